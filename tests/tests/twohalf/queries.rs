//! Picking at a point of the screen, contacts, copies, clearing, footprints and the order of drawing.

use conformance::fixtures::depth::{
    DT, GRAVITY, SLOP, assert_near, assert_near3, ball, fix, geom_of, place, platform, run, set_surface,
    simulator, solid, throw, under_test, velocity, weightless,
};
use twohalf::{
    Axis, BodyId, ContactTarget, DepthProfile, DepthScheme, DrawOrder, Drawable, GeomId, Platform,
    PlatformId, TextureId, TwoHalfPhysicsSimulator, Vector2, Vector3,
};

/// Where a point of the world appears.
fn on_screen(simulator: &TwoHalfPhysicsSimulator, point: [f32; 3]) -> Vector2 {
    simulator.projection().to_screen(Vector3::from(point))
}

/// An empty simulator whose Z axis has an angle, with all waiting objects added.
fn at_angle(angle: i32) -> TwoHalfPhysicsSimulator {
    under_test(TwoHalfPhysicsSimulator::with_angle(600, angle).unwrap())
}

const ANGLES: [i32; 5] = [90, 60, 45, 120, 17];

#[test]
pub(crate) fn a_point_of_the_ground_is_found_from_where_it_appears() {
    for angle in ANGLES {
        let simulator = at_angle(angle);
        for point in [[0.0, 0.0, 0.0], [123.25, 0.0, 77.5], [-310.0, 0.0, 12.125], [40.0, 0.0, -55.0]] {
            let found = simulator.screen_to_ground(on_screen(&simulator, point));
            // Rounded to f32 on the way, with numbers up to 1000, and Z once more times the cotangent.
            assert_near3(found, point, 5e-4);
            assert_eq!(found.y, 0.0);
        }
    }
}

#[test]
pub(crate) fn a_point_of_the_screen_is_found_from_the_ground_below_it() {
    for angle in ANGLES {
        let simulator = at_angle(angle);
        for point in [[0.0, 600.0], [320.0, 240.0], [-50.0, 599.0], [640.0, 0.0]].map(Vector2::from) {
            let back = simulator.projection().to_screen(simulator.screen_to_ground(point));
            assert!((back - point).norm() < 5e-4, "{angle}: {back:?} {point:?}");
        }
    }
}

#[test]
pub(crate) fn the_lower_edge_of_the_screen_is_the_ground_at_depth_0() {
    for angle in ANGLES {
        assert_eq!(at_angle(angle).screen_to_ground(Vector2::new(70.0, 600.0)), Vector3::new(70.0, 0.0, 0.0));
    }
}

/// A ball of radius 20 at (100, 50, 30) and a box of 60 x 40 in front of it at (110, 30, 0), which covers some of it.
fn ball_behind_box(angle: i32) -> (TwoHalfPhysicsSimulator, [BodyId; 2]) {
    let mut simulator = at_angle(angle);
    let bodies = [
        ball(&mut simulator, 20.0, [100.0, 50.0, 60.0]),
        solid(&mut simulator, [60.0, 40.0, 40.0], [110.0, 60.0, 0.0]),
    ];
    run(&mut simulator, 1);
    (simulator, bodies)
}

#[test]
pub(crate) fn a_geom_is_found_where_its_picture_is() {
    for angle in ANGLES {
        let (simulator, [round, square]) = ball_behind_box(angle);
        let [ball_geom, box_geom] = [round, square].map(|body| geom_of(&simulator, body));
        let at = |across: f32, up: f32| on_screen(&simulator, [100.0 + across, 70.0 + up, 60.0]);
        // A disc, not the polygon that draws it, and not its box.
        for (across, up) in [(0.0, 19.9), (19.9, 0.0), (-14.1, 14.1)] {
            assert!(simulator.collide_all(at(across, up)).contains(&ball_geom), "{angle}");
        }
        for (across, up) in [(0.0, 20.1), (20.1, 0.0), (-14.3, 14.3)] {
            assert!(!simulator.collide_all(at(across, up)).contains(&ball_geom), "{angle}");
        }
        let at = |across: f32, up: f32| on_screen(&simulator, [110.0 + across, 80.0 + up, 0.0]);
        for (across, up) in [(29.9, 19.9), (-29.9, -19.9), (0.0, 0.0)] {
            assert!(simulator.collide_all(at(across, up)).contains(&box_geom), "{angle}");
        }
        for (across, up) in [(30.1, 0.0), (0.0, 20.1)] {
            assert!(!simulator.collide_all(at(across, up)).contains(&box_geom), "{angle}");
        }
    }
}

