//! Crates that fall asleep, and a polygon from a picture (behaviour chapter 16, section C.2, demos 2 and 3).

use farseer_core::math::Vector2;
use farseer_core::{BodyFactory, GeomFactory, GeomPlacement, InactivityController, Result};

use super::{BLACK, Drive, GOLD, SampleScene, WHITE, border, crate_box, map_outline};

/// Advanced 2: a controller disables crates that lie still.
pub(super) fn inactivity_controller() -> Result<SampleScene> {
    let mut scene = SampleScene::new(150.0)?;
    let mut controller = InactivityController::new();
    controller.set_activation_distance(120.0)?;
    controller.set_max_idle_time(2000.0)?;
    let controller = scene.simulator.create_controller(controller)?;
    scene.simulator.add(controller)?;
    for row in 1..=5 {
        for column in 1..=13 {
            let place = Vector2::new(300.0 + 28.0 * column as f32, 300.0 + 28.0 * row as f32);
            crate_box(&mut scene, 25.0, 25.0, place)?;
        }
    }
    border(&mut scene)?;
    Ok(scene)
}

/// Advanced 3: a polygon with the outline of a picture is pushed against a ball.
pub(super) fn map_vertices_from_textures() -> Result<SampleScene> {
    let mut scene = SampleScene::new(0.0)?;
    let simulator = &mut scene.simulator;
    let mut outline = map_outline();
    let map = BodyFactory::create_polygon_body_in(simulator, &outline, 5.0)?;
    simulator[map].set_position(Vector2::new(500.0, 400.0));
    let placement = GeomPlacement::default();
    let map_geom = GeomFactory::create_polygon_geom_in(simulator, map, &mut outline, placement)?;
    let ball = BodyFactory::create_circle_body_in(simulator, 35.0, 1.0)?;
    simulator[ball].set_position(Vector2::new(300.0, 400.0));
    let ball_geom = GeomFactory::create_circle_geom_in(simulator, ball, 35.0, 20, placement)?;
    scene.show(map_geom, WHITE, BLACK);
    scene.show(ball_geom, GOLD, BLACK);
    scene.act(Drive::along_x(map, -50.0));
    border(&mut scene)?;
    Ok(scene)
}
