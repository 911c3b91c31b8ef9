//! An island with joints in a step: its contacts and joints are rows of one system, solved for velocities and then for positions.
//!
//! A solution is a transaction: nothing is written before it is accepted. An island whose solution is not accepted goes on with the
//! best there is, and costs so much of the budget that it is soon the iterative solver's; at once if it gains energy. In the middle of a
//! blow the iterative solver is worse than any best: it begins from impulses that it cannot hold.

use super::block::Triple;
use super::constraint::{Constraint, FIXED};
use super::constraint_list::add_push;
use super::island::{Effort, Goal, Island, Member, dot, greater};
use super::joint::JointRows;
use super::price::most_steps;
use super::whole::{Reading, Standing, Whole};
use crate::methods::IslandChoice;
use crate::precise::Precise;
use crate::precise::bodies::Bodies;
use crate::precise::joints::island_rows::Span;
use crate::precise::joints::springs::Springs;
use crate::precise::joints::{IMMOVABLE, Joints};
use crate::precise::parameters::direct::{
    ACCEPTED_ENERGY_RATIO, ACCEPTED_ENERGY_SLACK, ACCEPTED_JOINT_ERROR, ACCEPTED_RESIDUAL,
    ACCEPTED_RESIDUAL_FRACTION, ACCEPTED_ROTATION, BEARABLE_VELOCITY_ERROR, CORRECTION_ERROR_RATIO,
    CORRECTION_HALVINGS, CYCLIC_VELOCITY_ERROR, ERROR_ARM, EXACT_VELOCITY_ERROR, JACOBIAN_ROTATION,
    JOINT_ERROR_PROGRESS, JOINTED_PENETRATION_RATE, JOINTED_PENETRATION_SPEED, LATERAL_STICTION_SPEED,
    MOVING_VELOCITY_ERROR, POSITION_CORRECTIONS, RESTING_VELOCITY_ERROR, SOLVED_VELOCITY_ERROR,
};
use crate::precise::rows::{Lane, Rows};
use crate::precise::tuning::Step;

impl Precise {
    /// Solves an island with joints. Answers how many Newton steps that took, and whether the solution is good.
    pub(super) fn solve_joined(&mut self, whole: &mut Whole, step: &Step, unit: f64) -> Effort {
        let Precise { bodies, rows, joints, springs, direct, tuning, .. } = self;
        if whole.stands_as_before(bodies, joints, rows) {
            whole.joints.iter().for_each(|&at| joints.note_solved(at));
            return Effort { steps: 0, residual: 0.0, is_solved: true };
        }
        whole.stood.clear();
        // Room for the update in which it comes to stand, which may be any.
        whole.stood.reserve(whole.island.members.len());
        whole.separations.reserve(whole.homes.len().saturating_sub(whole.separations.len()));
        let (dt, substeps) = (f64::from(step.dt), f64::from(step.substeps));
        let is_optional = direct.timing.choice != IslandChoice::Whole;
        let was_solved = direct.wear[whole.island.members[0].number as usize].was_solved;
        let left = whole.take_bodies(bodies, substeps, unit);
        let mut reading = Reading {
            bodies,
            step,
            dt,
            rate: dt.recip(),
            parts: substeps,
            left,
            quiet: unit * RESTING_VELOCITY_ERROR,
        };
        whole.is_left = false;
        whole.make_contacts(rows, &reading, false);
        whole.damp_spins(springs, dt);
        whole.make_joints(joints, Span { dt, of_forces: dt, substeps, of_step: dt }, ERROR_ARM * unit);
        whole.make_springs(springs, dt, ERROR_ARM * unit);
        let is_driven = whole.island.is_driven();
        if is_driven {
            reading.quiet = unit * MOVING_VELOCITY_ERROR;
        }
        whole.island.stiffen_inertia(dt, |_, _| 0.0);
        let free_energy = whole.island.energy();
        whole.island.warm_start();
        let most_steps = most_steps(whole);
        let mut effort = whole.island.find_velocities(&reading, unit, most_steps);
        let gains = whole.island.gains(free_energy, dt, unit);
        whole.find_ways(dt, false);
        let most = f64::from(tuning.push) * dt;
        let undone = (JOINTED_PENETRATION_RATE * dt).min(1.0);
        let deepest = whole.island.advance_separations(dt, left);
        let before = whole.find_errors(joints, (0.0, false));
        // Stiff springs without friction creep to where they pull: less than what is quiet is far in the end.
        let is_still =
            whole.springs.is_empty() && whole.island.greatest_speed(ERROR_ARM * unit) <= reading.quiet;
        if effort.steps == 0 && is_still && !is_driven && deepest <= left && before <= left {
            whole.stand(rows, &reading);
            whole.joints.iter().for_each(|&at| joints.note_solved(at));
            return effort;
        }
        let turned = whole.island.greatest_spin() * dt;
        let after = match !(gains && is_optional) {
            true => whole.close(
                joints,
                (dt, deepest),
                [left, most, JOINTED_PENETRATION_SPEED * unit * dt],
                undone,
            ),
            false => f64::INFINITY,
        };
        let is_torn = after > ACCEPTED_JOINT_ERROR * unit;
        let is_stuck = whole.homes.is_empty()
            && before > ACCEPTED_JOINT_ERROR * unit
            && is_torn
            && after > before - JOINT_ERROR_PROGRESS * most;
        let has_diverged = !was_solved && turned > ACCEPTED_ROTATION && is_torn;
        whole.is_left = is_optional && (gains || has_diverged || is_stuck);
        effort.is_solved &= !gains && turned <= ACCEPTED_ROTATION && after <= ACCEPTED_JOINT_ERROR * unit;
        if !whole.is_left {
            let Whole { island, joints: of_island, .. } = &*whole;
            of_island.iter().zip(&island.joints).for_each(|(&at, rows)| joints.take_solution(at, rows, dt));
            whole.springs.iter().for_each(|&at| springs.note_solved(at));
            whole.write(rows, substeps, step.h);
        }
        effort
    }
}

