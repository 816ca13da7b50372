//! Every shader translates to every back end, with core features only. No GPU is needed.

use naga::back::pipeline_constants::process_overrides;
use naga::back::{PipelineConstants, glsl, hlsl, msl, spv};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{Module, ShaderStage};

fn parse(name: &str, source: &str) -> (Module, ModuleInfo) {
    let module =
        naga::front::wgsl::parse_str(source).unwrap_or_else(|e| panic!("{}", e.emit_to_string_with_path(source, name)));
    let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .unwrap_or_else(|e| panic!("{}", e.emit_to_string_with_path(source, name)));
    // Constants that pipelines choose keep their defaults here.
    let constants = PipelineConstants::default();
    let (module, info) = process_overrides(&module, &info, None, &constants).unwrap_or_else(|e| panic!("{name}: {e}"));
    (module.into_owned(), info.into_owned())
}

#[test]
fn spir_v() {
    for (name, source) in lucerna_shaders::ALL {
        let (module, info) = parse(name, source);
        spv::write_vec(&module, &info, &spv::Options::default(), None).unwrap_or_else(|e| panic!("{name}: {e}"));
    }
}

#[test]
fn hlsl() {
    for (name, source) in lucerna_shaders::ALL {
        let (module, info) = parse(name, source);
        let (options, pipeline) = (hlsl::Options::default(), hlsl::PipelineOptions::default());
        let mut text = String::new();
        hlsl::Writer::new(&mut text, &options, &pipeline)
            .write(&module, &info, None)
            .unwrap_or_else(|e| panic!("{name}: {e}"));
    }
}

#[test]
fn msl() {
    for (name, source) in lucerna_shaders::ALL {
        let (module, info) = parse(name, source);
        let options = msl::Options { lang_version: (2, 1), fake_missing_bindings: true, ..Default::default() };
        msl::write_string(&module, &info, &options, &msl::PipelineOptions::default())
            .unwrap_or_else(|e| panic!("{name}: {e}"));
    }
}

#[test]
fn glsl_es() {
    for (name, source) in lucerna_shaders::ALL {
        let (module, info) = parse(name, source);
        for entry in &module.entry_points {
            let options = glsl::Options {
                version: glsl::Version::Embedded { version: 310, is_webgl: false },
                ..Default::default()
            };
            let pipeline =
                glsl::PipelineOptions { shader_stage: entry.stage, entry_point: entry.name.clone(), multiview: None };
            let mut text = String::new();
            glsl::Writer::new(
                &mut text,
                &module,
                &info,
                &options,
                &pipeline,
                naga::proc::BoundsCheckPolicies::default(),
            )
            .and_then(|mut writer| writer.write())
            .unwrap_or_else(|e| panic!("{name}/{}: {e}", entry.name));
            assert!(matches!(entry.stage, ShaderStage::Vertex | ShaderStage::Fragment | ShaderStage::Compute));
        }
    }
}
