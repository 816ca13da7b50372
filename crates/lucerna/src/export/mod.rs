//! Flames for other programs: meshes, control nets and lights, written to whatever takes bytes.
//!
//! | what | how |
//! |---|---|
//! | [`write_obj`] | the surfaces of one frame: positions, normals, texture coordinates, one group a flame |
//! | [`GlbSequence`] | the surfaces of many frames in one binary glTF 2.0, shown one after the other |
//! | [`write_nets`] | the control nets of one frame as JSON, for `lucerna_nurbs` |
//! | [`LightTable`] | the lights of many frames as CSV, in candela |
//! | [`FlameTable`] | what each flame gives off: volume, power, centroid, colour, as CSV |
//!
//! Units are those of the frame: metres, seconds, `y` up, linear colours. `docs/export.md` describes the files.
//!
//! ```
//! use lucerna::{World, export};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let mut world = World::new(lucerna::scene::open("candle")?)?;
//! world.step(0.1)?;
//! let mut obj = Vec::new();
//! export::write_obj(&world.frame(), &mut obj)?;
//! assert!(String::from_utf8(obj)?.contains("g flame_0"));
//! # Ok(())
//! # }
//! ```

mod checked;
mod gltf;
mod lights;
mod nets;
mod obj;

pub use gltf::GlbSequence;
pub use lights::{FlameTable, LightTable};
pub use nets::write_nets;
pub use obj::write_obj;

/// Why flames could not be exported.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExportError {
    /// Something that the format cannot hold.
    #[error("{field} is {value}: must be {allowed}")]
    Value {
        /// What it is, as a path from the frame: `flame_vertices[7].position`.
        field: String,
        /// Its value.
        value: String,
        /// What is allowed.
        allowed: &'static str,
    },
    /// The bytes could not be written.
    #[error("cannot write")]
    Write(#[from] std::io::Error),
}

impl ExportError {
    fn value(field: impl Into<String>, value: &impl ToString, allowed: &'static str) -> Self {
        Self::Value { field: field.into(), value: value.to_string(), allowed }
    }
}
