//! Objects meet in three axes: the axis of the contact, its effect, and the velocities that it leaves unchanged.
//!
//! Without gravity unless a test says otherwise, high above the ground. Tolerances: a contact is found at the end of a step, up
//! to v dt late; the impulse of a single contact point is exact but for rounding.

use conformance::fixtures::depth::{
    DT, GRAVITY, SLOP, assert_near, assert_near3, ball, collisions_of, crate_box, fix, geom_of, momentum,
    place, platform, run, run_until_hit, set_surface, simulator, solid, throw, velocity, weightless,
};
use twohalf::{Axis, BodyId, Collision, ContactTarget, TwoHalfPhysicsSimulator, Vector3};

/// Velocities of a few hundred px/s after a few hundred operations of f32.
const ROUNDING: f32 = 1e-3;

/// A box of 40 x 40 x 40 whose middle is at (0, 520, 0), immovable.
fn post(simulator: &mut TwoHalfPhysicsSimulator) -> BodyId {
    let body = solid(simulator, [40.0, 40.0, 40.0], [0.0, 500.0, 0.0]);
    fix(simulator, body);
    body
}

#[test]
pub(crate) fn objects_pass_in_front_of_and_behind_each_other() {
    for is_ball in [true, false] {
        for z in [-30.1, 30.1, -80.0, 80.0] {
            let mut simulator = weightless();
            post(&mut simulator);
            let body = match is_ball {
                true => ball(&mut simulator, 10.0, [-100.0, 510.0, z]),
                false => solid(&mut simulator, [20.0, 20.0, 20.0], [-100.0, 510.0, z]),
            };
            throw(&mut simulator, body, [80.0, 0.0, 0.0]);
            run(&mut simulator, 250);
            assert_eq!(velocity(&simulator, body), Vector3::new(80.0, 0.0, 0.0), "{z}");
            assert_near3(place(&simulator, body), [100.0, 510.0, z], 0.01);
        }
    }
}

#[test]
pub(crate) fn boxes_whose_faces_only_touch_in_depth_pass_each_other() {
    let mut simulator = weightless();
    post(&mut simulator);
    let body = solid(&mut simulator, [20.0, 20.0, 20.0], [-100.0, 510.0, 30.0]);
    throw(&mut simulator, body, [80.0, 0.0, 0.0]);
    run(&mut simulator, 250);
    assert_eq!(velocity(&simulator, body), Vector3::new(80.0, 0.0, 0.0));
}

#[test]
fn a_figure_is_thrown_over_another_along_x_along_z_and_obliquely() {
    for direction in [[1.0, 0.0], [0.0, 1.0], [0.6, -0.8]] {
        for is_ball in [true, false] {
            let mut simulator = simulator();
            let other = solid(&mut simulator, [30.0, 40.0, 20.0], [0.0, 0.0, 0.0]);
            let [x, z] = direction.map(|part: f32| part * 100.0);
            let body = match is_ball {
                true => ball(&mut simulator, 10.0, [-x, 0.0, -z]),
                false => solid(&mut simulator, [20.0, 20.0, 20.0], [-x, 0.0, -z]),
            };
            // 72 px high after 1.2 s over the other's middle.
            throw(&mut simulator, body, [x / 1.2, 120.0, z / 1.2]);
            let geom = geom_of(&simulator, body);
            for _ in 0..235 {
                simulator.update(DT);
                assert!(collisions_of(&simulator, geom).is_empty());
            }
            assert_near3(
                place(&simulator, body),
                [x * 0.96, 120.0 * 2.35 - 50.0 * 2.35 * 2.36, z * 0.96],
                1.0,
            );
            assert_near3(place(&simulator, other), [0.0, 0.0, 0.0], SLOP + 0.02);
        }
    }
}

/// Throws a box of 20 x 20 x 20 at the post, its middle at `start` from the post's, and returns its first collision. They
/// overlap along an axis when their middles are less than 30 px apart.
fn first_hit(start: [f32; 3], speed: [f32; 3]) -> Collision {
    let mut simulator = weightless();
    post(&mut simulator);
    let [x, y, z] = start;
    let body = solid(&mut simulator, [20.0, 20.0, 20.0], [x, 510.0 + y, z]);
    throw(&mut simulator, body, speed);
    let geom = geom_of(&simulator, body);
    run_until_hit(&mut simulator, geom)
}

