//! Watching a run of a scene with depth.

use crate::error::{Largest, Watch};
use crate::stability::reasons::NOT_FINITE;
use crate::world::World;

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

/// Watches with a function of time in s and the world, from before the first step on; `None` where it looks away.
/// A run also fails when the state of an object is not finite; the function never sees such a state.
pub fn watch(look: impl FnMut(f64, &dyn World) -> Option<Seen> + 'static) -> Box<dyn Watch> {
    Box::new(Looking { look, largest: Largest::default(), last: None })
}

struct Looking<F> {
    look: F,
    /// Of what is fine.
    largest: Largest,
    last: Option<Seen>,
}

impl<F: FnMut(f64, &dyn World) -> Option<Seen>> Watch for Looking<F> {
    fn see(&mut self, time: f64, world: &dyn World) {
        if matches!(self.last, Some(Seen::Failed(..))) {
            return;
        }
        let seen = if world.is_finite() {
            (self.look)(time, world)
        } else {
            Some(Seen::Failed(NOT_FINITE, f64::INFINITY))
        };
        if let Some(Seen::Fine(error)) = seen {
            self.largest.take(error);
        }
        self.last = seen.or(self.last);
    }

    fn error(&self) -> f64 {
        match self.last {
            Some(Seen::Ends(error) | Seen::Open(_, error) | Seen::Failed(_, error)) => error,
            _ => self.largest.get(),
        }
    }

    fn failed(&self) -> Option<&'static str> {
        match self.last {
            Some(Seen::Open(reason, _) | Seen::Failed(reason, _)) => Some(reason),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::depth_scenes::bounce;
    use crate::peers::TwoHalf;

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
