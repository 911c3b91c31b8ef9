//! No small input takes minutes or gigabytes: limits of a simulator's cost, and cheap cases that must stay cheap.

use conformance::fixtures::plane::{
    BROAD_PHASES, add_box, add_circle, add_floor, faithful, simulator, simulator_with, state, v,
};
use conformance::run::Run;
use conformance::scene::Scene;
use farseer_core::{
    Body, BroadPhaseCollider, Context, Error, Event, EventHandler, GeomId, GeomPlacement, JointFactory,
    Limits, Methods, NarrowPhaseCollider, ObjectId, PhysicsSimulator, SavedSimulator, Vertices,
};
use serde_json::{Value, json};
use std::time::Instant;
use twohalf::{SavedTwoHalfSimulator, TwoHalfPhysicsSimulator};

/// Seconds for a call that would take minutes without limits, and takes a tenth of a second.
const DEADLINE_SECONDS: f32 = 20.0;

/// Number of nodes times vertices of the grid of a square of 100 with cells of 1.
const SQUARE_WORK: u64 = 101 * 101 * 4;

fn limited(grid_work: u64, total_grid_work: u64) -> Limits {
    Limits { grid_work, total_grid_work, ..Limits::default() }
}

fn corners(size: f32) -> Vertices {
    Vertices::create_simple_rectangle(size, size).unwrap()
}

/// A square of about 100, with cells of 1. Squares of different `shift` have different grids of equal work.
fn add_square(simulator: &mut PhysicsSimulator, shift: u8) -> Result<GeomId, Error> {
    let body = simulator.create_body(Body::new());
    let square = corners(100.0 - f32::from(shift) * 0.001);
    simulator.create_geom(body, square, GeomPlacement::with_grid_size(1.0))
}

/// A simulator with this number of different grids.
fn squares(count: u8) -> PhysicsSimulator {
    let mut simulator = simulator(0.0);
    for shift in 0..count {
        add_square(&mut simulator, shift).unwrap();
    }
    simulator
}

fn exceeded(limit: &'static str, needed: u64, allowed: u64) -> Error {
    Error::LimitExceeded { limit, needed, allowed }
}

#[test]
fn a_grid_beyond_its_limit_is_refused_without_effect() {
    let mut simulator = simulator(0.0);
    simulator.set_limits(limited(SQUARE_WORK - 1, u64::MAX));
    let body = simulator.create_body(Body::new());
    let before = simulator.snapshot();
    let refused = simulator.create_geom(body, corners(100.0), GeomPlacement::with_grid_size(1.0));
    assert_eq!(refused, Err(exceeded("grid_work", SQUARE_WORK, SQUARE_WORK - 1)));
    assert!(simulator.snapshot() == before);
    simulator.set_limits(limited(SQUARE_WORK, u64::MAX));
    simulator.create_geom(body, corners(100.0), GeomPlacement::with_grid_size(1.0)).unwrap();
}

/// Both would take minutes.
#[test]
fn absurd_grids_are_refused_without_being_made() {
    let mut simulator = simulator(0.0);
    let body = simulator.create_body(Body::new());
    let circle = Vertices::create_circle(50.0, 5000).unwrap();
    let refused = simulator.create_geom(body, circle.clone(), GeomPlacement::with_grid_size(0.0125));
    assert!(matches!(refused, Err(Error::LimitExceeded { limit: "grid_work", .. })), "{refused:?}");
    let refused = farseer_core::DistanceGrid::new(circle, 0.0125);
    assert!(matches!(refused, Err(Error::LimitExceeded { limit: "grid_work", .. })));
    let mut thin = Vertices::create_ellipse(1000.0, 0.1, 5000).unwrap();
    thin[0].y += 0.001;
    let refused = simulator.create_geom(body, thin, GeomPlacement::default());
    assert!(matches!(refused, Err(Error::LimitExceeded { limit: "grid_work", .. })), "{refused:?}");
}

#[test]
fn all_grids_together_stay_within_their_limit() {
    let mut simulator = simulator(0.0);
    simulator.set_limits(limited(SQUARE_WORK, SQUARE_WORK * 2));
    let first = add_square(&mut simulator, 0).unwrap();
    add_square(&mut simulator, 1).unwrap();
    let refused = add_square(&mut simulator, 2);
    assert_eq!(refused, Err(exceeded("total_grid_work", SQUARE_WORK * 3, SQUARE_WORK * 2)));
    for _ in 0..10 {
        add_square(&mut simulator, 1).expect("equal grids are one");
    }
    simulator.dispose(first).unwrap();
    add_square(&mut simulator, 2).expect("a grid that is gone does not count");
    assert!(add_square(&mut simulator, 0).is_err());
}

