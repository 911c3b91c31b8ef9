//! Four joints of a colour in the substeps of an update: the rows that each keeps as one block, and its [free row](super::block_row).
//!
//! Impulses are those of a substep, on the second body, by the rows of a [`BlockPair`].

use crate::precise::parameters::joints::{
    HANDED_OVER_IMPULSE_LOSS, HANDED_OVER_LOSS_PER_CORRECTION, SOFT_ROW_ANGLE_ERROR, SOFT_ROW_ARM,
};
use wide::f32x4;

use super::super::bodies::{Bodies, Hot};
use super::super::direct::block::Triple;
use super::super::direct::constraint::Set;
use super::super::direct::joint::{ACROSS, ALONG, ANGLE};
use super::block_pair::{BlockPair, Lanes, Normal, Rows, narrow, put, wide};
use super::block_row::{BlockRow, free_row};
use super::frame::Frame;
use super::hold::Hold;
use super::soft_law::{BlockLaw, BlockMass, Law};
use super::tree::Link;
use crate::math::lanes::{greater, select, smaller};

/// In place of a joint: a lane without one.
const NONE: u32 = u32::MAX;

const ZERO: Lanes = f32x4::ZERO;

/// The joints.
#[derive(Debug, Clone, Copy)]
pub(super) struct SoftBlock {
    /// Indices of the joints in the list of joints, or [`NONE`].
    holds: [u32; 4],
    pair: BlockPair,
    /// Masks of the kept rows, their effective mass as a block, position errors (length units, radians) and impulses.
    kept: Rows,
    mass: BlockMass,
    errors: Rows,
    impulses: Rows,
    /// The distance or angle that is kept; of an angle less the one when the update began.
    target: Lanes,
    /// Greatest impulse of the linear rows together, and of the angle; and whether one of them is not infinite.
    most: Lanes,
    most_of_angle: Lanes,
    is_bounded: bool,
    /// Masks and laws of joints that their users made soft; and whether there are any.
    softened: Lanes,
    softness: BlockLaw,
    is_softened: bool,
    free: Option<BlockRow>,
    /// Impulses of the update so far on the second body: along x and y, and turning.
    total: Rows,
}

/// Joints that may share a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Kind {
    normal: Normal,
    has_free_row: bool,
}

impl Kind {
    /// How many there are.
    pub(super) const COUNT: usize = 6;

    pub(super) fn of(hold: &Hold) -> Self {
        Kind { normal: Normal::of(hold.link), has_free_row: free_row(hold).is_some() }
    }

    /// Its number.
    pub(super) fn number(self) -> usize {
        self.normal as usize * 2 + usize::from(self.has_free_row)
    }
}

impl SoftBlock {
    /// Without joints.
    pub(super) fn new(kind: Kind) -> Self {
        let infinite = f32x4::splat(f32::INFINITY);
        SoftBlock {
            holds: [NONE; 4],
            pair: BlockPair::new(kind.normal),
            kept: [ZERO; 3],
            mass: BlockMass::default(),
            errors: [ZERO; 3],
            impulses: [ZERO; 3],
            target: ZERO,
            most: infinite,
            most_of_angle: infinite,
            is_bounded: false,
            softened: ZERO,
            softness: BlockLaw::of(&Law::HARD),
            is_softened: false,
            free: kind.has_free_row.then(BlockRow::default),
            total: [ZERO; 3],
        }
    }

    /// Whether all lanes have joints.
    pub(super) fn is_full(&self) -> bool {
        self.holds[3] != NONE
    }

