//! Flame surfaces of many frames in one binary glTF 2.0 (Khronos, section 4.4: GLB).
//!
//! Each frame is a node with a mesh of its own, for flames come and go, and a morph target cannot. A node is seen while
//! its scale is 1 and hidden while it is 0 (section 3.5.3 has this as the way to animate visibility).

use super::ExportError;
use super::checked::{self, FlameMesh};
use glam::Vec3;
use lucerna_frame::{Frame, blackbody_rgb};
use serde_json::{Value, json};
use std::io::Write;

/// Bytes from vertex to vertex: position, normal, texture coordinates.
const STRIDE: usize = 32;
/// Component types and buffer targets of the specification.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;
/// Buffer views.
const KEYS: usize = 0;
const VERTICES: usize = 1;
const INDICES: usize = 2;
/// Accessors that all frames share: scales hidden, shown, hidden; shown, hidden; and hidden, shown.
const MIDDLE: usize = 0;
const FIRST: usize = 1;
const LAST: usize = 2;

/// Gathers frames and writes them as one .glb: an animation in which each is shown in its turn.
///
/// Every flame is a primitive with positions (m), normals and texture coordinates (u around the flame, v from tip to
/// root, as glTF has its pictures from the top). Its material emits the colour of its soot, scaled to at most 1.
/// All frames are held in memory, 32 bytes a vertex; triangles that frames share are held once.
#[derive(Debug)]
pub struct GlbSequence {
    fps: f64,
    keys: Vec<u8>,
    vertices: Vec<u8>,
    indices: Vec<u8>,
    /// Triangles that are in `indices` already, with their accessor.
    known: Vec<(Vec<u32>, usize)>,
    colors: Vec<[f32; 3]>,
    accessors: Vec<Value>,
    meshes: Vec<Value>,
    nodes: Vec<Value>,
}

impl GlbSequence {
    /// Begins a sequence with `fps` frames a second.
    ///
    /// # Errors
    /// When `fps` is not above 0 and finite.
    pub fn new(fps: f64) -> Result<Self, ExportError> {
        if !(fps > 0.0 && fps.is_finite()) {
            return Err(ExportError::value("fps", &fps, "above 0 and finite"));
        }
        let scales = |first: usize, count: usize| json!({ "bufferView": KEYS, "byteOffset": 12 * first, "componentType": FLOAT, "count": count, "type": "VEC3" });
        Ok(Self {
            fps,
            keys: bytes(&[0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0]),
            vertices: Vec::new(),
            indices: Vec::new(),
            known: Vec::new(),
            colors: Vec::new(),
            accessors: vec![scales(0, 3), scales(1, 2), scales(0, 2)],
            meshes: Vec::new(),
            nodes: Vec::new(),
        })
    }

    /// Adds a frame.
    ///
    /// # Errors
    /// When the frame has control nets instead of vertices, its slices do not fit together, a number is not finite, or
    /// the file would pass the 4 GiB that the format can hold. The sequence is then as it was.
    pub fn push(&mut self, frame: &Frame<'_>) -> Result<(), ExportError> {
        let flames = checked::flames(frame)?;
        let added: usize = flames.iter().map(|f| STRIDE * f.vertices.len() + 4 * f.indices.len()).sum();
        check_size(self.keys.len() + self.vertices.len() + self.indices.len() + added)?;
        let primitives: Vec<Value> = flames.iter().map(|flame| self.primitive(flame)).collect();
        let name = format!("frame_{:05}", self.nodes.len());
        let mut node = json!({ "name": name });
        if !primitives.is_empty() {
            node["mesh"] = self.meshes.len().into();
            self.meshes.push(json!({ "name": name, "primitives": primitives }));
        }
        if !self.nodes.is_empty() {
            // Programs that show no animations show the first frame.
            node["scale"] = json!([0, 0, 0]);
        }
        self.nodes.push(node);
        Ok(())
    }

    fn primitive(&mut self, flame: &FlameMesh<'_>) -> Value {
        let start = self.vertices.len();
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for v in flame.vertices {
            low = low.min(v.position.into());
            high = high.max(v.position.into());
            let numbers = v.position.into_iter().chain(v.normal).chain([v.uv[0], 1.0 - v.uv[1]]);
            self.vertices.extend(numbers.flat_map(f32::to_le_bytes));
        }
        let first = self.accessors.len();
        for (offset, kind) in [(0, "VEC3"), (12, "VEC3"), (24, "VEC2")] {
            self.accessors.push(json!({
                "bufferView": VERTICES, "byteOffset": start + offset,
                "componentType": FLOAT, "count": flame.vertices.len(), "type": kind,
            }));
        }
        self.accessors[first]["min"] = json!(low.to_array());
        self.accessors[first]["max"] = json!(high.to_array());
        json!({
            "attributes": { "POSITION": first, "NORMAL": first + 1, "TEXCOORD_0": first + 2 },
            "indices": self.triangles(flame.indices),
            "material": self.material(flame),
        })
    }

