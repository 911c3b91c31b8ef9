//! Scenes of the 2.5D engine, drawn in one call.

use twohalf::{
    BodyId, DepthProfile, Drawable, Fluid, Interpolation3D, Platform, Region, TwoHalfPhysicsSimulator,
    Vector2, Vector3, Well,
};
use twohalf_factories::{Ball, TwoHalfBodyFactory, TwoHalfGeomFactory, spawn};
use twohalf_render::*;

const RED: Color = Color::rgb(255, 0, 0);

/// Straight up the screen goes Z: a point is at x = X, y = 200 - Y - Z.
fn world() -> TwoHalfPhysicsSimulator {
    TwoHalfPhysicsSimulator::with_angle_and_gravity(200, 90, Vector2::new(0.0, 0.0)).unwrap()
}

/// A box of 40 x 40 x 40 px that stands at a place.
fn add_box(simulator: &mut TwoHalfPhysicsSimulator, place: Vector3) -> BodyId {
    let body = TwoHalfBodyFactory::create_rectangle_body(simulator, 40.0, 40.0, 1.0).unwrap();
    let geom = TwoHalfGeomFactory::create_rectangle_geom(simulator, body, 40.0, 40.0).unwrap();
    let mut view = simulator.body_mut(body).unwrap();
    view.ground_mut().set_object_geom(geom, None).unwrap();
    view.set_position3d(place);
    body
}

/// Black shadows, as wide as they are in the middle.
fn drawn(simulator: &TwoHalfPhysicsSimulator, look: impl FnMut(Drawable) -> Look) -> SoftwareCanvas {
    let mut canvas = SoftwareCanvas::new(200, 200).unwrap();
    canvas.clear(Color::WHITE);
    let shadow = Texture2D::from_rgba8(1, 1, vec![0, 0, 0, 255]).unwrap();
    Scene::new(simulator, &shadow).draw(&mut canvas, look);
    canvas
}

fn plain() -> PlatformLook {
    PlatformLook { top: Color::rgb(0, 255, 0), edge_width: 0.0, ..PlatformLook::new(RED) }
}

#[test]
fn a_solid_shows_its_front_and_its_top() {
    let mut simulator = world();
    add_box(&mut simulator, Vector3::new(100.0, 0.0, 60.0));
    simulator.update(0.0);
    let canvas = drawn(&simulator, |_| Look::Solid(plain()));
    // Its front is at Z = 40, from Y = 0 to 40; its top at Y = 40, from there to Z = 80.
    assert_eq!(canvas.pixel(100, 158), Some(RED));
    assert_eq!(canvas.pixel(100, 122), Some(RED));
    assert_eq!(canvas.pixel(100, 118), Some(Color::rgb(0, 255, 0)));
    assert_eq!(canvas.pixel(100, 82), Some(Color::rgb(0, 255, 0)));
    assert_eq!(canvas.pixel(100, 78), Some(Color::WHITE));
}

#[test]
fn a_shadow_lies_on_a_box_below_and_ends_at_the_edge_of_its_top() {
    let mut simulator = world();
    let below = add_box(&mut simulator, Vector3::new(100.0, 0.0, 60.0));
    let above = add_box(&mut simulator, Vector3::new(115.0, 40.0, 60.0));
    simulator.update(0.0);
    let clear = Texture2D::from_rgba8(1, 1, vec![0; 4]).unwrap();
    let canvas = drawn(&simulator, |thing| match thing {
        Drawable::Body(id) if id == above => Look::Picture(Picture::new(&clear)),
        Drawable::Body(id) if id == below => Look::Solid(plain()),
        _ => Look::Nothing,
    });
    // 1.2 times as wide as the box above, from 91 to 139; the top below ends at 120.
    let row: Vec<Color> = (0..200).map(|x| canvas.pixel(x, 100).unwrap()).collect();
    assert_eq!([row[85], row[93], row[118]], [Color::rgb(0, 255, 0), Color::BLACK, Color::BLACK]);
    assert_eq!([row[122], row[130]], [Color::WHITE, Color::WHITE]);
}

