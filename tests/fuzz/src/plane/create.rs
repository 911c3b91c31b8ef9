//! Calls that make objects, one for each kind.

use farseer_core::{
    Body, BodyFactory, BodyId, Controller, FluidDragController, GeomFactory, GeomId, GravityController,
    InactivityController, JointFactory, JointId, NarrowPhaseCollider, Result, ScalingController,
    SpringFactory, SpringId, WaveController,
};

use super::Plane;
use super::controllers::container;
use crate::drives::create_driven_joint;
use crate::shapes::{chain, edges, outline, placement};

/// A function that makes an object of some kind and returns its id.
pub(super) type Make<I> = fn(&mut Plane) -> Result<I>;

pub(super) const BODIES: &[Make<BodyId>] = &[
    |game| {
        let (width, height) = (game.random.number(1.0, 50.0), game.random.number(1.0, 50.0));
        let mass = game.mass();
        BodyFactory::create_rectangle_body_in(&mut game.simulator, width, height, mass)
    },
    |game| {
        let (radius, mass) = (game.random.number(1.0, 50.0), game.mass());
        BodyFactory::create_circle_body_in(&mut game.simulator, radius, mass)
    },
    |game| {
        let (height, radius) = (game.random.number(10.0, 60.0), game.random.number(1.0, 15.0));
        let mass = game.mass();
        BodyFactory::create_capsule_body_in(&mut game.simulator, height, radius, mass)
    },
    |game| {
        let (x, y, mass) = (game.random.number(1.0, 50.0), game.random.number(1.0, 50.0), game.mass());
        BodyFactory::create_ellipse_body_in(&mut game.simulator, x, y, mass)
    },
    |game| {
        let (outline, mass) = (outline(&mut game.random), game.mass());
        BodyFactory::create_polygon_body_in(&mut game.simulator, &outline, mass)
    },
    |game| {
        let (mass, inertia) = (game.mass(), game.random.number(1.0, 500.0));
        BodyFactory::create_body_in(&mut game.simulator, mass, inertia)
    },
    |game| {
        let body = game.body();
        BodyFactory::create_body_from_in(&mut game.simulator, body)
    },
    |game| {
        let mut body = Body::new();
        for _ in 0..2 {
            game.random.pick(super::BODY_EDITS)(&mut body, &mut game.random);
        }
        Ok(game.simulator.create_body(body))
    },
];

pub(super) const GEOMS: &[Make<GeomId>] = &[
    |game| {
        let (body, place) = (game.body(), placement(&mut game.random));
        let (width, height) = (game.random.number(1.0, 50.0), game.random.number(1.0, 50.0));
        GeomFactory::create_rectangle_geom_in(&mut game.simulator, body, width, height, place)
    },
    |game| {
        let (body, place) = (game.body(), placement(&mut game.random));
        let (radius, edges) = (game.random.number(1.0, 50.0), edges(&mut game.random, 3, 30));
        GeomFactory::create_circle_geom_in(&mut game.simulator, body, radius, edges, place)
    },
    |game| {
        let (body, place) = (game.body(), placement(&mut game.random));
        let (height, radius) = (game.random.number(10.0, 60.0), game.random.number(1.0, 15.0));
        let edges = edges(&mut game.random, 1, 15);
        GeomFactory::create_capsule_geom_in(&mut game.simulator, body, height, radius, edges, place)
    },
    |game| {
        let (body, place) = (game.static_body(), placement(&mut game.random));
        let points = chain(&mut game.random);
        GeomFactory::create_chain_geom_in(&mut game.simulator, body, &points, place)
    },
    |game| {
        let (body, place) = (game.body(), placement(&mut game.random));
        let (x, y) = (game.random.number(1.0, 50.0), game.random.number(1.0, 50.0));
        let edges = edges(&mut game.random, 3, 30);
        GeomFactory::create_ellipse_geom_in(&mut game.simulator, body, x, y, edges, place)
    },
    |game| {
        let (body, place) = (game.body(), placement(&mut game.random));
        let mut outline = outline(&mut game.random);
        GeomFactory::create_polygon_geom_in(&mut game.simulator, body, &mut outline, place)
    },
    |game| {
        let (body, geom) = (game.body(), game.geom());
        GeomFactory::create_geom_from_in(&mut game.simulator, body, geom)
    },
    |game| {
        let (body, geom, offset) = (game.body(), game.geom(), game.random.vector(20.0));
        let turn = game.random.number(-3.0, 3.0);
        GeomFactory::create_geom_from_with_offset_in(&mut game.simulator, body, geom, offset, turn)
    },
    |game| {
        let (body, place) = (game.body(), placement(&mut game.random));
        let outline = outline(&mut game.random);
        game.simulator.create_geom(body, outline, place)
    },
];

