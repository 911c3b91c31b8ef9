//! Ray cast and shape cast (swept box): time of impact of a point or an axis-aligned box on a straight path.
//!
//! Frame: the plane's, y **down**. A shape cast of a box is a ray cast of its centre against the Minkowski
//! sum of box and shape. For two convex polyhedra the sum is bounded by planes normal to a face of one or to
//! an edge of each (Gottschalk, Lin and Manocha, *OBBTree*, 1996). For a box and a round shape it is a larger
//! box with rounded edges (Ericson, *Real-Time Collision Detection*, 5.5.7).

use farseer_core::depth::VerticalShape;

use super::{Face, SlantedBox};
use crate::{Vector2, Vector3};

/// Hit of a path: time of impact as a fraction of the path, 0..=1, and outward unit normal of the surface, y down.
pub(crate) type Hit = (f32, Vector3);

/// Gap between parts of a shape that counts as none, as a fraction of the path; dimensionless.
const JOIN_TOLERANCE: f32 = 1e-5;

/// A straight path of a point or a box.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sweep {
    start: Vector3,
    displacement: Vector3,
    /// Half extents of the box, px; 0 for a point.
    half: Vector3,
    /// Whether a surface parallel to the path counts as hit when it is touched.
    grazes: bool,
}

/// Interval of the path inside all half spaces so far, with the normal at its start.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ClipInterval {
    /// Start of the interval, as a fraction of the path.
    entered: f32,
    /// End of the interval, as a fraction of the path.
    left: f32,
    normal: Vector3,
}

impl ClipInterval {
    fn new() -> Self {
        ClipInterval { entered: f32::NEG_INFINITY, left: f32::INFINITY, normal: Vector3::zeros() }
    }

    /// Returns the interval clipped by one more half space; `None` if nothing is left. `distance` is that of the start outside
    /// of the half space, px; `rate` is its change over the whole path, px.
    fn cut(mut self, distance: f32, rate: f32, normal: Vector3) -> Option<Self> {
        if rate == 0.0 {
            return (distance <= 0.0).then_some(self);
        }
        let fraction = -distance / rate;
        if rate > 0.0 {
            self.left = self.left.min(fraction);
        } else if fraction > self.entered {
            (self.entered, self.normal) = (fraction, normal);
        }
        (self.entered <= self.left).then_some(self)
    }

    /// Returns the union of the intervals in two parts of a convex shape: from the earlier start to the later end.
    fn with(self, other: ClipInterval) -> Self {
        let first = if other.entered < self.entered { other } else { self };
        ClipInterval { left: self.left.max(other.left), ..first }
    }

    /// Returns whether the path continues from the part with this interval directly into the part with the interval `next`.
    fn joins(&self, next: &ClipInterval) -> bool {
        self.entered < next.entered && self.left >= next.entered - JOIN_TOLERANCE
    }

    /// Returns the hit at the start of the interval; `None` if the path starts inside of the shape.
    pub(crate) fn entry(self) -> Option<Hit> {
        (0.0..=1.0).contains(&self.entered).then_some((self.entered, self.normal))
    }
}

/// Returns the first hit of a shape that consists of parts; `None` if the path enters no part from outside.
pub(crate) fn entry_of_parts(parts: &[ClipInterval]) -> Option<Hit> {
    let entries = parts.iter().filter(|part| !parts.iter().any(|other| other.joins(part)));
    let entries = entries.filter_map(|part| part.entry());
    entries.reduce(|first, entry| if entry.0 < first.0 { entry } else { first })
}

impl Sweep {
    /// Returns the path of a point; `None` if the path has no length or is not finite.
    pub(crate) fn of_point(start: Vector3, displacement: Vector3) -> Option<Self> {
        let length = displacement.norm_squared();
        (start.iter().all(|number| number.is_finite()) && length > 0.0 && length.is_finite())
            .then_some(Sweep { start, displacement, half: Vector3::zeros(), grazes: true })
    }

    /// The path of a box about a point. Surfaces parallel to the path do not stop it.
    pub(crate) fn of_box(start: Vector3, displacement: Vector3, half: Vector3) -> Option<Self> {
        Some(Sweep { half, grazes: false, ..Self::of_point(start, displacement)? })
    }

    /// Position at a fraction of the path.
    pub(crate) fn at(&self, fraction: f32) -> Vector3 {
        self.start + self.displacement * fraction
    }

    /// Returns the path of the box's centre as a path of a point.
    fn middle(&self) -> Self {
        Sweep { half: Vector3::zeros(), ..*self }
    }

    fn is_box(&self) -> bool {
        self.half != Vector3::zeros()
    }

