//! Errors of a run of [`advise`](super::advise), as quantities that matter to a game.

use super::reference::{Reference, Sample};
use super::{Asked, Outcome};
use crate::stability::reasons::{MISPLACED, NOT_FINITE};
use crate::watch::Watch;
use crate::world::{BodyState, World, distance};
use farseer_core::PhysicsSimulator;
use farseer_core::math::Vector2;
use std::cell::RefCell;
use std::rc::Rc;

/// Greatest error of a final position, and of a distance from a path, as a multiple of the tolerance (dimensionless). These
/// errors matter less than overlaps.
const POSITION_TOLERANCES: f64 = 8.0;
/// Distance from its resting position beyond which a body counts as fallen, as a multiple of the tolerance (dimensionless).
const FALLEN_TOLERANCES: f64 = 16.0;
/// Time in s in which a body at rest may move by the tolerance; tolerance / time is the greatest speed at rest.
const REST_TIME: f64 = 0.2;
/// Fraction of the energy whose loss or gain is not noticed, dimensionless.
const ENERGY_FRACTION: f64 = 0.1;
/// Length in s of the step in which a copy of a scene finds its contacts. Bodies hardly move in it.
const TINY_STEP: f32 = 1e-6;
/// Reason of a failure: a body is at least [`FALLEN_TOLERANCES`] tolerances below its resting position.
const FELL: &str = "falls";

/// Errors of a run of [`advise`](super::advise), in the game's length units and s. `None` where the careful runs give no
/// prediction.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Findings {
    /// Greatest overlap of two outlines minus that of a careful run at the same time, in length units. Outlines are those of
    /// the precise set: circles are round.
    pub overlap: f64,
    /// Greatest error of a joint minus that of a careful run at the same time, in length units. An angle counts as the arc of a
    /// point one length unit away.
    pub gap: f64,
    /// Greatest speed, in length units/s, of the bodies that come to rest in both careful runs, measured in the last second.
    /// `None` if no body does.
    pub unrest: Option<f64>,
    /// Greatest distance, in length units, of a body from its resting position in the careful runs. `None` if no body comes to
    /// rest in both.
    pub displacement: Option<f64>,
    /// Number of bodies farther than 16 tolerances from their resting position in the careful runs.
    pub fallen: usize,
    /// Greatest distance of a body from its path in the careful runs, in length units, while both careful runs are on one path.
    pub stray: Option<f64>,
    /// Greatest difference of kinetic plus potential energy from that of the careful run, while both careful runs are on one
    /// path. Afterwards, the excess over the careful run's greatest energy. Unit: fraction of the greatest kinetic energy plus
    /// the energy that lifts every body by one length unit.
    pub energy: Option<f64>,
}

impl Findings {
    /// Returns the name of the worst error and its value as a multiple of its tolerance (dimensionless).
    pub fn worst(&self, asked: &Asked) -> (&'static str, f64) {
        self.relative_errors(asked).into_iter().fold(("nothing", 0.0), |worst, part| {
            if part.1 > worst.1 || part.1.is_nan() { part } else { worst }
        })
    }

    /// Returns the names of all errors and their values as multiples of their tolerances (dimensionless).
    fn relative_errors(&self, asked: &Asked) -> [(&'static str, f64); 6] {
        let length = asked.tolerance;
        [
            ("overlap", self.overlap / length),
            ("joint gap", self.gap / length),
            ("rest speed", self.unrest.unwrap_or(0.0) * REST_TIME / length),
            ("displacement", self.displacement.unwrap_or(0.0) / (POSITION_TOLERANCES * length)),
            ("path error", self.stray.unwrap_or(0.0) / (POSITION_TOLERANCES * length)),
            ("energy", self.energy.unwrap_or(0.0) / ENERGY_FRACTION),
        ]
    }
}

/// Kinetic energy and potential energy of gravity of a simulator's movable bodies, in mass units * length units^2/s^2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Energy {
    pub(super) motion: f64,
    height: f64,
}

impl Energy {
    pub(super) fn of(simulator: &PhysicsSimulator) -> Self {
        let mut energy = Energy { motion: 0.0, height: 0.0 };
        let gravity = [simulator.gravity().x, simulator.gravity().y].map(f64::from);
        for body in simulator.bodies().map(|body| &simulator[body]) {
            if !body.enabled() || body.is_static() || body.is_kinematic() {
                continue;
            }
            let (state, mass) = (BodyState::of(body), f64::from(body.mass()));
            let inertia = f64::from(body.moment_of_inertia());
            energy.motion +=
                0.5 * mass * state.speed().powi(2) + 0.5 * inertia * state.angular_velocity.powi(2);
            let part = if body.ignore_gravity() { 0.0 } else { f64::from(body.gravity_scale()) };
            let [x, y] = state.position_in_plane();
            energy.height -= part * mass * (gravity[0] * x + gravity[1] * y);
        }
        energy
    }

    /// Returns the energy that lifts all bodies by `unit`, one length unit of the game, in mass units * length units^2/s^2.
    pub(super) fn of_a_unit(simulator: &PhysicsSimulator, unit: f32) -> f64 {
        let gravity = f64::from(simulator.gravity().norm() * unit);
        let movable = simulator.bodies().map(|body| &simulator[body]).filter(|body| !body.is_static());
        movable.map(|body| f64::from(body.mass()) * gravity).sum()
    }

