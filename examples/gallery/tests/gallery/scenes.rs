//! Every scene, and the results that each is made to show.

use farseer_core::{PhysicsSimulator, RevoluteJoint};
use gallery::play::{Player, Set, World};
use gallery::scenes::{GalleryScene, scenes};
use gallery::show::{Half, Show};
use gallery::state;

pub(crate) fn scene(name: &str) -> GalleryScene {
    scenes().into_iter().find(|scene| scene.name == name).expect("it is listed")
}

fn play(show: &mut Show, seconds: f32) {
    let steps = (seconds * show.rate() as f32) as u32;
    (0..steps).for_each(|_| show.step(Player::Script).unwrap());
}

/// A scene after some seconds.
fn played(name: &str, seconds: f32) -> Show {
    let mut show = scene(name).build().unwrap();
    play(&mut show, seconds);
    show
}

fn half(show: &Show, set: Set) -> &Half {
    show.halves().iter().find(|half| half.set() == set).unwrap()
}

fn plane(half: &Half) -> &PhysicsSimulator {
    match half.play().world() {
        World::Plane(simulator) => simulator,
        World::Depth(_) => panic!("it has depth"),
    }
}

/// The farthest that a body that can move is from where it began, px.
fn farthest(name: &str, seconds: f32, set: Set) -> f32 {
    let (before, after) = (scene(name).build().unwrap(), played(name, seconds));
    let [before, after] = [&before, &after].map(|show| plane(half(show, set)));
    let ways =
        before.body_list().iter().map(|&body| (after[body].position() - before[body].position()).norm());
    ways.fold(0.0, f32::max)
}

#[test]
fn all_numbers_stay_finite_for_twenty_seconds() {
    for scene in scenes() {
        let mut show = scene.build().unwrap();
        let bodies = |show: &Show| {
            show.halves().iter().map(|half| state::counts(half.play().world()).bodies).sum::<usize>()
        };
        assert!(bodies(&show) > 0, "{} is empty", scene.name);
        play(&mut show, 20.0);
        assert!(show.halves().iter().all(|half| state::is_finite(half.play().world())), "{}", scene.name);
    }
}

#[test]
fn names_are_addresses_and_none_is_there_twice() {
    let mut names: Vec<String> = scenes().into_iter().map(|scene| scene.name).collect();
    assert!(
        names.iter().all(|name| name.chars().all(|letter| letter.is_ascii_alphanumeric() || letter == '_'))
    );
    let count = names.len();
    names.sort();
    names.dedup();
    assert_eq!(names.len(), count);
}

#[test]
fn a_copy_goes_on_with_the_same_bits() {
    for name in ["demo_scene_2", "brawler", "pinball", "mass_ratio", "farseer_advanced_6"] {
        let mut show = played(name, 1.0);
        let mut copy = show.clone();
        play(&mut show, 1.0);
        play(&mut copy, 1.0);
        let hashes = |show: &Show| {
            show.halves().iter().map(|half| state::hash(half.play().world())).collect::<Vec<_>>()
        };
        assert_eq!(hashes(&show), hashes(&copy), "{name}");
    }
}

#[test]
fn columns_stand_with_the_precise_and_fall_with_the_faithful_set() {
    for (name, height) in [("column_20", 480.0), ("column_100", 2400.0)] {
        // A stack of rigid boxes stands where it is; contacts yield by a hundredth of a px.
        assert!(farthest(name, 8.0, Set::Precise) < 0.1, "{name}");
        assert!(farthest(name, 8.0, Set::Faithful) > 0.3 * height, "{name}");
    }
}

#[test]
fn the_pyramid_stands_with_the_precise_set() {
    // Heights of boxes vary by up to a twentieth of a px, and there are twenty rows that settle.
    let way = farthest("pyramid", 8.0, Set::Precise);
    assert!(way < 2.0, "{way}");
}

/// The widest gap of all hinges between two bodies after some seconds, px: each hinge was one point of both at the start.
fn widest_gap(name: &str, seconds: f32, set: Set) -> f32 {
    let (before, after) = (scene(name).build().unwrap(), played(name, seconds));
    let [before, after] = [&before, &after].map(|show| plane(half(show, set)));
    let gap = |&id: &farseer_core::JointId| {
        let joint: &RevoluteJoint = before.joint_as(id).ok()?;
        let hinge = joint.anchor();
        let [a, b] = [joint.body1(), joint.body2()]
            .map(|body| after[body].get_world_position(before[body].get_local_position(hinge)));
        Some((a - b).norm())
    };
    before.joint_list().iter().filter_map(gap).fold(0.0, f32::max)
}

