//! Makes bodies with a geom.

use farseer_core::math::Vector2;
use farseer_core::{BodyFactory, BodyId, GeomFactory, GeomId, GeomPlacement, PhysicsSimulator, Result};

use crate::random::Random;

/// Makes a box or a circle somewhere above the floor, and adds body and geom to the simulator.
///
/// # Errors
/// If the id space is exhausted.
pub(crate) fn create_thing(
    simulator: &mut PhysicsSimulator,
    random: &mut Random,
) -> Result<(BodyId, GeomId)> {
    let (width, height) = (random.between(5.0, 30.0), random.between(5.0, 30.0));
    let body = BodyFactory::create_rectangle_body_in(simulator, width, height, random.between(0.5, 5.0))?;
    simulator[body].set_position(Vector2::new(random.between(-150.0, 150.0), random.between(-100.0, 100.0)));
    let place = GeomPlacement::default();
    let geom = if random.toss() {
        GeomFactory::create_rectangle_geom_in(simulator, body, width, height, place)?
    } else {
        GeomFactory::create_circle_geom_in(simulator, body, width * 0.5, 8, place)?
    };
    simulator[geom].set_friction_coefficient(0.4);
    Ok((body, geom))
}
