//! What ends up in which pixel.

use std::f32::consts::FRAC_PI_2;

use twohalf_render::*;

const RED: Color = Color::rgb(255, 0, 0);
const GREEN: Color = Color::rgb(0, 255, 0);
const BLUE: Color = Color::rgb(0, 0, 255);

fn white_canvas(width: u32, height: u32) -> SoftwareCanvas {
    let mut canvas = SoftwareCanvas::new(width, height).unwrap();
    canvas.clear(Color::WHITE);
    canvas
}

fn solid(width: u32, height: u32, c: Color) -> Texture2D {
    let pixels = [c.r, c.g, c.b, c.a].repeat((width * height) as usize);
    Texture2D::from_rgba8(width, height, pixels).unwrap()
}

/// Red above green on the left, white above blue on the right, each 10 x 10 px.
fn four_fields() -> Texture2D {
    let pixels = (0..400).flat_map(|i| match (i % 20 < 10, i / 20 < 10) {
        (true, true) => [255, 0, 0, 255],
        (true, false) => [0, 255, 0, 255],
        (false, true) => [255, 255, 255, 255],
        (false, false) => [0, 0, 255, 255],
    });
    Texture2D::from_rgba8(20, 20, pixels.collect()).unwrap()
}

fn assert_only_filled(canvas: &SoftwareCanvas, inside: impl Fn(u32, u32) -> bool, color: Color) {
    for y in 0..canvas.height() {
        for x in 0..canvas.width() {
            let expected = if inside(x, y) { color } else { Color::WHITE };
            assert_eq!(canvas.pixel(x, y), Some(expected), "pixel ({x}, {y})");
        }
    }
}

#[test]
fn a_filled_rectangle_covers_exactly_its_pixels() {
    let mut canvas = white_canvas(20, 15);
    canvas.fill_rectangle([3.0, 5.0], [7.0, 4.0], &Transform::IDENTITY, RED);
    assert_only_filled(&canvas, |x, y| (3..10).contains(&x) && (5..9).contains(&y), RED);
}

#[test]
fn a_transform_moves_and_scales_a_rectangle() {
    let mut canvas = white_canvas(20, 15);
    let transform = Transform::scaling([2.0, 3.0]).then(&Transform::translation([4.0, 1.0]));
    canvas.fill_rectangle([1.0, 1.0], [3.0, 2.0], &transform, RED);
    assert_only_filled(&canvas, |x, y| (6..12).contains(&x) && (4..10).contains(&y), RED);
}

#[test]
fn translucent_colours_blend_with_what_is_below() {
    let mut canvas = white_canvas(4, 4);
    canvas.fill_rectangle([0.0, 0.0], [4.0, 4.0], &Transform::IDENTITY, RED.with_alpha(128));
    assert_eq!(canvas.pixel(1, 1), Some(Color::rgb(255, 127, 127)));
}

#[test]
fn an_ellipse_fills_its_middle_and_leaves_the_corners_of_its_box() {
    let mut canvas = white_canvas(40, 20);
    canvas.fill_ellipse([20.0, 10.0], [18.0, 8.0], &Transform::IDENTITY, BLUE);
    for (x, y) in [(20, 10), (3, 10), (36, 10), (20, 3), (20, 16)] {
        assert_eq!(canvas.pixel(x, y), Some(BLUE), "({x}, {y})");
    }
    for (x, y) in [(1, 10), (3, 3), (36, 3), (3, 16), (36, 16), (20, 1)] {
        assert_eq!(canvas.pixel(x, y), Some(Color::WHITE), "({x}, {y})");
    }
}

#[test]
fn a_concave_polygon_leaves_its_notch_open() {
    let mut canvas = white_canvas(20, 20);
    let arrow = [[2.0, 2.0], [18.0, 2.0], [18.0, 18.0], [10.0, 6.0], [2.0, 18.0]];
    canvas.fill_polygon(&arrow, &Transform::IDENTITY, GREEN);
    assert_eq!(canvas.pixel(10, 4), Some(GREEN));
    assert_eq!(canvas.pixel(10, 14), Some(Color::WHITE));
}

