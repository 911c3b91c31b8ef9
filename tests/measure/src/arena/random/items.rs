//! Random items: bodies with their joints that fill a rectangle of a random scene.

use super::parts::{Style, forms};
use crate::arena::joint::{Joint, JointKind};
use crate::arena::scene::{Body, Form, Kind, Point, Shape};
use crate::arena::scenes::rain::ragdoll;
use crate::joints::random::Random;
use std::f32::consts::{FRAC_PI_2, TAU};

/// Bodies and joints within a rectangle whose lower left corner is the origin. Joints give their bodies by index into
/// `bodies`.
#[derive(Debug, Default)]
pub(super) struct Item {
    pub(super) bodies: Vec<Body>,
    pub(super) joints: Vec<Joint>,
    /// Width and height of the rectangle in m.
    pub(super) size: Point,
    /// Whether the item stands on the floor of the room.
    pub(super) stands: bool,
    /// Reach in m and frequency in rad/s of the horizontal motion of the first body, which is kinematic.
    pub(super) motion: Option<[f32; 2]>,
}

/// Kind of items: its name, and the function that draws one.
pub(super) struct ItemKind {
    pub(super) name: &'static str,
    pub(super) draw: fn(&mut Random, &Style) -> Item,
    /// Greatest number of such items in a scene.
    pub(super) most: usize,
}

/// Returns all kinds of items.
pub(super) fn item_kinds() -> [ItemKind; 15] {
    let kind = |name, draw, most| ItemKind { name, draw, most };
    [
        kind("loose", loose, usize::MAX),
        kind("wall", wall, usize::MAX),
        kind("pyramid", pyramid, usize::MAX),
        kind("chain", chain, usize::MAX),
        kind("bridge", bridge, 20),
        kind("net", net, 4),
        kind("ragdoll", doll, usize::MAX),
        kind("figure", figure, usize::MAX),
        kind("linked", linked, usize::MAX),
        kind("cart", cart, usize::MAX),
        kind("rotor", rotor, 8),
        kind("piston", piston, 8),
        kind("obstacle", obstacle, 20),
        kind("spinner", spinner, 8),
        kind("pusher", pusher, 4),
    ]
}

impl Item {
    fn add(&mut self, body: Body) -> usize {
        self.bodies.push(body);
        self.bodies.len() - 1
    }

    /// Adds a static body without shapes at a place in m.
    fn post(&mut self, place: Point) -> usize {
        self.add(Body::immovable(Kind::Static, place, Vec::new()))
    }

    fn join(&mut self, kind: JointKind, bodies: [usize; 2], anchor: Point) -> &mut Joint {
        let joint = Joint::between(kind, bodies, bodies.map(|index| &self.bodies[index]), anchor);
        let index = self.joints.len();
        self.joints.push(joint);
        &mut self.joints[index]
    }

    /// Puts all shapes into a collision group, so that they do not collide with each other.
    fn group(&mut self, random: &mut Random) {
        let group = 1 + random.below(7) as u32;
        let shapes = self.bodies.iter_mut().flat_map(|body| &mut body.shapes);
        shapes.for_each(|shape| shape.filter.group = group);
    }

    /// Gives all bodies one velocity.
    fn throw(mut self, random: &mut Random, style: &Style) -> Self {
        let velocity = style.velocity(random);
        self.bodies.iter_mut().for_each(|body| body.velocity = velocity);
        self
    }
}

fn loose(random: &mut Random, style: &Style) -> Item {
    let extent = style.extent(random);
    let forms = forms(random, extent);
    let body = style.body(random, [0.5 * extent; 2], forms);
    // A turned body of several shapes may reach further from its centre of mass than half of its extent.
    let size = [1.5 * extent; 2];
    let place = size.map(|side| 0.5 * side);
    let body = Body { angle: random.between(0.0, TAU), position: place, ..body };
    Item { bodies: vec![body], size, ..Item::default() }.throw(random, style)
}

fn wall(random: &mut Random, style: &Style) -> Item {
    let (columns, rows) = (1 + random.below(12), 3 + random.below(12));
    let half = [0.5 * style.extent(random), 0.5 * style.extent(random)].map(|half| half.clamp(0.1, 1.0));
    let offset = if random.chance(0.5) { half[0] } else { 0.0 };
    let mut item = Item { stands: true, ..Item::default() };
    for row in 0..rows {
        let shift = if row % 2 == 1 { offset } else { 0.0 };
        for column in 0..columns {
            let place = [half[0] * (2 * column + 1) as f32 + shift, half[1] * (2 * row + 1) as f32];
            item.add(style.rectangle(random, place, half));
        }
    }
    item.size = [2.0 * half[0] * columns as f32 + offset, 2.0 * half[1] * rows as f32];
    item
}

