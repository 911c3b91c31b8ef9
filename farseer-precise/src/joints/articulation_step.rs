//! Step of a free articulation: a tree of joints whose bodies have no contacts. SHAKE with RATTLE in its own substeps, on top
//! of the [articulated-body algorithm](super::articulated_body).
//!
//! **Positions.** A substep of h seconds solves for the velocity v' with which the joints hold at its *end*: C(x + h v') = 0,
//! with the joint error C and positions x. Linearised about the velocity v before joint impulses this is J v' = J v - C(x + h
//! v) / h. All of v cancels but the angular velocity w: each side of a joint contributes (x + R r) / h - w p. Here r is the
//! vector from the centre of mass to the anchor, R the rotation of the body in the substep, and p = (-r.y, r.x). This is SHAKE
//! (J.-P. Ryckaert, G. Ciccotti, H. Berendsen 1977) with one iteration, or two.
//!
//! **Velocities.** Forces act by halves at the start and the end of a step (kick-drift-kick, as in a leapfrog). After the last
//! substep the velocity is projected on the joints (RATTLE, H. C. Andersen 1983). One projection suffices, since SHAKE and
//! RATTLE visit the same positions (B. Leimkuhler, R. Skeel, "Symplectic numerical integrators in constrained Hamiltonian
//! systems", 1994). Articulations without an energy balance get full kicks at the start instead, without the projection.
//!
//! RATTLE is symplectic, without energy drift, in a limit only: joints solved to convergence, and a constant number of substeps.
//! Here a substep ends after a few iterations, and the number of substeps follows the motion. The [energy
//! balance](super::energy_balance) bounds the drift of articulations that get one: see `ArticulationSize` in `substep_plan`.
//!
//! **Geometric stiffness** above the stable limit occurs in a whip. That of a body is added to the inertia, that of a [rod](super::rod)
//! to the coupling of its two bodies. Most of the added stiffness carries momentum, so that little energy is lost.
//!
//! The module reads the links, joint constraints and forces of [`BodySet`]. It writes velocities, displacements and joint
//! impulses of the links.

use super::super::bodies::BodySet;
use super::super::scaled_parameters::StepContext;
use super::articulated_body::{
    ArticulatedLink, Links, for_each_down, propagate_down, propagate_momentum_up, propagate_up,
};
use super::energy_balance::{BalancedLink, InitialEnergy};
use super::joint_constraint::JointList;
use super::link_state::begin_links;
use super::locked_dofs::LockedDofs;
use super::rod::RodState;
use super::substep_plan::{ArticulationSize, SubstepPlan, max_spins};
use crate::index::BodyIndex;
use crate::parameters::joints::{IMPLICIT_STIFFNESS_RATIO, MAX_WHIP_JOINT_ERROR, STIFFNESS_JUMP_RETRIES};

/// Raises the added stiffness of each body to the present excess of its geometric stiffness over the stable limit, after a
/// [jump](ArticulatedLink::stiffness_jumped).
///
/// Joint tension acts as a stiffness against rotation, which an explicit substep cannot integrate beyond a limit: a chain that
/// carries much more than its own weight would be torn apart. The excess is added to the inertia, as an implicit step does (M.
/// Tournier et al., "Stable constrained dynamics", 2015; S. Andrews et al., "Geometric stiffness for real-time constrained
/// multibody dynamics", 2017).
fn raise_added_stiffness(links: &mut Links<ArticulatedLink>) {
    for link in links.iter_mut() {
        let excess = link.excess_stiffness();
        link.added_stiffness = if excess > link.added_stiffness { excess } else { link.added_stiffness };
        link.rod.raise_added_stiffness();
    }
}

/// Computes the geometric stiffness of all links from the joint impulses of a substep of `h` seconds. Unit: mass units * length
/// units^2.
fn compute_geometric_stiffness(links: &mut Links<ArticulatedLink>, h: f64) {
    for_each_down(links, |link, parent| link.accumulate_stiffness(parent, h));
}

