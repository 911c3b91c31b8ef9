//! Engines that solve contacts of their own between the iterations of the solver: arbiters left to them, and bodies in the
//! solver.

use conformance::fixtures::plane::{
    add_box, add_floor, body_bits, faithful_methods, lively_scene, not_finite, simulator, state, v,
};
use farseer_core::{BodyId, PhysicsSimulator, SolverBody, SolverBodyIndex};

const DT: f32 = 0.01;

/// A box that lies on a floor and overlaps it by 1.
fn box_on_floor() -> (PhysicsSimulator, BodyId) {
    let mut simulator = simulator(100.0);
    add_floor(&mut simulator, (100.0, 20.0), v(0.0, 19.0));
    let (body, _) = add_box(&mut simulator, (20.0, 20.0), v(0.0, 0.0));
    (simulator, body)
}

/// An update in stages, with one function before the pre-step, and one in every iteration.
fn run(
    simulator: &mut PhysicsSimulator,
    before: impl FnOnce(&mut PhysicsSimulator),
    mut iteration: impl FnMut(&mut PhysicsSimulator),
) {
    assert!(simulator.process_queues(DT, None));
    simulator.find_pairs(None);
    simulator.collide_pairs(None);
    before(simulator);
    simulator.apply_forces(DT, 0.0, None);
    simulator.pre_step(1.0 / DT);
    for _ in 0..simulator.iterations() {
        simulator.solve_iteration(None);
        iteration(simulator);
    }
    simulator.integrate(DT, None);
}

fn leave_all(simulator: &mut PhysicsSimulator) {
    (0..simulator.arbiter_count()).for_each(|position| simulator.leave_to_engine(position));
}

#[test]
fn bodies_fall_through_contacts_that_an_engine_does_not_solve() {
    let (mut simulator, body) = box_on_floor();
    for _ in 0..10 {
        run(&mut simulator, leave_all, |_| {});
    }
    // g * dt^2 * (1 + ... + 10)
    let fallen = simulator[body].position().y;
    assert!((fallen - 0.55).abs() < 1e-4, "{fallen}");
}

#[test]
fn an_arbiter_left_to_the_engine_stays_in_the_list_and_is_not_counted_as_solved() {
    let (mut simulator, ..) = box_on_floor();
    run(&mut simulator, leave_all, |_| {});
    assert_eq!(simulator.arbiter_count(), 1);
    assert!(simulator.contact_count() > 0);
    assert_eq!(simulator.counters().contacts_solved, 0);
    assert_eq!(simulator.counters().pairs_touching, 1);
}

#[test]
fn an_arbiter_is_left_to_the_engine_for_one_update() {
    let (mut simulator, ..) = box_on_floor();
    run(&mut simulator, leave_all, |_| {});
    simulator.update(DT);
    assert_eq!(simulator.counters().contacts_solved, simulator.contact_count());
}

#[test]
fn only_the_arbiter_at_the_position_is_left_to_the_engine() {
    let (mut simulator, left) = box_on_floor();
    let (solved, geom) = add_box(&mut simulator, (20.0, 20.0), v(35.0, 0.0));
    let leave = |simulator: &mut PhysicsSimulator| {
        assert_eq!(simulator.arbiter_count(), 2);
        let position = simulator.arbiters().position(|arbiter| arbiter.geom_b() != geom).unwrap();
        simulator.leave_to_engine(position);
        // There is no such arbiter.
        simulator.leave_to_engine(7);
    };
    run(&mut simulator, leave, |_| {});
    assert!(simulator[left].linear_velocity().y > 0.9, "falls with g * dt");
    assert!(simulator[solved].linear_velocity().y.abs() < 0.1, "held");
}

#[test]
fn impulses_that_the_engine_sets_are_there_in_the_next_update() {
    let (mut simulator, ..) = box_on_floor();
    run(&mut simulator, leave_all, |_| {});
    simulator.set_arbiter_impulses(0, 1, 3.0, -0.5);
    let id = simulator.arbiter(0).unwrap().contacts().nth(1).unwrap().id;
    let mut seen = None;
    run(
        &mut simulator,
        |simulator| {
            let arbiter = simulator.arbiter(0).unwrap();
            seen = arbiter.contacts().find(|contact| contact.id == id);
            leave_all(simulator);
        },
        |_| {},
    );
    let seen = seen.unwrap();
    assert_eq!((seen.normal_impulse(), seen.tangent_impulse()), (3.0, -0.5));
}

