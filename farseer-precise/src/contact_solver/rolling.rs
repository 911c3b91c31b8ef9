//! Contacts of polygons that roll or topple over a static face, updated in every substep.
//!
//! The narrow phase runs once per step and finds two vertices. A polygon of 48 vertices that rolls with 12 rad/s passes more
//! than one vertex in 1/60 s. The next vertex would penetrate the face undetected. The resolution of this penetration would
//! lift the body in every step: potential energy out of nothing. So the edge that faces the plane is determined anew before
//! each substep. Separations and arms of its vertices are those of the middle of the substep. This midpoint rule makes the path
//! of a vertex exact to second order, and keeps the energy while the body pivots (E. Hairer, C. Lubich, G. Wanner, "Geometric
//! Numerical Integration", 2006, II.1).
//!
//! A polygon that neither slides nor leaves the face, and touches nothing but static faces of one plane, pivots in closed form
//! instead: [`pivoting`](crate::contact_solver::pivoting).

use crate::bodies::BodySet;
use crate::broad_phase::pairs::{CachedManifold, Pairs};
use crate::broad_phase::proxies::Proxies;
use crate::constraint_graph::{ConstraintGraph, ContactConstraint, ContactPoint};
use crate::contact_solver::pivoting::PivotState;
use crate::index::{BodyIndex, IndexedVec, PairIndex, ProxyIndex};
use crate::joints::JointSystem;
use crate::math::plane::{
    Rot, Vector, cross, difference, dot, rotate, rotate_inverse, rotation, scaled, sum, translation,
};
use crate::math::scalar;
use crate::narrow_phase::manifold::{find_incident_edge, next_index};
use crate::parameters::contacts::ROLLING_VERTEX_TOLERANCE;
use crate::scaled_parameters::{Parameters, StepContext};
use crate::shape::ShapeRef;
use crate::storage::order::sort_by_number;

/// A contact of a polygon that rolls over a static face in this step.
#[derive(Debug, Clone, Copy)]
pub struct RollingContact {
    /// Indices of two proxies: of the static face, then of the polygon.
    pub(crate) proxies: [ProxyIndex; 2],
    /// Index of the pair of both proxies, valid from [`RollingSolver::prepare`] to the end of the step.
    pub(crate) pair: PairIndex,
    /// Indices of the polygon's vertices at the two contact points.
    pub(crate) vertices: [u32; 2],
    /// Lengths added to the separations of both points for the relaxation, length units. With them the relaxation aims at the
    /// velocity that a pivoting polygon has at the end of the substep.
    end_velocity_offsets: [f32; 2],
    /// Separations of both points at the end of the substep, length units; negative for penetration.
    pub(crate) end_separations: [f32; 2],
    /// Accumulated normal impulses of both points before the substep, mass units * length units/s.
    initial_impulses: [f32; 2],
    /// Displacement of the polygon's body in this step without midpoint correction: x, y (length units), rotation (radians), z
    /// (length units).
    delta_pose: [f32; 4],
    /// Whether the polygon rotates so fast that its vertices on the face are determined anew in every substep.
    needs_vertex_updates: bool,
    /// State after the step of a polygon that pivots in closed form, in place of the result of the iterative solver. `None` for
    /// a polygon that the iterative solver moves.
    pub(crate) pivot: Option<PivotState>,
}

impl RollingContact {
    /// Returns a rolling contact between `proxies` (static face, polygon). `is_fast`: whether the vertices are determined anew
    /// in every substep. [`RollingSolver::prepare`] sets the other fields.
    pub(crate) fn new(proxies: [ProxyIndex; 2], is_fast: bool) -> Self {
        RollingContact {
            needs_vertex_updates: is_fast,
            pivot: None,
            proxies,
            pair: PairIndex::default(),
            vertices: [0; 2],
            end_velocity_offsets: [0.0; 2],
            end_separations: [0.0; 2],
            initial_impulses: [0.0; 2],
            delta_pose: [0.0; 4],
        }
    }
}

/// Plane of a static face under a polygon.
#[derive(Clone, Copy)]
pub(crate) struct StaticPlane {
    /// Unit normal of the plane towards the polygon, in world axes.
    pub(crate) normal: Vector,
    /// Signed distance along the normal from the origin of a body to the plane, length units. The body is that of the static
    /// face (A) in planes from [`of`](Self::of), that of the polygon (B) in `pivoting_bodies`.
    pub(crate) offset: f32,
}

