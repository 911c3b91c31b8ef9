//! Two bodies and a joint or spring of each kind between them, for properties that hold for any bodies.

use farseer_core::math::Vector2;
use farseer_core::{
    AngleJoint, AngleSpring, BodyId, FixedAngleJoint, FixedAngleSpring, FixedLinearSpring, JointFactory,
    JointId, LinearSpring, ObjectId, PhysicsSimulator, PinJoint, SpringFactory, SpringId,
};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestRng, TestRunner};

use crate::joint_bench::add_body;
use conformance::fixtures::plane::{self, v};

/// Number of cases per property and kind.
const CASES: u32 = 64;
pub(crate) const DT: f32 = 1.0 / 60.0;

/// The kinds of joints and springs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Kind {
    Angle,
    AngleLimit,
    FixedAngle,
    FixedAngleLimit,
    FixedRevolute,
    Pin,
    Revolute,
    Slider,
    Weld,
    AngleSpring,
    FixedAngleSpring,
    FixedLinearSpring,
    LinearSpring,
}

impl Kind {
    pub(crate) const ALL: [Kind; 13] = [
        Kind::Angle,
        Kind::AngleLimit,
        Kind::FixedAngle,
        Kind::FixedAngleLimit,
        Kind::FixedRevolute,
        Kind::Pin,
        Kind::Revolute,
        Kind::Slider,
        Kind::Weld,
        Kind::AngleSpring,
        Kind::FixedAngleSpring,
        Kind::FixedLinearSpring,
        Kind::LinearSpring,
    ];

    /// Whether it holds the first body only.
    pub(crate) fn is_fixed(self) -> bool {
        use Kind::{FixedAngle, FixedAngleLimit, FixedAngleSpring, FixedLinearSpring, FixedRevolute};
        matches!(self, FixedAngle | FixedAngleLimit | FixedAngleSpring | FixedLinearSpring | FixedRevolute)
    }

    pub(crate) fn is_spring(self) -> bool {
        use Kind::{AngleSpring, FixedAngleSpring, FixedLinearSpring, LinearSpring};
        matches!(self, AngleSpring | FixedAngleSpring | FixedLinearSpring | LinearSpring)
    }
}

#[derive(Debug, Clone, Copy)]
pub(crate) enum Link {
    Joint(JointId),
    Spring(SpringId),
}

/// Two bodies 3 to 5 apart, and how far the link between them is from its state of rest.
#[derive(Debug, Clone)]
pub(crate) struct Setup {
    /// Mass and moment of inertia.
    pub(crate) masses: [(f32, f32); 2],
    /// Position, rotation.
    pub(crate) first: ([f32; 2], f32),
    /// Distance and direction from the first, rotation.
    pub(crate) second: (f32, f32, f32),
    /// Velocity x, y in length units/s and angular velocity in rad/s.
    pub(crate) velocities: [[f32; 3]; 2],
    /// Local, within 0.7 of the middle of the body, in length units.
    pub(crate) anchors: [[f32; 2]; 2],
    pub(crate) violation: f32,
    /// Stiffness and damping.
    pub(crate) constants: (f32, f32),
}

fn setup() -> impl Strategy<Value = Setup> {
    let mass = || (0.5..5.0_f32, 0.5..5.0_f32);
    let speeds = || [-3.0..3.0_f32, -3.0..3.0, -3.0..3.0];
    let anchor = || [-0.5..0.5_f32, -0.5..0.5];
    let first = ([-5.0..5.0_f32, -5.0..5.0], -2.0..2.0_f32);
    let second = (3.0..5.0_f32, -3.0..3.0_f32, -2.0..2.0_f32);
    let rest = ([anchor(), anchor()], 0.2..1.0_f32, (5.0..40.0_f32, 4.0..10.0_f32));
    ([mass(), mass()], first, second, [speeds(), speeds()], rest).prop_map(
        |(masses, first, second, velocities, (anchors, violation, constants))| Setup {
            masses,
            first,
            second,
            velocities,
            anchors,
            violation,
            constants,
        },
    )
}

/// Bodies without gravity and drag, at rest, and a link that is violated.
pub(crate) struct Scene {
    pub(crate) simulator: PhysicsSimulator,
    pub(crate) bodies: [BodyId; 2],
    pub(crate) link: Link,
}

