//! Depth state of all bodies and geoms, beside the objects of the core.

use farseer_core::math::scalar::nearest_finite;
use farseer_core::{BodyId, GeomId, PhysicsSimulator};
use serde::{Deserialize, Serialize};

use super::body::DepthBody;
use super::profile::DepthProfile;
use super::secondary_map::SecondaryMap;
use super::upright::half_height;

/// Depth state of all bodies and geoms, and the changes that the core has not received yet.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct DepthState {
    pub(crate) bodies: SecondaryMap<BodyId, DepthBody>,
    pub(crate) profiles: SecondaryMap<GeomId, DepthProfile>,
    /// Bodies with changes that the precise set has not received yet.
    #[serde(skip)]
    pub(crate) edited: Vec<BodyId>,
    /// Bodies with a force along Z that cannot move yet, because they do not take part in the simulation.
    #[serde(skip)]
    pub(crate) waiting: Vec<BodyId>,
    /// Bodies whose force along Z the precise set has received. A body that does not move yet may change its
    /// mass, so the force is sent again.
    #[serde(skip)]
    pub(crate) forced: Vec<BodyId>,
    /// Whether the precise set has received the depth states of all bodies once.
    #[serde(skip)]
    pub(crate) is_sent: bool,
}

impl DepthState {
    /// Returns whether any geom is upright; only the precise set supports upright geoms.
    pub(crate) fn have_uprights(&self, core: &PhysicsSimulator) -> bool {
        let profile = |geom: GeomId| self.profiles.get(geom);
        core.geoms().any(|geom| profile(geom).is_some_and(|profile| profile.is_upright()))
    }

    /// Returns a body for a change of itself or of its geoms; `None` for a stale id. The next update sends the body to the core
    /// again.
    pub(crate) fn edit(&mut self, id: BodyId) -> Option<&mut DepthBody> {
        let state = self.bodies.get_mut(id)?;
        if !std::mem::replace(&mut state.is_edited, true) {
            self.edited.push(id);
        }
        Some(state)
    }

    pub(crate) fn insert_body(&mut self, id: BodyId) {
        self.bodies.insert(id, DepthBody::default());
        self.edit(id);
    }

    /// Z of a body's centre of mass, px.
    pub(crate) fn z_of(&self, body: BodyId) -> f32 {
        self.bodies.get(body).map_or(0.0, |state| state.z)
    }

    /// Z of the middle of the common depth interval of two geoms, px.
    pub(crate) fn middle(&self, core: &PhysicsSimulator, geom1: GeomId, geom2: GeomId) -> f32 {
        let interval = |geom: GeomId| {
            let z = core.geom(geom).map_or(0.0, |geom| self.z_of(geom.body()));
            let half = self.profiles.get(geom).map_or(0.0, |profile| profile.half_depth());
            (nearest_finite(z - half), nearest_finite(z + half))
        };
        let ((near1, far1), (near2, far2)) = (interval(geom1), interval(geom2));
        let (near, far) = (near1.max(near2), far1.min(far2));
        let middle = (near + far) * 0.5;
        if middle.is_finite() { middle } else { near * 0.5 + far * 0.5 }
    }
}

/// Distance from a body's origin down to the lowest point of its object geom at the present rotation, px; 0
/// without an object geom. It is negative if the geom lies above the origin.
pub(crate) fn lowest(core: &PhysicsSimulator, depths: &DepthState, body: BodyId) -> f64 {
    let object = depths.bodies.get(body).and_then(|state| state.ground.object_geom());
    let Some(id) = object else { return 0.0 };
    let (Some(geom), Some(origin)) = (core.geom(id).filter(|geom| geom.body() == body), core.body(body))
    else {
        return 0.0;
    };
    let matrix = geom.matrix();
    // The geom's origin relative to the body's; exact if both coincide.
    let offset = f64::from(matrix.m42) - f64::from(origin.position().y);
    if let Some(upright) = depths.profiles.get(id).and_then(DepthProfile::upright) {
        return f64::from(geom.offset().y) + f64::from(half_height(&upright));
    }
    match depths.profiles.get(id) {
        Some(DepthProfile::Round { radius }) => offset + f64::from(*radius),
        _ => {
            let (across, down) = (f64::from(matrix.m12), f64::from(matrix.m22));
            let heights =
                geom.local_vertices().iter().map(|v| f64::from(v.x) * across + f64::from(v.y) * down);
            offset + heights.fold(f64::NEG_INFINITY, f64::max)
        }
    }
}
