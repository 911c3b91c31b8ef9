//! Runs scenes with methods and settings against each other, and measures error and time.
//!
//! Every point is run once with its watch, which gives the error, and then several times without it, which gives
//! the time: CPU time of the thread, spent in steps alone. The points of a scene take turns, so that what the
//! machine does besides meets all of them, and the median over the turns is kept. Short runs are repeated until
//! enough is measured; long ones take fewer turns, very long ones one.

use super::method::Setting;
use super::shard::Shard;
use super::stability::reasons::PANICKED;
use super::stopwatch::Stopwatch;
use super::watch::Watch;
use super::world::World;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Duration;

/// Turns of each point, of one that takes long, and of one that takes so long that chance does not matter: odd, so that
/// there is one in the middle.
const TURNS: [usize; 3] = [7, 3, 1];
/// Least time that is measured in a turn, if the run is not so slow to begin that [`PATIENCE`] ends first.
const LEAST: Duration = Duration::from_millis(5);
/// Longest that a turn repeats short runs, building included.
const PATIENCE: Duration = Duration::from_millis(60);
/// What is long, and very long, for a run.
const LONG: [Duration; 2] = [Duration::from_millis(100), Duration::from_secs(2)];

/// A scene in an engine, and who watches it.
pub struct Run {
    /// The scene, before its first step.
    pub world: Box<dyn World>,
    /// Names of scenes, each with what watches for it: the trial's first, then those that differ from it in what counts
    /// as error alone.
    pub watches: Vec<(&'static str, Box<dyn Watch>)>,
}

impl Run {
    /// Looks at how it is at a time in s. Whether it is worth going on: not when a body's state is not finite.
    pub fn look(&mut self, time: f64) -> bool {
        for (_, watch) in &mut self.watches {
            watch.see(time, &*self.world);
        }
        self.world.is_finite()
    }
}

/// Begins a run from the start; the error says what the engine lacks for it.
pub type Start<'a> = Box<dyn Fn() -> Result<Run, String> + 'a>;

/// What a chart says of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Subject {
    /// Name of the scene.
    pub name: &'static str,
    /// One sentence.
    pub about: &'static str,
    /// Numbers of bodies; 0 alone where size does not matter.
    pub sizes: Vec<usize>,
    /// What the error is.
    pub error: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// The error a game would accept.
    pub tolerance: f64,
}

impl Subject {
    /// The name as a reader writes it.
    pub fn title(&self) -> String {
        self.name.replace('_', " ").replace("newtons", "Newton's")
    }

    /// The same with those of the sizes alone that there are points of; nothing if there are none.
    pub fn with_points(mut self, points: &[Point]) -> Option<Self> {
        self.sizes.retain(|&size| points.iter().any(|point| point.scene == self.name && point.size == size));
        (!self.sizes.is_empty()).then_some(self)
    }
}

/// What is run to give a point.
pub struct Trial<'a> {
    /// Name of the scene.
    pub scene: &'static str,
    /// Number of bodies; 0 where it does not matter.
    pub size: usize,
    /// Name of the method.
    pub method: &'static str,
    /// The setting.
    pub setting: Setting,
    /// Simulated time of a run in s.
    pub seconds: f64,
    /// Begins the run.
    pub start: Start<'a>,
}

/// How a run went.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// The error says how well.
    Fine,
    /// Not at all: what happened, in a word or two. Drawn as a cross.
    Failed(&'static str),
}

/// What a method with a setting made of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// Name of the scene.
    pub scene: &'static str,
    /// Number of bodies; 0 where it does not matter.
    pub size: usize,
    /// Name of the method.
    pub method: &'static str,
    /// The setting.
    pub setting: Setting,
    /// In the unit of the scene; not finite if the run failed.
    pub error: f64,
    /// How it went.
    pub outcome: Outcome,
    /// CPU time of the steps for each second of simulated time; not a number if the run panicked.
    pub microseconds_per_simulated_second: f64,
    /// Steps of a run: fewer than the scene has if it was given up.
    pub steps: u32,
    /// Turns that the time is the median of.
    pub turns: usize,
}

