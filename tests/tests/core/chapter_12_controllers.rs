//! Checks of behaviour chapter 12: controllers.

use conformance::fixtures::plane::{simulator, v};
use conformance::units::{assert_bits, assert_words, floats};
use farseer_core::math::Vector2;
use farseer_core::{
    Aabb, AabbFluidContainer, Body, BodyId, Controller, ControllerId, Error, Event, FluidContainer,
    FluidContainerRef, FluidDragController, GeomId, GeomPlacement, GravityController, GravityType,
    InactivityController, PhysicsSimulator, ScalingController, Vertices, WaveController,
};

const DT: f32 = 1.0 / 60.0;

const OCTAGON: [(f32, f32); 8] = [
    (1.25, 0.0),
    (0.75, 0.75),
    (0.0, 1.25),
    (-0.75, 0.75),
    (-1.25, 0.0),
    (-0.75, -0.75),
    (0.0, -1.25),
    (0.75, -0.75),
];

fn bits(hex: u32) -> f32 {
    f32::from_bits(hex)
}

fn octagon() -> Vertices {
    OCTAGON.iter().map(|&(x, y)| v(x, y)).collect()
}

fn pool() -> FluidContainerRef {
    FluidContainerRef::Aabb(AabbFluidContainer::new(Aabb::new(v(-10.0, 0.0), v(10.0, 20.0))).unwrap())
}

fn add_controller(simulator: &mut PhysicsSimulator, controller: impl Into<Controller>) -> ControllerId {
    let controller = simulator.create_controller(controller).unwrap();
    simulator.add(controller).unwrap();
    controller
}

/// A fluid that carries one geom, of a body that is not in the simulation: forces stay in its accumulators.
struct Basin {
    simulator: PhysicsSimulator,
    body: BodyId,
    geom: GeomId,
    drag: ControllerId,
}

impl Basin {
    fn new(outline: Vertices) -> Self {
        let mut simulator = simulator(0.0);
        let body = simulator.create_body(Body::new());
        let geom = simulator.create_geom(body, outline, GeomPlacement::with_grid_size(0.5)).unwrap();
        let mut drag = FluidDragController::new(pool(), 0.8, 1.1, 0.5, v(0.0, 10.0)).unwrap();
        drag.add_geom(geom).unwrap();
        let drag = add_controller(&mut simulator, drag);
        Basin { simulator, body, geom, drag }
    }

    /// The one of check 2.
    fn with_octagon() -> Self {
        let mut basin = Basin::new(octagon());
        let body = basin.body();
        body.set_mass(3.0).unwrap();
        body.set_moment_of_inertia(2.0).unwrap();
        body.set_position(v(0.25, -0.5));
        body.set_rotation(0.2);
        body.set_linear_velocity(v(-1.25, 3.0));
        body.set_angular_velocity(-2.0);
        basin
    }

    fn body(&mut self) -> &mut Body {
        &mut self.simulator[self.body]
    }

    /// Force and torque of one update, with the body at this height, and the numbers of vertices of entries.
    fn update_at(&mut self, y: f32) -> ([f32; 3], Vec<u32>) {
        let body = self.body();
        let x = body.position().x;
        body.clear_force();
        body.clear_torque();
        body.set_position(v(x, y));
        self.simulator.update(DT);
        let body = &self.simulator[self.body];
        let entry = |event: &Event| match *event {
            Event::FluidEntry { controller, geom, vertices } => {
                assert_eq!((controller, geom), (self.drag, self.geom));
                Some(vertices)
            }
            _ => None,
        };
        let entries = self.simulator.events().iter().filter_map(entry).collect();
        ([body.force().x, body.force().y, body.torque()], entries)
    }

    fn drag(&mut self) -> &mut FluidDragController {
        self.simulator.controller_as_mut(self.drag).unwrap()
    }
}

#[track_caller]
fn assert_load(actual: [f32; 3], expected: &str) {
    assert_bits(&actual, &floats(expected), || "force and torque".to_owned());
}

