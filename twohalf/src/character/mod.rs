//! Character controller: moves a body along floors by velocities, with steps, jumps, slopes and ledges.

mod capsule_ground;
mod character_footprint;
mod character_step;
mod ground_probe;
mod ledge;
mod neighbours;
mod wall_avoidance;

use serde::{Deserialize, Serialize};

use self::ledge::Ledge;
pub(crate) use self::neighbours::Neighbours;
use crate::error::{invalid, only_precise, stale};
use crate::{BodyId, ContactTarget, DepthScheme, Result, TwoHalfPhysicsSimulator, Vector3};
#[cfg(doc)]
use crate::{DepthProfile, TwoHalfBody};

/// Settings of a character controller. Lengths in px, times in s, angles in radians.
///
/// ```
/// # use twohalf::CharacterSettings;
/// let heavy = CharacterSettings { acceleration: 600.0, jump_height: 40.0, ..CharacterSettings::default() };
/// # assert_eq!(heavy.step_up, 8.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct CharacterSettings {
    /// Greatest acceleration towards the input on a floor, px/s², finite and 0 or more. It also limits the
    /// pushing force to mass times this. Default 1500.
    pub acceleration: f32,
    /// Greatest acceleration towards the input in the air, px/s², finite and 0 or more. Default 600.
    pub air_acceleration: f32,
    /// Height of a jump, px, finite and 0 or more. Default 60.
    pub jump_height: f32,
    /// Height of the highest curb or stair that is stepped up, px above the floor, finite and 0 or more. A
    /// curb of exactly this height counts. Default 8.
    pub step_up: f32,
    /// Greatest gap between sole and floor that is closed without a fall, px, finite and 0 or more. It keeps
    /// a standing character on slopes, curbs and lifts. Default 8.
    pub snap: f32,
    /// Slope of the steepest floor, radians from level, 0 or more and less than a quarter turn. Steeper
    /// surfaces are walls, and the character slides down. Default 50 degrees.
    pub max_slope: f32,
    /// Time after leaving an edge during which a jump is still allowed, s, finite and 0 or more. Default 0.1.
    pub coyote_time: f32,
    /// Height above the soles up to which a falling character grabs ledges, px, finite and 0 or more. Ledges
    /// are edges of platforms and of static and kinematic bodies, above step height. Default 0: it grabs
    /// none.
    pub ledge_reach: f32,
    /// Speed of the climb over a ledge, px/s, finite and 0 or more. Default 160.
    pub climb_speed: f32,
}

impl Default for CharacterSettings {
    fn default() -> Self {
        CharacterSettings {
            acceleration: 1500.0,
            air_acceleration: 600.0,
            jump_height: 60.0,
            step_up: 8.0,
            snap: 8.0,
            max_slope: 50f32.to_radians(),
            coyote_time: 0.1,
            ledge_reach: 0.0,
            climb_speed: 160.0,
        }
    }
}

impl CharacterSettings {
    fn check(&self) -> Result<()> {
        let lengths = [
            ("acceleration", self.acceleration),
            ("air_acceleration", self.air_acceleration),
            ("jump_height", self.jump_height),
            ("step_up", self.step_up),
            ("snap", self.snap),
            ("coyote_time", self.coyote_time),
            ("ledge_reach", self.ledge_reach),
            ("climb_speed", self.climb_speed),
        ];
        for (argument, value) in lengths {
            if !(value.is_finite() && value >= 0.0) {
                return Err(invalid(argument, value, "finite and 0 or more"));
            }
        }
        if !(0.0..std::f32::consts::FRAC_PI_2).contains(&self.max_slope) {
            return Err(invalid("max_slope", self.max_slope, "0 or more and less than a quarter turn"));
        }
        Ok(())
    }

    /// Least upward component of a floor's normal; dimensionless.
    fn min_up(&self) -> f32 {
        farseer_core::math::scalar::sin_cos(self.max_slope).1
    }
}

/// Input of a player for one step.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct MoveInput {
    /// Wanted speed along X, px/s, relative to the current or last floor.
    pub x: f32,
    /// Wanted speed along Z, px/s, relative to the current or last floor.
    pub z: f32,
    /// Whether the jump key was pressed in this step. If it stays true while the key is held, the character
    /// jumps again at each landing.
    pub jump: bool,
}

