//! A saved simulator continues with the same bits, and a damaged save is refused.

use conformance::fixtures::depth::{
    DT, ball, busy_scene, crate_box, geom_of, run, set_surface, simulator, solid, weightless, with_scheme,
};
use serde_json::{Value, json};
use twohalf::farseer_core::{
    BodyFactory, BodyId, BroadPhaseCollider, GeomPlacement, Methods, NarrowPhaseCollider, PhysicsSimulator,
    Vertices,
};
use twohalf::{
    CharacterController, CharacterSettings, Collision, Context, DepthProfile, DepthScheme, Event,
    EventHandler, MoveInput, Platform, TwoHalfPhysicsSimulator, Vector2, Vector3,
};

fn loaded(simulator: &TwoHalfPhysicsSimulator) -> TwoHalfPhysicsSimulator {
    serde_json::from_str(&serde_json::to_string(simulator).unwrap()).unwrap()
}

#[test]
pub(crate) fn a_loaded_simulator_continues_with_the_same_bits() {
    let (mut simulator, bodies) = busy_scene();
    for steps in [40, 100, 160] {
        run(&mut simulator, steps);
        let text = serde_json::to_string(&simulator).unwrap();
        let mut loaded: TwoHalfPhysicsSimulator = serde_json::from_str(&text).unwrap();
        let mut original = simulator.clone();
        for _ in 0..150 {
            original.update(DT);
            loaded.update(DT);
            for &body in &bodies {
                let [a, b] = [&original, &loaded].map(|simulator| {
                    let view = simulator.body(body).unwrap();
                    let numbers = [view.position3d().x, view.position3d().y, view.position3d().z];
                    (numbers.map(f32::to_bits), view.rotation().to_bits(), view.linear_velocity_z().to_bits())
                });
                assert_eq!(a, b);
            }
        }
        assert_eq!(serde_json::to_string(&original).unwrap(), serde_json::to_string(&loaded).unwrap());
    }
}

#[test]
pub(crate) fn the_busy_scene_has_contacts_of_pairs_and_with_the_ground() {
    let (mut simulator, _) = busy_scene();
    run(&mut simulator, 140);
    let counters = simulator.counters();
    assert!(counters.pairs_touching > 0 && counters.ground_contacts > 0, "{counters:?}");
}

#[test]
pub(crate) fn pending_forces_along_z_are_saved() {
    let (mut simulator, bodies) = busy_scene();
    simulator.body_mut(bodies[0]).unwrap().apply_force_z(3.0);
    simulator.body_mut(bodies[0]).unwrap().apply_impulse_z(4.0);
    let text = serde_json::to_string(&simulator).unwrap();
    let mut loaded: TwoHalfPhysicsSimulator = serde_json::from_str(&text).unwrap();
    run(&mut simulator, 1);
    run(&mut loaded, 1);
    let [a, b] = [&simulator, &loaded].map(|s| s.body(bodies[0]).unwrap().linear_velocity_z());
    assert_eq!(a, b);
    assert!(a > 4.0);
}

/// The message with which a save is refused after a change.
fn refusal(change: impl Fn(&mut Value)) -> String {
    let (mut simulator, _) = busy_scene();
    run(&mut simulator, 140);
    let mut saved = serde_json::to_value(&simulator).unwrap();
    change(&mut saved);
    match serde_json::from_value::<TwoHalfPhysicsSimulator>(saved) {
        Ok(_) => String::from("accepted"),
        Err(error) => error.to_string(),
    }
}

#[test]
pub(crate) fn a_save_without_change_is_accepted() {
    assert_eq!(refusal(|_| ()), "accepted");
}

#[test]
pub(crate) fn a_save_with_an_angle_out_of_range_is_refused() {
    let message = refusal(|saved| saved["world"]["projection"]["angle"] = json!(180));
    assert!(message.contains("angle is 180"), "{message}");
}

#[test]
pub(crate) fn a_save_with_an_infinite_z_is_refused() {
    let message = refusal(|saved| saved["world"]["depths"]["bodies"]["entries"][0][1]["z"] = json!(1e300));
    assert!(message.contains("along Z"), "{message}");
}

