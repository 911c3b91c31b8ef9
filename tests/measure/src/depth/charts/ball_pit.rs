//! A chart's scene in 2.5D: balls fall into a pit and come to rest.

use super::{DepthChartScene, SIZES};
use crate::scenes::depth::{DepthObject, DepthPlatform, DepthScene, DepthShape, Surface};
use crate::watch::{Observation, Watch, watch};
use crate::world::{World, distance};

/// Number of layers of balls at the start.
const LAYERS: f32 = 4.0;
/// Edge of the cube of space for one ball at the start, px.
const CELL: f32 = 24.0;
/// Thickness of the walls in px. It is more than a ball moves in a step.
const WALL: f32 = 60.0;
/// `END`: simulated time in s. `REST`: time in s from which on the balls should be at rest.
const END: f64 = 8.0;
const REST: f64 = 7.0;

pub(super) const SCENES: [DepthChartScene; 2] = [PENETRATION, SPEED];

const PENETRATION: DepthChartScene = DepthChartScene {
    name: "ball_pit_penetration",
    about: "Balls fall into a pit and lie in it; the largest penetration of two balls, or of a ball and the pit.",
    sizes: SIZES,
    build: ball_pit,
    seconds: END,
    watch: |scene| {
        let pit = Pit::of(scene);
        resting(scene, move |balls| pit.largest_overlap(balls))
    },
    error: "largest penetration in the last second",
    unit: "px",
    // A tenth of a ball's radius (10 px): an overlap of less than a pixel is invisible.
    tolerance: 1.0,
    broad_phases_matter: false,
    peers_too: true,
};

const SPEED: DepthChartScene = DepthChartScene {
    name: "ball_pit_speed",
    about: "Balls fall into a pit; their speeds at a time when they should be at rest.",
    watch: |scene| resting(scene, |balls| root_mean_square(balls.iter().map(|ball| ball.speed))),
    error: "root mean square of the speeds in the last second",
    unit: "px/s",
    // 2 px/s is a fifth of a ball's radius per second: the ball appears at rest.
    tolerance: 2.0,
    ..PENETRATION
};

/// Returns a scene of `count` balls with radii of about 10 px, in four layers above a pit of four walls.
fn ball_pit(count: usize) -> DepthScene {
    let surface = Surface { friction: 0.5, restitution: 0.1 };
    let side = (count as f32 / LAYERS).sqrt().ceil().max(1.0) as usize;
    let mut scene = DepthScene::empty(format!("ball_pit_of_{count}"), 800, surface);
    let from_middle = |index: usize| CELL * (index as f32 - (side - 1) as f32 / 2.0);
    for index in 0..count {
        let (layer, cell) = (index / (side * side), index % (side * side));
        let radius = 10.0 + vary(index, 1);
        let position = [
            from_middle(cell % side) + 0.9 * vary(index, 2),
            CELL * (layer as f32 + 0.5) + 0.5 * vary(index, 3),
            from_middle(cell / side) + 0.9 * vary(index, 4),
        ];
        let ball = DepthObject::ball(radius, position).with_mass(radius * radius / 100.0);
        scene.objects.push(ball.with_surface(surface));
    }
    enclose(scene, CELL * side as f32, CELL * (LAYERS + 3.0), surface)
}

/// Adds four platforms as walls around a square field of `width` px: platforms are equal for all methods. `height` is that
/// of the walls in px.
fn enclose(scene: DepthScene, width: f32, height: f32, surface: Surface) -> DepthScene {
    let middle = (width + WALL) / 2.0;
    let wall = |size, [x, z]: [f32; 2]| DepthPlatform::new(size, [x, 0.0, z], surface);
    let across = [WALL, height, width + 2.0 * WALL];
    let along = [width, height, WALL];
    scene
        .with_platform(wall(across, [-middle, 0.0]))
        .with_platform(wall(across, [middle, 0.0]))
        .with_platform(wall(along, [0.0, -middle]))
        .with_platform(wall(along, [0.0, middle]))
}

/// Returns a number between -1 and 1, dimensionless, that differs for every index: the fractional part of a multiple of an
/// irrational number. `sequence` selects the irrational number.
fn vary(index: usize, sequence: usize) -> f32 {
    let step = [0.856_674_883, 0.733_891_856, 0.628_706_724, 0.538_597_253][sequence - 1];
    (((index + 1) as f64 * step).fract() * 2.0 - 1.0) as f32
}

/// Centre, radius and speed of a ball at one moment.
#[derive(Debug, Clone, Copy)]
struct Ball {
    middle: [f64; 3],
    radius: f64,
    speed: f64,
}

/// The dimensions of the pit.
#[derive(Debug, Clone, Copy)]
struct Pit {
    /// Half the inner extent of the pit along X and along Z, px.
    half: f64,
}

