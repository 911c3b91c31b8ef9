//! A small beat-'em-up: walk, jump, punch, lift and throw, over a hole, a belt, a pond and a lift, against thugs who chase.
//!
//! `cargo run --release --example brawler` lets a script play it, and writes an animation and a page of stills.

mod game;

use std::path::Path;

use examples::{Recorder, Result, draw_hills};
use game::*;
use twohalf::{Drawable, Vector3};
use twohalf_render::*;

/// Where the pictures go, seen from where the program was started.
const FOLDER: &str = "target/brawler";
const SIZE: [u32; 2] = [640, 400];
const COAT: Color = Color::rgb(46, 110, 196);
const THUG: Color = Color::rgb(176, 52, 44);
const STONE: Color = Color::rgb(128, 120, 116);
const AMBER: Color = Color::rgb(226, 160, 36);
const WOOD: Color = Color::rgb(182, 128, 70);

fn main() -> Result<()> {
    let mut game = Brawler::new()?;
    let recorder = Recorder {
        name: "brawler",
        size: SIZE,
        shrink: 2,
        steps_per_second: RATE,
        seconds: 42,
        stills: &[1.0, 3.0, 6.2, 11.0, 18.0, 24.0, 34.0, 37.0, 41.0],
    };
    let look = Paint { shadow: Scene::soft_shadow(), crate_box: Texture2D::crate_box(30, 30, WOOD)? };
    let sky = SoftwareCanvas::new(SIZE[0], SIZE[1])?;
    let step = |game: &mut Brawler| game.step(script(game));
    let summary =
        recorder.film(Path::new(FOLDER), &mut game, &sky, step, |game, canvas| look.draw(game, canvas))?;
    println!(
        "{} updates, {:.1} us each; {} points\n  animation: {}\n  stills:    {}",
        summary.steps,
        summary.mean_step.as_secs_f64() * 1e6,
        game.score,
        summary.animation.display(),
        summary.contact_sheet.display(),
    );
    Ok(())
}

/// Somebody who knows the street, and presses the keys.
fn script(game: &Brawler) -> Keys {
    let me = game.player();
    let is_at_edge =
        (HOLE[0] - 14.0..HOLE[0] + 20.0).contains(&me.x) || (POND[0] - 12.0..POND[0]).contains(&me.x);
    let near = |at: Vector3| (at.y - me.y).abs() < 40.0;
    let ahead = game.fighters[1..].iter().map(|thug| (thug.health, game.place(thug.body)));
    let ahead = ahead.filter(|(health, at)| *health > 0 && near(*at) && (at - me).norm() < 240.0);
    let thug = ahead.map(|(_, at)| at).min_by(|a, b| (a - me).norm().total_cmp(&(b - me).norm()));
    if let Some(at) = thug {
        let (way, z) = (at - me, (at.z - me.z).clamp(-20.0, 20.0) / 20.0);
        let throws = game.held.is_some() && way.z.abs() < 14.0;
        let is_close = way.x.abs() < 38.0;
        let x = if is_close { 0.01 * way.x.signum() } else { way.x.signum() };
        return Keys {
            x,
            z,
            grab: throws,
            punch: is_close && way.z.abs() < 14.0,
            jump: is_at_edge && x > 0.0,
        };
    }
    let in_reach = |load: &Load| {
        let way = game.place(load.body) - me;
        (0.0..42.0).contains(&way.x) && way.z.abs() < 20.0 && near(game.place(load.body))
    };
    if game.held.is_none() && me.x < 1000.0 && game.loads.iter().any(in_reach) {
        return Keys { grab: true, ..Keys::default() };
    }
    let waits = (LIFT[0] - 40.0..LIFT[0] - 13.0).contains(&me.x) && game.lift_height() > 12.0
        || (LIFT[0] + 20.0..LIFT[1]).contains(&me.x) && me.y < TERRACE - 6.0;
    Keys { x: f32::from(u8::from(!waits)), z: (80.0 - me.z) / 40.0, jump: is_at_edge, ..Keys::default() }
}

struct Paint {
    shadow: Texture2D,
    crate_box: Texture2D,
}

