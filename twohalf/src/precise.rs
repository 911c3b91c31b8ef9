//! An update with the precise set: the 2D engine below works in three axes, is told what it does not know, and tells what
//! touches.

use farseer_core::{
    BodyId, Fixture, GeomId, PhysicsSimulator, SpaceBody, SpacePartner, SpaceProfile, SpaceTouch,
};

use crate::depth::is_movable;
use crate::events::{Collision, Context, Event, EventHandler};
use crate::pairs::PlaneHandler;
use crate::step::{disable, reborrow};
use crate::touch::{Kept, Touch, TouchKey, TouchPoint};
use crate::world::World;
use crate::{Partner, PlatformId, TwoHalfPhysicsSimulator, Vector3};

impl TwoHalfPhysicsSimulator {
    pub(crate) fn run_precise(&mut self, dt: f32, mut handler: Option<&mut dyn EventHandler>) {
        let TwoHalfPhysicsSimulator { core, world } = self;
        world.begin();
        world.update.dt = dt;
        world.tell_depths(core);
        let goes_on = if handler.is_some() {
            let mut meeting = PlaneHandler { world: &mut *world, handler: reborrow(&mut handler) };
            core.update_in_space(dt, Some(&mut meeting))
        } else {
            let goes_on = core.update_in_space(dt, None);
            if goes_on {
                world.read_depths(core);
            }
            goes_on
        };
        world.tell_pending();
        world.take_events(core);
        if !goes_on {
            world.stand_still(core);
            return;
        }
        world.rest(core);
        world.list_touches(core);
        world.tell_changes(core, &mut handler);
        world.finish(core);
    }
}

/// Whether two have pushed each other in this update, or are not apart at its end.
fn is_touching(found: &SpaceTouch) -> bool {
    found.points[..found.count].iter().any(|point| point.impulse > 0.0 || point.separation <= APART)
}

/// Resting contacts are as near as that, px.
const APART: f32 = 0.01;

impl World {
    /// The 2D engine is told what has become otherwise along Z: all of it, if it knows nothing yet.
    pub(crate) fn tell_depths(&mut self, core: &mut PhysicsSimulator) {
        if !std::mem::replace(&mut self.depths.is_told, true) {
            core.bodies().for_each(|id| _ = self.depths.edit(id));
        }
        let mut news = std::mem::take(&mut self.depths.news);
        for id in news.drain(..) {
            self.tell_body(core, id);
            for at in 0..core.geoms_of(id).len() {
                self.tell_profile(core, core.geoms_of(id)[at]);
            }
        }
        self.depths.news = news;
        if self.platforms.take_changed() {
            let fixtures = self.platforms.iter().map(|(id, platform)| Fixture {
                id: id.number(),
                shape: *platform.shape(),
                rotation: platform.rotation(),
                settings: platform.settings().clone(),
            });
            core.set_fixtures(fixtures);
        }
    }

    fn tell_body(&mut self, core: &mut PhysicsSimulator, id: BodyId) {
        let (Some(body), Some(state)) = (core.body(id), self.depths.bodies.get_mut(id)) else { return };
        state.is_news = false;
        let inverse_mass = if is_movable(core, id) { body.inverse_mass() } else { 0.0 };
        let velocity = state.velocity_z + std::mem::take(&mut state.impulse_z) * inverse_mass;
        let acceleration = state.force_z * inverse_mass;
        if !(velocity.is_finite() && acceleration.is_finite()) {
            disable(core, id);
            self.events.push(Event::NotFinite { body: id, disabled: true });
            return;
        }
        state.velocity_z = velocity;
        let told = SpaceBody {
            z: state.z,
            velocity,
            acceleration,
            motion: state.motion.unwrap_or_default().into(),
            angular_velocity: [state.angular_velocity_x, state.angular_velocity_y],
        };
        core.set_space_body(id, told);
    }

    fn tell_profile(&self, core: &mut PhysicsSimulator, id: GeomId) {
        let (Some(view), Some(profile)) = (core.geom(id), self.depths.profiles.get(id)) else { return };
        let ground = self.depths.bodies.get(view.body()).map(|state| state.ground);
        let ground = ground.filter(|ground| ground.object_geom() == Some(id));
        let told = SpaceProfile {
            half_depth: profile.half_depth(),
            is_round: profile.is_round(),
            ground: ground.map(|ground| [ground.friction_coefficient(), ground.restitution_coefficient()]),
        };
        core.set_space_profile(id, told);
    }

    /// Takes over where bodies have come along Z, before anybody is told that they moved.
    pub(crate) fn read_depths(&mut self, core: &PhysicsSimulator) {
        for (id, told) in core.space_moved() {
            let Some(state) = self.depths.bodies.get_mut(id) else { continue };
            let SpaceBody { z, velocity, angular_velocity: [x, y], motion, .. } = told;
            (state.z, state.velocity_z, state.motion) = (z, velocity, Some(Vector3::from(motion)));
            (state.angular_velocity_x, state.angular_velocity_y) = (x, y);
            // It has acted.
            state.force_z = 0.0;
        }
    }

