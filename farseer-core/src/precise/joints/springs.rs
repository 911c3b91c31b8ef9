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
//! [`Precise::constrain_spring`] makes this choice for each spring when it acts. A spring that the direct solver does not solve
//! in this step is solved by the [iterative solver](super::soft_spring).
//!
//! | spring | rows of the direct solver |
//! |---|---|
//! | linear, fixed linear | along the line between its anchors; across it for geometric stiffness beyond the stable limit |
//! | angle | the angle; its damping acts on the angular velocity of each body and adds to their inertia |
//! | fixed angle | the angle |

use super::super::Precise;
use super::super::direct_solver::constraint::{BodyIndices, FIXED};
use super::super::direct_solver::joint::{ALONG, ANGLE, JointRows, SpringDamper};
use super::super::scaled_parameters::StepContext;
use super::articulated_body::LockedDofs;
use super::frame::JointFrame;
use super::joint_constraint::JointAnchor;
use super::{JointCandidate, bodies_hash};
use crate::body::BodyId;
use crate::math::Vector2;
use crate::objects::Objects;
use crate::springs::{Spring, SpringForce, SpringId, SpringKind};
use crate::storage::reusing_clone::reusing_clone;

/// Springs that solvers treat as rows in this update, instead of explicit forces.
#[derive(Debug, Default)]
pub(in crate::precise) struct SpringRows {
    /// Springs that became rows, in the order of the simulator's list. Each has the accelerations that its explicit force would
    /// give to A and B: x and y in length units/s^2, angular in radians/s^2.
    constrained: Vec<(SpringId, [[f32; 3]; 2])>,
    /// The springs of `constrained` that act on a dynamic body, with poses and coefficients in this step.
    constraints: Vec<SpringConstraint>,
    /// For each body index whether a spring of `constraints` acts on the body. Unused between steps.
    is_body_attached: Vec<bool>,
}

reusing_clone! { SpringRows { constrained, constraints, is_body_attached } }

/// A spring with its pose and coefficients in one step.
#[derive(Debug, Clone, Copy)]
pub(in crate::precise) struct SpringConstraint {
    spring: SpringId,
    /// Bodies A and B of the spring, `None` for the world.
    bodies: [Option<BodyId>; 2],
    /// Anchors on the bodies A and B, or on the world.
    ends: [JointAnchor; 2],
    /// Whether the row is along the line between the anchors; else it is angular.
    is_linear: bool,
    /// Stiffness k, >= 0: mass units/s^2 in linear springs, mass units * length units^2/s^2 per radian in angle springs.
    pub(super) stiffness: f64,
    /// Damping c, >= 0: mass units/s in linear springs, mass units * length units^2/s in angle springs.
    pub(super) damping: f64,
    /// Torque on each body per angular velocity of that body, mass units * length units^2/s, >= 0. It damps angle springs
    /// between two bodies, whose `damping` is 0.
    spin_damping: f64,
    /// Stretch at the start of the step: length units in linear springs, radians in angle springs.
    pub(super) stretch: f64,
    /// Largest torque, mass units * length units^2/s^2, > 0; infinite for linear springs.
    pub(super) max_torque: f64,
    /// Accelerations that the explicit force of the spring would give to A and B: x and y in length units/s^2, angular in
    /// radians/s^2.
    accelerations: [[f32; 3]; 2],
    /// Whether the direct solver has solved the spring in this step.
    is_solved: bool,
}

impl SpringRows {
    /// Returns whether no spring is a row in this step.
    pub(in crate::precise) fn is_empty(&self) -> bool {
        self.constraints.is_empty()
    }

    /// Removes all springs from the list of this step, since the body indices in them have become invalid.
    pub(in crate::precise) fn clear_body_indices(&mut self) {
        self.constraints.clear();
    }

