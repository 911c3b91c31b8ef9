//! Sleep and waking of pairs: contact constraints are parked with their bodies, and return with them. See
//! [`sleep`](super::sleep).

use super::sleep::SleepState;
use crate::broad_phase::pairs::Pairs;
use crate::broad_phase::proxies::{BodyType, Proxies};
use crate::constraint_graph::ConstraintGraph;
use crate::index::BodyIndex;
use crate::narrow_phase::NarrowPhase;
use crate::storage::order::sort_by_number;

/// Requests that sleeping bodies wake which an awake body has touched: those of the pairs in `touched_pairs`, which is cleared.
pub fn wake_touched(sleep: &mut SleepState, pairs: &Pairs, proxies: &Proxies) {
    let mut touched = std::mem::take(&mut sleep.touched_pairs);
    // A pair that a handler has rejected has lost its constraint.
    touched.retain(|&pair| pairs.has_constraint(pair));
    for pair in touched.drain(..) {
        sleep.request_wake_of_pair(pairs.bodies_of(proxies, pair));
    }
    sleep.touched_pairs = touched;
}

/// Requests that the sleeping bodies wake with which a body has contact constraints.
pub fn wake_partners(sleep: &mut SleepState, pairs: &Pairs, proxies: &Proxies, body: BodyIndex) {
    for pair in pairs.pairs_of_body(proxies, body).filter(|&pair| pairs.has_constraint(pair)) {
        sleep.request_wake_of_pair(pairs.bodies_of(proxies, pair));
    }
}

/// Returns whether exactly the contact constraints of sleeping bodies are parked. For debug assertions.
pub fn are_sleeping_pairs_parked(
    sleep: &SleepState,
    pairs: &Pairs,
    proxies: &Proxies,
    constraints: &ConstraintGraph,
) -> bool {
    pairs.indices().all(|pair| {
        pairs.state(pair).constraint.is_none_or(|constraint| {
            let is_asleep = constraints.sleeping_constraint(constraint).is_some();
            pairs
                .bodies_of(proxies, pair)
                .iter()
                .all(|&(body, body_type)| !body_type.takes_impulses() || sleep.is_asleep(body) == is_asleep)
        })
    })
}

/// Parks the contact constraints of pairs without an awake body that impulses can move. Pairs without a body that may move
/// leave the awake pairs.
pub fn sleep_pairs(narrow_phase: &mut NarrowPhase<'_>) {
    let h = narrow_phase.impulse_substep;
    // Backwards: a pair that moves into a free position has been handled already.
    for pair in narrow_phase.pairs.awake().rev() {
        let NarrowPhase { sleep, pairs, proxies, .. } = narrow_phase;
        let is_awake =
            |&(body, body_type): &(BodyIndex, BodyType)| body_type.takes_impulses() && !sleep.is_asleep(body);
        if pairs.bodies_of(proxies, pair).iter().any(is_awake) {
            continue;
        }
        let may_move = sleep.may_move(pairs, proxies, pair);
        narrow_phase.set_constraint_asleep(pair, true, h);
        if !may_move {
            narrow_phase.sleep_pair(pair);
        }
    }
}

/// Wakes the bodies in `wake_requests`, each with all bodies that fell asleep with it, and their pairs. Returns the indices of the
/// woken bodies.
pub fn wake_requested(narrow_phase: &mut NarrowPhase<'_>) -> Vec<BodyIndex> {
    let sleep = &mut *narrow_phase.sleep;
    let mut requests = std::mem::take(&mut sleep.wake_requests);
    let mut woken = Vec::new();
    requests.drain(..).for_each(|body| sleep.wake_ring(body, |body| woken.push(body)));
    sleep.wake_requests = requests;
    wake_pairs(narrow_phase, &woken);
    woken
}

/// Moves the pairs of woken bodies back to the awake pairs, and returns their contact constraints to the colours of the
/// constraint graph.
///
/// The pairs are taken in the order of creation numbers, because the order of constraints in the overflow colour depends on it.
fn wake_pairs(narrow_phase: &mut NarrowPhase<'_>, woken_bodies: &[BodyIndex]) {
    let h = narrow_phase.impulse_substep;
    let (all, proxies) = (&*narrow_phase.pairs, narrow_phase.proxies);
    let mut pairs = Vec::new();
    for &body in woken_bodies {
        pairs.extend(all.pairs_of_body(proxies, body));
    }
    sort_by_number(&mut pairs, |&pair| all.creation_numbers(proxies, pair));
    pairs.dedup();
    for &pair in &pairs {
        narrow_phase.set_constraint_asleep(pair, false, h);
        if !narrow_phase.pairs.has_constraint(pair) {
            narrow_phase.pairs.invalidate(pair);
        }
    }
    pairs.retain(|&pair| !narrow_phase.pairs.is_awake(pair));
    // In ascending order, so that the indices of the pairs that follow stay valid.
    pairs.sort_unstable();
    pairs.into_iter().for_each(|pair| {
        narrow_phase.wake_pair(pair);
    });
}
