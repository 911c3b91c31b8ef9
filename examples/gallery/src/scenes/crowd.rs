//! Thousands of balls and crates in 2.5D: they fall on a field with platforms and between walls, roll, and fall asleep.

use std::cell::RefCell;

use conformance::scenes::vary;
use examples::{Result, palette, wood};
use twohalf::{BodyId, DrawOrder, Drawable, Platform, PlatformId, TwoHalfPhysicsSimulator, Vector2, Vector3};
use twohalf_factories::{Ball, Prism, spawn, spawn_lane};
use twohalf_render::{
    Canvas, Color, DrawPlatform, PlatformLook, Point, Sprite, SpriteBatch, Texture2D, Transform, View,
};

use crate::play::{Play, Player, Set, World, WorldMut};

const RATE: u32 = 60;
/// Direction of the Z axis in degrees.
const ANGLE: i32 = 70;
const RADIUS: f32 = 9.0;
/// Px of the field from one object to the next.
const SPACING: f32 = 26.0;
/// Force per px/s.
const DRAG: f32 = 0.6;
const COLORS: usize = 6;
const GRASS: Color = Color::rgb(92, 138, 84);
const SKY: Color = Color::rgb(30, 40, 52);

/// The field, and the looks of its bodies.
#[derive(Debug, Clone)]
struct Crowd {
    simulator: TwoHalfPhysicsSimulator,
    platforms: Vec<PlatformId>,
    /// By body slot: balls, or crates.
    is_ball: Vec<bool>,
    balls: Vec<Texture2D>,
    crates: Vec<Texture2D>,
    shadow: Texture2D,
    /// Corners of the field on the screen.
    field: [Point; 4],
    size: [f32; 2],
    camera: Transform,
    order: RefCell<DrawOrder>,
}

/// A number of objects over a field.
pub(super) fn crowd(set: Set, count: usize) -> Result<Box<dyn Play>> {
    let columns = (1.8 * count as f32).sqrt().ceil() as usize;
    let rows = count.div_ceil(columns);
    let [wide, deep] = [columns, rows].map(|number| SPACING * (number as f32 + 1.0));
    let gravity = Vector2::new(0.0, 500.0);
    let mut simulator = TwoHalfPhysicsSimulator::with_angle_and_gravity(deep as i32, ANGLE, gravity)?;
    simulator.set_depth_scheme(super::scheme(set))?;
    spawn_lane(&mut simulator, [0.0, wide], [0.0, deep], 2000.0)?;
    let platforms = add_platforms(&mut simulator, wide, deep)?;
    let mut is_ball = Vec::new();
    for index in 0..count {
        let (row, column) = (index / columns, index % columns);
        let aside = [1, 2].map(|sequence| 4.0 * vary(index, sequence));
        let place = [
            SPACING * (column as f32 + 1.0) + aside[0],
            110.0 + 120.0 * (1.0 + vary(index, 3)),
            SPACING * (row as f32 + 1.0) + aside[1],
        ];
        let ball = !index.is_multiple_of(3);
        let thing =
            if ball { Ball::new(RADIUS).restitution(0.5) } else { Prism::new([2.0 * RADIUS; 3]).upright() };
        let body = spawn(&mut simulator, thing.at(place))?.body;
        if let Some(mut body) = simulator.body_mut(body) {
            // Rolling bodies on level ground have no other resistance.
            body.set_linear_drag_coefficient(DRAG);
            body.set_velocity3d(Vector3::new(90.0 * vary(index, 2), 0.0, 90.0 * vary(index, 1)));
        }
        is_ball.resize(is_ball.len().max(body.slot() + 1), false);
        is_ball[body.slot()] = ball;
    }
    simulator.update(0.0);
    let corners = [[0.0, 0.0], [wide, 0.0], [wide, deep], [0.0, deep]];
    let field = corners.map(|[x, z]| simulator.projection().to_screen(Vector3::new(x, 0.0, z)).into());
    let (size, camera) = fit(field);
    let side = 2.0 * RADIUS;
    Ok(Box::new(Crowd {
        simulator,
        platforms,
        is_ball,
        balls: (0..COLORS)
            .map(|at| Texture2D::ball(side as u32, palette(at)))
            .collect::<std::result::Result<_, _>>()?,
        crates: (0..3)
            .map(|at| Texture2D::crate_box(side as u32, side as u32, wood(at)))
            .collect::<std::result::Result<_, _>>()?,
        shadow: Texture2D::shadow(24, 12)?,
        field,
        size,
        camera,
        order: RefCell::default(),
    }))
}

