//! Iterative solver: contacts, joints and springs in substeps.
//!
//! A substep is that of Box2D 3's "Soft Step" (E. Catto, "Solver2D", 2024), on the substeps of M. Macklin et al., "Small Steps
//! in Physics Simulation" (2019):
//!
//! 1. apply forces and the warm start (`apply_warm_start`);
//! 2. solve joints, then contacts as soft constraints with bias (`solve_with_bias`);
//! 3. integrate positions (`integrate_positions`);
//! 4. relaxation: solve joints and contacts as rigid constraints without bias (`relax`).
//!
//! After the last substep restitution is applied (`apply_restitution`).

use std::ops::Range;

use crate::bodies::{BodySet, MotionState};
use crate::broad_phase::pairs::Pairs;
use crate::broad_phase::proxies::Proxies;
use crate::constraint_graph::{ColorUsage, ConstraintGraph, ConstraintGraph3};
use crate::contact_solver::held_contacts::{HeldContacts, hold_deep_contacts};
use crate::contact_solver::restitution::apply_restitution;
use crate::contact_solver::rolling::{RollingContact, RollingSolver};
use crate::contact_solver::rolling_resistance::{
    RollingRow, list_rolling_rows, relax_rolling, store_rolling, warm_start_rolling,
};
use crate::contact_solver::soft_step::{ContactSubstep, relax, solve_with_bias, solve_with_joint_softness};
use crate::contact_solver::warm_start::accumulate_warm_start;
use crate::depth::feature_gate::FeatureGate;
use crate::depth::state::DepthState;
use crate::index::{IndexedVec, ProxyIndex};
use crate::integration::{
    apply_midpoint_correction, apply_warm_start, integrate_free_flight, integrate_positions, resolve_bounce,
};
use crate::joints::JointSystem;
use crate::joints::springs::SpringRows;
use crate::parameters::contacts::{JOINTED_RESTITUTION_MAX_SWEEPS, JOINTED_RESTITUTION_TOLERANCE};
use crate::scaled_parameters::{Parameters, StepContext};

/// The parts of the engine that the iterative solver reads and writes.
pub(crate) struct IterativeSolver<'a> {
    pub(crate) bodies: &'a mut BodySet,
    pub(crate) constraints: &'a mut ConstraintGraph,
    pub(crate) color_usage: &'a ColorUsage,
    pub(crate) joints: &'a mut JointSystem,
    pub(crate) springs: &'a SpringRows,
    pub(crate) proxies: &'a Proxies,
    pub(crate) pairs: &'a mut Pairs,
    pub(crate) depth: Option<FeatureGate<&'a mut DepthState>>,
    pub(crate) parameters: &'a Parameters,
    /// Index ranges of the awake bodies.
    pub(crate) awake_body_runs: &'a [Range<usize>],
    /// Contacts of polygons that roll over a static face in this step.
    pub(crate) rolling_contacts: &'a mut Vec<RollingContact>,
    /// Rows of rolling resistance; empty without it.
    pub(crate) rolling_rows: &'a mut Vec<RollingRow>,
    /// Workspace with an entry for each proxy, all false.
    pub(crate) proxy_flags: &'a mut IndexedVec<ProxyIndex, bool>,
    /// Whether any contact may have restitution.
    pub(crate) has_restitution: bool,
    /// Approach speed below which contacts do not bounce, length units/s, >= 0.
    pub(crate) restitution_threshold: f32,
}

