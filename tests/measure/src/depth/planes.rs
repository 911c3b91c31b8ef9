//! The same scene in 2D and in 2.5D, as the thesis compared them: circles that fall into a pit, all at one depth.

use crate::error::Largest;
use crate::method::{Effort, Setting};
use crate::sweep::{Outcome, Point, Running, Trial};
use conformance::run::Run;
use conformance::scenes::circles_in_a_pit;
use farseer_core::math::Vector2;
use farseer_core::{GeomPlacement, PhysicsSimulator};
use twohalf::{Methods, TwoHalfPhysicsSimulator};

/// Name of the scene.
pub const PLANES: &str = "pit_in_2d_and_2.5d";
/// Numbers of circles: those of the thesis' comparison, and more.
const SIZES: [usize; 4] = [20, 40, 200, 2000];
/// The setting: what is compared is time.
const SETTING: Setting = Setting::fixed(1.0 / 60.0, 5);
/// Simulated time in s: the circles fall and come to lie.
const SECONDS: f64 = 5.0;

/// The simulators that are compared: the first is the 2D engine itself.
pub const PLANE_METHODS: [&str; 3] = ["2D", "2.5D, faithful", "2.5D, thesis"];
const METHODS: [Option<Methods>; 3] = [None, Some(Methods::Faithful), Some(Methods::Thesis)];

/// The trials of the comparison. The error of each is the largest distance, in px, that a circle ever has from where
/// it is in the 2D engine at the same time.
pub fn plane_trials(effort: Effort) -> Vec<Trial<'static>> {
    let sizes = SIZES.into_iter().filter(|&size| effort == Effort::Full || size < 1000);
    sizes.flat_map(|size| [0, 1, 2].map(|index| trial(size, PLANE_METHODS[index], METHODS[index]))).collect()
}

fn trial(size: usize, method: &'static str, methods: Option<Methods>) -> Trial<'static> {
    let start = move || {
        let run: Box<dyn Running> = Box::new(PlaneRun::new(size, methods)?);
        Ok(run)
    };
    Trial { scene: PLANES, size, method, setting: SETTING, seconds: SECONDS, start: Box::new(start) }
}

/// CPU time of a step in µs.
pub fn time_per_step(point: &Point) -> f64 {
    point.microseconds_per_simulated_second * f64::from(point.setting.dt.mean())
}

/// The comparison's points among others, of a size and a method.
pub fn plane_point<'a>(points: &'a [Point], size: usize, method: &str) -> Option<&'a Point> {
    points.iter().find(|point| point.scene == PLANES && point.size == size && point.method == method)
}

/// The sizes that there are points of.
pub fn plane_sizes(points: &[Point]) -> impl Iterator<Item = usize> {
    let is_there = move |size| PLANE_METHODS.iter().any(|method| plane_point(points, size, method).is_some());
    SIZES.into_iter().filter(move |&size| is_there(size))
}

/// A simulator with or without depth.
enum Plane {
    Flat(Box<PhysicsSimulator>),
    Deep(Box<TwoHalfPhysicsSimulator>),
}

impl Plane {
    fn new(size: usize, methods: Option<Methods>) -> Result<Self, String> {
        let scene = circles_in_a_pit(size);
        let run = Run::build(&scene).map_err(|error| error.to_string())?;
        match methods {
            None => Ok(Plane::Flat(Box::new(run.simulator().clone()))),
            Some(methods) => deep(&run, methods).map_err(|error| error.to_string()),
        }
    }

    fn core(&self) -> &PhysicsSimulator {
        match self {
            Plane::Flat(simulator) => simulator,
            Plane::Deep(simulator) => simulator.core(),
        }
    }

    fn step(&mut self, dt: f32) {
        match self {
            Plane::Flat(simulator) => simulator.update(dt),
            Plane::Deep(simulator) => simulator.update(dt),
        }
    }
}

/// The bodies and geoms of a run, made anew in the same order: methods are chosen before anything takes part. Seen
/// straight from above the ground, and without a ground, so that nothing but what is in the plane acts.
fn deep(run: &Run<'_>, methods: Methods) -> twohalf::Result<Plane> {
    let flat = run.simulator();
    let mut simulator = TwoHalfPhysicsSimulator::with_angle_and_gravity(600, 90, flat.gravity())?;
    simulator.set_methods(methods)?;
    let bodies: Vec<_> = run.bodies().iter().map(|&body| simulator.create_body(flat[body].clone())).collect();
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
    Ok(Plane::Deep(Box::new(simulator)))
}

struct PlaneRun {
    plane: Plane,
    /// The 2D engine, stepped while looking.
    reference: Plane,
    time: f64,
    largest: Largest,
}

impl PlaneRun {
    fn new(size: usize, methods: Option<Methods>) -> Result<Self, String> {
        let (plane, reference) = (Plane::new(size, methods)?, Plane::new(size, None)?);
        Ok(PlaneRun { plane, reference, time: 0.0, largest: Largest::default() })
    }
}

impl Running for PlaneRun {
    fn step(&mut self, dt: f32) {
        self.plane.step(dt);
    }

    fn look(&mut self, time: f64) -> bool {
        if time > self.time {
            self.reference.step(SETTING.dt.mean());
            self.time = time;
        }
        note_distances(self.plane.core(), self.reference.core(), &mut self.largest);
        self.largest.get().is_finite()
    }

    fn verdict(&self) -> (f64, Outcome) {
        let largest = self.largest.get();
        (largest, if largest.is_finite() { Outcome::Fine } else { Outcome::Failed("not finite") })
    }
}

fn note_distances(one: &PhysicsSimulator, other: &PhysicsSimulator, largest: &mut Largest) {
    let place = |simulator: &PhysicsSimulator, index: usize| -> Vector2 {
        simulator[simulator.body_list()[index]].position()
    };
    // Nothing is listed before the first step.
    largest.take(0.0);
    for index in 0..one.body_list().len().min(other.body_list().len()) {
        largest.take(f64::from((place(one, index) - place(other, index)).norm()));
    }
}
