//! The contacts of an update, and what is remembered of those of the last.

use farseer_core::order::{joined, sort_within};
use farseer_core::{BodyId, GeomId};
use serde::{Deserialize, Serialize};

use super::partner::{Axis, Partner};
use super::platform_id::PlatformId;
use crate::Vector3;
use crate::shapes::{Face, KeptAxis};

/// Names a contact from one update to the next, and orders them: creation numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub(crate) enum TouchKey {
    /// Two geoms, the older one first.
    Pair(u32, u32),
    /// A geom and a platform.
    Platform(u32, PlatformId),
    /// A geom and its body's ground.
    Ground(u32),
}

impl TouchKey {
    /// A number that has the order of keys.
    pub(crate) fn rank(self) -> u128 {
        joined(match self {
            TouchKey::Pair(older, younger) => [0, older, younger],
            TouchKey::Platform(geom, platform) => [1, geom, platform.number()],
            TouchKey::Ground(geom) => [2, geom, 0],
        })
    }
}

/// What a contact remembers of how it began.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) enum Kept {
    /// Nothing: it is found anew in every update.
    Nothing,
    /// Two outlines that met along Z: whether the younger geom is behind.
    Depth { is_behind: bool },
    /// An outline on a platform.
    Axis(KeptAxis),
    /// A ball whose centre is inside a platform, and the face through which it came.
    Face(Face),
    /// A ball whose centre is inside a prism, and the normal of the side through which it came.
    Side(Vector3),
    /// A contact of the 2D engine with motion along Z: solved here, found there.
    Plane,
}

impl Kept {
    /// False only after loading garbage.
    fn is_finite(&self) -> bool {
        match self {
            Kept::Side(normal) => normal.iter().all(|number| number.is_finite()),
            Kept::Axis(KeptAxis::Plane { normal, .. }) => normal.iter().all(|number| number.is_finite()),
            _ => true,
        }
    }
}

/// A contact of a geom with something.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) struct Touch {
    pub(crate) key: TouchKey,
    pub(crate) this: GeomId,
    pub(crate) body: BodyId,
    pub(crate) partner: Partner,
    /// The body of the partner, if that is a geom.
    pub(crate) partner_body: Option<BodyId>,
    /// That of the first point.
    pub(crate) normal: Vector3,
    pub(crate) kept: Kept,
    pub(crate) first_point: u32,
    pub(crate) point_count: u32,
    pub(crate) friction: f32,
    pub(crate) restitution: f32,
    /// Whether it exerts impulses.
    pub(crate) responds: bool,
    pub(crate) shares_pressure: bool,
    /// Place in the 2D engine's list, for [`Kept::Plane`]; of this update only.
    #[serde(skip)]
    pub(crate) arbiter: u32,
}

impl Touch {
    pub(crate) fn axis(&self) -> Axis {
        Axis::of(self.normal.z)
    }

    /// Of all points of its list.
    pub(crate) fn points_in<'a>(&self, points: &'a [TouchPoint]) -> &'a [TouchPoint] {
        &points[self.first_point as usize..(self.first_point + self.point_count) as usize]
    }

    pub(crate) fn is_plane(&self) -> bool {
        self.kept == Kept::Plane
    }
}

/// A point of a contact.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) struct TouchPoint {
    pub(crate) position: Vector3,
    /// Unit vector from the partner to `this`.
    pub(crate) normal: Vector3,
    pub(crate) separation: f32,
    pub(crate) feature: u32,
    pub(crate) normal_impulse: f32,
    /// Along the two tangents of the normal; see the solver.
    pub(crate) friction_impulse: [f32; 2],
}

/// Contacts in the order of their keys, with their points.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct TouchList {
    pub(crate) touches: Vec<Touch>,
    pub(crate) points: Vec<TouchPoint>,
    /// Room to sort in.
    #[serde(skip)]
    pub(crate) places: Vec<(u128, u32)>,
}

impl TouchList {
    pub(crate) fn clear(&mut self) {
        self.touches.clear();
        self.points.clear();
    }

    pub(crate) fn find(&self, key: TouchKey) -> Option<&Touch> {
        let index = self.touches.binary_search_by_key(&key, |touch| touch.key).ok()?;
        self.touches.get(index)
    }

    pub(crate) fn points_of(&self, touch: &Touch) -> &[TouchPoint] {
        touch.points_in(&self.points)
    }

    pub(crate) fn points_of_mut(&mut self, touch: &Touch) -> &mut [TouchPoint] {
        &mut self.points[touch.first_point as usize..(touch.first_point + touch.point_count) as usize]
    }

    pub(crate) fn sort(&mut self) {
        sort_within(&mut self.places, &mut self.touches, |touch| touch.key.rank());
    }

    /// Whether keys are in order, ranges in bounds and numbers finite: false only after loading garbage.
    pub(crate) fn is_valid(&self) -> bool {
        let finite = |v: &Vector3| v.iter().all(|number| number.is_finite());
        let in_bounds = |touch: &Touch| {
            let end = u64::from(touch.first_point) + u64::from(touch.point_count);
            end <= self.points.len() as u64 && touch.point_count > 0
        };
        let touch_is_finite = |touch: &Touch| {
            finite(&touch.normal)
                && touch.friction.is_finite()
                && touch.restitution.is_finite()
                && touch.kept.is_finite()
        };
        let point_is_finite = |point: &TouchPoint| {
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
