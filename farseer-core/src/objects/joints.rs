//! Joints and their bodies (behaviour chapter 10).

use super::Objects;
use crate::body::entry::Bodies;
use crate::body::missing_body::{check_bodies, missing_body_id};
use crate::body::{Body, BodyId};
use crate::error::{Error, Result};
#[cfg(feature = "precise")]
use crate::geom::{GeomId, filter::are_separated};
use crate::joints::{
    Joint, JointId, JointKind, JointLimits, JointMotor, JointServo, JointType, MotorAndLimits, MotorJoint,
    PoseServo,
};
use crate::math::Vector2;
use crate::math::finite::finite_vector;
use crate::math::scalar::nearest_finite;

/// Joints.
impl Objects {
    /// Stores a joint. It acts once it is [added](Self::add).
    ///
    /// # Errors
    /// A body that is stale; with the precise set a second body that is the first one.
    pub(crate) fn create_joint(&mut self, joint: Joint) -> Result<JointId> {
        self.check_body("body1", joint.body1())?;
        joint.body2().map_or(Ok(()), |body| self.check_body("body2", body))?;
        if self.methods.is_precise() && joint.body2() == Some(joint.body1()) {
            return Err(Error::invalid("body2", joint.body1(), "another body than body1"));
        }
        Ok(self.joints.create(joint))
    }

    /// Refuses a range that ends before it begins, with the precise set. The original takes it.
    pub(crate) fn check_range(&self, min: f32, max: f32) -> Result<()> {
        match self.methods.is_precise() && min > max {
            true => Err(Error::invalid("min", min, "at most max")),
            false => Ok(()),
        }
    }

