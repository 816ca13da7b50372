//! What the tests share: scenes in memory and files in a folder of their own.

#![allow(dead_code, reason = "each test file uses its own part")]

use lucerna_scene::{LoadedScene, MeshSource, Scene, SceneError, WickSource};
use std::path::{Path, PathBuf};

/// An empty folder for one test.
pub(crate) fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// The smallest scene: one point burns in the middle of a box from -1 to 1.
pub(crate) fn smallest() -> Scene {
    let text = "(
        name: \"smallest\",
        air: (origin_m: (-1.0, -1.0, -1.0), size_m: (2.0, 2.0, 2.0), cells: (8, 8, 8)),
        fires: [(wicks: [polyline(points: [(0.0, 0.0, 0.0)], radius_m: 0.01)])],
    )";
    lucerna_scene::parse(text, Path::new("smallest.ron")).unwrap()
}

/// A scene whose wick is a file of this content.
pub(crate) fn with_wick(folder: &Path, name: &str, bytes: &[u8]) -> Result<LoadedScene, SceneError> {
    std::fs::write(folder.join(name), bytes).unwrap();
    let mut scene = smallest();
    scene.fires[0].wicks = vec![WickSource::mesh(name)];
    LoadedScene::from_scene(scene, folder)
}

/// A scene with an opaque mesh of this content.
pub(crate) fn with_mesh(folder: &Path, name: &str, bytes: &[u8]) -> Result<LoadedScene, SceneError> {
    std::fs::write(folder.join(name), bytes).unwrap();
    let mut scene = smallest();
    scene.meshes = vec![MeshSource::new(name)];
    LoadedScene::from_scene(scene, folder)
}

/// The message of a failure without the folder.
pub(crate) fn message(folder: &Path, result: Result<LoadedScene, SceneError>) -> String {
    let text = result.expect_err("must fail").to_string();
    text.replace(&format!("{}/", folder.display()), "")
}

/// A glTF file with one triangle: its JSON and its bytes.
pub(crate) fn triangle_gltf(buffer: &str) -> (String, Vec<u8>) {
    let mut bytes = Vec::new();
    for x in [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0] {
        bytes.extend(x.to_le_bytes());
    }
    for c in [255_u8, 128, 0, 255].repeat(3) {
        bytes.push(c);
    }
    for index in [0_u16, 1, 2, 0] {
        bytes.extend(index.to_le_bytes());
    }
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
        "nodes":[{{"name":"Wick one","children":[1],"translation":[0.0,0.5,0.0]}},{{"mesh":0,"name":"Wick two","scale":[0.5,0.5,0.5]}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"COLOR_0":1}},"indices":2,"material":0}}]}}],
        "materials":[{{"pbrMetallicRoughness":{{"baseColorFactor":[0.5,0.5,0.5,1.0],"baseColorTexture":{{"index":0}}}},
        "emissiveFactor":[1.0,0.5,0.0],"extensions":{{"KHR_materials_emissive_strength":{{"emissiveStrength":3.0}}}}}}],
        "extensionsUsed":["KHR_materials_emissive_strength"],
        "textures":[{{"source":0}}],"images":[{{"uri":"missing.png"}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}},
        {{"bufferView":1,"componentType":5121,"normalized":true,"count":3,"type":"VEC4"}},
        {{"bufferView":2,"componentType":5123,"count":3,"type":"SCALAR"}}],
        "bufferViews":[{{"buffer":0,"byteOffset":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":12}},
        {{"buffer":0,"byteOffset":48,"byteLength":8}}],
        "buffers":[{{{buffer}"byteLength":56}}]}}"#
    );
    (json, bytes)
}

/// The same as one binary file.
pub(crate) fn triangle_glb() -> Vec<u8> {
    let (json, bytes) = triangle_gltf("");
    let mut json = json.into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut glb = b"glTF".to_vec();
    glb.extend(2_u32.to_le_bytes());
    glb.extend((28 + json.len() as u32 + bytes.len() as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", &json), (b"BIN\0", &bytes)] {
        glb.extend((chunk.len() as u32).to_le_bytes());
        glb.extend(kind);
        glb.extend(chunk);
    }
    glb
}
