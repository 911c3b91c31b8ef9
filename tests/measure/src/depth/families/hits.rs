//! The families of hits: objects fly without gravity past a static post, against its front, or against it along all three
//! axes.

use super::lanes::{ICE, RADIUS, at, each, largest, scene};
use super::{DepthFamily, PLAIN};
use crate::scenes::depth::{DepthObject, DepthScene, Surface};
use crate::stability::reasons::{MISSED, SLOWED, TOUCHED, WRONG_AXIS};
use crate::watch::{Observation, Watch, watch};
use crate::world::{BodyState, World};

/// `POST`: half the extent of the post along X and Y, px; along Z, too, unless a family varies it. `THROWN`: half the extent of
/// the thrown box, px.
const POST: f32 = 20.0;
const THROWN: f32 = 10.0;
/// Height in px of the middle of post and thrown object: far above the ground.
const MIDDLE: f32 = 500.0;
/// The surface of post and thrown object: restitution 1 and no friction, so that the object flies back as fast as it came.
const BOUNCY: Surface = Surface { friction: 0.0, restitution: 1.0 };

pub(super) const FAMILIES: [DepthFamily; 6] =
    [MISS, HIT_FAST, HIT_THIN, HIT_PARTLY, DIAGONAL_FAST, DIAGONAL_CLOSE];

fn post(lane: usize, depth: f32) -> DepthObject {
    let place = at(lane, [0.0, MIDDLE - POST, 0.0]);
    DepthObject::new_box([2.0 * POST, 2.0 * POST, depth], place).fixed().with_surface(BOUNCY)
}

/// Returns the thrown object of a lane. Its middle is at `[x, y, z]` px relative to the middle of the lane's post; `depth`
/// is its extent along Z in px.
fn thrown(is_ball: bool, lane: usize, [x, y, z]: [f32; 3], depth: f32) -> DepthObject {
    let place = at(lane, [x, MIDDLE + y - THROWN, z]);
    let object = match is_ball {
        true => DepthObject::ball(RADIUS, place),
        false => DepthObject::new_box([2.0 * THROWN, 2.0 * THROWN, depth], place),
    };
    object.with_surface(BOUNCY)
}

/// Returns a scene with one of the objects `thrown` and a post of `depth` px along Z in each lane.
fn at_posts(name: &str, depth: f32, thrown: Vec<DepthObject>) -> DepthScene {
    let lanes = thrown.len();
    let mut scene = DepthScene { ground: ICE, objects: thrown, ..scene(name).weightless() };
    scene.objects.extend((0..lanes).map(|lane| post(lane, depth)));
    scene
}

const MISS: DepthFamily = DepthFamily {
    name: "Depth miss",
    about: "Balls and boxes fly by the front and the back of a post, along X at 80 px/s, and must not be touched.",
    parameter: "gap in depth",
    unit: "px",
    values: &[10.0, 1.0, 0.1, 0.01, 1e-3, 1e-4, 1e-5],
    quick_values: &[10.0, 0.1, 1e-3, 1e-5],
    build: |gap, _| {
        let beside = POST + THROWN + gap as f32;
        let thrown = (0..4).map(|lane| {
            let side = if lane % 2 == 0 { -1.0 } else { 1.0 };
            thrown(lane < 2, lane, [-100.0, 0.0, side * beside], 2.0 * THROWN).with_velocity([80.0, 0.0, 0.0])
        });
        at_posts("depth_miss", 2.0 * POST, thrown.collect())
    },
    seconds: |_| 2.5,
    judge: |_, _| {
        each(4, |_, _, _, state: BodyState| {
            let [x, y, z] = state.velocity;
            let change = largest([x - 80.0, y, z]);
            if change > 0.1 { Observation::Failed(TOUCHED, change) } else { Observation::Fine(change) }
        })
    },
    quantity: "largest change of speed",
    quantity_unit: "px/s",
    ..PLAIN
};

/// Number of balls, and of boxes. Each starts a quarter of 1/60 s of flight farther from the post than the one before, so
/// that they hit at four phases of a step.
const PHASES: usize = 4;
/// Duration of the flight of the first object to the post in s.
const FLIGHT: f64 = 0.2;

