//! Checks runs against the recordings of the original: one scene, or folders of them.
//!
//! A scene in which the original threw an exception, or in which a body's state stopped being a number, is compared up to the
//! step before that. From there on this engine has a behaviour of its own, which is checked instead:
//!
//! - Where the original refused to create or set a value with an exception, this engine returns an error.
//! - Where the original threw in an update the run goes on to the end, and every body's state stays finite.
//! - Where the original went on with NaN or infinity, that is reported at the latest one step later
//!   ([`Event::NotFinite`](farseer_core::Event::NotFinite) of a body, or the like of a joint, spring or controller). Otherwise
//!   the faulty value of the scene has been rejected before.

mod folder;
mod summary;

pub use folder::{Entry, entries};
pub use summary::{Summary, check_folders};

use crate::compare::{Difference, compare};
use crate::run::{Recording, record};
use crate::scene::{Features, Reason, Scene};
use crate::trace::{Line, Trace};
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Outcome of a check of a scene.
#[derive(Debug)]
pub enum Reproduction {
    /// Every byte of the trace is reproduced.
    Exact,
    /// Everything is equal up to the step before a fault of the original that this engine does not reproduce, and the behaviour
    /// from there on is the documented one.
    ExactUntil {
        /// The last step compared.
        step: u32,
        /// The fault of the original in the next step.
        original: String,
    },
    /// The scene needs a feature that the caller excludes.
    Skipped(Features),
    /// The trace is not reproduced.
    Differs(Box<Difference>),
    /// The scene could not be run or does not behave as documented.
    Failed(String),
}

impl Reproduction {
    /// Whether the scene was run and is as it should be.
    pub fn is_exact(&self) -> bool {
        matches!(self, Reproduction::Exact | Reproduction::ExactUntil { .. })
    }

    /// Whether the scene was skipped on request.
    pub fn is_skipped(&self) -> bool {
        matches!(self, Reproduction::Skipped(_))
    }

    /// Whether the check failed.
    pub fn is_failure(&self) -> bool {
        matches!(self, Reproduction::Differs(_) | Reproduction::Failed(_))
    }
}

impl fmt::Display for Reproduction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Reproduction::Exact => write!(f, "exact"),
            Reproduction::ExactUntil { step, original } => {
                write!(f, "exact until step {step}, as documented after it ({original})")
            }
            Reproduction::Skipped(features) => write!(f, "skipped ({features})"),
            Reproduction::Differs(difference) => write!(f, "{difference}"),
            Reproduction::Failed(reason) => write!(f, "failed: {reason}"),
        }
    }
}

/// Checks a scene against the text of its trace, and skips it if it needs an excluded feature. A panic is caught and reported
/// as a failure.
pub fn check(scene: &Scene, trace: &str, skip: Features) -> Reproduction {
    let needs = scene.features();
    if !needs.and(skip).is_empty() {
        return Reproduction::Skipped(needs.and(skip));
    }
    let expected: Trace = match trace.parse() {
        Ok(expected) => expected,
        Err(error) => return Reproduction::Failed(format!("the trace {error}")),
    };
    guard(|| judge(scene, &expected, trace, &record(scene)))
}

/// Makes a panic a failure.
fn guard(check: impl FnOnce() -> Reproduction) -> Reproduction {
    catch_unwind(AssertUnwindSafe(check))
        .unwrap_or_else(|panic| Reproduction::Failed(format!("panicked: {}", message(panic.as_ref()))))
}

/// The text of a panic.
fn message(panic: &(dyn std::any::Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no message")
}

/// Compares the recording of a run with the expected trace.
pub fn judge(scene: &Scene, expected: &Trace, text: &str, recording: &Recording) -> Reproduction {
    let unusual = match Unusual::of(scene, expected) {
        Ok(unusual) => unusual,
        Err(reason) => return Reproduction::Failed(reason),
    };
    if !is_header_of(scene, expected) {
        return Reproduction::Failed("the header of the trace is that of another scene".to_owned());
    }
    let Some(step) = unusual.first() else {
        if let Some((step, error)) = &recording.error {
            return Reproduction::Failed(format!("step {step}: {error}"));
        }
        return match compare(expected, &recording.trace, None) {
            Some(difference) => Reproduction::Differs(Box::new(difference)),
            None if recording.trace.to_string() != text => {
                Reproduction::Failed("the lines are equal, but the texts are not".to_owned())
            }
            None => Reproduction::Exact,
        };
    };
    // A scene that cannot be built has only the first lines of the header to compare.
    if step > 0
        && let Some(difference) = compare(expected, &recording.trace, Some(step))
    {
        return Reproduction::Differs(Box::new(difference));
    }
    match unusual.check(scene, recording) {
        Ok(()) => Reproduction::ExactUntil { step: step.saturating_sub(1), original: unusual.to_string() },
        Err(reason) => Reproduction::Failed(format!("the original: {unusual}; here: {reason}")),
    }
}

/// Whether the header of a trace agrees with the scene.
fn is_header_of(scene: &Scene, trace: &Trace) -> bool {
    let header = &trace.header;
    header.scene == scene.name
        && header.steps == scene.steps
        && header.dt == scene.dt.to_bits()
        && header.full_every == scene.trace.full_every
}

/// A fault of the original that this engine does not reproduce.
struct Unusual {
    thrown: Option<(u32, String)>,
    first_nan_step: Option<u32>,
}

impl fmt::Display for Unusual {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(step) = self.first_nan_step {
            write!(f, "not a number at step {step}")?;
        }
        if let Some((step, exception)) = &self.thrown {
            let comma = if self.first_nan_step.is_some() { ", " } else { "" };
            write!(f, "{comma}{exception} at step {step}")?;
        }
        Ok(())
    }
}

