//! A log of the events of several updates.

use crate::report::Event;
use crate::simulator::PhysicsSimulator;

/// The events of all updates since the game read them last. A simulator keeps only the events of its last update: a
/// frame with two updates would miss those of the first, and one without any would see them twice. Not in the original.
///
/// ```
/// use farseer_core::{BodyFactory, Event, EventLog, FixedStepClock, PhysicsSimulator};
///
/// let mut simulator = PhysicsSimulator::default();
/// let mut log = EventLog::new();
/// let body = BodyFactory::create_circle_body_in(&mut simulator, 10.0, 1.0)?;
/// for _ in 0..3 {
///     simulator.update(0.01);
///     log.take(&simulator);
/// }
/// let added = log.drain().filter(|event| *event == Event::Added { object: body.into() });
/// assert_eq!(added.count(), 1, "in the first of three updates");
/// assert_eq!(log.drain().count(), 0);
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct EventLog {
    events: Vec<Event>,
}

impl EventLog {
    /// An empty log.
    pub fn new() -> Self {
        Self::default()
    }

    /// Appends the events of the last update; to be called once after each update.
    pub fn take(&mut self, simulator: &PhysicsSimulator) {
        self.events.extend_from_slice(simulator.events());
    }

    /// Returns the events since the last call, in order, and removes them. Events that the caller does not read are
    /// lost.
    pub fn drain(&mut self) -> impl Iterator<Item = Event> + '_ {
        self.events.drain(..)
    }

    /// The events since [`drain`](Self::drain) was called last.
    pub fn events(&self) -> &[Event] {
        &self.events
    }
}