fn pyramid(random: &mut Random, style: &Style) -> Item {
    let (base, half) = (3 + random.below(18), (0.5 * style.extent(random)).clamp(0.1, 1.0));
    let mut item = Item { stands: true, size: [2.0 * half * base as f32; 2], ..Item::default() };
    for row in 0..base {
        for column in 0..base - row {
            let x = half * (row + 1 + 2 * column) as f32;
            item.add(style.rectangle(random, [x, half * (2 * row + 1) as f32], [half; 2]));
        }
    }
    item
}

/// Adds `count` links in a row along x, hinged to each other; returns the x of the right end in m. `half` is half the length
/// and width of a link in m.
fn links(item: &mut Item, random: &mut Random, style: &Style, (count, half): (usize, Point)) -> f32 {
    let y = item.size[1] - half[1];
    for index in 0..count {
        let x = half[0] * (2 * index + 1) as f32;
        let link = item.add(style.rectangle(random, [x, y], half));
        if index > 0 {
            item.join(JointKind::Hinge, [link - 1, link], [x - half[0], y]);
        }
    }
    2.0 * half[0] * count as f32
}

/// Draws a chain, free or hung by one end, in some of them with a heavy ball at the other end.
fn chain(random: &mut Random, style: &Style) -> Item {
    let count = random.log_between(2.0, 60.0) as usize;
    let length = (0.5 * style.extent(random)).clamp(0.1, 1.0);
    let half = [length, length * random.between(0.2, 0.5)];
    let has_ball = random.chance(0.4);
    let radius = if has_ball { length * random.between(0.5, 3.0) } else { half[1] };
    let mut item = Item { size: [0.0, radius + half[1].max(radius)], ..Item::default() };
    let right = links(&mut item, random, style, (count, half));
    let y = item.size[1] - half[1];
    item.size[0] = right;
    if has_ball {
        let form = Form::Circle { centre: [0.0; 2], radius };
        let ball = item.add(style.body(random, [right + radius, radius], vec![form]));
        item.join(JointKind::Hinge, [count - 1, ball], [right, y]);
        item.size[0] += 2.0 * radius;
    }
    if random.chance(0.5) {
        let post = item.post([0.0, y]);
        item.join(JointKind::Hinge, [post, 0], [0.0, y]);
        return item;
    }
    item.throw(random, style)
}

fn bridge(random: &mut Random, style: &Style) -> Item {
    let count = 4 + random.below(40);
    let length = (0.5 * style.extent(random)).clamp(0.1, 1.0);
    let half = [length, length * random.between(0.2, 0.5)];
    let mut item = Item { size: [0.0, 2.0 * half[1] + random.between(0.0, 4.0)], ..Item::default() };
    let right = links(&mut item, random, style, (count, half));
    let y = item.size[1] - half[1];
    item.size[0] = right;
    for (x, end) in [(0.0, 0), (right, count - 1)] {
        let post = item.post([x, y]);
        item.join(JointKind::Hinge, [post, end], [x, y]);
    }
    item
}

/// Draws a net of discs, which is held at a corner or free.
fn net(random: &mut Random, style: &Style) -> Item {
    let (columns, rows) = (2 + random.below(14), 2 + random.below(14));
    let pitch = style.extent(random).clamp(0.2, 2.0);
    let mut item = Item { size: [columns, rows].map(|count| pitch * count as f32), ..Item::default() };
    for index in 0..columns * rows {
        let (column, row) = (index / rows, index % rows);
        let [x, y] = [column, row].map(|place| pitch * (place as f32 + 0.5));
        let form = Form::Circle { centre: [0.0; 2], radius: 0.4 * pitch };
        item.add(style.body(random, [x, y], vec![form]));
        if row > 0 {
            item.join(JointKind::Hinge, [index - 1, index], [x, y - 0.5 * pitch]);
        }
        if column > 0 {
            item.join(JointKind::Hinge, [index - rows, index], [x - 0.5 * pitch, y]);
        }
    }
    if random.chance(0.5) {
        let (held, at) = (rows - 1, [0.5 * pitch, item.size[1]]);
        let post = item.post(at);
        item.join(JointKind::Hinge, [post, held], at);
        return item;
    }
    item.throw(random, style)
}

