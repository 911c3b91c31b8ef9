//! Exceptions of the original, against the record: here an error that names the argument.

use std::collections::BTreeMap;
use std::io::Read;

use farseer_core::math::Vector2;
use farseer_core::shape::Vertices;
use farseer_core::{
    Body, BodyFactory, BodyId, BroadPhaseCollider, Contact, Context, Error, Event, EventHandler, GeomFactory,
    GeomId, GeomPlacement, PhysicsSimulator, Result,
};

/// Cases that hand over a null reference: Rust has none, so there is no call to refuse.
const NULL_REFERENCES: [&str; 14] = [
    "Simulator.Add(null geom)",
    "Simulator.Remove(null geom)",
    "Simulator.Add(null body)",
    "Simulator.Remove(null body)",
    "Simulator.Add(null joint)",
    "Simulator.Add(null spring)",
    "Simulator.Add(null controller)",
    "CreatePolygonBody null",
    "CreatePolygonGeom null body",
    "CreatePolygonGeom null vertices",
    "CreateSATPolygonGeom null body",
    "CreateSATPolygonGeom null vertices",
    "DistanceGrid.CreateDistanceGrid(null)",
    "CurveKeyCollection.Add(null)",
];

/// Cases of parts that have tests of their own, or no counterpart in the port.
const ELSEWHERE: [(&str, &str); 12] = [
    ("FixedRevoluteJoint.Anchor without body", "joints without bodies"),
    ("RevoluteJoint.SetInitialAnchor without body", "joints without bodies"),
    ("WeldJoint.SetInitialAnchor without body", "joints without bodies"),
    ("PinJoint.Anchor1 without body", "joints without bodies"),
    ("CreateFixedRevoluteJoint on static body then Enabled", "joints"),
    ("Angle joint with NaN impulse", "joints"),
    ("Curve.ComputeTangent index -1", "curves"),
    ("Curve.ComputeTangent index too large", "curves"),
    ("Curve.Evaluate without keys", "curves"),
    ("Path.Update with no control points", "paths"),
    ("Vertices.CreateCapsule endRadius too large", "outlines"),
    ("DistanceGrid.Copy existing target", "grids belong to geoms and are not entered under ids"),
];

/// The exception and the parameter it names, by name of the case.
fn recorded() -> BTreeMap<String, (Option<String>, Option<String>)> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/golden/units/exceptions.json.gz");
    let mut text = String::new();
    flate2::read::GzDecoder::new(std::fs::File::open(path).unwrap()).read_to_string(&mut text).unwrap();
    let record: serde_json::Value = serde_json::from_str(&text).unwrap();
    let field = |case: &serde_json::Value, key: &str| case["out"][key].as_str().map(str::to_owned);
    let cases = record["cases"].as_array().unwrap().iter();
    cases
        .map(|case| {
            (case["fn"].as_str().unwrap().to_owned(), (field(case, "throws"), field(case, "parameter")))
        })
        .collect()
}

/// The argument that a call refused; `None` if it went well.
fn refused<T>(result: Result<T>) -> Option<&'static str> {
    match result {
        Ok(_) => None,
        Err(Error::InvalidArgument { argument, .. }) => Some(argument),
        Err(Error::GeomListNotEmpty) => Some("the geom list"),
        Err(Error::MissingDistanceGrid { argument }) => Some(argument),
        Err(error) => panic!("{error:?}"),
    }
}

fn outline(points: &[(f32, f32)]) -> Vertices {
    points.iter().map(|&(x, y)| Vector2::new(x, y)).collect()
}

fn simulator() -> (PhysicsSimulator, BodyId) {
    let mut simulator = PhysicsSimulator::default();
    let body = simulator.create_body(Body::new());
    (simulator, body)
}

fn set_mass(value: f32) -> Option<&'static str> {
    refused(Body::new().set_mass(value))
}

fn set_moment_of_inertia(value: f32) -> Option<&'static str> {
    refused(Body::new().set_moment_of_inertia(value))
}

