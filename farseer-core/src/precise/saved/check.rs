//! Whether what was loaded can be used.

use super::{Known, Saved, SavedContacts, SavedPair, SavedProxy, SavedRow, Sleeper};
use crate::methods::Methods;
use crate::precise::Precise;
use crate::precise::rows::COLOURS;
use crate::precise::tuning::Tuning;

impl Precise {
    /// Whether what was loaded can be used, and is of these methods.
    pub(crate) fn is_valid(&self, methods: Methods) -> bool {
        matches!(methods, Methods::Precise { length_unit } if length_unit == self.tuning.unit)
            && self
                .loaded
                .as_ref()
                .is_none_or(|saved| saved.is_valid() && saved.is_in_space == self.space.is_some())
    }
}

impl Saved {
    /// Whether everything is finite and names what is there: false only after loading garbage.
    fn is_valid(&self) -> bool {
        let Tuning { unit, .. } = self.tuning;
        unit.is_finite()
            && unit > 0.0
            && self.tuning == Tuning::new(unit)
            && finite(&[self.h, self.dt])
            && self.proxies.iter().all(SavedProxy::is_valid)
            && self.pairs.iter().all(|pair| pair.is_valid(self.proxies.len()))
            && finite(&self.gravity)
            && self.ways.iter().all(|(_, way)| finite(way))
            && self.rest.iter().all(|&(_, rest)| rest.is_finite())
            && self.wear.iter().all(|(_, wear)| wear.effort.is_finite() && wear.budget.is_finite())
            && self.sleepers.iter().all(|sleeper| sleeper.is_valid(self.sleepers.len()))
    }
}

impl SavedProxy {
    fn is_valid(&self) -> bool {
        let SavedProxy { bounds, depths, known: Known { place, contacts, one_way, .. }, .. } = self;
        finite(&[depths.low, depths.high])
            && finite(bounds)
            && finite(place)
            && finite(contacts)
            && finite(&one_way.unwrap_or_default())
    }
}

impl SavedPair {
    /// Of so many proxies.
    fn is_valid(&self, proxies: usize) -> bool {
        let SavedContacts { turns, relative, normal, count, anchors, separations, lead, space, .. } =
            &self.frozen;
        self.proxies.iter().all(|&proxy| (proxy as usize) < proxies)
            && *count <= 2
            && finite(turns)
            && finite(relative)
            && finite(normal)
            && finite(&[space.normal_z, space.apart, space.spread])
            && finite(&space.depths)
            && finite(separations)
            && lead.abs() <= 1.0
            && anchors.iter().all(|anchor| finite(anchor))
            && self.row.as_ref().is_none_or(|row| *count > 0 && row.is_valid())
    }
}

impl SavedRow {
    fn is_valid(&self) -> bool {
        let SavedRow { tangent_impulse, space, impulses, held, separations, asleep, direct, kept, .. } = self;
        (self.colour as usize) < COLOURS
            && finite(&[*tangent_impulse, asleep.unwrap_or(0.0)])
            && direct.is_none_or(|(h, exact)| h.is_finite() && exact.iter().all(|x| x.is_finite()))
            && finite(&kept.unwrap_or_default())
            && finite(space)
            && [impulses, held, separations].into_iter().all(|numbers| finite(numbers))
    }
}

impl Sleeper {
    /// Of so many.
    fn is_valid(&self, sleepers: usize) -> bool {
        let is_there = (self.first as usize) < sleepers;
        is_there && finite(&self.place) && finite(&self.borne) && finite(&self.nature)
    }
}

fn finite(numbers: &[f32]) -> bool {
    numbers.iter().all(|number| number.is_finite())
}
