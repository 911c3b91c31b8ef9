//! Time of impact (TOI) of two convex shapes in the plane, by conservative advancement.
//!
//! The shapes move on straight paths and rotate at constant rates through the step. The separation along an axis shrinks no
//! faster than the relative speed along it plus, for each shape, its angular speed times the largest distance of its surface
//! from the origin of its body. So the time until the shapes can touch is at least separation divided by this closing speed (B.
//! Mirtich, "Impulse-based Dynamic Simulation of Rigid Body Systems", 1996, section 2.3). The iteration advances by that time;
//! without a positive closing speed there is no impact.
//!
//! The target is a small penetration and not the first touch, so that the next step finds a contact and a grazing shape does
//! not stop.

use crate::math::plane::{Pose, Vector, difference, dot, length, rotate, rotation, scaled, sum, translation};
use crate::math::scalar;
use crate::parameters::narrow_phase::TOI_MAX_ITERATIONS;
use crate::shape::ShapeRef;

/// A convex shape on its path through a step: initial pose and displacement of its body.
#[derive(Clone, Copy)]
pub(crate) struct SweptShape<'a> {
    /// The shape in the frame of its body.
    pub(crate) shape: ShapeRef<'a>,
    /// World pose of the body at the start of the step.
    pub(crate) pose: Pose,
    /// Displacement of the body in the step: x, y (length units), rotation (radians), z (length units, unused).
    pub(crate) displacement: [f32; 4],
}

impl SweptShape<'_> {
    /// Returns the world pose of the body after a fraction of the step, 0..=1: x, y (length units), cosine, sine.
    pub(crate) fn pose_at(&self, fraction: f32) -> Pose {
        let ([x, y, c, s], [dx, dy, turned, _]) = (self.pose, self.displacement);
        if turned == 0.0 {
            return [x + fraction * dx, y + fraction * dy, c, s];
        }
        let (sine, cosine) = scalar::sin_cos(fraction * turned);
        let [c, s] = rotate([cosine, sine], [c, s]);
        [x + fraction * dx, y + fraction * dy, c, s]
    }

    /// Returns the vertices of the shape in world coordinates, length units; for a circle its centre.
    fn vertices(&self, pose: Pose) -> impl Iterator<Item = Vector> + '_ {
        let ShapeRef { shape, vertices: points, .. } = &self.shape;
        let points = if points.is_empty() { std::slice::from_ref(&shape.centre) } else { points };
        points.iter().map(move |&point| sum(translation(pose), rotate(rotation(pose), point)))
    }

    /// Returns the support function: the largest world coordinate of the shape along the unit vector `direction`, radius
    /// included, length units.
    pub(crate) fn support(&self, pose: Pose, direction: Vector) -> f32 {
        self.support_vertex(pose, direction).0 + self.shape.shape.radius
    }

    /// Returns the largest world coordinate of the vertices along the unit vector `direction` (length units, without the
    /// radius), and the vertex with this coordinate.
    fn support_vertex(&self, pose: Pose, direction: Vector) -> (f32, Vector) {
        let along = self.vertices(pose).map(|corner| (dot(corner, direction), corner));
        along.fold((f32::MIN, [0.0; 2]), |most, one| if one.0 > most.0 { one } else { most })
    }

    /// Returns the centre of the shape's AABB in world coordinates, length units.
    fn centre(&self, pose: Pose) -> Vector {
        sum(translation(pose), rotate(rotation(pose), self.shape.shape.centre))
    }
}

/// Two convex shapes A and B on their paths through a step.
pub(crate) struct SweptPair<'a> {
    pub(crate) a: SweptShape<'a>,
    pub(crate) b: SweptShape<'a>,
}

