//! Fallback of the direct solver: islands without an acceptable solution go to the iterative solver within the same update.
//!
//! In a wedge normal impulses and friction may raise each other without end, so that no round of the augmented Lagrangian
//! method converges. The contact constraints of such an island move back to the graph colours. One factor scales their
//! warm-start impulses down so far that they do not add energy. Unscaled impulses would throw apart bodies that just leave a
//! jam. Contact cycles with a [budget](super::cost_model) are an exception. They stay in the direct solver with the result of
//! Gauss-Seidel sweeps, until the budget is spent or a result gains energy or shoots a body out.

use super::DirectSolver;
use super::island_body::{IslandBody, MemberIndex, dot, max_or_nan};
use super::island_history::IslandHistory;
use super::island_newton::IslandSystem;
use super::island_stats::IslandIndex;
use super::mat3::Vec3;
use crate::broad_phase::pairs::Pairs;
use crate::broad_phase::proxies::Proxies;
use crate::constraint_graph::ConstraintGraph;
use crate::index::{BodyIndex, DenseIndex};
use crate::narrow_phase::constraint_lifetime::move_to_direct_solver;
use crate::parameters::direct::{ACCEPTED_ENERGY_GAIN, ACCEPTED_SPEED_GAIN};
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
                if was_direct {
                    let constraint = &mut constraints.direct_constraint_mut(handle).constraint;
                    constraint.forget_impacts();
                    if may_rock {
                        let points = &mut constraint.points;
                        points.iter_mut().for_each(|point| point.rest_impulse *= adaptation.adapted_fraction);
                    }
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
    /// Returns whether the solution of an island of contacts gains energy, or gives a body more speed than
    /// [`ACCEPTED_SPEED_GAIN`] allows. `free` returns the velocity of a body without contact impulses (length units/s, length
    /// units/s, radians/s). `dt` is the step in seconds, `unit` the length unit.
    ///
    /// The rows are linear, rigid and hold for a whole step. A heavy body that lands on a light wedge shoots it out as fast as
    /// the wedge is slim, further than any of its contacts is valid; the soft rows of the iterative solver yield.
    pub(super) fn exceeds_free_motion(&self, free: impl Fn(BodyIndex) -> Vec3, dt: f64, unit: f64) -> bool {
        let fastest = self.members.iter().map(|member| member.squared_speed(member.velocity));
        let is_bounded = fastest.fold(0.0, |most, squared| max_or_nan(squared, most))
            <= self.speed_limit_squared(&free, unit);
        let doubled_energy = |member: &IslandBody| {
            let velocity = free(member.body);
            dot(member.momentum(velocity), velocity)
        };
        let free_energy = self.members.iter().map(doubled_energy).sum();
        !is_bounded || self.gains_energy(free_energy, dt, unit, ACCEPTED_ENERGY_GAIN)
    }

    /// Returns the square of the greatest speed that contacts may give a member, length units^2/s^2, from the velocities `free`
    /// without contact impulses and from those of belts and kinematic bodies. `unit` is the length unit.
    fn speed_limit_squared(&self, free: impl Fn(BodyIndex) -> Vec3, unit: f64) -> f64 {
        let fastest = self.members.iter().fold(0.0, |most, member| {
            let squared = member.squared_speed(free(member.body));
            max_or_nan(squared, most)
        });
        let driven = self.contacts.iter().flat_map(|contact| contact.driven_velocity_error);
        let fastest = driven.fold(fastest, |most, speed| max_or_nan(speed * speed, most));
        let [gain, slack] = ACCEPTED_SPEED_GAIN;
        gain * gain * fastest + slack * slack * unit * unit
    }

    /// Multiplies the initial impulses of all contacts by one factor, 0..=1, with which they remove as much kinetic energy as
    /// possible. The products become the impulses of the contacts.
    ///
    /// Let l be the initial impulses of all rows, u the relative velocities of the rows without these impulses, and du the
    /// change of u by all of l. The kinetic energy is least at the factor p with l . (u + p du) = 0. `free` returns the
    /// velocity of a body without contact impulses (length units/s, length units/s, radians/s). `unit` is the length unit.
    ///
    /// Impulses that would still give a body more speed than [`ACCEPTED_SPEED_GAIN`] allows become 0: the energy of a light
    /// body hardly counts beside that of heavy ones.
    pub(super) fn scale_down_impulses(&mut self, free: impl Fn(BodyIndex) -> Vec3, unit: f64) {
        let limit = self.speed_limit_squared(&free, unit);
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
        let scaled = |at: MemberIndex| {
            std::array::from_fn(|i| {
                let before = negative_gradient[at][i];
                before + factor * (direction[at][i] - before)
            })
        };
        let max = members.enumerated().map(|(at, member)| member.squared_speed(scaled(at)));
        let is_bounded = max.fold(0.0, |most, squared| max_or_nan(squared, most)) <= limit;
        let factor = if is_bounded { factor } else { 0.0 };
        for contact in contacts {
            contact.impulses = contact.initial_impulses.map(|impulse| factor * impulse);
        }
        lateral_frictions.iter_mut().for_each(|friction| friction.impulse *= factor);
    }
}
