//! Pictures, as far as the engine has to know them.

use serde::{Deserialize, Serialize};

/// Names a picture of the game. The engine draws nothing: it keeps the name and the size for whoever draws.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[doc(alias = "Texture2D")]
pub struct TextureId {
    /// The game's own number for the picture.
    pub id: u32,
    /// Width in px.
    pub width: u32,
    /// Height in px.
    pub height: u32,
}
