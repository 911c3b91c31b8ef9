//! The two bodies of four joints of a colour, side by side: relative poses, Jacobians, and what impulses do.
//!
//! Lanes without a joint have bodies 0 and inverse masses 0. No two lanes share a body that gives way.

use wide::{f32x4, f64x4};

use super::super::bodies::{Bodies, Hot};
use super::super::rows::set;
use super::frame::Frame;
use super::hold::Hold;
use super::tree::Link;
use crate::math::lanes::{select, sin_cos};
use crate::math::scalar::sin_cos_of_any;

/// Of four joints, by lane.
pub(super) type Lanes = f32x4;
/// By row: along n, of the angle, along t = (n.y, -n.x).
pub(super) type Rows = [Lanes; 3];
/// Velocity or displacement of four bodies: along x and y, turning, and along the depth axis.
type Motion = [Lanes; 4];

const ZERO: Lanes = f32x4::ZERO;

/// The same numbers in f64.
#[inline(always)]
pub(super) fn wide(lanes: Lanes) -> f64x4 {
    f64x4::new(lanes.to_array().map(f64::from))
}

/// Numbers rounded to f32.
#[inline(always)]
pub(super) fn narrow(lanes: f64x4) -> Lanes {
    f32x4::new(lanes.to_array().map(|number| number as f32))
}

/// Puts a number, rounded to f32, into a lane.
#[inline(always)]
pub(super) fn put(lanes: &mut Lanes, lane: usize, number: f64) {
    set(lanes, lane, number as f32);
}

/// How the direction n of the rows is found.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) enum Normal {
    /// It is (1, 0): of a point, a weld, an angle.
    #[default]
    Fixed,
    /// Across the axis of a prismatic joint.
    Axis,
    /// Along the line between the anchors.
    Line,
}

impl Normal {
    pub(super) fn of(link: Link) -> Self {
        match link {
            Link::Line => Normal::Axis,
            Link::Distance => Normal::Line,
            _ => Normal::Fixed,
        }
    }
}

/// The bodies.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct BlockPair {
    pub(super) way: Normal,
    /// Indices into [`Bodies::hot`] on both sides: 0 for what has no velocity.
    bodies: [[u32; 4]; 2],
    inverse_masses: [Lanes; 2],
    inverse_inertias: [Lanes; 2],
    arms: [[Lanes; 2]; 2],
    apart: [Lanes; 2],
    axis: [Lanes; 2],
    /// Radians by which the second body has turned against the first since the update began.
    pub(super) turned: Lanes,
    pub(super) normal: [Lanes; 2],
    /// Angular parts of the linear rows on both sides, along n and along t; that of the angle is 1.
    angular: [[Lanes; 2]; 2],
}

impl BlockPair {
    /// Without joints.
    pub(super) fn new(way: Normal) -> Self {
        BlockPair { way, ..BlockPair::default() }
    }

    /// Puts a joint into a lane.
    pub(super) fn set(&mut self, lane: usize, hold: &Hold, bodies: &Bodies) {
        let Frame { arms, apart, axis, .. } = Frame::of(hold);
        for side in [0, 1] {
            let end = &hold.ends[side];
            let is_listed = (end.pose as usize) < bodies.hot.len();
            self.bodies[side][lane] = if is_listed { end.pose } else { 0 };
            let [mass, inertia] = if end.body == 0 { [0.0; 2] } else { bodies.inverses[end.body as usize] };
            put(&mut self.inverse_masses[side], lane, mass.into());
            put(&mut self.inverse_inertias[side], lane, inertia.into());
            (0..2).for_each(|i| put(&mut self.arms[side][i], lane, arms[side][i]));
        }
        for i in 0..2 {
            put(&mut self.apart[i], lane, apart[i]);
            put(&mut self.axis[i], lane, axis[i]);
        }
    }

    /// Velocities of both bodies.
    #[inline(always)]
    pub(super) fn velocities(&self, hot: &[Hot]) -> [Motion; 2] {
        self.bodies.map(|of| f32x4::transpose(of.map(|body| f32x4::new(hot[body as usize].velocity))))
    }

