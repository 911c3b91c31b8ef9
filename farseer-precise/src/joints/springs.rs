//! Springs as rows of the solvers.
//!
//! A spring at a body with joints or contacts is a row with stiffness k and damping c, integrated with implicit Euler. With
//! stretch x at the start of the step and its rate u at the end, the impulse is
//!
//! ```text
//! l = -dt (k (x + dt u) + c u) = -s (u + dt k x / s),   s = dt (c + dt k)
//! ```
//!
//! (D. Baraff and A. Witkin, "Large steps in cloth simulation", 1998). An explicit force would accelerate a light body too much
//! if other rows hold it, since these rows change its effective mass. A spring whose bodies have neither joints nor contacts
//! stays an explicit force: implicit Euler would damp its oscillation.
//!
//! The adapter makes this choice for each spring when it acts. A spring that the
//! direct solver does not solve in this step is solved by the [iterative solver](super::soft_spring).
//!
//! | spring | rows of the direct solver |
//! |---|---|
//! | linear, fixed linear | along the line between its anchors; across it for geometric stiffness beyond the stable limit |
//! | angle | the angle; its damping acts on the angular velocity of each body and adds to their inertia |
//! | fixed angle | the angle |
//! | servo of a joint | the angle, or along the axis; its damping acts on the relative velocity |
//!
//! **Servos** of joints are springs whose rest position is the target. The numerical damping of implicit Euler, dt k to first
//! order, is a part of their damping c: the row has the slope dt max(c, dt k) instead of dt (c + dt k). A servo with a damping
//! ratio above half its angular frequency times dt is damped as asked. Below that, the numerical damping remains.

use super::super::bodies::BodySet;
use super::super::direct_solver::constraint::{BodyIndices, FIXED};
use super::super::direct_solver::joint::{ACROSS, ALONG, ANGLE, JointRows, SpringDamper};
use super::frame::JointFrame;
use super::indices::{CandidateIndex, JointIndex, SpringIndex};
use super::joint_constraint::{JointAnchor, JointCandidate, JointConstraint};
use super::locked_dofs::LockedDofs;
use super::vec2::{Vec2, add_scaled, dot};
use crate::index::{BodyIndex, IndexedVec};
use crate::parameters::joints::DRY_FRICTION_RATE;
use crate::reusing_clone;

/// Springs that solvers treat as rows in this update, instead of explicit forces.
#[derive(Debug, Default)]
pub struct SpringRows {
    /// Springs that are rows and act on a dynamic body, with poses and coefficients in this step.
    constraints: IndexedVec<SpringIndex, SpringConstraint>,
    /// For each body index whether a spring of `constraints` acts on the body. Unused between steps.
    is_body_attached: IndexedVec<BodyIndex, bool>,
}

reusing_clone! { SpringRows { constraints, is_body_attached } }

/// A spring with its pose and coefficients in one step.
#[derive(Debug, Clone, Copy)]
pub struct SpringConstraint {
    /// Anchors on the bodies A and B, or on the world.
    pub ends: [JointAnchor; 2],
    /// Whether the row is along the line between the anchors; else it is angular, or along `axis`.
    pub is_linear: bool,
    /// Direction of the row in world coordinates, a unit vector, for a spring along an axis that turns with the first body.
    /// `None` for all other springs.
    pub axis: Option<Vec2>,
    /// The joint whose servo the spring is; `None` for a spring of the game.
    pub joint: Option<JointIndex>,
    /// Stiffness k, >= 0: mass units/s^2 in linear springs, mass units * length units^2/s^2 per radian in angle springs.
    pub stiffness: f64,
    /// Damping c, >= 0: mass units/s in linear springs, mass units * length units^2/s in angle springs.
    pub damping: f64,
    /// Torque on each body per angular velocity of that body, mass units * length units^2/s, >= 0. It damps angle springs
    /// between two bodies, whose `damping` is 0.
    pub spin_damping: f64,
    /// Stretch at the start of the step: length units in linear springs, radians in angle springs.
    pub stretch: f64,
    /// Largest torque, mass units * length units^2/s^2, > 0; infinite for linear springs. Along `axis` the largest force, mass
    /// units * length units/s^2.
    pub max_torque: f64,
    /// Accelerations that the explicit force of the spring would give to A and B: x and y in length units/s^2, angular in
    /// radians/s^2.
    pub accelerations: [[f32; 3]; 2],
    /// Whether the direct solver has solved the spring in this step.
    pub is_solved: bool,
}

impl SpringRows {
    /// Returns whether no spring is a row in this step.
    pub fn is_empty(&self) -> bool {
        self.constraints.is_empty()
    }

