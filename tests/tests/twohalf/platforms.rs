//! Objects land on platforms, walk off them, bump into them and pass under them.
//!
//! Tolerances: at rest the solver has a slop of 0.05 px, and gravity adds g dt² = 0.01 px before the next contact takes it
//! back. An object that moves along one axis alone must not move along another: there the bound is rounding.

use conformance::fixtures::depth::{
    DT, GRAVITY, SLOP, assert_near, assert_near3, ball, collisions_of, geom_of, place, platform, run,
    run_until_hit, set_platform_surface, set_surface, simulator, solid, throw, velocity, weightless,
};
use twohalf::{Axis, BodyId, ContactTarget, Event, PlatformId, TwoHalfPhysicsSimulator, Vector3};

/// Depth in px of a resting object below its surface: the slop and the motion of gravity in a step.
const REST: f32 = SLOP + 2.0 * GRAVITY * DT * DT;
/// Rounding of coordinates up to 1000 px in some hundred steps.
const ROUNDING: f32 = 1e-2;

/// The platform of most tests: X from -100 to 100, Y from 20 to 60, Z from 50 to 150.
fn block(simulator: &mut TwoHalfPhysicsSimulator) -> PlatformId {
    platform(simulator, [200.0, 40.0, 100.0], [0.0, 20.0, 100.0])
}

/// A box of 40 x 20 x 20 or a ball of radius 10.
fn object(simulator: &mut TwoHalfPhysicsSimulator, is_ball: bool, place: [f32; 3]) -> BodyId {
    match is_ball {
        true => ball(simulator, 10.0, place),
        false => solid(simulator, [40.0, 20.0, 20.0], place),
    }
}

/// Lets an object fall at 16 px per step onto the block, from heights that put its first overlap anywhere within a
/// step, and asserts that it stays where it lands.
#[track_caller]
fn assert_lands_and_stays(is_ball: bool, x: f32, z: f32, across: [f32; 2]) {
    for phase in 0..16 {
        let mut simulator = simulator();
        block(&mut simulator);
        let body = object(&mut simulator, is_ball, [x, 124.0 + phase as f32, z]);
        throw(&mut simulator, body, [across[0], -1600.0, across[1]]);
        run(&mut simulator, 300);
        let rest = place(&simulator, body);
        assert!(rest.y >= 60.0 - REST && rest.y <= 60.0 + REST, "phase {phase}: {rest:?}");
        if across == [0.0; 2] {
            assert_near(rest.z, z, ROUNDING);
            assert_near(rest.x, x, 0.1);
        }
        assert!(simulator.body(body).unwrap().rotation().sin().abs() < 0.01, "phase {phase}");
    }
}

#[test]
pub(crate) fn a_box_that_lands_2_px_inside_the_front_edge_at_16_px_per_step_stays() {
    assert_lands_and_stays(false, 0.0, 50.0 - 10.0 + 2.0, [0.0; 2]);
}

#[test]
pub(crate) fn a_box_that_lands_2_px_inside_the_back_edge_at_16_px_per_step_stays() {
    assert_lands_and_stays(false, 0.0, 150.0 + 10.0 - 2.0, [0.0; 2]);
}

#[test]
pub(crate) fn a_ball_whose_middle_lands_2_px_inside_the_front_edge_at_16_px_per_step_stays() {
    assert_lands_and_stays(true, 0.0, 50.0 + 2.0, [0.0; 2]);
}

#[test]
pub(crate) fn a_box_whose_middle_lands_2_px_inside_the_left_edge_at_16_px_per_step_stays() {
    assert_lands_and_stays(false, -100.0 + 2.0, 100.0, [0.0; 2]);
}

#[test]
pub(crate) fn a_ball_whose_middle_lands_2_px_inside_the_left_edge_at_16_px_per_step_stays() {
    assert_lands_and_stays(true, -100.0 + 2.0, 100.0, [0.0; 2]);
}

#[test]
pub(crate) fn a_box_that_comes_down_over_the_front_corner_stays() {
    assert_lands_and_stays(false, -98.0, 42.0, [0.0; 2]);
}