#[test]
fn a_line_has_its_width_in_canvas_pixels_whatever_the_transform() {
    let mut canvas = white_canvas(20, 20);
    let transform = Transform::scaling([5.0, 5.0]);
    canvas.stroke_polyline(&[[1.0, 2.0], [3.0, 2.0]], false, 4.0, &transform, RED);
    assert_only_filled(&canvas, |x, y| (5..15).contains(&x) && (8..12).contains(&y), RED);
}

#[test]
fn only_a_closed_polyline_returns_to_its_first_point() {
    let corners = [[4.0, 4.0], [16.0, 4.0], [16.0, 16.0], [4.0, 16.0]];
    let left_side = |closed| {
        let mut canvas = white_canvas(20, 20);
        canvas.stroke_polyline(&corners, closed, 2.0, &Transform::IDENTITY, RED);
        canvas.pixel(4, 10)
    };
    assert_eq!(left_side(true), Some(RED));
    assert_eq!(left_side(false), Some(Color::WHITE));
}

#[test]
fn a_sprite_at_a_whole_position_is_copied_pixel_by_pixel() {
    let mut canvas = white_canvas(30, 30);
    let texture = four_fields();
    let mut batch = SpriteBatch::begin();
    batch.draw(Sprite::new(&texture, [5.0, 6.0]));
    batch.end(&mut canvas);
    for (x, y) in (0..20).flat_map(|x| (0..20).map(move |y| (x, y))) {
        assert_eq!(canvas.pixel(x + 5, y + 6), texture.pixel(x, y), "({x}, {y})");
    }
    assert_eq!(canvas.pixel(4, 10), Some(Color::WHITE));
    assert_eq!(canvas.pixel(25, 25), Some(Color::WHITE));
}

#[test]
fn sprites_are_drawn_back_to_front_whatever_the_order_of_the_calls() {
    let mut canvas = white_canvas(10, 10);
    let mut batch = SpriteBatch::begin();
    for (color, layer_depth) in [(RED, 0.5), (GREEN, 0.1), (BLUE, 0.9)] {
        batch.draw(Sprite { layer_depth, ..Sprite::new(&solid(10, 10, color), [0.0, 0.0]) });
    }
    batch.end(&mut canvas);
    assert_eq!(canvas.pixel(5, 5), Some(GREEN));
}

#[test]
fn sprites_of_equal_depth_keep_the_order_of_the_calls() {
    let mut canvas = white_canvas(10, 10);
    let mut batch = SpriteBatch::begin();
    for (color, layer_depth) in [(RED, 0.0), (GREEN, -0.0), (BLUE, 0.0)] {
        batch.draw(Sprite { layer_depth, ..Sprite::new(&solid(10, 10, color), [0.0, 0.0]) });
    }
    batch.end(&mut canvas);
    assert_eq!(canvas.pixel(5, 5), Some(BLUE));
}

#[test]
fn a_quarter_turn_of_a_sprite_is_clockwise_about_its_origin() {
    let mut canvas = white_canvas(40, 40);
    let mut batch = SpriteBatch::begin();
    batch.draw(Sprite { rotation: FRAC_PI_2, ..Sprite::centered(&four_fields(), [20.0, 20.0]) });
    batch.end(&mut canvas);
    // Before: red at the upper left, white upper right, green lower left, blue lower right.
    assert_eq!(canvas.pixel(25, 15), Some(RED), "upper left goes to the upper right");
    assert_eq!(canvas.pixel(15, 15), Some(GREEN), "lower left goes to the upper left");
    assert_eq!(canvas.pixel(15, 25), Some(BLUE), "lower right goes to the lower left");
    assert_eq!(canvas.pixel(25, 25), Some(Color::WHITE), "upper right goes to the lower right");
}

#[test]
fn a_negative_scale_mirrors_a_sprite() {
    let mut canvas = white_canvas(40, 40);
    let mut batch = SpriteBatch::begin();
    batch.draw(Sprite { scale: [-1.0, 1.0], ..Sprite::centered(&four_fields(), [20.0, 20.0]) });
    batch.end(&mut canvas);
    assert_eq!(canvas.pixel(25, 15), Some(RED));
    assert_eq!(canvas.pixel(15, 25), Some(BLUE));
}