/// The share of the light that the shadow of a platform leaves, of a white ground and of a green top.
const SHADED: [Color; 2] = [Color::rgb(185, 185, 185), Color::rgb(0, 185, 0)];

#[test]
fn the_shadow_of_a_platform_in_the_air_lies_on_what_is_beneath_it_and_beyond_its_edge_on_the_ground() {
    // A table from X = 20 to 80 whose top is at Y = 20, and above it, from X = 50 to 110, a plate of 10 px.
    type Table = fn(&mut TwoHalfPhysicsSimulator);
    let tables: [Table; 2] = [
        |simulator| {
            Platform::new(simulator, 60.0, 20.0, 60.0, Vector3::new(50.0, 0.0, 60.0), None).unwrap();
        },
        |simulator| {
            let body = TwoHalfBodyFactory::create_rectangle_body(simulator, 60.0, 20.0, 1.0).unwrap();
            let geom = TwoHalfGeomFactory::create_rectangle_geom(simulator, body, 60.0, 20.0).unwrap();
            simulator.set_depth_profile(geom, DepthProfile::Prism { depth: 60.0 }).unwrap();
            let mut view = simulator.body_mut(body).unwrap();
            view.ground_mut().set_object_geom(geom, None).unwrap();
            view.set_position3d(Vector3::new(50.0, 0.0, 60.0));
        },
    ];
    for table in tables {
        let mut simulator = world();
        table(&mut simulator);
        let place = Vector3::new(80.0, 90.0, 60.0);
        let plate = Platform::new(&mut simulator, 60.0, 10.0, 40.0, place, None).unwrap();
        simulator.update(0.0);
        let clear = PlatformLook { top: Color::TRANSPARENT, front: Color::TRANSPARENT, ..plain() };
        let canvas = drawn(&simulator, |thing| match thing {
            Drawable::Platform(id) if id == plate => Look::Solid(clear),
            _ => Look::Solid(plain()),
        });
        // At Z = 60 and 76 the table's top is at y = 120 and 104, the ground at y = 140 and 124.
        let on_top = [(45, 120), (55, 120), (75, 104)].map(|(x, y)| canvas.pixel(x, y).unwrap());
        assert_eq!(on_top, [plain().top, SHADED[1], SHADED[1]]);
        let on_ground = [(95, 140), (105, 124), (115, 140)].map(|(x, y)| canvas.pixel(x, y).unwrap());
        assert_eq!(on_ground, [SHADED[0], SHADED[0], Color::WHITE]);
        // The plate reaches from Z = 40 to 80, the table from Z = 30 to 90.
        let beyond = [(75, 95), (75, 145)].map(|(x, y)| canvas.pixel(x, y).unwrap());
        assert_eq!(beyond, [plain().top; 2]);
    }
}

#[test]
fn the_shadow_of_a_platform_goes_down_a_slope_with_it_and_no_shadow_falls_upwards() {
    let mut simulator = world();
    // A slope from (60, 60) down to (140, 0) and a plate above it, and another slope that is above the plate.
    let down = |height: f32| Vector3::new(100.0, 30.0 + height, 60.0);
    let rotation = (60.0_f32 / 80.0).atan();
    let slope = Platform::with_rotation(&mut simulator, 100.0, 1.0, 60.0, down(0.0), rotation, None).unwrap();
    let plate =
        Platform::new(&mut simulator, 60.0, 2.0, 20.0, Vector3::new(100.0, 75.0, 60.0), None).unwrap();
    simulator.update(0.0);
    let clear = PlatformLook { top: Color::TRANSPARENT, front: Color::TRANSPARENT, ..plain() };
    let canvas = drawn(&simulator, |thing| match thing {
        Drawable::Platform(id) if id == plate => Look::Solid(clear),
        Drawable::Platform(id) if id == slope => Look::Solid(plain()),
        _ => Look::Nothing,
    });
    let at = |x: f32, z: f32| {
        let y = 60.0 - 0.75 * (x - 60.0);
        canvas.pixel(x as u32, (200.0 - y - z) as u32).unwrap()
    };
    // From X = 70 to 130 and Z = 50 to 70.
    assert_eq!([at(75.0, 54.0), at(75.0, 66.0), at(125.0, 54.0), at(125.0, 66.0)], [SHADED[1]; 4]);
    assert_eq!([at(65.0, 60.0), at(75.0, 46.0), at(75.0, 75.0), at(134.0, 60.0)], [plain().top; 4]);
}