    /// What has fallen asleep does not move.
    fn rest(&mut self, core: &PhysicsSimulator) {
        for (id, told) in core.space_rested() {
            let Some(state) = self.depths.bodies.get_mut(id).filter(|state| !state.is_news) else { continue };
            (state.z, state.velocity_z) = (told.z, 0.0);
            (state.angular_velocity_x, state.angular_velocity_y) = (0.0, 0.0);
            state.motion = Some(Vector3::zeros());
        }
    }

    /// The contacts of this update.
    fn list_touches(&mut self, core: &PhysicsSimulator) {
        self.touches.clear();
        for (_, found) in core.space_touches().filter(|(_, found)| is_touching(found)) {
            self.push_touch(core, &found);
        }
        self.touches.sort();
    }

    fn push_touch(&mut self, core: &PhysicsSimulator, found: &SpaceTouch) -> Option<()> {
        let number = core.geom(found.this)?.id();
        let (key, partner, partner_body, z) = match found.partner {
            SpacePartner::Ground => (TouchKey::Ground(number), Partner::Ground, None, self.z_of(found.body)),
            SpacePartner::Fixture(number) => {
                let id = PlatformId::from_number(number);
                let z = self.z_of(found.body);
                (TouchKey::Platform(number, id), Partner::Platform(id), None, z)
            }
            SpacePartner::Geom(other) => {
                let view = core.geom(other)?;
                let key = TouchKey::Pair(view.id(), number);
                (key, Partner::Geom(other), Some(view.body()), self.middle(core, found.this, other))
            }
        };
        let first_point = self.touches.points.len() as u32;
        let normal = Vector3::from(found.normal);
        for point in &found.points[..found.count] {
            self.touches.points.push(TouchPoint {
                position: Vector3::new(point.position.x, point.position.y, z),
                normal,
                separation: point.separation,
                feature: point.feature,
                normal_impulse: point.impulse,
                friction_impulse: point.friction_impulse,
            });
        }
        self.touches.touches.push(Touch {
            key,
            this: found.this,
            body: found.body,
            partner,
            partner_body,
            normal,
            kept: Kept::Nothing,
            first_point,
            point_count: found.count as u32,
            friction: found.friction,
            restitution: found.restitution,
            responds: found.responds,
            shares_pressure: false,
            arbiter: 0,
        });
        Some(())
    }

    /// What begins and ceases to touch.
    fn tell_changes(&mut self, core: &mut PhysicsSimulator, handler: &mut Option<&mut dyn EventHandler>) {
        for index in 0..self.touches.touches.len() {
            let touch = self.touches.touches[index];
            if self.last.find(touch.key).is_some() {
                continue;
            }
            for is_partner in [true, false] {
                let collision: Option<Collision> = self.collision(&touch, is_partner);
                self.events.extend(collision.map(Event::Collision));
            }
        }
        self.tell_separated(core, handler);
    }

    /// Asks a handler about everything that touches; answers what it refuses.
    pub(crate) fn ask_about_touches(
        &mut self,
        context: &mut farseer_core::Context<'_>,
        handler: &mut dyn EventHandler,
    ) -> Vec<usize> {
        let mut found: Vec<(usize, SpaceTouch)> =
            context.simulator().space_touches().filter(|(_, touch)| touch.is_told).collect();
        found.sort_by_key(|(_, touch)| self.key_of_touch(context.simulator(), touch));
        let mut refused = Vec::new();
        for (pair, touch) in found {
            self.touches.clear();
            if self.push_touch(context.simulator(), &touch).is_none() {
                continue;
            }
            let touch = self.touches.touches[0];
            for is_partner in [true, false] {
                let Some(collision) = self.collision(&touch, is_partner) else { continue };
                let is_told = context
                    .simulator()
                    .geom(collision.this)
                    .is_none_or(|geom| geom.collision_callbacks_enabled());
                let accepts =
                    !is_told || handler.on_collision(&mut Context::within(context, self), &collision);
                self.tell_depths(context.simulator_mut());
                if !accepts {
                    refused.push(pair);
                    self.events.push(Event::Collision(Collision { vetoed: true, ..collision }));
                    break;
                }
            }
        }
        refused
    }

    fn key_of_touch(&self, core: &PhysicsSimulator, touch: &SpaceTouch) -> Option<TouchKey> {
        let number = core.geom(touch.this)?.id();
        Some(match touch.partner {
            SpacePartner::Ground => TouchKey::Ground(number),
            SpacePartner::Fixture(platform) => TouchKey::Platform(number, PlatformId::from_number(platform)),
            SpacePartner::Geom(other) => TouchKey::Pair(core.geom(other)?.id(), number),
        })
    }
}
