//! Geoms.

use farseer_core::math::Vector2;
use farseer_core::{BodyId, CollisionCategory, GeomFactory, GeomId, GeomPlacement};

use crate::boundary::{exports, leave_numbers, points};
use crate::world::{Simulator, either};

fn placed(x: f32, y: f32, rotation_offset: f32, collision_grid_size: f32) -> GeomPlacement {
    GeomPlacement { offset: Vector2::new(x, y), rotation_offset, collision_grid_size }
}

exports! {
    /// A rectangle.
    fn geom_rectangle(
        simulator: Simulator, body: BodyId, width: f32, height: f32,
        offset_x: f32, offset_y: f32, rotation_offset: f32, collision_grid_size: f32,
    ) {
        let placement = placed(offset_x, offset_y, rotation_offset, collision_grid_size);
        simulator.objects(|objects| GeomFactory::create_rectangle_geom_in(objects, body, width, height, placement))
    }

    /// A circle; for the faithful set a polygon with this number of edges.
    fn geom_circle(
        simulator: Simulator, body: BodyId, radius: f32, number_of_edges: i32,
        offset_x: f32, offset_y: f32, rotation_offset: f32, collision_grid_size: f32,
    ) {
        let placement = placed(offset_x, offset_y, rotation_offset, collision_grid_size);
        simulator.objects(|objects| {
            GeomFactory::create_circle_geom_in(objects, body, radius, number_of_edges, placement)
        })
    }

    /// A capsule.
    fn geom_capsule(
        simulator: Simulator, body: BodyId, height: f32, end_radius: f32, edges: i32,
        offset_x: f32, offset_y: f32, rotation_offset: f32, collision_grid_size: f32,
    ) {
        let placement = placed(offset_x, offset_y, rotation_offset, collision_grid_size);
        simulator.objects(|objects| {
            GeomFactory::create_capsule_geom_in(objects, body, height, end_radius, edges, placement)
        })
    }

    /// The polygon whose corners were left as numbers, with its centroid at the offset.
    fn geom_polygon(
        simulator: Simulator, body: BodyId,
        offset_x: f32, offset_y: f32, rotation_offset: f32, collision_grid_size: f32,
    ) {
        let mut corners = points()?;
        let placement = placed(offset_x, offset_y, rotation_offset, collision_grid_size);
        simulator.objects(|objects| GeomFactory::create_polygon_geom_in(objects, body, &mut corners, placement))
    }

    /// The chain of edges whose points were left as numbers.
    fn geom_chain(
        simulator: Simulator, body: BodyId,
        offset_x: f32, offset_y: f32, rotation_offset: f32, collision_grid_size: f32,
    ) {
        let corners = points()?;
        let placement = placed(offset_x, offset_y, rotation_offset, collision_grid_size);
        simulator.objects(|objects| GeomFactory::create_chain_geom_in(objects, body, &corners, placement))
    }

    /// Ends its life with the next update.
    fn geom_dispose(simulator: Simulator, geom: GeomId) {
        simulator.doubt()?;
        either!(simulator, |engine| engine.dispose(geom)?)
    }

    /// Whether it was disposed.
    fn geom_is_disposed(simulator: Simulator, geom: GeomId) {
        simulator.with(|world| Ok(world.engine.core().is_disposed(geom)))
    }

    /// The body it is attached to.
    fn geom_body(simulator: Simulator, geom: GeomId) { simulator.geom(geom, |geom| geom.body()) }

    /// Leaves its corners in the world as numbers.
    fn geom_world_vertices(simulator: Simulator, geom: GeomId) {
        simulator.geom(geom, |geom| {
            leave_numbers(geom.world_vertices().iter().flat_map(|corner| [corner.x, corner.y]).map(f64::from))
        })
    }

    /// Its friction.
    fn geom_friction_coefficient(simulator: Simulator, geom: GeomId) {
        simulator.geom(geom, |geom| geom.friction_coefficient())
    }

    /// Sets its friction.
    fn geom_set_friction_coefficient(simulator: Simulator, geom: GeomId, friction_coefficient: f32) {
        simulator.edit_geom(geom, |geom| geom.set_friction_coefficient(friction_coefficient))
    }

    /// Its bounciness.
    fn geom_restitution_coefficient(simulator: Simulator, geom: GeomId) {
        simulator.geom(geom, |geom| geom.restitution_coefficient())
    }

    /// Sets its bounciness.
    fn geom_set_restitution_coefficient(simulator: Simulator, geom: GeomId, restitution_coefficient: f32) {
        simulator.edit_geom(geom, |geom| geom.set_restitution_coefficient(restitution_coefficient))
    }

    /// Its categories as bits.
    fn geom_collision_categories(simulator: Simulator, geom: GeomId) {
        simulator.geom(geom, |geom| geom.collision_categories().bits())
    }

    /// Sets its categories.
    fn geom_set_collision_categories(simulator: Simulator, geom: GeomId, collision_categories: CollisionCategory) {
        simulator.edit_geom(geom, |geom| geom.set_collision_categories(collision_categories))
    }

    /// The categories it collides with, as bits.
    fn geom_collides_with(simulator: Simulator, geom: GeomId) {
        simulator.geom(geom, |geom| geom.collides_with().bits())
    }

    /// Sets the categories it collides with.
    fn geom_set_collides_with(simulator: Simulator, geom: GeomId, collides_with: CollisionCategory) {
        simulator.edit_geom(geom, |geom| geom.set_collides_with(collides_with))
    }

    /// Its group.
    fn geom_collision_group(simulator: Simulator, geom: GeomId) {
        simulator.geom(geom, |geom| geom.collision_group())
    }

    /// Sets its group.
    fn geom_set_collision_group(simulator: Simulator, geom: GeomId, collision_group: i32) {
        simulator.edit_geom(geom, |geom| geom.set_collision_group(collision_group))
    }

    /// Whether new pairs with it are looked for.
    fn geom_collision_enabled(simulator: Simulator, geom: GeomId) {
        simulator.geom(geom, |geom| geom.collision_enabled())
    }

    /// Sets whether new pairs with it are looked for.
    fn geom_set_collision_enabled(simulator: Simulator, geom: GeomId, value: bool) {
        simulator.doubt()?;
        simulator.edit_geom(geom, |geom| geom.set_collision_enabled(value))
    }

    /// Whether it touches without pushing.
    fn geom_is_sensor(simulator: Simulator, geom: GeomId) { simulator.geom(geom, |geom| geom.is_sensor()) }

    /// Sets whether it touches without pushing.
    fn geom_set_is_sensor(simulator: Simulator, geom: GeomId, value: bool) {
        either!(simulator, |engine| engine.set_is_sensor(geom, value)?)
    }

    /// Two geoms no longer collide.
    fn geom_ignore_collision_with(simulator: Simulator, geom: GeomId, other: GeomId) {
        simulator.doubt()?;
        either!(simulator, |engine| engine.ignore_collision_with(geom, other)?)
    }

    /// Two geoms collide again.
    fn geom_restore_collision_with(simulator: Simulator, geom: GeomId, other: GeomId) {
        either!(simulator, |engine| engine.restore_collision_with(geom, other)?)
    }
}