#[test]
pub(crate) fn a_save_with_a_negative_depth_is_refused() {
    let message = refusal(|saved| {
        saved["world"]["depths"]["profiles"]["entries"][0][1] = json!({ "Prism": { "depth": -1.0 } });
    });
    assert!(message.contains("depth profile"), "{message}");
}

#[test]
pub(crate) fn a_save_whose_entry_lies_in_another_slot_is_refused() {
    let message =
        refusal(|saved| saved["world"]["depths"]["bodies"]["entries"].as_array_mut().unwrap().swap(0, 1));
    assert!(message.contains("damaged"), "{message}");
}

#[test]
pub(crate) fn a_save_in_which_a_body_has_no_depth_is_refused() {
    let message = refusal(|saved| saved["world"]["depths"]["bodies"]["entries"][2] = Value::Null);
    assert!(message.contains("has no depth"), "{message}");
}

#[test]
pub(crate) fn a_save_whose_contact_has_no_points_is_refused() {
    let message = refusal(|saved| saved["touches"]["touches"][0]["point_count"] = json!(0));
    assert!(message.contains("contacts"), "{message}");
}

#[test]
pub(crate) fn a_save_whose_contact_has_infinite_friction_is_refused() {
    let message = refusal(|saved| saved["touches"]["touches"][0]["friction"] = json!(1e300));
    assert!(message.contains("contacts"), "{message}");
}

#[test]
pub(crate) fn a_save_with_a_damaged_2d_engine_is_refused() {
    let message = refusal(|saved| {
        saved["core"]["objects"]["bodies"]["list"][0] = json!({ "index": 99, "generation": 0 })
    });
    assert!(message.contains("damaged"), "{message}");
}

#[test]
fn contacts_with_an_infinite_restitution_are_saved_and_loaded() {
    with_scheme(DepthScheme::Precise, || {
        let mut simulator = simulator();
        let body = crate_box(&mut simulator, [20.0, 20.0], [0.0, 0.0, 0.0]);
        set_surface(&mut simulator, body, 0.5, f32::MAX);
        run(&mut simulator, 1);
        assert_eq!(simulator.contacts().count(), 2);
        assert_eq!(loaded(&simulator).snapshot(), simulator.snapshot());
    });
}

#[test]
fn a_save_whose_plane_has_the_methods_of_another_scheme_is_refused() {
    let mut precise = PhysicsSimulator::default();
    precise.set_methods(Methods::PRECISE).unwrap();
    let precise = serde_json::to_value(&precise).unwrap();
    let message = refusal(|saved| {
        saved["core"]["objects"]["methods"] = precise["objects"]["methods"].clone();
        saved["core"]["pipeline"] = precise["pipeline"].clone();
        saved["core"]["contacts"] = precise["contacts"].clone();
    });
    assert!(message.contains("not those of the scheme"), "{message}");
}

#[test]
pub(crate) fn a_save_with_an_unknown_rejected_argument_is_refused() {
    let message = refusal(|saved| {
        saved["world"]["depths"]["bodies"]["entries"][0][1]["rejected"] = json!(["position3d", "colour"]);
    });
    assert!(message.contains("refused argument"), "{message}");
}

/// Everything that setters of this engine refuse, of a body, its geom, its ground and a platform.
fn refuse_everything(simulator: &mut TwoHalfPhysicsSimulator) {
    let body = simulator.body_list()[0];
    let geom = simulator.geom_list()[0];
    let platform = simulator.platforms().next().unwrap();
    let (nan, nowhere) = (f32::NAN, Vector3::new(0.0, f32::NAN, 0.0));
    let mut view = simulator.body_mut(body).unwrap();
    view.set_position3d(nowhere);
    view.set_velocity3d(nowhere);
    view.set_angular_velocity3d(nowhere);
    view.set_linear_velocity_z(nan);
    view.apply_force_z(nan);
    view.set_rotation(nan);
    view.ground_mut().set_friction_coefficient(nan);
    view.ground_mut().set_restitution_coefficient(nan);
    simulator.geom_mut(geom).unwrap().set_friction_coefficient(nan);
    simulator.platform_mut(platform).unwrap().set_restitution_coefficient(nan);
}

