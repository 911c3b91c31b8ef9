//! The original's water sample: a raft with a heap of blocks on water that makes waves where bodies dip in.
//!
//! `cargo run --release --example farseer_water` writes an animation and a page of stills; with `-- --debug` the original's
//! debug view is drawn over the pictures.

use std::path::Path;

use conformance::samples::sample;
use examples::{Result, SampleFilm, wants_debug_view};

/// Folder of the pictures, relative to the working directory.
const FOLDER: &str = "target/farseer_water";

fn main() -> Result<()> {
    let wants_debug_view = wants_debug_view()?;
    let mut scene = (sample("Water").ok_or("there is no such sample")?.build)()?;
    let film = SampleFilm {
        name: "farseer_water",
        seconds: 10,
        stills: &[0.0, 1.0, 1.6, 3.0, 7.0, 9.9],
        picture: None,
        wants_debug_view,
    };
    println!("{}", film.film(Path::new(FOLDER), "Water sample:", &mut scene)?);
    Ok(())
}
