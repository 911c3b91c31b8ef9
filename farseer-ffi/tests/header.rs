//! The committed header and the C# file have the functions of the library.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn header() -> PathBuf {
    root().join("include/farseer.h")
}

/// The header that cbindgen makes of the sources.
fn generated() -> String {
    let config = cbindgen::Config::from_file(root().join("cbindgen.toml")).unwrap();
    let bindings = cbindgen::generate_with_config(root(), config).unwrap();
    let mut text = Vec::new();
    bindings.write(&mut text);
    String::from_utf8(text).unwrap()
}

/// `RENEW_HEADER=1 cargo test -p farseer-ffi --test header` writes the header anew.
#[test]
fn the_committed_header_is_that_of_the_sources() {
    let generated = generated();
    if std::env::var_os("RENEW_HEADER").is_some() {
        std::fs::write(header(), &generated).unwrap();
    }
    let committed = std::fs::read_to_string(header()).unwrap();
    assert!(committed == generated, "renew it: RENEW_HEADER=1 cargo test -p farseer-ffi --test header");
}

/// Names of functions in a text, each with the number of its parameters. `marker` precedes the name.
fn functions(text: &str, is_declared: impl Fn(&str) -> bool) -> BTreeMap<String, usize> {
    let mut found = BTreeMap::new();
    for (place, _) in text.match_indices("farseer_") {
        let (before, rest) = text.split_at(place);
        let line = before.rsplit('\n').next().unwrap_or_default();
        let Some((name, rest)) = rest.split_once('(') else { continue };
        let Some((parameters, after)) = rest.split_once(");") else { continue };
        let is_name = name.chars().all(|letter| letter.is_ascii_alphanumeric() || letter == '_');
        if !is_name || !is_declared(line) || after.starts_with(')') {
            continue;
        }
        let is_empty = ["", "void"].contains(&parameters.trim());
        found.insert(name.to_owned(), if is_empty { 0 } else { parameters.matches(',').count() + 1 });
    }
    found
}

#[test]
fn the_csharp_file_has_every_function_of_the_header() {
    let header = functions(&generated(), |line| !line.starts_with("//") && !line.contains(" * "));
    let csharp = std::fs::read_to_string(root().join("csharp/Farseer.cs")).unwrap();
    // Attributes of parameters have a comma.
    let csharp = csharp.replace("[In, Out]", "[InOut]");
    let csharp = functions(&csharp, |line| line.contains("extern "));
    assert!(header.len() > 150, "{}", header.len());
    assert_eq!(csharp, header);
}