impl IterativeSolver<'_> {
    /// Runs the iterative solver: substeps, then the midpoint correction of the displacements, then restitution. Returns whether
    /// the substeps had contacts.
    pub(crate) fn solve(&mut self, step: &StepContext) -> bool {
        self.joints.begin_iterative(self.springs, self.bodies, step);
        let is_planar = self.depth.is_none();
        if is_planar {
            self.prepare_rolling(step);
            if self.has_only_pivots() {
                self.integrate_beside_pivots(step);
                return false;
            }
        }
        let may_bounce = self.accumulate_warm_start(step);
        let contact_substep = ContactSubstep {
            inverse_h: 1.0 / step.h,
            max_bias_speed: self.parameters.recovery_speed,
            records_active_points: may_bounce,
            has_contacts: !self.constraints.is_empty(),
        };
        self.begin_rolling_resistance(is_planar);
        self.warm_start_hinges();
        if !is_planar {
            self.prepare_rolling(step);
        }
        let has_joints = self.joints.act_in_substeps();
        for substep in 0..step.substeps {
            self.begin_substep(step, substep == 0);
            self.solve_with_bias(step, contact_substep, has_joints);
            integrate_positions(self.bodies, self.awake_body_runs, step.h, substep == 0);
            self.relax(step, contact_substep, has_joints);
            self.relax_rolling_resistance();
        }
        self.end_rolling_resistance();
        self.correct_displacements(step);
        if may_bounce {
            self.apply_restitution(step);
        }
        true
    }

    /// Lists the rows of rolling resistance, and adds their impulses to the warm start; none in three axes.
    #[inline(never)]
    fn begin_rolling_resistance(&mut self, is_planar: bool) {
        if is_planar && self.proxies.resist_rolling {
            list_rolling_rows(self.rolling_rows, self.pairs, self.proxies, self.constraints);
            warm_start_rolling(self.rolling_rows, self.bodies);
        }
    }

    /// Solves rolling resistance once, after the contacts of a relaxation.
    #[inline(never)]
    fn relax_rolling_resistance(&mut self) {
        relax_rolling(self.rolling_rows, self.constraints, &mut self.bodies.states);
    }

    /// Stores the impulses of rolling resistance in the pairs, and clears the list of rows.
    #[inline(never)]
    fn end_rolling_resistance(&mut self) {
        store_rolling(self.rolling_rows, self.pairs);
        self.rolling_rows.clear();
    }

    /// Finds the rolling contacts of this step, and among them the polygons that pivot in closed form.
    fn prepare_rolling(&mut self, step: &StepContext) {
        if !self.rolling_contacts.is_empty() {
            let (mut rolling_solver, rolling) = self.rolling_solver();
            rolling_solver.prepare(rolling, step);
        }
    }

    /// Returns whether polygons that pivot in closed form have all contacts of the iterative solver, and joints have no part in
    /// it. Substeps of contacts would have no effect then, since the closed form replaces their results.
    fn has_only_pivots(&mut self) -> bool {
        if self.rolling_contacts.is_empty() || self.has_restitution || self.joints.act_in_substeps() {
            return false;
        }
        let constraint_count = self.constraints.planar_count();
        let (rolling_solver, rolling) = self.rolling_solver();
        rolling_solver.count_pivot_constraints(rolling) == constraint_count
    }

    /// Moves all bodies through a step in which no contact or joint of the iterative solver acts: pivoting polygons as the closed
    /// form says, all other bodies in free flight.
    fn integrate_beside_pivots(&mut self, step: &StepContext) {
        integrate_free_flight(self.bodies, self.awake_body_runs, step);
        let (mut rolling_solver, rolling) = self.rolling_solver();
        rolling_solver.save_delta_poses(rolling);
        rolling_solver.restore_delta_poses(rolling);
    }

    /// Start of a substep: applies the warm start of all bodies, and moves the points of rolling contacts. `is_first`: whether the
    /// substep is the first of the step.
    fn begin_substep(&mut self, step: &StepContext, is_first: bool) {
        self.apply_hinge_springs(step.h, is_first);
        if !self.rolling_contacts.is_empty() {
            let (mut rolling_solver, rolling) = self.rolling_solver();
            rolling_solver.begin_substep(rolling, step, is_first);
        }
        apply_warm_start(self.bodies, self.awake_body_runs, is_first);
        self.apply_spin_warm_start(is_first);
    }

    /// Solves joints, hinges and contacts with bias, before positions are integrated. `has_joints`: whether joints act in the
    /// substeps. Deep contacts [prevail](hold_deep_contacts) over joints with large errors.
    fn solve_with_bias(&mut self, step: &StepContext, substep: ContactSubstep, has_joints: bool) {
        if has_joints {
            self.joints.solve_with_bias(self.bodies, step.h);
        }
        self.solve_hinge_stops(step.h);
        match self.depth {
            None if !substep.has_contacts => {}
            None => solve_contacts_with_bias(
                self.constraints,
                &mut self.bodies.states,
                self.joints.iterative_body_masks(),
                step,
                substep,
            ),
            Some(_) => self.solve_with_bias_3d(step, substep),
        }
        if has_joints && substep.has_contacts && self.joints.has_large_iterative_error() {
            self.hold_deep_contacts(step, substep);
        }
        self.solve_hinge_stops(step.h);
        if has_joints {
            self.joints.equalize_z_velocity(self.bodies);
            self.joints.limit_speeds(self.bodies, step.h);
        }
    }

    /// Separates the contact points that joints have pressed too deep into static and kinematic bodies.
    #[inline(never)]
    fn hold_deep_contacts(&mut self, step: &StepContext, substep: ContactSubstep) {
        let IterativeSolver { joints, bodies, constraints, parameters, .. } = self;
        let (masks, held_bodies) = joints.masks_of_held_bodies();
        let held = HeldContacts {
            masks,
            min_extents: bodies.min_extents.slice(..),
            max_depth: parameters.speculative_distance,
            bias_rate: step.jointed_static_softness.bias_rate,
            max_bias_speed: substep.max_bias_speed,
        };
        let states = &mut bodies.states;
        let ConstraintGraph { two_points, one_point, two_points_static, one_point_static, depth, .. } =
            &mut **constraints;
        hold_deep_contacts::<false, 2, _>(two_points, states, held, held_bodies);
        hold_deep_contacts::<false, 1, _>(one_point, states, held, held_bodies);
        hold_deep_contacts::<true, 2, _>(two_points_static, states, held, held_bodies);
        hold_deep_contacts::<true, 1, _>(one_point_static, states, held, held_bodies);
        let ConstraintGraph3 { prisms, balls, prisms_static, balls_static } = depth;
        hold_deep_contacts::<false, 2, _>(prisms, states, held, held_bodies);
        hold_deep_contacts::<false, 1, _>(balls, states, held, held_bodies);
        hold_deep_contacts::<true, 2, _>(prisms_static, states, held, held_bodies);
        hold_deep_contacts::<true, 1, _>(balls_static, states, held, held_bodies);
    }

    /// Relaxation of joints, contacts and hinges, after positions are integrated: removes the velocity by which the bias resolved
    /// errors. `has_joints`: whether joints act in the substeps.
    fn relax(&mut self, step: &StepContext, substep: ContactSubstep, has_joints: bool) {
        self.update_hinge_angles();
        if !self.rolling_contacts.is_empty() {
            let (mut rolling_solver, rolling) = self.rolling_solver();
            rolling_solver.set_relax_separations(rolling);
        }
        if has_joints {
            self.joints.update_anchors(self.bodies, step.h);
            self.joints.relax(self.bodies, step.h);
        }
        match self.depth {
            None if !substep.has_contacts => {}
            None => relax_contacts(self.constraints, &mut self.bodies.states, substep),
            Some(_) => self.relax_3d(substep),
        }
        self.solve_hinge_stops(step.h);
        if has_joints {
            self.joints.equalize_z_velocity(self.bodies);
        }
    }

    /// Applies the midpoint correction to the displacements of the step, except to those of rolling polygons.
    fn correct_displacements(&mut self, step: &StepContext) {
        let has_rolling_contacts = !self.rolling_contacts.is_empty();
        if has_rolling_contacts {
            let (rolling_solver, rolling) = self.rolling_solver();
            rolling_solver.save_delta_poses(rolling);
        }
        apply_midpoint_correction(
            self.bodies,
            self.awake_body_runs,
            (self.color_usage, self.joints),
            self.parameters.speculative_distance,
            step,
        );
        if has_rolling_contacts {
            let (mut rolling_solver, rolling) = self.rolling_solver();
            rolling_solver.restore_delta_poses(rolling);
        }
    }

    /// Stores velocities and impulses of the polygons that have pivoted in closed form, after the last substep.
    /// `has_contact_substeps`: see [`solve`](Self::solve).
    pub(crate) fn store_pivots(&mut self, step: &StepContext, has_contact_substeps: bool) {
        if self.rolling_contacts.is_empty() {
            return;
        }
        let (mut solver, rolling) = self.rolling_solver();
        for roll in rolling {
            if let Some(after) = roll.pivot {
                solver.store_pivot(roll, &after, step, has_contact_substeps);
            }
        }
    }

    /// Returns the solver of rolling contacts, with the list of these contacts.
    fn rolling_solver(&mut self) -> (RollingSolver<'_>, &mut Vec<RollingContact>) {
        let solver = RollingSolver {
            bodies: self.bodies,
            proxies: self.proxies,
            pairs: self.pairs,
            constraints: self.constraints,
            joints: self.joints,
            parameters: self.parameters,
            is_planar: self.depth.is_none(),
            proxy_flags: self.proxy_flags,
        };
        (solver, self.rolling_contacts)
    }

    /// Warm start: sums into `bodies.warm_start` the velocity changes by the accumulated impulses of all contacts and joints of
    /// each body. Load adaptation of the contacts runs in this loop, too, and constraints with restitution store their approach
    /// velocities. Returns whether an approach speed exceeds the restitution threshold.
    fn accumulate_warm_start(&mut self, step: &StepContext) -> bool {
        let (warm_start, states) = (&mut self.bodies.warm_start, &self.bodies.states);
        self.awake_body_runs.iter().for_each(|run| warm_start.slice_mut(run.clone()).fill([0.0; 4]));
        let may_bounce = if self.depth.is_some() {
            self.accumulate_warm_start_3d(step)
        } else {
            let adaptation = (&step.load_adaptation, self.joints.iterative_body_masks());
            let threshold = self.has_restitution.then_some(self.restitution_threshold);
            let ConstraintGraph { two_points, one_point, two_points_static, one_point_static, .. } =
                self.constraints;
            accumulate_warm_start::<false, 2>(two_points, warm_start, states, adaptation, threshold)
                | accumulate_warm_start::<false, 1>(one_point, warm_start, states, adaptation, threshold)
                | accumulate_warm_start::<true, 2>(
                    two_points_static,
                    warm_start,
                    states,
                    adaptation,
                    threshold,
                )
                | accumulate_warm_start::<true, 1>(
                    one_point_static,
                    warm_start,
                    states,
                    adaptation,
                    threshold,
                )
        };
        self.joints.add_warm_start(self.bodies);
        may_bounce
    }

    /// Applies restitution after the substeps.
    ///
    /// An impact on one body of an articulation changes the velocities of all its bodies. Gauss-Seidel sweeps over contacts and
    /// joints compute these velocities. A last sweep over the contacts then separates the bodies.
    fn apply_restitution(&mut self, step: &StepContext) {
        if self.joints.iterative_body_masks().is_some() {
            for _ in 0..JOINTED_RESTITUTION_MAX_SWEEPS {
                self.joints.begin_restitution();
                self.restitution_sweep(step, false);
                if self.joints.apply_restitution(self.bodies)
                    <= JOINTED_RESTITUTION_TOLERANCE * self.parameters.restitution_threshold
                {
                    break;
                }
            }
        }
        self.restitution_sweep(step, true);
    }

    /// Applies restitution once to all contacts of the iterative solver. In the last sweep (`is_last`) two bodies that have no
    /// other contact or joint bounce in closed form: [`resolve_bounce`].
    fn restitution_sweep(&mut self, step: &StepContext, is_last: bool) {
        if self.depth.is_some() {
            return self.apply_restitution_3d(step, is_last);
        }
        let threshold = self.restitution_threshold;
        let IterativeSolver { constraints, bodies, color_usage, joints, .. } = self;
        let mut states = std::mem::take(&mut bodies.states);
        macro_rules! bounce_all {
            ($fixed:literal, $points:literal, $rows:expr) => {
                apply_restitution::<$fixed, $points, _>(
                    $rows,
                    &mut states,
                    threshold,
                    |row, lanes, states| {
                        if is_last {
                            resolve_bounce(bodies, states, (color_usage, joints), step, row, lanes)
                        } else {
                            joints.record_restitution(row, lanes)
                        }
                    },
                )
            };
        }
        bounce_all!(false, 2, &mut constraints.two_points);
        bounce_all!(false, 1, &mut constraints.one_point);
        bounce_all!(true, 2, &mut constraints.two_points_static);
        bounce_all!(true, 1, &mut constraints.one_point_static);
        bodies.states = states;
    }
}