    /// Puts a joint into the first lane without one, in an update of so many seconds, and substeps of these. Answers whether the joint
    /// keeps something, drives or has had to push: a rope that hangs through does not.
    pub(super) fn put(&mut self, at: u32, hold: &Hold, bodies: &Bodies, times: [f64; 2]) -> bool {
        let lane = self.holds.iter().position(|&hold| hold == NONE).unwrap_or(3);
        self.holds[lane] = at;
        self.pair.set(lane, hold, bodies);
        let [nx, ny] = Frame::of(hold).normal();
        let [x, y, torque] = hold.force.map(|force| force * times[1]);
        let impulses = [x * nx + y * ny, torque, x * ny - y * nx];
        let kept = kept_rows(hold);
        for row in (0..3).filter(|row| kept >> row & 1 == 1) {
            put(&mut self.impulses[row], lane, impulses[row]);
            self.kept[row].as_mut_array()[lane] = f32::from_bits(!0);
        }
        let begun = if hold.link == Link::Distance { 0.0 } else { hold.angle };
        put(&mut self.target, lane, hold.range[0] - begun);
        if hold.most < f64::from(f32::MAX) {
            let is_linear = matches!(hold.link, Link::Point | Link::Distance);
            put(if is_linear { &mut self.most } else { &mut self.most_of_angle }, lane, hold.most);
            self.is_bounded = true;
        }
        if let Some(law) = Law::of_softness(hold, times) {
            self.softened.as_mut_array()[lane] = f32::from_bits(!0);
            self.softness.set(lane, &law);
            self.is_softened = true;
        }
        let mut acts = kept != 0;
        if let (Some(free), Some(row)) = (&mut self.free, free_row(hold)) {
            free.set(lane, hold, impulses[row], times[1]);
            acts |= hold.drive.is_some_and(|drive| drive.motor().is_some())
                || free.impulse().to_array()[lane] != 0.0;
        }
        acts
    }

    /// All joints are in it.
    pub(super) fn begin(&mut self, law: &Law, unit: f32) {
        self.pair.follow();
        self.follow();
        self.soften(&BlockLaw::of(law), unit);
    }

    /// Errors and effective masses follow the pair.
    fn follow(&mut self) {
        let ([along, across], way) = self.pair.places();
        let greatest = f32x4::splat(SOFT_ROW_ANGLE_ERROR as f32);
        let beyond = self.pair.turned - self.target;
        let is_distance = self.pair.way == Normal::Line;
        self.errors = [
            if is_distance { along - self.target } else { along },
            smaller(greater(beyond, ZERO - greatest), greatest),
            if is_distance { ZERO } else { across },
        ];
        let [mut diagonal, products] = self.pair.matrix();
        let row = self.row();
        if let Some(free) = &mut self.free {
            let length = match self.pair.way {
                Normal::Fixed => None,
                Normal::Axis => Some(way),
                Normal::Line => Some(along),
            };
            free.follow(self.pair.turned, length, narrow(diagonal[row]));
        }
        if self.is_softened {
            let compliance = wide(self.softness.compliance & self.softened);
            diagonal.iter_mut().for_each(|own| *own += compliance);
        }
        self.mass = BlockMass::of(diagonal, products, self.kept);
    }

    /// The free row.
    fn row(&self) -> usize {
        match self.pair.way {
            Normal::Fixed => ANGLE,
            Normal::Axis => ACROSS,
            Normal::Line => ALONG,
        }
    }

    /// Impulses of all rows, with those of motors and limits.
    #[inline(always)]
    fn all_impulses(&self) -> Rows {
        let mut impulses = self.impulses;
        if let Some(free) = &self.free {
            impulses[self.row()] += free.impulse();
        }
        impulses
    }

