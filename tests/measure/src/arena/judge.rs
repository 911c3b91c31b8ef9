//! Measurement of a state by the same geometry for every engine: overlaps, joint gaps, escaped bodies, energy.

use super::engine::State;
use super::joint::{Joint, JointKind};
use super::play::Play;
use super::scene::{Body, Filter, Form, Kind, Limits, Point, Shape};
use crate::penetration::depth::{Form as Piece, depth};
use crate::world::turned;
use std::collections::BTreeSet;

/// Greatest distance in m at which two shapes count as touching: Box2D's linear slop.
const TOUCH: f64 = 0.005;

/// Measured state of a scene. Bodies are dynamic bodies.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Verdict {
    /// Number of dynamic bodies that exist.
    pub bodies: usize,
    /// Number of dynamic bodies with a state that is not finite; all other figures omit them.
    pub not_finite: usize,
    /// Number of dynamic bodies outside of the bounds of the scene.
    pub escaped: usize,
    /// Number of pairs of convex pieces that touch or overlap.
    pub contacts: usize,
    /// Greatest overlap depth of two convex pieces in metres, >= 0.
    pub deepest: f64,
    /// Indices of the two bodies that overlap most deeply; `None` if no two overlap.
    pub deepest_pair: Option<[usize; 2]>,
    /// Mean overlap depth in metres of the pairs that touch; negative if most of these are slightly apart.
    pub mean_overlap: f64,
    /// Greatest distance in metres between the two anchors of a joint.
    pub gap: f64,
    /// Index of the joint with the greatest distance; `None` if no joint is open.
    pub widest_joint: Option<usize>,
    /// Greatest speed of a centre of mass in m/s.
    pub speed: f64,
    /// Kinetic energy of all dynamic bodies in J (kg m²/s²).
    pub energy: f64,
    /// Mean height (y) of the centres of mass in metres.
    pub height: f64,
    /// Greatest height (y) of a centre of mass in metres.
    pub highest: f64,
}

impl Verdict {
    /// Returns whether the state of all bodies is finite and within `limits`.
    pub fn is_sound(&self, limits: &Limits) -> bool {
        (self.not_finite, self.escaped) == (0, 0)
            && self.deepest <= f64::from(limits.overlap)
            && self.gap <= f64::from(limits.gap)
            && self.speed <= f64::from(limits.speed)
    }
}

/// A convex piece of a shape in world coordinates (m), with the least and greatest x and y of its AABB.
struct Placed {
    body: usize,
    is_dynamic: bool,
    filter: Filter,
    piece: Piece,
    x: (f64, f64),
    y: (f64, f64),
}

/// Measures the present state of a scene.
pub fn judge(play: &mut Play<'_>) -> Verdict {
    let mut states = Vec::with_capacity(play.bodies.len());
    for (index, body) in play.bodies.iter().enumerate() {
        states.push(body.as_ref().map(|_| play.engine.state(index)));
    }
    let mut verdict = Verdict { highest: f64::NEG_INFINITY, ..Verdict::default() };
    let mut placed = Vec::new();
    for (index, (body, state)) in play.bodies.iter().zip(&states).enumerate() {
        let (Some(body), Some(state)) = (body, state) else { continue };
        if body.kind == Kind::Dynamic {
            verdict.observe(body, state, play.scene.limits.bounds);
        }
        if is_finite(state) {
            body.shapes.iter().for_each(|shape| place(index, body, shape, state, &mut placed));
        }
    }
    verdict.height /= (verdict.bodies - verdict.not_finite).max(1) as f64;
    for (index, joint) in play.joints.iter().enumerate() {
        let Some(joint) = joint else { continue };
        let [Some(a), Some(b)] = joint.bodies.map(|index| states[index]) else { continue };
        let [Some(one), Some(two)] = joint.bodies.map(|index| play.bodies[index].as_ref()) else { continue };
        let gap = gap(joint, [one, two], [a, b]);
        if gap > verdict.gap {
            (verdict.gap, verdict.widest_joint) = (gap, Some(index));
        }
    }
    let joined = play.joints.iter().flatten().map(|joint| sorted(joint.bodies)).collect();
    verdict.measure_overlaps(placed, &joined);
    verdict
}

impl Verdict {
    fn observe(&mut self, body: &Body, state: &State, bounds: Option<[Point; 2]>) {
        self.bodies += 1;
        if !is_finite(state) {
            self.not_finite += 1;
            return;
        }
        let is_outside = |[low, high]: [Point; 2]| {
            (0..2).any(|axis| !(low[axis]..=high[axis]).contains(&state.position[axis]))
        };
        self.escaped += usize::from(bounds.is_some_and(is_outside));
        let speed = f64::from(state.velocity[0]).hypot(f64::from(state.velocity[1]));
        self.speed = self.speed.max(speed);
        let turning = f64::from(body.inertia) * f64::from(state.spin).powi(2);
        self.energy += 0.5 * (f64::from(body.mass) * speed * speed + turning);
        let height = f64::from(state.position[1]);
        (self.height, self.highest) = (self.height + height, self.highest.max(height));
    }

