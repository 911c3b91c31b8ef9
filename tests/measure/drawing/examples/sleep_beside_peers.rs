//! Compares sleep in our engine and others: the cost of a world at rest, which bodies wake, and when all rest again.
//!
//! `cargo run --release --features peers --example sleep_beside_peers` prints a report, and writes it with its tables to
//! `target/sleep`. Without the feature no other engines take part. Times hold for the machine that measured them; only ratios
//! of one run may be quoted.

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

/// Measures how much time sleep saves, and which bodies wake.
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
    // The program makes the output folder before the first run, so that it does not measure results it cannot write.
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
