//! Sprites, collected and drawn back to front.

use crate::{Canvas, Color, Point, Rectangle, Text, Texture2D, Transform, View};

/// A texture at a place. Made with [`Sprite::new`] or [`Sprite::centered`], other fields as needed:
///
/// ```
/// # use twohalf_render::{Color, Sprite, Texture2D};
/// let ball = Texture2D::ball(40, Color::rgb(200, 40, 40))?;
/// let sprite = Sprite { rotation: 0.5, layer_depth: 0.2, ..Sprite::centered(&ball, [100.0, 50.0]) };
/// # assert_eq!(sprite.origin, [20.0, 20.0]);
/// # Ok::<(), twohalf_render::RenderError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Sprite {
    /// The picture.
    pub texture: Texture2D,
    /// The part of the texture that is shown: a cell of a sheet ([`Rectangle::cell`]). All of it if `None`.
    #[doc(alias = "sourceRectangle")]
    pub source: Option<Rectangle>,
    /// Where the texture's `origin` goes on the canvas, px.
    pub position: Point,
    /// Rotation about the origin, radians, in screen orientation: positive is clockwise.
    pub rotation: f32,
    /// The point of the texture that is put at `position` and about which it turns and scales, px from the
    /// top left corner of the texture, or of the part of it that is shown.
    pub origin: Point,
    /// Factors along the texture's x and y, before the rotation; negative ones mirror.
    pub scale: Point,
    /// Slopes, px per px: additional displacement downwards for each px to the right and each px down,
    /// applied after the rotation. It serves sprites on a slope; `[0.0, 0.0]` leaves the sprite in the plane
    /// of the screen.
    pub slant: Point,
    /// Only what lies inside of this polygon is drawn: corners in px of the canvas.
    pub clip: Option<Vec<Point>>,
    /// Multiplies every channel; its alpha is the opacity. White leaves the texture as it is.
    pub tint: Color,
    /// Order in the batch, dimensionless: 0 is the front, 1 the back. Values outside are clamped.
    #[doc(alias = "LayerDepth")]
    pub layer_depth: f32,
}

impl Sprite {
    /// The texture as it is, its top left corner at `position`, in front (layer depth 0).
    pub fn new(texture: &Texture2D, position: impl Into<Point>) -> Self {
        Sprite {
            texture: texture.clone(),
            source: None,
            position: position.into(),
            rotation: 0.0,
            origin: [0.0, 0.0],
            scale: [1.0, 1.0],
            slant: [0.0, 0.0],
            clip: None,
            tint: Color::WHITE,
            layer_depth: 0.0,
        }
    }

    /// As [`Sprite::new`], with the middle of the texture at `position`.
    pub fn centered(texture: &Texture2D, position: impl Into<Point>) -> Self {
        Sprite { origin: texture.center(), ..Sprite::new(texture, position) }
    }

    /// A part of the texture, its top left corner at `position`, in front.
    pub fn part(texture: &Texture2D, source: Rectangle, position: impl Into<Point>) -> Self {
        Sprite { source: Some(source), ..Sprite::new(texture, position) }
    }

    /// A polygon of one colour, in front: corners in px of the canvas, convex or not.
    pub fn polygon(corners: impl Into<Vec<Point>>, color: Color) -> Self {
        let corners = corners.into();
        let [mut least, mut greatest] = [[f32::INFINITY; 2], [f32::NEG_INFINITY; 2]];
        for axis in [0, 1] {
            for corner in &corners {
                least[axis] = least[axis].min(corner[axis]);
                greatest[axis] = greatest[axis].max(corner[axis]);
            }
        }
        // One px, stretched over all of the polygon.
        Sprite {
            scale: [greatest[0] - least[0], greatest[1] - least[1]],
            tint: color,
            clip: Some(corners),
            ..Sprite::new(&Texture2D::white_pixel(), least)
        }
    }

