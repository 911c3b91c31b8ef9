//! Narrow phase: the parts of the solver that this stage reads and writes, and the pair that it works on. All other files of the
//! folder implement the stage on them.

use super::touch_event::TouchEvent;
use crate::bodies::BodySet;
use crate::broad_phase::pairs::Pairs;
use crate::broad_phase::proxies::{Proxies, Proxy};
use crate::constraint_graph::{ColorUsage, ConstraintGraph};
use crate::contact_solver::rolling::RollingContact;
use crate::depth::feature_gate::FeatureGate;
use crate::depth::state::DepthState;
use crate::direct_solver::DirectSolver;
use crate::index::{BodyIndex, PairIndex};
use crate::island::sleep::SleepState;
use crate::math::plane::{Pose, Vector, difference, rotate_inverse, rotation, translation};
use crate::scaled_parameters::Parameters;
use crate::surface::FrictionType;

/// The narrow phase: references to the state of the simulator that it reads and writes.
pub struct NarrowPhase<'a> {
    pub(crate) bodies: &'a BodySet,
    pub(crate) proxies: &'a Proxies,
    pub(crate) pairs: &'a mut Pairs,
    pub(crate) constraints: &'a mut ConstraintGraph,
    pub(crate) palette: &'a mut ColorUsage,
    pub(crate) sleep: &'a mut SleepState,
    pub(crate) direct: &'a mut DirectSolver,
    pub(crate) depth: Option<FeatureGate<&'a DepthState>>,
    pub(crate) parameters: &'a Parameters,
    pub(crate) friction: FrictionType,
    /// Largest number of contact points of two convex pieces, 1 or 2. Further points of a manifold are dropped, the shallowest
    /// first.
    pub(crate) max_contacts: usize,
    /// Length of the step, in seconds.
    pub(crate) dt: f32,
    /// Length of the substep in which the impulses of the constraints act, in seconds.
    pub(crate) impulse_substep: f32,
    /// Velocity change by gravity in the step, for a body of gravity scale 1, in length units/s.
    pub(crate) gravity_delta: Vector,
    /// Events of pairs of geoms that have begun or ceased to touch since the last report to the game.
    pub(crate) touch_events: &'a mut Vec<TouchEvent>,
    /// Contacts with static or kinematic bodies that have ended, in worlds with a depth axis: index of the dynamic body, and
    /// the penetration at the end in length units, >= 0.
    pub(crate) ended_static_contacts: &'a mut Vec<(BodyIndex, f32)>,
    pub(crate) stats: &'a mut NarrowPhaseStats,
    /// Workspace: indices of the pairs to update; empty between updates of contacts.
    pub(crate) dirty_pairs: &'a mut Vec<PairIndex>,
    /// Contacts of polygons that roll over a static face in this step. The solver updates these contacts in its substeps.
    pub(crate) rolling_contacts: &'a mut Vec<RollingContact>,
}

/// Numbers of pairs with contacts that the narrow phase has updated: those computed anew, and those recycled.
#[derive(Debug, Clone, Copy, Default)]
pub struct NarrowPhaseStats {
    /// Number of updated pairs whose manifold was computed anew.
    pub computed: usize,
    /// Number of updated pairs whose cached manifold was recycled.
    pub recycled: usize,
}

/// The proxies A and B of a pair, with the world poses of their bodies.
#[derive(Clone, Copy)]
pub(crate) struct ProxyPair<'a> {
    pub(crate) a: &'a Proxy,
    pub(crate) b: &'a Proxy,
    pub(crate) pose_a: Pose,
    pub(crate) pose_b: Pose,
}

impl ProxyPair<'_> {
    /// Returns the pose of B's body in the frame of A's body: x and y in length units, cosine and sine of the angle.
    pub(crate) fn relative_pose(&self) -> [f32; 4] {
        let (qa, qb) = (rotation(self.pose_a), rotation(self.pose_b));
        let [x, y] = rotate_inverse(qa, self.offset());
        let [c, s] = rotate_inverse(qa, qb);
        [x, y, c, s]
    }

    /// Returns the vector from the origin of A's body to the origin of B's body, in world axes, length units.
    pub(crate) fn offset(&self) -> Vector {
        difference(translation(self.pose_b), translation(self.pose_a))
    }
}
