//! Scenes in which the faithful and the precise set differ: hard cases show the abilities of a method.

use conformance::scenes::{circles_in_a_pit, pyramid};
use examples::Result;
use farseer_core::math::{Vector2, scalar};
use farseer_core::{
    BodyFactory, BodyId, GeomFactory, GeomPlacement, JointFactory, Methods, PhysicsSimulator,
};

use super::blocks::Blocks;
use crate::play::{Play, Set};

/// Steps per second.
const RATE: u32 = 100;
const GRAVITY: f32 = 500.0;
/// Edge of a box of a column in px.
pub(super) const EDGE: f32 = 24.0;

fn simulator(set: Set) -> Result<PhysicsSimulator> {
    let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, GRAVITY))?;
    choose(&mut simulator, set)?;
    Ok(simulator)
}

fn choose(simulator: &mut PhysicsSimulator, set: Set) -> Result<()> {
    if set == Set::Precise {
        simulator.set_methods(Methods::PRECISE)?;
        simulator.set_iterations(4);
    }
    Ok(())
}

/// Adds a box about a point.
fn add_box(simulator: &mut PhysicsSimulator, size: [f32; 2], at: [f32; 2], mass: f32) -> Result<BodyId> {
    let [width, height] = size;
    let body = BodyFactory::create_rectangle_body_in(simulator, width, height, mass)?;
    simulator[body].set_position(Vector2::from(at));
    let placement = GeomPlacement::default();
    let geom = GeomFactory::create_rectangle_geom_in(simulator, body, width, height, placement)?;
    simulator[geom].set_friction_coefficient(0.6);
    simulator[geom].set_restitution_coefficient(0.0);
    Ok(body)
}

/// A floor whose surface is at y = 0.
fn add_floor(simulator: &mut PhysicsSimulator, width: f32) -> Result<()> {
    let floor = add_box(simulator, [width, 40.0], [0.0, 20.0], 1.0)?;
    simulator[floor].set_is_static(true);
    Ok(())
}

/// A column of boxes, each as heavy as the others.
pub(super) fn column(set: Set, count: usize) -> Result<Box<dyn Play>> {
    let mut simulator = simulator(set)?;
    let height = EDGE * count as f32;
    add_floor(&mut simulator, (0.6 * height).max(400.0))?;
    for index in 0..count {
        let aside = 0.3 * conformance::scenes::vary(index, 2);
        add_box(&mut simulator, [EDGE; 2], [aside, -EDGE * (index as f32 + 0.5)], 1.0)?;
    }
    let half = (0.3 * height).max(200.0);
    Ok(Box::new(Blocks::new(simulator, RATE, [[-half, -1.06 * height], [half, 40.0]])))
}

/// A chain of links on hinges, fixed at both ends: it begins as half a circle, and swings.
pub(super) fn chain(set: Set, count: usize) -> Result<Box<dyn Play>> {
    const LINK: f32 = 12.0;
    let mut simulator = simulator(set)?;
    // A circle's chords, each as long as a link.
    let turn = std::f32::consts::PI / count as f32;
    let radius = 0.5 * LINK / scalar::sin(0.5 * turn);
    let hinge = |index: usize| {
        let (sin, cos) = scalar::sin_cos(turn * index as f32);
        Vector2::new(-radius * cos, radius * sin)
    };
    let mut before: Option<BodyId> = None;
    for index in 0..count {
        let [from, to] = [hinge(index), hinge(index + 1)];
        let way = to - from;
        let link =
            add_link(&mut simulator, [LINK, 8.0], 0.5 * (from + to), scalar::atan2(way.y, way.x), 0.2)?;
        hang(&mut simulator, before, link, from)?;
        before = Some(link);
    }
    if let Some(last) = before {
        JointFactory::create_fixed_revolute_joint_in(&mut simulator, last, hinge(count))?;
    }
    Ok(Box::new(Blocks::new(
        simulator,
        RATE,
        [[-1.2 * radius, -0.15 * radius], [1.2 * radius, 1.6 * radius]],
    )))
}

