//! Properties of controllers that do not depend on bits: closed forms and invariants over random inputs, and their interplay
//! with the game.

use conformance::fixtures::plane::{add_circle, simulator, state, v};
use farseer_core::math::{Vector2, vector2};
use farseer_core::{
    Aabb, AabbFluidContainer, Body, BodyId, Context, Controller, ControllerId, Error, Event, EventHandler,
    FluidContainer, FluidContainerRef, FluidDragController, GeomId, GeomPlacement, GravityController,
    GravityType, InactivityController, PhysicsSimulator, ScalingController, UserController, Vertices,
    WaveController,
};
use proptest::prelude::*;

const DT: f32 = 1.0 / 64.0;

fn add_controller(simulator: &mut PhysicsSimulator, controller: impl Into<Controller>) -> ControllerId {
    let controller = simulator.create_controller(controller).unwrap();
    simulator.add(controller).unwrap();
    controller
}

fn sea() -> FluidContainerRef {
    FluidContainerRef::Aabb(AabbFluidContainer::new(Aabb::new(v(-1e4, 0.0), v(1e4, 1e4))).unwrap())
}

/// A disc deep under water, of a body that is not in the simulation and so keeps its forces.
fn diver(radius: f32, edges: i32, drag: FluidDragController) -> (PhysicsSimulator, BodyId) {
    let mut simulator = simulator(0.0);
    let body = simulator.create_body(Body::new());
    simulator[body].set_position(v(3.0, 1000.0));
    let outline = Vertices::create_circle(radius, edges).unwrap();
    let placement = GeomPlacement::with_grid_size(radius / 4.0);
    let geom = simulator.create_geom(body, outline, placement).unwrap();
    let mut drag = drag;
    drag.add_geom(geom).unwrap();
    add_controller(&mut simulator, drag);
    (simulator, body)
}

/// Whether the count is reduced before or after the step that is refused.
#[test]
fn a_refused_wave_step_leaves_the_nodes_beyond_a_reduced_count_alone() {
    for is_reduced_first in [true, false] {
        let mut wave = WaveController::new(v(0.0, 0.0), 50.0, 10.0, 6).unwrap();
        wave.set_frequency(0.0).unwrap();
        for x in [15.0, 25.0, 35.0, 45.0] {
            wave.disturb(x, 4.0).unwrap();
        }
        wave.update(DT).unwrap();
        let before = wave.current_wave().to_vec();
        assert!(before[3..5].iter().all(|&offset| offset != 0.0), "{before:?}");
        if is_reduced_first {
            wave.set_node_count(4).unwrap();
        }
        wave.set_damping_coefficient(f32::MAX).unwrap();
        assert!(wave.update(DT).is_err());
        assert_eq!(wave.current_wave(), before);
        wave.set_node_count(4).unwrap();
        wave.set_damping_coefficient(0.5).unwrap();
        wave.update(DT).unwrap();
        assert_ne!(wave.current_wave()[..3], before[..3], "the others move");
        assert_eq!(wave.current_wave()[4..], before[4..], "reduced first: {is_reduced_first}");
    }
}

