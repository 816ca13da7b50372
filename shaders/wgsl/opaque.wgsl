// The opaque scene, lit by the flames pixel by pixel.

struct Surface {
    @builtin(position) clip: vec4f,
    @location(0) world: vec3f,
    @location(1) normal: vec3f,
    @location(2) color: vec3f,
    @location(3) emission: vec3f,
    @location(4) translucency: f32,
}

@vertex
fn vs_opaque(
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) color: vec3f,
    @location(3) emission: vec3f,
    @location(4) translucency: f32,
) -> Surface {
    var out: Surface;
    out.clip = view.clip_from_world * vec4f(position, 1.0);
    out.world = position;
    out.normal = normal;
    out.color = color;
    out.emission = emission;
    out.translucency = translucency;
    return out;
}

// Blinn-Phong with a broad lobe: wood, wax and stone. The exponent is a power of two: four squarings, no pow.
const SHININESS: f32 = 16.0;
const SPECULAR: f32 = 0.04;

@fragment
fn fs_opaque(in: Surface, @builtin(front_facing) is_front: bool) -> @location(0) vec4f {
    let to_eye = normalize(view.eye_time.xyz - in.world);
    var normal = normalize(in.normal);
    if !is_front {
        normal = -normal;
    }
    var irradiance = vec3f(0.0);
    var gloss = vec3f(0.0);
    for (var i = 0u; i < view.size_layers_lights.w; i++) {
        let light = lights[i];
        let to_light = light.position_radius.xyz - in.world;
        // A sphere of gas, not a point: the fall-off levels out inside it, and it peeps over the horizon.
        let radius = light.position_radius.w;
        let distance2 = dot(to_light, to_light);
        let squared = distance2 + radius * radius;
        let direction = to_light * inverseSqrt(max(distance2, 1e-12));
        let wrap = radius * inverseSqrt(squared);
        let cosine = dot(normal, direction);
        let reflected = max((cosine + wrap) / (1.0 + wrap), 0.0);
        // Light that went in elsewhere: it knows little of this normal.
        let facing = mix(reflected, 0.5 + 0.5 * cosine, in.translucency);
        irradiance += light.intensity.rgb * (facing / squared);
        let half_way = direction + to_eye;
        let along = max(dot(normal, half_way), 0.0);
        let square = along * along / max(dot(half_way, half_way), 1e-6);
        let fourth = square * square;
        let eighth = fourth * fourth;
        gloss += light.intensity.rgb * (reflected / squared * eighth * eighth);
    }
    let gain = view.ambient_gain.w;
    let diffuse = in.color * (irradiance * (gain / 3.14159265) + view.ambient_gain.rgb);
    let specular = gloss * (gain * SPECULAR * (SHININESS + 2.0) / 6.2831853);
    return vec4f(min(diffuse + specular + in.emission, vec3f(BRIGHTEST)), 1.0);
}

// The depth alone, for the passes that follow.
@vertex
fn vs_depth(@location(0) position: vec3f) -> @builtin(position) vec4f {
    return view.clip_from_world * vec4f(position, 1.0);
}
