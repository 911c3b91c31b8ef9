//! The state to save.

use super::{Saved, SavedContacts, SavedPair, SavedProxy, SavedRow, Sleeper};
use crate::body::BodyId;
use crate::math::scalar::nearest_finite;
use crate::precise::Precise;
use crate::precise::direct::Wear;
use crate::precise::pairs::Frozen;
use crate::precise::rows::{Home, Kind, Lane, SpaceLane};
use crate::precise::space::parts::Depths;
use crate::precise::touch::Change;
use crate::storage::order::sort_by_number;

impl Precise {
    /// The state to save.
    pub(in crate::precise) fn save(&self) -> Saved {
        if let Some(loaded) = &self.loaded {
            return loaded.clone();
        }
        let mut has_escaped = vec![false; self.proxies.all.len()];
        self.proxies.escaped.iter().for_each(|&proxy| has_escaped[proxy as usize] = true);
        let mut places = Vec::with_capacity(self.proxies.all.len());
        let mut count = 0;
        for proxy in &self.proxies.all {
            places.push(count);
            count += u32::from(!proxy.is_empty());
        }
        let listed = self.proxies.all.iter().enumerate().filter(|(_, proxy)| !proxy.is_empty());
        let proxies = listed.map(|(at, proxy)| SavedProxy {
            geom: proxy.geom,
            number: proxy.number,
            piece: proxy.piece,
            mobility: proxy.mobility,
            bounds: self.proxies.bounds[at],
            depths: self.space.as_ref().map_or(Depths::default(), |space| space.depths(at)),
            motion: self.proxies.motion[at],
            has_escaped: has_escaped[at],
            known: self.known_of(at),
        });
        Saved {
            tuning: self.tuning,
            h: self.h,
            dt: self.dt,
            has_handled: self.has_handled,
            friction: self.friction,
            most_contacts: self.most_contacts,
            proxies: proxies.collect(),
            pairs: (0..self.pairs.len()).map(|pair| self.save_pair(pair, &places)).collect(),
            awake: self.pairs.awake as u32,
            gravity: self.sleep.gravity,
            rest: self.save_rest().collect(),
            sleepers: self.save_sleepers(),
            joints: self.sleep.joints.clone(),
            wear: self.save_wear().collect(),
            timing: self.direct.timing,
            is_in_space: self.space.is_some(),
            ways: self.save_ways().collect(),
            woken: self.woken.clone(),
            changes: self.save_changes(),
        }
    }

    /// Their order depends on whether pairs were taken out one by one or with all the others.
    fn save_changes(&self) -> Vec<Change> {
        let mut changes = self.changes.clone();
        sort_by_number(&mut changes, Change::order);
        changes
    }

    /// Of what has geoms: only those know whether they were moved since.
    fn save_ways(&self) -> impl Iterator<Item = (BodyId, [f32; 4])> + '_ {
        let count = if self.proxies.one_way > 0 { self.bodies.count } else { 0 };
        let ways = (1..=count).map(|number| (number, self.bodies.path[number]));
        let ways = ways.filter(|&(number, way)| way != [0.0; 4] && self.proxies.of(number).next().is_some());
        ways.filter_map(|(number, way)| Some((self.bodies.ids[number]?, way)))
    }

    fn save_rest(&self) -> impl Iterator<Item = (BodyId, f32)> + '_ {
        let at_rest = self.sleep.awake(self.bodies.count).filter(|&number| self.sleep.rest[number] > 0.0);
        at_rest.filter_map(|number| Some((self.name_of(number)?, self.sleep.rest[number])))
    }

    fn save_wear(&self) -> impl Iterator<Item = (BodyId, Wear)> + '_ {
        let worn = (1..=self.bodies.count).map(|number| (number, self.direct.wear[number]));
        let worn = worn.filter(|&(_, wear)| wear != Wear::default());
        worn.filter_map(|(number, wear)| Some((self.bodies.ids[number]?, wear)))
    }

    fn save_sleepers(&self) -> Vec<Sleeper> {
        let mut sleepers = Vec::with_capacity(self.sleep.count);
        let mut places = vec![0; self.bodies.count + 1];
        let mut are_fresh = vec![false; self.bodies.count + 1];
        self.sleep.fresh.iter().for_each(|&body| are_fresh[body as usize] = true);
        for number in (1..=self.bodies.count).filter(|&number| self.sleep.is_asleep(number)) {
            let Some(body) = self.name_of(number) else { continue };
            places[number] = sleepers.len() as u32;
            let first = places[self.sleep.first_with(number)];
            sleepers.push(Sleeper {
                body,
                first,
                place: self.place_of(number),
                borne: self.sleep.borne[number],
                nature: self.nature_of(number),
                is_fresh: are_fresh[number],
            });
        }
        sleepers
    }

    fn save_pair(&self, pair: usize, places: &[u32]) -> SavedPair {
        let (watch, state) = (self.pairs.watched[pair], self.pairs.all[pair]);
        let Frozen { turns, relative, normal, count, anchors, separations, features, lead, space } =
            self.pairs.frozen[pair];
        SavedPair {
            proxies: watch.proxies.map(|proxy| places[proxy as usize]),
            since: watch.since,
            tolerance: watch.tolerance,
            is_told: state.is_told,
            is_vetoed: state.is_vetoed,
            was_vetoed: state.was_vetoed,
            passage: state.passage,
            frozen: SavedContacts {
                turns,
                relative,
                normal,
                count,
                anchors,
                separations,
                features,
                lead,
                space,
            },
            row: state.home.map(|home| self.save_row(state.kind, home, state.is_set)),
        }
    }

    fn save_row(&self, kind: Kind, home: Home, is_set: bool) -> SavedRow {
        let Lane { tangent_impulse, points, friction, restitution, tangent_speed, space, .. } =
            self.rows.lane(kind, home);
        let (sleeping, aside) = (self.rows.asleep(home), self.rows.aside(home));
        let surface = is_set.then_some([friction, restitution, tangent_speed]);
        SavedRow {
            colour: aside.map_or(home.colour, |row| row.colour),
            slot: if home.is_in_order() { home.slot } else { 0 },
            asleep: sleeping.map(|row| row.h),
            direct: aside.filter(|_| sleeping.is_none()).map(|row| (row.h, row.exact)),
            tangent_impulse,
            space: saved_of(space),
            impulses: points.map(|point| point.impulse),
            held: points.map(|point| point.held),
            are_dropped: points.map(|point| point.mass == 0.0),
            // What spins beyond all measure leaves a contact by more than there are numbers.
            separations: points.map(|point| nearest_finite(point.separation)),
            kept: surface.filter(|_| sleeping.is_some()),
            surface: surface.filter(|_| sleeping.is_none()),
        }
    }
}

fn saved_of(space: SpaceLane) -> [f32; 6] {
    let [one, other, along, across] = space.totals;
    [space.across_impulse, space.twist_impulse, one, other, along, across]
}
