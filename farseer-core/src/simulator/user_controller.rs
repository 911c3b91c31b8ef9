//! Controllers that the game implements.

use super::Context;
use crate::controllers::ControllerId;

/// A [user-defined](crate::Controller::user_defined) controller of the game (behaviour chapter 12, section 3).
///
/// It belongs to the game, which returns it from
/// [`EventHandler::user_controller`](crate::EventHandler::user_controller), so that saving the simulator saves all
/// state that belongs to the simulator.
#[doc(alias = "Controller")]
pub trait UserController {
    /// Called in list order in every update, after collision detection and before springs and gravity, if the
    /// controller is enabled. `dt` is the step in seconds, `dt_real` the real time of the update in seconds, 0 by
    /// default.
    #[doc(alias = "Update")]
    fn update(&mut self, context: &mut Context<'_>, controller: ControllerId, dt: f32, dt_real: f32);

    /// Called at the start of every update, also with a step of 0, a disabled simulator or a disabled controller.
    /// Objects disposed here leave in this update.
    #[doc(alias = "Validate")]
    fn validate(&mut self, context: &mut Context<'_>, controller: ControllerId) {
        let _ = (context, controller);
    }
}
