//! Traces from text.

use super::{ArbiterLine, BodyLine, ContactLine, Counts, Event, Header, Line, StepLine, Trace};
use std::iter::Peekable;
use std::str::{FromStr, Lines, SplitAsciiWhitespace};

/// Why a text is not a trace.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TraceError {
    /// The file cannot be read.
    #[error("cannot be read: {0}")]
    File(#[from] std::io::Error),
    /// A line does not conform to the format.
    #[error("line {line}: {reason}")]
    Line {
        /// Number of the line, from 1.
        line: usize,
        /// The fault of the line.
        reason: String,
    },
    /// The text ends before its `end` line.
    #[error("ends without an `end` line")]
    Unfinished,
}

impl FromStr for Trace {
    type Err = TraceError;

    fn from_str(text: &str) -> Result<Self, TraceError> {
        let mut lines = text.lines().peekable();
        let mut number = 0;
        let header =
            header(&mut lines, &mut number).map_err(|reason| TraceError::Line { line: number, reason })?;
        let mut trace = Trace { header, lines: Vec::new() };
        for text in lines {
            number += 1;
            if trace.end().is_some() {
                return Err(TraceError::Line {
                    line: number,
                    reason: "comes after the `end` line".to_owned(),
                });
            }
            trace.lines.push(line(text).map_err(|reason| TraceError::Line { line: number, reason })?);
        }
        if trace.end().is_some() { Ok(trace) } else { Err(TraceError::Unfinished) }
    }
}

/// The header; `number` counts the lines.
fn header(lines: &mut Peekable<Lines<'_>>, number: &mut usize) -> Result<Header, String> {
    let mut value = |key: &str| {
        *number += 1;
        let line = lines.next().unwrap_or_default();
        let value = line.strip_prefix(key).and_then(|rest| rest.strip_prefix(' '));
        value.map(str::to_owned).ok_or_else(|| format!("\"{line}\" where `{key}` should be"))
    };
    let format = value("farseer-trace")?;
    if format != "1" {
        return Err(format!("format \"{format}\" is not 1, the only one known"));
    }
    let scene = value("scene")?;
    let steps = number_in(&value("steps")?)?;
    let dt = word_in(&value("dt")?)?;
    let full_every = number_in(&value("full_every")?)?;
    let counts = match lines.peek() {
        Some(line) if line.starts_with("bodies ") => Some(counts(lines, number)?),
        _ => None,
    };
    Ok(Header { scene, steps, dt, full_every, counts })
}

/// The part of the header that is missing when building threw.
fn counts(lines: &mut Peekable<Lines<'_>>, number: &mut usize) -> Result<Counts, String> {
    let mut count = |key: &str| {
        *number += 1;
        let line = lines.next().unwrap_or_default();
        match line.split_once(' ') {
            Some((word, value)) if word == key => number_in(value),
            _ => Err(format!("\"{line}\" where `{key}` should be")),
        }
    };
    Ok(Counts {
        bodies: count("bodies")?,
        geoms: count("geoms")?,
        joints: count("joints")?,
        springs: count("springs")?,
        controllers: count("controllers")?,
    })
}

/// A line after the header.
fn line(text: &str) -> Result<Line, String> {
    let mut fields = Fields(text.split_ascii_whitespace());
    let line = match fields.text()? {
        "e" => Line::Event { step: fields.number()?, event: event(&mut fields)? },
        "s" => Line::Step(StepLine {
            step: fields.number()?,
            hash: hash_in(fields.text()?)?,
            arbiters: fields.number()?,
            contacts: fields.number()?,
        }),
        "b" => {
            Line::Body(BodyLine { body: fields.number()?, state: fields.words()?, flags: fields.number()? })
        }
        "a" => Line::Arbiter(ArbiterLine {
            geom_a: fields.number()?,
            geom_b: fields.number()?,
            contacts: fields.number()?,
        }),
        "k" => Line::Contact(ContactLine {
            id: [fields.number()?, fields.number()?, fields.number()?],
            values: fields.words()?,
        }),
        "x" => Line::Thrown { step: fields.number()?, exception: fields.text()?.to_owned() },
        "end" => Line::End { steps: fields.number()?, hash: hash_in(fields.text()?)? },
        other => return Err(format!("\"{other}\" is no kind of line")),
    };
    match fields.0.next() {
        Some(field) => Err(format!("\"{field}\" is one field too many")),
        None => Ok(line),
    }
}

/// The fields of an event line after the step.
fn event(fields: &mut Fields<'_>) -> Result<Event, String> {
    Ok(match fields.text()? {
        "c" => {
            Event::Collision { this: fields.number()?, other: fields.number()?, contacts: fields.number()? }
        }
        "s" => Event::Separation { this: fields.number()?, other: fields.number()? },
        "j" => Event::JointBroke { joint: fields.number()? },
        "g" => Event::SpringBroke { spring: fields.number()? },
        "f" => Event::FluidEntry {
            controller: fields.number()?,
            geom: fields.number()?,
            vertices: fields.number()?,
        },
        "h" => Event::BroadPhase { geom_a: fields.number()?, geom_b: fields.number()? },
        "q" => {
            let first = match fields.text()? {
                "-1" => None,
                geom => Some(number_in(geom)?),
            };
            let count: usize = fields.number()?;
            let all = (0..count).map(|_| fields.number()).collect::<Result<_, _>>()?;
            Event::Query { first, all }
        }
        "u" => Event::Interval { values: fields.words()? },
        other => return Err(format!("\"{other}\" is no kind of event")),
    })
}

/// The fields of a line that are still to be read.
struct Fields<'a>(SplitAsciiWhitespace<'a>);

impl<'a> Fields<'a> {
    fn text(&mut self) -> Result<&'a str, String> {
        self.0.next().ok_or_else(|| "has too few fields".to_owned())
    }

    fn number<N: FromStr>(&mut self) -> Result<N, String> {
        number_in(self.text()?)
    }

    fn words<const N: usize>(&mut self) -> Result<[u32; N], String> {
        let mut words = [0; N];
        for word in &mut words {
            *word = word_in(self.text()?)?;
        }
        Ok(words)
    }
}

fn number_in<N: FromStr>(text: &str) -> Result<N, String> {
    text.parse().map_err(|_| format!("\"{text}\" is not a number that can stand here"))
}

fn word_in(text: &str) -> Result<u32, String> {
    hex(text, 8).map(|word| word as u32)
}

fn hash_in(text: &str) -> Result<u64, String> {
    hex(text, 16)
}

fn hex(text: &str, digits: usize) -> Result<u64, String> {
    let number =
        u64::from_str_radix(text, 16).ok().filter(|_| text.len() == digits && !text.starts_with('+'));
    number.ok_or_else(|| format!("\"{text}\" is not a number of {digits} hex digits"))
}
