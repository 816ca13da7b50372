//! The numbers of a glTF file: buffers are found, and every accessor is checked before it is read, so that
//! sizes, offsets and types that do not fit are errors.

use super::MAX_VERTICES;
use crate::SceneError;
use crate::assets::{self, MAX_MESH_BYTES};
use gltf::accessor::{DataType, Dimensions, Iter};
use gltf::buffer::{Data, Source};
use gltf::{Accessor, Document};
use std::path::Path;

/// The bytes of all buffers of a file.
#[derive(Debug)]
pub(super) struct Buffers<'a> {
    path: &'a Path,
    data: Vec<Vec<u8>>,
}

impl<'a> Buffers<'a> {
    pub(super) fn read(path: &'a Path, document: &Document, blob: Option<Vec<u8>>) -> Result<Self, SceneError> {
        let mut blob = blob;
        let mut total = 0;
        let mut data = Vec::new();
        for buffer in document.buffers() {
            let fault =
                |problem: String| SceneError::mesh(path, None, format!("its buffer {} {problem}", buffer.index()));
            let bytes = match buffer.source() {
                Source::Bin => blob.take().ok_or_else(|| fault("is missing from the file".to_owned()))?,
                Source::Uri(uri) if uri.starts_with("data:") => {
                    let data = Data::from_source(Source::Uri(uri), None);
                    data.map_err(|error| fault(format!("cannot be decoded: {error}")))?.0
                }
                Source::Uri(uri) => {
                    let name = percent_decode(uri).filter(|name| !name.contains(':'));
                    let name = name.ok_or_else(|| fault(format!("is `{uri}`: must be a relative path")))?;
                    assets::read(&assets::beside(path, &name), MAX_MESH_BYTES)?.into_owned()
                }
            };
            if bytes.len() < buffer.length() {
                return Err(fault(format!("has {} bytes: must be {}", bytes.len(), buffer.length())));
            }
            total += bytes.len() as u64;
            if total > MAX_MESH_BYTES {
                return Err(fault(format!("is too large: must be at most {} MiB in all", MAX_MESH_BYTES >> 20)));
            }
            data.push(bytes);
        }
        Ok(Self { path, data })
    }

    pub(super) fn fault(&self, problem: impl Into<String>) -> SceneError {
        SceneError::mesh(self.path, None, problem)
    }

    /// Three numbers an item: positions and normals.
    pub(super) fn vectors(&self, accessor: &Accessor<'_>) -> Result<Vec<[f32; 3]>, SceneError> {
        self.check(accessor, &[(DataType::F32, Dimensions::Vec3)])?;
        let vectors: Vec<[f32; 3]> = self.items(accessor)?.collect();
        if vectors.iter().flatten().any(|x| !x.is_finite()) {
            return Err(self.fault(format!("its accessor {} holds a number that is not finite", accessor.index())));
        }
        Ok(vectors)
    }

    /// Linear colours.
    pub(super) fn colours(&self, accessor: &Accessor<'_>) -> Result<Vec<[f32; 3]>, SceneError> {
        let types = [DataType::F32, DataType::U16, DataType::U8];
        let allowed: Vec<_> =
            types.iter().flat_map(|&kind| [(kind, Dimensions::Vec3), (kind, Dimensions::Vec4)]).collect();
        self.check(accessor, &allowed)?;
        Ok(match (accessor.data_type(), accessor.dimensions()) {
            (DataType::F32, Dimensions::Vec3) => self.items(accessor)?.collect(),
            (DataType::F32, _) => self.items(accessor)?.map(|[r, g, b, _]: [f32; 4]| [r, g, b]).collect(),
            (DataType::U16, Dimensions::Vec3) => self.items(accessor)?.map(from_u16).collect(),
            (DataType::U16, _) => self.items(accessor)?.map(|[r, g, b, _]: [u16; 4]| from_u16([r, g, b])).collect(),
            (_, Dimensions::Vec3) => self.items(accessor)?.map(from_u8).collect(),
            _ => self.items(accessor)?.map(|[r, g, b, _]: [u8; 4]| from_u8([r, g, b])).collect(),
        })
    }

    /// Indices of vertices.
    pub(super) fn indices(&self, accessor: &Accessor<'_>) -> Result<Vec<u32>, SceneError> {
        let types = [DataType::U32, DataType::U16, DataType::U8];
        self.check(accessor, &types.map(|kind| (kind, Dimensions::Scalar)))?;
        Ok(match accessor.data_type() {
            DataType::U32 => self.items(accessor)?.collect(),
            DataType::U16 => self.items::<u16>(accessor)?.map(u32::from).collect(),
            _ => self.items::<u8>(accessor)?.map(u32::from).collect(),
        })
    }

    fn items<T: gltf::accessor::Item>(&self, accessor: &Accessor<'_>) -> Result<Iter<'_, T>, SceneError> {
        Iter::new(accessor.clone(), |buffer| self.data.get(buffer.index()).map(Vec::as_slice))
            .ok_or_else(|| self.fault(format!("its accessor {} has no data", accessor.index())))
    }

    fn check(&self, accessor: &Accessor<'_>, allowed: &[(DataType, Dimensions)]) -> Result<(), SceneError> {
        let index = accessor.index();
        if accessor.sparse().is_some() {
            return Err(self.fault(format!("its accessor {index} is sparse: must be dense")));
        }
        let Some(view) = accessor.view() else {
            return Err(self.fault(format!("its accessor {index} has no data")));
        };
        if !allowed.contains(&(accessor.data_type(), accessor.dimensions())) {
            return Err(self.fault(format!("its accessor {index} has a type that is not allowed where it is used")));
        }
        let count = accessor.count();
        if !(1..=6 * MAX_VERTICES).contains(&count) {
            let most = 6 * MAX_VERTICES;
            return Err(self.fault(format!("its accessor {index} has {count} items: must be 1 to {most}")));
        }
        let size = accessor.size();
        let stride = view.stride().unwrap_or(size);
        let needed = stride
            .checked_mul(count - 1)
            .and_then(|bytes| bytes.checked_add(size))
            .and_then(|bytes| bytes.checked_add(accessor.offset()));
        let view_end = view.offset().checked_add(view.length());
        let held = self.data.get(view.buffer().index()).map_or(0, Vec::len);
        let fits = stride >= size
            && needed.is_some_and(|bytes| bytes <= view.length())
            && view_end.is_some_and(|end| end <= held);
        if fits { Ok(()) } else { Err(self.fault(format!("its accessor {index} reaches beyond its buffer"))) }
    }
}

fn from_u16(colour: [u16; 3]) -> [f32; 3] {
    colour.map(|c| f32::from(c) / f32::from(u16::MAX))
}

fn from_u8(colour: [u8; 3]) -> [f32; 3] {
    colour.map(|c| f32::from(c) / f32::from(u8::MAX))
}

/// A relative address as a file name.
fn percent_decode(uri: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&first, tail)) = rest.split_first() {
        let hex = tail.get(..2).and_then(|two| std::str::from_utf8(two).ok());
        match hex.and_then(|two| u8::from_str_radix(two, 16).ok()) {
            Some(byte) if first == b'%' => {
                bytes.push(byte);
                rest = &tail[2..];
            }
            _ => {
                bytes.push(first);
                rest = tail;
            }
        }
    }
    String::from_utf8(bytes).ok()
}
