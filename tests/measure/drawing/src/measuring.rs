//! Command-line options of the programs that measure, and the files of their tables.

use clap::{Args, ValueEnum};
use measure::method::Effort;
use measure::origin::{origin_csv, read_origin};
use measure::shard::Shard;
use std::collections::BTreeSet;
use std::error::Error;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Result with any error of the measuring programs.
pub type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// An engine of this workspace. It is measured together with its peers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Engine {
    /// `farseer-core`.
    #[value(name = "2d")]
    Plane,
    /// `twohalf`.
    #[value(name = "2.5d")]
    Depth,
}

impl Engine {
    /// Returns the name of the engine for readers.
    pub fn name(self) -> &'static str {
        match self {
            Engine::Plane => "2D",
            Engine::Depth => "2.5D",
        }
    }

    /// Returns the name of the folder for results of the engine.
    pub fn folder(self) -> &'static str {
        match self {
            Engine::Plane => "2d",
            Engine::Depth => "2.5d",
        }
    }
}

/// Options that select the measurements and the folder of their results.
#[derive(Debug, Args)]
pub struct Measuring {
    /// Few settings and sizes: minutes.
    #[arg(long)]
    quick: bool,
    /// Only one of the engines.
    #[arg(long)]
    engine: Option<Engine>,
    /// Only scenes with this in their names.
    #[arg(long, value_name = "NAME")]
    scene: Option<String>,
    /// Only methods with this in their names.
    #[arg(long, value_name = "NAME")]
    method: Option<String>,
    /// Where to write: in folders `2d` and `2.5d` of this one [default: a folder of `target`].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Only one of several shards of the sweep, such as 3/16: its tables are written and no chart is drawn.
    #[arg(long, value_name = "PART", conflicts_with = "merge")]
    shard: Option<Shard>,
    /// Run nothing: merge the tables of all shards, from these files or folders, and draw. All other options must be the same
    /// as for the shards.
    #[arg(long, value_name = "PATH", num_args = 1..)]
    merge: Vec<PathBuf>,
}

/// Origin of figures, as names and values: versions, machine, options.
pub type Origin = Vec<(&'static str, String)>;

/// Name of the table with the origin of the figures.
const ORIGIN: &str = "origin";

impl Measuring {
    /// Returns how many settings and sizes are tried.
    pub fn effort(&self) -> Effort {
        if self.quick { Effort::Quick } else { Effort::Full }
    }

    /// Returns whether the options select a scene of an engine.
    pub fn wants_scene(&self, engine: Engine, name: &str) -> bool {
        self.engine.is_none_or(|wanted| wanted == engine) && is_in(self.scene.as_deref(), name)
    }

    /// Returns whether the options select a method.
    pub fn wants_method(&self, name: &str) -> bool {
        is_in(self.method.as_deref(), name)
    }

    /// Returns the output folder `name`, below the folder of the arguments or else below `otherwise`. Makes the folder if it is
    /// missing.
    ///
    /// # Errors
    ///
    /// When the folder cannot be made.
    pub fn folder(&self, otherwise: &str, name: &str) -> Result<PathBuf> {
        let folder = self.out.as_deref().unwrap_or(Path::new(otherwise)).join(name);
        let made = fs::create_dir_all(&folder);
        made.map_err(|error| format!("cannot write to {}: {error}", folder.display()))?;
        Ok(folder)
    }

    /// Returns the shard of the sweep that the options select; without that option, the whole sweep.
    pub fn shard(&self) -> Shard {
        self.shard.unwrap_or(Shard::WHOLE)
    }

    /// Returns whether the options select only a shard of the sweep. No chart can be drawn then.
    pub fn is_part(&self) -> bool {
        self.shard() != Shard::WHOLE
    }

    /// Returns the files and folders whose tables are merged. If there are any, no trial is run.
    pub fn merge(&self) -> &[PathBuf] {
        &self.merge
    }

    /// Writes a table into a folder, and the origin of its figures into a file beside the table.
    ///
    /// # Errors
    ///
    /// When one of the files cannot be written.
    pub fn write_table(&self, folder: &Path, name: &str, table: &str, origin: &Origin) -> Result<()> {
        let file = |name: &str| match self.shard {
            Some(shard) => folder.join(format!("{name}.{shard}.csv")),
            None => folder.join(format!("{name}.csv")),
        };
        fs::write(file(name), table)?;
        fs::write(file(ORIGIN), origin_csv(origin))?;
        Ok(())
    }

    /// Returns the error message for options that select no trial. It lists the names that could be selected.
    pub fn nothing_to_run<'a>(
        &self,
        scenes: impl Iterator<Item = &'a str>,
        methods: impl Iterator<Item = &'a str>,
    ) -> String {
        format!(
            "nothing to run: no method in {:?} runs a scene in {:?}\nscenes: {}\nmethods: {}",
            self.method.as_deref().unwrap_or("all"),
            self.scene.as_deref().unwrap_or("all"),
            scenes.collect::<Vec<_>>().join("; "),
            methods.collect::<Vec<_>>().join("; ")
        )
    }
}

/// Returns the texts of all tables `name` in files and folders, and the origin of their figures.
///
/// # Errors
///
/// When there is no such table, or one cannot be read.
pub fn tables(paths: &[PathBuf], name: &str) -> Result<(Vec<String>, Origin)> {
    let mut files = Vec::new();
    for path in paths {
        find_tables(path, name, &mut files).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    if files.is_empty() {
        return Err(format!("there is no table called {name} in {paths:?}").into());
    }
    let (mut tables, mut origin) = (Vec::new(), Origin::new());
    for file in files {
        tables.push(read(&file)?);
        let beside = file.with_file_name(file_name(&file).replacen(name, ORIGIN, 1));
        origin.extend(read_origin(&read(&beside)?)?);
    }
    Ok((tables, origin))
}

/// Returns the origin of figures. Without merged tables it is `own`. Else each name of `own` gets all values that the tables
/// have for it.
pub fn merged_origin(own: Origin, tables: Option<&Origin>) -> Origin {
    let Some(tables) = tables else { return own };
    let values = |name| {
        let values = tables.iter().filter(|(known, _)| *known == name).map(|(_, value)| &**value);
        values.collect::<BTreeSet<&str>>().into_iter().collect::<Vec<_>>().join("; ")
    };
    own.into_iter().map(|(name, _)| (name, values(name))).collect()
}

/// Appends the files of the table `name` to `files`: `path` itself if it is a file, else those in this folder and its
/// subfolders.
fn find_tables(path: &Path, name: &str, files: &mut Vec<PathBuf>) -> io::Result<()> {
    if path.is_dir() {
        let mut inside =
            fs::read_dir(path)?.map(|entry| Ok(entry?.path())).collect::<io::Result<Vec<_>>>()?;
        inside.sort();
        let is_table = |path: &PathBuf| path.is_dir() || file_name(path).starts_with(&format!("{name}."));
        inside.iter().filter(|path| is_table(path)).try_for_each(|path| find_tables(path, name, files))
    } else {
        files.push(path.to_owned());
        Ok(())
    }
}

fn file_name(path: &Path) -> &str {
    path.file_name().and_then(|name| name.to_str()).unwrap_or("")
}

fn read(path: &Path) -> Result<String> {
    Ok(fs::read_to_string(path).map_err(|error| format!("cannot read {}: {error}", path.display()))?)
}

fn is_in(part: Option<&str>, name: &str) -> bool {
    part.is_none_or(|part| name.to_lowercase().contains(&part.to_lowercase()))
}
