//! The scenes of the chart that have depth.

mod ball_pit;
mod conveyor;
mod throw;

use crate::charts::ChartScene;
use crate::scenes::depth::DepthScene;

/// A scene of the chart with depth; sizes are numbers of movable objects.
pub type DepthChartScene = ChartScene<DepthScene>;

/// All scenes of the chart with depth: the one place to add one.
pub fn depth_chart_scenes() -> Vec<DepthChartScene> {
    [&throw::SCENES[..], &conveyor::SCENES, &ball_pit::SCENES].concat()
}

/// Numbers of objects where size matters.
const SIZES: &[usize] = &[5, 20, 200, 2000];
