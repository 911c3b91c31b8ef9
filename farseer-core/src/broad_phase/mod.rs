//! Which pairs of geoms may touch: the broad phases (behaviour chapter 08).
//!
//! The order in which pairs are found is the order of the arbiter list, and so the order in which impulses act.

mod brute_force;
mod endpoint;
mod selective_sweep;
mod slot_table;
mod sort;
mod spatial_hash;
mod sweep_and_prune;

pub use selective_sweep::{SelectiveSweepOrder, SweepEnd};

use serde::{Deserialize, Serialize};

use crate::arena::Arena;
use crate::geom::GeomId;
use crate::geom_entry::GeomEntry;
use crate::methods::BroadPhaseCollider;
use crate::pair_filter::Scene;
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
    fn scene(&self) -> Scene<'_>;
    /// Takes a pair whose boxes overlap.
    fn register(&mut self, geom1: GeomId, geom2: GeomId);
    /// Takes a pair found by the brute force method, which looks through the arbiter list itself.
    fn register_unless_listed(&mut self, geom1: GeomId, geom2: GeomId);
}

/// The state of the chosen method.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) enum BroadPhase {
    SelectiveSweep(SelectiveSweep),
    SweepAndPrune(SweepAndPrune),
    BruteForce,
    SpatialHash(SpatialHash),
}

impl BroadPhase {
    pub(crate) fn new(method: BroadPhaseCollider) -> Self {
        match method {
            BroadPhaseCollider::SelectiveSweep => BroadPhase::SelectiveSweep(SelectiveSweep::default()),
            BroadPhaseCollider::SweepAndPrune => BroadPhase::SweepAndPrune(SweepAndPrune::default()),
            BroadPhaseCollider::BruteForce => BroadPhase::BruteForce,
            BroadPhaseCollider::SpatialHash { cell_size, auto_adjust_cell_size } => {
                BroadPhase::SpatialHash(SpatialHash::new(cell_size, auto_adjust_cell_size))
            }
        }
    }

    pub(crate) fn method(&self) -> BroadPhaseCollider {
        match self {
            BroadPhase::SelectiveSweep(_) => BroadPhaseCollider::SelectiveSweep,
            BroadPhase::SweepAndPrune(_) => BroadPhaseCollider::SweepAndPrune,
            BroadPhase::BruteForce => BroadPhaseCollider::BruteForce,
            BroadPhase::SpatialHash(hash) => hash.method(),
        }
    }

    /// A geom entered the geom list.
    pub(crate) fn add(&mut self, id: GeomId, geoms: &Arena<GeomEntry>) {
        match self {
            BroadPhase::SelectiveSweep(sweep) => sweep.add(id),
            BroadPhase::SweepAndPrune(sweep) => sweep.add(id, geoms),
            BroadPhase::BruteForce | BroadPhase::SpatialHash(_) => {}
        }
    }

    /// Geoms left the geom list: those that are not `alive` go.
    pub(crate) fn retain(&mut self, alive: impl Fn(&GeomEntry) -> bool, geoms: &Arena<GeomEntry>) {
        let alive = |id: GeomId| geoms.get(id).is_some_and(&alive);
        match self {
            BroadPhase::SelectiveSweep(sweep) => sweep.retain(alive),
            BroadPhase::SweepAndPrune(sweep) => sweep.retain(alive),
            BroadPhase::BruteForce | BroadPhase::SpatialHash(_) => {}
        }
    }

    /// Looks for pairs and hands them to the sink.
    pub(crate) fn update(&mut self, geom_list: &[GeomId], sink: &mut impl PairSink) {
        match self {
            BroadPhase::SelectiveSweep(sweep) => sweep.update(sink),
            BroadPhase::SweepAndPrune(sweep) => sweep.update(sink),
            BroadPhase::BruteForce => brute_force::update(geom_list, sink),
            BroadPhase::SpatialHash(hash) => hash.update(geom_list, sink),
        }
    }

    /// Whether all geoms exist and all indices are in range: false only after loading garbage.
    pub(crate) fn is_valid(&self, geoms: &Arena<GeomEntry>) -> bool {
        match self {
            BroadPhase::SelectiveSweep(sweep) => sweep.is_valid(geoms),
            BroadPhase::SweepAndPrune(sweep) => sweep.is_valid(geoms),
            BroadPhase::BruteForce => true,
            BroadPhase::SpatialHash(hash) => hash.is_valid(),
        }
    }
}
