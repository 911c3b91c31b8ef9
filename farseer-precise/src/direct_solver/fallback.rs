//! Fallback of the direct solver: islands without an acceptable solution go to the iterative solver within the same update.
//!
//! In a wedge normal impulses and friction may raise each other without end, so that no round of the augmented Lagrangian
//! method converges. The contact constraints of such an island move back to the graph colours. One factor scales their
//! warm-start impulses down so far that they do not add energy. Unscaled impulses would throw apart bodies that just leave a
//! jam. Contact cycles with a [budget](super::cost_model) are an exception. They stay in the direct solver with the result of
//! Gauss-Seidel sweeps, until the budget is spent.

use super::DirectSolver;
use super::island_body::IslandBody;
use super::island_history::IslandHistory;
use super::island_newton::IslandSystem;
use super::island_stats::IslandIndex;
use super::mat3::Vec3;
use crate::broad_phase::pairs::Pairs;
use crate::broad_phase::proxies::Proxies;
use crate::constraint_graph::ConstraintGraph;
use crate::index::{BodyIndex, DenseIndex};
use crate::narrow_phase::constraint_lifetime::move_to_direct_solver;
use crate::scaled_parameters::LoadAdaptation;

impl DirectSolver {
    /// Moves contact constraints between the graph colours and the direct solver, as selected. A constraint keeps its impulses
    /// when it moves.
    ///
    /// The rest impulse of a constraint that returns to the iterative solver is its whole last load. After an impact such rest
    /// impulses would press against each other for a second in contact cycles. Islands with joints are softer in the iterative
    /// solver. In both cases the rest impulse is multiplied by the `adapted_fraction` of `adaptation`. `h` is the length of the
    /// substeps in which the impulses last acted, in seconds.
    pub(crate) fn move_constraints(
        &mut self,
        pairs: &mut Pairs,
        proxies: &Proxies,
        constraints: &mut ConstraintGraph,
        adaptation: &LoadAdaptation,
        h: f32,
    ) {
        for pair in pairs.awake() {
            let Some((_, handle)) = pairs.constraint(pair) else { continue };
            let body = pairs.bodies_of(proxies, pair)[1].0;
            let (is_direct, was_direct) = (self.is_direct(body), handle.is_in_direct_solver());
            if is_direct != was_direct {
                let body = BodyIndex::new(body.position());
                let IslandHistory { formed_by_motion, has_accepted_solution, .. } = self.history[body];
                let may_rock = has_accepted_solution
                    || (formed_by_motion && self.census.stats_of(body).has_contact_cycles());
                if was_direct && may_rock {
                    let points = &mut constraints.direct_constraint_mut(handle).constraint.points;
                    points.iter_mut().for_each(|point| point.rest_impulse *= adaptation.adapted_fraction);
                }
                move_to_direct_solver(pairs, constraints, pair, is_direct, h);
            }
        }
        self.history.iter_mut().for_each(|entry| entry.has_accepted_solution &= entry.is_direct);
    }

    /// Hands all released islands over to the iterative solver. Returns whether there was one: then contact constraints must
    /// [move](Self::move_constraints) to the graph colours before the iterative solver runs.
    pub(super) fn release_unsolved(&mut self) -> bool {
        let DirectSolver { islands, count, history, is_listed, .. } = self;
        if !islands.slice(..*count).iter().any(|island| island.is_released) {
            return false;
        }
        let mut solved = 0;
        for at in (0..*count).map(IslandIndex::new) {
            if islands[at].is_released {
                let members = &islands[at].system.members;
                members.iter().for_each(|member| history[member.body].is_direct = false);
            } else {
                islands.swap(at, IslandIndex::new(solved));
                solved += 1;
            }
        }
        // Constraints move, so the handles of the other islands are listed again.
        (*count, *is_listed) = (solved, false);
        true
    }
}

impl IslandSystem {
    /// Multiplies the initial impulses of all contacts by one factor, 0..=1, with which they remove as much kinetic energy as
    /// possible. The products become the impulses of the contacts.
    ///
    /// Let l be the initial impulses of all rows, u the relative velocities of the rows without these impulses, and du the
    /// change of u by all of l. The kinetic energy is least at the factor p with l . (u + p du) = 0. `free` returns the
    /// velocity of a body without contact impulses (length units/s, length units/s, radians/s).
    pub(super) fn scale_down_impulses(&mut self, free: impl Fn(BodyIndex) -> Vec3) {
        let IslandSystem { members, contacts, lateral_frictions, negative_gradient, direction, .. } = self;
        negative_gradient.clear();
        direction.clear();
        for &IslandBody { body: number, velocity, best_velocity_change: best, .. } in members.iter() {
            negative_gradient.push(free(number));
            direction.push(std::array::from_fn(|i| velocity[i] - best[i]));
        }
        let (mut work, mut doubled_energy) = (0.0, 0.0);
        for contact in contacts.iter() {
            let [before, after] = [&*negative_gradient, &*direction]
                .map(|velocities| contact.relative_velocities_in(velocities));
            for (row, impulse) in contact.initial_impulses.into_iter().enumerate() {
                work -= impulse * (before[row] + contact.prescribed_velocity[row]);
                doubled_energy += impulse * (after[row] - before[row]);
            }
        }
        // NaN gives 0.
        let factor = if work > 0.0 && doubled_energy > 0.0 { (work / doubled_energy).min(1.0) } else { 0.0 };
        for contact in contacts {
            contact.impulses = contact.initial_impulses.map(|impulse| factor * impulse);
        }
        lateral_frictions.iter_mut().for_each(|friction| friction.impulse *= factor);
    }
}
