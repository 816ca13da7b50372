// One direction of a separable Gaussian whose taps come from the CPU, and the 4 x 4 box that feeds it.

struct Kernel {
    // x, y: step in texels; z: taps on each side; w: unused
    direction_radius: vec4i,
    // Four weights in each, from the centre outwards.
    weights: array<vec4f, 16>,
}

@group(0) @binding(0) var<uniform> kernel: Kernel;
@group(0) @binding(1) var source: texture_2d<f32>;

@fragment
fn fs_blur(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let last = vec2i(textureDimensions(source)) - 1;
    let center = vec2i(position.xy);
    var sum = textureLoad(source, center, 0) * kernel.weights[0].x;
    for (var i = 1; i <= kernel.direction_radius.z; i++) {
        let offset = kernel.direction_radius.xy * i;
        let weight = kernel.weights[i / 4][i % 4];
        let both = textureLoad(source, clamp(center - offset, vec2i(0), last), 0)
            + textureLoad(source, clamp(center + offset, vec2i(0), last), 0);
        sum += both * weight;
    }
    return sum;
}

@fragment
fn fs_shrink(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let last = vec2i(textureDimensions(source)) - 1;
    let corner = vec2i(position.xy) * 4;
    var sum = vec4f(0.0);
    for (var y = 0; y < 4; y++) {
        for (var x = 0; x < 4; x++) {
            sum += textureLoad(source, min(corner + vec2i(x, y), last), 0);
        }
    }
    return sum / 16.0;
}
