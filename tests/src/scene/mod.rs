//! The scene format: everything needed to build and drive a simulation, as JSON.
//!
//! Units are the user's length unit (pixels in most scenes), seconds, radians and kilograms; screen y points down. Bodies,
//! joints, springs and controllers are named by their order of creation, geoms by their id, which is their order of creation
//! too, both from 0. Numbers are decimals that become the nearest double and then the nearest float.
//!
//! A file with an unknown key, type or word is refused, with its name, the position and the reason. See [`crate::run`] for how
//! a scene becomes a simulation.

mod at;
mod body;
mod controller;
mod error;
mod features;
mod geom;
mod joint;
mod outline;
mod path;
mod reader;
mod script;
mod settings;
mod spring;

pub use at::At;
pub use body::{BodySettings, BodyShape, BodySpec};
pub use controller::{
    ControllerKind, ControllerSpec, Corners, FluidContainer, FluidDragSpec, GravityLaw, GravitySpec, WaveSpec,
};
pub use error::{Reason, SceneError};
pub use features::{Feature, Features};
pub use geom::{GeomSettings, GeomShape, GeomSpec};
pub use joint::{JointGeometry, JointKind, JointSettings, JointSpec};
pub use outline::{Outline, OutlineForm};
pub use path::{Link, PathGeoms, PathKind, PathSpec};
pub use script::{Creation, Op, ScalingChange, ScriptEntry, SimulatorChange, Target};
pub use settings::{
    BroadPhase, Friction, NarrowPhase, Outcome, SimulatorSettings, SolverSettings, TraceSettings,
};
pub use spring::{SpringGeometry, SpringKind, SpringSettings, SpringSpec};

use crate::file;
use reader::{Keys, Object, Read};
use std::path::Path;

/// A scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Name, as in the name of its file.
    pub name: String,
    /// One sentence.
    pub about: String,
    /// Words to sort scenes by.
    pub tags: Vec<String>,
    /// Settings of the simulator.
    pub simulator: SimulatorSettings,
    /// Time step of every update, in seconds.
    pub dt: f32,
    /// Number of updates.
    pub steps: u32,
    /// Content of a trace of the scene.
    pub trace: TraceSettings,
    /// Bodies, created first.
    pub bodies: Vec<BodySpec>,
    /// Chains and tracks.
    pub paths: Vec<PathSpec>,
    /// Geoms.
    pub geoms: Vec<GeomSpec>,
    /// Joints.
    pub joints: Vec<JointSpec>,
    /// Springs.
    pub springs: Vec<SpringSpec>,
    /// Controllers, created last.
    pub controllers: Vec<ControllerSpec>,
    /// Timed operations.
    pub script: Vec<ScriptEntry>,
    /// Second argument of every update, in seconds.
    pub dt_real: f32,
    /// Index of the scaling controller that decides the time step.
    pub scaled_by: Option<usize>,
    /// Faults of the original in the scene.
    pub outcome: Outcome,
    /// Where the scene came from, for errors.
    file: String,
}

impl Keys for Scene {
    fn take(object: &mut Object<'_>) -> Result<Self, SceneError> {
        let format: i32 = object.key("format")?;
        if format != 1 {
            return Err(object.error_at("format", format!("{format} is not 1, the only format known")));
        }
        Ok(Scene {
            name: object.key("name")?,
            about: object.key("about")?,
            tags: object.key("tags")?,
            simulator: object.key("simulator")?,
            dt: object.key("dt")?,
            steps: object.key("steps")?,
            trace: object.key("trace")?,
            bodies: object.key_or("bodies", Vec::new())?,
            paths: object.key_or("paths", Vec::new())?,
            geoms: object.key_or("geoms", Vec::new())?,
            joints: object.key_or("joints", Vec::new())?,
            springs: object.key_or("springs", Vec::new())?,
            controllers: object.key_or("controllers", Vec::new())?,
            script: object.key_or("script", Vec::new())?,
            dt_real: object.key_or("dt_real", 0.0)?,
            scaled_by: object.key("scaled_by")?,
            outcome: object.key_or("outcome", Outcome::default())?,
            file: String::new(),
        })
    }
}

