// The opaque scene, lit by the flames pixel by pixel.

// A light of a flame, or many in one.
struct Light {
    // xyz: where it is in the world; w: square of its radius.
    position_radius2: vec4f,
    intensity: vec4f,
}

struct Lighting {
    // xyz: corner of the grid of cells; w: cells per metre.
    origin_scale: vec4f,
    // Cells along x, y and z; w: lights with a shadow.
    counts: vec4u,
    // x: texels across a face of a shadow map; y: tangent of half its field; zw: the size of a texel.
    shadow: vec4f,
    // x: taps of the filter of shadows; yzw: unused
    taps: vec4u,
}

@group(1) @binding(0) var<uniform> lighting: Lighting;
@group(1) @binding(1) var<storage, read> lights: array<Light>;
// For each cell where its list begins and ends; then the lists of lights.
@group(1) @binding(2) var<storage, read> lists: array<u32>;

// The cell of a point of the world: where its list begins and ends.
fn list_of(world: vec3f) -> vec2u {
    let last = vec3f(lighting.counts.xyz) - 1.0;
    let at = vec3u(clamp((world - lighting.origin_scale.xyz) * lighting.origin_scale.w, vec3f(0.0), last));
    let cell = (at.z * lighting.counts.y + at.y) * lighting.counts.x + at.x;
    return vec2u(lists[2u * cell], lists[2u * cell + 1u]);
}

struct Surface {
    @builtin(position) @invariant clip: vec4f,
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

fn sum_of(color: vec3f) -> f32 {
    return color.r + color.g + color.b;
}

// How much of a light of intensity 1 a surface throws back: diffusely, and towards the eye.
fn reflected(position_radius2: vec4f, world: vec3f, normal: vec3f, to_eye: vec3f, translucency: f32) -> vec2f {
    let to_light = position_radius2.xyz - world;
    // A sphere of gas, not a point: the fall-off levels out inside it, and it peeps over the horizon.
    let distance2 = dot(to_light, to_light);
    let squared = distance2 + position_radius2.w;
    let direction = to_light * inverseSqrt(max(distance2, 1e-12));
    let wrap = sqrt(position_radius2.w / squared);
    let cosine = dot(normal, direction);
    let facing = max((cosine + wrap) / (1.0 + wrap), 0.0);
    let half_way = direction + to_eye;
    let along = max(dot(normal, half_way), 0.0);
    let square = along * along / max(dot(half_way, half_way), 1e-6);
    let fourth = square * square;
    let eighth = fourth * fourth;
    // Light that went in elsewhere knows little of this normal.
    return vec2f(mix(facing, 0.5 + 0.5 * cosine, translucency), facing * eighth * eighth) / squared;
}

@fragment
fn fs_opaque(in: Surface, @builtin(front_facing) is_front: bool) -> @location(0) vec4f {
    let to_eye = normalize(view.eye_time.xyz - in.world);
    var normal = normalize(in.normal);
    if !is_front {
        normal = -normal;
    }
    var irradiance = vec3f(0.0);
    var gloss = vec3f(0.0);
    let list = list_of(in.world);
    for (var i = list.x; i < list.y; i++) {
        let light = lights[lists[i]];
        let share = reflected(light.position_radius2, in.world, normal, to_eye, in.translucency);
        irradiance += light.intensity.rgb * share.x;
        gloss += light.intensity.rgb * share.y;
    }
    if SHADOWS {
        // The normal of the triangle itself, towards the eye: shadows are thrown by triangles.
        var flat_normal = cross(dpdx(in.world), dpdy(in.world));
        let area = length(flat_normal);
        flat_normal = select(normal, flat_normal / area, area > 0.0);
        flat_normal *= select(1.0, -1.0, dot(flat_normal, to_eye) < 0.0);
        // All the light that may fall here: what a light adds to it is its share of the taps.
        var all = sum_of(irradiance);
        for (var i = 0u; i < lighting.counts.w; i++) {
            let share = reflected(casters[i].position_radius2, in.world, normal, to_eye, in.translucency);
            all += share.x * sum_of(casters[i].intensity_share.rgb);
        }
        let taps_per_light = f32(lighting.taps.x) / max(all, 1e-30);
        // Interleaved gradient noise (Jimenez 2014): neighbours turn the taps by very different angles.
        let noise = fract(52.9829189 * fract(dot(in.clip.xy, vec2f(0.06711056, 0.00583715))));
        var turn = vec2f(cos(6.2831853 * noise), sin(6.2831853 * noise));
        for (var i = 0u; i < lighting.counts.w; i++) {
            let light = casters[i].intensity_share;
            let share = reflected(casters[i].position_radius2, in.world, normal, to_eye, in.translucency);
            let taps = min(u32(ceil(share.x * sum_of(light.rgb) * taps_per_light)), lighting.taps.x);
            let hidden = (1.0 - visibility(i, in.world, flat_normal, turn, taps)) * light.w;
            turn = turned(turn, GOLDEN);
            // Light that went in elsewhere knows little of this shadow.
            irradiance += light.rgb * (share.x * (1.0 - hidden * (1.0 - in.translucency)));
            gloss += light.rgb * (share.y * (1.0 - hidden));
        }
    }
    let gain = view.ambient_gain.w;
    let diffuse = in.color * (irradiance * (gain / 3.14159265) + view.ambient_gain.rgb);
    let specular = gloss * (gain * SPECULAR * (SHININESS + 2.0) / 6.2831853);
    // Beyond the edge of a triangle, where only samples lie in it, colours may fall below zero.
    return vec4f(clamp(diffuse + specular + in.emission, vec3f(0.0), vec3f(BRIGHTEST)), 1.0);
}

// The depth alone, for the passes that follow: bit for bit that of the surfaces above.
@vertex
fn vs_depth(@location(0) position: vec3f) -> @builtin(position) @invariant vec4f {
    return view.clip_from_world * vec4f(position, 1.0);
}
