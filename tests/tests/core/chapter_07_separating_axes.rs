//! Checks of behaviour chapter 07: separating axes. A is made before B.

use conformance::fixtures::plane::{simulator, v};
use conformance::units::assert_words;
use farseer_core::{Body, Contact, GeomId, GeomPlacement, NarrowPhaseCollider, PhysicsSimulator, Vertices};

/// A convex geom: outline, position, rotation.
type Placed = (Vertices, (f32, f32), f32);

fn rectangle(width: f32, height: f32) -> Vertices {
    Vertices::create_simple_rectangle(width, height).unwrap()
}

fn circle(radius: f32) -> Vertices {
    Vertices::create_circle(radius, 32).unwrap()
}

fn add(simulator: &mut PhysicsSimulator, (outline, position, rotation): Placed) -> GeomId {
    let body = simulator.create_body(Body::new());
    simulator.add(body).unwrap();
    simulator[body].set_position(v(position.0, position.1));
    simulator[body].set_rotation(rotation);
    let geom = simulator.create_geom(body, outline, GeomPlacement::default()).unwrap();
    simulator.add(geom).unwrap();
    geom
}

fn contacts(a: Placed, b: Placed, limit: i32) -> Vec<Contact> {
    let mut simulator = simulator(0.0);
    simulator.set_narrow_phase_collider(NarrowPhaseCollider::Sat);
    simulator.set_max_contacts_to_detect(limit);
    simulator.set_max_contacts_to_resolve(100).unwrap();
    add(&mut simulator, a);
    add(&mut simulator, b);
    assert!(simulator.process_queues(0.01, None));
    simulator.find_pairs(None);
    simulator.collide_pairs(None);
    simulator.arbiters().next().map_or(Vec::new(), |arbiter| arbiter.contacts().collect())
}

/// Position of a contact and the vertex it belongs to: owner (0 is A) and number.
type Place<'a> = (&'a str, u32, i32);