    /// Draws it now, whatever its layer depth.
    pub fn draw(&self, canvas: &mut dyn Canvas) {
        let Sprite { texture, tint, .. } = self;
        let (transform, clip) = (self.transform(), self.clip.as_deref());
        match self.source {
            Some(source) => canvas.draw_texture_part(texture, source, &transform, *tint, clip),
            None => canvas.draw_texture(texture, &transform, *tint, clip),
        }
    }

    /// Takes the texture's px to the canvas: origin to zero, scale, turn, slant, move to the position.
    pub fn transform(&self) -> Transform {
        Transform::translation([-self.origin[0], -self.origin[1]])
            .then(&Transform::scaling(self.scale))
            .then(&Transform::rotation(self.rotation))
            .then(&Transform::slant(self.slant))
            .then(&Transform::translation(self.position))
    }
}

/// Sprites and texts of one picture, drawn back to front.
///
/// [`SpriteBatch::begin`] opens it, [`SpriteBatch::draw`] and [`SpriteBatch::draw_string`] add to it, and
/// [`SpriteBatch::end`] draws everything: larger layer depth first, equal ones in the order they were added. There is
/// no way to draw outside of begin and end, and so no error for it.
#[derive(Debug, Clone, Default)]
#[doc(alias = "Microsoft.Xna.Framework.Graphics.SpriteBatch")]
pub struct SpriteBatch {
    items: Vec<Item>,
    camera: Transform,
}

#[derive(Debug, Clone)]
enum Item {
    Sprite(Sprite),
    Text(Text),
}

impl Item {
    fn layer_depth(&self) -> f32 {
        let depth = match self {
            Item::Sprite(sprite) => sprite.layer_depth,
            Item::Text(text) => text.layer_depth,
        };
        // `+ 0.0` makes -0 and 0 equal.
        depth.clamp(0.0, 1.0) + 0.0
    }

    fn draw(&self, canvas: &mut dyn Canvas) {
        match self {
            Item::Text(text) => text.draw(canvas),
            Item::Sprite(sprite) => sprite.draw(canvas),
        }
    }
}

impl SpriteBatch {
    /// An empty batch.
    #[doc(alias = "Begin")]
    pub fn begin() -> Self {
        SpriteBatch::default()
    }

    /// An empty batch whose sprites a camera takes to the canvas; see [`Transform::camera`]. With numbers that are not
    /// finite nothing is drawn.
    #[doc(alias = "Begin(SpriteBlendMode, SpriteSortMode, SaveStateMode, Matrix)")]
    pub fn begin_with(camera: &Transform) -> Self {
        SpriteBatch { camera: *camera, ..SpriteBatch::default() }
    }

    /// Adds a sprite. One with a number that is not finite is dropped.
    #[doc(alias = "Draw")]
    pub fn draw(&mut self, sprite: Sprite) {
        let Sprite { position, rotation, origin, scale, slant, layer_depth, .. } = &sprite;
        let points = [position, origin, scale, slant].into_iter().chain(sprite.clip.iter().flatten());
        let numbers = points.flatten().chain([rotation, layer_depth]);
        if numbers.copied().all(f32::is_finite) {
            self.items.push(Item::Sprite(sprite));
        }
    }

    /// Adds a text. One with a number that is not finite is dropped.
    #[doc(alias = "DrawString")]
    pub fn draw_string(&mut self, text: Text) {
        if text.is_finite() {
            self.items.push(Item::Text(text));
        }
    }

    /// Draws everything and ends the batch.
    #[doc(alias = "End")]
    pub fn end(mut self, canvas: &mut dyn Canvas) {
        // The sort is stable: sprites of equal depth stay in the order in which they were added.
        self.items.sort_by(|a, b| b.layer_depth().total_cmp(&a.layer_depth()));
        let mut view = View::new(canvas).camera(&self.camera);
        self.items.iter().for_each(|item| item.draw(&mut view));
    }
}
