//! The search of rustdoc finds members by the original's names: unless the name is the same but for case and underscores, the
//! item has an alias.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use super::{Row, rows};

/// Members whose counterpart every Rust programmer knows.
const LANGUAGE: [&str; 8] =
    ["Equals", "ToString", "Clone", "CompareTo", "GetEnumerator", "Invoke", "Instance", "this[]"];

/// A name without case and underscores.
fn bare(name: &str) -> String {
    name.replace('_', "").to_lowercase()
}

/// The texts in quotes of a line of an alias attribute.
fn quoted(line: &str) -> impl Iterator<Item = &str> {
    line.split('"').skip(1).step_by(2)
}

/// The name of the item that begins in a line.
fn item(line: &str) -> Option<&str> {
    let mut words = line.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|word| !word.is_empty());
    words.find(|word| {
        !["pub", "const", "fn", "struct", "enum", "trait", "type", "crate", "mut"].contains(word)
    })
}

/// Adds the aliases in a source file to those of each item name.
fn read_aliases(source: &str, aliases: &mut BTreeMap<String, Vec<String>>) {
    let mut waiting: Vec<String> = Vec::new();
    let mut is_inside = false;
    for line in source.lines().map(str::trim_start) {
        is_inside |= line.starts_with("#[doc(alias");
        if is_inside {
            waiting.extend(quoted(line).map(String::from));
            is_inside = !line.ends_with(")]");
        } else if !line.starts_with("#[")
            && !line.starts_with("//")
            && let Some(item) = item(line)
        {
            aliases.entry(item.to_string()).or_default().append(&mut waiting);
        }
    }
}

/// The aliases of each item name in the sources of the core and of its solver.
fn aliases() -> BTreeMap<String, Vec<String>> {
    let mut aliases = BTreeMap::new();
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    // The core exports scalars and types of the other crate.
    let mut folders = vec![workspace.join("farseer-core/src"), workspace.join("farseer-precise/src")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("the sources are there") {
            let path = entry.expect("they can be listed").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                read_aliases(&fs::read_to_string(path).expect("they are text"), &mut aliases);
            }
        }
    }
    aliases
}

/// The member an alias such as `Body.GetWorldPosition(Vector2)` names.
fn member(alias: &str) -> &str {
    let name = alias.split('(').next().unwrap_or(alias);
    name.rsplit('.').next().unwrap_or(name)
}

/// Whether rustdoc finds a member under its original name.
fn is_found(row: &Row, aliases: &BTreeMap<String, Vec<String>>) -> bool {
    let names_member = |alias: &String| member(alias) == row.member;
    let mut segments = row.paths().flat_map(|path| path.split([':', '.']));
    segments.any(|segment| {
        bare(segment) == bare(&row.member)
            || aliases.get(segment).is_some_and(|aliases| aliases.iter().any(names_member))
    })
}

#[test]
fn api_members_are_found_under_their_original_names() {
    let aliases = aliases();
    let mut is_any_found: BTreeMap<(String, String), bool> = BTreeMap::new();
    for row in rows() {
        let is_language = LANGUAGE.contains(&row.member.as_str()) || row.member.starts_with("op_");
        if row.excuse.is_empty() && row.kind != "constructor" && !is_language {
            let found = is_found(&row, &aliases);
            // One overload is enough.
            *is_any_found.entry((row.of, row.member)).or_default() |= found;
        }
    }
    let lost: Vec<_> = is_any_found.iter().filter(|(_, found)| !**found).map(|(member, _)| member).collect();
    assert!(lost.is_empty(), "no alias: {lost:#?}");
}

#[test]
fn names_that_games_use_and_2_1_3_lacks_are_found() {
    let guide = include_str!("../../../farseer-core/src/guide/porting.md");
    let section = guide.split("# From 2.0 to 2.1.3 to here").nth(1).expect("the section with its table");
    let cells =
        section.lines().filter(|line| line.starts_with("| `")).filter_map(|line| line.split('|').nth(1));
    let names: Vec<&str> = cells.flat_map(|cell| cell.split('`').skip(1).step_by(2)).map(member).collect();
    let aliases = aliases();
    let is_found = |name: &str| {
        aliases
            .iter()
            .any(|(item, of)| bare(item) == bare(name) || of.iter().any(|alias| member(alias) == name))
    };
    let lost: Vec<_> = names.iter().filter(|name| !is_found(name)).collect();
    assert!(lost.is_empty(), "no alias: {lost:?}");
    assert!(names.contains(&"CalculateGridCellSizeFromAABB"), "{names:?}");
}