    /// Bodies that give way take over these velocities.
    #[inline(always)]
    pub(super) fn write(&self, hot: &mut [Hot], velocities: [Motion; 2]) {
        for (side, velocities) in velocities.into_iter().enumerate() {
            let rows = f32x4::transpose(velocities);
            self.for_each_body(side, |lane, body| hot[body].velocity = rows[lane].to_array());
        }
    }

    /// Lanes and bodies that give way.
    #[inline(always)]
    fn for_each_body(&self, side: usize, mut act: impl FnMut(usize, usize)) {
        let (masses, inertias) =
            (self.inverse_masses[side].to_array(), self.inverse_inertias[side].to_array());
        for lane in 0..4 {
            if masses[lane] > 0.0 || inertias[lane] > 0.0 {
                act(lane, self.bodies[side][lane] as usize);
            }
        }
    }

    /// Relative velocities of the rows.
    #[inline(always)]
    pub(super) fn relative(&self, [a, b]: &[Motion; 2]) -> Rows {
        let ([nx, ny], [x, y, spin]) = (self.normal, [b[0] - a[0], b[1] - a[1], b[2] - a[2]]);
        let [[along_a, across_a], [along_b, across_b]] = self.angular;
        [
            x * nx + y * ny + (b[2] * along_b - a[2] * along_a),
            spin,
            x * ny - y * nx + (b[2] * across_b - a[2] * across_a),
        ]
    }

    /// Changes of velocity of both bodies by impulses of the rows.
    #[inline(always)]
    pub(super) fn yields(&self, [along, angle, across]: Rows) -> [[Lanes; 3]; 2] {
        let [nx, ny] = self.normal;
        let (x, y) = (along * nx + across * ny, along * ny - across * nx);
        let change = |side: usize, sign: Lanes| {
            let (mass, inertia) = (sign * self.inverse_masses[side], sign * self.inverse_inertias[side]);
            let [along_arm, across_arm] = self.angular[side];
            [mass * x, mass * y, inertia * (along * along_arm + angle + across * across_arm)]
        };
        [change(0, f32x4::splat(-1.0)), change(1, f32x4::splat(1.0))]
    }

    /// Impulses of the rows act on these velocities.
    #[inline(always)]
    pub(super) fn push(&self, velocities: &mut [Motion; 2], impulses: Rows) {
        for (velocity, change) in velocities.iter_mut().zip(self.yields(impulses)) {
            (0..3).for_each(|i| velocity[i] += change[i]);
        }
    }

    /// Masks of joints of which a body has one, of masks by body number.
    pub(super) fn mask(&self, masks: &[u32]) -> Lanes {
        let [a, b] = self.bodies;
        let of = |body: u32| if body == 0 { 0 } else { masks.get(body as usize).copied().unwrap_or(0) };
        f32x4::new(std::array::from_fn(|lane| f32::from_bits(of(a[lane]) | of(b[lane]))))
    }

    /// Gives the bodies of these lanes that give way a mask, and lists those that had none.
    pub(super) fn mark(&self, lanes: Lanes, masks: &mut [u32], list: &mut Vec<u32>) {
        for side in [0, 1] {
            self.for_each_body(side, |lane, body| {
                if lanes.to_array()[lane].to_bits() != 0 && std::mem::replace(&mut masks[body], !0) == 0 {
                    list.push(body as u32);
                }
            });
        }
    }

    /// Impulses are to act at the beginning of every substep: adds what they do to these sums by body.
    pub(super) fn add(&self, sums: &mut [[f32; 4]], impulses: Rows) {
        self.add_changes(sums, self.yields(impulses));
    }

    fn add_changes(&self, sums: &mut [[f32; 4]], changes: [[Lanes; 3]; 2]) {
        for (side, [x, y, turn]) in changes.into_iter().enumerate() {
            let rows = f32x4::transpose([x, y, turn, ZERO]);
            self.for_each_body(side, |lane, body| {
                sums[body] = (f32x4::new(sums[body]) + rows[lane]).to_array();
            });
        }
    }