    /// Returns the springs of this step as candidates for islands of the direct solver.
    pub(in crate::precise) fn candidates(&self) -> impl Iterator<Item = JointCandidate> + '_ {
        self.constraints.iter().enumerate().map(|(at, hold)| JointCandidate {
            joint: at as u32,
            bodies: hold.ends.map(|end| end.body),
            is_free_articulation: false,
            has_rows: true,
            error: 0.0,
        })
    }

    /// Returns the spring at `index` of the list of this step.
    pub(in crate::precise) fn constraint(&self, index: u32) -> &SpringConstraint {
        &self.constraints[index as usize]
    }

    /// Marks the spring at `index` as solved by the direct solver, so that the iterative solver leaves it out.
    pub(in crate::precise) fn mark_solved(&mut self, index: u32) {
        self.constraints[index as usize].is_solved = true;
    }

    /// Returns the springs that the direct solver has not solved.
    pub(super) fn unsolved(&self) -> impl Iterator<Item = &SpringConstraint> + '_ {
        self.constraints.iter().filter(|hold| !hold.is_solved)
    }

    /// Returns whether the direct solver has solved all springs of this step.
    pub(in crate::precise) fn are_all_solved(&self) -> bool {
        self.unsolved().next().is_none()
    }

    /// Returns whether a spring of this step acts on the body with the index `body`.
    pub(in crate::precise) fn is_attached_to(&self, body: usize) -> bool {
        self.is_body_attached.get(body) == Some(&true)
    }

    /// Returns a hash of the springs, of their bodies, and of which of these bodies are dynamic; 0 without springs
    /// (multiplicative hashing).
    ///
    /// It does not depend on body indices, since restoring a snapshot changes these.
    pub(in crate::precise) fn signature(&self) -> u64 {
        self.constraints.iter().fold(0, |sum: u64, hold| {
            let [a, b] = hold.ends.map(|end| u64::from(end.body != 0));
            let word = hold.spring.to_bits().rotate_left(2) ^ (a << 1 | b);
            let word = word ^ bodies_hash(hold.bodies);
            (sum.rotate_left(5) ^ word).wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15)
        })
    }
}

impl SpringConstraint {
    /// Returns the rows of the spring in a step of `dt` seconds, for the direct solver.
    ///
    /// `lever` converts angular errors to linear ones where errors are compared, length units per radian.
    pub(in crate::precise) fn constraint_rows(
        &self,
        body_indices: BodyIndices,
        dt: f64,
        lever: f64,
    ) -> JointRows {
        let frame = self.frame();
        let row = if self.is_linear { ALONG } else { ANGLE };
        let prescribed = [0, 1]
            .map(|side| if body_indices.bodies[side] == FIXED { self.ends[side].velocity } else { [0.0; 3] });
        let mut rows = JointRows::new(body_indices, frame.jacobian(), [0.0; 3], prescribed, lever);
        let SpringConstraint { stiffness, damping, stretch, .. } = *self;
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
        let link = if self.is_linear { LockedDofs::Distance } else { LockedDofs::Angle };
        JointFrame::between(link, &self.ends, self.stretch)
    }

    /// Returns the anchors of the spring on the bodies A and B, or on the world.
    pub(super) fn ends(&self) -> &[JointAnchor; 2] {
        &self.ends
    }

    /// Returns the torque on each body per angular velocity of that body, mass units * length units^2/s; 0 for linear springs.
    pub(in crate::precise) fn spin_damping(&self) -> f64 {
        self.spin_damping
    }
}

/// Returns whether a row can express the spring: stiffness and damping are not negative, one of them is positive, and its
/// torque is not 0.
fn is_passive(spring: &Spring) -> bool {
    let (stiffness, damping) = (spring.spring_constant(), spring.damping_constant());
    let is_strong = match spring.kind() {
        SpringKind::Angle(angle) => angle.max_torque() > 0.0 && angle.torque_multiplier() != 0.0,
        SpringKind::FixedAngle(angle) => angle.max_torque() > 0.0 && angle.torque_multiplier() != 0.0,
        _ => true,
    };
    is_strong && stiffness >= 0.0 && damping >= 0.0 && stiffness + damping > 0.0
}

/// Returns the torque limit in mass units * length units^2/s^2: `torque`, or infinity if `torque` is `f32::MAX` or more.
fn torque_limit(torque: f32) -> f64 {
    if torque < f32::MAX { torque.into() } else { f64::INFINITY }
}

