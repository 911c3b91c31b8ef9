//! What the street looks like.

use twohalf::{Drawable, Vector3};
use twohalf_render::*;

use super::game::*;
use crate::{Result, draw_hills};

/// Width and height of the picture in px.
pub const SIZE: [u32; 2] = [640, 400];
const COAT: Color = Color::rgb(46, 110, 196);
const THUG: Color = Color::rgb(176, 52, 44);
const STONE: Color = Color::rgb(128, 120, 116);
const AMBER: Color = Color::rgb(226, 160, 36);
const WOOD: Color = Color::rgb(182, 128, 70);

/// The pictures of the game.
#[derive(Debug, Clone)]
pub struct Paint {
    shadow: Texture2D,
    crate_box: Texture2D,
}

impl Paint {
    /// Paints them.
    ///
    /// # Errors
    /// None with these sizes.
    pub fn new() -> Result<Self> {
        Ok(Paint { shadow: Scene::soft_shadow(), crate_box: Texture2D::crate_box(30, 30, WOOD)? })
    }

    /// What follows the player: from the simulator's px to those of the picture.
    pub fn camera(game: &Brawler) -> Transform {
        let [width, height] = SIZE.map(|side| side as f32);
        let x = game.player().x.clamp(0.4 * width, 1850.0) + 60.0;
        Transform::camera([x, 0.5 * height], 1.0, 0.0, [0.5 * width, 0.5 * height])
    }

    /// Draws the street about the player on a canvas of [`SIZE`].
    ///
    /// # Errors
    /// None.
    pub fn draw(&self, game: &Brawler, canvas: &mut dyn Canvas) -> Result<()> {
        let camera = Paint::camera(game);
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
