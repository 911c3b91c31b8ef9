//! Checks that all readable numbers of a 2.5D simulator are finite.

use farseer_core::{BodyId, GeomId};
use twohalf::{TwoHalfContact, TwoHalfPhysicsSimulator, Vector3};

use crate::finite::finite;
use crate::plane;

/// Checks that every readable number is finite, including those of the 2D engine below. The error names the first that is not.
pub(crate) fn check_numbers(simulator: &TwoHalfPhysicsSimulator) -> Result<(), String> {
    plane::check_numbers(simulator.core())?;
    simulator.core().bodies().try_for_each(|body| check_body(simulator, body))?;
    simulator.core().geoms().try_for_each(|geom| check_geom(simulator, geom))?;
    simulator.contacts().try_for_each(|contact| check_contact(&contact))?;
    simulator.platforms().filter_map(|id| simulator.platform(id)).try_for_each(|platform| {
        vector("velocity of a platform", platform.velocity())?;
        vector("position of a platform", platform.position3d())?;
        platform.corners().iter().try_for_each(|&corner| vector("corner of a platform", corner))
    })
}

fn vector(name: &str, vector: Vector3) -> Result<(), String> {
    finite(name, vector.iter())
}

fn check_body(simulator: &TwoHalfPhysicsSimulator, id: BodyId) -> Result<(), String> {
    let body = simulator.body(id).ok_or("a body of the 2D engine is unknown")?;
    vector("position3d", body.position3d())?;
    vector("origin3d", body.origin3d())?;
    vector("velocity3d", body.velocity3d())?;
    vector("angular_velocity3d", body.angular_velocity3d())?;
    finite("force_z", &[body.force_z()])?;
    finite("layer_depth", &[body.layer_depth()])?;
    body.supports().iter().try_for_each(|support| vector("normal of a support", support.normal))?;
    let Some(surface) = simulator.surface_beneath_body(id) else { return Ok(()) };
    finite("height of the surface beneath", &[surface.height])?;
    vector("normal of the surface beneath", surface.normal)
}

fn check_geom(simulator: &TwoHalfPhysicsSimulator, id: GeomId) -> Result<(), String> {
    let geom = simulator.geom(id).ok_or("a geom of the 2D engine is unknown")?;
    vector("geom position3d", geom.position3d())?;
    geom.screen_outline().iter().try_for_each(|corner| finite("screen_outline", corner.iter()))?;
    let hull = geom.virtual_geom();
    finite("virtual_geom", &[hull.left, hull.right, hull.front, hull.back, hull.bottom, hull.top])?;
    let (near, far) = simulator.depth_interval(id).unwrap_or_default();
    finite("depth_interval", &[near, far])
}

fn check_contact(contact: &TwoHalfContact) -> Result<(), String> {
    vector("contact position", contact.position)?;
    vector("contact normal", contact.normal)?;
    finite("separation", &[contact.separation])?;
    finite("normal_impulse", &[contact.normal_impulse])?;
    finite("friction_impulse", &[contact.friction_impulse])
}