impl Point {
    fn is_of(&self, scene: &str, size: usize, method: &str, setting: Setting) -> bool {
        self.scene == scene && self.size == size && self.method == method && self.setting == setting
    }

    /// What tells it from all others.
    fn name(&self) -> String {
        format!("{} {}, {}, {}", self.scene, self.size, self.method, self.setting.label())
    }

    /// Whether the run was as good as a tolerance asks.
    pub fn meets(&self, tolerance: f64) -> bool {
        self.outcome == Outcome::Fine && self.error <= tolerance
    }
}

/// A method that has not got what a scene needs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Absent {
    /// Name of the scene.
    pub scene: &'static str,
    /// Name of the method.
    pub method: &'static str,
    /// What it lacks.
    pub reason: String,
}

/// What came of all trials.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Sweep {
    /// A point of every trial that could be made.
    pub points: Vec<Point>,
    /// The others: one entry for a scene and a method.
    pub absent: Vec<Absent>,
}

impl Sweep {
    /// Makes trials: those of one scene and size, which must follow each other, by turns. `told` is called when a trial is
    /// begun, with what is done of all in the unit of [`Trial::cost`].
    pub fn run(&mut self, trials: &[Trial<'_>], told: &mut dyn FnMut(&Trial<'_>, f64)) {
        let mut done = 0.0;
        for rivals in trials.chunk_by(Trial::is_rival) {
            self.run_by_turns(rivals, done, told);
            done += rivals.iter().map(Trial::cost).sum::<f64>();
        }
    }

