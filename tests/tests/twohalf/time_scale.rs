//! Bodies with a time scale below that of the others, or of 0.

use conformance::fixtures::depth::{
    DT, assert_goes_on_after_loading, assert_near, assert_near3, ball, momentum, place, platform, run,
    set_surface, simulator, solid, throw, velocity, weightless, with_scheme,
};
use twohalf::{
    BodyId, CharacterController, CharacterSettings, DepthScheme, MoveInput, TwoHalfPhysicsSimulator,
};
use twohalf_factories::{Figure, spawn};

fn precise(test: impl FnOnce()) {
    with_scheme(DepthScheme::Precise, test);
}

/// A box in the air with a velocity along all axes.
fn thrown() -> (TwoHalfPhysicsSimulator, BodyId) {
    let mut simulator = simulator();
    let body = solid(&mut simulator, [20.0; 3], [0.0, 500.0, 50.0]);
    throw(&mut simulator, body, [60.0, 30.0, 40.0]);
    simulator.body_mut(body).unwrap().set_angular_velocity(2.0);
    (simulator, body)
}

#[test]
fn a_stopped_body_stays_to_the_bit_and_goes_on_with_the_velocity_that_it_had() {
    precise(|| {
        let (mut simulator, body) = thrown();
        run(&mut simulator, 10);
        let (there, speed) = (place(&simulator, body), velocity(&simulator, body));
        simulator.stop_time(body, 25).unwrap();
        for _ in 0..25 {
            assert_eq!(simulator.time_scale(body), 0.0);
            run(&mut simulator, 1);
            assert_eq!((place(&simulator, body), velocity(&simulator, body)), (there, speed));
            assert_eq!(simulator.body(body).unwrap().angular_velocity(), 2.0);
            assert!(!simulator.body(body).unwrap().is_kinematic());
        }
        assert_eq!(simulator.time_scale(body), 1.0);
        let (mut other, same) = thrown();
        run(&mut other, 40);
        run(&mut simulator, 30);
        assert_eq!(place(&simulator, body), place(&other, same));
        assert_eq!(velocity(&simulator, body), velocity(&other, same));
    });
}

#[test]
fn a_slowed_free_body_takes_longer_for_the_same_distance() {
    precise(|| {
        for (scale, times) in [(0.5, 2), (0.25, 4), (0.1, 10)] {
            let ((mut slow, body), (mut usual, same)) = (thrown(), thrown());
            slow.set_time_scale(body, scale).unwrap();
            for _ in 0..8 {
                run(&mut slow, 10 * times);
                run(&mut usual, 10);
                assert_near3(place(&slow, body), place(&usual, same).into(), 0.02);
                assert_near3(velocity(&slow, body), velocity(&usual, same).into(), 0.02);
                let turned =
                    |simulator: &TwoHalfPhysicsSimulator, body| simulator.body(body).unwrap().rotation();
                assert_near(turned(&slow, body), turned(&usual, same), 1e-3);
            }
        }
    });
}

#[test]
fn drag_and_applied_forces_take_longer_too() {
    precise(|| {
        let scene = || {
            let mut simulator = weightless();
            let body = solid(&mut simulator, [20.0; 3], [0.0, 500.0, 50.0]);
            throw(&mut simulator, body, [200.0, 0.0, 0.0]);
            let mut view = simulator.body_mut(body).unwrap();
            view.set_linear_drag_coefficient(2.0);
            view.core_mut().set_is_quadratic_drag_enabled(true);
            view.core_mut().set_quadratic_drag_coefficient(0.01);
            (simulator, body)
        };
        let ((mut slow, body), (mut usual, same)) = (scene(), scene());
        slow.set_time_scale(body, 0.5).unwrap();
        for _ in 0..40 {
            for _ in 0..2 {
                slow.body_mut(body).unwrap().apply_force3d([0.0, 50.0, 30.0].into());
                run(&mut slow, 1);
            }
            usual.body_mut(same).unwrap().apply_force3d([0.0, 50.0, 30.0].into());
            run(&mut usual, 1);
        }
        // Drag by the square acts over a step as it was when that began.
        assert_near3(velocity(&slow, body), velocity(&usual, same).into(), 0.5);
        assert_near3(place(&slow, body), place(&usual, same).into(), 0.5);
        assert!(velocity(&usual, same).x < 100.0 && velocity(&usual, same).z > 4.0);
    });
}

