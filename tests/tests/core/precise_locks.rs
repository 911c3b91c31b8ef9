//! The precise set: bodies whose x or y coordinate is locked.

use conformance::fixtures::plane::{
    SOLVERS, add_box, add_circle, add_floor, add_ghost, add_post, precise, run, simulator, v, with_solver,
};
use farseer_core::{
    BodyBuilder, BodyId, Error, GeomBuilder, JointFactory, Methods, PhysicsSimulator, SolverChoice,
};

const GRAVITY: f32 = 320.0;
const RATES: [f32; 3] = [30.0, 60.0, 240.0];

/// A box without friction on an incline of .5 rad.
fn on_incline(choice: SolverChoice) -> (PhysicsSimulator, BodyId) {
    let mut simulator = with_solver(choice, GRAVITY);
    let (ground, top) = add_box(&mut simulator, (400.0, 40.0), v(0.0, 0.0));
    simulator[ground].set_is_static(true);
    simulator[ground].set_rotation(0.5);
    simulator[top].set_friction_coefficient(0.0);
    let up = v(0.5_f32.sin(), -0.5_f32.cos());
    let (body, geom) = add_box(&mut simulator, (20.0, 20.0), up * 30.0);
    simulator[body].set_rotation(0.5);
    simulator[geom].set_friction_coefficient(0.0);
    (simulator, body)
}

/// The sum of the normal impulses at all contacts of a body.
fn normal_impulse(simulator: &PhysicsSimulator, body: BodyId) -> f32 {
    simulator.contacts_of(body).iter().map(|contact| contact.normal_impulse).sum()
}

#[test]
fn a_body_with_locked_x_rests_on_an_incline_for_ten_minutes_with_the_same_bits() {
    for choice in SOLVERS {
        let (mut simulator, body) = on_incline(choice);
        simulator.set_axes_locked(body, [true, false]).unwrap();
        simulator.set_sleep_enabled(false);
        let at = simulator[body].position();
        run(&mut simulator, 60);
        let rest = simulator[body].position();
        run(&mut simulator, 36_000);
        let end = simulator[body].position();
        assert_eq!(end.x.to_bits(), at.x.to_bits(), "{choice:?}");
        // The contact may be as deep as its slop, .16 px, most of which the body reaches in the first second.
        assert!((rest.y - at.y).abs() < 0.3 && (end.y - rest.y).abs() < 0.1, "{choice:?}: {at} {rest} {end}");
        // The normal force N carries the weight alone: N cos(.5) = m g, compared with a box on a level floor.
        let mut level = with_solver(choice, GRAVITY);
        add_floor(&mut level, (400.0, 20.0), v(0.0, 20.0));
        let (resting, _) = add_box(&mut level, (20.0, 20.0), v(0.0, 0.0));
        level.set_sleep_enabled(false);
        run(&mut level, 240);
        let ratio = normal_impulse(&simulator, body) / normal_impulse(&level, resting);
        assert!((ratio * 0.5_f32.cos() - 1.0).abs() < 0.01, "{choice:?}: {ratio}");
    }
}

#[test]
fn a_locked_body_moves_as_one_on_a_prismatic_joint_to_a_static_body() {
    for choice in SOLVERS {
        for rate in RATES {
            let (mut locked, body) = on_incline(choice);
            locked.set_axes_locked(body, [false, true]).unwrap();
            let (mut joined, other) = on_incline(choice);
            let at = joined[other].position();
            let post = add_post(&mut joined, at);
            JointFactory::create_wheel_joint_in(&mut joined, post, other, at, v(1.0, 0.0), 0.0, 0.0).unwrap();
            for simulator in [&mut locked, &mut joined] {
                // A constant force along x, beside the push of the incline.
                for _ in 0..(0.5 * rate) as u32 {
                    let mass = simulator[body].mass();
                    simulator[body].apply_force(v(100.0 * mass, 0.0));
                    simulator.update(1.0 / rate);
                }
            }
            let [one, two] = [&locked[body], &joined[other]].map(|body| body.position());
            assert_eq!(one.y.to_bits(), at.y.to_bits());
            assert!(
                (one.x - two.x).abs() < 0.05 + 0.01 * (one.x - at.x).abs(),
                "{choice:?} {rate}: {one} {two}"
            );
        }
    }
}

