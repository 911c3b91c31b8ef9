//! Speed against accuracy, and where methods fail: what the programs `accuracy_vs_speed` and `stability_map` and the
//! tests of both share.
//!
//! A way to simulate is an entry of [`method::methods`]. A scene of a chart is an entry of [`charts::chart_scenes`]: [`trials`]
//! says with which settings it is run, [`sweep`] runs all against each other, [`csv`], [`plot`] and [`report`] tell what
//! came of it. What is driven until it fails is an entry of [`stability::families`], with maps of its own. [`depth`] has all
//! that for the 2.5D engine. Lengths are px, y points down, times are s, angles rad; where an engine needs metres, 32 px are one.

pub mod charts;
pub mod closed_forms;
pub mod csv;
pub mod depth;
pub mod error;
pub mod method;
pub mod origin;
pub mod ours;
#[cfg(feature = "peers")]
pub mod peers_2d;
pub mod penetration;
pub mod plot;
pub mod progress;
pub mod report;
pub mod stability;
pub mod stopwatch;
pub mod sweep;
pub mod trials;
pub mod world;
