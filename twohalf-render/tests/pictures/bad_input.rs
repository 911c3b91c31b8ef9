//! Bad input gives an error or draws nothing; nothing panics.

use twohalf_render::*;

const RED: Color = Color::rgb(255, 0, 0);

/// Sizes that no picture can have.
const BAD_SIZES: [(u32, u32); 6] =
    [(0, 0), (0, 10), (10, 0), (u32::MAX, 1), (1, u32::MAX), (MAX_SIDE, MAX_SIDE)];

fn is_refused<T>(result: Result<T>) -> bool {
    matches!(result, Err(RenderError::InvalidArgument { .. }))
}

/// Draws on a white canvas and says whether that changed anything.
fn changes(draw: impl FnOnce(&mut SoftwareCanvas)) -> bool {
    let mut canvas = SoftwareCanvas::new(30, 20).unwrap();
    canvas.clear(Color::WHITE);
    let before = canvas.rgba8();
    draw(&mut canvas);
    canvas.rgba8() != before
}

#[test]
fn pictures_without_area_or_of_absurd_size_are_refused() {
    for (width, height) in BAD_SIZES {
        assert!(is_refused(SoftwareCanvas::new(width, height)), "canvas {width} x {height}");
        assert!(is_refused(Texture2D::shadow(width, height)), "shadow {width} x {height}");
        assert!(is_refused(Texture2D::crate_box(width, height, RED)), "crate {width} x {height}");
        assert!(is_refused(Texture2D::from_rgba8(width, height, vec![0; 4])), "{width} x {height}");
    }
    for diameter in [0, MAX_SIDE, u32::MAX] {
        assert!(is_refused(Texture2D::ball(diameter, RED)), "ball {diameter}");
        assert!(is_refused(Texture2D::ball_light(diameter)), "light {diameter}");
    }
}

#[test]
fn shadows_of_boxes_with_bad_numbers_are_refused() {
    for angle in [0.0, 180.0, -45.0, f32::NAN, f32::INFINITY] {
        assert!(is_refused(Texture2D::box_shadow(10, 10, angle)), "{angle}");
    }
    assert!(is_refused(Texture2D::box_shadow(0, 10, 60.0)));
    assert!(is_refused(Texture2D::box_shadow(10, 0, 60.0)));
    assert!(is_refused(Texture2D::box_shadow(10, 1000, f32::MIN_POSITIVE)), "leans without end");
}

#[test]
fn the_smallest_generated_textures_exist() {
    for (width, height) in [(1, 1), (1, 7), (9, 1), (2, 3)] {
        assert!(Texture2D::shadow(width, height).is_ok());
        assert!(Texture2D::crate_box(width, height, RED).is_ok());
        assert!(Texture2D::ball(width, RED).is_ok());
    }
}

#[test]
fn pixels_that_do_not_fit_the_size_are_refused() {
    assert!(is_refused(Texture2D::from_rgba8(2, 2, vec![0; 15])));
    assert!(is_refused(Texture2D::from_rgba8(2, 2, vec![0; 17])));
}

#[test]
fn bytes_that_are_no_picture_are_refused() {
    for bytes in [&b""[..], b"GIF89a", &[137, 80, 78, 71, 13, 10, 26, 10, 0, 0]] {
        assert!(matches!(Texture2D::decode_png(bytes), Err(RenderError::DecodePng { .. })));
    }
}

#[test]
fn a_picture_that_announces_an_absurd_size_is_refused() {
    let mut bytes = Vec::new();
    // Only the header; dropping the writer ends the file.
    drop(png::Encoder::new(&mut bytes, 2_000_000, 2_000_000).write_header().unwrap());
    assert!(matches!(Texture2D::decode_png(&bytes), Err(RenderError::DecodePng { .. })));
}

#[test]
fn shapes_with_bad_numbers_draw_nothing() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30] {
        let moved = Transform::translation([bad, 0.0]);
        let none = Transform::IDENTITY;
        assert!(!changes(|c| c.fill_rectangle([bad, 0.0], [5.0, 5.0], &none, RED)), "{bad}");
        assert!(!changes(|c| c.fill_rectangle([0.0, 0.0], [bad, 5.0], &none, RED)), "{bad}");
        assert!(!changes(|c| c.fill_rectangle([0.0, 0.0], [5.0, 5.0], &moved, RED)), "{bad}");
        assert!(!changes(|c| c.fill_ellipse([bad, 9.0], [5.0, 5.0], &none, RED)), "{bad}");
        assert!(!changes(|c| c.fill_ellipse([9.0, 9.0], [5.0, bad], &none, RED)), "{bad}");
        assert!(!changes(|c| c.fill_ellipse([9.0, 9.0], [5.0, 5.0], &moved, RED)), "{bad}");
        let triangle = [[0.0, 0.0], [bad, 10.0], [10.0, 0.0]];
        assert!(!changes(|c| c.fill_polygon(&triangle, &none, RED)), "{bad}");
        assert!(!changes(|c| c.stroke_polyline(&triangle, true, 2.0, &none, RED)), "{bad}");
        assert!(!changes(|c| c.stroke_polyline(&[[0.0, 0.0], [9.0, 9.0]], true, bad, &none, RED)), "{bad}");
    }
}

