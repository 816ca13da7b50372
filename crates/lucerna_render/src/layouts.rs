//! The layouts of all bind groups: what each pass may read.

use crate::data::{LightingData, View};
use std::num::NonZeroU64;
use wgpu::{
    BindGroupLayout, BindingType, Device, SamplerBindingType, ShaderStages, TextureSampleType, TextureViewDimension,
};

/// The layouts of all bind groups.
#[derive(Debug)]
pub(crate) struct Layouts {
    pub(crate) common: BindGroupLayout,
    pub(crate) lighting: BindGroupLayout,
    pub(crate) face: BindGroupLayout,
    pub(crate) peel: BindGroupLayout,
    pub(crate) shell: BindGroupLayout,
    pub(crate) texture: BindGroupLayout,
    pub(crate) volume: BindGroupLayout,
    pub(crate) blur: BindGroupLayout,
    pub(crate) compose: BindGroupLayout,
    pub(crate) evaluate: BindGroupLayout,
}

impl Layouts {
    pub(crate) fn new(device: &Device) -> Self {
        let make = |label, types: &[BindingType]| {
            layout(device, label, types, |ty| match ty {
                // Only the view is read in vertex shaders.
                BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, .. } => ShaderStages::VERTEX_FRAGMENT,
                _ => ShaderStages::FRAGMENT,
            })
        };
        let uniform = |size: usize| BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: false,
            min_binding_size: NonZeroU64::new(size as u64),
        };
        let storage = |read_only| BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only },
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let texture = |filterable, view_dimension| BindingType::Texture {
            sample_type: TextureSampleType::Float { filterable },
            view_dimension,
            multisampled: false,
        };
        let surfaces = BindingType::Texture {
            sample_type: TextureSampleType::Uint,
            view_dimension: TextureViewDimension::D2Array,
            multisampled: false,
        };
        let sampler = BindingType::Sampler(SamplerBindingType::Filtering);
        let (plain, smooth) = (texture(false, TextureViewDimension::D2), texture(true, TextureViewDimension::D2));
        Self {
            common: make("common", &[uniform(size_of::<View>()), storage(true)]),
            lighting: make(
                "lighting",
                &[
                    uniform(size_of::<LightingData>()),
                    storage(true),
                    storage(true),
                    storage(true),
                    plain,
                    BindingType::Texture {
                        sample_type: TextureSampleType::Depth,
                        view_dimension: TextureViewDimension::D2,
                        multisampled: false,
                    },
                    BindingType::Sampler(SamplerBindingType::Comparison),
                ],
            ),
            face: make(
                "face",
                &[BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Uniform,
                    has_dynamic_offset: true,
                    min_binding_size: NonZeroU64::new(size_of::<[[f32; 4]; 4]>() as u64),
                }],
            ),
            peel: make("peel", &[plain, plain]),
            shell: make("shell", &[surfaces]),
            texture: make("flame texture", &[smooth, sampler]),
            volume: make(
                "volume",
                &[
                    surfaces,
                    texture(false, TextureViewDimension::D2Array),
                    plain,
                    texture(true, TextureViewDimension::D3),
                    sampler,
                    storage(false),
                ],
            ),
            blur: make("blur", &[uniform(size_of::<crate::data::Kernel>()), plain]),
            compose: make(
                "compose",
                &[
                    uniform(size_of::<crate::data::ComposeData>()),
                    plain,
                    plain,
                    smooth,
                    smooth,
                    smooth,
                    smooth,
                    surfaces,
                    plain,
                    sampler,
                ],
            ),
            evaluate: layout(
                device,
                "evaluate",
                &[storage(true), storage(true), storage(true), storage(false)],
                |_| ShaderStages::COMPUTE,
            ),
        }
    }
}

fn layout(
    device: &Device,
    label: &str,
    types: &[BindingType],
    visibility: impl Fn(&BindingType) -> ShaderStages,
) -> BindGroupLayout {
    let entries: Vec<_> = types
        .iter()
        .enumerate()
        .map(|(binding, ty)| wgpu::BindGroupLayoutEntry {
            binding: binding as u32,
            visibility: visibility(ty),
            ty: *ty,
            count: None,
        })
        .collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries: &entries })
}