#[test]
fn what_does_not_look_like_anything_is_not_drawn_and_casts_no_shadow() {
    let mut simulator = world();
    add_box(&mut simulator, Vector3::new(100.0, 30.0, 60.0));
    Platform::new(&mut simulator, 50.0, 20.0, 30.0, Vector3::new(40.0, 40.0, 30.0), None).unwrap();
    simulator.update(0.0);
    let canvas = drawn(&simulator, |_| Look::Nothing);
    assert!(canvas.rgba8().iter().all(|&byte| byte == 255));
}

#[test]
fn the_feet_of_who_stands_on_a_box_are_seen_before_its_top() {
    for aside in [-12.0, -4.0, 4.0, 12.0] {
        let mut simulator = world();
        let below = add_box(&mut simulator, Vector3::new(100.0, 0.0, 60.0));
        add_box(&mut simulator, Vector3::new(100.0, 40.0, 60.0 + aside));
        simulator.update(0.0);
        let feet = Texture2D::from_rgba8(2, 2, [0, 0, 255, 255].repeat(4)).unwrap();
        let canvas = drawn(&simulator, |thing| match thing {
            Drawable::Body(id) if id == below => Look::Solid(plain()),
            _ => Look::Picture(Picture::standing(&feet)),
        });
        let at = (200.0 - 40.0 - 60.0 - aside) as u32 - 1;
        assert_eq!(canvas.pixel(100, at), Some(Color::rgb(0, 0, 255)), "{aside} px behind the middle");
    }
}

/// How far two pictures are apart where they are farthest, and in how many px they differ clearly.
fn difference(a: &SoftwareCanvas, b: &SoftwareCanvas) -> (u8, usize) {
    let ways = || a.rgba8().into_iter().zip(b.rgba8()).map(|(a, b)| a.abs_diff(b));
    (ways().max().unwrap(), ways().filter(|way| *way > 40).count())
}

/// Before the last update a scene looked as it looks now between the updates, at their first end, and now at their second.
fn assert_goes_back(
    mut simulator: TwoHalfPhysicsSimulator,
    shadow: &Texture2D,
    look: impl Fn(Drawable) -> Look + Copy,
) {
    let draw = |simulator: &TwoHalfPhysicsSimulator, between: Option<(&Interpolation3D, f32)>| {
        let mut canvas = SoftwareCanvas::new(200, 200).unwrap();
        canvas.clear(Color::WHITE);
        let mut scene = Scene::new(simulator, shadow);
        if let Some((interpolation, fraction)) = between {
            scene = scene.between(interpolation, fraction);
        }
        scene.draw(&mut canvas, look);
        canvas
    };
    let mut interpolation = Interpolation3D::new();
    let before = draw(&simulator, None);
    interpolation.remember(&simulator);
    simulator.update(0.01);
    interpolation.remember(&simulator);
    let now = draw(&simulator, None);
    assert!(difference(&before, &now).1 > 20);
    assert_eq!(draw(&simulator, Some((&interpolation, 1.0))), now);
    // Edges are shaded by how much of a px they cover, in steps of 1/16 of it and of 1/256 px.
    let (greatest, clearly) = difference(&draw(&simulator, Some((&interpolation, 0.0))), &before);
    assert!(clearly == 0, "{clearly} px differ, by up to {greatest}");
}

#[test]
fn between_two_updates_a_box_over_a_lift_is_drawn_with_its_shadow_on_the_way() {
    let mut simulator = world();
    let body = add_box(&mut simulator, Vector3::new(80.0, 61.0, 60.0));
    let place = Vector3::new(90.0, 40.0, 60.0);
    let lift = Platform::new(&mut simulator, 60.0, 20.0, 60.0, place, None).unwrap();
    simulator.update(0.0);
    simulator.platform_mut(lift).unwrap().set_velocity(Vector3::new(0.0, 400.0, 0.0)).unwrap();
    simulator.body_mut(body).unwrap().set_velocity3d(Vector3::new(500.0, 400.0, -600.0));
    let shadow = Texture2D::from_rgba8(1, 1, vec![0, 0, 0, 255]).unwrap();
    assert_goes_back(simulator, &shadow, |_| Look::Solid(plain()));
}

