//! Differences of two traces.

mod finding;

pub use finding::{Finding, Place, ulps};

use crate::trace::{ArbiterLine, BodyLine, ContactLine, Event, Line, StepLine, Trace};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// The first step at which two traces differ, and how.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Difference {
    /// The step, 0 for the header and the state before the first step.
    pub step: u32,
    /// Differences at that step, or at the next full state if there is none at that step.
    pub findings: Vec<Finding>,
}

impl Difference {
    /// Number of findings that are printed; the first ones are the most informative.
    const SHOWN: usize = 12;
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "differs at step {}", self.step)?;
        for finding in self.findings.iter().take(Self::SHOWN) {
            write!(f, "\n    {finding}")?;
        }
        if self.findings.len() > Self::SHOWN {
            write!(f, "\n    ... and {} more", self.findings.len() - Self::SHOWN)?;
        }
        Ok(())
    }
}

/// Compares a trace with the expected one: all of it, or only the steps before a fault of the original that is not reproduced.
pub fn compare(expected: &Trace, actual: &Trace, before: Option<u32>) -> Option<Difference> {
    let mut findings = header(expected, actual);
    let (expected_moments, actual_moments) = (moments(expected), moments(actual));
    let steps: BTreeSet<u32> = expected_moments.keys().chain(actual_moments.keys()).copied().collect();
    let nothing = Moment::default();
    let mut first = (!findings.is_empty()).then_some(0);
    for step in steps.into_iter().filter(|&step| before.is_none_or(|before| step < before)) {
        let expected = expected_moments.get(&step).unwrap_or(&nothing);
        let actual = actual_moments.get(&step).unwrap_or(&nothing);
        if first.is_none() {
            findings.extend(expected.step_findings(actual, step));
        }
        findings.extend(expected.state_findings(actual, step));
        if !findings.is_empty() {
            first = first.or(Some(step));
            if expected.is_full() {
                break;
            }
        }
    }
    if first.is_none() && before.is_none() && expected.end() != actual.end() {
        let (steps, _) = expected.end().unwrap_or_default();
        first = Some(steps);
        findings.push(Finding::End { expected: expected.end(), actual: actual.end() });
    }
    first.map(|step| Difference { step, findings })
}

fn header(expected: &Trace, actual: &Trace) -> Vec<Finding> {
    if expected.header == actual.header {
        return Vec::new();
    }
    let (expected, actual) = (expected.header.to_string(), actual.header.to_string());
    let mut lines = (expected.lines(), actual.lines());
    let mut findings = Vec::new();
    loop {
        match (lines.0.next(), lines.1.next()) {
            (None, None) => return findings,
            (expected, actual) if expected == actual => {}
            (expected, actual) => findings.push(Finding::Header {
                expected: expected.unwrap_or_default().to_owned(),
                actual: actual.unwrap_or_default().to_owned(),
            }),
        }
    }
}

/// The lines of a trace for one step.
#[derive(Default)]
struct Moment<'a> {
    events: Vec<&'a Event>,
    line: Option<StepLine>,
    bodies: Vec<BodyLine>,
    arbiters: Vec<(ArbiterLine, Vec<ContactLine>)>,
    thrown: Option<&'a str>,
}

/// The lines of a trace by step.
fn moments(trace: &Trace) -> BTreeMap<u32, Moment<'_>> {
    let mut moments: BTreeMap<u32, Moment<'_>> = BTreeMap::new();
    let mut current = 0;
    for line in &trace.lines {
        current = match line {
            Line::Event { step, .. } | Line::Step(StepLine { step, .. }) | Line::Thrown { step, .. } => *step,
            Line::Body(_) | Line::Arbiter(_) | Line::Contact(_) => current,
            Line::End { .. } => break,
        };
        let moment = moments.entry(current).or_default();
        match line {
            Line::Event { event, .. } => moment.events.push(event),
            Line::Step(line) => moment.line = Some(*line),
            Line::Body(line) => moment.bodies.push(*line),
            Line::Arbiter(line) => moment.arbiters.push((*line, Vec::new())),
            Line::Contact(line) => {
                if let Some((_, contacts)) = moment.arbiters.last_mut() {
                    contacts.push(*line);
                }
            }
            Line::Thrown { exception, .. } => moment.thrown = Some(exception),
            Line::End { .. } => {}
        }
    }
    moments
}

