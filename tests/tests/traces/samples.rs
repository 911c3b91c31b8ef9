//! The original's sample scenes against its recordings (behaviour chapter 16, part E).

use conformance::samples::{
    CENTRE, DT, Grenade, SAMPLES, SampleScene, ball, map_outline, sample, splat_outline,
};
use conformance::trace::hash::Fnv;
use farseer_core::math::Vector2;
use farseer_core::{BodyId, PhysicsSimulator};

/// Hash of all bodies: position, rotation, velocities, in list order.
fn hash(simulator: &PhysicsSimulator) -> u64 {
    let mut hash = Fnv::EMPTY;
    for &body in simulator.body_list() {
        let body = &simulator[body];
        let (position, velocity) = (body.position(), body.linear_velocity());
        for number in
            [position.x, position.y, body.rotation(), velocity.x, velocity.y, body.angular_velocity()]
        {
            hash.word(number.to_bits());
        }
    }
    hash.finish()
}

/// Numbers of bodies, geoms, joints, springs and controllers.
fn counts(simulator: &PhysicsSimulator) -> [usize; 5] {
    [
        simulator.body_list().len(),
        simulator.geom_list().len(),
        simulator.joint_list().len(),
        simulator.spring_list().len(),
        simulator.controller_list().len(),
    ]
}

/// A sample after a number of steps.
fn after(name: &str, steps: u32) -> SampleScene {
    let mut scene = (sample(name).unwrap().build)().unwrap();
    run(&mut scene, steps);
    scene
}

fn run(scene: &mut SampleScene, steps: u32) {
    for _ in 0..steps {
        scene.step().unwrap();
    }
}

/// The recording of a sample.
struct Record {
    name: &'static str,
    counts: [usize; 5],
    /// Numbers of steps, and the hashes after them.
    hashes: &'static [(u32, u64)],
}

