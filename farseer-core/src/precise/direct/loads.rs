//! Islands in which something heavy presses on something light: in the plane, too, they are solved as a whole, whatever moves.
//!
//! In a pass a row changes its impulse by what the lighter side weighs. What is heavy needs as many passes to be stopped as it is
//! times as heavy, and as many to be let go again. Until then it sinks in, and then all that has stopped it throws it back: out of
//! a jam faster than it came.
//!
//! Without rings of contacts a solution is cheap, and pays as soon as something bears more than its own weight: stacks under
//! what jumps on them. Rings that move are dear, and heaps lie well by passes: there only what is far heavier counts.

use super::Census;
use super::constraint::{Ends, FIXED};
use super::depth::is_burden;
use super::island::Island;
use crate::precise::Precise;
use crate::precise::parameters::direct::{
    CYCLIC_DEPTH_ISLAND_BODIES, HEAVY_MASS_RATIO, JAMMING_MASS_RATIO, LOADED_TOWER_BODIES,
};
use crate::precise::rows::Lane;

/// Whether one of two with these reciprocals of masses is more than so many times as heavy as the other; both can be pushed.
#[inline(always)]
pub(super) fn differ([a, b]: [f32; 2], times: f32) -> bool {
    let (heavy, light) = if a < b { (a, b) } else { (b, a) };
    heavy > 0.0 && light > times * heavy
}

impl Census {
    /// In the plane: it is solved as a whole because of what it bears.
    pub(super) fn is_loaded(&self) -> bool {
        let has_rings = self.has_rings();
        let is_small = !has_rings || self.bodies <= CYCLIC_DEPTH_ISLAND_BODIES;
        (self.is_burdened && !has_rings && self.bodies >= LOADED_TOWER_BODIES) || (self.is_jammed && is_small)
    }
}

impl Island {
    /// Whether two in it are of such different masses that they may jam.
    pub(super) fn may_jam(&self, ends: &[Ends]) -> bool {
        ends.iter().filter(|ends| !ends.bodies.contains(&FIXED)).any(|ends| {
            differ(ends.bodies.map(|at| (1.0 / self.members[at as usize].mass) as f32), JAMMING_MASS_RATIO)
        })
    }
}

impl Precise {
    /// Whether something heavy lies on something light by a row, and whether what is far heavier presses on that from anywhere. In
    /// the plane what is light must have other rows: two that meet in the air do well by passes.
    pub(super) fn load(&self, lane: &Lane) -> [bool; 2] {
        let [a, b] = lane.inverse_masses;
        if self.space.is_some() {
            return [is_burden([a, b], lane.normal, self.fall), false];
        }
        let light = if a < b { lane.b } else { lane.a };
        let is_heavy = differ([a, b], self.least_burden()) && !self.palette.is_single(light as usize);
        [
            is_heavy && is_burden([a, b], lane.normal, self.fall),
            is_heavy && differ([a, b], JAMMING_MASS_RATIO),
        ]
    }

    /// What is so many times as heavy is a burden. In a great heap of things of all sizes islands that bear some come and go in every
    /// update, and asking for them takes half as long as the rest of it: there only what may jam counts.
    pub(super) fn least_burden(&self) -> f32 {
        if self.space.is_some() || self.is_few() { HEAVY_MASS_RATIO } else { JAMMING_MASS_RATIO }
    }

    /// Whether there is a load that is not borne as a whole.
    pub(super) fn has_load(&self) -> bool {
        self.has_unlike()
            && (0..self.pairs.awake).any(|pair| {
                let state = &self.pairs.all[pair];
                let differs = || {
                    let inverse_masses = self.sides(pair).map(|(body, _)| self.bodies.inverses[body][0]);
                    differ(inverse_masses, HEAVY_MASS_RATIO)
                };
                let home = state.home.filter(|home| !home.is_direct() && differs());
                home.is_some_and(|home| self.load(&self.rows.lane(state.kind, home)).contains(&true))
            })
    }

    /// Whether there may be bodies of such different masses that one is a load to another.
    fn has_unlike(&self) -> bool {
        let (mut least, mut most) = (f32::MAX, 0.0);
        for run in &self.sleep.bodies {
            for &[inverse, _] in &self.bodies.inverses[run.clone()] {
                least = if inverse > 0.0 && inverse < least { inverse } else { least };
                most = if inverse > most { inverse } else { most };
            }
        }
        differ([least, most], HEAVY_MASS_RATIO)
    }
}
