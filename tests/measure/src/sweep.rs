//! Runs scenes with methods and settings by turns, and measures error and time.
//!
//! Each trial is run once with its watch, which gives the error, and then several times without it, which gives the time.
//! The time is the CPU time of the thread in steps alone. The trials of a scene take turns, so that other load on the
//! machine slows all of them alike; the point has the median over the turns. Runs shorter than 5 ms are repeated within a
//! turn. Long runs take three turns, very long runs one.

use super::method::Setting;
use super::shard::Shard;
use super::stability::reasons::PANICKED;
use super::stopwatch::Stopwatch;
use super::watch::Watch;
use super::world::World;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Duration;

/// Number of turns of a trial whose run is short, long or very long (see [`LONG`]). The numbers are odd, so the median is
/// one of the measured times.
const TURNS: [usize; 3] = [7, 3, 1];
/// Least CPU time measured in a turn; short runs are repeated until it is reached or [`PATIENCE`] is over.
const LEAST: Duration = Duration::from_millis(5);
/// Longest CPU time of a turn that repeats short runs, the building of scenes included.
const PATIENCE: Duration = Duration::from_millis(60);
/// CPU times above which a run counts as long, and as very long.
const LONG: [Duration; 2] = [Duration::from_millis(100), Duration::from_secs(2)];

/// A scene in an engine before its first step, with the watches that measure its error.
pub struct Run {
    /// World of the scene, before its first step.
    pub world: Box<dyn World>,
    /// Watches with the names of their scenes: first the trial's own scene, then scenes that differ from it in the measure
    /// of error alone.
    pub watches: Vec<(&'static str, Box<dyn Watch>)>,
}

impl Run {
    /// Lets all watches observe the state at `time` in s. Returns whether the run goes on: it ends if the state of a body is
    /// not finite.
    pub fn observe(&mut self, time: f64) -> bool {
        for (_, watch) in &mut self.watches {
            watch.observe(time, &*self.world);
        }
        self.world.is_finite()
    }
}

/// Creates a run at time 0; the error names a feature that the engine lacks for the scene.
pub type Start<'a> = Box<dyn Fn() -> Result<Run, String> + 'a>;

/// Texts, sizes and tolerance of the chart of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Subject {
    /// Name of the scene.
    pub name: &'static str,
    /// Description of the scene in one sentence.
    pub about: &'static str,
    /// Numbers of bodies with which the scene is run; 0 alone where size does not matter.
    pub sizes: Vec<usize>,
    /// Name of the measured error, for the axis of the chart.
    pub error: &'static str,
    /// Unit of the error; empty for a count.
    pub unit: &'static str,
    /// Greatest error that a game would accept: a length, a percentage or a number, in the unit that the field `unit` names.
    pub tolerance: f64,
}

impl Subject {
    /// Returns the name of the scene with spaces instead of underscores, for readers.
    pub fn title(&self) -> String {
        let words = self.name.replace('_', " ").replace("newtons", "Newton's");
        words.replace("conveyor askew", "oblique conveyor")
    }

    /// Returns this subject with those sizes alone that occur in `points`; `None` if there are none.
    pub fn with_points(mut self, points: &[Point]) -> Option<Self> {
        self.sizes.retain(|&size| points.iter().any(|point| point.scene == self.name && point.size == size));
        (!self.sizes.is_empty()).then_some(self)
    }
}

/// Input of a run: scene, size, method and setting. Its result is a [`Point`].
pub struct Trial<'a> {
    /// Name of the scene.
    pub scene: &'static str,
    /// Number of bodies; 0 where size does not matter.
    pub size: usize,
    /// Name of the method.
    pub method: &'static str,
    /// Time step, and iterations or substeps per step.
    pub setting: Setting,
    /// Simulated time of a run in s.
    pub seconds: f64,
    /// Creates the world and the watches of the run.
    pub start: Start<'a>,
}

/// Success or failure of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// The run succeeded; the error is in the field `error` of the point.
    Fine,
    /// The run failed, for the reason in the text, a word or two. Charts draw a cross.
    Failed(&'static str),
}

/// Error and time of a scene with a method and a setting.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// Name of the scene.
    pub scene: &'static str,
    /// Number of bodies; 0 where size does not matter.
    pub size: usize,
    /// Name of the method.
    pub method: &'static str,
    /// Time step, and iterations or substeps per step.
    pub setting: Setting,
    /// Error of the run in the unit of the scene ([`Subject::unit`]), >= 0; infinite if the run failed.
    pub error: f64,
    /// Success or failure of the run.
    pub outcome: Outcome,
    /// CPU time of the steps per second of simulated time, in µs/s; NaN if the run panicked.
    pub microseconds_per_simulated_second: f64,
    /// Number of steps of a run; fewer than the length of the scene requires if the run ended early.
    pub steps: u32,
    /// Number of turns over which the median of the time is taken.
    pub turns: usize,
}

