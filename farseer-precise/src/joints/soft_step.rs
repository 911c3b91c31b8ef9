//! Joints and springs in the iterative solver: soft constraints beside the contacts (E. Catto, "Solver2D", 2024; Box2D 3).
//!
//! In every substep all joints are solved before all contacts: with bias before bodies move, rigidly in the relaxation after
//! it. One warm start applies the accumulated impulses of joints and contacts together, at the start of the substep. A warm
//! start joint by joint, between the solves, leaves two to ten times as much error.
//!
//! Joints have no load adaptation as contacts have. The anchors of a joint hardly move relative to each other even while the
//! bodies swing, so that a small relative motion is no sign of rest.
//!
//! The rows are built anew in every update from the saved state of joints and bodies.

use super::super::bodies::BodySet;
use super::super::constraint_graph::ContactConstraintSimd;
use super::super::direct_solver::joint::{ACROSS, ALONG};
use super::super::scaled_parameters::StepContext;
use super::colours::{JointColor, assign_colors};
use super::indices::JointIndex;
use super::joint_constraint::{JointAnchor, JointList};
use super::soft_angle_spring::SoftAngleSpring;
use super::soft_axis_spring::SoftAxisSpring;
use super::soft_block::{BlockKind, SoftJointBlock};
use super::soft_coupling::SoftCoupling;
use super::soft_law::{RowSoftness, RowSoftnessLanes};
use super::soft_spring::SoftSpring;
use super::springs::SpringRows;
use crate::index::{BodyIndex, DenseIndex, IndexedVec};
use crate::parameters::joints::{JOINTED_BODY_ROTATION, JOINTED_BODY_SPEED, SOFT_ROW_ARM};
use crate::reusing_clone;

/// Joints and springs of the iterative solver.
#[derive(Debug, Default)]
pub(super) struct SoftJoints {
    /// All 2D joints as (index into the list of joints, colour), sorted by colour.
    colored_joints: Vec<(JointIndex, JointColor)>,
    /// Joints that the iterative solver has in this update, in blocks of four.
    blocks: Vec<SoftJointBlock>,
    /// Linear springs that the iterative solver has in this update.
    springs: Vec<SoftSpring>,
    /// Servos along an axis that the iterative solver has in this update.
    axis_springs: Vec<SoftAxisSpring>,
    /// Angle springs that the iterative solver has in this update.
    angle_springs: Vec<SoftAngleSpring>,
    /// Gears and pulleys that the iterative solver has in this update.
    couplings: Vec<SoftCoupling>,
    /// Indices of the dynamic bodies of `blocks` and of the springs, into the arrays of `BodySet`.
    jointed_bodies: Vec<BodyIndex>,
    /// For each body index all bits set if the body is in `jointed_bodies`, else 0.
    jointed_masks: IndexedVec<BodyIndex, u32>,
    /// For each body index all bits set if a contact has held the body against joints in this update, else 0.
    held_masks: IndexedVec<BodyIndex, u32>,
    /// Indices of bodies that an impact of this update has reached, by a contact or through joints.
    impacted_bodies: Vec<BodyIndex>,
    /// For each body index all bits set if the body is in `impacted_bodies`, else 0.
    impacted_masks: IndexedVec<BodyIndex, u32>,
}

reusing_clone! { SoftJoints { colored_joints, blocks, springs, axis_springs, angle_springs, couplings, jointed_bodies, jointed_masks, held_masks, impacted_bodies, impacted_masks } }

impl SoftJoints {
    /// Assigns colours to the 2D joints, whose indices into `joints` are `in_plane`, and reserves memory. Called after the list
    /// of joints has changed. `bodies` is the number of bodies.
    pub(super) fn plan(&mut self, joints: &JointList, in_plane: &[JointIndex], bodies: usize) {
        self.clear();
        assign_colors(joints, in_plane, bodies, &mut self.colored_joints);
        // The memory is for all joints: any of them may come to the iterative solver later. Each colour may leave one block of
        // each kind that is not full.
        let colours = self.colored_joints.chunk_by(|one, other| one.1 == other.1).count();
        let blocks = self.colored_joints.len().div_ceil(4) + BlockKind::COUNT * colours;
        let alone = self.colored_joints.iter().filter(|&&(_, colour)| colour.is_overflow()).count();
        self.blocks.reserve(self.colored_joints.len().min(blocks + alone));
        self.jointed_bodies.reserve(bodies.min(2 * self.colored_joints.len()));
        self.impacted_bodies.drain(..).for_each(|body| self.impacted_masks[body] = 0);
        // All masks are 0 here.
        for masks in [&mut self.jointed_masks, &mut self.held_masks, &mut self.impacted_masks] {
            masks.resize(bodies, 0);
        }
    }

