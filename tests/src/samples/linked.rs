//! Welded boxes, gears and a table (behaviour chapter 16, section C.1, demo 10).

use farseer_core::math::Vector2;
use farseer_core::shape::Vertices;
use farseer_core::{BodyFactory, Context, GeomFactory, GeomPlacement, JointFactory, JointId, Result};

use super::scene::Known;
use super::{BLACK, GOLD, SampleScene, Table, WHITE, border, table};

/// Disposes a weld that broke.
fn dispose_weld(_: &mut Known, context: &mut Context<'_>, weld: JointId) {
    // Its id is not stale: it is in the simulator that calls.
    context.remove(weld).ok();
    context.dispose(weld).ok();
}

/// Simple 10: two boxes welded to each other, two gears, and a table.
pub(super) fn weld_joint_and_gears() -> Result<SampleScene> {
    let mut scene = SampleScene::new(100.0)?;
    welded_boxes(&mut scene)?;
    gears(&mut scene)?;
    let position = Vector2::new(200.0, 450.0);
    let group = 50;
    table(
        &mut scene,
        Table { position, width: 200.0, height: 50.0, collision_group: group, breakpoints: [2.5; 2] },
    )?;
    border(&mut scene)?;
    Ok(scene)
}

fn welded_boxes(scene: &mut SampleScene) -> Result<()> {
    let simulator = &mut scene.simulator;
    let mut bodies = Vec::new();
    for x in [250.0, 350.0] {
        let body = BodyFactory::create_rectangle_body_in(simulator, 100.0, 25.0, 5.0)?;
        simulator[body].set_position(Vector2::new(x, 300.0));
        bodies.push(body);
    }
    let mut geoms = Vec::new();
    for &body in &bodies {
        let placement = GeomPlacement::default();
        geoms.push(GeomFactory::create_rectangle_geom_in(simulator, body, 100.0, 25.0, placement)?);
    }
    simulator.ignore_collision_with(geoms[0], geoms[1])?;
    let middle = Vector2::new(300.0, 300.0);
    let weld = JointFactory::create_weld_joint_in(simulator, bodies[0], bodies[1], middle)?;
    simulator[weld].set_breakpoint(5.0)?;
    geoms.into_iter().for_each(|geom| scene.show(geom, WHITE, BLACK));
    scene.dispatch.on_joint_broke(weld, dispose_weld);
    Ok(())
}

fn gears(scene: &mut SampleScene) -> Result<()> {
    let places = [Vector2::new(500.0, 200.0), Vector2::new(613.0, 200.0)];
    let mut bodies = Vec::new();
    for (place, group) in places.into_iter().zip([2, 3]) {
        let simulator = &mut scene.simulator;
        let mut outline = Vertices::create_gear(50.0, 20, 0.5, 10.0)?;
        let body = BodyFactory::create_polygon_body_in(simulator, &outline, 10.0)?;
        simulator[body].set_position(place);
        let placement = GeomPlacement::with_grid_size(1.5);
        let geom = GeomFactory::create_polygon_geom_in(simulator, body, &mut outline, placement)?;
        simulator[geom].set_collision_group(group);
        simulator[geom].set_friction_coefficient(0.0);
        scene.show(geom, GOLD, BLACK);
        bodies.push(body);
    }
    for (body, place) in bodies.into_iter().zip(places) {
        JointFactory::create_fixed_revolute_joint_in(&mut scene.simulator, body, place)?;
    }
    Ok(())
}
