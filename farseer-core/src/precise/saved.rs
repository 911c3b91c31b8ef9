//! What is saved of the precise set, and taken over when everything is listed anew: everything that a later bit depends on.
//! Pairs of what has gone are taken out in the order in which [`members`](super::members) does.
//! What follows from that and from the objects is not.

use serde::{Deserialize, Serialize, Serializer};

use super::Precise;
use super::direct::{Timing, Wear};
use super::one_way::Passage;
use super::pairs::{BY_ROW, Frozen, FrozenInSpace};
use super::proxies::{Mobility, Proxy};
use super::rows::{Home, Kind, Lane, SpaceLane};
use super::sleep::KnownJoint;
use super::space::Held;
use super::space::parts::Depths;
use super::tuning::Tuning;
use crate::body::BodyId;
use crate::geom::GeomId;
use crate::geom::surface::FrictionType;
use crate::math::plane::Vector;
use crate::math::scalar::nearest_finite;
use crate::methods::Methods;
use crate::objects::Objects;
use crate::storage::order::sort_by_number;

/// The state of the precise set.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Saved {
    tuning: Tuning,
    h: f32,
    dt: f32,
    has_handled: bool,
    friction: FrictionType,
    most_contacts: u32,
    proxies: Vec<SavedProxy>,
    /// First those that may change: so many.
    pairs: Vec<SavedPair>,
    awake: u32,
    /// The gravity that things sleep under, how long others have been at rest, and what sleeps.
    gravity: [f32; 2],
    rest: Vec<(BodyId, f32)>,
    sleepers: Vec<Sleeper>,
    joints: Vec<KnownJoint>,
    /// Whether there is a depth axis.
    is_in_space: bool,
    /// How islands have fared that were solved as a whole, and when islands are asked for next.
    wear: Vec<(BodyId, Wear)>,
    timing: Timing,
    /// The ways of the last step, if something is one-way.
    ways: Vec<(BodyId, [f32; 4])>,
    /// Bodies that the game woke since the last update.
    woken: Vec<BodyId>,
}

/// A body that sleeps.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Sleeper {
    body: BodyId,
    /// The place in this list of the first one of those that fell asleep together.
    first: u32,
    place: [f32; 4],
    borne: [f32; 4],
    /// Reciprocals of mass and inertia, and what part of gravity acts.
    nature: [f32; 3],
    /// It has just fallen asleep, and does not know yet what it bears.
    is_fresh: bool,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct SavedProxy {
    geom: GeomId,
    piece: u32,
    mobility: Mobility,
    bounds: [f32; 4],
    /// Along the depth axis.
    depths: Depths,
    motion: u32,
    has_escaped: bool,
    known: Known,
}

