//! A wgpu renderer for fire: exact depth peeling, shading along the ray, and glow at several resolutions.
//!
//! It takes the caller's device, queue and encoder; it never creates a device, reads no file and knows no solver.
//! A frame goes through six [`Stage`]s; each is one file here and one or two in `lucerna_shaders`.
//!
//! ```no_run
//! # fn draw(device: &wgpu::Device, queue: &wgpu::Queue, target: &wgpu::TextureView,
//! #         frame: &lucerna_frame::Frame<'_>) -> Result<(), lucerna_render::RenderError> {
//! use lucerna_frame::{Camera, Look};
//! use lucerna_render::FireRenderer;
//!
//! let mut renderer = FireRenderer::new(device, queue, wgpu::TextureFormat::Bgra8UnormSrgb); // once
//!
//! renderer.prepare(device, queue, [1280, 720], frame, &Camera::default(), &Look::default())?; // every frame
//! let mut encoder = device.create_command_encoder(&Default::default());
//! renderer.render(&mut encoder, target);
//! queue.submit([encoder.finish()]);
//! # Ok(())
//! # }
//! ```

mod bounds;
mod check;
mod compose;
mod data;
mod error;
mod flames;
mod glow;
mod layouts;
mod light_cells;
mod light_tree;
mod lighting;
mod nets;
mod opaque;
mod pipelines;
mod renderer;
mod shadows;
mod statistics;
mod surfaces;
mod targets;
mod textures;
mod upload;

pub use error::RenderError;
pub use renderer::{FireRenderer, Stage};
pub use statistics::Statistics;
