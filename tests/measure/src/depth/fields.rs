//! Many objects in the 2.5D engine and in `rapier3d`: the cost of a step, and the distance of objects from their correct
//! positions.
//!
//! Both engines run with a step of 1/60 s and 4 substeps, and take turns in one process. Bodies sleep only in the field
//! `resting`, whose steps are timed once all bodies are at rest.

use super::depth_chart_scenes;
use crate::csv::table;
use crate::engines::depth::TwoHalf;
use crate::engines::rapier3d::Rapier;
use crate::scenes::depth::{DepthScene, deep_field, flying, ropes, standing, street};
use crate::stopwatch::Stopwatch;
use crate::watch::{Watch, worst};
use crate::world::{World, distance};
use serde::Serialize;
use std::time::Duration;
use twohalf::DepthScheme;

/// A field: a scene of many objects, the measure of its error, and whether bodies sleep.
#[derive(Clone, Copy)]
#[expect(missing_debug_implementations, reason = "functions have none")]
pub struct Field {
    /// Name of the field, for tables.
    pub name: &'static str,
    /// One sentence that describes the field and its error.
    pub about: &'static str,
    build: fn(usize) -> DepthScene,
    watch: fn(&DepthScene) -> Box<dyn Watch>,
    /// Simulated time of a run in s.
    seconds: f64,
    /// Simulated time in s after which steps are timed; bodies then sleep. `None` disables sleep and times all steps.
    sleeps_after: Option<f64>,
}

/// Cost and error of one field with one number of objects, in `twohalf` and in `rapier3d`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FieldFigures {
    /// Name of the field.
    pub scene: &'static str,
    /// Number of movable objects.
    pub objects: usize,
    /// CPU time per step of `twohalf` in ms.
    pub twohalf_ms: f64,
    /// CPU time per step of `rapier3d` in ms.
    pub rapier3d_ms: f64,
    /// CPU time of `rapier3d` divided by that of `twohalf`, dimensionless.
    pub ratio: f64,
    /// Largest error of an object in `twohalf`, in px.
    pub twohalf_error: f64,
    /// Largest error of an object in `rapier3d`, in px.
    pub rapier3d_error: f64,
}

/// Numbers of objects that each field is run with.
pub const SIZES: [usize; 5] = [20, 40, 200, 1000, 10_000];
const DT: f32 = 1.0 / 60.0;
const SUBSTEPS: usize = 4;
/// Number of steps that one engine makes before it is the other engine's turn.
const TURN: u32 = 6;

/// Returns all fields.
pub fn fields() -> Vec<Field> {
    let flying = Field {
        name: "flying",
        about: "Balls and boxes fly; their distance from their parabolas.",
        build: flying,
        watch: against_flight,
        seconds: 2.0,
        sleeps_after: None,
    };
    let standing = Field {
        name: "standing",
        about: "Figures stand on the ground; their displacement.",
        build: standing,
        watch: against_gliding,
        ..flying
    };
    let resting = Field {
        name: "resting",
        about: "The same, with sleep; timed when all are asleep.",
        seconds: 5.0,
        sleeps_after: Some(3.0),
        ..standing
    };
    let street = Field {
        name: "street",
        about: "Figures stand, or glide past those in front and behind; their distance from their expected positions.",
        build: street,
        ..standing
    };
    let deep = Field {
        name: "deep field",
        about: "The same, in a field ten figures wide.",
        build: deep_field,
        ..street
    };
    let ropes = Field {
        name: "ropes",
        about: "Ropes of 20 links hang and swing; the excess of the distance of two links over its limit.",
        build: ropes,
        watch: against_stretching,
        seconds: 4.0,
        ..flying
    };
    let mut all = vec![flying, standing, resting, street, deep, ropes];
    all.extend(depth_chart_scenes().into_iter().find(|scene| scene.name == "ball_pit_penetration").map(
        |pit| Field {
            name: "pile",
            about: "Balls fall into a pit and lie in it; their penetration at rest.",
            build: pit.build,
            watch: pit.watch,
            seconds: pit.seconds,
            ..flying
        },
    ));
    all
}

