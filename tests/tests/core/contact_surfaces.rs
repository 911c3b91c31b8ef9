//! Friction, restitution and tangent speed that a handler sets for an update, with both sets of methods.

use conformance::fixtures::plane::{add_box, add_circle, add_floor, lively_scene, simulator, state, v};
use farseer_core::{BodyId, Contact, Context, Error, EventHandler, GeomId, Methods, PhysicsSimulator};

const DT: f32 = 1.0 / 60.0;

const SETS: [fn(&mut PhysicsSimulator); 2] = [
    |_| {},
    |simulator| {
        simulator.set_methods(Methods::PRECISE).unwrap();
        simulator.set_iterations(4);
    },
];

/// A handler that is one function.
struct On<F>(F);

impl<F: FnMut(&mut Context<'_>, GeomId, GeomId)> EventHandler for On<F> {
    fn on_collision(
        &mut self,
        context: &mut Context<'_>,
        this: GeomId,
        other: GeomId,
        _: &mut Vec<Contact>,
    ) -> bool {
        (self.0)(context, this, other);
        true
    }
}

fn floored(choose: fn(&mut PhysicsSimulator), friction: f32) -> PhysicsSimulator {
    let mut simulator = simulator(320.0);
    choose(&mut simulator);
    let (_, floor) = add_floor(&mut simulator, (4000.0, 20.0), v(0.0, 10.0));
    simulator[floor].set_friction_coefficient(friction);
    simulator
}

/// A box at rest on a floor, both of this friction.
fn resting_box(choose: fn(&mut PhysicsSimulator), friction: f32) -> (PhysicsSimulator, BodyId) {
    let mut simulator = floored(choose, friction);
    let (body, geom) = add_box(&mut simulator, (32.0, 32.0), v(0.0, -16.0));
    simulator[geom].set_friction_coefficient(friction);
    simulator[body].set_linear_drag_coefficient(0.0);
    (0..120).for_each(|_| simulator.update(DT));
    (simulator, body)
}

