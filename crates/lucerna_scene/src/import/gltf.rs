//! Meshes and wicks from glTF and GLB files; images are not read.

use super::gltf_data::Buffers;
use super::{MAX_LIGHT, RawMesh, WickGroup, check_size};
use crate::SceneError;
use glam::{Mat3, Mat4, Vec3};
use gltf::mesh::Mode;
use gltf::{Document, Gltf, Node, Primitive, Semantic};
use lucerna_frame::MeshVertex;
use std::path::Path;

/// Reads the triangles of all nodes of the scene.
pub(super) fn mesh(path: &Path, bytes: &[u8]) -> Result<RawMesh, SceneError> {
    let (document, buffers) = open(path, bytes)?;
    let mut raw = RawMesh::default();
    for (node, world) in placed_nodes(&document, &buffers)? {
        for primitive in node.mesh().iter().flat_map(gltf::Mesh::primitives) {
            append(&mut raw, &primitive, world, &buffers)?;
            check_size(path, raw.vertices.len(), raw.triangles.len())?;
        }
    }
    Ok(raw)
}

/// Reads the vertices of all nodes, one group a node.
pub(super) fn wicks(path: &Path, bytes: &[u8]) -> Result<Vec<WickGroup>, SceneError> {
    let (document, buffers) = open(path, bytes)?;
    let mut groups = Vec::new();
    let mut count = 0;
    for (node, world) in placed_nodes(&document, &buffers)? {
        let Some(mesh) = node.mesh() else { continue };
        let name = node.name().or(mesh.name()).unwrap_or_default().to_owned();
        let (mut vertices, mut links) = (Vec::new(), Vec::new());
        for primitive in mesh.primitives() {
            let first = vertices.len() as u32;
            let found = positions(&primitive, world, &buffers)?;
            let indices = indices(&primitive, found.len(), &buffers)?;
            links.extend(linked(primitive.mode(), &indices).map(|pair| pair.map(|i| first + i)));
            vertices.extend(found);
            check_size(path, count + vertices.len(), links.len() / 3)?;
        }
        count += vertices.len();
        groups.push(WickGroup { name, vertices, links });
    }
    Ok(groups)
}

/// Pairs of vertices that belong together.
fn linked(mode: Mode, indices: &[u32]) -> Box<dyn Iterator<Item = [u32; 2]> + '_> {
    match mode {
        Mode::Points => Box::new(std::iter::empty()),
        Mode::Lines => Box::new(indices.as_chunks::<2>().0.iter().copied()),
        Mode::LineStrip | Mode::LineLoop => Box::new(indices.windows(2).map(|pair| [pair[0], pair[1]])),
        _ => Box::new(triangles(mode, indices).flat_map(|[a, b, c]| [[a, b], [b, c]])),
    }
}

fn open<'a>(path: &'a Path, bytes: &[u8]) -> Result<(Document, Buffers<'a>), SceneError> {
    let fault = |problem: String| SceneError::mesh(path, None, format!("is not a glTF file: {problem}"));
    let gltf = Gltf::from_slice_without_validation(bytes).map_err(|error| fault(error.to_string()))?;
    let json = gltf.document.into_json();
    // The crate's own validation looks accessors up before it checks their indices.
    let accessors = json.accessors.len();
    let used = json.meshes.iter().flat_map(|mesh| &mesh.primitives).flat_map(|one| one.attributes.values());
    if let Some(index) = used.map(gltf::json::Index::value).find(|&index| index >= accessors) {
        return Err(fault(format!("accessor {index} does not exist: there are {accessors}")));
    }
    let document = Document::from_json(json).map_err(|error| fault(error.to_string()))?;
    let buffers = Buffers::read(path, &document, gltf.blob)?;
    Ok((document, buffers))
}

/// The nodes of the scene with their transforms to world space. Nodes form trees: one that is met twice is a
/// fault.
fn placed_nodes<'a>(document: &'a Document, buffers: &Buffers<'_>) -> Result<Vec<(Node<'a>, Mat4)>, SceneError> {
    let scene = document.default_scene().or_else(|| document.scenes().next());
    let mut waiting: Vec<(Node<'a>, Mat4)> = match scene {
        Some(scene) => scene.nodes().map(|node| (node, Mat4::IDENTITY)).collect(),
        None => roots(document).into_iter().map(|node| (node, Mat4::IDENTITY)).collect(),
    };
    let mut met = vec![false; document.nodes().len()];
    let mut placed = Vec::new();
    while let Some((node, parent)) = waiting.pop() {
        if std::mem::replace(&mut met[node.index()], true) {
            return Err(buffers.fault(format!("its node {} has more than one parent", node.index())));
        }
        let world = parent * Mat4::from_cols_array_2d(&node.transform().matrix());
        if !world.is_finite() {
            return Err(buffers.fault(format!("its node {} has a transform that is not finite", node.index())));
        }
        waiting.extend(node.children().map(|child| (child, world)));
        placed.push((node, world));
    }
    Ok(placed)
}