#[test]
fn a_clipped_sprite_ends_where_its_polygon_ends() {
    let mut canvas = white_canvas(30, 30);
    let mut batch = SpriteBatch::begin();
    let clip = Some(vec![[10.0, 0.0], [40.0, 0.0], [40.0, 12.0], [10.0, 12.0]]);
    batch.draw(Sprite { clip, ..Sprite::new(&solid(20, 20, RED), [4.0, 4.0]) });
    batch.end(&mut canvas);
    assert_only_filled(&canvas, |x, y| (10..24).contains(&x) && (4..12).contains(&y), RED);
}

#[test]
fn a_clip_takes_nothing_from_what_is_inside_of_it() {
    let sprite = Sprite { rotation: 0.3, ..Sprite::centered(&four_fields(), [15.0, 14.0]) };
    let around = Some(vec![[-5.0, -5.0], [50.0, -5.0], [50.0, 50.0], [-5.0, 50.0]]);
    let [whole, clipped] = [None, around].map(|clip| {
        let mut canvas = white_canvas(30, 30);
        let mut batch = SpriteBatch::begin();
        batch.draw(Sprite { clip, ..sprite.clone() });
        batch.end(&mut canvas);
        canvas
    });
    for (x, y) in (0..30).flat_map(|x| (0..30).map(move |y| (x, y))) {
        let [a, b] = [&whole, &clipped].map(|canvas| canvas.pixel(x, y).unwrap());
        // The corners are computed once more, so smooth edges may differ in their last step.
        for (a, b) in [(a.r, b.r), (a.g, b.g), (a.b, b.b), (a.a, b.a)] {
            assert!(a.abs_diff(b) <= 1, "({x}, {y})");
        }
    }
}

#[test]
fn a_concave_clip_leaves_its_notch_open() {
    let mut canvas = white_canvas(20, 20);
    let mut batch = SpriteBatch::begin();
    let arrow = vec![[2.0, 2.0], [18.0, 2.0], [18.0, 18.0], [10.0, 6.0], [2.0, 18.0]];
    batch.draw(Sprite { clip: Some(arrow), ..Sprite::new(&solid(20, 15, GREEN), [0.0, 0.0]) });
    batch.end(&mut canvas);
    assert_eq!(canvas.pixel(10, 4), Some(GREEN));
    assert_eq!(canvas.pixel(10, 12), Some(Color::WHITE), "the notch");
    assert_eq!(canvas.pixel(3, 12), Some(GREEN));
    assert_eq!(canvas.pixel(3, 15), Some(Color::WHITE), "below the texture");
}

#[test]
fn a_polygon_as_a_sprite_has_its_colour_everywhere_and_is_sorted_with_the_others() {
    let mut canvas = white_canvas(20, 15);
    let mut batch = SpriteBatch::begin();
    let rectangle = [[3.0, 5.0], [10.0, 5.0], [10.0, 9.0], [3.0, 9.0]];
    batch.draw(Sprite { layer_depth: 0.2, ..Sprite::polygon(rectangle, RED) });
    batch.draw(Sprite { layer_depth: 0.3, ..Sprite::new(&solid(5, 3, BLUE), [4.0, 6.0]) });
    batch.end(&mut canvas);
    assert_only_filled(&canvas, |x, y| (3..10).contains(&x) && (5..9).contains(&y), RED);
}

#[test]
fn a_slant_lowers_a_sprite_by_its_distance_to_the_right_and_down() {
    let sprite = Sprite { slant: [0.5, 1.0], ..Sprite::centered(&four_fields(), [40.0, 30.0]) };
    let at = |point| sprite.transform().apply(point);
    assert_eq!(at([10.0, 10.0]), [40.0, 30.0], "the origin stays");
    assert_eq!(at([14.0, 10.0]), [44.0, 32.0]);
    assert_eq!(at([10.0, 14.0]), [40.0, 38.0]);
}

#[test]
fn a_tint_multiplies_colour_and_opacity() {
    let mut canvas = white_canvas(10, 10);
    let mut batch = SpriteBatch::begin();
    let tint = Color::rgba(255, 0, 102, 128);
    batch.draw(Sprite { tint, ..Sprite::new(&solid(10, 10, Color::rgb(100, 200, 255)), [0.0, 0.0]) });
    batch.end(&mut canvas);
    let c = canvas.pixel(5, 5).unwrap();
    // (100, 0, 102) at 128/255 over white.
    for (channel, expected) in [(c.r, 177u8), (c.g, 127), (c.b, 178)] {
        assert!(channel.abs_diff(expected) <= 1, "{c:?}");
    }
}

