//! Cameras, clip rectangles, parts of textures, and text that is turned.

use std::f32::consts::FRAC_PI_2;

use twohalf_render::*;

const RED: Color = Color::rgb(255, 0, 0);

fn white(width: u32, height: u32) -> SoftwareCanvas {
    let mut canvas = SoftwareCanvas::new(width, height).unwrap();
    canvas.clear(Color::WHITE);
    canvas
}

/// Everything that can be drawn, some of it across every side of the middle.
fn draw_all_kinds(canvas: &mut dyn Canvas) {
    let still = Transform::IDENTITY;
    canvas.fill_rectangle([5.0, 5.0], [30.0, 20.0], &still, RED);
    canvas.fill_ellipse([50.0, 30.0], [25.0, 12.0], &still, Color::rgba(0, 0, 255, 128));
    let zigzag = [[0.0, 50.0], [30.0, 12.0], [55.0, 58.0], [79.0, 3.0]];
    canvas.stroke_polyline(&zigzag, false, 3.0, &still, Color::rgba(0, 160, 0, 180));
    canvas.stroke_polyline(&[[10.0, 30.0], [70.0, 30.0], [40.0, 55.0]], true, 2.0, &still, Color::BLACK);
    let ball = Texture2D::ball(24, RED).unwrap();
    canvas.draw_texture(&ball, &Transform::translation([16.0, 32.0]), Color::WHITE, None);
    let clip = [[50.0, 40.0], [78.0, 40.0], [64.0, 60.0]];
    canvas.draw_texture(&ball, &Transform::translation([52.0, 38.0]), Color::WHITE, Some(&clip));
    draw_text(canvas, "clip", [14.0, 4.0], 2, Color::BLACK);
}

#[test]
fn nothing_is_drawn_outside_of_a_clip_rectangle() {
    let mut canvas = white(80, 60);
    let window = Rectangle::new(20, 15, 40, 30);
    draw_all_kinds(&mut View::new(&mut canvas).clip(window));
    let inside = |x, y| (20..60).contains(&x) && (15..45).contains(&y);
    for (x, y) in (0..60).flat_map(|y| (0..80).map(move |x| (x, y))) {
        assert!(inside(x, y) || canvas.pixel(x, y) == Some(Color::WHITE), "({x}, {y})");
    }
}

#[test]
fn a_clip_rectangle_takes_nothing_from_what_is_inside_of_it() {
    let [mut cut, mut whole] = [white(80, 60), white(80, 60)];
    draw_all_kinds(&mut View::new(&mut cut).clip(Rectangle::new(20, 15, 40, 30)));
    draw_all_kinds(&mut whole);
    let differ = |x, y| {
        let [a, b] = [&cut, &whole].map(|canvas| canvas.pixel(x, y).unwrap());
        // Edges of what is cut are rounded anew, and joints of lines are flat.
        a.r.abs_diff(b.r).max(a.g.abs_diff(b.g)).max(a.b.abs_diff(b.b)) > 16
    };
    let count = (15..45).flat_map(|y| (20..60).map(move |x| (x, y))).filter(|&(x, y)| differ(x, y)).count();
    assert!(count <= 12, "{count} of 1,200 px");
}

#[test]
fn a_camera_moves_and_enlarges_what_a_batch_draws() {
    let mut canvas = white(40, 40);
    let mut batch = SpriteBatch::begin_with(&Transform::camera([100.0, 100.0], 2.0, 0.0, [20.0, 20.0]));
    batch.draw(Sprite::polygon([[100.0, 100.0], [105.0, 100.0], [105.0, 103.0], [100.0, 103.0]], RED));
    batch.end(&mut canvas);
    for (x, y) in (0..40).flat_map(|y| (0..40).map(move |x| (x, y))) {
        let inside = (20..30).contains(&x) && (20..26).contains(&y);
        assert_eq!(canvas.pixel(x, y), Some(if inside { RED } else { Color::WHITE }), "({x}, {y})");
    }
}

#[test]
fn a_view_shows_the_part_of_the_scene_that_its_camera_takes_into_its_window() {
    let mut canvas = white(200, 100);
    let camera = Transform::camera([500.0, 50.0], 2.0, 0.0, [150.0, 50.0]);
    let view = View::new(&mut canvas).camera(&camera).clip(Rectangle::new(100, 0, 100, 100));
    assert_eq!(view.visible_area(), [[475.0, 25.0], [525.0, 75.0]]);
}

#[test]
fn a_camera_without_an_area_draws_nothing() {
    let mut canvas = white(80, 60);
    for zoom in [0.0, f32::NAN] {
        let camera = Transform::camera([0.0; 2], zoom, 0.0, [40.0, 30.0]);
        let mut batch = SpriteBatch::begin_with(&camera);
        batch.draw(Sprite::new(&Texture2D::ball(24, RED).unwrap(), [0.0, 0.0]));
        batch.end(&mut canvas);
        let mut view = View::new(&mut canvas).camera(&camera);
        draw_ground_backdrop(&mut view, &GroundBackdrop::new(30.0, 60.0)).unwrap();
    }
    assert_eq!(canvas, white(80, 60));
}

