//! A contact as the direct method sees it: rows of at most two points along the normal, and one of friction.

use super::block::Triple;
use super::factor::Entry;
use super::island::Member;
use crate::precise::rows::{Aside, Lane};

/// In place of a body's place in its island: it does not give way.
pub(super) const FIXED: u32 = u32::MAX;
/// The row of friction, after those of the points.
pub(super) const FRICTION: usize = 2;

/// How much deeper than others a point has to be that nothing loads.
const UNLOADED: f64 = 100.0;

/// Rows by bits.
pub(super) type Set = u8;

/// What a contact is between.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ends {
    /// Places in the island, or [`FIXED`].
    pub(super) bodies: [u32; 2],
    /// Of the two bodies' block, if both give way.
    pub(super) entry: Option<Entry>,
}

/// Where the rows of a contact act. They are relative velocities u = d (vB - vA) + wB b - wA a, with d the normal for points and
/// the tangent (normal y, -normal x) for friction.
#[derive(Debug, Clone, Copy)]
pub(super) struct Arms {
    pub(super) normal: [f64; 2],
    pub(super) a: Triple,
    pub(super) b: Triple,
}

impl Arms {
    #[inline(always)]
    pub(super) fn of(lane: &Lane) -> Self {
        let ([one, two], [a, b]) = (&lane.points, lane.tangent_arms);
        Arms {
            normal: lane.normal.map(f64::from),
            a: [one.arm_a, two.arm_a, a].map(f64::from),
            b: [one.arm_b, two.arm_b, b].map(f64::from),
        }
    }

    /// Relative velocities of all rows.
    #[inline(always)]
    pub(super) fn relative(&self, a: Triple, b: Triple) -> Triple {
        let ([nx, ny], [x, y]) = (self.normal, [b[0] - a[0], b[1] - a[1]]);
        let along = [x * nx + y * ny, x * nx + y * ny, x * ny - y * nx];
        std::array::from_fn(|row| along[row] + b[2] * self.b[row] - a[2] * self.a[row])
    }

    /// What impulses do to A and to B: their sum, and how they turn each.
    #[inline(always)]
    pub(super) fn push(&self, impulses: Triple) -> [Triple; 2] {
        let ([nx, ny], along) = (self.normal, impulses[0] + impulses[1]);
        let (x, y) = (along * nx + impulses[2] * ny, along * ny - impulses[2] * nx);
        let turn = |arms: &Triple| impulses[0] * arms[0] + impulses[1] * arms[1] + impulses[2] * arms[2];
        [[-x, -y, -turn(&self.a)], [x, y, turn(&self.b)]]
    }
}

/// A contact between two bodies of an island.
#[derive(Debug, Clone, Copy)]
pub(super) struct Contact {
    pub(super) bodies: [u32; 2],
    pub(super) entry: Option<Entry>,
    pub(super) arms: Arms,
    /// The rows there are.
    pub(super) rows: Set,
    /// What an impulse on each row weighs: velocity times this.
    pub(super) masses: Triple,
    /// The stiffness of each row in the present round.
    pub(super) stiffness: Triple,
    pub(super) friction: f64,
    /// How great friction may be.
    pub(super) bound: f64,
    pub(super) separations: [f64; 2],
    /// Velocity of each row by what does not give way.
    pub(super) carried: Triple,
    /// Velocity of each row above the one it may have: of points 0 and more, of friction 0.
    pub(super) excess: Triple,
    /// What the last direction would change of it.
    pub(super) change: Triple,
    /// Impulses of the whole step: now, when the step began, and when the round began.
    pub(super) impulses: Triple,
    pub(super) begun: Triple,
    pub(super) centre: Triple,
    /// Those that leave the least error.
    pub(super) best: Triple,
    /// Rows that yield as springs, rather than pressing nothing or sliding; and those that the factors were made for.
    pub(super) active: Set,
    pub(super) factored: Set,
}

impl Contact {
    /// Of a row whose impulses are of so many parts of a step, with velocities before impulses act.
    #[inline(always)]
    pub(super) fn new(row: &Aside, parts: f64, Ends { bodies, entry }: Ends) -> Self {
        let lane = &row.lane;
        let [one, two] = &lane.points;
        let is_there = |at: usize| lane.points[at].mass > 0.0;
        let rows = u8::from(is_there(0)) | u8::from(is_there(1)) << 1 | 1 << FRICTION;
        let impulses = impulses(row, parts);
        Contact {
            bodies,
            entry,
            arms: Arms::of(lane),
            rows,
            masses: [one.mass, two.mass, lane.tangent_mass].map(f64::from),
            stiffness: [0.0; 3],
            friction: f64::from(lane.friction),
            bound: 0.0,
            separations: [one.separation, two.separation].map(f64::from),
            carried: [0.0; 3],
            excess: [0.0, 0.0, -f64::from(lane.tangent_speed)],
            change: [0.0; 3],
            impulses,
            begun: impulses,
            centre: impulses,
            best: impulses,
            active: 0,
            factored: 0,
        }
    }

