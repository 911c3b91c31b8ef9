//! A damaged save is refused, or makes a simulator that runs: no call panics, no number becomes infinite.

use conformance::fixtures::plane::{Game, add_box, is_finite, lively_scene, methods, simulator_with, v};
use farseer_core::{
    Body, BroadPhaseCollider, GeomPlacement, Methods, NarrowPhaseCollider, PhysicsSimulator, Vertices,
    math::Matrix,
};
use serde::Deserialize;
use serde_json::{Value, json};

/// Runs the loaded simulator, if there is one. Returns whether loading was refused.
fn is_refused_or_runs(loaded: serde_json::Result<PhysicsSimulator>, what: &str) -> bool {
    let Ok(mut simulator) = loaded else { return true };
    assert!(is_finite(&simulator), "not finite when loaded: {what}");
    // Any number of iterations is legitimate, but the greatest takes too long.
    simulator.set_iterations(simulator.iterations().min(10));
    for step in 0..10 {
        simulator.update(0.01);
        assert!(is_finite(&simulator), "not finite after {step} updates: {what}");
    }
    loads_itself(&simulator, what);
    let bodies = simulator.body_list().to_vec();
    for &body in &bodies {
        simulator[body].set_position(v(1.0, 2.0));
    }
    simulator.update(0.01);
    for &body in &bodies {
        simulator.dispose(body).unwrap();
    }
    simulator.update(0.01);
    can_be_added_to(simulator, what);
    false
}

/// Loads parsed JSON: the loader gets the same requests as from a text, which need not be written and parsed for each case.
fn loaded(save: &Value) -> serde_json::Result<PhysicsSimulator> {
    <PhysicsSimulator as Deserialize>::deserialize(save)
}

fn loads_itself(simulator: &PhysicsSimulator, what: &str) {
    let restored = PhysicsSimulator::default().restore(&simulator.snapshot());
    assert_eq!(restored, Ok(()), "it refuses its own snapshot: {what}");
}

/// Whether a geom can be made, unless the numbers of geoms are used up.
fn can_be_added_to(mut simulator: PhysicsSimulator, what: &str) {
    let body = simulator.create_body(Body::new());
    simulator.add(body).unwrap();
    let outline = Vertices::create_simple_rectangle(10.0, 10.0).unwrap();
    match simulator.create_geom(body, outline, GeomPlacement::default()) {
        Ok(geom) => simulator.add(geom).unwrap(),
        Err(error) => assert!(error.to_string().contains("2^31"), "{error}: {what}"),
    }
    simulator.update(0.01);
    assert!(is_finite(&simulator) && simulator.is_listed(body), "nothing can be added: {what}");
}

/// A scene with all kinds of unfinished work: pairs, removed and pending objects, edited bodies, free slots.
fn busy_save(methods: Methods) -> Value {
    let mut simulator = lively_scene(methods, 5);
    let mut game = Game::default();
    for _ in 0..70 {
        game.step(&mut simulator);
    }
    let geom = simulator.geom_list()[5];
    simulator.remove(geom).unwrap();
    let body = simulator.body_list()[10];
    simulator.dispose(body).unwrap();
    let body = simulator.body_list()[11];
    simulator[body].set_position(v(3.0, 4.0));
    add_box(&mut simulator, (10.0, 10.0), v(8.0, 1.0));
    serde_json::to_value(&simulator).unwrap()
}

/// Paths to all numbers of a value.
fn numbers(value: &Value, path: &mut Vec<String>, found: &mut Vec<String>) {
    match value {
        Value::Number(_) => found.push(format!("/{}", path.join("/"))),
        Value::Array(list) => {
            for (index, value) in list.iter().enumerate() {
                path.push(index.to_string());
                numbers(value, path, found);
                path.pop();
            }
        }
        Value::Object(fields) => {
            for (key, value) in fields {
                path.push(key.clone());
                numbers(value, path, found);
                path.pop();
            }
        }
        _ => {}
    }
}

