//! Everything of a simulator but the 2D engine below it and what updates work with.

use farseer_core::{BodyId, GeomId, PhysicsSimulator};
use serde::{Deserialize, Serialize};

use super::crush_watch::CrushWatch;
use super::depths::Depths;
use super::fields::Fields;
use super::footing::Footings;
use super::pace::Pace;
use super::partner::Partner;
use super::platforms::Platforms;
use super::scheme::DepthScheme;
use super::touches::TouchList;
use crate::Projection;

/// What this engine keeps beside the 2D engine.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct World {
    pub(crate) projection: Projection,
    pub(crate) scheme: DepthScheme,
    /// Z of layer depth 0 and of layer depth 1.
    pub(crate) layer_range: (f32, f32),
    pub(crate) depths: Depths,
    pub(crate) platforms: Platforms,
    pub(crate) fields: Fields,
    /// Bodies with a time of their own.
    pub(crate) paces: Vec<Pace>,
    /// Bodies of which it is told when they are crushed.
    pub(crate) crush_watches: Vec<CrushWatch>,
    /// Supports of walking figures about which handlers are asked.
    pub(crate) footings: Footings,
    /// Holder and load of grips that have broken and nobody was told of yet.
    pub(crate) broken_grips: Vec<(BodyId, BodyId)>,
    /// Contacts of the last update that came to its end. With the precise set only what was loaded: the engine below knows what
    /// touches from the first update on.
    #[serde(skip)]
    pub(crate) touches: TouchList,
    /// Derived: a body has refused an argument, and the next update is to tell of it.
    #[serde(skip)]
    pub(crate) has_rejected: bool,
}

impl World {
    pub(crate) fn new(projection: Projection) -> Self {
        World {
            layer_range: (0.0, projection.height() as f32),
            projection,
            scheme: DepthScheme::default(),
            depths: Depths::default(),
            platforms: Platforms::default(),
            fields: Fields::default(),
            paces: Vec::new(),
            crush_watches: Vec::new(),
            footings: Footings::default(),
            broken_grips: Vec::new(),
            touches: TouchList::default(),
            has_rejected: false,
        }
    }

    /// Notes an argument that a setter of a body has refused.
    #[cold]
    pub(crate) fn reject(&mut self, body: BodyId, argument: &'static str) {
        self.depths.bodies[body].rejected.note(argument);
        self.has_rejected = true;
    }

    /// 0 at the near end of the range, 1 at the far one.
    pub(crate) fn layer_depth(&self, z: f32) -> f32 {
        let (near, far) = self.layer_range;
        ((z - near) / (far - near)).clamp(0.0, 1.0)
    }

    /// Whether both sides of a contact could still touch.
    pub(crate) fn may_touch(&self, core: &PhysicsSimulator, this: GeomId, partner: Partner) -> bool {
        takes_part(core, this) && self.exists(core, partner)
    }

    /// Whether a partner takes part.
    pub(crate) fn exists(&self, core: &PhysicsSimulator, partner: Partner) -> bool {
        match partner {
            Partner::Geom(geom) => takes_part(core, geom),
            Partner::Platform(platform) => self.platforms.get(platform).is_some(),
            Partner::Ground => true,
        }
    }
}

/// Whether a geom is in its list and its body is enabled.
fn takes_part(core: &PhysicsSimulator, geom: GeomId) -> bool {
    core.is_listed(geom)
        && core.geom(geom).and_then(|geom| core.body(geom.body())).is_some_and(|body| body.enabled())
}
