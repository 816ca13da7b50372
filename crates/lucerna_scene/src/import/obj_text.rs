//! The lines of an OBJ file, checked one by one, so that what remains can be assembled without surprises.
//!
//! Files from the wild have CRLF, continued lines, tabs, Latin-1 bytes, names with spaces, indices beyond the
//! end, numbers that are not; every fault is named with its line here.

use super::{MAX_TRIANGLES, MAX_VERTICES, WickGroup, check_size};
use crate::SceneError;
use std::borrow::Cow;
use std::path::Path;

/// A checked OBJ file.
#[derive(Debug, Default)]
pub(super) struct ObjText {
    /// The lines that shape and colour depend on, clean.
    pub(super) text: String,
    /// All positions.
    pub(super) positions: Vec<[f32; 3]>,
    coloured: usize,
    normals: usize,
    triangles: usize,
    /// Groups with their elements; only where asked for.
    groups: Option<Vec<Group>>,
    /// Vertices that an element of any group connects, where groups are asked for.
    links: Vec<[u32; 2]>,
}

/// The elements of one group.
#[derive(Debug, Default)]
struct Group {
    name: String,
    /// The vertices that its elements use, repeated as they are used.
    vertices: Vec<u32>,
    /// Pairs that one of them connects.
    links: Vec<[u32; 2]>,
}

/// The vertices of an OBJ file: those of groups that are wanted or named for wicks, or else all as one group.
pub(super) fn wicks(path: &Path, bytes: &[u8], group: Option<&str>) -> Result<Vec<WickGroup>, SceneError> {
    let mut obj = scan(path, bytes, Some(group))?;
    let mut groups = Vec::new();
    for Group { name, vertices: mut indices, mut links } in obj.groups.take().unwrap_or_default() {
        indices.sort_unstable();
        indices.dedup();
        let place = |vertex: u32| indices.partition_point(|&other| other < vertex) as u32;
        links.iter_mut().for_each(|pair| *pair = pair.map(place));
        let vertices = indices.iter().map(|&index| obj.positions[index as usize]).collect();
        groups.push(WickGroup { name, vertices, links });
    }
    if groups.is_empty() {
        groups.push(WickGroup { name: String::new(), vertices: obj.positions, links: obj.links });
    }
    Ok(groups)
}

