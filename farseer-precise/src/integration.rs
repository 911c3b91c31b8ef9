//! Integration: forces and warm start at the beginning of a substep, positions, closed forms for free flight and for bounces,
//! and the poses at the end of the step.
//!
//! A body in the iterative solver moves by the symplectic Euler method in substeps. `apply_midpoint_correction` turns the
//! displacement into that of the midpoint rule where no impact occurred. For an isolated bounce `resolve_bounce` replaces the
//! displacement by a closed form. The broad phase then tests the new poses against the fat AABBs.

use crate::index::{BodyIndex, DenseIndex};
use crate::parameters::contacts::{CENTRAL_IMPACT_TOLERANCE, MIDPOINT_MAX_VELOCITY_CHANGE};
use std::ops::Range;

use wide::f32x4;

use super::bodies::{BodySet, MotionState, sin_cos_of_rotation};
use super::constraint_graph::{ColorUsage, ContactConstraintSimd, ContactPointSimd, SimdContacts};
use super::joints::JointSystem;
use super::scaled_parameters::StepContext;
use crate::math::decay;

/// Velocity of a body before the step, and its changes by forces in the step.
#[derive(Debug, Default)]
pub struct BodyForces {
    /// Velocity at the beginning of the step: x, y (length units/s), angular velocity (radians/s), z (length units/s).
    pub velocity: [f32; 4],
    /// Velocity change per substep by forces, gravity and drag: x, y (length units/s), angular velocity (radians/s), z (length
    /// units/s).
    pub force_delta: [f32; 4],
    /// Correction of the displacement in the step for applied forces: x, y (length units), rotation (radians), z (length
    /// units).
    pub force_position_delta: [f32; 4],
}

impl BodyForces {
    /// Returns the changes of a velocity in a step of `dt` and its substeps of `h` seconds by accelerations and drag rates
    /// (1/s, of the velocity in the plane and of the spin). The accelerations are those by applied forces and by gravity. The
    /// velocity after the step is the exact solution of `v' = a - r v` for drag rate r (1/s) and acceleration a: `v E + a (1 -
    /// E) / r` with `E = exp(-r dt)`. Quadratic drag has the rate of the beginning of the step throughout.
    ///
    /// `force_position_delta` corrects the displacement for forces that a game or a spring has applied, since they may depend on
    /// the position. Free flight moves bodies by the mean of the velocities before and after the step. Under a spring force this
    /// displacement would be too short, and the amplitude would grow. With the correction, applied forces move the body by the
    /// velocity after the step. That is the symplectic Euler method, as in the faithful set, which keeps the amplitude.
    #[inline(always)]
    pub fn of_step(
        velocity: f32x4,
        [applied, by_gravity]: [f32x4; 2],
        drag_rates: (f32, f32),
        [dt, h]: [f32; 2],
    ) -> Self {
        let acceleration = by_gravity + applied;
        let velocity_change = match drag_rates {
            // Without drag E = 1.
            (0.0, 0.0) => acceleration * f32x4::splat(dt),
            (drag, rotational_drag) => {
                let (decay, grown) =
                    decay::decay_and_integral_simd(f32x4::new([drag, drag, rotational_drag, 0.0]), dt);
                velocity * decay + acceleration * grown
            }
        };
        BodyForces {
            velocity: velocity.to_array(),
            force_delta: (velocity_change * f32x4::splat(h / dt)).to_array(),
            force_position_delta: (applied * f32x4::splat(0.5 * dt * dt)).to_array(),
        }
    }
}

/// Begins a substep: adds to the velocity of each awake body its change by forces (`force_delta`) and its warm start.
///
/// The warm start of a body is the velocity change by the sum of all accumulated impulses on the body. After each substep it
/// grows by the velocity change that the solver made in that substep, since the accumulated impulses grew accordingly.
#[inline(always)]
pub(crate) fn apply_warm_start(bodies: &mut BodySet, runs: &[Range<usize>], is_first: bool) {
    for run in runs.iter().cloned() {
        let (states, warm_starts) =
            (bodies.states.slice_mut(run.clone()), bodies.warm_start.slice_mut(run.clone()));
        let (warm_started, force_deltas) =
            (bodies.warm_started_velocity.slice_mut(run.clone()), bodies.force_delta.slice(run));
        for (((state, warm_start), warm_started_velocity), force_delta) in
            states.iter_mut().zip(warm_starts).zip(warm_started).zip(force_deltas)
        {
            let velocity = f32x4::new(state.velocity);
            if !is_first {
                *warm_start =
                    (f32x4::new(*warm_start) + (velocity - f32x4::new(*warm_started_velocity))).to_array();
            }
            *warm_started_velocity =
                (velocity + f32x4::new(*warm_start) + f32x4::new(*force_delta)).to_array();
            state.velocity = *warm_started_velocity;
        }
    }
}