/// A ball above a platform that has been in an update.
fn ball_and_platform() -> TwoHalfPhysicsSimulator {
    let mut simulator = simulator();
    ball(&mut simulator, 10.0, [0.0, 100.0, 50.0]);
    Platform::new(&mut simulator, 100.0, 10.0, 100.0, Vector3::new(0.0, 0.0, 50.0), None).unwrap();
    run(&mut simulator, 2);
    simulator
}

fn rejected(simulator: &TwoHalfPhysicsSimulator) -> Vec<&'static str> {
    let argument = |event: &Event| match *event {
        Event::RejectedInput { argument, .. } => Some(argument),
        _ => None,
    };
    simulator.events().iter().filter_map(argument).collect()
}

#[test]
pub(crate) fn pending_refusals_are_reported_after_loading() {
    let mut simulator = ball_and_platform();
    refuse_everything(&mut simulator);
    let mut loaded = loaded(&simulator);
    run(&mut simulator, 1);
    run(&mut loaded, 1);
    assert_eq!(rejected(&simulator).len(), 10, "{:?}", rejected(&simulator));
    assert_eq!(loaded.events(), simulator.events());
    run(&mut loaded, 1);
    assert_eq!(rejected(&loaded), [] as [&str; 0]);
}

#[test]
pub(crate) fn refusals_do_not_pile_up() {
    let length_after = |count: usize| {
        let mut simulator = ball_and_platform();
        (0..count).for_each(|_| refuse_everything(&mut simulator));
        let length = simulator.snapshot().len();
        run(&mut simulator, 1);
        (length, rejected(&simulator).len())
    };
    assert_eq!(length_after(20), length_after(1000));
}

/// Sweep and prune finds a pair with a geom that is just leaving, as the original does.
#[test]
fn a_contact_with_a_geom_that_has_left_its_list_goes_on_after_loading() {
    let mut core = PhysicsSimulator::new(Vector2::zeros()).unwrap();
    core.set_broad_phase_collider(BroadPhaseCollider::SweepAndPrune).unwrap();
    let mut simulator = TwoHalfPhysicsSimulator::from_core(600, 90, core).unwrap();
    let first = crate_box(&mut simulator, [20.0, 20.0], [0.0, 100.0, 50.0]);
    // The table of pairs is too small for more than two.
    crate_box(&mut simulator, [20.0, 20.0], [500.0, 100.0, 50.0]);
    crate_box(&mut simulator, [20.0, 20.0], [800.0, 100.0, 50.0]);
    run(&mut simulator, 1);
    crate_box(&mut simulator, [20.0, 20.0], [5.0, 118.0, 50.0]);
    let leaving = simulator.core().geoms_of(first)[0];
    simulator.remove(leaving).unwrap();
    run(&mut simulator, 1);
    assert!(!simulator.core().is_listed(leaving) && simulator.contacts().count() > 0);
    let mut loaded = loaded(&simulator);
    run(&mut simulator, 1);
    run(&mut loaded, 1);
    assert!(simulator.contacts().count() > 0);
    assert_eq!(loaded.events(), simulator.events());
    assert!(loaded.snapshot() == simulator.snapshot());
}

#[test]
pub(crate) fn settings_of_balls_that_their_boxes_cannot_follow_are_saved_and_loaded() {
    let mut simulator = weightless();
    let body = ball(&mut simulator, 10.0, [0.0, 0.0, 0.0]);
    let geom = simulator.core().geoms_of(body)[0];
    simulator.set_depth_scheme(twohalf::DepthScheme::Thesis).unwrap();
    simulator.set_depth_profile(geom, twohalf::DepthProfile::Round { radius: 3.4e38 }).unwrap();
    simulator.body_mut(body).unwrap().core_mut().set_position(Vector2::new(1e38, 0.0));
    simulator.set_depth_scheme(twohalf::DepthScheme::Faithful).unwrap();
    let _ = loaded(&simulator);
}

