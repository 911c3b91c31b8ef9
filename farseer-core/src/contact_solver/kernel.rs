//! Solver kernel for one contact: pre-step with warm start, then normal impulse, bias impulse and friction (E. Catto,
//! "Iterative Dynamics with Temporal Coherence", 2005). All in one file and in the original's order of operations
//! (behaviour chapter 03, section 6).

use super::PreStepSettings;
use super::lanes::Lanes;

/// Velocities and inverse masses of a body, or of one body per lane.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct BodyLanes<T> {
    /// Linear velocity in length units/s and angular velocity in rad/s.
    pub(super) velocity: [T; 3],
    /// Linear and angular bias velocity, which only separates overlapping bodies.
    pub(super) bias: [T; 3],
    pub(super) inverse_mass: T,
    pub(super) inverse_inertia: T,
}

impl<T: Lanes> BodyLanes<T> {
    /// Zero if all velocities are finite, else NaN.
    #[inline(always)]
    pub(super) fn zero_if_finite(&self) -> T {
        let zero = T::splat(0.0);
        let [x, y, w] = self.velocity;
        let [bias_x, bias_y, bias_w] = self.bias;
        x * zero + y * zero + w * zero + (bias_x * zero + bias_y * zero + bias_w * zero)
    }
}

/// Surface properties that the contacts of two geoms share.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct PairConstants<T> {
    pub(super) friction: T,
    pub(super) restitution: T,
    /// Target of friction: tangential speed of B relative to A, in length units/s.
    pub(super) tangent_speed: T,
}

/// Index of body A among the two bodies of a pair. Body B has index 1, or 0 as well if it is the same body. That
/// happens when a geom is moved to the body of the other geom during a contact.
const A: usize = 0;

/// One contact as rows of the solver: normal, bias and friction. Impulses are in mass units · length units/s.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ContactRow<T> {
    pub(super) normal: [T; 2],
    /// Offsets of the contact from the positions of the two bodies, in length units.
    pub(super) r1: [T; 2],
    pub(super) r2: [T; 2],
    pub(super) normal_mass: T,
    pub(super) tangent_mass: T,
    pub(super) separation: T,
    /// Target of the bias velocity along the normal, in length units/s: resolves part of the penetration in this
    /// update.
    pub(super) target_bias: T,
    pub(super) bounce_velocity: T,
    pub(super) normal_impulse: T,
    pub(super) tangent_impulse: T,
    pub(super) bias_impulse: T,
}

#[inline(always)]
fn dot<T: Lanes>(a: [T; 2], b: [T; 2]) -> T {
    a[0] * b[0] + a[1] * b[1]
}

#[inline(always)]
fn tangent<T: Lanes>(n: [T; 2]) -> [T; 2] {
    [n[1], -n[0]]
}