impl Scene {
    pub(crate) fn new(kind: Kind, setup: &Setup) -> Self {
        let mut simulator = plane::simulator(0.0);
        let ([x, y], rotation) = setup.first;
        let (distance, direction, rotation2) = setup.second;
        let place2 = v(x + distance * direction.cos(), y + distance * direction.sin());
        let bodies = [
            add_body(&mut simulator, setup.masses[0], v(x, y), rotation),
            add_body(&mut simulator, setup.masses[1], place2, rotation2),
        ];
        for body in bodies {
            simulator[body].set_linear_drag_coefficient(0.0);
            simulator[body].set_rotational_drag_coefficient(0.0);
        }
        let link = create(kind, setup, &mut simulator, bodies);
        Scene { simulator, bodies, link }
    }

    pub(crate) fn moving(kind: Kind, setup: &Setup) -> Self {
        let mut scene = Scene::new(kind, setup);
        for (body, [x, y, w]) in scene.bodies.into_iter().zip(setup.velocities) {
            scene.simulator[body].set_linear_velocity(v(x, y));
            scene.simulator[body].set_angular_velocity(w);
        }
        scene
    }

    pub(crate) fn error(&self) -> f32 {
        match self.link {
            Link::Joint(joint) => self.simulator[joint].joint_error(),
            Link::Spring(spring) => self.simulator[spring].spring_error(),
        }
    }

    pub(crate) fn set_breakpoint(&mut self, breakpoint: f32) {
        match self.link {
            Link::Joint(joint) => self.simulator[joint].set_breakpoint(breakpoint).unwrap(),
            Link::Spring(spring) => self.simulator[spring].set_breakpoint(breakpoint).unwrap(),
        }
    }

    /// Bias factor of a joint, stiffness of a spring.
    pub(crate) fn set_strength(&mut self, strength: f32) {
        match self.link {
            Link::Joint(joint) => self.simulator[joint].set_bias_factor(strength).unwrap(),
            Link::Spring(spring) => self.simulator[spring].set_spring_constant(strength).unwrap(),
        }
    }

    pub(crate) fn set_enabled(&mut self, enabled: bool) {
        match self.link {
            Link::Joint(joint) => self.simulator[joint].set_enabled(enabled),
            Link::Spring(spring) => self.simulator[spring].set_enabled(enabled),
        }
    }

    pub(crate) fn is_enabled(&self) -> bool {
        match self.link {
            Link::Joint(joint) => self.simulator[joint].enabled(),
            Link::Spring(spring) => self.simulator[spring].enabled(),
        }
    }

    pub(crate) fn id(&self) -> ObjectId {
        match self.link {
            Link::Joint(joint) => joint.into(),
            Link::Spring(spring) => spring.into(),
        }
    }

    pub(crate) fn is_there(&self) -> bool {
        match self.link {
            Link::Joint(joint) => self.simulator.joint(joint).is_some(),
            Link::Spring(spring) => self.simulator.spring(spring).is_some(),
        }
    }

    pub(crate) fn linear_velocity_of_second(&self) -> Vector2 {
        self.simulator[self.bodies[1]].linear_velocity()
    }

    pub(crate) fn linear_momentum(&self) -> [f64; 2] {
        let momentum = |body: BodyId| {
            let body = &self.simulator[body];
            [body.linear_velocity().x, body.linear_velocity().y]
                .map(|v| f64::from(v) * f64::from(body.mass()))
        };
        let [[ax, ay], [bx, by]] = self.bodies.map(momentum);
        [ax + bx, ay + by]
    }

    /// Angular momentum about the origin.
    pub(crate) fn angular_momentum(&self) -> f64 {
        let momentum = |body: BodyId| {
            let body = &self.simulator[body];
            let [x, y, vx, vy, w] = [
                body.position().x,
                body.position().y,
                body.linear_velocity().x,
                body.linear_velocity().y,
                body.angular_velocity(),
            ]
            .map(f64::from);
            f64::from(body.mass()) * (x * vy - y * vx) + f64::from(body.moment_of_inertia()) * w
        };
        self.bodies.into_iter().map(momentum).sum()
    }

    /// Sum of the absolute momenta of the bodies: the scale of rounding errors. Arms are below 10.
    pub(crate) fn scale(&self) -> f64 {
        let size = |body: BodyId| {
            let body = &self.simulator[body];
            let speed = body.linear_velocity().norm() * body.mass();
            f64::from(speed + body.angular_velocity().abs() * body.moment_of_inertia())
        };
        self.bodies.into_iter().map(size).sum()
    }
}

