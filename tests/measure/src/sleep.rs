//! Sleep: what a world costs in which all is at rest, who wakes when something lands or pushes, and when all rest again.
//!
//! [`heaps`] are many heaps far from each other, [`pushes`] a pyramid that is pushed at its foot. Every method that
//! [lets things sleep](Method::sleeps) is run as recommended, with its own rule of when that is.

pub mod heaps;
pub mod pushes;

use super::method::Method;
use super::scenes::movable;
use super::world::World;
use conformance::scene::Scene;

/// For how long a scene may stay awake, in s of the simulation, before it is given up.
const PATIENCE: f64 = 60.0;

/// A scene in an engine that lets things sleep.
struct Sleeper {
    method: &'static str,
    world: Box<dyn World>,
    /// The bodies that can move.
    movable: Vec<usize>,
    /// In s.
    dt: f32,
}

impl Sleeper {
    fn new(method: &Method, scene: &Scene) -> Result<Self, String> {
        let mut world = (method.build)(scene, method.recommended)?;
        world.set_sleep_enabled(true);
        let dt = method.recommended.dt.mean();
        Ok(Sleeper { method: method.name, world, movable: movable(scene), dt })
    }

    /// Those that sleep.
    fn asleep(&self) -> impl Iterator<Item = usize> + '_ {
        self.movable.iter().copied().filter(|&index| self.world.is_asleep(index))
    }

    /// Steps until all sleep, and gives the time it took in s; nothing if it is given up. All is looked at after each step.
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

/// All methods that let things sleep.
pub fn sleepers(methods: Vec<Method>) -> Vec<Method> {
    methods.into_iter().filter(|method| method.sleeps).collect()
}

/// With as many decimals as are worth writing down.
fn rounded(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0
}