    /// Impulses of joints that another solver had are cut to what soft rows can take over: see [`HANDED_OVER_IMPULSE_LOSS`].
    fn soften(&mut self, law: &BlockLaw, unit: f32) {
        let [[ax, ay, aw], [bx, by, bw]] = self.pair.yields(self.impulses);
        let speeds = self.pair.relative(&[[ax, ay, aw, ZERO], [bx, by, bw, ZERO]]);
        let lost: Rows = std::array::from_fn(|row| (law.leak * speeds[row]) & self.kept[row]);
        let rate = f32x4::splat(HANDED_OVER_LOSS_PER_CORRECTION) * law.mass * law.bias;
        let closed: Rows = std::array::from_fn(|row| (rate * self.errors[row]) & self.kept[row]);
        let lever = f32x4::splat(SOFT_ROW_ARM * unit);
        let size = |rows: Rows| {
            let linear = (rows[ALONG] * rows[ALONG] + rows[ACROSS] * rows[ACROSS]).sqrt();
            [linear, greater(rows[ANGLE], ZERO - rows[ANGLE]) * lever]
        };
        let (lost, closed) = (size(lost), size(closed));
        for (rows, kind) in [(&[ALONG, ACROSS][..], 0), (&[ANGLE], 1)] {
            let most = f32x4::splat(HANDED_OVER_IMPULSE_LOSS * unit) + closed[kind];
            let is_cut = lost[kind].simd_gt(most) & (self.softened ^ f32x4::splat(f32::from_bits(!0)));
            for &row in rows {
                let impulse = self.impulses[row];
                self.impulses[row] = select(is_cut, impulse * (most / lost[kind]), impulse);
            }
        }
    }

    /// The impulses so far are to act at the beginning of every substep.
    pub(super) fn warm(&self, warm: &mut [[f32; 4]]) {
        self.pair.add(warm, self.all_impulses());
    }

    /// One pass over the rows: motors, limits, kept rows.
    #[inline(always)]
    pub(super) fn solve(&mut self, hot: &mut [Hot], of_pass: &BlockLaw, inverse_h: f32) {
        let mut velocities = self.pair.velocities(hot);
        let law = match self.is_softened {
            true => of_pass.or(self.softened, &self.softness),
            false => *of_pass,
        };
        let row = self.row();
        if let Some(free) = &mut self.free {
            let mut change = [ZERO; 3];
            change[row] = free.solve(self.pair.relative(&velocities)[row], &law, inverse_h);
            self.pair.push(&mut velocities, change);
        }
        let speeds = self.pair.relative(&velocities);
        let missing: Rows = std::array::from_fn(|row| {
            speeds[row] + law.bias * self.errors[row] + law.compliance * self.impulses[row]
        });
        let found = self.mass.times(missing);
        let mut next: Rows = std::array::from_fn(|row| law.next(self.impulses[row], found[row]));
        if self.is_bounded {
            next = self.bounded(next, missing, &law);
        }
        let change = std::array::from_fn(|row| next[row] - self.impulses[row]);
        self.impulses = next;
        self.pair.push(&mut velocities, change);
        self.pair.write(hot, velocities);
    }

    /// Joints that keep something whatever that takes, of bodies that a blow has reached: they keep what they hold in the velocities after
    /// it, and it reaches both of their bodies. Impulses before it were those with which bodies were stopped: warm starting with them
    /// would push again what has left. Motors, limits, soft and bounded joints share no blow. Answers the greatest speed that was missed.
    pub(super) fn bounce(
        &mut self,
        hot: &mut [Hot],
        (struck, list): (&mut [u32], &mut Vec<u32>),
        unit: f32,
    ) -> f32 {
        let infinite = f32x4::splat(f32::INFINITY);
        let is_hard = self.most.simd_eq(infinite) & self.most_of_angle.simd_eq(infinite);
        let [along, angle, across] = self.kept;
        let is_hard = is_hard & (along | angle | across);
        let reached = select(self.softened, ZERO, is_hard & self.pair.mask(struck));
        if reached.none() {
            return 0.0;
        }
        let mut velocities = self.pair.velocities(hot);
        let speeds = self.pair.relative(&velocities);
        let change = self.mass.times(speeds).map(|impulse| (ZERO - impulse) & reached);
        self.pair.push(&mut velocities, change);
        self.pair.write(hot, velocities);
        self.pair.mark(reached, struck, list);
        let impulses = self.on_second_of(change);
        (0..3).for_each(|i| self.total[i] += impulses[i]);
        self.impulses = self.impulses.map(|impulse| select(reached, ZERO, impulse));
        let size = |row: usize| greater(speeds[row], ZERO - speeds[row]) & self.kept[row] & reached;
        let missed =
            greater(greater(size(ALONG), size(ACROSS)), f32x4::splat(SOFT_ROW_ARM * unit) * size(ANGLE));
        missed.to_array().into_iter().fold(0.0, |most, missed| if missed > most { missed } else { most })
    }

