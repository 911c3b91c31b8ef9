//! Bodies and geoms that come and go, without all others being listed anew: what comes is the last in its list, and what goes
//! leaves its place empty. All is as if it had been listed anew, to the last bit. Where geoms are one-way, all is: what passes
//! them is known of whole bodies and geoms, and not of those alone that come and go.

use super::Precise;
use super::nearby::Loose;
use super::space::parts::is_geom;
use super::sync::{NONE, set};
use crate::body::BodyId;
use crate::geom::GeomId;
use crate::objects::Objects;
use crate::precise::parameters::broad_phase::KEPT_EMPTY_POSITIONS;

/// Who has come and gone since all were listed.
struct Members {
    /// Numbers of bodies, and proxies.
    gone_bodies: Vec<usize>,
    gone_proxies: Vec<u32>,
    /// Bodies that can be pushed, and places in the list of geoms.
    new_bodies: Vec<BodyId>,
    new_geoms: Vec<usize>,
    /// Bodies that are disabled, and whether some geom is of one.
    absent: Vec<BodyId>,
    has_absent_geoms: bool,
}

impl Precise {
    /// Takes over who has come and gone. Answers whether that was possible: what has changed otherwise, or finds no room, is
    /// for a list made anew.
    pub(super) fn follow_members(&mut self, objects: &Objects) -> bool {
        let members = Members::new(self, objects)
            .filter(|members| !members.meet_one_way(self, objects) && members.find_room(self, objects));
        let Some(members) = members else { return false };
        self.forget_members(&members);
        for &id in &members.new_bodies {
            self.add_body(id, objects);
        }
        for &at in &members.new_geoms {
            self.add_geom(at, objects);
        }
        for &id in &members.new_bodies {
            if let Some(number) = self.number_of(id) {
                self.measure(number, objects);
            }
        }
        self.renew_places(&members, objects);
        self.absent = members.absent;
        self.note_joints();
        let mut joints = std::mem::take(&mut self.sleep.joints);
        joints.retain(|joint| self.lies(joint));
        self.sleep.joints = joints;
        self.sleep.renew_runs(&self.proxies);
        true
    }

    fn forget_members(&mut self, members: &Members) {
        let Members { gone_bodies, gone_proxies, .. } = members;
        // They do not wake any more.
        gone_bodies.iter().for_each(|&number| self.sleep.forget(number));
        let pairs = gone_proxies.iter().flat_map(|&proxy| self.pairs.of(proxy));
        let mut pairs: Vec<usize> = pairs.collect();
        // From the last one on, so that numbers stay what they are.
        pairs.sort_unstable();
        pairs.dedup();
        for pair in pairs.into_iter().rev() {
            if self.pairs.all[pair].home.is_some() {
                self.note_loss(pair);
            }
            self.touch().end_touch(pair);
            self.touch().forget_pair(pair);
        }
        self.proxies.escaped.retain(|proxy| gone_proxies.binary_search(proxy).is_err());
        for &proxy in gone_proxies {
            let (geom, body) =
                (self.proxies.all[proxy as usize].geom, self.proxies.all[proxy as usize].body as usize);
            self.grid.take_out(proxy);
            self.proxies.forget(proxy);
            self.first_proxies[geom.slot()] = NONE;
            // What stands still and has no geom any more is nothing.
            if body >= self.bodies.first_fixed() && self.proxies.of(body).next().is_none() {
                self.forget_body(body);
            }
        }
        gone_bodies.iter().for_each(|&number| self.forget_body(number));
    }

    fn forget_body(&mut self, number: usize) {
        if let Some(id) = self.bodies.ids[number] {
            self.body_numbers[id.slot()] = NONE;
        }
        if number < self.bodies.first_fixed() {
            self.direct.forget(number);
            self.palette.forget(number);
        }
        self.bodies.forget(number);
    }

    fn add_body(&mut self, id: BodyId, objects: &Objects) {
        let body = &objects.bodies[id].body;
        let Some(number) = self.bodies.add_movable(id, body) else { return };
        set(&mut self.body_numbers, id.slot(), number as u32);
        self.palette.add(number, self.bodies.inverses[number]);
        self.sleep.add(number);
        self.add_body_in_space(number, id);
    }

