//! Adapter: bodies that keep their x or y coordinate.
//!
//! A lock is infinite mass along an axis of the world. In the solvers it is a joint to the world that keeps one coordinate, or both:
//! rows beside those of contacts and joints. Velocity and forces along a locked axis are 0 when a step begins. The step's end
//! removes the remainders of rounding and position corrections along the axis, so that a locked coordinate keeps its bits.

use super::ids::IdTable;
use crate::body::{Body, BodyId};
use crate::objects::Objects;
use crate::storage::arena::Id as _;
use farseer_precise::Solver;
use farseer_precise::index::BodyIndex;
use farseer_precise::joints::joint_constraint::{JointAnchor, JointConstraint};
use farseer_precise::joints::locked_dofs::LockedDofs;
use farseer_precise::reusing_clone;

/// The bodies with locked axes.
#[derive(Debug, Default)]
pub(super) struct AxisLocks {
    /// Each body with its locked axes, x and y, sorted by the ranks of the bodies.
    bodies: Vec<(BodyId, [bool; 2])>,
}

reusing_clone! { AxisLocks { bodies } }

impl AxisLocks {
    /// Returns whether no body has locked axes.
    pub(super) fn is_empty(&self) -> bool {
        self.bodies.is_empty()
    }

    /// Returns the locked axes of a body, x and y.
    pub(super) fn axes_of(&self, id: BodyId) -> [bool; 2] {
        let place = self.bodies.binary_search_by_key(&id.rank(), |(other, _)| other.rank());
        place.map_or([false; 2], |at| self.bodies[at].1)
    }

    /// Notes the locks of a body. It is called whenever a body is listed or edited. Returns whether they have changed.
    pub(super) fn note(&mut self, id: BodyId, body: &Body) -> bool {
        let axes = body.locked_axes();
        let place = self.bodies.binary_search_by_key(&id.rank(), |(other, _)| other.rank());
        match (place, axes.contains(&true)) {
            (Ok(at), true) => std::mem::replace(&mut self.bodies[at], (id, axes)) != (id, axes),
            (Ok(at), false) => {
                self.bodies.remove(at);
                true
            }
            (Err(at), true) => {
                self.bodies.insert(at, (id, axes));
                true
            }
            (Err(_), false) => false,
        }
    }

    /// Removes bodies that are gone, and returns the others with their locked axes.
    pub(super) fn living(&mut self, objects: &Objects) -> &[(BodyId, [bool; 2])] {
        self.bodies.retain(|(id, _)| objects.bodies.get(*id).is_some());
        &self.bodies
    }

    /// Calls `hold` with the locked axes and the index of each listed dynamic body.
    fn for_each(&self, ids: &IdTable, solver: &mut Solver, hold: fn(&mut Solver, BodyIndex, usize)) {
        for &(id, axes) in &self.bodies {
            let index = ids.body_index(id).filter(|&index| solver.bodies.is_dynamic(index));
            for axis in (0..2).filter(|&axis| axes[axis]) {
                index.into_iter().for_each(|index| hold(solver, index, axis));
            }
        }
    }

    /// Removes velocities and forces along locked axes, when a step begins.
    pub(super) fn stop(&self, ids: &IdTable, solver: &mut Solver) {
        self.for_each(ids, solver, |Solver { bodies, .. }, index, axis| {
            bodies.states[index].velocity[axis] = 0.0;
            bodies.initial_velocity[index][axis] = 0.0;
            bodies.force_delta[index][axis] = 0.0;
            bodies.force_position_delta[index][axis] = 0.0;
        });
    }

    /// Removes velocities and displacements along locked axes, when a step ends.
    pub(super) fn hold(&self, ids: &IdTable, solver: &mut Solver) {
        self.for_each(ids, solver, |Solver { bodies, .. }, index, axis| {
            bodies.states[index].velocity[axis] = 0.0;
            bodies.delta_pose[index][axis] = 0.0;
        });
    }
}

/// Returns the joint to the world that keeps the locked `axes` of the body with this anchor at its centre of mass, at the present
/// pose.
pub(super) fn lock_constraint(body: JointAnchor, axes: [bool; 2]) -> JointConstraint {
    let (locked, axis) = match axes {
        [true, true] => (LockedDofs::Point, [0.0; 2]),
        // The axis is the one that stays free.
        [true, false] => (LockedDofs::PointOnLine, [0.0, 1.0]),
        [false, _] => (LockedDofs::PointOnLine, [1.0, 0.0]),
    };
    let world = JointAnchor { arm: body.position, ..JointAnchor::default() };
    let joint = JointConstraint::new(locked, [world, body], f64::from(f32::MAX));
    JointConstraint { axis, local_axis: axis, is_axis_lock: true, ..joint }
}

/// Moves the anchor on the world to the present place of the body, and removes the force of the last step.
///
/// So a lock has neither errors nor a warm start, and a restored simulator continues with the same bits.
pub(super) fn begin_lock(constraint: &mut JointConstraint) {
    constraint.anchors[0].arm = constraint.anchors[1].position;
    constraint.force = [0.0; 3];
}