#[test]
pub(crate) fn overlapping_objects_are_found_in_list_order_and_picked_from_the_front() {
    let (mut simulator, [round, square]) = ball_behind_box(90);
    let geoms = [round, square].map(|body| geom_of(&simulator, body));
    // The middle of the ball is at (100, 80) up from the lower edge, the box from (80, 60) to (140, 100).
    simulator.body_mut(round).unwrap().set_position3d(Vector3::new(100.0, 0.0, 60.0));
    run(&mut simulator, 1);
    let both = Vector2::new(100.0, 600.0 - 80.0);
    assert_eq!(simulator.collide_all(both), geoms);
    assert_eq!(simulator.collide(both), Some(geoms[0]));
    assert_eq!(simulator.pick_front(both), Some(Drawable::Body(square)));
    // Behind it now.
    simulator.body_mut(square).unwrap().set_position3d(Vector3::new(110.0, -60.0, 120.0));
    assert_eq!(simulator.collide(both), Some(geoms[0]));
    assert_eq!(simulator.pick_front(both), Some(Drawable::Body(round)));
}

#[test]
pub(crate) fn no_object_is_found_where_none_is_drawn() {
    let (simulator, _) = ball_behind_box(60);
    let nowhere = Vector2::new(-500.0, 100.0);
    assert_eq!((simulator.collide(nowhere), simulator.pick_front(nowhere)), (None, None));
    assert!(simulator.collide_all(nowhere).is_empty());
    for odd in [f32::NAN, f32::INFINITY] {
        assert_eq!(simulator.collide(Vector2::new(odd, 0.0)), None);
        assert_eq!(simulator.pick_front(Vector2::new(0.0, odd)), None);
    }
}

#[test]
pub(crate) fn a_removed_geom_is_not_found() {
    let (mut simulator, [round, _]) = ball_behind_box(90);
    let point = on_screen(&simulator, [100.0, 75.0, 60.0]);
    let geom = geom_of(&simulator, round);
    assert_eq!(simulator.collide(point), Some(geom));
    simulator.remove(geom).unwrap();
    run(&mut simulator, 1);
    assert_eq!((simulator.collide(point), simulator.pick_front(point)), (None, None));
}

#[test]
pub(crate) fn a_platform_is_picked_at_its_front_and_at_its_top_and_no_geom_of_it_is_found() {
    for angle in ANGLES {
        let mut simulator = at_angle(angle);
        let id = platform(&mut simulator, [100.0, 40.0, 60.0], [0.0, 20.0, 100.0]);
        for point in [[0.0, 40.0, 70.0], [45.0, 60.0, 100.0], [-45.0, 60.0, 125.0]] {
            let point = on_screen(&simulator, point);
            assert_eq!(simulator.pick_front(point), Some(Drawable::Platform(id)), "{angle}");
            assert_eq!(simulator.collide(point), None);
        }
        for point in [[0.0, 61.0, 130.5], [0.0, 19.0, 70.0]] {
            assert_eq!(simulator.pick_front(on_screen(&simulator, point)), None, "{angle}");
        }
    }
}

#[test]
pub(crate) fn objects_on_a_platform_are_picked_before_it() {
    let mut simulator = simulator();
    let id = platform(&mut simulator, [200.0, 40.0, 100.0], [0.0, 20.0, 100.0]);
    let body = solid(&mut simulator, [40.0, 20.0, 20.0], [0.0, 60.0, 120.0]);
    run(&mut simulator, 20);
    let middle = on_screen(&simulator, [0.0, 70.0, 120.0]);
    assert_eq!(simulator.pick_front(middle), Some(Drawable::Body(body)));
    let beside = on_screen(&simulator, [60.0, 60.0, 120.0]);
    assert_eq!(simulator.pick_front(beside), Some(Drawable::Platform(id)));
}

#[test]
fn the_contacts_of_a_box_at_rest_are_its_lower_corners_and_carry_its_weight() {
    let mut simulator = simulator();
    let body = solid(&mut simulator, [40.0, 20.0, 20.0], [10.0, 0.0, 30.0]);
    set_surface(&mut simulator, body, 0.3, 0.0);
    run(&mut simulator, 100);
    let contacts: Vec<_> = simulator.contacts().collect();
    assert_eq!(contacts.len(), 2);
    for contact in &contacts {
        assert_eq!(
            (contact.this, contact.partner, contact.axis),
            (geom_of(&simulator, body), ContactTarget::Ground, Axis::Plane)
        );
        assert_eq!(contact.normal, Vector3::new(0.0, 1.0, 0.0));
        assert_near((contact.position.x - 10.0).abs(), 20.0, 0.01);
        assert_near(contact.position.y, contact.separation, 1e-6);
        assert_eq!(contact.position.z, 30.0);
        assert!((-SLOP - 0.02..0.0).contains(&contact.separation));
    }
    assert_near(contacts.iter().map(|contact| contact.normal_impulse).sum(), GRAVITY * DT, 1e-3);
}

