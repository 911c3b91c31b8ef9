//! Rows of balls of different categories (behaviour chapter 16, sections B.3 and C.1, demos 5 and 8).

use farseer_core::math::{Vector2, vector2};
use farseer_core::{BodyFactory, BodyId, CollisionCategory, GeomFactory, GeomPlacement, Result};

use super::{Agent, BLACK, CENTRE, Drive, Rgba, SampleScene, border};

const RED: Rgba = [200, 0, 0, 175];
const GREEN: Rgba = [0, 200, 0, 175];
const BLUE: Rgba = [0, 0, 200, 175];
const DARK: Rgba = [0, 0, 0, 200];

/// A row of balls.
#[derive(Debug, Clone, Copy)]
pub struct Circles {
    /// Middle of the first ball.
    pub start: Vector2,
    /// Middle of the last ball.
    pub end: Vector2,
    /// Number of balls, 2 or more.
    pub count: usize,
    /// Radius of the balls in px.
    pub radius: f32,
    /// Categories the balls are in.
    pub collision_categories: CollisionCategory,
    /// Categories they collide with.
    pub collides_with: CollisionCategory,
    /// Their colour.
    pub color: Rgba,
}

/// Adds a row of balls.
///
/// # Errors
/// A radius that is not greater than 0.
pub fn circles(scene: &mut SampleScene, row: &Circles) -> Result<()> {
    let simulator = &mut scene.simulator;
    let first = BodyFactory::create_circle_body_in(simulator, row.radius, 0.5)?;
    simulator[first].set_position(row.start);
    let mut bodies: Vec<BodyId> = vec![first];
    for index in 1..row.count {
        let body = BodyFactory::create_body_from_in(simulator, first)?;
        let amount = index as f32 / (row.count - 1) as f32;
        simulator[body].set_position(vector2::lerp(row.start, row.end, amount));
        bodies.push(body);
    }
    let model =
        GeomFactory::create_circle_geom_in(simulator, first, row.radius, 10, GeomPlacement::default())?;
    simulator[model].set_restitution_coefficient(0.7);
    simulator[model].set_friction_coefficient(0.2);
    simulator[model].set_collision_categories(row.collision_categories);
    simulator[model].set_collides_with(row.collides_with);
    let mut geoms = vec![model];
    for &body in &bodies[1..] {
        geoms.push(GeomFactory::create_geom_from_in(simulator, body, model)?);
    }
    geoms.into_iter().for_each(|geom| scene.show(geom, row.color, BLACK));
    Ok(())
}

/// Simple 5: four groups of rows, each of which collides with itself and with some of the others.
pub(super) fn collision_categories() -> Result<SampleScene> {
    let cat = CollisionCategory::cat;
    let mut scene = SampleScene::new(0.0)?;
    scene.simulator.set_max_contacts_to_detect(2);
    let agent = Agent::of_fifth_category()?.add(&mut scene, CENTRE)?;
    scene.act(Drive::along_x(agent, 1000.0));

    let with_agent = |number| Ok::<_, farseer_core::Error>(cat(number)? | cat(4)? | cat(5)?);
    let left = [[100.0, 100.0, 100.0, 668.0], [200.0, 200.0, 200.0, 568.0], [300.0, 300.0, 300.0, 468.0]];
    let top = [[200.0, 100.0, 824.0, 100.0], [300.0, 200.0, 724.0, 200.0], [400.0, 300.0, 624.0, 300.0]];
    let right = [[924.0, 100.0, 924.0, 668.0], [824.0, 200.0, 824.0, 568.0], [724.0, 300.0, 724.0, 468.0]];
    let bottom = [[200.0, 668.0, 824.0, 668.0], [300.0, 568.0, 724.0, 568.0], [400.0, 468.0, 624.0, 468.0]];
    for (rows, collision_categories, collides_with, color) in [
        (left, cat(1)?, with_agent(1)?, RED),
        (top, cat(2)?, with_agent(2)?, GREEN),
        (right, cat(3)?, with_agent(3)?, BLUE),
        (bottom, cat(4)?, !cat(5)?, DARK),
    ] {
        for ([x1, y1, x2, y2], (count, radius)) in rows.into_iter().zip([(15, 15.0), (15, 12.0), (10, 9.0)]) {
            let (start, end) = (Vector2::new(x1, y1), Vector2::new(x2, y2));
            let row = Circles { start, end, count, radius, collision_categories, collides_with, color };
            circles(&mut scene, &row)?;
        }
    }
    border(&mut scene)?;
    Ok(scene)
}

/// Simple 8: 1600 balls in 40 rows, which collide with the agent alone.
pub(super) fn broad_phase_collision_stress_test() -> Result<SampleScene> {
    let cat = CollisionCategory::cat;
    let mut scene = SampleScene::new(0.0)?;
    scene.simulator.set_max_contacts_to_detect(2);
    let agent = Agent::of_fifth_category()?.add(&mut scene, CENTRE)?;
    scene.act(Drive::along_x(agent, 1000.0));
    let black = [0, 0, 0, 175];
    for (top, category, color) in [(50.0, 1, RED), (194.0, 3, BLUE), (458.0, 2, GREEN), (602.0, 4, black)] {
        for index in 0..10 {
            let y = top + 12.0 * index as f32;
            let row = Circles {
                start: Vector2::new(50.0, y),
                end: Vector2::new(974.0, y),
                count: 40,
                radius: 5.0,
                collision_categories: cat(category)?,
                collides_with: cat(5)?,
                color,
            };
            circles(&mut scene, &row)?;
        }
    }
    border(&mut scene)?;
    Ok(scene)
}
