//! The contact state between two geoms, and the ordered list of all of them (behaviour chapter 03).

use serde::{Deserialize, Serialize};

use crate::contacts::contact::Contact;
use crate::contacts::listed_pairs::ListedPairs;
use crate::contacts::pair_table::GeomPairBitmap;
use crate::geom::GeomId;
use crate::geom::entry::Geoms;
use crate::math::scalar::nearest_finite;
use crate::storage::order::{sort_by_number, sort_by_number_in};
use farseer_precise::reusing_clone;
use farseer_precise::surface::{FrictionType, SurfaceOverride, mix_friction};

/// Number of arbiters in the pool of a new simulator.
const INITIAL_POOL_SIZE: u32 = 128;

/// Number of contacts for which an arbiter reserves memory: the default maximum that is resolved.
const CONTACT_CAPACITY: usize = 4;

/// Contact state of two geoms. A has the smaller creation number.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct Arbiter {
    /// `None` only before first use.
    pub(crate) geoms: Option<(GeomId, GeomId)>,
    /// Combined friction coefficient, dimensionless, computed when the arbiter is set up. Infinite if the sum of the
    /// coefficients is.
    #[serde(with = "crate::storage::bits")]
    pub(crate) friction: f32,
    /// Contacts; set-up does not clear them: a pair that gets its old arbiter back continues with the old impulses.
    pub(crate) contacts: Vec<Contact>,
}

reusing_clone! { Arbiter { geoms, friction, contacts } }

impl Arbiter {
    fn fresh() -> Self {
        Arbiter { geoms: None, friction: 0.0, contacts: Vec::with_capacity(CONTACT_CAPACITY) }
    }
}

/// The contact state between two geoms.
#[derive(Debug, Clone, Copy)]
#[doc(alias = "Arbiter")]
pub struct ArbiterRef<'a> {
    pub(crate) handle: u32,
    pub(crate) geoms: (GeomId, GeomId),
    pub(crate) friction: f32,
    pub(crate) contacts: ContactSource<'a>,
}

/// The contacts of a pair: those stored in the arbiter, or copies that were computed for the caller.
#[derive(Debug, Clone, Copy)]
pub(crate) enum ContactSource<'a> {
    Stored(&'a [Contact]),
    #[cfg(feature = "precise")]
    Copied([Contact; 2], usize),
}

impl ContactSource<'_> {
    fn as_slice(&self) -> &[Contact] {
        match self {
            ContactSource::Stored(contacts) => contacts,
            #[cfg(feature = "precise")]
            ContactSource::Copied(contacts, count) => &contacts[..*count],
        }
    }
}

impl<'a> ArbiterRef<'a> {
    /// Whether this is the same arbiter as `other`. A simulator's list may hold an arbiter twice: it is solved twice
    /// then but has its contacts once.
    pub fn is_same(&self, other: &Self) -> bool {
        self.handle == other.handle
    }

    /// The geom with the smaller creation number.
    #[doc(alias("GeometryA", "GeomA"))]
    pub fn geom_a(&self) -> GeomId {
        self.geoms.0
    }

    /// The geom with the greater creation number.
    #[doc(alias("GeometryB", "GeomB"))]
    pub fn geom_b(&self) -> GeomId {
        self.geoms.1
    }

    /// The combined friction coefficient, dimensionless, fixed when the boxes began to overlap. If the sum of the two
    /// coefficients is infinite, the greatest finite number.
    pub fn friction(&self) -> f32 {
        nearest_finite(self.friction)
    }

    /// The contacts, deepest first.
    #[doc(alias = "ContactList")]
    pub fn contacts(&self) -> impl ExactSizeIterator<Item = Contact> + use<'a> {
        let contacts = self.contacts;
        (0..contacts.as_slice().len()).map(move |at| contacts.as_slice()[at])
    }
}

