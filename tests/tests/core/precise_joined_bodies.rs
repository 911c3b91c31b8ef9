//! The precise set: joints whose bodies do not collide with each other.

use conformance::fixtures::plane::{add_box, precise, run, simulator, v};
use farseer_core::{BodyId, Error, Event, GeomId, JointFactory, JointId, PhysicsSimulator, SolverChoice};

const DT: f32 = 1.0 / 60.0;
const SOLVERS: [SolverChoice; 3] = [SolverChoice::Auto, SolverChoice::Iterative, SolverChoice::Direct];

/// Two boxes that overlap by half, with a hinge in the overlap.
fn pair(choice: SolverChoice, gravity: f32) -> (PhysicsSimulator, [(BodyId, GeomId); 2], JointId) {
    let mut simulator = precise(gravity);
    simulator.set_solver_choice(choice);
    let a = add_box(&mut simulator, (20.0, 20.0), v(0.0, 0.0));
    let b = add_box(&mut simulator, (20.0, 20.0), v(10.0, 0.0));
    let hinge = JointFactory::create_revolute_joint_in(&mut simulator, a.0, b.0, v(5.0, 0.0)).unwrap();
    (simulator, [a, b], hinge)
}

fn is_touching(simulator: &PhysicsSimulator, pair: [(BodyId, GeomId); 2]) -> bool {
    simulator.contacts_of(pair[0].0).iter().any(|contact| contact.other == pair[1].1)
}

#[test]
fn bodies_of_a_joint_collide_by_default_and_do_not_with_the_flag() {
    for choice in SOLVERS {
        let (mut simulator, pair, hinge) = self::pair(choice, 0.0);
        assert!(simulator[hinge].do_bodies_collide());
        run(&mut simulator, 3);
        assert!(is_touching(&simulator, pair), "{choice:?}");
        let (mut simulator, pair, hinge) = self::pair(choice, 0.0);
        simulator.set_joint_bodies_collide(hinge, false).unwrap();
        for _ in 0..120 {
            simulator.update(DT);
            assert!(!is_touching(&simulator, pair), "{choice:?}");
        }
        let speed = pair.map(|(body, _)| simulator[body].linear_velocity().norm());
        assert!(speed.iter().all(|speed| *speed == 0.0), "{speed:?}");
    }
}

#[test]
fn a_separated_pair_still_collides_with_others() {
    let (mut simulator, pair, hinge) = self::pair(SolverChoice::Auto, 300.0);
    simulator.set_joint_bodies_collide(hinge, false).unwrap();
    let (floor, _) = add_box(&mut simulator, (400.0, 20.0), v(0.0, 40.0));
    simulator[floor].set_is_static(true);
    run(&mut simulator, 240);
    for (body, _) in pair {
        let y = simulator[body].position().y;
        assert!((y - 20.0).abs() < 0.5, "{y}");
    }
}

/// Counts the events by which two geoms separate from each other.
fn separations(simulator: &PhysicsSimulator, [a, b]: [(BodyId, GeomId); 2]) -> usize {
    let between =
        |event: &&Event| matches!(event, Event::Separation { this, other } if [*this, *other] == [a.1, b.1]);
    simulator.events().iter().filter(between).count()
}

#[test]
fn contacts_end_with_an_event_when_the_flag_is_set_and_come_back_when_it_is_removed() {
    for choice in SOLVERS {
        let (mut simulator, pair, hinge) = self::pair(choice, 0.0);
        run(&mut simulator, 5);
        assert!(is_touching(&simulator, pair));
        simulator.set_joint_bodies_collide(hinge, false).unwrap();
        simulator.update(DT);
        assert_eq!(separations(&simulator, pair), 1, "{choice:?}");
        assert!(!is_touching(&simulator, pair));
        run(&mut simulator, 30);
        simulator.set_joint_bodies_collide(hinge, true).unwrap();
        simulator.update(DT);
        assert!(is_touching(&simulator, pair), "{choice:?}");
    }
}

