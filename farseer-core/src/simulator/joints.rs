//! Joints in the simulator: who they hold together, and when they act (behaviour chapter 10).

use super::PhysicsSimulator;
use super::queues::Handler;
use crate::arena::Arena;
use crate::body::{Body, BodyId};
use crate::body_entry::BodyEntry;
use crate::error::{Error, Result, finite_vector};
use crate::events::{Context, Event, EventHandler};
use crate::joints::joint_body::{JointBodies, JointBody, JointPose};
use crate::joints::{Joint, JointId, JointKind, JointType};
use crate::math::Vector2;
use crate::nobody::{check_bodies, nobody};
use crate::solver::{SolverBody, SolverPlace};

/// Joints.
impl PhysicsSimulator {
    /// Takes a joint in. It acts after it was [added](Self::add).
    ///
    /// # Errors
    /// A body that is stale.
    pub(crate) fn create_joint(&mut self, joint: Joint) -> Result<JointId> {
        self.check_body("body1", joint.body1())?;
        joint.body2().map_or(Ok(()), |body| self.check_body("body2", body))?;
        Ok(self.joints.create(joint))
    }

    /// Makes a joint of a kind that holds nothing yet, as the original's constructors without arguments do: for what is
    /// read from a file one value after the other. Bodies are set by [`set_joint_body1`](Self::set_joint_body1) (also
    /// the only one) and [`set_joint_body2`](Self::set_joint_body2); an anchor after the bodies it is on. Until they are
    /// set, anchors are the bodies' origins, and angles, limits and distances are 0. Everything else has the default of
    /// its kind. The joint can be [added](Self::add) once it has its bodies.
    ///
    /// ```
    /// use farseer_core::math::Vector2;
    /// use farseer_core::{Body, Error, PhysicsSimulator, RevoluteJoint};
    /// let mut simulator = PhysicsSimulator::default();
    /// let (arm, hand) = (simulator.create_body(Body::new()), simulator.create_body(Body::new()));
    /// let wrist = simulator.create_empty_joint::<RevoluteJoint>();
    /// simulator.set_joint_body1(wrist, arm)?;
    /// assert_eq!(simulator.add(wrist), Err(Error::MissingBody { argument: "joint", missing: "body2" }));
    /// simulator.set_joint_body2(wrist, hand)?;
    /// simulator.set_joint_anchor(wrist, Vector2::new(20.0, 0.0))?;
    /// simulator[wrist].set_softness(0.1)?;
    /// simulator.add(wrist)?;
    /// # Ok::<(), Error>(())
    /// ```
    #[doc(alias(
        "AngleJoint()",
        "AngleLimitJoint()",
        "FixedAngleJoint()",
        "FixedAngleLimitJoint()",
        "FixedRevoluteJoint()",
        "PinJoint()",
        "RevoluteJoint()",
        "SliderJoint()",
        "WeldJoint()"
    ))]
    pub fn create_empty_joint<J: JointType>(&mut self) -> JointId {
        self.joints.create(J::without_bodies())
    }

    /// A joint, unless the id is stale.
    #[inline]
    pub fn joint(&self, joint: JointId) -> Option<&Joint> {
        self.joints.get(joint)
    }

    /// A joint to edit, unless the id is stale.
    #[inline]
    pub fn joint_mut(&mut self, joint: JointId) -> Option<&mut Joint> {
        self.joints.get_mut(joint)
    }

    /// A joint as what it is: `simulator.joint_as::<PinJoint>(joint)?.target_distance()`.
    ///
    /// # Errors
    /// A stale id; a joint of another kind.
    pub fn joint_as<J: JointType>(&self, joint: JointId) -> Result<&J> {
        let argument = "joint";
        J::of(self.joints.find(argument, joint)?).ok_or(Error::WrongKind { argument, expected: J::NAME })
    }

    /// A joint as what it is, to edit.
    ///
    /// # Errors
    /// A stale id; a joint of another kind.
    pub fn joint_as_mut<J: JointType>(&mut self, joint: JointId) -> Result<&mut J> {
        let argument = "joint";
        J::of_mut(self.joints.find_mut(argument, joint)?)
            .ok_or(Error::WrongKind { argument, expected: J::NAME })
    }

    /// The joints that take part, in the order in which they were added.
    #[doc(alias = "JointList")]
    pub fn joint_list(&self) -> &[JointId] {
        self.joints.list()
    }

    /// Lets a joint hold another body, its first or only one; anchors and impulses stay what they are.
    ///
    /// # Errors
    /// A stale id.
    #[doc(alias("Body1", "FixedRevoluteJoint.Body", "FixedAngleJoint.Body", "FixedAngleLimitJoint.Body"))]
    pub fn set_joint_body1(&mut self, joint: JointId, body: BodyId) -> Result<()> {
        self.check_body("body", body)?;
        self.joints.find_mut("joint", joint)?.set_body1(body);
        Ok(())
    }

    /// Lets a joint between two bodies hold another second body; anchors and impulses stay what they are.
    ///
    /// # Errors
    /// A stale id; a joint on one body.
    #[doc(alias = "Body2")]
    pub fn set_joint_body2(&mut self, joint: JointId, body: BodyId) -> Result<()> {
        self.check_body("body", body)?;
        let changed = self.joints.find_mut("joint", joint)?;
        if changed.body2().is_none() {
            return Err(Error::WrongKind { argument: "joint", expected: "joint between two bodies" });
        }
        changed.set_body2(body);
        Ok(())
    }

    /// Moves the anchor of a revolute, fixed revolute or weld joint to a point of the world; the bodies hold on to it
    /// where they are now.
    ///
    /// # Errors
    /// A stale id; a body that was not set yet; a point that is not finite, or too far from the bodies for finite arms; a
    /// joint of another kind.
    #[doc(alias("Anchor", "SetAnchor", "SetInitialAnchor"))]
    pub fn set_joint_anchor(&mut self, joint: JointId, anchor: Vector2) -> Result<()> {
        let (joint, body1, body2) = self.joint_and_bodies(joint)?;
        match joint.kind_mut() {
            JointKind::Revolute(joint) => joint.set_anchor(anchor, body1, body2),
            JointKind::FixedRevolute(joint) => joint.set_anchor(anchor, body1),
            JointKind::Weld(joint) => joint.set_anchor(anchor, body1, body2),
            _ => Err(wrong_kind("RevoluteJoint, FixedRevoluteJoint or WeldJoint")),
        }
    }

    /// Moves the anchor of a pin or slider joint on its first body to a point in the coordinates of that body. The
    /// target distance stays.
    ///
    /// # Errors
    /// A stale id; a body that was not set yet; a point that is not finite, or not in the world; a joint of another kind.
    #[doc(alias = "Anchor1")]
    pub fn set_joint_anchor1(&mut self, joint: JointId, anchor: Vector2) -> Result<()> {
        let joint = self.joints.find_mut("joint", joint)?;
        let body1 = held_body(&self.bodies, "body1", joint.body1());
        match joint.kind_mut() {
            JointKind::Pin(joint) => joint.set_anchor1(anchor, body1?),
            JointKind::Slider(joint) => joint.set_anchor1(anchor, body1?),
            _ => Err(wrong_kind("PinJoint or SliderJoint")),
        }
    }

    /// Moves the anchor of a pin or slider joint on its second body to a point in the coordinates of that body. The
    /// target distance stays.
    ///
    /// # Errors
    /// A stale id; a body that was not set yet; a point that is not finite, or not in the world; a joint of another kind.
    #[doc(alias = "Anchor2")]
    pub fn set_joint_anchor2(&mut self, joint: JointId, anchor: Vector2) -> Result<()> {
        let joint = self.joints.find_mut("joint", joint)?;
        let body2 = held_body(&self.bodies, "body2", joint.body2().unwrap_or(joint.body1()));
        match joint.kind_mut() {
            JointKind::Pin(joint) => joint.set_anchor2(anchor, body2?),
            JointKind::Slider(joint) => joint.set_anchor2(anchor, body2?),
            _ => Err(wrong_kind("PinJoint or SliderJoint")),
        }
    }

    /// Where the anchor of a revolute, weld or slider joint is on its first body: the body's position now, and the arm
    /// of the last update. Before the first update a revolute or weld joint has no arm.
    ///
    /// # Errors
    /// A stale id; a body that was not set yet; a joint of another kind; an anchor that is so far away that it is not
    /// finite.
    #[doc(alias("CurrentAnchor", "CurrentAnchorPosition"))]
    pub fn joint_current_anchor(&self, joint: JointId) -> Result<Vector2> {
        let joint = self.joints.find("joint", joint)?;
        let body1 = held_body(&self.bodies, "body1", joint.body1())?;
        let anchor = match joint.kind() {
            JointKind::Revolute(joint) => joint.current_anchor(body1),
            JointKind::Weld(joint) => joint.current_anchor(body1),
            JointKind::Slider(joint) => joint.current_anchor(body1),
            _ => return Err(wrong_kind("RevoluteJoint, WeldJoint or SliderJoint")),
        };
        finite_vector("joint", anchor)
    }

    /// A joint with its bodies; twice the same body if it has one.
    fn joint_and_bodies(&mut self, joint: JointId) -> Result<(&mut Joint, &Body, &Body)> {
        let joint = self.joints.find_mut("joint", joint)?;
        check_bodies("joint", joint.body1(), joint.body2())?;
        let body1 = held_body(&self.bodies, "body1", joint.body1())?;
        let body2 = held_body(&self.bodies, "body2", joint.body2().unwrap_or(joint.body1()))?;
        Ok((joint, body1, body2))
    }

    /// Refuses a joint that was made without its bodies and has not been given them all.
    pub(super) fn check_joint_bodies(&self, joint: JointId) -> Result<()> {
        let joint = self.joints.find("joint", joint)?;
        check_bodies("joint", joint.body1(), joint.body2())
    }

    /// Joints whose body is disposed or gone are disposed.
    pub(super) fn dispose_joints_without_body(&mut self) {
        for position in 0..self.joints.list().len() {
            let Some((id, joint)) = self.joints.at(position) else { continue };
            let bodies = [Some(joint.body1()), joint.body2()];
            if bodies.into_iter().flatten().any(|body| self.is_disposed(body)) {
                self.joints.dispose("joint", id).expect("a listed joint is there");
            }
        }
    }
}

