//! Where our methods hold and where they fail, and what judges it.

#[path = "../common/mod.rs"]
mod common;

#[macro_use]
mod written;

mod arena;
mod depth;
mod facts;
mod joints;
mod judges;
mod plane;
mod sleep;
