//! The depth axis of the precise set, for engines such as `twohalf`; it may change with them.
//!
//! A 2D game needs nothing of this module. An engine with depth owns a [`PhysicsSimulator`](crate::PhysicsSimulator) and adds a
//! third axis to it by [`DepthAxisMut::enable`]. It sets positions, velocities and forces along z ([`DepthBodyState`]), depth
//! shapes of geoms ([`DepthShape`]), and boxes of the world that have no body ([`WorldBox`]). Axes: x and y (down) are those of
//! the core, z is depth; the ground is the plane y = 0.
//!
//! The stages of an update:
//!
//! 1. [`process_queues`](crate::PhysicsSimulator::process_queues) adds and removes objects;
//! 2. [`DepthAxisMut::step`] runs the other stages, with the callbacks of a [`DepthHandler`];
//! 3. [`DepthAxis::moved_bodies`], [`DepthAxis::newly_asleep_bodies`] and [`DepthAxis::moving_world_boxes`] are the result;
//! 4. [`DepthAxisMut::drain_contact_events`] reports contacts that began or ended, [`DepthAxis::contacts`] lists all.
//!
//! ```
//! use farseer_core::depth::{DepthAxis, DepthAxisMut, DepthBodyState};
//! use farseer_core::math::Vector2;
//! use farseer_core::{BodyFactory, PhysicsSimulator};
//!
//! let mut simulator = PhysicsSimulator::new(Vector2::zeros())?;
//! let body = BodyFactory::create_circle_body_in(&mut simulator, 10.0, 1.0)?;
//! DepthAxisMut::of(&mut simulator).enable(32.0)?;
//!
//! let drifting = DepthBodyState { velocity: 60.0, ..DepthBodyState::default() };
//! DepthAxisMut::of(&mut simulator).set_body(body, drifting);
//! simulator.process_queues(0.5, None);
//! DepthAxisMut::of(&mut simulator).step(0.5, None);
//!
//! let (moved, state) = DepthAxis::of(&simulator).moved_bodies().next().expect("the body is awake");
//! assert_eq!(moved, body);
//! // 60 units/s for half a second, less the drag of the body.
//! assert!((state.z - 30.0).abs() < 0.01);
//! # Ok::<(), farseer_core::Error>(())
//! ```

mod axis;
mod handler;

pub use axis::{DepthAxis, DepthAxisMut, DepthPath};
pub use handler::DepthHandler;

pub use crate::precise::depth_contact::{
    DepthContact, DepthContactEvent, DepthContactPoint, DepthContactTarget,
};
pub use farseer_precise::depth::interface::{
    DepthBodyState, DepthShape, DepthTarget, FilterNumbers, HingeFeature, VerticalShape, WorldBox,
    WorldBoxHinge, WorldBoxMotion,
};
