//! Flows that viscosity slows without changing their shape, on grids of several sizes: the
//! plane Taylor-Green vortices, and the ABC flow (Arnold, Beltrami, Childress) in three dimensions.

use std::f32::consts::TAU;
use std::path::Path;

use lucerna_fluid::{Fluid, Sides, Vec3};
use plotters::chart::SeriesLabelPosition;

use crate::chart::{Chart, Mark, Series, write_row};
use crate::schemes::SCHEMES;
use crate::{Outcome, Row};

const VISCOSITY_M2_S: f32 = 0.005;
const END_S: f32 = 0.5;

/// A flow of wavelength 1 m with all velocities below about 1 m/s.
type Flow = fn(Vec3) -> Vec3;

/// Error of the energy after half a second, by scheme and grid.
pub(crate) fn run(folder: &Path, rows: &mut Vec<Row>) -> Outcome<()> {
    let cases: [(&str, Flow, f32, bool, &[usize]); 2] = [
        ("Taylor-Green vortices", vortices, 2.0, true, &[16, 32, 64, 128]),
        ("ABC flow", abc, 1.0, false, &[16, 32, 64]),
    ];
    let mut charts = Vec::new();
    for (name, flow, waves, is_plane, sizes) in cases {
        // The Laplacian of the flow is minus the sum of its squared wave numbers times the flow.
        let kept = (-2.0 * f64::from(VISCOSITY_M2_S * waves * TAU * TAU * END_S)).exp();
        let mut series = Vec::new();
        for (at, scheme) in SCHEMES.iter().enumerate() {
            let mut errors = Vec::new();
            for n in sizes.iter().copied() {
                let counts = [n, n, if is_plane { 1 } else { n }];
                let depth = if is_plane { 1.0 / n as f32 } else { 1.0 };
                let z = if is_plane { Sides::CLOSED.z } else { Sides::PERIODIC.z };
                let builder = Fluid::builder(counts)
                    .size_m(Vec3::new(1.0, 1.0, depth))
                    .sides(Sides { z, ..Sides::PERIODIC })
                    .viscosity_m2_s(VISCOSITY_M2_S);
                let mut fluid = (scheme.set)(builder).build()?;
                fluid.fill_velocity(flow)?;
                let before = fluid.mean_kinetic_energy_m2_s2();
                // A Courant number of 1 at the start.
                let steps = (END_S * n as f32).ceil() as usize;
                for _ in 0..steps {
                    fluid.step(END_S / steps as f32)?;
                }
                errors.push((n, (fluid.mean_kinetic_energy_m2_s2() / before / kept - 1.0).abs()));
            }
            let text: Vec<String> = errors.iter().map(|(_, error)| format!("{:.2}", 100.0 * error)).collect();
            let counts: Vec<String> = sizes.iter().map(ToString::to_string).collect();
            rows.push(Row {
                what: format!(
                    "viscous {name}, {}, grids of {} cells an axis: error of the energy after it has fallen to {kept:.2}",
                    scheme.name,
                    counts.join(", ")
                ),
                measured: format!("{} %", text.join(", ")),
                reference: "exact solution of Navier and Stokes".into(),
            });
            let points = errors.into_iter().map(|(n, error)| ((n as f64).log2(), error.max(1.0e-5).log10())).collect();
            series.push(Series { name: scheme.name.into(), colour: at + 1, mark: Mark::Line, points });
        }
        charts.push((format!("Viscous {name}, t = 0.5 s, CFL 1"), series));
    }
    let charts: Vec<Chart<'_>> = charts
        .iter_mut()
        .map(|(title, series)| Chart {
            title,
            x: ("cells an axis", [4.0, 7.0]),
            y: ("error of the energy, %", [-4.0, 0.0]),
            has_log_axes: true,
            legend: SeriesLabelPosition::LowerLeft,
            series: std::mem::take(series),
        })
        .collect();
    write_row(&folder.join("viscous_decay.svg"), &charts)
}

fn vortices(point: Vec3) -> Vec3 {
    let [x, y, _] = (TAU * point).to_array();
    Vec3::new(x.sin() * y.cos(), -x.cos() * y.sin(), 0.0)
}

fn abc(point: Vec3) -> Vec3 {
    let [x, y, z] = (TAU * point).to_array();
    0.5 * Vec3::new(z.sin() + y.cos(), x.sin() + z.cos(), y.sin() + x.cos())
}
