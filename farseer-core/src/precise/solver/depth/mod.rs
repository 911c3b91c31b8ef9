//! Depth axis of the precise set: collision and contacts in three axes, for an engine with depth (`twohalf`) on top.
//!
//! Axes: x right, y down, z into the picture. A body moves along z as along x and y: z is component 3 of its velocity and of
//! its displacement. Bodies rotate in the plane of x and y only, except spheres, which rotate about all axes.
//!
//! | stage | files |
//! |---|---|
//! | input of the engine above, output to it | [`interface`], [`body_state`], [`geom_shapes`] |
//! | broad phase: cells over x and z, intervals along z | [`state`], [`world_boxes`] |
//! | continuous collision | [`continuous_collision`] |
//! | narrow phase: prisms along z, spheres, ground | [`prism_collision`], [`sphere_sphere`], [`sheared_box`] |
//! | narrow phase: vertical shapes (cylinder, capsule, prism along y) | [`vertical_dispatch`] and `vertical_*` |
//! | contact constraints with two tangents, friction | [`friction_3d`], [`step`] |
//! | ground and boxes without a geom | [`world_boxes`], [`hinged_box`], [`one_way`] |
//!
//! The engine above owns depth positions, shapes and world boxes. It passes changes of these to the precise set before each
//! update.

pub(in crate::precise) mod body_state;
mod contact_patch;
pub(in crate::precise) mod contact_point;
mod continuous_collision;
pub(crate) mod feature_gate;
mod fixed_rotation;
mod footprint;
pub(crate) mod footprint_corners;
pub(in crate::precise) mod friction_3d;
mod geom_shapes;
pub(in crate::precise) mod hinged_box;
mod hinged_box_state;
pub(crate) mod interface;
pub(in crate::precise) mod one_way;
pub(in crate::precise) mod owner;
mod predicted_miss;
pub(in crate::precise) mod prism_collision;
pub(crate) mod shape_distance;
mod sheared_box;
pub(in crate::precise) mod sphere_sphere;
pub(crate) mod state;
pub(in crate::precise) mod step;
mod vertical_dispatch;
mod vertical_prism;
mod vertical_shapes;
mod vertical_sheared_box;
pub(in crate::precise) mod world_box_shape;
pub(in crate::precise) mod world_boxes;
