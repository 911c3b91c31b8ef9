//! What can go wrong when pictures are made, read or written.

use std::path::{Path, PathBuf};

/// Why a call was refused or a file could not be read or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// An argument has a value that cannot be accepted. The refused call has changed nothing.
    #[error("{argument} is {value}, but must be {requirement}")]
    InvalidArgument {
        /// Name of the argument, as in the function's signature.
        argument: &'static str,
        /// The value that was given.
        value: String,
        /// What would have been accepted.
        requirement: &'static str,
    },
    /// A file could not be read.
    #[error("cannot read {}", path.display())]
    ReadFile {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        source: std::io::Error,
    },
    /// A file, or a folder above it, could not be written.
    #[error("cannot write {}", path.display())]
    WriteFile {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        source: std::io::Error,
    },
    /// What was given as a PNG picture is not one, or is larger than [`MAX_SIDE`] or [`MAX_PIXELS`] allow.
    #[error("cannot decode the PNG picture {name}")]
    DecodePng {
        /// The file's path, or "in memory".
        name: String,
        /// What the decoder said.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// What was given as a JPEG picture is not one, or is larger than [`MAX_SIDE`] or [`MAX_PIXELS`] allow.
    #[error("cannot decode the JPEG picture {name}")]
    DecodeJpeg {
        /// The file's path, or "in memory".
        name: String,
        /// What the decoder said.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// No file has this name.
    #[error("there is no picture {name} in {}", folder.display())]
    NoPicture {
        /// The name that was asked for.
        name: String,
        /// Where it was looked for.
        folder: PathBuf,
    },
    /// The engine has refused what was asked of it.
    #[error(transparent)]
    Engine(#[from] twohalf::Error),
}

impl From<twohalf::farseer_core::Error> for RenderError {
    fn from(error: twohalf::farseer_core::Error) -> Self {
        RenderError::Engine(error.into())
    }
}

/// Result of a call that makes, reads or writes a picture.
pub type Result<T, E = RenderError> = std::result::Result<T, E>;

/// Longest side of a canvas or texture, in px.
pub const MAX_SIDE: u32 = 16_384;

/// Most pixels of a canvas or texture (256 MiB as RGBA8).
pub const MAX_PIXELS: u64 = 1 << 26;

impl RenderError {
    /// A [`RenderError::InvalidArgument`].
    pub(crate) fn invalid(
        argument: &'static str,
        value: impl std::fmt::Debug,
        requirement: &'static str,
    ) -> Self {
        RenderError::InvalidArgument { argument, value: format!("{value:?}"), requirement }
    }

    /// A [`RenderError::WriteFile`] from what the operating system said.
    pub(crate) fn write(path: &Path, source: std::io::Error) -> Self {
        RenderError::WriteFile { path: path.to_owned(), source }
    }
}

/// Refuses pictures that are empty or too large.
pub(crate) fn check_size(width: u32, height: u32) -> Result<()> {
    let allowed = 1..=MAX_SIDE;
    if !allowed.contains(&width) {
        return Err(RenderError::invalid("width", width, "1 to 16384 px"));
    }
    if !allowed.contains(&height) {
        return Err(RenderError::invalid("height", height, "1 to 16384 px"));
    }
    if u64::from(width) * u64::from(height) > MAX_PIXELS {
        return Err(RenderError::invalid("width x height", (width, height), "at most 2^26 px"));
    }
    Ok(())
}

/// Refuses NaN and what lies outside the range.
pub(crate) fn check_range(
    argument: &'static str,
    value: f32,
    range: std::ops::RangeInclusive<f32>,
    requirement: &'static str,
) -> Result<()> {
    if range.contains(&value) { Ok(()) } else { Err(RenderError::invalid(argument, value, requirement)) }
}
