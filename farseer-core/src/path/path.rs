//! Paths: rows of bodies along a curve (behaviour chapter 14, sections 5 to 7).

use serde::{Deserialize, Serialize};

use super::link::{BodyRow, LinkSettings, LinkType};
use super::walk::place_bodies;
use crate::body::BodyId;
use crate::factories::{BodyFactory, GeomFactory};
use crate::geom::{Geom, GeomId};
use crate::joints::JointId;
use crate::math::Vector2;
use crate::math::finite::{finite, finite_vector};
use crate::methods::CollisionCategory;
use crate::object_id::ObjectId;
use crate::objects::{GeomPlacement, Objects};
use crate::shape::{Aabb, Vertices};
use crate::springs::SpringId;
use crate::{Error, Result};

/// Half a side, in length units, of the box around a control point in which [`Path::point_in_control_point`] finds it.
/// Farseer's value.
const CONTROL_POINT_HALF_SIZE: f32 = 3.0;

/// A row of rectangular bodies along a smooth curve through control points, each linked with the next: chains, ropes,
/// bridges, tracks.
///
/// [`ComplexFactory`](crate::ComplexFactory) makes the usual ones in one call. A path names its objects, which live in
/// the simulator; it is plain data and can be saved beside it.
///
/// ```
/// use farseer_core::{LinkType, Path, PhysicsSimulator, math::Vector2};
///
/// let mut simulator = PhysicsSimulator::default();
/// let mut path = Path::new(20.0, 10.0, 1.0, false)?;
/// for (x, y) in [(0.0, 0.0), (100.0, 50.0), (200.0, 0.0)] {
///     path.add(Vector2::new(x, y))?;
/// }
/// path.update(&mut simulator)?;
/// path.link_bodies(&mut simulator, LinkType::RevoluteJoint, 0.0, 0.0, 0.0, 0.0)?;
/// path.create_geoms(&mut simulator, 1)?;
/// path.add_to_physics_simulator(&mut simulator);
/// assert_eq!(path.joints().len(), path.bodies().len() - 1);
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Path {
    width: f32,
    height: f32,
    link_width: f32,
    mass: f32,
    endless: bool,
    needs_recalculation: bool,
    control_points: Vertices,
    bodies: Vec<BodyId>,
    geoms: Vec<GeomId>,
    joints: Vec<JointId>,
    springs: Vec<SpringId>,
}

/// Constructors.
impl Path {
    /// An empty path of bodies of this size, in length units, which are as far apart as they are wide. If it is endless
    /// the last body is linked with the first.
    ///
    /// # Errors
    /// A number that is not finite.
    #[doc(alias = "Path(float, float, float, bool)")]
    pub fn new(width: f32, height: f32, mass: f32, endless: bool) -> Result<Self> {
        Self::with_link_width(width, height, width, mass, endless)
    }

    /// An empty path of bodies of this size, whose origins are about `link_width` length units apart.
    ///
    /// # Errors
    /// A number that is not finite.
    #[doc(alias = "Path(float, float, float, float, bool)")]
    pub fn with_link_width(
        width: f32,
        height: f32,
        link_width: f32,
        mass: f32,
        endless: bool,
    ) -> Result<Self> {
        Ok(Path {
            width: finite("width", width)?,
            height: finite("height", height)?,
            link_width: finite("link_width", link_width)?,
            mass: finite("mass", mass)?,
            endless,
            needs_recalculation: true,
            control_points: Vertices::new(),
            bodies: Vec::new(),
            geoms: Vec::new(),
            joints: Vec::new(),
            springs: Vec::new(),
        })
    }
}

/// Control points and objects.
impl Path {
    /// The points through which the curve goes, in length units.
    #[doc(alias = "ControlPoints")]
    pub fn control_points(&self) -> &Vertices {
        &self.control_points
    }

    /// The bodies, ordered along the curve.
    #[doc(alias = "Bodies")]
    pub fn bodies(&self) -> &[BodyId] {
        &self.bodies
    }

    /// The geoms in the order in which they were made.
    #[doc(alias = "Geoms")]
    pub fn geoms(&self) -> &[GeomId] {
        &self.geoms
    }

