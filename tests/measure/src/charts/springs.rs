//! A body on a spring without damping.

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
/// In Hz.
const SOFT: f64 = 1.0;
/// In Hz. With ω dt = 0.84 at 1/60 s well inside of what explicit springs bear (2), and 1.7 at 1/30 s near the limit.
const STIFF: f64 = 8.0;
const SOFT_SECONDS: f64 = 20.0;
const STIFF_SECONDS: f64 = 5.0;
const REACH: f64 = 1e4;
/// A swing within this share of its first amplitude is none any more: what it does there is noise.
const DEAD: f64 = 0.05;
/// Fewer whole periods than this tell nothing of a frequency.
const FEWEST_PERIODS: u32 = 2;

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
        // As of a pendulum: a second in a minute and a half.
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
        // Such a spring is felt as a shock absorber; its pitch is hardly seen.
        tolerance: 5.0,
        ..soft
    };
    vec![
        soft,
        ChartScene {
            name: "spring_amplitude",
            watch: |_| watch_amplitude(SOFT_SECONDS),
            error: "error of the amplitude at the end",
            // After twenty swings a tenth may be lost or gained; every real spring loses more.
            tolerance: 10.0,
            ..soft
        },
        stiff,
        ChartScene {
            name: "stiff_spring_amplitude",
            watch: |_| watch_amplitude(STIFF_SECONDS),
            error: "error of the amplitude at the end",
            // It must not grow without bound or die at once; a fifth is not noticed at this pitch.
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
    // Of a mass of 1.
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

/// Watches the period for as long as there is a swing.
struct SwingPeriod {
    /// By the law, in Hz.
    frequency: f64,
    period: Period,
    /// The widest since it last passed the middle, in px, and where it is.
    widest: f64,
    last: f64,
    /// When it was last seen wide.
    last_wide: f64,
    is_dead: bool,
}

impl Watch for SwingPeriod {
    fn see(&mut self, time: f64, world: &dyn World) {
        let stretch = stretch(world);
        if stretch * self.last < 0.0 {
            self.is_dead |= self.widest < DEAD * AMPLITUDE;
            self.widest = 0.0;
        }
        self.last = stretch;
        self.widest = self.widest.max(stretch.abs());
        if stretch.abs() > DEAD * AMPLITUDE {
            self.last_wide = time;
        }
        // What swings no more never passes the middle; a swing is wide twice in a period.
        self.is_dead |= time - self.last_wide > 1.0 / self.frequency;
        if !self.is_dead {
            self.period.take(time, stretch);
        }
    }

    fn error(&self) -> f64 {
        self.period.mean().map_or(f64::NAN, |mean| 100.0 * (mean * self.frequency - 1.0).abs())
    }

    fn failed(&self) -> Option<&'static str> {
        (self.is_dead && self.period.count() < FEWEST_PERIODS).then_some("died")
    }
}

fn watch_frequency(frequency: f64) -> Box<dyn Watch> {
    let period = Period::default();
    let swing = SwingPeriod { frequency, period, widest: 0.0, last: 0.0, last_wide: 0.0, is_dead: false };
    bounded(Box::new(swing))
}

/// Watches the amplitude in the last second and a half: more than one swing, and of the stiff spring so many that
/// some step falls near a turning point.
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

/// Another watch, in which a swing that has grown to twice its amplitude has failed: it goes on to grow.
fn bounded(watch: Box<dyn Watch>) -> Box<dyn Watch> {
    let verdict = |_: f64, world: &dyn World| (stretch(world).abs() > 2.0 * AMPLITUDE).then_some("blew up");
    failing(watch, REACH, verdict)
}