#[test]
fn between_two_updates_what_turns_is_drawn_on_its_way_round() {
    let picture = Texture2D::from_rgba8(2, 2, [255, 0, 0, 255].repeat(4)).unwrap();
    let looks = [
        Look::Solid(plain()),
        Look::Picture(Picture { scale: 20.0, ..Picture::new(&picture) }),
        Look::Ball(RED),
    ];
    let clear = Texture2D::from_rgba8(1, 1, vec![0; 4]).unwrap();
    for look in &looks {
        let mut simulator = world();
        let place = [100.0, 60.0, 60.0];
        let body = match look {
            Look::Ball(_) => spawn(&mut simulator, Ball::new(20.0).at(place)).unwrap().body,
            _ => add_box(&mut simulator, place.into()),
        };
        simulator.body_mut(body).unwrap().core_mut().set_angular_velocity(30.0);
        simulator.update(0.01);
        assert_goes_back(simulator, &clear, |_| look.clone());
    }
}

#[test]
fn between_two_updates_platforms_are_drawn_on_their_way_round() {
    let clear = Texture2D::from_rgba8(1, 1, vec![0; 4]).unwrap();
    for height in [0.0, 40.0] {
        let mut simulator = world();
        let place = Vector3::new(100.0, height, 60.0);
        let platform = Platform::new(&mut simulator, 80.0, 20.0, 10.0, place, None).unwrap();
        simulator.update(0.0);
        // It moves as it turns, and its shadow with it.
        let mut view = simulator.platform_mut(platform).unwrap();
        view.set_angular_velocity(40.0).unwrap();
        view.set_velocity(Vector3::new(500.0, 0.0, 300.0)).unwrap();
        simulator.update(0.01);
        assert_goes_back(simulator, &clear, |_| Look::Solid(plain()));
    }
}

#[test]
fn between_two_updates_the_shadow_of_a_platform_on_one_that_turns_is_drawn_with_it() {
    let mut simulator = world();
    let table = Vector3::new(100.0, 0.0, 60.0);
    let table = Platform::new(&mut simulator, 60.0, 20.0, 60.0, table, None).unwrap();
    let above = Vector3::new(110.0, 60.0, 70.0);
    let above = Platform::new(&mut simulator, 50.0, 6.0, 50.0, above, None).unwrap();
    simulator.update(0.0);
    simulator.platform_mut(table).unwrap().set_angular_velocity(30.0).unwrap();
    simulator.update(0.01);
    let clear = Texture2D::from_rgba8(1, 1, vec![0; 4]).unwrap();
    assert_goes_back(simulator, &clear, |thing| match thing {
        Drawable::Platform(id) if id == above => Look::Solid(PlatformLook {
            top: Color::TRANSPARENT,
            front: Color::TRANSPARENT,
            sides: Color::TRANSPARENT,
            ..plain()
        }),
        _ => Look::Solid(plain()),
    });
}

#[test]
fn between_two_updates_a_line_ends_where_both_its_ends_are_drawn() {
    let mut simulator = world();
    let [from, to] = [60.0, 140.0].map(|x| add_box(&mut simulator, Vector3::new(x, 40.0, 60.0)));
    simulator.update(0.0);
    for (body, speed) in [(from, 800.0), (to, -900.0)] {
        simulator.body_mut(body).unwrap().set_velocity3d(Vector3::new(0.0, speed, 300.0));
    }
    let clear = Texture2D::from_rgba8(1, 1, vec![0; 4]).unwrap();
    assert_goes_back(simulator, &clear, |thing| match thing {
        Drawable::Body(id) if id == from => Look::Line { to, color: RED, width: 4.0 },
        _ => Look::Nothing,
    });
}

