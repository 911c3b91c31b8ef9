//! The row along which four joints leave their bodies free, as the iterative solver sees it: a motor, and limits on both sides.
//!
//! | joint | row | value |
//! |---|---|---|
//! | revolute | angle | radians from the angle of reference |
//! | prismatic | along the axis | length units |
//! | slider | along the line between the anchors | length units |
//! | angle limit | angle | radians |
//!
//! A joint without a motor has one whose greatest impulse is 0; one without limits has infinite ones.

use crate::precise::parameters::joints::SOFT_ROW_ANGLE_ERROR;
use wide::f32x4;

use super::super::direct::joint::{ACROSS, ALONG, ANGLE};
use super::block_pair::{Lanes, put};
use super::hold::Hold;
use super::soft_law::{BlockLaw, within};
use super::tree::Link;
use crate::math::lanes::{greater, positive, select, smaller};

const ZERO: Lanes = f32x4::ZERO;

/// The row, with impulses of a substep.
#[derive(Debug, Clone, Copy)]
pub(super) struct BlockRow {
    /// Reciprocal of the effective mass; 0 if neither body can move along it.
    inverse_mass: Lanes,
    /// The value, and the one when the update began.
    value: Lanes,
    begun: Lanes,
    /// A motor: the speed that it seeks, in length units/s or radians/s, its greatest impulse and its impulse.
    speed: Lanes,
    strength: Lanes,
    driven: Lanes,
    /// The range of the value; beyond a limit by `slop` nothing is corrected. The greatest impulse of a limit, and the greatest error
    /// that counts. Each limit pushes one way, and both impulses are 0 or more.
    limits: [Lanes; 2],
    slop: Lanes,
    most: Lanes,
    farthest: Lanes,
    impulses: [Lanes; 2],
}

impl Default for BlockRow {
    fn default() -> Self {
        let infinite = f32x4::splat(f32::INFINITY);
        BlockRow {
            inverse_mass: ZERO,
            value: ZERO,
            begun: ZERO,
            speed: ZERO,
            strength: ZERO,
            driven: ZERO,
            limits: [ZERO - infinite, infinite],
            slop: ZERO,
            most: infinite,
            farthest: infinite,
            impulses: [ZERO; 2],
        }
    }
}

impl BlockRow {
    /// Puts a joint into a lane, in substeps of `h` seconds, with the impulse that all of its row exerted last. The motor takes as much
    /// of the impulse as it can, and the limit on whose side the rest is takes that.
    pub(super) fn set(&mut self, lane: usize, hold: &Hold, impulse: f64, h: f64) {
        let drive = hold.drive;
        let mut rest = impulse;
        if let Some(motor) = drive.and_then(|drive| drive.motor()) {
            let most = f64::from(motor.greatest_effort) * h;
            let driven = within(impulse, most);
            rest -= driven;
            put(&mut self.speed, lane, motor.speed.into());
            put(&mut self.strength, lane, most);
            put(&mut self.driven, lane, driven);
        }
        let limits = match drive {
            Some(drive) => drive.limits().map(|limits| [limits.lower, limits.upper].map(f64::from)),
            None => Some(hold.range),
        };
        let reference = drive.map_or(0.0, |drive| f64::from(drive.reference));
        let is_angle = !matches!(hold.link, Link::Distance | Link::Line);
        if is_angle {
            put(&mut self.begun, lane, hold.angle - reference);
        }
        let Some(limits) = limits else { return };
        let (slop, most) = if drive.is_some() { (0.0, f64::INFINITY) } else { (hold.slop, hold.most) };
        let pushes = [rest, -rest].map(|impulse| if impulse > 0.0 { within(impulse, most) } else { 0.0 });
        for side in [0, 1] {
            put(&mut self.limits[side], lane, limits[side]);
            put(&mut self.impulses[side], lane, pushes[side]);
        }
        put(&mut self.slop, lane, slop);
        put(&mut self.most, lane, most);
        put(&mut self.farthest, lane, if is_angle { SOFT_ROW_ANGLE_ERROR } else { f64::INFINITY });
    }

    /// The value follows the bodies: an angle by how far they have turned, or a length.
    pub(super) fn follow(&mut self, turned: Lanes, length: Option<Lanes>, inverse_mass: Lanes) {
        self.inverse_mass = inverse_mass;
        self.value = length.unwrap_or(self.begun + turned);
    }

    /// The impulse of motor and limits together.
    #[inline(always)]
    pub(super) fn impulse(&self) -> Lanes {
        self.driven + (self.impulses[0] - self.impulses[1])
    }

    /// Solves motors, which are rigid, and then limits, at these relative velocities along the row. Answers the changes of the
    /// impulses.
    #[inline(always)]
    pub(super) fn solve(&mut self, mut speed: Lanes, law: &BlockLaw, inverse_h: f32) -> Lanes {
        let gives_way = self.inverse_mass.simd_gt(ZERO);
        let inverse = self.inverse_mass;
        let mass = (f32x4::splat(1.0) / inverse) & gives_way;
        let free = self.driven - (speed - self.speed) * mass;
        let driven = smaller(greater(free, ZERO - self.strength), self.strength);
        let mut change = (driven - self.driven) & gives_way;
        self.driven += change;
        speed += inverse * change;
        let soft_mass = (f32x4::splat(1.0) / (inverse + law.compliance)) & gives_way;
        for (side, sign) in [1.0, -1.0].into_iter().enumerate() {
            let more = self.solve_limit((side, f32x4::splat(sign)), speed, law, [mass, soft_mass], inverse_h);
            change += more;
            speed += inverse * more;
        }
        change
    }

    /// Solves the lower (0) or the upper limit (1). A limit that is not reached is a rigid row with u >= -room / h; one that is passed
    /// has the law of the pass. Answers the change of the impulse along the row.
    #[inline(always)]
    fn solve_limit(
        &mut self,
        (side, sign): (usize, Lanes),
        speed: Lanes,
        law: &BlockLaw,
        [mass, soft_mass]: [Lanes; 2],
        inverse_h: f32,
    ) -> Lanes {
        let (old, approach) = (self.impulses[side], sign * speed);
        let room = sign * (self.value - self.limits[side]);
        let is_apart = room.simd_gt(ZERO);
        let beyond = smaller(room + self.slop, ZERO);
        let rate = law.bias * greater(beyond, ZERO - self.farthest);
        let soft = law.next(old, soft_mass * (approach + rate + law.compliance * old));
        let rigid = old - mass * (approach + room * f32x4::splat(inverse_h));
        let new = smaller(positive(select(is_apart, rigid, soft)), self.most);
        let change = (new - old) & mass.simd_gt(ZERO);
        self.impulses[side] = old + change;
        sign * change
    }
}

/// The row along which motor or limits of a joint act; `None` if it has none of them.
pub(super) fn free_row(hold: &Hold) -> Option<usize> {
    let has_range = hold.range[0] < hold.range[1];
    match hold.link {
        Link::Distance => has_range.then_some(ALONG),
        Link::Angle => has_range.then_some(ANGLE),
        Link::Line => hold.drive.map(|_| ACROSS),
        _ => hold.drive.map(|_| ANGLE),
    }
}
