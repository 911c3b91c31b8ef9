//! Snapshots: a restored simulator goes on with the same bits, and damaged bytes have no effect.

use conformance::fixtures::depth;
use conformance::fixtures::plane::{
    BROAD_PHASES, Game, Random, add_box, faithful, is_finite, lively_scene, simulator, state, v,
};
use farseer_core::snapshot::SnapshotFormat;
use farseer_core::{
    Aabb, AabbFluidContainer, BodyBuilder, BodyFactory, BodyId, ComplexFactory, Controller, ControllerId,
    ControllerKind, Error, FluidContainerRef, FluidDragController, GeomBuilder, GravityController,
    InactivityController, JointFactory, JointKind, LinkType, Methods, NarrowPhaseCollider, PhysicsSimulator,
    ScalingController, SpringFactory, SpringKind, WaveController,
};
use flate2::Crc;
use twohalf::TwoHalfPhysicsSimulator;

const GRID: NarrowPhaseCollider = NarrowPhaseCollider::DistanceGrid;

/// A scene with everything in it, some updates old.
fn everything(methods: Methods, updates: u32) -> (PhysicsSimulator, Game) {
    let mut simulator = lively_scene(methods, 5);
    add_joints(&mut simulator);
    add_springs(&mut simulator);
    add_rows(&mut simulator);
    add_controllers(&mut simulator);
    let mut game = Game::default();
    for _ in 0..updates {
        game.step(&mut simulator);
    }
    (simulator, game)
}

/// Circles in a row above the walls, without geoms.
fn row(simulator: &mut PhysicsSimulator, count: usize, y: f32) -> Vec<BodyId> {
    let body = |i: usize| {
        let body = BodyFactory::create_circle_body_in(simulator, 8.0, 1.0 + i as f32 * 0.25).unwrap();
        simulator[body].set_position(v(i as f32 * 20.0 - 150.0, y));
        body
    };
    (0..count).map(body).collect()
}

/// One joint of every kind.
fn add_joints(simulator: &mut PhysicsSimulator) {
    let b = row(simulator, 12, -250.0);
    let (origin, arm) = (v(0.0, 0.0), v(5.0, 0.0));
    JointFactory::create_revolute_joint_in(simulator, b[0], b[1], v(-140.0, -250.0)).unwrap();
    JointFactory::create_fixed_revolute_joint_in(simulator, b[0], v(-160.0, -255.0)).unwrap();
    JointFactory::create_pin_joint_in(simulator, b[1], arm, b[2], -arm).unwrap();
    JointFactory::create_slider_joint_in(simulator, b[2], arm, b[3], origin, 5.0, 25.0).unwrap();
    JointFactory::create_weld_joint_in(simulator, b[3], b[4], v(-80.0, -250.0)).unwrap();
    JointFactory::create_angle_joint_with_in(simulator, b[5], b[6], 0.1, 0.4).unwrap();
    JointFactory::create_angle_limit_joint_in(simulator, b[6], b[7], -0.2, 0.2).unwrap();
    JointFactory::create_fixed_angle_joint_in(simulator, b[8]).unwrap();
    JointFactory::create_fixed_angle_limit_joint_in(simulator, b[9], -0.5, 0.5).unwrap();
    let brittle = JointFactory::create_fixed_revolute_joint_in(simulator, b[10], v(60.0, -250.0)).unwrap();
    simulator[brittle].set_breakpoint(0.01).unwrap();
    simulator[b[9]].set_angular_velocity(3.0);
    simulator[b[7]].set_angular_velocity(-2.0);
}

/// One spring of every kind.
fn add_springs(simulator: &mut PhysicsSimulator) {
    let b = row(simulator, 6, -200.0);
    let (origin, arm) = (v(0.0, 0.0), v(0.0, 5.0));
    SpringFactory::create_linear_spring_in(simulator, b[0], arm, b[1], origin, 30.0, 1.0).unwrap();
    SpringFactory::create_fixed_linear_spring_in(simulator, b[0], -arm, v(-150.0, -260.0), 60.0, 2.0)
        .unwrap();
    SpringFactory::create_angle_spring_in(simulator, b[2], b[3], 900.0, 30.0).unwrap();
    SpringFactory::create_fixed_angle_spring_in(simulator, b[4], 900.0, 30.0).unwrap();
    simulator[b[2]].set_angular_velocity(4.0);
    simulator[b[4]].set_angular_velocity(-4.0);
}

