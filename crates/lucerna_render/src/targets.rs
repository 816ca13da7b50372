//! Every texture that depends on the picture's size, and the bind groups over them, in one owner.

use crate::data::{Kernel, MAX_GLOW};
use crate::layouts::Layouts;
use crate::pipelines::{COUNT, DEPTH, HDR, LAYER};
use lucerna_frame::Look;
use wgpu::{BindGroup, BindingResource, Device, TextureFormat, TextureUsages, TextureView, TextureViewDimension};

/// What decides whether the targets must be made anew.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Shape {
    pub(crate) size: [u32; 2],
    pub(crate) layers: u32,
    pub(crate) samples: u32,
    /// Divisor of each blurred copy.
    pub(crate) glow: Vec<u32>,
}

impl Shape {
    pub(crate) fn of(size: [u32; 2], look: &Look) -> Self {
        Self {
            size,
            layers: look.layers,
            samples: look.samples,
            glow: look.glow.iter().map(|level| level.divisor).collect(),
        }
    }

    /// True if this is the shape of a look, found out without allocating.
    pub(crate) fn fits(&self, size: [u32; 2], look: &Look) -> bool {
        self.size == size
            && self.layers == look.layers
            && self.samples == look.samples
            && self.glow.iter().copied().eq(look.glow.iter().map(|level| level.divisor))
    }

    pub(crate) fn reduced(&self, divisor: u32) -> [u32; 2] {
        self.size.map(|side| side.div_ceil(divisor))
    }
}

/// One blurred copy: its two passes.
#[derive(Debug)]
pub(crate) struct GlowTarget {
    pub(crate) divisor: u32,
    pub(crate) kernels: [wgpu::Buffer; 2],
    pub(crate) across: TextureView,
    pub(crate) done: TextureView,
    pub(crate) groups: [BindGroup; 2],
}

/// A reduced copy of the flames that blurs start from.
#[derive(Debug)]
pub(crate) struct Reduced {
    pub(crate) divisor: u32,
    pub(crate) view: TextureView,
    pub(crate) group: BindGroup,
}

/// The textures.
#[derive(Debug)]
pub(crate) struct Targets {
    pub(crate) shape: Shape,
    pub(crate) opaque: TextureView,
    /// Colour and depth with several samples, if asked for.
    pub(crate) multisampled: Option<(TextureView, TextureView)>,
    pub(crate) scene_depth: TextureView,
    pub(crate) layer_depths: Vec<TextureView>,
    pub(crate) layer_surfaces: Vec<TextureView>,
    pub(crate) flame_texture: wgpu::Texture,
    pub(crate) flames: TextureView,
    pub(crate) count_texture: wgpu::Texture,
    pub(crate) count: TextureView,
    pub(crate) reduced: Vec<Reduced>,
    pub(crate) glow: Vec<GlowTarget>,
    /// For each layer: the scene's depth and the layer before.
    pub(crate) peel_groups: Vec<BindGroup>,
    pub(crate) shell_group: BindGroup,
    pub(crate) volume_group: BindGroup,
    pub(crate) compose_group: BindGroup,
}

/// What the targets' bind groups need from elsewhere.
pub(crate) struct Shared<'a> {
    pub(crate) layouts: &'a Layouts,
    pub(crate) noise: &'a TextureView,
    pub(crate) repeat: &'a wgpu::Sampler,
    pub(crate) clamp: &'a wgpu::Sampler,
    pub(crate) open_intervals: &'a wgpu::Buffer,
    pub(crate) compose: &'a wgpu::Buffer,
    /// The caller's depth, where there is one.
    pub(crate) scene_depth: Option<&'a TextureView>,
}

pub(crate) fn group(
    device: &Device,
    label: &str,
    layout: &wgpu::BindGroupLayout,
    resources: &[BindingResource<'_>],
) -> BindGroup {
    let entries: Vec<_> = resources
        .iter()
        .enumerate()
        .map(|(binding, resource)| wgpu::BindGroupEntry { binding: binding as u32, resource: resource.clone() })
        .collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some(label), layout, entries: &entries })
}

fn texture(
    device: &Device,
    label: &str,
    size: [u32; 2],
    layers: u32,
    samples: u32,
    format: TextureFormat,
) -> wgpu::Texture {
    let read =
        if samples == 1 { TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_SRC } else { TextureUsages::empty() };
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: layers },
        mip_level_count: 1,
        sample_count: samples,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: TextureUsages::RENDER_ATTACHMENT | read,
        view_formats: &[],
    })
}

