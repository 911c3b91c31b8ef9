//! Compares the 2.5D engine with `rapier3d` in scenes of many objects: flying, standing, at rest, in traffic, in a deep field,
//! on ropes, in a pile.
//!
//! `cargo run --release --features peers --example twohalf_vs_rapier3d` prints a table,
//! `scene,objects,twohalf_ms,rapier3d_ms,ratio,twohalf_error,rapier3d_error`, and writes it to `target/twohalf_vs_rapier3d`.
//! Times hold for the machine that measured them; only ratios of one run may be quoted.

use clap::Parser;
use drawing::measuring::Result;
use std::path::PathBuf;

/// Measures the time per update of `twohalf` and `rapier3d` on grounds crowded with objects.
#[derive(Debug, Parser)]
struct Arguments {
    /// Greatest number of objects: larger scenes are skipped.
    #[arg(long, default_value_t = 10_000)]
    most: usize,
    /// Only scenes with this in their names.
    #[arg(long, value_name = "NAME", default_value = "")]
    scene: String,
    /// Where to write.
    #[arg(long, value_name = "DIR", default_value = "target/twohalf_vs_rapier3d")]
    out: PathBuf,
}

#[cfg(feature = "peers")]
fn main() -> Result<()> {
    use measure::depth::fields::{SIZES, fields, fields_csv, run_field};
    use measure::origin::{origin, origin_csv};
    use std::fs;

    let Arguments { most, scene, out } = Arguments::parse();
    fs::create_dir_all(&out).map_err(|error| format!("cannot write to {}: {error}", out.display()))?;
    let fields: Vec<_> = fields().into_iter().filter(|field| field.name.contains(&scene)).collect();
    fields.iter().for_each(|field| eprintln!("{}: {}", field.name, field.about));
    // The largest scenes come last: in memory that ten thousand objects have used, twenty objects take up to half as long
    // again.
    let sizes = SIZES.into_iter().filter(|&size| size <= most);
    let mut figures: Vec<_> =
        sizes.flat_map(|size| fields.iter().map(move |field| run_field(field, size))).collect();
    figures.sort_by_key(|row| fields.iter().position(|field| field.name == row.scene));
    let table = fields_csv(&figures);
    fs::write(out.join("figures.csv"), &table)?;
    fs::write(out.join("origin.csv"), origin_csv(&origin(measure::depth::depth_peer_versions())))?;
    print!("{table}");
    Ok(())
}

#[cfg(not(feature = "peers"))]
fn main() -> Result<()> {
    let _ = Arguments::parse();
    Err("there is nothing to compare with: run with --features peers".into())
}