    /// The accessor of these indices.
    fn triangles(&mut self, indices: &[u32]) -> usize {
        if let Some((_, accessor)) = self.known.iter().find(|(known, _)| known == indices) {
            return *accessor;
        }
        let accessor = self.accessors.len();
        self.accessors.push(json!({
            "bufferView": INDICES, "byteOffset": self.indices.len(),
            "componentType": UNSIGNED_INT, "count": indices.len(), "type": "SCALAR",
        }));
        self.indices.extend(indices.iter().flat_map(|index| index.to_le_bytes()));
        self.known.push((indices.to_vec(), accessor));
        accessor
    }

    /// The material that emits the colour of a flame's soot.
    fn material(&mut self, flame: &FlameMesh<'_>) -> usize {
        let color = (blackbody_rgb(flame.shade.temperature_k) * Vec3::from(flame.shade.tint)).max(Vec3::ZERO);
        let color = color / color.max_element();
        let color = if color.is_finite() { color } else { Vec3::ONE }.to_array();
        self.colors.iter().position(|known| *known == color).unwrap_or_else(|| {
            self.colors.push(color);
            self.colors.len() - 1
        })
    }

    /// Shows each frame in its turn; a single one is always seen.
    fn animation(&mut self) -> Option<Value> {
        let last = self.nodes.len() - 1;
        if last == 0 {
            return None;
        }
        let at = |frame: usize| (frame as f64 / self.fps) as f32;
        let (mut samplers, mut channels) = (Vec::new(), Vec::new());
        for node in 0..=last {
            let (times, scales) = match node {
                0 => (vec![0.0, at(1)], FIRST),
                _ if node == last => (vec![0.0, at(node)], LAST),
                _ => (vec![0.0, at(node), at(node + 1)], MIDDLE),
            };
            channels.push(json!({ "sampler": node, "target": { "node": node, "path": "scale" } }));
            samplers.push(json!({ "input": self.accessors.len(), "interpolation": "STEP", "output": scales }));
            self.accessors.push(json!({
                "bufferView": KEYS, "byteOffset": self.keys.len(), "componentType": FLOAT, "count": times.len(),
                "type": "SCALAR", "min": [0.0], "max": [times[times.len() - 1]],
            }));
            self.keys.extend(bytes(&times));
        }
        Some(json!({ "name": "flames", "samplers": samplers, "channels": channels }))
    }

    /// Writes the file.
    ///
    /// # Errors
    /// When there is no frame, the file would pass 4 GiB, or `out` fails.
    pub fn finish(mut self, mut out: impl Write) -> Result<(), ExportError> {
        if self.nodes.is_empty() {
            return Err(ExportError::value("the number of frames", &0, "1 or more"));
        }
        let animation = self.animation();
        let parts = [&self.keys, &self.vertices, &self.indices];
        let size: usize = parts.iter().map(|part| part.len()).sum();
        let mut views = vec![json!({ "buffer": 0, "byteLength": self.keys.len() })];
        if !self.meshes.is_empty() {
            views.push(json!({
                "buffer": 0, "byteOffset": self.keys.len(), "byteLength": self.vertices.len(),
                "byteStride": STRIDE, "target": ARRAY_BUFFER,
            }));
            views.push(json!({
                "buffer": 0, "byteOffset": self.keys.len() + self.vertices.len(), "byteLength": self.indices.len(),
                "target": ELEMENT_ARRAY_BUFFER,
            }));
        }
        let material = |color| {
            let surface = json!({ "baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0 });
            json!({ "name": "flame", "pbrMetallicRoughness": surface, "emissiveFactor": color })
        };
        let mut root = json!({
            "asset": { "version": "2.0", "generator": "Lucerna" },
            "scene": 0,
            "scenes": [{ "nodes": (0..self.nodes.len()).collect::<Vec<usize>>() }],
            "nodes": self.nodes,
            "buffers": [{ "byteLength": size }],
            "bufferViews": views,
            "accessors": self.accessors,
        });
        // Lists that are empty are not allowed.
        if !self.meshes.is_empty() {
            root["meshes"] = self.meshes.into();
            root["materials"] = self.colors.into_iter().map(material).collect();
        }
        if let Some(animation) = animation {
            root["animations"] = json!([animation]);
        }
        let mut text = serde_json::to_vec(&root).map_err(std::io::Error::from)?;
        text.resize(text.len().next_multiple_of(4), b' ');
        let whole = check_size(12 + 8 + text.len() + 8 + size)?;
        out.write_all(b"glTF")?;
        for word in [2, whole, text.len() as u32] {
            out.write_all(&word.to_le_bytes())?;
        }
        out.write_all(b"JSON")?;
        out.write_all(&text)?;
        out.write_all(&(size as u32).to_le_bytes())?;
        out.write_all(b"BIN\0")?;
        for part in parts {
            out.write_all(part)?;
        }
        Ok(out.flush()?)
    }
}

fn bytes(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}

fn check_size(size: usize) -> Result<u32, ExportError> {
    u32::try_from(size).map_err(|_| {
        ExportError::value("the size of the glTF file in bytes", &size, "below 4 GiB: export fewer frames")
    })
}
