//! Import of the simulator's joints into the precise set, and export of joint forces.
//!
//! After an edit, every enabled joint becomes a [`JointConstraint`], and the articulations are built anew. In every step the
//! constraints follow the poses of their bodies. After the step the joints get error, anchors and force; overloaded joints
//! break. The module reads the joints and bodies of the simulator. It writes errors, anchors and forces of the joints, and an
//! event for each broken joint.

use super::super::Precise;
use super::super::bodies::signed_angle;
use super::super::scaled_parameters::StepContext;
use super::articulated_body::{LockedDofs, Vec2};
use super::articulation_step::rotate;
use super::joint_constraint::{JointAnchor, JointConstraint, to_vector2};
use crate::body::BodyId;
use crate::body::entry::Bodies;
use crate::joints::constraint_spec::ConstraintSpecKind;
use crate::joints::{Joint, JointId};
use crate::math::{Vector2, scalar};
use crate::objects::Objects;
use crate::report::{Event, Report};

/// Converts a vector from the vector type of the public API to `f64`.
fn to_vec2(v: Vector2) -> Vec2 {
    [f64::from(v.x), f64::from(v.y)]
}

impl Precise {
    /// Returns one side of a joint: the body `id` with the anchor `anchor`, or the world if `id` is `None`. Returns `None` if
    /// the body is gone.
    ///
    /// `anchor` is in local coordinates of the body, or in world coordinates for the world.
    pub(super) fn joint_anchor(
        &self,
        id: Option<BodyId>,
        anchor: Vector2,
        bodies: &Bodies,
    ) -> Option<JointAnchor> {
        let Some(id) = id else {
            return Some(JointAnchor { arm: to_vec2(anchor), ..JointAnchor::default() });
        };
        let body = &bodies.get(id)?.body;
        let Some(index) = self.body_index(id) else {
            let (sine, cosine) = scalar::sin_cos(body.rotation());
            let ([x, y], s, c) = (to_vec2(anchor), f64::from(sine), f64::from(cosine));
            let arm = [c * x - s * y, s * x + c * y];
            return Some(JointAnchor { position: to_vec2(body.position()), arm, ..JointAnchor::default() });
        };
        let is_dynamic = index < self.bodies.first_static()
            && self.bodies.inverse_mass_inertia[index] != [0.0; 2]
            && !self.sleep.is_asleep(index);
        let mut joint_anchor = JointAnchor {
            body: if is_dynamic { index as u32 } else { 0 },
            pose_body: index as u32,
            local_anchor: to_vec2(anchor),
            ..JointAnchor::default()
        };
        joint_anchor.update(&self.bodies);
        Some(joint_anchor)
    }

    /// Returns a joint as a constraint at the present poses. Returns `None` if the joint is not active, because neither body is
    /// dynamic or a body is gone.
    fn active_joint_constraint(&self, joint: (JointId, &Joint), bodies: &Bodies) -> Option<JointConstraint> {
        self.joint_constraint(joint, bodies)
            .filter(|constraint| constraint.anchors[0].body != constraint.anchors[1].body)
    }

    /// Returns a joint as a constraint at the present poses, whether its bodies are dynamic or not; `None` if a body is gone.
    fn joint_constraint(&self, (id, joint): (JointId, &Joint), bodies: &Bodies) -> Option<JointConstraint> {
        let spec = joint.constraint_spec();
        let anchors = [
            self.joint_anchor(spec.bodies.0, spec.anchors[0], bodies)?,
            self.joint_anchor(Some(spec.bodies.1), spec.anchors[1], bodies)?,
        ];
        let locked = match spec.keeps {
            ConstraintSpecKind::Point => LockedDofs::Point,
            ConstraintSpecKind::PointAndAngle => LockedDofs::Weld,
            ConstraintSpecKind::Angle => LockedDofs::Angle,
            ConstraintSpecKind::Distance => LockedDofs::Distance,
            ConstraintSpecKind::Line => LockedDofs::Line,
        };
        let can_be_soft = matches!(locked, LockedDofs::Point | LockedDofs::Distance);
        let softness = if can_be_soft { f64::from(joint.softness()) } else { 0.0 };
        let mut constraint = JointConstraint {
            joint: id,
            bodies: spec.bodies,
            locked,
            anchors,
            angle: 0.0,
            local_axis: to_vec2(spec.axis),
            axis: [0.0; 2],
            drive: spec.drive,
            range: spec.range.map(f64::from),
            slop: f64::from(spec.slop).max(0.0),
            max_impulse: f64::from(spec.most).abs(),
            softness: softness.max(0.0),
            // A larger factor would overcorrect, so that the next update has to correct back.
            bias_factor: f64::from(joint.bias_factor()).clamp(0.0, 1.0),
            depth_offset: self.depth_offset(spec.keeps, spec.bodies),
            has_moved: true,
            force: joint.force_and_torque(),
            force_along_depth: joint.force_along_depth(),
            mean_force: None,
            error: 0.0,
            first_arm: Vector2::zeros(),
        };
        constraint.update_angle_and_axis(bodies);
        Some(constraint)
    }