#[test]
fn the_contact_of_two_balls_is_between_them() {
    let mut simulator = weightless();
    let a = ball(&mut simulator, 10.0, [0.0, 500.0, 0.0]);
    let b = ball(&mut simulator, 10.0, [0.0, 500.0, 19.0]);
    run(&mut simulator, 1);
    let contacts: Vec<_> = simulator.contacts().collect();
    assert_eq!(contacts.len(), 1);
    let contact = contacts[0];
    assert_eq!(
        (contact.this, contact.partner),
        (geom_of(&simulator, b), ContactTarget::Geom(geom_of(&simulator, a)))
    );
    assert_eq!((contact.axis, contact.normal), (Axis::Depth, Vector3::new(0.0, 0.0, 1.0)));
    assert_eq!((contact.separation, contact.normal_impulse), (-1.0, 0.0));
    assert_eq!(contact.position, Vector3::new(0.0, 510.0, 9.0));
}

#[test]
pub(crate) fn the_friction_impulse_of_a_sliding_contact_is_its_coefficient_times_the_normal_one() {
    let mut simulator = simulator();
    let body = ball(&mut simulator, 10.0, [0.0, 0.0, 0.0]);
    set_surface(&mut simulator, body, 0.2, 0.0);
    throw(&mut simulator, body, [60.0, 0.0, 80.0]);
    run(&mut simulator, 10);
    let contact = simulator.contacts().next().unwrap();
    assert_near(contact.friction_impulse, 0.2 * contact.normal_impulse, 1e-4);
}

/// A ball with other than default values of all properties that a clone copies.
fn original(simulator: &mut TwoHalfPhysicsSimulator) -> (BodyId, GeomId) {
    let body = ball(simulator, 10.0, [40.0, 300.0, 70.0]);
    let geom = geom_of(simulator, body);
    let mut view = simulator.body_mut(body).unwrap();
    view.ground_mut().set_friction_coefficient(0.7);
    view.ground_mut().set_restitution_coefficient(0.6);
    view.ground_mut().set_object_geom(geom, Some(TextureId { id: 9, width: 30, height: 12 })).unwrap();
    view.set_mass(3.0).unwrap();
    throw(simulator, body, [1.0, 2.0, 3.0]);
    simulator.geom_mut(geom).unwrap().set_friction_coefficient(0.25);
    simulator.set_depth_profile(geom, DepthProfile::Round { radius: 11.0 }).unwrap();
    (body, geom)
}

#[test]
pub(crate) fn a_cloned_body_has_the_place_in_depth_and_the_ground_of_the_original_and_no_geom() {
    let mut simulator = weightless();
    let (body, geom) = original(&mut simulator);
    let copy = simulator.clone_body(body).unwrap();
    let (view, old) = (simulator.body(copy).unwrap(), simulator.body(body).unwrap());
    // As in the 2D engine, it is at the origin of X and Y.
    assert_eq!((view.origin3d(), view.mass()), (Vector3::new(0.0, 0.0, 70.0), 3.0));
    assert_eq!((view.ground().friction_coefficient(), view.ground().restitution_coefficient()), (0.7, 0.6));
    assert_eq!(view.ground().shadow_image(), Some(TextureId { id: 9, width: 30, height: 12 }));
    assert_eq!((view.ground().object_geom(), old.ground().object_geom()), (None, Some(geom)));
    assert_eq!(view.velocity3d(), Vector3::zeros());
}

#[test]
pub(crate) fn a_cloned_geom_has_the_profile_and_the_settings_of_the_original_and_rests_on_the_ground_for_it()
{
    let mut simulator = simulator();
    let (body, geom) = original(&mut simulator);
    let copy = simulator.clone_body(body).unwrap();
    let twin = simulator.clone_geom(copy, geom).unwrap();
    assert_eq!(simulator.depth_profile(twin), Some(DepthProfile::Round { radius: 11.0 }));
    assert_eq!(simulator.geom_mut(twin).unwrap().friction_coefficient(), 0.25);
    assert_eq!(simulator.body(copy).unwrap().ground().object_geom(), Some(twin));
    // It lands like the original, which is out of its path.
    simulator.add(copy).unwrap();
    simulator.add(twin).unwrap();
    for id in [body, copy] {
        simulator.body_mut(id).unwrap().set_velocity3d(Vector3::zeros());
        let x = if id == body { 500.0 } else { 0.0 };
        simulator.body_mut(id).unwrap().set_position3d(Vector3::new(x, 300.0, 70.0));
    }
    run(&mut simulator, 300);
    assert_eq!(place(&simulator, copy).y, place(&simulator, body).y);
}

#[test]
pub(crate) fn a_geom_that_is_no_object_geom_does_not_become_one_by_cloning() {
    let mut simulator = weightless();
    let (body, geom) = original(&mut simulator);
    let second = simulator.clone_geom(body, geom).unwrap();
    assert_eq!(simulator.body(body).unwrap().ground().object_geom(), Some(geom));
    let copy = simulator.clone_body(body).unwrap();
    simulator.clone_geom(copy, second).unwrap();
    assert_eq!(simulator.body(copy).unwrap().ground().object_geom(), None);
}

