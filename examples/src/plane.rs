//! A 2D scene: the Farseer engine, and how its objects look.

use farseer_core::math::Vector2;
use farseer_core::{BodyFactory, BodyId, GeomFactory, GeomId, GeomPlacement, PhysicsSimulator};
use twohalf_render::{Canvas, Color, Sprite, SpriteBatch, Transform};

use crate::{GRAVITY, Look, RATE, Result, SIZE, palette, wood};

/// Height of the floor in px.
const FLOOR: f32 = 50.0;
/// Width and height of the walls at both ends of the floor in px.
const WALL: [f32; 2] = [14.0, 300.0];
/// Friction and restitution coefficients of all geoms.
const SURFACE: [f32; 2] = [0.5, 0.5];
/// Colour of static bodies.
const EARTH: Color = Color::rgb(150, 118, 80);
/// Height in px from which on an object counts as being in the air at the end.
const ON_THE_FLOOR: f32 = 1.5;

/// A 2D simulator with a floor between two walls, and its objects.
#[derive(Debug, Clone)]
pub struct Plane {
    simulator: PhysicsSimulator,
    looks: Vec<(BodyId, Look)>,
    /// Static boxes: size, middle and rotation.
    fixed: Vec<([f32; 2], [f32; 2], f32)>,
    most_contacts: usize,
}

impl Plane {
    /// A floor between two walls.
    ///
    /// # Errors
    /// None with these sizes.
    pub fn new() -> Result<Self> {
        let simulator = PhysicsSimulator::new(Vector2::new(0.0, GRAVITY))?;
        let mut plane = Plane { simulator, looks: Vec::new(), fixed: Vec::new(), most_contacts: 0 };
        let [width, height] = SIZE.map(|side| side as f32);
        plane.add_platform([width, FLOOR], [width / 2.0, height - FLOOR / 2.0], 0.0)?;
        for x in [WALL[0] / 2.0, width - WALL[0] / 2.0] {
            plane.add_platform(WALL, [x, height - FLOOR - WALL[1] / 2.0], 0.0)?;
        }
        Ok(plane)
    }

    /// Adds an immovable rectangle about a point of the screen, turned clockwise by `rotation` rad.
    ///
    /// # Errors
    /// A size out of range.
    pub fn add_platform(&mut self, size: [f32; 2], [x, y]: [f32; 2], rotation: f32) -> Result<()> {
        let simulator = &mut self.simulator;
        let body = BodyFactory::create_rectangle_body_in(simulator, size[0], size[1], 1.0)?;
        simulator[body].set_is_static(true);
        simulator[body].set_position(Vector2::new(x, y));
        simulator[body].set_rotation(rotation);
        // The cells of a long thin geom have to be given.
        let placement = GeomPlacement::with_grid_size(5.0);
        let geom = GeomFactory::create_rectangle_geom_in(simulator, body, size[0], size[1], placement)?;
        self.set_surface(geom);
        self.fixed.push((size, [x, y], rotation));
        Ok(())
    }

    /// Adds a circle about a point of the screen.
    ///
    /// # Errors
    /// A radius out of range.
    pub fn add_circle(&mut self, radius: f32, position: [f32; 2], velocity: [f32; 2]) -> Result<()> {
        let mass = radius * radius / 500.0;
        let body = BodyFactory::create_circle_body_in(&mut self.simulator, radius, mass)?;
        let placement = GeomPlacement::default();
        let geom = GeomFactory::create_circle_geom_in(&mut self.simulator, body, radius, 32, placement)?;
        self.set_surface(geom);
        self.place(body, position, velocity, Look::ball(radius, palette(self.looks.len()))?);
        Ok(())
    }

    /// Adds a box about a point of the screen.
    ///
    /// # Errors
    /// A size out of range.
    pub fn add_box(&mut self, size: [f32; 2], position: [f32; 2], velocity: [f32; 2]) -> Result<()> {
        let [width, height] = size;
        let mass = width * height / 1500.0;
        let body = BodyFactory::create_rectangle_body_in(&mut self.simulator, width, height, mass)?;
        let placement = GeomPlacement::default();
        let geom =
            GeomFactory::create_rectangle_geom_in(&mut self.simulator, body, width, height, placement)?;
        self.set_surface(geom);
        self.place(body, position, velocity, Look::crate_box(width, height, wood(self.looks.len()))?);
        Ok(())
    }

    fn set_surface(&mut self, geom: GeomId) {
        let [friction, restitution] = SURFACE;
        self.simulator[geom].set_friction_coefficient(friction);
        self.simulator[geom].set_restitution_coefficient(restitution);
    }

    fn place(&mut self, body: BodyId, position: [f32; 2], velocity: [f32; 2], look: Look) {
        self.simulator[body].set_position(Vector2::from(position));
        self.simulator[body].set_linear_velocity(Vector2::from(velocity));
        self.looks.push((body, look));
    }

    /// Makes a step.
    pub fn step(&mut self) {
        self.simulator.update(1.0 / RATE as f32);
        self.most_contacts = self.most_contacts.max(self.simulator.counters().contacts_solved);
    }

    /// Draws the sky and the static bodies.
    pub fn draw_backdrop(&self, canvas: &mut dyn Canvas) {
        canvas.clear(Color::rgb(196, 220, 238));
        for &([width, height], middle, rotation) in &self.fixed {
            let place = Transform::rotation(rotation).then(&Transform::translation(middle));
            let corner = [-width / 2.0, -height / 2.0];
            canvas.fill_rectangle(corner, [width, height], &place, EARTH);
            canvas.fill_rectangle(corner, [width, 4.0], &place, EARTH.darker(0.4));
        }
    }

    /// Draws the dynamic bodies.
    pub fn draw(&self, canvas: &mut dyn Canvas) {
        let mut batch = SpriteBatch::begin();
        for (body, look) in &self.looks {
            let body = &self.simulator[*body];
            let position = [body.position().x, body.position().y];
            let sprite = Sprite::centered(&look.texture, position);
            batch.draw(Sprite { rotation: body.rotation(), ..sprite });
            look.draw_light(&mut batch, position, 0.0);
        }
        batch.end(canvas);
    }

    /// Number of bodies, those that do not move among them.
    pub fn bodies(&self) -> usize {
        self.simulator.body_list().len()
    }

    /// The simulator, to look at.
    pub fn simulator(&self) -> &PhysicsSimulator {
        &self.simulator
    }

    /// The simulator, to meddle with it.
    pub fn simulator_mut(&mut self) -> &mut PhysicsSimulator {
        &mut self.simulator
    }

    /// Most contact points that a step solved.
    pub fn most_contacts(&self) -> usize {
        self.most_contacts
    }

    /// How many objects lie on the floor, and how many there are.
    pub fn on_the_floor(&self) -> (usize, usize) {
        let floor = SIZE[1] as f32 - FLOOR;
        let height = |(body, _): &(BodyId, Look)| {
            let geoms = self.simulator.geoms_of(*body).iter().filter_map(|&geom| self.simulator.geom(geom));
            floor - geoms.map(|geom| geom.aabb().max.y).fold(f32::NEG_INFINITY, f32::max)
        };
        let lying = self.looks.iter().filter(|object| height(object).abs() < ON_THE_FLOOR);
        (lying.count(), self.looks.len())
    }
}
