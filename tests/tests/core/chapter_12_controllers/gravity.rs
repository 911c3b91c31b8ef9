//! Bodies and points that attract.

use super::{DT, add_controller};
use conformance::fixtures::plane::{both_sets, simulator, simulator_with, v};
use conformance::units::{assert_bits, assert_words, floats};
use farseer_core::math::Vector2;
use farseer_core::{
    Body, BodyId, Controller, ControllerId, Event, GravityController, GravityType, Methods, PhysicsSimulator,
};

/// Three bodies and a gravity controller. The update itself clears forces, so that another controller reads them.
struct Attraction {
    simulator: PhysicsSimulator,
    bodies: [BodyId; 3],
    controller: ControllerId,
}

impl Attraction {
    /// The one of check 10.
    fn new(methods: Methods) -> Self {
        let mut simulator = simulator_with(0.0, methods);
        let mut add = |mass: f32, position: Vector2| {
            let body = simulator.create_body(Body::new());
            simulator.add(body).unwrap();
            simulator[body].set_mass(mass).unwrap();
            simulator[body].set_position(position);
            simulator[body].set_linear_drag_coefficient(0.0);
            body
        };
        let bodies = [add(2.0, v(0.0, 0.0)), add(5.0, v(3.0, 4.0)), add(1.0, v(-2.0, 1.0))];
        simulator[bodies[2]].set_is_static(true);
        let points = vec![v(1.0, -1.0), v(40.0, 0.0)];
        let gravity = GravityController::new(vec![bodies[1], bodies[2]], points, 10.0, 6.0).unwrap();
        let controller = add_controller(&mut simulator, gravity);
        Attraction { simulator, bodies, controller }
    }

    fn set_squared(&mut self) {
        let gravity: &mut GravityController = self.simulator.controller_as_mut(self.controller).unwrap();
        gravity.set_gravity_type(GravityType::DistanceSquared);
    }

    /// The forces of the controller, read by a user-defined controller after it.
    fn forces(&mut self) -> [Vector2; 3] {
        let looks = add_controller(&mut self.simulator, Controller::user_defined());
        let mut handler = Looks { controller: looks, look: Look { bodies: self.bodies, forces: None } };
        self.simulator.update_with(DT, &mut handler);
        handler.look.forces.expect("the controller was not called")
    }
}

struct Looks {
    controller: ControllerId,
    look: Look,
}

struct Look {
    bodies: [BodyId; 3],
    forces: Option<[Vector2; 3]>,
}

impl farseer_core::UserController for Look {
    fn update(&mut self, context: &mut farseer_core::Context<'_>, _: ControllerId, _: f32, _: f32) {
        self.forces = Some(self.bodies.map(|body| context.body(body).unwrap().force()));
    }
}

impl farseer_core::EventHandler for Looks {
    fn user_controller(&mut self, controller: ControllerId) -> Option<&mut dyn farseer_core::UserController> {
        (controller == self.controller).then_some(&mut self.look as &mut dyn farseer_core::UserController)
    }
}

#[test]
fn check_10_linear_attraction_has_the_recorded_forces() {
    for methods in both_sets() {
        let [a, b, c] = Attraction::new(methods).forces();
        assert_words(&a, "408ccccd c0333334");
        assert_words(&b, "c12cd1ca c15084ef");
        assert_words(&c, "4071cf5a bf27f6b8");
    }
}

#[test]
fn check_10_squared_attraction_has_the_recorded_forces() {
    for methods in both_sets() {
        let mut attraction = Attraction::new(methods);
        attraction.set_squared();
        let [a, b, c] = attraction.forces();
        assert_words(&a, "407e4b87 c0948d05");
        assert_words(&b, "bff35f5f c016e031");
        assert_words(&c, "3f646a02 be8cfd50");
    }
}

#[test]
fn check_10_bodies_without_gravity_and_disabled_ones_are_left_out() {
    for methods in both_sets() {
        let mut attraction = Attraction::new(methods);
        attraction.set_squared();
        let [a, b, _] = attraction.bodies;
        attraction.simulator[a].set_ignore_gravity(true);
        attraction.simulator[b].set_enabled(false);
        let [a, b, c] = attraction.forces();
        assert_eq!((a, b), (v(0.0, 0.0), v(0.0, 0.0)));
        assert_words(&c, "3f23d994 beda776f");
    }
}

