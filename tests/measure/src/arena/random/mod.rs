//! Random scenes beside the peers: a guard against an engine that is good at known scenes alone.
//!
//! A seed alone determines a scene: a closed room with items of one to four kinds, such as loose bodies, walls, chains, nets,
//! ragdolls, carts, and kinematic movers. [`play::play`] runs it in all engines, and [`flags::flags`] compares them.

pub mod flags;
mod items;
mod parts;
pub mod play;

use super::scene::{Action, Body, Form, Kind, Limits, Point, Scene, Shape};
use crate::joints::random::Random;
use items::{Item, item_kinds};
use parts::Style;

/// Number of steps of a run.
const STEPS: usize = 360;
/// Least and greatest number of dynamic bodies. The last item may exceed the greatest number.
const BODIES: [f32; 2] = [20.0, 3000.0];
/// Thickness of the walls of a room in m. The fastest bodies move 1.7 m in a step.
const WALL: f32 = 1.0;

/// The scene of a seed.
#[expect(missing_debug_implementations, reason = "scenes have none")]
pub struct RandomScene {
    /// Seed of the scene.
    pub seed: u64,
    /// The scene; its limits bound the room, and the speed in m/s above which a body counts as exploding.
    pub scene: Scene,
    /// Names of the kinds of items and other features, separated by `+`.
    pub kinds: String,
    /// Whether motors, springs or kinematic bodies can add energy.
    pub is_driven: bool,
}

/// Returns the scene of a seed: equal seeds give equal scenes.
pub fn random_scene(seed: u64) -> RandomScene {
    let mut random = Random::new(seed);
    let style = Style::draw(&mut random);
    let (mut items, mut kinds) = draw_items(&mut random, &style);
    // Items that stand on the floor come first, since the first row is the lowest.
    items.sort_by_key(|item| !item.stands);
    let (places, size) = arrange(&items, &mut random);
    let is_thin = random.chance(0.25);
    let mut scene = Scene { gravity: [0.0, -style.gravity], ..Scene::empty(STEPS, Limits::default()) };
    scene.add(room(&style, size, is_thin));
    let mut movers = Vec::new();
    for (item, place) in items.into_iter().zip(places) {
        if let Some(motion) = item.motion {
            let [x, y] = item.bodies[0].position;
            movers.push((scene.bodies.len(), [x + place[0], y + place[1]], motion));
        }
        add_item(&mut scene, item, place);
    }
    let is_kinematic = |body: &Body| body.kind == Kind::Kinematic;
    let is_driven =
        scene.bodies.iter().any(is_kinematic) || scene.joints.iter().any(|joint| joint.is_driven());
    if !movers.is_empty() {
        scene.script = Some(Box::new(move |step| movers.iter().map(|mover| moved(mover, step)).collect()));
    }
    scene.limits = limits(&style, size);
    for (has, name) in [
        (is_thin, "thin walls"),
        (style.speed > 20.0, "fast"),
        (style.restitution > 0.0, "bouncy"),
        (style.gravity == 0.0, "weightless"),
        (style.density_ratio > 10.0, "masses"),
        (style.sizes[1] > 10.0 * style.sizes[0], "sizes"),
    ] {
        if has {
            kinds.push(name);
        }
    }
    RandomScene { seed, scene, kinds: kinds.join("+"), is_driven }
}

/// Draws items of one to four kinds until there are enough dynamic bodies, and returns the names of the kinds.
fn draw_items(random: &mut Random, style: &Style) -> (Vec<Item>, Vec<&'static str>) {
    let wanted = random.log_between(BODIES[0], BODIES[1]) as usize;
    let mut kinds = Vec::from(item_kinds());
    let mut chosen = Vec::new();
    for _ in 0..1 + random.below(4) {
        chosen.push(kinds.swap_remove(random.below(kinds.len())));
    }
    // Kinds with few items cannot fill a room alone.
    if chosen.iter().all(|kind| kind.most < usize::MAX) {
        chosen.extend(kinds.into_iter().find(|kind| kind.name == "loose"));
    }
    let (mut items, mut counts, mut bodies) = (Vec::new(), vec![0; chosen.len()], 0);
    while bodies < wanted {
        let kind = random.below(chosen.len());
        if counts[kind] == chosen[kind].most {
            continue;
        }
        counts[kind] += 1;
        let item = (chosen[kind].draw)(random, style);
        bodies += item.bodies.iter().filter(|body| body.kind == Kind::Dynamic).count();
        items.push(item);
    }
    let names = chosen.iter().zip(counts).filter(|(_, count)| *count > 0).map(|(kind, _)| kind.name);
    (items, names.collect())
}