fn doll(random: &mut Random, style: &Style) -> Item {
    let mut item = Item { size: [0.8, 1.7], ..Item::default() };
    let group = 1 + random.below(7) as u32;
    for (body, joint) in ragdoll([0.4, 0.1], 0, group) {
        item.add(body);
        item.joints.extend(joint);
    }
    item.throw(random, style)
}

/// Draws a figure of 3 to 9 bodies with joints of any kind and up to two loops; its bodies do not collide with each other.
fn figure(random: &mut Random, style: &Style) -> Item {
    let extent = style.extent(random).clamp(0.2, 2.0);
    let mut item = Item { size: [4.0 * extent; 2], ..Item::default() };
    let count = 3 + random.below(7);
    for made in 0..count {
        let place = [0, 1].map(|axis| random.between(0.7 * extent, item.size[axis] - 0.7 * extent));
        let reach = extent * random.between(0.4, 1.0);
        let forms = forms(random, reach);
        let body = style.body(random, place, forms);
        item.add(Body { angle: random.between(-1.5, 1.5), ..body });
        if made > 0 {
            let other = random.below(made);
            connect(&mut item, [other, made], random);
        }
    }
    for _ in 0..random.below(3) {
        let (one, two) = (random.below(count), random.below(count));
        if one != two {
            connect(&mut item, [one, two], random);
        }
    }
    item.group(random);
    if random.chance(0.2) {
        let place = item.bodies[0].position;
        let post = item.post(place);
        item.join(JointKind::Hinge, [post, 0], place);
        return item;
    }
    item.throw(random, style)
}

/// Adds a joint of any kind midway between two bodies, in some with limits or a motor.
fn connect(item: &mut Item, bodies: [usize; 2], random: &mut Random) {
    let [[x1, y1], [x2, y2]] = bodies.map(|index| item.bodies[index].position);
    let (anchor, distance) = ([0.5 * (x1 + x2), 0.5 * (y1 + y2)], (x2 - x1).hypot(y2 - y1).max(0.02));
    let mass: f32 = bodies.iter().map(|&index| item.bodies[index].mass).sum();
    let effort = 10.0 * mass * random.log_between(0.1, 10.0);
    let (has_limits, has_motor) = (random.chance(0.4), random.chance(0.2));
    match random.below(10) {
        0..5 => {
            let joint = item.join(JointKind::Hinge, bodies, anchor);
            joint.limits = has_limits.then(|| [random.between(-1.5, 0.0), random.between(0.0, 1.5)]);
            joint.motor = has_motor.then(|| [random.between(-10.0, 10.0), effort * distance]);
        }
        5..7 => drop(item.join(JointKind::Weld, bodies, anchor)),
        7 => {
            let angle = random.between(0.0, TAU);
            let joint = item.join(JointKind::Slider { axis: [angle.cos(), angle.sin()] }, bodies, anchor);
            joint.limits = has_limits.then(|| [-distance, distance]);
            joint.motor = has_motor.then(|| [random.between(-5.0, 5.0), effort]);
        }
        8 => drop(item.join(JointKind::Rod, bodies, anchor)),
        _ => drop(item.join(JointKind::Rope { length: distance * random.between(1.0, 1.5) }, bodies, anchor)),
    }
}

/// Draws two to five bodies in a row with rods, ropes, welds or springs between neighbours.
fn linked(random: &mut Random, style: &Style) -> Item {
    let extent = style.extent(random);
    let (count, pitch) = (2 + random.below(4), extent * random.between(1.1, 2.0));
    let mut item = Item { size: [pitch * count as f32, 1.2 * extent], ..Item::default() };
    for index in 0..count {
        let forms = forms(random, extent);
        let place = [pitch * (index as f32 + 0.5), 0.6 * extent];
        let body = style.body(random, place, forms);
        item.add(Body { position: place, ..body });
        if index > 0 {
            let bodies = [index - 1, index];
            let middle = [pitch * index as f32, place[1]];
            match random.below(4) {
                0 => drop(item.join(JointKind::Rod, bodies, middle)),
                1 => drop(item.join(JointKind::Rope { length: 1.2 * pitch }, bodies, middle)),
                2 => drop(item.join(JointKind::Weld, bodies, middle)),
                _ => {
                    let spring = Some([random.log_between(0.5, 8.0), random.between(0.0, 1.0)]);
                    item.join(JointKind::Spring, bodies, middle).spring = spring;
                }
            }
        }
    }
    item.throw(random, style)
}

