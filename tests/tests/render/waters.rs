//! Water hides objects below its surface. A pool of 200 px from X = 100 on, from Z = 20 to 180.

use crate::canvases::{FACES, GREEN, RED, canvas};
use twohalf::{Drawable, Platform, Region, TwoHalfPhysicsSimulator, Vector2, Vector3};
use twohalf_factories::{Figure, Prism, spawn, spawn_slope};
use twohalf_render::{Canvas, Color, Look, Picture, PlatformLook, Scene, SoftwareCanvas, Texture2D, Water};

const BLUE: Color = Color::rgba(0, 0, 255, 128);
/// Red through half of blue.
const TINTED: Color = Color::rgb(127, 0, 128);

fn pool(depth: f32) -> Water {
    Water { region: Region::new([100.0, 0.0, 20.0], [300.0, depth, 180.0]).unwrap(), color: BLUE }
}

fn simulator() -> TwoHalfPhysicsSimulator {
    TwoHalfPhysicsSimulator::with_gravity(600, Vector2::new(0.0, 900.0)).unwrap()
}

/// Everything in red, figures as flat pictures of 30 x 60 px.
fn picture(simulator: &TwoHalfPhysicsSimulator, waters: &[Water], is_flat: bool) -> SoftwareCanvas {
    let mut canvas = canvas();
    canvas.clear(Color::WHITE);
    let shadow = Scene::soft_shadow();
    let flat = crate::canvases::plain(30, 60, RED);
    let solid = PlatformLook { top: RED, front: RED, sides: RED, ..FACES };
    Scene::new(simulator, &shadow).waters(waters).draw(&mut canvas, |thing| match thing {
        Drawable::Body(_) if is_flat => Look::Picture(Picture::standing(&flat)),
        _ => Look::Solid(solid),
    });
    canvas
}

fn seen(canvas: &SoftwareCanvas, simulator: &TwoHalfPhysicsSimulator, point: [f32; 3]) -> Color {
    let on_screen = simulator.projection().to_screen(Vector3::from(point));
    canvas.pixel(on_screen.x as u32, on_screen.y as u32).unwrap()
}

/// Whether as much of the red is left: the front of the water is darker than its surface.
fn is_near(color: Color, expected: Color) -> bool {
    color.r.abs_diff(expected.r) <= 3 && color.g <= 3
}

#[test]
fn a_figure_is_tinted_up_to_the_surface_at_every_depth() {
    for is_flat in [true, false] {
        for depth in [2.0, 10.0, 30.0, 58.0, 90.0] {
            for z in [40.0, 100.0, 160.0] {
                let mut simulator = simulator();
                let figure = Figure::new([30.0, 60.0, 20.0]).at([200.0, 0.0, z]);
                let figure = spawn(&mut simulator, figure).unwrap();
                simulator.update(0.0);
                let canvas = picture(&simulator, &[pool(depth)], is_flat);
                // Solid figures meet the surface at their front.
                let front = simulator.geom(figure.geom).unwrap().virtual_geom().front;
                let front = if is_flat { z } else { front };
                for y in [1.5, 3.5, 12.0, 28.0, 33.0, 55.0] {
                    // The edge between the front and the surface of the water is a white line.
                    if (y + front - depth - 20.0).abs() < 2.0 {
                        continue;
                    }
                    let expected = if y < depth { TINTED } else { RED };
                    let color = seen(&canvas, &simulator, [200.0, y, front]);
                    assert!(is_near(color, expected), "{is_flat}, {depth} px, z {z}, y {y}: {color:?}");
                }
            }
        }
    }
}

#[test]
fn a_figure_that_jumps_comes_out_of_the_water() {
    for (height, y, expected) in [
        (0.0, 20.0, TINTED),
        (10.0, 20.0, TINTED),
        (25.0, 28.0, TINTED),
        (25.0, 31.0, RED),
        (40.0, 41.0, RED),
    ] {
        let mut simulator = simulator();
        spawn(&mut simulator, Figure::new([30.0, 60.0, 20.0]).at([200.0, height, 100.0])).unwrap();
        simulator.update(0.0);
        let color = seen(&picture(&simulator, &[pool(30.0)], true), &simulator, [200.0, y, 100.0]);
        assert!(is_near(color, expected), "{height} {y}: {color:?}");
    }
}

