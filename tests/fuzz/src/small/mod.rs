//! Tests small scenes of the precise set: no body leaves its room, momentum is conserved and energy does not grow.

mod scene;

use crate::engine::Engine;
use farseer_core::{BodyId, Event};
use scene::Scene;

/// Number of updates of a scene.
const UPDATES: usize = 300;

/// Greatest change of the total momentum in a scene without walls, as a fraction of the greatest momentum of a single body.
/// Measured in 100,000 scenes: at most 6e-5. Their up to twelve bodies make 300 updates in up to 8 substeps, each with rounding
/// errors of 6e-8.
const MAX_MOMENTUM_CHANGE: f64 = 1.2e-4;

/// Greatest rotation of a body in a step, radians, for which walls must hold it: an eighth of a turn. A body that turns by half
/// a turn in a step shows the same corners to a wall in every step. Each time these corners leave the wall, and its centre
/// moves on through the wall.
const MAX_ROTATION_PER_STEP: f32 = std::f32::consts::FRAC_PI_4;

/// Greatest ratio of the energy of a scene without restitution to its initial energy; the next constant is that with
/// restitution.
///
/// Without restitution energy only comes from overlaps that are resolved, and from rounding. Measured in 50,000 scenes that
/// begin with more than the [`SLACK`]: at most 1.1.
///
/// With restitution energy can grow. Newton's law of restitution, applied to one contact after the other, does not conserve
/// energy where a body is hit in several places at once. Measured in 50,000 scenes: at most 29. Only two of them have more than
/// 1.5: one or two concave bodies bounce there for long without any loss.
const MAX_ENERGY_RATIO: f64 = 1.15;
const MAX_BOUNCING_ENERGY_RATIO: f64 = 32.0;
/// Velocity of all bodies, px/s, that the resolution of overlaps may leave behind.
const SLACK: f64 = 2.0;

/// Simulates the scene of a seed and checks its invariants.
///
/// - Every number is finite.
/// - No body is further behind the face of a wall than it moves in a step.
/// - Momentum is conserved in scenes without static bodies.
/// - Energy does not grow.
///
/// # Errors
/// Names the first violated invariant, and the update after which it is violated.
pub fn small_scene_holds(seed: u64) -> Result<(), String> {
    let mut scene = Scene::new(seed).map_err(|error| error.to_string())?;
    let mut bounds = Bounds::of(&scene);
    for update in 1..=UPDATES {
        scene.simulator.update(scene.dt);
        bounds.check(&scene).map_err(|what| format!("update {update}: {what}"))?;
    }
    scene.simulator.check_numbers()
}

/// Bounds of a scene's invariants: energy, and the momentum that is conserved.
struct Bounds {
    energy: f64,
    momentum: [f64; 2],
    /// Greatest momentum of a single body so far, mass units * length units/s.
    greatest_momentum: f64,
    /// Greatest distance that a body has moved in a step so far, px.
    way: f32,
    /// Whether each body has turned in a step by more than [`MAX_ROTATION_PER_STEP`]. Walls need not hold such a body.
    have_spun: Vec<bool>,
}

impl Bounds {
    fn of(scene: &Scene) -> Self {
        let factor = if scene.bounces { MAX_BOUNCING_ENERGY_RATIO } else { MAX_ENERGY_RATIO };
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
            *has_spun |= body.angular_velocity().abs() * scene.dt > MAX_ROTATION_PER_STEP;
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
        if scene.room.is_none() && change > MAX_MOMENTUM_CHANGE * self.greatest_momentum {
            return Err(format!("momentum has changed by {change}"));
        }
        Ok(())
    }
}

fn is_failure(event: &Event) -> bool {
    matches!(event, Event::NotFinite { .. } | Event::RejectedInput { .. })
}

/// Returns the total momentum of all bodies, mass units * length units/s, along x and y. Sums in double precision, so that the
/// sum adds no error.
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
