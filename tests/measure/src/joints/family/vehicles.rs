//! Carts, cars with suspension springs, and tanks with tracks.

use super::JointScene;
use crate::joints::assembly::{Assembly, Form, JointKind};
use std::f32::consts::PI;

/// Gravity in px/s², downwards.
const GRAVITY: f32 = 900.0;
/// Radius of the wheels of a cart, and distance along x of each wheel from the middle of the cart, in px.
const WHEEL: [f32; 2] = [12.0, 35.0];
/// Number of links of a track.
const TRACK: usize = 24;
/// Radius of the round ends of a track, and distance between the centres of both ends, in px.
const OVAL: [f32; 2] = [20.0, 60.0];

pub(super) fn scenes() -> Vec<JointScene> {
    let mut scenes = Vec::from([20.0, 50.0, 200.0].map(cart));
    scenes.extend([motor_cart(), car(10.0), car(150.0), tank(1.0), tank(20.0)]);
    scenes
}

/// Returns a box of `mass` kg on two wheels of 1 kg.
fn cart(mass: f32) -> JointScene {
    JointScene::new(format!("cart {mass} on wheels 1"), on_wheels(mass, 0.5, None)).watching(1)
}

/// Returns a cart with motors at both wheels: it should move at the speed of the wheel rims.
fn motor_cart() -> JointScene {
    let assembly = on_wheels(20.0, 0.9, Some([10.0, 4e4]));
    let way = 10.0 * WHEEL[0] * super::SECONDS as f32;
    JointScene::new("cart 20 driven by motors 10 rad/s", assembly).watching_at(1, [way, -25.0])
}

/// Returns a cart of `mass` kg (body 1) on two wheels of 1 kg. `motor` is angular velocity in rad/s and greatest torque in
/// kg px²/s².
fn on_wheels(mass: f32, friction: f32, motor: Option<[f32; 2]>) -> Assembly {
    let mut assembly = Assembly::with_floor(GRAVITY, friction);
    let cart = assembly.rectangle([0.0, -25.0], [100.0, 20.0], mass, 1);
    let [radius, side] = WHEEL;
    for x in [-side, side] {
        let anchor = [x, -radius];
        let wheel = assembly.circle(anchor, radius, 1.0, 1);
        assembly.joint(cart, wheel, JointKind::Hinge { anchor, limits: None, motor });
    }
    assembly
}

/// Returns a car of `mass` kg on two axles of 1 kg with wheels of 1 kg; the stiffness of the suspension springs is
/// proportional to the mass of the car.
fn car(mass: f32) -> JointScene {
    let mut assembly = Assembly::with_floor(GRAVITY, 0.5);
    let car = assembly.rectangle([0.0, -40.0], [120.0, 20.0], mass, 1);
    let (stiffness, damping) = (400.0 * mass, 20.0 * mass);
    for x in [-40.0, 40.0] {
        let place = [x, -15.0];
        let wheel = assembly.circle(place, 15.0, 1.0, 1);
        let axle = assembly.body(place, Form::None, 1.0, 0);
        assembly.slider(car, axle, place, [0.0, 1.0]);
        assembly.hinge(axle, wheel, place);
        assembly.spring(car, [x, 0.0], axle, stiffness, damping);
    }
    let sag = mass * GRAVITY / (2.0 * stiffness);
    JointScene::new(format!("car {mass} on springs"), assembly).watching_at(car, [0.0, -40.0 + sag])
}

/// Returns a tank: a body of `mass` kg on two wheels within a closed track of links on hinges.
fn tank(mass: f32) -> JointScene {
    let mut assembly = Assembly::with_floor(GRAVITY, 0.8);
    let [radius, length] = OVAL;
    let y = -radius - 3.0;
    let hull = assembly.rectangle([0.0, y], [length, 10.0], mass, 1);
    for x in [-length / 2.0, length / 2.0] {
        let wheel = assembly.circle([x, y], radius - 3.5, 1.0, 0);
        assembly.hinge(hull, wheel, [x, y]);
    }
    let pitch = (2.0 * length + 2.0 * PI * radius) / TRACK as f32;
    let first = assembly.bodies.len();
    for index in 0..TRACK {
        let ([dx, dy], angle) = on_track((index as f32 + 0.5) * pitch);
        let link = assembly.rectangle([dx, y + dy], [pitch - 1.0, 5.0], 0.2, 0);
        assembly.bodies[link].angle = angle;
    }
    for index in 0..TRACK {
        let ([dx, dy], _) = on_track((index as f32 + 1.0) * pitch);
        assembly.hinge(first + index, first + (index + 1) % TRACK, [dx, y + dy]);
    }
    JointScene::new(format!("tank {mass}, track of {TRACK}"), assembly)
}

/// Returns position in px relative to the middle of a track, and angle in rad, after a distance of `way` px from the start
/// of its upper side.
fn on_track(way: f32) -> ([f32; 2], f32) {
    let [radius, length] = OVAL;
    let half = length + PI * radius;
    let way = way % (2.0 * half);
    // The second half of the track is the first one rotated by half a turn.
    let (way, turn, sign) = if way < half { (way, 0.0, 1.0) } else { (way - half, PI, -1.0) };
    let (place, angle) = if way < length {
        ([way - length / 2.0, -radius], 0.0)
    } else {
        let angle = (way - length) / radius;
        ([length / 2.0 + radius * angle.sin(), -radius * angle.cos()], angle)
    };
    (place.map(|part| sign * part), turn + angle)
}