impl Whole {
    /// It stood still in the last update, and nothing about it has changed: bodies, the other ends of joints, motors, contacts.
    fn stands_as_before(&self, bodies: &Bodies, joints: &Joints, rows: &Rows) -> bool {
        let of_members = self.island.members.iter().zip(&self.stood);
        !self.stood.is_empty()
            && self.has_pushes
            && self.joints.iter().all(|&at| !joints.hold(at).has_moved())
            && of_members.map(|(member, stood)| (member.number as usize, stood)).all(|(number, stood)| {
                *stood == Standing::of(bodies, number) && bodies.hot[number].velocity == [0.0; 4]
            })
            && self.homes.iter().zip(&self.separations).all(|(&home, separations)| {
                let Lane { a, points: [one, other], .. } = &rows.direct(home).lane;
                let stands = |body: u32| bodies.hot[body as usize].velocity == [0.0; 4];
                [one.separation, other.separation] == *separations
                    && (!bodies.is_kinematic(*a as usize) || stands(*a))
            })
    }

    /// No member is faster than what is quiet: the island stands still, and impulses stay as they are. One that stood still before as
    /// well is not to be solved until something changes: from velocities of 0 a solution finds the same again. (A pendulum that turns
    /// round has no velocity either, and gets one.)
    fn stand(&mut self, rows: &mut Rows, reading: &Reading<'_>) {
        self.keep(rows, reading.step, reading.parts);
        self.has_pushes = true;
        let Whole { island, ways, stood, separations, homes, .. } = self;
        separations.clear();
        separations.extend(
            homes.iter().map(|&home| rows.direct(home).lane.points.each_ref().map(|point| point.separation)),
        );
        ways.iter_mut().for_each(|way| *way = [0.0; 3]);
        let Reading { bodies, .. } = reading;
        let stands = |member: &Member| bodies.hot[member.number as usize].velocity == [0.0; 4];
        if island.members.iter().all(stands) {
            stood.extend(island.members.iter().map(|member| Standing::of(bodies, member.number as usize)));
        }
        island.members.iter_mut().for_each(|member| member.velocity = [0.0; 3]);
    }

