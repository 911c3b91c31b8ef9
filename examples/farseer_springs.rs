//! Samples of the original with springs and with joints.
//!
//! - Simple 6: levers, ropes and a ball on springs.
//! - Simple 7: spiders that bend their legs.
//! - Advanced 5: a vehicle in a track of hinged plates.
//!
//! `cargo run --release --example farseer_springs` writes an animation and a page of stills of each; with `-- --debug` the
//! original's debug view is drawn over the pictures.

use std::path::Path;

use conformance::samples::sample;
use examples::{Result, SampleFilm, wants_debug_view};

/// Folder of the pictures, relative to the working directory.
const FOLDER: &str = "target/farseer_springs";

fn main() -> Result<()> {
    let wants_debug_view = wants_debug_view()?;
    let film = |name, seconds, stills| SampleFilm { name, seconds, stills, picture: None, wants_debug_view };
    let films = [
        (
            "Simple 6",
            "Linear and angular springs",
            film("farseer_springs", 6, &[0.0, 0.6, 1.2, 1.8, 3.0, 5.9]),
        ),
        ("Simple 7", "Dynamic angle joints", film("farseer_spiders", 8, &[0.0, 1.0, 2.0, 4.5, 6.0, 7.9])),
        ("Advanced 5", "Path factory", film("farseer_track", 6, &[0.0, 0.6, 1.2, 1.8, 3.0, 5.9])),
    ];
    for (name, title, film) in films {
        let mut scene = (sample(name).ok_or("there is no such sample")?.build)()?;
        println!("{}\n", film.film(Path::new(FOLDER), &format!("{name}, {title}:"), &mut scene)?);
    }
    Ok(())
}
