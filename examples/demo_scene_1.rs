//! Demo Scene 1 of the thesis (4.1), both ways: objects that fall on a floor in 2D with Farseer's engine, and on
//! a ground with depth, each with its shadow, in 2.5D.
//!
//! `cargo run --release --example demo_scene_1` writes an animation and a page of stills of each.

use std::path::{Path, PathBuf};

use examples::{Look, Recorder, Result, Summary, palette};
use farseer_core::math::Vector2;
use farseer_core::{BodyFactory, BodyId, GeomFactory, GeomPlacement, PhysicsSimulator};
use twohalf::{Drawable, TextureId, TwoHalfPhysicsSimulator, Vector3};
use twohalf_factories::{TwoHalfBodyFactory, TwoHalfGeomFactory};
use twohalf_render::{
    Canvas, Color, DrawBody, GroundBackdrop, SoftwareCanvas, Sprite, SpriteBatch, Texture2D, Transform,
    draw_ground_backdrop,
};

/// Size of the pictures in px.
const SIZE: [u32; 2] = [800, 500];
/// Downward, px/s².
const GRAVITY: f32 = 500.0;
/// Steps per second.
const RATE: u32 = 120;
/// From which height in px on an object counts as being in the air at the end.
const ON_THE_GROUND: f32 = 1.5;
/// Where the pictures go, seen from where the program was started.
const FOLDER: &str = "target/demo_scene_1";

fn main() -> Result<()> {
    let folder = PathBuf::from(FOLDER);
    let plane = film_2d(&folder)?;
    let depth = film_2_5d(&folder)?;
    println!("{plane}\n\n{depth}");
    Ok(())
}

/// What happened, in words.
fn report(title: &str, summary: &Summary, bodies: usize, most_contacts: usize, at_the_end: &str) -> String {
    format!(
        "{title}\n  {} steps of 1/{RATE} s, {bodies} bodies, up to {most_contacts} contact points at a time, \
         {:.1} us per step\n  {at_the_end}\n  animation: {}\n  stills:    {}",
        summary.steps,
        summary.mean_step.as_secs_f64() * 1e6,
        summary.animation.display(),
        summary.contact_sheet.display(),
    )
}

/// A 2D simulator and how its objects look.
struct Plane {
    simulator: PhysicsSimulator,
    looks: Vec<(BodyId, Look)>,
    most_contacts: usize,
}

/// Height of the 2D scene's floor in px.
const FLOOR: f32 = 50.0;

/// Width and height of the walls at both ends of the floor in px.
const WALL: [f32; 2] = [14.0, 300.0];

/// Adds an immovable rectangle.
fn add_wall(simulator: &mut PhysicsSimulator, [x, y]: [f32; 2], [width, height]: [f32; 2]) -> Result<()> {
    let wall = BodyFactory::create_rectangle_body_in(simulator, width, height, 1.0)?;
    simulator[wall].set_is_static(true);
    simulator[wall].set_position(Vector2::new(x, y));
    // The cells of a long thin geom have to be given.
    let placement = GeomPlacement::with_grid_size(5.0);
    let geom = GeomFactory::create_rectangle_geom_in(simulator, wall, width, height, placement)?;
    simulator[geom].set_friction_coefficient(0.5);
    simulator[geom].set_restitution_coefficient(0.5);
    Ok(())
}