    /// Counts touching pairs and measures overlap depths; a sweep along x finds the pairs. It skips two pieces of one body,
    /// of two bodies that are not dynamic, of a filtered pair, and of two bodies with a joint.
    fn measure_overlaps(&mut self, mut placed: Vec<Placed>, joined: &BTreeSet<[usize; 2]>) {
        placed.sort_by(|one, other| one.x.0.total_cmp(&other.x.0));
        let mut sum = 0.0;
        for (index, one) in placed.iter().enumerate() {
            for other in placed[index + 1..].iter().take_while(|other| other.x.0 <= one.x.1 + TOUCH) {
                let may_touch = one.y.0 <= other.y.1 + TOUCH && other.y.0 <= one.y.1 + TOUCH;
                if !may_touch || !one.meets(other) || joined.contains(&sorted([one.body, other.body])) {
                    continue;
                }
                let depth = depth(&one.piece, &other.piece);
                if depth >= -TOUCH {
                    (self.contacts, sum) = (self.contacts + 1, sum + depth);
                    if depth > self.deepest {
                        (self.deepest, self.deepest_pair) = (depth, Some([one.body, other.body]));
                    }
                }
            }
        }
        self.mean_overlap = sum / self.contacts.max(1) as f64;
    }
}

impl Placed {
    fn meets(&self, other: &Placed) -> bool {
        self.body != other.body && (self.is_dynamic || other.is_dynamic) && self.filter.meets(other.filter)
    }
}

fn place(index: usize, body: &Body, shape: &Shape, state: &State, placed: &mut Vec<Placed>) {
    let position = state.position.map(f64::from);
    for piece in pieces(&shape.form) {
        let piece = piece.placed(position, f64::from(state.angle));
        placed.push(Placed {
            body: index,
            is_dynamic: body.kind == Kind::Dynamic,
            filter: shape.filter,
            x: piece.extent([1.0, 0.0]),
            y: piece.extent([0.0, 1.0]),
            piece,
        });
    }
}

/// Returns a shape as convex pieces in local coordinates of its body, in m. If a rounded shape overlaps by more than its
/// radius, the measured depth may be no more than the radius, since depth is measured per piece.
fn pieces(form: &Form) -> Vec<Piece> {
    let polygon = |corners: &[Point]| {
        Piece::polygon(&corners.iter().map(|corner| corner.map(f64::from)).collect::<Vec<_>>())
    };
    match form {
        Form::Circle { centre, radius } => vec![disc(*centre, *radius)],
        Form::Capsule { ends, radius } => rounded(ends, *radius),
        Form::Polygon { corners, radius } if *radius > 0.0 => {
            let mut pieces = rounded(corners, *radius);
            pieces.push(polygon(corners));
            pieces
        }
        Form::Box { .. } | Form::Polygon { .. } => vec![polygon(&form.sharp_corners())],
        Form::Chain { points, is_loop } => {
            let closing = [points[points.len() - 1], points[0]];
            points.windows(2).chain(is_loop.then_some(&closing[..])).map(polygon).collect()
        }
    }
}

/// Returns the rim of an outline with rounded corners as convex pieces: discs at the corners, and rectangles outside of the
/// edges.
fn rounded(corners: &[Point], radius: f32) -> Vec<Piece> {
    let mut pieces: Vec<Piece> = corners.iter().map(|&corner| disc(corner, radius)).collect();
    for (index, &from) in corners.iter().enumerate() {
        let [from, to] = [from, corners[(index + 1) % corners.len()]].map(|corner| corner.map(f64::from));
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let scale = f64::from(radius) / dx.hypot(dy);
        let out = |[x, y]: [f64; 2]| [x + dy * scale, y - dx * scale];
        pieces.push(Piece::polygon(&[from, to, out(to), out(from)]));
    }
    pieces
}

fn disc(centre: Point, radius: f32) -> Piece {
    Piece::Disc { centre: centre.map(f64::from), radius: f64::from(radius) }
}

/// Returns the distance in m by which a joint is open. `of` are its bodies as they were at the start, `states` as they are.
pub(super) fn gap(joint: &Joint, of: [&Body; 2], states: [State; 2]) -> f64 {
    let [one, two] = joint.local_anchors(of);
    let [[x1, y1], [x2, y2]] = [to_world(&states[0], one), to_world(&states[1], two)];
    let (dx, dy) = (x2 - x1, y2 - y1);
    match joint.kind {
        JointKind::Hinge | JointKind::Weld => dx.hypot(dy),
        JointKind::Slider { .. } => {
            let axis = f64::from(states[0].angle) + f64::from(joint.local_axes(of)[0]);
            (dy * axis.cos() - dx * axis.sin()).abs()
        }
        JointKind::Rod => (dx.hypot(dy) - f64::from(Joint::length(of))).abs(),
        JointKind::Rope { length } => (dx.hypot(dy) - f64::from(length)).max(0.0),
        JointKind::Spring => 0.0,
    }
}

fn to_world(state: &State, local: Point) -> [f64; 2] {
    let [x, y] = turned(local.map(f64::from), f64::from(state.angle));
    [x + f64::from(state.position[0]), y + f64::from(state.position[1])]
}

fn sorted([a, b]: [usize; 2]) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

fn is_finite(state: &State) -> bool {
    let State { position: [x, y], angle, velocity: [u, v], spin } = *state;
    [x, y, angle, u, v, spin].iter().all(|number| number.is_finite())
}
