//! State of a simulator of either engine.

use conformance::trace::hash::Fnv;
use examples::Result;
use farseer_core::Methods;

use crate::play::{Set, World, WorldMut};

/// Numbers of bodies and contacts, and the work of the last step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Number of bodies, static ones included.
    pub bodies: usize,
    /// Number of contact points.
    pub contacts: usize,
    /// Number of sleeping bodies.
    pub asleep: usize,
}

/// How much there is.
pub fn counts(world: World<'_>) -> Counts {
    match world {
        World::Plane(simulator) => {
            let counters = simulator.counters();
            let [contacts, asleep] = [counters.contacts_solved, counters.bodies_asleep];
            Counts { bodies: simulator.body_list().len(), contacts, asleep }
        }
        World::Depth(simulator) => {
            let contacts = simulator.counters().contacts_solved;
            let asleep = simulator.core().counters().bodies_asleep;
            Counts { bodies: simulator.body_list().len(), contacts, asleep }
        }
    }
}

/// A hash of all that a simulator is: equal if and only if all its bits are, up to chance.
pub fn hash(world: World<'_>) -> u64 {
    let mut hash = Fnv::EMPTY;
    hash.bytes(&match world {
        World::Plane(simulator) => simulator.snapshot(),
        World::Depth(simulator) => simulator.snapshot(),
    });
    hash.finish()
}

/// Whether the position, rotation and velocities of every movable body are finite.
pub fn is_finite(world: World<'_>) -> bool {
    match world {
        World::Plane(simulator) => simulator.body_list().iter().all(|&body| {
            let body = &simulator[body];
            let numbers = [body.position(), body.linear_velocity()].map(|vector| vector.x + vector.y);
            numbers.into_iter().chain([body.rotation(), body.angular_velocity()]).all(f32::is_finite)
        }),
        World::Depth(simulator) => simulator.body_list().iter().all(|&body| {
            simulator.body(body).is_some_and(|body| {
                let numbers =
                    [body.position3d(), body.velocity3d(), body.angular_velocity3d()].map(|v| v.sum());
                numbers.into_iter().chain([body.rotation()]).all(f32::is_finite)
            })
        }),
    }
}

/// Chooses a set of methods in mid-run.
///
/// # Errors
/// A feature of the scene that the other set lacks.
pub fn switch(world: WorldMut<'_>, set: Set) -> Result<()> {
    match world {
        WorldMut::Plane(simulator) => {
            let methods = match set {
                Set::Faithful => Methods::default(),
                Set::Precise => Methods::PRECISE,
            };
            simulator.set_methods(methods)?;
        }
        WorldMut::Depth(simulator) => simulator.set_depth_scheme(crate::scenes::scheme(set))?,
    }
    Ok(())
}
