//! One scene in 2D and in 2.5D, as the thesis compared them: circles that fall into a pit, all at the same Z.

use crate::charts::ChartScene;
use crate::engines::plane::FarseerWorld;
use crate::method::{Built, Family, Method, Setting};
use crate::sweep::Point;
use crate::watch::{Watch, in_reach, worst};
use crate::world::{BodyState, World, distance};
use conformance::run::Run;
use conformance::scene::Scene;
use conformance::scenes::circles_in_a_pit;
use farseer_core::GeomPlacement;
use twohalf::{DepthScheme, TwoHalfPhysicsSimulator};

/// Name of the scene that is compared in 2D and in 2.5D.
pub const PLANES: &str = "pit_in_2d_and_2.5d";
/// The only setting of the comparison of 2D and 2.5D: 1/60 s with 5 iterations. The comparison is one of CPU time.
const SETTING: Setting = Setting::fixed(1.0 / 60.0, 5);

/// The comparison of 2D and 2.5D. Its error is the largest distance in px, at any time, of a circle from the position of
/// that circle in the 2D engine.
pub const PLANE_SCENE: ChartScene = ChartScene {
    name: PLANES,
    about: "Circles that fall into a pit, all at one depth, with and without the third axis.",
    // The numbers of circles in the thesis' comparison, and 2000.
    sizes: &[20, 40, 200, 2000],
    build: circles_in_a_pit,
    // The circles fall and come to rest.
    seconds: 5.0,
    watch: against_2d,
    error: "largest distance from the 2D engine's circles",
    unit: "px",
    // An error of less than a pixel is invisible.
    tolerance: 1.0,
    broad_phases_matter: false,
    peers_too: false,
};

/// Returns the three methods that are compared: the 2D engine, then the 2.5D engine with the faithful and with the thesis
/// scheme.
pub fn plane_methods() -> [Method; 3] {
    let flat = Method {
        name: "2D",
        family: Family::Ours,
        is_broad_phase_variant: false,
        sleeps: false,
        recommended: SETTING,
        settings: |_| vec![SETTING],
        mapped: |_| Vec::new(),
        build: |scene, _| Ok(Box::new(FarseerWorld::new(scene)?)),
    };
    let faithful = Method {
        name: "2.5D, faithful",
        build: |scene, _| Deep::build(scene, DepthScheme::Faithful),
        ..flat
    };
    let thesis =
        Method { name: "2.5D, thesis", build: |scene, _| Deep::build(scene, DepthScheme::Thesis), ..flat };
    [flat, faithful, thesis]
}

/// Returns the CPU time of a step of the run `point` in µs.
pub fn time_per_step(point: &Point) -> f64 {
    point.microseconds_per_simulated_second * f64::from(point.setting.dt.mean())
}

/// Returns the point of the 2D and 2.5D comparison with this number of circles and this method; `None` if `points` has
/// none.
pub fn plane_point<'a>(points: &'a [Point], size: usize, method: &str) -> Option<&'a Point> {
    points.iter().find(|point| point.scene == PLANES && point.size == size && point.method == method)
}

/// Returns the numbers of circles for which `points` has a point of the 2D and 2.5D comparison.
pub fn plane_sizes(points: &[Point]) -> impl Iterator<Item = usize> {
    let is_there = move |size| points.iter().any(|point| point.scene == PLANES && point.size == size);
    PLANE_SCENE.sizes.iter().copied().filter(move |&size| is_there(size))
}

/// The bodies and geoms of a 2D scene in the 2.5D engine, all at the same Z.
struct Deep {
    simulator: TwoHalfPhysicsSimulator,
    bodies: Vec<twohalf::BodyId>,
}

impl Deep {
    fn build(scene: &Scene, scheme: DepthScheme) -> Built {
        let run = Run::build(scene).map_err(|error| error.to_string())?;
        let deep = Self::of(&run, scheme).map_err(|error| error.to_string())?;
        Ok(Box::new(deep))
    }

    /// Copies the bodies and geoms of the 2D scene `run` into a new 2.5D simulator, in order. The scheme is set first,
    /// while the simulator is empty. The screen angle is 90 degrees and there is no ground, so the 2.5D simulation has
    /// the forces of the 2D one.
    fn of(run: &Run<'_>, scheme: DepthScheme) -> twohalf::Result<Self> {
        let flat = run.simulator();
        let mut simulator = TwoHalfPhysicsSimulator::with_angle_and_gravity(600, 90, flat.gravity())?;
        simulator.set_depth_scheme(scheme)?;
        let bodies: Vec<_> =
            run.bodies().iter().map(|&body| simulator.create_body(flat[body].clone())).collect();
        for &body in &bodies {
            simulator.add(body)?;
        }
        for &id in run.geoms() {
            let Some(geom) = flat.geom(id) else { continue };
            let Some(owner) = run.bodies().iter().position(|&body| body == geom.body()) else { continue };
            let vertices = geom.local_vertices().clone();
            let copy = simulator.create_geom(bodies[owner], vertices, GeomPlacement::default())?;
            if let Some(settings) = simulator.geom_mut(copy) {
                settings.set_friction_coefficient(geom.friction_coefficient());
                settings.set_restitution_coefficient(geom.restitution_coefficient());
            }
            simulator.add(copy)?;
        }
        Ok(Deep { simulator, bodies })
    }
}

impl World for Deep {
    fn step(&mut self, dt: f32) {
        self.simulator.update(dt);
    }

    fn body(&self, index: usize) -> BodyState {
        BodyState::of(&self.simulator.core()[self.bodies[index]])
    }

    fn body_count(&self) -> usize {
        self.bodies.len()
    }
}

fn against_2d(scene: &Scene) -> Box<dyn Watch> {
    let mut reference = FarseerWorld::new(scene).unwrap_or_else(|error| panic!("{error}"));
    let mut stepped = 0.0;
    let farthest = move |time: f64, world: &dyn World| {
        if time > stepped {
            reference.step(SETTING.dt.mean());
            stepped = time;
        }
        let off = |index| distance(world.body(index).position, reference.body(index).position);
        (0..world.body_count()).map(off).max_by(f64::total_cmp)
    };
    in_reach(worst(farthest), f64::INFINITY)
}
