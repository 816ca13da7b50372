//! Makes the meshes of the built-in scenes: `cargo run -p lucerna_scene --example make_assets`.
//!
//! Everything is a function of fixed seeds: running it again writes the same files.

mod campfire;
mod candle;
mod hall;
mod mesh;
mod noise;
mod torch;

use std::path::Path;

fn main() -> std::io::Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let parts = candle::parts().into_iter().chain(torch::parts()).chain(campfire::parts()).chain(hall::parts());
    for (name, text) in parts {
        println!("{name}: {} kB", text.len() / 1000);
        std::fs::write(folder.join(name), text)?;
    }
    Ok(())
}
