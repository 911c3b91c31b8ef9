//! The arithmetic of one contact point in three axes.

use super::PreStep;
use crate::depth::TouchPoint;

/// What the solver reads and changes of a body.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct SpaceBody {
    pub(super) linear: [f32; 3],
    pub(super) angular: [f32; 3],
    /// Velocities that only push overlapping bodies apart; about the depth axis alone.
    pub(super) bias: [f32; 3],
    pub(super) bias_spin: f32,
    pub(super) inverse_mass: f32,
    pub(super) inverse_inertia: [f32; 3],
}

/// One contact point as the solver sees it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    normal: [f32; 3],
    tangents: [[f32; 3]; 2],
    /// Offsets of the point from the two bodies' centres.
    arms: [[f32; 3]; 2],
    normal_mass: f32,
    /// Inverse of the 2 x 2 matrix of the tangents: two diagonal elements and the other one.
    tangent_mass: [f32; 3],
    separation: f32,
    /// Velocity with which the overlap is to be undone.
    target_bias: f32,
    bounce_velocity: f32,
    pub(super) normal_impulse: f32,
    pub(super) friction_impulse: [f32; 2],
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

/// Two unit vectors at right angles to a unit normal and to each other. In the plane the first is the 2D engine's
/// tangent and the second points into the picture.
fn tangents_of(n: [f32; 3]) -> [[f32; 3]; 2] {
    let flat = (n[0] * n[0] + n[1] * n[1]).sqrt();
    let first = if n[2] == 0.0 {
        [n[1], -n[0], 0.0]
    } else if flat > 0.1 {
        [n[1] / flat, -n[0] / flat, 0.0]
    } else {
        // Nearly along the depth axis: the part of the x axis at right angles to it.
        let x = difference([1.0, 0.0, 0.0], scaled(n, n[0]));
        scaled(x, 1.0 / dot(x, x).sqrt())
    };
    let second = if n[2] == 0.0 { [0.0, 0.0, 1.0] } else { cross(first, n) };
    [first, second]
}

impl SpaceBody {
    #[inline(always)]
    pub(super) fn is_finite(&self) -> bool {
        let sum = |v: [f32; 3]| v[0] * 0.0 + v[1] * 0.0 + v[2] * 0.0;
        sum(self.linear) + sum(self.angular) + sum(self.bias) + self.bias_spin * 0.0 == 0.0
    }

    /// Velocity of the point at an offset from the centre of mass.
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
    fn push(&mut self, impulse: [f32; 3], arm: [f32; 3]) {
        let turn = cross(arm, impulse);
        for axis in 0..3 {
            self.linear[axis] += impulse[axis] * self.inverse_mass;
            self.angular[axis] += turn[axis] * self.inverse_inertia[axis];
        }
    }

    #[inline(always)]
    fn push_apart(&mut self, impulse: [f32; 3], arm: [f32; 3]) {
        for (bias, impulse) in self.bias.iter_mut().zip(impulse) {
            *bias += impulse * self.inverse_mass;
        }
        self.bias_spin += (arm[0] * impulse[1] - arm[1] * impulse[0]) * self.inverse_inertia[2];
    }

    /// How much velocity along `a` at an offset an impulse along `b` there makes, but for the inverse mass.
    #[inline(always)]
    fn turning(&self, arm: [f32; 3], a: [f32; 3], b: [f32; 3]) -> f32 {
        let (a, b) = (cross(arm, a), cross(arm, b));
        let i = self.inverse_inertia;
        a[0] * b[0] * i[0] + a[1] * b[1] * i[1] + a[2] * b[2] * i[2]
    }
}

