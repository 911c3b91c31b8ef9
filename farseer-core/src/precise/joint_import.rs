//! Adapter: import of the game's joints as constraints of the solvers, and export of joint forces.
//!
//! After an edit, every enabled joint becomes a [`JointConstraint`], and the articulations are built anew. In every step the
//! constraints follow the poses of their bodies. After the step the joints get error, anchors and force; overloaded joints
//! break. The module reads the joints and bodies of the simulator. It writes errors, anchors and forces of the joints, and an
//! event for each broken joint.

use super::axis_locks::{AxisLocks, begin_lock, lock_constraint};
use super::ids::IdTable;
use crate::body::BodyId;
use crate::body::entry::Bodies;
use crate::joints::constraint_spec::ConstraintSpecKind;
use crate::joints::{Joint, JointId, JointKind, JointServo, MotorAndLimits, MotorJoint};
use crate::math::{Vector2, scalar};
use crate::objects::Objects;
use crate::report::{Event, Report};
use crate::springs::SpringId;
use farseer_precise::bodies::BodySet;
use farseer_precise::depth::feature_gate::FeatureGate;
use farseer_precise::depth::state::DepthState;
use farseer_precise::index::{BodyIndex, DenseIndex};
use farseer_precise::island::sleep::SleepState;
use farseer_precise::joints::JointSystem;
use farseer_precise::joints::indices::JointIndex;
use farseer_precise::joints::joint_constraint::{JointAnchor, JointConstraint, JointDrive, Limits, Motor};
use farseer_precise::joints::locked_dofs::LockedDofs;
use farseer_precise::joints::springs::{PoseServo, Servo, SpringConstraint, SpringRows};
use farseer_precise::joints::vec2::Vec2;
use farseer_precise::reusing_clone;
use farseer_precise::scaled_parameters::StepContext;

/// Joints and springs of the game behind the dense indices of the solver.
#[derive(Debug, Default)]
pub(super) struct JointTable {
    /// Ids of each active joint, by its index in [`JointSystem`]. Locks of axes come last.
    ids: Vec<JointIds>,
    /// Whether the joints are up to date: no joint and no list of joints has been edited since the last import.
    is_imported: bool,
    /// Whether the joints were imported anew in this update, so that joint indices may have changed.
    are_indices_new: bool,
    /// Hash of the joints that were imported last, of their bodies and of the properties by which the direct solver accepts or
    /// rejects islands.
    signature: u64,
    /// Whether some joint has a finite breakpoint (limit of its position error).
    may_break: bool,
    /// Joints with a servo, in the order of their indices in [`JointSystem`].
    servos: Vec<JointIndex>,
    /// Whether the pairs of bodies that do not collide because of a joint are up to date with the joints.
    are_bodies_separated: bool,
    /// Springs that became rows in this update, in the order of the simulator's list. Each has the accelerations that its
    /// explicit force would give to A and B: x and y in length units/s^2, angular in radians/s^2.
    pub(super) row_springs: Vec<(SpringId, [[f32; 3]; 2])>,
}

reusing_clone! { JointTable { ids, is_imported, are_indices_new, signature, may_break, servos, are_bodies_separated, row_springs } }

/// Ids of a joint and of its bodies.
#[derive(Debug, Clone, Copy)]
struct JointIds {
    /// The joint; `None` for the locks of a body's axes.
    joint: Option<JointId>,
    /// Both bodies of the joint; the first is `None` for the world.
    bodies: (Option<BodyId>, BodyId),
}

impl JointIds {
    /// Returns the joint; `None` if it is gone, and for the locks of a body's axes.
    fn joint_of(self, objects: &Objects) -> Option<&Joint> {
        self.joint.and_then(|id| objects.joints.get(id))
    }
}

impl JointTable {
    /// Marks the joints as edited, so that the next step imports them again.
    pub(super) fn invalidate(&mut self) {
        (self.is_imported, self.are_bodies_separated) = (false, false);
    }

    /// Marks the pairs of bodies that do not collide because of a joint as up to date. Returns whether they were not.
    pub(super) fn take_unseparated(&mut self) -> bool {
        !std::mem::replace(&mut self.are_bodies_separated, true)
    }

    /// Returns whether no joint has been edited since the last import.
    pub(super) fn are_imported(&self) -> bool {
        self.is_imported
    }

    /// Returns whether some joint may break: it has a finite breakpoint (limit of its position error), or edited joints have
    /// not been imported yet.
    pub(super) fn may_break(&self) -> bool {
        !self.is_imported || self.may_break
    }

