//! The figure that the player moves (behaviour chapter 16, section B.3).

use std::f32::consts::FRAC_PI_4;

use farseer_core::math::Vector2;
use farseer_core::{BodyFactory, BodyId, CollisionCategory, GeomFactory, GeomPlacement, Result};

use super::{BLACK, GOLD, Rgba, SampleScene};

/// Half the distance of the outer balls in px.
const REACH: f32 = 40.0;
const GROUP: i32 = 1;
const BEAM: Rgba = [169, 169, 169, 255];

/// Five balls on two crossed beams.
#[derive(Debug, Clone, Copy)]
pub struct Agent {
    /// Categories its geoms are in.
    pub collision_categories: CollisionCategory,
    /// Categories they collide with.
    pub collides_with: CollisionCategory,
}

impl Default for Agent {
    /// In all categories, colliding with all.
    fn default() -> Self {
        Agent { collision_categories: CollisionCategory::ALL, collides_with: CollisionCategory::ALL }
    }
}

impl Agent {
    /// The agent of scenes with categories: in the fifth, colliding with all but the fourth.
    pub(super) fn of_fifth_category() -> Result<Self> {
        Ok(Agent {
            collision_categories: CollisionCategory::cat(5)?,
            collides_with: !CollisionCategory::cat(4)?,
        })
    }

    /// Adds it.
    ///
    /// # Errors
    /// A position that is not finite.
    pub fn add(&self, scene: &mut SampleScene, position: Vector2) -> Result<BodyId> {
        let simulator = &mut scene.simulator;
        let body = BodyFactory::create_rectangle_body_in(simulator, 2.0 * REACH, 2.0 * REACH, 5.0)?;
        simulator[body].set_position(position);

        let placement = GeomPlacement { offset: Vector2::new(-REACH, -REACH), ..Default::default() };
        let first = GeomFactory::create_circle_geom_in(simulator, body, 16.0, 10, placement)?;
        simulator[first].set_restitution_coefficient(0.4);
        simulator[first].set_friction_coefficient(0.2);
        simulator[first].set_collision_group(GROUP);
        simulator[first].set_collision_categories(self.collision_categories);
        simulator[first].set_collides_with(self.collides_with);
        let mut balls = vec![first];
        for (x, y) in [(-REACH, REACH), (REACH, -REACH), (REACH, REACH), (0.0, 0.0)] {
            let offset = Vector2::new(x, y);
            let ball = GeomFactory::create_geom_from_with_offset_in(simulator, body, first, offset, 0.0)?;
            balls.push(ball);
        }

        let mut beams = Vec::new();
        for rotation_offset in [FRAC_PI_4, -FRAC_PI_4] {
            let placement = GeomPlacement { rotation_offset, ..Default::default() };
            let beam = GeomFactory::create_rectangle_geom_in(simulator, body, 16.0, 120.0, placement)?;
            simulator[beam].set_collision_group(GROUP);
            simulator[beam].set_collision_categories(self.collision_categories);
            simulator[beam].set_collides_with(self.collides_with);
            simulator[beam].set_friction_coefficient(0.0);
            simulator[beam].set_restitution_coefficient(0.0);
            beams.push(beam);
        }
        beams.into_iter().for_each(|beam| scene.show(beam, BEAM, BLACK));
        balls.into_iter().for_each(|ball| scene.show(ball, GOLD, BLACK));
        Ok(body)
    }
}
