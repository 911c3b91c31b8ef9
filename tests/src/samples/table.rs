//! A table whose legs break off (behaviour chapter 16, section B.3).

use farseer_core::math::Vector2;
use farseer_core::{BodyFactory, Context, GeomFactory, GeomPlacement, JointFactory, JointId, Result};

use super::scene::Known;
use super::{BLACK, Rgba, SampleScene};

const BURLY_WOOD: Rgba = [222, 184, 135, 255];

/// Position of a table, and the load that it carries.
#[derive(Debug, Clone, Copy)]
pub struct Table {
    /// Middle of the top.
    pub position: Vector2,
    /// Width of the top in px.
    pub width: f32,
    /// Height of the legs in px.
    pub height: f32,
    /// Number of the collision group of its parts, for as long as their welds hold.
    pub collision_group: i32,
    /// Greatest error of the left and the right weld in px. The original draws both at random from 1 to 4.
    pub breakpoints: [f32; 2],
}

/// Enables collisions between the parts of a table when a weld breaks.
fn come_apart(known: &mut Known, context: &mut Context<'_>, weld: JointId) {
    for &part in known.welded.get(weld).into_iter().flatten() {
        if let Some(geom) = context.geom_mut(part) {
            geom.set_collision_group(0);
        }
    }
}

/// Adds a table.
///
/// # Errors
/// A size that is not greater than 0.
pub fn table(scene: &mut SampleScene, table: Table) -> Result<()> {
    let Table { position, width, height, collision_group, breakpoints } = table;
    let down = height / 2.0 + 5.0;
    let left_place = Vector2::new(position.x - width / 2.0 + 10.0, position.y + down);
    let right_place = Vector2::new(position.x + width / 2.0 - 10.0, position.y + down);
    let simulator = &mut scene.simulator;
    let mut board = |width, height, mass, place| {
        let body = BodyFactory::create_rectangle_body_in(simulator, width, height, mass)?;
        simulator[body].set_position(place);
        Ok(body)
    };
    let top = board(width, 10.0, 6.0, position)?;
    let right = board(10.0, height, 3.0, right_place)?;
    let left = board(10.0, height, 3.0, left_place)?;
    let mut geom = |body, width, height| {
        let placement = GeomPlacement::default();
        let geom = GeomFactory::create_rectangle_geom_in(simulator, body, width, height, placement)?;
        simulator[geom].set_collision_group(collision_group);
        simulator[geom].set_restitution_coefficient(0.0);
        Ok(geom)
    };
    let top_geom = geom(top, width, 10.0)?;
    let right_geom = geom(right, 10.0, height)?;
    let left_geom = geom(left, 10.0, height)?;
    let mut weld = |leg, corner, breakpoint| {
        let joint = JointFactory::create_weld_joint_in(simulator, leg, top, corner)?;
        simulator[joint].set_breakpoint(breakpoint)?;
        Ok(joint)
    };
    let left_weld = weld(left, left_place + Vector2::new(5.0, -height / 2.0), breakpoints[0])?;
    let right_weld = weld(right, right_place + Vector2::new(-5.0, -height / 2.0), breakpoints[1])?;
    for (weld, leg) in [(left_weld, left_geom), (right_weld, right_geom)] {
        scene.known.welded.insert(weld, [leg, top_geom]);
        scene.dispatch.on_joint_broke(weld, come_apart);
    }
    [top_geom, right_geom, left_geom].into_iter().for_each(|geom| scene.show(geom, BURLY_WOOD, BLACK));
    Ok(())
}
