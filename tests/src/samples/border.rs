//! The frame around every scene (behaviour chapter 16, section B.2).

use farseer_core::math::Vector2;
use farseer_core::{BodyFactory, BodyId, GeomFactory, GeomPlacement, Result};

use super::{CENTRE, Rgba, SCREEN, SampleScene, WHITE};

/// Thickness of the frame.
const THICKNESS: f32 = 38.0;
const GROUP: i32 = 100;
const FILL: Rgba = [200, 200, 200, 150];

/// Adds the frame; every scene does so last.
///
/// # Errors
/// None in an ordinary scene.
pub fn border(scene: &mut SampleScene) -> Result<BodyId> {
    let [width, height] = SCREEN;
    let simulator = &mut scene.simulator;
    let body = BodyFactory::create_rectangle_body_in(simulator, width, height, 1.0)?;
    simulator[body].set_is_static(true);
    simulator[body].set_position(CENTRE);

    let to_side = width / 2.0 - THICKNESS / 2.0;
    let placement = GeomPlacement { offset: Vector2::new(-to_side, 0.0), ..Default::default() };
    let left = GeomFactory::create_rectangle_geom_in(simulator, body, THICKNESS, height, placement)?;
    simulator[left].set_restitution_coefficient(0.0001);
    simulator[left].set_friction_coefficient(0.5);
    simulator[left].set_collision_group(GROUP);
    let offset = Vector2::new(to_side, 0.0);
    let right = GeomFactory::create_geom_from_with_offset_in(simulator, body, left, offset, 0.0)?;

    let to_edge = height / 2.0 - THICKNESS / 2.0;
    let placement =
        GeomPlacement { offset: Vector2::new(0.0, -to_edge), ..GeomPlacement::with_grid_size(20.0) };
    let top = GeomFactory::create_rectangle_geom_in(simulator, body, width, THICKNESS, placement)?;
    simulator[top].set_restitution_coefficient(0.2);
    simulator[top].set_friction_coefficient(0.2);
    simulator[top].set_collision_group(GROUP);
    let offset = Vector2::new(0.0, to_edge);
    let bottom = GeomFactory::create_geom_from_with_offset_in(simulator, body, top, offset, 0.0)?;

    for geom in [left, right, top, bottom] {
        scene.show(geom, FILL, WHITE);
    }
    Ok(body)
}
