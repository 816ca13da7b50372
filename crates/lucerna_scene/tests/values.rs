//! Every value that is not allowed is named with what is.

mod common;

use common::smallest;
use lucerna_flame::{FuelDistribution, Swing};
use lucerna_frame::{Blur, DebugView, GlowLevel, Transparency};
use lucerna_scene::{CameraKey, FireAir, MeshSource, Pressure, Scene, WickSource, validate};

#[track_caller]
fn refused(edit: impl FnOnce(&mut Scene), expected: &str) {
    let mut scene = smallest();
    edit(&mut scene);
    assert_eq!(validate(&scene).expect_err(expected).to_string(), expected);
}

fn polyline(points: Vec<[f32; 3]>, radius_m: f32) -> WickSource {
    WickSource::Polyline { points, radius_m }
}

#[test]
fn the_smallest_scene_is_allowed() {
    validate(&smallest()).unwrap();
}

#[test]
fn air() {
    refused(|s| s.air.cells[1] = 0, "air.cells[1] is 0: must be 2 to 256");
    refused(|s| s.air.cells[0] = 257, "air.cells[0] is 257: must be 2 to 256");
    refused(|s| s.air.cells = [256; 3], "air.cells is 256 x 256 x 256: must be at most 4000000 in all");
    refused(|s| s.air.size_m[2] = 0.0, "air.size_m[2] is 0: must be above 0 and at most 1000");
    refused(|s| s.air.size_m[0] = f32::NAN, "air.size_m[0] is NaN: must be above 0 and at most 1000");
    refused(|s| s.air.size_m[0] = 1.0e-5, "air.size_m[0] is 0.00001: must be at least 0.0001 m for each cell");
    refused(|s| s.air.origin_m[0] = f32::INFINITY, "air.origin_m[0] is inf: must be -100000 to 100000");
    refused(|s| s.air.time_step_s = 0.0, "air.time_step_s is 0: must be 0.00001 to 10");
    refused(|s| s.air.viscosity_m2_s = -1.0, "air.viscosity_m2_s is -1: must be 0 to 1000");
    refused(|s| s.air.vorticity_confinement = -1.0, "air.vorticity_confinement is -1: must be 0 to 100");
    refused(|s| s.air.pressure = Pressure::GaussSeidel(0), "air.pressure gauss_seidel is 0: must be 1 to 10000");
    refused(|s| s.air.ambient_k = 0.0, "air.ambient_k is 0: must be 1 to 5000");
    refused(|s| s.air.cooling_per_s = -0.5, "air.cooling_per_s is -0.5: must be 0 to 1000");
    refused(|s| s.air.row_buoyancy_m_s2 = f32::NAN, "air.row_buoyancy_m_s2 is NaN: must be 0 to 10000");
    refused(|s| s.air.wind_m_s[1] = 1.0e9, "air.wind_m_s[1] is 1000000000: must be -100 to 100");
}

#[test]
fn camera_and_look() {
    refused(|s| s.camera.target = s.camera.eye, "camera.target is (0, 1, 3): must be another point than camera.eye");
    refused(|s| s.camera.fov_y_deg = 180.0, "camera.fov_y_deg is 180: must be 1 to 170");
    refused(|s| s.camera.near_m = 0.0, "camera.near_m is 0: must be above 0 and at most 100000");
    refused(|s| s.camera.far_m = 0.01, "camera.far_m is 0.01: must be above camera.near_m, 0.01");
    refused(
        |s| s.look.transparency = Transparency::Unsorted,
        "look.transparency is unsorted: must be peeled where look.shading is volume",
    );
    refused(|s| s.look.layers = 33, "look.layers is 33: must be 1 to 32");
    refused(|s| s.look.glow = vec![s.look.glow[0]; 5], "the number of look.glow is 5: must be at most 4");
    refused(|s| s.look.glow[1].divisor = 2, "look.glow[1].divisor is 2: must be 1, 4 or 16");
    refused(
        |s| s.look.glow[0] = GlowLevel { divisor: 1, blur: Blur::Height(0.0), gain: 1.0 },
        "look.glow[0].blur height is 0: must be above 0 and at most 1",
    );
    refused(
        |s| s.look.glow[0] = GlowLevel { divisor: 1, blur: Blur::Pixels(22.0), gain: 1.0 },
        "look.glow[0].blur pixels is 22: must be above 0 and at most 21",
    );
    refused(|s| s.look.glow[0].gain = -1.0, "look.glow[0].gain is -1: must be 0 to 100");
    refused(|s| s.look.exposure_stops = f32::NAN, "look.exposure_stops is NaN: must be -30 to 30");
    refused(|s| s.look.white_k = 0.0, "look.white_k is 0: must be 1000 to 20000");
    refused(|s| s.look.ambient[2] = -0.1, "look.ambient[2] is -0.1: must be 0 to 60000");
    refused(|s| s.look.background[0] = 1.0e5, "look.background[0] is 100000: must be 0 to 60000");
    refused(|s| s.look.light_gain = 1.0e5, "look.light_gain is 100000: must be 0 to 60000");
    refused(|s| s.look.shadows = 33, "look.shadows is 33: must be 0 to 32");
    refused(|s| s.look.shadow_size = 8, "look.shadow_size is 8: must be 16 to 1024");
    refused(|s| s.look.shadow_samples = 0, "look.shadow_samples is 0: must be 1 to 64");
    refused(
        |s| (s.look.shadows, s.look.shadow_size) = (9, 1024),
        "look.shadow_size is 1024: must be at most 8192 / look.shadows, 910",
    );
    refused(|s| s.look.light_merging = 1.5, "look.light_merging is 1.5: must be 0 to 1");
    refused(|s| s.look.samples = 2, "look.samples is 2: must be 1 or 4");
    refused(|s| s.look.volume_steps = 1, "look.volume_steps is 1: must be 2 to 32");
    refused(|s| s.look.debug = DebugView::Layer(8), "look.debug layer is 8: must be below look.layers, 8");
    refused(|s| s.look.debug = DebugView::Glow(3), "look.debug glow is 3: must be below the number of look.glow, 3");
}

