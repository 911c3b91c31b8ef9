//! Scenes in the 2D engine of this workspace.

use crate::method::{Built, Effort, Family, Mapped, Method, Setting, mapped};
use crate::world::{BodyState, World};
use conformance::run::Run;
use conformance::scene::{BroadPhase, NarrowPhase, Scene};
use farseer_core::math::Vector2;
use farseer_core::{BodyId, Methods, PhysicsSimulator};

/// A scene in [`PhysicsSimulator`], without the log that a run keeps: a measured step does what a game's does.
#[derive(Debug)]
pub struct FarseerWorld {
    simulator: PhysicsSimulator,
    bodies: Vec<BodyId>,
}

impl FarseerWorld {
    /// Builds a scene.
    ///
    /// # Errors
    ///
    /// When the scene cannot be built, or has a script, which no engine but this would play.
    pub fn new(scene: &Scene) -> Result<Self, String> {
        if !scene.script.is_empty() {
            return Err("the scene has a script".to_owned());
        }
        let mut run = Run::build(scene).map_err(|error| error.to_string())?;
        let bodies = run.bodies().to_vec();
        let empty = PhysicsSimulator::new(Vector2::zeros()).map_err(|error| error.to_string())?;
        Ok(FarseerWorld { simulator: std::mem::replace(run.simulator_mut(), empty), bodies })
    }

    /// A simulator that is built already, and its bodies in their order.
    pub fn with_bodies(simulator: PhysicsSimulator, bodies: Vec<BodyId>) -> Self {
        FarseerWorld { simulator, bodies }
    }

    /// The simulator.
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

/// The methods of this workspace, the original's default first.
pub fn our_methods() -> Vec<Method> {
    let method = Method {
        name: "Farseer, distance grid",
        family: Family::Ours,
        is_broad_phase_variant: false,
        sleeps: false,
        // The original's default iterations (behaviour chapter 06).
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
    // Neither do the peers sleep where it is measured what a step costs, and what it leaves.
    world.set_sleep_enabled(false);
    Ok(Box::new(world))
}

/// Substeps as of the peers.
fn precise_settings(effort: Effort) -> Vec<Setting> {
    let quick = [(1.0 / 30.0, 4), (1.0 / 60.0, 2), (1.0 / 60.0, 4), (1.0 / 60.0, 8), (1.0 / 240.0, 4)];
    let full = [(0.016, 4), (0.01, 4), (1.0 / 120.0, 4), (1.0 / 60.0, 16)];
    let more = if effort == Effort::Full { &full[..] } else { &[] };
    let fixed = quick.iter().chain(more).map(|&(dt, passes)| Setting::fixed(dt, passes));
    fixed.chain([Setting::jitter(1.0 / 60.0, 4)]).collect()
}

/// The steps on a map in s: the usual one, that of games which read whole milliseconds, and a short one.
pub(crate) const STEPS: [f32; 3] = [1.0 / 60.0, 0.016, 1.0 / 200.0];
/// In the table of first failures are the usual setting and the most careful one.
const IN_TABLE: [Setting; 2] = [Setting::fixed(STEPS[0], 5), Setting::fixed(STEPS[2], 40)];

/// The columns of the original's default methods: more than others have.
fn all_mapped() -> Vec<Mapped> {
    let settings = STEPS.into_iter().flat_map(|dt| [5, 10, 20, 40].map(|passes| Setting::fixed(dt, passes)));
    mapped(settings, &IN_TABLE)
}

fn few_mapped() -> Vec<Mapped> {
    let settings =
        [STEPS[0], STEPS[2]].into_iter().flat_map(|dt| [5, 40].map(|passes| Setting::fixed(dt, passes)));
    mapped(settings, &IN_TABLE)
}

/// Steps that games take, each with the original's default iterations; fewer iterations at the longest and the usual
/// step, more at the usual one and, since a hard scene needs both, at the shorter ones.
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