    /// The joints in the order in which they were made.
    #[doc(alias = "Joints")]
    pub fn joints(&self) -> &[JointId] {
        &self.joints
    }

    /// The springs in the order in which they were made.
    #[doc(alias = "Springs")]
    pub fn springs(&self) -> &[SpringId] {
        &self.springs
    }

    /// The list of [`bodies`](Self::bodies), to edit.
    pub fn bodies_mut(&mut self) -> &mut Vec<BodyId> {
        &mut self.bodies
    }

    /// The list of [`geoms`](Self::geoms), to edit.
    pub fn geoms_mut(&mut self) -> &mut Vec<GeomId> {
        &mut self.geoms
    }

    /// The list of [`joints`](Self::joints), to edit.
    pub fn joints_mut(&mut self) -> &mut Vec<JointId> {
        &mut self.joints
    }

    /// The list of [`springs`](Self::springs), to edit.
    pub fn springs_mut(&mut self) -> &mut Vec<SpringId> {
        &mut self.springs
    }

    /// Appends a control point; the next [`update`](Self::update) makes bodies.
    ///
    /// # Errors
    /// A value that is not finite.
    #[doc(alias = "Add(Vector2)")]
    pub fn add(&mut self, control_point: Vector2) -> Result<()> {
        self.control_points.push(finite_vector("control_point", control_point)?);
        self.needs_recalculation = true;
        Ok(())
    }

    /// Appends a body made by the game.
    #[doc(alias = "Add(Body)")]
    pub fn add_body(&mut self, body: BodyId) {
        self.bodies.push(body);
    }

    /// Appends a geom made by the game.
    #[doc(alias = "Add(Geom)")]
    pub fn add_geom(&mut self, geom: GeomId) {
        self.geoms.push(geom);
    }

    /// Appends a joint made by the game.
    #[doc(alias = "Add(Joint)")]
    pub fn add_joint(&mut self, joint: JointId) {
        self.joints.push(joint);
    }

    /// Appends a spring made by the game.
    #[doc(alias = "Add(Spring)")]
    pub fn add_spring(&mut self, spring: SpringId) {
        self.springs.push(spring);
    }

    /// Removes the first control point that is equal to this one, if there is one. Either way the next
    /// [`update`](Self::update) makes bodies.
    #[doc(alias = "Remove(Vector2)")]
    pub fn remove(&mut self, control_point: Vector2) {
        if let Some(index) = self.control_points.iter().position(|&point| point == control_point) {
            self.control_points.remove(index);
        }
        self.needs_recalculation = true;
    }

    /// Removes a control point; the next [`update`](Self::update) makes bodies.
    ///
    /// # Errors
    /// An index that is not less than the number of control points.
    #[doc(alias = "Remove(int)")]
    pub fn remove_at(&mut self, index: usize) -> Result<()> {
        self.check(index)?;
        self.control_points.remove(index);
        self.needs_recalculation = true;
        Ok(())
    }

    /// Moves a control point; the next [`update`](Self::update) makes bodies.
    ///
    /// # Errors
    /// A value that is not finite; an index that is not less than the number of control points.
    #[doc(alias = "MoveControlPoint")]
    pub fn move_control_point(&mut self, position: Vector2, index: usize) -> Result<()> {
        self.check(index)?;
        self.control_points[index] = finite_vector("position", position)?;
        self.needs_recalculation = true;
        Ok(())
    }

    fn check(&self, index: usize) -> Result<()> {
        if index < self.control_points.len() {
            Ok(())
        } else {
            Err(Error::invalid("index", index, "less than the number of control points"))
        }
    }

    /// The index of the first control point within 3 length units along x and along y; for editors.
    #[doc(alias = "PointInControlPoint")]
    pub fn point_in_control_point(&self, point: Vector2) -> Option<usize> {
        let reach = Vector2::new(CONTROL_POINT_HALF_SIZE, CONTROL_POINT_HALF_SIZE);
        let holds_point = |&control_point: &Vector2| {
            Aabb::new(control_point - reach, control_point + reach).contains(point)
        };
        self.control_points.iter().position(holds_point)
    }
}

