//! A cylinder in a channel sheds eddies: `cargo run --release -p lucerna_fluid --example
//! vortex_street` writes the vorticity to `target/vortex_street/` and prints how often.
//!
//! The channel of M. Schäfer and S. Turek, *Benchmark Computations of Laminar Flow Around a
//! Cylinder*, 1996, case 2D-2: Reynolds number 100, the cylinder fills 0.244 of the height.
//! They give a Strouhal number of 0.295 to 0.305.

use std::{error::Error, fs, io::BufWriter, path::Path};

use lucerna_fluid::{Fluid, Obstacle, Side, SideAt, Sides, Vec3};

const CELLS: [usize; 3] = [330, 62, 1];
const SIZE_M: Vec3 = Vec3::new(2.2, 0.41, 0.01);
const CENTRE: Vec3 = Vec3::new(0.2, 0.2, 0.0);
const DIAMETER_M: f32 = 0.1;
const MEAN_M_S: f32 = 1.0;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = Path::new("target/vortex_street");
    fs::create_dir_all(folder)?;
    let sides = Sides { x: [Side::Inflow, Side::Open], y: [Side::NoSlip; 2], ..Sides::CLOSED };
    let mut air = Fluid::builder(CELLS).size_m(SIZE_M).sides(sides).viscosity_m2_s(1.0e-3).build()?;
    let parabola = |point: Vec3| {
        let share = point.y / SIZE_M.y;
        Vec3::X * 6.0 * MEAN_M_S * share * (1.0 - share)
    };
    air.set_side_velocity(SideAt::Left, parabola)?;
    air.fill_velocity(parabola)?;
    air.set_obstacles(&[Obstacle::cylinder(CENTRE - Vec3::Z, CENTRE + Vec3::Z, 0.5 * DIAMETER_M)])?;
    let (dt_s, probe) = (1.0 / 240.0, CENTRE + Vec3::new(0.15, 0.0, 0.005));
    let (mut crossings, mut last) = (Vec::new(), 0.0);
    for step in 0..1920 {
        air.step(dt_s)?;
        let across = air.velocity(probe).y;
        let time_s = (step + 1) as f32 * dt_s;
        // An eddy of each kind a period; the first seconds are the start.
        if last < 0.0 && across >= 0.0 && time_s > 4.0 {
            crossings.push(time_s - dt_s * across / (across - last));
        }
        last = across;
        if step % 480 == 479 {
            let path = folder.join(format!("vorticity_{step:04}.png"));
            write_vorticity(&path, &air)?;
            println!("{}", path.display());
        }
    }
    if let [first, .., last] = crossings[..] {
        let period_s = (last - first) / (crossings.len() - 1) as f32;
        println!("Strouhal number {:.3}; published 0.295 to 0.305", DIAMETER_M / (MEAN_M_S * period_s));
    }
    Ok(())
}

/// Vorticity: blue clockwise, red against it, grey the cylinder.
fn write_vorticity(path: &Path, air: &Fluid) -> Result<(), Box<dyn Error>> {
    let (width, height) = (4 * CELLS[0], 4 * CELLS[1]);
    let mut pixels = Vec::with_capacity(3 * width * height);
    for row in 0..height {
        for column in 0..width {
            let share = Vec3::new((column as f32 + 0.5) / width as f32, 1.0 - (row as f32 + 0.5) / height as f32, 0.5);
            let point = SIZE_M * share;
            let turn = (air.vorticity_at(point).z / 60.0).clamp(-1.0, 1.0);
            let is_solid = (point - CENTRE).truncate().length() < 0.5 * DIAMETER_M;
            let colour = [1.0 + turn.min(0.0), 1.0 - turn.abs(), 1.0 - turn.max(0.0)];
            pixels.extend(if is_solid { [90; 3] } else { colour.map(|share| (255.0 * share) as u8) });
        }
    }
    let mut encoder = png::Encoder::new(BufWriter::new(fs::File::create(path)?), width as u32, height as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header()?.write_image_data(&pixels)?;
    Ok(())
}
