//! The chosen methods and their state.

pub(crate) mod integrate_positions;
pub(crate) mod integrate_velocities;
pub(crate) mod joint_solver;

use serde::{Deserialize, Serialize};

use crate::broad_phase::BroadPhase;
use crate::contact_solver::{ContactSolver, SolverBodies};
use crate::contacts::contact::Contact;
use crate::geom::GeomId;
use crate::precise::Precise;
use farseer_precise::reusing_clone;
use joint_solver::SequentialJointSolver;

/// State that the stages of an update keep, for themselves and for each other.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(crate) struct Pipeline {
    pub(crate) broad_phase: BroadPhase,
    /// State of the precise set, while it is chosen. All other fields belong to the faithful set.
    pub(crate) precise: Option<Box<Precise>>,
    /// The velocities of an update during the iterations.
    #[serde(skip)]
    pub(crate) bodies: SolverBodies,
    #[serde(skip)]
    pub(crate) contacts: ContactSolver,
    #[serde(skip)]
    pub(crate) joints: SequentialJointSolver,
    /// Contacts of the pair in work; empty between stages.
    #[serde(skip)]
    pub(crate) new_contacts: Vec<Contact>,
    #[serde(skip)]
    pub(crate) separated: Vec<(GeomId, GeomId)>,
}

reusing_clone! { Pipeline { broad_phase, precise, bodies, contacts, joints, new_contacts, separated } }
