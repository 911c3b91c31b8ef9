//! Checks of behaviour chapter 06: distance grids. Automatic cell sizes unless stated.

use conformance::fixtures::plane::{simulator, v};
use conformance::units::assert_words;
use farseer_core::{
    Body, Contact, DistanceGrid, Error, Event, GeomId, GeomPlacement, PhysicsSimulator, Vertices,
};

fn add(simulator: &mut PhysicsSimulator, outline: Vertices, position: (f32, f32), rotation: f32) -> GeomId {
    let body = simulator.create_body(Body::new());
    simulator.add(body).unwrap();
    simulator[body].set_position(v(position.0, position.1));
    simulator[body].set_rotation(rotation);
    let geom = simulator.create_geom(body, outline, GeomPlacement::default()).unwrap();
    simulator.add(geom).unwrap();
    geom
}

fn grid_of(outline: Vertices, position: (f32, f32), rotation: f32) -> DistanceGrid {
    let mut simulator = simulator(0.0);
    let geom = add(&mut simulator, outline, position, rotation);
    simulator.geom(geom).unwrap().distance_grid().unwrap().clone()
}

fn rectangle(width: f32, height: f32) -> Vertices {
    Vertices::create_rectangle(width, height).unwrap()
}

fn node(grid: &DistanceGrid, x: usize, y: usize) -> f32 {
    grid.nodes()[x * grid.size().1 + y]
}

/// Check 1.
#[test]
fn a_square_has_its_known_grid() {
    let grid = grid_of(rectangle(10.0, 10.0), (0.0, 0.0), 0.0);
    assert_eq!((grid.cell_size(), grid.inverse_cell_size(), grid.size()), (1.0, 1.0, (11, 11)));
    let row = |y| (0..11).map(|x| node(&grid, x, y)).collect::<Vec<f32>>();
    assert_eq!(row(5), [0.0, -1.0, -2.0, -3.0, -4.0, -5.0, -4.0, -3.0, -2.0, -1.0, 0.0]);
    assert_eq!(row(2), [0.0, -1.0, -2.0, -2.0, -2.0, -2.0, -2.0, -2.0, -2.0, -1.0, 0.0]);
    assert_eq!(row(0), [0.0; 11]);
}

/// Check 2.
#[test]
fn points_are_sampled_in_the_grid() {
    let grid = grid_of(rectangle(10.0, 10.0), (0.0, 0.0), 0.0);
    let expect = |point, normal: &str, distance: &str| {
        let feature = grid.intersect(point).unwrap();
        assert_words(&feature.normal, normal);
        assert_words(&feature.distance, distance);
        assert_eq!(feature.position, point);
    };
    expect(v(3.3, -1.7), "3f800000 00000000", "bfd9999a");
    expect(v(0.0, 0.0), "3f3504f3 3f3504f3", "c0a00000");
    expect(v(4.9999, 0.5), "3f800000 00000000", "b8d20000");
    assert_eq!(grid.intersect(v(5.0, 0.0)), None);
}

/// Check 3.
#[test]
fn the_automatic_cell_size_depends_on_the_rotation() {
    let grid = grid_of(rectangle(8.0, 3.0), (100.0, 50.0), 0.4);
    assert_words(&grid.cell_size(), "3f167d8d");
    assert_words(&grid.inverse_cell_size(), "3fd9bdcd");
    assert_eq!((grid.size(), grid.aabb().min), ((15, 7), v(-4.0, -1.5)));
    assert_eq!(node(&grid, 0, 0), 0.0);
    assert_words(&node(&grid, 14, 6), "3f13392a");
    assert_words(&node(&grid, 7, 2), "bf967d8d");
    let upright = grid_of(rectangle(8.0, 3.0), (100.0, 50.0), 0.0);
    assert_words(&upright.cell_size(), "3e99999a");
    assert_eq!(upright.size(), (28, 11));
}

/// The squares of checks 4 to 6, A made first or second, and their contacts with `limit` looked for.
fn square_contacts(a_is_first: bool, limit: i32) -> Vec<Contact> {
    let mut simulator = simulator(0.0);
    let poses = [((0.0, 0.0), 0.0), ((9.0, 1.0), 0.1)];
    let order = if a_is_first { [0, 1] } else { [1, 0] };
    for index in order {
        add(&mut simulator, rectangle(10.0, 10.0), poses[index].0, poses[index].1);
    }
    simulator.set_max_contacts_to_detect(limit);
    simulator.set_max_contacts_to_resolve(100).unwrap();
    assert!(simulator.process_queues(0.01, None));
    simulator.find_pairs(None);
    simulator.collide_pairs(None);
    simulator.arbiters().next().map_or(Vec::new(), |arbiter| arbiter.contacts().collect())
}

/// Check 4: position, normal, separation, owner (0 is A) and vertex.
const CONTACTS: [(&str, &str, &str, u32, i32); 8] = [
    ("4090c5ce c08f2c8c", "3f3dcfd0 bf2bc707", "be801b7f", 1, 0),
    ("4088c938 bffe4b74", "3f800000 00000000", "bf39b640", 1, 1),
    ("4080cca1 3f003696", "3f800000 00000000", "bf799af8", 1, 2),
    ("4071a014 403f4104", "3f800000 00000000", "bf9cbfd8", 1, 3),
    ("40a00000 40a00000", "3e270e42 bf7c9200", "bf1375b2", 0, 24),
    ("40a00000 40200000", "3f7eb898 3dcc7577", "bf95b9d0", 0, 25),
    ("40a00000 00000000", "3f7eb898 3dcc7577", "bf6b8eea", 0, 26),
    ("40a00000 c0200000", "3f7eb898 3dcc7577", "bf2baa32", 0, 27),
];

