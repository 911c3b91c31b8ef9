//! Platforms that overlap: the order of drawing, and the visible parts. A street of 60 px, 200 px deep.

use crate::canvases::{BLUE, FACES, GREEN, RED, YELLOW, canvas};
use twohalf::{Drawable, Platform, PlatformId, TwoHalfPhysicsSimulator, Vector3};
use twohalf_factories::{Figure, Prism, spawn, spawn_slope};
use twohalf_render::{Look, PlatformLook, Scene, SoftwareCanvas};

const STREET: f32 = 60.0;
const TOPS: [f32; 14] = [-20.0, -10.0, -2.0, -0.5, -0.05, 0.05, 0.5, 1.0, 2.0, 5.0, 10.0, 15.0, 20.0, 40.0];

fn street(angle: i32) -> (TwoHalfPhysicsSimulator, PlatformId) {
    let mut simulator = TwoHalfPhysicsSimulator::with_angle(600, angle).unwrap();
    let street = platform(&mut simulator, [500.0, STREET, 200.0], [250.0, 0.0, 110.0]);
    (simulator, street)
}

fn platform(
    simulator: &mut TwoHalfPhysicsSimulator,
    [width, height, depth]: [f32; 3],
    place: [f32; 3],
) -> PlatformId {
    Platform::new(simulator, width, height, depth, Vector3::from(place), None).unwrap()
}

/// Whether one is drawn before the other.
fn is_below(simulator: &TwoHalfPhysicsSimulator, one: Drawable, other: Drawable) -> bool {
    let order = simulator.draw_order();
    let place = |thing| order.iter().position(|drawn| *drawn == thing).unwrap();
    place(one) < place(other)
}

/// The street in grey and one platform more: red above, blue in front.
fn picture(simulator: &TwoHalfPhysicsSimulator, street: PlatformId) -> SoftwareCanvas {
    let mut canvas = canvas();
    let shadow = Scene::soft_shadow();
    Scene::new(simulator, &shadow).draw(&mut canvas, |thing| match thing {
        Drawable::Platform(id) if id == street => Look::Solid(FACES),
        Drawable::Platform(_) => Look::Solid(PlatformLook { top: RED, front: YELLOW, ..FACES }),
        Drawable::Body(_) => Look::Nothing,
    });
    canvas
}

fn seen(
    canvas: &SoftwareCanvas,
    simulator: &TwoHalfPhysicsSimulator,
    point: [f32; 3],
) -> Option<twohalf_render::Color> {
    let on_screen = simulator.projection().to_screen(Vector3::from(point));
    canvas.pixel(on_screen.x as u32, on_screen.y as u32)
}

#[test]
fn a_lift_of_any_height_that_rises_above_the_street_is_drawn_after_it() {
    for angle in [60, 90, 120] {
        for height in [20.0, 40.0, 60.0, 100.0, 140.0, 200.0] {
            for top in TOPS {
                let (mut simulator, street) = street(angle);
                let lift =
                    platform(&mut simulator, [70.0, height, 60.0], [250.0, STREET + top - height, 110.0]);
                simulator.update(0.0);
                let [street, lift] = [street, lift].map(Drawable::Platform);
                let case = format!("{angle} degrees, {height} px tall, {top} px over the street");
                assert_eq!(is_below(&simulator, street, lift), top > 0.0, "{case}");
            }
        }
    }
}

#[test]
fn the_order_of_creation_and_platforms_elsewhere_have_no_effect() {
    for top in [0.5, 5.0, 10.0] {
        let mut simulator = TwoHalfPhysicsSimulator::with_angle(600, 90).unwrap();
        let lift = platform(&mut simulator, [70.0, 140.0, 60.0], [250.0, STREET + top - 140.0, 110.0]);
        let slope =
            spawn_slope(&mut simulator, [290.0, 100.0], [400.0, STREET], [80.0, 140.0], 20.0).unwrap();
        let shelf = platform(&mut simulator, [200.0, 10.0, 40.0], [330.0, 160.0, 160.0]);
        let street = platform(&mut simulator, [500.0, STREET, 200.0], [250.0, 0.0, 110.0]);
        simulator.update(0.0);
        let [lift, slope, shelf, street] = [lift, slope, shelf, street].map(Drawable::Platform);
        assert!(simulator.draw_order().contains(&shelf));
        for thing in [lift, slope] {
            assert!(is_below(&simulator, street, thing), "{thing:?} at {top}");
        }
    }
}

