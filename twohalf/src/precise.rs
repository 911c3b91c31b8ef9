//! An update with the precise set: the 2D engine below works in three axes, is told what it does not know, and tells what
//! touches.

use std::borrow::Cow;

use farseer_core::{
    BodyId, GeomId, PhysicsSimulator, SpaceBody, SpaceChange, SpacePartner, SpaceProfile, SpaceTouch,
};

use crate::depth::is_movable;
use crate::events::{Collision, Context, Event, EventHandler};
use crate::pairs::PlaneHandler;
use crate::step::{StepCounters, disable, reborrow};
use crate::tell::{collision, is_told};
use crate::touch::{Kept, Touch, TouchKey, TouchList, TouchPoint};
use crate::world::World;
use crate::{Partner, PlatformId, TwoHalfPhysicsSimulator, Vector3};

impl TwoHalfPhysicsSimulator {
    pub(crate) fn run_precise(&mut self, dt: f32, mut handler: Option<&mut dyn EventHandler>) {
        let TwoHalfPhysicsSimulator { core, world } = self;
        world.begin();
        world.update.dt = dt;
        world.tell_depths(core);
        let goes_on = {
            let mut meeting = PlaneHandler { world: &mut *world, handler: reborrow(&mut handler) };
            core.begin_in_space(dt, meeting.handler.is_some().then_some(&mut meeting as _))
        };
        if goes_on {
            world.act_fields(core, dt);
            let mut meeting = PlaneHandler { world: &mut *world, handler: reborrow(&mut handler) };
            core.go_on_in_space(dt, meeting.handler.is_some().then_some(&mut meeting as _));
            if handler.is_none() {
                world.read_depths(core);
            }
        }
        world.tell_pending();
        world.take_events(core);
        if !goes_on {
            world.stand_still(core);
            return;
        }
        world.rest(core);
        world.tell_changes(core, &mut handler);
        world.count(core);
    }
}

