//! Position and size of the shadow of an object in the air.

use twohalf::{Surface, TwoHalfPhysicsSimulator, Vector3};

use crate::surface::{edge, slopes, to_screen};
use crate::{Color, Point, Sprite, SpriteBatch, Texture2D, Transform};

/// Limit of the scale of a shadow at great heights (a factor).
pub const SHADOW_SCALE_LIMIT: f32 = 0.3;

/// Factor for the size of a shadow. The lowest point of its object is `height` above the surface that takes
/// the shadow: "the more an object flies above the ground, the smaller its shadow" (thesis 3.4).
///
/// ```text
/// scale = L + (1 - L) * reference / (reference + height)      L = SHADOW_SCALE_LIMIT = 0.3
/// ```
///
/// The scale is 1 on the ground and below it. At `height == reference` it has lost half of 1 - L; it falls
/// towards L and never reaches it. The thesis states no law. This one falls fastest just above the ground,
/// where the eye has to tell resting from flying. It still changes high up, where a linear law would already
/// have reached its end. `reference` should be about the object's own size or a little more, in the same unit
/// as `height`.
///
/// Returns 0, a shadow that is not drawn, if `height` is not finite or `reference` is not finite and greater
/// than 0.
///
/// ```
/// use twohalf_render::shadow_scale;
/// assert_eq!(shadow_scale(0.0, 100.0), 1.0);
/// assert_eq!(shadow_scale(100.0, 100.0), 0.65);
/// assert!(shadow_scale(1000.0, 100.0) > 0.3);
/// ```
#[doc(alias = "isShadowResizable")]
pub fn shadow_scale(height: f32, reference: f32) -> f32 {
    if !height.is_finite() || !reference.is_finite() || reference <= 0.0 {
        return 0.0;
    }
    // Divided by the reference first: the sum of two large finite numbers could be infinite.
    SHADOW_SCALE_LIMIT + (1.0 - SHADOW_SCALE_LIMIT) / (1.0 + height.max(0.0) / reference)
}

/// The picture of a shadow as it lies on level ground.
pub(crate) struct Shadow<'a> {
    pub(crate) texture: &'a Texture2D,
    pub(crate) position_offset: Point,
    pub(crate) scale: Point,
    pub(crate) color_tint: Color,
    pub(crate) layer_depth: f32,
}

impl Shadow<'_> {
    /// Draws the shadow on the topmost surface beneath a point of the world, clipped at the surface's edge.
    /// With the height of its object, the shadow shrinks with the object's distance from the surface.
    pub(crate) fn draw_beneath(
        &self,
        simulator: &TwoHalfPhysicsSimulator,
        batch: &mut SpriteBatch,
        point: Vector3,
        lowest: Option<f32>,
    ) {
        if let Some(surface) = simulator.surface_beneath(point) {
            let edge = edge(simulator, &surface, point.x);
            batch.draw(self.sprite(simulator, &surface, edge, point, lowest));
        }
    }

    /// The sprite of the shadow on a surface beneath a point, clipped at the surface's edge on the screen.
    pub(crate) fn sprite(
        &self,
        simulator: &TwoHalfPhysicsSimulator,
        surface: &Surface,
        edge: Option<Vec<Point>>,
        point: Vector3,
        lowest: Option<f32>,
    ) -> Sprite {
        let below = to_screen(simulator, Vector3::new(point.x, surface.height, point.z));
        let reference = self.texture.width() as f32 * self.scale[0].abs();
        let size = lowest.map_or(1.0, |lowest| shadow_scale(lowest - surface.height, reference));
        let slant = slopes(simulator, surface);
        let to_canvas = Transform::slant(slant).then(&Transform::translation(below));
        Sprite {
            scale: self.scale.map(|factor| factor * size),
            slant,
            clip: edge,
            tint: self.color_tint,
            layer_depth: self.layer_depth,
            ..Sprite::centered(self.texture, to_canvas.apply(self.position_offset))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_is_one_at_and_below_the_ground() {
        assert_eq!(shadow_scale(0.0, 50.0), 1.0);
        assert_eq!(shadow_scale(-3.0, 50.0), 1.0);
    }

    #[test]
    fn the_scale_falls_with_every_pixel_of_height_and_stays_above_its_limit() {
        let scales: Vec<f32> = (0..2000).map(|height| shadow_scale(height as f32, 80.0)).collect();
        assert!(scales.windows(2).all(|pair| pair[1] < pair[0]));
        assert!(scales.iter().all(|&scale| scale > SHADOW_SCALE_LIMIT));
    }

    #[test]
    fn bad_heights_and_references_give_no_shadow() {
        for (height, reference) in
            [(f32::NAN, 1.0), (f32::INFINITY, 1.0), (1.0, 0.0), (1.0, -5.0), (1.0, f32::NAN)]
        {
            assert_eq!(shadow_scale(height, reference), 0.0, "({height}, {reference})");
        }
    }
}
