//! Queries with a filter: rays, shape casts, overlaps, points and nearest points, with the true shapes of geoms. Ours.
//!
//! The candidates come from the hash grid of the precise set, or are all geoms with the faithful one. Each is tested by its
//! convex pieces, in double precision.

mod cast;
mod convex;
mod explosion;
mod filter;
mod mover;
mod ray;
mod world_shape;

use crate::builders::GeomBuilder;
use crate::geom::GeomId;
use crate::math::Vector2;
use crate::objects::{Objects, RayCastHit};
use crate::shape::Aabb;
use crate::simulator::PhysicsSimulator;
use crate::simulator::candidates::{Candidate, First, Segment, fraction_key, in_order};
use crate::{Error, Result};
use convex::{Convex, Placement};

pub use explosion::Explosion;
pub use filter::QueryFilter;
pub use mover::{CharacterMover, MoverInput, MoverOptions, MoverReport, MoverState, MoverTouch};

/// The point of a geom that is nearest to a point: see [`PhysicsSimulator::nearest_point`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearestPoint {
    /// The geom.
    pub geom: GeomId,
    /// The nearest point of the geom, in the world; the given point if that is inside.
    pub point: Vector2,
    /// Unit vector from the geom to the given point; zero if that is inside.
    pub normal: Vector2,
    /// Distance in length units, 0 or more.
    pub distance: f32,
}

/// Queries with a filter. They find geoms by their true shapes: circles and capsules are round, not polygons. Geoms of bodies
/// that were edited since the last update are found at their new places; geoms that were added since then are not found.
///
/// Positions and motions are in the world, in length units, y down.
impl PhysicsSimulator {
    /// The first geom that a ray from `start` to `end` enters; of several at the same distance, the first in list order.
    /// A geom is found from the first update after it was added on.
    ///
    /// A geom that contains the start is hit only where the ray enters it again. Chains are hit from their free side. A ray that
    /// ends where it starts hits no geom.
    ///
    /// ```
    /// use farseer_core::{BodyBuilder, GeomBuilder, PhysicsSimulator, QueryFilter};
    /// let mut simulator = PhysicsSimulator::precise([0.0, 300.0])?;
    /// let (hero, _) = simulator.add_body(BodyBuilder::dynamic(), [GeomBuilder::circle(10.0)])?;
    /// let (_, [wall]) = simulator.add_body(BodyBuilder::fixed().position([100.0, 0.0]), [GeomBuilder::circle(20.0)])?;
    /// simulator.update(1.0 / 60.0);
    /// let filter = QueryFilter { exclude_body: Some(hero), ..QueryFilter::default() };
    /// let hit = simulator.cast_ray([-50.0, 0.0], [150.0, 0.0], &filter)?.unwrap();
    /// assert_eq!((hit.geom, hit.point.x, hit.normal.x), (wall, 80.0, -1.0));
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// A point that is not finite.
    pub fn cast_ray(
        &self,
        start: impl Into<Vector2>,
        end: impl Into<Vector2>,
        filter: &QueryFilter<'_>,
    ) -> Result<Option<RayCastHit>> {
        let ray = ray::Ray::new(start.into(), end.into())?;
        let mut first = First::new();
        self.for_each_admitted_along(&ray.segment(), filter, |list_key, geom| {
            if let Some((fraction, hit)) = ray.hit(self, geom) {
                first.offer(list_key, fraction, hit);
            }
            first.number()
        });
        Ok(first.into_item())
    }

    /// All geoms that a ray from `start` to `end` enters, each at its first entry, by distance: see [`cast_ray`](Self::cast_ray).
    ///
    /// # Errors
    /// A point that is not finite.
    pub fn cast_ray_all(
        &self,
        start: impl Into<Vector2>,
        end: impl Into<Vector2>,
        filter: &QueryFilter<'_>,
    ) -> Result<Vec<RayCastHit>> {
        let ray = ray::Ray::new(start.into(), end.into())?;
        let mut hits = Vec::new();
        self.for_each_admitted_along(&ray.segment(), filter, |list_key, geom| {
            let hit = ray.hit(self, geom);
            hits.extend(hit.map(|(fraction, hit)| (fraction_key(fraction), list_key, hit)));
            1.0
        });
        Ok(in_order(hits))
    }

    /// Any geom between two points, the first that is found: the cheapest test of a line of sight.
    ///
    /// # Errors
    /// A point that is not finite.
    pub fn cast_ray_any(
        &self,
        start: impl Into<Vector2>,
        end: impl Into<Vector2>,
        filter: &QueryFilter<'_>,
    ) -> Result<Option<RayCastHit>> {
        let ray = ray::Ray::new(start.into(), end.into())?;
        let mut found = None;
        self.for_each_admitted_along(&ray.segment(), filter, |_, geom| {
            found = found.or_else(|| ray.hit(self, geom).map(|(_, hit)| hit));
            // A negative fraction ends the search.
            if found.is_some() { -1.0 } else { 1.0 }
        });
        Ok(found)
    }

