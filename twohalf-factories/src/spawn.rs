//! Things of a game in one call: body, geom, depth, both frictions, what rests on the ground, and where.

use serde::{Deserialize, Serialize};
use twohalf::farseer_core::Error;
use twohalf::{BodyId, DepthProfile, Footprint, GeomId, Result, TextureId, TwoHalfPhysicsSimulator, Vector3};

use crate::{TwoHalfBodyFactory, TwoHalfGeomFactory};

/// Moment of inertia of what does not topple.
const NEVER_TURNS: f32 = 1e20;
/// Corners of a ball's outline; the ball itself is round.
const CORNERS: i32 = 24;

/// The ids of what was [spawned](spawn).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Spawned {
    /// The body: where it is, its velocities, its ground.
    pub body: BodyId,
    /// Its only geom, which rests on the ground: friction, restitution, categories.
    pub geom: GeomId,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Shape {
    Box { size: [f32; 3] },
    Ball { radius: f32 },
    Upright(DepthProfile),
}

/// What [`spawn`] makes. [`Prism`], [`Ball`], [`Cylinder`], [`Capsule`] and [`Figure`] begin one.
#[derive(Debug, Clone, Copy, PartialEq)]
#[must_use = "`spawn` makes it"]
pub struct Thing {
    shape: Shape,
    mass: f32,
    friction: f32,
    restitution: f32,
    is_upright: bool,
    position3d: Vector3,
    shadow: Option<TextureId>,
}

/// A box, or a prism on end.
#[derive(Debug, Clone, Copy)]
pub struct Prism;

/// A cylinder on end.
#[derive(Debug, Clone, Copy)]
pub struct Cylinder;

/// A capsule on end.
#[derive(Debug, Clone, Copy)]
pub struct Capsule;

/// A ball, which rolls in all directions.
#[derive(Debug, Clone, Copy)]
pub struct Ball;

/// Somebody who is steered: an upright cylinder without friction or bounce.
#[derive(Debug, Clone, Copy)]
pub struct Figure;

impl Prism {
    /// A box of width, height and depth in px, of mass 1, friction 0.4, without bounce.
    #[expect(clippy::new_ret_no_self, reason = "all things are told the same")]
    pub fn new(size: [f32; 3]) -> Thing {
        Thing::of(Shape::Box { size })
    }

    /// A prism on end: a footprint and a height in px, of mass 1, friction 0.4, without bounce. It
    /// [stays upright](DepthProfile::Upright).
    pub fn footprint(footprint: Footprint, height: f32) -> Thing {
        Thing::of(Shape::Upright(DepthProfile::Upright { footprint, height }))
    }
}

impl Cylinder {
    /// A cylinder on end: a radius and a height in px, of mass 1, friction 0.4, without bounce. It
    /// [stays upright](DepthProfile::Cylinder).
    #[expect(clippy::new_ret_no_self, reason = "all things are told the same")]
    pub fn new(radius: f32, height: f32) -> Thing {
        Thing::of(Shape::Upright(DepthProfile::Cylinder { radius, height }))
    }
}

impl Capsule {
    /// A capsule on end: a radius, and a height in px that is at least twice that, of mass 1, friction 0.4, without bounce. It
    /// [stays upright](DepthProfile::Capsule).
    #[expect(clippy::new_ret_no_self, reason = "all things are told the same")]
    pub fn new(radius: f32, height: f32) -> Thing {
        Thing::of(Shape::Upright(DepthProfile::Capsule { radius, height }))
    }
}

impl Ball {
    /// A ball of a radius in px, of mass 1, friction 0.4, without bounce; solid, with 2/5 m r².
    #[expect(clippy::new_ret_no_self, reason = "all things are told the same")]
    pub fn new(radius: f32) -> Thing {
        Thing::of(Shape::Ball { radius })
    }
}

