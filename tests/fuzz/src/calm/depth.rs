//! Calm games of the 2.5D engine, in which bodies come to rest between calls.

use farseer_core::{BodyId, CollisionCategory};
use twohalf::{
    CharacterController, CharacterSettings, MoveInput, PlatformId, Result, TwoHalfPhysicsSimulator, Vector3,
};

use super::{any_call, mass, rest};
use crate::around::GameWrapper;
use crate::game::{Call, Game, Outcome};
use crate::random::Random;
use crate::upright::swing;

/// Greatest number of figures that walk at the same time.
const MOST_WALKERS: usize = 4;

/// A game of bodies that ride on platforms which rotate and move. Bodies also walk, and a time scale slows or stops them.
///
/// They meet bodies of any mass, and the game watches whether they are crushed. `G` is the inner game, whose calls are made in
/// between.
#[derive(Debug)]
pub struct CalmDepth<G> {
    game: G,
    walkers: Vec<(BodyId, CharacterController, MoveInput)>,
}

impl<G: Game<Simulator = TwoHalfPhysicsSimulator> + 'static> GameWrapper for CalmDepth<G> {
    type Inner = G;

    fn wrap(game: G) -> Self {
        CalmDepth { game, walkers: vec![] }
    }
    fn calls() -> &'static [Call<Self>] {
        const {
            &[
                Call { name: "create a thing", weight: 3, make: |game| (G::calls()[0].make)(&mut game.game) },
                Call { name: "play as ever", weight: 3, make: |game| any_call(&mut game.game) },
                Call { name: "turn or move a platform", weight: 2, make: Self::move_platform },
                Call { name: "edit a body", weight: 3, make: Self::edit_body },
                Call { name: "walk", weight: 2, make: Self::let_walk },
                Call { name: "rest", weight: 20, make: Self::rest },
            ]
        }
    }
    fn inner(&self) -> &G {
        &self.game
    }
    fn inner_mut(&mut self) -> &mut G {
        &mut self.game
    }
}

impl<G: Game<Simulator = TwoHalfPhysicsSimulator> + 'static> CalmDepth<G> {
    fn move_platform(&mut self) -> Outcome {
        let all: Vec<PlatformId> = self.simulator().platforms().collect();
        if all.is_empty() {
            return Outcome::Queried;
        }
        let (id, edit) = (self.random().pick(&all), self.random().below(8));
        let (turn, way) = (self.random().number(-2.0, 2.0), self.random().vector3(60.0));
        let middle = self.simulator().platform(id).map_or(Vector3::zeros(), |platform| platform.position3d());
        let swing = swing(middle, self.random());
        let Some(mut platform) = self.simulator_mut().platform_mut(id) else { return Outcome::Queried };
        Outcome::of(match edit {
            0 => platform.set_angular_velocity(turn),
            1 => platform.turn_to(turn),
            2 => platform.set_velocity(way),
            3 => platform.set_velocity(Vector3::zeros()),
            4 => platform.set_one_way(turn > 0.0),
            5 | 6 => platform.set_swing(swing),
            _ => {
                platform.set_collides_with(CollisionCategory::ALL);
                platform.set_collision_categories(CollisionCategory::ALL);
                Ok(())
            }
        })
    }

    /// Makes a random body walk from now on, or changes how it walks.
    fn let_walk(&mut self) -> Outcome {
        let all: Vec<BodyId> = self.simulator().core().bodies().collect();
        if all.is_empty() {
            return Outcome::Queried;
        }
        let random = self.random();
        let wish = MoveInput {
            x: random.number(-150.0, 150.0),
            z: random.number(-150.0, 150.0),
            jump: random.toss(),
        };
        let walk =
            CharacterSettings { ledge_reach: random.pick(&[0.0, 30.0]), ..CharacterSettings::default() };
        let walker = (random.pick(&all), CharacterController::new(walk), wish);
        let known = self.walkers.iter().position(|(body, ..)| *body == walker.0);
        if self.walkers.len() < MOST_WALKERS && known.is_none() {
            self.walkers.push(walker);
            return Outcome::Queried;
        }
        let place = known.unwrap_or_else(|| self.random().below(MOST_WALKERS));
        self.walkers[place] = walker;
        Outcome::Queried
    }

    fn rest(&mut self) -> Outcome {
        let mut walkers = std::mem::take(&mut self.walkers);
        let outcome = rest(self, |simulator, dt| {
            for (body, walker, wish) in &mut walkers {
                // A body that was removed, or that has no object geom, cannot walk.
                simulator.walk(*body, walker, *wish, dt).ok();
            }
            simulator.update(dt);
        });
        self.walkers = walkers;
        outcome
    }

    fn edit_body(&mut self) -> Outcome {
        let all: Vec<BodyId> = self.simulator().core().bodies().collect();
        if all.is_empty() {
            return Outcome::Queried;
        }
        let id = self.random().pick(&all);
        let mut random = self.random().split();
        Outcome::of(random.pick(EDITS)(self.simulator_mut(), id, &mut random))
    }
}

type Edit = fn(&mut TwoHalfPhysicsSimulator, BodyId, &mut Random) -> Result<()>;

const EDITS: &[Edit] = &[
    |simulator, body, random| simulator.set_time_scale(body, random.pick(&[0.0, 0.1, 0.5, 1.0])),
    |simulator, body, random| simulator.stop_time(body, random.below(40) as u32),
    |simulator, body, random| {
        let tolerance = random.toss().then(|| random.number(0.0, 10.0));
        simulator.set_crush_tolerance(body, tolerance)
    },
    |simulator, body, random| {
        simulator.set_sleep_enabled(random.chance(85));
        simulator.wake(body);
        Ok(())
    },
    |simulator, body, random| {
        let mass = mass(random);
        simulator.body_mut(body).map_or(Ok(()), |mut body| body.set_mass(mass))
    },
    |simulator, body, random| {
        let velocity = random.vector3(2000.0);
        if let Some(mut body) = simulator.body_mut(body) {
            body.core_mut().set_is_bullet(true);
            body.set_velocity3d(velocity);
        }
        Ok(())
    },
    |simulator, body, random| {
        let force = random.number(-20.0, 20.0);
        if let Some(mut body) = simulator.body_mut(body) {
            body.apply_force_z(force);
        }
        Ok(())
    },
];
