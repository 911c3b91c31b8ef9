//! Under the precise set no body passes through a static one, and a bullet through no body.

use approx::assert_abs_diff_eq;
use farseer_core::math::Vector2;
use farseer_core::{
    BodyFactory, BodyId, CollisionCategory, Contact, Context, Event, EventHandler, GeomFactory, GeomId,
    GeomPlacement, Methods, PhysicsSimulator,
};

const DT: f32 = 1.0 / 60.0;

fn v(x: f32, y: f32) -> Vector2 {
    Vector2::new(x, y)
}

fn simulator(gravity: f32) -> PhysicsSimulator {
    let mut simulator = PhysicsSimulator::new(v(0.0, gravity)).unwrap();
    simulator.set_methods(Methods::PRECISE).unwrap();
    simulator.set_iterations(4);
    simulator
}

fn add_box(simulator: &mut PhysicsSimulator, at: Vector2, size: (f32, f32)) -> (BodyId, GeomId) {
    let body = BodyFactory::create_rectangle_body_in(simulator, size.0, size.1, 1.0).unwrap();
    simulator[body].set_position(at);
    simulator[body].set_linear_drag_coefficient(0.0);
    let placement = GeomPlacement::default();
    (body, GeomFactory::create_rectangle_geom_in(simulator, body, size.0, size.1, placement).unwrap())
}

fn add_ball(simulator: &mut PhysicsSimulator, at: Vector2, radius: f32) -> (BodyId, GeomId) {
    let body = BodyFactory::create_circle_body_in(simulator, radius, 1.0).unwrap();
    simulator[body].set_position(at);
    simulator[body].set_linear_drag_coefficient(0.0);
    (body, GeomFactory::create_circle_geom_in(simulator, body, radius, 16, GeomPlacement::default()).unwrap())
}

/// A wall of this thickness with its left side at x = 0.
fn add_wall(simulator: &mut PhysicsSimulator, thickness: f32) -> (BodyId, GeomId) {
    let (wall, geom) = add_box(simulator, v(0.5 * thickness, 0.0), (thickness, 400.0));
    simulator[wall].set_is_static(true);
    (wall, geom)
}

#[test]
fn no_body_tunnels_through_a_wall_of_any_thickness_at_any_speed() {
    for thickness in [0.5, 4.0, 32.0] {
        for speed in [1e3, 1e4, 1e5, 1e6] {
            for is_ball in [true, false] {
                let mut simulator = simulator(0.0);
                add_wall(&mut simulator, thickness);
                let start = v(-137.0, 3.0);
                let (body, _) = match is_ball {
                    true => add_ball(&mut simulator, start, 4.0),
                    false => add_box(&mut simulator, start, (8.0, 8.0)),
                };
                simulator[body].set_linear_velocity(v(speed, 0.0));
                simulator[body].set_rotation(0.3);
                for _ in 0..120 {
                    simulator.update(DT);
                    let x = simulator[body].position().x;
                    assert!(x < 0.0, "{x} behind {thickness} px at {speed} px/s");
                }
                let x = simulator[body].position().x;
                assert!(x < -3.9, "{x} still in {thickness} px at {speed} px/s");
            }
        }
    }
}

#[test]
fn a_body_bounces_off_a_wall_it_would_have_passed_with_the_speed_it_came_with() {
    let mut simulator = simulator(0.0);
    let (_, wall) = add_wall(&mut simulator, 4.0);
    let (body, geom) = add_ball(&mut simulator, v(-137.0, 0.0), 4.0);
    for geom in [wall, geom] {
        simulator.geom_mut(geom).unwrap().set_restitution_coefficient(1.0);
    }
    simulator[body].set_linear_velocity(v(6000.0, 0.0));
    (0..10).for_each(|_| simulator.update(DT));
    assert_abs_diff_eq!(simulator[body].linear_velocity().x, -6000.0, epsilon = 0.01);
}

#[test]
fn a_grazing_body_loses_no_speed() {
    let mut simulator = simulator(0.0);
    // Slabs side by side, as a floor is made of.
    for i in 0..20 {
        let (slab, geom) = add_box(&mut simulator, v(50.0 * i as f32, 10.0), (50.0, 20.0));
        simulator[slab].set_is_static(true);
        simulator.geom_mut(geom).unwrap().set_friction_coefficient(0.0);
    }
    let (body, geom) = add_box(&mut simulator, v(0.0, -4.0), (8.0, 8.0));
    simulator.geom_mut(geom).unwrap().set_friction_coefficient(0.0);
    simulator[body].set_linear_velocity(v(3000.0, 0.0));
    (0..18).for_each(|_| simulator.update(DT));
    assert_abs_diff_eq!(simulator[body].position().x, 900.0, epsilon = 0.01);
    assert_abs_diff_eq!(simulator[body].linear_velocity().x, 3000.0, epsilon = 0.01);
}

