//! What was edited is taken over: bodies that moved, and what came, went or became what it was not.

use super::Precise;
use super::bodies::{inverses_of, ring_of};
use super::fingerprint::Fingerprint;
use super::grid::Box2;
use super::outline::Shape;
use super::proxies::{Mobility, Proxy, filter_of};
use super::saved::{Edits, Saved};
use super::space::parts::{Depths, SpaceProfile, is_geom};
use crate::body::{Body, BodyId};
use crate::geom::entry::GeomEntry;
use crate::geom::filter::{is_valid_pair, may_go_on_touching};
use crate::geom::pieces::Piece;
use crate::geom::{Geom, GeomId};
use crate::math::plane::Vector;
use crate::objects::Objects;

pub(super) const NONE: u32 = u32::MAX;

/// Entry of a table by slot, which is as long as it must be.
pub(super) fn set(table: &mut Vec<u32>, slot: usize, number: u32) {
    if table.len() <= slot {
        table.resize(slot + 1, NONE);
    }
    table[slot] = number;
}

pub(super) fn get(table: &[u32], slot: usize) -> Option<usize> {
    table.get(slot).copied().filter(|&number| number != NONE).map(|number| number as usize)
}

impl Precise {
    /// The number of a body, if it is listed.
    pub(crate) fn number_of(&self, body: BodyId) -> Option<usize> {
        get(&self.body_numbers, body.slot()).filter(|&number| self.bodies.ids[number] == Some(body))
    }

    /// Bodies or geoms have become what they were not.
    pub(crate) fn note_change(&mut self) {
        self.is_stale = true;
    }

    /// Bodies or geoms have entered or left their lists.
    pub(crate) fn note_members(&mut self) {
        self.has_new_members = true;
    }

    /// A body was lent out for editing: what it is then is taken over when the next stage begins that asks for it.
    pub(crate) fn note_body(&mut self, body: BodyId) {
        self.edited_bodies.push(body);
    }

    /// A geom was lent out for editing.
    pub(crate) fn note_geom(&mut self, geom: GeomId) {
        self.edited_geoms.push(geom);
    }

    /// Whether a body takes part otherwise than it is listed.
    fn is_another_kind(&self, id: BodyId, objects: &Objects) -> bool {
        let Some(body) = objects.bodies.get(id).map(|entry| &entry.body) else { return false };
        // Who has come is asked about elsewhere.
        let Some(number) = self.number_of(id) else {
            return !self.has_new_members && takes_part(id, objects);
        };
        let is_movable = number < self.bodies.first_fixed();
        let inverses = if is_movable { inverses_of(body) } else { [0.0; 2] };
        // What cannot be pushed takes no colour.
        let is_same_kind = body.enabled()
            && is_movable == body.is_integrated()
            && self.bodies.is_kinematic(number) == (is_movable && body.is_kinematic())
            && (inverses == [0.0; 2]) == (self.bodies.inverses[number] == [0.0; 2]);
        !is_same_kind
    }

    /// Whether a geom may meet others than it could, or pushes others.
    fn meets_others(&self, id: GeomId, objects: &Objects) -> bool {
        let Some(entry) = objects.geoms.get(id) else { return false };
        let (filter, responds) = (filter_of(entry), entry.geom.collision_response_enabled());
        self.proxies_of(id, objects).any(|at| {
            let proxy = &self.proxies.all[at];
            proxy.filter != filter || proxy.responds != responds
        })
    }

    fn take_body(&mut self, id: BodyId, objects: &Objects) {
        let (Some(entry), Some(number)) = (objects.bodies.get(id), self.number_of(id)) else { return };
        let body = &entry.body;
        let is_movable = number < self.bodies.first_fixed();
        let inverses = if is_movable { self.inverses_in_space(number, body) } else { [0.0; 2] };
        let velocity = self.surface_velocity(id, is_movable, body);
        let has_moved = self.bodies.was_moved(number, body) || self.was_moved_in_space(number, id);
        let is_other = inverses != self.bodies.inverses[number];
        let rests = body.rests_with(self.bodies.gravity_parts[number]) && self.rests_in_space(id);
        if has_moved || is_other || !rests {
            self.sleep.note_waking(number);
        } else {
            self.sleep.note_push(number);
        }
        self.bodies.inverses[number] = inverses;
        if is_movable {
            self.measure_ring(number, objects);
        }
        if is_other {
            self.note_joints();
        }
        self.bodies.gravity_parts[number] = body.gravity_part();
        if is_movable {
            self.bodies.are_bullets[number] = body.is_bullet();
        }
        self.bodies.set_velocity(number, body);
        if has_moved {
            self.bodies.move_to(number, body);
            self.bodies.forget_way(number);
        }
        self.take_body_in_space(number, id);
        self.steady_if_upright(number);
        for &geom in &entry.geoms {
            self.renew_proxies(geom, objects, |proxy| {
                let is_belt_changed = proxy.surface_velocity != velocity;
                proxy.surface_velocity = velocity;
                let contacts = is_other || is_belt_changed;
                Renewal { moved: has_moved, contacts, callbacks: false, passages: false }
            });
        }
    }