/// Runs `field` with `objects` movable objects in both engines and returns the cost and the error of each.
pub fn run_field(field: &Field, objects: usize) -> FieldFigures {
    let scene = (field.build)(objects);
    let mut ours = TwoHalf::with_scheme(&scene, DepthScheme::Precise, SUBSTEPS as i32);
    let mut peer = Rapier::new(&scene).with_iterations(SUBSTEPS);
    if field.sleeps_after.is_some() {
        ours = ours.with_sleep();
        peer = peer.with_sleep();
    }
    let mut runs = [Timed::new(field, &scene, Box::new(ours)), Timed::new(field, &scene, Box::new(peer))];
    let steps = (field.seconds / f64::from(DT)).round() as u32;
    for turn in 0..steps / TURN {
        runs.iter_mut().for_each(|run| run.turn(turn));
    }
    let [twohalf_ms, rapier3d_ms] = runs.each_ref().map(Timed::ms_per_step);
    let [twohalf_error, rapier3d_error] = runs.each_ref().map(|run| run.watch.error());
    let ratio = rapier3d_ms / twohalf_ms;
    FieldFigures { scene: field.name, objects, twohalf_ms, rapier3d_ms, ratio, twohalf_error, rapier3d_error }
}

/// A run of a field in one engine, with the CPU time of its steps.
struct Timed {
    world: Box<dyn World>,
    watch: Box<dyn Watch>,
    from: f64,
    time: Duration,
    steps: u32,
}

impl Timed {
    fn new(field: &Field, scene: &DepthScene, world: Box<dyn World>) -> Self {
        let mut watch = (field.watch)(scene);
        watch.observe(0.0, &*world);
        let from = field.sleeps_after.unwrap_or(0.0);
        Timed { world, watch, from, time: Duration::ZERO, steps: 0 }
    }

    fn turn(&mut self, turn: u32) {
        let watch = Stopwatch::start();
        (0..TURN).for_each(|_| self.world.step(DT));
        let elapsed = watch.elapsed();
        let now = f64::from((turn + 1) * TURN) * f64::from(DT);
        if now > self.from {
            (self.time, self.steps) = (self.time + elapsed, self.steps + TURN);
        }
        self.watch.observe(now, &*self.world);
    }

    fn ms_per_step(&self) -> f64 {
        self.time.as_secs_f64() * 1e3 / f64::from(self.steps)
    }
}

/// Returns a watch of the largest distance in px of an object from the parabola of its initial position and velocity.
fn against_flight(scene: &DepthScene) -> Box<dyn Watch> {
    against(scene, f64::from(scene.gravity))
}

/// Returns a watch of the largest distance in px of an object from the straight path of its initial position and velocity.
fn against_gliding(scene: &DepthScene) -> Box<dyn Watch> {
    against(scene, 0.0)
}

fn against(scene: &DepthScene, gravity: f64) -> Box<dyn Watch> {
    let starts: Vec<[[f64; 3]; 2]> = scene
        .objects
        .iter()
        .map(|object| [object.position, object.velocity].map(|of| of.map(f64::from)))
        .collect();
    worst(move |time, world| {
        let of = |(index, [place, velocity]): (usize, &[[f64; 3]; 2])| {
            let mut expected: [f64; 3] = std::array::from_fn(|axis| place[axis] + velocity[axis] * time);
            expected[1] -= 0.5 * gravity * time * time;
            distance(world.body(index).position, expected)
        };
        starts.iter().enumerate().map(of).reduce(f64::max)
    })
}

/// Returns a watch of the largest excess, in px, of the distance of two neighbours on a rope over their initial distance.
/// All balls have one radius, so the distance of lowest points equals that of centres.
fn against_stretching(scene: &DepthScene) -> Box<dyn Watch> {
    let place = |object: usize| scene.objects[object].position.map(f64::from);
    let two = scene.ropes.iter().flat_map(|rope| rope.windows(2).map(|two| [two[0], two[1]]));
    let links: Vec<_> = two.map(|two| (two, distance(place(two[0]), place(two[1])))).collect();
    worst(move |_, world| {
        let stretched = |&([a, b], length): &([usize; 2], f64)| {
            distance(world.body(a).position, world.body(b).position) - length
        };
        links.iter().map(stretched).reduce(f64::max)
    })
}

/// Returns the figures as comma-separated values: a line for each field and number of objects.
pub fn fields_csv(figures: &[FieldFigures]) -> String {
    table(figures)
}
