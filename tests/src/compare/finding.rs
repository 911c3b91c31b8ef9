//! Single differences of two traces, written for the eye.

use crate::trace::{ArbiterLine, Event, StepLine};
use std::fmt;

/// A single difference. "Expected" is the original's value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Finding {
    /// A line of the header.
    Header {
        /// The original's line.
        expected: String,
        /// The line found.
        actual: String,
    },
    /// An event, or a missing or additional one.
    Event {
        /// The step.
        step: u32,
        /// Position among the events of the step.
        index: usize,
        /// The original's event.
        expected: Option<Event>,
        /// The event found.
        actual: Option<Event>,
    },
    /// The line of a step: hash, number of arbiters, number of contacts.
    Step {
        /// The step.
        step: u32,
        /// The original's line.
        expected: Option<StepLine>,
        /// The line found.
        actual: Option<StepLine>,
    },
    /// The bodies in the simulator's list.
    BodyList {
        /// The step.
        step: u32,
        /// The original's list.
        expected: Vec<usize>,
        /// The list found.
        actual: Vec<usize>,
    },
    /// A float of a body or contact.
    Word {
        /// The step.
        step: u32,
        /// The body or contact.
        place: Place,
        /// Which.
        field: &'static str,
        /// The original's value, as a bit pattern.
        expected: u32,
        /// The value found, as a bit pattern.
        actual: u32,
    },
    /// The flags of a body: 1 for an enabled and 2 for a static one, added up.
    Flags {
        /// The step.
        step: u32,
        /// Index of the body.
        body: usize,
        /// The original's flags.
        expected: u32,
        /// The flags found.
        actual: u32,
    },
    /// A pair that touches, or a missing or additional one.
    Arbiter {
        /// The step.
        step: u32,
        /// Position in the arbiter list.
        index: usize,
        /// The original's pair.
        expected: Option<ArbiterLine>,
        /// The pair found.
        actual: Option<ArbiterLine>,
    },
    /// The id of a contact.
    ContactId {
        /// The step.
        step: u32,
        /// The pair.
        pair: ArbiterLine,
        /// The original's id.
        expected: [i32; 3],
        /// The id found.
        actual: [i32; 3],
    },
    /// An exception of the original.
    Thrown {
        /// The step.
        step: u32,
        /// Type of the original's exception.
        expected: Option<String>,
        /// Type of the exception found.
        actual: Option<String>,
    },
    /// Number of completed steps and cumulative hash.
    End {
        /// The original's.
        expected: Option<(u32, u64)>,
        /// The numbers found.
        actual: Option<(u32, u64)>,
    },
}

/// The owner of a float.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// A body's, by index.
    Body(usize),
    /// A contact's.
    Contact {
        /// Id of the pair's first geom.
        geom_a: usize,
        /// Id of the pair's second geom.
        geom_b: usize,
        /// Id of the contact.
        id: [i32; 3],
    },
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Finding::Header { expected, actual } => {
                write!(f, "header: expected `{expected}`, found `{actual}`")
            }
            Finding::Event { step, index, expected, actual } => {
                let (expected, actual) = (or_none(expected.as_ref()), or_none(actual.as_ref()));
                write!(f, "step {step}, event {index}: expected {expected}, found {actual}")
            }
            Finding::Step { step, expected, actual } => step_line(f, *step, *expected, *actual),
            Finding::BodyList { step, expected, actual } => {
                write!(f, "step {step}, bodies in the list: expected {expected:?}, found {actual:?}")
            }
            Finding::Word { step, place, field, expected, actual } => {
                write!(f, "step {step}, {place}, {field}: expected ")?;
                float(f, *expected)?;
                write!(f, ", found ")?;
                float(f, *actual)?;
                match ulps(*expected, *actual) {
                    Some(ulps) => write!(f, ", {ulps} ulps apart"),
                    None => Ok(()),
                }
            }
            Finding::Flags { step, body, expected, actual } => {
                write!(f, "step {step}, body {body}, flags: expected {expected}, found {actual}")
            }
            Finding::Arbiter { step, index, expected, actual } => {
                let (expected, actual) = (or_none(expected.as_ref()), or_none(actual.as_ref()));
                write!(f, "step {step}, arbiter {index}: expected {expected}, found {actual}")
            }
            Finding::ContactId { step, pair, expected, actual } => {
                write!(f, "step {step}, arbiter {pair}, contact: expected {expected:?}, found {actual:?}")
            }
            Finding::Thrown { step, expected, actual } => {
                let (expected, actual) = (or_none(expected.as_ref()), or_none(actual.as_ref()));
                write!(f, "step {step}, exception: expected {expected}, found {actual}")
            }
            Finding::End { expected, actual } => {
                let text = |end: &Option<(u32, u64)>| end.map(|(steps, hash)| format!("{steps} {hash:016x}"));
                let (expected, actual) = (text(expected), text(actual));
                let (expected, actual) = (or_none(expected.as_ref()), or_none(actual.as_ref()));
                write!(f, "end: expected {expected}, found {actual}")
            }
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Body(body) => write!(f, "body {body}"),
            Place::Contact { geom_a, geom_b, id: [geom_1, vertex, geom_2] } => {
                write!(f, "geoms {geom_a} and {geom_b}, contact {geom_1} {vertex} {geom_2}")
            }
        }
    }
}

