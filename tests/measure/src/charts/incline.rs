//! Charts of sliding, sticking and rolling on an incline.

use super::super::closed_forms::{RollingPolygon, rolling_acceleration, stopping_distance};
use super::super::watch::{Watch, in_reach, last, worst};
use super::super::world::{World, masses};
use super::build::{GRAVITY, PRESS, ground, on_slope, stage, start};
use super::{ChartScene, ONE_SIZE};
use crate::scenes::stage::{Stage, vector};
use conformance::scene::Scene;

const FRICTION: f64 = 0.5;
/// Angle of the gentle slope: 15 degrees, in radians. A friction coefficient of 0.5 holds a body up to 26.6 degrees.
const GENTLE: f64 = std::f64::consts::PI / 12.0;
/// Angle of the steep slope: 20 degrees, in radians. A rolling disc would slip at a friction coefficient below a third of the
/// slope's tangent, 0.12.
const STEEP: f64 = std::f64::consts::PI / 9.0;
/// Width and height of the crate in px.
const CRATE: [f64; 2] = [32.0, 16.0];
const SPEED: f64 = 160.0;
const RADIUS: f64 = 16.0;
const ROLLING: f64 = 3.0;
/// Number of corners of the wheel, a regular polygon.
const CORNERS: i32 = 16;
/// Angle of the slope of the wheel: 6 degrees, in radians. The wheel soon rolls at the speed that its corners allow: 3.3 rad/s
/// when one lands. It would hop from 4.4 rad/s on, where ω² r and the rest of the turning about a corner exceed the component
/// of gravity perpendicular to the slope. On 11 degrees it reaches that speed.
const SLIGHT: f64 = std::f64::consts::PI / 30.0;
const ROLLING_ON_CORNERS: f64 = 5.0;
const MOVING: usize = 1;
const REACH: f64 = 1e4;

pub(super) fn scenes() -> Vec<ChartScene> {
    let slide = ChartScene {
        name: "slide",
        about: "A crate slides down an incline of 15 degrees until friction has stopped it.",
        sizes: ONE_SIZE,
        build: |_| crate_on_incline(SPEED),
        seconds: 5.0,
        watch: watch_slide,
        error: "error of the stopping distance",
        unit: "px",
        // 8 px is a quarter of the crate's length, on a path of more than five crate lengths.
        tolerance: 8.0,
        broad_phases_matter: false,
        peers_too: true,
    };
    let roll = ChartScene {
        name: "roll_circle",
        about: "A circle rolls down 20 degrees: a true one in rapier and Box2D, here a polygon of 64 edges, which as a rigid \
                body is 6.5 % slower by law.",
        build: |_| circle_on_incline(),
        seconds: ROLLING,
        watch: watch_roll,
        error: "error of the acceleration",
        unit: "%",
        // An error of a twentieth of a barrel's acceleration is invisible.
        tolerance: 5.0,
        ..slide
    };
    vec![
        slide,
        ChartScene {
            name: "stick",
            about: "A crate lies on an incline of 15 degrees, below the angle of friction, for ten seconds.",
            build: |_| crate_on_incline(0.0),
            seconds: 10.0,
            watch: watch_stick,
            error: "creep after the first second",
            // A body that creeps less than a pixel in nine seconds appears at rest.
            tolerance: 1.0,
            ..slide
        },
        roll,
        ChartScene {
            name: "roll_polygon",
            about: "A polygon of 16 edges in every engine rolls down 6 degrees, against a rigid one that never hops.",
            build: |_| wheel_on_incline(),
            seconds: ROLLING_ON_CORNERS,
            watch: watch_roll_on_corners,
            error: "error of the distance rolled",
            ..roll
        },
    ]
}

fn incline(name: &str, angle: f64) -> Stage {
    let mut stage = stage(name).with_surface(FRICTION, 0.0);
    ground(&mut stage, 1600.0, angle);
    stage
}

fn crate_on_incline(speed: f64) -> Scene {
    let mut stage = incline("crate_on_incline", GENTLE);
    let place = on_slope(GENTLE, 0.0, CRATE[1] / 2.0 - PRESS);
    stage.boxed(place, CRATE, 1.0);
    stage.last().rotation = Some(GENTLE as f32);
    stage.last().settings.linear_velocity = Some(vector(on_slope(GENTLE, speed, 0.0)));
    stage.done()
}