fn expect_contact(
    contacts: &[Contact],
    (position, normal, separation, owner, vertex): (&str, &str, &str, u32, i32),
) {
    let found = contacts.iter().find(|contact| contact.id.geom1 == owner && contact.id.vertex == vertex);
    let contact = found.unwrap_or_else(|| panic!("no contact of vertex {vertex} of {owner}: {contacts:?}"));
    assert_eq!(contact.id.geom2, 1 - owner);
    assert_words(&contact.position, position);
    assert_words(&contact.normal, normal);
    assert_words(&contact.separation, separation);
}

/// Check 4.
#[test]
fn two_squares_touch_at_eight_vertices() {
    let contacts = square_contacts(true, 10);
    assert_eq!(contacts.len(), 8);
    CONTACTS.into_iter().for_each(|expected| expect_contact(&contacts, expected));
}

/// Check 5: with B made first the vertices are counted from A's, and the normals have the opposite direction.
#[test]
fn the_order_of_creation_decides_numbers_and_normals() {
    let contacts = square_contacts(false, 10);
    assert_eq!(contacts.len(), 8);
    let mut ids: Vec<(u32, i32)> =
        contacts.iter().map(|contact| (contact.id.geom1, contact.id.vertex)).collect();
    ids.sort_unstable();
    // Number 0 is B now.
    assert_eq!(ids, [(0, 16), (0, 17), (0, 18), (0, 19), (1, 8), (1, 9), (1, 10), (1, 11)]);
    let negated = contacts.iter().find(|contact| contact.id.geom1 == 0 && contact.id.vertex == 17).unwrap();
    assert_words(&negated.normal, "bf800000 80000000");
}

/// Check 6.
#[test]
fn the_limit_stops_the_search() {
    let two = square_contacts(true, 2);
    assert_eq!(two.len(), 2);
    CONTACTS[..2].iter().for_each(|&expected| expect_contact(&two, expected));
    assert_eq!(square_contacts(true, -1).len(), 8);
    assert_eq!(square_contacts(true, 0).len(), 0);
}

/// Check 7.
#[test]
fn a_circle_has_its_known_grid() {
    let grid = grid_of(Vertices::create_circle(5.0, 16).unwrap(), (0.0, 0.0), 0.0);
    assert_eq!((grid.cell_size(), grid.size()), (1.0, (11, 11)));
    assert_words(&node(&grid, 5, 5), "c09cecf6");
    assert_words(&node(&grid, 3, 7), "c0084f67");
    assert_words(&node(&grid, 0, 0), "40048c60");
    let feature = grid.intersect(v(1.0, 2.0)).unwrap();
    assert_words(&feature.normal, "3f0472ac 3f5b1306");
    assert_words(&feature.distance, "c02bdde0");
}

/// Check 8: the original fails there.
#[test]
fn a_point_whose_cell_reaches_past_the_last_node_is_outside() {
    let grid = grid_of(rectangle(640.0, 640.0), (0.0, 0.0), 0.0);
    assert_eq!((grid.cell_size(), grid.size()), (64.0, (11, 11)));
    assert_eq!(grid.intersect(v(f32::from_bits(0x439f_ffff), 0.0)), None);
    assert!(grid.intersect(v(319.0, 0.0)).is_some());
}

/// Check 10.
#[test]
fn degenerate_outlines_have_grids_of_few_nodes() {
    let line: Vertices = [v(0.0, 0.0), v(5.0, 0.0)].into_iter().collect();
    assert_eq!(DistanceGrid::new(line, 1.0).unwrap().size(), (6, 1));
    let point: Vertices = [v(2.0, 3.0)].into_iter().collect();
    let grid = DistanceGrid::new(point, 1.0).unwrap();
    assert_eq!((grid.size(), grid.nodes()), ((1, 1), &[0.0][..]));
}

/// Check 11.
#[test]
fn a_negative_cell_size_is_automatic() {
    let mut simulator = simulator(0.0);
    let body = simulator.create_body(Body::new());
    let outline = Vertices::create_simple_rectangle(4.0, 2.0).unwrap();
    let geom = simulator.create_geom(body, outline, GeomPlacement::with_grid_size(-3.0)).unwrap();
    assert_words(&simulator.geom(geom).unwrap().grid_cell_size(), "3e4ccccd");
}

#[test]
fn cell_sizes_without_a_grid_are_refused() {
    for bad in [0.0, -1.0, f32::NAN, f32::INFINITY, 1e-30] {
        let refused = DistanceGrid::new(rectangle(10.0, 10.0), bad);
        assert!(
            matches!(refused, Err(Error::InvalidArgument { argument: "collision_grid_size", .. })),
            "{bad}"
        );
    }
}

/// A geom without a grid, made under SAT, has no contacts under the distance grid.
#[test]
fn geoms_without_a_grid_have_no_contacts() {
    use farseer_core::NarrowPhaseCollider;
    let mut simulator = simulator(0.0);
    simulator.set_narrow_phase_collider(NarrowPhaseCollider::Sat);
    let a = add(&mut simulator, rectangle(10.0, 10.0), (0.0, 0.0), 0.0);
    simulator.set_narrow_phase_collider(NarrowPhaseCollider::DistanceGrid);
    let b = add(&mut simulator, rectangle(10.0, 10.0), (9.0, 1.0), 0.0);
    simulator.update(0.01);
    let separation = |this, other| Event::Separation { this, other };
    assert_eq!(simulator.arbiter_count(), 0);
    assert_eq!(simulator.events()[simulator.events().len() - 2..], [separation(a, b), separation(b, a)]);
}