    /// Rows of its joints.
    fn make_joints(&mut self, joints: &Joints, span: Span, lever: f64) {
        let Whole { island, joints: of_island, joint_ends, .. } = self;
        let Island { members, joints: rows, .. } = island;
        rows.clear();
        for (&at, &ends) in of_island.iter().zip(joint_ends.iter()) {
            let mut made = joints.hold(at).rows(ends, span, lever);
            made.weigh(members);
            rows.push(made);
        }
    }

    /// Rows of its springs, behind those of its joints.
    fn make_springs(&mut self, springs: &Springs, dt: f64, lever: f64) {
        let Whole { island: Island { members, joints: rows, .. }, springs: of_island, spring_ends, .. } =
            self;
        for (&at, &ends) in of_island.iter().zip(spring_ends.iter()) {
            let mut made = springs.hold(at).rows(ends, dt, lever);
            made.weigh(members);
            rows.push(made);
        }
    }

    /// Damping of the spin of single bodies, implicit: I w' = I w - dt c w'.
    fn damp_spins(&mut self, springs: &Springs, dt: f64) {
        let Whole { island: Island { members, .. }, springs: of_island, spring_ends, .. } = self;
        for (&at, ends) in of_island.iter().zip(spring_ends.iter()) {
            let damping = dt * springs.hold(at).damping_of_spin();
            for member in ends.bodies.into_iter().filter(|&member| member != FIXED && damping > 0.0) {
                members[member as usize].add_inertia(damping, 0.0);
            }
        }
    }

    /// Position solve: joints are closed, and points taken out of what they are in, from the displacements of the velocities on.
    /// Answers the greatest position error of a joint that is left, in length units.
    pub(super) fn close(
        &mut self,
        joints: &Joints,
        (dt, mut deepest): (f64, f64),
        limits: [f64; 3],
        undone: f64,
    ) -> f64 {
        let (turns, left) = (self.island.greatest_spin() * dt > JACOBIAN_ROTATION, limits[0]);
        let mut error = self.find_errors(joints, (dt, turns));
        for correction in 0.. {
            let is_jacobian_new = correction > 0 || turns;
            let enough = if correction == 0 { left } else { CORRECTION_ERROR_RATIO * left };
            if correction == POSITION_CORRECTIONS || (error <= enough && deepest <= left) {
                return error;
            }
            self.island.correct_positions(limits, undone, is_jacobian_new);
            self.follow_correction(1.0);
            let before = std::mem::replace(&mut error, self.find_errors(joints, (dt, true)));
            // A long chain near a straight line has corrections that turn its links by a radian: the linear model ends long before.
            for halving in 1..=CORRECTION_HALVINGS {
                if error <= before {
                    break;
                }
                self.follow_correction(-(0.5_f64.powi(halving)));
                error = self.find_errors(joints, (dt, true));
            }
            // Overlaps are undone once, and as far as that is to be in one step.
            deepest = 0.0;
        }
        f64::INFINITY
    }

    /// Displacements go along the last position correction by this part of it.
    fn follow_correction(&mut self, part: f64) {
        let Whole { island, ways, .. } = self;
        for (way, more) in ways.iter_mut().zip(island.ways()) {
            (0..3).for_each(|axis| way[axis] += part * more[axis]);
        }
    }

    /// Position errors of joints after the displacements so far. Answers the greatest, in length units.
    fn find_errors(&mut self, joints: &Joints, how: (f64, bool)) -> f64 {
        let Whole { island, joints: of_island, joint_ends, ways, .. } = self;
        let mut worst = 0.0;
        for ((rows, &at), &ends) in island.joints.iter_mut().zip(of_island.iter()).zip(joint_ends.iter()) {
            joints.hold(at).find_errors(rows, ends, ways, how);
            worst = greater(rows.greatest_error(), worst);
        }
        worst
    }
}