#[test]
fn a_standing_picture_has_its_feet_where_the_body_stands() {
    let mut simulator = world();
    add_box(&mut simulator, Vector3::new(100.0, 0.0, 60.0));
    simulator.update(0.0);
    let texture = Texture2D::from_rgba8(2, 3, [255, 0, 0, 255].repeat(6)).unwrap();
    let canvas = drawn(&simulator, |_| Look::Picture(Picture { scale: 10.0, ..Picture::standing(&texture) }));
    for (x, y) in (110..140).flat_map(|y| (90..110).map(move |x| (x, y))) {
        assert_eq!(canvas.pixel(x, y), Some(RED), "({x}, {y})");
    }
    // Above it is nothing, and below it the shadow on the ground.
    assert_eq!([canvas.pixel(100, 109), canvas.pixel(100, 141)], [Some(Color::WHITE), Some(Color::BLACK)]);
}

#[test]
fn a_flipped_picture_shows_its_left_on_the_right() {
    let mut simulator = world();
    add_box(&mut simulator, Vector3::new(100.0, 0.0, 60.0));
    simulator.update(0.0);
    let texture = Texture2D::from_rgba8(2, 1, [[255, 0, 0, 255], [0, 0, 255, 255]].concat()).unwrap();
    let picture = Picture { scale: 10.0, ..Picture::standing(&texture) };
    let right =
        |flip| drawn(&simulator, |_| Look::Picture(Picture { flip, ..picture.clone() })).pixel(108, 135);
    assert_eq!([right(false), right(true)], [Some(Color::rgb(0, 0, 255)), Some(RED)]);
}

#[test]
fn textures_repeat_over_the_faces_of_a_platform() {
    let mut simulator = world();
    Platform::new(&mut simulator, 80.0, 40.0, 40.0, Vector3::new(100.0, 0.0, 60.0), None).unwrap();
    simulator.update(0.0);
    let [red, blue] = [[255, 0, 0, 255], [0, 0, 255, 255]];
    // Stripes of 10 px.
    let stripes = Texture2D::from_rgba8(20, 1, [red.repeat(10), blue.repeat(10)].concat()).unwrap();
    let textures = Textures { top: None, front: Some(stripes) };
    let canvas = drawn(&simulator, |_| Look::Textured(plain(), textures.clone()));
    for tile in 0..4 {
        let colors = [65, 75].map(|x| canvas.pixel(x + 20 * tile, 140));
        assert_eq!(colors, [Some(RED), Some(Color::rgb(0, 0, 255))], "{tile}");
    }
    assert_eq!(canvas.pixel(65, 118), Some(Color::rgb(0, 255, 0)));
}

#[test]
fn a_texture_ends_with_its_face_where_the_ground_begins() {
    let mut simulator = world();
    Platform::new(&mut simulator, 80.0, 40.0, 40.0, Vector3::new(100.0, -25.0, 60.0), None).unwrap();
    simulator.update(0.0);
    // The lower half of it is red; 15 px of its blue upper half are above the ground, whose edge is at y = 160.
    let [red, blue] = [[255, 0, 0, 255], [0, 0, 255, 255]];
    let texture = Texture2D::from_rgba8(1, 40, [blue.repeat(20), red.repeat(20)].concat()).unwrap();
    let textures = Textures { top: None, front: Some(texture) };
    let canvas = drawn(&simulator, |_| Look::Textured(plain(), textures.clone()));
    let without = drawn(&simulator, |_| Look::Nothing);
    assert_eq!([147, 157].map(|y| canvas.pixel(100, y)), [Some(Color::rgb(0, 0, 255)); 2]);
    assert_eq!([163, 175].map(|y| canvas.pixel(100, y)), [163, 175].map(|y| without.pixel(100, y)));
}

#[test]
fn what_is_under_the_mouse_is_found_through_the_camera() {
    let mut simulator = world();
    let body = add_box(&mut simulator, Vector3::new(100.0, 0.0, 60.0));
    simulator.update(0.0);
    let shadow = Scene::soft_shadow();
    let scene =
        Scene::new(&simulator, &shadow).camera(&Transform::camera([100.0, 120.0], 3.0, 0.0, [50.0, 50.0]));
    assert_eq!(scene.pick([50.0, 50.0]), Some(Drawable::Body(body)));
    assert_eq!(scene.pick([50.0, 190.0]), None);
}

