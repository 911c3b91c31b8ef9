//! Bodies as sprites.

use crate::canvases::{RED, drawn, plain};
use conformance::fixtures::depth::{crate_box, weightless};
use twohalf::Vector3;
use twohalf_render::{DrawBody, SpriteBatch};

#[test]
fn a_body_is_drawn_about_its_origin_and_turned_with_it() {
    let mut simulator = weightless();
    let body = crate_box(&mut simulator, [60.0, 20.0], [100.0, 0.0, 0.0]);
    let mut view = simulator.body_mut(body).unwrap();
    view.set_rotation(std::f32::consts::FRAC_PI_2);
    view.set_position3d(Vector3::new(100.0, 0.0, 0.0));
    let mut batch = SpriteBatch::begin();
    simulator.draw_body(&mut batch, body, &plain(60, 20, RED), 0.5);
    assert_eq!(drawn(batch), Some([90, 540, 110, 600]));
}

#[test]
fn a_disposed_body_draws_nothing() {
    let mut simulator = weightless();
    let body = crate_box(&mut simulator, [60.0, 20.0], [100.0, 0.0, 0.0]);
    simulator.dispose(body).unwrap();
    simulator.update(0.0);
    let mut batch = SpriteBatch::begin();
    simulator.draw_body(&mut batch, body, &plain(60, 20, RED), 0.5);
    assert_eq!(drawn(batch), None);
}
