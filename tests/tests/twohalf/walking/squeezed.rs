//! A figure is not squeezed through anything: thin walls, a corner, flying bodies, and presses that leave it less space than
//! its size.

use super::*;

/// Behind and before X = 100, from the floor up to 300 px.
const THIN: f32 = 4.0;

fn wall_to_the_right(stage: &mut Stage) {
    stage.platform([THIN, 300.0, 600.0], [100.0 + 0.5 * THIN, 0.0, 0.0], 0.0);
}

/// At each rate, with a figure of each shape.
fn for_all(test: impl Fn(f32)) {
    for shape in [None, Some(CYLINDER), Some(CAPSULE)] {
        SHAPE.set(shape);
        RATES.into_iter().for_each(&test);
        SHAPE.set(None);
    }
}

/// Its greatest X.
fn right_side(stage: &Stage) -> f32 {
    let body = stage.simulator.body(stage.figure).unwrap();
    stage.simulator.geom(body.ground().object_geom().unwrap()).unwrap().virtual_geom().right
}

/// Its greatest Z.
fn back_side(stage: &Stage) -> f32 {
    let body = stage.simulator.body(stage.figure).unwrap();
    stage.simulator.geom(body.ground().object_geom().unwrap()).unwrap().virtual_geom().back
}

#[test]
fn it_does_not_walk_through_a_thin_wall_at_any_speed_of_the_input() {
    for_all(|rate| {
        for speed in [150.0, 600.0, 3000.0] {
            for jump in [false, true] {
                let mut stage = Stage::new(rate, [0.0; 3]);
                wall_to_the_right(&mut stage);
                let wish = MoveInput { x: speed, z: 0.2 * speed.min(200.0), jump };
                stage.walk(wish, 2.0, |stage| {
                    let into = right_side(stage) - 100.0;
                    assert!(into < 0.1, "{rate} {speed} {jump}: {into}");
                });
                assert_near(right_side(&stage), 100.0, 0.2);
            }
        }
    });
}

#[test]
fn it_does_not_walk_out_of_a_corner_of_thin_walls() {
    for_all(|rate| {
        let mut stage = Stage::new(rate, [0.0; 3]);
        wall_to_the_right(&mut stage);
        stage.platform([600.0, 300.0, THIN], [0.0, 0.0, 80.0 + 0.5 * THIN], 0.0);
        stage.walk(MoveInput { x: 400.0, z: 400.0, jump: true }, 3.0, |stage| {
            let into = [right_side(stage) - 100.0, back_side(stage) - 80.0];
            assert!(into[0] < 0.1 && into[1] < 0.1, "{rate}: {into:?}");
        });
    });
}

#[test]
fn a_heavy_crate_that_is_thrown_at_it_does_not_push_it_through_a_thin_wall() {
    for_all(|rate| {
        for (mass, speed) in [(70.0, 600.0), (700.0, 600.0), (7000.0, 300.0)] {
            let mut stage = Stage::new(rate, [60.0, 0.0, 0.0]);
            wall_to_the_right(&mut stage);
            let load = stage.crate_box([60.0, 80.0, 60.0], mass, [-60.0, 0.0, 0.0]);
            stage.simulator.body_mut(load).unwrap().core_mut().set_moment_of_inertia(1e20).unwrap();
            stage.walk(STILL, 0.2, |_| {});
            stage.simulator.body_mut(load).unwrap().set_velocity3d(Vector3::new(speed, 0.0, 0.0));
            stage.walk(RIGHT, 2.0, |stage| {
                let middle = right_side(stage) - 15.0;
                assert!(middle < 100.0, "{rate} {mass}: {middle}");
            });
            assert!(right_side(&stage) < 100.2, "{rate} {mass}: {}", right_side(&stage));
        }
    });
}

#[test]
fn between_a_press_and_a_thin_wall_it_stays_between_them() {
    for_all(|rate| {
        let mut stage = Stage::new(rate, [60.0, 0.0, 0.0]);
        wall_to_the_right(&mut stage);
        // It leaves 20 px of space, where the figure needs 30.
        let press = stage.platform([40.0, 300.0, 600.0], [-60.0, 0.0, 0.0], 0.0);
        let goes = |stage: &mut Stage, speed: f32, seconds: f32| {
            let velocity = Vector3::new(speed, 0.0, 0.0);
            stage.simulator.platform_mut(press).unwrap().set_velocity(velocity).unwrap();
            stage.walk(RIGHT, seconds, |stage| {
                let left = stage.simulator.platform(press).unwrap().position3d().x + 20.0;
                let middle = right_side(stage) - 15.0;
                assert!((left..100.0).contains(&middle), "{rate}: {middle} beside {left}");
            });
        };
        goes(&mut stage, 60.0, 2.0);
        goes(&mut stage, 0.0, 1.0);
        goes(&mut stage, -60.0, 1.0);
        assert_near(right_side(&stage), 100.0, 0.2);
    });
}

#[test]
fn between_a_press_and_a_thin_floor_it_stays_above_the_floor() {
    for_all(|rate| {
        let mut stage = Stage::new(rate, [0.0, 100.0, 0.0]);
        stage.platform([400.0, THIN, 400.0], [0.0, 100.0 - THIN, 0.0], 0.0);
        // It leaves 40 px of space, where the figure is 60 px high.
        let press = stage.platform([400.0, 40.0, 400.0], [0.0, 200.0, 0.0], 0.0);
        for (speed, seconds) in [(-30.0, 2.0), (0.0, 1.0), (30.0, 2.0)] {
            let velocity = Vector3::new(0.0, speed, 0.0);
            stage.simulator.platform_mut(press).unwrap().set_velocity(velocity).unwrap();
            stage.walk(STILL, seconds, |stage| {
                let middle = stage.soles() + 30.0;
                let roof = stage.simulator.platform(press).unwrap().position3d().y;
                assert!((100.0..roof).contains(&middle), "{rate}: {middle} below {roof}");
            });
        }
        stage.walk(STILL, 0.5, |_| {});
        assert_near(stage.soles(), 100.0, 0.2);
    });
}
