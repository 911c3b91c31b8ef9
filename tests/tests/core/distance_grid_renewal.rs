//! Distance grids that are taken away and made again (behaviour chapter 06, section 2).

use conformance::fixtures::plane::{add_circle, add_floor, simulator, v};
use farseer_core::{
    BodyFactory, BodyId, Error, GeomFactory, GeomId, GeomPlacement, NarrowPhaseCollider, PhysicsSimulator,
    Vertices,
};

/// Where the floor is: not at the origin, where boxes would be right by chance.
const FLOOR: (f32, f32) = (50.0, 300.0);
/// Distance in px by which its outline is moved.
const MOVED: f32 = 400.0;

fn scene() -> (PhysicsSimulator, BodyId, GeomId) {
    let mut simulator = simulator(100.0);
    let (body, floor) = add_floor(&mut simulator, (100.0, 20.0), v(FLOOR.0, FLOOR.1));
    (simulator, body, floor)
}

fn moved_outline(simulator: &PhysicsSimulator, geom: GeomId) -> Vertices {
    let mut outline = simulator.geom(geom).unwrap().local_vertices().clone();
    outline.translate(v(MOVED, 0.0));
    outline
}

fn move_outline(simulator: &mut PhysicsSimulator, geom: GeomId) {
    let outline = moved_outline(simulator, geom);
    simulator.set_vertices(geom, outline).unwrap();
}

fn renew(simulator: &mut PhysicsSimulator, geom: GeomId) {
    simulator.remove_distance_grid(geom).unwrap();
    simulator.create_distance_grid(geom).unwrap();
}

/// Whether a ball that is dropped at an x comes to rest on the floor. It falls 80 and more in 5 s.
fn bears(simulator: &mut PhysicsSimulator, x: f32) -> bool {
    let (ball, _) = add_circle(simulator, 10.0, 16, v(x, FLOOR.1 - 40.0));
    for _ in 0..500 {
        simulator.update(0.01);
    }
    simulator[ball].position().y < FLOOR.1
}

#[test]
fn a_geom_with_a_new_grid_collides_at_its_outline() {
    let (mut simulator, _, floor) = scene();
    move_outline(&mut simulator, floor);
    renew(&mut simulator, floor);
    assert!(bears(&mut simulator, FLOOR.0 + MOVED));
    assert!(!bears(&mut simulator, FLOOR.0));
}

#[test]
fn a_new_outline_without_a_new_grid_does_not_collide() {
    let (mut simulator, _, floor) = scene();
    move_outline(&mut simulator, floor);
    assert!(!bears(&mut simulator, FLOOR.0 + MOVED));
}

#[test]
fn a_new_grid_brings_box_and_world_vertices_to_the_geom() {
    let (mut simulator, body, floor) = scene();
    simulator[body].set_rotation(0.5);
    move_outline(&mut simulator, floor);
    renew(&mut simulator, floor);
    let geom = simulator.geom(floor).unwrap();
    let expected: Vertices = geom.local_vertices().iter().map(|&p| geom.get_world_position(p)).collect();
    for (&vertex, &expected) in geom.world_vertices().iter().zip(expected.iter()) {
        // The same sums, but for terms of zero.
        assert_eq!(vertex, expected);
        assert!(vertex >= geom.aabb().min && vertex <= geom.aabb().max, "{vertex}");
    }
}

#[test]
fn a_clone_keeps_the_grid_that_was_shared() {
    let (mut simulator, _, floor) = scene();
    let elsewhere = BodyFactory::create_rectangle_body_in(&mut simulator, 100.0, 20.0, 1.0).unwrap();
    simulator[elsewhere].set_is_static(true);
    simulator[elsewhere].set_position(v(-500.0, FLOOR.1));
    let clone = simulator.clone_geom(elsewhere, floor).unwrap();
    simulator.add(clone).unwrap();
    let shared = simulator.geom(clone).unwrap().distance_grid().unwrap().clone();

    move_outline(&mut simulator, floor);
    renew(&mut simulator, floor);
    assert_eq!(simulator.geom(clone).unwrap().distance_grid(), Some(&shared));
    assert_ne!(simulator.geom(floor).unwrap().distance_grid(), Some(&shared));
    assert!(bears(&mut simulator, -500.0));
    assert!(bears(&mut simulator, FLOOR.0 + MOVED));
}