/// Circles above a floor.
fn plane() -> Result<Plane> {
    let [width, height] = SIZE.map(|side| side as f32);
    let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, GRAVITY))?;
    add_wall(&mut simulator, [width / 2.0, height - FLOOR / 2.0], [width, FLOOR])?;
    for x in [WALL[0] / 2.0, width - WALL[0] / 2.0] {
        add_wall(&mut simulator, [x, height - FLOOR - WALL[1] / 2.0], WALL)?;
    }
    let mut looks = Vec::new();
    for index in 0..12 {
        let i = index as f32;
        let radius = 22.0 + 7.0 * (i * 1.7).sin();
        let body = BodyFactory::create_circle_body_in(&mut simulator, radius, radius * radius / 500.0)?;
        let geom =
            GeomFactory::create_circle_geom_in(&mut simulator, body, radius, 32, GeomPlacement::default())?;
        simulator[geom].set_friction_coefficient(0.5);
        simulator[geom].set_restitution_coefficient(0.5);
        let column = (index * 5) % 12;
        let x = 110.0 + 52.0 * column as f32 + 9.0 * (i * 2.3).cos();
        simulator[body].set_position(Vector2::new(x, 300.0 - 50.0 * i));
        simulator[body].set_linear_velocity(Vector2::new(40.0 * (i * 1.3).sin(), 0.0));
        looks.push((body, Look::ball(radius, palette(index))?));
    }
    Ok(Plane { simulator, looks, most_contacts: 0 })
}

fn film_2d(folder: &Path) -> Result<String> {
    let mut backdrop = SoftwareCanvas::new(SIZE[0], SIZE[1])?;
    backdrop.clear(Color::rgb(196, 220, 238));
    let [width, height] = SIZE.map(|side| side as f32);
    let identity = Transform::IDENTITY;
    backdrop.fill_rectangle([0.0, height - FLOOR], [width, FLOOR], &identity, Color::rgb(150, 118, 80));
    for x in [0.0, width - WALL[0]] {
        let corner = [x, height - FLOOR - WALL[1]];
        backdrop.fill_rectangle(corner, WALL, &identity, Color::rgb(150, 118, 80));
    }
    backdrop.fill_rectangle([0.0, height - FLOOR], [width, 4.0], &identity, Color::rgb(92, 70, 44));
    let recorder = Recorder {
        name: "demo_scene_1_2d",
        size: SIZE,
        steps_per_second: RATE,
        seconds: 6,
        stills: &[0.0, 0.6, 1.2, 1.8, 3.0, 5.9],
    };
    let mut scene = plane()?;
    let step = |scene: &mut Plane| {
        scene.simulator.update(1.0 / RATE as f32);
        scene.most_contacts = scene.most_contacts.max(scene.simulator.counters().contacts_solved);
    };
    let summary = recorder.film(folder, &mut scene, &backdrop, step, |scene, canvas| {
        let mut batch = SpriteBatch::begin();
        for (body, look) in &scene.looks {
            let body = &scene.simulator[*body];
            let position = [body.position().x, body.position().y];
            let sprite = Sprite::centered(&look.texture, position);
            batch.draw(Sprite { rotation: body.rotation(), ..sprite });
            look.draw_light(&mut batch, position, 0.0);
        }
        batch.end(canvas);
        Ok(())
    })?;
    let bodies = scene.simulator.body_list().len();
    let height = |(body, look): &(BodyId, Look)| {
        let lowest = scene.simulator[*body].position().y + look.texture.height() as f32 / 2.0;
        height - FLOOR - lowest
    };
    let lying = scene.looks.iter().filter(|circle| height(circle).abs() < ON_THE_GROUND).count();
    let end = format!("{lying} of {} circles on the floor at the end", scene.looks.len());
    Ok(report("2D, the Farseer engine:", &summary, bodies, scene.most_contacts, &end))
}

/// A 2.5D simulator and how its objects look.
struct Depth {
    simulator: TwoHalfPhysicsSimulator,
    /// By body slot.
    looks: Vec<Option<Look>>,
    /// By id of the shadow image.
    shadows: Vec<Texture2D>,
    most_contacts: usize,
}

/// Direction of the Z axis in degrees.
const ANGLE: i32 = 62;
/// Z of the horizon.
const HORIZON: f32 = 300.0;

/// Shape, place over the ground and velocity along X, up and along Z of an object.
struct Start {
    shape: Shape,
    place: [f32; 3],
    velocity: [f32; 3],
}