impl StaticPlane {
    /// Returns the plane of the static face A of a cached manifold: through its first contact point, moved along the normal
    /// onto the surface of A.
    pub(crate) fn of(manifold: &CachedManifold) -> Self {
        let (normal, [ax, ay, ..]) = (manifold.normal, manifold.anchors[0]);
        StaticPlane { normal, offset: dot([ax, ay], normal) - 0.5 * manifold.separations[0] }
    }
}

/// The parts of the engine that the solver of rolling contacts reads and writes.
pub(crate) struct RollingSolver<'a> {
    pub(crate) bodies: &'a mut BodySet,
    pub(crate) proxies: &'a Proxies,
    pub(crate) pairs: &'a mut Pairs,
    pub(crate) constraints: &'a mut ConstraintGraph,
    pub(crate) joints: &'a JointSystem,
    pub(crate) parameters: &'a Parameters,
    /// Whether the bodies move in the plane: in three axes outlines that overlap in the plane may be separated along z.
    pub(crate) is_planar: bool,
    /// Workspace with an entry for each proxy, all false.
    pub(crate) proxy_flags: &'a mut IndexedVec<ProxyIndex, bool>,
}

impl RollingSolver<'_> {
    /// Finds the rolling contacts of this step, before the substeps, and removes all others from `rolling`. A rolling
    /// contact either has a polygon that pivots in closed form: `pivot` is its state after the step. Or its polygon rotates
    /// fast and has vertices at the contact points: [`match_vertices`](Self::match_vertices) stores the pair and these
    /// vertices.
    pub(crate) fn prepare(&mut self, rolling: &mut Vec<RollingContact>, step: &StepContext) {
        sort_by_number(rolling, |roll| self.proxies.creation_numbers(roll.proxies));
        rolling.dedup_by_key(|roll| roll.proxies);
        self.find_pivoting_bodies(rolling, step);
        rolling.retain_mut(|roll| {
            roll.pivot.is_some() || (roll.needs_vertex_updates && self.match_vertices(roll).is_some())
        });
    }

    /// Finds the pair of a rolling contact and the polygon's vertices at its contact points, and stores both in `roll`. Returns
    /// `None` if a point is not at a vertex, if the polygon does not rotate or is not convex, or if the contact is not planar
    /// or not in the iterative solver.
    fn match_vertices(&self, roll: &mut RollingContact) -> Option<()> {
        let pair =
            self.pairs.pairs_of(roll.proxies[1]).find(|&at| self.pairs.proxies_of(at) == roll.proxies)?;
        let (state, manifold) = (self.pairs.state(pair), self.pairs.manifold(pair));
        let handle = state.constraint.filter(|&home| self.constraints.parked(home).is_none())?;
        let outline = self.proxies.shape_of(roll.proxies[1]);
        let is_flat = manifold.depth.normal_z == 0.0 && manifold.depth.patch_radius == 0.0;
        let is_convex = !(outline.vertices.is_empty() || outline.shape.is_linked());
        let has_mass = self.constraints.get(state.kind, handle).inverse_masses[1] > 0.0;
        if !(is_flat && is_convex && has_mass) || manifold.arm_lead_angle == 0.0 {
            return None;
        }
        let [_, _, c, s] = manifold.rotations;
        let ends = incident_edge(outline, rotate_inverse([c, s], manifold.normal));
        let tangent = [-manifold.normal[1], manifold.normal[0]];
        let is_at = |at: usize, corner: u32| {
            let [_, _, bx, by] = manifold.anchors[at];
            let off = difference([bx, by], rotate([c, s], outline.vertices[corner as usize]));
            dot(off, tangent).abs() <= ROLLING_VERTEX_TOLERANCE * outline.shape.max_extent
        };
        let is_turned = !is_at(0, ends[0]);
        let corners = if is_turned { [ends[1], ends[0]] } else { ends };
        let are_corners = (0..manifold.point_count()).all(|at| is_at(at, corners[at]));
        (roll.pair, roll.vertices) = (pair, corners);
        are_corners.then_some(())
    }

    /// Moves the contact points of rolling polygons to the vertices that face the plane in the middle of the coming substep.
    pub(crate) fn begin_substep(
        &mut self,
        rolling: &mut [RollingContact],
        step: &StepContext,
        is_first: bool,
    ) {
        rolling.iter_mut().for_each(|roll| self.update_rolling_contact(roll, step, is_first));
    }

    /// Updates one rolling contact for the middle of the coming substep: vertices, arms, separations, effective masses and
    /// impulses of both points.
    fn update_rolling_contact(&mut self, roll: &mut RollingContact, step: &StepContext, is_first: bool) {
        if roll.pivot.is_some() {
            return;
        }
        let (pair, [at_a, at_b]) = (roll.pair, roll.proxies);
        (roll.end_velocity_offsets, roll.initial_impulses) = ([0.0; 2], [f32::MAX; 2]);
        let Some(handle) = self.pairs.state(pair).constraint else { return };
        let [a, b] = roll.proxies.map(|proxy| self.proxies.body_of(proxy));
        let outline = self.proxies.shape_of(at_b);
        let edge = self.rolling_edge(roll, step, is_first);
        let plane_normal = edge.plane.normal;
        let face = self.proxies.shape_of(at_a);
        let on_face = |arm: &Vector| {
            is_over_face(face, rotation(self.bodies.poses[a]), plane_normal, sum(edge.apart, *arm))
        };
        if !self.pairs.state(pair).is_on_ground && !edge.arms.iter().all(on_face) {
            return;
        }
        let radius = outline.shape.radius;
        let kind = self.pairs.state(pair).kind;
        let old = self.constraints.get(kind, handle);
        let mut constraint = old;
        edge.set_points(&mut constraint, roll.vertices, &old, radius);
        let reach = self.parameters.speculative_distance;
        constraint.tangent_arms[1] = friction_arm(&constraint, edge.arms, plane_normal, radius, reach);
        let turning =
            constraint.inverse_inertias[1] * constraint.tangent_arms[1] * constraint.tangent_arms[1];
        constraint.tangent_mass = 1.0 / (constraint.inverse_masses[1] + turning);
        roll.end_velocity_offsets = edge.end_velocity_offsets(outline);
        roll.vertices = edge.corners;
        roll.initial_impulses = constraint.points.map(|point| point.normal_impulse);
        self.replace_warm_start(b, &old, &constraint);
        self.constraints.set(kind, handle, &constraint);
    }

    /// Returns the edge on which a polygon rolls, in the middle of the coming substep.
    fn rolling_edge(&self, roll: &RollingContact, step: &StepContext, is_first: bool) -> RollingEdge {
        let [a, b] = roll.proxies.map(|proxy| self.proxies.body_of(proxy));
        let plane = StaticPlane::of(self.pairs.manifold(roll.pair));
        let path = if is_first { [0.0; 4] } else { self.bodies.delta_pose[b] };
        let half_turn = 0.5 * step.h * self.bodies.states[b].velocity[2];
        let (sine, cosine) = scalar::sin_cos(path[2] + half_turn);
        let q = rotate([cosine, sine], rotation(self.bodies.poses[b]));
        let apart = difference(translation(self.bodies.poses[b]), translation(self.bodies.poses[a]));
        let apart = sum(apart, [path[0], path[1]]);
        let outline = self.proxies.shape_of(roll.proxies[1]);
        let corners = incident_edge(outline, rotate_inverse(q, plane.normal));
        let arms = corners.map(|corner| rotate(q, outline.vertices[corner as usize]));
        RollingEdge { plane, half_turn, rotation: q, apart, corners, arms }
    }

    /// Adjusts the warm start of body `b` after an update of its constraint. Adds the velocity change by the normal impulses
    /// and angular impulses of `new`, and subtracts that of `old`.
    fn replace_warm_start(&mut self, b: BodyIndex, old: &ContactConstraint, new: &ContactConstraint) {
        let normal_impulse =
            |lane: &ContactConstraint| lane.points[0].normal_impulse + lane.points[1].normal_impulse;
        let angular_impulse = |lane: &ContactConstraint| {
            let of_points: f32 =
                lane.points.iter().map(|point| point.normal_impulse * point.normal_arm_b).sum();
            of_points + lane.tangent_impulse * lane.tangent_arms[1]
        };
        let change = new.inverse_masses[1] * (normal_impulse(new) - normal_impulse(old));
        let warm = &mut self.bodies.warm_start[b];
        warm[0] += change * new.normal[0];
        warm[1] += change * new.normal[1];
        warm[2] += new.inverse_inertias[1] * (angular_impulse(new) - angular_impulse(old));
    }

    /// Sets the separations of the rolling contacts for the relaxation of this substep.
    ///
    /// The solve with bias gives the velocity in the middle of the substep, by which the body moves. The relaxation is to leave
    /// the velocity at the end of the substep. Both use the arms of the middle, so that impulses at the vertex about which the
    /// polygon pivots do no work. With one velocity for both purposes, each substep would lose the energy (r w^2 h)^2 / 2 per
    /// unit of mass. Here r is the distance from that vertex to the centre of mass, w the angular velocity and h the length of
    /// the substep.
    ///
    /// The relaxation is speculative: it stops a vertex that would reach the face within one more substep. That is too early
    /// for the next vertex. The energy loss of its impact grows with the square of the angle by which the impact comes too
    /// early. So a vertex that does not reach the face in this substep gets a separation that excludes it from the relaxation.
    pub(crate) fn set_relax_separations(&mut self, rolling: &mut [RollingContact]) {
        for roll in rolling.iter_mut().filter(|roll| roll.pivot.is_none()) {
            let state = self.pairs.state(roll.pair);
            let Some(handle) = state.constraint else { continue };
            let constraint = self.constraints.get(state.kind, handle);
            let [x, y, turned, _] = self.bodies.states[constraint.b].displacement;
            let mut separations = [0.0; 2];
            for (at, point) in constraint.points.iter().enumerate() {
                let after = point.separation + dot([x, y], constraint.normal) + turned * point.normal_arm_b;
                let is_free = point.normal_impulse == 0.0 && roll.initial_impulses[at] == 0.0;
                let arrives_later = is_free && after > 0.0;
                roll.end_separations[at] = after;
                separations[at] = point.separation
                    + if arrives_later { self.parameters.length_unit } else { roll.end_velocity_offsets[at] };
            }
            self.constraints.set_separations(state.kind, handle, separations);
        }
    }

    /// Stores in each rolling contact the displacement of its polygon in the step, which the midpoint correction must not
    /// change.
    pub(crate) fn save_delta_poses(&self, rolling: &mut [RollingContact]) {
        for roll in rolling {
            let path = self.bodies.delta_pose[self.proxies.body_of(roll.proxies[1])];
            roll.delta_pose = roll.pivot.map_or(path, |after| {
                [after.delta_position[0], after.delta_position[1], after.delta_rotation, 0.0]
            });
        }
    }

    /// Sets the displacement of each rolling polygon in the step to the stored one, after the midpoint correction.
    pub(crate) fn restore_delta_poses(&mut self, rolling: &[RollingContact]) {
        for roll in rolling {
            self.bodies.delta_pose[self.proxies.body_of(roll.proxies[1])] = roll.delta_pose;
        }
    }
}

