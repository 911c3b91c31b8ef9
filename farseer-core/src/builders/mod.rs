//! Bodies with their geoms in one call. Ours: Farseer has a factory for each shape, and settings afterwards.

mod add;
mod body_builder;
mod geom_builder;
mod geom_shape;
mod mass;

pub use body_builder::BodyBuilder;
pub use geom_builder::GeomBuilder;
pub(crate) use mass::MassProperties;