#[test]
pub(crate) fn a_box_that_lands_while_it_moves_inward_over_the_front_edge_slides_on_along_the_top() {
    // 16 px down and 0.2 px inward per step; over the edge by more than the slop before it is down.
    assert_lands_and_stays(false, 0.0, 45.0, [0.0, 20.0]);
}

#[test]
pub(crate) fn a_box_that_lands_with_a_little_of_it_over_the_left_edge_is_not_thrown_aside() {
    for phase in 0..16 {
        let mut simulator = simulator();
        block(&mut simulator);
        let body = object(&mut simulator, false, [-118.0, 124.0 + phase as f32, 100.0]);
        throw(&mut simulator, body, [0.0, -1600.0, 0.0]);
        let geom = geom_of(&simulator, body);
        let hit = run_until_hit(&mut simulator, geom);
        assert_eq!(hit.normal, Vector3::new(0.0, 1.0, 0.0), "phase {phase}");
    }
}

#[test]
pub(crate) fn a_ball_whose_middle_comes_down_beside_the_front_edge_falls_off_it() {
    let mut simulator = simulator();
    block(&mut simulator);
    let body = ball(&mut simulator, 10.0, [0.0, 80.0, 47.0]);
    run(&mut simulator, 400);
    let end = place(&simulator, body);
    assert!(end.z < 40.0, "{end:?}");
    assert_near(end.y, 0.0, REST);
}

#[test]
pub(crate) fn a_box_walks_off_the_front_and_the_back_only_when_all_of_its_footprint_has_left() {
    for sign in [-1.0, 1.0] {
        let mut simulator = simulator();
        block(&mut simulator);
        let body = object(&mut simulator, false, [0.0, 60.0, 100.0]);
        throw(&mut simulator, body, [0.0, 0.0, sign * 50.0]);
        for _ in 0..300 {
            simulator.update(DT);
            let beyond = (place(&simulator, body).z - 100.0) * sign - 60.0;
            let height = place(&simulator, body).y;
            // A step after it has left it is still on top.
            if beyond < 0.0 {
                assert_near(height, 60.0, REST);
            } else if beyond > 5.0 {
                assert!(height < 60.0 - REST, "{height} px high, {beyond} px beyond the edge");
            }
        }
        let end = place(&simulator, body);
        assert_near3(end, [0.0, 0.0, 100.0 + sign * 150.0], REST + ROUNDING);
        assert_near(velocity(&simulator, body).z, sign * 50.0, ROUNDING);
    }
}

#[test]
pub(crate) fn a_box_walks_off_the_left_and_the_right_edge_and_ends_up_on_the_ground() {
    for sign in [-1.0, 1.0] {
        let mut simulator = simulator();
        block(&mut simulator);
        let body = object(&mut simulator, false, [0.0, 60.0, 100.0]);
        throw(&mut simulator, body, [sign * 50.0, 0.0, 0.0]);
        let mut is_over = true;
        for _ in 0..800 {
            simulator.update(DT);
            is_over &= place(&simulator, body).x * sign < 100.0;
            if is_over {
                assert_near(place(&simulator, body).y, 60.0, REST);
            }
        }
        let end = place(&simulator, body);
        assert!(end.x * sign > 120.0, "{end:?}");
        // It may lie on any of its sides.
        assert_near(end.y, 0.0, 2.0 * REST);
        assert_near(end.z, 100.0, ROUNDING);
    }
}

#[test]
pub(crate) fn a_ball_walks_off_each_of_the_four_edges_and_ends_up_on_the_ground() {
    for [x, z] in [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]] {
        let mut simulator = simulator();
        block(&mut simulator);
        let body = object(&mut simulator, true, [0.0, 60.0, 100.0]);
        throw(&mut simulator, body, [50.0 * x, 0.0, 50.0 * z]);
        let edge = if x == 0.0 { 50.0 } else { 100.0 };
        let mut is_over = true;
        for _ in 0..500 {
            simulator.update(DT);
            let at = place(&simulator, body);
            is_over &= at.x * x + (at.z - 100.0) * z < edge;
            if is_over {
                assert_near(at.y, 60.0, REST);
            }
        }
        let end = place(&simulator, body);
        assert!(end.x * x + (end.z - 100.0) * z > edge + 10.0, "{end:?}");
        assert_near(end.y, 0.0, REST);
    }
}

