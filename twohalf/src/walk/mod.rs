//! Figures that walk.

mod feet;
mod floor;
mod ledge;
mod near;
mod rest;
mod stride;
mod walls;

use serde::{Deserialize, Serialize};

use self::ledge::Ledge;
pub(crate) use self::near::Near;
use crate::error::{invalid, only_precise, stale};
use crate::{BodyId, DepthScheme, Partner, Result, TwoHalfPhysicsSimulator, Vector3};
#[cfg(doc)]
use crate::{DepthProfile, TwoHalfBody};

/// How a figure walks. Lengths in px, times in s, angles in rad.
///
/// ```
/// # use twohalf::Walk;
/// let heavy = Walk { acceleration: 600.0, jump_height: 40.0, ..Walk::default() };
/// # assert_eq!(heavy.step_up, 8.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Walk {
    /// How fast the figure takes up the speed that is wished, px/s², while it stands on something. It is also how hard it
    /// pushes: a force of its mass times this. Default 1500.
    pub acceleration: f32,
    /// The same in the air. Default 600.
    pub air_acceleration: f32,
    /// How far the soles rise in a jump, px. Default 60.
    pub jump_height: f32,
    /// The highest curb or stair, measured from the floor that is stood on, that is walked up as if it were none, px; one of exactly
    /// this height is. Default 8.
    pub step_up: f32,
    /// How far below the soles the floor may be for a figure that stood to be put down on it instead of falling, px: over the
    /// edge of a slope, down a curb, on a lift. Default 8.
    pub snap: f32,
    /// The steepest slope that is a floor, rad from level, less than a quarter turn. What is steeper is a wall, and slid down.
    /// Default 50 degrees.
    pub max_slope: f32,
    /// For how long one may still jump after having walked over an edge, s. Default 0.1.
    pub coyote_time: f32,
    /// How high over its soles an edge may be that a figure takes hold of while it falls, px: of platforms, and of static and kinematic
    /// bodies. Default 0: it takes hold of none. What is a step for it is none to hold on to.
    pub ledge_reach: f32,
    /// How fast it climbs over an edge, px/s. Default 160.
    pub climb_speed: f32,
}

impl Default for Walk {
    fn default() -> Self {
        Walk {
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

impl Walk {
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

    /// Least upward part of the normal of a floor.
    fn least_up(&self) -> f32 {
        farseer_core::math::scalar::sin_cos(self.max_slope).1
    }
}

/// What a player wishes in a step.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Wish {
    /// Speed along X, px/s, against what the figure stands on, or stood on last.
    pub x: f32,
    /// Speed along Z, px/s, likewise.
    pub z: f32,
    /// Whether the key was pressed just now: true for as long as it is held makes it jump again at each landing.
    pub jump: bool,
}

/// One figure that walks: what [`TwoHalfPhysicsSimulator::walk`] needs to know of the steps before. Plain data, to be kept and
/// saved by the game next to the body's id.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Walker {
    /// How it walks. May be changed at any time.
    pub walk: Walk,
    floor: Option<Partner>,
    /// Velocity of the floor, or of the last one.
    carried: Vector3,
    /// Upward velocity that it was given.
    told: f32,
    /// Since it stood, s.
    aloft: f32,
    has_jumped: bool,
    /// Gravity is kept from it.
    is_held: bool,
    /// What it hangs on.
    ledge: Option<Ledge>,
}

impl Walker {
    /// A figure that has not walked yet.
    pub fn new(walk: Walk) -> Self {
        // What stands nowhere yet may not jump.
        Walker { walk, aloft: f32::MAX, ..Walker::default() }
    }

    /// What was loaded may hold anything.
    fn check(&self) -> Result<()> {
        self.walk.check()?;
        let numbers = [self.carried.x, self.carried.y, self.carried.z, self.told, self.aloft];
        if self.ledge.is_some_and(|ledge| !ledge.is_valid()) {
            return Err(invalid("walker", self.ledge, "one that hangs on an edge along X or Z"));
        }
        let wrong = numbers.into_iter().find(|number| !number.is_finite());
        wrong.map_or(Ok(()), |number| Err(invalid("walker", number, "without numbers that are not finite")))
    }

    /// Whether the figure stood, by the last call of [`walk`](TwoHalfPhysicsSimulator::walk): on a floor that is not too steep,
    /// also on the way over a curb or the edge of a slope; not from the step of a jump on. What to choose a picture by.
    pub fn is_grounded(&self) -> bool {
        self.floor.is_some()
    }

    /// What it stood on.
    pub fn floor(&self) -> Option<Partner> {
        self.floor
    }

