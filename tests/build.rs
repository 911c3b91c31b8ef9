//! Makes code of the tables in `docs` that say where the members of other APIs are: it names every path, with the row
//! that does behind it, so that a path that does not exist fails the build and the compiler shows the row.

use std::error::Error;
use std::fmt::Write;
use std::path::Path;
use std::{env, fs};

use csv::{Reader, StringRecord};

/// Traits whose methods are named, and what implements them: the tests bring these names along.
const TRAITS: [(&str, &str); 5] = [
    ("farseer_core::EventHandler", "Silent"),
    ("farseer_core::FluidContainer", "AabbFluidContainer"),
    ("farseer_core::UserController", "Idle"),
    ("twohalf::EventHandler", "Silent"),
    ("twohalf_render::DrawBody", "TwoHalfPhysicsSimulator"),
];

fn main() -> Result<(), Box<dyn Error>> {
    for table in ["farseer-api", "twohalf-appendix"] {
        println!("cargo::rerun-if-changed=../docs/{table}.csv");
        let code = code(table).map_err(|error| format!("docs/{table}.csv: {error}"))?;
        fs::write(Path::new(&env::var("OUT_DIR")?).join(format!("{table}.rs")), code)?;
    }
    Ok(())
}

/// A list of what each path of a table is called, each by a macro that uses it.
fn code(table: &str) -> Result<String, Box<dyn Error>> {
    let mut reader = Reader::from_path(format!("../docs/{table}.csv"))?;
    let head = reader.headers()?.clone();
    let column = |name| head.iter().position(|cell| cell == name).ok_or(format!("no column {name}"));
    let (member, rust, types) = (column("member")?, column("rust")?, column("rust_types")?);
    let mut code = String::from("vec![\n");
    for row in reader.records() {
        let row = row?;
        let place = format!("docs/{table}.csv, line {}: {}.{}", line(&row), &row[0], &row[member]);
        for (path, of) in typed(&row[rust], &row[types]).ok_or(format!("{place}: one type for each path"))? {
            writeln!(code, "    {}, // {place}", named(path, of))?;
        }
    }
    Ok(code + "]\n")
}

/// The line a row begins in.
fn line(row: &StringRecord) -> u64 {
    row.position().map_or(0, |position| position.line())
}

/// Each path with its type; where the cell of types is empty, the compiler knows them all.
fn typed<'a>(paths: &'a str, types: &'a str) -> Option<Vec<(&'a str, &'a str)>> {
    let paths: Vec<&str> = paths.split_whitespace().collect();
    let types = if types.is_empty() { vec!["_"; paths.len()] } else { types.split("; ").collect() };
    (paths.len() == types.len()).then(|| paths.into_iter().zip(types).collect())
}

/// What uses a path: names tell variants and types from functions and constants.
fn named(path: &str, of: &str) -> String {
    let (owner, field) = path.split_once('.').unwrap_or((path, ""));
    let without_parameters = owner.split("::<").next().unwrap_or(owner);
    let (parent, last) = without_parameters.rsplit_once("::").unwrap_or(("", without_parameters));
    let is_in_type = is_type(parent.rsplit("::").next().unwrap_or(parent));
    if let Some((_, implementor)) = TRAITS.iter().find(|(name, _)| *name == parent) {
        return format!("method!({implementor} as {parent}, {last})");
    }
    match (is_type(last), is_in_type, field.is_empty()) {
        (true, true, true) => format!("variant!({path})"),
        (true, true, false) => format!("variant_field!({owner}, {field})"),
        (true, false, true) => format!("a_type!({path})"),
        (_, _, false) => format!("field!({owner}, {field})"),
        (false, _, true) => format!("value!({path}: {of})"),
    }
}

/// Whether a name is in the case of types and variants.
fn is_type(name: &str) -> bool {
    name.starts_with(char::is_uppercase) && name.contains(char::is_lowercase)
}