    /// Returns the number of springs that are rows in this step.
    pub fn count(&self) -> usize {
        self.constraints.len()
    }

    /// Removes all springs from the list of this step.
    pub fn clear(&mut self) {
        self.constraints.clear();
    }

    /// Adds a spring to the list of this step.
    pub fn push(&mut self, spring: SpringConstraint) {
        self.constraints.push(spring);
    }

    /// Begins a step of `dt` seconds with the springs of the list: finds the bodies on which they act.
    ///
    /// Adds half the acceleration by each explicit force times dt^2 to `force_position_delta` of its bodies. With this term the
    /// force moves bodies by the symplectic Euler method, as in the faithful set.
    pub fn begin_step(&mut self, bodies: &mut BodySet, dt: f32) {
        let SpringRows { constraints, is_body_attached } = self;
        if constraints.is_empty() && is_body_attached.is_empty() {
            return;
        }
        is_body_attached.clear();
        is_body_attached.resize(if constraints.is_empty() { 0 } else { bodies.states.len() }, false);
        for spring in constraints.iter() {
            for (end, accelerations) in spring.ends.iter().zip(spring.accelerations) {
                if end.body != BodyIndex::PLACEHOLDER {
                    is_body_attached[end.body] = true;
                    let position_delta = &mut bodies.force_position_delta[end.body];
                    (0..3).for_each(|axis| position_delta[axis] += accelerations[axis] * (0.5 * dt * dt));
                }
            }
        }
    }

    /// Returns the springs of this step as candidates for islands of the direct solver.
    pub(crate) fn candidates(&self) -> impl Iterator<Item = JointCandidate> + '_ {
        self.constraints.enumerated().map(|(at, spring)| JointCandidate {
            index: CandidateIndex::Spring(at),
            bodies: spring.ends.map(|end| end.body),
            is_free_articulation: false,
            has_rows: true,
            error: 0.0,
        })
    }

    /// Returns the spring at `index` of the list of this step.
    pub(crate) fn constraint(&self, index: SpringIndex) -> &SpringConstraint {
        &self.constraints[index]
    }

    /// Marks the spring at `index` as solved by the direct solver, so that the iterative solver leaves it out. Returns the joint
    /// whose servo the spring is, if any.
    pub(crate) fn mark_solved(&mut self, index: SpringIndex) -> Option<JointIndex> {
        let spring = &mut self.constraints[index];
        spring.is_solved = true;
        spring.joint
    }

    /// Returns the springs that the direct solver has not solved.
    pub(super) fn unsolved(&self) -> impl Iterator<Item = &SpringConstraint> + '_ {
        self.constraints.iter().filter(|spring| !spring.is_solved)
    }

    /// Returns whether the direct solver has solved all springs of this step.
    pub(crate) fn are_all_solved(&self) -> bool {
        self.unsolved().next().is_none()
    }

    /// Returns whether a spring of this step acts on the body with the index `body`.
    pub fn is_attached_to(&self, body: BodyIndex) -> bool {
        self.is_body_attached.at(body) == Some(&true)
    }
}

impl SpringConstraint {
    /// Returns the rows of the spring in a step of `dt` seconds, for the direct solver.
    ///
    /// `lever` converts angular errors to linear ones where errors are compared, length units per radian.
    pub(crate) fn constraint_rows(&self, body_indices: BodyIndices, dt: f64, lever: f64) -> JointRows {
        let (frame, row) = (self.frame(), self.row());
        let prescribed = [0, 1]
            .map(|side| if body_indices.bodies[side] == FIXED { self.ends[side].velocity } else { [0.0; 3] });
        let mut rows = JointRows::new(body_indices, frame.jacobian(), [0.0; 3], prescribed, lever);
        let SpringConstraint { stiffness, stretch, .. } = *self;
        let damping = self.row_damping(dt);
        rows.add_spring_row(row, SpringDamper { stiffness, damping, stretch }, [dt, self.max_torque * dt]);
        if self.is_linear {
            let distance = frame.distance();
            let tension = if distance > 0.0 { stretch / distance } else { 1.0 };
            rows.add_transverse_stiffness(dt * dt * stiffness * tension);
        }
        rows
    }

    /// Returns the relative pose of the spring's bodies. For an angle spring, the angle of the pose is the spring's stretch in
    /// radians.
    pub(super) fn frame(&self) -> JointFrame {
        if let Some(axis) = self.axis {
            return JointFrame { axis, ..JointFrame::between(LockedDofs::Line, &self.ends, 0.0) };
        }
        let link = if self.is_linear { LockedDofs::Distance } else { LockedDofs::Angle };
        JointFrame::between(link, &self.ends, self.stretch)
    }

