//! The precise set: saves, clones and changes of method in the middle of a run.

use conformance::fixtures::plane::{Refuses, add_box, add_circle, add_floor, simulator, v};
use farseer_core::{
    BroadPhaseCollider, Contact, Context, EventHandler, GeomId, JointFactory, JointId, Methods,
    NarrowPhaseCollider, PhysicsSimulator,
};

const DT: f32 = 1.0 / 60.0;

/// Boxes and balls that fall into a pit, a few at a time.
fn filling_pit() -> PhysicsSimulator {
    let mut simulator = simulator(320.0);
    simulator.set_methods(Methods::PRECISE).unwrap();
    simulator.set_iterations(4);
    add_floor(&mut simulator, (200.0, 20.0), v(0.0, 10.0));
    add_floor(&mut simulator, (20.0, 400.0), v(-90.0, -200.0));
    add_floor(&mut simulator, (20.0, 400.0), v(90.0, -200.0));
    simulator
}

fn throw_in(simulator: &mut PhysicsSimulator, number: usize) {
    let place = v(((number * 37) % 120) as f32 - 60.0, -300.0 - (number % 3) as f32 * 30.0);
    let geom = if number.is_multiple_of(2) {
        add_box(simulator, (20.0, 14.0 + (number % 5) as f32), place).1
    } else {
        add_circle(simulator, 8.0, 16, place).1
    };
    simulator[geom].set_friction_coefficient(0.4);
    simulator[geom].set_restitution_coefficient(0.1 * (number % 4) as f32);
}

/// Steps both alike: a body is thrown in every ten steps, and one is removed now and then.
fn play(simulator: &mut PhysicsSimulator, step: usize) {
    if step.is_multiple_of(10) && step < 300 {
        throw_in(simulator, step / 10);
    }
    if step % 83 == 82 {
        let first = simulator.body_list()[3];
        simulator.dispose(first).unwrap();
    }
    if step % 29 == 28 {
        let last = *simulator.body_list().last().unwrap();
        let position = simulator[last].position();
        simulator[last].set_position(position - v(0.0, 20.0));
        simulator[last].set_linear_velocity(v(60.0, -100.0));
    }
    simulator.update(DT);
}

#[test]
fn a_pile_that_builds_up_goes_on_with_the_same_bits_after_a_restore_in_every_step() {
    let (mut plain, mut restored) = (filling_pit(), filling_pit());
    for step in 0..500 {
        play(&mut plain, step);
        play(&mut restored, step);
        assert_eq!(plain.events(), restored.events(), "step {step}");
        assert!(plain.snapshot() == restored.snapshot(), "step {step}");
        let mut next = simulator(1.0);
        next.restore(&restored.snapshot()).unwrap();
        restored = next;
    }
    assert!(plain.arbiter_count() > 20);
}

/// Small boxes on a plate, more than there are colours for constraints, and one more body every few steps while others are
/// removed.
fn laden_plate() -> PhysicsSimulator {
    let mut simulator = filling_pit();
    add_floor(&mut simulator, (900.0, 20.0), v(0.0, 200.0));
    let (plate, _) = add_box(&mut simulator, (800.0, 10.0), v(0.0, 180.0));
    simulator[plate].set_mass(50.0).unwrap();
    for number in 0..60 {
        add_box(&mut simulator, (8.0, 8.0), v(number as f32 * 12.0 - 354.0, 170.0));
    }
    simulator
}

#[test]
fn overflow_constraints_keep_their_order_when_bodies_are_added_and_removed() {
    let (mut plain, mut restored) = (laden_plate(), laden_plate());
    let mut most = 0;
    for step in 0..150 {
        for simulator in [&mut plain, &mut restored] {
            if step % 5 == 4 {
                let going = simulator.body_list()[4 + (step * 7) % 40];
                simulator.dispose(going).unwrap();
            }
            if step % 7 == 6 {
                add_box(simulator, (8.0, 8.0), v((step * 5 % 700) as f32 - 350.0, 150.0));
            }
            simulator.update(DT);
        }
        most = most.max(plain.rows_per_colour().len());
        assert!(plain.snapshot() == restored.snapshot(), "step {step}");
        let mut next = simulator(1.0);
        next.restore(&restored.snapshot()).unwrap();
        restored = next;
    }
    assert_eq!(most, 32);
}

#[test]
fn a_clone_goes_on_with_the_same_bits() {
    let mut plain = filling_pit();
    let mut cloned = filling_pit();
    for step in 0..400 {
        play(&mut plain, step);
        play(&mut cloned, step);
        cloned = cloned.clone();
    }
    assert!(plain.snapshot() == cloned.snapshot());
}

#[test]
fn contacts_are_readable_before_the_first_update_after_a_restore() {
    let mut plain = filling_pit();
    (0..200).for_each(|step| play(&mut plain, step));
    // An edit counts from the next update on.
    let last = *plain.body_list().last().unwrap();
    for is_edited in [false, true] {
        if is_edited {
            plain[last].set_linear_velocity(v(60.0, -100.0));
            plain[last].set_mass(2.0).unwrap();
        }
        let mut restored = simulator(1.0);
        restored.restore(&plain.snapshot()).unwrap();
        assert!(plain.contact_count() > 10);
        let touching = |simulator: &PhysicsSimulator| -> Vec<Contact> {
            simulator.arbiters().flat_map(|arbiter| arbiter.contacts()).collect()
        };
        assert_eq!(touching(&restored), touching(&plain));
        assert!(restored.snapshot() == plain.snapshot());
    }
}

