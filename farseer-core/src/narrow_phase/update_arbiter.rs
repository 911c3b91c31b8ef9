//! Update of the contacts of an arbiter (behaviour chapter 03, section 5).

use crate::contacts::contact::Contact;
use crate::geom::GeomId;
use crate::geom::entry::Geoms;
use crate::methods::NarrowPhaseCollider;

/// Maximum numbers of contacts of a pair: to find, and to solve.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ContactLimits {
    pub(crate) detect: i32,
    pub(crate) resolve: i32,
}

/// Replaces `contacts` by the contacts of two geoms, deepest first.
pub(crate) fn find_contacts(
    method: NarrowPhaseCollider,
    geoms: &Geoms,
    (a, b): (GeomId, GeomId),
    limits: ContactLimits,
    contacts: &mut Vec<Contact>,
) {
    contacts.clear();
    let (geom_a, geom_b) = (&geoms[a], &geoms[b]);
    super::collide(method, limits.detect, geom_a, geom_b, contacts);
    contacts.retain(Contact::is_finite);
    sort_by_separation(contacts);
    contacts.truncate(limits.resolve.max(0) as usize);
}

/// Replaces the contacts of a pair. New contacts take the impulses of old ones with the same id, for the warm start.
pub(crate) fn replace_contacts(known: &mut Vec<Contact>, contacts: &mut [Contact]) {
    for contact in contacts.iter_mut() {
        if let Some(old) = known.iter().find(|old| old.id == contact.id) {
            contact.normal_impulse = old.normal_impulse;
            contact.tangent_impulse = old.tangent_impulse;
        }
    }
    known.clear();
    known.extend_from_slice(contacts);
}

/// Stable insertion sort, deepest first.
fn sort_by_separation(contacts: &mut [Contact]) {
    for i in 1..contacts.len() {
        let mut j = i;
        while j > 0 && contacts[j - 1].separation > contacts[j].separation {
            contacts.swap(j - 1, j);
            j -= 1;
        }
    }
}
