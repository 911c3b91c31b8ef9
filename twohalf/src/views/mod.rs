//! What users see of bodies, geoms, grounds, platforms and contacts: views of the data, through a simulator or the context of a
//! callback.

mod access;
mod body;
mod body_mut;
mod contacts;
mod geom;
mod ground;
mod overlap;
mod platform;
mod squeeze;
mod swinging_platform;
mod touching;
mod turned_platform;
mod upright_overlap;
mod virtual_geom;

pub use access::{Access, AccessMut};
pub use body::TwoHalfBody;
pub use contacts::TwoHalfContact;
pub(crate) use contacts::contacts;
pub use geom::TwoHalfGeom;
pub use ground::GroundMut;
pub(crate) use overlap::Placed;
pub use platform::PlatformMut;
pub use squeeze::Squeeze;
pub(crate) use squeeze::squeeze;
pub(crate) use touching::{list_touches, partner_of, touch_of};
pub use virtual_geom::VirtualGeom;
