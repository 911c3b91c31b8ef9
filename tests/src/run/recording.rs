//! Complete runs as traces.

use super::Run;
use crate::scene::{Scene, SceneError};
use crate::trace::hash::{Fnv, step_line};
use crate::trace::{ArbiterLine, BodyLine, ContactLine, Header, Line, StepLine, Trace, word};
use farseer_core::{Body, BodyId, Event, PhysicsSimulator};
use std::collections::HashMap;

/// Record of a run.
#[derive(Debug)]
pub struct Recording {
    /// The trace, up to the end or the error.
    pub trace: Trace,
    /// The refusal, and the number of the update before which it occurred; 0 for the build.
    pub error: Option<(u32, SceneError)>,
    /// Number of the first step after which a body that still exists had a state that is not finite, and the body.
    pub not_finite: Option<(u32, usize)>,
    /// Number of the first step whose update reported that a body had stopped being finite, or would have.
    pub reported: Option<u32>,
}

/// Builds a scene and makes all its steps.
pub fn record(scene: &Scene) -> Recording {
    let header = Header {
        scene: scene.name.clone(),
        steps: scene.steps,
        dt: word(scene.dt),
        full_every: scene.trace.full_every,
        counts: None,
    };
    let mut recording = Recording {
        trace: Trace { header, lines: Vec::new() },
        error: None,
        not_finite: None,
        reported: None,
    };
    let mut hash = Fnv::EMPTY;
    let mut steps = 0;
    match Run::build(scene) {
        Ok(mut run) => {
            recording.trace.header.counts = Some(run.counts());
            recording.state(&run, 0);
            while steps < scene.steps {
                if let Err(error) = run.step() {
                    recording.trace.lines.extend(run.take_events());
                    recording.error = Some((steps + 1, error));
                    break;
                }
                steps += 1;
                hash.bytes(&recording.step(&mut run, steps).to_le_bytes());
            }
        }
        Err(error) => recording.error = Some((0, error)),
    }
    recording.trace.lines.push(Line::End { steps, hash: hash.finish() });
    recording
}

impl Recording {
    /// Records a step that was made; returns its hash.
    fn step(&mut self, run: &mut Run<'_>, step: u32) -> u64 {
        self.trace.lines.extend(run.take_events());
        if self.reported.is_none() && run.simulator.events().iter().any(is_about_what_is_not_finite) {
            self.reported = Some(step);
        }
        self.look_for_not_finite(run, step);
        self.state(run, step)
    }

    /// Records the line of a step, and the full state if it is due; returns the step's hash.
    fn state(&mut self, run: &Run<'_>, step: u32) -> u64 {
        let scene = run.scene;
        let simulator = &run.simulator;
        let line = line(simulator, step);
        let full = step.is_multiple_of(scene.trace.full_every) || step == scene.steps;
        if full || step.is_multiple_of(scene.trace.step_every) {
            self.trace.lines.push(Line::Step(line));
        }
        if full {
            self.trace.lines.extend(body_lines(run));
            if scene.trace.contacts && step != 0 {
                self.trace.lines.extend(contact_lines(run));
            }
        }
        line.hash
    }

    fn look_for_not_finite(&mut self, run: &Run<'_>, step: u32) {
        if self.not_finite.is_some() {
            return;
        }
        let finite = |id: &BodyId| match run.simulator.body(*id) {
            Some(body) => state(body).into_iter().all(|word| f32::from_bits(word).is_finite()),
            None => true,
        };
        self.not_finite = run.bodies.iter().position(|id| !finite(id)).map(|body| (step, body));
    }
}

fn is_about_what_is_not_finite(event: &Event) -> bool {
    matches!(
        event,
        Event::NotFinite { .. }
            | Event::JointNotFinite { .. }
            | Event::SpringNotFinite { .. }
            | Event::ControllerNotFinite { .. }
    )
}

/// The seven words of a body's state.
fn state(body: &Body) -> [u32; 7] {
    let (position, velocity) = (body.position(), body.linear_velocity());
    [
        word(position.x),
        word(position.y),
        word(body.rotation()),
        word(body.total_rotation()),
        word(velocity.x),
        word(velocity.y),
        word(body.angular_velocity()),
    ]
}

fn line(simulator: &PhysicsSimulator, step: u32) -> StepLine {
    let (arbiters, contacts) = match step {
        0 => (0, 0),
        _ => simulator.arbiters().fold((0, 0), |(arbiters, contacts), arbiter| {
            (arbiters + 1, contacts + arbiter.contacts().len() as u32)
        }),
    };
    step_line(step, simulator.body_list().iter().map(|&id| state(&simulator[id])), arbiters, contacts)
}

/// One line per body in the simulator's list.
fn body_lines(run: &Run<'_>) -> Vec<Line> {
    let numbers: HashMap<BodyId, usize> =
        run.bodies.iter().enumerate().map(|(index, &id)| (id, index)).collect();
    let lines = run.simulator.body_list().iter().map(|id| {
        let body = &run.simulator[*id];
        let flags = u32::from(body.enabled()) + 2 * u32::from(body.is_static());
        Line::Body(BodyLine { body: numbers[id], state: state(body), flags })
    });
    lines.collect()
}

/// The pairs that touch, each with its contacts.
fn contact_lines(run: &Run<'_>) -> Vec<Line> {
    let mut lines = Vec::new();
    for arbiter in run.simulator.arbiters() {
        lines.push(Line::Arbiter(ArbiterLine {
            geom_a: run.log.number(arbiter.geom_a()),
            geom_b: run.log.number(arbiter.geom_b()),
            contacts: arbiter.contacts().len(),
        }));
        lines.extend(arbiter.contacts().map(|contact| {
            let id = [contact.id.geom1 as i32, contact.id.vertex, contact.id.geom2 as i32];
            let values = [
                contact.position.x,
                contact.position.y,
                contact.normal.x,
                contact.normal.y,
                contact.separation,
            ];
            Line::Contact(ContactLine { id, values: values.map(word) })
        }));
    }
    lines
}
