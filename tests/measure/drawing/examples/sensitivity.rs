//! What half and twice each number of the precise method changes.
//!
//! `cargo run --profile tools --example sensitivity` copies the workspace to `target/sensitivity/copy`, measures there as it is, then with
//! each number of `farseer-core/src/precise/parameters` at half and at twice its value, those of joints and of the direct solver first.
//! Where a verdict flips it measures with five sixths and six fifths of it, too. It writes `figures.csv` and `report.md` after each
//! number. A run that was ended goes on where it was. Nothing is timed.

use clap::Parser;
use drawing::measuring::Result;
use measure::origin::{origin, origin_csv};
use measure::sensitivity::differences::{Figures, figures_csv, read_figures};
use measure::sensitivity::parameters::{Number, numbers};
use measure::sensitivity::report::report;
use measure::sensitivity::rows::{Row, measured, read_rows, rows_csv};
use measure::shard::Shard;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// What a copy consists of. Examples and other members are there since the workspace names them.
const COPIED: [&str; 10] = [
    "Cargo.toml",
    "Cargo.lock",
    "README.md",
    "docs",
    "farseer-core",
    "twohalf",
    "twohalf-factories",
    "twohalf-render",
    "tests",
    "examples",
];
/// What numbers are multiplied by.
const FACTORS: [f64; 2] = [0.5, 2.0];
/// And where a verdict flips.
const NEAR_FACTORS: [f64; 2] = [1.0 / 1.2, 1.2];
/// A measurement is given up after so many times the time of the first.
const PATIENCE: u32 = 10;

/// Measures what numbers of the precise method change.
#[derive(Debug, Parser)]
struct Arguments {
    /// Only numbers with one of these in their names, or whose file it is.
    #[arg(long, value_name = "NAME", num_args = 1..)]
    only: Vec<String>,
    /// Only one of several parts of the numbers, such as 3/16.
    #[arg(long, value_name = "PART")]
    shard: Option<Shard>,
    /// Lists the numbers and measures nothing.
    #[arg(long)]
    list: bool,
    /// Measures with the engine as it is compiled and writes the rows: what is run in the copy.
    #[arg(long, value_name = "FILE")]
    rows: Option<PathBuf>,
    /// The workspace.
    #[arg(long, value_name = "DIR", default_value = ".")]
    workspace: PathBuf,
    /// Where to write.
    #[arg(long, value_name = "DIR", default_value = "target/sensitivity")]
    out: PathBuf,
}

fn main() -> Result<()> {
    let arguments = Arguments::parse();
    if let Some(file) = &arguments.rows {
        return Ok(fs::write(file, rows_csv(&measured()?))?);
    }
    let numbers = numbers(&arguments.workspace)?;
    let chosen = chosen(&arguments, &numbers);
    if arguments.list {
        for Number { module, name, unit, value, .. } in &chosen {
            println!("{module:<14} {name:<36} {value:<20} {unit}");
        }
        return Ok(());
    }
    let shard = arguments.shard.map_or(String::new(), |shard| format!(".{shard}"));
    let copy = Copy::make(&arguments.workspace, &arguments.out.join(format!("copy{shard}")))?;
    fs::write(arguments.out.join("origin.csv"), origin_csv(&origin([])))?;
    let table = arguments.out.join(format!("figures{shard}.csv"));
    let mut all = fs::read_to_string(&table).map_or(Ok(Vec::new()), |text| read_figures(&text))?;
    let start = Instant::now();
    let before = copy.measure(Duration::MAX)??;
    let patience = PATIENCE * start.elapsed();
    for number in &chosen {
        for factors in [FACTORS, NEAR_FACTORS] {
            let is_known = |all: &[Figures], factor| {
                all.iter().any(|one| one.parameter == number.name && one.factor == factor)
            };
            for factor in factors {
                let Some(value) = number.times(factor).filter(|_| !is_known(&all, factor)) else { continue };
                all.push(copy.figures(number, factor, &value, &before, patience)?);
                eprintln!("{} s: {}", start.elapsed().as_secs(), told(&all[all.len() - 1]));
                all.sort_by_key(|one| numbers.iter().position(|number| number.name == one.parameter));
                fs::write(&table, figures_csv(&all))?;
                fs::write(arguments.out.join(format!("report{shard}.md")), report(&all))?;
            }
            if !all.iter().any(|one| one.parameter == number.name && one.flips > 0) {
                break;
            }
        }
    }
    eprintln!("{}", table.display());
    Ok(())
}