#[test]
pub(crate) fn a_cleared_simulator_is_empty_and_its_ids_are_stale() {
    let mut simulator = simulator();
    let id = platform(&mut simulator, [200.0, 40.0, 100.0], [0.0, 20.0, 0.0]);
    let body = solid(&mut simulator, [40.0, 20.0, 20.0], [0.0, 61.0, 0.0]);
    let geom = geom_of(&simulator, body);
    run(&mut simulator, 50);
    simulator.clear();
    assert!(
        simulator.body(body).is_none() && simulator.geom(geom).is_none() && simulator.platform(id).is_none()
    );
    assert_eq!(
        (simulator.body_list().len(), simulator.geom_list().len(), simulator.platforms().count()),
        (0, 0, 0)
    );
    assert_eq!(
        (simulator.contacts().count(), simulator.events().len(), simulator.draw_order().len()),
        (0, 0, 0)
    );
    assert_eq!(
        (simulator.angle(), simulator.height(), simulator.gravity()),
        (60, 600, Vector2::new(0.0, GRAVITY))
    );
    run(&mut simulator, 1);
    assert!(simulator.events().is_empty());
}

#[test]
pub(crate) fn a_cleared_simulator_can_be_filled_again() {
    let mut simulator = simulator();
    for _ in 0..3 {
        let id = platform(&mut simulator, [200.0, 40.0, 100.0], [0.0, 20.0, 0.0]);
        let body = solid(&mut simulator, [40.0, 20.0, 20.0], [0.0, 80.0, 0.0]);
        run(&mut simulator, 150);
        assert_near3(place(&simulator, body), [0.0, 60.0, 0.0], SLOP + 0.02);
        assert!(simulator.platform(id).is_some());
        simulator.clear();
    }
}

#[test]
pub(crate) fn layer_depth_is_0_in_front_1_at_the_back_and_monotonic_in_z() {
    let mut simulator = weightless();
    let body = ball(&mut simulator, 10.0, [0.0, 0.0, 0.0]);
    let mut depth_at = |z: f32| {
        simulator.body_mut(body).unwrap().set_position3d(Vector3::new(0.0, 0.0, z));
        simulator.body(body).unwrap().layer_depth()
    };
    // By default from 0 to the height of the screen.
    assert_eq!(
        [depth_at(-5.0), depth_at(0.0), depth_at(300.0), depth_at(600.0), depth_at(700.0)],
        [0.0, 0.0, 0.5, 1.0, 1.0]
    );
    let depths: Vec<f32> = (0..100).map(|step| depth_at(step as f32 * 6.0)).collect();
    assert!(depths.windows(2).all(|pair| pair[0] < pair[1]));
}

#[test]
pub(crate) fn the_range_of_layer_depths_can_be_set_and_must_have_an_extent() {
    let mut simulator = weightless();
    let body = ball(&mut simulator, 10.0, [0.0, 0.0, 0.0]);
    simulator.set_layer_depth_range(-100.0, 100.0).unwrap();
    assert_eq!(simulator.body(body).unwrap().layer_depth(), 0.5);
    for (near, far) in [(1.0, 1.0), (2.0, 1.0), (f32::NAN, 1.0), (0.0, f32::INFINITY), (f32::MIN, f32::MAX)] {
        assert!(simulator.set_layer_depth_range(near, far).is_err(), "{near} {far}");
    }
    assert_eq!(simulator.body(body).unwrap().layer_depth(), 0.5);
}

#[test]
pub(crate) fn the_footprint_of_a_box_is_a_rectangle_and_of_a_ball_a_disc() {
    let mut simulator = weightless();
    let square = solid(&mut simulator, [40.0, 30.0, 20.0], [10.0, 5.0, 50.0]);
    let round = ball(&mut simulator, 12.0, [100.0, 7.0, -20.0]);
    run(&mut simulator, 1);
    let footprint = |body| simulator.geom(geom_of(&simulator, body)).unwrap().virtual_geom();
    let v = footprint(square);
    assert_eq!([v.left, v.right, v.front, v.back, v.bottom, v.top], [-10.0, 30.0, 40.0, 60.0, 5.0, 35.0]);
    assert!(!v.is_round);
    let v = footprint(round);
    assert_eq!([v.left, v.right, v.front, v.back, v.bottom, v.top], [88.0, 112.0, -32.0, -8.0, 7.0, 31.0]);
    assert!(v.is_round);
}

