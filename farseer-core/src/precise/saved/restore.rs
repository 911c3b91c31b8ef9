//! What was saved is taken over. Pairs of what has gone are taken out in the order in which
//! [`members`](crate::precise::members) does.

use super::{Edits, Saved, SavedContacts, SavedPair, SavedProxy, SavedRow, Sleeper};
use crate::body::BodyId;
use crate::objects::Objects;
use crate::precise::Precise;
use crate::precise::one_way::Passage;
use crate::precise::pairs::{BY_ROW, Frozen};
use crate::precise::touch::Change;
use crate::storage::order::sort_by_number;

impl Precise {
    /// Takes over what is known of the proxies and pairs that are still there.
    pub(in crate::precise) fn restore(&mut self, saved: &Saved, objects: &Objects, edits: Edits) {
        self.has_handled =
            saved.has_handled || saved.pairs.iter().any(|pair| pair.is_vetoed || pair.was_vetoed);
        self.grid.reset(self.proxies.all.len());
        self.pairs.reset(self.proxies.all.len());
        self.rows.clear();
        self.palette.reset(&self.bodies.inverses[..self.bodies.hot.len()]);
        self.note_swings();
        self.restore_wear(saved);
        self.restore_ways(saved);
        let (places, edited) = self.restore_proxies(saved, edits);
        self.restore_sleep(saved, objects);
        let stays = |pair: &SavedPair| {
            let now = pair.proxies.map(|proxy| places[proxy as usize]);
            now[0].zip(now[1]).map(|(a, b)| [a, b]).filter(|&now| {
                let [one, other] = now.map(|proxy| self.proxies.all[proxy as usize].geom);
                self.ordered(now) == Some(now)
                    && (edits == Edits::Awaited || self.may_stay((one, other), objects))
            })
        };
        let stays: Vec<_> = saved.pairs.iter().map(stays).collect();
        self.end_touches(saved, |at| stays[at].is_none());
        for (pair, _) in
            saved.pairs.iter().zip(&stays).filter(|(pair, stays)| stays.is_none() && pair.row.is_some())
        {
            self.lose_row(pair, &places);
        }
        let mut rows = Vec::new();
        for at in saved.order_without(|at| stays[at].is_none()) {
            let (pair, Some(now)) = (&saved.pairs[at], stays[at]) else { continue };
            let row = self.restore_pair(now, pair);
            let was_direct = pair.row.is_some_and(|row| row.direct.is_some());
            self.direct.timing.is_due |= was_direct && row.is_none();
            rows.extend(row);
        }
        self.renew_turned(saved, &places);
        edited.into_iter().for_each(|proxy| self.look_again(proxy));
        self.restore_rows(rows);
        self.lay_pairs_down();
        self.woken.clear();
        self.woken.extend_from_slice(&saved.woken);
        self.wake_woken();
    }

    /// Changes that the game has not been told yet, and touches that have ended because their pair is lost: by categories or a
    /// group, because a side was disabled or is gone, or has other pieces now.
    fn end_touches(&mut self, saved: &Saved, is_lost: impl Fn(usize) -> bool) {
        self.changes.clear();
        self.changes.extend_from_slice(&saved.changes);
        let ended = saved.pairs.iter().enumerate().filter(|&(at, pair)| pair.is_told && is_lost(at));
        self.changes.extend(ended.map(|(_, pair)| {
            let sides = pair.proxies.map(|proxy| &saved.proxies[proxy as usize]);
            Change::new(sides.map(|proxy| (proxy.number, proxy.geom)), false)
        }));
    }

    /// The rows of pairs, as they were saved.
    fn restore_rows(&mut self, mut rows: Vec<(usize, SavedRow)>) {
        // Only the order of rows in the last colour matters.
        sort_by_number(&mut rows, |(_, row): &(usize, SavedRow)| row.slot.into());
        for (pair, row) in rows {
            let surface = row.kept.or(row.surface);
            if let Some([_, restitution, _]) = surface {
                self.pairs.all[pair].is_set = true;
                self.bounces |= restitution > 0.0;
            }
            let aside = row.asleep.map(|h| (h, None)).or(row.direct.map(|(h, exact)| (h, Some(exact))));
            self.touch().restore_row(pair, row.colour, aside, |lane| {
                if let Some(surface) = surface {
                    [lane.friction, lane.restitution, lane.tangent_speed] = surface;
                }
                lane.tangent_impulse = row.tangent_impulse;
                let [across, twist, totals @ ..] = row.space;
                (lane.space.across_impulse, lane.space.twist_impulse) = (across, twist);
                lane.space.totals = totals;
                for (at, point) in lane.points.iter_mut().enumerate() {
                    point.impulse = row.impulses[at];
                    point.held = row.held[at];
                    point.separation = row.separations[at];
                    if row.are_dropped[at] {
                        point.mass = 0.0;
                    }
                }
            });
        }
    }

