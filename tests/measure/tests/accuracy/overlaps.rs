//! Tests the penetration depth of shapes: known depths, pairs that do not count, and a search for deeper ones.

use crate::common::told::{PrescribedWorld, flat, starts};
use approx::assert_relative_eq;
use conformance::scene::{BodyShape, BodySpec, GeomShape, GeomSpec, Outline, OutlineForm, Scene};
use farseer_core::math::Vector2;
use measure::penetration::Shapes;
use measure::world::BodyState;
use proptest::prelude::*;
use std::f64::consts::PI;

fn placed(scene: &mut Scene, shape: GeomShape, position: [f64; 2], rotation: f64) {
    let mut body = BodySpec::new(BodyShape::Explicit { mass: 1.0, moment_of_inertia: 1.0 });
    body.position = Some(Vector2::new(position[0] as f32, position[1] as f32));
    body.rotation = Some(rotation as f32);
    scene.bodies.push(body);
    scene.geoms.push(GeomSpec::new(scene.bodies.len() - 1, shape));
}

fn overlap_of(scene: &Scene) -> f64 {
    Shapes::of(scene).largest_overlap(&PrescribedWorld(starts(scene)))
}

/// Returns the penetration depth of two shapes in px. Arguments: shape, position in px and angle in radians of each.
fn overlap(one: (GeomShape, [f64; 2], f64), other: (GeomShape, [f64; 2], f64)) -> f64 {
    let mut scene = Scene::empty("overlap", "Two shapes.");
    for (shape, position, rotation) in [one, other] {
        placed(&mut scene, shape, position, rotation);
    }
    overlap_of(&scene)
}

const SQUARE: GeomShape = GeomShape::Rectangle { width: 20.0, height: 20.0 };
const DISC: GeomShape = GeomShape::Circle { radius: 10.0, edges: 12 };

#[test]
fn known_overlaps_are_found() {
    let diagonal = 10.0 * 2.0_f64.sqrt();
    for (name, one, other, known) in [
        ("squares", (SQUARE, [0.0, 0.0], 0.0), (SQUARE, [17.0, 5.0], 0.0), 3.0),
        ("squares apart", (SQUARE, [0.0, 0.0], 0.0), (SQUARE, [20.5, 5.0], 0.0), 0.0),
        ("a corner in a square", (SQUARE, [0.0, 0.0], 0.0), (SQUARE, [22.0, 0.0], PI / 4.0), diagonal - 12.0),
        ("discs", (DISC, [0.0, 0.0], 0.0), (DISC, [9.0, 12.0], 0.0), 5.0),
        ("discs apart", (DISC, [0.0, 0.0], 0.0), (DISC, [15.0, 15.0], 0.0), 0.0),
        ("a disc on a side", (SQUARE, [0.0, 0.0], 0.0), (DISC, [3.0, -18.0], 0.0), 2.0),
        (
            "a disc on a corner",
            (SQUARE, [0.0, 0.0], 0.0),
            (DISC, [16.0, 16.0], 0.0),
            10.0 - 6.0 * 2.0_f64.sqrt(),
        ),
        ("a disc beside a corner", (SQUARE, [0.0, 0.0], 0.0), (DISC, [18.0, 18.0], 0.0), 0.0),
        ("a disc with its centre within", (SQUARE, [0.0, 0.0], 0.0), (DISC, [0.0, 4.0], 0.0), 16.0),
        ("a square within another", (SQUARE, [0.0, 0.0], 0.0), (SQUARE, [0.0, 1.0], 0.0), 19.0),
    ] {
        let found = overlap(one.clone(), other.clone());
        assert!((found - known).abs() < 1e-5, "{name}: {found}, not {known}");
        assert_eq!(overlap(other, one), found, "{name}, the other way round");
    }
}

#[test]
fn offsets_turn_with_the_body_and_with_the_geom() {
    for shape in [SQUARE, DISC] {
        let mut scene = Scene::empty("offset", "Two shapes, one beside the middle of its body.");
        placed(&mut scene, shape, [0.0, 0.0], PI / 2.0);
        scene.geoms[0].offset = Some(Vector2::new(30.0, 0.0));
        // In the body's frame the offset points down (y), and the rotation of the body turns it to the left.
        scene.geoms[0].rotation_offset = Some(std::f32::consts::FRAC_PI_2);
        placed(&mut scene, SQUARE, [-49.0, 0.0], 0.0);
        assert_relative_eq!(overlap_of(&scene), 1.0, epsilon = 1e-4);
    }
}

#[test]
fn outlines_and_their_pieces_have_their_shape() {
    let points = [[0.0, 0.0], [30.0, 0.0], [0.0, 30.0]].map(|[x, y]: [f32; 2]| Vector2::new(x, y)).to_vec();
    let outline = Outline { form: OutlineForm::Points { points }, subdivide: Some(4.0) };
    let triangle = GeomShape::Raw { outline };
    // The centre of the disc, of radius 10 px, is 9 px beyond the middle of the long side: the penetration depth is 1 px.
    let beyond = 15.0 + 9.0 / 2.0_f64.sqrt();
    let found = overlap((triangle, [0.0, 0.0], 0.0), (DISC, [beyond, beyond], 0.0));
    assert_relative_eq!(found, 1.0, epsilon = 1e-5);
}

