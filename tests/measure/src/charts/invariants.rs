//! Energy and momentum of a scene, from the states of its bodies.

use super::super::world::{BodyMass, World};

/// Returns the sum of kinetic energy and potential energy of gravity, in kg px²/s². `masses` lists the bodies that count;
/// `gravity` is the acceleration in px/s², downwards.
pub(super) fn energy(masses: &[BodyMass], gravity: f64, world: &dyn World) -> f64 {
    let of_body = |(index, mass): (usize, &BodyMass)| {
        let body = world.body(index);
        let moving = mass.mass * body.speed().powi(2) + mass.inertia * body.angular_velocity.powi(2);
        moving / 2.0 - mass.mass * gravity * body.position[1]
    };
    masses.iter().enumerate().map(of_body).sum()
}

/// Returns the total momentum of the bodies in `masses`, along x and y, in kg px/s.
pub(super) fn momentum(masses: &[BodyMass], world: &dyn World) -> [f64; 2] {
    let part = |axis: usize| {
        masses.iter().enumerate().map(|(index, mass)| mass.mass * world.body(index).velocity[axis]).sum()
    };
    [part(0), part(1)]
}
