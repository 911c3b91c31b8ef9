//! The objects of a simulator (behaviour chapters 04, section 2, and 05, section 3), independent of the stages of an
//! update.

mod controllers;
mod creating;
mod editing;
mod farseer_queries;
mod geom_transforms;
mod joints;
mod lifecycle;
mod ray_cast;
mod save;
mod save_moving;
mod springs;
mod typed_ids;

use crate::body::entry::Bodies;
use crate::body::{Body, BodyId};
use crate::controllers::{Controller, ControllerId};
use crate::geom::entry::Geoms;
use crate::geom::grid_cache::GridCache;
use crate::geom::view::GeomRef;
use crate::geom::{Geom, GeomId};
use crate::joints::{Joint, JointId};
use crate::limits::Limits;
use crate::methods::Methods;
use crate::report::PendingEvent;
use crate::springs::{Spring, SpringId};
use crate::storage::arena::stale;
use crate::storage::collection::Collection;
use farseer_precise::reusing_clone;

pub use creating::GeomPlacement;
pub(crate) use editing::{check_surface, unit};
pub use farseer_queries::GeomPointPair;
pub(crate) use geom_transforms::TransformUpdate;
pub use ray_cast::RayCastHit;
pub(crate) use ray_cast::{Ray, is_query_box, ray_segment};
pub(crate) use save::SavedObjects;
pub(crate) use save_moving::{LoadedMovingObjects, MovingObjectsView};
pub use typed_ids::{TypedJointId, TypedSpringId};

/// The bodies, geoms, joints, springs and controllers of a simulator, and all operations on them between updates and in
/// callbacks. [`PhysicsSimulator`](crate::PhysicsSimulator) and [`Context`](crate::Context) deref to this type, so that
/// a function with an argument `&mut Objects` can be called from both sides:
///
/// ```
/// use farseer_core::math::Vector2;
/// use farseer_core::{Body, BodyId, Context, Contact, EventHandler, GeomId, Objects, PhysicsSimulator};
///
/// fn reset(objects: &mut Objects, ball: BodyId) {
///     objects[ball].set_position(Vector2::new(0.0, -50.0));
/// }
///
/// struct Pit(BodyId);
/// impl EventHandler for Pit {
///     fn on_collision(&mut self, context: &mut Context, _: GeomId, _: GeomId, _: &mut Vec<Contact>) -> bool {
///         reset(context, self.0);
///         true
///     }
/// }
///
/// let mut simulator = PhysicsSimulator::default();
/// let ball = simulator.create_body(Body::new());
/// reset(&mut simulator, ball);
/// assert_eq!(simulator[ball].position().y, -50.0);
/// ```
///
/// Objects live here and are named by ids. Their lifecycle is that of the original. A *created* object exists but takes
/// no part. An *added* one takes part from the next update on. A *removed* one takes no part any more, and may be added
/// again. The id of a *disposed* one goes stale with the next update.
///
/// Ids belong to one simulator: if the `Objects` of two are swapped, updates fail. So `Objects` can be neither made nor
/// loaded without a simulator:
///
/// ```compile_fail
/// let objects = farseer_core::Objects::default();
/// ```
/// ```compile_fail
/// let objects: farseer_core::Objects = postcard::from_bytes(&[])?;
/// # Ok::<(), postcard::Error>(())
/// ```
#[derive(Debug)]
pub struct Objects {
    pub(crate) bodies: Bodies,
    pub(crate) geoms: Geoms,
    pub(crate) controllers: Collection<Controller, ControllerId>,
    pub(crate) joints: Collection<Joint, JointId>,
    pub(crate) springs: Collection<Spring, SpringId>,
    next_geom_number: u32,
    /// Bodies and geoms that the game has borrowed mutably since edits were last applied.
    pub(crate) touched_bodies: Vec<BodyId>,
    pub(crate) touched_geoms: Vec<GeomId>,
    /// Events to report: those since the last update, or since the last moment when no callback was running.
    pub(crate) pending: Vec<PendingEvent>,
    /// The chosen methods: geoms are prepared for them, queries and updates use them.
    pub(crate) methods: Methods,
    /// Whether bodies or geoms have entered or left their lists; `has_new_structure`: whether others have changed
    /// without being borrowed.
    pub(crate) has_new_members: bool,
    /// The bodies and geoms that have entered or left their lists since `has_new_members` was last cleared. Not saved.
    pub(crate) new_members: NewMembers,
    pub(crate) has_new_structure: bool,
    /// Whether the game has borrowed joints mutably since this flag was last cleared.
    pub(crate) has_edited_joints: bool,
    /// Whether motors or limits of joints have been added or removed since this flag was last cleared.
    pub(crate) has_edited_drives: bool,
    /// Pairs of bodies that do not collide because of a joint between them, as the precise set knows them. Sorted, with the
    /// smaller id of a pair first.
    pub(crate) separated_bodies: Vec<(BodyId, BodyId)>,
    /// Not saved: a save cannot raise the limits.
    limits: Limits,
    grids: GridCache,
}

