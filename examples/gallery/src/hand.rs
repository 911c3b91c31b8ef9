//! Grabbing of bodies with the mouse or a finger.

use farseer_core::{MousePicker, PhysicsSimulator};
use twohalf::{BodyId, Drawable, TwoHalfPhysicsSimulator, Vector2, Vector3};
use twohalf_render::Point;

use crate::play::WorldMut;

/// Stiffness and damping of the pull on the grabbed body, per mass: acceleration per px, and per px/s.
const PULL: [f32; 2] = [500.0, 40.0];

/// A hand that grabs one body at a time.
#[derive(Debug, Clone, Default)]
pub(crate) struct Hand {
    /// The picker of the 2D engine.
    picker: MousePicker,
    held: Option<Held>,
}

/// The grabbed body in the 2.5D engine.
#[derive(Debug, Clone, Copy)]
struct Held {
    body: BodyId,
    /// Vector from the body to the grabbed point, px of the screen.
    grip: Vector2,
    target: Vector2,
}

impl Hand {
    /// Grabs a movable body at a point, px of the simulator's screen; returns whether there is one.
    pub(crate) fn grab(&mut self, world: WorldMut<'_>, at: Point) -> bool {
        let at = Vector2::from(at);
        match world {
            WorldMut::Plane(simulator) => self.grab_in_plane(simulator, at).unwrap_or(false),
            WorldMut::Depth(simulator) => {
                let moves = |body: BodyId| simulator.body(body).is_some_and(|body| !body.is_static());
                let front = simulator.pick_front_where(at, |thing| match thing {
                    Drawable::Body(body) => moves(body),
                    Drawable::Platform(_) => false,
                });
                self.held = match front {
                    Some(Drawable::Body(body)) => {
                        simulator.body(body).map(|view| Held { body, grip: at - view.position(), target: at })
                    }
                    _ => None,
                };
                self.held.is_some()
            }
        }
    }

    fn grab_in_plane(&mut self, simulator: &mut PhysicsSimulator, at: Vector2) -> farseer_core::Result<bool> {
        self.picker.release(simulator);
        let body = simulator.collide(at).and_then(|geom| simulator.body_of(geom));
        let Some(mass) =
            body.map(|body| &simulator[body]).filter(|body| !body.is_static()).map(|body| body.mass())
        else {
            return Ok(false);
        };
        self.picker = MousePicker::new(PULL[0] * mass, PULL[1] * mass)?;
        Ok(self.picker.pick(simulator, at)?.is_some())
    }

    /// Moves the grabbed body towards a point.
    pub(crate) fn drag(&mut self, world: WorldMut<'_>, to: Point) {
        if !to.iter().all(|number| number.is_finite()) {
            return;
        }
        match world {
            // A point that is finite is not refused.
            WorldMut::Plane(simulator) => self.picker.drag(simulator, Vector2::from(to)).unwrap_or(()),
            WorldMut::Depth(_) => {
                if let Some(held) = &mut self.held {
                    held.target = Vector2::from(to);
                }
            }
        }
    }

    /// Releases the grabbed body: it flies on as fast as it was moved.
    pub(crate) fn release(&mut self, world: WorldMut<'_>) {
        if let WorldMut::Plane(simulator) = world {
            self.picker.release(simulator);
        }
        self.held = None;
    }

    /// Applies the pull to the grabbed body; before every step.
    pub(crate) fn pull(&mut self, world: WorldMut<'_>) {
        if let (WorldMut::Depth(simulator), Some(held)) = (world, self.held) {
            pull(simulator, held);
        }
    }

    /// Whether a body is grabbed.
    pub(crate) fn is_holding(&self) -> bool {
        self.held.is_some() || self.picker.spring().is_some()
    }
}

fn pull(simulator: &mut TwoHalfPhysicsSimulator, held: Held) {
    let gravity = simulator.gravity();
    let Some(mut body) = simulator.body_mut(held.body) else { return };
    let way = held.target - held.grip - body.position();
    let (velocity, mass) = (body.velocity3d(), body.mass());
    let [stiffness, damping] = PULL;
    // Y is up, and the screen's y is down. The grabbed body keeps its depth.
    let push = Vector3::new(stiffness * way.x, gravity.y - stiffness * way.y, 0.0) - velocity * damping;
    body.apply_force3d(push * mass);
}