#[test]
fn a_shadow_is_densest_in_the_middle_and_fades_to_nothing() {
    let shadow = Texture2D::shadow(81, 41).unwrap();
    let alpha = |x, y| shadow.pixel(x, y).unwrap().a;
    let row: Vec<u8> = (40..81).map(|x| alpha(x, 20)).collect();
    let column: Vec<u8> = (20..41).map(|y| alpha(40, y)).collect();
    assert!(row[0] > 120, "{row:?}");
    assert!(row.windows(2).all(|pair| pair[1] <= pair[0]), "{row:?}");
    assert!(column.windows(2).all(|pair| pair[1] <= pair[0]), "{column:?}");
    assert!(row[20] < row[0] && row[35] < row[20]);
    assert_eq!(alpha(0, 0), 0);
    assert!(alpha(80, 20) < 4);
}

#[test]
fn the_shadow_of_a_box_has_the_shape_of_its_footprint() {
    let shadow = Texture2D::box_shadow(100, 60, 45.0).unwrap();
    assert_eq!([shadow.width(), shadow.height()], [100 + 60 + 16, 60 + 16]);
    let alpha = |x, y| shadow.pixel(x, y).unwrap().a;
    let full = alpha(88, 38);
    assert!(full > 100);
    // The footprint's far edge is 60 px farther to the right than the near one.
    for (x, y, inside) in [(30, 56, true), (145, 20, true), (20, 15, false), (150, 60, false)] {
        assert_eq!(alpha(x, y) == full, inside, "({x}, {y})");
        assert_eq!(alpha(x, y) == 0, !inside, "({x}, {y})");
    }
    // Half of it at the edge: 8 px from the upper side of the texture.
    assert!(alpha(100, 7) < full / 2 && alpha(100, 8) > full / 2);
}

#[test]
fn a_ball_is_opaque_in_its_circle_and_transparent_outside() {
    let ball = Texture2D::ball(60, Color::rgb(200, 50, 50)).unwrap();
    assert_eq!(ball.pixel(30, 30).unwrap().a, 255);
    assert_eq!(ball.pixel(30, 1).unwrap().a, 255);
    assert_eq!(ball.pixel(2, 2).unwrap().a, 0);
}

#[test]
fn no_turn_of_a_ball_up_to_a_whole_one_looks_like_no_turn() {
    let ball = Texture2D::ball(60, Color::rgb(200, 50, 50)).unwrap();
    let drawn = |rotation| {
        let mut canvas = white_canvas(60, 60);
        let mut batch = SpriteBatch::begin();
        batch.draw(Sprite { rotation, ..Sprite::centered(&ball, [30.0, 30.0]) });
        batch.end(&mut canvas);
        canvas.rgba8()
    };
    let still = drawn(0.0);
    for twelfth in 1..12 {
        let turned = drawn(twelfth as f32 * std::f32::consts::TAU / 12.0);
        let different = still.iter().zip(&turned).filter(|(a, b)| a.abs_diff(**b) > 40).count();
        assert!(different > 500, "{different} bytes differ after {twelfth}/12 of a turn");
    }
}

#[test]
fn the_light_on_a_ball_is_brighter_at_the_upper_left() {
    let mut canvas = SoftwareCanvas::new(60, 60).unwrap();
    canvas.clear(Color::rgb(128, 128, 128));
    let mut batch = SpriteBatch::begin();
    batch.draw(Sprite::new(&Texture2D::ball_light(60).unwrap(), [0.0, 0.0]));
    batch.end(&mut canvas);
    assert!(canvas.pixel(18, 14).unwrap().r > 150);
    assert!(canvas.pixel(44, 48).unwrap().r < 110);
}

#[test]
fn a_crate_fills_its_texture_and_has_a_dark_edge() {
    let texture = Texture2D::crate_box(90, 60, Color::rgb(180, 130, 70)).unwrap();
    assert!(texture.rgba8().chunks_exact(4).all(|pixel| pixel[3] == 255));
    assert!(texture.pixel(0, 30).unwrap().r < texture.pixel(5, 30).unwrap().r);
}