pub(crate) fn partner_of(partner: SpacePartner) -> Partner {
    match partner {
        SpacePartner::Ground => Partner::Ground,
        SpacePartner::Fixture(number) => Partner::Platform(PlatformId::from_number(number)),
        SpacePartner::Geom(geom) => Partner::Geom(geom),
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
        let mut waiting = std::mem::take(&mut self.depths.waiting);
        waiting.retain(|&id| {
            let can_move = is_movable(core, id);
            if can_move {
                self.depths.edit(id);
            }
            !can_move && core.body(id).is_some()
        });
        self.depths.waiting = waiting;
        let mut news = std::mem::take(&mut self.depths.news);
        for id in news.drain(..) {
            self.tell_body(core, id);
            for at in 0..core.geoms_of(id).len() {
                self.tell_profile(core, core.geoms_of(id)[at]);
            }
        }
        self.depths.news = news;
        if self.platforms.take_changed() {
            let fixtures = self.platforms.iter().map(|(id, platform)| platform.fixture(id));
            core.set_fixtures(fixtures);
        }
        for (id, motion) in self.platforms.edited_motions() {
            core.set_fixture_motion(id.number(), motion);
        }
    }

    fn tell_body(&mut self, core: &mut PhysicsSimulator, id: BodyId) {
        let (Some(body), Some(state)) = (core.body(id), self.depths.bodies.get_mut(id)) else { return };
        state.is_news = false;
        let can_move = is_movable(core, id);
        let inverse_mass = if can_move { body.inverse_mass() } else { 0.0 };
        if !can_move && state.force_z != 0.0 && !self.depths.waiting.contains(&id) {
            self.depths.waiting.push(id);
        }
        // Nothing added to a negative zero would make it a positive one, which a save must not do.
        let impulse = std::mem::take(&mut state.impulse_z);
        let velocity =
            if impulse == 0.0 { state.velocity_z } else { state.velocity_z + impulse * inverse_mass };
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
            target: state.target.filter(|_| body.is_kinematic()),
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
            upright: profile.upright(),
        };
        core.set_space_profile(id, told);
    }

    /// Takes over where bodies have come along Z, and platforms, before anybody is told that they moved.
    pub(crate) fn read_depths(&mut self, core: &PhysicsSimulator) {
        for (number, centre, yaw, motion) in core.fixtures_moved() {
            self.platforms.has_moved(PlatformId::from_number(number), centre, yaw, motion);
        }
        for (id, told) in core.space_moved() {
            let Some(state) = self.depths.bodies.get_mut(id) else { continue };
            let SpaceBody { z, velocity, angular_velocity: [x, y], motion, target, .. } = told;
            (state.z, state.velocity_z, state.motion) = (z, velocity, Some(Vector3::from(motion)));
            (state.angular_velocity_x, state.angular_velocity_y) = (x, y);
            state.target = target;
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

    /// What touches, as this engine lists it, and its points.
    fn touch_of(&self, core: &PhysicsSimulator, found: &SpaceTouch) -> Option<(Touch, [TouchPoint; 2])> {
        let number = core.geom(found.this)?.id();
        let partner = partner_of(found.partner);
        let key = match partner {
            Partner::Ground => TouchKey::Ground(number),
            Partner::Platform(id) => TouchKey::Platform(number, id),
            Partner::Geom(other) => TouchKey::Pair(core.geom(other)?.id(), number),
        };
        let normal = Vector3::from(found.normal);
        let points = found.points.map(|point| TouchPoint {
            position: Vector3::new(point.position.x, point.position.y, found.z),
            normal,
            separation: point.separation,
            feature: point.feature,
            normal_impulse: point.impulse,
            friction_impulse: point.friction_impulse,
        });
        let touch = Touch {
            key,
            this: found.this,
            body: found.body,
            partner,
            partner_body: found.partner_body,
            normal,
            kept: Kept::Nothing,
            first_point: 0,
            point_count: found.count as u32,
            friction: found.friction,
            restitution: found.restitution,
            responds: found.responds,
            shares_pressure: false,
            arbiter: 0,
        };
        Some((touch, points))
    }

    /// The contacts of the last update, found in the engine below when somebody asks; what was loaded, until it moves on.
    pub(crate) fn list_touches(&self, core: &PhysicsSimulator) -> Cow<'_, TouchList> {
        if !core.knows_touches() {
            return self.loaded_touches(core);
        }
        Cow::Owned(self.list(core, core.space_touches()))
    }

    /// Those of one body, if they are found when somebody asks.
    pub(crate) fn list_touches_of(&self, core: &PhysicsSimulator, body: BodyId) -> Cow<'_, TouchList> {
        if !core.knows_touches() {
            return self.loaded_touches(core);
        }
        Cow::Owned(self.list(core, core.space_touches_of(body)))
    }

    /// Those that were loaded, but for what has gone since.
    fn loaded_touches(&self, core: &PhysicsSimulator) -> Cow<'_, TouchList> {
        let is_there = |touch: &Touch| self.may_touch(core, touch.this, touch.partner);
        if self.touches.touches.iter().all(is_there) {
            return Cow::Borrowed(&self.touches);
        }
        let mut list = TouchList::default();
        for touch in self.touches.touches.iter().filter(|touch| is_there(touch)) {
            let first_point = list.points.len() as u32;
            list.points.extend_from_slice(self.touches.points_of(touch));
            list.touches.push(Touch { first_point, ..*touch });
        }
        Cow::Owned(list)
    }

    fn list(&self, core: &PhysicsSimulator, found: impl Iterator<Item = SpaceTouch>) -> TouchList {
        let mut list = TouchList::default();
        let touches = found.filter(is_touching).filter_map(|found| self.touch_of(core, &found));
        for (touch, points) in touches.filter(|(touch, _)| self.may_touch(core, touch.this, touch.partner)) {
            let first_point = list.points.len() as u32;
            list.points.extend_from_slice(&points[..touch.point_count as usize]);
            list.touches.push(Touch { first_point, ..touch });
        }
        list.sort();
        list
    }

    /// What begins and ceases to touch.
    fn tell_changes(&mut self, core: &mut PhysicsSimulator, handler: &mut Option<&mut dyn EventHandler>) {
        let changes = core.take_space_changes();
        for begun in changes.iter().filter_map(|change| change.touch) {
            for collision in self.collisions(core, &begun).into_iter().flatten() {
                self.events.push(Event::Collision(collision));
            }
        }
        for &SpaceChange { this, partner, .. } in changes.iter().filter(|change| change.touch.is_none()) {
            let partner = partner_of(partner);
            if self.may_touch(core, this, partner) {
                self.tell_parted(core, handler, this, partner);
            }
        }
    }

    /// A contact, as both of its sides are told of it: the older geom first.
    fn collisions(&self, core: &PhysicsSimulator, found: &SpaceTouch) -> [Option<Collision>; 2] {
        let Some((touch, points)) = self.touch_of(core, found) else { return [None; 2] };
        [true, false].map(|is_partner| collision(&touch, &points[..found.count], is_partner))
    }

    /// Asks a handler about everything that touches; answers what it refuses.
    pub(crate) fn ask_about_touches(
        &mut self,
        context: &mut farseer_core::Context<'_>,
        handler: &mut dyn EventHandler,
    ) -> Vec<usize> {
        let mut found: Vec<(usize, SpaceTouch)> = context.simulator().space_touches_heard().collect();
        found.sort_by_key(|(_, touch)| self.touch_of(context.simulator(), touch).map(|(touch, _)| touch.key));
        found.retain(|(_, touch)| !self.accepts_touch(context, handler, touch));
        found.into_iter().map(|(pair, _)| pair).collect()
    }

    fn accepts_touch(
        &mut self,
        context: &mut farseer_core::Context<'_>,
        handler: &mut dyn EventHandler,
        touch: &SpaceTouch,
    ) -> bool {
        for collision in self.collisions(context.simulator(), touch).into_iter().flatten() {
            if !is_told(context.simulator(), collision.this) {
                continue;
            }
            let accepts = handler.on_collision(&mut Context::within(context, self), &collision);
            self.tell_depths(context.simulator_mut());
            if !accepts {
                self.events.push(Event::Collision(Collision { vetoed: true, ..collision }));
                return false;
            }
        }
        true
    }

    /// What the update did.
    fn count(&mut self, core: &PhysicsSimulator) {
        let counters = core.counters();
        let on_ground = core.on_ground_count();
        self.update.is_running = false;
        self.counters = StepCounters {
            pairs_tested: counters.pairs_tested,
            pairs_touching: counters.pairs_touching - on_ground,
            ground_contacts: on_ground,
            contacts_solved: counters.contacts_solved,
            rows_solved: 3 * counters.contacts_solved,
            bodies_moved: counters.bodies_moved,
        };
    }
}
