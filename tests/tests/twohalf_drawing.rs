//! Bodies and their shadows as sprites.

mod twohalf_common;

use twohalf::{BodyId, TwoHalfPhysicsSimulator, Vector3};
use twohalf_common::{ball, crate_box, weightless};
use twohalf_render::{Canvas, Color, DrawBody, SoftwareCanvas, SpriteBatch, Texture2D, shadow_scale};

/// A texture of one colour.
fn plain(width: u32, height: u32) -> Texture2D {
    Texture2D::from_rgba8(width, height, [255, 0, 0, 255].repeat((width * height) as usize)).unwrap()
}

/// The box around what is drawn: left, top, right, bottom in px.
fn drawn(batch: SpriteBatch) -> Option<[u32; 4]> {
    let mut canvas = SoftwareCanvas::new(400, 600).unwrap();
    canvas.clear(Color::TRANSPARENT);
    batch.end(&mut canvas);
    let is_painted = |x, y| canvas.pixel(x, y).is_some_and(|color| color.a > 127);
    let painted: Vec<(u32, u32)> =
        (0..600).flat_map(|y| (0..400).map(move |x| (x, y))).filter(|&(x, y)| is_painted(x, y)).collect();
    let xs = || painted.iter().map(|p| p.0);
    let ys = || painted.iter().map(|p| p.1);
    Some([xs().min()?, ys().min()?, xs().max()? + 1, ys().max()? + 1])
}

fn shadow(simulator: &TwoHalfPhysicsSimulator, body: BodyId, is_resizable: bool) -> Option<[u32; 4]> {
    let mut batch = SpriteBatch::begin();
    let (offset, scale) = ([0.0, 0.0], [1.0, 1.0]);
    simulator.draw_shadow(&mut batch, body, &plain(40, 40), offset, scale, Color::WHITE, 1.0, is_resizable);
    drawn(batch)
}

/// A simulator at 45 degrees with a ball.
fn scene(place: [f32; 3]) -> (TwoHalfPhysicsSimulator, BodyId) {
    let mut simulator = TwoHalfPhysicsSimulator::with_angle(600, 45).unwrap();
    let body = ball(&mut simulator, 20.0, place);
    (simulator, body)
}

#[test]
fn the_shadow_of_a_resting_ball_lies_about_the_point_where_it_touches() {
    let (simulator, body) = scene([100.0, 0.0, 50.0]);
    assert_eq!(shadow(&simulator, body, true), Some([130, 530, 170, 570]));
}

#[test]
fn the_shadow_of_a_flying_ball_stays_on_the_ground_below_it_and_shrinks_by_the_law() {
    let (simulator, body) = scene([100.0, 40.0, 50.0]);
    // At the height of its own width.
    assert_eq!(shadow_scale(40.0, 40.0), 0.65);
    assert_eq!(shadow(&simulator, body, true), Some([150 - 13, 550 - 13, 150 + 13, 550 + 13]));
}

#[test]
fn a_shadow_that_is_not_resizable_keeps_its_size() {
    let (simulator, body) = scene([100.0, 40.0, 50.0]);
    assert_eq!(shadow(&simulator, body, false), Some([130, 530, 170, 570]));
}

#[test]
fn a_shadow_is_moved_by_its_offset_and_scaled_by_its_scale() {
    let (simulator, body) = scene([100.0, 0.0, 50.0]);
    let mut batch = SpriteBatch::begin();
    let (offset, scale) = ([10.0, -6.0], [2.0, 0.5]);
    simulator.draw_shadow(&mut batch, body, &plain(40, 40), offset, scale, Color::WHITE, 1.0, true);
    assert_eq!(drawn(batch), Some([120, 534, 200, 554]));
}

#[test]
fn a_body_is_drawn_about_its_origin_and_turned_with_it() {
    let mut simulator = weightless();
    let body = crate_box(&mut simulator, [60.0, 20.0], [100.0, 0.0, 0.0]);
    let mut view = simulator.body_mut(body).unwrap();
    view.set_rotation(std::f32::consts::FRAC_PI_2);
    view.set_position3d(Vector3::new(100.0, 0.0, 0.0));
    let mut batch = SpriteBatch::begin();
    simulator.draw_body(&mut batch, body, &plain(60, 20), 0.5);
    assert_eq!(drawn(batch), Some([90, 540, 110, 600]));
}

#[test]
fn a_body_that_is_gone_draws_nothing() {
    let (mut simulator, body) = scene([100.0, 0.0, 50.0]);
    simulator.dispose(body).unwrap();
    simulator.update(0.0);
    let mut batch = SpriteBatch::begin();
    simulator.draw_body(&mut batch, body, &plain(60, 20), 0.5);
    assert_eq!(drawn(batch), None);
    assert_eq!(shadow(&simulator, body, true), None);
}
