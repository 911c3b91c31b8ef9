//! A pose at which the box of a geom would not be finite harms nobody.

use farseer_core::math::Vector2;
use farseer_core::{
    BodyFactory, BodyId, BroadPhaseCollider, Event, GeomFactory, GeomPlacement, PhysicsSimulator, Result,
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
fn a_rotation_beyond_all_numbers_is_put_back_and_reported_and_the_others_come_to_rest() {
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
fn spinning_beyond_all_numbers_is_put_back_and_reported_and_the_others_come_to_rest() {
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
fn a_static_body_is_put_back_and_never_disabled() {
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
fn a_geom_that_would_reach_beyond_all_numbers_is_refused() {
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
fn what_was_put_back_can_be_saved_and_loaded() {
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
