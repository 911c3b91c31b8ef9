//! Lifts, platforms, belts, walls that move, and dynamic bodies.

use super::*;

#[test]
fn a_lift_carries_it_up_and_down_without_jitter() {
    for (speed, case) in
        [60.0, -60.0, 300.0, -300.0].into_iter().flat_map(|it| cases().map(move |case| (it, case)))
    {
        let mut stage = Stage::new(case, [0.0, -0.1]);
        let lift = stage.kinematic([100.0, 20.0], [0.0, 10.0], [0.0, 0.0]);
        stage.run(STILL, 0.2, |_| {});
        stage.simulator[lift].set_linear_velocity(Vector2::new(0.0, speed));
        let gap = stage.simulator[lift].position().y - stage.at().y;
        stage.run(STILL, 2.0, |stage| {
            assert!(stage.mover.is_grounded());
            near(stage.simulator[lift].position().y - stage.at().y, gap, 1e-3);
            near(stage.at().x, 0.0, 1e-6);
        });
    }
}

#[test]
fn a_platform_carries_it_with_its_exact_velocity_standing_walking_and_jumping() {
    for case in cases() {
        let mut stage = Stage::new(case, [0.0, -0.1]);
        let platform = stage.kinematic([4000.0, 20.0], [0.0, 10.0], [70.0, 0.0]);
        stage.run(STILL, 0.2, |_| {});
        let start = stage.at().x - stage.simulator[platform].position().x;
        stage.run(STILL, 1.0, |stage| {
            near(stage.at().x - stage.simulator[platform].position().x, start, 1e-3);
        });
        near(stage.mover.velocity().x, 70.0, 1e-3);
        stage.run(RIGHT, 0.1, |_| {});
        near(stage.mover.velocity().x, 220.0, 0.01);
        stage.run(STILL, 0.5, |_| {});
        let start = stage.at().x - stage.simulator[platform].position().x;
        stage.step(JUMP);
        stage.run(JUMP, 1.0, |stage| {
            near(stage.at().x - stage.simulator[platform].position().x, start, 0.01);
        });
        assert!(stage.mover.is_grounded());
    }
}

#[test]
fn a_jump_from_a_rising_lift_has_its_velocity_too() {
    for case in cases() {
        let mut stage = Stage::new(case, [0.0, -0.1]);
        stage.kinematic([100.0, 20.0], [0.0, 10.0], [0.0, -120.0]);
        stage.run(STILL, 0.5, |_| {});
        stage.step(JUMP);
        let speed = (2.0 * GRAVITY * 60.0f32).sqrt() + 120.0;
        near(stage.mover.velocity().y, -speed + GRAVITY * stage.dt, 0.01);
    }
}

#[test]
fn a_turning_platform_and_a_belt_carry_it() {
    for case in cases() {
        let mut stage = Stage::new(case.clone(), [60.0, -0.1]);
        let wheel = stage.kinematic([400.0, 20.0], [0.0, 10.0], [0.0, 0.0]);
        stage.run(STILL, 0.1, |_| {});
        let start = stage.at();
        stage.simulator[wheel].set_angular_velocity(0.3);
        stage.run(STILL, 1.0, |stage| assert!(stage.mover.is_grounded()));
        // A point of the top, 60 right of the middle and 10 above it, turns by 0.3.
        let (sine, cosine) = 0.3f32.sin_cos();
        near(stage.at().x - start.x, 60.0 * (cosine - 1.0) + 10.0 * sine, 4.0);

        let (body, slab) = (BodyBuilder::fixed().position([0.0, 10.0]), GeomBuilder::rectangle(4000.0, 20.0));
        let belts =
            [(body.clone().linear_velocity([50.0, 0.0]), slab.clone()), (body, slab.surface_speed(50.0))];
        for (body, geom) in belts {
            let mut stage = Stage::new(case.clone(), [0.0, -0.1]);
            stage.simulator.add_body(body, [geom]).unwrap();
            stage.run(STILL, 0.2, |_| {});
            let start = stage.at().x;
            stage.run(STILL, 1.0, |_| {});
            near(stage.at().x - start, 50.0, 0.01);
        }
    }
}

#[test]
fn a_moving_wall_pushes_it_and_crushes_it_against_another() {
    for case in cases() {
        let mut stage = Stage::on_ground(case);
        let wall = stage.kinematic([20.0, 100.0], [-60.0, -51.0], [120.0, 0.0]);
        stage.fixed([20.0, 100.0], [100.0, -50.0]);
        let mut crushed = None;
        for _ in 0..(1.4 / stage.dt) as usize {
            let report = stage.step(STILL);
            let face = stage.simulator[wall].position().x + 10.0;
            let room = 90.0 - face;
            assert!(stage.at().x + 15.0 <= 90.0 + 1e-3, "it is in the static wall: {:?}", stage.at());
            if room > 30.1 {
                assert_eq!(report.crushed_by, None, "{room}");
                assert!(stage.at().x - 15.0 >= face - 1e-3, "the wall is in it: {:?} {face}", stage.at());
            }
            crushed = crushed.or(report.crushed_by);
        }
        assert_eq!(crushed, Some(wall));
        near(stage.height(), 0.0, 0.1);
    }
}