/// A body that a joint holds, whether or not it has the other one.
fn held_body<'a>(bodies: &'a Arena<BodyEntry>, missing: &'static str, body: BodyId) -> Result<&'a Body> {
    if body == nobody() {
        return Err(Error::MissingBody { argument: "joint", missing });
    }
    let entry = bodies.get(body).ok_or(Error::StaleId { argument: "body of the joint" })?;
    Ok(&entry.body)
}

fn wrong_kind(expected: &'static str) -> Error {
    Error::WrongKind { argument: "joint", expected }
}

/// What the passes of an update know of the joints in the list, by its positions.
#[derive(Debug, Clone, Default)]
pub(super) struct JointPasses {
    seats: Vec<Seat>,
    /// The places are known: a pass has begun since the pre-step.
    are_placed: bool,
    /// Bodies have the velocities that they have in the solver.
    velocities_are_down: bool,
}

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
        is_static: body.is_static(),
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

/// The gate of behaviour chapter 10, section 4: not all bodies are static, and not all are disabled.
fn may_act(bodies: [&Body; 2]) -> bool {
    bodies.iter().any(|body| !body.is_static()) && bodies.iter().any(|body| body.enabled())
}

/// The joints' part of an update.
impl PhysicsSimulator {
    /// Joints in list order: errors and masses, and the impulses of the last update act again.
    pub(super) fn pre_step_joints(&mut self, inverse_dt: f32) {
        self.joint_passes.are_placed = false;
        self.joint_passes.seats.clear();
        for position in 0..self.joints.list().len() {
            let seat = self.pre_step_joint(position, inverse_dt).unwrap_or_default();
            self.joint_passes.seats.push(seat);
        }
    }

