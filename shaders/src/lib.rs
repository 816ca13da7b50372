//! The WGSL of Lucerna, one file per pass.
//!
//! Each constant is a complete module, ready for `wgpu::Device::create_shader_module`; shared parts are put in
//! front at compile time. Nothing beyond WebGPU's core features and default limits is used.

/// The opaque scene, lit by the flames: `vs_opaque`, `fs_opaque`, `vs_depth`.
pub const OPAQUE: &str = concat!(
    include_str!("../wgsl/common.wgsl"),
    include_str!("../wgsl/opaque.wgsl"),
    include_str!("../wgsl/shadows.wgsl")
);

/// What a light sees of the scene: `vs_shadow`.
pub const SHADOW_MAP: &str = include_str!("../wgsl/shadow_map.wgsl");

/// Depth peeling: `vs_flame`, `fs_first`, `fs_next`, `fs_count`.
pub const PEEL: &str = concat!(
    include_str!("../wgsl/common.wgsl"),
    include_str!("../wgsl/surface.wgsl"),
    include_str!("../wgsl/peel.wgsl")
);

/// `shell` shading of peeled layers: `vs_fullscreen`, `fs_shell`.
pub const SHELL: &str = concat!(
    include_str!("../wgsl/common.wgsl"),
    include_str!("../wgsl/surface.wgsl"),
    include_str!("../wgsl/shell_color.wgsl"),
    include_str!("../wgsl/shell.wgsl"),
    include_str!("../wgsl/fullscreen.wgsl")
);

/// `shell` shading in one additive pass: `vs_flame`, `fs_unsorted`.
pub const UNSORTED: &str = concat!(
    include_str!("../wgsl/common.wgsl"),
    include_str!("../wgsl/surface.wgsl"),
    include_str!("../wgsl/shell_color.wgsl"),
    include_str!("../wgsl/unsorted.wgsl")
);

/// `volume` shading of peeled layers: `vs_fullscreen`, `fs_volume`.
pub const VOLUME: &str = concat!(
    include_str!("../wgsl/common.wgsl"),
    include_str!("../wgsl/surface.wgsl"),
    include_str!("../wgsl/volume.wgsl"),
    include_str!("../wgsl/fullscreen.wgsl")
);

/// Gaussian blur and its reduced sources: `vs_fullscreen`, `fs_blur`, `fs_shrink`.
pub const BLUR: &str = concat!(include_str!("../wgsl/blur.wgsl"), include_str!("../wgsl/fullscreen.wgsl"));

/// Composition into the target: `vs_fullscreen`, `fs_compose`, `fs_over`, `fs_debug`.
pub const COMPOSE: &str = concat!(
    include_str!("../wgsl/common.wgsl"),
    include_str!("../wgsl/compose.wgsl"),
    include_str!("../wgsl/fullscreen.wgsl")
);

/// Debug lines: `vs_line`, `fs_line`.
pub const LINES: &str = concat!(include_str!("../wgsl/common.wgsl"), include_str!("../wgsl/lines.wgsl"));

/// Vertices of flames from control nets: `cs_evaluate`, a compute pass.
pub const EVALUATE: &str = include_str!("../wgsl/evaluate.wgsl");

/// All modules by name.
pub const ALL: [(&str, &str); 10] = [
    ("opaque", OPAQUE),
    ("shadow map", SHADOW_MAP),
    ("peel", PEEL),
    ("shell", SHELL),
    ("unsorted", UNSORTED),
    ("volume", VOLUME),
    ("blur", BLUR),
    ("compose", COMPOSE),
    ("lines", LINES),
    ("evaluate", EVALUATE),
];
