//! Options and input of a mover.

use serde::{Deserialize, Serialize};

use crate::math::finite::zero_or_more;
use crate::math::scalar;
use crate::methods::CollisionCategory;
use crate::{Error, Result};

/// Options of a [`CharacterMover`](super::CharacterMover). Lengths are in length units, times in s, angles in radians. The
/// defaults are those of games in px: see [`scaled`](Self::scaled).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MoverOptions {
    /// Greatest acceleration to the speed of the input on the ground, in length units/s², 0 or more. Default 1500.
    pub acceleration: f32,
    /// Greatest acceleration to the speed of the input in the air, in length units/s², 0 or more. Default 600.
    pub air_acceleration: f32,
    /// Factor of the simulator's gravity, dimensionless, 0 or more. Default 1.
    pub gravity_scale: f32,
    /// Height of a jump whose key is held, in length units, 0 or more: h = v² / 2 g. Default 60.
    pub jump_height: f32,
    /// Fraction of the upward velocity that stays when the key is released on the way up, 0..=1. Default 0.5; with 1 all jumps
    /// are equally high.
    pub jump_cut: f32,
    /// Time after an edge in which a jump is still possible, in s, 0 or more. Default 0.1.
    pub coyote_time: f32,
    /// Time before landing in which the press of the jump key is remembered, in s, 0 or more. Default 0.1.
    pub jump_buffer: f32,
    /// Slope of the steepest ground, in radians from level, 0 or more and less than a quarter turn. Default 50 degrees.
    pub max_slope: f32,
    /// Height of the highest edge that is stepped up, in length units, 0 or more. Default 8.
    pub step_up: f32,
    /// Greatest gap below the soles that is closed without a fall, in length units, 0 or more. Default 8.
    pub snap: f32,
    /// Greatest force that pushes dynamic bodies, in mass units · length units/s², 0 or more. Default 3000; with 0 they are
    /// walls.
    pub push_force: f32,
    /// Mass whose weight acts on dynamic bodies under the mover, in mass units, 0 or more. Default 2. Such bodies stay awake.
    pub mass: f32,
    /// Geoms of at least one of these categories are obstacles. Default all.
    pub categories: CollisionCategory,
    /// The mover's own categories: geoms that collide with none of them are no obstacles. Default all.
    pub as_categories: CollisionCategory,
}

impl Default for MoverOptions {
    fn default() -> Self {
        MoverOptions {
            acceleration: 1500.0,
            air_acceleration: 600.0,
            gravity_scale: 1.0,
            jump_height: 60.0,
            jump_cut: 0.5,
            coyote_time: 0.1,
            jump_buffer: 0.1,
            max_slope: 50f32.to_radians(),
            step_up: 8.0,
            snap: 8.0,
            push_force: 3000.0,
            mass: 2.0,
            categories: CollisionCategory::ALL,
            as_categories: CollisionCategory::ALL,
        }
    }
}

impl MoverOptions {
    /// The options with all lengths multiplied by a factor, greater than 0: 1.0 / 32.0 makes those of a game in metres with 32
    /// px each.
    ///
    /// ```
    /// use farseer_core::MoverOptions;
    /// assert_eq!(MoverOptions::default().scaled(1.0 / 32.0).step_up, 0.25);
    /// ```
    #[must_use]
    pub fn scaled(self, factor: f32) -> Self {
        MoverOptions {
            acceleration: self.acceleration * factor,
            air_acceleration: self.air_acceleration * factor,
            jump_height: self.jump_height * factor,
            step_up: self.step_up * factor,
            snap: self.snap * factor,
            push_force: self.push_force * factor,
            ..self
        }
    }

    pub(super) fn check(&self) -> Result<()> {
        let numbers = [
            ("acceleration", self.acceleration),
            ("air_acceleration", self.air_acceleration),
            ("gravity_scale", self.gravity_scale),
            ("jump_height", self.jump_height),
            ("coyote_time", self.coyote_time),
            ("jump_buffer", self.jump_buffer),
            ("step_up", self.step_up),
            ("snap", self.snap),
            ("push_force", self.push_force),
            ("mass", self.mass),
        ];
        for (argument, value) in numbers {
            zero_or_more(argument, value)?;
        }
        if !(0.0..=1.0).contains(&self.jump_cut) {
            return Err(Error::invalid("jump_cut", self.jump_cut, "from 0 to 1"));
        }
        if !(0.0..std::f32::consts::FRAC_PI_2).contains(&self.max_slope) {
            let range = "0 or more and less than a quarter turn";
            return Err(Error::invalid("max_slope", self.max_slope, range));
        }
        Ok(())
    }

    /// Least upward component of a ground's normal, dimensionless.
    pub(super) fn min_up(&self) -> f64 {
        f64::from(scalar::sin_cos(self.max_slope).1)
    }
}

/// Input of a player for one move.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct MoverInput {
    /// Wanted speed along X, in length units/s, relative to the present or last ground.
    pub x: f32,
    /// Whether the jump key is down. A jump begins when it goes down.
    pub jump: bool,
    /// Whether to drop through one-way ground.
    pub drop: bool,
}
