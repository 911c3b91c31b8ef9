//! Queries of rays, points and boxes.

use std::mem::MaybeUninit;

use farseer_core::{Aabb, BodyId, CollisionCategory, GeomId, QueryFilter, RayCastHit};

use crate::arguments::{FarseerVector2, Finite, flag};
use crate::arrays::{self, write_list};
use crate::failure::{Failure, FarseerStatus, Outcome};
use crate::guard::{FarseerSimulator, answer, with};
use crate::ids::{FarseerBody, FarseerGeom, Id};

/// Which geoms a query finds. Start from farseer_query_filter_default.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FarseerQueryFilter {
    /// Bit mask: geoms of at least one of these categories are found.
    pub categories: i32,
    /// Bit mask: categories of the query itself, with which a geom has to collide.
    pub as_categories: i32,
    /// Flag: whether geoms of static bodies are found.
    pub static_bodies: i32,
    /// Flag: whether geoms of kinematic bodies are found.
    pub kinematic_bodies: i32,
    /// Flag: whether geoms of dynamic bodies are found.
    pub dynamic_bodies: i32,
    /// Flag: whether sensors are found.
    pub sensors: i32,
    /// Id of a body that is not found; 0 for none.
    pub exclude_body: FarseerBody,
    /// Id of a geom that is not found; 0 for none.
    pub exclude_geom: FarseerGeom,
}

impl Default for FarseerQueryFilter {
    fn default() -> Self {
        FarseerQueryFilter {
            categories: CollisionCategory::ALL.bits(),
            as_categories: CollisionCategory::ALL.bits(),
            static_bodies: 1,
            kinematic_bodies: 1,
            dynamic_bodies: 1,
            sensors: 0,
            exclude_body: 0,
            exclude_geom: 0,
        }
    }
}

/// Reads an id that may be 0 for none.
fn maybe<I: Id>(argument: &str, number: u64) -> Outcome<Option<I>> {
    if number == 0 { Ok(None) } else { I::from_number(argument, number).map(Some) }
}

/// Reads a filter; null is the default.
fn read(filter: Option<&FarseerQueryFilter>) -> Outcome<QueryFilter<'static>> {
    let filter = filter.copied().unwrap_or_default();
    Ok(QueryFilter {
        categories: CollisionCategory::from_bits(filter.categories),
        as_categories: CollisionCategory::from_bits(filter.as_categories),
        fixed: flag("filter.static_bodies", filter.static_bodies)?,
        kinematic: flag("filter.kinematic_bodies", filter.kinematic_bodies)?,
        dynamic: flag("filter.dynamic_bodies", filter.dynamic_bodies)?,
        sensors: flag("filter.sensors", filter.sensors)?,
        exclude_body: maybe::<BodyId>("filter.exclude_body", filter.exclude_body)?,
        exclude_geom: maybe::<GeomId>("filter.exclude_geom", filter.exclude_geom)?,
        accepts: None,
    })
}

/// The point at which a ray enters a geom.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FarseerRayHit {
    /// Id of the geom.
    pub geom: FarseerGeom,
    /// The point in the world, in length units.
    pub point: FarseerVector2,
    /// Outward unit normal at the point.
    pub normal: FarseerVector2,
    /// Fraction of the distance from start to end, 0 to 1.
    pub fraction: f32,
}

impl FarseerRayHit {
    fn of(hit: &RayCastHit) -> Outcome<Self> {
        Ok(FarseerRayHit {
            geom: hit.geom.to_number()?,
            point: hit.point.into(),
            normal: hit.normal.into(),
            fraction: hit.fraction,
        })
    }
}

/// Writes the first geom that a ray between two points enters, in length units, and whether there is one: 0 or 1. Without one, the hit
/// is zero. `filter` may be null.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_simulator_cast_ray(
    simulator: Option<&FarseerSimulator>,
    start: FarseerVector2,
    end: FarseerVector2,
    filter: Option<&FarseerQueryFilter>,
    hit: Option<&mut MaybeUninit<FarseerRayHit>>,
    found: Option<&mut MaybeUninit<i32>>,
) -> FarseerStatus {
    with(simulator, |world| {
        let hit = hit.ok_or_else(|| Failure::null("hit"))?;
        let found = found.ok_or_else(|| Failure::null("found"))?;
        let (start, end) = (start.finite("start")?, end.finite("end")?);
        let first = world.simulator.cast_ray(start, end, &read(filter)?)?;
        hit.write(first.as_ref().map(FarseerRayHit::of).transpose()?.unwrap_or_default());
        found.write(first.is_some().into());
        Ok(())
    })
}

/// Writes all geoms that a ray between two points enters, by distance, and their number. `filter` may be null.
///
/// # Safety
/// An array that is not null has the items that its number says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn farseer_simulator_cast_ray_all(
    simulator: Option<&FarseerSimulator>,
    start: FarseerVector2,
    end: FarseerVector2,
    filter: Option<&FarseerQueryFilter>,
    hits: *mut FarseerRayHit,
    capacity: usize,
    count: Option<&mut MaybeUninit<usize>>,
) -> FarseerStatus {
    // SAFETY: the caller answers for the array.
    let room = unsafe { arrays::room("hits", hits, capacity) };
    write_list(simulator, room, count, |world| {
        let (start, end) = (start.finite("start")?, end.finite("end")?);
        let hits = world.simulator.cast_ray_all(start, end, &read(filter)?)?;
        hits.iter().map(FarseerRayHit::of).collect()
    })
}

/// Writes the geoms that contain a point, and their number. `filter` may be null.
///
/// # Safety
/// An array that is not null has the items that its number says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn farseer_simulator_geoms_at(
    simulator: Option<&FarseerSimulator>,
    point: FarseerVector2,
    filter: Option<&FarseerQueryFilter>,
    geoms: *mut FarseerGeom,
    capacity: usize,
    count: Option<&mut MaybeUninit<usize>>,
) -> FarseerStatus {
    // SAFETY: the caller answers for the array.
    let room = unsafe { arrays::room("geoms", geoms, capacity) };
    write_list(simulator, room, count, |world| {
        let found = world.simulator.geoms_at(point.finite("point")?, &read(filter)?)?;
        found.iter().map(|geom| geom.to_number()).collect()
    })
}

/// Writes the geoms whose boxes overlap the box from `min` to `max`, in length units, and their number.
///
/// # Safety
/// An array that is not null has the items that its number says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn farseer_simulator_geoms_in_box(
    simulator: Option<&FarseerSimulator>,
    min: FarseerVector2,
    max: FarseerVector2,
    geoms: *mut FarseerGeom,
    capacity: usize,
    count: Option<&mut MaybeUninit<usize>>,
) -> FarseerStatus {
    // SAFETY: the caller answers for the array.
    let room = unsafe { arrays::room("geoms", geoms, capacity) };
    write_list(simulator, room, count, |world| {
        let found = world.simulator.query_aabb(&Aabb::new(min.finite("min")?, max.finite("max")?));
        found.iter().map(|geom| geom.to_number()).collect()
    })
}

/// Writes the filter that finds all geoms but sensors.
#[unsafe(no_mangle)]
pub extern "C" fn farseer_query_filter_default(
    filter: Option<&mut MaybeUninit<FarseerQueryFilter>>,
) -> FarseerStatus {
    answer(|| {
        filter.ok_or_else(|| Failure::null("filter"))?.write(FarseerQueryFilter::default());
        Ok(())
    })
}