const HALF_IN: &str = "bdcf6c91 c067e1be 3f868122";
const NOTHING: &str = "00000000 00000000 00000000";

#[test]
fn check_1_a_box_of_fluid_keeps_a_margin_inside_but_touches() {
    let mut container = AabbFluidContainer::new(Aabb::new(v(0.0, 0.0), v(10.0, 5.0))).unwrap();
    assert!(!container.contains(v(0.0, 1.0)));
    assert!(!container.contains(v(bits(0x3727_c5ac), 1.0)));
    assert!(container.contains(v(bits(0x3729_732b), 1.0)));
    assert!(!container.contains(v(bits(0x411f_fff6), 1.0)));
    assert!(container.contains(v(bits(0x411f_ff97), 1.0)));
    assert!(container.intersect(&Aabb::new(v(10.0, 5.0), v(11.0, 6.0))));
}

#[test]
fn check_2_the_octagon_lies_where_the_original_has_it() {
    let mut basin = Basin::with_octagon();
    basin.simulator.update(DT);
    let geom = basin.simulator.geom(basin.geom).unwrap();
    assert_words(&geom.world_vertices()[0], "3f91289e bf8b039e");
    assert_words(&geom.world_vertices()[7], "3fbccf87 be80da04");
}

#[test]
fn check_2_entry_is_told_once_while_the_force_is_the_same_every_time() {
    let mut basin = Basin::with_octagon();
    let (load, entries) = basin.update_at(-0.5);
    assert_load(load, HALF_IN);
    assert_eq!(entries, [3]);
    let (load, entries) = basin.update_at(-0.5);
    assert_load(load, HALF_IN);
    assert!(entries.is_empty());
}

#[test]
fn check_2_a_geom_that_leaves_the_box_in_one_step_does_not_enter_again() {
    let mut basin = Basin::with_octagon();
    basin.update_at(-0.5);
    let (load, _) = basin.update_at(-5.0);
    assert_load(load, NOTHING);
    assert!(basin.update_at(-0.5).1.is_empty());
}

#[test]
fn check_2_a_geom_that_only_touches_the_box_in_between_enters_again() {
    let mut basin = Basin::with_octagon();
    basin.update_at(-0.5);
    let (load, _) = basin.update_at(-1.2);
    assert_load(load, NOTHING);
    assert_eq!(basin.update_at(-0.5).1, [3]);
}

#[test]
fn check_2_after_a_reset_entry_is_told_again() {
    let mut basin = Basin::with_octagon();
    basin.update_at(-0.5);
    basin.drag().reset();
    assert_eq!(basin.update_at(-0.5).1, [3]);
}

#[test]
fn check_2_under_water_the_loads_are_the_recorded_ones() {
    let mut basin = Basin::with_octagon();
    assert_load(basin.update_at(10.0).0, "40818122 c21ed9e5 4040002e");
    basin.body().set_linear_velocity(v(0.0, 0.0));
    basin.body().set_angular_velocity(0.0);
    assert_load(basin.update_at(10.0).0, "00000000 c1f00008 b6960005");
}

#[test]
fn check_2_a_drag_that_would_be_nan_is_not_applied_and_reported() {
    let mut basin = Basin::with_octagon();
    basin.body().set_linear_velocity(v(1e-30, 0.0));
    basin.body().set_angular_velocity(0.0);
    assert_load(basin.update_at(10.0).0, NOTHING);
    let report = Event::ControllerNotFinite { controller: basin.drag };
    assert!(basin.simulator.events().contains(&report));
}

#[test]
fn check_3_a_box_with_two_corners_in_the_water_feels_nothing() {
    let outline = [v(-1.0, -1.0), v(-1.0, 1.0), v(1.0, 1.0), v(1.0, -1.0)];
    let mut basin = Basin::new(Vertices::from(&outline[..]));
    let (load, entries) = basin.update_at(0.0);
    assert_load(load, NOTHING);
    assert!(entries.is_empty());
}

