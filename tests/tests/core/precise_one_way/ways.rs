//! Landing and passing, by the direction of the approach.

use super::*;

#[test]
fn a_falling_body_lands_from_any_height() {
    for (name, add, height) in THINGS {
        for (rate, above) in
            RATES.into_iter().flat_map(|rate| [0.0, 1.0, 30.0, 300.0, 3000.0].map(|above| (rate, above)))
        {
            let (mut simulator, _, _) = stage();
            let (body, _) = add(&mut simulator, v(3.0, -HALF - height - above));
            run_for(&mut simulator, 5.0, rate);
            assert_stands(&simulator, body, (name, height), HALF, rate);
        }
    }
}

#[test]
fn a_falling_body_moves_as_on_a_closed_one_to_the_last_bit() {
    for (name, add, height) in THINGS {
        for (rate, above) in RATES.into_iter().flat_map(|rate| [5.0, 50.0, 333.0].map(|above| (rate, above)))
        {
            let (mut open, _, _) = stage();
            let (mut closed, _, platform) = stage();
            closed.set_one_way(platform, None).unwrap();
            let [body, other] = [&mut open, &mut closed].map(|simulator| {
                let (body, _) = add(simulator, v(20.0, -HALF - height - above));
                simulator[body].set_linear_velocity(v(30.0, 0.0));
                simulator[body].set_angular_velocity(0.5);
                body
            });
            // It leaves over the edge at last, and falls past it.
            for step in 0..(6.0 * rate) as usize {
                open.update(1.0 / rate);
                closed.update(1.0 / rate);
                if closed[other].position().x > 100.0 - 2.0 * height {
                    break;
                }
                assert_eq!(body_bits(&open[body]), body_bits(&closed[other]), "{name}, {step}, {rate} Hz");
            }
        }
    }
}

#[test]
fn a_body_faster_than_its_and_the_platforms_thickness_per_step_lands() {
    for (name, add, height) in THINGS {
        for rate in RATES {
            for speed in [2000.0, 20_000.0] {
                let (mut simulator, _, _) = stage();
                let (body, _) = add(&mut simulator, v(-40.0, -400.0 - height));
                simulator[body].set_linear_velocity(v(0.0, speed));
                run_for(&mut simulator, 2.0, rate);
                assert_stands(&simulator, body, (name, height), HALF, rate);
            }
        }
    }
}

#[test]
fn a_body_that_rises_from_below_flies_freely() {
    for (_, add, height) in THINGS {
        // The tallest one is out after 0.2 s, and falls after 0.5 s.
        let from = v(0.0, HALF + height + 20.0);
        assert_flies_free(|| stage().0, add, (from, v(0.0, -600.0)), 0.5);
        // At this speed a closed platform would stop it.
        assert_flies_free(|| stage().0, add, (from, v(0.0, -20_000.0)), 0.5);
    }
}

#[test]
fn a_body_that_has_risen_through_it_lands_on_it() {
    for (name, add, height) in THINGS {
        for (rate, speed) in
            RATES.into_iter().flat_map(|rate| [450.0, 600.0, 700.0].map(|speed| (rate, speed)))
        {
            let (mut simulator, _, _) = stage();
            let (body, _) = add(&mut simulator, v(0.0, HALF + height + 1.0));
            simulator[body].set_linear_velocity(v(0.0, -speed));
            run_for(&mut simulator, 4.0, rate);
            assert_stands(&simulator, body, (name, height), HALF, rate);
        }
    }
}

#[test]
fn a_body_that_turns_back_before_it_has_emerged_falls_freely() {
    for (_, add, height) in THINGS {
        // To where its highest point is 2 and 12 px above the underside, and its lowest 5 and 0.3 px below the top.
        let ways = [22.0, 32.0, 20.0 + 20.0 + 2.0 * height - 5.0, 20.0 + 20.0 + 2.0 * height - 0.3];
        for way in ways.into_iter().filter(|_| height != 12.5) {
            let speed = (2.0 * GRAVITY * way).sqrt();
            let from = v(0.0, HALF + height + 20.0);
            assert_flies_free(|| stage().0, add, (from, v(0.0, -speed)), 1.2);
        }
    }
}