    /// Returns the row of the spring: ALONG the line between its anchors, ACROSS for a row along `axis`, or ANGLE.
    pub(super) fn row(&self) -> usize {
        match (self.axis, self.is_linear) {
            (Some(_), _) => ACROSS,
            (None, true) => ALONG,
            (None, false) => ANGLE,
        }
    }

    /// Returns the damping of the row in a step or substep of `dt` seconds, in the unit of `damping`. That of a servo is less by
    /// the numerical damping of implicit Euler.
    pub(super) fn row_damping(&self, dt: f64) -> f64 {
        let numerical = if self.joint.is_some() { dt * self.stiffness } else { 0.0 };
        if self.damping > numerical { self.damping - numerical } else { 0.0 }
    }

    /// Returns the anchors of the spring on the bodies A and B, or on the world.
    pub(super) fn ends(&self) -> &[JointAnchor; 2] {
        &self.ends
    }

    /// Returns the torque on each body per angular velocity of that body, mass units * length units^2/s; 0 for linear springs.
    pub(crate) fn spin_damping(&self) -> f64 {
        self.spin_damping
    }
}

impl SpringConstraint {
    /// Moves `damping` of an angle spring to `spin_damping`, which acts on the angular velocities of its bodies. A spring at
    /// its torque limit has no damping.
    ///
    /// An angle spring damps the angular velocity of each body, not the relative one. `angular_velocity` returns that of an
    /// anchor's body in radians/s.
    pub fn set_spin_damping(&mut self, angular_velocity: impl Fn(&JointAnchor) -> f32) {
        let damping = std::mem::take(&mut self.damping);
        let is_bounded = |end: &JointAnchor, sign: f64| {
            end.body != BodyIndex::PLACEHOLDER
                && (sign * self.stiffness * self.stretch - damping * f64::from(angular_velocity(end))).abs()
                    >= self.max_torque
        };
        if !(is_bounded(&self.ends[0], 1.0) || is_bounded(&self.ends[1], -1.0)) {
            self.spin_damping = damping;
        }
    }
}

/// Target, strength and bound of a joint's servo.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Servo {
    /// Position that the servo seeks: length units along an axis, radians about a point.
    pub target: f64,
    /// Stiffness, >= 0: mass units/s^2 along an axis, mass units * length units^2/s^2 per radian about a point.
    pub stiffness: f64,
    /// Damping, >= 0: mass units/s along an axis, mass units * length units^2/s about a point.
    pub damping: f64,
    /// Greatest force (mass units * length units/s^2) or torque (mass units * length units^2/s^2), > 0.
    pub greatest_effort: f64,
}

impl SpringConstraint {
    /// Returns the `servo` of the joint with the index `at`, as a spring at the present pose of the joint's `constraint`.
    /// `reference` is the relative angle that counts as position 0, in radians.
    pub fn of_servo(at: JointIndex, constraint: &JointConstraint, servo: Servo, reference: f64) -> Self {
        let is_along_axis = constraint.locked.servo_row() == ACROSS;
        let position = if is_along_axis {
            JointFrame::of(constraint).axis_offset()
        } else {
            constraint.angle - reference
        };
        SpringConstraint {
            ends: constraint.anchors,
            is_linear: false,
            axis: is_along_axis.then_some(constraint.axis),
            joint: Some(at),
            stiffness: servo.stiffness,
            damping: servo.damping,
            spin_damping: 0.0,
            stretch: position - servo.target,
            max_torque: servo.greatest_effort,
            accelerations: [[0.0; 3]; 2],
            is_solved: false,
        }
    }
}

/// Strength and bounds of a joint that moves its second body to a pose relative to the first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoseServo {
    /// Angle of the second body minus that of the first that the joint seeks, in radians.
    pub target_angle: f64,
    /// Angular frequency of the free oscillation about the pose, radians/s, >= 0. Without it the joint is dry friction.
    pub angular_frequency: f64,
    /// Damping ratio, dimensionless, >= 0; 1 is critical damping.
    pub damping_ratio: f64,
    /// Greatest force, mass units * length units/s^2, >= 0.
    pub greatest_force: f64,
    /// Greatest torque, mass units * length units^2/s^2, >= 0.
    pub greatest_torque: f64,
}

