//! The precise set: islands whose bodies have joints and contacts, or whose joints close loops. Their rows are one system.

use conformance::fixtures::plane::{precise, run, v};
use farseer_core::math::Vector2;
use farseer_core::{
    BodyFactory, BodyId, GeomFactory, GeomId, GeomPlacement, IslandSolver, JointFactory, JointId, JointMotor,
    PhysicsSimulator,
};

const DT: f32 = 1.0 / 60.0;
/// Length units per second squared; 32 length units are a metre.
const GRAVITY: f32 = 900.0;

fn place(simulator: &mut PhysicsSimulator, body: BodyId, geom: GeomId, position: Vector2) {
    simulator[body].set_position(position);
    simulator[body].set_linear_drag_coefficient(0.0);
    simulator[body].set_rotational_drag_coefficient(0.0);
    simulator[geom].set_friction_coefficient(0.5);
}

fn add_rectangle(
    simulator: &mut PhysicsSimulator,
    position: Vector2,
    [width, height]: [f32; 2],
    mass: f32,
) -> (BodyId, GeomId) {
    let body = BodyFactory::create_rectangle_body_in(simulator, width, height, mass).unwrap();
    let placement = GeomPlacement::default();
    let geom = GeomFactory::create_rectangle_geom_in(simulator, body, width, height, placement).unwrap();
    place(simulator, body, geom, position);
    (body, geom)
}

fn add_disc(simulator: &mut PhysicsSimulator, position: Vector2, radius: f32, mass: f32) -> (BodyId, GeomId) {
    let body = BodyFactory::create_circle_body_in(simulator, radius, mass).unwrap();
    let geom =
        GeomFactory::create_circle_geom_in(simulator, body, radius, 16, GeomPlacement::default()).unwrap();
    place(simulator, body, geom, position);
    (body, geom)
}

/// A static floor whose surface is at y = 0.
fn add_floor(simulator: &mut PhysicsSimulator) {
    let (body, _) = add_rectangle(simulator, v(0.0, 20.0), [2000.0, 40.0], 1.0);
    simulator[body].set_is_static(true);
}

/// Distance of two anchors that a joint keeps together: each a body and a point in its coordinates.
fn gap(simulator: &PhysicsSimulator, [(a, p), (b, q)]: [(BodyId, Vector2); 2]) -> f32 {
    (simulator[a].get_world_position(p) - simulator[b].get_world_position(q)).norm()
}

/// A hinge at a point in world coordinates, and the anchors that it keeps together.
fn hinge(
    simulator: &mut PhysicsSimulator,
    a: BodyId,
    b: BodyId,
    at: Vector2,
) -> (JointId, [(BodyId, Vector2); 2]) {
    let joint = JointFactory::create_revolute_joint_in(simulator, a, b, at).unwrap();
    (joint, [a, b].map(|body| (body, simulator[body].get_local_position(at))))
}

/// Greatest gap in these steps.
fn greatest_gap(simulator: &mut PhysicsSimulator, steps: usize, anchors: &[[(BodyId, Vector2); 2]]) -> f32 {
    let mut worst = 0.0_f32;
    for _ in 0..steps {
        simulator.update(DT);
        worst = anchors.iter().map(|&anchors| gap(simulator, anchors)).fold(worst, f32::max);
    }
    worst
}

/// A Warren girder of panels of 40 between static ends, with nodes of mass 1 and bars of mass 0.5.
fn add_girder(simulator: &mut PhysicsSimulator, panels: usize) -> Vec<[(BodyId, Vector2); 2]> {
    let is_node = |column: usize, row: usize| row == 0 || column < panels;
    let places = (0..=panels).flat_map(|column| [(column, 0), (column, 1)]);
    let nodes: Vec<BodyId> = places
        .filter(|&(column, row)| is_node(column, row))
        .map(|(column, row)| {
            let at = v(40.0 * column as f32 + 20.0 * row as f32, -35.0 * row as f32);
            let (body, geom) = add_disc(simulator, at, 5.0, 1.0);
            simulator[geom].set_collision_group(1);
            body
        })
        .collect();
    let mut anchors = Vec::new();
    for one in 0..nodes.len() {
        for other in [one + 1, one + 2].into_iter().filter(|&other| other < nodes.len()) {
            let [p, q] = [one, other].map(|node| simulator[nodes[node]].position());
            let way = q - p;
            let (bar, geom) = add_rectangle(simulator, (p + q) * 0.5, [way.norm(), 4.0], 0.5);
            simulator[bar].set_rotation(way.y.atan2(way.x));
            simulator[geom].set_collision_group(1);
            anchors.push(hinge(simulator, nodes[one], bar, p).1);
            anchors.push(hinge(simulator, nodes[other], bar, q).1);
        }
    }
    for end in [nodes[0], nodes[2 * panels]] {
        simulator[end].set_is_static(true);
    }
    anchors
}