#[test]
pub(crate) fn the_footprint_of_a_turned_box_is_as_wide_as_it_is_now() {
    let mut simulator = weightless();
    let body = solid(&mut simulator, [40.0, 40.0, 20.0], [0.0, 100.0, 0.0]);
    simulator.body_mut(body).unwrap().set_rotation(std::f32::consts::FRAC_PI_4);
    run(&mut simulator, 1);
    let v = simulator.geom(geom_of(&simulator, body)).unwrap().virtual_geom();
    assert_near(v.right - v.left, 40.0 * 2.0_f32.sqrt(), 1e-3);
    assert_near(v.top - v.bottom, 40.0 * 2.0_f32.sqrt(), 1e-3);
    assert_eq!(v.back - v.front, 20.0);
}

#[test]
pub(crate) fn footprints_overlap_when_extents_and_heights_do() {
    let mut simulator = weightless();
    let a = solid(&mut simulator, [40.0, 40.0, 40.0], [0.0, 500.0, 0.0]);
    let others = [[39.0, 500.0, 39.0], [41.0, 500.0, 0.0], [0.0, 541.0, 0.0], [0.0, 500.0, 41.0]]
        .map(|place| solid(&mut simulator, [40.0, 40.0, 40.0], place));
    let footprint = |body| simulator.geom(geom_of(&simulator, body)).unwrap().virtual_geom();
    let overlaps = others.map(|other| footprint(a).overlaps(&footprint(other)));
    assert_eq!(overlaps, [true, false, false, false]);
    assert_eq!(others.map(|other| footprint(other).overlaps(&footprint(a))), overlaps);
}

#[test]
pub(crate) fn overlap_queries_of_geoms_use_all_three_axes() {
    let mut simulator = weightless();
    let square = solid(&mut simulator, [40.0, 40.0, 40.0], [0.0, 500.0, 0.0]);
    let geom = geom_of(&simulator, square);
    // 7 px beyond the edge in X and Z: 9.9 px away.
    for (radius, expected) in [(9.8, false), (10.0, true)] {
        let round = ball(&mut simulator, radius, [27.0, 510.0, 27.0]);
        let other = geom_of(&simulator, round);
        assert_eq!(simulator.geom(geom).unwrap().collides_with_geom(other), expected);
        assert_eq!(simulator.geom(other).unwrap().collides_with_geom(geom), expected);
    }
    for (z, expected) in [(39.0, true), (41.0, false)] {
        let other = solid(&mut simulator, [40.0, 40.0, 40.0], [39.0, 539.0, z]);
        let other = geom_of(&simulator, other);
        assert_eq!(simulator.geom(geom).unwrap().collides_with_geom(other), expected);
    }
}

/// The order of drawing by names: bodies by index, platforms from 100.
fn order(simulator: &TwoHalfPhysicsSimulator, bodies: &[BodyId], platforms: &[PlatformId]) -> Vec<usize> {
    let name = |drawable: &Drawable| match drawable {
        Drawable::Body(id) => bodies.iter().position(|body| body == id).unwrap(),
        Drawable::Platform(id) => 100 + platforms.iter().position(|platform| platform == id).unwrap(),
    };
    simulator.draw_order().iter().map(name).collect()
}

#[test]
pub(crate) fn objects_behind_on_and_in_front_of_a_platform_are_drawn_in_that_order() {
    let mut simulator = simulator();
    let floor = platform(&mut simulator, [200.0, 40.0, 100.0], [0.0, 0.0, 100.0]);
    let in_front = solid(&mut simulator, [30.0, 60.0, 20.0], [0.0, 0.0, 35.0]);
    let on_top = solid(&mut simulator, [30.0, 60.0, 20.0], [0.0, 40.0, 60.0]);
    let behind = solid(&mut simulator, [30.0, 60.0, 20.0], [0.0, 0.0, 165.0]);
    run(&mut simulator, 20);
    assert_eq!(order(&simulator, &[in_front, on_top, behind], &[floor]), [2, 100, 1, 0]);
}

#[test]
pub(crate) fn objects_around_each_of_a_hundred_platforms_are_drawn_in_order() {
    let mut simulator = simulator();
    let mut groups = Vec::new();
    for at in 0..100 {
        let (x, y) = ((at % 10) as f32 * 130.0, (at / 10) as f32 * 47.0);
        let floor = platform(&mut simulator, [100.0, 40.0, 100.0], [x, y, 100.0]);
        let around = [[y, 165.0], [y + 40.0, 130.0], [y, 35.0]]
            .map(|[height, z]| solid(&mut simulator, [30.0, 60.0, 20.0], [x, height, z]));
        around.iter().for_each(|&body| fix(&mut simulator, body));
        let [behind, on_top, in_front] = around.map(Drawable::Body);
        groups.push([behind, Drawable::Platform(floor), on_top, in_front]);
    }
    run(&mut simulator, 1);
    let order = simulator.draw_order();
    let place = |drawable: Drawable| order.iter().position(|&drawn| drawn == drawable).unwrap();
    for group in groups {
        let places = group.map(place);
        assert!(places.is_sorted(), "{places:?}");
    }
    assert_eq!(order.len(), 400);
}

