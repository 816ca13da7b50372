//! Named changes to a scene: what paper 003's authors run, a cheap scene, a fine one.

use crate::{AirAdvection, AirSides, Fire, Pressure, Scene, SceneError};
use lucerna_flame::{Drive, FuelDistribution, FuelForm, Supply, SurfaceGrid};
use lucerna_frame::{Blur, GlowLevel, Look, Shading, Transparency};

const NAMES: &[&str] = &["paper", "draft", "fine"];

/// Most cells along one axis of the `draft` preset.
const DRAFT_CELLS: u32 = 20;

/// Most cells along one axis of the `fine` preset.
const FINE_CELLS: u32 = 96;

/// Heat that does as much as the force at the roots, K/s, in the `paper` preset.
const HEAT_K_S: f32 = 8000.0;

/// The names of the presets.
///
/// * `paper`: what the authors of paper 003 run. 15 x 15 x 15 cells in a closed cube around the scene's air, direct
///   pressure, root forces, no heat but their buoyancy by rows and a strength raised to make up for it, 2 slices of a
///   wick, 8 particles a skeleton, no taper, turbulence or expansion (wider roots instead), their forms of the fuel
///   functions, a texture on the surfaces (`shell`, not softened), 4 layers (2 where there is a single flame), two
///   glow levels of their seven taps with equal gains, one sample a pixel, no shadows. Tips break away no more often
///   than theirs.
/// * `draft`: cheap, for machines without a fast GPU: at most 20 cells along an axis, small surfaces, 4 layers,
///   at most 4 steps inside each interval, one sample a pixel, 3 coarse shadows.
/// * `fine`: for pictures: twice the cells along each axis, up to 96 (a length keeps its physical size), finer
///   surfaces, 16 layers, 16 steps inside each interval. Cells stay as they are where root forces reach less far than
///   the width of one, as a candle's do: how strong they are was set for these cells.
#[must_use]
pub fn presets() -> &'static [&'static str] {
    NAMES
}

/// Changes a scene to a preset; camera, wicks and meshes stay.
///
/// # Errors
///
/// [`SceneError::Unknown`] where there is no preset of that name.
pub fn apply_preset(scene: &mut Scene, name: &str) -> Result<(), SceneError> {
    match name {
        "paper" => paper(scene),
        "draft" => draft(scene),
        "fine" => fine(scene),
        _ => {
            return Err(SceneError::Unknown { kind: "preset", name: name.to_owned(), allowed: NAMES.join(", ") });
        }
    }
    Ok(())
}

fn paper(scene: &mut Scene) {
    let air = &mut scene.air;
    let cube = |origin_m: &mut [f32; 3], size_m: &mut [f32; 3], cells: &mut [u32; 3]| {
        // The authors' box is a cube: the same floor and middle, wide enough for what was there.
        let side = size_m.iter().copied().fold(0.0, f32::max);
        for axis in [0, 2] {
            origin_m[axis] += 0.5 * (size_m[axis] - side);
        }
        *size_m = [side; 3];
        *cells = [15; 3];
    };
    cube(&mut air.origin_m, &mut air.size_m, &mut air.cells);
    for own in scene.fires.iter_mut().filter_map(|fire| fire.air.as_mut()) {
        cube(&mut own.origin_m, &mut own.size_m, &mut own.cells);
        (own.sides, own.vorticity_confinement, own.cooling_per_s) = (None, None, None);
    }
    air.pressure = Pressure::Direct;
    air.sides = AirSides::Closed;
    air.advection = AirAdvection::SemiLagrangian;
    air.cooling_per_s = 0.0;
    air.wind_m_s = [0.0; 3];
    let strongest = scene.fires.iter().map(|fire| fire.fuel.strength_m_s2).fold(0.0, f32::max);
    if air.row_buoyancy_m_s2 == 0.0 {
        // Their torch: 0.0018 a step in every cell against 2 x 0.5 x 0.04 in a root's.
        air.row_buoyancy_m_s2 = 0.045 * strongest;
    }
    for fire in &mut scene.fires {
        fire.drive = Drive::RootForces;
        if matches!(fire.life.supply, Supply::Grams(_) | Supply::Kilojoules(_)) {
            fire.life.supply = Supply::Endless;
        }
        fire.fuel.form = FuelForm::Published;
        if matches!(fire.fuel.distribution, FuelDistribution::Uniform | FuelDistribution::Table(_)) {
            fire.fuel.distribution = FuelDistribution::Gaussian;
        }
        // What heat did, the force at the roots does; so measured that the built-in scenes keep their heights.
        fire.fuel.strength_m_s2 = (fire.fuel.strength_m_s2 * (1.0 + fire.fuel.heat_k_s / HEAT_K_S)).min(1.0e5);
        fire.fuel.heat_k_s = 0.0;
        let skeletons = &mut fire.skeletons;
        // Expansion dies away in half the peripheral life: roots stand where it would have pushed the sheet.
        skeletons.width_m += 0.25 * skeletons.expansion_m_s * skeletons.peripheral_life_s;
        skeletons.width_m = skeletons.width_m.min(10.0);
        skeletons.expansion_m_s = 0.0;
        skeletons.slices = 2;
        skeletons.particles = 8;
        skeletons.taper = 0.0;
        skeletons.turbulence_m_s = 0.0;
        // They let each of the four leads break with a chance of 0.1 a step.
        let most = 0.1 * 4.0 / air.time_step_s;
        skeletons.shed_per_s = skeletons.shed_per_s.min(most).min(100.0);
        // About the 400 to 570 vertices a surface that they draw.
        fire.surface = SurfaceGrid { around: 24, up: 20, tip_softness: 0.9 };
    }
    let single = scene.fires.iter().map(|fire| fire.wicks.len() * fire.places().len()).sum::<usize>() == 1;
    let look = &mut scene.look;
    look.shading = Shading::Shell;
    look.transparency = Transparency::Peeled;
    look.layers = if single { 2 } else { 4 };
    look.glow = vec![
        GlowLevel { divisor: 1, blur: Blur::Published, gain: 1.0 },
        GlowLevel { divisor: 4, blur: Blur::Published, gain: 1.0 },
    ];
    look.shell_softness = 0.0;
    look.samples = 1;
    look.shadows = 0;
    keep_debug_view(look);
}

