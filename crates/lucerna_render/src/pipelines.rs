//! All pipelines, made once.

use crate::layouts::Layouts;
use lucerna_shaders as wgsl;
use wgpu::{
    BindGroupLayout, ColorTargetState, CompareFunction, DepthStencilState, Device, PrimitiveTopology, RenderPipeline,
    TextureFormat, VertexBufferLayout, VertexStepMode,
};

/// Scene-referred colour.
pub(crate) const HDR: TextureFormat = TextureFormat::Rgba16Float;
/// Depth of the scene and of the layers: bit-exact between passes.
pub(crate) const DEPTH: TextureFormat = TextureFormat::Depth32Float;
/// What a layer remembers of its surface (see `surface.wgsl`).
pub(crate) const LAYER: TextureFormat = TextureFormat::Rg32Uint;
/// Number of surfaces behind a pixel; counts to 2048 are exact.
pub(crate) const COUNT: TextureFormat = TextureFormat::R16Float;

/// Composition, specialised by what it has to read.
#[derive(Debug)]
pub(crate) struct ComposePipelines {
    /// Where no glow reaches.
    pub(crate) scene: RenderPipeline,
    /// By number of blurred copies; onto a fresh target and over what is there; sharpest copy reduced and full.
    pub(crate) levels: [[[RenderPipeline; 2]; 2]; 4],
}

/// All pipelines.
#[derive(Debug)]
pub(crate) struct Pipelines {
    pub(crate) layouts: Layouts,
    /// The opaque scene with one and with four samples, without and with shadows.
    pub(crate) opaque: [[RenderPipeline; 2]; 2],
    /// What a light sees.
    pub(crate) shadow: RenderPipeline,
    /// The depth of the opaque scene with one and with four samples.
    pub(crate) depth: [RenderPipeline; 2],
    pub(crate) peel_first: RenderPipeline,
    pub(crate) peel_next: RenderPipeline,
    pub(crate) count: RenderPipeline,
    pub(crate) shell: RenderPipeline,
    pub(crate) unsorted: RenderPipeline,
    pub(crate) volume: RenderPipeline,
    pub(crate) blur: RenderPipeline,
    pub(crate) shrink: RenderPipeline,
    pub(crate) compose: ComposePipelines,
    /// One intermediate target.
    pub(crate) debug: RenderPipeline,
    pub(crate) lines: RenderPipeline,
    /// Vertices from control nets.
    pub(crate) evaluate: wgpu::ComputePipeline,
}

const MESH_ATTRIBUTES: [wgpu::VertexAttribute; 5] =
    wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x3, 3 => Float32x3, 4 => Float32];
const FLAME_ATTRIBUTES: [wgpu::VertexAttribute; 6] = wgpu::vertex_attr_array![
    0 => Float32x3, 1 => Float32, 2 => Float32x3, 3 => Float32, 4 => Float32x2, 5 => Uint32
];
const LINE_ATTRIBUTES: [wgpu::VertexAttribute; 2] = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3];

/// What differs between the pipelines.
struct Recipe<'a> {
    label: &'a str,
    source: &'a wgpu::ShaderModule,
    groups: &'a [Option<&'a BindGroupLayout>],
    vertex: (&'a str, Option<VertexBufferLayout<'a>>),
    fragment: Option<(&'a str, ColorTargetState)>,
    /// What passes the test of the depth, which is then written.
    depth: Option<CompareFunction>,
    topology: PrimitiveTopology,
    samples: u32,
    compilation: wgpu::PipelineCompilationOptions<'a>,
}

