//! Narrow phase: ghost filter for internal edges. It prevents ghost collisions with the joints between edges of a chain, and
//! between convex pieces of a concave outline.
//!
//! A contact normal w, outward from a piece, must be a normal of the whole outline at the contact point (its Gauss map; E.
//! Catto, "Ghost Collisions", box2d.org, 2020, and `b2ClassifyNormal` in Box2D's `manifold.c`):
//!
//! - on an edge of the outline only its own normal n is allowed, on an internal edge none;
//! - at a convex vertex between edges of normals n and n' all normals from n to n' are allowed. With cross(n, n') > 0 for a
//!   convex vertex, w lies between them if cross(n, w) >= 0 and cross(w, n') >= 0;
//! - at a straight or concave vertex only n and n' are allowed.
//!
//! For each candidate axis, an edge normal of either shape, a piece is tested at its support vertex along w. If both edges
//! there belong to the outline, w lies between their normals and is *admitted*. An internal edge is replaced by the adjacent
//! edge of the outline. A normal beyond that edge's at a convex vertex is *skipped*: the adjacent piece has the contact. Any
//! normal but n at a straight or concave vertex is *snapped*: the contact moves to the piece's own edge.
//!
//! So collinear edges have the normal of their common line everywhere. Contact points of two pieces at one vertex share the
//! normal impulse. A snapped contact is dropped if its penetration along the new normal far exceeds that along w, because it
//! then belongs to another piece.

use crate::math::plane::{
    Pose, Vector, cross, difference, dot, rotate, rotate_inverse, rotation, scaled, sum, translation,
};
use crate::narrow_phase::capsule::{are_cores_separated, is_along_normal};
use crate::narrow_phase::manifold::Manifold;
use crate::narrow_phase::shape_pair::{ClosestFeatures, PairSide, ShapePair, WhichShape};
use crate::parameters::narrow_phase::{
    REFERENCE_EDGE_HYSTERESIS, SNAP_MAX_PENETRATION_RATIO, STRAIGHT_VERTEX_MAX_SIN, VORONOI_TOLERANCE_SIN,
};
use crate::shape::ShapeRef;

/// Classification of a contact normal against the outline. The cases and their names are Box2D's: `b2_normalAdmit`,
/// `b2_normalSkip` and `b2_normalSnap` of `enum b2NormalType` in `manifold.c` (E. Catto).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Verdict {
    /// The outline has this normal at the contact point: the contact counts.
    Admitted,
    /// The normal belongs to a neighbouring piece: the contact is dropped, because that piece has it.
    Skipped,
    /// The outline has no such normal at the contact point: the contact takes the normal of the piece's own edge.
    Snapped,
}

/// Separations of one shape, without its radius, along the edge normals of another shape.
#[derive(Clone, Copy)]
struct SeparatingAxes {
    /// Largest separation over all edges, internal ones included, in length units, negative for penetration.
    max_separation: f32,
    /// Largest separation over the edges that belong to the outline, in length units, negative for penetration, and the index
    /// of that edge. `None` if all edges are internal.
    best_outer_edge: Option<(f32, usize)>,
}

/// Returns the manifold of two polygons without radii, of which at least one is linked. `margin`: contact margin in length
/// units.
pub(crate) fn polygons(shapes: &ShapePair<'_>, margin: f32) -> Manifold {
    match axes_within_margin(shapes, margin) {
        Ok(axes) => best_axis_contact(shapes, axes, margin),
        Err(gap) => Manifold::separated(gap),
    }
}

/// Returns the manifold of a linked polygon and a capsule, in either order. `margin`: contact margin in length units.
pub(crate) fn capsule(shapes: &ShapePair<'_>, margin: f32) -> Manifold {
    let axes = match axes_within_margin(shapes, margin) {
        Ok(axes) => axes,
        Err(gap) => return Manifold::separated(gap),
    };
    let greatest = larger(axes[0].max_separation, axes[1].max_separation);
    match shapes
        .closest_features(margin)
        .filter(|&(distance, _)| are_cores_separated(shapes, greatest, distance))
    {
        Some((distance, ClosestFeatures::Edge(which, edge))) => {
            edge_contact(shapes, axes, (which, edge), distance, margin)
        }
        Some((distance, ClosestFeatures::Vertices { vertex_a, vertex_b, offset })) => {
            let w = scaled(offset, 1.0 / distance);
            let (verdict, which) = stricter_verdict(
                classify_normal(&shapes.a, w),
                classify_normal(&shapes.b, shapes.a.to_other(scaled(w, -1.0))),
            );
            match verdict {
                Verdict::Admitted => vertex_contact(shapes, axes, (vertex_a, vertex_b, offset), margin),
                Verdict::Skipped => Manifold::separated(0.0),
                Verdict::Snapped => snap_to_edge(shapes, axes, which, distance, margin),
            }
        }
        None => best_axis_contact(shapes, axes, margin),
    }
}