#[test]
fn bodies_collide_again_when_their_joint_is_disabled_removed_or_breaks_even_if_they_slept() {
    type Edit = fn(&mut PhysicsSimulator, JointId);
    let edits: [(&str, Edit); 4] = [
        ("disabled", |simulator, hinge| simulator[hinge].set_enabled(false)),
        ("removed", |simulator, hinge| simulator.remove(hinge).unwrap()),
        ("disposed", |simulator, hinge| simulator.dispose(hinge).unwrap()),
        ("broken", |simulator, hinge| simulator[hinge].set_greatest_force(0.0).unwrap()),
    ];
    for (name, edit) in edits {
        let (mut simulator, pair, hinge) = self::pair(SolverChoice::Auto, 300.0);
        simulator.set_joint_bodies_collide(hinge, false).unwrap();
        let (floor, _) = add_box(&mut simulator, (400.0, 20.0), v(0.0, 20.0));
        simulator[floor].set_is_static(true);
        run(&mut simulator, 300);
        assert!(!is_touching(&simulator, pair));
        if name == "broken" {
            // A lasting load: the second box hangs on the first one.
            simulator[pair[1].0].apply_impulse(v(0.0, -1.0));
        }
        edit(&mut simulator, hinge);
        run(&mut simulator, 4);
        assert!(is_touching(&simulator, pair), "{name}");
    }
}

#[test]
fn a_second_joint_keeps_the_bodies_apart_and_a_body_set_anew_moves_the_flag() {
    let (mut simulator, pair, hinge) = self::pair(SolverChoice::Auto, 0.0);
    let weld = JointFactory::create_weld_joint_in(&mut simulator, pair[1].0, pair[0].0, v(5.0, 0.0)).unwrap();
    for joint in [hinge, weld] {
        simulator.set_joint_bodies_collide(joint, false).unwrap();
    }
    run(&mut simulator, 5);
    simulator.remove(hinge).unwrap();
    run(&mut simulator, 5);
    assert!(!is_touching(&simulator, pair));
    let (other, _) = add_box(&mut simulator, (5.0, 5.0), v(300.0, 0.0));
    simulator.set_joint_body1(weld, other).unwrap();
    simulator[weld].set_greatest_force(f32::MAX).unwrap();
    simulator.update(DT);
    assert!(is_touching(&simulator, pair));
}

#[test]
fn a_snapshot_at_any_moment_goes_on_with_the_same_bits() {
    for (moment, edit_at) in [(10, 20), (20, 20), (21, 20), (40, 20)] {
        let (mut simulator, [a, b], hinge) = self::pair(SolverChoice::Auto, 300.0);
        simulator.set_joint_bodies_collide(hinge, false).unwrap();
        let (floor, _) = add_box(&mut simulator, (400.0, 20.0), v(0.0, 60.0));
        simulator[floor].set_is_static(true);
        let mut copy: Option<PhysicsSimulator> = None;
        for step in 0..90 {
            for simulator in std::iter::once(&mut simulator).chain(&mut copy) {
                if step == edit_at {
                    simulator.set_joint_bodies_collide(hinge, true).unwrap();
                }
                if step == edit_at + 10 {
                    simulator.set_joint_bodies_collide(hinge, false).unwrap();
                }
            }
            // The copy is made after the edit, before the update that applies it.
            if step == moment {
                let mut restored = precise(0.0);
                restored.restore(&simulator.snapshot()).unwrap();
                copy = Some(restored);
            }
            simulator.update(DT);
            if let Some(copy) = &mut copy {
                copy.update(DT);
                for (body, _) in [a, b] {
                    let bits = |simulator: &PhysicsSimulator| {
                        let (at, angle) = (simulator[body].position(), simulator[body].rotation());
                        [at.x, at.y, angle].map(f32::to_bits)
                    };
                    assert_eq!(bits(copy), bits(&simulator), "step {step}, copy of step {moment}");
                }
                assert!(copy.snapshot() == simulator.snapshot(), "step {step}, copy of step {moment}");
            }
        }
    }
}

