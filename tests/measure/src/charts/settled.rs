//! What is measured where things should come to rest: how deep they are in each other, how fast they still move,
//! and whether what was built still stands.

use super::super::penetration::Shapes;
use super::ChartScene;
use super::build::start;
use crate::scenes::movable;
use crate::watch::{Largest, Watch, failing, greatest, last, mean_speed, worst};
use crate::world::{World, distance};
use conformance::scene::Scene;

/// The last second of a run is looked at.
const WINDOW: f64 = 1.0;
/// Overlaps are looked for so many times in it: what sinks is slow, and looking is not free.
const LOOKS: f64 = 10.0;

/// The name of a scene and what watches it.
type Measure = (&'static str, fn(&Scene) -> Box<dyn Watch>);

/// The charts of what is built to stand: one by overlap as given, one by height and one by speed, with their names and
/// watches.
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
        // It is a share, since every contact gives way a little: in a tower of any number of boxes, each is then lower
        // by a hundredth of a box with respect to the one it stands on, which nobody sees.
        tolerance: 1.0,
        ..overlap
    };
    let speed = ChartScene {
        name: speed,
        watch: watch_speed,
        error: "fastest speed at the end",
        unit: "px/s",
        // What gravity gives in a step of 1/60 s: so much comes and goes from step to step in what rests, and
        // moves nothing by a tenth of a pixel.
        tolerance: 5.0,
        ..overlap
    };
    [overlap, height, speed]
}

/// Says what of a scene has come to ruin, if anything has.
pub(super) type RuinCheck = Box<dyn Fn(&dyn World) -> Option<&'static str>>;

/// What stands may move `slack` px from where it was built; what is farther away has toppled.
pub(super) fn toppled(scene: &Scene, slack: f64) -> RuinCheck {
    let places: Vec<(usize, [f64; 2])> =
        movable(scene).into_iter().map(|index| (index, start(scene, index))).collect();
    let has_left = move |world: &dyn World, &(index, start): &(usize, [f64; 2])| {
        distance(world.body(index).place(), start) > slack
    };
    Box::new(move |world| places.iter().any(|place| has_left(world, place)).then_some("toppled"))
}

/// The body that was built highest, and how high above 0 its centre is then, in px.
fn top(scene: &Scene) -> Option<(usize, f64)> {
    let bodies = movable(scene).into_iter().map(|index| (index, -start(scene, index)[1]));
    // Of two at one height the first.
    bodies.reduce(|top, other| if other.1 > top.1 { other } else { top })
}

/// How high the top of a scene is as built, in px: that of one where things touch and do not overlap.
pub(super) fn built_height(scene: &Scene) -> f64 {
    top(scene).map_or(f64::NAN, |(_, height)| height)
}

/// What stands or lies after `seconds`, and what of it counts as a failure.
#[derive(Clone, Copy)]
pub(super) struct Rest {
    pub seconds: f64,
    /// Asked in the last second alone, since what has come to ruin does not mend.
    pub ruin: fn(&Scene) -> RuinCheck,
}

impl Rest {
    /// Error: by how much the body that was built highest is higher or lower at the end than where it would be if
    /// nothing overlapped, in percent of that height. `height` is in px, of that body's centre above 0.
    pub(super) fn height(self, scene: &Scene, height: f64) -> Box<dyn Watch> {
        let top = top(scene);
        let error = move |_: f64, world: &dyn World| {
            let is = -world.body(top?.0).position[1];
            Some(100.0 * (is / height - 1.0).abs())
        };
        self.standing(scene, last(error))
    }

    /// Error: the speed of the fastest body in the last second, in px/s.
    pub(super) fn speed(self, scene: &Scene) -> Box<dyn Watch> {
        let bodies = movable(scene);
        let fastest = move |world: &dyn World| greatest(world, &bodies, |body| body.speed());
        self.standing(scene, self.worst_at_end(fastest))
    }

    /// Error: the root of the mean squared speed of the bodies in the last second, in px/s: where one that still
    /// rolls does not matter.
    pub(super) fn mean_speed(self, scene: &Scene) -> Box<dyn Watch> {
        let bodies = movable(scene);
        self.standing(scene, self.worst_at_end(move |world| mean_speed(world, &bodies)))
    }

    /// Error: the largest overlap of two shapes in the last second, in px.
    pub(super) fn penetration(self, scene: &Scene) -> Box<dyn Watch> {
        let shapes = Shapes::of(scene);
        let mut next = self.seconds - WINDOW;
        let mut largest = Largest::default();
        let look = move |time: f64, world: &dyn World| {
            if time < next {
                return None;
            }
            next += WINDOW / LOOKS;
            largest.take(shapes.largest_overlap(world));
            Some(largest.get())
        };
        self.standing(scene, last(look))
    }

    /// The largest of a value in the last second.
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
