// Soft shadows of a few lights: six faces of a cube around each, in one atlas of depths.

// Chosen when the pipeline is made: a branch not taken costs as much on a software driver.
override SHADOWS: bool = true;

// A light with a shadow.
struct Caster {
    // xyz: where it is in the world; w: square of its radius.
    position_radius2: vec4f,
    // rgb; w: how much of its shadow is shown, 0 to 1.
    intensity_share: vec4f,
    // x: distance of the near planes; yzw: unused
    near: vec4f,
}

@group(1) @binding(3) var<storage, read> casters: array<Caster>;
// The same texture twice: what lies nearest, as near / distance, and whether it lies nearer than that.
@group(1) @binding(4) var nearest: texture_2d<f32>;
@group(1) @binding(5) var nearest_compared: texture_depth_2d;
@group(1) @binding(6) var comparison: sampler_comparison;

// Blockers are looked for so many times at most.
const SEARCHES: u32 = 16u;
// Where a light's ball is seen under more than this (a tangent), its shadow gets no softer.
const SOFTEST: f32 = 0.4;
// The angle between one tap of a spiral and the next: the golden one, as cosine and sine.
const GOLDEN: vec2f = vec2f(-0.7373688, 0.6754903);

struct CubePoint {
    // In texels of the light's strip of the atlas.
    texel: vec2f,
    // Along the face's axis, m.
    depth: f32,
}

// Where a point, seen from the light, lies on the faces of the cube: +x, -x, +y, -y, +z, -z from left to right.
fn on_cube(p: vec3f) -> CubePoint {
    let a = abs(p);
    let is_x = a.x >= max(a.y, a.z);
    let is_y = !is_x && a.y >= a.z;
    let face = select(select(vec2f(4.0, p.z), vec2f(2.0, p.y), is_y), vec2f(0.0, p.x), is_x);
    let across = select(select(p.xy, p.zx, is_y), p.yz, is_x);
    let size = lighting.shadow.x;
    let depth = abs(face.y);
    var out: CubePoint;
    out.depth = depth;
    let place = across / (depth * lighting.shadow.y);
    let column = face.x + select(0.0, 1.0, face.y < 0.0);
    out.texel = vec2f((column + 0.5 + 0.5 * place.x) * size, (0.5 + 0.5 * place.y) * size);
    return out;
}

fn turned(v: vec2f, by: vec2f) -> vec2f {
    return vec2f(v.x * by.x - v.y * by.y, v.x * by.y + v.y * by.x);
}

// How far along `q` something hides a point of a surface: up to the surface's own plane, which does not hide itself, or to
// the limit. `plane` and `along` are distances along the normal, of the plane and of `q`. In lengths of `q`.
fn reach(plane: f32, along: f32, limit: f32) -> f32 {
    return select(limit, min(plane / along, limit), plane * along > 0.0);
}

// The share of a light that a point of a flat triangle sees, 0 to 1. `turn` differs from pixel to pixel; with `taps` of 0
// nothing is looked up.
fn visibility(index: u32, world: vec3f, normal: vec3f, turn: vec2f, taps: u32) -> f32 {
    let caster = casters[index];
    let size = lighting.shadow.x;
    let top = f32(index) * size;
    let near = caster.near.x;
    let across_texel = 2.0 * lighting.shadow.y / size;
    // The plane of the surface, nearer to the light by one and a half texels: within a texel and its neighbours its depth
    // changes by less, however it is turned. A plane that faces away hides nothing of the light either: that a ball sinks
    // below the horizon is counted where it is reflected.
    let p = world - caster.position_radius2.xyz;
    let a = abs(p);
    let below = dot(p, normal);
    let plane = sign(below) * max(abs(below) - 1.5 * across_texel * max(a.x, max(a.y, a.z)), 0.0);
    let limit = select(1.0, 1e-4, plane == 0.0);
    let distance = length(p);
    let ahead = p / max(distance, 1e-6);
    let side = normalize(select(vec3f(0.0, -ahead.z, ahead.y), vec3f(ahead.y, -ahead.x, 0.0), abs(ahead.z) < 0.7));
    let u = side * distance;
    let v = cross(ahead, side) * distance;
    let across = vec2f(dot(u, normal), dot(v, normal));
    // Of the light's ball, as seen from the point: the tangent of the half angle.
    let ball = sqrt(caster.position_radius2.w) / max(distance, 1e-6);

    // How far the blockers are, on average: those that hide any part of the ball.
    var spiral = turn;
    var blockers = 0.0;
    var distances = 0.0;
    let searches = select(0u, clamp(2u * taps, 4u, SEARCHES), taps > 0u);
    for (var i = 0u; i < searches; i++) {
        let along = (f32(i) + 0.5) / f32(searches);
        let offset = SOFTEST * along * along;
        let step = spiral * offset;
        spiral = turned(spiral, GOLDEN);
        let at = on_cube(p + u * step.x + v * step.y);
        let hides_to = reach(plane, below + dot(across, step), limit);
        let stored = textureLoad(nearest, vec2i(at.texel + vec2f(0.0, top)), 0).r;
        let blocker = near / max(stored, 1e-9) / at.depth;
        if blocker < hides_to && offset <= ball * (1.0 / blocker - 1.0) + across_texel {
            blockers += 1.0;
            distances += blocker;
        }
    }
    let blocker = distances / max(blockers, 1.0);
    // The ball's image through the blocker, on the cube at that distance.
    let radius = clamp(ball * (1.0 / max(blocker, 1e-3) - 1.0), across_texel, SOFTEST);
    let used = select(0u, taps, blockers > 0.0);
    var lit = 0.0;
    for (var i = 0u; i < used; i++) {
        let offset = radius * sqrt((f32(i) + 0.5) / f32(taps));
        let step = spiral * offset;
        spiral = turned(spiral, GOLDEN);
        let at = on_cube(p + u * step.x + v * step.y);
        let hides_to = reach(plane, below + dot(across, step), limit);
        let place = (at.texel + vec2f(0.0, top)) * lighting.shadow.zw;
        lit += textureSampleCompareLevel(nearest_compared, comparison, place, near / (at.depth * hides_to));
    }
    return select(1.0, lit / f32(max(taps, 1u)), used > 0u);
}
