//! Continuous collision: fast bodies stop at their time of impact (TOI).
//!
//! The solver moves bodies along straight paths through the step. A dynamic body whose displacement exceeds its smallest extent
//! (least distance from its middle to its surface) could end behind a wall without a contact. Its path ends at the first TOI
//! with a geom that stops it. That is a geom of a static, kinematic or sleeping body, or of any body if one of the two is a
//! bullet. The body keeps the velocity of that time, and the next step finds the contact.
//!
//! The TOI is that of the relative motion, by [conservative advancement](time_of_impact). Between the TOI and the end of the
//! step the body moves with the body that it hit, as if fixed to it. Otherwise a descending lift would separate from the body
//! after every impact, and the body would never land.
//!
//! The broad phase is queried along the path only for geoms that can stop the body, and pairs are made only for actual impacts.
//! The cost does not depend on the number of other bodies along the path (E. Catto, Box2D 3, `solver.c`: continuous collision
//! queries the static tree and keeps no pairs).

pub mod fast_body;
pub mod joined_impacts;
pub mod swept_motion;
pub mod time_of_impact;

use super::bodies::BodySet;
use super::island::sleep::SleepState;
use super::joints::JointSystem;
use crate::broad_phase::proxies::BodyType;
use crate::index::{BodyIndex, DenseIndex, PairIndex, ProxyIndex};
use crate::math::lanes::{columns, smaller};
use crate::parameters::narrow_phase::{CCD_MAX_COORDINATE, TOI_PENETRATION_RATIO};
use crate::storage::order::{packed_key, sort_by_number};
use fast_body::FastBody;
use joined_impacts::{clamp_joined_bodies, scale_joined_velocity};
use swept_motion::SweptMotion;
use wide::f32x4;

/// Returns a mask of those among four bodies that move in the step by more than `min_extents` (least distances from their middles
/// to their surfaces), and by less than [`CCD_MAX_COORDINATE`]. Bit i is for the body i.
///
/// The rows are the displacements of the bodies: x, y (length units), rotation (radians), z (length units). `max_extents` are the
/// largest distances of their surfaces from their origins. All extents are in length units.
#[inline(always)]
fn fast_lanes(displacements: &[[f32; 4]; 4], max_extents: f32x4, min_extents: f32x4) -> u32 {
    let [x, y, turned, z] = columns(displacements).map(f32x4::abs);
    let distance = x + y + z + max_extents * turned;
    (distance.simd_gt(min_extents) & distance.simd_lt(f32x4::splat(CCD_MAX_COORDINATE))).to_bitmask()
}

/// Lists the fast bodies of the step in `fast`: dynamic, awake, and moving by more than the least distance from their middle to
/// their surface, or by more than `max_threshold` (length units).
pub(crate) fn list_fast_bodies(
    bodies: &BodySet,
    sleep: &SleepState,
    max_threshold: f32,
    fast: &mut Vec<FastBody>,
) {
    fast.clear();
    for run in &sleep.awake_body_runs {
        let (paths, _) = bodies.delta_pose.slice(run.clone()).as_chunks::<4>();
        let [reaches, cores] =
            [&bodies.max_extents, &bodies.min_extents].map(|of| of.slice(run.clone()).as_chunks::<4>().0);
        for (block, ((paths, reaches), cores)) in paths.iter().zip(reaches).zip(cores).enumerate() {
            let cores = smaller(f32x4::new(*cores), f32x4::splat(max_threshold));
            let lanes = fast_lanes(paths, f32x4::new(*reaches), cores);
            if lanes == 0 {
                continue;
            }
            for lane in (0..4).filter(|lane| lanes >> lane & 1 == 1) {
                let number = BodyIndex::new(run.start + 4 * block + lane);
                if !sleep.is_asleep(number) && bodies.has_body[number] && !bodies.is_kinematic(number) {
                    fast.push(FastBody::of(number));
                }
            }
        }
    }
}