#[test]
fn figures_and_crates_on_the_lift_and_around_it_are_drawn_after_the_street_and_in_their_depth() {
    for top in [-5.0, 0.5, 10.0, 40.0f32] {
        let (mut simulator, street) = street(90);
        let lift = platform(&mut simulator, [70.0, 140.0, 60.0], [250.0, STREET + top - 140.0, 110.0]);
        let mut figure =
            |at: [f32; 3]| spawn(&mut simulator, Figure::new([30.0, 60.0, 20.0]).at(at)).unwrap().body;
        let (on, before, behind) = (
            figure([250.0, STREET + top.max(0.0), 110.0]),
            figure([250.0, STREET, 60.0]),
            figure([250.0, STREET, 160.0]),
        );
        let crate_box = Prism::new([20.0; 3]).at([230.0, STREET + top.max(0.0), 95.0]);
        let load = spawn(&mut simulator, crate_box).unwrap().body;
        simulator.update(0.0);
        let [street, lift] = [street, lift].map(Drawable::Platform);
        let [on, before, behind, load] = [on, before, behind, load].map(Drawable::Body);
        for body in [on, before, behind, load] {
            assert!(is_below(&simulator, street, body), "{top}");
        }
        assert!(
            is_below(&simulator, lift, on)
                && is_below(&simulator, lift, load)
                && is_below(&simulator, lift, before)
        );
        if top > 0.0 {
            assert!(is_below(&simulator, behind, lift), "{top}");
        }
    }
}

#[test]
fn the_top_and_the_front_over_the_street_of_a_lift_are_visible() {
    for top in [5.0, 10.0, 20.0, 40.0] {
        let (mut simulator, street) = street(90);
        platform(&mut simulator, [70.0, 140.0, 60.0], [250.0, STREET + top - 140.0, 110.0]);
        simulator.update(0.0);
        let canvas = picture(&simulator, street);
        let at = |point| seen(&canvas, &simulator, point);
        assert_eq!(at([250.0, STREET + top, 110.0]), Some(RED), "{top}");
        assert_eq!(at([250.0, STREET + 0.5 * top, 80.0]), Some(YELLOW), "{top}");
        // Before the lift there is the street.
        assert_eq!(at([250.0, STREET, 75.0]), Some(GREEN), "{top}");
        assert_eq!(at([250.0, STREET - 20.0, 10.0]), Some(BLUE), "{top}");
    }
    // A sunk one is invisible, a flush one is visible.
    for (top, color) in [(-5.0, GREEN), (0.0, RED)] {
        let (mut simulator, street) = street(90);
        platform(&mut simulator, [70.0, 140.0, 60.0], [250.0, STREET + top - 140.0, 110.0]);
        simulator.update(0.0);
        assert_eq!(
            seen(&picture(&simulator, street), &simulator, [250.0, STREET, 110.0]),
            Some(color),
            "{top}"
        );
    }
}

/// A ramp between the street and a block of 60 px on it, and one down on the other side.
#[test]
fn a_slope_is_hidden_below_the_top_of_its_street() {
    for (from, to, foot) in
        [([100.0, 120.0], [260.0, STREET], 250.0), ([260.0, STREET], [420.0, 120.0], 270.0)]
    {
        let (mut simulator, street) = street(90);
        spawn_slope(&mut simulator, from, to, [60.0, 160.0], 20.0).unwrap();
        simulator.update(0.0);
        let canvas = picture(&simulator, street);
        let at = |point| seen(&canvas, &simulator, point);
        // The front of the plank would reach 20 px below its foot.
        for below in [2.0, 8.0, 16.0] {
            assert_eq!(at([foot, STREET - below, 60.0]), Some(GREEN), "{from:?} {below}");
        }
        // The visible parts over the street: the top in the middle of its depth, and the wedge of its front.
        assert_eq!(at([180.0 + (foot - 250.0) * 8.0, 90.0, 110.0]), Some(RED), "{from:?}");
        assert_eq!(at([foot, STREET + 1.5, 60.0]), Some(YELLOW), "{from:?}");
    }
}

/// A solid that is not drawn, or is transparent, hides nothing.
#[test]
fn undrawn_and_transparent_platforms_hide_no_objects_in_them() {
    let (mut simulator, street) = street(90);
    platform(&mut simulator, [70.0, 140.0, 60.0], [250.0, 0.0, 20.0]);
    simulator.update(0.0);
    let glass = twohalf_render::Color::rgba(255, 255, 255, 1);
    let glass = PlatformLook { top: glass, front: glass, sides: glass, ..FACES };
    for other in [Look::Nothing, Look::Solid(glass)] {
        let mut canvas = canvas();
        let shadow = Scene::soft_shadow();
        Scene::new(&simulator, &shadow).draw(&mut canvas, |thing| match thing {
            Drawable::Platform(id) if id == street => Look::Solid(FACES),
            _ => other.clone(),
        });
        let color = seen(&canvas, &simulator, [250.0, 30.0, 10.0]).unwrap();
        assert!(color.b > 250 && color.r < 5, "{other:?}: {color:?}");
    }
}
