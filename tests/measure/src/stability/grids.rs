//! Families of shapes that distance grids or the separating-axis test represent badly.

use super::parts::{SPEED_LIMIT, all, calm, ends_in};
use super::{StabilityFamily, reasons};
use crate::scenes::stage::{METRE, Stage};
use crate::watch::Watch;
use crate::world::{World, distance};
use conformance::scene::{Outline, OutlineForm, Scene};
use farseer_core::math::Vector2;

const FALLS: StabilityFamily = StabilityFamily {
    judge: rests_at_its_height,
    seconds: |_| 5.0,
    quantity: "height of its centre above its resting position",
    ..StabilityFamily::PLAIN
};

pub(super) const FAMILIES: [StabilityFamily; 6] = [
    StabilityFamily {
        name: "Grid Cell, resting box",
        about: "A box of 1 m falls from half a metre on a floor, tilted, both with grids of this cell size, and rests on it. \
                (Cells of a box's tenth are the default.)",
        parameter: "cell, as a share of the box",
        values: &[0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0],
        quick_values: &[0.1, 0.5, 1.0, 2.0],
        build: |cell, _| box_with_cells(cell as f32),
        ..FALLS
    },
    StabilityFamily {
        name: "Concave Notch, cell size",
        about: "A ball of 0.5 m falls into a notch of 1 m by 2 m in a solid block with a grid of this cell size, and \
                rests on its bottom.",
        parameter: "cell, as a share of the notch's width",
        values: &[0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.7, 1.0, 1.5, 2.0],
        quick_values: &[0.1, 0.5, 1.0],
        build: |cell, _| notch(2.0, cell as f32),
        ..FALLS
    },
    StabilityFamily {
        name: "Concave Notch, depth",
        about: "A ball of 0.5 m falls into a notch of 1 m in a solid block and rests on its bottom. (Separating axes \
                know convex outlines only.)",
        parameter: "depth of the notch",
        unit: "px",
        values: &[0.0, 1.6, 3.2, 8.0, 16.0, 32.0, 64.0],
        quick_values: &[0.0, 8.0, 64.0],
        build: |depth, _| notch(depth as f32 / METRE, 0.0),
        ..FALLS
    },
    StabilityFamily {
        name: "Thin Needle, falling flat",
        about: "A needle of 2 m of this thickness falls flat from half a metre and rests on the floor. The floor is \
                thick: however thin the needle is, nothing is expected to fail.",
        parameter: "thickness",
        unit: "px",
        values: &[16.0, 8.0, 4.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01],
        quick_values: &[8.0, 1.0, 0.01],
        build: |thickness, _| needle(thickness as f32),
        ..FALLS
    },
    StabilityFamily {
        name: "Needle on Posts",
        about: "A bar of 4 m by 0.5 m that has corners only falls from half a metre on two posts of this width, and \
                rests on them. The posts have corners too, which meet the bar: however thin they are, nothing is \
                expected to fail.",
        parameter: "width of a post",
        unit: "px",
        values: &[32.0, 16.0, 8.0, 4.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02],
        quick_values: &[32.0, 1.0, 0.02],
        build: |width, _| on_posts(width as f32),
        ..FALLS
    },
    StabilityFamily {
        name: "Crossing Bars",
        about: "An upright bar of 4 m by 8 px begins with its end in a level one that is fixed, or through it, without \
                gravity. It is pushed: after 5 s it has moved by over 1 px. (The grid knows only how deep vertices are.)",
        parameter: "depth of its end below the other bar",
        unit: "px",
        values: &[-6.0, -4.0, -2.0, 0.0, 4.0, 8.0, 16.0, 32.0],
        quick_values: &[-6.0, 0.0, 16.0],
        build: |below, _| crossing(below as f32),
        judge: is_pushed,
        quantity: "distance moved",
        ..FALLS
    },
];

/// Returns a watch of the falling body, which is the last one. It must come to rest at the position of the marker, a body of
/// the scene without a shape.
fn rests_at_its_height(_: f64, scene: &Scene) -> Box<dyn Watch> {
    let last = scene.bodies.len() - 1;
    let rest = scene.bodies[MARKER].position.map_or(0.0, |place| f64::from(place.y));
    let height = move |world: &dyn World| rest - world.body(last).position[1];
    let lowest = height;
    // A tolerance of a tenth of a metre in each direction.
    all(vec![
        calm(scene, SPEED_LIMIT),
        ends_in(-3.2.., reasons::TUNNELLED, lowest),
        ends_in(..3.2, reasons::STUCK, height),
    ])
}