impl Point {
    fn is_of(&self, scene: &str, size: usize, method: &str, setting: Setting) -> bool {
        self.scene == scene && self.size == size && self.method == method && self.setting == setting
    }

    /// Returns a name that no other point has: scene, size, method and setting.
    fn name(&self) -> String {
        format!("{} {}, {}, {}", self.scene, self.size, self.method, self.setting.label())
    }

    /// Returns whether the run succeeded with an error of at most `tolerance`, in the unit of the scene's error
    /// ([`Subject::unit`]).
    pub fn meets(&self, tolerance: f64) -> bool {
        self.outcome == Outcome::Fine && self.error <= tolerance
    }
}

/// A method that cannot run a scene, since its engine lacks a feature.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Absent {
    /// Name of the scene.
    pub scene: &'static str,
    /// Name of the method.
    pub method: &'static str,
    /// Name of the feature that the engine lacks.
    pub reason: String,
}

/// Results of all trials of a sweep.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Sweep {
    /// One point for each trial that could be run.
    pub points: Vec<Point>,
    /// One entry for each scene and method that could not be run.
    pub absent: Vec<Absent>,
}

impl Sweep {
    /// Runs trials and appends the points. Trials of one scene and size must follow each other; they run by turns. `told` is
    /// called when a trial begins, with the estimated cost in s of all trials done so far ([`Trial::cost`]).
    pub fn run(&mut self, trials: &[Trial<'_>], told: &mut dyn FnMut(&Trial<'_>, f64)) {
        let mut done = 0.0;
        for rivals in trials.chunk_by(Trial::is_rival) {
            self.run_by_turns(rivals, done, told);
            done += rivals.iter().map(Trial::cost).sum::<f64>();
        }
    }

