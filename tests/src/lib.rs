//! What the tests across crates share: a device with nothing optional, and textures read back as numbers.

use lucerna::{StepSummary, World};
use std::time::Duration;

// The examples of the README are compiled and run as those of the documentation are.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;

/// A device with core features and default limits only, so that passing here means passing elsewhere.
///
/// # Panics
/// If there is no adapter: the tests of pictures mean nothing without one.
#[must_use]
pub fn device() -> (wgpu::Device, wgpu::Queue) {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))
        .expect("no graphics adapter: run scripts/setup, or install mesa-vulkan-drivers");
    pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default())).expect("a device of core features")
}

/// A built-in scene that has burned for a while.
///
/// # Panics
/// If it does not burn.
#[must_use]
pub fn burning(name: &str, time_s: f64) -> World {
    let scene = lucerna::scene::builtin(name).expect(name);
    let mut world = World::new(scene).expect(name);
    while world.time_s() < time_s {
        step_once(&mut world);
    }
    world
}

/// One fixed step, whatever its length.
///
/// # Panics
/// If the world does not make just this step.
pub fn step_once(world: &mut World) -> StepSummary {
    let summary = world.step(world.scene().scene.air.time_step_s).expect("a step");
    assert_eq!((summary.steps, summary.dropped), (1, 0));
    summary
}

/// A texture to render into and read back.
#[must_use]
pub fn target(device: &wgpu::Device, [width, height]: [u32; 2], format: wgpu::TextureFormat) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some("target"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT
            | wgpu::TextureUsages::COPY_SRC
            | wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    })
}

/// All texels of a texture, row by row without padding.
///
/// # Panics
/// If the GPU does not answer within half a minute.
#[must_use]
pub fn read(device: &wgpu::Device, queue: &wgpu::Queue, texture: &wgpu::Texture) -> Vec<u8> {
    let size = texture.size();
    let row = size.width * texture.format().block_copy_size(None).expect("a colour format");
    let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("read-back"),
        size: u64::from(padded * size.height),
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(padded), rows_per_image: None };
    encoder.copy_texture_to_buffer(
        texture.as_image_copy(),
        wgpu::TexelCopyBufferInfo { buffer: &buffer, layout },
        size,
    );
    queue.submit([encoder.finish()]);
    buffer.slice(..).map_async(wgpu::MapMode::Read, |_| ());
    let wait = wgpu::PollType::Wait { submission_index: None, timeout: Some(Duration::from_secs(30)) };
    device.poll(wait).expect("the GPU answers");
    let mapped = buffer.slice(..).get_mapped_range().expect("mapped");
    mapped.chunks(padded as usize).flat_map(|line| &line[..row as usize]).copied().collect()
}

/// The first bytes of a buffer.
///
/// # Panics
/// If the GPU does not answer within half a minute.
#[must_use]
pub fn read_buffer(device: &wgpu::Device, queue: &wgpu::Queue, from: &wgpu::Buffer, size: u64) -> Vec<u8> {
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("read-back"),
        size,
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encoder.copy_buffer_to_buffer(from, 0, &buffer, 0, size);
    queue.submit([encoder.finish()]);
    buffer.slice(..).map_async(wgpu::MapMode::Read, |_| ());
    let wait = wgpu::PollType::Wait { submission_index: None, timeout: Some(Duration::from_secs(30)) };
    device.poll(wait).expect("the GPU answers");
    buffer.slice(..).get_mapped_range().expect("mapped").to_vec()
}

/// A half-precision number.
#[must_use]
pub fn half(bits: u16) -> f32 {
    let sign = if bits >> 15 == 1 { -1.0 } else { 1.0 };
    let (exponent, mantissa) = (i32::from((bits >> 10) & 31), f32::from(bits & 0x3ff));
    sign * match exponent {
        0 => mantissa * (-24.0_f32).exp2(),
        31 if mantissa == 0.0 => f32::INFINITY,
        31 => f32::NAN,
        _ => (1.0 + mantissa / 1024.0) * ((exponent - 15) as f32).exp2(),
    }
}

/// The texels of an `Rgba16Float` texture.
#[must_use]
pub fn read_rgba16f(device: &wgpu::Device, queue: &wgpu::Queue, texture: &wgpu::Texture) -> Vec<[f32; 4]> {
    read(device, queue, texture)
        .chunks_exact(8)
        .map(|texel| std::array::from_fn(|i| half(u16::from_le_bytes([texel[2 * i], texel[2 * i + 1]]))))
        .collect()
}

/// The luminance of a linear colour.
#[must_use]
pub fn luminance([r, g, b]: [f32; 3]) -> f32 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

/// The built-in scenes but the hall: that is too large to be burned and drawn again and again. The tests of the facade
/// burn it.
pub fn small_scenes() -> impl Iterator<Item = &'static &'static str> {
    lucerna::scene::builtin_names().iter().filter(|name| **name != "hall")
}