fn told(figures: &Figures) -> String {
    let Figures { parameter, factor, worst_row, before, after, .. } = figures;
    format!("{parameter} times {factor:.2}: {} rows, {worst_row}: {before} -> {after}", figures.rows())
}

/// The numbers that are asked for.
fn chosen(arguments: &Arguments, numbers: &[Number]) -> Vec<Number> {
    let mut all = numbers.to_vec();
    let is_meant =
        |number: &Number, part: &String| number.name.contains(part.as_str()) || number.module == *part;
    all.retain(|number| {
        arguments.only.is_empty() || arguments.only.iter().any(|part| is_meant(number, part))
    });
    let picks = arguments.shard.unwrap_or(Shard::WHOLE).picks(&vec![1.0; all.len()]);
    all.into_iter().zip(picks).filter(|(_, pick)| *pick).map(|(number, _)| number).collect()
}

/// A copy of the workspace, in which numbers are changed.
struct Copy {
    folder: PathBuf,
}

impl Copy {
    fn make(workspace: &Path, folder: &Path) -> Result<Self> {
        fs::create_dir_all(folder)?;
        for name in COPIED {
            copy(&workspace.join(name), &folder.join(name))
                .map_err(|error| format!("cannot copy {name} to {}: {error}", folder.display()))?;
        }
        Ok(Copy { folder: fs::canonicalize(folder)? })
    }

    /// What a number changes; then it is as it was.
    fn figures(
        &self,
        number: &Number,
        factor: f64,
        value: &str,
        before: &[Row],
        patience: Duration,
    ) -> Result<Figures> {
        let file = self.folder.join(number.file());
        let text = fs::read_to_string(&file)?;
        fs::write(&file, number.written_into(&text, value))?;
        let after = self.measure(patience);
        fs::write(&file, text)?;
        let Number { name, module, unit, value, .. } = number.clone();
        let mut figures = Figures { parameter: name, module, unit, value, factor, ..Figures::default() };
        match after? {
            Ok(rows) => figures.count(before, &rows)?,
            Err(reason) => (figures.worst_row, figures.flips) = (reason, 1),
        }
        Ok(figures)
    }

    /// Builds and measures: the rows, or why there are none.
    fn measure(&self, patience: Duration) -> Result<std::result::Result<Vec<Row>, String>> {
        let mut cargo = Command::new("cargo");
        cargo.args(["build", "--offline", "--quiet", "--package", "drawing", "--example", "sensitivity"]);
        cargo.env("CARGO_INCREMENTAL", "1").env("CARGO_TARGET_DIR", self.folder.join("target"));
        // Warnings of numbers that make a comparison useless would be all that is seen.
        let status = cargo.current_dir(&self.folder).stderr(Stdio::null()).status()?;
        if !status.success() {
            return Ok(Err("does not build".to_owned()));
        }
        let rows = self.folder.join("rows.csv");
        let mut program = Command::new(self.folder.join("target/debug/examples/sensitivity"));
        let child =
            program.arg("--rows").arg(&rows).current_dir(&self.folder).stderr(Stdio::null()).spawn()?;
        match ended_well(child, patience)? {
            true => Ok(Ok(read_rows(&fs::read_to_string(&rows)?)?)),
            false => Ok(Err("panics, or takes too long".to_owned())),
        }
    }
}

/// Waits for a program, and ends it if that takes too long.
fn ended_well(mut child: Child, patience: Duration) -> Result<bool> {
    let start = Instant::now();
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(status.success());
        }
        if start.elapsed() > patience {
            child.kill()?;
            child.wait()?;
            return Ok(false);
        }
        sleep(Duration::from_millis(50));
    }
}

/// Copies what is different, so that what is the same is not built again.
fn copy(from: &Path, to: &Path) -> std::io::Result<()> {
    if from.is_dir() {
        if from.file_name().is_some_and(|name| name == "target") {
            return Ok(());
        }
        fs::create_dir_all(to)?;
        return fs::read_dir(from)?.try_for_each(|entry| {
            let entry = entry?;
            copy(&entry.path(), &to.join(entry.file_name()))
        });
    }
    let text = fs::read(from)?;
    if fs::read(to).is_ok_and(|there| there == text) { Ok(()) } else { fs::write(to, text) }
}