#[test]
pub(crate) fn two_boxes_that_come_together_diagonally_meet_along_the_axis_that_they_enter_last() {
    for (start, speed, expected) in [
        // Gaps of 20 and 40.3 px, closing equally.
        ([-50.0, 0.0, -70.3], [300.0, 0.0, 300.0], [0.0, 0.0, -1.0]),
        ([-70.3, 0.0, -50.0], [300.0, 0.0, 300.0], [-1.0, 0.0, 0.0]),
        ([50.0, 0.0, 70.3], [-300.0, 0.0, -300.0], [0.0, 0.0, 1.0]),
        ([70.3, 0.0, 50.0], [-300.0, 0.0, -300.0], [1.0, 0.0, 0.0]),
        // The wider gap is closed first.
        ([-50.0, 0.0, -60.3], [300.0, 0.0, 900.0], [-1.0, 0.0, 0.0]),
        ([-60.3, 0.0, -50.0], [900.0, 0.0, 300.0], [0.0, 0.0, -1.0]),
        // From above and from below.
        ([5.0, 70.3, -50.0], [0.0, -300.0, 300.0], [0.0, 1.0, 0.0]),
        ([5.0, 50.0, -70.3], [0.0, -300.0, 300.0], [0.0, 0.0, -1.0]),
        ([5.0, -70.3, 50.0], [0.0, 300.0, -300.0], [0.0, -1.0, 0.0]),
        ([5.0, -50.0, 70.3], [0.0, 300.0, -300.0], [0.0, 0.0, 1.0]),
        // All three.
        ([-40.0, -50.0, -70.3], [300.0, 300.0, 300.0], [0.0, 0.0, -1.0]),
        ([-70.3, -50.0, -40.0], [300.0, 300.0, 300.0], [-1.0, 0.0, 0.0]),
        ([-40.0, 70.3, -50.0], [300.0, -300.0, 300.0], [0.0, 1.0, 0.0]),
    ] {
        let hit = first_hit(start, speed);
        assert_near3(hit.normal, expected, 1e-6);
        assert_eq!(hit.axis, if expected[2] == 0.0 { Axis::Plane } else { Axis::Depth }, "{start:?}");
    }
}

#[test]
fn a_pair_that_enters_both_axes_at_once_meets_along_the_one_with_the_smaller_overlap() {
    // Both gaps are closed after 0.1005 s; half a step later the faster axis has the greater overlap.
    let along_z = first_hit([-60.15, 0.0, -50.1], [300.0, 0.0, 200.0]);
    assert_eq!(along_z.axis, Axis::Depth);
    let along_x = first_hit([-50.1, 0.0, -60.15], [200.0, 0.0, 300.0]);
    assert_eq!(along_x.axis, Axis::Plane);
}

#[test]
pub(crate) fn a_pair_without_relative_motion_along_z_meets_in_the_plane_at_any_overlap_in_depth() {
    let hit = first_hit([-50.0, 0.0, 29.9], [900.0, 0.0, 0.0]);
    assert_eq!(hit.axis, Axis::Plane);
}

/// Presses a box against the front of the post (`press` along Z) or against its left side, and lets it slide along until it has
/// gone past. Returns the velocity along the slide, and the axes of all contacts.
fn slide_along(is_front: bool) -> (f32, Vec<Axis>) {
    let mut simulator = weightless();
    post(&mut simulator);
    let start = if is_front { [-5.0, 510.0, -30.0] } else { [-30.0, 510.0, -5.0] };
    let body = solid(&mut simulator, [20.0, 20.0, 20.0], start);
    let geom = geom_of(&simulator, body);
    let (push, slide) = match is_front {
        true => (Vector3::new(0.0, 0.0, 200.0), Vector3::new(1.0, 0.0, 0.0)),
        false => (Vector3::new(200.0, 0.0, 0.0), Vector3::new(0.0, 0.0, 1.0)),
    };
    let mut axes = Vec::new();
    for step in 0..400 {
        if step == 50 {
            simulator.body_mut(body).unwrap().set_velocity3d(slide * 20.0);
        }
        simulator.body_mut(body).unwrap().apply_force3d(push);
        simulator.update(DT);
        axes.extend(collisions_of(&simulator, geom).iter().map(|collision| collision.axis));
    }
    (velocity(&simulator, body).dot(&slide), axes)
}