#[test]
fn a_flag_set_beside_other_edits_before_a_snapshot_acts_in_the_next_update() {
    for edit in [
        |simulator: &mut PhysicsSimulator, body: BodyId| simulator[body].set_position(v(11.0, 0.0)),
        |simulator: &mut PhysicsSimulator, body: BodyId| simulator[body].set_mass(3.0).unwrap(),
        |simulator: &mut PhysicsSimulator, _: BodyId| {
            add_box(simulator, (5.0, 5.0), v(80.0, 0.0));
        },
    ] {
        let (mut simulator, pair, hinge) = self::pair(SolverChoice::Auto, 300.0);
        run(&mut simulator, 5);
        for do_collide in [false, true] {
            edit(&mut simulator, pair[1].0);
            simulator.set_joint_bodies_collide(hinge, do_collide).unwrap();
            let mut copy = precise(0.0);
            copy.restore(&simulator.snapshot()).unwrap();
            for _ in 0..3 {
                simulator.update(DT);
                copy.update(DT);
                assert!(copy.snapshot() == simulator.snapshot());
                assert_eq!(is_touching(&copy, pair), do_collide);
            }
        }
    }
}

#[test]
fn a_flag_separates_bodies_that_sleep_and_wakes_them() {
    let (mut simulator, pair, hinge) = self::pair(SolverChoice::Auto, 300.0);
    let (floor, _) = add_box(&mut simulator, (400.0, 20.0), v(0.0, 20.0));
    simulator[floor].set_is_static(true);
    let weld = JointFactory::create_weld_joint_in(&mut simulator, pair[0].0, pair[1].0, v(5.0, 0.0)).unwrap();
    run(&mut simulator, 600);
    assert!(pair.iter().all(|&(body, _)| simulator.is_asleep(body)));
    assert!(is_touching(&simulator, pair));
    simulator.set_joint_bodies_collide(hinge, false).unwrap();
    simulator.update(DT);
    assert!(!pair.iter().any(|&(body, _)| simulator.is_asleep(body)));
    assert_eq!(separations(&simulator, pair), 1);
    assert!(!is_touching(&simulator, pair));
    run(&mut simulator, 600);
    assert!(pair.iter().all(|&(body, _)| simulator.is_asleep(body)));
    simulator.dispose(weld).unwrap();
    simulator.set_joint_bodies_collide(hinge, true).unwrap();
    simulator.update(DT);
    assert!(is_touching(&simulator, pair));
}

#[test]
fn the_faithful_methods_forget_which_bodies_were_separated() {
    let (mut simulator, pair, hinge) = self::pair(SolverChoice::Auto, 0.0);
    simulator.set_joint_bodies_collide(hinge, false).unwrap();
    run(&mut simulator, 3);
    assert!(!is_touching(&simulator, pair));
    simulator.set_joint_bodies_collide(hinge, true).unwrap();
    // No update of the precise set has seen that the bodies collide again.
    simulator.set_methods(farseer_core::Methods::default()).unwrap();
    run(&mut simulator, 1);
    simulator.set_methods(farseer_core::Methods::PRECISE).unwrap();
    run(&mut simulator, 1);
    assert!(is_touching(&simulator, pair));
    simulator.set_joint_bodies_collide(hinge, false).unwrap();
    run(&mut simulator, 1);
    assert!(!is_touching(&simulator, pair));
}

#[test]
fn refused_with_one_body_a_stale_id_or_the_faithful_methods() {
    let (mut simulator, pair, hinge) = self::pair(SolverChoice::Auto, 0.0);
    let pivot = JointFactory::create_fixed_revolute_joint_in(&mut simulator, pair[0].0, v(0.0, 0.0)).unwrap();
    assert!(matches!(simulator.set_joint_bodies_collide(pivot, false), Err(Error::WrongKind { .. })));
    simulator.set_joint_bodies_collide(hinge, false).unwrap();
    let methods = farseer_core::Methods::default();
    assert!(matches!(simulator.set_methods(methods), Err(Error::NotSupported { .. })));
    simulator.dispose(hinge).unwrap();
    simulator.update(DT);
    assert!(matches!(simulator.set_joint_bodies_collide(hinge, true), Err(Error::StaleId { .. })));
    let mut simulator = self::simulator(0.0);
    let [a, b] = [0.0, 10.0].map(|x| add_box(&mut simulator, (20.0, 20.0), v(x, 0.0)).0);
    let hinge = JointFactory::create_revolute_joint_in(&mut simulator, a, b, v(5.0, 0.0)).unwrap();
    assert!(simulator.set_joint_bodies_collide(hinge, true).is_ok());
    let refused = simulator.set_joint_bodies_collide(hinge, false);
    assert!(matches!(refused, Err(Error::NotSupported { .. })));
    assert!(simulator[hinge].do_bodies_collide());
}
