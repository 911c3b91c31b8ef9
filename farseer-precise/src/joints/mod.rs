//! Joints of the precise set: choice of the solver for each articulation, and its state from step to step.
//!
//! | articulation | solver |
//! |---|---|
//! | free tree (no contacts) without motors, limits or ropes | [articulated-body algorithm](articulated_body) in substeps of its own: [`articulation_step`], [`revolute_tree`] |
//! | any other | the [direct solver](super::direct_solver), as [rows of its system](island_rows), if it accepts the articulation; in substeps of its own if there is no contact and no loop closure |
//! | rejected by the direct solver, or with soft joints | [soft rows](soft_step) of the iterative solver, beside the contacts |
//!
//! [Springs](springs) at jointed or touched bodies are rows, too, of the direct or of the iterative solver. Articulations with
//! a distance joint in three axes have solvers of their own: see [`spatial_joints`].
//!
//! The module reads joint constraints, and poses and velocities of bodies. It writes velocities and displacements of bodies, and
//! forces of joints.

pub mod articulated_body;
pub mod articulated_inertia;
pub mod articulation;
pub mod articulation_step;
pub mod block_pair;
pub mod block_row;
pub mod colours;
pub mod energy_balance;
pub mod forest;
pub mod frame;
pub mod implicit_spring_row;
pub mod indices;
pub mod island_rows;
pub mod joint_constraint;
pub mod link_motion;
pub mod link_state;
pub mod locked_dofs;
pub mod revolute_tree;
pub mod rod;
pub mod rotation;
pub mod soft_angle_spring;
pub mod soft_axis_spring;
pub mod soft_block;
pub mod soft_coupling;
pub mod soft_law;
pub mod soft_pair;
pub mod soft_spring;
pub mod soft_step;
pub mod spatial_joints;
pub mod springs;
pub mod substep_plan;
pub mod target_velocity;
pub mod vec2;

use super::bodies::BodySet;
use super::constraint_graph::ContactConstraintSimd;
use super::direct_solver::joint::JointRows;
use super::scaled_parameters::StepContext;
use crate::index::{BodyIndex, DenseIndex, IndexedVec, index_type};
use crate::reusing_clone;
use articulated_body::LinkIndex;
use articulation::Articulation;
use forest::{EdgeList, NO_TREE_INDEX, SpanningForest};
use indices::{CandidateIndex, JointIndex};
pub(crate) use joint_constraint::JointCandidate;
use joint_constraint::{JointConstraint, JointList};
use locked_dofs::LockedDofs;
use soft_step::SoftJoints;
use spatial_joints::{SpatialJointGroup, ZGroup, spatial_groups};
use springs::SpringRows;

index_type! {
    /// Index of an articulation in the plane.
    pub(crate) struct ArticulationIndex;
}

/// All active joints of a simulator, and the articulations that they form.
#[derive(Debug, Default)]
pub struct JointSystem {
    /// Active joints, which hold at least one dynamic body, in the order of the simulator's list of joints.
    constraints: JointList,
    /// Articulations that are solved in the plane: in 2D all, in three axes those without a distance joint.
    articulation_list: IndexedVec<ArticulationIndex, Articulation>,
    /// For each joint index: index of the joint's articulation in `articulation_list`, or the length of that list if the joint
    /// is in none.
    articulation_of: IndexedVec<JointIndex, ArticulationIndex>,
    /// For each body index: index of the body's entry in its articulation, or [`NO_TREE_INDEX`] if no joint holds the body.
    tree_index_of: IndexedVec<BodyIndex, LinkIndex>,
    /// Groups of bodies with one velocity along the depth axis; empty in 2D.
    z_groups: Vec<ZGroup>,
    /// Articulations in three axes that contain a distance joint; empty in 2D.
    spatial: Vec<SpatialJointGroup>,
    /// The joints and springs that the iterative solver solves in this update.
    soft: SoftJoints,
    /// Length unit of the simulator, > 0, in the user's units of length.
    length_unit: f64,
}

