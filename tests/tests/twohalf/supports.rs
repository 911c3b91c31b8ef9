//! Surfaces beneath a point, and supports of a body.

use conformance::fixtures::depth::{
    assert_near, assert_near3, ball, fix, geom_of, place, platform, run, set_platform_surface, set_surface,
    simulator, solid, throw, weightless,
};
use twohalf::farseer_core::{GeomPlacement, Vertices};
use twohalf::{
    BodyId, ContactTarget, Platform, PlatformId, Support, TwoHalfPhysicsSimulator, Vector2, Vector3,
};

const UP: [f32; 3] = [0.0, 1.0, 0.0];

/// Heights of a few hundred px in f32, after some operations.
const ROUNDING: f32 = 1e-3;

/// ContactTarget, height and normal of the surface beneath a point.
fn beneath(simulator: &TwoHalfPhysicsSimulator, point: [f32; 3]) -> Option<(ContactTarget, f32, Vector3)> {
    let surface = simulator.surface_beneath(Vector3::from(point))?;
    Some((surface.partner, surface.height, surface.normal))
}

fn tilted(
    simulator: &mut TwoHalfPhysicsSimulator,
    position: [f32; 3],
    angle: f32,
    friction: f32,
) -> PlatformId {
    let position = Vector3::from(position);
    let id = Platform::with_rotation(simulator, 400.0, 20.0, 200.0, position, angle, None).unwrap();
    set_platform_surface(simulator, id, friction, 0.0);
    id
}

#[test]
pub(crate) fn the_ground_is_beneath_every_point_that_is_not_below_it() {
    let simulator = weightless();
    for point in [[0.0, 0.0, 0.0], [-300.0, 50.0, -70.0], [1e6, 1e6, 1e6]] {
        assert_eq!(beneath(&simulator, point), Some((ContactTarget::Ground, 0.0, Vector3::from(UP))));
    }
    // A resting body overlaps by the slop of 0.05 px; four times that count as resting.
    assert!(beneath(&simulator, [0.0, -0.19, 0.0]).is_some());
    assert_eq!(beneath(&simulator, [0.0, -0.21, 0.0]), None);
}

#[test]
pub(crate) fn the_surface_beneath_the_lowest_point_of_a_resting_body_is_its_support() {
    let mut simulator = simulator();
    platform(&mut simulator, [200.0, 40.0, 100.0], [0.0, 0.0, 0.0]);
    let on_platform = ball(&mut simulator, 10.0, [0.0, 41.0, 0.0]);
    let on_ground = ball(&mut simulator, 10.0, [300.0, 1.0, 0.0]);
    run(&mut simulator, 200);
    let beneath = |body| simulator.surface_beneath(place(&simulator, body)).map(|surface| surface.height);
    assert_eq!((beneath(on_platform), beneath(on_ground)), (Some(40.0), Some(0.0)));
}

#[test]
pub(crate) fn a_level_platform_is_beneath_the_points_over_it_and_no_others() {
    let mut simulator = weightless();
    let id = platform(&mut simulator, [200.0, 40.0, 100.0], [10.0, 20.0, 100.0]);
    let top = Some((ContactTarget::Platform(id), 60.0, Vector3::from(UP)));
    let ground = Some((ContactTarget::Ground, 0.0, Vector3::from(UP)));
    for (point, expected) in [
        ([10.0, 200.0, 100.0], top),
        ([-89.0, 61.0, 51.0], top),
        ([109.0, 60.0, 149.0], top),
        // Beside it, under it, within it, and before the front.
        ([111.0, 200.0, 100.0], ground),
        ([10.0, 10.0, 100.0], ground),
        ([10.0, 40.0, 100.0], ground),
        ([10.0, 200.0, 49.0], ground),
        ([10.0, 200.0, 151.0], ground),
    ] {
        assert_eq!(beneath(&simulator, point), expected, "{point:?}");
    }
}