impl Scene {
    /// A scene without anything in it, to be filled by a program: 300 steps of 0.01 s, traced without events
    /// and contacts.
    pub fn empty(name: &str, about: &str) -> Self {
        Scene {
            name: name.to_owned(),
            about: about.to_owned(),
            tags: Vec::new(),
            simulator: SimulatorSettings::default(),
            dt: 0.01,
            steps: 300,
            trace: TraceSettings {
                full_every: 50,
                events: false,
                events_until: None,
                contacts: false,
                step_every: 1,
            },
            bodies: Vec::new(),
            paths: Vec::new(),
            geoms: Vec::new(),
            joints: Vec::new(),
            springs: Vec::new(),
            controllers: Vec::new(),
            script: Vec::new(),
            dt_real: 0.0,
            scaled_by: None,
            outcome: Outcome::default(),
            file: name.to_owned(),
        }
    }

    /// Reads a scene from a file of JSON, plain or compressed by gzip (`.gz`).
    ///
    /// # Errors
    ///
    /// When the file cannot be read, is not JSON or is not a scene; the error names the file, the position in it and the
    /// reason.
    pub fn from_file(path: impl AsRef<Path>) -> Result<Self, SceneError> {
        let path = path.as_ref();
        let file = path.display().to_string();
        let text = file::read_text(path).map_err(|error| SceneError::new(At::Root, error).in_file(&file))?;
        Scene::from_json(&file, &text)
    }

    /// Reads a scene from a text of JSON; `name` replaces the file in errors.
    ///
    /// # Errors
    ///
    /// When the text is not JSON or not a scene.
    pub fn from_json(name: &str, text: &str) -> Result<Self, SceneError> {
        let scene: Result<Scene, SceneError> = serde_json::from_str(text)
            .map_err(|error| SceneError::new(At::Root, error))
            .and_then(|value| Read::read(&value, At::Root));
        match scene {
            Ok(scene) => Ok(Scene { file: name.to_owned(), ..scene }),
            Err(error) => Err(error.in_file(name)),
        }
    }

    /// Where the scene came from: the name errors give.
    pub fn file(&self) -> &str {
        &self.file
    }

    /// The features that the scene needs beyond bodies and geoms.
    pub fn features(&self) -> Features {
        let mut features = Features::default();
        let mut note = |used: bool, feature| {
            if used {
                features.insert(feature);
            }
        };
        note(!self.joints.is_empty(), Feature::Joints);
        note(!self.springs.is_empty(), Feature::Springs);
        note(!self.controllers.is_empty() || self.scaled_by.is_some(), Feature::Controllers);
        note(!self.paths.is_empty(), Feature::Paths);
        for entry in &self.script {
            if let Some(feature) = entry.op.feature() {
                note(true, feature);
            }
        }
        features
    }
}

impl Op {
    /// The feature the operation needs.
    pub(crate) fn feature(&self) -> Option<Feature> {
        match self {
            Op::Add { target, .. }
            | Op::Remove { target, .. }
            | Op::Dispose { target, .. }
            | Op::Enable { target, .. }
            | Op::Disable { target, .. } => target.feature(),
            Op::Create { creation: Creation::Joint { .. } } | Op::SetJoint { .. } => Some(Feature::Joints),
            Op::Create { creation: Creation::Spring { .. } } | Op::SetSpring { .. } => Some(Feature::Springs),
            Op::Create { creation: Creation::Controller { .. } }
            | Op::DisturbWave { .. }
            | Op::FluidAddGeom { .. }
            | Op::FluidRemoveGeom { .. }
            | Op::SetScaling { .. } => Some(Feature::Controllers),
            _ => None,
        }
    }
}

impl Target {
    /// The feature that an object of this kind needs.
    fn feature(self) -> Option<Feature> {
        match self {
            Target::Body | Target::Geom => None,
            Target::Joint => Some(Feature::Joints),
            Target::Spring => Some(Feature::Springs),
            Target::Controller => Some(Feature::Controllers),
        }
    }
}
