//! A pose at which the AABB of a geom would not be finite has no effect on other bodies.

use farseer_core::math::{Matrix, Vector2};
use farseer_core::{
    Body, BodyFactory, BodyId, BroadPhaseCollider, DebugShape, Event, GeomFactory, GeomId, GeomPlacement,
    JointFactory, PhysicsSimulator, PhysicsSimulatorView, Result, SpringFactory, Vertices,
};

const BROAD_PHASES: [BroadPhaseCollider; 4] = [
    BroadPhaseCollider::SelectiveSweep,
    BroadPhaseCollider::SweepAndPrune,
    BroadPhaseCollider::BruteForce,
    BroadPhaseCollider::SPATIAL_HASH,
];

/// Twelve boxes above a floor, and one more that `spoil` may edit.
fn heap(broad_phase: BroadPhaseCollider) -> Result<(PhysicsSimulator, Vec<BodyId>, BodyId)> {
    let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 200.0))?;
    simulator.set_broad_phase_collider(broad_phase)?;
    let floor = BodyFactory::create_rectangle_body_in(&mut simulator, 800.0, 40.0, 1.0)?;
    simulator[floor].set_is_static(true);
    simulator[floor].set_position(Vector2::new(400.0, 500.0));
    GeomFactory::create_rectangle_geom_in(&mut simulator, floor, 800.0, 40.0, GeomPlacement::default())?;
    let mut boxes = Vec::new();
    for i in 0..13u8 {
        let body = BodyFactory::create_rectangle_body_in(&mut simulator, 30.0, 30.0, 1.0)?;
        GeomFactory::create_rectangle_geom_in(&mut simulator, body, 30.0, 30.0, GeomPlacement::default())?;
        simulator[body].set_position(Vector2::new(50.0 + f32::from(i) * 55.0, 440.0));
        boxes.push(body);
    }
    let spoiled = boxes.remove(6);
    Ok((simulator, boxes, spoiled))
}

fn at_rest(simulator: &PhysicsSimulator, boxes: &[BodyId]) -> usize {
    boxes.iter().filter(|&&body| (simulator[body].position().y - 465.0).abs() < 1.0).count()
}

fn reports(simulator: &PhysicsSimulator, body: BodyId, disabled: bool) -> usize {
    simulator.events().iter().filter(|&&event| event == Event::NotFinite { body, disabled }).count()
}

#[test]
fn an_overflowing_rotation_is_restored_and_reported_and_the_other_bodies_come_to_rest() {
    for broad_phase in BROAD_PHASES {
        let (mut simulator, boxes, spoiled) = heap(broad_phase).unwrap();
        simulator.update(0.01);
        let before = simulator[spoiled].rotation();
        simulator[spoiled].set_rotation(3.4e38);
        simulator.update(0.01);
        assert_eq!(reports(&simulator, spoiled, true), 1, "{broad_phase:?}");
        assert_eq!(simulator[spoiled].rotation(), before);
        assert!(!simulator[spoiled].enabled());
        (0..300).for_each(|_| simulator.update(0.01));
        assert_eq!(at_rest(&simulator, &boxes), 12, "{broad_phase:?}");
    }
}

#[test]
fn an_overflowing_spin_is_restored_and_reported_and_the_other_bodies_come_to_rest() {
    for broad_phase in BROAD_PHASES {
        let (mut simulator, boxes, spoiled) = heap(broad_phase).unwrap();
        simulator[spoiled].set_rotational_drag_coefficient(0.0);
        simulator[spoiled].set_angular_velocity(3.3e38);
        let mut reported = 0;
        for _ in 0..300 {
            simulator.update(0.01);
            reported += reports(&simulator, spoiled, true);
        }
        assert_eq!(reported, 1, "{broad_phase:?}");
        assert_eq!(at_rest(&simulator, &boxes), 12, "{broad_phase:?}");
    }
}

