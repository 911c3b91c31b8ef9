//! Random scenes: invariants of all of them. The same scenes in every run.

use std::cell::Cell;

use conformance::fixtures::depth::{
    DT, GRAVITY, SLOP, platform, run, set_platform_surface, under_test, with_scheme,
};
use proptest::prelude::{Just, Strategy, prop_oneof};
use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestRng, TestRunner};
use twohalf::farseer_core::{BroadPhaseCollider, PhysicsSimulator, Vertices};
use twohalf::{
    BodyId, DepthProfile, DepthScheme, GeomId, Platform, TwoHalfPhysicsSimulator, Vector2, Vector3,
};
use twohalf_factories::{TwoHalfBodyFactory, TwoHalfGeomFactory};

/// Number of scenes per property.
const CASES: u32 = 48;

/// Middle of the space in which objects begin, px.
const MIDDLE: [f32; 3] = [90.0, 60.0, 60.0];

#[derive(Debug, Clone, Copy)]
enum Form {
    Ball,
    Box,
    Polygon {
        corners: i32,
    },
    /// Not convex.
    Angle,
}

/// An object: extents in px, position of its middle, velocity along X, up and Z.
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

/// Some objects that do not overlap: each has a cell of 60 px of its own and is anywhere within it.
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
            let body =
                TwoHalfBodyFactory::create_rectangle_body(simulator, width, height, thing.mass).unwrap();
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
    let config =
        Config { cases: CASES, failure_persistence: None, max_shrink_iters: 200, ..Config::default() };
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
    let mut simulator = under_test(TwoHalfPhysicsSimulator::with_angle(600, 60).unwrap());
    let bodies = things.iter().map(|&thing| make(&mut simulator, thing, 0.0, false)).collect();
    (simulator, bodies)
}

