//! The precise set: reports of islands, and the choice of their solver by the game.

use conformance::fixtures::plane::{add_box, add_circle, add_floor, simulator, v};
use farseer_core::{
    BodyId, DebugShape, Island, IslandSolver, JointFactory, Methods, PhysicsSimulator, PhysicsSimulatorView,
    SolverChoice, SolverReason, SpringFactory,
};

const DT: f32 = 1.0 / 60.0;
const GRAVITY: f32 = 320.0;

/// A simulator with a floor whose surface is at y = 0.
fn precise() -> PhysicsSimulator {
    let mut simulator = simulator(GRAVITY);
    simulator.set_methods(Methods::PRECISE).unwrap();
    simulator.set_iterations(4);
    add_floor(&mut simulator, (2000.0, 20.0), v(0.0, 10.0));
    simulator
}

fn run(simulator: &mut PhysicsSimulator, steps: usize) {
    (0..steps).for_each(|_| simulator.update(DT));
}

/// Boxes of 32 px, one on the other.
fn add_column(simulator: &mut PhysicsSimulator, x: f32, count: usize) -> Vec<BodyId> {
    (0..count).map(|row| add_box(simulator, (32.0, 32.0), v(x, -16.0 - 32.0 * row as f32)).0).collect()
}

/// Boxes beside and over each other that fall upon one another.
fn add_heap(simulator: &mut PhysicsSimulator, count: usize) {
    for at in 0..count {
        let (row, column) = (at / 6, at % 6);
        let x = 36.0 * column as f32 + 12.0 * (row % 3) as f32;
        add_box(simulator, (32.0, 32.0), v(x, -20.0 - 38.0 * row as f32));
    }
}

/// Links of 16 px that hang from a point in the air.
fn add_chain(simulator: &mut PhysicsSimulator, count: usize) -> Vec<BodyId> {
    let mut bodies = Vec::<BodyId>::new();
    for at in 0..count {
        let left = v(-500.0 + 16.0 * at as f32, -500.0);
        let (body, geom) = add_box(simulator, (16.0, 4.0), left + v(8.0, 0.0));
        simulator[geom].set_collision_group(1);
        match bodies.last() {
            None => JointFactory::create_fixed_revolute_joint_in(simulator, body, left),
            Some(&last) => JointFactory::create_revolute_joint_in(simulator, last, body, left),
        }
        .unwrap();
        bodies.push(body);
    }
    bodies
}

fn only(simulator: &PhysicsSimulator) -> Island {
    let islands = simulator.islands();
    assert_eq!(islands.len(), 1, "{islands:?}");
    islands.into_iter().next().unwrap()
}

fn told(simulator: &PhysicsSimulator) -> (IslandSolver, SolverReason) {
    let island = only(simulator);
    (island.method, island.why)
}

#[test]
fn a_body_in_the_air_is_ballistic_and_has_no_solver_cost() {
    let mut simulator = precise();
    add_box(&mut simulator, (32.0, 32.0), v(0.0, -500.0));
    run(&mut simulator, 3);
    let island = only(&simulator);
    assert_eq!((island.method, island.why), (IslandSolver::Ballistic, SolverReason::NothingTouches));
    let cost = island.cost;
    assert_eq!((cost.rows, cost.joints, cost.parts, cost.newton_steps), (0, 0, 1, 0));
    assert_eq!(simulator.island_residual(&island), Default::default());
}

#[test]
fn a_chain_in_the_air_is_an_articulation_with_its_own_number_of_substeps() {
    let mut simulator = precise();
    add_chain(&mut simulator, 12);
    // It begins slowly, and is fast when it is through.
    let parts: Vec<u32> = (0..180)
        .map(|_| {
            simulator.update(DT);
            let island = only(&simulator);
            assert_eq!(
                (island.method, island.why),
                (IslandSolver::Articulated, SolverReason::NothingTouches)
            );
            assert_eq!((island.cost.joints, island.bodies.len()), (12, 12));
            island.cost.parts
        })
        .collect();
    assert_eq!(parts[0], 2);
    // At most two in each of four substeps, and four if the step is repeated.
    assert!(parts.iter().all(|&parts| parts <= 16) && parts.iter().any(|&parts| parts > 2), "{parts:?}");
}

#[test]
fn the_gap_of_a_joint_is_reported() {
    let mut simulator = precise();
    let bodies = add_chain(&mut simulator, 2);
    run(&mut simulator, 1);
    let gap = |simulator: &PhysicsSimulator| simulator.island_residual(&only(simulator)).gap;
    assert!(gap(&simulator) < 0.01, "{}", gap(&simulator));
    let place = simulator[bodies[1]].position();
    simulator[bodies[1]].set_position(place + v(0.0, 200.0));
    run(&mut simulator, 1);
    // Half of a gap of one length unit is corrected in each substep.
    let left = gap(&simulator);
    assert!((200.0 - 4.0 * 16.0 - 1.0..200.0).contains(&left), "{left}");
}

