//! Changes that affect more than one object (behaviour chapter 05, section 3).

use super::Objects;
use super::creating::{automatic_cell_size, check_may_hold_chain, check_outline, check_pose_is_finite};
use crate::body::BodyId;
use crate::geom::GeomId;
use crate::geom::entry::GeomEntry;
use crate::math::finite::{finite, finite_vector, zero_or_more};
use crate::math::{Matrix, Vector2};
use crate::shape::Vertices;
use crate::{Error, Result, SurfaceOptions};

/// Changes.
impl Objects {
    /// Moves a geom to another body; its offsets stay.
    ///
    /// # Errors
    /// A stale id; a box that is not finite at the other body; a chain for a body that is not static.
    #[doc(alias = "SetBody")]
    pub fn set_body(&mut self, geom: GeomId, body: BodyId) -> Result<()> {
        let old_body = self.geoms.get(geom).ok_or(Error::StaleId { argument: "geom" })?.body;
        let new_owner = self.bodies.get(body).ok_or(Error::StaleId { argument: "body" })?;
        if self.geoms[geom].outline.is_one_sided() {
            check_may_hold_chain(body, new_owner)?;
        }
        check_pose_is_finite("geom", self.geoms[geom].clone(), new_owner)?;
        self.update_edited_geom_transforms(old_body);
        self.update_edited_geom_transforms(body);
        let new_body = &self.bodies[body].body;
        let moved = &mut self.geoms[geom];
        moved.body = body;
        moved.update_transform(new_body.position(), new_body.rotation());
        self.bodies[old_body].detach(geom);
        self.bodies[body].geoms.push(geom);
        self.has_new_structure = true;
        Ok(())
    }

    /// Replaces the outline of a geom. With the [precise set](crate::Methods::Precise) world vertices and box change at
    /// once, contacts in the next update. Bodies that rest on the geom wake, and bodies that it overlaps are pushed
    /// out.
    ///
    /// With the faithful set, as in the original, world vertices and box stay at the body's origin until the body is
    /// moved or integrated next, and the distance grid stays that of the old outline. Contacts are found with the old
    /// grid until it is [removed](Self::remove_distance_grid) and [made again](Self::create_distance_grid).
    ///
    /// # Errors
    /// A stale id; an empty or non-finite outline; one whose world coordinates are not finite at the body's pose.
    #[doc(alias("SetVertices", "LocalVertices"))]
    pub fn set_vertices(&mut self, geom: GeomId, vertices: impl Into<Vertices>) -> Result<()> {
        let vertices = check_outline(vertices.into())?;
        let mut replaced = self.geoms.get(geom).ok_or(Error::StaleId { argument: "geom" })?.clone();
        let body = replaced.body;
        replaced.set_vertices(vertices);
        let GeomEntry { local_vertices, .. } =
            check_pose_is_finite("vertices", replaced, &self.bodies[body])?;
        self.update_edited_geom_transforms(body);
        let replaced = &mut self.geoms[geom];
        replaced.set_vertices(local_vertices);
        if self.methods.is_precise() {
            let body = &self.bodies[body].body;
            replaced.update_transform(body.position(), body.rotation());
        }
        self.has_new_structure = true;
        Ok(())
    }

    /// Makes the distance grid of a geom from its present outline, and updates its world vertices and box. If the geom
    /// has a grid, no state changes: [remove](Self::remove_distance_grid) the old one first. The cell size stays; at 0
    /// or less it becomes a tenth of the shorter side of the geom's present box. Geoms that shared the old grid, such
    /// as [clones](Self::clone_geom), keep that. While SAT is selected a grid can be made, but is not used (behaviour
    /// chapter 06, section 2).
    ///
    /// # Errors
    /// A stale id; a geom whose box in the world is not finite. A flat outline without a cell size, or a cell size that
    /// would need more than 2^26 nodes. [`Error::LimitExceeded`] for a grid whose work exceeds the
    /// [limits](Self::limits).
    #[doc(alias("CreateDistanceGrid", "DistanceGrid.CreateDistanceGrid"))]
    pub fn create_distance_grid(&mut self, geom: GeomId) -> Result<()> {
        let entry = self.geoms.get(geom).ok_or(Error::StaleId { argument: "geom" })?;
        if entry.grid.is_some() {
            return Ok(());
        }
        self.update_edited_geom_transforms(entry.body);
        let mut entry = self.geoms[geom].clone();
        if entry.grid_cell_size <= 0.0 {
            entry.grid_cell_size = automatic_cell_size(&entry);
        }
        entry.set_grid(self.distance_grid(&entry.local_vertices, entry.grid_cell_size)?);
        entry.refresh();
        let owner = &self.bodies[entry.body];
        self.geoms[geom] = check_pose_is_finite("geom", entry, owner)?;
        Ok(())
    }

