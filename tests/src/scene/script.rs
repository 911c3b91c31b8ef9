//! Timed operations.

use super::reader::{Keys, Object, keys, tagged, words};
use super::settings::at_least_one;
use super::{
    BodySettings, BodySpec, ControllerSpec, GeomSettings, GeomSpec, JointGeometry, JointSettings, JointSpec,
    NarrowPhase, Outline, SceneError, SolverSettings, SpringGeometry, SpringSettings, SpringSpec,
};
use farseer_core::math::Vector2;

/// An operation and the steps before which it is applied.
#[derive(Debug, Clone, PartialEq)]
pub struct ScriptEntry {
    /// First step, counted from 1.
    pub step: u32,
    /// Last step it may be applied at; the first alone when absent.
    pub until: Option<u32>,
    /// Distance of the steps, at least 1.
    pub every: u32,
    /// The operation.
    pub op: Op,
}

impl ScriptEntry {
    /// Whether it is applied before the update with this number.
    pub fn is_due(&self, step: u32) -> bool {
        match self.until {
            Some(until) => {
                step >= self.step && step <= until && (step - self.step).is_multiple_of(self.every)
            }
            None => step == self.step,
        }
    }
}

impl Keys for ScriptEntry {
    fn take(object: &mut Object<'_>) -> Result<Self, SceneError> {
        Ok(ScriptEntry {
            step: at_least_one(object, "step", None)?,
            until: object.key("until")?,
            every: at_least_one(object, "every", Some(1))?,
            op: Op::take(object)?,
        })
    }
}

/// The kinds of object that are created, added and so on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Target {
    /// A body, by index.
    Body,
    /// A geom, by id.
    Geom,
    /// A joint, by index.
    Joint,
    /// A spring, by index.
    Spring,
    /// A controller, by index.
    Controller,
}

words!(Target {
    "body" => Body,
    "geom" => Geom,
    "joint" => Joint,
    "spring" => Spring,
    "controller" => Controller,
});

/// An object to create.
#[derive(Debug, Clone, PartialEq)]
pub enum Creation {
    /// A body.
    Body {
        /// Description of the body.
        spec: Box<BodySpec>,
    },
    /// A geom.
    Geom {
        /// Description of the geom.
        spec: Box<GeomSpec>,
    },
    /// A joint.
    Joint {
        /// Description of the joint.
        spec: Box<JointSpec>,
    },
    /// A spring.
    Spring {
        /// Description of the spring.
        spec: Box<SpringSpec>,
    },
    /// A controller.
    Controller {
        /// Description of the controller.
        spec: Box<ControllerSpec>,
    },
}

tagged!(Creation, "target" {
    "body" => Body { spec },
    "geom" => Geom { spec },
    "joint" => Joint { spec },
    "spring" => Spring { spec },
    "controller" => Controller { spec },
});

/// Settings of the simulator a script may set.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SimulatorChange {
    /// Whether updates do anything.
    pub enabled: Option<bool>,
    /// Settings of the contact solver.
    pub solver: SolverSettings,
    /// How contacts are found.
    pub narrow_phase: Option<NarrowPhase>,
    /// Greatest number of contacts that are computed per pair.
    pub max_contacts_to_detect: Option<i32>,
}

keys!(SimulatorChange { enabled, solver [flat], narrow_phase, max_contacts_to_detect });

/// Settings of a scaling controller a script may set, and calls it may make.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ScalingChange {
    /// Longest time step.
    pub maximum_interval: Option<f32>,
    /// Current time step.
    pub update_interval: Option<f32>,
    /// How often the time step is increased.
    pub increase: u32,
    /// How often the time step is decreased.
    pub decrease: u32,
}

keys!(ScalingChange { maximum_interval, update_interval, increase [or 0], decrease [or 0] });