#[test]
pub(crate) fn the_highest_of_several_surfaces_below_the_point_counts() {
    let mut simulator = weightless();
    let low = platform(&mut simulator, [200.0, 10.0, 100.0], [0.0, 20.0, 0.0]);
    let high = platform(&mut simulator, [100.0, 10.0, 100.0], [0.0, 90.0, 0.0]);
    for (point, expected) in [
        ([0.0, 500.0, 0.0], ContactTarget::Platform(high)),
        ([0.0, 70.0, 0.0], ContactTarget::Platform(low)),
        ([80.0, 500.0, 0.0], ContactTarget::Platform(low)),
        ([0.0, 10.0, 0.0], ContactTarget::Ground),
    ] {
        assert_eq!(beneath(&simulator, point).unwrap().0, expected, "{point:?}");
    }
}

#[test]
pub(crate) fn the_gap_between_two_platforms_shows_the_ground() {
    let mut simulator = weightless();
    for x in [-60.0, 60.0] {
        platform(&mut simulator, [100.0, 40.0, 100.0], [x, 20.0, 0.0]);
    }
    assert_eq!(beneath(&simulator, [0.0, 100.0, 0.0]).unwrap().0, ContactTarget::Ground);
    assert_eq!(beneath(&simulator, [11.0, 100.0, 0.0]).unwrap().1, 60.0);
}

#[test]
pub(crate) fn a_slope_is_beneath_at_the_height_of_its_line_with_its_normal() {
    for angle in [0.4, -0.4_f32] {
        let mut simulator = weightless();
        let id = tilted(&mut simulator, [30.0, 190.0, 0.0], angle, 0.0);
        // The middle of the upper side is half the height out of the middle.
        let middle = [30.0 + 10.0 * angle.sin(), 200.0 + 10.0 * angle.cos()];
        for x in [-100.0, 0.0, 33.0, 150.0] {
            let (partner, height, normal) = beneath(&simulator, [x, 1000.0, 50.0]).unwrap();
            assert_eq!(partner, ContactTarget::Platform(id));
            assert_near(height, middle[1] - (x - middle[0]) * angle.tan(), ROUNDING);
            assert_near3(normal, [angle.sin(), angle.cos(), 0.0], 1e-6);
        }
        assert_eq!(beneath(&simulator, [260.0, 1000.0, 50.0]).unwrap().0, ContactTarget::Ground);
    }
}

#[test]
pub(crate) fn a_sheared_platform_is_beneath_the_points_drawn_over_its_top() {
    let mut simulator = weightless();
    let position = Vector3::new(0.0, 20.0, 60.0);
    let id = Platform::with_rotation_and_angle(&mut simulator, 100.0, 40.0, 80.0, position, 0.0, None, 120)
        .unwrap();
    let corners = simulator.platform(id).unwrap().corners();
    let middle_of_back = (corners[4] + corners[5]) * 0.5;
    for (across, expected) in [(-49.0, 60.0), (49.0, 60.0), (-51.0, 0.0), (51.0, 0.0)] {
        let point = middle_of_back + Vector3::new(across, 10.0, -0.01);
        assert_eq!(simulator.surface_beneath(point).unwrap().height, expected, "{across}");
    }
}

#[test]
pub(crate) fn the_surface_beneath_a_body_is_that_beneath_the_middle_of_its_object_geom() {
    let mut simulator = weightless();
    let id = platform(&mut simulator, [200.0, 40.0, 100.0], [0.0, 20.0, 100.0]);
    let over = ball(&mut simulator, 10.0, [99.0, 100.0, 100.0]);
    let beside = ball(&mut simulator, 10.0, [101.0, 100.0, 100.0]);
    // Resting a little in it still is on it.
    let resting = ball(&mut simulator, 10.0, [0.0, 59.95, 100.0]);
    let partner = |body: BodyId| simulator.surface_beneath_body(body).unwrap().partner;
    assert_eq!(partner(over), ContactTarget::Platform(id));
    assert_eq!(partner(beside), ContactTarget::Ground);
    assert_eq!(partner(resting), ContactTarget::Platform(id));
}

#[test]
pub(crate) fn a_removed_platform_is_no_surface() {
    let mut simulator = weightless();
    let id = platform(&mut simulator, [200.0, 40.0, 100.0], [0.0, 20.0, 100.0]);
    simulator.remove_platform(id).unwrap();
    assert_eq!(beneath(&simulator, [0.0, 100.0, 100.0]).unwrap().0, ContactTarget::Ground);
    assert!(simulator.platform(id).is_none());
}

