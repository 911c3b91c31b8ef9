//! Snapshot of the precise set: all state that influences later bits.
//!
//! Data that follows from this state and from the simulator's objects is not saved. A rebuild of the lists uses this state,
//! too: it saves, lists everything anew and restores.
//!
//! | module | task |
//! |---|---|
//! | `save` | writes the state to [`Saved`] |
//! | `check` | validates a loaded [`Saved`] |
//! | `records` | the parts of [`Saved`] of which there are many, as words |
//! | `load` | serialises the engine, and lists everything anew from a loaded [`Saved`] |
//! | `restore` | applies a [`Saved`] to rebuilt lists |
//! | `pending_events` | typed events that the next update reports |

mod check;
mod load;
mod pending_events;
mod records;
mod restore;
mod save;

use serde::{Deserialize, Serialize};

use super::ids::owner_of;
use crate::body::BodyId;
use crate::geom::GeomId;
use crate::precise::sleeping_joints::SleepingJoint;
use farseer_precise::broad_phase::pairs::CachedManifoldZ;
use farseer_precise::broad_phase::pairs::OneWayState;
use farseer_precise::broad_phase::proxies::BodyType;
use farseer_precise::constraint_graph::saved_constraint::SavedConstraint;
use farseer_precise::depth::interface::DepthInterval;
use farseer_precise::direct_solver::{IslandHistory, ReselectionTimer};
use farseer_precise::index::IndexedVec;
use farseer_precise::math::plane::Vector;
use farseer_precise::narrow_phase::{TouchEvent, TouchKind};
use farseer_precise::scaled_parameters::Parameters;
use farseer_precise::surface::{FrictionType, SurfaceOptions};
use pending_events::SavedPendingEvents;

/// Saved state of the precise set. `Pairs`: the pairs, as a list or as an iterator that only a serializer reads.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Saved<Pairs = Vec<SavedPair>> {
    tuning: Parameters,
    /// Length of the substep in which the saved contact impulses act, seconds.
    #[serde(rename = "h")]
    substep: f32,
    /// Length of the last step, seconds.
    dt: f32,
    /// Whether a collision handler has disabled or changed a contact for the last step.
    has_handled: bool,
    friction: FrictionType,
    /// Greatest number of contact points of a pair of convex pieces, 0..=2.
    most_contacts: u32,
    proxies: IndexedVec<SavedProxyIndex, SavedProxy>,
    /// All pairs: first the awake pairs, then the pairs of sleeping bodies.
    pairs: Pairs,
    /// Number of awake pairs, which come first in `pairs`.
    #[serde(rename = "awake")]
    awake_pair_count: u32,
    /// Gravity in the last step: x, y in length units/s^2. Another gravity wakes the sleeping bodies.
    gravity: [f32; 2],
    /// Times for which awake bodies have been at rest, seconds.
    #[serde(rename = "rest")]
    rest_times: Vec<(BodyId, f32)>,
    /// All sleeping bodies.
    #[serde(rename = "sleepers")]
    sleeping_bodies: Vec<SavedSleepingBody>,
    /// Joints of sleeping bodies, as they were when the bodies fell asleep. A change wakes the bodies.
    joints: Vec<SleepingJoint>,
    /// Whether the saved state has a depth axis.
    is_in_space: bool,
    /// History of the solver selection, by body; histories with default values are left out.
    #[serde(rename = "wear")]
    solver_history: Vec<(BodyId, IslandHistory)>,
    /// Timer of the next solver selection.
    #[serde(rename = "timing")]
    reselection_timer: ReselectionTimer,
    /// Displacements of bodies in the last step, if there are one-way geoms: x, y (length units), rotation (radians), z (length
    /// units).
    #[serde(rename = "ways")]
    delta_poses: Vec<(BodyId, [f32; 4])>,
    /// Ids of bodies that the game has woken since the last update.
    woken: Vec<BodyId>,
    /// Ids of sleeping bodies that an override of a contact's surface wakes at the next import. Not serialised: they exist in
    /// the middle of an update only, in which a handler may cause a rebuild.
    #[serde(skip)]
    wake_requests: Vec<BodyId>,
    /// Touch events that the game has not received yet.
    #[serde(rename = "changes")]
    touch_events: Vec<SavedTouchEvent>,
    /// Other typed events that the next update reports.
    pending_events: SavedPendingEvents,
}

