//! Queries of a simulator (behaviour chapters 04 and 09) and convex pieces (chapters 05 and 13.3) against the
//! record.

use conformance::units::{Words, assert_bits, assert_words, cases, check, floats, vertices};
use farseer_core::math::Vector2;
use farseer_core::{Body, Error, GeomFactory, GeomId, GeomPlacement, NarrowPhaseCollider, PhysicsSimulator};
use serde_json::Value;

fn text<'a>(record: &'a Value, key: &str) -> &'a str {
    record[key].as_str().unwrap_or_else(|| panic!("no {key} in {record}"))
}

fn recorded_scene(geoms: &[Value]) -> (PhysicsSimulator, Vec<GeomId>) {
    let mut simulator = PhysicsSimulator::default();
    simulator.set_narrow_phase_collider(NarrowPhaseCollider::Sat);
    let mut ids = Vec::new();
    for record in geoms {
        let body = simulator.create_body(Body::new());
        let [position] = vertices(text(record, "position"))[..] else { panic!("{record}") };
        let [rotation] = floats(text(record, "rotation"))[..] else { panic!("{record}") };
        simulator[body].set_position(position);
        simulator[body].set_rotation(rotation);
        let outline = vertices(text(record, "vertices"));
        ids.push(simulator.create_geom(body, outline, GeomPlacement::default()).unwrap());
        simulator.add(body).unwrap();
        simulator.add(ids[ids.len() - 1]).unwrap();
    }
    simulator.process_added_and_removed();
    (simulator, ids)
}

#[test]
fn segments_and_points_meet_the_recorded_geoms() {
    check("rays", "LineSegmentAllGeomsIntersect", |case| {
        let (simulator, geoms) = recorded_scene(case.input.value("geoms").as_array().unwrap());
        let index_of = |geom: GeomId| geoms.iter().position(|&other| other == geom).unwrap() as i64;
        let hits = simulator.line_segment_all_geoms_intersect(
            case.input.vector("p1"),
            case.input.vector("p2"),
            case.input.boolean("use_aabb"),
        );
        let recorded = case.output.value("hits").as_array().unwrap();
        assert_eq!(hits.len(), recorded.len());
        for (hit, record) in hits.iter().zip(recorded) {
            assert_eq!(index_of(hit.geom), record["geom"].as_i64().unwrap());
            assert_words(&hit.points, text(record, "points"));
        }
        let point = case.input.vector("collide_point");
        let first = simulator.collide(point).map_or(-1, index_of);
        assert_eq!(first, i64::from(case.output.integer("collide")));
        let all: Vec<Value> = simulator.collide_all(point).into_iter().map(|g| index_of(g).into()).collect();
        assert_eq!(&all, case.output.value("collide_all").as_array().unwrap());
    });
}

fn decompose(outline: &farseer_core::Vertices, max_geoms: i32) -> farseer_core::Result<Pieces> {
    let mut simulator = PhysicsSimulator::default();
    simulator.set_narrow_phase_collider(NarrowPhaseCollider::Sat);
    let body = simulator.create_body(Body::new());
    simulator[body].set_position(Vector2::new(2.0, 3.0));
    let geoms = GeomFactory::create_sat_polygon_geom(&mut simulator, body, outline, max_geoms)?;
    Ok(Pieces { simulator, geoms })
}

/// The argument that was refused.
fn refused_argument(pieces: farseer_core::Result<Pieces>) -> &'static str {
    match pieces.map(|pieces| pieces.geoms) {
        Err(Error::InvalidArgument { argument, .. }) => argument,
        other => panic!("{other:?}"),
    }
}

struct Pieces {
    simulator: PhysicsSimulator,
    geoms: Vec<GeomId>,
}

#[test]
fn polygons_are_cut_into_the_recorded_geoms() {
    let mut refused = 0;
    for case in cases("hull_decompose", "DecomposeGeom") {
        let outline = case.input.vertices("vertices");
        let pieces = decompose(&outline, case.input.integer("max_polys"));
        assert!(case.throws().is_none() && !case.hangs());
        let (local, world) = (case.output.vertex_lists("pieces"), case.output.vertex_lists("world"));
        if world.iter().any(|outline| outline.iter().any(|v| v.x.is_nan())) {
            // An outline without area has no centroid; the original goes on with NaN.
            assert_eq!(refused_argument(pieces), "vertices", "given {:?}", case.input);
            refused += 1;
            continue;
        }
        let Pieces { simulator, geoms } = pieces.unwrap();
        assert_eq!((geoms.len(), geoms.len()), (local.len(), world.len()));
        for ((&id, local), world) in geoms.iter().zip(&local).zip(&world) {
            let geom = simulator.geom(id).unwrap();
            assert_bits(&geom.local_vertices().words(), &local.words(), || format!("{:?}", case.input));
            assert_bits(&geom.world_vertices().words(), &world.words(), || format!("{:?}", case.input));
        }
        case.output.assert_all_read();
    }
    assert_eq!(refused, 9);
}