/// A chain of every kind of link, and a track.
fn add_rows(simulator: &mut PhysicsSimulator) {
    let factory = ComplexFactory {
        max: 12.0,
        spring_constant: 300.0,
        damping_constant: 10.0,
        ..ComplexFactory::default()
    };
    let links = [LinkType::RevoluteJoint, LinkType::PinJoint, LinkType::SliderJoint, LinkType::LinearSpring];
    for (i, link) in links.into_iter().enumerate() {
        let start = v(i as f32 * 60.0 - 100.0, -300.0);
        let end = start + v(40.0, 90.0);
        let mut chain =
            factory.create_pinned_chain_in(simulator, start, end, 15.0, 6.0, 0.5, true, false, link).unwrap();
        chain.create_geoms_in(simulator, 7).unwrap();
    }
    let points = [v(-60.0, 40.0), v(60.0, 40.0), v(70.0, 80.0), v(-70.0, 80.0)];
    factory.create_track_in(simulator, &points, 16.0, 6.0, 1.0, true, 8, LinkType::RevoluteJoint).unwrap();
}

/// One controller of every kind, and of every kind of fluid.
fn add_controllers(simulator: &mut PhysicsSimulator) {
    let add = |simulator: &mut PhysicsSimulator, controller: Controller| -> ControllerId {
        let controller = simulator.create_controller(controller).unwrap();
        simulator.add(controller).unwrap();
        controller
    };
    simulator.process_added_and_removed();
    let geoms = simulator.geom_list().to_vec();
    let wave = WaveController::new(v(-300.0, 250.0), 600.0, 60.0, 12).unwrap();
    let wave = add(simulator, wave.into());
    let basin = AabbFluidContainer::new(Aabb::new(v(-300.0, 150.0), v(0.0, 300.0))).unwrap();
    for container in [FluidContainerRef::Aabb(basin), FluidContainerRef::Wave(wave)] {
        let mut fluid = FluidDragController::new(container, 0.001, 1.0, 0.5, v(0.0, 200.0)).unwrap();
        for &geom in geoms.iter().skip(3).step_by(3) {
            fluid.add_geom(geom).unwrap();
        }
        add(simulator, fluid.into());
    }
    let heavy = simulator.body_list()[4];
    let gravity = GravityController::new(vec![heavy], vec![v(50.0, -100.0)], 500.0, 200.0).unwrap();
    add(simulator, gravity.into());
    add(simulator, InactivityController::new().into());
    add(simulator, ScalingController::new(0.01, 0.04).unwrap().into());
    add(simulator, Controller::user_defined());
    for &body in &simulator.body_list().to_vec()[5..9] {
        simulator[body].set_is_auto_idle(true);
    }
}

/// The contents of the scene, by name.
#[test]
fn the_scene_has_everything_in_it() {
    let (simulator, _) = everything(Methods::default(), 70);
    let name = |text: String| text.split('(').next().unwrap_or_default().to_owned();
    let mut kinds: Vec<String> = Vec::new();
    let (joints, springs) = (simulator.joint_list().iter(), simulator.spring_list().iter());
    kinds.extend(joints.map(|&joint| name(format!("{:?} joint", simulator[joint].kind()))));
    kinds.extend(springs.map(|&spring| name(format!("{:?} spring", simulator[spring].kind()))));
    let controllers = simulator.controller_list().iter();
    kinds.extend(controllers.map(|&id| name(format!("{:?}", simulator.controller(id).unwrap().kind()))));
    kinds.sort();
    kinds.dedup();
    // Nine joints; four springs, of which two kinds share their names with joints; five controllers and the game's.
    let expected = [
        "Angle",
        "AngleLimit",
        "FixedAngle",
        "FixedAngleLimit",
        "FixedLinear",
        "FixedRevolute",
        "FluidDrag",
        "Gravity",
        "Inactivity",
        "Linear",
        "Pin",
        "Revolute",
        "Scaling",
        "Slider",
        "UserDefined",
        "Wave",
        "Weld",
    ];
    assert_eq!(kinds, expected);
    let springs = simulator.spring_list().iter().filter(|&&spring| {
        matches!(simulator[spring].kind(), SpringKind::Angle(_) | SpringKind::FixedAngle(_))
    });
    assert_eq!(springs.count(), 2);
    let joints = simulator.joint_list().iter().map(|&joint| &simulator[joint]);
    let broken = joints.filter(|joint| !joint.enabled());
    assert_eq!(broken.filter(|joint| matches!(joint.kind(), JointKind::FixedRevolute(_))).count(), 1);
    assert!(simulator.contact_count() > 8, "{}", simulator.contact_count());
    assert!(is_finite(&simulator));
    let wet = |&id: &ControllerId| match simulator.controller(id).map(Controller::kind) {
        Some(ControllerKind::FluidDrag(fluid)) => fluid.geoms().count() > 0,
        _ => false,
    };
    assert_eq!(simulator.controller_list().iter().filter(|id| wet(id)).count(), 2);
}

