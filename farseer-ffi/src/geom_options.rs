//! Geoms described by options.

use std::mem::MaybeUninit;

use farseer_core::math::Vector2;
use farseer_core::{BodyId, CollisionCategory, GeomBuilder, WantedEvents};

use crate::arguments::{FarseerVector2, Finite, choose, flag};
use crate::arrays;
use crate::failure::{Failure, FarseerStatus, Outcome};
use crate::guard::{FarseerSimulator, answer, write};
use crate::ids::{FarseerBody, FarseerGeom, Id};

/// Shapes of geoms.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FarseerShape {
    /// `width` by `height`.
    Rectangle = 0,
    /// `radius`.
    Circle = 1,
    /// Upright: `height` from tip to tip, `radius` of its ends.
    Capsule = 2,
    /// The corners `points`, convex or not.
    Polygon = 3,
    /// Edges between the `points`, solid from one side, on a static body; under the precise methods.
    Chain = 4,
    /// Edges between the `points`, solid from both sides, on a static body; under the precise methods.
    TwoSidedChain = 5,
    /// The corners `points`, rounded by `radius`; under the precise methods.
    RoundedPolygon = 6,
}

/// Events that a geom wants, to be added up.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FarseerWantedEvents {
    /// No events.
    None = 0,
    /// Begin and end of touches.
    Touch = 1,
    /// Begin and end of overlaps with sensors.
    Sensor = 2,
    /// Hits.
    Hit = 4,
}

/// A geom for farseer_body_create and farseer_geom_create. Start from farseer_geom_options_default.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FarseerGeomOptions {
    /// Shape code: a FarseerShape.
    pub shape: i32,
    /// Width of a rectangle in length units.
    pub width: f32,
    /// Height of a rectangle or a capsule in length units.
    pub height: f32,
    /// Radius of a circle, of the ends of a capsule or of rounded corners, in length units.
    pub radius: f32,
    /// Points of polygons and chains, in length units; read by the call alone.
    pub points: *const FarseerVector2,
    /// Number of points.
    pub point_count: usize,
    /// Position on the body in length units.
    pub offset: FarseerVector2,
    /// Rotation relative to the body in radians.
    pub rotation_offset: f32,
    /// Mass per square of a length unit; 0: the engine's default.
    pub density: f32,
    /// Mass in mass units, instead of a density; 0: by the density.
    pub mass: f32,
    /// Friction coefficient.
    pub friction: f32,
    /// Restitution coefficient, 0 to 1.
    pub restitution: f32,
    /// Bit mask: the categories of the geom.
    pub categories: i32,
    /// Bit mask: the categories that it collides with.
    pub collides_with: i32,
    /// Group number: geoms of one group other than 0 do not collide.
    pub group: i32,
    /// Flag: whether it is a sensor, which exerts no impulses.
    pub sensor: i32,
    /// Bit mask: a sum of FarseerWantedEvents; -1: touches and sensors under the precise methods.
    pub wanted_events: i32,
    /// A number of yours: the tag.
    pub tag: u64,
}

impl Default for FarseerGeomOptions {
    fn default() -> Self {
        FarseerGeomOptions {
            shape: FarseerShape::Rectangle as i32,
            width: 1.0,
            height: 1.0,
            radius: 0.5,
            points: std::ptr::null(),
            point_count: 0,
            offset: FarseerVector2::default(),
            rotation_offset: 0.0,
            density: 0.0,
            mass: 0.0,
            friction: 0.6,
            restitution: 0.0,
            categories: CollisionCategory::ALL.bits(),
            collides_with: CollisionCategory::ALL.bits(),
            group: 0,
            sensor: 0,
            wanted_events: -1,
            tag: 0,
        }
    }
}

/// Shapes in the order of their codes.
const SHAPES: [FarseerShape; 7] = [
    FarseerShape::Rectangle,
    FarseerShape::Circle,
    FarseerShape::Capsule,
    FarseerShape::Polygon,
    FarseerShape::Chain,
    FarseerShape::TwoSidedChain,
    FarseerShape::RoundedPolygon,
];

