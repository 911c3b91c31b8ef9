//! Contacts of the last update, as games see them.

use std::borrow::Cow;

use farseer_core::math::scalar::nearest_finite;
use farseer_core::{BodyId, GeomId, PhysicsSimulator};

use super::contact_query::{list_contacts, list_contacts_of};
use crate::Vector3;
use crate::depth::{Axis, ContactKey, ContactList, ContactPoint, ContactTarget, DepthScheme, World};
use crate::projection::to_world;

/// A contact point of the last update.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias = "Contact")]
pub struct TwoHalfContact {
    /// The geom that the contact is listed for; of two geoms the younger one.
    pub this: GeomId,
    /// The contact target: the older geom, a platform or the ground.
    pub partner: ContactTarget,
    /// Axes along which the contact acts.
    pub axis: Axis,
    /// Position in the world, px, Y up.
    pub position: Vector3,
    /// Unit normal in the world, Y up, from the target to `this`.
    pub normal: Vector3,
    /// Separation along the normal, px; negative is penetration.
    pub separation: f32,
    /// Normal impulse, mass · px/s, 0 or more.
    pub normal_impulse: f32,
    /// Magnitude of the friction impulse, mass · px/s, 0 or more.
    pub friction_impulse: f32,
}

/// Iterates over the contact points of one body. Where contacts are not queried by body, points of other bodies come, too.
pub(super) fn contacts_of<'a>(
    core: &'a PhysicsSimulator,
    world: &'a World,
    body: BodyId,
) -> Box<dyn Iterator<Item = TwoHalfContact> + 'a> {
    if world.scheme == DepthScheme::Precise {
        return Box::new(points_of(&list_contacts_of(core, world, body)).into_iter());
    }
    Box::new(contacts(core, world))
}

/// All contact points of the last update: those of pairs in X and Y, then all others.
pub(crate) fn contacts<'a>(
    core: &'a PhysicsSimulator,
    world: &'a World,
) -> impl Iterator<Item = TwoHalfContact> + 'a {
    let in_plane = core.arbiters().flat_map(move |arbiter| {
        let (a, b) = (arbiter.geom_a(), arbiter.geom_b());
        let z = world.depths.middle(core, a, b);
        let across = friction_along_z(core, &world.touches, a, b);
        arbiter.contacts().zip(0..).map(move |(contact, index)| TwoHalfContact {
            this: b,
            partner: ContactTarget::Geom(a),
            axis: Axis::Plane,
            position: Vector3::new(contact.position.x, -contact.position.y, z),
            normal: Vector3::new(contact.normal.x, -contact.normal.y, 0.0),
            separation: contact.separation,
            normal_impulse: contact.normal_impulse(),
            friction_impulse: length([
                contact.tangent_impulse(),
                across.get(index).map_or(0.0, |point| point.friction_impulse[1]),
            ]),
        })
    });
    let list = match world.scheme {
        DepthScheme::Precise => list_contacts(core, world),
        DepthScheme::Faithful | DepthScheme::Thesis => Cow::Borrowed(&world.touches),
    };
    in_plane.chain(points_of(&list))
}

/// Returns the points, as `twohalf` has solved them, of a contact that the core found between two geoms.
fn friction_along_z<'a>(
    core: &PhysicsSimulator,
    list: &'a ContactList,
    a: GeomId,
    b: GeomId,
) -> &'a [ContactPoint] {
    let numbers = core.geom(a).zip(core.geom(b)).map(|(a, b)| ContactKey::Pair(a.id(), b.id()));
    numbers.and_then(|key| list.find(key)).map_or(&[], |touch| list.points_of(touch))
}

fn points_of(list: &ContactList) -> Vec<TwoHalfContact> {
    let others = list.touches.iter().filter(|touch| !touch.is_plane()).flat_map(|touch| {
        list.points_of(touch).iter().map(|point| TwoHalfContact {
            this: touch.this,
            partner: touch.partner,
            axis: touch.axis(),
            position: to_world(point.position),
            normal: to_world(touch.normal),
            separation: point.separation,
            normal_impulse: point.normal_impulse,
            friction_impulse: length(point.friction_impulse),
        })
    });
    others.collect()
}

fn length([x, y]: [f32; 2]) -> f32 {
    if y == 0.0 {
        return x.abs();
    }
    let length = (x * x + y * y).sqrt();
    if length.is_finite() {
        return length;
    }
    // The squares may overflow although the length does not.
    let [x, y] = [x, y].map(f64::from);
    nearest_finite((x * x + y * y).sqrt() as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_length_of_great_impulses_is_finite() {
        assert_eq!(length([3e20, 4e20]), 5e20);
        assert_eq!(length([f32::MAX, f32::MAX]), f32::MAX);
        assert_eq!(length([3.0, 4.0]), 5.0);
    }
}