#[test]
fn wicks() {
    refused(|s| s.fires.clear(), "the number of fires is 0: must be 1 to 64");
    refused(|s| s.fires[0].wicks.clear(), "the number of fires[0].wicks is 0: must be 1 to 64");
    refused(
        |s| s.fires[0].wicks = vec![s.fires[0].wicks[0].clone(); 65],
        "the number of fires[0].wicks is 65: must be 1 to 64",
    );
    refused(
        |s| {
            s.fires[0].wicks = vec![s.fires[0].wicks[0].clone(); 60];
            s.fires[0].at = vec![[0.0; 3]; 50];
        },
        "the number of wicks of all copies of all fires is 3000: must be at most 2520",
    );
    refused(
        |s| s.fires[0].wicks[0] = polyline(vec![[0.0, 3.0, 0.0]], 0.1),
        "fires[0].wicks[0].points[0] is at (0, 3, 0): must be inside the air, from (-1, -1, -1) to (1, 1, 1)",
    );
    refused(
        |s| s.fires[0].wicks[0] = polyline(vec![[f32::NAN, 0.0, 0.0]], 0.1),
        "fires[0].wicks[0].points[0] is at (NaN, 0, 0): must be inside the air, from (-1, -1, -1) to (1, 1, 1)",
    );
    refused(
        |s| s.fires[0].wicks[0] = polyline(vec![], 0.1),
        "the number of fires[0].wicks[0].points is 0: must be 1 to 1024",
    );
    refused(
        |s| s.fires[0].wicks[0] = polyline(vec![[0.0; 3]; 2], 0.1),
        "fires[0].wicks[0].points is of no length: must be one point, or points that differ",
    );
    refused(
        |s| s.fires[0].wicks[0] = polyline(vec![[0.0; 3]], 0.0),
        "fires[0].wicks[0].radius_m is 0: must be 0.000001 to 10",
    );
    refused(
        |s| s.fires[0].wicks[0] = WickSource::mesh(""),
        "fires[0].wicks[0].file is empty: must be the path of an OBJ, glTF or GLB file",
    );
    refused(
        |s| s.meshes.push(MeshSource { scale: 0.0, ..MeshSource::new("a.obj") }),
        "meshes[0].scale is 0: must be 0.000001 to 1000000",
    );
}

#[test]
fn copies() {
    let own = |origin_m, size_m, cells| {
        let (sides, vorticity_confinement, cooling_per_s) = (None, None, None);
        Some(FireAir { origin_m, size_m, cells, sides, vorticity_confinement, cooling_per_s })
    };
    refused(|s| s.fires[0].at = vec![[0.0, f32::NAN, 0.0]], "fires[0].at[0][1] is NaN: must be -100000 to 100000");
    refused(
        |s| s.fires[0].at = vec![[0.0; 3], [3.0, 0.0, 0.0]],
        "fires[0].wicks[0].points[0] is at (3, 0, 0): must be inside the air, from (-1, -1, -1) to (1, 1, 1)",
    );
    refused(|s| s.fires[0].at = vec![[0.0; 3]; 4097], "the number of fires[0].at is 4097: must be at most 4096");
    refused(
        |s| s.fires[0].turns_deg = vec![10.0, 20.0],
        "the number of fires[0].turns_deg is 2: must be none, or 1: one for each place",
    );
    refused(|s| s.fires[0].turns_deg = vec![400.0], "fires[0].turns_deg[0] is 400: must be -360 to 360");
    refused(
        |s| s.fires[0].air = own([0.5; 3], [0.1; 3], [4; 3]),
        "fires[0].wicks[0].points[0] is at (0, 0, 0): must be inside the air, from (0.5, 0.5, 0.5) to (0.6, 0.6, 0.6)",
    );
    refused(
        |s| s.fires[0].air = own([-1.0; 3], [2.0; 3], [4, 300, 4]),
        "fires[0].air.cells[1] is 300: must be 2 to 256",
    );
    refused(
        |s| s.fires[0].air = own([-1.0; 3], [2.0, 0.0, 2.0], [4; 3]),
        "fires[0].air.size_m[1] is 0: must be above 0 and at most 1000",
    );
    refused(
        |s| {
            s.fires[0].air = own([-1.0; 3], [2.0; 3], [150; 3]);
            s.fires[0].at = vec![[0.0; 3]; 10];
        },
        "the number of cells of all copies of fires[0].air.cells is 33750000: must be at most 32000000",
    );
    refused(
        |s| s.meshes.push(MeshSource { turns_deg: vec![f32::NAN], ..MeshSource::new("a.obj") }),
        "meshes[0].turns_deg[0] is NaN: must be -360 to 360",
    );
}

