//! Calm games of the 2D engine, in which bodies come to rest between calls.

use farseer_core::math::Vector2;
use farseer_core::{BodyId, JointFactory, JointId, Methods, PhysicsSimulator, Result, SolverChoice};

use super::{any_call, mass, rest};
use crate::around::GameWrapper;
use crate::drives::{create_driven_joint, edit_drive, lock_axes};
use crate::engine::Engine;
use crate::game::{Call, Game, Outcome};
use crate::plane::OneWayPlane;
use crate::random::Random;

/// A game of the precise set, with one-way geoms, bullets, joints and all solvers of islands.
#[derive(Debug)]
pub struct CalmPlane(OneWayPlane);

const CALLS: &[Call<CalmPlane>] = &[
    Call { name: "create a thing", weight: 3, make: create_thing },
    Call { name: "play as ever", weight: 3, make: |game| any_call(&mut game.0) },
    Call { name: "tie", weight: 2, make: add_link },
    Call { name: "edit a drive", weight: 2, make: edit_link },
    Call { name: "shoot", weight: 2, make: shoot },
    Call { name: "change a setting", weight: 2, make: change_setting },
    Call { name: "rest", weight: 20, make: |game| rest(game, |simulator, dt| simulator.update(dt)) },
];

impl GameWrapper for CalmPlane {
    type Inner = OneWayPlane;

    fn wrap(game: OneWayPlane) -> Self {
        CalmPlane(game)
    }
    fn calls() -> &'static [Call<Self>] {
        CALLS
    }
    fn inner(&self) -> &OneWayPlane {
        &self.0
    }
    fn inner_mut(&mut self) -> &mut OneWayPlane {
        &mut self.0
    }
}

impl CalmPlane {
    fn body(&mut self) -> Option<BodyId> {
        let count = self.simulator().bodies().count();
        let at = self.random().below(count);
        self.simulator().bodies().nth(at)
    }
}

/// Makes an object of a random mass.
fn create_thing(game: &mut CalmPlane) -> Outcome {
    let before = Engine::geoms(game.simulator());
    let outcome = game.0.create_thing();
    let mass = mass(game.random());
    let last = game.simulator().bodies().last();
    if Engine::geoms(game.simulator()) > before
        && let Some(body) = last.and_then(|last| game.simulator_mut().body_mut(last))
    {
        body.set_mass(mass).ok();
    }
    outcome
}

type AddLink = fn(&mut PhysicsSimulator, [BodyId; 2], &mut Random) -> Result<JointId>;

const LINKS: &[AddLink] = &[
    |simulator, [a, b], _| {
        let middle = (simulator[a].position() + simulator[b].position()) * 0.5;
        JointFactory::create_revolute_joint_in(simulator, a, b, middle)
    },
    |simulator, [a, b], _| {
        JointFactory::create_pin_joint_in(simulator, a, Vector2::zeros(), b, Vector2::zeros())
    },
    |simulator, [a, b], random| {
        let most = random.between(20.0, 200.0);
        JointFactory::create_slider_joint_in(simulator, a, Vector2::zeros(), b, Vector2::zeros(), 0.0, most)
    },
    |simulator, [a, b], _| {
        let middle = (simulator[a].position() + simulator[b].position()) * 0.5;
        let weld = JointFactory::create_weld_joint(simulator, a, b, middle)?;
        simulator.add(weld)?;
        Ok(weld)
    },
    |simulator, [a, _], random| {
        let anchor = simulator[a].position() + random.vector(40.0);
        JointFactory::create_fixed_revolute_joint_in(simulator, a, anchor)
    },
    create_driven,
    create_driven,
    create_driven,
];

/// Makes a joint with drives and adds it.
fn create_driven(
    simulator: &mut PhysicsSimulator,
    bodies: [BodyId; 2],
    random: &mut Random,
) -> Result<JointId> {
    let joint = create_driven_joint(simulator, bodies, random)?;
    simulator.add(joint)?;
    Ok(joint)
}

/// Edits the drives of a joint.
fn edit_link(game: &mut CalmPlane) -> Outcome {
    let joints = game.simulator().joint_list().to_vec();
    if joints.is_empty() {
        return Outcome::Queried;
    }
    let mut random = game.random().split();
    edit_drive(game.simulator_mut(), random.pick(&joints), &mut random).ok();
    Outcome::Changed
}

fn add_link(game: &mut CalmPlane) -> Outcome {
    let (Some(a), Some(b)) = (game.body(), game.body()) else { return Outcome::Queried };
    let mut random = game.random().split();
    // A created object exists even if the simulator refuses to add it.
    drop(random.pick(LINKS)(game.simulator_mut(), [a, b], &mut random));
    Outcome::Changed
}

/// A fast bullet in a random direction.
fn shoot(game: &mut CalmPlane) -> Outcome {
    let (Some(id), velocity) = (game.body(), game.random().vector(5000.0)) else { return Outcome::Queried };
    let is_bullet = game.random().chance(70);
    let Some(body) = game.simulator_mut().body_mut(id) else { return Outcome::Queried };
    body.set_is_bullet(is_bullet);
    body.set_linear_velocity(velocity);
    Outcome::Changed
}

const SETTINGS: &[fn(&mut PhysicsSimulator, &mut Random)] = &[
    |simulator, random| {
        let all = [SolverChoice::Auto, SolverChoice::Iterative, SolverChoice::Direct];
        simulator.set_solver_choice(random.pick(&all));
    },
    |simulator, random| simulator.set_sleep_enabled(random.chance(85)),
    // The faithful set refuses one-way geoms.
    |simulator, random| {
        let methods = if random.chance(30) { Methods::default() } else { Methods::PRECISE };
        simulator.set_methods(methods).ok();
    },
    |simulator, random| {
        let all: Vec<BodyId> = simulator.bodies().collect();
        if !all.is_empty() {
            lock_axes(simulator, random.pick(&all), random).ok();
        }
    },
    |simulator, random| simulator.set_gravity(random.vector(200.0)).unwrap_or_default(),
    |simulator, random| simulator.set_iterations(1 + random.below(8) as i32),
    |simulator, random| {
        let all: Vec<BodyId> = simulator.bodies().collect();
        if !all.is_empty() {
            simulator.wake(random.pick(&all));
        }
    },
];

fn change_setting(game: &mut CalmPlane) -> Outcome {
    let mut random = game.random().split();
    random.pick(SETTINGS)(game.simulator_mut(), &mut random);
    Outcome::Changed
}