#[test]
fn a_body_that_hits_a_stopped_body_bounces_as_off_a_wall() {
    precise(|| {
        let mut simulator = weightless();
        let wall = solid(&mut simulator, [20.0; 3], [0.0, 100.0, 50.0]);
        let other = ball(&mut simulator, 10.0, [-60.0, 100.0, 50.0]);
        set_surface(&mut simulator, other, 0.0, 1.0);
        set_surface(&mut simulator, wall, 0.0, 1.0);
        throw(&mut simulator, wall, [0.0, 70.0, 0.0]);
        throw(&mut simulator, other, [100.0, 0.0, 0.0]);
        simulator.stop_time(wall, 80).unwrap();
        run(&mut simulator, 80);
        assert_near3(velocity(&simulator, other), [-100.0, 0.0, 0.0], 0.01);
        assert_near3(place(&simulator, wall), [0.0, 100.0, 50.0], 0.0);
        run(&mut simulator, 10);
        assert_near3(place(&simulator, wall), [0.0, 107.0, 50.0], 0.01);
    });
}

#[test]
fn a_collision_with_a_slowed_body_keeps_momentum() {
    precise(|| {
        for scale in [1.0, 0.5, 0.1] {
            let mut simulator = weightless();
            let slow = solid(&mut simulator, [20.0; 3], [0.0, 100.0, 50.0]);
            let other = solid(&mut simulator, [20.0; 3], [-60.0, 100.0, 50.0]);
            throw(&mut simulator, slow, [20.0, 0.0, 0.0]);
            throw(&mut simulator, other, [200.0, 0.0, 0.0]);
            simulator.set_time_scale(slow, scale).unwrap();
            let before = momentum(&simulator, &[slow, other]);
            run(&mut simulator, 60);
            assert_near3(momentum(&simulator, &[slow, other]), before.into(), 0.05);
            // Their velocities on the screen are equal.
            assert_near(velocity(&simulator, slow).x * scale, velocity(&simulator, other).x, 0.5);
        }
    });
}

#[test]
fn a_body_on_a_stopped_body_waits_and_falls_with_it() {
    precise(|| {
        let mut simulator = simulator();
        let below = solid(&mut simulator, [40.0; 3], [0.0, 200.0, 50.0]);
        let above = solid(&mut simulator, [20.0; 3], [0.0, 240.0, 50.0]);
        simulator.set_time_scale(below, 0.0).unwrap();
        run(&mut simulator, 400);
        assert_near3(place(&simulator, above), [0.0, 240.0, 50.0], 0.05);
        assert!(simulator.is_asleep(above));
        simulator.set_time_scale(below, 1.0).unwrap();
        run(&mut simulator, 100);
        assert_near(place(&simulator, below).y, 200.0 - 50.0, 0.1);
        assert_near(place(&simulator, above).y, 240.0 - 50.0, 0.1);
        run(&mut simulator, 600);
        assert_near(place(&simulator, above).y, 40.0, 0.1);
        assert!(simulator.is_asleep(above) && simulator.is_asleep(below));
    });
}

#[test]
fn impulses_and_velocities_wait_for_a_stopped_body_and_forces_do_not() {
    precise(|| {
        let mut simulator = weightless();
        let body = solid(&mut simulator, [20.0; 3], [0.0, 100.0, 50.0]);
        simulator.stop_time(body, 20).unwrap();
        run(&mut simulator, 5);
        simulator.body_mut(body).unwrap().apply_impulse3d([30.0, 0.0, 20.0].into());
        for _ in 0..5 {
            simulator.body_mut(body).unwrap().apply_force3d([0.0, 1e4, 1e4].into());
            simulator.body_mut(body).unwrap().apply_torque(1e4);
            run(&mut simulator, 1);
        }
        assert_near3(velocity(&simulator, body), [30.0, 0.0, 20.0], 0.0);
        throw(&mut simulator, body, [0.0, 50.0, 0.0]);
        run(&mut simulator, 10);
        assert_near3(place(&simulator, body), [0.0, 100.0, 50.0], 0.0);
        run(&mut simulator, 10);
        assert_near3(place(&simulator, body), [0.0, 100.0 + 500.0 * DT, 50.0], 1e-3);
    });
}

#[test]
fn a_slow_body_lands_rests_and_sleeps_where_others_do() {
    precise(|| {
        let mut simulator = simulator();
        platform(&mut simulator, [200.0, 20.0, 100.0], [0.0, 0.0, 50.0]);
        let bodies = [-50.0, 50.0].map(|x| solid(&mut simulator, [20.0; 3], [x, 60.0, 50.0]));
        simulator.set_time_scale(bodies[0], 0.25).unwrap();
        run(&mut simulator, 1500);
        for body in bodies {
            assert_near(place(&simulator, body).y, 20.0, 0.05);
            assert!(simulator.is_asleep(body));
        }
        simulator.set_time_scale(bodies[0], 1.0).unwrap();
        run(&mut simulator, 300);
        assert_near(place(&simulator, bodies[0]).y, 20.0, 0.05);
    });
}

