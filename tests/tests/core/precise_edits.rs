//! The precise set: shapes and positions that are edited while bodies touch them, rest on them or sleep.

use farseer_core::math::Vector2;
use farseer_core::shape::Vertices;
use farseer_core::{
    BodyFactory, BodyId, Contact, Context, EventHandler, GeomFactory, GeomId, GeomPlacement, JointFactory,
    Methods, PhysicsSimulator,
};

const DT: f32 = 1.0 / 60.0;
/// Penetration and separation of bodies at rest, px. Measured: at most 0.003, and 0.023 in a stack that has come down.
const AT_REST: f32 = 0.05;

fn v(x: f32, y: f32) -> Vector2 {
    Vector2::new(x, y)
}

fn precise(gravity: f32) -> PhysicsSimulator {
    let mut simulator = PhysicsSimulator::new(v(0.0, gravity)).unwrap();
    simulator.set_methods(Methods::PRECISE).unwrap();
    simulator.set_iterations(4);
    simulator
}

fn add_box(simulator: &mut PhysicsSimulator, at: Vector2, [width, height]: [f32; 2]) -> (BodyId, GeomId) {
    let body = BodyFactory::create_rectangle_body_in(simulator, width, height, 1.0).unwrap();
    simulator[body].set_position(at);
    let placement = GeomPlacement::default();
    let geom = GeomFactory::create_rectangle_geom_in(simulator, body, width, height, placement).unwrap();
    simulator[geom].set_friction_coefficient(0.5);
    (body, geom)
}

fn add_static(simulator: &mut PhysicsSimulator, at: Vector2, size: [f32; 2]) -> (BodyId, GeomId) {
    let added = add_box(simulator, at, size);
    simulator[added.0].set_is_static(true);
    added
}

fn rectangle([width, height]: [f32; 2]) -> Vertices {
    Vertices::create_rectangle(width, height).unwrap()
}

fn reshape(simulator: &mut PhysicsSimulator, geom: GeomId, size: [f32; 2]) {
    simulator.set_vertices(geom, rectangle(size)).unwrap();
}

fn run(simulator: &mut PhysicsSimulator, seconds: f32) {
    run_by(simulator, seconds, DT);
}

fn run_by(simulator: &mut PhysicsSimulator, seconds: f32, dt: f32) {
    (0..(seconds / dt).round() as usize).for_each(|_| simulator.update(dt));
}

fn y(simulator: &PhysicsSimulator, body: BodyId) -> f32 {
    simulator[body].position().y
}

#[track_caller]
fn assert_y(simulator: &PhysicsSimulator, body: BodyId, expected: f32) {
    let y = y(simulator, body);
    assert!((y - expected).abs() < AT_REST, "y {y} instead of {expected}");
}

/// A simulator that was saved and loaded.
fn restored(simulator: &PhysicsSimulator) -> PhysicsSimulator {
    let mut copy = PhysicsSimulator::default();
    copy.restore(&simulator.snapshot()).unwrap();
    copy
}

/// A floor with its top at y = 0, and on it a box of 32: the floor's geom, the box.
fn box_on_floor() -> (PhysicsSimulator, GeomId, (BodyId, GeomId)) {
    let mut simulator = precise(900.0);
    let (_, floor) = add_static(&mut simulator, v(0.0, 20.0), [800.0, 40.0]);
    let thing = add_box(&mut simulator, v(0.0, -16.0), [32.0, 32.0]);
    (simulator, floor, thing)
}

#[test]
fn a_box_that_is_halved_sinks_to_the_floor_awake_and_asleep_and_at_all_steps() {
    for (rest, dt) in [(0.2, DT), (2.0, DT), (2.0, 1.0 / 30.0), (2.0, 1.0 / 120.0)] {
        let (mut simulator, _, (body, geom)) = box_on_floor();
        run_by(&mut simulator, rest, dt);
        assert_eq!(simulator.is_asleep(body), rest > 1.0);
        reshape(&mut simulator, geom, [32.0, 16.0]);
        run_by(&mut simulator, 1.5, dt);
        assert_y(&simulator, body, -8.0);
        assert!(simulator.is_asleep(body));
    }
}