/// Moves a free tree through all substeps of a step, and repeats the step with more substeps if its energy error is too large.
/// Returns the number of substeps.
///
/// Forces of springs and of the game may depend on the position. They act in full at the start of the step, as for bodies
/// without joints. `length_unit` is the length unit of the simulator.
pub(super) fn step_free_tree(
    (links, size): (&mut Links<ArticulatedLink>, ArticulationSize),
    constraints: &JointList,
    bodies: &BodySet,
    step: &StepContext,
    length_unit: f64,
) -> u32 {
    let dt = f64::from(step.dt);
    let mut plan = begin_step((links, size), constraints, bodies, step);
    loop {
        let start = run_substeps(links, bodies, step, &plan, length_unit);
        let balance = plan.energy_balance(links, start, dt);
        let Some(refined) = balance.and_then(|balance| plan.refined(&balance)) else {
            balance.inspect(|balance| balance.project_energy(links));
            break;
        };
        begin_step((links, size), constraints, bodies, step);
        plan = refined;
    }
    plan.substeps
}

/// Sets the links to the state at the start of a step, and returns the plan of the articulation's substeps.
fn begin_step(
    (links, size): (&mut Links<ArticulatedLink>, ArticulationSize),
    constraints: &JointList,
    bodies: &BodySet,
    step: &StepContext,
) -> SubstepPlan {
    let (dt, substeps) = (f64::from(step.dt), f64::from(step.substeps));
    begin_links(links, constraints, bodies, f64::from(step.h));
    let rod_spin = begin_rods(links);
    // The impulse of one undivided step is `substeps` times that of a solver substep.
    compute_geometric_stiffness(links, dt * substeps);
    for_each_down(links, |link, parent| {
        link.initial_error = parent.as_deref().map_or(0.0, |parent| link.relative_joint_error(parent));
        link.accumulate_joint_torque(parent);
    });
    let (mut spins, mut has_large_error) = ([rod_spin, 0.0], false);
    for link in links.iter_mut() {
        if link.body == BodyIndex::PLACEHOLDER {
            link.joint_spin_change = 0.0;
            continue;
        }
        has_large_error |= link.has_joint_error_above(MAX_WHIP_JOINT_ERROR);
        link.joint_spin_change *= substeps / link.inertia;
        spins = max_spins(spins, link.velocity[2], link.joint_spin_change);
    }
    let plan = SubstepPlan::of(size, step, spins, |ratio| {
        links.iter().any(|link| link.is_stiffer(IMPLICIT_STIFFNESS_RATIO * ratio))
    });
    SubstepPlan { predicts_spin: plan.predicts_spin && !has_large_error, ..plan }
}

/// Begins the step of all distance joints. Returns the greatest angular velocity of one, in radians/s, >= 0.
fn begin_rods(links: &mut Links<ArticulatedLink>) -> f64 {
    let mut greatest = 0.0;
    for_each_down(links, |link, parent| {
        if let Some(parent) = parent.filter(|_| link.locked == LockedDofs::Distance) {
            greatest = link.begin_rod(parent).max(greatest);
        }
    });
    greatest
}

