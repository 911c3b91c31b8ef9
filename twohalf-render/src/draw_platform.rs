//! Platforms of the 2.5D engine in plain colours, and their shadows.

use twohalf::{PlatformId, TwoHalfPhysicsSimulator, Vector3};

use crate::hidden::{Seen, Within};
use crate::outline_of_line::across;
use crate::shadow::Shadow;
use crate::surface::{Face, to_screen};
use crate::{Color, Point, Sprite, SpriteBatch, TextureStore};

/// Look of a platform in a game without art: a colour for every face, edges drawn after.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlatformLook {
    /// The upper face, when level.
    pub top: Color,
    /// The face towards the viewer.
    pub front: Color,
    /// The faces to the left and to the right.
    pub sides: Color,
    /// The lower face, when level; visible if the platform is tilted far enough.
    pub underside: Color,
    /// The lines between the faces.
    pub edges: Color,
    /// Width of these lines in px; none at 0.
    pub edge_width: f32,
}

impl PlatformLook {
    /// A front of this colour, a lighter top, darker sides, and thin dark edges.
    pub fn new(color: Color) -> Self {
        PlatformLook {
            top: color.lighter(0.35),
            front: color,
            sides: color.darker(0.25),
            underside: color.darker(0.45),
            edges: color.darker(0.6),
            edge_width: 1.5,
        }
    }

    /// Whether all faces are opaque.
    pub(crate) fn is_opaque(&self) -> bool {
        [self.top, self.front, self.sides].iter().all(|color| color.a == u8::MAX)
    }

    fn face(&self, face: Face) -> Color {
        match face {
            Face::Top => self.top,
            Face::Front | Face::Back => self.front,
            Face::Left | Face::Right => self.sides,
            Face::Underside => self.underside,
        }
    }
}

/// Draws platforms of a simulator. A stale platform draws nothing.
pub trait DrawPlatform {
    /// Adds the visible faces of a platform, as far as they are above the ground, Y = 0. The ground hides the
    /// part of a lift in its shaft, or the foot of a slope. `layer_depth`: 0 front to 1 back.
    fn draw_platform(
        &self,
        batch: &mut SpriteBatch,
        platform: PlatformId,
        look: &PlatformLook,
        layer_depth: f32,
    );

    /// Adds the platform's shadow: its shadow image, on the topmost surface (ground or another platform)
    /// beneath the middle of its underside. See [`DrawBody::draw_shadow`](crate::DrawBody::draw_shadow) for
    /// the arguments. Without an image it adds nothing.
    #[expect(clippy::too_many_arguments, reason = "those of a body's shadow")]
    fn draw_platform_shadow(
        &self,
        batch: &mut SpriteBatch,
        textures: &TextureStore,
        platform: PlatformId,
        position_offset: Point,
        scale: Point,
        color_tint: Color,
        layer_depth: f32,
        is_shadow_resizable: bool,
    );
}

impl DrawPlatform for TwoHalfPhysicsSimulator {
    fn draw_platform(
        &self,
        batch: &mut SpriteBatch,
        platform: PlatformId,
        look: &PlatformLook,
        layer_depth: f32,
    ) {
        let Some(platform) = self.platform(platform) else { return };
        draw_faces(self, batch, (&platform.corners(), Within::ALL), look, layer_depth);
    }

    fn draw_platform_shadow(
        &self,
        batch: &mut SpriteBatch,
        textures: &TextureStore,
        platform: PlatformId,
        position_offset: Point,
        scale: Point,
        color_tint: Color,
        layer_depth: f32,
        is_shadow_resizable: bool,
    ) {
        let Some(platform) = self.platform(platform) else { return };
        let Some(texture) = platform.shadow_image().and_then(|image| textures.get(image)) else { return };
        let corners = platform.corners();
        let middle = corners.iter().sum::<Vector3>() / 8.0;
        let lowest = corners.iter().map(|corner| corner.y).fold(f32::INFINITY, f32::min);
        let shadow = Shadow { texture, position_offset, scale, color_tint, layer_depth };
        let point = Vector3::new(middle.x, underside(&corners, middle), middle.z);
        shadow.draw_beneath(self, batch, point, is_shadow_resizable.then_some(lowest));
    }
}

/// Draws the visible faces of a platform with these corners.
pub(crate) fn draw_faces(
    simulator: &TwoHalfPhysicsSimulator,
    batch: &mut SpriteBatch,
    (corners, within): (&[Vector3; 8], Within<'_>),
    look: &PlatformLook,
    layer_depth: f32,
) {
    let on_screen = |point: Vector3| to_screen(simulator, point);
    let faces = Face::ALL.map(|face| (face, face.corners(corners)));
    let visible = faces.into_iter().filter(|(_, corners)| is_clockwise(&corners.map(on_screen)));
    let seen: Vec<(Face, Seen)> = visible.map(|(face, corners)| (face, within.seen(corners))).collect();
    for (face, seen) in &seen {
        for piece in &seen.pieces {
            let outline: Vec<Point> = piece.iter().copied().map(on_screen).collect();
            batch.draw(Sprite { layer_depth, ..Sprite::polygon(outline, look.face(*face)) });
        }
    }
    for [from, to] in seen.iter().flat_map(|(_, seen)| &seen.lines) {
        let line = line(on_screen(*from), on_screen(*to), look.edge_width);
        batch.draw(Sprite { layer_depth, ..Sprite::polygon(line, look.edges) });
    }
}

/// Height at which a line straight down from a point inside leaves a platform, px; at the ground if that is
/// below it.
fn underside(corners: &[Vector3; 8], from: Vector3) -> f32 {
    let height = |face: Face| {
        let [corner, ..] = face.corners(corners);
        let normal = face.normal(corners);
        let to_side = normal.x * (from.x - corner.x) + normal.z * (from.z - corner.z);
        (normal.y < 0.0).then(|| corner.y - to_side / normal.y)
    };
    let lowest = if from.y < 0.0 { f32::NEG_INFINITY } else { 0.0 };
    Face::ALL.into_iter().filter_map(height).fold(lowest, f32::max)
}

fn is_clockwise(&[a, b, c, _]: &[Point; 4]) -> bool {
    (b[0] - a[0]) * (c[1] - a[1]) > (b[1] - a[1]) * (c[0] - a[0])
}

/// The outline of a line of some width.
fn line(a: Point, b: Point, width: f32) -> [Point; 4] {
    // The line is half of its width longer at either end, so that lines meet in corners; without a length it
    // is empty.
    let [x, y] = across(a, b, width);
    [
        [a[0] + y + x, a[1] - x + y],
        [b[0] - y + x, b[1] + x + y],
        [b[0] - y - x, b[1] + x - y],
        [a[0] + y - x, a[1] - x - y],
    ]
}
