//! The precise set: springs of bodies with contacts or joints. They are rows with a stiffness of their own.

use conformance::fixtures::plane::{add_level_floor, add_part, energy, precise, run, v};
use farseer_core::math::Vector2;
use farseer_core::{
    AngleSpring, BodyFactory, BodyId, Contact, Context, Event, EventHandler, FixedAngleSpring,
    FixedLinearSpring, GeomFactory, GeomId, GeomPlacement, IslandSolver, JointFactory, JointId, LinearSpring,
    PhysicsSimulator, SolverChoice, SpringFactory, SpringId,
};

const DT: f32 = 1.0 / 60.0;
/// Length units per second squared; 32 length units are a metre.
const GRAVITY: f32 = 900.0;

fn add_wheel(simulator: &mut PhysicsSimulator, at: Vector2, radius: f32) -> BodyId {
    let body = BodyFactory::create_circle_body_in(simulator, radius, 1.0).unwrap();
    let geom =
        GeomFactory::create_circle_geom_in(simulator, body, radius, 16, GeomPlacement::default()).unwrap();
    simulator[body].set_position(at);
    simulator[geom].set_friction_coefficient(0.8);
    body
}

/// A light plate on the floor and a load above it that slides upright on a spring of 100 length units.
fn add_sprung_load(
    simulator: &mut PhysicsSimulator,
    mass: f32,
    [stiffness, damping]: [f32; 2],
) -> (BodyId, BodyId, SpringId) {
    let plate = add_part(simulator, v(0.0, -5.0), [60.0, 10.0], 1.0);
    let load = add_part(simulator, v(0.0, -105.0), [40.0, 40.0], mass);
    let origin = v(0.0, 0.0);
    let spring =
        SpringFactory::create_linear_spring_in(simulator, plate, origin, load, origin, stiffness, damping)
            .unwrap();
    JointFactory::create_prismatic_joint_in(simulator, plate, load, v(0.0, -5.0), v(0.0, 1.0)).unwrap();
    (plate, load, spring)
}

#[test]
fn a_spring_on_a_light_plate_yields_by_its_constant() {
    for dt in [1.0 / 30.0, DT, 1.0 / 120.0] {
        for (mass, stiffness, damping) in [
            (1.0, 500.0, 20.0),
            (10.0, 4000.0, 0.0),
            (150.0, 60_000.0, 3000.0),
            (150.0, 1e6, 1e4),
            (10.0, 1e9, 0.0),
        ] {
            let mut simulator = precise(GRAVITY);
            add_level_floor(&mut simulator);
            let (plate, load, _) = add_sprung_load(&mut simulator, mass, [stiffness, damping]);
            (0..(12.0 / dt) as usize).for_each(|_| simulator.update(dt));
            let length = simulator[plate].position().y - simulator[load].position().y;
            let law = 100.0 - mass * GRAVITY / stiffness;
            let case = format!("mass {mass}, stiffness {stiffness}, dt {dt}");
            // A velocity error of 1e-4 units of 32 per second is not corrected, in every step until it sleeps; a body that
            // swings by less than 2.4 length units per second sleeps.
            let left = 0.02 + 2.4 * (mass / stiffness).sqrt();
            assert!((length - law).abs() < left, "{case}: {length} instead of {law}");
            assert!((simulator[plate].position().y + 5.0).abs() < 0.02, "{case}");
            assert!(simulator.is_asleep(load), "{case}");
        }
    }
}

#[test]
fn an_undamped_spring_on_a_plate_never_lifts_it_nor_throws_its_load_higher() {
    for (mass, stiffness) in [(2.0, 500.0), (10.0, 4000.0), (150.0, 60_000.0), (150.0, 1e6)] {
        let mut simulator = precise(GRAVITY);
        add_level_floor(&mut simulator);
        let (plate, load, _) = add_sprung_load(&mut simulator, mass, [stiffness, 0.0]);
        for step in 0..600 {
            simulator.update(DT);
            let [plate, load] = [plate, load].map(|body| simulator[body].position().y);
            let case = format!("mass {mass}, stiffness {stiffness}, step {step}");
            assert!(load > -105.01 && plate > -5.05, "{case}: load at {load}, plate at {plate}");
        }
    }
}

