//! Joints in three axes.
//!
//! Nothing turns bodies about the axes of the plane. So a joint that keeps a point has one thing to do more than in the plane:
//! its bodies move along the depth axis as [one](tied). A distance is another matter: its direction leads out of the plane.
//! What hangs together by joints and has a distance among them is a [group](group) of its own ([planned](plan) once), whose [rows](row) are solved
//! at once with a [sparse](sparse) matrix; trees of joints in the plane remain what they are.

mod group;
mod plan;
mod row;
mod sparse;
mod swing;
mod tied;

pub(super) use group::SpatialGroup;
pub(super) use plan::spatial_groups;
pub(super) use tied::Tied;