    /// A geom by its place in the list.
    fn add_geom(&mut self, at: usize, objects: &Objects) {
        let Some((id, geom)) = objects.geoms.at(at) else { return };
        if self.number_of(geom.body).is_none() {
            self.bodies.add_fixed(geom.body, &objects.bodies[geom.body].body);
            set(&mut self.body_numbers, geom.body.slot(), self.bodies.ids.len() as u32 - 1);
        }
        for piece in 0..geom.pieces().len() {
            let Some(place) = self.proxy_for(at, piece, objects).and_then(|proxy| self.proxies.add(proxy))
            else {
                continue;
            };
            if piece == 0 {
                set(&mut self.first_proxies, id.slot(), place as u32);
            }
            if let Some(space) = self.space.as_deref_mut() {
                space.add_proxy(place, id);
            }
            self.steady_body_of(place as u32);
            let count = self.proxies.all.len();
            self.known.resize(count, false);
            self.grid.grow(count);
            self.pairs.grow(count);
            self.enter(place as u32);
            // It may be an island that is to be solved as a whole from the beginning.
            self.direct.timing.is_due = true;
        }
    }

    /// The places of geoms in their list may be others now; and queries look at more of them wherever they are, or fewer.
    fn renew_places(&mut self, members: &Members, objects: &Objects) {
        let is_loose = |at: usize| objects.geoms.at(at).is_none_or(|(id, geom)| !self.bounds_hold(id, geom));
        let new_loose: Vec<usize> = members.new_geoms.iter().copied().filter(|&at| is_loose(at)).collect();
        let known = std::mem::take(&mut self.loose);
        let is_listed = |loose: &&Loose| objects.geoms.life(loose.geom).is_some_and(|life| life.is_listed);
        let mut known = known.iter().filter(is_listed).peekable();
        let is_shifted =
            !members.gone_proxies.is_empty() || known.peek().is_some() || members.has_absent_geoms;
        let first = if is_shifted { 0 } else { members.new_geoms.first().copied().unwrap_or(usize::MAX) };
        for (at, &geom) in objects.geoms.list().iter().enumerate().skip(first) {
            let place = at as u32;
            let pieces = self.proxies_from(geom);
            let was_loose = known.next_if(|loose| loose.geom == geom).is_some();
            if was_loose || pieces.is_empty() || new_loose.binary_search(&at).is_ok() {
                self.loose.push(Loose { place, geom });
            }
            self.proxies.all[pieces].iter_mut().for_each(|proxy| proxy.place = place);
        }
    }

    /// The places of a geom's proxies, as they are listed.
    fn proxies_from(&self, geom: GeomId) -> std::ops::Range<usize> {
        let Some(first) = self.proxy_of(geom, 0).map(|first| first as usize) else { return 0..0 };
        let count = self.proxies.all[first..].iter().take_while(|proxy| proxy.geom == geom).count();
        first..first + count
    }
}

impl Members {
    /// Whether there are one-way geoms, or one comes.
    fn meet_one_way(&self, precise: &Precise, objects: &Objects) -> bool {
        let new = || self.new_geoms.iter().filter_map(|&at| objects.geoms.at(at));
        precise.proxies.one_way > 0 || new().any(|(_, geom)| geom.one_way.is_some())
    }

    /// `None` if those who are left are not what they were, or in another order.
    fn new(precise: &Precise, objects: &Objects) -> Option<Self> {
        let mut members = Members {
            gone_bodies: Vec::new(),
            gone_proxies: Vec::new(),
            new_bodies: Vec::new(),
            new_geoms: Vec::new(),
            absent: Vec::new(),
            has_absent_geoms: false,
        };
        members.compare_bodies(precise, objects)?;
        members.compare_geoms(precise, objects)?;
        members.are_whole(precise, objects).then_some(members)
    }

