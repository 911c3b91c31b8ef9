//! The gallery in a window, or on a page.

mod atlas;
mod canvas;
mod page;

use macroquad::prelude as quad;
use macroquad::prelude::KeyCode;

use crate::keys::{Key, KeySet};
use crate::scenes::GalleryScene;
use crate::viewer::{Input, Viewer};
use canvas::{Ink, ScreenCanvas};

/// Keys of a keyboard. Others may stand beside them in a game.
const KEYS: &[(KeyCode, Key)] = &[
    (KeyCode::Left, Key::Left),
    (KeyCode::A, Key::Left),
    (KeyCode::Right, Key::Right),
    (KeyCode::D, Key::Right),
    (KeyCode::Up, Key::Up),
    (KeyCode::W, Key::Up),
    (KeyCode::Down, Key::Down),
    (KeyCode::S, Key::Down),
    (KeyCode::Space, Key::Jump),
    (KeyCode::Enter, Key::Jump),
    (KeyCode::X, Key::Punch),
    (KeyCode::C, Key::Grab),
    (KeyCode::P, Key::Pause),
    (KeyCode::Period, Key::Step),
    (KeyCode::O, Key::Slow),
    (KeyCode::R, Key::Restart),
    (KeyCode::B, Key::Rewind),
    (KeyCode::M, Key::Methods),
    (KeyCode::Key1, Key::Outlines),
    (KeyCode::Key2, Key::Boxes),
    (KeyCode::Key3, Key::Contacts),
    (KeyCode::Key4, Key::Islands),
    (KeyCode::Key5, Key::Sleep),
    (KeyCode::Key6, Key::Joints),
    (KeyCode::G, Key::Graph),
    (KeyCode::H, Key::Help),
    (KeyCode::F1, Key::Help),
    (KeyCode::F, Key::Full),
    (KeyCode::F11, Key::Full),
    (KeyCode::Escape, Key::List),
    (KeyCode::PageUp, Key::Before),
    (KeyCode::PageDown, Key::After),
];

/// Opens a window with some scenes, and shows one of them; returns when it is closed. With a duration it prints the time of its
/// last frames at the end. Edges are smoothed with `samples` samples of each px.
pub fn open(scenes: Vec<GalleryScene>, first: usize, lasts: Option<f64>, samples: i32) {
    let window = macroquad::conf::Conf {
        miniquad_conf: macroquad::miniquad::conf::Conf {
            window_title: "twohalf".to_owned(),
            window_width: 1280,
            window_height: 760,
            high_dpi: true,
            sample_count: samples,
            ..Default::default()
        },
        draw_call_vertex_capacity: 10_000,
        draw_call_index_capacity: 15_000,
        ..Default::default()
    };
    macroquad::Window::from_config(window, run(scenes, first, lasts));
}

async fn run(scenes: Vec<GalleryScene>, first: usize, lasts: Option<f64>) {
    quad::simulate_mouse_with_touch(false);
    let mut viewer = match Viewer::new(scenes, first) {
        Ok(viewer) => viewer,
        Err(error) => return macroquad::miniquad::error!("{}", error),
    };
    let (mut ink, mut fingers, mut is_full) = (Ink::default(), Fingers::default(), false);
    let opened = quad::get_time();
    while lasts.is_none_or(|seconds| quad::get_time() - opened < seconds) {
        if page::rests() {
            quad::next_frame().await;
            continue;
        }
        let input = input(&mut fingers);
        open_dropped(&mut viewer);
        page::meet(&mut viewer);
        if page::has_left_full() {
            viewer.leave_full();
            is_full = false;
        }
        viewer.frame(&input, &quad::get_time);
        if viewer.is_full() != is_full {
            is_full = viewer.is_full();
            quad::set_fullscreen(is_full);
        }
        let start = quad::get_time();
        let mut canvas = ScreenCanvas::new(&mut ink, input.size);
        if let Err(error) = viewer.draw(&mut canvas) {
            viewer.say(error.to_string());
        }
        canvas.end();
        viewer.drawn_in(quad::get_time() - start);
        quad::next_frame().await;
    }
    let [frame, steps, drawing] = viewer.times();
    let name = &viewer.scenes()[viewer.at()].name;
    println!("{name:14} frame {frame:7.2} ms, steps {steps:7.2} ms, drawing {drawing:7.2} ms");
}

/// Fingers of the last frame, by the ids of the system.
#[derive(Default)]
struct Fingers {
    down: Vec<u64>,
}

impl Fingers {
    /// Positions of the fingers, in the order in which they went down. One that went down and up between two frames counts as down
    /// for one.
    fn places(&mut self) -> Vec<[f32; 2]> {
        let is_up = |touch: &quad::Touch| {
            matches!(touch.phase, quad::TouchPhase::Ended | quad::TouchPhase::Cancelled)
        };
        let mut touches = quad::touches();
        touches.retain(|touch| !is_up(touch) || !self.down.contains(&touch.id));
        let age = |touch: &quad::Touch| self.down.iter().position(|&id| id == touch.id).unwrap_or(usize::MAX);
        touches.sort_by_key(|touch| (age(touch), touch.id));
        self.down = touches.iter().map(|touch| touch.id).collect();
        touches.iter().map(|touch| touch.position.to_array()).collect()
    }
}

/// The present input of the person.
fn input(fingers: &mut Fingers) -> Input {
    let fingers = fingers.places();
    let is_touched = !fingers.is_empty();
    // A button that went down and up between two frames counts as down for one.
    let is_down = quad::is_mouse_button_down(quad::MouseButton::Left)
        || quad::is_mouse_button_pressed(quad::MouseButton::Left);
    let is_down = is_down && !is_touched;
    let mouse: [f32; 2] = quad::mouse_position().into();
    let is_key_down = |code| quad::is_key_down(code) || quad::is_key_pressed(code);
    let keys: KeySet = KEYS.iter().filter(|(code, _)| is_key_down(*code)).map(|&(_, key)| key).collect();
    Input {
        size: [quad::screen_width(), quad::screen_height()],
        seconds: quad::get_frame_time(),
        keys,
        pointers: if is_down { vec![mouse] } else { fingers },
        // A notch of a wheel is 1, or 120, or px, by platform.
        wheel: -quad::mouse_wheel().1.signum() * f32::from(u8::from(quad::mouse_wheel().1 != 0.0)) * 60.0,
        hover: mouse,
        has_touch: is_touched || page::has_touch(),
    }
}

/// Files of scenes that were dropped on the window.
fn open_dropped(viewer: &mut Viewer) {
    for file in quad::get_dropped_files() {
        let name = file.path.map_or_else(|| "the file".to_owned(), |path| path.display().to_string());
        let bytes = file.bytes.map_or_else(|| std::fs::read(&name), Ok);
        match bytes.map_err(Into::into).and_then(|bytes| GalleryScene::from_bytes(&name, &bytes)) {
            Ok(scene) => viewer.add(scene),
            Err(error) => viewer.say(error.to_string()),
        }
    }
}
