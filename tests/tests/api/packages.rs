//! Each package can be published: it builds on its own, outside of the repository.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

struct Package {
    folder: PathBuf,
    manifest: Value,
}

/// The packages of the workspace that may be published.
fn packages() -> Vec<Package> {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--no-deps", "--offline", "--locked", "--format-version", "1"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("cargo is there: it runs this");
    let metadata: Value = serde_json::from_slice(&output.stdout).expect("cargo writes JSON");
    let packages = metadata["packages"].as_array().expect("there are packages");
    let published = packages.iter().filter(|package| package["publish"].is_null());
    let found: Vec<Package> = published
        .map(|manifest| {
            let path = Path::new(manifest["manifest_path"].as_str().expect("it has a manifest"));
            let folder = path.parent().expect("a file lies in a folder").to_path_buf();
            Package { folder, manifest: manifest.clone() }
        })
        .collect();
    let names = "farseer-precise, farseer-core, farseer-ffi, twohalf, its factories and its renderer";
    assert_eq!(found.len(), 6, "{names}");
    found
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Targets of the Markdown links in a text.
fn links(text: &str) -> impl Iterator<Item = &str> {
    text.split("](").skip(1).filter_map(|rest| rest.split(')').next())
}

#[test]
fn every_package_has_a_description_and_a_repository() {
    for Package { folder, manifest } in packages() {
        for key in ["description", "license", "repository", "readme"] {
            assert!(manifest[key].is_string(), "{}: no {key}", folder.display());
        }
        assert_eq!(manifest["readme"], "README.md", "{}: a readme of its own", folder.display());
    }
}

#[test]
fn every_package_carries_both_licences() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for Package { folder, .. } in packages() {
        for name in ["LICENSE-MIT", "LICENSE-APACHE"] {
            assert_eq!(read(&folder.join(name)), read(&root.join(name)), "{}", folder.display());
        }
    }
}

#[test]
fn links_of_a_readme_lead_to_files_of_the_same_package_or_to_the_web() {
    for Package { folder, .. } in packages() {
        let readme = read(&folder.join("README.md"));
        assert!(links(&readme).count() >= 2, "{}: at least the licences", folder.display());
        for link in links(&readme) {
            let is_inside = !link.contains("..") && folder.join(link).is_file();
            assert!(link.starts_with("https://") || is_inside, "{}: {link}", folder.display());
        }
    }
}

#[test]
fn every_package_forbids_unsafe_code_but_the_c_abi_which_gives_a_reason_for_each_block() {
    for Package { folder, manifest } in packages() {
        if manifest["name"] == "farseer-ffi" {
            let rules = read(&folder.join("Cargo.toml"));
            assert!(rules.contains("undocumented_unsafe_blocks = \"deny\""));
            continue;
        }
        let library = read(&folder.join("src/lib.rs"));
        assert!(library.lines().any(|line| line == "#![forbid(unsafe_code)]"), "{}", folder.display());
    }
}