#[test]
fn churn_does_not_exhaust_the_limit_of_all_grids() {
    let mut simulator = simulator(0.0);
    simulator.set_limits(limited(SQUARE_WORK, SQUARE_WORK * 3));
    for round in 0..200 {
        let geom = add_square(&mut simulator, round).unwrap();
        simulator.dispose(geom).unwrap();
        simulator.update(0.01);
    }
}

/// A refusal must not depend on other simulators.
#[test]
fn grids_that_only_a_clone_has_count_as_if_there_were_no_clone() {
    let outcomes = [true, false].map(|keeps_clone| {
        let mut simulator = simulator(0.0);
        simulator.set_limits(limited(SQUARE_WORK, SQUARE_WORK * 2));
        let first = add_square(&mut simulator, 0).unwrap();
        add_square(&mut simulator, 1).unwrap();
        let clone = keeps_clone.then(|| simulator.clone());
        simulator.dispose(first).unwrap();
        let outcomes = [2, 0, 2, 1].map(|shift| add_square(&mut simulator, shift).is_ok());
        drop(clone);
        outcomes
    });
    assert_eq!(outcomes, [[true, false, true, true]; 2]);
}

/// The cost of ordinary games: the scenes that the original was recorded with.
#[test]
fn recorded_scenes_need_a_fiftieth_of_the_limits() {
    let files = std::fs::read_dir(conformance::golden::folder()).expect("the folder is there");
    let paths = files.map(|file| file.expect("it can be read").path());
    let (mut largest, mut largest_total) = (0, 0);
    for path in paths.filter(|path| path.to_string_lossy().ends_with(".json.gz")) {
        let scene = Scene::from_file(path).unwrap_or_else(|error| panic!("{error}"));
        let Ok(run) = Run::build(&scene) else { continue };
        let simulator = run.simulator();
        let grids = simulator.geoms().filter_map(|geom| simulator.geom(geom)?.distance_grid());
        let works: Vec<u64> = grids.map(|grid| (grid.nodes().len() * grid.outline().len()) as u64).collect();
        largest = works.iter().copied().fold(largest, u64::max);
        largest_total = largest_total.max(works.iter().sum::<u64>());
    }
    println!("one grid {largest}, all of a scene {largest_total}");
    assert!(largest > 0);
    assert!(largest * 50 < Limits::default().grid_work);
    assert!(largest_total * 50 < Limits::default().total_grid_work);
}

fn with_cells(simulator: &PhysicsSimulator, cell_size: f32) -> Value {
    let mut save = serde_json::to_value(simulator).unwrap();
    for slot in save["objects"]["geoms"]["entries"]["slots"].as_array_mut().unwrap() {
        slot["value"]["value"]["grid"]["cell_size"] = json!(cell_size);
    }
    save
}

#[test]
fn a_save_that_asks_for_absurd_grids_is_refused_without_making_them() {
    for count in [1, 8] {
        let save = with_cells(&squares(count), 100.0 / 8100.0);
        let refused = serde_json::from_value::<PhysicsSimulator>(save).expect_err("15 s and 254 MB for each");
        assert!(refused.to_string().starts_with("grid_work would be "), "{refused}");
    }
}

#[test]
fn all_grids_of_a_save_together_stay_within_the_limit() {
    let text = serde_json::to_string(&squares(8)).unwrap();
    let load = |limits| serde_json::from_str::<SavedSimulator>(&text).unwrap().load(limits);
    let refused = load(limited(SQUARE_WORK, SQUARE_WORK * 8 - 1)).expect_err("one too many");
    assert_eq!(refused, exceeded("total_grid_work", SQUARE_WORK * 8, SQUARE_WORK * 8 - 1));
    let limits = limited(SQUARE_WORK, SQUARE_WORK * 8);
    assert_eq!(load(limits).unwrap().limits(), limits);
}