/// A ball of mass 1 without drag on an undamped spring from a point of the world, stretched by 10, far from everything.
fn add_swinging(simulator: &mut PhysicsSimulator) -> BodyId {
    let ball = add_part(simulator, v(-5000.0, 0.0), [10.0, 10.0], 1.0);
    SpringFactory::create_fixed_linear_spring_in(simulator, ball, v(0.0, 0.0), v(-5000.0, -50.0), 400.0, 0.0)
        .unwrap();
    simulator[ball].set_position(v(-5000.0, 10.0));
    ball
}

#[test]
fn a_spring_between_free_bodies_keeps_its_bits_beside_any_other_bodies() {
    let mut alone = precise(0.0);
    let of_alone = add_swinging(&mut alone);
    let mut beside = precise(0.0);
    let of_beside = add_swinging(&mut beside);
    add_level_floor(&mut beside);
    let (_, load, _) = add_sprung_load(&mut beside, 10.0, [4000.0, 100.0]);
    let mut furthest = 0.0_f32;
    for step in 0..1200 {
        beside[load].apply_force(v(0.0, 9000.0));
        alone.update(DT);
        beside.update(DT);
        assert_eq!(alone[of_alone].position(), beside[of_beside].position(), "step {step}");
        furthest = if step < 1100 { 0.0 } else { furthest.max(alone[of_alone].position().y) };
    }
    assert!((furthest - 10.0).abs() < 0.2, "{furthest}");
}

#[test]
fn the_sag_of_a_car_follows_the_constants_of_its_springs() {
    for mass in [2.0, 10.0, 150.0] {
        let mut simulator = precise(GRAVITY);
        add_level_floor(&mut simulator);
        let body = add_part(&mut simulator, v(0.0, -50.0), [120.0, 20.0], mass);
        let stiffness = 400.0 * mass;
        for x in [-40.0, 40.0] {
            let wheel = add_wheel(&mut simulator, v(x, -10.0), 10.0);
            SpringFactory::create_linear_spring_in(
                &mut simulator,
                body,
                v(x, 0.0),
                wheel,
                v(0.0, 0.0),
                stiffness,
                20.0 * mass,
            )
            .unwrap();
            JointFactory::create_prismatic_joint_in(&mut simulator, body, wheel, v(x, -10.0), v(0.0, 1.0))
                .unwrap();
        }
        run(&mut simulator, 600);
        let sag = simulator[body].position().y + 50.0;
        let law = 0.5 * mass * GRAVITY / stiffness;
        assert!((sag - law).abs() < 0.02, "mass {mass}: {sag} instead of {law}");
        assert!(simulator[body].linear_velocity().norm() < 0.1, "mass {mass}");
    }
}

/// A level lever of mass 2 on a base that stands on the floor, hinged at its left end, with the torque of its weight about the
/// hinge.
fn add_lever(simulator: &mut PhysicsSimulator) -> (BodyId, BodyId, f32) {
    add_level_floor(simulator);
    let base = add_part(simulator, v(0.0, -20.0), [200.0, 40.0], 20.0);
    let lever = add_part(simulator, v(40.0, -100.0), [80.0, 8.0], 2.0);
    JointFactory::create_revolute_joint_in(simulator, base, lever, v(0.0, -100.0)).unwrap();
    (base, lever, 2.0 * GRAVITY * 40.0)
}

#[test]
fn an_angle_spring_holds_a_lever_at_the_angle_of_its_torque() {
    for (stiffness, damping) in [(4e5, 2e4), (4e6, 1e5), (1e8, 1e6), (1e12, 0.0)] {
        let mut simulator = precise(GRAVITY);
        let (base, lever, torque) = add_lever(&mut simulator);
        SpringFactory::create_angle_spring_in(&mut simulator, base, lever, stiffness, damping).unwrap();
        run(&mut simulator, 1200);
        let angle = simulator[lever].total_rotation() - simulator[base].total_rotation();
        // The arm of the weight gets shorter as the lever sinks.
        let law = (0..50).fold(0.0_f32, |angle, _| torque * angle.cos() / stiffness);
        assert!((angle - law).abs() < 1e-3, "stiffness {stiffness}: {angle} instead of {law}");
    }
}

