//! Levers and ropes held by springs (behaviour chapter 16, section B.3).

use farseer_core::math::Vector2;
use farseer_core::{BodyFactory, BodyId, GeomFactory, GeomPlacement, JointFactory, Result, SpringFactory};

use super::{BLACK, GOLD, SampleScene, WHITE};

/// The end of a lever that is held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// The left one.
    Left,
    /// The upper one.
    Top,
    /// The right one.
    Right,
    /// The lower one.
    Bottom,
}

/// A board that turns about one of its ends against an angle spring.
#[derive(Debug, Clone, Copy)]
pub struct Lever {
    /// The end that is held.
    pub side: Side,
    /// Width and height in px.
    pub size: [f32; 2],
    /// Torque of the spring per rad.
    pub spring_constant: f32,
    /// Torque of the spring per angular velocity, in kg px²/s.
    pub damping_constant: f32,
    /// Number of the collision group.
    pub collision_group: i32,
    /// Where it is held.
    pub position: Vector2,
}

impl Lever {
    /// Adds it.
    ///
    /// # Errors
    /// A size that is not greater than 0.
    pub fn add(&self, scene: &mut SampleScene) -> Result<BodyId> {
        let [width, height] = self.size;
        let (offset, radius) = match self.side {
            Side::Left => (Vector2::new(-width / 2.0, 0.0), height),
            Side::Top => (Vector2::new(0.0, -height / 2.0), width),
            Side::Right => (Vector2::new(width / 2.0, 0.0), height),
            Side::Bottom => (Vector2::new(0.0, height / 2.0), width),
        };
        let simulator = &mut scene.simulator;
        let body = BodyFactory::create_rectangle_body_in(simulator, width, height, 1.0)?;
        let placement = GeomPlacement::default();
        let board = GeomFactory::create_rectangle_geom_in(simulator, body, width, height, placement)?;
        simulator[body].set_position(self.position - offset);
        let placement = GeomPlacement { offset, ..Default::default() };
        let hub = GeomFactory::create_circle_geom_in(simulator, body, radius, 20, placement)?;
        for geom in [board, hub] {
            simulator[geom].set_friction_coefficient(0.5);
            simulator[geom].set_collision_group(self.collision_group);
        }
        JointFactory::create_fixed_revolute_joint_in(simulator, body, self.position)?;
        let (spring, damping) = (self.spring_constant, self.damping_constant);
        SpringFactory::create_fixed_angle_spring_in(simulator, body, spring, damping)?;
        scene.show(board, WHITE, BLACK);
        scene.show(hub, GOLD, BLACK);
        Ok(body)
    }
}

/// Square blocks, each hanging on the one above by a spring.
#[derive(Debug, Clone, Copy)]
pub struct Rope {
    /// Position of the uppermost block.
    pub position: Vector2,
    /// Number of blocks.
    pub count: usize,
    /// Edge of a block, and distance of their middles, in px.
    pub edge: f32,
    /// Mass of a block in kg.
    pub mass: f32,
    /// Force of a spring per length.
    pub spring_constant: f32,
    /// Force of a spring per velocity, in kg/s.
    pub damping_constant: f32,
    /// Number of the collision group.
    pub collision_group: i32,
}

impl Rope {
    /// Adds it; returns its uppermost block.
    ///
    /// # Errors
    /// A size or mass that is not greater than 0.
    pub fn add(&self, scene: &mut SampleScene) -> Result<BodyId> {
        let simulator = &mut scene.simulator;
        let first = BodyFactory::create_rectangle_body_in(simulator, self.edge, self.edge, self.mass)?;
        simulator[first].set_position(self.position);
        let mut bodies = vec![first];
        for index in 1..self.count {
            let above = simulator[bodies[index - 1]].position();
            let body = BodyFactory::create_body_from_in(simulator, first)?;
            simulator[body].set_position(above + Vector2::new(0.0, self.edge));
            bodies.push(body);
        }
        let placement = GeomPlacement::default();
        let model = GeomFactory::create_rectangle_geom_in(simulator, first, self.edge, self.edge, placement)?;
        simulator[model].set_collision_group(self.collision_group);
        let mut geoms = vec![model];
        for &body in &bodies[1..] {
            geoms.push(GeomFactory::create_geom_from_in(simulator, body, model)?);
        }
        let (spring, damping) = (self.spring_constant, self.damping_constant);
        let middle = Vector2::zeros();
        for pair in bodies.windows(2) {
            SpringFactory::create_linear_spring_in(
                simulator, pair[0], middle, pair[1], middle, spring, damping,
            )?;
        }
        geoms.into_iter().for_each(|geom| scene.show(geom, WHITE, BLACK));
        Ok(first)
    }
}
