//! Energy balance of a free articulation over a step.
//!
//! Joints do no work, so the kinetic energy changes by the work of the applied forces alone. Any further change is the energy
//! error of the step. The error is of second order in the length of a substep. With substeps of constant length it would
//! average out (E. Hairer, C. Lubich, G. Wanner, "Geometric Numerical Integration", 2006, IX). Substeps that get shorter where
//! bodies rotate fast turn it into a drift.
//!
//! A large error repeats the step with more substeps. A small one is removed by projection on the energy (Hairer et al., IV.4).
//! The projection scales all velocities by a factor s, which keeps the joints satisfied: J s v = s J v = 0. A free articulation
//! is scaled relative to the rigid motion with the same momentum and angular momentum, so that both are conserved. Such
//! projections on energy within a level set of the momenta: J. Simo, N. Tarnow, K. Wong, "Exact energy-momentum conserving
//! algorithms and symplectic schemes for nonlinear dynamics" (1992).
//!
//! The module reads positions, velocities and forces of the links at the end of a step, and writes the velocities.

use super::articulated_body::{Links, TreeNode};
use super::locked_dofs::LockedDofs;
use super::vec2::{Vec2, add_scaled, cross, dot, perp};
use crate::parameters::joints::{
    FAILED_STEP_ENERGY_ERROR, FAILED_STEP_JOINT_ERROR, MAX_ENERGY_VELOCITY_SCALE, MAX_INELASTIC_LOSS,
    MAX_POSITION_ROUNDING, MAX_ROTATION_ROUNDING, MAX_STEP_ENERGY_ERROR, MAX_STEP_JOINT_ERROR,
    MAX_WHIP_JOINT_ERROR,
};

/// Pose, velocity, mass and forces of one body of an articulation at the end of a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct LinkEndState {
    /// Degrees of freedom that the joint with the parent locks, or how a root is held.
    pub(super) locked: LockedDofs,
    /// Mass of the body. Unit: mass units.
    pub(super) mass: f64,
    /// Moment of inertia about the centre of mass. Unit: mass units * length units^2.
    pub(super) inertia: f64,
    /// Displacement of the body in this step: x and y in length units, rotation in radians.
    pub(super) delta_pose: [f64; 3],
    /// Position of the centre of mass in the world. Unit: length units.
    pub(super) position: Vec2,
    /// Velocity of the centre of mass along x and y in length units/s, and angular velocity in radians/s.
    pub(super) velocity: [f64; 3],
    /// Velocity change by applied forces in a substep: x and y in length units/s, angular in radians/s.
    pub(super) force_delta: [f64; 3],
}

/// A link of an articulation, whose velocity the energy balance reads and scales.
pub(super) trait BalancedLink: TreeNode {
    /// Returns the state of the link's body at the end of the step.
    fn state(&self) -> LinkEndState;
    /// Sets the velocity of the body: x and y in length units/s, angular in radians/s.
    fn set_velocity(&mut self, velocity: [f64; 3]);
    /// Returns the largest work that the joint with the parent does in a step of `dt` seconds by closing the error of rounded
    /// positions. Unit: mass units * length units^2/s^2.
    fn max_rounding_work(&self, dt: f64) -> f64;
    /// Returns the largest work that the joint with the parent does in a step of `dt` seconds by closing the error with which the
    /// step began. Unit: mass units * length units^2/s^2, >= 0.
    fn max_closing_work(&self, parent: &Self, dt: f64) -> f64;
    /// Returns the speed at which the bodies violate the joint with the parent. Unit: length units/s, >= 0.
    fn joint_velocity_error(&self, parent: &Self) -> f64;
    /// Returns the error of the joint with the parent at the end of the step minus that when the step began. Errors of linear rows
    /// are fractions of the joint's arms plus the radius of gyration, dimensionless; errors of angular rows are in radians.
    fn joint_error_growth(&self, parent: &Self) -> f64;
    /// Returns whether the error of the joint with the parent exceeded `error` when the step began. Errors of linear rows are
    /// fractions of the joint's arms plus the radius of gyration, dimensionless; errors of angular rows are in radians.
    fn has_joint_error_above(&self, error: f64) -> bool;

    /// Returns the state of the link's body at the end of the step; `None` for a fixed root, which has no body of its own.
    #[inline(always)]
    fn end_state(&self) -> Option<LinkEndState> {
        Some(self.state()).filter(|state| state.locked != LockedDofs::Fixed)
    }

    /// Returns whether this is a fixed root with a velocity.
    fn is_moving_fixed_root(&self) -> bool {
        let LinkEndState { locked, velocity, .. } = self.state();
        locked == LockedDofs::Fixed && velocity != [0.0; 3]
    }

    /// Returns whether this is the root of a tree that is not fixed to the world.
    fn is_free_root(&self) -> bool {
        self.state().locked == LockedDofs::Free
    }
}

