//! Watches: they observe a run and measure its error as one number.

use crate::stability::reasons::NOT_FINITE;
use crate::world::{BodyState, World, distance};

/// Watches a run and measures its error.
pub trait Watch {
    /// Observes the world after a step; `time` is the simulated time in s so far. It is also called once before the first
    /// step.
    fn observe(&mut self, time: f64, world: &dyn World);

    /// Returns the error of the run so far, in the unit of the scene; infinite or NaN if the run failed.
    fn error(&self) -> f64;

    /// Returns the reason of a failure in a word or two; `None` if the run has not failed.
    fn failed(&self) -> Option<&'static str> {
        None
    }
}

/// Creates a watch from a state and three functions: `see` updates the state after each step at a time in s, `error` returns
/// the error, `failed` returns the reason of a failure or `None`.
pub fn custom_watch<S: 'static>(
    kept: S,
    see: impl FnMut(&mut S, f64, &dyn World) + 'static,
    error: impl Fn(&S) -> f64 + 'static,
    failed: impl Fn(&S) -> Option<&'static str> + 'static,
) -> Box<dyn Watch> {
    Box::new(CustomWatch { state: kept, observe: see, error, failed })
}

struct CustomWatch<S, See, Error, Failed> {
    state: S,
    observe: See,
    error: Error,
    failed: Failed,
}

impl<S, See, Error, Failed> Watch for CustomWatch<S, See, Error, Failed>
where
    See: FnMut(&mut S, f64, &dyn World),
    Error: Fn(&S) -> f64,
    Failed: Fn(&S) -> Option<&'static str>,
{
    fn observe(&mut self, time: f64, world: &dyn World) {
        (self.observe)(&mut self.state, time, world);
    }

    fn error(&self) -> f64 {
        (self.error)(&self.state)
    }

    fn failed(&self) -> Option<&'static str> {
        (self.failed)(&self.state)
    }
}

/// Maximum of some numbers. NaN counts as infinity, so a NaN is never lost.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Maximum(Option<f64>);

impl Maximum {
    /// Includes a number in the maximum.
    pub fn take(&mut self, value: f64) {
        let value = if value.is_nan() { f64::INFINITY } else { value };
        self.0 = Some(self.0.map_or(value, |largest| largest.max(value)));
    }

    /// Returns the maximum so far; NaN before the first number.
    pub fn get(self) -> f64 {
        self.0.unwrap_or(f64::NAN)
    }
}

/// Result of observing a run at one moment. Errors are in the unit of the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Observation {
    /// The state is good. The error of the run is the maximum of these errors.
    Fine(f64),
    /// The state is good if it stays so until the end. The error of the run is the last of these errors.
    Ends(f64),
    /// The run fails if this is its last observation: reason and error.
    Open(&'static str, f64),
    /// The run has failed, whatever follows: reason and error.
    Failed(&'static str, f64),
}

impl Observation {
    /// Combines two observations: the worse kind of the two (fine, ends, open, failed) with the larger error.
    pub fn and(self, other: Observation) -> Observation {
        let larger = self.error().max(other.error());
        match (self, other) {
            (Observation::Failed(reason, _), _) | (_, Observation::Failed(reason, _)) => {
                Observation::Failed(reason, larger)
            }
            (Observation::Open(reason, _), _) | (_, Observation::Open(reason, _)) => {
                Observation::Open(reason, larger)
            }
            (Observation::Ends(_), _) | (_, Observation::Ends(_)) => Observation::Ends(larger),
            (Observation::Fine(_), Observation::Fine(_)) => Observation::Fine(larger),
        }
    }

    fn error(self) -> f64 {
        match self {
            Observation::Fine(error)
            | Observation::Ends(error)
            | Observation::Open(_, error)
            | Observation::Failed(_, error) => error,
        }
    }
}

/// Creates a watch whose error is the maximum of the errors that `look` returns, in the unit of the scene. `look` gets the
/// time in s and the world. `None` is no observation; the error is NaN if there never is one.
pub fn worst(mut look: impl FnMut(f64, &dyn World) -> Option<f64> + 'static) -> Box<dyn Watch> {
    watch(move |time, world| look(time, world).map(Observation::Fine))
}

/// Creates a watch whose error is the last one that `look` returns, for quantities that count only at the end of a run.
/// `look` gets the time in s and the world. The error is NaN before the first one.
pub fn last(mut look: impl FnMut(f64, &dyn World) -> Option<f64> + 'static) -> Box<dyn Watch> {
    watch(move |time, world| look(time, world).map(Observation::Ends))
}

/// Creates a watch from a function of the time in s and the world, which is called once before the first step and then after
/// each step. `None` is no observation. A run also fails if the state of an object is not finite; `look` never gets such a
/// state.
pub fn watch(mut look: impl FnMut(f64, &dyn World) -> Option<Observation> + 'static) -> Box<dyn Watch> {
    custom_watch(
        // The maximum of the errors that are fine, and the last observation.
        (Maximum::default(), None),
        move |(largest, last), time, world| {
            let seen = match last {
                Some(Observation::Failed(..)) => None,
                _ if world.is_finite() => look(time, world),
                _ => Some(Observation::Failed(NOT_FINITE, f64::INFINITY)),
            };
            if let Some(Observation::Fine(error)) = seen {
                largest.take(error);
            }
            *last = seen.or(*last);
        },
        |(largest, last)| match last {
            Some(Observation::Ends(error) | Observation::Open(_, error) | Observation::Failed(_, error)) => {
                *error
            }
            _ => largest.get(),
        },
        |(_, last)| match last {
            Some(Observation::Open(reason, _) | Observation::Failed(reason, _)) => Some(*reason),
            _ => None,
        },
    )
}

/// Wraps a watch with a test of failure: the run fails with the first reason that `verdict` returns. It also fails if the
/// state of a body is not finite, if a body is more than `reach` px from the origin, or if the wrapped watch has no finite
/// error.
pub fn failing(
    watch: Box<dyn Watch>,
    reach: f64,
    mut verdict: impl FnMut(f64, &dyn World) -> Option<&'static str> + 'static,
) -> Box<dyn Watch> {
    custom_watch(
        (watch, None),
        move |(watch, failed), time, world| {
            if failed.is_none() {
                *failed = strayed(world, reach).or_else(|| verdict(time, world));
                watch.observe(time, world);
            }
        },
        |(watch, failed)| if failed.is_some() { f64::INFINITY } else { watch.error() },
        |(watch, failed)| {
            let nothing = || (!watch.error().is_finite()).then_some("nothing to measure");
            failed.or_else(|| watch.failed()).or_else(nothing)
        },
    )
}

/// Wraps a watch: the run fails if the state of a body is not finite, or if a body is more than `reach` px from the origin.
pub fn in_reach(watch: Box<dyn Watch>, reach: f64) -> Box<dyn Watch> {
    failing(watch, reach, |_, _| None)
}

/// Returns the reason if the state of a body is not finite, or if a body is more than `reach` px from the origin; else
/// `None`.
pub fn strayed(world: &dyn World, reach: f64) -> Option<&'static str> {
    (0..world.body_count()).map(|index| world.body(index)).find_map(|body| {
        if !body.is_finite() {
            Some(NOT_FINITE)
        } else if distance(body.position, [0.0; 3]) > reach {
            Some("flew off")
        } else {
            None
        }
    })
}

