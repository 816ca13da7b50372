//! Black-body colours: Planck's law through the CIE 1931 observer to linear sRGB.

use glam::{Mat3, Vec3};

/// Second radiation constant, m K (paper 000 prints 1.4388e-2).
const C2_M_K: f64 = 1.438_777e-2;

/// First radiation constant for radiance, 2 h c^2, W m^2 / sr.
const C1L_W_M2: f64 = 1.191_043e-16;

/// Luminous efficacy of light at 540 THz, lm/W: the definition of the candela.
const EFFICACY_LM_W: f64 = 683.002;

/// The temperature whose luminance is 1.
const REFERENCE_K: f64 = 1800.0;

/// Distance of the wavelengths that are summed, nm.
const STEP_NM: f64 = 4.7;

/// Linear sRGB from CIE XYZ (IEC 61966-2-1), columns.
const SRGB_FROM_XYZ: Mat3 = Mat3::from_cols_array(&[
    3.240_97,
    -0.969_243_7,
    0.055_630_08,
    -1.537_383_2,
    1.875_967_5,
    -0.203_976_96,
    -0.498_610_76,
    0.041_555_06,
    1.056_971_5,
]);

/// The colour of a black body in linear sRGB, as radiance relative to the luminance at 1800 K.
///
/// Temperatures are clamped to 500..20000 K. The blue channel is negative below about 1900 K because such
/// colours lie outside of sRGB; adapt to a camera's white first ([`adaptation`]) and clamp afterwards.
#[must_use]
pub fn blackbody_rgb(temperature_k: f32) -> Vec3 {
    let scale = 1.0 / blackbody_xyz(REFERENCE_K)[1];
    let [x, y, z] = blackbody_xyz(f64::from(temperature_k)).map(|v| (v * scale) as f32);
    SRGB_FROM_XYZ * Vec3::new(x, y, z)
}

/// The luminance that radiances call 1, that of a black body of 1800 K: about 1.18e5 cd/m^2.
#[must_use]
pub fn unit_luminance_cd_m2() -> f32 {
    luminance_cd_m2(REFERENCE_K) as f32
}

/// Luminance of a black body, cd/m^2.
fn luminance_cd_m2(temperature_k: f64) -> f64 {
    EFFICACY_LM_W * C1L_W_M2 * 1e28 * STEP_NM * 1e-9 * blackbody_xyz(temperature_k)[1]
}

/// CIE 1931 chromaticity (x, y) of a black body.
#[must_use]
pub fn blackbody_chromaticity(temperature_k: f32) -> [f32; 2] {
    let [x, y, z] = blackbody_xyz(f64::from(temperature_k));
    [(x / (x + y + z)) as f32, (y / (x + y + z)) as f32]
}

/// The matrix that makes light of `white_k` look white, in linear sRGB (Bradford adaptation to D65).
#[must_use]
pub fn adaptation(white_k: f32) -> Mat3 {
    let bradford = Mat3::from_cols_array(&[0.8951, -0.7502, 0.0389, 0.2664, 1.7135, -0.0685, -0.1614, 0.0367, 1.0296]);
    let [x, y, z] = blackbody_xyz(f64::from(white_k));
    let from = bradford * Vec3::new((x / y) as f32, 1.0, (z / y) as f32);
    let to = bradford * Vec3::new(0.950_47, 1.0, 1.088_83);
    SRGB_FROM_XYZ * bradford.inverse() * Mat3::from_diagonal(to / from) * bradford * SRGB_FROM_XYZ.inverse()
}

/// Planck's radiance (paper 000, section 4) integrated with the observer, in an arbitrary unit.
fn blackbody_xyz(temperature_k: f64) -> [f64; 3] {
    let temperature_k = if temperature_k.is_finite() { temperature_k.clamp(500.0, 20_000.0) } else { REFERENCE_K };
    let mut xyz = [0.0; 3];
    for step in 0..=100 {
        let nm = 360.0 + STEP_NM * f64::from(step);
        let m = nm * 1e-9;
        let radiance = 1e-28 / (m.powi(5) * (C2_M_K / (m * temperature_k)).exp_m1());
        for (sum, weight) in xyz.iter_mut().zip(observer(nm)) {
            *sum += radiance * weight;
        }
    }
    xyz
}

/// The CIE 1931 2-degree observer, in the analytic fit of Wyman, Sloan and Shirley (JCGT 2013, equation 4).
fn observer(nm: f64) -> [f64; 3] {
    let lobe = |center: f64, below: f64, above: f64| {
        let t = (nm - center) / if nm < center { below } else { above };
        (-0.5 * t * t).exp()
    };
    [
        1.056 * lobe(599.8, 37.9, 31.0) + 0.362 * lobe(442.0, 16.0, 26.7) - 0.065 * lobe(501.1, 20.4, 26.2),
        0.821 * lobe(568.8, 46.9, 40.5) + 0.286 * lobe(530.9, 16.3, 31.1),
        1.217 * lobe(437.0, 11.8, 36.0) + 0.681 * lobe(459.0, 26.0, 13.8),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chromaticities_lie_on_the_published_planckian_locus() {
        let published =
            [(1500.0, 0.5857, 0.3931), (2000.0, 0.5267, 0.4133), (2500.0, 0.4770, 0.4137), (6500.0, 0.3135, 0.3237)];
        for (kelvin, x, y) in published {
            let [got_x, got_y] = blackbody_chromaticity(kelvin);
            assert!((got_x - x).abs() < 0.005 && (got_y - y).abs() < 0.005, "{kelvin} K: {got_x} {got_y}");
        }
    }

    #[test]
    fn a_black_body_of_freezing_platinum_has_sixty_candela_a_square_centimetre() {
        // The definition of the candela from 1946 to 1979, at 2041.4 K (ITS-90).
        let got = luminance_cd_m2(2041.4);
        println!("{got:.0} cd/m^2 of 600000, {:.0} at 1800 K", unit_luminance_cd_m2());
        assert!((got / 6e5 - 1.0).abs() < 0.01, "{got}");
    }

    #[test]
    fn adapted_white_is_white_and_luminance_grows_with_temperature() {
        let white = adaptation(3200.0) * blackbody_rgb(3200.0);
        assert!((white / white.y - Vec3::ONE).abs().max_element() < 2e-3, "{white}");
        let luminance = |k| blackbody_rgb(k).dot(Vec3::new(0.2126, 0.7152, 0.0722));
        assert!((luminance(1800.0) - 1.0).abs() < 1e-3);
        assert!(luminance(1700.0) < luminance(1800.0) && luminance(f32::NAN).is_finite());
    }
}