/// Checks every line; for wicks it gathers groups, the wanted one and those named for wicks, instead of text.
pub(super) fn scan(path: &Path, bytes: &[u8], for_wicks: Option<Option<&str>>) -> Result<ObjText, SceneError> {
    if bytes.iter().take(4096).any(|&byte| byte == 0) {
        return Err(SceneError::mesh(path, None, "is not an OBJ file: it is not text"));
    }
    let mut obj = ObjText { groups: for_wicks.map(|_| Vec::new()), ..ObjText::default() };
    if for_wicks.is_none() {
        obj.text.reserve(bytes.len());
    }
    let mut group = String::new();
    let mut gathers = false;
    for (number, line) in lines(bytes) {
        let fault = |problem: String| SceneError::mesh(path, Some(number), problem);
        let text = decode(&line);
        let text = text.trim();
        let (keyword, rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
        let rest = rest.trim();
        match keyword {
            "v" => obj.vertex(rest).map_err(fault)?,
            "vn" => obj.normal(rest).map_err(fault)?,
            "f" | "l" | "p" => obj.element(keyword, rest, gathers.then_some(&group)).map_err(fault)?,
            "o" | "g" => {
                group = rest.to_owned();
                gathers = for_wicks.is_some_and(|wanted| wanted == Some(rest) || super::is_wick(rest));
                obj.keep(keyword, rest);
            }
            "usemtl" | "mtllib" if !rest.is_empty() => obj.keep(keyword, rest),
            _ => {}
        }
        check_size(path, obj.positions.len(), obj.triangles)?;
    }
    if obj.positions.is_empty() {
        return Err(SceneError::mesh(path, None, "has no vertices"));
    }
    if obj.coloured != 0 && obj.coloured != obj.positions.len() {
        return Err(SceneError::mesh(path, None, "has colours on some of its vertices: must be all or none"));
    }
    Ok(obj)
}

impl ObjText {
    fn keep(&mut self, keyword: &str, rest: &str) {
        if self.groups.is_none() {
            self.text.push_str(keyword);
            self.text.push(' ');
            self.text.push_str(rest);
            self.text.push('\n');
        }
    }

    fn vertex(&mut self, rest: &str) -> Result<(), String> {
        let (mut numbers, count) = floats::<6>(rest, "v")?;
        match count {
            3 => {}
            4 => {
                let w = numbers[3];
                numbers.iter_mut().take(3).for_each(|x| *x /= w);
                if numbers.iter().take(3).any(|x| !x.is_finite()) {
                    return Err(format!("the weight of the vertex is {w}: must not be 0"));
                }
            }
            6 => self.coloured += 1,
            _ => return Err(format!("a vertex has {count} numbers: must be 3, 4 or 6")),
        }
        self.positions.push([numbers[0], numbers[1], numbers[2]]);
        self.keep("v", rest);
        Ok(())
    }

    fn normal(&mut self, rest: &str) -> Result<(), String> {
        let (_, count) = floats::<3>(rest, "vn")?;
        if count != 3 {
            return Err(format!("a normal has {count} numbers: must be 3"));
        }
        self.normals += 1;
        if self.normals > 3 * MAX_VERTICES {
            return Err(format!("more than {} normals", 3 * MAX_VERTICES));
        }
        self.keep("vn", rest);
        Ok(())
    }

    fn element(&mut self, keyword: &str, rest: &str, group: Option<&String>) -> Result<(), String> {
        let mut corners = 0_usize;
        let mut before = None;
        for corner in rest.split_whitespace() {
            let mut parts = corner.split('/');
            let vertex = index(parts.next().unwrap_or_default(), self.positions.len(), "vertices")?;
            if parts.next().is_some_and(|part| !part.is_empty() && part.parse::<i32>().is_err()) {
                return Err(format!("`{corner}` is not a corner of a face"));
            }
            if let Some(normal) = parts.next().filter(|part| !part.is_empty()) {
                index(normal, self.normals, "normals")?;
            }
            if parts.next().is_some() {
                return Err(format!("`{corner}` is not a corner of a face"));
            }
            corners += 1;
            let link = before.replace(vertex).filter(|_| keyword != "p").map(|other| [other, vertex]);
            if let Some(groups) = &mut self.groups {
                if let Some(name) = group {
                    if groups.last().is_none_or(|last| last.name != *name) {
                        groups.push(Group { name: name.clone(), ..Group::default() });
                    }
                    if let Some(last) = groups.last_mut() {
                        last.vertices.push(vertex);
                        last.links.extend(link);
                    }
                }
                self.links.extend(link);
            }
        }
        if keyword == "f" && corners >= 3 {
            self.triangles += corners - 2;
            if self.triangles > MAX_TRIANGLES {
                return Err(format!("more than {MAX_TRIANGLES} triangles"));
            }
            self.keep("f", rest);
        }
        Ok(())
    }
}

/// Up to `N` finite numbers and how many there are in all.
fn floats<const N: usize>(rest: &str, what: &str) -> Result<([f32; N], usize), String> {
    let mut numbers = [0.0; N];
    let mut count = 0;
    for word in rest.split_whitespace() {
        let number: f32 = word.parse().map_err(|_| format!("`{word}` in `{what}` is not a number"))?;
        if !number.is_finite() {
            return Err(format!("`{word}` in `{what}` is not a finite number"));
        }
        if let Some(slot) = numbers.get_mut(count) {
            *slot = number;
        }
        count += 1;
    }
    Ok((numbers, count))
}

/// An index that counts from 1, or from the end when negative, as one that counts from 0.
fn index(text: &str, count: usize, what: &str) -> Result<u32, String> {
    let number: i64 = text.parse().map_err(|_| format!("`{text}` is not an index"))?;
    let end = count as i64;
    let from_zero = if number < 0 { end.saturating_add(number) } else { number - 1 };
    match u32::try_from(from_zero) {
        Ok(index) if from_zero < end => Ok(index),
        _ => Err(format!("index {number} is out of range: there are {count} {what} so far")),
    }
}

/// The lines with their numbers; a line that ends in a backslash goes on in the next one.
fn lines(bytes: &[u8]) -> impl Iterator<Item = (usize, Cow<'_, [u8]>)> {
    let mut physical = bytes.split(|&byte| byte == b'\n').enumerate();
    std::iter::from_fn(move || {
        let (index, line) = physical.next()?;
        let mut line = Cow::Borrowed(line);
        loop {
            let trimmed = line.trim_ascii_end();
            if trimmed.last() != Some(&b'\\') {
                break;
            }
            let kept = trimmed.len() - 1;
            line.to_mut().truncate(kept);
            let Some((_, next)) = physical.next() else { break };
            line.to_mut().push(b' ');
            line.to_mut().extend_from_slice(next);
        }
        Some((index + 1, line))
    })
}

/// UTF-8 where it is, else Latin-1.
pub(super) fn decode(line: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(line) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(line.iter().map(|&byte| char::from(byte)).collect()),
    }
}
