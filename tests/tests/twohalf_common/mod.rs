//! What the tests of the 2.5D engine share. Lengths in px, steps of 0.01 s, gravity 100 px/s².
#![allow(dead_code, reason = "not every test program needs everything")]

use twohalf::{
    Axis, BodyId, Collision, DepthProfile, Event, EventHandler, GeomId, Partner, Platform, PlatformId,
    TwoHalfPhysicsSimulator, Vector2, Vector3,
};
use twohalf_factories::{TwoHalfBodyFactory, TwoHalfGeomFactory};

/// Length of a step in s.
pub(crate) const DT: f32 = 0.01;
/// Gravity in px/s².
pub(crate) const GRAVITY: f32 = 100.0;

/// An empty simulator with gravity.
pub(crate) fn simulator() -> TwoHalfPhysicsSimulator {
    TwoHalfPhysicsSimulator::with_angle_and_gravity(600, 60, Vector2::new(0.0, GRAVITY)).unwrap()
}

/// An empty simulator without gravity.
pub(crate) fn weightless() -> TwoHalfPhysicsSimulator {
    TwoHalfPhysicsSimulator::with_angle(600, 60).unwrap()
}

/// A ball of mass 1 without drag whose lowest point is at a place.
pub(crate) fn ball(simulator: &mut TwoHalfPhysicsSimulator, radius: f32, place: [f32; 3]) -> BodyId {
    let body = TwoHalfBodyFactory::create_circle_body(simulator, radius, 1.0).unwrap();
    let geom = TwoHalfGeomFactory::create_circle_geom(simulator, body, radius, 24).unwrap();
    finish(simulator, body, geom, place)
}

/// A box of mass 1 without drag whose lowest point is at a place.
pub(crate) fn crate_box(simulator: &mut TwoHalfPhysicsSimulator, size: [f32; 2], place: [f32; 3]) -> BodyId {
    let [width, height] = size;
    let body = TwoHalfBodyFactory::create_rectangle_body(simulator, width, height, 1.0).unwrap();
    let geom = TwoHalfGeomFactory::create_rectangle_geom(simulator, body, width, height).unwrap();
    finish(simulator, body, geom, place)
}

fn finish(
    simulator: &mut TwoHalfPhysicsSimulator,
    body: BodyId,
    geom: twohalf::GeomId,
    place: [f32; 3],
) -> BodyId {
    let mut view = simulator.body_mut(body).unwrap();
    view.core_mut().set_linear_drag_coefficient(0.0);
    view.core_mut().set_rotational_drag_coefficient(0.0);
    view.ground_mut().set_object_geom(geom, None).unwrap();
    view.set_position3d(Vector3::from(place));
    body
}

/// Gives a body's object geom and ground the same coefficients, so that these are the combined ones.
pub(crate) fn set_surface(
    simulator: &mut TwoHalfPhysicsSimulator,
    body: BodyId,
    friction: f32,
    restitution: f32,
) {
    let mut view = simulator.body_mut(body).unwrap();
    let mut ground = view.ground_mut();
    ground.set_friction_coefficient(friction);
    ground.set_restitution_coefficient(restitution);
    let geom = ground.object_geom().unwrap();
    let geom = simulator.geom_mut(geom).unwrap();
    geom.set_friction_coefficient(friction);
    geom.set_restitution_coefficient(restitution);
}

/// Position of a body in the world.
pub(crate) fn place(simulator: &TwoHalfPhysicsSimulator, body: BodyId) -> Vector3 {
    simulator.body(body).unwrap().position3d()
}

/// Sets the velocity along X, up and along Z.
pub(crate) fn throw(simulator: &mut TwoHalfPhysicsSimulator, body: BodyId, velocity: [f32; 3]) {
    let mut view = simulator.body_mut(body).unwrap();
    view.set_linear_velocity(Vector2::new(velocity[0], -velocity[1]));
    view.set_linear_velocity_z(velocity[2]);
}