impl Row {
    /// A contact point before the pre-step.
    pub(super) fn new(
        normal: [f32; 3],
        position: [f32; 3],
        centres: [[f32; 3]; 2],
        point: &TouchPoint,
    ) -> Self {
        Row {
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
    fn relative_velocity(&self, bodies: &[SpaceBody; 2]) -> [f32; 3] {
        difference(bodies[B].velocity_at(self.arms[B]), bodies[A].velocity_at(self.arms[A]))
    }

    #[inline(always)]
    fn push_pair(&self, impulse: [f32; 3], bodies: &mut [SpaceBody; 2]) {
        bodies[B].push(impulse, self.arms[B]);
        bodies[A].push(scaled(impulse, -1.0), self.arms[A]);
    }

    /// Inverse of the mass that an impulse along `a` moves along `b`, turning included.
    #[inline(always)]
    fn turning(&self, bodies: &[SpaceBody; 2], a: [f32; 3], b: [f32; 3]) -> f32 {
        bodies[A].turning(self.arms[A], a, b) + bodies[B].turning(self.arms[B], a, b)
    }

    /// Masses and biases, from velocities before any impulse acts.
    ///
    /// `pull` is the velocity that gravity has given in this step, where that does not count for the bounce.
    pub(super) fn prepare(
        &mut self,
        restitution: f32,
        pull: [f32; 3],
        settings: PreStep,
        bodies: &[SpaceBody; 2],
    ) {
        let [first, second] = self.tangents;
        let mass = bodies[A].inverse_mass + bodies[B].inverse_mass;
        self.normal_mass = 1.0 / (mass + self.turning(bodies, self.normal, self.normal));
        let k = [
            mass + self.turning(bodies, first, first),
            mass + self.turning(bodies, second, second),
            self.turning(bodies, first, second),
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
        // What a pull towards the surface has added in this step was not there when it arrived.
        let pulled = dot(pull, self.normal).min(0.0);
        let arrival = if pulled < 0.0 { (speed - pulled).min(0.0) } else { speed };
        self.bounce_velocity = arrival * restitution;
    }

    /// The impulses of the last update act again.
    pub(super) fn warm_start(&self, bodies: &mut [SpaceBody; 2]) {
        let [first, second] = self.tangents;
        let [along, across] = self.friction_impulse;
        let impulse: [f32; 3] = std::array::from_fn(|axis| {
            self.normal[axis] * self.normal_impulse + first[axis] * along + second[axis] * across
        });
        self.push_pair(impulse, bodies);
    }

    /// Normal impulse, and the impulse that undoes overlap.
    #[inline(always)]
    pub(super) fn solve_normal(&mut self, bodies: &mut [SpaceBody; 2]) {
        let speed = dot(self.relative_velocity(bodies), self.normal);
        let old = self.normal_impulse;
        self.normal_impulse = (old - self.normal_mass * (speed + self.bounce_velocity)).max(0.0);
        self.push_pair(scaled(self.normal, self.normal_impulse - old), bodies);

        let bias = difference(bodies[B].bias_at(self.arms[B]), bodies[A].bias_at(self.arms[A]));
        let old = self.bias_impulse;
        self.bias_impulse = (old + self.normal_mass * (self.target_bias - dot(bias, self.normal))).max(0.0);
        let push = scaled(self.normal, self.bias_impulse - old);
        bodies[B].push_apart(push, self.arms[B]);
        bodies[A].push_apart(scaled(push, -1.0), self.arms[A]);
    }

    /// Friction: what would stop the sliding, held within a disc.
    #[inline(always)]
    pub(super) fn solve_friction(&mut self, limit: f32, bodies: &mut [SpaceBody; 2]) {
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
            // It slides. What would stop it is askew to the sliding where one tangent turns the bodies and the other
            // does not; friction acts against the sliding.
            let m = m11.min(m22);
            on_circle([old[0] - m * slip[0], old[1] - m * slip[1]], limit)
        };
        let change = [self.friction_impulse[0] - old[0], self.friction_impulse[1] - old[1]];
        let impulse = std::array::from_fn(|axis| first[axis] * change[0] + second[axis] * change[1]);
        self.push_pair(impulse, bodies);
    }
}

/// The nearest point of a circle; the origin where that is all of them.
#[inline(always)]
fn on_circle([x, y]: [f32; 2], radius: f32) -> [f32; 2] {
    let length = (x * x + y * y).sqrt();
    if length == 0.0 {
        return [0.0; 2];
    }
    let factor = radius / length;
    [x * factor, y * factor]
}

/// A face along Z: the bodies do not turn about the other axes, so one normal impulse does for all of its
/// points, and each bears an equal part.
pub(super) fn solve_shared(rows: &mut [Row], friction: f32, bodies: &mut [SpaceBody; 2]) {
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
