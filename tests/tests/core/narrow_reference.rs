//! The distance grid's contacts against plain ones: behaviour chapter 06, section 4, every vertex of both geoms in
//! turn, without the engine's shortcuts.

use conformance::fixtures::plane::{Random, simulator, v};
use farseer_core::math::Matrix;
use farseer_core::{Body, Contact, ContactId, GeomId, GeomPlacement, GeomRef, PhysicsSimulator, Vertices};

/// Contacts of the vertices of one geom in the grid of another.
fn plain_half(
    owner: GeomRef<'_>,
    other: GeomRef<'_>,
    first: i32,
    direction: f32,
    limit: i32,
    found: &mut Vec<Contact>,
) {
    let Some(grid) = other.distance_grid() else { return };
    for (i, &vertex) in owner.world_vertices().iter().enumerate() {
        if found.len() as i64 == i64::from(limit) {
            return;
        }
        let Some(feature) = grid.intersect(other.transform_to_local_coordinates(vertex)) else { continue };
        if feature.distance < 0.0 {
            let normal = other.transform_normal_to_world(feature.normal) * direction;
            let id = ContactId { geom1: owner.id(), vertex: first + i as i32, geom2: other.id() };
            found.push(Contact::new(vertex, normal, feature.distance, id));
        }
    }
}

fn plain_contacts(a: GeomRef<'_>, b: GeomRef<'_>, limit: i32) -> Vec<Contact> {
    let mut found = Vec::new();
    if a.distance_grid().is_some() && b.distance_grid().is_some() {
        plain_half(b, a, 0, 1.0, limit, &mut found);
        plain_half(a, b, b.world_vertices().len() as i32, -1.0, limit, &mut found);
    }
    found.sort_by(|x, y| x.separation.partial_cmp(&y.separation).unwrap());
    found
}

/// Zeros of both signs are one here: the general inverse of a matrix and the plain one differ in them.
fn bits(contacts: &[Contact]) -> Vec<(u32, i32, u32, [u32; 5])> {
    let bits = |c: &Contact| {
        [c.position.x, c.position.y, c.normal.x, c.normal.y, c.separation].map(|x| (x + 0.0).to_bits())
    };
    contacts.iter().map(|c| (c.id.geom1, c.id.vertex, c.id.geom2, bits(c))).collect()
}

fn outline(random: &mut Random) -> Vertices {
    let size = random.between(5.0, 60.0);
    let made = match random.below(6) {
        0 => Vertices::create_rectangle(size, random.between(3.0, 60.0)),
        1 => Vertices::create_simple_rectangle(size, random.between(3.0, 60.0)),
        2 => Vertices::create_circle(size / 2.0, 3 + random.below(60) as i32),
        3 => Vertices::create_ellipse(size / 2.0, random.between(2.0, 20.0), 3 + random.below(40) as i32),
        4 => Vertices::create_gear(size / 3.0, 3 + random.below(12) as i32, 0.5, random.between(-3.0, 8.0)),
        _ => Vertices::create_capsule(size, size * 0.3, 3 + random.below(9) as i32),
    };
    let mut made = made.unwrap();
    if random.below(3) == 0 {
        // Off centre, so that the origin is no inner point.
        made.translate(v(random.between(-40.0, 40.0), random.between(-40.0, 40.0)));
    }
    made
}

/// A geom near a centre, on a body of its own.
fn add(simulator: &mut PhysicsSimulator, random: &mut Random, centre: (f32, f32)) -> GeomId {
    let body = simulator.create_body(Body::new());
    simulator[body]
        .set_position(v(centre.0 + random.between(-30.0, 30.0), centre.1 + random.between(-30.0, 30.0)));
    simulator[body].set_rotation(random.pick(&[0.0, 0.3, 1.570_796_4, 2.0, -1.0, 4000.0, 3e9]));
    let placement = GeomPlacement {
        offset: v(random.between(-5.0, 5.0), 0.0),
        rotation_offset: random.pick(&[0.0, 0.7, -2.0]),
        collision_grid_size: random.pick(&[0.0, 0.0, 1.5, 4.0, 20.0]),
    };
    let outline = outline(random);
    let geom = simulator.create_geom(body, outline, placement).unwrap();
    simulator.add(geom).unwrap();
    geom
}

