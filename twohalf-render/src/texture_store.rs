//! Textures by the ids under which the simulator knows them.

use twohalf::TextureId;

use crate::Texture2D;

/// The pictures of a game. The simulator keeps ids only: those of the shadows of bodies and platforms.
///
/// ```
/// # use twohalf_render::{Texture2D, TextureStore};
/// let mut textures = TextureStore::default();
/// let id = textures.add(Texture2D::shadow(44, 18)?);
/// assert_eq!((id.width, id.height), (44, 18));
/// assert_eq!(textures.get(id).map(Texture2D::width), Some(44));
/// # Ok::<(), twohalf_render::RenderError>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct TextureStore {
    textures: Vec<Texture2D>,
}

impl TextureStore {
    /// Keeps a texture and gives it an id.
    pub fn add(&mut self, texture: Texture2D) -> TextureId {
        let id =
            TextureId { id: self.textures.len() as u32, width: texture.width(), height: texture.height() };
        self.textures.push(texture);
        id
    }

    /// The texture with this id; `None` if this store has none of this number and size.
    pub fn get(&self, id: TextureId) -> Option<&Texture2D> {
        let texture = self.textures.get(id.id as usize)?;
        ((texture.width(), texture.height()) == (id.width, id.height)).then_some(texture)
    }
}