    /// Removes the distance grid of a geom: it has no contacts by distance grids until a grid is [made
    /// again](Self::create_distance_grid). The original throws when such a geom is tested. Geoms that share the grid
    /// keep it. A geom without a grid does not change.
    ///
    /// # Errors
    /// A stale id.
    #[doc(alias("RemoveDistanceGrid", "DistanceGrid.RemoveDistanceGrid"))]
    pub fn remove_distance_grid(&mut self, geom: GeomId) -> Result<()> {
        self.geoms.get_mut(geom).ok_or(Error::StaleId { argument: "geom" })?.grid = None;
        Ok(())
    }

    /// Replaces the matrix of a geom until its body is moved or integrated next. World vertices and box change at once;
    /// the geom's position and rotation do not, as in the original.
    ///
    /// # Errors
    /// A stale id; a matrix that is not finite or has no finite inverse, or with which world coordinates are not
    /// finite.
    #[doc(alias = "Matrix")]
    pub fn set_matrix(&mut self, geom: GeomId, matrix: &Matrix) -> Result<()> {
        let is_finite = |m: &Matrix| m.iter().all(|element| element.is_finite());
        if !is_finite(matrix) || !is_finite(&crate::math::matrix::invert(matrix)) {
            return Err(Error::invalid("matrix", matrix.as_slice(), "finite and invertible"));
        }
        let mut replaced = self.geoms.get(geom).ok_or(Error::StaleId { argument: "geom" })?.clone();
        let body = replaced.body;
        replaced.set_matrix(matrix);
        check_pose_is_finite("matrix", replaced, &self.bodies[body])?;
        self.update_edited_geom_transforms(body);
        self.geoms[geom].set_matrix(matrix);
        self.has_new_structure = true;
        Ok(())
    }

    /// Makes a geom one-way, or an ordinary geom again with `None`. A one-way geom stops bodies that come against a
    /// direction, and all others pass through it: for platforms that a figure jumps up through, valves and doors. The
    /// direction is given in the coordinates of the geom's body and turns with it; its length has no effect. (0, -1) is
    /// up on a body that is not turned.
    ///
    /// - **A shape lands** if at the first touch it is entirely above a face of the geom whose normal is within 60
    ///   degrees of the direction. The tolerance is the reach of contacts, a fiftieth of the length unit of the
    ///   methods. Each convex piece counts for itself; a round face counts where the two touch. A crate that arrives
    ///   with one corner beside the end of a platform, and below its top, does not land. A shape that has landed
    ///   collides with all of the geom until the two separate.
    /// - **All other shapes pass through** as if the geom were not there, to the last bit, and without callbacks and
    ///   events. They come from behind or from the sides, or turn back inside. Shapes also pass if they already overlap
    ///   by more than the reach of contacts when one of the two is placed, when their collision is enabled again, or
    ///   when the direction is set. They pass until no piece of their body overlaps the geom any more.
    /// - The decision depends on the motion of both bodies in the step in which they meet. So it depends neither on the
    ///   length of steps nor on which of the two moves or turns. A shape that moves by more than its thickness in a
    ///   step lands as well.
    /// - If both geoms are one-way, a shape lands only if it does so on both. So a one-way geom of a falling body falls
    ///   through a floor; planks of a hanging bridge collide with what lands on them, and pass each other.
    /// - A contact that a handler refuses has not landed. To let a body drop through a platform, refuse the contact, or
    ///   separate the categories of the two until it has sunk in by more than the reach of contacts; it then continues
    ///   by itself.
    /// - A sensor, or a geom without collision response, reports everything that overlaps it, from whatever side it
    ///   came. Rays, points and boxes hit one-way geoms from all sides.
    ///
    /// The direction takes effect with the next update. Only with the [precise set](crate::Methods::Precise). An engine
    /// with depth ignores it, and has platforms instead.
    ///
    /// ```
    /// use farseer_core::math::Vector2;
    /// use farseer_core::{BodyFactory, GeomFactory, GeomPlacement, Methods, PhysicsSimulator};
    /// let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 900.0))?;
    /// simulator.set_methods(Methods::PRECISE)?;
    /// let mut make = |width: f32, height: f32, y: f32| {
    ///     let body = BodyFactory::create_rectangle_body_in(&mut simulator, width, height, 1.0)?;
    ///     simulator[body].set_position(Vector2::new(0.0, y));
    ///     let place = GeomPlacement::default();
    ///     let geom = GeomFactory::create_rectangle_geom_in(&mut simulator, body, width, height, place)?;
    ///     Ok::<_, farseer_core::Error>((body, geom))
    /// };
    /// let (platform, top) = make(200.0, 20.0, 0.0)?;
    /// let (figure, _) = make(20.0, 40.0, 60.0)?;
    /// simulator[platform].set_is_static(true);
    /// simulator.set_one_way(top, Some(Vector2::new(0.0, -1.0)))?;
    /// // It jumps from below, through the platform, and lands on it.
    /// simulator[figure].set_linear_velocity(Vector2::new(0.0, -500.0));
    /// (0..120).for_each(|_| simulator.update(1.0 / 60.0));
    /// assert!((simulator[figure].position().y - -30.0).abs() < 0.1);
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// A stale id; a direction that is not finite or has no length; [`Error::NotSupported`] under the faithful methods.
    pub fn set_one_way(&mut self, geom: GeomId, direction: Option<Vector2>) -> Result<()> {
        self.geoms.find("geom", geom)?;
        let direction = direction.map(unit).transpose()?;
        if direction.is_some() {
            self.methods.check_one_way()?;
        }
        self.geoms[geom].one_way = direction;
        // A setter of the geom would mark it as edited, too.
        self.geom_mut(geom);
        Ok(())
    }