/// Arbiters in the order in which they are solved, and a pool of unused ones.
///
/// Arbiters have identity: list and pool hold handles, and both may hold the same handle twice, which happens in the
/// original when a geom with a duplicated pair is removed.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct ArbiterList {
    pub(crate) arbiters: Vec<Arbiter>,
    pub(crate) list: Vec<u32>,
    /// A stack: the last arbiter put in is taken first.
    pool: Vec<u32>,
    pairs: GeomPairBitmap,
    /// By handle: whether an engine on top solves the arbiter itself in this update. Empty as long as there is none.
    #[serde(skip)]
    left_to_engine: Vec<bool>,
    /// By handle: surface properties that a handler has set in this update. Empty as long as there are none.
    #[serde(skip)]
    surfaces: Vec<SurfaceOverride>,
    /// Index of the listed pairs, valid while a broad phase that [asks for it](Self::index_listed) searches for pairs.
    #[serde(skip)]
    listed: ListedPairs,
}

reusing_clone! { ArbiterList { arbiters, list, pool, pairs, left_to_engine, surfaces, listed } }

impl Default for ArbiterList {
    fn default() -> Self {
        ArbiterList {
            arbiters: (0..INITIAL_POOL_SIZE).map(|_| Arbiter::fresh()).collect(),
            list: Vec::new(),
            pool: (0..INITIAL_POOL_SIZE).collect(),
            pairs: GeomPairBitmap::default(),
            left_to_engine: Vec::new(),
            surfaces: Vec::new(),
            listed: ListedPairs::default(),
        }
    }
}

impl ArbiterList {
    #[inline]
    pub(crate) fn len(&self) -> usize {
        self.list.len()
    }

    #[inline]
    pub(crate) fn at(&self, position: usize) -> &Arbiter {
        &self.arbiters[self.list[position] as usize]
    }

    pub(crate) fn get_mut(&mut self, position: usize) -> Option<&mut Arbiter> {
        self.list.get(position).map(|&handle| &mut self.arbiters[handle as usize])
    }

    /// Excludes an arbiter from the core's solver.
    pub(crate) fn leave_to_engine(&mut self, position: usize) {
        if let Some(&handle) = self.list.get(position) {
            self.left_to_engine.resize(self.arbiters.len(), false);
            self.left_to_engine[handle as usize] = true;
        }
    }

    /// Clears the settings of engines and handlers, which last for one update.
    pub(crate) fn clear_overrides(&mut self) {
        self.left_to_engine.clear();
        self.surfaces.clear();
    }

    /// Stores the surface properties that a handler has set for an arbiter, if any.
    #[inline]
    pub(crate) fn set_surface(&mut self, handle: usize, surface: SurfaceOverride) {
        if surface != SurfaceOverride::default() {
            self.surfaces.resize(self.arbiters.len(), SurfaceOverride::default());
            self.surfaces[handle] = surface;
        }
    }

    /// Surface properties that a handler has set for an arbiter in this update.
    #[inline]
    pub(crate) fn surface(&self, handle: u32) -> SurfaceOverride {
        self.surfaces.get(handle as usize).copied().unwrap_or_default()
    }

    #[inline]
    pub(crate) fn is_left_to_engine(&self, handle: u32) -> bool {
        self.left_to_engine.get(handle as usize).is_some_and(|&is_left| is_left)
    }

    /// Indexes the list as it is now, for [`is_listed`](Self::is_listed) and
    /// [`add_arbiter_unless_listed`](Self::add_arbiter_unless_listed).
    pub(crate) fn index_listed(&mut self) {
        self.listed.clear(self.arbiters.len());
        for &handle in &self.list {
            if let Some(pair) = self.arbiters[handle as usize].geoms {
                self.listed.add(handle, pair);
            }
        }
    }

    /// Whether the list has an arbiter of a pair.
    pub(crate) fn is_listed(&self, geom1: GeomId, geom2: GeomId) -> bool {
        self.listed.contains((geom1, geom2)) || self.listed.contains((geom2, geom1))
    }

