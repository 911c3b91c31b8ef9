//! Wind and explosions (behaviour chapter 16, sections B.3 and C.2, demo 6).

use farseer_core::math::{Vector2, vector2};
use farseer_core::shape::Aabb;
use farseer_core::{BodyId, PhysicsSimulator, Result};

use super::{Actor, Pyramid, SampleScene, border, pyramid};

/// Blows at bodies to its right.
#[derive(Debug, Clone, Copy)]
pub struct HairDryer {
    /// Middle of the left edge of its area of effect, 300 by 200, in px.
    pub position: Vector2,
}

impl Actor for HairDryer {
    fn before_step(&mut self, simulator: &mut PhysicsSimulator) -> Result<()> {
        let (x, y) = (self.position.x, self.position.y);
        let reach = Aabb::new(Vector2::new(x, y - 100.0), Vector2::new(x + 300.0, y + 100.0));
        for body in bodies_in(simulator, &reach) {
            simulator[body].apply_force(Vector2::new(400.0, 0.0));
        }
        Ok(())
    }
}

/// Goes off after three seconds, once.
#[derive(Debug, Clone, Copy)]
pub struct Grenade {
    position: Vector2,
    /// Milliseconds until it goes off; `None` afterwards.
    timer: Option<i32>,
}

impl Grenade {
    /// A grenade that was dropped at this point of the world.
    pub fn new(position: Vector2) -> Self {
        Grenade { position, timer: Some(3000) }
    }
}

impl Actor for Grenade {
    fn before_step(&mut self, simulator: &mut PhysicsSimulator) -> Result<()> {
        self.timer = self.timer.map(|timer| timer - 10);
        if self.timer.is_some_and(|timer| timer <= 0) {
            self.timer = None;
            let half = Vector2::new(100.0, 100.0);
            for body in bodies_in(simulator, &Aabb::new(self.position - half, self.position + half)) {
                let away = vector2::normalize(simulator[body].position() - self.position);
                simulator[body].apply_force(away * 50_000.0);
            }
        }
        Ok(())
    }
}

fn bodies_in(simulator: &PhysicsSimulator, reach: &Aabb) -> Vec<BodyId> {
    let is_in = |&body: &BodyId| reach.contains(simulator[body].position());
    simulator.body_list().iter().copied().filter(is_in).collect()
}

/// Advanced 6: a heap of 105 blocks in the wind.
pub(super) fn wind_and_explosions() -> Result<SampleScene> {
    let mut scene = SampleScene::new(100.0)?;
    scene.simulator.set_bias_factor(0.3)?;
    let heap = Pyramid {
        edge: 32.0,
        spacing: 32.0 / 5.0,
        mass: 1.0,
        friction: 0.4,
        rows: 14,
        origin: Vector2::new(218.0, 643.0),
    };
    pyramid(&mut scene, heap)?;
    scene.act(HairDryer { position: Vector2::new(100.0, 100.0) });
    border(&mut scene)?;
    Ok(scene)
}
