//! Measures the effect of each parameter of the precise method: rows of measurements that change at half and at twice its
//! value.
//!
//! `cargo run --profile tools --example sensitivity` copies the workspace to `target/sensitivity/copy` and measures there.
//!
//! 1. The engine with the present values of all parameters.
//! 2. Twelve engines in which one parameter each is a ten-thousandth greater. They show the rows that change by chance
//!    (`chaotic.txt`).
//! 3. Each parameter of `farseer-precise/src/parameters` at half and at twice its value. Parameters of joints and of the
//!    direct solver come first. If a verdict flips, five sixths and six fifths of the value are measured, too.
//!
//! It writes `figures.csv` and `report.md` after each parameter. A run that was ended goes on where it was. No time is
//! measured.

use clap::Parser;
use drawing::measuring::{Result, merged_origin, tables};
use measure::origin::{origin, origin_csv};
use measure::sensitivity::differences::{Figures, chaotic, figures_csv, read_figures};
use measure::sensitivity::parameters::{Parameter, parameters};
use measure::sensitivity::report::report;
use measure::sensitivity::rows::{Row, measured, read_rows, rows_csv};
use measure::shard::Shard;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Files and folders of the workspace that are copied. Examples and other members are among them because the manifest names
/// them.
const COPIED: [&str; 11] = [
    "Cargo.toml",
    "Cargo.lock",
    "README.md",
    "docs",
    "farseer-precise",
    "farseer-core",
    "twohalf",
    "twohalf-factories",
    "twohalf-render",
    "tests",
    "examples",
];
/// Factors by which the value of each parameter is multiplied. Dimensionless.
const FACTORS: [f64; 2] = [0.5, 2.0];
/// Factors of a parameter's value that are measured in addition if a verdict flips. Dimensionless.
const NEAR_FACTORS: [f64; 2] = [1.0 / 1.2, 1.2];
/// Names of parameters of all stages of the precise set. Each is changed by a ten-thousandth of its value: rows of the table that
/// change with that are chaotic.
const NUDGED: [&str; 12] = [
    "CONTACT_FREQUENCY",
    "CONTACT_DAMPING_RATIO",
    "JOINT_FREQUENCY",
    "JOINT_DAMPING_RATIO",
    "PREDICTED_ROTATION_ERROR",
    "MOMENTUM_SHARE_OF_STIFFNESS",
    "MOMENTUM_SHARE_HALVED_AT",
    "HANDED_OVER_IMPULSE_LOSS",
    "JOINTED_PENETRATION_RATE",
    "FIRST_COMPLIANCE",
    "JOINT_ROW_COMPLIANCE",
    "GREATEST_SAG",
];
/// Factor of the slight change of the parameters in `NUDGED`, dimensionless. It changes no row of a scene without chaos, but is
/// far greater than rounding errors.
const NUDGE: f64 = 1.0001;
/// A measurement is given up after this number of times the duration of the first one.
const PATIENCE: u32 = 10;

/// Measures the effect of each parameter of the precise method.
#[derive(Debug, Parser)]
struct Arguments {
    /// Only parameters with one of these in their names, or from a file of this name.
    #[arg(long, value_name = "NAME", num_args = 1..)]
    only: Vec<String>,
    /// Only one of several shards of the parameters, such as 3/16.
    #[arg(long, value_name = "PART")]
    shard: Option<Shard>,
    /// Measures nothing: merges the tables of all shards, from these files or folders.
    #[arg(long, value_name = "PATH", num_args = 1.., conflicts_with = "shard")]
    merge: Vec<PathBuf>,
    /// Lists the parameters and measures nothing.
    #[arg(long)]
    list: bool,
    /// Measures with the engine as it is compiled and writes the rows: the mode that is run in the copy.
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
    let parameters = parameters(&arguments.workspace)?;
    if arguments.list {
        for Parameter { module, name, unit, value, .. } in chosen(&arguments, &parameters) {
            println!("{module:<14} {name:<36} {value:<20} {unit}");
        }
        return Ok(());
    }
    let mut table = Table::open(&arguments)?;
    if arguments.merge.is_empty() {
        measure_all(&arguments, &parameters, &mut table)?;
    }
    table.write()?;
    eprintln!("{}", table.file.display());
    Ok(())
}

/// Measures every entry that the table lacks.
fn measure_all(arguments: &Arguments, parameters: &[Parameter], table: &mut Table) -> Result<()> {
    let copy = Copy::make(&arguments.workspace, &arguments.out.join(format!("copy{}", table.part)))?;
    let start = Instant::now();
    let mut before = vec![copy.measure(Duration::MAX)??];
    let patience = PATIENCE * start.elapsed();
    for name in NUDGED {
        let number = parameters.iter().find(|number| number.name == name);
        let number = number.ok_or_else(|| format!("there is no number {name}"))?;
        let value = number.times(NUDGE).ok_or_else(|| format!("{name} cannot be nudged"))?;
        before.push(copy.measure_with(number, &value, patience)??);
    }
    fs::write(table.file.with_file_name("chaotic.txt"), chaotic(&before).join("\n") + "\n")?;
    for number in &chosen(arguments, parameters) {
        for factors in [FACTORS, NEAR_FACTORS] {
            for factor in factors {
                let Some(value) = number.times(factor) else { continue };
                if table.of(number).all(|one| one.factor != factor) {
                    let figures = copy.figures(number, factor, &value, &before, patience)?;
                    eprintln!("{} s: {}", start.elapsed().as_secs(), told(&figures));
                    table.add(figures, parameters);
                    table.write()?;
                }
            }
            if table.of(number).all(|one| one.flips == 0) {
                break;
            }
        }
    }
    Ok(())
}