#[derive(Clone, Copy)]
enum Shape {
    Ball { radius: f32 },
    Crate { width: f32, height: f32 },
}

const fn ball(radius: f32, place: [f32; 3], velocity: [f32; 3]) -> Start {
    Start { shape: Shape::Ball { radius }, place, velocity }
}

const fn crate_box(width: f32, height: f32, place: [f32; 3], velocity: [f32; 3]) -> Start {
    Start { shape: Shape::Crate { width, height }, place, velocity }
}

const STARTS: &[Start] = &[
    // A stack of crates far behind, with a ball that falls on its edge.
    crate_box(64.0, 56.0, [70.0, 20.0, 215.0], [0.0; 3]),
    crate_box(56.0, 48.0, [74.0, 130.0, 215.0], [0.0; 3]),
    ball(22.0, [92.0, 330.0, 215.0], [0.0; 3]),
    // Balls at three depths, falling.
    ball(34.0, [150.0, 260.0, 72.0], [0.0; 3]),
    ball(28.0, [330.0, 200.0, 130.0], [15.0, 0.0, 0.0]),
    ball(24.0, [430.0, 320.0, 235.0], [-10.0, 0.0, 0.0]),
    // Two that run into each other at one depth, and one that passes in front of them.
    ball(26.0, [255.0, 0.0, 95.0], [120.0, 160.0, 0.0]),
    ball(26.0, [520.0, 0.0, 95.0], [-120.0, 160.0, 0.0]),
    ball(20.0, [40.0, 30.0, 12.0], [170.0, 140.0, 0.0]),
    // Thrown into the picture and out of it.
    ball(26.0, [580.0, 20.0, 20.0], [-10.0, 300.0, 85.0]),
    ball(24.0, [300.0, 60.0, 270.0], [40.0, 200.0, -70.0]),
    crate_box(44.0, 44.0, [560.0, 0.0, 150.0], [50.0, 240.0, 80.0]),
    // Crates that fall on a corner and on each other.
    crate_box(90.0, 50.0, [620.0, 180.0, 65.0], [0.0; 3]),
    crate_box(50.0, 50.0, [600.0, 330.0, 65.0], [0.0; 3]),
    crate_box(70.0, 44.0, [450.0, 120.0, 170.0], [-25.0, 0.0, 0.0]),
];

fn depth() -> Result<Depth> {
    let gravity = Vector2::new(0.0, GRAVITY);
    let simulator = TwoHalfPhysicsSimulator::with_angle_and_gravity(SIZE[1] as i32, ANGLE, gravity)?;
    let mut scene = Depth { simulator, looks: Vec::new(), shadows: Vec::new(), most_contacts: 0 };
    for (index, start) in STARTS.iter().enumerate() {
        add(&mut scene, index, start)?;
    }
    // Everything enters, nothing moves.
    scene.simulator.update(0.0);
    Ok(scene)
}

