//! What the programs that measure are started with.

use clap::{Args, ValueEnum};
use measure::method::Effort;
use measure::origin::{origin_csv, read_origin};
use measure::shard::Shard;
use std::collections::BTreeSet;
use std::error::Error;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// What the programs can fail with.
pub type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// An engine of this workspace, with what it is measured beside.
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
    /// As readers call it.
    pub fn name(self) -> &'static str {
        match self {
            Engine::Plane => "2D",
            Engine::Depth => "2.5D",
        }
    }

    /// The folder of what came of it.
    pub fn folder(self) -> &'static str {
        match self {
            Engine::Plane => "2d",
            Engine::Depth => "2.5d",
        }
    }
}

/// What to measure, and where to write what came of it.
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
    /// Only one of several parts of all that, such as 3/16: its tables are written and nothing is drawn.
    #[arg(long, value_name = "PART", conflicts_with = "merge")]
    shard: Option<Shard>,
    /// Run nothing: put together the tables of all parts, from these files or folders, and draw. Everything else must be
    /// as it was given to the parts.
    #[arg(long, value_name = "PATH", num_args = 1..)]
    merge: Vec<PathBuf>,
}

/// Where figures come from, as names and values.
pub type Origin = Vec<(&'static str, String)>;

/// Name of the table that tells it.
const ORIGIN: &str = "origin";

impl Measuring {
    /// How much is tried.
    pub fn effort(&self) -> Effort {
        if self.quick { Effort::Quick } else { Effort::Full }
    }

    /// Whether a scene of an engine is wanted.
    pub fn wants_scene(&self, engine: Engine, name: &str) -> bool {
        self.engine.is_none_or(|wanted| wanted == engine) && is_in(self.scene.as_deref(), name)
    }

    /// Whether a method is wanted.
    pub fn wants_method(&self, name: &str) -> bool {
        is_in(self.method.as_deref(), name)
    }

    /// The folder to write to, made if it was not there: that which was asked for, or another one.
    ///
    /// # Errors
    ///
    /// When it cannot be made.
    pub fn folder(&self, otherwise: &str, name: &str) -> Result<PathBuf> {
        let folder = self.out.as_deref().unwrap_or(Path::new(otherwise)).join(name);
        let made = fs::create_dir_all(&folder);
        made.map_err(|error| format!("cannot write to {}: {error}", folder.display()))?;
        Ok(folder)
    }

    /// The part of the sweep that is wanted.
    pub fn shard(&self) -> Shard {
        self.shard.unwrap_or(Shard::WHOLE)
    }

    /// Whether nothing is to be drawn, since it is not all there.
    pub fn is_part(&self) -> bool {
        self.shard() != Shard::WHOLE
    }

    /// The files and folders of tables that are put together; if there are any, nothing is run.
    pub fn merge(&self) -> &[PathBuf] {
        &self.merge
    }

    /// Writes a table into a folder, and beside it where it comes from.
    ///
    /// # Errors
    ///
    /// When they cannot be written.
    pub fn write_table(&self, folder: &Path, name: &str, table: &str, origin: &Origin) -> Result<()> {
        let file = |name: &str| match self.shard {
            Some(shard) => folder.join(format!("{name}.{shard}.csv")),
            None => folder.join(format!("{name}.csv")),
        };
        fs::write(file(name), table)?;
        fs::write(file(ORIGIN), origin_csv(origin))?;
        Ok(())
    }

    /// What to say when nothing is left to run, with the names there are.
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

/// The tables of a name in files and folders, and where they come from.
///
/// # Errors
///
/// When there is none, or one cannot be read.
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

/// The origin of figures: one's own, or of each of its names all values that tables have which were put together.
pub fn merged_origin(own: Origin, tables: Option<&Origin>) -> Origin {
    let Some(tables) = tables else { return own };
    let values = |name| {
        let values = tables.iter().filter(|(known, _)| *known == name).map(|(_, value)| &**value);
        values.collect::<BTreeSet<&str>>().into_iter().collect::<Vec<_>>().join("; ")
    };
    own.into_iter().map(|(name, _)| (name, values(name))).collect()
}

/// Appends the files of a table that a path is, or that are in the folder that it is, or in one within.
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