#[test]
fn the_stack_on_a_floor_sinks_when_the_floor_is_halved() {
    let (mut simulator, floor, (low, _)) = box_on_floor();
    let (high, _) = add_box(&mut simulator, v(0.0, -48.0), [32.0, 32.0]);
    run(&mut simulator, 2.0);
    assert!(simulator.is_asleep(high));
    reshape(&mut simulator, floor, [800.0, 20.0]);
    run(&mut simulator, 1.5);
    assert_y(&simulator, low, -6.0);
    assert_y(&simulator, high, -38.0);
}

#[test]
fn queries_see_a_new_outline_where_its_body_is_at_once() {
    let mut simulator = precise(900.0);
    let (_, geom) = add_static(&mut simulator, v(1000.0, 20.0), [40.0, 40.0]);
    simulator.update(DT);
    reshape(&mut simulator, geom, [400.0, 40.0]);
    for _ in 0..2 {
        assert!(simulator.geom_collides_with_point(geom, v(1150.0, 20.0)));
        assert!(!simulator.geom_collides_with_point(geom, v(0.0, 0.0)));
        let aabb = simulator.geom(geom).unwrap().aabb();
        assert_eq!((aabb.min, aabb.max), (v(800.0, 0.0), v(1200.0, 40.0)));
        simulator.update(DT);
    }
}

#[test]
fn a_resized_static_box_supports_bodies_on_its_new_shape_alone() {
    for is_restored in [false, true] {
        let mut simulator = precise(900.0);
        let (_, shrunk) = add_static(&mut simulator, v(0.0, 20.0), [400.0, 40.0]);
        let (_, grown) = add_static(&mut simulator, v(1000.0, 20.0), [40.0, 40.0]);
        let over_end = add_box(&mut simulator, v(150.0, -16.0), [32.0, 32.0]).0;
        run(&mut simulator, 1.0);
        assert_y(&simulator, over_end, -16.0);
        reshape(&mut simulator, shrunk, [40.0, 40.0]);
        reshape(&mut simulator, grown, [400.0, 40.0]);
        if is_restored {
            simulator = restored(&simulator);
        }
        let late = add_box(&mut simulator, v(1150.0, -60.0), [32.0, 32.0]).0;
        run(&mut simulator, 1.0);
        assert!(y(&simulator, over_end) > 100.0);
        assert_y(&simulator, late, -16.0);
    }
}

#[test]
fn an_edited_shape_goes_on_with_the_same_bits_after_a_restore() {
    let (mut simulator, floor, (body, geom)) = box_on_floor();
    let (high, _) = add_box(&mut simulator, v(0.0, -48.0), [32.0, 32.0]);
    run(&mut simulator, 1.0);
    reshape(&mut simulator, geom, [32.0, 16.0]);
    reshape(&mut simulator, floor, [800.0, 20.0]);
    simulator[high].set_position(v(4.0, -48.0));
    let mut twin = restored(&simulator);
    for _ in 0..180 {
        simulator.update(DT);
        twin.update(DT);
        assert!(simulator.snapshot() == twin.snapshot());
        twin = restored(&twin);
    }
    assert_y(&simulator, body, 2.0);
}

#[test]
fn a_box_that_grows_in_a_gap_pushes_its_neighbours_out_without_throwing_them() {
    let mut simulator = precise(0.0);
    let left = add_box(&mut simulator, v(-26.0, 0.0), [20.0, 20.0]).0;
    let (_, grown) = add_box(&mut simulator, v(0.0, 0.0), [20.0, 20.0]);
    let right = add_box(&mut simulator, v(26.0, 0.0), [20.0, 20.0]).0;
    run(&mut simulator, 2.0);
    reshape(&mut simulator, grown, [40.0, 20.0]);
    let mut fastest = 0.0_f32;
    for _ in 0..120 {
        simulator.update(DT);
        fastest = [left, right]
            .iter()
            .fold(fastest, |most, &body| most.max(simulator[body].linear_velocity().norm()));
    }
    let gap = simulator[right].position().x - simulator[left].position().x;
    assert!(gap > 59.9, "{gap}");
    // Penetration of 4 px is undone at 4 length units/s, 128 px/s, at most.
    assert!(fastest < 130.0, "{fastest}");
}

