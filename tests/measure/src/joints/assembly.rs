//! The description of a joint scene: bodies, joints and springs, in px, kg, s and rad, y down.
//!
//! The scene format of the tests is that of the original, which has no prismatic joints, and no limits and motors of
//! joints. An assembly has these, and no settings that other engines lack.

use crate::world::BodyState;

/// Greatest distance in px from the centre of a body without shape that counts for its speed.
const POINT_REACH: f32 = 8.0;
/// Size in px of the static floor, whose surface is y = 0: wider than any run reaches, thicker than anything falls in an
/// update.
const FLOOR: [f32; 2] = [12_800.0, 64.0];

/// The one shape of a body. Its centroid is the centre of mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Form {
    /// No shape: the body collides with nothing.
    None,
    /// Width and height in px, > 0.
    Rectangle([f32; 2]),
    /// Radius in px, > 0.
    Circle(f32),
}

impl Form {
    /// Moment of inertia about the centroid in kg px² of a homogeneous shape. A body without shape has a radius of
    /// gyration of 10 px.
    pub fn inertia(self, mass: f32) -> f32 {
        match self {
            Form::None => 100.0 * mass,
            Form::Rectangle([width, height]) => mass * (width * width + height * height) / 12.0,
            Form::Circle(radius) => 0.5 * mass * radius * radius,
        }
    }

    /// Distance in px from the centre to the farthest point.
    pub fn reach(self) -> f32 {
        match self {
            Form::None => POINT_REACH,
            Form::Rectangle([width, height]) => 0.5 * width.hypot(height),
            Form::Circle(radius) => radius,
        }
    }
}

/// A body, static or dynamic.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyDef {
    /// Centre of mass in px.
    pub position: [f32; 2],
    /// In rad, clockwise on the screen.
    pub angle: f32,
    /// In px/s.
    pub velocity: [f32; 2],
    /// In rad/s.
    pub angular_velocity: f32,
    /// In kg, > 0.
    pub mass: f32,
    /// Moment of inertia about the centre of mass in kg px², > 0.
    pub inertia: f32,
    /// Its shape.
    pub form: Form,
    /// Whether nothing moves it.
    pub is_static: bool,
    /// Bodies of one group do not collide; 0 is no group.
    pub group: i32,
    /// Coefficient of friction, >= 0.
    pub friction: f32,
}

impl BodyDef {
    /// The state at the start.
    pub fn state(&self) -> BodyState {
        let ([x, y], [vx, vy]) = (self.position.map(f64::from), self.velocity.map(f64::from));
        BodyState {
            position: [x, y, 0.0],
            angle: f64::from(self.angle),
            velocity: [vx, vy, 0.0],
            angular_velocity: f64::from(self.angular_velocity),
        }
    }
}

/// A joint or spring between two bodies, which may collide.
#[derive(Debug, Clone, PartialEq)]
pub struct JointDef {
    /// Index of the first body.
    pub body1: usize,
    /// Index of the second body.
    pub body2: usize,
    /// Its kind.
    pub kind: JointKind,
}

/// Anchors are in the world at the start, in px.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum JointKind {
    /// A revolute joint.
    Hinge {
        /// The point that both bodies share.
        anchor: [f32; 2],
        /// Least and greatest angle in rad of the second body against the first, from that at the start.
        limits: Option<[f32; 2]>,
        /// Speed in rad/s of the second body against the first, and greatest torque in kg px²/s².
        motor: Option<[f32; 2]>,
    },
    /// The bodies move as one.
    Weld {
        /// The point that both bodies share.
        anchor: [f32; 2],
    },
    /// A prismatic joint: the second body moves along a line of the first, and does not turn against it.
    Slider {
        /// A point of that line.
        anchor: [f32; 2],
        /// Its direction, of length 1.
        axis: [f32; 2],
    },
    /// A distance joint between the centres.
    Rod {
        /// In px, > 0.
        length: f32,
    },
    /// A spring from a point of the first body to the centre of the second.
    Spring {
        /// The point in the axes of the first body, in px.
        arm: [f32; 2],
        /// Rest length in px: the length at the start.
        length: f32,
        /// In kg/s², > 0.
        stiffness: f32,
        /// In kg/s, >= 0.
        damping: f32,
    },
}