#[test]
fn a_pair_keeps_its_contact_axis_until_it_separates() {
    for (is_front, axis) in [(true, Axis::Depth), (false, Axis::Plane)] {
        let (speed, axes) = slide_along(is_front);
        // 35 px at 20 px/s after the first half second: longer than the others' overlap stays the greater one.
        assert!(axes.len() > 200 && axes.len() < 399, "{}", axes.len());
        assert!(axes.iter().all(|&met| met == axis));
        // No impulse acted along the slide.
        assert_near(speed, 20.0, ROUNDING);
    }
}

#[test]
fn crossed_bars_meet_along_z_where_they_cross() {
    let mut simulator = weightless();
    let upright = solid(&mut simulator, [10.0, 100.0, 10.0], [0.0, 500.0, 0.0]);
    let level = solid(&mut simulator, [100.0, 10.0, 10.0], [0.0, 545.0, -40.0]);
    throw(&mut simulator, level, [0.0, 0.0, 80.0]);
    let geom = geom_of(&simulator, level);
    let hit = run_until_hit(&mut simulator, geom);
    assert_eq!((hit.axis, hit.normal, hit.contacts), (Axis::Depth, Vector3::new(0.0, 0.0, -1.0), 2));
    for contact in simulator.contacts() {
        assert_near(contact.position.x.abs(), 5.0, ROUNDING);
        assert_near((contact.position.y - 550.0).abs(), 5.0, ROUNDING);
    }
    run(&mut simulator, 20);
    for body in [upright, level] {
        assert_near3(velocity(&simulator, body), [0.0, 0.0, 40.0], ROUNDING);
    }
}

#[test]
pub(crate) fn crossed_bars_at_different_heights_pass_along_z() {
    let mut simulator = weightless();
    solid(&mut simulator, [10.0, 100.0, 10.0], [0.0, 500.0, 0.0]);
    let level = solid(&mut simulator, [100.0, 10.0, 10.0], [0.0, 601.0, -40.0]);
    throw(&mut simulator, level, [0.0, 0.0, 80.0]);
    run(&mut simulator, 100);
    assert_eq!(velocity(&simulator, level), Vector3::new(0.0, 0.0, 80.0));
}

#[test]
pub(crate) fn slanted_bars_whose_boxes_overlap_but_whose_outlines_do_not_pass_along_z() {
    let mut simulator = weightless();
    let bars = [0.0, 40.0].map(|x| solid(&mut simulator, [100.0, 10.0, 10.0], [x, 500.0, -2.0 * x]));
    for body in bars {
        let mut view = simulator.body_mut(body).unwrap();
        view.set_rotation(std::f32::consts::FRAC_PI_4);
        let place = view.position3d();
        view.set_position3d(Vector3::new(place.x, 500.0, place.z));
    }
    throw(&mut simulator, bars[1], [0.0, 0.0, 80.0]);
    run(&mut simulator, 200);
    assert_eq!(velocity(&simulator, bars[1]), Vector3::new(0.0, 0.0, 80.0));
}

/// A box on another one, pressed together by 100 px/s² of force on both; no gravity and no ground.
fn pressed_stack(masses: [f32; 2], friction: f32) -> (TwoHalfPhysicsSimulator, [BodyId; 2]) {
    let mut simulator = weightless();
    let lower = solid(&mut simulator, [200.0, 20.0, 300.0], [0.0, 500.0, 0.0]);
    let upper = solid(&mut simulator, [40.0, 20.0, 40.0], [0.0, 520.0, 0.0]);
    for (body, mass) in [lower, upper].into_iter().zip(masses) {
        set_surface(&mut simulator, body, friction, 0.0);
        simulator.body_mut(body).unwrap().set_mass(mass).unwrap();
    }
    (simulator, [lower, upper])
}

fn run_pressed(simulator: &mut TwoHalfPhysicsSimulator, [lower, upper]: [BodyId; 2], steps: usize) {
    for _ in 0..steps {
        simulator.body_mut(lower).unwrap().apply_force3d(Vector3::new(0.0, 100.0, 0.0));
        simulator.body_mut(upper).unwrap().apply_force3d(Vector3::new(0.0, -100.0, 0.0));
        simulator.update(DT);
    }
}

