//! The look of the street: all pictures are painted here.

use twohalf::{BodyId, DepthProfile, Drawable};
use twohalf_factories::Actor;
use twohalf_render::*;

use super::game::*;
use crate::Result;
use crate::scenery::{city_at_dusk, draw_burst, sky_at_dusk};

/// Width and height of the picture in px.
pub const SIZE: [u32; 2] = [720, 480];
const ZOOM: f32 = 1.2;
/// Lower edge of the city in px of the picture, and the fraction of the camera's motion that it follows.
const HORIZON: f32 = 245.0;
const FAR: f32 = 0.35;
const COAT: Color = Color::rgb(46, 120, 214);
const THUGS: [Color; 3] = [Color::rgb(196, 60, 48), Color::rgb(122, 74, 160), Color::rgb(60, 132, 84)];
const AMBER: Color = Color::rgb(232, 168, 40);
const WOOD: Color = Color::rgb(176, 118, 64);
const STEEL: Color = Color::rgb(92, 98, 112);

/// The pictures of the game.
#[derive(Debug, Clone)]
pub struct Paint {
    shadow: Texture2D,
    sky: Texture2D,
    city: Texture2D,
    crate_box: Textures,
    street: Textures,
    wall: Textures,
    machine: Textures,
}

impl Paint {
    /// Paints them. None of these sizes is refused.
    pub fn new() -> Result<Self> {
        let slabs = Texture2D::paving([40, 28], [6, 5], Color::rgb(150, 146, 150))?;
        let kerb = Texture2D::paving([60, 20], [4, 7], Color::rgb(112, 106, 112))?;
        let bricks = Texture2D::bricks([22, 11], [12, 8], Color::rgb(142, 82, 66))?;
        let plates = Texture2D::paving([30, 14], [3, 10], AMBER)?;
        Ok(Paint {
            shadow: Scene::soft_shadow(),
            sky: sky_at_dusk(SIZE, 235.0)?,
            city: city_at_dusk(ZOOM)?,
            crate_box: Textures { front: Some(Texture2D::crate_box(30, 30, WOOD)?), top: None },
            street: Textures { top: Some(slabs), front: Some(kerb) },
            wall: Textures { top: None, front: Some(bricks) },
            machine: Textures { top: Some(plates.clone()), front: Some(plates) },
        })
    }

    /// The camera, which follows the player: from the simulator's px to those of the picture.
    pub fn camera(game: &Brawler) -> Transform {
        let [x, y] = [game.player().x.clamp(216.0, 1860.0) + 60.0, HEIGHT as f32 - 194.0];
        Transform::camera([x, y], ZOOM, 0.0, SIZE.map(|side| 0.5 * side as f32))
    }

    /// Draws the street about the player on a canvas of [`SIZE`]; the renderer refuses none of it.
    pub fn draw(&self, game: &Brawler, canvas: &mut dyn Canvas) -> Result<()> {
        let camera = Paint::camera(game);
        canvas.draw_texture(&self.sky, &Transform::IDENTITY, Color::WHITE, None);
        // It has its final size, and moves by integer px, so that it is never resampled.
        let passed = Transform::translation([(FAR * camera.translation[0]).round(), 0.0]);
        let mut view = View::new(canvas).camera(&passed);
        draw_parallax_layer(&mut view, &self.city, HORIZON - self.city.height() as f32, 1.0);
        let (holes, waters) = ([Patch::hole(HOLE, LANE)], Water::all_of(&game.simulator));
        let scene = Scene::new(&game.simulator, &self.shadow).camera(&camera).patches(&holes).waters(&waters);
        scene.draw(canvas, |thing| self.look(game, thing));
        for (place, at) in game.state.blows.iter().filter(|(_, at)| game.state.time - at < 0.3) {
            let [x, y] = camera.apply(game.simulator.projection().to_screen(*place).into());
            draw_burst(canvas, [x, y - 40.0 * (game.state.time - at)], "POW");
        }
        let health = "#".repeat(game.fighters[0].health as usize);
        draw_text(canvas, &health, [16.0, 16.0], 2, Color::rgb(255, 112, 100));
        draw_text(canvas, &format!("{:06}", game.state.score), [600.0, 16.0], 2, Color::WHITE);
        Ok(())
    }

    fn look(&self, game: &Brawler, thing: Drawable) -> Look {
        match thing {
            Drawable::Platform(id) if game.walls.contains(&id) => Look::Nothing,
            Drawable::Platform(id) if id == game.lift || id == game.press => {
                Look::Textured(PlatformLook::new(AMBER), self.machine.clone())
            }
            Drawable::Platform(id) if id == game.door.platform() => {
                Look::Solid(PlatformLook::new(WOOD.darker(0.25)))
            }
            Drawable::Platform(id) if game.simulator.platform(id).is_some_and(|it| it.depth() < 20.0) => {
                Look::Textured(PlatformLook::new(WOOD.darker(0.4)), self.wall.clone())
            }
            Drawable::Platform(_) => Look::Textured(PlatformLook::new(STEEL), self.street.clone()),
            Drawable::Body(body) => self.look_of_body(game, body),
        }
    }

    fn look_of_body(&self, game: &Brawler, body: BodyId) -> Look {
        if let Some(at) = game.fighters.iter().position(|fighter| fighter.actor.thing.body == body) {
            return Look::Figure(figure(game, at));
        }
        if let Some(bead) = game.rope.bodies.windows(2).find(|pair| pair[0] == body) {
            return Look::Line { to: bead[1], color: Color::rgb(206, 176, 120), width: 3.0 };
        }
        let geom = game.simulator.core().geoms_of(body).first();
        match geom.and_then(|&geom| game.simulator.depth_profile(geom)) {
            _ if body == game.loads[0].body => Look::Ball(STEEL),
            Some(DepthProfile::Round { .. }) => Look::Ball(AMBER),
            _ => Look::Textured(PlatformLook::new(WOOD), self.crate_box.clone()),
        }
    }
}

fn figure(game: &Brawler, at: usize) -> Figure {
    let Fighter { actor: Actor { looks_left, stride, stunned, rests, walker, .. }, health } =
        game.fighters[at];
    let color = if at == 0 { COAT } else { THUGS[health as usize % 3] };
    let pose = match () {
        _ if stunned > 0.0 && health == 0 => Pose::Lies,
        _ if stunned > 0.0 => Pose::Reels,
        _ if rests > if at == 0 { 0.12 } else { 0.7 } => Pose::Strikes,
        _ if at == 0 && game.state.hands.held().is_some() => Pose::Lifts,
        _ if !walker.is_grounded() => Pose::Jumps,
        _ => Pose::Walks,
    };
    Figure { looks_left, stride, pose, ..Figure::new(color) }
}
