//! Narrow phase of two spheres in three axes: one contact point on the line of centres. A pair that does not touch yet gets the
//! normal of its predicted touch.
//!
//! Reads centres, radii and predicted displacements; returns a manifold with its point relative to the position of body A.

use super::posed_solid::PosedSolid;
use crate::math::plane::{Pose, Vector, difference, rotate, rotation, scaled, sum, translation};
use crate::narrow_phase::manifold::Manifold;
use crate::shape::Shape;

/// Sphere of a proxy: centre, radius and predicted displacement.
pub(crate) struct Sphere {
    /// Centre of the sphere in world coordinates x and y, length units.
    centre: Vector,
    /// Vector in x and y from the body's position to the centre of the sphere, in world axes, length units.
    arm: Vector,
    /// World position of the centre along z in length units.
    z: f32,
    /// Radius in length units, >= 0.
    radius: f32,
    /// Displacement of the body along x, y and z in the coming step if its velocity does not change, in length units.
    predicted_displacement: [f32; 3],
}

impl Sphere {
    #[inline(always)]
    pub(super) fn new(shape: Shape, pose: Pose, z: f32, ahead: [f32; 3]) -> Self {
        let centre = sum(translation(pose), rotate(rotation(pose), shape.centre));
        Sphere {
            centre,
            arm: difference(centre, translation(pose)),
            z,
            radius: shape.radius,
            predicted_displacement: ahead,
        }
    }

    pub(super) fn of(solid: PosedSolid<'_>) -> Self {
        Sphere::new(solid.outline.shape, solid.pose, solid.z, solid.predicted_displacement)
    }
}

/// Returns the contact manifold of spheres A and B, with its point relative to the position of body A. `is_new`: the spheres
/// did not touch in the last step. `contact_margin` is in length units.
pub(crate) fn collide_spheres(a: Sphere, b: Sphere, is_new: bool, contact_margin: f32) -> Manifold {
    let [dx, dy] = difference(b.centre, a.centre);
    let dz = b.z - a.z;
    let squared = dx * dx + dy * dy + dz * dz;
    let distance = squared.sqrt();
    // Coincident centres separate along y.
    let is_far = squared > f32::MIN_POSITIVE;
    let mut normal =
        if is_far { [dx, dy, dz].map(|component| component / distance) } else { [0.0, 1.0, 0.0] };
    let mut separation = distance - a.radius - b.radius;
    if separation > contact_margin {
        return Manifold::separated(separation);
    }
    if is_new && separation > 0.0 {
        let Some(touch) = predict_contact(&a, &b, [dx, dy, dz]) else { return Manifold::separated(0.0) };
        (separation, normal) = touch;
    }
    let [nx, ny, nz] = normal;
    let point = sum(a.arm, scaled([nx, ny], a.radius + 0.5 * separation));
    let mut found = Manifold::single_point([nx, ny], point, separation, 0, f32::MAX);
    found.normal_z = nz;
    found
}

/// Returns separation (length units) and unit normal from A to B of two separated spheres at their predicted touch in this
/// step; `None` if the spheres miss each other. The separation is the present one, measured along that normal. `offset` is the
/// centre of B relative to the centre of A, in length units.
fn predict_contact(a: &Sphere, b: &Sphere, offset: [f32; 3]) -> Option<(f32, [f32; 3])> {
    let (displacement, radii): ([f32; 3], f32) = (
        std::array::from_fn(|axis| b.predicted_displacement[axis] - a.predicted_displacement[axis]),
        a.radius + b.radius,
    );
    let product = |a: [f32; 3], b: [f32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    // Earlier root of |offset + t displacement| = radii.
    let (closing, squared) = (-product(offset, displacement), product(displacement, displacement));
    let under_root = closing * closing - squared * (product(offset, offset) - radii * radii);
    if !(closing > 0.0 && under_root > 0.0) {
        return None;
    }
    let fraction = (product(offset, offset) - radii * radii) / (closing + under_root.sqrt());
    let normal: [f32; 3] = std::array::from_fn(|axis| (offset[axis] + fraction * displacement[axis]) / radii);
    (fraction <= 1.0).then_some((-fraction * product(displacement, normal), normal))
}
