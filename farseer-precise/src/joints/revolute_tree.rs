//! Step of a free articulation whose joints are all rigid revolute joints without motors: chains, ropes, bridges, ragdolls.
//!
//! The algorithm is that of [`articulation_step`](super::articulation_step): SHAKE with RATTLE on the articulated-body
//! algorithm. These trees are by far the most common, so this version is specialised. A link holds only the data that revolute
//! joints need, anchors are updated in the pass that reads the bodies, and each pass over the links does all the work that is
//! possible there.
//!
//! The module reads [`BodySet`] and the joint constraints. It writes velocities, displacements, joint errors and joint forces.

use crate::parameters::joints::{
    IMPLICIT_STIFFNESS_RATIO, JOINT_CORRECTION_SPEED, MAX_WHIP_JOINT_ERROR, STIFFNESS_JUMP_RETRIES,
};

use super::super::bodies::BodySet;
use super::super::scaled_parameters::StepContext;
use super::articulated_body::{LinkIndex, Links, TreeNode, for_each_down, for_each_up_prepared};
use super::articulated_inertia::{ArticulatedInertia, ArticulatedMomentum};
use super::energy_balance::{BalancedLink, InitialEnergy, LinkEndState, max_rounding_error};
use super::indices::JointIndex;
use super::joint_constraint::JointList;
use super::locked_dofs::LockedDofs;
use super::substep_plan::{ArticulationSize, SubstepPlan, max_spins};
use super::vec2::{Vec2, add_scaled, dot, perp};
use crate::index::BodyIndex;

mod build;
mod link;

pub(super) use build::revolute_links;

/// A link: a body in a tree of revolute joints. Parents come before their children in the list of links; a root is its own
/// parent.
///
/// The alignment and the order of the fields allow the processor to read pairs of numbers in place: a vector of three components
/// and a number fill two pairs.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C, align(16))]
pub(super) struct RevoluteLink {
    /// Anchor of the joint in local coordinates of the body, relative to its centre of mass. Unit: length units.
    anchor: Vec2,
    /// Anchor of the joint in local coordinates of the parent, relative to the parent's centre of mass. Unit: length units.
    parent_anchor: Vec2,
    /// Arm: vector from the centre of mass of the body to its anchor, in world coordinates. Unit: length units.
    arm: Vec2,
    /// Parent's arm: vector from the centre of mass of the parent to its anchor, in world coordinates. Unit: length units.
    parent_arm: Vec2,
    /// Position of the centre of mass in the world. Unit: length units.
    position: Vec2,
    /// A rotation as [cosine, sine]. Dimensionless.
    ///
    /// When the step begins it is the rotation of the body in the world. While a substep is solved it is the [nonlinear
    /// part](super::rotation::nonlinear_rotation) of the substep's rotation: [cosine, sine minus the angle]. When bodies move it
    /// is the whole rotation in the substep.
    rotation: Vec2,
    /// Articulated inertia [A c; c^T d] of the link and its subtree about the joint with the parent. After the backward pass
    /// its `mass` is A - c c^T / d: rotation is eliminated.
    articulated_inertia: ArticulatedInertia,
    /// Target velocity of the body relative to its parent at the joint, along x and y. Unit: length units/s.
    target_velocity: Vec2,
    /// Impulse of the joint on the body in this substep, along x and y. Unit: mass units * length units/s.
    impulse: Vec2,
    /// Sum of `impulse` over the substeps since the step began. Unit: mass units * length units/s.
    total_impulse: Vec2,
    /// Momentum of the link and its subtree about the joint with the parent. After the backward pass rotation is eliminated
    /// from its `linear` momentum.
    momentum: ArticulatedMomentum,
    /// 1 / d of the articulated inertia [A c; c^T d]: reciprocal of the rotational inertia of the link and its subtree about
    /// the joint. Unit: 1/(mass units * length units^2).
    inverse_rotational: f64,
    /// Solved velocity of the body at the joint with the parent, and angular velocity: x and y in length units/s, angular in
    /// radians/s.
    joint_velocity: [f64; 3],
    /// Predicted angular velocity in this substep, about which the joint errors are linearised. Unit: radians/s.
    predicted_spin: f64,
    /// Velocity of the centre of mass before joint impulses, and angular velocity: x and y in length units/s, angular in
    /// radians/s.
    velocity: [f64; 3],
    /// Change of the angular velocity by joints in the previous substep. It predicts the change in this one. Unit: radians/s.
    joint_spin_change: f64,
    /// Velocity change by applied forces in a substep: x and y in length units/s, angular in radians/s.
    force_delta: [f64; 3],
    /// Geometric stiffness of the body against rotation, due to the joint forces, times the square of the substep. Unit: mass
    /// units * length units^2.
    geometric_stiffness: f64,
    /// Displacement since the step began: x and y in length units, rotation in radians.
    delta_pose: [f64; 3],
    /// Distance between the two anchors of the joint when the step begins. Unit: length units, >= 0.
    initial_error: f64,
    /// Largest geometric stiffness of the body that is stable in a substep; infinite for a fixed root. Unit: mass units * length
    /// units^2.
    stable_stiffness: f64,
    /// Excess of the geometric stiffness over the stable limit, added to the moment of inertia. Unit: mass units * length
    /// units^2, >= 0.
    added_stiffness: f64,
    /// Least geometric stiffness that counts as a [jump](Self::stiffness_jumped). Unit: mass units * length units^2.
    jump_stiffness: f64,
    /// Amount of `added_stiffness` that [carries momentum](super::substep_plan::momentum_carrying_stiffness). Unit: mass units
    /// * length units^2, >= 0.
    momentum_stiffness: f64,
    /// Mass of the body. Unit: mass units.
    mass: f64,
    /// Moment of inertia about the centre of mass. Unit: mass units * length units^2.
    inertia: f64,
    /// Sign of the joint force on this body: 1 for the second body of the joint, -1 for the first. Dimensionless.
    sign: f64,
    /// Sum of both arms and the radius of gyration: joint errors are compared with it. Unit: length units.
    reach: f64,
    /// Index of the body into the arrays of `BodySet`; 0 for the world.
    body: BodyIndex,
    /// Index of the parent in the list of links.
    parent: LinkIndex,
    /// Index of the joint with the parent into `JointSystem::constraints`.
    joint: JointIndex,
    /// `Point` for a body with a revolute joint to its parent; roots are `Free` or `Fixed`.
    locked: LockedDofs,
    /// Whether this body is the first body of the joint, and the parent the second.
    is_first: bool,
}

