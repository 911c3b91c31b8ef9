//! Bodies whose time passes more slowly than that of the others, or not at all.
//!
//! Between updates a body has what is its own: the velocities, mass and gravity of its own time. During an update it is what
//! others see of it. So setters, impulses and saves need to know nothing of this.

use farseer_core::{BodyId, PhysicsSimulator};
use serde::{Deserialize, Serialize};

use crate::depth::is_movable;
use crate::error::{invalid, only_precise, stale};
use crate::world::World;
use crate::{DepthScheme, Result, TwoHalfPhysicsSimulator, Vector2};

/// Slower than this is still, so that no number of a slow body is out of range.
const SLOWEST: f32 = 0.01;

/// A body with a time of its own.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) struct Pace {
    body: BodyId,
    scale: f32,
    /// For so many updates still it stands still.
    stops: u32,
    #[serde(skip)]
    own: Option<Own>,
}

/// What is its own, while it is in an update as others see it.
#[derive(Debug, Clone, Copy)]
struct Own {
    /// Of this update; 0 stands still.
    scale: f32,
    motion: Motion,
    mass: f32,
    moment_of_inertia: f32,
    gravity_scale: f32,
    quadratic_drag: f32,
    rotational_drag: f32,
    /// What others see.
    seen: Motion,
}

#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Motion {
    velocity: Vector2,
    velocity_z: f32,
    spin: f32,
    spin_xy: [f32; 2],
}

impl Motion {
    fn times(self, factor: f32) -> Self {
        Motion {
            velocity: self.velocity * factor,
            velocity_z: self.velocity_z * factor,
            spin: self.spin * factor,
            spin_xy: self.spin_xy.map(|spin| spin * factor),
        }
    }
}

impl Pace {
    fn scale_now(&self) -> f32 {
        if self.stops > 0 { 0.0 } else { self.scale }
    }

    fn is_over(&self) -> bool {
        self.scale == 1.0 && self.stops == 0
    }

    /// What was loaded may hold anything.
    pub(crate) fn is_valid(&self) -> bool {
        is_scale(self.scale)
    }
}

fn is_scale(scale: f32) -> bool {
    scale == 0.0 || (SLOWEST..=1.0).contains(&scale)
}

/// Time of single bodies.
impl TwoHalfPhysicsSimulator {
    /// How fast the time of a body passes: 1 as for all others, unless it was set; 0 while it
    /// [stands still](Self::stop_time), and for stale ids 1.
    pub fn time_scale(&self, body: BodyId) -> f32 {
        let pace = self.world.paces.iter().find(|pace| pace.body == body);
        pace.map_or(1.0, Pace::scale_now)
    }

    /// Lets the time of a body pass `scale` times as fast as that of the others: 1 as for them, 0 not at all, else 0.01 to 1.
    ///
    /// Left alone, the body goes in t seconds the way that it would have gone in `scale` · t, with the same places on it. Its
    /// velocities, forces, mass and gravity are those of its own time: they are what is read and set between updates, and stay
    /// what they are when the scale changes. To others it moves `scale` times as fast, and is 1 / `scale` times as heavy,
    /// so that its momentum is what it was: a blow gives it the same velocity of its own at any scale.
    ///
    /// With 0 it stands where it is, as solid as what is [kinematic](crate::TwoHalfBody::set_is_kinematic): others lie on it and bounce
    /// off it, and none moves it. Its velocity waits. Impulses that are applied to it change that, and a velocity may be set; forces do
    /// nothing, for there is no time in which they could, and what touches it gives it nothing. When its time goes on, it meets anew what it touched.
    ///
    /// Figures [walk](Self::walk) in their own time, with the wishes of their own time; called while it stands still, `walk`
    /// does nothing. Callbacks see the body as others do. Static and kinematic bodies have no time of their own.
    ///
    /// ```
    /// # use twohalf::{TwoHalfPhysicsSimulator, Vector2, Vector3, farseer_core::BodyFactory};
    /// let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 900.0))?;
    /// let stone = simulator.create_body(BodyFactory::create_circle_body(10.0, 1.0)?);
    /// simulator.add(stone)?;
    /// simulator.body_mut(stone).unwrap().set_position3d(Vector3::new(0.0, 500.0, 0.0));
    /// simulator.set_time_scale(stone, 0.5)?;
    /// (0..120).for_each(|_| simulator.update(1.0 / 120.0));
    /// // In half a second of its own: 900 / 2 · 0.5².
    /// let stone = simulator.body(stone).unwrap();
    /// assert!((stone.position3d().y - (500.0 - 112.5)).abs() < 0.5);
    /// assert!((stone.velocity3d().y + 450.0).abs() < 0.5);
    /// # Ok::<(), twohalf::Error>(())
    /// ```
    ///
    /// # Errors
    /// A stale body; a scale that is none of these; another scheme than [`DepthScheme::Precise`].
    pub fn set_time_scale(&mut self, body: BodyId, scale: f32) -> Result<()> {
        if !is_scale(scale) {
            return Err(invalid("scale", scale, "0, or 0.01 to 1"));
        }
        self.pace_of(body)?.scale = scale;
        Ok(())
    }

