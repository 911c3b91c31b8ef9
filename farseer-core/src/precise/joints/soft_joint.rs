//! A joint of the iterative solver in the substeps of an update: the rows that it keeps as one block, and its
//! [free row](super::free_row).
//!
//! Impulses are those of a substep: see [`SoftPair`].

use super::super::bodies::{Bodies, Hot};
use super::super::direct::block::Triple;
use super::super::direct::constraint::Set;
use super::super::direct::joint::{ACROSS, ALONG, ANGLE};
use super::frame::Frame;
use super::free_row::FreeRow;
use super::hold::Hold;
use super::soft_law::{GREATEST_ANGLE, Law, inverse_of, times, within};
use super::soft_pair::SoftPair;
use super::tree::Link;

/// A joint that another solver solved exactly hands over any impulse, of which a soft row loses a part in its first pass. This speed
/// in units of length per second, and this many times the speed with which the row closes its error, are the most that is lost.
/// Rows of the iterative solver at rest lose as much as they close.
const LEAST_LOST: f64 = 0.25;
const LOST_OF_CLOSED: f64 = 4.0;

/// Length in units of length that a turn by one radian counts as where speeds are compared: an arm inside of a body.
pub(super) const LEVER: f64 = 0.3;

/// The parameters that all joints of a pass share.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pass {
    pub(super) law: Law,
    /// Seconds of the substep.
    pub(super) h: f64,
}

/// The joint.
#[derive(Debug, Clone, Copy)]
pub(super) struct SoftJoint {
    /// Index of the joint in the list of joints.
    pub(super) hold: u32,
    pair: SoftPair,
    /// The kept rows, their effective mass as a block, position errors (length units, radians) and impulses.
    kept: Set,
    mass: [Triple; 3],
    errors: Triple,
    impulses: Triple,
    /// The distance or angle that is kept.
    target: f64,
    /// Greatest impulse: of a point or distance, or of the angle of what keeps more than that.
    most: f64,
    /// The law of a joint that its user made soft.
    softness: Option<Law>,
    free: Option<FreeRow>,
    /// Impulses of the update so far on the second body: along x and y, and turning.
    total: Triple,
}

impl SoftJoint {
    /// The joint at the beginning of an update.
    pub(super) fn new(at: u32, hold: &Hold, bodies: &Bodies, times: [f64; 2]) -> Self {
        let pair = SoftPair::new(&hold.ends, Frame::of(hold), bodies);
        let [nx, ny] = pair.jacobian.normal;
        let [x, y, torque] = hold.force.map(|force| force * times[1]);
        let impulses = [x * nx + y * ny, torque, x * ny - y * nx];
        let kept = kept_rows(hold);
        let keeps = |row: usize| kept >> row & 1 == 1;
        let mut joint = SoftJoint {
            hold: at,
            pair,
            kept,
            mass: [[0.0; 3]; 3],
            errors: [0.0; 3],
            impulses: std::array::from_fn(|row| if keeps(row) { impulses[row] } else { 0.0 }),
            target: hold.range[0],
            most: if hold.most < f64::from(f32::MAX) { hold.most } else { f64::INFINITY },
            softness: Law::of_softness(hold, times),
            free: FreeRow::of(hold, impulses, times[1]),
            total: [0.0; 3],
        };
        joint.follow_frame();
        joint
    }

    /// Whether it keeps something, drives or has had to push: a rope that hangs through does not.
    pub(super) fn acts(&self) -> bool {
        self.kept != 0 || self.free.is_some_and(|free| free.acts())
    }

    /// Errors and effective masses follow the frame.
    fn follow_frame(&mut self) {
        self.errors = self.find_errors();
        let mut matrix = self.pair.matrix();
        if let Some(free) = &mut self.free {
            free.follow(&self.pair.frame, matrix[free.row][free.row]);
        }
        if let Some(law) = &self.softness {
            (0..3).for_each(|row| matrix[row][row] += law.compliance);
        }
        self.mass = inverse_of(&matrix, self.kept);
    }

    fn find_errors(&self) -> Triple {
        let SoftPair { frame, jacobian, .. } = &self.pair;
        let (gap, [nx, ny]) = (frame.gap(), jacobian.normal);
        let linear = match frame.link {
            Link::Distance => [frame.distance() - self.target, 0.0],
            _ => [gap[0] * nx + gap[1] * ny, gap[0] * ny - gap[1] * nx],
        };
        [linear[0], within(frame.angle - self.target, GREATEST_ANGLE), linear[1]]
    }

    /// Impulses of all rows, with those of motor and limits.
    fn all_impulses(&self) -> Triple {
        let mut impulses = self.impulses;
        if let Some(free) = &self.free {
            impulses[free.row] += free.impulse();
        }
        impulses
    }

