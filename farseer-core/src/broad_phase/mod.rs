//! Broad phases of the faithful set: the search for pairs of geoms whose AABBs overlap (behaviour chapter 08).
//!
//! The order in which pairs are found is the order of the arbiter list, and so the order in which impulses act.

mod brute_force;
mod dotnet_dictionary;
mod dotnet_introsort;
mod endpoint;
mod sap_overlaps;
mod selective_sweep;
mod spatial_hash;
mod sweep_and_prune;

pub use selective_sweep::{SelectiveSweepOrder, SweepEnd};

use serde::{Deserialize, Serialize};

use crate::geom::GeomId;
use crate::geom::entry::Geoms;
use crate::geom::filter::Filter;
use crate::methods::BroadPhaseCollider;
use selective_sweep::SelectiveSweep;
use spatial_hash::SpatialHash;
use sweep_and_prune::SweepAndPrune;

/// The simulator as a broad phase sees it during the search for pairs.
pub(crate) trait PairCallback {
    /// Whether a handler answers [`approve`](Self::approve). With some methods the answer replaces the box test.
    fn has_approval(&self) -> bool;
    /// Asks the user's handler whether the pair may collide.
    fn approve(&mut self, geom1: GeomId, geom2: GeomId) -> bool;
    /// Geoms, bodies and filters in their present state: the handler may have changed them since the last call.
    fn filter(&self) -> Filter<'_>;
    /// The geoms that take part. No handler changes the list.
    fn geom_list(&self) -> &[GeomId];
    /// Adds a pair whose boxes overlap.
    fn register(&mut self, geom1: GeomId, geom2: GeomId);
    /// Indexes the pairs of the arbiter list, for [`register_unless_listed`](Self::register_unless_listed).
    fn index_listed(&mut self);
    /// Adds a pair found by the brute force method, unless the arbiter list has it.
    fn register_unless_listed(&mut self, geom1: GeomId, geom2: GeomId);
}

/// The chosen broad phase with its state.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) enum BroadPhase {
    SelectiveSweep(SelectiveSweep),
    SweepAndPrune(SweepAndPrune),
    BruteForce,
    SpatialHash(SpatialHash),
    /// Placeholder during the search, while the method's state is moved out and handlers have the simulator.
    AtWork,
}

/// `clone_from` reuses the capacity of the default method's lists. The other methods keep trees of small lists, which
/// are cloned anew.
impl Clone for BroadPhase {
    fn clone(&self) -> Self {
        match self {
            BroadPhase::SelectiveSweep(state) => BroadPhase::SelectiveSweep(state.clone()),
            BroadPhase::SweepAndPrune(state) => BroadPhase::SweepAndPrune(state.clone()),
            BroadPhase::BruteForce => BroadPhase::BruteForce,
            BroadPhase::SpatialHash(state) => BroadPhase::SpatialHash(state.clone()),
            BroadPhase::AtWork => BroadPhase::AtWork,
        }
    }

    fn clone_from(&mut self, source: &Self) {
        match (self, source) {
            (BroadPhase::SelectiveSweep(state), BroadPhase::SelectiveSweep(source)) => {
                state.clone_from(source)
            }
            (state, source) => *state = source.clone(),
        }
    }
}

impl Default for BroadPhase {
    fn default() -> Self {
        BroadPhase::new(BroadPhaseCollider::default())
    }
}

impl BroadPhase {
    pub(crate) fn new(method: BroadPhaseCollider) -> Self {
        match method {
            BroadPhaseCollider::SelectiveSweep => BroadPhase::SelectiveSweep(SelectiveSweep::default()),
            BroadPhaseCollider::SweepAndPrune => BroadPhase::SweepAndPrune(SweepAndPrune::default()),
            BroadPhaseCollider::BruteForce => BroadPhase::BruteForce,
            BroadPhaseCollider::SpatialHash { .. } => BroadPhase::SpatialHash(SpatialHash::default()),
        }
    }

    fn is_of(&self, method: BroadPhaseCollider) -> bool {
        matches!(
            (self, method),
            (BroadPhase::SelectiveSweep(_), BroadPhaseCollider::SelectiveSweep)
                | (BroadPhase::SweepAndPrune(_), BroadPhaseCollider::SweepAndPrune)
                | (BroadPhase::BruteForce, BroadPhaseCollider::BruteForce)
                | (BroadPhase::SpatialHash(_), BroadPhaseCollider::SpatialHash { .. })
        )
    }

    /// A geom entered the geom list.
    pub(crate) fn add(&mut self, id: GeomId, geoms: &Geoms) {
        match self {
            BroadPhase::SelectiveSweep(sweep) => sweep.add(id),
            BroadPhase::SweepAndPrune(sweep) => sweep.add(id, geoms),
            BroadPhase::BruteForce | BroadPhase::SpatialHash(_) | BroadPhase::AtWork => {}
        }
    }

    /// Geoms left the geom list: removes those that are not alive.
    pub(crate) fn retain(&mut self, is_alive: impl Fn(GeomId) -> bool, geoms: &Geoms) {
        match self {
            BroadPhase::SelectiveSweep(sweep) => sweep.retain(is_alive),
            BroadPhase::SweepAndPrune(sweep) => sweep.retain(is_alive, geoms),
            BroadPhase::BruteForce | BroadPhase::SpatialHash(_) | BroadPhase::AtWork => {}
        }
    }

    /// Starts the method anew if the state is not its own: in a simulator that a handler copied or saved during the
    /// search.
    pub(crate) fn restore(&mut self, method: BroadPhaseCollider, geoms: &Geoms) {
        if !self.is_of(method) {
            *self = BroadPhase::new(method);
            geoms.list().iter().for_each(|&geom| self.add(geom, geoms));
        }
    }

    /// Searches for pairs and hands them to `sink`. The spatial hash may adjust its cell size.
    pub(crate) fn update(&mut self, method: &mut BroadPhaseCollider, sink: &mut impl PairCallback) {
        match (self, method) {
            (BroadPhase::SelectiveSweep(sweep), _) => sweep.update(sink),
            (BroadPhase::SweepAndPrune(sweep), _) => sweep.update(sink),
            (BroadPhase::BruteForce, _) => brute_force::update(sink),
            (
                BroadPhase::SpatialHash(hash),
                BroadPhaseCollider::SpatialHash { cell_size, auto_adjust_cell_size },
            ) => hash.update(cell_size, *auto_adjust_cell_size, sink),
            (BroadPhase::SpatialHash(_) | BroadPhase::AtWork, _) => {}
        }
    }

    /// Whether the state is that of `method`, all geoms exist and all indices are in range. False only after loading
    /// corrupt data.
    pub(crate) fn is_valid(&self, method: BroadPhaseCollider, geoms: &Geoms) -> bool {
        match self {
            BroadPhase::AtWork => true,
            _ if !self.is_of(method) => false,
            BroadPhase::SelectiveSweep(sweep) => sweep.is_valid(geoms),
            BroadPhase::SweepAndPrune(sweep) => sweep.is_valid(geoms),
            BroadPhase::BruteForce => true,
            BroadPhase::SpatialHash(hash) => hash.is_valid(),
        }
    }
}