#[test]
fn a_girder_of_bars_of_any_length_carries_its_own_weight() {
    for panels in [2, 4, 7, 10, 14] {
        let mut simulator = precise(GRAVITY);
        let anchors = add_girder(&mut simulator, panels);
        // Measured: 0.004 in the first second, when loads come up.
        let worst = greatest_gap(&mut simulator, 300, &anchors);
        assert!(worst < 0.02, "{panels} panels: {worst}");
    }
}

/// A net of discs on hinges, hung by its upper row.
fn add_grid(simulator: &mut PhysicsSimulator, size: usize) -> Vec<[(BodyId, Vector2); 2]> {
    let mut bodies: Vec<BodyId> = Vec::new();
    let mut anchors = Vec::new();
    for at in 0..size * size {
        let (row, column) = (at / size, at % size);
        let (body, geom) = add_disc(simulator, v(32.0 * column as f32, 32.0 * row as f32), 12.0, 1.0);
        simulator[geom].set_collision_group(1);
        simulator[body].set_is_static(row == 0);
        if column > 0 {
            let point = v(32.0 * column as f32 - 16.0, 32.0 * row as f32);
            anchors.push(hinge(simulator, bodies[at - 1], body, point).1);
        }
        if row > 0 {
            let point = v(32.0 * column as f32, 32.0 * row as f32 - 16.0);
            anchors.push(hinge(simulator, bodies[at - size], body, point).1);
        }
        bodies.push(body);
    }
    anchors
}

#[test]
fn a_net_of_hinges_stretches_by_less_than_a_hundredth_of_a_pixel_at_any_size() {
    for size in [3, 6, 9, 12] {
        let mut simulator = precise(GRAVITY);
        let anchors = add_grid(&mut simulator, size);
        // Measured: 0.001.
        let worst = greatest_gap(&mut simulator, 120, &anchors);
        assert!(worst < 0.01, "{size}: {worst}");
    }
}

#[test]
fn a_block_of_any_mass_welded_on_a_light_plate_stands() {
    for mass in [0.5, 2.0, 10.0, 30.0, 100.0, 300.0] {
        let mut simulator = precise(GRAVITY);
        add_floor(&mut simulator);
        let (plate, _) = add_rectangle(&mut simulator, v(0.0, -5.0), [60.0, 10.0], 1.0);
        let (block, _) = add_rectangle(&mut simulator, v(0.0, -30.0), [40.0, 40.0], mass);
        JointFactory::create_weld_joint_in(&mut simulator, plate, block, v(0.0, -10.0)).unwrap();
        run(&mut simulator, 300);
        let off = (simulator[block].position() - v(0.0, -30.0)).norm();
        assert!(off < 0.02 && simulator.is_asleep(block), "mass {mass}: {off} away");
    }
}

#[test]
fn a_cart_of_any_mass_stands_on_light_wheels() {
    for mass in [1.0, 20.0, 50.0, 200.0] {
        let mut simulator = precise(GRAVITY);
        add_floor(&mut simulator);
        let (cart, _) = add_rectangle(&mut simulator, v(0.0, -30.0), [100.0, 20.0], mass);
        let anchors = [-35.0, 35.0].map(|x| {
            let (wheel, geom) = add_disc(&mut simulator, v(x, -10.0), 10.0, 1.0);
            simulator[geom].set_collision_group(1);
            hinge(&mut simulator, cart, wheel, v(x, -10.0)).1
        });
        let worst = greatest_gap(&mut simulator, 300, &anchors);
        let speed = simulator[cart].linear_velocity().norm();
        assert!(worst < 0.02 && speed < 0.5, "mass {mass}: gap {worst}, speed {speed}");
    }
}

#[test]
fn each_hinge_of_a_plank_on_two_posts_reports_half_of_its_weight() {
    let mut simulator = precise(GRAVITY);
    add_floor(&mut simulator);
    let (plank, _) = add_rectangle(&mut simulator, v(0.0, -45.0), [200.0, 10.0], 6.0);
    let joints = [-80.0, 80.0].map(|x| {
        let (post, geom) = add_rectangle(&mut simulator, v(x, -20.0), [30.0, 40.0], 2.0);
        simulator[geom].set_collision_group(1);
        hinge(&mut simulator, post, plank, v(x, -40.0)).0
    });
    run(&mut simulator, 100);
    for joint in joints {
        let force = simulator.joint(joint).unwrap().force();
        // A velocity error of 1e-4 units of 32 per second is not corrected, of a mass of 10 per step: 2 of 2,700 at each hinge,
        // and as much of its neighbour's.
        assert!((force.y + 0.5 * 6.0 * GRAVITY).abs() < 4.0, "{force:?}");
    }
}