    /// Returns the distance along the depth axis from the first body of a distance joint to the second, in length units; 0 for
    /// other joints.
    fn depth_offset(&self, locked: ConstraintSpecKind, bodies: (Option<BodyId>, BodyId)) -> f64 {
        match (locked, &self.depth, bodies) {
            (ConstraintSpecKind::Distance, Some(space), (Some(first), second)) => {
                f64::from(-space.relative_z_and_velocity(first, second)[0])
            }
            _ => 0.0,
        }
    }

    /// Returns the position error of a joint: length units; radians for a joint that locks an angle alone. Returns `None` if
    /// the joint is not active, because no body is dynamic and awake or a body is gone.
    pub(crate) fn joint_error(&self, joint: (JointId, &Joint), bodies: &Bodies) -> Option<f32> {
        Some(self.active_joint_constraint(joint, bodies)?.compute_error() as f32)
    }

    /// Returns the position error of a joint, whether its bodies sleep or not: length units; radians for a joint that locks an
    /// angle alone. Returns `None` if a body is gone.
    pub(crate) fn joint_error_even_asleep(&self, joint: (JointId, &Joint), bodies: &Bodies) -> Option<f32> {
        Some(self.joint_constraint(joint, bodies)?.compute_error() as f32)
    }

    /// Marks the joints as edited, so that the next step imports them again.
    pub(crate) fn invalidate_joints(&mut self) {
        self.joints.is_imported = false;
    }

    /// Moves the joint constraints to the poses of this step, prepares their solvers, and builds the springs that are rows.
    /// Imports the joints first if one was edited.
    pub(crate) fn import_joints(&mut self, objects: &Objects, step: &StepContext) {
        self.import_springs(objects, step);
        self.joints.begin_update(self.parameters.length_unit);
        self.reimport_joints(objects);
        let are_indices_new = std::mem::take(&mut self.joints.are_indices_new);
        let signature = self.joints.last_signature ^ self.springs.signature();
        self.direct_solver.note_joints(signature, are_indices_new);
        if self.joints.constraints.is_empty() {
            return;
        }
        let mut joints = std::mem::take(&mut self.joints);
        if self.depth.is_some() {
            let distance_joints =
                joints.constraints.iter_mut().filter(|constraint| constraint.locked == LockedDofs::Distance);
            distance_joints.for_each(|hold| {
                hold.depth_offset = self.depth_offset(ConstraintSpecKind::Distance, hold.bodies)
            });
        }
        if !joints.constraints.is_empty() {
            let all_touched = self.constraints.has_overflow();
            let is_touched = |body: usize| {
                all_touched || !self.color_usage.has_no_constraint(body) || self.springs.is_attached_to(body)
            };
            joints.prepare(&self.bodies, objects, is_touched);
            joints.prepare_spatial(
                (&self.bodies, objects),
                (step, self.parameters.length_unit),
                is_touched,
                |id| self.depth.as_ref().map_or(0.0, |space| space.z_and_velocity(id)[0]),
            );
        }
        self.joints = joints;
    }

