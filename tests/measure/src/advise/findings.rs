//! What is off in a run, in terms that mean something to a game.

use super::reference::{Look, Reference};
use super::{Asked, Outcome};
use crate::stability::reasons::{MISPLACED, NOT_FINITE};
use crate::watch::Watch;
use crate::world::{BodyState, World, distance};
use farseer_core::PhysicsSimulator;
use farseer_core::math::Vector2;
use std::cell::RefCell;
use std::rc::Rc;

/// What is judged by more than one tolerance: where things end, and how far from their path they are.
const PLACE: f64 = 8.0;
/// What has left its place: so many tolerances from where it should rest.
const LEFT: f64 = 16.0;
/// The time in s in which what should rest may move by the tolerance.
const CALM: f64 = 0.2;
/// Part of the energy that nobody notices.
const ENERGY: f64 = 0.1;
/// The step in which a copy of a scene looks for its contacts: nothing moves in it.
const INSTANT: f32 = 1e-6;
/// Why a run has failed in which something is lower than it should be by as much.
const FELL: &str = "falls";

/// What is off in a run: lengths in the game's unit, speeds per s. `None` where nothing can be told.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Findings {
    /// By how much the greatest overlap of two outlines is more than in a careful run at the same moment. Outlines are those of
    /// the precise set: circles are round.
    pub overlap: f64,
    /// The same of the greatest distance of a joint from what it keeps; an angle counts as the way of a point one length unit
    /// away.
    pub gap: f64,
    /// Fastest speed, in the last second, of what should rest then.
    pub unrest: Option<f64>,
    /// Furthest from where it should rest that something has come to, and how many have left their place altogether.
    pub displacement: Option<f64>,
    /// See [`displacement`](Self::displacement).
    pub fallen: usize,
    /// Furthest from the way of the careful runs that something goes, while these are on one.
    pub stray: Option<f64>,
    /// Greatest difference of the energy of motion and height from that of the careful run, while ways can be told; then by how
    /// much it is more than that ever has. As a part of the greatest energy of motion, and what lifting everything by a
    /// length unit takes.
    pub energy: Option<f64>,
}

impl Findings {
    /// What is worst, and how many times what is exact enough it is.
    pub fn worst(&self, asked: &Asked) -> (&'static str, f64) {
        self.parts(asked).into_iter().fold(("nothing", 0.0), |worst, part| {
            if part.1 > worst.1 || part.1.is_nan() { part } else { worst }
        })
    }

    /// Everything in parts of what is exact enough.
    fn parts(&self, asked: &Asked) -> [(&'static str, f64); 6] {
        let length = asked.tolerance;
        [
            ("overlap", self.overlap / length),
            ("joint gap", self.gap / length),
            ("unrest", self.unrest.unwrap_or(0.0) * CALM / length),
            ("displacement", self.displacement.unwrap_or(0.0) / (PLACE * length)),
            ("way", self.stray.unwrap_or(0.0) / (PLACE * length)),
            ("energy", self.energy.unwrap_or(0.0) / ENERGY),
        ]
    }
}

/// Energy of motion and of height of a simulator's bodies.
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
            let [x, y] = state.place();
            energy.height -= part * mass * (gravity[0] * x + gravity[1] * y);
        }
        energy
    }

    /// What it takes to lift everything by a unit.
    pub(super) fn of_a_unit(simulator: &PhysicsSimulator, unit: f32) -> f64 {
        let gravity = f64::from(simulator.gravity().norm() * unit);
        let movable = simulator.bodies().map(|body| &simulator[body]).filter(|body| !body.is_static());
        movable.map(|body| f64::from(body.mass()) * gravity).sum()
    }

    pub(super) fn total(self) -> f64 {
        self.motion + self.height
    }
}

/// Watches a run beside the careful ones.
pub(super) struct Finder {
    asked: Asked,
    reference: Rc<Reference>,
    simulator: Rc<RefCell<PhysicsSimulator>>,
    found: Rc<RefCell<Findings>>,
    outcome: Outcome,
}

