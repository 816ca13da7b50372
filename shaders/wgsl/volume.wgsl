// `volume` shading: the peeled layers pair, flame by flame, into the intervals that the ray spends inside, and
// the gas glows along them.

@group(1) @binding(0) var layer_surfaces: texture_2d_array<u32>;
@group(1) @binding(1) var layer_depths: texture_2d_array<f32>;
@group(1) @binding(2) var scene_depth: texture_2d<f32>;
@group(1) @binding(3) var noise: texture_3d<f32>;
@group(1) @binding(4) var noise_sampler: sampler;
@group(1) @binding(5) var<storage, read_write> open_intervals: atomic<u32>;

// Flames that one ray may be inside of, or have been inside of.
const SLOTS: u32 = 16u;

struct Ray {
    origin: vec3f,
    direction: vec3f,
    // Where the visible part of the ray begins and ends, in metres from the origin.
    begin: f32,
    end: f32,
}

struct Light3 {
    soot: vec3f,
    blue: vec3f,
    depth: f32,
}

struct Open {
    packed: vec2u,
    distance: f32,
    // Surfaces entered and not yet left; 0 once the flame was left.
    count: i32,
}

fn noise_at(flame: Flame, index: u32, point: vec3f) -> f32 {
    // Filaments are drawn out upwards; each flame has a pattern of its own.
    let p = point * (vec3f(1.0, 0.45, 1.0) * flame.noise_per_m) + vec3f(f32(index) * 0.37);
    let coarse = textureSampleLevel(noise, noise_sampler, p - vec3f(0.0, flame.cool.w, 0.0), 0.0).x;
    let fine = textureSampleLevel(noise, noise_sampler, p * 2.3 - vec3f(0.0, flame.blue.w, 0.0), 0.0).x;
    return coarse * 0.65 + fine * 0.35;
}

// Share of a chord that lies in the outer fifth of the radius.
fn limb_share(facing: f32) -> f32 {
    let f2 = facing * facing;
    return 1.0 - sqrt(max(f2 - 0.36, 0.0)) / max(facing, 1e-4);
}

fn interval(ray: Ray, enter: Layer, leave: Layer, from_m: f32, to_m: f32) -> Light3 {
    var out: Light3;
    let first = max(from_m, ray.begin);
    let last = min(to_m, ray.end);
    let chord = to_m - from_m;
    if last <= first || chord <= 0.0 {
        return out;
    }
    let flame = flames[enter.flame];
    let steps = view.modes.y;
    let step_m = (last - first) / f32(steps);
    var soot = 0.0;
    for (var i = 0u; i < steps; i++) {
        let distance = first + (f32(i) + 0.5) * step_m;
        let along = (distance - from_m) / chord;
        let side = 2.0 * along - 1.0;
        let facing = mix(enter.facing, leave.facing, along);
        let height = mix(enter.height, leave.height, along);
        // The relative radius of a point on a chord: 1 at its ends, sqrt(1 - facing^2) at its middle.
        let q2 = 1.0 - facing * facing * (1.0 - side * side);
        var density = 1.0 - q2;
        if flame.noise_amount > 0.0 {
            let n = noise_at(flame, enter.flame, ray.origin + ray.direction * distance);
            // Noise eats at the rim and at the tip first; the root stays whole.
            let bite = flame.noise_amount * smoothstep(0.0, 0.35, height) * (0.6 + 0.8 * height);
            density = max(density * (1.0 + bite) - bite * 1.5 * n, 0.0) * mix(1.0, 2.0 * (1.0 - n), flame.noise_amount * 0.6);
        }
        let inner = flame.dark_radius * clamp((flame.dark_end - height) / (0.77 * flame.dark_end + 1e-4), 0.0, 1.0);
        let dark = 0.85 * (1.0 - smoothstep(0.6, 1.2, sqrt(q2) / max(inner, 1e-4)));
        let grown = smoothstep(flame.soot_begin, max(flame.soot_full, flame.soot_begin + 1e-4), height);
        let fading = pow(clamp((1.0 - height) / max(flame.tip_fade, 1e-4), 0.0, 1.0), 0.6);
        soot += density * (1.0 - dark) * grown * fading;
    }
    let depth = soot * step_m * flame.soot_per_m * flame.strength;
    // Thin gas shows cooler, orange; deep gas the soot's own colour.
    let visible = depth * view.background_exposure.w * flame.hot.g;
    let radiance = mix(flame.hot.rgb, flame.cool.rgb, exp(-0.9 * visible));
    out.soot = radiance * flame.tint * depth;
    out.depth = depth;
    // The blue zone is a thin shell around the root, seen once on the near and once on the far side.
    let half_m = 0.5 * chord;
    let near_m = clamp(min(last, from_m + half_m) - first, 0.0, half_m);
    let far_m = clamp(last - max(first, from_m + half_m), 0.0, half_m);
    let near = near_m * limb_share(enter.facing) * pow(clamp((flame.blue_end - enter.height) / max(flame.blue_end, 1e-4), 0.0, 1.0), 1.3);
    let far = far_m * limb_share(leave.facing) * pow(clamp((flame.blue_end - leave.height) / max(flame.blue_end, 1e-4), 0.0, 1.0), 1.3);
    out.blue = flame.blue.rgb * flame.tint * ((near + far) * flame.blue_per_m * flame.strength);
    return out;
}