impl TreeNode for RevoluteLink {
    #[inline(always)]
    fn parent(&self) -> LinkIndex {
        self.parent
    }
}

impl BalancedLink for RevoluteLink {
    fn state(&self) -> LinkEndState {
        let RevoluteLink { locked, mass, inertia, delta_pose, position, velocity, force_delta, .. } = *self;
        LinkEndState { locked, mass, inertia, delta_pose, position, velocity, force_delta }
    }

    fn set_velocity(&mut self, velocity: [f64; 3]) {
        self.velocity = velocity;
    }

    fn max_rounding_work(&self, dt: f64) -> f64 {
        dot(self.total_impulse, self.total_impulse).sqrt() / dt
            * max_rounding_error(self.position, dot(self.arm, self.arm).sqrt())
    }

    fn max_closing_work(&self, _: &Self, dt: f64) -> f64 {
        dot(self.total_impulse, self.total_impulse).sqrt() / dt * self.initial_error
    }

    fn joint_velocity_error(&self, parent: &Self) -> f64 {
        if !self.locked.is_joint() {
            return 0.0;
        }
        let at = |[x, y, spin]: [f64; 3], arm: Vec2| add_scaled([x, y], perp(arm), spin);
        let relative_velocity =
            add_scaled(at(self.velocity, self.arm), at(parent.velocity, self.parent_arm), -1.0);
        dot(relative_velocity, relative_velocity).sqrt()
    }

    fn joint_error_growth(&self, parent: &Self) -> f64 {
        if !self.locked.is_joint() {
            return 0.0;
        }
        let offset = self.anchor_offset(parent);
        let growth = dot(offset, offset).sqrt() - self.initial_error;
        if growth > 0.0 { growth / self.reach } else { 0.0 }
    }

    fn has_joint_error_above(&self, error: f64) -> bool {
        self.initial_error > error * self.reach
    }
}

