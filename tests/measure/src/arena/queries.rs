//! Times of queries in large worlds: closest hits of rays, and shapes in boxes.

use super::engine::{EngineEntry, Result};
use super::play::Play;
use super::run::rounded;
use super::scene::{Point, Scene};
use super::scenes::{tiles, worlds};
use crate::method::unit;
use crate::stopwatch::Stopwatch;
use serde::Serialize;

/// Number of steps before the queries: the pile is then a heap, and the stacks sleep.
const STEPS: usize = 120;
/// Number of turns; each time is the least over all turns.
const TURNS: usize = 3;
/// Kinds of queries: lengths of rays, and sides of boxes, in m.
const KINDS: [(&str, f32); 4] = [("ray", 5.0), ("ray", 100.0), ("box", 1.0), ("box", 10.0)];

/// Figures of one kind of query in a world: one line of the table. The time is the CPU time in µs of a query; hits are the mean
/// number of rays that hit, or of shapes in a box.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[expect(missing_docs, reason = "see above; lengths in m")]
pub struct QueryFigures {
    pub world: &'static str,
    pub bodies: usize,
    pub query: &'static str,
    pub length: f32,
    pub engine: &'static str,
    pub us: f64,
    pub hits: f64,
}

/// Times `count` queries of each kind in piles, stacks and tiles of `bodies` bodies, in each engine by turns.
///
/// # Errors
/// An engine refuses a body, a step or a query.
pub fn query_figures(bodies: usize, count: usize, engines: &[EngineEntry]) -> Result<Vec<QueryFigures>> {
    let size = bodies as f32 / 100_000.0;
    let mut figures = Vec::new();
    for entry in worlds().into_iter().chain([tiles()]) {
        let scene = (entry.build)(size);
        let mut plays =
            engines.iter().map(|&engine| Play::new(&scene, engine)).collect::<Result<Vec<_>>>()?;
        for play in &mut plays {
            (0..STEPS).try_for_each(|_| play.step().map(|_| ()))?;
        }
        for (query, length) in KINDS {
            let areas = areas(&scene, query, length, count);
            let mut least = vec![(f64::INFINITY, 0.0); plays.len()];
            for _ in 0..TURNS {
                for (play, least) in plays.iter_mut().zip(&mut least) {
                    let (time, hits) = ask(play, query, &areas)?;
                    *least = (least.0.min(time), hits);
                }
            }
            figures.extend(engines.iter().zip(least).map(|(engine, (time, hits))| QueryFigures {
                world: entry.name,
                bodies,
                query,
                length,
                engine: engine.name,
                us: rounded(1e6 * time / count as f64),
                hits: rounded(hits / count as f64),
            }));
        }
    }
    Ok(figures)
}

/// Returns the ends of rays, or the lowest and highest corners of boxes, in m: spread over the lower half of the initial extent
/// of a scene, in which the bodies of all worlds lie.
fn areas(scene: &Scene, query: &str, length: f32, count: usize) -> Vec<[Point; 2]> {
    let (mut low, mut high) = ([f32::MAX; 2], [f32::MIN; 2]);
    let static_alone = scene.bodies.iter().all(|body| body.mass == 0.0);
    for body in scene.bodies.iter().filter(|body| static_alone || body.mass > 0.0) {
        for axis in 0..2 {
            low[axis] = low[axis].min(body.position[axis]);
            high[axis] = high[axis].max(body.position[axis]);
        }
    }
    high[1] = 0.5 * (low[1] + high[1]);
    let at = |number: usize| {
        let share = |axis: usize| unit(2 * number as u64 + axis as u64);
        [0, 1].map(|axis| low[axis] + share(axis) * (high[axis] - low[axis]))
    };
    let area = |index: usize| {
        let ([x, y], [tx, ty]) = (at(2 * index), at(2 * index + 1));
        if query == "box" {
            let half = 0.5 * length;
            return [[x - half, y - half], [x + half, y + half]];
        }
        let scale = length / (tx - x).hypot(ty - y).max(1e-3);
        [[x, y], [x + (tx - x) * scale, y + (ty - y) * scale]]
    };
    (0..count).map(area).collect()
}

/// Returns the CPU time of all queries in s, and the number of hits.
fn ask(play: &mut Play<'_>, query: &str, areas: &[[Point; 2]]) -> Result<(f64, f64)> {
    let watch = Stopwatch::start();
    let mut hits = 0;
    for &[from, to] in areas {
        hits += match query {
            "ray" => usize::from(play.engine.cast_ray(from, to)?.is_some()),
            _ => play.engine.count_in_box(from, to)?,
        };
    }
    Ok((watch.elapsed().as_secs_f64(), hits as f64))
}
