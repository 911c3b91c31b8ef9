//! Pairs of the precise set in 2D: sensors may also pair with static and kinematic bodies.

use super::GeomId;
use super::entry::{GeomEntry, Geoms};
use super::filter::{Filter, may_keep_arbiter};
use crate::body::entry::Bodies;

impl Filter<'_> {
    /// Like [`may_collide`](Self::may_collide), for the precise set in 2D: a [sensor](is_sensor_pair) may also pair
    /// with static and kinematic bodies.
    pub(crate) fn may_touch(&self, a: &GeomEntry, b: &GeomEntry) -> bool {
        self.may_be_pair(a, b, is_sensor_pair)
    }
}

/// Whether one of two geoms has no collision response, as sensors have none.
fn is_sensor_pair(a: &GeomEntry, b: &GeomEntry) -> bool {
    !(a.geom.collision_response_enabled() && b.geom.collision_response_enabled())
}

/// Like [`is_valid_pair`](super::filter::is_valid_pair), for the precise set in 2D: a [sensor](is_sensor_pair) may also pair with static and
/// kinematic bodies.
pub(crate) fn may_keep_touching(pair: (GeomId, GeomId), geoms: &Geoms, bodies: &Bodies) -> bool {
    may_keep_arbiter(pair, geoms, bodies, is_sensor_pair)
}
