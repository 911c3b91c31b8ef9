//! Queries of points, boxes and rays.

use farseer_core::Aabb;
use farseer_core::math::Vector2;
use farseer_core::{CollisionCategory, GeomId, RayCastHit};

use crate::boundary::{Answer, Outcome, exports, leave_numbers};
use crate::fields::Fields;
use crate::world::{Engine, Simulator};

/// Leaves hits in rows of six: geom, point, normal, fraction.
fn leave_hits(hits: impl IntoIterator<Item = RayCastHit>) -> Outcome<f64> {
    let mut numbers = Vec::new();
    for hit in hits {
        numbers.push(hit.geom.number()?);
        numbers.extend([hit.point.x, hit.point.y, hit.normal.x, hit.normal.y, hit.fraction].map(f64::from));
    }
    Ok(leave_numbers(numbers))
}

fn leave_geoms(geoms: impl IntoIterator<Item = GeomId>) -> Outcome<f64> {
    let numbers: Vec<f64> = geoms.into_iter().map(Answer::number).collect::<Outcome<_>>()?;
    Ok(leave_numbers(numbers))
}

exports! {
    /// The geoms at a point: of the plane, or in 2.5D of the screen.
    fn query_collide_all(simulator: Simulator, x: f32, y: f32) {
        let point = Vector2::new(x, y);
        simulator.with(|world| leave_geoms(match &world.engine {
            Engine::Plane(simulator) => simulator.collide_all(point),
            #[cfg(feature = "depth")]
            Engine::Depth(depth) => depth.simulator.collide_all(point),
        }))
    }

    /// The geoms in a box of the plane.
    fn query_aabb(simulator: Simulator, min_x: f32, min_y: f32, max_x: f32, max_y: f32) {
        let aabb = Aabb::new(Vector2::new(min_x, min_y), Vector2::new(max_x, max_y));
        simulator.plane(|plane| leave_geoms(plane.query_aabb(&aabb)))
    }

    /// Leaves the first hit of a ray among the geoms of these categories: geom, point, normal and fraction; no numbers if there
    /// is none.
    fn query_ray_cast(
        simulator: Simulator, start_x: f32, start_y: f32, end_x: f32, end_y: f32, categories: CollisionCategory,
    ) {
        let (start, end) = (Vector2::new(start_x, start_y), Vector2::new(end_x, end_y));
        simulator.plane(|plane| {
            let is_wanted = |geom| {
                plane.geom(geom).is_some_and(|geom| geom.collision_categories().intersects(categories))
            };
            let hit = if categories == CollisionCategory::ALL {
                plane.ray_cast(start, end)
            } else {
                plane.ray_cast_all(start, end).into_iter().find(|hit| is_wanted(hit.geom))
            };
            let Some(hit) = hit else { return Ok(leave_numbers([])) };
            let [x, y, normal_x, normal_y] = [hit.point.x, hit.point.y, hit.normal.x, hit.normal.y].map(f64::from);
            Ok(leave_numbers([hit.geom.number()?, x, y, normal_x, normal_y, f64::from(hit.fraction)]))
        })
    }

    /// Casts the ray whose start, end and filter were left as numbers. Leaves hits in rows of six: the first, or with `mode` 1
    /// all, or with 2 any.
    fn query_cast_ray(simulator: Simulator, mode: usize) {
        let mut fields = Fields::left();
        let (start, end, filter) = (fields.point("start")?, fields.point("end")?, fields.filter()?);
        simulator.plane(|plane| match mode {
            0 => leave_hits(plane.cast_ray(start, end, &filter)?),
            1 => leave_hits(plane.cast_ray_all(start, end, &filter)?),
            _ => leave_hits(plane.cast_ray_any(start, end, &filter)?),
        })
    }

    /// Casts the shape whose position, rotation, motion, filter and outline were left as numbers. Leaves hits as
    /// `query_cast_ray`: the first or, with `mode` 1, all.
    fn query_cast_shape(simulator: Simulator, mode: usize) {
        let mut fields = Fields::left();
        let (position, rotation) = (fields.point("position")?, fields.get("rotation")?);
        let (motion, filter, shape) = (fields.point("motion")?, fields.filter()?, fields.geom()?);
        simulator.plane(|plane| match mode {
            0 => leave_hits(plane.cast_shape(&shape, position, rotation, motion, &filter)?),
            _ => leave_hits(plane.cast_shape_all(&shape, position, rotation, motion, &filter)?),
        })
    }

    /// Leaves the geoms that a shape overlaps: all or, with `mode` 1, any.
    fn query_overlap_shape(simulator: Simulator, mode: usize) {
        let mut fields = Fields::left();
        let (position, rotation) = (fields.point("position")?, fields.get("rotation")?);
        let (filter, shape) = (fields.filter()?, fields.geom()?);
        simulator.plane(|plane| match mode {
            0 => leave_geoms(plane.overlap_shape(&shape, position, rotation, &filter)?),
            _ => leave_geoms(plane.overlap_any(&shape, position, rotation, &filter)?),
        })
    }

    /// Leaves the geoms that contain a point.
    fn query_geoms_at(simulator: Simulator) {
        let mut fields = Fields::left();
        let (point, filter) = (fields.point("point")?, fields.filter()?);
        simulator.plane(|plane| leave_geoms(plane.geoms_at(point, &filter)?))
    }

    /// Leaves the nearest geom within a distance, with its nearest point, normal and distance; no numbers if there is none.
    fn query_nearest_point(simulator: Simulator) {
        let mut fields = Fields::left();
        let (point, distance, filter) = (fields.point("point")?, fields.get("maxDistance")?, fields.filter()?);
        simulator.plane(|plane| {
            let Some(nearest) = plane.nearest_point(point, distance, &filter)? else { return Ok(leave_numbers([])) };
            let (point, normal) = (nearest.point, nearest.normal);
            let [x, y, normal_x, normal_y] = [point.x, point.y, normal.x, normal.y].map(f64::from);
            Ok(leave_numbers([nearest.geom.number()?, x, y, normal_x, normal_y, f64::from(nearest.distance)]))
        })
    }

    /// The geoms that a geom touched in the last update.
    fn query_overlaps(simulator: Simulator, geom: GeomId) {
        simulator.with(|world| leave_geoms(match &world.engine {
            Engine::Plane(simulator) => simulator.overlaps(geom),
            #[cfg(feature = "depth")]
            Engine::Depth(depth) => depth.simulator.overlaps_of(geom, |_| true),
        }))
    }
}