#[test]
fn the_gap_of_a_sleeping_chain_is_reported_too() {
    let mut simulator = precise();
    let bodies = add_chain(&mut simulator, 3);
    for (at, &body) in bodies.iter().enumerate() {
        simulator[body].set_rotation(std::f32::consts::FRAC_PI_2);
        simulator[body].set_position(v(-500.0, -492.0 + 16.0 * at as f32));
    }
    run(&mut simulator, 60);
    assert_eq!(told(&simulator), (IslandSolver::Asleep, SolverReason::AtRest));
    let gap = simulator.island_residual(&only(&simulator)).gap;
    assert!(gap > 0.0 && gap < 0.01, "{gap}");
}

#[test]
fn a_column_built_in_place_uses_the_direct_solver() {
    let mut simulator = precise();
    simulator.set_sleep_enabled(false);
    add_column(&mut simulator, 0.0, 5);
    run(&mut simulator, 1);
    let first = only(&simulator);
    assert_eq!((first.method, first.why), (IslandSolver::Direct, SolverReason::Pays));
    assert!(first.is_solved_whole && !first.is_asleep);
    assert_eq!((first.cost.rows, first.cost.parts), (5, 1));
    assert!(first.cost.newton_steps > 0, "the load is found");
    run(&mut simulator, 120);
    let island = only(&simulator);
    assert_eq!(island.cost.newton_steps, 0, "it goes on to bear what it bore");
    let left = simulator.island_residual(&island);
    // As the guide says: below a thousandth of a px.
    assert!(left.overlap < 1e-3 && left.approach < 0.01, "{left:?}");
}

#[test]
fn a_falling_heap_uses_the_iterative_solver() {
    let mut simulator = precise();
    add_heap(&mut simulator, 60);
    run(&mut simulator, 40);
    let islands = simulator.islands();
    let heap = islands.iter().max_by_key(|island| island.bodies.len()).unwrap();
    assert!(heap.bodies.len() >= 40, "{}", heap.bodies.len());
    assert_eq!((heap.method, heap.why), (IslandSolver::Iterative, SolverReason::Moves));
    assert_eq!(heap.cost.parts, 4, "the substeps");
    assert!(heap.cost.rows >= heap.bodies.len());
}

#[test]
fn sleeping_bodies_have_no_solver_cost() {
    let mut simulator = precise();
    add_column(&mut simulator, 0.0, 3);
    run(&mut simulator, 120);
    let island = only(&simulator);
    assert_eq!((island.method, island.why), (IslandSolver::Asleep, SolverReason::AtRest));
    assert!(island.is_asleep && !island.is_solved_whole);
    assert_eq!(island.cost, Default::default());
}

#[test]
fn the_reason_for_the_iterative_solver_is_reported() {
    type Build = fn(&mut PhysicsSimulator);
    let scenes: [(Build, SolverReason); 4] = [
        (|simulator| drop(add_column(simulator, 0.0, 1)), SolverReason::OneBody),
        (add_small_ring, SolverReason::TooSmall),
        (|simulator| drop(add_column(simulator, 0.0, 401)), SolverReason::TooLarge),
        (add_tied_column, SolverReason::Joints),
    ];
    for (build, why) in scenes {
        let mut simulator = precise();
        build(&mut simulator);
        run(&mut simulator, 2);
        assert_eq!(told(&simulator), (IslandSolver::Iterative, why));
    }
}

/// Two boxes side by side, one across them, and one on it.
fn add_small_ring(simulator: &mut PhysicsSimulator) {
    for place in [v(-16.0, -16.0), v(16.0, -16.0), v(0.0, -48.0)] {
        add_box(simulator, (32.0, 32.0), place);
    }
}

fn add_tied_column(simulator: &mut PhysicsSimulator) {
    let bodies = add_column(simulator, 0.0, 3);
    let between = v(0.0, -32.0);
    let joint = JointFactory::create_revolute_joint_in(simulator, bodies[0], bodies[1], between).unwrap();
    simulator[joint].set_softness(0.1).unwrap();
}

