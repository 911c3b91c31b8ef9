//! Times of small changes in a large world: one body comes and goes among static tiles.

use super::engine::{EngineEntry, Result};
use super::play::Play;
use super::run::rounded;
use super::scene::{Action, Body, Kind, Shape};
use super::scenes::tiles;
use crate::sweep::median;
use serde::Serialize;
use std::time::Duration;

/// Number of bodies that come and go, one after the other.
const BODIES: usize = 50;

/// Figures of a kind of change: one line of the table. The time is the median CPU time in µs of the change and the step after
/// it.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[expect(missing_docs, reason = "see above")]
pub struct ChangeFigures {
    pub tiles: usize,
    pub change: &'static str,
    pub engine: &'static str,
    pub us: f64,
}

/// Adds a body to a world of static tiles and removes it, `BODIES` times; then the same with a static body.
///
/// # Errors
/// An engine refuses a body or a step.
pub fn change_figures(count: usize, engines: &[EngineEntry]) -> Result<Vec<ChangeFigures>> {
    let scene = (tiles().build)(count as f32 / 100_000.0);
    let mut figures = Vec::new();
    for &engine in engines {
        let mut play = Play::new(&scene, engine)?;
        for _ in 0..3 {
            play.step()?;
        }
        for (kind, names) in [
            (Kind::Dynamic, ["add", "step", "remove"]),
            (Kind::Static, ["add static", "step static", "remove static"]),
        ] {
            let times = coming_and_going(&mut play, kind)?;
            figures.extend(names.into_iter().zip(times).map(|(change, times)| ChangeFigures {
                tiles: count,
                change,
                engine: engine.name,
                us: rounded(1e6 * median(times).map_or(f64::NAN, |time| time.as_secs_f64())),
            }));
        }
    }
    Ok(figures)
}

/// Returns the CPU times of adding with a step, of a step alone, and of removing with a step.
fn coming_and_going(play: &mut Play<'_>, kind: Kind) -> Result<[Vec<Duration>; 3]> {
    let mut times = [const { Vec::new() }; 3];
    for index in 0..BODIES {
        let place = [index as f32 + 0.5, 1.5];
        let shapes = vec![Shape::rectangle([0.2; 2], [0.0; 2])];
        let body = match kind {
            Kind::Dynamic => Body::dynamic(place, shapes),
            _ => Body::immovable(kind, place, shapes),
        };
        let added = play.change(&Action::AddBody(body))?;
        times[0].push(added + play.step()?);
        times[1].push(play.step()?);
        let removed = play.change(&Action::RemoveBody(play.bodies.len() - 1))?;
        times[2].push(removed + play.step()?);
        play.step()?;
    }
    Ok(times)
}
