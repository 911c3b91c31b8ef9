//! Joints as rows of an island in the [direct solver](crate::direct_solver): Jacobian, impulse bounds and position
//! errors.
//!
//! Up to two rows are linear, along the normal n and the tangent t = (n.y, -n.x); one is angular:
//!
//! | joint | n | row along n | angular row | row along t |
//! |---|---|---|---|---|
//! | revolute | (1, 0) | equality | motor and limits | equality |
//! | weld | (1, 0) | equality | equality with the largest impulse | equality |
//! | prismatic | across the axis | equality | equality | motor and limits |
//! | wheel | across the axis | equality | motor | servo, as a row of its own |
//! | pin, slider | from anchor A to anchor B | equality, or limits | | |
//! | gear | | | equality, with the ratio in the Jacobian of A | |
//! | angle, angle limit | | | equality, or limits | |
//!
//! A motor and both limits of a joint share one row. "Equality" means a bilateral row.

use super::super::direct_solver::constraint::{BodyIndices, FIXED, Jacobian};
use super::super::direct_solver::island_body::MemberVectors;
use super::super::direct_solver::joint::{ACROSS, ALONG, ANGLE, JointRows, MotorTarget};
use super::super::direct_solver::mat3::Vec3;
use super::frame::JointFrame;
use super::joint_constraint::JointConstraint;
use super::locked_dofs::LockedDofs;
use super::vec2::add_scaled;

/// The time interval for which the direct solver builds rows: a step or a fraction of it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StepInterval {
    /// Time for which bodies move in the interval, seconds, > 0.
    pub(crate) dt: f64,
    /// Time for which forces act in the interval, seconds, > 0.
    pub(crate) force_dt: f64,
    /// Number of substeps of the iterative solver in `force_dt`, not always an integer. The greatest impulse of a joint is
    /// given per substep.
    pub(crate) force_substeps: f64,
    /// Length of the whole step, seconds, > 0.
    pub(crate) step_dt: f64,
}

impl JointRows {
    /// Returns the force on body B along x and y (mass units * length units/s^2) and the torque (mass units * length
    /// units^2/s^2): the solved impulses, divided by the `dt` seconds in which they act.
    pub(crate) fn force_and_torque(&self, dt: f64) -> Vec3 {
        let (Jacobian { normal: [nx, ny], .. }, [along, angle, across]) = self.solution();
        let (x, y) = (along * nx + across * ny, along * ny - across * nx);
        [x, y, angle].map(|impulse| impulse / dt + 0.0)
    }
}

/// Returns the impulse limit in the unit of `impulse`: `impulse`, or infinity if `impulse` is `f32::MAX` or more.
fn finite_or_infinite(impulse: f64) -> f64 {
    if impulse < f64::from(f32::MAX) { impulse } else { f64::INFINITY }
}

impl JointConstraint {
    /// Returns whether the direct solver can solve the joint: it is rigid, and it is neither a pulley nor a revolute joint
    /// with a greatest impulse.
    ///
    /// The rows of a joint have one direction for both bodies. The greatest impulse bounds the length of a vector, which two rows with separate bounds cannot express.
    pub(crate) fn fits_direct_solver(&self) -> bool {
        self.softness == 0.0
            && self.locked != LockedDofs::Pulley
            && !(self.locked == LockedDofs::Point && self.max_impulse < f64::from(f32::MAX))
    }

    /// Returns the rows of the joint for an interval of the step, for the direct solver.
    ///
    /// `lever` converts angular errors to linear ones where errors are compared, length units per radian.
    pub(crate) fn constraint_rows(
        &self,
        body_indices: BodyIndices,
        interval: StepInterval,
        lever: f64,
    ) -> JointRows {
        let StepInterval { dt, force_dt: of_forces, force_substeps: substeps, step_dt: of_step } = interval;
        let frame = JointFrame::of(self);
        let jacobian = frame.jacobian();
        let prescribed = self.prescribed_velocities(body_indices);
        let impulses = self.row_impulses(&jacobian, of_forces);
        let mut rows = JointRows::new(body_indices, jacobian, impulses, prescribed, lever);
        let max_impulse = finite_or_infinite(self.max_impulse * substeps);
        let [low, high] = self.range;
        let mut add_row = |row: usize, value: f64, most: f64| {
            if low < high {
                rows.add_limited_row(row, [value - low, high - value], MotorTarget::NONE, [dt, most]);
            } else if most < f64::INFINITY {
                rows.add_bounded_row(row, most, value - high, self.bias_factor / of_step);
            } else {
                rows.add_bilateral_row(row, most);
            }
        };
        if self.locked == LockedDofs::Distance {
            add_row(ALONG, frame.distance(), max_impulse);
        } else {
            if self.locked.locks(ANGLE) {
                add_row(ANGLE, self.angle, max_impulse);
            }
            for row in [ALONG, ACROSS].into_iter().filter(|&row| self.locked.locks(row)) {
                rows.add_bilateral_row(row, f64::INFINITY);
            }
        }
        self.add_motor_and_limits(&mut rows, &frame, interval);
        rows
    }