proptest! {
    /// The area is half a sum of 80 products of an x up to 43 and a y up to 1040 at most. Products and partial sums are
    /// below 65536 and so rounded by 0.002 at most, 0.16 after all: of an area of 180 or more, less than a thousandth.
    #[test]
    fn a_submerged_disc_is_as_light_as_the_fluid_it_displaces(
        radius in 8.0_f32..40.0,
        edges in 8_i32..40,
        density in 0.01_f32..2.0,
        gravity in -200.0_f32..200.0,
    ) {
        let drag = FluidDragController::new(sea(), density, 0.5, 0.5, v(0.0, gravity)).unwrap();
        let (mut simulator, body) = diver(radius, edges, drag);
        simulator.update(DT);
        let (r, n) = (f64::from(radius), f64::from(edges));
        let area = 0.5 * n * r * r * (2.0 * std::f64::consts::PI / n).sin();
        let expected = -f64::from(gravity) * area * f64::from(density);
        let force = simulator[body].force();
        prop_assert_eq!(force.x, 0.0);
        prop_assert!((f64::from(force.y) - expected).abs() <= 0.001 * expected.abs(), "{force:?} {expected}");
    }

    #[test]
    fn drag_takes_energy_from_a_body(
        radius in 1.0_f32..40.0,
        velocity in (-500.0_f32..500.0, -500.0_f32..500.0),
        spin in -20.0_f32..20.0,
        density in 0.0_f32..2.0,
        linear in 0.0_f32..2.0,
        rotational in 0.0_f32..2.0,
    ) {
        let drag = FluidDragController::new(sea(), density, linear, rotational, v(0.0, 0.0)).unwrap();
        let (mut simulator, body) = diver(radius, 16, drag);
        simulator[body].set_linear_velocity(v(velocity.0, velocity.1));
        simulator[body].set_angular_velocity(spin);
        simulator.update(DT);
        let body = &simulator[body];
        let linear_power = f64::from(vector2::dot(body.force(), body.linear_velocity()));
        let angular_power = f64::from(body.torque() * body.angular_velocity());
        // Both products may be large and of opposite sign if the disc's centroid is not exactly at its body.
        let rounding = 1e-5 * (linear_power.abs() + angular_power.abs());
        prop_assert!(linear_power + angular_power <= rounding, "{linear_power} {angular_power}");
    }

    /// Some ten roundings of half an ulp each: distance, reciprocals, products.
    #[test]
    fn attraction_falls_off_as_documented(
        body in (-100.0_f32..100.0, -100.0_f32..100.0),
        source in (-100.0_f32..100.0, -100.0_f32..100.0),
        strength in -1000.0_f32..1000.0,
        mass in 0.1_f32..100.0,
        is_squared: bool,
    ) {
        let mut gravity = GravityController::with_points(vec![v(source.0, source.1)], strength, 150.0).unwrap();
        if is_squared {
            gravity.set_gravity_type(GravityType::DistanceSquared);
        }
        let force = force_on_static(v(body.0, body.1), mass, gravity);
        let [dx, dy] = [source.0 - body.0, source.1 - body.1].map(f64::from);
        let distance = dx.hypot(dy);
        // Rounding may decide the side of the radius on which a source lies; a distance of zero is another test.
        prop_assume!(distance > 1e-3 && (distance - 150.0).abs() > 1e-3);
        let size = f64::from(strength) * f64::from(mass) / distance.powi(if is_squared { 2 } else { 1 });
        let size = if distance < 150.0 { size } else { 0.0 };
        for (actual, direction) in [(force.x, dx), (force.y, dy)] {
            let expected = size * direction / distance;
            let error = (f64::from(actual) - expected).abs();
            prop_assert!(error <= 1e-6 * expected.abs(), "{actual} {expected}");
        }
    }

    /// With offsets u and damping d, u(k + 1) = d (A u(k) - u(k - 1)), where A is symmetric with eigenvalues 2 cos t.
    /// So the length of u(k) is at most (k + 1) d^(k / 2) times that of u(0), by Chebyshev's polynomials.
    #[test]
    fn a_damped_wave_dies_out(
        nodes in 5_usize..40,
        at in 0.0_f32..1.0,
        offset in -50.0_f32..50.0,
        damping in 0.5_f32..0.98,
    ) {
        let mut wave = WaveController::new(v(0.0, 0.0), 100.0, 50.0, nodes).unwrap();
        wave.set_damping_coefficient(damping).unwrap();
        wave.set_frequency(0.0).unwrap();
        let (first, last) = (wave.x_position()[1], wave.x_position()[nodes - 2]);
        wave.disturb(first + (last - first) * at * 0.999 + 1e-3, offset).unwrap();
        let length = |wave: &WaveController| -> f64 {
            wave.current_wave().iter().map(|&u| f64::from(u) * f64::from(u)).sum::<f64>().sqrt()
        };
        let start = length(&wave);
        for k in 1..=600 {
            wave.update(DT).unwrap();
            let bound = f64::from(k + 1) * f64::from(damping).powf(f64::from(k) / 2.0) * start;
            prop_assert!(length(&wave) <= bound * 1.001 + 1e-30, "{k}: {} {bound}", length(&wave));
        }
    }

    #[test]
    fn a_driven_wave_stays_finite_with_any_damping(
        damping in -3.0_f32..3.0,
        step in -1e3_f32..1e3,
        limits in (-1e4_f32..1e4, -1e4_f32..1e4),
    ) {
        let mut wave = WaveController::new(v(0.0, 0.0), 100.0, 50.0, 12).unwrap();
        wave.set_damping_coefficient(damping).unwrap();
        wave.set_frequency(0.0).unwrap();
        wave.set_wave_generator_step(step).unwrap();
        wave.set_wave_generator_max(limits.0).unwrap();
        wave.set_wave_generator_min(limits.1).unwrap();
        for _ in 0..600 {
            let before = wave.current_wave().to_vec();
            if wave.update(DT).is_err() {
                prop_assert_eq!(wave.current_wave(), before);
            }
            prop_assert!(wave.current_wave().iter().all(|offset| offset.is_finite()));
        }
    }

    /// Steps are multiples of 1/1024, whose sums are exact.
    #[test]
    fn accumulated_time_is_neither_lost_nor_counted_twice(
        preferred in 0.001_f32..0.1,
        maximum in 0.0_f32..0.2,
        raises in 0_usize..20,
        frames in prop::collection::vec(0_u16..64, 1..200),
    ) {
        let mut scaling = ScalingController::new(preferred, maximum).unwrap();
        for _ in 0..raises {
            scaling.increase_update_interval();
        }
        let (mut given, mut taken) = (0.0, 0.0);
        for frame in frames {
            let dt = f32::from(frame) / 1024.0;
            given += dt;
            let interval = scaling.get_update_interval(dt);
            taken += interval;
            let rest = given - taken;
            prop_assert!(interval == 0.0 || (interval >= scaling.update_interval() && rest == 0.0));
            prop_assert!((0.0..scaling.update_interval()).contains(&rest));
        }
    }

    #[test]
    fn the_interval_stays_between_the_preferred_one_and_that_plus_the_maximum(
        preferred in 0.001_f32..0.1,
        maximum in 0.0_f32..0.2,
        frames in prop::collection::vec((0.0_f32..0.1, 0.0_f32..0.5), 1..200),
    ) {
        let mut scaling = ScalingController::new(preferred, maximum).unwrap();
        for (dt, dt_real) in frames {
            scaling.update(dt, dt_real);
            let interval = scaling.update_interval();
            prop_assert!((preferred..=preferred + maximum).contains(&interval), "{interval}");
        }
    }

    #[test]
    fn an_idle_body_does_not_move_until_a_moving_one_comes_near(
        speed in 0.0_f32..54.0,
        max_idle_time in 50.0_f32..500.0,
        distance in 150.0_f32..400.0,
    ) {
        let mut simulator = simulator(0.0);
        let mut inactivity = InactivityController::new();
        inactivity.set_max_idle_time(max_idle_time).unwrap();
        add_controller(&mut simulator, inactivity);
        let sleeper = add_body(&mut simulator, v(0.0, 0.0), v(0.0, speed));
        simulator[sleeper].set_is_auto_idle(true);
        let until_idle = (max_idle_time / (DT * 1000.0)).ceil() as usize + 1;
        for _ in 0..until_idle {
            simulator.update(DT);
        }
        prop_assert!(!simulator[sleeper].enabled());
        let rest = simulator[sleeper].position();
        let visitor = add_body(&mut simulator, rest - v(distance, 0.0), v(60.0, 0.0));
        for _ in 0..600 {
            let gap = rest.x - simulator[visitor].position().x;
            simulator.update(DT);
            if gap > 100.0 {
                prop_assert_eq!(simulator[sleeper].position(), rest);
            } else {
                prop_assert!(simulator[sleeper].enabled());
                prop_assert_eq!(simulator[sleeper].position() != rest, simulator[sleeper].linear_velocity().y != 0.0);
                return Ok(());
            }
        }
        prop_assert!(false, "the visitor never came");
    }
}

