//! A 2D game of `farseer-core` drawn with this crate alone, without a window: things made from pictures fall on a
//! floor; two players see it through cameras of their own, one with the debug view over it.
//!
//! `cargo run --release -p twohalf-render --example plane_game` writes `target/plane_game.png`.

use twohalf::farseer_core::math::Vector2;
use twohalf::farseer_core::{
    BodyFactory, GeomFactory, GeomPlacement, PhysicsSimulator, PhysicsSimulatorView,
};
use twohalf_render::*;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

const SIZE: [u32; 2] = [720, 480];
const FLOOR: [f32; 2] = [1000.0, 40.0];

fn main() -> Result<()> {
    let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 300.0))?;
    add_floor(&mut simulator)?;
    let things = add_things(&mut simulator)?;
    (0..400).for_each(|_| simulator.update(0.01));

    let mut canvas = SoftwareCanvas::new(SIZE[0], SIZE[1])?;
    let [left, right] = [Rectangle::new(0, 0, 358, 480), Rectangle::new(362, 0, 358, 480)];
    let far = Transform::camera([500.0, 330.0], 0.7, 0.0, [179.0, 240.0]);
    draw(&mut View::new(&mut canvas).clip(left), &far, &simulator, &things);
    let near = Transform::camera([430.0, 430.0], 2.0, -0.15, [541.0, 280.0]);
    draw(&mut View::new(&mut canvas).clip(right), &near, &simulator, &things);
    let lines = PhysicsSimulatorView {
        enable_edge_view: true,
        enable_performance_panel_view: false,
        ..PhysicsSimulatorView::default()
    };
    draw_debug_view(&lines, &simulator, &mut View::new(&mut canvas).clip(right).camera(&near));
    canvas.save_png("target/plane_game.png")?;
    println!("target/plane_game.png");
    Ok(())
}

fn add_floor(simulator: &mut PhysicsSimulator) -> Result<()> {
    let [width, height] = FLOOR;
    let floor = BodyFactory::create_rectangle_body_in(simulator, width, height, 1.0)?;
    let placement = GeomPlacement::with_grid_size(5.0);
    GeomFactory::create_rectangle_geom_in(simulator, floor, width, height, placement)?;
    simulator[floor].set_is_static(true);
    simulator[floor].set_position(Vector2::new(500.0, 520.0));
    Ok(())
}

/// Balls, crates, and arrows drawn by code: outlines, masses and bodies come from the pictures.
fn add_things(simulator: &mut PhysicsSimulator) -> Result<Vec<PictureBody>> {
    let pictures = [
        Texture2D::ball(44, Color::rgb(210, 60, 50))?,
        Texture2D::crate_box(48, 48, Color::rgb(176, 124, 66))?,
        arrow()?,
    ];
    let mut things = Vec::new();
    for index in 0u8..15 {
        let picture = &pictures[usize::from(index % 3)];
        let thing = PictureBody::create_in(simulator, picture, 1.0, &Tracing::default())?;
        let [column, row] = [f32::from(index % 5), f32::from(index / 5)];
        simulator[thing.body].set_position(Vector2::new(340.0 + 75.0 * column, 380.0 - 90.0 * row));
        simulator[thing.body].set_rotation(0.3 * f32::from(index));
        things.push(thing);
    }
    Ok(things)
}

/// A picture with a concave outline.
fn arrow() -> Result<Texture2D> {
    let mut canvas = SoftwareCanvas::new(64, 48)?;
    let corners =
        [[2.0, 16.0], [34.0, 16.0], [34.0, 3.0], [62.0, 24.0], [34.0, 45.0], [34.0, 32.0], [2.0, 32.0]];
    canvas.fill_polygon(&corners, &Transform::IDENTITY, Color::rgb(60, 120, 200));
    Ok(canvas.to_texture()?)
}

fn draw(view: &mut View<'_>, camera: &Transform, simulator: &PhysicsSimulator, things: &[PictureBody]) {
    view.clear(Color::rgb(198, 220, 236));
    let mut batch = SpriteBatch::begin_with(camera);
    let [left, right, top] = [0.0, FLOOR[0], 500.0];
    let floor = [[left, top], [right, top], [right, top + FLOOR[1]], [left, top + FLOOR[1]]];
    batch.draw(Sprite { layer_depth: 1.0, ..Sprite::polygon(floor, Color::rgb(120, 96, 70)) });
    for thing in things {
        let body = &simulator[thing.body];
        batch.draw(Sprite { layer_depth: 0.5, ..thing.sprite(body.position(), body.rotation()) });
    }
    let sign = Text::centered("PLANE", [500.0, 200.0]);
    batch.draw_string(Text { rotation: -0.2, scale: [5.0, 5.0], color: Color::rgb(40, 60, 90), ..sign });
    batch.end(view);
}