/// Cells of 2 x 2 px in one row: red, green.
fn sheet() -> Texture2D {
    let [red, green] = [[255, 0, 0, 255], [0, 255, 0, 255]];
    let row = [red, red, green, green].concat();
    Texture2D::from_rgba8(4, 2, [row.clone(), row].concat()).unwrap()
}

#[test]
fn a_source_rectangle_shows_its_cell_and_nothing_beside_it() {
    let mut canvas = white(40, 40);
    let mut batch = SpriteBatch::begin();
    let cell = Sprite::part(&sheet(), Rectangle::cell(1, 2, 2, 2), [10.0, 10.0]);
    batch.draw(Sprite { scale: [8.0, 8.0], ..cell });
    batch.end(&mut canvas);
    for (x, y) in (0..40).flat_map(|y| (0..40).map(move |x| (x, y))) {
        let inside = (10..26).contains(&x) && (10..26).contains(&y);
        let expected = if inside { Color::rgb(0, 255, 0) } else { Color::WHITE };
        assert_eq!(canvas.pixel(x, y), Some(expected), "({x}, {y})");
    }
}

#[test]
fn a_source_rectangle_outside_of_the_texture_shows_nothing() {
    assert_eq!(sheet().part(Rectangle::new(4, 0, 2, 2)), None);
    assert_eq!(sheet().part(Rectangle::new(3, 1, 9, 9)).map(|part| part.width()), Some(1));
}

#[test]
fn a_text_turned_by_a_quarter_runs_down() {
    let mut canvas = white(60, 60);
    Text { rotation: FRAC_PI_2, scale: [2.0, 2.0], color: RED, ..Text::new("ll", [40.0, 10.0]) }
        .draw(&mut canvas);
    let mut upright = white(60, 60);
    Text { scale: [2.0, 2.0], color: RED, ..Text::new("ll", [10.0, 20.0]) }.draw(&mut upright);
    // (x, y) of the upright text goes to (40 - (y - 20), 10 + (x - 10)), pixel for pixel.
    for (x, y) in (0..16).flat_map(|y| (0..32).map(move |x| (x, y))) {
        assert_eq!(canvas.pixel(39 - y, 10 + x), upright.pixel(10 + x, 20 + y), "({x}, {y})");
    }
}

#[test]
fn texts_and_sprites_are_sorted_together() {
    let mut canvas = white(20, 20);
    let mut batch = SpriteBatch::begin();
    batch.draw_string(Text { layer_depth: 0.5, ..Text::new("MMMM", [0.0, 0.0]) });
    let cover = Sprite::polygon([[0.0, 0.0], [20.0, 0.0], [20.0, 20.0], [0.0, 20.0]], RED);
    batch.draw(Sprite { layer_depth: 0.25, ..cover });
    batch.end(&mut canvas);
    assert!(canvas.rgba8().chunks(4).all(|pixel| pixel == [255, 0, 0, 255]));
}

#[test]
fn a_text_in_its_middle_leaves_as_much_to_the_left_as_to_the_right() {
    let text = Text::centered("abc\nd", [50.0, 50.0]);
    assert_eq!((text.size(), text.origin), ([24.0, 16.0], [12.0, 8.0]));
}

#[test]
fn a_backdrop_seen_through_a_camera_covers_all_of_its_window() {
    let mut canvas = white(120, 80);
    let camera = Transform::camera([1234.5, 30.3], 0.37, 0.2, [60.0, 40.0]);
    let mut view = View::new(&mut canvas).camera(&camera);
    let backdrop = GroundBackdrop { lines: Color::TRANSPARENT, ..GroundBackdrop::new(50.0, 60.0) };
    draw_ground_backdrop(&mut view, &backdrop).unwrap();
    assert!(canvas.rgba8().chunks(4).all(|pixel| pixel != [255, 255, 255, 255]));
}

#[test]
fn what_is_seen_of_a_view_of_a_view_is_what_is_seen_through_both() {
    let mut canvas = white(100, 80);
    let mut outer = View::new(&mut canvas).camera(&Transform::translation([-300.0, 40.0]));
    let moved = Transform::translation([7.0, -2.0]);
    let inner = View::new(&mut outer).camera(&moved);
    assert_eq!(inner.visible_area(), [[293.0, -38.0], [393.0, 42.0]]);
    let cut = View::new(&mut outer).camera(&moved).clip(Rectangle::new(320, 0, 500, 500));
    assert_eq!(cut.visible_area(), [[313.0, 2.0], [393.0, 42.0]]);
}
