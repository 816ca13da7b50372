//! Draws the pictures of `docs/nurbs.md`: `cargo run --release -p lucerna_nurbs --example pictures [FOLDER]`.
//!
//! Surfaces are tessellated by this crate and drawn from back to front; nothing else is needed.

mod curves;
mod surfaces;
mod svg;

use std::error::Error;
use std::path::Path;
use std::{env, fs};

fn main() -> Result<(), Box<dyn Error>> {
    let plots = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/plots");
    let folder = env::args().nth(1).map_or(plots, Into::into);
    fs::create_dir_all(&folder)?;
    for (name, picture) in [("nurbs_curves.svg", curves::draw()?), ("nurbs_surfaces.svg", surfaces::draw()?)] {
        let path = folder.join(name);
        fs::write(&path, picture)?;
        println!("{}", path.display());
    }
    Ok(())
}
