//! Updates of a settled scene allocate no memory.
//!
//! A program of its own: a program has one allocator, and this one counts.

// A global allocator cannot be written without: its trait is unsafe.
#![allow(unsafe_code)]

use conformance::fixtures::depth;
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use conformance::fixtures::plane::{
    self, NARROW_PHASES, add_box, add_circle, add_floor, faithful_methods, lively_scene, simulator_with, v,
};
use farseer_core::{
    Aabb, BodyBuilder, BodyId, BodyInterpolation, BroadPhaseCollider, CharacterMover, Context, Controller,
    Dispatch, EventHandler, FluidContainerRef, FluidDragController, GeomBuilder, GravityController,
    InactivityController, IslandSolver, JointFactory, JointId, Methods, MoverInput, MoverOptions,
    PhysicsSimulator, QueryFilter, ScalingController, SolverChoice, SpringFactory, SpringId, WantedEvents,
    WaveController,
};

/// The system's allocator, counting the calls of every thread for itself.
struct Counting;

thread_local! {
    static CALLS: Cell<usize> = const { Cell::new(0) };
}

fn count() {
    CALLS.set(CALLS.get() + 1);
}

// SAFETY: every call is handed on as it is; counting touches no memory that the allocator manages.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        // SAFETY: the caller's promises are those of `System`.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        count();
        // SAFETY: as above.
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, new_size: usize) -> *mut u8 {
        count();
        // SAFETY: as above.
        unsafe { System.realloc(pointer, layout, new_size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Calls of the allocator during an action.
fn calls(action: impl FnOnce()) -> usize {
    let before = CALLS.get();
    action();
    CALLS.get() - before
}

/// Boxes and circles at rest on a floor between two walls, some in stacks.
fn settled_scene(methods: Methods) -> PhysicsSimulator {
    let mut simulator = simulator_with(200.0, methods);
    add_floor(&mut simulator, (600.0, 40.0), v(0.0, 320.0));
    add_floor(&mut simulator, (40.0, 700.0), v(-320.0, 0.0));
    add_floor(&mut simulator, (40.0, 700.0), v(320.0, 0.0));
    for i in 0..24 {
        let position = v((i % 8) as f32 * 70.0 - 250.0, 285.0 - (i / 8) as f32 * 35.0);
        let (_, geom) = if i >= 16 && i % 2 == 0 {
            add_circle(&mut simulator, 14.0, 12, position)
        } else {
            add_box(&mut simulator, (30.0, 30.0), position)
        };
        simulator[geom].set_friction_coefficient(0.6);
    }
    for _ in 0..1500 {
        simulator.update(0.01);
    }
    simulator
}

#[test]
fn the_counter_counts_allocations() {
    assert_eq!(calls(|| drop(std::hint::black_box(Box::new(1)))), 2);
    assert_eq!(calls(|| ()), 0);
}

#[test]
fn an_update_of_a_settled_scene_allocates_nothing() {
    let mut allocating = Vec::new();
    for methods in faithful_methods() {
        let mut simulator = settled_scene(methods);
        assert!(simulator.contact_count() > 40, "{methods:?}: nothing touches");
        let calls: usize = (0..300).map(|_| calls(|| simulator.update(0.01))).sum();
        if calls > 0 {
            allocating.push(format!("{methods:?}: {calls} calls in 300 updates"));
        }
    }
    assert!(allocating.is_empty(), "{allocating:#?}");
}

/// The settled scene, with the precise set for long enough to settle again.
fn settled_precise_scene() -> PhysicsSimulator {
    let mut simulator = settled_scene(Default::default());
    simulator.set_methods(Methods::PRECISE).unwrap();
    (0..600).for_each(|_| simulator.update(0.01));
    assert!(simulator.contact_count() > 40, "nothing touches");
    simulator
}

#[test]
fn an_update_of_a_settled_scene_with_the_precise_set_allocates_nothing() {
    let mut simulator = settled_precise_scene();
    assert_eq!((0..300).map(|_| calls(|| simulator.update(0.01))).sum::<usize>(), 0);
}

#[test]
fn rays_and_boxes_of_the_precise_set_allocate_nothing_after_the_first() {
    let simulator = settled_precise_scene();
    let mut found = Vec::new();
    let mut ask = || {
        let filter = QueryFilter::default();
        let mut answers = 0;
        for at in 0..40 {
            let (start, end) = (v(15.0 * at as f32 - 300.0, -300.0), v(300.0 - 15.0 * at as f32, 320.0));
            answers += usize::from(simulator.ray_cast(start, end).is_some());
            answers += usize::from(simulator.cast_ray(start, end, &filter).unwrap().is_some());
            answers += usize::from(simulator.cast_ray_any(start, end, &filter).unwrap().is_some());
            simulator.query_aabb_into(&Aabb::new(v(-300.0, 0.0), end), &mut found);
            answers += found.len();
        }
        answers
    };
    assert!(ask() > 100);
    assert_eq!(calls(|| _ = ask()), 0);
}

#[test]
fn typed_events_hits_and_options_of_sleep_allocate_nothing() {
    let mut simulator = PhysicsSimulator::precise([0.0, 300.0]).unwrap();
    simulator
        .add_body(BodyBuilder::fixed().position([0.0, 10.0]), [GeomBuilder::rectangle(900.0, 20.0)])
        .unwrap();
    simulator.set_largest_speed(Some(1000.0)).unwrap();
    for i in 0..20 {
        // One column never sleeps, the others do.
        let place = [(i % 4) as f32 * 60.0, -16.0 - (i / 4) as f32 * 32.0];
        let body = BodyBuilder::dynamic().position(place).sleep_allowed(i % 4 > 0);
        let geom = GeomBuilder::rectangle(32.0, 32.0).events(WantedEvents::ALL);
        simulator.add_body(body, [geom]).unwrap();
    }
    (0..300).for_each(|_| simulator.update(0.01));
    assert_eq!(simulator.counters().bodies_asleep, 15);
    assert_eq!(calls(|| (0..300).for_each(|_| simulator.update(0.01))), 0);
}

#[test]
fn the_drawing_order_is_sorted_again_without_allocation() {
    let (mut simulator, _) = depth::busy_scene();
    simulator.update(0.01);
    let mut order = twohalf::DrawOrder::default();
    assert!(calls(|| _ = order.sort(&simulator)) > 0);
    assert_eq!(calls(|| (0..10).for_each(|_| _ = order.sort(&simulator))), 0);
}

#[test]
fn an_update_with_handlers_of_every_geom_allocates_nothing() {
    let mut simulator = settled_precise_scene();
    let mut dispatch = Dispatch::new();
    for geom in simulator.geoms() {
        dispatch.on_collision(geom, |count: &mut usize, _, _, _, _| {
            *count += 1;
            true
        });
    }
    let mut count = 0;
    // The first one grows the lists of contacts.
    simulator.update_with(0.01, &mut dispatch.with(&mut count));
    let calls = calls(|| (0..300).for_each(|_| simulator.update_with(0.01, &mut dispatch.with(&mut count))));
    assert!(count > 300 * 40, "all are asked in every update");
    assert_eq!(calls, 0);
}

#[test]
fn restoring_a_settled_scene_by_clone_from_allocates_nothing() {
    let mut scenes: Vec<_> = NARROW_PHASES
        .map(|narrow| settled_scene(plane::faithful(BroadPhaseCollider::default(), narrow)))
        .into_iter()
        .chain([settled_precise_scene()])
        .collect();
    for simulator in &mut scenes {
        let mut kept = simulator.clone();
        let mut calls_of = || {
            let before = kept.clone();
            (0..5).for_each(|_| simulator.update(0.01));
            let there = calls(|| kept.clone_from(simulator));
            there + calls(|| simulator.clone_from(&before))
        };
        calls_of();
        assert_eq!((0..10).map(|_| calls_of()).sum::<usize>(), 0, "{:?}", simulator.methods());
    }
}

#[test]
fn bodies_on_and_in_a_one_way_geom_allocate_nothing() {
    let mut simulator = simulator_with(300.0, Methods::PRECISE);
    simulator.set_sleep_enabled(false);
    let (_, platform) = add_floor(&mut simulator, (400.0, 40.0), v(0.0, 0.0));
    simulator.set_one_way(platform, Some(v(0.0, -1.0))).unwrap();
    for at in 0..5 {
        add_box(&mut simulator, (20.0, 20.0), v(at as f32 * 30.0, -30.0));
        let (inside, _) = add_circle(&mut simulator, 5.0, 12, v(at as f32 * 30.0, 5.0));
        simulator[inside].set_ignore_gravity(true);
        simulator[inside].set_linear_velocity(v(3.0, 0.0));
    }
    (0..60).for_each(|_| simulator.update(0.01));
    assert_eq!((0..300).map(|_| calls(|| simulator.update(0.01))).sum::<usize>(), 0);
    assert!(simulator.arbiter_count() >= 5);
}

#[test]
fn a_bridge_with_the_precise_set_allocates_nothing() {
    let mut simulator = PhysicsSimulator::new(v(0.0, 300.0)).unwrap();
    simulator.set_methods(Methods::PRECISE).unwrap();
    // A sleeping world makes no step.
    simulator.set_sleep_enabled(false);
    let mut joints = Vec::new();
    let mut planks: Vec<farseer_core::BodyId> = Vec::new();
    for at in 0..10 {
        let left = 16.0 * at as f32;
        let mut plank = farseer_core::Body::new();
        plank.set_position(v(left + 8.0, 0.0));
        let plank = simulator.create_body(plank);
        simulator.add(plank).unwrap();
        joints.push(match planks.last() {
            None => JointFactory::create_fixed_revolute_joint(&mut simulator, plank, v(left, 0.0)),
            Some(&last) => JointFactory::create_revolute_joint(&mut simulator, last, plank, v(left, 0.0)),
        });
        if let Some(&last) = planks.last() {
            joints.push(JointFactory::create_angle_limit_joint(&mut simulator, last, plank, -0.2, 0.2));
        }
        planks.push(plank);
    }
    joints.push(JointFactory::create_fixed_revolute_joint(&mut simulator, planks[9], v(160.0, 0.0)));
    joints.into_iter().for_each(|joint| simulator.add(joint.unwrap()).unwrap());
    (0..100).for_each(|_| simulator.update(0.01));
    assert_eq!((0..100).map(|_| calls(|| simulator.update(0.01))).sum::<usize>(), 0);
}

/// A chain of this many links of 16 length units from a point of the world, level at first. Its bodies have no geoms.
fn add_chain(simulator: &mut PhysicsSimulator, links: usize) -> Vec<JointId> {
    let mut last = None;
    (0..links)
        .map(|at| {
            let left = 16.0 * at as f32;
            let mut link = farseer_core::Body::new();
            link.set_position(v(left + 8.0, 0.0));
            let link = simulator.create_body(link);
            simulator.add(link).unwrap();
            let joint = match last.replace(link) {
                None => JointFactory::create_fixed_revolute_joint_in(simulator, link, v(left, 0.0)),
                Some(last) => JointFactory::create_revolute_joint_in(simulator, last, link, v(left, 0.0)),
            };
            joint.unwrap()
        })
        .collect()
}

/// Calls of the allocator in the last of three seconds, in which one island is solved by this solver throughout.
fn calls_with_solver(mut simulator: PhysicsSimulator, solver: IslandSolver) -> usize {
    simulator.set_sleep_enabled(false);
    let mut sum = 0;
    for step in 0..180 {
        let calls = calls(|| simulator.update(1.0 / 60.0));
        if step >= 120 {
            assert!(
                simulator.islands().iter().any(|island| island.method == solver && island.cost.joints > 0)
            );
            sum += calls;
        }
    }
    sum
}

#[test]
fn a_swinging_articulation_allocates_nothing() {
    let mut simulator = plane::precise(300.0);
    add_chain(&mut simulator, 10);
    assert_eq!(calls_with_solver(simulator, IslandSolver::Articulated), 0);
}

#[test]
fn joints_of_the_iterative_solver_allocate_nothing() {
    let mut simulator = plane::precise(300.0);
    simulator.set_solver_choice(SolverChoice::Iterative);
    plane::add_level_floor(&mut simulator);
    for joint in add_chain(&mut simulator, 10) {
        simulator.joint_mut(joint).unwrap().set_softness(0.1).unwrap();
    }
    assert_eq!(calls_with_solver(simulator, IslandSolver::Iterative), 0);
}

#[test]
fn callbacks_of_the_precise_set_allocate_nothing() {
    let mut simulator = settled_precise_scene();
    (0..2).for_each(|_| simulator.update_with(0.01, &mut Silent));
    assert_eq!((0..100).map(|_| calls(|| simulator.update_with(0.01, &mut Silent))).sum::<usize>(), 0);
}

/// A handler that makes edits without effect in every callback.
struct Silent;
impl EventHandler for Silent {
    fn on_body_updated(&mut self, context: &mut Context<'_>, body: farseer_core::BodyId) {
        let body = context.body_mut(body).unwrap();
        body.set_angular_velocity(body.angular_velocity());
    }
}

/// Sets the friction and restitution of every collision.
struct Setting;
impl EventHandler for Setting {
    fn on_collision(
        &mut self,
        context: &mut Context<'_>,
        _: farseer_core::GeomId,
        _: farseer_core::GeomId,
        _: &mut Vec<farseer_core::Contact>,
    ) -> bool {
        context.set_contact_friction(0.7).is_ok() && context.set_contact_tangent_speed(0.0).is_ok()
    }
}

#[test]
fn callbacks_that_set_friction_allocate_nothing() {
    for mut simulator in [settled_scene(Default::default()), settled_precise_scene()] {
        (0..2).for_each(|_| simulator.update_with(0.01, &mut Setting));
        assert_eq!((0..100).map(|_| calls(|| simulator.update_with(0.01, &mut Setting))).sum::<usize>(), 0);
    }
}

#[test]
fn callbacks_allocate_nothing() {
    for methods in faithful_methods() {
        let mut simulator = settled_scene(methods);
        simulator.update_with(0.01, &mut Silent);
        let calls: usize = (0..100).map(|_| calls(|| simulator.update_with(0.01, &mut Silent))).sum();
        assert_eq!(calls, 0, "{methods:?}");
    }
}

#[test]
fn edits_and_their_reports_allocate_nothing_after_the_first() {
    let mut simulator = settled_scene(Default::default());
    let body = simulator.body_list()[5];
    let mut edit = || {
        let position = simulator[body].position();
        simulator[body].set_position(position);
        simulator[body].apply_force(v(1.0, 0.0));
        simulator[body].set_angular_velocity(f32::NAN);
        simulator.update(0.01);
    };
    edit();
    let calls: usize = (0..50).map(|_| calls(&mut edit)).sum();
    assert_eq!(calls, 0);
}

/// New pairs are found while bodies move, but the memory of earlier ones is reused.
#[test]
fn a_lively_scene_allocates_less_over_time() {
    for methods in faithful_methods() {
        let mut simulator = lively_scene(methods, 11);
        let mut calls_of =
            |updates: usize| -> usize { (0..updates).map(|_| calls(|| simulator.update(0.01))).sum() };
        let (first, _, last) = (calls_of(300), calls_of(600), calls_of(300));
        assert!(last * 10 <= first, "{methods:?}: {first} calls at first, {last} at last");
    }
}

/// Every kind of joint, spring and controller, some updates old. No body comes to rest here: a wave carries everything.
fn linked_scene() -> PhysicsSimulator {
    let mut simulator = simulator_with(100.0, Default::default());
    let s = &mut simulator;
    let (bodies, geoms): (Vec<_>, Vec<_>) =
        (0..24).map(|i| add_circle(s, 5.0, 12, v(i as f32 * 12.0, 0.0))).unzip();
    add_joints(s, &bodies);
    add_springs(s, &bodies);
    let mut wave = WaveController::new(v(-300.0, 50.0), 900.0, 200.0, 20).unwrap();
    wave.set_frequency(0.02).unwrap();
    wave.set_wave_generator_step(1.0).unwrap();
    wave.set_wave_generator_max(5.0).unwrap();
    wave.set_wave_generator_min(-5.0).unwrap();
    let wave = s.create_controller(wave).unwrap();
    let mut fluid =
        FluidDragController::new(FluidContainerRef::Wave(wave), 0.02, 1.0, 0.5, v(0.0, 100.0)).unwrap();
    geoms.iter().for_each(|&geom| fluid.add_geom(geom).unwrap());
    let gravity = GravityController::new(vec![bodies[20]], vec![v(50.0, 50.0)], 100.0, 300.0).unwrap();
    s.add(wave).unwrap();
    let controllers = [
        fluid.into(),
        gravity.into(),
        InactivityController::new().into(),
        ScalingController::new(0.01, 0.03).unwrap().into(),
        Controller::user_defined(),
    ];
    for controller in controllers {
        let controller = s.create_controller(controller).unwrap();
        s.add(controller).unwrap();
    }
    (0..1500).for_each(|_| simulator.update(0.01));
    simulator
}

fn add_joints(s: &mut PhysicsSimulator, b: &[BodyId]) {
    let o = v(0.0, 0.0);
    JointFactory::create_fixed_revolute_joint_in(s, b[0], o).unwrap();
    JointFactory::create_revolute_joint_in(s, b[0], b[1], v(6.0, 0.0)).unwrap();
    JointFactory::create_pin_joint_in(s, b[1], o, b[2], o).unwrap();
    JointFactory::create_slider_joint_in(s, b[2], o, b[3], o, 8.0, 14.0).unwrap();
    JointFactory::create_weld_joint_in(s, b[3], b[4], v(42.0, 0.0)).unwrap();
    JointFactory::create_angle_joint_in(s, b[5], b[6]).unwrap();
    JointFactory::create_angle_limit_joint_in(s, b[6], b[7], -0.2, 0.2).unwrap();
    JointFactory::create_fixed_angle_joint_in(s, b[8]).unwrap();
    JointFactory::create_fixed_angle_limit_joint_in(s, b[9], -0.2, 0.2).unwrap();
}

fn add_springs(s: &mut PhysicsSimulator, b: &[BodyId]) {
    let o = v(0.0, 0.0);
    SpringFactory::create_fixed_linear_spring_in(s, b[12], o, v(100.0, 0.0), 50.0, 5.0).unwrap();
    SpringFactory::create_linear_spring_in(s, b[12], o, b[13], o, 50.0, 5.0).unwrap();
    SpringFactory::create_angle_spring_in(s, b[12], b[13], 50.0, 5.0).unwrap();
    SpringFactory::create_fixed_angle_spring_in(s, b[14], 50.0, 5.0).unwrap();
}

#[test]
fn an_update_with_joints_springs_and_controllers_allocates_nothing() {
    let mut simulator = linked_scene();
    let counts =
        [simulator.joint_list().len(), simulator.spring_list().len(), simulator.controller_list().len()];
    assert_eq!(counts, [9, 4, 6]);
    let calls: usize = (0..300).map(|_| calls(|| simulator.update(0.01))).sum();
    assert_eq!(calls, 0);
    assert!(plane::is_finite(&simulator) && simulator.contact_count() > 0);
}

#[test]
fn callbacks_of_joints_and_springs_allocate_nothing() {
    #[derive(Default)]
    struct Told {
        joints: usize,
        springs: usize,
    }
    impl EventHandler for Told {
        fn handles_joint_updates(&self) -> bool {
            true
        }
        fn on_joint_updated(&mut self, context: &mut Context<'_>, joint: JointId) {
            self.joints += 1;
            let body = context.joint(joint).unwrap().body1();
            let body = context.body_mut(body).unwrap();
            body.set_angular_velocity(body.angular_velocity());
        }
        fn handles_spring_updates(&self) -> bool {
            true
        }
        fn on_spring_updated(&mut self, context: &mut Context<'_>, spring: SpringId) {
            self.springs += 1;
            let body = context.spring(spring).unwrap().body1();
            let body = context.body_mut(body).unwrap();
            body.set_angular_velocity(body.angular_velocity());
        }
    }
    let mut simulator = linked_scene();
    let mut told = Told::default();
    simulator.update_with(0.01, &mut told);
    let calls: usize = (0..100).map(|_| calls(|| simulator.update_with(0.01, &mut told))).sum();
    assert_eq!(calls, 0);
    assert!(told.joints > 1000 && told.springs > 100, "{} {}", told.joints, told.springs);
}

#[test]
fn queries_of_a_settled_scene_allocate_nothing() {
    let mut simulator = settled_scene(Default::default());
    let mut interpolation = BodyInterpolation::new();
    interpolation.remember(&simulator);
    let mut hits = 0;
    for _ in 0..10 {
        simulator.update(0.01);
        let calls = calls(|| {
            interpolation.remember(&simulator);
            hits += usize::from(simulator.ray_cast(v(-290.0, 285.0), v(290.0, 290.0)).is_some());
        });
        assert_eq!(calls, 0);
    }
    let body = simulator.body_list()[5];
    assert!(hits == 10 && interpolation.pose(body, 0.5).is_some(), "{hits} hits");
}

/// Balls and crates on the ground and on a platform, and balls on top of crates, at several depths.
fn settled_scene_with_depth() -> twohalf::TwoHalfPhysicsSimulator {
    let mut simulator = depth::simulator();
    let place = twohalf::Vector3::new(200.0, 0.0, 200.0);
    twohalf::Platform::new(&mut simulator, 600.0, 30.0, 60.0, place, None).unwrap();
    for i in 0..40u8 {
        let place = [f32::from(i % 8) * 60.0, 35.0, f32::from(i / 8) * 50.0];
        if i % 2 == 0 {
            depth::ball(&mut simulator, 10.0, place);
        } else {
            depth::crate_box(&mut simulator, [20.0, 16.0], place);
            depth::ball(&mut simulator, 8.0, [place[0], place[1] + 20.0, place[2]]);
        }
    }
    (0..600).for_each(|_| simulator.update(depth::DT));
    simulator
}

#[test]
fn walking_and_jumping_among_crates_allocates_nothing() {
    let gravity = twohalf::Vector2::new(0.0, 900.0);
    let mut simulator = twohalf::TwoHalfPhysicsSimulator::with_gravity(600, gravity).unwrap();
    let place = twohalf::Vector3::new(0.0, 0.0, 200.0);
    twohalf::Platform::new(&mut simulator, 100.0, 6.0, 60.0, place, None).unwrap();
    for at in 0..5 {
        depth::crate_box(&mut simulator, [20.0, 16.0], [60.0 + 21.0 * at as f32, 20.0, 200.0]);
    }
    let figure = depth::crate_box(&mut simulator, [20.0, 40.0], [40.0, 40.0, 200.0]);
    simulator.body_mut(figure).unwrap().core_mut().set_moment_of_inertia(1e20).unwrap();
    let mut walker = twohalf::CharacterController::new(twohalf::CharacterSettings::default());
    // Updates whose pairs change may allocate.
    let mut walk = |steps: usize| -> usize {
        (0..steps)
            .map(|step| {
                let x = if step % 200 < 100 { 60.0 } else { -60.0 };
                let wish = twohalf::MoveInput { x, jump: step % 70 == 0, ..twohalf::MoveInput::default() };
                let calls = calls(|| simulator.walk(figure, &mut walker, wish, depth::DT).unwrap());
                simulator.update(depth::DT);
                calls
            })
            .sum()
    };
    walk(1000);
    assert_eq!(walk(400), 0);
}

#[test]
fn an_update_of_ropes_that_swing_and_of_rafts_in_a_current_allocates_nothing() {
    let mut simulator = twohalf::TwoHalfPhysicsSimulator::new(600).unwrap();
    let pool = twohalf::Region::new([-500.0, 0.0, -500.0], [500.0, 100.0, 500.0]).unwrap();
    let flow = twohalf::Vector3::new(0.0, 0.0, 0.1);
    simulator.add_field(twohalf::Fluid { flow, ..twohalf::Fluid::water(pool, 1e-3) }).unwrap();
    simulator.add_field(twohalf::Well { strength: 1e4, ..twohalf::Well::new([0.0, 300.0, 0.0]) }).unwrap();
    depth::crate_box(&mut simulator, [40.0, 20.0], [200.0, 90.0, 0.0]);
    depth::ball(&mut simulator, 10.0, [-200.0, 90.0, 0.0]);
    let ends = [0.0, 90.0].map(|x| twohalf_factories::RopeEnd::Fixed([x, 300.0, x]));
    let rope = twohalf_factories::Rope::new(ends[0], ends[1]).length(150.0);
    let rope = twohalf_factories::spawn_rope(&mut simulator, rope).unwrap();
    depth::throw(&mut simulator, rope.bodies[5], [0.0, 0.0, 5.0]);
    (0..300).for_each(|_| simulator.update(depth::DT));
    assert!(!simulator.is_asleep(rope.bodies[5]));
    assert_eq!(calls(|| (0..100).for_each(|_| simulator.update(depth::DT))), 0);
}

#[test]
fn an_update_of_a_settled_scene_with_depth_allocates_nothing() {
    struct Silent;
    impl twohalf::EventHandler for Silent {}
    let mut simulator = settled_scene_with_depth();
    let counters = simulator.counters();
    assert!(counters.ground_contacts == 32 && counters.pairs_touching == 28, "{counters:?}");
    let calls = calls(|| {
        (0..100).for_each(|_| simulator.update(depth::DT));
        (0..100).for_each(|_| simulator.update_with(depth::DT, &mut Silent));
    });
    assert_eq!(calls, 0);
}

#[test]
fn swinging_and_pressed_doors_allocate_nothing() {
    use twohalf_factories::{SwingDoor, spawn_swing_door};
    depth::with_scheme(twohalf::DepthScheme::Precise, || {
        let mut simulator = settled_scene_with_depth();
        let door = |z: f32| SwingDoor::new([60.0, 0.0, z], [100.0, 60.0, 6.0]).damping(0.0);
        let [free, pressed] = [800.0, 1100.0].map(|z| spawn_swing_door(&mut simulator, door(z)).unwrap());
        simulator.platform_mut(free).unwrap().set_angular_velocity(3.0).unwrap();
        let crate_box = depth::crate_box(&mut simulator, [20.0, 16.0], [140.0, 20.0, 1080.0]);
        let mut swing = |updates: usize| {
            for _ in 0..updates {
                simulator.body_mut(crate_box).unwrap().set_velocity3d([0.0, 0.0, 10.0].into());
                simulator.update(depth::DT);
            }
        };
        swing(150);
        assert_eq!(calls(|| swing(100)), 0);
        let turning = [free, pressed].map(|id| simulator.platform(id).unwrap().angular_velocity());
        assert!(turning.iter().all(|&turning| turning != 0.0), "{turning:?}");
    });
}

#[test]
fn crush_monitored_stopped_and_slowed_bodies_allocate_nothing() {
    depth::with_scheme(twohalf::DepthScheme::Precise, || {
        let mut simulator = settled_scene_with_depth();
        simulator.set_sleep_enabled(false);
        for (at, body) in simulator.body_list().to_vec().into_iter().enumerate() {
            simulator.set_crush_tolerance(body, Some(0.5)).unwrap();
            match at % 8 {
                0 => simulator.set_time_scale(body, 0.0).unwrap(),
                1 => simulator.set_time_scale(body, 0.5).unwrap(),
                _ => (),
            }
        }
        (0..200).for_each(|_| simulator.update(depth::DT));
        assert_eq!(calls(|| (0..100).for_each(|_| simulator.update(depth::DT))), 0);
    });
}

#[test]
fn a_character_that_walks_jumps_and_rides_allocates_nothing_after_the_first_moves() {
    let mut simulator = PhysicsSimulator::precise([0.0, 900.0]).unwrap();
    let add = |simulator: &mut PhysicsSimulator, body, size: [f32; 2]| {
        simulator.add_body(body, [GeomBuilder::rectangle(size[0], size[1])]).unwrap().0
    };
    add(&mut simulator, BodyBuilder::fixed().position([0.0, 10.0]), [2000.0, 20.0]);
    for i in 0..10 {
        add(&mut simulator, BodyBuilder::fixed().position([40.0 * i as f32 - 200.0, 3.0]), [20.0, 20.0]);
    }
    let lift = add(&mut simulator, BodyBuilder::kinematic().position([0.0, -50.0]), [60.0, 10.0]);
    let shape = GeomBuilder::capsule(60.0, 12.0);
    let mut mover = CharacterMover::new(&shape, [0.0, -100.0], MoverOptions::default()).unwrap();
    let mut calls_of = |from: usize, to: usize| -> usize {
        let mut count = 0;
        for step in from..to {
            let sign = if step % 160 < 80 { 1.0 } else { -1.0 };
            simulator[lift].set_linear_velocity_y(40.0 * sign);
            simulator.update(1.0 / 60.0);
            let input = MoverInput { x: 150.0 * sign, jump: step % 50 < 10, drop: false };
            count += calls(|| _ = mover.update(&mut simulator, input, 1.0 / 60.0).unwrap());
        }
        count
    };
    assert!(calls_of(0, 320) > 0, "the first moves fill the memory");
    assert_eq!(calls_of(320, 960), 0);
}