#[test]
fn camera_paths() {
    let key = |time_s: f32, x: f32| CameraKey { time_s, eye: [x, 0.0, 1.0], target: [0.0; 3] };
    refused(
        |s| s.camera_path = vec![key(1.0, 0.0), key(1.0, 1.0)],
        "camera_path[1].time_s is 1: must be after that of the key before, 1",
    );
    refused(|s| s.camera_path = vec![key(0.0, f32::NAN)], "camera_path[0].eye[0] is NaN: must be -100000 to 100000");
    let mut scene = smallest();
    assert_eq!(scene.camera_at(3.0), scene.camera);
    scene.camera_path = vec![key(1.0, 0.0), key(2.0, 1.0), key(4.0, 1.5), key(5.0, -1.0)];
    let x = |time_s: f64| scene.camera_at(time_s).eye[0];
    for (time_s, at) in [(0.0, 0.0), (1.0, 0.0), (2.0, 1.0), (4.0, 1.5), (5.0, -1.0), (9.0, -1.0)] {
        assert!((x(time_s) - at).abs() < 1e-6, "{time_s} s: {}", x(time_s));
    }
    let bends = (1001..4999).map(|i| f64::from(i) * 1e-3);
    let sharpest = bends.map(|t| (x(t + 1e-3) - 2.0 * x(t) + x(t - 1e-3)).abs()).fold(0.0, f32::max);
    println!("the sharpest change of speed in a millisecond is {sharpest:.1e} m/ms");
    assert!(sharpest < 3e-5, "no kinks: {sharpest}");
}

#[test]
fn fires() {
    refused(|s| s.fires[0].skeletons.taper = 1.5, "fires[0].skeletons.taper is 1.5: must be 0 to 1");
    refused(
        |s| (s.fires[0].skeletons.lead_life_s, s.fires[0].skeletons.peripheral_life_s) = (0.05, 0.1),
        "fires[0].skeletons.lead_life_s is 0.05: must be at least peripheral_life_s, 0.1",
    );
    refused(|s| s.fires[0].skeletons.turbulence_m = 0.0, "fires[0].skeletons.turbulence_m is 0: must be 0.0001 to 100");
    refused(|s| s.fires[0].fuel.strength_m_s2 = -1.0, "fires[0].fuel.strength_m_s2 is -1: must be 0 to 100000");
    refused(|s| s.fires[0].fuel.heat_k_s = 2.0e6, "fires[0].fuel.heat_k_s is 2000000: must be 0 to 1000000");
    refused(
        |s| s.fires[0].fuel.distribution = FuelDistribution::Table(vec![1.0]),
        "the number of samples of fires[0].fuel.distribution table is 1: must be 2 to 4096",
    );
    refused(
        |s| s.fires[0].fuel.distribution = FuelDistribution::Table(vec![1.0, f32::NAN]),
        "fires[0].fuel.distribution table[1] is NaN: must be 0 to 1000",
    );
    refused(
        |s| s.fires[0].fuel.swing = Swing::Periodic { amplitude: 1.0, frequency_hz: 0.0 },
        "fires[0].fuel.swing.frequency_hz is 0: must be above 0 and at most 1000",
    );
    refused(
        |s| s.fires[0].fuel.swing = Swing::Random { amplitude: -1.0 },
        "fires[0].fuel.swing.amplitude is -1: must be 0 to 100",
    );
    refused(|s| s.fires[0].skeletons.slices = 0, "fires[0].skeletons.slices is 0: must be 1 to 64");
    refused(|s| s.fires[0].skeletons.particles = 2, "fires[0].skeletons.particles is 2: must be 3 to 32");
    refused(|s| s.fires[0].skeletons.lead_life_s = 0.0, "fires[0].skeletons.lead_life_s is 0: must be 0.001 to 60");
    refused(|s| s.fires[0].surface.around = 31, "fires[0].surface.around is 31: must be an even number, 4 to 256");
    refused(|s| s.fires[0].surface.up = 1, "fires[0].surface.up is 1: must be 3 to 256");
    refused(|s| s.fires[0].surface.tip_softness = 1.5, "fires[0].surface.tip_softness is 1.5: must be 0 to 1");
    refused(|s| s.fires[0].shade.temperature_k = 0.0, "fires[0].shade.temperature_k is 0: must be 500 to 10000");
    refused(|s| s.fires[0].shade.soot_full = 0.1, "fires[0].shade.soot_full is 0.1: must be at least soot_begin, 0.13");
}