#[test]
fn the_cells_of_a_save_are_those_it_had() {
    let grids = |simulator: &PhysicsSimulator| {
        let grid = |geom| simulator.geom(geom).unwrap().distance_grid().unwrap().clone();
        simulator.geoms().map(grid).collect::<Vec<_>>()
    };
    let source = squares(3);
    let mut restored = simulator(0.0);
    restored.restore(&source.snapshot()).unwrap();
    assert_eq!(grids(&restored), grids(&source));
}

#[test]
fn a_snapshot_beyond_the_limits_leaves_the_simulator_as_it_was() {
    let snapshot = squares(2).snapshot();
    let mut simulator = simulator(50.0);
    simulator.set_limits(limited(SQUARE_WORK, SQUARE_WORK));
    let before = simulator.snapshot();
    assert_eq!(simulator.restore(&snapshot), Err(exceeded("total_grid_work", SQUARE_WORK * 2, SQUARE_WORK)));
    assert!(simulator.snapshot() == before);
}

#[test]
fn limits_belong_to_the_simulator_and_not_to_its_state() {
    let limits = Limits { grid_work: SQUARE_WORK * 2, total_grid_work: SQUARE_WORK * 3, iterations: 7 };
    let mut simulator = squares(1);
    let unlimited = simulator.snapshot();
    simulator.set_limits(limits);
    assert!(simulator.snapshot() == unlimited, "they are not saved");
    assert_eq!(simulator.clone().limits(), limits);
    simulator.restore(&unlimited).unwrap();
    assert_eq!(simulator.limits(), limits);
    simulator.clear();
    assert_eq!(simulator.limits(), limits);
    let text = serde_json::to_string(&simulator).unwrap();
    let loaded: PhysicsSimulator = serde_json::from_str(&text).unwrap();
    assert_eq!(loaded.limits(), Limits::default());
}

#[test]
fn the_limits_of_a_25d_simulator_are_those_of_its_core() {
    let make = || TwoHalfPhysicsSimulator::from_core(480, 90, squares(2)).unwrap();
    let (mut simulator, source) = (make(), make());
    simulator.set_limits(limited(SQUARE_WORK, SQUARE_WORK));
    let refused = Err(exceeded("total_grid_work", SQUARE_WORK * 2, SQUARE_WORK).into());
    assert_eq!(simulator.restore(&source.snapshot()), refused);
    let limits = limited(SQUARE_WORK, SQUARE_WORK * 2);
    simulator.set_limits(limits);
    simulator.restore(&source.snapshot()).unwrap();
    assert_eq!((simulator.limits(), simulator.core().limits()), (limits, limits));
    let text = serde_json::to_string(&source).unwrap();
    let saved: SavedTwoHalfSimulator = serde_json::from_str(&text).unwrap();
    assert_eq!(saved.load(limits).unwrap().limits(), limits);
}

/// Three boxes over 600,000 cells each; each entry is about 7 bytes of the snapshot.
#[test]
fn the_cells_of_the_spatial_hash_are_bounded_together() {
    let hash = BroadPhaseCollider::SpatialHash { cell_size: 0.5, auto_adjust_cell_size: false };
    let pairs = [hash, BroadPhaseCollider::BruteForce].map(|broad| {
        let mut simulator = simulator_with(0.0, faithful(broad, NarrowPhaseCollider::Sat));
        for x in 0..3 {
            add_box(&mut simulator, (100.0, 100.0), v(x as f32 * 95.0, 0.0));
        }
        simulator.update(0.01);
        // The cells of one box, not of three.
        assert!(simulator.snapshot().len() < 1 << 20);
        simulator.arbiters().map(|arbiter| (arbiter.geom_a(), arbiter.geom_b())).collect::<Vec<_>>()
    });
    assert_eq!(pairs[0].len(), 2);
    let [mut hashed, all] = pairs;
    hashed.sort();
    assert_eq!(hashed, all, "what does not fit is met all the same");
}

struct AcceptsAll;

impl EventHandler for AcceptsAll {
    fn handles_broad_phase(&self) -> bool {
        true
    }

    fn on_broad_phase_collision(&mut self, _: &mut Context<'_>, _: GeomId, _: GeomId) -> bool {
        true
    }
}

