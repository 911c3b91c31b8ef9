//! Ragdolls of eleven bones that fall on five floors. The oldest are removed as new ones are added.

use super::{count, fall_speed, ground};
use crate::arena::joint::Joint;
use crate::arena::scene::{Action, Body, Form, Limits, Scene, Shape};
use std::f32::consts::PI;

/// Number of floors. Ragdolls fall on each of them.
const FLOORS: usize = 5;
/// Number of ragdolls that are added beside each other above each floor.
const ABREAST: usize = 5;
/// Distance between neighbouring floors in metres.
const STOREY: f32 = 45.0;
/// Number of ragdolls that are added in one step, on all floors.
const GROUP: usize = FLOORS * ABREAST;
/// Width and height of a square tile of the floors, in metres.
const TILE: f32 = 0.5;
/// Number of steps after which a ragdoll is removed.
const LIFE: usize = 320;

pub(super) fn rain(size: f32) -> Scene {
    let columns = count(40, size);
    // The ragdolls above a floor are 2 m wide together; a floor has at least 32 tiles (16 m).
    let tiles = count(500, size).max(32);
    let span = tiles as f32 * TILE;
    let limits = Limits { bounds: None, speed: fall_speed(STOREY * 7.0), overlap: 0.1, gap: 0.1 };
    let mut scene = Scene::empty(1000, limits);
    let tile = |floor: usize, index: usize| {
        let at = [TILE * index as f32 - 0.5 * span, STOREY * floor as f32];
        let mut tile = Shape::rectangle([0.5 * TILE; 2], at);
        // The mean of 0.493 and the 0.2 of ragdolls is the geometric mean of 0.6 and 0.2.
        tile.mean_surface[0] = 0.493;
        tile
    };
    scene.add(ground(
        (0..FLOORS).flat_map(|floor| (0..=tiles).map(move |index| tile(floor, index))).collect(),
    ));
    scene.script = Some(Box::new(move |step| actions(step, columns, span)));
    scene
}

/// Returns the actions before a step. At regular intervals the next of `columns` columns gets a new group of ragdolls, and
/// its old group is removed. `span` is the width of the floors in metres.
fn actions(step: usize, columns: usize, span: f32) -> Vec<Action> {
    let pause = (LIFE / columns).max(1);
    if !step.is_multiple_of(pause) {
        return Vec::new();
    }
    let group = step / pause;
    let mut actions = Vec::new();
    if let Some(old) = group.checked_sub(columns) {
        let joints = old * GROUP * (BONES - 1)..(old + 1) * GROUP * (BONES - 1);
        let bodies = 1 + old * GROUP * BONES..1 + (old + 1) * GROUP * BONES;
        actions.extend(joints.map(Action::RemoveJoint).chain(bodies.map(Action::RemoveBody)));
    }
    let left = span * (((group % columns) as f32 + 0.5) / columns as f32 - 0.5);
    for number in 0..GROUP {
        let (floor, place) = (number / ABREAST, number % ABREAST);
        let at = [left + 0.5 * place as f32, 40.0 + STOREY * floor as f32];
        let first = 1 + (group * GROUP + number) * BONES;
        add_ragdoll(&mut actions, at, first, place as u32 + 1);
    }
    actions
}

/// Category bit of bones.
const BONE: u32 = 2;
/// Category bit of feet, which collide with the ground alone.
const FOOT: u32 = 4;

/// A bone of a ragdoll: a capsule along y, and the joint to its parent.
#[derive(Clone, Copy)]
struct Bone {
    /// Height of the bone's origin above that of the ragdoll, in metres.
    y: f32,
    /// Lower and upper end of the capsule's axis above the bone's origin, and its radius, in metres.
    capsule: [f32; 3],
    /// Index of the parent bone, to which the joint connects this bone.
    parent: usize,
    /// Height of the joint above the ragdoll's origin, in metres.
    pivot: f32,
    /// Least and greatest joint angle, in half turns (pi rad).
    limits: [f32; 2],
    /// Greatest torque of the joint's friction in newton metres.
    friction: f32,
    /// Relative angle in rad at which the joint angle is 0.
    reference: f32,
    damping: f32,
    has_foot: bool,
}