impl Moment<'_> {
    /// Whether the state of the bodies is given.
    fn is_full(&self) -> bool {
        !self.bodies.is_empty()
    }

    /// Differences of the events and of the line of the step.
    fn step_findings(&self, actual: &Moment<'_>, step: u32) -> Vec<Finding> {
        let mut findings = Vec::new();
        let events = self.events.len().max(actual.events.len());
        let different = (0..events).find(|&index| self.events.get(index) != actual.events.get(index));
        if let Some(index) = different {
            let event = |moment: &Moment<'_>| moment.events.get(index).map(|&event| event.clone());
            findings.push(Finding::Event { step, index, expected: event(self), actual: event(actual) });
        }
        if self.line != actual.line {
            findings.push(Finding::Step { step, expected: self.line, actual: actual.line });
        }
        if self.thrown != actual.thrown {
            let thrown = |moment: &Moment<'_>| moment.thrown.map(str::to_owned);
            findings.push(Finding::Thrown { step, expected: thrown(self), actual: thrown(actual) });
        }
        findings
    }

    /// Differences of the full state.
    fn state_findings(&self, actual: &Moment<'_>, step: u32) -> Vec<Finding> {
        let mut findings = Vec::new();
        let list = |moment: &Moment<'_>| moment.bodies.iter().map(|line| line.body).collect::<Vec<_>>();
        let (expected_list, actual_list) = (list(self), list(actual));
        if expected_list != actual_list {
            findings.push(Finding::BodyList { step, expected: expected_list, actual: actual_list });
        }
        let line_of = |body| actual.bodies.iter().find(|line| line.body == body);
        for expected in &self.bodies {
            if let Some(actual) = line_of(expected.body) {
                findings.extend(body_findings(expected, actual, step));
            }
        }
        findings.extend(self.contact_findings(actual, step));
        findings
    }

    /// The first difference of the pairs, or the differences of the first pair whose contacts differ.
    fn contact_findings(&self, actual: &Moment<'_>, step: u32) -> Vec<Finding> {
        let pairs = self.arbiters.len().max(actual.arbiters.len());
        for index in 0..pairs {
            match (self.arbiters.get(index), actual.arbiters.get(index)) {
                (Some((pair, expected)), Some((actual_pair, actual))) if pair == actual_pair => {
                    let findings = pair_findings(*pair, expected, actual, step);
                    if !findings.is_empty() {
                        return findings;
                    }
                }
                (expected, actual) => {
                    let pair = |pair: Option<&(ArbiterLine, Vec<ContactLine>)>| pair.map(|(line, _)| *line);
                    return vec![Finding::Arbiter {
                        step,
                        index,
                        expected: pair(expected),
                        actual: pair(actual),
                    }];
                }
            }
        }
        Vec::new()
    }
}

fn body_findings(expected: &BodyLine, actual: &BodyLine, step: u32) -> Vec<Finding> {
    let place = Place::Body(expected.body);
    let mut findings = words(step, place, &BodyLine::FIELDS, &expected.state, &actual.state);
    if expected.flags != actual.flags {
        findings.push(Finding::Flags {
            step,
            body: expected.body,
            expected: expected.flags,
            actual: actual.flags,
        });
    }
    findings
}

fn pair_findings(
    pair: ArbiterLine,
    expected: &[ContactLine],
    actual: &[ContactLine],
    step: u32,
) -> Vec<Finding> {
    let mut findings = Vec::new();
    for (expected, actual) in expected.iter().zip(actual) {
        if expected.id != actual.id {
            findings.push(Finding::ContactId { step, pair, expected: expected.id, actual: actual.id });
        }
        let place = Place::Contact { geom_a: pair.geom_a, geom_b: pair.geom_b, id: expected.id };
        findings.extend(words(step, place, &ContactLine::FIELDS, &expected.values, &actual.values));
    }
    findings
}

/// The words that differ.
fn words(step: u32, place: Place, fields: &[&'static str], expected: &[u32], actual: &[u32]) -> Vec<Finding> {
    let pairs = fields.iter().zip(expected.iter().zip(actual));
    let different = pairs.filter(|(_, (expected, actual))| expected != actual);
    different
        .map(|(&field, (&expected, &actual))| Finding::Word { step, place, field, expected, actual })
        .collect()
}
