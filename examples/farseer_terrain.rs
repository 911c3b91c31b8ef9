//! Terrain and blots whose outlines are traced from pictures that the program paints when it starts, and balls and crates that
//! fall on them. The last scene is the original's sample with blots that are cut into convex pieces (Advanced 9).
//!
//! `cargo run --release --example farseer_terrain` writes an animation and a page of stills of each; with `-- --debug` the
//! original's debug view is drawn over the pictures.

use std::path::Path;

use conformance::samples::{SCREEN, SampleScene, ball, border, crate_box, ragdoll, sample, splat_outline};
use examples::{Result, SampleFilm, wants_debug_view};
use farseer_core::math::Vector2;
use farseer_core::shape::{PolygonCreationAssistance, Vertices};
use farseer_core::{BodyFactory, GeomFactory, GeomPlacement};
use twohalf_render::{Canvas, Color, Point, SoftwareCanvas, Transform};

/// Folder of the pictures, relative to the working directory.
const FOLDER: &str = "target/farseer_terrain";

/// Edges of the area inside of the border in px: left, right, bottom.
const FREE: [f32; 3] = [38.0, 986.0, 730.0];
const SOIL: Color = Color::rgb(126, 92, 58);
const GRASS: Color = Color::rgb(84, 150, 62);
const TRACE: [u8; 4] = [255, 250, 205, 255];
const BLACK: [u8; 4] = [0, 0, 0, 255];
const CLEAR: [u8; 4] = [0, 0, 0, 0];

fn main() -> Result<()> {
    let wants_debug_view = wants_debug_view()?;
    let folder = Path::new(FOLDER);
    let picture = paint_terrain()?;
    let mut scene = terrain(&picture)?;
    let film = SampleFilm {
        name: "farseer_terrain",
        seconds: 7,
        stills: &[0.0, 0.8, 1.6, 2.4, 3.6, 6.9],
        picture: Some(picture.to_texture()?),
        wants_debug_view,
    };
    println!("{}\n", film.film(folder, "Terrain traced from a picture:", &mut scene)?);

    let mut scene = (sample("Advanced 9").ok_or("there is no such sample")?.build)()?;
    let film = SampleFilm {
        name: "farseer_blots",
        seconds: 5,
        stills: &[0.0, 0.6, 1.2, 1.8, 2.6, 4.9],
        picture: None,
        wants_debug_view,
    };
    println!("{}", film.film(folder, "Advanced 9, Auto-divide geometry with SAT:", &mut scene)?);
    Ok(())
}

/// Height of the hills at an x, as y of the screen.
fn surface(x: f32) -> f32 {
    let t = (x - FREE[0]) / (FREE[1] - FREE[0]);
    600.0 + 70.0 * (7.0 * t + 0.4).cos() - 24.0 * (17.0 * t).sin() + 7.0 * (53.0 * t).sin()
}

/// Hills with a rock in the shape of a mushroom, and an island that floats above them.
fn paint_terrain() -> Result<SoftwareCanvas> {
    let [width, height] = SCREEN.map(|side| side as u32);
    let mut canvas = SoftwareCanvas::new(width, height)?;
    let [left, right, bottom] = FREE;
    let columns = (right - left) as u32 / 2;
    let hills: Vec<Point> = (0..=columns).map(|i| left + 2.0 * i as f32).map(|x| [x, surface(x)]).collect();
    let mut outline = hills.clone();
    outline.extend([[right, bottom], [left, bottom]]);
    canvas.fill_polygon(&outline, &Transform::IDENTITY, SOIL);
    canvas.stroke_polyline(&hills, false, 10.0, &Transform::IDENTITY, GRASS);

    let foot = surface(760.0);
    let stem = [[738.0, foot + 20.0], [744.0, foot - 110.0], [776.0, foot - 110.0], [790.0, foot + 20.0]];
    canvas.fill_polygon(&stem, &Transform::IDENTITY, SOIL.lighter(0.12));
    let cap = Transform::rotation(-0.16).then(&Transform::translation([760.0, foot - 118.0]));
    canvas.fill_ellipse([0.0, 0.0], [96.0, 34.0], &cap, SOIL.darker(0.15));

    let island = Transform::rotation(0.22).then(&Transform::translation([300.0, 330.0]));
    let rock = [
        [-95.0, -8.0],
        [-40.0, -16.0],
        [30.0, -12.0],
        [100.0, -18.0],
        [60.0, 20.0],
        [10.0, 46.0],
        [-50.0, 24.0],
    ];
    canvas.fill_polygon(&rock, &island, SOIL);
    canvas.stroke_polyline(&rock[..4], false, 8.0, &island, GRASS);
    Ok(canvas)
}

