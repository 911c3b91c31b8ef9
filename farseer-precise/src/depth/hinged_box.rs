//! World boxes on a vertical hinge: doors with a spring, a damper and angular stops.
//!
//! A hinged box has one degree of freedom, the yaw. Contact constraints see a body of infinite mass, with a finite moment of
//! inertia I about the hinge. At a distance r from the hinge its effective mass is I / r^2. Graph colouring and islands treat a
//! hinged box like a dynamic body.
//!
//! | state | method |
//! |---|---|
//! | without contacts | closed form of I x" + c x' + k x = 0, with x = yaw - rest angle |
//! | with contacts, spring force at the start of a substep | explicit |
//! | with contacts, change of the spring force and damper | implicit Euler: removes energy, never adds it |
//! | stops | rigid constraint without restitution |
//!
//! Reads hinge parameters and contact constraints; writes yaw and angular velocity of the box.

use super::hinged_box_state::HingedBoxState;
use super::interface::{self, HingeFeature, WorldBoxHinge};
use super::state::DepthState;
use crate::bodies::BodySet;
use crate::broad_phase::pairs::{Pair, Pairs};
use crate::broad_phase::proxies::Proxies;
use crate::constraint_graph::{ColorUsage, ConstraintGraph};
use crate::contact_solver::iterative_solver::IterativeSolver;
use crate::index::{BodyIndex, DenseIndex, IndexRange};
use crate::island::sleep::SleepState;
use crate::parameters::depth::{HINGE_REST_MAX_DISTANCE, HINGE_STOP_MAX_ANGLE};
use crate::scaled_parameters::StepContext;

impl WorldBoxHinge {
    /// Returns the inverse moment of inertia about the hinge, in 1/(mass units * length units^2).
    pub(super) fn inverse_inertia(&self) -> f32 {
        1.0 / self.inertia
    }

    /// Returns the yaw between the stops that is nearest to `angle`, in radians.
    pub(super) fn clamp_to_stops(&self, angle: f32) -> f32 {
        super::vertical_shapes::clamp_any(angle, self.stops[0], self.stops[1])
    }

    /// Returns the centre of the box in world coordinates x, y (down) and z, length units, at the yaw with this cosine and
    /// sine. `y` is the height of the centre.
    pub fn box_centre(&self, [cosine, sine]: [f32; 2], y: f32) -> crate::math::Vector3 {
        let ([x, z], [along, across]) = (self.pivot, self.box_offset);
        crate::math::Vector3::new(
            x + (along * cosine - across * sine),
            y,
            z + (along * sine + across * cosine),
        )
    }

    /// Returns yaw (radians) and angular velocity (rad/s) of the box after `seconds` without contacts and stops, in closed
    /// form. The first argument holds both quantities at the start.
    fn free_motion(&self, [angle, angular_velocity]: [f32; 2], seconds: f32) -> [f32; 2] {
        let [inertia, stiffness, damping, rest, t] =
            [self.inertia, self.stiffness, self.damping, self.rest_angle, seconds].map(f64::from);
        let (x, v) = (f64::from(angle) - rest, f64::from(angular_velocity));
        let (pull, slowing) = (stiffness / inertia, 0.5 * damping / inertia);
        let [cosine, sine] = damped_cos_sin(slowing, pull, t);
        let next = cosine * x + sine * (v + slowing * x);
        let velocity = cosine * v - sine * (slowing * v + pull * x);
        let next = if x == 0.0 && v == 0.0 { angle } else { (next + rest) as f32 };
        [next, velocity as f32]
    }

    /// Returns yaw (radians) and angular velocity (rad/s) of the box after `seconds` without contacts, in closed form. A box
    /// that would pass a stop is at rest at the stop.
    fn free_motion_with_stops(&self, from: [f32; 2], seconds: f32) -> [f32; 2] {
        let [angle, angular_velocity] = self.free_motion(from, seconds);
        let stopped = self.clamp_to_stops(angle);
        if stopped == angle { [angle, angular_velocity] } else { [stopped, 0.0] }
    }
}

