//! Games with one-way geoms, amid all other calls.

use farseer_core::Methods;
use farseer_core::math::Vector2;

use super::Plane;
use super::stages::any_call;
use crate::around::GameWrapper;
use crate::game::{Call, Game, Outcome};
use crate::random::Random;

/// A game of the precise set, in which geoms get new one-way directions again and again.
#[derive(Debug)]
pub struct OneWayPlane(Plane);

impl OneWayPlane {
    /// Makes an object with a body and a geom.
    pub(crate) fn create_thing(&mut self) -> Outcome {
        (Plane::calls()[0].make)(&mut self.0)
    }
}

/// Sets one-way directions of geoms. Most directions are up, so that falling bodies land.
fn set_one_way(game: &mut Plane) -> Outcome {
    let geom = game.geom();
    let direction = match game.random.below(8) {
        0 => None,
        1 => Some(game.random.vector(1.0)),
        _ => Some(Vector2::new(0.0, -1.0)),
    };
    Outcome::of(game.simulator.set_one_way(geom, direction))
}

/// Throws a body up, or teleports it.
fn throw(game: &mut Plane) -> Outcome {
    let id = game.body();
    let speed = game.random.number(0.0, 400.0);
    let place = game.random.chance(20).then(|| game.random.vector(150.0));
    let Some(body) = game.simulator.body_mut(id) else { return Outcome::Queried };
    body.set_linear_velocity(Vector2::new(0.0, -speed));
    place.into_iter().for_each(|place| body.set_position(place));
    Outcome::Changed
}

impl GameWrapper for OneWayPlane {
    type Inner = Plane;

    fn begin(random: Random) -> Plane {
        let mut game = Plane::new(random);
        game.simulator.set_methods(Methods::PRECISE).expect("all that there is can be of the precise set");
        game
    }
    fn wrap(plane: Plane) -> Self {
        OneWayPlane(plane)
    }
    fn calls() -> &'static [Call<Self>] {
        &[
            Call { name: "a call", weight: 12, make: |game| any_call(&mut game.0) },
            Call { name: "set_one_way", weight: 2, make: |game| set_one_way(&mut game.0) },
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