#[rustfmt::skip]
const RECORDS: &[Record] = &[
    Record { name: "Simple 1", counts: [2, 4, 0, 0, 0], hashes: &[(1, 0xD4A4_1B00_9067_0A85), (60, 0x7F4B_78A6_1397_688E), (200, 0xC64E_2314_4D37_FC5F)] },
    Record { name: "Simple 2", counts: [3, 6, 0, 0, 0], hashes: &[(1, 0xF186_3F52_0D2A_1D48), (60, 0x9D9A_A9FA_FDD9_8B0A), (200, 0x0FCE_ECBA_F1F4_A84A)] },
    Record { name: "Simple 3", counts: [7, 16, 0, 0, 0], hashes: &[(1, 0x0732_2564_1446_B1C4), (60, 0x7B26_5E7B_BB1A_A30D), (200, 0x5D25_C4C7_882A_0AB6)] },
    Record { name: "Simple 4", counts: [107, 116, 0, 0, 0], hashes: &[(1, 0xBF02_099B_241F_F5DA), (60, 0x3DD2_0BC6_8BB0_A215), (200, 0x3029_ACF0_267A_A57E)] },
    Record { name: "Simple 5", counts: [162, 171, 0, 0, 0], hashes: &[(1, 0x584D_57ED_5895_5DF9), (60, 0xB3DB_6F92_BF26_E332), (200, 0x6AAA_4D41_B91E_2EAD)] },
    Record { name: "Simple 6", counts: [50, 63, 4, 45, 0], hashes: &[(1, 0x7EC3_1934_0E1F_5657), (60, 0x6DF5_D723_C705_5140), (200, 0x34FD_0930_F54D_9F3F)] },
    Record { name: "Simple 7", counts: [82, 91, 128, 0, 0], hashes: &[(1, 0x19F7_A3D7_2C1F_AD68), (60, 0x9D46_2D90_1E49_1F3F), (200, 0x3763_E90D_2E6D_1939)] },
    Record { name: "Simple 8", counts: [1602, 1611, 0, 0, 0], hashes: &[(1, 0xA431_C8F0_F442_F961), (60, 0x0867_E3DB_7D38_A4DA)] },
    Record { name: "Simple 9", counts: [16, 19, 9, 0, 0], hashes: &[(1, 0x84A9_FF0A_606C_DC0B), (60, 0x87BC_A1E8_EF1F_4903), (200, 0x2C06_572F_586A_2362)] },
    Record { name: "Simple 10", counts: [8, 11, 5, 0, 0], hashes: &[(1, 0xE0BA_C744_7EFA_931C), (60, 0x3F0D_00AB_9536_F0D8), (200, 0x1161_D9AF_913B_5306)] },
    Record { name: "Advanced 2", counts: [66, 69, 0, 0, 1], hashes: &[(1, 0x0B41_D5C5_BDAD_2708), (60, 0x036F_5066_AC84_BF8F), (200, 0xADEB_449A_5E7E_AAA7)] },
    Record { name: "Advanced 3", counts: [3, 6, 0, 0, 0], hashes: &[(1, 0x488C_F730_2655_722C), (60, 0xE725_B787_7FB3_FAB8), (200, 0x2E34_0C1C_CFEA_F6B5)] },
    Record { name: "Advanced 4", counts: [53, 56, 32, 20, 0], hashes: &[(1, 0xB442_0035_EB79_B260), (60, 0xD591_D5E9_D4A2_47E7), (200, 0x4061_8DC6_2A60_590E)] },
    Record { name: "Advanced 5", counts: [29, 32, 26, 1, 0], hashes: &[(1, 0x6A4D_1765_0B1E_C968), (60, 0x4434_593F_00FC_6222), (200, 0x7443_302D_E051_CAC8)] },
    Record { name: "Advanced 6", counts: [106, 109, 0, 0, 0], hashes: &[(1, 0x9632_5782_E96E_1824), (60, 0xF704_4B5F_877F_A5B1), (200, 0xF2ED_598B_809B_D001)] },
    Record { name: "Advanced 9", counts: [7, 130, 0, 0, 0], hashes: &[(1, 0xB5F2_5023_3D40_D243), (60, 0x445E_EC6B_9EE9_7A90), (200, 0xC272_C34C_D165_187A)] },
    Record { name: "Water", counts: [12, 15, 0, 0, 1], hashes: &[(1, 0x0F84_887A_4FF4_D481), (60, 0x73B1_5D09_F83E_9FB4), (200, 0x4EE1_28D4_680C_B471)] },
];

fn matches_the_record(name: &str) {
    let record = RECORDS.iter().find(|record| record.name == name).unwrap();
    let mut scene = after(name, 0);
    let mut step = 0;
    let mut found = Vec::new();
    for &(due, expected) in record.hashes {
        run(&mut scene, due - step);
        step = due;
        if due == 1 {
            assert_eq!(
                counts(scene.simulator()),
                record.counts,
                "{name}: bodies, geoms, joints, springs, controllers"
            );
        }
        found.push((due, hash(scene.simulator()), expected));
    }
    let wrong: Vec<_> = found.iter().filter(|(_, found, expected)| found != expected).collect();
    assert!(wrong.is_empty(), "{name}: step, found and recorded hash: {wrong:X?}");
}

macro_rules! records {
    ($($test:ident: $name:literal;)*) => {$(
        #[test]
        fn $test() {
            matches_the_record($name);
        }
    )*};
}

records! {
    a_single_body_is_as_recorded: "Simple 1";
    two_bodies_with_geom_is_as_recorded: "Simple 2";
    multiple_geometries_and_static_bodies_is_as_recorded: "Simple 3";
    stacked_objects_is_as_recorded: "Simple 4";
    collision_categories_is_as_recorded: "Simple 5";
    linear_and_angular_springs_is_as_recorded: "Simple 6";
    dynamic_angle_joints_is_as_recorded: "Simple 7";
    broad_phase_collision_stress_test_is_as_recorded: "Simple 8";
    ragdoll_is_as_recorded: "Simple 9";
    weld_joint_and_gears_is_as_recorded: "Simple 10";
    inactivity_controller_is_as_recorded: "Advanced 2";
    map_vertices_from_textures_is_as_recorded: "Advanced 3";
    chains_factory_is_as_recorded: "Advanced 4";
    path_factory_is_as_recorded: "Advanced 5";
    wind_and_explosions_is_as_recorded: "Advanced 6";
    auto_divide_geometry_with_sat_is_as_recorded: "Advanced 9";
    water_is_as_recorded: "Water";
}

