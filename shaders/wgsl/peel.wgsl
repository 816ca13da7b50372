// Depth peeling (paper 003, section 5.1): each pass keeps the nearest surface behind the last pass's.

@group(1) @binding(0) var scene_depth: texture_2d<f32>;
@group(1) @binding(1) var previous_depth: texture_2d<f32>;

// In `shell` shading the scene hides layers. In `volume` it does not: it cuts intervals later, because a wick
// stands inside its flame and the far side is needed to know how long the ray was inside.
fn is_hidden(clip: vec4f) -> bool {
    return view.modes.x == 0u && clip.z >= textureLoad(scene_depth, vec2i(clip.xy), 0).x;
}

@fragment
fn fs_first(in: FlameSurface, @builtin(front_facing) front: bool) -> @location(0) vec2u {
    if is_hidden(in.clip) {
        discard;
    }
    return pack_layer(in, front);
}

@fragment
fn fs_next(in: FlameSurface, @builtin(front_facing) front: bool) -> @location(0) vec2u {
    if in.clip.z <= textureLoad(previous_depth, vec2i(in.clip.xy), 0).x || is_hidden(in.clip) {
        discard;
    }
    return pack_layer(in, front);
}

// Counts every surface behind a pixel.
@fragment
fn fs_count(in: FlameSurface) -> @location(0) vec4f {
    if is_hidden(in.clip) {
        discard;
    }
    return vec4f(1.0, 0.0, 0.0, 0.0);
}
