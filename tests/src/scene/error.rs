//! Errors of a scene: the file, the position in it, and the reason.

use super::At;

/// Why a scene cannot be read, built or driven.
#[derive(Debug)]
pub struct SceneError {
    /// Name of the scene's file, or the name given to [`super::Scene::from_json`].
    pub file: String,
    /// Position in the file, such as `bodies[3].shape.radius`. Empty for the complete file.
    pub at: String,
    /// The reason of the error.
    pub reason: Reason,
}

/// The reason of an error at one position of a scene.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Reason {
    /// The file cannot be read.
    #[error("cannot be read: {0}")]
    File(#[from] std::io::Error),
    /// The text is not JSON; the message has line and column.
    #[error("is not JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// The value does not conform to the scene format.
    #[error("{0}")]
    Format(String),
    /// A number that is not finite as a 32-bit float.
    #[error("{0} is not finite")]
    NotFinite(f32),
    /// An index or id names an object that does not exist (yet).
    #[error("there is no {kind} {index}, only {count} of them")]
    NoSuch {
        /// The kind of the object: `body`, `geom`, ...
        kind: &'static str,
        /// The index or id given.
        index: usize,
        /// How many there are at that moment.
        count: usize,
    },
    /// The engine refused it.
    #[error("{0}")]
    Refused(#[from] farseer_core::Error),
}

impl SceneError {
    /// An error at a position of a file whose name the caller adds with [`SceneError::in_file`].
    pub(crate) fn new(at: At<'_>, reason: impl Into<Reason>) -> Self {
        SceneError { file: String::new(), at: at.to_string(), reason: reason.into() }
    }

    /// An error of form at a position.
    pub(crate) fn format(at: At<'_>, reason: impl Into<String>) -> Self {
        SceneError::new(at, Reason::Format(reason.into()))
    }

    /// The same error with the name of the file.
    pub(crate) fn in_file(self, file: &str) -> Self {
        SceneError { file: file.to_owned(), ..self }
    }

    /// Whether the engine refused a value of the scene (and the file is sound): where the original throws an exception when an
    /// object is created or set.
    pub fn is_refusal(&self) -> bool {
        matches!(self.reason, Reason::Refused(_) | Reason::NotFinite(_))
    }
}

impl std::fmt::Display for SceneError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for part in [&self.file, &self.at] {
            if !part.is_empty() {
                write!(f, "{part}: ")?;
            }
        }
        write!(f, "{}", self.reason)
    }
}

impl std::error::Error for SceneError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(&self.reason)
    }
}
