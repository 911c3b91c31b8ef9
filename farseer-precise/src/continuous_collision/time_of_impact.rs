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

use crate::math::lanes::{greater, select};
use crate::math::plane::{Pose, Rot, Vector, difference, dot, rotate, rotation, sum, translation};
use crate::math::scalar;
use crate::parameters::narrow_phase::TOI_MAX_ITERATIONS;
use crate::shape::ShapeRef;
use wide::f32x4;

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
        let along = self.vertices(pose).map(|corner| dot(corner, direction));
        along.fold(f32::MIN, |most, one| if one > most { one } else { most }) + self.shape.shape.radius
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
    /// The axes along which the separation may be largest are the face normals and, with round shapes, the directions between
    /// two vertices. They are tested four at a time.
    pub(crate) fn separation(&self, fraction: f32) -> (f32, Vector) {
        let poses = [self.a.pose_at(fraction), self.b.pose_at(fraction)];
        let [a, b] = [PosedVertices::new(&self.a, poses[0]), PosedVertices::new(&self.b, poses[1])];
        let mut best = BestAxis { separation: f32::MIN, axis: [0.0, 1.0] };
        for axes in rotated_normals(&self.a.shape, rotation(poses[0])) {
            best.include(separations(&a, &b, axes), axes);
        }
        for axes in rotated_normals(&self.b.shape, rotation(poses[1])) {
            let axes = axes.map(|side| -side);
            best.include(separations(&a, &b, axes), axes);
        }
        if a.radius > 0.0 || b.radius > 0.0 {
            best.include_vertex_directions(&a, &b);
        }
        (best.separation, best.axis)
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

/// Number of vertices of a shape whose world coordinates are computed once for all axes, a count. Most shapes have at most as
/// many.
const STORED_VERTICES: usize = 8;

/// The vertices of a shape in world coordinates, length units.
struct PosedVertices<'a> {
    /// Vertices in the frame of the body, length units.
    local: &'a [Vector],
    pose: Pose,
    /// World coordinates of the first vertices, length units.
    stored: [Vector; STORED_VERTICES],
    /// Radius of the shape, length units, >= 0.
    radius: f32,
}

impl<'a> PosedVertices<'a> {
    /// Returns the vertices of a shape in the given pose of its body; for a circle its centre.
    #[inline(always)]
    fn new(shape: &'a SweptShape<'_>, pose: Pose) -> Self {
        let ShapeRef { shape, vertices, .. } = &shape.shape;
        let local = if vertices.is_empty() { std::slice::from_ref(&shape.centre) } else { vertices };
        let mut stored = [[0.0; 2]; STORED_VERTICES];
        for (stored, &point) in stored.iter_mut().zip(local) {
            *stored = sum(translation(pose), rotate(rotation(pose), point));
        }
        PosedVertices { local, pose, stored, radius: shape.radius }
    }

    /// Returns a vertex in world coordinates, length units.
    #[inline(always)]
    fn vertex(&self, at: usize) -> Vector {
        match self.stored.get(at) {
            Some(&vertex) => vertex,
            None => sum(translation(self.pose), rotate(rotation(self.pose), self.local[at])),
        }
    }

    /// Returns the largest world coordinates of the vertices along four directions, without the radius, length units.
    #[inline(always)]
    fn max_projections(&self, [x, y]: [f32x4; 2]) -> f32x4 {
        (0..self.local.len()).map(|at| self.vertex(at)).fold(f32x4::splat(f32::MIN), |most, vertex| {
            greater(f32x4::splat(vertex[0]) * x + f32x4::splat(vertex[1]) * y, most)
        })
    }
}

/// Returns the separations of A and B along four axes, unit vectors from A to B: length units, negative for penetration.
#[inline(always)]
fn separations(a: &PosedVertices<'_>, b: &PosedVertices<'_>, axes: [f32x4; 2]) -> f32x4 {
    let (of_a, of_b) = (a.max_projections(axes), b.max_projections(axes.map(|side| -side)));
    -(of_b + f32x4::splat(b.radius)) - (of_a + f32x4::splat(a.radius))
}

/// Returns the edge normals of a shape in world axes, four at a time. `q` is the rotation of its body: cosine and sine.
#[inline(always)]
fn rotated_normals<'a>(shape: &ShapeRef<'a>, [c, s]: Rot) -> impl Iterator<Item = [f32x4; 2]> + use<'a> {
    let (c, s) = (f32x4::splat(c), f32x4::splat(s));
    shape.edge_lanes().iter().map(move |edges| {
        let [x, y] = edges.normals;
        [c * x - s * y, s * x + c * y]
    })
}

/// The axis with the largest separation so far.
struct BestAxis {
    /// Separation along the axis, length units, negative for penetration.
    separation: f32,
    /// Unit vector from A to B in world axes.
    axis: Vector,
}

impl BestAxis {
    /// Takes the best of four axes if its separation (length units) is larger than that so far. The first of equal ones counts.
    #[inline(always)]
    fn include(&mut self, separations: f32x4, axes: [f32x4; 2]) {
        if separations.simd_gt(f32x4::splat(self.separation)).none() {
            return;
        }
        let [x, y] = axes.map(f32x4::to_array);
        for (lane, separation) in separations.to_array().into_iter().enumerate() {
            if separation > self.separation {
                (self.separation, self.axis) = (separation, [x[lane], y[lane]]);
            }
        }
    }

    /// Tests the directions from each vertex of A to each vertex of B. Coincident vertices have no direction.
    fn include_vertex_directions(&mut self, a: &PosedVertices<'_>, b: &PosedVertices<'_>) {
        for from in (0..a.local.len()).map(|at| a.vertex(at).map(f32x4::splat)) {
            for first in (0..b.local.len()).step_by(4) {
                let last = b.local.len() - 1;
                let to: [Vector; 4] = std::array::from_fn(|lane| b.vertex((first + lane).min(last)));
                let [to_x, to_y] = [0, 1].map(|axis| f32x4::new(to.map(|vertex| vertex[axis])));
                let (x, y) = (to_x - from[0], to_y - from[1]);
                let distance = (x * x + y * y).sqrt();
                let inverse = f32x4::ONE / distance;
                let axes = [x * inverse, y * inverse];
                let is_direction = distance.simd_gt(f32x4::ZERO);
                let separations = select(is_direction, separations(a, b, axes), f32x4::splat(f32::MIN));
                self.include(separations, axes);
            }
        }
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
