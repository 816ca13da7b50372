//! Buffers that grow: the GPU sees a new one only when more is needed than ever before.

/// A buffer rewritten every frame.
#[derive(Debug)]
pub(crate) struct GrowBuffer {
    pub(crate) buffer: wgpu::Buffer,
    label: &'static str,
    usage: wgpu::BufferUsages,
}

impl GrowBuffer {
    pub(crate) fn new(device: &wgpu::Device, label: &'static str, usage: wgpu::BufferUsages, bytes: u64) -> Self {
        let usage = usage | wgpu::BufferUsages::COPY_DST;
        Self { buffer: create(device, label, usage, bytes), label, usage }
    }

    /// Makes room for so many bytes; true if the buffer is a new one, which bind groups must take up.
    pub(crate) fn reserve(&mut self, device: &wgpu::Device, needed: u64) -> bool {
        let grows = needed > self.buffer.size();
        if grows {
            // Half as much again where the device allows, so that a slowly growing fire settles.
            let limits = device.limits();
            let is_bound = self.usage.contains(wgpu::BufferUsages::STORAGE);
            let most = if is_bound { limits.max_storage_buffer_binding_size } else { limits.max_buffer_size };
            self.buffer = create(device, self.label, self.usage, (needed * 3 / 2).min(most).max(needed));
        }
        grows
    }

    /// Writes `bytes` to the front; true if the buffer is a new one, which bind groups must take up.
    pub(crate) fn write(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, bytes: &[u8]) -> bool {
        let grows = self.reserve(device, bytes.len() as u64);
        if !bytes.is_empty() {
            queue.write_buffer(&self.buffer, 0, bytes);
        }
        grows
    }
}

fn create(device: &wgpu::Device, label: &str, usage: wgpu::BufferUsages, bytes: u64) -> wgpu::Buffer {
    let size = bytes.max(256).next_multiple_of(wgpu::COPY_BUFFER_ALIGNMENT);
    device.create_buffer(&wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false })
}