/// Gives each kinematic body the velocity that the game prescribes, and the displacement velocity * dt. Impulses of the solver
/// do not change the motion of a kinematic body. `dt` is the step in seconds.
#[inline]
pub fn integrate_kinematic(bodies: &mut BodySet, dt: f32) {
    let BodySet { kinematic, states, initial_velocity, delta_pose, .. } = bodies;
    for &number in kinematic.iter() {
        states[number].velocity = initial_velocity[number];
        delta_pose[number] = initial_velocity[number].map(|velocity| velocity * dt);
    }
}

/// Integrates positions over a substep of `h` seconds: displacement = velocity * h, added to `delta_pose` of each awake body.
#[inline(always)]
pub(crate) fn integrate_positions(bodies: &mut BodySet, runs: &[Range<usize>], h: f32, is_first: bool) {
    let h = f32x4::splat(h);
    for run in runs.iter().cloned() {
        for (state, delta_pose) in
            bodies.states.slice_mut(run.clone()).iter_mut().zip(bodies.delta_pose.slice_mut(run))
        {
            let step = f32x4::new(state.velocity) * h;
            state.displacement = step.to_array();
            *delta_pose =
                if is_first { state.displacement } else { (f32x4::new(*delta_pose) + step).to_array() };
        }
    }
}

/// Integrates a whole step of all awake bodies, for bodies without contacts and joints in the iterative solver. The velocity
/// becomes v + a dt, and the displacement is dt times the mean of both velocities, plus `force_position_delta`.
#[inline(always)]
pub(crate) fn integrate_free_flight(bodies: &mut BodySet, runs: &[Range<usize>], step: &StepContext) {
    let (dt, substeps) = (f32x4::splat(step.dt), f32x4::splat(step.substeps as f32));
    let half = f32x4::splat(0.5);
    for run in runs.iter().cloned() {
        let (states, force_delta) =
            (bodies.states.slice_mut(run.clone()), bodies.force_delta.slice(run.clone()));
        let (forced, delta_poses) =
            (bodies.force_position_delta.slice(run.clone()), bodies.delta_pose.slice_mut(run));
        for (((state, delta), position_delta), delta_pose) in
            states.iter_mut().zip(force_delta).zip(forced).zip(delta_poses)
        {
            // The mean of the velocities before and after is exact under constant forces.
            let (velocity, push) = (f32x4::new(state.velocity), f32x4::new(*delta) * substeps);
            let displacement = (velocity + half * push) * dt + f32x4::new(*position_delta);
            (state.velocity, *delta_pose) = ((velocity + push).to_array(), displacement.to_array());
        }
    }
}

