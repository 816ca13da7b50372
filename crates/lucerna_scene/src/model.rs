//! The scene as it stands in a file.

use crate::camera::CameraKey;
use crate::place::FireAir;
use crate::{Motion, WickSource};
use glam::{EulerRot, Quat};
use lucerna_flame::{Drive, Fuel, Life, Skeletons, SurfaceGrid, WickLook};
use lucerna_frame::{Camera, FlameShade, Look};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// A scene: wicks, what burns on them, the air, the opaque things around, the camera and the look.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Shown in the window and in reports.
    pub name: String,
    /// Everything random is drawn from it.
    #[serde(default)]
    pub seed: u64,
    /// The camera.
    #[serde(default)]
    pub camera: Camera,
    /// Where the camera flies in simulated time; nothing leaves it where it is.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub camera_path: Vec<CameraKey>,
    /// How the picture is made.
    #[serde(default)]
    pub look: Look,
    /// The air.
    pub air: Air,
    /// The fires; each is a group of wicks that burn alike.
    pub fires: Vec<Fire>,
    /// Opaque things.
    #[serde(default)]
    pub meshes: Vec<MeshSource>,
    /// What the fires may cost; nothing is all that they need.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub detail: Option<Budget>,
    /// What moves.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub motions: Vec<Motion>,
}

/// What the fires of a world may cost. It is told in work, not in time: the same world does the same on any machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Budget {
    /// Cells of air that are advanced in each fixed step. Airs that no fire can do without count first.
    pub cell_steps: u64,
    /// Vertices of attached flames.
    pub vertices: u64,
}

/// Which sides of the air's box are closed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AirSides {
    /// A floor below, open on all other sides.
    #[default]
    Floor,
    /// Open everywhere.
    Open,
    /// Closed everywhere (what the authors of paper 003 run).
    Closed,
}

/// How the pressure is solved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Pressure {
    /// Exactly, by transforms.
    #[default]
    Direct,
    /// The given number of Gauss-Seidel sweeps (paper 003).
    GaussSeidel(u32),
}

/// How the air's velocity is carried along by itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AirAdvection {
    /// From where the air was a step ago: the fastest, and the one that damps eddies most.
    #[default]
    SemiLagrangian,
    /// As above, and its error estimated and taken out again: livelier, at about twice the cost.
    MacCormack,
    /// Two half steps and a reflection between them: keeps the energy of eddies, at about four times the cost.
    Reflection,
    /// From where the air was, by cubics that make no new extremes.
    Cubic,
    /// With the mass that carries it, in parts of half a cell a step: plumes roll up and puff as they should, at many
    /// times the cost.
    Conservative,
}

/// How the air carries its heat.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum HeatAdvection {
    /// From where the air was a step ago: the fastest; a few per cent of the heat get lost or made on the way.
    #[default]
    SemiLagrangian,
    /// Through the faces of the cells: heat put in is heat found, which is what measurements need.
    Flux,
    /// As semi-Lagrangian, and its error estimated and taken out again.
    MacCormack,
    /// From where the air was, by cubics that make no new extremes.
    Cubic,
}

/// The air around the fires.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Air {
    /// Lowest corner of the box, m.
    pub origin_m: [f32; 3],
    /// Size of the box, m.
    pub size_m: [f32; 3],
    /// Cells along x, y and z, 2 to 256 each.
    pub cells: [u32; 3],
    /// Fixed time step, s.
    #[serde(default = "Air::default_time_step_s")]
    pub time_step_s: f32,
    /// Kinematic viscosity, m^2/s.
    #[serde(default)]
    pub viscosity_m2_s: f32,
    /// Vorticity confinement, 0 for none.
    #[serde(default)]
    pub vorticity_confinement: f32,
    /// How the pressure is solved.
    #[serde(default)]
    pub pressure: Pressure,
    /// How the velocity is carried along.
    #[serde(default)]
    pub advection: AirAdvection,
    /// How the heat is carried along.
    #[serde(default)]
    pub heat_advection: HeatAdvection,
    /// Which sides are closed.
    #[serde(default)]
    pub sides: AirSides,
    /// Temperature of the air, K.
    #[serde(default = "Air::default_ambient_k")]
    pub ambient_k: f32,
    /// Rate at which hot air cools, 1/s.
    #[serde(default)]
    pub cooling_per_s: f32,
    /// Upward acceleration of row j is this times `n_y / j`, m/s^2 (the authors' buoyancy), 0 for none.
    #[serde(default)]
    pub row_buoyancy_m_s2: f32,
    /// Wind through the open sides, m/s.
    #[serde(default)]
    pub wind_m_s: [f32; 3],
    /// The motion that the box goes along with; it does not turn.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub follows: Option<String>,
}

