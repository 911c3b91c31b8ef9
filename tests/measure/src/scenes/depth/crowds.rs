//! Scenes with many objects: a heap, and traffic on a field. A fixed pseudo-random sequence places the objects, so that a
//! scene is always the same.

use farseer_core::Vertices;
use farseer_core::math::Vector2;

use super::{DepthObject, DepthPlatform, DepthScene, DepthShape, SLOPE_ROTATION, Surface};

/// Edge of the cube of space for one object of a heap at the start, px: objects start apart.
const PILE_CELL: f32 = 36.0;
/// Edge of the square of space for one object of the traffic, px.
const TRAFFIC_CELL: f32 = 40.0;
/// Number of cells (squares of `TRAFFIC_CELL` px) along X, and along Z, that share one platform of the traffic.
const CELLS_PER_PLATFORM: usize = 4;
/// Height of the walls of the traffic in px: no object jumps over them.
const WALL_HEIGHT: f32 = 400.0;
/// Thickness of the walls around a heap or the traffic, in px: more than an object moves in one step.
const WALL: f32 = 60.0;

/// A scene in which `count` objects fall into a pit and come to rest in a heap of about four layers. Half of the objects are
/// balls, the others boxes and polygons. Four static walls follow as the last objects.
pub fn pile(count: usize) -> DepthScene {
    const LAYERS: f32 = 4.0;
    let surface = Surface { friction: 0.5, restitution: 0.1 };
    let side = (count as f32 / LAYERS).sqrt().ceil().max(1.0) as usize;
    let mut numbers = Numbers::new(count);
    let mut scene = DepthScene::empty(format!("pile_of_{count}"), 600, surface);
    for index in 0..count {
        let (layer, cell) = (index / (side * side), index % (side * side));
        let [x, z] = place_in_field(cell, side, PILE_CELL);
        let position = [
            x + 2.0 * numbers.next(),
            PILE_CELL * (layer as f32 + 0.5) + numbers.next(),
            z + 2.0 * numbers.next(),
        ];
        scene.objects.push(mixed(index, &mut numbers, position).with_surface(surface));
    }
    let height = PILE_CELL * (count as f32 / (side * side) as f32 + 3.0);
    enclose(scene, side as f32 * PILE_CELL, height.max(3.0 * PILE_CELL), surface)
}

/// A scene in which `count` objects move around on a field with level and sloped platforms and walls, and keep hitting each
/// other. Balls roll; boxes and polygons slide with little friction. The space per object is equal for every count. The objects
/// start above the platforms, so that most land within the first 2 s. Four static walls follow as the last objects.
pub fn traffic(count: usize) -> DepthScene {
    let slippery = Surface { friction: 0.0, restitution: 0.1 };
    let lively = Surface { friction: 0.1, restitution: 0.9 };
    let side = (count as f32).sqrt().ceil().max(1.0) as usize;
    let mut numbers = Numbers::new(count);
    let mut scene = DepthScene::empty(format!("traffic_of_{count}"), 600, slippery);
    for index in 0..count {
        let [x, z] = place_in_field(index, side, TRAFFIC_CELL);
        let position = [x + 5.0 * numbers.next(), 110.0 + 30.0 * numbers.next(), z + 5.0 * numbers.next()];
        let velocity = [90.0 * numbers.next(), 20.0 * numbers.next(), 90.0 * numbers.next()];
        let object = mixed(index, &mut numbers, position).with_surface(lively);
        scene.objects.push(object.with_velocity(velocity));
    }
    let blocks = (side / CELLS_PER_PLATFORM).max(1);
    for index in 0..blocks * blocks {
        let [x, z] = place_in_field(index, blocks, TRAFFIC_CELL * CELLS_PER_PLATFORM as f32);
        scene.platforms.push(platform(index, [x, z], slippery));
    }
    enclose(scene, side as f32 * TRAFFIC_CELL, WALL_HEIGHT, lively)
}

/// Returns one of four platforms, by `index` modulo 4: a bar to pass under, a step to bump into, a slope to the right, a
/// slope to the left. `[x, z]` is its position in px.
fn platform(index: usize, [x, z]: [f32; 2], surface: Surface) -> DepthPlatform {
    let level = |size, height| DepthPlatform::new(size, [x, height, z], surface);
    match index % 4 {
        0 => level([100.0, 12.0, 60.0], 50.0),
        1 => level([80.0, 25.0, 80.0], 0.0),
        2 => DepthPlatform { rotation: SLOPE_ROTATION, ..level([110.0, 12.0, 70.0], 25.0) },
        _ => DepthPlatform { rotation: -SLOPE_ROTATION, ..level([110.0, 12.0, 70.0], 25.0) },
    }
}

/// Returns a ball, a box or a polygon in turn, about 20 px across. Its mass in kg is proportional to the area of the shape
/// in X and Y.
fn mixed(index: usize, numbers: &mut Numbers, position: [f32; 3]) -> DepthObject {
    let size = 10.0 + 2.0 * numbers.next();
    match index % 4 {
        0 | 2 => DepthObject::ball(size, position).with_mass(size * size / 100.0),
        1 => {
            let extents = [2.2 * size, 1.6 * size, 1.8 * size];
            DepthObject::new_box(extents, position).with_mass(extents[0] * extents[1] / 314.0)
        }
        _ => DepthObject::new(DepthShape::Polygon { outline: hexagon(size), depth: 1.5 * size }, position)
            .with_mass(0.83 * size * size / 100.0),
    }
}

