//! What the street looks like: all pictures are painted here.

use twohalf::{Drawable, PlatformId};
use twohalf_render::*;

use super::game::*;
use crate::Result;

/// Width and height of the picture in px.
pub const SIZE: [u32; 2] = [720, 480];
const ZOOM: f32 = 1.25;
/// From the lower edge to where the city begins.
const HORIZON: f32 = 190.0;
const COAT: Color = Color::rgb(46, 120, 214);
const THUGS: [Color; 3] = [Color::rgb(196, 60, 48), Color::rgb(122, 74, 160), Color::rgb(60, 132, 84)];
const AMBER: Color = Color::rgb(232, 168, 40);
const WOOD: Color = Color::rgb(176, 118, 64);
const STEEL: Color = Color::rgb(92, 98, 112);
const INK: Color = Color::rgb(30, 22, 34);

/// The pictures of the game.
#[derive(Debug, Clone)]
pub struct Paint {
    shadow: Texture2D,
    city: Texture2D,
    crate_box: Textures,
    street: Textures,
    wall: Textures,
}

impl Paint {
    /// Paints them.
    ///
    /// # Errors
    /// None with these sizes.
    pub fn new() -> Result<Self> {
        let slabs = Texture2D::paving([40, 28], [6, 5], Color::rgb(150, 146, 150))?;
        let kerb = Texture2D::paving([60, 20], [4, 7], Color::rgb(112, 106, 112))?;
        let bricks = Texture2D::bricks([22, 11], [12, 8], Color::rgb(142, 82, 66))?;
        Ok(Paint {
            shadow: Scene::soft_shadow(),
            city: city()?,
            crate_box: Textures { front: Some(Texture2D::crate_box(30, 30, WOOD)?), top: None },
            street: Textures { top: Some(slabs), front: Some(kerb) },
            wall: Textures { top: None, front: Some(bricks) },
        })
    }

    /// What follows the player: from the simulator's px to those of the picture.
    pub fn camera(game: &Brawler) -> Transform {
        let [width, height] = SIZE.map(|side| side as f32);
        let x = game.player().x.clamp(0.3 * width, 1860.0) + 60.0;
        let y = HEIGHT as f32 + 6.0 - 0.5 * height / ZOOM - 0.5 * (game.floor - STREET);
        Transform::camera([x, y], ZOOM, 0.0, [0.5 * width, 0.5 * height])
    }

    /// Draws the street about the player on a canvas of [`SIZE`].
    ///
    /// # Errors
    /// None.
    pub fn draw(&self, game: &Brawler, canvas: &mut dyn Canvas) -> Result<()> {
        let camera = Paint::camera(game);
        let mut view = View::new(canvas).camera(&camera);
        let dusk = GroundBackdrop {
            sky_top: Color::rgb(58, 52, 110),
            sky_horizon: Color::rgb(250, 168, 110),
            floor_near: Color::rgb(70, 62, 70),
            ..GroundBackdrop::new(HORIZON, ANGLE as f32)
        };
        draw_ground_backdrop(&mut view, &dusk)?;
        let top = HEIGHT as f32 - HORIZON - self.city.height() as f32;
        draw_parallax_layer(&mut view, &self.city, top, 0.35);
        let (holes, waters) = ([Patch::hole(HOLE, LANE)], [Water::new(game.water)]);
        let scene = Scene::new(&game.simulator, &self.shadow).camera(&camera).patches(&holes).waters(&waters);
        scene.draw(canvas, |thing| self.look(game, thing));
        for (place, left) in &game.blows {
            let [x, y] = camera.apply(game.simulator.projection().to_screen(*place).into());
            draw_blow(canvas, [x, y - 40.0 * (0.3 - left)]);
        }
        let [text, width] = [format!("{:06}", game.score), "#".repeat(game.fighters[0].health as usize)];
        for (offset, tone) in [(2.0, INK), (0.0, Color::WHITE)] {
            draw_text(canvas, &text, [SIZE[0] as f32 - 120.0 + offset, 16.0 + offset], 2, tone);
        }
        for (offset, tone) in [(2.0, INK), (0.0, Color::rgb(255, 92, 84))] {
            draw_text(canvas, &width, [16.0 + offset, 16.0 + offset], 2, tone);
        }
        Ok(())
    }

