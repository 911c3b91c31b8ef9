//! Buoyancy and drag in a fluid (behaviour chapter 12, section 5).

use serde::{Deserialize, Serialize};

use super::FluidContainerRef;
use crate::body::Body;
use crate::checked_properties::checked_properties;
use crate::error::{Error, Result};
use crate::geom::GeomId;
use crate::math::finite::{finite, finite_vector};
use crate::math::{Vector2, vector2};
use crate::shape::Vertices;
use crate::storage::collection::has_no_duplicates;

/// A geom with a smaller part of its vertices in the fluid has left it.
const LEAVING_FRACTION: f32 = 0.15;

/// A smaller submerged area, in square units, feels nothing.
const LEAST_AREA: f64 = 0.000001;

/// Lets geoms float: buoyancy, drag, and an event when one dives in.
///
/// The submerged shape is the polygon of the **vertices** inside the container; it is not clipped at the surface, so
/// a box with two of four corners in the water feels nothing. Outlines with many vertices float best.
///
/// ```
/// use farseer_core::math::Vector2;
/// use farseer_core::{Aabb, AabbFluidContainer, FluidContainerRef, FluidDragController};
///
/// let pool = Aabb::new(Vector2::new(0.0, 200.0), Vector2::new(800.0, 600.0));
/// let pool = FluidContainerRef::Aabb(AabbFluidContainer::new(pool)?);
/// let water = FluidDragController::new(pool, 0.005, 0.9, 1.0, Vector2::new(0.0, 150.0))?;
/// assert_eq!(water.density(), 0.005);
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct FluidDragController {
    container: FluidContainerRef,
    density: f32,
    linear_drag_coefficient: f32,
    rotational_drag_coefficient: f32,
    gravity: Vector2,
    /// In the order in which they were added, and whether each was found in the fluid.
    pub(crate) geoms: Vec<(GeomId, bool)>,
    /// The submerged vertices of the geom at work.
    #[serde(skip)]
    pub(crate) submerged: Vertices,
}

impl FluidDragController {
    /// A fluid without geoms to carry. `density` is mass per square unit, the drag coefficients are per velocity,
    /// `gravity` is what the fluid weighs with and may differ from the simulator's.
    ///
    /// # Errors
    /// Numbers that are not finite.
    #[doc(alias = "Initialize")]
    pub fn new(
        container: FluidContainerRef,
        density: f32,
        linear_drag_coefficient: f32,
        rotational_drag_coefficient: f32,
        gravity: Vector2,
    ) -> Result<Self> {
        Ok(FluidDragController {
            container,
            density: finite("density", density)?,
            linear_drag_coefficient: finite("linear_drag_coefficient", linear_drag_coefficient)?,
            rotational_drag_coefficient: finite("rotational_drag_coefficient", rotational_drag_coefficient)?,
            gravity: finite_vector("gravity", gravity)?,
            geoms: Vec::new(),
            submerged: Vertices::new(),
        })
    }

    /// Replaces everything that [`new`](Self::new) takes; geoms stay, and so does what is known of each.
    ///
    /// # Errors
    /// Numbers that are not finite.
    #[doc(alias = "Initialize")]
    pub fn initialize(
        &mut self,
        container: FluidContainerRef,
        density: f32,
        linear_drag_coefficient: f32,
        rotational_drag_coefficient: f32,
        gravity: Vector2,
    ) -> Result<()> {
        let fresh = FluidDragController::new(
            container,
            density,
            linear_drag_coefficient,
            rotational_drag_coefficient,
            gravity,
        )?;
        let geoms = std::mem::take(&mut self.geoms);
        let submerged = std::mem::take(&mut self.submerged);
        *self = FluidDragController { geoms, submerged, ..fresh };
        Ok(())
    }

    checked_properties! {
        /// Mass of the fluid per square unit.
        #[doc(alias = "Density")]
        density, set_density;
        /// Force per velocity, per density, breadth and submerged mass.
        #[doc(alias = "LinearDragCoefficient")]
        linear_drag_coefficient, set_linear_drag_coefficient;
        /// Torque per angular velocity and submerged mass.
        #[doc(alias = "RotationalDragCoefficient")]
        rotational_drag_coefficient, set_rotational_drag_coefficient;
    }

    /// Where the fluid is.
    pub fn container(&self) -> FluidContainerRef {
        self.container
    }

    /// Moves the fluid.
    pub fn set_container(&mut self, container: FluidContainerRef) {
        self.container = container;
    }

    /// The gravity that makes the fluid buoyant, in units per square second.
    pub fn gravity(&self) -> Vector2 {
        self.gravity
    }

