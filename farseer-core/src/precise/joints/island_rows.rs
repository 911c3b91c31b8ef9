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
use super::tree::{Link, plus};

/// A part of a step for which rows are made.
#[derive(Debug, Clone, Copy)]
pub(in crate::precise) struct Span {
    /// Seconds that bodies move for, and seconds that forces act for.
    pub(in crate::precise) dt: f64,
    pub(in crate::precise) of_forces: f64,
    /// Substeps of the iterative solver that forces act for, and seconds of the whole step.
    pub(in crate::precise) substeps: f64,
    pub(in crate::precise) of_step: f64,
}

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

    /// Its rows in a span of the step.
    pub(in crate::precise) fn rows(&self, ends: Ends, span: Span, lever: f64) -> JointRows {
        let Span { dt, of_forces, substeps, of_step } = span;
        let frame = Frame::of(self);
        let jacobian = frame.jacobian();
        let prescribed = self.prescribed(ends);
        let impulses = self.impulses(&jacobian, of_forces);
        let mut rows = JointRows::new(ends, jacobian, impulses, prescribed, lever);
        let most = bound(self.most * substeps);
        let [low, high] = self.range;
        let mut hold = |row: usize, value: f64, most: f64| {
            if low < high {
                rows.limit(row, [value - low, high - value], Drive::NONE, [dt, most]);
            } else if most < f64::INFINITY {
                rows.keep_within(row, most, value - high, self.bias_factor / of_step);
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
        self.drive_rows(&mut rows, &frame, span);
        rows
    }

    /// Motor and limits.
    fn drive_rows(&self, rows: &mut JointRows, frame: &Frame, span: Span) {
        let Some(drive) = &self.drive else { return };
        let row = driven_row(self.link);
        let motor = drive.motor().map(|motor| Drive {
            speed: motor.speed.into(),
            most: bound(f64::from(motor.greatest_effort) * span.of_forces),
        });
        let travel = frame.travel(f64::from(drive.reference));
        match (motor, drive.limits()) {
            (motor, Some(limits)) => {
                let room = [travel - f64::from(limits.lower), f64::from(limits.upper) - travel];
                rows.limit(row, room, motor.unwrap_or(Drive::NONE), [span.dt, f64::INFINITY]);
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

    pub(in crate::precise) fn force_and_torque(&self) -> [f64; 3] {
        self.force
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

    /// Displacements of its two bodies in `dt` seconds, of members and of kinematic bodies.
    fn displacements(&self, ends: Ends, of_members: &[Triple], dt: f64) -> [Triple; 2] {
        let prescribed = self.prescribed(ends);
        [0, 1].map(|side: usize| match ends.bodies[side] {
            FIXED => prescribed[side].map(|velocity| velocity * dt),
            at => of_members[at as usize],
        })
    }

    /// Its bodies have been displaced in `dt` seconds.
    pub(in crate::precise) fn displace(&mut self, ends: Ends, of_members: &[Triple], dt: f64) {
        let displacements = self.displacements(ends, of_members, dt);
        let frame = Frame::of(self).displaced(displacements);
        for ((end, [x, y, _]), arm) in self.ends.iter_mut().zip(displacements).zip(frame.arms) {
            (end.place, end.arm) = (plus(end.place, [x, y], 1.0), arm);
        }
        (self.angle, self.axis) = (frame.angle, frame.axis);
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
        let frame = Frame::of(self).displaced(self.displacements(ends, displacements, dt));
        if is_jacobian_new {
            rows.set_jacobian(frame.jacobian());
        }
        rows.errors = self.errors(&frame);
    }

    /// Linearisation error of its rows for displacements of the members in `dt` seconds: change of their values beyond what the Jacobian
    /// says, in length units and radians.
    pub(in crate::precise) fn linearisation_error(
        &self,
        ends: Ends,
        displacements: &[Triple],
        dt: f64,
    ) -> Triple {
        let displacements = self.displacements(ends, displacements, dt);
        let before = Frame::of(self);
        let after = before.displaced(displacements);
        let told = before.jacobian().relative(displacements[0], displacements[1]);
        let values = |frame: &Frame| {
            let (gap, [nx, ny]) = (frame.gap(), frame.normal());
            match self.link {
                Link::Distance => [frame.distance(), 0.0],
                _ => [gap[0] * nx + gap[1] * ny, gap[0] * ny - gap[1] * nx],
            }
        };
        let ([along, across], [was_along, was_across]) = (values(&after), values(&before));
        [along - was_along - told[ALONG], 0.0, across - was_across - told[ACROSS]]
    }

    /// Position errors of the rows.
    fn errors(&self, frame: &Frame) -> Triple {
        let (gap, [nx, ny]) = (frame.gap(), frame.normal());
        let linear = [gap[0] * nx + gap[1] * ny, gap[0] * ny - gap[1] * nx];
        let mut errors = match self.link {
            Link::Point => [linear[0], 0.0, linear[1]],
            Link::Weld => [linear[0], frame.angle - self.range[0], linear[1]],
            Link::Line => [linear[0], frame.angle - self.range[0], 0.0],
            Link::Angle => [0.0, self.beyond(frame.angle), 0.0],
            _ => [self.beyond(frame.distance()), 0.0, 0.0],
        };
        if let Some((drive, limits)) = self.drive.and_then(|drive| Some((drive, drive.limits()?))) {
            let travel = frame.travel(f64::from(drive.reference));
            let [lower, upper] = [limits.lower, limits.upper].map(f64::from);
            errors[driven_row(self.link)] = travel - travel.clamp(lower, upper);
        }
        errors
    }
}
