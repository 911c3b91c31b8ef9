//! Random scenes: what must hold in every one. The same scenes in every run.

mod twohalf_common;

use std::cell::Cell;

use proptest::prelude::{Just, Strategy, prop_oneof};
use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestRng, TestRunner};
use twohalf::farseer_core::{BroadPhaseCollider, PhysicsSimulator, Vertices};
use twohalf::{BodyId, DepthProfile, GeomId, Partner, TwoHalfPhysicsSimulator, Vector2, Vector3};
use twohalf_common::{DT, GRAVITY, SLOP, platform, run, set_platform_surface};
use twohalf_factories::{TwoHalfBodyFactory, TwoHalfGeomFactory};

/// Scenes per property.
const CASES: u32 = 48;

/// Middle of the room in which objects begin, px.
const MIDDLE: [f32; 3] = [90.0, 60.0, 60.0];

#[derive(Debug, Clone, Copy)]
enum Form {
    Ball,
    Box,
    Polygon { corners: i32 },
    /// Not convex.
    Angle,
}

/// An object: extents in px, place of its middle, velocity along X, up and Z.
#[derive(Debug, Clone, Copy)]
struct Thing {
    form: Form,
    size: [f32; 3],
    place: [f32; 3],
    velocity: [f32; 3],
    spin: f32,
    mass: f32,
    friction: f32,
    restitution: f32,
}

fn thing(speed: f32) -> impl Strategy<Value = Thing> {
    let form = prop_oneof![
        Just(Form::Ball),
        Just(Form::Box),
        (3..8_i32).prop_map(|corners| Form::Polygon { corners }),
        Just(Form::Angle),
    ];
    let velocity = [-speed..speed, -speed..speed, -speed..speed];
    let rest = (-3.0..3.0_f32, 0.5..4.0_f32, 0.0..0.8_f32, 0.0..0.9_f32);
    (form, [12.0..40.0_f32, 12.0..40.0, 12.0..40.0], velocity, rest).prop_map(
        |(form, size, velocity, (spin, mass, friction, restitution))| Thing {
            form,
            size,
            place: [0.0; 3],
            velocity,
            spin,
            mass,
            friction,
            restitution,
        },
    )
}

/// Some objects that do not overlap: each has a cell of 60 px of its own and lies anywhere within it.
fn things(speed: f32) -> impl Strategy<Value = Vec<Thing>> {
    let cell = [0.0..16.0_f32, 0.0..16.0, 0.0..16.0];
    proptest::collection::vec((thing(speed), cell), 2..13).prop_map(|things| {
        let put = |(index, (thing, cell)): (usize, (Thing, [f32; 3]))| {
            let corner = [index % 3, index / 3 % 2, index / 6].map(|cell| 60.0 * cell as f32);
            let place: [f32; 3] = std::array::from_fn(|axis| corner[axis] + cell[axis] + 22.0);
            // Towards the middle, so that they meet.
            let velocity = std::array::from_fn(|axis| thing.velocity[axis] + MIDDLE[axis] - place[axis]);
            Thing { place, velocity, ..thing }
        };
        things.into_iter().enumerate().map(put).collect()
    })
}