#[test]
fn check_4_a_geom_added_twice_is_refused_and_carried_once() {
    let mut basin = Basin::with_octagon();
    let geom = basin.geom;
    assert!(matches!(basin.drag().add_geom(geom), Err(Error::InvalidArgument { argument: "geom", .. })));
    assert_load(basin.update_at(-0.5).0, HALF_IN);
    basin.drag().remove_geom(geom);
    assert_load(basin.update_at(-0.5).0, NOTHING);
}

#[test]
fn check_5_three_of_32_vertices_enter_in_every_update() {
    let mut basin = Basin::new(Vertices::create_circle(2.0, 32).unwrap());
    for _ in 0..3 {
        assert_eq!(basin.update_at(-1.9).1, [3]);
    }
}

#[track_caller]
fn assert_motion(body: &Body, step: u32, expected: &str) {
    let (position, velocity) = (body.position(), body.linear_velocity());
    let actual = [position.x, position.y, body.rotation(), velocity.x, velocity.y, body.angular_velocity()];
    assert_bits(&actual, &floats(expected), || format!("step {step}"));
}

/// Steps a simulator, and compares a body with a table of steps and words.
fn follow(simulator: &mut PhysicsSimulator, body: BodyId, table: &[(u32, &str)]) {
    let last = table.last().unwrap().0;
    for step in 1..=last {
        simulator.update(DT);
        if let Some((_, words)) = table.iter().find(|row| row.0 == step) {
            assert_motion(&simulator[body], step, words);
        }
    }
}

/// The octagon of check 6, in the simulation without its geom, and a fluid that carries it.
fn floating(
    container: impl FnOnce(&mut PhysicsSimulator) -> FluidContainerRef,
) -> (PhysicsSimulator, BodyId) {
    let mut simulator = simulator(10.0);
    let container = container(&mut simulator);
    let body = simulator.create_body(Body::new());
    simulator.add(body).unwrap();
    simulator[body].set_mass(2.0).unwrap();
    simulator[body].set_moment_of_inertia(3.0).unwrap();
    simulator[body].set_position(v(1.0, -3.0));
    simulator[body].set_rotation(0.1);
    let geom = simulator.create_geom(body, octagon(), GeomPlacement::with_grid_size(0.5)).unwrap();
    let mut drag = FluidDragController::new(container, 0.8, 1.1, 0.5, v(0.0, 10.0)).unwrap();
    drag.add_geom(geom).unwrap();
    add_controller(&mut simulator, drag);
    (simulator, body)
}

#[test]
fn check_6_the_floating_octagon_moves_as_recorded() {
    let (mut simulator, body) = floating(|_| pool());
    let table = [
        (1, "3f800000 c03fd27d 3dcccccd 00000000 3e2aaaab 00000000"),
        (60, "3f800032 3fd428f8 3dcf7700 3840d7fa 40c3729c 3c13d93a"),
        (120, "3f800119 405f821d 3ddf216e 377f9f2e bf83f8b6 3bd3ad26"),
        (600, "3f98b0dd 3f5ab15f 3f4c1a4f 3c4e7b0a bf182d96 be30480e"),
    ];
    follow(&mut simulator, body, &table);
}

/// The wave of check 7 after its two disturbances.
fn wave_of_check_7() -> WaveController {
    let mut wave = WaveController::new(v(-3.0, 2.0), 10.0, 4.0, 6).unwrap();
    wave.disturb(1.0, 0.5).unwrap();
    wave.disturb(3.0, -0.25).unwrap();
    wave.set_wave_generator_max(0.3).unwrap();
    wave.set_wave_generator_min(-0.3).unwrap();
    wave.set_wave_generator_step(0.2).unwrap();
    wave
}

/// A box that reaches down to `bottom`.
fn above(bottom: f32) -> Aabb {
    Aabb::new(v(0.0, -5.0), v(1.0, bottom))
}

