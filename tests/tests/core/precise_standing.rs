//! The precise set: islands with joints at rest are not solved again until their surroundings change.

use conformance::fixtures::plane::{precise, run, v};
use farseer_core::{
    BodyFactory, BodyId, GeomFactory, GeomPlacement, JointFactory, JointId, JointMotor, PhysicsSimulator,
};

const DT: f32 = 1.0 / 60.0;
const GRAVITY: f32 = 320.0;

fn add_box(
    simulator: &mut PhysicsSimulator,
    [x, y]: [f32; 2],
    [width, height]: [f32; 2],
    mass: f32,
) -> BodyId {
    let body = BodyFactory::create_rectangle_body_in(simulator, width, height, mass).unwrap();
    let placement = GeomPlacement::default();
    let geom = GeomFactory::create_rectangle_geom_in(simulator, body, width, height, placement).unwrap();
    simulator[geom].set_friction_coefficient(0.5);
    simulator[body].set_position(v(x, y));
    simulator[body].set_linear_drag_coefficient(0.0);
    simulator[body].set_rotational_drag_coefficient(0.0);
    body
}

/// A table on a static floor: a plate welded to two legs, and a pointer on a hinge with a motor at its middle.
struct Table {
    floor: BodyId,
    plate: BodyId,
    pointer: BodyId,
    hinge: JointId,
}

fn add_table(simulator: &mut PhysicsSimulator) -> Table {
    let floor = add_box(simulator, [0.0, 20.0], [2000.0, 40.0], 1.0);
    simulator[floor].set_is_static(true);
    let plate = add_box(simulator, [0.0, -44.0], [120.0, 8.0], 20.0);
    for x in [-50.0, 50.0] {
        let leg = add_box(simulator, [x, -20.0], [8.0, 40.0], 1.0);
        JointFactory::create_weld_joint_in(simulator, plate, leg, v(x, -40.0)).unwrap();
    }
    let pointer = add_box(simulator, [0.0, -80.0], [4.0, 40.0], 1.0);
    let hinge = JointFactory::create_revolute_joint_in(simulator, plate, pointer, v(0.0, -60.0)).unwrap();
    simulator[pointer].set_rotation(0.0);
    let brake = JointMotor { speed: 0.0, greatest_effort: 1e6 };
    simulator.set_joint_motor(hinge, Some(brake)).unwrap();
    Table { floor, plate, pointer, hinge }
}

fn standing_table() -> (PhysicsSimulator, Table) {
    let mut simulator = precise(GRAVITY);
    simulator.set_sleep_enabled(false);
    let table = add_table(&mut simulator);
    run(&mut simulator, 120);
    (simulator, table)
}

/// Poses and velocities of all bodies.
fn state(simulator: &PhysicsSimulator) -> Vec<[u32; 6]> {
    let of_body = |id: BodyId| {
        let body = &simulator[id];
        let ([place, velocity], spin) = ([body.position(), body.linear_velocity()], body.angular_velocity());
        [place.x, place.y, body.total_rotation(), velocity.x, velocity.y, spin].map(f32::to_bits)
    };
    simulator.body_list().iter().map(|&id| of_body(id)).collect()
}

#[test]
fn an_island_at_rest_has_no_velocity_and_keeps_its_pose_bit_by_bit() {
    let (mut simulator, _) = standing_table();
    let before = state(&simulator);
    assert!(before.iter().all(|[_, _, _, x, y, spin]| [x, y, spin].iter().all(|&&bits| bits == 0)));
    run(&mut simulator, 600);
    assert_eq!(state(&simulator), before);
}

#[test]
fn islands_at_rest_stay_at_rest_at_any_rotation_by_a_right_angle() {
    // Rounding turns a pose of 0 to the f32 next to a full turn and back.
    for quarter in 0..4 {
        let mut simulator = precise(GRAVITY);
        simulator.set_sleep_enabled(false);
        let table = add_table(&mut simulator);
        let angle = std::f32::consts::FRAC_PI_2 * quarter as f32;
        let block = add_box(&mut simulator, [30.0, -58.0], [20.0, 20.0], 5.0);
        simulator[block].set_rotation(angle);
        JointFactory::create_weld_joint_in(&mut simulator, table.plate, block, v(30.0, -48.0)).unwrap();
        run(&mut simulator, 300);
        let before = state(&simulator);
        run(&mut simulator, 60);
        assert_eq!(state(&simulator), before, "{quarter} quarters");
    }
}