#[test]
pub(crate) fn a_box_that_slides_on_another_in_depth_drags_it_with_friction_times_pressure() {
    let (mut simulator, bodies) = pressed_stack([3.0, 1.0], 0.3);
    run_pressed(&mut simulator, bodies, 20);
    throw(&mut simulator, bodies[1], [0.0, 0.0, 40.0]);
    run_pressed(&mut simulator, bodies, 50);
    // Half a second of 0.3 x 100: 15 px/s for the upper one, a third of it for the lower one.
    assert_near(velocity(&simulator, bodies[1]).z, 40.0 - 15.0, 0.02);
    assert_near(velocity(&simulator, bodies[0]).z, 5.0, 0.02);
    assert_near(momentum(&simulator, &bodies).z, 40.0, ROUNDING);
}

#[test]
pub(crate) fn a_box_that_slid_on_another_in_depth_ends_up_moving_with_it() {
    let (mut simulator, bodies) = pressed_stack([3.0, 1.0], 0.3);
    run_pressed(&mut simulator, bodies, 20);
    throw(&mut simulator, bodies[1], [0.0, 0.0, 40.0]);
    run_pressed(&mut simulator, bodies, 200);
    for body in bodies {
        assert_near(velocity(&simulator, body).z, 10.0, ROUNDING);
        assert_near(simulator.body(body).unwrap().angular_velocity(), 0.0, ROUNDING);
    }
}

#[test]
pub(crate) fn without_friction_a_box_slides_on_another_in_depth_for_ever() {
    let (mut simulator, bodies) = pressed_stack([3.0, 1.0], 0.0);
    run_pressed(&mut simulator, bodies, 20);
    throw(&mut simulator, bodies[1], [0.0, 0.0, 40.0]);
    run_pressed(&mut simulator, bodies, 200);
    assert_eq!([velocity(&simulator, bodies[1]).z, velocity(&simulator, bodies[0]).z], [40.0, 0.0]);
}

#[test]
pub(crate) fn a_box_that_slides_obliquely_on_another_stops_straight_after_v_squared_over_2_mu_g() {
    for [x, z] in [[0.6, 0.8], [0.8, -0.6], [0.0, 1.0], [-0.28, 0.96]] {
        let mut simulator = simulator();
        let table = solid(&mut simulator, [400.0, 20.0, 400.0], [0.0, 100.0, 0.0]);
        fix(&mut simulator, table);
        let body = solid(&mut simulator, [60.0, 20.0, 40.0], [0.0, 120.0, 0.0]);
        for body in [table, body] {
            set_surface(&mut simulator, body, 0.4, 0.0);
        }
        run(&mut simulator, 50);
        throw(&mut simulator, body, [100.0 * x, 0.0, 100.0 * z]);
        run(&mut simulator, 400);
        let end = place(&simulator, body);
        // v dt / 2 behind the parabola; a contact may be missed while the box settles.
        assert_near(end.x * x + end.z * z, 100.0 * 100.0 / (2.0 * 0.4 * GRAVITY), 1.5 * 100.0 * DT);
        assert_near(end.x * z - end.z * x, 0.0, 0.5);
        assert_near(velocity(&simulator, body).norm(), 0.0, ROUNDING);
    }
}

/// Presses a box that spins about Z against the front of the post and returns its spin after each step.
fn spins_against_front(friction: f32) -> Vec<f32> {
    let mut simulator = weightless();
    let wall = post(&mut simulator);
    let body = solid(&mut simulator, [30.0, 30.0, 20.0], [0.0, 505.0, -30.0]);
    for body in [wall, body] {
        set_surface(&mut simulator, body, friction, 0.0);
    }
    simulator.body_mut(body).unwrap().set_angular_velocity(3.0);
    let mut spins = vec![3.0];
    for _ in 0..200 {
        simulator.body_mut(body).unwrap().apply_force_z(100.0);
        simulator.update(DT);
        spins.push(simulator.body(body).unwrap().angular_velocity());
    }
    spins
}

#[test]
pub(crate) fn a_contact_along_z_stops_spin_about_z_by_friction_at_its_points() {
    let spins = spins_against_front(0.5);
    assert_near(spins[200], 0.0, ROUNDING);
    // 50 px/s² of friction at most half a diagonal (21.3 px) from the middle of a box with 150 px² of inertia. The first touch
    // has twice that, because the force of the step before was not resisted.
    let most = 0.5 * 100.0 * 21.3 / 150.0 * DT;
    for (index, pair) in spins.windows(2).enumerate() {
        let most = if index < 2 { 2.0 * most } else { most };
        assert!(pair[1] <= pair[0] + ROUNDING && pair[1] > pair[0] - most - ROUNDING, "{pair:?}");
    }
}