/// Solves all contacts of the iterative solver in the plane as soft constraints, with a bias velocity that resolves penetration.
/// `masks`: for each body all bits set if it has joints in the iterative solver, else 0; `None` if no body has.
fn solve_contacts_with_bias(
    constraints: &mut ConstraintGraph,
    states: &mut [MotionState],
    masks: Option<&[u32]>,
    step: &StepContext,
    substep: ContactSubstep,
) {
    let ConstraintGraph { two_points, one_point, two_points_static, one_point_static, .. } = constraints;
    if let Some(masks) = masks {
        let (soft, fixed) = (step.softness_with_joints(false), step.softness_with_joints(true));
        solve_with_joint_softness::<false, 2, _>(two_points, states, substep, soft, masks);
        solve_with_joint_softness::<false, 1, _>(one_point, states, substep, soft, masks);
        solve_with_joint_softness::<true, 2, _>(two_points_static, states, substep, fixed, masks);
        solve_with_joint_softness::<true, 1, _>(one_point_static, states, substep, fixed, masks);
        return;
    }
    let (soft, fixed) = (step.contact_softness, step.static_softness);
    solve_with_bias::<false, 2, _>(two_points, states, substep, soft);
    solve_with_bias::<false, 1, _>(one_point, states, substep, soft);
    solve_with_bias::<true, 2, _>(two_points_static, states, substep, fixed);
    solve_with_bias::<true, 1, _>(one_point_static, states, substep, fixed);
}

/// Relaxation: solves all contacts of the iterative solver in the plane as rigid constraints without bias, friction included.
fn relax_contacts(constraints: &mut ConstraintGraph, states: &mut [MotionState], substep: ContactSubstep) {
    let ConstraintGraph { two_points, one_point, two_points_static, one_point_static, .. } = constraints;
    relax::<false, 2>(two_points, states, substep);
    relax::<false, 1>(one_point, states, substep);
    relax::<true, 2>(two_points_static, states, substep);
    relax::<true, 1>(one_point_static, states, substep);
}
