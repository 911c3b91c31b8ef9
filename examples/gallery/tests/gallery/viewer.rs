//! Inputs of a person, frame by frame.

use gallery::keys::{Key, KeySet};
use gallery::play::{Set, World};
use gallery::scenes::scenes;
use gallery::state;
use gallery::viewer::{Input, Viewer};
use twohalf_render::{Point, SoftwareCanvas};

const WINDOW: Point = [1000.0, 700.0];
const PHONE: Point = [360.0, 640.0];
/// A frame in s: two steps of a scene at 120 steps per second.
const FRAME: f32 = 1.0 / 60.0;

fn viewer(name: &str) -> Viewer {
    let all = scenes();
    let at = all.iter().position(|scene| scene.name == name).unwrap();
    Viewer::new(all, at).unwrap()
}

fn idle() -> Input {
    Input { size: WINDOW, seconds: FRAME, ..Input::default() }
}

fn frame(viewer: &mut Viewer, input: &Input) {
    viewer.frame(input, &|| 0.0);
}

fn wait(viewer: &mut Viewer, frames: u32) {
    (0..frames).for_each(|_| frame(viewer, &idle()));
}

/// A key goes down and up.
fn press(viewer: &mut Viewer, key: Key) {
    hold(viewer, &[key], 1);
    frame(viewer, &Input { seconds: 0.0, ..idle() });
}

fn hold(viewer: &mut Viewer, keys: &[Key], frames: u32) {
    let keys: KeySet = keys.iter().copied().collect();
    (0..frames).for_each(|_| frame(viewer, &Input { keys, ..idle() }));
}

fn pointer(viewer: &mut Viewer, at: Point) {
    frame(viewer, &Input { pointers: vec![at], ..idle() });
}

fn hash(viewer: &Viewer) -> Vec<u64> {
    viewer.show().halves().iter().map(|half| state::hash(half.play().world())).collect()
}

fn picture(viewer: &Viewer, [width, height]: Point) -> Vec<u8> {
    let mut canvas = SoftwareCanvas::new(width as u32, height as u32).unwrap();
    viewer.draw(&mut canvas).unwrap();
    canvas.rgba8()
}

/// Where the last body in 2D, or the first one in 2.5D, of half a scene is on the window, and its velocity.
fn mover(viewer: &Viewer, half: usize) -> (Point, f32) {
    let world = viewer.show().halves()[half].play().world();
    let (place, velocity) = match world {
        World::Plane(simulator) => {
            let body = &simulator[simulator.body_list()[simulator.body_list().len() - 1]];
            (body.position(), body.linear_velocity().x)
        }
        World::Depth(simulator) => {
            let body = simulator.body(simulator.body_list()[0]).unwrap();
            (body.position(), body.velocity3d().x)
        }
    };
    (viewer.show().on_canvas(viewer.area(WINDOW), half, place.into()), velocity)
}

#[test]
fn a_grabbed_body_follows_the_pointer_and_is_thrown() {
    for (name, half) in [("pyramid", 0), ("pyramid", 1), ("demo_scene_2", 0), ("demo_scene_2", 1)] {
        let mut viewer = viewer(name);
        wait(&mut viewer, 150);
        let (from, _) = mover(&viewer, half);
        pointer(&mut viewer, from);
        assert!(viewer.show().is_holding(), "{name} {half}");
        // Up, and then swiftly to the left.
        for step in 1..=60 {
            pointer(&mut viewer, [from[0], from[1] - 1.5 * step as f32]);
        }
        let (above, _) = mover(&viewer, half);
        assert!((above[1] - (from[1] - 90.0)).abs() < 25.0, "{name} {half}: {from:?} {above:?}");
        for step in 1..=12 {
            pointer(&mut viewer, [from[0] - 6.0 * step as f32, from[1] - 90.0]);
        }
        wait(&mut viewer, 1);
        assert!(!viewer.show().is_holding());
        let (_, velocity) = mover(&viewer, half);
        assert!(velocity < -100.0, "{name} {half}: {velocity}");
    }
}