/// Bits of the position of a body.
fn place(scene: &SampleScene, body: BodyId) -> [u32; 2] {
    let position = scene.simulator()[body].position();
    [position.x.to_bits(), position.y.to_bits()]
}

/// Bits of position and rotation of the body at an index in the list.
fn pose(scene: &SampleScene, index: usize) -> [u32; 3] {
    let body = scene.simulator().body_list()[index];
    let [x, y] = place(scene, body);
    [x, y, scene.simulator()[body].rotation().to_bits()]
}

fn bits(number: f32) -> u32 {
    number.to_bits()
}

#[test]
fn every_recorded_sample_is_tested() {
    let recorded: Vec<_> = RECORDS.iter().map(|record| record.name).collect();
    let built: Vec<_> =
        SAMPLES.iter().map(|sample| sample.name).filter(|&name| name != "Advanced 8").collect();
    assert_eq!(recorded, built);
}

#[test]
fn the_step_is_one_bit_longer_than_a_hundredth() {
    assert_eq!(DT.to_bits(), 0x3C23_D70B);
}

#[test]
fn the_agent_falls_through_the_obstacles_as_recorded() {
    let mut scene = after("Simple 3", 60);
    assert_eq!(pose(&scene, 0), [0x4400_2B86, 0x42E5_7BB1, 0x3DA7_62C9]);
    run(&mut scene, 140);
    assert_eq!(pose(&scene, 0), [0x440C_A7E7, 0x4338_3286, 0x3FCB_446B]);
}

#[test]
fn the_stack_settles_as_recorded() {
    let top = 104;
    let mut scene = after("Simple 4", 1);
    assert_eq!(pose(&scene, 0)[..2], [bits(218.0), 0x4431_0052]);
    assert_eq!(pose(&scene, top)[..2], [0x43F7_AAAB, 0x4319_569C]);
    run(&mut scene, 59);
    assert_eq!(scene.simulator().arbiter_count(), 14);
    run(&mut scene, 140);
    assert_eq!(scene.simulator().arbiter_count(), 158);
    assert_eq!(pose(&scene, 0), [0x435A_90F2, 0x4432_8016, 0x39CF_12CA]);
    assert_eq!(pose(&scene, top)[..2], [0x43F7_AAAB, 0x437D_C447]);
}

#[test]
fn the_ball_on_a_spring_and_the_agent_with_a_tail_move_as_recorded() {
    // Agent; platform, lever; platform, two levers, 20 blocks; platform; ball.
    let ball = 27;
    let mut scene = after("Simple 6", 60);
    assert_eq!(pose(&scene, ball)[..2], [bits(778.0), 0x4369_C18C]);
    run(&mut scene, 140);
    assert_eq!(pose(&scene, ball)[..2], [bits(778.0), 0x43C0_94BC]);
    assert_eq!(pose(&scene, 0), [0x4400_154E, 0x4333_C901, 0x40C9_0EC8]);
}

#[test]
fn the_first_spider_walks_as_recorded() {
    let mut scene = after("Simple 7", 1);
    assert_eq!(pose(&scene, 1), [0x43FF_F7D9, 0x42EE_1DAB, 0x40C8_62E6]);
    run(&mut scene, 199);
    assert_eq!(pose(&scene, 1), [0x4406_B0CC, 0x432C_EBBE, 0x3F39_8476]);
}

#[test]
fn spiders_bend_their_legs_at_the_401st_step() {
    let target = |scene: &SampleScene| {
        let joint = scene.simulator().joint_list()[1];
        scene.simulator().joint_as::<farseer_core::AngleJoint>(joint).unwrap().target_angle()
    };
    let mut scene = after("Simple 7", 1);
    assert_eq!(target(&scene), -0.2);
    run(&mut scene, 399);
    assert_eq!(target(&scene), -0.2);
    run(&mut scene, 1);
    assert_eq!(target(&scene), -1.2);
}