#[test]
fn a_plank_that_spins_does_not_pass_a_wall() {
    for spin in [60.0, 170.0, 400.0] {
        let mut simulator = simulator(0.0);
        add_wall(&mut simulator, 4.0);
        let (plank, _) = add_box(&mut simulator, v(-60.0, 0.0), (100.0, 4.0));
        simulator[plank].set_linear_velocity(v(200.0, 0.0));
        simulator[plank].set_angular_velocity(spin);
        for _ in 0..240 {
            simulator.update(DT);
            let x = simulator[plank].position().x;
            assert!(x < 0.0, "{x} at {spin} rad/s");
        }
    }
}

#[test]
fn a_long_frame_leaves_no_body_below_a_floor() {
    for frame in [0.25, 1.0] {
        let mut simulator = simulator(1000.0);
        let (floor, _) = add_box(&mut simulator, v(0.0, 10.0), (2000.0, 20.0));
        simulator[floor].set_is_static(true);
        let bodies: Vec<BodyId> = (0..20)
            .map(|i| {
                let at = v(90.0 * i as f32 - 900.0, -40.0 - 37.0 * i as f32);
                if i % 2 == 0 {
                    add_ball(&mut simulator, at, 10.0).0
                } else {
                    add_box(&mut simulator, at, (20.0, 20.0)).0
                }
            })
            .collect();
        for _ in 0..40 {
            simulator.update(frame);
            for &body in &bodies {
                let y = simulator[body].position().y;
                assert!(y < 0.0, "{y} after frames of {frame} s");
            }
        }
    }
}

#[test]
fn in_long_frames_a_box_slides_as_far_as_in_short_ones() {
    for frame in [0.2, 0.05, DT] {
        let mut simulator = simulator(600.0);
        simulator.set_gravity(v(300.0, 600.0)).unwrap();
        let (floor, surface) = add_box(&mut simulator, v(0.0, 10.0), (4000.0, 20.0));
        simulator[floor].set_is_static(true);
        let (body, geom) = add_box(&mut simulator, v(0.0, -10.0), (60.0, 20.0));
        for geom in [surface, geom] {
            simulator.geom_mut(geom).unwrap().set_friction_coefficient(0.0);
        }
        (0..(2.0 / frame).round() as usize).for_each(|_| simulator.update(frame));
        // Half of the acceleration times the square of the time.
        assert_abs_diff_eq!(simulator[body].position().x, 600.0, epsilon = 0.1);
    }
}

#[test]
fn only_a_bullet_has_ccd_against_dynamic_bodies() {
    for is_bullet in [true, false] {
        let mut simulator = simulator(0.0);
        let (target, _) = add_box(&mut simulator, v(0.0, 0.0), (4.0, 40.0));
        let (body, _) = add_ball(&mut simulator, v(-95.0, 0.0), 2.0);
        simulator[body].set_is_bullet(is_bullet);
        simulator[body].set_linear_velocity(v(6000.0, 0.0));
        (0..6).for_each(|_| simulator.update(DT));
        assert_eq!(simulator[target].linear_velocity().x > 100.0, is_bullet);
        let momentum = simulator[target].linear_velocity().x + simulator[body].linear_velocity().x;
        assert_abs_diff_eq!(momentum, 6000.0, epsilon = 0.1);
    }
}

#[test]
fn two_bullets_meet_in_the_middle() {
    let mut simulator = simulator(0.0);
    let bullets = [-1.0, 1.0].map(|side| {
        let (body, geom) = add_ball(&mut simulator, v(155.0 * side, 0.0), 2.0);
        simulator[body].set_is_bullet(true);
        simulator[body].set_linear_velocity(v(-6000.0 * side, 0.0));
        simulator.geom_mut(geom).unwrap().set_restitution_coefficient(1.0);
        body
    });
    (0..8).for_each(|_| simulator.update(DT));
    let speeds = bullets.map(|body| simulator[body].linear_velocity().x);
    assert!(speeds[0] < -5999.0 && speeds[1] > 5999.0, "{speeds:?}");
}