#[test]
fn gravity_acts_along_the_free_axis_alone_by_its_closed_form() {
    for rate in RATES {
        for axes in [[true, false], [false, true], [true, true]] {
            let mut simulator = precise(0.0);
            simulator.set_gravity(v(30.0, 50.0)).unwrap();
            let body = add_ghost(&mut simulator, (10.0, 10.0), v(3.3, 4.4));
            simulator.set_axes_locked(body, axes).unwrap();
            simulator[body].set_linear_velocity(v(7.0, 9.0));
            (0..rate as u32).for_each(|_| simulator.update(1.0 / rate));
            let at = simulator[body].position();
            let free = [3.3 + 7.0 + 15.0, 4.4 + 9.0 + 25.0];
            for (axis, kept) in [3.3_f32, 4.4].into_iter().enumerate() {
                if axes[axis] {
                    assert_eq!(at[axis].to_bits(), kept.to_bits(), "{axes:?}");
                } else {
                    assert!((at[axis] - free[axis]).abs() < 1e-3 * free[axis], "{axes:?} {rate}: {at}");
                }
            }
        }
    }
}

#[test]
fn an_oblique_impact_has_the_impulse_of_infinite_mass_along_the_locked_axis() {
    for choice in SOLVERS {
        let mut simulator = with_solver(choice, 0.0);
        let [a, b] = [v(-20.0, -20.0), v(0.0, 0.0)].map(|at| {
            let (body, geom) = add_circle(&mut simulator, 10.0, 32, at);
            simulator[geom].set_friction_coefficient(0.0);
            simulator[geom].set_restitution_coefficient(0.0);
            simulator[body].set_mass(2.0).unwrap();
            body
        });
        simulator.set_axes_locked(b, [false, true]).unwrap();
        simulator[a].set_linear_velocity(v(60.0, 60.0));
        run(&mut simulator, 30);
        // K = 1/m + nx^2/m along n = (1, 1)/sqrt(2); p = v.n / K.
        let n = std::f32::consts::FRAC_1_SQRT_2;
        let impulse = 60.0 * 2.0 * n / (1.5 / 2.0);
        let (va, vb) = (simulator[a].linear_velocity(), simulator[b].linear_velocity());
        let exact = [60.0 - impulse * n / 2.0, impulse * n / 2.0];
        // The iterative solver solves contact and lock by turns, and pushes out what it left in the first substeps.
        let most = if choice == SolverChoice::Iterative { 4.0 } else { 0.5 };
        assert!((va - v(exact[0], exact[0])).norm() < most, "{choice:?}: {va} {exact:?}");
        assert!((vb - v(exact[1], 0.0)).norm() < most && vb.y == 0.0, "{choice:?}: {vb} {exact:?}");
        assert_eq!(simulator[b].position().y.to_bits(), 0.0_f32.to_bits());
    }
}

#[test]
fn a_pendulum_on_a_cart_with_locked_y_keeps_momentum_along_x() {
    for choice in SOLVERS {
        for rate in RATES {
            let mut simulator = with_solver(choice, GRAVITY);
            let cart = add_ghost(&mut simulator, (20.0, 10.0), v(5.5, 1.1));
            let bob = add_ghost(&mut simulator, (6.0, 6.0), v(45.5, 1.1));
            JointFactory::create_revolute_joint_in(&mut simulator, cart, bob, v(5.5, 1.1)).unwrap();
            simulator.set_axes_locked(cart, [false, true]).unwrap();
            (0..(3.0 * rate) as u32).for_each(|_| {
                simulator.update(1.0 / rate);
                assert_eq!(simulator[cart].position().y.to_bits(), 1.1_f32.to_bits());
            });
            let momentum: f32 =
                [cart, bob].iter().map(|&id| simulator[id].mass() * simulator[id].linear_velocity().x).sum();
            assert!(momentum.abs() < 0.5 * simulator[bob].mass(), "{choice:?} {rate}: {momentum}");
            let apart = simulator[bob].position() - simulator[cart].position();
            assert!((apart.norm() - 40.0).abs() < 0.5, "{choice:?} {rate}: {apart}");
        }
    }
}

