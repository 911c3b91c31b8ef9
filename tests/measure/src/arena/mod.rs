//! The arena: scenes of Box2D's benchmark, which are independent of this workspace, at any size in any engine.
//!
//! [`scenes()`] describes the scenes once for all [`engines()`]. [`Play`] runs a scene in an engine, and [`judge()`]
//! measures its final state by the same geometry for every engine. [`run`] times engines by turns.

#[cfg(feature = "peers")]
mod box2d;
mod engine;
mod judge;
mod ours;
mod play;
pub mod run;
mod scene;
mod scenes;

pub use engine::{BOX2D, Counters, DT, Engine, EngineEntry, OURS, Result, State, engines};
pub use judge::{Verdict, judge};
pub use play::Play;
pub use scene::{Action, Body, Filter, Form, Joint, Kind, Limits, Point, Scene, Script, Shape};
pub use scenes::{SceneEntry, scenes};
