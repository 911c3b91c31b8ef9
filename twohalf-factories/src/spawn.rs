//! Spawning of objects in one call: body, geom, depth, both frictions, object geom of the ground, and
//! position.

use serde::{Deserialize, Serialize};
use twohalf::farseer_core::Error;
use twohalf::{BodyId, DepthProfile, Footprint, GeomId, Result, TextureId, TwoHalfPhysicsSimulator, Vector3};

use crate::{TwoHalfBodyFactory, TwoHalfGeomFactory};

/// Moment of inertia of bodies that do not topple, mass · px².
const LOCKED_INERTIA: f32 = 1e20;
/// Number of corners of a ball's outline; the ball itself is round.
const BALL_OUTLINE_CORNERS: i32 = 24;

/// Ids of a [spawned](spawn) object.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Spawned {
    /// The body: position, velocities, ground.
    pub body: BodyId,
    /// Its only geom, the object geom of its ground: friction, restitution, categories.
    pub geom: GeomId,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Shape {
    Box { size: [f32; 3] },
    Ball { radius: f32 },
    Upright(DepthProfile),
}

/// Description of an object for [`spawn`], from [`Prism`], [`Ball`], [`Cylinder`], [`Capsule`] or [`Figure`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[must_use = "`spawn` makes it"]
pub struct Thing {
    shape: Shape,
    /// Mass, in mass units.
    mass: f32,
    /// Friction coefficient, dimensionless.
    friction: f32,
    /// Restitution coefficient, dimensionless.
    restitution: f32,
    is_upright: bool,
    position3d: Vector3,
    shadow: Option<TextureId>,
}

/// A box, or an upright prism.
#[derive(Debug, Clone, Copy)]
pub struct Prism;

/// An upright cylinder.
#[derive(Debug, Clone, Copy)]
pub struct Cylinder;

/// An upright capsule.
#[derive(Debug, Clone, Copy)]
pub struct Capsule;

/// A ball, which rolls in all directions.
#[derive(Debug, Clone, Copy)]
pub struct Ball;

/// A character: an upright cylinder without friction or restitution.
#[derive(Debug, Clone, Copy)]
pub struct Figure;

impl Prism {
    /// A box of width, height and depth in px, of mass 1, friction 0.4, without restitution.
    #[expect(clippy::new_ret_no_self, reason = "all kinds have the same constructors")]
    pub fn new(size: [f32; 3]) -> Thing {
        Thing::of(Shape::Box { size })
    }

    /// An upright prism: a footprint and a height in px, of mass 1, friction 0.4, without restitution. It
    /// [stays upright](DepthProfile::Upright).
    pub fn footprint(footprint: Footprint, height: f32) -> Thing {
        Thing::of(Shape::Upright(DepthProfile::Upright { footprint, height }))
    }
}

impl Cylinder {
    /// An upright cylinder: a radius and a height in px, of mass 1, friction 0.4, without restitution. It
    /// [stays upright](DepthProfile::Cylinder).
    #[expect(clippy::new_ret_no_self, reason = "all kinds have the same constructors")]
    pub fn new(radius: f32, height: f32) -> Thing {
        Thing::of(Shape::Upright(DepthProfile::Cylinder { radius, height }))
    }
}

impl Capsule {
    /// An upright capsule: a radius, and a height in px that is at least twice that, of mass 1, friction 0.4,
    /// without restitution. It [stays upright](DepthProfile::Capsule).
    #[expect(clippy::new_ret_no_self, reason = "all kinds have the same constructors")]
    pub fn new(radius: f32, height: f32) -> Thing {
        Thing::of(Shape::Upright(DepthProfile::Capsule { radius, height }))
    }
}

impl Ball {
    /// A ball of a radius in px, of mass 1, friction 0.4, without restitution; solid, with 2/5 m r².
    #[expect(clippy::new_ret_no_self, reason = "all kinds have the same constructors")]
    pub fn new(radius: f32) -> Thing {
        Thing::of(Shape::Ball { radius })
    }
}

impl Figure {
    /// A character of width, height and depth in px, of mass 70. It is a [`Cylinder`] of that height, whose
    /// diameter is the mean of width and depth: two of them slide past each other and round corners, where
    /// boxes would catch. It needs [`DepthScheme::Precise`](twohalf::DepthScheme::Precise), as
    /// [walking](TwoHalfPhysicsSimulator::walk) does; with other schemes use an upright [`Prism`].
    #[expect(clippy::new_ret_no_self, reason = "all kinds have the same constructors")]
    pub fn new([width, height, depth]: [f32; 3]) -> Thing {
        let size = Some([width, height, depth]).filter(|size| size.iter().all(|&side| side > 0.0));
        // A size out of range becomes NaN, which `spawn` refuses.
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

    /// Sets the mass, finite and greater than 0.
    pub fn mass(mut self, mass: f32) -> Self {
        self.mass = mass;
        self
    }

    /// Sets the friction coefficient of the geom and of the body's ground, dimensionless.
    pub fn friction(mut self, friction: f32) -> Self {
        self.friction = friction;
        self
    }

    /// Sets the restitution coefficient of the geom and of the body's ground, dimensionless, usually 0 to 1.
    pub fn restitution(mut self, restitution: f32) -> Self {
        self.restitution = restitution;
        self
    }

    /// Keeps the body upright by a moment of inertia of 1e20.
    pub fn upright(mut self) -> Self {
        self.is_upright = true;
        self
    }

    /// Sets its [`position3d`](twohalf::TwoHalfBody::position3d), X, Y up and Z in px: Y is that of its
    /// lowest point.
    pub fn at(mut self, position3d: [f32; 3]) -> Self {
        self.position3d = position3d.into();
        self
    }

    /// Sets the picture of its shadow.
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
            _ if self.is_upright => Some(LOCKED_INERTIA),
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
                TwoHalfGeomFactory::create_circle_geom(simulator, body, radius, BALL_OUTLINE_CORNERS)
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

/// Width and height of an upright shape, px.
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

/// Creates an object and adds it to the simulator: it takes part from the next update.
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
/// A size or mass that is not finite and greater than 0, or so small that the moment of inertia vanishes. A
/// friction, restitution or position that is not finite. A capsule of less than twice its radius in height.
/// An upright shape with another scheme than [`DepthScheme::Precise`](twohalf::DepthScheme::Precise). A
/// failed call adds nothing.
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