impl Island {
    /// Solves for velocities what is further from what it is to be than what is quiet.
    pub(super) fn find_velocities(&mut self, reading: &Reading<'_>, unit: f64, most_steps: usize) -> Effort {
        let residual = self.begin(reading.dt, [reading.left, LATERAL_STICTION_SPEED * unit]);
        if residual <= reading.quiet {
            return Effort { steps: 0, residual, is_solved: true };
        }
        self.solve(&Goal {
            begun: residual,
            bearable: (ACCEPTED_RESIDUAL * unit + ACCEPTED_RESIDUAL_FRACTION * residual)
                .min(BEARABLE_VELOCITY_ERROR * unit),
            enough: unit * SOLVED_VELOCITY_ERROR,
            exact: unit * EXACT_VELOCITY_ERROR,
            still: unit * RESTING_VELOCITY_ERROR,
            near: unit * CYCLIC_VELOCITY_ERROR,
            most_steps,
        })
    }

    /// Geometric stiffness (M. Tournier and others, "Stable constrained dynamics", 2015): forces of joints that pull a body apart
    /// resist its rotation; those beyond what its inertia bears in `dt` seconds add to it.
    /// `with_momentum` says how much of an addition turns as the member does, given that and what its inertia bears.
    pub(super) fn stiffen_inertia(&mut self, dt: f64, with_momentum: impl Fn(f64, f64) -> f64) {
        self.find_pulls();
        for (member, &[pull, reach, _]) in self.members.iter_mut().zip(&self.gradient) {
            let borne = member.borne_stiffness(reach);
            let more = dt * pull - borne;
            if more > 0.0 {
                member.add_inertia(more, with_momentum(more, borne));
            }
        }
    }

    /// The greatest geometric stiffness of a member in `dt` seconds, in parts of what its inertia bears.
    pub(super) fn greatest_stiffness(&mut self, dt: f64) -> f64 {
        self.find_pulls();
        let all = self.members.iter().zip(&self.gradient);
        all.fold(0.0, |most, (member, &[pull, reach, _])| {
            greater(dt * pull / member.borne_stiffness(reach), most)
        })
    }

    /// Sums up for each member the products of arms and impulses of joints, and finds the square of the longest arm.
    fn find_pulls(&mut self) {
        let Island { members, joints, gradient, .. } = self;
        gradient.clear();
        gradient.resize(members.len(), [0.0; 3]);
        for joint in joints.iter() {
            let [on_a, on_b] = joint.jacobian.push(joint.impulses);
            let arms = [joint.jacobian.a, joint.jacobian.b];
            let [nx, ny] = joint.jacobian.normal;
            for (side, push) in [on_a, on_b].into_iter().enumerate() {
                let member = joint.bodies[side];
                if member == FIXED {
                    continue;
                }
                // From arm x n and arm x t back to the arm.
                let [across_n, _, across_t] = arms[side];
                let arm = [across_n * ny - across_t * nx, -across_n * nx - across_t * ny];
                let of_member = &mut gradient[member as usize];
                of_member[0] += arm[0] * push[0] + arm[1] * push[1];
                of_member[1] = of_member[1].max(arm[0] * arm[0] + arm[1] * arm[1]);
            }
        }
    }

    /// Warm start: impulses of the step before act again, by the part of them that leaves the least energy. With l the impulses and
    /// u the velocity errors that they act on, that is the part p with l (u + p J M^-1 J^T l) = 0. In closed loops impulses of before
    /// may be any self-stress, and once the geometry has changed it would throw the bodies apart.
    pub(super) fn warm_start(&mut self) {
        let Island { members, contacts, joints, direction, .. } = self;
        direction.clear();
        direction.resize(members.len(), [0.0; 3]);
        push_all(contacts, direction);
        push_all(joints, direction);
        for (change, member) in direction.iter_mut().zip(members.iter()) {
            *change = member.yields(*change);
        }
        let velocities = |at: usize| members[at].velocity;
        let [lost, needed] =
            works(joints, velocities, direction, works(contacts, velocities, direction, [0.0; 2]));
        // None of what is not a number.
        let part = if lost > 0.0 && needed > 0.0 { (lost / needed).min(1.0) } else { 0.0 };
        scale_impulses(contacts, part);
        scale_impulses(joints, part);
        for (member, change) in members.iter_mut().zip(direction.iter()) {
            (0..3).for_each(|axis| member.velocity[axis] += part * change[axis]);
        }
    }

