//! Which objects meet: what the 2D engine is told about depth while it looks for pairs.

use farseer_core::shape::Aabb;
use farseer_core::{BodyId, Contact, Context, EventHandler, GeomId, ObjectId};
use serde::{Deserialize, Serialize};

use crate::depth::{Depths, extents_overlap};

/// Pairs of geoms that pass each other: their boxes overlapped on the screen's plane while they were at
/// different depths. They go on passing until the boxes part, also if they come to the same depth meanwhile.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct PassingPairs {
    /// Creation numbers, the smaller one first; sorted.
    known: Vec<(u32, u32)>,
    /// Those of the current update.
    #[serde(skip)]
    current: Vec<(u32, u32)>,
    /// For every pair that was refused in the current update, in order: whether by this engine.
    #[serde(skip)]
    refusals: Vec<bool>,
}

impl PassingPairs {
    fn is_known(&self, pair: (u32, u32)) -> bool {
        self.known.binary_search(&pair).is_ok()
    }

    pub(crate) fn begin(&mut self) {
        self.current.clear();
        self.refusals.clear();
    }

    /// What was found in this update is what the next one knows.
    pub(crate) fn finish(&mut self) {
        self.current.sort_unstable();
        self.current.dedup();
        std::mem::swap(&mut self.known, &mut self.current);
    }

    /// For every refusal of the update, in order: whether it was this engine's and not the game's.
    pub(crate) fn refusals(&self) -> impl Iterator<Item = bool> + '_ {
        self.refusals.iter().copied()
    }

    /// Whether the pairs are sorted, without duplicates: false only after loading garbage.
    pub(crate) fn is_valid(&self) -> bool {
        self.known.iter().all(|(low, high)| low < high) && self.known.windows(2).all(|w| w[0] < w[1])
    }
}

/// Stands between the 2D engine and the game's handler: refuses pairs at different depths, passes everything
/// else on.
pub(crate) struct DepthFilter<'a, 'h> {
    pub(crate) depths: &'a Depths,
    pub(crate) pairs: &'a mut PassingPairs,
    /// Whether an answer replaces the broad phase's own test of the boxes. The others have made theirs, in their
    /// own way: sweep and prune widens the boxes.
    pub(crate) replaces_box_test: bool,
    pub(crate) handler: Option<&'h mut dyn EventHandler>,
}

/// A pair as the filter sees it.
struct Met {
    numbers: (u32, u32),
    boxes_overlap: bool,
    depths_overlap: bool,
}

impl DepthFilter<'_, '_> {
    fn look(&self, context: &Context<'_>, geom1: GeomId, geom2: GeomId) -> Option<Met> {
        let (a, b) = (context.geom(geom1)?, context.geom(geom2)?);
        let extents = (self.depths.extent(geom1, a.body()), self.depths.extent(geom2, b.body()));
        Some(Met {
            numbers: (a.id().min(b.id()), a.id().max(b.id())),
            boxes_overlap: Aabb::intersect(&a.aabb(), &b.aabb()),
            depths_overlap: match extents {
                (Some(a), Some(b)) => extents_overlap(a, b),
                _ => true,
            },
        })
    }

    /// Whether two geoms may meet; notes those that pass each other.
    fn may_meet(&mut self, met: &Met) -> bool {
        let passes = self.pairs.is_known(met.numbers) || !met.depths_overlap;
        if passes && met.boxes_overlap {
            self.pairs.current.push(met.numbers);
        }
        !passes
    }
}

impl EventHandler for DepthFilter<'_, '_> {
    fn handles_broad_phase(&self) -> bool {
        true
    }

    fn on_broad_phase_collision(&mut self, context: &mut Context<'_>, geom1: GeomId, geom2: GeomId) -> bool {
        let met = self.look(context, geom1, geom2).filter(|met| self.may_meet(met));
        let Some(met) = met else {
            self.pairs.refusals.push(true);
            return false;
        };
        let handler = self.handler.as_mut().filter(|handler| handler.handles_broad_phase());
        let is_asked = handler.is_some();
        let accepted = match handler {
            // The game's answer replaces the test of the boxes, as without depth.
            Some(handler) => handler.on_broad_phase_collision(context, geom1, geom2),
            None => met.boxes_overlap || !self.replaces_box_test,
        };
        if !accepted {
            self.pairs.refusals.push(!is_asked);
        }
        accepted
    }

    fn on_collision(
        &mut self,
        context: &mut Context<'_>,
        this: GeomId,
        other: GeomId,
        contacts: &mut Vec<Contact>,
    ) -> bool {
        let met = self.look(context, this, other);
        if !met.is_none_or(|met| self.may_meet(&met)) {
            self.pairs.refusals.push(true);
            return false;
        }
        let accepted = match &mut self.handler {
            Some(handler) => handler.on_collision(context, this, other, contacts),
            None => true,
        };
        if !accepted {
            self.pairs.refusals.push(false);
        }
        accepted
    }

    fn on_separation(&mut self, context: &mut Context<'_>, this: GeomId, other: GeomId) {
        if let Some(handler) = &mut self.handler {
            handler.on_separation(context, this, other);
        }
    }

    fn on_body_updated(&mut self, context: &mut Context<'_>, body: BodyId) {
        if let Some(handler) = &mut self.handler {
            handler.on_body_updated(context, body);
        }
    }

    fn on_body_disposed(&mut self, context: &mut Context<'_>, body: BodyId) {
        if let Some(handler) = &mut self.handler {
            handler.on_body_disposed(context, body);
        }
    }

    fn on_added(&mut self, object: ObjectId) {
        if let Some(handler) = &mut self.handler {
            handler.on_added(object);
        }
    }

    fn on_removed(&mut self, object: ObjectId) {
        if let Some(handler) = &mut self.handler {
            handler.on_removed(object);
        }
    }
}