    /// Creates a sweep from points measured earlier. Scenes and methods that cannot be run are determined anew from
    /// `trials`.
    pub fn of_points(points: Vec<Point>, trials: &[Trial<'_>]) -> Self {
        let mut sweep = Sweep { points, absent: Vec::new() };
        for rivals in trials.chunk_by(|a, b| a.scene == b.scene && a.method == b.method) {
            if let Err(reason) = (rivals[0].start)() {
                sweep.note_absent(&rivals[0], reason);
            }
        }
        sweep
    }

    /// Creates a sweep from the points of all its shards.
    ///
    /// # Errors
    ///
    /// A point occurs twice, or a trial has no point although the engine has all features for it.
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
            // Half of the cost is the run with the watch, the other half the turns.
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
    /// Returns whether two trials have the same scene and size, so that they are compared.
    fn is_rival(&self, other: &Trial<'_>) -> bool {
        self.scene == other.scene && self.size == other.size
    }

    /// Returns the trials that belong to `shard`. All trials that are compared with each other belong to the same shard,
    /// since only times from one machine may be compared.
    pub fn of_shard(trials: Vec<Trial<'a>>, shard: Shard) -> Vec<Trial<'a>> {
        let costs = trials.chunk_by(Trial::is_rival).map(|rivals| rivals.iter().map(Trial::cost).sum());
        let picks = shard.picks(&costs.collect::<Vec<f64>>());
        let is_picked = trials.chunk_by(Trial::is_rival).zip(picks);
        let is_picked: Vec<bool> = is_picked.flat_map(|(rivals, pick)| vec![pick; rivals.len()]).collect();
        trials.into_iter().zip(is_picked).filter(|(_, pick)| *pick).map(|(trial, _)| trial).collect()
    }

    /// Returns the estimated cost in s on the machine where the formula was fitted: a constant, and a cost per step that
    /// grows with bodies and iterations.
    pub fn cost(&self) -> f64 {
        let steps = self.seconds / f64::from(self.setting.dt.mean());
        let bodies = self.size.max(2) as f64;
        let step = 1e-6 * bodies * (3.0 + 0.4 * f64::from(self.setting.passes));
        0.06 + 2.0 * steps * step
    }

    /// Runs the trial once without timing. Returns scene name, error and outcome for each of its watches.
    ///
    /// # Errors
    ///
    /// The name of the feature that the engine lacks for the scene.
    pub fn measured(&self) -> Result<Vec<(&'static str, f64, Outcome)>, String> {
        Ok(Entry::watched(self)?.measured)
    }

    /// Returns the time steps of a run in s; the sum is as near as possible to the length of the scene.
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

/// Name of a scene, error in the unit of that scene, and outcome.
type Measured = (&'static str, f64, Outcome);

fn measured(scene: &'static str, watch: &dyn Watch) -> Measured {
    match watch.failed() {
        Some(reason) => (scene, f64::INFINITY, Outcome::Failed(reason)),
        None if watch.error().is_finite() => (scene, watch.error(), Outcome::Fine),
        None => (scene, f64::INFINITY, Outcome::Failed("nothing to measure")),
    }
}

/// A trial with its measurements so far.
struct Entry<'a> {
    trial: &'a Trial<'a>,
    /// One measurement for each watch of the trial.
    measured: Vec<Measured>,
    steps: u32,
    /// Simulated time in s of the run.
    simulated: f64,
    /// CPU time of a run, one entry for each turn.
    times: Vec<Duration>,
}

impl<'a> Entry<'a> {
    /// Runs the trial with its watches. If the engine panics, the outcome is a failure and other trials go on.
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
        let mut goes_on = run.observe(0.0);
        for dt in self.trial.steps() {
            if !goes_on {
                break;
            }
            run.world.step(dt);
            self.simulated += f64::from(dt);
            self.steps += 1;
            goes_on = run.observe(self.simulated);
        }
        self.measured = run.watches.iter().map(|(name, watch)| measured(name, &**watch)).collect();
        Ok(())
    }

    /// Returns whether the trial needs more turns; a trial that panicked needs none.
    fn needs_turns(&self) -> bool {
        let first = self.times.first().copied().unwrap_or_default();
        let turns = TURNS[LONG.iter().filter(|&&long| first > long).count()];
        let has_panicked = self.measured.iter().any(|measured| measured.2 == Outcome::Failed(PANICKED));
        self.times.len() < turns && !has_panicked
    }

    /// Repeats the run until [`LEAST`] or [`PATIENCE`] is reached, and appends the CPU time per run.
    fn take_turn(&mut self) {
        let (mut took, mut runs) = (Duration::ZERO, 0);
        let patience = Stopwatch::start();
        while runs == 0 || took < LEAST && patience.elapsed() < PATIENCE {
            // The first build succeeded, so this one does, too.
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

/// Returns the median of an odd number of CPU times; `None` if `times` is empty.
pub(crate) fn median(mut times: Vec<Duration>) -> Option<Duration> {
    times.sort_unstable();
    times.get(times.len() / 2).copied()
}

#[cfg(test)]
mod tests {
    use super::super::watch::last;
    use super::super::world::BodyState;
    use super::*;

    /// A body that moves by 1 px per s; beyond `end` (px) it panics, or its state is not finite.
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

    /// A watch whose error is a multiple of the distance that the body covered.
    fn distance_watch(factor: f64) -> Box<dyn Watch> {
        last(move |_, world: &dyn World| Some(factor * world.body(0).position[0]))
    }

    /// Returns the sweep of a body whose state is not finite beyond `end` (px), or that panics there.
    fn sweep(setting: Setting, end: f64, panics: bool) -> Sweep {
        let start: Start<'_> = Box::new(move || {
            let watches = vec![("move", distance_watch(1.0)), ("other", distance_watch(2.0))];
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
    fn a_run_that_becomes_non_finite_stops_and_is_recorded() {
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
    fn each_further_measure_is_a_point_of_its_own() {
        let sweep = sweep(Setting::fixed(0.25, 1), 2.0, false);
        let points: Vec<_> = sweep.points.iter().map(|point| (point.scene, point.error)).collect();
        assert_eq!(points, [("move", 1.0), ("other", 2.0)]);
    }

    #[test]
    fn an_unbuildable_scene_is_reported_once() {
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

    /// Returns trials of some scenes and sizes, with two settings each.
    fn trials() -> Vec<Trial<'static>> {
        let trial = |scene, size, setting| {
            let start: Start<'_> = Box::new(move || {
                let watch = distance_watch(size as f64);
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

    /// Returns the points of trials without the times, which differ from run to run.
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
    fn merged_shards_equal_the_complete_sweep() {
        let points: Vec<Point> = parts(4).iter().flat_map(|part| untimed(part)).collect();
        let mut merged = Sweep::merged(points, &trials()).unwrap().points;
        let whole = untimed(&trials());
        assert_eq!(merged.len(), whole.len());
        merged.retain(|point| !whole.contains(point));
        assert_eq!(merged, []);
    }

    #[test]
    fn compared_trials_are_in_one_shard() {
        for part in parts(4) {
            assert!(part.chunk_by(Trial::is_rival).all(|rivals| rivals.len() == 2));
        }
    }

    #[test]
    fn a_missing_or_duplicate_shard_is_detected() {
        let points: Vec<Point> = parts(3)[1..].iter().flat_map(|part| untimed(part)).collect();
        let missing = Sweep::merged(points.clone(), &trials());
        assert!(missing.is_err_and(|error| error.ends_with("is missing")));
        let twice = Sweep::merged([&points[..], &points].concat(), &trials());
        assert!(twice.is_err_and(|error| error.ends_with("is there twice")));
    }
}