fn expect_contacts(found: &[Contact], normal: &str, separation: &str, places: &[Place<'_>]) {
    assert_eq!(found.len(), places.len(), "{found:?}");
    for (contact, &(position, owner, vertex)) in found.iter().zip(places) {
        assert_eq!((contact.id.geom1, contact.id.vertex, contact.id.geom2), (owner, vertex, 1 - owner));
        assert_words(&contact.position, position);
        assert_words(&contact.normal, normal);
        assert_words(&contact.separation, separation);
    }
}

/// Check 1.
#[test]
fn rotated_squares_touch_at_two_vertices() {
    let square = rectangle(10.0, 10.0);
    let found = contacts((square.clone(), (0.0, 0.0), 0.0), (square, (9.0, 1.0), 0.1), 10);
    let places = [("40a00000 40a00000", 0, 2), ("4090c5ce c08f2c8c", 1, 0)];
    expect_contacts(&found, "3f7eb897 3dcc7573", "bfb5ac30", &places);
}

/// Check 2.
#[test]
fn crossing_outlines_touch_at_one_vertex() {
    let (flat, tall) = ((rectangle(20.0, 4.0), (0.0, 0.0), 0.0), (rectangle(4.0, 20.0), (1.0, 0.5), 0.0));
    let found = contacts(flat.clone(), tall.clone(), 10);
    expect_contacts(&found, "3f800000 00000000", "c1300000", &[("bf800000 c1180000", 1, 0)]);
    let swapped = contacts(tall, flat, 10);
    expect_contacts(&swapped, "bf800000 80000000", "c1300000", &[("c1200000 c0000000", 1, 0)]);
}

/// Check 3.
#[test]
fn overlaps_below_a_thousandth_are_no_contact() {
    let at = |x: f32| {
        contacts((rectangle(10.0, 10.0), (0.0, 0.0), 0.0), (rectangle(10.0, 10.0), (x, 0.0), 0.0), 10)
    };
    assert_eq!((at(10.0).len(), at(9.9995).len()), (0, 0));
    let places = [("40a00000 40a00000", 0, 2), ("409fef9e 40a00000", 1, 1)];
    expect_contacts(&at(9.998), "3f800000 80000000", "bb031000", &places);
}

/// Check 4.
#[test]
fn identical_squares_touch_at_one_corner_twice() {
    let square = (rectangle(10.0, 10.0), (0.0, 0.0), 0.0);
    let places = [("40a00000 40a00000", 0, 2), ("40a00000 40a00000", 1, 2)];
    expect_contacts(&contacts(square.clone(), square, 10), "3f800000 80000000", "c1200000", &places);
}

/// Check 5.
#[test]
fn the_limit_admits_one_contact_more() {
    let at = |limit| contacts((circle(5.0), (0.0, 0.0), 0.0), (circle(6.0), (0.5, 0.0), 0.0), limit);
    let all = at(10);
    let vertices: Vec<(u32, i32)> = all.iter().map(|contact| (contact.id.geom1, contact.id.vertex)).collect();
    assert_eq!(vertices, (0..11).map(|vertex| (0, vertex)).collect::<Vec<_>>());
    for contact in all.iter().chain(&at(0)).chain(&at(-1)) {
        assert_words(&contact.normal, "3f7ec46d 3dc8bd35");
        assert_words(&contact.separation, "c12730e8");
    }
    assert_eq!(at(0).len(), 1);
    expect_contacts(&at(-1), "3f7ec46d 3dc8bd35", "c12730e8", &[("40d00000 00000000", 1, 0)]);
}

/// Check 6. The box test of the query keeps points on its sides out, so two hairs widen the box; their edges come in
/// pairs and cross every ray an even number of times.
#[test]
fn points_on_right_and_lower_edges_are_inside() {
    let corners = [
        (-5.0, -5.0),
        (-20.0, -20.0),
        (-5.0, -5.0),
        (-5.0, 5.0),
        (5.0, 5.0),
        (20.0, 20.0),
        (5.0, 5.0),
        (5.0, -5.0),
    ];
    let outline: Vertices = corners.into_iter().map(|(x, y)| v(x, y)).collect();
    let mut simulator = simulator(0.0);
    simulator.set_narrow_phase_collider(NarrowPhaseCollider::Sat);
    let geom = add(&mut simulator, (outline, (0.0, 0.0), 0.0));
    for (x, y, is_inside) in [
        (-5.0, -5.0, false),
        (-5.0, 5.0, false),
        (5.0, 5.0, true),
        (5.0, -5.0, false),
        (-5.0, 0.0, false),
        (5.0, 0.0, true),
        (0.0, 5.0, true),
        (0.0, -5.0, false),
        (0.0, 0.0, true),
        (5.01, 0.0, false),
    ] {
        assert_eq!(simulator.geom_collides_with_point(geom, v(x, y)), is_inside, "({x}, {y})");
    }
}

/// A vertex on an edge of the other outline, as contacts show it: the box test does not come before them.
#[test]
fn vertices_on_edges_touch_by_the_same_rule() {
    let touching = |x: f32, y: f32| {
        contacts((rectangle(10.0, 10.0), (0.0, 0.0), 0.0), (rectangle(4.0, 4.0), (x, y), 0.0), 10)
            .iter()
            .filter(|contact| contact.id.geom1 == 1)
            .map(|contact| contact.id.vertex)
            .collect::<Vec<i32>>()
    };
    // Vertices of B: 0 upper left, 1 lower left, 2 lower right, 3 upper right.
    assert_eq!(touching(3.0, 0.0), [0, 1, 2, 3], "on the right edge");
    assert_eq!(touching(-3.0, 0.0), [2, 3], "on the left edge");
    assert_eq!(touching(0.0, 3.0), [0, 1, 2, 3], "on the lower edge");
    assert_eq!(touching(0.0, -3.0), [1, 2], "on the upper edge");
}