    /// On whose edge it hangs, or over whose edge it climbs. What to choose a picture by.
    pub fn ledge(&self) -> Option<Partner> {
        self.ledge.map(|ledge| ledge.partner())
    }

    /// Velocity in the world, px/s, Y up, of what it stands or hangs on, or did last.
    pub fn carried(&self) -> Vector3 {
        self.carried
    }
}

impl TwoHalfPhysicsSimulator {
    /// Lets a figure walk, jump and fall as a player expects: to be called before each update, with the update's `dt` in s. The
    /// figure is a body whose object geom is upright and does not turn: best a [cylinder](DepthProfile::Cylinder), which slides past
    /// others and round corners, a [capsule](DepthProfile::Capsule), or a box with a huge moment of inertia; best without friction.
    ///
    /// - Its velocity along X and Z, as seen from above, becomes what is wished, as fast as [`Walk::acceleration`] allows; up and
    ///   down slopes alike. What it stands on carries it: platforms that move, belts, bodies.
    /// - It follows the floor: up curbs, down over edges, up and down slopes and lifts, without hopping. A slope up to
    ///   [`Walk::max_slope`] is stood on without sliding. The floor is the ground, platforms, and bodies that are
    ///   prisms; not balls.
    /// - A capsule stands on what its round end touches: it lies on slopes without a gap, and sinks round an edge that it walks
    ///   over, as far as the direction in which that holds it is no steeper than [`Walk::max_slope`]; from there it falls. It stands
    ///   still before that as it does on a slope. Up a curb it is lifted as one with soles is, when it would touch its edge.
    /// - It jumps as high as it is told, whatever the step is.
    /// - It leans on nothing: walls and, in the air, bodies stop it at their surface, so that their friction holds it neither up
    ///   nor back. On the floor it pushes bodies as hard as its mass and acceleration allow.
    /// - While it falls, it takes hold of an edge within [`Walk::ledge_reach`] towards which it wishes, if there is room for it to
    ///   stand there. Without a wish it hangs there, and goes where the edge goes; with the same wish it climbs over it, with the
    ///   opposite one it lets go, and it may jump off.
    /// - What an [`EventHandler`](crate::EventHandler) refuses to let it touch holds it neither up nor back: a hole that is no ground,
    ///   a platform that it falls through, a curb or a wall. In an update with a handler that is asked, in
    ///   [`on_collision`](crate::EventHandler::on_collision), about what the figure stands on, hangs on, is held off from, or will step
    ///   on within three updates, as if it touched that; the answer holds for the next call of this.
    /// - Whoever throws it up, by an impulse or a velocity, is obeyed: it lets go of the floor from the speed on that would lift
    ///   it by more than [`Walk::snap`].
    ///
    /// All of this is done by velocities, never by places: nothing is walked through. While the figure stands, it
    /// [ignores gravity](TwoHalfBody::set_ignore_gravity), and what it stands on bears its weight; what is to fall without
    /// walking any more is [let go](Self::let_go).
    ///
    /// ```
    /// use twohalf::farseer_core::{BodyFactory, GeomPlacement, Vertices};
    /// use twohalf::{TwoHalfPhysicsSimulator, Vector2, Walk, Walker, Wish};
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
    /// let mut walker = Walker::new(Walk::default());
    /// for _ in 0..60 {
    ///     simulator.walk(figure, &mut walker, Wish { x: 150.0, ..Wish::default() }, 1.0 / 60.0)?;
    ///     simulator.update(1.0 / 60.0);
    /// }
    /// assert!(walker.is_grounded());
    /// assert!((simulator.body(figure).unwrap().velocity3d().x - 150.0).abs() < 0.5);
    /// # Ok::<(), twohalf::Error>(())
    /// ```
    ///
    /// # Errors
    /// A stale body, or one without an object geom; settings of the walk out of their ranges, or a walker that was loaded with
    /// numbers that are not finite; a wish that is not finite; a `dt` that is not finite and greater than 0; another scheme than
    /// [`DepthScheme::Precise`].
    pub fn walk(&mut self, body: BodyId, walker: &mut Walker, wish: Wish, dt: f32) -> Result<()> {
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
        self.stride(body, geom, walker, wish, dt);
        Ok(())
    }

    /// Gives a figure back to gravity, with the velocity that it has: knocked out, thrown, or no figure any more. It may
    /// [walk](Self::walk) again at any time.
    ///
    /// # Errors
    /// A stale body.
    pub fn let_go(&mut self, body: BodyId, walker: &mut Walker) -> Result<()> {
        self.body(body).ok_or(stale("body"))?;
        self.hold(body, walker, false);
        (walker.floor, walker.ledge, walker.aloft) = (None, None, f32::MAX);
        Ok(())
    }
}
