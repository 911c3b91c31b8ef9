//! The shapes near a mover, and casts of the mover against them.

use super::super::convex::{Closest, Convex, Point, dot, minus, plus, scaled, vector};
use super::super::filter::QueryFilter;
use super::super::world_shape::{may_reach, to_world};
use super::shape::MoverShape;
use crate::body::BodyId;
use crate::geom::GeomId;
use crate::math::Vector2;
use crate::shape::Aabb;
use crate::simulator::PhysicsSimulator;
use crate::simulator::candidates::Candidate;

/// Maximum number of steps of a cast, a count: see `cast.rs`.
const MAX_STEPS: usize = 60;
/// Closing speed up to which a cast passes an obstacle, as a fraction of the motion: rounding of normals closes motions that
/// slide along a surface.
const GRAZE_RATIO: f64 = 1e-4;
/// Motion into an obstacle that a cast passes at most, as a fraction of the skin.
const GRAZE_MAX_SKIN: f64 = 0.1;
/// Distance to the skin at which a cast ends, as a fraction of the skin.
const TOUCH_SKIN: f64 = 1e-3;
/// Depth in the skin, as a fraction of it, beyond which a mover is in an obstacle, not on it.
pub(super) const SKIN_SLACK: f64 = 0.25;
/// Least cosine between a normal and the open direction of a one-way geom that stops: 60 degrees, as in the solver.
const ONE_WAY_MIN_COS: f64 = 0.5;
/// Margin of the box in which obstacles are gathered, as a fraction of its extent, so that few moves gather twice.
const GATHER_MARGIN: f64 = 0.25;

/// Kind of the body of an obstacle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Fixed,
    Kinematic,
    Dynamic,
}

/// A convex piece of a geom in the world.
#[derive(Debug, Clone)]
pub(super) struct Obstacle {
    pub(super) shape: Convex,
    pub(super) geom: GeomId,
    pub(super) body: BodyId,
    pub(super) kind: Kind,
    /// Unit vector to the open side of a one-way geom.
    open: Option<Point>,
}

/// Obstacles that a cast does not meet.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Passable {
    /// A body that is none.
    pub(super) body: Option<BodyId>,
    /// One-way geoms that touch the mover at this height or above are none, in length units, y down.
    pub(super) one_way_above: Option<f64>,
}

/// The first obstacle of a cast.
#[derive(Debug, Clone, Copy)]
pub(super) struct MoverHit {
    /// Fraction of the motion, 0..=1.
    pub(super) fraction: f64,
    /// Unit vector from the obstacle to the mover.
    pub(super) normal: Point,
    /// Point on the obstacle, in length units.
    pub(super) point: Point,
    pub(super) geom: GeomId,
    pub(super) body: BodyId,
    pub(super) kind: Kind,
}

/// The obstacles in a box. Their memory is kept from move to move.
#[derive(Debug, Clone, Default)]
pub(super) struct Obstacles {
    /// The first `count` are obstacles; the memory of the others is reused.
    list: Vec<Obstacle>,
    count: usize,
    near: Vec<(u32, GeomId)>,
    /// Left, top, right, bottom of the box, in length units.
    covered: [f64; 4],
}

impl Obstacles {
    /// Forgets all obstacles.
    pub(super) fn clear(&mut self) {
        self.count = 0;
        self.covered = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
    }

    pub(super) fn all(&self) -> &[Obstacle] {
        &self.list[..self.count]
    }

    /// Gathers the obstacles in a box (left, top, right, bottom), unless they are known.
    pub(super) fn cover(&mut self, simulator: &PhysicsSimulator, bounds: [f64; 4], filter: &QueryFilter<'_>) {
        let [left, top, right, bottom] = bounds;
        let known = self.covered;
        if known[0] <= left && known[1] <= top && known[2] >= right && known[3] >= bottom {
            return;
        }
        let more = GATHER_MARGIN * ((right - left) + (bottom - top));
        self.covered = [
            known[0].min(left - more),
            known[1].min(top - more),
            known[2].max(right + more),
            known[3].max(bottom + more),
        ];
        let [left, top, right, bottom] = self.covered;
        let aabb = Aabb::new(vector([left, top]), vector([right, bottom]));
        self.count = 0;
        self.near.clear();
        simulator.for_each_near(&aabb, |Candidate { list_key, geom, .. }| self.near.push((list_key, geom)));
        // In the order of the list of geoms, each once.
        self.near.sort_unstable_by_key(|&(list_key, _)| list_key);
        self.near.dedup_by_key(|&mut (list_key, _)| list_key);
        for at in 0..self.near.len() {
            let geom = self.near[at].1;
            if filter.admits(simulator, geom) && may_reach(simulator, geom, &aabb) {
                self.add(simulator, geom);
            }
        }
    }

