//! Adapter: import of the game's springs as rows of the solvers.
//!
//! A spring at a body with joints or contacts becomes a [row](farseer_precise::joints::springs); all others stay explicit forces. The
//! choice is made when the spring acts. The step then reads pose and coefficients of each row.

use super::joint_import::{JointImport, JointTable, bodies_hash};
use crate::body::{Body, BodyId};
use crate::math::Vector2;
use crate::objects::Objects;
use crate::springs::{Spring, SpringForce, SpringId, SpringKind};
use farseer_precise::broad_phase::pairs::Pairs;
use farseer_precise::broad_phase::proxies::Proxies;
use farseer_precise::index::BodyIndex;
use farseer_precise::joints::JointSystem;
use farseer_precise::joints::joint_constraint::JointAnchor;
use farseer_precise::joints::springs::{SpringConstraint, SpringRows, anchor_distance};

/// The parts by which a spring becomes a row or stays an explicit force.
pub(super) struct SpringChoice<'a> {
    pub(super) import: JointImport<'a>,
    pub(super) joints: &'a JointSystem,
    pub(super) pairs: &'a Pairs,
    pub(super) proxies: &'a Proxies,
}

impl SpringChoice<'_> {
    /// Returns the accelerations that the explicit forces `pushes` of a spring would give to its bodies A and B, if the spring
    /// becomes a row: x and y in length units/s^2, angular in radians/s^2. `None` if the forces stay explicit.
    pub(super) fn row_accelerations(
        &self,
        spring: &Spring,
        pushes: [Option<SpringForce>; 2],
    ) -> Option<[[f32; 3]; 2]> {
        if !(is_passive(spring) && self.needs_constraint(spring)) {
            return None;
        }
        let mut accelerations = [[0.0; 3]; 2];
        for push in pushes.into_iter().flatten() {
            // A spring to the world has its body on side B.
            let side = usize::from(spring.body2().is_none() || push.body() != spring.body1());
            accelerations[side] = push.accelerations(&self.import.objects[push.body()].body);
        }
        Some(accelerations)
    }

    /// Returns whether both bodies of a spring are awake and enabled, and one of them is dynamic and has a joint or a contact.
    fn needs_constraint(&self, spring: &Spring) -> bool {
        let JointImport { bodies, sleep, .. } = self.import;
        let [one, other] = spring.ends().map(|end| end.map(|body| self.import.ids.body_index(body)));
        let ends =
            [one.unwrap_or(Some(BodyIndex::PLACEHOLDER)), other.unwrap_or(Some(BodyIndex::PLACEHOLDER))];
        let [Some(a), Some(b)] = ends else { return false };
        let is_held = |&body: &BodyIndex| {
            body != BodyIndex::PLACEHOLDER
                && body < bodies.first_static()
                && bodies.is_dynamic(body)
                && (self.joints.has_joint(body) || self.has_contact(body))
        };
        a != b && ![a, b].iter().any(|&body| sleep.is_asleep(body)) && [a, b].iter().any(is_held)
    }

    /// Returns whether the body with the index `body` has a contact constraint.
    fn has_contact(&self, body: BodyIndex) -> bool {
        self.pairs.pairs_of_body(self.proxies, body).any(|pair| self.pairs.has_constraint(pair))
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

/// Reads poses and coefficients of the springs that are rows, for this step. Returns a hash of these springs, of their bodies, and
/// of which of these bodies are dynamic; 0 without springs (multiplicative hashing).
///
/// The hash does not depend on body indices, since restoring a snapshot changes these.
pub(super) fn import_springs(
    table: &JointTable,
    rows: &mut SpringRows,
    import: JointImport<'_>,
    objects: &Objects,
) -> u64 {
    rows.clear();
    let mut signature = 0_u64;
    for &(id, accelerations) in &table.row_springs {
        let Some(spring) = objects.springs.get(id) else { continue };
        let Some(constraint) = import.spring_constraint(spring) else { continue };
        signature = (signature.rotate_left(5) ^ spring_hash((id, spring), &constraint))
            .wrapping_add(1)
            .wrapping_mul(0x9E37_79B9_7F4A_7C15);
        rows.push(SpringConstraint { accelerations, ..constraint });
    }
    signature
}

/// Returns a hash of a spring, of its bodies, and of which of them are dynamic.
fn spring_hash((id, spring): (SpringId, &Spring), constraint: &SpringConstraint) -> u64 {
    let [a, b] = constraint.ends.map(|end| u64::from(end.body != BodyIndex::PLACEHOLDER));
    id.to_bits().rotate_left(2) ^ (a << 1 | b) ^ bodies_hash(spring.ends())
}

impl JointImport<'_> {
    /// Returns the constraint of a spring at the present poses.
    ///
    /// Returns `None` if no end is on a dynamic body, if both ends are on the same body, or if a linear spring with a rest
    /// length has coincident anchors.
    fn spring_constraint(self, spring: &Spring) -> Option<SpringConstraint> {
        let (ends, rest_length) = self.spring_anchors(spring)?;
        let is_linear = matches!(spring.kind(), SpringKind::Linear(_) | SpringKind::FixedLinear(_));
        let distance = if is_linear { anchor_distance(&ends) } else { 0.0 };
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
            ends,
            is_linear,
            axis: None,
            joint: None,
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
                self.bodies.states.at(end.body).map_or(0.0, |state| state.velocity[2])
            });
        }
        (constraint.ends[0].body != constraint.ends[1].body).then_some(constraint)
    }

    /// Returns the anchors of a spring and its rest length in length units. An angle spring has instead of the length its rest
    /// angle minus its present angle, in radians.
    ///
    /// Returns `None` if a body is gone.
    fn spring_anchors(self, spring: &Spring) -> Option<([JointAnchor; 2], f64)> {
        let angle_of =
            |body: BodyId| self.objects.get(body).map(|entry| f64::from(entry.body.total_rotation()));
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
        Some(([self.anchor(a, p)?, self.anchor(b, q)?], rest))
    }
}

impl SpringForce {
    /// The body.
    pub(crate) fn body(self) -> BodyId {
        match self {
            SpringForce::Force { body, .. } | SpringForce::Torque { body, .. } => body,
        }
    }

    /// Accelerations of the body, in length units/s² and rad/s².
    pub(crate) fn accelerations(self, body: &Body) -> [f32; 3] {
        let (force, torque) = match self {
            SpringForce::Force { force, point, .. } => {
                let arm = point - body.position();
                (force, arm.x * force.y - arm.y * force.x)
            }
            SpringForce::Torque { torque, .. } => (Vector2::zeros(), torque),
        };
        let inverse = body.inverse_mass();
        [force.x * inverse, force.y * inverse, torque * body.inverse_moment_of_inertia()]
    }
}
