// `shell` shading: the peeled layers, textured and added (paper 003, section 5.1).

@group(1) @binding(0) var layer_surfaces: texture_2d_array<u32>;

@fragment
fn fs_shell(@builtin(position) position: vec4f) -> @location(0) vec4f {
    var sum = vec3f(0.0);
    for (var i = 0u; i < view.size_layers.z; i++) {
        let packed = textureLoad(layer_surfaces, vec2i(position.xy), i32(i), 0).xy;
        if packed.x == 0u {
            break;
        }
        sum += shell_color(unpack_layer(packed));
    }
    return vec4f(min(sum, vec3f(BRIGHTEST)), 0.0);
}
