//! Queries of contacts, and contacts that an engine on top solves.

use super::PhysicsSimulator;
use crate::contacts::arbiter::{ArbiterRef, ContactSource};
use crate::geom::GeomId;
use farseer_precise::surface::{mix_friction, mix_restitution};

/// Contacts.
impl PhysicsSimulator {
    /// The touching pairs whose boxes overlapped in the last update, in the order in which they are solved. With the
    /// precise set the order is unspecified, and each pair of convex pieces has an arbiter of its own.
    #[doc(alias = "ArbiterList")]
    pub fn arbiters(&self) -> impl Iterator<Item = ArbiterRef<'_>> {
        let count =
            self.pipeline.precise.as_ref().map_or(self.contacts.len(), |precise| precise.pair_count());
        (0..count).filter_map(|at| match &self.pipeline.precise {
            Some(precise) => precise.arbiter_of_pair(at),
            None => self.listed_arbiter(at),
        })
    }

    fn listed_arbiter(&self, position: usize) -> Option<ArbiterRef<'_>> {
        let handle = *self.contacts.list.get(position)?;
        let arbiter = self.contacts.at(position);
        let contacts = ContactSource::Stored(&arbiter.contacts);
        Some(ArbiterRef { handle, geoms: arbiter.geoms?, friction: arbiter.friction, contacts })
    }

    /// The arbiter at a position of the list, from 0; `None` beyond its end.
    pub fn arbiter(&self, position: usize) -> Option<ArbiterRef<'_>> {
        if self.pipeline.precise.is_some() {
            return self.arbiters().nth(position);
        }
        self.listed_arbiter(position)
    }

    /// Number of [`arbiters`](Self::arbiters).
    pub fn arbiter_count(&self) -> usize {
        self.pipeline.precise.as_ref().map_or(self.contacts.len(), |precise| precise.touching_count())
    }

    /// Number of contacts of all arbiters.
    pub fn contact_count(&self) -> usize {
        self.arbiters().map(|arbiter| arbiter.contacts().len()).sum()
    }

    /// The geoms that a geom touched in the last update, in the order in which the pairs are solved. For a sensor these
    /// are the geoms inside of it: sensors have contacts like other geoms, without impulses.
    ///
    /// None for a stale id. Pairs that may not collide and collisions that a handler refused do not count: they have no
    /// contacts. Two static bodies may not collide, unless, with the precise set, one of the geoms is a
    /// [sensor](crate::Objects::set_is_sensor) or has no collision response.
    pub fn overlaps(&self, geom: GeomId) -> Vec<GeomId> {
        let mut partners = Vec::new();
        for arbiter in self.arbiters().filter(|arbiter| arbiter.contacts().len() > 0) {
            let partner = match (arbiter.geom_a(), arbiter.geom_b()) {
                (a, b) if a == geom => b,
                (a, b) if b == geom => a,
                _ => continue,
            };
            // The list may contain a pair twice.
            if !partners.contains(&partner) {
                partners.push(partner);
            }
        }
        partners
    }
}

/// Contacts that an engine on top solves.
impl PhysicsSimulator {
    /// Excludes the arbiter at this position of the list from the core's solver in this update. To be called between
    /// [`collide_pairs`](Self::collide_pairs) and [`pre_step`](Self::pre_step). The arbiter stays in the list with its
    /// contacts and their impulses, and is not counted in [`contacts_solved`](crate::StepCounters::contacts_solved). A
    /// position beyond the end of the list has no effect.
    pub fn leave_to_engine(&mut self, position: usize) {
        self.contacts.leave_to_engine(position);
    }

    /// Sets the accumulated impulses, in mass units · length units/s, of a contact of the arbiter at a position of the
    /// list, as an engine computed them for an arbiter that was [left](Self::leave_to_engine) to it. The contact has
    /// them again in the next update, if it still exists. Impulses of other arbiters are overwritten by
    /// [`integrate`](Self::integrate).
    ///
    /// No effect if there is no such contact or an impulse is not finite.
    pub fn set_arbiter_impulses(
        &mut self,
        position: usize,
        contact_index: usize,
        normal_impulse: f32,
        tangent_impulse: f32,
    ) {
        let arbiter = self.contacts.get_mut(position);
        let Some(contact) = arbiter.and_then(|arbiter| arbiter.contacts.get_mut(contact_index)) else {
            return;
        };
        if normal_impulse.is_finite() && tangent_impulse.is_finite() {
            (contact.normal_impulse, contact.tangent_impulse) = (normal_impulse, tangent_impulse);
        }
    }

    /// Combines two restitution coefficients: their mean.
    pub fn mix_restitution(a: f32, b: f32) -> f32 {
        mix_restitution(a, b)
    }

    /// Combines two friction coefficients by the [`friction_type`](Self::friction_type).
    pub fn mix_friction(&self, a: f32, b: f32) -> f32 {
        mix_friction(self.settings.friction_type, a, b)
    }
}
