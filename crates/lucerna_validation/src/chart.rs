//! Plots as small SVG.

use std::fmt::Write;

/// Colours that remain apart for most colour-blind eyes (Okabe and Ito).
const COLOURS: [&str; 6] = ["#000000", "#d55e00", "#0072b2", "#009e73", "#cc79a7", "#e69f00"];
/// Size of a plot, and the part of it that the axes frame: left, top, right, bottom.
const SIZE: [f64; 2] = [460.0, 320.0];
const FRAME: [f64; 4] = [58.0, 30.0, 448.0, 276.0];
/// Points a line is thinned to: a plot shows no more.
const MOST_POINTS: usize = 240;

/// An axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What it shows, with its unit.
    pub label: String,
    /// Whether equal lengths are equal ratios.
    pub is_log: bool,
}

impl Axis {
    /// Equal lengths are equal differences.
    #[must_use]
    pub fn linear(label: &str) -> Self {
        Self { label: label.into(), is_log: false }
    }

    /// Equal lengths are equal ratios.
    #[must_use]
    pub fn log(label: &str) -> Self {
        Self { label: label.into(), is_log: true }
    }
}

/// How a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// A line through the points.
    Line,
    /// A broken line: what is published.
    Dashes,
    /// Circles.
    Points,
}

/// Points with a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// For the legend.
    pub name: String,
    /// How it is drawn.
    pub mark: Mark,
    /// x and y; those that an axis cannot show are left out.
    pub points: Vec<(f64, f64)>,
}

/// A plot.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// Above the plot.
    pub title: String,
    /// Across.
    pub x: Axis,
    /// Upwards.
    pub y: Axis,
    /// What is drawn, the first in black.
    pub series: Vec<Series>,
}

/// Points of a series.
type Points = Vec<(f64, f64)>;

/// An axis that knows what it has to show.
struct Scale {
    low: f64,
    high: f64,
    is_log: bool,
    from: f64,
    to: f64,
}

impl Scale {
    fn new(values: impl Iterator<Item = f64> + Clone, is_log: bool, from: f64, to: f64) -> Self {
        let low = values.clone().fold(f64::INFINITY, f64::min);
        let high = values.fold(f64::NEG_INFINITY, f64::max);
        let (low, high) = if low <= high { (low, high) } else { (1.0, 2.0) };
        if is_log {
            return Self { low: low / 1.15, high: high * 1.15, is_log, from, to };
        }
        // Zero belongs to what nearly reaches it.
        let low = if low > 0.0 && low < 0.6 * high { 0.0 } else { low };
        let room = 0.05 * (high - low).max(1.0e-9 * high.abs()).max(1.0e-30);
        Self { low: if low == 0.0 { 0.0 } else { low - room }, high: high + room, is_log, from, to }
    }

    fn place(&self, value: f64) -> f64 {
        let share = if self.is_log {
            (value / self.low).ln() / (self.high / self.low).ln()
        } else {
            (value - self.low) / (self.high - self.low)
        };
        self.from + share * (self.to - self.from)
    }

    /// Round values along the axis, with their labels.
    fn ticks(&self) -> Vec<(f64, String)> {
        if self.is_log {
            let (first, last) = (self.low.log10().floor() as i32, self.high.log10().ceil() as i32);
            let decades = (first..=last).flat_map(|power| [1.0, 2.0, 5.0].map(|digit| digit * 10.0_f64.powi(power)));
            let shown = decades.filter(|value| (self.low..=self.high).contains(value));
            return shown.map(|value| (value, label(value, value))).collect();
        }
        let rough = (self.high - self.low) / 5.0;
        let unit = 10.0_f64.powf(rough.log10().floor());
        let step = unit * [1.0, 2.0, 5.0, 10.0].into_iter().find(|digit| digit * unit >= rough).unwrap_or(10.0);
        let first = (self.low / step).ceil() as i64;
        let places = (first..).map(|at| at as f64 * step).take_while(|value| *value <= self.high);
        places.take(20).map(|value| (value, label(value, step))).collect()
    }
}

