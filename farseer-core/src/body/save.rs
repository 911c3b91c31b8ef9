//! Saving of a body, and the checks when one is loaded.

use std::borrow::Cow;

use serde::ser::{Error as _, SerializeTuple};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error as _};

use super::Body;
use super::kinematic::Target;
use super::options::BodyOptions;
use super::rejected_arguments::BodyArguments;
use crate::math::Vector2;
use crate::storage::rejected_arguments::RejectedArguments;
use farseer_precise::storage::words::{self, Record, Words};

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

/// The numbers and flags of a body, in binary formats.
struct Numbers<'a>(Cow<'a, Body>);

impl Serialize for Numbers<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        words::serialize(self.0.as_ref(), serializer, |_, _| Err(S::Error::custom("a body in a text format")))
    }
}

impl<'de> Deserialize<'de> for Numbers<'_> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let body = words::deserialize(deserializer, |_| Err(D::Error::custom("a body in a text format")))?;
        Ok(Numbers(Cow::Owned(body)))
    }
}

impl Record for Body {
    const WORDS: usize = 30;

    #[inline(always)]
    fn visit(&mut self, words: &mut impl Words) {
        let vectors = [
            &mut self.position,
            &mut self.linear_velocity,
            &mut self.linear_velocity_bias,
            &mut self.force,
            &mut self.impulse,
        ];
        vectors.into_iter().for_each(|vector| words.floats(vector.as_mut_slice()));
        let mut revolutions = self.revolutions.cast_unsigned();
        words.word(&mut revolutions);
        self.revolutions = revolutions.cast_signed();
        let numbers = [
            &mut self.rotation,
            &mut self.total_rotation,
            &mut self.angular_velocity,
            &mut self.angular_velocity_bias,
            &mut self.torque,
            &mut self.mass,
            &mut self.inverse_mass,
            &mut self.moment_of_inertia,
            &mut self.inverse_moment_of_inertia,
            &mut self.linear_drag_coefficient,
            &mut self.quadratic_drag_coefficient,
            &mut self.rotational_drag_coefficient,
            &mut self.idle_time,
            &mut self.minimum_velocity,
            &mut self.gravity_scale,
        ];
        numbers.into_iter().for_each(|number| words.float(number));
        words.long(&mut self.tag);
        self.options.visit(words);
        words.flags([
            &mut self.is_static,
            &mut self.is_kinematic,
            &mut self.enabled,
            &mut self.ignore_gravity,
            &mut self.is_quadratic_drag_enabled,
            &mut self.is_auto_idle,
            &mut self.has_moved,
            &mut self.pose_is_dirty,
        ]);
    }
}

impl Serialize for Body {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if serializer.is_human_readable() {
            return SavedBody::serialize(self, serializer);
        }
        let mut parts = serializer.serialize_tuple(3)?;
        parts.serialize_element(&Numbers(Cow::Borrowed(self)))?;
        parts.serialize_element(&self.target)?;
        parts.serialize_element(&self.rejected)?;
        parts.end()
    }
}

/// Refuses a body that no sequence of calls could have made.
impl<'de> Deserialize<'de> for Body {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let body = if deserializer.is_human_readable() {
            SavedBody::deserialize(deserializer)?
        } else {
            let (Numbers(body), target, rejected) = Deserialize::deserialize(deserializer)?;
            Body { target, rejected, ..body.into_owned() }
        };
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
