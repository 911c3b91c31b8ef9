//! Joint solver of the faithful set: sequential impulses, joint by joint (behaviour chapter 10, section 4).

use crate::body::entry::Bodies;
use crate::body::{Body, BodyId};
use crate::contact_solver::{SolverBodies, SolverBody, SolverBodyIndex};
use crate::joints::joint_body::{JointBodies, JointBody, JointPose};
use crate::joints::{Joint, JointId, Joints};
use crate::math::Vector2;
use crate::report::{Event, Report};
use farseer_precise::reusing_clone;

/// State of the joints in one update, by their positions in the list.
#[derive(Debug, Default)]
pub(crate) struct SequentialJointSolver {
    solved_joints: Vec<SolvedJoint>,
    /// Whether the solver's indices of the bodies are known: from the first iteration after the pre-step on.
    are_indexed: bool,
    /// Whether bodies have the velocities that they have in the solver.
    velocities_are_stored: bool,
}

reusing_clone! { SequentialJointSolver { solved_joints, are_indexed, velocities_are_stored } }

/// State of one joint in an update.
#[derive(Debug, Clone, Copy, Default)]
struct SolvedJoint {
    /// Indices of its bodies in the solver; the same twice for a joint on one body.
    bodies: [SolverBodyIndex; 2],
    is_static: [bool; 2],
    /// Whether the joint is solved: it is enabled, and its bodies let it act.
    is_active: bool,
    /// Whether the joint is skipped for the rest of this update, because it would have made a velocity infinite or NaN.
    is_dropped: bool,
}

impl SolvedJoint {
    fn is_one_body(&self) -> bool {
        self.bodies[0] == self.bodies[1]
    }
}

fn pose_of(body: &Body) -> JointPose {
    let (position, rotation, total_rotation) = (body.position(), body.rotation(), body.total_rotation());
    JointPose { position, rotation, total_rotation }
}

fn state_of(body: &Body) -> JointBody {
    JointBody {
        velocity: body.linear_velocity,
        angular_velocity: body.angular_velocity,
        inverse_mass: body.inverse_mass,
        inverse_inertia: body.inverse_moment_of_inertia,
        is_static: body.is_immovable(),
    }
}

fn set_velocity(body: &mut Body, state: &JointBody) {
    body.linear_velocity = state.velocity;
    body.angular_velocity = state.angular_velocity;
}

#[inline]
fn joint_bodies([one, two]: [JointBody; 2], are_one: bool) -> JointBodies {
    if are_one { JointBodies::one(one) } else { JointBodies::two(one, two) }
}

/// Whether a joint acts (behaviour chapter 10, section 4): not all bodies are immovable, and not all are disabled.
fn may_act(bodies: [&Body; 2]) -> bool {
    bodies.iter().any(|body| !body.is_immovable()) && bodies.iter().any(|body| body.enabled())
}

/// The bodies of a joint; the same twice for a joint on one body.
fn bodies_of(joint: &Joint) -> [BodyId; 2] {
    [joint.body1(), joint.body2().unwrap_or(joint.body1())]
}

impl SequentialJointSolver {
    /// Pre-step in list order: errors, effective masses and the warm start.
    pub(crate) fn pre_step(
        &mut self,
        inverse_dt: f32,
        joints: &mut Joints,
        bodies: &mut Bodies,
        report: &mut Report,
    ) {
        self.are_indexed = false;
        self.solved_joints.clear();
        for position in 0..joints.list().len() {
            let solved_joint = pre_step_joint(position, inverse_dt, joints, bodies, report);
            self.solved_joints.push(solved_joint.unwrap_or_default());
        }
    }

    /// In the first iteration, finds the bodies of the joints in the solver. Bodies without contacts are added to it.
    pub(crate) fn begin_iteration(&mut self, joints: &Joints, bodies: &Bodies, solved: &mut SolverBodies) {
        if std::mem::replace(&mut self.are_indexed, true) {
            return;
        }
        for (position, solved_joint) in self.solved_joints.iter_mut().enumerate() {
            let Some((_, joint)) = joints.at(position).filter(|_| solved_joint.is_active) else { continue };
            match bodies_of(joint).map(|id| solved.index_of(id, bodies)) {
                [Some(one), Some(two)] => solved_joint.bodies = [one, two],
                _ => solved_joint.is_active = false,
            }
        }
    }

