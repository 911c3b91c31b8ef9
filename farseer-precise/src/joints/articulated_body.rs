//! Articulated-body algorithm (R. Featherstone, "The calculation of robot dynamics using articulated-body inertias", 1983) for
//! trees of planar bodies that joints connect.
//!
//! The algorithm solves M v' = M v + J^T l, J v' = b exactly in one pass up and one pass down the tree. M holds the masses, v
//! and v' the velocities before and after, J the joint Jacobian, l the joint impulses and b the target velocities of the
//! joints. The elimination has no fill-in, so its cost is linear in the number of bodies.
//!
//! - Backward pass (`propagate_up`): each body adds its inertia and momentum to those of its parent. The motions that the
//!   joint leaves free are eliminated first.
//! - Forward pass (`propagate_down`): velocities and joint impulses follow from the root to the leaves.
//!
//! Each body is described at its joint with the parent, a root at its centre of mass. A velocity is [v.x, v.y, w]: the linear
//! velocity v of that point and the angular velocity w. With r the vector from one point to another and p = (-r.y, r.x), the
//! other point moves with v + w p. An articulated inertia [A c; c^T d] of the other point is [A, c + A p; ., d + 2 c.p + p.A p]
//! at the first.
//!
//! Trees that have only rigid revolute joints and no contacts use the same formulas in [`revolute_tree`](super::revolute_tree).
//! All numbers are `f64`: the elimination of a free motion subtracts nearly equal inertias where a light body carries a long or
//! heavy tail, so that the small difference loses its leading digits.

use super::articulated_inertia::{ArticulatedInertia, ArticulatedMomentum, SymMat2};
use super::indices::JointIndex;
use super::locked_dofs::LockedDofs;
use super::rod::RodState;
use super::vec2::{Vec2, add_scaled, dot, perp};
use crate::index::{BodyIndex, DenseIndex, IndexedVec, index_type};

index_type! {
    /// Index of a link in the list of its articulation.
    pub(super) struct LinkIndex;
}

/// The links of an articulation.
pub(super) type Links<N> = IndexedVec<LinkIndex, N>;

/// A link: a body in a tree of joints. Parents come before their children in the list of links; a root is its own parent.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ArticulatedLink {
    /// Index of the body into the arrays of `BodySet`; 0 for the world.
    pub(super) body: BodyIndex,
    /// Index of the parent in the list of links.
    pub(super) parent: LinkIndex,
    /// Index of the joint with the parent into `JointSystem::constraints`.
    pub(super) joint: JointIndex,
    /// Degrees of freedom that the joint with the parent locks, or how a root is held.
    pub(super) locked: LockedDofs,
    /// Whether this body is the first body of the joint, and the parent the second.
    pub(super) is_first: bool,
    /// Mass of the body. Unit: mass units.
    pub(super) mass: f64,
    /// Moment of inertia about the centre of mass. Unit: mass units * length units^2.
    pub(super) inertia: f64,
    /// Excess of the geometric stiffness over the stable limit, integrated implicitly by adding it to the moment of inertia:
    /// see [`raise_added_stiffness`](super::articulation_step). Unit: mass units * length units^2, >= 0.
    pub(super) added_stiffness: f64,
    /// Geometric stiffness of the body against rotation, due to the joint forces, times the square of the substep. Unit: mass
    /// units * length units^2.
    pub(super) geometric_stiffness: f64,
    /// Square of the largest distance from the centre of mass to a joint of the body. Unit: length units^2.
    pub(super) max_arm_squared: f64,
    /// Velocity of the centre of mass, and angular velocity: x and y in length units/s, angular in radians/s.
    pub(super) velocity: [f64; 3],
    /// Predicted angular velocity in this substep, about which the joint errors are linearised. Unit: radians/s.
    pub(super) predicted_spin: f64,
    /// Change of the angular velocity by joints in the previous substep. It predicts the change in this one. Unit: radians/s.
    pub(super) joint_spin_change: f64,
    /// Velocity in this substep before joint impulses: x and y in length units/s, angular in radians/s.
    pub(super) unconstrained_velocity: [f64; 3],
    /// Velocity change by applied forces in a substep: x and y in length units/s, angular in radians/s.
    pub(super) force_delta: [f64; 3],
    /// Position of the centre of mass in the world. Unit: length units.
    pub(super) position: Vec2,
    /// Displacement since the step began: x and y in length units, rotation in radians.
    pub(super) delta_pose: [f64; 3],
    /// Rotation in this substep. Before the solve it is [cosine, sine minus the angle in radians], after it [cosine, sine].
    /// Dimensionless.
    pub(super) rotation: Vec2,
    /// Arm: vector from the centre of mass of the body to its anchor of the joint, in world coordinates. Unit: length units.
    pub(super) arm: Vec2,
    /// Parent's arm: vector from the centre of mass of the parent to its anchor of the joint, in world coordinates. Unit:
    /// length units.
    pub(super) parent_arm: Vec2,
    /// Unit vector in world coordinates. Distance joint: from the parent's anchor to the body's. Prismatic joint: along its
    /// axis. Unused in other joints.
    pub(super) axis: Vec2,
    /// State of a distance joint across its axis; unused in other joints.
    pub(super) rod: RodState,
    /// Target velocity of the body relative to its parent at the joint: x and y in length units/s, angular in radians/s. For a
    /// distance joint the first component is the velocity along `axis`, and the others are unused.
    pub(super) target_velocity: [f64; 3],
    /// Distance joint: target length, in length units. Other joints: error of the angle relative to the parent when the step
    /// begins, in radians.
    pub(super) angle_error_or_length: f64,
    /// Joint error when the step begins, >= 0. Linear errors are a fraction of the joint's arms plus the radius of gyration
    /// (dimensionless), angular errors are in radians.
    pub(super) initial_error: f64,
    /// Impulse of the joint on the body in this substep, in the world: x and y (mass units * length units/s), angular (mass
    /// units * length units^2/s).
    pub(super) impulse: [f64; 3],
    /// Sum of `impulse` over the substeps since the step began: x and y (mass units * length units/s), angular (mass units *
    /// length units^2/s).
    pub(super) total_impulse: [f64; 3],
    /// Intermediate results of a solve by the articulated-body algorithm.
    pub(super) scratch: AbaScratch,
}