    /// Returns the joint that was active in this update with this index; `None` if there is none.
    pub(super) fn joint_at(&self, index: usize) -> Option<JointId> {
        self.ids.get(index).and_then(|ids| ids.joint)
    }

    /// Returns the hash of all joints, and whether their indices may have changed since the last call.
    pub(super) fn take_signature(&mut self) -> (u64, bool) {
        (self.signature, std::mem::take(&mut self.are_indices_new))
    }

    /// Returns both bodies of each active joint of which a body is not in the simulation; the first is `None` for the world.
    pub(super) fn bodies_of_unlisted(
        &self,
        joints: &JointSystem,
    ) -> impl Iterator<Item = (Option<BodyId>, BodyId)> {
        let is_unlisted = |(constraint, ids): &(&JointConstraint, &JointIds)| {
            let [first, second] = constraint.anchors.map(|anchor| anchor.pose_body == BodyIndex::PLACEHOLDER);
            second || (first && ids.bodies.0.is_some())
        };
        joints.constraints().iter().zip(&self.ids).filter(is_unlisted).map(|(_, ids)| ids.bodies)
    }
}

/// Returns a hash of the ids of the bodies A and B of a joint or spring; `None` is the world. Ids do not change with a restore.
pub(super) fn bodies_hash(bodies: [Option<BodyId>; 2]) -> u64 {
    let [a, b] = bodies.map(|body| body.map_or(u64::MAX, BodyId::to_bits));
    a.rotate_left(17) ^ b.rotate_left(41)
}

/// Returns a hash of the active joints, of their bodies and of the joint properties by which the direct solver accepts or
/// rejects islands (multiplicative hashing).
fn joints_hash(joints: &[JointConstraint], ids: &[JointIds]) -> u64 {
    joints.iter().zip(ids).fold(joints.len() as u64, |sum, (constraint, ids)| {
        let [is_bounded, is_driven, is_row] = constraint.solver_properties().map(u64::from);
        let word = ids.joint.map_or(LOCK_HASH, JointId::to_bits).rotate_left(3)
            ^ (is_bounded << 2 | is_driven << 1 | is_row);
        let word = word ^ bodies_hash([ids.bodies.0, Some(ids.bodies.1)]);
        (sum.rotate_left(5) ^ word).wrapping_mul(0x9E37_79B9_7F4A_7C15)
    })
}

/// Converts a vector from the vector type of the public API to `f64`.
fn to_vec2(v: Vector2) -> Vec2 {
    [f64::from(v.x), f64::from(v.y)]
}

/// Converts a vector to the vector type of the public API.
fn to_vector2([x, y]: Vec2) -> Vector2 {
    Vector2::new(x as f32, y as f32)
}

/// Returns motor and limits of a joint as the solvers take them.
fn joint_drive(drive: &MotorAndLimits) -> JointDrive {
    JointDrive {
        motor: drive
            .motor()
            .map(|motor| Motor { speed: motor.speed, greatest_effort: motor.greatest_effort }),
        limits: drive.limits().map(|limits| Limits { lower: limits.lower, upper: limits.upper }),
        reference: drive.reference,
    }
}

/// Word that keeps the hash of a joint with a servo from that of a spring with the same id. Value chosen.
const SERVO_HASH: u64 = 0x5E12_0000_0000_5E12;

/// Word that stands for the id of a lock in hashes. Value chosen.
const LOCK_HASH: u64 = 0x10C4_0000_0000_10C4;

/// Returns a servo as the solvers take it; `None` if it exerts no force.
fn servo_row(servo: JointServo) -> Option<Servo> {
    let [target, stiffness, damping] = [servo.target, servo.stiffness, servo.damping].map(f64::from);
    let greatest_effort =
        if servo.greatest_effort < f32::MAX { servo.greatest_effort.into() } else { f64::INFINITY };
    (greatest_effort > 0.0 && stiffness + damping > 0.0).then_some(Servo {
        target,
        stiffness,
        damping,
        greatest_effort,
    })
}

/// Returns target and strength of a motor joint as the solvers take them.
fn pose_servo(joint: &MotorJoint) -> PoseServo {
    let servo = joint.servo();
    PoseServo {
        target_angle: joint.angle().into(),
        angular_frequency: std::f64::consts::TAU * f64::from(servo.frequency),
        damping_ratio: servo.damping_ratio.into(),
        greatest_force: servo.greatest_force.into(),
        greatest_torque: servo.greatest_torque.into(),
    }
}