#[test]
fn empty_space_is_not_grabbed_and_static_bodies_are_not_moved() {
    let mut viewer = viewer("column_20");
    let [corner, size] = viewer.area(WINDOW);
    pointer(&mut viewer, [corner[0] + 5.0, corner[1] + 0.5 * size[1]]);
    assert!(!viewer.show().is_holding());
    wait(&mut viewer, 1);
    let floor = viewer.show().on_canvas(viewer.area(WINDOW), 1, [0.0, 20.0]);
    pointer(&mut viewer, floor);
    assert!(!viewer.show().is_holding());
}

#[test]
fn a_pause_stops_time_and_single_steps_advance_it() {
    let mut viewer = viewer("demo_scene_1");
    wait(&mut viewer, 10);
    press(&mut viewer, Key::Pause);
    let before = hash(&viewer);
    wait(&mut viewer, 10);
    assert_eq!(hash(&viewer), before);
    let mut twin = viewer.show().clone();
    twin.step(gallery::play::Player::Script).unwrap();
    press(&mut viewer, Key::Step);
    let after: Vec<u64> = twin.halves().iter().map(|half| state::hash(half.play().world())).collect();
    assert_eq!(hash(&viewer), after);
    press(&mut viewer, Key::Pause);
    wait(&mut viewer, 1);
    assert_ne!(hash(&viewer), after);
}

/// Speed of the first ball of Demo Scene 1 in 2D, which falls, after some frames.
fn fall(viewer: &Viewer) -> f32 {
    match viewer.show().halves()[0].play().world() {
        World::Plane(simulator) => {
            simulator.body_list().iter().map(|&body| simulator[body].linear_velocity().y).fold(0.0, f32::max)
        }
        World::Depth(_) => panic!("it has no depth"),
    }
}

#[test]
fn slow_motion_is_five_times_slower() {
    let (mut fast, mut slow) = (viewer("demo_scene_1"), viewer("demo_scene_1"));
    hold(&mut slow, &[Key::Slow], 1);
    wait(&mut fast, 4);
    wait(&mut slow, 19);
    // Both fall from rest for 8 steps: at 2 steps a frame, and at 2 steps in 5 frames.
    assert_eq!(fall(&fast), fall(&slow));
    assert!(fall(&fast) > 20.0);
}

#[test]
fn restart_gives_the_first_state_again() {
    let mut viewer = viewer("mass_ratio");
    let start = hash(&viewer);
    wait(&mut viewer, 60);
    assert_ne!(hash(&viewer), start);
    frame(&mut viewer, &Input { keys: [Key::Restart].into_iter().collect(), seconds: 0.0, ..idle() });
    assert_eq!(hash(&viewer), start);
}

#[test]
fn a_rewound_state_is_equal_bit_for_bit_and_continues_equally() {
    for name in ["demo_scene_2", "brawler", "pinball"] {
        let mut viewer = viewer(name);
        let mut seen = vec![hash(&viewer)];
        for _ in 0..240 {
            wait(&mut viewer, 1);
            seen.push(hash(&viewer));
        }
        hold(&mut viewer, &[Key::Rewind], 60);
        let then = hash(&viewer);
        // A copy is made before a step, so it need not be the state at the end of a frame. The states of pinball are a frame
        // each four steps, of the others each two.
        press(&mut viewer, Key::Pause);
        wait(&mut viewer, 3);
        assert_eq!(hash(&viewer), then, "{name}");
        press(&mut viewer, Key::Pause);
        let mut twin = viewer.show().clone();
        let found = (0..600).any(|_| {
            twin.step(gallery::play::Player::Script).unwrap();
            let now: Vec<u64> = twin.halves().iter().map(|half| state::hash(half.play().world())).collect();
            now == seen[seen.len() - 1]
        });
        assert!(found, "{name}: the way on leads elsewhere");
        // Two seconds back, at twice the speed of time in one second.
        assert!(then != seen[seen.len() - 1], "{name}");
    }
}

#[test]
fn rewinding_as_far_as_it_goes_stops_at_the_start() {
    let mut viewer = viewer("mass_ratio");
    let start = hash(&viewer);
    wait(&mut viewer, 60);
    hold(&mut viewer, &[Key::Rewind], 200);
    assert_eq!(hash(&viewer), start);
}