#[test]
pub(crate) fn a_reused_order_has_the_present_objects() {
    let (mut simulator, bodies) = conformance::fixtures::depth::busy_scene();
    let mut order = DrawOrder::default();
    for step in 0..300 {
        run(&mut simulator, 1);
        match step {
            100 => simulator.remove(bodies[0]).unwrap(),
            140 => simulator.add(bodies[0]).unwrap(),
            180 => {
                let place = Vector3::new(20.0, 10.0, 40.0);
                Platform::new(&mut simulator, 60.0, 10.0, 50.0, place, None).unwrap();
            }
            220 => simulator.body_mut(bodies[2]).unwrap().set_enabled(false),
            240 => {
                let first = simulator.platforms().next().unwrap();
                simulator.remove_platform(first).unwrap();
            }
            260 => simulator.dispose(bodies[1]).unwrap(),
            _ => {}
        }
        assert_eq!(order.sort(&simulator), simulator.draw_order());
    }
}

#[test]
pub(crate) fn objects_under_a_platform_are_drawn_before_it_at_any_position() {
    for z in [90.0, 100.0, 130.0] {
        let mut simulator = simulator();
        let roof = platform(&mut simulator, [200.0, 20.0, 100.0], [0.0, 80.0, 100.0]);
        let under = solid(&mut simulator, [30.0, 60.0, 20.0], [0.0, 0.0, z]);
        let over = solid(&mut simulator, [30.0, 60.0, 20.0], [0.0, 100.0, z]);
        run(&mut simulator, 20);
        assert_eq!(order(&simulator, &[under, over], &[roof]), [0, 100, 1], "{z}");
    }
}

#[test]
pub(crate) fn a_slope_is_drawn_before_objects_on_it_and_after_objects_behind_it() {
    let mut simulator = weightless();
    let position = Vector3::new(0.0, 90.0, 100.0);
    let slope = Platform::with_rotation(&mut simulator, 300.0, 20.0, 100.0, position, 0.4, None).unwrap();
    let high = solid(&mut simulator, [20.0, 20.0, 20.0], [-100.0, 155.0, 100.0]);
    let behind = solid(&mut simulator, [20.0, 20.0, 20.0], [0.0, 100.0, 170.0]);
    run(&mut simulator, 1);
    assert_eq!(order(&simulator, &[high, behind], &[slope]), [1, 100, 0]);
}

#[test]
pub(crate) fn the_higher_of_two_stacked_objects_is_drawn_later() {
    let mut simulator = simulator();
    // Made from the highest to the lowest, so that it is not the order of making.
    let bodies =
        [2, 1, 0].map(|level| solid(&mut simulator, [40.0, 30.0, 30.0], [0.0, 30.0 * level as f32, 5.0]));
    run(&mut simulator, 20);
    assert_eq!(order(&simulator, &bodies, &[]), [2, 1, 0]);
}

/// An empty simulator of the tested scheme, with gravity, whose Z axis has an angle.
fn world_at(angle: i32) -> TwoHalfPhysicsSimulator {
    let gravity = Vector2::new(0.0, GRAVITY);
    under_test(TwoHalfPhysicsSimulator::with_angle_and_gravity(600, angle, gravity).unwrap())
}

#[test]
pub(crate) fn objects_on_a_box_are_drawn_after_it_at_any_position() {
    for angle in [70, 90, 110] {
        for aside in [-12.0, -4.0, 0.0, 4.0, 12.0] {
            for depth in [18.0, 40.0] {
                let mut simulator = world_at(angle);
                let upper = solid(&mut simulator, [26.0, 56.0, depth], [50.0, 40.0, 80.0 + aside]);
                let lower = solid(&mut simulator, [40.0; 3], [50.0, 0.0, 80.0]);
                for step in 0..60 {
                    run(&mut simulator, 1);
                    let order = order(&simulator, &[lower, upper], &[]);
                    assert_eq!(
                        order,
                        [0, 1],
                        "at {angle} degrees, {aside} px aside, {depth} px deep, step {step}"
                    );
                }
            }
            let mut simulator = world_at(angle);
            let round = ball(&mut simulator, 10.0, [50.0, 40.0, 80.0 + aside]);
            let lower = solid(&mut simulator, [40.0; 3], [50.0, 0.0, 80.0]);
            run(&mut simulator, 1);
            assert_eq!(
                order(&simulator, &[lower, round], &[]),
                [0, 1],
                "a ball at {angle} degrees, {aside} px aside"
            );
        }
    }
}

