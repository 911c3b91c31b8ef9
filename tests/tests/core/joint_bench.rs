//! Joints on a bench: iterations one by one, as the behaviour chapter drives the original's.

use conformance::units::{assert_bits, assert_words, floats};
use farseer_core::math::Vector2;
use farseer_core::{Body, BodyId, Context, EventHandler, Joint, JointId, PhysicsSimulator, SpringId};

/// Counts callbacks of joints and springs.
#[derive(Debug, Default)]
pub(crate) struct Log {
    pub(crate) updated: usize,
    pub(crate) broke: usize,
}

impl EventHandler for Log {
    fn on_joint_broke(&mut self, _: &mut Context<'_>, _: JointId) {
        self.broke += 1;
    }

    fn handles_joint_updates(&self) -> bool {
        true
    }

    fn on_joint_updated(&mut self, _: &mut Context<'_>, _: JointId) {
        self.updated += 1;
    }

    fn on_spring_broke(&mut self, _: &mut Context<'_>, _: SpringId) {
        self.broke += 1;
    }

    fn handles_spring_updates(&self) -> bool {
        true
    }

    fn on_spring_updated(&mut self, _: &mut Context<'_>, _: SpringId) {
        self.updated += 1;
    }
}

pub(crate) fn add_body(
    simulator: &mut PhysicsSimulator,
    (mass, moment_of_inertia): (f32, f32),
    position: Vector2,
    rotation: f32,
) -> BodyId {
    let mut body = Body::new();
    body.set_mass(mass).unwrap();
    body.set_moment_of_inertia(moment_of_inertia).unwrap();
    body.set_position(position);
    body.set_rotation(rotation);
    let body = simulator.create_body(body);
    simulator.add(body).unwrap();
    body
}

/// A joint and its bodies, without gravity, for single iterations.
pub(crate) struct Bench {
    pub(crate) simulator: PhysicsSimulator,
    pub(crate) bodies: Vec<BodyId>,
    pub(crate) joint: JointId,
    pub(crate) log: Log,
    is_in_step: bool,
}

impl Bench {
    pub(crate) fn new(make: impl FnOnce(&mut PhysicsSimulator) -> (Vec<BodyId>, JointId)) -> Self {
        let mut simulator = PhysicsSimulator::new(Vector2::zeros()).unwrap();
        let (bodies, joint) = make(&mut simulator);
        assert!(simulator.process_queues(1.0 / 60.0, None));
        Bench { simulator, bodies, joint, log: Log::default(), is_in_step: false }
    }

    pub(crate) fn common(&mut self) -> &mut Joint {
        &mut self.simulator[self.joint]
    }

    pub(crate) fn body(&mut self, body: usize) -> &mut Body {
        &mut self.simulator[self.bodies[body]]
    }

    /// PreStep at 60 steps per second.
    pub(crate) fn pre_step(&mut self) {
        self.end_step();
        self.simulator.pre_step(60.0);
        self.is_in_step = true;
    }

    /// Update.
    pub(crate) fn update(&mut self) {
        self.simulator.solve_iteration(Some(&mut self.log));
    }

    /// Gives the bodies their velocities; in no time they do not move.
    pub(crate) fn end_step(&mut self) {
        if std::mem::take(&mut self.is_in_step) {
            self.simulator.integrate(0.0, None);
        }
    }

    pub(crate) fn set_velocity(&mut self, body: usize, [x, y, w]: [f32; 3]) {
        let id = self.bodies[body];
        if self.is_in_step {
            let place = self.simulator.solver_place(id).unwrap();
            let state = self.simulator.solver_body(place);
            let velocity = [x, y, w];
            assert!(self.simulator.set_solver_body(place, farseer_core::SolverBody { velocity, ..state }));
        } else {
            self.simulator[id].set_linear_velocity(Vector2::new(x, y));
            self.simulator[id].set_angular_velocity(w);
        }
    }

    /// Velocity x, y and angular velocity.
    pub(crate) fn velocity(&mut self, body: usize) -> [f32; 3] {
        let id = self.bodies[body];
        if self.is_in_step {
            let place = self.simulator.solver_place(id).unwrap();
            return self.simulator.solver_body(place).velocity;
        }
        let body = &self.simulator[id];
        [body.linear_velocity().x, body.linear_velocity().y, body.angular_velocity()]
    }

    #[track_caller]
    pub(crate) fn expect_velocity(&mut self, body: usize, expected: &str) {
        let actual = self.velocity(body);
        assert_bits(&actual, &floats(expected), || format!("velocity of body {body}"));
    }

    /// Angular velocities of all bodies.
    #[track_caller]
    pub(crate) fn expect_spins(&mut self, expected: &str) {
        let actual: Vec<f32> = (0..self.bodies.len()).map(|body| self.velocity(body)[2]).collect();
        assert_bits(&actual, &floats(expected), || "angular velocities".to_owned());
    }

    #[track_caller]
    pub(crate) fn expect_error(&self, expected: &str) {
        assert_words(&self.simulator[self.joint].joint_error(), expected);
    }

    #[track_caller]
    pub(crate) fn expect_current_anchor(&self, expected: &str) {
        assert_words(&self.simulator.joint_current_anchor(self.joint).unwrap(), expected);
    }
}
