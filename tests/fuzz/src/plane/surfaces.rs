//! Games with rounded polygons, chains that are solid on both sides, height fields and surfaces of all kinds, amid all other calls.

use farseer_core::math::Vector2;
use farseer_core::{BodyBuilder, CombinationRule, GeomBuilder, Methods, SurfaceOptions};

use super::Plane;
use super::stages::any_call;
use crate::around::GameWrapper;
use crate::game::{Call, Game, Outcome};
use crate::random::Random;
use crate::shapes::{chain, outline};

/// A game of the precise set, in which bodies get shapes and surfaces that geoms of Farseer do not have.
#[derive(Debug)]
pub struct SurfacePlane(Plane);

/// Rules of combination, and none.
const RULES: [Option<CombinationRule>; 6] = [
    None,
    Some(CombinationRule::Mean),
    Some(CombinationRule::GeometricMean),
    Some(CombinationRule::Minimum),
    Some(CombinationRule::Product),
    Some(CombinationRule::Maximum),
];

/// Returns a random shape. Some have impossible numbers.
fn shape(random: &mut Random) -> GeomBuilder {
    let geom = match random.below(6) {
        0 => GeomBuilder::segment(random.vector(40.0), random.vector(40.0)).mass(random.number(0.5, 5.0)),
        1 => GeomBuilder::two_sided_chain(chain(random)).mass(random.number(0.5, 5.0)),
        2 => {
            let heights: Vec<f32> = (0..random.below(12)).map(|_| random.number(-20.0, 20.0)).collect();
            GeomBuilder::height_field(heights, random.number(2.0, 40.0))
        }
        3 => GeomBuilder::rounded_polygon(outline(random).iter().copied(), random.number(0.5, 10.0)),
        _ => {
            let [x, y] = [random.number(1.0, 20.0), random.number(1.0, 20.0)];
            let corners = [[-x, -y], [x, -y], [x, y], [-x, y]];
            GeomBuilder::rounded_polygon(corners, random.number(0.1, 10.0))
        }
    };
    let surface = surface(random);
    let geom = geom.surface_speed(surface.speed).rolling_resistance(surface.rolling_resistance);
    geom.friction(random.number(0.0, 1.0))
        .offset(random.vector(20.0))
        .rotation_offset(random.number(-3.0, 3.0))
}

fn surface(random: &mut Random) -> SurfaceOptions {
    SurfaceOptions {
        friction_rule: random.pick(&RULES),
        restitution_rule: random.pick(&RULES),
        speed: if random.toss() { 0.0 } else { random.number(-100.0, 100.0) },
        rolling_resistance: if random.toss() { 0.0 } else { random.number(0.0, 1.0) },
    }
}

/// Adds a body of any kind with one or two shapes.
fn add_body(game: &mut Plane) -> Outcome {
    if game.is_crowded() {
        return Outcome::Queried;
    }
    let body = match game.random.below(4) {
        0 => BodyBuilder::fixed(),
        1 => BodyBuilder::kinematic().linear_velocity(game.random.vector(30.0)),
        _ => BodyBuilder::dynamic().linear_velocity(game.random.vector(200.0)),
    };
    let body = body.position(game.random.vector(150.0)).rotation(game.random.number(-3.0, 3.0));
    let geoms: Vec<GeomBuilder> = (0..1 + game.random.below(2)).map(|_| shape(&mut game.random)).collect();
    Outcome::of(game.simulator.add_body_with(&body, &geoms).map(|(body, geoms)| {
        game.pools.bodies.push(body);
        game.pools.geoms.extend(geoms);
    }))
}

/// Adds a shape to a body that exists.
fn add_geom(game: &mut Plane) -> Outcome {
    if game.is_crowded() {
        return Outcome::Queried;
    }
    let (body, shape) = (game.body(), shape(&mut game.random));
    Outcome::of(game.simulator.add_geom(body, &shape).map(|geom| game.pools.geoms.push(geom)))
}

fn set_surface(game: &mut Plane) -> Outcome {
    let (geom, surface) = (game.geom(), surface(&mut game.random));
    Outcome::of(game.simulator.set_surface(geom, surface))
}

/// Lets a body fall, or throws it.
fn throw(game: &mut Plane) -> Outcome {
    let (id, speed) = (game.body(), game.random.vector(400.0));
    let Some(body) = game.simulator.body_mut(id) else { return Outcome::Queried };
    body.set_linear_velocity(speed + Vector2::new(0.0, -50.0));
    Outcome::Changed
}

impl GameWrapper for SurfacePlane {
    type Inner = Plane;

    fn begin(random: Random) -> Plane {
        let mut game = Plane::new(random);
        game.simulator.set_methods(Methods::PRECISE).expect("all that there is can be of the precise set");
        game
    }
    fn wrap(plane: Plane) -> Self {
        SurfacePlane(plane)
    }
    fn calls() -> &'static [Call<Self>] {
        &[
            Call { name: "a call", weight: 8, make: |game| any_call(&mut game.0) },
            Call { name: "add a body", weight: 2, make: |game| add_body(&mut game.0) },
            Call { name: "add a geom", weight: 1, make: |game| add_geom(&mut game.0) },
            Call { name: "set_surface", weight: 2, make: |game| set_surface(&mut game.0) },
            Call { name: "throw", weight: 1, make: |game| throw(&mut game.0) },
        ]
    }
    fn inner(&self) -> &Plane {
        &self.0
    }
    fn inner_mut(&mut self) -> &mut Plane {
        &mut self.0
    }
}