#[test]
fn shapes_without_area_draw_nothing() {
    let none = Transform::IDENTITY;
    assert!(!changes(|c| c.fill_rectangle([5.0, 5.0], [0.0, 5.0], &none, RED)));
    assert!(!changes(|c| c.fill_rectangle([9.0, 9.0], [-4.0, 5.0], &none, RED)));
    assert!(!changes(|c| c.fill_ellipse([9.0, 9.0], [0.0, 5.0], &none, RED)));
    assert!(!changes(|c| c.fill_ellipse([9.0, 9.0], [5.0, -5.0], &none, RED)));
    assert!(!changes(|c| c.fill_polygon(&[], &none, RED)));
    assert!(!changes(|c| c.fill_polygon(&[[0.0, 0.0], [9.0, 9.0]], &none, RED)));
    assert!(!changes(|c| c.fill_polygon(&[[0.0, 0.0], [9.0, 9.0], [4.5, 4.5]], &none, RED)));
    assert!(!changes(|c| c.fill_rectangle([1.0, 1.0], [5.0, 5.0], &Transform::scaling([0.0, 1.0]), RED)));
    assert!(!changes(|c| c.stroke_polyline(&[], true, 2.0, &none, RED)));
    assert!(!changes(|c| c.stroke_polyline(&[[1.0, 1.0]], true, 2.0, &none, RED)));
    assert!(!changes(|c| c.stroke_polyline(&[[1.0, 1.0], [9.0, 9.0]], true, 0.0, &none, RED)));
    assert!(!changes(|c| c.stroke_polyline(&[[1.0, 1.0], [9.0, 9.0]], true, -2.0, &none, RED)));
}

#[test]
fn sprites_with_bad_numbers_draw_nothing() {
    let texture = Texture2D::crate_box(10, 10, RED).unwrap();
    let good = Sprite::new(&texture, [5.0, 5.0]);
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let sprites = [
            Sprite { position: [bad, 5.0], ..good.clone() },
            Sprite { origin: [0.0, bad], ..good.clone() },
            Sprite { scale: [bad, 1.0], ..good.clone() },
            Sprite { rotation: bad, ..good.clone() },
            Sprite { layer_depth: bad, ..good.clone() },
            Sprite { slant: [0.0, bad], ..good.clone() },
            Sprite { clip: Some(vec![[0.0, 0.0], [20.0, bad], [0.0, 20.0]]), ..good.clone() },
            Sprite::polygon([[0.0, 0.0], [20.0, bad], [0.0, 20.0]], RED),
        ];
        for sprite in sprites {
            let mut batch = SpriteBatch::begin();
            batch.draw(sprite.clone());
            assert!(!changes(|canvas| batch.end(canvas)), "{sprite:?}");
        }
    }
    let mut batch = SpriteBatch::begin();
    batch.draw(Sprite { scale: [0.0, 0.0], ..good.clone() });
    batch.draw(Sprite { tint: Color::WHITE.with_alpha(0), ..good.clone() });
    batch.draw(Sprite { clip: Some(vec![]), ..good.clone() });
    batch.draw(Sprite { clip: Some(vec![[0.0, 0.0], [20.0, 20.0]]), ..good.clone() });
    batch.draw(Sprite::polygon([], RED));
    batch.draw(Sprite::polygon([[3.0, 4.0]; 3], RED));
    assert!(!changes(|canvas| batch.end(canvas)));

    let mut batch = SpriteBatch::begin();
    batch.draw(good);
    assert!(changes(|canvas| batch.end(canvas)), "a good sprite is seen");
}

#[test]
fn text_of_scale_zero_or_at_a_bad_place_draws_nothing() {
    assert!(!changes(|c| draw_text(c, "abc", [0.0, 0.0], 0, RED)));
    assert!(!changes(|c| draw_text(c, "abc", [0.0, 0.0], u32::MAX, RED)));
    assert!(!changes(|c| draw_text(c, "abc", [f32::NAN, 0.0], 1, RED)));
    assert!(changes(|c| draw_text(c, "abc", [0.0, 0.0], 1, RED)));
}