/// The force of a gravity controller in one update on a static body, which keeps it.
fn force_on_static(position: Vector2, mass: f32, gravity: GravityController) -> Vector2 {
    let mut simulator = simulator(0.0);
    let body = add_body(&mut simulator, position, v(0.0, 0.0));
    simulator[body].set_mass(mass).unwrap();
    simulator[body].set_is_static(true);
    add_controller(&mut simulator, gravity);
    simulator.update(DT);
    simulator[body].force()
}

fn add_body(simulator: &mut PhysicsSimulator, position: Vector2, velocity: Vector2) -> BodyId {
    let body = simulator.create_body(Body::new());
    simulator.add(body).unwrap();
    simulator[body].set_position(position);
    simulator[body].set_linear_velocity(velocity);
    simulator[body].set_linear_drag_coefficient(0.0);
    body
}

/// Calls of the game's own controllers and containers, in order.
#[derive(Default)]
struct Log {
    calls: Vec<(ControllerId, &'static str)>,
}

/// Applies a force to a body, checks whether gravity acted before, and disposes another controller.
#[derive(Default)]
struct Game {
    log: Log,
    body: Option<BodyId>,
    disposes: Option<ControllerId>,
    seen_force: Option<Vector2>,
    times: Vec<(f32, f32)>,
    below: f32,
    entries: Vec<(GeomId, Vertices)>,
}

impl UserController for Game {
    fn update(&mut self, context: &mut Context<'_>, controller: ControllerId, dt: f32, dt_real: f32) {
        self.log.calls.push((controller, "update"));
        self.times.push((dt, dt_real));
        if let Some(body) = self.body {
            self.seen_force = Some(context.body(body).unwrap().force());
            context.body_mut(body).unwrap().apply_force(v(1.0, 0.0));
        }
        if let Some(other) = self.disposes {
            context.dispose(other).unwrap();
        }
    }

