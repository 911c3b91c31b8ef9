//! Which pairs of geoms may touch: the broad phases (behaviour chapter 08).
//!
//! The order in which pairs are found is the order of the arbiter list, and so the order in which impulses act.

mod brute_force;
mod endpoint;
mod overlaps;
mod selective_sweep;
mod slot_table;
mod sort;
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

/// What a broad phase sees of the simulator while it looks for pairs.
pub(crate) trait PairSink {
    /// Whether somebody answers [`approve`](Self::approve); with some methods the answer replaces the box test.
    fn has_approval(&self) -> bool;
    /// Asks the user's handler whether the pair may collide.
    fn approve(&mut self, geom1: GeomId, geom2: GeomId) -> bool;
    /// The scene as it is now: the handler may have changed it.
    fn filter(&self) -> Filter<'_>;
    /// The geoms that take part. No handler changes the list.
    fn geom_list(&self) -> &[GeomId];
    /// Takes a pair whose boxes overlap.
    fn register(&mut self, geom1: GeomId, geom2: GeomId);
    /// Notes which pairs the arbiter list has, for [`register_unless_listed`](Self::register_unless_listed).
    fn index_listed(&mut self);
    /// Takes a pair found by the brute force method, which looks through the arbiter list itself.
    fn register_unless_listed(&mut self, geom1: GeomId, geom2: GeomId);
}

/// The state of the chosen method.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) enum BroadPhase {
    SelectiveSweep(SelectiveSweep),
    SweepAndPrune(SweepAndPrune),
    BruteForce,
    SpatialHash(SpatialHash),
    /// Stands for a method while it looks for pairs and handlers look at the simulator.
    AtWork,
}

/// `clone_from` keeps the room that lists of the default method have. What the others keep is a tree of small lists.
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

    /// Geoms left the geom list: those that are not alive go.
    pub(crate) fn retain(&mut self, is_alive: impl Fn(GeomId) -> bool, geoms: &Geoms) {
        match self {
            BroadPhase::SelectiveSweep(sweep) => sweep.retain(is_alive),
            BroadPhase::SweepAndPrune(sweep) => sweep.retain(is_alive, geoms),
            BroadPhase::BruteForce | BroadPhase::SpatialHash(_) | BroadPhase::AtWork => {}
        }
    }

    /// Begins anew in a simulator that a handler copied or saved while its method was at work.
    pub(crate) fn restore(&mut self, method: BroadPhaseCollider, geoms: &Geoms) {
        if !self.is_of(method) {
            *self = BroadPhase::new(method);
            geoms.list().iter().for_each(|&geom| self.add(geom, geoms));
        }
    }

    /// Looks for pairs and hands them to the sink. The spatial hash may adjust its cells.
    pub(crate) fn update(&mut self, method: &mut BroadPhaseCollider, sink: &mut impl PairSink) {
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

    /// Whether it is the method's state, all geoms exist and all indices are in range: false only after loading garbage.
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
