//! Queries of points, boxes and rays.

use farseer_core::Aabb;
use farseer_core::math::Vector2;
use farseer_core::{CollisionCategory, GeomId};

use crate::boundary::{Answer, Outcome, exports, leave_numbers};
use crate::world::{Engine, Simulator};

fn leave_geoms(geoms: Vec<GeomId>) -> Outcome<f64> {
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

    /// The geoms that a geom touched in the last update.
    fn query_overlaps(simulator: Simulator, geom: GeomId) {
        simulator.with(|world| leave_geoms(match &world.engine {
            Engine::Plane(simulator) => simulator.overlaps(geom),
            #[cfg(feature = "depth")]
            Engine::Depth(depth) => depth.simulator.overlaps_of(geom, |_| true),
        }))
    }
}
