//! The chosen methods and their state.

pub(crate) mod forces;
pub(crate) mod joint_passes;
pub(crate) mod positions;

use serde::{Deserialize, Serialize};

use crate::contacts::contact::Contact;
use crate::geom::GeomId;
use crate::pairs::BroadPhase;
use crate::precise::Precise;
use crate::solve::{ContactSolver, SolverBodies};
use crate::storage::reusing_clone::reusing_clone;
use joint_passes::JointPasses;

/// What the stages of an update keep, for themselves and for each other.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(crate) struct Pipeline {
    pub(crate) broad_phase: BroadPhase,
    /// Of the precise set, while it is chosen; everything else here is the faithful one's.
    pub(crate) precise: Option<Box<Precise>>,
    /// The velocities of an update while it solves.
    #[serde(skip)]
    pub(crate) bodies: SolverBodies,
    #[serde(skip)]
    pub(crate) contacts: ContactSolver,
    #[serde(skip)]
    pub(crate) joints: JointPasses,
    /// Empty between stages.
    #[serde(skip)]
    pub(crate) new_contacts: Vec<Contact>,
    #[serde(skip)]
    pub(crate) separated: Vec<(GeomId, GeomId)>,
}

reusing_clone! { Pipeline { broad_phase, precise, bodies, contacts, joints, new_contacts, separated } }
