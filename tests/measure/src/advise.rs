//! Which methods are exact enough for a scene of a user's, and which of these cost least.
//!
//! [`advise`] runs the scene with each of [`CHOICES`], by turns, so that what the machine does besides meets all of them, and
//! beside two careful runs of the precise set that say how it really goes. What is off means something to a game: see
//! [`Findings`]. Neither set moves a chaotic scene along the path of the other: paths are compared only for as long as
//! the two careful runs are on one.
//!
//! ```
//! use farseer_core::{BodyFactory, GeomFactory, GeomPlacement, Methods, PhysicsSimulator, math::Vector2};
//! use measure::advise::{Asked, advise};
//!
//! // A crate on a floor. A game can hand over a clone of its simulator as it is.
//! let build = |methods: Methods| -> farseer_core::Result<PhysicsSimulator> {
//!     let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 320.0))?;
//!     simulator.set_methods(methods)?;
//!     for (y, is_static) in [(16.0, true), (-16.0, false)] {
//!         let body = BodyFactory::create_rectangle_body_in(&mut simulator, 32.0, 32.0, 1.0)?;
//!         simulator[body].set_position(Vector2::new(0.0, y));
//!         simulator[body].set_is_static(is_static);
//!         GeomFactory::create_rectangle_geom_in(&mut simulator, body, 32.0, 32.0, GeomPlacement::default())?;
//!     }
//!     Ok(simulator)
//! };
//! let advice = advise(&Asked { seconds: 1.0, ..Asked::default() }, build)?;
//! assert!(advice.recommended().is_some());
//! println!("{}\n{}", advice.table(), advice.sentence());
//! # Ok::<(), String>(())
//! ```

mod findings;
mod reference;
mod scene;
mod words;

pub use findings::Findings;
pub use scene::{advise_on, asked_of};

use crate::method::Setting;
use crate::sweep::{Outcome, Point, Run, Start, Subject, Sweep, Trial};
use crate::watch::Watch;
use crate::world::{BodyState, World};
use farseer_core::{BodyId, GeomId, IslandChoice, Methods, NarrowPhaseCollider, PhysicsSimulator};
use findings::Finder;
use reference::Reference;
use std::cell::RefCell;
use std::fmt::Display;
use std::rc::Rc;

/// What is asked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Asked {
    /// Simulated time in s: long enough for what is to fall, swing or come to rest.
    pub seconds: f64,
    /// The game's time step in s.
    pub dt: f32,
    /// Iterations of the faithful set that the game has.
    pub iterations: u32,
    /// Size of things in the game's unit of length: 32 for games in px, 1 for games in metres.
    pub length_unit: f32,
    /// What nobody sees: a length. 1 px, by default, where a unit is 32 px.
    pub tolerance: f64,
}

impl Default for Asked {
    fn default() -> Self {
        Asked { seconds: 5.0, dt: 1.0 / 60.0, iterations: 5, length_unit: 32.0, tolerance: 1.0 }
    }
}

impl Asked {
    /// Refuses what nothing can be run with.
    fn check(&self) -> Result<(), String> {
        let Asked { seconds, dt, length_unit, tolerance, .. } = *self;
        let numbers = [
            ("seconds", seconds),
            ("dt", f64::from(dt)),
            ("length_unit", f64::from(length_unit)),
            ("tolerance", tolerance),
        ];
        let is_wrong = |(_, value): &(&str, f64)| !(value.is_finite() && *value > 0.0);
        if let Some((name, value)) = numbers.into_iter().find(is_wrong) {
            return Err(format!("{name} is {value}, and must be more than 0"));
        }
        let steps = seconds / f64::from(dt);
        if !(LEAST..=MOST).contains(&steps) {
            return Err(format!(
                "{seconds} s in steps of {dt} s are {steps:.0}: {LEAST} to {MOST} can be judged"
            ));
        }
        Ok(())
    }

    /// The precise set for this scene.
    pub(crate) fn precise(&self) -> Methods {
        Methods::Precise { length_unit: self.length_unit }
    }
}

/// Steps of a run: enough to tell rest from motion, and not hours.
const LEAST: f64 = 20.0;
const MOST: f64 = 100_000.0;

/// A way to run a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Choice {
    /// What a reader calls it, with its [setting](Verdict::setting).
    pub name: &'static str,
    /// Whether it is the precise set, with what is chosen of its islands.
    pub islands: Option<IslandChoice>,
    /// Iterations or substeps; of the faithful set, 0 for those that the game has.
    pub passes: u32,
    /// Into how many updates a step of the game is divided.
    pub parts: u16,
}

const FAITHFUL: Choice = Choice { name: "Faithful", islands: None, passes: 0, parts: 1 };
const PRECISE: Choice =
    Choice { name: "Precise", islands: Some(IslandChoice::ByItself), passes: 4, parts: 1 };

const PASSES: Choice =
    Choice { name: "Precise, passes alone", islands: Some(IslandChoice::Passes), ..PRECISE };