impl Recipe<'_> {
    fn make(self, device: &Device) -> RenderPipeline {
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(self.label),
            bind_group_layouts: self.groups,
            immediate_size: 0,
        });
        let buffers: Vec<_> = self.vertex.1.into_iter().map(Some).collect();
        let targets: Vec<_> = self.fragment.iter().map(|(_, target)| Some(target.clone())).collect();
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(self.label),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: self.source,
                entry_point: Some(self.vertex.0),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &buffers,
            },
            primitive: wgpu::PrimitiveState { topology: self.topology, ..Default::default() },
            depth_stencil: self.depth.map(|compare| DepthStencilState {
                format: DEPTH,
                depth_write_enabled: Some(true),
                depth_compare: Some(compare),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState { count: self.samples, ..Default::default() },
            fragment: self.fragment.as_ref().map(|(entry, _)| wgpu::FragmentState {
                module: self.source,
                entry_point: Some(entry),
                compilation_options: self.compilation.clone(),
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}

#[expect(clippy::too_many_arguments, reason = "the fields of a recipe, in order")]
fn triangles<'a>(
    device: &Device,
    label: &'a str,
    source: &'a wgpu::ShaderModule,
    groups: &'a [Option<&'a BindGroupLayout>],
    vertex: (&'a str, Option<VertexBufferLayout<'a>>),
    fragment: Option<(&'a str, ColorTargetState)>,
    depth: bool,
    samples: u32,
) -> RenderPipeline {
    let topology = PrimitiveTopology::TriangleList;
    let compilation = wgpu::PipelineCompilationOptions::default();
    let depth = depth.then_some(CompareFunction::Less);
    Recipe { label, source, groups, vertex, fragment, depth, topology, samples, compilation }.make(device)
}

/// A pass over every pixel.
fn full(
    device: &Device,
    label: &str,
    source: &wgpu::ShaderModule,
    groups: &[Option<&BindGroupLayout>],
    entry: &str,
    target: ColorTargetState,
) -> RenderPipeline {
    full_with(device, label, source, groups, entry, target, wgpu::PipelineCompilationOptions::default())
}

/// A pass over every pixel with its constants chosen.
fn full_with(
    device: &Device,
    label: &str,
    source: &wgpu::ShaderModule,
    groups: &[Option<&BindGroupLayout>],
    entry: &str,
    target: ColorTargetState,
    compilation: wgpu::PipelineCompilationOptions<'_>,
) -> RenderPipeline {
    let (vertex, fragment) = (("vs_fullscreen", None), Some((entry, target)));
    let topology = PrimitiveTopology::TriangleList;
    Recipe { label, source, groups, vertex, fragment, depth: None, topology, samples: 1, compilation }.make(device)
}

const ADD: wgpu::BlendComponent = wgpu::BlendComponent {
    src_factor: wgpu::BlendFactor::One,
    dst_factor: wgpu::BlendFactor::One,
    operation: wgpu::BlendOperation::Add,
};
const OVER: wgpu::BlendComponent = wgpu::BlendComponent {
    src_factor: wgpu::BlendFactor::One,
    dst_factor: wgpu::BlendFactor::OneMinusSrcAlpha,
    operation: wgpu::BlendOperation::Add,
};

impl Pipelines {
    pub(crate) fn new(device: &Device, target: TextureFormat) -> Self {
        let layouts = Layouts::new(device);
        let module = |label, source: &str| {
            device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(label),
                source: wgpu::ShaderSource::Wgsl(source.into()),
            })
        };
        let (common, peel) = (Some(&layouts.common), Some(&layouts.peel));
        let blended = |format, component| ColorTargetState {
            format,
            blend: Some(wgpu::BlendState { color: component, alpha: component }),
            write_mask: wgpu::ColorWrites::ALL,
        };
        let vertices = |stride: usize, attributes| VertexBufferLayout {
            array_stride: stride as u64,
            step_mode: VertexStepMode::Vertex,
            attributes,
        };
        let meshes = || vertices(size_of::<lucerna_frame::MeshVertex>(), &MESH_ATTRIBUTES);
        let flames = || vertices(size_of::<lucerna_frame::FlameVertex>(), &FLAME_ATTRIBUTES);

        let source = module("opaque", wgsl::OPAQUE);
        let opaque = [1, 4].map(|samples| {
            [0.0, 1.0].map(|shadows| {
                let constants = [("SHADOWS", shadows)];
                Recipe {
                    label: "opaque",
                    source: &source,
                    groups: &[common, Some(&layouts.lighting)],
                    vertex: ("vs_opaque", Some(meshes())),
                    fragment: Some(("fs_opaque", HDR.into())),
                    // What is seen may be known already.
                    depth: Some(CompareFunction::LessEqual),
                    topology: PrimitiveTopology::TriangleList,
                    samples,
                    compilation: wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() },
                }
                .make(device)
            })
        });
        let shadow = Recipe {
            label: "shadow map",
            source: &module("shadow map", wgsl::SHADOW_MAP),
            groups: &[Some(&layouts.face)],
            vertex: ("vs_shadow", Some(meshes())),
            fragment: None,
            depth: Some(CompareFunction::Greater),
            topology: PrimitiveTopology::TriangleList,
            samples: 1,
            compilation: wgpu::PipelineCompilationOptions::default(),
        }
        .make(device);
        let depth = [1, 4].map(|samples| {
            triangles(device, "depth", &source, &[common], ("vs_depth", Some(meshes())), None, true, samples)
        });

        let source = module("peel", wgsl::PEEL);
        let surface = |label, entry, target: ColorTargetState, depth| {
            let vertex = ("vs_flame", Some(flames()));
            triangles(device, label, &source, &[common, peel], vertex, Some((entry, target)), depth, 1)
        };
        let peel_first = surface("peel first", "fs_first", LAYER.into(), true);
        let peel_next = surface("peel next", "fs_next", LAYER.into(), true);
        let count = surface("count", "fs_count", blended(COUNT, ADD), false);

        let texture = Some(&layouts.texture);
        let source = module("shell", wgsl::SHELL);
        let shell = full(device, "shell", &source, &[common, Some(&layouts.shell), texture], "fs_shell", HDR.into());
        let source = module("unsorted", wgsl::UNSORTED);
        let (vertex, fragment) = (("vs_flame", Some(flames())), Some(("fs_unsorted", blended(HDR, ADD))));
        let unsorted = triangles(device, "unsorted", &source, &[common, peel, texture], vertex, fragment, false, 1);
        let source = module("volume", wgsl::VOLUME);
        let volume = full(device, "volume", &source, &[common, Some(&layouts.volume)], "fs_volume", HDR.into());

        let source = module("blur", wgsl::BLUR);
        let blur = full(device, "blur", &source, &[Some(&layouts.blur)], "fs_blur", HDR.into());
        let shrink = full(device, "shrink", &source, &[Some(&layouts.blur)], "fs_shrink", HDR.into());
        let source = module("compose", wgsl::COMPOSE);
        let groups = [common, Some(&layouts.compose)];
        let make = |entry, target: ColorTargetState, levels, full: bool| {
            let constants = [("GLOW_LEVELS", f64::from(levels)), ("SHARPEST_IS_FULL", f64::from(u8::from(full)))];
            let compilation = wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
            full_with(device, "compose", &source, &groups, entry, target, compilation)
        };
        let compose = ComposePipelines {
            scene: make("fs_compose", target.into(), 0, true),
            levels: [1, 2, 3, 4].map(|levels| {
                [("fs_compose", target.into()), ("fs_over", blended(target, OVER))].map(
                    |(entry, target): (_, ColorTargetState)| {
                        [false, true].map(|full| make(entry, target.clone(), levels, full))
                    },
                )
            }),
        };
        let debug = full(device, "debug view", &source, &groups, "fs_debug", target.into());
        let source = module("lines", wgsl::LINES);
        let lines = Recipe {
            label: "lines",
            source: &source,
            groups: &[common],
            vertex: ("vs_line", Some(vertices(size_of::<lucerna_frame::LineVertex>(), &LINE_ATTRIBUTES))),
            fragment: Some(("fs_line", target.into())),
            depth: None,
            topology: PrimitiveTopology::LineList,
            samples: 1,
            compilation: wgpu::PipelineCompilationOptions::default(),
        }
        .make(device);
        let source = module("evaluate", wgsl::EVALUATE);
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("evaluate"),
            bind_group_layouts: &[Some(&layouts.evaluate)],
            immediate_size: 0,
        });
        let evaluate = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("evaluate"),
            layout: Some(&layout),
            module: &source,
            entry_point: Some("cs_evaluate"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        Self {
            layouts,
            opaque,
            shadow,
            depth,
            peel_first,
            peel_next,
            count,
            shell,
            unsorted,
            volume,
            blur,
            shrink,
            compose,
            debug,
            lines,
            evaluate,
        }
    }
}