    fn look(&self, game: &Brawler, thing: Drawable) -> Look {
        match thing {
            Drawable::Platform(id) => self.look_of_platform(game, id),
            Drawable::Body(body) => {
                if let Some(at) = game.fighters.iter().position(|fighter| fighter.thing.body == body) {
                    return Look::Figure(figure(game, at));
                }
                if let Some(bead) = game.rope.bodies.windows(2).find(|pair| pair[0] == body) {
                    return Look::Line { to: bead[1], color: Color::rgb(206, 176, 120), width: 3.0 };
                }
                match game.loads.iter().position(|load| load.thing.body == body) {
                    Some(0) => Look::Ball(STEEL),
                    Some(at) if game.loads[at].is_ball => Look::Ball(AMBER),
                    _ => Look::Textured(PlatformLook::new(WOOD), self.crate_box.clone()),
                }
            }
        }
    }

    fn look_of_platform(&self, game: &Brawler, id: PlatformId) -> Look {
        let depth = game.simulator.platform(id).map_or(0.0, |platform| platform.depth());
        match id {
            id if game.walls.contains(&id) => Look::Nothing,
            id if id == game.lift => Look::Solid(PlatformLook::new(AMBER)),
            id if id == game.press => Look::Solid(PlatformLook::new(STEEL)),
            id if game.door.posts().contains(&id) => {
                Look::Solid(PlatformLook { edge_width: 0.0, ..PlatformLook::new(WOOD.darker(0.25)) })
            }
            _ if depth < 20.0 => Look::Textured(PlatformLook::new(WOOD.darker(0.4)), self.wall.clone()),
            _ => Look::Textured(PlatformLook::new(STEEL), self.street.clone()),
        }
    }
}

fn figure(game: &Brawler, at: usize) -> Figure {
    let Fighter { looks_left, stride, reels, rests, health, ref walker, .. } = game.fighters[at];
    let color = if at == 0 { COAT } else { THUGS[health as usize % 3] };
    let pose = match () {
        _ if reels > 0.0 && health == 0 => Pose::Lies,
        _ if reels > 0.0 => Pose::Reels,
        _ if rests > if at == 0 { 0.12 } else { 0.7 } => Pose::Strikes,
        _ if at == 0 && game.held.is_some() => Pose::Lifts,
        _ if !walker.is_grounded() => Pose::Jumps,
        _ => Pose::Walks,
    };
    Figure { looks_left, stride, pose, ..Figure::new(color) }
}

/// A star with a word on it.
fn draw_blow(canvas: &mut dyn Canvas, center: Point) {
    for (size, color) in [(1.0, INK), (0.9, AMBER), (0.6, Color::rgb(255, 240, 150))] {
        let corner = |at: usize| {
            let (angle, far) =
                (std::f32::consts::TAU * at as f32 / 20.0, if at % 2 == 0 { 38.0 } else { 22.0 });
            [center[0] + 1.3 * size * far * angle.cos(), center[1] + 0.8 * size * far * angle.sin()]
        };
        let star: Vec<Point> = (0..20).map(corner).collect();
        canvas.fill_polygon(&star, &Transform::IDENTITY, color);
    }
    Text { scale: [2.0; 2], color: Color::rgb(190, 40, 30), ..Text::centered("POW", center) }.draw(canvas);
}

/// Houses before the evening sky, some windows lit; it can be repeated.
fn city() -> Result<Texture2D> {
    let mut canvas = SoftwareCanvas::new(640, 150)?;
    let mut fill = |[x, y]: Point, [width, height]: Point, color: Color| {
        let corners = [[x, y], [x + width, y], [x + width, y + height], [x, y + height]];
        canvas.fill_polygon(&corners, &Transform::IDENTITY, color);
    };
    for (row, color) in [Color::rgb(112, 84, 124), Color::rgb(64, 50, 84)].into_iter().enumerate() {
        for house in 0..8 {
            let random = (house * 7919 + row * 104_729 + 37) * 2_654_435_761 % 4096;
            let (left, top) = ((house * 80 + row * 36 % 80) as f32, (20 + 45 * row + random % 60) as f32);
            fill([left, top], [66.0, 150.0], color);
            for window in 0..24 {
                let at = [left + 8.0 + (window % 4 * 14) as f32, top + 8.0 + (window / 4 * 16) as f32];
                let is_lit = random >> (window % 12) & 1 == 1 && row == 1;
                fill(at, [7.0, 9.0], if is_lit { Color::rgb(255, 206, 120) } else { color.darker(0.25) });
            }
        }
    }
    Ok(canvas.to_texture()?)
}
