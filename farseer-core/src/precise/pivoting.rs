//! A polygon that pivots over a static face from corner to corner, in closed form.
//!
//! Between two strikes the polygon is a compound pendulum about the corner that it stands on: its energy is constant. A strike
//! keeps the angular momentum about the corner that strikes, and takes the rest: with the arms r from the old and r' from the
//! new corner to the centre of mass, the spin w becomes w (I + m r . r') / (I + m r'^2) (T. McGeer, "Passive Dynamic Walking",
//! 1990: the rimless wheel). Substeps resolve neither: a wheel of 96 corners strikes several times in one, and the part of a
//! substep by which a strike comes late is as large as its loss.

use super::outline::Outline;
use crate::math::plane::{Vector, cross, difference, dot, length, scaled, sum, turn};
use crate::math::scalar;
use crate::precise::parameters::contacts::{PIVOT_IMPACTS_PER_STEP, PIVOT_LEAST_SUBSTEP, PIVOT_SLIP};

/// A polygon, the face under it, and the forces on it in this step.
#[derive(Clone, Copy)]
pub(super) struct Pivoting<'a> {
    pub(super) outline: Outline<'a>,
    /// Cosine and sine of the rotation of the polygon when the step begins.
    pub(super) rotation: [f32; 2],
    /// Unit normal of the face towards the polygon.
    pub(super) normal: Vector,
    /// Square of the radius of gyration, I / m, in square length units.
    pub(super) gyration: f32,
    /// Acceleration by forces, length units/s^2, and by torques, rad/s^2.
    pub(super) acceleration: Vector,
    pub(super) angular_acceleration: f32,
    pub(super) friction: f32,
    /// Fastest strike that does not bounce, length units/s.
    pub(super) quiet: f32,
}

/// A polygon on one of its corners.
#[derive(Debug, Clone, Copy)]
pub(super) struct OnCorner {
    /// Index of the corner.
    corner: usize,
    /// From the corner to the centre of mass, length units.
    arm: Vector,
    /// Rotation since the step began, rad, and its rate, rad/s.
    pub(super) turned: f32,
    pub(super) spin: f32,
    /// Path of the centre of mass since the step began, length units.
    pub(super) path: Vector,
    /// Force of the face on the polygon per unit of mass, length units/s^2.
    pub(super) reaction: Vector,
}

impl OnCorner {
    pub(super) fn velocity(&self) -> Vector {
        perpendicular(scaled(self.arm, self.spin))
    }
}

/// The corner that strikes next, and the rotation until then, >= 0, in rad.
struct Strike {
    corner: usize,
    angle: f32,
}

