//! Families of chains and nets: bodies connected by revolute joints. The bodies do not collide.

use super::parts::{SPEED_LIMIT, all, calm, ends_in, joined};
use super::{Moment, SECONDS, StabilityFamily, reasons};
use crate::scenes::movable;
use crate::scenes::stage::{METRE, Stage};
use crate::watch::{Watch, greatest};
use crate::world::World;
use conformance::scene::Scene;

/// Base of families that are judged by the distance between the ends of joints.
const JOINED: StabilityFamily = StabilityFamily {
    judge: stays_joined,
    quantity: "widest gap of a joint in the last fifth",
    ..StabilityFamily::PLAIN
};
/// Simulated time in s of runs that show their subject in less than the usual time.
const SHORT: f64 = 5.0;
/// Greatest distance in px between the ends of a joint that is no failure: a tenth of a metre, which a player sees.
const GAP: f64 = 3.2;

pub(super) const FAMILIES: [StabilityFamily; 5] = [
    StabilityFamily {
        name: "Bridge",
        about: "Planks of 1 m, joined to a chain that is a twentieth longer than the distance between its fixed ends, \
                hang for 10 s; in the last 2 s no joint is open by over a tenth of a metre.",
        parameter: "planks",
        values: &[5.0, 10.0, 20.0, 40.0, 80.0, 160.0],
        quick_values: &[5.0, 20.0, 80.0],
        build: |planks, _| bridge(planks as usize, 0.0),
        ..JOINED
    },
    StabilityFamily {
        name: "Ball and Chain",
        about: "A ball swings on a chain of 10 links of 1 m that begins level; from 8 s to 10 s no joint is open by \
                over a tenth of a metre.",
        parameter: "mass of the ball by that of a link",
        values: &[1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0],
        quick_values: &[1.0, 10.0, 100.0],
        build: |ratio, _| ball_and_chain(ratio as f32),
        ..JOINED
    },
    StabilityFamily {
        name: "Stretched Chain",
        about: "The joints of a hanging chain of 10 links of 1 m begin open by a fraction of a link. They close: \
                from 4 s to 5 s no joint is open by over a tenth of a metre.",
        parameter: "gap, as a share of a link",
        values: &[0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 10.0],
        quick_values: &[0.1, 1.0, 4.0],
        build: |_, _| hanging_chain(LINKS, 1.0),
        act: pull_apart,
        judge: hangs_again,
        seconds: |_| SHORT,
        ..JOINED
    },
    StabilityFamily {
        name: "Joint Grid",
        about: "A square net of discs, 1 m apart, each joined to its neighbours, hangs from its two upper corners for \
                10 s; in the last 2 s no joint is open by over a tenth of a metre.",
        parameter: "discs per row",
        values: &[2.0, 4.0, 6.0, 8.0, 10.0, 15.0, 20.0],
        quick_values: &[2.0, 6.0, 10.0],
        build: |count, _| grid(count as usize),
        ..JOINED
    },
    StabilityFamily {
        name: "Breakable Joint",
        about: "A load hangs on a chain of 3 links whose joints break when they are open by over 2 px. Under every \
                load the chain holds, and no joint breaks in 5 s.",
        parameter: "mass of the load by that of a link",
        values: &[1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0],
        quick_values: &[1.0, 10.0, 100.0],
        build: |ratio, _| breakable(ratio as f32),
        judge: |_, scene| {
            all(vec![calm(scene, SPEED_LIMIT), joined(scene, SHORT, f64::from(METRE), reasons::BROKE)])
        },
        seconds: |_| SHORT,
        ..JOINED
    },
];

/// Returns a watch of joints that must hold for [`SECONDS`](super::SECONDS).
pub(super) fn stays_joined(_: f64, scene: &Scene) -> Box<dyn Watch> {
    let joined = joined(scene, SECONDS, GAP, reasons::STRETCHED);
    all(vec![calm(scene, SPEED_LIMIT), joined])
}

/// Length and width of a link of a chain in px.
const LINK: [f32; 2] = [METRE, METRE / 4.0];
/// Number of links of a hanging chain without its load.
const LINKS: usize = 10;

