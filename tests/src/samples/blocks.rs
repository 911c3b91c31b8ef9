//! Balls, crates, heaps of crates and the floors below them (behaviour chapter 16, section B.3).

use farseer_core::math::Vector2;
use farseer_core::{BodyFactory, BodyId, GeomFactory, GeomId, GeomPlacement, Result};

use super::{BLACK, Rgba, SampleScene, WHITE};

const YELLOW: Rgba = [255, 255, 0, 255];

/// Adds a small ball.
///
/// # Errors
/// A position that is not finite.
pub fn ball(scene: &mut SampleScene, position: Vector2) -> Result<(BodyId, GeomId)> {
    let simulator = &mut scene.simulator;
    let body = BodyFactory::create_circle_body_in(simulator, 12.0, 1.0)?;
    simulator[body].set_position(position);
    let placement = GeomPlacement::with_grid_size(0.5);
    let geom = GeomFactory::create_circle_geom_in(simulator, body, 12.0, 10, placement)?;
    simulator[geom].set_collision_group(1);
    scene.show(geom, YELLOW, BLACK);
    Ok((body, geom))
}

/// Adds a crate of mass 1 that may come to rest.
///
/// # Errors
/// A size that is not greater than 0.
pub fn crate_box(
    scene: &mut SampleScene,
    width: f32,
    height: f32,
    position: Vector2,
) -> Result<(BodyId, GeomId)> {
    let simulator = &mut scene.simulator;
    let body = BodyFactory::create_rectangle_body_in(simulator, width, height, 1.0)?;
    simulator[body].set_position(position);
    simulator[body].set_is_auto_idle(true);
    simulator[body].set_minimum_velocity(25.0);
    let placement = GeomPlacement::default();
    let geom = GeomFactory::create_rectangle_geom_in(simulator, body, width, height, placement)?;
    simulator[geom].set_friction_coefficient(1.0);
    scene.show(geom, WHITE, BLACK);
    Ok((body, geom))
}

/// Adds a rectangle that does not move.
///
/// # Errors
/// A size that is not greater than 0.
pub fn rectangle_platform(
    scene: &mut SampleScene,
    width: f32,
    height: f32,
    position: Vector2,
    collision_group: i32,
) -> Result<BodyId> {
    let simulator = &mut scene.simulator;
    let body = BodyFactory::create_rectangle_body_in(simulator, width, height, 1.0)?;
    simulator[body].set_is_static(true);
    simulator[body].set_position(position);
    let placement = GeomPlacement::default();
    let geom = GeomFactory::create_rectangle_geom_in(simulator, body, width, height, placement)?;
    simulator[geom].set_collision_group(collision_group);
    simulator[geom].set_friction_coefficient(1.0);
    scene.show(geom, WHITE, BLACK);
    Ok(body)
}

/// A heap of square blocks that fall onto each other.
#[derive(Debug, Clone, Copy)]
pub struct Pyramid {
    /// Edge of a block in px.
    pub edge: f32,
    /// Space between blocks in px, sideways and upward.
    pub spacing: f32,
    /// Mass of a block in kg.
    pub mass: f32,
    /// Friction coefficient of the blocks.
    pub friction: f32,
    /// Blocks in the bottom row, and number of rows.
    pub rows: usize,
    /// Position of the leftmost block of the bottom row.
    pub origin: Vector2,
}

/// Adds a heap; returns its blocks, bottom row first, each row from left to right.
///
/// # Errors
/// Sizes that are not greater than 0.
pub fn pyramid(scene: &mut SampleScene, pyramid: Pyramid) -> Result<Vec<(BodyId, GeomId)>> {
    let Pyramid { edge, spacing, mass, friction, rows, origin } = pyramid;
    let simulator = &mut scene.simulator;
    // The template of the blocks takes no part, but takes a geom number.
    let template = simulator.create_body(BodyFactory::create_rectangle_body(edge, edge, mass)?);
    let placement = GeomPlacement::default();
    let model = GeomFactory::create_rectangle_geom(simulator, template, edge, edge, placement)?;
    simulator[model].set_friction_coefficient(friction);
    simulator[model].set_restitution_coefficient(0.0);

    let to_row = Vector2::new(edge / 2.0 + spacing / 2.0, -(edge + spacing));
    let to_column = Vector2::new(spacing + edge, 0.0);
    let mut blocks = Vec::new();
    for row in 0..rows {
        let leftmost = origin + to_row * row as f32;
        for column in 0..rows - row {
            let body = BodyFactory::create_body_from_in(simulator, template)?;
            let geom = GeomFactory::create_geom_from_in(simulator, body, model)?;
            simulator[body].set_position(leftmost + to_column * column as f32);
            blocks.push((body, geom));
        }
    }
    blocks.iter().for_each(|&(_, geom)| scene.show(geom, WHITE, BLACK));
    Ok(blocks)
}