#[test]
fn a_static_body_is_restored_and_never_disabled() {
    let (mut simulator, _, spoiled) = heap(BroadPhaseCollider::SelectiveSweep).unwrap();
    simulator[spoiled].set_is_static(true);
    simulator.update(0.01);
    let before = simulator[spoiled].position();
    simulator[spoiled].set_position(Vector2::new(f32::MAX, 0.0));
    simulator[spoiled].set_rotation(3.4e38);
    simulator.update(0.01);
    assert_eq!(reports(&simulator, spoiled, false), 1);
    assert_eq!(simulator[spoiled].position(), before);
    assert!(simulator[spoiled].enabled());
}

#[test]
fn a_geom_with_an_overflowing_aabb_is_refused() {
    let (mut simulator, boxes, _) = heap(BroadPhaseCollider::SelectiveSweep).unwrap();
    let far = GeomPlacement {
        offset: Vector2::new(3.4e38, 3.4e38),
        rotation_offset: 0.7,
        collision_grid_size: 3.0,
    };
    let before = simulator.geoms_of(boxes[0]).to_vec();
    assert!(GeomFactory::create_rectangle_geom_in(&mut simulator, boxes[0], 30.0, 30.0, far).is_err());
    assert!(simulator.clone_geom_with_offset(boxes[0], before[0], far.offset, far.rotation_offset).is_err());
    assert_eq!(simulator.geoms_of(boxes[0]), before);
}

#[test]
fn a_restored_body_can_be_saved_and_loaded() {
    for broad_phase in BROAD_PHASES {
        let (mut simulator, _, spoiled) = heap(broad_phase).unwrap();
        simulator.update(0.01);
        simulator[spoiled].set_rotation(3.4e38);
        simulator.update(0.01);
        let text = serde_json::to_string(&simulator).unwrap();
        let loaded: PhysicsSimulator = serde_json::from_str(&text).unwrap();
        assert_eq!(serde_json::to_string(&loaded).unwrap(), text, "{broad_phase:?}");
    }
}

/// A box of 10 x 10 whose body is at a position.
fn box_at(x: f32) -> (PhysicsSimulator, BodyId, GeomId) {
    let mut simulator = PhysicsSimulator::default();
    let body = BodyFactory::create_rectangle_body_in(&mut simulator, 10.0, 10.0, 1.0).unwrap();
    simulator[body].set_position(Vector2::new(x, 0.0));
    let placement = GeomPlacement::with_grid_size(1.0);
    let geom = GeomFactory::create_rectangle_geom_in(&mut simulator, body, 10.0, 10.0, placement).unwrap();
    simulator.update(0.01);
    (simulator, body, geom)
}

fn is_finite(v: Vector2) -> bool {
    v.x.is_finite() && v.y.is_finite()
}

#[track_caller]
fn shows_finite_numbers(simulator: &PhysicsSimulator, geom: GeomId) {
    let view = simulator.geom(geom).unwrap();
    let aabb = view.aabb();
    assert!(is_finite(aabb.min) && is_finite(aabb.max), "{aabb:?}");
    assert!(view.world_vertices().iter().all(|&vertex| is_finite(vertex)));
    assert!(is_finite(view.position()) && view.rotation().is_finite());
    assert!(view.matrix().iter().chain(view.matrix_inverse().iter()).all(|number| number.is_finite()));
}

#[test]
fn an_outline_that_overflows_at_the_pose_of_its_body_is_refused() {
    let (mut simulator, body, geom) = box_at(3e38);
    simulator[body].set_tag(7);
    let before = simulator.snapshot();
    let great = Vertices::create_simple_rectangle(2e38, 2e38).unwrap();
    let error = simulator.set_vertices(geom, great.clone()).unwrap_err().to_string();
    assert!(error.starts_with("vertices is"), "{error}");
    assert!(simulator.snapshot() == before);
    let (mut simulator, _, geom) = box_at(0.0);
    simulator.set_vertices(geom, great).unwrap();
    shows_finite_numbers(&simulator, geom);
}

#[test]
fn a_matrix_that_makes_the_outline_overflow_is_refused() {
    let (mut simulator, body, geom) = box_at(0.0);
    simulator[body].set_position(Vector2::new(1.0, 0.0));
    let before = simulator.snapshot();
    let mut matrix = Matrix::identity();
    matrix.m11 = 2e38;
    assert!(simulator.set_matrix(geom, &matrix).is_err());
    assert!(simulator.snapshot() == before);
}

