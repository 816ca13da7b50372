//! Textures that the renderer makes for itself: the painted flame of `shell` shading and the noise of `volume`.

use std::f32::consts::TAU;

/// A repeatable random number in 0..1 for a lattice point.
fn lattice(x: u32, y: u32, z: u32) -> f32 {
    let mut h = x.wrapping_mul(0x8da6_b343) ^ y.wrapping_mul(0xd816_3841) ^ z.wrapping_mul(0xcb1a_b31f);
    h = (h ^ (h >> 15)).wrapping_mul(0x2c1b_3c6d);
    h = (h ^ (h >> 12)).wrapping_mul(0x297a_2d39);
    (h ^ (h >> 15)) as f32 / u32::MAX as f32
}

/// Smooth value noise that repeats after `period` lattice cells along each axis.
fn periodic_noise(p: [f32; 3], period: [u32; 3]) -> f32 {
    let cell = p.map(f32::floor);
    let mut t = [p[0] - cell[0], p[1] - cell[1], p[2] - cell[2]];
    for v in &mut t {
        *v = *v * *v * *v * (*v * (*v * 6.0 - 15.0) + 10.0);
    }
    let mut sum = 0.0;
    for corner in 0..8u32 {
        let mut weight = 1.0;
        let mut at = [0u32; 3];
        for axis in 0..3 {
            let up = (corner >> axis) & 1;
            weight *= if up == 1 { t[axis] } else { 1.0 - t[axis] };
            at[axis] = (cell[axis] as u32 + up) % period[axis];
        }
        sum += weight * lattice(at[0], at[1], at[2]);
    }
    sum
}

/// Edge of the noise volume in texels.
const NOISE_SIZE: u32 = 64;

/// Three octaves of value noise in a cube that tiles, 0 to 1.
pub(crate) fn noise(device: &wgpu::Device, queue: &wgpu::Queue) -> wgpu::TextureView {
    let mut texels = Vec::with_capacity((NOISE_SIZE * NOISE_SIZE * NOISE_SIZE) as usize);
    for z in 0..NOISE_SIZE {
        for y in 0..NOISE_SIZE {
            for x in 0..NOISE_SIZE {
                let mut value = 0.0;
                for (cells, gain) in [(6u32, 0.57), (13, 0.29), (27, 0.14)] {
                    let scale = cells as f32 / NOISE_SIZE as f32;
                    value += gain * periodic_noise([x, y, z].map(|v| v as f32 * scale), [cells; 3]);
                }
                // Value noise crowds around a half: spread it.
                texels.push((((value - 0.5) * 1.7 + 0.5).clamp(0.0, 1.0) * 255.0) as u8);
            }
        }
    }
    let size = wgpu::Extent3d { width: NOISE_SIZE, height: NOISE_SIZE, depth_or_array_layers: NOISE_SIZE };
    upload(device, queue, "noise", size, wgpu::TextureDimension::D3, wgpu::TextureFormat::R8Unorm, 1, &texels)
}

/// Size of the painted flame in texels.
const FLAME_SIZE: [u32; 2] = [128, 256];

/// A painted flame: streaks that rise from a dark, bluish root through yellow to an orange tip.
pub(crate) fn painted_flame(device: &wgpu::Device, queue: &wgpu::Queue) -> wgpu::TextureView {
    let [width, height] = FLAME_SIZE;
    let mut texels = Vec::with_capacity((width * height * 4) as usize);
    for row in 0..height {
        // The first row is the tip.
        let h = 1.0 - (row as f32 + 0.5) / height as f32;
        for column in 0..width {
            let u = (column as f32 + 0.5) / width as f32;
            let wander = 0.05 * (TAU * (h * 1.5)).sin();
            let streaks = periodic_noise([((u + wander) * 6.0).rem_euclid(6.0), h * 3.0, 0.0], [6, 64, 1]) * 0.6
                + periodic_noise([(u * 14.0).rem_euclid(14.0), h * 5.0, 0.0], [14, 64, 1]) * 0.4;
            texels.extend(painted_texel(h, streaks));
        }
    }
    flame_texture(device, queue, FLAME_SIZE, &texels)
}

fn painted_texel(h: f32, streaks: f32) -> [u8; 4] {
    let ramp = |from: f32, to: f32, x: f32| {
        let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    };
    let body = ramp(0.02, 0.30, h) * ramp(1.0, 0.45, h);
    let strength = body * (0.2 + 1.1 * streaks);
    let blue = 0.05 * ramp(0.25, 0.02, h);
    // Layers add up to yellow: one alone is a deep orange.
    let red = strength * 0.5;
    let green = red * (0.24 + 0.14 * ramp(0.95, 0.3, h)) * (0.7 + 0.45 * streaks);
    let base_blue = red * 0.02;
    let encode = |linear: f32| (linear.clamp(0.0, 1.0).powf(1.0 / 2.2) * 255.0) as u8;
    [encode(red + blue * 0.1), encode(green + blue * 0.3), encode(base_blue + blue), 255]
}

/// A texture for `shell` shading from sRGB texels.
pub(crate) fn flame_texture(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    size: [u32; 2],
    texels: &[u8],
) -> wgpu::TextureView {
    let extent = wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 };
    let format = wgpu::TextureFormat::Rgba8UnormSrgb;
    upload(device, queue, "flame texture", extent, wgpu::TextureDimension::D2, format, 4, texels)
}

#[expect(clippy::too_many_arguments, reason = "one private helper for both textures")]
fn upload(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    label: &str,
    size: wgpu::Extent3d,
    dimension: wgpu::TextureDimension,
    format: wgpu::TextureFormat,
    texel_bytes: u32,
    texels: &[u8],
) -> wgpu::TextureView {
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(size.width * texel_bytes),
        rows_per_image: Some(size.height),
    };
    queue.write_texture(texture.as_image_copy(), texels, layout, size);
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