fn create(kind: Kind, setup: &Setup, s: &mut PhysicsSimulator, [a, b]: [BodyId; 2]) -> Link {
    let [anchor1, anchor2] = setup.anchors.map(|[x, y]| v(x, y));
    let point = (s[a].position() + s[b].position()) * 0.5 + anchor1;
    let (stiffness, damping) = setup.constants;
    let violation = setup.violation;
    let total = [a, b].map(|body| s[body].total_rotation());
    let angle = total[1] - total[0];
    match kind {
        Kind::Angle => {
            let joint = JointFactory::create_angle_joint_in(s, a, b).unwrap();
            s.joint_as_mut::<AngleJoint>(joint).unwrap().set_target_angle(angle + violation).unwrap();
            Link::Joint(joint)
        }
        Kind::AngleLimit => {
            let (min, max) = (angle + violation, angle + violation + 1.0);
            let joint = JointFactory::create_angle_limit_joint_in(s, a, b, min, max).unwrap();
            Link::Joint(joint)
        }
        Kind::FixedAngle => {
            let joint = JointFactory::create_fixed_angle_joint_in(s, a).unwrap();
            s.joint_as_mut::<FixedAngleJoint>(joint).unwrap().set_target_angle(total[0] - violation).unwrap();
            Link::Joint(joint)
        }
        Kind::FixedAngleLimit => {
            let (min, max) = (total[0] - violation - 1.0, total[0] - violation);
            Link::Joint(JointFactory::create_fixed_angle_limit_joint_in(s, a, min, max).unwrap())
        }
        Kind::FixedRevolute => {
            let joint = JointFactory::create_fixed_revolute_joint_in(s, a, point).unwrap();
            shift(s, a, violation);
            Link::Joint(joint)
        }
        Kind::Pin => {
            let joint = JointFactory::create_pin_joint_in(s, a, anchor1, b, anchor2).unwrap();
            let pin = s.joint_as_mut::<PinJoint>(joint).unwrap();
            pin.set_target_distance(pin.target_distance() + violation).unwrap();
            Link::Joint(joint)
        }
        Kind::Revolute => {
            let joint = JointFactory::create_revolute_joint_in(s, a, b, point).unwrap();
            shift(s, b, violation);
            Link::Joint(joint)
        }
        Kind::Slider => {
            let distance = (s[a].get_world_position(anchor1) - s[b].get_world_position(anchor2)).norm();
            let (min, max) = (distance - violation - 0.5, distance - violation);
            Link::Joint(JointFactory::create_slider_joint_in(s, a, anchor1, b, anchor2, min, max).unwrap())
        }
        Kind::Weld => {
            let joint = JointFactory::create_weld_joint_in(s, a, b, point).unwrap();
            shift(s, b, violation);
            Link::Joint(joint)
        }
        Kind::AngleSpring => {
            let spring = SpringFactory::create_angle_spring_in(s, a, b, stiffness, damping).unwrap();
            s.spring_as_mut::<AngleSpring>(spring).unwrap().set_target_angle(angle + violation).unwrap();
            Link::Spring(spring)
        }
        Kind::FixedAngleSpring => {
            let spring = SpringFactory::create_fixed_angle_spring_in(s, a, stiffness, damping).unwrap();
            let target = total[0] + violation;
            s.spring_as_mut::<FixedAngleSpring>(spring).unwrap().set_target_angle(target).unwrap();
            Link::Spring(spring)
        }
        Kind::FixedLinearSpring => {
            let world = s[b].position();
            let spring =
                SpringFactory::create_fixed_linear_spring_in(s, a, anchor1, world, stiffness, damping)
                    .unwrap();
            let linear = s.spring_as_mut::<FixedLinearSpring>(spring).unwrap();
            linear.set_rest_length(linear.rest_length() + violation).unwrap();
            Link::Spring(spring)
        }
        Kind::LinearSpring => {
            let spring =
                SpringFactory::create_linear_spring_in(s, a, anchor1, b, anchor2, stiffness, damping)
                    .unwrap();
            let linear = s.spring_as_mut::<LinearSpring>(spring).unwrap();
            linear.set_rest_length(linear.rest_length() + violation).unwrap();
            Link::Spring(spring)
        }
    }
}

fn shift(simulator: &mut PhysicsSimulator, body: BodyId, way: f32) {
    let position = simulator[body].position();
    simulator[body].set_position(position + Vector2::new(0.6, -0.8) * way);
}

/// Runs a test on the same random cases every time.
pub(crate) fn check(test: impl Fn(&Setup) -> Result<(), TestCaseError>) {
    let config = Config { cases: CASES, failure_persistence: None, ..Config::default() };
    let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    TestRunner::new_with_rng(config, rng).run(&setup(), |setup| test(&setup)).unwrap();
}