    /// Whether handles are in range, and every listed arbiter has geoms that exist. False only after loading corrupt
    /// data.
    pub(crate) fn is_valid(&self, geoms: &Geoms) -> bool {
        let in_range = |&handle: &u32| (handle as usize) < self.arbiters.len();
        self.pairs.is_valid()
            && self.list.iter().all(in_range)
            && self.pool.iter().all(in_range)
            && self.list.iter().all(|&handle| {
                self.arbiters[handle as usize]
                    .geoms
                    .is_some_and(|(a, b)| geoms.contains(a) && geoms.contains(b) && a != b)
            })
            && self
                .arbiters
                .iter()
                .all(|arbiter| !arbiter.friction.is_nan() && arbiter.contacts.iter().all(Contact::is_finite))
    }

    /// Enters the pairs of the listed arbiters under the collision ids of the **previous** update, then numbers
    /// the geoms anew. In an update in which geoms moved down in the list, the entries are wrong; the duplicate
    /// and suppressed pairs that follow from it are part of the original's behaviour.
    pub(crate) fn prepare_for_broad_phase_collision(&mut self, geoms: &mut Geoms) {
        self.pairs.clear(geoms.list().len());
        for &handle in &self.list {
            if let Some((a, b)) = self.arbiters[handle as usize].geoms {
                self.pairs.test_and_set(geoms[a].collision_id, geoms[b].collision_id);
            }
        }
        for index in 0..geoms.list().len() {
            let geom = geoms.list()[index];
            geoms[geom].collision_id = index as i32;
        }
    }

    /// Appends an arbiter for a pair, unless the pair is in the table.
    pub(crate) fn add_arbiter_for_geom_pair(
        &mut self,
        geoms: &Geoms,
        friction_type: FrictionType,
        geom1: GeomId,
        geom2: GeomId,
    ) {
        if !self.pairs.test_and_set(geoms[geom1].collision_id, geoms[geom2].collision_id) {
            let handle = self.take_from_pool();
            self.set_up(handle, geoms, friction_type, geom1, geom2);
            self.list.push(handle);
        }
    }

    /// Appends an arbiter for a pair, unless the list has one: the brute force broad phase does this.
    ///
    /// Like the original, it takes an arbiter from the pool and sets it up before it searches; an arbiter that is put
    /// back stays on top of the pool.
    pub(crate) fn add_arbiter_unless_listed(
        &mut self,
        geoms: &Geoms,
        friction_type: FrictionType,
        geom1: GeomId,
        geom2: GeomId,
    ) {
        let handle = self.take_from_pool();
        let before = self.arbiters[handle as usize].geoms;
        let pair = self.set_up(handle, geoms, friction_type, geom1, geom2);
        self.listed.reassign(handle, before, pair);
        if self.listed.contains(pair) {
            self.pool.push(handle);
        } else {
            self.listed.add(handle, pair);
            self.list.push(handle);
        }
    }

    fn take_from_pool(&mut self) -> u32 {
        self.pool.pop().unwrap_or_else(|| {
            self.arbiters.push(Arbiter::fresh());
            self.arbiters.len() as u32 - 1
        })
    }

    /// Sets an arbiter up for a pair and returns its geoms as A and B. Its contacts stay.
    fn set_up(
        &mut self,
        handle: u32,
        geoms: &Geoms,
        friction_type: FrictionType,
        geom1: GeomId,
        geom2: GeomId,
    ) -> (GeomId, GeomId) {
        let (a, b) = if geoms[geom1].number < geoms[geom2].number { (geom1, geom2) } else { (geom2, geom1) };
        let (friction_a, friction_b) =
            (geoms[a].geom.friction_coefficient, geoms[b].geom.friction_coefficient);
        let arbiter = &mut self.arbiters[handle as usize];
        arbiter.geoms = Some((a, b));
        arbiter.friction = mix_friction(friction_type, friction_a, friction_b);
        (a, b)
    }

