//! Mass ratios in solver selection: in which islands a heavy body presses on light ones.
//!
//! In an iteration of the iterative solver a row changes its impulse by about the mass of the lighter body. So the number of
//! iterations that stop a heavy body is about the mass ratio. Until then the body penetrates. As many iterations pass until the
//! accumulated impulses are gone again: they throw the body out of a jam faster than it came.
//!
//! | island in 2D | goes to the direct solver |
//! |---|---|
//! | no contact cycles, 3 or more bodies | if a body carries one of more than 1.5 times its mass |
//! | no contact cycles, or up to 24 bodies while at most 64 bodies are awake | if a body of more than 16 times the mass presses from anywhere |
//!
//! A direct solution without contact cycles is cheap. Moving cycles are expensive, and heaps rest well in the iterative solver. In a
//! large heap of mixed masses, solutions for jammed cycles took more than half of an update, and threw bodies: of 86 random scenes, one
//! exploded and one more had overlaps.

use super::constraint::{BodyIndices, FIXED};
use super::island_newton::IslandSystem;
use super::island_stats::IslandStats;
use super::load::{exceeds_mass_ratio, is_heavy_on_light};
use super::selection::SolverSelection;
use crate::constraint_graph::ContactConstraint;
use crate::index::BodyIndex;
use crate::parameters::direct::{
    CYCLIC_DEPTH_ISLAND_BODIES, HEAVY_MASS_RATIO, JAMMING_MASS_RATIO, LOADED_TOWER_BODIES,
};

impl IslandStats {
    /// Returns whether an island in 2D goes to the direct solver because of its mass ratios.
    pub(super) fn is_loaded(&self) -> bool {
        let has_cycles = self.has_contact_cycles();
        let is_small =
            !has_cycles || (self.has_few_awake_bodies && self.bodies <= CYCLIC_DEPTH_ISLAND_BODIES);
        (self.has_heavy_on_light && !has_cycles && self.bodies >= LOADED_TOWER_BODIES)
            || (self.may_jam && is_small)
    }
}

impl IslandSystem {
    /// Returns whether a constraint connects two members with a mass ratio above [`JAMMING_MASS_RATIO`].
    pub(super) fn may_jam(&self, constraints: &[BodyIndices]) -> bool {
        self.has_jamming_masses()
            && constraints.iter().filter(|ends| !ends.bodies.contains(&FIXED)).any(|ends| {
                exceeds_mass_ratio(
                    ends.bodies.map(|at| (1.0 / self.members[at].mass) as f32),
                    JAMMING_MASS_RATIO,
                )
            })
    }

    /// Returns whether the heaviest and the lightest member have a mass ratio above [`JAMMING_MASS_RATIO`], or a member cannot
    /// move. If not, no two members have one, and [`may_jam`](Self::may_jam) need not read the constraints.
    fn has_jamming_masses(&self) -> bool {
        let (mut least, mut greatest) = (f64::INFINITY, 0.0);
        for member in self.members.iter() {
            least = if member.mass < least { member.mass } else { least };
            greatest = if member.mass > greatest { member.mass } else { greatest };
        }
        let [light, heavy] = [least, greatest].map(|mass: f64| (1.0 / mass) as f32);
        !(heavy > 0.0 && light <= JAMMING_MASS_RATIO * heavy)
    }
}

impl SolverSelection<'_> {
    /// Returns two facts about a contact. The first is whether a heavy body lies on a light one. The second, only in 2D, is
    /// whether a body above [`JAMMING_MASS_RATIO`] presses on a light one from any side.
    ///
    /// In 2D the light body must have other constraints: two bodies that meet in the air do well in the iterative solver.
    pub(super) fn classify_load(&self, contact: &ContactConstraint) -> [bool; 2] {
        let [a, b] = contact.inverse_masses;
        if self.has_depth {
            return [is_heavy_on_light([a, b], contact.normal, self.gravity_delta), false];
        }
        let light = if a < b { contact.b } else { contact.a };
        let is_heavy = exceeds_mass_ratio([a, b], self.heavy_mass_ratio())
            && !self.color_usage.has_at_most_one_constraint(BodyIndex(light.0));
        [
            is_heavy && is_heavy_on_light([a, b], contact.normal, self.gravity_delta),
            is_heavy && exceeds_mass_ratio([a, b], JAMMING_MASS_RATIO),
        ]
    }

    /// Returns the mass ratio above which a body counts as heavy compared with another one, dimensionless, > 1.
    ///
    /// It is [`HEAVY_MASS_RATIO`] in 2.5D and with few awake bodies, else [`JAMMING_MASS_RATIO`]. In a large heap of mixed
    /// sizes heavy bodies come to lie on light ones in every update; solver selection for them would take half as long as all
    /// other stages of the update.
    pub(super) fn heavy_mass_ratio(&self) -> f32 {
        if self.has_depth || self.has_few_awake_bodies { HEAVY_MASS_RATIO } else { JAMMING_MASS_RATIO }
    }

    /// Returns whether a contact of the iterative solver has a heavy body on a light one or may jam, by
    /// [`classify_load`](Self::classify_load).
    pub(super) fn has_unsolved_load(&self) -> bool {
        self.has_large_mass_ratio()
            && self.pairs.awake().any(|pair| {
                let differs = || {
                    let inverse_masses = self
                        .pairs
                        .bodies_of(self.proxies, pair)
                        .map(|(body, _)| self.bodies.inverse_mass_inertia[body][0]);
                    exceeds_mass_ratio(inverse_masses, HEAVY_MASS_RATIO)
                };
                let constraint = self.pairs.constraint(pair);
                let iterative = constraint.filter(|(_, handle)| !handle.is_in_direct_solver() && differs());
                iterative.is_some_and(|(kind, handle)| {
                    self.classify_load(&self.constraints.get(kind, handle)).contains(&true)
                })
            })
    }

    /// Returns whether the lightest and the heaviest awake dynamic body have a mass ratio above [`HEAVY_MASS_RATIO`].
    fn has_large_mass_ratio(&self) -> bool {
        let (mut lowest, mut highest) = (f32::MAX, 0.0);
        for run in &self.sleep.awake_body_runs {
            for &[inverse, _] in self.bodies.inverse_mass_inertia.slice(run.clone()) {
                lowest = if inverse > 0.0 && inverse < lowest { inverse } else { lowest };
                highest = if inverse > highest { inverse } else { highest };
            }
        }
        exceeds_mass_ratio([lowest, highest], HEAVY_MASS_RATIO)
    }
}