impl Pivoting<'_> {
    /// The polygon after `dt` seconds, integrated in parts of `h` seconds. `None` if it slips, hops, bounces, or has not the
    /// energy to pass the corners that it stands on: then it rocks, and comes to rest.
    pub(super) fn after(&self, ends: [u32; 2], velocity: [f32; 3], dt: f32, h: f32) -> Option<OnCorner> {
        let (mut state, mut left) = (self.begin(ends, velocity)?, dt);
        for _ in 0..PIVOT_IMPACTS_PER_STEP {
            let next = self.next(&state)?;
            self.passes_top(&state, next.angle).then_some(())?;
            left = self.pivot(&mut state, next.angle, left, h)?;
            if left <= 0.0 {
                return Some(state);
            }
            self.strike(&mut state, next.corner)?;
        }
        None
    }

    fn begin(&self, ends: [u32; 2], [x, y, spin]: [f32; 3]) -> Option<OnCorner> {
        let arm_of = |end: u32| scaled(turn(self.rotation, self.outline.points[end as usize]), -1.0);
        let slip_of = |arm: Vector| length(difference([x, y], perpendicular(scaled(arm, spin))));
        let [slip, other] = ends.map(|end| slip_of(arm_of(end)));
        let corner = if slip < other { ends[0] } else { ends[1] } as usize;
        let arm = arm_of(corner as u32);
        (slip_of(arm) <= PIVOT_SLIP * spin.abs() * length(arm)).then_some(())?;
        let momentum = self.gyration * spin + cross(arm, [x, y]);
        let spin = momentum / (self.gyration + dot(arm, arm));
        let state = OnCorner { corner, arm, turned: 0.0, spin, path: [0.0; 2], reaction: [0.0; 2] };
        self.bears(&state).map(|reaction| OnCorner { reaction, ..state })
    }

    fn next(&self, state: &OnCorner) -> Option<Strike> {
        let count = self.outline.points.len();
        let (side, ahead) = if state.spin > 0.0 { (1.0, count - 1) } else { (-1.0, 1) };
        let corner = (state.corner + ahead) % count;
        let edge = difference(self.outline.points[corner], self.outline.points[state.corner]);
        let edge = turn(self.rotation, edge);
        let (sine, cosine) = scalar::sin_cos(state.turned);
        let edge = turn([cosine, sine], edge);
        let along = scaled(perpendicular(self.normal), side);
        let angle = scalar::atan2(dot(edge, self.normal), dot(edge, along));
        (angle > -PIVOT_SLIP).then_some(Strike { corner, angle: scalar::max(angle, 0.0) })
    }

    /// Whether the energy of the polygon carries its centre of mass over the corner, if that is before the strike.
    fn passes_top(&self, state: &OnCorner, angle: f32) -> bool {
        let side = if state.spin > 0.0 { 1.0 } else { -1.0 };
        let rises = |arm: Vector| dot(self.acceleration, perpendicular(scaled(arm, side))) < 0.0;
        let (arm, inertia) = (state.arm, self.gyration + dot(state.arm, state.arm));
        if !rises(arm) || rises(turned(arm, side * angle)) {
            return true;
        }
        let lift = length(self.acceleration) * length(arm) + dot(self.acceleration, arm);
        let braked = scalar::min(self.gyration * self.angular_acceleration * side, 0.0) * angle;
        state.spin * state.spin * inertia > 2.0 * (lift - braked)
    }

    /// Pivots until the strike at this angle, or for the time that is left: answers what is left then.
    fn pivot(&self, state: &mut OnCorner, angle: f32, mut left: f32, h: f32) -> Option<f32> {
        let (first, side) = (*state, if state.spin > 0.0 { 1.0 } else { -1.0 });
        let inertia = self.gyration + dot(first.arm, first.arm);
        let mut turned_by = 0.0;
        loop {
            let t = scalar::min(left, h);
            let free = state.spin * t + 0.5 * self.angular(state) * t * t;
            let is_flat = (turned_by + free) * side >= angle;
            let to = if is_flat { side * angle } else { turned_by + free };
            let change = difference(turned(first.arm, to), first.arm);
            let work = dot(self.acceleration, change) + self.gyration * self.angular_acceleration * to;
            let squared = first.spin * first.spin + 2.0 * work / inertia;
            (squared > 0.0).then_some(())?;
            let spin = side * squared.sqrt();
            let passed = if is_flat { 2.0 * (to - turned_by) / (state.spin + spin) } else { t };
            left -= scalar::max(scalar::min(passed, t), 0.0);
            turned_by = to;
            (state.turned, state.spin) = (first.turned + to, spin);
            (state.arm, state.path) = (sum(first.arm, change), sum(first.path, change));
            state.reaction = self.bears(state)?;
            if left <= PIVOT_LEAST_SUBSTEP * h {
                return Some(0.0);
            }
            if is_flat {
                return Some(left);
            }
        }
    }

    fn strike(&self, state: &mut OnCorner, corner: usize) -> Option<()> {
        let edge = difference(self.outline.points[corner], self.outline.points[state.corner]);
        let (sine, cosine) = scalar::sin_cos(state.turned);
        let edge = turn([cosine, sine], turn(self.rotation, edge));
        (state.spin.abs() * length(edge) <= self.quiet).then_some(())?;
        let (before, arm) = (state.velocity(), difference(state.arm, edge));
        let kept = (self.gyration + dot(arm, state.arm)) / (self.gyration + dot(arm, arm));
        (kept > 0.0).then_some(())?;
        (state.corner, state.arm, state.spin) = (corner, arm, kept * state.spin);
        self.holds(difference(state.velocity(), before)).then_some(())
    }

    /// Angular acceleration about the corner, rad/s^2.
    fn angular(&self, state: &OnCorner) -> f32 {
        let torque = cross(state.arm, self.acceleration) + self.gyration * self.angular_acceleration;
        torque / (self.gyration + dot(state.arm, state.arm))
    }

    /// The reaction of the face per unit of mass, if the face can give it.
    fn bears(&self, state: &OnCorner) -> Option<Vector> {
        let spun = perpendicular(scaled(state.arm, self.angular(state)));
        let drawn = scaled(state.arm, -state.spin * state.spin);
        let reaction = difference(sum(spun, drawn), self.acceleration);
        self.holds(reaction).then_some(reaction)
    }

    /// Whether a force or an impulse presses the two together and stays within the limit of friction.
    fn holds(&self, force: Vector) -> bool {
        let pressed = dot(force, self.normal);
        pressed >= 0.0 && cross(self.normal, force).abs() <= self.friction * pressed
    }
}

fn perpendicular([x, y]: Vector) -> Vector {
    [-y, x]
}

fn turned(arm: Vector, angle: f32) -> Vector {
    let (sine, cosine) = scalar::sin_cos(angle);
    turn([cosine, sine], arm)
}
