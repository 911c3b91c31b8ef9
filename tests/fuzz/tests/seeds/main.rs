//! Tests invariants that hold for all calls, with fixed seeds.

mod figures;
mod play;
mod saves;
mod small;
mod soak;
mod texts_and_textures;