fn run(simulator: &mut PhysicsSimulator, steps: usize, on: impl FnMut(&mut Context<'_>, GeomId, GeomId)) {
    let mut handler = On(on);
    (0..steps).for_each(|_| simulator.update_with(DT, &mut handler));
}

/// A box that tilts by roundings has tilted normals, which accelerate it: 0.005 px/s in a second were measured. Friction would
/// take 2.7 px/s in every step.
fn assert_kept(simulator: &PhysicsSimulator, body: BodyId) {
    let speed = simulator[body].linear_velocity().x;
    assert!((speed - 100.0).abs() < 0.05, "{speed}");
}

#[test]
fn a_slide_without_friction_keeps_its_speed() {
    for choose in SETS {
        let (mut simulator, body) = resting_box(choose, 0.5);
        simulator[body].set_linear_velocity(v(100.0, 0.0));
        run(&mut simulator, 60, |context, _, _| context.set_contact_friction(0.0).unwrap());
        assert_kept(&simulator, body);
        // With the friction of the geoms it would have lost 160 px/s.
        (0..60).for_each(|_| simulator.update(DT));
        assert!(simulator[body].linear_velocity().x.abs() < 0.1);
    }
}

#[test]
fn a_slide_is_braked_by_the_friction_override() {
    for choose in SETS {
        let (mut simulator, body) = resting_box(choose, 0.0);
        simulator[body].set_linear_velocity(v(200.0, 0.0));
        run(&mut simulator, 60, |context, _, _| context.set_contact_friction(0.25).unwrap());
        // 0.25 g in a second are 80 px/s; the faithful set's impulses lag by a step or two.
        let lost = 200.0 - simulator[body].linear_velocity().x;
        assert!((lost - 80.0).abs() < 4.0, "{lost}");
    }
}

#[test]
fn a_bounce_follows_the_restitution_override() {
    for choose in SETS {
        for restitution in [0.0f32, 0.5, 1.0] {
            let mut simulator = floored(choose, 0.0);
            let (body, _) = add_circle(&mut simulator, 16.0, 32, v(0.0, -216.0));
            let (mut lowest, mut highest) = (f32::MIN, f32::MAX);
            for _ in 0..120 {
                run(&mut simulator, 1, |context, _, _| context.set_contact_restitution(restitution).unwrap());
                let y = simulator[body].position().y;
                (lowest, highest) = if y > lowest { (y, y) } else { (lowest, highest.min(y)) };
            }
            // It has fallen by 200 px; the moment of the hit is known up to a step of the fall, 6 px.
            let wanted = 200.0 * restitution * restitution;
            assert!((lowest - highest - wanted).abs() < 12.0, "{restitution}: {}", lowest - highest);
        }
    }
}

#[test]
fn a_handler_makes_a_conveyor() {
    for choose in SETS {
        let (mut simulator, body) = resting_box(choose, 0.5);
        run(&mut simulator, 60, |context, _, _| context.set_contact_tangent_speed(50.0).unwrap());
        // It moves to the left, as y points down. The tolerance is a tenth, since it has just stopped to slip.
        assert!(
            (simulator[body].linear_velocity().x + 50.0).abs() < 5.0,
            "{}",
            simulator[body].linear_velocity()
        );
        run(&mut simulator, 120, |_, _, _| {});
        assert!(simulator[body].linear_velocity().x.abs() < 0.1);
    }
}

/// The floor is the younger geom here.
#[test]
fn the_direction_of_a_conveyor_does_not_depend_on_creation_order() {
    for choose in SETS {
        let mut simulator = simulator(320.0);
        choose(&mut simulator);
        let (body, geom) = add_box(&mut simulator, (32.0, 32.0), v(0.0, -16.0));
        let (_, floor) = add_floor(&mut simulator, (4000.0, 20.0), v(0.0, 10.0));
        [geom, floor].into_iter().for_each(|geom| simulator[geom].set_friction_coefficient(0.5));
        run(&mut simulator, 120, |context, _, _| context.set_contact_tangent_speed(50.0).unwrap());
        assert!(
            (simulator[body].linear_velocity().x + 50.0).abs() < 1.0,
            "{}",
            simulator[body].linear_velocity()
        );
    }
}

#[test]
fn a_conveyor_adds_to_the_motion_of_a_belt() {
    for choose in SETS {
        let (mut simulator, body) = resting_box(choose, 0.5);
        let floor = simulator.body_list()[0];
        simulator[floor].set_linear_velocity(v(-20.0, 0.0));
        run(&mut simulator, 120, |context, _, _| context.set_contact_tangent_speed(30.0).unwrap());
        assert!(
            (simulator[body].linear_velocity().x + 50.0).abs() < 1.0,
            "{}",
            simulator[body].linear_velocity()
        );
    }
}

#[test]
fn the_last_callback_decides() {
    for choose in SETS {
        let (mut simulator, body) = resting_box(choose, 0.5);
        simulator[body].set_linear_velocity(v(100.0, 0.0));
        let first = simulator.geom_list()[0];
        run(&mut simulator, 30, |context, this, _| {
            context.set_contact_friction(if this == first { 9.0 } else { 0.0 }).unwrap();
        });
        assert_kept(&simulator, body);
    }
}

/// Sets the values that are there anyway.
#[test]
fn overrides_equal_to_the_values_of_the_geoms_change_no_bit() {
    for choose in SETS {
        let scene = || {
            let mut scene = lively_scene(Default::default(), 21);
            choose(&mut scene);
            scene
        };
        let (mut plain, mut set) = (scene(), scene());
        for step in 0..120 {
            run(&mut plain, 1, |_, _, _| {});
            run(&mut set, 1, |context, this, other| {
                let [a, b] = [this, other].map(|geom| context.geom(geom).unwrap());
                let (first, second) = if a.id() < b.id() { (a, b) } else { (b, a) };
                let mean = |one: f32, other: f32| (one + other) / 2.0;
                let friction = mean(first.friction_coefficient(), second.friction_coefficient());
                let restitution = mean(first.restitution_coefficient(), second.restitution_coefficient());
                context.set_contact_friction(friction).unwrap();
                context.set_contact_restitution(restitution).unwrap();
                context.set_contact_tangent_speed(0.0).unwrap();
            });
            assert_eq!(state(&plain), state(&set), "step {step}");
        }
    }
}

/// Sets in every other update, and goes on from a save after each: a save does not contain the overrides.
#[test]
fn overrides_last_for_one_update() {
    for choose in SETS {
        let mut played = lively_scene(Default::default(), 22);
        choose(&mut played);
        let mut has_set = 0;
        for step in 0..160 {
            let mut restored = PhysicsSimulator::default();
            restored.restore(&played.snapshot()).unwrap();
            for simulator in [&mut played, &mut restored] {
                run(simulator, 1, |context, this, _| {
                    let number = context.geom(this).unwrap().id();
                    if step % 2 == 0 && number % 3 > 0 {
                        context.set_contact_friction(number as f32 * 0.1).unwrap();
                        context.set_contact_restitution(0.8).unwrap();
                        context.set_contact_tangent_speed(60.0).unwrap();
                        has_set += 1;
                    }
                });
            }
            assert_eq!(state(&played), state(&restored), "step {step}");
            assert!(played.snapshot() == restored.snapshot(), "step {step}");
        }
        assert!(has_set > 500, "{has_set}");
    }
}

/// The precise set builds its lists again in the middle of the update, because a callback has edited a geom that touches.
#[test]
fn edits_in_the_same_callback_keep_the_overrides() {
    for choose in SETS {
        let (mut simulator, body) = resting_box(choose, 0.5);
        let (_, other) = add_box(&mut simulator, (10.0, 10.0), v(500.0, -5.0));
        simulator[body].set_linear_velocity(v(100.0, 0.0));
        let mine = simulator.geom_list()[1];
        let mut group = 1;
        run(&mut simulator, 60, |context, this, _| {
            context.set_contact_friction(if this == mine { 0.0 } else { 0.5 }).unwrap();
            group += 1;
            context.geom_mut(other).unwrap().set_collision_group(group);
        });
        assert_kept(&simulator, body);
    }
}

#[test]
fn a_contact_refused_after_an_override_exerts_no_impulse() {
    struct Refusing;
    impl EventHandler for Refusing {
        fn on_collision(
            &mut self,
            context: &mut Context<'_>,
            _: GeomId,
            _: GeomId,
            _: &mut Vec<Contact>,
        ) -> bool {
            context.set_contact_restitution(1.0).unwrap();
            false
        }
    }
    for choose in SETS {
        let (mut simulator, body) = resting_box(choose, 0.5);
        (0..30).for_each(|_| simulator.update_with(DT, &mut Refusing));
        // Half of g t^2 in half a second.
        assert!((simulator[body].position().y + 16.0 - 40.0).abs() < 4.0);
    }
}

#[test]
fn an_invalid_override_is_an_error_that_names_it_and_changes_no_state() {
    for choose in SETS {
        let (mut simulator, body) = resting_box(choose, 0.5);
        simulator[body].set_linear_velocity(v(100.0, 0.0));
        let named = |result: Result<(), Error>, name: &str| {
            assert!(
                matches!(&result, Err(Error::InvalidArgument { argument, .. }) if *argument == name),
                "{result:?}"
            );
        };
        run(&mut simulator, 30, |context, _, _| {
            context.set_contact_friction(0.0).unwrap();
            for bad in [f32::NAN, f32::INFINITY, -f32::INFINITY, -0.1] {
                named(context.set_contact_friction(bad), "friction");
                named(context.set_contact_restitution(bad), "restitution");
            }
            for bad in [f32::NAN, f32::INFINITY, -f32::INFINITY] {
                named(context.set_contact_tangent_speed(bad), "tangent_speed");
            }
        });
        assert_kept(&simulator, body);
    }
}

/// The greatest numbers are accepted, and do not make any other one infinite or NaN.
#[test]
fn the_greatest_overrides_make_no_number_infinite_or_nan() {
    for choose in SETS {
        let (mut simulator, body) = resting_box(choose, 0.5);
        simulator[body].set_linear_velocity(v(100.0, 50.0));
        run(&mut simulator, 30, |context, _, _| {
            context.set_contact_friction(f32::MAX).unwrap();
            context.set_contact_restitution(f32::MAX).unwrap();
            context.set_contact_tangent_speed(f32::MAX).unwrap();
        });
        assert!(conformance::fixtures::plane::is_finite(&simulator));
    }
}

#[test]
fn overrides_are_refused_in_other_callbacks() {
    struct Elsewhere(usize);
    impl EventHandler for Elsewhere {
        fn on_body_updated(&mut self, context: &mut Context<'_>, _: BodyId) {
            assert_eq!(context.set_contact_friction(0.0), Err(Error::NoCollision));
            assert_eq!(context.set_contact_restitution(0.0), Err(Error::NoCollision));
            assert_eq!(context.set_contact_tangent_speed(0.0), Err(Error::NoCollision));
            self.0 += 1;
        }
        fn on_separation(&mut self, context: &mut Context<'_>, _: GeomId, _: GeomId) {
            assert_eq!(context.set_contact_friction(0.0), Err(Error::NoCollision));
        }
    }
    for choose in SETS {
        let mut simulator = lively_scene(Default::default(), 23);
        choose(&mut simulator);
        let mut elsewhere = Elsewhere(0);
        (0..60).for_each(|_| simulator.update_with(DT, &mut elsewhere));
        assert!(elsewhere.0 > 100);
    }
}