    /// Removes all joints and springs from the iterative solver.
    pub(super) fn clear(&mut self) {
        self.blocks.clear();
        self.springs.clear();
        self.axis_springs.clear();
        self.angle_springs.clear();
        self.couplings.clear();
        for body in self.jointed_bodies.drain(..) {
            (self.jointed_masks[body], self.held_masks[body]) = (0, 0);
        }
    }

    /// Builds the rows of an update: from the joints for which `is_iterative` returns true, and from the springs that the
    /// direct solver has not solved.
    ///
    /// `is_iterative` takes an index into `joints`. `length_unit` is the length unit of the simulator, > 0.
    pub(super) fn prepare(
        &mut self,
        (joints, springs): (&JointList, &SpringRows),
        is_iterative: impl Fn(JointIndex) -> bool,
        (bodies, step): (&BodySet, &StepContext),
        length_unit: f64,
    ) {
        self.clear();
        let times = [step.dt, step.h].map(f64::from);
        self.add_joints(joints, is_iterative, (bodies, length_unit), times);
        let softness = RowSoftness::soft(step.h.into());
        self.blocks.iter_mut().for_each(|block| block.prepare(&softness, length_unit as f32));
        let max_speed = f64::from(JOINTED_BODY_SPEED) * length_unit;
        let max_spin = max_speed / (f64::from(SOFT_ROW_ARM) * length_unit);
        for spring in springs.unsolved() {
            match spring.row() {
                ALONG => self.springs.push(SoftSpring::new(spring, bodies, times[1], max_speed)),
                ACROSS => self.axis_springs.push(SoftAxisSpring::new(spring, bodies, times[1], max_speed)),
                _ => self.angle_springs.push(SoftAngleSpring::new(spring, bodies, times[1], max_spin)),
            }
            self.mark_bodies(spring.ends());
        }
    }

    /// Puts the joints for which `is_iterative` returns true into blocks. `times` are the seconds of an update and of a substep.
    fn add_joints(
        &mut self,
        joints: &JointList,
        is_iterative: impl Fn(JointIndex) -> bool,
        (bodies, length_unit): (&BodySet, f64),
        times: [f64; 2],
    ) {
        // For each kind, the block of this colour that is not full.
        let mut open = [None; BlockKind::COUNT];
        let mut last = None;
        for at in 0..self.colored_joints.len() {
            let (at, color) = self.colored_joints[at];
            if !is_iterative(at) {
                continue;
            }
            let joint = &joints[at];
            if joint.locked.is_coupling() {
                self.couplings.push(SoftCoupling::new(at, joint, bodies, (times[1], length_unit)));
                self.mark_bodies(&joint.anchors);
                continue;
            }
            let is_new = last.replace(color) != Some(color);
            if is_new || color.is_overflow() {
                open = [None; BlockKind::COUNT];
            }
            let kind = BlockKind::of_joint(joint);
            let block = *open[kind.index()].get_or_insert_with(|| {
                self.blocks.push(SoftJointBlock::new(kind));
                self.blocks.len() - 1
            });
            let is_acting = self.blocks[block].add_joint(at, joint, bodies, times);
            if self.blocks[block].is_full() {
                open[kind.index()] = None;
            }
            if is_acting {
                self.mark_bodies(&joint.anchors);
            }
        }
    }

    /// Adds the dynamic bodies of a joint or spring to `jointed_bodies`, if they are not in it.
    fn mark_bodies(&mut self, ends: &[JointAnchor; 2]) {
        for body in ends.iter().map(|end| end.body).filter(|&body| body != BodyIndex::PLACEHOLDER) {
            if std::mem::replace(&mut self.jointed_masks[body], !0) == 0 {
                self.jointed_bodies.push(body);
            }
        }
    }

