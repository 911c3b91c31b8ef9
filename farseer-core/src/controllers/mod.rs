//! Controllers: they act on bodies in every update, before springs and gravity (behaviour chapter 12).
//!
//! Lengths are in the user's unit, screen y down; seconds unless milliseconds are named.

mod fluid_container;
mod fluid_drag;
mod gravity;
mod inactivity;
mod scaling;
mod wave;

use serde::{Deserialize, Serialize};

pub use fluid_container::{AabbFluidContainer, FluidContainer, FluidContainerRef};
pub use fluid_drag::FluidDragController;
pub use gravity::{GravityController, GravityType};
pub use inactivity::InactivityController;
pub use scaling::ScalingController;
pub use wave::WaveController;

crate::storage::arena::define_id! {
    /// Id of a [`Controller`], valid in the simulator that made it, in its clones and in simulators loaded from its
    /// saves.
    ControllerId
}

/// The kinds of controllers, with their settings.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[non_exhaustive]
pub enum ControllerKind {
    /// Geoms float in a fluid.
    FluidDrag(FluidDragController),
    /// Points and bodies attract bodies.
    Gravity(GravityController),
    /// Bodies that are slow for long are disabled.
    Inactivity(InactivityController),
    /// The time step grows when the machine is slow.
    Scaling(ScalingController),
    /// A water surface with waves.
    Wave(WaveController),
    /// The game's [`UserController`](crate::UserController) acts.
    UserDefined,
}

/// A controller acts on bodies in every update, before springs and gravity, in the order of the [controller
/// list](crate::PhysicsSimulator::controller_list) (behaviour chapter 12, sections 2 and 3).
///
/// ```
/// use farseer_core::{Controller, GravityController, PhysicsSimulator, math::Vector2};
///
/// let mut simulator = PhysicsSimulator::default();
/// let planet = GravityController::with_points(vec![Vector2::new(100.0, 0.0)], 5000.0, 400.0)?;
/// let planet = simulator.create_controller(planet)?;
/// simulator.add(planet)?;
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Controller {
    is_enabled: bool,
    tag: u64,
    kind: ControllerKind,
}

impl Controller {
    fn new(kind: ControllerKind) -> Self {
        Controller { is_enabled: true, tag: 0, kind }
    }

    /// A controller that calls a [`UserController`](crate::UserController) of the game. The game's
    /// [`EventHandler`](crate::EventHandler::user_controller) is asked for it in every update.
    pub fn user_defined() -> Self {
        Controller::new(ControllerKind::UserDefined)
    }

    /// Whether updates run the controller. Default true.
    #[doc(alias = "Enabled")]
    pub fn enabled(&self) -> bool {
        match &self.kind {
            ControllerKind::Scaling(scaling) => scaling.enabled(),
            _ => self.is_enabled,
        }
    }

    /// Sets whether updates run the controller. A disabled controller stays in its list.
    pub fn set_enabled(&mut self, enabled: bool) {
        match &mut self.kind {
            ControllerKind::Scaling(scaling) => scaling.set_enabled(enabled),
            _ => self.is_enabled = enabled,
        }
    }

    /// A number for the user's own purposes. Default 0.
    #[doc(alias = "Tag")]
    pub fn tag(&self) -> u64 {
        self.tag
    }

    /// Sets the user's number.
    pub fn set_tag(&mut self, tag: u64) {
        self.tag = tag;
    }

    /// Kind and settings of the controller. To edit them, see
    /// [`PhysicsSimulator::controller_as_mut`](crate::PhysicsSimulator::controller_as_mut).
    pub fn kind(&self) -> &ControllerKind {
        &self.kind
    }

    /// Kind and settings, to edit.
    pub(crate) fn kind_mut(&mut self) -> &mut ControllerKind {
        &mut self.kind
    }

    /// Whether every number is one that calls could have made. False only after loading corrupt data.
    pub(crate) fn is_valid(&self) -> bool {
        match &self.kind {
            ControllerKind::FluidDrag(controller) => controller.is_valid(),
            ControllerKind::Gravity(controller) => controller.is_valid(),
            ControllerKind::Inactivity(controller) => controller.is_valid(),
            ControllerKind::Scaling(controller) => controller.is_valid(),
            ControllerKind::Wave(controller) => controller.is_valid(),
            ControllerKind::UserDefined => true,
        }
    }
}

mod sealed {
    pub trait Sealed {}
}

/// The kinds of controllers, for [`PhysicsSimulator::controller_as`](crate::PhysicsSimulator::controller_as).
pub trait ControllerType: sealed::Sealed + Sized {
    /// Name of the kind, for messages.
    const NAME: &'static str;

    /// The controller as this kind, if it is one.
    fn of(controller: &Controller) -> Option<&Self>;

    /// The same, to edit.
    fn of_mut(controller: &mut Controller) -> Option<&mut Self>;
}

macro_rules! controller_types {
    ($($kind:ident: $controller:ident;)*) => {$(
        impl sealed::Sealed for $controller {}

        impl ControllerType for $controller {
            const NAME: &'static str = stringify!($controller);

            fn of(controller: &Controller) -> Option<&Self> {
                match &controller.kind {
                    ControllerKind::$kind(this) => Some(this),
                    _ => None,
                }
            }

            fn of_mut(controller: &mut Controller) -> Option<&mut Self> {
                match &mut controller.kind {
                    ControllerKind::$kind(this) => Some(this),
                    _ => None,
                }
            }
        }

        impl From<$controller> for Controller {
            fn from(controller: $controller) -> Self {
                Controller::new(ControllerKind::$kind(controller))
            }
        }
    )*};
}

controller_types! {
    FluidDrag: FluidDragController;
    Gravity: GravityController;
    Inactivity: InactivityController;
    Scaling: ScalingController;
    Wave: WaveController;
}