#[test]
fn a_floor_that_grows_lifts_bodies_asleep_on_it() {
    let (mut simulator, floor, (body, _)) = box_on_floor();
    run(&mut simulator, 2.0);
    assert!(simulator.is_asleep(body));
    reshape(&mut simulator, floor, [800.0, 48.0]);
    run(&mut simulator, 2.0);
    assert_y(&simulator, body, -20.0);
}

#[test]
fn a_polygon_that_changes_its_kind_of_outline_collides_with_its_new_outline() {
    // A valley whose ground is at y = 10 in the middle, of several convex pieces; a roof with its ridge at y = -20.
    let valley = [[-100.0, 0.0], [-40.0, 10.0], [40.0, 10.0], [100.0, 0.0], [100.0, 40.0], [-100.0, 40.0]];
    let roof = [[0.0, -20.0], [100.0, 20.0], [-100.0, 20.0]];
    let outline = |corners: &[[f32; 2]]| corners.iter().map(|&[x, y]| v(x, y - 20.0)).collect::<Vertices>();
    let mut simulator = precise(900.0);
    let (_, ground) = add_static(&mut simulator, v(0.0, 20.0), [200.0, 40.0]);
    let (body, geom) = add_box(&mut simulator, v(0.0, -10.0), [20.0, 20.0]);
    simulator[geom].set_friction_coefficient(1.0);
    run(&mut simulator, 2.0);
    assert_y(&simulator, body, -10.0);
    simulator.set_vertices(ground, outline(&valley)).unwrap();
    run(&mut simulator, 2.0);
    assert_y(&simulator, body, 0.0);
    simulator.set_vertices(ground, outline(&roof)).unwrap();
    simulator[body].set_position(v(0.0, -60.0));
    simulator.update(DT);
    run(&mut simulator, 1.0);
    assert!(y(&simulator, body) < 100.0 || simulator[body].position().x.abs() > 90.0);
    reshape(&mut simulator, ground, [200.0, 40.0]);
    simulator[body].set_position(v(0.0, -30.0));
    simulator[body].set_rotation(0.0);
    simulator[body].set_linear_velocity(v(0.0, 0.0));
    simulator[body].set_angular_velocity(0.0);
    run(&mut simulator, 2.0);
    assert_y(&simulator, body, -10.0);
}

#[test]
fn a_kinematic_and_a_hanging_body_have_their_new_outline() {
    let mut simulator = precise(900.0);
    let (lift, top) = add_box(&mut simulator, v(0.0, 20.0), [200.0, 40.0]);
    simulator[lift].set_is_kinematic(true);
    let body = add_box(&mut simulator, v(0.0, -16.0), [32.0, 32.0]).0;
    // It hangs 60 px above the lift's right end, on a pin.
    let (post, of_post) = add_static(&mut simulator, v(80.0, -200.0), [10.0, 10.0]);
    let (hanging, of_hanging) = add_box(&mut simulator, v(80.0, -70.0), [20.0, 20.0]);
    [of_post, of_hanging].into_iter().for_each(|geom| simulator[geom].set_collision_group(1));
    JointFactory::create_pin_joint_in(&mut simulator, post, v(0.0, 0.0), hanging, v(0.0, 0.0)).unwrap();
    run(&mut simulator, 2.0);
    reshape(&mut simulator, top, [200.0, 20.0]);
    run(&mut simulator, 2.0);
    assert_y(&simulator, body, -6.0);
    // Grown down to 2 px below the lift's top at y = 10, it touches that.
    reshape(&mut simulator, of_hanging, [20.0, 164.0]);
    simulator.update(DT);
    assert_eq!(simulator.overlaps(of_hanging), [top]);
}