/// Returns exp(-b t) cos(w t) and exp(-b t) sin(w t) / w with w^2 = p - b^2, which may be negative. b is `slowing`, in 1/s; p
/// is `pull`, in 1/s^2; `t` is in seconds. The first value is dimensionless, the second one is in seconds.
fn damped_cos_sin(slowing: f64, pull: f64, t: f64) -> [f64; 2] {
    let squared = pull - slowing * slowing;
    let decay = libm::exp(-slowing * t);
    let size = squared.abs().sqrt();
    if size * t < 1e-4 {
        let x = squared * t * t;
        return [decay * (1.0 - 0.5 * x), decay * t * (1.0 - x / 6.0)];
    }
    if squared > 0.0 {
        return [decay * libm::cos(size * t), decay * libm::sin(size * t) / size];
    }
    // Overdamped: the slower of both decay rates is b - sqrt(b^2 - p) = p / (b + sqrt(b^2 - p)), which avoids cancellation.
    let slow = libm::exp(-pull / (slowing + size) * t);
    let fast = libm::exp(-(slowing + size) * t);
    [0.5 * (slow + fast), 0.5 * (slow - fast) / size]
}

/// Returns `list`, or an empty list without the feature `swing`. So the compiler removes the code for hinges without the
/// feature.
fn empty_if_disabled<T>(list: &mut [T]) -> &mut [T] {
    if HingeFeature::ENABLED { list } else { &mut [] }
}

/// Start of solving: fills `hinged_boxes` with the awake hinged boxes.
pub(crate) fn list_hinged_boxes(
    space: &mut DepthState,
    bodies: &BodySet,
    sleep: &SleepState,
    step: &StepContext,
) {
    let DepthState { moving_boxes, world_boxes, hinged_boxes, .. } = space;
    hinged_boxes.clear();
    for (body_index, &box_index) in (1..).map(BodyIndex).zip(&*empty_if_disabled(moving_boxes)) {
        let world_box = &world_boxes[box_index as usize];
        let Some(&hinge) = world_box.hinge().filter(|_| !sleep.is_asleep(body_index)) else {
            continue;
        };
        let angle = world_box.yaw.unwrap_or_default();
        let initial = [angle, bodies.states[body_index].velocity[2]];
        hinged_boxes.push(HingedBoxState {
            body: body_index,
            box_index,
            hinge,
            initial,
            angle,
            constraint_impulse: hinge.constraint_torque * step.h,
            is_integrated: false,
        });
    }
}

/// Braces the hinged boxes that rest at a stop: contacts that press such a box against the stop see infinite inertia, as if it
/// were static. A touching contact that presses from the other side ends the bracing.
pub(crate) fn brace_at_stops(
    space: &mut DepthState,
    proxies: &Proxies,
    pairs: &Pairs,
    constraints: &mut ConstraintGraph,
) {
    for hinged_box in empty_if_disabled(&mut space.hinged_boxes) {
        let HingedBoxState { body, hinge, initial: [angle, angular_velocity], .. } = *hinged_box;
        let [least, greatest] = hinge.stops;
        let pull = hinge.stiffness * (hinge.rest_angle - angle);
        let rests = |distance: f32, away: f32| {
            distance < HINGE_STOP_MAX_ANGLE && away * angular_velocity <= 0.0 && away * pull <= 0.0
        };
        let at_stop = [rests(angle - least, 1.0), rests(greatest - angle, -1.0)];
        let of_box = || pairs.pairs_of_body(proxies, body).map(|pair| pairs.state(pair));
        let is_pressed = |side: usize| {
            of_box().any(|pair| pair.is_touching && drives_towards_stop(constraints, pair, side))
        };
        let braced = [0, 1].map(|side| at_stop[side] && (at_stop[1 - side] || !is_pressed(1 - side)));
        for pair in of_box() {
            let is_braced = (0..2).any(|side| braced[side] && drives_towards_stop(constraints, pair, side));
            let inverse_inertia = if is_braced { 0.0 } else { hinge.inverse_inertia() };
            set_hinge_inertia(constraints, pair, inverse_inertia);
        }
    }
}