#[test]
fn a_column_a_bullet_and_a_pushed_heap_keep_their_locked_coordinates() {
    for choice in SOLVERS {
        let mut simulator = with_solver(choice, GRAVITY);
        add_floor(&mut simulator, (2000.0, 20.0), v(0.0, 10.0));
        let column: Vec<BodyId> = (0..6)
            .map(|at| {
                let (body, _) = add_box(&mut simulator, (20.0, 20.0), v(at as f32, -10.0 - 20.5 * at as f32));
                simulator.set_axes_locked(body, [true, false]).unwrap();
                body
            })
            .collect();
        let (bullet, _) = add_box(&mut simulator, (8.0, 8.0), v(-400.0, -30.7));
        simulator[bullet].set_is_bullet(true);
        simulator[bullet].set_linear_velocity(v(20_000.0, 0.0));
        simulator.set_axes_locked(bullet, [false, true]).unwrap();
        run(&mut simulator, 240);
        for (at, &body) in column.iter().enumerate() {
            assert_eq!(simulator[body].position().x.to_bits(), (at as f32).to_bits(), "{choice:?}");
        }
        let at = simulator[bullet].position();
        assert_eq!(at.y.to_bits(), (-30.7_f32).to_bits());
        assert!(at.x < 0.0, "{choice:?}: the column has infinite mass along x, {at}");
    }
}

#[test]
fn locks_set_and_removed_in_mid_run_wake_and_snapshots_go_on_with_the_same_bits() {
    for choice in SOLVERS {
        let (mut simulator, body) = on_incline(choice);
        simulator.set_axes_locked(body, [true, false]).unwrap();
        run(&mut simulator, 240);
        assert!(simulator.is_asleep(body), "{choice:?}");
        let mut copy = precise(0.0);
        copy.restore(&simulator.snapshot()).unwrap();
        for simulator in [&mut simulator, &mut copy] {
            simulator.set_axes_locked(body, [false, false]).unwrap();
            simulator.update(1.0 / 60.0);
            assert!(!simulator.is_asleep(body), "{choice:?}");
        }
        for step in 0..60 {
            if step == 20 {
                for simulator in [&mut simulator, &mut copy] {
                    simulator.set_axes_locked(body, [false, true]).unwrap();
                }
            }
            if step == 21 || step == 40 {
                let snapshot = copy.snapshot();
                copy = precise(0.0);
                copy.restore(&snapshot).unwrap();
            }
            simulator.update(1.0 / 60.0);
            copy.update(1.0 / 60.0);
            assert!(copy.snapshot() == simulator.snapshot(), "{choice:?}, {step}");
        }
        assert!(simulator[body].position().x > 20.0, "{choice:?}: it slid before");
    }
}

#[test]
fn a_builder_locks_axes_and_the_faithful_methods_refuse_them() {
    let mut simulator = PhysicsSimulator::precise([0.0, 100.0]).unwrap();
    let body = BodyBuilder::dynamic().position([1.0, 2.0]).lock_x(true).lock_y(true).lock_rotation(true);
    let (id, _) = simulator.add_body(body, [GeomBuilder::circle(5.0)]).unwrap();
    assert_eq!(simulator[id].locked_axes(), [true, true]);
    run(&mut simulator, 30);
    assert_eq!(simulator[id].position(), v(1.0, 2.0));
    assert!(matches!(simulator.set_methods(Methods::default()), Err(Error::NotSupported { .. })));
    simulator.set_axes_locked(id, [false; 2]).unwrap();
    assert!(simulator.set_methods(Methods::default()).is_ok());
    let refused = simulator.set_axes_locked(id, [true, false]);
    assert!(matches!(refused, Err(Error::NotSupported { .. })));
    assert!(simulator.set_axes_locked(id, [false; 2]).is_ok());
    let mut faithful = self::simulator(0.0);
    let refused = faithful.add_body(BodyBuilder::dynamic().lock_y(true), [GeomBuilder::circle(5.0)]);
    assert!(matches!(refused, Err(Error::NotSupported { .. })));
}