#[test]
pub(crate) fn a_box_is_beneath_the_points_over_it_and_a_ball_is_not() {
    let mut simulator = weightless();
    let lower = solid(&mut simulator, [40.0, 20.0, 30.0], [100.0, 30.0, 50.0]);
    ball(&mut simulator, 20.0, [0.0, 0.0, 0.0]);
    simulator.update(0.0);
    let top = Some((ContactTarget::Geom(geom_of(&simulator, lower)), 50.0, Vector3::from(UP)));
    let ground = Some((ContactTarget::Ground, 0.0, Vector3::from(UP)));
    for (point, expected) in [
        ([100.0, 200.0, 50.0], top),
        ([81.0, 50.0, 36.0], top),
        ([119.0, 49.9, 64.0], top),
        // Beside it, under it, within it, before its front and behind its back; and over the ball.
        ([79.0, 200.0, 50.0], ground),
        ([100.0, 20.0, 50.0], ground),
        ([100.0, 40.0, 50.0], ground),
        ([100.0, 200.0, 34.0], ground),
        ([100.0, 200.0, 66.0], ground),
        ([0.0, 200.0, 0.0], ground),
    ] {
        assert_eq!(beneath(&simulator, point), expected, "{point:?}");
    }
}

#[test]
pub(crate) fn a_tilted_box_is_beneath_at_the_height_of_its_edges_with_their_normals() {
    let mut simulator = weightless();
    let body = solid(&mut simulator, [40.0, 20.0, 30.0], [0.0, 90.0, 0.0]);
    // Clockwise on the screen: the right end is the lower one.
    simulator.body_mut(body).unwrap().set_rotation(0.4);
    simulator.update(0.0);
    let (sin, cos) = 0.4f32.sin_cos();
    let centre = simulator.body(body).unwrap().origin3d();
    // The corner on top is 20 to the left of the middle and 10 above it before it is turned.
    let ridge = [centre.x - 20.0 * cos + 10.0 * sin, centre.y + 20.0 * sin + 10.0 * cos];
    for (x, slope, normal) in [(10.0, -sin / cos, [sin, cos, 0.0]), (-1.0, cos / sin, [-cos, sin, 0.0])] {
        let (partner, height, out) = beneath(&simulator, [ridge[0] + x, 500.0, 0.0]).unwrap();
        assert_eq!(partner, ContactTarget::Geom(geom_of(&simulator, body)));
        assert_near(height, ridge[1] + slope * x, ROUNDING);
        assert_near3(out, normal, 1e-5);
    }
}

#[test]
pub(crate) fn sensors_and_disabled_and_disposed_geoms_are_no_surfaces() {
    type Open = fn(&mut TwoHalfPhysicsSimulator, BodyId);
    let opened: [Open; 4] = [
        |simulator, body| simulator.set_is_sensor(geom_of(simulator, body), true).unwrap(),
        |simulator, body| {
            let geom = geom_of(simulator, body);
            simulator.geom_mut(geom).unwrap().set_collision_enabled(false);
        },
        |simulator, body| simulator.body_mut(body).unwrap().set_enabled(false),
        |simulator, body| simulator.dispose(body).unwrap(),
    ];
    for open in opened {
        let mut simulator = weightless();
        let body = solid(&mut simulator, [40.0, 20.0, 30.0], [0.0, 30.0, 0.0]);
        simulator.update(0.0);
        assert_eq!(beneath(&simulator, [0.0, 200.0, 0.0]).unwrap().1, 50.0);
        open(&mut simulator, body);
        assert_eq!(beneath(&simulator, [0.0, 200.0, 0.0]).unwrap().0, ContactTarget::Ground);
    }
}

#[test]
pub(crate) fn the_surface_beneath_skips_filtered_objects() {
    let mut simulator = weightless();
    let block = platform(&mut simulator, [200.0, 10.0, 100.0], [0.0, 20.0, 0.0]);
    let bodies = [60.0, 100.0].map(|y| solid(&mut simulator, [40.0, 20.0, 30.0], [0.0, y, 0.0]));
    simulator.update(0.0);
    let [low, high] = bodies.map(|body| ContactTarget::Geom(geom_of(&simulator, body)));
    let mut order = Vec::new();
    while let Some(surface) =
        simulator.surface_beneath_where(Vector3::new(0.0, 200.0, 0.0), |partner| !order.contains(&partner))
    {
        order.push(surface.partner);
    }
    assert_eq!(order, [high, low, ContactTarget::Platform(block), ContactTarget::Ground]);
}