    /// K = J M^-1 J^T: its diagonal, and the products of rows 0 and 1, 0 and 2, 1 and 2. With long arms f32 would lose the masses in
    /// it.
    pub(super) fn matrix(&self) -> [[f64x4; 3]; 2] {
        let linear = wide(self.inverse_masses[0]) + wide(self.inverse_masses[1]);
        let [ia, ib] = self.inverse_inertias.map(wide);
        let [[na, ta], [nb, tb]] = self.angular.map(|of_side| of_side.map(wide));
        [
            [linear + (ia * na * na + ib * nb * nb), ia + ib, linear + (ia * ta * ta + ib * tb * tb)],
            [ia * na + ib * nb, ia * na * ta + ib * nb * tb, ia * ta + ib * tb],
        ]
    }

    /// From the anchors of the first bodies to those of the second.
    #[inline(always)]
    fn gap(&self) -> [Lanes; 2] {
        std::array::from_fn(|i| self.apart[i] + self.arms[1][i] - self.arms[0][i])
    }

    /// The position errors along n and t, with the distance in place of the first one between anchors that keep theirs, and the way
    /// along the axis of prismatic joints.
    pub(super) fn places(&self) -> ([Lanes; 2], Lanes) {
        let ([x, y], [nx, ny]) = (self.gap(), self.normal);
        ([x * nx + y * ny, x * ny - y * nx], x * self.axis[0] + y * self.axis[1])
    }

    /// The Jacobian follows the poses.
    pub(super) fn follow(&mut self) {
        let [x, y] = self.gap();
        self.normal = match self.way {
            Normal::Fixed => [f32x4::splat(1.0), ZERO],
            Normal::Axis => [ZERO - self.axis[1], self.axis[0]],
            Normal::Line => {
                let distance = (x * x + y * y).sqrt();
                let is_apart = distance.simd_gt(ZERO);
                [select(is_apart, x / distance, f32x4::splat(1.0)), (y / distance) & is_apart]
            }
        };
        let ([nx, ny], [[ax, ay], [bx, by]]) = (self.normal, self.arms);
        // A prismatic joint acts on both bodies at the second anchor.
        let [ax, ay] = if self.way == Normal::Axis { [ax + x, ay + y] } else { [ax, ay] };
        let angular = |x: Lanes, y: Lanes| [x * ny - y * nx, ZERO - (x * nx + y * ny)];
        self.angular = [angular(ax, ay), angular(bx, by)];
    }

    /// Bodies have moved. Impulses that act again at the beginning of the next substep get the arms and directions of that: left as
    /// they were, they would gain energy where bodies turn.
    pub(super) fn advance(&mut self, bodies: &mut Bodies, impulses: Rows) {
        let before = self.yields(impulses);
        let [a, b]: [Motion; 2] =
            self.bodies.map(|of| f32x4::transpose(of.map(|body| f32x4::new(bodies.hot[body as usize].step))));
        for (arm, turn) in self.arms.iter_mut().zip([a[2], b[2]]) {
            *arm = turned(*arm, turn_of(turn));
        }
        if self.way == Normal::Axis {
            self.axis = turned(self.axis, turn_of(a[2]));
        }
        (0..2).for_each(|i| self.apart[i] += b[i] - a[i]);
        self.turned += b[2] - a[2];
        self.follow();
        let after = self.yields(impulses);
        let changes = [0, 1].map(|side| std::array::from_fn(|i| before[side][i] - after[side][i]));
        self.add_changes(&mut bodies.begun, changes);
    }
}

/// Sine and cosine of angles in radians.
#[inline(always)]
fn turn_of(angles: Lanes) -> (Lanes, Lanes) {
    let is_small = (angles * angles).simd_lt(f32x4::splat(10.0));
    if is_small.all() { sin_cos(angles) } else { turn_of_any(angles) }
}

#[cold]
fn turn_of_any(angles: Lanes) -> (Lanes, Lanes) {
    let of_each = angles.to_array().map(sin_cos_of_any);
    (f32x4::new(of_each.map(|(sine, _)| sine)), f32x4::new(of_each.map(|(_, cosine)| cosine)))
}

#[inline(always)]
fn turned([x, y]: [Lanes; 2], (sine, cosine): (Lanes, Lanes)) -> [Lanes; 2] {
    [cosine * x - sine * y, sine * x + cosine * y]
}