#[test]
fn a_restored_simulator_goes_on_with_the_same_bits() {
    for methods in BROAD_PHASES.map(|broad| faithful(broad, GRID)).into_iter().chain([Methods::PRECISE]) {
        let (mut original, mut game) = everything(methods, 0);
        for updates in [0, 41, 37, 60] {
            for _ in 0..updates {
                game.step(&mut original);
            }
            let snapshot = original.snapshot();
            let mut restored = simulator(1.0);
            restored.restore(&snapshot).unwrap();
            assert!(restored.snapshot() == snapshot, "{methods:?}: the same bytes");
            let (mut original, mut game) = (original.clone(), game.clone());
            let mut same_game = game.clone();
            for update in 0..60 {
                game.step(&mut original);
                same_game.step(&mut restored);
                assert_eq!(state(&original), state(&restored), "{methods:?}, update {update}");
                assert_eq!(original.events(), restored.events());
            }
            assert!(original.snapshot() == restored.snapshot(), "{methods:?}: the same bytes later");
        }
    }
}

#[test]
fn a_simulator_goes_back_without_its_geoms_with_the_same_bits() {
    for methods in [Methods::default(), Methods::PRECISE] {
        let (simulator, _) = everything(methods, 60);
        let (moving, mut twin) = (simulator.snapshot_moving(), simulator.clone());
        assert!(moving.len() < simulator.snapshot().len(), "{methods:?}");
        (0..30).for_each(|_| twin.update(0.01));
        assert_ne!(twin.state_hash(), simulator.state_hash(), "{methods:?}");
        twin.restore_moving(&moving).unwrap();
        assert_eq!(twin.snapshot(), simulator.snapshot(), "{methods:?}");
        // Bits of the next updates, of events, too.
        let mut simulator = simulator;
        for update in 0..30 {
            simulator.update(0.01);
            twin.update(0.01);
            assert_eq!(twin.events(), simulator.events(), "{methods:?}, update {update}");
            assert_eq!(twin.snapshot(), simulator.snapshot(), "{methods:?}, update {update}");
        }
    }
}

#[test]
fn a_snapshot_without_geoms_is_refused_by_other_geoms() {
    let (mut simulator, _) = everything(Methods::PRECISE, 60);
    let moving = simulator.snapshot_moving();
    let refused = |simulator: &mut PhysicsSimulator, moving: &[u8]| {
        let before = simulator.snapshot();
        let error = simulator.restore_moving(moving).unwrap_err().to_string();
        assert!(simulator.snapshot() == before, "{error}");
        error
    };
    assert!(refused(&mut PhysicsSimulator::default(), &moving).contains("other geoms"));
    let whole = simulator.snapshot();
    assert!(refused(&mut simulator, &whole).contains("which `PhysicsSimulator::restore` reads"));
    let error = simulator.restore(&moving).unwrap_err().to_string();
    assert!(error.contains("which `PhysicsSimulator::restore_moving` reads"), "{error}");
    let recording = farseer_core::Recording::new(&simulator, 1).unwrap().to_bytes();
    assert!(refused(&mut simulator, &recording).contains("which `Recording::from_bytes` reads"));
    assert!(refused(&mut simulator, b"MyGame01").contains("not a snapshot of such"));
    for end in (0..moving.len()).step_by(997) {
        refused(&mut simulator, &moving[..end]);
    }
    let geom = simulator.geoms().next().unwrap();
    simulator.dispose(geom).unwrap();
    simulator.update(0.01);
    assert!(refused(&mut simulator, &moving).contains("other geoms"));
}

