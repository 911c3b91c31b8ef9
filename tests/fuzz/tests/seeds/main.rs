//! What must hold whatever is called, from fixed seeds.

mod play;
mod saves;
mod small;
mod soak;
mod texts_and_textures;
