//! The contacts of one body.

use super::PhysicsSimulator;
use crate::body::BodyId;
use crate::contacts::arbiter::ArbiterRef;
use crate::geom::GeomId;
use crate::math::Vector2;

/// A point at which a body touches another: see [`PhysicsSimulator::contacts_of`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyContact {
    /// The geom of the body.
    pub geom: GeomId,
    /// The geom that it touches.
    pub other: GeomId,
    /// World position, in length units.
    pub point: Vector2,
    /// Unit normal from the other geom to that of the body: up for a body that stands on it.
    pub normal: Vector2,
    /// Distance of the outlines along the normal, in length units; negative when they overlap.
    pub separation: f32,
    /// Impulse along the normal in the last update, or its last substep, in mass units · length units/s, 0 or more.
    pub normal_impulse: f32,
}

impl PhysicsSimulator {
    /// The points at which a body touched others in the last update, ordered by the creation numbers of the other geoms; sensors
    /// are left out. None for a stale id. With the precise set the time depends on the contacts of this body alone.
    ///
    /// ```
    /// use farseer_core::{BodyBuilder, GeomBuilder, PhysicsSimulator};
    /// let mut simulator = PhysicsSimulator::precise([0.0, 300.0])?;
    /// simulator.add_body(BodyBuilder::fixed().position([0.0, 10.0]), [GeomBuilder::rectangle(400.0, 20.0)])?;
    /// let hero = BodyBuilder::dynamic().position([0.0, -16.0]);
    /// let (hero, _) = simulator.add_body(hero, [GeomBuilder::rectangle(32.0, 32.0)])?;
    /// (0..10).for_each(|_| simulator.update(1.0 / 60.0));
    /// let stands = simulator.contacts_of(hero).iter().any(|contact| contact.normal.y < -0.7);
    /// assert!(stands);
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    pub fn contacts_of(&self, body: BodyId) -> Vec<BodyContact> {
        let mut contacts = Vec::new();
        let geoms = self.geoms_of(body);
        let mut add = |arbiter: &ArbiterRef<'_>| {
            let is_a = geoms.contains(&arbiter.geom_a());
            if !(is_a || geoms.contains(&arbiter.geom_b())) {
                return;
            }
            let responds =
                |geom: GeomId| self.geom(geom).is_some_and(|geom| geom.collision_response_enabled());
            let (geom, other, sign) = match is_a {
                true => (arbiter.geom_a(), arbiter.geom_b(), -1.0),
                false => (arbiter.geom_b(), arbiter.geom_a(), 1.0),
            };
            if !(responds(geom) && responds(other)) {
                return;
            }
            contacts.extend(arbiter.contacts().map(|contact| BodyContact {
                geom,
                other,
                point: contact.position,
                normal: contact.normal * sign,
                separation: contact.separation,
                normal_impulse: contact.normal_impulse(),
            }));
        };
        match &self.pipeline.precise {
            Some(precise) => precise.arbiters_of(body).iter().for_each(&mut add),
            None => self.arbiters().for_each(|arbiter| add(&arbiter)),
        }
        let number = |geom: GeomId| self.geom(geom).map_or(0, |geom| geom.id());
        contacts.sort_by_key(|contact| (number(contact.other), number(contact.geom)));
        contacts
    }
}