/// A name, and a change that a game may make.
type Change = (&'static str, fn(&mut PhysicsSimulator, &Table));

/// The pointer or the plate moves by each.
const CHANGES: [Change; 8] = [
    ("a motor", |simulator, table| {
        let motor = JointMotor { speed: 1.0, greatest_effort: 1e6 };
        simulator.set_joint_motor(table.hinge, Some(motor)).unwrap();
    }),
    ("no motor, and a push", |simulator, table| {
        simulator.set_joint_motor(table.hinge, None).unwrap();
        simulator[table.pointer].set_angular_velocity(0.1);
    }),
    ("a force", |simulator, table| {
        simulator[table.plate].apply_force(v(40_000.0, 0.0));
    }),
    ("gravity", |simulator, _| simulator.set_gravity(v(300.0, GRAVITY)).unwrap()),
    ("a belt", |simulator, table| simulator[table.floor].set_linear_velocity(v(50.0, 0.0))),
    ("a velocity", |simulator, table| simulator[table.plate].set_linear_velocity(v(0.0, -50.0))),
    ("a pose of the floor", |simulator, table| simulator[table.floor].set_position(v(0.0, 30.0))),
    ("a joint less", |simulator, table| simulator.dispose(table.hinge).unwrap()),
];

#[test]
fn any_change_is_detected_at_once() {
    for (name, change) in CHANGES {
        let (mut simulator, table) = standing_table();
        let before = state(&simulator);
        change(&mut simulator, &table);
        run(&mut simulator, 10);
        assert_ne!(state(&simulator), before, "{name}");
    }
}

#[test]
fn skipped_islands_equal_islands_that_are_solved_in_every_update() {
    // A restored simulator has no record that the island was at rest.
    for (name, change) in CHANGES {
        let (mut simulator, table) = standing_table();
        let mut restored = simulator.clone();
        for step in 0..40 {
            if step == 20 {
                change(&mut simulator, &table);
                change(&mut restored, &table);
            }
            simulator.update(DT);
            let mut next = precise(1.0);
            next.restore(&restored.snapshot()).unwrap();
            restored = next;
            restored.update(DT);
            assert_eq!(state(&restored), state(&simulator), "{name}, step {step}");
        }
    }
}

#[test]
fn a_platform_that_starts_to_slide_carries_its_load() {
    let mut simulator = precise(GRAVITY);
    simulator.set_sleep_enabled(false);
    let table = add_table(&mut simulator);
    simulator[table.floor].set_is_static(false);
    simulator[table.floor].set_is_kinematic(true);
    run(&mut simulator, 120);
    let before = simulator[table.plate].position();
    simulator[table.floor].set_linear_velocity(v(5.0, 0.0));
    run(&mut simulator, 60);
    let way = simulator[table.plate].position().x - before.x;
    // Friction takes it to 5 units/s within the first update.
    assert!((way - 5.0).abs() < 0.1, "{way}");
}

#[test]
fn a_body_slides_when_its_friction_is_removed() {
    let (mut simulator, table) = standing_table();
    // A fifth of the weight: less than friction of 0.5 holds.
    simulator.set_gravity(v(0.2 * GRAVITY, GRAVITY)).unwrap();
    run(&mut simulator, 120);
    let held = state(&simulator);
    run(&mut simulator, 60);
    assert_eq!(state(&simulator), held);
    let geoms: Vec<_> = simulator.geoms().collect();
    geoms.into_iter().for_each(|geom| simulator[geom].set_friction_coefficient(0.0));
    let before = simulator[table.plate].position();
    run(&mut simulator, 60);
    let way = simulator[table.plate].position().x - before.x;
    // Half of the acceleration times a second squared; the first substep may be lost.
    assert!((way - 0.1 * GRAVITY).abs() < 0.02 * 0.1 * GRAVITY, "{way}");
}

#[test]
fn a_pendulum_on_a_body_at_rest_swings_back_from_zero_speed() {
    let (mut simulator, table) = standing_table();
    let bob = add_box(&mut simulator, [0.0, -28.0], [4.0, 16.0], 1.0);
    JointFactory::create_revolute_joint_in(&mut simulator, table.plate, bob, v(0.0, -40.0)).unwrap();
    // The spin that gravity takes away in one update, at 0.05 radians.
    let (angle, arm) = (0.05_f32, 12.0);
    simulator[bob].set_position(v(-arm * angle.sin(), -40.0 + arm * angle.cos()));
    simulator[bob].set_rotation(angle);
    let inertia = simulator[bob].moment_of_inertia() + arm * arm;
    simulator[bob].set_angular_velocity(GRAVITY * arm * angle.sin() / inertia * DT);
    let spin = simulator[bob].angular_velocity();
    simulator[bob].set_linear_velocity(v(-arm * angle.cos(), -arm * angle.sin()) * spin);
    run(&mut simulator, 60);
    assert!((simulator[bob].rotation() - angle).abs() > 0.01, "{}", simulator[bob].rotation());
}

#[test]
fn a_change_of_mass_at_rest_counts_from_then_on() {
    let (mut simulator, table) = standing_table();
    simulator[table.pointer].set_mass(3.0).unwrap();
    run(&mut simulator, 2);
    let force = simulator[table.hinge].force();
    assert!((force.norm() - 3.0 * GRAVITY).abs() < 0.01 * 3.0 * GRAVITY, "{force}");
}
