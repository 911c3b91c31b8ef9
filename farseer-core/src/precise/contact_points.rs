//! Adapter: contacts of the solver as the API shows them.

use crate::contacts::contact::{Contact, ContactId};
use crate::math::Vector2;
use farseer_precise::narrow_phase::contact_reader::PlanarContact;

/// Returns the contacts of two geoms; the first `count` entries are valid. `creation_numbers`: those of the geoms of proxies A
/// and B. The normal of the result points from the geom with the smaller number to the other one.
pub(super) fn contacts_of(contact: &PlanarContact, [a, b]: [u32; 2]) -> [Contact; 2] {
    let is_flipped = a > b;
    let (geom1, geom2) = if is_flipped { (b, a) } else { (a, b) };
    let sign = if is_flipped { -1.0 } else { 1.0 };
    let normal = Vector2::new(sign * contact.normal[0], sign * contact.normal[1]);
    let mut contacts = [Contact::default(); 2];
    for (contact, point) in contacts.iter_mut().zip(&contact.points[..contact.count]) {
        let id = ContactId { geom1, vertex: point.feature as i32, geom2 };
        *contact = Contact::of_point(point, normal, id);
    }
    contacts
}
