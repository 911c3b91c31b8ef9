//! What is written can be read back.

use std::fs::File;
use std::io::BufReader;
use std::path::PathBuf;

use png::{BlendOp, Decoder, Reader};
use twohalf_render::*;

fn file(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name)
}

/// A square that moves over a backdrop.
fn frame(index: u32) -> SoftwareCanvas {
    let mut canvas = SoftwareCanvas::new(120, 80).unwrap();
    draw_ground_backdrop(&mut canvas, &GroundBackdrop::new(50.0, 60.0)).unwrap();
    let corner = [10.0 + 7.0 * index as f32, 30.0 + 3.0 * index as f32];
    canvas.fill_rectangle(corner, [12.0, 9.0], &Transform::IDENTITY, Color::rgb(200, 20, 20));
    canvas
}

fn write_animation(name: &str, frames: &[SoftwareCanvas], delay_ms: u16) -> PathBuf {
    let path = file(name);
    let [width, height] = frames[0].size();
    let mut animation = Animation::create(&path, width, height, frames.len() as u32, delay_ms).unwrap();
    frames.iter().for_each(|frame| animation.add_frame(frame).unwrap());
    animation.finish().unwrap();
    path
}

fn open(path: &PathBuf) -> Reader<BufReader<File>> {
    Decoder::new(BufReader::new(File::open(path).unwrap())).read_info().unwrap()
}

/// Adds the next frame to what is shown, as a viewer does (opaque pixels only).
fn show_next(reader: &mut Reader<BufReader<File>>, shown: &mut [u8]) {
    let width = reader.info().width as usize;
    let mut data = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut data).unwrap();
    let control = *reader.info().frame_control().unwrap();
    let (left, top) = (control.x_offset as usize, control.y_offset as usize);
    for (i, pixel) in data.chunks_exact(4).take((control.width * control.height) as usize).enumerate() {
        let (x, y) = (left + i % control.width as usize, top + i / control.width as usize);
        if control.blend_op == BlendOp::Source || pixel[3] == 255 {
            shown[4 * (y * width + x)..][..4].copy_from_slice(pixel);
        }
    }
}

#[test]
fn an_animation_has_the_frames_and_the_delay_asked_for_and_loops_for_ever() {
    let frames: Vec<_> = (0..5).map(frame).collect();
    let path = write_animation("animation/counted.png", &frames, 40);
    let mut reader = open(&path);
    let control = *reader.info().animation_control().unwrap();
    assert_eq!((control.num_frames, control.num_plays), (5, 0));
    let mut data = vec![0; reader.output_buffer_size().unwrap()];
    for _ in 0..5 {
        reader.next_frame(&mut data).unwrap();
        let frame = reader.info().frame_control().unwrap();
        assert_eq!((frame.delay_num, frame.delay_den), (40, 1000));
    }
    assert!(reader.next_frame(&mut data).is_err(), "there is no sixth frame");
}

#[test]
fn a_viewer_shows_every_frame_of_an_animation_as_it_was_drawn() {
    let mut frames: Vec<_> = (0..4).map(frame).collect();
    frames.insert(2, frames[1].clone());
    let mut reader = open(&write_animation("animation/shown.png", &frames, 20));
    let mut shown = vec![0; 120 * 80 * 4];
    for (index, frame) in frames.iter().enumerate() {
        show_next(&mut reader, &mut shown);
        assert!(shown == frame.rgba8(), "frame {index}");
    }
}

#[test]
fn translucent_changes_replace_what_an_animation_showed() {
    let mut frames = vec![SoftwareCanvas::new(20, 20).unwrap(), SoftwareCanvas::new(20, 20).unwrap()];
    frames[0].clear(Color::rgb(200, 0, 0));
    frames[1].clear(Color::rgb(200, 0, 0));
    frames[1].clear(Color::rgba(0, 0, 200, 100));
    let mut reader = open(&write_animation("animation/translucent.png", &frames, 20));
    let mut shown = vec![0; 20 * 20 * 4];
    show_next(&mut reader, &mut shown);
    show_next(&mut reader, &mut shown);
    assert!(shown == frames[1].rgba8());
}

#[test]
fn a_frame_too_many_is_refused() {
    let mut animation = Animation::create(file("too_many.png"), 120, 80, 1, 20).unwrap();
    animation.add_frame(&frame(0)).unwrap();
    assert!(matches!(animation.add_frame(&frame(1)), Err(RenderError::InvalidArgument { .. })));
    animation.finish().unwrap();
}

#[test]
fn an_animation_that_lacks_frames_cannot_be_finished() {
    let mut animation = Animation::create(file("too_few.png"), 120, 80, 3, 20).unwrap();
    animation.add_frame(&frame(0)).unwrap();
    assert!(matches!(animation.finish(), Err(RenderError::InvalidArgument { argument: "frames", .. })));
}

#[test]
fn a_frame_of_another_size_is_refused() {
    let mut animation = Animation::create(file("other_size.png"), 100, 80, 1, 20).unwrap();
    assert!(matches!(animation.add_frame(&frame(0)), Err(RenderError::InvalidArgument { .. })));
}