    pub(super) fn total(self) -> f64 {
        self.motion + self.height
    }
}

/// Watches a run of a choice and compares it with the careful runs.
pub(super) struct FindingsWatch {
    asked: Asked,
    reference: Rc<Reference>,
    simulator: Rc<RefCell<PhysicsSimulator>>,
    found: Rc<RefCell<Findings>>,
    outcome: Outcome,
}

impl FindingsWatch {
    pub(super) fn new(
        asked: Asked,
        reference: Rc<Reference>,
        simulator: Rc<RefCell<PhysicsSimulator>>,
        found: Rc<RefCell<Findings>>,
    ) -> Self {
        FindingsWatch { asked, reference, simulator, found, outcome: Outcome::Fine }
    }

    fn compare(&mut self, time: f64, bodies: &[BodyState]) {
        let FindingsWatch { asked, reference, simulator, found, .. } = self;
        let Some(look) = reference.at(time, 0.25 * f64::from(asked.dt)) else { return };
        let mut found = found.borrow_mut();
        let off = |body: usize| distance(bodies[body].position, look.bodies[body].position);
        let simulator = simulator.borrow();
        let [overlap, gap] = overlap_and_gap(&simulator, asked);
        found.overlap = found.overlap.max(overlap - look.overlap);
        found.gap = found.gap.max(gap - look.gap);
        let is_told = time <= reference.predictable();
        if is_told {
            found.stray = maximum_of(found.stray, reference.moving_bodies().map(off));
        }
        let energy = Energy::of(&simulator).total();
        let differs =
            if is_told { (energy - look.energy.total()).abs() } else { energy - reference.most_energy };
        let part = Some(differs.max(0.0) / reference.energy_scale).filter(|part| part.is_finite());
        found.energy = maximum_of(found.energy, part.into_iter());
        if Reference::is_late(asked, time) {
            self.outcome = found.judge_positions(asked, reference, look, bodies, simulator.gravity());
        }
    }
}

impl Findings {
    /// Compares the positions of bodies that should be at rest with their resting positions.
    fn judge_positions(
        &mut self,
        asked: &Asked,
        reference: &Reference,
        look: &Sample,
        bodies: &[BodyState],
        gravity: Vector2,
    ) -> Outcome {
        let resting = || reference.resting_bodies();
        let off = |body: usize| distance(bodies[body].position, look.bodies[body].position);
        self.unrest = maximum_of(self.unrest, resting().map(|body| bodies[body].speed()));
        self.displacement = maximum_of(None, resting().map(off));
        self.fallen = resting().filter(|&body| off(body) > FALLEN_TOLERANCES * asked.tolerance).count();
        let down = gravity.try_normalize(0.0).unwrap_or_default();
        let is_lower = |body: usize| {
            let ([x, y], [there_x, there_y]) =
                (bodies[body].position_in_plane(), look.bodies[body].position_in_plane());
            f64::from(down.x) * (x - there_x) + f64::from(down.y) * (y - there_y)
                > FALLEN_TOLERANCES * asked.tolerance
        };
        match self.fallen {
            0 => Outcome::Fine,
            _ if resting().any(is_lower) => Outcome::Failed(FELL),
            _ => Outcome::Failed(MISPLACED),
        }
    }
}

impl Watch for FindingsWatch {
    fn observe(&mut self, time: f64, world: &dyn World) {
        let bodies: Vec<BodyState> = (0..world.body_count()).map(|index| world.body(index)).collect();
        if !bodies.iter().all(BodyState::is_finite) {
            self.outcome = Outcome::Failed(NOT_FINITE);
        } else if self.outcome != Outcome::Failed(NOT_FINITE) {
            self.compare(time, &bodies);
        }
    }

    fn error(&self) -> f64 {
        self.found.borrow().worst(&self.asked).1
    }

    fn failed(&self) -> Option<&'static str> {
        match self.outcome {
            Outcome::Fine => None,
            Outcome::Failed(reason) => Some(reason),
        }
    }
}

/// Returns the maximum of `values` and `before`; `before` if there are no values.
fn maximum_of(before: Option<f64>, values: impl Iterator<Item = f64>) -> Option<f64> {
    values.fold(before, |greatest, value| Some(greatest.map_or(value, |greatest| greatest.max(value))))
}

/// Returns the greatest overlap of two outlines and the greatest gap of a joint at present, in length units. A copy of the
/// scene computes both in one short step with the precise set, whichever set the run has.
pub(super) fn overlap_and_gap(simulator: &PhysicsSimulator, asked: &Asked) -> [f64; 2] {
    let mut copy = simulator.clone();
    copy.set_sleep_enabled(false);
    copy.set_methods(asked.precise()).expect("the careful runs have been of this set");
    copy.update(TINY_STEP);
    let mut worst = [0.0_f32; 2];
    for left in copy.islands().iter().map(|island| copy.island_residual(island)) {
        worst[0] = worst[0].max(left.overlap);
        worst[1] = worst[1].max(left.gap).max(left.angle * asked.length_unit);
    }
    worst.map(f64::from)
}