    fn validate(&mut self, _: &mut Context<'_>, controller: ControllerId) {
        self.log.calls.push((controller, "validate"));
    }
}

impl FluidContainer for Game {
    fn intersect(&self, _: &Aabb) -> bool {
        true
    }

    fn contains(&mut self, point: Vector2) -> bool {
        point.y > self.below
    }
}

impl EventHandler for Game {
    fn user_controller(&mut self, _: ControllerId) -> Option<&mut dyn UserController> {
        Some(self)
    }

    fn fluid_container(&mut self, controller: ControllerId) -> Option<&mut dyn FluidContainer> {
        self.log.calls.push((controller, "container"));
        Some(self)
    }

    fn on_fluid_entry(&mut self, _: &mut Context<'_>, _: ControllerId, geom: GeomId, vertices: &Vertices) {
        self.entries.push((geom, vertices.clone()));
    }
}

#[test]
fn user_defined_controllers_and_containers_are_called_in_list_order() {
    let mut simulator = simulator(0.0);
    let (_, geom) = add_circle(&mut simulator, 10.0, 16, v(0.0, 0.0));
    let first = add_controller(&mut simulator, Controller::user_defined());
    let mut drag =
        FluidDragController::new(FluidContainerRef::UserDefined, 1.0, 0.1, 0.1, v(0.0, 10.0)).unwrap();
    drag.add_geom(geom).unwrap();
    let drag = add_controller(&mut simulator, drag);
    let last = add_controller(&mut simulator, Controller::user_defined());
    let mut game = Game::default();
    simulator.update_with_real_time(DT, 0.5, Some(&mut game));
    let expected =
        [(first, "validate"), (last, "validate"), (first, "update"), (drag, "container"), (last, "update")];
    assert_eq!(game.log.calls, expected);
    assert_eq!(game.times, [(DT, 0.5), (DT, 0.5)]);
}

#[test]
fn user_defined_controllers_see_the_effects_of_earlier_ones() {
    let mut simulator = simulator(0.0);
    let body = add_body(&mut simulator, v(0.0, 0.0), v(0.0, 0.0));
    add_controller(&mut simulator, GravityController::with_points(vec![v(0.0, 2.0)], 8.0, 10.0).unwrap());
    add_controller(&mut simulator, Controller::user_defined());
    let mut game = Game { body: Some(body), ..Game::default() };
    simulator.update_with(DT, &mut game);
    assert_eq!(game.seen_force, Some(v(0.0, 4.0)));
    assert_eq!(simulator[body].linear_velocity(), v(1.0 * DT, 4.0 * DT));
}

#[test]
fn a_controller_disposed_by_one_before_it_does_not_act() {
    let mut simulator = simulator(0.0);
    let body = add_body(&mut simulator, v(0.0, 0.0), v(0.0, 0.0));
    add_controller(&mut simulator, Controller::user_defined());
    let gravity = GravityController::with_points(vec![v(0.0, 2.0)], 8.0, 10.0).unwrap();
    let gravity = add_controller(&mut simulator, gravity);
    let mut game = Game { disposes: Some(gravity), ..Game::default() };
    simulator.update_with(DT, &mut game);
    assert_eq!(simulator[body].linear_velocity(), v(0.0, 0.0));
}

#[test]
fn disabled_controllers_are_validated_but_not_updated() {
    let mut simulator = simulator(0.0);
    let controller = add_controller(&mut simulator, Controller::user_defined());
    simulator[controller].set_enabled(false);
    let mut game = Game::default();
    simulator.update_with(DT, &mut game);
    assert_eq!(game.log.calls, [(controller, "validate")]);
}

#[test]
fn controllers_without_a_handler_are_reported() {
    let mut simulator = simulator(0.0);
    let (_, geom) = add_circle(&mut simulator, 10.0, 16, v(0.0, 0.0));
    let user = add_controller(&mut simulator, Controller::user_defined());
    let mut drag =
        FluidDragController::new(FluidContainerRef::UserDefined, 1.0, 0.1, 0.1, v(0.0, 10.0)).unwrap();
    drag.add_geom(geom).unwrap();
    let drag = add_controller(&mut simulator, drag);
    simulator.update(DT);
    let missing = simulator.events().iter().filter(|event| matches!(event, Event::MissingController { .. }));
    let expected = [user, drag].map(|controller| Event::MissingController { controller });
    assert!(missing.eq(&expected));
}

#[test]
fn entry_is_reported_with_the_vertices_in_the_fluid() {
    let mut simulator = simulator(0.0);
    let (_, geom) = add_circle(&mut simulator, 10.0, 16, v(0.0, 0.0));
    let mut drag =
        FluidDragController::new(FluidContainerRef::UserDefined, 1.0, 0.1, 0.1, v(0.0, 10.0)).unwrap();
    drag.add_geom(geom).unwrap();
    let drag = add_controller(&mut simulator, drag);
    let mut game = Game { below: 1.0, ..Game::default() };
    simulator.process_added_and_removed();
    let world = simulator.geom(geom).unwrap().world_vertices().into_owned();
    simulator.update_with(DT, &mut game);
    let submerged: Vertices = world.into_iter().filter(|vertex| vertex.y > 1.0).collect();
    assert_eq!(submerged.len(), 7);
    assert_eq!(game.entries, [(geom, submerged)]);
    assert!(simulator.controller_as::<FluidDragController>(drag).unwrap().is_in_fluid(geom));
}

#[test]
fn disposed_geoms_and_bodies_are_dropped() {
    let mut simulator = simulator(0.0);
    let (body, geom) = add_circle(&mut simulator, 10.0, 16, v(0.0, 50.0));
    let mut drag = FluidDragController::new(sea(), 1.0, 0.1, 0.1, v(0.0, 10.0)).unwrap();
    drag.add_geom(geom).unwrap();
    let drag = add_controller(&mut simulator, drag);
    let gravity = GravityController::with_bodies(vec![body], 1.0, 10.0).unwrap();
    let gravity = add_controller(&mut simulator, gravity);
    simulator.update(DT);
    simulator.dispose(body).unwrap();
    simulator.update(DT);
    assert_eq!(simulator.controller_as::<FluidDragController>(drag).unwrap().geoms().count(), 0);
    assert!(simulator.controller_as::<GravityController>(gravity).unwrap().body_list().is_empty());
}

#[test]
fn a_disposed_container_or_one_that_is_no_wave_is_refused() {
    let mut simulator = simulator(0.0);
    let create = |controller: ControllerId, simulator: &mut PhysicsSimulator| {
        let container = FluidContainerRef::Wave(controller);
        simulator.create_controller(FluidDragController::new(container, 1.0, 0.1, 0.1, v(0.0, 10.0)).unwrap())
    };
    let other = add_controller(&mut simulator, InactivityController::new());
    let expected = Error::WrongKind { argument: "container", expected: "WaveController" };
    assert_eq!(create(other, &mut simulator), Err(expected));
    simulator.dispose(other).unwrap();
    simulator.update(DT);
    assert_eq!(create(other, &mut simulator), Err(Error::StaleId { argument: "container" }));
}

#[test]
fn a_controller_is_found_by_its_own_type_only() {
    let mut simulator = simulator(0.0);
    let controller = simulator.create_controller(InactivityController::new()).unwrap();
    assert!(simulator.controller_as::<InactivityController>(controller).is_ok());
    let expected = Error::WrongKind { argument: "controller", expected: "WaveController" };
    assert_eq!(simulator.controller_as_mut::<WaveController>(controller).err(), Some(expected));
}

#[test]
fn non_finite_numbers_are_refused_without_effect() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        assert!(ScalingController::new(bad, 0.1).is_err());
        assert!(WaveController::new(v(0.0, bad), 10.0, 10.0, 5).is_err());
        assert!(GravityController::with_points(vec![v(bad, 0.0)], 1.0, 1.0).is_err());
        assert!(FluidDragController::new(sea(), 1.0, bad, 1.0, v(0.0, 0.0)).is_err());
        assert!(AabbFluidContainer::new(Aabb::new(v(0.0, 0.0), v(bad, 1.0))).is_err());

