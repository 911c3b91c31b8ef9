//! Inertia and momentum of a body and the subtree below it, about a point, for the articulated-body algorithm.

use super::vec2::{Vec2, add_scaled, cross, dot, perp};

/// A symmetric 2x2 matrix.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct SymMat2 {
    xx: f64,
    xy: f64,
    yy: f64,
}

impl SymMat2 {
    /// Returns the product of the matrix and the vector `v`.
    #[inline(always)]
    pub(super) fn mul_vec(&self, v: Vec2) -> Vec2 {
        [self.xx * v[0] + self.xy * v[1], self.xy * v[0] + self.yy * v[1]]
    }

    /// Returns self + s v v^T.
    #[inline(always)]
    pub(super) fn with_outer_product(&self, v: Vec2, s: f64) -> Self {
        SymMat2 {
            xx: self.xx + s * v[0] * v[0],
            xy: self.xy + s * v[0] * v[1],
            yy: self.yy + s * v[1] * v[1],
        }
    }

    /// Returns the solution x of self x = v.
    #[inline(always)]
    pub(super) fn solve(&self, v: Vec2) -> Vec2 {
        let inverse = 1.0 / (self.xx * self.yy - self.xy * self.xy);
        [(self.yy * v[0] - self.xy * v[1]) * inverse, (self.xx * v[1] - self.xy * v[0]) * inverse]
    }
}

/// Articulated inertia [A c; c^T d] of a body and the subtree below it, about a point. It maps the velocity of the point and
/// the angular velocity to momentum.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ArticulatedInertia {
    /// Block A of the articulated inertia [A c; c^T d]: inertia against translation of the point. Unit: mass units.
    pub(super) mass: SymMat2,
    /// Block c of the articulated inertia [A c; c^T d]: linear momentum per unit of angular velocity. Unit: mass units * length
    /// units.
    pub(super) coupling: Vec2,
    /// Element d of the articulated inertia [A c; c^T d]: inertia against rotation about the point. Unit: mass units * length
    /// units^2.
    pub(super) rotational: f64,
}

/// Momentum of a body and the subtree below it, about the point of the body's [`ArticulatedInertia`].
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ArticulatedMomentum {
    /// Linear momentum along x and y. Unit: mass units * length units/s.
    pub(super) linear: Vec2,
    /// Angular momentum of the body and the subtree about the point. Unit: mass units * length units^2/s.
    pub(super) angular: f64,
}

impl ArticulatedInertia {
    /// Returns the inertia of a single body about a point. `arm` leads from the body's centre of mass to the point, in length
    /// units.
    #[inline(always)]
    pub(super) fn of_body(mass: f64, inertia: f64, arm: Vec2) -> Self {
        let p = perp(arm);
        ArticulatedInertia {
            mass: SymMat2 { xx: mass, xy: 0.0, yy: mass },
            coupling: [-mass * p[0], -mass * p[1]],
            rotational: inertia + mass * dot(p, p),
        }
    }

    /// Adds the inertia `other`, which refers to another point. `arm` leads from the point of `self` to the point of `other`,
    /// in length units.
    #[inline(always)]
    pub(super) fn add_at(&mut self, other: &ArticulatedInertia, arm: Vec2) {
        let p = perp(arm);
        self.add_point_mass(&other.mass, arm);
        self.coupling = add_scaled(self.coupling, other.coupling, 1.0);
        self.rotational += other.rotational + 2.0 * dot(other.coupling, p);
    }

    /// Adds the inertia of a point that resists translation only. `arm` leads from the point of `self` to that point, in length
    /// units.
    #[inline(always)]
    pub(super) fn add_point_mass(&mut self, mass: &SymMat2, arm: Vec2) {
        let p = perp(arm);
        let moved = mass.mul_vec(p);
        self.mass.xx += mass.xx;
        self.mass.xy += mass.xy;
        self.mass.yy += mass.yy;
        self.coupling = add_scaled(self.coupling, moved, 1.0);
        self.rotational += dot(moved, p);
    }

    /// Returns the velocity of a body with this inertia and momentum that no joint holds: x and y in length units/s, angular in
    /// radians/s.
    #[inline(always)]
    pub(super) fn unconstrained_velocity(&self, momentum: &ArticulatedMomentum) -> [f64; 3] {
        let (inertia, twist) = self.eliminate_translation(momentum);
        let spin = twist / inertia;
        let [x, y] = self.mass.solve(add_scaled(momentum.linear, self.coupling, -spin));
        [x, y, spin]
    }

    /// Returns the inertia that remains when the point may slide freely along the unit vector `direction` (Schur complement).
    #[inline(always)]
    pub(super) fn eliminate_slide(&self, direction: Vec2) -> ArticulatedInertia {
        let moved = self.mass.mul_vec(direction);
        let (inverse, coupled) = (1.0 / dot(direction, moved), dot(self.coupling, direction));
        ArticulatedInertia {
            mass: self.mass.with_outer_product(moved, -inverse),
            coupling: add_scaled(self.coupling, moved, -coupled * inverse),
            rotational: self.rotational - coupled * coupled * inverse,
        }
    }

    /// Returns the momentum that remains of `linear` and `angular` beyond that of the velocity `target` relative to the parent: x
    /// and y in length units/s, angular in radians/s.
    #[inline(always)]
    pub(super) fn remaining_momentum(
        &self,
        (linear, angular): (Vec2, f64),
        [x, y, spin]: [f64; 3],
    ) -> ArticulatedMomentum {
        let linear = add_scaled(linear, self.mass.mul_vec([x, y]), -1.0);
        ArticulatedMomentum {
            linear: add_scaled(linear, self.coupling, -spin),
            angular: angular - dot(self.coupling, [x, y]) - self.rotational * spin,
        }
    }

    /// Returns the rotational inertia (mass units * length units^2) and the angular momentum (mass units * length units^2/s)
    /// that remain when the point may translate freely (Schur complement).
    #[inline(always)]
    pub(super) fn eliminate_translation(&self, momentum: &ArticulatedMomentum) -> (f64, f64) {
        let weighed = self.mass.solve(self.coupling);
        (self.rotational - dot(self.coupling, weighed), momentum.angular - dot(weighed, momentum.linear))
    }
}

impl ArticulatedMomentum {
    /// Returns the momentum of a single body about a point. `arm` leads from the body's centre of mass to the point. The
    /// velocity is that of the centre of mass: x and y in length units/s, angular in radians/s.
    #[inline(always)]
    pub(super) fn of_body(mass: f64, inertia: f64, arm: Vec2, [x, y, spin]: [f64; 3]) -> Self {
        let along = [mass * x, mass * y];
        ArticulatedMomentum { linear: along, angular: inertia * spin - cross(arm, along) }
    }

    /// Adds the linear momentum `linear` that acts at the end of `arm`, and the angular momentum `angular`.
    #[inline(always)]
    pub(super) fn add_at(&mut self, linear: Vec2, angular: f64, arm: Vec2) {
        self.linear = add_scaled(self.linear, linear, 1.0);
        self.angular += angular + cross(arm, linear);
    }
}