impl Figure {
    /// A figure of width, height and depth in px, of mass 70. It is a [`Cylinder`] of that height, whose diameter is the mean of
    /// width and depth: two of them slide past each other, and one round a corner, where boxes would catch. Only with
    /// [`DepthScheme::Precise`](twohalf::DepthScheme::Precise), as [walking](TwoHalfPhysicsSimulator::walk); elsewhere an upright
    /// [`Prism`] does.
    #[expect(clippy::new_ret_no_self, reason = "all things are told the same")]
    pub fn new([width, height, depth]: [f32; 3]) -> Thing {
        let size = Some([width, height, depth]).filter(|size| size.iter().all(|&side| side > 0.0));
        // What is no size is refused as that.
        let radius = if size.is_some() { 0.25 * width + 0.25 * depth } else { f32::NAN };
        Cylinder::new(radius, height).mass(70.0).friction(0.0)
    }
}

impl Thing {
    fn of(shape: Shape) -> Self {
        let position3d = Vector3::zeros();
        Thing {
            shape,
            mass: 1.0,
            friction: 0.4,
            restitution: 0.0,
            is_upright: false,
            position3d,
            shadow: None,
        }
    }

    /// Its mass, finite and greater than 0.
    pub fn mass(mut self, mass: f32) -> Self {
        self.mass = mass;
        self
    }

    /// Friction against other things and against the ground. Later: that of the geom and that of the body's ground.
    pub fn friction(mut self, friction: f32) -> Self {
        self.friction = friction;
        self
    }

    /// Bounciness against other things and the ground, usually 0 to 1.
    pub fn restitution(mut self, restitution: f32) -> Self {
        self.restitution = restitution;
        self
    }

    /// It never topples: its moment of inertia is 1e20.
    pub fn upright(mut self) -> Self {
        self.is_upright = true;
        self
    }

    /// Its [`position3d`](twohalf::TwoHalfBody::position3d), X, Y up and Z in px: Y is that of its lowest point.
    pub fn at(mut self, position3d: [f32; 3]) -> Self {
        self.position3d = position3d.into();
        self
    }

    /// The picture of its shadow.
    pub fn shadow(mut self, image: TextureId) -> Self {
        self.shadow = Some(image);
        self
    }

    fn check(&self) -> Result<()> {
        let positive = |argument, value: f32| match value.is_finite() && value > 0.0 {
            true => Ok(()),
            false => Err(Error::invalid(argument, value, "finite and greater than 0")),
        };
        let finite = |argument, value: f32| match value.is_finite() {
            true => Ok(()),
            false => Err(Error::invalid(argument, value, "finite")),
        };
        match self.shape {
            Shape::Box { size: [width, height, depth] } => {
                positive("width", width)?;
                positive("height", height)?;
                positive("depth", depth)?;
            }
            Shape::Ball { radius } => positive("radius", radius)?,
            Shape::Upright(profile) => {
                let [width, height] = front_of(profile);
                positive("radius", width)?;
                positive("height", height)?;
            }
        }
        positive("mass", self.mass)?;
        finite("friction", self.friction)?;
        finite("restitution", self.restitution)?;
        self.position3d.iter().try_for_each(|&number| finite("position3d", number))?;
        Ok(())
    }

    fn body(&self, simulator: &mut TwoHalfPhysicsSimulator) -> Result<BodyId> {
        match self.shape {
            Shape::Box { size: [width, height, _] } => {
                TwoHalfBodyFactory::create_rectangle_body(simulator, width, height, self.mass)
            }
            Shape::Ball { radius } => TwoHalfBodyFactory::create_circle_body(simulator, radius, self.mass),
            Shape::Upright(profile) => {
                let [width, height] = front_of(profile);
                TwoHalfBodyFactory::create_rectangle_body(simulator, width, height, self.mass)
            }
        }
    }

    fn moment_of_inertia(&self) -> Option<f32> {
        match self.shape {
            _ if self.is_upright => Some(NEVER_TURNS),
            Shape::Ball { radius } => Some(0.4 * self.mass * radius * radius),
            Shape::Box { .. } | Shape::Upright(_) => None,
        }
    }

