//! Scenes of the 2.5D engine in which objects are added and removed, with all features of the precise set.

use std::collections::VecDeque;

use farseer_core::math::Vector2;
use farseer_core::{BodyId, Footprint, ObjectId};
use twohalf::{Fluid, Platform, PlatformId, Region, TwoHalfPhysicsSimulator, Vector3, Well};
use twohalf_factories::{Ball, Capsule, Cylinder, Prism, Rope, RopeEnd, spawn, spawn_rope};

use super::{Churn, Result};
use crate::random::Random;
use crate::tied::links::{JOINTS, SPRINGS};

const THINGS: usize = 16;
/// Size of a platform along X, Y and Z, px.
const SIZE: [f32; 3] = [60.0, 12.0, 50.0];

/// A scene of balls, crates, vertical shapes and ropes, which joints and springs of all kinds connect. They fall into water and
/// on platforms that move, rotate or slope.
#[derive(Debug)]
pub struct DepthChurn {
    simulator: TwoHalfPhysicsSimulator,
    random: Random,
    /// Bodies of each object in the scene, oldest object first.
    living: VecDeque<Vec<BodyId>>,
    platforms: VecDeque<PlatformId>,
    /// Number of objects that were made so far. `laid` is the number of platforms.
    made: usize,
    laid: usize,
}

impl DepthChurn {
    /// Returns the scene of a seed.
    ///
    /// # Errors
    /// Never: the simulator accepts all arguments that are used here.
    pub fn new(seed: u64) -> Result<Self> {
        let gravity = Vector2::new(0.0, 300.0);
        let mut churn = DepthChurn {
            simulator: TwoHalfPhysicsSimulator::with_angle_and_gravity(600, 60, gravity)?,
            random: Random::new(300 + seed),
            living: VecDeque::new(),
            platforms: VecDeque::new(),
            made: 0,
            laid: 0,
        };
        churn.add_fields()?;
        for _ in 0..5 {
            churn.add_platform()?;
        }
        for _ in 0..THINGS {
            churn.add_thing()?;
        }
        Ok(churn)
    }

    fn add_fields(&mut self) -> Result<()> {
        let pool = Region::new([-150.0, 0.0, 60.0], [0.0, 25.0, 120.0])?;
        let flow = Vector3::new(10.0, 0.0, -20.0);
        self.simulator.add_field(Fluid { flow, ..Fluid::water(pool, 1e-3) })?;
        self.simulator.add_field(Fluid::wind(Region::EVERYWHERE, Vector3::new(20.0, 0.0, 10.0), 1e-5))?;
        self.simulator.add_field(Well { strength: 1e4, ..Well::new([0.0, 60.0, 60.0]) })?;
        Ok(())
    }

    /// Adds a platform. Its kind goes round: a lift, a belt, a rotating table, a slope to the back, a slope to the side.
    fn add_platform(&mut self) -> Result<()> {
        let place = self.place(0.0, 40.0);
        let [width, height, depth] = SIZE;
        let id = Platform::new(&mut self.simulator, width, height, depth, place.into(), None)?;
        let speed = self.random.between(-40.0, 40.0);
        let mut platform = self.simulator.platform_mut(id).ok_or("it was just made")?;
        match self.laid % 5 {
            0 => platform.set_velocity(Vector3::new(0.0, speed, speed))?,
            1 => platform.set_surface_speed(speed, -speed)?,
            2 => platform.set_angular_velocity(0.05 * speed)?,
            3 => platform.set_pitch(0.01 * speed)?,
            _ => platform.set_rotation(0.01 * speed)?,
        }
        self.platforms.push_back(id);
        self.laid += 1;
        Ok(())
    }

    /// Returns random X, Y and Z of a new object, px. Y lies between `low` and `high`.
    fn place(&mut self, low: f32, high: f32) -> [f32; 3] {
        let random = &mut self.random;
        [random.between(-150.0, 150.0), random.between(low, high), random.between(0.0, 120.0)]
    }

    /// Adds an object and returns its body. Its kind goes round: a ball, a crate, a cylinder, a capsule, a wedge on end, a ball
    /// on a rope.
    fn add_thing(&mut self) -> Result<BodyId> {
        let (place, size) = (self.place(20.0, 80.0), self.random.between(5.0, 12.0));
        let kind = self.made % 6;
        let thing = match kind {
            0 | 5 => Ball::new(size),
            1 => Prism::new([2.0 * size, 1.5 * size, size]),
            2 => Cylinder::new(size, 2.0 * size),
            3 => Capsule::new(size, 3.0 * size),
            _ => Prism::footprint(Footprint::new(&wedge(size))?, 2.0 * size),
        };
        let mass = self.random.between(0.5, 5.0);
        let body = spawn(&mut self.simulator, thing.mass(mass).friction(0.4).at(place))?.body;
        let mut bodies = vec![body];
        if kind == 5 {
            let hook = RopeEnd::Fixed([place[0], place[1] + 50.0, place[2] - 20.0]);
            let rope = Rope::new(hook, RopeEnd::Body(body)).parts(4);
            bodies = spawn_rope(&mut self.simulator, rope)?.bodies;
        }
        self.living.push_back(bodies);
        self.made += 1;
        Ok(body)
    }

    /// Adds a joint or a spring between two bodies. It keeps the present distance of the bodies.
    fn add_link(&mut self, bodies: [BodyId; 2]) -> Result<()> {
        let (joint, spring) = (self.random.pick(JOINTS), self.random.pick(SPRINGS));
        let random = &mut self.random;
        let link: ObjectId = self.simulator.edit_objects(|objects| {
            let link = if random.toss() {
                joint(objects, bodies, random)?.into()
            } else {
                spring(objects, bodies, random)?.into()
            };
            objects.add(link).map(|()| link)
        })?;
        // The call may fail: an angle joint has no length, and the distance may be less than the lower limit of a slider.
        let _ = self.simulator.take_length(link);
        Ok(())
    }

    fn replace_a_platform(&mut self) -> Result<()> {
        let oldest = self.platforms.pop_front().ok_or("there is none")?;
        self.simulator.remove_platform(oldest)?;
        self.add_platform()
    }
}

/// Returns the three corners of a wedge, X and Z in px.
fn wedge(size: f32) -> [Vector2; 3] {
    [[-size, -size], [size, -size], [0.0, size]].map(Vector2::from)
}

impl Churn for DepthChurn {
    type Simulator = TwoHalfPhysicsSimulator;

    fn replace_one(&mut self, is_tied: bool) -> Result<()> {
        let oldest = self.living.pop_front().ok_or("nothing lives")?;
        oldest.into_iter().try_for_each(|body| self.simulator.dispose(body))?;
        let other = self.living[self.random.below(self.living.len())][0];
        let body = self.add_thing()?;
        if is_tied {
            self.add_link([body, other])?;
            self.replace_a_platform()?;
        }
        Ok(())
    }

    fn simulator(&self) -> &TwoHalfPhysicsSimulator {
        &self.simulator
    }

    fn simulator_mut(&mut self) -> &mut TwoHalfPhysicsSimulator {
        &mut self.simulator
    }
}