/// Edge of a polygon that faces the plane on which the polygon rolls, in the middle of a substep. World axes.
struct RollingEdge {
    plane: StaticPlane,
    /// Rotation of the polygon in half of the substep, radians.
    half_turn: f32,
    /// Cosine and sine of the rotation of the polygon.
    rotation: Vector,
    /// Position of the polygon's body relative to that of the face, length units.
    apart: Vector,
    /// Indices of the vertices at both ends of the edge.
    corners: [u32; 2],
    /// Vectors from the origin of the polygon's body to both vertices, length units.
    arms: [Vector; 2],
}

impl RollingEdge {
    /// Sets the two points of `constraint` to the ends of the edge. A point at a vertex of the last substep (`known`) keeps the
    /// impulses that the point had in `old`. `radius`: rounding of the polygon, length units.
    fn set_points(
        &self,
        constraint: &mut ContactConstraint,
        known: [u32; 2],
        old: &ContactConstraint,
        radius: f32,
    ) {
        let RollingEdge { plane, half_turn, apart, corners, arms, .. } = self;
        for at in 0..2 {
            let from = match known.iter().position(|&corner| corner == corners[at]) {
                Some(from) => Some(from),
                None if known.iter().any(|corner| corners.contains(corner)) => None,
                None => Some(at),
            };
            let arm_b = cross(arms[at], plane.normal);
            let middle = dot(sum(*apart, arms[at]), plane.normal) - radius - plane.offset;
            let kept = from.map_or(ContactPoint::default(), |from| old.points[from]);
            constraint.points[at] = ContactPoint {
                normal_arm_a: 0.0,
                normal_arm_b: arm_b,
                separation: middle - half_turn * arm_b,
                normal_impulse: kept.normal_impulse,
                // With a rest impulse of 0 the contact would sag at each new vertex, which loses energy.
                rest_impulse: kept.normal_impulse,
                normal_mass: 0.0,
            };
            constraint.points[at].normal_mass = constraint.effective_mass(&constraint.points[at]);
            constraint.depth.totals[at] = from.map_or(0.0, |from| old.depth.totals[from]);
        }
    }