/// Moves a free tree of this size through all substeps of a step. Returns the number of substeps.
///
/// Writes velocities and displacements of `bodies`, and errors and forces of `constraints`. Repeats the step with more substeps
/// if its energy error is too large. `length_unit` is the length unit of the simulator.
pub(super) fn step_revolute_tree(
    (links, size): (&mut Links<RevoluteLink>, ArticulationSize),
    constraints: &mut JointList,
    bodies: &mut BodySet,
    step: &StepContext,
    length_unit: f64,
) -> u32 {
    let dt = f64::from(step.dt);
    let mut plan = begin_step((links, size), constraints, bodies, step);
    loop {
        let start = run_substeps(links, (constraints, bodies), step, &plan, length_unit);
        let balance = plan.energy_balance(links, start, dt);
        let Some(refined) = balance.and_then(|balance| plan.refined(&balance)) else {
            balance.inspect(|balance| balance.project_energy(links));
            break;
        };
        begin_step((links, size), constraints, bodies, step);
        plan = refined;
    }
    if !plan.is_kick_drift {
        // In reverse order, because the last links are still in the cache.
        for link in links.iter_mut().rev() {
            let force = link.total_impulse.map(|impulse| impulse / dt);
            link.store(constraints, bodies, (link.velocity, link.delta_pose, force));
        }
    }
    plan.substeps
}

/// Sets the links to the state at the start of a step, and returns the plan of the articulation's substeps.
fn begin_step(
    (links, size): (&mut Links<RevoluteLink>, ArticulationSize),
    constraints: &mut JointList,
    bodies: &BodySet,
    step: &StepContext,
) -> SubstepPlan {
    let dt = f64::from(step.dt);
    let (mut spins, mut has_large_error) = ([0.0; 2], false);
    if size.is_balanced {
        for_each_down(links, |link, parent| link.begin_step(parent, constraints, bodies, (dt, true)));
        for link in links.iter_mut() {
            if link.body == BodyIndex::PLACEHOLDER {
                link.joint_spin_change = 0.0;
                continue;
            }
            link.joint_spin_change *= dt / link.inertia;
            has_large_error |= link.has_joint_error_above(MAX_WHIP_JOINT_ERROR);
            spins = max_spins(spins, link.velocity[2], link.joint_spin_change);
        }
    } else {
        for_each_down(links, |link, parent| {
            link.begin_step(parent, constraints, bodies, (dt, false));
            let spin = if link.body == BodyIndex::PLACEHOLDER { 0.0 } else { link.velocity[2].abs() };
            spins[0] = if spin > spins[0] { spin } else { spins[0] };
        });
    }
    let plan = SubstepPlan::of(size, step, spins, |ratio| {
        let bears = IMPLICIT_STIFFNESS_RATIO * ratio;
        links.iter().any(|link| link.geometric_stiffness > bears * link.stable_stiffness)
    });
    SubstepPlan { predicts_spin: plan.predicts_spin && !has_large_error, ..plan }
}

/// Runs all substeps of a step. Returns the energy at the start of the step, or `None` if the articulation gets no energy
/// balance. Without a balance the last substep also stores the results in `constraints` and `bodies`.
fn run_substeps(
    links: &mut Links<RevoluteLink>,
    (constraints, bodies): (&mut JointList, &mut BodySet),
    step: &StepContext,
    plan: &SubstepPlan,
    length_unit: f64,
) -> Option<InitialEnergy> {
    let SubstepPlan { substeps, is_kick_drift, max_prediction_error, predicts_spin, .. } = *plan;
    let dt = f64::from(step.dt);
    let h = dt / f64::from(substeps);
    let limits = SubstepLimits { h, length_unit, max_spin_error: max_prediction_error / h };
    let times = (step.dt, substeps as f32, step.substeps as f32);
    let start = if is_kick_drift {
        let begin = |link: &mut RevoluteLink, bodies: &mut BodySet| {
            link.scale_to_substep(bodies, times, false);
            link.apply_forces(1.0, false);
        };
        let end = |link: &RevoluteLink, bodies: &mut BodySet| {
            if substeps == 1 {
                link.store_kick_drift(constraints, bodies, (h, dt));
            }
        };
        solve_substep(links, bodies, limits, begin, end);
        None
    } else {
        links.iter_mut().for_each(|link| link.scale_to_substep(bodies, times, true));
        let start = InitialEnergy::of(links);
        solve_substep(links, bodies, limits, |link, _| link.apply_forces(0.5, predicts_spin), |_, _| {});
        Some(start)
    };
    run_further_substeps(links, (constraints, bodies), plan, limits, dt);
    if !is_kick_drift {
        for_each_down(links, |link, parent| link.integrate_position(parent, h));
        project_velocities(links);
    }
    start
}