const HIT_FAST: DepthFamily = DepthFamily {
    name: "Depth hit, fast",
    about: "Balls and boxes fly into the picture against the front of a post of 40 px, at four phases of a step, and \
            must fly back.",
    parameter: "speed",
    unit: "px/s",
    values: &[30.0, 100.0, 300.0, 600.0, 1e3, 1.6e3, 2.4e3, 3.6e3, 5e3, 1e4, 3e4],
    quick_values: &[100.0, 1e3, 2.4e3, 1e4],
    build: |speed, _| against_front(2 * PHASES, speed, 2.0 * POST, 0.0),
    seconds: |_| 2.0 * FLIGHT,
    judge: |speed, _| flies_back(2 * PHASES, speed),
    quantity: "largest difference from the rebound speed",
    quantity_unit: "px/s",
    ..PLAIN
};

const HIT_THIN: DepthFamily = DepthFamily {
    name: "Depth hit, thin",
    about: "Boxes fly at 800 px/s into the picture against a post, and must fly back; both get thinner \
            in depth.",
    parameter: "depth of each",
    unit: "px",
    values: &[40.0, 20.0, 10.0, 7.0, 5.0, 3.0, 2.0, 1.0],
    quick_values: &[40.0, 10.0, 5.0, 1.0],
    build: |depth, _| against_front(PHASES, 800.0, depth as f32, 0.0),
    judge: |_, _| flies_back(PHASES, 800.0),
    ..HIT_FAST
};

const HIT_PARTLY: DepthFamily = DepthFamily {
    name: "Depth hit, glancing",
    about: "Boxes fly at 80 px/s into the picture against the front of a post, with little of them \
            before it, and must fly back.",
    parameter: "box extent in front of the post",
    unit: "px",
    values: &[10.0, 1.0, 0.1, 0.01, 1e-3],
    quick_values: &[10.0, 1.0, 0.1],
    build: |part, _| against_front(PHASES, 80.0, 2.0 * POST, POST + THROWN - part as f32),
    judge: |_, _| flies_back(PHASES, 80.0),
    ..HIT_FAST
};

/// Returns a scene with one object per lane that flies along Z at the front of a post of `depth` px. Lanes 0 to 3 have
/// boxes, all others balls. The object's middle is `beside` px to the left of the post's.
fn against_front(lanes: usize, speed: f64, depth: f32, beside: f32) -> DepthScene {
    let own_depth = depth.min(2.0 * THROWN);
    let thrown = (0..lanes).map(|lane| {
        let is_ball = lane >= PHASES;
        let time = FLIGHT + (lane % PHASES) as f64 / (60.0 * PHASES as f64);
        let half = if is_ball { RADIUS } else { own_depth / 2.0 };
        let z = -(depth / 2.0 + half) - (speed * time) as f32;
        thrown(is_ball, lane, [-beside, 0.0, z], own_depth).with_velocity([0.0, 0.0, speed as f32])
    });
    at_posts("depth_hit", depth, thrown.collect())
}

fn flies_back(lanes: usize, speed: f64) -> Box<dyn Watch> {
    each(lanes, move |_, _, _, state: BodyState| {
        let [x, y, z] = state.velocity;
        let wrong = largest([x, y, z + speed]);
        if z > 0.9 * speed {
            Observation::Open(MISSED, wrong)
        } else if (z + speed).abs() > 0.05 * speed {
            Observation::Open(SLOWED, wrong)
        } else if largest([x, y]) > 0.05 * speed {
            Observation::Open(WRONG_AXIS, wrong)
        } else {
            Observation::Ends(wrong)
        }
    })
}

/// Distance in px that a box flies along its first axis from the time it enters that axis until it enters the second one. A
/// box enters an axis when the extents of box and post begin to overlap along it. At 22 px no corner is near.
const BEFORE_SECOND: f64 = 22.0;

const DIAGONAL_FAST: DepthFamily = DepthFamily {
    name: "Diagonal hit, fast",
    about: "Boxes fly at a post along all three axes at once, equally fast. They must be thrown back along the \
            axis along which they reach it last, by 10 px: X, Y or Z.",
    parameter: "speed along each axis",
    unit: "px/s",
    values: &[100.0, 300.0, 600.0, 1e3, 1.6e3, 2.4e3, 3.6e3, 5e3],
    quick_values: &[100.0, 1e3, 2.4e3, 5e3],
    build: |speed, _| diagonal([speed; 3], 10.0, FLIGHT),
    seconds: |_| 2.0 * FLIGHT,
    judge: |speed, _| thrown_back_along_last([speed; 3]),
    quantity: "largest part of the speed that changed along another axis",
    quantity_unit: "",
    ..PLAIN
};

