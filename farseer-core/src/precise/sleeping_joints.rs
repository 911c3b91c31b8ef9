//! Adapter: joints of sleeping bodies. The bodies wake when one of their joints has been added, removed or edited since they
//! fell asleep.

use serde::{Deserialize, Serialize};

use super::ids::IdTable;
use crate::body::BodyId;
use crate::joints::constraint_spec::ConstraintSpec;
use crate::joints::{Joint, JointId};
use crate::objects::Objects;
use farseer_precise::bodies::BodySet;
use farseer_precise::depth::feature_gate::FeatureGate;
use farseer_precise::depth::state::DepthState;
use farseer_precise::island::sleep::SleepState;

/// State of a joint when its bodies fell asleep. The bodies wake when the state of the joint changes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct SleepingJoint {
    pub(super) joint: JointId,
    /// Bodies, anchors and kind of the joint when its bodies fell asleep.
    pub(super) held: ConstraintSpec,
    /// Softness, bias factor (dimensionless) and breakpoint of the joint. The meaning of softness depends on the kind of joint.
    /// Breakpoint of a distance: length units; of an angle: radians.
    #[serde(rename = "numbers")]
    pub(super) parameters: [f32; 3],
    /// Poses of those bodies of the joint that are outside of the solver (disabled, or not in the simulator): x, y (length
    /// units), rotation (radians), z (length units); zeros for other bodies. They reveal that such a body has moved.
    pub(super) unlisted: [[f32; 4]; 2],
}

impl SleepingJoint {
    /// Returns the ids of the one or two bodies of the joint.
    pub(super) fn bodies(&self) -> impl Iterator<Item = BodyId> {
        self.held.bodies.0.into_iter().chain([self.held.bodies.1])
    }

    /// Returns whether the joint connects a sleeping body.
    pub(super) fn holds_sleeping_body(&self, ids: &IdTable, sleep: &SleepState) -> bool {
        self.bodies().any(|body| ids.body_index(body).is_some_and(|number| sleep.is_asleep(number)))
    }

    /// Requests that the sleeping bodies of the joint wake.
    pub(super) fn request_wake(&self, ids: &IdTable, sleep: &mut SleepState) {
        self.bodies().filter_map(|body| ids.body_index(body)).for_each(|number| sleep.request_wake(number));
    }
}

/// Removes the joints without a sleeping body.
pub(super) fn drop_joints_of_awake(joints: &mut Vec<SleepingJoint>, ids: &IdTable, sleep: &SleepState) {
    joints.retain(|joint| joint.holds_sleeping_body(ids, sleep));
}

/// Parts from which the present state of a joint follows, for comparison with that at which its bodies fell asleep.
pub(super) struct JointComparison<'a> {
    pub(super) ids: &'a IdTable,
    pub(super) bodies: &'a BodySet,
    pub(super) depth: Option<FeatureGate<&'a DepthState>>,
    pub(super) objects: &'a Objects,
}

impl JointComparison<'_> {
    /// Returns the present state of a joint; `None` if the joint is disabled.
    fn state_of(&self, (id, joint): (JointId, &Joint)) -> Option<SleepingJoint> {
        if !joint.enabled() {
            return None;
        }
        let held = joint.constraint_spec();
        let unlisted = [held.bodies.0, Some(held.bodies.1)];
        let unlisted = unlisted.map(|id| id.map_or([0.0; 4], |id| self.pose_of_unlisted(id)));
        let parameters = [joint.softness(), joint.bias_factor(), joint.breakpoint()];
        Some(SleepingJoint { joint: id, held, parameters, unlisted })
    }

    /// Returns the pose of a body outside of the solver (disabled, or not in the simulator): x, y (length units), rotation
    /// (radians), z (length units). Zeros for bodies in the solver.
    fn pose_of_unlisted(&self, id: BodyId) -> [f32; 4] {
        let entry = self.objects.bodies.get(id).filter(|_| self.ids.body_index(id).is_none());
        entry.map_or([0.0; 4], |entry| {
            let (position, rotation) = (entry.body.position(), entry.body.rotation());
            let z = self.depth.map_or(0.0, |space| space.z_and_velocity(id.slot())[0]);
            [position.x, position.y, rotation, z]
        })
    }

    /// Lists in `known` the joints of sleeping bodies, as they are now, in the order of the simulator's list.
    pub(super) fn list_sleeping(&self, sleep: &SleepState, known: &mut Vec<SleepingJoint>) {
        let joints = &self.objects.joints;
        let all = (0..joints.list().len()).filter_map(|at| joints.at(at));
        known.clear();
        let now = all.filter_map(|joint| self.state_of(joint));
        known.extend(now.filter(|joint| joint.holds_sleeping_body(self.ids, sleep)));
    }

    /// Requests that bodies wake whose joints are in one list only: in `known`, or in that of the simulator.
    pub(super) fn wake_unless_known(&self, known: &[SleepingJoint], sleep: &mut SleepState) {
        let joints = &self.objects.joints;
        let mut is_listed = vec![false; joints.slot_count()];
        joints.list().iter().for_each(|joint| is_listed[joint.slot()] = true);
        self.wake_unless_unchanged(known, sleep, |joint| is_listed.get(joint.joint.slot()) == Some(&true));
        let mut is_known = vec![false; joints.slot_count()];
        for joint in known {
            // A damaged snapshot may contain any slot.
            is_known.get_mut(joint.joint.slot()).into_iter().for_each(|is_known| *is_known = true);
        }
        let all = (0..joints.list().len()).filter_map(|at| joints.at(at));
        let unknown = all.filter(|(id, _)| !is_known[id.slot()]);
        unknown
            .filter_map(|joint| self.state_of(joint))
            .for_each(|joint| joint.request_wake(self.ids, sleep));
    }

    /// Requests that the bodies of a joint in `known` wake if the joint has changed since they fell asleep, connects an awake
    /// dynamic body, or `may_stay` is false for it.
    pub(super) fn wake_unless_unchanged(
        &self,
        known: &[SleepingJoint],
        sleep: &mut SleepState,
        may_stay: impl Fn(&SleepingJoint) -> bool,
    ) {
        for joint in known {
            if !(may_stay(joint) && self.is_unchanged(joint)) || self.has_awake_body(joint, sleep) {
                joint.request_wake(self.ids, sleep);
            }
        }
    }

    /// Returns whether a dynamic body of a joint of sleeping bodies is awake. Such a body was static, kinematic or disabled
    /// when the other one fell asleep.
    fn has_awake_body(&self, joint: &SleepingJoint, sleep: &SleepState) -> bool {
        joint.bodies().filter_map(|body| self.ids.body_index(body)).any(|number| {
            number < self.bodies.first_static()
                && self.bodies.inverse_mass_inertia[number] != [0.0; 2]
                && !sleep.is_asleep(number)
        })
    }

    /// Returns whether a joint has not changed since its bodies fell asleep, and does not exceed its load limits.
    fn is_unchanged(&self, joint: &SleepingJoint) -> bool {
        let now = self.objects.joints.get(joint.joint).filter(|now| now.is_within_load_limits());
        now.and_then(|now| self.state_of((joint.joint, now))) == Some(*joint)
    }
}