impl Air {
    fn default_time_step_s() -> f32 {
        1.0 / 60.0
    }
    fn default_ambient_k() -> f32 {
        293.0
    }
}

/// Wicks that burn alike.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fire {
    /// The wicks, from where the fire stands; each carries a flame, or several where it is a ring or has several parts.
    pub wicks: Vec<WickSource>,
    /// Where the fire stands, m; nothing is one fire at the origin.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub at: Vec<[f32; 3]>,
    /// How far the fire is turned about y at each place, degrees; nothing is not at all.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub turns_deg: Vec<f32>,
    /// The box of air that each copy of the fire has of its own; nothing is the air of the scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub air: Option<FireAir>,
    /// How it drives the air, and what burns.
    #[serde(default)]
    pub drive: Drive,
    /// How fuel is spread along the wicks, and how strong root forces are.
    #[serde(default)]
    pub fuel: Fuel,
    /// How it begins and ends.
    #[serde(default)]
    pub life: Life,
    /// The particle chains.
    #[serde(default)]
    pub skeletons: Skeletons,
    /// The surface.
    #[serde(default)]
    pub surface: SurfaceGrid,
    /// How it glows.
    #[serde(default)]
    pub shade: FlameShade,
    /// How its wicks look.
    #[serde(default)]
    pub wick: WickLook,
    /// The motion that carries it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motion: Option<String>,
}

/// An opaque thing from a file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeshSource {
    /// A mesh file (OBJ with MTL, glTF, GLB), relative to the scene file.
    pub file: PathBuf,
    /// Where its origin goes, m.
    #[serde(default)]
    pub position_m: [f32; 3],
    /// How it is turned about its origin, degrees: about x, then y, then z.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub rotation_deg: [f32; 3],
    /// Its scale.
    #[serde(default = "one")]
    pub scale: f32,
    /// The motion that carries it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motion: Option<String>,
    /// Where copies of it stand, m, each with `position_m` on top; nothing is one at the origin.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub at: Vec<[f32; 3]>,
    /// How far each copy is turned about y, degrees; nothing is not at all.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub turns_deg: Vec<f32>,
}

impl MeshSource {
    /// A file as it stands.
    pub fn new(file: impl Into<PathBuf>) -> Self {
        let (position_m, rotation_deg) = ([0.0; 3], [0.0; 3]);
        let (motion, at, turns_deg) = (None, Vec::new(), Vec::new());
        Self { file: file.into(), position_m, rotation_deg, scale: 1.0, motion, at, turns_deg }
    }

    pub(crate) fn placement(&self) -> Placement {
        Placement { position_m: self.position_m, rotation_deg: self.rotation_deg, scale: self.scale }
    }
}

/// Where something from a file stands in the scene.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placement {
    pub(crate) position_m: [f32; 3],
    pub(crate) rotation_deg: [f32; 3],
    pub(crate) scale: f32,
}

impl Placement {
    /// The turn: about x, then y, then z.
    pub(crate) fn rotation(&self) -> Quat {
        turn(self.rotation_deg)
    }
}

/// A turn about x, then y, then z.
pub(crate) fn turn(rotation_deg: [f32; 3]) -> Quat {
    let [x, y, z] = rotation_deg.map(f32::to_radians);
    Quat::from_euler(EulerRot::ZYX, z, y, x)
}

pub(crate) fn one() -> f32 {
    1.0
}

pub(crate) fn is_zero(vector: &[f32; 3]) -> bool {
    *vector == [0.0; 3]
}

/// A scene with its files read: what a world is made from.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadedScene {
    /// The scene as it stands in the file.
    pub scene: Scene,
    /// The shapes of every fire, in the order of its wicks (outer: fires, inner: one for each flame), from where the fire
    /// stands: a wick that is a ring or has several parts has several.
    pub wicks: Vec<Vec<lucerna_flame::WickShape>>,
    /// The opaque meshes in world space.
    pub meshes: Vec<lucerna_frame::OpaqueMesh>,
}
