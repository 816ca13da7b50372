//! A hot plume without any drawing: `cargo run --release -p lucerna_fluid --example solver_alone`
//! writes slices through its middle to `target/solver_alone/`.

use std::{error::Error, fs, io::BufWriter, path::Path};

use lucerna_fluid::{Fluid, Side, Sides, Vec3};

const CELLS: [usize; 3] = [48, 72, 48];
const PIXELS_PER_CELL: usize = 6;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = Path::new("target/solver_alone");
    fs::create_dir_all(folder)?;
    let mut air = Fluid::builder(CELLS)
        .size_m(Vec3::new(0.8, 1.2, 0.8))
        .sides(Sides { y: [Side::FreeSlip, Side::Open], ..Sides::OPEN })
        .vorticity_confinement(3.0)
        .cooling_per_s(0.6)
        .build()?;
    for frame in 0..180 {
        // A bed of coals: heat that wanders a little, so that the plume sways.
        let sway = 0.03 * (0.11 * frame as f32).sin();
        air.add_heat(Vec3::new(0.4 + sway, 0.06, 0.4 - 0.5 * sway), 0.1, 9000.0)?;
        let report = air.step(1.0 / 60.0)?;
        if frame % 30 == 29 {
            let path = folder.join(format!("plume_{frame:03}.png"));
            write_slice(&path, &air)?;
            println!(
                "{}: {:.1} m/s, {:.0} K above ambient, divergence {:.1e}",
                path.display(),
                report.max_speed_m_s,
                report.max_temperature_k,
                report.divergence_after
            );
        }
    }
    Ok(())
}

/// Temperature in the plane through the middle: black, red, yellow, white from 0 to 600 K.
fn write_slice(path: &Path, air: &Fluid) -> Result<(), Box<dyn Error>> {
    let (width, height) = (CELLS[0] * PIXELS_PER_CELL, CELLS[1] * PIXELS_PER_CELL);
    let mut pixels = Vec::with_capacity(3 * width * height);
    for row in 0..height {
        for column in 0..width {
            let across = (column as f32 + 0.5) / width as f32;
            let up = 1.0 - (row as f32 + 0.5) / height as f32;
            let heat = air.temperature(air.origin() + air.size_m() * Vec3::new(across, up, 0.5)) / 600.0;
            pixels.extend([0.0, 1.0, 2.0].map(|from| (255.0 * (3.0 * heat - from).clamp(0.0, 1.0)) as u8));
        }
    }
    let mut encoder = png::Encoder::new(BufWriter::new(fs::File::create(path)?), width as u32, height as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header()?.write_image_data(&pixels)?;
    Ok(())
}