#[test]
fn a_motor_in_an_island_reaches_its_speed_and_keeps_it() {
    let mut simulator = precise(GRAVITY);
    add_floor(&mut simulator);
    let (base, of_base) = add_rectangle(&mut simulator, v(0.0, -20.0), [200.0, 40.0], 20.0);
    let (arm, of_arm) = add_rectangle(&mut simulator, v(0.0, -60.0), [8.0, 40.0], 1.0);
    for geom in [of_base, of_arm] {
        simulator[geom].set_collision_group(1);
    }
    let (joint, anchors) = hinge(&mut simulator, base, arm, v(0.0, -40.0));
    simulator.set_joint_motor(joint, Some(JointMotor { speed: 1.0, greatest_effort: 1e6 })).unwrap();
    run(&mut simulator, 18);
    assert!((simulator[arm].angular_velocity() - 1.0).abs() < 1e-3, "{}", simulator[arm].angular_velocity());
    let worst = greatest_gap(&mut simulator, 60, &[anchors]);
    let spin = simulator[arm].angular_velocity();
    assert!((spin - 1.0).abs() < 1e-2 && worst < 0.02, "{spin}, gap {worst}");
}

#[test]
fn welded_pieces_that_overlap_do_not_spin_up() {
    for size in [60.0, 110.0, 160.0] {
        let mut simulator = precise(0.0);
        let (hub, _) = add_disc(&mut simulator, v(0.0, 0.0), 50.0, 10.0);
        let pieces = [0.0_f32, 0.5, 1.0, 1.5].map(|part| {
            let angle = part * std::f32::consts::PI;
            let way = v(angle.cos(), angle.sin());
            let (piece, _) = add_rectangle(&mut simulator, way * 150.0, [200.0, size], 4.0);
            simulator[piece].set_rotation(angle);
            JointFactory::create_weld_joint_in(&mut simulator, hub, piece, way * 50.0).unwrap();
            piece
        });
        let energy = |simulator: &PhysicsSimulator| -> f32 {
            let of = |body: &BodyId| {
                let body = &simulator[*body];
                let spin = body.angular_velocity();
                body.mass() * body.linear_velocity().norm_squared() + body.moment_of_inertia() * spin * spin
            };
            pieces.iter().chain([&hub]).map(of).sum()
        };
        run(&mut simulator, 300);
        let before = energy(&simulator);
        run(&mut simulator, 300);
        let (after, mass) = (energy(&simulator), 26.0);
        // A pair that is still pushed apart after five seconds moves with a length unit per second at most, and does not gain
        // energy.
        assert!(after <= 1.05 * before + 1.0 && after < mass * 32.0 * 32.0, "{size}: {before}, then {after}");
    }
}

#[test]
fn an_island_with_joints_that_is_saved_in_any_step_goes_on_with_the_same_bits() {
    let mut simulator = precise(GRAVITY);
    add_floor(&mut simulator);
    let (plate, _) = add_rectangle(&mut simulator, v(0.0, -25.0), [60.0, 10.0], 1.0);
    let (block, _) = add_rectangle(&mut simulator, v(5.0, -50.0), [40.0, 40.0], 30.0);
    JointFactory::create_weld_joint_in(&mut simulator, plate, block, v(0.0, -30.0)).unwrap();
    let (cart, _) = add_rectangle(&mut simulator, v(200.0, -40.0), [100.0, 20.0], 20.0);
    for x in [165.0, 235.0] {
        let (wheel, geom) = add_disc(&mut simulator, v(x, -20.0), 10.0, 1.0);
        simulator[geom].set_collision_group(1);
        hinge(&mut simulator, cart, wheel, v(x, -20.0));
    }
    for step in 0..120 {
        let mut restored = precise(0.0);
        restored.restore(&simulator.snapshot()).unwrap();
        simulator.update(DT);
        restored.update(DT);
        assert!(simulator.snapshot() == restored.snapshot(), "step {step}");
    }
}

#[test]
fn a_jointed_island_at_rest_makes_no_newton_steps_and_falls_asleep() {
    let mut simulator = precise(GRAVITY);
    add_floor(&mut simulator);
    let (plate, _) = add_rectangle(&mut simulator, v(0.0, -5.0), [60.0, 10.0], 1.0);
    let (block, _) = add_rectangle(&mut simulator, v(0.0, -30.0), [40.0, 40.0], 5.0);
    JointFactory::create_weld_joint_in(&mut simulator, plate, block, v(0.0, -10.0)).unwrap();
    run(&mut simulator, 20);
    let island = &simulator.islands()[0];
    assert_eq!((island.method, island.cost.newton_steps), (IslandSolver::Direct, 0));
    run(&mut simulator, 60);
    assert!(simulator.is_asleep(block));
}