/// Pairs of random geoms, of which `edit` changes the first or replaces it by another one before they meet.
fn pairs_touch_as_plain(edit: impl Fn(&mut PhysicsSimulator, &mut Random, GeomId) -> GeomId) {
    let mut touching = 0;
    for seed in 0..1500 {
        let mut random = Random::new(seed);
        let mut simulator = simulator(0.0);
        let limit = random.pick(&[10, 10, 3, -1, 100]);
        simulator.set_max_contacts_to_detect(limit);
        simulator.set_max_contacts_to_resolve(1000).unwrap();
        // Far from the origin positions are coarse, and near it the margin of the box matters.
        let far = random.pick(&[0.0, 0.0, 300.0, 50_000.0, 3e6]);
        let [a, b] = [(); 2].map(|()| add(&mut simulator, &mut random, (far, -far)));
        let a = edit(&mut simulator, &mut random, a);
        assert!(simulator.process_queues(0.01, None));
        simulator.find_pairs(None);
        simulator.collide_pairs(None);
        let found = simulator.arbiters().next().map_or(Vec::new(), |arbiter| arbiter.contacts().collect());
        let mut pair = [a, b].map(|geom| simulator.geom(geom).unwrap());
        pair.sort_by_key(|geom| geom.id());
        let [a, b] = pair;
        assert!(simulator.arbiter_count() <= 1);
        if farseer_core::Aabb::intersect(&a.aabb(), &b.aabb()) {
            assert_eq!(bits(&found), bits(&plain_contacts(a, b, limit)), "seed {seed}");
        }
        touching += u32::from(!found.is_empty());
    }
    assert!(touching > 300, "only {touching} pairs touch");
}

#[test]
fn contacts_equal_those_of_a_test_of_every_vertex() {
    pairs_touch_as_plain(|_, _, geom| geom);
}

/// The grid stays that of the old outline, however far that reaches beyond the new one.
#[test]
fn contacts_of_geoms_with_a_new_outline_equal_those_of_a_test_of_every_vertex() {
    pairs_touch_as_plain(|simulator, random, geom| {
        let new = Vertices::create_rectangle(random.between(2.0, 12.0), random.between(2.0, 12.0)).unwrap();
        simulator.set_vertices(geom, new).unwrap();
        let body = simulator.geom(geom).unwrap().body();
        let position = simulator[body].position();
        simulator[body].set_position(position);
        geom
    });
}

/// A matrix of the user's, which shears and scales, lasts until the body moves.
#[test]
fn contacts_of_geoms_with_a_matrix_equal_those_of_a_test_of_every_vertex() {
    pairs_touch_as_plain(|simulator, random, geom| {
        simulator.process_added_and_removed();
        let mut matrix: Matrix = simulator.geom(geom).unwrap().matrix();
        matrix.m12 += random.between(-0.5, 0.5);
        matrix.m11 *= random.between(0.5, 2.0);
        simulator.set_matrix(geom, &matrix).unwrap();
        geom
    });
}

/// A clone shares the grid of its source, whose outline may be another one by then.
#[test]
fn contacts_of_clones_with_a_new_outline_equal_those_of_a_test_of_every_vertex() {
    pairs_touch_as_plain(|simulator, random, geom| {
        let new = Vertices::create_circle(random.between(2.0, 9.0), 9).unwrap();
        simulator.set_vertices(geom, new).unwrap();
        let body = simulator.create_body(Body::new());
        let old_body = simulator.geom(geom).unwrap().body();
        let position = simulator[old_body].position();
        simulator[body].set_position(position);
        simulator[body].set_rotation(0.4);
        let clone = simulator.clone_geom(body, geom).unwrap();
        simulator.add(clone).unwrap();
        simulator.dispose(geom).unwrap();
        clone
    });
}