    /// Imports the joints and builds the articulations, if a joint or a body with joints was edited.
    pub(super) fn reimport_joints(&mut self, objects: &Objects) {
        if self.joints.is_imported {
            return;
        }
        let mut joints = std::mem::take(&mut self.joints);
        joints.constraints.clear();
        joints.z_groups.clear();
        joints.spatial.clear();
        let all = (0..objects.joints.list().len()).filter_map(|at| objects.joints.at(at));
        let enabled = all.filter(|(_, joint)| joint.enabled());
        joints.may_break = enabled.clone().any(|(_, joint)| joint.breakpoint() != f32::MAX);
        joints.constraints.reserve(objects.joints.list().len());
        joints
            .constraints
            .extend(enabled.filter_map(|joint| self.active_joint_constraint(joint, &objects.bodies)));
        joints.plan(&self.bodies, self.depth.is_some());
        joints.last_signature = joints.signature();
        (joints.is_imported, joints.are_indices_new) = (true, true);
        self.joints = joints;
    }

    /// Writes error, anchors and force to the joints in `objects`. Joints whose load exceeds their greatest force or torque
    /// break, and `report` gets an event for each.
    pub(crate) fn export_joints(&mut self, objects: &mut Objects, report: &mut Report) {
        for constraint in &mut self.joints.constraints {
            let Some(joint) = objects.joints.get_mut(constraint.joint) else { continue };
            joint.set_error(constraint.error);
            joint.store_world_anchors(constraint.first_arm, || {
                constraint
                    .anchors
                    .map(|anchor| [to_vector2(anchor.arm), to_vector2(anchor.anchor_position())])
            });
            let mean = constraint.mean_force.take().unwrap_or(constraint.force);
            if joint.store_load(constraint.force, mean, constraint.force_along_depth) {
                report.push(Event::JointBroke { joint: constraint.joint });
                self.joints.is_imported = false;
            }
            // The joint replaces non-finite values; the constraint takes the same ones.
            (constraint.force, constraint.force_along_depth) =
                (joint.force_and_torque(), joint.force_along_depth());
        }
    }

    /// Returns whether some joint may break: it has a finite breakpoint (limit of its position error), or edited joints have
    /// not been imported yet.
    pub(crate) fn may_break_joints(&self) -> bool {
        self.joints.may_break()
    }

    /// Returns the joint that was active in this update with this index into `JointSystem::constraints`; `None` if there is
    /// none.
    pub(crate) fn joint_at(&self, index: usize) -> Option<JointId> {
        self.joints.constraints.get(index).map(|constraint| constraint.joint)
    }
}

impl JointConstraint {
    /// Sets the angle of the second body minus that of the first (radians) and the world axis of a prismatic joint from the
    /// poses of `bodies`.
    fn update_angle_and_axis(&mut self, bodies: &Bodies) {
        let rotation_of =
            |id: BodyId| bodies.get(id).map_or(0.0, |entry| f64::from(entry.body.total_rotation()));
        if self.has_angle() {
            self.angle = rotation_of(self.bodies.1) - self.bodies.0.map_or(0.0, rotation_of);
        }
        if self.locked == LockedDofs::Line
            && let Some(entry) = self.bodies.0.and_then(|id| bodies.get(id))
        {
            let (sine, cosine) = libm::sincos(signed_angle(entry.body.rotation()));
            self.axis = rotate([cosine, sine], self.local_axis);
        }
    }

    /// Sets anchors, angle, axis, motor and position error to those at the start of a step.
    pub(super) fn update(&mut self, bodies: &super::BodySet, objects: &Objects) {
        let before = (self.anchors, self.angle, self.axis, self.drive);
        self.anchors.iter_mut().for_each(|anchor| anchor.update(bodies));
        self.update_angle_and_axis(&objects.bodies);
        // The target of a motor may change in every step without a new import.
        if self.drive.is_some() {
            self.drive = objects.joints.get(self.joint).and_then(Joint::motor_and_limits).copied();
        }
        self.has_moved = before != (self.anchors, self.angle, self.axis, self.drive);
        self.error = self.compute_error() as f32;
        self.first_arm = to_vector2(self.anchors[0].arm);
    }
}
