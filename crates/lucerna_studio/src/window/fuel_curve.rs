//! The fuel distribution as a curve that is drawn with the mouse.

use egui::{Color32, Pos2, Response, Sense, Stroke, Ui, vec2};
use lucerna::flame::{FuelDistribution, FuelForm};

/// Samples of a curve that is begun.
const SAMPLES: usize = 9;
/// Most samples that are drawn with the mouse.
const MOST: usize = 65;
/// The drawing's size in points.
const SIZE: egui::Vec2 = vec2(220.0, 84.0);

/// A table that begins as another distribution is now; random numbers begin at a half.
pub(super) fn table_of(distribution: &FuelDistribution, form: FuelForm) -> Vec<f32> {
    match distribution {
        FuelDistribution::Table(samples) => samples.clone(),
        other => resampled(SAMPLES, |u| other.value(u, form, 0.5).clamp(0.0, 1.0)),
    }
}

fn resampled(count: usize, value: impl Fn(f32) -> f32) -> Vec<f32> {
    (0..count).map(|i| value(2.0 * i as f32 / (count - 1) as f32 - 1.0)).collect()
}

/// As many samples of the same curve.
fn with_count(samples: &[f32], count: usize) -> Vec<f32> {
    let table = FuelDistribution::Table(samples.to_vec());
    resampled(count.clamp(2, MOST), |u| table.value(u, FuelForm::Normalised, 0.0))
}

/// Draws the curve through a place: `x` and `y` are 0 to 1, and so are the samples' heights in units of `top`. With the
/// place before, samples that the mouse has passed in between change as well.
fn draw(samples: &mut [f32], top: f32, before: Option<[f32; 2]>, [x, y]: [f32; 2]) {
    let last = samples.len().max(2) - 1;
    let near = |x: f32| (x.clamp(0.0, 1.0) * last as f32).round() as usize;
    let (from, to) = (near(before.map_or(x, |b| b[0])), near(x));
    for i in from.min(to)..=from.max(to) {
        let share = match before {
            Some([bx, _]) if (x - bx).abs() > 1e-6 => ((i as f32 / last as f32 - bx) / (x - bx)).clamp(0.0, 1.0),
            _ => 1.0,
        };
        let height = before.map_or(y, |b| b[1] + (y - b[1]) * share);
        if let Some(sample) = samples.get_mut(i) {
            *sample = top * height.clamp(0.0, 1.0);
        }
    }
}

/// Shows the curve, lets the mouse draw it, and offers more or fewer points.
pub(super) fn show(ui: &mut Ui, samples: &mut Vec<f32>) -> Response {
    ui.vertical(|ui| {
        let (response, painter) = ui.allocate_painter(SIZE, Sense::click_and_drag());
        let rect = response.rect.shrink(5.0);
        let top = samples.iter().copied().fold(1.0_f32, f32::max);
        let share = |at: Pos2| [(at.x - rect.left()) / rect.width(), (rect.bottom() - at.y) / rect.height()];
        if let Some(at) = response.interact_pointer_pos().filter(|_| response.is_pointer_button_down_on()) {
            let before = ui.input(|input| at - input.pointer.delta());
            let before = (!response.drag_started()).then(|| share(before));
            draw(samples, top, before, share(at));
        }
        painter.rect_filled(response.rect, 3.0, Color32::from_gray(24));
        let last = samples.len().max(2) - 1;
        let place = |i: usize, value: f32| {
            let x = rect.left() + rect.width() * i as f32 / last as f32;
            egui::pos2(x, rect.bottom() - rect.height() * value / top)
        };
        let places: Vec<Pos2> = samples.iter().enumerate().map(|(i, value)| place(i, *value)).collect();
        let flame = Color32::from_rgb(255, 170, 60);
        painter.line(places.clone(), Stroke::new(1.5, flame));
        for at in places.into_iter().filter(|_| last < 40) {
            painter.circle_filled(at, 3.0, flame);
        }
        ui.horizontal(|ui| {
            for (text, count) in [("Fewer points", samples.len() / 2 + 1), ("More points", samples.len() * 2 - 1)] {
                if ui.small_button(text).clicked() {
                    *samples = with_count(samples, count);
                }
            }
        });
        response
    })
    .inner
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_begins_as_the_distribution_that_it_replaces() {
        let samples = table_of(&FuelDistribution::Linear, FuelForm::Normalised);
        assert_eq!((samples.len(), samples[0], samples[4], samples[8]), (9, 0.0, 0.5, 1.0));
        assert_eq!(with_count(&samples, 17)[15], 0.9375);
        assert_eq!(with_count(&with_count(&samples, 17), 9), samples);
        assert_eq!((with_count(&samples, 0).len(), with_count(&samples, 9999).len()), (2, MOST));
    }

    #[test]
    fn the_mouse_moves_what_it_passes() {
        let mut samples = vec![0.0; 5];
        draw(&mut samples, 1.0, None, [0.27, 0.8]);
        assert_eq!(samples, [0.0, 0.8, 0.0, 0.0, 0.0]);
        draw(&mut samples, 2.0, Some([0.25, 0.0]), [1.0, 0.75]);
        assert_eq!(samples, [0.0, 0.0, 0.5, 1.0, 1.5]);
        draw(&mut samples, 1.0, Some([9.0, 9.0]), [-3.0, -3.0]);
        assert!(samples.iter().all(|s| (0.0..=1.0).contains(s)), "{samples:?}");
    }
}
