//! How deep something has been pressed into what it touches: so deep it is in the next one, too, that is flush with that.

use super::{Touch, Two};
use crate::precise::Precise;
use crate::precise::pairs::Pair;
use crate::precise::proxies::Mobility;

impl Touch<'_> {
    /// Penetration, in length units, of the second one of a pair in what it touches, or in what it parted from last; the greatest
    /// that counts if the first one can be pushed, too: it is pressed into what it lies on, by whatever lies on it. 0 if one of
    /// the two is a ball, or the ground, which has no edges.
    pub(super) fn sunk_before(&self, pair: usize, two: Two<'_>) -> f32 {
        let state = &self.pairs.all[pair];
        if !state.kind.has_two_points || state.is_on_ground {
            return 0.0;
        }
        if two.a.mobility == Mobility::Dynamic { f32::MAX } else { self.sunk(two.b.body as usize) }
    }

    fn sunk(&self, body: usize) -> f32 {
        let id = self.bodies.ids[body];
        let before = self.space.zip(id).map_or(0.0, |(space, id)| space.body(id).sunk);
        let depths = self.pairs.of_body(self.proxies, body).map(|pair| self.depth(pair));
        depths.fold(before, |deepest, depth| if depth > deepest { depth } else { deepest })
    }

    /// How deep the two of a pair are in each other that push each other.
    fn depth(&self, pair: usize) -> f32 {
        let frozen = &self.pairs.frozen[pair];
        if self.pairs.all[pair].home.is_none() {
            return 0.0;
        }
        let separations = self.separations_now(frozen, self.two(pair));
        let points = &separations[..frozen.count as usize];
        points.iter().fold(0.0, |deepest, apart| if -apart > deepest { -apart } else { deepest })
    }

    /// The two are about to part.
    pub(in crate::precise) fn note_parting(&mut self, pair: usize) {
        let Pair { kind, home, .. } = self.pairs.all[pair];
        let two = self.two(pair);
        if self.space.is_none() || home.is_none() || !kind.has_two_points || two.a.mobility.gives_way() {
            return;
        }
        if let Some(body) = self.bodies.ids[two.b.body as usize] {
            self.parted.push((body, self.depth(pair).min(f32::MAX)));
        }
    }
}

impl Precise {
    /// A body that has parted from one that does not give way remembers how deep it was in that: it may come back to the same
    /// face. A body that sleeps has not moved: it keeps what it remembers, and the game is told of none that sleeps.
    pub(in crate::precise) fn remember_sunk(&mut self) {
        let mut parted = std::mem::take(&mut self.parted);
        parted.retain(|&(body, _)| self.number_of(body).is_some_and(|number| !self.sleep.is_asleep(number)));
        if let Some(space) = &mut self.space {
            parted.iter().for_each(|&(body, _)| space.body_mut(body).sunk = 0.0);
            for &(body, depth) in &parted {
                let told = space.body_mut(body);
                told.sunk = told.sunk.max(depth);
            }
        }
        parted.clear();
        self.parted = parted;
    }
}