/// Operations on a simulator.
impl Path {
    /// Makes the bodies, if control points have changed since the last call. They are in the simulator, but take no
    /// part before they are [added](Self::add_to_physics_simulator).
    ///
    /// As in the original bodies of earlier calls stay and a complete second row is appended. The last control point is
    /// moved to the last point that was evaluated, which may lie before the end. On an exactly vertical section bodies
    /// are not turned.
    ///
    /// # Errors
    /// No control points; control points too far apart for finite arithmetic; a width, height or mass that is not
    /// greater than 0. Numbers with which the original loops forever: a link width that is not greater than 0, or
    /// greater than the distance that the path reaches from its first control point.
    #[doc(alias = "Update")]
    pub fn update(&mut self, simulator: &mut Objects) -> Result<()> {
        if !self.needs_recalculation {
            return Ok(());
        }
        let row = place_bodies(&self.control_points, self.link_width)?;
        let model = BodyFactory::create_rectangle_body(self.width, self.height, self.mass)?;
        for (position, rotation) in row.poses {
            let mut body = model.clone();
            body.set_position(position);
            body.set_rotation(rotation);
            self.bodies.push(simulator.create_body(body));
        }
        if let Some(last) = self.control_points.last_mut() {
            *last = row.end;
        }
        self.needs_recalculation = false;
        Ok(())
    }

    /// [`link_bodies_with`](Self::link_bodies_with) a rest length factor of 1.
    ///
    /// # Errors
    /// As there.
    #[doc(alias = "LinkBodies")]
    pub fn link_bodies(
        &mut self,
        simulator: &mut Objects,
        link_type: LinkType,
        min: f32,
        max: f32,
        spring_constant: f32,
        damping_constant: f32,
    ) -> Result<()> {
        self.link_bodies_with(simulator, link_type, min, max, spring_constant, damping_constant, 1.0)
    }

    /// Links every body with the next, and the last with the first if the path is endless. `min` and `max` are the
    /// range of slider joints in length units. The other arguments are for springs: stiffness in mass units/s², damping
    /// in mass units/s, and a factor of the rest length.
    ///
    /// As in the original the length of a pin, and the rest length of a spring, is the width of a body from the second
    /// link on: such a chain stretches when it is simulated. The link before is looked up by its index in
    /// [`joints`](Self::joints) or [`springs`](Self::springs), so link the bodies before adding others.
    ///
    /// # Errors
    /// A stale body; a number that is not finite; an endless path without bodies; an object other than a pin joint or
    /// linear spring where the link before is looked up.
    #[doc(alias = "LinkBodies")]
    #[allow(clippy::too_many_arguments)] // The original's signature.
    pub fn link_bodies_with(
        &mut self,
        simulator: &mut Objects,
        link_type: LinkType,
        min: f32,
        max: f32,
        spring_constant: f32,
        damping_constant: f32,
        spring_rest_length_factor: f32,
    ) -> Result<()> {
        let links = LinkSettings {
            link_type,
            min,
            max,
            spring_constant,
            damping_constant,
            spring_rest_length_factor,
        };
        self.link(simulator, &links)
    }

    pub(crate) fn link(&mut self, simulator: &mut Objects, links: &LinkSettings) -> Result<()> {
        let row = BodyRow {
            simulator,
            bodies: &self.bodies,
            joints: &self.joints,
            springs: &self.springs,
            width: self.width,
            endless: self.endless,
        };
        let linked = links.make(row)?;
        for joint in linked.joints {
            self.joints.push(simulator.create_joint(joint)?);
        }
        for spring in linked.springs {
            self.springs.push(simulator.create_spring(spring)?);
        }
        Ok(())
    }

    /// Makes a rectangle geom for every body, all in one collision group. A second call makes a second set.
    ///
    /// # Errors
    /// A stale body; a width or height that is not greater than 0.
    #[doc(alias = "CreateGeoms(int)")]
    pub fn create_geoms(&mut self, simulator: &mut Objects, collision_group: i32) -> Result<()> {
        self.create_geoms_and(simulator, |geom| geom.set_collision_group(collision_group))
    }

