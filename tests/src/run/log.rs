//! The handler of a run: logs callbacks as the lines of a trace and vetoes collisions.

use crate::scene::Scene;
use crate::trace::{Event, Line};
use farseer_core::{Contact, Context, ControllerId, EventHandler, GeomId, JointId, SpringId, Vertices};
use std::collections::HashMap;

/// Subscriptions of a run, and the events it received.
#[derive(Debug, Clone, Default)]
pub(super) struct Log {
    /// Id in the scene of every geom ever created.
    numbers: HashMap<GeomId, usize>,
    /// Index in the scene of every joint, spring and controller ever created.
    joints: HashMap<JointId, usize>,
    springs: HashMap<SpringId, usize>,
    controllers: HashMap<ControllerId, usize>,
    /// For each geom, the geoms for which its collision callback returns false.
    vetoes: Vec<Vec<usize>>,
    /// Whether the broad phase event is subscribed.
    broad_phase_event: bool,
    /// Number of the last step whose events are logged; 0 for none.
    until: u32,
    /// The current step.
    pub(super) step: u32,
    /// Logged events that are not yet fetched.
    pub(super) lines: Vec<Line>,
}

impl Log {
    /// The handler with the scene's subscriptions, before any object is created.
    pub(super) fn of(scene: &Scene) -> Self {
        Log {
            broad_phase_event: scene.simulator.broad_phase_event,
            until: if scene.trace.events { scene.trace.events_until.unwrap_or(u32::MAX) } else { 0 },
            ..Log::default()
        }
    }

    /// Makes a new geom known.
    pub(super) fn subscribe(&mut self, geom: GeomId, veto: &[usize]) {
        self.numbers.insert(geom, self.vetoes.len());
        self.vetoes.push(veto.to_vec());
    }

    /// Makes a new joint known.
    pub(super) fn know_joint(&mut self, joint: JointId) {
        self.joints.insert(joint, self.joints.len());
    }

    /// Makes a new spring known.
    pub(super) fn know_spring(&mut self, spring: SpringId) {
        self.springs.insert(spring, self.springs.len());
    }

    /// Makes a new controller known.
    pub(super) fn know_controller(&mut self, controller: ControllerId) {
        self.controllers.insert(controller, self.controllers.len());
    }

    /// Id in the scene of a geom.
    pub(super) fn number(&self, geom: GeomId) -> usize {
        self.numbers.get(&geom).copied().expect("every geom of the simulation is created through the run")
    }

    /// Logs an event of the current step.
    pub(super) fn event(&mut self, event: Event) {
        if self.step <= self.until {
            self.lines.push(Line::Event { step: self.step, event });
        }
    }
}

impl EventHandler for Log {
    fn on_collision(
        &mut self,
        _: &mut Context<'_>,
        this: GeomId,
        other: GeomId,
        contacts: &mut Vec<Contact>,
    ) -> bool {
        let (this, other) = (self.number(this), self.number(other));
        self.event(Event::Collision { this, other, contacts: contacts.len() });
        !self.vetoes[this].contains(&other)
    }

    fn on_separation(&mut self, _: &mut Context<'_>, this: GeomId, other: GeomId) {
        self.event(Event::Separation { this: self.number(this), other: self.number(other) });
    }

    fn handles_broad_phase(&self) -> bool {
        self.broad_phase_event
    }

    fn on_broad_phase_collision(&mut self, _: &mut Context<'_>, a: GeomId, b: GeomId) -> bool {
        self.event(Event::BroadPhase { geom_a: self.number(a), geom_b: self.number(b) });
        true
    }

    fn on_joint_broke(&mut self, _: &mut Context<'_>, joint: JointId) {
        self.event(Event::JointBroke { joint: self.joints[&joint] });
    }

    fn on_spring_broke(&mut self, _: &mut Context<'_>, spring: SpringId) {
        self.event(Event::SpringBroke { spring: self.springs[&spring] });
    }

    fn on_fluid_entry(
        &mut self,
        _: &mut Context<'_>,
        controller: ControllerId,
        geom: GeomId,
        vertices: &Vertices,
    ) {
        let (controller, geom) = (self.controllers[&controller], self.number(geom));
        self.event(Event::FluidEntry { controller, geom, vertices: vertices.len() });
    }
}
