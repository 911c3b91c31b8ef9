//! The precise set: joints break at their greatest force or torque with either solver, and slip at their greatest impulse.

use conformance::fixtures::plane::{simulator_with, v};
use farseer_core::math::Vector2;
use farseer_core::{
    BodyFactory, BodyId, Event, GeomFactory, GeomPlacement, JointFactory, JointId, Methods, PhysicsSimulator,
    SolverChoice, WeldJoint,
};

/// Length units per second squared.
const GRAVITY: f32 = 900.0;
const STEPS: [f32; 3] = [1.0 / 30.0, 1.0 / 60.0, 1.0 / 120.0];
const LOAD: f32 = 5.0;
/// Distance from the joint to the centre of the load, length units.
const ARM: f32 = 30.0;

fn add_box(simulator: &mut PhysicsSimulator, at: Vector2, [w, h]: [f32; 2], mass: f32) -> BodyId {
    let body = BodyFactory::create_rectangle_body_in(simulator, w, h, mass).unwrap();
    simulator[body].set_position(at);
    body
}

fn add_solid(simulator: &mut PhysicsSimulator, at: Vector2, size: [f32; 2], mass: f32) -> BodyId {
    let body = add_box(simulator, at, size, mass);
    let [w, h] = size;
    let geom =
        GeomFactory::create_rectangle_geom_in(simulator, body, w, h, GeomPlacement::default()).unwrap();
    simulator[geom].set_collision_group(i32::from(mass < 100.0));
    body
}

/// The support of a load.
#[derive(Debug, Clone, Copy, PartialEq)]
enum On {
    /// A static body: it collides with no dynamic one.
    Post,
    /// A mast that stands on a floor.
    Mast,
}

/// A load below its joint, or beside it, on a post or mast that it does not touch.
fn loaded(
    choice: SolverChoice,
    on: On,
    is_weld: bool,
    is_beside: bool,
) -> (PhysicsSimulator, JointId, BodyId) {
    let mut simulator = simulator_with(GRAVITY, Methods::PRECISE);
    simulator.set_solver_choice(choice);
    let at = v(0.0, -100.0);
    let holder = match on {
        On::Post => {
            let post = add_box(&mut simulator, at, [10.0, 10.0], 1.0);
            simulator[post].set_is_static(true);
            post
        }
        On::Mast => {
            let floor = add_solid(&mut simulator, v(0.0, 20.0), [2000.0, 40.0], 100.0);
            simulator[floor].set_is_static(true);
            add_solid(&mut simulator, v(0.0, -60.0), [200.0, 120.0], 40.0)
        }
    };
    let load =
        add_box(&mut simulator, at + if is_beside { v(ARM, 0.0) } else { v(0.0, ARM) }, [20.0, 20.0], LOAD);
    let joint = if is_weld {
        JointFactory::create_weld_joint_in(&mut simulator, holder, load, at).unwrap()
    } else {
        JointFactory::create_revolute_joint_in(&mut simulator, holder, load, at).unwrap()
    };
    (simulator, joint, load)
}

fn count_broken(simulator: &mut PhysicsSimulator, dt: f32, seconds: f32) -> usize {
    let mut count = 0;
    for _ in 0..(seconds / dt) as usize {
        simulator.update(dt);
        count += simulator.events().iter().filter(|event| matches!(event, Event::JointBroke { .. })).count();
    }
    count
}

const SOLVERS: [(SolverChoice, On); 3] =
    [(SolverChoice::Auto, On::Post), (SolverChoice::Iterative, On::Mast), (SolverChoice::Direct, On::Mast)];

#[test]
fn a_joint_breaks_once_above_its_greatest_force_and_never_below_whichever_solver_has_it() {
    for dt in STEPS {
        for (choice, on) in SOLVERS {
            for is_weld in [false, true] {
                for (part, expected) in [(1.02, 0), (0.98, 1)] {
                    let (mut simulator, joint, _) = loaded(choice, on, is_weld, false);
                    assert_eq!(count_broken(&mut simulator, dt, 1.0), 0);
                    simulator[joint].set_greatest_force(part * LOAD * GRAVITY).unwrap();
                    let broken = count_broken(&mut simulator, dt, 1.0);
                    assert_eq!(broken, expected, "{part} of the load, {dt} s, {choice:?}, weld {is_weld}");
                }
            }
        }
    }
}

#[test]
fn a_weld_breaks_once_above_its_greatest_torque_and_never_below_whichever_solver_has_it() {
    for dt in STEPS {
        for (choice, on) in SOLVERS {
            for (part, expected) in [(1.02, 0), (0.98, 1)] {
                let (mut simulator, joint, _) = loaded(choice, on, true, true);
                assert_eq!(count_broken(&mut simulator, dt, 1.0), 0);
                simulator[joint].set_greatest_torque(part * LOAD * GRAVITY * ARM).unwrap();
                let broken = count_broken(&mut simulator, dt, 1.0);
                assert_eq!(broken, expected, "{part} of the load, {dt} s, {choice:?}");
            }
        }
    }
}

#[test]
fn a_joint_that_sleeps_wakes_and_breaks_when_its_greatest_force_or_torque_falls_below_its_load() {
    for (choice, on) in SOLVERS {
        let (mut simulator, joint, load) = loaded(choice, on, true, true);
        assert_eq!(count_broken(&mut simulator, STEPS[1], 4.0), 0);
        assert!(simulator.is_asleep(load), "{choice:?}");
        // A greater limit wakes no body.
        simulator[joint].set_greatest_force(1.02 * LOAD * GRAVITY).unwrap();
        simulator[joint].set_greatest_torque(1.02 * LOAD * GRAVITY * ARM).unwrap();
        simulator.update(STEPS[1]);
        assert!(simulator.is_asleep(load), "{choice:?}");
        let mut of_torque = simulator.clone();
        of_torque[joint].set_greatest_torque(0.9 * LOAD * GRAVITY * ARM).unwrap();
        simulator[joint].set_greatest_force(0.9 * LOAD * GRAVITY).unwrap();
        for simulator in [&mut simulator, &mut of_torque] {
            assert_eq!(count_broken(simulator, STEPS[1], 0.2), 1, "{choice:?}");
            assert!(simulator[load].linear_velocity().y > 0.0, "{choice:?}");
        }
    }
}

#[test]
fn a_weld_on_the_floor_slips_with_its_greatest_torque_and_holds_with_more_than_its_load() {
    for dt in STEPS {
        for (part, expected) in [(1.05, 0.0), (0.9, 0.7864)] {
            let (mut simulator, joint, load) = loaded(SolverChoice::Direct, On::Mast, true, true);
            simulator[load].set_linear_drag_coefficient(0.0);
            simulator[load].set_rotational_drag_coefficient(0.0);
            let substeps = simulator.iterations() as f32;
            let impulse = part * LOAD * GRAVITY * ARM * dt / substeps;
            simulator.joint_as_mut::<WeldJoint>(joint).unwrap().set_max_impulse(impulse).unwrap();
            let mut farthest = 0.0_f32;
            for _ in 0..(2.0 / dt) as usize {
                simulator.update(dt);
                farthest = farthest.max(simulator[load].total_rotation());
            }
            // With a constant torque of 0.9 of its load it swings between 0 and the angle at which sin a = 0.9 a; a step of
            // 1/30 s turns it by up to 0.05 rad.
            assert!((farthest - expected).abs() < 0.02, "{farthest} with {part}, {dt} s");
        }
    }
}