#[test]
fn check_10_a_body_at_a_source_gets_no_force_from_it_which_is_reported() {
    for methods in both_sets() {
        let mut attraction = Attraction::new(methods);
        let [a, ..] = attraction.bodies;
        attraction.simulator[a].set_position(v(1.0, -1.0));
        let [force, ..] = attraction.forces();
        // The rest comes from b at (2, 5) from there, beyond half the radius, and from c at (-3, 2).
        let pull = |x: f32, y: f32| v(x, y) * (10.0 / (x * x + y * y)) * 2.0;
        let expected = pull(2.0, 5.0) + pull(-3.0, 2.0);
        approx::assert_relative_eq!(force.x, expected.x, max_relative = 1e-5);
        approx::assert_relative_eq!(force.y, expected.y, max_relative = 1e-5);
        let report = Event::ControllerNotFinite { controller: attraction.controller };
        assert!(attraction.simulator.events().contains(&report));
    }
}

/// The force of one update on a static body at (3, 4), which keeps it.
fn force_on_static(make: impl FnOnce(&mut PhysicsSimulator, BodyId) -> GravityController) -> Vector2 {
    let mut simulator = simulator(0.0);
    let body = simulator.create_body(Body::new());
    simulator.add(body).unwrap();
    simulator[body].set_is_static(true);
    simulator[body].set_position(v(3.0, 4.0));
    let gravity = make(&mut simulator, body);
    add_controller(&mut simulator, gravity);
    simulator.update(DT);
    simulator[body].force()
}

#[test]
fn check_10_a_point_exactly_at_the_radius_attracts_a_static_body() {
    let force =
        force_on_static(|_, _| GravityController::with_points(vec![v(13.0, 4.0)], 5.0, 10.0).unwrap());
    assert_eq!(force, v(0.5, 0.0));
}

#[test]
fn check_10_static_bodies_do_not_attract_each_other() {
    let force = force_on_static(|simulator, _| {
        let other = simulator.create_body(Body::new());
        simulator[other].set_is_static(true);
        GravityController::with_bodies(vec![other], 5.0, 10.0).unwrap()
    });
    assert_eq!(force, v(0.0, 0.0));
}

#[test]
fn check_11_two_bodies_and_a_point_move_as_recorded() {
    let mut simulator = simulator(0.0);
    let mut add = |mass: f32, inertia: f32, position: Vector2| {
        let body = simulator.create_body(Body::new());
        simulator.add(body).unwrap();
        simulator[body].set_mass(mass).unwrap();
        simulator[body].set_moment_of_inertia(inertia).unwrap();
        simulator[body].set_position(position);
        body
    };
    let (a, b) = (add(2.0, 3.0, v(0.0, 0.0)), add(50.0, 7.0, v(30.0, 40.0)));
    simulator[a].set_linear_velocity(v(3.0, -1.0));
    let gravity = GravityController::new(vec![b], vec![v(-10.0, 5.0)], 200.0, 100.0).unwrap();
    add_controller(&mut simulator, gravity);
    let table = [
        (1, a, "3d3d5314 bc5e178a 40317de2 bf503611"),
        (1, b, "41effe64 421fff4c bd415250 bd292807"),
        (60, a, "c08f5ae7 408dddbd c160d27f 41152be5"),
        (60, b, "41e469e3 421aee56 c0376e01 c0208040"),
        (600, a, "c26b7644 c1533d65 c0c22ae2 40841713"),
        (600, b, "c35813a4 c32f5186 c217e4d0 c204e83d"),
    ];
    for step in 1..=600 {
        simulator.update(DT);
        for (_, body, words) in table.iter().filter(|row| row.0 == step) {
            let (p, u) = (simulator[*body].position(), simulator[*body].linear_velocity());
            assert_bits(&[p.x, p.y, u.x, u.y], &floats(words), || format!("step {step}"));
        }
    }
}