/// The parts that the import of joints and springs reads.
#[derive(Clone, Copy)]
pub(crate) struct JointImport<'a> {
    /// Bodies of the game.
    pub(super) objects: &'a Bodies,
    /// Bodies of the solver.
    pub(super) bodies: &'a BodySet,
    pub(super) ids: &'a IdTable,
    pub(super) sleep: &'a SleepState,
    pub(super) depth: Option<FeatureGate<&'a DepthState>>,
}

impl<'a> JointImport<'a> {
    /// Returns the import from the bodies `objects` of the game to the `bodies` of the solver.
    pub(super) fn new(
        objects: &'a Bodies,
        (bodies, ids): (&'a BodySet, &'a IdTable),
        sleep: &'a SleepState,
        depth: Option<&'a FeatureGate<Box<DepthState>>>,
    ) -> Self {
        JointImport { objects, bodies, ids, sleep, depth: depth.map(FeatureGate::by_ref) }
    }

    /// Returns one side of a joint: the body `id` with the anchor `anchor`, or the world if `id` is `None`. Returns `None` if
    /// the body is gone.
    ///
    /// `anchor` is in local coordinates of the body, or in world coordinates for the world.
    pub(super) fn anchor(self, id: Option<BodyId>, anchor: Vector2) -> Option<JointAnchor> {
        let Some(id) = id else {
            return Some(JointAnchor { arm: to_vec2(anchor), ..JointAnchor::default() });
        };
        let body = &self.objects.get(id)?.body;
        let Some(index) = self.ids.body_index(id) else {
            let (sine, cosine) = scalar::sin_cos(body.rotation());
            let ([x, y], s, c) = (to_vec2(anchor), f64::from(sine), f64::from(cosine));
            let arm = [c * x - s * y, s * x + c * y];
            return Some(JointAnchor { position: to_vec2(body.position()), arm, ..JointAnchor::default() });
        };
        let is_dynamic = index < self.bodies.first_static()
            && self.bodies.inverse_mass_inertia[index] != [0.0; 2]
            && !self.sleep.is_asleep(index);
        let mut joint_anchor = JointAnchor {
            body: if is_dynamic { index } else { BodyIndex::PLACEHOLDER },
            pose_body: index,
            local_anchor: to_vec2(anchor),
            ..JointAnchor::default()
        };
        joint_anchor.update(self.bodies);
        Some(joint_anchor)
    }

    /// Returns a joint as a constraint at the present poses. Returns `None` if the joint is not active, because neither body is
    /// dynamic or a body is gone.
    fn active_constraint(self, joint: &Joint) -> Option<JointConstraint> {
        self.constraint(joint).filter(|constraint| constraint.anchors[0].body != constraint.anchors[1].body)
    }

    /// Returns a joint as a constraint at the present poses, whether its bodies are dynamic or not; `None` if a body is gone.
    fn constraint(self, joint: &Joint) -> Option<JointConstraint> {
        let spec = joint.constraint_spec();
        let anchors = [
            self.anchor(spec.bodies.0, spec.anchors[0])?,
            self.anchor(Some(spec.bodies.1), spec.anchors[1])?,
        ];
        let locked = match spec.keeps {
            ConstraintSpecKind::Point => LockedDofs::Point,
            ConstraintSpecKind::PointAndAngle => LockedDofs::Weld,
            ConstraintSpecKind::Angle => LockedDofs::Angle,
            ConstraintSpecKind::Distance => LockedDofs::Distance,
            ConstraintSpecKind::Line => LockedDofs::Line,
            ConstraintSpecKind::PointOnLine => LockedDofs::PointOnLine,
            ConstraintSpecKind::Nothing => LockedDofs::Unlocked,
            ConstraintSpecKind::Gear => LockedDofs::Gear,
            ConstraintSpecKind::Pulley => LockedDofs::Pulley,
        };
        let can_be_soft = matches!(locked, LockedDofs::Point | LockedDofs::Distance);
        let softness = if can_be_soft { f64::from(joint.softness()) } else { 0.0 };
        let mut constraint = JointConstraint {
            local_axis: to_vec2(spec.axis),
            ratio: spec.ratio.into(),
            pulleys: spec.pulleys.map(to_vec2),
            drive: spec.drive.as_ref().map(joint_drive),
            range: spec.range.map(f64::from),
            slop: f64::from(spec.slop).max(0.0),
            softness: softness.max(0.0),
            // A larger factor would overcorrect, so that the next update has to correct back.
            bias_factor: f64::from(joint.bias_factor()).clamp(0.0, 1.0),
            depth_offset: self.depth_offset(locked, spec.bodies),
            force: joint.force_and_torque(),
            force_along_depth: joint.force_along_depth(),
            ..JointConstraint::new(locked, anchors, f64::from(spec.most).abs())
        };
        self.read_pose(spec.bodies, &mut constraint);
        Some(constraint)
    }