/// A value with the digits that a step of this size needs.
fn label(value: f64, step: f64) -> String {
    let digits = (-step.log10().floor()).max(0.0) as usize;
    format!("{:.digits$}", if value.abs() < 1.0e-12 { 0.0 } else { value })
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

impl Chart {
    /// A law, and what was found beside it, on logarithmic axes.
    pub(crate) fn of_law(title: &str, [x, y]: [&str; 2], (name, law): (&str, Points), found: Points) -> Self {
        let law = Series { name: name.into(), mark: Mark::Dashes, points: law };
        let found = Series { name: "found".into(), mark: Mark::Points, points: found };
        Self { title: title.into(), x: Axis::log(x), y: Axis::log(y), series: vec![law, found] }
    }

    /// The plot as a fragment of SVG, moved right by `shift`.
    fn draw(&self, out: &mut String, shift: f64) -> std::fmt::Result {
        let [left, top, right, bottom] = FRAME;
        let can_show = |(x, y): &(f64, f64)| {
            x.is_finite() && y.is_finite() && (*x > 0.0 || !self.x.is_log) && (*y > 0.0 || !self.y.is_log)
        };
        let points = || self.series.iter().flat_map(|series| series.points.iter().copied()).filter(can_show);
        let x = Scale::new(points().map(|point| point.0), self.x.is_log, left, right);
        let y = Scale::new(points().map(|point| point.1), self.y.is_log, bottom, top);
        writeln!(out, "<g transform=\"translate({shift} 0)\">")?;
        writeln!(out, "<text x=\"{left}\" y=\"18\" font-size=\"14\">{}</text>", escape(&self.title))?;
        for (value, label) in x.ticks() {
            let at = x.place(value);
            writeln!(out, "<path fill=\"none\" class=\"t\" d=\"M{at:.1} {top}V{bottom}\"/>")?;
            writeln!(out, "<text x=\"{at:.1}\" y=\"{}\" text-anchor=\"middle\">{label}</text>", bottom + 15.0)?;
        }
        for (value, label) in y.ticks() {
            let at = y.place(value);
            writeln!(out, "<path fill=\"none\" class=\"t\" d=\"M{left} {at:.1}H{right}\"/>")?;
            writeln!(out, "<text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{label}</text>", left - 5.0, at + 4.0)?;
        }
        writeln!(out, "<path fill=\"none\" class=\"a\" d=\"M{left} {top}V{bottom}H{right}\"/>")?;
        let middle = 0.5 * (left + right);
        let (below, label) = (bottom + 34.0, escape(&self.x.label));
        writeln!(out, "<text x=\"{middle}\" y=\"{below}\" text-anchor=\"middle\">{label}</text>")?;
        let (middle, label) = (0.5 * (top + bottom), escape(&self.y.label));
        writeln!(out, "<text text-anchor=\"middle\" transform=\"translate(14 {middle}) rotate(-90)\">{label}</text>")?;
        for (at, series) in self.series.iter().enumerate() {
            let colour = COLOURS[at % COLOURS.len()];
            let shown: Vec<(f64, f64)> = series.points.iter().copied().filter(can_show).collect();
            let every = shown.len().div_ceil(MOST_POINTS).max(1);
            let places = shown.iter().step_by(every).map(|(px, py)| (x.place(*px), y.place(*py)));
            let legend_y = top + 14.0 + 15.0 * at as f64;
            let (from, to) = (right - 22.0, right - 4.0);
            match series.mark {
                Mark::Points => {
                    let circles = places.chain([(right - 13.0, legend_y - 4.0)]);
                    for (px, py) in circles {
                        writeln!(
                            out,
                            "<circle fill=\"none\" cx=\"{px:.1}\" cy=\"{py:.1}\" r=\"3.5\" stroke=\"{colour}\"/>"
                        )?;
                    }
                }
                Mark::Line | Mark::Dashes => {
                    let mut path = String::new();
                    for (at, (px, py)) in places.enumerate() {
                        write!(path, "{}{px:.1} {py:.1}", if at == 0 { 'M' } else { 'L' })?;
                    }
                    write!(path, "M{from} {0}H{to}", legend_y - 4.0)?;
                    let dashes = if series.mark == Mark::Dashes { " stroke-dasharray=\"5 3\"" } else { "" };
                    writeln!(out, "<path fill=\"none\" class=\"l\" d=\"{path}\" stroke=\"{colour}\"{dashes}/>")?;
                }
            }
            let name = escape(&series.name);
            writeln!(out, "<text x=\"{}\" y=\"{legend_y}\" text-anchor=\"end\">{name}</text>", right - 27.0)?;
        }
        writeln!(out, "</g>")
    }
}

/// Plots side by side as one SVG.
pub(crate) fn row(charts: &[Chart]) -> String {
    let (width, height) = (SIZE[0] * charts.len() as f64, SIZE[1]);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"sans-serif\" font-size=\"11\">\n<style>.t{{stroke:#ddd}}.a{{stroke:#000}}\
         .l{{stroke-width:1.6}}circle{{stroke-width:1.4}}</style>\n<rect width=\"{width}\" height=\"{height}\" \
         fill=\"#fff\"/>\n"
    );
    for (at, chart) in charts.iter().enumerate() {
        // Writing to a string does not fail.
        let _ = chart.draw(&mut out, SIZE[0] * at as f64);
    }
    out.push_str("</svg>\n");
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart(is_log: bool, points: Vec<(f64, f64)>) -> Chart {
        let axis = |label: &str| Axis { label: label.into(), is_log };
        let series = vec![Series { name: "a < b".into(), mark: Mark::Points, points }];
        Chart { title: "t".into(), x: axis("x"), y: axis("y"), series }
    }

    #[test]
    fn ten_times_is_as_far_anywhere_on_a_log_axis() {
        let scale = Scale::new([0.1, 100.0].into_iter(), true, 0.0, 300.0);
        let (a, b, c) = (scale.place(0.2), scale.place(2.0), scale.place(20.0));
        assert!((b - a - (c - b)).abs() < 1.0e-9 && b > a);
        assert_eq!(scale.ticks().first().map(|tick| tick.1.clone()), Some("0.1".into()));
    }

    #[test]
    fn what_cannot_be_shown_is_left_out() {
        for (is_log, points, circles) in [
            (true, vec![(0.0, 1.0), (1.0, f64::NAN), (2.0, 2.0)], 2),
            (false, vec![(0.0, 1.0), (1.0, 3.0), (f64::INFINITY, 2.0)], 3),
            (false, Vec::new(), 1),
        ] {
            let svg = row(&[chart(is_log, points)]);
            assert_eq!(svg.matches("<circle").count(), circles, "{svg}");
            assert!(svg.contains("a &lt; b") && !svg.contains("NaN") && !svg.contains("inf\""), "{svg}");
        }
    }
}
