//! The description of a joint scene: bodies, joints and springs, in px, kg, s and rad, y down.
//!
//! The scene format of the conformance tests follows the original engine, which has neither prismatic joints nor limits and
//! motors. An assembly has these, and no settings that other engines lack.

use crate::world::BodyState;

/// Reach r of a body without a shape, in px. The speed of a body is |v| + |angular velocity| r; for other bodies r is the distance
/// to the farthest point of the shape.
const POINT_REACH: f32 = 8.0;
/// Width and height in px of the static floor, whose surface is y = 0: wider than any run reaches, thicker than any fall in
/// one update.
const FLOOR: [f32; 2] = [12_800.0, 64.0];

/// Shape of a body. Its centroid is the centre of mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Form {
    /// The body has no shape and does not collide.
    None,
    /// The body is a rectangle: width and height in px, > 0.
    Rectangle([f32; 2]),
    /// The body is a circle: radius in px, > 0.
    Circle(f32),
}

impl Form {
    /// Returns the moment of inertia about the centroid in kg px² of a homogeneous shape; `mass` in kg. A body without a
    /// shape has a radius of gyration of 10 px.
    pub fn inertia(self, mass: f32) -> f32 {
        match self {
            Form::None => 100.0 * mass,
            Form::Rectangle([width, height]) => mass * (width * width + height * height) / 12.0,
            Form::Circle(radius) => 0.5 * mass * radius * radius,
        }
    }

    /// Returns the distance in px from the centre of mass to the farthest point of the shape.
    pub fn reach(self) -> f32 {
        match self {
            Form::None => POINT_REACH,
            Form::Rectangle([width, height]) => 0.5 * width.hypot(height),
            Form::Circle(radius) => radius,
        }
    }
}

/// A static or dynamic body of a joint scene: state at the start, mass and shape.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyDef {
    /// Position of the centre of mass at the start, in px.
    pub position: [f32; 2],
    /// Angle at the start in rad, clockwise on the screen.
    pub angle: f32,
    /// Velocity of the centre of mass at the start, in px/s.
    pub velocity: [f32; 2],
    /// Angular velocity at the start in rad/s, clockwise on the screen.
    pub angular_velocity: f32,
    /// Mass in kg, > 0.
    pub mass: f32,
    /// Moment of inertia about the centre of mass in kg px², > 0.
    pub inertia: f32,
    /// Shape of the body.
    pub form: Form,
    /// Whether the body is static.
    pub is_static: bool,
    /// Collision group number: bodies of one group do not collide; 0 is no group.
    pub group: i32,
    /// Coefficient of friction, >= 0.
    pub friction: f32,
}

impl BodyDef {
    /// Returns the state of the body at the start.
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

/// A joint or spring between two bodies. The two bodies may collide with each other.
#[derive(Debug, Clone, PartialEq)]
pub struct JointDef {
    /// Index of the first body into `Assembly::bodies`.
    pub body1: usize,
    /// Index of the second body into `Assembly::bodies`.
    pub body2: usize,
    /// Kind of the joint with its dimensions.
    pub kind: JointKind,
}

/// Kind and dimensions of a joint. Anchors are world positions at the start, in px.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum JointKind {
    /// A revolute joint: the bodies share a point and rotate about it.
    Hinge {
        /// World position at the start, in px, of the point that both bodies share.
        anchor: [f32; 2],
        /// Least and greatest angle in rad of the second body relative to the first; 0 at the start.
        limits: Option<[f32; 2]>,
        /// Angular velocity in rad/s of the second body relative to the first that the motor seeks, and its greatest torque
        /// in kg px²/s².
        motor: Option<[f32; 2]>,
    },
    /// A weld joint: the bodies share a point and keep their relative angle.
    Weld {
        /// World position at the start, in px, of the point that both bodies share.
        anchor: [f32; 2],
    },
    /// A prismatic joint: the second body moves along a line that is fixed in the first, and does not rotate relative to it.
    Slider {
        /// World position at the start, in px, of a point of that line.
        anchor: [f32; 2],
        /// Direction of that line at the start: a unit vector in the world, dimensionless.
        axis: [f32; 2],
    },
    /// A distance joint between the two centres of mass.
    Rod {
        /// Distance in px that the joint keeps, > 0.
        length: f32,
    },
    /// A spring from a point of the first body to the centre of mass of the second.
    Spring {
        /// Point at which the spring holds the first body, in local coordinates of that body, in px.
        arm: [f32; 2],
        /// Rest length of the spring in px: its length at the start.
        length: f32,
        /// Stiffness of the spring in kg/s², > 0.
        stiffness: f32,
        /// Damping of the spring in kg/s, >= 0.
        damping: f32,
    },
}