impl Precise {
    /// Starts the springs of an update: clears the list of springs that are rows, and imports edited joints.
    ///
    /// Joints are imported here because [`constrain_spring`](Self::constrain_spring) decides by them.
    pub(crate) fn begin_springs(&mut self, objects: &Objects) {
        self.springs.constrained.clear();
        if self.depth.is_none() && !objects.springs.list().is_empty() {
            self.reimport_joints(objects);
        }
    }

    /// Decides whether a spring is a row in this update, and adds it to the list of rows if so. Returns whether it is a row;
    /// the caller must not apply the explicit forces `pushes` then.
    pub(crate) fn constrain_spring(
        &mut self,
        id: SpringId,
        pushes: [Option<SpringForce>; 2],
        objects: &Objects,
    ) -> bool {
        let spring = &objects.springs[id];
        let takes = self.depth.is_none() && is_passive(spring) && self.needs_constraint(spring);
        if takes {
            let mut accelerations = [[0.0; 3]; 2];
            for push in pushes.into_iter().flatten() {
                // A spring to the world has its body on side B.
                let side = usize::from(spring.body2().is_none() || push.body() != spring.body1());
                accelerations[side] = push.accelerations(&objects.bodies[push.body()].body);
            }
            self.springs.constrained.push((id, accelerations));
        }
        takes
    }

    /// Returns whether both bodies of a spring are awake and enabled, and one of them is dynamic and has a joint or a contact.
    fn needs_constraint(&self, spring: &Spring) -> bool {
        let [one, other] = spring.ends().map(|end| end.map(|body| self.body_index(body)));
        let ends = [one.unwrap_or(Some(0)), other.unwrap_or(Some(0))];
        let [Some(a), Some(b)] = ends else { return false };
        let is_held = |&body: &usize| {
            body != 0
                && body < self.bodies.first_static()
                && self.bodies.is_dynamic(body)
                && (self.joints.has_joint(body) || self.has_contact(body))
        };
        a != b && ![a, b].iter().any(|&body| self.sleep.is_asleep(body)) && [a, b].iter().any(is_held)
    }

    /// Returns whether the body with the index `body` has a contact constraint.
    fn has_contact(&self, body: usize) -> bool {
        self.pairs.pairs_of_body(&self.proxies, body).any(|pair| self.pairs.all[pair].constraint.is_some())
    }

    /// Computes poses and coefficients of the springs that are rows, for this step.
    ///
    /// Adds half the acceleration by each explicit force times dt^2 to `force_position_delta` of its bodies. With this term the
    /// force moves bodies by the symplectic Euler method, as in the faithful set.
    pub(super) fn import_springs(&mut self, objects: &Objects, step: &StepContext) {
        let mut springs = std::mem::take(&mut self.springs);
        springs.constraints.clear();
        let of_step = springs.constrained.iter().filter_map(|&(id, accelerations)| {
            let constraint = self.spring_constraint((id, objects.springs.get(id)?), objects)?;
            Some(SpringConstraint { accelerations, ..constraint })
        });
        springs.constraints.extend(of_step);
        if !(springs.constraints.is_empty() && springs.is_body_attached.is_empty()) {
            springs.is_body_attached.clear();
            springs
                .is_body_attached
                .resize(if springs.constraints.is_empty() { 0 } else { self.bodies.states.len() }, false);
        }
        for hold in &springs.constraints {
            for (end, accelerations) in hold.ends.iter().zip(hold.accelerations) {
                if end.body != 0 {
                    springs.is_body_attached[end.body as usize] = true;
                    let position_delta = &mut self.bodies.force_position_delta[end.body as usize];
                    (0..3).for_each(|axis| {
                        position_delta[axis] += accelerations[axis] * (0.5 * step.dt * step.dt)
                    });
                }
            }
        }
        self.springs = springs;
    }

