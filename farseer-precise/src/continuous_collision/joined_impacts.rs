//! Continuous collision of articulations: all bodies of an articulation stop at the first time of impact (TOI) of one of them.
//!
//! If only one body stopped, its joints would separate by the motion of the other bodies in the rest of the step: by 0.3 m
//! after a fall of 40 m. The position correction would then throw the articulation upwards.

use crate::bodies::BodySet;
use crate::continuous_collision::fast_body::FastBody;
use crate::index::BodyIndex;
use crate::joints::JointSystem;
use crate::storage::order::sort_by_number;

/// Gives all bodies of an articulation the earliest TOI of one of them. `fast_bodies` is sorted by body index, before and after.
pub(super) fn clamp_joined_bodies(joints: &JointSystem, fast_bodies: &mut Vec<FastBody>) {
    if joints.is_empty() || fast_bodies.iter().all(|flight| flight.toi >= 1.0) {
        return;
    }
    let fast_count = fast_bodies.len();
    for bodies in joints.articulation_bodies().filter(|bodies| bodies.len() > 1) {
        let position = |body: &BodyIndex| {
            fast_bodies[..fast_count].binary_search_by_key(body, |flight| flight.body).ok()
        };
        let first = bodies.iter().filter_map(position).map(|at| fast_bodies[at]).reduce(|first, flight| {
            let key = |flight: &FastBody| (flight.toi, flight.body);
            if key(&flight) < key(&first) { flight } else { first }
        });
        let Some(FastBody { toi: time, pair, hit_body: stopped, .. }) = first.filter(|first| first.toi < 1.0)
        else {
            continue;
        };
        for &body in bodies {
            let joined =
                FastBody { toi: time, pair, hit_body: stopped, is_joined: true, ..FastBody::of(body) };
            match fast_bodies[..fast_count].binary_search_by_key(&body, |flight| flight.body) {
                Ok(at) => fast_bodies[at] = joined,
                Err(_) => fast_bodies.push(joined),
            }
        }
    }
    sort_by_number(fast_bodies, |flight| flight.body.0.into());
}

/// Sets the velocity of a body that stops with its articulation: interpolated between the start and the end of the step at
/// `toi`, a fraction of the step.
///
/// Both velocities satisfy the joints, and so does every linear combination. If instead the forces after the TOI were
/// subtracted, a hanging body would get a velocity.
pub(super) fn scale_joined_velocity(bodies: &mut BodySet, body: BodyIndex, toi: f32) {
    let before = bodies.initial_velocity[body];
    for (velocity, before) in bodies.states[body].velocity.iter_mut().zip(before) {
        *velocity = before + (*velocity - before) * toi;
    }
}