reusing_clone! {
    JointSystem {
        constraints, articulation_list, articulation_of, tree_index_of, z_groups, spatial, soft, length_unit
    }
}

impl JointSystem {
    /// Returns whether no joint needs the iterative solver: all articulations are free or solved by the direct solver.
    pub(crate) fn are_all_contact_free(&self) -> bool {
        self.spatial.iter().all(|group| group.is_contact_free())
            && !self.articulation_list.iter().any(Articulation::is_iterative)
    }

    /// Returns the indices of the dynamic bodies of each articulation in the plane.
    pub(crate) fn articulation_bodies(&self) -> impl Iterator<Item = &[BodyIndex]> + '_ {
        self.articulation_list.iter().map(|articulation| &articulation.bodies[..])
    }

    /// Returns the number of dynamic bodies in the plane that free articulations move in this step.
    pub(crate) fn free_body_count(&self) -> usize {
        let free = self.articulation_list.iter().filter(|articulation| articulation.is_free());
        free.map(|articulation| articulation.bodies.len()).sum()
    }

    /// Returns the joints in the plane as candidates for the direct solver.
    pub(crate) fn candidates(&self) -> impl Iterator<Item = JointCandidate> + '_ {
        self.articulation_list.iter().flat_map(move |articulation| {
            let is_free = articulation.is_contact_free && articulation.is_tree();
            articulation.joints.iter().map(move |&joint| {
                let constraint = &self.constraints[joint];
                JointCandidate {
                    index: CandidateIndex::Joint(joint),
                    bodies: constraint.anchors.map(|anchor| anchor.body),
                    is_free_articulation: is_free,
                    has_rows: constraint.fits_direct_solver(),
                    error: constraint.error.abs(),
                }
            })
        })
    }

    /// Returns the constraint of the joint with the index `joint`.
    pub(crate) fn constraint(&self, joint: JointIndex) -> &JointConstraint {
        &self.constraints[joint]
    }

    /// Returns whether the articulation of a joint has a loop closure: a joint between bodies that other joints connect
    /// already.
    pub(crate) fn has_loop(&self, joint: JointIndex) -> bool {
        self.articulation_list[self.articulation_of[joint]].has_loop
    }

    /// Stores `force`, which the direct solver has found for a joint. No other solver takes the joint in this step.
    ///
    /// The components of `force` are those on the joint's second body: along x and y (mass units * length units/s^2) and the
    /// torque (mass units * length units^2/s^2).
    pub(crate) fn set_force(&mut self, joint: JointIndex, force: [f64; 3]) {
        self.constraints[joint].force = force;
        self.mark_solved(joint);
    }

    /// Adds to the servo force of a joint a mean force over the update on the joint's second body: along x and y (mass units *
    /// length units/s^2) and the torque (mass units * length units^2/s^2).
    pub(crate) fn add_servo_force(&mut self, joint: JointIndex, force: [f64; 3]) {
        let sum = &mut self.constraints[joint].servo_force;
        (0..3).for_each(|axis| sum[axis] += force[axis]);
    }

    /// Removes the stored force of a joint: the next solver starts without an impulse of it.
    pub(crate) fn forget_force(&mut self, joint: JointIndex) {
        self.constraints[joint].force = [0.0; 3];
    }

    /// Converts the row impulses that the direct solver has found in a step of `dt` seconds to the force of the joint, and
    /// stores it. No other solver takes the joint in this step.
    pub(crate) fn store_solution(&mut self, joint: JointIndex, rows: &JointRows, dt: f64) {
        self.constraints[joint].set_force_from_impulses(rows, dt);
        self.mark_solved(joint);
    }

    /// Marks the articulation of a joint as solved by the direct solver: no other solver takes it in this step.
    pub(crate) fn mark_solved(&mut self, joint: JointIndex) {
        self.articulation_list[self.articulation_of[joint]].is_solved = true;
    }

    /// Marks the articulations of `joints` as solved by the direct solver. `joints` are indices.
    pub(crate) fn mark_all_solved(&mut self, joints: &[JointIndex]) {
        joints.iter().for_each(|&joint| self.mark_solved(joint));
    }

    /// Returns whether there is no active joint.
    pub fn is_empty(&self) -> bool {
        self.constraints.is_empty()
    }

    /// Returns all active joints, in the order of the simulator's list of joints.
    pub fn constraints(&self) -> &JointList {
        &self.constraints
    }

    /// Returns all active joints for a change, in the order of the simulator's list of joints.
    pub fn constraints_mut(&mut self) -> &mut JointList {
        &mut self.constraints
    }

    /// Returns whether some joint holds the body with the index `body`.
    #[inline(always)]
    pub fn has_joint(&self, body: BodyIndex) -> bool {
        self.tree_index_of.at(body).is_some_and(|&index| index != NO_TREE_INDEX)
    }

    /// Returns whether joints, or springs of the iterative solver, act on any body in this update.
    pub(super) fn act_on_bodies(&self) -> bool {
        !(self.constraints.is_empty() && self.soft.is_empty())
    }

    /// Returns the body indices of all free articulations (those without contacts), each with the number of substeps into which
    /// the articulation divides its step. `substeps` is the number of the solver's substeps.
    pub fn free_articulations(&self, substeps: u32) -> impl Iterator<Item = (BodyIndex, u32)> + '_ {
        let free = self.articulation_list.iter().filter(|group| group.is_free());
        let in_plane = free.flat_map(|group| group.bodies.iter().map(|&body| (body, group.substeps)));
        let apart = self.spatial.iter().filter(|group| group.is_contact_free());
        let in_space = apart.flat_map(move |group| {
            let parts = substeps * group.substep_parts();
            group.bodies().iter().map(move |&body| (body, parts))
        });
        in_plane.chain(in_space)
    }

    /// Returns the indices of both bodies of each active joint, whatever their body types; 0 for the world.
    pub fn body_pairs(&self) -> impl Iterator<Item = [BodyIndex; 2]> + '_ {
        self.constraints.iter().map(|constraint| constraint.anchors.map(|anchor| anchor.pose_body))
    }

    /// Returns for each running motor: the indices of both bodies (0 for the world), the target speed, and whether the motor is
    /// linear. The unit of the speed is length units/s for linear motors and radians/s for rotary ones.
    pub(crate) fn motors(&self) -> impl Iterator<Item = ([BodyIndex; 2], f32, bool)> + '_ {
        self.constraints.iter().filter_map(|constraint| {
            let motor = constraint.drive?.motor.filter(|motor| motor.greatest_effort > 0.0)?;
            Some((
                constraint.anchors.map(|anchor| anchor.pose_body),
                motor.speed,
                constraint.locked == LockedDofs::Line,
            ))
        })
    }

    /// Replaces all joints by `joints`, at most `count`, and builds their articulations. `is_in_space` tells whether the
    /// simulator has a depth axis.
    pub fn replace(
        &mut self,
        joints: impl Iterator<Item = JointConstraint>,
        count: usize,
        bodies: &BodySet,
        is_in_space: bool,
    ) {
        self.constraints.clear();
        self.constraints.as_vec_mut().reserve(count);
        self.constraints.extend(joints);
        self.plan(bodies, is_in_space);
    }

    /// Builds the articulations, their trees and the groups in three axes from the imported joints.
    fn plan(&mut self, bodies: &BodySet, is_in_space: bool) {
        (self.z_groups, self.spatial) = (Vec::new(), Vec::new());
        let mut in_plane: Vec<JointIndex> = self.constraints.indices().collect();
        if is_in_space {
            (self.spatial, in_plane) = spatial_groups(&self.constraints, bodies);
            let planar_constraints: JointList = in_plane.iter().map(|&at| self.constraints[at]).collect();
            self.z_groups = ZGroup::find_all(&planar_constraints, bodies.states.len());
        }
        for &at in &in_plane {
            self.constraints[at].force_along_depth = 0.0;
        }
        let edges: EdgeList = in_plane.iter().map(|&at| self.constraints[at].edge()).collect();
        let SpanningForest { articulations: mut plans, mut tree_index_of } =
            SpanningForest::new(&edges, bodies.first_static().position());
        plans.iter_mut().for_each(|group| group.map_joint_indices(&in_plane));
        if !self.spatial.is_empty() {
            tree_index_of.resize(bodies.first_static().position(), NO_TREE_INDEX);
        }
        for &body in self.spatial.iter().flat_map(SpatialJointGroup::bodies) {
            // A mark that some joint holds the body; the index itself is not used.
            tree_index_of[body] = LinkIndex(0);
        }
        let articulations = plans.into_iter().map(|plan| Articulation::new(plan, &self.constraints, bodies));
        self.articulation_list = articulations.collect();
        self.articulation_of.clear();
        self.articulation_of.resize(self.constraints.len(), self.articulation_list.next_index());
        for (at, group) in self.articulation_list.enumerated() {
            group.joints.iter().for_each(|&joint| self.articulation_of[joint] = at);
        }
        self.tree_index_of = tree_index_of;
        self.soft.plan(&self.constraints, &in_plane, bodies.first_static().position());
    }

    /// Updates the joints in the plane to the poses of the bodies at the start of a step, and determines which articulations
    /// are free.
    ///
    /// `is_touched` returns whether contacts or springs act on a body; it is `None` if there are neither. `read` sets angle,
    /// axis and motor of a joint, by its index.
    pub fn prepare(
        &mut self,
        bodies: &BodySet,
        is_touched: Option<impl Fn(BodyIndex) -> bool>,
        read: impl Fn(JointIndex, &mut JointConstraint),
    ) {
        let JointSystem { articulation_list: articulations, constraints, .. } = self;
        for articulation in articulations {
            articulation.is_contact_free = !articulation.is_soft
                && is_touched
                    .as_ref()
                    .is_none_or(|is_touched| !articulation.bodies.iter().any(|&body| is_touched(body)));
            articulation.is_solved = false;
            if !articulation.is_free_revolute_tree() {
                for &at in &articulation.joints {
                    constraints[at].update(bodies, |constraint| read(at, constraint));
                }
            }
        }
    }

    /// Prepares the articulations with distance joints in three axes for a step. `is_touched` and `read` are as in
    /// [`prepare`](Self::prepare). `depth_of` returns the z position of the body on a side (0 or 1) of a joint, by its index, in
    /// length units.
    pub fn prepare_spatial(
        &mut self,
        bodies: &BodySet,
        step: &StepContext,
        is_touched: impl Fn(BodyIndex) -> bool,
        read: impl Fn(JointIndex, &mut JointConstraint),
        depth_of: impl Fn(JointIndex, usize) -> f32,
    ) {
        let times = [f64::from(step.dt), f64::from(step.h)];
        for group in &mut self.spatial {
            for at in group.joint_indices() {
                self.constraints[at].update(bodies, |constraint| read(at, constraint));
            }
            group.update_contact_free(&is_touched);
            group.prepare(&self.constraints, bodies, times, self.length_unit, &depth_of);
        }
    }

    /// Returns the articulations with a distance joint in three axes that the iterative solver solves, with the constraints of
    /// all joints.
    fn iterative_spatial_groups(&mut self) -> impl Iterator<Item = (&mut SpatialJointGroup, &JointList)> {
        let JointSystem { spatial, constraints, .. } = self;
        spatial.iter_mut().filter(|group| !group.is_contact_free()).map(|group| (group, &*constraints))
    }

    /// Moves free articulations with joints that are not revolute, and free groups of joints in three axes, through all
    /// substeps of a step.
    pub(crate) fn step_free_articulations(&mut self, bodies: &BodySet, step: &StepContext) {
        let has_generic_step = |group: &&mut Articulation| group.is_free() && !group.is_free_revolute_tree();
        for group in self.articulation_list.iter_mut().filter(has_generic_step) {
            group.substeps = articulation_step::step_free_tree(
                (&mut group.links, group.size),
                &self.constraints,
                bodies,
                step,
                self.length_unit,
            );
        }
        self.spatial.iter_mut().for_each(|group| group.free_step(&self.constraints, bodies, step));
    }

    /// Gives all bodies of each group in `z_groups` the same velocity along the depth axis.
    pub(crate) fn equalize_z_velocity(&self, bodies: &mut BodySet) {
        self.z_groups.iter().for_each(|tied| tied.equalize_z_velocity(bodies));
    }

    /// Gives all bodies of each group in `z_groups` the same velocity and displacement along the depth axis, in a step of `dt`
    /// seconds without contacts.
    pub(crate) fn equalize_z_displacement(&self, bodies: &mut BodySet, dt: f32) {
        self.z_groups.iter().for_each(|tied| tied.equalize_z_displacement(bodies, dt));
    }

    /// Starts an update: removes all joints and springs from the iterative solver. `length_unit` is the length unit of the
    /// simulator, in the user's units of length.
    pub fn begin_update(&mut self, length_unit: f32) {
        self.length_unit = f64::from(length_unit);
        self.soft.clear();
    }

    /// Builds the soft rows of the iterative solver for joints and springs that no other solver takes.
    pub(crate) fn begin_iterative(&mut self, springs: &SpringRows, bodies: &BodySet, step: &StepContext) {
        let JointSystem {
            soft,
            articulation_list: articulations,
            articulation_of,
            constraints,
            length_unit,
            ..
        } = self;
        if articulations.iter().any(Articulation::is_iterative) || !springs.are_all_solved() {
            let is_iterative = |at: JointIndex| articulations[articulation_of[at]].is_iterative();
            soft.prepare((constraints, springs), is_iterative, (bodies, step), *length_unit);
        }
    }

    /// Returns whether a joint of the iterative solver has a position error that is too large to be corrected in proportion, at
    /// the start of the substep.
    pub(crate) fn has_large_iterative_error(&self) -> bool {
        self.soft.has_large_error()
    }

    /// Returns two masks for each body index: all bits set if the body has joints in the iterative solver, and all bits set if a
    /// contact [holds](crate::contact_solver::held_contacts) the body in this update, else 0.
    pub(crate) fn masks_of_held_bodies(&mut self) -> (&[u32], &mut [u32]) {
        self.soft.masks_of_held_bodies()
    }

    /// Returns whether joints or springs act in the substeps of the iterative solver in this update.
    pub(crate) fn act_in_substeps(&self) -> bool {
        !(self.soft.is_empty() && self.z_groups.is_empty() && self.spatial.is_empty())
    }

    /// Adds the velocity changes by accumulated impulses of joints and springs to the warm-start sums of the bodies, which the
    /// next substep applies.
    pub(crate) fn add_warm_start(&self, bodies: &mut BodySet) {
        self.soft.add_warm_start(bodies);
    }

    /// Returns for each body index all bits set if the body has a joint or spring in the iterative solver, else 0. Returns
    /// `None` if the iterative solver has neither joints nor springs in this update.
    pub(crate) fn iterative_body_masks(&self) -> Option<&[u32]> {
        (!self.soft.is_empty()).then(|| self.soft.body_masks().slice(..))
    }

    /// Returns whether the iterative solver has a joint or spring of the body with the index `body` in this update.
    pub(crate) fn has_iterative_joint(&self, body: BodyIndex) -> bool {
        self.soft.body_masks().at(body).is_some_and(|&mask| mask != 0)
    }

    /// Solves joints and springs of the iterative solver with bias, before the positions of a substep of `h` seconds are
    /// integrated.
    pub(crate) fn solve_with_bias(&mut self, bodies: &mut BodySet, h: f32) {
        self.iterative_spatial_groups()
            .for_each(|(group, constraints)| group.solve_positions(constraints, bodies, h.into()));
        self.soft.solve_with_bias(bodies, h);
    }

    /// Limits the velocities of bodies with joints of the iterative solver in a substep of `h` seconds: see
    /// [`JOINTED_BODY_SPEED`](super::parameters::joints::JOINTED_BODY_SPEED).
    pub(crate) fn limit_speeds(&self, bodies: &mut BodySet, h: f32) {
        self.soft.limit_speeds(bodies, self.length_unit as f32, h);
    }

    /// Moves the anchors and updates the rows of the iterative solver's joints, after the positions of a substep of `h` seconds
    /// were integrated.
    pub(crate) fn update_anchors(&mut self, bodies: &mut BodySet, h: f32) {
        self.iterative_spatial_groups().for_each(|(group, _)| group.update_anchors(bodies, h.into()));
        self.soft.advance(bodies);
    }

    /// Solves the joints of the iterative solver without bias, after the positions of a substep of `h` seconds were integrated
    /// (relaxation).
    pub(crate) fn relax(&mut self, bodies: &mut BodySet, h: f32) {
        self.iterative_spatial_groups()
            .for_each(|(group, constraints)| group.solve_velocities(constraints, bodies, h.into()));
        self.soft.relax(bodies, h);
    }

    /// Starts the restitution phase: no body with joints counts as impacted yet.
    pub(crate) fn begin_restitution(&mut self) {
        self.soft.begin_restitution();
    }

    /// Notes the bodies of these lanes of `row`, if they have joints in the iterative solver: restitution has changed their
    /// velocities. [`apply_restitution`](Self::apply_restitution) begins at the noted bodies.
    #[inline(always)]
    pub(crate) fn record_restitution<const P: usize>(&mut self, row: &ContactConstraintSimd<P>, lanes: u32) {
        self.soft.record_restitution(row, lanes);
    }

    /// Removes the velocity errors that restitution causes at joints of the iterative solver. Returns the largest error before
    /// removal, in length units/s.
    pub(crate) fn apply_restitution(&mut self, bodies: &mut BodySet) -> f32 {
        self.soft.propagate_impacts(bodies, self.length_unit as f32)
    }

    /// Moves the free revolute trees through a step. Stores velocities and displacements of the other free articulations in the
    /// bodies, and the forces of all joints in `constraints`.
    pub(crate) fn store(&mut self, bodies: &mut BodySet, step: &StepContext) {
        let (dt, per_second) = (f64::from(step.dt), 1.0 / f64::from(step.dt));
        self.spatial.iter().for_each(|group| group.store_forces(&mut self.constraints, bodies, dt));
        self.soft.store_forces(&mut self.constraints, [step.dt, step.h]);
        for group in self.articulation_list.iter_mut().filter(|group| group.is_free()) {
            if group.is_free_revolute_tree() {
                group.substeps = revolute_tree::step_revolute_tree(
                    (&mut group.revolute_links, group.size),
                    &mut self.constraints,
                    bodies,
                    step,
                    self.length_unit,
                );
                continue;
            }
            for node in group.links.iter().filter(|node| node.body != BodyIndex::PLACEHOLDER) {
                let ([vx, vy, spin], [x, y, rotation]) = (node.velocity, node.delta_pose);
                // Joints in the plane leave the velocity along the depth axis as it is.
                let (velocity, delta_pose) =
                    (&mut bodies.states[node.body].velocity, &mut bodies.delta_pose[node.body]);
                *velocity = [vx as f32, vy as f32, spin as f32, velocity[3]];
                *delta_pose = [x as f32, y as f32, rotation as f32, delta_pose[3]];
            }
            for node in group.links.iter().filter(|node| node.locked.is_joint()) {
                let force_of_impulse = node.joint_sign() * per_second;
                self.constraints[node.joint].force =
                    node.total_impulse.map(|impulse| impulse * force_of_impulse);
            }
        }
    }
}