#[test]
#[should_panic(expected = "not convex")]
fn an_outline_with_a_notch_is_refused() {
    let points =
        [[0.0, 0.0], [30.0, 0.0], [10.0, 10.0], [0.0, 30.0]].map(|[x, y]: [f32; 2]| Vector2::new(x, y));
    let form = OutlineForm::Points { points: points.to_vec() };
    let notched = GeomShape::Raw { outline: Outline { form, subdivide: None } };
    overlap((notched, [0.0, 0.0], 0.0), (DISC, [0.0, 0.0], 0.0));
}

#[test]
fn shapes_that_do_not_collide_do_not_overlap() {
    let deep = || {
        let mut scene = Scene::empty("deep", "Two squares in each other.");
        placed(&mut scene, SQUARE, [0.0, 0.0], 0.0);
        placed(&mut scene, SQUARE, [5.0, 0.0], 0.0);
        scene
    };
    assert_relative_eq!(overlap_of(&deep()), 15.0);
    let mut still = deep();
    still.bodies.iter_mut().for_each(|body| body.is_static = Some(true));
    assert_eq!(overlap_of(&still), 0.0);
    let mut grouped = deep();
    grouped.geoms.iter_mut().for_each(|geom| geom.settings.collision_group = Some(3));
    assert_eq!(overlap_of(&grouped), 0.0);
    let mut one_body = deep();
    one_body.geoms[1].body = 0;
    assert_eq!(overlap_of(&one_body), 0.0);
}

#[test]
fn an_overlap_of_a_non_finite_pose_is_infinite() {
    let mut scene = Scene::empty("lost", "A square.");
    placed(&mut scene, SQUARE, [0.0, 0.0], 0.0);
    let mut world = PrescribedWorld(starts(&scene));
    world.0[0].position[1] = f64::NAN;
    assert_eq!(Shapes::of(&scene).largest_overlap(&world), f64::INFINITY);
}

fn discs() -> impl Strategy<Value = Vec<([f64; 2], f32)>> {
    prop::collection::vec((prop::array::uniform2(-200.0..200.0), 0.5_f32..30.0), 2..60)
}

proptest! {
    #[test]
    fn among_many_discs_the_deepest_pair_is_found(discs in discs()) {
        let mut scene = Scene::empty("discs", "Discs anywhere.");
        for &(position, radius) in &discs {
            placed(&mut scene, GeomShape::Circle { radius, edges: 8 }, position, 0.0);
        }
        let states = starts(&scene);
        let mut deepest = 0.0_f64;
        for (index, (_, radius)) in discs.iter().enumerate() {
            for (other, (_, other_radius)) in discs.iter().enumerate().skip(index + 1) {
                let (a, b) = (states[index].position, states[other].position);
                let between = (a[0] - b[0]).hypot(a[1] - b[1]);
                deepest = deepest.max(f64::from(*radius) + f64::from(*other_radius) - between);
            }
        }
        prop_assert!((overlap_of(&scene) - deepest).abs() < 1e-9);
    }

    #[test]
    fn a_rigid_motion_of_both_shapes_keeps_the_overlap(
        place in prop::array::uniform2(-25.0..25.0),
        turns in prop::array::uniform2(-PI..PI),
        whole in -PI..PI,
        far in prop::array::uniform2(-500.0..500.0),
    ) {
        let mut scene = Scene::empty("pair", "Two rectangles.");
        placed(&mut scene, GeomShape::Rectangle { width: 20.0, height: 30.0 }, [0.0, 0.0], turns[0]);
        placed(&mut scene, GeomShape::Rectangle { width: 15.0, height: 9.0 }, place, turns[1]);
        let shapes = Shapes::of(&scene);
        let here = PrescribedWorld(starts(&scene));
        let (sine, cosine) = whole.sin_cos();
        let there = PrescribedWorld(here.0.iter().map(|state| {
            let [x, y] = state.position_in_plane();
            let position = [x * cosine - y * sine + far[0], x * sine + y * cosine + far[1]];
            BodyState { position: flat(position), angle: state.angle + whole, ..*state }
        }).collect());
        prop_assert!((shapes.largest_overlap(&here) - shapes.largest_overlap(&there)).abs() < 1e-9);
    }

    #[test]
    fn the_overlap_of_boxes_is_the_least_separating_displacement(
        place in prop::array::uniform2(-30.0..30.0),
        turn in -PI..PI,
    ) {
        let mut scene = Scene::empty("pair", "Two squares.");
        placed(&mut scene, SQUARE, [0.0, 0.0], 0.0);
        placed(&mut scene, SQUARE, place, turn);
        let shapes = Shapes::of(&scene);
        let mut world = PrescribedWorld(starts(&scene));
        let (depth, start) = (shapes.largest_overlap(&world), world.0[1].position);
        let mut parted = |by: f64, angle: f64| {
            world.0[1].position = flat([start[0] + by * angle.cos(), start[1] + by * angle.sin()]);
            shapes.largest_overlap(&world) <= 1e-9
        };
        // A displacement of that length in some direction separates the shapes, and none that is shorter does. The search tries
        // every degree. Its best direction is off by at most half a degree, which lengthens the displacement by less than 1e-4
        // of it.
        let degrees = || (0..360).map(|degree| f64::from(degree).to_radians());
        let normals = [0.0, turn].into_iter().flat_map(|of| (0..4).map(move |side| of + f64::from(side) * PI / 2.0));
        prop_assert!(normals.into_iter().any(|angle| parted(depth + 1e-6, angle)));
        prop_assert!(depth == 0.0 || degrees().all(|angle| !parted(depth * 0.999, angle)));
    }
}