/// What was known of a proxy and its body when contacts were looked for: what is otherwise was edited since.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Known {
    place: [f32; 4],
    /// Reciprocals of mass and inertia, velocity of the surface, friction and restitution.
    contacts: [f32; 8],
    /// Whom it may meet, and whether it pushes.
    filter: [i32; 6],
    /// The direction against which it holds.
    one_way: Option<Vector>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct SavedPair {
    /// Places in the list of saved proxies.
    proxies: [u32; 2],
    since: u32,
    tolerance: u32,
    is_told: bool,
    is_vetoed: bool,
    passage: Passage,
    frozen: SavedContacts,
    row: Option<SavedRow>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct SavedContacts {
    turns: [f32; 4],
    relative: [f32; 4],
    normal: [f32; 2],
    count: u32,
    anchors: [[f32; 4]; 2],
    separations: [f32; 2],
    features: [u32; 2],
    lead: f32,
    space: FrozenInSpace,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct SavedRow {
    colour: u32,
    /// Its place among the rows of the last colour, whose order matters; else 0.
    slot: u32,
    /// Seconds of the substeps that its impulses are of, if it sleeps.
    asleep: Option<f32>,
    /// The same if it is solved with its island, and its impulses with all their digits.
    direct: Option<(f32, [f64; 3])>,
    tangent_impulse: f32,
    /// Of the second tangent, of twisting, and of the whole step: in three axes.
    space: [f32; 6],
    impulses: [f32; 2],
    held: [f32; 2],
    /// A handler has taken the point off the list.
    are_dropped: [bool; 2],
    separations: [f32; 2],
    /// Friction, restitution and tangent speed, if a handler has set them: of a row that sleeps.
    kept: Option<[f32; 3]>,
    /// The same of one that is awake. For the rest of the step alone: the next one begins with those of the geoms.
    #[serde(skip)]
    surface: Option<[f32; 3]>,
}

fn saved_of(space: SpaceLane) -> [f32; 6] {
    let [one, other, along, across] = space.totals;
    [space.across_impulse, space.twist_impulse, one, other, along, across]
}

impl Serialize for Precise {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.save().serialize(serializer)
    }
}

impl From<Saved> for Precise {
    fn from(saved: Saved) -> Self {
        Precise {
            h: saved.h,
            dt: saved.dt,
            friction: saved.friction,
            most_contacts: saved.most_contacts,
            space: saved.is_in_space.then(Held::new).flatten(),
            loaded: Some(saved.clone()),
            ..Precise::new(saved.tuning.unit)
        }
    }
}

impl Saved {
    /// Whether everything is finite and names what is there: false only after loading garbage.
    fn is_valid(&self) -> bool {
        let finite = |numbers: &[f32]| numbers.iter().all(|number| number.is_finite());
        let pair_is_valid = |pair: &SavedPair| {
            let SavedContacts { turns, relative, normal, count, anchors, separations, lead, space, .. } =
                &pair.frozen;
            let row_is_valid = |row: &SavedRow| {
                let SavedRow {
                    tangent_impulse,
                    space,
                    impulses,
                    held,
                    separations,
                    asleep,
                    direct,
                    kept,
                    ..
                } = row;
                (row.colour as usize) < super::rows::COLOURS
                    && finite(&[*tangent_impulse, asleep.unwrap_or(0.0)])
                    && direct.is_none_or(|(h, exact)| h.is_finite() && exact.iter().all(|x| x.is_finite()))
                    && finite(&kept.unwrap_or_default())
                    && finite(space)
                    && [impulses, held, separations].iter().all(|numbers| finite(*numbers))
            };
            pair.proxies.iter().all(|&proxy| (proxy as usize) < self.proxies.len())
                && *count <= 2
                && finite(turns)
                && finite(relative)
                && finite(normal)
                && finite(&[space.normal_z, space.apart, space.spread])
                && finite(&space.depths)
                && finite(separations)
                && lead.abs() <= 1.0
                && anchors.iter().all(|anchor| finite(anchor))
                && pair.row.as_ref().is_none_or(|row| *count > 0 && row_is_valid(row))
        };
        let Tuning { unit, .. } = self.tuning;
        unit.is_finite()
            && unit > 0.0
            && self.tuning == Tuning::new(unit)
            && self.h.is_finite()
            && self.dt.is_finite()
            && self.proxies.iter().all(
                |SavedProxy { bounds, depths, known: Known { place, contacts, one_way, .. }, .. }| {
                    finite(&[depths.low, depths.high])
                        && finite(bounds)
                        && finite(place)
                        && finite(contacts)
                        && finite(&one_way.unwrap_or_default())
                },
            )
            && self.pairs.iter().all(pair_is_valid)
            && finite(&self.gravity)
            && self.ways.iter().all(|(_, way)| finite(way))
            && self.rest.iter().all(|&(_, rest)| rest.is_finite())
            && self.wear.iter().all(|(_, wear)| wear.effort.is_finite())
            && self.sleepers.iter().all(|sleeper| {
                let is_there = (sleeper.first as usize) < self.sleepers.len();
                is_there && finite(&sleeper.place) && finite(&sleeper.borne) && finite(&sleeper.nature)
            })
    }
}

impl Saved {
    /// A body wakes once all is listed, if it sleeps.
    pub(super) fn wake(&mut self, body: BodyId) {
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

impl Precise {
    /// Whether what was loaded can be used, and is of these methods.
    pub(crate) fn is_valid(&self, methods: Methods) -> bool {
        matches!(methods, Methods::Precise { length_unit } if length_unit == self.tuning.unit)
            && self
                .loaded
                .as_ref()
                .is_none_or(|saved| saved.is_valid() && saved.is_in_space == self.space.is_some())
    }

    /// Lists what was loaded, for those who ask what touches before the next update. What was edited before the save counts
    /// from that update on, which then lists everything once more.
    pub(crate) fn list_loaded(&mut self, objects: &Objects) {
        // The engine above tells of the depth axis first.
        let Some(saved) = self.loaded.take_if(|saved| !saved.is_in_space) else { return };
        self.list(objects, &saved);
        if self.save() != saved {
            self.is_stale = true;
            self.loaded = Some(saved);
        }
    }

    /// The state to save.
    pub(super) fn save(&self) -> Saved {
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
        }
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
        at_rest.filter_map(|number| Some((self.bodies.ids[number]?, self.sleep.rest[number])))
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
            let Some(body) = self.bodies.ids[number] else { continue };
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

    fn nature_of(&self, number: usize) -> [f32; 3] {
        let [mass, inertia] = self.bodies.inverses[number];
        [mass, inertia, self.bodies.gravity_parts[number]]
    }

    /// Position and rotation, and where it is along the depth axis.
    fn place_of(&self, number: usize) -> [f32; 4] {
        let ([x, y, ..], rotation) = (self.bodies.poses[number], self.bodies.rotations[number]);
        [x, y, rotation, self.space.as_ref().map_or(0.0, |space| space.places[number])]
    }

    fn known_of(&self, proxy: usize) -> Known {
        let Proxy { body, friction, restitution, surface_velocity, filter, responds, one_way, .. } =
            self.proxies.all[proxy];
        let ([mass, inertia], [vx, vy, spin, vz]) = (self.bodies.inverses[body as usize], surface_velocity);
        let [is, with, group, enabled, ignores] = filter;
        Known {
            place: self.place_of(body as usize),
            contacts: [mass, inertia, vx, vy, spin, vz, friction, restitution],
            filter: [is, with, group, enabled, ignores, i32::from(responds)],
            one_way,
        }
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

    /// Takes over what is known of the proxies and pairs that are still there.
    pub(super) fn restore(&mut self, saved: &Saved, objects: &Objects) {
        self.has_handled = saved.has_handled || saved.pairs.iter().any(|pair| pair.is_vetoed);
        self.grid.reset(self.proxies.all.len());
        self.pairs.reset(self.proxies.all.len());
        self.rows.clear();
        self.palette.reset(&self.bodies.inverses[..self.bodies.hot.len()]);
        self.restore_wear(saved);
        self.restore_ways(saved);
        let (places, edited) = self.restore_proxies(saved);
        self.restore_sleep(saved, objects);
        let stays = |pair: &SavedPair| {
            let now = pair.proxies.map(|proxy| places[proxy as usize]);
            now[0].zip(now[1]).map(|(a, b)| [a, b]).filter(|&now| {
                let [one, other] = now.map(|proxy| self.proxies.all[proxy as usize].geom);
                self.ordered(now) == Some(now) && self.may_stay((one, other), objects)
            })
        };
        let stays: Vec<_> = saved.pairs.iter().map(stays).collect();
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
        self.lay_pairs_down();
        self.woken.clear();
        self.woken.extend_from_slice(&saved.woken);
        self.wake_woken();
    }

    /// What a row's bodies rested on has gone, with the row.
    fn lose_row(&mut self, pair: &SavedPair, places: &[Option<u32>]) {
        let was_direct = pair.row.is_some_and(|row| row.direct.is_some());
        self.direct.timing.is_due |= was_direct;
        self.direct.timing.may_be_due = true;
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
        for &(body, rest) in &saved.rest {
            if let Some(number) = self.number_of(body).filter(|&number| number <= self.bodies.count) {
                self.sleep.rest[number] = rest;
            }
        }
        // By the first of each island: one of it that sleeps again.
        let mut again = vec![None; saved.sleepers.len()];
        for &Sleeper { body, first, place, borne, nature, is_fresh } in &saved.sleepers {
            let may_sleep = |number: &usize| self.is_dynamic(*number) && !self.sleep.is_asleep(*number);
            let Some(number) = self.number_of(body).filter(may_sleep) else { continue };
            self.bodies.rest(number, 1.0);
            self.sleep.lay_down(number, again[first as usize], borne);
            again[first as usize] = Some(number);
            self.sleep.fresh.extend(is_fresh.then_some(number as u32));
            // Forces may have been applied since.
            self.sleep.note_push(number);
            if self.place_of(number) != place
                || self.nature_of(number) != nature
                || !self.is_at_rest(body, objects)
            {
                self.sleep.note_waking(number);
                // Contacts are looked at with the velocity that it was given.
                if let Some(entry) = objects.bodies.get(body) {
                    self.bodies.set_velocity(number, &entry.body);
                }
                self.take_body_in_space(number, body);
                self.steady_if_upright(number);
            }
        }
        self.sleep.joints = saved.joints.iter().filter(|joint| self.lies(joint)).copied().collect();
        self.sleep.renew_runs(&self.proxies);
    }

    /// Answers where each saved proxy is now, and whose contacts are to be looked at again. One that is moved by
    /// something else now than before is another one.
    fn restore_proxies(&mut self, saved: &Saved) -> (Vec<Option<u32>>, Vec<u32>) {
        let mut is_known = vec![false; self.proxies.all.len()];
        let mut places = Vec::with_capacity(saved.proxies.len());
        let mut edited = Vec::new();
        for proxy in &saved.proxies {
            let place = self
                .proxy_of(proxy.geom, proxy.piece)
                .filter(|&place| self.proxies.all[place as usize].mobility == proxy.mobility)
                .filter(|&place| !std::mem::replace(&mut is_known[place as usize], true));
            if let Some(place) = place {
                edited.extend(self.restore_proxy(place, proxy).then_some(place));
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
    fn restore_proxy(&mut self, place: u32, saved: &SavedProxy) -> bool {
        let (then, now) = (saved.known, self.known_of(place as usize));
        self.proxies.motion[place as usize] = saved.motion;
        self.enter_with(place, saved.bounds, saved.depths);
        let has_moved = then.place != now.place;
        if has_moved {
            self.jump(place);
            self.bodies.forget_way(self.proxies.all[place as usize].body as usize);
        }
        if saved.has_escaped || has_moved || then.filter != now.filter {
            self.proxies.escaped.push(place);
        }
        has_moved || then.contacts != now.contacts || then.filter != now.filter || then.one_way != now.one_way
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
