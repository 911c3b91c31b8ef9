//! Games that call the stages of an update in any order, as an engine with mistakes might do.

use super::Plane;
use crate::around::GameWrapper;
use crate::game::{Call, Outcome, draw};
use crate::shapes::step;

/// A game that calls single stages between updates. It has no twins: saves do not include the state that a stage leaves to
/// later stages of the same update.
#[derive(Debug)]
pub struct StagedPlane(Plane);

const STAGES: &[fn(&mut Plane)] = &[
    |game| {
        game.simulator.process_queues(step(&mut game.random), None);
    },
    |game| game.simulator.find_pairs(None),
    |game| game.simulator.collide_pairs(None),
    |game| game.simulator.apply_forces(step(&mut game.random), step(&mut game.random), None),
    |game| game.simulator.pre_step(1.0 / step(&mut game.random)),
    |game| game.simulator.solve_iteration(None),
    |game| game.simulator.integrate(step(&mut game.random), None),
    |game| game.simulator.leave_to_engine(game.random.below(10)),
    |game| game.simulator.process_added_and_removed(),
    |game| game.simulator.settle(None),
    |game| {
        let (arbiter, contact) = (game.random.below(10), game.random.below(5));
        let (normal, tangent) = (game.random.number(0.0, 10.0), game.random.number(-3.0, 3.0));
        game.simulator.set_arbiter_impulses(arbiter, contact, normal, tangent);
    },
    |game| {
        let id = game.body();
        let Some(place) = game.simulator.solver_place(id) else { return };
        let mut body = game.simulator.solver_body(place);
        body.velocity[game.random.below(3)] = game.random.number(-10.0, 10.0);
        body.bias[game.random.below(3)] = game.random.number(-1.0, 1.0);
        game.simulator.set_solver_body(place, body);
        if game.random.chance(10) {
            game.simulator.solver_body_failed(place);
        }
    },
];

impl GameWrapper for StagedPlane {
    type Inner = Plane;

    fn wrap(plane: Plane) -> Self {
        StagedPlane(plane)
    }
    fn calls() -> &'static [Call<Self>] {
        &[
            Call { name: "a call", weight: 3, make: |game| any_call(&mut game.0) },
            Call {
                name: "a stage",
                weight: 1,
                make: |game| {
                    game.0.random.pick(STAGES)(&mut game.0);
                    Outcome::Changed
                },
            },
        ]
    }
    fn inner(&self) -> &Plane {
        &self.0
    }
    fn inner_mut(&mut self) -> &mut Plane {
        &mut self.0
    }
}

/// Makes one of the calls of a 2D game.
pub(super) fn any_call(game: &mut Plane) -> Outcome {
    (draw::<Plane>(&mut game.random).make)(game)
}
