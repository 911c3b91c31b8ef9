//! How two come together on their ways through a step, in three axes: what [`flight`](crate::precise::flight) asks.
//!
//! Outlines are apart as long as they are in the plane or along the depth axis, balls by their distance. Each of these tells an
//! axis along which the two come together no faster than by their velocity, and by what turns in the plane.

use super::solid::{Kind, Solid};
use super::upright::product;
use super::{Space, slant, standing};
use crate::math::Vector3;
use crate::math::plane::{length, rotation, sum, turn};
use crate::precise::bodies::Bodies;
use crate::precise::flight::{Flyer, Two};
use crate::precise::proxies::{Proxies, Proxy};
use crate::shape::SlantedBox;

/// Something on its way.
#[derive(Clone, Copy)]
struct Flying<'a> {
    plane: Flyer<'a>,
    kind: Kind,
    z: f32,
    slant: Option<SlantedBox>,
}

impl Flying<'_> {
    fn height(&self, part: f32) -> f32 {
        self.z + part * self.plane.path[3]
    }

    /// The middle of a ball.
    fn centre(&self, part: f32) -> [f32; 3] {
        let pose = self.plane.at(part);
        let [x, y] = sum([pose[0], pose[1]], turn(rotation(pose), self.plane.outline.shape.centre));
        [x, y, self.height(part)]
    }

    fn radius(&self) -> f32 {
        if self.kind == Kind::Ball { self.plane.outline.shape.radius } else { 0.0 }
    }

    fn half(&self) -> f32 {
        if let Kind::Prism(half) = self.kind { half } else { 0.0 }
    }

    /// The same without the roundness of a ball.
    fn core(mut self) -> Self {
        if self.kind == Kind::Ball {
            self.plane.outline.shape.radius = 0.0;
        }
        self
    }
}

impl Space {
    fn flying<'a>(&self, at: u32, proxies: &'a Proxies, bodies: &Bodies, path: [f32; 4]) -> Flying<'a> {
        let proxy: &Proxy = &proxies.all[at as usize];
        let plane = Flyer {
            outline: proxies.corners.outline(proxy.shape),
            pose: bodies.poses[proxy.body as usize],
            path,
        };
        let solid = self.solid(at, proxy, plane.outline, (bodies, 0.0));
        Flying { plane, kind: solid.kind, z: solid.z, slant: solid.slant }
    }

    /// Distance of a pair after a part of the step, and how fast it can become less, in lengths per step; with the paths of
    /// its bodies in the step.
    pub(in crate::precise) fn coming(
        &self,
        [a, b]: [u32; 2],
        proxies: &Proxies,
        bodies: &Bodies,
        paths: [[f32; 4]; 2],
        part: f32,
    ) -> (f32, f32) {
        if self.is_upright(a) || self.is_upright(b) {
            return self.coming_upright([a, b], proxies, bodies, paths, part);
        }
        let [a, b] = [(a, paths[0]), (b, paths[1])].map(|(at, path)| self.flying(at, proxies, bodies, path));
        let (apart, axis, leaning) = separation(a, b, part);
        let turning = |one: &Flying<'_>| one.plane.path[2].abs() * one.plane.outline.shape.reach;
        let way = [0, 1, 3].map(|at| b.plane.path[at] - a.plane.path[at]);
        let along = way.iter().zip(axis).fold(0.0, |sum, (way, axis)| sum + way * axis);
        (apart, turning(&a) + turning(&b) + leaning * way[2].abs() - along)
    }
}

impl Space {
    /// The same of a pair of which one is upright.
    fn coming_upright(
        &self,
        [a, b]: [u32; 2],
        proxies: &Proxies,
        bodies: &Bodies,
        paths: [[f32; 4]; 2],
        part: f32,
    ) -> (f32, f32) {
        let [(a, way_a), (b, way_b)] = [(a, paths[0]), (b, paths[1])].map(|(at, path)| {
            let proxy = &proxies.all[at as usize];
            let outline = proxies.corners.outline(proxy.shape);
            let plane = Flyer { outline, pose: bodies.poses[proxy.body as usize], path };
            let mut solid = self.solid(at, proxy, outline, (bodies, 0.0));
            (solid.pose, solid.z) = (plane.at(part), solid.z + part * path[3]);
            (solid, path)
        });
        let (apart, axis) = standing::separation(a, b);
        let turning = |solid: &Solid<'_>, path: [f32; 4]| path[2].abs() * solid.outline.shape.reach;
        let way = [0, 1, 3].map(|at| way_b[at] - way_a[at]);
        (apart, turning(&a, way_a) + turning(&b, way_b) - product(way, axis))
    }
}