fn add(scene: &mut Depth, index: usize, start: &Start) -> Result<()> {
    let simulator = &mut scene.simulator;
    let (body, geom, look, width) = match start.shape {
        Shape::Ball { radius } => {
            let mass = radius * radius / 500.0;
            let body = TwoHalfBodyFactory::create_circle_body(simulator, radius, mass)?;
            let geom = TwoHalfGeomFactory::create_circle_geom(simulator, body, radius, 32)?;
            (body, geom, Look::ball(radius, palette(index))?, 2.0 * radius)
        }
        Shape::Crate { width, height } => {
            let mass = width * height / 1500.0;
            let body = TwoHalfBodyFactory::create_rectangle_body(simulator, width, height, mass)?;
            let geom = TwoHalfGeomFactory::create_rectangle_geom(simulator, body, width, height)?;
            let texture = Texture2D::crate_box(width as u32, height as u32, wood(index))?;
            (body, geom, Look { texture, light: None }, width)
        }
    };
    let is_ball = matches!(start.shape, Shape::Ball { .. });
    let settings = simulator.geom_mut(geom).ok_or("the geom is new")?;
    settings.set_friction_coefficient(0.5);
    settings.set_restitution_coefficient(if is_ball { 0.6 } else { 0.25 });

    let shadow = Texture2D::shadow((1.2 * width) as u32, (0.5 * width) as u32)?;
    let image = TextureId { id: index as u32, width: shadow.width(), height: shadow.height() };
    let mut view = simulator.body_mut(body).ok_or("the body is new")?;
    let mut ground = view.ground_mut();
    ground.set_friction_coefficient(0.5);
    ground.set_restitution_coefficient(if is_ball { 0.6 } else { 0.25 });
    ground.set_object_geom(geom, Some(image))?;
    if !is_ball {
        view.set_rotation(0.5 * (index as f32 * 1.9).sin());
    }
    view.set_position3d(Vector3::from(start.place));
    view.set_linear_velocity(Vector2::new(start.velocity[0], -start.velocity[1]));
    view.set_linear_velocity_z(start.velocity[2]);
    scene.looks.resize(body.slot() + 1, None);
    scene.looks[body.slot()] = Some(look);
    scene.shadows.push(shadow);
    Ok(())
}

/// A colour of wood, by number.
fn wood(index: usize) -> Color {
    const WOODS: [Color; 3] = [Color::rgb(186, 130, 70), Color::rgb(160, 100, 52), Color::rgb(204, 154, 96)];
    WOODS[index % WOODS.len()]
}

fn draw_depth(scene: &Depth, canvas: &mut dyn Canvas) {
    let simulator = &scene.simulator;
    let mut batch = SpriteBatch::begin();
    for drawable in simulator.draw_order() {
        let Drawable::Body(id) = drawable else { continue };
        let Some(body) = simulator.body(id) else { continue };
        if let Some(shadow) =
            body.ground().shadow_image().and_then(|image| scene.shadows.get(image.id as usize))
        {
            simulator.draw_shadow(&mut batch, id, shadow, [0.0; 2], [1.0; 2], Color::WHITE, 1.0, true);
        }
        if let Some(look) = scene.looks.get(id.slot()).and_then(Option::as_ref) {
            simulator.draw_body(&mut batch, id, &look.texture, 0.5);
            let position = body.position();
            look.draw_light(&mut batch, [position.x, position.y], 0.5);
        }
    }
    batch.end(canvas);
}

fn film_2_5d(folder: &Path) -> Result<String> {
    let mut backdrop = SoftwareCanvas::new(SIZE[0], SIZE[1])?;
    draw_ground_backdrop(&mut backdrop, &GroundBackdrop::new(HORIZON, ANGLE as f32))?;
    let recorder = Recorder {
        name: "demo_scene_1_2_5d",
        size: SIZE,
        steps_per_second: RATE,
        seconds: 6,
        stills: &[0.0, 0.5, 1.0, 1.5, 2.5, 5.9],
    };
    let mut scene = depth()?;
    let step = |scene: &mut Depth| {
        scene.simulator.update(1.0 / RATE as f32);
        scene.most_contacts = scene.most_contacts.max(scene.simulator.counters().contacts_solved);
    };
    let summary = recorder.film(folder, &mut scene, &backdrop, step, |scene, canvas| {
        draw_depth(scene, canvas);
        Ok(())
    })?;
    let simulator = &scene.simulator;
    let height = |&id: &BodyId| simulator.body(id).map_or(0.0, |body| body.position3d().y);
    let lying = simulator.body_list().iter().filter(|id| height(id).abs() < ON_THE_GROUND).count();
    let bodies = simulator.body_list().len();
    let end = format!("{lying} of {bodies} objects on the ground at the end, others on top of these");
    Ok(report("2.5D:", &summary, bodies, scene.most_contacts, &end))
}
