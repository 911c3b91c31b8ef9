//! What the scenes are put together from. Bodies have no drag unless a scene says so.

use conformance::scene::{
    BodySettings, BodyShape, BodySpec, GeomShape, GeomSpec, Outline, OutlineForm, Scene,
};
use farseer_core::math::Vector2;

/// Gravity in px/s²: 10 m/s² where 32 px are a metre.
pub(super) const GRAVITY: f64 = 320.0;

/// How deep things that rest on each other are put into each other at the start, in px: so that they touch in
/// the first step, and less than every engine leaves alone.
pub(super) const PRESS: f64 = 0.02;

/// An empty scene under gravity.
pub(super) fn scene(name: &str, about: &str) -> Scene {
    let mut scene = weightless(name, about);
    scene.simulator.gravity = Some(Vector2::new(0.0, GRAVITY as f32));
    scene
}

/// An empty scene without gravity.
pub(super) fn weightless(name: &str, about: &str) -> Scene {
    Scene::empty(name, about)
}

/// Adds a body without drag; gives its index.
pub(super) fn body(scene: &mut Scene, shape: BodyShape, position: [f64; 2], rotation: f64) -> usize {
    let settings =
        BodySettings { linear_drag: Some(0.0), rotational_drag: Some(0.0), ..BodySettings::default() };
    scene.bodies.push(BodySpec {
        position: Some(vector(position)),
        rotation: Some(rotation as f32),
        settings,
        ..BodySpec::new(shape)
    });
    scene.bodies.len() - 1
}

/// What a surface is like.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Surface {
    pub friction: f64,
    pub restitution: f64,
}

/// A surface that rubs and does not bounce.
pub(super) fn rough(friction: f64) -> Surface {
    Surface { friction, restitution: 0.0 }
}

/// Adds a geom to the last body.
fn geom(scene: &mut Scene, shape: GeomShape, surface: Surface) {
    let mut geom = GeomSpec::new(scene.bodies.len() - 1, shape);
    geom.settings.friction = Some(surface.friction as f32);
    geom.settings.restitution = Some(surface.restitution as f32);
    scene.geoms.push(geom);
}

/// A rectangle in px and its mass in kg.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slab {
    pub width: f64,
    pub height: f64,
    pub mass: f64,
}

/// Adds a rectangle; gives its index.
pub(super) fn slab(
    scene: &mut Scene,
    size: Slab,
    position: [f64; 2],
    rotation: f64,
    surface: Surface,
) -> usize {
    let [width, height, mass] = [size.width, size.height, size.mass].map(|value| value as f32);
    let index = body(scene, BodyShape::Rectangle { width, height, mass }, position, rotation);
    geom(scene, GeomShape::Rectangle { width, height }, surface);
    index
}

/// Adds a circle of mass `mass`, in the engine of this workspace a polygon of so many edges; gives its index.
pub(super) fn ball(
    scene: &mut Scene,
    radius: f64,
    mass: f64,
    edges: i32,
    position: [f64; 2],
    surface: Surface,
) -> usize {
    let (radius, mass) = (radius as f32, mass as f32);
    let index = body(scene, BodyShape::Circle { radius, mass }, position, 0.0);
    geom(scene, GeomShape::Circle { radius, edges }, surface);
    index
}

/// Adds a regular polygon in every engine, given by the distance of its corners in px and their number, with the mass
/// and inertia of a circle; gives its index.
pub(super) fn wheel(
    scene: &mut Scene,
    (radius, edges): (f64, i32),
    position: [f64; 2],
    rotation: f64,
    surface: Surface,
) -> usize {
    let radius = radius as f32;
    let index = body(scene, BodyShape::Circle { radius, mass: 1.0 }, position, rotation);
    let outline = Outline { form: OutlineForm::Circle { radius, edges }, subdivide: None };
    geom(scene, GeomShape::Polygon { outline }, surface);
    index
}

/// Adds a convex polygon of mass 1, its corners given in the world; gives its index. Its edges are cut into pieces of
/// 10 px, as those of ready-made rectangles are into four: distance grids know a face by its vertices alone.
pub(super) fn stone(scene: &mut Scene, corners: &[[f64; 2]], surface: Surface) -> usize {
    let centre = centroid(corners);
    let points = corners.iter().map(|p| vector([p[0] - centre[0], p[1] - centre[1]])).collect();
    let outline = Outline { form: OutlineForm::Points { points }, subdivide: Some(10.0) };
    let index = body(scene, BodyShape::Polygon { outline: outline.clone(), mass: 1.0 }, centre, 0.0);
    geom(scene, GeomShape::Polygon { outline }, surface);
    index
}

/// Adds a static slab 40 px thick whose upper side goes through the origin at an angle, down to the right; gives
/// its index.
pub(super) fn ground(scene: &mut Scene, length: f64, angle: f64, surface: Surface) -> usize {
    const THICKNESS: f64 = 40.0;
    let centre = on_slope(angle, 0.0, -THICKNESS / 2.0);
    let index = slab(scene, Slab { width: length, height: THICKNESS, mass: 1.0 }, centre, angle, surface);
    scene.bodies[index].is_static = Some(true);
    // Left alone, the grid's cells are made from the box around the turned slab, and come out as coarse as it is thick.
    scene.geoms[index].collision_grid_size = Some(4.0);
    index
}

/// The place that lies so far down a slope through the origin and so far above it.
pub(super) fn on_slope(angle: f64, down: f64, above: f64) -> [f64; 2] {
    let (sine, cosine) = angle.sin_cos();
    [down * cosine + above * sine, down * sine - above * cosine]
}

/// The number of rows of a triangle with 1, 2, 3, ... things in its rows that holds at least so many.
pub(super) fn rows_of_triangle(count: usize) -> usize {
    (1..).find(|rows| rows * (rows + 1) / 2 >= count).unwrap_or(1)
}

fn centroid(corners: &[[f64; 2]]) -> [f64; 2] {
    let (mut sum, mut area) = ([0.0, 0.0], 0.0);
    for (index, a) in corners.iter().enumerate() {
        let b = corners[(index + 1) % corners.len()];
        let cross = a[0] * b[1] - a[1] * b[0];
        area += cross;
        sum = [sum[0] + (a[0] + b[0]) * cross, sum[1] + (a[1] + b[1]) * cross];
    }
    sum.map(|sum| sum / (3.0 * area))
}

pub(super) fn vector(value: [f64; 2]) -> Vector2 {
    Vector2::new(value[0] as f32, value[1] as f32)
}

/// Where a body of a scene starts, in px.
pub(super) fn start(scene: &Scene, index: usize) -> [f64; 2] {
    let position = scene.bodies[index].position.unwrap_or_else(Vector2::zeros);
    [f64::from(position.x), f64::from(position.y)]
}
