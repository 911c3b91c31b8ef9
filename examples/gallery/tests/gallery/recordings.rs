//! Recordings: at any step, with layers, and two beside each other.

use farseer_core::math::Vector2;
use farseer_core::{BodyBuilder, GeomBuilder, PhysicsSimulator, Recording};
use gallery::Layers;
use gallery::film::Film;
use gallery::keys::{Key, KeySet, Keys};
use gallery::play::{Player, World};
use gallery::scenes::{GalleryScene, Game};
use gallery::show::Show;
use twohalf_render::{SoftwareCanvas, Texture2D};

const DT: f32 = 1.0 / 60.0;

/// A run of 90 steps in which boxes fall on each other; the lowest is pushed in one step.
fn run(push_at: usize, keyframe_interval: u32) -> Recording {
    let mut simulator = PhysicsSimulator::precise([0.0, 300.0]).unwrap();
    let floor = BodyBuilder::fixed().position([0.0, 10.0]);
    simulator.add_body(floor, [GeomBuilder::rectangle(400.0, 20.0)]).unwrap();
    let boxes: Vec<_> = (0..6)
        .map(|at| {
            let body = BodyBuilder::dynamic().position([0.0, -20.0 - 40.0 * at as f32]);
            simulator.add_body(body, [GeomBuilder::rectangle(32.0, 32.0)]).unwrap().0
        })
        .collect();
    let mut recording = Recording::new(&simulator, keyframe_interval).unwrap();
    for step in 0..90 {
        if step == push_at {
            simulator[boxes[0]].apply_impulse(Vector2::new(60.0, 0.0));
        }
        simulator.update(DT);
        recording.record(&simulator, DT, &[u8::from(step == push_at)]);
    }
    recording
}

fn scene(runs: Vec<Recording>, step: usize) -> GalleryScene {
    GalleryScene::from_recordings("a_run", runs, step).unwrap()
}

fn hashes(show: &Show) -> Vec<u64> {
    let worlds = show.halves().iter().map(|half| half.play().world());
    worlds
        .map(|world| match world {
            World::Plane(simulator) => simulator.state_hash(),
            World::Depth(_) => panic!("a recording is of the 2D engine"),
        })
        .collect()
}

fn key(key: Key) -> Player {
    let keys: KeySet = [key].into_iter().collect();
    Player::Keys(Keys { held: keys, pressed: keys })
}

#[test]
fn a_recording_is_shown_at_any_step() {
    let recorded = run(40, 1);
    for steps in [0, 1, 41, 90, 1000] {
        let show = scene(vec![recorded.clone()], steps).build().unwrap();
        if let Some(last) = steps.min(90).checked_sub(1) {
            assert_eq!(hashes(&show), [recorded.hash(last).unwrap()], "{steps}");
        }
    }
}

#[test]
fn keys_go_through_the_steps() {
    let recorded = run(40, 1);
    let mut show = scene(vec![recorded.clone(), run(60, 1)], 0).build().unwrap();
    let at = |show: &Show| {
        let hash = hashes(show)[0];
        (0..90).find(|&step| recorded.hash(step) == Some(hash)).map_or(0, |step| step + 1)
    };
    (0..5).for_each(|_| show.step(key(Key::Right)).unwrap());
    assert_eq!(at(&show), 5);
    show.step(key(Key::Left)).unwrap();
    assert_eq!(at(&show), 4);
    show.step(Player::Keys(Keys::default())).unwrap();
    assert_eq!(at(&show), 4, "it waits for keys");
    // The first difference is in the step after 40.
    show.step(key(Key::Jump)).unwrap();
    assert_eq!(at(&show), 41);
    let [one, other] = hashes(&show).try_into().unwrap();
    assert_ne!(one, other);
    show.step(key(Key::Left)).unwrap();
    let [one, other] = hashes(&show).try_into().unwrap();
    assert_eq!(one, other, "before it they are equal");
}

#[test]
fn between_keyframes_the_hash_tells_whether_input_is_missing() {
    let recorded = run(40, 30);
    let hash = |steps| hashes(&scene(vec![recorded.clone()], steps).build().unwrap())[0];
    assert_eq!(hash(39), recorded.hash(38).unwrap(), "without input so far");
    assert_ne!(hash(50), recorded.hash(49).unwrap(), "the gallery cannot push as the game did");
    assert_eq!(hash(60), recorded.hash(59).unwrap(), "a keyframe");
}

#[test]
fn runs_say_where_they_part() {
    assert_eq!(scene(vec![run(40, 30), run(40, 30)], 0).about, "Two equal runs of 90 steps.");
    let scene = scene(vec![run(40, 30), run(60, 30)], 0);
    assert_eq!((scene.about.as_str(), scene.game), ("Two runs that part in step 41.", Game::Replay));
    assert!(GalleryScene::from_recordings("none", Vec::new(), 0).is_err());
}

#[test]
fn a_file_is_opened_by_its_content() {
    let bytes = run(40, 30).to_bytes();
    assert_eq!(GalleryScene::from_bytes("a run", &bytes).unwrap().game, Game::Replay);
    let error = GalleryScene::from_bytes("a run", &bytes[..100]).unwrap_err().to_string();
    assert!(error.contains("cut short"), "{error}");
    assert!(GalleryScene::from_bytes("a text", b"no scene").is_err());
}

#[test]
fn contacts_and_islands_are_drawn_over_a_recording() {
    let picture = |layers: Layers| {
        let show = scene(vec![run(40, 1), run(60, 1)], 85).build().unwrap();
        let mut canvas = SoftwareCanvas::new(400, 300).unwrap();
        show.draw(&mut canvas, [[0.0; 2], [400.0, 300.0]], layers).unwrap();
        canvas.rgba8().to_vec()
    };
    let plain = picture(Layers::default());
    assert_ne!(picture(Layers { contacts: true, ..Layers::default() }), plain);
    assert_ne!(picture(Layers { islands: true, ..Layers::default() }), plain);
}

#[test]
fn a_film_of_two_runs_is_written() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    let layers = Layers { contacts: true, islands: true, ..Layers::default() };
    let film = Film { seconds: 0.5, out: folder.join("two_runs.png"), largest: 900, layers };
    let filmed = film.film(&scene(vec![run(40, 1), run(60, 1)], 50), |_, _| ()).unwrap();
    assert!(Texture2D::load_png(&filmed.animation).unwrap().width() > 400);
}