/// Midpoint correction: subtracts h / 2 times the velocity change in the step from the displacement in the step. The substeps
/// of h seconds moved each body by the velocity after each substep (symplectic Euler). The corrected displacement is exact
/// under constant forces.
///
/// It applies to a body if
/// - it has at most one constraint and no joint,
/// - its velocity has changed by at most [`MIDPOINT_MAX_VELOCITY_CHANGE`] times the change by forces: there was no impact,
/// - and it has no contact, or the correction is at most the speculative distance (length units), or the velocity has changed
///   by the same amount in each substep. Else, in a long step, the body may have landed, and the correction would move it
///   into the surface.
#[inline(always)]
pub(crate) fn apply_midpoint_correction(
    bodies: &mut BodySet,
    runs: &[Range<usize>],
    (color_usage, joints): (&ColorUsage, &JointSystem),
    speculative_distance: f32,
    step: &StepContext,
) {
    let (minus_half_h, substeps) = (-0.5 * step.h, step.substeps as f32);
    let max_change = MIDPOINT_MAX_VELOCITY_CHANGE * substeps;
    let max_change_squared = speculative_distance * speculative_distance / (minus_half_h * minus_half_h);
    let has_joints = joints.act_on_bodies();
    let is_jointed =
        |body: BodyIndex| has_joints && (joints.has_joint(body) || joints.has_iterative_joint(body));
    let mut correct = |body: BodyIndex| {
        let change = f32x4::new(bodies.states[body].velocity) - f32x4::new(bodies.initial_velocity[body]);
        let (size, force_delta) = (linear_size_squared(change.to_array()), bodies.force_delta[body]);
        let is_uniform = || {
            let last = f32x4::new(force_delta) + f32x4::new(bodies.warm_start[body]);
            linear_size_squared((change - last * f32x4::splat(substeps)).to_array()) <= max_change_squared
        };
        let is_free = color_usage.has_no_constraint(body);
        if size <= max_change * max_change * linear_size_squared(force_delta)
            && (is_free || size <= max_change_squared || is_uniform())
        {
            let mut delta_pose = f32x4::new(bodies.delta_pose[body]) + change * f32x4::splat(minus_half_h);
            if is_free {
                delta_pose += f32x4::new(bodies.force_position_delta[body]);
            }
            bodies.delta_pose[body] = delta_pose.to_array();
        }
    };
    for run in runs.iter().cloned() {
        for body in run.map(BodyIndex::new) {
            if color_usage.has_at_most_one_constraint(body) && !is_jointed(body) {
                correct(body);
            }
        }
    }
}

/// Returns the square of the linear part of a velocity change: x, y and z of `[x, y, angular, z]`, in length units^2/s^2.
#[inline(always)]
fn linear_size_squared([x, y, _, z]: [f32; 4]) -> f32 {
    x * x + y * y + z * z
}

/// Computes the bounce of each contact in the lanes of the mask `lanes` whose two bodies have no other contact or joint.
/// Overwrites the displacements and, after a central impact, the velocities of both bodies.
///
/// A central impact has a closed form, [`BounceArc`]. After another impact the bodies have the separation of the beginning of
/// the step: a step with restitution 1 is then its own mirror image in time. Neither method gains or loses energy over ten
/// thousand bounces.
pub(crate) fn resolve_bounce<const P: usize, R: SimdContacts<P>>(
    bodies: &mut BodySet,
    states: &mut [MotionState],
    (color_usage, joints): (&ColorUsage, &JointSystem),
    step: &StepContext,
    contacts: &R,
    lanes: u32,
) {
    let constraint = contacts.constraint();
    for lane in (0..4).filter(|lane| lanes >> lane & 1 == 1) {
        let bodies_of = [constraint.a[lane], constraint.b[lane]];
        let is_alone = |body: BodyIndex| {
            body == BodyIndex::PLACEHOLDER
                || (color_usage.has_at_most_one_constraint(body) && !joints.has_joint(body))
        };
        if bodies_of.into_iter().all(is_alone) {
            resolve_bounce_lane(bodies, states, step, contacts, lane);
        }
    }
}

