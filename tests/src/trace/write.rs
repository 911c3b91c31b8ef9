//! Traces to text.

use super::{ArbiterLine, BodyLine, ContactLine, Event, Header, Line, StepLine, Trace};
use std::fmt::{self, Display, Formatter};

impl Display for Trace {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.header.fmt(f)?;
        self.lines.iter().try_for_each(|line| writeln!(f, "{line}"))
    }
}

impl Display for Header {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "farseer-trace 1")?;
        writeln!(f, "scene {}", self.scene)?;
        writeln!(f, "steps {}", self.steps)?;
        writeln!(f, "dt {:08x}", self.dt)?;
        writeln!(f, "full_every {}", self.full_every)?;
        if let Some(counts) = &self.counts {
            writeln!(f, "bodies {}", counts.bodies)?;
            writeln!(f, "geoms {}", counts.geoms)?;
            writeln!(f, "joints {}", counts.joints)?;
            writeln!(f, "springs {}", counts.springs)?;
            writeln!(f, "controllers {}", counts.controllers)?;
        }
        Ok(())
    }
}

impl Display for Line {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Line::Event { step, event } => write!(f, "e {step} {event}"),
            Line::Step(line) => line.fmt(f),
            Line::Body(line) => line.fmt(f),
            Line::Arbiter(line) => line.fmt(f),
            Line::Contact(line) => line.fmt(f),
            Line::Thrown { step, exception } => write!(f, "x {step} {exception}"),
            Line::End { steps, hash } => write!(f, "end {steps} {hash:016x}"),
        }
    }
}

impl Display for StepLine {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "s {} {:016x} {} {}", self.step, self.hash, self.arbiters, self.contacts)
    }
}

impl Display for BodyLine {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "b {}", self.body)?;
        words(f, &self.state)?;
        write!(f, " {}", self.flags)
    }
}

impl Display for ArbiterLine {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "a {} {} {}", self.geom_a, self.geom_b, self.contacts)
    }
}

impl Display for ContactLine {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let [geom_1, vertex, geom_2] = self.id;
        write!(f, "k {geom_1} {vertex} {geom_2}")?;
        words(f, &self.values)
    }
}

impl Display for Event {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Event::Collision { this, other, contacts } => write!(f, "c {this} {other} {contacts}"),
            Event::Separation { this, other } => write!(f, "s {this} {other}"),
            Event::JointBroke { joint } => write!(f, "j {joint}"),
            Event::SpringBroke { spring } => write!(f, "g {spring}"),
            Event::FluidEntry { controller, geom, vertices } => write!(f, "f {controller} {geom} {vertices}"),
            Event::BroadPhase { geom_a, geom_b } => write!(f, "h {geom_a} {geom_b}"),
            Event::Query { first, all } => {
                match first {
                    Some(geom) => write!(f, "q {geom} {}", all.len())?,
                    None => write!(f, "q -1 {}", all.len())?,
                }
                all.iter().try_for_each(|geom| write!(f, " {geom}"))
            }
            Event::Interval { values } => {
                write!(f, "u")?;
                words(f, values)
            }
        }
    }
}

/// Bit patterns, each after a blank.
fn words(f: &mut Formatter<'_>, words: &[u32]) -> fmt::Result {
    words.iter().try_for_each(|word| write!(f, " {word:08x}"))
}
