//! The border: every call enters the engine here, and no panic leaves it.

use std::mem::MaybeUninit;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Mutex, MutexGuard};

use farseer_core::PhysicsSimulator;

use crate::failure::{Failure, FarseerStatus, Outcome};

/// A simulator. Threads may share it: its calls wait for each other.
#[derive(Debug)]
pub struct FarseerSimulator {
    /// A panic poisons the mutex, which then refuses all further calls.
    world: Mutex<World>,
}

/// The content of a simulator's handle.
#[derive(Debug)]
pub(crate) struct World {
    pub(crate) simulator: PhysicsSimulator,
    /// The last snapshot, until the caller copies it.
    pub(crate) snapshot: Vec<u8>,
}

impl FarseerSimulator {
    pub(crate) fn new(simulator: PhysicsSimulator) -> Self {
        FarseerSimulator { world: Mutex::new(World { simulator, snapshot: Vec::new() }) }
    }

    fn lock(&self) -> Outcome<MutexGuard<'_, World>> {
        self.world.lock().map_err(|_| Failure::panicked_before())
    }
}

/// Runs the work of a call. A refusal or a panic becomes a status.
pub(crate) fn answer(act: impl FnOnce() -> Outcome) -> FarseerStatus {
    // A simulator whose work panics is used no more, so that no broken state is seen.
    match catch_unwind(AssertUnwindSafe(act)) {
        Ok(Ok(())) => FarseerStatus::Ok,
        Ok(Err(failure)) => failure.report(),
        Err(payload) => Failure::panicked(&*payload).report(),
    }
}

/// Runs the work of a call with a simulator.
pub(crate) fn with(
    simulator: Option<&FarseerSimulator>,
    act: impl FnOnce(&mut World) -> Outcome,
) -> FarseerStatus {
    answer(|| {
        let simulator = simulator.ok_or_else(|| Failure::null("simulator"))?;
        act(&mut *simulator.lock()?)
    })
}

/// Like [`with`], for a call with one result. A null pointer for it, named `argument`, is refused before any work.
pub(crate) fn write<T>(
    simulator: Option<&FarseerSimulator>,
    argument: &'static str,
    result: Option<&mut MaybeUninit<T>>,
    act: impl FnOnce(&mut World) -> Outcome<T>,
) -> FarseerStatus {
    with(simulator, |world| {
        let result = result.ok_or_else(|| Failure::null(argument))?;
        result.write(act(world)?);
        Ok(())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::failure::farseer_last_error;
    use crate::tests::{last_error, simulator};

    #[test]
    fn a_panic_becomes_a_status_and_the_simulator_refuses_further_calls() {
        let simulator = simulator();
        let quiet = std::panic::take_hook();
        std::panic::set_hook(Box::new(|_| {}));
        let status = with(Some(&simulator), |_| panic!("broken on purpose"));
        std::panic::set_hook(quiet);
        assert_eq!(status, FarseerStatus::Panicked);
        assert_eq!(last_error(), "the engine panicked: broken on purpose");

        assert_eq!(with(Some(&simulator), |_| Ok(())), FarseerStatus::Panicked);
        assert_eq!(last_error(), "the simulator panicked in an earlier call: destroy it");
        crate::simulator::farseer_simulator_destroy(Some(simulator));
    }

    #[test]
    fn a_null_simulator_and_a_null_result_are_refused() {
        assert_eq!(with(None, |_| Ok(())), FarseerStatus::NullPointer);
        assert_eq!(last_error(), "simulator is a null pointer");
        let simulator = simulator();
        let status = write::<f32>(Some(&simulator), "mass", None, |_| panic!("it must not be run"));
        assert_eq!(status, FarseerStatus::NullPointer);
        assert_eq!(last_error(), "mass is a null pointer");
    }

    #[test]
    fn threads_share_a_simulator_and_have_messages_of_their_own() {
        let simulator = simulator();
        with(None, |_| Ok(()));
        std::thread::scope(|scope| {
            scope.spawn(|| {
                assert_eq!(last_error(), "");
                assert_eq!(with(Some(&simulator), |_| Ok(())), FarseerStatus::Ok);
            });
        });
        assert_eq!(last_error(), "simulator is a null pointer");
        assert!(!farseer_last_error().is_null());
    }
}
