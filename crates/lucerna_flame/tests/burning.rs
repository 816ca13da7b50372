//! Flames in simulated air: their surfaces stay closed and right side out, their motion is as it should be.

use glam::Vec3;
use lucerna_flame::{FlameError, FlameSettings, Flames, Fuel, FuelDistribution, Skeletons, Swing, WickShape};
use lucerna_fluid::{Advection, Fluid, Side, Sides};
use lucerna_frame::FlameShade;
use std::collections::HashMap;

fn air(cells: usize, low: [f32; 3], size: [f32; 3]) -> Fluid {
    let sides = Sides { y: [Side::FreeSlip, Side::Open], ..Sides::OPEN };
    let builder = Fluid::builder([cells, cells * 2, cells]).origin(low.into()).size_m(size.into());
    builder.advection(Advection::SemiLagrangian).sides(sides).cooling_per_s(2.0).build().expect("a plain box of air")
}

fn candle() -> (Fluid, FlameSettings) {
    let wick = WickShape::Polyline { points: vec![[0.0002, 0.005, 0.0001]], radius_m: 0.0006 };
    (air(16, [-0.06, -0.0075, -0.06], [0.12, 0.24, 0.12]), FlameSettings::new(wick))
}

fn torch() -> (Fluid, Vec<FlameSettings>) {
    let flame = |i: usize| {
        let (sin, cos) = (i as f32 * 0.63).sin_cos();
        let end = [0.06 * cos, 0.0, 0.06 * sin];
        let wick = WickShape::Polyline { points: vec![end.map(|v| -v), [0.0, 0.02, 0.0], end], radius_m: 0.006 };
        FlameSettings {
            fuel: Fuel {
                distribution: FuelDistribution::Bilinear,
                strength_m_s2: 20.0,
                swing: Swing::Noise { amplitude: 1.0, frequency_hz: 5.0 },
                heat_k_s: 3000.0,
                ..Fuel::default()
            },
            skeletons: Skeletons {
                lead_life_s: 0.22,
                peripheral_life_s: 0.2,
                width_m: 0.02,
                expansion_m_s: 0.25,
                shed_per_s: 2.0,
                turbulence_m_s: 0.8,
                turbulence_m: 0.1,
                ..Skeletons::default()
            },
            ..FlameSettings::new(wick)
        }
    };
    (air(15, [-0.3, -0.15, -0.3], [0.6, 1.2, 0.6]), (0..5).map(flame).collect())
}

fn burn(fluid: &mut Fluid, flames: &mut Flames, dt: f32, steps: usize) {
    for _ in 0..steps {
        flames.drive(fluid).expect("drive");
        fluid.step(dt).expect("step");
        flames.step(fluid, dt);
    }
    flames.build();
}

/// Each surface: every edge is crossed once in each direction (by position), and it encloses a volume.
fn check_closed(flames: &Flames) {
    for (index, draw) in flames.draws().iter().enumerate() {
        let vertices = &flames.vertices()[draw.first_vertex as usize..][..draw.vertex_count as usize];
        let indices = &flames.indices()[draw.first_index as usize..][..draw.index_count as usize];
        let mut edges: HashMap<[[u32; 3]; 2], i32> = HashMap::new();
        let key = |p: [f32; 3]| p.map(|v| (v + 0.0).to_bits());
        let mut volume = 0.0_f64;
        for t in indices.chunks_exact(3) {
            let p: Vec<Vec3> = t.iter().map(|&i| vertices[i as usize].position.into()).collect();
            let centre = Vec3::from(vertices[0].position);
            volume += f64::from((p[0] - centre).dot((p[1] - centre).cross(p[2] - centre))) / 6.0;
            for k in 0..3 {
                let (a, b) = (key(p[k].to_array()), key(p[(k + 1) % 3].to_array()));
                if a != b {
                    *edges.entry([a, b]).or_default() += 1;
                    *edges.entry([b, a]).or_default() -= 1;
                }
            }
        }
        let open = edges.values().filter(|&&n| n != 0).count();
        assert_eq!(open, 0, "surface {index} has open edges at {} s", flames.time_s());
        assert!(
            volume > 0.0,
            "surface {index} of {} ({} vertices) is inside out at {} s: {volume}",
            flames.draws().len(),
            vertices.len(),
            flames.time_s()
        );
        for v in vertices {
            let all = [&v.position[..], &v.normal, &v.uv, &[v.height, v.radius_m]].concat();
            assert!(all.iter().all(|x| x.is_finite()), "{v:?}");
            assert!((0.0..=1.0).contains(&v.height) && v.radius_m > 0.0 && v.flame == index as u32);
        }
    }
}

#[test]
fn ten_seconds_of_a_torch_are_closed_and_right_side_out() {
    let (mut fluid, settings) = torch();
    let mut flames = Flames::new(settings, 7).expect("torch");
    let (mut free, mut heights) = (0, Vec::new());
    for frame in 0..600 {
        burn(&mut fluid, &mut flames, 1.0 / 60.0, 1);
        check_closed(&flames);
        free += flames.draws().len() - 5;
        if frame > 60 {
            let attached = &flames.vertices()[..flames.draws()[4].first_vertex as usize];
            heights.push(attached.iter().map(|v| v.position[1]).fold(f32::MIN, f32::max));
        }
    }
    assert!(free > 60, "tips break away: {free}");
    let mean = heights.iter().sum::<f32>() / heights.len() as f32;
    let spread = (heights.iter().map(|h| (h - mean).powi(2)).sum::<f32>() / heights.len() as f32).sqrt();
    assert!((0.2..0.7).contains(&mean), "a torch's flame is 0.3 to 0.6 m high: {mean}");
    assert!(spread > 0.03 * mean, "it is lively: {spread} about {mean}");
}