#[test]
fn impulses_that_are_not_finite_or_have_no_contact_are_refused() {
    let (mut simulator, ..) = box_on_floor();
    simulator.update(DT);
    let before = state(&simulator);
    simulator.set_arbiter_impulses(0, 0, f32::NAN, 0.0);
    simulator.set_arbiter_impulses(0, 0, 1.0, f32::INFINITY);
    simulator.set_arbiter_impulses(0, 99, 1.0, 1.0);
    simulator.set_arbiter_impulses(9, 0, 1.0, 1.0);
    assert_eq!(state(&simulator), before);
    assert!(simulator.arbiter(9).is_none());
}

#[test]
fn bodies_have_a_solver_index_only_between_pre_step_and_integration() {
    let mut simulator = simulator(0.0);
    let (body, _) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    let (stale, _) = add_box(&mut simulator, (10.0, 10.0), v(50.0, 0.0));
    simulator.dispose(stale).unwrap();
    for _ in 0..2 {
        let mut iterations = 0;
        run(
            &mut simulator,
            |simulator| assert_eq!(simulator.solver_place(body), None),
            |simulator| {
                assert!(simulator.solver_place(body).is_some());
                assert_eq!(simulator.solver_place(body), simulator.solver_place(body));
                assert_eq!(simulator.solver_place(stale), None);
                iterations += 1;
            },
        );
        assert_eq!(iterations, 5);
        assert_eq!(simulator.solver_place(body), None);
    }
}

#[test]
fn a_body_made_after_the_pre_step_gets_a_solver_index_as_well() {
    let mut simulator = simulator(0.0);
    let (_, _) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    run(
        &mut simulator,
        |_| {},
        |simulator| {
            let (new, _) = add_box(simulator, (10.0, 10.0), v(100.0, 0.0));
            assert!(simulator.solver_place(new).is_some());
        },
    );
}

#[test]
fn bodies_taken_into_the_solver_and_written_back_keep_every_bit() {
    for methods in faithful_methods() {
        let (mut plain, mut read) = (lively_scene(methods, 5), lively_scene(methods, 5));
        for _ in 0..60 {
            plain.update(DT);
            run(
                &mut read,
                |_| {},
                |simulator| {
                    for body in simulator.body_list().to_vec() {
                        let place = simulator.solver_place(body).unwrap();
                        let velocities = simulator.solver_body(place);
                        assert!(simulator.set_solver_body(place, velocities));
                    }
                },
            );
            assert_eq!(state(&plain), state(&read), "{methods:?}");
        }
    }
}

/// One update in which a function acts on a body in the solver once.
fn act_on(
    simulator: &mut PhysicsSimulator,
    body: BodyId,
    act: impl FnOnce(&mut PhysicsSimulator, SolverBodyIndex),
) {
    let mut act = Some(act);
    run(
        simulator,
        |_| {},
        |simulator| {
            let place = simulator.solver_place(body).unwrap();
            if let Some(act) = act.take() {
                act(simulator, place);
            }
        },
    );
}

#[test]
fn the_solver_shows_velocities_and_inverse_masses_of_a_body() {
    let mut simulator = simulator(0.0);
    let (body, _) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    simulator[body].set_mass(2.0).unwrap();
    simulator[body].set_moment_of_inertia(4.0).unwrap();
    simulator[body].set_linear_velocity(v(1.0, -2.0));
    simulator[body].set_angular_velocity(3.0);
    simulator[body].set_linear_drag_coefficient(0.0);
    simulator[body].set_rotational_drag_coefficient(0.0);
    act_on(&mut simulator, body, |simulator, place| {
        let expected = SolverBody {
            velocity: [1.0, -2.0, 3.0],
            bias: [0.0; 3],
            inverse_mass: 0.5,
            inverse_inertia: 0.25,
        };
        assert_eq!(simulator.solver_body(place), expected);
    });
}

