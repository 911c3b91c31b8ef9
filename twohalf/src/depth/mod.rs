//! What there is beside the 2D engine: data, and what follows from it alone. Knows no stage.

mod body;
mod crush_watch;
mod depths;
mod fields;
mod footing;
mod ground;
mod id_table;
mod pace;
mod partner;
mod platform;
mod platform_id;
mod platforms;
mod profile;
mod scheme;
mod support;
mod touches;
pub(crate) mod upright;
mod world;

pub(crate) use body::{DepthBody, is_movable};
pub(crate) use crush_watch::CrushWatch;
pub(crate) use depths::{Depths, lowest};
pub use fields::{Field, FieldId, Fluid, Region, Well};
pub(crate) use footing::Footing;
pub use ground::Ground;
pub(crate) use id_table::IdTable;
pub(crate) use pace::Pace;
pub use partner::{Axis, Partner};
pub use platform::{Platform, Swing};
pub use platform_id::PlatformId;
pub(crate) use platforms::Platforms;
pub use profile::DepthProfile;
pub use scheme::DepthScheme;
#[allow(deprecated, reason = "the former name goes on")]
pub use scheme::Methods;
pub use support::Support;
pub(crate) use touches::{Kept, Touch, TouchKey, TouchList, TouchPoint};
pub(crate) use world::World;