fn whole(texture: &wgpu::Texture) -> TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// A view of all layers, and one of each.
fn layered(texture: &wgpu::Texture, layers: u32) -> (TextureView, Vec<TextureView>) {
    let all = texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(TextureViewDimension::D2Array),
        ..Default::default()
    });
    let each = (0..layers)
        .map(|layer| {
            texture.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(TextureViewDimension::D2),
                base_array_layer: layer,
                array_layer_count: Some(1),
                ..Default::default()
            })
        })
        .collect();
    (all, each)
}

impl Targets {
    pub(crate) fn new(device: &Device, shape: Shape, shared: &Shared<'_>) -> Self {
        use BindingResource::{Sampler, TextureView as View};
        let (size, layouts) = (shape.size, shared.layouts);
        let plain = |label, format| texture(device, label, size, 1, 1, format);
        let opaque = whole(&plain("opaque", HDR));
        let multisampled = (shape.samples > 1).then(|| {
            let make = |label, format| whole(&texture(device, label, size, 1, shape.samples, format));
            (make("opaque samples", HDR), make("depth samples", DEPTH))
        });
        let scene_depth = shared.scene_depth.cloned().unwrap_or_else(|| whole(&plain("scene depth", DEPTH)));
        let (depths, layer_depths) =
            layered(&texture(device, "layer depths", size, shape.layers, 1, DEPTH), shape.layers);
        let (surfaces, layer_surfaces) =
            layered(&texture(device, "layer surfaces", size, shape.layers, 1, LAYER), shape.layers);
        let flame_texture = plain("flames", HDR);
        let flames = whole(&flame_texture);
        let count_texture = plain("count", COUNT);
        let count = whole(&count_texture);

        let deepest = shape.glow.iter().copied().max().unwrap_or(1);
        let mut reduced: Vec<Reduced> = Vec::new();
        for divisor in [4, 16].into_iter().filter(|divisor| *divisor <= deepest) {
            let source = reduced.last().map_or(&flames, |r| &r.view);
            let unused = kernel_buffer(device);
            let resources = [unused.as_entire_binding(), View(source)];
            let group = group(device, "shrink", &layouts.blur, &resources);
            let view = whole(&texture(device, "reduced flames", shape.reduced(divisor), 1, 1, HDR));
            reduced.push(Reduced { divisor, view, group });
        }
        let glow: Vec<_> = shape
            .glow
            .iter()
            .map(|&divisor| {
                let source = reduced.iter().find(|r| r.divisor == divisor).map_or(&flames, |r| &r.view);
                let make = || whole(&texture(device, "glow", shape.reduced(divisor), 1, 1, HDR));
                let (across, done) = (make(), make());
                let kernels = [kernel_buffer(device), kernel_buffer(device)];
                let groups = [(&kernels[0], source), (&kernels[1], &across)].map(|(kernel, source)| {
                    group(device, "blur", &layouts.blur, &[kernel.as_entire_binding(), View(source)])
                });
                GlowTarget { divisor, kernels, across, done, groups }
            })
            .collect();

        let peel_groups = (0..shape.layers as usize)
            .map(|layer| {
                let previous = if layer == 0 { &scene_depth } else { &layer_depths[layer - 1] };
                group(device, "peel", &layouts.peel, &[View(&scene_depth), View(previous)])
            })
            .collect();
        let shell_group = group(device, "shell", &layouts.shell, &[View(&surfaces)]);
        let volume_group = group(
            device,
            "volume",
            &layouts.volume,
            &[
                View(&surfaces),
                View(&depths),
                View(&scene_depth),
                View(shared.noise),
                Sampler(shared.repeat),
                shared.open_intervals.as_entire_binding(),
            ],
        );
        // Without any blur the flames themselves are shown.
        let shown = |index: usize| glow.get(index).map_or(&flames, |level| &level.done);
        let mut resources = vec![shared.compose.as_entire_binding(), View(&opaque), View(&flames)];
        resources.extend((0..MAX_GLOW).map(|index| View(shown(index))));
        resources.extend([View(&surfaces), View(&count), Sampler(shared.clamp)]);
        let compose_group = group(device, "compose", &layouts.compose, &resources);
        Self {
            opaque,
            multisampled,
            scene_depth,
            layer_depths,
            layer_surfaces,
            flame_texture,
            flames,
            count_texture,
            count,
            reduced,
            peel_groups,
            shell_group,
            volume_group,
            compose_group,
            glow,
            shape,
        }
    }
}

fn kernel_buffer(device: &Device) -> wgpu::Buffer {
    device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("blur kernel"),
        size: size_of::<Kernel>() as u64,
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}
