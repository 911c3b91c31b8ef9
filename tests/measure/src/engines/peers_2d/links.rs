//! The joints and springs of a scene, in the units of another engine (peer): metres, kg, s and radians.

use super::parts::{BodyPart, double};
use super::state::{metres, point, square_metres};
use conformance::scene::{
    JointKind, JointSettings, JointSpec, Scene, SpringKind, SpringSettings, SpringSpec,
};
use farseer_core::math::Vector2;
use std::f64::consts::PI;

/// A joint or spring between two bodies, or between a body and the world.
#[derive(Debug, Clone)]
pub(super) struct Link {
    /// Index of the first body; `None` for the world.
    pub(super) body1: Option<usize>,
    pub(super) body2: usize,
    pub(super) kind: LinkKind,
}

/// Kind of a joint or spring. Anchors are in the coordinates of the two bodies, metres. Angles are the second body's rotation
/// minus the first body's, radians.
#[derive(Debug, Clone, Copy)]
pub(super) enum LinkKind {
    /// A revolute joint without limits and motor: the anchors coincide.
    Point { anchors: [[f32; 2]; 2] },
    /// A revolute joint: the anchors coincide. `limits` bound the angle minus `angle`, radians; `motor` is the target speed in
    /// radians/s and the greatest torque in N m.
    Hinge { anchors: [[f32; 2]; 2], angle: f32, limits: Option<[f32; 2]>, motor: Option<[f32; 2]> },
    /// A prismatic joint: the second anchor moves along an axis through the first. `angles` are the axis' directions in both
    /// bodies, radians.
    Slider { anchors: [[f32; 2]; 2], angles: [f32; 2] },
    /// A weld joint: the anchors coincide and the relative angle is constant, radians.
    Weld { anchors: [[f32; 2]; 2], angle: f32 },
    /// A distance joint: the distance of the anchors is `length` metres.
    Distance { anchors: [[f32; 2]; 2], length: f32 },
    /// A distance joint with limits: the distance of the anchors is between `min` and `max` metres.
    DistanceRange { anchors: [[f32; 2]; 2], min: f32, max: f32 },
    /// Keeps the relative angle at `angle` radians.
    Angle { angle: f32 },
    /// Keeps the relative angle between `min` and `max` radians.
    AngleRange { min: f32, max: f32 },
    /// A linear spring along the line between the anchors: rest length in metres, stiffness in N/m, damping in N s/m.
    Spring { anchors: [[f32; 2]; 2], length: f32, stiffness: f32, damping: f32 },
    /// An angular spring: rest angle in radians, stiffness in N m per radian.
    AngleSpring { angle: f32, stiffness: f32 },
}

/// Converts the joints and springs of a scene. The damping of an angular spring is put on the two bodies: it acts on each
/// body's angular velocity (behaviour chapter 11), not on the difference.
pub(super) fn links(scene: &Scene, bodies: &mut [BodyPart]) -> Result<Vec<Link>, String> {
    let mut links = Vec::new();
    let acts = |spec: &&JointSpec| spec.in_simulation && spec.settings.enabled != Some(false);
    for spec in scene.joints.iter().filter(acts) {
        check_joint(&spec.settings)?;
        links.push(joint(spec, bodies)?);
    }
    let acts = |spec: &&SpringSpec| spec.in_simulation && spec.settings.enabled != Some(false);
    for spec in scene.springs.iter().filter(acts) {
        check_spring(&spec.settings)?;
        links.extend(spring(spec, bodies)?);
    }
    Ok(links)
}

fn check_joint(settings: &JointSettings) -> Result<(), String> {
    if settings.softness.is_some_and(|softness| softness != 0.0) {
        return Err("no soft joints".to_owned());
    }
    if settings.breakpoint.is_some_and(|value| value < f32::MAX) {
        return Err("no joints that break by their error".to_owned());
    }
    if settings.max_impulse.is_some_and(|value| value < f32::MAX) {
        return Err("no joints with a greatest impulse".to_owned());
    }
    Ok(())
}

