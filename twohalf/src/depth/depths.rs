//! All that bodies and geoms have beyond those of the 2D engine.

use farseer_core::math::scalar::nearest_finite;
use farseer_core::{BodyId, GeomId, PhysicsSimulator};
use serde::{Deserialize, Serialize};

use super::body::DepthBody;
use super::id_table::IdTable;
use super::profile::DepthProfile;
use super::upright::half_height;

/// Everything this engine keeps beside the objects of the 2D engine.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct Depths {
    pub(crate) bodies: IdTable<BodyId, DepthBody>,
    pub(crate) profiles: IdTable<GeomId, DepthProfile>,
    /// Bodies of which something has changed that the precise set is to be told of.
    #[serde(skip)]
    pub(crate) news: Vec<BodyId>,
    /// Bodies that a force waits for until they can be moved.
    #[serde(skip)]
    pub(crate) waiting: Vec<BodyId>,
    /// Bodies that it was told a force of: what a body weighs that does not move yet may become otherwise.
    #[serde(skip)]
    pub(crate) forced: Vec<BodyId>,
    /// Whether it has been told of everything else.
    #[serde(skip)]
    pub(crate) is_told: bool,
}

impl Depths {
    /// Whether a geom is upright, which only the precise set knows.
    pub(crate) fn have_uprights(&self, core: &PhysicsSimulator) -> bool {
        let profile = |geom: GeomId| self.profiles.get(geom);
        core.geoms().any(|geom| profile(geom).is_some_and(|profile| profile.is_upright()))
    }

    /// A body, to change it, or its geoms.
    pub(crate) fn edit(&mut self, id: BodyId) -> Option<&mut DepthBody> {
        let state = self.bodies.get_mut(id)?;
        if !std::mem::replace(&mut state.is_news, true) {
            self.news.push(id);
        }
        Some(state)
    }

    pub(crate) fn insert_body(&mut self, id: BodyId) {
        self.bodies.insert(id, DepthBody::default());
        self.edit(id);
    }

    /// Z of a body's middle.
    pub(crate) fn z_of(&self, body: BodyId) -> f32 {
        self.bodies.get(body).map_or(0.0, |state| state.z)
    }

    /// Z of the middle of what two geoms have in common.
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

/// Distance from a body's origin down to the lowest point of its object geom at its present rotation; 0
/// without an object geom. Negative if all of the geom lies above the origin.
pub(crate) fn lowest(core: &PhysicsSimulator, depths: &Depths, body: BodyId) -> f64 {
    let object = depths.bodies.get(body).and_then(|state| state.ground.object_geom());
    let Some(id) = object else { return 0.0 };
    let (Some(geom), Some(origin)) = (core.geom(id).filter(|geom| geom.body() == body), core.body(body))
    else {
        return 0.0;
    };
    let matrix = geom.matrix();
    // The geom's origin as seen from the body's: exact where they coincide.
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
