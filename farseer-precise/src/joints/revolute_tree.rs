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
use wide::f32x4;

use super::super::bodies::BodySet;
use super::super::scaled_parameters::StepContext;
use super::articulated_body::{ArticulatedLink, LinkIndex, Links, TreeNode, for_each_down, for_each_up};
use super::articulated_inertia::{ArticulatedInertia, ArticulatedMomentum};
use super::articulation_step::{
    SubstepPlan, clamped_remainder, cos_sin, max_spins, momentum_conserving_stiffness, nonlinear_rotation,
    predict_spin_change, stable_stiffness,
};
use super::energy_balance::{BalancedLink, InitialEnergy, LinkEndState, max_rounding_error};
use super::indices::JointIndex;
use super::joint_constraint::JointList;
use super::locked_dofs::LockedDofs;
use super::vec2::{Vec2, add_scaled, cross, dot, perp, rotate};
use crate::index::{BodyIndex, DenseIndex};

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
    /// part](nonlinear_rotation) of the substep's rotation: [cosine, sine minus the angle]. When bodies move it is the whole
    /// rotation in the substep.
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
    /// Amount of `added_stiffness` that [carries momentum](momentum_conserving_stiffness). Unit: mass units * length
    /// units^2, >= 0.
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
    fn end_state(&self) -> Option<LinkEndState> {
        let RevoluteLink { mass, inertia, delta_pose, position, velocity, force_delta, .. } = *self;
        (self.body != BodyIndex::PLACEHOLDER).then_some(LinkEndState {
            mass,
            inertia,
            delta_pose,
            position,
            velocity,
            force_delta,
        })
    }

    fn set_velocity(&mut self, velocity: [f64; 3]) {
        self.velocity = velocity;
    }

    fn max_rounding_work(&self, dt: f64) -> f64 {
        dot(self.total_impulse, self.total_impulse).sqrt() / dt
            * max_rounding_error(self.position, dot(self.arm, self.arm).sqrt())
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

    fn has_joint_error_above(&self, error: f64) -> bool {
        self.initial_error > error * self.reach
    }

    fn is_moving_fixed_root(&self) -> bool {
        self.locked == LockedDofs::Fixed && self.velocity != [0.0; 3]
    }

    fn is_free_root(&self) -> bool {
        self.locked == LockedDofs::Free
    }
}

/// Converts a tree of links to revolute links. Returns an empty list if some joint is not a rigid revolute joint without a
/// motor.
pub(super) fn revolute_links(links: &Links<ArticulatedLink>, constraints: &JointList) -> Links<RevoluteLink> {
    let is_rigid_revolute = |link: &ArticulatedLink| {
        let constraint = &constraints[link.joint];
        link.locked == LockedDofs::Point && constraint.softness == 0.0 && constraint.drive.is_none()
    };
    let is_root = |node: &ArticulatedLink| !node.locked.is_joint();
    if !links.iter().all(|node| is_root(node) || is_rigid_revolute(node)) {
        return Links::default();
    }
    let mut revolute_links: Links<RevoluteLink> =
        links.iter().map(|node| revolute_link(node, constraints)).collect();
    // The farther a joint is from the body's origin, the larger the stable stiffness is.
    let mut max_arms_squared: Links<f64> =
        revolute_links.iter().map(|link| dot(link.anchor, link.anchor)).collect();
    for link in revolute_links.iter().filter(|hinge| hinge.locked.is_joint()) {
        let max_arm_squared = &mut max_arms_squared[link.parent];
        *max_arm_squared = max_arm_squared.max(dot(link.parent_anchor, link.parent_anchor));
    }
    for (link, max_arm_squared) in revolute_links.iter_mut().zip(max_arms_squared.iter()) {
        let is_fixed = link.locked == LockedDofs::Fixed;
        link.stable_stiffness = if is_fixed {
            f64::INFINITY
        } else {
            stable_stiffness(link.inertia, link.mass, *max_arm_squared)
        };
    }
    revolute_links
}