#[test]
fn torso_and_head_of_the_ragdoll_fall_as_recorded() {
    let mut scene = after("Simple 9", 1);
    assert_eq!(pose(&scene, 0), [bits(612.0), 0x42DC_76B6, 0x40C9_0FDB]);
    run(&mut scene, 199);
    assert_eq!(pose(&scene, 0), [0x4416_2AD2, 0x436A_C04A, 0x3D05_0E1D]);
    assert_eq!(pose(&scene, 1), [0x4419_E04C, 0x4340_7CD8, 0x3F81_AE82]);
}

#[test]
fn gear_and_welded_box_move_as_recorded() {
    let mut scene = after("Simple 10", 1);
    assert_eq!(pose(&scene, 2), [0x43F9_E48F, 0x4348_5E94, 0x3C52_FCD3]);
    run(&mut scene, 59);
    assert_eq!(pose(&scene, 2), [bits(500.0), bits(200.0), 0x3C9E_A3EB]);
    run(&mut scene, 140);
    assert_eq!(pose(&scene, 0)[..2], [bits(250.0), 0x43FA_7C93]);
}

#[test]
fn the_outline_of_the_map_has_the_recorded_measures() {
    let outline = map_outline();
    let centroid = outline.get_centroid();
    assert_eq!(outline.len(), 90);
    assert_eq!(outline.get_area(), 38708.0);
    assert_eq!([bits(centroid.x), bits(centroid.y)], [0x4308_DA19, 0x42DB_A8C3]);
    assert_eq!(bits(outline.get_moment_of_inertia().unwrap()), 0x4606_2F44);
}

#[test]
fn the_map_moves_as_recorded() {
    let scene = after("Advanced 3", 200);
    let map = scene.simulator().body_list()[0];
    assert_eq!(bits(scene.simulator()[map].moment_of_inertia()), 0x4727_BB15);
    assert_eq!(place(&scene, map), [0x43F0_0D22, bits(400.0)]);
}

#[test]
fn the_ends_of_the_chains_hang_as_recorded() {
    let scene = after("Advanced 4", 200);
    // The last of each chain: the first of the next is the body before a higher collision group.
    let simulator = scene.simulator();
    let group = |&body: &BodyId| simulator[simulator.geoms_of(body)[0]].collision_group();
    let last = |chain| simulator.body_list().iter().copied().rfind(|body| group(body) == chain).unwrap();
    assert_eq!(place(&scene, last(1)), [0x42FC_18B3, 0x4393_3285]);
    assert_eq!(place(&scene, last(2)), [0x4381_0FF9, 0x43D9_C97F]);
    assert_eq!(place(&scene, last(3)), [0x43C4_DCC7, 0x440C_27F6]);
    assert_eq!(place(&scene, last(4)), [0x43E5_2455, 0x43DA_24F1]);
    assert_eq!(place(&scene, last(5)), [0x4426_904A, 0x435D_7946]);
}

#[test]
fn the_first_wheel_rolls_as_recorded() {
    // The border and the second wheel come after it.
    let index = |scene: &SampleScene| scene.simulator().body_list().len() - 3;
    let mut scene = after("Advanced 5", 1);
    assert_eq!(pose(&scene, index(&scene)), [0x43AE_E396, 0x43FA_0C6D, 0x3A30_A9A2]);
    run(&mut scene, 199);
    assert_eq!(pose(&scene, index(&scene)), [0x43B7_C8FA, 0x4428_8C87, 0x409B_1248]);
}

/// Number of geoms that a line from the middle of the screen crosses, and the crossings.
fn crossings(x: f32, y: f32) -> (usize, Vec<[u32; 2]>) {
    let scene = after("Advanced 8", 1);
    let pairs = scene.simulator().line_segment_all_geoms_intersect(CENTRE, Vector2::new(x, y), false);
    let points = pairs.iter().flat_map(|pair| &pair.points);
    (pairs.len(), points.map(|point| [bits(point.x), bits(point.y)]).collect())
}