/// Makes an object, its lowest point at least at `floor`; on its ground if it has one.
fn make(simulator: &mut TwoHalfPhysicsSimulator, thing: Thing, floor: f32, has_ground: bool) -> BodyId {
    let [width, height, depth] = thing.size;
    let (body, geom) = match thing.form {
        Form::Ball => {
            let radius = width * 0.5;
            let body = TwoHalfBodyFactory::create_circle_body(simulator, radius, thing.mass).unwrap();
            (body, TwoHalfGeomFactory::create_circle_geom(simulator, body, radius, 16).unwrap())
        }
        Form::Box => {
            let body = TwoHalfBodyFactory::create_rectangle_body(simulator, width, height, thing.mass).unwrap();
            (body, TwoHalfGeomFactory::create_rectangle_geom(simulator, body, width, height).unwrap())
        }
        Form::Polygon { corners } => {
            outlined(simulator, Vertices::create_circle(width * 0.5, corners).unwrap(), thing.mass)
        }
        Form::Angle => {
            let (w, h) = (width * 0.5, height * 0.5);
            let corners = [[-w, -h], [-w, h], [w, h], [w, 0.0], [0.0, 0.0], [0.0, -h]];
            let outline: Vec<Vector2> = corners.map(Vector2::from).into();
            outlined(simulator, Vertices::from(outline), thing.mass)
        }
    };
    if !matches!(thing.form, Form::Ball) {
        simulator.set_depth_profile(geom, DepthProfile::Prism { depth }).unwrap();
    }
    let settings = simulator.geom_mut(geom).unwrap();
    settings.set_friction_coefficient(thing.friction);
    settings.set_restitution_coefficient(thing.restitution);
    let mut view = simulator.body_mut(body).unwrap();
    view.set_linear_drag_coefficient(0.0);
    view.set_rotational_drag_coefficient(0.0);
    if has_ground {
        view.ground_mut().set_object_geom(geom, None).unwrap();
        view.ground_mut().set_friction_coefficient(thing.friction);
        view.ground_mut().set_restitution_coefficient(thing.restitution);
    }
    let [x, y, z] = thing.place;
    view.set_position3d(Vector3::new(x, y + floor, z));
    view.set_velocity3d(Vector3::from(thing.velocity));
    view.set_angular_velocity(thing.spin);
    body
}

fn outlined(simulator: &mut TwoHalfPhysicsSimulator, outline: Vertices, mass: f32) -> (BodyId, GeomId) {
    let body = TwoHalfBodyFactory::create_polygon_body(simulator, outline.clone(), mass).unwrap();
    (body, TwoHalfGeomFactory::create_polygon_geom(simulator, body, outline, 0.0).unwrap())
}

/// Checks a property of random scenes, the same ones in every run.
fn check<S: Strategy>(strategy: S, property: impl Fn(S::Value)) {
    let config = Config { cases: CASES, failure_persistence: None, max_shrink_iters: 200, ..Config::default() };
    let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut runner = TestRunner::new_with_rng(config, rng);
    let outcome = runner.run(&strategy, |value| {
        property(value);
        Ok::<(), TestCaseError>(())
    });
    if let Err(error) = outcome {
        panic!("{error}");
    }
}

fn weightless_scene(things: &[Thing]) -> (TwoHalfPhysicsSimulator, Vec<BodyId>) {
    let mut simulator = TwoHalfPhysicsSimulator::with_angle(600, 60).unwrap();
    let bodies = things.iter().map(|&thing| make(&mut simulator, thing, 0.0, false)).collect();
    (simulator, bodies)
}

/// With gravity, over the ground and two platforms: a level one below the objects and a slope beside it.
fn heavy_scene(things: &[Thing]) -> (TwoHalfPhysicsSimulator, Vec<BodyId>) {
    let gravity = Vector2::new(0.0, GRAVITY);
    let mut simulator = TwoHalfPhysicsSimulator::with_angle_and_gravity(600, 60, gravity).unwrap();
    let floor = platform(&mut simulator, [120.0, 30.0, 70.0], [40.0, 20.0, 40.0]);
    set_platform_surface(&mut simulator, floor, 0.4, 0.2);
    let position = Vector3::new(190.0, 30.0, 40.0);
    let slope = twohalf::Platform::with_rotation(&mut simulator, 120.0, 20.0, 90.0, position, -0.4, None).unwrap();
    set_platform_surface(&mut simulator, slope, 0.4, 0.2);
    for [width, depth, x, z] in [[40.0, 400.0, -40.0, 60.0], [40.0, 400.0, 240.0, 60.0], [400.0, 40.0, 100.0, -50.0], [400.0, 40.0, 100.0, 170.0]] {
        platform(&mut simulator, [width, 800.0, depth], [x, -100.0, z]);
    }
    let bodies = things.iter().map(|&thing| make(&mut simulator, thing, 110.0, true)).collect();
    (simulator, bodies)
}