    /// Whether the island has more energy than motors, springs and the velocities without constraints account for, which have twice the
    /// energy `free`, in `dt` seconds.
    pub(super) fn gains(&self, free: f64, dt: f64, unit: f64) -> bool {
        let supplied = self.supplied_energy() + 0.5 * self.released_energy(dt);
        let slack = ACCEPTED_ENERGY_SLACK * unit * unit * self.mass();
        // An energy that is not a number gains, too.
        let keeps = self.energy() <= ACCEPTED_ENERGY_RATIO * free + 2.0 * supplied + slack;
        !keeps
    }

    /// Twice the kinetic energy.
    pub(super) fn energy(&self) -> f64 {
        self.members.iter().map(|member| dot(member.weighed(member.velocity), member.velocity)).sum()
    }

    fn mass(&self) -> f64 {
        self.members.iter().map(|member| member.mass).filter(|&mass| mass < IMMOVABLE).sum()
    }

    /// Whether something moves bodies by itself: a motor, a belt or a kinematic body.
    fn is_driven(&self) -> bool {
        self.contacts.iter().any(|contact| contact.supplied != [0.0; 3])
            || self.joints.iter().any(JointRows::is_driven)
    }

    /// The greatest speed of a member, in length units per second, with spins as speeds at this lever.
    fn greatest_speed(&self, lever: f64) -> f64 {
        let of_member = |[x, y, spin]: Triple| greater(greater(x.abs(), y.abs()), lever * spin.abs());
        self.members.iter().fold(0.0, |most, member| greater(of_member(member.velocity), most))
    }

    /// The fastest spin of a member, in radians per second.
    pub(super) fn greatest_spin(&self) -> f64 {
        self.members.iter().fold(0.0, |most, member| greater(member.velocity[2].abs(), most))
    }

    /// Twice the energy that springs release in a step of `dt` seconds with the velocities now; less than 0 if they take it up.
    fn released_energy(&self, dt: f64) -> f64 {
        let velocity = |member: usize| self.members[member].velocity;
        self.joints.iter().map(|joint| joint.released(velocity, dt)).sum()
    }

    /// Energy that motors, belts and kinematic bodies put in at most.
    fn supplied_energy(&self) -> f64 {
        let of_contacts = self.contacts.iter().map(|contact| work(contact.impulses, contact.supplied));
        let of_joints = self.joints.iter().map(|joint| work(joint.impulses, joint.all_carried()));
        of_contacts.chain(of_joints).sum()
    }
}

/// Work of impulses at prescribed velocities, whatever its sign.
fn work(impulses: Triple, velocities: Triple) -> f64 {
    (0..3).map(|row| (impulses[row] * velocities[row]).abs()).sum()
}

/// Adds what the impulses of constraints do to members.
fn push_all<C: Constraint>(constraints: &[C], pushes: &mut [Triple]) {
    for rows in constraints {
        add_push(&rows.jacobian, rows.bodies, rows.impulses, pushes);
    }
}

/// Adds the energy that impulses take from these velocities, and twice that which they hold by the changes that they make.
fn works<C: Constraint>(
    constraints: &[C],
    velocities: impl Fn(usize) -> Triple,
    changes: &[Triple],
    [mut lost, mut needed]: [f64; 2],
) -> [f64; 2] {
    for rows in constraints {
        let (before, change) = (rows.relative_of(&velocities), rows.relative_in(changes));
        for row in 0..3 {
            lost -= rows.impulses[row] * (before[row] + rows.supplied[row]);
            needed += rows.impulses[row] * change[row];
        }
        needed += rows.yielding();
    }
    [lost, needed]
}

/// A step begins with this part of the impulses.
fn scale_impulses<C: Constraint>(constraints: &mut [C], part: f64) {
    for rows in constraints {
        let impulses = rows.impulses.map(|impulse| part * impulse);
        rows.start_from(impulses);
    }
}
