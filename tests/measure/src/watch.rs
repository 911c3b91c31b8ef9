//! Watching a run, and saying in one number how wrong it was.

use crate::stability::reasons::NOT_FINITE;
use crate::world::{BodyState, World, distance};

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

/// A watch made of what it keeps, what it does with it after a step (given the time in s), the error and the failure.
pub fn made_of<S: 'static>(
    kept: S,
    see: impl FnMut(&mut S, f64, &dyn World) + 'static,
    error: impl Fn(&S) -> f64 + 'static,
    failed: impl Fn(&S) -> Option<&'static str> + 'static,
) -> Box<dyn Watch> {
    Box::new(MadeOf { kept, see, error, failed })
}

struct MadeOf<S, See, Error, Failed> {
    kept: S,
    see: See,
    error: Error,
    failed: Failed,
}

impl<S, See, Error, Failed> Watch for MadeOf<S, See, Error, Failed>
where
    See: FnMut(&mut S, f64, &dyn World),
    Error: Fn(&S) -> f64,
    Failed: Fn(&S) -> Option<&'static str>,
{
    fn see(&mut self, time: f64, world: &dyn World) {
        (self.see)(&mut self.kept, time, world);
    }

    fn error(&self) -> f64 {
        (self.error)(&self.kept)
    }

    fn failed(&self) -> Option<&'static str> {
        (self.failed)(&self.kept)
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

/// What is seen at one moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Seen {
    /// Nothing is wrong but by this much; the largest of these is the error.
    Fine(f64),
    /// Nothing is wrong if it stays so until the end; the last of these is the error.
    Ends(f64),
    /// It is a failure if it stays so until the end: why, and how wrong it is.
    Open(&'static str, f64),
    /// It is a failure whatever comes: why, and how wrong it is.
    Failed(&'static str, f64),
}

impl Seen {
    /// Both: the worse of them, and the larger error.
    pub fn and(self, other: Seen) -> Seen {
        let larger = self.error().max(other.error());
        match (self, other) {
            (Seen::Failed(reason, _), _) | (_, Seen::Failed(reason, _)) => Seen::Failed(reason, larger),
            (Seen::Open(reason, _), _) | (_, Seen::Open(reason, _)) => Seen::Open(reason, larger),
            (Seen::Ends(_), _) | (_, Seen::Ends(_)) => Seen::Ends(larger),
            (Seen::Fine(_), Seen::Fine(_)) => Seen::Fine(larger),
        }
    }

    fn error(self) -> f64 {
        match self {
            Seen::Fine(error) | Seen::Ends(error) | Seen::Open(_, error) | Seen::Failed(_, error) => error,
        }
    }
}

/// Keeps the largest of the errors that a function sees. It may look away (`None`); if it never looked, the error is NaN.
pub fn worst(mut look: impl FnMut(f64, &dyn World) -> Option<f64> + 'static) -> Box<dyn Watch> {
    watch(move |time, world| look(time, world).map(Seen::Fine))
}

/// Keeps the last of the errors that a function sees, for what counts at the end of a run only. NaN as long as there was
/// none.
pub fn last(mut look: impl FnMut(f64, &dyn World) -> Option<f64> + 'static) -> Box<dyn Watch> {
    watch(move |time, world| look(time, world).map(Seen::Ends))
}

/// Watches with a function of time in s and the world, from before the first step on; `None` where it looks away.
/// A run also fails when the state of an object is not finite; the function never sees such a state.
pub fn watch(mut look: impl FnMut(f64, &dyn World) -> Option<Seen> + 'static) -> Box<dyn Watch> {
    made_of(
        // The largest of what is fine, and what was seen last.
        (Largest::default(), None),
        move |(largest, last), time, world| {
            let seen = match last {
                Some(Seen::Failed(..)) => None,
                _ if world.is_finite() => look(time, world),
                _ => Some(Seen::Failed(NOT_FINITE, f64::INFINITY)),
            };
            if let Some(Seen::Fine(error)) = seen {
                largest.take(error);
            }
            *last = seen.or(*last);
        },
        |(largest, last)| match last {
            Some(Seen::Ends(error) | Seen::Open(_, error) | Seen::Failed(_, error)) => *error,
            _ => largest.get(),
        },
        |(_, last)| match last {
            Some(Seen::Open(reason, _) | Seen::Failed(reason, _)) => Some(*reason),
            _ => None,
        },
    )
}

/// Another watch, and what counts as a failure: the first word a function says stays. Besides, a run fails when
/// the state of a body is not finite or lies outside of the scene, and when there was nothing to measure.
/// Farther than `reach` px from the origin nothing belongs to the scene any more.
pub fn failing(
    watch: Box<dyn Watch>,
    reach: f64,
    mut verdict: impl FnMut(f64, &dyn World) -> Option<&'static str> + 'static,
) -> Box<dyn Watch> {
    made_of(
        (watch, None),
        move |(watch, failed), time, world| {
            if failed.is_none() {
                *failed = strayed(world, reach).or_else(|| verdict(time, world));
                watch.see(time, world);
            }
        },
        |(watch, failed)| if failed.is_some() { f64::INFINITY } else { watch.error() },
        |(watch, failed)| {
            let nothing = || (!watch.error().is_finite()).then_some("nothing to measure");
            failed.or_else(|| watch.failed()).or_else(nothing)
        },
    )
}

/// Another watch that fails when a body's state is not finite, or lies farther from the origin than `reach` px.
pub fn in_reach(watch: Box<dyn Watch>, reach: f64) -> Box<dyn Watch> {
    failing(watch, reach, |_, _| None)
}

/// Whether a body's state is not finite, or farther from the origin than `reach` px.
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

/// The root of the mean of the squared speeds of some bodies, in px/s.
pub(crate) fn mean_speed(world: &dyn World, bodies: &[usize]) -> f64 {
    let squares: f64 = bodies.iter().map(|&index| world.body(index).speed().powi(2)).sum();
    (squares / bodies.len().max(1) as f64).sqrt()
}

/// The greatest value of a measure of some bodies.
pub(crate) fn greatest(world: &dyn World, bodies: &[usize], measure: impl Fn(BodyState) -> f64) -> f64 {
    bodies.iter().map(|&index| measure(world.body(index))).fold(f64::NEG_INFINITY, f64::max)
}

/// The least value of a measure of some bodies.
pub(crate) fn least(world: &dyn World, bodies: &[usize], measure: impl Fn(BodyState) -> f64) -> f64 {
    bodies.iter().map(|&index| measure(world.body(index))).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engines::depth::TwoHalf;
    use crate::scenes::depth::bounce;

    /// What is made of some looks.
    fn watched(looks: &'static [Seen]) -> (f64, Option<&'static str>) {
        let world = TwoHalf::new(&bounce());
        let mut looks = looks.iter().copied();
        let mut watch = watch(move |_, _| looks.next());
        (0..8).for_each(|step| watch.see(f64::from(step), &world));
        (watch.error(), watch.failed())
    }

    #[test]
    fn the_error_is_the_largest_of_what_is_fine() {
        assert_eq!(watched(&[Seen::Fine(1.0), Seen::Fine(3.0), Seen::Fine(2.0)]), (3.0, None));
    }

    #[test]
    fn the_error_at_the_end_is_the_last_one() {
        assert_eq!(watched(&[Seen::Open("lost", 9.0), Seen::Ends(3.0), Seen::Ends(2.0)]), (2.0, None));
    }

    #[test]
    fn what_is_open_at_the_end_has_failed_and_what_closed_before_has_not() {
        assert_eq!(watched(&[Seen::Fine(1.0), Seen::Open("lost", 9.0)]), (9.0, Some("lost")));
        assert_eq!(watched(&[Seen::Open("lost", 9.0), Seen::Fine(1.0)]), (1.0, None));
    }

    #[test]
    fn what_has_failed_stays_so() {
        assert_eq!(watched(&[Seen::Failed("lost", 2.0), Seen::Fine(3.0)]), (2.0, Some("lost")));
    }

    #[test]
    fn of_two_looks_the_worse_counts_with_the_larger_error() {
        assert_eq!(Seen::Fine(2.0).and(Seen::Ends(1.0)), Seen::Ends(2.0));
        assert_eq!(Seen::Ends(2.0).and(Seen::Open("lost", 1.0)), Seen::Open("lost", 2.0));
        assert_eq!(Seen::Open("lost", 1.0).and(Seen::Failed("gone", 0.5)), Seen::Failed("gone", 1.0));
    }
}
