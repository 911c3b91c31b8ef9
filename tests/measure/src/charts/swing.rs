//! Charts of pendulums and chains.

use super::super::closed_forms::pendulum_period;
use super::super::watch::{Watch, in_reach, last, worst};
use super::super::world::{World, masses, turned};
use super::build::{GRAVITY, stage, start};
use super::invariants::energy;
use super::signals::Period;
use super::{ChartScene, ONE_SIZE};
use crate::scenes::stage::vector;
use conformance::scene::{BodyShape, JointKind, JointSpec, Scene};

/// Distance from the pivot to the centre of the bob in px.
const LENGTH: f64 = 160.0;
const BOB: BodyShape = BodyShape::Circle { radius: 16.0, mass: 1.0 };
/// Length of a chain's link from joint to joint, in px.
const LINK: f64 = 16.0;
const TIE_BREADTH: f32 = 4.0;

pub(super) fn scenes() -> Vec<ChartScene> {
    let narrow = ChartScene {
        name: "pendulum_narrow",
        about: "A pendulum swings 5 degrees to each side.",
        sizes: ONE_SIZE,
        build: |_| pendulum(5.0_f64.to_radians()),
        seconds: 20.0,
        watch: |scene| watch_period(scene, 5.0_f64.to_radians()),
        error: "error of the period",
        unit: "%",
        // An error of 1 % is 1 s in 100 s: players judge the timing of swinging ropes by eye.
        tolerance: 1.0,
        broad_phases_matter: false,
        peers_too: true,
    };
    vec![
        narrow,
        ChartScene {
            name: "pendulum_wide",
            about: "A pendulum swings 120 degrees to each side, against its exact period.",
            build: |_| pendulum(120.0_f64.to_radians()),
            watch: |scene| watch_period(scene, 120.0_f64.to_radians()),
            ..narrow
        },
        ChartScene {
            name: "double_pendulum",
            about: "A double pendulum that starts level keeps its energy.",
            build: |_| double_pendulum(),
            seconds: 10.0,
            watch: watch_energy,
            error: "largest change of energy",
            // A tenth of the energy in ten seconds; real pendulums lose as much.
            tolerance: 10.0,
            ..narrow
        },
        ChartScene {
            name: "chain",
            about: "A chain of links hangs from one end and swings down from 30 degrees below level.",
            sizes: &[5, 20, 200, 2000],
            build: chain,
            seconds: 5.0,
            watch: watch_gaps,
            error: "largest gap in a joint",
            unit: "px",
            // The gap of a joint is at most a tenth of a link: less than the width of the links, so it is not visible.
            tolerance: LINK / 10.0,
            ..narrow
        },
    ]
}

/// Returns the position in px at the distance `length` px from the origin, at `angle` radians from straight down.
fn hanging(length: f64, angle: f64) -> [f64; 2] {
    [length * angle.sin(), length * angle.cos()]
}

fn pendulum(amplitude: f64) -> Scene {
    let mut stage = stage("pendulum");
    let body = stage.body(BOB, hanging(LENGTH, amplitude));
    stage.joint(JointKind::FixedRevolute { body, anchor: vector([0.0, 0.0]) });
    stage.done()
}

fn double_pendulum() -> Scene {
    let mut stage = stage("double_pendulum");
    let body1 = stage.body(BOB, [LENGTH, 0.0]);
    let body2 = stage.body(BOB, [2.0 * LENGTH, 0.0]);
    stage.joint(JointKind::FixedRevolute { body: body1, anchor: vector([0.0, 0.0]) });
    stage.joint(JointKind::Revolute { body1, body2, anchor: vector([LENGTH, 0.0]) });
    stage.done()
}

fn chain(count: usize) -> Scene {
    let mut stage = stage(format!("chain_of_{count}"));
    let angle = 60.0_f64.to_radians();
    let link = BodyShape::Rectangle { width: TIE_BREADTH, height: LINK as f32, mass: 1.0 };
    for index in 0..count {
        let top = LINK * index as f64;
        // The link is long along the chain: its rotation on the screen has the opposite sign of the angle from straight down.
        let body2 = stage.body(link.clone(), hanging(top + LINK / 2.0, angle));
        stage.last().rotation = Some(-angle as f32);
        let anchor = vector(hanging(top, angle));
        stage.joint(match index.checked_sub(1) {
            None => JointKind::FixedRevolute { body: body2, anchor },
            Some(body1) => JointKind::Revolute { body1, body2, anchor },
        });
    }
    stage.done()
}

fn watch_period(scene: &Scene, amplitude: f64) -> Box<dyn Watch> {
    let mass = masses(scene)[0];
    let law = pendulum_period(GRAVITY, mass.mass, LENGTH, mass.inertia, amplitude);
    let mut period = Period::default();
    let error = move |time: f64, world: &dyn World| {
        let [x, y] = world.body(0).position_in_plane();
        period.take(time, x.atan2(y));
        Some(100.0 * (period.mean()? / law - 1.0).abs())
    };
    in_reach(last(error), 1e4)
}

fn watch_energy(scene: &Scene) -> Box<dyn Watch> {
    let masses = masses(scene);
    // Depth of the fall from level to hanging: the first bob falls one length, the second two lengths.
    let depth = LENGTH * (masses[0].mass + 2.0 * masses[1].mass);
    let scale = GRAVITY * depth;
    let mut first = None;
    let error = move |_: f64, world: &dyn World| {
        let energy = energy(&masses, GRAVITY, world);
        let change = energy - *first.get_or_insert(energy);
        Some(100.0 * change.abs() / scale)
    };
    in_reach(worst(error), 1e4)
}

/// A revolute joint of two bodies, or of a body and the world (`None`). `ends` holds the body's index and the anchor in the
/// body's coordinates, px.
struct Hinge {
    ends: [Option<(usize, [f64; 2])>; 2],
    anchor: [f64; 2],
}

fn hinges(scene: &Scene) -> Vec<Hinge> {
    let end = |index: usize, anchor: [f64; 2]| {
        let (start, turn) = (start(scene, index), scene.bodies[index].rotation.unwrap_or(0.0));
        (index, turned([anchor[0] - start[0], anchor[1] - start[1]], -f64::from(turn)))
    };
    let hinge = |joint: &JointSpec| {
        let (one, other, anchor) = match joint.kind {
            JointKind::Revolute { body1, body2, anchor } => (Some(body1), body2, anchor),
            JointKind::FixedRevolute { body, anchor } => (None, body, anchor),
            _ => return None,
        };
        let anchor = [f64::from(anchor.x), f64::from(anchor.y)];
        let ends = [one.map(|one| end(one, anchor)), Some(end(other, anchor))];
        Some(Hinge { ends, anchor })
    };
    scene.joints.iter().filter_map(hinge).collect()
}

fn watch_gaps(scene: &Scene) -> Box<dyn Watch> {
    let hinges = hinges(scene);
    let reach = 10.0 * LINK * (scene.bodies.len() as f64 + 10.0);
    let gap = move |_: f64, world: &dyn World| {
        let gap = |hinge: &Hinge| {
            let [one, other] = hinge.ends.map(|end| match end {
                None => hinge.anchor,
                Some((index, local)) => world.body(index).to_world(local),
            });
            (one[0] - other[0]).hypot(one[1] - other[1])
        };
        Some(hinges.iter().map(gap).fold(0.0, f64::max))
    };
    in_reach(worst(gap), reach)
}
