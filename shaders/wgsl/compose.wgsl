// Everything into the target: scene behind the flames, blurred flames on top, exposure, tone map, dither.

// Chosen when the pipeline is made: on software drivers a branch not taken costs as much as one taken.
override GLOW_LEVELS: u32 = 4u;
override SHARPEST_IS_FULL: bool = false;

struct Compose {
    // One gain for each blurred copy; 0 where there is none.
    gains: vec4f,
    // debug view (see below), its layer, unused, unused
    debug: vec4u,
    // xy: texture coordinates of each blurred copy per pixel; its last texels may reach beyond the picture.
    uv_per_pixel: array<vec4f, 4>,
}

@group(1) @binding(0) var<uniform> compose: Compose;
@group(1) @binding(1) var opaque_color: texture_2d<f32>;
@group(1) @binding(2) var flame_color: texture_2d<f32>;
@group(1) @binding(3) var glow_0: texture_2d<f32>;
@group(1) @binding(4) var glow_1: texture_2d<f32>;
@group(1) @binding(5) var glow_2: texture_2d<f32>;
@group(1) @binding(6) var glow_3: texture_2d<f32>;
@group(1) @binding(7) var layer_surfaces: texture_2d_array<u32>;
@group(1) @binding(8) var layer_count: texture_2d<f32>;
@group(1) @binding(9) var linear_sampler: sampler;

const DEBUG_LAYER: u32 = 1u;
const DEBUG_COUNT: u32 = 2u;
const DEBUG_FLAMES: u32 = 3u;
const DEBUG_GLOW: u32 = 4u;
const DEBUG_OPAQUE: u32 = 5u;

// Two thirds per channel, one third on the luminance with the hue kept: the core of a flame goes to cream, its
// edges stay orange.
fn filmic(x: vec3f) -> vec3f {
    let channels = 1.0 - exp(-x);
    let luminance = dot(x, vec3f(0.2126, 0.7152, 0.0722));
    let hue = x * ((1.0 - exp(-luminance)) / max(luminance, 1e-6));
    return mix(channels, min(hue, vec3f(1.0)), 1.0 / 3.0);
}

// Interleaved gradient noise (Jimenez 2014), one step of 8 bits wide: no bands in the dark.
fn dither(pixel: vec2f) -> f32 {
    return (fract(52.9829189 * fract(dot(pixel, vec2f(0.06711056, 0.00583715)))) - 0.5) / 255.0;
}

// The sharpest copy is of full size or stands alone; reading it needs no filter then.
fn sharpest_at(pixel: vec2f) -> vec4f {
    if GLOW_LEVELS == 0u {
        return vec4f(0.0);
    }
    if SHARPEST_IS_FULL {
        return textureLoad(glow_0, vec2i(pixel), 0);
    }
    return textureSampleLevel(glow_0, linear_sampler, pixel * compose.uv_per_pixel[0].xy, 0.0);
}

fn glow_at(sharpest: vec3f, pixel: vec2f) -> vec3f {
    var sum = sharpest * compose.gains.x;
    if GLOW_LEVELS > 1u {
        sum += textureSampleLevel(glow_1, linear_sampler, pixel * compose.uv_per_pixel[1].xy, 0.0).rgb * compose.gains.y;
    }
    if GLOW_LEVELS > 2u {
        sum += textureSampleLevel(glow_2, linear_sampler, pixel * compose.uv_per_pixel[2].xy, 0.0).rgb * compose.gains.z;
    }
    if GLOW_LEVELS > 3u {
        sum += textureSampleLevel(glow_3, linear_sampler, pixel * compose.uv_per_pixel[3].xy, 0.0).rgb * compose.gains.w;
    }
    return sum * view.extra.y;
}

fn displayed(light: vec3f, pixel: vec2f) -> vec3f {
    var color = min(light * view.background_exposure.w, vec3f(BRIGHTEST));
    if view.modes.w == 1u {
        color = filmic(color);
    }
    if view.modes.z == LINEAR {
        return color;
    }
    if view.modes.z == ENCODED {
        return srgb(color) + dither(pixel);
    }
    // The target encodes by itself: a step of the encoded value is about 2.27 sqrt(c) steps of the linear one.
    return color + dither(pixel) * (2.27 * sqrt(clamp(color, vec3f(0.0), vec3f(1.0))) + 0.05);
}

// Blue through green to red, for counts from 1 to 16.
fn heat_color(count: f32) -> vec3f {
    let t = clamp(count / 16.0, 0.0, 1.0);
    return select(vec3f(0.0), clamp(vec3f(2.0 * t - 0.5, 1.5 - abs(4.0 * t - 2.0), 1.2 - 2.5 * t), vec3f(0.03), vec3f(1.0)), count > 0.0);
}

fn debug_color(pixel: vec2i) -> vec3f {
    switch compose.debug.x {
        case DEBUG_LAYER: {
            let packed = textureLoad(layer_surfaces, pixel, i32(compose.debug.y), 0).xy;
            let height = f32(packed.x & 0xffffu) / 65535.0;
            let side = select(vec3f(0.1, 0.4, 1.0), vec3f(1.0, 0.5, 0.1), ((packed.x >> 16u) & 1u) == 1u);
            return select(vec3f(0.0), side * (0.15 + 0.85 * height), packed.x != 0u);
        }
        case DEBUG_COUNT: {
            return heat_color(textureLoad(layer_count, pixel, 0).x);
        }
        default: {
            return vec3f(0.0);
        }
    }
}

fn debug_light(position: vec2f) -> vec3f {
    let pixel = vec2i(position);
    switch compose.debug.x {
        case DEBUG_FLAMES: {
            return textureLoad(flame_color, pixel, 0).rgb * view.extra.y;
        }
        case DEBUG_OPAQUE: {
            return textureLoad(opaque_color, pixel, 0).rgb;
        }
        default: {
            return glow_at(sharpest_at(position).rgb, position);
        }
    }
}

// One of the intermediate targets. A pass of its own: on software drivers even a branch not taken costs.
@fragment
fn fs_debug(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(position.xy);
    if compose.debug.x == DEBUG_LAYER || compose.debug.x == DEBUG_COUNT {
        let color = debug_color(pixel);
        return vec4f(select(color, srgb(color), view.modes.z == ENCODED), 1.0);
    }
    return vec4f(displayed(debug_light(position.xy), position.xy), 1.0);
}

@fragment
fn fs_compose(@builtin(position) position: vec4f) -> @location(0) vec4f {
    // The sharpest copy also says how much of the scene the soot hides: its edge must be as soft as the flame's.
    let sharpest = sharpest_at(position.xy);
    let scene = textureLoad(opaque_color, vec2i(position.xy), 0).rgb;
    return vec4f(displayed(scene * (1.0 - sharpest.a) + glow_at(sharpest.rgb, position.xy), position.xy), 1.0);
}

// Over a picture that is there already: premultiplied, so that the glow adds and the soot hides.
@fragment
fn fs_over(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let sharpest = sharpest_at(position.xy);
    return vec4f(displayed(glow_at(sharpest.rgb, position.xy), position.xy), sharpest.a);
}
