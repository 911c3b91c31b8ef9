//! Blows: bodies in reach of a strike, its effect, and the hit-stop.

use twohalf::farseer_core::Error;
use twohalf::{GeomId, Result, TwoHalfPhysicsSimulator, Vector3};

use crate::Spawned;

/// A blow: its reach and effect. Lengths in px.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Blow {
    /// Reach in front of the striker, from its side on, px.
    pub reach: f32,
    /// Least and greatest height above the striker's soles, px.
    pub heights: [f32; 2],
    /// Reach to the front and to the back of the striker's middle, px.
    pub half_depth: f32,
    /// Velocity of the target after the blow, px/s: forwards and up, independent of its mass.
    pub velocity: [f32; 2],
    /// Number of updates of hit-stop, in which the [time](TwoHalfPhysicsSimulator::stop_time) of striker and
    /// targets is stopped.
    pub stop: u32,
}

impl Default for Blow {
    /// A punch of a figure of about 60 px.
    fn default() -> Self {
        Blow { reach: 30.0, heights: [18.0, 52.0], half_depth: 16.0, velocity: [180.0, 160.0], stop: 8 }
    }
}

/// Strikes to the left or to the right. Returns the struck geoms in the order of the geom list: those in
/// reach that `is_target` accepts, without those of the striker. Dynamic bodies get the velocity of the blow
/// after the hit-stop. Other bodies are struck as well and stay.
///
/// A character controller must be [let go](TwoHalfPhysicsSimulator::let_go) while it reels.
///
/// ```
/// use twohalf::{TwoHalfPhysicsSimulator, Vector2};
/// use twohalf_factories::{Blow, Figure, spawn, strike};
///
/// let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 900.0))?;
/// let [player, thug] = [60.0, 100.0].map(|x| spawn(&mut simulator, Figure::new([30.0, 60.0, 20.0]).at([x, 0.0, 50.0])));
/// let (player, thug) = (player?, thug?);
/// simulator.update(1.0 / 60.0);
/// let struck = strike(&mut simulator, player, false, &Blow { stop: 6, ..Blow::default() }, |_| true)?;
/// assert_eq!(struck, [thug.geom]);
/// for update in 0..30 {
///     simulator.update(1.0 / 60.0);
///     let place = simulator.body(thug.body).unwrap().position3d();
///     assert_eq!(place.x > 100.0, update >= 6);
/// }
/// # Ok::<(), twohalf::Error>(())
/// ```
///
/// # Errors
/// A stale striker; numbers that are not finite; lengths less than 0; heights of which the first exceeds the
/// second; a stop other than 0 with another scheme than
/// [`DepthScheme::Precise`](twohalf::DepthScheme::Precise). A failed call strikes none.
pub fn strike(
    simulator: &mut TwoHalfPhysicsSimulator,
    striker: Spawned,
    to_left: bool,
    blow: &Blow,
    mut is_target: impl FnMut(GeomId) -> bool,
) -> Result<Vec<GeomId>> {
    let mut struck = in_reach(simulator, striker, to_left, blow)?;
    struck.retain(|&geom| is_target(geom));
    if blow.stop > 0 && !struck.is_empty() {
        simulator.stop_time(striker.body, blow.stop)?;
    }
    let [forwards, up] = blow.velocity;
    let velocity = Vector3::new(if to_left { -forwards } else { forwards }, up, 0.0);
    for body in struck.iter().filter_map(|&geom| simulator.core().body_of(geom)).collect::<Vec<_>>() {
        let Some(mut view) = simulator.body_mut(body) else { continue };
        if view.is_static() || view.is_kinematic() {
            continue;
        }
        view.set_velocity3d(velocity);
        if blow.stop > 0 {
            simulator.stop_time(body, blow.stop)?;
        }
    }
    Ok(struck)
}

/// The geoms in reach of a blow, in the order of the geom list, without those of the striker: targets to
/// strike or to lift.
///
/// # Errors
/// A stale striker; numbers that are not finite; lengths less than 0; heights of which the first exceeds the
/// second.
pub fn in_reach(
    simulator: &TwoHalfPhysicsSimulator,
    striker: Spawned,
    to_left: bool,
    blow: &Blow,
) -> Result<Vec<GeomId>> {
    blow.check()?;
    let (low, high) = blow.hit_box(simulator, striker, to_left)?;
    let is_other = |geom| simulator.core().body_of(geom) != Some(striker.body);
    Ok(simulator.query_box(low, high, is_other))
}

impl Blow {
    fn check(&self) -> Result<()> {
        let [low, high] = self.heights;
        let lengths = [("reach", self.reach), ("half_depth", self.half_depth), ("heights", high - low)];
        for (argument, value) in lengths {
            if !(value.is_finite() && value >= 0.0) {
                Err(Error::invalid(argument, value, "finite and 0 or more"))?;
            }
        }
        for value in self.velocity {
            if !value.is_finite() {
                Err(Error::invalid("velocity", value, "finite"))?;
            }
        }
        Ok(())
    }

    /// Least and greatest X, Y and Z in reach, px.
    fn hit_box(
        &self,
        simulator: &TwoHalfPhysicsSimulator,
        striker: Spawned,
        to_left: bool,
    ) -> Result<(Vector3, Vector3)> {
        let stale = || Error::StaleId { argument: "striker" };
        let shape = simulator.geom(striker.geom).ok_or_else(stale)?.virtual_geom();
        let z = simulator.body(striker.body).ok_or_else(stale)?.position3d().z;
        let [left, right] = if to_left {
            [shape.left - self.reach, shape.left]
        } else {
            [shape.right, shape.right + self.reach]
        };
        let [low, high] = self.heights.map(|height| shape.bottom + height);
        Ok((Vector3::new(left, low, z - self.half_depth), Vector3::new(right, high, z + self.half_depth)))
    }
}