    /// How far a body reaches, how thick and how round it is.
    pub(super) fn measure(&mut self, number: usize, objects: &Objects) {
        let Precise { bodies, proxies, .. } = self;
        let shapes = proxies.of(number).map(|proxy| proxies.all[proxy as usize].shape);
        bodies.measure(number, shapes.map(|shape| (shape, proxies.corners.core(shape))));
        if let Some(space) = self.space.as_deref_mut() {
            space.measure_ball(number, &self.proxies);
        }
        self.measure_ring(number, objects);
    }

    /// How far a body without geoms reaches.
    fn measure_ring(&mut self, number: usize, objects: &Objects) {
        let body = self.bodies.ids[number].and_then(|id| objects.bodies.get(id));
        if let Some(entry) = body.filter(|entry| !entry.body.is_kinematic())
            && self.proxies.of(number).next().is_none()
        {
            self.bodies.reaches[number] = ring_of(&entry.body);
        }
    }

    fn take_geom(&mut self, id: GeomId, objects: &Objects) {
        let Some(entry) = objects.geoms.get(id) else { return };
        let (geom, one_way) = (&entry.geom, self.direction_of(entry));
        let [friction, restitution] = surface_of(geom);
        let is_heard = geom.collision_callbacks_enabled();
        self.bounces |= restitution > 0.0;
        self.renew_proxies(id, objects, |proxy| {
            let is_other = proxy.friction != friction || proxy.restitution != restitution;
            (proxy.friction, proxy.restitution) = (friction, restitution);
            let callbacks = std::mem::replace(&mut proxy.is_heard, is_heard) != is_heard;
            let passages = std::mem::replace(&mut proxy.one_way, one_way) != one_way;
            Renewal { moved: false, contacts: is_other || passages, callbacks, passages }
        });
    }

    /// The direction against which a geom holds: in three axes there is none.
    fn direction_of(&self, geom: &GeomEntry) -> Option<Vector> {
        geom.one_way.filter(|_| self.space.is_none()).map(|direction| [direction.x, direction.y])
    }