#[test]
fn an_angle_spring_turns_with_its_greatest_torque_and_no_more() {
    let at_once = |part: f32| {
        let mut simulator = precise(GRAVITY);
        let (base, lever, torque) = add_lever(&mut simulator);
        let spring = SpringFactory::create_angle_spring_in(&mut simulator, base, lever, 1e9, 0.0).unwrap();
        let spring = simulator.spring_as_mut::<AngleSpring>(spring).unwrap();
        spring.set_target_angle(-1.0).unwrap();
        spring.set_max_torque(part * torque).unwrap();
        let inertia = simulator[lever].moment_of_inertia() + 2.0 * 40.0 * 40.0;
        run(&mut simulator, 3);
        let law = (1.0 - part) * torque / inertia * 3.0 * DT;
        (simulator[lever].angular_velocity() - simulator[base].angular_velocity(), law)
    };
    for part in [0.5, 0.9, 1.1, 1.5] {
        let (spin, law) = at_once(part);
        assert!(
            (spin - law).abs() < 0.02 * law.abs() + 1e-3,
            "{part} of the weight: {spin} instead of {law}"
        );
    }
}

#[test]
fn a_fixed_angle_spring_turns_a_box_over_its_edge_no_further_than_its_target() {
    let mut simulator = precise(GRAVITY);
    add_level_floor(&mut simulator);
    let bar = add_part(&mut simulator, v(0.0, -20.0), [40.0, 40.0], 1.0);
    let spring = SpringFactory::create_fixed_angle_spring_in(&mut simulator, bar, 1e7, 2e5).unwrap();
    simulator.spring_as_mut::<FixedAngleSpring>(spring).unwrap().set_target_angle(0.3).unwrap();
    run(&mut simulator, 300);
    let turned = simulator[bar].total_rotation();
    assert!((turned - 0.3).abs() < 0.01, "{turned}");
}

#[test]
fn a_stiff_spring_that_drags_a_jointed_body_to_a_point_holds_it_there() {
    for stiffness in [1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13] {
        let (mut simulator, look) = hoist([stiffness, 2.0 * (5.2 * stiffness).sqrt()]);
        run(&mut simulator, 1200);
        let ((_, off), weight) = (look(&simulator), 5.2 * GRAVITY);
        // A load that still swings from the point, from less than level, pulls with three times its weight at most.
        assert!(off < 3.0 * weight / stiffness + 0.01, "stiffness {stiffness}: {off}");
    }
}

/// A block of mass 5 on the floor, with a tip of mass 0.2 welded to it, which a spring without length pulls to a point. Energy
/// of all of it, and how far the tip is from the point.
fn hoist([stiffness, damping]: [f32; 2]) -> (PhysicsSimulator, impl Fn(&PhysicsSimulator) -> (f32, f32)) {
    let mut simulator = precise(GRAVITY);
    add_level_floor(&mut simulator);
    let block = add_part(&mut simulator, v(0.0, -20.0), [40.0, 40.0], 5.0);
    let tip = add_part(&mut simulator, v(40.0, -30.0), [20.0, 10.0], 0.2);
    JointFactory::create_weld_joint_in(&mut simulator, block, tip, v(25.0, -30.0)).unwrap();
    let (point, origin) = (v(120.0, -160.0), v(10.0, 0.0));
    let spring =
        SpringFactory::create_fixed_linear_spring_in(&mut simulator, tip, origin, point, stiffness, damping)
            .unwrap();
    simulator.spring_as_mut::<FixedLinearSpring>(spring).unwrap().set_rest_length(0.0).unwrap();
    let look = move |simulator: &PhysicsSimulator| {
        let stretch = (simulator[tip].get_world_position(origin) - point).norm();
        (energy(simulator, &[block, tip], GRAVITY) + 0.5 * stiffness * stretch * stretch, stretch)
    };
    (simulator, look)
}