/// Returns the manifold of a linked polygon A and a circle B: at most one point, at an edge of the outline or at a vertex. The
/// vertex is used if the centre of the circle is in the vertex's Voronoi region of the whole outline.
pub(crate) fn circle(a: ShapeRef<'_>, b: ShapeRef<'_>, pose_a: Pose, pose_b: Pose, margin: f32) -> Manifold {
    let q = rotation(pose_a);
    let centre_b =
        sum(difference(translation(pose_b), translation(pose_a)), rotate(rotation(pose_b), b.shape.centre));
    let centre = rotate_inverse(q, centre_b);
    let radius = b.shape.radius;
    let axes = axes_of(a, |normal, point| dot(normal, difference(centre, point)));
    if axes.max_separation > margin + radius {
        return Manifold::separated(axes.max_separation - radius);
    }
    let Some((height, edge)) = axes.best_outer_edge.filter(|_| is_in_front(a, centre)) else {
        return Manifold::separated(0.0);
    };
    let is_outside = axes.max_separation > 0.0;
    if is_outside && axes.max_separation > height {
        // An internal edge is closer, so the centre faces another piece.
        return Manifold::separated(0.0);
    }
    let (normal, distance) = match vertex_region(a, edge, centre) {
        // A two-sided edge has no inside, also where the centre is on its line.
        Some((offset, is_own)) if is_outside || a.is_two_sided() => {
            if !is_own {
                return Manifold::separated(0.0);
            }
            let distance = dot(offset, offset).sqrt();
            if distance > 0.0 {
                (scaled(offset, 1.0 / distance), distance)
            } else {
                (a.normals[edge], height)
            }
        }
        _ => (a.normals[edge], height),
    };
    let separation = distance - radius;
    let point = difference(centre, scaled(normal, radius + 0.5 * separation));
    Manifold::single_point(normal, point, separation, edge as u32, margin).to_world(q)
}

/// Returns the vector from an end of an edge to a point beyond that end, in the frame of the shape, length units; `None` if the
/// point projects between the ends. The flag tells whether the point is also beyond the adjacent edge of the outline, so that
/// the vertex is the closest feature.
fn vertex_region(a: ShapeRef<'_>, edge: usize, point: Vector) -> Option<(Vector, bool)> {
    let [start, end] = [edge, (edge + 1) % a.vertices.len()].map(|corner| a.vertices[corner]);
    let [before, after] = a.adjacency()[edge].neighbours.map(|[x, y]| [-y, x]);
    let along = difference(end, start);
    let (from_start, from_end) = (difference(point, start), difference(point, end));
    if dot(from_start, along) < 0.0 {
        Some((from_start, dot(from_start, before) >= 0.0))
    } else if dot(from_end, along) > 0.0 {
        Some((from_end, dot(from_end, after) <= 0.0))
    } else {
        None
    }
}

/// Returns the separations along the edge normals of A, then of B. `Err` holds a lower bound of the distance of the shapes in
/// length units, if it exceeds `margin`. `Err(0.0)`: a contact with the back of a chain edge, or of two chain edges, does not
/// exist.
fn axes_within_margin(shapes: &ShapePair<'_>, margin: f32) -> Result<[SeparatingAxes; 2], f32> {
    let (a, b) = (&shapes.a, &shapes.b);
    let radius = shapes.total_radius();
    let axes = [(a, b), (b, a)].map(|(this, other)| axes_of_side(this, other));
    let greatest = larger(axes[0].max_separation, axes[1].max_separation);
    if greatest > margin + radius {
        return Err(greatest - radius);
    }
    let in_front = |this: &PairSide<'_>, other: &PairSide<'_>| {
        is_in_front(this.shape_ref, this.to_local(other.shape_ref.shape.centre))
    };
    if are_both_chain_edges(shapes) || !in_front(a, b) || !in_front(b, a) {
        return Err(0.0);
    }
    Ok(axes)
}

/// Returns the larger of two numbers; `a` if one of them is NaN.
fn larger(a: f32, b: f32) -> f32 {
    if b > a { b } else { a }
}

/// Returns whether both shapes are edges of chains. Such edges have no inside, and do not collide with each other.
fn are_both_chain_edges(shapes: &ShapePair<'_>) -> bool {
    [shapes.a, shapes.b].iter().all(|side| side.shape_ref.is_chain_edge())
}

