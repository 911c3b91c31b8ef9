//! Charts of a body on a spring without damping: error of the period and of the amplitude.

use super::super::watch::{Watch, failing, last};
use super::super::world::World;
use super::build::weightless;
use super::signals::Period;
use super::{ChartScene, ONE_SIZE};
use crate::scenes::stage::vector;
use conformance::scene::{BodyShape, Scene, SpringKind, SpringSettings, SpringSpec};
use std::f64::consts::TAU;

const BOB: BodyShape = BodyShape::Circle { radius: 16.0, mass: 1.0 };
const REST_LENGTH: f64 = 200.0;
const AMPLITUDE: f64 = 40.0;
/// Frequency of the soft spring in Hz.
const SOFT: f64 = 1.0;
/// Frequency of the stiff spring in Hz. An explicit spring is stable below ω dt = 2 (ω: angular frequency). This one has ω dt =
/// 0.84 at 1/60 s and 1.7 at 1/30 s.
const STIFF: f64 = 8.0;
const SOFT_SECONDS: f64 = 20.0;
const STIFF_SECONDS: f64 = 5.0;
const REACH: f64 = 1e4;
/// Fraction of the initial amplitude below which a swing counts as over, dimensionless: the rest is noise.
const MIN_AMPLITUDE_FRACTION: f64 = 0.05;
/// Least number of full periods from which a frequency is determined.
const MIN_PERIODS: u32 = 2;

pub(super) fn scenes() -> Vec<ChartScene> {
    let soft = ChartScene {
        name: "spring_frequency",
        about: "A body swings on a spring of 1 Hz; the springs of rapier and Box2D are implicit, and damp it.",
        sizes: ONE_SIZE,
        build: |_| build(SOFT),
        seconds: SOFT_SECONDS,
        watch: |_| watch_frequency(SOFT),
        error: "error of the frequency, by the period",
        unit: "%",
        // As for a pendulum, an error of 1 % is 1 s in 100 s.
        tolerance: 1.0,
        broad_phases_matter: false,
        peers_too: true,
    };
    let stiff = ChartScene {
        name: "stiff_spring_frequency",
        about: "A body swings on a stiff spring of 8 Hz; those of rapier and Box2D are implicit, and damp it.",
        build: |_| build(STIFF),
        seconds: STIFF_SECONDS,
        watch: |_| watch_frequency(STIFF),
        // A spring this stiff acts like a shock absorber; its frequency is hardly visible.
        tolerance: 5.0,
        ..soft
    };
    vec![
        soft,
        ChartScene {
            name: "spring_amplitude",
            watch: |_| watch_amplitude(SOFT_SECONDS),
            error: "error of the amplitude at the end",
            // After twenty swings a tenth of the amplitude may be lost or gained; every real spring loses more.
            tolerance: 10.0,
            ..soft
        },
        stiff,
        ChartScene {
            name: "stiff_spring_amplitude",
            watch: |_| watch_amplitude(STIFF_SECONDS),
            error: "error of the amplitude at the end",
            // The amplitude must neither grow without bound nor vanish at once; a fifth is not noticed at 8 Hz.
            tolerance: 20.0,
            ..stiff
        },
    ]
}

fn build(frequency: f64) -> Scene {
    let mut stage = weightless("spring");
    let body = stage.body(BOB, [REST_LENGTH + AMPLITUDE, 0.0]);
    let kind = SpringKind::FixedLinear {
        body,
        body_attach_point: vector([0.0, 0.0]),
        world_attach_point: vector([0.0, 0.0]),
    };
    let settings = SpringSettings { rest_length: Some(REST_LENGTH as f32), ..SpringSettings::default() };
    // The stiffness for a mass of 1 kg.
    let spring_constant = (TAU * frequency).powi(2) as f32;
    stage.scene_mut().springs.push(SpringSpec {
        kind,
        spring_constant,
        damping_constant: 0.0,
        settings,
        in_simulation: true,
    });
    stage.done()
}

fn stretch(world: &dyn World) -> f64 {
    world.body(0).position[0] - REST_LENGTH
}

/// Measures the mean period of a swing until the swing is over.
struct SwingPeriod {
    /// Frequency of the swing by the closed form, in Hz.
    frequency: f64,
    period: Period,
    /// Greatest displacement in px since the spring last passed its rest length. `last` is the last
    /// displacement in px.
    widest: f64,
    last: f64,
    /// Time in s at which the displacement last exceeded the least amplitude.
    last_wide: f64,
    is_dead: bool,
}

impl Watch for SwingPeriod {
    fn observe(&mut self, time: f64, world: &dyn World) {
        let stretch = stretch(world);
        if stretch * self.last < 0.0 {
            self.is_dead |= self.widest < MIN_AMPLITUDE_FRACTION * AMPLITUDE;
            self.widest = 0.0;
        }
        self.last = stretch;
        self.widest = self.widest.max(stretch.abs());
        if stretch.abs() > MIN_AMPLITUDE_FRACTION * AMPLITUDE {
            self.last_wide = time;
        }
        // A swing that is over need not pass the middle again; a swing that goes on reaches its amplitude twice per period.
        self.is_dead |= time - self.last_wide > 1.0 / self.frequency;
        if !self.is_dead {
            self.period.take(time, stretch);
        }
    }

    fn error(&self) -> f64 {
        self.period.mean().map_or(f64::NAN, |mean| 100.0 * (mean * self.frequency - 1.0).abs())
    }

    fn failed(&self) -> Option<&'static str> {
        (self.is_dead && self.period.count() < MIN_PERIODS).then_some("died")
    }
}

fn watch_frequency(frequency: f64) -> Box<dyn Watch> {
    let period = Period::default();
    let swing = SwingPeriod { frequency, period, widest: 0.0, last: 0.0, last_wide: 0.0, is_dead: false };
    bounded(Box::new(swing))
}

/// Returns a watch of the error of the amplitude, in percent, in the last 1.5 s of a run of `seconds` s. This interval is
/// longer than a swing of the soft spring. The stiff spring swings so often in it that some step falls near a turning point.
fn watch_amplitude(seconds: f64) -> Box<dyn Watch> {
    let mut farthest = 0.0_f64;
    let error = move |time: f64, world: &dyn World| {
        (time > seconds - 1.5).then(|| {
            farthest = farthest.max(stretch(world).abs());
            100.0 * (farthest / AMPLITUDE - 1.0).abs()
        })
    };
    bounded(last(error))
}

/// Wraps `watch` so that the run also fails when the displacement exceeds twice the initial amplitude.
fn bounded(watch: Box<dyn Watch>) -> Box<dyn Watch> {
    let verdict = |_: f64, world: &dyn World| (stretch(world).abs() > 2.0 * AMPLITUDE).then_some("blew up");
    failing(watch, REACH, verdict)
}