fn check_spring(settings: &SpringSettings) -> Result<(), String> {
    if settings.breakpoint.is_some_and(|value| value < f32::MAX) {
        return Err("no springs that break by their error".to_owned());
    }
    if settings.max_torque.is_some_and(|value| value < f32::MAX) {
        return Err("no springs with a greatest torque".to_owned());
    }
    Ok(())
}

/// The two bodies of a link under construction.
#[derive(Clone, Copy)]
struct Ends<'a> {
    bodies: &'a [BodyPart],
    body1: Option<usize>,
    body2: usize,
}

impl<'a> Ends<'a> {
    fn new(bodies: &'a [BodyPart], body1: Option<usize>, body2: usize) -> Result<Self, String> {
        let missing = body1.into_iter().chain([body2]).find(|&index| index >= bodies.len());
        match missing {
            Some(index) => Err(format!("a joint or spring names body {index}, which there is not")),
            None => Ok(Ends { bodies, body1, body2 }),
        }
    }

    fn link(self, kind: LinkKind) -> Link {
        Link { body1: self.body1, body2: self.body2, kind }
    }

    /// Returns the position of a point of the world in the coordinates of both bodies, metres.
    fn at(self, anchor: Vector2) -> [[f32; 2]; 2] {
        let anchor = double(anchor);
        let first = self.body1.map_or(anchor, |index| self.bodies[index].local(anchor));
        [first, self.bodies[self.body2].local(anchor)].map(point)
    }

    /// Returns the anchors in metres, in the coordinates of each body or of the world, and their present distance in px.
    fn between(self, anchor1: Vector2, anchor2: Vector2) -> ([[f32; 2]; 2], f64) {
        let (local1, local2) = (double(anchor1), double(anchor2));
        let first = self.body1.map_or(local1, |index| self.bodies[index].world(local1));
        let second = self.bodies[self.body2].world(local2);
        ([point(local1), point(local2)], (second[0] - first[0]).hypot(second[1] - first[1]))
    }

    /// Returns the second body's present rotation minus the first body's, radians.
    fn angle(self) -> f64 {
        let first = self.body1.map_or(0.0, |index| f64::from(self.bodies[index].angle));
        f64::from(self.bodies[self.body2].angle) - first
    }

    /// Returns the target angle in radians; `default` if it is `None`. Rejects an angle that a peer cannot distinguish from the
    /// angle one full turn away.
    fn distinct_angle(self, angle: Option<f32>, default: f64) -> Result<f32, String> {
        let angle = angle.map_or(default, f64::from);
        let away = (angle - self.angle()).abs();
        if away < PI { Ok(angle as f32) } else { Err(format!("no angle to be held that is {away} rad away")) }
    }
}

fn joint(spec: &JointSpec, bodies: &[BodyPart]) -> Result<Link, String> {
    let ends = |body1, body2| Ends::new(bodies, body1, body2);
    let settings = &spec.settings;
    Ok(match spec.kind {
        JointKind::Revolute { body1, body2, anchor } => {
            let ends = ends(Some(body1), body2)?;
            ends.link(LinkKind::Point { anchors: ends.at(anchor) })
        }
        JointKind::FixedRevolute { body, anchor } => {
            let ends = ends(None, body)?;
            ends.link(LinkKind::Point { anchors: ends.at(anchor) })
        }
        JointKind::Weld { body1, body2, anchor } => {
            let ends = ends(Some(body1), body2)?;
            ends.link(LinkKind::Weld { anchors: ends.at(anchor), angle: ends.angle() as f32 })
        }
        JointKind::Pin { body1, body2, anchor1, anchor2 } => {
            let ends = ends(Some(body1), body2)?;
            let (anchors, distance) = ends.between(anchor1, anchor2);
            let length = metres(settings.target_distance.map_or(distance, f64::from));
            ends.link(LinkKind::Distance { anchors, length })
        }
        JointKind::Slider { body1, body2, anchor1, anchor2, min, max } => {
            let ends = ends(Some(body1), body2)?;
            let (anchors, _) = ends.between(anchor1, anchor2);
            let [min, max] = [min, max].map(|length| metres(f64::from(length)));
            ends.link(LinkKind::DistanceRange { anchors, min, max })
        }
        // The target angle of an angle joint is not taken from the bodies' initial rotations, unlike that of an angle spring
        // (behaviour chapter 10).
        JointKind::Angle { body1, body2 } => {
            let ends = ends(Some(body1), body2)?;
            ends.link(LinkKind::Angle { angle: ends.distinct_angle(settings.target_angle, 0.0)? })
        }
        JointKind::FixedAngle { body } => {
            let ends = ends(None, body)?;
            ends.link(LinkKind::Angle { angle: ends.distinct_angle(settings.target_angle, 0.0)? })
        }
        JointKind::AngleLimit { body1, body2, lower_limit, upper_limit } => {
            angle_range(ends(Some(body1), body2)?, [lower_limit, upper_limit])?
        }
        JointKind::FixedAngleLimit { body, lower_limit, upper_limit } => {
            angle_range(ends(None, body)?, [lower_limit, upper_limit])?
        }
    })
}