/// Returns a chain of planks between two fixed points, on an arc of a circle. `centre` is x of the middle in px.
pub(super) fn bridge(planks: usize, centre: f32) -> Scene {
    let mut stage = Stage::new();
    // The chord of an arc of half angle a is sin(a) / a of the arc's length: 5 % shorter for a = 0.5509.
    let half_angle = 0.5509_f32;
    let radius = METRE / 2.0 / (half_angle / planks as f32).sin();
    let at = |joint: usize| {
        let angle = half_angle * (2.0 * joint as f32 / planks as f32 - 1.0);
        [centre + radius * angle.sin(), radius * (angle.cos() - half_angle.cos())]
    };
    let mut before = None;
    for plank in 0..planks {
        let ([x1, y1], [x2, y2]) = (at(plank), at(plank + 1));
        let body = stage.ghost([(x1 + x2) / 2.0, (y1 + y2) / 2.0], LINK, 1.0);
        stage.last().rotation = Some((y2 - y1).atan2(x2 - x1));
        match before {
            Some(before) => stage.hinge(before, body, [x1, y1]),
            None => stage.pivot(body, [x1, y1]),
        }
        before = Some(body);
    }
    if let Some(last) = before {
        stage.pivot(last, at(planks));
    }
    stage.done()
}

fn ball_and_chain(ratio: f32) -> Scene {
    let mut stage = Stage::new();
    let mut before = None;
    for link in 0..LINKS {
        let left = link as f32 * METRE;
        let body = stage.ghost([left + METRE / 2.0, 0.0], LINK, 1.0);
        match before {
            Some(before) => stage.hinge(before, body, [left, 0.0]),
            None => stage.pivot(body, [left, 0.0]),
        }
        before = Some(body);
    }
    let end = LINKS as f32 * METRE;
    let ball = stage.ghost([end + METRE, 0.0], [2.0 * METRE, 2.0 * METRE], ratio);
    if let Some(last) = before {
        stage.hinge(last, ball, [end, 0.0]);
    }
    stage.done()
}

/// Returns a chain that hangs from the origin and whose last link is the load, of `load` kg.
fn hanging_chain(links: usize, load: f32) -> Scene {
    let mut stage = Stage::new();
    for link in 0..links {
        let top = link as f32 * METRE;
        let mass = if link + 1 == links { load } else { 1.0 };
        let body = stage.ghost([0.0, top + METRE / 2.0], [LINK[1], LINK[0]], mass);
        if link == 0 {
            stage.pivot(body, [0.0, top]);
        } else {
            stage.hinge(body - 1, body, [0.0, top]);
        }
    }
    stage.done()
}

fn pull_apart(gap: f64, world: &mut dyn World, moment: Moment) {
    if moment.step == 0 {
        for link in 0..LINKS {
            let metre = f64::from(METRE);
            let top = (link as f64 + (link + 1) as f64 * gap) * metre;
            world.teleport(link, [0.0, top + metre / 2.0], 0.0);
        }
    }
}

/// Returns a watch of a chain whose joints must hold again at the end of the run. The speed of the links is limited at the end
/// alone.
fn hangs_again(_: f64, scene: &Scene) -> Box<dyn Watch> {
    let bodies = movable(scene);
    let fastest = move |world: &dyn World| greatest(world, &bodies, |body| body.speed());
    all(vec![
        calm(scene, f64::INFINITY),
        ends_in(..SPEED_LIMIT, reasons::BLEW_UP, fastest),
        joined(scene, SHORT, GAP, reasons::STRETCHED),
    ])
}

fn grid(count: usize) -> Scene {
    let mut stage = Stage::new();
    for index in 0..count * count {
        let (column, row) = ((index % count) as f32, (index / count) as f32);
        let place = [METRE * column, METRE * row];
        let body = stage.ghost(place, [0.8 * METRE, 0.8 * METRE], 1.0);
        if index % count > 0 {
            stage.hinge(body - 1, body, [place[0] - METRE / 2.0, place[1]]);
        }
        if index >= count {
            stage.hinge(body - count, body, [place[0], place[1] - METRE / 2.0]);
        }
        if index == 0 || index == count - 1 {
            stage.pivot(body, place);
        }
    }
    stage.done()
}

/// Number of links above the load of the breakable chain.
const BREAKABLE: usize = 3;

fn breakable(ratio: f32) -> Scene {
    let mut scene = hanging_chain(BREAKABLE + 1, ratio);
    for joint in &mut scene.joints {
        joint.settings.breakpoint = Some(2.0);
    }
    scene
}
