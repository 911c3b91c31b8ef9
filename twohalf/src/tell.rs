//! Telling a game what touches: callbacks, events, supports.

use farseer_core::math::scalar::nearest_finite;
use farseer_core::{BodyId, GeomId, PhysicsSimulator};

use crate::events::{Collision, Context, Event, EventHandler};
use crate::pairs::impulse_of;
use crate::support::Support;
use crate::touch::{Touch, TouchKey, TouchPoint};
use crate::world::{Source, World};
use crate::{Partner, Vector3};

/// From the solver's frame to the world: y points up there.
pub(crate) fn to_world(v: Vector3) -> Vector3 {
    Vector3::new(v.x, -v.y, v.z)
}

/// Whether a geom is in its list and its body is enabled.
fn takes_part(core: &PhysicsSimulator, geom: GeomId) -> bool {
    core.is_listed(geom)
        && core.geom(geom).and_then(|geom| core.body(geom.body())).is_some_and(|body| body.enabled())
}

/// Whether a handler is told of what a geom touches.
pub(crate) fn is_told(core: &PhysicsSimulator, geom: GeomId) -> bool {
    core.geom(geom).is_none_or(|geom| geom.collision_callbacks_enabled())
}

fn impulse_of_points(points: &[TouchPoint]) -> f32 {
    nearest_finite(points.iter().map(|point| point.normal_impulse).sum())
}

/// A contact of this engine, seen by one of its geoms.
pub(crate) fn collision(touch: &Touch, points: &[TouchPoint], is_partner: bool) -> Option<Collision> {
    let deepest = points.iter().min_by(|a, b| a.separation.total_cmp(&b.separation))?;
    let (this, partner, sign) = match (is_partner, touch.partner) {
        (false, partner) => (touch.this, partner, 1.0),
        (true, Partner::Geom(other)) => (other, Partner::Geom(touch.this), -1.0),
        (true, _) => return None,
    };
    Some(Collision {
        this,
        partner,
        axis: touch.axis(),
        normal: to_world(touch.normal) * sign,
        position: to_world(deepest.position),
        contacts: touch.point_count,
        normal_impulse: impulse_of_points(points),
        vetoed: false,
    })
}

impl World {
    /// Tells of every contact that this engine has found, and drops those that the handler refuses. Then of those
    /// that are gone.
    pub(crate) fn tell_touches(
        &mut self,
        core: &mut PhysicsSimulator,
        handler: &mut Option<&mut dyn EventHandler>,
    ) {
        let mut kept = 0;
        for index in 0..self.touches.touches.len() {
            let touch = self.touches.touches[index];
            if self.is_accepted(core, &touch, handler) {
                self.touches.touches[kept] = touch;
                kept += 1;
            }
        }
        self.touches.touches.truncate(kept);
        self.tell_separated(core, handler);
    }

    /// Asks both sides, the older geom first.
    fn is_accepted(
        &mut self,
        core: &mut PhysicsSimulator,
        touch: &Touch,
        handler: &mut Option<&mut dyn EventHandler>,
    ) -> bool {
        for is_partner in [true, false] {
            let points = self.touches.points_of(touch);
            let Some(mut collision) = collision(touch, points, is_partner) else { continue };
            if let Some(asked) = handler.as_mut().filter(|_| is_told(core, collision.this)) {
                let mut context = Context { core: core.context(), world: self };
                collision.vetoed = !asked.on_collision(&mut context, &collision);
                self.settle(core, handler);
            }
            self.events.push(Event::Collision(collision));
            if collision.vetoed {
                return false;
            }
            self.update.sources.push((self.events.len() as u32 - 1, Source::Touch(touch.key)));
        }
        true
    }

    /// Contacts of the last update that are gone, unless they ended by something else than parting.
    pub(crate) fn tell_separated(
        &mut self,
        core: &mut PhysicsSimulator,
        handler: &mut Option<&mut dyn EventHandler>,
    ) {
        for index in 0..self.last.touches.len() {
            let touch = self.last.touches[index];
            if touch.is_plane()
                || self.touches.find(touch.key).is_some()
                || !self.may_touch(core, touch.this, touch.partner)
            {
                continue;
            }
            self.tell_parted(core, handler, touch.this, touch.partner);
        }
    }

    /// Tells both sides of a contact that it has ended, the older geom first.
    pub(crate) fn tell_parted(
        &mut self,
        core: &mut PhysicsSimulator,
        handler: &mut Option<&mut dyn EventHandler>,
        this: GeomId,
        partner: Partner,
    ) {
        let other_side = match partner {
            Partner::Geom(other) => Some((other, Partner::Geom(this))),
            _ => None,
        };
        for (this, partner) in other_side.into_iter().chain([(this, partner)]) {
            self.events.push(Event::Separation { this, partner });
            if let Some(asked) = handler.as_mut().filter(|_| is_told(core, this)) {
                let mut context = Context { core: core.context(), world: self };
                asked.on_separation(&mut context, this, partner);
                self.settle(core, handler);
            }
        }
    }

    /// Whether both sides of a contact could still touch.
    pub(crate) fn may_touch(&self, core: &PhysicsSimulator, this: GeomId, partner: Partner) -> bool {
        takes_part(core, this) && self.exists(core, partner)
    }

