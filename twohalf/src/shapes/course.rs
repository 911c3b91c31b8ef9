//! Where a point that goes straight ahead enters something, or a box that is moved so.
//!
//! Frame: the plane's, y **down**. A box overlaps something where its middle is within what both cover together if one is
//! slid around the other, their Minkowski sum. Of two convex solids with flat sides that is what is behind all planes that
//! are normal to a side of one or to an edge of each, as far out as both reach (Gottschalk, Lin and Manocha, *OBBTree*, 1996); of
//! a box and something round it is a larger box with round edges (Ericson, *Real-Time Collision Detection*, 5.5.7). So both are
//! found as where a point enters.

use farseer_core::SpaceUpright;

use super::{Face, SlantedBox};
use crate::{Vector2, Vector3};

/// Part of the way at which something is entered, and the direction outward there.
pub(crate) type Entry = (f32, Vector3);

/// Parts of something that are no farther apart than this part of a way are one.
const SEAM: f32 = 1e-5;

/// What goes straight ahead.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Course {
    start: Vector3,
    way: Vector3,
    /// Half of the sizes of a box; of a point 0.
    half: Vector3,
    /// Whether what it slides along is in its way.
    grazes: bool,
}

/// The part of a course that is inside of all half spaces so far.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Inside {
    entered: f32,
    left: f32,
    normal: Vector3,
}

impl Inside {
    fn new() -> Self {
        Inside { entered: f32::NEG_INFINITY, left: f32::INFINITY, normal: Vector3::zeros() }
    }

    /// Inside of one more half space: how far the start is outside of it, how fast that grows along the way, and its normal.
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

    /// Of two parts of something convex: it is entered where the first of them is, and left where the last is.
    fn with(self, other: Inside) -> Self {
        let first = if other.entered < self.entered { other } else { self };
        Inside { left: self.left.max(other.left), ..first }
    }

    /// Whether the course comes out of this part of something right into another one.
    fn joins(&self, next: &Inside) -> bool {
        self.entered < next.entered && self.left >= next.entered - SEAM
    }

    /// Where it is entered on the way, if the start is not inside.
    pub(crate) fn entry(self) -> Option<Entry> {
        (0.0..=1.0).contains(&self.entered).then_some((self.entered, self.normal))
    }
}

/// Where something is entered first that consists of parts.
pub(crate) fn entry_of_parts(parts: &[Inside]) -> Option<Entry> {
    let entries = parts.iter().filter(|part| !parts.iter().any(|other| other.joins(part)));
    let entries = entries.filter_map(|part| part.entry());
    entries.reduce(|first, entry| if entry.0 < first.0 { entry } else { first })
}

impl Course {
    /// Of a point. `None` if it ends where it starts, or is not finite.
    pub(crate) fn of_point(start: Vector3, way: Vector3) -> Option<Self> {
        let length = way.norm_squared();
        (start.iter().all(|number| number.is_finite()) && length > 0.0 && length.is_finite())
            .then_some(Course { start, way, half: Vector3::zeros(), grazes: true })
    }

    /// Of a box about a point, which is not stopped by what it only slides along.
    pub(crate) fn of_box(start: Vector3, way: Vector3, half: Vector3) -> Option<Self> {
        Some(Course { half, grazes: false, ..Self::of_point(start, way)? })
    }

    /// Where it is after a part of the way.
    pub(crate) fn at(&self, fraction: f32) -> Vector3 {
        self.start + self.way * fraction
    }

    /// The middle of a box alone.
    fn middle(&self) -> Self {
        Course { half: Vector3::zeros(), ..*self }
    }

    fn is_box(&self) -> bool {
        self.half != Vector3::zeros()
    }

    fn cut(&self, inside: Inside, normal: Vector3, on_plane: Vector3) -> Option<Inside> {
        self.cut_at(inside, normal, (self.start - on_plane).dot(&normal))
    }

    /// By a half space that the start, or the middle of a box there, is outside of by a distance.
    fn cut_at(&self, inside: Inside, normal: Vector3, distance: f32) -> Option<Inside> {
        let (distance, rate) = (distance - self.half.dot(&normal.abs()), self.way.dot(&normal));
        let slides_along = rate == 0.0 && distance == 0.0 && !self.grazes;
        if slides_along { None } else { inside.cut(distance, rate, normal) }
    }

    /// By the planes across an axis that touch something convex with these corners, which a point does not need.
    fn cut_across(&self, mut inside: Inside, axis: Vector3, corners: &[Vector3]) -> Option<Inside> {
        for normal in [axis, -axis] {
            let outside = corners.iter().map(|corner| (self.start - corner).dot(&normal));
            inside = self.cut_at(inside, normal, outside.fold(f32::INFINITY, f32::min))?;
        }
        Some(inside)
    }

    /// Where it enters the ground.
    pub(crate) fn entry_of_ground(&self) -> Option<Entry> {
        self.cut(Inside::new(), -Vector3::y(), Vector3::zeros())?.entry()
    }

