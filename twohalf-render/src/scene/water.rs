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

    /// Whether something is drawn over it: what stands before it, floats above it, or adjoins it on the side to which the Z axis leans.
    pub(super) fn is_behind(&self, simulator: &TwoHalfPhysicsSimulator, thing: Drawable) -> bool {
        let (low, high) = (self.region.low(), self.region.high());
        let Some((least, greatest)) = bounds(simulator, thing) else { return false };
        let is_aside =
            if simulator.angle() <= 90 { least.x >= high.x - NEAR } else { greatest.x <= low.x + NEAR };
        is_aside || greatest.z <= low.z + NEAR || least.y >= high.y - NEAR
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

/// The least and the greatest X, Y and Z of something.
fn bounds(simulator: &TwoHalfPhysicsSimulator, thing: Drawable) -> Option<(Vector3, Vector3)> {
    match thing {
        Drawable::Platform(id) => {
            let corners = simulator.platform(id)?.corners();
            let first = corners[0];
            Some(
                corners
                    .iter()
                    .fold((first, first), |(low, high), corner| (low.inf(corner), high.sup(corner))),
            )
        }
        Drawable::Body(id) => {
            let shapes = simulator.core().geoms_of(id).iter().filter_map(|&geom| simulator.geom(geom));
            let ends = shapes.map(|geom| geom.virtual_geom()).map(|shape| {
                (
                    Vector3::new(shape.left, shape.bottom, shape.front),
                    Vector3::new(shape.right, shape.top, shape.back),
                )
            });
            ends.reduce(|(low, high), (other_low, other_high)| (low.inf(&other_low), high.sup(&other_high)))
        }
    }
}
