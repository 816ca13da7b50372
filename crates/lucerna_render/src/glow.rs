//! The blurred copies of the flames (paper 003, section 5.2).

use crate::data::{Kernel, MAX_TAPS};
use crate::flames::color_pass;
use crate::renderer::FireRenderer;
use crate::targets::Targets;
use lucerna_frame::{Blur, GlowLevel};

/// Standard deviations that a kernel reaches out to.
const REACH: f32 = 3.0;

/// The one-sided weights of a blur, from the centre outwards; they sum to 1 over both sides.
pub(crate) fn weights(blur: Blur, picture_height: u32, divisor: u32) -> ([f32; MAX_TAPS], i32) {
    let mut weights = [0.0; MAX_TAPS];
    let sigma = match blur {
        Blur::Height(fraction) => fraction * picture_height as f32 / divisor as f32,
        Blur::Pixels(pixels) => pixels,
        Blur::Published => {
            for (x, weight) in weights.iter_mut().take(4).enumerate() {
                *weight = (-((x * x) as f32) / (1.5 * 1.5)).exp();
            }
            return (normalised(weights), 3);
        }
    };
    let sigma = sigma.clamp(0.0, (MAX_TAPS - 1) as f32 / REACH);
    let radius = (REACH * sigma).ceil().min((MAX_TAPS - 1) as f32) as i32;
    if sigma < 0.05 {
        weights[0] = 1.0;
        return (weights, 0);
    }
    for (x, weight) in weights.iter_mut().take(radius as usize + 1).enumerate() {
        // Integrated over the texel, not sampled: right for small sigmas, too.
        let edge = |at: f32| erf(at / (sigma * std::f32::consts::SQRT_2));
        *weight = 0.5 * (edge(x as f32 + 0.5) - edge(x as f32 - 0.5));
    }
    (normalised(weights), radius)
}

fn normalised(weights: [f32; MAX_TAPS]) -> [f32; MAX_TAPS] {
    let sum = weights[0] + 2.0 * weights[1..].iter().sum::<f32>();
    weights.map(|w| w / sum)
}

/// The error function to 1.5e-7 (Abramowitz and Stegun 7.1.26).
fn erf(x: f32) -> f32 {
    let t = 1.0 / (1.0 + 0.327_591_1 * x.abs());
    let poly = t * (0.254_829_6 + t * (-0.284_496_74 + t * (1.421_413_7 + t * (-1.453_152_1 + t * 1.061_405_4))));
    (1.0 - poly * (-x * x).exp()).copysign(x)
}

impl FireRenderer {
    pub(crate) fn upload_kernels(queue: &wgpu::Queue, targets: &Targets, levels: &[GlowLevel]) {
        for (target, level) in targets.glow.iter().zip(levels) {
            let (weights, radius) = weights(level.blur, targets.shape.size[1], target.divisor);
            for (buffer, [x, y]) in target.kernels.iter().zip([[1, 0], [0, 1]]) {
                let kernel = Kernel { direction_radius: [x, y, radius, 0], weights };
                queue.write_buffer(buffer, 0, bytemuck::bytes_of(&kernel));
            }
        }
    }

    pub(crate) fn record_glow(&self, targets: &Targets, encoder: &mut wgpu::CommandEncoder) {
        for reduced in &targets.reduced {
            let mut pass = color_pass(encoder, "shrink", &reduced.view);
            if self.scissor(&mut pass, targets, reduced.divisor, [0; 2]) {
                pass.set_pipeline(&self.pipelines.shrink);
                pass.set_bind_group(0, &reduced.group, &[]);
                pass.draw(0..3, 0..1);
            }
        }
        for (level, radius) in targets.glow.iter().zip(self.glow_radii) {
            let passes = [(&level.across, [radius, 0]), (&level.done, [radius; 2])];
            for ((view, reach), group) in passes.into_iter().zip(&level.groups) {
                let mut pass = color_pass(encoder, "blur", view);
                if self.scissor(&mut pass, targets, level.divisor, reach) {
                    pass.set_pipeline(&self.pipelines.blur);
                    pass.set_bind_group(0, group, &[]);
                    pass.draw(0..3, 0..1);
                }
            }
        }
    }

    /// Limits a pass to where the flames are, and `reach` texels around; false if there are none.
    fn scissor(&self, pass: &mut wgpu::RenderPass<'_>, targets: &Targets, divisor: u32, reach: [u32; 2]) -> bool {
        let Some([x, y, width, height]) = self.flame_bounds else { return false };
        let size = targets.shape.reduced(divisor);
        let span = |from: u32, length: u32, reach: u32, size: u32| {
            let begin = (from / divisor).saturating_sub(reach).min(size);
            let end = ((from + length).div_ceil(divisor) + reach).min(size);
            (begin, end - begin)
        };
        let (x, width) = span(x, width, reach[0], size[0]);
        let (y, height) = span(y, height, reach[1], size[1]);
        pass.set_scissor_rect(x, y, width, height);
        width > 0 && height > 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kernels_keep_energy_and_have_the_width_asked_for() {
        for sigma in [0.8_f32, 1.0, 3.2, 12.0, 20.0] {
            let (w, radius) = weights(Blur::Pixels(sigma), 720, 1);
            let sum = w[0] + 2.0 * w[1..].iter().sum::<f32>();
            let variance = 2.0 * w.iter().enumerate().map(|(x, w)| (x * x) as f32 * w).sum::<f32>();
            assert!((sum - 1.0).abs() < 1e-5, "{sigma}: sum {sum}");
            // A texel's own width adds 1/12; cutting at three sigma takes 2.7 % off.
            let expected = sigma * sigma + 1.0 / 12.0;
            assert!((variance - expected).abs() < 0.05 * expected + 0.01, "{sigma}: {variance} vs {expected}");
            assert!(radius < MAX_TAPS as i32);
        }
    }

    #[test]
    fn a_blur_below_a_texel_is_what_falls_into_each_texel() {
        // Half of erfc(0.5 / (0.3 sqrt 2)) lies beyond the centre's edge on either side.
        let (w, _) = weights(Blur::Pixels(0.3), 720, 1);
        assert!((w[1] - 0.0478).abs() < 1e-3 && (w[0] - 0.9044).abs() < 1e-3, "{w:?}");
        assert_eq!(weights(Blur::Pixels(0.0), 720, 1).0[0], 1.0);
    }

    #[test]
    fn published_kernel_has_seven_taps() {
        let (w, radius) = weights(Blur::Published, 720, 4);
        assert_eq!(radius, 3);
        assert!((w[1] / w[0] - (-1.0_f32 / 2.25).exp()).abs() < 1e-6 && w[4] == 0.0);
    }
}