/// Intermediate results of the articulated-body algorithm for one link.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct AbaScratch {
    /// Articulated inertia of the link and its subtree, about the anchor of the joint with the parent.
    inertia: ArticulatedInertia,
    /// Momentum of the link and its subtree, about the anchor of the joint with the parent.
    momentum: ArticulatedMomentum,
    /// Vector from the parent's own joint (for a root, from the root's centre of mass) to the joint between parent and body.
    /// Unit: length units.
    lever: Vec2,
    /// Velocity of the body at its joint with the parent, and angular velocity: x and y in length units/s, angular in
    /// radians/s.
    joint_velocity: [f64; 3],
    /// 1 / d of the articulated inertia [A c; c^T d]: reciprocal of the rotational inertia, where the joint leaves rotation
    /// free. Unit: 1/(mass units * length units^2).
    inverse_rotational: f64,
    /// A - c c^T / d of the articulated inertia [A c; c^T d]: inertia of the link and its subtree against translation, with
    /// rotation eliminated. Unit: mass units.
    reduced_mass: SymMat2,
    /// Linear momentum of the link and its subtree, with rotation eliminated. Unit: mass units * length units/s.
    reduced_momentum: Vec2,
    /// Results for a distance joint with axis n. Let t be perpendicular to n, B be `reduced_mass`, and s the added stiffness of
    /// the [rod](RodState).
    ///
    /// B t, in mass units, and 1 / (t.B t + s), in 1/(mass units).
    across_axis: (Vec2, f64),
}

/// Backward pass of the articulated-body algorithm: computes inertias and momenta of all subtrees, from the leaves to the
/// roots.
///
/// The function is not inlined because it has many callers.
#[inline(never)]
pub(super) fn propagate_up(links: &mut Links<ArticulatedLink>) {
    for_each_up(links, ArticulatedLink::propagate_up);
}

/// Backward pass of the articulated-body algorithm for momenta and target velocities only, with the inertias of the last
/// [`propagate_up`].
#[inline(never)]
pub(super) fn propagate_momentum_up(links: &mut Links<ArticulatedLink>) {
    for_each_up(links, ArticulatedLink::propagate_momentum_up);
}