#[test]
fn the_other_set_is_chosen_in_mid_run_and_everything_stays_where_it_is() {
    let mut viewer = viewer("demo_scene_2");
    wait(&mut viewer, 60);
    let sets = |viewer: &Viewer| viewer.show().halves().iter().map(|half| half.set()).collect::<Vec<_>>();
    assert_eq!(sets(&viewer), [Set::Faithful, Set::Precise]);
    let places = |viewer: &Viewer| [0, 1].map(|half| mover(viewer, half).0);
    let before = places(&viewer);
    frame(&mut viewer, &Input { keys: [Key::Methods].into_iter().collect(), seconds: 0.0, ..idle() });
    assert_eq!(sets(&viewer), [Set::Precise, Set::Faithful]);
    assert_eq!(places(&viewer), before, "in 2D and with depth");
    wait(&mut viewer, 300);
    assert!(viewer.show().halves().iter().all(|half| state::is_finite(half.play().world())));
}

#[test]
fn games_keep_the_set_that_they_need() {
    for name in ["brawler", "pinball"] {
        let mut viewer = viewer(name);
        press(&mut viewer, Key::Methods);
        assert_eq!(viewer.show().halves()[0].set(), Set::Precise);
    }
}

#[test]
fn every_layer_draws() {
    // A ragdoll has joints, fallen bodies have contacts, and with the precise set there are islands; in the end all sleep.
    let mut viewer = viewer("mass_ratio");
    wait(&mut viewer, 120);
    press(&mut viewer, Key::Pause);
    for key in [Key::Outlines, Key::Boxes, Key::Contacts, Key::Islands, Key::Sleep, Key::Joints] {
        let before = picture(&viewer, WINDOW);
        press(&mut viewer, key);
        assert_ne!(picture(&viewer, WINDOW), before, "{key:?}");
    }
}

#[test]
fn every_layer_draws_with_depth_too() {
    let mut viewer = viewer("crowd_1000");
    wait(&mut viewer, 300);
    press(&mut viewer, Key::Pause);
    for key in [Key::Outlines, Key::Boxes, Key::Contacts, Key::Islands, Key::Sleep] {
        let before = picture(&viewer, WINDOW);
        press(&mut viewer, key);
        assert_ne!(picture(&viewer, WINDOW), before, "{key:?}");
    }
}

#[test]
fn help_graph_and_list_are_drawn_and_put_away() {
    let mut viewer = viewer("column_20");
    press(&mut viewer, Key::Pause);
    let plain = picture(&viewer, WINDOW);
    for key in [Key::Help, Key::List] {
        press(&mut viewer, key);
        assert_ne!(picture(&viewer, WINDOW), plain, "{key:?}");
        press(&mut viewer, key);
        assert_eq!(picture(&viewer, WINDOW), plain, "{key:?}");
    }
    press(&mut viewer, Key::Graph);
    assert_ne!(picture(&viewer, WINDOW), plain);
}

#[test]
fn a_scene_is_chosen_from_the_list_by_keys() {
    let mut viewer = viewer("demo_scene_2");
    press(&mut viewer, Key::List);
    assert!(viewer.is_choosing());
    press(&mut viewer, Key::Right);
    press(&mut viewer, Key::Jump);
    assert!(!viewer.is_choosing());
    assert_eq!(viewer.at(), 1);
    press(&mut viewer, Key::Before);
    assert_eq!(viewer.at(), 0);
    press(&mut viewer, Key::Before);
    assert_eq!(viewer.at(), viewer.scenes().len() - 1);
}

/// A frame on a phone.
fn touch(viewer: &mut Viewer, pointers: &[Point]) {
    frame(viewer, &Input { size: PHONE, pointers: pointers.to_vec(), has_touch: true, ..idle() });
}

#[test]
fn a_scene_is_chosen_from_the_list_by_a_tap_and_not_by_scrolling() {
    let mut viewer = viewer("demo_scene_2");
    hold(&mut viewer, &[Key::List], 1);
    touch(&mut viewer, &[]);
    // One column: the second entry begins a row below the title.
    for way in [0.0, 8.0, 30.0, 60.0] {
        touch(&mut viewer, &[[100.0, 320.0 - way]]);
    }
    touch(&mut viewer, &[]);
    assert!(viewer.is_choosing(), "it was scrolled by that, no more");
    touch(&mut viewer, &[[100.0, 70.0]]);
    touch(&mut viewer, &[]);
    assert!(!viewer.is_choosing());
    // 52 px after scrolling by 60 px, less the 8 px that are a tap yet or all of them.
    assert!(viewer.at() == 1 || viewer.at() == 2, "{}", viewer.at());
}

