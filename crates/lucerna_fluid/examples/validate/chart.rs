//! Line charts as SVG.

use std::fs;
use std::path::Path;

use plotters::prelude::*;
use plotters::style::FontFamily;

use crate::Outcome;

/// Colours that remain apart for most colour-blind eyes (Okabe and Ito).
const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 0, 0),
    RGBColor(213, 94, 0),
    RGBColor(0, 114, 178),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
];

/// The library draws in whole pixels: draw larger, then let the reader's program make it small.
const FINE: u32 = 4;
/// One pixel of the finished picture.
const PIXEL: i32 = FINE as i32;

/// How a series is drawn.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Mark {
    /// A line through the points: what was computed.
    Line,
    /// Circles: published values.
    Points,
}

/// Points with a name in the legend, or without one. Series of one colour number share a colour.
pub(crate) struct Series {
    pub(crate) name: String,
    pub(crate) colour: usize,
    pub(crate) mark: Mark,
    pub(crate) points: Vec<(f64, f64)>,
}

/// A chart.
pub(crate) struct Chart<'a> {
    pub(crate) title: &'a str,
    pub(crate) x: (&'a str, [f64; 2]),
    pub(crate) y: (&'a str, [f64; 2]),
    /// Whether x are powers of two and y powers of ten, to be labelled as a count and in percent.
    pub(crate) has_log_axes: bool,
    pub(crate) legend: SeriesLabelPosition,
    pub(crate) series: Vec<Series>,
}

impl Chart<'_> {
    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, plotters::coord::Shift>) -> Outcome<()>
    where
        B::ErrorType: 'static,
    {
        let font = |size: i32| (FontFamily::SansSerif, PIXEL * size).into_font();
        area.draw_text(self.title, &font(16).color(&BLACK), (56 * PIXEL, 8 * PIXEL))?;
        let mut chart = ChartBuilder::on(&area.margin(24 * PIXEL, 0, 0, 0))
            .margin(12 * PIXEL)
            .x_label_area_size(40 * PIXEL)
            .y_label_area_size(56 * PIXEL)
            .build_cartesian_2d(self.x.1[0]..self.x.1[1], self.y.1[0]..self.y.1[1])?;
        chart
            .configure_mesh()
            .x_desc(self.x.0)
            .y_desc(self.y.0)
            .x_labels(6)
            .y_labels(6)
            .x_label_formatter(&|x| if self.has_log_axes { count_label(*x) } else { label(*x) })
            .y_label_formatter(&|y| if self.has_log_axes { percent_label(*y) } else { label(*y) })
            .axis_desc_style(font(14))
            .label_style(font(12))
            .light_line_style(TRANSPARENT)
            .bold_line_style(BLACK.mix(0.12).stroke_width(FINE))
            .axis_style(BLACK.stroke_width(FINE))
            .set_all_tick_mark_size(5 * PIXEL)
            .draw()?;
        for series in &self.series {
            let colour = COLOURS[series.colour % COLOURS.len()];
            let points = series.points.iter().copied();
            let drawn = match series.mark {
                Mark::Line => chart.draw_series(LineSeries::new(points, colour.stroke_width(2 * FINE)))?,
                Mark::Points => {
                    chart.draw_series(points.map(|point| Circle::new(point, 4 * PIXEL, colour.stroke_width(FINE))))?
                }
            };
            if !series.name.is_empty() {
                drawn.label(series.name.as_str());
            }
            match series.mark {
                _ if series.name.is_empty() => {}
                Mark::Line => {
                    drawn.legend(move |(x, y)| {
                        PathElement::new([(x, y), (x + 18 * PIXEL, y)], colour.stroke_width(2 * FINE))
                    });
                }
                Mark::Points => {
                    drawn.legend(move |(x, y)| Circle::new((x + 9 * PIXEL, y), 4 * PIXEL, colour.stroke_width(FINE)));
                }
            }
        }
        chart
            .configure_series_labels()
            .position(self.legend.clone())
            .background_style(WHITE.mix(0.85))
            .border_style(BLACK.mix(0.2).stroke_width(FINE))
            .margin(8 * PIXEL)
            .legend_area_size(28 * PIXEL)
            .label_font(font(12))
            .draw()?;
        Ok(())
    }
}

/// One decimal place, and no minus before a zero that rounding has left.
fn label(value: f64) -> String {
    format!("{:.1}", (10.0 * value).round() / 10.0 + 0.0)
}

/// A whole power of two.
fn count_label(power: f64) -> String {
    if power.fract() == 0.0 { format!("{:.0}", power.exp2()) } else { String::new() }
}

/// A whole power of ten, in percent.
fn percent_label(power: f64) -> String {
    if power.fract() == 0.0 { format!("{}", 10.0_f64.powf(power + 2.0)) } else { String::new() }
}

/// Writes charts side by side.
pub(crate) fn write_row(path: &Path, charts: &[Chart<'_>]) -> Outcome<()> {
    let (width, height) = (520 * charts.len() as u32, 400);
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (FINE * width, FINE * height)).into_drawing_area();
        root.fill(&WHITE)?;
        for (area, chart) in root.split_evenly((1, charts.len())).iter().zip(charts) {
            chart.draw(area)?;
        }
        root.present()?;
    }
    let drawn = format!("width=\"{}\" height=\"{}\"", FINE * width, FINE * height);
    fs::write(path, svg.replacen(&drawn, &format!("width=\"{width}\" height=\"{height}\""), 1))?;
    Ok(())
}