fn draft(scene: &mut Scene) {
    for grid in grids(scene) {
        let most = grid.iter().copied().max().unwrap_or(DRAFT_CELLS);
        if most > DRAFT_CELLS {
            *grid = grid.map(|cells| (cells * DRAFT_CELLS / most).max(2));
        }
    }
    for fire in &mut scene.fires {
        fire.surface.around = fire.surface.around.min(16);
        fire.surface.up = fire.surface.up.min(12);
    }
    scene.look.layers = scene.look.layers.min(4);
    scene.look.volume_steps = scene.look.volume_steps.min(4);
    scene.look.samples = 1;
    scene.look.shadows = scene.look.shadows.min(3);
    scene.look.shadow_size = scene.look.shadow_size.min(256);
    scene.look.shadow_samples = scene.look.shadow_samples.min(8);
    keep_debug_view(&mut scene.look);
}

fn fine(scene: &mut Scene) {
    let refine = |cells: &mut [u32; 3]| {
        let most = cells.iter().copied().max().unwrap_or(FINE_CELLS);
        let target = (2 * most).min(FINE_CELLS);
        if most < target {
            *cells = cells.map(|cells| cells * target / most);
        }
    };
    let air = &mut scene.air;
    if !scene.fires.iter().any(|fire| fire.air.is_none() && is_set_for_cells(fire, air.size_m, air.cells)) {
        refine(&mut air.cells);
    }
    for fire in &mut scene.fires {
        if fire.air.as_ref().is_none_or(|own| is_set_for_cells(fire, own.size_m, own.cells)) {
            continue;
        }
        if let Some(own) = &mut fire.air {
            refine(&mut own.cells);
        }
    }
    for fire in &mut scene.fires {
        fire.surface.around = fire.surface.around.max(64);
        fire.surface.up = fire.surface.up.max(48);
    }
    scene.look.layers = scene.look.layers.max(16);
    scene.look.volume_steps = scene.look.volume_steps.max(16);
    scene.look.samples = 4;
    scene.look.shadow_samples = scene.look.shadow_samples.max(32);
    keep_debug_view(&mut scene.look);
}

/// Whether root forces reach less far than the width of a cell. In finer air the same heat would be in a thinner column:
/// its air would rise faster and pinch the flame.
fn is_set_for_cells(fire: &Fire, size_m: [f32; 3], cells: [u32; 3]) -> bool {
    let cell_m = size_m.iter().zip(cells).map(|(size, cells)| size / cells as f32).fold(f32::INFINITY, f32::min);
    // Twice the width of a flame is how far its roots push and heat.
    fire.drive == Drive::RootForces && 2.0 * fire.skeletons.width_m < cell_m
}

/// The cells of every air.
fn grids(scene: &mut Scene) -> impl Iterator<Item = &mut [u32; 3]> {
    let own = scene.fires.iter_mut().filter_map(|fire| fire.air.as_mut()).map(|air| &mut air.cells);
    std::iter::once(&mut scene.air.cells).chain(own)
}

/// A debug view of a layer or glow level that is gone falls back to the picture.
fn keep_debug_view(look: &mut Look) {
    use lucerna_frame::DebugView;
    let gone = match look.debug {
        DebugView::Layer(layer) => layer >= look.layers,
        DebugView::Glow(level) => level as usize >= look.glow.len(),
        _ => false,
    };
    if gone {
        look.debug = DebugView::Final;
    }
}