/// Saved form of a sleeping body.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(remote = "Self")]
struct SavedSleepingBody {
    /// Id of the body, or the id that stands for a hinged box.
    body: BodyId,
    /// Index into `Saved::sleeping_bodies` of the first body of the sleeping island.
    first: SavedSleeperIndex,
    /// Pose of the body in the world frame: x, y (length units), rotation (radians), z (length units).
    #[serde(rename = "place")]
    pose: [f32; 4],
    /// Acceleration by applied forces with which the body fell asleep: x, y (length units/s^2), angular (radians/s^2), z
    /// (length units/s^2).
    #[serde(rename = "borne")]
    supported_acceleration: [f32; 4],
    /// Reciprocals of mass (1/mass units) and moment of inertia (1/(mass units * length units^2)) of the body, its gravity scale
    /// (dimensionless), and its locked axes: 1 for x plus 2 for y.
    #[serde(rename = "nature")]
    constants: [f32; 4],
    /// Whether the body has just fallen asleep, so that the supported acceleration is not known yet.
    #[serde(rename = "is_fresh")]
    is_newly_asleep: bool,
}

/// Saved form of a proxy of the broad phase.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(remote = "Self")]
struct SavedProxy {
    geom: GeomId,
    /// Creation number of the geom, which is known even if the geom has been removed when the proxy is restored.
    number: u32,
    /// Index of the convex piece among the pieces of the geom.
    piece: u32,
    #[serde(rename = "mobility")]
    body_type: BodyType,
    /// Fat AABB of the proxy: low x, low y, high x, high y in length units, world frame.
    #[serde(rename = "bounds")]
    fat_aabb: [f32; 4],
    /// Fat interval of the proxy along the depth axis, length units.
    #[serde(rename = "depths")]
    depth_interval: DepthInterval,
    /// Upper bound of the path length of every point of the proxy since it was added, in 2^-26 length units, wrapping.
    #[serde(rename = "motion")]
    travel: u32,
    /// Whether the proxy has got a new fat AABB, so that the broad phase is to search its pairs.
    #[serde(rename = "has_escaped")]
    is_refitted: bool,
    /// Properties of the proxy and its body at the last import, by which edits are detected.
    #[serde(rename = "known")]
    imported: ImportedState,
}

/// Properties of a proxy and its body at the last import. If one of them differs from the current property, it was edited
/// since.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
struct ImportedState {
    /// Pose of the body in the world frame: x, y (length units), rotation (radians), z (length units).
    #[serde(rename = "place")]
    pose: [f32; 4],
    /// Reciprocals of mass (1/mass units) and moment of inertia (1/(mass units * length units^2)) of the body. Then its surface
    /// velocity: x, y (length units/s), angular (radians/s), z (length units/s). Then friction and restitution coefficient
    /// (dimensionless).
    #[serde(rename = "contacts")]
    contact_properties: [f32; 8],
    /// Combination rules, surface speed and rolling resistance of the geom.
    surface: SurfaceOptions,
    /// Collision filter: masks of the own and of the colliding categories, group, flags (1: collision is enabled, 2: both
    /// geoms must agree), number of changes of the ignored geoms. The last number has further flags. 1: contacts respond; then
    /// follow the bits of the wanted events.
    filter: [i32; 6],
    /// Outward direction of the solid side of a one-way geom, a unit vector in the frame of its body; else `None`.
    one_way: Option<Vector>,
    /// [Fingerprint](farseer_precise::fingerprint) of the shape of the proxy, a hash.
    fingerprint: u64,
}

/// Saved form of a [`TouchEvent`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
struct SavedTouchEvent {
    /// Creation numbers of the two geoms, the smaller one first.
    numbers: (u32, u32),
    /// Whether the touch begins (bit 0), and the [number](TouchKind::code) of its kind (further bits): bit flags.
    #[serde(rename = "begins")]
    flags: u8,
    geoms: (GeomId, GeomId),
}

