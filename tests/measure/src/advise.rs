//! Recommends a method for a user's scene: the cheapest one whose errors are within a tolerance.
//!
//! [`advise`] runs the scene with each of [`CHOICES`] by turns, so that other load on the machine slows all of them alike.
//! Two careful runs of the precise set, with 4 and 5 updates per step and 16 and 12 substeps per update, give the expected
//! course of the scene. Errors are quantities that matter to a game: see [`Findings`]. In a chaotic scene no two methods
//! follow the same path. Paths are therefore compared only until the two careful runs part.
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
use farseer_core::{BodyId, GeomId, Methods, NarrowPhaseCollider, PhysicsSimulator, SolverChoice};
use findings::FindingsWatch;
use reference::Reference;
use std::cell::RefCell;
use std::fmt::Display;
use std::rc::Rc;

/// Settings of a run of [`advise`]: duration, step and tolerance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Asked {
    /// Simulated time in s: long enough for bodies to fall, swing or come to rest.
    pub seconds: f64,
    /// The game's time step in s.
    pub dt: f32,
    /// Number of iterations per step of the faithful set in the user's game.
    pub iterations: u32,
    /// Typical size of an object in the game's unit of length: 32 for games in px, 1 for games in metres.
    pub length_unit: f32,
    /// Greatest error that no player sees, in the game's unit of length. Default: 1 (1 px), for games in which an object has
    /// 32 px.
    pub tolerance: f64,
}

impl Default for Asked {
    fn default() -> Self {
        Asked { seconds: 5.0, dt: 1.0 / 60.0, iterations: 5, length_unit: 32.0, tolerance: 1.0 }
    }
}

impl Asked {
    /// Returns an error with the reason if a setting is not finite, not greater than 0, or gives too few or too many steps.
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

    /// Returns the precise set with the length unit of this scene.
    pub(crate) fn precise(&self) -> Methods {
        Methods::Precise { length_unit: self.length_unit }
    }
}

/// Least number of steps of a run of [`advise`]: enough to distinguish rest from motion.
const LEAST: f64 = 20.0;
/// Greatest number of steps of a run of [`advise`], a bound on its duration.
const MOST: f64 = 100_000.0;

/// A method with which [`advise`] runs the scene: set of methods, solver and effort per step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Choice {
    /// Name of the method for readers. Choices with the same name differ in the [setting](Verdict::setting).
    pub name: &'static str,
    /// Island solver of the precise set; `None` for the faithful set.
    pub islands: Option<SolverChoice>,
    /// Number of iterations (faithful set) or substeps (precise set) per update. In the faithful set, 0 means the number in
    /// the user's game.
    pub passes: u32,
    /// Number of updates into which a time step of the game is divided, >= 1.
    pub parts: u16,
}

const FAITHFUL: Choice = Choice { name: "Faithful", islands: None, passes: 0, parts: 1 };
const PRECISE: Choice = Choice { name: "Precise", islands: Some(SolverChoice::Auto), passes: 4, parts: 1 };

const PASSES: Choice =
    Choice { name: "Precise, iterative solver alone", islands: Some(SolverChoice::Iterative), ..PRECISE };

/// All methods that [`advise`] runs, in the order of its table.
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
    /// Returns the time step in s of an update, and the iterations or substeps per update, of this choice.
    fn setting(&self, asked: &Asked) -> Setting {
        let passes = if self.passes == 0 { asked.iterations } else { self.passes };
        Setting::fixed(asked.dt / f32::from(self.parts), passes)
    }

    fn methods(&self, asked: &Asked) -> Methods {
        if self.islands.is_some() { asked.precise() } else { Methods::default() }
    }
}

/// Result of one choice in a run of [`advise`].
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// The method that was run.
    pub choice: Choice,
    /// Time step in s and iterations or substeps of the run.
    pub setting: Setting,
    /// Errors of the run in comparison with the careful runs (see [`advise`]).
    pub findings: Findings,
    /// Whether the run succeeded, or the reason of its failure, such as a body that falls or a number that is not finite.
    pub outcome: Outcome,
    /// CPU time of the steps per second of simulated time, in µs/s.
    pub microseconds_per_simulated_second: f64,
}

