//! Calls that make objects, one for each kind.

use farseer_core::{Body, BodyId, GeomId};
use twohalf::{DepthProfile, Platform, PlatformId, Result, TwoHalfPhysicsSimulator, Vector3};
use twohalf_factories::{TwoHalfBodyFactory, TwoHalfGeomFactory};

use super::{Depth, place};
use crate::random::Random;
use crate::shapes::{edges, outline, placement};

/// A function that makes an object of some kind and returns its id.
pub(super) type Make<I> = fn(&mut Depth) -> Result<I>;

pub(super) const BODIES: &[Make<BodyId>] = &[
    |game| {
        let (mass, inertia) = (game.mass(), game.random.number(1.0, 100.0));
        TwoHalfBodyFactory::create_body(&mut game.simulator, mass, inertia)
    },
    |game| {
        let body = game.body();
        TwoHalfBodyFactory::clone_body(&mut game.simulator, body)
    },
    |game| {
        let (x, y, mass) = (game.size(), game.size(), game.mass());
        TwoHalfBodyFactory::create_ellipse_body(&mut game.simulator, x, y, mass)
    },
    |game| {
        let (outline, mass) = (outline(&mut game.random), game.mass());
        TwoHalfBodyFactory::create_polygon_body(&mut game.simulator, outline, mass)
    },
    |game| {
        let (width, height, mass) = (game.size(), game.size(), game.mass());
        TwoHalfBodyFactory::create_rectangle_body(&mut game.simulator, width, height, mass)
    },
    |game| {
        let body = game.body();
        game.simulator.clone_body(body)
    },
    |game| Ok(game.simulator.create_body(Body::new())),
];

pub(super) const GEOMS: &[Make<GeomId>] = &[
    |game| {
        let (body, radius, edges) = (game.body(), game.size(), edges(&mut game.random, 3, 20));
        TwoHalfGeomFactory::create_circle_geom(&mut game.simulator, body, radius, edges)
    },
    |game| {
        let (body, x, y, edges) = (game.body(), game.size(), game.size(), edges(&mut game.random, 3, 20));
        TwoHalfGeomFactory::create_ellipse_geom(&mut game.simulator, body, x, y, edges)
    },
    |game| {
        let (body, geom) = (game.body(), game.geom());
        TwoHalfGeomFactory::create_geom(&mut game.simulator, body, geom)
    },
    |game| {
        let (body, geom) = (game.body(), game.geom());
        TwoHalfGeomFactory::create_geom_in(&mut game.simulator, body, geom)
    },
    |game| {
        let (body, width, height) = (game.body(), game.size(), game.size());
        TwoHalfGeomFactory::create_rectangle_geom(&mut game.simulator, body, width, height)
    },
    |game| {
        let (body, geom) = (game.body(), game.geom());
        game.simulator.clone_geom(body, geom)
    },
    |game| {
        let (body, outline) = (game.body(), outline(&mut game.random));
        game.simulator.create_geom(body, outline, placement(&mut game.random))
    },
];

pub(super) const PLATFORMS: &[Make<PlatformId>] = &[
    |game| {
        let ([width, height, depth], place) = game.platform();
        Platform::new(&mut game.simulator, width, height, depth, place, None)
    },
    |game| {
        let ([width, height, depth], place) = game.platform();
        let turn = game.random.number(-1.5, 1.5);
        Platform::with_rotation(&mut game.simulator, width, height, depth, place, turn, None)
    },
    |game| {
        let ([width, height, depth], place) = game.platform();
        let (turn, angle) = (game.random.number(-1.5, 1.5), game.random.count(1, 179));
        let simulator = &mut game.simulator;
        Platform::with_rotation_and_angle(simulator, width, height, depth, place, turn, None, angle)
    },
];

impl Depth {
    pub(crate) fn body(&mut self) -> BodyId {
        self.random.pick(&self.pools.bodies)
    }

    pub(crate) fn geom(&mut self) -> GeomId {
        self.random.pick(&self.pools.geoms)
    }

    fn mass(&mut self) -> f32 {
        self.random.number(0.5, 5.0)
    }

    fn size(&mut self) -> f32 {
        self.random.number(1.0, 30.0)
    }

    fn platform(&mut self) -> ([f32; 3], Vector3) {
        let random = &mut self.random;
        let size = [random.number(10.0, 200.0), random.number(5.0, 50.0), random.number(10.0, 100.0)];
        (size, place(random))
    }
}

/// Makes a moving body above the ground with a geom, which is a ball or a prism, and adds both to the simulator.
///
/// # Errors
/// If the outline of the geom is refused. The body stays in the simulator then.
pub(crate) fn create_thing(
    simulator: &mut TwoHalfPhysicsSimulator,
    random: &mut Random,
) -> Result<(BodyId, GeomId)> {
    let (width, height, mass) =
        (random.between(8.0, 30.0), random.between(8.0, 30.0), random.between(0.5, 4.0));
    let body = TwoHalfBodyFactory::create_rectangle_body(simulator, width, height, mass)?;
    let (position, velocity) = (place(random), random.vector3(100.0));
    let geom = match random.below(3) {
        0 => TwoHalfGeomFactory::create_circle_geom(simulator, body, width * 0.5, 12),
        1 => TwoHalfGeomFactory::create_rectangle_geom(simulator, body, width, height),
        _ => TwoHalfGeomFactory::create_polygon_geom(simulator, body, outline(random), 0.0),
    }?;
    if random.toss() {
        simulator.set_depth_profile(geom, DepthProfile::Prism { depth: random.between(5.0, 30.0) })?;
    }
    simulator.geom_mut(geom).expect("it was just made").set_friction_coefficient(0.4);
    let mut view = simulator.body_mut(body).expect("it was just made");
    if random.chance(80) {
        view.ground_mut().set_object_geom(geom, None)?;
    }
    view.set_position3d(position);
    view.set_velocity3d(velocity);
    Ok((body, geom))
}