/// Returns whether all contact points of a pair drive a hinged box towards a stop; false without a constraint. `side` selects
/// the stop: 0 is the least yaw, 1 the greatest one.
fn drives_towards_stop(constraints: &ConstraintGraph, pair: &Pair, side: usize) -> bool {
    let sign = if side == 0 { 1.0 } else { -1.0 };
    pair.constraint.is_some_and(|handle| {
        let constraint = constraints.get(pair.kind, handle);
        let mut points = constraint.points.iter().filter(|point| point.normal_mass > 0.0);
        points.all(|point| sign * point.normal_arm_a > 0.0)
    })
}

/// Sets the inverse moment of inertia that the contact constraint of a pair uses for its hinged box, in 1/(mass units * length
/// units^2), and computes the effective masses of the contact points from it.
fn set_hinge_inertia(constraints: &mut ConstraintGraph, pair: &Pair, inverse_inertia: f32) {
    let Some(handle) = pair.constraint else { return };
    let mut constraint = constraints.get(pair.kind, handle);
    if constraint.inverse_inertias[0] != inverse_inertia {
        constraint.inverse_inertias[0] = inverse_inertia;
        let row = constraint;
        for point in constraint.points.iter_mut().filter(|point| point.normal_mass > 0.0) {
            point.normal_mass = row.effective_mass(point);
        }
        constraints.set(pair.kind, handle, &constraint);
    }
}

/// End of solving: computes the motion of hinged boxes without contacts in closed form, and clamps the yaw of all others to the
/// stops. A box whose spring has not come to rest gets rest time 0, so that it stays awake. `has_overflow`: whether the
/// constraint graph has constraints in the overflow colour.
pub(crate) fn finish_hinges(
    space: &mut DepthState,
    bodies: &mut BodySet,
    sleep: &mut SleepState,
    (color_usage, has_overflow): (&ColorUsage, bool),
    length_unit: f32,
    step: &StepContext,
) {
    let DepthState { hinged_boxes, world_boxes, .. } = space;
    for HingedBoxState { body, box_index, hinge, initial, constraint_impulse, .. } in
        empty_if_disabled(hinged_boxes)
    {
        let at = *body;
        let mut torque = *constraint_impulse / step.h;
        let now = if color_usage.hinged_has_no_constraint(at) && !has_overflow {
            torque = 0.0;
            let after =
                (0..step.substeps).fold(*initial, |from, _| hinge.free_motion_with_stops(from, step.h));
            let missing = hinge.clamp_to_stops(hinge.rest_angle) - after[0];
            let reach = bodies.max_extents[at];
            if hinge.stiffness > 0.0 && missing.abs() * reach > HINGE_REST_MAX_DISTANCE * length_unit {
                sleep.rest_time[at] = 0.0;
            }
            bodies.states[at].velocity[2] = after[1];
            after[0]
        } else {
            let now = hinge.clamp_to_stops(initial[0] + bodies.delta_pose[at][2]);
            let angular_velocity = &mut bodies.states[at].velocity[2];
            if (now == hinge.stops[0] && *angular_velocity < 0.0)
                || (now == hinge.stops[1] && *angular_velocity > 0.0)
            {
                *angular_velocity = 0.0;
            }
            now
        };
        bodies.delta_pose[at][2] = now - initial[0];
        if let Some(hinged_box) =
            world_boxes[*box_index as usize].motion.as_mut().and_then(|it| it.hinge_mut())
        {
            hinged_box.constraint_torque = if torque.is_finite() { torque } else { 0.0 };
        }
    }
}

/// Sleep of hinged boxes.
impl DepthState {
    /// Returns whether the body with this index is a hinged box.
    pub fn is_hinged(&self, body_index: BodyIndex) -> bool {
        HingeFeature::ENABLED && self.hinge_of(body_index).is_some()
    }

    /// Returns the body index of the hinged box with this id; `None` if there is none.
    pub fn hinged_body(&self, id: u32) -> Option<BodyIndex> {
        let (place, world_box) = self.world_box_by_id(id)?;
        world_box.hinge()?;
        Some(BodyIndex::new(self.moving_boxes.binary_search(&(place as u32)).ok()? + 1))
    }

