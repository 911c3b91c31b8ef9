//! Surfaces that the character controller finds by its own queries, as floor or wall, and for which the solver has no contact.
//! The next update asks the event handler about each of them, as it asks about contacts.

use farseer_core::GeomId;
use serde::{Deserialize, Serialize};

use super::contact_target::ContactTarget;
use crate::Vector3;

/// A floor or wall that the character controller has found by a query, without a contact in the solver.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Footing {
    /// The object geom of the character.
    pub(crate) this: GeomId,
    pub(crate) partner: ContactTarget,
    /// Unit vector towards the character, Y up.
    pub(crate) normal: Vector3,
    /// Position of the point of contact, px, Y up.
    pub(crate) position: Vector3,
}

/// Queue between [`walk`](crate::TwoHalfPhysicsSimulator::walk) and the updates that ask an event handler.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct Footings {
    /// Supports and walls about which the next update asks the event handler.
    pub(crate) asked: Vec<Footing>,
    /// Sorted pairs that the handler has refused in the last update that asked.
    pub(crate) refused: Vec<(GeomId, ContactTarget)>,
}

impl Footings {
    /// Queues a question for the next update, once for each run of equal targets, so that a crowd costs no
    /// more than its characters.
    pub(crate) fn queue(&mut self, footing: Footing) {
        let mut of_this = self.asked.iter().rev().take_while(|other| other.this == footing.this);
        if !of_this.any(|other| other.partner == footing.partner) {
            self.asked.push(footing);
        }
    }

    /// Iterates over the targets that the event handler has refused to the character with this object geom.
    pub(crate) fn refused_to(&self, this: GeomId) -> impl Iterator<Item = ContactTarget> + '_ {
        let first = self.refused.partition_point(|&(other, _)| other < this);
        let of_this = self.refused[first..].iter().take_while(move |&&(other, _)| other == this);
        of_this.map(|&(_, partner)| partner)
    }

    /// Clears the queue in an update without a handler, which refuses nothing.
    pub(crate) fn skip(&mut self) {
        self.asked.clear();
        self.refused.clear();
    }

    /// Returns whether all numbers are finite and the pairs are sorted: false only for a damaged save.
    pub(crate) fn is_valid(&self) -> bool {
        let is_finite = |vector: &Vector3| vector.iter().all(|number| number.is_finite());
        let is_sorted = self.refused.is_sorted();
        is_sorted
            && self.asked.iter().all(|footing| is_finite(&footing.normal) && is_finite(&footing.position))
    }
}