#[test]
fn a_capsule_that_stands_on_a_box_is_drawn_after_it_and_one_behind_it_before_it() {
    // The box is 40 px deep; 31 px behind its middle a capsule of radius 9 stands 2 px behind its back.
    for (height, aside, expected) in [
        (40.0, -12.0, [0, 1]),
        (40.0, 4.0, [0, 1]),
        (40.0, 12.0, [0, 1]),
        (0.0, 31.0, [1, 0]),
        (0.0, -31.0, [0, 1]),
    ] {
        let mut simulator = world_at(70);
        simulator.set_depth_scheme(DepthScheme::Precise).unwrap();
        let figure = ball(&mut simulator, 9.0, [50.0, height, 80.0 + aside]);
        let geom = geom_of(&simulator, figure);
        simulator.set_depth_profile(geom, DepthProfile::Capsule { radius: 9.0, height: 56.0 }).unwrap();
        simulator.body_mut(figure).unwrap().set_position3d(Vector3::new(50.0, height, 80.0 + aside));
        let lower = solid(&mut simulator, [40.0; 3], [50.0, 0.0, 80.0]);
        run(&mut simulator, 60);
        assert_near(place(&simulator, figure).y, height, 4.0 * SLOP);
        assert_eq!(order(&simulator, &[lower, figure], &[]), expected, "{aside} px aside");
    }
}

#[test]
pub(crate) fn the_nearer_of_two_objects_side_by_side_is_drawn_later() {
    let mut simulator = simulator();
    let far = solid(&mut simulator, [40.0, 60.0, 20.0], [0.0, 0.0, 90.0]);
    let near = solid(&mut simulator, [40.0, 60.0, 20.0], [10.0, 0.0, 60.0]);
    let middle = solid(&mut simulator, [40.0, 60.0, 20.0], [5.0, 0.0, 75.0]);
    run(&mut simulator, 20);
    // The middles of 75 and 60, and of 90 and 75, are nearer than their depths.
    assert_eq!(order(&simulator, &[far, near, middle], &[]), [0, 2, 1]);
}

#[test]
pub(crate) fn a_figure_that_jumps_before_another_is_drawn_later_and_one_behind_it_earlier() {
    for (z, expected) in [(30.0, [1, 0]), (90.0, [0, 1])] {
        for height in [0.0, 10.0, 40.0] {
            let mut simulator = weightless();
            let jumping = solid(&mut simulator, [40.0, 60.0, 20.0], [10.0, height, z]);
            let standing = solid(&mut simulator, [40.0, 60.0, 20.0], [0.0, 0.0, 60.0]);
            run(&mut simulator, 1);
            assert_eq!(order(&simulator, &[jumping, standing], &[]), expected, "{z} {height}");
        }
    }
}

#[test]
pub(crate) fn ties_are_drawn_in_the_order_in_which_they_were_made_and_the_order_stays() {
    let mut simulator = weightless();
    let bodies = [0, 1, 2, 3]
        .map(|index| solid(&mut simulator, [40.0, 40.0, 40.0], [100.0 * index as f32, 0.0, 50.0]));
    run(&mut simulator, 1);
    for _ in 0..3 {
        assert_eq!(order(&simulator, &bodies, &[]), [0, 1, 2, 3]);
    }
}

#[test]
pub(crate) fn the_order_of_drawing_has_every_listed_and_enabled_object_once() {
    let mut simulator = weightless();
    let floor = platform(&mut simulator, [200.0, 40.0, 100.0], [0.0, 0.0, 100.0]);
    let there = ball(&mut simulator, 10.0, [0.0, 100.0, 0.0]);
    let fixed = ball(&mut simulator, 10.0, [100.0, 100.0, 0.0]);
    fix(&mut simulator, fixed);
    let disabled = ball(&mut simulator, 10.0, [200.0, 100.0, 0.0]);
    simulator.body_mut(disabled).unwrap().set_enabled(false);
    let removed = ball(&mut simulator, 10.0, [300.0, 100.0, 0.0]);
    run(&mut simulator, 1);
    simulator.remove(removed).unwrap();
    run(&mut simulator, 1);
    let mut drawn = simulator.draw_order();
    drawn.sort();
    assert_eq!(drawn, [Drawable::Body(there), Drawable::Body(fixed), Drawable::Platform(floor)]);
    assert_eq!(velocity(&simulator, there), Vector3::zeros());
}

#[test]
fn positions_beyond_the_finite_range_are_clamped_to_it_on_the_screen() {
    let mut simulator = at_angle(10);
    let body = ball(&mut simulator, 10.0, [0.0, 100.0, 0.0]);
    let geom = geom_of(&simulator, body);
    simulator.update(0.0);
    throw(&mut simulator, body, [0.0, 0.0, 3e38]);
    simulator.update(1.0);
    assert_eq!(simulator.body(body).unwrap().position3d().z, 3e38);
    simulator.set_depth_profile(geom, DepthProfile::Prism { depth: 3e38 }).unwrap();
    let view = simulator.geom(geom).unwrap();
    let outline = view.screen_outline();
    assert!(outline.iter().all(|vertex| vertex.x == f32::MAX && vertex.y.is_finite()), "{outline:?}");
    assert_eq!(view.virtual_geom().back, f32::MAX);
    assert_eq!(simulator.depth_interval(geom).unwrap().1, f32::MAX);
    assert_eq!(simulator.projection().screen_to_ground(Vector2::new(0.0, -3e38)).x, f32::MIN);
}