/// Returns the revolute link of a link in a tree that has only rigid revolute joints.
fn revolute_link(link: &ArticulatedLink, constraints: &JointList) -> RevoluteLink {
    let [anchor, parent_anchor] = if link.locked.is_joint() {
        let [first, second] = constraints[link.joint].anchors.map(|anchor| anchor.local_anchor);
        if link.is_first { [first, second] } else { [second, first] }
    } else {
        [[0.0; 2]; 2]
    };
    let [arm, parent_arm] = [anchor, parent_anchor].map(|anchor| dot(anchor, anchor).sqrt());
    RevoluteLink {
        body: link.body,
        parent: link.parent,
        joint: link.joint,
        locked: link.locked,
        is_first: link.is_first,
        sign: link.joint_sign(),
        mass: link.mass,
        inertia: link.inertia,
        reach: arm + parent_arm + (link.inertia / link.mass).sqrt(),
        anchor,
        parent_anchor,
        ..RevoluteLink::default()
    }
}

/// Moves a free tree through all substeps of a step. `count` is the number of its dynamic bodies. Returns the number of
/// substeps.
///
/// Writes velocities and displacements of `bodies`, and errors and forces of `constraints`. Repeats the step with more substeps
/// if its energy error is too large. `length_unit` is the length unit of the simulator.
pub(super) fn step_revolute_tree(
    (links, count): (&mut Links<RevoluteLink>, u32),
    constraints: &mut JointList,
    bodies: &mut BodySet,
    step: &StepContext,
    length_unit: f64,
) -> u32 {
    let dt = f64::from(step.dt);
    let mut plan = begin_step((links, count), constraints, bodies, step);
    loop {
        let start = run_substeps(links, bodies, step, &plan, length_unit);
        let balance = plan.energy_balance(links, start, dt);
        let Some(refined) = balance.and_then(|balance| plan.refined(&balance)) else {
            balance.inspect(|balance| balance.project_energy(links));
            break;
        };
        begin_step((links, count), constraints, bodies, step);
        plan = refined;
    }
    let SubstepPlan { substeps, is_kick_drift, .. } = plan;
    let h = dt / f64::from(substeps);
    // In reverse order, because the last links are still in the cache.
    for link in links.iter_mut().rev() {
        let (velocity, delta_pose, total) = if is_kick_drift {
            let velocity = link.origin_velocity();
            (velocity, link.delta_pose_after(velocity, h), add_scaled(link.total_impulse, link.impulse, 1.0))
        } else {
            (link.velocity, link.delta_pose, link.total_impulse)
        };
        link.store(constraints, bodies, (velocity, delta_pose, total.map(|impulse| impulse / dt)));
    }
    substeps
}