/// A link of a chain, which passes through the others.
fn add_link(
    simulator: &mut PhysicsSimulator,
    [length, thickness]: [f32; 2],
    at: Vector2,
    rotation: f32,
    mass: f32,
) -> Result<BodyId> {
    let link = BodyFactory::create_rectangle_body_in(simulator, length, thickness, mass)?;
    simulator[link].set_position(at);
    simulator[link].set_rotation(rotation);
    let placement = GeomPlacement::default();
    let geom = GeomFactory::create_rectangle_geom_in(simulator, link, length, thickness, placement)?;
    simulator[geom].set_collision_group(1);
    Ok(link)
}

/// Joins a link to the one before, or to the world.
fn hang(
    simulator: &mut PhysicsSimulator,
    before: Option<BodyId>,
    link: BodyId,
    hinge: Vector2,
) -> Result<()> {
    match before {
        Some(before) => JointFactory::create_revolute_joint_in(simulator, before, link, hinge)?,
        None => JointFactory::create_fixed_revolute_joint_in(simulator, link, hinge)?,
    };
    Ok(())
}

/// A heavy box on light ones, and a heavy ball on a light chain: a thousand to one.
pub(super) fn mass_ratio(set: Set) -> Result<Box<dyn Play>> {
    const HEAVY: f32 = 1000.0;
    let mut simulator = simulator(set)?;
    add_floor(&mut simulator, 700.0)?;
    for index in 0..3 {
        add_box(&mut simulator, [EDGE; 2], [-150.0, -EDGE * (index as f32 + 0.5)], 1.0)?;
    }
    add_box(&mut simulator, [90.0, 90.0], [-150.0, -3.0 * EDGE - 45.0], HEAVY)?;
    let mut before: Option<BodyId> = None;
    for index in 0..10 {
        let top = -330.0 + 20.0 * index as f32;
        let hinge = Vector2::new(140.0, top);
        let link = add_link(&mut simulator, [6.0, 20.0], hinge + Vector2::new(0.0, 10.0), 0.0, 1.0)?;
        hang(&mut simulator, before, link, hinge)?;
        before = Some(link);
    }
    let ball = BodyFactory::create_circle_body_in(&mut simulator, 36.0, HEAVY)?;
    simulator[ball].set_position(Vector2::new(140.0, -94.0));
    simulator[ball].set_linear_velocity(Vector2::new(-160.0, 0.0));
    let round = GeomFactory::create_circle_geom_in(&mut simulator, ball, 36.0, 24, GeomPlacement::default())?;
    simulator[round].set_collision_group(1);
    if let Some(last) = before {
        JointFactory::create_revolute_joint_in(&mut simulator, last, ball, Vector2::new(140.0, -130.0))?;
    }
    Ok(Box::new(Blocks::new(simulator, RATE, [[-300.0, -360.0], [320.0, 40.0]])))
}

/// Circles that fall into a pit.
pub(super) fn pit(set: Set, count: usize) -> Result<Box<dyn Play>> {
    let mut simulator = Blocks::of_scene(&circles_in_a_pit(count))?;
    choose(&mut simulator, set)?;
    let half = 12.0 * ((count as f32).sqrt() + 5.0);
    Ok(Box::new(Blocks::new(simulator, RATE, [[-half, -2.05 * half], [half, 44.0]])))
}

/// A pyramid of boxes.
pub(super) fn pyramid_of(set: Set, base: usize) -> Result<Box<dyn Play>> {
    let mut simulator = Blocks::of_scene(&pyramid(base))?;
    choose(&mut simulator, set)?;
    let half = 11.0 * base as f32 + 60.0;
    Ok(Box::new(Blocks::new(simulator, RATE, [[-half, -20.0 * base as f32 - 60.0], [half, 44.0]])))
}
