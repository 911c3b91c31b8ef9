//! Saving of a body, and the checks when one is loaded.

use serde::{Deserialize, Serialize};

use super::Body;
use super::kinematic::Target;
use super::options::BodyOptions;
use super::rejected_arguments::BodyArguments;
use crate::math::Vector2;
use crate::storage::rejected_arguments::RejectedArguments;

/// The saved fields of a body. `Body` itself does not derive `Deserialize`, so that none is loaded without the check.
#[derive(Serialize, Deserialize)]
#[serde(remote = "Body")]
struct SavedBody {
    position: Vector2,
    rotation: f32,
    revolutions: i32,
    total_rotation: f32,
    linear_velocity: Vector2,
    angular_velocity: f32,
    linear_velocity_bias: Vector2,
    angular_velocity_bias: f32,
    force: Vector2,
    torque: f32,
    impulse: Vector2,
    mass: f32,
    inverse_mass: f32,
    moment_of_inertia: f32,
    inverse_moment_of_inertia: f32,
    linear_drag_coefficient: f32,
    quadratic_drag_coefficient: f32,
    rotational_drag_coefficient: f32,
    idle_time: f32,
    minimum_velocity: f32,
    gravity_scale: f32,
    tag: u64,
    is_static: bool,
    is_kinematic: bool,
    #[serde(rename = "is_bullet")]
    options: BodyOptions,
    target: Option<Target>,
    enabled: bool,
    ignore_gravity: bool,
    is_quadratic_drag_enabled: bool,
    is_auto_idle: bool,
    has_moved: bool,
    pose_is_dirty: bool,
    rejected: RejectedArguments<BodyArguments>,
}

impl Serialize for Body {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        SavedBody::serialize(self, serializer)
    }
}

/// Refuses a body that no sequence of calls could have made.
impl<'de> Deserialize<'de> for Body {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let body = SavedBody::deserialize(deserializer)?;
        let numbers = [
            body.force.x,
            body.force.y,
            body.torque,
            body.impulse.x,
            body.impulse.y,
            body.linear_drag_coefficient,
            body.quadratic_drag_coefficient,
            body.rotational_drag_coefficient,
            body.idle_time,
            body.minimum_velocity,
            body.gravity_scale,
        ];
        let inverse = |value: f32| if body.is_immovable() { 0.0 } else { 1.0 / value };
        let inverse_moment_of_inertia =
            if body.is_rotation_locked() { 0.0 } else { inverse(body.moment_of_inertia) };
        let is_valid = body.is_finite()
            && numbers.iter().all(|number| number.is_finite())
            && body.mass.is_finite()
            && body.mass != 0.0
            && body.moment_of_inertia.is_finite()
            && body.moment_of_inertia > 0.0
            && !(body.is_static && body.is_kinematic)
            && body.target.is_none_or(|target| body.is_kinematic && target.is_finite())
            && body.inverse_mass == inverse(body.mass)
            && !(body.holds_rotation() && body.angular_velocity != 0.0)
            && body.inverse_moment_of_inertia == inverse_moment_of_inertia
            && body.inverse_mass.is_finite()
            && body.inverse_moment_of_inertia.is_finite();
        if is_valid {
            Ok(body)
        } else {
            Err(serde::de::Error::custom("the state of a body is not finite or contradicts itself"))
        }
    }
}
