//! Scenes with a few objects of each kind.

use farseer_core::math::Vector2;
use farseer_core::{
    Body, BodyFactory, BodyId, BroadPhaseCollider, FluidContainerRef, FluidDragController, GeomFactory,
    GeomId, GeomPlacement, GravityController, InactivityController, JointFactory, Methods,
    NarrowPhaseCollider, PhysicsSimulator, SpringFactory, WaveController,
};
use twohalf::{DepthProfile, DepthScheme, Platform, TwoHalfPhysicsSimulator, Vector3};
use twohalf_factories::{TwoHalfBodyFactory, TwoHalfGeomFactory};

use crate::plane::{create_floor, create_thing};
use crate::random::Random;

/// All broad phases of the 2D engine.
pub const BROAD_PHASES: [BroadPhaseCollider; 4] = [
    BroadPhaseCollider::SelectiveSweep,
    BroadPhaseCollider::SweepAndPrune,
    BroadPhaseCollider::BruteForce,
    BroadPhaseCollider::SPATIAL_HASH,
];

/// Returns sets of methods whose saves must give the same results: the faithful set with each broad phase, and the precise set.
pub fn methods() -> impl Iterator<Item = Methods> {
    let narrow = NarrowPhaseCollider::default();
    BROAD_PHASES.into_iter().map(move |broad| Methods::Faithful { broad, narrow }).chain([Methods::PRECISE])
}

/// Number of different scenes of an engine: one for each combination of broad phase and narrow phase.
pub const KINDS: usize = 2 * BROAD_PHASES.len();

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

fn world(kind: usize) -> Result<PhysicsSimulator> {
    let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 100.0))?;
    simulator.set_broad_phase_collider(BROAD_PHASES[kind % BROAD_PHASES.len()])?;
    if kind >= BROAD_PHASES.len() {
        simulator.set_narrow_phase_collider(NarrowPhaseCollider::Sat);
    }
    Ok(simulator)
}

/// Returns a simulator with bodies that fall on a floor and into water, with joints, springs and controllers of all kinds.
///
/// # Errors
/// Never: the simulator accepts all arguments that are used here.
pub fn plane(kind: usize) -> Result<PhysicsSimulator> {
    let mut simulator = world(kind)?;
    let mut random = Random::new(kind as u64);
    create_floor(&mut simulator)?;
    let things = (0..10)
        .map(|_| create_thing(&mut simulator, &mut random))
        .collect::<farseer_core::Result<Vec<_>>>()?;
    let bodies: Vec<BodyId> = things.iter().map(|thing| thing.0).collect();
    let geoms: Vec<GeomId> = things.iter().map(|thing| thing.1).collect();
    add_joints(&mut simulator, &bodies)?;
    add_springs(&mut simulator, &bodies)?;
    add_controllers(&mut simulator, &bodies, &geoms)?;
    simulator.geom_mut(geoms[0]).expect("it was just made").set_restitution_coefficient(0.6);
    Ok(simulator)
}

/// Number of different scenes of the precise set.
pub const PRECISE_KINDS: usize = 4;

/// Returns a simulator of the precise set. Bodies fall on each other, on hills, on a lift and into water, with joints, springs
/// and controllers of all kinds.
///
/// # Errors
/// Never: the simulator accepts all arguments that are used here.
pub fn precise(kind: usize) -> Result<PhysicsSimulator> {
    let mut simulator = world(0)?;
    simulator.set_methods(Methods::PRECISE)?;
    simulator.set_iterations(4);
    let mut random = Random::new(100 + kind as u64);
    create_floor(&mut simulator)?;
    create_hills(&mut simulator)?;
    create_lift(&mut simulator)?;
    let things = (0..20 * (kind + 1))
        .map(|_| create_thing(&mut simulator, &mut random))
        .collect::<farseer_core::Result<Vec<_>>>()?;
    let bodies: Vec<BodyId> = things.iter().map(|thing| thing.0).collect();
    let geoms: Vec<GeomId> = things.iter().map(|thing| thing.1).collect();
    for &body in bodies.iter().skip(10).step_by(3) {
        let place = GeomPlacement::default();
        GeomFactory::create_capsule_geom_in(&mut simulator, body, 30.0, 6.0, 6, place)?;
    }
    add_joints(&mut simulator, &bodies)?;
    add_springs(&mut simulator, &bodies)?;
    add_controllers(&mut simulator, &bodies, &geoms)?;
    geoms.iter().step_by(3).for_each(|&geom| simulator[geom].set_restitution_coefficient(0.6));
    Ok(simulator)
}

/// Makes hills: a chain on each side of the floor.
fn create_hills(simulator: &mut PhysicsSimulator) -> Result<()> {
    let ground = simulator.create_body(Body::new());
    simulator[ground].set_is_static(true);
    simulator.add(ground)?;
    let heights = [60.0, 110.0, 90.0, 109.0, 112.0, 110.0, 95.0, 100.0, 40.0];
    let point = |(number, &y): (usize, &f32)| Vector2::new(number as f32 * 100.0 - 400.0, y);
    let points: Vec<Vector2> = heights.iter().enumerate().map(point).collect();
    GeomFactory::create_chain_geom_in(simulator, ground, &points, GeomPlacement::default())?;
    Ok(())
}

