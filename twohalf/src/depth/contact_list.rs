//! Persistent contacts: key, manifold points with accumulated impulses, and the feature that persists between
//! updates.

use farseer_core::order::{joined, sort_within};
use farseer_core::{BodyId, GeomId};
use serde::{Deserialize, Serialize};

use super::contact_target::{Axis, ContactTarget};
use super::platform_id::PlatformId;
use crate::Vector3;
use crate::shapes::{Face, PersistedAxis};

/// Identifies a contact between updates and orders contacts, by creation numbers of geoms.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(crate) enum ContactKey {
    /// Two geoms, the older one first.
    Pair(u32, u32),
    /// A geom and a platform.
    Platform(u32, PlatformId),
    /// A geom and its body's ground.
    Ground(u32),
}

impl ContactKey {
    /// A number with the order of the keys.
    pub(crate) fn rank(self) -> u128 {
        joined(match self {
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
    /// Two outlines that touch along Z; whether the younger geom is behind.
    Depth { is_behind: bool },
    /// An outline on a platform: the contact axis.
    Axis(PersistedAxis),
    /// A ball whose centre is inside a platform: the face through which it entered.
    Face(Face),
    /// A ball whose centre is inside a prism: the normal of the side through which it entered.
    Side(Vector3),
    /// A contact that the core finds in X and Y and this crate solves, because its sides slide along Z.
    Plane,
}

impl PersistedFeature {
    /// Whether its numbers are finite: false only for a damaged save.
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
    /// The body of the target, if that is a geom.
    pub(crate) partner_body: Option<BodyId>,
    /// Unit normal of the first point, from the target to `this`, y down.
    pub(crate) normal: Vector3,
    pub(crate) kept: PersistedFeature,
    /// Index of the first point in the list.
    pub(crate) first_point: u32,
    /// Number of points.
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

    /// The points of the contact in the list that it belongs to.
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
    /// Accumulated friction impulses along the two tangents of the solver, mass · px/s.
    pub(crate) friction_impulse: [f32; 2],
}

/// Contacts sorted by key, with their points.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct ContactList {
    pub(crate) touches: Vec<Contact>,
    pub(crate) points: Vec<ContactPoint>,
    /// Buffer for sorting.
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
        sort_within(&mut self.places, &mut self.touches, |touch| touch.key.rank());
    }

    /// Whether keys are sorted, ranges are in bounds and numbers are finite: false only for a damaged save.
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