        let mut wave = WaveController::new(v(0.0, 0.0), 10.0, 10.0, 5).unwrap();
        assert!(wave.disturb(5.0, bad).is_err());
        assert!(wave.update(bad).is_err());
        assert!(wave.set_x_position(vec![bad; 5]).is_err());
        assert_eq!(wave.current_wave(), [0.0; 5]);
        assert_eq!(wave.x_position(), [0.0, 2.5, 5.0, 7.5, 10.0]);

        let mut inactivity = InactivityController::new();
        assert!(inactivity.set_max_idle_time(bad).is_err());
        assert_eq!(inactivity.max_idle_time(), 1000.0);

        let mut scaling = ScalingController::new(0.02, 0.05).unwrap();
        assert_eq!(scaling.get_update_interval(bad), 0.0);
        assert_eq!(scaling.get_update_interval(0.02), 0.02);
    }
}

#[test]
fn a_wave_with_fewer_nodes_than_it_was_built_with_leaves_the_others_alone() {
    let mut wave = WaveController::new(v(0.0, 0.0), 10.0, 10.0, 11).unwrap();
    wave.set_frequency(0.0).unwrap();
    wave.set_node_count(4).unwrap();
    wave.disturb(1.5, 1.0).unwrap();
    wave.disturb(7.5, 1.0).unwrap();
    assert_eq!(wave.current_wave()[4..], [0.0; 7]);
    wave.set_node_count(100).unwrap();
    wave.update(DT).unwrap();
    assert!(wave.contains(v(1e6, 100.0)));
}

