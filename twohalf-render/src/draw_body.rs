//! Bodies of the 2.5D engine as sprites, and their shadows.

use twohalf::{BodyId, GeomId, TwoHalfPhysicsSimulator};

use crate::shadow::Shadow;
use crate::{Color, Point, Sprite, SpriteBatch, Texture2D, TextureStore};

/// Draws bodies of a simulator. A stale body draws nothing.
pub trait DrawBody {
    /// Adds the shadow of a body: the shadow image of its ground. It lies on the topmost surface (ground,
    /// platform, or walkable top of a body) beneath the origin of one of its geoms, usually the object geom.
    /// Without an image, without a surface (below the ground), or with a geom of another body, it adds
    /// nothing.
    ///
    /// The image is that on level ground; a slope inclines it. Off the ground it ends at the edge of its
    /// face. Its middle is `position_offset` px, measured on level ground as seen on the screen, from the
    /// point straight below the geom's origin.
    ///
    /// With `is_shadow_resizable` the shadow shrinks with the height of the geom's lowest point over the
    /// surface below its origin (thesis 3.4). The law is that of [`shadow_scale`](crate::shadow_scale) with
    /// the drawn width of the image as reference: a shadow at the height of its own width has lost half of
    /// what it can lose.
    ///
    /// `layer_depth`: 0 front to 1 back. A shadow on the ground belongs behind everything, one on a platform
    /// or body just before that; [`TwoHalfPhysicsSimulator::surface_beneath_body`] returns the surface.
    #[doc(alias = "DrawShadow")]
    #[expect(clippy::too_many_arguments, reason = "the thesis' member has these")]
    fn draw_shadow(
        &self,
        batch: &mut SpriteBatch,
        textures: &TextureStore,
        body: BodyId,
        geom: GeomId,
        position_offset: Point,
        scale: Point,
        color_tint: Color,
        layer_depth: f32,
        is_shadow_resizable: bool,
    );

    /// Adds a body's sprite: `texture`, its middle at the body's origin on the screen, rotated with the body.
    fn draw_body(&self, batch: &mut SpriteBatch, body: BodyId, texture: &Texture2D, layer_depth: f32);
}

impl DrawBody for TwoHalfPhysicsSimulator {
    fn draw_shadow(
        &self,
        batch: &mut SpriteBatch,
        textures: &TextureStore,
        body: BodyId,
        geom: GeomId,
        position_offset: Point,
        scale: Point,
        color_tint: Color,
        layer_depth: f32,
        is_shadow_resizable: bool,
    ) {
        let Some(image) = self.body(body).and_then(|body| body.ground().shadow_image()) else { return };
        let geom = self.geom(geom).filter(|geom| geom.body() == body);
        let (Some(texture), Some(geom)) = (textures.get(image), geom) else { return };
        let lowest = is_shadow_resizable.then(|| geom.virtual_geom().bottom);
        let shadow = Shadow { texture, position_offset, scale, color_tint, layer_depth };
        shadow.draw_beneath(self, batch, geom.position3d(), lowest);
    }

    fn draw_body(&self, batch: &mut SpriteBatch, body: BodyId, texture: &Texture2D, layer_depth: f32) {
        let Some(body) = self.body(body) else { return };
        let rotation = body.rotation();
        batch.draw(Sprite { rotation, layer_depth, ..Sprite::centered(texture, body.position()) });
    }
}