    /// Number of joints in an iteration.
    pub(crate) fn count(&self) -> usize {
        self.solved_joints.len()
    }

    /// Solves the joint at a position once, also if its own callback has just disposed it. Returns whether it has
    /// acted.
    pub(crate) fn solve(
        &mut self,
        (position, id): (usize, JointId),
        joints: &mut Joints,
        bodies: &mut Bodies,
        solved: &mut SolverBodies,
        report: &mut Report,
    ) -> bool {
        let solved_joint = self.solved_joints[position];
        let Some(joint) = joints.get_mut(id).filter(|_| solved_joint.is_active && !solved_joint.is_dropped)
        else {
            return false;
        };
        let states = solved_joint.bodies.map(|place| solved.body(place));
        let mut changed = joint_bodies(
            [0, 1].map(|i| joint_body(&states[i], solved_joint.is_static[i])),
            solved_joint.is_one_body(),
        );
        let has_acted = joint.solve(&mut changed);
        if !changed.is_finite() {
            joint.forget_impulse();
            self.solved_joints[position].is_dropped = true;
            report.push(Event::JointNotFinite { joint: id });
            return false;
        }
        for (body, state) in [(1, changed.second()), (0, changed.first())] {
            let velocity = [state.velocity.x, state.velocity.y, state.angular_velocity];
            solved.set_body(solved_joint.bodies[body], &SolverBody { velocity, ..states[body] });
            if self.velocities_are_stored {
                solved.store_velocity(solved_joint.bodies[body], bodies);
            }
        }
        has_acted
    }

    pub(crate) fn end_iteration(&mut self) {
        self.velocities_are_stored = false;
    }

    /// Gives the bodies the solver's velocities before a callback in the middle of an iteration. Only the first call
    /// per iteration does so. Edited velocities return to the solver when edits are applied.
    pub(crate) fn store_velocities(&mut self, bodies: &mut Bodies, solved: &SolverBodies) {
        if !std::mem::replace(&mut self.velocities_are_stored, true) {
            solved.store_velocities(bodies);
        }
    }

    /// Copies the velocity of a body to the solver that a callback during an iteration has edited.
    pub(crate) fn load_velocity(&self, body: BodyId, bodies: &Bodies, solved: &mut SolverBodies) {
        if self.velocities_are_stored {
            solved.load_velocity(body, bodies);
        }
    }
}

/// Pre-step of one joint; `None` if it was disposed, or one of its bodies is gone.
fn pre_step_joint(
    position: usize,
    inverse_dt: f32,
    joints: &mut Joints,
    all: &mut Bodies,
    report: &mut Report,
) -> Option<SolvedJoint> {
    let (id, joint) = joints.at_mut(position)?;
    let ids = bodies_of(joint);
    let bodies = [&all.get(ids[0])?.body, &all.get(ids[1])?.body];
    let mut solved_joint = SolvedJoint {
        is_static: bodies.map(|body| body.is_immovable()),
        is_active: may_act(bodies),
        ..SolvedJoint::default()
    };
    if !(solved_joint.is_active && joint.enabled()) {
        return Some(solved_joint);
    }
    let mut changed = joint_bodies(bodies.map(state_of), ids[0] == ids[1]);
    joint.pre_step(inverse_dt, &bodies.map(pose_of), &mut changed);
    if changed.is_finite() {
        // The first body is stored last: if both are one body, the joint worked on the first copy.
        for (id, state) in [(ids[1], changed.second()), (ids[0], changed.first())] {
            set_velocity(&mut all[id].body, state);
        }
    } else {
        joint.forget_impulse();
        solved_joint.is_dropped = true;
        report.push(Event::JointNotFinite { joint: id });
    }
    Some(solved_joint)
}

fn joint_body(state: &SolverBody, is_static: bool) -> JointBody {
    let SolverBody { velocity: [x, y, w], inverse_mass, inverse_inertia, .. } = *state;
    JointBody { velocity: Vector2::new(x, y), angular_velocity: w, inverse_mass, inverse_inertia, is_static }
}
