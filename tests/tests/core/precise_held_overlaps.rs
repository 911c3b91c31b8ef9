//! The precise set: bodies that joints keep overlapping for good. No correction can separate them, so none may disturb them.

use conformance::fixtures::plane::{precise, v};
use farseer_core::math::Vector2;
use farseer_core::{
    BodyFactory, BodyId, GeomFactory, GeomPlacement, IslandSolver, JointFactory, PhysicsSimulator,
};

/// Steps in seconds.
const STEPS: [f32; 3] = [1.0 / 30.0, 1.0 / 60.0, 1.0 / 120.0];
/// Length units per second squared; 32 length units are a metre.
const GRAVITY: f32 = 900.0;

/// Returns a simulator without sleep, and a static floor whose surface is at y = 0.
fn scene_on_floor() -> PhysicsSimulator {
    let mut simulator = precise(GRAVITY);
    simulator.set_sleep_enabled(false);
    let floor = add_box(&mut simulator, v(0.0, 20.0), [2000.0, 40.0], 1.0);
    simulator[floor].set_is_static(true);
    simulator
}

fn add_box(
    simulator: &mut PhysicsSimulator,
    position: Vector2,
    [width, height]: [f32; 2],
    mass: f32,
) -> BodyId {
    let body = BodyFactory::create_rectangle_body_in(simulator, width, height, mass).unwrap();
    let placement = GeomPlacement::default();
    let geom = GeomFactory::create_rectangle_geom_in(simulator, body, width, height, placement).unwrap();
    simulator[body].set_position(position);
    simulator[geom].set_friction_coefficient(0.5);
    body
}

fn add_wheel(simulator: &mut PhysicsSimulator, position: Vector2, radius: f32) -> BodyId {
    let body = BodyFactory::create_circle_body_in(simulator, radius, 1.0).unwrap();
    let placement = GeomPlacement::default();
    let geom = GeomFactory::create_circle_geom_in(simulator, body, radius, 16, placement).unwrap();
    simulator[body].set_position(position);
    simulator[geom].set_friction_coefficient(0.5);
    body
}

/// Adds a body of `mass` on pairs of legs of two limbs. The legs of a pair are in the same place, and all limbs overlap the
/// bodies that they are hinged to. Returns the body.
fn add_creature(simulator: &mut PhysicsSimulator, pairs: usize, mass: f32) -> BodyId {
    let body = add_box(simulator, v(0.0, -110.0), [64.0 * pairs as f32, 40.0], mass);
    for leg in 0..2 * pairs {
        let x = 64.0 * (leg / 2) as f32 - 32.0 * (pairs - 1) as f32;
        let thigh = add_box(simulator, v(x, -75.0), [12.0, 50.0], 1.0);
        JointFactory::create_revolute_joint_in(simulator, body, thigh, v(x, -100.0)).unwrap();
        let shank = add_box(simulator, v(x, -27.0), [10.0, 54.0], 1.0);
        JointFactory::create_revolute_joint_in(simulator, thigh, shank, v(x, -52.0)).unwrap();
    }
    body
}

/// Asserts that the direct solver has all awake islands and needs no Newton steps for them.
fn assert_solved_without_newton_steps(simulator: &PhysicsSimulator, case: &str) {
    for island in simulator.islands() {
        assert_eq!(island.method, IslandSolver::Direct, "{case}");
        assert_eq!(island.cost.newton_steps, 0, "{case}");
    }
}

#[test]
fn a_creature_on_overlapping_legs_stands_still_where_it_was_built() {
    for dt in STEPS {
        for (pairs, mass) in [(2, 10.0), (5, 1.0), (5, 10.0), (5, 100.0), (8, 10.0)] {
            let mut simulator = scene_on_floor();
            let body = add_creature(&mut simulator, pairs, mass);
            (0..(1.0 / dt) as usize).for_each(|_| simulator.update(dt));
            let case = format!("{pairs} pairs of legs under {mass}, {dt} s");
            assert_solved_without_newton_steps(&simulator, &case);
            // Penetration that remains in a contact: 1e-5 m or 1e-6 of a coordinate, here of up to 250.
            let moved = (simulator[body].position() - v(0.0, -110.0)).norm();
            assert!(moved < 1e-3, "{case}: {moved}");
            assert_eq!(simulator[body].linear_velocity(), Vector2::zeros(), "{case}");
        }
    }
}

#[test]
fn a_hull_that_overlaps_its_wheels_comes_to_rest_after_a_fall() {
    for dt in STEPS {
        for (mass, radius) in [(1.0, 16.0), (20.0, 16.0), (5.0, 8.0), (5.0, 32.0)] {
            let mut simulator = scene_on_floor();
            let hull = add_box(&mut simulator, v(0.0, -40.0), [100.0, 10.0], mass);
            let wheels = [-50.0, 50.0].map(|x| {
                let wheel = add_wheel(&mut simulator, v(x, -40.0), radius);
                let joint =
                    JointFactory::create_revolute_joint_in(&mut simulator, hull, wheel, v(x, -40.0)).unwrap();
                (wheel, joint)
            });
            (0..(3.0 / dt) as usize).for_each(|_| simulator.update(dt));
            let case = format!("hull of {mass}, wheels of radius {radius}, {dt} s");
            assert_solved_without_newton_steps(&simulator, &case);
            for (wheel, joint) in wheels {
                let error = simulator[joint].joint_error();
                assert!(error < 0.01, "{case}: {error}");
                assert_eq!(simulator[wheel].linear_velocity(), Vector2::zeros(), "{case}");
            }
        }
    }
}

#[test]
fn bodies_that_a_joint_does_not_hold_together_separate() {
    // Two boxes on one hinge overlap, but can swing apart.
    let mut simulator = precise(0.0);
    let ids = [-3.0, 3.0].map(|x| add_box(&mut simulator, v(x, 20.0), [10.0, 40.0], 1.0));
    for (id, x) in ids.into_iter().zip([-3.0, 3.0]) {
        JointFactory::create_fixed_revolute_joint_in(&mut simulator, id, v(x, -40.0)).unwrap();
    }
    (0..600).for_each(|_| simulator.update(1.0 / 60.0));
    let apart = simulator[ids[1]].position().x - simulator[ids[0]].position().x;
    // The boxes are 6 apart and 10 wide; they turn by about 2/60 each, so a corner of one is 0.7 from its middle line.
    assert!(apart > 9.2, "{apart}");
}