const fn bone(y: f32, capsule: [f32; 3], parent: usize, pivot: f32, limits: [f32; 2], friction: f32) -> Bone {
    let (reference, damping, has_foot) = (0.0, 0.0, false);
    Bone { y, capsule, parent, pivot, limits, friction, reference, damping, has_foot }
}

const UPPER_LEG: Bone = bone(0.775, [-0.125, 0.125, 0.06], 0, 0.9, [-0.05, 0.4], 0.05);
const LOWER_LEG: Bone =
    Bone { has_foot: true, ..bone(0.475, [-0.155, 0.125, 0.045], 3, 0.625, [-0.5, -0.02], 0.025) };
const UPPER_ARM: Bone = bone(1.225, [-0.125, 0.125, 0.035], 1, 1.35, [-0.1, 0.8], 0.025);
const LOWER_ARM: Bone = Bone {
    damping: 0.1,
    reference: 0.25 * PI,
    ..bone(0.975, [-0.125, 0.125, 0.03], 7, 1.1, [-0.2, 0.3], 0.005)
};

/// Number of bones of a ragdoll.
const BONES: usize = 11;
const SKELETON: [Bone; BONES] = [
    bone(0.95, [-0.02, 0.02, 0.095], 0, 0.0, [0.0; 2], 0.0),
    bone(1.2, [-0.135, 0.135, 0.09], 0, 1.0, [-0.25, 0.0], 0.025),
    Bone { damping: 0.1, ..bone(1.475, [-0.038, 0.039, 0.075], 1, 1.4, [-0.3, 0.1], 0.0125) },
    UPPER_LEG,
    LOWER_LEG,
    UPPER_LEG,
    Bone { parent: 5, ..LOWER_LEG },
    UPPER_ARM,
    LOWER_ARM,
    UPPER_ARM,
    Bone { parent: 9, ..LOWER_ARM },
];

/// Appends the actions that add a ragdoll at (x, y) in m. Its bones become the bodies from index `first` on; each is
/// followed by the joint to its parent. Bodies of one `group` do not collide.
fn add_ragdoll(actions: &mut Vec<Action>, at: [f32; 2], first: usize, group: u32) {
    for (body, joint) in ragdoll(at, first, group) {
        actions.push(Action::AddBody(body));
        actions.extend(joint.map(Action::AddJoint));
    }
}

/// Returns the bones of a ragdoll at (x, y) in m, 1.7 m high, each with the joint to its parent. Its bones are the bodies from
/// index `first` on. Bodies of one `group` do not collide.
pub(in crate::arena) fn ragdoll(
    [x, y]: [f32; 2],
    first: usize,
    group: u32,
) -> impl Iterator<Item = (Body, Option<Joint>)> {
    SKELETON.iter().enumerate().map(move |(index, bone)| {
        let [low, high, radius] = bone.capsule;
        let skin = Form::Capsule { ends: [[0.0, low], [0.0, high]], radius };
        let mut shapes = vec![Shape::new(skin).with_friction(0.2).with_filter(BONE, 1 | BONE, group)];
        if bone.has_foot {
            let sole = [[-0.03, -0.185], [0.11, -0.185], [0.11, -0.16], [-0.03, -0.14]];
            let foot = Shape::new(Form::hull(&sole, 0.015));
            shapes.push(foot.with_friction(0.05).with_filter(FOOT, 1, group));
        }
        let body = Body::dynamic([x, y + bone.y], shapes);
        let body = Body { damping: bone.damping, sleep_speed: Some(0.1), ..body };
        let joint = Joint {
            reference: bone.reference,
            limits: Some(bone.limits.map(|limit| limit * PI)),
            motor: Some([0.0, bone.friction]),
            spring: Some([5.0, 0.5]),
            ..Joint::new([first + bone.parent, first + index], [x, y + bone.pivot])
        };
        (body, (index > 0).then_some(joint))
    })
}