#[test]
pub(crate) fn the_surface_beneath_a_cup_is_its_support_and_not_its_own_floor() {
    let mut simulator = weightless();
    let cup = solid(&mut simulator, [4.0; 3], [0.0; 3]);
    // Walls from -30 to -20 and from 20 to 30, and a floor 10 below the middle.
    let outline = [
        [-30.0, -20.0],
        [-20.0, -20.0],
        [-20.0, 10.0],
        [20.0, 10.0],
        [20.0, -20.0],
        [30.0, -20.0],
        [30.0, 20.0],
        [-30.0, 20.0],
    ];
    let outline = Vertices::from(outline.map(Vector2::from).to_vec());
    let geom = simulator.create_geom(cup, outline, GeomPlacement::default()).unwrap();
    simulator.add(geom).unwrap();
    let mut view = simulator.body_mut(cup).unwrap();
    view.ground_mut().set_object_geom(geom, None).unwrap();
    view.set_position3d(Vector3::new(0.0, 100.0, 0.0));
    simulator.update(0.0);
    let middle = simulator.geom(geom).unwrap().position3d();
    assert_near(middle.y, 120.0, ROUNDING);
    let from = [middle.x - 10.0, middle.y, middle.z];
    let (partner, height, _) = beneath(&simulator, from).unwrap();
    assert_eq!(partner, ContactTarget::Geom(geom));
    assert_near(height, 110.0, ROUNDING);
    assert_eq!(simulator.surface_beneath_body(cup).unwrap().partner, ContactTarget::Ground);
}

#[test]
pub(crate) fn a_body_falls_on_the_surface_beneath_it() {
    let mut simulator = simulator();
    let lower = solid(&mut simulator, [60.0, 30.0, 30.0], [0.0, 0.0, 0.0]);
    run(&mut simulator, 50);
    let upper = solid(&mut simulator, [40.0, 20.0, 20.0], [5.0, 60.0, 0.0]);
    simulator.update(0.0);
    let surface = simulator.surface_beneath_body(upper).unwrap();
    assert_eq!(surface.partner, ContactTarget::Geom(geom_of(&simulator, lower)));
    run(&mut simulator, 200);
    assert_eq!(support(&simulator, upper).map(|support| support.partner), Some(surface.partner));
    assert_near(place(&simulator, upper).y, surface.height, 0.2);
}

fn support(simulator: &TwoHalfPhysicsSimulator, body: BodyId) -> Option<Support> {
    simulator.body(body).unwrap().support()
}

#[test]
pub(crate) fn in_the_air_a_body_has_no_support() {
    let mut simulator = simulator();
    let body = ball(&mut simulator, 10.0, [0.0, 100.0, 0.0]);
    run(&mut simulator, 5);
    let view = simulator.body(body).unwrap();
    assert_eq!((view.support(), view.is_grounded(), view.supports()), (None, false, vec![]));
}

#[test]
pub(crate) fn on_the_ground_the_ground_is_the_support() {
    for is_ball in [true, false] {
        let mut simulator = simulator();
        let body = match is_ball {
            true => ball(&mut simulator, 10.0, [0.0, 1.0, 0.0]),
            false => solid(&mut simulator, [40.0, 20.0, 20.0], [0.0, 1.0, 0.0]),
        };
        run(&mut simulator, 50);
        let expected = Support { partner: ContactTarget::Ground, normal: Vector3::from(UP) };
        let view = simulator.body(body).unwrap();
        assert_eq!(
            (view.support(), view.is_grounded(), view.supports()),
            (Some(expected), true, vec![expected])
        );
        assert!(expected.carries());
    }
}