#[test]
fn a_snapshot_without_geoms_fits_a_simulator_of_the_same_calls_after_its_first_update() {
    let mut simulator = PhysicsSimulator::precise([0.0, 300.0]).unwrap();
    let floor = BodyBuilder::fixed().position([0.0, 20.0]);
    simulator.add_body(floor, [GeomBuilder::rectangle(400.0, 40.0)]).unwrap();
    for x in [-20.0, 0.0, 15.0] {
        let body = BodyBuilder::dynamic().position([x, -30.0 - x]);
        simulator.add_body(body, [GeomBuilder::rectangle(20.0, 20.0)]).unwrap();
    }
    let mut peer = simulator.clone();
    (0..20).for_each(|_| simulator.update(0.01));
    let moving = simulator.snapshot_moving();
    assert!(peer.restore_moving(&moving).is_err(), "its geoms wait for an update");
    peer.update(0.01);
    peer.restore_moving(&moving).unwrap();
    for _ in 0..30 {
        simulator.update(0.01);
        peer.update(0.01);
        assert_eq!(peer.state_hash(), simulator.state_hash());
    }
}

#[test]
fn edits_of_geoms_stay_when_the_rest_goes_back() {
    let (mut simulator, _) = everything(Methods::PRECISE, 60);
    let moving = simulator.snapshot_moving();
    let geom = simulator.geoms().next().unwrap();
    simulator[geom].set_friction_coefficient(0.123);
    simulator.update(0.01);
    simulator.restore_moving(&moving).unwrap();
    assert_eq!(simulator[geom].friction_coefficient(), 0.123);
    (0..30).for_each(|_| simulator.update(0.01));
}

#[test]
fn refused_arguments_of_geoms_are_in_a_snapshot_without_geoms() {
    let (mut simulator, _) = everything(Methods::PRECISE, 60);
    let geom = simulator.geoms().next().unwrap();
    simulator[geom].set_friction_coefficient(f32::NAN);
    let (moving, mut twin) = (simulator.snapshot_moving(), simulator.clone());
    twin.update(0.01);
    twin.restore_moving(&moving).unwrap();
    [&mut simulator, &mut twin].into_iter().for_each(|it| it.update(0.01));
    assert_eq!(twin.events(), simulator.events());
    assert!(twin.snapshot() == simulator.snapshot());
}

#[test]
fn pending_edits_are_in_the_snapshot() {
    for methods in [Methods::default(), Methods::PRECISE] {
        let (mut original, _) = everything(methods, 30);
        let (body, _) = add_box(&mut original, (10.0, 10.0), v(8.0, 1.0));
        original[body].apply_impulse(v(5.0, 5.0));
        let moved = original.body_list()[11];
        original[moved].set_position(v(3.0, 4.0));
        let joint = original.joint_list()[2];
        original.remove(joint).unwrap();
        let spring = original.spring_list()[1];
        original.dispose(spring).unwrap();
        let mut restored = PhysicsSimulator::default();
        restored.restore(&original.snapshot()).unwrap();
        for simulator in [&mut original, &mut restored] {
            simulator.update(0.01);
            assert!(
                simulator.is_listed(body)
                    && !simulator.is_listed(joint)
                    && simulator.spring(spring).is_none()
            );
        }
        assert_eq!(state(&original), state(&restored));
    }
}

/// A simulator that is to be left alone.
struct Untouched {
    simulator: PhysicsSimulator,
    before: Vec<u8>,
}

impl Untouched {
    fn new() -> Self {
        let mut simulator = simulator(100.0);
        add_box(&mut simulator, (10.0, 10.0), v(1.0, 2.0));
        simulator.update(0.01);
        let before = simulator.snapshot();
        Untouched { simulator, before }
    }

    #[track_caller]
    fn refuses(&mut self, bytes: &[u8]) -> Error {
        let error = self.simulator.restore(bytes).unwrap_err();
        assert!(self.simulator.snapshot() == self.before, "changed by a snapshot that it refused");
        error
    }
}