/// Returns whether a point is on the colliding side of a one-sided chain edge; true for all other shapes. `point` is in the frame
/// of the shape's body.
fn is_in_front(shape: ShapeRef<'_>, point: Vector) -> bool {
    !shape.is_one_sided() || dot(shape.normals[0], difference(point, shape.vertices[0])) >= 0.0
}

/// Returns the separations of the shape `other`, without its radius, along the edge normals of the shape `this`.
fn axes_of_side(this: &PairSide<'_>, other: &PairSide<'_>) -> SeparatingAxes {
    let origin = this.to_local([0.0; 2]);
    axes_of(this.shape_ref, |normal, point| {
        let along = this.to_other(normal);
        let projections = other.shape_ref.vertices.iter().map(|&point| dot(along, point));
        let nearest = projections.fold(f32::MAX, |a, b| if b < a { b } else { a });
        nearest + dot(normal, difference(origin, point))
    })
}

/// Returns the largest separations along the edge normals of a shape. `separation` computes the separation along an edge, in
/// length units, from the edge's normal and first vertex.
fn axes_of(shape: ShapeRef<'_>, separation: impl Fn(Vector, Vector) -> f32) -> SeparatingAxes {
    let adjacency = shape.adjacency();
    let mut axes = SeparatingAxes { max_separation: f32::MIN, best_outer_edge: None };
    for (edge, (&point, &normal)) in shape.vertices.iter().zip(shape.normals).enumerate() {
        let separation = separation(normal, point);
        if separation > axes.max_separation {
            axes.max_separation = separation;
        }
        let is_inner = adjacency.get(edge).is_some_and(|edge_adjacency| edge_adjacency.is_internal);
        if !is_inner && axes.best_outer_edge.is_none_or(|(best, _)| separation > best) {
            axes.best_outer_edge = Some((separation, edge));
        }
    }
    axes
}

/// Returns the manifold at the edge of both outlines that has the largest separation. `axes`: separations along the edges of A
/// and of B. `margin`: contact margin in length units.
fn best_axis_contact(shapes: &ShapePair<'_>, axes: [SeparatingAxes; 2], margin: f32) -> Manifold {
    let (which, (separation, edge)) = match (axes[0].best_outer_edge, axes[1].best_outer_edge) {
        (Some(a), Some(b)) if b.0 > a.0 + REFERENCE_EDGE_HYSTERESIS * margin => (WhichShape::B, b),
        (Some(a), _) => (WhichShape::A, a),
        (None, Some(b)) => (WhichShape::B, b),
        (None, None) => return Manifold::separated(0.0),
    };
    edge_contact(shapes, axes, (which, edge), separation, margin)
}

/// Returns the manifold at a reference edge if the outline of the other shape admits the opposite normal. Else the contact is
/// dropped or snapped to an edge of the other shape. `separation` is that of the shapes without radii along the edge normal, in
/// length units.
fn edge_contact(
    shapes: &ShapePair<'_>,
    axes: [SeparatingAxes; 2],
    (which, edge): (WhichShape, usize),
    separation: f32,
    margin: f32,
) -> Manifold {
    let this = shapes.side(which);
    if this.shape_ref.adjacency().get(edge).is_some_and(|edge_adjacency| edge_adjacency.is_internal) {
        return Manifold::separated(0.0);
    }
    let w = this.to_other(scaled(this.shape_ref.normals[edge], -1.0));
    match classify_normal(shapes.side(which.other()), w) {
        Verdict::Admitted => shapes.clip_edge(which, edge, margin),
        Verdict::Skipped => Manifold::separated(0.0),
        Verdict::Snapped => snap_to_edge(shapes, axes, which.other(), separation, margin),
    }
}

/// Returns the manifold of two vertices. If an edge normal is parallel to the line through them, it is the manifold of that
/// edge. `offset` leads from the vertex of A to that of B, in the frame of A, length units.
fn vertex_contact(
    shapes: &ShapePair<'_>,
    axes: [SeparatingAxes; 2],
    (vertex_a, vertex_b, offset): (usize, usize, Vector),
    margin: f32,
) -> Manifold {
    for (which, axes) in [WhichShape::A, WhichShape::B].into_iter().zip(axes) {
        if let Some((_, edge)) =
            axes.best_outer_edge.filter(|&(_, edge)| is_along_normal(shapes, which, edge, offset))
        {
            let manifold = shapes.clip_edge(which, edge, margin);
            if manifold.count > 0 {
                return manifold;
            }
        }
    }
    shapes.vertex_vertex(vertex_a, vertex_b, offset, margin)
}

