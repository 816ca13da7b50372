//! Surfaces over a grid of samples, and how they are written as OBJ.

use glam::Vec3;
use std::collections::HashMap;
use std::f32::consts::TAU;
use std::fmt::Write;

/// One sample of a surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample {
    /// Where it is, m.
    pub(crate) position: Vec3,
    /// Albedo.
    pub(crate) colour: Vec3,
    /// How strongly it glows, 0 to 1.
    pub(crate) glow: f32,
}

impl Sample {
    /// A sample that does not glow.
    pub(crate) fn new(position: Vec3, colour: Vec3) -> Self {
        Self { position, colour, glow: 0.0 }
    }
}

/// An OBJ file in the making.
pub(crate) struct Obj {
    vertices: String,
    known: HashMap<String, usize>,
    faces: String,
    material: String,
    digits: usize,
}

impl Obj {
    /// A file with positions to so many digits after the point, that uses a material file.
    pub(crate) fn new(materials: &str, digits: usize) -> Self {
        Self {
            vertices: format!("mtllib {materials}\n"),
            known: HashMap::new(),
            faces: String::new(),
            material: String::new(),
            digits,
        }
    }

    /// The text of the file.
    pub(crate) fn finish(self) -> String {
        self.vertices + &self.faces
    }

    /// A surface through `rows` times `columns` samples; `around` joins the last column to the first. Seen from
    /// outside, rows go up where columns go to the right.
    pub(crate) fn surface(
        &mut self,
        material: &str,
        [rows, columns]: [usize; 2],
        around: bool,
        sample: impl Fn(usize, usize) -> Sample,
    ) {
        let samples: Vec<Vec<Sample>> =
            (0..rows).map(|row| (0..columns).map(|column| sample(row, column)).collect()).collect();
        let last = if around { columns } else { columns - 1 };
        // Faces that glow come after the others, so that the material changes once.
        for glowing in [false, true] {
            for row in 0..rows - 1 {
                for column in 0..last {
                    let next = (column + 1) % columns;
                    let corners =
                        [samples[row][column], samples[row][next], samples[row + 1][next], samples[row + 1][column]];
                    if glowing == corners.iter().any(|corner| corner.glow > 0.0) {
                        self.face(material, &corners);
                    }
                }
            }
        }
    }

    /// One face, counter-clockwise seen from outside. Where a corner glows, the material is `ember` and the
    /// vertex colour is the glow, which is 0 where glowing and other faces meet.
    pub(crate) fn face(&mut self, material: &str, corners: &[Sample]) {
        let glowing = corners.iter().any(|corner| corner.glow > 0.0);
        let mut indices: Vec<usize> = Vec::new();
        for corner in corners {
            let colour = if glowing { Vec3::splat(corner.glow) } else { corner.colour };
            let index = self.vertex(corner.position, colour);
            if !indices.contains(&index) {
                indices.push(index);
            }
        }
        if indices.len() < 3 {
            return;
        }
        let material = if glowing { "ember" } else { material };
        if self.material != material {
            self.material = material.to_owned();
            writeln!(self.faces, "usemtl {material}").unwrap();
        }
        let words: Vec<String> = indices.iter().map(|index| (index + 1).to_string()).collect();
        writeln!(self.faces, "f {}", words.join(" ")).unwrap();
    }

    fn vertex(&mut self, position: Vec3, colour: Vec3) -> usize {
        let mut line = String::from("v");
        for x in position.to_array() {
            write!(line, " {}", number(x, self.digits)).unwrap();
        }
        for c in colour.to_array() {
            write!(line, " {}", number(c.clamp(0.0, 1.0), if c < 0.1 { 3 } else { 2 })).unwrap();
        }
        let next = self.known.len();
        *self.known.entry(line).or_insert_with_key(|line| {
            self.vertices.push_str(line);
            self.vertices.push('\n');
            next
        })
    }

    /// A lump: an icosahedron whose faces are cut in four `levels` times, then shaped by a function of the
    /// direction.
    pub(crate) fn lump(&mut self, material: &str, levels: u32, shape: impl Fn(Vec3) -> Sample) {
        let mut triangles = icosahedron();
        for _ in 0..levels {
            triangles = triangles.into_iter().flat_map(quarter).collect();
        }
        for glowing in [false, true] {
            for triangle in &triangles {
                let corners = triangle.map(&shape);
                if glowing == corners.iter().any(|corner| corner.glow > 0.0) {
                    self.face(material, &corners);
                }
            }
        }
    }
}

/// The angle of a column.
pub(crate) fn angle(column: usize, columns: usize) -> f32 {
    TAU * column as f32 / columns as f32
}

/// A point around the y axis; angles go against the clock seen from above, so that columns go right.
pub(crate) fn polar(radius: f32, angle: f32, y: f32) -> Vec3 {
    Vec3::new(radius * angle.cos(), y, -radius * angle.sin())
}

/// Linear interpolation in a table of (place, value) pairs with rising places.
pub(crate) fn table(points: &[[f32; 2]], place: f32) -> f32 {
    for pair in points.windows(2) {
        let [[x0, y0], [x1, y1]] = [pair[0], pair[1]];
        if place <= x1 {
            return y0 + (y1 - y0) * ((place - x0) / (x1 - x0)).clamp(0.0, 1.0);
        }
    }
    points[points.len() - 1][1]
}

fn number(x: f32, digits: usize) -> String {
    let text = format!("{x:.digits$}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    match text {
        "" | "0" | "-0" => "0".to_owned(),
        // The zero before the point is left out: files are shorter.
        _ => text.replacen("0.", ".", usize::from(text.starts_with("0.") || text.starts_with("-0."))),
    }
}

fn icosahedron() -> Vec<[Vec3; 3]> {
    let upper = |i: usize| polar(0.894_43, angle(i % 5, 5), 0.447_21);
    let lower = |i: usize| polar(0.894_43, angle(i % 5, 5) + TAU / 10.0, -0.447_21);
    let mut triangles = Vec::new();
    for i in 0..5 {
        triangles.push([Vec3::Y, upper(i), upper(i + 1)]);
        triangles.push([upper(i), lower(i), upper(i + 1)]);
        triangles.push([lower(i), lower(i + 1), upper(i + 1)]);
        triangles.push([Vec3::NEG_Y, lower(i + 1), lower(i)]);
    }
    triangles
}

fn quarter([a, b, c]: [Vec3; 3]) -> [[Vec3; 3]; 4] {
    let [ab, bc, ca] = [(a + b).normalize(), (b + c).normalize(), (c + a).normalize()];
    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
}