#[inline(always)]
fn subtract<T: Lanes>(a: [T; 2], b: [T; 2]) -> [T; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

/// Velocity of the point at an offset from the centre of mass.
#[inline(always)]
fn velocity_at<T: Lanes>(velocity: [T; 3], offset: [T; 2]) -> [T; 2] {
    [-velocity[2] * offset[1] + velocity[0], velocity[2] * offset[0] + velocity[1]]
}

/// Velocity of a body after an impulse at an offset.
#[inline(always)]
fn velocity_after_impulse<T: Lanes>(
    v: [T; 3],
    impulse: [T; 2],
    offset: [T; 2],
    inverse_mass: T,
    inverse_inertia: T,
) -> [T; 3] {
    [
        v[0] + impulse[0] * inverse_mass,
        v[1] + impulse[1] * inverse_mass,
        v[2] + (offset[0] * impulse[1] - offset[1] * impulse[0]) * inverse_inertia,
    ]
}

impl<T: Lanes> ContactRow<T> {
    /// Applies `impulse` to B and its opposite to A: B first, as in the original.
    #[inline(always)]
    fn apply_impulse<const B: usize>(&self, impulse: [T; 2], bodies: &mut [BodyLanes<T>; 2]) {
        let b = &mut bodies[B];
        b.velocity = velocity_after_impulse(b.velocity, impulse, self.r2, b.inverse_mass, b.inverse_inertia);
        let a = &mut bodies[A];
        a.velocity = velocity_after_impulse(
            a.velocity,
            [-impulse[0], -impulse[1]],
            self.r1,
            a.inverse_mass,
            a.inverse_inertia,
        );
    }

    #[inline(always)]
    fn apply_bias_impulse<const B: usize>(&self, impulse: [T; 2], bodies: &mut [BodyLanes<T>; 2]) {
        let b = &mut bodies[B];
        b.bias = velocity_after_impulse(b.bias, impulse, self.r2, b.inverse_mass, b.inverse_inertia);
        let a = &mut bodies[A];
        a.bias = velocity_after_impulse(
            a.bias,
            [-impulse[0], -impulse[1]],
            self.r1,
            a.inverse_mass,
            a.inverse_inertia,
        );
    }

    #[inline(always)]
    fn relative_velocity<const B: usize>(&self, bodies: &[BodyLanes<T>; 2]) -> [T; 2] {
        subtract(velocity_at(bodies[B].velocity, self.r2), velocity_at(bodies[A].velocity, self.r1))
    }

    /// Pre-step: effective masses, bias and the warm start (section 6.1). The offsets must have been set.
    #[inline(always)]
    pub(super) fn pre_step<const B: usize>(
        &mut self,
        pair: &PairConstants<T>,
        settings: PreStepSettings,
        bodies: &mut [BodyLanes<T>; 2],
    ) {
        let n = self.normal;
        let t = tangent(n);
        let (a, b) = (&bodies[A], &bodies[B]);
        let (rn1, rn2) = (dot(self.r1, n), dot(self.r2, n));
        let (d1, d2) = (dot(self.r1, self.r1), dot(self.r2, self.r2));
        let mass = a.inverse_mass + b.inverse_mass;
        let normal_k = mass + a.inverse_inertia * (d1 - rn1 * rn1) + b.inverse_inertia * (d2 - rn2 * rn2);
        self.normal_mass = T::splat(1.0) / normal_k;
        let (rt1, rt2) = (dot(self.r1, t), dot(self.r2, t));
        // The two inertia terms are added first here, unlike above.
        let tangent_k = mass + (a.inverse_inertia * (d1 - rt1 * rt1) + b.inverse_inertia * (d2 - rt2 * rt2));
        self.tangent_mass = T::splat(1.0) / tangent_k;
        let excess = T::splat(0.0).or_smaller(T::splat(settings.allowed_penetration) + self.separation);
        self.target_bias = T::splat(-settings.bias_factor * settings.inverse_dt) * excess;
        self.bounce_velocity = dot(self.relative_velocity::<B>(bodies), n) * pair.restitution;
        let impulse = [
            n[0] * self.normal_impulse + t[0] * self.tangent_impulse,
            n[1] * self.normal_impulse + t[1] * self.tangent_impulse,
        ];
        self.apply_impulse::<B>(impulse, bodies);
        self.bias_impulse = T::splat(0.0);
    }

    /// One iteration: normal impulse, bias impulse and friction impulse, each accumulated and clamped (section 6.2).
    #[inline(always)]
    pub(super) fn solve<const B: usize>(&mut self, pair: &PairConstants<T>, bodies: &mut [BodyLanes<T>; 2]) {
        let zero = T::splat(0.0);
        let n = self.normal;
        let t = tangent(n);

        let normal_speed = dot(self.relative_velocity::<B>(bodies), n);
        let old = self.normal_impulse;
        self.normal_impulse =
            (old + self.normal_mass * -(normal_speed + self.bounce_velocity)).or_greater(zero);
        let x = self.normal_impulse - old;
        self.apply_impulse::<B>([n[0] * x, n[1] * x], bodies);

        let bias = subtract(velocity_at(bodies[B].bias, self.r2), velocity_at(bodies[A].bias, self.r1));
        let bias_speed = dot(bias, n);
        let old = self.bias_impulse;
        self.bias_impulse = (old + self.normal_mass * (-bias_speed + self.target_bias)).or_greater(zero);
        let x = self.bias_impulse - old;
        self.apply_bias_impulse::<B>([n[0] * x, n[1] * x], bodies);

        let limit = pair.friction * self.normal_impulse;
        let tangent_speed = dot(self.relative_velocity::<B>(bodies), t);
        let old = self.tangent_impulse;
        // With a target speed of 0 this subtracts 0, which changes no bit.
        let wanted = old + self.tangent_mass * -(tangent_speed - pair.tangent_speed);
        self.tangent_impulse = (-limit).or_greater(wanted.or_smaller(limit));
        let x = self.tangent_impulse - old;
        self.apply_impulse::<B>([t[0] * x, t[1] * x], bodies);
    }
}