/// Level ones and slopes, spread over the field.
fn add_platforms(simulator: &mut TwoHalfPhysicsSimulator, wide: f32, deep: f32) -> Result<Vec<PlatformId>> {
    let mut platforms = Vec::new();
    for (index, [x, z]) in
        [[0.2, 0.3], [0.5, 0.65], [0.8, 0.35], [0.3, 0.8], [0.75, 0.8]].into_iter().enumerate()
    {
        let size = [0.16 * wide, 16.0, 0.18 * deep];
        let tilt = if index % 2 == 0 { 0.0 } else { 0.25 };
        let place = Vector3::new(x * wide, if tilt == 0.0 { 40.0 } else { 10.0 }, z * deep);
        platforms.push(Platform::with_rotation(simulator, size[0], size[1], size[2], place, tilt, None)?);
    }
    Ok(platforms)
}

/// The picture of a field, with air above it, and its camera.
fn fit(field: [Point; 4]) -> ([f32; 2], Transform) {
    let bound = |axis: usize, pick: fn(f32, f32) -> f32| {
        field.iter().map(|corner| corner[axis]).reduce(pick).unwrap_or(0.0)
    };
    let low = [bound(0, f32::min) - 20.0, bound(1, f32::min) - 200.0];
    let high = [bound(0, f32::max) + 20.0, bound(1, f32::max) + 20.0];
    let [width, height] = [high[0] - low[0], high[1] - low[1]];
    let zoom = 1200.0 / width;
    let size = [1200.0, (zoom * height).round()];
    let middle = [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])];
    (size, Transform::camera(middle, zoom, 0.0, size.map(|side| 0.5 * side)))
}

impl Crowd {
    fn draw_shadows(&self, batch: &mut SpriteBatch) {
        for &id in self.simulator.body_list() {
            let Some(body) = self.simulator.body(id) else { continue };
            let place = body.position3d();
            let ground = self.simulator.projection().to_screen(Vector3::new(place.x, 0.0, place.z));
            let shrink = 1.0 / (1.0 + 0.004 * place.y.max(0.0));
            let on_ground =
                Sprite { scale: [shrink; 2], layer_depth: 1.0, ..Sprite::centered(&self.shadow, ground) };
            batch.draw(on_ground);
        }
    }

    fn draw_body(&self, id: BodyId, layer_depth: f32, batch: &mut SpriteBatch) {
        let Some(body) = self.simulator.body(id) else { return };
        let of = |textures: &[Texture2D]| textures[id.slot() % textures.len()].clone();
        let is_ball = self.is_ball.get(id.slot()).is_some_and(|&ball| ball);
        let texture = if is_ball { of(&self.balls) } else { of(&self.crates) };
        let sprite = Sprite::centered(&texture, body.position());
        batch.draw(Sprite { rotation: body.rotation(), layer_depth, ..sprite });
    }
}

impl Play for Crowd {
    fn size(&self) -> [f32; 2] {
        self.size
    }

    fn rate(&self) -> u32 {
        RATE
    }

    fn step(&mut self, _: Player) -> Result<()> {
        self.simulator.update(1.0 / RATE as f32);
        Ok(())
    }

    fn draw(&self, canvas: &mut dyn Canvas) -> Result<()> {
        canvas.clear(SKY);
        let mut view = View::new(canvas).camera(&self.camera);
        view.fill_polygon(&self.field, &Transform::IDENTITY, GRASS);
        let mut batch = SpriteBatch::begin();
        self.draw_shadows(&mut batch);
        let mut order = self.order.borrow_mut();
        let order = order.sort(&self.simulator);
        let look = PlatformLook::new(Color::rgb(150, 122, 96));
        for (place, thing) in order.iter().enumerate() {
            let layer = 1.0 - (place + 1) as f32 / (order.len() + 1) as f32;
            match *thing {
                Drawable::Body(id) => self.draw_body(id, layer, &mut batch),
                Drawable::Platform(id) if self.platforms.contains(&id) => {
                    self.simulator.draw_platform(&mut batch, id, &look, layer);
                }
                Drawable::Platform(_) => (),
            }
        }
        batch.end(&mut view);
        Ok(())
    }

    fn world(&self) -> World<'_> {
        World::Depth(&self.simulator)
    }

    fn world_mut(&mut self) -> WorldMut<'_> {
        WorldMut::Depth(&mut self.simulator)
    }

    fn camera(&self) -> Transform {
        self.camera
    }

    fn copy(&self) -> Box<dyn Play> {
        Box::new(self.clone())
    }
}