    fn geom(&self, simulator: &mut TwoHalfPhysicsSimulator, body: BodyId) -> Result<GeomId> {
        match self.shape {
            Shape::Box { size: [width, height, depth] } => {
                let geom = TwoHalfGeomFactory::create_rectangle_geom(simulator, body, width, height)?;
                simulator.set_depth_profile(geom, DepthProfile::Prism { depth })?;
                Ok(geom)
            }
            Shape::Ball { radius } => {
                TwoHalfGeomFactory::create_circle_geom(simulator, body, radius, CORNERS)
            }
            Shape::Upright(profile) => {
                let [width, height] = front_of(profile);
                let geom = TwoHalfGeomFactory::create_rectangle_geom(simulator, body, width, height)?;
                simulator.set_depth_profile(geom, profile)?;
                Ok(geom)
            }
        }
    }

    fn furnish(&self, simulator: &mut TwoHalfPhysicsSimulator, body: BodyId) -> Result<GeomId> {
        let geom = self.geom(simulator, body)?;
        if let Some(settings) = simulator.geom_mut(geom) {
            settings.set_friction_coefficient(self.friction);
            settings.set_restitution_coefficient(self.restitution);
        }
        if let Some(mut view) = simulator.body_mut(body) {
            if let Some(moment) = self.moment_of_inertia() {
                view.core_mut().set_moment_of_inertia(moment)?;
            }
            let mut ground = view.ground_mut();
            ground.set_friction_coefficient(self.friction);
            ground.set_restitution_coefficient(self.restitution);
            ground.set_object_geom(geom, self.shadow)?;
            view.set_position3d(self.position3d);
        }
        Ok(geom)
    }
}

/// Width and height of something upright.
fn front_of(profile: DepthProfile) -> [f32; 2] {
    match profile {
        DepthProfile::Cylinder { radius, height } | DepthProfile::Capsule { radius, height } => {
            [2.0 * radius, height]
        }
        DepthProfile::Upright { footprint, height } => {
            let (low, high) = footprint.bounds();
            [high.x - low.x, height]
        }
        DepthProfile::Prism { depth } => [depth, depth],
        DepthProfile::Round { radius } => [2.0 * radius; 2],
    }
}

/// Makes a thing and adds it to the simulator: it takes part from the next update.
///
/// ```
/// use twohalf::{TwoHalfPhysicsSimulator, Vector2};
/// use twohalf_factories::{Ball, Figure, Prism, spawn};
///
/// let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 900.0))?;
/// let player = spawn(&mut simulator, Figure::new([30.0, 60.0, 20.0]).at([60.0, 0.0, 80.0]))?;
/// let load = spawn(&mut simulator, Prism::new([40.0, 40.0, 40.0]).mass(10.0).at([140.0, 0.0, 80.0]))?;
/// spawn(&mut simulator, Ball::new(15.0).mass(2.0).restitution(0.6).at([60.0, 100.0, 160.0]))?;
/// (0..120).for_each(|_| simulator.update(1.0 / 120.0));
/// assert!(simulator.body(player.body).unwrap().is_grounded());
/// // What was chosen can be changed.
/// simulator.geom_mut(load.geom).unwrap().set_friction_coefficient(0.1);
/// # Ok::<(), twohalf::Error>(())
/// ```
///
/// # Errors
/// A size or mass that is not finite and greater than 0, or so small that the moment of inertia vanishes; a friction,
/// restitution or position that is not finite; something upright that is not as high as a capsule has to be, or with another
/// scheme than [`DepthScheme::Precise`](twohalf::DepthScheme::Precise). Then nothing was made.
pub fn spawn(simulator: &mut TwoHalfPhysicsSimulator, thing: Thing) -> Result<Spawned> {
    thing.check()?;
    let body = thing.body(simulator)?;
    match thing.furnish(simulator, body) {
        Ok(geom) => Ok(Spawned { body, geom }),
        Err(error) => {
            simulator.dispose(body)?;
            Err(error)
        }
    }
}