/// The operations. Bodies, joints, springs and controllers are given by index, geoms by id.
#[derive(Debug, Clone, PartialEq)]
#[expect(
    missing_docs,
    reason = "the fields are the keys of the scene format and the arguments of the operation"
)]
pub enum Op {
    /// A force on the centre of mass.
    ApplyForce { body: usize, force: Vector2 },
    /// A force on a point in the body's coordinates.
    ApplyForceAtLocalPoint { body: usize, force: Vector2, point: Vector2 },
    /// A force on a point of the world.
    ApplyForceAtWorldPoint { body: usize, force: Vector2, point: Vector2 },
    /// A torque.
    ApplyTorque { body: usize, torque: f32 },
    /// An impulse, applied by the engine in its next update.
    ApplyImpulse { body: usize, impulse: Vector2 },
    /// An angular impulse.
    ApplyAngularImpulse { body: usize, impulse: f32 },
    /// Forgets forces.
    ClearForce { body: usize },
    /// Forgets torques.
    ClearTorque { body: usize },
    /// Forgets impulses.
    ClearImpulse { body: usize },
    /// Moves a body.
    SetPosition { body: usize, position: Vector2 },
    /// Turns a body.
    SetRotation { body: usize, rotation: f32 },
    /// Sets a velocity.
    SetLinearVelocity { body: usize, linear_velocity: Vector2 },
    /// Sets an angular velocity.
    SetAngularVelocity { body: usize, angular_velocity: f32 },
    /// Makes a body static or not.
    SetStatic { body: usize, value: bool },
    /// Sets a mass.
    SetMass { body: usize, mass: f32 },
    /// Sets a moment of inertia.
    SetMomentOfInertia { body: usize, moment_of_inertia: f32 },
    /// Sets any of a body's settings.
    SetBody { body: usize, settings: Box<BodySettings> },
    /// Stops a body and clears its forces and impulses.
    ResetDynamics { body: usize },
    /// Adds to the simulation.
    Add { target: Target, index: usize },
    /// Takes out of the simulation.
    Remove { target: Target, index: usize },
    /// Disposes an object.
    Dispose { target: Target, index: usize },
    /// Sets the enabled flag.
    Enable { target: Target, index: usize },
    /// Clears the enabled flag.
    Disable { target: Target, index: usize },
    /// Sets the gravity.
    SetGravity { gravity: Vector2 },
    /// Sets any of the simulator's settings.
    SetSimulator { change: Box<SimulatorChange> },
    /// Time step from this update on.
    SetDt { dt: f32 },
    /// Second argument of the update from this update on.
    SetDtReal { dt_real: f32 },
    /// Sets any of a geom's settings.
    SetGeom { geom: usize, settings: Box<GeomSettings> },
    /// Moves a geom to another body.
    SetGeomBody { geom: usize, body: usize },
    /// Gives a geom another outline.
    SetVertices { geom: usize, outline: Box<Outline> },
    /// Creates a further object.
    Create { creation: Creation },
    /// Makes two geoms ignore each other.
    IgnoreCollision { geom: usize, other: usize },
    /// Takes that back.
    RestoreCollision { geom: usize, other: usize },
    /// Sets any of a joint's settings, then its geometry.
    SetJoint { joint: usize, settings: Box<JointSettings>, geometry: Box<JointGeometry> },
    /// Sets a spring's constants and points, then any of its settings.
    SetSpring { spring: usize, geometry: Box<SpringGeometry>, settings: Box<SpringSettings> },
    /// Disturbs the surface of a wave controller.
    DisturbWave { controller: usize, x: f32, offset: f32 },
    /// Puts a geom into the care of a fluid.
    FluidAddGeom { controller: usize, geom: usize },
    /// Takes a geom out of the care of a fluid.
    FluidRemoveGeom { controller: usize, geom: usize },
    /// Sets any of a scaling controller's settings.
    SetScaling { controller: usize, change: ScalingChange },
    /// Queries the geoms at a point.
    Query { point: Vector2 },
}

tagged!(Op, "op" {
    "apply_force" => ApplyForce { body, force },
    "apply_force_at_local_point" => ApplyForceAtLocalPoint { body, force, point },
    "apply_force_at_world_point" => ApplyForceAtWorldPoint { body, force, point },
    "apply_torque" => ApplyTorque { body, torque },
    "apply_impulse" => ApplyImpulse { body, impulse },
    "apply_angular_impulse" => ApplyAngularImpulse { body, impulse },
    "clear_force" => ClearForce { body },
    "clear_torque" => ClearTorque { body },
    "clear_impulse" => ClearImpulse { body },
    "set_position" => SetPosition { body, position },
    "set_rotation" => SetRotation { body, rotation },
    "set_linear_velocity" => SetLinearVelocity { body, linear_velocity },
    "set_angular_velocity" => SetAngularVelocity { body, angular_velocity },
    "set_static" => SetStatic { body, value },
    "set_mass" => SetMass { body, mass },
    "set_moment_of_inertia" => SetMomentOfInertia { body, moment_of_inertia },
    "set_body" => SetBody { body, settings [flat] },
    "reset_dynamics" => ResetDynamics { body },
    "add" => Add { target, index },
    "remove" => Remove { target, index },
    "dispose" => Dispose { target, index },
    "enable" => Enable { target, index },
    "disable" => Disable { target, index },
    "set_gravity" => SetGravity { gravity },
    "set_simulator" => SetSimulator { change [flat] },
    "set_dt" => SetDt { dt },
    "set_dt_real" => SetDtReal { dt_real },
    "set_geom" => SetGeom { geom, settings [flat] },
    "set_geom_body" => SetGeomBody { geom, body },
    "set_vertices" => SetVertices { geom, outline },
    "create" => Create { creation [flat] },
    "ignore_collision" => IgnoreCollision { geom, other },
    "restore_collision" => RestoreCollision { geom, other },
    "set_joint" => SetJoint { joint, settings [flat], geometry [flat] },
    "set_spring" => SetSpring { spring, geometry [flat], settings [flat] },
    "disturb_wave" => DisturbWave { controller, x, offset },
    "fluid_add_geom" => FluidAddGeom { controller, geom },
    "fluid_remove_geom" => FluidRemoveGeom { controller, geom },
    "set_scaling" => SetScaling { controller, change [flat] },
    "query" => Query { point },
});
