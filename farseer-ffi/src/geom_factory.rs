//! Geoms as Farseer's factories make them.

use std::mem::MaybeUninit;

use farseer_core::{BodyId, GeomFactory, GeomId, GeomPlacement, Objects};

use crate::arguments::{FarseerVector2, Finite};
use crate::arrays;
use crate::body_factory::corners;
use crate::failure::{FarseerStatus, Outcome};
use crate::guard::{FarseerSimulator, write};
use crate::ids::{FarseerBody, FarseerGeom, Id};

/// Place of a geom on its body. Zero in all fields, or null, is the body's origin.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FarseerPlacement {
    /// Position on the body in length units, before the geom is turned: the rotation turns it, too.
    pub offset: FarseerVector2,
    /// Rotation relative to the body in radians.
    pub rotation_offset: f32,
    /// Edge of a cell of the distance grid in length units; 0: a tenth of the shorter side.
    pub collision_grid_size: f32,
}

/// Reads a placement. Null is the body's origin.
fn placed(placement: Option<&FarseerPlacement>) -> Outcome<GeomPlacement> {
    let placement = placement.copied().unwrap_or_default();
    Ok(GeomPlacement {
        offset: placement.offset.finite("placement.offset")?,
        rotation_offset: placement.rotation_offset.finite("placement.rotation_offset")?,
        collision_grid_size: placement.collision_grid_size.finite("placement.collision_grid_size")?,
    })
}

/// Makes a geom, adds it, and writes its id.
fn create(
    simulator: Option<&FarseerSimulator>,
    (body, placement): (FarseerBody, Option<&FarseerPlacement>),
    geom: Option<&mut MaybeUninit<FarseerGeom>>,
    make: impl FnOnce(&mut Objects, BodyId, GeomPlacement) -> farseer_core::Result<GeomId>,
) -> FarseerStatus {
    write(simulator, "geom", geom, |world| {
        let body = BodyId::from_number("body", body)?;
        make(&mut world.simulator, body, placed(placement)?)?.to_number()
    })
}

/// Adds a rectangle to a body; sides in length units, > 0.
/// `placement` may be null.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_geom_create_rectangle(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    width: f32,
    height: f32,
    placement: Option<&FarseerPlacement>,
    geom: Option<&mut MaybeUninit<FarseerGeom>>,
) -> FarseerStatus {
    create(simulator, (body, placement), geom, |objects, body, placement| {
        GeomFactory::create_rectangle_geom_in(objects, body, width, height, placement)
    })
}

/// Adds a circle to a body; radius in length units, > 0. For the faithful methods it is a polygon with this number of edges.
/// `placement` may be null.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_geom_create_circle(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    radius: f32,
    edges: i32,
    placement: Option<&FarseerPlacement>,
    geom: Option<&mut MaybeUninit<FarseerGeom>>,
) -> FarseerStatus {
    create(simulator, (body, placement), geom, |objects, body, placement| {
        GeomFactory::create_circle_geom_in(objects, body, radius, edges, placement)
    })
}

/// Adds an ellipse as a polygon to a body; radii in length units, > 0.
/// `placement` may be null.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_geom_create_ellipse(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    x_radius: f32,
    y_radius: f32,
    edges: i32,
    placement: Option<&FarseerPlacement>,
    geom: Option<&mut MaybeUninit<FarseerGeom>>,
) -> FarseerStatus {
    create(simulator, (body, placement), geom, |objects, body, placement| {
        GeomFactory::create_ellipse_geom_in(objects, body, x_radius, y_radius, edges, placement)
    })
}

/// Adds an upright capsule to a body; height from tip to tip and radius in length units, with this number of edges at each end.
/// `placement` may be null.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_geom_create_capsule(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    height: f32,
    end_radius: f32,
    edges: i32,
    placement: Option<&FarseerPlacement>,
    geom: Option<&mut MaybeUninit<FarseerGeom>>,
) -> FarseerStatus {
    create(simulator, (body, placement), geom, |objects, body, placement| {
        GeomFactory::create_capsule_geom_in(objects, body, height, end_radius, edges, placement)
    })
}

/// Adds a polygon to a body; corners in length units.
/// `placement` may be null.
///
/// # Safety
/// An array that is not null has the items that its number says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn farseer_geom_create_polygon(
    simulator: Option<&FarseerSimulator>,
    body: FarseerBody,
    points: *const FarseerVector2,
    count: usize,
    placement: Option<&FarseerPlacement>,
    geom: Option<&mut MaybeUninit<FarseerGeom>>,
) -> FarseerStatus {
    write(simulator, "geom", geom, |world| {
        let body = BodyId::from_number("body", body)?;
        // SAFETY: the caller answers for the array.
        let mut corners = corners(unsafe { arrays::read("points", points, count) })?;
        GeomFactory::create_polygon_geom_in(&mut world.simulator, body, &mut corners, placed(placement)?)?
            .to_number()
    })
}
