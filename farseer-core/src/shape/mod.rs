//! Outlines and boxes (behaviour chapters 05 and 15).
pub mod aabb;
mod boolean;
mod convex_hull;
mod creators;
mod cut_hole;
mod decompose;
pub(crate) mod distance;
mod ear_clipping;
mod edges;
mod feature;
mod footprint;
mod measures;
mod polygon_creation_assistance;
pub mod ray_helper;
mod simplify;
mod static_tools;
mod texture_outline;
mod texture_polygons;
mod texture_search;
mod triangulate;
pub mod vertices;
mod winding;

pub use aabb::Aabb;
pub use boolean::PolyUnionError;
pub use edges::{CrossingEdgeInfo, Edge, EdgeAlignment, EdgeIntersectInfo};
#[doc(hidden)]
pub use farseer_precise::slanted_box::{BoxTouch, Face, SlantedBox};
pub use feature::Feature;
pub use footprint::Footprint;
pub use polygon_creation_assistance::PolygonCreationAssistance;
pub use vertices::Vertices;
pub use winding::WindingOrder;