#[test]
fn chains_hold_together_with_the_precise_set_and_are_stretched_by_the_faithful_one() {
    for (name, least) in [("chain_200", 5.0), ("mass_ratio", 1.0)] {
        let [precise, faithful] = [Set::Precise, Set::Faithful].map(|set| widest_gap(name, 8.0, set));
        assert!(precise < 0.02, "{name}: {precise}");
        assert!(faithful > least, "{name}: {faithful}");
    }
}

#[test]
fn a_thousand_kilograms_rest_on_three_with_the_precise_set() {
    let show = played("mass_ratio", 20.0);
    let simulator = plane(half(&show, Set::Precise));
    let heavy = simulator
        .body_list()
        .iter()
        .map(|&body| &simulator[body])
        .find(|body| body.mass() == 1000.0)
        .unwrap();
    // Three boxes of 24 px, and half of its own 90 px.
    assert!((heavy.position().y - -(3.0 * 24.0 + 45.0)).abs() < 0.1, "{}", heavy.position().y);
}

#[test]
fn circles_come_to_rest_in_the_pit() {
    let show = played("pit_500", 12.0);
    let simulator = plane(half(&show, Set::Precise));
    let half_width = 12.0 * (500.0_f32.sqrt().ceil() + 1.0);
    for &body in simulator.body_list() {
        let place = simulator[body].position();
        assert!(simulator[body].is_static() || place.x.abs() < half_width && place.y < 0.0, "{place}");
    }
    assert!(state::counts(half(&show, Set::Precise).play().world()).asleep > 400);
}

#[test]
fn a_thousand_objects_stay_on_their_field_and_fall_asleep() {
    let show = played("crowd_1000", 20.0);
    let World::Depth(simulator) = show.halves()[0].play().world() else { panic!("it has depth") };
    for &body in simulator.body_list() {
        let place = simulator.body(body).unwrap().position3d();
        // 42 x 24 cells of 26 px, with one more for the margins.
        let is_inside = (0.0..26.0 * 44.0).contains(&place.x) && (0.0..26.0 * 25.0).contains(&place.z);
        assert!(is_inside && place.y > -1.0, "{place}");
    }
    let asleep = state::counts(show.halves()[0].play().world()).asleep;
    assert!(asleep > 900, "{asleep}");
}

#[test]
fn games_that_play_themselves_score() {
    let show = played("pinball", 20.0);
    assert!(state::is_finite(show.halves()[0].play().world()));
    let mut canvas = twohalf_render::SoftwareCanvas::new(420, 700).unwrap();
    let area = [[0.0; 2], [420.0, 700.0]];
    let start = scene("pinball").build().unwrap();
    let mut digits = |show: &Show| {
        show.draw(&mut canvas, area, gallery::Layers::default()).unwrap();
        let score = twohalf_render::Rectangle::new(150, 660, 144, 30);
        canvas.to_texture().unwrap().part(score).unwrap().rgba8().to_vec()
    };
    assert_ne!(digits(&start), digits(&show));
}

const OWN: &str = r#"{
    "format": 1, "name": "own", "about": "Of one's own.", "tags": [], "dt": 0.01, "steps": 100,
    "simulator": { "gravity": [0, 100] }, "trace": { "full_every": 10, "events": false, "contacts": false }, "bodies": [
        { "shape": { "type": "rectangle", "width": 200, "height": 20, "mass": 1 }, "position": [0, 100], "static": true },
        { "shape": { "type": "circle", "radius": 10, "mass": 1 }, "position": [0, 0] }
    ],
    "geoms": [
        { "body": 0, "shape": { "type": "rectangle", "width": 200, "height": 20 } },
        { "body": 1, "shape": { "type": "circle", "radius": 10, "edges": 16 } }
    ]
}"#;

#[test]
fn a_scene_of_ones_own_is_shown_from_its_file() {
    let own = GalleryScene::from_json("own.json", OWN).unwrap();
    let mut show = own.build().unwrap();
    play(&mut show, 5.0);
    let simulator = plane(&show.halves()[0]);
    let ball = simulator[simulator.body_list()[1]].position();
    assert!((ball.y - 80.0).abs() < 1.0 && ball.x.abs() < 5.0, "{ball}");
}

#[test]
fn a_file_that_is_no_scene_is_refused_by_its_name_and_the_place() {
    let wrong = OWN.replace("\"radius\": 10, \"edges\"", "\"radius\": \"ten\", \"edges\"");
    let error = GalleryScene::from_json("own.json", &wrong).unwrap_err().to_string();
    assert!(error.contains("own.json") && error.contains("geoms[1]"), "{error}");
}