#[test]
fn a_body_against_a_bullet_does_not_pass_its_point_of_impact() {
    let mut simulator = simulator(0.0);
    let [bullet, other] = [-1.0, 1.0].map(|side| {
        let (body, _) = add_ball(&mut simulator, v(155.0 * side, 0.0), 2.0);
        simulator[body].set_linear_velocity(v(-6000.0 * side, 0.0));
        body
    });
    simulator[bullet].set_is_bullet(true);
    (0..8).for_each(|_| simulator.update(DT));
    assert!(simulator[bullet].position().x < simulator[other].position().x);
    // Equal ones without restitution stop each other.
    let speeds = [bullet, other].map(|body| simulator[body].linear_velocity().x);
    assert!(speeds.iter().all(|speed| speed.abs() < 60.0), "{speeds:?}");
}

#[test]
fn a_body_filtered_from_a_wall_flies_through_it() {
    let mut simulator = simulator(0.0);
    let (_, wall) = add_wall(&mut simulator, 4.0);
    let wall = simulator.geom_mut(wall).unwrap();
    wall.set_collides_with(CollisionCategory::NONE);
    wall.set_collision_categories(CollisionCategory::NONE);
    let (body, _) = add_ball(&mut simulator, v(-137.0, 0.0), 4.0);
    simulator[body].set_linear_velocity(v(6000.0, 0.0));
    (0..6).for_each(|_| simulator.update(DT));
    assert_abs_diff_eq!(simulator[body].position().x, 463.0, epsilon = 0.01);
}

#[test]
fn a_body_from_behind_passes_a_one_sided_edge() {
    for (from, passes) in [(-100.0, false), (100.0, true)] {
        let mut simulator = simulator(0.0);
        let points = [v(-100.0, 0.0), v(100.0, 0.0)];
        let ground = BodyFactory::create_body_in(&mut simulator, 1.0, 1.0).unwrap();
        simulator[ground].set_is_static(true);
        GeomFactory::create_chain_geom_in(&mut simulator, ground, &points, GeomPlacement::default()).unwrap();
        let (ball, _) = add_ball(&mut simulator, v(0.0, from), 4.0);
        simulator[ball].set_linear_velocity(v(0.0, -60.0 * from));
        (0..4).for_each(|_| simulator.update(DT));
        let has_passed = simulator[ball].position().y * from < 0.0;
        assert_eq!(has_passed, passes, "from {from}: {}", simulator[ball].position());
    }
}

/// Counts the events of each sensor.
#[derive(Default)]
struct Ears {
    begun: usize,
    ended: usize,
}

impl EventHandler for Ears {
    fn on_collision(&mut self, _: &mut Context, _: GeomId, _: GeomId, _: &mut Vec<Contact>) -> bool {
        self.begun += 1;
        true
    }

    fn on_separation(&mut self, _: &mut Context, _: GeomId, _: GeomId) {
        self.ended += 1;
    }
}

#[test]
fn a_sensor_reports_once_a_body_that_crosses_it_in_one_step() {
    let mut simulator = simulator(0.0);
    let (_, sensor) = add_wall(&mut simulator, 4.0);
    simulator.geom_mut(sensor).unwrap().set_collision_response_enabled(false);
    let (body, _) = add_ball(&mut simulator, v(-137.0, 0.0), 4.0);
    simulator[body].set_linear_velocity(v(6000.0, 0.0));
    let mut ears = Ears::default();
    let mut events = 0;
    for _ in 0..6 {
        simulator.update_with(DT, &mut ears);
        events += simulator.events().iter().filter(|event| matches!(event, Event::Collision { .. })).count();
    }
    assert_abs_diff_eq!(simulator[body].position().x, 463.0, epsilon = 0.01);
    assert_eq!((ears.begun, ears.ended, events), (2, 2, 2), "each side once");
    simulator[body].set_linear_velocity(v(1.0, 0.0));
    simulator.update(DT);
    assert!(simulator.events().iter().all(|event| matches!(event, Event::BodyUpdated { .. })));
}

#[test]
fn fast_bodies_go_on_with_the_same_bits_after_a_restore_in_every_step() {
    let mut simulator = simulator(300.0);
    add_wall(&mut simulator, 4.0);
    for i in 0..6 {
        let (body, _) = add_ball(&mut simulator, v(-100.0 - 20.0 * i as f32, 10.0 * i as f32), 3.0);
        simulator[body].set_linear_velocity(v(5000.0 + 700.0 * i as f32, 0.0));
        simulator[body].set_is_bullet(i % 2 == 0);
    }
    let mut restored = simulator.clone();
    for _ in 0..60 {
        simulator.update(DT);
        let mut next = PhysicsSimulator::default();
        next.restore(&restored.snapshot()).unwrap();
        next.update(DT);
        restored = next;
        assert!(restored.snapshot() == simulator.snapshot());
    }
}
