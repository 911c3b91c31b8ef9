//! Bodies of the 2.5D engine as sprites, and their shadows.

use twohalf::{BodyId, TwoHalfPhysicsSimulator, Vector3};

use crate::{Color, Point, Sprite, SpriteBatch, Texture2D, shadow_scale};

/// Draws bodies of a simulator. A body that does not exist draws nothing.
pub trait DrawBody {
    /// Adds the shadow of a body: `texture`, its middle `position_offset` px from the point of the ground straight
    /// below the body's origin.
    ///
    /// With `is_shadow_resizable` the shadow is smaller the higher the body's lowest point is over the ground
    /// (thesis 3.4), by the law of [`shadow_scale`] with the drawn width of the texture as reference: a shadow at
    /// the height of its own width has lost half of what it can lose. `layer_depth`: 0 front to 1 back.
    #[doc(alias = "DrawShadow")]
    #[expect(clippy::too_many_arguments, reason = "the thesis' member has these")]
    fn draw_shadow(
        &self,
        batch: &mut SpriteBatch,
        body: BodyId,
        texture: &Texture2D,
        position_offset: Point,
        scale: Point,
        color_tint: Color,
        layer_depth: f32,
        is_shadow_resizable: bool,
    );

    /// Adds a body's sprite: `texture`, its middle at the body's origin on the screen, turned with the body.
    fn draw_body(&self, batch: &mut SpriteBatch, body: BodyId, texture: &Texture2D, layer_depth: f32);
}

impl DrawBody for TwoHalfPhysicsSimulator {
    fn draw_shadow(
        &self,
        batch: &mut SpriteBatch,
        body: BodyId,
        texture: &Texture2D,
        position_offset: Point,
        scale: Point,
        color_tint: Color,
        layer_depth: f32,
        is_shadow_resizable: bool,
    ) {
        let Some(body) = self.body(body) else { return };
        let position = body.position3d();
        let below = self.projection().to_screen(Vector3::new(position.x, 0.0, position.z));
        let size = match is_shadow_resizable {
            true => shadow_scale(position.y, texture.width() as f32 * scale[0].abs()),
            false => 1.0,
        };
        batch.draw(Sprite {
            scale: scale.map(|factor| factor * size),
            tint: color_tint,
            layer_depth,
            ..Sprite::centered(texture, [below.x + position_offset[0], below.y + position_offset[1]])
        });
    }

    fn draw_body(&self, batch: &mut SpriteBatch, body: BodyId, texture: &Texture2D, layer_depth: f32) {
        let Some(body) = self.body(body) else { return };
        let rotation = body.rotation();
        batch.draw(Sprite { rotation, layer_depth, ..Sprite::centered(texture, body.position()) });
    }
}
