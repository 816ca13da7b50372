//! Writes a rational torus and a closed flame to OBJ files in `target/nurbs_alone`.

use lucerna_nurbs::{Closure, GridOptions, GridPlan, KnotVector, Surface};
use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;
use std::{env, fs};

fn main() -> Result<(), Box<dyn Error>> {
    let torus = Surface::torus([0.0; 3], 3.0, 1.0)?;
    let joined = GridOptions { closure_u: Closure::Joined, closure_v: Closure::Joined, ..GridOptions::default() };
    let plan = GridPlan::new(torus.knots_u(), torus.knots_v(), joined)?;
    write_obj("torus", &plan, torus.points(), torus.weights())?;

    // A flame over a wick: ten rows around it, pinched to the line of the wick below and above.
    let around = KnotVector::periodic(3, 10)?;
    let along = KnotVector::clamped_uniform(3, 8)?;
    let options = GridOptions { closure_u: Closure::Periodic { start_row: 0 }, ..joined };
    let options = GridOptions { closure_v: Closure::Open, ..options };
    let leads = [0., 0., 1., 2., 3., 3., 3., 2., 1., 0.];
    let sides = [0., 1., 1., 1., 1., 0., -1., -1., -1., -1.];
    let ends = [-1., 0., 0., 0., 0., 1., 0., 0., 0., 0.];
    let widths = [0., 0.8, 1., 0.9, 0.7, 0.5, 0.3, 0.];
    let net: Vec<[f32; 3]> = (0..80)
        .map(|k| (k / 8, k % 8))
        .map(|(i, j)| [leads[i] + widths[j] * ends[i], j as f32 * 0.6, widths[j] * sides[i]])
        .collect();
    write_obj("flame", &GridPlan::new(&around, &along, options)?, &net, None)
}

fn write_obj(
    name: &str,
    plan: &GridPlan<f32>,
    points: &[[f32; 3]],
    weights: Option<&[f32]>,
) -> Result<(), Box<dyn Error>> {
    let mut text = String::new();
    plan.evaluate(points, weights, &mut plan.scratch(), |_, vertex| {
        let ([x, y, z], [nx, ny, nz]) = (vertex.position, vertex.normal);
        // Writing to a string cannot fail.
        let _ = writeln!(text, "v {x} {y} {z}\nvt {} {}\nvn {nx} {ny} {nz}", vertex.u, vertex.v);
    })?;
    for triangle in plan.indices().chunks_exact(3) {
        let [a, b, c] = [triangle[0] + 1, triangle[1] + 1, triangle[2] + 1];
        writeln!(text, "f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}")?;
    }
    let target = env::var_os("CARGO_TARGET_DIR").unwrap_or_else(|| "target".into());
    let folder = Path::new(&target).join("nurbs_alone");
    fs::create_dir_all(&folder)?;
    let path = folder.join(name).with_extension("obj");
    fs::write(&path, text)?;
    println!("{}: {} vertices", path.display(), plan.vertex_count());
    Ok(())
}