#[test]
fn an_existing_grid_is_not_made_again() {
    let (mut simulator, _, floor) = scene();
    move_outline(&mut simulator, floor);
    let before = simulator.snapshot();
    simulator.create_distance_grid(floor).unwrap();
    assert_eq!(simulator.snapshot(), before);
}

#[test]
fn a_geom_without_a_grid_collides_with_nothing() {
    let (mut simulator, _, floor) = scene();
    for _ in 0..2 {
        simulator.remove_distance_grid(floor).unwrap();
    }
    assert!(simulator.geom(floor).unwrap().distance_grid().is_none());
    assert!(!simulator.geom_collides_with_point(floor, v(FLOOR.0, FLOOR.1)));
    assert!(!bears(&mut simulator, FLOOR.0));
}

#[test]
fn the_cell_size_stays_when_a_grid_is_made_again() {
    let (mut simulator, _, floor) = scene();
    let before = simulator.geom(floor).unwrap().grid_cell_size();
    // A fraction of this size would be another.
    simulator.set_vertices(floor, Vertices::create_rectangle(300.0, 90.0).unwrap()).unwrap();
    renew(&mut simulator, floor);
    let geom = simulator.geom(floor).unwrap();
    assert_eq!((before, geom.grid_cell_size()), (2.0, 2.0));
    assert_eq!(geom.distance_grid().unwrap().size(), (151, 46));
}

#[test]
fn a_geom_made_under_separating_axes_gets_a_grid_by_its_present_box() {
    let (mut simulator, body, _) = scene();
    simulator.set_narrow_phase_collider(NarrowPhaseCollider::Sat);
    let placement = GeomPlacement::default();
    let geom = GeomFactory::create_rectangle_geom_in(&mut simulator, body, 60.0, 30.0, placement).unwrap();
    assert_eq!(simulator.geom(geom).unwrap().grid_cell_size(), 0.0);
    simulator.create_distance_grid(geom).unwrap();
    assert_eq!(simulator.geom(geom).unwrap().grid_cell_size(), 3.0);
    simulator.set_narrow_phase_collider(NarrowPhaseCollider::DistanceGrid);
    assert!(simulator.geom_collides_with_point(geom, v(FLOOR.0, FLOOR.1 - 12.0)));
}

#[test]
fn an_impossible_grid_changes_no_state() {
    let (mut simulator, body, _) = scene();
    simulator.set_narrow_phase_collider(NarrowPhaseCollider::Sat);
    let flat: Vertices = [v(-10.0, 0.0), v(0.0, 0.0), v(10.0, 0.0)].into_iter().collect();
    let geom = simulator.create_geom(body, flat, GeomPlacement::default()).unwrap();
    simulator.process_added_and_removed();
    let before = simulator.snapshot();
    let refused = simulator.create_distance_grid(geom);
    assert!(
        matches!(refused, Err(Error::InvalidArgument { argument: "collision_grid_size", .. })),
        "{refused:?}"
    );
    assert_eq!(simulator.snapshot(), before);
}

#[test]
fn a_disposed_geom_with_a_new_grid_is_removed_like_any_other() {
    let (mut simulator, _, floor) = scene();
    simulator.dispose(floor).unwrap();
    simulator.create_distance_grid(floor).unwrap();
    simulator.update(0.01);
    let stale = Err(Error::StaleId { argument: "geom" });
    assert_eq!(simulator.create_distance_grid(floor), stale);
    assert_eq!(simulator.remove_distance_grid(floor), stale);
}

#[test]
fn a_renewed_grid_is_saved() {
    let (mut simulator, _, floor) = scene();
    move_outline(&mut simulator, floor);
    renew(&mut simulator, floor);
    let mut twin = simulator.clone();
    twin.restore(&simulator.snapshot()).unwrap();
    assert!(bears(&mut simulator, FLOOR.0 + MOVED));
    assert!(bears(&mut twin, FLOOR.0 + MOVED));
    assert_eq!(twin.snapshot(), simulator.snapshot());
}
