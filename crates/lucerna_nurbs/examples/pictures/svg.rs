//! Just enough of a drawing: panels of lines, dots and shaded quadrilaterals in one SVG file.

use std::fmt::Write as _;

/// Width and height of a panel in pixels.
pub(crate) const PANEL: [f32; 2] = [300.0, 270.0];

/// A sheet of panels.
pub(crate) struct Sheet {
    columns: usize,
    panels: usize,
    body: String,
}

/// A point of a panel: 0 to 1 from left to right, and upwards.
pub(crate) type At = [f32; 2];

impl Sheet {
    pub(crate) fn new(columns: usize) -> Self {
        Self { columns, panels: 0, body: String::new() }
    }

    /// Begins a panel with a line of text below it.
    pub(crate) fn panel(&mut self, text: &str) {
        self.panels += 1;
        let [x, y] = self.origin();
        let (x, y) = (x + PANEL[0] * 0.5, y + PANEL[1] - 8.0);
        let _ = writeln!(self.body, r##"<text x="{x}" y="{y}" text-anchor="middle">{text}</text>"##);
    }

    fn origin(&self) -> At {
        let index = self.panels - 1;
        [(index % self.columns) as f32 * PANEL[0], (index / self.columns) as f32 * PANEL[1]]
    }

    /// Pixels in the panel, a little smaller than it so that the text has room.
    fn pixel(&self, [x, y]: At) -> At {
        let [left, top] = self.origin();
        let side = PANEL[1] - 40.0;
        [left + 0.5 * (PANEL[0] - side) + x * side, top + 10.0 + (1.0 - y) * side]
    }

    fn path(&self, points: impl IntoIterator<Item = At>) -> String {
        points.into_iter().fold(String::new(), |mut path, at| {
            let [x, y] = self.pixel(at);
            let _ = write!(path, "{x:.1},{y:.1} ");
            path
        })
    }

    /// A filled polygon with an edge of the same colour, which hides the gaps between neighbours.
    pub(crate) fn polygon(&mut self, points: impl IntoIterator<Item = At>, [r, g, b]: [u8; 3]) {
        let path = self.path(points);
        let _ = writeln!(self.body, r##"<path color="#{r:02x}{g:02x}{b:02x}" d="M{}z"/>"##, path.trim_end());
    }

    pub(crate) fn line(&mut self, points: impl IntoIterator<Item = At>, color: &str, width: f32) {
        let path = self.path(points);
        let _ =
            writeln!(self.body, r##"<polyline points="{path}" fill="none" stroke="{color}" stroke-width="{width}"/>"##);
    }

    pub(crate) fn dot(&mut self, at: At, color: &str, radius: f32) {
        let [x, y] = self.pixel(at);
        let _ = writeln!(self.body, r##"<circle cx="{x:.1}" cy="{y:.1}" r="{radius}" fill="{color}"/>"##);
    }

    pub(crate) fn finish(self) -> String {
        let [width, height] = [self.columns as f32 * PANEL[0], self.panels.div_ceil(self.columns) as f32 * PANEL[1]];
        format!(
            r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" font-family="sans-serif" font-size="13" stroke-linejoin="round">
<style>path{{fill:currentColor;stroke:currentColor}}</style>
<rect width="100%" height="100%" fill="#ffffff"/>
{}</svg>
"##,
            self.body
        )
    }
}
