//! Distance and closing speed of two moving shapes in three axes, for the time of impact by conservative advancement.
//!
//! [`time_of_impact`](crate::continuous_collision::time_of_impact) advances by distance / closing speed (B. Mirtich,
//! "Impulse-based Dynamic Simulation of Rigid Body Systems", 1996). Each function gives the distance along an axis in length
//! units, at a time in the step (a fraction, 0..=1). The closing speed is bounded by the velocity along this axis plus rotation
//! in the plane times the greatest radius.
//!
//! Prisms are separated in the plane or along z, spheres by the distance of their centres.

use super::posed_solid::{PosedSolid, SolidKind};
use super::state::DepthState;
use super::vertical_shapes::dot3;
use super::{sheared_box, vertical_dispatch};
use crate::bodies::BodySet;
use crate::broad_phase::proxies::{Proxies, Proxy};
use crate::continuous_collision::time_of_impact::{SweptPair, SweptShape};
use crate::index::ProxyIndex;
use crate::math::Vector3;
use crate::math::plane::{length, rotate, rotation, sum};
use crate::slanted_box::SlantedBox;

/// Shape with its pose at the start of the step and its displacement in the step.
#[derive(Clone, Copy)]
struct SweptSolid<'a> {
    /// Outline in x and y with its pose at the start of the step. `displacement` is that of the body in the step: x, y (length
    /// units), rotation (radians), z (length units).
    planar: SweptShape<'a>,
    /// Kind of the solid: prism, sphere, ground or vertical shape.
    kind: SolidKind,
    /// World position of the body along z at the start of the step, in length units.
    z: f32,
    /// Geometry of a sheared box; `None` for other shapes.
    sheared_box: Option<SlantedBox>,
}

impl SweptSolid<'_> {
    /// Returns the world position of the body along z after a fraction of the step, in length units.
    fn z_at(&self, fraction: f32) -> f32 {
        self.z + fraction * self.planar.displacement[3]
    }

    /// Returns the centre of a sphere after a fraction of the step: x, y and z in world coordinates, length units.
    fn centre_at(&self, fraction: f32) -> [f32; 3] {
        let pose = self.planar.pose_at(fraction);
        let [x, y] = sum([pose[0], pose[1]], rotate(rotation(pose), self.planar.shape.shape.centre));
        [x, y, self.z_at(fraction)]
    }

    /// Returns the radius of a sphere, in length units; 0 for other shapes.
    fn radius(&self) -> f32 {
        if self.kind == SolidKind::Sphere { self.planar.shape.shape.radius } else { 0.0 }
    }

    /// Returns half of the extent of a prism along z, in length units; 0 for other shapes.
    fn half_depth(&self) -> f32 {
        if let SolidKind::Prism(half) = self.kind { half } else { 0.0 }
    }

    /// Returns the solid with radius 0 if it is a sphere, so that its centre is tested as a point. Other solids stay unchanged.
    fn without_rounding(mut self) -> Self {
        if self.kind == SolidKind::Sphere {
            self.planar.shape.shape.radius = 0.0;
        }
        self
    }
}