#[test]
fn a_bouncing_ball_moves_its_column_to_the_iterative_solver_for_a_while() {
    let mut simulator = precise();
    add_column(&mut simulator, 0.0, 2);
    let (_, geom) = add_circle(&mut simulator, 10.0, 32, v(0.0, -64.0 - 10.0 - 50.0));
    simulator[geom].set_restitution_coefficient(1.0);
    let mut reasons = Vec::new();
    for _ in 0..60 {
        simulator.update(DT);
        reasons.extend(simulator.islands().iter().map(|island| island.why));
    }
    reasons.dedup();
    assert!(reasons.contains(&SolverReason::Bounces), "{reasons:?}");
    let rests = |why: &SolverReason| matches!(why, SolverReason::Rests { updates: 1..=16 });
    assert!(reasons.iter().any(rests), "{reasons:?}");
}

#[test]
fn a_spring_to_a_flying_body_keeps_its_column_in_the_direct_solver() {
    let mut simulator = precise();
    let column = add_column(&mut simulator, 0.0, 3);
    let (body, _) = add_box(&mut simulator, (32.0, 32.0), v(300.0, -500.0));
    let middle = v(0.0, 0.0);
    SpringFactory::create_linear_spring_in(&mut simulator, column[2], middle, body, middle, 0.1, 0.1)
        .unwrap();
    run(&mut simulator, 2);
    let island = only(&simulator);
    assert_eq!((island.bodies.len(), island.method), (4, IslandSolver::Direct));
}

#[test]
fn an_overlap_and_an_approach_speed_are_reported() {
    let mut simulator = precise();
    simulator.set_gravity(v(0.0, 0.0)).unwrap();
    let (body, _) = add_box(&mut simulator, (32.0, 32.0), v(0.0, -15.0));
    run(&mut simulator, 1);
    simulator[body].set_position(v(0.0, -14.0));
    run(&mut simulator, 1);
    let left = simulator.island_residual(&only(&simulator));
    // The overlap was 2 px, and its correction has a speed of at most three units a second.
    assert!(left.overlap > 2.0 - 3.0 * 32.0 * DT - 0.01 && left.overlap < 2.0, "{left:?}");
    simulator[body].set_linear_velocity(v(0.0, 50.0));
    simulator[body].set_angular_velocity(0.0);
    assert_eq!(simulator.island_residual(&only(&simulator)).approach, 50.0);
}

#[test]
fn a_forced_solver_choice_applies_to_columns_and_heaps() {
    let mut simulator = precise();
    simulator.set_sleep_enabled(false);
    simulator.set_solver_choice(SolverChoice::Iterative);
    add_column(&mut simulator, 0.0, 5);
    run(&mut simulator, 60);
    assert_eq!(told(&simulator), (IslandSolver::Iterative, SolverReason::Chosen));
    simulator.set_solver_choice(SolverChoice::Auto);
    run(&mut simulator, 1);
    assert_eq!(told(&simulator), (IslandSolver::Direct, SolverReason::Pays));

    let mut simulator = precise();
    simulator.set_solver_choice(SolverChoice::Direct);
    add_heap(&mut simulator, 30);
    for _ in 0..120 {
        simulator.update(DT);
        for island in simulator.islands().iter().filter(|island| !island.is_asleep) {
            let is_alone = island.why == SolverReason::OneBody || island.method == IslandSolver::Ballistic;
            let is_chosen = (island.method, island.why) == (IslandSolver::Direct, SolverReason::Chosen);
            assert!(is_chosen || is_alone, "{island:?}");
        }
    }
}

#[test]
fn a_body_that_slides_onto_a_light_one_does_not_push_it_faster_than_itself() {
    for rate in [30.0, 60.0, 120.0] {
        for mass in [3.0, 6.0, 20.0] {
            let mut simulator = precise();
            simulator.set_solver_choice(SolverChoice::Direct);
            let light = add_box(&mut simulator, (40.0, 40.0), v(0.0, -20.0)).0;
            let heavy = add_box(&mut simulator, (24.0, 60.0), v(-6.0, -73.0)).0;
            simulator[light].set_mass(mass).unwrap();
            simulator[heavy].set_mass(70.0).unwrap();
            simulator[heavy].set_moment_of_inertia(1e20).unwrap();
            simulator[heavy].set_linear_velocity(v(110.0, 190.0));
            for _ in 0..rate as usize {
                simulator.update(1.0 / rate);
                let speed = simulator[light].linear_velocity().x.abs();
                assert!(speed <= 110.0, "a box of {mass} at {rate} Hz: {speed}");
            }
        }
    }
}