#[test]
pub(crate) fn without_friction_a_contact_along_z_leaves_spin_alone() {
    let spins = spins_against_front(0.0);
    assert!(spins.iter().all(|&spin| spin == 3.0));
}

#[test]
pub(crate) fn friction_along_z_contacts_slows_sliding_along_the_front() {
    let mut simulator = weightless();
    let wall = solid(&mut simulator, [400.0, 400.0, 40.0], [0.0, 500.0, 0.0]);
    fix(&mut simulator, wall);
    let body = solid(&mut simulator, [30.0, 30.0, 20.0], [0.0, 700.0, -30.0]);
    for body in [wall, body] {
        set_surface(&mut simulator, body, 0.5, 0.0);
    }
    throw(&mut simulator, body, [30.0, -40.0, 0.0]);
    for _ in 0..60 {
        simulator.body_mut(body).unwrap().apply_force_z(100.0);
        simulator.update(DT);
    }
    // 0.5 x 100 against the velocity. Force was on before the first contact for at most a step.
    let speed = 50.0 - 50.0 * 0.6;
    assert_near3(velocity(&simulator, body), [0.6 * speed, -0.8 * speed, 0.0], 50.0 * DT + 0.1);
}

#[test]
pub(crate) fn a_box_slides_in_depth_from_one_crate_to_the_next_without_stumbling() {
    for phase in 0..8 {
        let mut simulator = simulator();
        for z in [0.0, 60.0] {
            let crate_below = solid(&mut simulator, [80.0, 40.0, 60.0], [0.0, 0.0, z]);
            fix(&mut simulator, crate_below);
        }
        let body = solid(&mut simulator, [20.0, 20.0, 20.0], [0.0, 42.0, -phase as f32 / 8.0]);
        run(&mut simulator, 100);
        throw(&mut simulator, body, [0.0, 0.0, 50.0]);
        run(&mut simulator, 120);
        assert_near(velocity(&simulator, body).z, 50.0, 0.01);
        assert_near(place(&simulator, body).y, 40.0, SLOP + 0.02);
    }
}

#[test]
pub(crate) fn a_ball_rolls_in_depth_from_one_crate_to_the_next_without_stumbling() {
    for phase in 0..8 {
        let mut simulator = simulator();
        for z in [0.0, 60.0] {
            let crate_below = solid(&mut simulator, [80.0, 40.0, 60.0], [0.0, 0.0, z]);
            fix(&mut simulator, crate_below);
        }
        let body = ball(&mut simulator, 10.0, [0.0, 42.0, -phase as f32 / 8.0]);
        run(&mut simulator, 100);
        throw(&mut simulator, body, [0.0, 0.0, 50.0]);
        run(&mut simulator, 120);
        assert_near(velocity(&simulator, body).z, 50.0, 0.01);
        assert_near(place(&simulator, body).y, 40.0, SLOP + 0.02);
    }
}

#[test]
pub(crate) fn a_box_that_lands_2_px_inside_the_front_of_a_crate_at_16_px_per_step_stays_on_it() {
    for phase in 0..16 {
        let mut simulator = simulator();
        let below = solid(&mut simulator, [80.0, 60.0, 60.0], [0.0, 0.0, 0.0]);
        fix(&mut simulator, below);
        let body = solid(&mut simulator, [40.0, 20.0, 20.0], [0.0, 124.0 + phase as f32, -38.0]);
        throw(&mut simulator, body, [0.0, -1600.0, 0.0]);
        run(&mut simulator, 200);
        assert_near3(place(&simulator, body), [0.0, 60.0, -38.0], SLOP + 0.15);
    }
}

#[test]
pub(crate) fn a_ball_rests_on_a_crate_also_near_its_front_edge() {
    for z in [0.0, -18.0, 18.0] {
        let mut simulator = simulator();
        let below = solid(&mut simulator, [80.0, 40.0, 40.0], [0.0, 0.0, 0.0]);
        let body = ball(&mut simulator, 10.0, [5.0, 45.0, z]);
        for body in [below, body] {
            set_surface(&mut simulator, body, 0.3, 0.0);
        }
        run(&mut simulator, 300);
        assert_near3(place(&simulator, body), [5.0, 40.0, z], 2.0 * SLOP + 0.05);
        assert_near3(place(&simulator, below), [0.0, 0.0, 0.0], SLOP + 0.05);
    }
}