    /// Locks the x or the y coordinate of a body, or both, or unlocks them. A locked coordinate keeps its bits, whatever acts on the
    /// body, as with infinite mass along that axis of the world. In the [iterative solver](crate::guide::solvers) an oblique impact
    /// may be stronger than with infinite mass, by a tenth. Velocities and forces along a locked axis end with the next
    /// update; [`set_position`](crate::Body::set_position) still moves the body. A change wakes it. Kinematic bodies move as
    /// before. For rotation there is [`set_rotation_locked`](crate::Body::set_rotation_locked).
    ///
    /// ```
    /// use farseer_core::{BodyBuilder, GeomBuilder, PhysicsSimulator};
    /// let mut simulator = PhysicsSimulator::precise([50.0, 300.0])?;
    /// // A lift: gravity along x has no effect on it.
    /// let (lift, _) = simulator.add_body(BodyBuilder::dynamic(), [GeomBuilder::rectangle(60.0, 10.0)])?;
    /// simulator.set_axes_locked(lift, [true, false])?;
    /// (0..60).for_each(|_| simulator.update(1.0 / 60.0));
    /// assert_eq!(simulator[lift].position().x, 0.0);
    /// assert!(simulator[lift].position().y > 100.0);
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// A stale id; [`Error::NotSupported`] for a lock under the faithful methods.
    #[doc(alias("b2MotionLocks", "LockedAxes", "lock_translations", "linearFactor"))]
    pub fn set_axes_locked(&mut self, body: BodyId, [x, y]: [bool; 2]) -> Result<()> {
        let entry = self.bodies.get(body).ok_or(Error::StaleId { argument: "body" })?;
        if entry.body.locked_axes() == [x, y] {
            return Ok(());
        }
        if x || y {
            self.methods.only_precise("locked axes of bodies")?;
        }
        self[body].set_locked_axes([x, y]);
        Ok(())
    }

    /// Sets how friction and restitution of a geom combine with those of others, the speed of its surface, and its rolling
    /// resistance. Bodies that touch it wake if something has changed. Builders have methods of the same names.
    ///
    /// ```
    /// use farseer_core::{BodyBuilder, GeomBuilder, PhysicsSimulator, SurfaceOptions};
    /// let mut simulator = PhysicsSimulator::precise([0.0, 300.0])?;
    /// let belt = BodyBuilder::fixed().position([0.0, 26.0]);
    /// let (_, [belt]) = simulator.add_body(belt, [GeomBuilder::rectangle(4000.0, 20.0)])?;
    /// let (parcel, _) = simulator.add_body(BodyBuilder::dynamic(), [GeomBuilder::rectangle(32.0, 32.0)])?;
    /// simulator.set_surface(belt, SurfaceOptions { speed: 60.0, ..SurfaceOptions::default() })?;
    /// (0..120).for_each(|_| simulator.update(1.0 / 60.0));
    /// assert!((simulator[parcel].linear_velocity().x - 60.0).abs() < 0.01);
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// A stale id; a number that is not finite; rolling resistance less than 0; [`Error::NotSupported`] for other than the default
    /// under the faithful methods.
    pub fn set_surface(&mut self, geom: GeomId, surface: SurfaceOptions) -> Result<()> {
        self.geoms.find("geom", geom)?;
        self.methods.check_surface(check_surface(surface)?)?;
        self[geom].surface = (surface != SurfaceOptions::default()).then_some(surface);
        Ok(())
    }

