//! Spiders that walk by bending their legs (behaviour chapter 16, sections B.3 and C.1, demo 7).

use farseer_core::math::Vector2;
use farseer_core::{
    AngleJoint, BodyFactory, BodyId, GeomFactory, GeomPlacement, JointFactory, JointId, PhysicsSimulator,
    Result,
};

use super::{Actor, Agent, BLACK, SampleScene, WHITE, border};

/// Milliseconds of a step.
const STEP: u32 = 10;
/// Milliseconds until the legs bend or stretch.
const PERIOD: u32 = 4000;
/// Half the length of the leg parts, and their distance from the middle of the body, in px.
const SHOULDER: f32 = 20.0;
const UPPER: f32 = 40.0;
const KNEE: f32 = 60.0;
const LOWER: f32 = 75.0;

/// A body with two legs of two limbs. It acts by setting the angles of its joints.
#[derive(Debug, Clone, Copy)]
pub struct Spider {
    /// The body between the legs.
    pub torso: BodyId,
    left_shoulder: JointId,
    right_shoulder: JointId,
    left_knee: JointId,
    right_knee: JointId,
    timer: u32,
    is_flexed: bool,
}

impl Spider {
    /// Adds a spider; let it [act](SampleScene::act).
    ///
    /// # Errors
    /// A position that is not finite.
    pub fn add(scene: &mut SampleScene, position: Vector2, collision_group: i32) -> Result<Self> {
        let at = |x: f32| position + Vector2::new(x, 0.0);
        let simulator = &mut scene.simulator;
        let torso = BodyFactory::create_circle_body_in(simulator, 20.0, 1.0)?;
        simulator[torso].set_position(position);
        let mut leg = |width, x| {
            let body = BodyFactory::create_rectangle_body_in(simulator, width, 12.0, 1.0)?;
            simulator[body].set_position(at(x));
            Ok(body)
        };
        let left_upper = leg(40.0, -UPPER)?;
        let left_lower = leg(30.0, -LOWER)?;
        let right_upper = leg(40.0, UPPER)?;
        let right_lower = leg(30.0, LOWER)?;

        let placement = GeomPlacement::default();
        let mut geoms = vec![GeomFactory::create_circle_geom_in(simulator, torso, 20.0, 14, placement)?];
        for (body, width) in
            [(left_upper, 40.0), (left_lower, 30.0), (right_upper, 40.0), (right_lower, 30.0)]
        {
            geoms.push(GeomFactory::create_rectangle_geom_in(simulator, body, width, 12.0, placement)?);
        }
        for &geom in &geoms {
            simulator[geom].set_collision_group(collision_group);
        }

        let mut bend = |body1, body2, x, angle, max_impulse| {
            JointFactory::create_revolute_joint_in(simulator, body1, body2, at(x))?;
            let joint = JointFactory::create_angle_joint_in(simulator, body1, body2)?;
            let kind = simulator.joint_as_mut::<AngleJoint>(joint)?;
            kind.set_target_angle(angle)?;
            kind.set_max_impulse(max_impulse)?;
            Ok(joint)
        };
        let left_shoulder = bend(torso, left_upper, -SHOULDER, -0.4, 300.0)?;
        // The original sets the left one twice, and this one never.
        let right_shoulder = bend(torso, right_upper, SHOULDER, 0.4, f32::MAX)?;
        let left_knee = bend(left_upper, left_lower, -KNEE, -0.4, 300.0)?;
        let right_knee = bend(right_upper, right_lower, KNEE, 0.4, 300.0)?;
        geoms.into_iter().for_each(|geom| scene.show(geom, WHITE, BLACK));
        let (timer, is_flexed) = (0, false);
        Ok(Spider { torso, left_shoulder, right_shoulder, left_knee, right_knee, timer, is_flexed })
    }
}

impl Actor for Spider {
    fn before_step(&mut self, simulator: &mut PhysicsSimulator) -> Result<()> {
        self.timer += STEP;
        if self.timer > PERIOD {
            self.timer = 0;
            self.is_flexed = !self.is_flexed;
        }
        let (knee, shoulder) = if self.is_flexed { (1.4, 1.2) } else { (0.4, 0.2) };
        for (joint, angle) in [
            (self.left_knee, -knee),
            (self.right_knee, knee),
            (self.left_shoulder, -shoulder),
            (self.right_shoulder, shoulder),
        ] {
            simulator.joint_as_mut::<AngleJoint>(joint)?.set_target_angle(angle)?;
        }
        Ok(())
    }
}

/// Simple 7: sixteen spiders fall on the floor and walk, past an agent.
pub(super) fn dynamic_angle_joints() -> Result<SampleScene> {
    let mut scene = SampleScene::new(150.0)?;
    scene.simulator.set_max_contacts_to_detect(5);
    scene.simulator.set_max_contacts_to_resolve(2)?;
    scene.simulator.set_iterations(10);
    scene.simulator.set_bias_factor(0.4)?;
    Agent::of_fifth_category()?.add(&mut scene, Vector2::new(312.0, 384.0))?;
    for index in 0..16 {
        let position = Vector2::new(512.0, (index + 1) as f32 * 30.0 + 100.0);
        let spider = Spider::add(&mut scene, position, 1001 + index)?;
        scene.act(spider);
    }
    border(&mut scene)?;
    Ok(scene)
}