/// Returns the lower left corner of each item in m, in rows from the bottom to the top, and the inner width and height of
/// the room in m.
fn arrange(items: &[Item], random: &mut Random) -> (Vec<Point>, Point) {
    let area: f32 = items.iter().map(|item| (item.size[0] + 0.2) * (item.size[1] + 0.2)).sum();
    let widest = items.iter().map(|item| item.size[0]).fold(4.0, f32::max);
    let width = (area * random.log_between(0.7, 4.0)).sqrt().max(widest + 1.0);
    let (mut places, mut x, mut y, mut top) = (Vec::new(), 0.1, 0.0, 0.0_f32);
    for item in items {
        if x + item.size[0] > width - 0.1 {
            (x, y) = (0.1, top + random.between(0.02, 0.3));
        }
        // In the lowest row only items that stand touch the floor.
        let lift = if item.stands { 0.0 } else { 0.02 };
        places.push([x, y + lift]);
        top = top.max(y + lift + item.size[1]);
        x += item.size[0] + random.between(0.02, 0.3);
    }
    (places, [width, top + random.between(1.0, 10.0)])
}

/// Creates the room: boxes of [`WALL`] m, or a chain without thickness. Its inner lower left corner is the origin.
fn room(style: &Style, [width, height]: Point, is_thin: bool) -> Body {
    if is_thin {
        let points = vec![[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]];
        let chain = style.shape(Form::Chain { points, is_loop: true });
        return Body::immovable(Kind::Static, [0.0; 2], vec![chain]);
    }
    let half = 0.5 * WALL;
    let across = [0.5 * width + WALL, half];
    let upright = [half, 0.5 * height + WALL];
    let walls = [
        (across, [0.5 * width, -half]),
        (across, [0.5 * width, height + half]),
        (upright, [-half, 0.5 * height]),
        (upright, [width + half, 0.5 * height]),
    ];
    let wall = |(half, centre)| -> Shape { style.shape(Form::Box { half, centre }) };
    Body::immovable(Kind::Static, [0.0; 2], walls.map(wall).to_vec())
}

/// Adds the bodies and joints of an item whose lower left corner is at `place`, in m.
fn add_item(scene: &mut Scene, item: Item, [x, y]: Point) {
    let first = scene.bodies.len();
    for mut body in item.bodies {
        body.position = [body.position[0] + x, body.position[1] + y];
        scene.add(body);
    }
    for mut joint in item.joints {
        joint.bodies = joint.bodies.map(|index| index + first);
        joint.anchor = [joint.anchor[0] + x, joint.anchor[1] + y];
        scene.joints.push(joint);
    }
}

/// Returns the action that moves a kinematic body in a step: a harmonic motion along x. The mover has the index of the body,
/// the middle in m, reach in m and frequency in rad/s.
fn moved((body, [x, y], [reach, frequency]): &(usize, Point, [f32; 2]), step: usize) -> Action {
    let phase = frequency * (step + 1) as f32 / 60.0;
    Action::Move { body: *body, to: [x + reach * phase.sin(), *y] }
}

/// Returns the limits of a sound state. An elastic hit by a heavy body triples the speed of a light one at most, if both move;
/// movers and rotors reach 48 m/s.
fn limits(style: &Style, [width, height]: Point) -> Limits {
    let fall = (2.0 * style.gravity * height).sqrt();
    Limits {
        bounds: Some([[0.0; 2], [width, height]]),
        speed: 3.0 * (style.speed + fall + 48.0),
        overlap: 0.1,
        gap: 0.05,
    }
}