#[test]
pub(crate) fn a_ball_between_two_boxes_in_depth_stays_where_it_is() {
    let mut simulator = simulator();
    for z in [-30.0, 30.0] {
        let wall = solid(&mut simulator, [80.0, 60.0, 40.04], [0.0, 0.0, z]);
        fix(&mut simulator, wall);
    }
    let body = ball(&mut simulator, 10.0, [3.0, 0.0, 0.0]);
    run(&mut simulator, 300);
    assert_near3(place(&simulator, body), [3.0, 0.0, 0.0], SLOP + 0.02);
    assert_near(velocity(&simulator, body).norm(), 0.0, ROUNDING);
}

#[test]
pub(crate) fn a_ball_is_caught_between_two_boxes_that_close_in_on_it() {
    let mut simulator = weightless();
    let boxes = [-60.0, 60.0].map(|z| solid(&mut simulator, [60.0, 60.0, 40.0], [0.0, 500.0, z]));
    let body = ball(&mut simulator, 10.0, [0.0, 520.0, 0.0]);
    throw(&mut simulator, boxes[0], [0.0, 0.0, 50.0]);
    throw(&mut simulator, boxes[1], [0.0, 0.0, -50.0]);
    run(&mut simulator, 200);
    // Everything is symmetrical; five iterations leave a fraction of the speed.
    assert_near3(place(&simulator, body), [0.0, 520.0, 0.0], 1.0);
    for [near, far] in [[boxes[0], body], [body, boxes[1]]] {
        assert!(place(&simulator, far).z - place(&simulator, near).z > 30.0 - 1.0);
    }
    assert_near(momentum(&simulator, &[boxes[0], boxes[1], body]).z, 0.0, ROUNDING);
}

#[test]
pub(crate) fn a_ball_in_the_gap_between_two_crates_rests_on_both_edges() {
    for [x, z] in [[1.0, 0.0], [0.0, 1.0]] {
        let mut simulator = simulator();
        for sign in [-1.0, 1.0] {
            let crate_below =
                solid(&mut simulator, [60.0, 40.0, 60.0], [36.0 * sign * x, 0.0, 36.0 * sign * z]);
            fix(&mut simulator, crate_below);
            set_surface(&mut simulator, crate_below, 0.3, 0.0);
        }
        let body = ball(&mut simulator, 10.0, [0.0, 45.0, 0.0]);
        set_surface(&mut simulator, body, 0.3, 0.0);
        run(&mut simulator, 300);
        // The edges are 6 px beside its middle: sqrt(10² - 6²) = 8 px below it. Overlap is along the normals.
        assert_near3(place(&simulator, body), [0.0, 40.0 + 8.0 - 10.0, 0.0], SLOP / 0.8 + 0.05);
    }
}

/// A ball of radius 5 whose middle gets inside a block of 60 x 60 x 60 in one step of 40 px, nearer to another face than to the
/// one it came through. Returns its final position relative to the block's middle.
fn pushed_out(is_platform: bool, from: Vector3, aside: Vector3) -> Vector3 {
    let mut simulator = weightless();
    match is_platform {
        true => {
            platform(&mut simulator, [60.0, 60.0, 60.0], [0.0, 500.0, 0.0]);
        }
        false => {
            let block = solid(&mut simulator, [60.0, 60.0, 60.0], [0.0, 500.0, 0.0]);
            fix(&mut simulator, block);
        }
    }
    let middle = Vector3::new(0.0, 530.0, 0.0);
    let start = middle + from * 50.0 + aside;
    let body = ball(&mut simulator, 5.0, (start - Vector3::new(0.0, 5.0, 0.0)).into());
    throw(&mut simulator, body, (from * -4000.0).into());
    simulator.update(DT);
    let inside = simulator.body(body).unwrap().origin3d() - middle;
    assert!(inside.amax() < 30.0);
    run(&mut simulator, 30);
    simulator.body(body).unwrap().origin3d() - middle
}

#[test]
fn a_fast_ball_whose_middle_gets_inside_is_pushed_out_of_the_face_of_entry() {
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Vector3::from);
    for is_platform in [true, false] {
        for from in axes.iter().flat_map(|axis| [*axis, -axis]) {
            for aside in axes.iter().filter(|axis| axis.dot(&from) == 0.0) {
                // 3 px from the side, 20 px from the face it came through.
                let end = pushed_out(is_platform, from, aside * 27.0);
                let (out, beside) = (end.dot(&from), end - from * end.dot(&from));
                assert!((34.9..=36.0).contains(&out), "platform: {is_platform}, {from:?} {aside:?}: {end:?}");
                assert_near3(beside, (aside * 27.0).into(), 0.01);
            }
        }
    }
}

