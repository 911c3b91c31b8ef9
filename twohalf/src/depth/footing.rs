//! Supports and walls of walking figures that have no contact; handlers are asked about them.

use farseer_core::GeomId;
use serde::{Deserialize, Serialize};

use super::partner::Partner;
use crate::Vector3;

/// A support or wall of a figure without a contact.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Footing {
    /// The figure.
    pub(crate) this: GeomId,
    pub(crate) partner: Partner,
    /// Unit vector towards the figure, Y up.
    pub(crate) normal: Vector3,
    /// Where it would touch, px, Y up.
    pub(crate) position: Vector3,
}

/// Between [`walk`](crate::TwoHalfPhysicsSimulator::walk) and the updates that ask a handler.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct Footings {
    /// The next update asks about these.
    pub(crate) asked: Vec<Footing>,
    /// A handler has refused these in the last update that asked, in the order of geoms and partners.
    pub(crate) refused: Vec<(GeomId, Partner)>,
}

impl Footings {
    /// Lets the next update ask, once for each partner in a row: a crowd costs no more than its figures do.
    pub(crate) fn ask(&mut self, footing: Footing) {
        let mut of_this = self.asked.iter().rev().take_while(|other| other.this == footing.this);
        if !of_this.any(|other| other.partner == footing.partner) {
            self.asked.push(footing);
        }
    }

    /// The partners that a handler has refused to a figure.
    pub(crate) fn refused_to(&self, this: GeomId) -> impl Iterator<Item = Partner> + '_ {
        let first = self.refused.partition_point(|&(other, _)| other < this);
        let of_this = self.refused[first..].iter().take_while(move |&&(other, _)| other == this);
        of_this.map(|&(_, partner)| partner)
    }

    /// An update without a handler refuses nothing.
    pub(crate) fn pass(&mut self) {
        self.asked.clear();
        self.refused.clear();
    }

    /// Whether everything that enters arithmetic is finite: false only after loading garbage.
    pub(crate) fn is_valid(&self) -> bool {
        let is_finite = |vector: &Vector3| vector.iter().all(|number| number.is_finite());
        let is_sorted = self.refused.is_sorted();
        is_sorted
            && self.asked.iter().all(|footing| is_finite(&footing.normal) && is_finite(&footing.position))
    }
}