    /// Returns whether the iterative solver has neither joints nor springs in this update.
    pub(super) fn is_empty(&self) -> bool {
        self.blocks.is_empty()
            && self.springs.is_empty()
            && self.axis_springs.is_empty()
            && self.angle_springs.is_empty()
            && self.couplings.is_empty()
    }

    /// Returns the masks of the bodies with joints or springs, and those of the bodies that contacts hold.
    pub(super) fn masks_of_held_bodies(&mut self) -> (&[u32], &mut [u32]) {
        (self.jointed_masks.slice(..), self.held_masks.slice_mut(..))
    }

    /// Returns whether a joint has a position error that is too large to be corrected in proportion, at the start of the substep.
    pub(super) fn has_large_error(&self) -> bool {
        self.blocks.iter().any(SoftJointBlock::has_large_error)
    }

    /// Returns for each body index all bits set if the body has a joint or spring in the iterative solver, else 0.
    pub(super) fn body_masks(&self) -> &IndexedVec<BodyIndex, u32> {
        &self.jointed_masks
    }

    /// Adds the velocity changes by the accumulated impulses of joints and springs to the warm-start sums in `bodies`.
    pub(super) fn add_warm_start(&self, bodies: &mut BodySet) {
        self.springs.iter().for_each(|spring| spring.add_warm_start(&mut bodies.warm_start));
        self.axis_springs.iter().for_each(|spring| spring.add_warm_start(&mut bodies.warm_start));
        self.angle_springs.iter().for_each(|spring| spring.add_warm_start(&mut bodies.warm_start));
        self.couplings.iter().for_each(|coupling| coupling.add_warm_start(&mut bodies.warm_start));
        self.blocks.iter().for_each(|block| block.add_warm_start(&mut bodies.warm_start));
    }

    /// Solves springs and joints once with bias, before bodies move in a substep of `h` seconds.
    pub(super) fn solve_with_bias(&mut self, bodies: &mut BodySet, h: f32) {
        self.springs.iter_mut().for_each(|spring| spring.solve(&mut bodies.states));
        self.axis_springs.iter_mut().for_each(|spring| spring.solve(&mut bodies.states));
        self.angle_springs.iter_mut().for_each(|spring| spring.solve(&mut bodies.states));
        self.solve(bodies, &RowSoftness::soft(h.into()), h);
    }

    /// Solves joints once without bias, after bodies have moved in a substep of `h` seconds: the relaxation. Adds the impulses
    /// of the substep to the sums of the update.
    pub(super) fn relax(&mut self, bodies: &mut BodySet, h: f32) {
        self.solve(bodies, &RowSoftness::RIGID, h);
        self.blocks.iter_mut().for_each(SoftJointBlock::accumulate_impulses);
        self.couplings.iter_mut().for_each(SoftCoupling::accumulate_impulse);
        self.axis_springs.iter_mut().for_each(SoftAxisSpring::accumulate_impulse);
        self.angle_springs.iter_mut().for_each(SoftAngleSpring::accumulate_impulse);
    }

    fn solve(&mut self, bodies: &mut BodySet, softness: &RowSoftness, h: f32) {
        let (law, inverse_h) = (RowSoftnessLanes::splat(softness), 1.0 / h);
        let couplings = self.couplings.iter_mut();
        couplings.for_each(|coupling| coupling.solve(&mut bodies.states, softness, h.into()));
        self.blocks.iter_mut().for_each(|block| block.solve(&mut bodies.states, &law, inverse_h));
    }

    /// Updates poses and rows of joints and springs after bodies have moved in a substep.
    pub(super) fn advance(&mut self, bodies: &mut BodySet) {
        self.springs.iter_mut().for_each(|spring| spring.advance(bodies));
        self.axis_springs.iter_mut().for_each(|spring| spring.advance(bodies));
        self.angle_springs.iter_mut().for_each(|spring| spring.advance(bodies));
        self.couplings.iter_mut().for_each(|coupling| coupling.advance(bodies));
        let SoftJoints { blocks, held_masks, .. } = self;
        blocks.iter_mut().for_each(|block| block.advance(bodies, held_masks));
    }