/// Forward pass of the articulated-body algorithm: computes velocities and joint impulses, from the roots to the leaves.
#[inline(never)]
pub(super) fn propagate_down(links: &mut Links<ArticulatedLink>) {
    for_each_down(links, ArticulatedLink::propagate_down);
}

/// A node of a tree in a list in which parents come before their children.
pub(super) trait TreeNode {
    /// Returns the index of the parent in the list; a root returns its own index.
    fn parent(&self) -> LinkIndex;
}

impl TreeNode for ArticulatedLink {
    #[inline(always)]
    fn parent(&self) -> LinkIndex {
        self.parent
    }
}

/// Calls `visit` with each node that has a parent and with that parent, children before parents.
#[inline(always)]
pub(super) fn for_each_up<N: TreeNode>(links: &mut Links<N>, mut visit: impl FnMut(&mut N, &mut N)) {
    let links = links.slice_mut(..);
    for at in (1..links.len()).rev() {
        let (before, rest) = links.split_at_mut(at);
        if let Some(parent) = before.get_mut(rest[0].parent().position()) {
            visit(&mut rest[0], parent);
        }
    }
}

/// Calls `prepare` with each node, and `visit` with each node that has a parent and with that parent, children before parents.
///
/// A node is prepared just before the first visit that reads or changes it, so that one pass over the list does the work of two.
#[inline(always)]
pub(super) fn for_each_up_prepared<N: TreeNode>(
    links: &mut Links<N>,
    mut prepare: impl FnMut(&mut N),
    mut visit: impl FnMut(&mut N, &mut N),
) {
    let links = links.slice_mut(..);
    let mut unprepared = links.len();
    for at in (0..links.len()).rev() {
        let parent = links[at].parent().position();
        // The only call of `prepare`, so that the compiler inlines it.
        while unprepared > parent
            && let Some(next) = links.get_mut(unprepared - 1)
        {
            prepare(next);
            unprepared -= 1;
        }
        let (before, rest) = links.split_at_mut(at);
        if let Some(parent) = before.get_mut(parent) {
            visit(&mut rest[0], parent);
        }
    }
}

/// Calls `visit` with each node and its parent, parents before children. The parent of a root is `None`.
#[inline(always)]
pub(super) fn for_each_down<N: TreeNode>(
    links: &mut Links<N>,
    mut visit: impl FnMut(&mut N, Option<&mut N>),
) {
    let links = links.slice_mut(..);
    for at in 0..links.len() {
        let (before, rest) = links.split_at_mut(at);
        let parent = rest[0].parent();
        visit(&mut rest[0], before.get_mut(parent.position()));
    }
}

/// A distance joint is a rod without mass, and holds its length along the axis n.
///
/// Its added stiffness s transmits impulses across it, along t perpendicular to n: m u - s u'. Here u and u' are the velocities of
/// the body relative to the parent along t, before and after, and m is the amount of s that carries momentum.
///
/// Let B and b be the reduced mass and momentum of the subtree. Let w be the parent's velocity at the joint plus the target
/// velocity along n. Then the body gets the velocity w + t u' with u' = (t.b + m u - t.B w) / (t.B t + s). The subtree acts on the
/// parent as the mass B - (B t)(B t)^T / (t.B t + s).
impl ArticulatedLink {
    /// Returns the inertia of the subtree that a distance joint transmits to the parent, and stores its terms in `scratch`.
    #[inline(always)]
    fn rod_mass(&mut self) -> SymMat2 {
        let (mass, across) = (self.scratch.reduced_mass, perp(self.axis));
        let moved = mass.mul_vec(across);
        let inverse = 1.0 / (dot(across, moved) + self.rod.added_stiffness);
        self.scratch.across_axis = (moved, inverse);
        mass.with_outer_product(moved, -inverse)
    }

    /// Returns the momentum that a distance joint transmits to the parent, x and y in mass units * length units/s.
    #[inline(always)]
    fn rod_momentum(&self) -> Vec2 {
        let AbaScratch { across_axis: (moved, inverse), reduced_mass, reduced_momentum, .. } = self.scratch;
        let target = [0, 1].map(|i| self.axis[i] * self.target_velocity[0]);
        // The body's momentum beyond that at the target velocity.
        let held = add_scaled(reduced_momentum, reduced_mass.mul_vec(target), -1.0);
        let across = (dot(perp(self.axis), held) + self.rod.momentum()) * inverse;
        add_scaled(held, moved, -across)
    }