    /// Removes the arbiters for which `is_leaving` is true, from the last to the first, and calls `left` with each pair
    /// in that order. The arbiters return to the pool with their contacts.
    pub(crate) fn remove_where(
        &mut self,
        mut is_leaving: impl FnMut(&Arbiter) -> bool,
        mut left: impl FnMut(GeomId, GeomId),
    ) {
        let mut leaving = 0;
        for position in (0..self.list.len()).rev() {
            let handle = self.list[position];
            let arbiter = &self.arbiters[handle as usize];
            if is_leaving(arbiter) {
                if let Some((a, b)) = arbiter.geoms {
                    left(a, b);
                }
                self.pool.push(handle);
                self.list[position] = u32::MAX;
                leaving += 1;
            }
        }
        if leaving > 0 {
            self.list.retain(|&handle| handle != u32::MAX);
        }
    }

    /// Removes the arbiters of removed geoms, geom by geom (behaviour chapter 03, section 7.4).
    ///
    /// The original scans the list from its end. Each arbiter found goes to the pool, and the **first equal** one
    /// leaves the list, so that the scan finds the same arbiter again. So of several arbiters of a pair the last one
    /// enters the pool as often as there are arbiters of the pair, and the others are lost, as in the original.
    pub(crate) fn remove_arbiters_of(&mut self, removed: &[GeomId]) {
        let mut turns: Vec<(u64, usize)> = removed.iter().map(|geom| geom.to_bits()).zip(0..).collect();
        sort_by_number(&mut turns, |&(geom, _)| geom.into());
        turns.dedup_by_key(|(geom, _)| *geom);
        let turn_of = |geom: GeomId| {
            let at = turns.binary_search_by_key(&geom.to_bits(), |&(geom, _)| geom).ok()?;
            Some(turns[at].1)
        };
        let turn_of_pair = |(a, b): (GeomId, GeomId)| turn_of(a).into_iter().chain(turn_of(b)).min();
        let mut leaving: Vec<RemovedArbiters> = Vec::new();
        for (found, &handle) in self.list.iter().rev().enumerate() {
            let Some(geoms) = self.arbiters[handle as usize].geoms else { continue };
            let turn = turn_of_pair(geoms);
            leaving.extend(turn.map(|turn| RemovedArbiters {
                geoms,
                geom_order: turn,
                found_order: found,
                handle,
                count: 1,
            }));
        }
        sort_by_number_in(&mut Vec::new(), &mut leaving, |&RemovedArbiters { geoms: (a, b), .. }| {
            u128::from(a.to_bits()) << 64 | u128::from(b.to_bits())
        });
        leaving.dedup_by(|next, first| {
            let is_same = next.geoms == first.geoms;
            first.count += usize::from(is_same);
            is_same
        });
        // Arbiters of one geom leave in the order in which they were found.
        sort_by_number_in(&mut Vec::new(), &mut leaving, |leaving| {
            (leaving.geom_order as u128) << 64 | leaving.found_order as u128
        });
        for RemovedArbiters { handle, count, .. } in leaving {
            self.pool.extend(std::iter::repeat_n(handle, count));
        }
        let arbiters = &self.arbiters;
        let leaves = |&handle: &u32| arbiters[handle as usize].geoms.and_then(turn_of_pair).is_some();
        self.list.retain(|handle| !leaves(handle));
    }
}

/// The arbiters of one pair that leave with a removed geom.
#[derive(Clone)]
struct RemovedArbiters {
    geoms: (GeomId, GeomId),
    /// Index, among the removed geoms, of the earlier of the pair's geoms.
    geom_order: usize,
    /// Number of arbiters that the scan finds before the last one of this pair, and the handle of that one.
    found_order: usize,
    handle: u32,
    /// Number of arbiters of the pair.
    count: usize,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::BodyId;
    use crate::geom::entry::GeomEntry;
    use crate::math::Vector2;
    use crate::storage::arena::Id;

    /// Pseudo-random numbers below a bound.
    struct Numbers(u64);