    /// Iterates over the body indices of the moving boxes; over none in builds without hinges.
    fn hinge_bodies(&self) -> IndexRange<BodyIndex> {
        IndexRange::new(BodyIndex(1), if HingeFeature::ENABLED { self.moving_boxes.len() } else { 0 })
    }

    /// Returns the number of sleeping hinged boxes.
    pub(crate) fn sleeping_hinged_boxes(&self, sleep: &SleepState) -> usize {
        self.hinge_bodies().filter(|&body_index| sleep.is_asleep(body_index)).count()
    }

    /// Marks hinged boxes in `color_usage`, so that no solver treats them as bodies with a single contact.
    pub(crate) fn mark_hinged_boxes(&self, color_usage: &mut ColorUsage) {
        let numbers = self.hinge_bodies().filter(|&body_index| self.hinge_of(body_index).is_some());
        numbers.for_each(|body_index| color_usage.mark_hinged(body_index));
    }

    /// Returns whether a sleeping hinged box may stay asleep: its angular velocity is 0 and the game has not edited its hinge.
    pub fn may_hinge_stay_asleep(&self, body_index: BodyIndex) -> bool {
        HingeFeature::ENABLED
            && self.hinged_box(body_index).and_then(|world_box| world_box.motion).is_some_and(|motion| {
                motion.yaw_rate == 0.0 && motion.hinge().is_some_and(|hinged_box| !hinged_box.is_edited)
            })
    }

    /// Copies the yaw rate that the game has set (rad/s) to the solver's velocity of a hinged box that wakes. Other bodies stay
    /// unchanged.
    pub fn import_hinge_velocity(&self, bodies: &mut BodySet, body_index: BodyIndex) {
        if !HingeFeature::ENABLED {
            return;
        }
        if let Some(motion) = self.hinged_box(body_index).and_then(|world_box| world_box.motion) {
            bodies.states[body_index].velocity[2] = motion.yaw_rate;
        }
    }

    /// Sets the stored yaw rate of a hinged box that fell asleep to 0. Other bodies stay unchanged.
    pub fn put_hinge_to_rest(&mut self, body_index: BodyIndex) {
        if self.is_hinged(body_index) {
            let place = self.moving_boxes[body_index.position() - 1] as usize;
            self.world_boxes[place].motion.iter_mut().for_each(|motion| motion.yaw_rate = 0.0);
        }
    }

    /// Returns the world box with this body index; `None` if the body is not a hinged box.
    fn hinged_box(&self, body_index: BodyIndex) -> Option<&interface::WorldBox> {
        let place = *self.moving_boxes.get(body_index.position().checked_sub(1)?)?;
        self.world_boxes.get(place as usize).filter(|world_box| world_box.hinge().is_some())
    }

    /// Returns the hinge of the box with this body index; `None` if the body is not a hinged box.
    fn hinge_of(&self, body_index: BodyIndex) -> Option<&WorldBoxHinge> {
        self.hinged_box(body_index)?.hinge()
    }
}