/// Sum of m v, and of m |v|.
fn momenta(simulator: &TwoHalfPhysicsSimulator, bodies: &[BodyId]) -> ([f64; 3], f64) {
    let (mut sum, mut size) = ([0.0; 3], 0.0);
    for view in bodies.iter().map(|&body| simulator.body(body).unwrap()) {
        let (mass, velocity) = (f64::from(view.mass()), view.velocity3d());
        (0..3).for_each(|axis| sum[axis] += mass * f64::from(velocity[axis]));
        size += mass * f64::from(velocity.norm());
    }
    (sum, size)
}

/// Kinetic energy, spin included.
fn kinetic(simulator: &TwoHalfPhysicsSimulator, bodies: &[BodyId]) -> f64 {
    let of = |&body: &BodyId| {
        let view = simulator.body(body).unwrap();
        let inertia = f64::from(view.core().moment_of_inertia());
        let spin = f64::from(view.angular_velocity3d().norm_squared());
        0.5 * (f64::from(view.mass()) * f64::from(view.velocity3d().norm_squared()) + inertia * spin)
    };
    bodies.iter().map(of).sum()
}

#[test]
fn measure() {
    let worst = Cell::new(0.0_f64);
    let worst_momentum = Cell::new(0.0_f64);
    let touched = Cell::new(0);
    check(things(40.0), |things| {
        let (mut simulator, bodies) = weightless_scene(&things);
        let before = kinetic(&simulator, &bodies);
        let (p, size) = momenta(&simulator, &bodies);
        for _ in 0..200 {
            simulator.update(DT);
            touched.set(touched.get() + simulator.contacts().count());
            let after = kinetic(&simulator, &bodies);
            worst.set(worst.get().max(after / before));
        }
        let (q, _) = momenta(&simulator, &bodies);
        let off = (0..3).map(|i| (p[i] - q[i]).abs()).fold(0.0, f64::max) / size;
        worst_momentum.set(worst_momentum.get().max(off));
    });
    println!("energy {} momentum {} touched {}", worst.get(), worst_momentum.get(), touched.get());
    let deepest = Cell::new([0.0_f32; 3]);
    let speed = Cell::new(0.0_f32);
    check(things(40.0), |things| {
        let (mut simulator, bodies) = heavy_scene(&things);
        run(&mut simulator, 1500);
        let mut d = deepest.get();
        for contact in simulator.contacts() {
            let kind = match contact.partner { Partner::Ground => 0, Partner::Platform(_) => 1, _ => 2 };
            d[kind] = d[kind].min(contact.separation);
        }
        deepest.set(d);
        let s = bodies.iter().map(|&b| simulator.body(b).unwrap().velocity3d().norm()).fold(0.0, f32::max);
        println!("speed {s} d {d:?}");
        speed.set(speed.get().max(s));
    });
    println!("deepest {:?} speed {}", deepest.get(), speed.get());
    for only_balls in [true, false] {
    let same = Cell::new(0);
    check(things(40.0), |mut things| {
        if only_balls { things.iter_mut().for_each(|t| t.form = Form::Ball); }
        let ends: Vec<String> = [BroadPhaseCollider::SelectiveSweep, BroadPhaseCollider::SweepAndPrune, BroadPhaseCollider::BruteForce, BroadPhaseCollider::SPATIAL_HASH].into_iter().map(|method| {
            let mut core = PhysicsSimulator::default();
            core.set_broad_phase_collider(method).unwrap();
            let mut simulator = TwoHalfPhysicsSimulator::from_core(600, 60, core).unwrap();
            let bodies: Vec<BodyId> = things.iter().map(|&thing| make(&mut simulator, thing, 0.0, false)).collect();
            run(&mut simulator, 200);
            bodies.iter().map(|&b| format!("{:?} {:?}", simulator.body(b).unwrap().position3d(), simulator.body(b).unwrap().velocity3d())).collect()
        }).collect();
        same.set(same.get() + usize::from(ends.iter().all(|e| *e == ends[0])));
    });
    println!("only balls {only_balls}: {} of 48 same in all broad phases", same.get());
    }
}