/// Distance of two, the axis along which it is, from A to B, and how much of the way along the depth axis adds to it.
fn separation(a: Flying<'_>, b: Flying<'_>, part: f32) -> (f32, [f32; 3], f32) {
    match (a.kind, b.kind) {
        (Kind::Ground, _) => (-(b.plane.support(b.plane.at(part), [0.0, 1.0])), [0.0, -1.0, 0.0], 0.0),
        (Kind::Ball, Kind::Ball) => of_balls(a, b, part),
        (Kind::Prism(_), Kind::Ball) if a.slant.is_some() => of_slant(a, b, part),
        _ => of_prisms(a, b, part),
    }
}

fn of_balls(a: Flying<'_>, b: Flying<'_>, part: f32) -> (f32, [f32; 3], f32) {
    let (from, to) = (a.centre(part), b.centre(part));
    let way: [f32; 3] = std::array::from_fn(|axis| to[axis] - from[axis]);
    let distance = length([length([way[0], way[1]]), way[2]]);
    let axis = if distance > 0.0 { way.map(|way| way / distance) } else { [0.0, 1.0, 0.0] };
    (distance - a.radius() - b.radius(), axis, 0.0)
}

/// A ball and the nearest point of a box that leans or climbs.
fn of_slant(a: Flying<'_>, ball: Flying<'_>, part: f32) -> (f32, [f32; 3], f32) {
    let [x, y] = [0, 1].map(|axis| part * a.plane.path[axis]);
    let moved = Vector3::new(x, y, part * a.plane.path[3]);
    let nearest = a.slant.and_then(|shape| shape.nearest(Vector3::from(ball.centre(part)) - moved));
    let (distance, axis) = nearest.unwrap_or((f32::MAX, Vector3::new(0.0, -1.0, 0.0)));
    (distance - ball.radius(), axis.into(), 0.0)
}

fn of_prisms(a: Flying<'_>, b: Flying<'_>, part: f32) -> (f32, [f32; 3], f32) {
    let radius = a.radius() + b.radius();
    let behind = b.height(part) - a.height(part);
    let side = if behind < 0.0 { -1.0 } else { 1.0 };
    let gap = behind.abs() - a.half() - b.half();
    let (apart, [x, y], leaning) = in_plane(a.core(), b.core(), part);
    if radius > 0.0 && apart > 0.0 && gap > 0.0 {
        let distance = length([apart, gap]);
        let axis = [x * apart / distance, y * apart / distance, side * gap / distance];
        return (distance - radius, axis, leaning);
    }
    if apart > gap { (apart - radius, [x, y, 0.0], leaning) } else { (gap - radius, [0.0, 0.0, side], 0.0) }
}

fn in_plane(a: Flying<'_>, b: Flying<'_>, part: f32) -> (f32, [f32; 2], f32) {
    let Some(shape) = a.slant else {
        let (apart, axis) = Two { a: a.plane, b: b.plane }.separation(part);
        return (apart, axis, 0.0);
    };
    let (z, half) = (b.height(part), b.half());
    let within = |z: f32| (z - shape.centre.z).clamp(-shape.half[2], shape.half[2]) + shape.centre.z;
    let (corners, outline) = slant::swept(&shape, within(z - half), within(z + half));
    let pose = [a.plane.pose[0], a.plane.pose[1], 1.0, 0.0];
    let swept = Flyer { outline: corners.outline(outline), pose, path: a.plane.path };
    let (apart, axis) = Two { a: swept, b: b.plane }.separation(part);
    (apart, axis, shape.lean(axis).abs())
}