#[test]
fn a_refused_change_of_body_or_box_leaves_pending_edits_pending() {
    let (mut simulator, body, geom) = box_at(3.4e38);
    let far = simulator.create_body(Body::new());
    simulator[body].set_rotation(0.1);
    simulator[far].set_position(Vector2::new(f32::MAX, f32::MAX));
    simulator[far].set_rotation(0.8);
    let before = simulator.snapshot();
    assert!(simulator.set_box_radius(geom, Some(3e37)).is_err());
    assert!(simulator.set_body(geom, far).is_err());
    assert!(simulator.snapshot() == before);
}

#[test]
fn a_pose_that_will_be_restored_is_not_readable() {
    let (mut simulator, body, geom) = box_at(0.0);
    let shown = simulator.geom(geom).unwrap().aabb();
    simulator[body].set_position(Vector2::new(f32::MAX, 0.0));
    simulator[body].set_rotation(3.4e38);
    shows_finite_numbers(&simulator, geom);
    simulator.update(0.01);
    assert_eq!(simulator.geom(geom).unwrap().aabb(), shown);
}

#[test]
fn an_outline_within_the_box_of_a_disc_does_not_overflow() {
    let (mut simulator, body, geom) = box_at(0.0);
    simulator.set_vertices(geom, Vertices::create_simple_rectangle(3.2e38, 1.0).unwrap()).unwrap();
    simulator.set_box_radius(geom, Some(1.0)).unwrap();
    simulator.update(0.01);
    simulator[body].set_position(Vector2::new(3e38, 0.0));
    simulator.update(0.01);
    assert_eq!(reports(&simulator, body, true), 1);
    shows_finite_numbers(&simulator, geom);
}

/// Two bodies so far apart that their distance is no number, and a pin joint and a spring between them.
fn stretched_joint() -> (PhysicsSimulator, farseer_core::JointId) {
    let mut simulator = PhysicsSimulator::default();
    let bodies =
        [0, 1].map(|_| BodyFactory::create_rectangle_body_in(&mut simulator, 10.0, 10.0, 1.0).unwrap());
    let anchor = Vector2::new(2e38, 2e38);
    let joint =
        JointFactory::create_pin_joint_in(&mut simulator, bodies[0], anchor, bodies[1], anchor).unwrap();
    SpringFactory::create_linear_spring_in(&mut simulator, bodies[0], anchor, bodies[1], anchor, 1.0, 1.0)
        .unwrap();
    simulator[bodies[0]].set_position(Vector2::new(-3e38, -3e38));
    simulator[bodies[1]].set_position(Vector2::new(3e38, 3e38));
    (0..3).for_each(|_| simulator.update(0.01));
    (simulator, joint)
}

#[test]
fn the_error_of_a_joint_is_shown_as_a_finite_number() {
    let (simulator, id) = stretched_joint();
    let joint = simulator.joint(id).unwrap();
    assert_eq!(joint.joint_error(), f32::MAX);
    let pin = simulator.joint_as::<farseer_core::PinJoint>(id).unwrap();
    assert!(is_finite(pin.world_anchor1()));
    assert_eq!(pin.world_anchor2(), Vector2::new(f32::MAX, f32::MAX));
}

#[test]
fn the_debug_view_omits_shapes_that_overflow() {
    let (simulator, _) = stretched_joint();
    let view = PhysicsSimulatorView { enable_edge_view: true, ..Default::default() };
    let (mut shapes, mut axes) = (0, 0);
    view.draw(&simulator, |shape| {
        let points = match shape {
            DebugShape::Line { start, end, .. } => [start, end],
            DebugShape::Circle { center, .. } => [center, center],
            DebugShape::Rectangle { min, .. } => [min, min],
            DebugShape::Text { position, .. } => [position, position],
        };
        assert!(points.into_iter().all(is_finite), "{points:?}");
        shapes += 1;
        axes += usize::from(matches!(shape, DebugShape::Line { .. }));
    });
    assert!(shapes > 10 && axes >= 4, "{shapes} shapes, {axes} lines");
}