/// Draws a cart: a chassis with two to four wheels, driven by motors or not.
fn cart(random: &mut Random, style: &Style) -> Item {
    let radius = (0.3 * style.extent(random)).clamp(0.1, 1.0);
    let wheels = 2 + random.below(3);
    let size = [2.5 * radius * wheels as f32, 3.0 * radius];
    let mut item = Item { size, ..Item::default() };
    let half = [0.5 * size[0], 0.4 * radius];
    let chassis = item.add(style.rectangle(random, [half[0], 2.5 * radius], half));
    let (speed, is_driven) = (random.between(-15.0, 15.0), random.chance(0.6));
    for wheel in 0..wheels {
        let place = [2.5 * radius * (wheel as f32 + 0.5), radius];
        let wheel = item.add(style.body(
            random,
            place,
            vec![Form::Circle { centre: [0.0; 2], radius: 0.95 * radius }],
        ));
        let torque = 10.0 * radius * item.bodies[chassis].mass;
        item.join(JointKind::Hinge, [chassis, wheel], place).motor = is_driven.then_some([speed, torque]);
    }
    item.group(random);
    item
}

/// Draws a blade that a motor turns about its middle.
fn rotor(random: &mut Random, style: &Style) -> Item {
    let arm = random.log_between(1.0, 8.0);
    let middle = [arm; 2];
    let mut item = Item { size: [2.0 * arm; 2], ..Item::default() };
    let post = item.post(middle);
    let half = [0.95 * arm, (0.05 * arm).max(0.1)];
    let blade = item.add(style.rectangle(random, middle, half));
    let torque = 10.0 * item.bodies[blade].mass * arm * random.log_between(0.5, 50.0);
    let motor = Some([random.between(-6.0, 6.0), torque]);
    item.join(JointKind::Hinge, [post, blade], middle).motor = motor;
    item
}

/// Draws a block that a motor moves along an axis to one of its limits.
fn piston(random: &mut Random, style: &Style) -> Item {
    let half = random.log_between(0.2, 1.5);
    let (travel, is_upright) = (half * random.between(1.0, 4.0), random.chance(0.5));
    let [along, across] = [2.0 * (half + travel), 2.0 * half];
    let size = if is_upright { [across, along] } else { [along, across] };
    let middle = size.map(|side| 0.5 * side);
    let mut item = Item { size, ..Item::default() };
    let post = item.post(middle);
    let block = item.add(style.rectangle(random, middle, [0.95 * half; 2]));
    let force = 10.0 * item.bodies[block].mass * random.log_between(0.5, 50.0);
    let angle = if is_upright { FRAC_PI_2 } else { 0.0 };
    let joint = item.join(JointKind::Slider { axis: [angle.cos(), angle.sin()] }, [post, block], middle);
    joint.limits = Some([-travel, travel]);
    joint.motor = Some([random.between(-5.0, 5.0), force]);
    item
}

fn obstacle(random: &mut Random, style: &Style) -> Item {
    let extent = random.log_between(0.5, 6.0);
    let size = [1.3 * extent; 2];
    let shapes = forms(random, extent).into_iter().map(|form| style.shape(form)).collect();
    let body = Body::immovable(Kind::Static, size.map(|side| 0.5 * side), shapes);
    Item { bodies: vec![Body { angle: random.between(0.0, TAU), ..body }], size, ..Item::default() }
}

fn spinner(random: &mut Random, style: &Style) -> Item {
    let arm = random.log_between(0.5, 6.0);
    let half = [0.95 * arm, random.between(0.1, 0.3) * arm];
    let shape: Shape = style.shape(Form::Box { half, centre: [0.0; 2] });
    let body = Body::immovable(Kind::Kinematic, [arm; 2], vec![shape]);
    let bodies = vec![Body { spin: random.between(-5.0, 5.0), ..body }];
    Item { bodies, size: [2.0 * arm; 2], ..Item::default() }
}

fn pusher(random: &mut Random, style: &Style) -> Item {
    let half = [random.log_between(0.2, 1.0), random.log_between(0.3, 3.0)];
    let (reach, frequency) = (random.log_between(0.5, 8.0), random.log_between(0.3, 3.0));
    let size = [2.0 * (half[0] + reach), 2.0 * half[1]];
    let shape = style.shape(Form::Box { half, centre: [0.0; 2] });
    let body = Body::immovable(Kind::Kinematic, size.map(|side| 0.5 * side), vec![shape]);
    Item { bodies: vec![body], size, motion: Some([reach, frequency]), ..Item::default() }
}
