//! One body, obstacles and a stack (behaviour chapter 16, section C.1, demos 1, 3 and 4).

use farseer_core::math::Vector2;
use farseer_core::{BodyFactory, GeomFactory, GeomPlacement, Result};

use super::{Agent, BLACK, CENTRE, Drive, GOLD, Pyramid, SampleScene, WHITE, border, pyramid};

/// Simple 1: a body without a geom, which leaves through the border.
pub(super) fn a_single_body() -> Result<SampleScene> {
    let mut scene = SampleScene::new(0.0)?;
    let body = BodyFactory::create_rectangle_body_in(&mut scene.simulator, 128.0, 128.0, 1.0)?;
    scene.simulator[body].set_position(CENTRE);
    scene.show_rectangle(body, [128.0, 128.0], GOLD, BLACK);
    scene.act(Drive { body, force: Vector2::new(50.0, 0.0), torque: 1000.0 });
    border(&mut scene)?;
    Ok(scene)
}

/// Simple 3: the agent falls through obstacles.
pub(super) fn multiple_geometries_and_static_bodies() -> Result<SampleScene> {
    let mut scene = SampleScene::new(100.0)?;
    Agent::default().add(&mut scene, Vector2::new(512.0, 100.0))?;
    obstacles(&mut scene)?;
    border(&mut scene)?;
    Ok(scene)
}

/// Adds the five obstacles.
pub(super) fn obstacles(scene: &mut SampleScene) -> Result<()> {
    let mut geoms = Vec::new();
    let simulator = &mut scene.simulator;
    for (x, y) in [(-50.0, -200.0), (150.0, -100.0), (100.0, 50.0), (-100.0, 200.0), (-170.0, 0.0)] {
        let body = BodyFactory::create_rectangle_body_in(simulator, 128.0, 32.0, 1.0)?;
        simulator[body].set_is_static(true);
        simulator[body].set_position(CENTRE + Vector2::new(x, y));
        let geom = match geoms.first() {
            Some(&model) => GeomFactory::create_geom_from_in(simulator, body, model)?,
            None => {
                let placement = GeomPlacement::default();
                let geom = GeomFactory::create_rectangle_geom_in(simulator, body, 128.0, 32.0, placement)?;
                simulator[geom].set_restitution_coefficient(0.2);
                simulator[geom].set_friction_coefficient(0.2);
                geom
            }
        };
        geoms.push(geom);
    }
    geoms.into_iter().for_each(|geom| scene.show(geom, WHITE, BLACK));
    Ok(())
}

/// Simple 4: a heap of 105 blocks, and the agent beside it.
pub(super) fn stacked_objects() -> Result<SampleScene> {
    let mut scene = SampleScene::new(50.0)?;
    scene.simulator.set_bias_factor(0.2)?;
    scene.simulator.set_max_contacts_to_detect(2);
    let heap = Pyramid {
        edge: 32.0,
        spacing: 32.0 / 3.0,
        mass: 1.0,
        friction: 0.4,
        rows: 14,
        origin: Vector2::new(218.0, 708.0),
    };
    pyramid(&mut scene, heap)?;
    Agent::default().add(&mut scene, Vector2::new(192.0, 184.0))?;
    border(&mut scene)?;
    Ok(scene)
}