fn create_lift(simulator: &mut PhysicsSimulator) -> Result<()> {
    let lift = BodyFactory::create_rectangle_body_in(simulator, 60.0, 6.0, 1.0)?;
    GeomFactory::create_rectangle_geom_in(simulator, lift, 60.0, 6.0, GeomPlacement::default())?;
    simulator[lift].set_is_kinematic(true);
    simulator[lift].set_position(Vector2::new(-60.0, 100.0));
    simulator[lift].set_linear_velocity(Vector2::new(15.0, -30.0));
    simulator[lift].set_angular_velocity(0.2);
    Ok(())
}

fn add_joints(simulator: &mut PhysicsSimulator, b: &[BodyId]) -> Result<()> {
    let (none, x, y) = (Vector2::zeros(), Vector2::new(3.0, 0.0), Vector2::new(0.0, 3.0));
    JointFactory::create_revolute_joint_in(simulator, b[0], b[1], none)?;
    JointFactory::create_pin_joint_in(simulator, b[1], x, b[2], y)?;
    JointFactory::create_slider_joint_in(simulator, b[2], x, b[3], y, 5.0, 20.0)?;
    JointFactory::create_angle_joint_in(simulator, b[4], b[5])?;
    JointFactory::create_angle_limit_joint_in(simulator, b[3], b[4], -0.3, 0.3)?;
    JointFactory::create_weld_joint_in(simulator, b[5], b[6], none)?;
    JointFactory::create_fixed_angle_joint_in(simulator, b[6])?;
    JointFactory::create_fixed_angle_limit_joint_in(simulator, b[8], -0.3, 0.3)?;
    JointFactory::create_fixed_revolute_joint_in(simulator, b[7], Vector2::new(0.0, -80.0))?;
    Ok(())
}

fn add_springs(simulator: &mut PhysicsSimulator, b: &[BodyId]) -> Result<()> {
    let (x, y, hook) = (Vector2::new(1.0, 0.0), Vector2::new(0.0, 1.0), Vector2::new(0.0, -60.0));
    SpringFactory::create_linear_spring_in(simulator, b[7], x, b[8], y, 30.0, 1.0)?;
    SpringFactory::create_fixed_linear_spring_in(simulator, b[8], x, hook, 30.0, 1.0)?;
    SpringFactory::create_angle_spring_in(simulator, b[8], b[9], 30.0, 1.0)?;
    SpringFactory::create_fixed_angle_spring_in(simulator, b[9], 30.0, 1.0)?;
    Ok(())
}

fn add_controllers(simulator: &mut PhysicsSimulator, b: &[BodyId], geoms: &[GeomId]) -> Result<()> {
    let water =
        simulator.create_controller(WaveController::new(Vector2::new(-150.0, 80.0), 300.0, 60.0, 8)?)?;
    let lift = Vector2::new(0.0, 100.0);
    let mut fluid = FluidDragController::new(FluidContainerRef::Wave(water), 0.001, 1.0, 0.5, lift)?;
    geoms.iter().try_for_each(|&geom| fluid.add_geom(geom))?;
    let fluid = simulator.create_controller(fluid)?;
    let pull = GravityController::new(vec![b[0]], vec![Vector2::new(5.0, 5.0)], 100.0, 100.0)?;
    let pull = simulator.create_controller(pull)?;
    let inactivity = simulator.create_controller(InactivityController::new())?;
    [water, fluid, pull, inactivity].into_iter().try_for_each(|controller| simulator.add(controller))?;
    Ok(())
}

/// Returns a 2.5D simulator with balls and boxes that fall on platforms and the ground.
///
/// # Errors
/// Never: the simulator accepts all arguments that are used here.
pub fn depth(kind: usize) -> Result<TwoHalfPhysicsSimulator> {
    let mut random = Random::new(kind as u64);
    let mut simulator = TwoHalfPhysicsSimulator::from_core(600, 60, world(kind)?)?;
    match kind % 4 {
        1 => simulator.set_depth_scheme(DepthScheme::Precise)?,
        3 => simulator.set_depth_scheme(DepthScheme::Thesis)?,
        _ => {}
    }
    let (right, left) = (Vector3::new(30.0, 20.0, 30.0), Vector3::new(-80.0, 20.0, 30.0));
    Platform::with_rotation(&mut simulator, 120.0, 20.0, 60.0, right, -0.3, None)?;
    Platform::new(&mut simulator, 120.0, 20.0, 60.0, left, None)?;
    for number in 0..10 {
        add_object(&mut simulator, &mut random, number)?;
    }
    Ok(simulator)
}

fn add_object(simulator: &mut TwoHalfPhysicsSimulator, random: &mut Random, number: usize) -> Result<()> {
    let body = TwoHalfBodyFactory::create_circle_body(simulator, 8.0, 1.0)?;
    let geom = if number.is_multiple_of(2) {
        TwoHalfGeomFactory::create_circle_geom(simulator, body, 8.0, 12)?
    } else {
        TwoHalfGeomFactory::create_rectangle_geom(simulator, body, 12.0, 16.0)?
    };
    if number % 3 == 1 {
        simulator.set_depth_profile(geom, DepthProfile::Prism { depth: 14.0 })?;
    }
    let mut view = simulator.body_mut(body).expect("it was just made");
    view.ground_mut().set_object_geom(geom, None)?;
    let (x, y, z) = (random.between(-100.0, 100.0), random.between(20.0, 90.0), random.between(0.0, 60.0));
    view.set_position3d(Vector3::new(x, y, z));
    view.set_velocity3d(Vector3::new(random.between(-50.0, 50.0), 0.0, random.between(-50.0, 50.0)));
    Ok(())
}