    /// Gives the collisions among the events the impulses that the solver found.
    pub(crate) fn fill_impulses(&mut self, core: &PhysicsSimulator) {
        for index in 0..self.update.sources.len() {
            let (event, source) = self.update.sources[index];
            let impulse = match source {
                Source::Touch(key) => self.touch_impulse(key),
                Source::Arbiter(position) => core.arbiter(position as usize).map_or(0.0, impulse_of),
            };
            if let Event::Collision(collision) = &mut self.events[event as usize] {
                collision.normal_impulse = impulse;
            }
        }
    }

    fn touch_impulse(&self, key: TouchKey) -> f32 {
        let points = self.touches.find(key).map_or(&[][..], |touch| self.touches.points_of(touch));
        impulse_of_points(points)
    }

    /// Notes for every body what holds it up best.
    pub(crate) fn find_supports(&mut self, core: &PhysicsSimulator) {
        let mut last = std::mem::take(&mut self.update.supports);
        last.clear();
        for &body in core.body_list() {
            if let Some(state) = self.depths.bodies.get_mut(body)
                && let Some(support) = state.support.take()
                && !std::mem::take(&mut state.is_support_kept)
            {
                last.push((body, support));
            }
        }
        for contact in core.arbiters() {
            let (a, b) = (contact.geom_a(), contact.geom_b());
            let Some(normal) = contact.contacts().next().map(|contact| contact.normal) else { continue };
            let upward = Vector3::new(normal.x, -normal.y, 0.0);
            self.note_support(core, b, Partner::Geom(a), upward);
            self.note_support(core, a, Partner::Geom(b), -upward);
        }
        for index in 0..self.touches.touches.len() {
            let touch = self.touches.touches[index];
            if touch.is_plane() || !touch.responds {
                continue;
            }
            let normal = to_world(touch.normal);
            self.note_support(core, touch.this, touch.partner, normal);
            if let Partner::Geom(other) = touch.partner {
                self.note_support(core, other, Partner::Geom(touch.this), -normal);
            }
        }
        self.keep_supports(core, &last);
        self.update.supports = last;
    }

    /// What lies on something may leave it for a single step, no faster than gravity makes it in two, before it
    /// lies on it again. For that step it still counts as held up.
    fn keep_supports(&mut self, core: &PhysicsSimulator, last: &[(BodyId, Support)]) {
        let slow = 2.0 * core.gravity().y.abs() * self.update.dt.abs();
        for &(id, support) in last {
            let is_slow = core.body(id).is_some_and(|body| {
                !body.ignore_gravity() && body.linear_velocity().y.abs() <= slow * body.gravity_scale().abs()
            });
            let is_there = self.exists(core, support.partner);
            let Some(state) = self.depths.bodies.get_mut(id).filter(|state| state.support.is_none()) else {
                continue;
            };
            if is_there && is_slow {
                (state.support, state.is_support_kept) = (Some(support), true);
            }
        }
    }

    /// Whether a partner takes part.
    fn exists(&self, core: &PhysicsSimulator, partner: Partner) -> bool {
        match partner {
            Partner::Geom(geom) => takes_part(core, geom),
            Partner::Platform(platform) => self.platforms.get(platform).is_some(),
            Partner::Ground => true,
        }
    }

    /// Forgets contacts and supports of what has left. Of contacts that are listed when somebody asks, what has left is not
    /// listed, whether they were loaded or not.
    pub(crate) fn forget_what_left(&mut self, core: &PhysicsSimulator) {
        if self.scheme != crate::DepthScheme::Precise {
            let mut touches = std::mem::take(&mut self.touches.touches);
            touches.retain(|touch| core.geom(touch.this).is_some() && self.exists(core, touch.partner));
            self.touches.touches = touches;
        }
        for &body in core.body_list() {
            let support = self.depths.bodies.get(body).and_then(|state| state.support);
            if support.is_some_and(|support| !self.exists(core, support.partner)) {
                self.depths.bodies[body].support = None;
            }
        }
    }

    /// What holds a body up best.
    pub(crate) fn support_of(&self, core: &PhysicsSimulator, body: BodyId) -> Option<Support> {
        if self.scheme != crate::DepthScheme::Precise {
            return self.depths.bodies.get(body)?.support;
        }
        let list = self.list_touches_of(core, body);
        let mut best: Option<Support> = None;
        for touch in list.touches.iter().filter(|touch| touch.responds) {
            let normal = to_world(touch.normal);
            let found = match touch.partner {
                partner if touch.body == body => Support { partner, normal },
                Partner::Geom(_) if touch.partner_body == Some(body) => {
                    Support { partner: Partner::Geom(touch.this), normal: -normal }
                }
                _ => continue,
            };
            if found.normal.y > best.map_or(0.0, |best| best.normal.y) {
                best = Some(found);
            }
        }
        best
    }

    fn note_support(&mut self, core: &PhysicsSimulator, geom: GeomId, partner: Partner, normal: Vector3) {
        let responds = |geom: GeomId| core.geom(geom).is_some_and(|geom| geom.collision_response_enabled());
        if normal.y <= 0.0 || !responds(geom) || matches!(partner, Partner::Geom(other) if !responds(other)) {
            return;
        }
        let body = core.geom(geom).map(|geom| geom.body());
        let Some(state) = body.and_then(|body| self.depths.bodies.get_mut(body)) else { return };
        if state.support.is_none_or(|best: Support| best.normal.y < normal.y) {
            state.support = Some(Support { partner, normal });
        }
    }
}