#[test]
fn a_lone_candle_is_steady_and_shaped_as_a_drop() {
    let (mut fluid, settings) = candle();
    let mut flames = Flames::new(vec![settings], 1).expect("candle");
    burn(&mut fluid, &mut flames, 1.0 / 60.0, 120);
    let (mut low, mut high) = (f32::MAX, f32::MIN);
    for _ in 0..60 {
        burn(&mut fluid, &mut flames, 1.0 / 60.0, 1);
        check_closed(&flames);
        let top = flames.vertices().iter().map(|v| v.position[1]).fold(f32::MIN, f32::max);
        (low, high) = (low.min(top), high.max(top));
    }
    assert!(high - low < 0.05 * high, "{low} to {high}");
    assert!((0.03..0.06).contains(&high), "{high}");
    // Radius by height: narrow at the root, widest in the lower half, pointed.
    let radius = |from: f32, to: f32| {
        let inside = flames.vertices().iter().filter(|v| (from..to).contains(&v.height));
        inside.map(|v| Vec3::from(v.position).with_y(0.0).length()).fold(0.0, f32::max)
    };
    let (root, body, neck, tip) = (radius(0.0, 0.03), radius(0.2, 0.5), radius(0.75, 0.85), radius(0.97, 1.01));
    assert!(root < 0.8 * body && neck < 0.7 * body && tip < 0.2 * body, "{root} {body} {neck} {tip}");
    assert!(radius(0.5, 1.0) <= body * 1.02, "widest in the lower half");
}

#[test]
fn no_time_step_makes_nonsense() {
    for dt in [1e-4, 0.1, 10.0] {
        let (mut fluid, settings) = torch();
        let mut flames = Flames::new(settings, 3).expect("torch");
        for _ in 0..20 {
            burn(&mut fluid, &mut flames, dt, 3);
            check_finite(&flames);
        }
    }
}

fn check_finite(flames: &Flames) {
    let finite = |p: &[f32]| p.iter().all(|v| v.is_finite());
    assert!(flames.vertices().iter().all(|v| finite(&v.position) && finite(&v.normal)));
    assert!(flames.lights().iter().all(|l| finite(&l.position) && finite(&l.intensity) && l.radius_m > 0.0));
}

#[test]
fn same_seed_same_bits_on_any_number_of_threads() {
    let run = |threads: usize, seed: u64| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("pool");
        pool.install(|| {
            let (mut fluid, settings) = torch();
            let mut flames = Flames::new(settings, seed).expect("torch");
            burn(&mut fluid, &mut flames, 1.0 / 60.0, 90);
            let sum = flames.vertices().iter().fold(0_u64, |sum, v| {
                v.position.iter().fold(sum, |sum, x| sum.rotate_left(5) ^ u64::from(x.to_bits()))
            });
            (flames.state_hash(), sum, fluid.state_hash())
        })
    };
    let one = run(1, 7);
    assert_eq!(one, run(2, 7));
    assert_eq!(one, run(7, 7));
    assert_ne!(one, run(1, 8));
}

#[test]
fn light_follows_soot_temperature_and_strength() {
    let total = |shade: FlameShade| {
        let (mut fluid, settings) = candle();
        let mut flames = Flames::new(vec![FlameSettings { shade, ..settings }], 1).expect("candle");
        burn(&mut fluid, &mut flames, 1.0 / 60.0, 60);
        assert!((2..=4).contains(&flames.lights().len()));
        let (low, high) = (flames.lights()[0].position[1], flames.lights()[2].position[1]);
        assert!(high - low > 0.008, "spread over the flame: {low} {high}");
        flames.lights().iter().map(|l| l.intensity[0]).sum::<f32>()
    };
    let base = FlameShade::default();
    let plain = total(base);
    let ratio = |shade| total(shade) / plain;
    assert!((ratio(FlameShade { strength: 0.5, ..base }) - 0.5).abs() < 1e-4);
    let doubled = ratio(FlameShade { soot_per_m: 2.0 * base.soot_per_m, ..base });
    assert!((1.9..2.0).contains(&doubled), "thin flames hide next to nothing of themselves: {doubled}");
    let thick = ratio(FlameShade { soot_per_m: 1000.0 * base.soot_per_m, ..base });
    assert!(thick < 100.0, "thick ones do: {thick}");
    assert!(ratio(FlameShade { temperature_k: 2000.0, ..base }) > 2.0);
}

#[test]
fn settings_change_without_putting_the_fire_out() {
    let (mut fluid, settings) = torch();
    let mut flames = Flames::new(settings.clone(), 7).expect("torch");
    burn(&mut fluid, &mut flames, 1.0 / 60.0, 60);
    let top = |f: &Flames| f.vertices().iter().map(|v| v.position[1]).fold(f32::MIN, f32::max);
    let before = top(&flames);
    let mut changed = settings.clone();
    changed[0].fuel.strength_m_s2 = 25.0;
    changed[0].skeletons.particles = 12;
    flames.set(changed).expect("set");
    flames.build();
    assert!(top(&flames) > 0.6 * before, "{before} {}", top(&flames));
    let mut bad = settings;
    bad[2].skeletons.width_m = f32::NAN;
    let hash = flames.state_hash();
    assert!(matches!(flames.set(bad), Err(FlameError::OutOfRange { field: "skeletons.width_m", .. })));
    assert_eq!(hash, flames.state_hash());
}