#[test]
fn a_hole_shows_its_wall_at_the_back_and_its_bottom_before_that() {
    let simulator = world();
    let mut canvas = SoftwareCanvas::new(200, 200).unwrap();
    canvas.clear(Color::WHITE);
    let hole = Patch::hole([50.0, 150.0], [20.0, 70.0]);
    let shadow = Scene::soft_shadow();
    Scene::new(&simulator, &shadow).patches(&[hole]).draw(&mut canvas, |_| Look::Nothing);
    // From y = 130 to 180; the wall is 30 px high.
    let colors = [128, 135, 158, 165, 178, 182].map(|y| canvas.pixel(100, y).unwrap());
    assert_eq!(colors, [Color::WHITE, hole.edge, hole.edge, hole.color, hole.color, Color::WHITE]);
}

#[test]
fn a_layer_moves_by_its_factor_of_the_camera() {
    // One red column in each 50 px.
    let mut pixels = vec![255; 4 * 50];
    pixels[..4].copy_from_slice(&[255, 0, 0, 255]);
    let texture = Texture2D::from_rgba8(50, 1, pixels).unwrap();
    let red_at = |scroll: f32, factor: f32| {
        let mut canvas = SoftwareCanvas::new(50, 4).unwrap();
        let camera = Transform::translation([-scroll, 0.0]);
        draw_parallax_layer(&mut View::new(&mut canvas).camera(&camera), &texture, 2.0, factor);
        (0..50).filter(|&x| canvas.pixel(x, 2) == Some(RED)).collect::<Vec<u32>>()
    };
    assert_eq!(red_at(0.0, 0.5), [0]);
    assert_eq!(red_at(20.0, 0.5), [40]);
    assert_eq!(red_at(20.0, 1.0), [30]);
    assert_eq!(red_at(20.0, 0.0), [0]);
}

#[test]
fn the_room_of_a_box_reaches_from_its_front_to_its_back() {
    let mut simulator = world();
    add_box(&mut simulator, Vector3::new(100.0, 0.0, 60.0));
    simulator.update(0.0);
    let draw = |enable_box_view| {
        let mut canvas = SoftwareCanvas::new(200, 200).unwrap();
        let view = DebugView { enable_box_view, enable_virtual_geom_view: false, ..DebugView::default() };
        DebugView { enable_ground_view: false, ..view }.draw(&simulator, &mut canvas);
        [160, 80].map(|y| (y - 1..=y).any(|y| canvas.pixel(100, y).unwrap().a > 0))
    };
    // The lower edge at the front is at Y = 0 and Z = 40, the upper one at the back at Y = 40 and Z = 80.
    assert_eq!([draw(true), draw(false)], [[true; 2], [false; 2]]);
}

#[test]
fn a_line_goes_from_the_middle_of_one_body_to_that_of_another_and_casts_no_shadow() {
    let mut simulator = world();
    let [from, to] = [60.0, 140.0].map(|x| add_box(&mut simulator, Vector3::new(x, 40.0, 60.0)));
    simulator.update(0.0);
    let canvas = drawn(&simulator, |thing| match thing {
        Drawable::Body(id) if id == from => Look::Line { to, color: RED, width: 4.0 },
        _ => Look::Nothing,
    });
    // Y = 60 and Z = 60 are at y = 80.
    assert_eq!([62, 100, 138].map(|x| canvas.pixel(x, 80)), [Some(RED); 3]);
    assert_eq!(
        [(50, 80), (150, 80), (100, 84), (60, 140)].map(|(x, y)| canvas.pixel(x, y)),
        [Some(Color::WHITE); 4]
    );
}