/// Hinged boxes in the substeps of the iterative solver.
impl IterativeSolver<'_> {
    /// Warm start: adds the angular velocity by the accumulated impulse of damper and stops to `BodySet::warm_start` of each
    /// awake hinged box.
    pub(crate) fn warm_start_hinges(&mut self) {
        self.for_each_hinged_box(|hinged_box, bodies| {
            bodies.warm_start[hinged_box.body][2] += hinged_box.constraint_impulse / hinged_box.hinge.inertia;
        });
    }

    /// Start of a substep: sets the yaw of each awake hinged box and stores the velocity change by its spring torque in
    /// `BodySet::force_delta`. `h` is the substep in seconds.
    #[inline(always)]
    pub(crate) fn apply_hinge_springs(&mut self, h: f32, is_first: bool) {
        self.for_each_hinged_box(|hinged_box, bodies| {
            let at = hinged_box.body;
            let turned = if is_first { 0.0 } else { bodies.delta_pose[at][2] };
            (hinged_box.angle, hinged_box.is_integrated) = (hinged_box.initial[0] + turned, false);
            let WorldBoxHinge { stiffness, inertia, rest_angle, .. } = hinged_box.hinge;
            bodies.force_delta[at][2] = h * stiffness * (rest_angle - hinged_box.angle) / inertia;
        });
    }

    /// After position integration: sets the yaw of each awake hinged box to the yaw at the start of the step plus the rotation
    /// since then.
    #[inline(always)]
    pub(crate) fn update_hinge_angles(&mut self) {
        self.for_each_hinged_box(|hinged_box, bodies| {
            hinged_box.angle = hinged_box.initial[0] + bodies.delta_pose[hinged_box.body][2];
            hinged_box.is_integrated = true;
        });
    }

    /// Solves the damper, the implicit part of the spring and the stops of all awake hinged boxes. `h` is the substep in
    /// seconds.
    #[inline(always)]
    pub(crate) fn solve_hinge_stops(&mut self, h: f32) {
        self.for_each_hinged_box(|hinged_box, bodies| {
            hinged_box.solve_damping_and_stops(&mut bodies.states[hinged_box.body].velocity[2], h);
        });
    }

    /// Calls `act` for each awake hinged box.
    #[inline(always)]
    fn for_each_hinged_box(&mut self, mut act: impl FnMut(&mut HingedBoxState, &mut BodySet)) {
        let IterativeSolver { depth: Some(space), bodies, .. } = self else { return };
        for hinged_box in empty_if_disabled(&mut space.hinged_boxes) {
            act(hinged_box, bodies);
        }
    }
}

#[cfg(all(test, feature = "swing"))]
mod tests {
    use super::{HingeFeature, WorldBoxHinge};

    fn hinge(stiffness: f32, damping: f32) -> WorldBoxHinge {
        WorldBoxHinge {
            pivot: [0.0; 2],
            box_offset: [30.0, 0.0],
            inertia: 2.0,
            stiffness,
            damping,
            rest_angle: 0.5,
            stops: [-2.0, 2.0],
            constraint_torque: 0.0,
            is_edited: false,
            proof: HingeFeature,
        }
    }

    /// Integrates the equation of motion with 20,000 steps of the classical Runge-Kutta method.
    fn runge_kutta(hinge: &WorldBoxHinge, from: [f32; 2], seconds: f64) -> [f64; 2] {
        let [inertia, k, c, rest] =
            [hinge.inertia, hinge.stiffness, hinge.damping, hinge.rest_angle].map(f64::from);
        let slope = |[x, v]: [f64; 2]| [v, -(k * (x - rest) + c * v) / inertia];
        let (count, mut now) = (20_000, from.map(f64::from));
        let h = seconds / f64::from(count);
        let on = |[x, v]: [f64; 2], [dx, dv]: [f64; 2], t: f64| [x + t * dx, v + t * dv];
        for _ in 0..count {
            let a = slope(now);
            let b = slope(on(now, a, 0.5 * h));
            let c = slope(on(now, b, 0.5 * h));
            let d = slope(on(now, c, h));
            now = on(now, std::array::from_fn(|i| (a[i] + 2.0 * (b[i] + c[i]) + d[i]) / 6.0), h);
        }
        now
    }

    #[test]
    fn free_motion_matches_runge_kutta_for_all_damping_ratios() {
        // No spring, no damper, undamped, underdamped, critically damped, slightly and strongly overdamped.
        for (k, c) in [(0.0, 0.0), (0.0, 3.0), (8.0, 0.0), (8.0, 1.0), (8.0, 8.0), (8.0, 8.001), (8.0, 300.0)]
        {
            let hinged_box = hinge(k, c);
            for seconds in [0.001, 0.1, 1.5] {
                let found = hinged_box.free_motion([-0.4, 1.5], seconds).map(f64::from);
                let law = runge_kutta(&hinged_box, [-0.4, 1.5], f64::from(seconds));
                for (found, law) in found.into_iter().zip(law) {
                    // Both have seven significant digits.
                    assert!(
                        (found - law).abs() < 4e-7,
                        "{found}, not {law}, with {k} and {c} after {seconds} s"
                    );
                }
            }
        }
    }

    #[test]
    fn hinge_at_rest_keeps_its_yaw_bit_for_bit() {
        assert_eq!(hinge(8.0, 1.0).free_motion([0.5, 0.0], 0.1), [0.5, 0.0]);
    }
}