/// Bodies, joints and springs under gravity. All restitutions are 0.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Assembly {
    /// Downwards, in px/s².
    pub gravity: f32,
    /// Coefficient of friction of bodies that are added.
    pub friction: f32,
    /// In the order of creation.
    pub bodies: Vec<BodyDef>,
    /// In the order of creation.
    pub joints: Vec<JointDef>,
}

impl Assembly {
    /// An empty scene.
    pub fn new(gravity: f32, friction: f32) -> Self {
        Assembly { gravity, friction, ..Assembly::default() }
    }

    /// A scene with a static floor whose surface is y = 0.
    pub fn with_floor(gravity: f32, friction: f32) -> Self {
        let mut assembly = Assembly::new(gravity, friction);
        assembly.wall([0.0, FLOOR[1] / 2.0], FLOOR);
        assembly
    }

    /// Adds a dynamic body and returns its index.
    pub fn body(&mut self, position: [f32; 2], form: Form, mass: f32, group: i32) -> usize {
        let inertia = form.inertia(mass);
        let (angle, friction, is_static) = (0.0, self.friction, false);
        let (velocity, angular_velocity) = ([0.0; 2], 0.0);
        self.bodies.push(BodyDef {
            position,
            angle,
            velocity,
            angular_velocity,
            mass,
            inertia,
            form,
            is_static,
            group,
            friction,
        });
        self.bodies.len() - 1
    }

    /// Adds a dynamic rectangle.
    pub fn rectangle(&mut self, position: [f32; 2], size: [f32; 2], mass: f32, group: i32) -> usize {
        self.body(position, Form::Rectangle(size), mass, group)
    }

    /// Adds a dynamic circle.
    pub fn circle(&mut self, position: [f32; 2], radius: f32, mass: f32, group: i32) -> usize {
        self.body(position, Form::Circle(radius), mass, group)
    }

    /// Adds a static rectangle.
    pub fn wall(&mut self, position: [f32; 2], size: [f32; 2]) -> usize {
        let wall = self.rectangle(position, size, 1.0, 0);
        self.bodies[wall].is_static = true;
        wall
    }

    /// Adds a static body without shape.
    pub fn post(&mut self, position: [f32; 2]) -> usize {
        let post = self.body(position, Form::None, 1.0, 0);
        self.bodies[post].is_static = true;
        post
    }

    /// Adds a joint.
    pub fn joint(&mut self, body1: usize, body2: usize, kind: JointKind) {
        self.joints.push(JointDef { body1, body2, kind });
    }

    /// Adds a hinge without limits and motor.
    pub fn hinge(&mut self, body1: usize, body2: usize, anchor: [f32; 2]) {
        self.joint(body1, body2, JointKind::Hinge { anchor, limits: None, motor: None });
    }

    /// Adds a weld.
    pub fn weld(&mut self, body1: usize, body2: usize, anchor: [f32; 2]) {
        self.joint(body1, body2, JointKind::Weld { anchor });
    }

    /// Adds a slider.
    pub fn slider(&mut self, body1: usize, body2: usize, anchor: [f32; 2], axis: [f32; 2]) {
        self.joint(body1, body2, JointKind::Slider { anchor, axis });
    }

    /// Adds a rod as long as the centres are apart.
    pub fn rod(&mut self, body1: usize, body2: usize) {
        let length = self.distance(body1, [0.0; 2], body2);
        self.joint(body1, body2, JointKind::Rod { length });
    }

    /// Adds a spring as long as its ends are apart.
    pub fn spring(&mut self, body1: usize, arm: [f32; 2], body2: usize, stiffness: f32, damping: f32) {
        let length = self.distance(body1, arm, body2);
        self.joint(body1, body2, JointKind::Spring { arm, length, stiffness, damping });
    }

    /// From a point in the axes of the first body to the centre of the second, in px.
    fn distance(&self, body1: usize, arm: [f32; 2], body2: usize) -> f32 {
        let ends =
            [self.bodies[body1].state().to_world(arm.map(f64::from)), self.bodies[body2].state().place()];
        crate::world::distance(ends[0], ends[1]) as f32
    }

    /// Whether a motor adds energy.
    pub fn is_driven(&self) -> bool {
        self.joints.iter().any(|joint| matches!(joint.kind, JointKind::Hinge { motor: Some(_), .. }))
    }
}
