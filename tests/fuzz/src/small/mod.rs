//! Small scenes of the precise set: nothing leaves its room, and momentum and energy come from nowhere.

mod scene;

use crate::engine::Engine;
use farseer_core::{BodyId, Event};
use scene::Scene;

/// Updates of a scene.
const UPDATES: usize = 300;

/// Momentum in the open may change by this part of the greatest momentum that a single body has had: 6e-5 is the most in
/// 100,000 scenes, where up to twelve bodies are pushed 300 times in up to 8 substeps, each time with roundings of 6e-8.
const MOMENTUM: f64 = 1.2e-4;

/// How far a body may turn in a step for walls to hold it: an eighth of a turn. What turns by half a turn in a step shows a
/// wall the same corners at every look, while they leave it, and its centre goes on through.
const FURTHEST_TURN: f32 = std::f32::consts::FRAC_PI_4;

/// How many times the energy it began with a scene may have.
///
/// Without restitution energy only comes from overlaps that are undone, and from roundings: 1.1 times is the most in 50,000
/// scenes that begin with more than the [`SLACK`]. With restitution energy can be won: Newton's law, applied to one contact
/// after the other, is no law of energy where a body is hit in several places at once. 29 times is the most in 50,000 scenes,
/// and only in two of them more than 1.5 times, where one or two concave bodies bounce for long without any loss.
const ENERGY: f64 = 1.15;
const BOUNCING_ENERGY: f64 = 32.0;
/// Velocity in px/s that overlaps which are undone may leave to everything.
const SLACK: f64 = 2.0;

/// A scene of a seed holds what it must: every number is finite, no body is further behind the face of a wall than it can
/// have come in a step, momentum stays where nothing stands still, and energy does not grow.
///
/// # Errors
/// What does not hold, and after how many updates.
pub fn small_scene_holds(seed: u64) -> Result<(), String> {
    let mut scene = Scene::new(seed).map_err(|error| error.to_string())?;
    let mut bounds = Bounds::of(&scene);
    for update in 1..=UPDATES {
        scene.simulator.update(scene.dt);
        bounds.check(&scene).map_err(|what| format!("update {update}: {what}"))?;
    }
    scene.simulator.check_numbers()
}

/// What a scene must not leave.
struct Bounds {
    energy: f64,
    momentum: [f64; 2],
    /// The greatest of a single body so far.
    greatest_momentum: f64,
    /// The furthest of a step so far.
    way: f32,
    /// Bodies that have turned too far in a step to be held by walls.
    have_spun: Vec<bool>,
}

impl Bounds {
    fn of(scene: &Scene) -> Self {
        let factor = if scene.bounces { BOUNCING_ENERGY } else { ENERGY };
        let mass: f64 = scene.bodies.iter().map(|&body| f64::from(scene.simulator[body].mass())).sum();
        let energy = factor * scene.energy() + 0.5 * mass * SLACK * SLACK;
        let have_spun = vec![false; scene.bodies.len()];
        let mut bounds =
            Bounds { energy, momentum: momentum(scene), greatest_momentum: 0.0, way: 0.0, have_spun };
        bounds.note(scene);
        bounds
    }

    fn note(&mut self, scene: &Scene) {
        for (&body, has_spun) in scene.bodies.iter().zip(&mut self.have_spun) {
            let body = &scene.simulator[body];
            *has_spun |= body.angular_velocity().abs() * scene.dt > FURTHEST_TURN;
            let speed = body.linear_velocity().norm();
            self.way = self.way.max(speed * scene.dt);
            self.greatest_momentum = self.greatest_momentum.max(f64::from(body.mass() * speed));
        }
    }

    fn check(&mut self, scene: &Scene) -> Result<(), String> {
        self.note(scene);
        if let Some(event) = scene.simulator.events().iter().find(|event| is_failure(event)) {
            return Err(format!("{event:?}"));
        }
        let energy = scene.energy();
        let is_held = |&(_, &has_spun): &(&BodyId, &bool)| !has_spun;
        let depths =
            scene.bodies.iter().zip(&self.have_spun).filter(is_held).map(|(&body, _)| scene.depth(body));
        let depth = depths.fold(f32::NEG_INFINITY, f32::max);
        if depth > self.way {
            return Err(format!("a body is {depth} px behind the face of a wall, a step is {} px", self.way));
        }
        if energy.is_nan() || energy > self.energy {
            return Err(format!("an energy of {energy}, {} is allowed", self.energy));
        }
        let change = distance(momentum(scene), self.momentum);
        if scene.room.is_none() && change > MOMENTUM * self.greatest_momentum {
            return Err(format!("momentum has changed by {change}"));
        }
        Ok(())
    }
}

fn is_failure(event: &Event) -> bool {
    matches!(event, Event::NotFinite { .. } | Event::RejectedInput { .. })
}

/// Of all bodies, in double precision, so that summing adds no error of its own.
fn momentum(scene: &Scene) -> [f64; 2] {
    let of = |&body: &BodyId| {
        let body = &scene.simulator[body];
        let velocity = body.linear_velocity();
        [velocity.x, velocity.y].map(|component| f64::from(body.mass()) * f64::from(component))
    };
    scene.bodies.iter().map(of).fold([0.0; 2], |[x, y], [dx, dy]| [x + dx, y + dy])
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}
