//! Pulley joint: a rope over two pulleys between two bodies. Not in the original, and only for the precise set.

use serde::{Deserialize, Serialize};

use crate::body::missing_body::missing_body_id;
use crate::body::{Body, BodyId};
use crate::error::{Error, Result};
use crate::joints::bodies::{only_precise, two_bodies};
use crate::joints::joint_body::{JointBodies, JointPose, JointStep};
use crate::joints::{Joint, JointKind};
use crate::math::Vector2;
use crate::math::finite::{finite_vector, zero_or_more};

/// A rope from the first body up to a pulley, on to another pulley, and down to the second body. With the lengths of rope a and b
/// between the bodies and their pulleys, a + [ratio](Self::ratio) · b is never greater than the [length](Self::length). The rope
/// has no mass, does not stretch, and only pulls. A ratio of 2 is a block and tackle: the second body moves by half of the way,
/// with twice the force.
///
/// Pulleys are points of the world, anchors points of the bodies. [`Joint::force`] is the force on the second body: read it, and the
/// [error](crate::Joint::joint_error), by the [untyped id](crate::TypedJointId::id).
///
/// The lengths of rope are distances. A body that is pulled up to its pulley hangs there, and its force points to and fro. A floor
/// below the other body stops it before.
///
/// Only the [precise set](crate::Methods::Precise) supports it: under the faithful one it cannot be added. It is a row of the
/// iterative solver; islands with a pulley are not solved by the [direct one](crate::guide::solvers). Its error is the length by
/// which the rope is too long: 0.01 px with masses of 4 and 7 under a gravity of 900 px/s². In `twohalf` it does not act on bodies
/// in a group of pins and sliders.
///
/// ```
/// use farseer_core::math::Vector2;
/// use farseer_core::{BodyFactory, JointFactory, Methods, PhysicsSimulator};
/// let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 300.0))?;
/// simulator.set_methods(Methods::PRECISE)?;
/// let [light, heavy] = [(-50.0, 1.0), (50.0, 2.0)].map(|(x, mass)| {
///     let body = BodyFactory::create_rectangle_body_in(&mut simulator, 20.0, 20.0, mass)?;
///     simulator[body].set_position(Vector2::new(x, 0.0));
///     Ok::<_, farseer_core::Error>((body, Vector2::zeros()))
/// });
/// let pulleys = [Vector2::new(-50.0, -100.0), Vector2::new(50.0, -100.0)];
/// let (light, heavy) = (light?, heavy?);
/// let rope = JointFactory::create_pulley_joint_in(&mut simulator, [light, heavy], pulleys, 1.0)?;
/// (0..30).for_each(|_| simulator.update(1.0 / 60.0));
/// // Atwood's machine: a third of gravity.
/// assert!((simulator[heavy.0].linear_velocity().y - 50.0).abs() < 1.0);
/// // The rope pulls the heavy one up with 2 m1 m2 g / (m1 + m2).
/// assert!((simulator[rope.id()].force().y + 400.0).abs() < 1.0);
/// assert!(simulator[rope.id()].joint_error() < 0.05);
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[derive(Debug, Clone, Serialize, Deserialize)]
#[doc(alias("b2PulleyJoint", "rope", "block and tackle"))]
pub struct PulleyJoint {
    body1: BodyId,
    body2: BodyId,
    anchors: [Vector2; 2],
    pulleys: [Vector2; 2],
    ratio: f32,
    length: f32,
}

impl PulleyJoint {
    pub(crate) fn new(
        bodies: [(BodyId, &Body); 2],
        anchors: [Vector2; 2],
        pulleys: [Vector2; 2],
        ratio: f32,
    ) -> Result<Joint> {
        let [body1, body2] = bodies.map(|(id, _)| id);
        let mut joint = PulleyJoint { body1, body2, ..PulleyJoint::without_bodies() };
        for (at, name) in [(0, "ends[0]"), (1, "ends[1]")] {
            joint.anchors[at] = finite_vector(name, anchors[at])?;
        }
        joint.set_pulleys(pulleys)?;
        if !(ratio > 0.0 && ratio.is_finite()) {
            return Err(Error::invalid("ratio", ratio, "greater than 0 and finite"));
        }
        joint.ratio = ratio;
        let rope = |at: usize| (bodies[at].1.get_world_position(anchors[at]) - pulleys[at]).norm();
        joint.set_length(rope(0) + ratio * rope(1))?;
        Ok(Joint::of(JointKind::Pulley(joint)))
    }

    pub(crate) fn without_bodies() -> Self {
        PulleyJoint {
            body1: missing_body_id(),
            body2: missing_body_id(),
            anchors: [Vector2::zeros(); 2],
            pulleys: [Vector2::zeros(); 2],
            ratio: 1.0,
            length: 0.0,
        }
    }

    two_bodies! {}

    /// The ends of the rope, each in the coordinates of its body, in length units.
    pub fn anchors(&self) -> [Vector2; 2] {
        self.anchors
    }

    /// The points of the world over which the rope runs, in length units.
    pub fn pulleys(&self) -> [Vector2; 2] {
        self.pulleys
    }

    /// Moves the pulleys to points of the world; the length of the rope stays.
    ///
    /// # Errors
    /// A point that is not finite. The pulleys stay then.
    pub fn set_pulleys(&mut self, pulleys: [Vector2; 2]) -> Result<()> {
        pulleys.iter().try_for_each(|&pulley| finite_vector("pulleys", pulley).map(drop))?;
        self.pulleys = pulleys;
        Ok(())
    }

    /// Weight of the second length of rope, dimensionless, greater than 0.
    pub fn ratio(&self) -> f32 {
        self.ratio
    }

    /// Length of the rope, in length units: the greatest sum of the first length and the ratio times the second one. By default
    /// what it was when the joint was made.
    pub fn length(&self) -> f32 {
        self.length
    }

    /// Sets the [length](Self::length): a winch. Edit the joint by its typed id, `simulator[rope].set_length(...)`.
    ///
    /// The rope follows a length that shrinks in every update 1.4 updates behind. The correction moves the bodies but is no part of
    /// their velocity. A length that grows lets them fall and catches them after some updates. A lift with a speed has a
    /// [prismatic joint](crate::PrismaticJoint) with a motor, or a counterweight that drives it.
    ///
    /// # Errors
    /// A length that is not finite and 0 or more. The old length stays then.
    pub fn set_length(&mut self, length: f32) -> Result<()> {
        self.length = zero_or_more("length", length)?;
        Ok(())
    }

    only_precise! {}

    pub(crate) fn is_valid(&self) -> bool {
        let points = self.anchors.iter().chain(&self.pulleys);
        points.into_iter().all(|point| point.x.is_finite() && point.y.is_finite())
            && self.ratio > 0.0
            && self.ratio.is_finite()
            && zero_or_more("length", self.length).is_ok()
    }
}