#[test]
fn check_7_nodes_are_spread_evenly() {
    assert_eq!(wave_of_check_7().x_position(), [-3.0, -1.0, 1.0, 3.0, 5.0, 7.0]);
}

#[test]
fn check_7_a_disturbance_on_an_inner_node_moves_both_segments() {
    let mut wave = WaveController::new(v(-3.0, 2.0), 10.0, 4.0, 6).unwrap();
    wave.disturb(1.0, 0.5).unwrap();
    assert_eq!(wave.current_wave(), [0.0, 0.5, 0.5, 0.0, 0.0, 0.0]);
    wave.disturb(3.0, -0.25).unwrap();
    assert_eq!(wave.current_wave(), [0.0, 0.5, 0.25, -0.25, 0.0, 0.0]);
}

#[test]
fn check_7_wave_steps_come_on_every_third_call_with_the_recorded_offsets() {
    let table = [
        (3, "3e733333 3e733333 3e733333 be733333 3e4ccccd"),
        (6, "be7f5c28 3e5ae147 3e733333 3ed4cccd 3ecccccd"),
        (9, "bcb8d501 be72978c 3ebe9ba5 3f54cccd 3ecccccd"),
        (12, "3c4212dd 3e044538 3ead919d 3ead7a43 3e4ccccd"),
        (15, "3e139b0d 3f0ef10a 3dba37dc be8e264e 00000000"),
        (18, "3f04e9e9 3dce0b59 bd62bf95 be71275d be4ccccd"),
        (24, "bf141bb2 bead66b5 bc4eb800 beb85bfe becccccd"),
        (60, "be4605fd bf5ad25a bf9e0167 befbb827 00000000"),
    ];
    let mut wave = wave_of_check_7();
    for call in 1..=60 {
        let before = wave.current_wave().to_vec();
        wave.update(0.1).unwrap();
        assert_eq!(wave.current_wave() != before, call % 3 == 0, "call {call}");
        if let Some((_, words)) = table.iter().find(|row| row.0 == call) {
            assert_bits(&wave.current_wave()[1..], &floats(words), || format!("call {call}"));
        }
    }
}

#[test]
fn check_7_the_box_follows_the_highest_inner_node_from_the_first_wave_step_on() {
    let mut wave = wave_of_check_7();
    assert!(wave.intersect(&above(2.0)));
    assert!(!wave.intersect(&above(bits(0x3fff_ffff))));
    for _ in 0..3 {
        wave.update(0.1).unwrap();
    }
    assert!(wave.intersect(&above(bits(0x3fe1_999a))));
    assert!(!wave.intersect(&above(bits(0x3fe1_9999))));
}

#[test]
fn check_7_points_are_compared_with_the_extended_surface() {
    let mut wave = wave_of_check_7();
    for _ in 0..3 {
        wave.update(0.1).unwrap();
    }
    for (x, y, expected) in [
        (0.0, bits(0x400f_3333), true),
        (0.0, 2.2, false),
        (-100.0, 2.5, true),
        (100.0, 2.5, false),
        (100.0, 25.0, true),
        (3.0, 50.0, true),
    ] {
        assert_eq!(wave.contains(v(x, y)), expected, "{x} {y}");
        assert_eq!(wave.vector_point(), v(x, y));
    }
}

#[test]
fn check_7_a_place_that_does_not_fit_32_bits_is_taken_for_the_first_segment() {
    let mut wave = wave_of_check_7();
    assert!(!wave.contains(v(3e10, 1.0)));
    assert_eq!(wave.vector_near_wave_edge(), v(-3.0, 2.0));
    assert_eq!(wave.vector_far_wave_edge(), v(-1.0, 2.5));
}