fn rectangle_geom(width: f32, height: f32) -> Option<&'static str> {
    let (mut simulator, body) = simulator();
    let placement = GeomPlacement::default();
    refused(GeomFactory::create_rectangle_geom(&mut simulator, body, width, height, placement))
}

fn ellipse_geom(x_radius: f32, y_radius: f32) -> Option<&'static str> {
    let (mut simulator, body) = simulator();
    let placement = GeomPlacement::default();
    refused(GeomFactory::create_ellipse_geom(&mut simulator, body, x_radius, y_radius, 8, placement))
}

fn circle_geom(radius: f32, edges: i32) -> Option<&'static str> {
    let (mut simulator, body) = simulator();
    refused(GeomFactory::create_circle_geom(&mut simulator, body, radius, edges, GeomPlacement::default()))
}

fn polygon_geom(points: &[(f32, f32)]) -> Option<&'static str> {
    let (mut simulator, body) = simulator();
    let mut vertices = outline(points);
    refused(GeomFactory::create_polygon_geom(&mut simulator, body, &mut vertices, GeomPlacement::default()))
}

fn polygon_body(points: &[(f32, f32)], mass: f32) -> Option<&'static str> {
    refused(BodyFactory::create_polygon_body(&outline(points), mass))
}

const TRIANGLE: [(f32, f32); 3] = [(0.0, 0.0), (3.0, 0.0), (0.0, 4.0)];
const LINE: [(f32, f32); 3] = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0)];

/// A simulator with one box in its geom list, or waiting to be.
fn with_box(is_processed: bool) -> (PhysicsSimulator, GeomId) {
    let (mut simulator, body) = simulator();
    simulator.add(body).unwrap();
    let placement = GeomPlacement::default();
    let geom = GeomFactory::create_rectangle_geom_in(&mut simulator, body, 10.0, 10.0, placement).unwrap();
    if is_processed {
        simulator.process_added_and_removed();
    }
    (simulator, geom)
}

fn set_broad_phase(is_processed: bool) -> Option<&'static str> {
    refused(with_box(is_processed).0.set_broad_phase_collider(BroadPhaseCollider::BruteForce))
}

fn clone_of_disposed_geom() -> Option<&'static str> {
    let (mut simulator, geom) = with_box(true);
    let body = simulator.create_body(Body::new());
    simulator.dispose(geom).unwrap();
    refused(simulator.clone_geom(body, geom))
}