    /// Adds the geometric stiffness of a distance joint under tension to its `rows`: the tension of the last force divided by the
    /// length, against motion across the axis.
    pub(crate) fn add_rod_stiffness(&self, rows: &mut JointRows, dt: f64) {
        if self.locked == LockedDofs::Distance {
            let frame = JointFrame::of(self);
            let [tension, ..] = self.row_impulses(&frame.jacobian(), -dt * dt);
            rows.add_transverse_stiffness(tension / frame.distance());
        }
    }

    /// Returns the distance of the anchors of a distance joint, in length units; `None` for other joints.
    pub(crate) fn rod_length(&self) -> Option<f64> {
        (self.locked == LockedDofs::Distance).then(|| JointFrame::of(self).distance())
    }

    /// Adds the row of motor and limits to `rows`, if the joint has a motor or limits.
    fn add_motor_and_limits(&self, rows: &mut JointRows, frame: &JointFrame, interval: StepInterval) {
        let Some(drive) = &self.drive else { return };
        let row = self.locked.motor_row();
        let motor = drive.motor.map(|motor| MotorTarget {
            speed: motor.speed.into(),
            max_impulse: finite_or_infinite(f64::from(motor.greatest_effort) * interval.force_dt),
        });
        let travel = frame.travel(f64::from(drive.reference));
        match (motor, drive.limits) {
            (motor, Some(limits)) => {
                let distances = [travel - f64::from(limits.lower), f64::from(limits.upper) - travel];
                rows.add_limited_row(
                    row,
                    distances,
                    motor.unwrap_or(MotorTarget::NONE),
                    [interval.dt, f64::INFINITY],
                );
            }
            (Some(motor), None) => rows.add_motor_row(row, motor),
            (None, None) => {}
        }
    }

    /// Returns the row impulses on body B that the stored force and torque give in `dt` seconds, in the order along the normal,
    /// angle, along the tangent. Unit: mass units * length units/s, for the angle mass units * length units^2/s.
    fn row_impulses(&self, jacobian: &Jacobian, dt: f64) -> Vec3 {
        let ([nx, ny], [x, y, torque]) = (jacobian.normal, self.force.map(|force| force * dt));
        [x * nx + y * ny, torque, x * ny - y * nx]
    }

    /// Returns the force on body B along x and y (mass units * length units/s^2) and the torque (mass units * length
    /// units^2/s^2).
    pub(crate) fn force_and_torque(&self) -> [f64; 3] {
        self.force
    }

    /// Stores the force and torque on body B: the solved impulses of `rows`, divided by the `force_dt` seconds in which they
    /// act.
    pub(crate) fn set_force_from_impulses(&mut self, rows: &JointRows, force_dt: f64) {
        self.force = rows.force_and_torque(force_dt);
    }

    /// Returns the velocities of the bodies A and B that the island does not contain: x and y in length units/s, angular in
    /// radians/s. They are 0 for bodies of the island and for static bodies.
    fn prescribed_velocities(&self, body_indices: BodyIndices) -> [Vec3; 2] {
        [0, 1].map(
            |side| if body_indices.bodies[side] == FIXED { self.anchors[side].velocity } else { [0.0; 3] },
        )
    }

    /// Returns whether a kinematic body moves an anchor of the joint.
    pub(crate) fn is_moved_by_kinematic_body(&self, body_indices: BodyIndices) -> bool {
        self.prescribed_velocities(body_indices) != [[0.0; 3]; 2]
    }

    /// Returns the displacements of A and B in `dt` seconds: x and y in length units, angle in radians.
    ///
    /// `island_displacements` holds the displacements of the island's bodies by index. Kinematic bodies move with their
    /// velocities.
    fn body_displacements(
        &self,
        body_indices: BodyIndices,
        island_displacements: &MemberVectors,
        dt: f64,
    ) -> [Vec3; 2] {
        let prescribed = self.prescribed_velocities(body_indices);
        [0, 1].map(|side: usize| match body_indices.bodies[side] {
            FIXED => prescribed[side].map(|velocity| velocity * dt),
            at => island_displacements[at],
        })
    }