pub(super) const JOINTS: &[Make<JointId>] = &[
    |game| {
        let (body1, body2, anchor) = (game.body(), game.body(), game.random.vector(100.0));
        JointFactory::create_revolute_joint_in(&mut game.simulator, body1, body2, anchor)
    },
    |game| {
        let (body, anchor) = (game.body(), game.random.vector(100.0));
        JointFactory::create_fixed_revolute_joint_in(&mut game.simulator, body, anchor)
    },
    |game| {
        let (body1, body2) = (game.body(), game.body());
        let (anchor1, anchor2) = (game.random.vector(10.0), game.random.vector(10.0));
        JointFactory::create_pin_joint_in(&mut game.simulator, body1, anchor1, body2, anchor2)
    },
    |game| {
        let (body1, body2) = (game.body(), game.body());
        let (anchor1, anchor2) = (game.random.vector(10.0), game.random.vector(10.0));
        let (min, max) = (game.random.number(0.0, 20.0), game.random.number(0.0, 60.0));
        JointFactory::create_slider_joint_in(&mut game.simulator, body1, anchor1, body2, anchor2, min, max)
    },
    |game| {
        let (body1, body2) = (game.body(), game.body());
        JointFactory::create_angle_joint_in(&mut game.simulator, body1, body2)
    },
    |game| {
        let (body1, body2) = (game.body(), game.body());
        let (softness, bias) = (game.random.number(0.0, 1.0), game.random.number(0.0, 1.0));
        JointFactory::create_angle_joint_with_in(&mut game.simulator, body1, body2, softness, bias)
    },
    |game| {
        let body = game.body();
        JointFactory::create_fixed_angle_joint_in(&mut game.simulator, body)
    },
    |game| {
        let (body1, body2) = (game.body(), game.body());
        let (lower, upper) = (game.random.number(-2.0, 2.0), game.random.number(-2.0, 2.0));
        JointFactory::create_angle_limit_joint_in(&mut game.simulator, body1, body2, lower, upper)
    },
    |game| {
        let body = game.body();
        let (lower, upper) = (game.random.number(-2.0, 2.0), game.random.number(-2.0, 2.0));
        JointFactory::create_fixed_angle_limit_joint_in(&mut game.simulator, body, lower, upper)
    },
    |game| {
        let (body1, body2, anchor) = (game.body(), game.body(), game.random.vector(100.0));
        JointFactory::create_weld_joint_in(&mut game.simulator, body1, body2, anchor)
    },
    create_driven,
    create_driven,
    create_driven,
    create_driven,
];

/// Makes a joint with drives. The faithful set refuses to add it.
fn create_driven(game: &mut Plane) -> Result<JointId> {
    let bodies = [game.body(), game.body()];
    let joint = create_driven_joint(&mut game.simulator, bodies, &mut game.random)?;
    drop(game.simulator.add(joint));
    Ok(joint)
}