    /// Computes velocity and joint impulse of a body with a distance joint. `at_parent` is the velocity of the parent at the
    /// joint, along x and y in length units/s.
    #[inline(always)]
    fn propagate_rod_down(&mut self, at_parent: Vec2) {
        let AbaScratch { across_axis: (moved, inverse), reduced_mass, reduced_momentum, .. } = self.scratch;
        let (n, t) = (self.axis, perp(self.axis));
        let along = add_scaled(at_parent, n, self.target_velocity[0]);
        let across = (dot(t, reduced_momentum) + self.rod.momentum() - dot(moved, along)) * inverse;
        let at_joint = add_scaled(along, t, across);
        let [x, y] = add_scaled(reduced_mass.mul_vec(at_joint), reduced_momentum, -1.0);
        self.impulse = [x, y, 0.0];
        self.solve_rotation(at_joint);
    }
}

impl ArticulatedLink {
    /// Adds the joint impulse of this substep to `total_impulse`, the sum of the step.
    #[inline(always)]
    pub(super) fn accumulate_impulse(&mut self) {
        (0..3).for_each(|i| self.total_impulse[i] += self.impulse[i]);
    }

    /// Sets inertia and momentum in `scratch` to those of the single body, about its joint with the parent.
    ///
    /// `stiffness_factor` scales the added stiffness: 1 in substeps, 0 when velocities are projected at the end of a step.
    /// Dimensionless.
    #[inline(always)]
    pub(super) fn init_own(&mut self, stiffness_factor: f64) {
        self.init_own_inertia(stiffness_factor);
        self.init_own_momentum(self.velocity, 0.0);
    }

    /// Sets the inertia in `scratch` to that of the single body about its joint with the parent, including `stiffness_factor`
    /// (dimensionless) times the added stiffness.
    #[inline(always)]
    pub(super) fn init_own_inertia(&mut self, stiffness_factor: f64) {
        self.scratch.inertia = ArticulatedInertia::of_body(
            self.mass,
            self.inertia + stiffness_factor * self.added_stiffness,
            self.arm,
        );
    }

    /// Sets the momentum in `scratch` to that of the single body about its joint with the parent. `velocity` is that of the
    /// centre of mass: x and y in length units/s, angular in radians/s.
    ///
    /// `stiffness` is the amount of the added stiffness that carries angular momentum. Unit: mass units * length units^2.
    #[inline(always)]
    pub(super) fn init_own_momentum(&mut self, velocity: [f64; 3], stiffness: f64) {
        self.scratch.momentum =
            ArticulatedMomentum::of_body(self.mass, self.inertia + stiffness, self.arm, velocity);
    }

    /// Adds the inertia and momentum of the link's subtree to those of the parent. Motions that the joint leaves free are
    /// eliminated.
    #[inline(always)]
    pub(super) fn propagate_up(&mut self, parent: &mut ArticulatedLink) {
        self.propagate_inertia_up(parent);
        self.propagate_momentum_up(parent);
    }

    /// Adds the inertia of the link's subtree to that of the parent. Motions that the joint leaves free are eliminated.
    #[inline(always)]
    fn propagate_inertia_up(&mut self, parent: &mut ArticulatedLink) {
        let mut lever = add_scaled(self.parent_arm, parent.arm, -1.0);
        if self.locked == LockedDofs::Line {
            // A prismatic joint acts at the child's anchor.
            lever = add_scaled(lever, self.anchor_offset(parent.position), 1.0);
        }
        self.scratch.lever = lever;
        let parent_inertia = &mut parent.scratch.inertia;
        match self.locked {
            LockedDofs::Free
            | LockedDofs::Fixed
            | LockedDofs::PointOnLine
            | LockedDofs::Unlocked
            | LockedDofs::Gear
            | LockedDofs::Pulley => {}
            LockedDofs::Point => {
                self.eliminate_rotation();
                parent_inertia.add_point_mass(&self.scratch.reduced_mass, lever);
            }
            LockedDofs::Distance => {
                self.eliminate_rotation();
                parent_inertia.add_point_mass(&self.rod_mass(), lever);
            }
            LockedDofs::Weld => parent_inertia.add_at(&self.scratch.inertia, lever),
            LockedDofs::Line => {
                parent_inertia.add_at(&self.scratch.inertia.eliminate_slide(self.axis), lever)
            }
            LockedDofs::Angle => {
                let (inertia, _) =
                    self.scratch.inertia.eliminate_translation(&ArticulatedMomentum::default());
                parent_inertia.rotational += inertia;
            }
        }
    }