/// A joint scene: bodies, joints and springs under gravity. All restitutions are 0.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Assembly {
    /// Gravity in px/s², downwards.
    pub gravity: f32,
    /// Coefficient of friction of bodies that are added later.
    pub friction: f32,
    /// Bodies in the order of creation.
    pub bodies: Vec<BodyDef>,
    /// Joints and springs in the order of creation.
    pub joints: Vec<JointDef>,
}

impl Assembly {
    /// Creates an empty scene; `gravity` in px/s², downwards; `friction` is the coefficient of all bodies that are added.
    pub fn new(gravity: f32, friction: f32) -> Self {
        Assembly { gravity, friction, ..Assembly::default() }
    }

    /// Creates a scene with a static floor whose surface is y = 0; `gravity` in px/s², `friction` as a coefficient.
    pub fn with_floor(gravity: f32, friction: f32) -> Self {
        let mut assembly = Assembly::new(gravity, friction);
        assembly.wall([0.0, FLOOR[1] / 2.0], FLOOR);
        assembly
    }

    /// Adds a dynamic body and returns its index. `position` in px, `mass` in kg; bodies of one `group` do not collide, 0 is
    /// no group.
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

    /// Adds a dynamic rectangle and returns its index. `position` of the centre and `size` in px, `mass` in kg.
    pub fn rectangle(&mut self, position: [f32; 2], size: [f32; 2], mass: f32, group: i32) -> usize {
        self.body(position, Form::Rectangle(size), mass, group)
    }

    /// Adds a dynamic circle and returns its index. `position` of the centre and `radius` in px, `mass` in kg.
    pub fn circle(&mut self, position: [f32; 2], radius: f32, mass: f32, group: i32) -> usize {
        self.body(position, Form::Circle(radius), mass, group)
    }

    /// Adds a static rectangle and returns its index. `position` of the centre and `size` in px.
    pub fn wall(&mut self, position: [f32; 2], size: [f32; 2]) -> usize {
        let wall = self.rectangle(position, size, 1.0, 0);
        self.bodies[wall].is_static = true;
        wall
    }

    /// Adds a static body without a shape and returns its index. `position` in px.
    pub fn post(&mut self, position: [f32; 2]) -> usize {
        let post = self.body(position, Form::None, 1.0, 0);
        self.bodies[post].is_static = true;
        post
    }

    /// Adds a joint or spring between two bodies, given by index.
    pub fn joint(&mut self, body1: usize, body2: usize, kind: JointKind) {
        self.joints.push(JointDef { body1, body2, kind });
    }

    /// Adds a hinge without limits and motor; `anchor` is a world position in px.
    pub fn hinge(&mut self, body1: usize, body2: usize, anchor: [f32; 2]) {
        self.joint(body1, body2, JointKind::Hinge { anchor, limits: None, motor: None });
    }

    /// Adds a weld; `anchor` is a world position in px.
    pub fn weld(&mut self, body1: usize, body2: usize, anchor: [f32; 2]) {
        self.joint(body1, body2, JointKind::Weld { anchor });
    }

    /// Adds a slider; `anchor` is a world position in px, `axis` a unit vector in the world.
    pub fn slider(&mut self, body1: usize, body2: usize, anchor: [f32; 2], axis: [f32; 2]) {
        self.joint(body1, body2, JointKind::Slider { anchor, axis });
    }

    /// Adds a rod whose length is the present distance of the two centres of mass.
    pub fn rod(&mut self, body1: usize, body2: usize) {
        let length = self.distance(body1, [0.0; 2], body2);
        self.joint(body1, body2, JointKind::Rod { length });
    }

    /// Adds a spring whose rest length is its present length. `arm` is the point on the first body in px (local
    /// coordinates), `stiffness` in kg/s², `damping` in kg/s.
    pub fn spring(&mut self, body1: usize, arm: [f32; 2], body2: usize, stiffness: f32, damping: f32) {
        let length = self.distance(body1, arm, body2);
        self.joint(body1, body2, JointKind::Spring { arm, length, stiffness, damping });
    }

    /// Returns the distance in px from the point `arm` of the first body (local coordinates, px) to the centre of the second
    /// body.
    fn distance(&self, body1: usize, arm: [f32; 2], body2: usize) -> f32 {
        let ends = [
            self.bodies[body1].state().to_world(arm.map(f64::from)),
            self.bodies[body2].state().position_in_plane(),
        ];
        crate::world::distance(ends[0], ends[1]) as f32
    }

    /// Returns whether a motor of a joint adds energy.
    pub fn is_driven(&self) -> bool {
        self.joints.iter().any(|joint| matches!(joint.kind, JointKind::Hinge { motor: Some(_), .. }))
    }
}
