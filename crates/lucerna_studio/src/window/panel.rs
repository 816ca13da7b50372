//! The panel: its sections stand in the order in which a picture is made.

use super::app::View;
use super::document::Document;
use super::meters::Meters;
use super::wick_edit::WickEdit;
use super::{
    panel_air, panel_camera, panel_fire, panel_picture, panel_scene, panel_shade, panel_statistics, panel_wicks,
};
use egui::{Color32, ScrollArea, Ui};
use lucerna::World;

/// Shows the panel and changes the edited scene.
pub(super) fn show(
    ui: &mut Ui,
    document: &mut Document,
    edit: &mut WickEdit,
    view: &mut View,
    meters: &Meters,
    world: &World,
    adapter: &str,
) {
    ui.add_space(6.0);
    if let Some(error) = &document.error {
        ui.colored_label(Color32::from_rgb(255, 120, 100), format!("Not applied: {error}"));
    }
    if let Some(notice) = &view.notice {
        ui.label(notice);
    }
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        panel_scene::show(ui, document, view);
        panel_wicks::show(ui, &mut document.edited, edit, view);
        panel_air::show(ui, &mut document.edited.air);
        let several = document.edited.fires.len() > 1;
        for (index, fire) in document.edited.fires.iter_mut().enumerate() {
            let of = if several { format!(" of fire {}", index + 1) } else { String::new() };
            ui.push_id(index, |ui| {
                panel_fire::show(ui, fire, &of);
                panel_shade::show(ui, &mut fire.shade, &of);
            });
        }
        panel_picture::show(ui, &mut document.edited.look, view);
        panel_camera::show(ui, document, view);
        panel_statistics::show(ui, meters, world, view, adapter);
    });
}
