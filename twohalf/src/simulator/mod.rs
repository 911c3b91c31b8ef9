//! The simulator: owns core, depth state, buffers and report.

mod crush;
mod draw_items;
mod draw_order;
mod fields;
mod geoms;
mod incremental_sort;
mod joint_lengths;
mod objects;
mod platforms;
mod queries;
mod rays;
mod save;
mod settings;
mod snapshot;
mod surface_query;
mod time_scale;
mod update;

pub use draw_items::Drawable;
pub use draw_order::DrawOrder;
pub use rays::{RayHit3D, SweepHit3D};
pub use save::SavedTwoHalfSimulator;
pub use surface_query::Surface;

use farseer_core::depth::DepthAxisMut;
use farseer_core::{Body, BodyId, PhysicsSimulator};

use crate::character::Neighbours;
use crate::depth::{DepthScheme, World};
use crate::stages::{Pipeline, Report};
use crate::views::access::{Source, SourceMut};
use crate::{Projection, Result, Vector2};
use objects::adopt_body;

/// Default direction of the Z axis on the screen, degrees: straight up.
const DEFAULT_ANGLE: i32 = 90;

/// Owns bodies and geoms and moves them in steps, in three dimensions.
///
/// Objects have the ids of the 2D engine and its life cycle: *created*, *added* (takes part from the next
/// update), *removed* and *disposed* (its id goes stale with the next update).
///
/// ```
/// use twohalf::{TwoHalfPhysicsSimulator, Vector2, Vector3, farseer_core};
/// use farseer_core::{BodyFactory, GeomPlacement, Vertices};
///
/// let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 100.0))?;
/// let body = simulator.create_body(BodyFactory::create_rectangle_body(20.0, 20.0, 1.0)?);
/// let geom = simulator.create_geom(body, Vertices::create_rectangle(20.0, 20.0)?, GeomPlacement::default())?;
/// simulator.add(body)?;
/// simulator.add(geom)?;
///
/// let mut crate_box = simulator.body_mut(body).unwrap();
/// crate_box.ground_mut().set_object_geom(geom, None)?;
/// crate_box.set_position3d(Vector3::new(100.0, 50.0, 30.0));
/// for _ in 0..200 {
///     simulator.update(0.01);
/// }
/// let position = simulator.body(body).unwrap().position3d();
/// assert!(position.y.abs() < 0.1 && position.z == 30.0);
/// # Ok::<(), twohalf::Error>(())
/// ```
#[derive(Debug)]
pub struct TwoHalfPhysicsSimulator {
    pub(crate) core: PhysicsSimulator,
    pub(crate) world: World,
    pipeline: Pipeline,
    report: Report,
    /// Buffer: neighbours of the character that moves next.
    pub(crate) near: Neighbours,
}

/// [`clone_from`](Clone::clone_from) keeps the capacity of the core's lists, for games that return to copies.
impl Clone for TwoHalfPhysicsSimulator {
    fn clone(&self) -> Self {
        let TwoHalfPhysicsSimulator { core, world, pipeline, report, near } = self;
        TwoHalfPhysicsSimulator {
            core: core.clone(),
            world: world.clone(),
            pipeline: pipeline.clone(),
            report: report.clone(),
            near: near.clone(),
        }
    }

    fn clone_from(&mut self, source: &Self) {
        let TwoHalfPhysicsSimulator { core, world, pipeline, report, near } = source;
        self.core.clone_from(core);
        self.world.clone_from(world);
        self.pipeline.clone_from(pipeline);
        self.report.clone_from(report);
        self.near.clone_from(near);
    }
}

/// Construction.
impl TwoHalfPhysicsSimulator {
    /// An empty simulator without gravity, for a screen of `height` px whose Z axis points straight up.
    ///
    /// # Errors
    /// A height that is not greater than 0.
    #[doc(alias = "TwoHalfPhysicsSimulator(int)")]
    pub fn new(height: i32) -> Result<Self> {
        Self::with_angle(height, DEFAULT_ANGLE)
    }

