//! Properties of geoms.

use std::mem::MaybeUninit;

use farseer_core::math::Vector2;
use farseer_core::{BodyId, CollisionCategory, Geom, GeomId, GeomRef};

use crate::arguments::{FarseerVector2, Finite, flag};
use crate::failure::{Failure, FarseerStatus, Outcome};
use crate::geom_options::wanted;
use crate::guard::{FarseerSimulator, with, write};
use crate::ids::{FarseerBody, FarseerGeom, Id};

/// Writes a property of a geom. `argument`: name of the result.
fn look<T>(
    simulator: Option<&FarseerSimulator>,
    geom: FarseerGeom,
    argument: &'static str,
    result: Option<&mut MaybeUninit<T>>,
    property: impl FnOnce(GeomRef<'_>) -> T,
) -> FarseerStatus {
    write(simulator, argument, result, |world| {
        let geom = GeomId::from_number("geom", geom)?;
        world.simulator.geom(geom).map(property).ok_or_else(|| Failure::stale("geom"))
    })
}

/// Changes a geom.
fn edit(
    simulator: Option<&FarseerSimulator>,
    geom: FarseerGeom,
    change: impl FnOnce(&mut Geom) -> Outcome,
) -> FarseerStatus {
    with(simulator, |world| {
        let geom = GeomId::from_number("geom", geom)?;
        change(world.simulator.geom_mut(geom).ok_or_else(|| Failure::stale("geom"))?)
    })
}

/// Writes the friction coefficient. Default 0 for geoms of the factories.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_geom_friction_coefficient(
    simulator: Option<&FarseerSimulator>,
    geom: FarseerGeom,
    friction_coefficient: Option<&mut MaybeUninit<f32>>,
) -> FarseerStatus {
    look(simulator, geom, "friction_coefficient", friction_coefficient, |geom| geom.friction_coefficient())
}

/// Sets the friction coefficient. Default 0 for geoms of the factories.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_geom_set_friction_coefficient(
    simulator: Option<&FarseerSimulator>,
    geom: FarseerGeom,
    friction_coefficient: f32,
) -> FarseerStatus {
    edit(simulator, geom, |geom| {
        geom.set_friction_coefficient(friction_coefficient.finite("friction_coefficient")?);
        Ok(())
    })
}

/// Writes the restitution coefficient, 0 to 1. Default 0.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_geom_restitution_coefficient(
    simulator: Option<&FarseerSimulator>,
    geom: FarseerGeom,
    restitution_coefficient: Option<&mut MaybeUninit<f32>>,
) -> FarseerStatus {
    look(simulator, geom, "restitution_coefficient", restitution_coefficient, |geom| {
        geom.restitution_coefficient()
    })
}

/// Sets the restitution coefficient, 0 to 1. Default 0.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_geom_set_restitution_coefficient(
    simulator: Option<&FarseerSimulator>,
    geom: FarseerGeom,
    restitution_coefficient: f32,
) -> FarseerStatus {
    edit(simulator, geom, |geom| {
        geom.set_restitution_coefficient(restitution_coefficient.finite("restitution_coefficient")?);
        Ok(())
    })
}

/// Writes the categories of the geom, one bit each. Default 0x7fffffff, all.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_geom_collision_categories(
    simulator: Option<&FarseerSimulator>,
    geom: FarseerGeom,
    collision_categories: Option<&mut MaybeUninit<i32>>,
) -> FarseerStatus {
    look(simulator, geom, "collision_categories", collision_categories, |geom| {
        geom.collision_categories().bits()
    })
}

/// Sets the categories of the geom, one bit each. Default 0x7fffffff, all.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_geom_set_collision_categories(
    simulator: Option<&FarseerSimulator>,
    geom: FarseerGeom,
    collision_categories: i32,
) -> FarseerStatus {
    edit(simulator, geom, |geom| {
        geom.set_collision_categories(CollisionCategory::from_bits(collision_categories));
        Ok(())
    })
}

/// Writes the categories that the geom collides with, one bit each. Default 0x7fffffff, all.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_geom_collides_with(
    simulator: Option<&FarseerSimulator>,
    geom: FarseerGeom,
    collides_with: Option<&mut MaybeUninit<i32>>,
) -> FarseerStatus {
    look(simulator, geom, "collides_with", collides_with, |geom| geom.collides_with().bits())
}

/// Sets the categories that the geom collides with, one bit each. Default 0x7fffffff, all.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_geom_set_collides_with(
    simulator: Option<&FarseerSimulator>,
    geom: FarseerGeom,
    collides_with: i32,
) -> FarseerStatus {
    edit(simulator, geom, |geom| {
        geom.set_collides_with(CollisionCategory::from_bits(collides_with));
        Ok(())
    })
}

/// Writes the group: geoms of one group other than 0 do not collide.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_geom_collision_group(
    simulator: Option<&FarseerSimulator>,
    geom: FarseerGeom,
    collision_group: Option<&mut MaybeUninit<i32>>,
) -> FarseerStatus {
    look(simulator, geom, "collision_group", collision_group, |geom| geom.collision_group())
}

/// Sets the group: geoms of one group other than 0 do not collide.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_geom_set_collision_group(
    simulator: Option<&FarseerSimulator>,
    geom: FarseerGeom,
    collision_group: i32,
) -> FarseerStatus {
    edit(simulator, geom, |geom| {
        geom.set_collision_group(collision_group);
        Ok(())
    })
}

