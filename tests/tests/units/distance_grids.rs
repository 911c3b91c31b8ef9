//! Distance grids of behaviour chapter 06, and the geoms that carry them, against the record.

use conformance::units::{Case, assert_bits, assert_words, check, floats, vertices};
use farseer_core::math::Vector2;
use farseer_core::{Aabb, BodyId, Contact, DistanceGrid, Feature, GeomId, GeomPlacement, PhysicsSimulator};
use serde_json::Value;

fn text<'a>(record: &'a Value, key: &str) -> &'a str {
    record[key].as_str().unwrap_or_else(|| panic!("no {key} in {record}"))
}

fn point(record: &Value) -> Vector2 {
    let [point] = vertices(text(record, "point"))[..] else { panic!("{record}") };
    point
}

fn expect_box(aabb: Aabb, words: &str) {
    assert_words(&[aabb.min, aabb.max][..], words);
}

fn expect_feature(feature: &Feature, record: &Value) {
    assert_words(&feature.distance, text(record, "distance"));
    assert_words(&feature.normal, text(record, "normal"));
    assert_words(&feature.position, text(record, "position"));
}

fn recorded_geom(case: &Case) -> (PhysicsSimulator, BodyId, GeomId) {
    let mut simulator = PhysicsSimulator::default();
    let body = simulator.create_body(farseer_core::Body::new());
    simulator[body].set_position(case.input.vector("body_position"));
    simulator[body].set_rotation(case.input.f32("body_rotation"));
    let placement = GeomPlacement::with_grid_size(case.input.f32("collision_grid_size"));
    let geom = simulator.create_geom(body, case.input.vertices("vertices"), placement).unwrap();
    (simulator, body, geom)
}

fn expect_grid(case: &Case, grid: &DistanceGrid) {
    case.expect("grid_cell_size_inv", &grid.inverse_cell_size());
    case.expect("grid_cell_size", &grid.cell_size());
    expect_box(grid.aabb(), case.output.text("aabb"));
    assert_eq!(grid.size().0, case.output.integer("x_size") as usize);
    assert_eq!(grid.size().1, case.output.integer("y_size") as usize);
    assert_bits(grid.nodes(), &floats(case.output.text("nodes")), || "nodes".to_owned());
}

#[test]
fn grids_return_the_recorded_values() {
    check("distance_grid", "DistanceGrid", |case| {
        let (simulator, _, id) = recorded_geom(case);
        let geom = simulator.geom(id).unwrap();
        let grid = geom.distance_grid().unwrap();
        expect_grid(case, grid);
        case.expect("grid_cell_size", &geom.grid_cell_size());
        case.expect("local_vertices", geom.local_vertices());
        case.expect("world_vertices", &*geom.world_vertices());
        expect_box(geom.aabb(), case.output.text("world_aabb"));
        case.expect("matrix", &geom.matrix());
        case.expect("matrix_inverse", &geom.matrix_inverse());
        for query in case.output.value("queries").as_array().unwrap() {
            let point = point(query);
            assert_words(&geom.get_nearest_distance(point), text(query, "nearest_distance"));
            let feature = grid.intersect(point);
            assert_eq!(feature.is_some(), query["hit"].as_bool().unwrap(), "{query}");
            if let Some(feature) = feature {
                expect_feature(&feature, query);
            }
        }
        for nearest in case.output.value("nearest_features").as_array().unwrap() {
            let index = nearest["index"].as_u64().unwrap() as usize;
            expect_feature(&geom.get_nearest_feature(point(nearest), index), nearest);
        }
    });
}

#[test]
fn contacts_are_searched_as_recorded() {
    use farseer_core::{ContactId, index_of_safe};
    let id_of = |words: &Value| {
        let number = |i: usize| words[i].as_i64().unwrap();
        ContactId { geom1: number(0) as u32, vertex: number(1) as i32, geom2: number(2) as u32 }
    };
    let contact = |id| Contact::new(Vector2::zeros(), Vector2::zeros(), 0.0, id);
    check("pair_bitmap", "ContactListIndexOfSafe", |case| {
        let ids = case.input.value("ids").as_array().unwrap();
        let contacts: Vec<Contact> = ids.iter().map(|id| contact(id_of(id))).collect();
        let found = index_of_safe(&contacts, &contact(id_of(case.input.value("probe"))));
        assert_eq!(found.map_or(-1, |index| index as i32), case.output.integer("index"));
    });
}