/// State of one character from step to step, for [`TwoHalfPhysicsSimulator::walk`]. It is plain data: the
/// game keeps and saves it next to the body's id.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct CharacterController {
    /// Settings; they may change at any time.
    pub walk: CharacterSettings,
    floor: Option<ContactTarget>,
    /// Velocity of the current or last floor, px/s, Y up.
    carried: Vector3,
    /// Upward velocity of the body that the last step of the controller set, px/s. A greater one shows that the character was
    /// thrown up.
    told: f32,
    /// Time since the character last stood, s.
    aloft: f32,
    has_jumped: bool,
    /// Whether the controller has switched gravity off for the body.
    is_held: bool,
    /// Ledge that the character hangs on; `None` if it hangs on none.
    ledge: Option<Ledge>,
}

impl CharacterController {
    /// A controller that has not moved its character yet.
    pub fn new(walk: CharacterSettings) -> Self {
        // A character that has not stood yet may not jump.
        CharacterController { walk, aloft: f32::MAX, ..CharacterController::default() }
    }

    /// Checks the settings and the numbers of a controller that was loaded.
    fn check(&self) -> Result<()> {
        self.walk.check()?;
        let numbers = [self.carried.x, self.carried.y, self.carried.z, self.told, self.aloft];
        if self.ledge.is_some_and(|ledge| !ledge.is_valid()) {
            return Err(invalid("walker", self.ledge, "one that hangs on an edge along X or Z"));
        }
        let wrong = numbers.into_iter().find(|number| !number.is_finite());
        wrong.map_or(Ok(()), |number| Err(invalid("walker", number, "without numbers that are not finite")))
    }

    /// Returns whether the character stood in the last call of [`walk`](TwoHalfPhysicsSimulator::walk). It stands on floors
    /// within the slope limit, also while it passes over a curb or the edge of a slope. A jump ends it. Games choose the
    /// animation by it.
    pub fn is_grounded(&self) -> bool {
        self.floor.is_some()
    }

    /// The floor that the character stands on; `None` in the air or on a ledge.
    pub fn floor(&self) -> Option<ContactTarget> {
        self.floor
    }

    /// The target whose ledge the character hangs on or climbs over; `None` if it does neither. Games choose the animation by
    /// it.
    pub fn ledge(&self) -> Option<ContactTarget> {
        self.ledge.map(|ledge| ledge.partner())
    }

    /// Velocity of the current or last floor or ledge in the world, px/s, Y up.
    pub fn carried(&self) -> Vector3 {
        self.carried
    }
}