impl SavedTouchEvent {
    /// Returns the saved form of an event.
    fn of(event: &TouchEvent) -> Self {
        let [one, other] = event.owners.map(GeomId::from_bits);
        let flags = u8::from(event.begins) | event.kind.code() << 1;
        SavedTouchEvent { numbers: event.numbers, flags, geoms: (one, other) }
    }

    /// Returns the event.
    fn event(&self) -> TouchEvent {
        let owners = [owner_of(self.geoms.0), owner_of(self.geoms.1)];
        let kind = TouchKind::of_code(self.flags >> 1);
        TouchEvent { numbers: self.numbers, begins: self.flags & 1 != 0, kind, owners }
    }
}

farseer_precise::index_type! {
    /// Index of a sleeping body in `Saved::sleeping_bodies`.
    pub struct SavedSleeperIndex;
}
farseer_precise::index_type! {
    /// Index of a proxy in `Saved::proxies`.
    pub struct SavedProxyIndex;
}

/// Saved form of a pair of proxies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct SavedPair {
    /// Indices of both proxies.
    proxies: [SavedProxyIndex; 2],
    /// Sum of the travels of both proxies at the last update of the pair, in 2^-26 length units, wrapping.
    #[serde(rename = "since")]
    motion_at_check: u32,
    /// Growth of the summed travels that triggers an update of the pair, in 2^-26 length units. For a pair of circles that
    /// touch: `UPDATED_BY_SOLVER`.
    #[serde(rename = "tolerance")]
    motion_tolerance: u32,
    /// Whether the pair touched according to its last touch event.
    #[serde(rename = "is_told")]
    is_touching: bool,
    /// Whether a collision handler has disabled the pair or removed contact points in this update.
    is_vetoed: bool,
    /// Whether a collision handler disabled the pair or removed contact points in the update before.
    was_vetoed: bool,
    /// State of a pair with a one-way geom: whether the one-way geom lets the other geom pass.
    #[serde(rename = "passage")]
    one_way_state: OneWayState,
    /// Contact points as the last narrow phase found them.
    #[serde(rename = "frozen")]
    manifold: SavedManifold,
    /// Contact constraint; `None` if the pair has none.
    #[serde(rename = "row")]
    constraint: Option<SavedConstraint>,
}

/// Contact points as the narrow phase found them, for contact recycling: see
/// [`CachedManifold`](farseer_precise::broad_phase::pairs::CachedManifold).
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(remote = "Self")]
struct SavedManifold {
    /// Cosine and sine of the rotation of A, then of B, when the manifold was computed. Dimensionless.
    #[serde(rename = "turns")]
    rotations: [f32; 4],
    /// Pose of B in the frame of A when the manifold was computed: x and y in length units, cosine and sine.
    #[serde(rename = "relative")]
    relative_pose: [f32; 4],
    /// Contact normal from A to B, a unit vector in world axes. Dimensionless.
    normal: [f32; 2],
    /// Number of contact points, 0..=2.
    count: u32,
    /// Vectors from the origins of A and B to each point, in world axes when the manifold was computed: [ax, ay, bx, by] in
    /// length units.
    anchors: [[f32; 4]; 2],
    /// Separations at both points, negative for penetration. Unit: length units.
    separations: [f32; 2],
    /// Feature ids of both points, for the warm start.
    features: [u32; 2],
    /// Angle by which the arms at B's vertices are rotated ahead, to the middle of the step. Unit: radians.
    #[serde(rename = "lead")]
    arm_lead_angle: f32,
    /// Additional data of contacts in three axes.
    #[serde(rename = "space")]
    depth: CachedManifoldZ,
}

/// When edits that were made since the saved state take effect, if the lists are rebuilt from that state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum EditPolicy<'a> {
    /// Applies all edits with the rebuild. The bodies are those that the game has edited since the saved state.
    Apply(&'a [BodyId]),
    /// Defers edits of collision filters, surface coefficients, shapes, poses and body types to the next update, and applies all
    /// others with the rebuild. AABBs stay those of the saved state.
    Defer,
}
