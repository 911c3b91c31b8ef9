//! Bodies described by options, with their geoms in one call.

use std::mem::MaybeUninit;

use farseer_core::{BodyBuilder, BodyId};

use crate::arguments::{FarseerVector2, Finite, choose, flag};
use crate::arrays;
use crate::failure::{Failure, FarseerStatus, Outcome};
use crate::geom_options::{FarseerGeomOptions, builders};
use crate::guard::{FarseerSimulator, answer, with};
use crate::ids::{FarseerBody, FarseerGeom, Id};

/// Kinds of bodies.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FarseerBodyKind {
    /// Forces and contacts move it.
    Dynamic = 0,
    /// Its velocity alone moves it.
    Kinematic = 1,
    /// It never moves.
    Static = 2,
}

/// A body with its geoms for farseer_body_create. Start from farseer_body_options_default.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FarseerBodyOptions {
    /// Kind code: a FarseerBodyKind.
    pub kind: i32,
    /// Position in length units.
    pub position: FarseerVector2,
    /// Rotation in radians.
    pub rotation: f32,
    /// Velocity in length units/s.
    pub linear_velocity: FarseerVector2,
    /// Angular velocity in rad/s.
    pub angular_velocity: f32,
    /// Fraction of the velocity that is lost per s.
    pub linear_damping: f32,
    /// Fraction of the angular velocity that is lost per s.
    pub angular_damping: f32,
    /// Factor of gravity.
    pub gravity_scale: f32,
    /// Mass in mass units; 0: that of the geoms.
    pub mass: f32,
    /// Moment of inertia in mass units · length units²; 0: that of the geoms.
    pub moment_of_inertia: f32,
    /// Flag: whether the body never turns.
    pub rotation_locked: i32,
    /// Flag: whether continuous collision acts against all bodies.
    pub bullet: i32,
    /// Flag: whether the body may fall asleep.
    pub sleep_allowed: i32,
    /// Flag: whether the body takes part.
    pub enabled: i32,
    /// A number of yours: the tag.
    pub tag: u64,
}

impl Default for FarseerBodyOptions {
    fn default() -> Self {
        FarseerBodyOptions {
            kind: FarseerBodyKind::Dynamic as i32,
            position: FarseerVector2::default(),
            rotation: 0.0,
            linear_velocity: FarseerVector2::default(),
            angular_velocity: 0.0,
            linear_damping: 0.0,
            angular_damping: 0.0,
            gravity_scale: 1.0,
            mass: 0.0,
            moment_of_inertia: 0.0,
            rotation_locked: 0,
            bullet: 0,
            sleep_allowed: 1,
            enabled: 1,
            tag: 0,
        }
    }
}

impl FarseerBodyOptions {
    fn builder(&self) -> Outcome<BodyBuilder> {
        let kinds = [BodyBuilder::dynamic, BodyBuilder::kinematic, BodyBuilder::fixed];
        let mut builder = choose("options.kind", self.kind, &kinds)?()
            .position(self.position.finite("options.position")?)
            .rotation(self.rotation.finite("options.rotation")?)
            .linear_velocity(self.linear_velocity.finite("options.linear_velocity")?)
            .angular_velocity(self.angular_velocity.finite("options.angular_velocity")?)
            .linear_damping(self.linear_damping.finite("options.linear_damping")?)
            .angular_damping(self.angular_damping.finite("options.angular_damping")?)
            .gravity_scale(self.gravity_scale.finite("options.gravity_scale")?)
            .lock_rotation(flag("options.rotation_locked", self.rotation_locked)?)
            .bullet(flag("options.bullet", self.bullet)?)
            .sleep_allowed(flag("options.sleep_allowed", self.sleep_allowed)?)
            .enabled(flag("options.enabled", self.enabled)?)
            .user_data(self.tag);
        if self.mass != 0.0 {
            builder = builder.mass(self.mass);
        }
        if self.moment_of_inertia != 0.0 {
            builder = builder.moment_of_inertia(self.moment_of_inertia);
        }
        Ok(builder)
    }
}

/// Writes the options of a dynamic body at the origin.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_options_default(
    options: Option<&mut MaybeUninit<FarseerBodyOptions>>,
) -> FarseerStatus {
    answer(|| {
        options.ok_or_else(|| Failure::null("options"))?.write(FarseerBodyOptions::default());
        Ok(())
    })
}

/// Adds a body with `count` geoms, whose mass and centre of mass become those of the body. Writes its id, and the ids of the geoms to
/// `ids`, an array of that length, which may be null.
///
/// # Safety
/// An array that is not null has the items that its number says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn farseer_body_create(
    simulator: Option<&FarseerSimulator>,
    options: Option<&FarseerBodyOptions>,
    geoms: *const FarseerGeomOptions,
    count: usize,
    body: Option<&mut MaybeUninit<FarseerBody>>,
    ids: *mut FarseerGeom,
) -> FarseerStatus {
    with(simulator, |world| {
        let body = body.ok_or_else(|| Failure::null("body"))?;
        let builder = options.ok_or_else(|| Failure::null("options"))?.builder()?;
        // SAFETY: the caller answers for the array, and for the points of its items.
        let geoms = unsafe { builders(arrays::read("geoms", geoms, count)?) }?;
        // SAFETY: the caller answers for the array.
        let room = unsafe { arrays::room("ids", ids, if ids.is_null() { 0 } else { count }) }?;
        let (id, made) = world.simulator.add_body_with(&builder, &geoms)?;
        body.write(id.to_number()?);
        for (place, id) in room.iter_mut().zip(made) {
            place.write(id.to_number()?);
        }
        Ok(())
    })
}

/// Sets mass and moment of inertia of a body from its geoms, with one density in mass units/length unit².
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_set_density(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    density: f32,
) -> FarseerStatus {
    with(simulator, |world| Ok(world.simulator.set_density(BodyId::from_number("body", body)?, density)?))
}
