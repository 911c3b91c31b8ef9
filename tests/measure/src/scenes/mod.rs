//! Scenes made by code, for charts, families, tests and benchmarks.

pub mod depth;
pub(crate) mod stage;

use conformance::scene::Scene;

/// Returns the indices of the bodies that are not static.
pub(crate) fn movable(scene: &Scene) -> Vec<usize> {
    let is_movable = |&index: &usize| scene.bodies[index].is_static != Some(true);
    (0..scene.bodies.len()).filter(is_movable).collect()
}
