//! Alters the nodes of JSON.

use serde_json::{Value, json};

use crate::random::Random;

/// Number of outer nesting levels in which no field is removed: every simulator has these fields, and loading fails without
/// one.
const SHALLOW: usize = 3;

/// Alters a random value, list or field of a tree.
pub(crate) fn alter(tree: &mut Value, random: &mut Random) {
    alter_at(tree, random, 0);
}

fn alter_at(tree: &mut Value, random: &mut Random, depth: usize) {
    match tree {
        Value::Object(fields) if !fields.is_empty() => {
            let chosen = random.below(fields.len());
            let Some(key) = fields.keys().nth(chosen).cloned() else { return };
            if depth > SHALLOW && random.chance(3) {
                fields.remove(&key);
            } else {
                alter_at(&mut fields[&key], random, depth + 1);
            }
        }
        Value::Array(items) if !items.is_empty() => {
            let chosen = random.below(items.len());
            if random.chance(10) {
                random.pick(LIST_ALTERATIONS)(items, chosen, random);
            } else {
                alter_at(&mut items[chosen], random, depth + 1);
            }
        }
        Value::Number(_) => *tree = random.pick(NUMBERS)(random),
        Value::Bool(value) => *value = !*value,
        Value::Null => *tree = json!(1),
        _ => {}
    }
}

const LIST_ALTERATIONS: &[fn(&mut Vec<Value>, usize, &mut Random)] = &[
    |items, chosen, _| drop(items.remove(chosen)),
    |items, chosen, _| items.push(items[chosen].clone()),
    |items, chosen, random| {
        let other = random.below(items.len());
        items.swap(chosen, other);
    },
];

const NUMBERS: &[fn(&mut Random) -> Value] = &[
    |_| json!(0),
    |_| json!(-1),
    |_| json!(u32::MAX),
    |_| json!(i32::MAX),
    |_| json!(u64::MAX),
    |random| json!(random.wild_number()),
    |random| json!(random.between(-100.0, 100.0)),
    |random| json!(random.below(40)),
];