    /// Makes a joint of a kind without bodies, as the original's constructors without arguments do, for data that are
    /// read from a file one value after the other. Bodies are set by [`set_joint_body1`](Self::set_joint_body1) (also
    /// the only one) and [`set_joint_body2`](Self::set_joint_body2), an anchor after its bodies. Until they are set,
    /// anchors are the bodies' origins, and angles, limits and distances are 0. All other settings have the defaults of
    /// the kind. The joint can be [added](Self::add) once it has its bodies.
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
        self.has_edited_joints = true;
        self.joints.get_mut(joint)
    }

    /// A joint as its own type: `simulator.joint_as::<PinJoint>(joint)?.target_distance()`.
    ///
    /// # Errors
    /// A stale id; a joint of another kind.
    pub fn joint_as<J: JointType>(&self, joint: JointId) -> Result<&J> {
        let argument = "joint";
        J::of(self.joints.find(argument, joint)?).ok_or(Error::WrongKind { argument, expected: J::NAME })
    }

    /// A joint as its own type, to edit.
    ///
    /// # Errors
    /// A stale id; a joint of another kind.
    pub fn joint_as_mut<J: JointType>(&mut self, joint: JointId) -> Result<&mut J> {
        let argument = "joint";
        self.has_edited_joints = true;
        let edited = self.joints.find_mut(argument, joint)?;
        edited.set_refuses_reversed(self.methods.is_precise());
        J::of_mut(edited).ok_or(Error::WrongKind { argument, expected: J::NAME })
    }

    /// The joints that take part, in the order in which they were added.
    #[doc(alias = "JointList")]
    pub fn joint_list(&self) -> &[JointId] {
        self.joints.list()
    }

    /// Replaces the first or only body of a joint; anchors and impulses stay.
    ///
    /// # Errors
    /// A stale id; with the precise set the second body of the joint. The joint does not change then.
    #[doc(alias("Body1", "FixedRevoluteJoint.Body", "FixedAngleJoint.Body", "FixedAngleLimitJoint.Body"))]
    pub fn set_joint_body1(&mut self, joint: JointId, body: BodyId) -> Result<()> {
        self.check_body("body", body)?;
        let is_precise = self.methods.is_precise();
        let changed = self.joints.find_mut("joint", joint)?;
        if is_precise && changed.body2() == Some(body) {
            return Err(Error::invalid("body", body, "another body than body2"));
        }
        changed.set_body1(body);
        self.has_edited_joints = true;
        Ok(())
    }

    /// Replaces the second body of a joint between two bodies; anchors and impulses stay.
    ///
    /// # Errors
    /// A stale id; a joint on one body; with the precise set the first body of the joint. The joint does not change then.
    #[doc(alias = "Body2")]
    pub fn set_joint_body2(&mut self, joint: JointId, body: BodyId) -> Result<()> {
        self.check_body("body", body)?;
        let is_precise = self.methods.is_precise();
        let changed = self.joints.find_mut("joint", joint)?;
        if changed.body2().is_none() {
            return Err(Error::WrongKind { argument: "joint", expected: "joint between two bodies" });
        }
        if is_precise && changed.body1() == body {
            return Err(Error::invalid("body", body, "another body than body1"));
        }
        changed.set_body2(body);
        self.has_edited_joints = true;
        Ok(())
    }

    /// Sets whether the two bodies of a joint collide with each other. Default true: they do. A joint with false keeps its
    /// bodies from colliding while it is in the simulation and enabled: links may overlap then. When it is removed, disabled
    /// or breaks, they collide again, and are pushed apart if they overlap. Contacts between them end with the next update,
    /// with their events. A body that a joint connects to the world keeps all of its contacts.
    ///
    /// One joint that separates two bodies is enough, whatever others connect them.
    ///
    /// ```
    /// use farseer_core::math::Vector2;
    /// use farseer_core::{BodyFactory, JointFactory, Methods, PhysicsSimulator};
    /// let mut simulator = PhysicsSimulator::default();
    /// simulator.set_methods(Methods::PRECISE)?;
    /// let arm = BodyFactory::create_rectangle_body_in(&mut simulator, 40.0, 10.0, 1.0)?;
    /// let hand = BodyFactory::create_circle_body_in(&mut simulator, 10.0, 1.0)?;
    /// let wrist = JointFactory::create_revolute_joint_in(&mut simulator, arm, hand, Vector2::new(20.0, 0.0))?;
    /// assert!(simulator[wrist].do_bodies_collide());
    /// simulator.set_joint_bodies_collide(wrist, false)?;
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// A stale id; a joint on one body; false with the faithful methods, which have no such joints
    /// ([`Error::NotSupported`]): there, [ignore](Self::ignore_collision_with) the collisions of the geoms.
    #[doc(alias("collideConnected", "contacts_enabled", "collide_bodies"))]
    pub fn set_joint_bodies_collide(&mut self, joint: impl Into<JointId>, do_collide: bool) -> Result<()> {
        let kept = self.joints.find_mut("joint", joint.into())?;
        if kept.body2().is_none() {
            return Err(Error::WrongKind { argument: "joint", expected: "joint between two bodies" });
        }
        if !do_collide {
            self.methods.check_separating_joints()?;
        }
        self.has_edited_joints |= kept.do_bodies_collide() != do_collide;
        kept.set_bodies_collide(do_collide);
        Ok(())
    }

    /// Whether a joint keeps the bodies of two geoms from colliding.
    #[cfg(feature = "precise")]
    pub(crate) fn are_separated_geoms(&self, (one, other): (GeomId, GeomId)) -> bool {
        let bodies = [one, other].map(|geom| self.geoms.get(geom).map(|entry| entry.body));
        let [Some(one), Some(other)] = bodies else { return false };
        are_separated(&self.separated_bodies, one, other)
    }

    /// Moves the anchor of a revolute, fixed revolute, weld, prismatic or wheel joint to a point of the world, for the bodies'
    /// present poses. [Limits](Self::set_joint_limits) are relative to these poses.
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
            JointKind::Prismatic(joint) => joint.set_anchor(anchor, body1, body2),
            JointKind::Wheel(joint) => joint.set_anchor(anchor, body1, body2),
            _ => {
                Err(wrong_kind("RevoluteJoint, FixedRevoluteJoint, WeldJoint, PrismaticJoint or WheelJoint"))
            }
        }
    }

    /// Sets the axis of a prismatic or wheel joint to a direction of the world, for the first body's present angle. Its length
    /// has no effect.
    ///
    /// # Errors
    /// A stale id; a body that was not set yet; an axis that is not finite or has no length; a joint of another kind.
    pub fn set_joint_axis(&mut self, joint: JointId, axis: Vector2) -> Result<()> {
        let (joint, body1, _) = self.joint_and_bodies(joint)?;
        match joint.kind_mut() {
            JointKind::Prismatic(joint) => joint.set_axis(axis, body1),
            JointKind::Wheel(joint) => joint.set_axis(axis, body1),
            _ => Err(wrong_kind("PrismaticJoint or WheelJoint")),
        }
    }

    /// Sets the motor of a revolute, fixed revolute, prismatic, wheel or angle spring joint, or removes it. It takes effect with the next
    /// update.
    ///
    /// ```
    /// use farseer_core::math::Vector2;
    /// use farseer_core::{BodyFactory, JointFactory, JointMotor, Methods, PhysicsSimulator};
    /// let mut simulator = PhysicsSimulator::default();
    /// simulator.set_methods(Methods::PRECISE)?;
    /// let wheel = BodyFactory::create_circle_body_in(&mut simulator, 10.0, 1.0)?;
    /// let axle = JointFactory::create_fixed_revolute_joint_in(&mut simulator, wheel, Vector2::zeros())?;
    /// simulator.set_joint_motor(axle, Some(JointMotor { speed: 3.0, greatest_effort: 1e6 }))?;
    /// simulator.update(0.01);
    /// assert!((simulator[wheel].angular_velocity() - 3.0).abs() < 0.001);
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// A stale id; a joint of another kind; a speed that is not finite, an effort that is not finite and 0 or more; the
    /// faithful methods, which have no motors ([`Error::NotSupported`]).
    pub fn set_joint_motor(&mut self, joint: impl Into<JointId>, motor: Option<JointMotor>) -> Result<()> {
        self.edit_motor_and_limits(joint.into(), DRIVEN, |joint| {
            joint.motor_and_limits_mut().map(|drive| drive.set_motor(motor))
        })
    }

    /// Sets the limits of a revolute, fixed revolute, prismatic or angle spring joint, or removes them. They take effect with the
    /// next update: a joint that is beyond them is brought back little by little.
    ///
    /// # Errors
    /// A stale id; a joint of another kind; limits that are not finite, or in the wrong order; the faithful methods, which
    /// have none for these joints ([`Error::NotSupported`]).
    pub fn set_joint_limits(&mut self, joint: impl Into<JointId>, limits: Option<JointLimits>) -> Result<()> {
        self.edit_motor_and_limits(joint.into(), LIMITED, |joint| {
            let has_limits = !matches!(joint.kind(), JointKind::Wheel(_));
            joint.motor_and_limits_mut().filter(|_| has_limits).map(|drive| drive.set_limits(limits))
        })
    }

    /// Sets the servo of a revolute, fixed revolute, prismatic, wheel or angle spring joint, or removes it. It takes effect with the next update,
    /// and wakes the bodies if it differs from the present one. Its target is relative to the reference of the [limits](Self::set_joint_limits), and compared with
    /// [`joint_travel`](Self::joint_travel). See [`JointServo`] for an example.
    ///
    /// Force and torque of the servo are part of [`Joint::force`] and [`Joint::torque`], and can break the joint.
    ///
    /// # Errors
    /// A stale id; a joint of another kind; a target that is not finite; a stiffness, damping or effort that is not finite and
    /// 0 or more; the faithful methods, which have no servos ([`Error::NotSupported`]). The old servo stays then.
    #[doc(alias("enableSpring", "SetSpringHertz", "set_motor_position", "SetTargetAngle"))]
    pub fn set_joint_servo(&mut self, joint: impl Into<JointId>, servo: Option<JointServo>) -> Result<()> {
        self.edit_motor_and_limits(joint.into(), DRIVEN, |joint| {
            joint.motor_and_limits_mut().map(|drive| drive.set_servo(servo))
        })
    }

    /// Moves the pose that a motor joint seeks: the place of the second body's centre in the coordinates of the first one, in
    /// length units, and the difference of their total rotations, in radians. It takes effect with the next update, and wakes
    /// the bodies.
    ///
    /// # Errors
    /// A stale id; a joint of another kind; a number that is not finite. The old pose stays then.
    #[doc(alias("SetLinearOffset", "SetAngularOffset"))]
    pub fn set_motor_joint_target(
        &mut self,
        joint: impl Into<JointId>,
        offset: Vector2,
        angle: f32,
    ) -> Result<()> {
        self.motor_joint_mut(joint.into())?.set_target(offset, angle)
    }

    /// Sets frequency, damping and bounds of a motor joint. They take effect with the next update.
    ///
    /// # Errors
    /// A stale id; a joint of another kind; a number that is not finite and 0 or more. The old values stay then.
    #[doc(alias("SetMaxForce", "SetMaxTorque"))]
    pub fn set_motor_joint_servo(&mut self, joint: impl Into<JointId>, servo: PoseServo) -> Result<()> {
        self.motor_joint_mut(joint.into())?.set_servo(servo)
    }

    /// A motor joint for an edit that changes its target or strength.
    fn motor_joint_mut(&mut self, joint: JointId) -> Result<&mut MotorJoint> {
        self.has_edited_drives = true;
        MotorJoint::of_mut(self.joints.find_mut("joint", joint)?).ok_or_else(|| wrong_kind(MotorJoint::NAME))
    }

    /// Edits a copy, so that the joint does not change if the edit is refused; `expected` names the kinds that have it. Only adding or removing a motor,
    /// limits or a servo changes how joints are solved.
    fn edit_motor_and_limits(
        &mut self,
        joint: JointId,
        expected: &'static str,
        edit: impl FnOnce(&mut Joint) -> Option<Result<()>>,
    ) -> Result<()> {
        let kept = self.joints.find_mut("joint", joint)?;
        let mut edited = kept.clone();
        edit(&mut edited).ok_or_else(|| wrong_kind(expected))??;
        self.methods.check_driven(&edited)?;
        let present = |joint: &Joint| joint.motor_and_limits().map(MotorAndLimits::present);
        self.has_edited_joints |= present(kept) != present(&edited);
        self.has_edited_drives |= kept.motor_and_limits() != edited.motor_and_limits();
        *kept = edited;
        Ok(())
    }

    /// Travel of a joint relative to the reference of its [limits](Self::set_joint_limits). It is the angle of a revolute or
    /// fixed revolute joint or angle spring in radians, and the distance of a prismatic or wheel joint along its axis in length
    /// units.
    ///
    /// # Errors
    /// A stale id; a body that was not set yet; a joint of another kind.
    pub fn joint_travel(&self, joint: impl Into<JointId>) -> Result<f32> {
        let joint = self.joints.find("joint", joint.into())?;
        let body1 = body_of_joint(&self.bodies, "body1", joint.body1())?;
        let body2 = joint.body2().map(|body2| body_of_joint(&self.bodies, "body2", body2)).transpose()?;
        let angle = match body2 {
            Some(body2) => body2.total_rotation() - body1.total_rotation(),
            None => body1.total_rotation(),
        };
        let travel = match (joint.kind(), joint.motor_and_limits()) {
            (JointKind::Prismatic(joint), _) => joint.travel(body1, body2.unwrap_or(body1)),
            (JointKind::Wheel(joint), _) => joint.travel(body1, body2.unwrap_or(body1)),
            (_, Some(drive)) => angle - drive.reference,
            _ => return Err(wrong_kind(DRIVEN)),
        };
        Ok(nearest_finite(travel))
    }

    /// Moves the anchor of a pin or slider joint on its first body to a point in the coordinates of that body. The
    /// target distance stays.
    ///
    /// # Errors
    /// A stale id; a body that was not set yet; a point that is not finite, or not in the world; a joint of another kind.
    #[doc(alias = "Anchor1")]
    pub fn set_joint_anchor1(&mut self, joint: JointId, anchor: Vector2) -> Result<()> {
        self.has_edited_joints = true;
        let joint = self.joints.find_mut("joint", joint)?;
        let body1 = body_of_joint(&self.bodies, "body1", joint.body1());
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
        self.has_edited_joints = true;
        let joint = self.joints.find_mut("joint", joint)?;
        let body2 = body_of_joint(&self.bodies, "body2", joint.body2().unwrap_or(joint.body1()));
        match joint.kind_mut() {
            JointKind::Pin(joint) => joint.set_anchor2(anchor, body2?),
            JointKind::Slider(joint) => joint.set_anchor2(anchor, body2?),
            _ => Err(wrong_kind("PinJoint or SliderJoint")),
        }
    }

    /// World position of the anchor of a revolute, weld, prismatic or slider joint on its first body, from the body's
    /// present position and the arm of the last update. Before the first update a revolute, weld or prismatic joint has
    /// no arm.
    ///
    /// # Errors
    /// A stale id; a body that was not set yet; a joint of another kind; an anchor whose coordinates are not finite.
    #[doc(alias("CurrentAnchor", "CurrentAnchorPosition"))]
    pub fn joint_current_anchor(&self, joint: JointId) -> Result<Vector2> {
        let joint = self.joints.find("joint", joint)?;
        let body1 = body_of_joint(&self.bodies, "body1", joint.body1())?;
        let anchor = match joint.kind() {
            JointKind::Revolute(joint) => joint.current_anchor(body1),
            JointKind::Weld(joint) => joint.current_anchor(body1),
            JointKind::Prismatic(joint) => joint.current_anchor(body1),
            JointKind::Wheel(joint) => joint.current_anchor(body1),
            JointKind::Slider(joint) => joint.current_anchor(body1),
            _ => {
                return Err(wrong_kind(
                    "RevoluteJoint, WeldJoint, PrismaticJoint, WheelJoint or SliderJoint",
                ));
            }
        };
        finite_vector("joint", anchor)
    }

    /// A joint with its bodies; the same body twice if it has one.
    pub(crate) fn joint_and_bodies(&mut self, joint: JointId) -> Result<(&mut Joint, &Body, &Body)> {
        self.has_edited_joints = true;
        let joint = self.joints.find_mut("joint", joint)?;
        check_bodies("joint", joint.body1(), joint.body2())?;
        let body1 = body_of_joint(&self.bodies, "body1", joint.body1())?;
        let body2 = body_of_joint(&self.bodies, "body2", joint.body2().unwrap_or(joint.body1()))?;
        Ok((joint, body1, body2))
    }
}