    /// What a row's bodies rested on has gone, with the row.
    fn lose_row(&mut self, pair: &SavedPair, places: &[Option<u32>]) {
        let was_direct = pair.row.is_some_and(|row| row.direct.is_some());
        self.direct.timing.is_due |= was_direct;
        self.direct.timing.may_be_due |= self.space.is_none();
        for proxy in pair.proxies.iter().filter_map(|&proxy| places[proxy as usize]) {
            self.sleep.note_loss(self.proxies.all[proxy as usize].body as usize);
        }
    }

    /// Of the bodies that move now.
    fn restore_ways(&mut self, saved: &Saved) {
        for &(body, way) in &saved.ways {
            if let Some(number) = self.number_of(body).filter(|&number| number <= self.bodies.count) {
                self.bodies.path[number] = way;
            }
        }
    }

    /// Those proxies whose direction is another one.
    fn renew_turned(&mut self, saved: &Saved, places: &[Option<u32>]) {
        for (proxy, place) in saved.proxies.iter().zip(places) {
            if let Some(place) =
                place.filter(|&now| self.proxies.all[now as usize].one_way != proxy.known.one_way)
            {
                self.renew_passages(place);
            }
        }
    }

    fn restore_wear(&mut self, saved: &Saved) {
        self.direct.timing = saved.timing;
        for &(body, wear) in &saved.wear {
            match self.number_of(body).filter(|&number| self.is_dynamic(number)) {
                Some(number) => self.direct.wear[number] = wear,
                None => self.direct.timing.is_due |= wear.is_direct,
            }
        }
    }

    /// Who slept, and still may, does; a body that was edited since wakes the others of its island.
    fn restore_sleep(&mut self, saved: &Saved, objects: &Objects) {
        self.sleep.gravity = saved.gravity;
        // What wakes before the next step begins asks what lies on what.
        self.fall = saved.gravity.map(|part| part * saved.dt);
        for &(body, rest) in &saved.rest {
            if let Some(number) = self.number_named(body).filter(|&number| number <= self.bodies.count) {
                self.sleep.rest[number] = rest;
            }
        }
        // By the first of each island: one of it that sleeps again.
        let mut again = vec![None; saved.sleepers.len()];
        for &Sleeper { body, first, place, borne, nature, is_fresh } in &saved.sleepers {
            let may_sleep = |&number: &usize| {
                (self.is_dynamic(number) || self.swings(number)) && !self.sleep.is_asleep(number)
            };
            let Some(number) = self.number_named(body).filter(may_sleep) else { continue };
            self.bodies.rest(number, 1.0);
            self.sleep.lay_down(number, again[first as usize], borne);
            again[first as usize] = Some(number);
            self.sleep.fresh.extend(is_fresh.then_some(number as u32));
            // Forces may have been applied since.
            self.sleep.note_push(number);
            if self.place_of(number) != place
                || self.nature_of(number) != nature
                || !(self.is_at_rest(body, objects) || self.is_swing_at_rest(number))
            {
                self.sleep.note_waking(number);
                self.take_swing(number);
                // Contacts are looked at with the velocity that it was given.
                // What swings has the name of no body.
                if let Some(entry) = objects.bodies.get(body) {
                    self.bodies.set_velocity(number, &entry.body);
                    self.take_body_in_space(number, body);
                }
                self.steady_if_upright(number);
            }
        }
        self.sleep.joints = saved.joints.iter().filter(|joint| self.lies(joint)).copied().collect();
        self.sleep.renew_runs(&self.proxies);
    }

