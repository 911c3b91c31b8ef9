//! Two recordings of a scene, and the table of what is compared.

use super::recording::Recording;
use measure::engines::depth::TwoHalf;
use measure::engines::rapier3d::Rapier;
use measure::scenes::depth::DepthScene;
use measure::world::{BodyState, Met};
use std::fmt::Write;
use std::ops::Deref;
use std::sync::{PoisonError, RwLock, RwLockWriteGuard};

/// How far ahead `rapier3d` foresees contacts, px: 0.02 of its length unit.
pub(crate) const MARGIN: f64 = 0.8;
/// The overlap in px that the solver of the 2D engine leaves alone.
pub(crate) const SLOP: f64 = 0.05;

/// Scenes are run while this is read, time is measured while it is written.
static MACHINE: RwLock<()> = RwLock::new(());

/// Waits until no scene is run, and lets none be run.
pub(crate) fn alone() -> RwLockWriteGuard<'static, ()> {
    MACHINE.write().unwrap_or_else(PoisonError::into_inner)
}

/// A recording with what is measured in it.
#[derive(Debug)]
pub(crate) struct Run(Recording);

impl Deref for Run {
    type Target = Recording;
    fn deref(&self) -> &Recording {
        &self.0
    }
}

/// When and where something was.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Crossing {
    /// Time in s.
    pub(crate) time: f64,
    /// X, Y and Z in px.
    pub(crate) position: [f64; 3],
}

impl Run {
    /// When and where an object last was above a height before it first was below it, having been higher.
    /// Between steps, in a straight line. NaN if it never was.
    pub(crate) fn crossing(&self, object: usize, height: f64) -> Crossing {
        let states: Vec<BodyState> = self.states(object).copied().collect();
        let found = states.windows(2).enumerate().find(|(_, pair)| {
            let [before, after] = [pair[0].position[1], pair[1].position[1]];
            before > height && after <= height
        });
        let Some((index, pair)) = found else { return Crossing { time: f64::NAN, position: [f64::NAN; 3] } };
        let [before, after] = [pair[0].position, pair[1].position];
        let part = (before[1] - height) / (before[1] - after[1]);
        let position = std::array::from_fn(|axis| before[axis] + part * (after[axis] - before[axis]));
        Crossing { time: (index as f64 + part) * self.dt(), position }
    }

    /// Rotation of an object in the step nearest to a [`crossing`](Self::crossing). NaN if there is none.
    pub(crate) fn crossing_rotation(&self, object: usize, height: f64) -> f64 {
        let time = self.crossing(object, height).time;
        if time.is_nan() { f64::NAN } else { self.state_at(object, time).angle }
    }

    /// Greatest height of an object on the way up that begins within three steps of a time.
    pub(crate) fn apex_after(&self, object: usize, time: f64) -> f64 {
        let after = self.states(object).skip((time / self.dt()).ceil() as usize + 3);
        let mut top = f64::NAN;
        for state in after {
            top = top.max(state.position[1]);
            if state.velocity[1] < 0.0 {
                break;
            }
        }
        top
    }

    /// Speed of an object at the end, px/s.
    pub(crate) fn speed(&self, object: usize) -> f64 {
        self.last(object).speed()
    }

    /// Mean over the first `count` objects at the end.
    pub(crate) fn mean(&self, count: usize, measure: impl Fn(BodyState) -> f64) -> f64 {
        (0..count).map(|object| measure(self.last(object))).sum::<f64>() / count as f64
    }
}

/// A line of the table.
#[derive(Debug)]
pub(crate) struct Check {
    quantity: String,
    ours: f64,
    peer: f64,
    tolerance: f64,
    tolerance_of_form: f64,
    form: Option<f64>,
}

impl Check {
    /// The most by which the two may differ, and this engine from a closed form.
    pub(crate) fn tolerance(&mut self, value: f64) -> &mut Self {
        self.tolerances(value, value)
    }