#[test]
fn a_figure_that_jumps_under_a_platform_bumps_its_head_and_falls_back() {
    for is_ball in [true, false] {
        let mut simulator = simulator();
        let roof = platform(&mut simulator, [200.0, 30.0, 100.0], [0.0, 100.0, 100.0]);
        let body = object(&mut simulator, is_ball, [10.0, 0.0, 90.0]);
        throw(&mut simulator, body, [0.0, 150.0, 0.0]);
        let geom = geom_of(&simulator, body);
        let hit = run_until_hit(&mut simulator, geom);
        assert_eq!((hit.partner, hit.normal), (ContactTarget::Platform(roof), Vector3::new(0.0, -1.0, 0.0)));
        // The callback comes when its top is at the underside, late by a step at 150 px/s.
        let highest = place(&simulator, body).y;
        assert!((80.0..=80.0 + 150.0 * DT).contains(&highest), "{highest}");
        simulator.update(DT);
        assert!(velocity(&simulator, body).y <= 0.0);
        // sqrt(2 h / g) = 1.26 s to fall back.
        run(&mut simulator, 140);
        assert_near3(place(&simulator, body), [10.0, 0.0, 90.0], REST + ROUNDING);
    }
}

#[test]
pub(crate) fn a_figure_that_jumps_beside_a_platform_does_not_hit_it() {
    for [x, z] in [[131.0, 100.0], [0.0, 29.0]] {
        let mut simulator = simulator();
        platform(&mut simulator, [200.0, 30.0, 100.0], [0.0, 100.0, 100.0]);
        let body = object(&mut simulator, false, [x, 0.0, z]);
        throw(&mut simulator, body, [0.0, 150.0, 0.0]);
        run(&mut simulator, 149);
        // v²/2g - v dt/2.
        assert_near(place(&simulator, body).y, 150.0 * 150.0 / 200.0 - 0.75, 150.0 * DT);
    }
}

#[test]
pub(crate) fn objects_pass_under_a_platform_along_x_and_along_z() {
    for direction in [[1.0, 0.0], [0.0, 1.0], [-0.6, 0.8]] {
        for is_ball in [true, false] {
            let mut simulator = simulator();
            platform(&mut simulator, [200.0, 30.0, 100.0], [0.0, 20.5, 100.0]);
            let start = [-250.0 * direction[0], 0.0, 100.0 - 250.0 * direction[1]];
            let body = object(&mut simulator, is_ball, start);
            throw(&mut simulator, body, [100.0 * direction[0], 0.0, 100.0 * direction[1]]);
            for _ in 0..500 {
                simulator.update(DT);
                let is_roof = |contact: &twohalf::Collision| !contact.partner.is_ground();
                let geom = geom_of(&simulator, body);
                assert!(!collisions_of(&simulator, geom).iter().any(is_roof));
            }
            let end = [250.0 * direction[0], 0.0, 100.0 + 250.0 * direction[1]];
            assert_near3(place(&simulator, body), end, REST + ROUNDING);
        }
    }
}

/// The four sides of the block: outward normals, and how far its middle is behind them.
const SIDES: [([f32; 3], f32); 4] =
    [([-1.0, 0.0, 0.0], 100.0), ([1.0, 0.0, 0.0], 100.0), ([0.0, 0.0, -1.0], 50.0), ([0.0, 0.0, 1.0], 50.0)];

