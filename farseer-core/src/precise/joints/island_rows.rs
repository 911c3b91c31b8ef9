//! Joints as rows of an island that the [direct solver](crate::precise::direct) takes: Jacobian, bounds and position errors.
//!
//! Up to two rows are linear, along a direction n and along t = (n.y, -n.x), and one is the angle:
//!
//! | joint | n | along n | angle | along t |
//! |---|---|---|---|---|
//! | revolute | (1, 0) | kept | motor and limits | kept |
//! | weld | (1, 0) | kept | kept by its greatest impulse | kept |
//! | prismatic | across the axis | kept | kept | motor and limits |
//! | pin, slider | along the line between the anchors | kept, or limits | | |
//! | angle, angle limit | | | kept, or limits | |
//!
//! One row is a motor and both limits of its travel.

use super::super::direct::block::Triple;
use super::super::direct::constraint::{Ends, FIXED, Jacobian};
use super::super::direct::joint::{ACROSS, ALONG, ANGLE, Drive, JointRows};
use super::frame::Frame;
use super::hold::Hold;
use super::tree::Link;

/// The row that motor and limits act on.
fn driven_row(link: Link) -> usize {
    if link == Link::Line { ACROSS } else { ANGLE }
}

/// A bound on an impulse; what is too great to be one is none.
fn bound(impulse: f64) -> f64 {
    if impulse < f64::from(f32::MAX) { impulse } else { f64::INFINITY }
}

impl Hold {
    /// Whether the direct solver can take it: it is not soft, and no greatest impulse limits a point, whose bound is round and not
    /// that of two rows.
    pub(in crate::precise) fn may_be_rows(&self) -> bool {
        self.softness == 0.0 && !(self.link == Link::Point && self.most < f64::from(f32::MAX))
    }

    /// How far it is from what it keeps when the step begins, with angles as lengths at this lever.
    pub(in crate::precise) fn error_as_length(&self, lever: f64) -> f64 {
        let scale = if self.link == Link::Angle { lever } else { 1.0 };
        f64::from(self.error).abs() * scale
    }

    /// Whether it has exerted a force or torque in the step before.
    pub(in crate::precise) fn has_force(&self) -> bool {
        self.force != [0.0; 3]
    }

    /// Its rows in a step of `dt` seconds and so many substeps.
    pub(in crate::precise) fn rows(&self, ends: Ends, [dt, substeps]: [f64; 2], lever: f64) -> JointRows {
        let frame = Frame::of(self);
        let jacobian = frame.jacobian();
        let prescribed = self.prescribed(ends);
        let mut rows = JointRows::new(ends, jacobian, self.impulses(&jacobian, dt), prescribed, lever);
        let most = bound(self.most * substeps);
        let [low, high] = self.range;
        let mut hold = |row: usize, value: f64, most: f64| {
            if low < high {
                rows.limit(row, [value - low, high - value], Drive::NONE, [dt, most]);
            } else if most < f64::INFINITY {
                rows.keep_within(row, most, value - high, self.bias_factor / dt);
            } else {
                rows.keep(row, most);
            }
        };
        match self.link {
            Link::Distance => hold(ALONG, frame.distance(), most),
            Link::Angle => hold(ANGLE, self.angle, most),
            Link::Weld | Link::Line => hold(ANGLE, self.angle, most),
            Link::Point | Link::Free | Link::Fixed => {}
        }
        if matches!(self.link, Link::Point | Link::Weld | Link::Line) {
            rows.keep(ALONG, f64::INFINITY);
        }
        if matches!(self.link, Link::Point | Link::Weld) {
            rows.keep(ACROSS, f64::INFINITY);
        }
        self.drive_rows(&mut rows, &frame, dt);
        rows
    }

    /// Motor and limits.
    fn drive_rows(&self, rows: &mut JointRows, frame: &Frame, dt: f64) {
        let Some(drive) = &self.drive else { return };
        let row = driven_row(self.link);
        let motor = drive.motor().map(|motor| Drive {
            speed: motor.speed.into(),
            most: bound(f64::from(motor.greatest_effort) * dt),
        });
        let travel = frame.travel(f64::from(drive.reference));
        match (motor, drive.limits()) {
            (motor, Some(limits)) => {
                let room = [travel - f64::from(limits.lower), f64::from(limits.upper) - travel];
                rows.limit(row, room, motor.unwrap_or(Drive::NONE), [dt, f64::INFINITY]);
            }
            (Some(motor), None) => rows.drive(row, motor),
            (None, None) => {}
        }
    }

    /// The impulses of a step by rows, from the force and torque on the second body.
    fn impulses(&self, jacobian: &Jacobian, dt: f64) -> Triple {
        let ([nx, ny], [x, y, torque]) = (jacobian.normal, self.force.map(|force| force * dt));
        [x * nx + y * ny, torque, x * ny - y * nx]
    }

    /// Force and torque on the second body by the impulses of a step.
    pub(in crate::precise) fn bear(&mut self, rows: &JointRows, dt: f64) {
        let (Jacobian { normal: [nx, ny], .. }, [along, angle, across]) = rows.found();
        let (x, y) = (along * nx + across * ny, along * ny - across * nx);
        self.force = [x, y, angle].map(|impulse| impulse / dt + 0.0);
    }

    /// Velocities of the two bodies as far as these are kinematic.
    fn prescribed(&self, ends: Ends) -> [Triple; 2] {
        [0, 1].map(|side| if ends.bodies[side] == FIXED { self.ends[side].velocity } else { [0.0; 3] })
    }

    /// Finds the position errors of its rows after displacements of the members in `dt` seconds, and its Jacobian there if that is to
    /// be new.
    pub(in crate::precise) fn find_errors(
        &self,
        rows: &mut JointRows,
        ends: Ends,
        displacements: &[Triple],
        (dt, is_jacobian_new): (f64, bool),
    ) {
        let prescribed = self.prescribed(ends);
        let displacement = |side: usize| match ends.bodies[side] {
            FIXED => prescribed[side].map(|velocity| velocity * dt),
            at => displacements[at as usize],
        };
        let frame = Frame::of(self).displaced([displacement(0), displacement(1)]);
        if is_jacobian_new {
            rows.set_jacobian(frame.jacobian());
        }
        let gap = frame.gap();
        let [nx, ny] = frame.normal();
        let linear = [gap[0] * nx + gap[1] * ny, gap[0] * ny - gap[1] * nx];
        rows.errors = match self.link {
            Link::Point => [linear[0], 0.0, linear[1]],
            Link::Weld => [linear[0], frame.angle - self.range[0], linear[1]],
            Link::Line => [linear[0], frame.angle - self.range[0], 0.0],
            Link::Angle => [0.0, self.beyond(frame.angle), 0.0],
            _ => [self.beyond(frame.distance()), 0.0, 0.0],
        };
        if let Some((drive, limits)) = self.drive.and_then(|drive| Some((drive, drive.limits()?))) {
            let travel = frame.travel(f64::from(drive.reference));
            let [lower, upper] = [limits.lower, limits.upper].map(f64::from);
            rows.errors[driven_row(self.link)] = travel - travel.clamp(lower, upper);
        }
    }
}