#[test]
fn an_animation_without_frames_or_size_is_refused() {
    for (width, height, frames) in [(0, 80, 1), (80, 0, 1), (80, 80, 0), (u32::MAX, 80, 1)] {
        let created = Animation::create(file("refused.png"), width, height, frames, 20);
        assert!(matches!(created, Err(RenderError::InvalidArgument { .. })), "{width} {height} {frames}");
    }
}

#[test]
fn a_contact_sheet_is_as_large_as_its_grid() {
    let mut sheet = ContactSheet::new(3, 2).unwrap();
    (0..4).for_each(|index| sheet.add(&frame(index), format!("step {index}")));
    // Cells of 60 x (40 + 24) px, gaps of 8 px.
    assert_eq!(sheet.render().unwrap().size(), [3 * 60 + 4 * 8, 2 * 64 + 3 * 8]);
}

#[test]
fn a_contact_sheet_shows_its_stills_in_reading_order() {
    let colors = [Color::rgb(250, 0, 0), Color::rgb(0, 250, 0), Color::rgb(0, 0, 250)];
    let mut sheet = ContactSheet::new(2, 1).unwrap();
    for color in colors {
        let mut canvas = SoftwareCanvas::new(40, 30).unwrap();
        canvas.clear(color);
        sheet.add(&canvas, "");
    }
    let picture = sheet.render().unwrap();
    let middles = [(8 + 20, 8 + 24 + 15), (56 + 20, 8 + 24 + 15), (8 + 20, 70 + 24 + 15)];
    for ((x, y), color) in middles.into_iter().zip(colors) {
        assert_eq!(picture.pixel(x, y), Some(color));
    }
}

#[test]
fn a_shrunk_still_has_the_mean_of_its_pixels() {
    let mut canvas = SoftwareCanvas::new(40, 40).unwrap();
    canvas.clear(Color::WHITE);
    for x in (0..40).step_by(2) {
        canvas.fill_rectangle([x as f32, 0.0], [1.0, 40.0], &Transform::IDENTITY, Color::BLACK);
    }
    let mut sheet = ContactSheet::new(1, 2).unwrap();
    sheet.add(&canvas, "");
    let grey = sheet.render().unwrap().pixel(18, 42).unwrap();
    assert!(grey.r.abs_diff(128) <= 1, "{grey:?}");
}

#[test]
fn an_empty_contact_sheet_and_bad_grids_are_refused() {
    assert!(ContactSheet::new(0, 1).is_err());
    assert!(ContactSheet::new(1, 0).is_err());
    assert!(ContactSheet::new(1, 65).is_err());
    assert!(ContactSheet::new(u32::MAX, 1).unwrap().render().is_err());
}

#[test]
fn a_canvas_is_read_back_as_it_was_written() {
    let path = file("deep/er/canvas.png");
    frame(2).save_png(&path).unwrap();
    let texture = Texture2D::load_png(&path).unwrap();
    assert_eq!((texture.width(), texture.height()), (120, 80));
    assert!(texture.rgba8() == frame(2).rgba8());
}

#[test]
fn a_texture_keeps_every_translucent_bit_through_a_file() {
    let pixels: Vec<u8> = (0..=255u8).flat_map(|i| [i, 255 - i, i / 2, i]).collect();
    let texture = Texture2D::from_rgba8(16, 16, pixels).unwrap();
    let path = file("translucent.png");
    texture.save_png(&path).unwrap();
    assert!(Texture2D::load_png(&path).unwrap() == texture);
}

#[test]
fn pictures_of_every_colour_type_are_understood() {
    use png::{BitDepth, ColorType};
    let cases: [(ColorType, BitDepth, &[u8], Color); 5] = [
        (ColorType::Grayscale, BitDepth::Eight, &[90], Color::rgb(90, 90, 90)),
        (ColorType::Grayscale, BitDepth::Sixteen, &[90, 200], Color::rgb(90, 90, 90)),
        (ColorType::GrayscaleAlpha, BitDepth::Eight, &[90, 40], Color::rgba(90, 90, 90, 40)),
        (ColorType::Rgb, BitDepth::Eight, &[1, 2, 3], Color::rgb(1, 2, 3)),
        (ColorType::Indexed, BitDepth::Eight, &[1], Color::rgb(7, 8, 9)),
    ];
    for (color_type, depth, data, expected) in cases {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 1, 1);
        encoder.set_color(color_type);
        encoder.set_depth(depth);
        if color_type == ColorType::Indexed {
            encoder.set_palette(vec![0, 0, 0, 7, 8, 9]);
        }
        encoder.write_header().unwrap().write_image_data(data).unwrap();
        let texture = Texture2D::decode_png(&bytes).unwrap();
        assert_eq!(texture.pixel(0, 0), Some(expected), "{color_type:?} {depth:?}");
    }
}

#[test]
fn errors_name_the_file() {
    let missing = file("no/such/picture.png");
    let error = Texture2D::load_png(&missing).unwrap_err();
    assert!(error.to_string().contains(missing.to_str().unwrap()), "{error}");

    // A file where a folder is needed.
    let blocker = file("blocker");
    std::fs::write(&blocker, "not a folder").unwrap();
    let error = frame(0).save_png(blocker.join("below.png")).unwrap_err();
    assert!(error.to_string().contains("below.png"), "{error}");

    let error = Texture2D::load_png(&blocker).unwrap_err();
    assert!(matches!(&error, RenderError::DecodePng { name, .. } if name.contains("blocker")), "{error}");
}
