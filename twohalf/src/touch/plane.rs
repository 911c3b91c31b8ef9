//! Contacts in X and Y whose partners slide past each other along Z: found by the 2D engine, solved here, because
//! friction acts along Z as well.

use farseer_core::{Contact, PhysicsSimulator};

use super::list::Subject;
use super::{Kept, Touch, TouchKey, TouchPoint};
use crate::world::World;
use crate::{Partner, Vector3};

/// Names a contact of the 2D engine from one update to the next.
fn feature_of(contact: &Contact, older: u32) -> u32 {
    (contact.id.vertex as u32).wrapping_mul(2) + u32::from(contact.id.geom1 == older)
}

impl World {
    /// Takes over the 2D engine's contacts that rub along Z, or did in the last update.
    pub(crate) fn take_over_plane_contacts(&mut self, core: &mut PhysicsSimulator) {
        for position in 0..core.arbiter_count() {
            if let Some(subject) = self.sliding_pair(core, position) {
                self.take_over(core, position, subject);
            }
        }
        self.touches.sort();
    }

    fn sliding_pair(&self, core: &PhysicsSimulator, position: usize) -> Option<Subject> {
        let arbiter = core.arbiter(position)?;
        let (a, b) = (core.geom(arbiter.geom_a())?, core.geom(arbiter.geom_b())?);
        let velocity = |body| self.depths.bodies.get(body).map_or(0.0, |state| state.velocity_z);
        let key = TouchKey::Pair(a.id(), b.id());
        let slides = velocity(a.body()) != velocity(b.body());
        let rubbed = || {
            let last = self.last.find(key).filter(|touch| touch.is_plane());
            last.is_some_and(|touch| {
                self.last.points_of(touch).iter().any(|point| point.friction_impulse[1] != 0.0)
            })
        };
        if !(a.collision_response_enabled() && b.collision_response_enabled()) || !(slides || rubbed()) {
            return None;
        }
        Some(Subject {
            key,
            this: arbiter.geom_b(),
            body: b.body(),
            partner: Partner::Geom(arbiter.geom_a()),
            partner_body: Some(a.body()),
            responds: true,
        })
    }

    fn take_over(&mut self, core: &mut PhysicsSimulator, position: usize, subject: Subject) {
        let Subject { key, this, body, partner, partner_body, responds } = subject;
        let (TouchKey::Pair(older, _), Partner::Geom(other)) = (key, partner) else { return };
        let Some(arbiter) = core.arbiter(position) else { return };
        let Some(restitution) = core.geom(this).zip(core.geom(other)).map(|(b, a)| {
            PhysicsSimulator::mix_restitution(a.restitution_coefficient(), b.restitution_coefficient())
        }) else {
            return;
        };
        let friction = arbiter.friction();
        if !friction.is_finite() || !restitution.is_finite() {
            return;
        }
        let z = self.middle(core, this, other);
        let last = self.last.find(key).filter(|touch| touch.is_plane());
        let known = last.map_or(&[][..], |touch| self.last.points_of(touch));
        let first_point = self.touches.points.len() as u32;
        for contact in arbiter.contacts() {
            let feature = feature_of(&contact, older);
            let before = known.iter().find(|point| point.feature == feature);
            self.touches.points.push(TouchPoint {
                position: Vector3::new(contact.position.x, contact.position.y, z),
                normal: Vector3::new(contact.normal.x, contact.normal.y, 0.0),
                separation: contact.separation,
                feature,
                normal_impulse: contact.normal_impulse(),
                friction_impulse: [
                    contact.tangent_impulse(),
                    before.map_or(0.0, |point| point.friction_impulse[1]),
                ],
            });
        }
        let Some(first) = arbiter.contacts().next() else { return };
        self.touches.touches.push(Touch {
            key,
            this,
            body,
            partner,
            partner_body,
            normal: Vector3::new(first.normal.x, first.normal.y, 0.0),
            kept: Kept::Plane,
            first_point,
            point_count: arbiter.contacts().len() as u32,
            friction,
            restitution,
            responds,
            shares_pressure: false,
            arbiter: position as u32,
        });
        core.leave_to_engine(position);
    }
}
