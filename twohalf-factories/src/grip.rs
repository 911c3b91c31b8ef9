//! Carrying and throwing.

use serde::{Deserialize, Serialize};
use twohalf::farseer_core::Error;
use twohalf::{GeomId, Result, TwoHalfPhysicsSimulator, Vector3};

use crate::Spawned;

/// So near they are not apart yet, px.
const APART: f32 = 1.0;

/// Somebody holds something, or has just thrown it: plain data, kept and saved where the game keeps its things.
///
/// While it is held the load has no weight and is brought to where it is held by its velocity, so that it still bumps into walls and
/// people. It does not meet whoever holds it, nor after a throw until the two are apart: it has their
/// [collision group](twohalf::farseer_core::Geom::set_collision_group). Whoever has none gets one of their own for good, a number
/// near the greatest there is.
///
/// ```
/// use twohalf::{TwoHalfPhysicsSimulator, Vector2, Vector3};
/// use twohalf_factories::{Figure, Grip, Prism, spawn};
///
/// const STEP: f32 = 1.0 / 60.0;
/// let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 900.0))?;
/// let player = spawn(&mut simulator, Figure::new([30.0, 60.0, 20.0]).at([60.0, 0.0, 50.0]))?;
/// let load = spawn(&mut simulator, Prism::new([30.0, 30.0, 30.0]).mass(5.0).at([100.0, 0.0, 50.0]))?;
/// let mut grip = Grip::take(&mut simulator, player, load)?;
/// for _ in 0..30 {
///     // Before the chest, at no more than 480 px/s.
///     grip.carry(&mut simulator, Vector3::new(10.0, 34.0, 0.0), 480.0, STEP)?;
///     simulator.update(STEP);
/// }
/// assert!((simulator.body(load.body).unwrap().position3d().y - 34.0).abs() < 0.1);
///
/// // Thrown backwards, through whoever throws it.
/// grip.throw(&mut simulator, Vector3::new(-300.0, 100.0, 0.0))?;
/// while !grip.is_over(&mut simulator) {
///     simulator.update(STEP);
/// }
/// assert!(simulator.body(load.body).unwrap().position3d().x < 60.0 - 30.0);
/// # Ok::<(), twohalf::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Grip {
    holder: Spawned,
    load: Spawned,
    /// What the load had before.
    group: i32,
    ignored_gravity: bool,
    is_open: bool,
}

impl Grip {
    /// Lets somebody hold something.
    ///
    /// # Errors
    /// One that is there no more.
    pub fn take(simulator: &mut TwoHalfPhysicsSimulator, holder: Spawned, load: Spawned) -> Result<Self> {
        for (argument, Spawned { body, geom }) in [("holder", holder), ("load", load)] {
            if simulator.body(body).is_none() || simulator.geom(geom).is_none() {
                Err(Error::StaleId { argument })?;
            }
        }
        let group_of = |simulator: &TwoHalfPhysicsSimulator, geom: GeomId| {
            simulator.core().geom(geom).map_or(0, |geom| geom.collision_group())
        };
        let group = group_of(simulator, load.geom);
        let shared = match group_of(simulator, holder.geom) {
            0 => i32::MAX - i32::try_from(holder.geom.slot()).unwrap_or(0),
            own => own,
        };
        for geom in [holder.geom, load.geom] {
            if let Some(settings) = simulator.geom_mut(geom) {
                settings.set_collision_group(shared);
            }
        }
        let ignored_gravity = simulator.body(load.body).is_some_and(|body| body.ignore_gravity());
        Ok(Grip { holder, load, group, ignored_gravity, is_open: false })
    }

    /// What is held, or was thrown.
    pub fn load(&self) -> Spawned {
        self.load
    }

    /// Before an update of `dt` s: brings what is held to where it is held, as seen from the [place](twohalf::TwoHalfBody::position3d)
    /// of whoever holds it, no faster than `speed` px/s. Nothing happens after a throw.
    ///
    /// # Errors
    /// One that is there no more; numbers that are not finite; a speed less than 0, or a `dt` that is not greater than 0.
    pub fn carry(
        &self,
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
        let holder = simulator.body(self.holder.body).ok_or(Error::StaleId { argument: "holder" })?;
        let aim = holder.position3d() + held_at;
        let mut load = simulator.body_mut(self.load.body).ok_or(Error::StaleId { argument: "load" })?;
        if self.is_open {
            return Ok(());
        }
        let way = aim - load.position3d();
        let (distance, most) = (way.norm(), speed * dt);
        let way = if distance > most { way * (most / distance) } else { way };
        load.set_ignore_gravity(true);
        load.set_velocity3d(way / dt);
        Ok(())
    }

    /// Lets go of what is held, with a velocity in the world, px/s, Y up.
    ///
    /// # Errors
    /// A load that is there no more; a velocity that is not finite.
    pub fn throw(&mut self, simulator: &mut TwoHalfPhysicsSimulator, velocity: Vector3) -> Result<()> {
        if !velocity.iter().all(|number| number.is_finite()) {
            Err(Error::invalid("velocity", velocity, "finite"))?;
        }
        let mut load = simulator.body_mut(self.load.body).ok_or(Error::StaleId { argument: "load" })?;
        load.set_ignore_gravity(self.ignored_gravity);
        load.set_velocity3d(velocity);
        self.is_open = true;
        Ok(())
    }

    /// After updates: whether it was thrown and is apart from whoever threw it. Then the two meet again, and this is
    /// to be forgotten. So it is when one of them is there no more.
    pub fn is_over(&self, simulator: &mut TwoHalfPhysicsSimulator) -> bool {
        let shapes = [self.holder.geom, self.load.geom].map(|geom| simulator.geom(geom));
        let [Some(holder), Some(load)] = shapes.map(|geom| geom.map(|geom| geom.virtual_geom())) else {
            return true;
        };
        let is_apart = holder.left > load.right + APART
            || load.left > holder.right + APART
            || holder.bottom > load.top + APART
            || load.bottom > holder.top + APART
            || holder.front > load.back + APART
            || load.front > holder.back + APART;
        let is_over = self.is_open && is_apart;
        if is_over && let Some(settings) = simulator.geom_mut(self.load.geom) {
            settings.set_collision_group(self.group);
        }
        is_over
    }
}