/// Table of figures as far as they are measured, with the file that holds it.
struct Table {
    file: PathBuf,
    /// Suffix of file names, which names the shard.
    part: String,
    all: Vec<Figures>,
}

impl Table {
    /// Opens the table of an interrupted run, or the tables of all shards.
    fn open(arguments: &Arguments) -> Result<Self> {
        let part = arguments.shard.map_or(String::new(), |shard| format!(".{shard}"));
        fs::create_dir_all(&arguments.out)?;
        let file = arguments.out.join(format!("figures{part}.csv"));
        let texts = match &arguments.merge[..] {
            [] => fs::read_to_string(&file).into_iter().collect(),
            parts => {
                let (texts, all) = tables(parts, "figures")?;
                fs::write(
                    arguments.out.join("origin.csv"),
                    origin_csv(&merged_origin(origin([]), Some(&all))),
                )?;
                texts
            }
        };
        if arguments.merge.is_empty() {
            fs::write(arguments.out.join(format!("origin{part}.csv")), origin_csv(&origin([])))?;
        }
        let all = texts.iter().map(|text| read_figures(text)).collect::<std::result::Result<Vec<_>, _>>()?;
        Ok(Table { file, part, all: all.concat() })
    }

    /// Returns the lines of a parameter that were measured while it had its present default value.
    fn of(&self, number: &Parameter) -> impl Iterator<Item = &Figures> {
        self.all.iter().filter(|one| one.parameter == number.name && one.value == number.value)
    }

    /// Adds a line in the order of the parameters. Removes lines of the same parameter that were measured with another default
    /// value.
    fn add(&mut self, figures: Figures, parameters: &[Parameter]) {
        self.all.retain(|one| one.parameter != figures.parameter || one.value == figures.value);
        self.all.push(figures);
        self.all.sort_by_key(|one| parameters.iter().position(|number| number.name == one.parameter));
    }

    fn write(&self) -> Result<()> {
        fs::write(&self.file, figures_csv(&self.all))?;
        Ok(fs::write(self.file.with_file_name(format!("report{}.md", self.part)), report(&self.all))?)
    }
}

fn told(figures: &Figures) -> String {
    let Figures { parameter, factor, worst_row, before, after, .. } = figures;
    format!("{parameter} times {factor:.2}: {} rows, {worst_row}: {before} -> {after}", figures.rows())
}

/// Returns the parameters that the arguments select.
fn chosen(arguments: &Arguments, parameters: &[Parameter]) -> Vec<Parameter> {
    let mut all = parameters.to_vec();
    let is_meant =
        |number: &Parameter, part: &String| number.name.contains(part.as_str()) || number.module == *part;
    all.retain(|number| {
        arguments.only.is_empty() || arguments.only.iter().any(|part| is_meant(number, part))
    });
    let picks = arguments.shard.unwrap_or(Shard::WHOLE).picks(&vec![1.0; all.len()]);
    all.into_iter().zip(picks).filter(|(_, pick)| *pick).map(|(number, _)| number).collect()
}

/// Rows of a measurement, or the reason why there are none.
type Measured = std::result::Result<Vec<Row>, String>;

/// A copy of the workspace, in which the program changes the values of parameters.
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

    /// Returns the changes that another value of a parameter makes.
    fn figures(
        &self,
        number: &Parameter,
        factor: f64,
        value: &str,
        before: &[Vec<Row>],
        patience: Duration,
    ) -> Result<Figures> {
        let after = self.measure_with(number, value, patience)?;
        let Parameter { name, module, unit, value, .. } = number.clone();
        let mut figures = Figures { parameter: name, module, unit, value, factor, ..Figures::default() };
        match after {
            Ok(rows) => figures.count(before, &rows)?,
            Err(reason) => (figures.worst_row, figures.flips) = (reason, 1),
        }
        Ok(figures)
    }

    /// Measures with another value of a parameter, and restores the old value after that.
    fn measure_with(&self, number: &Parameter, value: &str, patience: Duration) -> Result<Measured> {
        let file = self.folder.join(number.file());
        let text = fs::read_to_string(&file)?;
        fs::write(&file, number.written_into(&text, value))?;
        let measured = self.measure(patience);
        fs::write(&file, text)?;
        measured
    }

    /// Builds the copy and measures. Returns the rows, or the reason why there are none.
    fn measure(&self, patience: Duration) -> Result<Measured> {
        let mut cargo = Command::new("cargo");
        cargo.args(["build", "--offline", "--quiet", "--package", "drawing", "--example", "sensitivity"]);
        cargo.env("CARGO_INCREMENTAL", "1").env("CARGO_TARGET_DIR", self.folder.join("target"));
        // Standard error is discarded: it would hold only warnings about comparisons that a changed parameter makes useless.
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

/// Waits for a program and ends it if it takes longer than `patience`. Returns whether the program succeeded.
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

/// Copies the files that differ. Unchanged crates need not be built again then.
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
