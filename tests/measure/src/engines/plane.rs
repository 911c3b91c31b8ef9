//! Runs 2D scenes in the 2D engine of this workspace.

use crate::method::{Built, Effort, Family, Mapped, Method, Setting, mapped};
use crate::world::{BodyState, World};
use conformance::run::Run;
use conformance::scene::{BroadPhase, NarrowPhase, Scene};
use farseer_core::math::Vector2;
use farseer_core::{BodyId, Methods, PhysicsSimulator};

/// A 2D scene in [`PhysicsSimulator`], without the log that a conformance run keeps: a measured step costs what it costs in
/// a game.
#[derive(Debug)]
pub struct FarseerWorld {
    simulator: PhysicsSimulator,
    bodies: Vec<BodyId>,
}

impl FarseerWorld {
    /// Builds a scene in the 2D engine.
    ///
    /// # Errors
    ///
    /// The scene cannot be built, or has a script, which no other engine could play.
    pub fn new(scene: &Scene) -> Result<Self, String> {
        if !scene.script.is_empty() {
            return Err("the scene has a script".to_owned());
        }
        let mut run = Run::build(scene).map_err(|error| error.to_string())?;
        let bodies = run.bodies().to_vec();
        let empty = PhysicsSimulator::new(Vector2::zeros()).map_err(|error| error.to_string())?;
        Ok(FarseerWorld { simulator: std::mem::replace(run.simulator_mut(), empty), bodies })
    }

    /// Wraps a simulator that is built already. `bodies` are its bodies in the order of the scene.
    pub fn with_bodies(simulator: PhysicsSimulator, bodies: Vec<BodyId>) -> Self {
        FarseerWorld { simulator, bodies }
    }

    /// Returns the simulator of the 2D engine.
    pub fn simulator(&self) -> &PhysicsSimulator {
        &self.simulator
    }
}

impl World for FarseerWorld {
    fn step(&mut self, dt: f32) {
        self.simulator.update(dt);
    }

    fn body(&self, index: usize) -> BodyState {
        BodyState::of(&self.simulator[self.bodies[index]])
    }

    fn body_count(&self) -> usize {
        self.bodies.len()
    }

    fn set_velocity(&mut self, index: usize, velocity: [f64; 2], angular_velocity: f64) {
        let body = &mut self.simulator[self.bodies[index]];
        body.set_linear_velocity(vector(velocity));
        body.set_angular_velocity(angular_velocity as f32);
    }

    fn apply_impulse(&mut self, index: usize, impulse: [f64; 2]) {
        self.simulator[self.bodies[index]].apply_impulse(vector(impulse));
    }

    fn teleport(&mut self, index: usize, position: [f64; 2], angle: f64) {
        let body = &mut self.simulator[self.bodies[index]];
        body.set_position(vector(position));
        body.set_rotation(angle as f32);
    }

    fn set_sleep_enabled(&mut self, is_enabled: bool) {
        self.simulator.set_sleep_enabled(is_enabled);
    }

    fn is_asleep(&self, index: usize) -> bool {
        self.simulator.is_asleep(self.bodies[index])
    }
}

fn vector(value: [f64; 2]) -> Vector2 {
    Vector2::new(value[0] as f32, value[1] as f32)
}

/// Returns the methods of this workspace's 2D engine; the default of the original engine is the first.
pub fn our_methods() -> Vec<Method> {
    let method = Method {
        name: "Farseer, distance grid",
        family: Family::Ours,
        is_broad_phase_variant: false,
        sleeps: false,
        // 5 iterations is the default of the original engine (behaviour chapter 06).
        recommended: Setting::fixed(1.0 / 60.0, 5),
        settings,
        mapped: |effort| if effort == Effort::Full { all_mapped() } else { few_mapped() },
        build: |scene, setting| build(scene, setting, NarrowPhase::DistanceGrid, BroadPhase::SelectiveSweep),
    };
    let broad_phase_variant = Method {
        is_broad_phase_variant: true,
        mapped: |_| mapped([5, 20].map(|passes| Setting::fixed(STEPS[0], passes)), &[]),
        ..method
    };
    vec![
        method,
        Method {
            name: "Farseer, SAT",
            mapped: |_| few_mapped(),
            build: |scene, setting| build(scene, setting, NarrowPhase::Sat, BroadPhase::SelectiveSweep),
            ..method
        },
        Method {
            name: "Farseer, grid, sweep and prune",
            build: |scene, setting| {
                build(scene, setting, NarrowPhase::DistanceGrid, BroadPhase::SweepAndPrune)
            },
            ..broad_phase_variant
        },
        Method {
            name: "Farseer, grid, spatial hash",
            build: |scene, setting| build(scene, setting, NarrowPhase::DistanceGrid, BroadPhase::SpatialHash),
            ..broad_phase_variant
        },
        Method {
            name: "Precise",
            sleeps: true,
            recommended: Setting::fixed(1.0 / 60.0, 4),
            settings: precise_settings,
            mapped: |_| mapped(precise_settings(Effort::Quick), &[Setting::fixed(STEPS[0], 4)]),
            build: build_precise,
            ..method
        },
    ]
}