#[test]
fn restitution_acts_with_the_direct_solver_forced() {
    let highest = |choice| {
        let mut simulator = precise();
        simulator.set_solver_choice(choice);
        let (low, _) = add_box(&mut simulator, (32.0, 32.0), v(0.0, -16.0));
        simulator[low].set_mass(1e4).unwrap();
        simulator[low].set_moment_of_inertia(1e4 * 32.0 * 32.0 / 6.0).unwrap();
        let (ball, geom) = add_circle(&mut simulator, 10.0, 32, v(0.0, -142.0));
        simulator[geom].set_restitution_coefficient(1.0);
        run(&mut simulator, 45);
        let place = |_| {
            simulator.update(DT);
            simulator[ball].position().y
        };
        (0..40).map(place).fold(0.0, f32::min)
    };
    assert_eq!(highest(SolverChoice::Direct), highest(SolverChoice::Auto));
    // A quarter of the 100 px that it falls, from where it lies; of the 253 px/s of the impact the velocity of a step's
    // gravity, 5.3 px/s, may be missing, and drag takes some. Measured: 1.54 px.
    assert!((highest(SolverChoice::Direct) + 42.0 + 25.0).abs() < 2.0, "{}", highest(SolverChoice::Direct));
}

#[test]
fn a_choice_is_saved_and_a_loaded_simulator_goes_on_with_the_same_bits() {
    for choice in [SolverChoice::Auto, SolverChoice::Iterative, SolverChoice::Direct] {
        let mut plain = precise();
        add_heap(&mut plain, 30);
        add_column(&mut plain, -200.0, 6);
        run(&mut plain, 40);
        plain.set_solver_choice(choice);
        // At once, and after an update with the new choice.
        for _ in 0..2 {
            let mut loaded = PhysicsSimulator::default();
            loaded.restore(&plain.snapshot()).unwrap();
            assert_eq!(loaded.solver_choice(), choice);
            let mut plain = plain.clone();
            for _ in 0..60 {
                [&mut plain, &mut loaded].into_iter().for_each(|simulator| simulator.update(DT));
                assert!(plain.snapshot() == loaded.snapshot(), "{choice:?}");
            }
            run(&mut plain, 1);
        }
    }
}

#[test]
fn a_choice_undone_before_the_next_update_changes_no_bit() {
    let mut plain = precise();
    add_heap(&mut plain, 30);
    run(&mut plain, 30);
    let mut other = plain.clone();
    other.set_solver_choice(SolverChoice::Direct);
    other.set_solver_choice(SolverChoice::Auto);
    for simulator in [&mut plain, &mut other] {
        run(simulator, 30);
    }
    assert!(plain.snapshot() == other.snapshot());
}

#[test]
fn the_faithful_set_keeps_a_solver_choice_without_effect() {
    let mut plain = simulator(GRAVITY);
    add_floor(&mut plain, (400.0, 20.0), v(0.0, 10.0));
    let column = add_column(&mut plain, 0.0, 3);
    let mut chosen = plain.clone();
    chosen.set_solver_choice(SolverChoice::Direct);
    for simulator in [&mut plain, &mut chosen] {
        run(simulator, 60);
    }
    assert_eq!(chosen.solver_choice(), SolverChoice::Direct);
    assert!(column.iter().all(|&body| plain[body].position() == chosen[body].position()));
}

#[test]
fn each_solver_has_a_colour_of_its_own() {
    let mut simulator = precise();
    let asleep = add_column(&mut simulator, 300.0, 1);
    run(&mut simulator, 120);
    assert!(simulator.is_asleep(asleep[0]));
    add_column(&mut simulator, 0.0, 3);
    add_column(&mut simulator, -100.0, 1);
    add_chain(&mut simulator, 3);
    add_box(&mut simulator, (32.0, 32.0), v(500.0, -500.0));
    run(&mut simulator, 1);
    let mut colours = Vec::new();
    PhysicsSimulatorView::default().draw_islands(&simulator, |shape| {
        if let DebugShape::Line { color, .. } = shape {
            colours.push(color);
        }
    });
    colours.dedup();
    let count = colours.len();
    colours.sort_unstable();
    colours.dedup();
    assert_eq!((count, colours.len()), (5, 5));
}

#[test]
fn islands_can_be_asked_for_between_a_change_of_methods_and_the_next_update() {
    let mut simulator = simulator(100.0);
    let [one, other] = [0.0, 40.0].map(|x| add_box(&mut simulator, (10.0, 10.0), v(x, 0.0)).0);
    SpringFactory::create_angle_spring_in(&mut simulator, one, other, 1.0, 1.0).unwrap();
    simulator.update(0.01);
    simulator.set_methods(Methods::PRECISE).unwrap();
    assert!(simulator.islands().is_empty());
    simulator.sleep(one);
    simulator.update(0.01);
    assert_eq!(simulator.islands().len(), 1, "the spring connects the two");
}
