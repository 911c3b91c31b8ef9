//! A 2.5D scene: the engine, and how its objects look.

use twohalf::{
    BodyId, ContactTarget, DepthScheme, Drawable, Platform, PlatformId, TwoHalfPhysicsSimulator, Vector2,
    Vector3,
};
use twohalf_factories::{TwoHalfBodyFactory, TwoHalfGeomFactory};
use twohalf_render::{
    Canvas, Color, DebugView, DrawBody, DrawPlatform, PlatformLook, SpriteBatch, Texture2D, TextureStore,
};

use crate::{GRAVITY, Look, RATE, Result, SIZE, palette, wood};

/// Layer depth of drawings on the ground, dimensionless.
const ON_THE_GROUND: f32 = 1.0;
/// Friction coefficient of all objects without another setting.
const FRICTION: f32 = 0.5;
/// Restitution coefficients of balls, and of crates and platforms.
const RESTITUTION: [f32; 2] = [0.6, 0.25];
/// Height in px over the surface beneath it from which on an object counts as being in the air at the end.
const ON_THE_SURFACE: f32 = 1.5;

/// Shape, position over the ground and velocity along X, up and along Z of an object.
#[derive(Debug, Clone, Copy)]
pub struct Start {
    /// Shape.
    pub shape: Shape,
    /// X, height of the lowest point, and Z, in px.
    pub place: [f32; 3],
    /// Velocity along X, up and along Z, px/s.
    pub velocity: [f32; 3],
    /// Friction coefficient of the object; that of its ground is the usual one.
    pub friction: f32,
}

/// Shape and size in px.
#[derive(Debug, Clone, Copy)]
pub enum Shape {
    /// A ball.
    Ball {
        /// Radius in px.
        radius: f32,
    },
    /// A crate as deep as its shorter side.
    Crate {
        /// Width in px.
        width: f32,
        /// Height in px.
        height: f32,
        /// Rotation in rad, clockwise.
        rotation: f32,
    },
}

impl Start {
    /// A ball.
    pub const fn ball(radius: f32, place: [f32; 3], velocity: [f32; 3]) -> Self {
        Start { shape: Shape::Ball { radius }, place, velocity, friction: FRICTION }
    }

    /// A crate.
    pub const fn crate_box([width, height]: [f32; 2], place: [f32; 3], velocity: [f32; 3]) -> Self {
        let shape = Shape::Crate { width, height, rotation: 0.0 };
        Start { shape, place, velocity, friction: FRICTION }
    }

    /// The same crate, turned; a ball stays as it is.
    pub const fn turned(self, rotation: f32) -> Self {
        match self.shape {
            Shape::Crate { width, height, .. } => {
                Start { shape: Shape::Crate { width, height, rotation }, ..self }
            }
            Shape::Ball { .. } => self,
        }
    }

    /// The same with another friction.
    pub const fn with_friction(self, friction: f32) -> Self {
        Start { friction, ..self }
    }
}

/// A 2.5D simulator, how its objects look, and its pictures.
#[derive(Debug, Clone)]
pub struct Stage {
    simulator: TwoHalfPhysicsSimulator,
    textures: TextureStore,
    /// By body slot.
    looks: Vec<Option<Look>>,
    platforms: Vec<(PlatformId, PlatformLook)>,
    angle: i32,
    debug_view: Option<DebugView>,
    most_contacts: usize,
}

impl Stage {
    /// An empty stage whose Z axis has an angle of `angle` degrees counterclockwise from the x axis.
    ///
    /// # Errors
    /// An angle out of range.
    pub fn new(angle: i32, scheme: DepthScheme, wants_debug_view: bool) -> Result<Self> {
        let gravity = Vector2::new(0.0, GRAVITY);
        let mut simulator = TwoHalfPhysicsSimulator::with_angle_and_gravity(SIZE[1] as i32, angle, gravity)?;
        simulator.set_depth_scheme(scheme)?;
        Ok(Stage {
            simulator,
            textures: TextureStore::default(),
            looks: Vec::new(),
            platforms: Vec::new(),
            angle,
            debug_view: wants_debug_view.then(DebugView::default),
            most_contacts: 0,
        })
    }

    /// Adds a platform: its width, height and depth, its position, and its tilt in rad, clockwise.
    ///
    /// # Errors
    /// A size out of range.
    pub fn add_platform(
        &mut self,
        [width, height, depth]: [f32; 3],
        place: [f32; 3],
        rotation: f32,
        color: Color,
    ) -> Result<()> {
        let across = width * rotation.cos().abs() + height * rotation.sin().abs();
        let shadow = Texture2D::box_shadow(across as u32, depth as u32, self.angle as f32)?;
        let image = Some(self.textures.add(shadow));
        let place = Vector3::from(place);
        let id = Platform::with_rotation(&mut self.simulator, width, height, depth, place, rotation, image)?;
        let mut platform = self.simulator.platform_mut(id).ok_or("the platform is new")?;
        platform.set_friction_coefficient(FRICTION);
        platform.set_restitution_coefficient(RESTITUTION[1]);
        self.platforms.push((id, PlatformLook::new(color)));
        Ok(())
    }