#[test]
pub(crate) fn a_body_that_rests_is_grounded_in_every_update() {
    let mut simulator = simulator();
    let floor = platform(&mut simulator, [200.0, 40.0, 100.0], [300.0, 20.0, 0.0]);
    set_platform_surface(&mut simulator, floor, 0.5, 0.0);
    let mut bodies = Vec::new();
    for x in [0.0, 300.0] {
        let height = if x == 0.0 { 0.0 } else { 60.0 };
        bodies.push(ball(&mut simulator, 10.0, [x, height + 5.0, 0.0]));
        bodies.push(solid(&mut simulator, [40.0, 20.0, 20.0], [x + 50.0, height + 5.0, 0.0]));
    }
    for &body in &bodies {
        set_surface(&mut simulator, body, 0.5, 0.0);
    }
    run(&mut simulator, 100);
    for step in 0..200 {
        simulator.update(0.01);
        for (index, &body) in bodies.iter().enumerate() {
            assert!(simulator.body(body).unwrap().is_grounded(), "step {step}, body {index}");
        }
    }
}

#[test]
pub(crate) fn a_jumping_body_is_not_grounded_from_its_first_update_off_the_ground() {
    let mut simulator = simulator();
    let body = solid(&mut simulator, [40.0, 20.0, 20.0], [0.0, 0.0, 0.0]);
    run(&mut simulator, 50);
    assert!(simulator.body(body).unwrap().is_grounded());
    throw(&mut simulator, body, [0.0, 80.0, 0.0]);
    // In the first it still touched when it began.
    run(&mut simulator, 2);
    assert!(!simulator.body(body).unwrap().is_grounded());
}

#[test]
pub(crate) fn a_platform_supports_the_bodies_on_it() {
    let mut simulator = simulator();
    let id = platform(&mut simulator, [200.0, 40.0, 100.0], [0.0, 20.0, 100.0]);
    let body = solid(&mut simulator, [40.0, 20.0, 20.0], [0.0, 60.0, 45.0]);
    run(&mut simulator, 50);
    let view = simulator.body(body).unwrap();
    assert_eq!(view.support().unwrap().partner, ContactTarget::Platform(id));
    assert!(view.is_grounded());
}

#[test]
pub(crate) fn two_platforms_that_carry_one_box_are_both_among_its_supports() {
    let mut simulator = simulator();
    let ids = [-60.0, 60.0].map(|x| platform(&mut simulator, [100.0, 40.0, 100.0], [x, 20.0, 0.0]));
    let body = solid(&mut simulator, [80.0, 20.0, 20.0], [0.0, 60.0, 0.0]);
    run(&mut simulator, 50);
    let partners: Vec<_> =
        simulator.body(body).unwrap().supports().into_iter().map(|support| support.partner).collect();
    for id in ids {
        assert_eq!(
            partners.iter().filter(|&&partner| partner == ContactTarget::Platform(id)).count(),
            1,
            "{partners:?}"
        );
    }
}

/// A ball and a box on a slope that holds them by friction alone: whether they are grounded.
fn grounded_on_slope(angle: f32) -> [bool; 2] {
    [true, false].map(|is_ball| {
        let mut simulator = simulator();
        tilted(&mut simulator, [0.0, 390.0, 0.0], angle, 8.0);
        let out = Vector3::new(angle.sin(), angle.cos(), 0.0);
        let body = match is_ball {
            true => ball(&mut simulator, 10.0, [0.0; 3]),
            false => solid(&mut simulator, [20.0, 20.0, 20.0], [0.0; 3]),
        };
        set_surface(&mut simulator, body, 8.0, 0.0);
        let origin = Vector3::new(0.0, 400.0, 0.0) + out * 19.98;
        let mut view = simulator.body_mut(body).unwrap();
        view.set_rotation(angle);
        view.core_mut().set_position(twohalf::Vector2::new(origin.x, -origin.y));
        simulator.update(0.01);
        let view = simulator.body(body).unwrap();
        let support = view.support().expect("it touches the slope");
        assert_near3(support.normal, [angle.sin(), angle.cos(), 0.0], 1e-5);
        assert_eq!(support.carries(), view.is_grounded());
        view.is_grounded()
    })
}

#[test]
pub(crate) fn a_body_is_grounded_on_slopes_up_to_60_degrees_and_not_on_steeper_ones() {
    for degrees in [10.0, 45.0, 59.0, -59.0_f32] {
        assert_eq!(grounded_on_slope(degrees.to_radians()), [true; 2], "{degrees}");
    }
    for degrees in [61.0, 80.0, -61.0_f32] {
        assert_eq!(grounded_on_slope(degrees.to_radians()), [false; 2], "{degrees}");
    }
}