#[test]
fn a_text_sets_the_pixels_of_its_characters_scaled() {
    let mut canvas = white_canvas(24, 24);
    draw_text(&mut canvas, "|", [0.0, 0.0], 3, RED);
    // The font's bar is two columns (3 and 4) wide, with a gap in row 3 and an empty last row.
    let bar = |x: u32, y: u32| (9..15).contains(&x) && y / 3 != 3 && y / 3 != 7;
    assert_only_filled(&canvas, bar, RED);
}

#[test]
fn an_unknown_character_is_drawn_as_a_question_mark() {
    let drawn = |text| {
        let mut canvas = white_canvas(8, 8);
        draw_text(&mut canvas, text, [0.0, 0.0], 1, Color::BLACK);
        canvas.rgba8()
    };
    assert_eq!(drawn("\u{4e2d}"), drawn("?"));
}

#[test]
fn a_caption_changes_only_its_panel() {
    let mut canvas = white_canvas(200, 100);
    draw_caption(&mut canvas, "t = 1");
    assert_ne!(canvas.pixel(95, 31), Some(Color::WHITE));
    assert_eq!(canvas.pixel(96, 10), Some(Color::WHITE));
    assert_eq!(canvas.pixel(10, 32), Some(Color::WHITE));
}

/// Sum over a row of how much neighbouring pixels differ, as a measure for lines and tiles.
fn contrast(canvas: &SoftwareCanvas, y: u32) -> u32 {
    let red = |x| canvas.pixel(x, y).unwrap().r;
    (1..canvas.width()).map(|x| u32::from(red(x).abs_diff(red(x - 1)))).sum()
}

#[test]
fn the_floor_begins_at_the_horizon_and_loses_contrast_with_depth() {
    let mut canvas = SoftwareCanvas::new(400, 300).unwrap();
    draw_ground_backdrop(&mut canvas, &GroundBackdrop::new(200.0, 70.0)).unwrap();
    assert_eq!(contrast(&canvas, 60), 0, "sky");
    let [near, far] = [contrast(&canvas, 280), contrast(&canvas, 120)];
    assert!(far > 0 && near > 2 * far, "near {near}, far {far}");
}

#[test]
fn depth_lines_run_along_the_z_axis() {
    let mut canvas = SoftwareCanvas::new(400, 300).unwrap();
    let backdrop = GroundBackdrop { spacing: 100.0, ..GroundBackdrop::new(200.0, 45.0) };
    draw_ground_backdrop(&mut canvas, &backdrop).unwrap();
    // At 45 degrees the line that starts at X = 100 on the lower edge has moved Z px to the right at depth Z.
    for z in [30, 60, 130, 160] {
        let y = 300 - z;
        let brightness = |x: u32| u32::from(canvas.pixel(x, y).unwrap().r);
        let darkest = (100 + z - 20..100 + z + 20).min_by_key(|&x| brightness(x)).unwrap();
        assert!(darkest.abs_diff(100 + z) <= 1, "at depth {z} the line is at {darkest}");
    }
}

#[test]
fn canvases_too_wide_for_one_pass_are_drawn_without_seams() {
    // tiny-skia draws in tiles of 8191 px.
    let mut canvas = white_canvas(9000, 12);
    canvas.fill_rectangle([8100.0, 2.0], [200.0, 7.0], &Transform::IDENTITY, RED);
    assert_only_filled(&canvas, |x, y| (8100..8300).contains(&x) && (2..9).contains(&y), RED);
}

#[test]
fn a_sprite_across_the_middle_of_a_wide_canvas_is_whole() {
    let mut canvas = white_canvas(9000, 30);
    let mut batch = SpriteBatch::begin();
    batch.draw(Sprite::new(&four_fields(), [8186.0, 5.0]));
    batch.end(&mut canvas);
    let texture = four_fields();
    for (x, y) in (0..20).flat_map(|x| (0..20).map(move |y| (x, y))) {
        assert_eq!(canvas.pixel(x + 8186, y + 5), texture.pixel(x, y), "({x}, {y})");
    }
}
