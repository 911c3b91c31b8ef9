//! What is measured where things should come to rest: how deep they are in each other, how fast they still move,
//! and whether what was built still stands.

use super::super::error::{Failing, Largest, Last, Watch, Worst};
use super::super::penetration::Shapes;
use super::super::world::World;
use super::ChartScene;
use super::build::start;
use crate::scene::Scene;

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
        // A tenth of a box of 20 px and less of larger ones: nothing looks sunk.
        tolerance: 2.0,
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

/// Where the bodies were at first, and which of them can move.
#[derive(Debug, Clone)]
struct Places {
    starts: Vec<[f64; 2]>,
    movable: Vec<usize>,
}

impl Places {
    fn of(scene: &Scene) -> Self {
        let is_movable = |&index: &usize| scene.bodies[index].is_static != Some(true);
        Places {
            starts: (0..scene.bodies.len()).map(|index| start(scene, index)).collect(),
            movable: (0..scene.bodies.len()).filter(is_movable).collect(),
        }
    }

    /// How far the body that was highest at first is now from where it was, up or down, in px.
    fn lost_height(&self, world: &dyn World) -> f64 {
        let highest = |a: &&usize, b: &&usize| self.starts[**a][1].total_cmp(&self.starts[**b][1]);
        let top = self.movable.iter().min_by(highest);
        top.map_or(f64::NAN, |&top| (world.body(top).position[1] - self.starts[top][1]).abs())
    }

    /// The largest distance of a body from where it was, in px.
    fn moved(&self, world: &dyn World) -> f64 {
        let moved = |&index: &usize| {
            let (now, start) = (world.body(index).position, self.starts[index]);
            (now[0] - start[0]).hypot(now[1] - start[1])
        };
        self.movable.iter().map(moved).fold(0.0, f64::max)
    }
}

/// What stands or lies after `seconds`. Bodies may move `slack` px from where they were built; if one is farther
/// away at the end, it has toppled.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rest {
    pub seconds: f64,
    pub slack: f64,
}

impl Rest {
    /// Error: by how much the highest body is higher or lower at the end than it was built, in px.
    pub(super) fn height(self, scene: &Scene) -> Box<dyn Watch> {
        let places = Places::of(scene);
        self.standing(scene, Last::new(move |_, world| Some(places.lost_height(world))))
    }

    /// Error: the speed of the fastest body in the last second, in px/s.
    pub(super) fn speed(self, scene: &Scene) -> Box<dyn Watch> {
        let places = Places::of(scene);
        let fastest = move |world: &dyn World| {
            places.movable.iter().map(|&index| world.body(index).speed()).fold(0.0, f64::max)
        };
        self.standing(scene, self.worst_at_end(fastest))
    }

    /// Error: the root of the mean squared speed of the bodies in the last second, in px/s: where one that still
    /// rolls does not matter.
    pub(super) fn mean_speed(self, scene: &Scene) -> Box<dyn Watch> {
        let places = Places::of(scene);
        let mean = move |world: &dyn World| {
            let sum: f64 = places.movable.iter().map(|&index| world.body(index).speed().powi(2)).sum();
            (sum / places.movable.len().max(1) as f64).sqrt()
        };
        self.standing(scene, self.worst_at_end(mean))
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
        self.standing(scene, Last::new(look))
    }

    /// The largest of a value in the last second.
    fn worst_at_end(self, value: impl Fn(&dyn World) -> f64 + 'static) -> impl Watch + 'static {
        let from = self.seconds - WINDOW;
        Worst::new(move |time, world: &dyn World| (time >= from).then(|| value(world)))
    }

    fn standing(self, scene: &Scene, watch: impl Watch + 'static) -> Box<dyn Watch> {
        let places = Places::of(scene);
        let reach = 2e3 + 10.0 * places.starts.iter().map(|p| p[0].hypot(p[1])).fold(0.0, f64::max);
        // In the last second, since it does not stand up again.
        let verdict = move |time: f64, world: &dyn World| {
            (time >= self.seconds - WINDOW && places.moved(world) > self.slack).then_some("toppled")
        };
        Box::new(Failing::new(watch, reach, verdict))
    }
}
