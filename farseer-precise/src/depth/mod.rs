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
//! | solids, and margins of a pair | [`posed_solid`] |
//! | narrow phase: prisms along z, spheres, ground | [`prism_collision`], [`sphere_sphere`], [`sheared_box`] |
//! | narrow phase: vertical shapes (cylinder, capsule, prism along y) | [`vertical_dispatch`] and `vertical_*` |
//! | contact constraints with two tangents, friction | [`friction_3d`], [`step`] |
//! | ground and boxes without a geom | [`world_boxes`], [`hinged_box`], [`one_way`] |
//!
//! The engine above owns depth positions, shapes and world boxes. It passes changes of these to the precise set before each
//! update.

pub mod body_state;
pub mod contact_patch;
pub mod contact_point;
pub mod continuous_collision;
pub mod feature_gate;
pub mod fixed_rotation;
pub mod footprint;
pub mod friction_3d;
pub mod geom_shapes;
pub mod hinged_box;
pub mod hinged_box_state;
pub mod interface;
pub mod one_way;
pub mod owner;
pub mod posed_solid;
pub mod predicted_miss;
pub mod prism_collision;
pub mod shape_distance;
pub mod sheared_box;
pub mod sphere_sphere;
pub mod state;
pub mod step;
pub mod vertical_dispatch;
pub mod vertical_prism;
pub mod vertical_shapes;
pub mod vertical_sheared_box;
pub mod vertical_solid;
pub mod world_box_shape;
pub mod world_boxes;