    /// Impulses of a joint that another solver had are cut to what soft rows can take over: see [`LEAST_LOST`].
    pub(super) fn soften(&mut self, law: &Law, unit: f64) {
        if self.softness.is_some() {
            return;
        }
        let [a, b] = self.pair.yields(self.impulses);
        let lost = self.pair.jacobian.relative(a, b).map(|speed| law.leak * speed);
        let closed = self.errors.map(|error| LOST_OF_CLOSED * law.mass * law.bias * error);
        let has = |row: usize| f64::from(self.kept >> row & 1);
        let size = |[along, angle, across]: Triple| {
            let linear = has(ALONG) * along * along + has(ACROSS) * across * across;
            [linear.sqrt(), has(ANGLE) * angle.abs() * LEVER * unit]
        };
        let (lost, closed) = (size(lost), size(closed));
        for (rows, kind) in [([ALONG, ACROSS], 0), ([ANGLE; 2], 1)] {
            let most = LEAST_LOST * unit + closed[kind];
            if lost[kind] > most {
                let part = most / lost[kind];
                let [one, other] = rows;
                self.impulses[one] *= part;
                if other != one {
                    self.impulses[other] *= part;
                }
            }
        }
    }

    /// The impulses so far are to act at the beginning of every substep.
    pub(super) fn warm(&self, warm: &mut [[f32; 4]]) {
        self.pair.warm(warm, self.pair.yields(self.all_impulses()));
    }

    /// One pass over its rows: motor, limits, kept rows.
    pub(super) fn solve(&mut self, hot: &mut [Hot], pass: &Pass) {
        let mut velocities = self.pair.velocities(hot);
        let law = self.softness.unwrap_or(pass.law);
        if let Some(mut free) = self.free {
            let speed = self.pair.jacobian.relative(velocities[0], velocities[1])[free.row];
            let mut change = [0.0; 3];
            change[free.row] = free.solve(speed, (&law, pass.h));
            self.free = Some(free);
            self.pair.push(&mut velocities, change);
        }
        if self.kept != 0 {
            self.solve_kept(&mut velocities, &law);
        }
        self.pair.write(hot, velocities);
    }

    /// The kept rows as one block.
    #[inline(always)]
    fn solve_kept(&mut self, velocities: &mut [Triple; 2], law: &Law) {
        let speeds = self.pair.jacobian.relative(velocities[0], velocities[1]);
        let missing: Triple = std::array::from_fn(|row| {
            speeds[row] + law.bias * self.errors[row] + law.compliance * self.impulses[row]
        });
        let found = times(&self.mass, missing);
        let mut next: Triple = std::array::from_fn(|row| law.next(self.impulses[row], found[row]));
        if self.most < f64::INFINITY {
            next = self.bounded(next, missing, law);
        }
        let change = std::array::from_fn(|row| next[row] - self.impulses[row]);
        self.impulses = next;
        self.pair.push(velocities, change);
    }

    /// Impulses within the greatest one: of a point as a length; of the angle of what keeps a point or line, too, with which that
    /// is solved again.
    #[cold]
    fn bounded(&self, mut next: Triple, missing: Triple, law: &Law) -> Triple {
        let most = self.most;
        match self.pair.frame.link {
            Link::Point => {
                let size = (next[ALONG] * next[ALONG] + next[ACROSS] * next[ACROSS]).sqrt();
                let part = if size > most { most / size } else { 1.0 };
                next.map(|impulse| part * impulse)
            }
            Link::Weld | Link::Line if next[ANGLE].abs() > most => {
                next[ANGLE] = within(next[ANGLE], most);
                let (matrix, change) = (self.pair.matrix(), next[ANGLE] - self.impulses[ANGLE]);
                let missing = std::array::from_fn(|row| missing[row] + matrix[row][ANGLE] * change);
                let found = times(&inverse_of(&matrix, self.kept & !(1 << ANGLE)), missing);
                for row in [ALONG, ACROSS] {
                    next[row] = law.next(self.impulses[row], found[row]);
                }
                next
            }
            Link::Weld | Link::Line => next,
            _ => next.map(|impulse| within(impulse, most)),
        }
    }

    /// Bodies have moved.
    pub(super) fn advance(&mut self, bodies: &mut Bodies) {
        self.pair.advance(bodies, self.all_impulses());
        self.follow_frame();
    }

    /// Impulses of a substep on the second body: along x and y, and turning.
    fn on_second(&self) -> Triple {
        let ([nx, ny], [along, angle, across]) = (self.pair.jacobian.normal, self.all_impulses());
        [along * nx + across * ny, along * ny - across * nx, angle]
    }

    /// The impulses of this substep have acted.
    pub(super) fn count_impulse(&mut self) {
        let impulses = self.on_second();
        (0..3).for_each(|i| self.total[i] += impulses[i]);
    }

    /// Force and torque on the second body in the last substep of `h` seconds.
    pub(super) fn force(&self, h: f64) -> Triple {
        self.on_second().map(|impulse| impulse / h + 0.0)
    }

    /// The mean force and torque of the update of `dt` seconds.
    pub(super) fn mean_force(&self, dt: f64) -> Triple {
        self.total.map(|impulse| impulse / dt + 0.0)
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
