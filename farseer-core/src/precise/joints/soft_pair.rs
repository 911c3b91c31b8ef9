//! The two bodies of a constraint of the iterative solver: relative pose, Jacobian, and what impulses do to them.

use super::super::bodies::{Bodies, Hot};
use super::super::direct::block::Triple;
use super::super::direct::constraint::Jacobian;
use super::super::direct::joint::ANGLE;
use super::frame::Frame;
use super::hold::End;

/// The pair. Impulses are those of a substep, on the second body, by the rows of [`Frame::jacobian`].
#[derive(Debug, Clone, Copy)]
pub(super) struct SoftPair {
    /// Indices into [`Bodies::hot`]: 0 for what has no velocity.
    bodies: [u32; 2],
    /// Reciprocals of mass and moment of inertia; 0 for what is fixed.
    inverses: [[f64; 2]; 2],
    pub(super) frame: Frame,
    pub(super) jacobian: Jacobian,
}

impl SoftPair {
    pub(super) fn new(ends: &[End; 2], frame: Frame, bodies: &Bodies) -> Self {
        let is_listed = |pose: u32| (pose as usize) < bodies.hot.len();
        SoftPair {
            bodies: [0, 1].map(|side| ends[side].pose).map(|pose| if is_listed(pose) { pose } else { 0 }),
            inverses: [0, 1].map(|side| match ends[side].body {
                0 => [0.0; 2],
                body => bodies.inverses[body as usize].map(f64::from),
            }),
            frame,
            jacobian: frame.jacobian(),
        }
    }

    /// Velocities of both bodies.
    #[inline(always)]
    pub(super) fn velocities(&self, hot: &[Hot]) -> [Triple; 2] {
        self.bodies.map(|body| {
            let [x, y, spin, _] = hot[body as usize].velocity.map(f64::from);
            [x, y, spin]
        })
    }

    /// Bodies that give way take over these velocities.
    #[inline(always)]
    pub(super) fn write(&self, hot: &mut [Hot], velocities: [Triple; 2]) {
        for (side, [x, y, spin]) in velocities.into_iter().enumerate() {
            if self.gives_way(side) {
                let velocity = &mut hot[self.bodies[side] as usize].velocity;
                (velocity[0], velocity[1], velocity[2]) = (x as f32, y as f32, spin as f32);
            }
        }
    }

    #[inline(always)]
    fn gives_way(&self, side: usize) -> bool {
        self.inverses[side] != [0.0; 2]
    }

    /// Reciprocals of the moments of inertia.
    pub(super) fn inverse_inertias(&self) -> [f64; 2] {
        self.inverses.map(|[_, inertia]| inertia)
    }

    /// Moment of inertia about a point at the square of this distance from the origin; infinite for what cannot be turned or moved.
    pub(super) fn inertia_about(&self, side: usize, squared: f64) -> f64 {
        let [mass, inertia] = self.inverses[side].map(f64::recip);
        inertia + if squared > 0.0 { mass * squared } else { 0.0 }
    }

    /// K = J M^-1 J^T of all three rows.
    pub(super) fn matrix(&self) -> [Triple; 3] {
        let ([[mass_a, inertia_a], [mass_b, inertia_b]], Jacobian { a, b, .. }) =
            (self.inverses, self.jacobian);
        std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let linear = if i == j && i != ANGLE { mass_a + mass_b } else { 0.0 };
                linear + inertia_a * a[i] * a[j] + inertia_b * b[i] * b[j]
            })
        })
    }

    /// Changes of velocity of both bodies by impulses of the rows.
    #[inline(always)]
    pub(super) fn yields(&self, impulses: Triple) -> [Triple; 2] {
        let [a, b] = self.jacobian.push(impulses);
        let [[mass_a, inertia_a], [mass_b, inertia_b]] = self.inverses;
        [[mass_a * a[0], mass_a * a[1], inertia_a * a[2]], [mass_b * b[0], mass_b * b[1], inertia_b * b[2]]]
    }

    /// Impulses of the rows act on these velocities.
    #[inline(always)]
    pub(super) fn push(&self, velocities: &mut [Triple; 2], impulses: Triple) {
        for (velocity, change) in velocities.iter_mut().zip(self.yields(impulses)) {
            (0..3).for_each(|i| velocity[i] += change[i]);
        }
    }

    /// Impulses that do this to velocities are to act at the beginning of every substep.
    pub(super) fn warm(&self, warm: &mut [[f32; 4]], changes: [Triple; 2]) {
        for (side, change) in changes.into_iter().enumerate() {
            if self.gives_way(side) {
                let sum = &mut warm[self.bodies[side] as usize];
                (0..3).for_each(|i| sum[i] += change[i] as f32);
            }
        }
    }

    /// Frame and Jacobian follow bodies that have moved. Impulses that act again at the beginning of the next substep get the
    /// arms and directions of that: left as they were, they would gain energy where bodies turn.
    pub(super) fn advance(&mut self, bodies: &mut Bodies, impulses: Triple) {
        let before = self.yields(impulses);
        let steps = self.bodies.map(|body| {
            let [x, y, turned, _] = bodies.hot[body as usize].step.map(f64::from);
            [x, y, turned]
        });
        self.frame = self.frame.displaced(steps);
        self.jacobian = self.frame.jacobian();
        let after = self.yields(impulses);
        for side in [0, 1].into_iter().filter(|&side| self.gives_way(side)) {
            let begun = &mut bodies.begun[self.bodies[side] as usize];
            (0..3).for_each(|i| begun[i] -= (after[side][i] - before[side][i]) as f32);
        }
    }
}
