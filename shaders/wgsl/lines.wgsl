// Debug lines over the picture.

struct LinePoint {
    @builtin(position) clip: vec4f,
    @location(0) color: vec3f,
}

@vertex
fn vs_line(@location(0) position: vec3f, @location(1) color: vec3f) -> LinePoint {
    var out: LinePoint;
    out.clip = view.clip_from_world * vec4f(position, 1.0);
    out.color = color;
    return out;
}

@fragment
fn fs_line(in: LinePoint) -> @location(0) vec4f {
    return vec4f(select(in.color, srgb(in.color), view.modes.z == ENCODED), 1.0);
}