/// Index of the marker: the body without a shape that marks the correct final position.
const MARKER: usize = 0;

/// Returns a scene whose first body is a marker: a static body without a shape at the height `rest` px.
fn marked(rest: f32) -> Stage {
    let mut stage = Stage::new();
    stage.ghost([0.0, rest], [1.0, 1.0], 1.0);
    stage.last().is_static = Some(true);
    stage
}

fn box_with_cells(cell: f32) -> Scene {
    let mut stage = marked(-METRE / 2.0).with_floor(20.0 * METRE);
    stage.last_geom().collision_grid_size = Some(cell * METRE);
    // x is no multiple of the distance between the floor's vertices.
    stage.solid([7.3, -1.3 * METRE], [METRE, METRE]);
    stage.last().rotation = Some(0.4);
    stage.last_geom().collision_grid_size = Some(cell * METRE);
    stage.done()
}

/// Returns a scene with a block of 5 m by 4 m, whose upper side is y = 0 and has a notch of width 1 m. `depth` is the depth of
/// the notch in m, `cell` the size of a distance-grid cell in px.
fn notch(depth: f32, cell: f32) -> Scene {
    let (half, wide, depth) = (METRE / 2.0, 2.5 * METRE, depth * METRE);
    let radius = METRE / 4.0;
    let mut stage = marked(depth - radius);
    let corner = |x: f32, y: f32| Vector2::new(x, y);
    let mut points = vec![corner(-wide, 0.0)];
    if depth > 0.0 {
        points.extend([corner(-half, 0.0), corner(-half, depth), corner(half, depth), corner(half, 0.0)]);
    }
    points.extend([corner(wide, 0.0), corner(wide, 4.0 * METRE), corner(-wide, 4.0 * METRE)]);
    stage.outlined(Outline { form: OutlineForm::Points { points }, subdivide: Some(METRE / 4.0) }, 1.0);
    stage.last().is_static = Some(true);
    stage.last_geom().collision_grid_size = Some(cell * METRE);
    stage.ball([0.0, -1.5 * radius], radius);
    stage.done()
}

fn needle(thickness: f32) -> Scene {
    let mut stage = marked(-thickness / 2.0).with_floor(20.0 * METRE);
    stage.solid([0.0, -METRE / 2.0], [2.0 * METRE, thickness]);
    stage.done()
}

/// Adds a rectangle with four vertices only, centred at `[x, y]` px. Returns the index of its body.
fn bar(stage: &mut Stage, [x, y]: [f32; 2], [width, height]: [f32; 2]) -> usize {
    let (half_width, half_height) = (width / 2.0, height / 2.0);
    let points = [
        [x - half_width, y - half_height],
        [x + half_width, y - half_height],
        [x + half_width, y + half_height],
        [x - half_width, y + half_height],
    ];
    stage.polygon(&points, width * height / (METRE * METRE))
}

fn on_posts(width: f32) -> Scene {
    let height = METRE / 2.0;
    let mut stage = marked(-2.0 * METRE - height / 2.0);
    for x in [-METRE, METRE] {
        bar(&mut stage, [x, 0.0], [width, 4.0 * METRE]);
        stage.last().is_static = Some(true);
    }
    bar(&mut stage, [0.0, -2.5 * METRE - height / 2.0], [4.0 * METRE, height]);
    stage.done()
}

fn crossing(below: f32) -> Scene {
    let mut stage = Stage::without_gravity();
    let [length, thickness] = [4.0 * METRE, 8.0];
    let upright = (thickness - length) / 2.0 + below;
    for (place, width, height) in [([0.0, 0.0], length, thickness), ([21.0, upright], thickness, length)] {
        let corner = |x: f32, y: f32| Vector2::new(place[0] + x * width / 2.0, place[1] + y * height / 2.0);
        let points = vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
        stage.outlined(Outline { form: OutlineForm::Points { points }, subdivide: Some(METRE / 4.0) }, 1.0);
    }
    stage.scene_mut().bodies[0].is_static = Some(true);
    stage.done()
}

fn is_pushed(below: f64, scene: &Scene) -> Box<dyn Watch> {
    let start = [21.0, -60.0 + below];
    let moved = move |world: &dyn World| distance(world.body(1).position_in_plane(), start);
    all(vec![calm(scene, SPEED_LIMIT), ends_in(1.0.., reasons::STUCK, moved)])
}