/// A scene with every kind of controller, that goes on changing.
fn everything() -> PhysicsSimulator {
    let mut simulator = simulator(50.0);
    let mut wave = WaveController::new(v(-200.0, 0.0), 400.0, 300.0, 21).unwrap();
    wave.set_wave_generator_max(8.0).unwrap();
    wave.set_wave_generator_min(-8.0).unwrap();
    wave.set_wave_generator_step(3.0).unwrap();
    let wave = add_controller(&mut simulator, wave);
    let mut drag =
        FluidDragController::new(FluidContainerRef::Wave(wave), 0.005, 0.2, 0.2, v(0.0, 50.0)).unwrap();
    for i in 0..6 {
        let (body, geom) = add_circle(&mut simulator, 12.0, 20, v(i as f32 * 50.0 - 125.0, -40.0));
        simulator[body].set_is_auto_idle(i % 2 == 0);
        drag.add_geom(geom).unwrap();
    }
    add_controller(&mut simulator, drag);
    let gravity = GravityController::with_points(vec![v(0.0, 100.0)], 300.0, 400.0).unwrap();
    add_controller(&mut simulator, gravity);
    add_controller(&mut simulator, InactivityController::new());
    add_controller(&mut simulator, ScalingController::new(0.02, 0.05).unwrap());
    simulator
}

#[test]
fn a_saved_scene_with_every_controller_goes_on_with_the_same_bits() {
    let mut simulator = everything();
    for _ in 0..100 {
        simulator.update(DT);
    }
    let saved = serde_json::to_string(&simulator).unwrap();
    let mut loaded: PhysicsSimulator = serde_json::from_str(&saved).unwrap();
    for step in 0..300 {
        simulator.update(DT);
        loaded.update(DT);
        assert_eq!(state(&loaded), state(&simulator), "step {step}");
    }
    assert_eq!(serde_json::to_string(&loaded).unwrap(), serde_json::to_string(&simulator).unwrap());
}
