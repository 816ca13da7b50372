//! Smoke in a plane: `cargo run --release -p lucerna_fluid --example smoke_2d` writes
//! `target/smoke_2d.png`. One axis has a single cell, so that nothing moves along it.

use std::{error::Error, fs::File, io::BufWriter};

use lucerna_fluid::{Advection, Fluid, Side, Sides, Vec3};

const CELLS: [usize; 3] = [160, 240, 1];
const PIXELS_PER_CELL: usize = 3;

fn main() -> Result<(), Box<dyn Error>> {
    let mut air = Fluid::builder(CELLS)
        .size_m(Vec3::new(1.6, 2.4, 0.01))
        .sides(Sides { x: [Side::Open; 2], y: [Side::FreeSlip, Side::Open], z: [Side::FreeSlip; 2] })
        .advection(Advection::Reflection)
        .cooling_per_s(0.3)
        .scalar("soot")
        .build()?;
    let soot = air.scalar_id("soot").ok_or("the builder was given it")?;
    for step in 0..240 {
        let sway = 0.02 * (0.21 * step as f32).sin();
        let point = Vec3::new(0.8 + sway, 0.1, 0.005);
        air.add_heat(point, 0.08, 900.0)?;
        air.add_scalar(soot, point, 0.08, 6.0)?;
        let report = air.step(1.0 / 60.0)?;
        if step % 60 == 59 {
            println!("{:.1} s: {:.1} m/s, CFL {:.1}", (step + 1) as f32 / 60.0, report.max_speed_m_s, report.cfl);
        }
    }
    let (width, height) = (CELLS[0] * PIXELS_PER_CELL, CELLS[1] * PIXELS_PER_CELL);
    let mut pixels = Vec::with_capacity(width * height);
    for row in 0..height {
        for column in 0..width {
            let across = Vec3::new(column as f32 + 0.5, (height - row) as f32 - 0.5, 0.5);
            let point = air.origin() + across * air.cell_size_m() / PIXELS_PER_CELL as f32;
            // Light that is left behind the smoke.
            pixels.push((255.0 * (-2.5 * air.scalar(soot, point)).exp()) as u8);
        }
    }
    let path = "target/smoke_2d.png";
    let mut encoder = png::Encoder::new(BufWriter::new(File::create(path)?), width as u32, height as u32);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.write_header()?.write_image_data(&pixels)?;
    println!("{path}");
    Ok(())
}
