//! Errors of making, reading and writing pictures.

use std::path::{Path, PathBuf};

/// Reason why a call was refused or a file could not be read or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// An argument has a value that is not accepted. The refused call has changed nothing.
    #[error("{argument} is {value}, but must be {requirement}")]
    InvalidArgument {
        /// Name of the argument, as in the function's signature.
        argument: &'static str,
        /// The value that was given.
        value: String,
        /// The accepted values.
        requirement: &'static str,
    },
    /// A file could not be read.
    #[error("cannot read {}", path.display())]
    ReadFile {
        /// The file.
        path: PathBuf,
        /// Error of the operating system.
        source: std::io::Error,
    },
    /// A file, or a folder above it, could not be written.
    #[error("cannot write {}", path.display())]
    WriteFile {
        /// The file.
        path: PathBuf,
        /// Error of the operating system.
        source: std::io::Error,
    },
    /// The data are no PNG picture, or one larger than [`MAX_SIDE`] or [`MAX_PIXELS`] allow.
    #[error("cannot decode the PNG picture {name}")]
    DecodePng {
        /// The file's path, or "in memory".
        name: String,
        /// Error of the decoder.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// The data are no JPEG picture, or one larger than [`MAX_SIDE`] or [`MAX_PIXELS`] allow.
    #[error("cannot decode the JPEG picture {name}")]
    DecodeJpeg {
        /// The file's path, or "in memory".
        name: String,
        /// Error of the decoder.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// No file has this name.
    #[error("there is no picture {name} in {}", folder.display())]
    NoPicture {
        /// The requested name.
        name: String,
        /// The folder of the search.
        folder: PathBuf,
    },
    /// An error of the engine.
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

/// Longest side of a canvas or texture, px.
pub const MAX_SIDE: u32 = 16_384;

/// Greatest number of pixels of a canvas or texture (256 MiB as RGBA8).
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

    /// A [`RenderError::WriteFile`] from an error of the operating system.
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

/// Refuses NaN and values outside the range.
pub(crate) fn check_range(
    argument: &'static str,
    value: f32,
    range: std::ops::RangeInclusive<f32>,
    requirement: &'static str,
) -> Result<()> {
    if range.contains(&value) { Ok(()) } else { Err(RenderError::invalid(argument, value, requirement)) }
}