#[test]
pub(crate) fn a_geom_with_an_overflowing_outline_is_saved_and_loaded() {
    let mut core = PhysicsSimulator::default();
    core.set_narrow_phase_collider(NarrowPhaseCollider::Sat);
    let body = BodyFactory::create_rectangle_body_in(&mut core, 10.0, 10.0, 1.0).unwrap();
    let outline: Vertices = [(-3e38, -3e38), (-3e38, 3e38), (3e38, 3e38), (3e38, -3e38)]
        .into_iter()
        .map(|(x, y)| Vector2::new(x, y))
        .collect();
    let geom = core.create_geom(body, outline, GeomPlacement::default()).unwrap();
    let simulator = TwoHalfPhysicsSimulator::from_core(600, 90, core).unwrap();
    let (near, far) = simulator.depth_interval(geom).unwrap();
    assert!(near.is_finite() && far.is_finite());
    let _ = loaded(&simulator);
}

/// A moved body and a geom with another depth take effect in the next update. Until then queries find them where they were, also
/// after loading.
#[test]
fn queries_of_a_loaded_simulator_know_edits_no_sooner_than_those_of_the_saved_one() {
    let walk_past = |edit: fn(&mut TwoHalfPhysicsSimulator, BodyId)| {
        let mut simulator = simulator();
        simulator.set_depth_scheme(DepthScheme::Precise).unwrap();
        let figure = solid(&mut simulator, [20.0, 40.0, 20.0], [0.0, 0.0, 0.0]);
        let stair = solid(&mut simulator, [20.0, 6.0, 20.0], [0.0, 0.0, 200.0]);
        run(&mut simulator, 20);
        edit(&mut simulator, stair);
        let mut loaded = loaded(&simulator);
        assert!(simulator.contacts().eq(loaded.contacts()));
        let wish = MoveInput { x: 50.0, ..MoveInput::default() };
        let [a, b] = [&mut simulator, &mut loaded].map(|simulator| {
            let mut walker = CharacterController::new(CharacterSettings::default());
            simulator.walk(figure, &mut walker, wish, DT).unwrap();
            simulator.snapshot()
        });
        assert!(a == b);
    };
    walk_past(|simulator, stair| {
        simulator.body_mut(stair).unwrap().set_position3d(Vector3::new(5.0, 0.0, 0.0));
    });
    walk_past(|simulator, stair| {
        let geom = geom_of(simulator, stair);
        simulator.set_depth_profile(geom, DepthProfile::Prism { depth: 500.0 }).unwrap();
    });
}

struct Refuser;

impl EventHandler for Refuser {
    fn on_collision(&mut self, _: &mut Context<'_>, _: &Collision) -> bool {
        false
    }
}

/// A geom that a game has disposed keeps its contacts until the next update. A figure that the ground does not support there is
/// not supported by it after loading, either.
#[test]
fn contacts_of_a_disposed_geom_stay_refused_until_the_next_update_after_loading() {
    let mut simulator = simulator();
    simulator.set_depth_scheme(DepthScheme::Precise).unwrap();
    let figure = solid(&mut simulator, [20.0, 40.0, 20.0], [0.0, 0.0, 0.0]);
    (0..2).for_each(|_| simulator.update_with(DT, &mut Refuser));
    let geom = geom_of(&simulator, figure);
    simulator.dispose(geom).unwrap();
    let mut loaded = loaded(&simulator);
    for simulator in [&mut simulator, &mut loaded] {
        let mut walker = CharacterController::new(CharacterSettings::default());
        simulator.walk(figure, &mut walker, MoveInput { jump: true, ..MoveInput::default() }, DT).unwrap();
    }
    assert!(simulator.body(figure).unwrap().velocity3d().y <= 0.0);
    assert!(loaded.snapshot() == simulator.snapshot());
}
