//! The arithmetic of one contact: a kernel, kept in one piece and in the original's order of operations.

use super::{PreStepSettings, SolverBody};
use crate::contact::Contact;
use crate::math::scalar::{max, min};

/// What the contacts of two geoms have in common.
#[derive(Debug, Clone, Copy)]
pub(super) struct PairConstants {
    pub(super) friction: f32,
    pub(super) restitution: f32,
}

/// Place of body A among the two bodies of a pair. Body B is at 1, or at 0 as well if it is the same body, which
/// happens when a geom is moved to its partner's body during a contact.
const A: usize = 0;

/// One contact as the solver sees it.
#[derive(Debug, Clone, Copy)]
pub(super) struct ContactRow {
    position: [f32; 2],
    normal: [f32; 2],
    separation: f32,
    /// Offsets of the contact from the two bodies' positions.
    r1: [f32; 2],
    r2: [f32; 2],
    normal_mass: f32,
    tangent_mass: f32,
    /// Velocity with which the overlap is to be undone.
    target_bias: f32,
    bounce_velocity: f32,
    normal_impulse: f32,
    tangent_impulse: f32,
    bias_impulse: f32,
}

#[inline(always)]
fn dot(a: [f32; 2], b: [f32; 2]) -> f32 {
    a[0] * b[0] + a[1] * b[1]
}

#[inline(always)]
fn tangent(n: [f32; 2]) -> [f32; 2] {
    [n[1], -n[0]]
}

