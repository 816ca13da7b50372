//! A box of air under a lid that slides along, at a Reynolds number of 100: `cargo run --release
//! -p lucerna_fluid --example cavity` plots the velocity along the upright middle line against
//! published values to `target/cavity/centreline.svg`.

use std::{error::Error, fs};

use lucerna_fluid::{Fluid, Side, SideAt, Sides, Vec3};
use plotters::prelude::*;

#[allow(dead_code, reason = "the validation plots more")]
#[path = "validate/published.rs"]
mod published;

const CELLS: usize = 64;

fn main() -> Result<(), Box<dyn Error>> {
    let edge = 1.0 / CELLS as f32;
    let walls = [Side::NoSlip; 2];
    let mut air = Fluid::builder([CELLS, CELLS, 1])
        .size_m(Vec3::new(1.0, 1.0, edge))
        .sides(Sides { x: walls, y: walls, ..Sides::CLOSED })
        .viscosity_m2_s(0.01)
        .build()?;
    air.set_side_velocity(SideAt::Top, |_| Vec3::X)?;
    for _ in 0..25 * CELLS {
        air.step(edge)?;
    }
    let along = |height: f64| f64::from(air.velocity(Vec3::new(0.5, height as f32, 0.5 * edge)).x);
    // Samples end at the last centres; the walls' velocities are given.
    let inside = (0..CELLS).map(|cell| (cell as f64 + 0.5) / CELLS as f64).map(|height| (along(height), height));
    let line = [(0.0, 0.0)].into_iter().chain(inside).chain([(1.0, 1.0)]);

    fs::create_dir_all("target/cavity")?;
    let area = SVGBackend::new("target/cavity/centreline.svg", (480, 480)).into_drawing_area();
    area.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&area)
        .caption("Lid-driven cavity, Re 100, 64 x 64 cells", ("sans-serif", 18))
        .margin(12)
        .x_label_area_size(36)
        .y_label_area_size(44)
        .build_cartesian_2d(-0.4..1.0, 0.0..1.0)?;
    chart.configure_mesh().x_desc("velocity along the lid, of the lid's").y_desc("height, of the box").draw()?;
    chart.draw_series(LineSeries::new(line, &BLUE))?.label("here");
    let points = published::GHIA_100_U.iter().map(|(height, value)| Circle::new((*value, *height), 3, RED));
    chart.draw_series(points)?.label("Ghia, Ghia and Shin 1982");
    area.present()?;
    let off =
        published::GHIA_100_U.iter().fold(0.0, |most: f64, (height, value)| most.max((along(*height) - value).abs()));
    println!("target/cavity/centreline.svg: off the published values by {off:.4} of the lid's speed");
    Ok(())
}