/// Rigid motion that has the same momentum and angular momentum as an articulation.
#[derive(Debug, Clone, Copy, Default)]
struct RigidMotion {
    /// Centre of mass of the articulation in the world. Unit: length units.
    center: Vec2,
    /// Velocity of the centre of mass along x and y in length units/s, and angular velocity in radians/s.
    velocity: [f64; 3],
    /// Kinetic energy of the rigid motion. Unit: mass units * length units^2/s^2.
    energy: f64,
}

impl LinkEndState {
    /// Returns the kinetic energy of the body. Unit: mass units * length units^2/s^2.
    fn kinetic_energy(&self) -> f64 {
        let [x, y, spin] = self.velocity;
        0.5 * (self.mass * (x * x + y * y) + self.inertia * spin * spin)
    }

    /// Returns the work of the applied forces on the body in the step, which consists of substeps of `h` seconds. Unit: mass
    /// units * length units^2/s^2.
    fn force_work(&self, h: f64) -> f64 {
        let ([px, py, rotation], [fx, fy, torque_delta]) = (self.delta_pose, self.force_delta);
        (self.mass * (fx * px + fy * py) + self.inertia * torque_delta * rotation) / h
    }
}

impl RigidMotion {
    /// Returns the rigid motion with the momentum and angular momentum of these links.
    fn of<N: BalancedLink>(links: &Links<N>) -> Self {
        let bodies = || links.iter().filter_map(N::end_state);
        let (mut mass, mut moment, mut momentum) = (0.0, [0.0; 2], [0.0; 2]);
        for LinkEndState { mass: m, position, velocity: [x, y, _], .. } in bodies() {
            mass += m;
            (moment, momentum) = (add_scaled(moment, position, m), add_scaled(momentum, [x, y], m));
        }
        let [center, [x, y]] = [moment, momentum].map(|sum| sum.map(|sum| sum / mass));
        let (mut inertia, mut angular_momentum) = (0.0, 0.0);
        for body in bodies() {
            let (arm, [vx, vy, spin]) = (add_scaled(body.position, center, -1.0), body.velocity);
            inertia += body.inertia + body.mass * dot(arm, arm);
            angular_momentum += body.inertia * spin + body.mass * cross(arm, [vx - x, vy - y]);
        }
        let spin = angular_momentum / inertia;
        let energy = 0.5 * (mass * (x * x + y * y) + angular_momentum * spin);
        RigidMotion { center, velocity: [x, y, spin], energy }
    }

    /// Returns the velocity of the rigid motion at `position` (world, length units): x and y in length units/s, angular in
    /// radians/s.
    fn velocity_at(&self, position: Vec2) -> [f64; 3] {
        let [x, y, spin] = self.velocity;
        let [x, y] = add_scaled([x, y], perp(add_scaled(position, self.center, -1.0)), spin);
        [x, y, spin]
    }
}

/// Returns the largest joint error that rounding can cause at a body, for rotations of up to a hundred turns. Unit: length
/// units.
///
/// The arguments are the position of the centre of mass in the world and the distance from it to the anchor, in length units.
pub(super) fn max_rounding_error([x, y]: Vec2, arm: f64) -> f64 {
    MAX_POSITION_ROUNDING * (x.abs() + y.abs()) + MAX_ROTATION_ROUNDING * arm
}

/// Energy of an articulation at the start of a step. It includes the velocity change by forces that act in full at the start.
#[derive(Debug, Clone, Copy)]
pub(super) struct InitialEnergy {
    /// Kinetic energy at the start of the step. Unit: mass units * length units^2/s^2.
    kinetic: f64,
    /// Largest energy that joints can remove because the velocities at the start of the step violate the joints. Unit: mass
    /// units * length units^2/s^2.
    max_inelastic_loss: f64,
}

impl InitialEnergy {
    /// Returns the energy of these links at the start of a step.
    pub(super) fn of<N: BalancedLink>(links: &Links<N>) -> Self {
        let bodies = || links.iter().filter_map(N::end_state);
        let kinetic = bodies().map(|body| body.kinetic_energy()).sum();
        let mass: f64 = bodies().map(|body| body.mass).sum();
        let faster = |speed: f64, link: &N| speed.max(link.joint_velocity_error(&links[link.parent()]));
        let max_error = links.iter().fold(0.0, faster);
        InitialEnergy { kinetic, max_inelastic_loss: 0.5 * mass * max_error * max_error }
    }
}

/// Returns the largest work in a step of `dt` seconds of the joints with the world that were pulled apart before the step, in mass
/// units * length units^2/s^2. `None` if no joint was.
fn closing_work<N: BalancedLink>(links: &Links<N>, dt: f64) -> Option<f64> {
    let has_moved_anchor = |node: &&N| {
        node.has_joint_error_above(MAX_STEP_JOINT_ERROR) && links[node.parent()].end_state().is_none()
    };
    let moved = links.iter().filter(has_moved_anchor);
    moved.map(|node| node.max_closing_work(&links[node.parent()], dt)).reduce(|sum, work| sum + work)
}

