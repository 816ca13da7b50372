//! The lights of flames as a table.

use super::ExportError;
use glam::Vec3;
use lucerna_flame::Flames;
use lucerna_frame::unit_luminance_cd_m2;
use std::io::Write;

/// Luminance of linear sRGB (IEC 61966-2-1).
const LUMINANCE: Vec3 = Vec3::new(0.212_639, 0.715_168_7, 0.072_192_32);

/// Writes what each flame gives off as CSV, a row for each flame and moment.
///
/// Columns: `time_s`; `flame`, its number in the scene; `lit`, 1 or 0; `volume_m3` of the gas that is drawn;
/// `radiated_w`, heat radiated, W, empty for flames of root forces, which have no heat in kilowatts; the centroid `x_m`,
/// `y_m`, `z_m` of the light; its intensity `intensity_cd`; and its colour `red`, `green`, `blue`, as in [`LightTable`].
#[derive(Debug)]
pub struct FlameTable<W> {
    out: W,
}

impl<W: Write> FlameTable<W> {
    /// Begins a table.
    ///
    /// # Errors
    /// When `out` fails.
    pub fn new(mut out: W) -> Result<Self, ExportError> {
        writeln!(out, "time_s,flame,lit,volume_m3,radiated_w,x_m,y_m,z_m,intensity_cd,red,green,blue")?;
        Ok(Self { out })
    }

    /// Adds the flames of this moment.
    ///
    /// # Errors
    /// When `out` fails.
    pub fn push(&mut self, flames: &Flames) -> Result<(), ExportError> {
        let time_s = flames.time_s();
        for (flame, light) in flames.flame_lights().iter().enumerate() {
            let ([x, y, z], volume) = (light.centroid, light.volume_m3);
            let (candela, [red, green, blue]) = candela_and_color(light.intensity);
            let (lit, watts) = (u8::from(light.lit), light.radiated_w.map_or(String::new(), |watts| watts.to_string()));
            writeln!(
                self.out,
                "{time_s:.6},{flame},{lit},{volume},{watts},{x},{y},{z},{candela},{red},{green},{blue}"
            )?;
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

/// Luminous intensity, cd, and the colour of the same with luminance 1.
fn candela_and_color(intensity: [f32; 3]) -> (f32, [f32; 3]) {
    let luminance = Vec3::from(intensity).dot(LUMINANCE).max(0.0);
    // A tint can leave nothing to be seen.
    let scale = if luminance > 0.0 { 1.0 / luminance } else { 0.0 };
    (luminance * unit_luminance_cd_m2(), intensity.map(|channel| channel * scale))
}

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
            let (candela, [red, green, blue]) = candela_and_color(light.intensity);
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
