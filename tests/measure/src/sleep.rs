//! Sleep: the cost of a world at rest, the bodies that wake when one lands or is pushed, and the time until all sleep again.
//!
//! [`heaps`] measures many heaps far from each other, [`pushes`] a pyramid that is pushed at its foot. Every method that
//! [sleeps](Method::sleeps) is run with its recommended setting and its default rule of sleeping.

pub mod heaps;
pub mod pushes;

use super::method::Method;
use super::scenes::movable;
use super::world::World;
use conformance::scene::Scene;

/// Simulated time in s after which a run with awake bodies is ended.
const PATIENCE: f64 = 60.0;

/// World of a scene in an engine, with sleep enabled, and the method that built it.
struct Sleeper {
    method: &'static str,
    world: Box<dyn World>,
    /// Indices of the dynamic bodies.
    movable: Vec<usize>,
    /// Time step in s.
    dt: f32,
}

impl Sleeper {
    fn new(method: &Method, scene: &Scene) -> Result<Self, String> {
        let mut world = (method.build)(scene, method.recommended)?;
        world.set_sleep_enabled(true);
        let dt = method.recommended.dt.mean();
        Ok(Sleeper { method: method.name, world, movable: movable(scene), dt })
    }

    /// Returns the indices of the dynamic bodies that sleep.
    fn asleep(&self) -> impl Iterator<Item = usize> + '_ {
        self.movable.iter().copied().filter(|&index| self.world.is_asleep(index))
    }

    /// Steps until all dynamic bodies sleep, and returns the simulated time in s; `None` if some are awake after 60 s. `see`
    /// is called after each step with the time in s and this object.
    fn fall_asleep(&mut self, mut see: impl FnMut(f64, &Self)) -> Option<f64> {
        let dt = f64::from(self.dt);
        for step in 1..=(PATIENCE / dt).round() as u32 {
            self.world.step(self.dt);
            let time = f64::from(step) * dt;
            see(time, self);
            if self.asleep().count() == self.movable.len() {
                return Some(time);
            }
        }
        None
    }
}

/// Returns those of `methods` whose bodies can sleep.
pub fn sleepers(methods: Vec<Method>) -> Vec<Method> {
    methods.into_iter().filter(|method| method.sleeps).collect()
}

/// Rounds a value to three decimals, in any unit.
fn rounded(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0
}
