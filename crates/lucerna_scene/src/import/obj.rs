//! Opaque meshes from OBJ files with their materials.

use super::{MAX_LIGHT, RawMesh, check_size, mtl, obj_text};
use crate::SceneError;
use lucerna_frame::MeshVertex;
use std::cell::RefCell;
use std::path::Path;
use tobj::{LoadError, LoadOptions, Material, Mesh};

/// Base colour where a file names none.
const GREY: [f32; 3] = [0.5; 3];

const OPTIONS: LoadOptions =
    LoadOptions { single_index: true, triangulate: true, ignore_points: true, ignore_lines: true };

/// Reads the triangles of all groups.
pub(super) fn mesh(path: &Path, bytes: &[u8]) -> Result<RawMesh, SceneError> {
    let obj = obj_text::scan(path, bytes, None)?;
    let fault = RefCell::new(None);
    let library = |name: &Path| {
        mtl::library(path, &name.to_string_lossy()).unwrap_or_else(|error| {
            fault.borrow_mut().get_or_insert(error);
            Err(LoadError::MaterialParseError)
        })
    };
    let loaded = tobj::load_obj_buf(&mut obj.text.as_bytes(), &OPTIONS, library);
    if let Some(error) = fault.take() {
        return Err(error);
    }
    let (models, materials) = loaded.map_err(|error| SceneError::mesh(path, None, error.to_string()))?;
    // Every fault of a library is reported above; a library that is missing is not one.
    let materials = materials.unwrap_or_default();
    let mut raw = RawMesh::default();
    for model in &models {
        let material = model.mesh.material_id.and_then(|id| materials.get(id));
        append(&mut raw, &model.mesh, material);
        check_size(path, raw.vertices.len(), raw.triangles.len())?;
    }
    Ok(raw)
}

/// The mean of the transmission filter `Tf`, which `tobj` hands over as text.
fn translucency(material: &Material) -> f32 {
    let filter = material.unknown_param.get("Tf").map_or("", String::as_str);
    let numbers: Vec<f32> = filter.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    if numbers.is_empty() { 0.0 } else { (numbers.iter().sum::<f32>() / numbers.len() as f32).clamp(0.0, 1.0) }
}

/// Vertex colours multiply what the material reflects and what it emits.
fn append(raw: &mut RawMesh, mesh: &Mesh, material: Option<&Material>) {
    let first = raw.vertices.len() as u32;
    let diffuse = material.map_or(GREY, |material| material.diffuse.unwrap_or(GREY));
    let emissive = material.and_then(|material| material.emissive).unwrap_or_default();
    let translucency = material.map_or(0.0, translucency);
    let positions = mesh.positions.as_chunks::<3>().0;
    let colours = mesh.vertex_color.as_chunks::<3>().0;
    // Where only some faces have normals, there is no telling which vertex owns which.
    let normals = mesh.normals.as_chunks::<3>().0;
    let normals = if normals.len() == positions.len() { normals } else { &[] };
    for (index, &position) in positions.iter().enumerate() {
        let tint = colours.get(index).copied().unwrap_or([1.0; 3]);
        raw.vertices.push(MeshVertex {
            position,
            normal: normals.get(index).copied().unwrap_or_default(),
            color: std::array::from_fn(|c| (diffuse[c] * tint[c]).clamp(0.0, 1.0)),
            emission: std::array::from_fn(|c| (emissive[c] * tint[c]).clamp(0.0, MAX_LIGHT)),
            translucency,
        });
    }
    raw.triangles.extend(mesh.indices.as_chunks::<3>().0.iter().map(|corners| corners.map(|corner| first + corner)));
}