/// With gravity, over the ground and two platforms: a level one below the objects and a slope beside it.
fn heavy_scene(things: &[Thing]) -> (TwoHalfPhysicsSimulator, Vec<BodyId>) {
    let gravity = Vector2::new(0.0, GRAVITY);
    let mut simulator =
        under_test(TwoHalfPhysicsSimulator::with_angle_and_gravity(600, 60, gravity).unwrap());
    let floor = platform(&mut simulator, [120.0, 30.0, 70.0], [40.0, 20.0, 40.0]);
    set_platform_surface(&mut simulator, floor, 0.4, 0.2);
    let position = Vector3::new(190.0, 30.0, 40.0);
    let slope = Platform::with_rotation(&mut simulator, 120.0, 20.0, 90.0, position, -0.4, None).unwrap();
    set_platform_surface(&mut simulator, slope, 0.4, 0.2);
    // Four walls around it.
    for [x, z] in [[-1.0, 0.0], [1.0, 0.0], [0.0, -1.0], [0.0, 1.0]] {
        let size = if x == 0.0 { [400.0, 800.0, 40.0] } else { [40.0, 800.0, 400.0] };
        platform(&mut simulator, size, [100.0 + 140.0 * x, -100.0, 60.0 + 110.0 * z]);
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

/// Kinetic energy and that of the height of the middles.
fn energy(simulator: &TwoHalfPhysicsSimulator, bodies: &[BodyId]) -> f64 {
    let of_height = |&body: &BodyId| {
        let view = simulator.body(body).unwrap();
        f64::from(view.mass() * GRAVITY) * f64::from(view.origin3d().y)
    };
    kinetic(simulator, bodies) + bodies.iter().map(of_height).sum::<f64>()
}

#[test]
pub(crate) fn without_gravity_the_momentum_along_every_axis_stays() {
    let contacts = Cell::new(0);
    check(things(40.0), |things| {
        let (mut simulator, bodies) = weightless_scene(&things);
        let (before, size) = momenta(&simulator, &bodies);
        for _ in 0..300 {
            simulator.update(DT);
            contacts.set(contacts.get() + simulator.contacts().count());
        }
        let (after, _) = momenta(&simulator, &bodies);
        // Every impulse is added to the one body and subtracted from the other; the sums are rounded, by 6e-8 of the
        // velocity each.
        for axis in 0..3 {
            assert!((after[axis] - before[axis]).abs() < 1e-6 * size, "{before:?} {after:?}");
        }
    });
    assert!(contacts.get() > 500);
}

#[test]
pub(crate) fn without_gravity_the_kinetic_energy_does_not_grow() {
    check(things(40.0), |things| {
        let (mut simulator, bodies) = weightless_scene(&things);
        let start = kinetic(&simulator, &bodies);
        let mut last = start;
        for _ in 0..300 {
            simulator.update(DT);
            let now = kinetic(&simulator, &bodies);
            // Bias velocities correct overlap. The error that five iterations leave in contacts with several points may be
            // corrected in the next step: 2e-4 (measured).
            assert!(now <= last * 1.001 && now <= start * 1.000_001, "{start} {last} {now}");
            last = now;
        }
    });
}

#[test]
pub(crate) fn with_gravity_the_energy_grows_by_no_more_than_corrections_and_the_step_of_a_bounce_explain() {
    check(things(40.0), |things| {
        let (mut simulator, bodies) = heavy_scene(&things);
        let weight: f64 =
            bodies.iter().map(|&body| f64::from(simulator.body(body).unwrap().mass() * GRAVITY)).sum();
        let start = energy(&simulator, &bodies);
        let mut last = start;
        for _ in 0..600 {
            let speeds = bodies.iter().map(|&body| simulator.body(body).unwrap().velocity3d().norm());
            let fastest = f64::from(speeds.fold(0.0, f32::max));
            simulator.update(DT);
            let excess = simulator.contacts().map(|contact| (-contact.separation - SLOP).max(0.0));
            let excess: f64 = excess.map(f64::from).sum();
            let now = energy(&simulator, &bodies);
            // 0.8 of the overlap beyond the slop lifts at most everything. The velocity of gravity in the step of a bounce
            // comes back as well: (v + g dt)² - v² over 2 g, and v dt of height on the way up.
            let explained = weight * (0.8 * excess + 2.0 * (fastest + 1.0) * f64::from(DT));
            assert!(now <= last + explained, "{last} {now} {explained}");
            assert!(now <= start * 1.000_001, "{start} {now}");
            last = now;
        }
    });
}

/// Penetration depth of a body in an axis-aligned box, given by its least and greatest corners: the least displacement that
/// separates them, 0 if they do not overlap. For a ball it follows from the distance of its middle.
fn overlap(simulator: &TwoHalfPhysicsSimulator, body: BodyId, low: Vector3, high: Vector3) -> f32 {
    let geom = simulator.geom(simulator.body(body).unwrap().ground().object_geom().unwrap()).unwrap();
    let footprint = geom.virtual_geom();
    if let DepthProfile::Round { radius } = geom.depth_profile() {
        let middle = geom.position3d();
        let nearest = middle.sup(&low).inf(&high);
        return (radius - (middle - nearest).norm()).max(0.0);
    }
    let in_depth = (footprint.back - low.z).min(high.z - footprint.front);
    let of_corner = |corner: &Vector2| {
        let (x, y) = (corner.x, -corner.y);
        (x - low.x).min(high.x - x).min(y - low.y).min(high.y - y)
    };
    let in_plane = geom.world_vertices().iter().map(of_corner).fold(0.0, f32::max);
    in_plane.min(in_depth).max(0.0)
}

#[test]
fn after_settling_no_body_is_below_the_ground_or_inside_a_platform() {
    // The slop, and the motion of gravity in a step under those that lie on each other (measured: 0.052).
    check_settled(2.0 * SLOP);
}

#[test]
fn after_settling_with_the_precise_set_no_body_is_below_the_ground_or_inside_a_platform() {
    // Measured: 0.137, where a ball has been thrown into a gap and friction holds it there.
    with_scheme(DepthScheme::Precise, || check_settled(0.15));
}

fn check_settled(deepest: f32) {
    check(things(40.0), |mut things| {
        things.iter_mut().for_each(|thing| thing.restitution = 0.0);
        let (mut simulator, bodies) = heavy_scene(&things);
        run(&mut simulator, 1500);
        for contact in simulator.contacts() {
            assert!(contact.separation > -deepest, "{contact:?}");
        }
        let level: Vec<_> = simulator
            .platforms()
            .filter_map(|id| simulator.platform(id))
            .filter(|p| p.rotation() == 0.0)
            .collect();
        for &body in &bodies {
            assert!(simulator.body(body).unwrap().position3d().y > -deepest);
            for platform in &level {
                let [low, high] = [platform.corners()[3], platform.corners()[5]];
                let inside = overlap(&simulator, body, low, high);
                assert!(inside < deepest, "{inside} inside of {:?}", platform.position3d());
            }
        }
    });
}

#[test]
pub(crate) fn falling_bodies_penetrate_the_ground_and_platforms_by_no_more_than_a_step() {
    check(things(40.0), |things| {
        let (mut simulator, bodies) = heavy_scene(&things);
        for _ in 0..400 {
            simulator.update(DT);
            // They fall by less than 250 px: 224 px/s. Hits by others give up to twice as much.
            for &body in &bodies {
                assert!(simulator.body(body).unwrap().position3d().y > -2.0 * 224.0 * DT);
            }
        }
    });
}

fn assert_all_finite(simulator: &TwoHalfPhysicsSimulator, bodies: &[BodyId]) {
    for view in bodies.iter().map(|&body| simulator.body(body).unwrap()) {
        let numbers = [view.origin3d(), view.velocity3d(), view.angular_velocity3d()];
        assert!(numbers.iter().flat_map(|v| v.iter()).all(|number| number.is_finite()), "{numbers:?}");
    }
}

#[test]
pub(crate) fn all_numbers_stay_finite_at_any_speed() {
    for speed in [3e3, 1e7, 1e18, 1e38] {
        check(things(speed), |things| {
            let (mut simulator, bodies) = heavy_scene(&things);
            for _ in 0..60 {
                simulator.update(DT);
                assert_all_finite(&simulator, &bodies);
            }
        });
    }
}

#[test]
pub(crate) fn a_scene_that_was_saved_and_loaded_goes_on_with_the_same_bits() {
    check((things(40.0), 1..300_usize), |(things, steps)| {
        for is_heavy in [true, false] {
            let (mut simulator, _) = if is_heavy { heavy_scene(&things) } else { weightless_scene(&things) };
            run(&mut simulator, steps);
            let saved = serde_json::to_string(&simulator).unwrap();
            let mut loaded: TwoHalfPhysicsSimulator = serde_json::from_str(&saved).unwrap();
            for _ in 0..60 {
                simulator.update(DT);
                loaded.update(DT);
                assert_eq!(simulator.events(), loaded.events());
            }
            assert!(serde_json::to_string(&simulator).unwrap() == serde_json::to_string(&loaded).unwrap());
        }
    });
}

#[test]
pub(crate) fn a_scene_of_balls_does_the_same_with_every_broad_phase() {
    // Their contacts are solved in the order of creation, for every broad phase.
    let methods = [
        BroadPhaseCollider::SelectiveSweep,
        BroadPhaseCollider::SweepAndPrune,
        BroadPhaseCollider::BruteForce,
        BroadPhaseCollider::SPATIAL_HASH,
    ];
    check(things(40.0), |things| {
        let ends = methods.map(|method| {
            let mut core = PhysicsSimulator::new(Vector2::new(0.0, GRAVITY)).unwrap();
            core.set_broad_phase_collider(method).unwrap();
            let mut simulator = under_test(TwoHalfPhysicsSimulator::from_core(600, 60, core).unwrap());
            let as_ball = |thing: &Thing| Thing { form: Form::Ball, ..*thing };
            let balls: Vec<Thing> = things.iter().map(as_ball).collect();
            let bodies: Vec<BodyId> =
                balls.iter().map(|&ball| make(&mut simulator, ball, 0.0, true)).collect();
            run(&mut simulator, 300);
            let state = |&body: &BodyId| {
                let view = simulator.body(body).unwrap();
                [view.origin3d(), view.velocity3d(), view.angular_velocity3d()]
                    .map(|v| [v.x, v.y, v.z].map(f32::to_bits))
            };
            bodies.iter().map(state).collect::<Vec<_>>()
        });
        assert!(ends.iter().all(|end| *end == ends[0]));
    });
}
