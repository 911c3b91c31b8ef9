//! Closed forms that take more than a line of code.

use measure::scenes::depth::GRAVITY;

/// Returns the velocities of two bodies A and B after a hit, px/s. Each body has a velocity before it (px/s) and an inverse
/// mass, 0 for a static one. `towards_b` is the direction from A to B.
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

/// Returns the time, in s, at which a shrinking distance falls below `value` px. Uses bisection from 0 to `until` s.
pub(crate) fn time_of_meeting(distance: impl Fn(f64) -> f64, value: f64, until: f64) -> f64 {
    let (mut apart, mut together) = (0.0, until);
    for _ in 0..60 {
        let middle = (apart + together) / 2.0;
        if distance(middle) > value { apart = middle } else { together = middle }
    }
    apart
}

/// Returns the velocity along X and up, in px/s, of a body of mass 1 after it fell by `height` px on a corner, without a
/// bounce. The corner is at (`x`, `y`) px from the centre. The impulses J up and F along X stop the corner, with F within the
/// friction limit.
pub(crate) fn after_fall_on_corner(height: f64, inertia: f64, [x, y]: [f64; 2], friction: f64) -> [f64; 2] {
    let speed = (2.0 * f64::from(GRAVITY) * height).sqrt();
    // With impulses J and F the corner has the velocity -speed + a J + b F upwards, and b J + c F along X.
    let (a, b, c) = (1.0 + x * x / inertia, -x * y / inertia, 1.0 + y * y / inertia);
    let stuck = -b / c;
    let ratio = stuck.clamp(-friction, friction);
    let impulse = speed / (a + b * ratio);
    [ratio * impulse, impulse - speed]
}

/// Returns a point of an object (px, X and Y up, from its centre) after a clockwise `rotation` on the screen, radians.
pub(crate) fn turned([x, y]: [f64; 2], rotation: f64) -> [f64; 2] {
    let (sine, cosine) = rotation.sin_cos();
    [x * cosine + y * sine, y * cosine - x * sine]
}