impl PoseServo {
    /// Returns stiffness and damping of a row with the inverse effective mass `inverse`; 0 if neither body can move along the
    /// row. Without a frequency, but with a damping ratio, the row is dry friction: it stops relative motion as far as its bound
    /// allows.
    fn coefficients(&self, inverse: f64) -> [f64; 2] {
        let mass = if inverse > 0.0 { inverse.recip() } else { 0.0 };
        let w = self.angular_frequency;
        if w == 0.0 && self.damping_ratio > 0.0 {
            return [0.0, mass * DRY_FRICTION_RATE];
        }
        [mass * w * w, 2.0 * self.damping_ratio * mass * w]
    }

    /// Adds the servo of the joint with the index `at` to `springs`, as springs at the present pose of the joint's
    /// `constraint`: two along perpendicular directions between the anchors, and one of the angle.
    ///
    /// The first direction is that of the force without a bound. The bounds of both directions leave the length of the force
    /// below its bound, and all of it to the first direction where the bound is reached. Dry friction opposes the motion that the
    /// forces of the step would cause; the forces act in `substeps` parts.
    pub fn add_springs(
        &self,
        springs: &mut SpringRows,
        at: JointIndex,
        constraint: &JointConstraint,
        (bodies, substeps): (&BodySet, f64),
    ) {
        let inverses = constraint.anchors.map(|end| match end.body {
            BodyIndex::PLACEHOLDER => [0.0; 2],
            body => bodies.inverse_mass_inertia[body].map(f64::from),
        });
        let [mass, inertia] = [0, 1].map(|i| inverses[0][i] + inverses[1][i]);
        let offset = JointFrame::of(constraint).anchor_offset();
        let [stiffness, damping] = self.coefficients(mass);
        let by_forces = if stiffness > 0.0 { 0.0 } else { substeps };
        let velocity = relative_velocity(constraint, offset, (bodies, by_forces));
        let free: Vec2 = [0, 1].map(|i| -stiffness * offset[i] - damping * velocity[i]);
        let size = dot(free, free).sqrt();
        let direction = if size > 0.0 && size < f64::INFINITY {
            free.map(|component| component / size)
        } else {
            [1.0, 0.0]
        };
        let bound = self.greatest_force;
        let along = size.clamp(bound * std::f64::consts::FRAC_1_SQRT_2, bound);
        let across = (bound * bound - along * along).max(0.0).sqrt();
        let spring = SpringConstraint {
            ends: constraint.anchors,
            is_linear: false,
            axis: None,
            joint: Some(at),
            stiffness,
            damping,
            spin_damping: 0.0,
            stretch: 0.0,
            max_torque: 0.0,
            accelerations: [[0.0; 3]; 2],
            is_solved: false,
        };
        let perpendicular = [-direction[1], direction[0]];
        for (axis, max_force) in [(direction, along), (perpendicular, across)] {
            if stiffness + damping > 0.0 && max_force > 0.0 {
                let stretch = dot(offset, axis);
                springs.push(SpringConstraint { axis: Some(axis), stretch, max_torque: max_force, ..spring });
            }
        }
        let [stiffness, damping] = self.coefficients(inertia);
        if stiffness + damping > 0.0 && self.greatest_torque > 0.0 {
            let stretch = constraint.angle - self.target_angle;
            let max_torque = self.greatest_torque;
            springs.push(SpringConstraint { stiffness, damping, stretch, max_torque, ..spring });
        }
    }
}

/// Returns the velocity of the second anchor minus that of the point of the first body there, in length units/s. `offset` is
/// the vector from the first anchor to the second, in length units. The velocities of dynamic bodies count as after the forces of
/// `substeps` substeps.
fn relative_velocity(
    constraint: &JointConstraint,
    offset: Vec2,
    (bodies, substeps): (&BodySet, f64),
) -> Vec2 {
    let [[ax, ay, a], [bx, by, b]] = constraint.anchors.map(|end| match bodies.states.at(end.pose_body) {
        Some(state) if end.pose_body != BodyIndex::PLACEHOLDER => {
            let by_forces = if end.body == BodyIndex::PLACEHOLDER { 0.0 } else { substeps };
            let forces = bodies.force_delta[end.pose_body];
            std::array::from_fn(|axis| f64::from(state.velocity[axis]) + by_forces * f64::from(forces[axis]))
        }
        _ => end.velocity,
    });
    let [arm_a, arm_b] = [add_scaled(constraint.anchors[0].arm, offset, 1.0), constraint.anchors[1].arm];
    [bx - b * arm_b[1] - ax + a * arm_a[1], by + b * arm_b[0] - ay - a * arm_a[0]]
}

/// Returns the distance of the anchors on the bodies A and B, or on the world, in length units.
pub fn anchor_distance(ends: &[JointAnchor; 2]) -> f64 {
    JointFrame::between(LockedDofs::Distance, ends, 0.0).distance()
}