impl Verdict {
    /// Returns whether the run did not fail and every error is within its tolerance.
    pub fn is_exact_enough(&self, asked: &Asked) -> bool {
        self.outcome == Outcome::Fine && self.findings.worst(asked).1 <= 1.0
    }
}

/// Result of [`advise`]: a verdict for each choice, and how predictable the scene is.
#[derive(Debug, Clone, PartialEq)]
pub struct Advice {
    /// Settings with which [`advise`] was called.
    pub asked: Asked,
    /// Number of dynamic bodies in the scene.
    pub movable: usize,
    /// Number of dynamic bodies that come to rest in the same places in both careful runs (see [`advise`]).
    pub resting: usize,
    /// Simulated time in s after which the paths of the two careful runs (see [`advise`]) part.
    pub predictable: f64,
    /// One verdict for each choice that was run, in the order of [`CHOICES`].
    pub verdicts: Vec<Verdict>,
    /// Choices that cannot be run in this scene, each with the reason.
    pub absent: Vec<(Choice, String)>,
    /// Points of the chart: the worst error, as a multiple of its tolerance, and the CPU time in µs per simulated second.
    pub points: Vec<Point>,
}

/// Greatest ratio of two CPU times that count as equal, dimensionless. Value chosen; its sensitivity is not measured.
const CHANCE: f64 = 1.1;
/// Name of the scene in charts.
const SCENE: &str = "your_scene";

impl Advice {
    /// Returns the cheapest verdict that is exact enough. Among verdicts that need at most 1.1 times its CPU time, it
    /// returns the one with the least error. `None` if no verdict is exact enough.
    pub fn recommended(&self) -> Option<&Verdict> {
        let fine = || self.verdicts.iter().filter(|verdict| verdict.is_exact_enough(&self.asked));
        let time = |verdict: &Verdict| verdict.microseconds_per_simulated_second;
        let least = fine().map(time).fold(f64::INFINITY, f64::min);
        let worst = |verdict: &Verdict| verdict.findings.worst(&self.asked).1;
        fine().filter(|verdict| time(verdict) <= CHANCE * least).min_by(|a, b| worst(a).total_cmp(&worst(b)))
    }

    /// Returns the title, axis labels and tolerance of the chart.
    pub fn subject(&self) -> Subject {
        Subject {
            name: SCENE,
            about: "Greatest error, as a multiple of its tolerance, over CPU time.",
            sizes: vec![0],
            error: "greatest error / tolerance",
            unit: "",
            tolerance: 1.0,
        }
    }

    /// Returns the lines of the chart by name, each with its recommended setting: the game's own iterations, or 4 substeps.
    pub fn methods(&self) -> [(&'static str, Setting); 3] {
        [FAITHFUL, PRECISE, PASSES].map(|choice| (choice.name, choice.setting(&self.asked)))
    }
}

/// Runs a scene with each of [`CHOICES`], and returns the cost and the errors of each, and the cheapest that is exact
/// enough.
///
/// `build` creates the same scene anew at each call. Its argument is the set of methods; if the simulator has the other set,
/// it is changed afterwards. Work of the game between updates is not part of a run.
///
/// # Errors
///
/// - A setting is not finite or not greater than 0.
/// - The number of steps is too small or too great.
/// - `build` fails for the precise set.
/// - In a careful run the state of a body is not finite, or a body leaves the scene.
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
        absent.push((PASSES, "the same as Precise: the direct solver takes no island".to_owned()));
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

/// Returns whether verdict `one` is of the iterative solver alone and has the same errors and outcome as `other`.
fn is_the_same(one: &Verdict, other: &Verdict) -> bool {
    one.choice == PASSES && (&one.findings, one.outcome) == (&other.findings, other.outcome)
}

/// Errors of a run, shared between the verdict and the watch that measures them.
type Shared = Rc<RefCell<Findings>>;

/// Builds the scene with the methods, iterations and island solver of `choice`.
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
    simulator.set_solver_choice(choice.islands.unwrap_or_default());
    Ok(simulator)
}

/// Changes the simulator to `methods`. Creates missing distance grids, since geoms that were made in the precise set have
/// none.
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
            Box::new(FindingsWatch::new(*asked, reference.clone(), simulator.clone(), found.clone()));
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

/// A world whose simulator is shared with the watch of the run, which reads more than body states.
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