impl SweptPair<'_> {
    /// Returns the separation of A and B at a fraction of the step (length units, negative for penetration), and its axis, a
    /// unit vector from A to B in world axes.
    ///
    /// The separation along any axis is at most that of two single vertices. This bound, with the vertices that were nearest on
    /// the previous axis, skips most axes.
    pub(crate) fn separation(&self, fraction: f32) -> (f32, Vector) {
        let poses = [self.a.pose_at(fraction), self.b.pose_at(fraction)];
        let radii = [self.a.shape.shape.radius, self.b.shape.shape.radius];
        let separation_along = |axis: Vector| {
            let (of_a, near_a) = self.a.support_vertex(poses[0], axis);
            let (of_b, near_b) = self.b.support_vertex(poses[1], scaled(axis, -1.0));
            (-(of_b + radii[1]) - (of_a + radii[0]), [near_a, near_b])
        };
        let upper_bound = |[near_a, near_b]: [Vector; 2], axis: Vector| {
            -(dot(near_b, scaled(axis, -1.0)) + radii[1]) - (dot(near_a, axis) + radii[0])
        };

        // The separation along the axis with the largest bound is a lower limit for the result.
        let mut nearest = separation_along(difference(self.b.centre(poses[1]), self.a.centre(poses[0]))).1;
        let mut best_bound = (f32::MIN, [0.0, 1.0]);
        self.for_each_axis(poses, &mut |axis| {
            let most = upper_bound(nearest, axis);
            if most > best_bound.0 {
                best_bound = (most, axis);
            }
        });
        let (least, of_likely) = separation_along(best_bound.1);
        nearest = of_likely;
        let mut best = (f32::MIN, [0.0, 1.0]);
        self.for_each_axis(poses, &mut |axis| {
            let most = upper_bound(nearest, axis);
            if most < least || most <= best.0 {
                return;
            }
            let (apart, of_axis) = separation_along(axis);
            nearest = of_axis;
            if apart > best.0 {
                best = (apart, axis);
            }
        });
        best
    }

    /// Calls `consider` with each axis along which the separation may be largest, a unit vector from A to B. These are the face
    /// normals and, with round shapes, the directions between two vertices.
    fn for_each_axis(&self, [pose_a, pose_b]: [Pose; 2], consider: &mut dyn FnMut(Vector)) {
        for &normal in self.a.shape.normals {
            consider(rotate(rotation(pose_a), normal));
        }
        for &normal in self.b.shape.normals {
            consider(scaled(rotate(rotation(pose_b), normal), -1.0));
        }
        if self.a.shape.shape.radius > 0.0 || self.b.shape.shape.radius > 0.0 {
            for from in self.a.vertices(pose_a) {
                for to in self.b.vertices(pose_b) {
                    let offset = difference(to, from);
                    let distance = length(offset);
                    if distance > 0.0 {
                        consider(scaled(offset, 1.0 / distance));
                    }
                }
            }
        }
    }

    /// Returns the separation of A and B at a fraction of the step (length units, negative for penetration), and the closing
    /// speed along the axis of separation (length units per step).
    pub(crate) fn separation_and_closing_speed(&self, fraction: f32) -> (f32, f32) {
        let (separation, axis) = self.separation(fraction);
        (separation, self.closing_speed(axis))
    }

    /// Returns an upper bound of the speed at which A and B approach along `axis`, a unit vector from A to B: length units per
    /// step, rotation included.
    pub(crate) fn closing_speed(&self, axis: Vector) -> f32 {
        let relative_displacement =
            difference(translation(self.b.displacement), translation(self.a.displacement));
        let rotation_speed =
            |flyer: &SweptShape<'_>| flyer.displacement[2].abs() * flyer.shape.shape.max_extent;
        rotation_speed(&self.a) + rotation_speed(&self.b) - dot(relative_displacement, axis)
    }

    /// Returns whether A is a one-sided chain edge that B cannot hit: B is behind the edge, or does not move towards it.
    pub(crate) fn is_behind_edge(&self) -> bool {
        let [normal, _] = self.a.shape.normals else { return false };
        if !self.a.shape.is_one_sided() {
            return false;
        }
        let normal = rotate(rotation(self.a.pose), *normal);
        let on_edge = sum(translation(self.a.pose), rotate(rotation(self.a.pose), self.a.shape.vertices[0]));
        let centre = self.b.centre(self.b.pose);
        let relative_displacement =
            difference(translation(self.b.displacement), translation(self.a.displacement));
        dot(difference(centre, on_edge), normal) < 0.0
            || (dot(relative_displacement, normal) >= 0.0 && self.b.displacement[2] == 0.0)
    }
}

/// Returns the fraction of the step after which two shapes reach the target penetration; `None` if they never do.
///
/// If the shapes overlap at the start, the target is their penetration there plus `target_penetration`. The result is exact
/// within `tolerance`. Both parameters are in length units, >= 0. The closure returns the separation (length units) and the
/// closing speed (length units per step) at a fraction of the step.
pub(crate) fn conservative_advancement(
    target_penetration: f32,
    tolerance: f32,
    separation_and_closing_speed: impl Fn(f32) -> (f32, f32),
) -> Option<f32> {
    let (mut fraction, mut allowed_penetration) = (0.0, None);
    for _ in 0..TOI_MAX_ITERATIONS {
        let (separation, closing_speed) = separation_and_closing_speed(fraction);
        let distance = separation
            + *allowed_penetration.get_or_insert(if separation < 0.0 {
                target_penetration - separation
            } else {
                target_penetration
            });
        if distance <= tolerance {
            return Some(fraction);
        }
        if closing_speed <= 0.0 {
            return None;
        }
        fraction += distance / closing_speed;
        if fraction >= 1.0 || fraction.is_nan() {
            return None;
        }
    }
    Some(fraction)
}