    /// Returns the constraint of a spring at the present poses.
    ///
    /// Returns `None` if no end is on a dynamic body, if both ends are on the same body, or if a linear spring with a rest
    /// length has coincident anchors.
    fn spring_constraint(
        &self,
        (id, spring): (SpringId, &Spring),
        objects: &Objects,
    ) -> Option<SpringConstraint> {
        let (ends, rest_length) = self.spring_anchors(spring, objects)?;
        let is_linear = matches!(spring.kind(), SpringKind::Linear(_) | SpringKind::FixedLinear(_));
        let distance = JointFrame::between(LockedDofs::Distance, &ends, 0.0).distance();
        // A spring with rest length 0 has the same stiffness in all directions, so that it needs no direction at distance 0.
        if is_linear && distance == 0.0 && rest_length != 0.0 {
            return None;
        }
        let stretch = if is_linear { distance - rest_length } else { -rest_length };
        let (multiplier, max_torque) = match spring.kind() {
            SpringKind::Angle(angle) => (angle.torque_multiplier(), torque_limit(angle.max_torque())),
            SpringKind::FixedAngle(angle) => (angle.torque_multiplier(), torque_limit(angle.max_torque())),
            _ => (1.0, f64::INFINITY),
        };
        let [stiffness, damping] = [spring.spring_constant(), spring.damping_constant()]
            .map(|constant| f64::from(multiplier.abs()) * f64::from(constant));
        let mut constraint = SpringConstraint {
            spring: id,
            bodies: spring.ends(),
            ends,
            is_linear,
            stiffness,
            damping,
            spin_damping: 0.0,
            stretch,
            max_torque,
            accelerations: [[0.0; 3]; 2],
            is_solved: false,
        };
        if matches!(spring.kind(), SpringKind::Angle(_)) {
            constraint.set_spin_damping(|end| {
                self.bodies.states.get(end.body as usize).map_or(0.0, |hot| hot.velocity[2])
            });
        }
        (constraint.ends[0].body != constraint.ends[1].body).then_some(constraint)
    }

    /// Returns the anchors of a spring and its rest length in length units. An angle spring has instead of the length its rest
    /// angle minus its present angle, in radians.
    ///
    /// Returns `None` if a body is gone.
    fn spring_anchors(&self, spring: &Spring, objects: &Objects) -> Option<([JointAnchor; 2], f64)> {
        let bodies = &objects.bodies;
        let angle_of = |body: BodyId| bodies.get(body).map(|entry| f64::from(entry.body.total_rotation()));
        let origin = Vector2::zeros();
        let ([(a, p), (b, q)], rest) = match spring.kind() {
            SpringKind::Linear(linear) => {
                let one = (Some(linear.body1()), linear.attach_point1());
                ([one, (Some(linear.body2()), linear.attach_point2())], linear.rest_length().into())
            }
            SpringKind::FixedLinear(linear) => {
                let one = (None, linear.world_attach_point());
                ([one, (Some(linear.body()), linear.body_attach_point())], linear.rest_length().into())
            }
            SpringKind::Angle(angle) => {
                let turned = angle_of(angle.body2())? - angle_of(angle.body1())?;
                let ends = [angle.body1(), angle.body2()].map(|body| (Some(body), origin));
                (ends, f64::from(angle.target_angle()) - turned)
            }
            SpringKind::FixedAngle(angle) => {
                let turned = angle_of(angle.body())?;
                ([(None, origin), (Some(angle.body()), origin)], f64::from(angle.target_angle()) - turned)
            }
        };
        Some(([self.joint_anchor(a, p, bodies)?, self.joint_anchor(b, q, bodies)?], rest))
    }
}

impl SpringConstraint {
    /// Moves `damping` of an angle spring to `spin_damping`, which acts on the angular velocities of its bodies. A spring at
    /// its torque limit has no damping.
    ///
    /// An angle spring damps the angular velocity of each body, not the relative one. `angular_velocity` returns that of an
    /// anchor's body in radians/s.
    fn set_spin_damping(&mut self, angular_velocity: impl Fn(&JointAnchor) -> f32) {
        let damping = std::mem::take(&mut self.damping);
        let is_bounded = |end: &JointAnchor, sign: f64| {
            end.body != 0
                && (sign * self.stiffness * self.stretch - damping * f64::from(angular_velocity(end))).abs()
                    >= self.max_torque
        };
        if !(is_bounded(&self.ends[0], 1.0) || is_bounded(&self.ends[1], -1.0)) {
            self.spin_damping = damping;
        }
    }
}