/// Finds the times of impact of the fast bodies, and their displacements from then to the end of the step. Lists the sensors
/// that they cross before in `passthroughs`.
pub(crate) fn find_impacts(
    motion: SweptMotion<'_>,
    joints: &JointSystem,
    fast: &mut Vec<FastBody>,
    passthroughs: &mut Vec<[ProxyIndex; 2]>,
) {
    find_first_impacts(motion, fast);
    if motion.depth.is_none() {
        clamp_joined_bodies(joints, fast);
        record_sensor_passthroughs(motion, fast, passthroughs);
    }
    find_carried_motion(motion, fast);
}

/// Returns the first time of impact with a static body on the path of a carried body, one that moves on with the body that it
/// hit, as a fraction of the step. `None` without an impact.
pub(crate) fn toi_of_carried(motion: SweptMotion<'_>, flight: &FastBody) -> Option<f32> {
    let is_static = |pair_index: PairIndex| {
        let [(_, body_type), _] = motion.pairs.bodies_of(motion.proxies, pair_index);
        body_type == BodyType::Fixed && flight.pair != Some(pair_index)
    };
    motion.first_toi(flight.body, is_static).map(|(time, _)| time)
}

/// Finds the first time of impact of each fast body, and its pair.
fn find_first_impacts(motion: SweptMotion<'_>, fast: &mut [FastBody]) {
    if motion.depth.is_none() && !motion.has_obstacles() {
        return;
    }
    for flight in fast {
        let first = motion.first_toi(flight.body, |_| true);
        (flight.toi, flight.pair) = first.map_or((1.0, None), |(time, pair)| (time, Some(pair)));
    }
}

/// Finds the displacement of each fast body from its impact to the end of the step.
fn find_carried_motion(motion: SweptMotion<'_>, fast: &mut [FastBody]) {
    for at in 0..fast.len() {
        fast[at].carried_motion = motion.carried_motion(fast, &fast[at]);
    }
}

/// Ends the displacements of the fast bodies at their times of impact, and sets their velocities to those of that time. Forces
/// act until the impact only. `substeps`: number of substeps of the step. The carried bodies remain in `fast`: those that move
/// on with the body that they hit.
pub(crate) fn end_paths(bodies: &mut BodySet, fast: &mut Vec<FastBody>, substeps: f32) {
    fast.retain(|flight| flight.toi < 1.0);
    for &FastBody { body, toi: time, carried_motion: carried, is_joined, .. } in &*fast {
        for (component, carried) in bodies.delta_pose[body].iter_mut().zip(carried) {
            *component = *component * time + carried;
        }
        if is_joined {
            scale_joined_velocity(bodies, body, time);
            continue;
        }
        let unused_substeps = (1.0 - time) * substeps;
        for (velocity, push) in bodies.states[body].velocity.iter_mut().zip(bodies.force_delta[body]) {
            *velocity -= unused_substeps * push;
        }
    }
    fast.retain(|flight| flight.carried_motion != [0.0; 4]);
}

/// Appends to `passthroughs` the pairs of proxies of which a fast body enters and leaves a sensor within the step, the proxy
/// with the smaller creation number first. The game gets a collision and a separation event for each pair of geoms.
fn record_sensor_passthroughs(
    motion: SweptMotion<'_>,
    fast: &[FastBody],
    passthroughs: &mut Vec<[ProxyIndex; 2]>,
) {
    let SweptMotion { proxies, pairs, .. } = motion;
    if !pairs.has_sensors() {
        return;
    }
    let number = |proxy: ProxyIndex| proxies.proxy(proxy).creation_number;
    for &FastBody { body, toi: time, .. } in fast {
        for pair in proxies.proxies_of(body).flat_map(|proxy| pairs.pairs_of(proxy)) {
            let state = pairs.state(pair);
            if state.responds || state.is_touching || state.is_vetoed {
                continue;
            }
            let two = pairs.proxies_of(pair);
            let impact_time = motion.time_of_impact(two, TOI_PENETRATION_RATIO);
            if impact_time.is_some_and(|met| met < time) && motion.is_separated_after(pair, body, time) {
                let [a, b] = two;
                passthroughs.push(if number(a) < number(b) { [a, b] } else { [b, a] });
            }
        }
    }
    sort_by_number(passthroughs, |two| packed_key(two.map(number)));
    // The pieces of two geoms have the same numbers.
    passthroughs.dedup_by_key(|two| two.map(number));
}