/// A body of a joint; it may lack the other one.
fn body_of_joint<'a>(bodies: &'a Bodies, missing: &'static str, body: BodyId) -> Result<&'a Body> {
    if body == missing_body_id() {
        return Err(Error::MissingBody { argument: "joint", missing });
    }
    let entry = bodies.get(body).ok_or(Error::StaleId { argument: "body of the joint" })?;
    Ok(&entry.body)
}

/// Kinds of joints with a motor and a servo.
const DRIVEN: &str = "RevoluteJoint, FixedRevoluteJoint, PrismaticJoint, AngleSpringJoint or WheelJoint";

/// Kinds of joints with limits.
const LIMITED: &str = "RevoluteJoint, FixedRevoluteJoint, PrismaticJoint or AngleSpringJoint";

fn wrong_kind(expected: &'static str) -> Error {
    Error::WrongKind { argument: "joint", expected }
}

impl std::ops::Index<JointId> for Objects {
    type Output = Joint;
    /// # Panics
    /// If the id is stale; see [`Objects::joint`].
    fn index(&self, joint: JointId) -> &Joint {
        &self.joints[joint]
    }
}

impl std::ops::IndexMut<JointId> for Objects {
    /// # Panics
    /// If the id is stale; see [`Objects::joint_mut`].
    fn index_mut(&mut self, joint: JointId) -> &mut Joint {
        self.has_edited_joints = true;
        &mut self.joints[joint]
    }
}