fn roots(document: &Document) -> Vec<Node<'_>> {
    let mut is_child = vec![false; document.nodes().len()];
    for child in document.nodes().flat_map(|node| node.children().collect::<Vec<_>>()) {
        is_child[child.index()] = true;
    }
    document.nodes().filter(|node| !is_child[node.index()]).collect()
}

fn positions(primitive: &Primitive<'_>, world: Mat4, buffers: &Buffers<'_>) -> Result<Vec<[f32; 3]>, SceneError> {
    let Some(accessor) = primitive.get(&Semantic::Positions) else { return Ok(Vec::new()) };
    let mut positions = buffers.vectors(&accessor)?;
    for position in &mut positions {
        *position = world.transform_point3(Vec3::from(*position)).into();
    }
    Ok(positions)
}

/// The indices of a primitive of `count` vertices.
fn indices(primitive: &Primitive<'_>, count: usize, buffers: &Buffers<'_>) -> Result<Vec<u32>, SceneError> {
    let indices = match primitive.indices() {
        Some(accessor) => buffers.indices(&accessor)?,
        None => (0..count as u32).collect(),
    };
    match indices.iter().find(|&&index| index as usize >= count) {
        Some(index) => Err(buffers.fault(format!("has index {index} where there are {count} vertices"))),
        None => Ok(indices),
    }
}

fn append(raw: &mut RawMesh, primitive: &Primitive<'_>, world: Mat4, buffers: &Buffers<'_>) -> Result<(), SceneError> {
    let positions = positions(primitive, world, buffers)?;
    let count = positions.len();
    let indices = indices(primitive, count, buffers)?;
    let normals = match primitive.get(&Semantic::Normals) {
        Some(accessor) => buffers.vectors(&accessor)?,
        None => Vec::new(),
    };
    let colours = match primitive.get(&Semantic::Colors(0)) {
        Some(accessor) => buffers.colours(&accessor)?,
        None => Vec::new(),
    };
    let material = primitive.material();
    let [r, g, b, _] = material.pbr_metallic_roughness().base_color_factor();
    let strength = material.emissive_strength().unwrap_or(1.0);
    let emission = material.emissive_factor().map(|channel| (channel * strength).clamp(0.0, MAX_LIGHT));
    let linear = Mat3::from_mat4(world);
    let normal_from_local = linear.inverse().transpose();
    let first = raw.vertices.len() as u32;
    for (index, position) in positions.into_iter().enumerate() {
        let tint = colours.get(index).copied().unwrap_or([1.0; 3]);
        let normal = Vec3::from(normals.get(index).copied().unwrap_or_default());
        raw.vertices.push(MeshVertex {
            position,
            // A flattening transform has no inverse: such normals are made anew, as those that are missing.
            normal: (normal_from_local * normal).normalize_or_zero().into(),
            color: std::array::from_fn(|c| ([r, g, b][c] * tint[c]).clamp(0.0, 1.0)),
            emission,
            translucency: 0.0,
        });
    }
    let mirrored = linear.determinant() < 0.0;
    raw.triangles.extend(triangles(primitive.mode(), &indices).map(|[a, b, c]| {
        let [a, b, c] = [first + a, first + b, first + c];
        if mirrored { [a, c, b] } else { [a, b, c] }
    }));
    Ok(())
}

/// The triangles of a list, strip or fan; points and lines have none.
fn triangles(mode: Mode, indices: &[u32]) -> Box<dyn Iterator<Item = [u32; 3]> + '_> {
    match mode {
        Mode::Triangles => Box::new(indices.as_chunks::<3>().0.iter().copied()),
        Mode::TriangleStrip => Box::new(indices.windows(3).enumerate().map(|(index, corners)| {
            let [a, b, c] = [corners[0], corners[1], corners[2]];
            if index % 2 == 0 { [a, b, c] } else { [b, a, c] }
        })),
        Mode::TriangleFan => {
            let hub = indices.first().copied().unwrap_or_default();
            Box::new(indices.windows(2).skip(1).map(move |pair| [hub, pair[0], pair[1]]))
        }
        Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip => Box::new(std::iter::empty()),
    }
}