    fn add(&mut self, simulator: &PhysicsSimulator, id: GeomId) {
        let Some(geom) = simulator.geom(id) else { return };
        let body = geom.body();
        let kind = match simulator.body(body) {
            Some(body) if body.is_static() => Kind::Fixed,
            Some(body) if body.is_kinematic() => Kind::Kinematic,
            _ => Kind::Dynamic,
        };
        let to_world = to_world(&geom.matrix());
        let origin = to_world([0.0; 2]);
        // A one-way direction is given on the body, which the rotation offset does not turn.
        let turn = |direction: Vector2| match simulator.body(body) {
            Some(body) => crate::queries::convex::Placement::new((Vector2::zeros(), body.rotation()))
                .apply([f64::from(direction.x), f64::from(direction.y)]),
            None => minus(to_world([f64::from(direction.x), f64::from(direction.y)]), origin),
        };
        let open = geom.one_way().map(turn);
        for piece in geom.entry.pieces().iter() {
            match self.list.get_mut(self.count) {
                Some(obstacle) => {
                    obstacle.shape.set_to_piece(piece, &to_world);
                    (obstacle.geom, obstacle.body, obstacle.kind, obstacle.open) = (id, body, kind, open);
                }
                None => {
                    let shape = Convex::of_piece(piece, &to_world);
                    self.list.push(Obstacle { shape, geom: id, body, kind, open });
                }
            }
            self.count += 1;
        }
    }

    /// The first obstacle on the way of a mover, with a gap of `skin` around it; of several at the same fraction, the first in
    /// list order.
    pub(super) fn cast(
        &self,
        mover: &mut MoverShape,
        from: Point,
        motion: Point,
        skin: f64,
        passable: Passable,
    ) -> Option<MoverHit> {
        let mut first: Option<MoverHit> = None;
        for obstacle in self.all().iter().filter(|obstacle| passable.body != Some(obstacle.body)) {
            let hit = first_touch(mover, from, motion, skin, obstacle, passable);
            first = match (first, hit) {
                (Some(first), Some(hit)) if hit.fraction >= first.fraction => Some(first),
                (first, hit) => hit.or(first),
            };
        }
        first
    }
}

/// The touch of a mover on its way with one obstacle.
pub(super) fn first_touch(
    mover: &mut MoverShape,
    from: Point,
    motion: Point,
    skin: f64,
    obstacle: &Obstacle,
    passable: Passable,
) -> Option<MoverHit> {
    let length = dot(motion, motion).sqrt();
    let graze = (GRAZE_RATIO * length).min(GRAZE_MAX_SKIN * skin);
    let free_side = obstacle.shape.free_side;
    if free_side.is_some_and(|free| dot(motion, free) >= 0.0 || is_behind(mover, from, obstacle, free))
        || obstacle.open.is_some_and(|open| dot(motion, open) >= 0.0)
    {
        return None;
    }
    let mut fraction = 0.0;
    let mut gap = mover.gap(from, &obstacle.shape);
    if obstacle.open.is_some() && is_open(&gap, skin, passable) {
        return None;
    }
    for step in 0..MAX_STEPS {
        let closing = dot(motion, gap.normal);
        if closing <= graze {
            return None;
        }
        let distance = gap.distance - skin;
        if distance <= TOUCH_SKIN * skin || step + 1 == MAX_STEPS {
            break;
        }
        fraction += distance / closing;
        if fraction > 1.0 {
            return None;
        }
        gap = mover.gap(plus(from, scaled(motion, fraction)), &obstacle.shape);
    }
    let normal = gap.normal.map(|part| -part);
    let is_through = obstacle.open.is_some_and(|open| dot(normal, open) < ONE_WAY_MIN_COS);
    let Obstacle { geom, body, kind, .. } = *obstacle;
    (!is_through).then_some(MoverHit { fraction, normal, point: gap.point_b, geom, body, kind })
}

/// Whether a mover passes a one-way obstacle that it has this gap to: it is in it, or drops through it.
fn is_open(gap: &Closest, skin: f64, passable: Passable) -> bool {
    let drops =
        passable.one_way_above.is_some_and(|height| gap.point_b[1] <= height && gap.distance <= 2.0 * skin);
    drops || gap.distance < (1.0 - SKIN_SLACK) * skin
}

/// Whether the middle of a mover is behind an edge of a chain.
fn is_behind(mover: &MoverShape, at: Point, obstacle: &Obstacle, free_side: Point) -> bool {
    dot(minus(mover.middle(at), obstacle.shape.core[0]), free_side) < 0.0
}

impl Obstacle {
    /// Whether it pushes a mover that is in it: one-way geoms and the back of chains do not.
    pub(super) fn is_solid_for(&self, mover: &MoverShape, at: Point) -> bool {
        self.open.is_none() && !self.shape.free_side.is_some_and(|free| is_behind(mover, at, self, free))
    }
}