    /// Limits the velocities of bodies with joints or springs in the iterative solver, except bullets, in a substep of `h`
    /// seconds.
    ///
    /// The limits are [`JOINTED_BODY_SPEED`] for the speed, and [`JOINTED_BODY_ROTATION`] for the rotation in a substep. Joints
    /// that contradict each other would otherwise accelerate their bodies without bound.
    pub(super) fn limit_speeds(&self, bodies: &mut BodySet, length_unit: f32, h: f32) {
        let (max_speed, max_angular_speed) = (JOINTED_BODY_SPEED * length_unit, JOINTED_BODY_ROTATION / h);
        for body in self
            .jointed_bodies
            .iter()
            .map(|body| body.position())
            .filter(|&body| !bodies.are_bullets[BodyIndex::new(body)])
        {
            let [x, y, spin, _] = bodies.states[BodyIndex::new(body)].velocity;
            let (squared_speed, angular_speed) = (x * x + y * y, spin.abs());
            if squared_speed > max_speed * max_speed || angular_speed > max_angular_speed {
                let scale = if squared_speed > max_speed * max_speed {
                    max_speed / squared_speed.sqrt()
                } else {
                    1.0
                };
                let angular_scale =
                    if angular_speed > max_angular_speed { max_angular_speed / angular_speed } else { 1.0 };
                for (axis, (old, part)) in
                    [(x, scale), (y, scale), (spin, angular_scale)].into_iter().enumerate()
                {
                    // The removed velocity is no impulse, so the next warm start must not apply it again.
                    bodies.states[BodyIndex::new(body)].velocity[axis] = old * part;
                    bodies.warm_started_velocity[BodyIndex::new(body)][axis] += old * part - old;
                }
            }
        }
    }

    /// Starts the restitution phase of the contacts: no body is impacted yet.
    pub(super) fn begin_restitution(&mut self) {
        self.impacted_bodies.drain(..).for_each(|body| self.impacted_masks[body] = 0);
    }

    /// Adds the bodies of these contact lanes to the impacted bodies, if they have joints or springs in the iterative solver.
    /// `lanes` has one bit for each of the four lanes of `row`.
    pub(super) fn record_restitution<const P: usize>(&mut self, row: &ContactConstraintSimd<P>, lanes: u32) {
        for lane in (0..4).filter(|lane| lanes >> lane & 1 == 1) {
            for body in [row.a[lane], row.b[lane]] {
                let is_jointed = self.jointed_masks.at(body).is_some_and(|&mask| mask != 0);
                if is_jointed && std::mem::replace(&mut self.impacted_masks[body], !0) == 0 {
                    self.impacted_bodies.push(body);
                }
            }
        }
    }

    /// Removes the velocity errors of rigid joints after the restitution phase, in the order of colours, beginning at impacted
    /// bodies.
    ///
    /// Each solved joint makes its other body impacted, too. The impulses of the impact do not act again in the next update.
    /// Returns the largest velocity error before removal, length units/s.
    pub(super) fn propagate_impacts(&mut self, bodies: &mut BodySet, length_unit: f32) -> f32 {
        let SoftJoints { blocks, impacted_bodies, impacted_masks, .. } = self;
        if impacted_bodies.is_empty() {
            return 0.0;
        }
        let errors = blocks.iter_mut().map(|block| {
            block.solve_impact(&mut bodies.states, (impacted_masks, impacted_bodies), length_unit)
        });
        errors.fold(0.0, |most: f32, missed| if missed > most { missed } else { most })
    }

    /// Stores two forces in each joint: force and torque of the last substep, and the mean over the update. `times` are the
    /// seconds of the update and of the substep.
    pub(super) fn store_forces(&self, joints: &mut JointList, times: [f32; 2]) {
        self.blocks.iter().for_each(|block| block.store_forces(joints, times));
        self.couplings.iter().for_each(|coupling| coupling.store_force(joints, times.map(f64::from)));
        let dt = f64::from(times[0]);
        let along_axes = self.axis_springs.iter().filter_map(|spring| spring.servo_force(dt));
        let angular = self.angle_springs.iter().filter_map(|spring| spring.servo_force(dt));
        for (joint, force) in along_axes.chain(angular) {
            let sum = &mut joints[joint].servo_force;
            (0..3).for_each(|axis| sum[axis] += force[axis]);
        }
    }
}