pub(super) const SPRINGS: &[Make<SpringId>] = &[
    |game| {
        let (body1, body2) = (game.body(), game.body());
        let (point1, point2) = (game.random.vector(10.0), game.random.vector(10.0));
        let (spring, damping) = (game.random.number(0.0, 100.0), game.random.number(0.0, 5.0));
        let simulator = &mut game.simulator;
        SpringFactory::create_linear_spring_in(simulator, body1, point1, body2, point2, spring, damping)
    },
    |game| {
        let (body, point1, point2) = (game.body(), game.random.vector(10.0), game.random.vector(100.0));
        let (spring, damping) = (game.random.number(0.0, 100.0), game.random.number(0.0, 5.0));
        let simulator = &mut game.simulator;
        SpringFactory::create_fixed_linear_spring_in(simulator, body, point1, point2, spring, damping)
    },
    |game| {
        let (body1, body2) = (game.body(), game.body());
        let (spring, damping) = (game.random.number(0.0, 1000.0), game.random.number(0.0, 50.0));
        SpringFactory::create_angle_spring_in(&mut game.simulator, body1, body2, spring, damping)
    },
    |game| {
        let body = game.body();
        let (spring, damping) = (game.random.number(0.0, 1000.0), game.random.number(0.0, 50.0));
        SpringFactory::create_fixed_angle_spring_in(&mut game.simulator, body, spring, damping)
    },
];

pub(super) const CONTROLLERS: &[Make<Controller>] = &[
    |game| {
        let (position, nodes) = (game.random.vector(200.0), game.random.count(2, 20));
        let (width, height) = (game.random.number(100.0, 600.0), game.random.number(20.0, 100.0));
        Ok(WaveController::new(position, width, height, nodes.clamp(0, 10_000) as usize)?.into())
    },
    |game| {
        let (container, density) = (container(&game.pools, &mut game.random), game.random.number(0.0, 0.01));
        let (drag, turning) = (game.random.number(0.0, 2.0), game.random.number(0.0, 2.0));
        let gravity = game.random.vector(100.0);
        let mut fluid = FluidDragController::new(container, density, drag, turning, gravity)?;
        for _ in 0..4 {
            fluid.add_geom(game.geom())?;
        }
        Ok(fluid.into())
    },
    |game| {
        let (bodies, points) = (vec![game.body(), game.body()], vec![game.random.vector(50.0)]);
        let (strength, radius) = (game.random.number(0.0, 1000.0), game.random.number(10.0, 200.0));
        Ok(GravityController::new(bodies, points, strength, radius)?.into())
    },
    |game| {
        let points = vec![game.random.vector(50.0)];
        let (strength, radius) = (game.random.number(0.0, 1000.0), game.random.number(10.0, 200.0));
        Ok(GravityController::with_points(points, strength, radius)?.into())
    },
    |_| Ok(InactivityController::new().into()),
    |game| {
        let (preferred, maximum) = (game.random.number(0.001, 0.05), game.random.number(0.01, 0.1));
        Ok(ScalingController::new(preferred, maximum)?.into())
    },
    |_| Ok(Controller::user_defined()),
];

impl Plane {
    pub(super) fn body(&mut self) -> BodyId {
        self.random.pick(&self.pools.bodies)
    }

    /// Returns a static body if there is any, because other bodies cannot have chains. Otherwise returns another body.
    fn static_body(&mut self) -> BodyId {
        let is_static = |&body: &BodyId| self.simulator.body(body).is_some_and(Body::is_static);
        let bodies: Vec<BodyId> = self.pools.bodies.iter().copied().filter(is_static).collect();
        if bodies.is_empty() { self.body() } else { self.random.pick(&bodies) }
    }

    pub(super) fn geom(&mut self) -> GeomId {
        self.random.pick(&self.pools.geoms)
    }

    fn mass(&mut self) -> f32 {
        self.random.number(0.5, 10.0)
    }

    /// Makes geoms from a concave outline that is cut into convex pieces. Needs the narrow phase with separating axes.
    pub(super) fn create_pieces(&mut self) -> Result<()> {
        let (outline, body, most) =
            (outline(&mut self.random), self.body(), self.random.count(1, 40).min(40));
        let narrow_phase = self.simulator.narrow_phase_collider();
        self.simulator.set_narrow_phase_collider(NarrowPhaseCollider::Sat);
        let pieces = GeomFactory::create_sat_polygon_geom_in(&mut self.simulator, body, &outline, most);
        self.simulator.set_narrow_phase_collider(narrow_phase);
        self.pools.geoms.extend(pieces?);
        Ok(())
    }
}