/// Writes whether the geom collides: 0 or 1. Default 1.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_geom_collision_enabled(
    simulator: Option<&FarseerSimulator>,
    geom: FarseerGeom,
    collision_enabled: Option<&mut MaybeUninit<i32>>,
) -> FarseerStatus {
    look(simulator, geom, "collision_enabled", collision_enabled, |geom| geom.collision_enabled().into())
}

/// Sets whether the geom collides: 0 or 1. Default 1.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_geom_set_collision_enabled(
    simulator: Option<&FarseerSimulator>,
    geom: FarseerGeom,
    collision_enabled: i32,
) -> FarseerStatus {
    edit(simulator, geom, |geom| {
        geom.set_collision_enabled(flag("collision_enabled", collision_enabled)?);
        Ok(())
    })
}

/// Writes whether contacts of the geom exert impulses: 0 or 1. Default 1.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_geom_collision_response_enabled(
    simulator: Option<&FarseerSimulator>,
    geom: FarseerGeom,
    collision_response_enabled: Option<&mut MaybeUninit<i32>>,
) -> FarseerStatus {
    look(simulator, geom, "collision_response_enabled", collision_response_enabled, |geom| {
        geom.collision_response_enabled().into()
    })
}

/// Sets whether contacts of the geom exert impulses: 0 or 1. Default 1.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_geom_set_collision_response_enabled(
    simulator: Option<&FarseerSimulator>,
    geom: FarseerGeom,
    collision_response_enabled: i32,
) -> FarseerStatus {
    edit(simulator, geom, |geom| {
        geom.set_collision_response_enabled(flag("collision_response_enabled", collision_response_enabled)?);
        Ok(())
    })
}

/// Writes a number of yours, which the engine never reads.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_geom_tag(
    simulator: Option<&FarseerSimulator>,
    geom: FarseerGeom,
    tag: Option<&mut MaybeUninit<u64>>,
) -> FarseerStatus {
    look(simulator, geom, "tag", tag, |geom| geom.tag())
}

/// Sets a number of yours, which the engine never reads.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_geom_set_tag(
    simulator: Option<&FarseerSimulator>,
    geom: FarseerGeom,
    tag: u64,
) -> FarseerStatus {
    edit(simulator, geom, |geom| {
        geom.set_tag(tag);
        Ok(())
    })
}

/// Makes a geom a sensor, which exerts no impulses, or an ordinary geom: 1 or 0.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_geom_set_sensor(
    simulator: Option<&FarseerSimulator>,
    geom: FarseerGeom,
    sensor: i32,
) -> FarseerStatus {
    with(simulator, |world| {
        let geom = GeomId::from_number("geom", geom)?;
        Ok(world.simulator.set_sensor(geom, flag("sensor", sensor)?)?)
    })
}

/// Sets which events the geom wants under the precise methods: a sum of FarseerWantedEvents.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_geom_set_wanted_events(
    simulator: Option<&FarseerSimulator>,
    geom: FarseerGeom,
    wanted_events: i32,
) -> FarseerStatus {
    edit(simulator, geom, |geom| {
        geom.set_wanted_events(wanted("wanted_events", wanted_events)?);
        Ok(())
    })
}

/// Makes a geom solid from one side alone, under the precise methods. `direction` points out of the solid side, in the body's frame;
/// (0, 0) makes it solid from all sides.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_geom_set_one_way(
    simulator: Option<&FarseerSimulator>,
    geom: FarseerGeom,
    direction: FarseerVector2,
) -> FarseerStatus {
    with(simulator, |world| {
        let (geom, direction) = (GeomId::from_number("geom", geom)?, direction.finite("direction")?);
        let direction = Some(direction).filter(|direction| *direction != Vector2::zeros());
        Ok(world.simulator.set_one_way(geom, direction)?)
    })
}

/// Lets two geoms pass through each other, until farseer_geom_restore_collision_with.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_geom_ignore_collision_with(
    simulator: Option<&FarseerSimulator>,
    geom: FarseerGeom,
    other: FarseerGeom,
) -> FarseerStatus {
    with(simulator, |world| {
        let (geom, other) = (GeomId::from_number("geom", geom)?, GeomId::from_number("other", other)?);
        Ok(world.simulator.ignore_collision_with(geom, other)?)
    })
}

/// Ends farseer_geom_ignore_collision_with.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_geom_restore_collision_with(
    simulator: Option<&FarseerSimulator>,
    geom: FarseerGeom,
    other: FarseerGeom,
) -> FarseerStatus {
    with(simulator, |world| {
        let (geom, other) = (GeomId::from_number("geom", geom)?, GeomId::from_number("other", other)?);
        Ok(world.simulator.restore_collision_with(geom, other)?)
    })
}

/// Writes the body of a geom.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_geom_body(
    simulator: Option<&FarseerSimulator>,
    geom: FarseerGeom,
    body: Option<&mut MaybeUninit<FarseerBody>>,
) -> FarseerStatus {
    write(simulator, "body", body, |world| {
        let geom = GeomId::from_number("geom", geom)?;
        let body: Option<BodyId> = world.simulator.body_of(geom);
        body.ok_or_else(|| Failure::stale("geom"))?.to_number()
    })
}