impl Paint {
    fn draw(&self, game: &Brawler, canvas: &mut dyn Canvas) -> Result<()> {
        let [width, height] = SIZE.map(|side| side as f32);
        let x = game.player().x.clamp(0.4 * width, 1850.0) + 60.0;
        let camera = Transform::camera([x, 0.5 * height], 1.0, 0.0, [0.5 * width, 0.5 * height]);
        let mut view = View::new(canvas).camera(&camera);
        draw_ground_backdrop(&mut view, &GroundBackdrop::new(185.0, ANGLE as f32))?;
        draw_hills(canvas, 185.0);
        let patches = [Patch::hole(HOLE, LANE), Patch::water(POND, LANE)];
        let scene = Scene::new(&game.simulator, &self.shadow).camera(&camera).patches(&patches);
        scene.draw(canvas, |thing| self.look(game, thing));
        let mut view = View::new(canvas).camera(&camera);
        draw_water(game, &mut view);
        for (place, left) in &game.blows {
            let [x, y] = on_screen(game, *place);
            Text {
                scale: [2.0; 2],
                color: Color::rgb(255, 220, 60),
                ..Text::centered("POW!", [x, y - 60.0 * (0.25 - left)])
            }
            .draw(&mut view);
        }
        draw_text(canvas, &format!("SCORE {:05}", game.score), [12.0, 24.0], 2, Color::WHITE);
        draw_text(
            canvas,
            &"+".repeat(game.fighters[0].health as usize),
            [12.0, 46.0],
            2,
            Color::rgb(240, 90, 80),
        );
        Ok(())
    }

    fn look(&self, game: &Brawler, thing: Drawable) -> Look {
        match thing {
            Drawable::Platform(id) if game.walls.contains(&id) => Look::Nothing,
            Drawable::Platform(id) if id == game.lift => Look::Solid(PlatformLook::new(AMBER)),
            Drawable::Platform(id) if id == game.door => Look::Solid(PlatformLook::new(WOOD)),
            Drawable::Platform(_) => Look::Solid(PlatformLook::new(STONE)),
            Drawable::Body(body) => {
                let load = game.loads.iter().find(|load| load.body == body);
                let fighter = game.fighters.iter().position(|fighter| fighter.body == body);
                match (load, fighter) {
                    (Some(load), _) if load.is_ball => Look::Ball(AMBER),
                    (_, Some(at)) => {
                        let Fighter { looks_left, stride, reels, .. } = game.fighters[at];
                        let color = if at == 0 { COAT } else { THUG };
                        let color = if reels > 0.0 { color.lighter(0.6) } else { color };
                        Look::Figure(Figure { looks_left, stride, ..Figure::new(color) })
                    }
                    _ => {
                        let textures = Textures { front: Some(self.crate_box.clone()), top: None };
                        Look::Textured(PlatformLook::new(WOOD), textures)
                    }
                }
            }
        }
    }
}

fn on_screen(game: &Brawler, place: Vector3) -> [f32; 2] {
    let point = game.simulator.projection().to_screen(place);
    [point.x, point.y]
}

/// Its surface and its front, through which what is in it is seen.
fn draw_water(game: &Brawler, canvas: &mut dyn Canvas) {
    let at = |x: f32, y: f32, z: f32| on_screen(game, Vector3::new(x, y, z));
    let ([left, right], [front, back]) = (POND, LANE);
    let top =
        [at(left, WATER, front), at(right, WATER, front), at(right, WATER, back), at(left, WATER, back)];
    let face = [at(left, WATER, front), at(right, WATER, front), at(right, 0.0, front), at(left, 0.0, front)];
    canvas.fill_polygon(&top, &Transform::IDENTITY, Color::rgba(70, 150, 220, 110));
    canvas.fill_polygon(&face, &Transform::IDENTITY, Color::rgba(40, 100, 180, 150));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_script_plays_to_the_end_of_the_street() {
        let mut game = Brawler::new().unwrap();
        for _ in 0..60 * RATE {
            game.step(script(&game)).unwrap();
        }
        assert!(game.fighters.len() == 1 && game.player().x > 1900.0, "{}", game.player());
    }
}