#[test]
fn platforms_in_water_are_tinted_up_to_the_surface_and_slopes_up_to_their_exit() {
    let mut simulator = simulator();
    Platform::new(&mut simulator, 40.0, 60.0, 60.0, Vector3::new(140.0, 0.0, 100.0), None).unwrap();
    spawn_slope(&mut simulator, [200.0, 0.0], [300.0, 80.0], [60.0, 140.0], 10.0).unwrap();
    simulator.update(0.0);
    let canvas = picture(&simulator, &[pool(40.0)], false);
    for ([x, y, z], expected) in [
        // Front and top of the block.
        ([140.0, 20.0, 70.0], TINTED),
        ([140.0, 50.0, 70.0], RED),
        ([140.0, 60.0, 100.0], RED),
        // Top of the slope, 40 px high at X = 250.
        ([235.0, 28.0, 100.0], TINTED),
        ([235.0, 28.0, 130.0], TINTED),
        ([265.0, 52.0, 100.0], RED),
        ([265.0, 52.0, 70.0], RED),
    ] {
        let color = seen(&canvas, &simulator, [x, y, z]);
        assert!(is_near(color, expected), "{x} {y} {z}: {color:?}");
    }
}

#[test]
fn a_figure_on_a_platform_in_water_is_tinted_below_the_surface_alone() {
    for (top, y, expected) in [(20.0, 25.0, TINTED), (20.0, 45.0, RED), (50.0, 52.0, RED)] {
        let mut simulator = simulator();
        Platform::new(&mut simulator, 80.0, top, 60.0, Vector3::new(200.0, 0.0, 100.0), None).unwrap();
        spawn(&mut simulator, Figure::new([30.0, 60.0, 20.0]).at([200.0, top, 100.0])).unwrap();
        simulator.update(0.0);
        let color = seen(&picture(&simulator, &[pool(40.0)], true), &simulator, [200.0, y, 100.0]);
        assert!(is_near(color, expected), "{top} {y}: {color:?}");
    }
}

#[test]
fn two_waters_tint_the_objects_in_each_once() {
    let mut simulator = simulator();
    let other = Water { region: Region::new([320.0, 0.0, 20.0], [480.0, 20.0, 180.0]).unwrap(), color: BLUE };
    for x in [200.0, 400.0] {
        spawn(&mut simulator, Figure::new([30.0, 60.0, 20.0]).at([x, 0.0, 100.0])).unwrap();
    }
    spawn(&mut simulator, Prism::new([20.0; 3]).at([60.0, 0.0, 100.0])).unwrap();
    simulator.update(0.0);
    for waters in [[pool(40.0), other], [other, pool(40.0)]] {
        let canvas = picture(&simulator, &waters, true);
        for ([x, y], expected) in
            [([200.0, 30.0], TINTED), ([200.0, 45.0], RED), ([400.0, 10.0], TINTED), ([400.0, 30.0], RED)]
        {
            let color = seen(&canvas, &simulator, [x, y, 100.0]);
            assert!(is_near(color, expected), "{x} {y}: {color:?}");
        }
    }
}

#[test]
fn nearer_figures_cover_those_in_the_water_behind_them() {
    let mut simulator = simulator();
    let far = spawn(&mut simulator, Figure::new([30.0, 60.0, 20.0]).at([200.0, 0.0, 60.0])).unwrap();
    let near = spawn(&mut simulator, Figure::new([30.0, 60.0, 20.0]).at([205.0, 0.0, 30.0])).unwrap();
    simulator.update(0.0);
    let mut canvas = canvas();
    let shadow = Scene::soft_shadow();
    let textures = [RED, GREEN].map(|color| crate::canvases::plain(30, 60, color));
    let look = |texture: &Texture2D| Look::Picture(Picture::standing(texture));
    Scene::new(&simulator, &shadow)
        .waters(&[pool(2.0)])
        .draw(&mut canvas, |thing| look(&textures[usize::from(thing == Drawable::Body(near.body))]));
    assert!(far.body != near.body);
    // Both appear there, above the water.
    assert_eq!(seen(&canvas, &simulator, [203.0, 50.0, 30.0]), GREEN);
}