/// Computes displacements and velocities of the two bodies after the bounce of the contact in `lane`, 0..=3: see
/// [`resolve_bounce`].
fn resolve_bounce_lane<const P: usize, R: SimdContacts<P>>(
    bodies: &mut BodySet,
    states: &mut [MotionState],
    step: &StepContext,
    contacts: &R,
    lane: usize,
) {
    let constraint = contacts.constraint();
    let [a, b] = [constraint.a[lane], constraint.b[lane]];
    let of = |lanes: &f32x4| lanes.as_array()[lane];
    let axis = BounceAxis::of(contacts, lane);
    let mass_a = axis.inverse_masses[0];
    let [displacement_a, displacement_b] =
        [a, b].map(|body| mean_displacement(bodies, states, body, step.dt));
    // A kinematic A may rotate: velocity of its surface at the contact, along the normal.
    let is_kinematic = !(a == BodyIndex::PLACEHOLDER || mass_a > 0.0);
    let surface_speed = if is_kinematic {
        states[a.position()].velocity[2] * of(&constraint.points[0].normal_arm_a)
    } else {
        0.0
    };
    let acceleration = |body: BodyIndex| f32x4::new(bodies.force_delta[body]) * f32x4::splat(1.0 / step.h);
    let arc = BounceArc {
        initial_separation: of(&constraint.initial_separation[0]),
        approach_velocity: of(&constraint.approach_velocity[0]),
        acceleration: axis.component(acceleration(b) - acceleration(a)),
        restitution: of(&constraint.restitution),
    };
    // Two dynamic bodies that have overlapped since an earlier step may have moved others in the meantime.
    let has_just_met = mass_a == 0.0 || arc.initial_separation >= 0.0;
    let bounced =
        if has_just_met && is_central_impact(constraint, lane) { arc.after_bounce(step.dt) } else { None };
    let separation_change = axis.component(displacement_b - displacement_a) - surface_speed * step.dt;
    let (change_a, change_b) = axis.share(bounced.map_or(0.0, |(way, _)| way) - separation_change);
    if a != BodyIndex::PLACEHOLDER {
        bodies.delta_pose[a] = (displacement_a + change_a).to_array();
    }
    bodies.delta_pose[b] = (displacement_b + change_b).to_array();
    if let Some((_, velocity)) = bounced {
        axis.set_relative_velocity(states, [a, b], |now| velocity - (now - surface_speed));
    }
}

/// Returns the displacement of a body in a step of `dt` seconds at the mean of its velocities before and after the step: x, y
/// (length units), rotation (radians), z (length units). Zeros for the placeholder.
fn mean_displacement(bodies: &BodySet, states: &[MotionState], body: BodyIndex, dt: f32) -> f32x4 {
    if body == BodyIndex::PLACEHOLDER {
        return f32x4::ZERO;
    }
    let half = f32x4::splat(0.5 * dt);
    (f32x4::new(bodies.initial_velocity[body]) + f32x4::new(states[body.position()].velocity)) * half
}

/// Normal of a bounce, and how A and B share changes along it.
struct BounceAxis {
    /// Unit normal from A to B: x, y, 0 in place of rotation, z. World axes.
    normal: f32x4,
    /// Reciprocals of the masses of A and B, 1/mass units, >= 0.
    inverse_masses: [f32; 2],
}

impl BounceAxis {
    /// Returns the axis of the contact in `lane`, 0..=3.
    fn of<const P: usize, R: SimdContacts<P>>(contacts: &R, lane: usize) -> Self {
        let constraint = contacts.constraint();
        let of = |lanes: &f32x4| lanes.as_array()[lane];
        let [x, y, z] = [of(&constraint.normal_x), of(&constraint.normal_y), of(&contacts.normal_z())];
        BounceAxis {
            normal: f32x4::new([x, y, 0.0, z]),
            inverse_masses: [of(&constraint.inverse_mass_a), of(&constraint.inverse_mass_b)],
        }
    }

    /// Changes the velocities of the bodies A and B along the normal. `change` returns the change of their relative normal velocity
    /// (length units/s) for the present one.
    fn set_relative_velocity(
        &self,
        states: &mut [MotionState],
        [a, b]: [BodyIndex; 2],
        change: impl Fn(f32) -> f32,
    ) {
        let [now_a, now_b] = [a, b].map(|body| f32x4::new(states[body.position()].velocity));
        let (change_a, change_b) = self.share(change(self.component(now_b - now_a)));
        if a != BodyIndex::PLACEHOLDER {
            states[a.position()].velocity = (now_a + change_a).to_array();
        }
        states[b.position()].velocity = (now_b + change_b).to_array();
    }

    /// Returns the component of a vector along the normal, in its unit.
    fn component(&self, change: f32x4) -> f32 {
        let [x, y, _, z] = (change * self.normal).to_array();
        x + y + z
    }

    /// Returns the changes of the positions or velocities of A and B for a change of their relative normal component.
    fn share(&self, amount: f32) -> (f32x4, f32x4) {
        let [mass_a, mass_b] = self.inverse_masses;
        let amount = self.normal * f32x4::splat(amount / (mass_a + mass_b));
        (amount * f32x4::splat(-mass_a), amount * f32x4::splat(mass_b))
    }
}