/// Makes a number of steps.
pub(crate) fn run(simulator: &mut TwoHalfPhysicsSimulator, steps: usize) {
    for _ in 0..steps {
        simulator.update(DT);
    }
}

/// Three balls and three boxes at various depths that fall, bounce, meet and come to rest.
pub(crate) fn busy_scene() -> (TwoHalfPhysicsSimulator, Vec<BodyId>) {
    let mut simulator = simulator();
    let mut bodies = Vec::new();
    for index in 0..3 {
        let i = index as f32;
        let b = ball(&mut simulator, 20.0 + i, [100.0 + 35.0 * i, 80.0 + 60.0 * i, 10.0 * i]);
        set_surface(&mut simulator, b, 0.4, 0.5);
        throw(&mut simulator, b, [10.0 - 15.0 * i, 0.0, 20.0 * i]);
        let c = crate_box(&mut simulator, [50.0, 30.0 + i], [105.0 + 20.0 * i, 150.0 * i, 5.0 * i]);
        set_surface(&mut simulator, c, 0.5, 0.1);
        bodies.extend([b, c]);
    }
    (simulator, bodies)
}

/// The overlap that the solver leaves alone, px.
pub(crate) const SLOP: f32 = 0.05;

/// Fails unless a value is near another one.
#[track_caller]
pub(crate) fn assert_near(value: f32, expected: f32, tolerance: f32) {
    assert!((value - expected).abs() <= tolerance, "{value} is not within {tolerance} of {expected}");
}

/// Fails unless a vector is near another one.
#[track_caller]
pub(crate) fn assert_near3(value: Vector3, expected: [f32; 3], tolerance: f32) {
    let distance = (value - Vector3::from(expected)).norm();
    assert!(distance <= tolerance, "{value:?} is not within {tolerance} of {expected:?}");
}

/// A box of a depth of its own, otherwise as [`crate_box`].
pub(crate) fn solid(simulator: &mut TwoHalfPhysicsSimulator, size: [f32; 3], place: [f32; 3]) -> BodyId {
    let [width, height, depth] = size;
    let body = crate_box(simulator, [width, height], place);
    let geom = geom_of(simulator, body);
    simulator.set_depth_profile(geom, DepthProfile::Prism { depth }).unwrap();
    body
}

/// The object geom of a body.
pub(crate) fn geom_of(simulator: &TwoHalfPhysicsSimulator, body: BodyId) -> GeomId {
    simulator.body(body).unwrap().ground().object_geom().unwrap()
}

/// Velocity of a body along X, up and along Z.
pub(crate) fn velocity(simulator: &TwoHalfPhysicsSimulator, body: BodyId) -> Vector3 {
    simulator.body(body).unwrap().velocity3d()
}

/// A level platform: width, height and depth; X, underside and Z.
pub(crate) fn platform(
    simulator: &mut TwoHalfPhysicsSimulator,
    size: [f32; 3],
    place: [f32; 3],
) -> PlatformId {
    let [width, height, depth] = size;
    Platform::new(simulator, width, height, depth, Vector3::from(place), None).unwrap()
}

/// Sets the coefficients of a platform.
pub(crate) fn set_platform_surface(
    simulator: &mut TwoHalfPhysicsSimulator,
    platform: PlatformId,
    friction: f32,
    restitution: f32,
) {
    let mut view = simulator.platform_mut(platform).unwrap();
    view.settings_mut().set_friction_coefficient(friction);
    view.settings_mut().set_restitution_coefficient(restitution);
}

/// Makes a body immovable.
pub(crate) fn fix(simulator: &mut TwoHalfPhysicsSimulator, body: BodyId) {
    simulator.body_mut(body).unwrap().set_is_static(true);
}

/// Momentum of some bodies along X, up and along Z.
pub(crate) fn momentum(simulator: &TwoHalfPhysicsSimulator, bodies: &[BodyId]) -> Vector3 {
    let of = |&body: &BodyId| velocity(simulator, body) * simulator.body(body).unwrap().mass();
    bodies.iter().map(of).sum()
}

