//! Charts of balls that fall on the ground and bounce.

use super::super::closed_forms::apex;
use super::super::watch::{Maximum, Watch, in_reach, worst};
use super::super::world::World;
use super::build::{GRAVITY, ground, stage};
use super::signals::Peaks;
use super::{ChartScene, ONE_SIZE};
use conformance::scene::Scene;

/// Number of balls. The phase of a landing within a step is chance and affects the error; so several balls fall at once, and
/// the worst one counts.
const BALLS: usize = 8;
const RADIUS: f64 = 16.0;
/// Number of edges of a ball's polygon. One corner points down, so that the ball does not begin to turn.
const EDGES: i32 = 16;
/// Distance from one ball to the next along x, in px: balls never meet.
const SPACING: f64 = 100.0;
/// Index of the first ball among the bodies; the ground is body 0.
const FIRST: usize = 1;
const REACH: f64 = 1e4;
const TEN_THOUSAND_STEPS: f64 = 10_000.0 / 60.0;
/// Greatest fraction of its fall height that a ball may gain, dimensionless.
const MAX_HEIGHT_GAIN: f64 = 0.1;
/// Number of bounces that each ball must have made by the end. The highest ball takes 2.36 s per bounce, and 2.47 s if it has
/// gained the greatest height allowed.
const MANY_BOUNCES: i32 = 65;

pub(super) fn scenes() -> Vec<ChartScene> {
    let bounce = ChartScene {
        name: "bounce_restitution_1",
        about: "Balls that fall from eight heights bounce without loss, five times; the worst one counts.",
        sizes: ONE_SIZE,
        build: |_| build(1.0),
        // The highest ball passes its fifth apex after 11.8 s, or later if it gains height.
        seconds: 15.0,
        watch: |_| watch_apexes(1.0, 5, 15.0),
        error: "error of the height of the bounces",
        unit: "px",
        // A twentieth of the lowest fall height: a jump of a ball that a player knows still looks the same.
        tolerance: 8.0,
        broad_phases_matter: false,
        peers_too: true,
    };
    vec![
        ChartScene {
            name: "bounce_restitution_0",
            about: "Balls fall on the ground and stay there; the worst one counts.",
            build: |_| build(0.0),
            seconds: 3.0,
            watch: |_| watch_rest(),
            error: "height above or depth below the ground after the fall",
            // An error of a pixel looks like rest; a larger one looks like floating or sinking.
            tolerance: 1.0,
            ..bounce
        },
        ChartScene {
            name: "bounce_restitution_half",
            about: "Balls bounce with half their speed, twice; the worst one counts.",
            build: |_| build(0.5),
            // The highest ball passes its second apex after 2.7 s, or later if it gains height.
            seconds: 3.5,
            watch: |_| watch_apexes(0.5, 2, 3.5),
            ..bounce
        },
        bounce,
        ChartScene {
            name: "bounce_10000_steps",
            about: "Balls bounce without loss for 167 s, which are 10,000 steps of 1/60 s; one that gains more than a tenth has failed.",
            seconds: TEN_THOUSAND_STEPS,
            watch: |_| watch_energy(),
            error: "loss of height, or gain",
            unit: "%",
            // After three minutes of bouncing, a ball may have lost or gained a tenth of its height.
            tolerance: 100.0 * MAX_HEIGHT_GAIN,
            ..bounce
        },
    ]
}

/// Returns the fall height of a ball in px, for falls of 1.012 to 1.178 s. No usual step divides these times, and for each step
/// the remainders are spread over the step.
fn fall(ball: usize) -> f64 {
    let time = 1.0 + 0.0237 * (ball as f64 + 0.5);
    GRAVITY * time * time / 2.0
}

fn build(restitution: f64) -> Scene {
    let mut stage = stage("bounce").with_surface(0.0, restitution);
    ground(&mut stage, SPACING * (BALLS + 2) as f64, 0.0);
    for index in 0..BALLS {
        let x = SPACING * (index as f64 - (BALLS - 1) as f64 / 2.0);
        stage.disc([x, -RADIUS - fall(index)], RADIUS, 1.0, EDGES);
    }
    stage.done()
}

/// Returns the height in px of a ball's lowest point above the ground.
fn height(world: &dyn World, ball: usize) -> f64 {
    -world.body(FIRST + ball).position[1] - RADIUS
}

/// Returns the error of an apex, or the reason of a failure. The arguments are the ball's fall height in px, the number of the
/// bounce, from 1, and the height of the apex in px.
type Judge = Box<dyn Fn(f64, i32, f64) -> Result<f64, &'static str>>;

/// Watches the apexes of all balls and keeps the largest error.
struct Apexes {
    peaks: [Peaks; BALLS],
    counts: [i32; BALLS],
    /// Number of apexes that each ball must have reached at the time `due`, in s.
    asked: i32,
    due: f64,
    judge: Judge,
    largest: Maximum,
    failed: Option<&'static str>,
}

impl Apexes {
    fn watched(asked: i32, seconds: f64, judge: Judge) -> Box<dyn Watch> {
        let (peaks, counts, largest) = Default::default();
        // The last observation is up to a step before the end.
        let due = seconds - 0.1;
        let apexes = Apexes { peaks, counts, asked, due, judge, largest, failed: None };
        in_reach(Box::new(apexes), REACH)
    }
}

impl Watch for Apexes {
    fn observe(&mut self, time: f64, world: &dyn World) {
        for ball in 0..BALLS {
            let Some((bounce, peak)) = self.peaks[ball].take(height(world, ball)) else { continue };
            self.counts[ball] = bounce;
            match (self.judge)(fall(ball), bounce, peak) {
                Ok(error) => self.largest.take(error),
                Err(failure) => self.failed = self.failed.or(Some(failure)),
            }
        }
        let too_few = time > self.due && self.counts.iter().any(|&count| count < self.asked);
        self.failed = self.failed.or(too_few.then_some("stopped"));
    }

    fn error(&self) -> f64 {
        if self.failed.is_some() { f64::INFINITY } else { self.largest.get() }
    }

    fn failed(&self) -> Option<&'static str> {
        self.failed
    }
}

fn watch_apexes(restitution: f64, bounces: i32, seconds: f64) -> Box<dyn Watch> {
    let judge = move |fall, bounce, peak: f64| {
        // Bounces after the required number do not count.
        let is_asked = bounce <= bounces;
        Ok(if is_asked { (peak - apex(fall, restitution, bounce)).abs() } else { 0.0 })
    };
    Apexes::watched(bounces, seconds, Box::new(judge))
}

fn watch_rest() -> Box<dyn Watch> {
    // The longest fall takes 1.18 s, and the landing one or two steps.
    let highest = |world: &dyn World| (0..BALLS).map(|ball| height(world, ball).abs()).fold(0.0, f64::max);
    in_reach(worst(move |time, world: &dyn World| (time > 1.3).then(|| highest(world))), REACH)
}

/// Returns a watch of the energy: an apex higher than the fall height by more than a game accepts is a failure.
fn watch_energy() -> Box<dyn Watch> {
    let judge = |fall: f64, _, peak: f64| {
        let gain = peak / fall - 1.0;
        if gain > MAX_HEIGHT_GAIN { Err("gained energy") } else { Ok(100.0 * gain.abs()) }
    };
    Apexes::watched(MANY_BOUNCES, TEN_THOUSAND_STEPS, Box::new(judge))
}
