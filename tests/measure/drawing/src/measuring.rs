//! What the programs that measure are started with.

use clap::{Args, ValueEnum};
use measure::method::Effort;
use std::error::Error;
use std::fs;
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
}

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

fn is_in(part: Option<&str>, name: &str) -> bool {
    part.is_none_or(|part| name.to_lowercase().contains(&part.to_lowercase()))
}