/// Names of the arguments that the port refuses in each case, or `None` if it goes on.
fn port() -> Vec<(&'static str, Option<&'static str>)> {
    use BodyFactory as B;
    vec![
        ("BroadPhaseCollider set with geoms present", set_broad_phase(true)),
        ("BroadPhaseCollider set with geoms pending", set_broad_phase(false)),
        ("Body.Mass=0", set_mass(0.0)),
        ("Body.Mass=-1", set_mass(-1.0)),
        ("Body.MomentOfInertia=0", set_moment_of_inertia(0.0)),
        ("Body.MomentOfInertia=-1", set_moment_of_inertia(-1.0)),
        ("Body.MomentOfInertia=NaN", set_moment_of_inertia(f32::NAN)),
        ("CreateRectangleBody width 0", refused(B::create_rectangle_body(0.0, 1.0, 1.0))),
        ("CreateRectangleBody height -1", refused(B::create_rectangle_body(1.0, -1.0, 1.0))),
        ("CreateRectangleBody mass 0", refused(B::create_rectangle_body(1.0, 1.0, 0.0))),
        ("CreateCircleBody radius 0", refused(B::create_circle_body(0.0, 1.0))),
        ("CreateCircleBody mass -1", refused(B::create_circle_body(1.0, -1.0))),
        ("CreateEllipseBody xRadius 0", refused(B::create_ellipse_body(0.0, 1.0, 1.0))),
        ("CreateEllipseBody yRadius 0", refused(B::create_ellipse_body(1.0, 0.0, 1.0))),
        ("CreateEllipseBody mass 0", refused(B::create_ellipse_body(1.0, 1.0, 0.0))),
        ("CreatePolygonBody mass 0", polygon_body(&TRIANGLE, 0.0)),
        ("CreatePolygonBody empty", polygon_body(&[], 1.0)),
        ("CreatePolygonBody one vertex", polygon_body(&[(1.0, 1.0)], 1.0)),
        ("CreatePolygonBody collinear", polygon_body(&LINE, 1.0)),
        ("CreateBody mass 0", refused(B::create_body(0.0, 1.0))),
        ("CreateBody moment 0", refused(B::create_body(1.0, 0.0))),
        ("CreateBody moment -1", refused(B::create_body(1.0, -1.0))),
        ("CreateRectangleGeom width 0", rectangle_geom(0.0, 1.0)),
        ("CreateRectangleGeom height 0", rectangle_geom(1.0, 0.0)),
        ("CreateCircleGeom radius 0", circle_geom(0.0, 8)),
        ("CreateCircleGeom 2 edges", circle_geom(1.0, 2)),
        ("CreateCircleGeom 1 edge", circle_geom(1.0, 1)),
        ("CreateCircleGeom 0 edges", circle_geom(1.0, 0)),
        ("CreateEllipseGeom xRadius 0", ellipse_geom(0.0, 1.0)),
        ("CreateEllipseGeom yRadius 0", ellipse_geom(1.0, 0.0)),
        ("CreatePolygonGeom empty", polygon_geom(&[])),
        ("CreatePolygonGeom collinear", polygon_geom(&LINE)),
        // Grids are copied from geom to geom by cloning.
        ("DistanceGrid.Copy unknown id", clone_of_disposed_geom()),
        ("Geom clone after source disposed", clone_of_disposed_geom()),
        ("Vertices.GetMomentOfInertia empty", refused(outline(&[]).get_moment_of_inertia())),
        ("Vertices.GetMomentOfInertia one vertex", refused(outline(&[(1.0, 1.0)]).get_moment_of_inertia())),
        ("Vertices.ProjectToAxis empty", refused(outline(&[]).project_to_axis(Vector2::new(1.0, 0.0)))),
    ]
}

/// Cases that the tests below look at one by one.
const BELOW: [&str; 6] = [
    "DistanceGrid collide after dispose",
    "Geom dispose twice",
    "Body angular velocity NaN then update",
    "Body linear velocity NaN then update",
    "Quadratic drag with NaN velocity then update",
    "Simulator.Update with negative dt",
];

/// The port's name of the parameter of the original's exception.
fn argument_name(case: &str, parameter: Option<&str>) -> &'static str {
    match (case, parameter) {
        ("BroadPhaseCollider set with geoms present", _) => "the geom list",
        ("Body.Mass=0", _) => "mass",
        ("Body.MomentOfInertia=0" | "Body.MomentOfInertia=-1", _) => "moment_of_inertia",
        ("CreateCircleGeom 2 edges" | "CreateCircleGeom 1 edge" | "CreateCircleGeom 0 edges", _) => {
            "number_of_edges"
        }
        ("Geom clone after source disposed" | "DistanceGrid.Copy unknown id", _) => "geom",
        ("Vertices.GetMomentOfInertia empty" | "Vertices.ProjectToAxis empty", _) => "self",
        (_, Some("width")) => "width",
        (_, Some("height")) => "height",
        (_, Some("mass")) => "mass",
        (_, Some("radius")) => "radius",
        (_, Some("xRadius")) => "x_radius",
        (_, Some("yRadius")) => "y_radius",
        (_, Some("momentOfInertia")) => "moment_of_inertia",
        (_, Some("value" | "index") | None) => "vertices",
        (_, Some(other)) => panic!("{case}: {other}"),
    }
}

/// Values that become NaN in the original are refused here.
const REFUSED_HERE_ONLY: [(&str, &str); 2] =
    [("Body.MomentOfInertia=NaN", "moment_of_inertia"), ("CreatePolygonBody collinear", "vertices")];

