//! A ball and a box (behaviour chapter 16, sections C.1, demo 2, and C.2, demo 8).

use farseer_core::math::Vector2;
use farseer_core::{BodyFactory, BodyId, GeomFactory, GeomPlacement, Result};

use super::{BLACK, Drive, GOLD, SampleScene, WHITE, border};

/// Simple 2: the box is pushed against the ball.
pub(super) fn two_bodies_with_geom() -> Result<SampleScene> {
    let (mut scene, rectangle) = ball_and_box()?;
    scene.act(Drive::along_x(rectangle, 50.0));
    Ok(scene)
}

/// Advanced 8: the same at rest, for lines that cross it.
pub(super) fn line_intersections() -> Result<SampleScene> {
    Ok(ball_and_box()?.0)
}

fn ball_and_box() -> Result<(SampleScene, BodyId)> {
    let mut scene = SampleScene::new(0.0)?;
    let simulator = &mut scene.simulator;
    let circle = BodyFactory::create_circle_body_in(simulator, 64.0, 1.0)?;
    simulator[circle].set_position(Vector2::new(725.0, 384.0));
    let round = GeomFactory::create_circle_geom_in(simulator, circle, 64.0, 20, GeomPlacement::default())?;
    let rectangle = BodyFactory::create_rectangle_body_in(simulator, 128.0, 128.0, 1.0)?;
    simulator[rectangle].set_position(Vector2::new(256.0, 384.0));
    let placement = GeomPlacement::default();
    let square = GeomFactory::create_rectangle_geom_in(simulator, rectangle, 128.0, 128.0, placement)?;
    scene.show(round, WHITE, BLACK);
    scene.show(square, GOLD, BLACK);
    border(&mut scene)?;
    Ok((scene, rectangle))
}