#[test]
pub(crate) fn a_position_that_does_not_appear_on_the_screen_is_refused() {
    let mut simulator = at_angle(10);
    let body = ball(&mut simulator, 10.0, [0.0, 100.0, 5.0]);
    simulator.body_mut(body).unwrap().set_position3d(Vector3::new(0.0, 0.0, 3e38));
    assert_eq!(simulator.body(body).unwrap().position3d().z, 5.0);
}

#[test]
pub(crate) fn picking_passes_through_filtered_objects() {
    let (mut simulator, [round, square]) = ball_behind_box(90);
    simulator.body_mut(round).unwrap().set_position3d(Vector3::new(100.0, 0.0, 60.0));
    run(&mut simulator, 1);
    let both = Vector2::new(100.0, 600.0 - 80.0);
    assert_eq!(simulator.pick_front_where(both, |_| true), Some(Drawable::Body(square)));
    let is_other = |drawable| drawable != Drawable::Body(square);
    assert_eq!(simulator.pick_front_where(both, is_other), Some(Drawable::Body(round)));
    assert_eq!(simulator.pick_front_where(both, |_| false), None);
}

/// Boxes of 20 px, one at the origin and one 100 px from it along each axis.
fn one_along_each_axis() -> (TwoHalfPhysicsSimulator, [GeomId; 4]) {
    let mut simulator = weightless();
    let places = [[0.0, 0.0, 0.0], [100.0, 0.0, 0.0], [0.0, 100.0, 0.0], [0.0, 0.0, 100.0]];
    let bodies = places.map(|place| solid(&mut simulator, [20.0; 3], place));
    let geoms = bodies.map(|body| geom_of(&simulator, body));
    run(&mut simulator, 1);
    (simulator, geoms)
}

#[test]
pub(crate) fn a_box_query_finds_overlaps_in_all_three_axes() {
    let (simulator, [middle, right, above, behind]) = one_along_each_axis();
    let found = |low: [f32; 3], high: [f32; 3]| simulator.query_box(low.into(), high.into(), |_| true);
    assert_eq!(found([-5.0, 5.0, -5.0], [5.0, 15.0, 5.0]), [middle]);
    assert_eq!(found([-5.0, 5.0, -5.0], [95.0, 15.0, 5.0]), [middle, right]);
    assert_eq!(found([-5.0, 5.0, -5.0], [5.0, 105.0, 5.0]), [middle, above]);
    assert_eq!(found([-5.0, 5.0, -5.0], [5.0, 15.0, 95.0]), [middle, behind]);
    assert!(found([40.0, 40.0, 40.0], [60.0, 60.0, 60.0]).is_empty());
}

#[test]
pub(crate) fn a_box_query_skips_filtered_objects() {
    let (simulator, [middle, right, ..]) = one_along_each_axis();
    let (low, high) = (Vector3::new(-5.0, 5.0, -5.0), Vector3::new(95.0, 15.0, 5.0));
    assert_eq!(simulator.query_box(low, high, |geom| geom != middle), [right]);
}

#[test]
pub(crate) fn an_invalid_box_query_finds_nothing() {
    let (simulator, _) = one_along_each_axis();
    let everything = Vector3::new(500.0, 500.0, 500.0);
    assert_eq!(simulator.query_box(-everything, everything, |_| true).len(), 4);
    assert!(simulator.query_box(everything, -everything, |_| true).is_empty());
    for odd in [f32::NAN, f32::INFINITY] {
        let high = Vector3::new(500.0, 500.0, odd);
        assert!(simulator.query_box(-everything, high, |_| true).is_empty());
    }
}

#[test]
pub(crate) fn a_geom_overlaps_objects_in_it_and_not_those_before_it_or_behind() {
    let mut simulator = weightless();
    let places = [[0.0, 0.0, 0.0], [15.0, 0.0, 0.0], [15.0, 0.0, 25.0], [15.0, 0.0, -25.0]];
    let bodies = places.map(|place| solid(&mut simulator, [20.0; 3], place));
    let [sensor, inside, ..] = bodies.map(|body| geom_of(&simulator, body));
    bodies.iter().for_each(|&body| fix(&mut simulator, body));
    run(&mut simulator, 1);
    assert_eq!(simulator.overlaps_of(sensor, |_| true), [inside]);
    assert!(simulator.overlaps_of(sensor, |geom| geom != inside).is_empty());
}
