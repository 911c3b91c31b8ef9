//! State of a simulator beside the core, without the buffers of an update.

use farseer_core::{BodyId, GeomId, PhysicsSimulator};
use serde::{Deserialize, Serialize};

use super::contact_list::ContactList;
use super::contact_target::ContactTarget;
use super::crush_monitor::CrushMonitor;
use super::depth_state::DepthState;
use super::fields::Fields;
use super::footing::Footings;
use super::platforms::Platforms;
use super::scheme::DepthScheme;
use super::time_scale::TimeScale;
use crate::Projection;

/// State that `twohalf` keeps beside the core: depths, platforms, fields, projection and contacts.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct World {
    pub(crate) projection: Projection,
    pub(crate) scheme: DepthScheme,
    /// Z in px of layer depth 0 and of layer depth 1.
    pub(crate) layer_range: (f32, f32),
    pub(crate) depths: DepthState,
    pub(crate) platforms: Platforms,
    pub(crate) fields: Fields,
    /// Bodies with a time scale other than 1, with that time scale.
    pub(crate) paces: Vec<TimeScale>,
    /// Bodies whose crushing is reported.
    pub(crate) crush_watches: Vec<CrushMonitor>,
    /// Supports and walls of characters about which the next update asks an event handler.
    pub(crate) footings: Footings,
    /// Holder and load of broken grips that no event has reported yet.
    pub(crate) broken_grips: Vec<(BodyId, BodyId)>,
    /// Contacts of the last complete update. With the precise set only loaded ones: the core has the contacts
    /// from the first update on.
    #[serde(skip)]
    pub(crate) touches: ContactList,
    /// Whether a body has refused an argument since the last update.
    #[serde(skip)]
    pub(crate) has_rejected: bool,
}

impl World {
    pub(crate) fn new(projection: Projection) -> Self {
        World {
            layer_range: (0.0, projection.height() as f32),
            projection,
            scheme: DepthScheme::default(),
            depths: DepthState::default(),
            platforms: Platforms::default(),
            fields: Fields::default(),
            paces: Vec::new(),
            crush_watches: Vec::new(),
            footings: Footings::default(),
            broken_grips: Vec::new(),
            touches: ContactList::default(),
            has_rejected: false,
        }
    }

    /// Stores the name of an argument that a setter of a body has refused. The next update reports it as an event.
    #[cold]
    pub(crate) fn reject(&mut self, body: BodyId, argument: &'static str) {
        self.depths.bodies[body].rejected.note(argument);
        self.has_rejected = true;
    }

    /// Layer depth at a Z, dimensionless: 0 at the near end of the range, 1 at the far end.
    pub(crate) fn layer_depth(&self, z: f32) -> f32 {
        let (near, far) = self.layer_range;
        ((z - near) / (far - near)).clamp(0.0, 1.0)
    }

    /// Returns whether both sides of a contact take part in the simulation.
    pub(crate) fn may_touch(&self, core: &PhysicsSimulator, this: GeomId, partner: ContactTarget) -> bool {
        takes_part(core, this) && self.exists(core, partner)
    }

    /// Returns whether a contact target takes part in the simulation.
    pub(crate) fn exists(&self, core: &PhysicsSimulator, partner: ContactTarget) -> bool {
        match partner {
            ContactTarget::Geom(geom) => takes_part(core, geom),
            ContactTarget::Platform(platform) => self.platforms.get(platform).is_some(),
            ContactTarget::Ground => true,
        }
    }
}

/// Returns whether a geom is in the list of the simulation and its body is enabled.
fn takes_part(core: &PhysicsSimulator, geom: GeomId) -> bool {
    core.is_listed(geom)
        && core.geom(geom).and_then(|geom| core.body(geom.body())).is_some_and(|body| body.enabled())
}