reusing_clone! {
    Objects {
        bodies, geoms, controllers, joints, springs, next_geom_number, touched_bodies,
        touched_geoms, pending, methods, has_new_members, new_members, has_new_structure, has_edited_joints, has_edited_drives, separated_bodies, limits, grids
    }
}

/// Bodies and geoms that have entered or left their lists, in the order in which they did, perhaps more than once.
#[derive(Debug, Default)]
pub(crate) struct NewMembers {
    pub(crate) bodies: Vec<BodyId>,
    pub(crate) geoms: Vec<GeomId>,
}

reusing_clone! { NewMembers { bodies, geoms } }

impl NewMembers {
    /// Forgets all.
    pub(crate) fn clear(&mut self) {
        self.bodies.clear();
        self.geoms.clear();
    }
}

impl Objects {
    /// No objects at all. Not a public default: ids belong to one simulator.
    pub(crate) fn empty() -> Self {
        Objects {
            bodies: Collection::default(),
            geoms: Collection::default(),
            controllers: Collection::default(),
            joints: Collection::default(),
            springs: Collection::default(),
            next_geom_number: 0,
            touched_bodies: Vec::new(),
            touched_geoms: Vec::new(),
            pending: Vec::new(),
            methods: Methods::default(),
            has_new_members: false,
            new_members: NewMembers::default(),
            has_new_structure: false,
            has_edited_joints: false,
            has_edited_drives: false,
            separated_bodies: Vec::new(),
            limits: Limits::default(),
            grids: GridCache::default(),
        }
    }
}

/// Access to objects.
impl Objects {
    /// A body, unless the id is stale.
    #[inline]
    pub fn body(&self, body: BodyId) -> Option<&Body> {
        self.bodies.get(body).map(|entry| &entry.body)
    }

    /// A body to edit, unless the id is stale. Its geoms are updated when it is moved.
    #[inline]
    pub fn body_mut(&mut self, body: BodyId) -> Option<&mut Body> {
        let entry = self.bodies.get_mut(body)?;
        if !entry.is_touched {
            entry.is_touched = true;
            self.touched_bodies.push(body);
        }
        Some(&mut entry.body)
    }