impl FarseerGeomOptions {
    /// The points of a polygon or a chain.
    ///
    /// # Safety
    /// As [`arrays::read`].
    unsafe fn corners(&self) -> Outcome<Vec<Vector2>> {
        // SAFETY: as that of this function.
        let points = unsafe { arrays::read("options.points", self.points, self.point_count) }?;
        points.iter().map(|point| point.finite("options.points")).collect()
    }

    /// The shape, without its other options.
    ///
    /// # Safety
    /// As [`arrays::read`] for the points.
    unsafe fn shaped(&self) -> Outcome<GeomBuilder> {
        // SAFETY: as that of this function.
        let corners = || unsafe { self.corners() };
        Ok(match choose("options.shape", self.shape, &SHAPES)? {
            FarseerShape::Rectangle => GeomBuilder::rectangle(self.width, self.height),
            FarseerShape::Circle => GeomBuilder::circle(self.radius),
            FarseerShape::Capsule => GeomBuilder::capsule(self.height, self.radius),
            FarseerShape::Polygon => GeomBuilder::polygon(corners()?),
            FarseerShape::Chain => GeomBuilder::chain(corners()?),
            FarseerShape::TwoSidedChain => GeomBuilder::two_sided_chain(corners()?),
            FarseerShape::RoundedPolygon => GeomBuilder::rounded_polygon(corners()?, self.radius),
        })
    }

    /// The engine's description of the geom.
    ///
    /// # Safety
    /// As [`arrays::read`] for the points.
    unsafe fn builder(&self) -> Outcome<GeomBuilder> {
        // SAFETY: as that of this function.
        let mut builder = unsafe { self.shaped() }?
            .offset(self.offset.finite("options.offset")?)
            .rotation_offset(self.rotation_offset.finite("options.rotation_offset")?)
            .friction(self.friction.finite("options.friction")?)
            .restitution(self.restitution.finite("options.restitution")?)
            .categories(CollisionCategory::from_bits(self.categories))
            .collides_with(CollisionCategory::from_bits(self.collides_with))
            .group(self.group)
            .sensor(flag("options.sensor", self.sensor)?)
            .user_data(self.tag);
        if self.density != 0.0 {
            builder = builder.density(self.density);
        }
        if self.mass != 0.0 {
            builder = builder.mass(self.mass);
        }
        if self.wanted_events != -1 {
            builder = builder.events(wanted("options.wanted_events", self.wanted_events)?);
        }
        Ok(builder)
    }
}

/// The engine's descriptions of geoms.
///
/// # Safety
/// As [`arrays::read`] for the points of each.
pub(crate) unsafe fn builders(options: &[FarseerGeomOptions]) -> Outcome<Vec<GeomBuilder>> {
    // SAFETY: as that of this function.
    options.iter().map(|options| unsafe { options.builder() }).collect()
}

/// Reads a sum of wanted events.
pub(crate) fn wanted(argument: &str, bits: i32) -> Outcome<WantedEvents> {
    if !(0..8).contains(&bits) {
        return Err(Failure::invalid(argument, bits, "a sum of FarseerWantedEvents, 0 to 7"));
    }
    let events = [WantedEvents::TOUCH, WantedEvents::SENSOR, WantedEvents::HIT];
    let set = (0..).zip(events).filter(|(place, _)| bits >> place & 1 == 1);
    Ok(set.fold(WantedEvents::NONE, |all, (_, event)| all | event))
}

/// Writes the options of a rectangle of 1 by 1 length unit, with friction 0.6.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_geom_options_default(
    options: Option<&mut MaybeUninit<FarseerGeomOptions>>,
) -> FarseerStatus {
    answer(|| {
        options.ok_or_else(|| Failure::null("options"))?.write(FarseerGeomOptions::default());
        Ok(())
    })
}

/// Adds a geom to a body, whose mass and centre of mass stay.
///
/// # Safety
/// An array that is not null has the items that its number says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn farseer_geom_create(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    options: Option<&FarseerGeomOptions>,
    geom: Option<&mut MaybeUninit<FarseerGeom>>,
) -> FarseerStatus {
    write(simulator, "geom", geom, |world| {
        let body = BodyId::from_number("body", body)?;
        let options = options.ok_or_else(|| Failure::null("options"))?;
        // SAFETY: the caller answers for the points of the options.
        let builder = unsafe { options.builder() }?;
        world.simulator.add_geom(body, &builder)?.to_number()
    })
}
