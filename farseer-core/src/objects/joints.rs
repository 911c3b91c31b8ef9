//! Joints: who they hold together (behaviour chapter 10).

use super::Objects;
use crate::body::entry::Bodies;
use crate::body::nobody::{check_bodies, nobody};
use crate::body::{Body, BodyId};
use crate::error::{Error, Result};
use crate::joints::{Joint, JointId, JointKind, JointType};
use crate::math::Vector2;
use crate::math::finite::finite_vector;

/// Joints.
impl Objects {
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
        self.has_edited_joints = true;
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
        self.has_edited_joints = true;
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
        self.has_edited_joints = true;
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
        self.has_edited_joints = true;
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
        self.has_edited_joints = true;
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
        self.has_edited_joints = true;
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
        self.has_edited_joints = true;
        let joint = self.joints.find_mut("joint", joint)?;
        check_bodies("joint", joint.body1(), joint.body2())?;
        let body1 = held_body(&self.bodies, "body1", joint.body1())?;
        let body2 = held_body(&self.bodies, "body2", joint.body2().unwrap_or(joint.body1()))?;
        Ok((joint, body1, body2))
    }
}

/// A body that a joint holds, whether or not it has the other one.
fn held_body<'a>(bodies: &'a Bodies, missing: &'static str, body: BodyId) -> Result<&'a Body> {
    if body == nobody() {
        return Err(Error::MissingBody { argument: "joint", missing });
    }
    let entry = bodies.get(body).ok_or(Error::StaleId { argument: "body of the joint" })?;
    Ok(&entry.body)
}

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