/// Damages a snapshot: bits, bytes, the length, the order.
fn mutate(bytes: &mut Vec<u8>, random: &mut Random) {
    if bytes.len() < 64 {
        bytes.push(1);
        return;
    }
    let (at, other) = (random.below(bytes.len()), random.below(bytes.len()));
    let run = at..(at + 1 + random.below(40)).min(bytes.len());
    match random.below(9) {
        0 => bytes[at] ^= 1 << random.below(8),
        1 => bytes[at] = random.next_u32() as u8,
        2 => bytes.swap(at, other),
        3 => bytes.truncate(at),
        4 => drop(bytes.drain(run)),
        5 => bytes.insert(at, random.next_u32() as u8),
        6 => bytes[run].fill(random.pick(&[0, 1, 0x7F, 0x80, 0xFF])),
        7 => bytes.extend((0..1 + random.below(9)).map(|_| random.next_u32() as u8)),
        _ => {
            let there = other.min(bytes.len() - run.len());
            bytes.copy_within(run, there);
        }
    }
}

#[test]
fn ten_thousand_mutated_snapshots_have_no_effect() {
    for methods in [Methods::default(), Methods::PRECISE] {
        let (source, _) = everything(methods, 70);
        let snapshot = source.snapshot();
        let mut random = Random::new(77);
        let mut untouched = Untouched::new();
        let mut unchanged = 0;
        for _ in 0..10_000 {
            let mut mutated = snapshot.clone();
            for _ in 0..1 + random.below(3) {
                mutate(&mut mutated, &mut random);
            }
            // Half of them are hit in the header, too.
            if random.below(2) == 0 && mutated.len() > 24 {
                let at = random.below(24);
                mutated[at] = random.next_u32() as u8;
            }
            if mutated == snapshot {
                unchanged += 1;
                let mut restored = PhysicsSimulator::default();
                restored.restore(&mutated).unwrap();
                assert!(restored.snapshot() == snapshot);
            } else {
                untouched.refuses(&mutated);
            }
        }
        assert!(unchanged < 500, "{unchanged} of 10,000 mutations changed nothing");
    }
}

#[test]
fn a_snapshot_cut_short_is_refused_at_every_length() {
    // Small, since its square of a length is computed here.
    let mut source = simulator(10.0);
    add_box(&mut source, (10.0, 10.0), v(0.0, 0.0));
    source.update(0.01);
    let snapshot = source.snapshot();
    let mut untouched = Untouched::new();
    for length in 0..snapshot.len() {
        assert!(matches!(untouched.refuses(&snapshot[..length]), Error::DamagedSave { .. }), "{length}");
    }
    untouched.simulator.restore(&snapshot).unwrap();
}

/// A container around any content, with a checksum that is right.
fn contain(magic: &[u8; 8], version: u32, content: &[u8]) -> Vec<u8> {
    let mut crc = Crc::new();
    let length = (content.len() as u64).to_le_bytes();
    for part in [magic, &version.to_le_bytes()[..], &length, content] {
        crc.update(part);
    }
    [magic, &version.to_le_bytes()[..], &crc.sum().to_le_bytes(), &length, content].concat()
}

/// Version of the present layout.
const VERSION: u32 = 21;
const MAGIC: &[u8; 8] = b"Farseer2";

#[test]
fn the_container_is_as_documented() {
    let snapshot = simulator(10.0).snapshot();
    assert!(contain(MAGIC, VERSION, &snapshot[24..]) == snapshot);
}

#[test]
fn each_kind_of_damage_has_its_reason() {
    let snapshot = simulator(10.0).snapshot();
    let content = &snapshot[24..];
    let mut untouched = Untouched::new();
    let mut reason = |bytes: &[u8]| match untouched.refuses(bytes) {
        Error::DamagedSave { reason } => reason,
        other => panic!("{other}"),
    };
    let foreign = reason(b"\x89PNG\r\n\x1a\n and some more");
    assert!(foreign.contains("not a snapshot"), "{foreign}");
    assert_eq!([reason(b""), reason(&contain(b"TwoHalf1", VERSION, content))], [foreign, foreign]);
    assert!(reason(&snapshot[..20]).contains("cut short"));
    assert!(reason(&snapshot[..snapshot.len() - 1]).contains("cut short"));
    assert!(reason(&[&snapshot[..], &[0]].concat()).contains("longer than it says"));
    let mut altered = snapshot.clone();
    *altered.last_mut().unwrap() ^= 1;
    assert!(reason(&altered).contains("checksum"));
    assert!(reason(&contain(MAGIC, VERSION, &[content, &[0]].concat())).contains("longer than it should be"));
    assert!(reason(&contain(MAGIC, VERSION, &content[..content.len() - 1])).contains("cannot be read"));
    assert_eq!(
        untouched.refuses(&contain(MAGIC, 1, content)),
        Error::UnknownSaveVersion { found: 1, known: VERSION }
    );
}