#[test]
fn refused_circles_are_the_same_after_a_restore_and_a_pause() {
    let mut plain = simulator(320.0);
    plain.set_methods(Methods::PRECISE).unwrap();
    for x in [0.0, 15.0] {
        add_circle(&mut plain, 8.0, 16, v(x, 0.0));
    }
    (0..2).for_each(|_| plain.update_with(DT, &mut Refuses::Collisions));
    let mut restored = simulator(1.0);
    restored.restore(&plain.snapshot()).unwrap();
    for dt in [0.0, DT, 0.0] {
        plain.update(dt);
        restored.update(dt);
        assert!(plain.snapshot() == restored.snapshot());
    }
}

/// Disposes a joint in a collision callback.
struct Disposes(JointId);

impl EventHandler for Disposes {
    fn on_collision(
        &mut self,
        context: &mut Context<'_>,
        _: GeomId,
        _: GeomId,
        _: &mut Vec<Contact>,
    ) -> bool {
        context.dispose(self.0).unwrap();
        true
    }
}

#[test]
fn a_joint_disposed_in_a_collision_callback_does_not_act_restored_or_not() {
    let mut plain = filling_pit();
    let (lying, _) = add_box(&mut plain, (20.0, 20.0), v(0.0, -10.0));
    let (hanging, _) = add_box(&mut plain, (20.0, 20.0), v(40.0, -100.0));
    let joint = JointFactory::create_revolute_joint_in(&mut plain, lying, hanging, v(20.0, -55.0)).unwrap();
    let hook = JointFactory::create_fixed_revolute_joint_in(&mut plain, hanging, v(50.0, -110.0)).unwrap();
    (0..30).for_each(|_| plain.update(DT));
    let force = plain[joint].force();
    assert!(force.norm() > 1.0, "{force}");
    let mut restored = simulator(1.0);
    restored.restore(&plain.snapshot()).unwrap();
    for simulator in [&mut plain, &mut restored] {
        simulator.update_with(DT, &mut Disposes(joint));
        assert!(simulator[hook].force().norm() > 1.0);
    }
    assert!(plain.snapshot() == restored.snapshot());
    assert_eq!(plain[joint].force(), force, "it has acted once more");
}

#[test]
fn json_keeps_every_bit() {
    let mut plain = filling_pit();
    (0..200).for_each(|step| play(&mut plain, step));
    let text = serde_json::to_string(&plain).unwrap();
    let mut read: PhysicsSimulator = serde_json::from_str(&text).unwrap();
    for step in 200..260 {
        play(&mut plain, step);
        play(&mut read, step);
    }
    assert!(plain.snapshot() == read.snapshot());
}

#[test]
fn methods_may_change_in_the_middle_of_a_run() {
    let mut simulator = filling_pit();
    simulator.set_methods(Methods::default()).unwrap();
    (0..20).for_each(|number| throw_in(&mut simulator, number));
    for round in 0..6 {
        let is_precise = round % 2 == 0;
        let (broad, narrow) = (BroadPhaseCollider::SPATIAL_HASH, NarrowPhaseCollider::Sat);
        let faithful = Methods::Faithful { broad, narrow };
        simulator.set_methods(if is_precise { Methods::PRECISE } else { faithful }).unwrap();
        (0..60).for_each(|_| simulator.update(DT));
        let is_inside = |position: farseer_core::math::Vector2| position.x.abs() < 100.0 && position.y < 5.0;
        for &body in simulator.body_list() {
            assert!(is_inside(simulator[body].position()) || simulator[body].is_static(), "round {round}");
        }
    }
    assert!(simulator.arbiter_count() > 10);
}

#[test]
fn an_invalid_length_unit_is_refused() {
    let mut simulator = simulator(320.0);
    for length_unit in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        assert!(simulator.set_methods(Methods::Precise { length_unit }).is_err(), "{length_unit}");
    }
    assert_eq!(simulator.methods(), Methods::default());
}

#[test]
fn a_pose_edited_from_zero_to_negative_zero_is_restored_with_its_sign() {
    for place in [v(-0.0, 0.0), v(0.0, -0.0)] {
        let mut plain = simulator(0.0);
        plain.set_methods(Methods::PRECISE).unwrap();
        let body = add_box(&mut plain, (20.0, 20.0), v(0.0, 0.0)).0;
        add_floor(&mut plain, (200.0, 20.0), v(0.0, 20.0));
        plain.update(DT);
        plain[body].set_position(place);
        plain[body].set_rotation(-0.0);
        for update in 0..3 {
            let mut restored = simulator(1.0);
            restored.restore(&plain.snapshot()).unwrap();
            assert!(restored.snapshot() == plain.snapshot(), "before update {update}");
            plain.update(DT);
            restored.update(DT);
            assert!(restored.snapshot() == plain.snapshot(), "after update {update}");
        }
    }
}
