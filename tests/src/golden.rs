//! The recorded runs of the original that lie in the repository.

use std::path::{Path, PathBuf};

/// The folder of the scenes (`NAME.json.gz`), traces (`NAME.trace.gz`) and their `INDEX.csv`.
pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("golden").join("traces")
}
