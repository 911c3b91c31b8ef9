//! The same for the 2.5D engine: its scenes, the methods that run them, and what is measured.
//!
//! Chart scenes are entries of [`depth_chart_scenes`], families entries of [`depth_families`], methods entries of
//! [`depth_methods`]. What comes of a run is a point of the same [`sweep`](super::sweep) and a cell of the same
//! [`map`](super::stability::map) as those of the 2D engine, so that the same code draws and reports it.
//!
//! Scenes are those of [`crate::scenes::depth`]: px, X to the right, Y up, Z into the picture, gravity 100 px/s².

mod charts;
mod families;
#[cfg(feature = "peers")]
pub mod fields;
mod method;
mod planes;

pub use charts::{DepthChartScene, depth_chart_scenes};
pub use families::{DepthFamily, depth_families};
pub use method::{DepthMethod, depth_methods, depth_peer_versions};
pub use planes::{PLANE_SCENE, PLANES, plane_methods, plane_point, plane_sizes, time_per_step};