impl DepthState {
    /// Returns the proxy with the index `at` as a swept solid. `path` is the displacement of its body in the step: x, y (length
    /// units), rotation (radians), z (length units).
    fn swept_solid<'a>(
        &self,
        at: ProxyIndex,
        proxies: &'a Proxies,
        bodies: &BodySet,
        path: [f32; 4],
    ) -> SweptSolid<'a> {
        let proxy: &Proxy = proxies.proxy(at);
        let plane = SweptShape {
            shape: proxies.vertices.shape_ref(proxy.shape),
            pose: bodies.poses[proxy.body],
            displacement: path,
        };
        let solid = self.posed_solid(at, proxy, plane.shape, (bodies, 0.0));
        SweptSolid { planar: plane, kind: solid.kind, z: solid.z, sheared_box: solid.sheared_box }
    }

    /// Returns the distance of two proxies after a fraction of the step (length units) and an upper bound of their closing
    /// speed (length units per step). `paths` are the displacements of both bodies in the step: x, y (length units), rotation
    /// (radians), z (length units).
    pub(crate) fn distance_and_closing_speed(
        &self,
        [a, b]: [ProxyIndex; 2],
        proxies: &Proxies,
        bodies: &BodySet,
        paths: [[f32; 4]; 2],
        fraction: f32,
    ) -> (f32, f32) {
        if self.is_vertical(a) || self.is_vertical(b) {
            return self.distance_and_closing_speed_vertical([a, b], proxies, bodies, paths, fraction);
        }
        let [a, b] =
            [(a, paths[0]), (b, paths[1])].map(|(at, path)| self.swept_solid(at, proxies, bodies, path));
        let (apart, axis, leaning) = separation(a, b, fraction);
        let turning =
            |one: &SweptSolid<'_>| one.planar.displacement[2].abs() * one.planar.shape.shape.max_extent;
        let displacement = [0, 1, 3].map(|at| b.planar.displacement[at] - a.planar.displacement[at]);
        let along = displacement.iter().zip(axis).fold(0.0, |sum, (component, axis)| sum + component * axis);
        (apart, turning(&a) + turning(&b) + leaning * displacement[2].abs() - along)
    }
}

impl DepthState {
    /// Returns the distance (length units) of two proxies, one of which has a vertical shape, after a fraction of the step, and
    /// an upper bound of their closing speed (length units per step). `paths` are the displacements of both bodies in the step.
    fn distance_and_closing_speed_vertical(
        &self,
        [a, b]: [ProxyIndex; 2],
        proxies: &Proxies,
        bodies: &BodySet,
        paths: [[f32; 4]; 2],
        fraction: f32,
    ) -> (f32, f32) {
        let [(a, way_a), (b, way_b)] = [(a, paths[0]), (b, paths[1])].map(|(at, path)| {
            let proxy = proxies.proxy(at);
            let outline = proxies.vertices.shape_ref(proxy.shape);
            let plane = SweptShape { shape: outline, pose: bodies.poses[proxy.body], displacement: path };
            let mut solid = self.posed_solid(at, proxy, outline, (bodies, 0.0));
            (solid.pose, solid.z) = (plane.pose_at(fraction), solid.z + fraction * path[3]);
            (solid, path)
        });
        let (apart, axis) = vertical_dispatch::separation(a, b);
        let turning = |solid: &PosedSolid<'_>, path: [f32; 4]| path[2].abs() * solid.outline.shape.max_extent;
        let displacement = [0, 1, 3].map(|at| way_b[at] - way_a[at]);
        (apart, turning(&a, way_a) + turning(&b, way_b) - dot3(displacement, axis))
    }
}

/// Returns three values of A and B after a fraction of the step: their separation (length units), the unit axis x, y, z from A
/// to B, and a dimensionless factor. Displacement along z times this factor adds to the closing speed, because the axis of a
/// sheared box changes with depth.
fn separation(a: SweptSolid<'_>, b: SweptSolid<'_>, fraction: f32) -> (f32, [f32; 3], f32) {
    match (a.kind, b.kind) {
        (SolidKind::Ground, _) => {
            (-(b.planar.support(b.planar.pose_at(fraction), [0.0, 1.0])), [0.0, -1.0, 0.0], 0.0)
        }
        (SolidKind::Sphere, SolidKind::Sphere) => separation_spheres(a, b, fraction),
        (SolidKind::Prism(_), SolidKind::Sphere) if a.sheared_box.is_some() => {
            separation_sheared_box(a, b, fraction)
        }
        _ => separation_prisms(a, b, fraction),
    }
}