    /// Answers where each saved proxy is now, and whose contacts are to be looked at again. One that is moved by
    /// something else now than before is another one.
    fn restore_proxies(&mut self, saved: &Saved, edits: Edits) -> (Vec<Option<u32>>, Vec<u32>) {
        let mut is_known = vec![false; self.proxies.all.len()];
        let mut places = Vec::with_capacity(saved.proxies.len());
        let mut edited = Vec::new();
        for proxy in &saved.proxies {
            let place = self
                .proxy_of(proxy.geom, proxy.piece)
                .filter(|&place| self.proxies.all[place as usize].mobility == proxy.mobility)
                .filter(|&place| !std::mem::replace(&mut is_known[place as usize], true));
            if let Some(place) = place {
                edited.extend(self.restore_proxy(place, proxy, edits).then_some(place));
            }
            places.push(place);
        }
        for at in (0..self.proxies.all.len()).filter(|&at| !is_known[at]) {
            if !self.proxies.all[at].is_empty() {
                self.enter(at as u32);
                // What has come may be an island that is to be solved as a whole from the beginning.
                self.direct.timing.is_due = true;
            }
        }
        (places, edited)
    }

    /// Answers whether something has changed that its contacts depend on.
    fn restore_proxy(&mut self, place: u32, saved: &SavedProxy, edits: Edits) -> bool {
        let (then, mut now) = (saved.known, self.known_of(place as usize));
        if edits == Edits::Awaited && then.filter != now.filter {
            let [filter @ .., responds] = then.filter;
            let proxy = &mut self.proxies.all[place as usize];
            (proxy.filter, proxy.responds) = (filter, responds != 0);
            self.edited_geoms.push(proxy.geom);
            now.filter = then.filter;
        }
        self.proxies.motion[place as usize] = saved.motion;
        self.enter_with(place, saved.bounds, saved.depths);
        let has_moved = then.place != now.place;
        // Bounds and manifolds are those of the shape that the proxy had.
        let is_reshaped = then.fingerprint != now.fingerprint;
        if has_moved {
            self.bodies.forget_way(self.proxies.all[place as usize].body as usize);
        }
        if has_moved || is_reshaped {
            self.jump(place);
        }
        if saved.has_escaped || has_moved || is_reshaped || then.filter != now.filter {
            self.proxies.escaped.push(place);
        }
        has_moved
            || is_reshaped
            || then.contacts != now.contacts
            || then.filter != now.filter
            || then.one_way != now.one_way
    }

    /// Answers the pair and its row. A pair whose contacts push now and did not before, or the other way round, is looked at
    /// anew.
    fn restore_pair(&mut self, proxies: [u32; 2], saved: &SavedPair) -> Option<(usize, SavedRow)> {
        if self.pairs.contains(proxies) {
            return None;
        }
        let pair = self.add_pair(proxies);
        let responds = self.pairs.all[pair].responds;
        let SavedContacts { turns, relative, normal, count, anchors, separations, features, lead, space } =
            saved.frozen;
        self.pairs.frozen[pair] =
            Frozen { turns, relative, normal, count, anchors, separations, features, lead, space };
        let watch = &mut self.pairs.watched[pair];
        (watch.since, watch.tolerance) = (saved.since, saved.tolerance);
        self.pairs.all[pair].is_vetoed = saved.is_vetoed;
        self.pairs.all[pair].was_vetoed = saved.was_vetoed;
        if self.pairs.all[pair].passage != Passage::Closed && saved.passage != Passage::Closed {
            self.pairs.all[pair].passage = saved.passage;
        }
        self.pairs.set_told(pair, saved.is_told);
        let row = saved.row.filter(|_| responds);
        // What was refused is looked at again in the next step in any case.
        let has_row = row.is_some() || saved.is_vetoed;
        if saved.tolerance == BY_ROW && !(has_row && self.touch().are_two_circles(pair)) {
            self.pairs.watched[pair].tolerance = 0;
        }
        row.map(|row| (pair, row))
    }
}

impl Saved {
    /// A body wakes once all is listed, if it sleeps.
    pub(in crate::precise) fn wake(&mut self, body: BodyId) {
        if self.sleepers.iter().any(|sleeper| sleeper.body == body) && !self.woken.contains(&body) {
            self.woken.push(body);
        }
    }

    /// The pairs without those that are lost, in the order in which they are once these were taken out, from the last one on.
    fn order_without(&self, is_lost: impl Fn(usize) -> bool) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.pairs.len()).collect();
        let mut awake = (self.awake as usize).min(order.len());
        for lost in (0..self.pairs.len()).rev().filter(|&at| is_lost(at)) {
            if lost < awake {
                awake -= 1;
                order.swap(lost, awake);
                order.swap_remove(awake);
            } else {
                order.swap_remove(lost);
            }
        }
        order
    }
}