impl Unusual {
    /// The fault by the scene and by the trace, which must be the same.
    fn of(scene: &Scene, trace: &Trace) -> Result<Self, String> {
        let in_trace = trace.lines.iter().find_map(|line| match line {
            Line::Thrown { step, exception } => Some((*step, exception.clone())),
            _ => None,
        });
        let in_scene = scene.outcome.throw_step.zip(scene.outcome.throws.clone());
        if in_scene != in_trace {
            return Err(format!(
                "the scene says that the original threw {in_scene:?}, the trace {in_trace:?}"
            ));
        }
        Ok(Unusual { thrown: in_scene, first_nan_step: scene.outcome.first_nan_step })
    }

    /// The first step that is not compared.
    fn first(&self) -> Option<u32> {
        let thrown = self.thrown.as_ref().map(|(step, _)| *step);
        [thrown, self.first_nan_step].into_iter().flatten().min()
    }

    /// Checks the documented behaviour.
    fn check(&self, scene: &Scene, recording: &Recording) -> Result<(), String> {
        if let Some((step, exception)) = &self.thrown
            && self.is_refusal_due(scene, *step, exception, recording)
        {
            return check_refusal(*step, recording);
        }
        if let Some((step, error)) = &recording.error {
            // A value that is not finite is rejected here before it can make any other one infinite or NaN.
            let in_time = self.first_nan_step.is_some_and(|limit| *step <= limit);
            return match error.reason {
                Reason::NotFinite(_) if in_time => Ok(()),
                _ => Err(format!("refused at step {step}: {error}")),
            };
        }
        if let Some((step, body)) = recording.not_finite {
            return Err(format!("body {body} is not finite after step {step}"));
        }
        match (self.first_nan_step, recording.reported) {
            (None, _) => Ok(()),
            (Some(limit), Some(reported)) if reported <= limit.saturating_add(1) => Ok(()),
            (Some(limit), Some(reported)) => Err(format!(
                "a body that stopped being finite was reported at step {reported}, not until step {}",
                limit.saturating_add(1)
            )),
            (Some(_), None) => Err("no body that stopped being finite was reported".to_owned()),
        }
    }

    /// Whether the original threw when a value was created or set, so that this engine must return an error.
    fn is_refusal_due(&self, scene: &Scene, step: u32, exception: &str, recording: &Recording) -> bool {
        if step == 0 {
            return true;
        }
        let scripted = scene.script.iter().any(|entry| entry.is_due(step));
        let refused = recording.error.as_ref().is_some_and(|(at, _)| *at == step);
        match Thrower::of(exception) {
            Thrower::Setter => scripted,
            Thrower::Update => false,
            Thrower::Either => refused,
        }
    }
}

/// Where the original throws an exception of some type.
enum Thrower {
    /// An exception of a constructor or setter.
    Setter,
    /// In an update.
    Update,
    /// In both.
    Either,
}

impl Thrower {
    fn of(exception: &str) -> Self {
        match exception.rsplit('.').next().unwrap_or_default() {
            "ArgumentOutOfRangeException"
            | "ArgumentNullException"
            | "OverflowException"
            | "OutOfMemoryException" => Thrower::Setter,
            "ArithmeticException" | "IndexOutOfRangeException" | "KeyNotFoundException" => Thrower::Update,
            _ => Thrower::Either,
        }
    }
}

fn check_refusal(step: u32, recording: &Recording) -> Result<(), String> {
    match &recording.error {
        Some((at, error)) if *at == step && error.is_refusal() => Ok(()),
        Some((at, error)) => Err(format!("step {at}: {error}")),
        None => Err("nothing was refused".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::{Reproduction, guard};

    #[test]
    fn a_panic_is_a_failure_with_its_message() {
        let verdict = guard(|| panic!("{} is too much", 5));
        assert_eq!(verdict.to_string(), "failed: panicked: 5 is too much");
    }

    #[test]
    fn a_result_without_panic_is_returned() {
        assert!(guard(|| Reproduction::Exact).is_exact());
    }
}