    /// Sets the angle of the second body minus that of the first times the ratio (radians) and the world axis of a prismatic joint from the
    /// poses of its `bodies`.
    fn read_pose(self, bodies: (Option<BodyId>, BodyId), constraint: &mut JointConstraint) {
        let rotation_of =
            |id: BodyId| self.objects.get(id).map_or(0.0, |entry| f64::from(entry.body.total_rotation()));
        if constraint.locked == LockedDofs::Gear {
            let unwrapped =
                |id: BodyId| self.objects.get(id).map_or(0.0, |entry| entry.body.unwrapped_rotation());
            constraint.angle = unwrapped(bodies.1) - constraint.ratio * bodies.0.map_or(0.0, unwrapped);
        } else if constraint.has_angle() {
            constraint.angle = rotation_of(bodies.1) - bodies.0.map_or(0.0, rotation_of);
        }
        if constraint.locked.has_axis()
            && let Some(entry) = bodies.0.and_then(|id| self.objects.get(id))
        {
            constraint.set_axis(entry.body.rotation());
        }
    }

    /// Returns the distance along the depth axis from the first body of a distance joint to the second, in length units; 0 for
    /// other joints.
    fn depth_offset(self, locked: LockedDofs, bodies: (Option<BodyId>, BodyId)) -> f64 {
        match (locked, self.depth, bodies) {
            (LockedDofs::Distance, Some(space), (Some(first), second)) => {
                f64::from(-space.relative_z_and_velocity(first.slot(), second.slot())[0])
            }
            _ => 0.0,
        }
    }

    /// Returns the position error of a joint: length units; radians for a joint that locks an angle alone. Returns `None` if
    /// the joint is not active, because no body is dynamic and awake or a body is gone.
    pub(crate) fn joint_error(self, joint: &Joint) -> Option<f32> {
        Some(self.active_constraint(joint)?.compute_error() as f32)
    }

    /// Returns the position error of a joint, whether its bodies sleep or not: length units; radians for a joint that locks an
    /// angle alone. Returns `None` if a body is gone.
    pub(super) fn joint_error_even_asleep(self, joint: &Joint) -> Option<f32> {
        Some(self.constraint(joint)?.compute_error() as f32)
    }

    /// Imports the joints and builds the articulations, if a joint or a body with joints was edited.
    ///
    /// The locked axes of bodies become joints to the world, after all others.
    pub(super) fn reimport_joints(
        self,
        table: &mut JointTable,
        joints: &mut JointSystem,
        (objects, locks): (&Objects, &mut AxisLocks),
    ) {
        if table.is_imported {
            return;
        }
        table.ids.clear();
        let all = (0..objects.joints.list().len()).filter_map(|at| objects.joints.at(at));
        let enabled = all.filter(|(_, joint)| joint.enabled());
        table.may_break = enabled.clone().any(|(_, joint)| joint.breakpoint() != f32::MAX);
        let active = enabled.filter_map(|(id, joint)| {
            let mut constraint = self.active_constraint(joint)?;
            if constraint.locked == LockedDofs::Unlocked {
                // Servos read the anchors of such a joint in each step, since a game may move them without a new import.
                constraint.clear_arms();
            }
            table.ids.push(JointIds { joint: Some(id), bodies: joint.constraint_spec().bodies });
            Some(constraint)
        });
        let mut active: Vec<JointConstraint> = active.collect();
        for &(id, axes) in locks.living(objects) {
            let body = self.anchor(Some(id), Vector2::zeros());
            if let Some(body) = body.filter(|body| body.body != BodyIndex::PLACEHOLDER) {
                active.push(lock_constraint(body, axes));
                table.ids.push(JointIds { joint: None, bodies: (None, id) });
            }
        }
        let count = active.len();
        joints.replace(active.into_iter(), count, self.bodies, self.depth.is_some());
        table.servos.clear();
        let has_servo = |ids: &JointIds| ids.joint_of(objects).is_some_and(Joint::has_servo);
        let with_servo = table.ids.iter().enumerate().filter(|(_, ids)| has_servo(ids));
        table.servos.extend(with_servo.map(|(at, _)| JointIndex::new(at)));
        table.signature = joints_hash(joints.constraints(), &table.ids);
        (table.is_imported, table.are_indices_new) = (true, true);
    }