#[test]
fn check_8_waves_without_a_segment_are_refused() {
    for nodes in [0, 1] {
        let wave = WaveController::new(v(0.0, 0.0), 10.0, 4.0, nodes);
        assert!(matches!(wave, Err(Error::InvalidArgument { argument: "node_count", .. })));
        let mut wave = WaveController::new(v(0.0, 0.0), 10.0, 4.0, 2).unwrap();
        assert!(wave.set_node_count(nodes).is_err());
        assert_eq!(wave.node_count(), 2);
    }
}

/// The wave and the octagon of check 9.
fn wave_and_octagon() -> (PhysicsSimulator, BodyId, ControllerId) {
    let mut made = None;
    let (simulator, body) = floating(|simulator| {
        let mut wave = WaveController::new(v(-8.0, 0.0), 16.0, 20.0, 9).unwrap();
        wave.set_wave_generator_max(0.6).unwrap();
        wave.set_wave_generator_min(-0.6).unwrap();
        wave.set_wave_generator_step(0.15).unwrap();
        wave.set_frequency(0.05).unwrap();
        wave.set_damping_coefficient(0.97).unwrap();
        let wave = add_controller(simulator, wave);
        made = Some(wave);
        FluidContainerRef::Wave(wave)
    });
    (simulator, body, made.unwrap())
}

#[test]
fn check_9_the_octagon_on_waves_moves_as_recorded() {
    let (mut simulator, body, _) = wave_and_octagon();
    let table = [
        (60, "3f7ffea0 3fdb1612 3dca5fd4 b901fda5 40c82730 bba98be5"),
        (120, "3f7ff9c1 4068933f 3dc1644e b82c220c bf7b9926 bb72c00f"),
        (600, "3f7f8480 3f4c590a 3d897a01 3a2c5897 bf3fe131 3d24c930"),
    ];
    follow(&mut simulator, body, &table);
}

#[test]
fn check_9_the_surface_moves_as_recorded() {
    let (mut simulator, _, wave) = wave_and_octagon();
    let table = [
        (60, "be8d935e bed4c6f4 bee1b066 bee676d8 beef9822 beed0614 bef29d6a bf19999a"),
        (600, "be42a710 be9655ff bed397e1 bf0fc4d3 bf1d605a bf2c93ea bf328251 bf19999a"),
    ];
    for step in 1..=600 {
        simulator.update(DT);
        if let Some((_, words)) = table.iter().find(|row| row.0 == step) {
            let offsets = simulator.controller_as::<WaveController>(wave).unwrap().current_wave();
            assert_eq!(offsets[0], 0.0);
            assert_bits(&offsets[1..], &floats(words), || format!("step {step}"));
        }
    }
}

/// Three bodies and a gravity controller. The update itself uses forces up, so that another controller looks at them.
struct Attraction {
    simulator: PhysicsSimulator,
    bodies: [BodyId; 3],
    controller: ControllerId,
}

