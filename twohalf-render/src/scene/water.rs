//! Boxes of the world that are seen through: water, gas, fog.

use twohalf::{Drawable, Field, Platform, Region, TwoHalfPhysicsSimulator, Vector3};

use super::{Look, Scene};
use crate::canvas::MAX_COORDINATE;
use crate::surface::to_screen;
use crate::{Canvas, Color, Point, Transform};

/// Greatest distance at which a body counts as adjoining the water, px.
const NEAR: f32 = 1.0;

/// A box of the world that is seen through, as a [`Fluid`](twohalf::Fluid) fills it. Bodies inside of it are
/// drawn below its surface and behind its front. Bodies before it or above it are drawn in front of it. A
/// body that sticks out is seen through the water up to the surface. The surface meets flat pictures and
/// solid bodies at their front, and platforms at their true intersection.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Water {
    /// The box, within the picture.
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

    /// The relation of a body or platform with this look to the water.
    pub(super) fn place_of(&self, scene: &Scene<'_>, thing: Drawable, look: &Look) -> Place {
        let (low, high) = (self.region.low(), self.region.high());
        let way = scene.shift(thing).way;
        let Some(bounds) = bounds(scene.simulator, thing) else { return Place::Under };
        let (least, greatest) = (bounds.0 + way, bounds.1 + way);
        let (is_left, is_right) = (greatest.x <= low.x + NEAR, least.x >= high.x - NEAR);
        let is_aside = match scene.simulator.angle() {
            90 => is_left || is_right,
            ..90 => is_right,
            _ => is_left,
        };
        let is_before = greatest.z <= low.z + NEAR;
        if is_aside || is_before || least.y >= high.y - NEAR {
            return Place::Over;
        }
        let front = front_of(scene.simulator, thing, look).map_or(least.z, |z| z + way.z);
        match thing {
            _ if greatest.y <= high.y + NEAR || least.z >= high.z - NEAR => Place::Under,
            Drawable::Platform(id)
                if scene
                    .simulator
                    .platform(id)
                    .is_some_and(|platform| is_level(platform) && front < low.z - NEAR) =>
            {
                Place::Over
            }
            Drawable::Platform(_) => Place::Through { row: None },
            Drawable::Body(_) if front < low.z - NEAR => Place::Over,
            Drawable::Body(_) => {
                let [_, row] = to_screen(scene.simulator, Vector3::new(0.0, high.y, front));
                Place::Through { row: Some(row) }
            }
        }
    }

    /// Splits a part of a body or platform that sticks out at the surface: below, above.
    pub(super) fn split(&self, part: Part, row: Option<f32>) -> [Part; 2] {
        let Part { rows: [from, to], heights: [low, high] } = part;
        match row {
            Some(row) => {
                [Part { rows: [from.max(row), to], ..part }, Part { rows: [from, to.min(row)], ..part }]
            }
            None => {
                let surface = self.region.high().y;
                [
                    Part { heights: [low, high.min(surface)], ..part },
                    Part { heights: [low.max(surface), high], ..part },
                ]
            }
        }
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

/// The relation of a body or platform to water.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Place {
    /// All of it is seen through the water, or lies behind it.
    Under,
    /// It sticks out: a body above a row of the screen, px, a platform above the surface.
    Through { row: Option<f32> },
    /// It stands before the water, floats above it, or adjoins it on the side to which the Z axis leans.
    Over,
}

/// A part of a body or platform that is drawn in one call: between two rows of the screen, px, and of a
/// platform between two heights, px.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Part {
    pub(super) rows: [f32; 2],
    pub(super) heights: [f32; 2],
}

impl Part {
    pub(super) const ALL: Part =
        Part { rows: [f32::NEG_INFINITY, f32::INFINITY], heights: [f32::NEG_INFINITY, f32::INFINITY] };

    /// Whether a height lies within the part.
    pub(super) fn holds(&self, height: f32) -> bool {
        let [low, high] = self.heights;
        low <= height && height < high
    }
}

/// Z of the frontmost drawn point: flat pictures, balls and capsules are drawn at the Z of their middle.
/// `None` for looks that are as deep as the body's box.
fn front_of(simulator: &TwoHalfPhysicsSimulator, thing: Drawable, look: &Look) -> Option<f32> {
    let Drawable::Body(id) = thing else { return None };
    let is_flat = match look {
        Look::Solid(_) | Look::Textured(..) => {
            let geoms = simulator.core().geoms_of(id);
            geoms.iter().all(|&geom| simulator.geom(geom).is_some_and(|geom| !geom.virtual_geom().has_top))
        }
        _ => true,
    };
    simulator.body(id).filter(|_| is_flat).map(|body| body.position3d().z)
}

fn is_level(platform: &Platform) -> bool {
    platform.rotation() == 0.0 && platform.pitch() == 0.0
}

/// The least and the greatest X, Y and Z of a body or platform.
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