#[test]
fn velocities_set_in_the_solver_stay_and_bias_moves_once() {
    let mut simulator = simulator(0.0);
    let (body, _) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    simulator[body].set_linear_drag_coefficient(0.0);
    act_on(&mut simulator, body, |simulator, place| {
        let before = simulator.solver_body(place);
        let set =
            SolverBody { velocity: [0.0, 2.0, 0.0], bias: [64.0, 0.0, 0.0], inverse_mass: 9.0, ..before };
        assert!(simulator.set_solver_body(place, set));
        let expected = SolverBody { inverse_mass: before.inverse_mass, ..set };
        assert_eq!(simulator.solver_body(place), expected, "masses are not taken over");
    });
    assert_eq!(simulator[body].linear_velocity(), v(0.0, 2.0));
    assert_eq!(simulator[body].position(), v(64.0 * DT, 2.0 * DT));
    simulator.update(DT);
    assert_eq!(simulator[body].position().x, 64.0 * DT);
}

#[test]
fn the_core_solves_with_the_velocities_that_the_engine_sets() {
    let mut simulator = simulator(0.0);
    let (left, _) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    let (right, _) = add_box(&mut simulator, (10.0, 10.0), v(9.9, 0.0));
    act_on(&mut simulator, left, |simulator, place| {
        let body = simulator.solver_body(place);
        assert!(simulator.set_solver_body(place, SolverBody { velocity: [10.0, 0.0, 0.0], ..body }));
    });
    // Equal masses without bounce share the velocity; four iterations come that near.
    let [left, right] = [left, right].map(|body| simulator[body].linear_velocity().x);
    assert!((left - 5.0).abs() < 0.1 && (right - 5.0).abs() < 0.1, "{left} {right}");
}

#[test]
fn non_finite_solver_velocities_keep_the_old_state_and_disable_the_body() {
    for spoil in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for component in 0..6 {
            let mut simulator = simulator(0.0);
            let (body, _) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
            let (other, _) = add_box(&mut simulator, (10.0, 10.0), v(50.0, 0.0));
            simulator[body].set_linear_velocity(v(1.0, 0.0));
            simulator[body].set_linear_drag_coefficient(0.0);
            act_on(&mut simulator, body, |simulator, place| {
                let before = simulator.solver_body(place);
                assert!(simulator.set_solver_body(place, SolverBody { velocity: [7.0; 3], ..before }));
                let mut spoilt = before;
                match component {
                    0..3 => spoilt.velocity[component] = spoil,
                    _ => spoilt.bias[component - 3] = spoil,
                }
                assert!(!simulator.set_solver_body(place, spoilt));
                assert_eq!(simulator.solver_body(place).velocity, [7.0; 3]);
            });
            assert_eq!(not_finite(&simulator), [(body, true)]);
            assert!(!simulator[body].enabled() && simulator[other].enabled());
            assert_eq!(simulator[body].linear_velocity(), v(1.0, 0.0));
        }
    }
}

#[test]
fn a_body_that_the_engine_marks_as_failed_keeps_its_state_and_is_disabled() {
    let mut simulator = simulator(0.0);
    let (body, _) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    simulator[body].set_linear_velocity(v(1.0, 0.0));
    simulator[body].set_linear_drag_coefficient(0.0);
    let before = body_bits(&simulator[body]);
    act_on(&mut simulator, body, |simulator, place| {
        let velocities = SolverBody { velocity: [7.0; 3], ..simulator.solver_body(place) };
        assert!(simulator.set_solver_body(place, velocities));
        simulator.solver_body_failed(place);
    });
    assert_eq!(not_finite(&simulator), [(body, true)]);
    simulator[body].set_enabled(true);
    assert_eq!(body_bits(&simulator[body]), before);
}

#[test]
fn a_static_body_that_failed_is_reported_and_stays_enabled() {
    let mut simulator = simulator(0.0);
    let (body, _) = add_floor(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    act_on(&mut simulator, body, |simulator, place| simulator.solver_body_failed(place));
    assert_eq!(not_finite(&simulator), [(body, false)]);
    assert!(simulator[body].enabled());
}

#[test]
fn a_stale_solver_index_has_no_effect() {
    let mut simulator = simulator(0.0);
    let (body, _) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    let mut old = None;
    act_on(&mut simulator, body, |_, place| old = Some(place));
    let old = old.unwrap();
    let before = state(&simulator);
    simulator.set_solver_body(old, SolverBody { velocity: [9.0; 3], ..SolverBody::default() });
    simulator.solver_body_failed(old);
    assert_eq!(state(&simulator), before);
    simulator.update(DT);
    assert_eq!(not_finite(&simulator), []);
    simulator.clear();
    assert_eq!(simulator.solver_body(old), SolverBody::default());
    simulator.set_solver_body(old, SolverBody::default());
}
