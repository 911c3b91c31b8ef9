//! Watching a run, and saying in one number how wrong it was.

use super::world::{World, distance};

/// Watches a run and says how wrong it was.
pub trait Watch {
    /// Looks at the world after a step; `time` is the simulated time in s so far. Also called once before the
    /// first step.
    fn see(&mut self, time: f64, world: &dyn World);

    /// How wrong the run was so far, in the scene's unit. Not finite when it failed.
    fn error(&self) -> f64;

    /// What went wrong, in a word or two, if anything did.
    fn failed(&self) -> Option<&'static str> {
        None
    }
}

/// The largest of some numbers. What is not a number counts as infinite, so that it is never lost.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Largest(Option<f64>);

impl Largest {
    /// Takes a number into account.
    pub fn take(&mut self, value: f64) {
        let value = if value.is_nan() { f64::INFINITY } else { value };
        self.0 = Some(self.0.map_or(value, |largest| largest.max(value)));
    }

    /// The largest so far; NaN as long as there was none.
    pub fn get(self) -> f64 {
        self.0.unwrap_or(f64::NAN)
    }
}

/// Keeps the largest of the errors that a function sees. It may look away (`None`); if it never looked, the
/// error is NaN.
pub struct Worst<F> {
    look: F,
    largest: Largest,
}

impl<F: FnMut(f64, &dyn World) -> Option<f64>> Worst<F> {
    /// Watches with a function of time in s and the world.
    pub fn new(look: F) -> Self {
        Worst { look, largest: Largest::default() }
    }
}

impl<F: FnMut(f64, &dyn World) -> Option<f64>> Watch for Worst<F> {
    fn see(&mut self, time: f64, world: &dyn World) {
        if let Some(error) = (self.look)(time, world) {
            self.largest.take(error);
        }
    }

    fn error(&self) -> f64 {
        self.largest.get()
    }
}

/// Keeps the last of the errors that a function sees, for what counts at the end of a run only. NaN as long as
/// there was none.
pub struct Last<F> {
    look: F,
    error: f64,
}

impl<F: FnMut(f64, &dyn World) -> Option<f64>> Last<F> {
    /// Watches with a function of time in s and the world.
    pub fn new(look: F) -> Self {
        Last { look, error: f64::NAN }
    }
}

impl<F: FnMut(f64, &dyn World) -> Option<f64>> Watch for Last<F> {
    fn see(&mut self, time: f64, world: &dyn World) {
        if let Some(error) = (self.look)(time, world) {
            self.error = error;
        }
    }

    fn error(&self) -> f64 {
        self.error
    }
}

/// Another watch, and what counts as a failure: the first word a function says stays. Besides, a run fails when
/// the state of a body is not finite or lies outside of the scene, and when there was nothing to measure.
pub struct Failing<W, F> {
    watch: W,
    verdict: F,
    /// Farther than this from the origin, in px, nothing belongs to the scene any more.
    reach: f64,
    failed: Option<&'static str>,
}

impl<W: Watch, F: FnMut(f64, &dyn World) -> Option<&'static str>> Failing<W, F> {
    /// A watch with a verdict and the reach of the scene in px.
    pub fn new(watch: W, reach: f64, verdict: F) -> Self {
        Failing { watch, verdict, reach, failed: None }
    }
}

impl<W: Watch, F: FnMut(f64, &dyn World) -> Option<&'static str>> Watch for Failing<W, F> {
    fn see(&mut self, time: f64, world: &dyn World) {
        if self.failed.is_none() {
            self.failed = strayed(world, self.reach).or_else(|| (self.verdict)(time, world));
            self.watch.see(time, world);
        }
    }

    fn error(&self) -> f64 {
        if self.failed.is_some() { f64::INFINITY } else { self.watch.error() }
    }

    fn failed(&self) -> Option<&'static str> {
        self.failed
            .or_else(|| self.watch.failed())
            .or_else(|| (!self.watch.error().is_finite()).then_some("nothing to measure"))
    }
}

/// Another watch that fails when a body's state is not finite, or lies farther from the origin than `reach` px.
pub fn in_reach(watch: impl Watch + 'static, reach: f64) -> Box<dyn Watch> {
    Box::new(Failing::new(watch, reach, |_, _| None))
}

/// Whether a body's state is not finite, or farther from the origin than `reach` px.
pub fn strayed(world: &dyn World, reach: f64) -> Option<&'static str> {
    (0..world.body_count()).map(|index| world.body(index)).find_map(|body| {
        if !body.is_finite() {
            Some("not finite")
        } else if distance(body.position, [0.0; 3]) > reach {
            Some("flew off")
        } else {
            None
        }
    })
}
