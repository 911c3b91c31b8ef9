//! Hands: carrying and throwing.

use serde::{Deserialize, Serialize};
use twohalf::farseer_core::Error;
use twohalf::{GeomId, Result, TwoHalfPhysicsSimulator, Vector3};

use crate::Spawned;

/// Distance up to which two bodies count as touching, px.
const SEPARATION_TOLERANCE: f32 = 1.0;
/// Default reach of hands as a factor of the holder's height, dimensionless: an arm and a step.
const DEFAULT_REACH_FACTOR: f32 = 1.0;

/// Hands of a character with the load that they hold and the loads just thrown. They are plain data: the game
/// keeps and saves them.
///
/// A held load has no weight. Its velocity brings it to the point where it is held, so that it still bumps
/// into walls and characters. It does not collide with its holder, nor after a throw until the two are apart:
/// it has the holder's [collision group](twohalf::farseer_core::Geom::set_collision_group). A holder without
/// a group gets one for good, a number near the greatest there is.
///
/// The load is lost when it is farther than [the reach](Self::set_reach) from its point: behind a wall, or
/// teleported. It is also lost when it or its holder is disposed or disabled. It gets its weight back then,
/// and [`carry`](Self::carry) queues an [`Event::GripBroke`](twohalf::Event::GripBroke) for the next update.
///
/// ```
/// use twohalf::{TwoHalfPhysicsSimulator, Vector2, Vector3};
/// use twohalf_factories::{Figure, Hands, Prism, spawn};
///
/// const STEP: f32 = 1.0 / 60.0;
/// // Before the chest.
/// const HELD_AT: Vector3 = Vector3::new(10.0, 34.0, 0.0);
/// let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 900.0))?;
/// let player = spawn(&mut simulator, Figure::new([30.0, 60.0, 20.0]).at([60.0, 0.0, 50.0]))?;
/// let load = spawn(&mut simulator, Prism::new([30.0, 30.0, 30.0]).mass(5.0).at([100.0, 0.0, 50.0]))?;
/// let mut hands = Hands::default();
/// hands.take(&mut simulator, player, load)?;
/// for _ in 0..30 {
///     hands.carry(&mut simulator, HELD_AT, 480.0, STEP)?;
///     simulator.update(STEP);
/// }
/// assert!((load.place(&simulator) - player.place(&simulator) - HELD_AT).norm() < 0.1);
///
/// // Thrown backwards, through the thrower.
/// assert_eq!(hands.throw(&mut simulator, Vector3::new(-300.0, 100.0, 0.0))?, Some(load));
/// for _ in 0..30 {
///     hands.carry(&mut simulator, HELD_AT, 480.0, STEP)?;
///     simulator.update(STEP);
/// }
/// assert!(load.place(&simulator).x < 60.0 - 30.0);
/// # Ok::<(), twohalf::Error>(())
/// ```
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Hands {
    held: Option<Grip>,
    /// Thrown loads that are not apart from the thrower yet.
    thrown: Vec<Grip>,
    reach: Option<f32>,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Grip {
    holder: Spawned,
    load: Spawned,
    /// Collision group of the load before the grip: a number, 0 is no group.
    group: i32,
    ignored_gravity: bool,
    /// Least distance so far from the point where it is held, px. A load from beyond the reach must not move
    /// away again.
    nearest: Option<f32>,
}

impl Hands {
    /// The held load.
    pub fn held(&self) -> Option<Spawned> {
        self.held.map(|grip| grip.load)
    }

    /// Greatest distance of the load from its point, px; `None` for the height of the holder.
    pub fn reach(&self) -> Option<f32> {
        self.reach
    }

    /// Sets the greatest distance of the load from its point, px, 0 or more, beyond which it is lost. `None`,
    /// the default, is the height of the holder. A load that was taken from farther away is not lost while it
    /// comes nearer. The next [`carry`](Self::carry) uses it.
    ///
    /// # Errors
    /// A reach that is not finite, or less than 0.
    pub fn set_reach(&mut self, reach: Option<f32>) -> Result<()> {
        if let Some(reach) = reach.filter(|reach| !(reach.is_finite() && *reach >= 0.0)) {
            Err(Error::invalid("reach", reach, "finite and 0 or more"))?;
        }
        self.reach = reach;
        Ok(())
    }

    /// Takes a load for a holder and drops the present load.
    ///
    /// # Errors
    /// A stale holder or load.
    pub fn take(
        &mut self,
        simulator: &mut TwoHalfPhysicsSimulator,
        holder: Spawned,
        load: Spawned,
    ) -> Result<()> {
        for (argument, Spawned { body, geom }) in [("holder", holder), ("load", load)] {
            if simulator.body(body).is_none() || simulator.geom(geom).is_none() {
                Err(Error::StaleId { argument })?;
            }
        }
        self.throw(simulator, Vector3::zeros())?;
        // A load that is caught again before it was apart keeps its former group.
        let known = self.thrown.iter().position(|grip| grip.load == load).map(|at| self.thrown.remove(at));
        let group = known.map_or_else(|| group_of(simulator, load.geom), |grip| grip.group);
        let shared = match group_of(simulator, holder.geom) {
            0 => i32::MAX - i32::try_from(holder.geom.slot()).unwrap_or(0),
            own => own,
        };
        for geom in [holder.geom, load.geom] {
            set_group(simulator, geom, shared);
        }
        let ignored_gravity = simulator.body(load.body).is_some_and(|body| body.ignore_gravity());
        self.held = Some(Grip { holder, load, group, ignored_gravity, nearest: None });
        Ok(())
    }

    /// Call before every update of `dt` s. The load moves to `held_at`, px, relative to the
    /// [position](twohalf::TwoHalfBody::position3d) of the holder, no faster than `speed` px/s, unless it is
    /// [lost](Self::set_reach). Thrown loads that are apart now collide with their thrower again.
    ///
    /// # Errors
    /// Numbers that are not finite; a speed less than 0, or a `dt` that is not greater than 0.
    pub fn carry(
        &mut self,
        simulator: &mut TwoHalfPhysicsSimulator,
        held_at: Vector3,
        speed: f32,
        dt: f32,
    ) -> Result<()> {
        if !(speed.is_finite() && speed >= 0.0) {
            Err(Error::invalid("speed", speed, "finite and 0 or more"))?;
        }
        if !(dt.is_finite() && dt > 0.0) {
            Err(Error::invalid("dt", dt, "finite and greater than 0"))?;
        }
        if !held_at.iter().all(|number| number.is_finite()) {
            Err(Error::invalid("held_at", held_at, "finite"))?;
        }
        self.thrown.retain(|grip| !grip.is_apart_now(simulator));
        let Some(mut grip) = self.held.take() else { return Ok(()) };
        let reach = self.reach.unwrap_or_else(|| DEFAULT_REACH_FACTOR * grip.height_of_holder(simulator));
        if grip.keeps(simulator, held_at, reach) {
            grip.bring(simulator, held_at, speed * dt, dt);
            self.held = Some(grip);
        } else {
            simulator.report_grip_broken(grip.holder.body, grip.load.body);
            grip.release(simulator);
            self.thrown.push(grip);
        }
        Ok(())
    }

    /// Releases the load with a velocity in the world, px/s, Y up, and returns it. A velocity of 0 drops it.
    ///
    /// # Errors
    /// A velocity that is not finite.
    pub fn throw(
        &mut self,
        simulator: &mut TwoHalfPhysicsSimulator,
        velocity: Vector3,
    ) -> Result<Option<Spawned>> {
        if !velocity.iter().all(|number| number.is_finite()) {
            Err(Error::invalid("velocity", velocity, "finite"))?;
        }
        let Some(grip) = self.held.take() else { return Ok(None) };
        grip.release(simulator);
        let Some(mut load) = simulator.body_mut(grip.load.body) else { return Ok(None) };
        load.set_velocity3d(velocity);
        self.thrown.push(grip);
        Ok(Some(grip.load))
    }
}

impl Grip {
    fn height_of_holder(&self, simulator: &TwoHalfPhysicsSimulator) -> f32 {
        let shape = simulator.geom(self.holder.geom).map(|geom| geom.virtual_geom());
        shape.map_or(0.0, |shape| shape.top - shape.bottom)
    }

    /// Vector from the load to the point where it is held, px; `None` if holder or load is stale or disabled.
    fn way(&self, simulator: &TwoHalfPhysicsSimulator, held_at: Vector3) -> Option<Vector3> {
        let place = |body| Some(simulator.body(body).filter(|body| body.enabled())?.position3d());
        let way = place(self.holder.body)? + held_at - place(self.load.body)?;
        way.iter().all(|number| number.is_finite()).then_some(way)
    }

    /// Whether the load is in reach, or has not moved farther away.
    fn keeps(&mut self, simulator: &TwoHalfPhysicsSimulator, held_at: Vector3, reach: f32) -> bool {
        let Some(distance) = self.way(simulator, held_at).map(|way| way.norm()) else { return false };
        let allowed = self.nearest.map_or(distance, |nearest| nearest + SEPARATION_TOLERANCE).max(reach);
        self.nearest = Some(self.nearest.map_or(distance, |nearest| nearest.min(distance)));
        distance <= allowed
    }

    fn bring(&self, simulator: &mut TwoHalfPhysicsSimulator, held_at: Vector3, most: f32, dt: f32) {
        let Some(way) = self.way(simulator, held_at) else { return };
        let Some(mut load) = simulator.body_mut(self.load.body) else { return };
        let distance = way.norm();
        let way = if distance > most { way * (most / distance) } else { way };
        load.set_ignore_gravity(true);
        load.set_velocity3d(way / dt);
        load.set_angular_velocity(0.0);
    }

    /// Restores the weight of the load.
    fn release(&self, simulator: &mut TwoHalfPhysicsSimulator) {
        if let Some(mut load) = simulator.body_mut(self.load.body) {
            load.set_ignore_gravity(self.ignored_gravity);
        }
    }

    /// Whether thrower and load are apart, or one of them is stale. If so, restores the collision group.
    fn is_apart_now(&self, simulator: &mut TwoHalfPhysicsSimulator) -> bool {
        let shapes = [self.holder.geom, self.load.geom].map(|geom| simulator.geom(geom));
        let [Some(a), Some(b)] = shapes.map(|geom| geom.map(|geom| geom.virtual_geom())) else {
            set_group(simulator, self.load.geom, self.group);
            return true;
        };
        let is_apart = |[low, high]: [f32; 2], [other_low, other_high]: [f32; 2]| {
            low > other_high + SEPARATION_TOLERANCE || other_low > high + SEPARATION_TOLERANCE
        };
        let is_apart_now = is_apart([a.left, a.right], [b.left, b.right])
            || is_apart([a.bottom, a.top], [b.bottom, b.top])
            || is_apart([a.front, a.back], [b.front, b.back]);
        if is_apart_now {
            set_group(simulator, self.load.geom, self.group);
        }
        is_apart_now
    }
}

fn group_of(simulator: &TwoHalfPhysicsSimulator, geom: GeomId) -> i32 {
    simulator.core().geom(geom).map_or(0, |geom| geom.collision_group())
}

fn set_group(simulator: &mut TwoHalfPhysicsSimulator, geom: GeomId, group: i32) {
    if let Some(settings) = simulator.geom_mut(geom) {
        settings.set_collision_group(group);
    }
}