#[test]
fn a_spring_that_hoists_a_heavy_body_by_a_light_one_welded_to_it_gains_no_energy() {
    let all = [10.0, 100.0, 1000.0, 1e4, 1e6];
    for (choice, all) in [(SolverChoice::Auto, &all[..]), (SolverChoice::Iterative, &all[..3])] {
        for &stiffness in all {
            let (mut simulator, look) = hoist([stiffness, 0.0]);
            simulator.set_solver_choice(choice);
            let (begun, _) = look(&simulator);
            for step in 0..300 {
                simulator.update(DT);
                let (energy, _) = look(&simulator);
                let case = format!("{choice:?}, stiffness {stiffness}, step {step}");
                assert!(energy < 1.01 * begun, "{case}: {energy} of {begun}");
            }
        }
    }
}

#[test]
fn the_iterative_solver_holds_a_load_at_the_sag_of_its_spring() {
    for (mass, stiffness, damping) in [(1.0, 500.0, 20.0), (10.0, 4000.0, 0.0), (150.0, 60_000.0, 3000.0)] {
        let mut simulator = precise(GRAVITY);
        simulator.set_solver_choice(SolverChoice::Iterative);
        add_level_floor(&mut simulator);
        let (plate, load, _) = add_sprung_load(&mut simulator, mass, [stiffness, damping]);
        run(&mut simulator, 720);
        let length = simulator[plate].position().y - simulator[load].position().y;
        let law = 100.0 - mass * GRAVITY / stiffness;
        let case = format!("mass {mass}, stiffness {stiffness}");
        // A load that swings by less than 2.4 length units per second sleeps.
        let left = 0.05 + 2.4 * (mass / stiffness).sqrt();
        assert!((length - law).abs() < left, "{case}: {length} instead of {law}");
        assert!(simulator[load].linear_velocity().norm() < 2.4, "{case}");
    }
}

#[test]
fn the_iterative_solver_turns_a_lever_to_the_angle_of_its_spring_torque() {
    for (stiffness, damping) in [(4e5, 2e4), (4e6, 1e5), (1e8, 1e6)] {
        let mut simulator = precise(GRAVITY);
        simulator.set_solver_choice(SolverChoice::Iterative);
        let (base, lever, torque) = add_lever(&mut simulator);
        SpringFactory::create_angle_spring_in(&mut simulator, base, lever, stiffness, damping).unwrap();
        run(&mut simulator, 1200);
        let angle = simulator[lever].total_rotation() - simulator[base].total_rotation();
        let law = (0..50).fold(0.0_f32, |angle, _| torque * angle.cos() / stiffness);
        assert!((angle - law).abs() < 1e-3, "stiffness {stiffness}: {angle} instead of {law}");
    }
}

#[test]
fn a_spring_that_is_a_row_breaks_and_reports_its_error_as_any_other() {
    let mut simulator = precise(GRAVITY);
    add_level_floor(&mut simulator);
    let (plate, load, spring) = add_sprung_load(&mut simulator, 10.0, [400.0, 100.0]);
    simulator[spring].set_breakpoint(5.0).unwrap();
    let mut before = 0.0;
    let broke = (0..120).find(|_| {
        before = simulator[plate].position().y - simulator[load].position().y - 100.0;
        simulator.update(DT);
        if !simulator.events().contains(&Event::SpringBroke { spring }) {
            assert!((simulator[spring].spring_error() - before).abs() < 1e-3);
        }
        !simulator[spring].enabled()
    });
    assert!(broke.is_some() && simulator[spring].spring_error() < -5.0);
    run(&mut simulator, 120);
    let apart = simulator[plate].position().y - simulator[load].position().y;
    assert!((apart - 25.0).abs() < 0.1, "the load lies on the plate: {apart}");
}

#[test]
fn springs_of_any_finite_constants_keep_all_numbers_finite() {
    let constants = [0.0, 1e-30, 1.0, 1e10, 1e30, f32::MAX, -1.0];
    for stiffness in constants {
        for damping in constants {
            let mut simulator = precise(GRAVITY);
            add_level_floor(&mut simulator);
            let (plate, load, _) = add_sprung_load(&mut simulator, 10.0, [stiffness, damping]);
            SpringFactory::create_angle_spring_in(&mut simulator, plate, load, stiffness, damping).unwrap();
            run(&mut simulator, 30);
            for body in [plate, load] {
                let (place, velocity) = (simulator[body].position(), simulator[body].linear_velocity());
                assert!((place.norm() + velocity.norm()).is_finite(), "{stiffness}, {damping}");
            }
        }
    }
}

