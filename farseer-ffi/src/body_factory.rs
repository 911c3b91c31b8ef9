//! Bodies as Farseer's factories make them.

use std::mem::MaybeUninit;

use farseer_core::math::Vector2;
use farseer_core::{BodyFactory, BodyId, Objects, Vertices};

use crate::arguments::{FarseerVector2, Finite};
use crate::arrays;
use crate::failure::{FarseerStatus, Outcome};
use crate::guard::{FarseerSimulator, write};
use crate::ids::{FarseerBody, Id};

/// Makes a body, adds it, and writes its id.
fn create(
    simulator: Option<&FarseerSimulator>,
    body: Option<&mut MaybeUninit<FarseerBody>>,
    make: impl FnOnce(&mut Objects) -> farseer_core::Result<BodyId>,
) -> FarseerStatus {
    write(simulator, "body", body, |world| make(&mut world.simulator)?.to_number())
}

/// The corners of a polygon, in length units.
pub(crate) fn corners(points: Outcome<&[FarseerVector2]>) -> Outcome<Vertices> {
    let corners: Vec<Vector2> = points?.iter().map(|point| point.finite("points")).collect::<Outcome<_>>()?;
    Ok(corners.into_iter().collect())
}

/// Makes a body with the moment of inertia of a rectangle; sides in length units, > 0.
/// It has no shape: add a geom.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_create_rectangle(
    simulator: Option<&FarseerSimulator>,
    width: f32,
    height: f32,
    mass: f32,
    body: Option<&mut MaybeUninit<FarseerBody>>,
) -> FarseerStatus {
    create(simulator, body, |objects| BodyFactory::create_rectangle_body_in(objects, width, height, mass))
}

/// Makes a body with the moment of inertia of a disc; radius in length units, > 0.
/// It has no shape: add a geom.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_create_circle(
    simulator: Option<&FarseerSimulator>,
    radius: f32,
    mass: f32,
    body: Option<&mut MaybeUninit<FarseerBody>>,
) -> FarseerStatus {
    create(simulator, body, |objects| BodyFactory::create_circle_body_in(objects, radius, mass))
}

/// Makes a body with the moment of inertia of an ellipse; radii in length units, > 0.
/// It has no shape: add a geom.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_create_ellipse(
    simulator: Option<&FarseerSimulator>,
    x_radius: f32,
    y_radius: f32,
    mass: f32,
    body: Option<&mut MaybeUninit<FarseerBody>>,
) -> FarseerStatus {
    create(simulator, body, |objects| BodyFactory::create_ellipse_body_in(objects, x_radius, y_radius, mass))
}

/// Makes a body with the moment of inertia of an upright capsule; height from tip to tip and radius in length units.
/// It has no shape: add a geom.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_create_capsule(
    simulator: Option<&FarseerSimulator>,
    height: f32,
    end_radius: f32,
    mass: f32,
    body: Option<&mut MaybeUninit<FarseerBody>>,
) -> FarseerStatus {
    create(simulator, body, |objects| BodyFactory::create_capsule_body_in(objects, height, end_radius, mass))
}

/// Makes a body with this mass in mass units and moment of inertia in mass units · length units².
/// It has no shape: add a geom.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_body_create_with_inertia(
    simulator: Option<&FarseerSimulator>,
    mass: f32,
    moment_of_inertia: f32,
    body: Option<&mut MaybeUninit<FarseerBody>>,
) -> FarseerStatus {
    create(simulator, body, |objects| BodyFactory::create_body_in(objects, mass, moment_of_inertia))
}

/// Makes a body with the moment of inertia of a polygon; corners in length units.
/// It has no shape: add a geom.
///
/// # Safety
/// An array that is not null has the items that its number says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn farseer_body_create_polygon(
    simulator: Option<&FarseerSimulator>,
    points: *const FarseerVector2,
    count: usize,
    mass: f32,
    body: Option<&mut MaybeUninit<FarseerBody>>,
) -> FarseerStatus {
    write(simulator, "body", body, |world| {
        // SAFETY: the caller answers for the array.
        let corners = corners(unsafe { arrays::read("points", points, count) })?;
        BodyFactory::create_polygon_body_in(&mut world.simulator, &corners, mass)?.to_number()
    })
}
