//! Judges joint scenes: an error is a fault if it is visible and greater than that of the better peer. A peer is an engine
//! of another project.

use super::table::Figures;

/// Greatest joint gap in px that is never a fault: smaller gaps are not visible in a game. Value chosen; its sensitivity is
/// not measured.
pub const GAP: f64 = 0.02;
/// Greatest displacement of the watched body in px that is never a fault: smaller ones are not visible in a game.
pub const DISPLACEMENT: f64 = 0.2;
/// Greatest speed at the end in px/s that is never a fault. Peers that end slower than this have come to rest.
pub const SPEED: f64 = 0.5;
/// Greatest energy gain that is never a fault, as a fraction of the greatest kinetic energy.
pub const ENERGY: f64 = 0.01;

/// Names of all faults. Gap: a joint is open. Displacement: the watched body is out of place. Speed: the scene moves where
/// all peers rest. Energy: the scene gains energy. Awake: the scene stays awake where all peers sleep.
pub const FAULTS: [&str; 5] = ["gap", "displacement", "speed", "energy", "awake"];

/// Returns the names of the faults of a scene in our engine in comparison with the peers. Without peers, rest and sleep are
/// not expected.
pub fn faults(ours: &Figures, peers: &[&Figures]) -> Vec<&'static str> {
    let least = |error: fn(&Figures) -> Option<f64>| {
        peers.iter().filter_map(|peer| error(peer)).fold(f64::INFINITY, f64::min)
    };
    let is_worse = |error: fn(&Figures) -> Option<f64>, visible: f64| {
        let bound = if peers.is_empty() { visible } else { least(error).max(visible) };
        error(ours).is_some_and(|ours| ours > bound)
    };
    let all_peers = |holds: fn(&Figures) -> bool| !peers.is_empty() && peers.iter().all(|peer| holds(peer));
    let has = [
        is_worse(|figures| Some(figures.gap_px), GAP),
        is_worse(|figures| figures.displacement_px, DISPLACEMENT),
        all_peers(|peer| peer.speed_px_per_s < SPEED)
            && is_worse(|figures| Some(figures.speed_px_per_s), SPEED),
        is_worse(|figures| figures.energy_gained, ENERGY),
        all_peers(|peer| peer.is_asleep) && !ours.is_asleep,
    ];
    FAULTS.into_iter().zip(has).filter_map(|(name, has)| has.then_some(name)).collect()
}

/// Returns the CPU time of our complete run divided by that of the fastest peer, dimensionless; `None` without peers.
pub fn part_of_faster_peer(ours: &Figures, peers: &[&Figures]) -> Option<f64> {
    let times = peers.iter().map(|peer| peer.ms_whole);
    times.reduce(f64::min).map(|fastest| ours.ms_whole / fastest)
}

#[cfg(test)]
mod tests {
    use super::*;

    const NONE: [&str; 0] = [];

    fn figures(gap_px: f64, speed_px_per_s: f64, is_asleep: bool) -> Figures {
        Figures { gap_px, speed_px_per_s, is_asleep, ms_whole: 2.0, ..Figures::default() }
    }

    #[test]
    fn an_error_that_the_better_peer_has_as_well_is_no_fault() {
        let (better, worse) = (figures(1.0, 0.0, false), figures(3.0, 0.0, false));
        let peers = [&better, &worse];
        assert_eq!(faults(&figures(1.0, 0.0, false), &peers), NONE);
        assert_eq!(faults(&figures(1.01, 0.0, false), &peers), ["gap"]);
    }

    #[test]
    fn errors_that_are_too_small_to_be_seen_are_no_faults() {
        let still = figures(0.0, 0.0, false);
        let seen = |gap, displacement, energy| Figures {
            displacement_px: Some(displacement),
            energy_gained: Some(energy),
            ..figures(gap, 0.0, false)
        };
        let peer = Figures { displacement_px: Some(0.0), energy_gained: Some(0.0), ..still };
        assert_eq!(faults(&seen(0.02, 0.2, 0.01), &[&peer]), NONE);
        assert_eq!(faults(&seen(0.021, 0.21, 0.011), &[&peer]), ["gap", "displacement", "energy"]);
        assert_eq!(faults(&seen(0.021, 0.2, 0.01), &[]), ["gap"]);
    }

    #[test]
    fn a_scene_need_not_rest_or_sleep_unless_it_does_in_both_peers() {
        let (resting, moving) = (figures(0.0, 0.1, true), figures(0.0, 2.0, false));
        let ours = figures(0.0, 5.0, false);
        assert_eq!(faults(&ours, &[&resting, &moving]), NONE);
        assert_eq!(faults(&ours, &[&resting, &resting]), ["speed", "awake"]);
        assert_eq!(faults(&ours, &[]), NONE);
    }

    #[test]
    fn the_faster_peer_is_the_measure_of_time() {
        let slower = Figures { ms_whole: 5.0, ..Figures::default() };
        let faster = Figures { ms_whole: 4.0, ..Figures::default() };
        assert_eq!(part_of_faster_peer(&figures(0.0, 0.0, true), &[&slower, &faster]), Some(0.5));
        assert_eq!(part_of_faster_peer(&faster, &[]), None);
    }
}
