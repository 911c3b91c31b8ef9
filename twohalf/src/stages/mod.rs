//! Stages of an update. A stage is a function over the parts that it needs, never over the simulator;
//! `faithful.rs` and `precise.rs` have their order.

mod callbacks;
mod collisions;
mod contact_filter;
mod convex_cache;
mod core_events;
mod core_sync;
mod crush;
mod depth_intervals;
mod faithful;
mod fields;
mod forces;
mod motion;
mod narrow_phase;
mod pairs;
mod precise;
mod report;
mod solver;
mod supports;
mod time_scale;

pub(crate) use core_sync::list_loaded;
pub(crate) use fields::immersion_of;
pub(crate) use report::Report;
pub use report::StepCounters;

use farseer_core::{GeomId, PhysicsSimulator};

use crate::depth::{ContactList, DepthScheme, World};
use crate::events::EventHandler;
use core_events::PairContext;
use solver::Solver3;

/// Buffers of an update and derived data. The result of an update does not depend on their content.
#[derive(Debug, Clone, Default)]
pub(crate) struct Pipeline {
    pair_context: PairContext,
    /// Contacts of the current update. The contacts of the last update stay in `World::touches` until this list is complete.
    found: ContactList,
    solver: Solver3,
    seams: Vec<narrow_phase::BallContact>,
    supports: Vec<supports::SupportCandidate>,
    immersion: fields::ClipBuffer,
    /// Bodies whose time scale is applied during the update.
    slowed: Vec<time_scale::UnscaledState>,
}

impl Pipeline {
    /// Drops the cached pieces of a geom whose outline has changed.
    pub(crate) fn forget_outline(&mut self, geom: GeomId) {
        self.pair_context.convex_cache.forget(geom);
    }
}

/// Mutable references to the parts of a simulator that an update needs.
pub(crate) struct Parts<'a> {
    pub(crate) core: &'a mut PhysicsSimulator,
    pub(crate) world: &'a mut World,
    pub(crate) pipeline: &'a mut Pipeline,
    pub(crate) report: &'a mut Report,
}

/// Advances the simulation by `dt` seconds.
pub(crate) fn update(parts: Parts<'_>, dt: f32, handler: Option<&mut dyn EventHandler>) {
    match parts.world.scheme {
        DepthScheme::Precise => precise::update(parts, dt, handler),
        DepthScheme::Faithful | DepthScheme::Thesis => faithful::update(parts, dt, handler),
    }
}