    /// Returns [`RollingContact::end_velocity_offsets`] for vertices that are still on the facing edge at the end of the substep;
    /// else 0. Length units.
    fn end_velocity_offsets(&self, outline: ShapeRef<'_>) -> [f32; 2] {
        let RollingEdge { plane, half_turn, rotation, corners, arms, .. } = self;
        let (sine, cosine) = scalar::sin_cos(*half_turn);
        let still_face =
            incident_edge(outline, rotate_inverse(rotate([cosine, sine], *rotation), plane.normal));
        std::array::from_fn(|at| {
            let stays = still_face.contains(&corners[at]);
            if stays { -2.0 * half_turn * half_turn * dot(arms[at], plane.normal) } else { 0.0 }
        })
    }
}

/// Returns the indices of the two vertices of the incident edge, whose normal is most opposite to `direction`, in the order in
/// which clipping gives them. `direction` is in the frame of the outline.
pub(crate) fn incident_edge(outline: ShapeRef<'_>, direction: Vector) -> [u32; 2] {
    let edge = find_incident_edge(outline, direction);
    [next_index(edge, outline.vertices.len()) as u32, edge as u32]
}

/// Returns whether `point` projects onto the face of `face` whose normal is `normal`. Point and normal are in world axes, the
/// point relative to the origin of the face's body, length units. `q`: cosine and sine of that body's rotation.
pub(crate) fn is_over_face(face: ShapeRef<'_>, q: Rot, normal: Vector, point: Vector) -> bool {
    FaceExtent::of(face, rotate_inverse(q, normal)).contains(rotate_inverse(q, point))
}

