//! Views of bodies, geoms, grounds, platforms and contacts, through a simulator or the context of a callback.

pub(crate) mod access;
mod body;
mod body_mut;
mod contact_query;
mod contacts;
mod crush_query;
mod geom;
mod ground;
mod overlap;
mod platform;
mod swinging_platform;
mod turned_platform;
mod upright_overlap;
mod virtual_geom;

pub use access::{Access, AccessMut};
pub use body::TwoHalfBody;
pub(crate) use contact_query::{contact_of, list_contacts, partner_of};
pub use contacts::TwoHalfContact;
pub(crate) use contacts::contacts;
pub use crush_query::CrushInfo;
pub(crate) use crush_query::crush_info;
pub use geom::TwoHalfGeom;
pub use ground::GroundMut;
pub(crate) use overlap::PosedGeom;
pub use platform::PlatformMut;
pub use virtual_geom::VirtualGeom;
