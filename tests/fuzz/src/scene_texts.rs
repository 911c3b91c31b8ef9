//! Loads altered scenes in JSON.

use std::{fs, io};

use conformance::file::read_text;
use conformance::golden;
use conformance::run::Run;
use conformance::scene::Scene;
use serde_json::Value;

use crate::random::Random;
use crate::saves::trees;

/// Number of steps that an accepted scene makes.
const STEPS: usize = 3;
/// Compressed length, in bytes, of the longest scene that is altered. Longer scenes take too long for thousands of seeds.
const LONGEST: u64 = 2_000;

/// Alters a scene and loads it. The loader must return an error, or a scene that can be built and makes steps, or that the
/// simulator refuses when it is built.
///
/// # Errors
/// If no recorded scenes are found. A violation is a panic.
pub fn altered_scene(seed: u64) -> Result<(), String> {
    let mut random = Random::new(seed);
    let text = original(&mut random).map_err(|error| format!("no scene to alter: {error}"))?;
    let text = if random.chance(80) { alter_tree(&text, &mut random) } else { alter_text(text, &mut random) };
    if let Ok(scene) = Scene::from_json("altered", &text) {
        make_steps(&scene);
    }
    Ok(())
}

fn make_steps(scene: &Scene) {
    let Ok(mut run) = Run::build(scene) else { return };
    for _ in 0..STEPS {
        if run.step().is_err() {
            return;
        }
    }
}

/// Returns the text of a random scene among the short ones of the recorded scenes.
fn original(random: &mut Random) -> io::Result<String> {
    let mut names = Vec::new();
    for entry in fs::read_dir(golden::folder())? {
        let entry = entry?;
        let path = entry.path();
        let is_scene = path.to_string_lossy().ends_with(".json.gz");
        if is_scene && entry.metadata()?.len() < LONGEST {
            names.push(path);
        }
    }
    names.sort();
    read_text(&names[random.below(names.len())])
}

fn alter_tree(text: &str, random: &mut Random) -> String {
    let mut tree: Value = serde_json::from_str(text).unwrap_or_default();
    for _ in 0..1 + random.below(3) {
        trees::alter(&mut tree, random);
    }
    tree.to_string()
}

/// Overwrites, removes or repeats a few characters of a text.
fn alter_text(text: String, random: &mut Random) -> String {
    let mut bytes = text.into_bytes();
    for _ in 0..1 + random.below(4) {
        let at = random.below(bytes.len());
        match random.below(3) {
            0 => bytes[at] = random.pick(CHARACTERS),
            1 => bytes.truncate(at.max(1)),
            _ => {
                bytes.splice(at..at, bytes[at..].iter().take(20).copied().collect::<Vec<u8>>()).for_each(drop)
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Returns a random text that is no scene: other JSON, or no JSON at all.
pub fn garbage(seed: u64) -> String {
    let mut random = Random::new(seed);
    if random.toss() {
        return (0..random.below(60)).map(|_| random.pick(CHARACTERS) as char).collect();
    }
    tree(&mut random, 4).to_string()
}

const CHARACTERS: &[u8] = b"{}[]\",:0-9e.\\ntf ";
/// Names of fields of scenes. Garbage uses them so that the loader reads on after the first field.
const FIELDS: [&str; 8] = ["bodies", "geoms", "joints", "simulator", "dt", "steps", "trace", "script"];

fn tree(random: &mut Random, depth: usize) -> Value {
    match random.below(if depth == 0 { 4 } else { 7 }) {
        0 => Value::Null,
        1 => random.toss().into(),
        2 => random.wild_number().into(),
        3 => random.pick(&FIELDS).into(),
        4 => (0..random.below(4)).map(|_| tree(random, depth - 1)).collect(),
        _ => {
            (0..random.below(9)).map(|_| (random.pick(&FIELDS).to_owned(), tree(random, depth - 1))).collect()
        }
    }
}