    fn cut(&self, inside: ClipInterval, normal: Vector3, on_plane: Vector3) -> Option<ClipInterval> {
        self.cut_at(inside, normal, (self.start - on_plane).dot(&normal))
    }

    /// Returns the interval clipped by a half space; `None` if nothing is left. `distance` is the signed distance of the start
    /// (the point, or the centre of the box) outside of the half space, px.
    fn cut_at(&self, inside: ClipInterval, normal: Vector3, distance: f32) -> Option<ClipInterval> {
        let (distance, rate) = (distance - self.half.dot(&normal.abs()), self.displacement.dot(&normal));
        let slides_along = rate == 0.0 && distance == 0.0 && !self.grazes;
        if slides_along { None } else { inside.cut(distance, rate, normal) }
    }

    /// Clips by the two planes normal to an axis that touch a convex shape with these corners; only boxes
    /// need it.
    fn cut_across(
        &self,
        mut inside: ClipInterval,
        axis: Vector3,
        corners: &[Vector3],
    ) -> Option<ClipInterval> {
        for normal in [axis, -axis] {
            let outside = corners.iter().map(|corner| (self.start - corner).dot(&normal));
            inside = self.cut_at(inside, normal, outside.fold(f32::INFINITY, f32::min))?;
        }
        Some(inside)
    }

    /// Returns the hit of the ground from above; `None` if the path misses it.
    pub(crate) fn entry_of_ground(&self) -> Option<Hit> {
        self.cut(ClipInterval::new(), -Vector3::y(), Vector3::zeros())?.entry()
    }

    pub(crate) fn entry_of_box(&self, shape: &SlantedBox) -> Option<Hit> {
        let mut inside = ClipInterval::new();
        for face in Face::SIDES.into_iter().chain([Face::Front, Face::Back]) {
            inside =
                self.cut_at(inside, shape.face_normal(face), shape.distance_to_face(face, self.start))?;
        }
        if self.is_box() {
            let axes = [0, 1, 2].map(|axis| Vector3::ith(axis, 1.0));
            let corners = shape.corners();
            for axis in axes {
                inside = self.cut_across(inside, axis, &corners)?;
            }
            for axis in axes {
                for next in [1, 3, 4] {
                    let crossed = axis.cross(&(corners[next] - corners[0]));
                    if let Some(crossed) = crossed.try_normalize(0.0) {
                        inside = self.cut_across(inside, crossed, &corners)?;
                    }
                }
            }
        }
        inside.entry()
    }

    /// Returns the interval of the path inside of a prism: a convex outline with negative area, extruded by `half` to both
    /// sides of the depth `z`.
    pub(crate) fn clip_prism(&self, piece: &[Vector2], z: f32, half: f32) -> Option<ClipInterval> {
        let corner = |at: usize| Vector3::new(piece[at].x, piece[at].y, 0.0);
        let centre = Vector3::new(0.0, 0.0, z);
        if piece.len() < 3 { None } else { self.clip_extrusion(2, centre, half, piece.len(), &corner) }
    }

    /// Returns the interval of the path inside of an upright shape whose centre is `at`, px.
    pub(crate) fn clip_upright(&self, shape: &VerticalShape, at: Vector3) -> Option<ClipInterval> {
        match *shape {
            VerticalShape::Cylinder { radius, half_height } => {
                self.clip_rounded_box(at, Vector3::new(0.0, half_height, 0.0), radius, true)
            }
            VerticalShape::Capsule { radius, half_height } => {
                self.clip_rounded_box(at, Vector3::new(0.0, half_height - radius, 0.0), radius, false)
            }
            VerticalShape::Prism { footprint, half_height } => {
                let corners = footprint.corners();
                let corner = |at: usize| Vector3::new(corners[at].x, 0.0, corners[at].y);
                self.clip_extrusion(1, at, half_height, corners.len(), &corner)
            }
        }
    }

    /// Returns the interval of the path inside of a convex outline that is extruded along an axis. `corner` returns each of its
    /// `count` corners relative to the place `at`, px.
    fn clip_extrusion(
        &self,
        axis: usize,
        at: Vector3,
        half: f32,
        count: usize,
        corner: &dyn Fn(usize) -> Vector3,
    ) -> Option<ClipInterval> {
        let mut inside = self.within(ClipInterval::new(), axis, at, half)?;
        for number in 0..count {
            let edge = corner((number + 1) % count) - corner(number);
            let out = Vector3::ith(axis, 1.0).cross(&edge) / edge.norm();
            inside = self.cut(inside, out, at + corner(number))?;
        }
        if self.is_box() {
            let corners: Vec<Vector3> = (0..count).map(|number| at + corner(number)).collect();
            for across in (0..3).filter(|&across| across != axis) {
                inside = self.cut_across(inside, Vector3::ith(across, 1.0), &corners)?;
            }
        }
        Some(inside)
    }

