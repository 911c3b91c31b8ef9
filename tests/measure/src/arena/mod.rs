//! The arena: scenes of Box2D's benchmark, large worlds and random scenes in any engine.
//!
//! [`scenes()`] describes the scenes once for all [`engines()`]. [`Play`] runs a scene in an engine, and [`judge()`]
//! measures its final state by the same geometry for every engine. [`run`] times engines by turns; [`queries`], [`changes`]
//! and [`memory`] measure large worlds. [`random`] compares engines in scenes that a seed determines.

#[cfg(feature = "peers")]
mod box2d;
pub mod changes;
mod engine;
mod joint;
mod judge;
pub mod memory;
mod ours;
mod play;
pub mod queries;
pub mod random;
#[cfg(feature = "peers")]
mod rapier;
pub mod run;
mod scene;
mod scenes;

pub use engine::{BOX2D, Counters, DT, Engine, EngineEntry, OURS, RAPIER, Result, State, engines};
pub use joint::{Joint, JointKind};
pub use judge::{Verdict, judge};
pub use play::Play;
pub use scene::{Action, Body, Filter, Form, Kind, Limits, Point, Scene, Script, Shape};
pub use scenes::{SceneEntry, scenes, tiles, worlds};
