//! Two recordings of a scene, one in each engine, and the table that compares them.

use super::recording::Recording;
use measure::engines::depth::TwoHalf;
use measure::engines::rapier3d::Rapier;
use measure::scenes::depth::DepthScene;
use measure::world::{BodyState, ContactPartner};
use std::fmt::Write;
use std::ops::Deref;
use std::sync::{PoisonError, RwLock, RwLockWriteGuard};

/// Distance at which `rapier3d` makes speculative contacts, px: 0.02 of its length unit.
pub(crate) const MARGIN: f64 = 0.8;
/// Penetration depth that the solver of the 2D engine leaves uncorrected, px.
pub(crate) const SLOP: f64 = 0.05;

/// Lock for the processor. Runs of scenes hold it for reading, and measurements of time for writing.
static MACHINE: RwLock<()> = RwLock::new(());

/// Waits until no scene runs, and keeps scenes from running while the returned guard lives.
pub(crate) fn alone() -> RwLockWriteGuard<'static, ()> {
    MACHINE.write().unwrap_or_else(PoisonError::into_inner)
}

/// Recording of a scene in one engine, with functions that measure it.
#[derive(Debug)]
pub(crate) struct Run(Recording);

impl Deref for Run {
    type Target = Recording;
    fn deref(&self) -> &Recording {
        &self.0
    }
}

/// Time and position at which an object crosses a height.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Crossing {
    /// Time since the start of the scene, s.
    pub(crate) time: f64,
    /// Position of the object: X, Y and Z in px, Y up.
    pub(crate) position: [f64; 3],
}

impl Run {
    /// Returns when and where an object first falls from above a height, in px, to this height or below. Interpolates linearly
    /// between two steps. Time and position are NaN if the object never does.
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

    /// Returns the angle of an object, in radians, in the step nearest to a [`crossing`](Self::crossing). NaN if there is none.
    pub(crate) fn crossing_rotation(&self, object: usize, height: f64) -> f64 {
        let time = self.crossing(object, height).time;
        if time.is_nan() { f64::NAN } else { self.state_at(object, time).angle }
    }

    /// Returns the greatest height of an object, in px, from three steps after `time` (s) until it falls again.
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

    /// Returns the speed of an object at the end of the scene, px/s.
    pub(crate) fn speed(&self, object: usize) -> f64 {
        self.last(object).speed()
    }

    /// Returns the mean of `measure` over the first `count` objects at the end of the scene, in the unit of `measure`.
    pub(crate) fn mean(&self, count: usize, measure: impl Fn(BodyState) -> f64) -> f64 {
        (0..count).map(|object| measure(self.last(object))).sum::<f64>() / count as f64
    }
}

/// A line of the table: a quantity in both engines and its tolerances.
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
    /// Sets the greatest difference from `rapier3d` and from the closed form, in the unit of the quantity.
    pub(crate) fn tolerance(&mut self, value: f64) -> &mut Self {
        self.tolerances(value, value)
    }

    /// Sets the greatest difference of our engine from `rapier3d` (`of_peer`) and from the closed form (`of_form`), in the unit
    /// of the quantity.
    pub(crate) fn tolerances(&mut self, of_peer: f64, of_form: f64) -> &mut Self {
        (self.tolerance, self.tolerance_of_form) = (of_peer, of_form);
        self
    }

    /// Sets the value of the quantity in closed form.
    pub(crate) fn closed_form(&mut self, value: f64) {
        self.form = Some(value);
    }

    /// Returns the differences that are too great, as text: that from `rapier3d`, and that from the closed form.
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

/// Recordings of a scene in our engine and in `rapier3d`, and the checks that compare them.
#[derive(Debug)]
pub(crate) struct Both {
    name: String,
    ours: Run,
    peer: Run,
    checks: Vec<Check>,
    faults: Vec<String>,
}

impl Both {
    /// Runs a scene in both engines and records it.
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

    /// Returns a quantity of the run in our engine, in the unit of `measure`.
    pub(crate) fn measure(&self, measure: impl Fn(&Run) -> f64) -> f64 {
        measure(&self.ours)
    }

    /// Adds a check that compares a quantity of both runs. The check fails until a tolerance is set.
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

    /// Returns whether both of a pair are objects: neither is the ground or a platform.
    pub(crate) fn of_objects((a, b): &(ContactPartner, ContactPartner)) -> bool {
        matches!((a, b), (ContactPartner::Object(_), ContactPartner::Object(_)))
    }

    /// Compares the first contacts of both runs with `expected`. Only pairs for which `counts` returns true are compared.
    pub(crate) fn hits(
        &mut self,
        expected: &[(ContactPartner, ContactPartner)],
        counts: impl Fn(&(ContactPartner, ContactPartner)) -> bool,
    ) {
        for (name, run) in [("twohalf", &self.ours), ("rapier3d", &self.peer)] {
            let pairs: Vec<_> = run.hits().iter().map(|hit| hit.pair).filter(|pair| counts(pair)).collect();
            if pairs != expected {
                self.faults.push(format!("{name}: the hits were {pairs:?} and not {expected:?}"));
            }
        }
    }

    /// Prints the table. Fails if a quantity differs by more than its tolerance, or if the first contacts differ.
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
        // The table is printed by one call, because tests run in parallel.
        print!("{table}");
        assert!(faults.is_empty(), "{}: {}", self.name, faults.join("; "));
    }
}
