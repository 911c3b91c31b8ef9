//! Patches of the ground: holes, water, paths. They are only drawn; the engine does not know them.

use twohalf::{TwoHalfPhysicsSimulator, Vector3};

use crate::clip::clip_to_convex;
use crate::surface::to_screen;
use crate::{Canvas, Color, Point, Transform};

/// A rectangle of the ground that looks different, in px of the world: X to the right, Z into the picture. It
/// is only drawn: the game decides about bodies that fall into it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patch {
    /// Least and greatest X, px.
    pub x: [f32; 2],
    /// Least and greatest Z, px.
    pub z: [f32; 2],
    /// Colour of the patch; of a hole, the colour of its bottom.
    pub color: Color,
    /// Depth of its bottom below the ground, px. At 0 or less it is flat.
    pub depth: f32,
    /// Colour of the wall at the back of a patch with a depth, and of the line around a flat patch.
    pub edge: Color,
}

impl Patch {
    /// A hole so deep that its bottom is not seen.
    pub const fn hole(x: [f32; 2], z: [f32; 2]) -> Self {
        let (color, edge) = (Color::rgb(20, 16, 18), Color::rgb(84, 62, 46));
        Patch { x, z, color, depth: 0.6 * (z[1] - z[0]), edge }
    }

    /// A pond, through which the ground is seen.
    pub const fn water(x: [f32; 2], z: [f32; 2]) -> Self {
        let (color, edge) = (Color::rgba(40, 110, 190, 150), Color::rgba(220, 240, 255, 200));
        Patch { x, z, color, depth: 0.0, edge }
    }

    pub(super) fn draw(&self, simulator: &TwoHalfPhysicsSimulator, canvas: &mut dyn Canvas) {
        let ([left, right], [front, back]) = (self.x, self.z);
        let at = |x: f32, y: f32, z: f32| to_screen(simulator, Vector3::new(x, y, z));
        let opening: [Point; 4] =
            [at(left, 0.0, back), at(right, 0.0, back), at(right, 0.0, front), at(left, 0.0, front)];
        canvas.fill_polygon(&opening, &Transform::IDENTITY, self.color);
        if self.depth > 0.0 {
            let below = -self.depth;
            let walls = [
                ([at(left, below, back), at(left, below, front), opening[3], opening[0]], 0.35),
                ([at(right, below, back), at(right, below, front), opening[2], opening[1]], 0.35),
                ([opening[0], opening[1], at(right, below, back), at(left, below, back)], 0.0),
            ];
            for (wall, shade) in walls {
                let seen = clip_to_convex(&wall, &opening);
                canvas.fill_polygon(&seen, &Transform::IDENTITY, self.edge.darker(shade));
            }
        } else {
            canvas.stroke_polyline(&opening, true, 1.5, &Transform::IDENTITY, self.edge);
        }
    }
}