fn build(scene: &Scene, setting: Setting, narrow_phase: NarrowPhase, broad_phase: BroadPhase) -> Built {
    let mut scene = scene.clone();
    scene.simulator.narrow_phase = Some(narrow_phase);
    scene.simulator.broad_phase = Some(broad_phase);
    let passes = i32::try_from(setting.passes).map_err(|_| format!("{} iterations", setting.passes))?;
    scene.simulator.solver.iterations = Some(passes);
    Ok(Box::new(FarseerWorld::new(&scene)?))
}

fn build_precise(scene: &Scene, setting: Setting) -> Built {
    let mut scene = scene.clone();
    scene.simulator.narrow_phase = Some(NarrowPhase::Sat);
    let mut world = FarseerWorld::new(&scene)?;
    world.simulator.set_iterations(i32::try_from(setting.passes).map_err(|error| error.to_string())?);
    world.simulator.set_methods(Methods::PRECISE).map_err(|error| error.to_string())?;
    // Sleep is disabled in other engines, too, when the cost and the error of a step are measured.
    world.set_sleep_enabled(false);
    Ok(Box::new(world))
}

/// Returns the settings of a chart's line for the precise set, with the numbers of substeps that other engines are run
/// with.
fn precise_settings(effort: Effort) -> Vec<Setting> {
    let quick = [(1.0 / 30.0, 4), (1.0 / 60.0, 2), (1.0 / 60.0, 4), (1.0 / 60.0, 8), (1.0 / 240.0, 4)];
    let full = [(0.016, 4), (0.01, 4), (1.0 / 120.0, 4), (1.0 / 60.0, 16)];
    let more = if effort == Effort::Full { &full[..] } else { &[] };
    let fixed = quick.iter().chain(more).map(|&(dt, passes)| Setting::fixed(dt, passes));
    fixed.chain([Setting::jitter(1.0 / 60.0, 4)]).collect()
}

/// Steps of a stability map in s: the usual one, the one of games that read integer milliseconds, and a short one.
pub(crate) const STEPS: [f32; 3] = [1.0 / 60.0, 0.016, 1.0 / 200.0];
/// Settings that the table of first failures shows: the usual one (1/60 s, 5 iterations) and the most careful one (1/200 s,
/// 40 iterations).
const IN_TABLE: [Setting; 2] = [Setting::fixed(STEPS[0], 5), Setting::fixed(STEPS[2], 40)];

/// Returns the columns of a stability map for the default methods of the original engine; other methods have fewer columns.
fn all_mapped() -> Vec<Mapped> {
    let settings = STEPS.into_iter().flat_map(|dt| [5, 10, 20, 40].map(|passes| Setting::fixed(dt, passes)));
    mapped(settings, &IN_TABLE)
}

fn few_mapped() -> Vec<Mapped> {
    let settings =
        [STEPS[0], STEPS[2]].into_iter().flat_map(|dt| [5, 40].map(|passes| Setting::fixed(dt, passes)));
    mapped(settings, &IN_TABLE)
}

/// Returns the settings of a chart's line: steps that games take, each with the original's default of 5 iterations. The
/// longest and the usual step also have fewer, the usual and the shorter steps more iterations; hard scenes need short
/// steps and many iterations together.
fn settings(effort: Effort) -> Vec<Setting> {
    let quick = vec![
        Setting::fixed(1.0 / 30.0, 2),
        Setting::fixed(1.0 / 30.0, 5),
        Setting::fixed(1.0 / 60.0, 2),
        Setting::fixed(1.0 / 60.0, 5),
        Setting::fixed(1.0 / 60.0, 20),
        Setting::fixed(1.0 / 120.0, 5),
        Setting::fixed(1.0 / 240.0, 10),
        Setting::jitter(1.0 / 60.0, 5),
    ];
    if effort == Effort::Quick {
        return quick;
    }
    let full = [
        Setting::fixed(0.016, 5),
        Setting::fixed(0.01, 5),
        Setting::fixed(1.0 / 60.0, 10),
        Setting::fixed(1.0 / 60.0, 40),
        Setting::fixed(1.0 / 120.0, 20),
        Setting::fixed(1.0 / 240.0, 5),
        Setting::fixed(1.0 / 240.0, 40),
    ];
    quick.into_iter().chain(full).collect()
}