#[test]
fn a_body_from_the_side_below_the_top_passes_through() {
    for (_, add, height) in THINGS {
        for way in [400.0, -400.0, 3000.0, -20_000.0f32] {
            // Its soles rise by 0.05 * 0.05 * 900 / 2 to 3 px below the top, and it leaves again falling.
            let from = v(-150.0 * way.signum(), -HALF - height + 4.0);
            assert_flies_free(|| stage().0, add, (from, v(way, -45.0)), 0.9);
        }
    }
}

#[test]
fn a_ball_at_the_corner_passes_from_the_side_and_lands_from_above() {
    for rate in RATES {
        let (mut simulator, _, _) = stage();
        // Its lowest point comes 4 px below the top before it meets the corner.
        let (passes, _) = add_circle(&mut simulator, 10.0, 12, v(-200.0, -16.0));
        simulator[passes].set_linear_velocity(v(2000.0, 0.0));
        simulator[passes].set_ignore_gravity(true);
        simulator[passes].set_position(v(-200.0, -16.0));
        run_for(&mut simulator, 0.2, rate);
        assert!(simulator[passes].position().x > 150.0, "{rate} Hz");
        assert_near(simulator[passes].position().y, -16.0, 0.0, "height");
        let (lands, _) = add_circle(&mut simulator, 10.0, 12, v(-98.0, -60.0));
        simulator[lands].set_linear_velocity(v(20.0, 0.0));
        run_for(&mut simulator, 3.0, rate);
        assert_near(simulator[lands].position().y, -HALF - 10.0, REST, "the ball that lands");
    }
}

#[test]
fn a_one_way_door_is_open_in_one_direction_and_closed_in_the_other() {
    for rate in RATES {
        let mut simulator = simulator_with(0.0, Methods::PRECISE);
        let (_, wall) = add_floor(&mut simulator, (10.0, 200.0), v(0.0, 0.0));
        simulator.set_one_way(wall, Some(v(3.0, 0.0))).unwrap();
        assert_eq!(simulator.geom(wall).unwrap().one_way(), Some(v(1.0, 0.0)));
        let throw = |simulator: &mut PhysicsSimulator, x: f32, y: f32, speed: f32| {
            let (body, _) = add_box(simulator, (16.0, 16.0), v(x, y));
            simulator[body].set_linear_drag_coefficient(0.0);
            simulator[body].set_linear_velocity(v(speed, 0.0));
            body
        };
        let opens = throw(&mut simulator, -60.0, -40.0, 300.0);
        let shut = throw(&mut simulator, 60.0, 40.0, -300.0);
        run_for(&mut simulator, 1.0, rate);
        assert_near(simulator[opens].position().x, 240.0, 0.01, "who goes through");
        assert!(simulator[shut].position().x >= 13.0 - REST, "{rate} Hz");
    }
}

#[test]
fn a_tilted_one_is_open_from_below_and_closed_from_above() {
    for rate in RATES {
        for tilt in [-0.3f32, 0.3] {
            let (mut simulator, platform, _) = stage();
            simulator[platform].set_rotation(tilt);
            let (ball, _) = add_circle(&mut simulator, 10.0, 12, v(0.0, 80.0));
            simulator[ball].set_linear_velocity(v(0.0, -550.0));
            // Up for 0.61 s to 168 px, down again to the top by 1 s, and at rest against it.
            run_for(&mut simulator, 1.4, rate);
            let (sine, cosine) = tilt.sin_cos();
            let place = simulator[ball].position();
            assert_near(place.x * sine - place.y * cosine, 20.0, 0.1, "height over the middle");
        }
    }
}