    fn compare_bodies(&mut self, precise: &Precise, objects: &Objects) -> Option<()> {
        let bodies = &precise.bodies;
        let (mut last, mut seen) = (0, 0);
        for (at, &id) in objects.bodies.list().iter().enumerate() {
            let known = precise.number_of(id);
            if let Some(number) = known.filter(|&number| number < bodies.first_fixed()) {
                if number <= last || !self.new_bodies.is_empty() {
                    return None;
                }
                (last, seen) = (number, seen + 1);
                continue;
            }
            let (_, entry) = objects.bodies.at(at)?;
            if entry.body.is_integrated() {
                if known.is_some() {
                    return None;
                }
                self.new_bodies.push(id);
            } else if !entry.body.enabled() {
                self.absent.push(id);
            }
        }
        if seen < bodies.live {
            let is_gone = |&number: &usize| {
                let is_listed = |id| objects.bodies.life(id).is_some_and(|life| life.is_listed);
                bodies.ids[number].is_some_and(|id| !is_listed(id))
            };
            self.gone_bodies.extend((1..=bodies.count).filter(is_gone));
        }
        (seen + self.gone_bodies.len() == bodies.live).then_some(())
    }

    fn compare_geoms(&mut self, precise: &Precise, objects: &Objects) -> Option<()> {
        let proxies = &precise.proxies;
        let (mut last, mut seen) = ([0; 2], 0);
        for (at, &id) in objects.geoms.list().iter().enumerate() {
            let pieces = precise.proxies_from(id);
            if pieces.is_empty() {
                let (_, geom) = objects.geoms.at(at)?;
                let is_there = objects.bodies.get(geom.body).is_some_and(|entry| entry.body.enabled());
                self.new_geoms.extend(is_there.then_some(at));
                self.has_absent_geoms |= !is_there;
                continue;
            }
            let last = &mut last[usize::from(pieces.start >= proxies.first_fixed)];
            if pieces.start < *last || !self.new_geoms.is_empty() {
                return None;
            }
            (*last, seen) = (pieces.end, seen + pieces.len());
        }
        let live = proxies.live - precise.fixture_count();
        if seen < live {
            let is_gone = |&at: &usize| {
                let proxy = &proxies.all[at];
                let is_listed =
                    !is_geom(proxy.geom) || objects.geoms.life(proxy.geom).is_some_and(|life| life.is_listed);
                !(proxy.is_empty() || is_listed)
            };
            self.gone_proxies.extend((0..proxies.all.len()).filter(is_gone).map(|at| at as u32));
        }
        (seen + self.gone_proxies.len() == live).then_some(())
    }

    /// Whether bodies that can be pushed come and go with all that they have.
    fn are_whole(&self, precise: &Precise, objects: &Objects) -> bool {
        let has_gone = |proxy: u32| self.gone_proxies.binary_search(&proxy).is_ok();
        let goes = |proxy: &u32| {
            let body = precise.proxies.all[*proxy as usize].body as usize;
            body >= precise.bodies.first_fixed() || self.gone_bodies.binary_search(&body).is_ok()
        };
        let comes = |&at: &usize| {
            let body = objects.geoms.at(at).map(|(_, geom)| geom.body);
            let known = body.and_then(|body| precise.number_of(body));
            known.is_none_or(|number| number >= precise.bodies.first_fixed())
        };
        // What stands still is listed before fixtures.
        let is_new =
            |&at: &usize| objects.geoms.at(at).is_some_and(|(_, geom)| self.new_bodies.contains(&geom.body));
        if precise.fixture_count() > 0 && !self.new_geoms.iter().all(is_new) {
            return false;
        }
        self.gone_bodies.iter().all(|&number| precise.proxies.of(number).all(has_gone))
            && self.gone_proxies.iter().all(goes)
            && self.new_geoms.iter().all(comes)
    }

    /// Whether there is room for those who come, and few enough places are empty.
    fn find_room(&self, precise: &Precise, objects: &Objects) -> bool {
        let Precise { bodies, proxies, grid, .. } = precise;
        let pieces = self.new_geoms.iter().filter_map(|&at| objects.geoms.at(at));
        let pieces: usize = pieces.map(|(_, geom)| geom.pieces().len()).sum();
        let places = proxies.all.len() - (proxies.first_fixed - proxies.movable);
        let is_full_enough =
            |live: usize, gone: usize, places: usize| 2 * (live - gone) + KEPT_EMPTY_POSITIONS >= places;
        bodies.count + self.new_bodies.len() < bodies.first_fixed()
            && proxies.movable + pieces <= proxies.first_fixed
            && grid.has_room(proxies.all.len() + pieces)
            && is_full_enough(bodies.live, self.gone_bodies.len(), bodies.count)
            && is_full_enough(proxies.live, self.gone_proxies.len(), places)
    }
}
