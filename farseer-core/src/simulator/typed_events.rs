//! Typed events of touches, sensors and hits: once for each pair.

use super::PhysicsSimulator;
use crate::geom::GeomId;
use crate::precise::contact_events::TouchChange;
use crate::report::Event;
use farseer_precise::narrow_phase::TouchKind;

impl PhysicsSimulator {
    /// Adds the typed events of touches and sensors that begin or end, or that have changed their kind.
    pub(super) fn report_typed_touches(&mut self, changes: &[TouchChange]) {
        let Some(precise) = &mut self.pipeline.precise else { return };
        for change in precise.changed_kinds.drain() {
            self.report.events.extend(end_of(change.before, change.geoms));
            self.report.events.extend(begin_of(change.after, change.geoms));
        }
        let event = |change: &TouchChange| match change.begins {
            true => begin_of(change.kind, change.geoms),
            false => end_of(change.kind, change.geoms),
        };
        self.report.events.extend(changes.iter().filter_map(event));
    }

    /// Adds the events of a sensor that a fast body crossed within the step.
    pub(super) fn report_passage(&mut self, a: GeomId, b: GeomId) {
        let (Some(one), Some(other)) = (self.objects.geom(a), self.objects.geom(b)) else { return };
        let sides = [one, other].map(|geom| (geom.id(), geom.collision_response_enabled()));
        let kind = TouchKind::of(sides, one.wanted_events().0 | other.wanted_events().0);
        self.report.events.extend(begin_of(kind, (a, b)));
        self.report.events.extend(end_of(kind, (a, b)));
    }

    /// Lists the hits of the step.
    pub(super) fn report_hits(&mut self) {
        let threshold = self.hit_speed();
        let PhysicsSimulator { pipeline, report, .. } = self;
        let Some(precise) = &mut pipeline.precise else { return };
        precise.list_hits(threshold, &mut report.hits);
    }
}

/// Returns the event with which a touch of this kind begins. The geom with the smaller creation number is first.
fn begin_of(kind: TouchKind, (first, second): (GeomId, GeomId)) -> Option<Event> {
    match kind {
        TouchKind::Unreported => None,
        TouchKind::Touch => Some(Event::TouchBegin { geom1: first, geom2: second }),
        TouchKind::Sensor { is_first: true } => Some(Event::SensorBegin { sensor: first, visitor: second }),
        TouchKind::Sensor { is_first: false } => Some(Event::SensorBegin { sensor: second, visitor: first }),
    }
}

/// Returns the event with which a touch of this kind ends.
fn end_of(kind: TouchKind, (first, second): (GeomId, GeomId)) -> Option<Event> {
    match kind {
        TouchKind::Unreported => None,
        TouchKind::Touch => Some(Event::TouchEnd { geom1: first, geom2: second }),
        TouchKind::Sensor { is_first: true } => Some(Event::SensorEnd { sensor: first, visitor: second }),
        TouchKind::Sensor { is_first: false } => Some(Event::SensorEnd { sensor: second, visitor: first }),
    }
}
