//! What must hold whatever is called, from fixed seeds.

mod figures;
mod play;
mod saves;
mod small;
mod soak;
mod texts_and_textures;