#[test]
fn a_ball_that_meets_a_moving_box_head_on_does_not_pass_through_it() {
    let mut simulator = weightless();
    let moving = solid(&mut simulator, [60.0, 60.0, 60.0], [0.0, 500.0, 50.0]);
    simulator.body_mut(moving).unwrap().set_mass(1000.0).unwrap();
    let body = ball(&mut simulator, 5.0, [27.0, 525.0, -30.0]);
    throw(&mut simulator, moving, [0.0, 0.0, -2500.0]);
    throw(&mut simulator, body, [0.0, 0.0, 2500.0]);
    run(&mut simulator, 20);
    assert!(place(&simulator, body).z < place(&simulator, moving).z - 34.0);
    assert_near(velocity(&simulator, body).x, 0.0, ROUNDING);
}

#[test]
pub(crate) fn a_ball_pushes_a_box_in_the_direction_of_their_contact() {
    let mut simulator = weightless();
    let still = crate_box(&mut simulator, [40.0, 40.0], [0.0, 500.0, 0.0]);
    // 6 of 10 px beyond the right front edge.
    let body = ball(&mut simulator, 10.0, [26.0, 510.0, -60.0]);
    throw(&mut simulator, body, [0.0, 0.0, 50.0]);
    let geom = geom_of(&simulator, still);
    let hit = run_until_hit(&mut simulator, geom);
    assert_eq!(hit.axis, Axis::Oblique);
    assert_eq!(hit.partner, ContactTarget::Geom(geom_of(&simulator, body)));
    run(&mut simulator, 20);
    let [pushed, after] = [still, body].map(|body| velocity(&simulator, body));
    assert_near3(pushed + after, [0.0, 0.0, 50.0], ROUNDING);
    assert!(pushed.x < -5.0 && pushed.z > 5.0 && after.x > 5.0, "{pushed:?} {after:?}");
    assert_near3(pushed.normalize(), hit.normal.into(), ROUNDING);
}

#[test]
pub(crate) fn equal_boxes_right_behind_each_other_meet_along_z() {
    for aside in [0.0, 1.0, 39.0] {
        let mut simulator = weightless();
        let still = solid(&mut simulator, [40.0; 3], [0.0, 500.0, 0.0]);
        let thrown = solid(&mut simulator, [40.0; 3], [aside, 500.0, 60.3]);
        throw(&mut simulator, thrown, [0.0, 0.0, -50.0]);
        run(&mut simulator, 100);
        for body in [still, thrown] {
            assert_near3(velocity(&simulator, body), [0.0, 0.0, -25.0], ROUNDING);
        }
    }
}

#[test]
fn boxes_with_a_small_overlap_and_motion_in_depth_separate_in_depth() {
    for aside in [0.0, 1.0, 5.0] {
        let mut simulator = weightless();
        let still = solid(&mut simulator, [40.0; 3], [0.0, 500.0, 0.0]);
        let thrown = solid(&mut simulator, [40.0; 3], [aside, 500.0, 39.0]);
        throw(&mut simulator, thrown, [0.0, 0.0, -10.0]);
        run(&mut simulator, 100);
        let apart = place(&simulator, thrown) - place(&simulator, still);
        assert_near3(apart, [aside, 0.0, 40.0], SLOP + 0.02);
    }
}

#[test]
pub(crate) fn a_box_walks_off_a_crate_in_depth_only_when_all_of_its_footprint_has_left() {
    for sign in [-1.0, 1.0] {
        let mut simulator = simulator();
        let below = solid(&mut simulator, [80.0, 60.0, 60.0], [0.0, 0.0, 0.0]);
        fix(&mut simulator, below);
        let body = solid(&mut simulator, [40.0, 20.0, 20.0], [0.0, 60.0, 0.0]);
        throw(&mut simulator, body, [0.0, 0.0, sign * 50.0]);
        for _ in 0..300 {
            simulator.update(DT);
            let at = place(&simulator, body);
            if at.z * sign < 40.0 {
                assert_near(at.y, 60.0, SLOP + 0.02);
            }
        }
        assert_near3(place(&simulator, body), [0.0, 0.0, sign * 150.0], SLOP + 0.02);
    }
}
