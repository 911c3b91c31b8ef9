//! Persistent contacts: key, manifold points with accumulated impulses, and the feature that persists between
//! updates.

use farseer_core::{BodyId, GeomId};
use farseer_precise::storage::order::{packed_key, sort_by_number_in};
use serde::{Deserialize, Serialize};

use super::contact_target::{Axis, ContactTarget};
use super::platform_id::PlatformId;
use crate::Vector3;
use crate::shapes::{Face, PersistedAxis};

/// Identifies a contact between updates and orders contacts, by creation numbers of geoms.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(crate) enum ContactKey {
    /// The contact is between two geoms, by creation numbers, the older geom first.
    Pair(u32, u32),
    /// The contact is between a geom, by creation number, and a platform.
    Platform(u32, PlatformId),
    /// The contact is between a geom, by creation number, and the ground of its body.
    Ground(u32),
}

impl ContactKey {
    /// Returns a number that orders contacts as their keys do.
    pub(crate) fn rank(self) -> u128 {
        packed_key(match self {
            ContactKey::Pair(older, younger) => [0, older, younger],
            ContactKey::Platform(geom, platform) => [1, geom, platform.number()],
            ContactKey::Ground(geom) => [2, geom, 0],
        })
    }
}

/// Feature of a contact that persists from the first touch on; the narrow phase tests it first.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) enum PersistedFeature {
    /// No feature: the contact is found anew in every update.
    Nothing,
    /// Two outlines touch along Z; `is_behind` tells whether the younger geom is behind the older one.
    Depth { is_behind: bool },
    /// An outline touches a platform along this contact axis.
    Axis(PersistedAxis),
    /// The centre of a ball is inside of a platform; it entered through this face.
    Face(Face),
    /// The centre of a ball is inside of a prism; it entered through the side with this normal.
    Side(Vector3),
    /// A contact that the core finds in X and Y and this crate solves, because its sides slide along Z.
    Plane,
}

impl PersistedFeature {
    /// Returns whether the numbers of the feature are finite: false only for a damaged save.
    fn is_finite(&self) -> bool {
        match self {
            PersistedFeature::Side(normal) => normal.iter().all(|number| number.is_finite()),
            PersistedFeature::Axis(PersistedAxis::Plane { normal, .. }) => {
                normal.iter().all(|number| number.is_finite())
            }
            _ => true,
        }
    }
}

/// A contact of a geom with a target: key, normal, coefficients and the range of its points.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) struct Contact {
    pub(crate) key: ContactKey,
    pub(crate) this: GeomId,
    pub(crate) body: BodyId,
    pub(crate) partner: ContactTarget,
    /// Body of the target; `None` if the target is not a geom.
    pub(crate) partner_body: Option<BodyId>,
    /// Unit normal of the first point, from the target to `this`, y down.
    pub(crate) normal: Vector3,
    pub(crate) kept: PersistedFeature,
    /// Index of the first point of the contact in the list of points.
    pub(crate) first_point: u32,
    /// Number of points of the contact.
    pub(crate) point_count: u32,
    /// Combined friction coefficient, dimensionless.
    pub(crate) friction: f32,
    /// Combined restitution coefficient, dimensionless.
    pub(crate) restitution: f32,
    /// Whether the contact exerts impulses.
    pub(crate) responds: bool,
    /// Whether all points share one normal impulse in equal parts.
    pub(crate) shares_pressure: bool,
    /// Index in the arbiter list of the core, for [`PersistedFeature::Plane`]; valid in this update only.
    #[serde(skip)]
    pub(crate) arbiter: u32,
}

impl Contact {
    pub(crate) fn axis(&self) -> Axis {
        Axis::of(self.normal.z)
    }

    /// Returns the points of the contact, a part of the given list of all points.
    pub(crate) fn points_in<'a>(&self, points: &'a [ContactPoint]) -> &'a [ContactPoint] {
        &points[self.first_point as usize..(self.first_point + self.point_count) as usize]
    }

    pub(crate) fn is_plane(&self) -> bool {
        self.kept == PersistedFeature::Plane
    }
}

/// A point of a contact manifold.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) struct ContactPoint {
    pub(crate) position: Vector3,
    /// Unit vector from the target to `this`, y down.
    pub(crate) normal: Vector3,
    /// Separation in px; negative is penetration.
    pub(crate) separation: f32,
    /// Feature id, by which impulses are matched between updates; dimensionless.
    pub(crate) feature: u32,
    /// Accumulated normal impulse, mass · px/s, 0 or more.
    pub(crate) normal_impulse: f32,
    /// Accumulated friction impulses along the first and the second tangent of the solver, mass · px/s.
    pub(crate) friction_impulse: [f32; 2],
}

/// Contacts sorted by key, with their points.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct ContactList {
    pub(crate) touches: Vec<Contact>,
    pub(crate) points: Vec<ContactPoint>,
    /// Reused buffer for sorting: ranks of keys with indices of contacts.
    #[serde(skip)]
    pub(crate) places: Vec<(u128, u32)>,
}

impl ContactList {
    pub(crate) fn clear(&mut self) {
        self.touches.clear();
        self.points.clear();
    }

    pub(crate) fn find(&self, key: ContactKey) -> Option<&Contact> {
        let index = self.touches.binary_search_by_key(&key, |touch| touch.key).ok()?;
        self.touches.get(index)
    }

    pub(crate) fn points_of(&self, touch: &Contact) -> &[ContactPoint] {
        touch.points_in(&self.points)
    }

    pub(crate) fn points_of_mut(&mut self, touch: &Contact) -> &mut [ContactPoint] {
        &mut self.points[touch.first_point as usize..(touch.first_point + touch.point_count) as usize]
    }

    pub(crate) fn sort(&mut self) {
        sort_by_number_in(&mut self.places, &mut self.touches, |touch| touch.key.rank());
    }

    /// Returns whether keys are sorted, ranges are in bounds and numbers are finite: false only for a damaged save.
    pub(crate) fn is_valid(&self) -> bool {
        let finite = |v: &Vector3| v.iter().all(|number| number.is_finite());
        let in_bounds = |touch: &Contact| {
            let end = u64::from(touch.first_point) + u64::from(touch.point_count);
            end <= self.points.len() as u64 && touch.point_count > 0
        };
        let touch_is_finite = |touch: &Contact| {
            finite(&touch.normal)
                && touch.friction.is_finite()
                && touch.restitution.is_finite()
                && touch.kept.is_finite()
        };
        let point_is_finite = |point: &ContactPoint| {
            let [along, across] = point.friction_impulse;
            let numbers = [point.separation, point.normal_impulse, along, across];
            finite(&point.position)
                && finite(&point.normal)
                && numbers.iter().all(|number| number.is_finite())
        };
        self.touches.windows(2).all(|pair| pair[0].key <= pair[1].key)
            && self.touches.iter().all(|touch| in_bounds(touch) && touch_is_finite(touch))
            && self.points.iter().all(point_is_finite)
    }
}
