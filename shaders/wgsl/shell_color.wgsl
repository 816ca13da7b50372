// The colour of one point of a flame's shell: the texture, tinted and faded where it turns away.

@group(2) @binding(0) var flame_texture: texture_2d<f32>;
@group(2) @binding(1) var flame_sampler: sampler;

fn shell_color(layer: Layer) -> vec3f {
    let flame = flames[layer.flame];
    // Twice around; the picture's first row is the tip.
    let uv = vec2f(layer.u * 2.0, 1.0 - layer.height);
    let texel = textureSampleLevel(flame_texture, flame_sampler, uv, 0.0).rgb;
    let softness = view.extra.x;
    let fade = 1.0 - softness + softness * layer.facing * layer.facing;
    return texel * flame.tint * (flame.strength * fade);
}
