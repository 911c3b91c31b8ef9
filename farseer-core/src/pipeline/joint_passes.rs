//! The joints' part of an update (behaviour chapter 10, section 4).

use crate::body::Body;
use crate::body::BodyId;
use crate::body::entry::Bodies;
use crate::joints::joint_body::{JointBodies, JointBody, JointPose};
use crate::joints::{Joint, JointId, Joints};
use crate::math::Vector2;
use crate::report::{Event, Report};
use crate::solve::{SolverBodies, SolverBody, SolverPlace};
use crate::storage::reusing_clone::reusing_clone;

/// What the passes of an update know of the joints in the list, by its positions.
#[derive(Debug, Default)]
pub(crate) struct JointPasses {
    seats: Vec<Seat>,
    /// The places are known: a pass has begun since the pre-step.
    are_placed: bool,
    /// Bodies have the velocities that they have in the solver.
    velocities_are_down: bool,
}

reusing_clone! { JointPasses { seats, are_placed, velocities_are_down } }

/// A joint in the passes of an update.
#[derive(Debug, Clone, Copy, Default)]
struct Seat {
    /// Where its bodies are in the solver; twice the same for a joint on one body.
    places: [SolverPlace; 2],
    is_static: [bool; 2],
    /// It is enabled, and its bodies let it act.
    is_due: bool,
    /// It would have made a velocity infinite or NaN, and is out of this update.
    is_dropped: bool,
}

impl Seat {
    fn is_one_body(&self) -> bool {
        self.places[0] == self.places[1]
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

/// The gate of behaviour chapter 10, section 4: not all bodies are immovable, and not all are disabled.
fn may_act(bodies: [&Body; 2]) -> bool {
    bodies.iter().any(|body| !body.is_immovable()) && bodies.iter().any(|body| body.enabled())
}

/// The bodies of a joint; twice the same for a joint on one body.
fn bodies_of(joint: &Joint) -> [BodyId; 2] {
    [joint.body1(), joint.body2().unwrap_or(joint.body1())]
}

impl JointPasses {
    /// Joints in list order: errors and masses, and the impulses of the last update act again.
    pub(crate) fn pre_step(
        &mut self,
        inverse_dt: f32,
        joints: &mut Joints,
        bodies: &mut Bodies,
        report: &mut Report,
    ) {
        self.are_placed = false;
        self.seats.clear();
        for position in 0..joints.list().len() {
            let seat = pre_step_joint(position, inverse_dt, joints, bodies, report);
            self.seats.push(seat.unwrap_or_default());
        }
    }

    /// Finds the bodies of the joints in the solver, if it is the first pass. Those that touch nothing are taken in.
    pub(crate) fn begin_pass(&mut self, joints: &Joints, bodies: &Bodies, solved: &mut SolverBodies) {
        if std::mem::replace(&mut self.are_placed, true) {
            return;
        }
        for (position, seat) in self.seats.iter_mut().enumerate() {
            let Some((_, joint)) = joints.at(position).filter(|_| seat.is_due) else { continue };
            match bodies_of(joint).map(|id| solved.place(id, bodies)) {
                [Some(one), Some(two)] => seat.places = [one, two],
                _ => seat.is_due = false,
            }
        }
    }

    /// Number of joints in a pass.
    pub(crate) fn count(&self) -> usize {
        self.seats.len()
    }

    /// One pass of the joint at a position, also if its own callback has just disposed it. Answers whether it has acted.
    pub(crate) fn solve(
        &mut self,
        (position, id): (usize, JointId),
        joints: &mut Joints,
        bodies: &mut Bodies,
        solved: &mut SolverBodies,
        report: &mut Report,
    ) -> bool {
        let seat = self.seats[position];
        let Some(joint) = joints.get_mut(id).filter(|_| seat.is_due && !seat.is_dropped) else {
            return false;
        };
        let states = seat.places.map(|place| solved.body(place));
        let mut changed =
            joint_bodies([0, 1].map(|i| joint_body(&states[i], seat.is_static[i])), seat.is_one_body());
        let has_acted = joint.solve(&mut changed);
        if !changed.is_finite() {
            joint.forget_impulse();
            self.seats[position].is_dropped = true;
            report.push(Event::JointNotFinite { joint: id });
            return false;
        }
        for (body, state) in [(1, changed.second()), (0, changed.first())] {
            let velocity = [state.velocity.x, state.velocity.y, state.angular_velocity];
            solved.set_body(seat.places[body], &SolverBody { velocity, ..states[body] });
            if self.velocities_are_down {
                solved.put_velocity_down(seat.places[body], bodies);
            }
        }
        has_acted
    }

    pub(crate) fn end_pass(&mut self) {
        self.velocities_are_down = false;
    }

    /// Before somebody looks in the middle of a pass: from the first time to the end of the pass the bodies have the
    /// velocities that the solver has. What is edited is taken up when edits settle.
    pub(crate) fn put_velocities_down(&mut self, bodies: &mut Bodies, solved: &SolverBodies) {
        if !std::mem::replace(&mut self.velocities_are_down, true) {
            solved.put_velocities_down(bodies);
        }
    }

    /// Lets the solver go on with the velocity of a body that a callback in the middle of a pass has edited.
    pub(crate) fn take_velocity_up(&self, body: BodyId, bodies: &Bodies, solved: &mut SolverBodies) {
        if self.velocities_are_down {
            solved.take_velocity_up(body, bodies);
        }
    }
}

/// `None` for a joint that was disposed, or one of whose bodies is gone.
fn pre_step_joint(
    position: usize,
    inverse_dt: f32,
    joints: &mut Joints,
    all: &mut Bodies,
    report: &mut Report,
) -> Option<Seat> {
    let (id, joint) = joints.at_mut(position)?;
    let ids = bodies_of(joint);
    let bodies = [&all.get(ids[0])?.body, &all.get(ids[1])?.body];
    let mut seat = Seat {
        is_static: bodies.map(|body| body.is_immovable()),
        is_due: may_act(bodies),
        ..Seat::default()
    };
    if !(seat.is_due && joint.enabled()) {
        return Some(seat);
    }
    let mut changed = joint_bodies(bodies.map(state_of), ids[0] == ids[1]);
    joint.pre_step(inverse_dt, &bodies.map(pose_of), &mut changed);
    if changed.is_finite() {
        // The first last: where both are one body, its copy is the one that was worked on.
        for (id, state) in [(ids[1], changed.second()), (ids[0], changed.first())] {
            set_velocity(&mut all[id].body, state);
        }
    } else {
        joint.forget_impulse();
        seat.is_dropped = true;
        report.push(Event::JointNotFinite { joint: id });
    }
    Some(seat)
}

fn joint_body(state: &SolverBody, is_static: bool) -> JointBody {
    let SolverBody { velocity: [x, y, w], inverse_mass, inverse_inertia, .. } = *state;
    JointBody { velocity: Vector2::new(x, y), angular_velocity: w, inverse_mass, inverse_inertia, is_static }
}
