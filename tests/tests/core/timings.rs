//! How long the stages of an update take, by a clock that is handed in (behaviour chapter 04, section 8).

use std::cell::Cell;

use conformance::fixtures::plane::{add_box, add_floor, simulator, state, v};
use farseer_core::{
    BodyId, Contact, Context, Controller, ControllerId, EventHandler, GeomId, JointFactory, JointId,
    LinearSpring, ObjectId, PhysicsSimulator, SpringFactory, SpringId, StepTimes, UserController,
};

/// The same time for all stages, and for the complete update.
fn times(stage: f32, update_time: f32) -> StepTimes {
    StepTimes {
        clean_up_time: stage,
        broad_phase_collision_time: stage,
        narrow_phase_collision_time: stage,
        apply_forces_time: stage,
        apply_impulses_time: stage,
        update_positions_time: stage,
        update_time,
    }
}

/// A clock that advances by 1 ms with every reading.
fn ticking() -> impl FnMut() -> f64 {
    let mut time = 1.0e6;
    move || {
        time += 1.0;
        time
    }
}

/// A box that lies on a floor, a stretched spring and a joint.
fn scene() -> PhysicsSimulator {
    let mut simulator = simulator(100.0);
    let (floor, _) = add_floor(&mut simulator, (200.0, 20.0), v(0.0, 0.0));
    let (block, _) = add_box(&mut simulator, (20.0, 20.0), v(-50.0, -19.5));
    let end = v(0.0, 0.0);
    let spring =
        SpringFactory::create_linear_spring_in(&mut simulator, floor, end, block, end, 5.0, 1.0).unwrap();
    simulator.spring_as_mut::<LinearSpring>(spring).unwrap().set_rest_length(40.0).unwrap();
    JointFactory::create_pin_joint_in(&mut simulator, floor, v(0.0, 0.0), block, v(0.0, 0.0)).unwrap();
    simulator
}

#[test]
fn before_the_first_timed_update_times_are_minus_one_with_a_gravity_and_zero_without() {
    assert_eq!(simulator(0.0).step_times(), times(-1.0, -1.0));
    assert_eq!(PhysicsSimulator::default().step_times(), times(0.0, 0.0));
}

#[test]
fn an_update_without_a_clock_leaves_the_times_alone() {
    let mut simulator = scene();
    simulator.update(0.01);
    assert_eq!(simulator.step_times(), times(-1.0, -1.0));
    simulator.update_timed(0.01, 0.0, None, &mut ticking());
    simulator.update(0.01);
    assert_eq!(simulator.step_times(), times(1.0, 6.0));
}

#[test]
fn a_stage_begins_where_the_one_before_ends() {
    let mut simulator = scene();
    simulator.update_timed(0.01, 0.0, None, &mut ticking());
    assert_eq!(simulator.step_times(), times(1.0, 6.0));
}

#[test]
fn an_update_without_a_step_has_only_clean_up_time() {
    let cleaned_up = StepTimes { clean_up_time: 1.0, ..times(0.0, 1.0) };
    for (dt, enabled) in [(0.0, true), (0.01, false), (f32::NAN, true)] {
        let mut simulator = scene();
        simulator.update_timed(0.01, 0.0, None, &mut ticking());
        simulator.set_enabled(enabled);
        simulator.update_timed(dt, 0.0, None, &mut ticking());
        assert_eq!(simulator.step_times(), cleaned_up, "{dt} {enabled}");
    }
}

/// Callbacks that take a time of their own each.
struct Slow<'c>(&'c Cell<f64>);

impl Slow<'_> {
    fn take(&self, milliseconds: f64) {
        self.0.set(self.0.get() + milliseconds);
    }
}

impl EventHandler for Slow<'_> {
    fn on_added(&mut self, _: ObjectId) {
        self.take(1.0);
    }

    fn handles_broad_phase(&self) -> bool {
        true
    }

    fn on_broad_phase_collision(&mut self, _: &mut Context<'_>, _: GeomId, _: GeomId) -> bool {
        self.take(20.0);
        true
    }

    fn on_collision(&mut self, _: &mut Context<'_>, _: GeomId, _: GeomId, _: &mut Vec<Contact>) -> bool {
        self.take(300.0);
        true
    }

    fn handles_spring_updates(&self) -> bool {
        true
    }

    fn on_spring_updated(&mut self, _: &mut Context<'_>, _: SpringId) {
        self.take(4000.0);
    }

    fn handles_joint_updates(&self) -> bool {
        true
    }

    fn on_joint_updated(&mut self, _: &mut Context<'_>, _: JointId) {
        self.take(50000.0);
    }

    fn on_body_updated(&mut self, _: &mut Context<'_>, _: BodyId) {
        self.take(600000.0);
    }
}

#[test]
fn each_time_is_that_of_its_stage() {
    let mut simulator = scene();
    let clock = Cell::new(0.0);
    simulator.update_timed(0.01, 0.0, Some(&mut Slow(&clock)), &mut || clock.get());
    let expected = StepTimes {
        // Two bodies, two geoms, a spring and a joint enter; the geoms follow both bodies, whose positions were set.
        clean_up_time: 1200006.0,
        broad_phase_collision_time: 20.0,
        // Both geoms get a callback.
        narrow_phase_collision_time: 600.0,
        apply_forces_time: 4000.0,
        // Once per pass of the solver.
        apply_impulses_time: 250000.0,
        update_positions_time: 600000.0,
        update_time: 2054626.0,
    };
    assert_eq!(simulator.step_times(), expected);
}

#[test]
fn a_timed_update_computes_the_same_as_any_update() {
    let (mut timed, mut plain) = (scene(), scene());
    for _ in 0..50 {
        timed.update_timed(0.01, 0.0, None, &mut ticking());
        plain.update(0.01);
        assert_eq!(state(&timed), state(&plain));
    }
}

#[test]
fn a_timed_update_passes_the_real_time_to_controllers() {
    struct Told(Vec<f32>);
    impl UserController for Told {
        fn update(&mut self, _: &mut Context<'_>, _: ControllerId, _: f32, dt_real: f32) {
            self.0.push(dt_real);
        }
    }
    impl EventHandler for Told {
        fn user_controller(&mut self, _: ControllerId) -> Option<&mut dyn UserController> {
            Some(self)
        }
    }
    let mut simulator = simulator(0.0);
    let controller = simulator.create_controller(Controller::user_defined()).unwrap();
    simulator.add(controller).unwrap();
    let mut told = Told(Vec::new());
    simulator.update_timed(0.01, 0.25, Some(&mut told), &mut ticking());
    assert_eq!(told.0, [0.25]);
}

#[test]
fn times_outlive_a_clear_and_are_not_saved() {
    let mut simulator = scene();
    simulator.update_timed(0.01, 0.0, None, &mut ticking());
    let snapshot = simulator.snapshot();
    simulator.clear();
    assert_eq!(simulator.step_times(), times(1.0, 6.0));
    simulator.restore(&snapshot).unwrap();
    assert_eq!(simulator.step_times(), times(0.0, 0.0));
}
