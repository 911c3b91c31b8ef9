//! Springs between bodies, and between bodies and the world (behaviour chapter 13, section 5).

use crate::body::{Body, BodyId};
use crate::math::Vector2;
use crate::objects::Objects;
use crate::springs::{AngleSpring, FixedAngleSpring, FixedLinearSpring, LinearSpring, SpringId};
use crate::{Error, Result};

/// Makes springs. Rest lengths and angles are computed from the present poses of the bodies, so place the bodies first.
///
/// Forces are in mass units · length units/s², torques in force times length.
#[doc(alias = "ControllerFactory")]
#[doc(alias = "SpringFactory.Instance")]
#[derive(Debug, Clone, Copy)]
pub struct SpringFactory;

impl SpringFactory {
    /// A spring between two points, each in the coordinates of its body, at rest at their present distance.
    ///
    /// # Errors
    /// A stale body; a number that is not finite; points too far apart for a finite distance.
    #[doc(alias = "CreateLinearSpring")]
    pub fn create_linear_spring(
        simulator: &mut Objects,
        body1: BodyId,
        attach_point1: Vector2,
        body2: BodyId,
        attach_point2: Vector2,
        spring_constant: f32,
        damping_constant: f32,
    ) -> Result<SpringId> {
        let (first, second) = (find(simulator, "body1", body1)?, find(simulator, "body2", body2)?);
        let spring = LinearSpring::new(
            first,
            attach_point1,
            second,
            attach_point2,
            spring_constant,
            damping_constant,
        )?;
        simulator.create_spring(spring)
    }

    /// A spring between a point in the body's coordinates and a point of the world, at rest at their present distance.
    ///
    /// # Errors
    /// A stale body; a number that is not finite; points too far apart for a finite distance.
    #[doc(alias = "CreateFixedLinearSpring")]
    pub fn create_fixed_linear_spring(
        simulator: &mut Objects,
        body: BodyId,
        body_attach_point: Vector2,
        world_attach_point: Vector2,
        spring_constant: f32,
        damping_constant: f32,
    ) -> Result<SpringId> {
        let body_with_id = find(simulator, "body", body)?;
        let spring = FixedLinearSpring::new(
            body_with_id,
            body_attach_point,
            world_attach_point,
            spring_constant,
            damping_constant,
        )?;
        simulator.create_spring(spring)
    }

    /// A torque toward the present relative angle of two bodies.
    ///
    /// # Errors
    /// A stale body; a number that is not finite.
    #[doc(alias = "CreateAngleSpring")]
    pub fn create_angle_spring(
        simulator: &mut Objects,
        body1: BodyId,
        body2: BodyId,
        spring_constant: f32,
        damping_constant: f32,
    ) -> Result<SpringId> {
        let (first, second) = (find(simulator, "body1", body1)?, find(simulator, "body2", body2)?);
        let spring = AngleSpring::new(first, second, spring_constant, damping_constant)?;
        simulator.create_spring(spring)
    }

    /// A torque toward the body's present total rotation.
    ///
    /// # Errors
    /// A stale body; a number that is not finite.
    #[doc(alias = "CreateFixedAngleSpring")]
    pub fn create_fixed_angle_spring(
        simulator: &mut Objects,
        body: BodyId,
        spring_constant: f32,
        damping_constant: f32,
    ) -> Result<SpringId> {
        let body_with_id = find(simulator, "body", body)?;
        let spring = FixedAngleSpring::new(body_with_id, spring_constant, damping_constant)?;
        simulator.create_spring(spring)
    }
}

/// Methods that also add the spring to the simulator.
impl SpringFactory {
    added! {
        create_linear_spring_in = create_linear_spring(body1: BodyId, attach_point1: Vector2, body2: BodyId, attach_point2: Vector2, spring_constant: f32, damping_constant: f32) -> SpringId;
        create_fixed_linear_spring_in = create_fixed_linear_spring(body: BodyId, body_attach_point: Vector2, world_attach_point: Vector2, spring_constant: f32, damping_constant: f32) -> SpringId;
        create_angle_spring_in = create_angle_spring(body1: BodyId, body2: BodyId, spring_constant: f32, damping_constant: f32) -> SpringId;
        create_fixed_angle_spring_in = create_fixed_angle_spring(body: BodyId, spring_constant: f32, damping_constant: f32) -> SpringId;
    }
}

fn find<'a>(simulator: &'a Objects, argument: &'static str, body: BodyId) -> Result<(BodyId, &'a Body)> {
    simulator.body(body).map(|found| (body, found)).ok_or(Error::StaleId { argument })
}
