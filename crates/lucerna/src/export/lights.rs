//! The lights of flames as a table.

use super::ExportError;
use glam::Vec3;
use lucerna_flame::Flames;
use lucerna_frame::unit_luminance_cd_m2;
use std::io::Write;

/// Luminance of linear sRGB (IEC 61966-2-1).
const LUMINANCE: Vec3 = Vec3::new(0.212_639, 0.715_168_7, 0.072_192_32);

/// Writes the lights that the renderer gets as CSV, a row for each light and moment.
///
/// Columns: `time_s`; `group`, of flames whose wicks overlap; `part` of the group, from 0 at the root to 2 at the tip
/// (parts that are dark are left out); the centroid `x_m`, `y_m`, `z_m` of the luminous gas and the standard deviation
/// `radius_m` of its distance from there; the luminous intensity `intensity_cd`, the same in all directions; and the
/// colour `red`, `green`, `blue` in linear sRGB with luminance 1, as it is, without a camera's white balance: the blue
/// of cool flames is negative, outside of sRGB.
#[derive(Debug)]
pub struct LightTable<W> {
    out: W,
}

impl<W: Write> LightTable<W> {
    /// Begins a table.
    ///
    /// # Errors
    /// When `out` fails.
    pub fn new(mut out: W) -> Result<Self, ExportError> {
        writeln!(out, "time_s,group,part,x_m,y_m,z_m,radius_m,intensity_cd,red,green,blue")?;
        Ok(Self { out })
    }

    /// Adds the lights of this moment.
    ///
    /// # Errors
    /// When `out` fails.
    pub fn push(&mut self, flames: &Flames) -> Result<(), ExportError> {
        for (light, [group, part]) in flames.lights().iter().zip(flames.light_parts()) {
            let ([x, y, z], radius) = (light.position, light.radius_m);
            let luminance = Vec3::from(light.intensity).dot(LUMINANCE).max(0.0);
            // A tint can leave nothing to be seen.
            let scale = if luminance > 0.0 { 1.0 / luminance } else { 0.0 };
            let [red, green, blue] = light.intensity.map(|channel| channel * scale);
            let candela = luminance * unit_luminance_cd_m2();
            let time_s = flames.time_s();
            writeln!(self.out, "{time_s:.6},{group},{part},{x},{y},{z},{radius},{candela},{red},{green},{blue}")?;
        }
        Ok(())
    }

    /// Ends the table.
    ///
    /// # Errors
    /// When `out` fails.
    pub fn finish(mut self) -> Result<(), ExportError> {
        Ok(self.out.flush()?)
    }
}