#[test]
fn a_backdrop_with_bad_numbers_is_refused_and_draws_nothing() {
    let good = GroundBackdrop::new(15.0, 60.0);
    let bad = [f32::NAN, f32::INFINITY, 0.0, -1.0];
    let mut backdrops: Vec<GroundBackdrop> = Vec::new();
    for value in bad {
        backdrops.push(GroundBackdrop { depth: value, ..good.clone() });
        backdrops.push(GroundBackdrop { angle: value, ..good.clone() });
        backdrops.push(GroundBackdrop { spacing: value, ..good.clone() });
    }
    backdrops.push(GroundBackdrop { angle: 180.0, ..good.clone() });
    backdrops.push(GroundBackdrop { spacing: 1e-3, ..good });
    for backdrop in backdrops {
        assert!(!changes(|canvas| assert!(is_refused(draw_ground_backdrop(canvas, &backdrop)))));
    }
}

#[test]
fn backdrops_at_the_ends_of_their_ranges_are_drawn() {
    for angle in [f32::MIN_POSITIVE, 0.01, 3.0, 90.0, 177.0, 179.99] {
        for depth in [1e-3, 10.0, 20.0, 1e6] {
            for spacing in [4.0, 1e6] {
                let backdrop = GroundBackdrop { spacing, ..GroundBackdrop::new(depth, angle) };
                assert!(changes(|canvas| draw_ground_backdrop(canvas, &backdrop).unwrap()));
            }
        }
    }
}

/// Numbers of every size and sign, the awkward ones often; the same ones in every run.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        let bits = (self.0 >> 32) as u32;
        match bits % 8 {
            0 => f32::from_bits(bits.rotate_left(13)),
            1 => [0.0, -0.0, 1e6, -1e6, 1e-30, f32::NAN, f32::INFINITY, 0.5][(bits >> 8) as usize % 8],
            2 => (bits >> 8) as f32 / 10.0,
            _ => (bits >> 8) as f32 / 1e5 - 60.0,
        }
    }

    fn pair(&mut self) -> [f32; 2] {
        [self.next(), self.next()]
    }

    fn transform(&mut self) -> Transform {
        match self.next() {
            n if n < 0.0 => Transform::IDENTITY,
            n if n < 40.0 => Transform::rotation(self.next()).then(&Transform::translation(self.pair())),
            _ => Transform { x_axis: self.pair(), y_axis: self.pair(), translation: self.pair() },
        }
    }
}

#[test]
fn no_numbers_whatever_make_drawing_panic() {
    let mut canvas = SoftwareCanvas::new(64, 48).unwrap();
    let textures = [Texture2D::ball(9, RED).unwrap(), Texture2D::crate_box(1, 30, RED).unwrap()];
    let mut numbers = Numbers(1);
    for index in 0..20_000 {
        let points: Vec<Point> = (0..index % 6).map(|_| numbers.pair()).collect();
        let transform = numbers.transform();
        let color = Color::rgba(10, 200, 30, (index % 256) as u8);
        canvas.fill_polygon(&points, &transform, color);
        canvas.stroke_polyline(&points, index % 2 == 0, numbers.next(), &transform, color);
        canvas.fill_ellipse(numbers.pair(), numbers.pair(), &transform, color);
        canvas.fill_rectangle(numbers.pair(), numbers.pair(), &transform, color);
        let clip = (index % 3 > 0).then_some(&points[..]);
        canvas.draw_texture(&textures[index % 2], &transform, color, clip);
    }
    assert!(canvas.pixel(0, 0).is_some());
}

#[test]
fn walls_of_bad_bricks_are_refused() {
    for brick in [[0, 10], [10, 3], [u32::MAX, 10]] {
        assert!(is_refused(Texture2D::bricks(brick, [4, 4], RED)), "{brick:?}");
        assert!(is_refused(Texture2D::paving(brick, [4, 4], RED)), "{brick:?}");
    }
    for count in [[0, 4], [4, 0], [u32::MAX, 4], [5000, 5000]] {
        assert!(is_refused(Texture2D::bricks([10, 10], count, RED)), "{count:?}");
    }
}

#[test]
fn a_wall_goes_on_where_it_is_repeated() {
    let wall = Texture2D::bricks([16, 8], [3, 4], RED).unwrap();
    // Joints run along the edges of the texture: the dark line between two rows, all along.
    for x in 0..48 {
        let [first, last] = [0, 31].map(|y| wall.pixel(x, y).unwrap().r);
        assert!(first < 200 && last < 200, "{x}: {first}, {last}");
    }
    // Of shifted rows the brick that is cut is the same at both sides.
    let [left, right] = [2, 45].map(|x| wall.pixel(x, 12).unwrap());
    assert_eq!(left, right);
}