fn angle_range(ends: Ends<'_>, [min, max]: [f32; 2]) -> Result<Link, String> {
    let middle = (f64::from(min) + f64::from(max)) / 2.0;
    let is_within_a_turn = |limit: f32| f64::from(limit).abs() < PI;
    if !(min <= max && is_within_a_turn(min) && is_within_a_turn(max)) {
        return Err(format!("no angle limits from {min} to {max} rad"));
    }
    ends.distinct_angle(Some(middle as f32), middle)?;
    Ok(ends.link(LinkKind::AngleRange { min, max }))
}

fn spring(spec: &SpringSpec, bodies: &mut [BodyPart]) -> Result<Option<Link>, String> {
    let (stiffness, damping) = (spec.spring_constant, spec.damping_constant);
    if !(stiffness >= 0.0 && damping >= 0.0) {
        return Err(format!("no stiffness of {stiffness} and damping of {damping}"));
    }
    if stiffness == 0.0 && damping == 0.0 {
        return Ok(None);
    }
    let (body1, body2, attached) = match spec.kind {
        SpringKind::Linear { body1, body2, attach_point1, attach_point2 } => {
            (Some(body1), body2, Some([attach_point1, attach_point2]))
        }
        SpringKind::FixedLinear { body, body_attach_point, world_attach_point } => {
            (None, body, Some([world_attach_point, body_attach_point]))
        }
        SpringKind::Angle { body1, body2 } => (Some(body1), body2, None),
        SpringKind::FixedAngle { body } => (None, body, None),
    };
    let ends = Ends::new(bodies, body1, body2)?;
    let Some([point1, point2]) = attached else {
        return angle_spring(spec, bodies, body1, body2).map(Some);
    };
    let (anchors, distance) = ends.between(point1, point2);
    let length = metres(spec.settings.rest_length.map_or(distance, f64::from));
    Ok(Some(ends.link(LinkKind::Spring { anchors, length, stiffness, damping })))
}

fn angle_spring(
    spec: &SpringSpec,
    bodies: &mut [BodyPart],
    body1: Option<usize>,
    body2: usize,
) -> Result<Link, String> {
    let ends = Ends::new(bodies, body1, body2)?;
    let angle = ends.distinct_angle(spec.settings.target_angle, ends.angle())?;
    // The sign of the torque multiplier has no effect.
    let factor = f64::from(spec.settings.torque_multiplier.unwrap_or(1.0)).abs();
    let stiffness = square_metres(factor * f64::from(spec.spring_constant));
    let link = ends.link(LinkKind::AngleSpring { angle, stiffness });
    let damping = square_metres(factor * f64::from(spec.damping_constant));
    for index in body1.into_iter().chain([body2]) {
        bodies[index].angular_damping += damping / bodies[index].inertia;
    }
    Ok(link)
}
