//! Joints are read when they or their bodies have changed, followed in every step, and told what held them.

use super::super::Precise;
use super::super::bodies::angle_of;
use super::super::tuning::Step;
use super::hold::{End, Hold, shown};
use super::swing::turned;
use super::tree::{Link, Vector};
use crate::body::BodyId;
use crate::body::entry::Bodies;
use crate::joints::held::Keeps;
use crate::joints::{Joint, JointId};
use crate::math::{Vector2, scalar};
use crate::objects::Objects;
use crate::report::{Event, Report};

fn vector(v: Vector2) -> Vector {
    [f64::from(v.x), f64::from(v.y)]
}

impl Precise {
    /// One side of a joint, the world if there is no body; `None` if the body is stale.
    pub(super) fn end(&self, id: Option<BodyId>, anchor: Vector2, bodies: &Bodies) -> Option<End> {
        let Some(id) = id else { return Some(End { arm: vector(anchor), ..End::default() }) };
        let body = &bodies.get(id)?.body;
        let Some(number) = self.number_of(id) else {
            let (sine, cosine) = scalar::sin_cos(body.rotation());
            let ([x, y], s, c) = (vector(anchor), f64::from(sine), f64::from(cosine));
            let arm = [c * x - s * y, s * x + c * y];
            return Some(End { place: vector(body.position()), arm, ..End::default() });
        };
        let gives_way = number < self.bodies.first_fixed()
            && self.bodies.inverses[number] != [0.0; 2]
            && !self.sleep.is_asleep(number);
        let mut end = End {
            body: if gives_way { number as u32 } else { 0 },
            pose: number as u32,
            anchor: vector(anchor),
            ..End::default()
        };
        end.follow(&self.bodies);
        Some(end)
    }

    /// A joint as it is now, unless it holds nothing that is there and gives way.
    fn hold(&self, joint: (JointId, &Joint), bodies: &Bodies) -> Option<Hold> {
        self.kept_by(joint, bodies).filter(|hold| hold.ends[0].body != hold.ends[1].body)
    }

    /// A joint as it is now, whether what it holds gives way or not; `None` if that is not there.
    fn kept_by(&self, (id, joint): (JointId, &Joint), bodies: &Bodies) -> Option<Hold> {
        let held = joint.held();
        let ends = [
            self.end(held.bodies.0, held.anchors[0], bodies)?,
            self.end(Some(held.bodies.1), held.anchors[1], bodies)?,
        ];
        let link = match held.keeps {
            Keeps::Point => Link::Point,
            Keeps::PointAndAngle => Link::Weld,
            Keeps::Angle => Link::Angle,
            Keeps::Distance => Link::Distance,
            Keeps::Line => Link::Line,
        };
        let yields = matches!(link, Link::Point | Link::Distance);
        let softness = if yields { f64::from(joint.softness()) } else { 0.0 };
        let mut hold = Hold {
            joint: id,
            bodies: held.bodies,
            link,
            ends,
            angle: 0.0,
            local_axis: vector(held.axis),
            axis: [0.0; 2],
            drive: held.drive,
            range: held.range.map(f64::from),
            slop: f64::from(held.slop).max(0.0),
            most: f64::from(held.most).abs(),
            softness: softness.max(0.0),
            // More than all of an error in an update would be undone again by the next one.
            bias_factor: f64::from(joint.bias_factor()).clamp(0.0, 1.0),
            behind: self.behind(held.keeps, held.bodies),
            has_moved: true,
            force: joint.force_and_torque(),
            force_along_depth: joint.force_along_depth(),
            mean_force: None,
            error: 0.0,
            arm: Vector2::zeros(),
        };
        hold.turn(bodies);
        Some(hold)
    }

    /// How far the second body of a joint that keeps a distance is behind the first.
    fn behind(&self, keeps: Keeps, bodies: (Option<BodyId>, BodyId)) -> f64 {
        match (keeps, &self.space, bodies) {
            (Keeps::Distance, Some(space), (Some(first), second)) => {
                f64::from(-space.behind(first, second)[0])
            }
            _ => 0.0,
        }
    }

    /// How far a joint is from what it keeps; `None` if it holds nothing.
    pub(crate) fn joint_error(&self, joint: (JointId, &Joint), bodies: &Bodies) -> Option<f32> {
        Some(self.hold(joint, bodies)?.find_error() as f32)
    }

    /// How far a joint is from what it keeps, asleep or not: a length, or an angle in radians if it keeps that alone.
    pub(crate) fn joint_gap(&self, joint: (JointId, &Joint), bodies: &Bodies) -> Option<f32> {
        Some(self.kept_by(joint, bodies)?.find_error() as f32)
    }

    /// Joints were lent out for editing.
    pub(crate) fn note_joints(&mut self) {
        self.joints.is_read = false;
    }

