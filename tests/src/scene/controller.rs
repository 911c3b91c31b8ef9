//! Controllers.

use super::SceneError;
use super::reader::{Keys, Object, keys, tagged, words};
use farseer_core::math::Vector2;

/// A controller to create.
#[derive(Debug, Clone, PartialEq)]
pub struct ControllerSpec {
    /// Its kind, with the values of the kind.
    pub kind: ControllerKind,
    /// Whether it acts.
    pub enabled: Option<bool>,
    /// Whether it is added to the simulation at once.
    pub in_simulation: bool,
}

keys!(ControllerSpec { kind [flat], enabled, in_simulation [or true] });

/// The controllers.
#[derive(Debug, Clone, PartialEq)]
pub enum ControllerKind {
    /// Drag and buoyancy in a fluid.
    FluidDrag {
        /// The fluid.
        fluid: FluidDragSpec,
    },
    /// Attraction by bodies and points.
    Gravity {
        /// The sources and their law.
        gravity: GravitySpec,
    },
    /// Puts bodies far from any activity to sleep.
    Inactivity {
        /// Distance within which an active body keeps others awake, in length units.
        activation_distance: f32,
        /// Time of rest before sleep, in milliseconds of the original's clock.
        max_idle_time: f32,
    },
    /// A surface of waves.
    Wave {
        /// The surface.
        wave: WaveSpec,
    },
    /// Adapts the time step to the load.
    Scaling {
        /// Time step it returns to.
        preferred_interval: f32,
        /// Longest time step.
        maximum_interval: f32,
    },
}

tagged!(ControllerKind, "type" {
    "fluid_drag" => FluidDrag { fluid [flat] },
    "gravity" => Gravity { gravity [flat] },
    "inactivity" => Inactivity { activation_distance, max_idle_time },
    "wave" => Wave { wave [flat] },
    "scaling" => Scaling { preferred_interval, maximum_interval },
});

/// A fluid and the geoms that swim in it.
#[derive(Debug, Clone, PartialEq)]
pub struct FluidDragSpec {
    /// Where the fluid is.
    pub container: FluidContainer,
    /// Mass per area.
    pub density: f32,
    /// Coefficient of the drag on velocity.
    pub linear_drag: f32,
    /// Coefficient of the drag on angular velocity.
    pub rotational_drag: f32,
    /// Gravity that buoyancy works against.
    pub gravity: Vector2,
    /// Ids of the geoms in its care.
    pub geoms: Vec<usize>,
}

/// Where a fluid is.
#[derive(Debug, Clone, PartialEq)]
pub enum FluidContainer {
    /// In a box.
    Box(Corners),
    /// Under the surface of a wave controller, given by index.
    Wave(usize),
}

/// Two corners of a box.
#[derive(Debug, Clone, PartialEq)]
pub struct Corners {
    /// The corner with the smaller coordinates.
    pub min: Vector2,
    /// The corner with the larger coordinates.
    pub max: Vector2,
}

keys!(Corners { min, max });

impl Keys for FluidDragSpec {
    fn take(object: &mut Object<'_>) -> Result<Self, SceneError> {
        let container = match (object.key("container")?, object.key("wave")?) {
            (Some(corners), None) => FluidContainer::Box(corners),
            (None, Some(wave)) => FluidContainer::Wave(wave),
            _ => return Err(object.error("needs either `container` or `wave`")),
        };
        Ok(FluidDragSpec {
            container,
            density: object.key("density")?,
            linear_drag: object.key("linear_drag")?,
            rotational_drag: object.key("rotational_drag")?,
            gravity: object.key("gravity")?,
            geoms: object.key_or("geoms", Vec::new())?,
        })
    }
}

/// How attraction depends on distance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GravityLaw {
    /// With its inverse.
    Linear,
    /// With the inverse of its square.
    DistanceSquared,
}

words!(GravityLaw { "linear" => Linear, "distance_squared" => DistanceSquared });

/// Sources of attraction. At least one of the lists is given.
#[derive(Debug, Clone, PartialEq)]
pub struct GravitySpec {
    /// Indices of attracting bodies.
    pub bodies: Option<Vec<usize>>,
    /// Attracting points.
    pub points: Option<Vec<Vector2>>,
    /// Strength of the gravity controller, a coefficient of its force.
    pub strength: f32,
    /// Range in length units.
    pub radius: f32,
    /// How attraction depends on distance.
    pub gravity_type: Option<GravityLaw>,
}

impl Keys for GravitySpec {
    fn take(object: &mut Object<'_>) -> Result<Self, SceneError> {
        if !object.has("bodies") && !object.has("points") {
            return Err(object.error("needs `bodies` or `points`"));
        }
        Ok(GravitySpec {
            bodies: object.key("bodies")?,
            points: object.key("points")?,
            strength: object.key("strength")?,
            radius: object.key("radius")?,
            gravity_type: object.key("gravity_type")?,
        })
    }
}

/// A surface of waves.
#[derive(Debug, Clone, PartialEq)]
pub struct WaveSpec {
    /// Its upper left corner.
    pub position: Vector2,
    /// Extent along x in length units.
    pub width: f32,
    /// Extent along y in length units.
    pub height: f32,
    /// Number of nodes of the surface.
    pub node_count: i32,
    /// Damping coefficient of the nodes.
    pub damping_coefficient: f32,
    /// Frequency of the surface's update.
    pub frequency: f32,
    /// Upper turning point of the generator in length units.
    pub generator_max: f32,
    /// Lower turning point of the generator in length units.
    pub generator_min: f32,
    /// Step of the generator.
    pub generator_step: f32,
}

keys!(WaveSpec {
    position,
    width,
    height,
    node_count,
    damping_coefficient,
    frequency,
    generator_max,
    generator_min,
    generator_step,
});