    /// [`create_geoms`](Self::create_geoms), and adds **all** geoms of the path to the simulator.
    ///
    /// # Errors
    /// As there.
    #[doc(alias = "CreateGeoms(PhysicsSimulator, int)")]
    pub fn create_geoms_in(&mut self, simulator: &mut Objects, collision_group: i32) -> Result<()> {
        self.create_geoms(simulator, collision_group)?;
        self.add_geoms(simulator);
        Ok(())
    }

    /// Makes a rectangle geom for every body, all with these categories. A second call makes a second set.
    ///
    /// # Errors
    /// As [`create_geoms`](Self::create_geoms).
    #[doc(alias = "CreateGeoms(CollisionCategory, CollisionCategory)")]
    pub fn create_geoms_with_categories(
        &mut self,
        simulator: &mut Objects,
        collision_categories: CollisionCategory,
        collides_with: CollisionCategory,
    ) -> Result<()> {
        self.create_geoms_and(simulator, |geom| {
            geom.set_collision_categories(collision_categories);
            geom.set_collides_with(collides_with);
        })
    }

    /// [`create_geoms_with_categories`](Self::create_geoms_with_categories), and adds **all** geoms of the path to the
    /// simulator.
    ///
    /// # Errors
    /// As [`create_geoms`](Self::create_geoms).
    #[doc(alias = "CreateGeoms(CollisionCategory, CollisionCategory, PhysicsSimulator)")]
    pub fn create_geoms_with_categories_in(
        &mut self,
        simulator: &mut Objects,
        collision_categories: CollisionCategory,
        collides_with: CollisionCategory,
    ) -> Result<()> {
        self.create_geoms_with_categories(simulator, collision_categories, collides_with)?;
        self.add_geoms(simulator);
        Ok(())
    }

    fn create_geoms_and(&mut self, simulator: &mut Objects, set: impl Fn(&mut Geom)) -> Result<()> {
        if self.bodies.iter().any(|&body| simulator.body(body).is_none()) {
            return Err(Error::StaleId { argument: "bodies" });
        }
        let before = self.geoms.len();
        for &body in &self.bodies {
            let placement = GeomPlacement::default();
            match GeomFactory::create_rectangle_geom(simulator, body, self.width, self.height, placement) {
                Ok(geom) => {
                    set(&mut simulator[geom]);
                    self.geoms.push(geom);
                }
                Err(error) => {
                    simulator.discard(self.geoms.drain(before..).map(ObjectId::from));
                    return Err(error);
                }
            }
        }
        Ok(())
    }

    fn add_geoms(&self, simulator: &mut Objects) {
        for &geom in &self.geoms {
            // Disposed geoms are skipped.
            simulator.add(geom).ok();
        }
    }

    /// Adds all bodies, geoms, joints and springs: they take part from the next update on. Disposed objects are
    /// skipped.
    #[doc(alias = "AddToPhysicsSimulator")]
    pub fn add_to_physics_simulator(&self, simulator: &mut Objects) {
        for object in self.objects() {
            simulator.add(object).ok();
        }
    }

    /// Removes all bodies, geoms, joints and springs from the simulation with the next update. Disposed objects are
    /// skipped.
    #[doc(alias = "RemoveFromPhysicsSimulator")]
    pub fn remove_from_physics_simulator(&self, simulator: &mut Objects) {
        for object in self.objects() {
            simulator.remove(object).ok();
        }
    }

    /// All objects of the path, in the order in which they are added and removed.
    pub(crate) fn objects(&self) -> impl DoubleEndedIterator<Item = ObjectId> + '_ {
        let bodies = self.bodies.iter().map(|&body| ObjectId::from(body));
        let geoms = self.geoms.iter().map(|&geom| ObjectId::from(geom));
        let joints = self.joints.iter().map(|&joint| ObjectId::from(joint));
        let springs = self.springs.iter().map(|&spring| ObjectId::from(spring));
        bodies.chain(geoms).chain(joints).chain(springs)
    }
}
