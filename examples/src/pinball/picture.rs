//! The look of the table, and a script that plays.

use farseer_core::BodyId;
use twohalf_render::{Canvas, Color, Transform, draw_text};

use super::{BALL, FLIPPER, Pinball, Side, TABLE, Thing};
use crate::Result;

/// Colour of the background.
pub const FELT: Color = Color::rgb(24, 52, 66);
const WOOD: Color = Color::rgb(150, 104, 62);
const RAIL: Color = Color::rgba(210, 226, 236, 200);

/// Launches, and raises a flipper while the ball is over it and moves down.
///
/// # Errors
/// None.
pub fn play(table: &mut Pinball) -> Result<()> {
    if table.is_waiting() {
        table.launch();
    }
    let ball = &table.simulator()[table.ball()];
    let (place, falls) = (ball.position(), ball.linear_velocity().y > -200.0);
    let is_due =
        |from: f32, to: f32| falls && (590.0..640.0).contains(&place.y) && (from..to).contains(&place.x);
    let (left, right) = (is_due(148.0, 192.0), is_due(200.0, 244.0));
    table.flip(Side::Left, left)?;
    table.flip(Side::Right, right)?;
    table.step();
    Ok(())
}

/// Draws a table on a canvas that is as large as [`TABLE`] and filled with [`FELT`].
pub fn draw(table: &Pinball, canvas: &mut dyn Canvas) {
    let simulator = table.simulator();
    let place = |body: BodyId| {
        let body = &simulator[body];
        Transform::rotation(body.rotation()).then(&Transform::translation(body.position().into()))
    };
    for (geom, &thing) in table.game().things.iter() {
        let Some(body) = simulator.body_of(geom) else { continue };
        match thing {
            Thing::Wall { size, is_above } => {
                bar(canvas, size, &place(body), if is_above { RAIL } else { WOOD })
            }
            Thing::Bumper { radius } => {
                disc(canvas, radius, &place(body), Color::rgb(206, 70, 60));
                disc(canvas, 0.6 * radius, &place(body), Color::rgb(250, 226, 150));
            }
            Thing::Light { is_on } => {
                disc(
                    canvas,
                    12.0,
                    &place(body),
                    if is_on { Color::rgb(255, 214, 90) } else { Color::rgb(70, 96, 110) },
                );
            }
        }
    }
    for flipper in table.flippers() {
        bar(canvas, FLIPPER, &place(flipper), Color::rgb(238, 150, 60));
    }
    disc(canvas, BALL, &place(table.ball()), Color::rgb(226, 230, 236));
    let text = format!("{:06}", table.game().score);
    draw_text(canvas, &text, [150.0, TABLE[1] - 34.0], 3, Color::WHITE);
}

fn bar(canvas: &mut dyn Canvas, [width, height]: [f32; 2], place: &Transform, color: Color) {
    canvas.fill_rectangle([-0.5 * width, -0.5 * height], [width, height], place, color);
}

fn disc(canvas: &mut dyn Canvas, radius: f32, place: &Transform, color: Color) {
    canvas.fill_ellipse([0.0; 2], [radius; 2], place, color);
}
