//! Row of a spring in the iterative solver, integrated with implicit Euler in each substep of h seconds.
//!
//! With stretch x at the start of the substep and its rate u at the end, the impulse is l = -h (k (x + h u) + c u). With K the
//! inverse effective mass, a row with accumulated impulse l changes it by
//!
//! ```text
//! dl = (-s u - h k x - l) / (1 + s K),   s = h (c + h k)
//! ```
//!
//! The row is solved in the phase with bias only, once per substep: the relaxation has no position errors to remove.

use super::soft_law::clamp_symmetric;

/// Row of a damped spring with the impulse l = -s u - h k x: velocity u at the end of a substep of h seconds, stretch x at its
/// start.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ImplicitSpringRow {
    /// Impulse per velocity, s = h (c + h k), >= 0, for stiffness k and damping c: mass units in linear rows, mass units *
    /// length units^2 in angular ones.
    pub(super) impulse_per_velocity: f64,
    /// Impulse h k x of the stretch x at the start of the substep: mass units * length units/s, in angular rows mass units *
    /// length units^2/s.
    pub(super) stretch_impulse: f64,
    /// Accumulated impulse of a substep on body B: mass units * length units/s, in angular rows mass units * length units^2/s.
    pub(super) impulse: f64,
}

impl ImplicitSpringRow {
    /// Solves the row once at the relative velocity `velocity` (length units/s, in angular rows radians/s). Returns the change
    /// of the impulse: mass units * length units/s, in angular rows mass units * length units^2/s.
    ///
    /// `inverse_mass` is the inverse effective mass, and `limit` the largest absolute impulse, >= 0.
    #[inline(always)]
    pub(super) fn solve(&mut self, velocity: f64, inverse_mass: f64, limit: f64) -> f64 {
        let impulse_error = -self.impulse_per_velocity * velocity - self.stretch_impulse - self.impulse;
        let impulse = clamp_symmetric(
            self.impulse + impulse_error / (1.0 + self.impulse_per_velocity * inverse_mass),
            limit,
        );
        impulse - std::mem::replace(&mut self.impulse, impulse)
    }
}

#[cfg(test)]
mod tests {
    use super::ImplicitSpringRow;

    #[test]
    fn a_spring_row_converges_to_implicit_euler_from_any_initial_impulse() {
        let (k, c, x, h, inverse_mass, free) = (900.0, 3.0, 0.7, 1.0 / 240.0, 0.4, -2.0);
        for begun in [0.0, -1.0, 20.0] {
            let mut row = ImplicitSpringRow {
                impulse_per_velocity: h * (c + h * k),
                stretch_impulse: h * k * x,
                impulse: begun,
            };
            // The initial impulse has changed the velocity already, as a warm start does.
            let speed = free + inverse_mass * begun;
            let after = speed + inverse_mass * row.solve(speed, inverse_mass, f64::INFINITY);
            let law = -h * (k * (x + h * after) + c * after);
            assert!((row.impulse - law).abs() < 1e-12, "{} instead of {law}", row.impulse);
        }
    }
}