#[test]
pub(crate) fn a_body_supports_another_one_and_is_not_supported_by_it() {
    for is_ball in [true, false] {
        let mut simulator = simulator();
        let lower = solid(&mut simulator, [60.0, 30.0, 30.0], [0.0, 0.0, 0.0]);
        let upper = match is_ball {
            true => ball(&mut simulator, 10.0, [0.0, 30.0, 0.0]),
            false => solid(&mut simulator, [40.0, 20.0, 20.0], [0.0, 30.0, 0.0]),
        };
        run(&mut simulator, 50);
        let below = ContactTarget::Geom(geom_of(&simulator, lower));
        assert_eq!(support(&simulator, upper).map(|support| support.partner), Some(below), "ball: {is_ball}");
        assert!(simulator.body(upper).unwrap().is_grounded());
        assert_eq!(support(&simulator, lower).map(|support| support.partner), Some(ContactTarget::Ground));
        let partners = simulator.body(lower).unwrap().supports();
        assert!(partners.iter().all(|support| support.partner == ContactTarget::Ground), "{partners:?}");
    }
}

#[test]
pub(crate) fn a_wall_is_no_support() {
    let mut simulator = simulator();
    let wall = platform(&mut simulator, [200.0, 200.0, 100.0], [0.0, -50.0, 100.0]);
    let body = solid(&mut simulator, [40.0, 20.0, 20.0], [0.0, 100.0, 39.5]);
    throw(&mut simulator, body, [0.0, 0.0, 100.0]);
    run(&mut simulator, 2);
    let touches = simulator.contacts().any(|contact| contact.partner == ContactTarget::Platform(wall));
    assert!(touches);
    assert_eq!(support(&simulator, body), None);
}

#[test]
pub(crate) fn a_body_on_the_ground_beside_a_wall_is_grounded() {
    let mut simulator = simulator();
    platform(&mut simulator, [200.0, 200.0, 100.0], [0.0, 0.0, 100.0]);
    let body = solid(&mut simulator, [40.0, 20.0, 20.0], [0.0, 0.0, 39.0]);
    run(&mut simulator, 20);
    for _ in 0..50 {
        simulator.body_mut(body).unwrap().set_linear_velocity_z(50.0);
        simulator.update(0.01);
        assert!(simulator.body(body).unwrap().is_grounded());
    }
}

#[test]
pub(crate) fn a_sensor_is_no_support() {
    let mut simulator = simulator();
    let lower = solid(&mut simulator, [60.0, 30.0, 30.0], [0.0, 20.0, 0.0]);
    fix(&mut simulator, lower);
    let geom = geom_of(&simulator, lower);
    simulator.set_is_sensor(geom, true).unwrap();
    let upper = solid(&mut simulator, [40.0, 20.0, 20.0], [0.0, 49.5, 0.0]);
    run(&mut simulator, 3);
    assert!(simulator.counters().pairs_touching > 0);
    assert_eq!(support(&simulator, upper), None);
    assert!(place(&simulator, upper).y < 49.5);
}

#[test]
pub(crate) fn a_bouncy_body_comes_to_rest_and_stays_grounded() {
    for on_platform in [true, false] {
        for is_ball in [true, false] {
            for restitution in [0.1, 0.5, 0.8] {
                let mut simulator = simulator();
                let height = if on_platform { 40.0 } else { 0.0 };
                if on_platform {
                    let floor = platform(&mut simulator, [200.0, 40.0, 200.0], [0.0, 0.0, 0.0]);
                    set_platform_surface(&mut simulator, floor, 0.3, restitution);
                }
                let body = match is_ball {
                    true => ball(&mut simulator, 10.0, [0.0, height + 30.0, 0.0]),
                    false => solid(&mut simulator, [40.0, 20.0, 20.0], [0.0, height + 30.0, 0.0]),
                };
                set_surface(&mut simulator, body, 0.3, restitution);
                // Bounces from 30 px last 2 sqrt(2 h / g) e / (1 - e) s: 6.2 s at 0.8.
                run(&mut simulator, 1500);
                for _ in 0..200 {
                    simulator.update(0.01);
                    assert!(simulator.body(body).unwrap().is_grounded(), "{restitution}, ball: {is_ball}");
                    assert_near(place(&simulator, body).y, height, 0.07);
                }
            }
        }
    }
}
