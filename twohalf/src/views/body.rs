//! Bodies as a game sees them.

use farseer_core::{Body, BodyId};

use super::access::Access;
use super::contacts::{TwoHalfContact, contacts_of};
use super::touching::support_of;
use crate::depth::{DepthBody, Ground, Partner, Support, lowest};
use crate::projection::plane_to_world;
use crate::{Vector2, Vector3};

/// A body of a simulator: to look at, from [`TwoHalfPhysicsSimulator::body`](crate::TwoHalfPhysicsSimulator::body),
/// or to change as well, from [`TwoHalfPhysicsSimulator::body_mut`](crate::TwoHalfPhysicsSimulator::body_mut); in
/// callbacks from the [`Context`](crate::Context).
///
/// Velocities, forces and impulses along X and Y are in screen orientation: x right, y **down**. Along Z,
/// positive is into the picture. Rotation is about the depth axis, in rad, clockwise on the screen.
///
/// What is not here is in [`core`](Self::core) and [`core_mut`](Self::core_mut).
///
/// Setters that a game calls every frame return nothing. Given a value that is not finite they change nothing;
/// the simulator reports the refusal as [`Event::RejectedInput`](crate::Event::RejectedInput) in its next update.
#[derive(Debug)]
pub struct TwoHalfBody<S> {
    pub(super) simulator: S,
    pub(super) id: BodyId,
}

impl<S: Access> TwoHalfBody<S> {
    pub(crate) fn new(simulator: S, id: BodyId) -> Option<Self> {
        simulator.core().body(id)?;
        simulator.world().depths.bodies.get(id)?;
        Some(TwoHalfBody { simulator, id })
    }

    /// The body in the 2D engine. Its position is that of the body's origin in the plane: x = X, y = -Y.
    pub fn core(&self) -> &Body {
        // That it exists was checked when the view was made, and nothing can be disposed while the view lives.
        &self.simulator.core()[self.id]
    }

    pub(super) fn state(&self) -> &DepthBody {
        &self.simulator.world().depths.bodies[self.id]
    }

    pub(super) fn lowest(&self) -> f64 {
        lowest(self.simulator.core(), &self.simulator.world().depths, self.id)
    }

    /// The id.
    pub fn id(&self) -> BodyId {
        self.id
    }

    /// Position in the world: X and Z of the body's origin, and as Y the height of the object geom's lowest point
    /// over the ground; without an object geom, of the origin.
    ///
    /// While a body that is not round rotates, the lowest point changes, and with it Y.
    #[doc(alias = "Position3D")]
    pub fn position3d(&self) -> Vector3 {
        let lowest = self.lowest();
        plane_to_world(self.core().position(), lowest, self.state().z)
    }

    /// Position of the body's origin on the screen, px.
    #[doc(alias = "Position")]
    pub fn position(&self) -> Vector2 {
        self.simulator.world().projection.plane_to_screen(self.core().position(), self.state().z)
    }

    /// Rotation in rad, normally from 0 to 2 pi.
    #[doc(alias = "Rotation")]
    pub fn rotation(&self) -> f32 {
        self.core().rotation()
    }

    /// Velocity along X and down, px/s.
    #[doc(alias = "LinearVelocity")]
    pub fn linear_velocity(&self) -> Vector2 {
        self.core().linear_velocity()
    }

    /// Velocity along Z, px/s.
    #[doc(alias = "LinearVelocityZ")]
    pub fn linear_velocity_z(&self) -> f32 {
        self.state().velocity_z
    }

    /// Angular velocity about the depth axis, rad/s.
    #[doc(alias = "AngularVelocity")]
    pub fn angular_velocity(&self) -> f32 {
        self.core().angular_velocity()
    }

    /// Angular velocity about the x axis, rad/s, with which a ball rolls in depth; it is not drawn. A ball of
    /// radius r that rolls on the ground without slipping has -v/r at a velocity v along Z.
    pub fn angular_velocity_x(&self) -> f32 {
        self.state().angular_velocity_x
    }

    /// Position of the body's origin in the world: X, Y up, Z. Unlike the Y of [`position3d`](Self::position3d),
    /// its rate is the body's velocity also while it rotates.
    pub fn origin3d(&self) -> Vector3 {
        plane_to_world(self.core().position(), 0.0, self.state().z)
    }

    /// Velocity of the body's origin in the world, px/s: along X, **up** and along Z.
    pub fn velocity3d(&self) -> Vector3 {
        let velocity = self.core().linear_velocity();
        Vector3::new(velocity.x, -velocity.y, self.state().velocity_z)
    }

    /// Angular velocity in rad/s about the axes x, y **down** and z into the picture, a right-handed frame. The third
    /// is [`angular_velocity`](Self::angular_velocity); the others are those of balls and are not drawn.
    pub fn angular_velocity3d(&self) -> Vector3 {
        let state = self.state();
        Vector3::new(state.angular_velocity_x, state.angular_velocity_y, self.core().angular_velocity())
    }

