//! Measures of scenes that should come to rest: overlaps, remaining speeds, and whether a structure still stands.

use super::super::penetration::Shapes;
use super::ChartScene;
use super::build::start;
use crate::scenes::movable;
use crate::watch::{Maximum, Watch, failing, greatest, last, mean_speed, worst};
use crate::world::{World, distance};
use conformance::scene::Scene;

/// Duration in s of the interval at the end of a run in which errors are measured.
const WINDOW: f64 = 1.0;
/// Number of times in the last second at which overlaps are computed: sinking is slow and the computation expensive.
const OVERLAP_SAMPLES: f64 = 10.0;

/// Name of a chart's scene, and the function that makes its watch.
type Measure = (&'static str, fn(&Scene) -> Box<dyn Watch>);

/// Returns the charts of a structure that should stand: by overlap, by height and by speed. Each has the name and the watch
/// that are given.
pub(super) fn charts_of_rest(
    overlap: ChartScene,
    (height, watch_height): Measure,
    (speed, watch_speed): Measure,
) -> [ChartScene; 3] {
    let height = ChartScene {
        name: height,
        watch: watch_height,
        error: "error of the height at the end",
        unit: "%",
        // The tolerance is a percentage, since every contact yields slightly. In a tower of any number of boxes, each is then
        // lower by a hundredth of a box relative to the box below, which is invisible.
        tolerance: 1.0,
        ..overlap
    };
    let speed = ChartScene {
        name: speed,
        watch: watch_speed,
        error: "fastest speed at the end",
        unit: "px/s",
        // 5 px/s is the velocity that gravity adds in a step of 1/60 s. The speed of resting bodies varies by it from step to
        // step, which moves no body by a tenth of a pixel.
        tolerance: 5.0,
        ..overlap
    };
    [overlap, height, speed]
}

/// A function that returns the reason why a structure has failed; `None` while it stands.
pub(super) type RuinCheck = Box<dyn Fn(&dyn World) -> Option<&'static str>>;

/// Returns the condition of failure of a structure: a body is more than `slack` px away from its start.
pub(super) fn toppled(scene: &Scene, slack: f64) -> RuinCheck {
    let places: Vec<(usize, [f64; 2])> =
        movable(scene).into_iter().map(|index| (index, start(scene, index))).collect();
    let has_left = move |world: &dyn World, &(index, start): &(usize, [f64; 2])| {
        distance(world.body(index).position_in_plane(), start) > slack
    };
    Box::new(move |world| places.iter().any(|place| has_left(world, place)).then_some("toppled"))
}

/// Returns the index of the body that was built highest and the initial height of its centre above 0 in px; `None` without
/// movable bodies.
fn top(scene: &Scene) -> Option<(usize, f64)> {
    let bodies = movable(scene).into_iter().map(|index| (index, -start(scene, index)[1]));
    // Of two bodies at one height, the first counts.
    bodies.reduce(|top, other| if other.1 > top.1 { other } else { top })
}

/// Returns the initial height in px, above 0, of the centre of the body that was built highest. It serves for scenes whose
/// bodies touch without overlap.
pub(super) fn built_height(scene: &Scene) -> f64 {
    top(scene).map_or(f64::NAN, |(_, height)| height)
}

/// A scene that should be at rest after `seconds` s, and its condition of failure.
#[derive(Clone, Copy)]
pub(super) struct Rest {
    pub seconds: f64,
    /// Condition of failure. It is tested in the last second alone, because a structure that has failed stays failed.
    pub ruin: fn(&Scene) -> RuinCheck,
}

impl Rest {
    /// Returns a watch of the height error: the final height of the body that was built highest against its height without
    /// overlaps, in percent of the latter. `height` is the height without overlaps: of that body's centre above 0, px.
    pub(super) fn height(self, scene: &Scene, height: f64) -> Box<dyn Watch> {
        let top = top(scene);
        let error = move |_: f64, world: &dyn World| {
            let is = -world.body(top?.0).position[1];
            Some(100.0 * (is / height - 1.0).abs())
        };
        self.standing(scene, last(error))
    }

    /// Returns a watch whose error is the greatest speed of a body in the last second, in px/s.
    pub(super) fn speed(self, scene: &Scene) -> Box<dyn Watch> {
        let bodies = movable(scene);
        let fastest = move |world: &dyn World| greatest(world, &bodies, |body| body.speed());
        self.standing(scene, self.worst_at_end(fastest))
    }

    /// Returns a watch whose error is the root mean square of the bodies' speeds in the last second, in px/s. One body that
    /// still rolls has little effect on it.
    pub(super) fn mean_speed(self, scene: &Scene) -> Box<dyn Watch> {
        let bodies = movable(scene);
        self.standing(scene, self.worst_at_end(move |world| mean_speed(world, &bodies)))
    }

    /// Returns a watch whose error is the largest overlap of two shapes in the last second, in px.
    pub(super) fn penetration(self, scene: &Scene) -> Box<dyn Watch> {
        let shapes = Shapes::of(scene);
        let mut next = self.seconds - WINDOW;
        let mut largest = Maximum::default();
        let look = move |time: f64, world: &dyn World| {
            if time < next {
                return None;
            }
            next += WINDOW / OVERLAP_SAMPLES;
            largest.take(shapes.largest_overlap(world));
            Some(largest.get())
        };
        self.standing(scene, last(look))
    }

    /// Returns a watch whose error is the greatest of `value` in the last second, in the unit of `value`.
    fn worst_at_end(self, value: impl Fn(&dyn World) -> f64 + 'static) -> Box<dyn Watch> {
        let from = self.seconds - WINDOW;
        worst(move |time, world: &dyn World| (time >= from).then(|| value(world)))
    }

    fn standing(self, scene: &Scene, watch: Box<dyn Watch>) -> Box<dyn Watch> {
        let starts = (0..scene.bodies.len()).map(|index| start(scene, index));
        let reach = 2e3 + 10.0 * starts.map(|p| p[0].hypot(p[1])).fold(0.0, f64::max);
        let ruin = (self.ruin)(scene);
        let verdict = move |time: f64, world: &dyn World| {
            let is_last_second = time >= self.seconds - WINDOW;
            is_last_second.then(|| ruin(world)).flatten()
        };
        failing(watch, reach, verdict)
    }
}
