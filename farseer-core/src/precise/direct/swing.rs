//! Free articulations with motors, limits or greatest impulses: islands of joints that nothing touches, solved in parts of the step.
//!
//! RATTLE (H. Andersen, 1983) with bounds on impulses. Each part begins with a kick by forces, and finds the impulses with which the
//! joints hold at its end (SHAKE): by the Jacobian of its beginning, and velocity errors that take in how far turning bends the joints
//! apart. The kicks at both ends of the step are halves, and the step ends with velocities that obey the joints there. Impulses act
//! where the bodies are, so that momentum and angular momentum stay, and what swings keeps its energy to the second order of a part;
//! motors and forces that are steady move bodies as far as they do in continuous time.

use super::island::{Effort, Island, greater};
use super::price::most_steps;
use super::whole::{Reading, Whole};
use crate::precise::Precise;
use crate::precise::joints::island_rows::Span;
use crate::precise::joints::swing::{Division, with_momentum};
use crate::precise::joints::{Joints, weight_of};
use crate::precise::parameters::direct::{
    ACCEPTED_JOINT_ERROR, ACCEPTED_ROTATION, ARTICULATION_SOLUTIONS, ERROR_ARM, MOVING_VELOCITY_ERROR,
};
use crate::precise::parameters::joints::{IMPLICIT_STIFFNESS_RATIO, LEAST_DIRECT_PARTS};
use crate::precise::tuning::Step;

impl Whole {
    /// Whether it swings by itself: nothing touches it, no spring pulls at it, and no joints close a loop. Where a loop is straight no
    /// impulse at the beginning of a part closes it at the end.
    pub(super) fn swings(&self, joints: &Joints) -> bool {
        self.homes.is_empty() && self.springs.is_empty() && !self.joints.iter().any(|&at| joints.has_loop(at))
    }

    /// Forces act for this share of the step; those that may depend on the place act at once when the step begins, as on bodies that
    /// nothing holds.
    fn kick(&mut self, share: f64, is_first: bool, reading: &Reading<'_>) {
        let Reading { bodies, step, .. } = reading;
        let (substeps, at_once) = (f64::from(step.substeps), 2.0 / f64::from(step.dt));
        let at_beginning = if is_first { 1.0 - share } else { -share };
        for member in &mut self.island.members {
            let (push, forced) = (bodies.push[member.number as usize], bodies.forced[member.number as usize]);
            for axis in 0..3 {
                let kick = share * substeps * f64::from(push[axis]);
                member.velocity[axis] += kick + at_beginning * at_once * f64::from(forced[axis]);
            }
            member.change = [0.0; 3];
            [member.mass, member.inertia] = bodies.inverses[member.number as usize].map(weight_of);
        }
    }

    /// Rows of its joints where they are now.
    fn make_rows(&mut self, span: Span, lever: f64) {
        let Whole { island: Island { members, joints: rows, .. }, holds, joint_ends, .. } = self;
        rows.clear();
        for (hold, &ends) in holds.iter().zip(joint_ends.iter()) {
            let mut made = hold.rows(ends, span, lever);
            made.weigh(members);
            rows.push(made);
        }
    }

    /// Finds the velocities of a part: those with which joints hold at its end if bodies move, else those that obey them where they
    /// are. A solution that gains energy is none.
    fn solve_part(&mut self, reading: &Reading<'_>, limits: (f64, usize), moves: bool) -> Effort {
        let (unit, most_steps) = limits;
        let free_energy = self.island.energy();
        self.island.warm_start();
        let mut effort = self.island.find_velocities(reading, unit, most_steps);
        for _ in 1..if moves { ARTICULATION_SOLUTIONS } else { 1 } {
            if self.take_linearisation_errors(reading.dt) <= reading.left {
                break;
            }
            let more = self.island.find_velocities(reading, unit, most_steps);
            effort = Effort { steps: effort.steps + more.steps, ..more };
        }
        let gains = self.island.gains(free_energy, reading.dt, unit);
        Effort { is_solved: effort.is_solved && !gains, ..effort }
    }

    /// Takes the linearisation errors of `dt` seconds into the velocity errors. Answers the greatest change of them, in length units.
    fn take_linearisation_errors(&mut self, dt: f64) -> f64 {
        self.find_ways(dt, false);
        let Whole { island: Island { members, joints: rows, .. }, holds, joint_ends, ways, .. } = self;
        let mut worst = 0.0;
        for ((rows, hold), &ends) in rows.iter_mut().zip(holds.iter()).zip(joint_ends.iter()) {
            worst =
                greater(rows.take_linearisation_error(hold.linearisation_error(ends, ways, dt), dt), worst);
        }
        members.iter_mut().for_each(|member| member.change = [0.0; 3]);
        worst
    }

