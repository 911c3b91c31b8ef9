//! Ids with which a game calls its simulator: of living objects, of removed objects, and of another simulator.

use farseer_core::{
    BodyFactory, BodyId, ControllerId, GeomFactory, GeomId, GeomPlacement, InactivityController,
    JointFactory, JointId, ObjectId, Path, PhysicsSimulator, Result, SpringFactory, SpringId,
};

use crate::random::Random;

/// Number of objects in the other simulator whose ids are in the pools. Slots and creation numbers are above those of most
/// games.
const FOREIGN: usize = 40;

/// Ids by kind. No pool is empty.
#[derive(Debug, Clone)]
pub(crate) struct Pools {
    pub(crate) bodies: Vec<BodyId>,
    pub(crate) geoms: Vec<GeomId>,
    pub(crate) joints: Vec<JointId>,
    pub(crate) springs: Vec<SpringId>,
    pub(crate) controllers: Vec<ControllerId>,
}

impl Pools {
    /// Returns pools with ids of another simulator, with low and high slots.
    pub(crate) fn foreign() -> Result<Self> {
        let mut other = PhysicsSimulator::default();
        for _ in 0..FOREIGN {
            let body = BodyFactory::create_circle_body_in(&mut other, 3.0, 1.0)?;
            GeomFactory::create_circle_geom_in(&mut other, body, 3.0, 5, GeomPlacement::default())?;
        }
        let (bodies, geoms): (Vec<_>, Vec<_>) = (other.bodies().collect(), other.geoms().collect());
        let last = bodies[FOREIGN - 1];
        Ok(Pools {
            joints: vec![JointFactory::create_fixed_angle_joint_in(&mut other, last)?],
            springs: vec![SpringFactory::create_fixed_angle_spring_in(&mut other, last, 1.0, 1.0)?],
            controllers: vec![other.create_controller(InactivityController::new())?],
            bodies: vec![bodies[0], bodies[1], last],
            geoms: vec![geoms[0], geoms[1], geoms[FOREIGN - 1]],
        })
    }

    /// Adds the ids of all objects of a simulator to the pools.
    pub(super) fn take_all(&mut self, simulator: &PhysicsSimulator) {
        self.bodies.extend(simulator.bodies());
        self.geoms.extend(simulator.geoms());
        self.joints.extend(simulator.joint_list());
        self.springs.extend(simulator.spring_list());
        self.controllers.extend(simulator.controller_list());
    }

    /// Returns a random id of any kind.
    pub(crate) fn object(&self, random: &mut Random) -> ObjectId {
        match random.below(5) {
            0 => random.pick(&self.bodies).into(),
            1 => random.pick(&self.geoms).into(),
            2 => random.pick(&self.joints).into(),
            3 => random.pick(&self.springs).into(),
            _ => random.pick(&self.controllers).into(),
        }
    }

    /// Adds some ids of a path's objects to the pools.
    pub(crate) fn take_from(&mut self, path: &Path) {
        const SOME: usize = 6;
        self.bodies.extend(path.bodies().iter().take(SOME));
        self.geoms.extend(path.geoms().iter().take(SOME));
        self.joints.extend(path.joints().iter().take(SOME));
        self.springs.extend(path.springs().iter().take(SOME));
    }
}
