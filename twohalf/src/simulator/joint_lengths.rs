//! Lengths of joints and springs in three axes.

use farseer_core::{
    BodyId, Error, FixedLinearSpring, JointId, JointKind, LinearSpring, ObjectId, PinJoint, SliderJoint,
    SpringId, SpringKind,
};

use crate::{DepthScheme, Result, TwoHalfPhysicsSimulator, Vector2, Vector3};

impl TwoHalfPhysicsSimulator {
    /// Sets the length of a pin, slider or linear spring to the present distance of its points in three axes,
    /// px, and returns it. Its original length is that of X and Y alone. The length of a slider is its
    /// greatest distance.
    ///
    /// A spring to a point of the world that [has no depth](FixedLinearSpring::set_world_attach_depth) acts
    /// in X and Y and takes the length there. So do all with other schemes than [`DepthScheme::Precise`].
    ///
    /// ```
    /// # use twohalf::{TwoHalfPhysicsSimulator, Vector2, Vector3, farseer_core::{BodyFactory, JointFactory, PinJoint}};
    /// let mut simulator = TwoHalfPhysicsSimulator::with_gravity(600, Vector2::new(0.0, 0.0))?;
    /// let [one, other] = [[0.0, 100.0, 0.0], [30.0, 100.0, 40.0]].map(|place| {
    ///     let body = simulator.create_body(BodyFactory::create_circle_body(5.0, 1.0).unwrap());
    ///     simulator.add(body).unwrap();
    ///     simulator.body_mut(body).unwrap().set_position3d(Vector3::from(place));
    ///     body
    /// });
    /// let zero = Vector2::new(0.0, 0.0);
    /// let pin = simulator.edit_objects(|objects| {
    ///     let pin = JointFactory::create_pin_joint(objects, one, zero, other, zero)?;
    ///     objects.add(pin)?;
    ///     Ok::<_, farseer_core::Error>(pin)
    /// })?;
    /// assert_eq!(simulator.core().joint_as::<PinJoint>(pin)?.target_distance(), 30.0);
    /// assert_eq!(simulator.take_length(pin)?, 50.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A stale id; another kind of object; a distance that is not finite, or less than the least distance of
    /// a slider. A failed call changes nothing.
    pub fn take_length(&mut self, object: impl Into<ObjectId>) -> Result<f32> {
        match object.into() {
            ObjectId::Joint(joint) => self.take_joint_length(joint),
            ObjectId::Spring(spring) => self.take_spring_length(spring),
            _ => Err(wrong_kind("object")),
        }
    }

    fn take_joint_length(&mut self, joint: JointId) -> Result<f32> {
        let argument = "joint";
        let (kind, body1, body2) = {
            let joint = self.core.joint(joint).ok_or(Error::StaleId { argument })?;
            (joint.kind(), joint.body1(), joint.body2().unwrap_or(joint.body1()))
        };
        let points = match kind {
            JointKind::Pin(pin) => [pin.anchor1(), pin.anchor2()],
            JointKind::Slider(slider) => [slider.anchor1(), slider.anchor2()],
            _ => return Err(wrong_kind(argument)),
        };
        let length = self.distance([body1, body2], points)?;
        if let JointKind::Slider(slider) = kind
            && length < slider.min()
        {
            Err(Error::invalid("length", length, "at least the slider's least distance"))?;
        }
        match kind {
            JointKind::Pin(_) => self.core.joint_as_mut::<PinJoint>(joint)?.set_target_distance(length)?,
            _ => self.core.joint_as_mut::<SliderJoint>(joint)?.set_max(length)?,
        }
        Ok(length)
    }

    fn take_spring_length(&mut self, spring: SpringId) -> Result<f32> {
        let argument = "spring";
        let found = self.core.spring(spring).ok_or(Error::StaleId { argument })?;
        match found.kind() {
            SpringKind::Linear(kind) => {
                let bodies = [found.body1(), found.body2().unwrap_or(found.body1())];
                let length = self.distance(bodies, [kind.attach_point1(), kind.attach_point2()])?;
                self.core.spring_as_mut::<LinearSpring>(spring)?.set_rest_length(length)?;
                Ok(length)
            }
            SpringKind::FixedLinear(kind) => {
                let point = kind.world_attach_point();
                let depth = kind.world_attach_depth().filter(|_| self.acts_along_depth());
                let at = self.point(found.body1(), kind.body_attach_point())?;
                let length = (at - Vector3::new(point.x, point.y, depth.unwrap_or(at.z))).norm();
                self.core.spring_as_mut::<FixedLinearSpring>(spring)?.set_rest_length(length)?;
                Ok(length)
            }
            _ => Err(wrong_kind(argument)),
        }
    }

    /// Returns the distance in three axes between points of two bodies, px.
    fn distance(&self, [one, other]: [BodyId; 2], [a, b]: [Vector2; 2]) -> Result<f32> {
        Ok((self.point(other, b)? - self.point(one, a)?).norm())
    }

    /// Returns the position of a point of a body in the frame of the plane with depth, px, y down.
    fn point(&self, id: BodyId, point: Vector2) -> Result<Vector3> {
        let body = self.core.body(id).ok_or(Error::StaleId { argument: "body" })?;
        let point = body.get_world_position(point);
        let z = if self.acts_along_depth() { self.world.depths.z_of(id) } else { 0.0 };
        Ok(Vector3::new(point.x, point.y, z))
    }

    fn acts_along_depth(&self) -> bool {
        self.world.scheme == DepthScheme::Precise
    }
}

fn wrong_kind(argument: &'static str) -> crate::Error {
    Error::WrongKind { argument, expected: "a pin, a slider or a linear spring" }.into()
}
