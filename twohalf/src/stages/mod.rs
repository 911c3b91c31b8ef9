//! What an update does, stage by stage. A stage takes the parts that it needs, never the simulator; `faithful.rs` and `precise.rs`
//! say in which order they come.

mod ask;
mod collisions;
mod crush;
mod exchange;
mod faithful;
mod fields;
mod forces;
mod motion;
mod outlines;
mod pace;
mod pairs;
mod plane_handler;
mod precise;
mod reach;
mod report;
mod solver;
mod supports;
mod tell;
mod touch;

pub(crate) use exchange::list_loaded;
pub(crate) use fields::immersion_of;
pub(crate) use report::Report;
pub use report::StepCounters;

use farseer_core::{GeomId, PhysicsSimulator};

use crate::depth::{DepthScheme, TouchList, World};
use crate::events::EventHandler;
use plane_handler::Meeting;
use solver::SpaceSolver;

/// What updates work with: room that is kept, and what is derived. Nothing that an update decides depends on what the one before
/// has left here.
#[derive(Debug, Clone, Default)]
pub(crate) struct Pipeline {
    meeting: Meeting,
    /// The contacts that are being looked for; those of the last update are in the world until these are complete.
    found: TouchList,
    solver: SpaceSolver,
    seams: Vec<touch::BallContact>,
    supports: Vec<supports::Held>,
    immersion: fields::Scratch,
    /// Bodies that are in an update as others see them.
    slowed: Vec<pace::Own>,
}

impl Pipeline {
    /// The outline of a geom has become another one.
    pub(crate) fn forget_outline(&mut self, geom: GeomId) {
        self.meeting.outlines.forget(geom);
    }
}

/// The parts of a simulator.
pub(crate) struct Parts<'a> {
    pub(crate) core: &'a mut PhysicsSimulator,
    pub(crate) world: &'a mut World,
    pub(crate) pipeline: &'a mut Pipeline,
    pub(crate) report: &'a mut Report,
}

/// Moves everything by `dt` seconds.
pub(crate) fn update(parts: Parts<'_>, dt: f32, handler: Option<&mut dyn EventHandler>) {
    match parts.world.scheme {
        DepthScheme::Precise => precise::update(parts, dt, handler),
        DepthScheme::Faithful | DepthScheme::Thesis => faithful::update(parts, dt, handler),
    }
}
