//! Boxes of the world through which things are seen: water, gas, fog.

use twohalf::{Drawable, Field, Region, TwoHalfPhysicsSimulator, Vector3};

use crate::canvas::MAX_COORDINATE;
use crate::surface::to_screen;
use crate::{Canvas, Color, Point, Transform};

/// What is no farther away adjoins, px.
const NEAR: f32 = 1.0;

/// A box of the world that is seen through, as a [`Fluid`](twohalf::Fluid) fills it. What is in it is drawn below its surface and behind
/// its front; what stands before it or flies over it, in front.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Water {
    /// Where it is, within the picture.
    pub region: Region,
    /// Its colour, translucent.
    pub color: Color,
}

impl Water {
    /// Clear water.
    pub const fn new(region: Region) -> Self {
        Water { region, color: Color::rgba(48, 128, 200, 125) }
    }

    /// All the water of a simulator: the fluids that have a density, unless they fill the world to one of its ends.
    pub fn all_of(simulator: &TwoHalfPhysicsSimulator) -> Vec<Water> {
        let fluids = simulator.fields().filter_map(|(_, field)| match field {
            Field::Fluid(fluid) if fluid.density > 0.0 => Some(fluid.region),
            _ => None,
        });
        let is_seen = |region: &Region| {
            let size = region.high() - region.low();
            size.iter().all(|side| *side < MAX_COORDINATE)
        };
        fluids.filter(is_seen).map(Water::new).collect()
    }

    /// The place in a list of things from back to front behind which it is drawn: what is farther back or in it comes before.
    pub(super) fn layer(
        &self,
        simulator: &TwoHalfPhysicsSimulator,
        things: impl Iterator<Item = Drawable>,
    ) -> usize {
        let (low, high) = (self.region.low(), self.region.high());
        let is_in_or_behind = |thing: Drawable| match thing {
            Drawable::Body(id) => simulator.body(id).is_some_and(|body| {
                let place = body.position3d();
                let is_beside = place.x < low.x || place.x > high.x;
                !is_beside && place.y < high.y && place.z >= low.z
            }),
            Drawable::Platform(id) => simulator.platform(id).is_some_and(|platform| {
                let corners = platform.corners();
                let least = |axis: usize| corners.iter().map(|corner| corner[axis]).fold(f32::MAX, f32::min);
                let greatest =
                    |axis: usize| corners.iter().map(|corner| corner[axis]).fold(f32::MIN, f32::max);
                let is_below = greatest(1) <= low.y + NEAR && least(0) < high.x && greatest(0) > low.x;
                // On the side from which the Z axis leans away, where the other side of it is seen through the water.
                let is_beside = if simulator.angle() <= 90 {
                    (greatest(0) - low.x).abs() <= NEAR
                } else {
                    (least(0) - high.x).abs() <= NEAR
                };
                least(2) >= high.z - NEAR || is_below || is_beside
            }),
        };
        let last = things.enumerate().filter(|(_, thing)| is_in_or_behind(*thing)).last();
        last.map_or(0, |(at, _)| at + 1)
    }

    pub(super) fn draw(&self, simulator: &TwoHalfPhysicsSimulator, canvas: &mut dyn Canvas) {
        let (low, high) = (self.region.low(), self.region.high());
        let at = |x: f32, y: f32, z: f32| to_screen(simulator, Vector3::new(x, y, z));
        let surface: [Point; 4] = [
            at(low.x, high.y, low.z),
            at(high.x, high.y, low.z),
            at(high.x, high.y, high.z),
            at(low.x, high.y, high.z),
        ];
        let front = [surface[0], surface[1], at(high.x, low.y, low.z), at(low.x, low.y, low.z)];
        let still = Transform::IDENTITY;
        canvas.fill_polygon(&surface, &still, self.color);
        canvas.fill_polygon(&front, &still, self.color.darker(0.3));
        canvas.stroke_polyline(&surface, true, 1.5, &still, Color::WHITE.with_alpha(self.color.a));
    }
}