    /// The places of a geom's proxies.
    fn proxies_of(&self, geom: GeomId, objects: &Objects) -> impl Iterator<Item = usize> + use<'_> {
        let first = get(&self.first_proxies, geom.slot()).unwrap_or(self.proxies.all.len());
        let count = objects.geoms.get(geom).map_or(0, |entry| entry.pieces().len());
        (first..(first + count).min(self.proxies.all.len()))
            .take_while(move |&at| self.proxies.all[at].geom == geom)
    }

    /// Lets the proxies of a geom take something over, and what they touch with it.
    fn renew_proxies(
        &mut self,
        geom: GeomId,
        objects: &Objects,
        mut take: impl FnMut(&mut Proxy) -> Renewal,
    ) {
        let Some(first) = self.proxies_of(geom, objects).next() else { return };
        for at in first..first + self.proxies_of(geom, objects).count() {
            let was_one_way = self.proxies.all[at].one_way.is_some();
            let renewal = take(&mut self.proxies.all[at]);
            self.proxies.one_way += usize::from(self.proxies.all[at].one_way.is_some());
            self.proxies.one_way -= usize::from(was_one_way);
            if renewal.moved {
                self.jump(at as u32);
                self.proxies.escaped.push(at as u32);
            }
            if renewal.contacts || renewal.moved {
                self.look_again(at as u32);
            }
            if renewal.callbacks {
                self.renew_callbacks(at as u32);
            }
            if renewal.passages {
                self.renew_passages(at as u32);
            }
        }
    }

    /// Of which pairs of a proxy a handler is told.
    fn renew_callbacks(&mut self, proxy: u32) {
        let mut pairs = std::mem::take(&mut self.lost);
        pairs.extend(self.pairs.of(proxy).map(|pair| pair as u32));
        for pair in pairs.drain(..) {
            let is_heard = self.is_heard(self.pairs.watched[pair as usize].proxies);
            self.pairs.set_heard(pair as usize, is_heard);
        }
        self.lost = pairs;
    }

    /// What the pairs of a proxy whose direction is another one knew of each other is forgotten.
    pub(super) fn renew_passages(&mut self, proxy: u32) {
        let mut pairs = std::mem::take(&mut self.lost);
        pairs.extend(self.pairs.of(proxy).map(|pair| pair as u32));
        for pair in pairs.drain(..) {
            self.pairs.all[pair as usize].passage = self.first_passage(pair as usize);
        }
        self.lost = pairs;
    }

    /// A proxy is somewhere else now.
    pub(super) fn jump(&mut self, proxy: u32) {
        let motion = &mut self.proxies.motion[proxy as usize];
        *motion = motion.wrapping_add(1 << 30);
        self.widen(proxy);
    }

    /// The pairs of a proxy are looked at in full in the next step, and how they are solved is asked again.
    pub(super) fn look_again(&mut self, proxy: u32) {
        self.direct.timing.may_be_due = true;
        let mut pairs = std::mem::take(&mut self.lost);
        pairs.extend(self.pairs.of(proxy).map(|pair| pair as u32));
        for pair in pairs.drain(..) {
            self.pairs.look_again(pair as usize);
            self.note_loss(pair as usize);
        }
        self.lost = pairs;
    }

    /// First stage: edits are taken over, and who has come and gone. If something is of another kind, everything is listed
    /// anew from what was known before any of them, as it is after loading.
    pub(crate) fn sync(&mut self, objects: &Objects) {
        let (mut bodies, mut geoms) =
            (std::mem::take(&mut self.edited_bodies), std::mem::take(&mut self.edited_geoms));
        self.is_stale = self.is_stale
            || bodies.iter().any(|&body| self.is_another_kind(body, objects))
            || geoms.iter().any(|&geom| self.meets_others(geom, objects));
        let has_new_members = std::mem::take(&mut self.has_new_members);
        let had_one_way = self.proxies.one_way > 0;
        let before = (cfg!(debug_assertions) && has_new_members).then(|| self.save());
        if has_new_members {
            self.is_stale = self.is_stale || self.loaded.is_some() || !self.follow_members(objects);
        }
        debug_assert!(
            self.is_stale || !self.has_changed_flags(objects),
            "what comes, goes and changes is noted"
        );
        if self.is_stale {
            let saved = self.loaded.take().unwrap_or_else(|| self.save());
            self.list(objects, &saved, Edits::Taken);
        } else {
            self.wake_woken();
            bodies.iter().for_each(|&body| self.take_body(body, objects));
            bodies.retain(|&body| self.number_of(body).is_none());
            if !bodies.is_empty() {
                self.note_joints_of_unlisted(&bodies);
            }
            geoms.iter().for_each(|&geom| self.take_geom(geom, objects));
            if !had_one_way && self.proxies.one_way > 0 {
                self.bodies.forget_ways();
            }
        }
        bodies.clear();
        geoms.clear();
        (self.edited_bodies, self.edited_geoms) = (bodies, geoms);
        self.note_joints_that_changed(objects);
        self.wake_up();
        debug_assert!(
            before.is_none_or(|before| self.is_as_listed_anew(objects, &before)),
            "who comes and goes changes no bit of the others"
        );
    }

    /// Whether everything is as if it had been listed anew, from what was known before.
    fn is_as_listed_anew(&self, objects: &Objects, before: &Saved) -> bool {
        let mut anew = self.clone();
        anew.list(objects, before, Edits::Taken);
        anew.note_joints_that_changed(objects);
        anew.wake_up();
        anew.save() == self.save()
    }

    /// Whether a body takes part or not against what is listed: nobody has noted it then.
    fn has_changed_flags(&self, objects: &Objects) -> bool {
        let ids = &self.bodies.ids[1..];
        let is_other = |(at, id): (usize, &Option<BodyId>)| {
            let is_movable = at < self.bodies.count;
            id.is_some_and(|id| {
                objects
                    .bodies
                    .get(id)
                    .is_none_or(|entry| !entry.body.enabled() || (is_movable && !entry.body.is_integrated()))
            })
        };
        let is_back = |&id: &BodyId| takes_part(id, objects);
        ids.iter().enumerate().any(is_other) || self.absent.iter().any(is_back)
    }

    /// Lists all bodies and geoms that take part, and takes over what is known of their pairs.
    pub(super) fn list(&mut self, objects: &Objects, saved: &Saved, edits: Edits) {
        (self.is_stale, self.has_new_members) = (false, false);
        // Proxies get other numbers, also where a handler has brought that about in the middle of an update.
        self.rolling.clear();
        self.note_joints();
        self.list_bodies(objects);
        self.list_proxies(objects);
        self.list_loose(objects);
        self.steady_all_bodies();
        self.sleep.reset(&self.bodies.ids[..self.bodies.first_fixed()]);
        self.enter_moving_fixtures();
        self.direct.reset(self.bodies.hot.len());
        self.springs.forget_numbers();
        (1..=self.bodies.count).for_each(|number| self.measure(number, objects));
        self.restore(saved, objects, edits);
    }

    /// Whether a body does not move, nor is pushed by anything but gravity.
    pub(super) fn is_at_rest(&self, id: BodyId, objects: &Objects) -> bool {
        let body = objects.bodies.get(id).map(|entry| &entry.body);
        body.is_some_and(|body| body.rests_with(body.gravity_part())) && self.rests_in_space(id)
    }

    /// Whether a pair that is known may stay.
    pub(super) fn may_stay(&self, geoms: (GeomId, GeomId), objects: &Objects) -> bool {
        let may_stay = if self.space.is_some() { is_valid_pair } else { may_go_on_touching };
        self.meets_fixture(geoms, objects).unwrap_or_else(|| may_stay(geoms, &objects.geoms, &objects.bodies))
    }

    fn list_bodies(&mut self, objects: &Objects) {
        let bodies = &objects.bodies;
        let movable = || (0..bodies.list().len()).filter_map(|at| bodies.at(at));
        self.body_numbers.clear();
        let mut fixed = Vec::new();
        let mut is_seen = vec![false; bodies.slot_count()];
        let mut see = |id: BodyId| !std::mem::replace(&mut is_seen[id.slot()], true);
        movable().filter(|(_, entry)| entry.body.is_integrated()).for_each(|(id, _)| {
            see(id);
        });
        for at in 0..objects.geoms.list().len() {
            let Some((_, geom)) = objects.geoms.at(at) else { continue };
            if bodies.get(geom.body).is_some_and(|entry| entry.body.enabled()) && see(geom.body) {
                fixed.push(geom.body);
            }
        }
        self.bodies.list(
            self.space.iter().flat_map(|space| space.moving_poses()),
            movable().filter(|(_, entry)| entry.body.is_integrated()).map(|(id, entry)| (id, &entry.body)),
            fixed.iter().map(|&id| (id, &bodies[id].body)),
        );
        self.list_fixtures();
        for (number, id) in self.bodies.ids.iter().enumerate() {
            if let Some(id) = id {
                set(&mut self.body_numbers, id.slot(), number as u32);
            }
        }
        self.absent.clear();
        self.absent.extend(movable().filter(|(_, entry)| !entry.body.enabled()).map(|(id, _)| id));
        if let Some(space) = self.space.as_deref_mut() {
            // What a field has done along the depth axis to what a handler has stopped since: no save has it.
            let unmoved = movable().filter(|(_, entry)| !entry.body.is_integrated());
            unmoved.for_each(|(id, _)| space.set_acceleration(id, 0.0));
        }
    }

    fn list_proxies(&mut self, objects: &Objects) {
        self.proxies.clear();
        self.first_proxies.clear();
        self.known.clear();
        self.bounces = false;
        let first_fixed = self.bodies.first_fixed() as u32;
        self.add_moving_fixtures();
        self.add_proxies(objects, |body| body < first_fixed);
        self.proxies.leave_room();
        self.add_proxies(objects, |body| body >= first_fixed);
        self.add_fixtures();
        self.proxies.link(self.bodies.poses.len());
        self.known.resize(self.proxies.all.len(), false);
    }

    fn add_proxies(&mut self, objects: &Objects, is_wanted: impl Fn(u32) -> bool) {
        for at in 0..objects.geoms.list().len() {
            let Some((id, geom)) = objects.geoms.at(at) else { continue };
            let Some(body) = get(&self.body_numbers, geom.body.slot()) else { continue };
            if !is_wanted(body as u32) {
                continue;
            }
            set(&mut self.first_proxies, id.slot(), self.proxies.all.len() as u32);
            for piece in 0..geom.pieces().len() {
                if let Some(proxy) = self.proxy_for(at, piece, objects) {
                    self.proxies.push(proxy);
                }
            }
        }
    }

    /// A piece of a geom, by the place of that in the list, as it is now.
    pub(super) fn proxy_for(&mut self, at: usize, piece: usize, objects: &Objects) -> Option<Proxy> {
        let (id, geom) = objects.geoms.at(at)?;
        let body = self.number_of(geom.body)?;
        let is_movable = body < self.bodies.first_fixed();
        let mobility = match is_movable {
            false => Mobility::Fixed,
            true if self.bodies.is_kinematic(body) => Mobility::Kinematic,
            true => Mobility::Dynamic,
        };
        let [friction, restitution] = surface_of(&geom.geom);
        self.bounces |= restitution > 0.0;
        let shape = self.shape_of(id, geom, piece);
        Some(Proxy {
            geom: id,
            piece: piece as u32,
            place: at as u32,
            number: geom.number,
            body: body as u32,
            mobility,
            shape,
            fingerprint: self.fingerprint_of(id, shape),
            friction,
            restitution,
            responds: geom.geom.collision_response_enabled(),
            is_heard: geom.geom.collision_callbacks_enabled(),
            filter: filter_of(geom),
            surface_velocity: self.surface_velocity(geom.body, is_movable, &objects.bodies[geom.body].body),
            one_way: self.direction_of(geom),
        })
    }

    /// What stands still and has a velocity is a belt.
    fn surface_velocity(&self, id: BodyId, is_movable: bool, body: &Body) -> [f32; 4] {
        let (velocity, spin) = (body.linear_velocity(), body.angular_velocity());
        let along_depth = self.space.as_ref().map_or(0.0, |space| space.body(id).velocity);
        if is_movable { [0.0; 4] } else { [velocity.x, velocity.y, spin, along_depth].map(with_one_zero) }
    }

    /// Its shape in the frame of its body.
    fn shape_of(&mut self, id: GeomId, geom: &GeomEntry, piece: usize) -> Shape {
        match self.space.as_ref().map(|space| space.profile(id)) {
            Some(SpaceProfile { upright: Some(upright), .. }) => {
                let ([x, y], half) = upright.front();
                self.proxies.corners.add_box_at([geom.offset.x + x, geom.offset.y + y], half)
            }
            Some(SpaceProfile { is_round: true, half_depth, .. }) => {
                let circle = Piece::Circle { centre: [0.0; 2], radius: half_depth };
                self.proxies.corners.add(&circle, geom)
            }
            _ => self.proxies.corners.add(&geom.pieces()[piece], geom),
        }
    }

    /// Fingerprint of a geom's shape, as it is listed.
    fn fingerprint_of(&self, id: GeomId, shape: Shape) -> u64 {
        let mut fingerprint = Fingerprint::default();
        fingerprint.add_outline(self.proxies.corners.outline(shape));
        if let Some(space) = &self.space {
            fingerprint.add_profile(&space.profile(id));
        }
        fingerprint.bits()
    }

    /// The proxy of a piece of a geom, if it is listed.
    pub(super) fn proxy_of(&self, geom: GeomId, piece: u32) -> Option<u32> {
        let first =
            if is_geom(geom) { get(&self.first_proxies, geom.slot()) } else { self.proxy_of_fixture(geom) };
        let at = first? + piece as usize;
        let proxy = self.proxies.all.get(at)?;
        (proxy.geom == geom && proxy.piece == piece).then_some(at as u32)
    }

    /// New bounds for a proxy that nothing is known of; its pairs are looked for.
    pub(super) fn enter(&mut self, proxy: u32) {
        self.proxies.escaped.push(proxy);
        self.widen(proxy);
    }

    /// Bounds as they were.
    pub(super) fn enter_with(&mut self, proxy: u32, bounds: Box2, depths: Depths) {
        self.proxies.bounds[proxy as usize] = bounds;
        let Some(space) = self.space.as_deref_mut() else { return self.grid.set(proxy, &bounds) };
        space.set_depths(proxy, depths);
        if space.is_in_grid(proxy) {
            self.grid.set(proxy, &space.cells(proxy, &bounds));
        }
    }
}

/// Whether a body or a geom of it is in the lists.
fn takes_part(id: BodyId, objects: &Objects) -> bool {
    let Some(entry) = objects.bodies.get(id).filter(|entry| entry.body.enabled()) else { return false };
    let has_geoms =
        || entry.geoms.iter().any(|&geom| objects.geoms.life(geom).is_some_and(|life| life.is_listed));
    (entry.body.is_integrated() && objects.bodies.life(id).is_some_and(|life| life.is_listed)) || has_geoms()
}

/// Friction and restitution of a geom.
fn surface_of(geom: &Geom) -> [f32; 2] {
    [geom.friction_coefficient(), geom.restitution_coefficient()].map(with_one_zero)
}

/// The two zeros are equal, so none replaces the other where only changes are taken over.
fn with_one_zero(number: f32) -> f32 {
    number + 0.0
}

/// What is due after an edit.
struct Renewal {
    moved: bool,
    contacts: bool,
    callbacks: bool,
    passages: bool,
}