impl Pit {
    fn of(scene: &DepthScene) -> Self {
        let [first, ..] = &scene.platforms[..] else { return Pit { half: f64::INFINITY } };
        Pit { half: f64::from(-first.position[0] - first.size[0] / 2.0) }
    }

    /// Returns the greatest penetration of a ball into another ball, the ground or a wall, px.
    fn largest_overlap(&self, balls: &[Ball]) -> f64 {
        let mut sorted: Vec<&Ball> = balls.iter().collect();
        sorted.sort_by(|a, b| left(a).total_cmp(&left(b)));
        let mut largest = sorted.iter().map(|ball| self.overlap_with_pit(ball)).fold(0.0, f64::max);
        for (index, ball) in sorted.iter().enumerate() {
            let right = ball.middle[0] + ball.radius;
            for other in sorted[index + 1..].iter().take_while(|other| left(other) < right) {
                let apart = distance(ball.middle, other.middle);
                largest = largest.max(ball.radius + other.radius - apart);
            }
        }
        largest
    }

    fn overlap_with_pit(&self, ball: &Ball) -> f64 {
        let [x, y, z] = ball.middle;
        (x.abs() + ball.radius - self.half).max(z.abs() + ball.radius - self.half).max(ball.radius - y)
    }

    /// Returns whether the centre of a ball is outside of the pit.
    fn has_lost(&self, ball: &Ball) -> bool {
        let [x, y, z] = ball.middle;
        x.abs() > self.half || z.abs() > self.half || y < 0.0
    }
}

fn left(ball: &Ball) -> f64 {
    ball.middle[0] - ball.radius
}

/// Returns a watch that applies `measure` to all balls once they should be at rest. The run fails if a ball has left the
/// pit.
fn resting(scene: &DepthScene, measure: impl Fn(&[Ball]) -> f64 + 'static) -> Box<dyn Watch> {
    let pit = Pit::of(scene);
    let radius = |object: &DepthObject| match object.shape {
        DepthShape::Ball { radius } => f64::from(radius),
        _ => 0.0,
    };
    let radii: Vec<f64> = scene.objects.iter().map(radius).collect();
    watch(move |time, world: &dyn World| {
        let balls: Vec<Ball> =
            radii.iter().enumerate().map(|(index, &radius)| ball(world, index, radius)).collect();
        if balls.iter().any(|ball| pit.has_lost(ball)) {
            return Some(Observation::Failed("left the pit", f64::INFINITY));
        }
        (time >= REST).then(|| Observation::Fine(measure(&balls)))
    })
}

fn ball(world: &dyn World, index: usize, radius: f64) -> Ball {
    let state = world.body(index);
    let [x, lowest, z] = state.position;
    Ball { middle: [x, lowest + radius, z], radius, speed: state.speed() }
}

fn root_mean_square(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len().max(1) as f64;
    (values.map(|value| value * value).sum::<f64>() / count).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn balls(scene: &DepthScene) -> Vec<Ball> {
        let ball = |object: &DepthObject| match object.shape {
            DepthShape::Ball { radius } => {
                let [x, y, z] = object.position.map(f64::from);
                let radius = f64::from(radius);
                Ball { middle: [x, y + radius, z], radius, speed: 0.0 }
            }
            _ => panic!("{object:?} is no ball"),
        };
        scene.objects.iter().map(ball).collect()
    }

    #[test]
    fn the_balls_of_a_pit_start_apart_and_inside() {
        for count in [5, 20, 200, 2000] {
            let scene = ball_pit(count);
            assert_eq!(scene.objects.len(), count);
            let pit = Pit::of(&scene);
            assert_eq!(pit.largest_overlap(&balls(&scene)), 0.0, "{count}");
        }
    }

    #[test]
    fn the_deepest_overlap_is_that_of_the_nearest_pair_or_of_a_wall() {
        let pit = Pit { half: 100.0 };
        let ball = |x: f64, y: f64, z: f64| Ball { middle: [x, y, z], radius: 10.0, speed: 0.0 };
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} is not {b}");
        // The centres are 3, 4 and 12 px apart along the axes: 13 px, where the radii add up to 20 px.
        near(pit.largest_overlap(&[ball(0.0, 50.0, 0.0), ball(3.0, 54.0, 12.0)]), 7.0);
        near(pit.largest_overlap(&[ball(0.0, 50.0, 0.0), ball(-92.0, 50.0, 0.0)]), 2.0);
        near(pit.largest_overlap(&[ball(0.0, 50.0, 95.0)]), 5.0);
        near(pit.largest_overlap(&[ball(0.0, 6.0, 0.0)]), 4.0);
    }
}
