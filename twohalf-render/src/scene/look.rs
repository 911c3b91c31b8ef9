//! Looks: how the bodies and platforms of a scene are drawn.

use twohalf::BodyId;

use crate::{Color, PlatformLook, Point, Rectangle, Texture2D};

/// How a body or platform of a [`Scene`](super::Scene) is drawn.
#[derive(Debug, Clone, PartialEq)]
pub enum Look {
    /// Invisible and without a shadow.
    Nothing,
    /// A flat picture at the depth of the body's middle. Platforms are not drawn as pictures: this look hides
    /// them.
    Picture(Picture),
    /// A solid with top and sides, in plain colours: a platform, or the outline of each of a body's geoms along its
    /// depth. Convex outlines look right.
    Solid(PlatformLook),
    /// As [`Look::Solid`], with textures on the faces that have one.
    Textured(PlatformLook, Textures),
    /// A ball of this colour with a mark that shows its rotation, of the size of the body's object geom.
    Ball(Color),
    /// A stand-in figure, until a picture of it is drawn.
    Figure(Figure),
    /// A line from the middle of the body to that of another one, without a shadow: a piece of a rope.
    Line {
        /// The other end.
        to: BodyId,
        /// Its colour.
        color: Color,
        /// Width of the line, px.
        width: f32,
    },
}

/// A flat picture of a body. Made with [`Picture::new`] or [`Picture::standing`], other fields as needed.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// The texture.
    pub texture: Texture2D,
    /// The part of the texture that is shown; all of it if `None`.
    pub source: Option<Rectangle>,
    /// Multiplies every channel; its alpha is the opacity.
    pub tint: Color,
    /// Whether it is mirrored, left for right.
    #[doc(alias = "SpriteEffects.FlipHorizontally")]
    pub flip: bool,
    /// Size of one px of the texture in px of the world (a factor).
    pub scale: f32,
    /// Whether the middle of its lower edge is put where the body stands, upright. Otherwise its middle is at the
    /// body's origin, and it turns with the body.
    pub stands: bool,
}

impl Picture {
    /// The texture about the body's origin, turning with it.
    pub fn new(texture: &Texture2D) -> Self {
        let texture = texture.clone();
        Picture { texture, source: None, tint: Color::WHITE, flip: false, scale: 1.0, stands: false }
    }

    /// The texture upright on the body's feet.
    pub fn standing(texture: &Texture2D) -> Self {
        Picture { stands: true, ..Picture::new(texture) }
    }

    /// Width and height of the shown part of the texture, px.
    pub(super) fn size(&self) -> Point {
        let all = Rectangle::new(0, 0, self.texture.width(), self.texture.height());
        let shown = self.source.map_or(all, |source| source.intersection(&all));
        [shown.width as f32, shown.height as f32]
    }
}

/// Textures for the faces of a solid, repeated from the upper left corner of each face, one px of the texture a px.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Textures {
    /// On the upper face of a platform or box.
    pub top: Option<Texture2D>,
    /// On the face towards the viewer.
    pub front: Option<Texture2D>,
}

/// A stand-in for a figure: legs, body and head, as large as the body's object geom.
///
/// It is only a look. The body for it is made by the `Figure` of `twohalf-factories`; where both are used,
/// one of them is named by its full path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Figure {
    /// Colour of the clothes.
    pub color: Color,
    /// Whether it looks to the left.
    pub looks_left: bool,
    /// Phase of its walk, dimensionless: the number of steps taken. At whole numbers it stands.
    pub stride: f32,
    /// Its pose.
    pub pose: Pose,
}

/// The pose of a [`Figure`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Pose {
    /// It walks or stands, according to its stride.
    #[default]
    Walks,
    /// It strikes forwards.
    Strikes,
    /// It walks or stands with its hands over its head, according to its stride.
    Lifts,
    /// It jumps, or falls.
    Jumps,
    /// It leans backwards, struck.
    Reels,
    /// It lies on its back, its feet where the body stands.
    Lies,
}

impl Figure {
    /// Standing, looking to the right.
    pub const fn new(color: Color) -> Self {
        Figure { color, looks_left: false, stride: 0.0, pose: Pose::Walks }
    }
}
