//! Fixtures of the tests of drawing. Canvases of 500 x 600 px.

use twohalf::{PlatformId, TwoHalfPhysicsSimulator};
use twohalf_render::{Canvas, Color, DrawPlatform, PlatformLook, SoftwareCanvas, SpriteBatch, Texture2D};

pub(crate) const RED: Color = Color::rgb(255, 0, 0);
pub(crate) const GREEN: Color = Color::rgb(0, 255, 0);
pub(crate) const BLUE: Color = Color::rgb(0, 0, 255);
pub(crate) const YELLOW: Color = Color::rgb(255, 255, 0);
pub(crate) const GRAY: Color = Color::rgb(90, 90, 90);

/// A texture of one colour.
pub(crate) fn plain(width: u32, height: u32, color: Color) -> Texture2D {
    let pixel = [color.r, color.g, color.b, color.a];
    Texture2D::from_rgba8(width, height, pixel.repeat((width * height) as usize)).unwrap()
}

/// A transparent canvas.
pub(crate) fn canvas() -> SoftwareCanvas {
    let mut canvas = SoftwareCanvas::new(500, 600).unwrap();
    canvas.clear(Color::TRANSPARENT);
    canvas
}

/// The picture of a batch.
pub(crate) fn picture(batch: SpriteBatch) -> SoftwareCanvas {
    let mut canvas = canvas();
    batch.end(&mut canvas);
    canvas
}

/// All pixels with their middles.
pub(crate) fn pixels() -> impl Iterator<Item = ([u32; 2], [f32; 2])> {
    let middle = |n: u32| n as f32 + 0.5;
    (0..600).flat_map(move |y| (0..500).map(move |x| ([x, y], [middle(x), middle(y)])))
}

/// Bounds of the drawing: left, top, right, bottom in px.
pub(crate) fn drawn(batch: SpriteBatch) -> Option<[u32; 4]> {
    let canvas = picture(batch);
    let is_painted = |[x, y]: [u32; 2]| canvas.pixel(x, y).is_some_and(|color| color.a > 127);
    let painted: Vec<[u32; 2]> = pixels().map(|(pixel, _)| pixel).filter(|&p| is_painted(p)).collect();
    let xs = || painted.iter().map(|p| p[0]);
    let ys = || painted.iter().map(|p| p[1]);
    Some([xs().min()?, ys().min()?, xs().max()? + 1, ys().max()? + 1])
}

/// Another colour for every face, no edges.
pub(crate) const FACES: PlatformLook = PlatformLook {
    top: GREEN,
    front: BLUE,
    sides: YELLOW,
    underside: GRAY,
    edges: Color::BLACK,
    edge_width: 0.0,
};

/// A platform alone, without edges.
pub(crate) fn platform_picture(simulator: &TwoHalfPhysicsSimulator, id: PlatformId) -> SoftwareCanvas {
    let mut batch = SpriteBatch::begin();
    simulator.draw_platform(&mut batch, id, &FACES, 0.5);
    picture(batch)
}