    /// Sets the fluid's gravity.
    ///
    /// # Errors
    /// What is not finite.
    pub fn set_gravity(&mut self, gravity: Vector2) -> Result<()> {
        self.gravity = finite_vector("gravity", gravity)?;
        Ok(())
    }

    /// The geoms that the fluid may carry, in the order in which it works on them.
    pub fn geoms(&self) -> impl Iterator<Item = GeomId> + '_ {
        self.geoms.iter().map(|&(geom, _)| geom)
    }

    /// Whether a geom was in the fluid when it was last looked at. One that leaves the container's box in one step
    /// goes on counting as in the fluid, as in the original.
    pub fn is_in_fluid(&self, geom: GeomId) -> bool {
        self.geoms.contains(&(geom, true))
    }

    /// Lets the fluid carry a geom, which need not be in the simulation. Disposed geoms are forgotten.
    ///
    /// # Errors
    /// A geom that is carried already; the original throws then, too, but doubles its forces.
    #[doc(alias = "AddGeom")]
    pub fn add_geom(&mut self, geom: GeomId) -> Result<()> {
        if self.geoms().any(|carried| carried == geom) {
            return Err(Error::invalid("geom", geom, "a geom that was not added before"));
        }
        self.geoms.push((geom, false));
        Ok(())
    }

    /// Lets the fluid leave a geom alone; nothing happens if it did already.
    #[doc(alias = "RemoveGeom")]
    pub fn remove_geom(&mut self, geom: GeomId) {
        self.geoms.retain(|&(carried, _)| carried != geom);
    }

    /// Forgets which geoms were in the fluid: those that are will be reported again.
    #[doc(alias = "Reset")]
    pub fn reset(&mut self) {
        for (_, is_in_fluid) in &mut self.geoms {
            *is_in_fluid = false;
        }
    }

    /// Whether a geom with so many of its vertices in the fluid counts as out of it.
    pub(crate) fn has_left(submerged: usize, vertices: usize) -> bool {
        (submerged as f32) < vertices as f32 * LEAVING_FRACTION
    }

    /// What the fluid does to a body of which this polygon is submerged; `None` if that is too small to matter.
    pub(crate) fn load(&self, submerged: &Vertices, total_area: f32, body: &Body) -> Option<Load> {
        let area = submerged.get_area();
        if f64::from(area) < LEAST_AREA {
            return None;
        }
        let centre = submerged.get_centroid_with_area(area);
        let buoyancy = -self.gravity * area * self.density;
        let velocity = body.get_velocity_at_world_point(centre);
        let breadth = breadth_across(submerged, velocity);
        let mass = body.mass() * (area / total_area);
        let drag = velocity * (-0.5 * self.density * breadth * self.linear_drag_coefficient * mass);
        let torque = -body.angular_velocity() * self.rotational_drag_coefficient * mass;
        Some(Load { force: buoyancy + drag, centre, torque })
    }

    pub(super) fn is_valid(&self) -> bool {
        let container_is_valid = match &self.container {
            FluidContainerRef::Aabb(container) => container.is_valid(),
            FluidContainerRef::Wave(_) | FluidContainerRef::UserDefined => true,
        };
        let numbers = [
            self.density,
            self.linear_drag_coefficient,
            self.rotational_drag_coefficient,
            self.gravity.x,
            self.gravity.y,
        ];
        let geoms: Vec<GeomId> = self.geoms().collect();
        container_is_valid && numbers.iter().all(|number| number.is_finite()) && has_no_duplicates(&geoms)
    }
}

/// Extent of a polygon across a direction; across none it is 0.
fn breadth_across(polygon: &Vertices, direction: Vector2) -> f32 {
    let mut axis = Vector2::new(-direction.y, direction.x);
    if axis.x != 0.0 || axis.y != 0.0 {
        axis = vector2::normalize(axis);
    }
    vector2::project_to_axis(polygon, axis).map_or(0.0, |(low, high)| (high - low).abs())
}

/// A force at a point of the world, and a torque.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Load {
    force: Vector2,
    centre: Vector2,
    torque: f32,
}

impl Load {
    /// Adds force and torque to a body. Answers false, and adds nothing, if what the body has then would not be
    /// finite.
    pub(crate) fn apply_to(self, body: &mut Body) -> bool {
        let Load { force, centre, torque } = self;
        let arm = centre - body.position();
        let sums = [
            body.force().x + force.x,
            body.force().y + force.y,
            body.torque() + (arm.x * force.y - arm.y * force.x) + torque,
        ];
        let is_finite = sums.iter().all(|sum| sum.is_finite());
        if is_finite {
            body.apply_force_at_world_point(force, centre);
            body.apply_torque(torque);
        }
        is_finite
    }
}
