//! Solids of the narrow phase in three axes: a proxy's shape with its pose and motion, and the margins of a pair.

use super::vertical_solid::VerticalSolid;
use crate::math::plane::{Pose, Vector, dot, rotate, rotate_inverse, rotation, sum, translation};
use crate::narrow_phase::manifold::Manifold;
use crate::parameters::depth::{
    LOADED_FLUSH_OVERLAP, MOVING_FLUSH_OVERLAP, PRISM_FACE_MIN_COSINE, RESTING_FLUSH_OVERLAP,
};
use crate::shape::ShapeRef;
use crate::slanted_box::SlantedBox;

/// Shape of a proxy with its pose, its displacement in the last step and the predicted one.
#[derive(Clone, Copy)]
pub(crate) struct PosedSolid<'a> {
    /// Outline in the frame of the body; for a vertical shape its bounding rectangle.
    pub(super) outline: ShapeRef<'a>,
    /// World pose of the body in the plane: x, y (length units), cosine and sine of the angle.
    pub(super) pose: Pose,
    /// Kind of the solid: prism, sphere, ground or vertical shape.
    pub(super) kind: SolidKind,
    /// World position of the body along z in length units.
    pub(super) z: f32,
    /// Displacement of the body in the last step along x, y and z, in length units.
    pub(super) last_displacement: [f32; 3],
    /// Displacement of the body along x, y and z in the coming step if its velocity does not change, in length units.
    pub(super) predicted_displacement: [f32; 3],
    /// Geometry of a sheared box, whose `outline` is its bounding rectangle; `None` for other solids.
    pub(super) sheared_box: Option<SlantedBox>,
    /// Vertical shape; `None` unless the kind is vertical.
    pub(super) vertical: Option<&'a VerticalSolid>,
}

/// Kind of solid that an outline stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum SolidKind {
    /// The solid is a prism: the outline extruded along z. The number is half of its extent along z in length units.
    Prism(f32),
    /// The solid is a sphere with the radius of the outline.
    Sphere,
    /// The solid is the ground: the half-space y > 0.
    Ground,
    /// The solid is a vertical shape, given by the field `vertical`.
    Vertical,
}

/// Axis of a pair's contact normal in the last step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum PreviousAxis {
    /// The pair did not touch in the last step.
    NoContact,
    /// The contact normal lay in the plane of x and y; for a vertical shape it was lateral.
    Plane,
    /// The contact normal was the z axis, with this sign (1 or -1).
    Depth(f32),
    /// A vertical shape was above or below the other solid.
    Vertical,
}

impl PreviousAxis {
    /// Returns the axis with A and B exchanged: the sign of the z axis changes.
    pub(super) fn flipped(self) -> Self {
        if let PreviousAxis::Depth(side) = self { PreviousAxis::Depth(-side) } else { self }
    }
}

/// Distances of the narrow phase for one pair.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ContactMargins {
    /// Contact margin in length units: points with a smaller separation are contacts.
    pub(super) contact_margin: f32,
    /// Speculative distance in length units. It equals the contact margin, except for pairs that a moving world box sweeps:
    /// their contact margin is greater.
    pub(super) speculative_distance: f32,
    /// Tolerance for flush faces in length units, >= 0: faces with a smaller overlap are flush.
    pub(super) flush_overlap: f32,
}

impl ContactMargins {
    /// Returns the margins of a pair. A loaded body penetrates its floor and meets the next flush face at the same penetration.
    /// `residual_penetration` is this penetration in length units, or that of the contact that ended last. `is_static`: the
    /// other body is static, so that its position is exact.
    pub(crate) fn new(
        [contact_margin, speculative_distance]: [f32; 2],
        is_static: bool,
        residual_penetration: f32,
    ) -> Self {
        let unpressed = if is_static { RESTING_FLUSH_OVERLAP } else { MOVING_FLUSH_OVERLAP };
        let flush = (unpressed * speculative_distance + residual_penetration)
            .min(LOADED_FLUSH_OVERLAP * speculative_distance);
        ContactMargins { contact_margin, speculative_distance, flush_overlap: flush }
    }

    /// Returns the greatest difference in height, in length units, at which two faces without load count as flush. The
    /// difference is greater if `is_movable`: then a load can push one of both bodies down.
    pub(crate) fn max_flush_overlap(speculative_distance: f32, is_movable: bool) -> f32 {
        speculative_distance * if is_movable { LOADED_FLUSH_OVERLAP } else { MOVING_FLUSH_OVERLAP }
    }
}

impl PosedSolid<'_> {
    /// Returns whether the solid is a sphere or a capsule.
    pub(crate) fn is_rounded(&self) -> bool {
        self.kind == SolidKind::Sphere || self.vertical.is_some_and(|upright| upright.rounding > 0.0)
    }

    /// Returns whether the solid is a prism along z that is not sheared.
    pub(crate) fn is_straight_prism(&self) -> bool {
        matches!(self.kind, SolidKind::Prism(_))
            && self.sheared_box.is_none()
            && !self.outline.vertices.is_empty()
    }

    /// Returns whether the solid is the ground, or a straight prism with a face of this normal (unit vector in world axes x and
    /// y).
    pub(crate) fn has_face(&self, normal: Vector) -> bool {
        let is_it = |&face: &Vector| dot(rotate(rotation(self.pose), face), normal) > PRISM_FACE_MIN_COSINE;
        self.kind == SolidKind::Ground || (self.is_straight_prism() && self.outline.normals.iter().any(is_it))
    }

    /// Returns the greatest coordinate of the solid along a unit normal in world axes x and y, in length units; for the ground
    /// the coordinate of its top, 0.
    pub(crate) fn support_coordinate(&self, normal: Vector) -> f32 {
        if self.kind == SolidKind::Ground {
            return 0.0;
        }
        let direction = rotate_inverse(rotation(self.pose), normal);
        dot(translation(self.pose), normal)
            + self.outline.shape.radius
            + self.outline.max_projection(direction)
    }

    /// Moves the solid by a fraction of its displacement `path` (x, y, rotation, z) to `pose`. The whole path becomes the
    /// predicted displacement. The part covered so far becomes the last displacement, because the pair was separated at the
    /// start of the step.
    pub(crate) fn advance(&mut self, pose: Pose, path: [f32; 4], fraction: f32) {
        self.pose = pose;
        self.z += fraction * path[3];
        let displacement = [path[0], path[1], path[3]];
        (self.last_displacement, self.predicted_displacement) =
            (displacement.map(|displacement| fraction * displacement), displacement);
    }

    /// Returns the centre of the outline in world coordinates x and y, length units.
    pub(super) fn shape_centre(&self) -> Vector {
        sum(translation(self.pose), rotate(rotation(self.pose), self.outline.shape.centre))
    }
}

/// Returns a manifold of A and B as a manifold of B and A: opposite normal, points relative to body B.
pub(super) fn flip_manifold(mut found: Manifold, a: PosedSolid<'_>, b: PosedSolid<'_>) -> Manifold {
    found = found.flip(a.pose, b.pose);
    found.normal_z = -found.normal_z;
    found.points_z = found.points_z.map(|depth| depth + (b.z - a.z));
    found
}

/// Returns the least separation of the contact points of a manifold, in length units.
pub(super) fn min_separation(found: &Manifold) -> f32 {
    let [one, other] = found.separations;
    if found.count > 1 && other < one { other } else { one }
}
