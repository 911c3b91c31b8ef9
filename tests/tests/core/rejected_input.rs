//! Numbers that are not finite: every method that a game calls per frame refuses them, changes no state, and the refusal is
//! reported once.

use conformance::fixtures::plane::{
    self, add_box, body_bits, both_sets, rejected, simulator, simulator_with, state, v,
};
use farseer_core::{Body, Event, Geom, GeomPlacement, Methods, ObjectId, PhysicsSimulator, Vertices};

const BAD: [f32; 3] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];

type Setter<T> = (&'static str, fn(&mut T, f32));

const BODY_METHODS: [Setter<Body>; 26] = [
    ("position", |body, bad| body.set_position(v(bad, 0.0))),
    ("position", |body, bad| body.set_position(v(0.0, bad))),
    ("rotation", |body, bad| body.set_rotation(bad)),
    ("linear_velocity", |body, bad| body.set_linear_velocity(v(bad, 0.0))),
    ("linear_velocity", |body, bad| body.set_linear_velocity(v(0.0, bad))),
    ("angular_velocity", |body, bad| body.set_angular_velocity(bad)),
    ("linear_drag_coefficient", |body, bad| body.set_linear_drag_coefficient(bad)),
    ("quadratic_drag_coefficient", |body, bad| body.set_quadratic_drag_coefficient(bad)),
    ("rotational_drag_coefficient", |body, bad| body.set_rotational_drag_coefficient(bad)),
    ("idle_time", |body, bad| body.set_idle_time(bad)),
    ("minimum_velocity", |body, bad| body.set_minimum_velocity(bad)),
    ("amount", |body, bad| body.apply_force(v(bad, 0.0))),
    ("amount", |body, bad| body.apply_force(v(0.0, bad))),
    ("amount", |body, bad| body.apply_force_at_local_point(v(bad, 0.0), v(1.0, 1.0))),
    ("amount", |body, bad| body.apply_force_at_local_point(v(0.0, bad), v(1.0, 1.0))),
    ("point", |body, bad| body.apply_force_at_local_point(v(1.0, 1.0), v(bad, 0.0))),
    ("point", |body, bad| body.apply_force_at_local_point(v(1.0, 1.0), v(0.0, bad))),
    ("amount", |body, bad| body.apply_force_at_world_point(v(bad, 0.0), v(1.0, 1.0))),
    ("amount", |body, bad| body.apply_force_at_world_point(v(0.0, bad), v(1.0, 1.0))),
    ("point", |body, bad| body.apply_force_at_world_point(v(1.0, 1.0), v(bad, 0.0))),
    ("point", |body, bad| body.apply_force_at_world_point(v(1.0, 1.0), v(0.0, bad))),
    ("torque", |body, bad| body.apply_torque(bad)),
    ("amount", |body, bad| body.apply_impulse(v(bad, 0.0))),
    ("amount", |body, bad| body.apply_impulse(v(0.0, bad))),
    ("amount", |body, bad| body.apply_angular_impulse(bad)),
    // Finite themselves, but their sum is not.
    ("amount", |body, _| (0..2).for_each(|_| body.apply_force(v(f32::MAX, 0.0)))),
];

const GEOM_METHODS: [Setter<Geom>; 2] = [
    ("friction_coefficient", |geom, bad| geom.set_friction_coefficient(bad)),
    ("restitution_coefficient", |geom, bad| geom.set_restitution_coefficient(bad)),
];

/// Two boxes that touch, after a few updates.
fn touching_boxes(methods: Methods) -> PhysicsSimulator {
    let mut simulator = simulator_with(10.0, methods);
    let (body, geom) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    add_box(&mut simulator, (10.0, 10.0), v(8.0, 1.0));
    simulator[body].set_angular_velocity(0.1);
    simulator[geom].set_friction_coefficient(0.5);
    for _ in 0..3 {
        simulator.update(0.01);
    }
    simulator
}

#[test]
fn bodies_refuse_non_finite_numbers_and_report_them_once() {
    for methods in both_sets() {
        for (argument, method) in &BODY_METHODS[..25] {
            for bad in BAD {
                let (mut simulator, mut expected) = (touching_boxes(methods), touching_boxes(methods));
                let body = simulator.body_list()[0];
                method(&mut simulator[body], bad);
                assert_eq!(body_bits(&simulator[body]), body_bits(&expected[body]), "{argument} {bad}");
                simulator.update(0.01);
                expected.update(0.01);
                assert_eq!(state(&simulator), state(&expected), "{argument} {bad}");
                let report = Event::RejectedInput { object: Some(ObjectId::Body(body)), argument };
                assert_eq!(rejected(&simulator), [*argument], "{bad}");
                assert!(simulator.events().contains(&report));
                simulator.update(0.01);
                assert_eq!(rejected(&simulator), [] as [&str; 0], "reported again: {argument}");
            }
        }
    }
}

#[test]
fn forces_refuse_to_add_up_to_infinity() {
    for methods in both_sets() {
        let mut simulator = touching_boxes(methods);
        let body = simulator.body_list()[0];
        let (argument, method) = BODY_METHODS[25];
        method(&mut simulator[body], f32::NAN);
        assert_eq!(simulator[body].force(), v(f32::MAX, 0.0));
        simulator.update(0.01);
        assert_eq!(rejected(&simulator), [argument]);
    }
}

#[test]
fn geoms_refuse_non_finite_numbers_and_report_them_once() {
    for methods in both_sets() {
        for (argument, method) in GEOM_METHODS {
            for bad in BAD {
                let (mut simulator, mut expected) = (touching_boxes(methods), touching_boxes(methods));
                let geom = simulator.geom_list()[0];
                method(&mut simulator[geom], bad);
                assert_eq!(simulator[geom].friction_coefficient(), 0.5);
                assert_eq!(simulator[geom].restitution_coefficient(), 0.0);
                simulator.update(0.01);
                expected.update(0.01);
                assert_eq!(state(&simulator), state(&expected));
                let report = Event::RejectedInput { object: Some(ObjectId::Geom(geom)), argument };
                assert_eq!(rejected(&simulator), [argument]);
                assert!(simulator.events().contains(&report));
                simulator.update(0.01);
                assert_eq!(rejected(&simulator), [] as [&str; 0]);
            }
        }
    }
}

#[test]
fn updates_refuse_steps_that_are_not_finite() {
    for methods in both_sets() {
        // Steps so small that their reciprocal is infinite as well.
        for dt in BAD.into_iter().chain([1e-39, -1e-39, f32::from_bits(1)]) {
            let mut simulator = touching_boxes(methods);
            let before = state(&simulator);
            simulator.update(dt);
            assert_eq!(state(&simulator), before, "{dt}");
            assert_eq!(simulator.events(), [Event::RejectedInput { object: None, argument: "dt" }]);
            simulator.update(0.0);
            assert_eq!(simulator.events(), []);
            assert_eq!(state(&simulator), before, "{dt}");
        }
    }
}

#[test]
fn a_refused_step_leaves_pending_edits_for_the_next() {
    for methods in both_sets() {
        let mut simulator = touching_boxes(methods);
        let body = simulator.body_list()[0];
        let (_, waiting) = add_box(&mut simulator, (10.0, 10.0), v(100.0, 0.0));
        simulator[body].set_angular_velocity(f32::NAN);
        simulator.update(f32::NAN);
        assert_eq!(simulator.geom_list().len(), 2);
        simulator.update(0.01);
        assert!(simulator.geom_list().contains(&waiting));
        assert_eq!(rejected(&simulator), ["angular_velocity"]);
    }
}

/// The stages are public; those with a step or its reciprocal must refuse it, too.
#[test]
fn stages_refuse_steps_that_are_not_finite() {
    for bad in BAD {
        let mut simulator = touching_boxes(Methods::default());
        assert!(!simulator.process_queues(bad, None));
        let mut simulator = touching_boxes(Methods::default());
        assert!(simulator.process_queues(0.01, None));
        simulator.find_pairs(None);
        simulator.collide_pairs(None);
        let before: Vec<Vec<u32>> =
            simulator.body_list().iter().map(|&body| body_bits(&simulator[body])).collect();
        simulator.apply_forces(bad, 0.0, None);
        simulator.pre_step(bad);
        simulator.solve_iteration(None);
        simulator.integrate(bad, None);
        let after: Vec<Vec<u32>> =
            simulator.body_list().iter().map(|&body| body_bits(&simulator[body])).collect();
        assert_eq!(before, after, "{bad}");
    }
}

#[test]
fn settings_refuse_non_finite_numbers() {
    for bad in BAD {
        let mut simulator = simulator(10.0);
        assert!(simulator.set_gravity(v(bad, 0.0)).is_err() && simulator.set_gravity(v(0.0, bad)).is_err());
        assert!(simulator.set_bias_factor(bad).is_err());
        assert!(simulator.set_allowed_penetration(bad).is_err());
        assert!(PhysicsSimulator::new(v(bad, 0.0)).is_err());
        assert_eq!(simulator.gravity(), v(0.0, 10.0));
        assert_eq!((simulator.bias_factor(), simulator.allowed_penetration()), (0.8, 0.05));
    }
}

#[test]
fn bodies_refuse_masses_that_are_not_finite_or_have_no_reciprocal() {
    for bad in BAD.into_iter().chain([0.0, -0.0, 1e-39, f32::from_bits(1)]) {
        let mut body = Body::new();
        assert!(body.set_mass(bad).is_err(), "{bad}");
        assert!(body.set_moment_of_inertia(bad).is_err(), "{bad}");
        assert_eq!(body_bits(&body), body_bits(&Body::new()));
    }
}

#[test]
fn geoms_refuse_outlines_and_placements_that_are_not_finite() {
    for bad in BAD {
        let mut simulator = simulator(0.0);
        let (body, geom) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        simulator.process_added_and_removed();
        let outline = Vertices::create_simple_rectangle(10.0, 10.0).unwrap();
        let mut bad_outline = outline.clone();
        bad_outline[2].x = bad;
        let good = GeomPlacement::default();
        for placement in [
            GeomPlacement { offset: v(bad, 0.0), ..good },
            GeomPlacement { offset: v(0.0, bad), ..good },
            GeomPlacement { rotation_offset: bad, ..good },
            GeomPlacement { collision_grid_size: bad, ..good },
        ] {
            assert!(simulator.create_geom(body, outline.clone(), placement).is_err());
        }
        assert!(simulator.create_geom(body, bad_outline.clone(), good).is_err());
        assert!(simulator.set_vertices(geom, bad_outline).is_err());
        assert!(simulator.clone_geom_with_offset(body, geom, v(bad, 0.0), 0.0).is_err());
        assert!(simulator.clone_geom_with_offset(body, geom, v(0.0, 0.0), bad).is_err());
        assert_eq!(simulator.geoms_of(body), [geom]);
        // A refused call takes no creation number.
        let next = simulator.create_geom(body, outline, good).unwrap();
        assert_eq!(simulator.geom(next).unwrap().id(), 1);
    }
}

#[test]
fn queries_with_non_finite_numbers_find_nothing() {
    for methods in plane::methods() {
        let mut simulator = plane::simulator_with(0.0, methods);
        add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
        simulator.process_added_and_removed();
        for bad in BAD {
            assert_eq!(simulator.collide(v(bad, 0.0)), None);
            assert_eq!(simulator.collide_all(v(0.0, bad)), []);
            let hits = simulator.line_segment_all_geoms_intersect(v(bad, bad), v(0.0, 0.0), false);
            assert!(hits.iter().all(|hit| hit.points.iter().all(|p| p.x.is_finite() && p.y.is_finite())));
        }
    }
}

#[test]
fn refusals_are_reported_one_by_one_and_beyond_sixteen_each_argument_once() {
    for methods in both_sets() {
        let mut simulator = touching_boxes(methods);
        let body = simulator.body_list()[0];
        for _ in 0..20 {
            simulator[body].set_position(v(f32::NAN, 0.0));
        }
        simulator[body].set_rotation(f32::NAN);
        simulator[body].set_rotation(f32::NAN);
        simulator.update(0.01);
        let expected = [&["position"; 16][..], &["rotation"]].concat();
        assert_eq!(rejected(&simulator), expected);
    }
}

/// Bytes of a simulator's data beside its contacts, after a number of refusals.
fn length_after_refusals(methods: Methods, count: usize) -> usize {
    let mut simulator = touching_boxes(methods);
    let (body, geom) = (simulator.body_list()[0], simulator.geom_list()[0]);
    let outline = simulator.geom(geom).unwrap().local_vertices().clone();
    for _ in 0..count {
        simulator[body].set_position(v(f32::NAN, 0.0));
        simulator[geom].set_restitution_coefficient(f32::NAN);
        simulator.set_vertices(geom, outline.clone()).unwrap();
        simulator.update(f32::NAN);
    }
    simulator.snapshot().len()
}

#[test]
fn refusals_do_not_pile_up_while_every_step_is_refused() {
    for methods in both_sets() {
        assert_eq!(length_after_refusals(methods, 20), length_after_refusals(methods, 1000));
    }
}
