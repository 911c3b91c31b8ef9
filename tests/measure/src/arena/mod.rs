//! The arena: the scenes of Box2D's own benchmark, which nobody of this workspace made, at any size in any engine.
//!
//! [`scenes()`] describes them once for all [`engines()`], [`Play`] plays one in an engine, [`judge()`] judges what it came to by the
//! same geometry for every engine, and [`run`] times engines by turns.

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