    /// Joints take over forces and torques, and add impulses to those of the step.
    fn bear(&mut self, of_forces: f64) {
        let Whole { island, holds, totals, .. } = self;
        for ((hold, rows), total) in holds.iter_mut().zip(&island.joints).zip(totals.iter_mut()) {
            hold.bear(rows, of_forces);
            let force = hold.force_and_torque();
            (0..3).for_each(|axis| total[axis] += force[axis] * of_forces);
        }
    }

    /// Bodies and joints move by the velocities.
    fn advance(&mut self, dt: f64) {
        self.find_ways(dt, false);
        let Whole { holds, joint_ends, ways, path, .. } = self;
        holds.iter_mut().zip(joint_ends.iter()).for_each(|(hold, &ends)| hold.displace(ends, ways, dt));
        for (path, way) in path.iter_mut().zip(ways.iter()) {
            (0..3).for_each(|axis| path[axis] += way[axis]);
        }
    }

    /// A step begins. Answers into how many parts it is divided.
    fn begin_swing(&mut self, joints: &Joints, step: &Step) -> u32 {
        let dt = f64::from(step.dt);
        let Whole { island, holds, totals, path, joints: of_island, joint_ends, .. } = self;
        holds.clear();
        holds.extend(of_island.iter().map(|&at| *joints.hold(at)));
        totals.clear();
        totals.resize(holds.len(), [0.0; 3]);
        path.clear();
        path.resize(island.members.len(), [0.0; 3]);
        island.contacts.clear();
        island.joints.clear();
        island.rubs.clear();
        let whole_step = Span { dt, of_forces: dt, substeps: step.substeps.into(), of_step: dt };
        for (hold, &ends) in holds.iter().zip(joint_ends.iter()) {
            let mut rows = hold.rows(ends, whole_step, 1.0);
            rows.weigh(&island.members);
            island.joints.push(rows);
        }
        let stiffness = island.greatest_stiffness(dt);
        let (count, spin) = (island.members.len() as u32, island.greatest_spin());
        let division =
            Division::of(count, step, [spin; 2], |bears| stiffness > IMPLICIT_STIFFNESS_RATIO * bears);
        division.parts.max(if Division::is_balanced(count) { LEAST_DIRECT_PARTS } else { 1 })
    }
}

impl Precise {
    /// Solves an island that [swings](Whole::swings). Answers how many Newton steps that took, and whether the solution is good; if it is
    /// not, nothing is written.
    pub(super) fn solve_swing(&mut self, whole: &mut Whole, step: &Step, unit: f64) -> Effort {
        let Precise { bodies, joints, tuning, .. } = self;
        let (dt, substeps) = (f64::from(step.dt), f64::from(step.substeps));
        let left = whole.take_bodies(bodies, 0.0, unit);
        whole.is_left = false;
        whole.stood.clear();
        let parts = whole.begin_swing(joints, step);
        let h = dt / f64::from(parts);
        // The residual that is quiet at rest would add up to a wrong angle of a slow motor.
        let quiet = unit * MOVING_VELOCITY_ERROR;
        let reading = Reading { bodies, step, dt: h, rate: h.recip(), parts: substeps, left, quiet };
        let most_steps = most_steps(whole);
        let mut all = Effort { steps: 0, residual: 0.0, is_solved: true };
        for part in 0..=parts {
            let (moves, share) = (part < parts, if part == 0 || part == parts { 0.5 } else { 1.0 });
            let share_of_step = share / f64::from(parts);
            whole.kick(share_of_step, part == 0, &reading);
            let span = Span { dt: h, of_forces: share * h, substeps: share_of_step * substeps, of_step: dt };
            whole.make_rows(span, ERROR_ARM * unit);
            if moves {
                whole.island.stiffen_inertia(h / share, with_momentum);
            }
            let effort = whole.solve_part(&reading, (unit, most_steps), moves);
            all.steps += effort.steps;
            all.residual = greater(effort.residual, all.residual);
            all.is_solved = effort.is_solved && whole.island.greatest_spin() * h <= ACCEPTED_ROTATION;
            if !all.is_solved {
                return all;
            }
            whole.bear(span.of_forces);
            if moves {
                whole.advance(h);
            }
        }
        whole.ways.clone_from(&whole.path);
        let most = f64::from(tuning.push) * dt;
        let gap = whole.close(joints, (dt, 0.0), [left, most, 0.0], 0.0);
        all.is_solved = gap <= ACCEPTED_JOINT_ERROR * unit;
        whole.has_swung = all.is_solved;
        if all.is_solved {
            for (&at, total) in whole.joints.iter().zip(&whole.totals) {
                joints.take_force(at, total.map(|impulse| impulse / dt + 0.0));
            }
        }
        all
    }
}