/// The colour of a box at a place beside, in or over a pool from X = 50 to 150, Y = 0 to 50 and Z = 20 to 100.
fn seen_through_water(place: Vector3) -> Color {
    let mut simulator = world();
    add_box(&mut simulator, place);
    simulator.update(0.0);
    let mut canvas = SoftwareCanvas::new(200, 200).unwrap();
    canvas.clear(Color::WHITE);
    let region = Region::new([50.0, 0.0, 20.0], [150.0, 50.0, 100.0]).unwrap();
    let waters = [Water { region, color: Color::rgba(0, 0, 255, 128) }];
    let shadow = Texture2D::from_rgba8(1, 1, vec![0; 4]).unwrap();
    Scene::new(&simulator, &shadow).waters(&waters).draw(&mut canvas, |_| Look::Solid(plain()));
    let middle = simulator.projection().to_screen(place + Vector3::new(0.0, 20.0, -20.0));
    canvas.pixel(middle.x as u32, middle.y as u32).unwrap()
}

#[test]
fn what_is_in_water_is_seen_through_it_and_what_is_before_or_over_it_is_not() {
    for place in [[100.0, 5.0, 60.0], [100.0, 20.0, 50.0]] {
        let color = seen_through_water(place.into());
        assert!(color.r < 200 && color.b > 60, "{place:?}: {color:?}");
    }
    for place in [[100.0, 52.0, 60.0], [100.0, 5.0, -1.0]] {
        assert_eq!(seen_through_water(place.into()), RED, "{place:?}");
    }
}

#[test]
fn the_waters_of_a_simulator_are_its_fluids_that_carry_and_have_an_end() {
    let mut simulator = world();
    let pool = Region::new([0.0; 3], [100.0; 3]).unwrap();
    simulator.add_field(Fluid::water(pool, 1e-3)).unwrap();
    simulator.add_field(Fluid::wind(pool, Vector3::x(), 1e-3)).unwrap();
    simulator.add_field(Fluid::water(Region::EVERYWHERE, 1e-3)).unwrap();
    simulator.add_field(Well::new([0.0; 3])).unwrap();
    assert_eq!(Water::all_of(&simulator), [Water::new(pool)]);
}

#[test]
fn every_pose_of_a_figure_looks_different_and_to_the_left_as_to_the_right() {
    let mut simulator = world();
    add_box(&mut simulator, Vector3::new(100.0, 0.0, 60.0));
    simulator.update(0.0);
    let all = [Pose::Walks, Pose::Strikes, Pose::Lifts, Pose::Jumps, Pose::Reels, Pose::Lies];
    let picture = |pose, looks_left| {
        let figure = Figure { pose, looks_left, stride: 0.3, ..Figure::new(RED) };
        drawn(&simulator, |_| Look::Figure(figure))
    };
    let pictures: Vec<SoftwareCanvas> = all.iter().map(|&pose| picture(pose, false)).collect();
    for (at, canvas) in pictures.iter().enumerate() {
        assert!(pictures[..at].iter().all(|other| other != canvas), "{:?}", all[at]);
        let mirrored = picture(all[at], true);
        let differing = (0..200).flat_map(|y| (0..200).map(move |x| (x, y))).filter(|&(x, y)| {
            let pair = [canvas.pixel(x, y), mirrored.pixel(199 - x, y)];
            let [Some(a), Some(b)] = pair else { return true };
            a.r.abs_diff(b.r) > 8 || a.g.abs_diff(b.g) > 8
        });
        // Edges are rounded otherwise, here and there; not mirrored, hundreds would differ.
        let count = differing.count();
        assert!(count < 60, "{:?}: {count}", all[at]);
    }
}

#[test]
fn only_the_tiles_of_a_face_that_are_seen_are_drawn_and_nothing_is_missing() {
    let mut simulator = world();
    Platform::new(&mut simulator, 3000.0, 40.0, 40.0, Vector3::new(100.0, 0.0, 60.0), None).unwrap();
    simulator.update(0.0);
    let tile = Texture2D::from_rgba8(10, 10, [255, 0, 0, 255].repeat(100)).unwrap();
    let textures = Textures { top: Some(tile.clone()), front: Some(tile) };
    let look = PlatformLook { edge_width: 0.0, ..plain() };
    let canvas = drawn(&simulator, |_| Look::Textured(look, textures.clone()));
    for (x, y) in (82..158).flat_map(|y| (0..200).map(move |x| (x, y))) {
        assert_eq!(canvas.pixel(x, y), Some(RED), "({x}, {y})");
    }
}