    /// Brings the joints to the poses of this step, and plans how they are solved.
    pub(crate) fn read_joints(&mut self, objects: &Objects, step: &Step) {
        self.read_springs(objects, step);
        self.joints.begin_update(self.tuning.unit);
        self.renew_joints(objects);
        let are_places_new = std::mem::take(&mut self.joints.are_places_new);
        let signature = self.joints.last_signature ^ self.springs.signature();
        self.direct.note_joints(signature, are_places_new);
        if self.joints.holds.is_empty() {
            return;
        }
        let mut joints = std::mem::take(&mut self.joints);
        if self.space.is_some() {
            let of_distance = joints.holds.iter_mut().filter(|hold| hold.link == Link::Distance);
            of_distance.for_each(|hold| hold.behind = self.behind(Keeps::Distance, hold.bodies));
        }
        if !joints.holds.is_empty() {
            let all_touched = self.rows.has_last();
            let is_touched =
                |body: usize| all_touched || !self.palette.is_free(body) || self.springs.pull_at(body);
            joints.begin(&self.bodies, objects, is_touched);
            joints.begin_in_space((&self.bodies, objects), (step, self.tuning.unit), is_touched, |id| {
                self.space.as_ref().map_or(0.0, |space| space.place_and_velocity(id)[0])
            });
        }
        self.joints = joints;
    }

    /// Reads and plans the joints, if something about them has changed.
    pub(super) fn renew_joints(&mut self, objects: &Objects) {
        if self.joints.is_read {
            return;
        }
        let mut joints = std::mem::take(&mut self.joints);
        joints.holds.clear();
        joints.tied.clear();
        joints.spatial.clear();
        let all = (0..objects.joints.list().len()).filter_map(|at| objects.joints.at(at));
        let enabled = all.filter(|(_, joint)| joint.enabled());
        joints.may_break = enabled.clone().any(|(_, joint)| joint.breakpoint() != f32::MAX);
        joints.holds.reserve(objects.joints.list().len());
        joints.holds.extend(enabled.filter_map(|joint| self.hold(joint, &objects.bodies)));
        joints.plan(&self.bodies, self.space.is_some());
        joints.last_signature = joints.signature();
        (joints.is_read, joints.are_places_new) = (true, true);
        self.joints = joints;
    }

    /// Joints learn how far they were from what they keep, where their anchors were, and what has held them; those that had
    /// to hold with too much break.
    pub(crate) fn write_joints(&mut self, objects: &mut Objects, report: &mut Report) {
        for hold in &mut self.joints.holds {
            let Some(joint) = objects.joints.get_mut(hold.joint) else { continue };
            joint.note(hold.error);
            joint.show_anchors(hold.arm, || hold.ends.map(|end| [shown(end.arm), shown(end.point())]));
            let mean = hold.mean_force.take().unwrap_or(hold.force);
            if joint.bear(hold.force, mean, hold.force_along_depth) {
                report.push(Event::JointBroke { joint: hold.joint });
                self.joints.is_read = false;
            }
            // What is not finite is forgotten there, and has to be here.
            (hold.force, hold.force_along_depth) = (joint.force_and_torque(), joint.force_along_depth());
        }
    }

    /// Whether some joint breaks where it is too far from what it keeps.
    pub(crate) fn may_break_joints(&self) -> bool {
        self.joints.may_break()
    }

    /// The joints that acted in this update, by their place among them.
    pub(crate) fn acting_joint(&self, at: usize) -> Option<JointId> {
        self.joints.holds.get(at).map(|hold| hold.joint)
    }
}

impl Hold {
    /// Finds the angle and the line that it keeps.
    fn turn(&mut self, bodies: &Bodies) {
        let of = |id: BodyId| bodies.get(id).map_or(0.0, |entry| f64::from(entry.body.total_rotation()));
        if self.turns() {
            self.angle = of(self.bodies.1) - self.bodies.0.map_or(0.0, of);
        }
        if self.link == Link::Line
            && let Some(entry) = self.bodies.0.and_then(|id| bodies.get(id))
        {
            let (sine, cosine) = libm::sincos(angle_of(entry.body.rotation()));
            self.axis = turned([cosine, sine], self.local_axis);
        }
    }

    /// Goes where its bodies are, and finds how far it is from what it keeps.
    pub(super) fn follow(&mut self, bodies: &super::Bodies, objects: &Objects) {
        let before = (self.ends, self.angle, self.axis, self.drive);
        self.ends.iter_mut().for_each(|end| end.follow(bodies));
        self.turn(&objects.bodies);
        // What a motor seeks may change in every step: that is no reason to plan anew.
        if self.drive.is_some() {
            self.drive = objects.joints.get(self.joint).and_then(Joint::drive).copied();
        }
        self.has_moved = before != (self.ends, self.angle, self.axis, self.drive);
        self.error = self.find_error() as f32;
        self.arm = shown(self.ends[0].arm);
    }
}