/// Returns the manifold at the edge of the shape `which` that has the largest separation and belongs to the outline. It
/// replaces a contact whose normal the outline does not have. `separation` is that of the shapes without radii along the old
/// normal, in length units.
fn snap_to_edge(
    shapes: &ShapePair<'_>,
    axes: [SeparatingAxes; 2],
    which: WhichShape,
    separation: f32,
    margin: f32,
) -> Manifold {
    let Some((_, edge)) = axes[which as usize].best_outer_edge else { return Manifold::separated(0.0) };
    let manifold = shapes.clip_edge(which, edge, margin);
    let overlap = if separation < 0.0 { -separation } else { 0.0 };
    let deepest =
        -SNAP_MAX_PENETRATION_RATIO * overlap - REFERENCE_EDGE_HYSTERESIS * margin - shapes.total_radius();
    let is_behind = manifold.separations[..manifold.count].iter().any(|&separation| separation < deepest);
    if is_behind { Manifold::separated(0.0) } else { manifold }
}

/// Returns the stricter of the verdicts of A and B, and the shape that it is of. `Skipped` is stricter than `Snapped`, and
/// `Snapped` stricter than `Admitted`.
fn stricter_verdict(a: Verdict, b: Verdict) -> (Verdict, WhichShape) {
    match (a, b) {
        (Verdict::Skipped, _) | (Verdict::Snapped, Verdict::Admitted) => (a, WhichShape::A),
        _ => (b, WhichShape::B),
    }
}

/// Returns whether the outline of a shape admits the unit normal w, given in the frame of the shape's body.
pub(crate) fn admits_normal(side: &PairSide<'_>, w: Vector) -> bool {
    classify_normal(side, w) == Verdict::Admitted
}

/// Classifies the unit normal w against the outline of a shape. w is outward, in the frame of the shape's body. Shapes that are
/// whole outlines admit every normal.
fn classify_normal(side: &PairSide<'_>, w: Vector) -> Verdict {
    let (shape, adjacency) = (side.shape_ref, side.shape_ref.adjacency());
    if adjacency.is_empty() {
        return Verdict::Admitted;
    }
    let vertex = support_vertex(shape, w);
    if shape.is_two_sided() {
        return classify_on_two_sided_edge(shape, vertex, w);
    }
    let before = (vertex + adjacency.len() - 1) % adjacency.len();
    match (adjacency[before].is_internal, adjacency[vertex].is_internal) {
        (false, false) => Verdict::Admitted,
        (false, true) => {
            let after = adjacency[before].neighbours[1];
            classify_at_vertex(shape.normals[before], after, cross(after, w))
        }
        (true, false) => {
            let earlier = adjacency[vertex].neighbours[0];
            classify_at_vertex(earlier, shape.normals[vertex], cross(w, earlier))
        }
        (true, true) => Verdict::Skipped,
    }
}

/// Classifies the unit normal w at a `vertex` (0 or 1) of a chain edge that collides on both sides. The side that w points to has
/// the contact.
fn classify_on_two_sided_edge(shape: ShapeRef<'_>, vertex: usize, w: Vector) -> Verdict {
    // Edge i of the two runs from vertex i to the other one.
    let side = usize::from(dot(w, shape.normals[0]) < 0.0);
    let (normal, [before, after]) = (shape.normals[side], shape.adjacency()[side].neighbours);
    if vertex == side {
        classify_at_vertex(before, normal, cross(w, before))
    } else {
        classify_at_vertex(normal, after, cross(after, w))
    }
}

/// Returns the support vertex: the index of the vertex that is farthest along w, a vector in the frame of the shape's body.
fn support_vertex(shape: ShapeRef<'_>, w: Vector) -> usize {
    let (mut best, mut vertex) = (f32::MIN, 0);
    for (at, &point) in shape.vertices.iter().enumerate() {
        let projection = dot(w, point);
        if projection > best {
            (best, vertex) = (projection, at);
        }
    }
    vertex
}

/// Classifies a contact normal at the vertex between two edges of the outline, whose unit normals are `first` and `second` in
/// order. `sine_beyond` is the sine of the angle by which the contact normal is beyond the normal of the adjacent edge.
fn classify_at_vertex(first: Vector, second: Vector, sine_beyond: f32) -> Verdict {
    let sine = cross(first, second);
    // The vertex between opposite normals, of an edge traversed back and forth, is convex too.
    let is_convex =
        sine > STRAIGHT_VERTEX_MAX_SIN || (sine >= -STRAIGHT_VERTEX_MAX_SIN && dot(first, second) < 0.0);
    if !is_convex {
        Verdict::Snapped
    } else if sine_beyond > VORONOI_TOLERANCE_SIN {
        Verdict::Skipped
    } else {
        Verdict::Admitted
    }
}
