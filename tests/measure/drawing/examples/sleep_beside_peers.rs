//! Sleep beside other engines: what a world costs in which all is at rest, who wakes, and when all rest again.
//!
//! `cargo run --release --features peers --example sleep_beside_peers` prints a report, and writes it to `target/sleep` with
//! the tables that it is made of. Without the feature there are no other engines in it. Times are for the machine they were
//! made on; what may be quoted are ratios of one run.

use clap::Parser;
use drawing::measuring::Result;
use drawing::sleeping::report;
use measure::method::{methods, peer_versions};
use measure::origin::{origin, origin_csv};
use measure::sleep::heaps::{heaps_csv, run_heaps};
use measure::sleep::pushes::{pushes_csv, run_pushes};
use measure::sleep::sleepers;
use std::fs;
use std::path::PathBuf;

/// Measures what sleep saves, and what wakes.
#[derive(Debug, Parser)]
struct Arguments {
    /// Number of heaps.
    #[arg(long, default_value_t = 500, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    heaps: u32,
    /// Where to write.
    #[arg(long, value_name = "DIR", default_value = "target/sleep")]
    out: PathBuf,
}

fn main() -> Result<()> {
    let Arguments { heaps, out } = Arguments::parse();
    // Before anything is run: what cannot be written would be lost.
    fs::create_dir_all(&out).map_err(|error| format!("cannot write to {}: {error}", out.display()))?;
    let methods = sleepers(methods());
    let pushes = run_pushes(&methods)?;
    let heaps = run_heaps(&methods, heaps as usize)?;
    let origin = origin(peer_versions());
    let report = report(&origin, &heaps, &pushes);
    fs::write(out.join("heaps.csv"), heaps_csv(&heaps))?;
    fs::write(out.join("pushes.csv"), pushes_csv(&pushes))?;
    fs::write(out.join("origin.csv"), origin_csv(&origin))?;
    fs::write(out.join("report.md"), &report)?;
    print!("{report}");
    Ok(())
}