    /// Layer depth for a draw call: 0 in front, 1 at the back, by the body's Z in the simulator's
    /// [layer depth range](crate::TwoHalfPhysicsSimulator::set_layer_depth_range).
    #[doc(alias = "LayerDepth")]
    pub fn layer_depth(&self) -> f32 {
        self.simulator.world().layer_depth(self.state().z)
    }

    /// What held the body up best in the last update: of everything below it that pushes it, what pushes it most
    /// straight up. `None` in the air. A body that leaves what it lies on for a single step, no faster than gravity
    /// makes it in two, still counts as held up.
    pub fn support(&self) -> Option<Support> {
        support_of(self.simulator.core(), self.simulator.world(), self.id)
    }

    /// Whether the body stood on something in the last update: the ground, a platform or another object that is no
    /// steeper than 60 degrees.
    pub fn is_grounded(&self) -> bool {
        self.support().is_some_and(|support| support.carries())
    }

    /// Everything below the body that pushed it in the last update; sensors and what has no response do not.
    pub fn supports(&self) -> Vec<Support> {
        let (core, world) = (self.simulator.core(), self.simulator.world());
        let is_mine = |geom| core.geom(geom).is_some_and(|geom| geom.body() == self.id);
        let responds = |geom| core.geom(geom).is_some_and(|geom| geom.collision_response_enabled());
        let pushes = |contact: &TwoHalfContact| {
            responds(contact.this)
                && match contact.partner {
                    Partner::Geom(geom) => responds(geom),
                    Partner::Platform(id) => {
                        world.platforms.get(id).is_some_and(|it| it.collision_response_enabled())
                    }
                    Partner::Ground => true,
                }
        };
        let mut supports = Vec::new();
        for contact in contacts_of(core, world, self.id).filter(pushes) {
            let below = match contact.partner {
                _ if is_mine(contact.this) => {
                    Some(Support { partner: contact.partner, normal: contact.normal })
                }
                Partner::Geom(other) if is_mine(other) => {
                    Some(Support { partner: Partner::Geom(contact.this), normal: -contact.normal })
                }
                _ => None,
            };
            supports.extend(below.filter(|support| support.normal.y > 0.0 && !supports.contains(support)));
        }
        supports
    }

    /// Force along X and down accumulated for the next update.
    #[doc(alias = "Force")]
    pub fn force(&self) -> Vector2 {
        self.core().force()
    }

    /// Torque accumulated for the next update.
    #[doc(alias = "Torque")]
    pub fn torque(&self) -> f32 {
        self.core().torque()
    }

    /// 1 / mass; 0 for an immovable body.
    #[doc(alias = "InverseMass")]
    pub fn inverse_mass(&self) -> f32 {
        self.core().inverse_mass()
    }

    /// Whether gravity leaves the body alone. Default false.
    #[doc(alias = "IgnoreGravity")]
    pub fn ignore_gravity(&self) -> bool {
        self.core().ignore_gravity()
    }

    /// How strongly gravity acts on the body: times what it does to others. Default 1.
    pub fn gravity_scale(&self) -> f32 {
        self.core().gravity_scale()
    }

    /// Drag per velocity, in all three axes. Default 0.001.
    #[doc(alias = "LinearDragCoefficient")]
    pub fn linear_drag_coefficient(&self) -> f32 {
        self.core().linear_drag_coefficient()
    }

    /// Drag per square of the angular velocity. Default 0.001.
    #[doc(alias = "RotationalDragCoefficient")]
    pub fn rotational_drag_coefficient(&self) -> f32 {
        self.core().rotational_drag_coefficient()
    }

    /// A number for the game's own purposes. Default 0.
    #[doc(alias = "Tag")]
    pub fn tag(&self) -> u64 {
        self.core().tag()
    }

    /// Whether the body was disposed and goes with the next update.
    #[doc(alias = "IsDisposed")]
    pub fn is_disposed(&self) -> bool {
        self.simulator.core().is_disposed(self.id)
    }

    /// Force along Z accumulated for the next update.
    #[doc(alias = "ForceZ")]
    pub fn force_z(&self) -> f32 {
        self.state().force_z
    }

    /// Mass.
    #[doc(alias = "Mass")]
    pub fn mass(&self) -> f32 {
        self.core().mass()
    }

    /// Whether the body is immovable.
    #[doc(alias = "IsStatic")]
    pub fn is_static(&self) -> bool {
        self.core().is_static()
    }

    /// Whether the body is moved by the game alone: see [`set_is_kinematic`](Self::set_is_kinematic).
    pub fn is_kinematic(&self) -> bool {
        self.core().is_kinematic()
    }

    /// Whether the body takes part in the simulation.
    #[doc(alias = "Enabled")]
    pub fn enabled(&self) -> bool {
        self.core().enabled()
    }

    /// How the body meets the plane Y = 0.
    #[doc(alias = "Ground")]
    pub fn ground(&self) -> &Ground {
        &self.state().ground
    }
}