    /// Takes points that were measured before; what engines lack for the trials is found again.
    pub fn of_points(points: Vec<Point>, trials: &[Trial<'_>]) -> Self {
        let mut sweep = Sweep { points, absent: Vec::new() };
        for rivals in trials.chunk_by(|a, b| a.scene == b.scene && a.method == b.method) {
            if let Err(reason) = (rivals[0].start)() {
                sweep.note_absent(&rivals[0], reason);
            }
        }
        sweep
    }

    /// Puts together the points of all parts of a sweep.
    ///
    /// # Errors
    ///
    /// Which point is there twice, and which trial has none although the engine has all it needs.
    pub fn merged(points: Vec<Point>, trials: &[Trial<'_>]) -> Result<Self, String> {
        for (index, point) in points.iter().enumerate() {
            if points[..index]
                .iter()
                .any(|other| other.is_of(point.scene, point.size, point.method, point.setting))
            {
                return Err(format!("{} is there twice", point.name()));
            }
        }
        let sweep = Self::of_points(points, trials);
        for trial in trials {
            let is_there = |point: &Point| point.is_of(trial.scene, trial.size, trial.method, trial.setting);
            let is_absent = |absent: &Absent| absent.scene == trial.scene && absent.method == trial.method;
            if !sweep.points.iter().any(is_there) && !sweep.absent.iter().any(is_absent) {
                let Trial { scene, size, method, setting, .. } = trial;
                return Err(format!("{scene} {size}, {method}, {} is missing", setting.label()));
            }
        }
        Ok(sweep)
    }

    fn run_by_turns(&mut self, rivals: &[Trial<'_>], mut done: f64, told: &mut dyn FnMut(&Trial<'_>, f64)) {
        let mut entries = Vec::new();
        for trial in rivals {
            told(trial, done);
            match Entry::watched(trial) {
                Ok(entry) => entries.push(entry),
                Err(reason) => self.note_absent(trial, reason),
            }
            // The other half is the turns.
            done += trial.cost() / 2.0;
        }
        for _ in 0..TURNS[0] {
            for entry in entries.iter_mut().filter(|entry| entry.needs_turns()) {
                entry.take_turn();
            }
        }
        self.points.extend(entries.into_iter().flat_map(Entry::points));
    }

    fn note_absent(&mut self, trial: &Trial<'_>, reason: String) {
        let is_known =
            self.absent.iter().any(|absent| absent.scene == trial.scene && absent.method == trial.method);
        if !is_known {
            self.absent.push(Absent { scene: trial.scene, method: trial.method, reason });
        }
    }
}

impl<'a> Trial<'a> {
    /// Whether two are of one scene and size, and so are compared.
    fn is_rival(&self, other: &Trial<'_>) -> bool {
        self.scene == other.scene && self.size == other.size
    }

    /// Those trials of a sweep that are in a part of it. All that are compared with each other are in one part: what may be
    /// quoted are ratios of one run.
    pub fn of_shard(trials: Vec<Trial<'a>>, shard: Shard) -> Vec<Trial<'a>> {
        let costs = trials.chunk_by(Trial::is_rival).map(|rivals| rivals.iter().map(Trial::cost).sum());
        let picks = shard.picks(&costs.collect::<Vec<f64>>());
        let is_picked = trials.chunk_by(Trial::is_rival).zip(picks);
        let is_picked: Vec<bool> = is_picked.flat_map(|(rivals, pick)| vec![pick; rivals.len()]).collect();
        trials.into_iter().zip(is_picked).filter(|(_, pick)| *pick).map(|(trial, _)| trial).collect()
    }

    /// About how long it takes, in s on the machine this was written on: what all take, and what bodies and passes add to
    /// each step.
    pub fn cost(&self) -> f64 {
        let steps = self.seconds / f64::from(self.setting.dt.mean());
        let bodies = self.size.max(2) as f64;
        let step = 1e-6 * bodies * (3.0 + 0.4 * f64::from(self.setting.passes));
        0.06 + 2.0 * steps * step
    }

    /// Makes one run that is not timed: for each scene that it is of its name, the error and the outcome.
    ///
    /// # Errors
    ///
    /// Capability that the engine lacks for the scene.
    pub fn measured(&self) -> Result<Vec<(&'static str, f64, Outcome)>, String> {
        Ok(Entry::watched(self)?.measured)
    }

    /// The steps of a run in s: so many that together they come nearest to the scene's length.
    fn steps(&self) -> impl Iterator<Item = f32> {
        let mut time = 0.0;
        let seconds = self.seconds;
        self.setting.dt.steps().take_while(move |&dt| {
            let is_due = time + f64::from(dt) / 2.0 < seconds;
            time += f64::from(dt);
            is_due
        })
    }
}

/// The name of a scene, the error and the outcome.
type Measured = (&'static str, f64, Outcome);

fn measured(scene: &'static str, watch: &dyn Watch) -> Measured {
    match watch.failed() {
        Some(reason) => (scene, f64::INFINITY, Outcome::Failed(reason)),
        None if watch.error().is_finite() => (scene, watch.error(), Outcome::Fine),
        None => (scene, f64::INFINITY, Outcome::Failed("nothing to measure")),
    }
}

/// A trial that is being measured.
struct Entry<'a> {
    trial: &'a Trial<'a>,
    /// What was measured.
    measured: Vec<Measured>,
    steps: u32,
    /// Simulated time of a run in s.
    simulated: f64,
    /// CPU time of a run, one for each turn.
    times: Vec<Duration>,
}

impl<'a> Entry<'a> {
    /// Makes the run that gives the error. An engine that panics has failed; the others go on.
    fn watched(trial: &'a Trial<'a>) -> Result<Self, String> {
        let mut entry = Entry {
            trial,
            measured: vec![(trial.scene, f64::INFINITY, Outcome::Failed(PANICKED))],
            steps: 0,
            simulated: 0.0,
            times: Vec::new(),
        };
        let run = catch_unwind(AssertUnwindSafe(|| entry.watch()));
        run.unwrap_or(Ok(()))?;
        Ok(entry)
    }

    fn watch(&mut self) -> Result<(), String> {
        let mut run = (self.trial.start)()?;
        let mut goes_on = run.look(0.0);
        for dt in self.trial.steps() {
            if !goes_on {
                break;
            }
            run.world.step(dt);
            self.simulated += f64::from(dt);
            self.steps += 1;
            goes_on = run.look(self.simulated);
        }
        self.measured = run.watches.iter().map(|(name, watch)| measured(name, &**watch)).collect();
        Ok(())
    }

    /// Whether more is to be measured: not of a run that panicked.
    fn needs_turns(&self) -> bool {
        let first = self.times.first().copied().unwrap_or_default();
        let turns = TURNS[LONG.iter().filter(|&&long| first > long).count()];
        let has_panicked = self.measured.iter().any(|measured| measured.2 == Outcome::Failed(PANICKED));
        self.times.len() < turns && !has_panicked
    }

    /// Repeats the run until enough is measured.
    fn take_turn(&mut self) {
        let (mut took, mut runs) = (Duration::ZERO, 0);
        let patience = Stopwatch::start();
        while runs == 0 || took < LEAST && patience.elapsed() < PATIENCE {
            // It could be built once, so it can be again.
            let Ok(mut run) = (self.trial.start)() else { return };
            let stopwatch = Stopwatch::start();
            for dt in self.trial.steps().take(self.steps as usize) {
                run.world.step(dt);
            }
            took += stopwatch.elapsed();
            runs += 1;
        }
        self.times.push(took / runs);
    }

    fn points(self) -> impl Iterator<Item = Point> {
        let Trial { size, method, setting, .. } = *self.trial;
        let (steps, turns) = (self.steps, self.times.len());
        let time = median(self.times).map_or(f64::NAN, |time| time.as_secs_f64() * 1e6 / self.simulated);
        self.measured.into_iter().map(move |(scene, error, outcome)| Point {
            scene,
            size,
            method,
            setting,
            error,
            outcome,
            microseconds_per_simulated_second: time,
            steps,
            turns,
        })
    }
}

/// The middle one of an odd number of times; nothing of none.
pub(crate) fn median(mut times: Vec<Duration>) -> Option<Duration> {
    times.sort_unstable();
    times.get(times.len() / 2).copied()
}

#[cfg(test)]
mod tests {
    use super::super::watch::last;
    use super::super::world::BodyState;
    use super::*;

    /// A body that moves by the steps; when it is beyond, it panics or its state is not finite.
    struct Mover {
        place: f64,
        end: f64,
        panics: bool,
    }

    impl World for Mover {
        fn step(&mut self, dt: f32) {
            self.place += f64::from(dt);
            assert!(!self.panics || self.place < self.end, "this panic is part of a test");
        }

        fn body(&self, _: usize) -> BodyState {
            let x = if self.place < self.end { self.place } else { f64::NAN };
            BodyState { position: [x, 0.0, 0.0], ..BodyState::default() }
        }

        fn body_count(&self) -> usize {
            1
        }
    }

    /// A watch whose error is a multiple of how far the body came.
    fn way(factor: f64) -> Box<dyn Watch> {
        last(move |_, world: &dyn World| Some(factor * world.body(0).position[0]))
    }

    /// What comes of a body that is not finite, or panics, when it is beyond an end.
    fn sweep(setting: Setting, end: f64, panics: bool) -> Sweep {
        let start: Start<'_> = Box::new(move || {
            let watches = vec![("move", way(1.0)), ("other", way(2.0))];
            Ok(Run { world: Box::new(Mover { place: 0.0, end, panics }), watches })
        });
        let trial = Trial { scene: "move", size: 0, method: "mover", setting, seconds: 1.0, start };
        let trials = [trial];
        let mut sweep = Sweep::default();
        sweep.run(&trials, &mut |_, _| {});
        sweep
    }

    #[test]
    fn a_run_is_as_long_as_the_scene() {
        let sweep = sweep(Setting::fixed(0.25, 1), 2.0, false);
        assert_eq!((sweep.points[0].steps, sweep.points[0].error), (4, 1.0));
    }

    #[test]
    fn a_jittering_run_is_about_as_long_as_the_scene() {
        let sweep = sweep(Setting::jitter(0.01, 1), 2.0, false);
        // The last step brings it nearest: at most half of the longest step is missing.
        assert!((sweep.points[0].error - 1.0).abs() <= 0.0075, "{}", sweep.points[0].error);
    }

    #[test]
    fn a_run_that_is_not_finite_is_given_up_and_kept() {
        let sweep = sweep(Setting::fixed(0.25, 1), 0.4, false);
        let point = &sweep.points[0];
        assert_eq!((point.steps, point.outcome), (2, Outcome::Failed("not finite")));
    }

    #[test]
    fn a_run_that_panics_has_failed_and_has_no_time() {
        let sweep = sweep(Setting::fixed(0.25, 1), 0.6, true);
        assert_eq!(sweep.points[0].outcome, Outcome::Failed(PANICKED));
        assert!(sweep.points[0].microseconds_per_simulated_second.is_nan());
    }

    #[test]
    fn what_else_was_measured_is_a_point_of_its_own() {
        let sweep = sweep(Setting::fixed(0.25, 1), 2.0, false);
        let points: Vec<_> = sweep.points.iter().map(|point| (point.scene, point.error)).collect();
        assert_eq!(points, [("move", 1.0), ("other", 2.0)]);
    }

    #[test]
    fn what_cannot_be_built_is_told_once() {
        let start = || -> Start<'static> { Box::new(|| Err("no joints".to_owned())) };
        let trials = [Setting::fixed(0.1, 1), Setting::fixed(0.2, 1)].map(|setting| Trial {
            scene: "chain",
            size: 0,
            method: "mover",
            setting,
            seconds: 1.0,
            start: start(),
        });
        let mut sweep = Sweep::default();
        sweep.run(&trials, &mut |_, _| {});
        assert_eq!((sweep.points.len(), sweep.absent.len()), (0, 1));
    }

    #[test]
    fn the_median_is_the_middle_one() {
        let times = [5, 1, 3].map(Duration::from_millis).to_vec();
        assert_eq!(median(times), Some(Duration::from_millis(3)));
    }

    /// Trials of some scenes and sizes, with two settings each.
    fn trials() -> Vec<Trial<'static>> {
        let trial = |scene, size, setting| {
            let start: Start<'_> = Box::new(move || {
                let watch = way(size as f64);
                Ok(Run {
                    world: Box::new(Mover { place: 0.0, end: f64::INFINITY, panics: false }),
                    watches: vec![(scene, watch)],
                })
            });
            Trial { scene, size, method: "mover", setting, seconds: 1.0, start }
        };
        let settings = [Setting::fixed(0.25, 1), Setting::jitter(0.25, 1)];
        let sizes = ["near", "far"].into_iter().flat_map(|scene| (1..=3).map(move |size| (scene, size)));
        sizes.flat_map(|(scene, size)| settings.map(|setting| trial(scene, size, setting))).collect()
    }

    /// What comes of trials, without what is never the same twice.
    fn untimed(trials: &[Trial<'_>]) -> Vec<Point> {
        let mut sweep = Sweep::default();
        sweep.run(trials, &mut |_, _| {});
        let point = |point| Point { microseconds_per_simulated_second: 0.0, turns: 0, ..point };
        sweep.points.into_iter().map(point).collect()
    }

    fn parts(of: usize) -> Vec<Vec<Trial<'static>>> {
        let shards = (1..=of).map(|number| format!("{number}/{of}").parse().unwrap());
        shards.map(|shard| Trial::of_shard(trials(), shard)).collect()
    }

    #[test]
    fn parts_put_together_are_the_whole() {
        let points: Vec<Point> = parts(4).iter().flat_map(|part| untimed(part)).collect();
        let mut merged = Sweep::merged(points, &trials()).unwrap().points;
        let whole = untimed(&trials());
        assert_eq!(merged.len(), whole.len());
        merged.retain(|point| !whole.contains(point));
        assert_eq!(merged, []);
    }

    #[test]
    fn what_is_compared_is_in_one_part() {
        for part in parts(4) {
            assert!(part.chunk_by(Trial::is_rival).all(|rivals| rivals.len() == 2));
        }
    }

    #[test]
    fn a_part_that_is_missing_or_there_twice_is_noticed() {
        let points: Vec<Point> = parts(3)[1..].iter().flat_map(|part| untimed(part)).collect();
        let missing = Sweep::merged(points.clone(), &trials());
        assert!(missing.is_err_and(|error| error.ends_with("is missing")));
        let twice = Sweep::merged([&points[..], &points].concat(), &trials());
        assert!(twice.is_err_and(|error| error.ends_with("is there twice")));
    }
}
