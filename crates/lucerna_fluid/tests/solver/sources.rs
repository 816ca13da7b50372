//! Sources of every shape: what they add, and what is refused.

use std::f32::consts::PI;
use std::sync::Arc;

use lucerna_fluid::{
    AIR_HEAT_CAPACITY_J_KG_K, Couple, Fluid, FluidError, ScalarSource, Shape, Sides, Source, Vec3, air_density_kg_m3,
};

/// The surface of a box, two triangles a side.
fn box_mesh(low: Vec3, high: Vec3) -> (Arc<[Vec3]>, Arc<[[u32; 3]]>) {
    let corner = |at: u32| {
        let pick = |bit: u32, low: f32, high: f32| if at & bit == 0 { low } else { high };
        Vec3::new(pick(1, low.x, high.x), pick(2, low.y, high.y), pick(4, low.z, high.z))
    };
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles: Vec<[u32; 3]> = quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    ((0..8).map(corner).collect(), triangles.into())
}

/// A ring about the y axis of rings of `sides` corners.
fn torus(centre: Vec3, radius: f32, thickness: f32, sides: u32) -> (Arc<[Vec3]>, Arc<[[u32; 3]]>) {
    let angle = |at: u32| 2.0 * PI * at as f32 / sides as f32;
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for i in 0..sides {
        for j in 0..sides {
            let away = radius + thickness * angle(j).cos();
            positions
                .push(centre + Vec3::new(away * angle(i).cos(), thickness * angle(j).sin(), away * angle(i).sin()));
            let at = |i: u32, j: u32| (i % sides) * sides + j % sides;
            triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    (positions.into(), triangles.into())
}

fn mesh((positions, triangles): (Arc<[Vec3]>, Arc<[[u32; 3]]>), layer_m: Option<f32>) -> Shape {
    Shape::Mesh { positions, triangles, layer_m }
}

fn shapes() -> Vec<Shape> {
    let (low, high) = (Vec3::new(0.21, 0.1, 0.3), Vec3::new(0.5, 0.42, 0.77));
    vec![
        Shape::Point(Vec3::new(0.33, 0.41, 0.02)),
        Shape::Box { low, high },
        Shape::Box { low, high: Vec3::new(high.x, low.y, high.z) },
        Shape::Sphere { centre: Vec3::new(0.1, 0.5, 0.5), radius_m: 0.3 },
        Shape::Sphere { centre: Vec3::splat(0.52), radius_m: 1.0e-5 },
        mesh(box_mesh(low, high), None),
        mesh(torus(Vec3::splat(0.5), 0.25, 0.12, 24), None),
        mesh(torus(Vec3::splat(0.5), 0.25, 0.12, 24), Some(0.05)),
    ]
}

fn run(fluid: &mut Fluid, steps: usize, dt_s: f32) {
    for _ in 0..steps {
        fluid.step(dt_s).unwrap();
    }
}

/// Heat in the box, kJ, with the density of ambient air.
fn heat_kj(fluid: &Fluid) -> f64 {
    let kelvin: f64 = fluid.temperatures().iter().map(|value| f64::from(*value)).sum();
    let volume = fluid.cell_size_m().as_dvec3().element_product();
    1.0e-3 * kelvin * volume * f64::from(air_density_kg_m3(fluid.ambient_k()) * AIR_HEAT_CAPACITY_J_KG_K)
}

#[test]
fn all_the_heat_of_a_source_gets_into_the_air() {
    let mut worst = 0.0_f64;
    for shape in shapes() {
        let mut fluid = Fluid::builder([15, 20, 17]).build().unwrap();
        let source = Source { heat_kw: 0.5, ..Source::new(shape.clone()) };
        for _ in 0..10 {
            fluid.add_source(&source).unwrap();
            fluid.step(0.01).unwrap();
        }
        let kept = fluid.attach_source(source).unwrap();
        run(&mut fluid, 10, 0.01);
        fluid.detach_source(kept).unwrap();
        fluid.step(0.01).unwrap();
        let off = heat_kj(&fluid) / 0.1 - 1.0;
        worst = worst.max(off.abs());
        assert!(off.abs() < 1.0e-3, "{shape:?}: off by {off}");
    }
    println!("heat of sources found in a closed box: off by {worst:.1e} at most");
}

#[test]
fn shapes_cover_their_volume() {
    let mut fluid = Fluid::builder([15, 20, 17]).build().unwrap();
    let mut volume = |shape: Shape| {
        let id = fluid.attach_source(Source::new(shape)).unwrap();
        let volume = fluid.source_volume_m3(id).unwrap();
        fluid.detach_source(id).unwrap();
        volume
    };
    let (low, high) = (Vec3::new(0.21, 0.1, 0.3), Vec3::new(0.5, 0.42, 0.77));
    let exact = f64::from((high - low).element_product());
    let plain = volume(Shape::Box { low, high });
    assert!((plain / exact - 1.0).abs() < 1.0e-5);
    let outside = volume(Shape::Box { low: low - 10.0 * Vec3::X, high });
    assert!((outside / exact - f64::from(high.x / (high.x - low.x))).abs() < 1.0e-4);
    // A mesh is exact along x and sampled by four rays a cell across.
    let meshed = volume(mesh(box_mesh(low, high), None));
    println!("a box as a mesh: {:.4} of its volume", meshed / exact);
    assert!((meshed / exact - 1.0).abs() < 0.05);
    let radius = 0.3_f32;
    let ball = volume(Shape::Sphere { centre: Vec3::splat(0.5), radius_m: radius });
    let exact = f64::from(4.0 / 3.0 * PI * radius.powi(3));
    println!("a ball: {:.4} of its volume", ball / exact);
    assert!((ball / exact - 1.0).abs() < 0.01);
    // A ring with a hole that rays pass through twice; its sections have 24 corners.
    let ring = volume(mesh(torus(Vec3::splat(0.5), 0.25, 0.12, 24), None));
    let section = |sides: f32| sides / 2.0 * (2.0 * PI / sides).sin() / PI;
    let exact = f64::from(2.0 * PI * PI * 0.25 * 0.12 * 0.12 * section(24.0) * section(24.0).sqrt());
    println!("a ring: {:.4} of its volume", ring / exact);
    assert!((ring / exact - 1.0).abs() < 0.02);
    let layer = volume(mesh(torus(Vec3::splat(0.5), 0.25, 0.12, 24), Some(0.05)));
    let surface = f64::from(4.0 * PI * PI * 0.25 * 0.12);
    println!("a layer on it: {:.4} of surface times thickness", layer / (0.05 * surface));
    assert!((layer / (0.05 * surface) - 1.0).abs() < 0.3);
}

#[test]
fn a_mesh_has_the_cells_of_the_box_that_it_encloses() {
    let warm = |shape: Shape| {
        let mut fluid = Fluid::builder([8; 3]).build().unwrap();
        fluid.add_source(&Source { kelvin_per_s: 100.0, ..Source::new(shape) }).unwrap();
        fluid.step(0.01).unwrap();
        fluid.temperatures().to_vec()
    };
    // Faces of the box on faces of cells, so that both are exact, and rays meet shared edges.
    let (low, high) = (Vec3::splat(0.25), Vec3::new(0.5, 0.75, 0.625));
    assert_eq!(warm(Shape::Box { low, high }), warm(mesh(box_mesh(low, high), None)));
}

#[test]
fn couples_relax_whatever_the_step() {
    let relaxed = |dt_s: f32| {
        let mut fluid = Fluid::builder([6; 3]).scalar("dye").build().unwrap();
        let dye = fluid.scalar_id("dye").unwrap();
        let source = Source {
            temperature: Some(Couple { value: 300.0, per_s: 2.0 }),
            scalars: vec![ScalarSource { couple: Some(Couple { value: 5.0, per_s: 2.0 }), ..ScalarSource::new(dye) }],
            ..Source::new(Shape::Box { low: Vec3::ZERO, high: Vec3::ONE })
        };
        fluid.attach_source(source).unwrap();
        run(&mut fluid, (1.0 / dt_s).round() as usize, dt_s);
        [fluid.temperature(Vec3::splat(0.5)) / 300.0, fluid.scalar(dye, Vec3::splat(0.5)) / 5.0]
    };
    let expected = 1.0 - (-2.0_f32).exp();
    for dt_s in [0.5, 0.01] {
        for found in relaxed(dt_s) {
            assert!((found / expected - 1.0).abs() < 1.0e-4, "{found} against {expected}");
        }
    }
}

#[test]
fn a_held_velocity_holds_and_a_force_gives_its_momentum() {
    let mut fluid = Fluid::builder([12; 3]).sides(Sides::OPEN).build().unwrap();
    let shape = Shape::Box { low: Vec3::splat(0.25), high: Vec3::splat(0.75) };
    let hold = Source { velocity: Some(Couple { value: Vec3::Y, per_s: 1.0e6 }), ..Source::new(shape.clone()) };
    fluid.attach_source(hold).unwrap();
    run(&mut fluid, 200, 0.02);
    let speed = fluid.velocity(Vec3::splat(0.5));
    assert!((speed - Vec3::Y).length() < 0.1, "{speed}");
    // A force on a body of air gives each kilogram its share.
    let push = |force_n: Vec3, acceleration_m_s2: Vec3| {
        let mut fluid = Fluid::builder([12; 3]).sides(Sides::OPEN).build().unwrap();
        fluid.add_source(&Source { force_n, acceleration_m_s2, ..Source::new(shape.clone()) }).unwrap();
        fluid.step(0.1).unwrap();
        fluid.velocity(Vec3::splat(0.5))
    };
    let mass_kg = 0.125 * air_density_kg_m3(fluid.ambient_k());
    let (by_force, by_mass) =
        (push(Vec3::new(0.2, 0.5, -0.1), Vec3::ZERO), push(Vec3::ZERO, Vec3::new(0.2, 0.5, -0.1) / mass_kg));
    assert!(by_mass.y > 0.1 && (by_force - by_mass).length() < 1.0e-4 * by_mass.length(), "{by_force} {by_mass}");
}

#[test]
fn mass_and_gas_let_in_are_found() {
    let mut fluid = Fluid::builder([10; 3]).scalar("smoke").sides(Sides::OPEN).build().unwrap();
    let smoke = fluid.scalar_id("smoke").unwrap();
    let source = Source {
        inflow_m3_s: 0.05,
        scalars: vec![ScalarSource { kg_s: 0.001, ..ScalarSource::new(smoke) }],
        ..Source::new(Shape::Sphere { centre: Vec3::splat(0.5), radius_m: 0.2 })
    };
    fluid.add_source(&source).unwrap();
    fluid.step(0.01).unwrap();
    let found = fluid.scalar_total(smoke) * f64::from(air_density_kg_m3(fluid.ambient_k()));
    assert!((found / 1.0e-5 - 1.0).abs() < 1.0e-4, "{found}");
    let volume = fluid.cell_size_m().as_dvec3().element_product();
    let out: f64 = fluid.divergence().iter().map(|value| f64::from(*value)).sum::<f64>() * volume;
    assert!((out / 0.05 - 1.0).abs() < 1.0e-3, "{out}");
}

#[test]
fn sources_that_make_no_sense_are_refused() {
    let mut fluid = Fluid::builder([8; 3]).scalar("dye").build().unwrap();
    let other = Fluid::builder([8; 3]).scalar("dye").scalar("smoke").build().unwrap();
    let hash = fluid.state_hash();
    let ball = || Source::new(Shape::Sphere { centre: Vec3::splat(0.5), radius_m: 0.2 });
    for bad in [f32::NAN, f32::INFINITY, 1.0e30] {
        let vector = Vec3::new(0.0, bad, 0.0);
        let sources = [
            Source { acceleration_m_s2: vector, ..ball() },
            Source { force_n: vector, ..ball() },
            Source { heat_kw: bad, ..ball() },
            Source { kelvin_per_s: bad, ..ball() },
            Source { expansion_per_s: bad, ..ball() },
            Source { inflow_m3_s: bad, ..ball() },
            Source { velocity: Some(Couple { value: vector, per_s: 1.0 }), ..ball() },
            Source { velocity: Some(Couple { value: Vec3::Y, per_s: bad }), ..ball() },
            Source { temperature: Some(Couple { value: bad, per_s: 1.0 }), ..ball() },
            Source::new(Shape::Sphere { centre: Vec3::splat(0.5), radius_m: bad }),
            Source::new(Shape::Point(vector)),
        ];
        for source in sources {
            assert!(fluid.add_source(&source).is_err(), "{source:?}");
            assert!(fluid.attach_source(source).is_err());
        }
    }
    let refused = |fluid: &mut Fluid, shape: Shape| fluid.add_source(&Source::new(shape)).unwrap_err();
    let far = Shape::Sphere { centre: Vec3::splat(3.0), radius_m: 0.2 };
    assert_eq!(refused(&mut fluid, far), FluidError::SourceOutside);
    assert_eq!(refused(&mut fluid, Shape::Point(Vec3::splat(-0.1))), FluidError::SourceOutside);
    let upside_down = Shape::Box { low: Vec3::ONE, high: Vec3::ZERO };
    assert!(matches!(refused(&mut fluid, upside_down), FluidError::Value { field: "high", .. }));
    let (positions, triangles) = box_mesh(Vec3::splat(0.2), Vec3::splat(0.8));
    let empty = mesh((positions.clone(), Arc::new([])), None);
    assert!(matches!(refused(&mut fluid, empty), FluidError::Mesh { problem: "has no triangles" }));
    let open = (positions.clone(), triangles[1..].into());
    assert_eq!(refused(&mut fluid, mesh(open.clone(), None)), FluidError::Mesh { problem: "is not closed" });
    fluid.add_source(&Source::new(mesh(open, Some(0.1)))).unwrap();
    let missing = (positions, Arc::from([[0, 1, 8]]));
    assert!(matches!(refused(&mut fluid, mesh(missing, Some(0.1))), FluidError::Mesh { .. }));
    let smoke = other.scalar_id("smoke").unwrap();
    let source = Source { scalars: vec![ScalarSource::new(smoke)], ..ball() };
    assert_eq!(fluid.add_source(&source), Err(FluidError::UnknownScalar { index: 1, count: 1 }));
    let id = fluid.attach_source(ball()).unwrap();
    assert!(fluid.set_source(id, Source { heat_kw: f32::NAN, ..ball() }).is_err());
    fluid.detach_source(id).unwrap();
    assert_eq!(fluid.detach_source(id), Err(FluidError::UnknownSource { id: 0 }));
    assert_eq!(fluid.set_source(id, ball()), Err(FluidError::UnknownSource { id: 0 }));
    assert_eq!(fluid.state_hash(), hash);
}

/// Sum of what is about to accelerate the air times the volume of a cell, by axis.
fn pending_push(fluid: &Fluid) -> [f64; 3] {
    let saved = serde_json::to_value(fluid.save()).unwrap();
    let volume: f64 = fluid.cell_size_m().to_array().map(f64::from).iter().product();
    [0, 1, 2].map(|axis| {
        let values = saved["pending"]["acceleration"][axis].as_array().unwrap();
        volume * values.iter().map(|value| value.as_f64().unwrap()).sum::<f64>()
    })
}

#[test]
fn a_push_has_the_same_momentum_on_every_grid() {
    let push = Vec3::new(3.0, 20.0, -7.0);
    for (cells, sides) in [([9, 14, 10], Sides::CLOSED), ([20, 31, 17], Sides::OPEN), ([16, 8, 8], Sides::PERIODIC)] {
        for (point, reach_m) in
            [(Vec3::new(0.5, 0.6, 0.5), 0.2), (Vec3::new(0.03, 0.9, 0.97), 0.3), (Vec3::new(0.99, 0.5, 0.5), 0.01)]
        {
            let mut fluid = Fluid::builder(cells).size_m(Vec3::ONE).sides(sides).build().unwrap();
            fluid.add_push(point, reach_m, push).unwrap();
            for (found, wanted) in pending_push(&fluid).into_iter().zip(push.to_array()) {
                let wanted = f64::from(wanted * reach_m.powi(3));
                assert!((found / wanted - 1.0).abs() < 1.0e-5, "{cells:?} {point} {reach_m}: {found} for {wanted}");
            }
        }
    }
    let mut fluid = Fluid::builder([8; 3]).size_m(Vec3::ONE).build().unwrap();
    fluid.add_push(Vec3::new(0.5, 1.3, 0.5), 0.2, push).unwrap();
    assert_eq!(pending_push(&fluid), [0.0; 3], "out of reach");
}