/// A face of a convex shape, in the frame of the shape's body.
pub(crate) struct FaceExtent {
    /// First end of the face. Unit: length units.
    start: Vector,
    /// Vector from the first end to the second. Unit: length units.
    along: Vector,
    /// Outward unit normal.
    normal: Vector,
}

impl FaceExtent {
    /// Returns the face of `face` whose normal is most in the direction of `normal`.
    pub(crate) fn of(face: ShapeRef<'_>, normal: Vector) -> Self {
        let [first, edge] = incident_edge(face, scaled(normal, -1.0)).map(|end| end as usize);
        let (start, end) = (face.vertices[first], face.vertices[edge]);
        FaceExtent { start, along: difference(end, start), normal: face.normals[edge] }
    }

    /// Returns whether the normal of the face is the unit vector `direction`, up to an angle whose sine is `tolerance`.
    pub(crate) fn is_normal_to(&self, direction: Vector, tolerance: f32) -> bool {
        cross(self.normal, direction).abs() <= tolerance && dot(self.normal, direction) > 0.0
    }

    /// Returns whether `point` projects onto the face.
    pub(crate) fn contains(&self, point: Vector) -> bool {
        let at = dot(difference(point, self.start), self.along);
        at >= 0.0 && at <= dot(self.along, self.along)
    }
}

/// Returns the arm of the friction row about the polygon's centre of mass, length units: cross product r x t of the vector r to
/// a contact point and the tangent t. It is the mean over the points with a separation below `reach` (length units). If there
/// is none, it is the arm of the point with the smaller separation.
fn friction_arm(
    constraint: &ContactConstraint,
    arms: [Vector; 2],
    normal: Vector,
    radius: f32,
    reach: f32,
) -> f32 {
    let arm = |at: usize| radius + 0.5 * constraint.points[at].separation - dot(arms[at], normal);
    let [first, second] = [0, 1].map(|at| constraint.points[at].separation);
    match (first < reach, second < reach) {
        (true, false) => arm(0),
        (false, true) => arm(1),
        (true, true) => 0.5 * (arm(0) + arm(1)),
        (false, false) if second < first => arm(1),
        (false, false) => arm(0),
    }
}
