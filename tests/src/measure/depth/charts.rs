//! The scenes of the chart that have depth.

mod ball_pit;
mod conveyor;
mod throw;

use super::DepthWatch;
use crate::depth_scenes::DepthScene;

/// A scene of the chart with depth, with what is measured in it.
#[derive(Debug, Clone, Copy)]
pub struct DepthChartScene {
    /// Such as `ball_pit_penetration`.
    pub name: &'static str,
    /// One sentence.
    pub about: &'static str,
    /// Numbers of movable objects; 0 alone where size does not matter.
    pub sizes: &'static [usize],
    /// Makes the scene of a size.
    pub build: fn(usize) -> DepthScene,
    /// Simulated time in s.
    pub seconds: f64,
    /// Makes what watches the scene.
    pub watch: fn(&DepthScene) -> Box<dyn DepthWatch>,
    /// What the error is, for the axis.
    pub error: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// The error a game would accept.
    pub tolerance: f64,
}

/// All scenes of the chart with depth: the one place to add one.
pub fn depth_chart_scenes() -> Vec<DepthChartScene> {
    [&throw::SCENES[..], &conveyor::SCENES, &ball_pit::SCENES].concat()
}

/// Numbers of objects where size matters.
const SIZES: &[usize] = &[5, 20, 200, 2000];