/// What is tried.
pub const CHOICES: [Choice; 7] = [
    FAITHFUL,
    Choice { passes: 20, ..FAITHFUL },
    Choice { passes: 20, parts: 2, ..FAITHFUL },
    Choice { passes: 2, ..PRECISE },
    PRECISE,
    Choice { passes: 8, ..PRECISE },
    PASSES,
];

impl Choice {
    /// The time step and passes in a scene.
    fn setting(&self, asked: &Asked) -> Setting {
        let passes = if self.passes == 0 { asked.iterations } else { self.passes };
        Setting::fixed(asked.dt / f32::from(self.parts), passes)
    }

    fn methods(&self, asked: &Asked) -> Methods {
        if self.islands.is_some() { asked.precise() } else { Methods::default() }
    }
}

/// What came of a choice.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// Which it is.
    pub choice: Choice,
    /// Its time step and passes.
    pub setting: Setting,
    /// What is off.
    pub findings: Findings,
    /// Why the run is of no use, if it is: what fell or was no number.
    pub outcome: Outcome,
    /// CPU time of the steps for each second of simulated time.
    pub microseconds_per_simulated_second: f64,
}

impl Verdict {
    /// Whether everything that is off is within what is asked.
    pub fn is_exact_enough(&self, asked: &Asked) -> bool {
        self.outcome == Outcome::Fine && self.findings.worst(asked).1 <= 1.0
    }
}

/// What [`advise`] answers.
#[derive(Debug, Clone, PartialEq)]
pub struct Advice {
    /// What was asked.
    pub asked: Asked,
    /// Bodies that can move; those that come to rest, in the same places in both careful runs; and for how many seconds
    /// these are on one path.
    pub movable: usize,
    /// See [`movable`](Self::movable).
    pub resting: usize,
    /// See [`movable`](Self::movable).
    pub predictable: f64,
    /// In the order of [`CHOICES`].
    pub verdicts: Vec<Verdict>,
    /// What cannot be run, and why.
    pub absent: Vec<(Choice, String)>,
    /// For a chart: what is off, in parts of what is exact enough, over time.
    pub points: Vec<Point>,
}

/// Times that differ by less than this factor are alike.
const CHANCE: f64 = 1.1;
/// Name of the scene in charts.
const SCENE: &str = "your_scene";

impl Advice {
    /// The cheapest that is exact enough; of those that hardly take more, the most exact one.
    pub fn recommended(&self) -> Option<&Verdict> {
        let fine = || self.verdicts.iter().filter(|verdict| verdict.is_exact_enough(&self.asked));
        let time = |verdict: &Verdict| verdict.microseconds_per_simulated_second;
        let least = fine().map(time).fold(f64::INFINITY, f64::min);
        let worst = |verdict: &Verdict| verdict.findings.worst(&self.asked).1;
        fine().filter(|verdict| time(verdict) <= CHANCE * least).min_by(|a, b| worst(a).total_cmp(&worst(b)))
    }

    /// What a chart says of it.
    pub fn subject(&self) -> Subject {
        Subject {
            name: SCENE,
            about: "What is off most, in parts of what would be exact enough, over the time it takes.",
            sizes: vec![0],
            error: "greatest error / what is exact enough",
            unit: "",
            tolerance: 1.0,
        }
    }