    /// Adds the momentum of the link's subtree to that of the parent. Motions that the joint leaves free are eliminated.
    #[inline(always)]
    pub(super) fn propagate_momentum_up(&mut self, parent: &mut ArticulatedLink) {
        let parent_momentum = &mut parent.scratch.momentum;
        let lever = self.scratch.lever;
        match self.locked {
            LockedDofs::Free
            | LockedDofs::Fixed
            | LockedDofs::PointOnLine
            | LockedDofs::Unlocked
            | LockedDofs::Gear
            | LockedDofs::Pulley => {}
            LockedDofs::Point => {
                self.eliminate_rotational_momentum();
                let [x, y, _] = self.target_velocity;
                let target_momentum = self.scratch.reduced_mass.mul_vec([x, y]);
                let linear = add_scaled(self.scratch.reduced_momentum, target_momentum, -1.0);
                parent_momentum.add_at(linear, 0.0, lever);
            }
            LockedDofs::Distance => {
                self.eliminate_rotational_momentum();
                parent_momentum.add_at(self.rod_momentum(), 0.0, lever);
            }
            LockedDofs::Weld => {
                let ArticulatedMomentum { linear, angular } = self.scratch.momentum;
                let held = self.scratch.inertia.remaining_momentum((linear, angular), self.target_velocity);
                parent_momentum.add_at(held.linear, held.angular, lever);
            }
            LockedDofs::Line => {
                let held = self.momentum_without_slide();
                parent_momentum.add_at(held.linear, held.angular, lever);
            }
            LockedDofs::Angle => {
                let (inertia, angular) = self.scratch.inertia.eliminate_translation(&self.scratch.momentum);
                parent_momentum.angular += angular - inertia * self.target_velocity[2];
            }
        }
    }

    /// Eliminates the rotation about the joint from the momentum: computes `reduced_momentum` in `scratch`.
    #[inline(always)]
    fn eliminate_rotational_momentum(&mut self) {
        let ArticulatedMomentum { linear, angular } = self.scratch.momentum;
        self.scratch.reduced_momentum =
            add_scaled(linear, self.scratch.inertia.coupling, -angular * self.scratch.inverse_rotational);
    }

    /// Returns the momentum that a prismatic joint transmits, with the motion along its axis eliminated.
    #[inline(always)]
    fn momentum_without_slide(&self) -> ArticulatedMomentum {
        let ArticulatedInertia { mass, coupling, .. } = self.scratch.inertia;
        let ArticulatedMomentum { linear, angular } = self.scratch.momentum;
        let held = self.scratch.inertia.eliminate_slide(self.axis);
        let slide = dot(self.axis, linear) / dot(self.axis, mass.mul_vec(self.axis));
        let linear = add_scaled(linear, mass.mul_vec(self.axis), -slide);
        let angular = angular - dot(coupling, self.axis) * slide;
        held.remaining_momentum((linear, angular), self.target_velocity)
    }

    /// Eliminates the rotation about the joint, which the joint leaves free: computes `inverse_rotational` and `reduced_mass`
    /// in `scratch`.
    #[inline(always)]
    fn eliminate_rotation(&mut self) {
        let ArticulatedInertia { mass, coupling, rotational } = self.scratch.inertia;
        self.scratch.inverse_rotational = 1.0 / rotational;
        self.scratch.reduced_mass = mass.with_outer_product(coupling, -self.scratch.inverse_rotational);
    }