#[test]
fn a_lift_under_a_ceiling_crushes_it() {
    for case in cases() {
        let mut stage = Stage::new(case, [0.0, -0.1]);
        let lift = stage.kinematic([100.0, 20.0], [0.0, 10.0], [0.0, -50.0]);
        stage.fixed([200.0, 20.0], [0.0, -110.0]);
        let mut first = None;
        for step in 0..(1.2 / stage.dt) as usize {
            let report = stage.step(STILL);
            assert!(stage.at().y - 30.0 >= -100.0 - 1e-3, "{:?}", stage.at());
            if report.crushed_by == Some(lift) {
                first = first.or(Some(step as f32 * stage.dt));
            }
        }
        // The room of 100 becomes 60 after 40 px.
        near(first.unwrap(), 0.8, 0.01 + 2.0 * stage.dt);
    }
}

#[test]
fn it_pushes_light_bodies_and_not_heavy_ones() {
    for case in cases() {
        let push = |mass: f32| {
            let mut stage = Stage::on_ground(case.clone());
            let load = stage.crate_box(40.0, mass, [60.0, -20.0]);
            stage.run(RIGHT, 2.0, |stage| near(stage.height(), 0.0, 0.1));
            stage.simulator[load].position().x - 60.0
        };
        // Friction resists with 0.5 x 900 times the mass: 450, and 45000 to a force of 3000.
        let (light, heavy) = (push(1.0), push(100.0));
        assert!(light > 180.0 && heavy < 0.5, "{} {light} {heavy}", case.1);
    }
}

#[test]
fn the_force_of_a_push_is_bounded_at_every_rate() {
    for case in cases() {
        let mut stage = Stage::on_ground(case);
        stage.simulator.set_gravity(Vector2::zeros()).unwrap();
        let load = stage.crate_box(60.0, 100.0, [45.1, -31.0]);
        stage.mover.options.push_force = 4000.0;
        stage.run(RIGHT, 1.0, |_| {});
        // 4000 / 100 px/s² for a second, but for the first tenth.
        let speed = stage.simulator[load].linear_velocity().x;
        assert!((30.0..=40.01).contains(&speed), "{speed}");
    }
}

#[test]
fn it_stands_on_crates_and_its_weight_acts() {
    for case in cases() {
        let mut stage = Stage::on_ground(case);
        let load = stage.crate_box(60.0, 4.0, [200.0, -30.0]);
        stage.mover.set_position([200.0, -120.0]).unwrap();
        stage.run(STILL, 1.0, |_| {});
        assert!(stage.mover.is_grounded());
        near(stage.height(), 60.0, 0.3);
        near(stage.simulator[load].position().x, 200.0, 0.1);
        // A plank on an edge tips under it.
        let mut stage = stage.clone();
        stage.fixed([40.0, 40.0], [-200.0, -20.0]);
        let plank = BodyBuilder::dynamic().position([-200.0, -45.0]).mass(1.0);
        let (plank, _) = stage.simulator.add_body(plank, [GeomBuilder::rectangle(200.0, 10.0)]).unwrap();
        stage.mover.set_position([-130.0, -90.0]).unwrap();
        stage.run(STILL, 0.7, |_| {});
        assert!(stage.simulator[plank].rotation() > 0.2, "{}", stage.simulator[plank].rotation());
    }
}

#[test]
fn a_body_that_follows_it_holds_crates_and_is_seen_by_sensors() {
    use farseer_core::Event;
    for (shape, rate) in cases() {
        let mut stage = Stage::on_ground((shape.clone(), rate));
        let (body, [geom]) = stage.simulator.add_body(BodyBuilder::kinematic(), [shape]).unwrap();
        stage.mover.set_body(Some(body));
        let coin = GeomBuilder::circle(8.0).sensor(true);
        let (_, [coin]) =
            stage.simulator.add_body(BodyBuilder::fixed().position([60.0, -30.0]), [coin]).unwrap();
        let mut seen = 0;
        stage.run(RIGHT, 1.0, |stage| {
            assert!(stage.mover.is_grounded());
            let began = Event::SensorBegin { sensor: coin, visitor: geom };
            seen += stage.simulator.events().iter().filter(|&&event| event == began).count();
        });
        assert_eq!(seen, 1);
        near(stage.at().x, 142.5, 0.1);
        stage.run(STILL, 0.3, |_| {});
        let load = stage.crate_box(60.0, 1.0, [stage.at().x, -130.0]);
        stage.run(STILL, 1.0, |_| {});
        assert!(stage.simulator[load].position().y < -80.0, "{:?}", stage.simulator[load].position());
    }
}
