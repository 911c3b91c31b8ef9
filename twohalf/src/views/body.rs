//! Views of bodies for reading.

use farseer_core::{Body, BodyId};

use super::access::Access;
use super::contact_query::support_of;
use super::contacts::{TwoHalfContact, contacts_of};
use crate::depth::{ContactTarget, DepthBody, Ground, Support, lowest};
use crate::projection::plane_to_world;
use crate::{Vector2, Vector3};

/// A body of a simulator: for reading from
/// [`TwoHalfPhysicsSimulator::body`](crate::TwoHalfPhysicsSimulator::body), for editing from
/// [`TwoHalfPhysicsSimulator::body_mut`](crate::TwoHalfPhysicsSimulator::body_mut), and in callbacks from the
/// [`Context`](crate::Context).
///
/// Velocities, forces and impulses along X and Y are in screen orientation: x right, y **down**. Along Z,
/// positive is into the picture. Rotation is about the depth axis, in radians, clockwise on the screen.
///
/// Other properties are in [`core`](Self::core) and [`core_mut`](Self::core_mut).
///
/// Setters that a game calls every frame return nothing. A value that is not finite changes nothing; the
/// simulator reports the refusal as [`Event::RejectedInput`](crate::Event::RejectedInput) in its next update.
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

    /// The body in the core. Its position is that of the body's origin in the plane: x = X, y = -Y.
    pub fn core(&self) -> &Body {
        // The constructor has checked the id, and no body is disposed while the view lives.
        &self.simulator.core()[self.id]
    }

    pub(super) fn state(&self) -> &DepthBody {
        &self.simulator.world().depths.bodies[self.id]
    }

    pub(super) fn lowest(&self) -> f64 {
        lowest(self.simulator.core(), &self.simulator.world().depths, self.id)
    }

    /// Id of the body.
    pub fn id(&self) -> BodyId {
        self.id
    }

    /// Position in the world, px: X and Z of the body's origin, and as Y the height of the object geom's
    /// lowest point over the ground; without an object geom, of the origin.
    ///
    /// While a body that is not round rotates, its lowest point changes, and Y with it.
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

    /// Rotation in radians, normally from 0 to 2 pi.
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

    /// Angular velocity about the depth axis, radians/s.
    #[doc(alias = "AngularVelocity")]
    pub fn angular_velocity(&self) -> f32 {
        self.core().angular_velocity()
    }

    /// Angular velocity about the x axis, radians/s, of a ball that rolls in depth; it is not drawn. A ball
    /// of radius r that rolls on the ground without slipping has -v/r at a velocity v along Z.
    pub fn angular_velocity_x(&self) -> f32 {
        self.state().angular_velocity_x
    }

    /// Position of the body's origin in the world, px: X, Y up, Z. Unlike the Y of
    /// [`position3d`](Self::position3d), its rate of change is the velocity also during a rotation.
    pub fn origin3d(&self) -> Vector3 {
        plane_to_world(self.core().position(), 0.0, self.state().z)
    }

    /// Velocity of the body's origin in the world, px/s: along X, **up** and along Z.
    pub fn velocity3d(&self) -> Vector3 {
        let velocity = self.core().linear_velocity();
        Vector3::new(velocity.x, -velocity.y, self.state().velocity_z)
    }

    /// Angular velocity in radians/s about the axes x, y **down** and z into the picture, a right-handed
    /// frame. The third is [`angular_velocity`](Self::angular_velocity); the others are those of balls and
    /// are not drawn.
    pub fn angular_velocity3d(&self) -> Vector3 {
        let state = self.state();
        Vector3::new(state.angular_velocity_x, state.angular_velocity_y, self.core().angular_velocity())
    }

    /// Layer depth for a draw call, dimensionless: 0 in front, 1 at the back, by the body's Z in the
    /// simulator's [layer depth range](crate::TwoHalfPhysicsSimulator::set_layer_depth_range).
    #[doc(alias = "LayerDepth")]
    pub fn layer_depth(&self) -> f32 {
        self.simulator.world().layer_depth(self.state().z)
    }

    /// Best support in the last update: the contact below the body with the most upward normal. `None` in the
    /// air. A resting body that separates for a single step, no faster than gravity accelerates in two, still
    /// counts as supported.
    pub fn support(&self) -> Option<Support> {
        support_of(self.simulator.core(), self.simulator.world(), self.id)
    }

    /// Returns whether the body stood in the last update: on the ground, a platform or another object no steeper than 60
    /// degrees.
    pub fn is_grounded(&self) -> bool {
        self.support().is_some_and(|support| support.carries())
    }

    /// All supports in the last update: contacts below the body. Sensors and geoms without response are none.
    pub fn supports(&self) -> Vec<Support> {
        let (core, world) = (self.simulator.core(), self.simulator.world());
        let is_mine = |geom| core.geom(geom).is_some_and(|geom| geom.body() == self.id);
        let responds = |geom| core.geom(geom).is_some_and(|geom| geom.collision_response_enabled());
        let pushes = |contact: &TwoHalfContact| {
            responds(contact.this)
                && match contact.partner {
                    ContactTarget::Geom(geom) => responds(geom),
                    ContactTarget::Platform(id) => {
                        world.platforms.get(id).is_some_and(|it| it.collision_response_enabled())
                    }
                    ContactTarget::Ground => true,
                }
        };
        let mut supports = Vec::new();
        for contact in contacts_of(core, world, self.id).filter(pushes) {
            let below = match contact.partner {
                _ if is_mine(contact.this) => {
                    Some(Support { partner: contact.partner, normal: contact.normal })
                }
                ContactTarget::Geom(other) if is_mine(other) => {
                    Some(Support { partner: ContactTarget::Geom(contact.this), normal: -contact.normal })
                }
                _ => None,
            };
            supports.extend(below.filter(|support| support.normal.y > 0.0 && !supports.contains(support)));
        }
        supports
    }

    /// Force along X and down, accumulated for the next update, mass · px/s².
    #[doc(alias = "Force")]
    pub fn force(&self) -> Vector2 {
        self.core().force()
    }

    /// Torque accumulated for the next update, mass · px²/s².
    #[doc(alias = "Torque")]
    pub fn torque(&self) -> f32 {
        self.core().torque()
    }

    /// Inverse mass, 1/mass; 0 for a static body.
    #[doc(alias = "InverseMass")]
    pub fn inverse_mass(&self) -> f32 {
        self.core().inverse_mass()
    }

    /// Returns whether the body ignores gravity. Default false.
    #[doc(alias = "IgnoreGravity")]
    pub fn ignore_gravity(&self) -> bool {
        self.core().ignore_gravity()
    }

    /// Factor of gravity for the body, dimensionless. Default 1.
    pub fn gravity_scale(&self) -> f32 {
        self.core().gravity_scale()
    }

    /// Linear drag coefficient in all three axes, mass per s. Default 0.001.
    #[doc(alias = "LinearDragCoefficient")]
    pub fn linear_drag_coefficient(&self) -> f32 {
        self.core().linear_drag_coefficient()
    }

    /// Rotational drag coefficient: torque per square of the angular velocity, mass · px². Default 0.001.
    #[doc(alias = "RotationalDragCoefficient")]
    pub fn rotational_drag_coefficient(&self) -> f32 {
        self.core().rotational_drag_coefficient()
    }

    /// A number for the game's own purposes. Default 0.
    #[doc(alias = "Tag")]
    pub fn tag(&self) -> u64 {
        self.core().tag()
    }

    /// Returns whether the body was disposed and goes with the next update.
    #[doc(alias = "IsDisposed")]
    pub fn is_disposed(&self) -> bool {
        self.simulator.core().is_disposed(self.id)
    }

    /// Force along Z, accumulated for the next update, mass · px/s².
    #[doc(alias = "ForceZ")]
    pub fn force_z(&self) -> f32 {
        self.state().force_z
    }

    /// Mass, in mass units.
    #[doc(alias = "Mass")]
    pub fn mass(&self) -> f32 {
        self.core().mass()
    }

    /// Returns whether the body is static.
    #[doc(alias = "IsStatic")]
    pub fn is_static(&self) -> bool {
        self.core().is_static()
    }

    /// Returns whether the body is kinematic: see [`set_is_kinematic`](Self::set_is_kinematic).
    pub fn is_kinematic(&self) -> bool {
        self.core().is_kinematic()
    }

    /// Returns whether the body takes part in the simulation.
    #[doc(alias = "Enabled")]
    pub fn enabled(&self) -> bool {
        self.core().enabled()
    }

    /// Ground of the body: its view of the plane Y = 0.
    #[doc(alias = "Ground")]
    pub fn ground(&self) -> &Ground {
        &self.state().ground
    }
}