/// What a geom was told of its contacts in the last update.
pub(crate) fn collisions_of(simulator: &TwoHalfPhysicsSimulator, geom: GeomId) -> Vec<Collision> {
    let of_geom = |event: &Event| match event {
        Event::Collision(collision) if collision.this == geom => Some(*collision),
        _ => None,
    };
    simulator.events().iter().filter_map(of_geom).collect()
}

/// Makes steps until the geom is told of a contact, and gives that.
#[track_caller]
pub(crate) fn run_until_hit(simulator: &mut TwoHalfPhysicsSimulator, geom: GeomId) -> Collision {
    for _ in 0..5_000 {
        simulator.update(DT);
        if let Some(collision) = collisions_of(simulator, geom).first() {
            return *collision;
        }
    }
    panic!("the geom touches nothing");
}

/// Two boxes or two balls of masses 2 and 1 without gravity, the second of which comes along an axis with 80 px/s.
pub(crate) fn pair_along(axis: Axis, restitution: f32) -> (TwoHalfPhysicsSimulator, [BodyId; 2], Vector3) {
    let mut simulator = weightless();
    let (bodies, direction) = match axis {
        Axis::Plane => {
            let still = solid(&mut simulator, [40.0, 40.0, 40.0], [0.0, 500.0, 0.0]);
            let thrown = solid(&mut simulator, [20.0, 20.0, 20.0], [-80.3, 510.0, 0.0]);
            ([still, thrown], Vector3::new(1.0, 0.0, 0.0))
        }
        Axis::Depth => {
            let still = solid(&mut simulator, [40.0, 40.0, 40.0], [0.0, 500.0, 0.0]);
            let thrown = solid(&mut simulator, [20.0, 20.0, 20.0], [0.0, 510.0, -80.3]);
            ([still, thrown], Vector3::new(0.0, 0.0, 1.0))
        }
        Axis::Oblique => {
            let still = ball(&mut simulator, 20.0, [0.0, 500.0, 0.0]);
            let thrown = ball(&mut simulator, 10.0, [-60.0, 510.0, -80.0]);
            ([still, thrown], Vector3::new(0.6, 0.0, 0.8))
        }
    };
    simulator.body_mut(bodies[0]).unwrap().set_mass(2.0).unwrap();
    for body in bodies {
        set_surface(&mut simulator, body, 0.0, restitution);
    }
    throw(&mut simulator, bodies[1], (direction * 80.0).into());
    (simulator, bodies, direction)
}

pub(crate) const AXES: [Axis; 3] = [Axis::Plane, Axis::Depth, Axis::Oblique];

/// Makes steps with a handler.
pub(crate) fn run_with(
    simulator: &mut TwoHalfPhysicsSimulator,
    handler: &mut dyn EventHandler,
    steps: usize,
) {
    for _ in 0..steps {
        simulator.update_with(DT, handler);
    }
}

/// A ball and a box of mass 1 that fall from 100 px onto the ground or a platform.
pub(crate) fn falling(
    is_ball: bool,
    on_platform: bool,
    restitution: f32,
) -> (TwoHalfPhysicsSimulator, BodyId, Partner) {
    let mut simulator = simulator();
    let mut partner = Partner::Ground;
    let mut height = 100.0;
    if on_platform {
        let floor = platform(&mut simulator, [200.0, 40.0, 100.0], [0.0, 20.0, 0.0]);
        set_platform_surface(&mut simulator, floor, 0.0, restitution);
        (partner, height) = (Partner::Platform(floor), 160.0);
    }
    let body = match is_ball {
        true => ball(&mut simulator, 10.0, [0.0, height, 0.0]),
        false => crate_box(&mut simulator, [20.0, 20.0], [0.0, height, 0.0]),
    };
    set_surface(&mut simulator, body, 0.0, restitution);
    (simulator, body, partner)
}

pub(crate) const FALLS: [(bool, bool); 4] = [(true, true), (true, false), (false, true), (false, false)];