    /// Returns the interval of the path inside of a ball.
    pub(crate) fn clip_ball(&self, centre: Vector3, radius: f32) -> Option<ClipInterval> {
        self.clip_rounded_box(centre, Vector3::zeros(), radius, false)
    }

    /// Returns the interval of the path inside of a box rounded by a radius: blocks along the axes, cylinders along its edges
    /// and spheres about its corners. With `ends` the box is rounded about the y axis only.
    fn clip_rounded_box(
        &self,
        centre: Vector3,
        half: Vector3,
        radius: f32,
        ends: bool,
    ) -> Option<ClipInterval> {
        let (core, middle) = (half + self.half, self.middle());
        let mut whole: Option<ClipInterval> = None;
        let mut join = |part: Option<ClipInterval>| {
            if let Some(part) = part {
                whole = Some(whole.map_or(part, |whole| whole.with(part)));
            }
        };
        for axis in (0..3).filter(|&axis| !(ends && axis == 1)) {
            join(middle.clip_block(centre, core + Vector3::ith(axis, radius)));
        }
        for axis in (0..3).filter(|&axis| if ends { axis == 1 } else { core[axis] > 0.0 }) {
            let reach = core[axis];
            for corner in corners_of(core - Vector3::ith(axis, reach)) {
                join(middle.clip_rod(centre + corner, radius, axis, reach));
            }
        }
        for corner in corners_of(core).filter(|_| !ends) {
            join(middle.clip_cylinder_or_sphere(centre + corner, radius, None));
        }
        whole
    }

    fn clip_block(&self, centre: Vector3, half: Vector3) -> Option<ClipInterval> {
        (0..3).try_fold(ClipInterval::new(), |inside, axis| self.within(inside, axis, centre, half[axis]))
    }

    fn clip_rod(&self, centre: Vector3, radius: f32, axis: usize, reach: f32) -> Option<ClipInterval> {
        self.within(self.clip_cylinder_or_sphere(centre, radius, Some(axis))?, axis, centre, reach)
    }

    /// Returns the interval clipped to the places within `reach` px of `centre` along an axis; `None` if nothing is left.
    fn within(&self, inside: ClipInterval, axis: usize, centre: Vector3, reach: f32) -> Option<ClipInterval> {
        [-1.0, 1.0].into_iter().try_fold(inside, |inside, side| {
            let out = Vector3::ith(axis, side);
            self.cut(inside, out, centre + out * reach)
        })
    }

    /// Returns the interval of the path inside of a cylinder about the axis with the index `line`, or inside of a sphere
    /// without one.
    fn clip_cylinder_or_sphere(
        &self,
        centre: Vector3,
        radius: f32,
        line: Option<usize>,
    ) -> Option<ClipInterval> {
        let level = |mut v: Vector3| {
            line.into_iter().for_each(|axis| v[axis] = 0.0);
            v
        };
        let (from, displacement) = (level(self.start - centre), level(self.displacement));
        let (a, b, c) =
            (displacement.norm_squared(), from.dot(&displacement), from.norm_squared() - radius * radius);
        if a == 0.0 {
            return (c <= 0.0).then(ClipInterval::new);
        }
        let root = b * b - a * c;
        if root.is_nan() || root < 0.0 {
            return None;
        }
        // The root without cancellation is computed first; the product of both roots is c / a.
        let sum = if b < 0.0 { root.sqrt() - b } else { -root.sqrt() - b };
        let (one, other) = (sum / a, if sum == 0.0 { 0.0 } else { c / sum });
        let (entered, left) = if one < other { (one, other) } else { (other, one) };
        Some(ClipInterval { entered, left, normal: (from + displacement * entered) / radius })
    }
}

/// Iterates over the corners of a box about the origin. Equal corners of a flat box occur once.
fn corners_of(half: Vector3) -> impl Iterator<Item = Vector3> {
    let is_high = |corner: usize, axis: usize| corner >> (2 - axis) & 1 == 1;
    let is_own = move |&corner: &usize| (0..3).all(|axis| half[axis] != 0.0 || is_high(corner, axis));
    let side = move |corner: usize, axis: usize| if is_high(corner, axis) { half[axis] } else { -half[axis] };
    (0..8).filter(is_own).map(move |corner| Vector3::from([0, 1, 2].map(|axis| side(corner, axis))))
}