    /// A moves by itself.
    #[inline(always)]
    pub(super) fn carry(&mut self, velocity: Triple) {
        self.carried = self.arms.relative(velocity, [0.0; 3]);
        (0..3).for_each(|row| self.excess[row] += self.carried[row]);
    }

    /// Members move as they do now: they may come nearer by what points are apart, less `reach`, so many times in a unit of time.
    #[inline(never)]
    pub(super) fn meet(&mut self, members: &[Member], rate: f64, reach: f64) {
        let velocity = self.relative_of(|member| members[member].velocity);
        (0..3).for_each(|row| self.excess[row] += velocity[row]);
        for row in 0..2 {
            self.excess[row] += approach(self.separations[row], reach, rate);
        }
    }

    /// Separations are those after `dt` of velocities. Answers how deep the deepest point is that is to be taken out of what it
    /// is in, if that is deeper than `reach`.
    #[inline(never)]
    pub(super) fn advance(&mut self, members: &[Member], dt: f64, reach: f64) -> f64 {
        let velocity = self.relative_of(|member| members[member].velocity);
        let mut deepest = 0.0;
        for (row, velocity) in velocity.into_iter().enumerate().take(2) {
            self.separations[row] += dt * (velocity + self.carried[row]);
            if self.is_pressed_out(row, reach) && -self.separations[row] > deepest {
                deepest = -self.separations[row];
            }
        }
        deepest
    }

    #[inline(always)]
    pub(super) fn has(&self, row: usize) -> bool {
        self.rows >> row & 1 == 1
    }

    /// Relative velocities of all rows, with this of members.
    #[inline(always)]
    pub(super) fn relative_of(&self, of: impl Fn(usize) -> Triple) -> Triple {
        let [a, b] = self.bodies.map(|member| if member == FIXED { [0.0; 3] } else { of(member as usize) });
        self.arms.relative(a, b)
    }

    /// Relative velocities of all rows, with these of members.
    pub(super) fn relative_in(&self, members: &[Triple]) -> Triple {
        self.relative_of(|member| members[member])
    }

    /// Friction within its bound; what is no number stays none.
    pub(super) fn limited(&self, impulse: f64) -> f64 {
        within(self.bound, impulse)
    }

    /// How far the rows are from what they are to be, as velocities: those that press are to stand still, the others may not
    /// approach; friction stands still or is as great as it may be.
    #[inline(never)]
    pub(super) fn residual(&self) -> f64 {
        let mut worst = 0.0;
        let mut note = |velocity: f64| worst = if velocity.abs() <= worst { worst } else { velocity.abs() };
        for row in 0..2 {
            let (mass, impulse, excess) = (self.masses[row], self.impulses[row], self.excess[row]);
            if impulse > mass * excess {
                note(excess);
            } else if impulse > 0.0 {
                note(impulse / mass);
            }
        }
        let (mass, impulse) = (self.masses[FRICTION], self.impulses[FRICTION]);
        if mass > 0.0 {
            let wanted = impulse - mass * self.excess[FRICTION];
            let limited = within(self.bounded(), wanted);
            note(if limited == wanted { self.excess[FRICTION] } else { (limited - impulse) / mass });
        }
        worst
    }

    /// The impulses of springs from those of the round on, within their bounds, and which are not at a bound. What is not there
    /// has no stiffness, and presses nothing.
    #[inline(always)]
    pub(super) fn law(&self, excess: Triple) -> (Triple, Set) {
        let [one, two, along]: Triple =
            std::array::from_fn(|row| self.centre[row] - self.stiffness[row] * excess[row]);
        let (first, second, sticks) = (one > 0.0, two > 0.0, along.abs() <= self.bound);
        let impulses = [
            if first { one } else { 0.0 },
            if second { two } else { 0.0 },
            if sticks { along } else { self.bound.copysign(along) },
        ];
        let is_bounded = sticks & (self.bound > 0.0);
        (impulses, u8::from(first) | u8::from(second) << 1 | u8::from(is_bounded) << FRICTION)
    }