    /// Computes the velocity of a root from the momentum and inertia of its tree; a fixed root keeps its velocity.
    #[inline(always)]
    fn solve_root(&mut self) {
        if self.locked == LockedDofs::Free {
            self.velocity = self.scratch.inertia.unconstrained_velocity(&self.scratch.momentum);
        }
        self.scratch.joint_velocity = self.velocity;
    }

    /// Computes the velocity of the body, and the joint impulse, from the parent's velocity. A root has no parent (`None`) and
    /// gets the velocity of a free body.
    #[inline(always)]
    pub(super) fn propagate_down(&mut self, parent: Option<&mut ArticulatedLink>) {
        let Some(parent) = parent else { return self.solve_root() };
        let [x, y, spin] = parent.scratch.joint_velocity;
        let at_parent = add_scaled([x, y], perp(self.scratch.lever), spin);
        let at_joint = add_scaled(at_parent, [self.target_velocity[0], self.target_velocity[1]], 1.0);
        match self.locked {
            LockedDofs::Free
            | LockedDofs::Fixed
            | LockedDofs::PointOnLine
            | LockedDofs::Unlocked
            | LockedDofs::Gear
            | LockedDofs::Pulley => {}
            LockedDofs::Point => {
                let [x, y] = add_scaled(
                    self.scratch.reduced_mass.mul_vec(at_joint),
                    self.scratch.reduced_momentum,
                    -1.0,
                );
                self.impulse = [x, y, 0.0];
                self.solve_rotation(at_joint);
            }
            LockedDofs::Distance => self.propagate_rod_down(at_parent),
            LockedDofs::Weld | LockedDofs::Line => {
                self.propagate_locked_angle_down(at_joint, spin + self.target_velocity[2])
            }
            LockedDofs::Angle => {
                let spin = spin + self.target_velocity[2];
                let (ArticulatedInertia { mass, coupling, .. }, momentum) =
                    (self.scratch.inertia, self.scratch.momentum);
                let (inertia, angular) = self.scratch.inertia.eliminate_translation(&momentum);
                self.impulse = [0.0, 0.0, inertia * spin - angular];
                self.set_joint_velocity(mass.solve(add_scaled(momentum.linear, coupling, -spin)), spin);
            }
        }
    }

    /// Computes velocity and joint impulse of a body with a weld or prismatic joint. `at_joint` is the velocity at the joint
    /// without a slide, along x and y in length units/s, and `spin` the angular velocity in radians/s.
    #[inline(always)]
    fn propagate_locked_angle_down(&mut self, mut at_joint: Vec2, spin: f64) {
        let ArticulatedInertia { mass, coupling, rotational } = self.scratch.inertia;
        let ArticulatedMomentum { linear, angular } = self.scratch.momentum;
        if self.locked == LockedDofs::Line {
            // The impulse along the line is 0.
            let free = add_scaled(add_scaled(linear, mass.mul_vec(at_joint), -1.0), coupling, -spin);
            let slide = dot(self.axis, free) / dot(self.axis, mass.mul_vec(self.axis));
            at_joint = add_scaled(at_joint, self.axis, slide);
        }
        let [fx, fy] = add_scaled(add_scaled(mass.mul_vec(at_joint), coupling, spin), linear, -1.0);
        self.impulse = [fx, fy, dot(coupling, at_joint) + rotational * spin - angular];
        self.set_joint_velocity(at_joint, spin);
    }

    /// Sets the velocity of a body whose joint leaves rotation free. `at_joint` is the velocity of the body at the joint, along
    /// x and y in length units/s.
    #[inline(always)]
    fn solve_rotation(&mut self, at_joint: Vec2) {
        let angular = self.scratch.momentum.angular - dot(self.scratch.inertia.coupling, at_joint);
        let spin = angular * self.scratch.inverse_rotational;
        self.set_joint_velocity(at_joint, spin);
    }

    /// Sets the velocity of the body's centre of mass. `at_joint` is the velocity of the body at its joint in length units/s,
    /// `spin` the angular velocity in radians/s.
    #[inline(always)]
    fn set_joint_velocity(&mut self, at_joint: Vec2, spin: f64) {
        self.scratch.joint_velocity = [at_joint[0], at_joint[1], spin];
        let [x, y] = add_scaled(at_joint, perp(self.arm), -spin);
        self.velocity = [x, y, spin];
    }
}
