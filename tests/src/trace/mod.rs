//! Traces: records of runs, as text that can be compared byte for byte.
//!
//! A trace has a header and lines of one word and fields, separated by one blank; floats are their 32-bit patterns in eight hex
//! digits, every NaN being `7fc00000`. See [`Line`] for the kinds of line and [`hash`] for the hashes.

pub mod hash;
mod read;
mod write;

pub use read::TraceError;

use crate::file;
use std::path::Path;

/// A complete trace.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Trace {
    /// Name and settings of the run.
    pub header: Header,
    /// The lines, in order.
    pub lines: Vec<Line>,
}

/// Name and settings of a run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Header {
    /// Name of the scene.
    pub scene: String,
    /// Number of updates of the run.
    pub steps: u32,
    /// Time step, as a bit pattern.
    pub dt: u32,
    /// Every how many steps the full state is written.
    pub full_every: u32,
    /// Numbers of the built objects; `None` when building failed.
    pub counts: Option<Counts>,
}

/// How much was built before the first step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Number of bodies.
    pub bodies: usize,
    /// Number of geoms, pieces of decompositions counted one by one.
    pub geoms: usize,
    /// Number of joints.
    pub joints: usize,
    /// Number of springs.
    pub springs: usize,
    /// Number of controllers.
    pub controllers: usize,
}

/// A line of a trace after the header.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Line {
    /// `e`: a callback or the result of a query. Events come before the line of their step.
    Event {
        /// The step it happened in.
        step: u32,
        /// The event.
        event: Event,
    },
    /// `s`: the end of a step.
    Step(StepLine),
    /// `b`: the state of a body, part of a full state.
    Body(BodyLine),
    /// `a`: a pair that touches, part of a full state.
    Arbiter(ArbiterLine),
    /// `k`: a contact of the pair above it.
    Contact(ContactLine),
    /// `x`: the original threw.
    Thrown {
        /// The step, 0 while building.
        step: u32,
        /// Full name of the exception's type.
        exception: String,
    },
    /// `end`: the last line.
    End {
        /// Number of completed steps.
        steps: u32,
        /// Hash of the hashes of all steps from the first on.
        hash: u64,
    },
}

/// The end of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StepLine {
    /// Number of the step, 0 for the state before the first.
    pub step: u32,
    /// Hash of the states of all bodies and the two counts.
    pub hash: u64,
    /// Number of arbiters.
    pub arbiters: u32,
    /// Number of contacts of all arbiters.
    pub contacts: u32,
}

/// The state of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BodyLine {
    /// Index of the body.
    pub body: usize,
    /// Position x and y, rotation, total rotation, velocity x and y, angular velocity, as bit patterns.
    pub state: [u32; 7],
    /// Flags: 1 for an enabled and 2 for a static body, added up.
    pub flags: u32,
}

impl BodyLine {
    /// Names of the words of the state.
    pub const FIELDS: [&'static str; 7] = [
        "position x",
        "position y",
        "rotation",
        "total rotation",
        "velocity x",
        "velocity y",
        "angular velocity",
    ];
}

/// A pair of geoms that touches.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ArbiterLine {
    /// Id of the first geom.
    pub geom_a: usize,
    /// Id of the second geom.
    pub geom_b: usize,
    /// Number of contacts.
    pub contacts: usize,
}

/// A contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ContactLine {
    /// The contact's id: id of the geom whose vertex it is, index of the vertex, id of the other geom.
    pub id: [i32; 3],
    /// Position x and y, normal x and y, separation, as bit patterns.
    pub values: [u32; 5],
}

impl ContactLine {
    /// Names of the values.
    pub const FIELDS: [&'static str; 5] = ["position x", "position y", "normal x", "normal y", "separation"];
}

/// A callback or the result of a query.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Event {
    /// `c`: the collision callback of a geom.
    Collision {
        /// Id of the geom that receives the callback.
        this: usize,
        /// Id of the geom that it touches.
        other: usize,
        /// Number of contacts handed over.
        contacts: usize,
    },
    /// `s`: the separation callback of a geom.
    Separation {
        /// Id of the geom that receives the callback.
        this: usize,
        /// Id of the geom that it touched.
        other: usize,
    },
    /// `j`: a joint broke.
    JointBroke {
        /// Index of the joint.
        joint: usize,
    },
    /// `g`: a spring broke.
    SpringBroke {
        /// Index of the spring.
        spring: usize,
    },
    /// `f`: a geom entered a fluid.
    FluidEntry {
        /// Index of the fluid's controller.
        controller: usize,
        /// Id of the geom.
        geom: usize,
        /// Number of submerged vertices.
        vertices: usize,
    },
    /// `h`: the broad phase's event.
    BroadPhase {
        /// Id of the first geom.
        geom_a: usize,
        /// Second geom.
        geom_b: usize,
    },
    /// `q`: the result of a query.
    Query {
        /// Id of the single geom that was found.
        first: Option<usize>,
        /// All geoms found.
        all: Vec<usize>,
    },
    /// `u`: the time step a scaling controller gave, its current and its longest time step, as bit patterns.
    Interval {
        /// The three values as bit patterns.
        values: [u32; 3],
    },
}

impl Trace {
    /// Reads a trace from a file, plain or compressed by gzip (`.gz`).
    ///
    /// # Errors
    ///
    /// When the file cannot be read or is not a trace.
    pub fn from_file(path: impl AsRef<Path>) -> Result<Self, TraceError> {
        file::read_text(path.as_ref())?.parse()
    }

    /// The last line's numbers: completed steps and cumulative hash.
    pub fn end(&self) -> Option<(u32, u64)> {
        match self.lines.last() {
            Some(&Line::End { steps, hash }) => Some((steps, hash)),
            _ => None,
        }
    }
}

/// The bit pattern of a float as a trace has it: signed zeros are kept, every NaN is the same.
pub fn word(value: f32) -> u32 {
    if value.is_nan() { 0x7fc0_0000 } else { value.to_bits() }
}