/// Returns whether the impact of the contact in `lane` is central: equal impulses at all points rotate neither body, and all
/// points have equal approach velocities.
fn is_central_impact<const P: usize>(constraint: &ContactConstraintSimd<P>, lane: usize) -> bool {
    let of = |lanes: &f32x4| lanes.as_array()[lane];
    let sum = |of_point: fn(&ContactPointSimd) -> &f32x4| {
        constraint.points.iter().map(|point| of(of_point(point))).sum::<f32>()
    };
    let (arm_a, arm_b) = (sum(|point| &point.normal_arm_a), sum(|point| &point.normal_arm_b));
    let turning =
        of(&constraint.inverse_inertia_a) * arm_a * arm_a + of(&constraint.inverse_inertia_b) * arm_b * arm_b;
    let moving = of(&constraint.inverse_mass_a) + of(&constraint.inverse_mass_b);
    let approach = of(&constraint.approach_velocity[0]);
    let is_like = |other: &f32x4| (of(other) - approach).abs() <= CENTRAL_IMPACT_TOLERANCE * approach.abs();
    turning <= CENTRAL_IMPACT_TOLERANCE * CENTRAL_IMPACT_TOLERANCE * moving
        && constraint.points.iter().all(|point| of(&point.normal_mass) > 0.0)
        && constraint.approach_velocity.iter().all(is_like)
}

/// Relative motion of two bodies along the contact normal under constant acceleration, with one impact in the step.
struct BounceArc {
    /// Separation of the two bodies at the beginning of the step, length units; negative for penetration.
    initial_separation: f32,
    /// Normal velocity of B relative to A at the beginning of the step, length units/s; negative while they approach.
    approach_velocity: f32,
    /// Normal acceleration of B relative to A by forces, length units/s^2.
    acceleration: f32,
    /// Restitution coefficient of the contact, dimensionless.
    restitution: f32,
}

impl BounceArc {
    /// Returns the change of the separation in a step of `dt` seconds (length units) and the relative normal velocity after the
    /// step (length units/s). `None` if there is no impact in the step, if the bodies meet twice, or if they have overlapped
    /// for longer than a step. Fast bodies may overlap before their contact is detected: the time of impact is then negative.
    ///
    /// Let s be the initial separation, u the approach velocity and a the acceleration. The impact is at the time t with `s + u
    /// t + a t^2 / 2 = 0`: `t = 2 s / (w - u)`. Here w is the impact speed, `w^2 = u^2 - 2 a s`.
    fn after_bounce(&self, dt: f32) -> Option<(f32, f32)> {
        let BounceArc { initial_separation, approach_velocity, acceleration, restitution } = *self;
        let squared = approach_velocity * approach_velocity - 2.0 * acceleration * initial_separation;
        if !(approach_velocity < 0.0 && squared > 0.0) {
            return None;
        }
        let speed = squared.sqrt();
        let time_of_impact = 2.0 * initial_separation / (speed - approach_velocity);
        let remaining = dt - time_of_impact;
        let exit_speed = restitution * speed;
        let end_separation = remaining * (exit_speed + 0.5 * acceleration * remaining);
        (time_of_impact >= -dt && remaining >= 0.0 && end_separation >= 0.0)
            .then_some((end_separation - initial_separation, exit_speed + acceleration * remaining))
    }
}

/// Adds the displacement of the step (`delta_pose`) to the positions in `poses`, and sets cosine and sine there from
/// `rotations`. These are already the rotations after the step.
#[inline(always)]
pub fn integrate_poses(bodies: &mut BodySet, runs: &[Range<usize>]) {
    for run in runs.iter().cloned() {
        let poses = bodies.poses.slice_mut(run.clone()).as_chunks_mut::<4>().0.iter_mut();
        let rotations = bodies.rotations.slice(run.clone()).as_chunks::<4>().0;
        let paths = bodies.delta_pose.slice(run).as_chunks::<4>().0;
        for ((poses, rotations), path) in poses.zip(rotations).zip(paths) {
            let [dx, dy, ..] = crate::math::lanes::columns(path);
            let [x, y, ..] = crate::math::lanes::columns(poses);
            let (sine, cosine) = sin_cos_of_rotation(f32x4::new(*rotations));
            *poses = f32x4::transpose([x + dx, y + dy, cosine, sine]).map(f32x4::to_array);
        }
    }
}