/// A search of the list for every pair would be 5 * 10^10 comparisons.
#[test]
fn a_handler_that_accepts_every_pair_of_brute_force_makes_no_search_of_each() {
    let methods = faithful(BroadPhaseCollider::BruteForce, NarrowPhaseCollider::DistanceGrid);
    let mut simulator = simulator_with(0.0, methods);
    for x in 0..800 {
        add_circle(&mut simulator, 5.0, 4, v(x as f32 * 20.0, 0.0));
    }
    let start = Instant::now();
    simulator.update_with(0.01, &mut AcceptsAll);
    assert_eq!(simulator.counters().pairs_tested, 800 * 799 / 2);
    assert!(start.elapsed().as_secs_f32() < DEADLINE_SECONDS);
}

#[test]
fn an_update_without_constraints_makes_no_iterations() {
    let mut simulator = simulator(100.0);
    simulator.set_iterations(i32::MAX);
    simulator.update(0.01);
    add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    simulator.update(0.01);
    assert_eq!((simulator.counters().passes, simulator.iterations()), (0, i32::MAX));
}

#[test]
fn iterations_beyond_the_limit_are_not_made() {
    let run = |iterations, limit| {
        let mut simulator = simulator(100.0);
        simulator.set_iterations(iterations);
        simulator.set_limits(Limits { iterations: limit, ..Limits::default() });
        add_floor(&mut simulator, (200.0, 20.0), v(0.0, 100.0));
        add_box(&mut simulator, (20.0, 20.0), v(3.0, 81.0));
        (0..20).for_each(|_| simulator.update(0.01));
        (simulator.counters().passes, state(&simulator))
    };
    assert_eq!(run(i32::MAX, 7), run(7, 1000));
    assert_eq!(run(7, 1000).0, 7);
    assert_eq!(run(-1, 7).0, 0);
}

#[test]
fn a_single_joint_is_solved() {
    let mut simulator = simulator(100.0);
    let (one, _) = add_box(&mut simulator, (10.0, 10.0), v(0.0, 0.0));
    let (two, _) = add_box(&mut simulator, (10.0, 10.0), v(50.0, 0.0));
    JointFactory::create_pin_joint_in(&mut simulator, one, v(0.0, 0.0), two, v(0.0, 0.0)).unwrap();
    simulator.update(0.01);
    assert_eq!(simulator.counters().passes, 5);
}

#[test]
fn contacts_of_the_25d_engine_alone_are_solved() {
    let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, v(0.0, 100.0)).unwrap();
    simulator.set_depth_scheme(twohalf::DepthScheme::Faithful).unwrap();
    simulator.set_iterations(9);
    simulator.update(0.01);
    assert_eq!(simulator.core().counters().passes, 0);
    let body = twohalf_factories::TwoHalfBodyFactory::create_rectangle_body(&mut simulator, 20.0, 20.0, 1.0);
    let body = body.unwrap();
    let geom = twohalf_factories::TwoHalfGeomFactory::create_rectangle_geom(&mut simulator, body, 20.0, 20.0);
    let mut on_ground = simulator.body_mut(body).unwrap();
    on_ground.ground_mut().set_object_geom(geom.unwrap(), None).unwrap();
    on_ground.set_position3d(twohalf::Vector3::new(0.0, 0.0, 0.0));
    (0..10).for_each(|_| simulator.update(0.01));
    assert_eq!((simulator.counters().ground_contacts, simulator.core().counters().passes), (1, 9));
}

/// One scan of the list for each would be 2 * 10^10 comparisons.
#[test]
fn many_objects_leave_in_one_update() {
    for methods in [faithful(BroadPhaseCollider::BruteForce, NarrowPhaseCollider::Sat), Methods::PRECISE] {
        const COUNT: usize = 200_000;
        let mut simulator = simulator_with(0.0, methods);
        let outline = corners(10.0);
        let made: Vec<_> = (0..COUNT)
            .map(|_| {
                let body = simulator.create_body(Body::new());
                let geom = simulator.create_geom(body, outline.clone(), GeomPlacement::default()).unwrap();
                simulator.add(body).unwrap();
                simulator.add(geom).unwrap();
                (body, geom)
            })
            .collect();
        // No step: only addition and removal.
        simulator.update(0.0);
        let start = Instant::now();
        for &(body, geom) in made.iter().rev().skip(1) {
            simulator.remove(geom).unwrap();
            simulator.remove(body).unwrap();
        }
        simulator.update(0.0);
        assert!(start.elapsed().as_secs_f32() < DEADLINE_SECONDS);
        let (body, geom) = made[COUNT - 1];
        assert_eq!((simulator.body_list(), simulator.geom_list()), (&[body][..], &[geom][..]));
        let removed = simulator.events().iter().map(|event| match event {
            Event::Removed { object } => *object,
            other => panic!("{other:?}"),
        });
        let geoms = made.iter().rev().skip(1).map(|&(_, geom)| ObjectId::from(geom));
        let bodies = made.iter().rev().skip(1).map(|&(body, _)| ObjectId::from(body));
        assert!(removed.eq(geoms.chain(bodies)), "in the order of the calls");
    }
}

