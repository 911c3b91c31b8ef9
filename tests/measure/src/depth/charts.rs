//! The 2.5D scenes that are charted.

mod ball_pit;
mod conveyor;
mod throw;

use crate::charts::ChartScene;
use crate::scenes::depth::DepthScene;

/// A 2.5D scene that is charted; its sizes are numbers of movable objects.
pub type DepthChartScene = ChartScene<DepthScene>;

/// Returns all 2.5D scenes that are charted, in the order of the charts. New scenes are added here.
pub fn depth_chart_scenes() -> Vec<DepthChartScene> {
    [&throw::SCENES[..], &conveyor::SCENES, &ball_pit::SCENES].concat()
}

/// Numbers of movable objects of scenes that are measured at several sizes.
const SIZES: &[usize] = &[5, 20, 200, 2000];
