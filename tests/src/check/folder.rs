//! Which scenes and traces lie in a folder.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

/// A scene and its trace, at least one of which was found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Entry {
    /// Name of the scene.
    pub name: String,
    /// File of the scene.
    pub scene: Option<PathBuf>,
    /// File of the trace.
    pub trace: Option<PathBuf>,
}

/// The scenes (`NAME.json`) and traces (`NAME.trace`) of a folder by name, plain or compressed (`.gz`); plain
/// ones come first. Folders in it are not searched.
///
/// # Errors
///
/// When the folder cannot be read.
pub fn entries(folder: &Path) -> io::Result<Vec<Entry>> {
    let mut found: BTreeMap<String, Entry> = BTreeMap::new();
    for file in std::fs::read_dir(folder)? {
        let path = file?.path();
        let file = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        let plain = file.strip_suffix(".gz").unwrap_or(file);
        let (name, is_scene) = match plain.rsplit_once('.') {
            Some((name, "json")) => (name, true),
            Some((name, "trace")) => (name, false),
            _ => continue,
        };
        if !path.is_file() {
            continue;
        }
        let entry = found.entry(name.to_owned()).or_insert_with(|| Entry {
            name: name.to_owned(),
            scene: None,
            trace: None,
        });
        let place = if is_scene { &mut entry.scene } else { &mut entry.trace };
        if place.is_none() || plain == file {
            *place = Some(path);
        }
    }
    Ok(found.into_values().collect())
}