/// Sets the links to the state at the start of a step, and returns the plan of the articulation's substeps. `count` is the
/// number of dynamic bodies.
fn begin_step(
    (links, count): (&mut Links<RevoluteLink>, u32),
    constraints: &mut JointList,
    bodies: &BodySet,
    step: &StepContext,
) -> SubstepPlan {
    let dt = f64::from(step.dt);
    let (mut spins, mut has_large_error) = ([0.0; 2], false);
    if SubstepPlan::is_energy_balanced(count) {
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
    let plan = SubstepPlan::of(count, step, spins, |ratio| {
        let bears = IMPLICIT_STIFFNESS_RATIO * ratio;
        links.iter().any(|link| link.geometric_stiffness > bears * link.stable_stiffness)
    });
    SubstepPlan { predicts_spin: plan.predicts_spin && !has_large_error, ..plan }
}

/// Runs all substeps of a step. Returns the energy at the start of the step, or `None` if the articulation gets no energy
/// balance.
fn run_substeps(
    links: &mut Links<RevoluteLink>,
    bodies: &BodySet,
    step: &StepContext,
    plan: &SubstepPlan,
    length_unit: f64,
) -> Option<InitialEnergy> {
    let SubstepPlan { substeps, is_kick_drift, max_prediction_error, predicts_spin, .. } = *plan;
    let dt = f64::from(step.dt);
    let h = dt / f64::from(substeps);
    let times = (step.dt, substeps as f32, step.substeps as f32);
    let start = if is_kick_drift {
        solve_substep(links, (h, length_unit), max_prediction_error / h, |link| {
            link.scale_to_substep(bodies, times, false);
            link.apply_forces(1.0, false);
        });
        None
    } else {
        links.iter_mut().for_each(|link| link.scale_to_substep(bodies, times, true));
        let start = InitialEnergy::of(links);
        solve_substep(links, (h, length_unit), max_prediction_error / h, |link| {
            link.apply_forces(0.5, predicts_spin)
        });
        Some(start)
    };
    for substep in 1..substeps {
        let share = if substep == 1 && !is_kick_drift { 0.5 } else { 1.0 };
        for_each_down(links, |link, parent| {
            link.record_joint_spin_change(predicts_spin, share);
            link.integrate_position(parent, h);
        });
        solve_substep(links, (h, length_unit), max_prediction_error / h, |link| {
            link.apply_forces(1.0, predicts_spin)
        });
    }
    if !is_kick_drift {
        for_each_down(links, |link, parent| link.integrate_position(parent, h));
        project_velocities(links);
    }
    start
}

/// Applies the second half of the last force kick (velocity change by applied forces), and projects the velocities on the
/// joints (RATTLE).
fn project_velocities(links: &mut Links<RevoluteLink>) {
    for link in links.iter_mut() {
        link.apply_forces(0.5, false);
        (link.target_velocity, link.added_stiffness, link.momentum_stiffness) = ([0.0; 2], 0.0, 0.0);
        link.init_own();
    }
    for_each_up(links, RevoluteLink::propagate_up);
    for_each_down(links, |link, parent| match parent {
        Some(parent) => link.propagate_down(parent),
        None => link.solve_root(),
    });
    links.iter_mut().for_each(RevoluteLink::apply_solution);
}

/// Solves a substep of `h` seconds for the velocities with which the joints hold at the end of the substep. `begin` is called
/// with each link before the solve.
///
/// The solve is repeated once if a body's rotation deviates from the prediction. It is repeated up to
/// [`STIFFNESS_JUMP_RETRIES`] times while the [stiffness jumps](RevoluteLink::stiffness_jumped). `max_spin_error` is the
/// largest accepted deviation of an angular velocity, in radians/s.
fn solve_substep(
    links: &mut Links<RevoluteLink>,
    (h, length_unit): (f64, f64),
    max_spin_error: f64,
    begin: impl Fn(&mut RevoluteLink),
) {
    for link in links.iter_mut() {
        begin(link);
        link.prepare_substep(h);
    }
    let correction = (-1.0 / h, JOINT_CORRECTION_SPEED * h * length_unit);
    for iteration in 0..=STIFFNESS_JUMP_RETRIES {
        for_each_up(links, |link, parent| {
            link.set_target_velocity(parent, correction);
            link.propagate_up(parent);
        });
        let (mut is_mispredicted, mut may_have_jump) = (false, false);
        for_each_down(links, |link, parent| {
            if let Some(parent) = parent {
                link.propagate_down(parent);
                link.set_stiffness(h);
                parent.geometric_stiffness -= h * dot(link.parent_arm, link.impulse);
                may_have_jump |= parent.stiffness_jumped();
            } else {
                link.solve_root();
                link.set_stiffness(h);
            }
            may_have_jump |= link.stiffness_jumped();
            is_mispredicted |= (link.joint_velocity[2] - link.predicted_spin).abs() > max_spin_error;
        });
        // The stiffness of a parent is complete after its last child.
        let has_jump = may_have_jump && links.iter().any(RevoluteLink::stiffness_jumped);
        if iteration == STIFFNESS_JUMP_RETRIES || !(has_jump || (iteration == 0 && is_mispredicted)) {
            break;
        }
        for link in links.iter_mut() {
            if has_jump {
                link.set_added_stiffness(link.added_stiffness.max(link.excess_stiffness()));
            }
            link.predicted_spin = link.joint_velocity[2];
            link.prepare_substep(h);
        }
    }
}

impl RevoluteLink {
    /// Copies pose and velocity of the body to the link, and computes arms, joint error, geometric stiffness and predicted
    /// change of the angular velocity.
    ///
    /// Stiffness and change follow from the joint force of the last step; they are those of an undivided step of `dt` seconds.
    /// The contributions of the parent's side are added to `parent`. The change is computed if the articulation
    /// [`is_balanced`](SubstepPlan::is_energy_balanced).
    #[inline(always)]
    fn begin_step(
        &mut self,
        parent: Option<&mut RevoluteLink>,
        constraints: &mut JointList,
        bodies: &BodySet,
        (dt, is_balanced): (f64, bool),
    ) {
        let body = self.body.position();
        if self.body != BodyIndex::PLACEHOLDER {
            let [x, y, c, s] = bodies.poses[body].map(f64::from);
            let [vx, vy, spin, _] = bodies.initial_velocity[body];
            (self.position, self.rotation) = ([x, y], [c, s]);
            self.velocity = [vx, vy, spin].map(f64::from);
        }
        (self.delta_pose, self.total_impulse, self.geometric_stiffness, self.initial_error) =
            ([0.0; 3], [0.0; 2], 0.0, 0.0);
        self.joint_spin_change = 0.0;
        let Some(parent) = parent else {
            // Rotating a zero arm could flip the sign of a zero.
            self.arm = [0.0; 2];
            return;
        };
        let constraint = &mut constraints[self.joint];
        self.arm = rotate(self.rotation, self.anchor);
        if parent.locked == LockedDofs::Fixed {
            let anchor = &mut constraint.anchors[usize::from(self.is_first)];
            anchor.update(bodies);
            (parent.position, parent.velocity, self.parent_arm) =
                (anchor.position, anchor.velocity, anchor.arm);
        } else {
            self.parent_arm = rotate(parent.rotation, self.parent_anchor);
        }
        let offset = self.anchor_offset(parent);
        self.initial_error = dot(offset, offset).sqrt();
        constraint.error = self.initial_error as f32;
        let first_arm = if self.is_first { self.arm } else { self.parent_arm };
        constraint.first_arm = first_arm;
        let force = [constraint.force[0] * self.sign, constraint.force[1] * self.sign];
        self.geometric_stiffness = dt * dt * dot(self.arm, force);
        parent.geometric_stiffness -= dt * dt * dot(self.parent_arm, force);
        if is_balanced {
            self.joint_spin_change = cross(self.arm, force);
            parent.joint_spin_change -= cross(self.parent_arm, force);
        }
    }

    /// Converts the quantities that refer to an undivided step or a solver substep, so that they refer to the articulation's
    /// substeps: geometric stiffness, predicted change and forces. Adds the velocity change by forces that act in full at the
    /// start of the step.
    ///
    /// `dt` is the step in seconds; `parts` and `substeps` are the numbers of substeps of the articulation and of the solver.
    /// The predicted change is converted if the articulation [`is_balanced`](SubstepPlan::is_energy_balanced).
    #[inline(always)]
    fn scale_to_substep(
        &mut self,
        bodies: &BodySet,
        (dt, parts, substeps): (f32, f32, f32),
        is_balanced: bool,
    ) {
        self.geometric_stiffness *= 1.0 / f64::from(parts * parts);
        if is_balanced {
            self.joint_spin_change *= 1.0 / f64::from(parts);
        }
        self.set_added_stiffness(self.excess_stiffness());
        if self.body != BodyIndex::PLACEHOLDER {
            let [force_delta, force_position_delta] = [&bodies.force_delta, &bodies.force_position_delta]
                .map(|of| f32x4::new(of[self.body.position()]));
            let initial_kick = force_position_delta * f32x4::splat(2.0 / dt);
            let push = (force_delta * f32x4::splat(substeps) - initial_kick) * f32x4::splat(1.0 / parts);
            let ([x, y, spin, _], at_once) = (push.to_array().map(f64::from), initial_kick.to_array());
            self.force_delta = [x, y, spin];
            (0..3).for_each(|i| self.velocity[i] += f64::from(at_once[i]));
        }
    }

    /// Adds the fraction `share` (0..=1) of the velocity change by applied forces in a substep to the velocity (a kick), and
    /// predicts the angular velocity after the joints have acted.
    #[inline(always)]
    fn apply_forces(&mut self, share: f64, predicts_spin: bool) {
        (0..3).for_each(|i| self.velocity[i] += share * self.force_delta[i]);
        let joint_spin_change = if predicts_spin {
            predict_spin_change(self.joint_spin_change, self.geometric_stiffness, self.stable_stiffness)
        } else {
            0.0
        };
        self.predicted_spin = self.velocity[2] + share * joint_spin_change;
    }

    /// Sets rotation, inertia and momentum of the single body for a substep of `h` seconds.
    #[inline(always)]
    fn prepare_substep(&mut self, h: f64) {
        self.rotation = nonlinear_rotation(self.predicted_spin * h);
        self.init_own();
    }

    /// Computes the target velocity with which the joint holds at the end of a substep: the predicted error of the anchors
    /// times `rate`.
    ///
    /// `rate` is -1 / (seconds of the substep). `max_correction` is the largest error that is corrected in the substep, in
    /// length units.
    #[inline(always)]
    fn set_target_velocity(&mut self, parent: &RevoluteLink, (rate, max_correction): (f64, f64)) {
        let error = self.anchor_offset(parent);
        let predicted_anchor = add_scaled(self.position, rotate(self.rotation, self.arm), 1.0);
        let mut predicted_error = add_scaled(
            predicted_anchor,
            add_scaled(parent.position, rotate(parent.rotation, self.parent_arm), 1.0),
            -1.0,
        );
        let size = dot(error, error);
        if size > max_correction * max_correction {
            predicted_error =
                add_scaled(predicted_error, error, -clamped_remainder(size.sqrt(), max_correction));
        }
        self.target_velocity = [predicted_error[0] * rate, predicted_error[1] * rate];
    }

    /// Sets inertia and momentum to those of the single body about its joint with the parent.
    #[inline(always)]
    fn init_own(&mut self) {
        self.articulated_inertia =
            ArticulatedInertia::of_body(self.mass, self.inertia + self.added_stiffness, self.arm);
        self.momentum = ArticulatedMomentum::of_body(
            self.mass,
            self.inertia + self.momentum_stiffness,
            self.arm,
            self.velocity,
        );
    }

    /// Adds inertia and momentum of the link's subtree to those of the parent, with the rotation about the joint eliminated.
    /// Backward pass of the articulated-body algorithm.
    #[inline(always)]
    fn propagate_up(&mut self, parent: &mut RevoluteLink) {
        let lever = add_scaled(self.parent_arm, parent.arm, -1.0);
        let ArticulatedInertia { mass, coupling, rotational } = self.articulated_inertia;
        self.inverse_rotational = 1.0 / rotational;
        let reduced_mass = mass.with_outer_product(coupling, -self.inverse_rotational);
        let reduced_momentum =
            add_scaled(self.momentum.linear, coupling, -self.momentum.angular * self.inverse_rotational);
        (self.articulated_inertia.mass, self.momentum.linear) = (reduced_mass, reduced_momentum);
        parent.articulated_inertia.add_point_mass(&reduced_mass, lever);
        parent.momentum.add_at(
            add_scaled(reduced_momentum, reduced_mass.mul_vec(self.target_velocity), -1.0),
            0.0,
            lever,
        );
    }

    /// Computes the velocity of a root at its centre of mass from the momentum and inertia of its tree; a fixed root keeps its
    /// velocity.
    #[inline(always)]
    fn solve_root(&mut self) {
        self.joint_velocity = if self.locked == LockedDofs::Free {
            self.articulated_inertia.unconstrained_velocity(&self.momentum)
        } else {
            self.velocity
        };
    }

    /// Computes the velocity of the body at its joint, and the joint impulse, from the parent's velocity. Forward pass of the
    /// articulated-body algorithm.
    #[inline(always)]
    fn propagate_down(&mut self, parent: &RevoluteLink) {
        let [x, y, spin] = parent.joint_velocity;
        let lever = add_scaled(self.parent_arm, parent.arm, -1.0);
        let at_joint = add_scaled(add_scaled([x, y], perp(lever), spin), self.target_velocity, 1.0);
        self.impulse =
            add_scaled(self.articulated_inertia.mass.mul_vec(at_joint), self.momentum.linear, -1.0);
        let spin = (self.momentum.angular - dot(self.articulated_inertia.coupling, at_joint))
            * self.inverse_rotational;
        self.joint_velocity = [at_joint[0], at_joint[1], spin];
    }

    /// Returns the solved velocity of the centre of mass, and the angular velocity: x and y in length units/s, angular in
    /// radians/s.
    #[inline(always)]
    fn origin_velocity(&self) -> [f64; 3] {
        let [x, y, spin] = self.joint_velocity;
        let [x, y] = add_scaled([x, y], perp(self.arm), -spin);
        [x, y, spin]
    }

    /// Returns the displacement since the step began, after `h` more seconds with the velocity `velocity`: x and y in length
    /// units, rotation in radians.
    #[inline(always)]
    fn delta_pose_after(&self, velocity: [f64; 3], h: f64) -> [f64; 3] {
        std::array::from_fn(|i| self.delta_pose[i] + velocity[i] * h)
    }

    /// Sets the velocity of the link to the solved one, and adds the joint impulse to `total_impulse`, the sum of the step.
    #[inline(always)]
    fn apply_solution(&mut self) {
        self.velocity = self.origin_velocity();
        self.total_impulse = add_scaled(self.total_impulse, self.impulse, 1.0);
    }

    /// Stores the change of the angular velocity by joints in this substep, which predicts the change in the next one. `share`
    /// is the fraction of the force kick that the substep had, 0..=1.
    #[inline(always)]
    fn record_joint_spin_change(&mut self, predicts_spin: bool, share: f64) {
        if predicts_spin {
            self.joint_spin_change = (self.joint_velocity[2] - self.velocity[2]) / share;
        }
    }

    /// Moves the body with the solved velocity for `h` seconds, and rotates the arms of its joint with the parent.
    #[inline(always)]
    fn integrate_position(&mut self, parent: Option<&mut RevoluteLink>, h: f64) {
        self.apply_solution();
        self.delta_pose = self.delta_pose_after(self.velocity, h);
        let [x, y, spin] = self.velocity.map(|velocity| velocity * h);
        self.position = add_scaled(self.position, [x, y], 1.0);
        self.rotation = cos_sin(spin);
        self.arm = rotate(self.rotation, self.arm);
        if let Some(parent) = parent {
            self.parent_arm = rotate(parent.rotation, self.parent_arm);
        }
    }

    /// Sets the geometric stiffness of the body to `h` * dot(`arm`, `impulse`), without the part of its children. Unit: mass
    /// units * length units^2.
    ///
    /// `h` is the substep in seconds, `impulse` the joint impulse of the substep, and `arm` the vector from the centre of mass
    /// to the anchor. A child subtracts `h` * dot(`parent_arm`, `impulse`).
    #[inline(always)]
    fn set_stiffness(&mut self, h: f64) {
        self.geometric_stiffness = h * dot(self.arm, self.impulse);
    }

    /// Stores velocity and displacement of the body in `bodies`, and the force of the joint in `constraints`.
    ///
    /// `force` is that on the link's body along x and y, in mass units * length units/s^2.
    #[inline(always)]
    fn store(
        &self,
        constraints: &mut JointList,
        bodies: &mut BodySet,
        (velocity, delta_pose, force): ([f64; 3], [f64; 3], Vec2),
    ) {
        if self.body != BodyIndex::PLACEHOLDER {
            let body = self.body.position();
            // Joints in the plane leave the velocity along the depth axis as it is.
            let (stored_velocity, stored_delta_pose) =
                (&mut bodies.states[body].velocity, &mut bodies.delta_pose[body]);
            for i in 0..3 {
                (stored_velocity[i], stored_delta_pose[i]) = (velocity[i] as f32, delta_pose[i] as f32);
            }
        }
        if self.locked.is_joint() {
            let [x, y] = force.map(|force| force * self.sign);
            constraints[self.joint].force = [x, y, 0.0];
        }
    }

    /// Sets the added stiffness to `stiffness`, and computes the amount of it that carries momentum. Unit: mass units * length
    /// units^2, >= 0.
    #[inline(always)]
    fn set_added_stiffness(&mut self, stiffness: f64) {
        self.jump_stiffness = stiffness + 2.0 * self.stable_stiffness;
        (self.added_stiffness, self.momentum_stiffness) =
            (stiffness, momentum_conserving_stiffness(stiffness, self.stable_stiffness));
    }

    /// Returns the excess of the geometric stiffness over the stable limit. Unit: mass units * length units^2, >= 0; 0 for a
    /// fixed root.
    #[inline(always)]
    fn excess_stiffness(&self) -> f64 {
        let excess = self.geometric_stiffness - self.stable_stiffness;
        if excess > 0.0 { excess } else { 0.0 }
    }

    /// Returns whether the geometric stiffness exceeds the added stiffness by more than twice the stable limit. This happens
    /// when a chain snaps taut.
    #[inline(always)]
    fn stiffness_jumped(&self) -> bool {
        self.geometric_stiffness > self.jump_stiffness
    }

    /// Returns the vector from the parent's anchor to the body's, in world coordinates. Unit: length units.
    #[inline(always)]
    fn anchor_offset(&self, parent: &RevoluteLink) -> Vec2 {
        add_scaled(
            add_scaled(self.position, self.arm, 1.0),
            add_scaled(parent.position, self.parent_arm, 1.0),
            -1.0,
        )
    }
}
