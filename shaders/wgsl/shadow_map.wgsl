// What a light sees through one face of the cube around it: the depth alone.

struct Face {
    clip_from_world: mat4x4f,
}

@group(0) @binding(0) var<uniform> face: Face;

@vertex
fn vs_shadow(@location(0) position: vec3f) -> @builtin(position) vec4f {
    return face.clip_from_world * vec4f(position, 1.0);
}