    /// A geom in the world, unless the id is stale.
    #[inline]
    pub fn geom(&self, geom: GeomId) -> Option<GeomRef<'_>> {
        let entry = self.geoms.get(geom)?;
        Some(GeomRef { entry, life: self.geoms.lifecycle_state(geom)?, body: self.bodies.get(entry.body) })
    }

    /// The settings of a geom to edit, unless the id is stale.
    #[inline]
    pub fn geom_mut(&mut self, geom: GeomId) -> Option<&mut Geom> {
        let entry = self.geoms.get_mut(geom)?;
        if !entry.is_touched {
            entry.is_touched = true;
            self.touched_geoms.push(geom);
        }
        Some(&mut entry.geom)
    }

    /// Calls `act` with each body that takes part, in the order in which they were added: the original's loop over
    /// `BodyList`. Bodies that were disposed since the last update are included.
    ///
    /// ```
    /// use farseer_core::{BodyFactory, PhysicsSimulator};
    /// let mut simulator = PhysicsSimulator::default();
    /// let ball = BodyFactory::create_circle_body_in(&mut simulator, 10.0, 1.0)?;
    /// simulator.update(0.01);
    /// simulator.for_each_body_mut(|_, body| body.set_ignore_gravity(true));
    /// assert!(simulator[ball].ignore_gravity());
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    #[doc(alias = "BodyList.ForEach")]
    pub fn for_each_body_mut(&mut self, mut act: impl FnMut(BodyId, &mut Body)) {
        for at in 0..self.bodies.list().len() {
            let id = self.bodies.list()[at];
            if let Some(body) = self.body_mut(id) {
                act(id, body);
            }
        }
    }

    /// The geoms of a body, in the order in which they were attached; none if the id is stale.
    pub fn geoms_of(&self, body: BodyId) -> &[GeomId] {
        self.bodies.get(body).map_or(&[], |entry| &entry.geoms)
    }

    /// The bodies that take part, in the order in which they were added.
    #[doc(alias = "BodyList")]
    pub fn body_list(&self) -> &[BodyId] {
        self.bodies.list()
    }

    /// The geoms that take part, in the order in which they were added.
    #[doc(alias = "GeomList")]
    pub fn geom_list(&self) -> &[GeomId] {
        self.geoms.list()
    }

    /// All existing bodies, in their lists or not, in the order of their [slots](BodyId::slot).
    pub fn bodies(&self) -> impl Iterator<Item = BodyId> + '_ {
        self.bodies.iter().map(|(id, _)| id)
    }

    /// All existing geoms, in their lists or not, in the order of their [slots](GeomId::slot).
    pub fn geoms(&self) -> impl Iterator<Item = GeomId> + '_ {
        self.geoms.iter().map(|(id, _)| id)
    }

    /// The body of a geom, unless the id is stale.
    pub fn body_of(&self, geom: GeomId) -> Option<BodyId> {
        self.geoms.get(geom).map(|entry| entry.body)
    }

    /// Whether an object was edited, or events are pending.
    #[inline]
    pub(crate) fn has_edits(&self) -> bool {
        !(self.touched_bodies.is_empty() && self.touched_geoms.is_empty() && self.pending.is_empty())
    }

    /// The limits of what this simulator may cost.
    pub fn limits(&self) -> Limits {
        self.limits
    }

    /// Sets the limits of what this simulator may cost. Existing objects stay, whatever they cost. Clones have the same
    /// limits. [`clear`](crate::PhysicsSimulator::clear) and [`restore`](crate::PhysicsSimulator::restore) keep them,
    /// and `restore` applies them to the restored objects.
    pub fn set_limits(&mut self, limits: Limits) {
        self.limits = limits;
    }
}

impl std::ops::Index<BodyId> for Objects {
    type Output = Body;
    /// # Panics
    /// If the id is stale; see [`Objects::body`].
    #[inline]
    fn index(&self, body: BodyId) -> &Body {
        &self.bodies[body].body
    }
}

impl std::ops::IndexMut<BodyId> for Objects {
    /// # Panics
    /// If the id is stale; see [`Objects::body_mut`].
    #[inline]
    fn index_mut(&mut self, body: BodyId) -> &mut Body {
        self.body_mut(body).unwrap_or_else(|| stale(body))
    }
}

impl std::ops::Index<GeomId> for Objects {
    type Output = Geom;
    /// # Panics
    /// If the id is stale; see [`Objects::geom`].
    #[inline]
    fn index(&self, geom: GeomId) -> &Geom {
        &self.geoms[geom].geom
    }
}

impl std::ops::IndexMut<GeomId> for Objects {
    /// # Panics
    /// If the id is stale; see [`Objects::geom_mut`].
    #[inline]
    fn index_mut(&mut self, geom: GeomId) -> &mut Geom {
        self.geom_mut(geom).unwrap_or_else(|| stale(geom))
    }
}