    /// The first geom that a shape touches on its straight way from a position by a motion. The point of the hit is on the geom,
    /// the normal points from the geom to the shape, and the shape touches at `position + fraction * motion`.
    ///
    /// `shape` is any shape of a [`GeomBuilder`], with its offset and rotation offset; other properties have no effect.
    /// `rotation` is that of the shape, in radians. A geom that the shape touches or overlaps at the start is hit at fraction 0
    /// if the motion leads further into it. A shape that slides along a face or leaves it hits nothing, nor does one without motion:
    /// [`overlap_shape`](Self::overlap_shape) finds overlaps.
    ///
    /// ```
    /// use farseer_core::{BodyBuilder, GeomBuilder, PhysicsSimulator, QueryFilter};
    /// let mut simulator = PhysicsSimulator::precise([0.0, 300.0])?;
    /// simulator.add_body(BodyBuilder::fixed().position([0.0, 100.0]), [GeomBuilder::rectangle(200.0, 20.0)])?;
    /// simulator.update(1.0 / 60.0);
    /// let hero = GeomBuilder::capsule(40.0, 10.0);
    /// let hit = simulator.cast_shape(&hero, [0.0, 0.0], 0.0, [0.0, 200.0], &QueryFilter::default())?.unwrap();
    /// // The soles are 20 below the middle, the floor is at 90.
    /// assert!((hit.fraction * 200.0 - 70.0).abs() < 0.001);
    /// assert_eq!(hit.normal.y, -1.0);
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// A shape that is not possible; a position, rotation or motion that is not finite.
    pub fn cast_shape(
        &self,
        shape: &GeomBuilder,
        position: impl Into<Vector2>,
        rotation: f32,
        motion: impl Into<Vector2>,
        filter: &QueryFilter<'_>,
    ) -> Result<Option<RayCastHit>> {
        let pieces = placed(shape, position.into(), rotation)?;
        let cast = cast::Cast::new(&pieces, motion.into())?;
        let mut first = First::new();
        self.for_each_admitted_along(&cast.segment(), filter, |list_key, geom| {
            if let Some((fraction, hit)) = cast.hit(self, geom, first.number()) {
                first.offer(list_key, fraction, hit);
            }
            first.number()
        });
        Ok(first.into_item())
    }

    /// All geoms that a shape touches on its way, by distance: see [`cast_shape`](Self::cast_shape).
    ///
    /// # Errors
    /// As [`cast_shape`](Self::cast_shape).
    pub fn cast_shape_all(
        &self,
        shape: &GeomBuilder,
        position: impl Into<Vector2>,
        rotation: f32,
        motion: impl Into<Vector2>,
        filter: &QueryFilter<'_>,
    ) -> Result<Vec<RayCastHit>> {
        let pieces = placed(shape, position.into(), rotation)?;
        let cast = cast::Cast::new(&pieces, motion.into())?;
        let mut hits = Vec::new();
        self.for_each_admitted_along(&cast.segment(), filter, |list_key, geom| {
            let hit = cast.hit(self, geom, 1.0);
            hits.extend(hit.map(|(fraction, hit)| (fraction_key(fraction), list_key, hit)));
            1.0
        });
        Ok(in_order(hits))
    }

    /// The geoms that a shape touches or overlaps, in list order. `shape` as in [`cast_shape`](Self::cast_shape). Chains have no
    /// inside: a shape overlaps their edges alone.
    ///
    /// # Errors
    /// A shape that is not possible; a position or rotation that is not finite.
    pub fn overlap_shape(
        &self,
        shape: &GeomBuilder,
        position: impl Into<Vector2>,
        rotation: f32,
        filter: &QueryFilter<'_>,
    ) -> Result<Vec<GeomId>> {
        let pieces = placed(shape, position.into(), rotation)?;
        Ok(self.admitted(&convex::aabb_of(&pieces), filter, |geom| world_shape::touches(self, geom, &pieces)))
    }

    /// Any geom that a shape touches or overlaps: whether there is room for it.
    ///
    /// # Errors
    /// As [`overlap_shape`](Self::overlap_shape).
    pub fn overlap_any(
        &self,
        shape: &GeomBuilder,
        position: impl Into<Vector2>,
        rotation: f32,
        filter: &QueryFilter<'_>,
    ) -> Result<Option<GeomId>> {
        let pieces = placed(shape, position.into(), rotation)?;
        let mut found = None;
        self.for_each_admitted_near(&convex::aabb_of(&pieces), filter, |_, geom| {
            if found.is_none() && world_shape::touches(self, geom, &pieces) {
                found = Some(geom);
            }
        });
        Ok(found)
    }