    /// Makes a geom a sensor (its body static, its collisions without response) or an ordinary geom (its body dynamic,
    /// whatever it was before, and its collisions with response).
    ///
    /// With the [precise set](crate::Methods::Precise) a sensor reports everything that overlaps it and that its filter
    /// admits: dynamic, kinematic and static bodies, and other sensors, whether they move or not. The same holds for
    /// each geom without [collision response](crate::Geom::set_collision_response_enabled), on any body. With the
    /// faithful set one of the two bodies must be dynamic.
    ///
    /// # Errors
    /// A stale id.
    #[doc(alias = "IsSensor")]
    pub fn set_is_sensor(&mut self, geom: GeomId, is_sensor: bool) -> Result<()> {
        let entry = self.geoms.get_mut(geom).ok_or(Error::StaleId { argument: "geom" })?;
        entry.is_sensor = is_sensor;
        entry.geom.set_collision_response_enabled(!is_sensor);
        self.bodies[entry.body].body.set_is_static(is_sensor);
        self.has_new_structure = true;
        Ok(())
    }

    /// Ignores collisions of the two geoms: no new pair of them is made. Geoms that already touch continue to do so
    /// until they separate.
    ///
    /// # Errors
    /// A stale id.
    #[doc(alias = "IgnoreCollisionWith")]
    pub fn ignore_collision_with(&mut self, geom: GeomId, other: GeomId) -> Result<()> {
        self.set_ignored(geom, other, true)
    }

    /// Undoes [`ignore_collision_with`](Self::ignore_collision_with) of the same geom; if the other geom ignores this
    /// one, it still does.
    ///
    /// # Errors
    /// A stale id.
    #[doc(alias = "RestoreCollisionWith")]
    pub fn restore_collision_with(&mut self, geom: GeomId, other: GeomId) -> Result<()> {
        self.set_ignored(geom, other, false)
    }

    fn set_ignored(&mut self, geom: GeomId, other: GeomId, ignored: bool) -> Result<()> {
        let number = self.geoms.get(other).ok_or(Error::StaleId { argument: "other" })?.number;
        let entry = self.geoms.get_mut(geom).ok_or(Error::StaleId { argument: "geom" })?;
        entry.set_ignored(number, ignored);
        // A setter of the geom would mark it as edited, too: the two may now collide.
        self.geom_mut(geom);
        Ok(())
    }

    /// Sets the radius of a disc about the geom's origin whose box is the geom's box, or with `None` makes it the box
    /// of the outline again. For engines that collide true circles, which reach beyond a polygon with the same corners.
    ///
    /// The radius, in length units, may differ from that of the [outline](crate::GeomRef::outline): any polygon may be
    /// the picture of a ball, and a circle may be that of a cylinder.
    ///
    /// # Errors
    /// A stale geom; a radius that is not finite and greater than 0, or with which the box would not be finite.
    pub fn set_box_radius(&mut self, geom: GeomId, radius: Option<f32>) -> Result<()> {
        let body = self.geoms.get(geom).ok_or(Error::StaleId { argument: "geom" })?.body;
        if let Some(radius) = radius.filter(|radius| !(radius.is_finite() && *radius > 0.0)) {
            return Err(Error::invalid("radius", radius, "finite and greater than 0"));
        }
        if radius.is_none() && self.geoms[geom].box_radius.is_none() {
            self.update_edited_geom_transforms(body);
            return Ok(());
        }
        let mut resized = self.geoms[geom].clone();
        resized.set_box_radius(radius);
        check_pose_is_finite("radius", resized, &self.bodies[body])?;
        self.update_edited_geom_transforms(body);
        self.geoms[geom].set_box_radius(radius);
        self.has_new_structure = true;
        Ok(())
    }
}

/// A direction as a unit vector.
pub(crate) fn unit(direction: Vector2) -> Result<Vector2> {
    finite_vector("direction", direction)?;
    let [x, y] = [f64::from(direction.x), f64::from(direction.y)];
    let length = (x * x + y * y).sqrt();
    if length == 0.0 {
        return Err(Error::invalid("direction", (direction.x, direction.y), "longer than 0"));
    }
    Ok(Vector2::new((x / length) as f32, (y / length) as f32))
}

/// Refuses a surface with a number that is not possible.
pub(crate) fn check_surface(surface: SurfaceOptions) -> Result<SurfaceOptions> {
    finite("surface_speed", surface.speed)?;
    zero_or_more("rolling_resistance", surface.rolling_resistance)?;
    Ok(surface)
}
