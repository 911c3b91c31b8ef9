//! What happens in closed form, where it takes more than a line.

use measure::scenes::depth::GRAVITY;

/// Velocities of two balls, or of a ball and what does not move, after a hit along a normal from the first one to
/// the second.
pub(crate) fn after_hit(
    (velocity_a, inverse_mass_a): ([f64; 3], f64),
    (velocity_b, inverse_mass_b): ([f64; 3], f64),
    restitution: f64,
    towards_b: [f64; 3],
) -> [[f64; 3]; 2] {
    let length = towards_b.iter().map(|part| part * part).sum::<f64>().sqrt();
    let normal = towards_b.map(|part| part / length);
    let approach: f64 = (0..3).map(|axis| (velocity_a[axis] - velocity_b[axis]) * normal[axis]).sum();
    let impulse = (1.0 + restitution) * approach / (inverse_mass_a + inverse_mass_b);
    let change = |velocity: [f64; 3], factor: f64| {
        std::array::from_fn(|axis| velocity[axis] + factor * impulse * normal[axis])
    };
    [change(velocity_a, -inverse_mass_a), change(velocity_b, inverse_mass_b)]
}

/// The time at which a distance that shrinks falls below a value, by bisection.
pub(crate) fn time_of_meeting(distance: impl Fn(f64) -> f64, value: f64, until: f64) -> f64 {
    let (mut apart, mut together) = (0.0, until);
    for _ in 0..60 {
        let middle = (apart + together) / 2.0;
        if distance(middle) > value { apart = middle } else { together = middle }
    }
    apart
}

/// Velocity along X and up of a body of mass 1 that fell on a corner at (`x`, `y`) from its centre and does not
/// bounce: the impulses J up and F along X stop the corner, F within friction.
pub(crate) fn after_fall_on_corner(height: f64, inertia: f64, [x, y]: [f64; 2], friction: f64) -> [f64; 2] {
    let speed = (2.0 * f64::from(GRAVITY) * height).sqrt();
    // Velocity of the corner: up -speed + a J + b F, along X b J + c F.
    let (a, b, c) = (1.0 + x * x / inertia, -x * y / inertia, 1.0 + y * y / inertia);
    let stuck = -b / c;
    let ratio = stuck.clamp(-friction, friction);
    let impulse = speed / (a + b * ratio);
    [ratio * impulse, impulse - speed]
}

/// A point of an object turned clockwise on the screen, X and Y up.
pub(crate) fn turned([x, y]: [f64; 2], rotation: f64) -> [f64; 2] {
    let (sine, cosine) = rotation.sin_cos();
    [x * cosine + y * sine, y * cosine - x * sine]
}