/// The kind of a number's position: its path without indices.
fn kind(path: &str) -> String {
    path.split('/').filter(|part| part.parse::<usize>().is_err()).collect::<Vec<_>>().join("/")
}

/// A few positions of every kind, spread over the file.
fn sample(paths: &[String], per_kind: usize) -> Vec<&String> {
    let mut by_kind = std::collections::BTreeMap::<String, Vec<&String>>::new();
    for path in paths {
        by_kind.entry(kind(path)).or_default().push(path);
    }
    let spread = |list: Vec<&'_ String>| -> Vec<usize> {
        let step = list.len().div_ceil(per_kind).max(1);
        (0..list.len()).step_by(step).collect()
    };
    by_kind.into_values().flat_map(|list| spread(list.clone()).into_iter().map(move |i| list[i])).collect()
}

/// Every broad phase, both narrow phases, and the precise set.
fn some_methods() -> impl Iterator<Item = Methods> {
    let is_needed = |methods: &Methods| match *methods {
        Methods::Faithful { broad, narrow } => {
            narrow == NarrowPhaseCollider::DistanceGrid || broad == BroadPhaseCollider::SelectiveSweep
        }
        _ => true,
    };
    methods().filter(is_needed)
}

/// Puts each replacement at a sample of positions, one at a time. Returns the saves that were not refused, and the number of
/// all.
fn replace_numbers_by(replacements: &[Value], per_kind: usize) -> (Vec<String>, usize) {
    let (mut accepted, mut tried) = (Vec::new(), 0);
    let mut failed = Vec::new();
    for methods in some_methods() {
        let mut save = busy_save(methods);
        let mut paths = Vec::new();
        numbers(&save, &mut Vec::new(), &mut paths);
        for path in sample(&paths, per_kind) {
            let undamaged = save.pointer(path).unwrap().clone();
            for replacement in replacements {
                *save.pointer_mut(path).unwrap() = replacement.clone();
                let what = format!("{methods:?} {path} = {replacement}");
                match std::panic::catch_unwind(|| is_refused_or_runs(loaded(&save), &what)) {
                    Ok(true) => {}
                    Ok(false) => accepted.push(what),
                    Err(_) => failed.push(what),
                }
                tried += 1;
            }
            *save.pointer_mut(path).unwrap() = undamaged;
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
    (accepted, tried)
}

fn some_are_refused((accepted, tried): (Vec<String>, usize)) {
    assert!(!accepted.is_empty() && accepted.len() < tried, "{} of {tried} were accepted", accepted.len());
}

#[test]
fn a_busy_save_is_not_refused() {
    for methods in methods() {
        let text = busy_save(methods).to_string();
        assert!(!is_refused_or_runs(serde_json::from_str(&text), "undamaged"), "{methods:?}");
    }
}

#[test]
fn truncated_text_is_refused() {
    let text = busy_save(Default::default()).to_string();
    for part in 0..200 {
        assert!(serde_json::from_str::<PhysicsSimulator>(&text[..text.len() * part / 200]).is_err());
    }
}

#[test]
fn saves_with_small_numbers_in_wrong_places_are_refused_or_run() {
    some_are_refused(replace_numbers_by(&[0.into(), 1.into(), (-1).into(), 7.into()], 1));
}

#[test]
fn saves_with_ids_and_counts_out_of_range_are_refused_or_run() {
    some_are_refused(replace_numbers_by(
        &[1000.into(), u32::MAX.into(), i32::MAX.into(), i32::MIN.into()],
        2,
    ));
}

#[test]
fn saves_with_the_largest_integers_are_refused_or_run() {
    some_are_refused(replace_numbers_by(
        &[i64::MAX.into(), i64::MIN.into(), u64::MAX.into(), (1u64 << 40).into()],
        1,
    ));
}

#[test]
fn saves_with_extreme_floats_are_refused_or_run() {
    some_are_refused(replace_numbers_by(&[1e38.into(), (-3.4e38).into(), 1e-44.into(), 0.3.into()], 1));
}

/// Derived numbers are saved as bit patterns: these are infinity, NaN and the largest float.
#[test]
fn saves_with_bit_patterns_of_infinity_and_nan_are_refused_or_run() {
    let patterns = [f32::INFINITY, f32::NEG_INFINITY, f32::NAN, f32::MAX].map(|x| x.to_bits().into());
    some_are_refused(replace_numbers_by(&patterns, 1));
}

#[test]
fn saves_with_numbers_beyond_floats_or_none_are_refused() {
    let (mut accepted, _) = replace_numbers_by(&[1e60.into(), Value::Null], 1);
    // Contacts that are awake have no number there.
    accepted.retain(|what| !what.ends_with("/asleep = null"));
    assert!(accepted.is_empty(), "{accepted:#?}");
}

/// Exchanges of two numbers of the same kind: references that exist but are wrong.
#[test]
fn saves_with_numbers_exchanged_are_refused_or_run() {
    for methods in methods() {
        let save = busy_save(methods);
        let mut paths = Vec::new();
        numbers(&save, &mut Vec::new(), &mut paths);
        for pair in paths.windows(2).step_by(paths.len() / 120) {
            let mut damaged = save.clone();
            let (a, b) = (save.pointer(&pair[0]).unwrap(), save.pointer(&pair[1]).unwrap());
            *damaged.pointer_mut(&pair[0]).unwrap() = b.clone();
            *damaged.pointer_mut(&pair[1]).unwrap() = a.clone();
            is_refused_or_runs(loaded(&damaged), &format!("{methods:?} {pair:?} exchanged"));
        }
    }
}

/// A list shorter or longer by one.
#[test]
fn saves_with_lists_of_wrong_length_are_refused_or_run() {
    fn lists(value: &Value, path: String, found: &mut Vec<String>) {
        match value {
            Value::Array(list) => {
                found.push(path.clone());
                for (index, value) in list.iter().enumerate() {
                    lists(value, format!("{path}/{index}"), found);
                }
            }
            Value::Object(fields) => {
                fields.iter().for_each(|(key, value)| lists(value, format!("{path}/{key}"), found));
            }
            _ => {}
        }
    }
    for methods in methods() {
        let save = busy_save(methods);
        let mut paths = Vec::new();
        lists(&save, String::new(), &mut paths);
        for path in sample(&paths, 2) {
            for lengthen in [false, true] {
                let mut damaged = save.clone();
                let list = damaged.pointer_mut(path).unwrap().as_array_mut().unwrap();
                match list.last().cloned() {
                    Some(last) if lengthen => list.push(last),
                    _ => drop(list.pop()),
                }
                let what = format!("{methods:?} {path} {}", if lengthen { "longer" } else { "shorter" });
                let result = std::panic::catch_unwind(|| is_refused_or_runs(loaded(&damaged), &what));
                assert!(result.is_ok(), "{what}");
            }
        }
    }
}

#[test]
fn an_empty_simulator_is_loaded() {
    for methods in methods() {
        let text = serde_json::to_string(&simulator_with(10.0, methods)).unwrap();
        assert!(!is_refused_or_runs(serde_json::from_str(&text), "empty"));
    }
}

/// Loads an edited save of a body with a box.
fn changed_box(change: impl Fn(&mut Value)) -> serde_json::Result<PhysicsSimulator> {
    let mut simulator = simulator_with(10.0, Default::default());
    let (_, geom) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    simulator.update(0.01);
    simulator.set_matrix(geom, &Matrix::identity()).unwrap();
    let mut saved = serde_json::to_value(&simulator).unwrap();
    change(&mut saved);
    serde_json::from_value(saved)
}

#[test]
fn a_simulator_makes_no_geom_when_the_numbers_of_geoms_are_used_up_and_loads_itself() {
    let last = i32::MAX - 1;
    let mut simulator = changed_box(|saved| saved["objects"]["next_geom_number"] = json!(last)).unwrap();
    let body = simulator.body_list()[0];
    let outline = Vertices::create_simple_rectangle(10.0, 10.0).unwrap();
    let make = |simulator: &mut PhysicsSimulator| {
        simulator.create_geom(body, outline.clone(), GeomPlacement::default())
    };
    let geom = make(&mut simulator).unwrap();
    assert_eq!(simulator.geom(geom).unwrap().id(), last as u32);
    let before = simulator.snapshot();
    let error = make(&mut simulator).unwrap_err().to_string();
    assert!(error.contains("2^31 - 1"), "{error}");
    assert!(simulator.clone_geom(body, geom).is_err());
    assert!(simulator.snapshot() == before);
    loads_itself(&simulator, "all numbers used");
}

/// Otherwise a stale id would name another object after 2^32 objects in one slot.
#[test]
fn a_slot_whose_generations_are_used_up_stays_empty() {
    let mut simulator = simulator_with(0.0, Default::default());
    simulator.create_body(Body::new());
    let mut saved = serde_json::to_value(&simulator).unwrap();
    saved["objects"]["bodies"]["entries"]["slots"][0]["generation"] = json!(u32::MAX);
    let mut simulator: PhysicsSimulator = serde_json::from_value(saved).unwrap();
    let last = simulator.bodies().next().unwrap();
    simulator.dispose(last).unwrap();
    simulator.update(0.01);
    loads_itself(&simulator, "a slot is used up");
    let other = simulator.create_body(Body::new());
    assert_eq!((last.slot(), other.slot()), (0, 1));
    assert!(simulator.body(last).is_none());
    loads_itself(&simulator, "a slot is used up and another one in use");
}

#[test]
fn a_box_without_change_is_loaded() {
    assert!(changed_box(|_| ()).is_ok());
}

#[test]
fn non_finite_placements_of_geoms_are_refused() {
    let infinity = json!(f32::INFINITY.to_bits());
    for (what, index) in
        [("aabb", 2), ("world_vertices", 3), ("pose", 4), ("pose", 10), ("pose", 13), ("pose", 14)]
    {
        let loaded = changed_box(|saved| {
            let geom = &mut saved["objects"]["geoms"]["entries"]["slots"][0]["value"]["value"];
            geom["transform"]["Own"][what][index] = infinity.clone()
        });
        let error = loaded.expect_err(what).to_string();
        assert!(error.contains("a geom is not finite"), "{what} {index}: {error}");
    }
    let loaded = changed_box(|saved| {
        saved["objects"]["geoms"]["entries"]["slots"][0]["value"]["value"]["user_matrix"][5] = json!(1e300)
    });
    assert!(loaded.is_err());
}

#[test]
fn unknown_names_of_rejected_arguments_are_refused() {
    for owner in ["bodies", "geoms"] {
        let kind = if owner == "bodies" { "body" } else { "geom" };
        let with = |names: Value| {
            changed_box(|saved| {
                saved["objects"][owner]["entries"]["slots"][0]["value"]["value"][kind]["rejected"] =
                    names.clone()
            })
        };
        assert!(with(json!([])).is_ok());
        let error = with(json!(["colour"])).unwrap_err().to_string();
        assert!(error.contains("refused argument"), "{error}");
    }
}

/// By the name of the type, too: the implementation that is derived for a private copy of its fields must not be accessible.
#[test]
fn a_contradictory_body_is_refused_by_every_loader() {
    let mut saved = serde_json::to_value(Body::new()).unwrap();
    assert!(Body::deserialize(&saved).is_ok());
    saved["mass"] = 2.into();
    assert!(Body::deserialize(&saved).is_err());
}
