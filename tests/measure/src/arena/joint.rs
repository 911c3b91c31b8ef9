//! Description of a joint of the arena, independent of the engine.

use super::scene::{Body, Point};

/// Kind of a joint: the freedoms that it takes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum JointKind {
    /// A revolute joint: both bodies share the anchor.
    #[default]
    Hinge,
    /// A weld: both bodies share the anchor and keep their relative angle.
    Weld,
    /// A prismatic joint: the anchor of the second body moves along a line through that of the first, and the relative angle
    /// stays.
    Slider {
        /// Direction of the line at the start: a unit vector in the world.
        axis: Point,
    },
    /// A distance joint: the centres of mass keep their distance.
    Rod,
    /// A rope: the distance of the centres of mass is at most its length.
    Rope {
        /// Greatest distance of the centres of mass, metres, > 0.
        length: f32,
    },
    /// A spring between the centres of mass; its rest length is their initial distance.
    Spring,
}

/// A joint between two bodies, which do not collide with each other.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Indices of the two bodies, in the order of creation.
    pub bodies: [usize; 2],
    /// Kind of the joint.
    pub kind: JointKind,
    /// World position in m of the point that both bodies share, when the joint is made. Rods, ropes and springs do not use it.
    pub anchor: Point,
    /// Relative angle of the second body in rad at which the joint angle is 0; welds and sliders keep it.
    pub reference: f32,
    /// Least and greatest joint angle in rad, or translation of a slider in m; `None` for no limits.
    pub limits: Option<[f32; 2]>,
    /// Angular velocity in rad/s of the second body relative to the first that the motor seeks, and greatest torque in N m.
    /// A slider has a velocity in m/s and a force in N. `None` for no motor.
    pub motor: Option<[f32; 2]>,
    /// Frequency in Hz and damping ratio of a spring that pulls the joint angle to 0, or of [`JointKind::Spring`]; `None` for
    /// no spring.
    pub spring: Option<[f32; 2]>,
}

impl Joint {
    /// Creates a hinge without limits, motor and spring; `anchor` is a world position in m.
    pub fn new(bodies: [usize; 2], anchor: Point) -> Self {
        let kind = JointKind::Hinge;
        Joint { bodies, kind, anchor, reference: 0.0, limits: None, motor: None, spring: None }
    }

    /// Creates a joint without limits, motor and spring; `anchor` is a world position in m. `ends` describes the bodies, whose
    /// initial relative angle becomes the reference.
    pub fn between(kind: JointKind, bodies: [usize; 2], ends: [&Body; 2], anchor: Point) -> Self {
        Joint { kind, reference: ends[1].angle - ends[0].angle, ..Joint::new(bodies, anchor) }
    }

    /// Returns whether a motor or a spring can add energy to the scene.
    pub fn is_driven(&self) -> bool {
        self.motor.is_some() || self.spring.is_some()
    }

    /// Returns the anchors in m in the coordinates of `bodies`, which are in the order of [`Joint::bodies`].
    pub(super) fn local_anchors(&self, bodies: [&Body; 2]) -> [Point; 2] {
        match self.kind {
            JointKind::Hinge | JointKind::Weld | JointKind::Slider { .. } => {
                bodies.map(|body| body.local(self.anchor))
            }
            JointKind::Rod | JointKind::Rope { .. } | JointKind::Spring => [[0.0; 2]; 2],
        }
    }

    /// Returns the angle of a slider's axis in rad in each of `bodies`; 0 for other joints.
    pub(super) fn local_axes(&self, bodies: [&Body; 2]) -> [f32; 2] {
        match self.kind {
            JointKind::Slider { axis: [x, y] } => {
                [y.atan2(x) - bodies[0].angle, y.atan2(x) - bodies[0].angle - self.reference]
            }
            _ => [0.0; 2],
        }
    }

    /// Returns the initial distance in m of the centres of mass of `bodies`.
    pub(super) fn length(bodies: [&Body; 2]) -> f32 {
        let [[x1, y1], [x2, y2]] = bodies.map(|body| body.position);
        (x2 - x1).hypot(y2 - y1)
    }

    /// Returns stiffness and damping of a spring between two bodies from its frequency in Hz and its damping ratio. `mobility`
    /// is the inverse mass of a body in 1/kg, or its inverse moment of inertia in 1/(kg m²).
    pub(super) fn stiffness(
        bodies: [&Body; 2],
        [hertz, ratio]: [f32; 2],
        mobility: fn(&Body) -> f32,
    ) -> [f32; 2] {
        let inertia = 1.0 / bodies.map(mobility).iter().sum::<f32>();
        let omega = std::f32::consts::TAU * hertz;
        [inertia * omega * omega, 2.0 * ratio * inertia * omega]
    }
}