#[test]
fn edits_and_removal_of_a_spring_move_its_load() {
    let mut simulator = precise(GRAVITY);
    add_level_floor(&mut simulator);
    let (plate, load, spring) = add_sprung_load(&mut simulator, 10.0, [4000.0, 400.0]);
    run(&mut simulator, 300);
    simulator[spring].set_spring_constant(9000.0).unwrap();
    simulator[load].apply_impulse(v(0.0, -1.0));
    run(&mut simulator, 300);
    let length = simulator[plate].position().y - simulator[load].position().y;
    assert!((length - 99.0).abs() < 0.02, "{length}");
    simulator.dispose(spring).unwrap();
    simulator[load].apply_impulse(v(0.0, -1.0));
    run(&mut simulator, 300);
    let length = simulator[plate].position().y - simulator[load].position().y;
    assert!((length - 25.0).abs() < 0.1, "{length}");
    assert_eq!(simulator.islands()[0].method, IslandSolver::Asleep);
}

#[test]
fn springs_that_are_rows_go_on_with_the_same_bits_after_a_restore_in_any_step() {
    let mut simulator = precise(GRAVITY);
    add_level_floor(&mut simulator);
    let (_, load, _) = add_sprung_load(&mut simulator, 10.0, [4000.0, 100.0]);
    // Springs between bodies that land one after the other: first forces, then rows.
    let falling: Vec<BodyId> = (0..3)
        .map(|at| {
            add_part(&mut simulator, v(200.0 + 50.0 * at as f32, -40.0 - 60.0 * at as f32), [20.0; 2], 1.0)
        })
        .collect();
    for pair in falling.windows(2) {
        let origin = v(0.0, 0.0);
        let spring = SpringFactory::create_linear_spring_in(
            &mut simulator,
            pair[0],
            origin,
            pair[1],
            origin,
            300.0,
            5.0,
        )
        .unwrap();
        simulator.spring_as_mut::<LinearSpring>(spring).unwrap().set_rest_length(45.0).unwrap();
    }
    let (base, lever, _) = add_lever(&mut simulator);
    SpringFactory::create_angle_spring_in(&mut simulator, base, lever, 4e5, 2e3).unwrap();
    for step in 0..300 {
        if step == 200 {
            simulator[load].apply_impulse(v(0.0, 100.0));
        }
        let mut restored = precise(0.0);
        restored.restore(&simulator.snapshot()).unwrap();
        simulator.update(DT);
        restored.update(DT);
        assert!(simulator.snapshot() == restored.snapshot(), "step {step}");
    }
}

/// Disables a joint when geoms begin to touch.
struct Unhinges(Option<JointId>);

impl EventHandler for Unhinges {
    fn on_collision(
        &mut self,
        context: &mut Context<'_>,
        _: GeomId,
        _: GeomId,
        _: &mut Vec<Contact>,
    ) -> bool {
        if let Some(joint) = self.0.take() {
            context[joint].set_enabled(false);
        }
        true
    }
}

#[test]
fn a_spring_is_a_force_in_the_update_in_which_a_handler_disables_the_joint_of_its_body() {
    let mut simulator = precise(GRAVITY);
    add_level_floor(&mut simulator);
    add_part(&mut simulator, v(300.0, -60.0), [20.0; 2], 1.0);
    let hung = add_part(&mut simulator, v(0.0, -300.0), [20.0; 2], 1.0);
    let joint = JointFactory::create_fixed_revolute_joint_in(&mut simulator, hung, v(40.0, -300.0)).unwrap();
    SpringFactory::create_fixed_linear_spring_in(
        &mut simulator,
        hung,
        v(0.0, 10.0),
        v(-60.0, -350.0),
        200.0,
        1.0,
    )
    .unwrap();
    let mut handler = Unhinges(Some(joint));
    for step in 0..60 {
        let mut restored = precise(0.0);
        restored.restore(&simulator.snapshot()).unwrap();
        restored.update_with(DT, &mut Unhinges(handler.0));
        simulator.update_with(DT, &mut handler);
        assert!(simulator.snapshot() == restored.snapshot(), "step {step}");
    }
    assert!(handler.0.is_none(), "the falling box never touched the floor");
}
