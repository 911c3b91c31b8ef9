//! With all bodies at one depth and none on the ground, the 2.5D engine is the 2D engine to the bit.

use conformance::golden;
use conformance::run::Run;
use conformance::scene::Scene;
use twohalf::TwoHalfPhysicsSimulator;
use twohalf::farseer_core::{Body, PhysicsSimulator};

/// Steps of each scene that are compared.
const STEPS: u32 = 250;

/// Names of the scenes of the repository that can run without their script's help.
fn scenes() -> Vec<Scene> {
    let mut paths: Vec<_> = std::fs::read_dir(golden::folder())
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.to_string_lossy().ends_with(".json.gz"))
        .collect();
    paths.sort();
    let scenes = paths.iter().map(|path| Scene::from_file(path).unwrap_or_else(|error| panic!("{error}")));
    scenes.filter(|scene| scene.script.is_empty()).collect()
}

#[test]
fn in_one_plane_every_bit_is_that_of_the_2d_engine() {
    let (mut compared, mut touching) = (0, 0);
    for scene in scenes() {
        // Some need a feature that the 2.5D engine leaves to the 2D engine, some have values that are refused.
        let Ok(run) = Run::build(&scene) else { continue };
        let mut core = run.simulator().clone();
        let mut simulator = TwoHalfPhysicsSimulator::from_core(600, 90, core.clone()).unwrap();
        let mut touched = false;
        for step in 0..scene.steps.min(STEPS) {
            core.update(scene.dt);
            simulator.update(scene.dt);
            touched |= core.contact_count() > 0;
            assert!(bits(&core) == bits(simulator.core()), "{}, step {step}", scene.name);
        }
        let [expected, saved] = [&core, simulator.core()].map(|core| serde_json::to_string(core).unwrap());
        assert!(expected == saved, "{}: the saved states differ", scene.name);
        compared += 1;
        touching += usize::from(touched);
    }
    assert!(compared >= 60 && touching >= 50, "{compared} compared, in {touching} of them something touches");
}

/// States of the bodies of a simulator, as bits.
fn bits(core: &PhysicsSimulator) -> Vec<[u32; 6]> {
    let of_body = |body: &Body| {
        let (position, velocity) = (body.position(), body.linear_velocity());
        [position.x, position.y, body.rotation(), velocity.x, velocity.y, body.angular_velocity()]
            .map(f32::to_bits)
    };
    core.body_list().iter().map(|&id| of_body(&core[id])).collect()
}