/// The outlines of all opaque parts of a picture.
fn trace(picture: &SoftwareCanvas) -> Result<Vec<Vertices>> {
    let mut texture =
        PolygonCreationAssistance::from_rgba(&picture.rgba8(), picture.width(), picture.height())?;
    texture.set_hull_tolerance(1.5)?;
    texture.set_multipart_detection(true);
    Ok(Vertices::create_polygons(&texture)?)
}

/// The terrain with the bodies that fall on it.
fn terrain(picture: &SoftwareCanvas) -> Result<SampleScene> {
    let mut scene = SampleScene::new(150.0)?;
    for outline in trace(picture)? {
        add_ground(&mut scene, &outline)?;
    }
    for (index, x) in
        [110.0, 190.0, 250.0, 330.0, 400.0, 560.0, 690.0, 770.0, 830.0, 920.0].iter().enumerate()
    {
        let y = 110.0 + 37.0 * (index * 3 % 4) as f32;
        ball(&mut scene, Vector2::new(*x, y))?;
    }
    for (x, y, edge) in
        [(290.0, 80.0, 34.0), (360.0, 230.0, 28.0), (640.0, 250.0, 36.0), (800.0, 300.0, 30.0)]
    {
        crate_box(&mut scene, edge, edge, Vector2::new(x, y))?;
    }
    ragdoll(&mut scene, Vector2::new(500.0, 170.0))?;
    let blot = trace(&paint_blot()?)?.into_iter().next().ok_or("nothing was traced")?;
    for (x, y) in [(130.0, 330.0), (900.0, 310.0)] {
        add_blot(&mut scene, &blot, Vector2::new(x, y))?;
    }
    border(&mut scene)?;
    Ok(scene)
}

/// Adds a part of the ground, at its position in the picture.
fn add_ground(scene: &mut SampleScene, outline: &Vertices) -> Result<()> {
    let simulator = scene.simulator_mut();
    let body = BodyFactory::create_polygon_body_in(simulator, outline, 1.0)?;
    simulator[body].set_is_static(true);
    let placement = GeomPlacement::with_grid_size(4.0);
    let geom = GeomFactory::create_polygon_geom_in(simulator, body, &mut outline.clone(), placement)?;
    simulator[geom].set_friction_coefficient(0.6);
    scene.show(geom, CLEAR, TRACE);
    Ok(())
}

/// The blot of a sample of the original, at half its size.
fn paint_blot() -> Result<SoftwareCanvas> {
    let mut canvas = SoftwareCanvas::new(110, 72)?;
    let outline: Vec<Point> = splat_outline().iter().map(|corner| (corner * 0.5).into()).collect();
    let inward = Transform::translation([2.0, 2.0]);
    canvas.fill_polygon(&outline, &inward, Color::WHITE);
    Ok(canvas)
}

fn add_blot(scene: &mut SampleScene, outline: &Vertices, position: Vector2) -> Result<()> {
    let simulator = scene.simulator_mut();
    let body = BodyFactory::create_polygon_body_in(simulator, outline, 2.0)?;
    simulator[body].set_position(position);
    let placement = GeomPlacement::with_grid_size(2.0);
    let geom = GeomFactory::create_polygon_geom_in(simulator, body, &mut outline.clone(), placement)?;
    simulator[geom].set_friction_coefficient(0.6);
    scene.show(geom, [200, 60, 70, 255], BLACK);
    Ok(())
}
