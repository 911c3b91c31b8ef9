//! Bodies at rest in a world with depth sleep, and wake.

use conformance::fixtures::depth::{DT, ball, place, run, solid, with_scheme};
use farseer_core::{IslandSolver, SolverReason};
use twohalf::{BodyId, DepthScheme, EventHandler, TwoHalfPhysicsSimulator, Vector3};

/// A box on another one, both at rest for two seconds.
fn two_at_rest(test: impl FnOnce(TwoHalfPhysicsSimulator, [BodyId; 2])) {
    with_scheme(DepthScheme::Precise, || {
        let mut simulator = conformance::fixtures::depth::simulator();
        let below = solid(&mut simulator, [40.0, 20.0, 40.0], [0.0, 0.0, 0.0]);
        let above = solid(&mut simulator, [20.0, 20.0, 20.0], [0.0, 20.0, 0.0]);
        run(&mut simulator, 200);
        test(simulator, [below, above]);
    });
}

#[test]
fn bodies_at_rest_sleep() {
    two_at_rest(|simulator, bodies| {
        for body in bodies {
            assert!(simulator.is_asleep(body));
            assert_eq!(simulator.why_awake(body), None);
        }
    });
}

#[test]
fn no_body_sleeps_if_sleeping_is_disabled() {
    two_at_rest(|mut simulator, bodies| {
        simulator.set_sleep_enabled(false);
        run(&mut simulator, 200);
        assert!(!simulator.is_sleep_enabled());
        assert!(bodies.iter().all(|&body| !simulator.is_asleep(body)));
    });
}

#[test]
fn contacts_with_depth_are_solved_iteratively_and_the_reason_is_reported() {
    two_at_rest(|mut simulator, [below, _]| {
        simulator.wake(below);
        run(&mut simulator, 1);
        let islands = simulator.core().islands();
        let told: Vec<_> = islands.iter().map(|island| (island.method, island.why)).collect();
        assert_eq!(told, [(IslandSolver::Iterative, SolverReason::HasDepth)]);
    });
}

#[test]
fn a_body_wakes_with_the_island_it_fell_asleep_with() {
    two_at_rest(|mut simulator, [below, above]| {
        simulator.wake(above);
        run(&mut simulator, 1);
        assert!(!simulator.is_asleep(above) && !simulator.is_asleep(below));
        assert!(simulator.why_awake(below).is_some());
    });
}

#[test]
fn sleeping_bodies_sleep_right_after_a_restore() {
    two_at_rest(|plain, bodies| {
        let mut restored = conformance::fixtures::depth::simulator();
        restored.restore(&plain.snapshot()).unwrap();
        assert!(bodies.iter().all(|&body| restored.is_asleep(body)));
    });
}

#[test]
fn bodies_can_be_woken_right_after_a_restore() {
    two_at_rest(|mut plain, [below, above]| {
        let mut restored = conformance::fixtures::depth::simulator();
        restored.restore(&plain.snapshot()).unwrap();
        for simulator in [&mut plain, &mut restored] {
            simulator.wake(above);
            run(simulator, 1);
            assert!(!simulator.is_asleep(above) && !simulator.is_asleep(below));
        }
        assert!(plain.snapshot() == restored.snapshot());
    });
}

#[test]
fn a_ball_that_moves_in_depth_wakes_the_body_that_it_hits() {
    two_at_rest(|mut simulator, [below, above]| {
        let thrown = ball(&mut simulator, 5.0, [0.0, 25.0, -60.0]);
        simulator.body_mut(thrown).unwrap().set_linear_velocity_z(400.0);
        run(&mut simulator, 5);
        assert!(simulator.is_asleep(above));
        run(&mut simulator, 15);
        assert!(!simulator.is_asleep(above));
        assert!(place(&simulator, above).z > 0.1);
        assert!(simulator.body(below).is_some());
    });
}

#[test]
fn an_impulse_in_depth_wakes() {
    two_at_rest(|mut simulator, [_, above]| {
        simulator.body_mut(above).unwrap().apply_impulse3d(Vector3::new(0.0, 0.0, 50.0));
        run(&mut simulator, 2);
        assert!(!simulator.is_asleep(above));
        assert!(place(&simulator, above).z > 0.1);
    });
}

#[test]
fn a_force_along_z_acts_once_also_where_it_does_not_keep_a_body_awake() {
    two_at_rest(|mut simulator, [_, above]| {
        let mass = simulator.body(above).unwrap().core().mass();
        let mut has_slept = false;
        for _ in 0..200 {
            simulator.body_mut(above).unwrap().apply_force_z(0.1 * mass);
            run(&mut simulator, 1);
            assert_eq!(simulator.body(above).unwrap().force_z(), 0.0);
            has_slept |= simulator.is_asleep(above);
        }
        assert!(has_slept);
    });
}

#[test]
fn a_sleeping_world_moves_no_body() {
    two_at_rest(|mut simulator, bodies| {
        let before = bodies.map(|body| place(&simulator, body));
        run(&mut simulator, 1000);
        assert_eq!(simulator.counters().bodies_moved, 0);
        assert_eq!(bodies.map(|body| place(&simulator, body)), before);
    });
}

/// A handler without callbacks; but with a handler all stages run, even if all bodies sleep.
struct Listens;

impl EventHandler for Listens {}

#[test]
fn updates_of_a_sleeping_world_and_later_ones_have_the_same_bits_with_handlers() {
    two_at_rest(|mut alone, [_, above]| {
        let mut heard = alone.clone();
        let mut both = |updates: usize, edit: &dyn Fn(&mut TwoHalfPhysicsSimulator)| {
            [&mut alone, &mut heard].into_iter().for_each(edit);
            for _ in 0..updates {
                alone.update(DT);
                heard.update_with(DT, &mut Listens);
                assert_eq!(alone.snapshot(), heard.snapshot());
                assert_eq!(alone.counters(), heard.counters());
                assert_eq!(alone.events(), heard.events());
            }
        };
        both(10, &|_| ());
        both(1, &|simulator| simulator.set_iterations(8));
        let up = Vector3::new(0.0, 60.0, 0.0);
        both(300, &|simulator| simulator.body_mut(above).unwrap().apply_impulse3d(up));
        both(10, &|_| ());
        assert!(alone.is_asleep(above));
    });
}

#[test]
fn a_body_asleep_on_the_ground_wakes_and_falls_when_its_object_geom_is_removed() {
    two_at_rest(|mut simulator, [below, above]| {
        simulator.body_mut(below).unwrap().ground_mut().clear_object_geom();
        run(&mut simulator, 1);
        assert!(!simulator.is_asleep(below) && !simulator.is_asleep(above));
        run(&mut simulator, 50);
        assert!(place(&simulator, below).y < -2.0);
        // The body that stood on it lands on its own ground.
        run(&mut simulator, 150);
        assert!(place(&simulator, above).y > -0.1);
    });
}
