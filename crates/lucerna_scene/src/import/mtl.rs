//! Material files of OBJ meshes: base colour `Kd`, emission `Ke` and translucency `Tf`; everything else is passed over.

use super::obj_text::decode;
use crate::SceneError;
use crate::assets::{self, MAX_TEXT_BYTES};
use std::fmt::Write;
use std::path::Path;
use tobj::MTLLoadResult;

/// Reads the materials that the OBJ file names with `mtllib`; none where the library is missing.
pub(super) fn library(obj: &Path, name: &str) -> Result<MTLLoadResult, SceneError> {
    let mut text = String::new();
    // One name that may hold spaces, or else the same without its folders, or else several names.
    let short = name.rsplit(['/', '\\']).next().unwrap_or_default();
    let found = append(obj, name, &mut text)? || append(obj, short, &mut text)?;
    if !found {
        for word in name.split_whitespace() {
            append(obj, word, &mut text)?;
        }
    }
    Ok(tobj::load_mtl_buf(&mut text.as_bytes()))
}

/// Appends the lines of a file that matter; false where there is no such file.
fn append(obj: &Path, name: &str, text: &mut String) -> Result<bool, SceneError> {
    let path = assets::beside(obj, name);
    match assets::read(&path, MAX_TEXT_BYTES) {
        Ok(bytes) => clean(&path, &bytes, text).map(|()| true),
        Err(SceneError::Read { .. }) => Ok(false),
        Err(error) => Err(error),
    }
}

fn clean(path: &Path, bytes: &[u8], text: &mut String) -> Result<(), SceneError> {
    let mut named = false;
    for (index, line) in bytes.split(|&byte| byte == b'\n').enumerate() {
        let line = decode(line);
        let line = line.trim();
        let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        let rest = rest.trim();
        match keyword {
            "newmtl" if !rest.is_empty() => {
                named = true;
                text.push_str("newmtl ");
                text.push_str(rest);
                text.push('\n');
            }
            "Kd" | "Ke" | "Tf" if named => {
                let colour = colour(rest)
                    .map_err(|problem| SceneError::mesh(path, Some(index + 1), format!("`{keyword}` {problem}")))?;
                if let Some([r, g, b]) = colour {
                    // Writing to a string cannot fail.
                    let _ = writeln!(text, "{keyword} {r} {g} {b}");
                }
            }
            _ => {}
        }
    }
    Ok(())
}

/// Three numbers, or one for all three; none for spectra, which this crate does not read.
fn colour(rest: &str) -> Result<Option<[f32; 3]>, String> {
    let mut numbers = [0.0_f32; 3];
    let mut count = 0;
    for word in rest.split_whitespace() {
        if count == 0 && ["spectral", "xyz"].contains(&word) {
            return Ok(None);
        }
        let number = word.parse().ok().filter(|x: &f32| x.is_finite());
        let number = number.ok_or_else(|| format!("holds `{word}`: must be a finite number"))?;
        if let Some(slot) = numbers.get_mut(count) {
            *slot = number;
        }
        count += 1;
    }
    match count {
        1 => Ok(Some([numbers[0]; 3])),
        3 => Ok(Some(numbers)),
        _ => Err(format!("has {count} numbers: must be 1 or 3")),
    }
}
