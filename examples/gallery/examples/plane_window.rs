//! A game of `farseer-core` in a window: the debug view as lines of macroquad. A click throws a box into the pit.
//!
//! `cargo run --release -p gallery --example plane_window`

use std::time::Duration;

use farseer_core::math::Vector2;
use farseer_core::{
    BodyFactory, BodyId, DebugShape, FixedStepClock, GeomFactory, GeomPlacement, PhysicsSimulator,
    PhysicsSimulatorView, Result,
};
use macroquad::prelude as quad;

#[macroquad::main("farseer-core")]
async fn main() -> Result<()> {
    let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 300.0))?;
    for (size, place) in
        [((760.0, 20.0), (400.0, 580.0)), ((20.0, 400.0), (30.0, 390.0)), ((20.0, 400.0), (770.0, 390.0))]
    {
        let wall = add_box(&mut simulator, size, place)?;
        simulator[wall].set_is_static(true);
    }
    let mut clock = FixedStepClock::default();
    let view = PhysicsSimulatorView { enable_edge_view: true, ..PhysicsSimulatorView::default() };
    loop {
        if quad::is_mouse_button_pressed(quad::MouseButton::Left) {
            add_box(&mut simulator, (32.0, 32.0), quad::mouse_position())?;
        }
        for _ in 0..clock.advance(Duration::from_secs_f32(quad::get_frame_time().max(0.0))) {
            simulator.update(clock.dt());
        }
        quad::clear_background(quad::SKYBLUE);
        view.draw(&simulator, draw);
        quad::next_frame().await;
    }
}

/// Adds a box of a width and a height, with its middle at a position, in px.
fn add_box(simulator: &mut PhysicsSimulator, size: (f32, f32), place: (f32, f32)) -> Result<BodyId> {
    let body = BodyFactory::create_rectangle_body_in(simulator, size.0, size.1, 1.0)?;
    simulator[body].set_position(Vector2::new(place.0, place.1));
    let geom =
        GeomFactory::create_rectangle_geom_in(simulator, body, size.0, size.1, GeomPlacement::default())?;
    simulator[geom].set_friction_coefficient(0.5);
    Ok(body)
}

fn draw(shape: DebugShape) {
    let ink = |[r, g, b, a]: [u8; 4]| quad::Color::from_rgba(r, g, b, a);
    match shape {
        DebugShape::Line { start, end, thickness, color } => {
            quad::draw_line(start.x, start.y, end.x, end.y, thickness, ink(color));
        }
        DebugShape::Circle { center, radius, color } => {
            quad::draw_circle(center.x, center.y, radius, ink(color))
        }
        DebugShape::Rectangle { min, size, color } => {
            quad::draw_rectangle(min.x, min.y, size.x, size.y, ink(color))
        }
        DebugShape::Text { position, text, color } => {
            quad::draw_text(&text, position.x, position.y + 12.0, 16.0, ink(color));
        }
    }
}