    pub(crate) fn entry_of_box(&self, shape: &SlantedBox) -> Option<Entry> {
        let mut inside = Inside::new();
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

    /// What of it is in a convex outline with negative area, drawn out to both sides of a depth.
    pub(crate) fn inside_prism(&self, piece: &[Vector2], z: f32, half: f32) -> Option<Inside> {
        let corner = |at: usize| Vector3::new(piece[at].x, piece[at].y, 0.0);
        let centre = Vector3::new(0.0, 0.0, z);
        if piece.len() < 3 { None } else { self.inside_drawn_out(2, centre, half, piece.len(), &corner) }
    }

    /// What of it is in something upright about a place.
    pub(crate) fn inside_upright(&self, shape: &SpaceUpright, at: Vector3) -> Option<Inside> {
        match *shape {
            SpaceUpright::Cylinder { radius, half_height } => {
                self.inside_rounded(at, Vector3::new(0.0, half_height, 0.0), radius, true)
            }
            SpaceUpright::Capsule { radius, half_height } => {
                self.inside_rounded(at, Vector3::new(0.0, half_height - radius, 0.0), radius, false)
            }
            SpaceUpright::Prism { footprint, half_height } => {
                let corners = footprint.corners();
                let corner = |at: usize| Vector3::new(corners[at].x, 0.0, corners[at].y);
                self.inside_drawn_out(1, at, half_height, corners.len(), &corner)
            }
        }
    }

    /// What of it is in a convex outline, of which so many corners are told as seen from a place, drawn out along an axis.
    fn inside_drawn_out(
        &self,
        axis: usize,
        at: Vector3,
        half: f32,
        count: usize,
        corner: &dyn Fn(usize) -> Vector3,
    ) -> Option<Inside> {
        let mut inside = self.within(Inside::new(), axis, at, half)?;
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

    /// What of it is in a ball.
    pub(crate) fn inside_ball(&self, centre: Vector3, radius: f32) -> Option<Inside> {
        self.inside_rounded(centre, Vector3::zeros(), radius, false)
    }

    /// What of it is no farther than a radius from a box, or if that has `ends`, no farther to its sides: blocks along the
    /// axes, rods along its edges and balls about its corners.
    fn inside_rounded(&self, centre: Vector3, half: Vector3, radius: f32, ends: bool) -> Option<Inside> {
        let (core, middle) = (half + self.half, self.middle());
        let mut whole: Option<Inside> = None;
        let mut join = |part: Option<Inside>| {
            if let Some(part) = part {
                whole = Some(whole.map_or(part, |whole| whole.with(part)));
            }
        };
        for axis in (0..3).filter(|&axis| !(ends && axis == 1)) {
            join(middle.inside_block(centre, core + Vector3::ith(axis, radius)));
        }
        for axis in (0..3).filter(|&axis| if ends { axis == 1 } else { core[axis] > 0.0 }) {
            let reach = core[axis];
            for corner in corners_of(core - Vector3::ith(axis, reach)) {
                join(middle.inside_rod(centre + corner, radius, axis, reach));
            }
        }
        for corner in corners_of(core).filter(|_| !ends) {
            join(middle.inside_round(centre + corner, radius, None));
        }
        whole
    }

    fn inside_block(&self, centre: Vector3, half: Vector3) -> Option<Inside> {
        (0..3).try_fold(Inside::new(), |inside, axis| self.within(inside, axis, centre, half[axis]))
    }

    fn inside_rod(&self, centre: Vector3, radius: f32, axis: usize, reach: f32) -> Option<Inside> {
        self.within(self.inside_round(centre, radius, Some(axis))?, axis, centre, reach)
    }

    /// No farther than `reach` from a place along an axis.
    fn within(&self, inside: Inside, axis: usize, centre: Vector3, reach: f32) -> Option<Inside> {
        [-1.0, 1.0].into_iter().try_fold(inside, |inside, side| {
            let out = Vector3::ith(axis, side);
            self.cut(inside, out, centre + out * reach)
        })
    }

    /// What of it is within a radius of a line along an axis or of a point.
    fn inside_round(&self, centre: Vector3, radius: f32, line: Option<usize>) -> Option<Inside> {
        let level = |mut v: Vector3| {
            line.into_iter().for_each(|axis| v[axis] = 0.0);
            v
        };
        let (from, way) = (level(self.start - centre), level(self.way));
        let (a, b, c) = (way.norm_squared(), from.dot(&way), from.norm_squared() - radius * radius);
        if a == 0.0 {
            return (c <= 0.0).then(Inside::new);
        }
        let root = b * b - a * c;
        if root.is_nan() || root < 0.0 {
            return None;
        }
        // The one of both that adds no two numbers of different signs is exact, and their product is c / a.
        let sum = if b < 0.0 { root.sqrt() - b } else { -root.sqrt() - b };
        let (one, other) = (sum / a, if sum == 0.0 { 0.0 } else { c / sum });
        let (entered, left) = if one < other { (one, other) } else { (other, one) };
        Some(Inside { entered, left, normal: (from + way * entered) / radius })
    }
}

/// The corners of a box about the origin, each once where it is flat.
fn corners_of(half: Vector3) -> impl Iterator<Item = Vector3> {
    let is_high = |corner: usize, axis: usize| corner >> (2 - axis) & 1 == 1;
    let is_own = move |&corner: &usize| (0..3).all(|axis| half[axis] != 0.0 || is_high(corner, axis));
    let side = move |corner: usize, axis: usize| if is_high(corner, axis) { half[axis] } else { -half[axis] };
    (0..8).filter(is_own).map(move |corner| Vector3::from([0, 1, 2].map(|axis| side(corner, axis))))
}
