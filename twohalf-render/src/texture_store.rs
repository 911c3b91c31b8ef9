//! Textures by the ids under which the simulator knows them.

use std::path::{Path, PathBuf};

use twohalf::TextureId;

use crate::{RenderError, Result, Texture2D};

/// Endings that are tried after a name, in this order.
const ENDINGS: [&str; 4] = ["", ".png", ".jpg", ".jpeg"];

/// The pictures of a game. The simulator keeps only ids: those of the shadows of bodies and platforms.
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
    folder: PathBuf,
    names: Vec<(String, TextureId)>,
    missing: Vec<String>,
}

impl TextureStore {
    /// A store that looks for names in a folder, as XNA's content manager does in its root directory; one made with
    /// `default` looks in the current folder.
    #[doc(alias = "RootDirectory")]
    pub fn in_folder(folder: impl Into<PathBuf>) -> Self {
        TextureStore { folder: folder.into(), ..TextureStore::default() }
    }

    /// The picture with this name in the folder, PNG or JPEG; the endings `.png`, `.jpg` and `.jpeg` may be
    /// left out and are tried in this order. The file is read on the first call for it; later calls return
    /// the same id.
    ///
    /// # Errors
    /// There is no such file, it cannot be read, or is no such picture. A failed call keeps nothing.
    #[doc(alias = "Content.Load")]
    pub fn load(&mut self, name: &str) -> Result<TextureId> {
        if let Some(&(_, id)) = self.names.iter().find(|(known, _)| known == name) {
            return Ok(id);
        }
        let texture = Texture2D::load(find(&self.folder, name)?)?;
        Ok(self.keep(name, texture))
    }

    /// As [`load`](Self::load), but a missing picture is replaced by magenta and black squares
    /// ([`Texture2D::stand_in`]). Its name and the reason are listed in [`missing`](Self::missing).
    pub fn load_or_stand_in(&mut self, name: &str) -> TextureId {
        self.load(name).unwrap_or_else(|error| {
            self.missing.push(format!("{name}: {error}"));
            self.keep(name, Texture2D::stand_in())
        })
    }

    /// The names that were replaced by a stand-in, each with the reason, in the order of the calls.
    pub fn missing(&self) -> &[String] {
        &self.missing
    }

    fn keep(&mut self, name: &str, texture: Texture2D) -> TextureId {
        let id = self.add(texture);
        self.names.push((name.to_owned(), id));
        id
    }

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

fn find(folder: &Path, name: &str) -> Result<PathBuf> {
    let paths = ENDINGS.map(|ending| folder.join(format!("{name}{ending}")));
    let found = paths.into_iter().find(|path| path.is_file());
    found.ok_or_else(|| RenderError::NoPicture { name: name.to_owned(), folder: folder.to_owned() })
}