/// Returns the corners in px, about the centre, of a regular hexagon that stands on one side. `radius` is the distance from
/// the centre to a corner in px.
fn hexagon(radius: f32) -> Vec<Vector2> {
    const HALF_ROOT_OF_3: f32 = 0.866_025_4;
    let corner = |x: f32, y: f32| Vector2::new(radius * x, radius * y);
    let mut outline = Vertices::from(vec![
        corner(1.0, 0.0),
        corner(0.5, -HALF_ROOT_OF_3),
        corner(-0.5, -HALF_ROOT_OF_3),
        corner(-1.0, 0.0),
        corner(-0.5, HALF_ROOT_OF_3),
        corner(0.5, HALF_ROOT_OF_3),
    ]);
    outline.force_counter_clockwise_order();
    outline.to_vec()
}

/// Returns X and Z in px of the middle of a cell. The field is a square about the origin with `side` cells of `size` px
/// along X and along Z.
fn place_in_field(cell: usize, side: usize, size: f32) -> [f32; 2] {
    let from_centre = |index: usize| size * (index as f32 - (side - 1) as f32 / 2.0);
    [from_centre(cell % side), from_centre(cell / side % side)]
}

/// Adds four static boxes as walls around a square field of `width` px. `height` is that of the walls in px.
fn enclose(scene: DepthScene, width: f32, height: f32, surface: Surface) -> DepthScene {
    let middle = (width + WALL) / 2.0;
    let wall = |size, position| DepthObject::new_box(size, position).with_surface(surface).fixed();
    scene
        .with(wall([WALL, height, width], [-middle, 0.0, 0.0]))
        .with(wall([WALL, height + 0.5, width], [middle, 0.0, 0.0]))
        .with(wall([width + 2.0 * WALL, height + 1.0, WALL], [0.0, 0.0, -middle]))
        .with(wall([width + 2.0 * WALL + 1.0, height + 1.5, WALL], [0.0, 0.0, middle]))
}

/// A pseudo-random sequence: D. Knuth's MMIX linear congruential generator, of which the upper 24 bits are used.
struct Numbers(u64);

impl Numbers {
    fn new(seed: usize) -> Self {
        let mut numbers = Numbers(seed as u64);
        numbers.next();
        numbers
    }

    /// Returns the next pseudo-random number, dimensionless, from -1 to 1.
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / (1 << 23) as f32 - 1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crowds_have_their_objects_and_four_walls() {
        for (scene, count) in [(traffic(20), 20), (traffic(1000), 1000), (pile(40), 40)] {
            let walls = scene.objects.iter().filter(|object| object.is_static).count();
            assert_eq!((scene.objects.len(), walls), (count + 4, 4));
            assert!(scene.objects[..count].iter().all(|object| !object.is_static));
        }
    }

    #[test]
    fn every_field_has_a_platform_and_the_large_ones_about_one_for_sixteen_objects() {
        let platforms = |count| traffic(count).platforms.len();
        assert_eq!((platforms(20), platforms(40), platforms(1000)), (1, 1, 64));
    }

    /// Returns the distances in px from an object's centre to its outermost points along X, Y and Z.
    fn reach(object: &DepthObject) -> [f32; 3] {
        match &object.shape {
            DepthShape::Ball { radius } => [*radius; 3],
            DepthShape::Box { size } => size.map(|extent| extent / 2.0),
            DepthShape::Polygon { outline, depth } => {
                let width = outline.iter().map(|v| v.x).fold(0.0, f32::max);
                let height = outline.iter().map(|v| v.y).fold(0.0, f32::max);
                [width, height, depth / 2.0]
            }
        }
    }

    fn boxes_overlap(a: &DepthObject, b: &DepthObject) -> bool {
        let (reach_a, reach_b) = (reach(a), reach(b));
        let middle = |object: &DepthObject, reach: [f32; 3]| {
            let [x, y, z] = object.position;
            [x, y + reach[1], z]
        };
        let (middle_a, middle_b) = (middle(a, reach_a), middle(b, reach_b));
        (0..3).all(|axis| (middle_a[axis] - middle_b[axis]).abs() < reach_a[axis] + reach_b[axis])
    }

    #[test]
    fn the_objects_of_crowds_start_apart_from_each_other_and_from_the_walls() {
        for scene in [traffic(40), traffic(200), pile(20), pile(200)] {
            for (index, object) in scene.objects.iter().enumerate() {
                let overlaps = |other: &DepthObject| {
                    boxes_overlap(object, other) && !(object.is_static && other.is_static)
                };
                assert!(!scene.objects[..index].iter().any(overlaps), "{} {index}", scene.name);
            }
        }
    }

    #[test]
    fn the_objects_of_traffic_start_above_its_platforms() {
        let scene = traffic(200);
        let lowest = scene.objects.iter().filter(|object| !object.is_static).map(|object| object.position[1]);
        let [sine, cosine] = super::super::SLOPE_SINE_AND_COSINE;
        let tops = scene.platforms.iter().map(|platform| {
            let [width, height, _] = platform.size;
            let half =
                if platform.rotation == 0.0 { height / 2.0 } else { (width * sine + height * cosine) / 2.0 };
            platform.position[1] + height / 2.0 + half
        });
        assert!(lowest.fold(f32::MAX, f32::min) > tops.fold(f32::MIN, f32::max));
    }
}
