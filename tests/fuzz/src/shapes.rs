//! Random outlines, and random poses of geoms on bodies.

use farseer_core::math::Vector2;
use farseer_core::{GeomPlacement, Result, Vertices};

use crate::random::Random;

/// Greatest number of edges of most outlines. With more edges distance grids, tests with separating axes and the saves after
/// every call take too long.
const MOST_EDGES: i32 = 100;
/// Smallest cell of most distance grids, length units. Grids with smaller cells take too long.
const FINEST_CELL: f32 = 0.3;
/// Coordinates, in length units, for outlines in which coincident and collinear corners are frequent.
const COARSE: [f32; 5] = [0.0, 5.0, 10.0, -5.0, -10.0];

type Make = fn(&mut Random) -> Result<Vertices>;

const OUTLINES: &[Make] = &[
    |random| Vertices::create_rectangle(random.number(1.0, 40.0), random.number(1.0, 40.0)),
    |random| Vertices::create_simple_rectangle(random.number(1.0, 40.0), random.number(1.0, 40.0)),
    |random| Vertices::create_circle(random.number(1.0, 20.0), edges(random, 3, 20)),
    |random| {
        Vertices::create_ellipse(random.number(1.0, 20.0), random.number(1.0, 20.0), edges(random, 3, 20))
    },
    |random| {
        let (radius, teeth) = (random.number(5.0, 20.0), edges(random, 3, 9).min(500));
        Vertices::create_gear(radius, teeth, random.number(0.0, 1.0), random.number(1.0, 8.0))
    },
    |random| {
        let (height, radius) = (random.number(10.0, 40.0), random.number(1.0, 5.0));
        Vertices::create_capsule(height, radius, edges(random, 2, 9).min(500))
    },
    |random| {
        let (height, top) = (random.number(10.0, 40.0), random.number(1.0, 5.0));
        let (top_edges, bottom_edges) = (edges(random, 2, 9).min(500), edges(random, 2, 9).min(500));
        Vertices::create_capsule_ends(height, top, top_edges, random.number(1.0, 5.0), bottom_edges)
    },
    |random| Ok((0..random.below(12)).map(|_| random.vector(20.0)).collect()),
    |random| {
        let corner = |random: &mut Random| Vector2::new(random.pick(&COARSE), random.pick(&COARSE));
        Ok((0..3 + random.below(6)).map(|_| corner(random)).collect())
    },
];

/// Returns the points of a chain: a walk to the right or the left, the points of an outline, or any points. Some chains are
/// closed.
pub(crate) fn chain(random: &mut Random) -> Vec<Vector2> {
    let mut points = match random.below(3) {
        0 => walk(random),
        1 => outline(random).iter().copied().collect(),
        _ => (0..random.below(12)).map(|_| random.vector(100.0)).collect(),
    };
    if random.toss() {
        points.reverse();
    }
    if random.chance(30) {
        points.extend(points.first().copied());
    }
    points
}

fn walk(random: &mut Random) -> Vec<Vector2> {
    let mut point = Vector2::new(-150.0, 0.0);
    let step = |_| {
        point += Vector2::new(random.number(1.0, 60.0), random.number(-20.0, 20.0));
        point
    };
    (0..12).map(step).collect()
}

/// Draws a number of edges in `low..=high`, or a wild one, but at most [`MOST_EDGES`].
pub(crate) fn edges(random: &mut Random, low: i32, high: i32) -> i32 {
    random.count(low, high).min(MOST_EDGES)
}

/// Returns a random outline. It has no points if its arguments were refused.
pub(crate) fn outline(random: &mut Random) -> Vertices {
    random.pick(OUTLINES)(random).unwrap_or_default()
}

/// Returns a random pose of a geom on a body, with a random cell size of the distance grid.
pub(crate) fn placement(random: &mut Random) -> GeomPlacement {
    let mut placement = GeomPlacement::default();
    if random.chance(30) {
        placement.offset = random.vector(10.0);
    }
    if random.chance(30) {
        placement.rotation_offset = random.number(-4.0, 4.0);
    }
    if random.chance(30) {
        placement.collision_grid_size = cell_size(random);
    }
    placement
}

fn cell_size(random: &mut Random) -> f32 {
    let size = random.number(0.5, 5.0);
    let is_fine = size > 0.0 && size < FINEST_CELL;
    if is_fine && random.chance(95) { 0.0 } else { size }
}

/// Draws the length of a step in s. It is 0.01 in most cases, and may be wild, zero or negative.
pub(crate) fn step(random: &mut Random) -> f32 {
    match random.below(12) {
        0 => random.wild_number(),
        1 => 0.0,
        2 => -0.01,
        3 => 1.0,
        4 => 1e-6,
        5 => random.between(0.0, 0.1),
        _ => 0.01,
    }
}