#[test]
fn a_figure_walks_and_jumps_in_its_own_time() {
    precise(|| {
        for scale in [0.5_f32, 0.25] {
            let mut simulator = simulator();
            let figure =
                spawn(&mut simulator, Figure::new([30.0, 60.0, 20.0]).at([0.0, 0.0, 50.0])).unwrap().body;
            let mut walker = CharacterController::new(CharacterSettings::default());
            simulator.set_time_scale(figure, scale).unwrap();
            let mut walk = |simulator: &mut TwoHalfPhysicsSimulator, steps: usize, jumps: bool| {
                let mut top = 0.0_f32;
                for step in 0..steps {
                    let wish = MoveInput { x: 100.0, z: 0.0, jump: jumps && step == 0 };
                    simulator.walk(figure, &mut walker, wish, DT).unwrap();
                    run(simulator, 1);
                    top = top.max(place(simulator, figure).y);
                }
                top
            };
            walk(&mut simulator, 100, false);
            let from = place(&simulator, figure).x;
            walk(&mut simulator, 100, false);
            assert_near(place(&simulator, figure).x - from, 100.0 * scale * (100.0 * DT), 0.2);
            let top = walk(&mut simulator, (2.0 / (scale * DT)) as usize, true);
            assert_near(top, 60.0, 1.0);
            simulator.stop_time(figure, 50).unwrap();
            let there = place(&simulator, figure);
            walk(&mut simulator, 50, false);
            assert_eq!(place(&simulator, figure), there);
        }
    });
}

#[test]
fn a_slow_figure_is_carried_as_fast_as_others() {
    precise(|| {
        let mut simulator = simulator();
        let lift = platform(&mut simulator, [400.0, 20.0, 100.0], [0.0, 0.0, 50.0]);
        let figure =
            spawn(&mut simulator, Figure::new([30.0, 60.0, 20.0]).at([0.0, 20.0, 50.0])).unwrap().body;
        let mut walker = CharacterController::new(CharacterSettings::default());
        simulator.set_time_scale(figure, 0.25).unwrap();
        simulator.platform_mut(lift).unwrap().set_velocity([40.0, 30.0, 0.0].into()).unwrap();
        for _ in 0..200 {
            simulator.walk(figure, &mut walker, MoveInput::default(), DT).unwrap();
            run(&mut simulator, 1);
        }
        let lift = simulator.platform(lift).unwrap().position3d();
        assert_near(place(&simulator, figure).y, lift.y + 20.0, 0.1);
        // It reaches the speed in its own time: 40 / 0.25 px/s at 1500 px/s², during which 1 / 0.25 as much time passes.
        let lag = 0.5 * 40.0 * (160.0 / 1500.0 / 0.25);
        assert_near(place(&simulator, figure).x, lift.x - lag, 1.0);
    });
}

#[test]
fn a_stopped_and_a_slow_body_go_on_after_loading() {
    precise(|| {
        let mut simulator = simulator();
        let bodies = [0.0, 25.0, 50.0].map(|y| solid(&mut simulator, [20.0; 3], [0.0, y, 50.0]));
        let rolling = ball(&mut simulator, 8.0, [-60.0, 0.0, 50.0]);
        throw(&mut simulator, rolling, [120.0, 0.0, 0.0]);
        simulator.set_time_scale(bodies[1], 0.5).unwrap();
        simulator.stop_time(bodies[2], 30).unwrap();
        let [a, b, c] = bodies;
        assert_goes_on_after_loading(&mut simulator, &[a, b, c, rolling]);
    });
}

#[test]
fn invalid_time_scales_are_refused() {
    precise(|| {
        let mut simulator = simulator();
        let body = ball(&mut simulator, 8.0, [0.0; 3]);
        for scale in [-1.0, 0.001, 1.5, f32::NAN, f32::INFINITY] {
            assert!(simulator.set_time_scale(body, scale).is_err());
        }
        assert_eq!(simulator.time_scale(body), 1.0);
        simulator.dispose(body).unwrap();
        run(&mut simulator, 1);
        assert!(simulator.set_time_scale(body, 0.5).is_err() && simulator.stop_time(body, 3).is_err());
    });
    for scheme in [DepthScheme::Faithful, DepthScheme::Thesis] {
        with_scheme(scheme, || {
            let mut simulator = simulator();
            let body = ball(&mut simulator, 8.0, [0.0; 3]);
            assert!(simulator.set_time_scale(body, 0.5).is_err() && simulator.stop_time(body, 3).is_err());
        });
    }
}