/// Such bytes are made on purpose. Even then no call panics, hangs or makes a number infinite.
#[test]
fn forged_contents_are_refused_or_run() {
    for methods in [Methods::default(), Methods::PRECISE] {
        let (source, _) = everything(methods, 70);
        let content = source.snapshot().split_off(24);
        let mut random = Random::new(99);
        let (mut refused, mut accepted) = (0, 0);
        for round in 0..800 {
            let mut forged = content.clone();
            mutate(&mut forged, &mut random);
            let mut simulator = PhysicsSimulator::default();
            if simulator.restore(&contain(MAGIC, VERSION, &forged)).is_err() {
                refused += 1;
                continue;
            }
            accepted += 1;
            // Any number of iterations is legitimate, but the greatest takes too long.
            simulator.set_iterations(simulator.iterations().min(10));
            for _ in 0..2 {
                simulator.update(0.01);
            }
            assert!(is_finite(&simulator), "round {round}");
        }
        assert!(refused > 200 && accepted > 50, "{refused} refused, {accepted} accepted");
    }
}

/// Lengths of lists in the content are not believed before their elements are there.
#[test]
fn enormous_lengths_are_refused() {
    for methods in [Methods::default(), Methods::PRECISE] {
        let (source, _) = everything(methods, 10);
        let content = source.snapshot().split_off(24);
        let mut untouched = Untouched::new();
        let mut refused = 0;
        for at in (0..content.len()).step_by(251) {
            let mut forged = content.clone();
            forged.splice(at..at + 1, [0xFF, 0xFF, 0xFF, 0xFF, 0x0F]);
            if PhysicsSimulator::default().restore(&contain(MAGIC, VERSION, &forged)).is_err() {
                untouched.refuses(&contain(MAGIC, VERSION, &forged));
                refused += 1;
            }
        }
        assert!(refused > 50, "{refused}");
        for content in [vec![0xFF; 64], vec![0xFF; 100_000], Vec::new()] {
            untouched.refuses(&contain(MAGIC, VERSION, &content));
        }
    }
}

#[test]
fn any_value_can_be_put_in_a_container() {
    let format = SnapshotFormat { magic: *b"MyGame01", version: 3 };
    let value = (vec![1_u32, 2], Some(-0.0_f32), String::from("level"));
    let bytes = format.write(&value);
    let read: (Vec<u32>, Option<f32>, String) = format.read(&bytes).unwrap();
    assert_eq!((read.1.map(f32::to_bits), &read.0, &read.2), (Some(0x8000_0000), &value.0, &value.2));
    let newer = SnapshotFormat { version: 4, ..format };
    assert_eq!(newer.read::<u8>(&bytes), Err(Error::UnknownSaveVersion { found: 3, known: 4 }));
}

#[test]
fn a_simulator_with_depth_is_restored_and_refuses_damage() {
    let (mut original, _) = depth::busy_scene();
    depth::run(&mut original, 100);
    let snapshot = original.snapshot();
    let mut restored = TwoHalfPhysicsSimulator::new(480).unwrap();
    restored.restore(&snapshot).unwrap();
    for _ in 0..100 {
        depth::run(&mut original, 1);
        depth::run(&mut restored, 1);
        assert!(original.snapshot() == restored.snapshot());
    }
    let before = restored.snapshot();
    let mut random = Random::new(3);
    for _ in 0..500 {
        let mut mutated = snapshot.clone();
        mutate(&mut mutated, &mut random);
        assert!(mutated == snapshot || restored.restore(&mutated).is_err());
    }
    assert!(restored.restore(&simulator(1.0).snapshot()).is_err());
    assert!(restored.snapshot() == before);
}