/// Energies of a free articulation over a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct EnergyBalance {
    /// Kinetic energy at the end of the step. Unit: mass units * length units^2/s^2.
    end_kinetic: f64,
    /// Energy error: `end_kinetic` minus the sum of the kinetic energy at the start and the work of applied forces. Unit: mass
    /// units * length units^2/s^2.
    excess: f64,
    /// Scale of `excess`: the larger of the kinetic energies at start and end, plus the sum of the absolute work of forces on
    /// each body. Unit: mass units * length units^2/s^2.
    scale: f64,
    /// Greatest growth of a joint error in the step. Errors of linear rows are fractions of the joint's arms plus the radius of
    /// gyration, dimensionless; errors of angular rows are in radians.
    max_error_growth: f64,
    /// Whether joints closed position errors or removed velocities that violated the joints in this step. Energy losses are
    /// then legitimate.
    has_inelastic_loss: bool,
}

impl EnergyBalance {
    /// Returns the energy balance of a step of `dt` seconds in substeps of `h` seconds.
    ///
    /// Returns `None` if a moving root drives the articulation. If a joint with the world was pulled apart before the step, only
    /// an excess counts that closing it cannot explain, and that is so large that the step [has failed](Self::has_failed).
    pub(super) fn of<N: BalancedLink>(
        links: &Links<N>,
        start: InitialEnergy,
        [dt, h]: [f64; 2],
    ) -> Option<Self> {
        if links.iter().any(N::is_moving_fixed_root) {
            return None;
        }
        let closing_work = closing_work(links, dt);
        let max_rounding_work: f64 = links.iter().map(|node| node.max_rounding_work(dt)).sum();
        let (mut end_kinetic, mut work, mut work_size) = (0.0, 0.0, 0.0);
        for body in links.iter().filter_map(N::end_state) {
            let body_work = body.force_work(h);
            (end_kinetic, work, work_size) =
                (end_kinetic + body.kinetic_energy(), work + body_work, work_size + body_work.abs());
        }
        // A joint lifts a resting body whose position rounding keeps constant; this does no work.
        let excess = end_kinetic - (start.kinetic + work);
        let excess = if excess.abs() > max_rounding_work { excess } else { 0.0 };
        let scale = start.kinetic.max(end_kinetic) + work_size;
        let is_explained =
            closing_work.is_some_and(|work| !(excess > work && excess > FAILED_STEP_ENERGY_ERROR * scale));
        let excess = if is_explained { 0.0 } else { excess };
        let has_inelastic_loss = closing_work.is_some()
            || links.iter().any(|node| node.has_joint_error_above(MAX_WHIP_JOINT_ERROR))
            || start.max_inelastic_loss > MAX_INELASTIC_LOSS * scale;
        let growth = |node: &N| node.joint_error_growth(&links[node.parent()]);
        let max_error_growth = links.iter().fold(0.0, |most: f64, node| most.max(growth(node)));
        Some(EnergyBalance { end_kinetic, excess, scale, max_error_growth, has_inelastic_loss })
    }

    /// Returns whether the energy error is so large that the step must be repeated with more substeps.
    pub(super) fn exceeds_tolerance(&self) -> bool {
        !self.has_inelastic_loss && self.excess.abs() > MAX_STEP_ENERGY_ERROR * self.scale
    }

    /// Returns whether the step has opened a joint, or the energy error is so large that the positions cannot be right either. A
    /// loss counts unless it is legitimate.
    pub(super) fn has_failed(&self) -> bool {
        let loss = if self.has_inelastic_loss { 0.0 } else { -self.excess };
        self.max_error_growth > FAILED_STEP_JOINT_ERROR
            || self.excess.max(loss) > FAILED_STEP_ENERGY_ERROR * self.scale
    }

    /// Scales the velocities of `links` so that the energy error becomes 0. [`MAX_ENERGY_VELOCITY_SCALE`] bounds the factor;
    /// legitimate losses stay.
    pub(super) fn project_energy<N: BalancedLink>(&self, links: &mut Links<N>) {
        let is_free = links.first().is_some_and(N::is_free_root);
        let rigid = if is_free { RigidMotion::of(links) } else { RigidMotion::default() };
        let internal = self.end_kinetic - rigid.energy;
        let scale = (1.0 - self.excess / internal).max(0.0).sqrt().min(MAX_ENERGY_VELOCITY_SCALE);
        if !(internal > 0.0 && scale.is_finite())
            || self.excess == 0.0
            || (self.has_inelastic_loss && scale > 1.0)
        {
            return;
        }
        for link in links {
            if let Some(LinkEndState { velocity, position, .. }) = link.end_state() {
                let rigid_velocity = rigid.velocity_at(position);
                link.set_velocity(std::array::from_fn(|i| {
                    rigid_velocity[i] + scale * (velocity[i] - rigid_velocity[i])
                }));
            }
        }
    }
}
