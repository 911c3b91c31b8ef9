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

/// Fraction of a geom's vertices, 0..=1: with fewer in the fluid the geom has left it. Farseer's value.
const LEAVING_FRACTION: f32 = 0.15;

/// Minimum submerged area, in length units²: a smaller one exerts no force. Farseer's value.
const MIN_SUBMERGED_AREA: f64 = 0.000001;

/// Lets geoms float: buoyancy, drag, and an event when one dives in.
///
/// The submerged shape is the polygon of the **vertices** inside the container. It is not clipped at the surface: a box
/// with two of four corners in the water gets no force. Outlines with many vertices float best.
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
    /// The geoms that may float, in the order in which they were added, and whether each was found in the fluid.
    pub(crate) geoms: Vec<(GeomId, bool)>,
    /// The submerged vertices of the geom in work.
    #[serde(skip)]
    pub(crate) submerged: Vertices,
}

impl FluidDragController {
    /// A fluid without geoms. `density` is in mass units per length unit², `gravity` in length units/s²: it gives the
    /// fluid its weight and may differ from the simulator's. For the coefficients see
    /// [`linear_drag_coefficient`](Self::linear_drag_coefficient) and
    /// [`rotational_drag_coefficient`](Self::rotational_drag_coefficient).
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

    /// Replaces everything that [`new`](Self::new) takes. The geoms stay, and so does whether each is in the fluid.
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
        /// Mass of the fluid per area, in mass units per length unit².
        #[doc(alias = "Density")]
        density, set_density;
        /// Coefficient of linear drag. Force = -0.5 · coefficient · velocity · density · breadth · submerged mass,
        /// where breadth is the extent across the velocity.
        #[doc(alias = "LinearDragCoefficient")]
        linear_drag_coefficient, set_linear_drag_coefficient;
        /// Coefficient of rotational drag. Torque = -coefficient · angular velocity · submerged mass.
        #[doc(alias = "RotationalDragCoefficient")]
        rotational_drag_coefficient, set_rotational_drag_coefficient;
    }

    /// The region of the fluid.
    pub fn container(&self) -> FluidContainerRef {
        self.container
    }

    /// Sets the region of the fluid.
    pub fn set_container(&mut self, container: FluidContainerRef) {
        self.container = container;
    }

    /// The gravity that makes the fluid buoyant, in length units/s².
    pub fn gravity(&self) -> Vector2 {
        self.gravity
    }

    /// Sets the fluid's gravity.
    ///
    /// # Errors
    /// A value that is not finite.
    pub fn set_gravity(&mut self, gravity: Vector2) -> Result<()> {
        self.gravity = finite_vector("gravity", gravity)?;
        Ok(())
    }

    /// The geoms that the fluid may carry, in the order in which it works on them.
    pub fn geoms(&self) -> impl Iterator<Item = GeomId> + '_ {
        self.geoms.iter().map(|&(geom, _)| geom)
    }

    /// Whether a geom was in the fluid in the last update. A geom that leaves the container's box within one step still
    /// counts as in the fluid, as in the original.
    pub fn is_in_fluid(&self, geom: GeomId) -> bool {
        self.geoms.contains(&(geom, true))
    }

    /// Adds a geom that the fluid may carry. It need not be in the simulation. Disposed geoms are removed
    /// automatically.
    ///
    /// # Errors
    /// A geom that was added before; the original throws then, too, but doubles its forces.
    #[doc(alias = "AddGeom")]
    pub fn add_geom(&mut self, geom: GeomId) -> Result<()> {
        if self.geoms().any(|carried| carried == geom) {
            return Err(Error::invalid("geom", geom, "a geom that was not added before"));
        }
        self.geoms.push((geom, false));
        Ok(())
    }

    /// Removes a geom, if it was added: the fluid has no effect on it any more.
    #[doc(alias = "RemoveGeom")]
    pub fn remove_geom(&mut self, geom: GeomId) {
        self.geoms.retain(|&(carried, _)| carried != geom);
    }

    /// Resets which geoms were in the fluid: geoms that are in it will be reported again.
    #[doc(alias = "Reset")]
    pub fn reset(&mut self) {
        for (_, is_in_fluid) in &mut self.geoms {
            *is_in_fluid = false;
        }
    }

    /// Whether a geom with this number of submerged vertices counts as out of the fluid.
    pub(crate) fn has_left(submerged: usize, vertices: usize) -> bool {
        (submerged as f32) < vertices as f32 * LEAVING_FRACTION
    }

    /// Force and torque of the fluid on a body with this submerged polygon; `None` below [`MIN_SUBMERGED_AREA`].
    pub(crate) fn fluid_force(
        &self,
        submerged: &Vertices,
        total_area: f32,
        body: &Body,
    ) -> Option<FluidForce> {
        let area = submerged.get_area();
        if f64::from(area) < MIN_SUBMERGED_AREA {
            return None;
        }
        let centre = submerged.get_centroid_with_area(area);
        let buoyancy = -self.gravity * area * self.density;
        let velocity = body.get_velocity_at_world_point(centre);
        let breadth = breadth_across(submerged, velocity);
        let mass = body.mass() * (area / total_area);
        let drag = velocity * (-0.5 * self.density * breadth * self.linear_drag_coefficient * mass);
        let torque = -body.angular_velocity() * self.rotational_drag_coefficient * mass;
        Some(FluidForce { force: buoyancy + drag, centre, torque })
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

/// Extent of a polygon across a direction, in length units; 0 if the direction is zero.
fn breadth_across(polygon: &Vertices, direction: Vector2) -> f32 {
    let mut axis = Vector2::new(-direction.y, direction.x);
    if axis.x != 0.0 || axis.y != 0.0 {
        axis = vector2::normalize(axis);
    }
    vector2::project_to_axis(polygon, axis).map_or(0.0, |(low, high)| (high - low).abs())
}

/// A force, the point of the world at which it acts, and an additional torque.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FluidForce {
    force: Vector2,
    centre: Vector2,
    torque: f32,
}

impl FluidForce {
    /// Adds force and torque to a body. If a sum would not be finite it adds none and returns false.
    pub(crate) fn apply_to(self, body: &mut Body) -> bool {
        let FluidForce { force, centre, torque } = self;
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