    /// Adds an object.
    ///
    /// # Errors
    /// A size out of range.
    pub fn add(&mut self, start: &Start) -> Result<()> {
        let index = self.looks.iter().flatten().count();
        let simulator = &mut self.simulator;
        let (body, geom, look, width) = match start.shape {
            Shape::Ball { radius } => {
                let mass = radius * radius / 500.0;
                let body = TwoHalfBodyFactory::create_circle_body(simulator, radius, mass)?;
                let geom = TwoHalfGeomFactory::create_circle_geom(simulator, body, radius, 32)?;
                (body, geom, Look::ball(radius, palette(index))?, 2.0 * radius)
            }
            Shape::Crate { width, height, .. } => {
                let mass = width * height / 1500.0;
                let body = TwoHalfBodyFactory::create_rectangle_body(simulator, width, height, mass)?;
                let geom = TwoHalfGeomFactory::create_rectangle_geom(simulator, body, width, height)?;
                (body, geom, Look::crate_box(width, height, wood(index))?, width)
            }
        };
        let restitution = RESTITUTION[usize::from(matches!(start.shape, Shape::Crate { .. }))];
        let settings = simulator.geom_mut(geom).ok_or("the geom is new")?;
        settings.set_friction_coefficient(start.friction);
        settings.set_restitution_coefficient(restitution);

        let image = self.textures.add(Texture2D::shadow((1.2 * width) as u32, (0.5 * width) as u32)?);
        let mut view = simulator.body_mut(body).ok_or("the body is new")?;
        let mut ground = view.ground_mut();
        ground.set_friction_coefficient(FRICTION);
        ground.set_restitution_coefficient(restitution);
        ground.set_object_geom(geom, Some(image))?;
        if let Shape::Crate { rotation, .. } = start.shape {
            view.set_rotation(rotation);
        }
        view.set_position3d(Vector3::from(start.place));
        view.set_linear_velocity(Vector2::new(start.velocity[0], -start.velocity[1]));
        view.set_linear_velocity_z(start.velocity[2]);
        self.looks.resize(self.looks.len().max(body.slot() + 1), None);
        self.looks[body.slot()] = Some(look);
        Ok(())
    }

    /// Adds all waiting objects without moving any.
    pub fn begin(&mut self) {
        self.simulator.update(0.0);
    }

    /// Makes a step.
    pub fn step(&mut self) {
        self.simulator.update(1.0 / RATE as f32);
        self.most_contacts = self.most_contacts.max(self.simulator.counters().contacts_solved);
    }

    /// Draws everything with its shadows, back to front.
    pub fn draw(&self, canvas: &mut dyn Canvas) {
        let order = self.simulator.draw_order();
        let layer = |place: usize| 1.0 - (place + 1) as f32 / (order.len() + 1) as f32;
        let mut batch = SpriteBatch::begin();
        for (place, drawable) in order.iter().enumerate() {
            match *drawable {
                Drawable::Platform(id) => self.draw_platform(&mut batch, id, layer(place)),
                Drawable::Body(id) => {
                    // A shadow is right before the object that it falls on, or on the ground, behind everything.
                    let surface = self.simulator.surface_beneath_body(id);
                    let below = surface.and_then(|surface| match surface.partner {
                        ContactTarget::Platform(id) => Some(Drawable::Platform(id)),
                        ContactTarget::Geom(geom) => Some(Drawable::Body(self.simulator.geom(geom)?.body())),
                        ContactTarget::Ground => None,
                    });
                    let below = below.and_then(|below| order.iter().position(|other| *other == below));
                    let of_shadow = below.map_or(ON_THE_GROUND, layer);
                    self.draw_body(&mut batch, id, layer(place), of_shadow);
                }
            }
        }
        batch.end(canvas);
        if let Some(view) = &self.debug_view {
            view.draw(&self.simulator, canvas);
        }
    }

    fn draw_platform(&self, batch: &mut SpriteBatch, id: PlatformId, layer: f32) {
        let Some((_, look)) = self.platforms.iter().find(|(platform, _)| *platform == id) else { return };
        let (simulator, textures) = (&self.simulator, &self.textures);
        simulator.draw_platform_shadow(
            batch,
            textures,
            id,
            [0.0; 2],
            [1.0; 2],
            Color::WHITE,
            ON_THE_GROUND,
            false,
        );
        simulator.draw_platform(batch, id, look, layer);
    }

    fn draw_body(&self, batch: &mut SpriteBatch, id: BodyId, layer: f32, of_shadow: f32) {
        let (simulator, textures) = (&self.simulator, &self.textures);
        let Some(body) = simulator.body(id) else { return };
        if let Some(geom) = body.ground().object_geom() {
            simulator.draw_shadow(
                batch,
                textures,
                id,
                geom,
                [0.0; 2],
                [1.0; 2],
                Color::WHITE,
                of_shadow,
                true,
            );
        }
        if let Some(look) = self.looks.get(id.slot()).and_then(Option::as_ref) {
            simulator.draw_body(batch, id, &look.texture, layer);
            look.draw_light(batch, body.position().into(), layer);
        }
    }

    /// The simulator, to look at.
    pub fn simulator(&self) -> &TwoHalfPhysicsSimulator {
        &self.simulator
    }

    /// The simulator, to meddle with it.
    pub fn simulator_mut(&mut self) -> &mut TwoHalfPhysicsSimulator {
        &mut self.simulator
    }

    /// Most contact points that a step solved.
    pub fn most_contacts(&self) -> usize {
        self.most_contacts
    }

    /// How many objects lie on the ground, how many on platforms, and how many there are.
    pub fn at_rest(&self) -> [usize; 3] {
        let mut count = [0, 0, self.simulator.body_list().len()];
        for &id in self.simulator.body_list() {
            let (Some(body), Some(surface)) =
                (self.simulator.body(id), self.simulator.surface_beneath_body(id))
            else {
                continue;
            };
            if (body.position3d().y - surface.height).abs() < ON_THE_SURFACE {
                count[usize::from(surface.partner != ContactTarget::Ground)] += 1;
            }
        }
        count
    }
}