/// Returns the root mean square of the speeds of the bodies with the indices `bodies`, in px/s.
pub(crate) fn mean_speed(world: &dyn World, bodies: &[usize]) -> f64 {
    let squares: f64 = bodies.iter().map(|&index| world.body(index).speed().powi(2)).sum();
    (squares / bodies.len().max(1) as f64).sqrt()
}

/// Returns the greatest value of `measure` over the bodies with the indices `bodies`, in the unit of `measure`.
pub(crate) fn greatest(world: &dyn World, bodies: &[usize], measure: impl Fn(BodyState) -> f64) -> f64 {
    bodies.iter().map(|&index| measure(world.body(index))).fold(f64::NEG_INFINITY, f64::max)
}

/// Returns the least value of `measure` over the bodies with the indices `bodies`, in the unit of `measure`.
pub(crate) fn least(world: &dyn World, bodies: &[usize], measure: impl Fn(BodyState) -> f64) -> f64 {
    bodies.iter().map(|&index| measure(world.body(index))).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engines::depth::TwoHalf;
    use crate::scenes::depth::bounce;

    /// Returns error and reason of failure of a watch after the observations `looks`.
    fn watched(looks: &'static [Observation]) -> (f64, Option<&'static str>) {
        let world = TwoHalf::new(&bounce());
        let mut looks = looks.iter().copied();
        let mut watch = watch(move |_, _| looks.next());
        (0..8).for_each(|step| watch.observe(f64::from(step), &world));
        (watch.error(), watch.failed())
    }

    #[test]
    fn the_error_is_the_maximum_of_the_fine_observations() {
        assert_eq!(
            watched(&[Observation::Fine(1.0), Observation::Fine(3.0), Observation::Fine(2.0)]),
            (3.0, None)
        );
    }

    #[test]
    fn the_error_at_the_end_is_the_last_one() {
        assert_eq!(
            watched(&[Observation::Open("lost", 9.0), Observation::Ends(3.0), Observation::Ends(2.0)]),
            (2.0, None)
        );
    }

    #[test]
    fn an_error_open_at_the_end_fails_and_one_closed_before_does_not() {
        assert_eq!(watched(&[Observation::Fine(1.0), Observation::Open("lost", 9.0)]), (9.0, Some("lost")));
        assert_eq!(watched(&[Observation::Open("lost", 9.0), Observation::Fine(1.0)]), (1.0, None));
    }

    #[test]
    fn a_failure_is_final() {
        assert_eq!(watched(&[Observation::Failed("lost", 2.0), Observation::Fine(3.0)]), (2.0, Some("lost")));
    }

    #[test]
    fn the_worse_of_two_observations_counts_with_the_larger_error() {
        assert_eq!(Observation::Fine(2.0).and(Observation::Ends(1.0)), Observation::Ends(2.0));
        assert_eq!(
            Observation::Ends(2.0).and(Observation::Open("lost", 1.0)),
            Observation::Open("lost", 2.0)
        );
        assert_eq!(
            Observation::Open("lost", 1.0).and(Observation::Failed("gone", 0.5)),
            Observation::Failed("gone", 1.0)
        );
    }
}