    impl Numbers {
        fn below(&mut self, bound: usize) -> usize {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 33) as usize % bound
        }
    }

    fn geoms() -> (Geoms, Vec<GeomId>) {
        let body = BodyId::new(0, 0);
        let mut geoms = Geoms::default();
        let ids =
            (0..6).map(|number| geoms.create(GeomEntry::new(number, body, Vector2::zeros(), 0.0))).collect();
        (geoms, ids)
    }

    fn pair(ids: &[GeomId], numbers: &mut Numbers) -> (GeomId, GeomId) {
        let first = numbers.below(ids.len() - 1);
        (ids[first], ids[first + 1 + numbers.below(ids.len() - first - 1)])
    }

    /// A list in which list and pool hold arbiters twice, and some are in both.
    fn shared_list(ids: &[GeomId], numbers: &mut Numbers) -> ArbiterList {
        let mut arbiters = ArbiterList::default();
        arbiters.arbiters.truncate(12);
        for arbiter in &mut arbiters.arbiters {
            arbiter.geoms = Some(pair(ids, numbers));
        }
        arbiters.list = (0..numbers.below(16)).map(|_| numbers.below(12) as u32).collect();
        arbiters.pool = (0..numbers.below(16)).map(|_| numbers.below(12) as u32).collect();
        arbiters
    }

    type Pairs = Vec<Option<(GeomId, GeomId)>>;

    /// The pairs of all arbiters, the list and the pool.
    fn state(list: &ArbiterList) -> (Pairs, Vec<u32>, Vec<u32>) {
        (list.arbiters.iter().map(|arbiter| arbiter.geoms).collect(), list.list.clone(), list.pool.clone())
    }

    /// The brute force broad phase as the behaviour chapter describes it.
    fn add_after_a_search(list: &mut ArbiterList, geoms: &Geoms, pair: (GeomId, GeomId)) {
        let handle = list.take_from_pool();
        list.set_up(handle, geoms, FrictionType::Average, pair.0, pair.1);
        if list.list.iter().any(|&listed| list.arbiters[listed as usize].geoms == Some(pair)) {
            list.pool.push(handle);
        } else {
            list.list.push(handle);
        }
    }

    #[test]
    fn indexed_lookup_equals_linear_search_with_shared_arbiters() {
        let (geoms, ids) = geoms();
        for seed in 0..500 {
            let mut numbers = Numbers(seed);
            let mut list = shared_list(&ids, &mut numbers);
            let mut searched = list.clone();
            list.index_listed();
            for _ in 0..20 {
                let (a, b) = pair(&ids, &mut numbers);
                list.add_arbiter_unless_listed(&geoms, FrictionType::Average, b, a);
                add_after_a_search(&mut searched, &geoms, (a, b));
                assert_eq!(state(&list), state(&searched), "seed {seed}");
            }
        }
    }

    /// Behaviour chapter 03, section 7.4, literally.
    fn remove_by_scans(list: &mut ArbiterList, geom: GeomId) {
        let mut position = list.list.len();
        while position > 0 {
            position -= 1;
            let handle = list.list[position];
            let pair = list.arbiters[handle as usize].geoms;
            if pair.is_some_and(|(a, b)| a == geom || b == geom) {
                list.pool.push(handle);
                let is_equal = |&other: &u32| list.arbiters[other as usize].geoms == pair;
                let first_equal = list.list.iter().position(is_equal).expect("it is equal to itself");
                list.list.remove(first_equal);
            }
        }
    }

    #[test]
    fn batch_removal_equals_one_scan_per_geom() {
        let (_, ids) = geoms();
        for seed in 0..500 {
            let mut numbers = Numbers(seed);
            let mut list = shared_list(&ids, &mut numbers);
            let mut scanned = list.clone();
            let removed: Vec<GeomId> = (0..numbers.below(4)).map(|_| ids[numbers.below(6)]).collect();
            list.remove_arbiters_of(&removed);
            removed.iter().for_each(|&geom| remove_by_scans(&mut scanned, geom));
            assert_eq!(state(&list), state(&scanned), "seed {seed}");
        }
    }
}
