// Flame surfaces: one vertex entry point for all passes, so that their depths agree bit for bit, and the
// packing of what a layer remembers.

struct FlameSurface {
    @builtin(position) @invariant clip: vec4f,
    // Cosine between the normal and the direction to the eye.
    @location(0) facing: f32,
    @location(1) height: f32,
    // What the layer keeps beside: the texture's u (shell) or the radius in metres (volume).
    @location(2) kept: f32,
    @location(3) @interpolate(flat) flame: u32,
}

@vertex
fn vs_flame(
    @location(0) position: vec3f,
    @location(1) height: f32,
    @location(2) normal: vec3f,
    @location(3) radius: f32,
    @location(4) uv: vec2f,
    @location(5) flame: u32,
) -> FlameSurface {
    var out: FlameSurface;
    out.clip = view.clip_from_world * vec4f(position, 1.0);
    out.facing = dot(normal, normalize(view.eye_time.xyz - position));
    out.height = height;
    out.kept = select(radius, uv.x, view.modes.x == 0u);
    out.flame = flame;
    return out;
}

// A layer: flame (15 bits, from 1), facing (1 bit), height (16 bits); how directly the surface faces the eye
// (16 bits), and the texture's u (shell) or the root of the radius (volume; finer where it is small).
const RADIUS_LIMIT_M: f32 = 16.0;

struct Layer {
    flame: u32,
    front: bool,
    height: f32,
    facing: f32,
    u: f32,
    radius: f32,
}

fn pack_layer(in: FlameSurface, front: bool) -> vec2u {
    let height = u32(clamp(in.height, 0.0, 1.0) * 65535.0 + 0.5);
    let first = ((in.flame + 1u) << 17u) | (select(0u, 1u, front) << 16u) | height;
    var second = u32(clamp(abs(in.facing), 0.0, 1.0) * 65535.0 + 0.5);
    if view.modes.x == 0u {
        second |= u32(fract(in.kept) * 65535.0 + 0.5) << 16u;
    } else {
        second |= u32(sqrt(clamp(in.kept / RADIUS_LIMIT_M, 0.0, 1.0)) * 65535.0 + 0.5) << 16u;
    }
    return vec2u(first, second);
}

fn unpack_layer(packed: vec2u) -> Layer {
    var layer: Layer;
    layer.flame = (packed.x >> 17u) - 1u;
    layer.front = ((packed.x >> 16u) & 1u) == 1u;
    layer.height = f32(packed.x & 0xffffu) / 65535.0;
    layer.facing = f32(packed.y & 0xffffu) / 65535.0;
    layer.u = f32(packed.y >> 16u) / 65535.0;
    layer.radius = layer.u * layer.u * RADIUS_LIMIT_M;
    return layer;
}
