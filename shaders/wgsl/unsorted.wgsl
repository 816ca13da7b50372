// `shell` shading in one additive pass: where layers are only added, their order does not matter.

@group(1) @binding(0) var scene_depth: texture_2d<f32>;

@fragment
fn fs_unsorted(in: FlameSurface, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    if in.clip.z >= textureLoad(scene_depth, vec2i(in.clip.xy), 0).x {
        discard;
    }
    return vec4f(min(shell_color(unpack_layer(pack_layer(in, front))), vec3f(BRIGHTEST)), 0.0);
}
