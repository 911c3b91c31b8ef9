//! Errors of a joint scene: gaps of its joints, speed and energy.

use super::assembly::{Assembly, JointDef, JointKind};
use crate::world::{World, distance, turned};

/// Kinetic and total energy in kg px²/s². Potential energy is 0 at y = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Energy {
    /// Kinetic energy of all dynamic bodies in kg px²/s², >= 0.
    pub kinetic: f64,
    /// Sum of kinetic energy, potential energy of gravity and energy of the springs, in kg px²/s².
    pub total: f64,
}

/// Measures gaps, speed and energy of a scene in any engine.
#[derive(Debug)]
pub struct Gauge<'a> {
    assembly: &'a Assembly,
    /// Two anchors for each joint, in local coordinates of its first and second body, in px.
    anchors: Vec<[[f64; 2]; 2]>,
}

/// Returns the greater of two errors in the unit of both; infinity if one is NaN.
pub fn worst(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::INFINITY } else { a.max(b) }
}

impl<'a> Gauge<'a> {
    /// Creates a gauge for worlds that are built from `assembly`.
    pub fn new(assembly: &'a Assembly) -> Self {
        Gauge { assembly, anchors: assembly.joints.iter().map(|joint| anchors(assembly, joint)).collect() }
    }

    /// Returns the widest gap of all joints in px. The gap of a hinge or weld is the distance between its anchors. That of a
    /// slider is the distance of the second anchor from the axis, that of a rod the error of its length. Springs have no
    /// gap.
    pub fn gap(&self, world: &dyn World) -> f64 {
        let joints = self.assembly.joints.iter().zip(&self.anchors);
        joints.fold(0.0, |most, (joint, anchors)| worst(most, self.gap_of(world, joint, anchors)))
    }

    fn gap_of(&self, world: &dyn World, joint: &JointDef, anchors: &[[f64; 2]; 2]) -> f64 {
        let one = world.body(joint.body1);
        let ends = [one.to_world(anchors[0]), world.body(joint.body2).to_world(anchors[1])];
        match joint.kind {
            JointKind::Hinge { .. } | JointKind::Weld { .. } => distance(ends[0], ends[1]),
            JointKind::Slider { axis, .. } => {
                let start = f64::from(self.assembly.bodies[joint.body1].angle);
                let [along_x, along_y] = turned(axis.map(f64::from), one.angle - start);
                ((ends[1][0] - ends[0][0]) * along_y - (ends[1][1] - ends[0][1]) * along_x).abs()
            }
            JointKind::Rod { length } => (distance(ends[0], ends[1]) - f64::from(length)).abs(),
            JointKind::Spring { .. } => 0.0,
        }
    }

    /// Returns the greatest speed of any dynamic body in px/s: speed of the centre plus angular velocity times the distance
    /// to the farthest point.
    pub fn speed(&self, world: &dyn World) -> f64 {
        self.dynamic().fold(0.0, |most, index| {
            let body = world.body(index);
            let reach = f64::from(self.assembly.bodies[index].form.reach());
            worst(most, body.speed() + body.angular_velocity.abs() * reach)
        })
    }

    /// Returns the present energy of the scene.
    pub fn energy(&self, world: &dyn World) -> Energy {
        let (mut kinetic, mut potential) = (0.0, 0.0);
        for index in self.dynamic() {
            let (definition, body) = (&self.assembly.bodies[index], world.body(index));
            let (mass, inertia) = (f64::from(definition.mass), f64::from(definition.inertia));
            kinetic += 0.5 * (mass * body.speed().powi(2) + inertia * body.angular_velocity.powi(2));
            potential -= mass * f64::from(self.assembly.gravity) * body.position[1];
        }
        let springs = self.assembly.joints.iter().zip(&self.anchors);
        potential += springs.map(|(joint, anchors)| spring_energy(world, joint, anchors)).sum::<f64>();
        Energy { kinetic, total: kinetic + potential }
    }

    /// Returns the mass of all dynamic bodies in kg.
    pub fn mass(&self) -> f64 {
        self.dynamic().map(|index| f64::from(self.assembly.bodies[index].mass)).sum()
    }

    /// Returns whether all dynamic bodies sleep.
    pub fn is_asleep(&self, world: &dyn World) -> bool {
        self.dynamic().all(|index| world.is_asleep(index))
    }

    fn dynamic(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.assembly.bodies.len()).filter(|&index| !self.assembly.bodies[index].is_static)
    }
}

fn anchors(assembly: &Assembly, joint: &JointDef) -> [[f64; 2]; 2] {
    match joint.kind {
        JointKind::Hinge { anchor, .. } | JointKind::Weld { anchor } | JointKind::Slider { anchor, .. } => {
            let local = |index: usize| assembly.bodies[index].state().to_local(anchor.map(f64::from));
            [local(joint.body1), local(joint.body2)]
        }
        JointKind::Rod { .. } => [[0.0; 2]; 2],
        JointKind::Spring { arm, .. } => [arm.map(f64::from), [0.0; 2]],
    }
}

fn spring_energy(world: &dyn World, joint: &JointDef, anchors: &[[f64; 2]; 2]) -> f64 {
    let JointKind::Spring { length, stiffness, .. } = joint.kind else { return 0.0 };
    let ends = [joint.body1, joint.body2].map(|index| world.body(index));
    let extent = distance(ends[0].to_world(anchors[0]), ends[1].to_world(anchors[1])) - f64::from(length);
    0.5 * f64::from(stiffness) * extent * extent
}