/// Throws an object without gravity at a side of a block, and returns its first collision and its position and velocity in the
/// end.
fn hit_side(
    side: [f32; 3],
    extent: f32,
    is_ball: bool,
    restitution: f32,
) -> (twohalf::Collision, Vector3, Vector3) {
    let mut simulator = weightless();
    let wall = platform(&mut simulator, [200.0, 60.0, 100.0], [0.0, -20.0, 100.0]);
    set_platform_surface(&mut simulator, wall, 0.0, restitution);
    let outward = Vector3::from(side);
    // The distance is no multiple of a step, so that the last bit of the last step does not decide.
    let aside = Vector3::new(7.0, 0.0, 7.0).component_mul(&(Vector3::repeat(1.0) - outward.abs()));
    let start = outward * (extent + 100.3) + aside;
    let body = object(&mut simulator, is_ball, (start + Vector3::new(0.0, 0.0, 100.0)).into());
    let geom = geom_of(&simulator, body);
    let settings = simulator.geom_mut(geom).unwrap();
    settings.set_restitution_coefficient(restitution);
    throw(&mut simulator, body, (outward * -80.0).into());
    let hit = (0..500).find_map(|_| {
        simulator.update(DT);
        collisions_of(&simulator, geom)
            .into_iter()
            .find(|collision| collision.partner == ContactTarget::Platform(wall))
    });
    run(&mut simulator, 50);
    (hit.unwrap(), place(&simulator, body), velocity(&simulator, body))
}

#[test]
pub(crate) fn objects_fly_back_from_the_front_the_back_and_the_sides_of_a_platform() {
    for (side, extent) in SIDES {
        for is_ball in [true, false] {
            let (hit, _, after) = hit_side(side, extent, is_ball, 1.0);
            assert_eq!(hit.normal, Vector3::from(side), "ball: {is_ball}");
            assert_eq!(hit.axis, if side[2] == 0.0 { Axis::Plane } else { Axis::Depth });
            let along = Vector3::new(after.x, 0.0, after.z);
            assert_near3(along, (Vector3::from(side) * 80.0).into(), ROUNDING);
        }
    }
}

#[test]
pub(crate) fn objects_without_restitution_stop_at_the_front_the_back_and_the_sides_of_a_platform() {
    for (side, extent) in SIDES {
        for is_ball in [true, false] {
            let (_, end, after) = hit_side(side, extent, is_ball, 0.0);
            let outward = Vector3::from(side);
            let half = if side[2] == 0.0 && !is_ball { 20.0 } else { 10.0 };
            let gap = (end - Vector3::new(0.0, 0.0, 100.0)).dot(&outward) - extent - half;
            // The correction ends within the slop, or beyond by the motion that was left.
            assert!((-SLOP - 0.01..=SLOP).contains(&gap), "{gap}, ball: {is_ball}, {side:?}");
            assert_near(after.dot(&outward), 0.0, ROUNDING);
        }
    }
}

#[test]
pub(crate) fn a_box_that_comes_diagonally_is_stopped_along_the_axis_that_it_enters_last() {
    // It comes to the front left edge from 60 px before it and `beside` px beside it, by as much along both axes.
    for (beside, expected) in [(40.0, [0.0, 0.0, -1.0]), (80.0, [-1.0, 0.0, 0.0])] {
        let mut simulator = weightless();
        block(&mut simulator);
        let body = object(&mut simulator, false, [-120.0 - beside, 30.0, 40.0 - 60.0]);
        throw(&mut simulator, body, [1500.0, 0.0, 1500.0]);
        let geom = geom_of(&simulator, body);
        let hit = run_until_hit(&mut simulator, geom);
        assert_eq!(hit.normal, Vector3::from(expected));
    }
}

#[test]
pub(crate) fn a_box_that_enters_depth_first_and_height_last_lands_on_top() {
    let mut simulator = weightless();
    block(&mut simulator);
    // 40 px before the front and 60 px over the top.
    let body = object(&mut simulator, false, [0.0, 120.0, 0.0]);
    throw(&mut simulator, body, [0.0, -1500.0, 1500.0]);
    let geom = geom_of(&simulator, body);
    let hit = run_until_hit(&mut simulator, geom);
    assert_eq!(hit.normal, Vector3::new(0.0, 1.0, 0.0));
}