#[test]
fn several_edits_in_one_frame_count_as_the_last_one() {
    let (mut simulator, floor, (body, geom)) = box_on_floor();
    run(&mut simulator, 2.0);
    reshape(&mut simulator, geom, [32.0, 80.0]);
    reshape(&mut simulator, floor, [800.0, 80.0]);
    reshape(&mut simulator, geom, [32.0, 16.0]);
    reshape(&mut simulator, floor, [800.0, 20.0]);
    run(&mut simulator, 2.0);
    assert_y(&simulator, body, 2.0);
    // A change that is undone within a frame wakes no body.
    assert!(simulator.is_asleep(body));
    reshape(&mut simulator, geom, [32.0, 80.0]);
    reshape(&mut simulator, geom, [32.0, 16.0]);
    simulator.update(DT);
    assert!(simulator.is_asleep(body));
}

/// Halves a geom when it touches another one.
struct Halves(GeomId, bool);

impl EventHandler for Halves {
    fn on_collision(
        &mut self,
        context: &mut Context<'_>,
        _: GeomId,
        _: GeomId,
        _: &mut Vec<Contact>,
    ) -> bool {
        if !std::mem::replace(&mut self.1, true) {
            context.set_vertices(self.0, rectangle([32.0, 16.0])).unwrap();
        }
        true
    }
}

#[test]
fn an_edit_in_a_callback_counts() {
    let (mut simulator, _, (body, geom)) = box_on_floor();
    simulator[body].set_position(v(0.0, -40.0));
    let mut halves = Halves(geom, false);
    (0..120).for_each(|_| simulator.update_with(DT, &mut halves));
    assert!(halves.1);
    assert_y(&simulator, body, -8.0);
}

#[test]
fn edits_of_a_disabled_body_count_once_it_is_enabled() {
    let (mut simulator, floor, (body, geom)) = box_on_floor();
    run(&mut simulator, 2.0);
    simulator[body].set_enabled(false);
    run(&mut simulator, 0.2);
    reshape(&mut simulator, geom, [32.0, 16.0]);
    reshape(&mut simulator, floor, [800.0, 20.0]);
    run(&mut simulator, 0.2);
    simulator[body].set_enabled(true);
    run(&mut simulator, 1.5);
    assert_y(&simulator, body, 2.0);
}

#[test]
fn a_sleeping_body_falls_if_it_or_its_floor_is_teleported() {
    let (mut simulator, floor, (body, _)) = box_on_floor();
    let other = add_box(&mut simulator, v(100.0, -16.0), [32.0, 32.0]).0;
    run(&mut simulator, 2.0);
    assert!(simulator.is_asleep(body) && simulator.is_asleep(other));
    simulator[body].set_position(v(-100.0, -60.0));
    run(&mut simulator, 2.0);
    assert_y(&simulator, body, -16.0);
    assert!(simulator.is_asleep(other));
    let floor_body = simulator.body_of(floor).unwrap();
    simulator[floor_body].set_position(v(0.0, 50.0));
    run(&mut simulator, 2.0);
    [body, other].into_iter().for_each(|body| assert_y(&simulator, body, 14.0));
    simulator[floor_body].set_rotation(std::f32::consts::PI);
    run(&mut simulator, 2.0);
    [body, other].into_iter().for_each(|body| assert_y(&simulator, body, 14.0));
}

#[test]
fn the_offset_of_a_geom_is_turned_with_it() {
    let mut simulator = precise(0.0);
    let body = BodyFactory::create_rectangle_body_in(&mut simulator, 10.0, 10.0, 1.0).unwrap();
    let placement = GeomPlacement::at(v(0.0, 15.0)).turned(std::f32::consts::FRAC_PI_2);
    let geom = GeomFactory::create_rectangle_geom_in(&mut simulator, body, 4.0, 4.0, placement).unwrap();
    let (_, wall) = add_static(&mut simulator, v(-22.0, 0.0), [10.0, 10.0]);
    let place = simulator.geom(geom).unwrap().position();
    // A quarter turn is rounded: sine and cosine are exact to 1e-7.
    assert!((place - v(-15.0, 0.0)).norm() < 1e-4, "{place:?}");
    // Its left side is at -17, and so is the wall's right side.
    simulator[body].set_position(v(-0.5, 0.0));
    simulator.update(DT);
    assert_eq!(simulator.overlaps(geom), [wall]);
}