/// Returns the separation of two spheres after a fraction of the step (length units), the unit axis from A to B, and the factor
/// 0, since the axis does not change with depth.
fn separation_spheres(a: SweptSolid<'_>, b: SweptSolid<'_>, fraction: f32) -> (f32, [f32; 3], f32) {
    let (from, to) = (a.centre_at(fraction), b.centre_at(fraction));
    let offset: [f32; 3] = std::array::from_fn(|axis| to[axis] - from[axis]);
    let distance = length([length([offset[0], offset[1]]), offset[2]]);
    let axis = if distance > 0.0 { offset.map(|component| component / distance) } else { [0.0, 1.0, 0.0] };
    (distance - a.radius() - b.radius(), axis, 0.0)
}

/// Returns the separation of a sphere from the sheared box A after a fraction of the step (length units), and the unit axis
/// from the closest point of the box to the sphere. The third value is 0: displacement along z adds nothing to the closing
/// speed.
fn separation_sheared_box(a: SweptSolid<'_>, ball: SweptSolid<'_>, fraction: f32) -> (f32, [f32; 3], f32) {
    let [x, y] = [0, 1].map(|axis| fraction * a.planar.displacement[axis]);
    let moved = Vector3::new(x, y, fraction * a.planar.displacement[3]);
    let nearest =
        a.sheared_box.and_then(|shape| shape.nearest(Vector3::from(ball.centre_at(fraction)) - moved));
    let (distance, axis) = nearest.unwrap_or((f32::MAX, Vector3::new(0.0, -1.0, 0.0)));
    (distance - ball.radius(), axis.into(), 0.0)
}

/// Returns the separation of two prisms, or of a prism and a sphere, after a fraction of the step (length units): in the plane,
/// along z, or oblique for a sphere near a rim. The other values are the unit axis from A to B and the factor by which
/// displacement along z adds to the closing speed.
fn separation_prisms(a: SweptSolid<'_>, b: SweptSolid<'_>, fraction: f32) -> (f32, [f32; 3], f32) {
    let radius = a.radius() + b.radius();
    let behind = b.z_at(fraction) - a.z_at(fraction);
    let side = if behind < 0.0 { -1.0 } else { 1.0 };
    let gap = behind.abs() - a.half_depth() - b.half_depth();
    let (apart, [x, y], leaning) = separation_in_plane(a.without_rounding(), b.without_rounding(), fraction);
    if radius > 0.0 && apart > 0.0 && gap > 0.0 {
        let distance = length([apart, gap]);
        let axis = [x * apart / distance, y * apart / distance, side * gap / distance];
        return (distance - radius, axis, leaning);
    }
    if apart > gap { (apart - radius, [x, y, 0.0], leaning) } else { (gap - radius, [0.0, 0.0, side], 0.0) }
}

/// Returns the separation of two solids in the plane (length units), the unit axis in x and y from A to B, and the factor by
/// which displacement along z adds to the closing speed. A sheared box is replaced by its outline over the depth range of the
/// other solid.
fn separation_in_plane(a: SweptSolid<'_>, b: SweptSolid<'_>, fraction: f32) -> (f32, [f32; 2], f32) {
    let Some(shape) = a.sheared_box else {
        let (apart, axis) = SweptPair { a: a.planar, b: b.planar }.separation(fraction);
        return (apart, axis, 0.0);
    };
    let (z, half) = (b.z_at(fraction), b.half_depth());
    let within = |z: f32| (z - shape.centre.z).clamp(-shape.half[2], shape.half[2]) + shape.centre.z;
    let (corners, outline) = sheared_box::outline_between(&shape, within(z - half), within(z + half));
    let pose = [a.planar.pose[0], a.planar.pose[1], 1.0, 0.0];
    let swept = SweptShape { shape: corners.shape_ref(outline), pose, displacement: a.planar.displacement };
    let (apart, axis) = SweptPair { a: swept, b: b.planar }.separation(fraction);
    (apart, axis, shape.lean(axis).abs())
}