/// A look at all geoms of the body for each would be 4 * 10^10 comparisons.
#[test]
fn a_body_may_have_many_geoms() {
    for methods in [faithful(BroadPhaseCollider::BruteForce, NarrowPhaseCollider::Sat), Methods::PRECISE] {
        const COUNT: usize = 200_000;
        let mut simulator = simulator_with(0.0, methods);
        let (body, other) = (simulator.create_body(Body::new()), simulator.create_body(Body::new()));
        let outline = corners(10.0);
        let start = Instant::now();
        let create = |simulator: &mut PhysicsSimulator| {
            simulator.create_geom(body, outline.clone(), GeomPlacement::default()).unwrap()
        };
        for _ in 0..COUNT {
            create(&mut simulator);
        }
        let snapshot = simulator.snapshot();
        simulator.restore(&snapshot).unwrap();
        assert_eq!(simulator.geoms_of(body).len(), COUNT);
        simulator.dispose(body).unwrap();
        simulator.update(0.0);
        assert_eq!((simulator.geoms().count(), simulator.bodies().count()), (0, 1));
        assert!(simulator.body(other).is_some());
        assert!(start.elapsed().as_secs_f32() < DEADLINE_SECONDS);
    }
}

/// All broad phases with distance grids, and the precise set.
fn methods_of_grids() -> impl Iterator<Item = Methods> {
    let faithful = |broad| faithful(broad, NarrowPhaseCollider::DistanceGrid);
    BROAD_PHASES.into_iter().map(faithful).chain([Methods::PRECISE])
}

/// A floor that overlaps everything, and a box that is another one in every round.
fn churn(methods: Methods, mut round: impl FnMut(&mut PhysicsSimulator, usize)) {
    let mut simulator = simulator_with(100.0, methods);
    add_floor(&mut simulator, (200.0, 20.0), v(0.0, 100.0));
    add_box(&mut simulator, (20.0, 20.0), v(-50.0, 80.0));
    let mut lengths = [0; 2];
    for (length, rounds) in lengths.iter_mut().zip([0..1000, 1000..4000]) {
        for index in rounds {
            round(&mut simulator, index);
            simulator.update(0.01);
        }
        *length = simulator.snapshot().len();
    }
    // A swept list may be twice as long as it must be; numbers grow by a digit.
    assert!(lengths[1] < lengths[0] + 400, "{methods:?}: {lengths:?}");
}

#[test]
fn snapshots_do_not_grow_while_objects_come_and_go() {
    for methods in methods_of_grids() {
        let mut last = None;
        churn(methods, |simulator, index| {
            let (body, _) = add_box(simulator, (20.0, 20.0), v((index % 7) as f32 * 10.0, 82.0));
            last.replace(body).into_iter().for_each(|body| simulator.dispose(body).unwrap());
        });
    }
}

#[test]
fn snapshots_do_not_grow_while_an_object_is_used_again_and_again() {
    for methods in methods_of_grids() {
        let mut pooled = None;
        churn(methods, |simulator, index| {
            let (_, geom) = *pooled.get_or_insert_with(|| add_box(simulator, (20.0, 20.0), v(20.0, 82.0)));
            match index % 2 {
                0 => simulator.add(geom).unwrap(),
                _ => simulator.remove(geom).unwrap(),
            }
        });
    }
}

/// Lists are not compacted while no step is made.
#[test]
fn snapshots_do_not_grow_while_objects_come_and_go_in_a_pause() {
    for methods in methods_of_grids() {
        let mut last = None;
        churn(methods, |simulator, index| {
            simulator.set_enabled(false);
            let (body, _) = add_box(simulator, (20.0, 20.0), v((index % 7) as f32 * 10.0, 82.0));
            last.replace(body).into_iter().for_each(|body| simulator.dispose(body).unwrap());
        });
    }
}