#[test]
fn on_a_phone_scenes_stand_above_each_other_and_take_its_width() {
    let mut viewer = viewer("demo_scene_2");
    touch(&mut viewer, &[]);
    let area = viewer.area(PHONE);
    let [first, second] = [0, 1].map(|half| viewer.show().on_canvas(area, half, [0.0, 0.0]));
    assert!((first[0] - second[0]).abs() < 1.0 && second[1] > first[1] + 200.0, "{first:?} {second:?}");
    let right = viewer.show().on_canvas(area, 0, [800.0, 0.0])[0];
    assert!(right - first[0] > 0.95 * PHONE[0], "{first:?} {right}");
}

#[test]
fn thumbs_play_the_games() {
    let mut viewer = viewer("pinball");
    touch(&mut viewer, &[]);
    let flipper = |viewer: &Viewer| match viewer.show().halves()[0].play().world() {
        World::Plane(simulator) => simulator[simulator.body_list()[1]].total_rotation(),
        World::Depth(_) => panic!("it has no depth"),
    };
    for _ in 0..30 {
        touch(&mut viewer, &[]);
    }
    let at_rest = flipper(&viewer);
    let [corner, size] = viewer.area(PHONE);
    let thumb = [corner[0] + 20.0, corner[1] + size[1] - 20.0];
    for _ in 0..20 {
        touch(&mut viewer, &[thumb]);
    }
    // From 0.45 to -0.5 rad.
    assert!((flipper(&viewer) - at_rest).abs() > 0.9, "{at_rest} {}", flipper(&viewer));
}

#[test]
fn keys_of_the_beat_em_up_move_its_fighter() {
    let mut viewer = viewer("brawler");
    let place = |viewer: &Viewer| match viewer.show().halves()[0].play().world() {
        World::Depth(simulator) => simulator.body(simulator.body_list()[0]).unwrap().position3d(),
        World::Plane(_) => panic!("it has depth"),
    };
    wait(&mut viewer, 1);
    let start = place(&viewer);
    hold(&mut viewer, &[Key::Right], 30);
    let right = place(&viewer);
    assert!(right.x - start.x > 40.0, "{start} {right}");
    hold(&mut viewer, &[Key::Up], 20);
    assert!(place(&viewer).z - right.z > 15.0, "{right} {}", place(&viewer));
    hold(&mut viewer, &[Key::Jump], 10);
    assert!(place(&viewer).y - right.y > 10.0, "{right} {}", place(&viewer));
}

#[test]
fn a_slow_machine_gets_less_time_and_not_an_endless_frame() {
    let mut viewer = viewer("demo_scene_1");
    // A clock that advances by a tenth of a second with every reading.
    let now = std::cell::Cell::new(0.0);
    let clock = || {
        now.set(now.get() + 0.1);
        now.get()
    };
    let before = hash(&viewer);
    viewer.frame(&Input { seconds: 1.0, ..idle() }, &clock);
    assert_ne!(hash(&viewer), before);
    let mut twin = self::viewer("demo_scene_1").show().clone();
    twin.step(gallery::play::Player::Script).unwrap();
    let after: Vec<u64> = twin.halves().iter().map(|half| state::hash(half.play().world())).collect();
    assert_eq!(hash(&viewer), after, "one step, and no more");
}

