//! Meshes and wicks from files: OBJ with MTL, glTF, GLB.

mod gltf;
mod gltf_data;
mod mtl;
mod normals;
mod obj;
mod obj_text;
mod parts;

use crate::SceneError;
use crate::assets::{self, MAX_MESH_BYTES};
use crate::model::Placement;
use glam::{Quat, Vec3};
use lucerna_frame::{MeshVertex, OpaqueMesh};
use std::borrow::Cow;
use std::path::Path;

/// Most light of a colour: what is drawn is gathered in half floats, which end at 65504.
pub(crate) const MAX_LIGHT: f32 = 6.0e4;

/// Most vertices of one file.
const MAX_VERTICES: usize = 4_000_000;

/// Most vertices of one wick.
const MAX_WICK_VERTICES: usize = lucerna_flame::MAX_WICK_POINTS;

/// Most triangles of one file.
const MAX_TRIANGLES: usize = 8_000_000;

/// A mesh as it stands in a file: one list for everything, normals still missing where the file has none.
#[derive(Debug, Default)]
struct RawMesh {
    /// Vertices; a normal of zero length is missing.
    vertices: Vec<MeshVertex>,
    /// Triangles.
    triangles: Vec<[u32; 3]>,
}

/// The vertices of one group of a file.
#[derive(Debug)]
struct WickGroup {
    name: String,
    vertices: Vec<[f32; 3]>,
    /// Pairs of vertices that a face or line connects.
    links: Vec<[u32; 2]>,
}

enum Format {
    Obj,
    Gltf,
}

/// Reads an opaque mesh; missing normals are made.
pub(crate) fn opaque_mesh(path: &Path, placement: &Placement) -> Result<OpaqueMesh, SceneError> {
    let (format, bytes) = read(path)?;
    let mut raw = match format {
        Format::Obj => obj::mesh(path, &bytes)?,
        Format::Gltf => gltf::mesh(path, &bytes)?,
    };
    drop(bytes);
    if raw.triangles.is_empty() {
        return Err(SceneError::mesh(path, None, "has no faces"));
    }
    let rotation = placement.rotation();
    for vertex in &mut raw.vertices {
        vertex.position = placed(path, vertex.position, placement, rotation)?;
        vertex.normal = (rotation * Vec3::from(vertex.normal)).into();
    }
    Ok(normals::complete(raw))
}

/// Reads the vertices of a wick, those of the group of this name, or of the one whose name starts with `wick`, or
/// all where there is no such group: as one list, or one for each part that faces connect.
pub(crate) fn wick_parts(
    path: &Path,
    group: Option<&str>,
    placement: &Placement,
    apart: bool,
) -> Result<Vec<Vec<[f32; 3]>>, SceneError> {
    let (format, bytes) = read(path)?;
    let groups = match format {
        Format::Obj => obj_text::wicks(path, &bytes, group)?,
        Format::Gltf => gltf::wicks(path, &bytes)?,
    };
    let mut chosen = choose(path, groups, group)?;
    if chosen.vertices.is_empty() {
        return Err(SceneError::mesh(path, None, "has no vertices"));
    }
    if chosen.vertices.len() > MAX_WICK_VERTICES {
        return Err(SceneError::mesh(path, None, format!("has more than {MAX_WICK_VERTICES} vertices for a wick")));
    }
    let rotation = placement.rotation();
    for vertex in &mut chosen.vertices {
        *vertex = placed(path, *vertex, placement, rotation)?;
    }
    Ok(if apart { parts::connected(chosen) } else { vec![chosen.vertices] })
}

fn choose(path: &Path, groups: Vec<WickGroup>, group: Option<&str>) -> Result<WickGroup, SceneError> {
    let mut names: Vec<&str> = groups.iter().map(|one| one.name.as_str()).filter(|name| is_wick(name)).collect();
    names.sort_unstable();
    names.dedup();
    let wanted = match (group, names.as_slice()) {
        (Some(name), _) => Some(name.to_owned()),
        (None, []) => None,
        (None, [name]) => Some((*name).to_owned()),
        (None, _) => {
            let names = names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
            return Err(SceneError::mesh(path, None, format!("has several wicks: group must be one of {names}")));
        }
    };
    let Some(wanted) = wanted else {
        return Ok(joined(groups.into_iter()));
    };
    if groups.iter().all(|one| one.name != wanted) {
        return Err(SceneError::mesh(path, None, format!("has no group named `{wanted}`")));
    }
    Ok(joined(groups.into_iter().filter(|one| one.name == wanted)))
}

fn joined(groups: impl Iterator<Item = WickGroup>) -> WickGroup {
    let mut all = WickGroup { name: String::new(), vertices: Vec::new(), links: Vec::new() };
    for group in groups {
        let first = all.vertices.len() as u32;
        all.vertices.extend(group.vertices);
        all.links.extend(group.links.into_iter().map(|pair| pair.map(|i| first + i)));
    }
    all
}

fn is_wick(name: &str) -> bool {
    name.as_bytes().get(..4).is_some_and(|start| start.eq_ignore_ascii_case(b"wick"))
}

fn placed(path: &Path, point: [f32; 3], placement: &Placement, rotation: Quat) -> Result<[f32; 3], SceneError> {
    let turned = rotation * (Vec3::from(point) * placement.scale);
    let placed = turned + Vec3::from(placement.position_m);
    if placed.is_finite() {
        return Ok(placed.into());
    }
    Err(SceneError::mesh(path, None, "has a vertex too far away to be placed"))
}

fn read(path: &Path) -> Result<(Format, Cow<'static, [u8]>), SceneError> {
    let bytes = assets::read(path, MAX_MESH_BYTES)?;
    if bytes.is_empty() {
        return Err(SceneError::mesh(path, None, "is empty"));
    }
    if bytes.starts_with(b"glTF") {
        return Ok((Format::Gltf, bytes));
    }
    let extension = path.extension().and_then(|text| text.to_str()).unwrap_or_default().to_ascii_lowercase();
    match extension.as_str() {
        "obj" => Ok((Format::Obj, bytes)),
        "gltf" | "glb" => Ok((Format::Gltf, bytes)),
        _ => Err(SceneError::mesh(path, None, "is not a mesh file: must be .obj, .gltf or .glb")),
    }
}

/// Whether the file is within the limits of this crate.
fn check_size(path: &Path, vertices: usize, triangles: usize) -> Result<(), SceneError> {
    if vertices > MAX_VERTICES {
        return Err(SceneError::mesh(path, None, format!("has more than {MAX_VERTICES} vertices")));
    }
    if triangles > MAX_TRIANGLES {
        return Err(SceneError::mesh(path, None, format!("has more than {MAX_TRIANGLES} triangles")));
    }
    Ok(())
}
