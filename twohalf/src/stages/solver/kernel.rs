//! Arithmetic of one contact point in three axes: effective masses, warm start, normal impulse and friction.

use super::PreStep;
use crate::depth::ContactPoint;

/// Velocities and inverse masses of a body in the solver.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct SolverBody3 {
    /// Linear velocity, px/s.
    pub(super) linear: [f32; 3],
    /// Angular velocity, radians/s.
    pub(super) angular: [f32; 3],
    /// Bias velocity that only resolves penetration, px/s; its rotation is about the depth axis alone.
    pub(super) bias: [f32; 3],
    /// Angular bias velocity about the depth axis, radians/s.
    pub(super) bias_spin: f32,
    /// Inverse mass, 1/mass.
    pub(super) inverse_mass: f32,
    /// Inverse moments of inertia, 1/(mass · px²).
    pub(super) inverse_inertia: [f32; 3],
}

/// Constraint of one contact point: arms, effective masses, target velocities and accumulated impulses.
#[derive(Debug, Clone, Copy)]
pub(super) struct ContactPointConstraint {
    normal: [f32; 3],
    tangents: [[f32; 3]; 2],
    /// Lever arms: offsets of the point from the centres of mass, px.
    arms: [[f32; 3]; 2],
    /// Effective mass along the normal, mass units.
    normal_mass: f32,
    /// Effective mass along the tangents, mass units: inverse of a symmetric 2 x 2 matrix as two diagonal
    /// elements and the off-diagonal one.
    tangent_mass: [f32; 3],
    /// Separation in px; negative is penetration.
    separation: f32,
    /// Bias velocity that resolves the penetration, px/s (Baumgarte stabilisation).
    target_bias: f32,
    /// Approach velocity times restitution, px/s, 0 or less.
    bounce_velocity: f32,
    /// Accumulated normal impulse, mass · px/s.
    pub(super) normal_impulse: f32,
    /// Accumulated friction impulses along the tangents, mass · px/s.
    pub(super) friction_impulse: [f32; 2],
    /// Accumulated bias impulse, mass · px/s.
    bias_impulse: f32,
}

const A: usize = 0;
const B: usize = 1;