// An interval of which only the entry is known: smooth gas over the chord of a round flame.
fn open_interval(ray: Ray, enter: Layer, from_m: f32) -> Light3 {
    var out: Light3;
    let flame = flames[enter.flame];
    let chord = min(2.0 * enter.radius * enter.facing, max(ray.end - from_m, 0.0));
    let grown = smoothstep(flame.soot_begin, max(flame.soot_full, flame.soot_begin + 1e-4), enter.height);
    let fading = pow(clamp((1.0 - enter.height) / max(flame.tip_fade, 1e-4), 0.0, 1.0), 0.6);
    // The mean of 1 - q^2 over a chord is two thirds of facing^2.
    let mean = enter.facing * enter.facing / 1.5;
    out.depth = chord * mean * grown * fading * flame.soot_per_m * flame.strength;
    out.soot = flame.hot.rgb * flame.tint * out.depth;
    return out;
}

@fragment
fn fs_volume(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(position.xy);
    if textureLoad(layer_surfaces, pixel, 0, 0).x == 0u {
        discard;
    }
    let eye = view.eye_time.xyz;
    var ray: Ray;
    ray.origin = eye;
    ray.direction = normalize(world_at(position.xy, 0.5) - eye);
    let slant = 1.0 / max(dot(ray.direction, view.forward_near.xyz), 1e-4);
    ray.begin = view.forward_near.w * slant;
    let scene = textureLoad(scene_depth, pixel, 0).x;
    ray.end = 1e9;
    if scene < 1.0 {
        ray.end = distance(world_at(position.xy, scene), eye);
    }

    var opened: array<Open, SLOTS>;
    var used = 0u;
    var soot = vec3f(0.0);
    var blue = vec3f(0.0);
    var depth = 0.0;
    var layers_left = false;
    for (var i = 0u; i < view.size_layers.z; i++) {
        let packed = textureLoad(layer_surfaces, pixel, i32(i), 0).xy;
        if packed.x == 0u {
            layers_left = true;
            break;
        }
        let z = textureLoad(layer_depths, pixel, i32(i), 0).x;
        let here = distance(world_at(position.xy, z), eye);
        let flame = packed.x >> 17u;
        var slot = 0u;
        for (; slot < used; slot++) {
            if (opened[slot].packed.x >> 17u) == flame {
                break;
            }
        }
        if slot == SLOTS {
            continue;
        }
        let is_new = slot == used;
        if is_new {
            used += 1u;
            opened[slot].count = 0;
        }
        let is_front = ((packed.x >> 16u) & 1u) == 1u;
        if is_front {
            if is_new || opened[slot].count == 0 {
                opened[slot].packed = packed;
                opened[slot].distance = here;
            }
            opened[slot].count += 1;
            continue;
        }
        var enter = opened[slot].packed;
        var from_m = opened[slot].distance;
        if is_new {
            // The first face of this flame is a back face: the eye is inside of it, unless the front face lies at the
            // same depth (a silhouette), where the ray was not inside at all.
            opened[slot].packed = packed;
            enter = packed;
            from_m = select(here, 2.0 * ray.begin - here, flames[flame - 1u].hot.w == 1.0);
        } else {
            opened[slot].count -= 1;
            if opened[slot].count != 0 {
                // Left a fold within the flame, or a face without an entry.
                opened[slot].count = max(opened[slot].count, 0);
                continue;
            }
        }
        let light = interval(ray, unpack_layer(enter), unpack_layer(packed), from_m, here);
        soot += light.soot;
        blue += light.blue;
        depth += light.depth;
    }
    // Still inside when the layers ran out: the chord of a round flame entered at this angle ends it.
    for (var slot = 0u; slot < used && !layers_left; slot++) {
        if opened[slot].count > 0 && opened[slot].distance < ray.end {
            let light = open_interval(ray, unpack_layer(opened[slot].packed), opened[slot].distance);
            soot += light.soot;
            depth += light.depth;
            atomicAdd(&open_intervals, 1u);
        }
    }
    // Flames that share a ray are taken as mixed along it: emission adds, and all of it is absorbed alike.
    let escape = select((1.0 - exp(-depth)) / max(depth, 1e-6), 1.0 - 0.5 * depth, depth < 1e-3);
    let radiance = min(adapted(soot) * escape + blue * escape, vec3f(BRIGHTEST));
    return vec4f(radiance, 1.0 - exp(-depth));
}