    /// Lets a body stand still for so many updates, as a [scale](Self::set_time_scale) of 0 does, and go on by itself: the
    /// hit-stop of whoever strikes and is struck. It replaces what is left of an earlier stop; 0 ends it.
    ///
    /// # Errors
    /// A stale body; another scheme than [`DepthScheme::Precise`].
    pub fn stop_time(&mut self, body: BodyId, updates: u32) -> Result<()> {
        self.pace_of(body)?.stops = updates;
        Ok(())
    }

    fn pace_of(&mut self, body: BodyId) -> Result<&mut Pace> {
        if self.world.scheme != DepthScheme::Precise {
            return Err(only_precise("bodies with a time of their own"));
        }
        self.core.body(body).ok_or(stale("body"))?;
        let paces = &mut self.world.paces;
        let at = paces.iter().position(|pace| pace.body == body).unwrap_or_else(|| {
            paces.push(Pace { body, scale: 1.0, stops: 0, own: None });
            paces.len() - 1
        });
        Ok(&mut paces[at])
    }
}

impl World {
    /// An update begins: bodies become what others see of them.
    pub(crate) fn slow_down(&mut self, core: &mut PhysicsSimulator) {
        if self.paces.is_empty() {
            return;
        }
        let mut paces = std::mem::take(&mut self.paces);
        paces.retain(|pace| !pace.is_over() && core.body(pace.body).is_some());
        for pace in &mut paces {
            let is_slow = is_movable(core, pace.body) && pace.scale_now() < 1.0;
            pace.own = if is_slow { self.as_seen(core, pace.body, pace.scale_now()) } else { None };
        }
        self.paces = paces;
    }

    /// It ends: they become what they are.
    pub(crate) fn catch_up(&mut self, core: &mut PhysicsSimulator, has_moved: bool) {
        for at in 0..self.paces.len() {
            let Pace { body, ref mut own, ref mut stops, .. } = self.paces[at];
            if has_moved {
                *stops = stops.saturating_sub(1);
            }
            if let Some(own) = own.take() {
                self.give_back(core, body, own);
            }
        }
    }

    fn motion(&self, core: &PhysicsSimulator, body: BodyId) -> Option<Motion> {
        let (plane, state) = (core.body(body)?, self.depths.bodies.get(body)?);
        Some(Motion {
            velocity: plane.linear_velocity(),
            velocity_z: state.velocity_z,
            spin: plane.angular_velocity(),
            spin_xy: [state.angular_velocity_x, state.angular_velocity_y],
        })
    }

    fn set_motion(&mut self, core: &mut PhysicsSimulator, body: BodyId, motion: Motion) {
        let (Some(plane), Some(state)) = (core.body_mut(body), self.depths.edit(body)) else { return };
        plane.set_linear_velocity(motion.velocity);
        plane.set_angular_velocity(motion.spin);
        state.velocity_z = motion.velocity_z;
        [state.angular_velocity_x, state.angular_velocity_y] = motion.spin_xy;
    }

