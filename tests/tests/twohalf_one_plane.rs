//! With everything at one depth and nothing on the ground, the 2.5D engine is the 2D engine to the bit.

mod common;

use common::golden_scene;
use conformance::run::Run;
use twohalf::TwoHalfPhysicsSimulator;

/// Scenes without script, for every broad and narrow phase.
const SCENES: [&str; 16] = [
    "box_drop_flat",
    "box_drop_tilted",
    "broad_brute_force",
    "broad_selective_sweep",
    "broad_spatial_hash",
    "broad_sweep_and_prune",
    "circle_roll_20",
    "concave_star",
    "cradle",
    "ellipses",
    "mass_ratio_up",
    "multi_geom_sat",
    "pile_050",
    "pile_100_sap",
    "pyramid_06_aligned",
    "stack_10",
];

#[test]
fn in_one_plane_every_bit_is_that_of_the_2d_engine() {
    for name in SCENES {
        let scene = golden_scene(name);
        assert!(scene.script.is_empty(), "{name} has a script");
        let mut core = Run::build(&scene).unwrap_or_else(|error| panic!("{error}")).simulator().clone();
        let mut simulator = TwoHalfPhysicsSimulator::from_core(600, 90, core.clone()).unwrap();
        let mut touched = false;
        for step in 0..scene.steps.min(400) {
            core.update(scene.dt);
            simulator.update(scene.dt);
            touched |= core.contact_count() > 0;
            for &id in core.body_list() {
                assert_eq!(bits(&core[id]), bits(&simulator.core()[id]), "{name}, step {step}");
            }
        }
        assert!(touched, "nothing touches in {name}");
        let [expected, saved] = [&core, simulator.core()].map(|core| serde_json::to_string(core).unwrap());
        assert!(expected == saved, "{name}: the saved states differ");
    }
}

fn bits(body: &twohalf::farseer_core::Body) -> [u32; 6] {
    let (position, velocity) = (body.position(), body.linear_velocity());
    [position.x, position.y, body.rotation(), velocity.x, velocity.y, body.angular_velocity()].map(f32::to_bits)
}