    /// A first guess: what has pressed goes on to, whatever it takes, and what has stuck sticks. Where nothing has pressed yet
    /// all that is not apart presses, and sticks: from one that meets to the next, as the bodies come upon each other, the set
    /// would take a step for each body of a column.
    pub(super) fn guess(&self, is_fresh: bool) -> (Triple, Set) {
        let presses = |row: usize| if is_fresh { self.is_near(row) } else { self.centre[row] > 0.0 };
        let free: Triple =
            std::array::from_fn(|row| self.centre[row] - self.stiffness[row] * self.excess[row]);
        let (mut impulses, mut active) = ([0.0; 3], 0);
        for row in (0..2).filter(|&row| presses(row)) {
            impulses[row] = free[row];
            active |= 1 << row;
        }
        let sticks = self.bound > 0.0 && self.centre[FRICTION].abs() < self.bound;
        impulses[FRICTION] = if sticks { free[FRICTION] } else { self.limited(self.centre[FRICTION]) };
        (impulses, active | u8::from(sticks) << FRICTION)
    }

    /// Friction's bound in the guess where nothing has pressed yet: none.
    pub(super) fn bound_of_fresh(&self) -> f64 {
        let is_near = self.is_near(0) || self.is_near(1);
        if is_near && self.friction > 0.0 { f64::INFINITY } else { 0.0 }
    }

    /// Whether a point would touch.
    fn is_near(&self, row: usize) -> bool {
        self.has(row) && self.excess[row] <= 0.0
    }

    /// Friction's bound, gone this part of the way to that of what presses now; the whole way from none.
    pub(super) fn followed_bound(&self, part: f64) -> f64 {
        let bounded = self.bounded();
        if self.bound.is_finite() { self.bound + part * (bounded - self.bound) } else { bounded }
    }

    /// Friction's bound at first, of what presses, or of what begins to.
    pub(super) fn first_bound(&self) -> f64 {
        let meets = (0..2).map(|row| (-self.excess[row] * self.masses[row]).max(0.0)).sum::<f64>();
        let presses = self.impulses[0] + self.impulses[1];
        self.friction * if presses == 0.0 { meets } else { presses }
    }

    /// Whether a point is to be taken out of what it is in, if that is deeper than `reach`.
    #[inline(always)]
    pub(super) fn is_pressed_out(&self, row: usize, reach: f64) -> bool {
        self.has(row) && is_pressed_out(self.impulses[row] > 0.0, self.separations[row], reach)
    }

    /// Friction is bounded by what presses.
    #[inline(always)]
    pub(super) fn bounded(&self) -> f64 {
        self.friction * (self.impulses[0] + self.impulses[1])
    }

    /// Stops a row of this velocity by itself, within its bounds; answers the impulse that this takes.
    pub(super) fn stopped(&mut self, row: usize, velocity: f64) -> Triple {
        let wanted = self.impulses[row] - self.masses[row] * velocity;
        self.bound = self.bounded();
        let impulse = if row == FRICTION { self.limited(wanted) } else { wanted.max(0.0) };
        let mut change = [0.0; 3];
        change[row] = impulse - self.impulses[row];
        self.impulses[row] = impulse;
        change
    }

    /// The impulses, and what is active, are those of springs now.
    #[inline(always)]
    pub(super) fn obey(&mut self) {
        (self.impulses, self.active) = self.law(self.excess);
    }
}

/// Impulses of the whole step, of a row whose impulses are of so many parts of it.
#[inline(always)]
pub(super) fn impulses(row: &Aside, parts: f64) -> Triple {
    let [one, two, along] = row.impulses().map(|impulse| impulse * parts);
    let of_point = |at: usize, impulse: f64| if row.lane.points[at].mass > 0.0 { impulse } else { 0.0 };
    [of_point(0, one), of_point(1, two), along]
}

/// How fast a point so far apart may come nearer: by what it is apart, less `reach`, so many times in a unit of time.
#[inline(always)]
pub(super) fn approach(separation: f64, reach: f64, rate: f64) -> f64 {
    let gap = separation - reach;
    if gap > 0.0 { gap * rate } else { 0.0 }
}

/// Whether a point is to be taken out of what it is in, if that is deeper than `reach`: one that presses, or is far deeper.
#[inline(always)]
pub(super) fn is_pressed_out(presses: bool, separation: f64, reach: f64) -> bool {
    presses | (separation < -UNLOADED * reach)
}

/// At most so much, either way; what is no number stays none.
#[inline(always)]
fn within(bound: f64, impulse: f64) -> f64 {
    if impulse.abs() <= bound { impulse } else { bound.copysign(impulse) }
}