    /// Impulses within the greatest ones: of the linear rows as a length; of the angle, with which they are solved again then.
    #[inline(never)]
    fn bounded(&self, mut next: Rows, missing: Rows, law: &BlockLaw) -> Rows {
        let size = (next[ALONG] * next[ALONG] + next[ACROSS] * next[ACROSS]).sqrt();
        let part = select(size.simd_gt(self.most), self.most / size, f32x4::splat(1.0));
        [ALONG, ACROSS].into_iter().for_each(|row| next[row] *= part);
        let angle = smaller(greater(next[ANGLE], ZERO - self.most_of_angle), self.most_of_angle);
        let is_cut = angle.simd_ne(next[ANGLE]);
        let change = angle - self.impulses[ANGLE];
        let [diagonal, products @ [beside_along, _, beside_across]] = self.pair.matrix();
        let mass = BlockMass::of(diagonal, products, [self.kept[ALONG], ZERO, self.kept[ACROSS]]);
        let [along, _, across] = missing;
        let [beside_along, beside_across] = [beside_along, beside_across].map(narrow);
        let found = mass.times([along + beside_along * change, ZERO, across + beside_across * change]);
        for row in [ALONG, ACROSS] {
            next[row] = select(is_cut, law.next(self.impulses[row], found[row]), next[row]);
        }
        next[ANGLE] = angle;
        next
    }

    /// Bodies have moved.
    pub(super) fn advance(&mut self, bodies: &mut Bodies) {
        self.pair.advance(bodies, self.all_impulses());
        self.follow();
    }

    /// Impulses of a substep on the second body: along x and y, and turning.
    fn on_second(&self) -> Rows {
        self.on_second_of(self.all_impulses())
    }

    fn on_second_of(&self, [along, angle, across]: Rows) -> Rows {
        let [nx, ny] = self.pair.normal;
        [along * nx + across * ny, along * ny - across * nx, angle]
    }

    /// The impulses of this substep have acted.
    pub(super) fn count_impulses(&mut self) {
        let impulses = self.on_second();
        (0..3).for_each(|i| self.total[i] += impulses[i]);
    }

    /// Forces and torques on the second bodies in the last substep, and their means over the update of `dt` seconds.
    pub(super) fn tell(&self, holds: &mut [Hold], [dt, h]: [f32; 2]) {
        let last = self.on_second();
        for (lane, &at) in self.holds.iter().enumerate().filter(|&(_, &at)| at != NONE) {
            let per_second = |rows: &Rows, seconds: f32| -> Triple {
                rows.map(|impulses| f64::from(impulses.to_array()[lane]) / f64::from(seconds) + 0.0)
            };
            let hold = &mut holds[at as usize];
            hold.force = per_second(&last, h);
            hold.mean_force = Some(per_second(&self.total, dt));
        }
    }
}

/// The rows that a joint keeps.
fn kept_rows(hold: &Hold) -> Set {
    let has_range = hold.range[0] < hold.range[1];
    match hold.link {
        Link::Point => 1 << ALONG | 1 << ACROSS,
        Link::Weld => 1 << ALONG | 1 << ANGLE | 1 << ACROSS,
        Link::Line => 1 << ALONG | 1 << ANGLE,
        Link::Distance if !has_range => 1 << ALONG,
        Link::Angle if !has_range => 1 << ANGLE,
        _ => 0,
    }
}