    fn own(&self, core: &PhysicsSimulator, body: BodyId, scale: f32) -> Option<Own> {
        let (motion, plane) = (self.motion(core, body)?, core.body(body)?);
        Some(Own {
            scale,
            motion,
            mass: plane.mass(),
            moment_of_inertia: plane.moment_of_inertia(),
            gravity_scale: plane.gravity_scale(),
            quadratic_drag: plane.quadratic_drag_coefficient(),
            rotational_drag: plane.rotational_drag_coefficient(),
            seen: motion.times(scale),
        })
    }

    /// A body becomes what others see of it. The numbers of one that is very heavy may have no room for more: it stands still.
    fn as_seen(&mut self, core: &mut PhysicsSimulator, body: BodyId, scale: f32) -> Option<Own> {
        let slow = if scale > 0.0 { self.slow(core, body, scale) } else { None };
        slow.or_else(|| self.hold(core, body))
    }

    /// A body stands still; what was applied to it becomes velocity of its own.
    fn hold(&mut self, core: &mut PhysicsSimulator, body: BodyId) -> Option<Own> {
        let (plane, state) = (core.body_mut(body)?, self.depths.edit(body)?);
        let velocity = plane.linear_velocity() + plane.impulse() * plane.inverse_mass();
        let velocity_z = state.velocity_z + state.impulse_z * plane.inverse_mass();
        plane.set_linear_velocity(velocity);
        if velocity_z.is_finite() {
            state.velocity_z = velocity_z;
        }
        plane.clear_impulse();
        plane.clear_force();
        plane.clear_torque();
        (state.impulse_z, state.force_z) = (0.0, 0.0);
        let own = self.own(core, body, 0.0)?;
        core.body_mut(body)?.set_is_kinematic(true);
        self.set_motion(core, body, Motion::default());
        Some(own)
    }

    /// A body becomes slow and heavy, if there are numbers for it.
    fn slow(&mut self, core: &mut PhysicsSimulator, body: BodyId, scale: f32) -> Option<Own> {
        let own = self.own(core, body, scale)?;
        let plane = core.body_mut(body)?;
        plane.set_mass(own.mass / scale).ok()?;
        if plane.set_moment_of_inertia(own.moment_of_inertia / scale).is_err() {
            // What was accepted before is accepted again.
            let _ = plane.set_mass(own.mass);
            return None;
        }
        plane.set_gravity_scale(own.gravity_scale * (scale * scale));
        plane.set_quadratic_drag_coefficient(own.quadratic_drag / scale);
        plane.set_rotational_drag_coefficient(own.rotational_drag / scale);
        let (force, torque) = (plane.force() * scale, plane.torque() * scale);
        plane.clear_force();
        plane.clear_torque();
        plane.apply_force(force);
        plane.apply_torque(torque);
        self.depths.edit(body)?.force_z *= scale;
        self.set_motion(core, body, own.seen);
        Some(own)
    }

    fn give_back(&mut self, core: &mut PhysicsSimulator, body: BodyId, own: Own) {
        let (Some(now), Some(plane)) = (self.motion(core, body), core.body_mut(body)) else { return };
        if own.scale == 0.0 {
            plane.set_is_kinematic(false);
        } else {
            // What was accepted before is accepted again.
            let _ = plane.set_mass(own.mass).and(plane.set_moment_of_inertia(own.moment_of_inertia));
            plane.set_gravity_scale(own.gravity_scale);
            plane.set_quadratic_drag_coefficient(own.quadratic_drag);
            plane.set_rotational_drag_coefficient(own.rotational_drag);
        }
        // What has not changed comes back to the bit.
        let is_same = own.scale == 0.0 || now == own.seen;
        self.set_motion(core, body, if is_same { own.motion } else { now.times(1.0 / own.scale) });
    }
}
