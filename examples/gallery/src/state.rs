//! What is known of a simulator, whichever engine it is.

use conformance::trace::hash::Fnv;
use examples::Result;
use farseer_core::Methods;

use crate::play::{Set, World, WorldMut};

/// How much there is, and what the last step had to do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Bodies, those that do not move among them.
    pub bodies: usize,
    /// Contact points.
    pub contacts: usize,
    /// Bodies that sleep.
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

/// Whether everything that moves has a place, a rotation and velocities.
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
/// What the other set does not have.
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
