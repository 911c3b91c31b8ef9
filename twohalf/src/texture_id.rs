//! Ids of pictures.

use serde::{Deserialize, Serialize};

/// Identifies a picture of the game. The engine draws nothing: it keeps id and size for the renderer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[doc(alias = "Texture2D")]
pub struct TextureId {
    /// Id of the picture in the game.
    pub id: u32,
    /// Width in px.
    pub width: u32,
    /// Height in px.
    pub height: u32,
}
