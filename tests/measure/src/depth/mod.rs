//! Scenes, methods and measurements of the 2.5D engine.
//!
//! Chart scenes are entries of [`depth_chart_scenes`], families entries of [`depth_families`], methods entries of
//! [`depth_methods`]. The outcome of a run is a point of the same [`sweep`](super::sweep) and a cell of the same
//! [`map`](super::stability::map) as those of the 2D engine, so that the same code draws and reports it.
//!
//! Scenes are built by [`crate::scenes::depth`]. Lengths are px; X points to the right, Y up, Z into the picture; gravity
//! is 100 px/s².

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