#[inline(always)]
fn subtract(a: [f32; 2], b: [f32; 2]) -> [f32; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

/// Velocity of the point at an offset from the centre of mass.
#[inline(always)]
fn velocity_at(velocity: [f32; 3], offset: [f32; 2]) -> [f32; 2] {
    [-velocity[2] * offset[1] + velocity[0], velocity[2] * offset[0] + velocity[1]]
}

/// Adds an impulse at an offset to a velocity.
#[inline(always)]
fn push(
    velocity: &mut [f32; 3],
    impulse: [f32; 2],
    offset: [f32; 2],
    inverse_mass: f32,
    inverse_inertia: f32,
) {
    velocity[0] += impulse[0] * inverse_mass;
    velocity[1] += impulse[1] * inverse_mass;
    velocity[2] += (offset[0] * impulse[1] - offset[1] * impulse[0]) * inverse_inertia;
}

impl ContactRow {
    pub(super) fn new(contact: &Contact) -> Self {
        ContactRow {
            position: [contact.position.x, contact.position.y],
            normal: [contact.normal.x, contact.normal.y],
            separation: contact.separation,
            r1: [0.0; 2],
            r2: [0.0; 2],
            normal_mass: 0.0,
            tangent_mass: 0.0,
            target_bias: 0.0,
            bounce_velocity: 0.0,
            normal_impulse: contact.normal_impulse,
            tangent_impulse: contact.tangent_impulse,
            bias_impulse: 0.0,
        }
    }

    pub(super) fn write_back(&self, contact: &mut Contact) {
        contact.normal_impulse = self.normal_impulse;
        contact.tangent_impulse = self.tangent_impulse;
    }

    pub(super) fn impulses(&self) -> (f32, f32) {
        (self.normal_impulse, self.tangent_impulse)
    }

    pub(super) fn forget_impulses(&mut self) {
        self.normal_impulse = 0.0;
        self.tangent_impulse = 0.0;
        self.bias_impulse = 0.0;
    }

    /// Adds `impulse` to the velocity of B and takes it from A's: B first, as in the original.
    #[inline(always)]
    fn push_pair<const B: usize>(&self, impulse: [f32; 2], bodies: &mut [SolverBody; 2]) {
        let b = &mut bodies[B];
        push(&mut b.velocity, impulse, self.r2, b.inverse_mass, b.inverse_inertia);
        let a = &mut bodies[A];
        push(&mut a.velocity, [-impulse[0], -impulse[1]], self.r1, a.inverse_mass, a.inverse_inertia);
    }

    #[inline(always)]
    fn relative_velocity<const B: usize>(&self, bodies: &[SolverBody; 2]) -> [f32; 2] {
        subtract(velocity_at(bodies[B].velocity, self.r2), velocity_at(bodies[A].velocity, self.r1))
    }

    /// Behaviour chapter 03, section 6.1.
    #[inline(always)]
    pub(super) fn pre_step<const B: usize>(
        &mut self,
        pair: &PairConstants,
        settings: PreStepSettings,
        bodies: &mut [SolverBody; 2],
    ) {
        let n = self.normal;
        let t = tangent(n);
        let (a, b) = (&bodies[A], &bodies[B]);
        self.r1 = subtract(self.position, a.position);
        self.r2 = subtract(self.position, b.position);
        let (rn1, rn2) = (dot(self.r1, n), dot(self.r2, n));
        let (d1, d2) = (dot(self.r1, self.r1), dot(self.r2, self.r2));
        let mass = a.inverse_mass + b.inverse_mass;
        let normal_k = mass + a.inverse_inertia * (d1 - rn1 * rn1) + b.inverse_inertia * (d2 - rn2 * rn2);
        self.normal_mass = 1.0 / normal_k;
        let (rt1, rt2) = (dot(self.r1, t), dot(self.r2, t));
        // The two inertia terms are added first here, unlike above.
        let tangent_k = mass + (a.inverse_inertia * (d1 - rt1 * rt1) + b.inverse_inertia * (d2 - rt2 * rt2));
        self.tangent_mass = 1.0 / tangent_k;
        let excess = min(0.0, settings.allowed_penetration + self.separation);
        self.target_bias = -settings.bias_factor * settings.inverse_dt * excess;
        self.bounce_velocity = dot(self.relative_velocity::<B>(bodies), n) * pair.restitution;
        let impulse = [
            n[0] * self.normal_impulse + t[0] * self.tangent_impulse,
            n[1] * self.normal_impulse + t[1] * self.tangent_impulse,
        ];
        self.push_pair::<B>(impulse, bodies);
        self.bias_impulse = 0.0;
    }

    /// Behaviour chapter 03, section 6.2.
    #[inline(always)]
    pub(super) fn solve<const B: usize>(&mut self, pair: &PairConstants, bodies: &mut [SolverBody; 2]) {
        let n = self.normal;
        let t = tangent(n);

        let normal_speed = dot(self.relative_velocity::<B>(bodies), n);
        let old = self.normal_impulse;
        self.normal_impulse = max(old + self.normal_mass * -(normal_speed + self.bounce_velocity), 0.0);
        let x = self.normal_impulse - old;
        self.push_pair::<B>([n[0] * x, n[1] * x], bodies);

        let bias = subtract(velocity_at(bodies[B].bias, self.r2), velocity_at(bodies[A].bias, self.r1));
        let bias_speed = dot(bias, n);
        let old = self.bias_impulse;
        self.bias_impulse = max(old + self.normal_mass * (-bias_speed + self.target_bias), 0.0);
        let x = self.bias_impulse - old;
        let impulse = [n[0] * x, n[1] * x];
        let b = &mut bodies[B];
        push(&mut b.bias, impulse, self.r2, b.inverse_mass, b.inverse_inertia);
        let a = &mut bodies[A];
        push(&mut a.bias, [-impulse[0], -impulse[1]], self.r1, a.inverse_mass, a.inverse_inertia);

        let limit = pair.friction * self.normal_impulse;
        let tangent_speed = dot(self.relative_velocity::<B>(bodies), t);
        let old = self.tangent_impulse;
        self.tangent_impulse = max(-limit, min(old + self.tangent_mass * -tangent_speed, limit));
        let x = self.tangent_impulse - old;
        self.push_pair::<B>([t[0] * x, t[1] * x], bodies);
    }
}
