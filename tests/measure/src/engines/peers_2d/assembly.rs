//! Builds a joint scene in another engine (peer), in metres, kg and s.

use super::links::{Link, LinkKind};
use super::parts::{BodyPart, Form, Parts, ShapePart};
use super::state::{metres, point, square_metres};
use super::{box2d, rapier};
use crate::joints::assembly::{self, Assembly, BodyDef, JointDef, JointKind};
use crate::method::{Built, Setting};

/// Builds a joint scene in Box2D.
///
/// # Errors
///
/// The scene has a feature that Box2D lacks.
pub fn assemble_box2d(assembly: &Assembly, setting: Setting) -> Built {
    box2d::build_parts(&parts(assembly), setting)
}

/// Builds a joint scene in `rapier2d`.
///
/// # Errors
///
/// The scene has a feature that `rapier2d` lacks.
pub fn assemble_rapier(assembly: &Assembly, setting: Setting) -> Built {
    rapier::build_parts(&parts(assembly), setting)
}

fn parts(assembly: &Assembly) -> Parts {
    let bodies: Vec<_> = assembly.bodies.iter().map(body).collect();
    let shapes = assembly.bodies.iter().enumerate().filter_map(|(index, body)| shape(index, body));
    Parts {
        gravity: point([0.0, f64::from(assembly.gravity)]),
        takes_lesser_friction: false,
        shapes: shapes.collect(),
        links: assembly.joints.iter().map(|joint| link(&bodies, joint)).collect(),
        bodies,
    }
}

fn body(definition: &BodyDef) -> BodyPart {
    BodyPart {
        is_static: definition.is_static,
        mass: definition.mass,
        inertia: square_metres(f64::from(definition.inertia)),
        position: point(definition.position.map(f64::from)),
        angle: definition.angle,
        velocity: point(definition.velocity.map(f64::from)),
        angular_velocity: definition.angular_velocity,
        feels_gravity: true,
        linear_damping: 0.0,
        angular_damping: 0.0,
        rotational_drag: 0.0,
    }
}

fn shape(body: usize, definition: &BodyDef) -> Option<ShapePart> {
    let half = |extent: f32| metres(f64::from(extent) / 2.0);
    let form = match definition.form {
        assembly::Form::None => return None,
        assembly::Form::Rectangle(size) => {
            Form::Rectangle { centre: [0.0; 2], angle: 0.0, half_extents: size.map(half) }
        }
        assembly::Form::Circle(radius) => {
            Form::Circle { centre: [0.0; 2], radius: metres(f64::from(radius)) }
        }
    };
    // Groups are counted from 1 in the definition and from 0 in a peer.
    let group = usize::try_from(definition.group - 1).ok();
    Some(ShapePart { body, form, friction: definition.friction, restitution: 0.0, group })
}

fn link(bodies: &[BodyPart], joint: &JointDef) -> Link {
    let parts = [joint.body1, joint.body2].map(|index| &bodies[index]);
    let at = |anchor: [f32; 2]| parts.map(|part| point(part.local(anchor.map(f64::from))));
    let angle = parts[1].angle - parts[0].angle;
    let length_of = |length: f32| metres(f64::from(length));
    let kind = match joint.kind {
        JointKind::Hinge { anchor, limits: None, motor: None } => LinkKind::Point { anchors: at(anchor) },
        JointKind::Hinge { anchor, limits, motor } => {
            let motor = motor.map(|[speed, torque]| [speed, square_metres(f64::from(torque))]);
            LinkKind::Hinge { anchors: at(anchor), angle, limits, motor }
        }
        JointKind::Weld { anchor } => LinkKind::Weld { anchors: at(anchor), angle },
        JointKind::Slider { anchor, axis: [x, y] } => {
            let angles = parts.map(|part| y.atan2(x) - part.angle);
            LinkKind::Slider { anchors: at(anchor), angles }
        }
        JointKind::Rod { length } => LinkKind::Distance { anchors: [[0.0; 2]; 2], length: length_of(length) },
        JointKind::Spring { arm, length, stiffness, damping } => {
            let anchors = [point(arm.map(f64::from)), [0.0; 2]];
            LinkKind::Spring { anchors, length: length_of(length), stiffness, damping }
        }
    };
    Link { body1: Some(joint.body1), body2: joint.body2, kind }
}
