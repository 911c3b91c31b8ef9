//! Depth data beside the core: state of bodies, platforms, fields and contacts. It depends on no stage.

mod body;
mod contact_list;
mod contact_target;
mod crush_monitor;
mod depth_state;
mod fields;
mod footing;
mod ground;
mod platform;
mod platform_id;
mod platforms;
mod profile;
mod scheme;
mod secondary_map;
mod support;
mod time_scale;
pub(crate) mod upright;
mod world;

pub(crate) use body::{DepthBody, is_movable};
pub(crate) use contact_list::{Contact, ContactKey, ContactList, ContactPoint, PersistedFeature};
pub use contact_target::{Axis, ContactTarget};
pub(crate) use crush_monitor::CrushMonitor;
pub(crate) use depth_state::{DepthState, lowest};
pub use fields::{Field, FieldId, Fluid, Region, Well};
pub(crate) use footing::Footing;
pub use ground::Ground;
pub use platform::{Platform, Swing};
pub use platform_id::PlatformId;
pub(crate) use platforms::Platforms;
pub use profile::DepthProfile;
pub use scheme::DepthScheme;
#[allow(deprecated, reason = "the former name goes on")]
pub use scheme::Methods;
pub(crate) use secondary_map::SecondaryMap;
pub use support::Support;
pub(crate) use time_scale::TimeScale;
pub(crate) use world::World;
