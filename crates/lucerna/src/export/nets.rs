//! Control nets of one moment as JSON.

use super::ExportError;
use lucerna_flame::{ControlNet, Flames};
use lucerna_nurbs::{GridOptions, KnotVector};
use serde::Serialize;
use std::io::Write;

#[derive(Serialize)]
struct Moment<'a> {
    time_s: f64,
    nets: Vec<Net<'a>>,
}

/// Knots and grid are written as `lucerna_nurbs` reads them.
#[derive(Serialize)]
struct Net<'a> {
    flame: usize,
    free: bool,
    rows: usize,
    columns: usize,
    knots_u: &'a KnotVector<f32>,
    knots_v: &'a KnotVector<f32>,
    grid: GridOptions,
    points: &'a [[f32; 3]],
}

impl<'a> Net<'a> {
    fn new((flame, net): (usize, ControlNet<'a>)) -> Self {
        let ControlNet { knots_u, knots_v, grid, points, is_free: free } = net;
        let columns = knots_v.count();
        Self { flame, free, rows: points.len() / columns, columns, knots_u, knots_v, grid, points }
    }
}

/// Writes the control nets of all flames, with their knots and the grids on which their vertices are made: enough for
/// `lucerna_nurbs` to make the same vertices.
///
/// # Errors
/// When `out` fails.
pub fn write_nets(flames: &Flames, mut out: impl Write) -> Result<(), ExportError> {
    let nets = flames.control_nets().enumerate().map(Net::new).collect();
    serde_json::to_writer(&mut out, &Moment { time_s: flames.time_s(), nets }).map_err(std::io::Error::from)?;
    writeln!(out)?;
    Ok(())
}