#[inline(always)]
fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn difference(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
fn scaled(a: [f32; 3], factor: f32) -> [f32; 3] {
    [a[0] * factor, a[1] * factor, a[2] * factor]
}

/// Two unit vectors orthogonal to a unit normal and to each other. In the plane the first is the core's
/// tangent and the second points into the picture.
fn tangents_of(n: [f32; 3]) -> [[f32; 3]; 2] {
    let flat = (n[0] * n[0] + n[1] * n[1]).sqrt();
    let first = if n[2] == 0.0 {
        [n[1], -n[0], 0.0]
    } else if flat > 0.1 {
        [n[1] / flat, -n[0] / flat, 0.0]
    } else {
        // Nearly along the depth axis: the component of the x axis orthogonal to the normal.
        let x = difference([1.0, 0.0, 0.0], scaled(n, n[0]));
        scaled(x, 1.0 / dot(x, x).sqrt())
    };
    let second = if n[2] == 0.0 { [0.0, 0.0, 1.0] } else { cross(first, n) };
    [first, second]
}

impl SolverBody3 {
    #[inline(always)]
    pub(super) fn is_finite(&self) -> bool {
        let sum = |v: [f32; 3]| v[0] * 0.0 + v[1] * 0.0 + v[2] * 0.0;
        sum(self.linear) + sum(self.angular) + sum(self.bias) + self.bias_spin * 0.0 == 0.0
    }

    /// Returns the velocity of the point of the body at the offset `arm` from its centre of mass, px/s.
    #[inline(always)]
    fn velocity_at(&self, arm: [f32; 3]) -> [f32; 3] {
        let turn = cross(self.angular, arm);
        [self.linear[0] + turn[0], self.linear[1] + turn[1], self.linear[2] + turn[2]]
    }

    #[inline(always)]
    fn bias_at(&self, arm: [f32; 3]) -> [f32; 3] {
        [self.bias[0] - self.bias_spin * arm[1], self.bias[1] + self.bias_spin * arm[0], self.bias[2]]
    }

    #[inline(always)]
    fn apply_impulse(&mut self, impulse: [f32; 3], arm: [f32; 3]) {
        let turn = cross(arm, impulse);
        for axis in 0..3 {
            self.linear[axis] += impulse[axis] * self.inverse_mass;
            self.angular[axis] += turn[axis] * self.inverse_inertia[axis];
        }
    }

    #[inline(always)]
    fn apply_bias_impulse(&mut self, impulse: [f32; 3], arm: [f32; 3]) {
        for (bias, impulse) in self.bias.iter_mut().zip(impulse) {
            *bias += impulse * self.inverse_mass;
        }
        self.bias_spin += (arm[0] * impulse[1] - arm[1] * impulse[0]) * self.inverse_inertia[2];
    }

    /// Returns the velocity along `a` that a unit impulse along `b` causes by rotation alone, both at the offset `arm`, 1/mass:
    /// an element of the inverse effective mass.
    #[inline(always)]
    fn angular_coupling(&self, arm: [f32; 3], a: [f32; 3], b: [f32; 3]) -> f32 {
        let (a, b) = (cross(arm, a), cross(arm, b));
        let i = self.inverse_inertia;
        a[0] * b[0] * i[0] + a[1] * b[1] * i[1] + a[2] * b[2] * i[2]
    }
}

impl ContactPointConstraint {
    /// Returns the constraint of a contact point with arms and separation, before `prepare` computes the rest.
    pub(super) fn new(
        normal: [f32; 3],
        position: [f32; 3],
        centres: [[f32; 3]; 2],
        point: &ContactPoint,
    ) -> Self {
        ContactPointConstraint {
            normal,
            tangents: tangents_of(normal),
            arms: centres.map(|centre| difference(position, centre)),
            normal_mass: 0.0,
            tangent_mass: [0.0; 3],
            separation: point.separation,
            target_bias: 0.0,
            bounce_velocity: 0.0,
            normal_impulse: point.normal_impulse,
            friction_impulse: point.friction_impulse,
            bias_impulse: 0.0,
        }
    }

    #[inline(always)]
    fn relative_velocity(&self, bodies: &[SolverBody3; 2]) -> [f32; 3] {
        difference(bodies[B].velocity_at(self.arms[B]), bodies[A].velocity_at(self.arms[A]))
    }

    #[inline(always)]
    fn apply_impulse_pair(&self, impulse: [f32; 3], bodies: &mut [SolverBody3; 2]) {
        bodies[B].apply_impulse(impulse, self.arms[B]);
        bodies[A].apply_impulse(scaled(impulse, -1.0), self.arms[A]);
    }

    /// Returns the rotational part of the inverse effective mass of both bodies, 1/mass, for an impulse along `a` and a
    /// velocity along `b`.
    #[inline(always)]
    fn angular_coupling(&self, bodies: &[SolverBody3; 2], a: [f32; 3], b: [f32; 3]) -> f32 {
        bodies[A].angular_coupling(self.arms[A], a, b) + bodies[B].angular_coupling(self.arms[B], a, b)
    }

    /// Computes effective masses, bias and bounce from the velocities before the warm start.
    ///
    /// `pull` is the relative velocity that gravity has added in this step, px/s, where it does not count for
    /// the bounce.
    pub(super) fn prepare(
        &mut self,
        restitution: f32,
        pull: [f32; 3],
        settings: PreStep,
        bodies: &[SolverBody3; 2],
    ) {
        let [first, second] = self.tangents;
        let mass = bodies[A].inverse_mass + bodies[B].inverse_mass;
        self.normal_mass = 1.0 / (mass + self.angular_coupling(bodies, self.normal, self.normal));
        let k = [
            mass + self.angular_coupling(bodies, first, first),
            mass + self.angular_coupling(bodies, second, second),
            self.angular_coupling(bodies, first, second),
        ];
        self.tangent_mass = if k[2] == 0.0 {
            [1.0 / k[0], 1.0 / k[1], 0.0]
        } else {
            let determinant = k[0] * k[1] - k[2] * k[2];
            [k[1] / determinant, k[0] / determinant, -k[2] / determinant]
        };
        let excess = (settings.slop + self.separation).min(0.0);
        self.target_bias = -settings.bias_factor * settings.inverse_dt * excess;
        let speed = dot(self.relative_velocity(bodies), self.normal);
        // The approach velocity is that without the gravity of this step.
        let pulled = dot(pull, self.normal).min(0.0);
        let arrival = if pulled < 0.0 { (speed - pulled).min(0.0) } else { speed };
        self.bounce_velocity = arrival * restitution;
    }

    /// Applies the accumulated impulses of the last update (warm start).
    pub(super) fn warm_start(&self, bodies: &mut [SolverBody3; 2]) {
        let [first, second] = self.tangents;
        let [along, across] = self.friction_impulse;
        let impulse: [f32; 3] = std::array::from_fn(|axis| {
            self.normal[axis] * self.normal_impulse + first[axis] * along + second[axis] * across
        });
        self.apply_impulse_pair(impulse, bodies);
    }

    /// Solves the normal impulse, and the bias impulse that resolves penetration.
    #[inline(always)]
    pub(super) fn solve_normal(&mut self, bodies: &mut [SolverBody3; 2]) {
        let speed = dot(self.relative_velocity(bodies), self.normal);
        let old = self.normal_impulse;
        self.normal_impulse = (old - self.normal_mass * (speed + self.bounce_velocity)).max(0.0);
        self.apply_impulse_pair(scaled(self.normal, self.normal_impulse - old), bodies);

        let bias = difference(bodies[B].bias_at(self.arms[B]), bodies[A].bias_at(self.arms[A]));
        let old = self.bias_impulse;
        self.bias_impulse = (old + self.normal_mass * (self.target_bias - dot(bias, self.normal))).max(0.0);
        let push = scaled(self.normal, self.bias_impulse - old);
        bodies[B].apply_bias_impulse(push, self.arms[B]);
        bodies[A].apply_bias_impulse(scaled(push, -1.0), self.arms[A]);
    }

    /// Solves friction along both tangents as one block, clamped to a disc (Coulomb's law).
    #[inline(always)]
    pub(super) fn solve_friction(&mut self, limit: f32, bodies: &mut [SolverBody3; 2]) {
        let limit = limit.max(0.0);
        let [first, second] = self.tangents;
        let velocity = self.relative_velocity(bodies);
        let slip = [dot(velocity, first), dot(velocity, second)];
        let [m11, m22, m12] = self.tangent_mass;
        let old = self.friction_impulse;
        let wanted = [old[0] - (m11 * slip[0] + m12 * slip[1]), old[1] - (m22 * slip[1] + m12 * slip[0])];
        self.friction_impulse = if wanted[1] == 0.0 && slip[1] == 0.0 {
            [wanted[0].clamp(-limit, limit), wanted[1]]
        } else if wanted[0] * wanted[0] + wanted[1] * wanted[1] <= limit * limit {
            wanted
        } else {
            // The contact slides. The block solution is not parallel to the sliding if rotation couples with
            // one tangent only; friction must oppose the sliding.
            let m = m11.min(m22);
            on_circle([old[0] - m * slip[0], old[1] - m * slip[1]], limit)
        };
        let change = [self.friction_impulse[0] - old[0], self.friction_impulse[1] - old[1]];
        let impulse = std::array::from_fn(|axis| first[axis] * change[0] + second[axis] * change[1]);
        self.apply_impulse_pair(impulse, bodies);
    }
}

/// Returns the nearest point on a circle about the origin; the origin for the origin itself.
#[inline(always)]
fn on_circle([x, y]: [f32; 2], radius: f32) -> [f32; 2] {
    let length = (x * x + y * y).sqrt();
    if length == 0.0 {
        return [0.0; 2];
    }
    let factor = radius / length;
    [x * factor, y * factor]
}

/// Solves the contact points of two faces that touch along Z. The bodies do not rotate about the other axes, so all points
/// share one normal impulse in equal parts.
pub(super) fn solve_shared(
    rows: &mut [ContactPointConstraint],
    friction: f32,
    bodies: &mut [SolverBody3; 2],
) {
    let share = 1.0 / rows.len() as f32;
    let Some((first, _)) = rows.split_first_mut() else { return };
    let mut whole = *first;
    whole.normal_impulse = rows.iter().map(|row| row.normal_impulse).sum();
    whole.bias_impulse = rows.iter().map(|row| row.bias_impulse).sum();
    whole.solve_normal(bodies);
    let limit = friction * whole.normal_impulse * share;
    for row in rows {
        row.normal_impulse = whole.normal_impulse * share;
        row.bias_impulse = whole.bias_impulse * share;
        row.solve_friction(limit, bodies);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tangents_are_unit_vectors_at_right_angles() {
        let third = 1.0 / 3.0_f32.sqrt();
        for n in [[0.0, -1.0, 0.0], [0.6, 0.8, 0.0], [0.0, 0.0, -1.0], [third; 3], [0.05, 0.0, 0.998_749]] {
            let [a, b] = tangents_of(n);
            // Unit within the rounding of the normals given.
            for (value, expected) in
                [(dot(a, a), 1.0), (dot(b, b), 1.0), (dot(a, b), 0.0), (dot(a, n), 0.0), (dot(b, n), 0.0)]
            {
                assert!((value - expected).abs() < 1e-5, "{n:?}: {value} is not {expected}");
            }
        }
    }

    #[test]
    fn the_nearest_point_of_a_circle_lies_in_the_same_direction() {
        assert_eq!(on_circle([3.0, 4.0], 2.5), [1.5, 2.0]);
        assert_eq!(on_circle([0.3, 0.4], 5.0), [3.0, 4.0]);
        assert_eq!(on_circle([0.0, 0.0], 5.0), [0.0, 0.0]);
    }
}