    /// The geoms that contain a point, in list order. Chains contain none.
    ///
    /// # Errors
    /// A point that is not finite.
    pub fn geoms_at(&self, point: impl Into<Vector2>, filter: &QueryFilter<'_>) -> Result<Vec<GeomId>> {
        let point = [Convex::point(finite("point", point.into())?)];
        let contains = |geom: GeomId| {
            let is_chain = self.geom(geom).is_some_and(|geom| geom.outline().is_chain());
            !is_chain && world_shape::touches(self, geom, &point)
        };
        Ok(self.admitted(&convex::aabb_of(&point), filter, contains))
    }

    /// The nearest geom within a distance of a point, with its nearest point; of several at the same distance, the first in list
    /// order. A geom that contains the point has the distance 0.
    ///
    /// # Errors
    /// A point or distance that is not finite; a distance less than 0.
    pub fn nearest_point(
        &self,
        point: impl Into<Vector2>,
        max_distance: f32,
        filter: &QueryFilter<'_>,
    ) -> Result<Option<NearestPoint>> {
        let point = finite("point", point.into())?;
        let reach = crate::math::finite::zero_or_more("max_distance", max_distance)?;
        let around = Aabb::new(point - Vector2::new(reach, reach), point + Vector2::new(reach, reach));
        let from_point = Convex::point(point);
        let mut first = First::new();
        self.for_each_admitted_near(&around, filter, |list_key, geom| {
            let closest = world_shape::nearest(self, geom, &from_point);
            if let Some(closest) = closest.filter(|closest| closest.distance <= f64::from(reach)) {
                first.offer(list_key, closest.distance, (geom, closest));
            }
        });
        Ok(first.into_item().map(|(geom, closest)| {
            let distance = closest.distance;
            let is_outside = distance > 0.0;
            NearestPoint {
                geom,
                point: if is_outside { convex::vector(closest.point_b) } else { point },
                normal: if is_outside {
                    convex::vector(closest.normal.map(|part| -part))
                } else {
                    Vector2::zeros()
                },
                distance: distance.max(0.0) as f32,
            }
        }))
    }

    /// The geoms near a box that a filter admits and for which `is_found` is true, in list order.
    pub(super) fn admitted(
        &self,
        aabb: &Aabb,
        filter: &QueryFilter<'_>,
        is_found: impl Fn(GeomId) -> bool,
    ) -> Vec<GeomId> {
        let mut found = Vec::new();
        self.for_each_admitted_near(aabb, filter, |list_key, geom| {
            if is_found(geom) {
                found.push((0, list_key, geom));
            }
        });
        in_order(found)
    }

    /// Calls `visit` with the list keys and ids of the geoms near a box that a filter admits: in no particular order, and perhaps
    /// twice with one of them.
    fn for_each_admitted_near(
        &self,
        aabb: &Aabb,
        filter: &QueryFilter<'_>,
        mut visit: impl FnMut(u32, GeomId),
    ) {
        self.for_each_near(aabb, |Candidate { list_key, geom, .. }| {
            if filter.admits(self, geom) && world_shape::may_reach(self, geom, aabb) {
                visit(list_key, geom);
            }
        });
    }

    /// Calls `visit` with the list keys and ids of the geoms along a path that a filter admits, as
    /// [`for_each_admitted_near`](Self::for_each_admitted_near) does. `visit` returns the fraction of the path beyond which geoms
    /// are of no interest; the last one holds for the next call.
    fn for_each_admitted_along(
        &self,
        segment: &Segment,
        filter: &QueryFilter<'_>,
        mut visit: impl FnMut(u32, GeomId) -> f64,
    ) {
        let mut max_fraction = 1.0;
        self.for_each_along(segment, |Candidate { list_key, geom, .. }| {
            if filter.admits(self, geom) {
                max_fraction = visit(list_key, geom);
            }
            max_fraction
        });
    }
}

/// Returns the convex pieces of a shape at a place in the world.
fn placed(shape: &GeomBuilder, position: Vector2, rotation: f32) -> Result<Vec<Convex>> {
    let position = finite("position", position)?;
    crate::math::finite::finite("rotation", rotation)?;
    let shape_at = Placement::new(shape.offset_and_rotation()?);
    let placement = Placement::new((position, rotation));
    Ok(shape
        .pieces()?
        .iter()
        .map(|piece| Convex::of_piece(piece, |p| placement.apply(shape_at.apply(p))))
        .collect())
}

fn finite(argument: &'static str, point: Vector2) -> Result<Vector2> {
    match point.x.is_finite() && point.y.is_finite() {
        true => Ok(point),
        false => Err(Error::invalid(argument, (point.x, point.y), "finite")),
    }
}

/// Whether an object of the simulator has this geom, and it is not disposed.
fn exists(objects: &Objects, geom: GeomId) -> bool {
    !objects.is_disposed(geom)
}
