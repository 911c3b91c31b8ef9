//! Scenes of the 2D engine in which objects are added and removed.

use std::collections::VecDeque;

use farseer_core::math::Vector2;
use farseer_core::{BodyId, JointFactory, Methods, PhysicsSimulator, SpringFactory};

use super::{Churn, Result};
use crate::plane::{create_floor, create_thing};
use crate::random::Random;

/// A scene of boxes and circles above a floor. Pin joints and springs connect some of them.
#[derive(Debug)]
pub struct PlaneChurn {
    simulator: PhysicsSimulator,
    random: Random,
    living: VecDeque<BodyId>,
}

impl PlaneChurn {
    /// Returns a scene of twelve objects above a floor.
    ///
    /// # Errors
    /// Never: the simulator accepts all arguments that are used here.
    pub fn new(methods: Methods) -> Result<Self> {
        let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 100.0))?;
        simulator.set_methods(methods)?;
        create_floor(&mut simulator)?;
        let mut churn = PlaneChurn { simulator, random: Random::new(5), living: VecDeque::new() };
        for _ in 0..12 {
            churn.add_thing()?;
        }
        Ok(churn)
    }

    fn add_thing(&mut self) -> Result<BodyId> {
        let (body, _) = create_thing(&mut self.simulator, &mut self.random)?;
        self.living.push_back(body);
        Ok(body)
    }
}

impl Churn for PlaneChurn {
    type Simulator = PhysicsSimulator;

    fn replace_one(&mut self, is_tied: bool) -> Result<()> {
        let oldest = self.living.pop_front().ok_or("nothing lives")?;
        self.simulator.dispose(oldest)?;
        let other = self.living[self.random.below(self.living.len())];
        let body = self.add_thing()?;
        if is_tied {
            let here = Vector2::zeros();
            JointFactory::create_pin_joint_in(&mut self.simulator, body, here, other, here)?;
            SpringFactory::create_linear_spring_in(&mut self.simulator, body, here, other, here, 5.0, 1.0)?;
        }
        Ok(())
    }

    fn simulator(&self) -> &PhysicsSimulator {
        &self.simulator
    }

    fn simulator_mut(&mut self) -> &mut PhysicsSimulator {
        &mut self.simulator
    }
}
