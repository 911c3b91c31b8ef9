//! Joints in the passes of the iterative solver: soft constraints beside the contacts (E. Catto, "Solver2D", 2024; Box2D 3).
//!
//! In every substep all joints are solved before all contacts: softly before bodies move, and hard after that. What the impulses of
//! joints do is summed with that of contacts, and acts at once at the beginning of the substep: a warm start that goes joint by joint,
//! between the solutions, leaves two to ten times as much error. Joints learn no load, as contacts do: their anchors hardly move against
//! each other however they swing, so that nothing tells when to learn.
//!
//! All of it is made anew in every update from what is saved of joints and bodies.

use super::super::bodies::Bodies;
use super::super::tuning::Step;
use super::colours::sort_by_colour;
use super::hold::{End, Hold};
use super::soft_joint::{LEVER, Pass, SoftJoint};
use super::soft_law::Law;
use super::soft_spring::SoftSpring;
use super::springs::Springs;
use crate::storage::reusing_clone::reusing_clone;

/// Greatest speed of bodies with joints in the iterative solver, in units of length per second: that of all bodies in Box2D 3
/// (`maximumLinearSpeed`, 400 m/s).
const GREATEST_SPEED: f32 = 400.0;

/// The joints of the iterative solver.
#[derive(Debug, Default)]
pub(super) struct SoftJoints {
    /// All joints in the plane, by their places in the list, in the order of their colours.
    order: Vec<u32>,
    /// The joints of this update, and the springs that are rows.
    joints: Vec<SoftJoint>,
    springs: Vec<SoftSpring>,
    /// Their dynamic bodies; and by body number whether it is one of them, as a mask of all bits.
    bodies: Vec<u32>,
    masks: Vec<u32>,
}

reusing_clone! { SoftJoints { order, joints, springs, bodies, masks } }

impl SoftJoints {
    /// Plans the order of these joints, given by their places in the list.
    pub(super) fn plan(&mut self, holds: &[Hold], in_plane: &[u32], bodies: usize) {
        self.forget();
        self.order.clear();
        self.order.extend(in_plane);
        sort_by_colour(holds, &mut self.order, bodies);
        self.masks.clear();
        self.masks.resize(bodies, 0);
    }

    /// No joint is solved in this update, unless more is told.
    pub(super) fn forget(&mut self) {
        self.joints.clear();
        self.springs.clear();
        self.bodies.drain(..).for_each(|body| self.masks[body as usize] = 0);
    }

    /// An update begins, in which these joints are solved, and the springs that no other solver has solved.
    pub(super) fn begin(
        &mut self,
        (holds, springs): (&[Hold], &Springs),
        is_in: impl Fn(usize) -> bool,
        (bodies, step): (&Bodies, &Step),
        unit: f64,
    ) {
        self.forget();
        let (times, law) = ([step.dt, step.h].map(f64::from), Law::soft(step.h.into()));
        let fastest = [f64::from(GREATEST_SPEED) * unit, LEVER * unit];
        let SoftJoints { order, joints, springs: of_springs, bodies: marked, masks } = self;
        let mut mark = |ends: &[End; 2]| {
            for body in ends.iter().map(|end| end.body).filter(|&body| body != 0) {
                if std::mem::replace(&mut masks[body as usize], !0) == 0 {
                    marked.push(body);
                }
            }
        };
        for &at in order.iter().filter(|&&at| is_in(at as usize)) {
            let hold = &holds[at as usize];
            let mut joint = SoftJoint::new(at, hold, bodies, times);
            joint.soften(&law, unit);
            joints.push(joint);
            if joint.acts() {
                mark(&hold.ends);
            }
        }
        for hold in springs.unsolved() {
            of_springs.push(SoftSpring::new(hold, bodies, times[1], fastest));
            mark(hold.ends());
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.joints.is_empty() && self.springs.is_empty()
    }

    /// By body number a mask of all bits for bodies with joints in the iterative solver.
    pub(super) fn masks(&self) -> &[u32] {
        &self.masks
    }

    /// Adds what impulses do to velocities in a substep.
    pub(super) fn warm(&self, bodies: &mut Bodies) {
        self.springs.iter().for_each(|spring| spring.warm(&mut bodies.warm));
        self.joints.iter().for_each(|joint| joint.warm(&mut bodies.warm));
    }

    /// The pass before bodies move.
    pub(super) fn solve_soft(&mut self, bodies: &mut Bodies, h: f32) {
        let h = f64::from(h);
        self.springs.iter_mut().for_each(|spring| spring.solve(&mut bodies.hot));
        self.solve(bodies, &Pass { law: Law::soft(h), h });
    }

    /// The pass after bodies have moved.
    pub(super) fn relax(&mut self, bodies: &mut Bodies, h: f32) {
        self.solve(bodies, &Pass { law: Law::HARD, h: h.into() });
        self.joints.iter_mut().for_each(SoftJoint::count_impulse);
    }

    fn solve(&mut self, bodies: &mut Bodies, pass: &Pass) {
        self.joints.iter_mut().for_each(|joint| joint.solve(&mut bodies.hot, pass));
    }

    /// Joints and springs follow bodies that have moved.
    pub(super) fn advance(&mut self, bodies: &mut Bodies) {
        self.springs.iter_mut().for_each(|spring| spring.advance(bodies));
        self.joints.iter_mut().for_each(|joint| joint.advance(bodies));
    }

    /// No body is faster than bodies with joints may be, but for bullets. Joints that cannot be kept would drive them further and
    /// further apart.
    pub(super) fn limit_speeds(&self, bodies: &mut Bodies, unit: f32) {
        let most = GREATEST_SPEED * unit;
        for body in self.bodies.iter().map(|&body| body as usize) {
            let [x, y, ..] = bodies.hot[body].velocity;
            let squared = x * x + y * y;
            if squared > most * most && !bodies.are_bullets[body] {
                let part = most / squared.sqrt();
                for (axis, old) in [x, y].into_iter().enumerate() {
                    // The part that is cut off is no impulse that acts again.
                    bodies.hot[body].velocity[axis] = old * part;
                    bodies.begun[body][axis] += old * part - old;
                }
            }
        }
    }

    /// Forces and torques of these joints in the last substep, and their means over the update of `dt` seconds.
    pub(super) fn finish(&self, holds: &mut [Hold], [dt, h]: [f32; 2]) {
        for joint in &self.joints {
            let hold = &mut holds[joint.hold as usize];
            (hold.force, hold.mean_force) = (joint.force(h.into()), Some(joint.mean_force(dt.into())));
        }
    }
}
