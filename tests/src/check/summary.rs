//! Checks of complete folders, and their report.

use super::{Entry, Reproduction, check, entries};
use crate::file::read_text;
use crate::scene::{Features, Scene};
use std::collections::BTreeMap;
use std::fmt;
use std::io;
use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::mpsc::channel;

/// How many scenes came out how.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct Count {
    exact: usize,
    skipped: usize,
    failed: usize,
}

impl Count {
    fn add(&mut self, verdict: &Reproduction) {
        match verdict {
            verdict if verdict.is_exact() => self.exact += 1,
            verdict if verdict.is_skipped() => self.skipped += 1,
            _ => self.failed += 1,
        }
    }
}

impl fmt::Display for Count {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let scenes = self.exact + self.skipped + self.failed;
        let Count { exact, skipped, failed } = self;
        write!(f, "{scenes:5} scenes: {exact:5} exact, {skipped:5} skipped, {failed:5} failed")
    }
}

/// The outcome of a check of folders.
#[derive(Debug, Default)]
pub struct Summary {
    tags: BTreeMap<String, Count>,
    all: Count,
    unreadable: usize,
}

impl Summary {
    /// Whether at least one scene was checked, and none differs, failed or could not be read.
    pub fn is_success(&self) -> bool {
        self.all.failed == 0 && self.unreadable == 0 && self.all != Count::default()
    }

    /// Number of scenes that were run and are as they should be.
    pub fn exact(&self) -> usize {
        self.all.exact
    }

    /// Number of scenes that were skipped on request.
    pub fn skipped(&self) -> usize {
        self.all.skipped
    }

    /// Number of scenes that failed.
    pub fn failed(&self) -> usize {
        self.all.failed
    }

    fn add(&mut self, checked: &Checked) {
        self.all.add(&checked.verdict);
        for tag in &checked.tags {
            self.tags.entry(tag.clone()).or_default().add(&checked.verdict);
        }
    }
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (tag, count) in &self.tags {
            writeln!(f, "{tag:<20} {count}")?;
        }
        write!(f, "{:<20} {}", "all", self.all)
    }
}

/// A checked scene.
struct Checked {
    verdict: Reproduction,
    tags: Vec<String>,
}

/// Checks the scenes of folders with some threads, writing one line (or a few for differences) for each scene in the order of
/// their names. Files that are broken or missing are reported and make the check fail, but do not end it.
///
/// # Errors
///
/// When the report cannot be written.
pub fn check_folders(
    folders: &[PathBuf],
    skip: Features,
    threads: usize,
    report: &mut dyn io::Write,
) -> io::Result<Summary> {
    let mut summary = Summary::default();
    for folder in folders {
        match entries(folder) {
            Ok(list) if list.is_empty() => {
                writeln!(report, "{}: has no scenes", folder.display())?;
                summary.unreadable += 1;
            }
            Ok(list) => check_entries(list, skip, threads, &mut summary, report)?,
            Err(error) => {
                writeln!(report, "{}: {error}", folder.display())?;
                summary.unreadable += 1;
            }
        }
    }
    Ok(summary)
}

/// Checks entries with some threads and reports them in their order as soon as they are done.
fn check_entries(
    list: Vec<Entry>,
    skip: Features,
    threads: usize,
    summary: &mut Summary,
    report: &mut dyn io::Write,
) -> io::Result<()> {
    let names: Vec<String> = list.iter().map(|entry| entry.name.clone()).collect();
    let work = Mutex::new(list.into_iter().enumerate());
    let (done, results) = channel();
    std::thread::scope(|scope| {
        for _ in 0..threads.max(1) {
            let (work, done) = (&work, done.clone());
            scope.spawn(move || {
                // A panic while the lock is held is impossible but for a broken iterator, which has no more entries.
                while let Some((index, entry)) = work.lock().ok().and_then(|mut work| work.next()) {
                    if done.send((index, check_entry(&entry, skip))).is_err() {
                        return;
                    }
                }
            });
        }
        drop(done);
        let mut waiting = BTreeMap::new();
        let mut next = 0;
        for (index, checked) in results {
            waiting.insert(index, checked);
            while let Some(checked) = waiting.remove(&next) {
                writeln!(report, "{:<28} {}", names[next], checked.verdict)?;
                summary.add(&checked);
                next += 1;
            }
        }
        Ok(())
    })
}

fn check_entry(entry: &Entry, skip: Features) -> Checked {
    let failed = |reason: String, tags| Checked { verdict: Reproduction::Failed(reason), tags };
    let Some(path) = &entry.scene else {
        return failed("has a trace, but no scene".to_owned(), Vec::new());
    };
    let scene = match Scene::from_file(path) {
        Ok(scene) => scene,
        Err(error) => return failed(error.to_string(), Vec::new()),
    };
    let Some(path) = &entry.trace else {
        return failed("has a scene, but no trace".to_owned(), scene.tags);
    };
    match read_text(path) {
        Ok(text) => Checked { verdict: check(&scene, &text, skip), tags: scene.tags },
        Err(error) => failed(format!("{}: {error}", path.display()), scene.tags),
    }
}