    /// The lines of a chart, with the settings that a game begins with: its own, and 4 substeps.
    pub fn methods(&self) -> [(&'static str, Setting); 3] {
        [FAITHFUL, PRECISE, PASSES].map(|choice| (choice.name, choice.setting(&self.asked)))
    }
}

/// Runs a scene with each choice there is, and says what it takes, how far it is off, and which is the cheapest that is exact
/// enough. `build` makes the scene anew, always the same, for these methods, or for others that may be changed to them. What a
/// game does between updates is not in it.
///
/// # Errors
///
/// A number of what is asked that is not finite, or not greater than 0; steps that are too few or too many; what `build` says
/// of the precise set; a careful run in which something is no number or leaves.
pub fn advise<E: Display>(
    asked: &Asked,
    build: impl Fn(Methods) -> Result<PhysicsSimulator, E>,
) -> Result<Advice, String> {
    asked.check()?;
    let build = |choice: &Choice| built(asked, choice, &build);
    let reference = Rc::new(Reference::of(asked, &build)?);
    let (mut tried, mut absent) = (Vec::new(), Vec::new());
    let is_twice = |at: usize| {
        let is_same = |other: &Choice| {
            other.name == CHOICES[at].name && other.setting(asked) == CHOICES[at].setting(asked)
        };
        CHOICES[..at].iter().any(is_same)
    };
    for choice in (0..CHOICES.len()).filter(|&at| !is_twice(at)).map(|at| CHOICES[at]) {
        match build(&choice) {
            Ok(_) => tried.push((choice, Rc::new(RefCell::new(Findings::default())))),
            Err(reason) => absent.push((choice, reason)),
        }
    }
    let trial = |(choice, found): &(Choice, Shared)| trial(asked, *choice, &reference, found, &build);
    let mut sweep = Sweep::default();
    sweep.run(&tried.iter().map(trial).collect::<Vec<_>>(), &mut |_, _| {});
    let mut verdicts: Vec<Verdict> =
        tried.iter().filter_map(|tried| verdict(asked, tried, &sweep.points)).collect();
    let by_itself = verdicts.iter().find(|verdict| verdict.choice == PRECISE).cloned();
    if verdicts.pop_if(|last| by_itself.is_some_and(|other| is_the_same(last, &other))).is_some() {
        absent.push((PASSES, "the same as Precise: nothing is solved as a whole".to_owned()));
        sweep.points.retain(|point| point.method != PASSES.name);
    }
    Ok(Advice {
        asked: *asked,
        movable: reference.movable(),
        resting: reference.resting(),
        predictable: reference.predictable(),
        verdicts,
        absent,
        points: sweep.points,
    })
}

/// Whether two runs were one, to the bit.
fn is_the_same(one: &Verdict, other: &Verdict) -> bool {
    one.choice == PASSES && (&one.findings, one.outcome) == (&other.findings, other.outcome)
}

/// What a run has found, shared with who watches it.
type Shared = Rc<RefCell<Findings>>;

/// Makes the scene for a choice.
fn built<E: Display>(
    asked: &Asked,
    choice: &Choice,
    build: &impl Fn(Methods) -> Result<PhysicsSimulator, E>,
) -> Result<PhysicsSimulator, String> {
    let methods = choice.methods(asked);
    let mut simulator = build(methods).map_err(|error| error.to_string())?;
    let is_faithful = |methods| matches!(methods, Methods::Faithful { .. });
    if simulator.methods() != methods && !(is_faithful(simulator.methods()) && is_faithful(methods)) {
        change(&mut simulator, methods).map_err(|error| error.to_string())?;
    }
    let passes = choice.setting(asked).passes;
    simulator.set_iterations(i32::try_from(passes).map_err(|_| format!("{passes} iterations"))?);
    simulator.set_island_choice(choice.islands.unwrap_or_default());
    Ok(simulator)
}

/// Changes to the other set. What was made under the precise one has no distance grids yet.
fn change(simulator: &mut PhysicsSimulator, methods: Methods) -> farseer_core::Result<()> {
    simulator.set_methods(methods)?;
    let has_grid = |&geom: &GeomId| simulator.geom(geom).is_some_and(|geom| geom.distance_grid().is_some());
    let without: Vec<GeomId> = simulator.geoms().filter(|geom| !has_grid(geom)).collect();
    let wants_grids = simulator.narrow_phase_collider() == NarrowPhaseCollider::DistanceGrid;
    without.into_iter().filter(|_| wants_grids).try_for_each(|geom| simulator.create_distance_grid(geom))
}

fn trial<'a>(
    asked: &'a Asked,
    choice: Choice,
    reference: &Rc<Reference>,
    found: &Shared,
    build: &'a impl Fn(&Choice) -> Result<PhysicsSimulator, String>,
) -> Trial<'a> {
    let (reference, found) = (reference.clone(), found.clone());
    let start: Start<'a> = Box::new(move || {
        let simulator = build(&choice)?;
        let bodies: Vec<BodyId> = simulator.bodies().collect();
        let simulator = Rc::new(RefCell::new(simulator));
        let watch: Box<dyn Watch> =
            Box::new(Finder::new(*asked, reference.clone(), simulator.clone(), found.clone()));
        Ok(Run { world: Box::new(Stepped { simulator, bodies }), watches: vec![(SCENE, watch)] })
    });
    let setting = choice.setting(asked);
    Trial { scene: SCENE, size: 0, method: choice.name, setting, seconds: asked.seconds, start }
}

fn verdict(asked: &Asked, (choice, found): &(Choice, Shared), points: &[Point]) -> Option<Verdict> {
    let setting = choice.setting(asked);
    let point = points.iter().find(|point| point.method == choice.name && point.setting == setting)?;
    Some(Verdict {
        choice: *choice,
        setting,
        findings: found.borrow().clone(),
        outcome: point.outcome,
        microseconds_per_simulated_second: point.microseconds_per_simulated_second,
    })
}

/// A simulator that its watch looks into, too.
struct Stepped {
    simulator: Rc<RefCell<PhysicsSimulator>>,
    bodies: Vec<BodyId>,
}

impl World for Stepped {
    fn step(&mut self, dt: f32) {
        self.simulator.borrow_mut().update(dt);
    }

    fn body(&self, index: usize) -> BodyState {
        self.simulator.borrow().body(self.bodies[index]).map_or(BodyState::default(), BodyState::of)
    }

    fn body_count(&self) -> usize {
        self.bodies.len()
    }
}