impl Finder {
    pub(super) fn new(
        asked: Asked,
        reference: Rc<Reference>,
        simulator: Rc<RefCell<PhysicsSimulator>>,
        found: Rc<RefCell<Findings>>,
    ) -> Self {
        Finder { asked, reference, simulator, found, outcome: Outcome::Fine }
    }

    fn look(&mut self, time: f64, bodies: &[BodyState]) {
        let Finder { asked, reference, simulator, found, .. } = self;
        let Some(look) = reference.at(time, 0.25 * f64::from(asked.dt)) else { return };
        let mut found = found.borrow_mut();
        let off = |body: usize| distance(bodies[body].position, look.bodies[body].position);
        let simulator = simulator.borrow();
        let [overlap, gap] = apart(&simulator, asked);
        found.overlap = found.overlap.max(overlap - look.overlap);
        found.gap = found.gap.max(gap - look.gap);
        let is_told = time <= reference.predictable();
        if is_told {
            found.stray = greater(found.stray, reference.moving_bodies().map(off));
        }
        let energy = Energy::of(&simulator).total();
        let differs =
            if is_told { (energy - look.energy.total()).abs() } else { energy - reference.most_energy };
        let part = Some(differs.max(0.0) / reference.energy_scale).filter(|part| part.is_finite());
        found.energy = greater(found.energy, part.into_iter());
        if Reference::is_late(asked, time) {
            self.outcome = found.judge_places(asked, reference, look, bodies, simulator.gravity());
        }
    }
}

impl Findings {
    /// Where things are that should rest by now.
    fn judge_places(
        &mut self,
        asked: &Asked,
        reference: &Reference,
        look: &Look,
        bodies: &[BodyState],
        gravity: Vector2,
    ) -> Outcome {
        let resting = || reference.resting_bodies();
        let off = |body: usize| distance(bodies[body].position, look.bodies[body].position);
        self.unrest = greater(self.unrest, resting().map(|body| bodies[body].speed()));
        self.displacement = greater(None, resting().map(off));
        self.fallen = resting().filter(|&body| off(body) > LEFT * asked.tolerance).count();
        let down = gravity.try_normalize(0.0).unwrap_or_default();
        let is_lower = |body: usize| {
            let ([x, y], [there_x, there_y]) = (bodies[body].place(), look.bodies[body].place());
            f64::from(down.x) * (x - there_x) + f64::from(down.y) * (y - there_y) > LEFT * asked.tolerance
        };
        match self.fallen {
            0 => Outcome::Fine,
            _ if resting().any(is_lower) => Outcome::Failed(FELL),
            _ => Outcome::Failed(MISPLACED),
        }
    }
}

impl Watch for Finder {
    fn see(&mut self, time: f64, world: &dyn World) {
        let bodies: Vec<BodyState> = (0..world.body_count()).map(|index| world.body(index)).collect();
        if !bodies.iter().all(BodyState::is_finite) {
            self.outcome = Outcome::Failed(NOT_FINITE);
        } else if self.outcome != Outcome::Failed(NOT_FINITE) {
            self.look(time, &bodies);
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

/// The greatest of these; what was before if there are none.
fn greater(before: Option<f64>, values: impl Iterator<Item = f64>) -> Option<f64> {
    values.fold(before, |greatest, value| Some(greatest.map_or(value, |greatest| greatest.max(value))))
}

/// How deep outlines overlap and how far joints gape where everything is now, as the precise set sees it: a copy of the scene
/// looks, whatever set moves it.
pub(super) fn apart(simulator: &PhysicsSimulator, asked: &Asked) -> [f64; 2] {
    let mut copy = simulator.clone();
    copy.set_sleep_enabled(false);
    copy.set_methods(asked.precise()).expect("the careful runs have been of this set");
    copy.update(INSTANT);
    let mut worst = [0.0_f32; 2];
    for left in copy.islands().iter().map(|island| copy.island_residual(island)) {
        worst[0] = worst[0].max(left.overlap);
        worst[1] = worst[1].max(left.gap).max(left.angle * asked.length_unit);
    }
    worst.map(f64::from)
}