impl TwoHalfPhysicsSimulator {
    /// Moves a character for one step: it walks, jumps and falls. Call it before each update, with the
    /// update's `dt` in s.
    ///
    /// The body needs an upright object geom and must not rotate. A [cylinder](DepthProfile::Cylinder) slides
    /// along others and round corners; a [capsule](DepthProfile::Capsule) or a box with a huge moment of
    /// inertia work as well. The geom is best without friction.
    ///
    /// - Its velocity along X and Z approaches the input with [`CharacterSettings::acceleration`], as seen
    ///   from above, on level ground and on slopes. Moving platforms, belts and bodies carry it.
    /// - It follows the floor: up curbs, down over edges, along slopes and lifts, without hopping. It stands
    ///   without sliding on slopes up to [`CharacterSettings::max_slope`]. Floors are the ground, platforms,
    ///   and bodies that are prisms; balls are none.
    /// - A capsule rests on its lower hemisphere. It lies on slopes without a gap and sinks round an edge
    ///   until the normal is steeper than [`CharacterSettings::max_slope`]; then it falls. A curb lifts it
    ///   like a flat sole.
    /// - A jump has the set height for every length of step.
    /// - Walls, and bodies in the air, stop it at their surface, so that their friction does not act on it.
    ///   On a floor it pushes bodies with a force of up to its mass times its acceleration.
    /// - While it falls, it grabs a ledge within [`CharacterSettings::ledge_reach`] along the input, if there
    ///   is room to stand. Without input it hangs and moves with the ledge. Input towards the ledge climbs
    ///   over it, input away from it lets go, and a jump leaves it.
    /// - Targets that an [`EventHandler`](crate::EventHandler) refuses neither support nor stop it: holes,
    ///   platforms to drop through, curbs, walls. An update with a handler calls
    ///   [`on_collision`](crate::EventHandler::on_collision) for each support, ledge and wall, and for each
    ///   curb within three steps. The answer holds for the next call of this function.
    /// - An impulse or velocity that would lift it by more than [`CharacterSettings::snap`] takes it off the
    ///   floor.
    ///
    /// The controller sets velocities and never positions, so the character does not pass through objects.
    /// While it stands, the body [ignores gravity](TwoHalfBody::set_ignore_gravity), and its weight acts on
    /// its support. A body that is to fall without the controller is [let go](Self::let_go).
    ///
    /// ```
    /// use twohalf::farseer_core::{BodyFactory, GeomPlacement, Vertices};
    /// use twohalf::{TwoHalfPhysicsSimulator, Vector2, CharacterSettings, CharacterController, MoveInput};
    ///
    /// let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 900.0))?;
    /// let mut body = BodyFactory::create_rectangle_body(30.0, 60.0, 70.0)?;
    /// body.set_moment_of_inertia(1e20)?;
    /// let figure = simulator.create_body(body);
    /// let geom =
    ///     simulator.create_geom(figure, Vertices::create_rectangle(30.0, 60.0)?, GeomPlacement::default())?;
    /// simulator.add(figure)?;
    /// simulator.add(geom)?;
    /// simulator.body_mut(figure).unwrap().ground_mut().set_object_geom(geom, None)?;
    ///
    /// let mut walker = CharacterController::new(CharacterSettings::default());
    /// for _ in 0..60 {
    ///     simulator.walk(figure, &mut walker, MoveInput { x: 150.0, ..MoveInput::default() }, 1.0 / 60.0)?;
    ///     simulator.update(1.0 / 60.0);
    /// }
    /// assert!(walker.is_grounded());
    /// assert!((simulator.body(figure).unwrap().velocity3d().x - 150.0).abs() < 0.5);
    /// # Ok::<(), twohalf::Error>(())
    /// ```
    ///
    /// # Errors
    /// A stale body, or one without an object geom. Settings out of their ranges. A loaded controller with
    /// numbers that are not finite. An input that is not finite. A `dt` that is not finite and greater than
    /// 0. Another scheme than [`DepthScheme::Precise`].
    pub fn walk(
        &mut self,
        body: BodyId,
        walker: &mut CharacterController,
        wish: MoveInput,
        dt: f32,
    ) -> Result<()> {
        if self.world.scheme != DepthScheme::Precise {
            return Err(only_precise("figures that walk"));
        }
        for (argument, value) in [("wish.x", wish.x), ("wish.z", wish.z)] {
            if !value.is_finite() {
                return Err(invalid(argument, value, "finite"));
            }
        }
        if !(dt.is_finite() && dt > 0.0) {
            return Err(invalid("dt", dt, "finite and greater than 0"));
        }
        let geom = self.body(body).ok_or(stale("body"))?.ground().object_geom();
        let geom = geom.ok_or_else(|| invalid("body", body, "one with an object geom"))?;
        walker.check()?;
        if self.time_scale(body) == 0.0 {
            return Ok(());
        }
        self.world.platforms.sort();
        self.move_character(body, geom, walker, wish, dt);
        Ok(())
    }

    /// Gives a character back to gravity with its present velocity: knocked out, thrown, or no longer
    /// controlled. [`walk`](Self::walk) may take it over again at any time.
    ///
    /// # Errors
    /// A stale body.
    pub fn let_go(&mut self, body: BodyId, walker: &mut CharacterController) -> Result<()> {
        self.body(body).ok_or(stale("body"))?;
        self.suspend_gravity(body, walker, false);
        (walker.floor, walker.ledge, walker.aloft) = (None, None, f32::MAX);
        Ok(())
    }
}