#[test]
pub(crate) fn a_wide_hole_between_two_platforms_is_fallen_into() {
    for [x, z] in [[1.0, 0.0], [0.0, 1.0]] {
        for is_ball in [true, false] {
            let mut simulator = simulator();
            for sign in [-1.0, 1.0] {
                platform(&mut simulator, [100.0, 40.0, 100.0], [sign * 100.0 * x, 20.0, sign * 100.0 * z]);
            }
            let body = object(&mut simulator, is_ball, [-90.0 * x, 60.0, -90.0 * z]);
            throw(&mut simulator, body, [50.0 * x, 0.0, 50.0 * z]);
            run(&mut simulator, 400);
            let end = place(&simulator, body);
            assert!(end.y < 10.0, "ball: {is_ball}, {end:?}");
        }
    }
}

/// Slides an object without friction over the gap between two platforms of the same height, 0 px for a seam. Asserts that it
/// goes on as without a gap: a level frictionless surface exerts upward impulses only.
#[track_caller]
fn assert_crosses(direction: [f32; 2], gap: f32, is_ball: bool, speed: f32, phase: f32) {
    let [x, z] = direction;
    let mut simulator = simulator();
    for sign in [-1.0, 1.0] {
        let middle = sign * (100.0 + gap / 2.0);
        platform(&mut simulator, [200.0, 40.0, 200.0], [middle * x, 20.0, middle * z]);
    }
    // Dropped, so that it has the overlap of bodies at rest.
    let start = [(phase - 80.0) * x, 70.0, (phase - 80.0) * z];
    let body = object(&mut simulator, is_ball, start);
    run(&mut simulator, 100);
    throw(&mut simulator, body, [speed * x, 0.0, speed * z]);
    let steps = (160.0 / speed / DT) as usize;
    for _ in 0..steps {
        simulator.update(DT);
        assert_near(place(&simulator, body).y, 60.0, REST);
    }
    assert_near3(velocity(&simulator, body), [speed * x, 0.0, speed * z], ROUNDING);
    assert_near(simulator.body(body).unwrap().rotation().sin(), 0.0, 1e-3);
}

#[test]
pub(crate) fn a_box_crosses_the_seam_of_two_platforms_without_stumbling() {
    for direction in [[1.0, 0.0], [0.0, 1.0]] {
        for speed in [20.0, 50.0, 200.0] {
            (0..8).for_each(|phase| assert_crosses(direction, 0.0, false, speed, phase as f32 / 8.0));
        }
    }
}

#[test]
fn a_ball_crosses_the_seam_of_two_platforms_without_stumbling() {
    for direction in [[1.0, 0.0], [0.0, 1.0]] {
        for speed in [20.0, 50.0, 200.0] {
            (0..8).for_each(|phase| assert_crosses(direction, 0.0, true, speed, phase as f32 / 8.0));
        }
    }
}

#[test]
pub(crate) fn a_box_crosses_a_gap_that_is_narrower_than_half_of_it() {
    assert_crosses([0.0, 1.0], 8.0, false, 50.0, 0.0);
    assert_crosses([1.0, 0.0], 8.0, false, 50.0, 0.0);
}

#[test]
pub(crate) fn bodies_on_a_removed_platform_fall_to_the_ground() {
    for is_ball in [true, false] {
        let mut simulator = simulator();
        let floor = block(&mut simulator);
        let body = object(&mut simulator, is_ball, [0.0, 60.0, 100.0]);
        run(&mut simulator, 50);
        assert_near(place(&simulator, body).y, 60.0, REST);
        simulator.remove_platform(floor).unwrap();
        assert!(simulator.remove_platform(floor).is_err());
        run(&mut simulator, 200);
        assert_near3(place(&simulator, body), [0.0, 0.0, 100.0], REST + ROUNDING);
    }
}