    /// An empty simulator without gravity. `angle` is the direction of the Z axis on the screen, degrees
    /// counterclockwise from the x axis.
    ///
    /// # Errors
    /// A height that is not greater than 0; an angle that is not between 0 and 180.
    #[doc(alias = "TwoHalfPhysicsSimulator(int, int)")]
    pub fn with_angle(height: i32, angle: i32) -> Result<Self> {
        Self::empty(height, angle, PhysicsSimulator::default())
    }

    /// An empty simulator with gravity: acceleration in px/s² in screen orientation, so (0, 100) pulls down.
    ///
    /// # Errors
    /// A height that is not greater than 0; gravity that is not finite.
    #[doc(alias = "TwoHalfPhysicsSimulator(int, Vector2)")]
    pub fn with_gravity(height: i32, gravity: Vector2) -> Result<Self> {
        Self::with_angle_and_gravity(height, DEFAULT_ANGLE, gravity)
    }

    /// An empty simulator with a Z axis at an angle and gravity.
    ///
    /// # Errors
    /// As [`with_angle`](Self::with_angle) and [`with_gravity`](Self::with_gravity).
    #[doc(alias = "TwoHalfPhysicsSimulator(int, int, Vector2)")]
    pub fn with_angle_and_gravity(height: i32, angle: i32, gravity: Vector2) -> Result<Self> {
        Self::empty(height, angle, PhysicsSimulator::new(gravity)?)
    }

    fn empty(height: i32, angle: i32, core: PhysicsSimulator) -> Result<Self> {
        let mut simulator = Self::from_core(height, angle, core)?;
        simulator.set_depth_scheme(DepthScheme::default())?;
        Ok(simulator)
    }

    /// Takes over a 2D simulator with its settings and all of its objects; objects that wait to be added
    /// enter now. Its plane becomes that of X and Y. Every body is at Z = 0, with its height so that y = 0 is
    /// the ground, and no body has an object geom yet. Every geom is a prism as deep as the shorter side of
    /// its outline's AABB.
    ///
    /// This also allows another broad phase or other solver settings. A simulator with the [precise
    /// set](farseer_core::Methods::Precise) gets [`DepthScheme::Precise`], any other one
    /// [`DepthScheme::Faithful`].
    ///
    /// # Errors
    /// A height that is not greater than 0; an angle that is not between 0 and 180.
    pub fn from_core(height: i32, angle: i32, core: PhysicsSimulator) -> Result<Self> {
        let mut world = World::new(Projection::new(height, angle)?);
        let is_precise = matches!(core.methods(), farseer_core::Methods::Precise { .. });
        world.scheme = if is_precise { DepthScheme::Precise } else { DepthScheme::Faithful };
        let mut simulator = TwoHalfPhysicsSimulator::of(core, world);
        simulator.core.process_added_and_removed();
        if is_precise {
            DepthAxisMut::of(&mut simulator.core).enable(LENGTH_UNIT)?;
        }
        let TwoHalfPhysicsSimulator { core, world, .. } = &mut simulator;
        for body in core.bodies() {
            adopt_body(core, &mut world.depths, body);
        }
        Ok(simulator)
    }

    /// Returns a simulator of a core and the state beside it, before its first update.
    fn of(core: PhysicsSimulator, world: World) -> Self {
        let (pipeline, report) = Default::default();
        TwoHalfPhysicsSimulator { core, world, pipeline, report, near: Neighbours::default() }
    }
}

macro_rules! access {
    ($($type:ty),*) => {$(
        impl Source for $type {
            fn core(&self) -> &PhysicsSimulator {
                &self.core
            }
            fn world(&self) -> &World {
                &self.world
            }
        }
    )*};
}

access!(&TwoHalfPhysicsSimulator, &mut TwoHalfPhysicsSimulator);

impl SourceMut for &mut TwoHalfPhysicsSimulator {
    fn core_body_mut(&mut self, body: BodyId) -> Option<&mut Body> {
        self.core.body_mut(body)
    }
    fn world_mut(&mut self) -> &mut World {
        &mut self.world
    }
}

/// Length unit of the precise set, px: the size of objects that a player looks at; see
/// [`farseer_core::Methods::Precise`].
const LENGTH_UNIT: f32 = 32.0;
