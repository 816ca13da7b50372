//! The rows of the panel: a label on the left, a control on the right, a tooltip on both.

use egui::{ComboBox, DragValue, Grid, Response, Slider, SliderClamping, Ui, emath::Numeric};
use std::ops::RangeInclusive;

/// A folding section of rows.
pub(super) fn section(ui: &mut Ui, title: &str, open: bool, rows: impl FnOnce(&mut Ui)) {
    egui::CollapsingHeader::new(egui::RichText::new(title).strong())
        .default_open(open)
        .show(ui, |ui| table(ui, title, rows));
}

/// Rows in two columns.
pub(super) fn table(ui: &mut Ui, id: &str, rows: impl FnOnce(&mut Ui)) {
    ui.spacing_mut().slider_width = 110.0;
    Grid::new(id).num_columns(2).min_col_width(92.0).spacing([8.0, 5.0]).show(ui, rows);
}

/// A row of any control.
pub(super) fn row(ui: &mut Ui, label: &str, tooltip: &str, control: impl FnOnce(&mut Ui) -> Response) {
    ui.label(label).on_hover_text(tooltip);
    control(ui).on_hover_text(tooltip);
    ui.end_row();
}

/// A slider with a unit.
pub(super) fn slider<N: Numeric>(
    ui: &mut Ui,
    value: &mut N,
    range: RangeInclusive<N>,
    label: &str,
    unit: &str,
    tooltip: &str,
) {
    row(ui, label, tooltip, |ui| ui.add(bare(value, range, unit)));
}

/// A slider with a unit whose every decade is as long.
pub(super) fn log_slider<N: Numeric>(
    ui: &mut Ui,
    value: &mut N,
    range: RangeInclusive<N>,
    label: &str,
    unit: &str,
    tooltip: &str,
) {
    // A range that begins at zero has no decades there: four are enough.
    let smallest = if range.start().to_f64() > 0.0 { range.start().to_f64() } else { range.end().to_f64() * 1e-4 };
    row(ui, label, tooltip, |ui| ui.add(bare(value, range, unit).logarithmic(true).smallest_positive(smallest)));
}

/// A slider keeps what a scene file says, even beyond its own ends.
fn bare<'a, N: Numeric>(value: &'a mut N, range: RangeInclusive<N>, unit: &str) -> Slider<'a> {
    let suffix = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    Slider::new(value, range).suffix(suffix).clamping(SliderClamping::Edits)
}

/// Three numbers with a unit.
pub(super) fn vector<N: Numeric>(
    ui: &mut Ui,
    value: &mut [N; 3],
    range: RangeInclusive<N>,
    (label, unit, speed): (&str, &str, f64),
    tooltip: &str,
) {
    row(ui, label, tooltip, |ui| {
        ui.horizontal(|ui| {
            for component in value {
                ui.add(DragValue::new(component).range(range.clone()).speed(speed).clamp_existing_to_range(false));
            }
            ui.label(unit)
        })
        .response
    });
}

/// A number with a unit that has no natural ends.
pub(super) fn number<N: Numeric>(ui: &mut Ui, value: &mut N, speed: f64, label: &str, unit: &str, tooltip: &str) {
    row(ui, label, tooltip, |ui| ui.add(DragValue::new(value).speed(speed).suffix(format!(" {unit}"))));
}

/// A linear colour.
pub(super) fn color(ui: &mut Ui, value: &mut [f32; 3], label: &str, tooltip: &str) {
    row(ui, label, tooltip, |ui| ui.color_edit_button_rgb(value));
}

/// A switch.
pub(super) fn switch(ui: &mut Ui, value: &mut bool, label: &str, tooltip: &str) {
    row(ui, label, tooltip, |ui| ui.checkbox(value, ""));
}

/// One of a few values.
pub(super) fn choice<T: Clone + PartialEq>(
    ui: &mut Ui,
    value: &mut T,
    options: &[(&str, T)],
    label: &str,
    tooltip: &str,
) {
    let selected = options.iter().position(|(_, option)| option == value);
    if let Some(chosen) = pick(ui, selected, options.iter().map(|(text, _)| *text), label, tooltip) {
        *value = options[chosen].1.clone();
    }
}

/// One of a few names; gives the index of a newly picked one.
pub(super) fn pick<'a>(
    ui: &mut Ui,
    selected: Option<usize>,
    names: impl Iterator<Item = &'a str>,
    label: &str,
    tooltip: &str,
) -> Option<usize> {
    let names: Vec<&str> = names.collect();
    let shown = selected.and_then(|index| names.get(index)).copied().unwrap_or("choose");
    let mut chosen = None;
    row(ui, label, tooltip, |ui| {
        ComboBox::from_id_salt((label, ui.scope_id()))
            .width(150.0)
            .selected_text(shown)
            .show_ui(ui, |ui| {
                for (index, name) in names.iter().enumerate() {
                    if ui.selectable_label(selected == Some(index), *name).clicked() {
                        chosen = Some(index);
                    }
                }
            })
            .response
    });
    chosen
}

/// A fact: a name and what it is.
pub(super) fn fact(ui: &mut Ui, label: &str, value: &str, tooltip: &str) {
    row(ui, label, tooltip, |ui| ui.monospace(value));
}