#[test]
fn the_wheel_zooms_at_the_mouse_and_bodies_are_grabbed_there_as_before() {
    let mut viewer = viewer("column_100");
    wait(&mut viewer, 30);
    let (at, _) = mover(&viewer, 1);
    for _ in 0..8 {
        frame(&mut viewer, &Input { wheel: -60.0, hover: at, ..idle() });
    }
    // 1.004 to the power of 480.
    assert!((viewer.show().lens().zoom() - 6.79).abs() < 0.01, "{}", viewer.show().lens().zoom());
    let (now, _) = mover(&viewer, 1);
    assert!((now[0] - at[0]).hypot(now[1] - at[1]) < 2.0, "{at:?} {now:?}");
    pointer(&mut viewer, now);
    assert!(viewer.show().is_holding());
    wait(&mut viewer, 1);
    frame(&mut viewer, &Input { wheel: 6000.0, hover: at, ..idle() });
    assert_eq!(viewer.show().lens(), gallery::Lens::default());
}

#[test]
fn two_fingers_zoom_and_one_moves_the_visible_part() {
    let mut viewer = viewer("column_20");
    touch(&mut viewer, &[]);
    let [corner, size] = viewer.area(PHONE);
    // Beside the columns, where there is no body to grab.
    let at = [corner[0] + 100.0, corner[1] + 0.25 * size[1]];
    for apart in [20.0, 30.0, 60.0] {
        touch(&mut viewer, &[at, [at[0] + apart, at[1]]]);
    }
    assert!((viewer.show().lens().zoom() - 2.0).abs() < 1e-3, "{}", viewer.show().lens().zoom());
    touch(&mut viewer, &[at]);
    let origin = |viewer: &Viewer| viewer.show().on_canvas(viewer.area(PHONE), 0, [0.0, 0.0]);
    let before = origin(&viewer);
    touch(&mut viewer, &[[at[0], at[1] + 7.0]]);
    let after = origin(&viewer);
    assert!(
        (after[1] - before[1] - 7.0).abs() < 0.01 && (after[0] - before[0]).abs() < 0.01,
        "{before:?} {after:?}"
    );
}

/// A number that follows from the one before, as if by chance.
fn next(seed: &mut u32) -> u32 {
    *seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
    *seed >> 8
}

#[test]
fn random_input_causes_no_panic() {
    const KEYS: [Key; 25] = [
        Key::Left,
        Key::Right,
        Key::Up,
        Key::Down,
        Key::Jump,
        Key::Punch,
        Key::Grab,
        Key::Pause,
        Key::Step,
        Key::Slow,
        Key::Restart,
        Key::Rewind,
        Key::Methods,
        Key::Outlines,
        Key::Boxes,
        Key::Contacts,
        Key::Islands,
        Key::Sleep,
        Key::Joints,
        Key::Graph,
        Key::Help,
        Key::Full,
        Key::List,
        Key::Before,
        Key::After,
    ];
    let all: Vec<_> = scenes().into_iter().filter(|scene| !scene.name.starts_with("crowd")).collect();
    let mut viewer = Viewer::new(all, 0).unwrap();
    let mut canvas = SoftwareCanvas::new(300, 200).unwrap();
    let mut seed = 1;
    let (mut seen, mut pointers, mut keys) = (Vec::new(), Vec::new(), KeySet::default());
    for at in 0..3000 {
        let size = if next(&mut seed).is_multiple_of(50) { [0.0, 1.0] } else { [300.0, 200.0] };
        if next(&mut seed).is_multiple_of(4) {
            keys = (0..next(&mut seed) % 2).map(|_| KEYS[next(&mut seed) as usize % KEYS.len()]).collect();
        }
        if next(&mut seed).is_multiple_of(6) {
            let mut place = || [(next(&mut seed) % 300) as f32, (next(&mut seed) % 200) as f32];
            pointers = [place(), place()].to_vec();
            pointers.truncate(next(&mut seed) as usize % 3);
        }
        let has_touch = at > 1500;
        frame(
            &mut viewer,
            &Input {
                size,
                seconds: FRAME,
                keys,
                pointers: pointers.clone(),
                wheel: (next(&mut seed) % 3) as f32 * 60.0 - 60.0,
                hover: [150.0, 90.0],
                has_touch,
            },
        );
        if at % 20 == 0 {
            viewer.draw(&mut canvas).unwrap();
        }
        assert!(
            viewer.show().halves().iter().all(|half| state::is_finite(half.play().world())),
            "frame {at}"
        );
        seen.push(viewer.at());
    }
    seen.sort_unstable();
    seen.dedup();
    assert!(seen.len() > 3, "{} scenes were visited", seen.len());
}
