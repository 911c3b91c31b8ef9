//! Joints in three axes.
//!
//! Bodies do not rotate about x or y. So a joint that keeps a point has one more row than in 2D: its bodies have the same z
//! velocity, which [`z_groups`] solves exactly. A distance joint is different, since its direction has a z component.
//!
//! Connected joints with a distance joint among them form a `SpatialJointGroup`, [built](build) when the list of joints
//! changes. Its [rows](constraint_row) are solved together with a [sparse factorisation](sparse_ldlt). All other joints keep
//! the articulations and rows of 2D.

pub mod build;
pub mod constraint_row;
pub mod free_step;
pub mod group_solver;
pub mod joint_state;
pub mod row_kind;
pub mod sparse_ldlt;
pub mod z_groups;

pub(super) use build::spatial_groups;
pub(super) use group_solver::SpatialJointGroup;
pub(super) use z_groups::ZGroup;