/// A line as the trace has it, without its letter and step.
fn or_none(line: Option<&impl fmt::Display>) -> String {
    line.map_or_else(|| "none".to_owned(), |line| format!("`{line}`"))
}

fn step_line(
    f: &mut fmt::Formatter<'_>,
    step: u32,
    expected: Option<StepLine>,
    actual: Option<StepLine>,
) -> fmt::Result {
    let (Some(expected), Some(actual)) = (expected, actual) else {
        let (expected, actual) = (or_none(expected.as_ref()), or_none(actual.as_ref()));
        return write!(f, "step {step}: expected {expected}, found {actual}");
    };
    write!(f, "step {step}: hash {:016x} expected, {:016x} found", expected.hash, actual.hash)?;
    if expected.arbiters != actual.arbiters {
        write!(f, "; {} arbiters expected, {} found", expected.arbiters, actual.arbiters)?;
    }
    if expected.contacts != actual.contacts {
        write!(f, "; {} contacts expected, {} found", expected.contacts, actual.contacts)?;
    }
    Ok(())
}

fn float(f: &mut fmt::Formatter<'_>, bits: u32) -> fmt::Result {
    write!(f, "{:?} ({bits:08x})", f32::from_bits(bits))
}

/// Distance of two floats in ulps by their bit patterns, both zeros being the same; `None` if one is not a number.
pub fn ulps(a: u32, b: u32) -> Option<u32> {
    let rank = |bits: u32| {
        let magnitude = i64::from(bits & 0x7fff_ffff);
        if bits >> 31 == 0 { magnitude } else { -magnitude }
    };
    let is_number = |bits: u32| !f32::from_bits(bits).is_nan();
    // Two finite floats or infinities are at most 2 * 0x7f80_0000 apart, which is less than 2^32.
    (is_number(a) && is_number(b)).then(|| rank(a).abs_diff(rank(b)) as u32)
}

#[cfg(test)]
mod tests {
    use super::ulps;

    #[test]
    fn neighbouring_floats_are_one_ulp_apart() {
        assert_eq!(ulps(1.0_f32.to_bits(), 1.0_f32.next_up().to_bits()), Some(1));
        assert_eq!(ulps((-1.0_f32).to_bits(), (-1.0_f32).next_down().to_bits()), Some(1));
    }

    #[test]
    fn the_distance_goes_through_zero() {
        assert_eq!(ulps(f32::from_bits(2).to_bits(), (-f32::from_bits(3)).to_bits()), Some(5));
        assert_eq!(ulps(0.0_f32.to_bits(), (-0.0_f32).to_bits()), Some(0));
    }

    #[test]
    fn the_two_infinities_are_farthest_apart() {
        assert_eq!(ulps(f32::INFINITY.to_bits(), f32::NEG_INFINITY.to_bits()), Some(0xff00_0000));
    }

    #[test]
    fn nan_has_no_distance_in_ulps() {
        assert_eq!(ulps(f32::NAN.to_bits(), 1.0_f32.to_bits()), None);
    }
}
