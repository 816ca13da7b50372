// What every pass knows: the camera, the look and the flames.

struct View {
    clip_from_world: mat4x4f,
    world_from_clip: mat4x4f,
    // Columns of the matrix that adapts linear sRGB to the camera's white.
    adapt_x: vec4f,
    adapt_y: vec4f,
    adapt_z: vec4f,
    // xyz: the eye in the world; w: simulated time in seconds.
    eye_time: vec4f,
    // xyz: the direction of view; w: distance of the near plane in metres.
    forward_near: vec4f,
    // rgb, linear; w: gain of the light on the scene.
    ambient_gain: vec4f,
    // rgb, linear; w: factor of the exposure.
    background_exposure: vec4f,
    // width, height, layers; w: unused
    size_layers: vec4u,
    // shading (0 shell, 1 volume), integration steps, what the target stores (see below), tone map (0 none, 1 filmic)
    modes: vec4u,
    // x: softness of shells; y: gain of the flames over the scene (shells are painted for the display); zw: unused
    extra: vec4f,
}

struct Flame {
    tint: vec3f,
    soot_per_m: f32,
    temperature_k: f32,
    soot_begin: f32,
    soot_full: f32,
    tip_fade: f32,
    blue_per_m: f32,
    blue_end: f32,
    dark_radius: f32,
    dark_end: f32,
    noise_amount: f32,
    noise_per_m: f32,
    noise_rise_m_s: f32,
    strength: f32,
    // Black-body radiance at the soot's temperature, and 300 K below; emission of the blue zone. hot.w: 1 if the eye
    // may be inside the flame. cool.w, blue.w: how far the two octaves of noise have risen, in periods.
    hot: vec4f,
    cool: vec4f,
    blue: vec4f,
}

@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<storage, read> flames: array<Flame>;

// What a target stores: linear light that it encodes as sRGB itself, sRGB that we encode, or plain linear numbers.
const ENCODES: u32 = 0u;
const ENCODED: u32 = 1u;
const LINEAR: u32 = 2u;

// Just below what half floats hold: nothing brighter goes into a target, so that nothing becomes infinite.
const BRIGHTEST: f32 = 6e4;

fn srgb(x: vec3f) -> vec3f {
    let c = clamp(x, vec3f(0.0), vec3f(1.0));
    return select(1.055 * pow(c, vec3f(1.0 / 2.4)) - 0.055, c * 12.92, c <= vec3f(0.0031308));
}

fn adapted(color: vec3f) -> vec3f {
    let c = view.adapt_x.rgb * color.r + view.adapt_y.rgb * color.g + view.adapt_z.rgb * color.b;
    return max(c, vec3f(0.0));
}

// The world point of a pixel centre at a depth.
fn world_at(pixel: vec2f, depth: f32) -> vec3f {
    let size = vec2f(view.size_layers.xy);
    let ndc = vec2f(pixel.x / size.x * 2.0 - 1.0, 1.0 - pixel.y / size.y * 2.0);
    let p = view.world_from_clip * vec4f(ndc, depth, 1.0);
    return p.xyz / p.w;
}