#[test]
fn lines_cross_geoms_as_recorded() {
    assert_eq!(crossings(725.0, 384.0), (1, vec![[bits(661.0), bits(384.0)]]));
    let circle = [[0x4425_529B, 0x43C0_EAF3], [0x4445_1D8B, 0x43C1_B316]];
    let (count, points) = crossings(1000.0, 390.0);
    assert_eq!(count, 2);
    assert_eq!(points, [circle[0], circle[1], [bits(986.0), 0x43C2_E9F8]]);
    let rectangle = [[bits(320.0), 0x43AC_6D5C], [0x4346_1862, bits(320.0)]];
    assert_eq!(crossings(100.0, 300.0), (1, rectangle.to_vec()));
    assert_eq!(crossings(512.0, 760.0), (1, vec![[bits(512.0), bits(730.0)]]));
}

#[test]
fn the_outline_of_the_blot_has_the_recorded_measures() {
    let outline = splat_outline();
    let centroid = outline.get_centroid();
    assert_eq!(outline.len(), 68);
    assert_eq!(outline.get_area(), 13545.0);
    assert_eq!([bits(centroid.x), bits(centroid.y)], [0x42D0_7FD2, 0x4285_3B20]);
    assert_eq!(bits(outline.get_moment_of_inertia().unwrap()), 0x4539_918A);
}

#[test]
fn the_blot_is_cut_into_the_recorded_pieces() {
    let scene = after("Advanced 9", 1);
    let simulator = scene.simulator();
    let blot = simulator.body_list()[0];
    let corners = |&geom| simulator.geom(geom).unwrap().local_vertices().len();
    let pieces: Vec<usize> = simulator.geoms_of(blot).iter().map(corners).collect();
    assert_eq!(pieces, [5, 7, 5, 6, 6, 7, 5, 7, 7, 4, 3, 4, 8, 10, 3, 3, 3, 3, 6, 3, 3]);
}

#[test]
fn with_sat_nothing_is_computed_for_the_grid_of_the_border() {
    let scene = after("Advanced 9", 1);
    let simulator = scene.simulator();
    let border = *simulator.body_list().last().unwrap();
    let cell = |&geom| simulator.geom(geom).unwrap().grid_cell_size();
    let cells: Vec<f32> = simulator.geoms_of(border).iter().map(cell).collect();
    assert_eq!(cells, [0.0, 0.0, 20.0, 20.0]);
}

#[test]
fn the_raft_floats_as_recorded() {
    let mut scene = after("Water", 1);
    assert_eq!(pose(&scene, 0)[..2], [bits(512.0), 0x43F9_DCCD]);
    run(&mut scene, 59);
    assert_eq!(pose(&scene, 0), [0x4400_004A, 0x4401_841B, 0x399F_4041]);
    run(&mut scene, 140);
    assert_eq!(pose(&scene, 0), [0x4400_34DE, 0x440B_CC60, 0x40C8_ADE3]);
}

#[test]
fn a_grenade_accelerates_near_bodies_at_the_300th_step_alone() {
    let mut scene = SampleScene::new(0.0).unwrap();
    let near = ball(&mut scene, CENTRE + Vector2::new(60.0, 0.0)).unwrap().0;
    let far = ball(&mut scene, CENTRE + Vector2::new(160.0, 0.0)).unwrap().0;
    scene.act(Grenade::new(CENTRE));
    run(&mut scene, 299);
    assert_eq!(scene.simulator()[near].linear_velocity(), Vector2::zeros());
    run(&mut scene, 1);
    // A force of 50000 for a step on a mass of 1.
    assert_eq!(scene.simulator()[near].linear_velocity(), Vector2::new(50_000.0 * DT, 0.0));
    assert_eq!(scene.simulator()[far].linear_velocity(), Vector2::zeros());
    let speed = scene.simulator()[near].linear_velocity();
    run(&mut scene, 1);
    assert!(scene.simulator()[near].linear_velocity().x <= speed.x);
}