impl Attraction {
    /// The one of check 10.
    fn new() -> Self {
        let mut simulator = simulator(0.0);
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

    /// The forces of the controller, seen by a user-defined controller after it.
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
    let [a, b, c] = Attraction::new().forces();
    assert_words(&a, "408ccccd c0333334");
    assert_words(&b, "c12cd1ca c15084ef");
    assert_words(&c, "4071cf5a bf27f6b8");
}

#[test]
fn check_10_squared_attraction_has_the_recorded_forces() {
    let mut attraction = Attraction::new();
    attraction.set_squared();
    let [a, b, c] = attraction.forces();
    assert_words(&a, "407e4b87 c0948d05");
    assert_words(&b, "bff35f5f c016e031");
    assert_words(&c, "3f646a02 be8cfd50");
}

#[test]
fn check_10_bodies_without_gravity_and_disabled_ones_are_left_out() {
    let mut attraction = Attraction::new();
    attraction.set_squared();
    let [a, b, _] = attraction.bodies;
    attraction.simulator[a].set_ignore_gravity(true);
    attraction.simulator[b].set_enabled(false);
    let [a, b, c] = attraction.forces();
    assert_eq!((a, b), (v(0.0, 0.0), v(0.0, 0.0)));
    assert_words(&c, "3f23d994 beda776f");
}

#[test]
fn check_10_a_body_at_a_source_feels_nothing_of_it_which_is_reported() {
    let mut attraction = Attraction::new();
    let [a, ..] = attraction.bodies;
    attraction.simulator[a].set_position(v(1.0, -1.0));
    let [force, ..] = attraction.forces();
    // What is left comes from b at (2, 5) from there, out of half the radius, and from c at (-3, 2).
    let pull = |x: f32, y: f32| v(x, y) * (10.0 / (x * x + y * y)) * 2.0;
    let expected = pull(2.0, 5.0) + pull(-3.0, 2.0);
    approx::assert_relative_eq!(force.x, expected.x, max_relative = 1e-5);
    approx::assert_relative_eq!(force.y, expected.y, max_relative = 1e-5);
    let report = Event::ControllerNotFinite { controller: attraction.controller };
    assert!(attraction.simulator.events().contains(&report));
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

/// A simulator with an inactivity controller.
fn with_inactivity() -> (PhysicsSimulator, ControllerId) {
    let mut simulator = simulator(0.0);
    let controller = add_controller(&mut simulator, InactivityController::new());
    (simulator, controller)
}

fn add_body(simulator: &mut PhysicsSimulator, x: f32, is_auto_idle: bool) -> BodyId {
    let body = simulator.create_body(Body::new());
    simulator.add(body).unwrap();
    simulator[body].set_position(v(x, 0.0));
    simulator[body].set_is_auto_idle(is_auto_idle);
    body
}

fn bodies_enabled(simulator: &PhysicsSimulator, controller: ControllerId) -> u32 {
    simulator.controller_as::<InactivityController>(controller).unwrap().bodies_enabled()
}

#[test]
fn check_12_a_slow_body_is_disabled_after_a_second() {
    let (mut simulator, controller) = with_inactivity();
    let body = add_body(&mut simulator, 0.0, true);
    simulator[body].set_linear_velocity(v(54.0, 0.0));
    simulator[body].set_linear_drag_coefficient(0.0);
    let idle_time_and_x =
        |simulator: &PhysicsSimulator| vec![v(simulator[body].idle_time(), simulator[body].position().x)];
    for step in 1..=61 {
        simulator.update(DT);
        match step {
            1 => assert_words(&idle_time_and_x(&simulator), "41855556 3f666667"),
            59 => assert_words(&idle_time_and_x(&simulator), "4475d55d 4254666d"),
            60 => {
                assert_words(&idle_time_and_x(&simulator), "447a0008 4254666d");
                assert_eq!(simulator[body].linear_velocity(), v(54.0, 0.0));
                assert_eq!(bodies_enabled(&simulator, controller), 1);
            }
            61 => assert_eq!(bodies_enabled(&simulator, controller), 0),
            _ => {}
        }
        assert_eq!(simulator[body].enabled(), step < 60);
    }
}

#[test]
fn check_13_a_body_woken_by_one_before_it_is_looked_at_in_the_same_pass() {
    let (mut simulator, controller) = with_inactivity();
    add_body(&mut simulator, 100.0, false);
    let a = add_body(&mut simulator, 0.0, true);
    simulator[a].set_enabled(false);
    simulator.update(0.1);
    assert!(simulator[a].enabled());
    assert_eq!(simulator[a].idle_time(), 100.0);
    assert_eq!(bodies_enabled(&simulator, controller), 2);
}

#[test]
fn check_13_a_body_woken_by_one_after_it_is_not() {
    let (mut simulator, controller) = with_inactivity();
    let a = add_body(&mut simulator, 0.0, true);
    add_body(&mut simulator, 100.0, false);
    simulator[a].set_enabled(false);
    simulator.update(0.1);
    assert!(simulator[a].enabled());
    assert_eq!(simulator[a].idle_time(), 0.0);
    assert_eq!(bodies_enabled(&simulator, controller), 1);
}

#[test]
fn check_13_a_body_may_be_disabled_and_woken_in_one_pass() {
    let (mut simulator, controller) = with_inactivity();
    let a = add_body(&mut simulator, 0.0, true);
    add_body(&mut simulator, 0.0, false);
    simulator[a].set_idle_time(950.0);
    simulator.update(0.1);
    assert!(simulator[a].enabled());
    assert_eq!(simulator[a].idle_time(), 0.0);
    assert_eq!(bodies_enabled(&simulator, controller), 2);
}

fn scaling() -> ScalingController {
    ScalingController::new(0.02, 0.05).unwrap()
}

#[test]
fn check_14_time_is_collected_until_the_interval_is_full() {
    let mut scaling = scaling();
    assert_eq!(scaling.get_update_interval(0.015), 0.0);
    assert_words(&scaling.get_update_interval(0.015), "3cf5c28f");
    assert_words(&scaling.get_update_interval(0.02), "3ca3d70a");
}

#[test]
fn check_14_the_penalty_rises_and_falls_as_recorded() {
    let mut scaling = scaling();
    for word in [
        "3ccccccc", "3cf5c28f", "3d0f5c29", "3d23d70a", "3d3851eb", "3d4ccccc", "3d6147ad", "3d75c28e",
        "3d851eb8", "3d8f5c28", "3d8f5c28", "3d8f5c28",
    ] {
        scaling.increase_update_interval();
        assert_words(&scaling.update_interval(), word);
    }
    for word in ["3d8a3d70", "3d851eb7", "3d7ffffd", "3d75c28c", "3d6b851b", "3d6147aa"] {
        scaling.decrease_update_interval();
        assert_words(&scaling.update_interval(), word);
    }
    scaling.set_maximum_update_interval(0.01).unwrap();
    assert_eq!(scaling.maximum_update_interval(), 0.05);
    scaling.set_maximum_update_interval(0.03).unwrap();
    assert_eq!(scaling.maximum_update_interval(), 0.03);
    scaling.set_update_interval(0.1).unwrap();
    assert_eq!(scaling.maximum_update_interval(), 0.1);
    assert_words(&scaling.update_interval(), "3e0a3d70");
}

#[test]
fn check_14_without_collecting_time_is_handed_on() {
    let mut disabled = scaling();
    disabled.set_enabled(false);
    assert_eq!(disabled.get_update_interval(0.001), 0.001);
    let mut without_base = ScalingController::new(0.0, 0.05).unwrap();
    assert_eq!(without_base.get_update_interval(0.001), 0.001);
}

#[test]
fn check_14_updates_raise_and_lower_the_interval_as_recorded() {
    let mut simulator = simulator(0.0);
    let controller = add_controller(&mut simulator, scaling());
    for (dt_real, word) in [
        (0.2, "3ca3d70a"),
        (0.2, "3ccccccc"),
        (0.2, "3ccccccc"),
        (0.2, "3ccccccc"),
        (0.0, "3cb851eb"),
        (0.0, "3cb851eb"),
    ] {
        simulator.update_with_real_time(0.01, dt_real, None);
        let scaling: &ScalingController = simulator.controller_as(controller).unwrap();
        assert_words(&scaling.update_interval(), word);
    }
}

#[test]
fn check_15_a_disabled_controller_stays_in_the_list_and_a_disposed_one_goes() {
    let (mut simulator, controller) = with_inactivity();
    simulator[controller].set_enabled(false);
    simulator.update(DT);
    assert_eq!(simulator.controller_list(), [controller]);
    simulator.dispose(controller).unwrap();
    assert_eq!(simulator.controller_list(), [controller]);
    simulator.update(DT);
    assert!(simulator.controller_list().is_empty());
    assert!(simulator.controller(controller).is_none());
}