    /// The most by which the two may differ; the most by which this engine may differ from a closed form.
    pub(crate) fn tolerances(&mut self, of_peer: f64, of_form: f64) -> &mut Self {
        (self.tolerance, self.tolerance_of_form) = (of_peer, of_form);
        self
    }

    /// What it is in closed form.
    pub(crate) fn form(&mut self, value: f64) {
        self.form = Some(value);
    }

    /// What is wrong, if anything.
    fn faults(&self) -> Vec<&'static str> {
        let is_near = |value: f64, tolerance: f64| (self.ours - value).abs() <= tolerance;
        let mut faults = Vec::new();
        if !is_near(self.peer, self.tolerance) {
            faults.push("differs from rapier3d");
        }
        if self.form.is_some_and(|form| !is_near(form, self.tolerance_of_form)) {
            faults.push("differs from the closed form");
        }
        faults
    }
}

/// A scene in both engines.
#[derive(Debug)]
pub(crate) struct Both {
    name: String,
    ours: Run,
    peer: Run,
    checks: Vec<Check>,
    faults: Vec<String>,
}

impl Both {
    /// Runs a scene in both.
    pub(crate) fn run(scene: &DepthScene) -> Self {
        let _shared = MACHINE.read().unwrap_or_else(PoisonError::into_inner);
        Both {
            name: scene.name.clone(),
            ours: Run(Recording::new(scene, &mut TwoHalf::new(scene))),
            peer: Run(Recording::new(scene, &mut Rapier::accurate(scene))),
            checks: Vec::new(),
            faults: Vec::new(),
        }
    }

    /// Measures something in this engine's run.
    pub(crate) fn measure(&self, measure: impl Fn(&Run) -> f64) -> f64 {
        measure(&self.ours)
    }

    /// Compares a quantity. Nothing is near enough until a tolerance is given.
    pub(crate) fn check(&mut self, quantity: &str, measure: impl Fn(&Run) -> f64) -> &mut Check {
        self.checks.push(Check {
            quantity: quantity.to_owned(),
            ours: measure(&self.ours),
            peer: measure(&self.peer),
            tolerance: f64::NAN,
            tolerance_of_form: f64::NAN,
            form: None,
        });
        self.checks.last_mut().expect("one was just pushed")
    }

    /// Whether neither of a pair is the ground or a platform.
    pub(crate) fn of_objects((a, b): &(Met, Met)) -> bool {
        matches!((a, b), (Met::Object(_), Met::Object(_)))
    }

    /// Compares who met whom first, of the pairs that count.
    pub(crate) fn hits(&mut self, expected: &[(Met, Met)], counts: impl Fn(&(Met, Met)) -> bool) {
        for (name, run) in [("twohalf", &self.ours), ("rapier3d", &self.peer)] {
            let pairs: Vec<_> = run.hits().iter().map(|hit| hit.pair).filter(|pair| counts(pair)).collect();
            if pairs != expected {
                self.faults.push(format!("{name}: the hits were {pairs:?} and not {expected:?}"));
            }
        }
    }

    /// Prints the table and fails if anything differs by more than it may.
    pub(crate) fn report(self) {
        let mut table = format!(
            "\n{:<32}{:>12}{:>12}{:>12}{:>12}{:>12}\n",
            self.name, "twohalf", "rapier3d", "closed form", "difference", "tolerance"
        );
        let mut faults = self.faults;
        for check in &self.checks {
            let form = check.form.map_or("-".to_owned(), |form| format!("{form:.4}"));
            let Check { quantity, ours, peer, tolerance, .. } = check;
            let difference = ours - peer;
            let wrong = check.faults();
            let mark = if wrong.is_empty() { "" } else { "  !" };
            writeln!(
                table,
                "  {quantity:<30}{ours:>12.4}{peer:>12.4}{form:>12}{difference:>12.4}{tolerance:>12.4}{mark}"
            )
            .expect("a string takes everything");
            faults.extend(wrong.into_iter().map(|fault| format!("{quantity} {fault}")));
        }
        // In one piece: tests run side by side.
        print!("{table}");
        assert!(faults.is_empty(), "{}: {}", self.name, faults.join("; "));
    }
}
