//! The two bodies of a spring in the iterative solver: relative pose, Jacobian and velocity changes by impulses.

use super::super::bodies::{BodySet, MotionState};
use super::super::direct_solver::constraint::Jacobian;
use super::super::direct_solver::joint::ANGLE;
use super::super::direct_solver::mat3::Vec3;
use super::frame::JointFrame;
use super::joint_constraint::JointAnchor;
use crate::index::{BodyIndex, DenseIndex};

/// Bodies A and B of a spring. Impulses are those of one substep on B, in the rows of [`JointFrame::jacobian`]: along the
/// normal, of the angle, along the tangent.
#[derive(Debug, Clone, Copy)]
pub(super) struct SpringBodyPair {
    /// Indices of A and B in [`BodySet::states`]; 0 for bodies without a velocity.
    bodies: [BodyIndex; 2],
    /// For A and B: inverse mass, 1/(mass units), and inverse moment of inertia, 1/(mass units * length units^2); 0 for bodies
    /// that are not dynamic.
    inverses: [[f64; 2]; 2],
    /// Relative pose of the two bodies.
    pub(super) frame: JointFrame,
    /// Jacobian of the spring's rows at the pose of `frame`.
    pub(super) jacobian: Jacobian,
}

impl SpringBodyPair {
    pub(super) fn new(anchors: &[JointAnchor; 2], frame: JointFrame, bodies: &BodySet) -> Self {
        let is_listed = |pose: BodyIndex| pose.position() < bodies.states.len();
        SpringBodyPair {
            bodies: [0, 1]
                .map(|side| anchors[side].pose_body)
                .map(|pose| if is_listed(pose) { pose } else { BodyIndex::PLACEHOLDER }),
            inverses: [0, 1].map(|side| match anchors[side].body {
                BodyIndex::PLACEHOLDER => [0.0; 2],
                body => bodies.inverse_mass_inertia[body].map(f64::from),
            }),
            frame,
            jacobian: frame.jacobian(),
        }
    }

    /// Returns the velocities of A and B in the world: x and y in length units/s, angular in radians/s.
    #[inline(always)]
    pub(super) fn velocities(&self, states: &[MotionState]) -> [Vec3; 2] {
        self.bodies.map(|body| {
            let [x, y, spin, _] = states[body.position()].velocity.map(f64::from);
            [x, y, spin]
        })
    }

    /// Stores the velocities of A and B in `states`, for the dynamic ones: x and y in length units/s, angular in radians/s.
    #[inline(always)]
    pub(super) fn store_velocities(&self, states: &mut [MotionState], velocities: [Vec3; 2]) {
        for (side, [x, y, spin]) in velocities.into_iter().enumerate() {
            if self.is_movable(side) {
                let velocity = &mut states[self.bodies[side].position()].velocity;
                (velocity[0], velocity[1], velocity[2]) = (x as f32, y as f32, spin as f32);
            }
        }
    }

    #[inline(always)]
    fn is_movable(&self, side: usize) -> bool {
        self.inverses[side] != [0.0; 2]
    }

    /// Returns the inverse moments of inertia of A and B, 1/(mass units * length units^2).
    pub(super) fn inverse_inertias(&self) -> [f64; 2] {
        self.inverses.map(|[_, inertia]| inertia)
    }

    /// Returns the moment of inertia of the body on `side` (0: A, 1: B) about a point, mass units * length units^2 (parallel
    /// axis theorem).
    ///
    /// `squared_distance` is the square of the point's distance from the centre of mass, length units^2. The result is infinite
    /// for bodies that do not rotate or do not move.
    pub(super) fn inertia_about(&self, side: usize, squared_distance: f64) -> f64 {
        let [mass, inertia] = self.inverses[side].map(f64::recip);
        inertia + if squared_distance > 0.0 { mass * squared_distance } else { 0.0 }
    }

    /// Returns K = J M^-1 J^T of the rows along the normal, of the angle and along the tangent, the inverse of the effective
    /// mass: 1/(mass units), 1/(mass units * length units^2) for the angle.
    pub(super) fn inverse_effective_mass(&self) -> [Vec3; 3] {
        let ([[mass_a, inertia_a], [mass_b, inertia_b]], Jacobian { angular_a: a, angular_b: b, .. }) =
            (self.inverses, self.jacobian);
        std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let linear = if i == j && i != ANGLE { mass_a + mass_b } else { 0.0 };
                linear + inertia_a * a[i] * a[j] + inertia_b * b[i] * b[j]
            })
        })
    }

    /// Returns the velocity changes M^-1 J^T l of A and B by the impulses l of the rows: x and y in length units/s, angular in
    /// radians/s.
    #[inline(always)]
    pub(super) fn velocity_changes(&self, impulses: Vec3) -> [Vec3; 2] {
        let [a, b] = self.jacobian.body_impulses(impulses);
        let [[mass_a, inertia_a], [mass_b, inertia_b]] = self.inverses;
        [[mass_a * a[0], mass_a * a[1], inertia_a * a[2]], [mass_b * b[0], mass_b * b[1], inertia_b * b[2]]]
    }

    /// Applies the impulses of the rows to the velocities of A and B (x, y, angular).
    #[inline(always)]
    pub(super) fn apply_impulses(&self, velocities: &mut [Vec3; 2], impulses: Vec3) {
        for (velocity, change) in velocities.iter_mut().zip(self.velocity_changes(impulses)) {
            (0..3).for_each(|i| velocity[i] += change[i]);
        }
    }

    /// Adds the velocity changes of A and B (x and y in length units/s, angular in radians/s) to `sums`, the warm-start sums by
    /// body index.
    pub(super) fn add_warm_start(&self, sums: &mut [[f32; 4]], changes: [Vec3; 2]) {
        for (side, change) in changes.into_iter().enumerate() {
            if self.is_movable(side) {
                let sum = &mut sums[self.bodies[side].position()];
                (0..3).for_each(|i| sum[i] += change[i] as f32);
            }
        }
    }

    /// Updates pose and Jacobian after the bodies have moved in a substep, and corrects the next warm start.
    ///
    /// `impulses` are the accumulated impulses of the rows. They act again at the start of the next substep, with the arms and
    /// normals after the motion. With the arms and normals before it, the impulses would add energy to bodies that rotate.
    pub(super) fn advance(&mut self, bodies: &mut BodySet, impulses: Vec3) {
        let before = self.velocity_changes(impulses);
        let steps = self.bodies.map(|body| {
            let [x, y, turned, _] = bodies.states[body].displacement.map(f64::from);
            [x, y, turned]
        });
        self.frame = self.frame.displaced(steps);
        self.jacobian = self.frame.jacobian();
        let after = self.velocity_changes(impulses);
        for side in [0, 1].into_iter().filter(|&side| self.is_movable(side)) {
            let begun = &mut bodies.warm_started_velocity[self.bodies[side]];
            (0..3).for_each(|i| begun[i] -= (after[side][i] - before[side][i]) as f32);
        }
    }
}
