//! Upright and turned shapes, as solids.

use twohalf::{Drawable, Platform, TwoHalfPhysicsSimulator, Vector3};
use twohalf_factories::{Cylinder, spawn};
use twohalf_render::{Color, Look, PlatformLook, Scene, SoftwareCanvas};

fn drawn(simulator: &TwoHalfPhysicsSimulator, look: &PlatformLook) -> SoftwareCanvas {
    let mut canvas = SoftwareCanvas::new(200, 200).unwrap();
    let shadow = Scene::soft_shadow();
    Scene::new(simulator, &shadow).draw(&mut canvas, |thing| match thing {
        Drawable::Body(_) | Drawable::Platform(_) => Look::Solid(*look),
    });
    canvas
}

#[test]
fn a_cylinder_shows_its_top_and_the_half_of_its_side_that_is_in_front() {
    let mut simulator = TwoHalfPhysicsSimulator::new(200).unwrap();
    spawn(&mut simulator, Cylinder::new(20.0, 50.0).at([100.0, 0.0, 60.0])).unwrap();
    simulator.update(0.0);
    let look = PlatformLook::new(Color::rgb(90, 120, 190));
    let canvas = drawn(&simulator, &look);
    // Its middle is 60 up the screen, its top 50 higher; its front comes down 20 from there, and goes up 20 behind.
    assert_eq!(canvas.pixel(100, 200 - 110), Some(look.top));
    assert_eq!(canvas.pixel(100, 200 - 110 - 15), Some(look.top));
    let front = canvas.pixel(100, 200 - 45).unwrap();
    let near = |a: u8, b: u8| a.abs_diff(b) <= 6;
    assert!(near(front.r, look.front.r) && near(front.b, look.front.b), "{front:?}");
    assert_eq!(canvas.pixel(100, 200 - 60 - 50 - 25), Some(Color::TRANSPARENT));
}

#[test]
fn the_back_of_a_platform_turned_half_round_is_visible() {
    let mut simulator = TwoHalfPhysicsSimulator::new(200).unwrap();
    let place = Vector3::new(100.0, 0.0, 60.0);
    let id = Platform::new(&mut simulator, 80.0, 40.0, 40.0, place, None).unwrap();
    simulator.platform_mut(id).unwrap().set_yaw(std::f32::consts::PI).unwrap();
    let look = PlatformLook::new(Color::rgb(90, 120, 190));
    let canvas = drawn(&simulator, &look);
    assert_eq!(canvas.pixel(100, 200 - 60), Some(look.front));
    assert_eq!(canvas.pixel(100, 200 - 100), Some(look.top));
}
