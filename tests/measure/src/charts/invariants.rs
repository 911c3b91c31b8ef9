//! Energy and momentum of a scene, from the states of its bodies.

use super::super::world::{BodyMass, World};

/// Kinetic energy and that of height, in kg px²/s², of the bodies that have a mass in the list, by index; gravity in
/// px/s² down.
pub(super) fn energy(masses: &[BodyMass], gravity: f64, world: &dyn World) -> f64 {
    let of_body = |(index, mass): (usize, &BodyMass)| {
        let body = world.body(index);
        let moving = mass.mass * body.speed().powi(2) + mass.inertia * body.angular_velocity.powi(2);
        moving / 2.0 - mass.mass * gravity * body.position[1]
    };
    masses.iter().enumerate().map(of_body).sum()
}

/// Momentum in kg px/s.
pub(super) fn momentum(masses: &[BodyMass], world: &dyn World) -> [f64; 2] {
    let part = |axis: usize| {
        masses.iter().enumerate().map(|(index, mass)| mass.mass * world.body(index).velocity[axis]).sum()
    };
    [part(0), part(1)]
}