/// Runs all substeps but the first of a step of `dt` seconds. `limits` are those of each substep.
fn run_further_substeps(
    links: &mut Links<RevoluteLink>,
    (constraints, bodies): (&mut JointList, &mut BodySet),
    plan: &SubstepPlan,
    limits: SubstepLimits,
    dt: f64,
) {
    let SubstepPlan { substeps, is_kick_drift, predicts_spin, .. } = *plan;
    for substep in 1..substeps {
        let share = if substep == 1 && !is_kick_drift { 0.5 } else { 1.0 };
        for_each_down(links, |link, parent| {
            link.record_joint_spin_change(predicts_spin, share);
            link.integrate_position(parent, limits.h);
        });
        let is_stored = is_kick_drift && substep + 1 == substeps;
        let end = |link: &RevoluteLink, bodies: &mut BodySet| {
            if is_stored {
                link.store_kick_drift(constraints, bodies, (limits.h, dt));
            }
        };
        solve_substep(links, bodies, limits, |link, _| link.apply_forces(1.0, predicts_spin), end);
    }
}

/// Applies the second half of the last force kick (velocity change by applied forces), and projects the velocities on the
/// joints (RATTLE).
fn project_velocities(links: &mut Links<RevoluteLink>) {
    let begin = |link: &mut RevoluteLink| {
        link.apply_forces(0.5, false);
        (link.target_velocity, link.added_stiffness, link.momentum_stiffness) = ([0.0; 2], 0.0, 0.0);
        link.init_own();
    };
    for_each_up_prepared(links, begin, RevoluteLink::propagate_up);
    for_each_down(links, |link, parent| {
        match parent {
            Some(parent) => link.propagate_down(parent),
            None => link.solve_root(),
        }
        link.apply_solution();
    });
}

/// Length and tolerances of a substep.
#[derive(Clone, Copy)]
struct SubstepLimits {
    /// Length of the substep. Unit: seconds, > 0.
    h: f64,
    /// Length unit of the simulator. Unit: the user's units of length, > 0.
    length_unit: f64,
    /// Largest accepted deviation of an angular velocity from its prediction. Unit: radians/s, >= 0.
    max_spin_error: f64,
}

/// Solves a substep for the velocities with which the joints hold at the end of the substep. `begin` is called with each link
/// before the solve, and `end` with each link after each solve; both get `bodies`.
///
/// The solve is repeated once if a body's rotation deviates from the prediction. It is repeated up to
/// [`STIFFNESS_JUMP_RETRIES`] times while the [stiffness jumps](RevoluteLink::stiffness_jumped).
fn solve_substep(
    links: &mut Links<RevoluteLink>,
    bodies: &mut BodySet,
    SubstepLimits { h, length_unit, max_spin_error }: SubstepLimits,
    begin: impl Fn(&mut RevoluteLink, &mut BodySet),
    mut end: impl FnMut(&RevoluteLink, &mut BodySet),
) {
    let correction = (-1.0 / h, JOINT_CORRECTION_SPEED * h * length_unit);
    let mut has_jump = false;
    for iteration in 0..=STIFFNESS_JUMP_RETRIES {
        let prepare = |link: &mut RevoluteLink| {
            if iteration == 0 {
                begin(link, bodies);
            } else {
                link.adopt_solution(has_jump);
            }
            link.prepare_substep(h);
        };
        for_each_up_prepared(links, prepare, |link, parent| {
            link.set_target_velocity(parent, correction);
            link.propagate_up(parent);
        });
        let (mut is_mispredicted, mut may_have_jump) = (false, false);
        for_each_down(links, |link, parent| {
            may_have_jump |= link.solve(parent, h);
            is_mispredicted |= (link.joint_velocity[2] - link.predicted_spin).abs() > max_spin_error;
            end(link, bodies);
        });
        // The stiffness of a parent is complete after its last child.
        has_jump = may_have_jump && links.iter().any(RevoluteLink::stiffness_jumped);
        if !(has_jump || (iteration == 0 && is_mispredicted)) {
            break;
        }
    }
}