    /// `None` for a joint that was disposed, or one of whose bodies is gone.
    fn pre_step_joint(&mut self, position: usize, inverse_dt: f32) -> Option<Seat> {
        let (id, joint) = self.joints.at_mut(position)?;
        let ids = [joint.body1(), joint.body2().unwrap_or(joint.body1())];
        let bodies = [&self.bodies.get(ids[0])?.body, &self.bodies.get(ids[1])?.body];
        let mut seat = Seat {
            is_static: bodies.map(|body| body.is_static()),
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
                set_velocity(&mut self.bodies[id].body, state);
            }
        } else {
            joint.forget_impulse();
            seat.is_dropped = true;
            self.events.push(Event::JointNotFinite { joint: id });
        }
        Some(seat)
    }

    /// Finds the bodies of the joints in the solver. Those that touch nothing are taken in.
    fn place_joints(&mut self) {
        self.joint_passes.are_placed = true;
        for position in 0..self.joint_passes.seats.len() {
            let seat = &mut self.joint_passes.seats[position];
            let Some((_, joint)) = self.joints.at(position).filter(|_| seat.is_due) else { continue };
            let ids = [joint.body1(), joint.body2().unwrap_or(joint.body1())];
            match ids.map(|id| self.solver.place(id, &self.bodies)) {
                [Some(one), Some(two)] => seat.places = [one, two],
                _ => seat.is_due = false,
            }
        }
    }

    /// One pass over the joints in list order: those that are beyond their breakpoint break, and act once more.
    pub(super) fn solve_joints(&mut self, handler: Handler) {
        if !self.joint_passes.are_placed {
            self.place_joints();
        }
        for position in 0..self.joint_passes.seats.len() {
            let Some((id, joint)) = self.joints.at_mut(position) else { continue };
            if !joint.enabled() {
                continue;
            }
            if joint.breaks() {
                self.events.push(Event::JointBroke { joint: id });
                self.tell_of_joint(handler, |handler, context| handler.on_joint_broke(context, id));
            }
            let seat = self.joint_passes.seats[position];
            if seat.is_due && !seat.is_dropped && self.solve_joint(position, id, seat) {
                let is_told = handler.as_ref().is_some_and(|handler| handler.handles_joint_updates());
                if is_told {
                    self.tell_of_joint(handler, |handler, context| handler.on_joint_updated(context, id));
                }
            }
        }
        self.joint_passes.velocities_are_down = false;
    }

    /// One pass of a joint. Answers whether it has acted.
    fn solve_joint(&mut self, position: usize, id: JointId, seat: Seat) -> bool {
        let Some(joint) = self.joints.get_mut(id) else { return false };
        let states = seat.places.map(|place| self.solver.body(place));
        let [one, two] = [0, 1].map(|body| {
            let SolverBody { velocity: [x, y, w], inverse_mass, inverse_inertia, .. } = states[body];
            JointBody {
                velocity: Vector2::new(x, y),
                angular_velocity: w,
                inverse_mass,
                inverse_inertia,
                is_static: seat.is_static[body],
            }
        });
        let mut changed = joint_bodies([one, two], seat.places[0] == seat.places[1]);
        let has_acted = joint.solve(&mut changed);
        if !changed.is_finite() {
            joint.forget_impulse();
            self.joint_passes.seats[position].is_dropped = true;
            self.events.push(Event::JointNotFinite { joint: id });
            return false;
        }
        for (body, state) in [(1, changed.second()), (0, changed.first())] {
            let velocity = [state.velocity.x, state.velocity.y, state.angular_velocity];
            self.solver.set_body(seat.places[body], &SolverBody { velocity, ..states[body] });
            if self.joint_passes.velocities_are_down {
                self.solver.put_velocity_down(seat.places[body], &mut self.bodies);
            }
        }
        has_acted
    }

    /// Tells the handler in the middle of a pass. From the first time in a pass to its end the bodies have the
    /// velocities that the solver has, so that they can be looked at; what is edited is taken up when edits settle.
    fn tell_of_joint(
        &mut self,
        handler: Handler,
        tell: impl FnOnce(&mut dyn EventHandler, &mut Context<'_>),
    ) {
        let Some(handler) = handler else { return };
        if !std::mem::replace(&mut self.joint_passes.velocities_are_down, true) {
            self.solver.put_velocities_down(&mut self.bodies);
        }
        tell(&mut **handler, &mut Context { simulator: self });
        self.settle_edits(&mut Some(&mut **handler));
    }

    /// Lets the solver go on with the velocity of a body that a callback in the middle of a pass has edited.
    pub(super) fn take_edited_velocity_up(&mut self, body: BodyId) {
        if self.joint_passes.velocities_are_down {
            self.solver.take_velocity_up(body, &self.bodies);
        }
    }
}

impl std::ops::Index<JointId> for PhysicsSimulator {
    type Output = Joint;
    /// # Panics
    /// If the id is stale; see [`PhysicsSimulator::joint`].
    fn index(&self, joint: JointId) -> &Joint {
        &self.joints[joint]
    }
}

impl std::ops::IndexMut<JointId> for PhysicsSimulator {
    /// # Panics
    /// If the id is stale; see [`PhysicsSimulator::joint_mut`].
    fn index_mut(&mut self, joint: JointId) -> &mut Joint {
        &mut self.joints[joint]
    }
}