    /// Adds the servos of joints to `springs`, at the poses of this step. Returns a hash of the joints with servos and of the number
    /// of rows of each, by which islands list their rows anew; 0 without servos (multiplicative hashing). A servo without effort
    /// has no row, and a motor joint at the bound of its force has one row less.
    pub(super) fn add_servos(
        self,
        table: &JointTable,
        springs: &mut SpringRows,
        (objects, step): (&Objects, &StepContext),
    ) -> u64 {
        let mut signature = 0_u64;
        for &at in &table.servos {
            let ids = &table.ids[at.position()];
            let (Some(id), Some(joint)) = (ids.joint, ids.joint_of(objects)) else { continue };
            let Some(constraint) = self.constraint(joint) else { continue };
            let count_before = springs.count();
            if let JointKind::Motor(motor) = joint.kind() {
                pose_servo(motor).add_springs(springs, at, &constraint, (self.bodies, step.substeps.into()));
            } else if let Some(drive) = joint.motor_and_limits()
                && let Some(servo) = drive.servo().and_then(servo_row)
            {
                springs.push(SpringConstraint::of_servo(at, &constraint, servo, drive.reference.into()));
            }
            let row_count = (springs.count() - count_before) as u64;
            signature = (signature.rotate_left(5) ^ id.to_bits() ^ SERVO_HASH)
                .wrapping_add(1 + row_count)
                .wrapping_mul(0x9E37_79B9_7F4A_7C15);
        }
        signature
    }

    /// Moves the joint constraints to the poses of this step, and prepares their solvers. `is_touched` returns whether contacts
    /// or springs act on a body; it is `None` if there are neither.
    pub(super) fn prepare_joints(
        self,
        JointTable { ids, .. }: &JointTable,
        joints: &mut JointSystem,
        objects: &Objects,
        step: &StepContext,
        is_touched: Option<impl Fn(BodyIndex) -> bool>,
    ) {
        if self.depth.is_some() {
            for (constraint, ids) in joints.constraints_mut().iter_mut().zip(ids) {
                if constraint.locked == LockedDofs::Distance {
                    constraint.depth_offset = self.depth_offset(LockedDofs::Distance, ids.bodies);
                }
            }
        }
        let read = |at: JointIndex, constraint: &mut JointConstraint| {
            let ids = &ids[at.position()];
            if constraint.is_axis_lock {
                return begin_lock(constraint);
            }
            self.read_pose(ids.bodies, constraint);
            // The target of a motor may change in every step without a new import.
            if constraint.drive.is_some() {
                let drive = ids.joint_of(objects).and_then(Joint::motor_and_limits);
                constraint.drive = drive.map(joint_drive).or(constraint.drive);
            }
        };
        joints.prepare(self.bodies, is_touched.as_ref(), read);
        if let Some(space) = self.depth {
            let depth_of = |at: JointIndex, side: usize| match (side, ids[at.position()].bodies) {
                (0, (None, _)) => 0.0,
                (0, (Some(body), _)) | (_, (_, body)) => space.z_and_velocity(body.slot())[0],
            };
            let is_touched = |body| is_touched.as_ref().is_some_and(|is_touched| is_touched(body));
            joints.prepare_spatial(self.bodies, step, is_touched, read, depth_of);
        }
    }
}

/// Writes error, anchors and force to the joints in `objects`. Joints whose load exceeds their greatest force or torque break,
/// and `report` gets an event for each.
pub(super) fn export_joints(
    table: &mut JointTable,
    joints: &mut JointSystem,
    objects: &mut Objects,
    report: &mut Report,
) {
    for (constraint, ids) in joints.constraints_mut().iter_mut().zip(&table.ids) {
        let (Some(id), Some(joint)) = (ids.joint, ids.joint.and_then(|id| objects.joints.get_mut(id))) else {
            continue;
        };
        joint.set_error(constraint.error);
        joint.store_world_anchors(constraint.first_arm.map(|component| component as f32), || {
            constraint.anchors.map(|anchor| [to_vector2(anchor.arm), to_vector2(anchor.anchor_position())])
        });
        let mean = constraint.mean_force.take();
        let others = (&mut constraint.force_along_depth, constraint.servo_force);
        if joint.store_load(&mut constraint.force, mean, others) {
            report.push(Event::JointBroke { joint: id });
            (table.is_imported, table.are_bodies_separated) = (false, false);
        }
    }
}
