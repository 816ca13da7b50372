//! The graphics device, and a target whose pixels can be read back.

use anyhow::{Context, Result, anyhow, bail};
use std::sync::{Arc, Mutex, PoisonError, mpsc};
use std::time::Duration;

/// Longest wait for the device before a run gives up.
const PATIENCE: Duration = Duration::from_secs(300);

/// The format that fire is drawn into.
pub const TARGET_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;

/// What is asked of a device: no optional feature and the limits that every device offers.
#[must_use]
pub fn device_descriptor() -> wgpu::DeviceDescriptor<'static> {
    wgpu::DeviceDescriptor {
        label: Some("lucerna"),
        required_features: wgpu::Features::empty(),
        required_limits: wgpu::Limits::default(),
        ..Default::default()
    }
}

/// A device, its queue and the errors that it reported.
#[derive(Clone, Debug)]
pub struct Gpu {
    /// The device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// The adapter's name, driver and backend in words.
    pub adapter: String,
    first_error: Arc<Mutex<Option<String>>>,
}

impl Gpu {
    /// Opens the best adapter without a window.
    pub fn open() -> Result<Self> {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = wgpu::Backends::PRIMARY;
        let instance = wgpu::Instance::new(descriptor);
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            ..Default::default()
        };
        let adapter = pollster::block_on(instance.request_adapter(&options)).map_err(|_| {
            anyhow!(
                "no graphics adapter was found: install a Vulkan driver \
                 (a software one on Debian and Ubuntu: apt install mesa-vulkan-drivers)"
            )
        })?;
        let (device, queue) = pollster::block_on(adapter.request_device(&device_descriptor()))
            .with_context(|| format!("{} gave no device", adapter.get_info().name))?;
        Ok(Self::from_parts(device, queue, &adapter.get_info()))
    }

    /// Takes over a device that somebody else opened; errors are kept for [`Gpu::check`] from now on.
    #[must_use]
    pub fn from_parts(device: wgpu::Device, queue: wgpu::Queue, info: &wgpu::AdapterInfo) -> Self {
        let first_error = Arc::new(Mutex::new(None));
        let keep = Arc::clone(&first_error);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            keep.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert_with(|| error.to_string());
        }));
        let driver = if info.driver_info.is_empty() { &info.driver } else { &info.driver_info };
        let adapter = format!("{} ({driver}, {:?})", info.name, info.backend);
        Self { device, queue, adapter, first_error }
    }

    /// Fails with the first error that the device reported since the last call.
    pub fn check(&self) -> Result<()> {
        match self.first_error.lock().unwrap_or_else(PoisonError::into_inner).take() {
            Some(error) => bail!("the graphics device reports: {error}"),
            None => Ok(()),
        }
    }

    /// Waits until all submitted work is done.
    pub fn wait(&self) -> Result<()> {
        let poll = wgpu::PollType::Wait { submission_index: None, timeout: Some(PATIENCE) };
        let waited = self.device.poll(poll);
        self.check()?;
        waited.map(|_| ()).map_err(|error| anyhow!("waiting for the graphics device failed: {error}"))
    }

    /// Submits what an encoder recorded.
    pub fn submit(&self, encoder: wgpu::CommandEncoder) {
        self.queue.submit([encoder.finish()]);
    }

    /// A new encoder.
    #[must_use]
    pub fn encoder(&self) -> wgpu::CommandEncoder {
        self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("lucerna") })
    }
}

/// A colour target of a fixed size and the buffer that its pixels are read back through.
#[derive(Debug)]
pub struct Target {
    /// The view that fire is drawn into.
    pub view: wgpu::TextureView,
    texture: wgpu::Texture,
    buffer: wgpu::Buffer,
    size_px: [u32; 2],
}

impl Target {
    /// Makes a target for pictures ([`TARGET_FORMAT`]).
    pub fn new(gpu: &Gpu, size_px: [u32; 2]) -> Result<Self> {
        Self::with_format(gpu, size_px, TARGET_FORMAT)
    }

    /// Makes a target of another uncompressed format.
    pub fn with_format(gpu: &Gpu, size_px: [u32; 2], format: wgpu::TextureFormat) -> Result<Self> {
        let most = gpu.device.limits().max_texture_dimension_2d;
        let [width, height] = size_px;
        if width.max(height) > most {
            bail!("this device draws pictures of at most {most}x{most} pixels, not {width}x{height}");
        }
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("target"),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                | wgpu::TextureUsages::COPY_SRC
                | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[format.remove_srgb_suffix()],
        });
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("read-back"),
            size: u64::from(row_bytes(width, format)) * u64::from(height),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        gpu.check()?;
        Ok(Self { view: texture.create_view(&wgpu::TextureViewDescriptor::default()), texture, buffer, size_px })
    }

    /// Width and height.
    #[must_use]
    pub fn size_px(&self) -> [u32; 2] {
        self.size_px
    }

    /// A view whose samples are display-referred numbers, as egui wants them.
    #[must_use]
    pub fn display_view(&self) -> wgpu::TextureView {
        self.texture.create_view(&wgpu::TextureViewDescriptor {
            format: Some(self.texture.format().remove_srgb_suffix()),
            usage: Some(wgpu::TextureUsages::TEXTURE_BINDING),
            ..Default::default()
        })
    }

    /// Copies the pixels to the processor: rows of red, green, blue, from the top, into `rgb`.
    pub fn read(&self, gpu: &Gpu, rgb: &mut Vec<u8>) -> Result<()> {
        rgb.clear();
        self.read_rows(gpu, |row| {
            let (pixels, _) = row.as_chunks::<4>();
            rgb.extend(pixels.iter().flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]));
        })
    }

    /// Hands the bytes of each row of pixels to `look`, from the top.
    pub fn read_rows(&self, gpu: &Gpu, look: impl FnMut(&[u8])) -> Result<()> {
        let [width, _] = self.size_px;
        let format = self.texture.format();
        let stride = row_bytes(width, format);
        let mut encoder = gpu.encoder();
        encoder.copy_texture_to_buffer(
            self.texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &self.buffer,
                layout: wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(stride), rows_per_image: None },
            },
            self.texture.size(),
        );
        gpu.submit(encoder);
        let (sender, receiver) = mpsc::channel();
        self.buffer.map_async(wgpu::MapMode::Read, .., move |result| {
            // Nobody listens any more only when the wait below has failed, which is reported there.
            let _ = sender.send(result);
        });
        gpu.wait()?;
        receiver.recv_timeout(PATIENCE).context("the picture never arrived")?.context("the picture cannot be read")?;
        {
            let bytes = self.buffer.get_mapped_range(..).context("the picture cannot be read")?;
            let used = (width * pixel_bytes(format)) as usize;
            bytes.chunks_exact(stride as usize).map(|row| &row[..used]).for_each(look);
        }
        self.buffer.unmap();
        Ok(())
    }
}

/// Bytes of a padded row of pixels.
fn row_bytes(width: u32, format: wgpu::TextureFormat) -> u32 {
    (width * pixel_bytes(format)).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT)
}

fn pixel_bytes(format: wgpu::TextureFormat) -> u32 {
    format.block_copy_size(None).unwrap_or(4)
}
