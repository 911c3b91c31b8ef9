//! Bodies made from pictures.

use twohalf::farseer_core::PhysicsSimulator;
use twohalf::farseer_core::math::Vector2;
use twohalf::{TwoHalfPhysicsSimulator, Vector3};
use twohalf_render::*;

fn ball() -> Texture2D {
    Texture2D::ball(40, Color::rgb(200, 40, 40)).unwrap()
}

#[test]
fn the_outline_of_a_ball_has_the_area_and_the_middle_of_the_ball() {
    let mut simulator = PhysicsSimulator::new(Vector2::zeros()).unwrap();
    let thing = PictureBody::create_in(&mut simulator, &ball(), 2.0, &Tracing::default()).unwrap();
    // Through the middles of the outermost px, at most the tolerance of 1.5 px inside of that.
    let area = simulator.geom(thing.geom).unwrap().world_vertices().get_area();
    let circle = |radius: f32| std::f32::consts::PI * radius * radius;
    assert!((circle(18.0)..circle(20.0)).contains(&area.abs()), "{area}");
    assert!(thing.origin.iter().all(|at| (at - 20.0).abs() < 0.6), "{:?}", thing.origin);
    assert_eq!(simulator[thing.body].mass(), 2.0);
}

#[test]
fn no_edge_of_a_thing_is_longer_than_asked_for() {
    let mut simulator = PhysicsSimulator::new(Vector2::zeros()).unwrap();
    let tracing = Tracing { max_edge_length: Some(3.0), ..Tracing::default() };
    let thing = PictureBody::create_in(&mut simulator, &ball(), 1.0, &tracing).unwrap();
    let corners = simulator.geom(thing.geom).unwrap().world_vertices();
    for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        assert!((b - a).norm() <= 3.001, "{a} {b}");
    }
}

#[test]
fn a_thing_with_depth_stands_on_the_ground_and_is_drawn_where_it_is() {
    let mut simulator = TwoHalfPhysicsSimulator::new(200).unwrap();
    let thing =
        PictureBody::create_in_depth(&mut simulator, &ball(), 1.0, 12.0, &Tracing::default()).unwrap();
    simulator.body_mut(thing.body).unwrap().set_position3d(Vector3::new(100.0, 0.0, 30.0));
    (0..50).for_each(|_| simulator.update(0.01));
    assert_eq!(simulator.depth_interval(thing.geom), Some((24.0, 36.0)));
    let body = simulator.body(thing.body).unwrap();
    assert!(body.is_grounded());
    let mut canvas = SoftwareCanvas::new(200, 200).unwrap();
    let mut batch = SpriteBatch::begin();
    batch.draw(thing.sprite(body.position(), body.rotation()));
    batch.end(&mut canvas);
    // Its lowest px is on the ground, which is 30 px up the screen at this depth.
    let rows = canvas.rgba8().chunks(4 * 200).map(|row| row.iter().any(|&byte| byte > 0)).collect::<Vec<_>>();
    let lowest = rows.iter().rposition(|&is_drawn| is_drawn).unwrap() + 1;
    assert!(lowest.abs_diff(170) <= 2, "{lowest}");
}

#[test]
fn a_refused_thing_leaves_nothing_behind() {
    let clear = Texture2D::from_rgba8(9, 9, vec![0; 9 * 9 * 4]).unwrap();
    let mut simulator = PhysicsSimulator::new(Vector2::zeros()).unwrap();
    let tracing = Tracing::default();
    let bad_grid = Tracing { collision_grid_size: f32::NAN, ..tracing };
    let mut refused = |texture: &Texture2D, mass, tracing| {
        assert!(PictureBody::create_in(&mut simulator, texture, mass, tracing).is_err());
        simulator.update(0.01);
        assert!(simulator.body_list().is_empty());
    };
    refused(&clear, 1.0, &tracing);
    refused(&ball(), -1.0, &tracing);
    refused(&ball(), 1.0, &bad_grid);

    let mut deep = TwoHalfPhysicsSimulator::new(200).unwrap();
    assert!(PictureBody::create_in_depth(&mut deep, &ball(), 1.0, f32::NAN, &tracing).is_err());
    deep.update(0.01);
    assert!(deep.body_list().is_empty());
}