#[test]
pub(crate) fn bodies_on_a_teleported_platform_fall_to_the_ground() {
    let mut simulator = simulator();
    let floor = block(&mut simulator);
    let body = object(&mut simulator, false, [0.0, 60.0, 100.0]);
    run(&mut simulator, 50);
    simulator.platform_mut(floor).unwrap().set_position3d(Vector3::new(500.0, 20.0, 100.0)).unwrap();
    run(&mut simulator, 200);
    assert_near3(place(&simulator, body), [0.0, 0.0, 100.0], REST + ROUNDING);
}

#[test]
pub(crate) fn a_body_without_an_object_geom_stands_on_platforms_all_the_same() {
    let mut simulator = simulator();
    let floor = block(&mut simulator);
    let body = twohalf_factories::TwoHalfBodyFactory::create_rectangle_body(&mut simulator, 40.0, 20.0, 1.0)
        .unwrap();
    twohalf_factories::TwoHalfGeomFactory::create_rectangle_geom(&mut simulator, body, 40.0, 20.0).unwrap();
    simulator.body_mut(body).unwrap().set_position3d(Vector3::new(0.0, 90.0, 100.0));
    run(&mut simulator, 200);
    // Its height is that of its origin.
    assert_near(place(&simulator, body).y, 70.0, REST);
    simulator.remove_platform(floor).unwrap();
    run(&mut simulator, 200);
    assert!(place(&simulator, body).y < -50.0);
}

#[test]
pub(crate) fn friction_stops_a_box_on_a_platform_after_v_squared_over_2_mu_g() {
    for [x, z] in [[1.0, 0.0], [0.0, -1.0], [0.6, 0.8]] {
        let mut simulator = simulator();
        let floor = platform(&mut simulator, [800.0, 40.0, 800.0], [0.0, 20.0, 0.0]);
        set_platform_surface(&mut simulator, floor, 0.4, 0.0);
        let body = object(&mut simulator, false, [0.0, 60.0, 0.0]);
        set_surface(&mut simulator, body, 0.4, 0.0);
        throw(&mut simulator, body, [100.0 * x, 0.0, 100.0 * z]);
        run(&mut simulator, 500);
        let end = place(&simulator, body);
        // The path is behind the parabola by v dt / 2, and its first step has no contact yet.
        assert_near(end.x * x + end.z * z, 100.0 * 100.0 / (2.0 * 0.4 * GRAVITY), 1.5 * 100.0 * DT);
        assert_near(end.x * z - end.z * x, 0.0, 0.1);
    }
}

#[test]
pub(crate) fn leaving_a_platform_is_reported_once() {
    let mut simulator = simulator();
    let floor = block(&mut simulator);
    let body = object(&mut simulator, false, [0.0, 60.0, 100.0]);
    throw(&mut simulator, body, [0.0, 0.0, 50.0]);
    let geom = geom_of(&simulator, body);
    let mut told = 0;
    for _ in 0..300 {
        simulator.update(DT);
        let is_leaving = |event: &&Event| {
            **event == Event::Separation { this: geom, partner: ContactTarget::Platform(floor) }
        };
        told += simulator.events().iter().filter(is_leaving).count();
    }
    assert_eq!(told, 1);
}

#[test]
fn a_raised_platform_lifts_the_bodies_on_it() {
    for is_ball in [true, false] {
        let mut simulator = simulator();
        let floor = block(&mut simulator);
        let body = object(&mut simulator, is_ball, [0.0, 60.0, 100.0]);
        run(&mut simulator, 50);
        for step in 1..=100 {
            // Half a px per step; 0.8 of the excess over the slop is corrected in each: a quarter of that is left.
            let position = Vector3::new(0.0, 20.0 + 0.5 * step as f32, 100.0);
            simulator.platform_mut(floor).unwrap().set_position3d(position).unwrap();
            simulator.update(DT);
            let below = position.y + 40.0 - place(&simulator, body).y;
            assert!((-REST..=SLOP + 0.5 * 0.25 + 0.02).contains(&below), "step {step}: {below}");
            assert!(simulator.body(body).unwrap().is_grounded());
        }
    }
}
