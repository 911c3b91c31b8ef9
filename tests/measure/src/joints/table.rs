//! Figures of joint scenes, written as a table and read from it.

use super::engines::OURS;
use super::judge::{faults, part_of_faster_peer};
use crate::csv::{rows, table};
use serde::{Deserialize, Serialize};

/// Figures of a joint scene in an engine: one line of the table.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Figures {
    /// Name of the scene.
    pub scene: String,
    /// Name of the engine.
    pub engine: String,
    /// Number of bodies, static ones included.
    pub bodies: usize,
    /// Number of joints; springs do not count.
    pub joints: usize,
    /// Simulated time of the run in s.
    pub seconds: f64,
    /// Widest gap of a joint in the last second, in px.
    pub gap_px: f64,
    /// Distance of the watched body from its expected position at the end, in px; `None` if no body is watched.
    pub displacement_px: Option<f64>,
    /// Greatest speed of a point of a dynamic body in the last second, in px/s.
    pub speed_px_per_s: f64,
    /// Greatest increase of the total energy since the start, as a fraction of the greatest kinetic energy. The divisor is
    /// at least the kinetic energy of all bodies at 1 m/s. `None` if a motor or the script adds energy.
    pub energy_gained: Option<f64>,
    /// Whether all dynamic bodies sleep at the end of a run with sleep. All other figures are from runs without sleep.
    pub is_asleep: bool,
    /// CPU time of the first update, in µs.
    pub us_first_step: f64,
    /// Mean CPU time of an update in the first second, in µs.
    pub us_first_second: f64,
    /// Mean CPU time of an update after the first second, in µs.
    pub us_later: f64,
    /// CPU time of the complete run, in ms.
    pub ms_whole: f64,
    /// CPU time of our complete run divided by that of the fastest peer, dimensionless; `None` for other engines or without
    /// peers.
    pub part_of_faster_peer: Option<f64>,
    /// [Faults](super::judge::FAULTS) of our engine, separated by commas; empty for other engines.
    pub faults: String,
}

/// Rounds a value to four significant digits; further digits of a measurement are noise.
pub(super) fn four_digits(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}

/// Sets faults and relative time of our engine in `figures`, the figures of one scene. Peers that are missing there are
/// taken from `older`.
pub fn judge(figures: &mut [Figures], older: &[Figures]) {
    let Some(index) = figures.iter().position(|figures| figures.engine == OURS.name) else { return };
    let scene = &figures[index].scene;
    let is_peer = |other: &&Figures| other.scene == *scene && other.engine != OURS.name;
    let mut peers: Vec<&Figures> = figures.iter().filter(is_peer).collect();
    let is_known = |older: &&Figures| peers.iter().any(|peer| peer.engine == older.engine);
    let others: Vec<&Figures> = older.iter().filter(|older| is_peer(older) && !is_known(older)).collect();
    peers.extend(others);
    let names = faults(&figures[index], &peers);
    let part = part_of_faster_peer(&figures[index], &peers).map(four_digits);
    (figures[index].faults, figures[index].part_of_faster_peer) = (names.join(", "), part);
}

/// Returns the figures as a table with one line for every scene and engine.
pub fn figures_csv(figures: &[Figures]) -> String {
    table(figures)
}

/// Reads the figures from a table that [`figures_csv`] has written.
///
/// # Errors
///
/// A line does not hold figures; the text names the first such line.
pub fn read_figures(text: &str) -> Result<Vec<Figures>, String> {
    rows(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figures(engine: &str, gap_px: f64) -> Figures {
        Figures { scene: "chain".into(), engine: engine.into(), gap_px, ms_whole: 3.0, ..Figures::default() }
    }

    #[test]
    fn figures_that_are_written_are_read() {
        let all = [figures(OURS.name, f64::INFINITY), figures("peer", 1.2345e-7)];
        let read = read_figures(&figures_csv(&all));
        assert_eq!(read, Ok(all.to_vec()));
    }

    #[test]
    fn ours_is_judged_by_peers_of_the_same_run_before_those_of_an_older_table() {
        let mut both = [figures(OURS.name, 0.5), figures("peer", 0.4)];
        judge(&mut both, &[figures("peer", 1.0), figures("another", 1.0)]);
        assert_eq!((both[0].faults.as_str(), both[0].part_of_faster_peer), ("gap", Some(1.0)));
        let mut alone = [figures(OURS.name, 0.5)];
        judge(&mut alone, &[figures("peer", 0.6)]);
        assert_eq!(alone[0].faults, "");
    }
}