#[test]
fn exceptions_of_the_original_are_refusals_that_name_the_argument() {
    let recorded = recorded();
    let mut wrong = Vec::new();
    for (case, refused) in port() {
        let (exception, parameter) = &recorded[case];
        let here_only = REFUSED_HERE_ONLY.iter().find(|(name, _)| *name == case);
        let expected = match exception {
            Some(_) => Some(argument_name(case, parameter.as_deref())),
            None => here_only.map(|(_, argument)| *argument),
        };
        if refused != expected {
            wrong.push(format!("{case}: refused {refused:?}, should be {expected:?}"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn every_recorded_case_is_dealt_with_once() {
    let mut dealt_with: Vec<String> = port().into_iter().map(|(case, _)| case.to_owned()).collect();
    dealt_with.extend(NULL_REFERENCES.map(str::to_owned));
    dealt_with.extend(ELSEWHERE.map(|(case, _)| case.to_owned()));
    dealt_with.extend(BELOW.map(str::to_owned));
    dealt_with.sort_unstable();
    assert_eq!(dealt_with, recorded().into_keys().collect::<Vec<_>>());
}

#[test]
fn geoms_are_disposed_twice_without_error() {
    let (mut simulator, geom) = with_box(true);
    assert_eq!(recorded()["Geom dispose twice"].0, None);
    assert_eq!([simulator.dispose(geom), simulator.dispose(geom)], [Ok(()), Ok(())]);
}

/// Disposes the second geom in the callback of the first pair.
struct DisposesOnce(Option<GeomId>);

impl EventHandler for DisposesOnce {
    fn on_collision(
        &mut self,
        context: &mut Context<'_>,
        _: GeomId,
        _: GeomId,
        _: &mut Vec<Contact>,
    ) -> bool {
        if let Some(geom) = self.0.take() {
            context.dispose(geom).unwrap();
        }
        true
    }
}

/// The narrow phase meets a geom whose grid was removed in the same update; the original throws there.
#[test]
fn a_disposed_geom_has_no_contacts() {
    let (mut simulator, first) = with_box(false);
    let mut add_box = |x: f32| {
        let body = simulator.create_body(Body::new());
        simulator[body].set_position(Vector2::new(x, 1.0));
        GeomFactory::create_rectangle_geom_in(&mut simulator, body, 10.0, 10.0, GeomPlacement::default())
            .unwrap()
    };
    let (middle, last) = (add_box(8.0), add_box(16.0));
    simulator.update_with(0.01, &mut DisposesOnce(Some(last)));
    let touching: Vec<_> = simulator.arbiters().map(|arbiter| (arbiter.geom_a(), arbiter.geom_b())).collect();
    assert_eq!(touching, [(first, middle)]);
}

/// The original throws in the next update, or goes on with NaN. Here the setter refuses NaN.
#[test]
fn velocities_of_nan_are_refused_and_the_body_goes_on() {
    for is_quadratic_drag_enabled in [false, true] {
        let (mut simulator, body) = simulator();
        simulator.add(body).unwrap();
        simulator[body].set_is_quadratic_drag_enabled(is_quadratic_drag_enabled);
        simulator[body].set_linear_velocity(Vector2::new(1.0, 0.0));
        simulator[body].set_linear_velocity(Vector2::new(f32::NAN, 0.0));
        simulator[body].set_angular_velocity(f32::NAN);
        simulator.update(0.01);
        assert!(simulator[body].enabled() && simulator[body].position().x > 0.0);
        let refusals: Vec<&str> = simulator
            .events()
            .iter()
            .filter_map(|event| match event {
                Event::RejectedInput { argument, .. } => Some(*argument),
                _ => None,
            })
            .collect();
        assert_eq!(refusals, ["linear_velocity", "angular_velocity"]);
    }
}

#[test]
fn a_negative_step_runs_backwards() {
    assert_eq!(recorded()["Simulator.Update with negative dt"].0, None);
    let (mut simulator, body) = simulator();
    simulator.add(body).unwrap();
    simulator[body].set_linear_velocity(Vector2::new(100.0, 0.0));
    simulator.update(-0.01);
    assert!(simulator[body].position().x < 0.0);
}