/// Speeds in px/s of a box in a diagonal hit, along the axis in which it reaches the post last, second and first.
const UNEQUAL: [f64; 3] = [150.0, 75.0, 50.0];
/// Duration in s of a flight at the speeds `UNEQUAL`: long enough for the box to start outside of the post in all axes.
const LONG_FLIGHT: f64 = 1.0;

const DIAGONAL_CLOSE: DepthFamily = DepthFamily {
    name: "Diagonal hit, close",
    about: "Boxes fly at a post along all three axes, at 150 px/s along the last axis, 75 and 50 along the others. When \
            they reach the other two, less and less distance is left along the last; they must be thrown back along it.",
    parameter: "distance left along the last axis",
    unit: "px",
    values: &[50.0, 20.0, 10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1],
    quick_values: &[50.0, 10.0, 2.0, 0.5],
    build: |way, _| diagonal(UNEQUAL, way, LONG_FLIGHT),
    seconds: |_| LONG_FLIGHT + 0.2,
    judge: |_, _| thrown_back_along_last(UNEQUAL),
    ..DIAGONAL_FAST
};

/// Orders in which a box reaches the extent of the post along the axes (0 = X, 1 = Y, 2 = Z): last, second and first. The
/// last or the second axis is always Z; the 2D engine alone would decide between X and Y.
const ORDERS: [[usize; 3]; 4] = [[0, 2, 1], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
/// Number of lanes of a diagonal hit: each entry of `ORDERS`, from the negative and from the positive side.
const DIAGONALS: usize = 2 * ORDERS.len();

/// Returns the velocity in px/s, along X, Y and Z, of the box in a lane of a diagonal hit. `speeds` are those along the
/// axis in which the box reaches the extent of the post last, second and first; `ORDERS` names these axes.
fn velocity_of(lane: usize, speeds: [f64; 3]) -> [f64; 3] {
    let side = if lane < ORDERS.len() { 1.0 } else { -1.0 };
    let mut velocity = [0.0; 3];
    for (axis, speed) in ORDERS[lane % ORDERS.len()].into_iter().zip(speeds) {
        velocity[axis] = side * speed;
    }
    velocity
}

/// Returns a scene of boxes that fly at posts along all three axes. A box reaches the extent of the post along the last
/// axis after `flight` s, along the second when it has `way` px to go along the last, and along the first before that.
fn diagonal(speeds: [f64; 3], way: f64, flight: f64) -> DepthScene {
    let [last, ..] = speeds;
    let thrown = (0..DIAGONALS).map(|lane| {
        let velocity = velocity_of(lane, speeds);
        let mut place = [0.0; 3];
        let second = flight - way / last;
        let first = second - BEFORE_SECOND / speeds[2];
        for (axis, time) in ORDERS[lane % ORDERS.len()].into_iter().zip([flight, second, first]) {
            place[axis] =
                -(velocity[axis] * time + velocity[axis].signum() * f64::from(POST + THROWN)) as f32;
        }
        thrown(false, lane, place, 2.0 * THROWN).with_velocity(velocity.map(|part| part as f32))
    });
    at_posts("diagonal_hit", 2.0 * POST, thrown.collect())
}

/// Returns a watch that checks the first change of each box's velocity. It must be along the axis in which the box reached
/// the extent of the post last.
fn thrown_back_along_last(speeds: [f64; 3]) -> Box<dyn Watch> {
    let mut first_changes: [Option<[f64; 3]>; DIAGONALS] = [None; DIAGONALS];
    watch(move |_, world: &dyn World| {
        let mut seen = Observation::Ends(0.0);
        for (lane, first_change) in first_changes.iter_mut().enumerate() {
            let (before, now) = (velocity_of(lane, speeds), world.body(lane).velocity);
            let change: [f64; 3] =
                std::array::from_fn(|axis| ((now[axis] - before[axis]) / before[axis]).abs());
            if first_change.is_none() && largest(change) > 0.02 {
                *first_change = Some(change);
            }
            let of_lane = first_change.map_or(Observation::Open(MISSED, 1.0), |change| {
                let [_, second, first] = ORDERS[lane % ORDERS.len()];
                let others = change[second].max(change[first]);
                if others > 0.02 {
                    Observation::Failed(WRONG_AXIS, others)
                } else {
                    Observation::Ends(others)
                }
            });
            seen = seen.and(of_lane);
        }
        Some(seen)
    })
}