fn circle_on_incline() -> Scene {
    let mut stage = incline("circle_on_incline", STEEP);
    stage.disc(on_slope(STEEP, 0.0, RADIUS - PRESS), RADIUS, 1.0, 64);
    stage.done()
}

fn wheel_on_incline() -> Scene {
    let mut stage = incline("polygon_on_incline", SLIGHT);
    // The wheel starts on a corner: it falls forward, and then rolls.
    stage.wheel(on_slope(SLIGHT, 0.0, RADIUS - PRESS), RADIUS, CORNERS);
    stage.last().rotation = Some(SLIGHT as f32);
    stage.done()
}

/// Returns the distance in px, along the slope, of the moving body from the position `from` (px). `angle` is that of the slope
/// in radians.
fn distance_down_slope(world: &dyn World, from: [f64; 2], angle: f64) -> f64 {
    let down = on_slope(angle, 1.0, 0.0);
    let place = world.body(MOVING).position_in_plane();
    (place[0] - from[0]) * down[0] + (place[1] - from[1]) * down[1]
}

fn watch_slide(scene: &Scene) -> Box<dyn Watch> {
    let from = start(scene, MOVING);
    let law = stopping_distance(SPEED, GRAVITY, GENTLE, FRICTION);
    in_reach(last(move |_, world| Some((distance_down_slope(world, from, GENTLE) - law).abs())), REACH)
}

fn watch_stick(_: &Scene) -> Box<dyn Watch> {
    let mut settled = None;
    let creep = move |time: f64, world: &dyn World| {
        if time < 1.0 {
            return None;
        }
        let from = *settled.get_or_insert_with(|| world.body(MOVING).position_in_plane());
        Some(distance_down_slope(world, from, GENTLE).abs())
    };
    in_reach(worst(creep), REACH)
}

fn watch_roll(scene: &Scene) -> Box<dyn Watch> {
    let from = start(scene, MOVING);
    let mass = masses(scene)[MOVING];
    let law = rolling_acceleration(GRAVITY, STEEP, mass.mass, RADIUS, mass.inertia);
    let error = move |time: f64, world: &dyn World| {
        // At the start the path is too short for a relative error.
        (time > ROLLING / 2.0).then(|| {
            let acceleration = 2.0 * distance_down_slope(world, from, STEEP) / (time * time);
            100.0 * (acceleration / law - 1.0).abs()
        })
    };
    in_reach(last(error), REACH)
}

/// Returns the closed form of the rolling polygon with the wheel's initial state in the scene.
fn rolling_wheel(scene: &Scene) -> RollingPolygon {
    let mass = masses(scene)[MOVING];
    RollingPolygon {
        corners: CORNERS.unsigned_abs(),
        radius: RADIUS,
        mass: mass.mass,
        inertia: mass.inertia,
        gravity: GRAVITY,
        slope: SLIGHT,
        foot: 0.0,
        lean: 0.0,
        rate: 0.0,
    }
}

fn watch_roll_on_corners(scene: &Scene) -> Box<dyn Watch> {
    let from = start(scene, MOVING);
    let mut law = rolling_wheel(scene);
    let mut before = 0.0;
    let error = move |time: f64, world: &dyn World| {
        law.roll(time - before);
        before = time;
        // At the start the path is too short for a relative error.
        let late = time > ROLLING_ON_CORNERS / 2.0;
        late.then(|| 100.0 * (distance_down_slope(world, from, SLIGHT) / law.way() - 1.0).abs())
    };
    in_reach(last(error), REACH)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_wheel_neither_hops_nor_slips_nor_turns_back() {
        let mut wheel = rolling_wheel(&wheel_on_incline());
        for _ in 0..(1000.0 * ROLLING_ON_CORNERS) as u32 {
            wheel.roll(1e-3);
            let [along, away] = wheel.push();
            assert!(
                away > 0.4 * GRAVITY && along.abs() < FRICTION / 2.0 * away && wheel.rate > 0.0,
                "{wheel:?}"
            );
        }
        // After more than one turn of the wheel the initial state has no effect.
        assert!(wheel.way() > 100.0, "{wheel:?}");
    }
}