    /// Sets anchors, angle and axis of the joint to those after the displacements of its bodies in `dt` seconds.
    /// `island_displacements` holds the displacements of the island's bodies: x and y in length units, angle in radians.
    pub(crate) fn displace(
        &mut self,
        body_indices: BodyIndices,
        island_displacements: &MemberVectors,
        dt: f64,
    ) {
        let displacements = self.body_displacements(body_indices, island_displacements, dt);
        let frame = JointFrame::of(self).displaced(displacements);
        for ((end, [x, y, _]), arm) in self.anchors.iter_mut().zip(displacements).zip(frame.arms) {
            (end.position, end.arm) = (add_scaled(end.position, [x, y], 1.0), arm);
        }
        (self.angle, self.axis) = (frame.angle, frame.axis);
    }

    /// Sets the position errors of `rows` to those at the displaced pose: after `displacements` of the island's bodies in `dt`
    /// seconds.
    ///
    /// With `is_jacobian_new` the rows also get the Jacobian of the displaced pose.
    pub(crate) fn update_errors(
        &self,
        rows: &mut JointRows,
        body_indices: BodyIndices,
        displacements: &MemberVectors,
        (dt, is_jacobian_new): (f64, bool),
    ) {
        let frame = JointFrame::of(self).displaced(self.body_displacements(body_indices, displacements, dt));
        if is_jacobian_new {
            rows.set_jacobian(frame.jacobian());
        }
        rows.errors = self.position_errors(&frame);
    }

    /// Returns the position errors of the rows along the normal, of the angle and along the tangent at the start of the step:
    /// length units, for the angle radians.
    pub(crate) fn initial_errors(&self) -> Vec3 {
        self.position_errors(&JointFrame::of(self))
    }

    /// Returns the linearisation errors of the rows along the normal, of the angle and along the tangent for these
    /// displacements, in length units (for the angle 0).
    ///
    /// The error is the change of a row's position minus the change that the Jacobian predicts.
    pub(crate) fn linearisation_error(
        &self,
        body_indices: BodyIndices,
        displacements: &MemberVectors,
        dt: f64,
    ) -> Vec3 {
        let displacements = self.body_displacements(body_indices, displacements, dt);
        let before = JointFrame::of(self);
        let after = before.displaced(displacements);
        let predicted = before.jacobian().relative_velocities(displacements[0], displacements[1]);
        if self.locked == LockedDofs::Distance {
            return [after.distance() - before.distance() - predicted[ALONG], 0.0, 0.0];
        }
        let values = |frame: &JointFrame| {
            let (gap, [nx, ny]) = (frame.anchor_offset(), frame.normal());
            [gap[0] * nx + gap[1] * ny, gap[0] * ny - gap[1] * nx]
        };
        let ([along, across], [was_along, was_across]) = (values(&after), values(&before));
        [along - was_along - predicted[ALONG], 0.0, across - was_across - predicted[ACROSS]]
    }

    /// Returns the position errors of the rows along the normal, of the angle and along the tangent at the pose `frame`: length
    /// units, for the angle radians. Errors within a range or between limits are 0.
    fn position_errors(&self, frame: &JointFrame) -> Vec3 {
        let (gap, [nx, ny]) = (frame.anchor_offset(), frame.normal());
        let linear = [gap[0] * nx + gap[1] * ny, gap[0] * ny - gap[1] * nx];
        let mut errors = match self.locked {
            LockedDofs::Point => [linear[0], 0.0, linear[1]],
            LockedDofs::Weld => [linear[0], frame.angle - self.range[0], linear[1]],
            LockedDofs::Line => [linear[0], frame.angle - self.range[0], 0.0],
            LockedDofs::PointOnLine => [linear[0], 0.0, 0.0],
            LockedDofs::Unlocked => [0.0; 3],
            LockedDofs::Gear => [0.0, frame.angle - self.range[0], 0.0],
            LockedDofs::Angle => [0.0, self.range_error(frame.angle), 0.0],
            _ => [self.range_error(frame.distance()), 0.0, 0.0],
        };
        if let Some((drive, limits)) = self.drive.and_then(|drive| Some((drive, drive.limits?))) {
            let travel = frame.travel(f64::from(drive.reference));
            let [lower, upper] = [limits.lower, limits.upper].map(f64::from);
            errors[self.locked.motor_row()] = travel - travel.clamp(lower, upper);
        }
        errors
    }
}