/// Runs all substeps of a step with as few passes over the links as possible. Returns the energy at the start of the step, or
/// `None` if the articulation gets no energy balance.
fn run_substeps(
    links: &mut Links<ArticulatedLink>,
    bodies: &BodySet,
    step: &StepContext,
    plan: &SubstepPlan,
    length_unit: f64,
) -> Option<InitialEnergy> {
    let SubstepPlan { substeps, is_kick_drift, max_prediction_error, predicts_spin, .. } = *plan;
    let (dt, solver_substeps) = (f64::from(step.dt), f64::from(step.substeps));
    let h = dt / f64::from(substeps);
    for link in links.iter_mut() {
        link.scale_to_substep(bodies, (dt, f64::from(substeps)), solver_substeps / f64::from(substeps));
    }
    let start = (!is_kick_drift).then(|| InitialEnergy::of(links));
    for substep in 0..substeps {
        let share = if substep == 0 && !is_kick_drift { 0.5 } else { 1.0 };
        for link in links.iter_mut() {
            link.apply_forces(share);
            let joint_spin_change = if predicts_spin { link.predicted_spin_change() } else { 0.0 };
            (link.unconstrained_velocity, link.predicted_spin) =
                (link.velocity, link.velocity[2] + share * joint_spin_change);
            link.rod.begin_substep();
        }
        solve_substep(links, (h, length_unit), max_prediction_error / h);
        for_each_down(links, |link, parent| {
            if predicts_spin {
                link.joint_spin_change = (link.velocity[2] - link.unconstrained_velocity[2]) / share;
            }
            link.accumulate_impulse();
            link.integrate_position(parent, h);
        });
    }
    if !is_kick_drift {
        project_velocities(links);
    }
    start
}

/// Applies the second half of the last force kick (velocity change by applied forces), and projects the velocities on the
/// joints (RATTLE).
fn project_velocities(links: &mut Links<ArticulatedLink>) {
    for link in links.iter_mut() {
        link.apply_forces(0.5);
        link.clear_target_velocity();
        link.rod = RodState::default();
        link.init_own(0.0);
    }
    propagate_up(links);
    propagate_down(links);
    links.iter_mut().for_each(ArticulatedLink::accumulate_impulse);
}

/// Predicts the velocities across all distance joints in a repeated solve by those of the last one. Returns whether an angular
/// velocity of a rod deviates from its last prediction by more than `max_spin_error`, in radians/s.
fn predict_rods(links: &mut Links<ArticulatedLink>, max_spin_error: f64) -> bool {
    let mut deviates = false;
    for_each_down(links, |link, parent| {
        if let Some(parent) = parent.filter(|_| link.locked == LockedDofs::Distance) {
            deviates |= link.predict_rod(parent) > max_spin_error;
        }
    });
    deviates
}

/// Solves a substep of `h` seconds for the velocities with which the joints hold at the end of the substep.
///
/// The solve is repeated once if a body's rotation deviates from the prediction. It is repeated up to
/// [`STIFFNESS_JUMP_RETRIES`] times while the [stiffness jumps](ArticulatedLink::stiffness_jumped) or the rotation of a rod
/// deviates. `max_spin_error` is the
/// largest accepted deviation of an angular velocity, in radians/s.
fn solve_substep(links: &mut Links<ArticulatedLink>, (h, length_unit): (f64, f64), max_spin_error: f64) {
    let mut has_stiffness_jump = true;
    for iteration in 0..=STIFFNESS_JUMP_RETRIES {
        for_each_down(links, |link, parent| {
            link.set_target_velocity(parent, h, length_unit);
            link.init_own_momentum(link.unconstrained_velocity, link.momentum_stiffness());
        });
        if has_stiffness_jump {
            links.iter_mut().for_each(|link| link.init_own_inertia(1.0));
            propagate_up(links);
        } else {
            propagate_momentum_up(links);
        }
        propagate_down(links);
        compute_geometric_stiffness(links, h);
        has_stiffness_jump = links.iter().any(ArticulatedLink::stiffness_jumped);
        let is_mispredicted =
            |link: &ArticulatedLink| (link.velocity[2] - link.predicted_spin).abs() > max_spin_error;
        let has_rod_error = predict_rods(links, max_spin_error);
        let repeats =
            has_stiffness_jump || has_rod_error || (iteration == 0 && links.iter().any(is_mispredicted));
        if iteration == STIFFNESS_JUMP_RETRIES || !repeats {
            break;
        }
        if has_stiffness_jump {
            raise_added_stiffness(links);
        }
        for link in links.iter_mut() {
            (link.predicted_spin, link.velocity) = (link.velocity[2], link.unconstrained_velocity);
        }
    }
}
