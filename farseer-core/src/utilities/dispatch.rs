//! Handlers of single objects, in place of the original's events.

use super::secondary_map::{MapId, SecondaryMap};
use crate::body::BodyId;
use crate::contacts::Contact;
use crate::controllers::ControllerId;
use crate::geom::GeomId;
use crate::joints::JointId;
use crate::objects::Objects;
use crate::shape::Vertices;
use crate::simulator::{Context, EventHandler, UserController};
use crate::springs::SpringId;

/// Called when a geom touches another: as [`EventHandler::on_collision`], with the game first.
pub type CollisionHandler<G> = fn(&mut G, &mut Context<'_>, GeomId, GeomId, &mut Vec<Contact>) -> bool;
/// Called when a geom separates from another: as [`EventHandler::on_separation`], with the game first.
pub type SeparationHandler<G> = fn(&mut G, &mut Context<'_>, GeomId, GeomId);
/// Called for an event of a body, joint or spring, with the game first.
pub type ObjectHandler<G, I> = fn(&mut G, &mut Context<'_>, I);
/// Called when a geom enters a fluid: as [`EventHandler::on_fluid_entry`], with the game first.
pub type FluidHandler<G> = fn(&mut G, &mut Context<'_>, ControllerId, GeomId, &Vertices);

/// Update of a controller of the game's own: as [`UserController::update`], with the game first. The two numbers are
/// the step and the real time, in seconds.
pub type ControllerHandler<G> = fn(&mut G, &mut Context<'_>, ControllerId, f32, f32);

/// Id of one subscription of a [`Dispatch`], for ending it by [`Dispatch::off`]. A dispatch never gives an id out
/// twice.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Subscription(u64);

/// Handlers of single geoms, bodies, joints, springs and controllers, in place of C#'s `geom.OnCollision += handler`: a
/// game subscribes its functions, and an update calls those of the objects concerned. Ours: the original has events.
///
/// Handlers are plain functions with the game `G` as an argument; they capture no state. Several handlers of one object
/// are called in the order of their subscription. All collision handlers are called, and the result of the last one
/// counts, as with C#'s events. A handler cannot subscribe others while an update runs: it stores in the game the
/// subscriptions to be made afterwards.
///
/// Objects without a handler cost a lookup per callback; a geom whose
/// [callbacks](crate::Geom::set_collision_callbacks_enabled) are switched off costs nothing. No call allocates.
/// Handlers of disposed objects are never called again; [`forget_disposed`](Self::forget_disposed) frees their memory.
///
/// A game that needs more, such as fluid containers of its own or callbacks of the broad phase, implements
/// [`EventHandler`]. Its methods may call those of [`with`](Self::with): all methods to whose events the game
/// subscribes, since the dispatch is not called otherwise.
///
/// ```
/// use farseer_core::{BodyFactory, Dispatch, GeomFactory, GeomPlacement, PhysicsSimulator, math::Vector2};
///
/// #[derive(Default)]
/// struct Game { bumps: u32 }
///
/// let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 100.0))?;
/// let floor = BodyFactory::create_rectangle_body_in(&mut simulator, 100.0, 10.0, 1.0)?;
/// simulator[floor].set_is_static(true);
/// let ground = GeomFactory::create_rectangle_geom_in(&mut simulator, floor, 100.0, 10.0, GeomPlacement::default())?;
/// let ball = BodyFactory::create_circle_body_in(&mut simulator, 5.0, 1.0)?;
/// simulator[ball].set_position(Vector2::new(0.0, -11.0));
/// GeomFactory::create_circle_geom_in(&mut simulator, ball, 5.0, 16, GeomPlacement::default())?;
///
/// let mut game = Game::default();
/// let mut dispatch = Dispatch::new();
/// let bump = dispatch.on_collision(ground, |game: &mut Game, context, _, other, _| {
///     game.bumps += 1;
///     if let Some(body) = context.body_of(other) {
///         context[body].set_linear_velocity(Vector2::new(0.0, -80.0));
///     }
///     true
/// });
/// (0..100).for_each(|_| simulator.update_with(0.01, &mut dispatch.with(&mut game)));
/// assert_eq!(game.bumps, 1);
///
/// assert!(dispatch.off(bump));
/// (0..200).for_each(|_| simulator.update_with(0.01, &mut dispatch.with(&mut game)));
/// assert_eq!(game.bumps, 1, "it lies on the floor, and nobody counts");
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Dispatch<G> {
    last: u64,
    collisions: Handlers<GeomId, CollisionHandler<G>>,
    separations: Handlers<GeomId, SeparationHandler<G>>,
    bodies_updated: Handlers<BodyId, ObjectHandler<G, BodyId>>,
    bodies_disposed: Handlers<BodyId, ObjectHandler<G, BodyId>>,
    joints_broken: Handlers<JointId, ObjectHandler<G, JointId>>,
    springs_broken: Handlers<SpringId, ObjectHandler<G, SpringId>>,
    joints_updated: Handlers<JointId, ObjectHandler<G, JointId>>,
    springs_updated: Handlers<SpringId, ObjectHandler<G, SpringId>>,
    fluid_entries: Handlers<ControllerId, FluidHandler<G>>,
    controllers: Handlers<ControllerId, ControllerHandler<G>>,
}

impl<G> Default for Dispatch<G> {
    fn default() -> Self {
        Dispatch {
            last: 0,
            collisions: Handlers::default(),
            separations: Handlers::default(),
            bodies_updated: Handlers::default(),
            bodies_disposed: Handlers::default(),
            joints_broken: Handlers::default(),
            springs_broken: Handlers::default(),
            joints_updated: Handlers::default(),
            springs_updated: Handlers::default(),
            fluid_entries: Handlers::default(),
            controllers: Handlers::default(),
        }
    }
}

/// Defines a subscribing method for each event.
macro_rules! subscriptions {
    ($($(#[$doc:meta])* $on:ident($list:ident, $id:ident: $of:ty, $handler:ty);)*) => {
        impl<G> Dispatch<G> {
            $(
                $(#[$doc])*
                pub fn $on(&mut self, $id: $of, handler: $handler) -> Subscription {
                    self.last += 1;
                    self.$list.add($id, Subscription(self.last), handler)
                }
            )*

            /// Ends a subscription. Returns whether there was one.
            #[doc(alias = "-=")]
            pub fn off(&mut self, subscription: Subscription) -> bool {
                false $(|| self.$list.end(subscription))*
            }

            /// Removes the handlers of objects that were disposed, or will be removed with the next update.
            pub fn forget_disposed(&mut self, objects: &Objects) {
                $(self.$list.of.forget_disposed(objects);)*
            }

            /// Ends all subscriptions.
            pub fn clear(&mut self) {
                $(self.$list.of.clear();)*
            }
        }
    };
}

subscriptions! {
    /// Calls a handler whenever this geom touches another: see [`EventHandler::on_collision`].
    #[doc(alias("OnCollision", "CollisionEventHandler", "+="))]
    on_collision(collisions, geom: GeomId, CollisionHandler<G>);
    /// Calls a handler whenever this geom separates from another: see [`EventHandler::on_separation`].
    #[doc(alias("OnSeparation", "SeparationEventHandler"))]
    on_separation(separations, geom: GeomId, SeparationHandler<G>);
    /// Calls a handler whenever this body has moved: see [`Event::BodyUpdated`](crate::Event::BodyUpdated).
    #[doc(alias("Updated", "UpdatedEventHandler"))]
    on_body_updated(bodies_updated, body: BodyId, ObjectHandler<G, BodyId>);
    /// Calls a handler when this body is disposed: see [`Event::BodyDisposed`](crate::Event::BodyDisposed).
    #[doc(alias = "Disposed")]
    on_body_disposed(bodies_disposed, body: BodyId, ObjectHandler<G, BodyId>);
    /// Calls a handler when this joint breaks: see [`EventHandler::on_joint_broke`].
    #[doc(alias = "Joint.Broke")]
    on_joint_broke(joints_broken, joint: JointId, ObjectHandler<G, JointId>);
    /// Calls a handler when this spring breaks: see [`EventHandler::on_spring_broke`].
    #[doc(alias = "Spring.Broke")]
    on_spring_broke(springs_broken, spring: SpringId, ObjectHandler<G, SpringId>);
    /// Calls a handler whenever this joint has applied an impulse, several times per update: see
    /// [`EventHandler::on_joint_updated`].
    #[doc(alias("JointUpdated", "JointDelegate"))]
    on_joint_updated(joints_updated, joint: JointId, ObjectHandler<G, JointId>);
    /// Calls a handler whenever this spring has applied a force or torque: see [`EventHandler::on_spring_updated`].
    #[doc(alias("SpringUpdated", "SpringDelegate"))]
    on_spring_updated(springs_updated, spring: SpringId, ObjectHandler<G, SpringId>);
    /// Calls a handler when a geom enters the fluid of this controller: see [`EventHandler::on_fluid_entry`].
    #[doc(alias("Entry", "EntryEventHandler"))]
    on_fluid_entry(fluid_entries, controller: ControllerId, FluidHandler<G>);
    /// Calls a handler in every update of this [user-defined](crate::Controller::user_defined) controller: see
    /// [`UserController::update`]. Its state is in the game.
    #[doc(alias("Controller", "Update"))]
    on_controller_update(controllers, controller: ControllerId, ControllerHandler<G>);
}

impl<G> Dispatch<G> {
    /// A dispatch without subscriptions.
    pub fn new() -> Self {
        Self::default()
    }

    /// The dispatch with the game, as the handler of an update: `simulator.update_with(dt, &mut dispatch.with(&mut
    /// game))`.
    pub fn with<'a>(&'a self, game: &'a mut G) -> Dispatched<'a, G> {
        Dispatched { dispatch: self, game }
    }
}

/// A [`Dispatch`] and the game whose functions it calls.
#[derive(Debug)]
pub struct Dispatched<'a, G> {
    dispatch: &'a Dispatch<G>,
    game: &'a mut G,
}

impl<G> EventHandler for Dispatched<'_, G> {
    fn on_collision(
        &mut self,
        context: &mut Context<'_>,
        this: GeomId,
        other: GeomId,
        contacts: &mut Vec<Contact>,
    ) -> bool {
        let handlers = self.dispatch.collisions.of(this);
        handlers.fold(true, |_, handler| handler(self.game, context, this, other, contacts))
    }

    fn on_separation(&mut self, context: &mut Context<'_>, this: GeomId, other: GeomId) {
        self.dispatch.separations.of(this).for_each(|handler| handler(self.game, context, this, other));
    }

    fn on_body_updated(&mut self, context: &mut Context<'_>, body: BodyId) {
        self.dispatch.bodies_updated.of(body).for_each(|handler| handler(self.game, context, body));
    }

    fn on_body_disposed(&mut self, context: &mut Context<'_>, body: BodyId) {
        self.dispatch.bodies_disposed.of(body).for_each(|handler| handler(self.game, context, body));
    }

    fn on_joint_broke(&mut self, context: &mut Context<'_>, joint: JointId) {
        self.dispatch.joints_broken.of(joint).for_each(|handler| handler(self.game, context, joint));
    }

    fn on_spring_broke(&mut self, context: &mut Context<'_>, spring: SpringId) {
        self.dispatch.springs_broken.of(spring).for_each(|handler| handler(self.game, context, spring));
    }

    fn handles_joint_updates(&self) -> bool {
        self.dispatch.joints_updated.are_used
    }

    fn on_joint_updated(&mut self, context: &mut Context<'_>, joint: JointId) {
        self.dispatch.joints_updated.of(joint).for_each(|handler| handler(self.game, context, joint));
    }

    fn handles_spring_updates(&self) -> bool {
        self.dispatch.springs_updated.are_used
    }

    fn on_spring_updated(&mut self, context: &mut Context<'_>, spring: SpringId) {
        self.dispatch.springs_updated.of(spring).for_each(|handler| handler(self.game, context, spring));
    }

    fn on_fluid_entry(
        &mut self,
        context: &mut Context<'_>,
        controller: ControllerId,
        geom: GeomId,
        vertices: &Vertices,
    ) {
        let handlers = self.dispatch.fluid_entries.of(controller);
        handlers.for_each(|handler| handler(self.game, context, controller, geom, vertices));
    }

    fn user_controller(&mut self, controller: ControllerId) -> Option<&mut dyn UserController> {
        let is_known = self.dispatch.controllers.of(controller).next().is_some();
        is_known.then_some(self as &mut dyn UserController)
    }
}

/// Acts as every controller that has a subscription.
impl<G> UserController for Dispatched<'_, G> {
    fn update(&mut self, context: &mut Context<'_>, controller: ControllerId, dt: f32, dt_real: f32) {
        let handlers = self.dispatch.controllers.of(controller);
        handlers.for_each(|handler| handler(self.game, context, controller, dt, dt_real));
    }
}

/// The handlers of one event, in the order in which they were subscribed.
#[derive(Debug, Clone)]
struct Handlers<I, H> {
    of: SecondaryMap<I, Vec<(Subscription, H)>>,
    /// Whether there has ever been one: the most frequent callbacks test this flag alone.
    are_used: bool,
}

impl<I, H> Default for Handlers<I, H> {
    fn default() -> Self {
        Handlers { of: SecondaryMap::default(), are_used: false }
    }
}

impl<I: MapId, H: Copy> Handlers<I, H> {
    fn add(&mut self, id: I, subscription: Subscription, handler: H) -> Subscription {
        self.are_used = true;
        self.of.get_or_default(id).push((subscription, handler));
        subscription
    }

    fn end(&mut self, subscription: Subscription) -> bool {
        let mut lists = self.of.iter_mut().map(|(_, list)| list);
        lists.any(|list| {
            let at = list.iter().position(|&(of, _)| of == subscription);
            at.map(|at| list.remove(at)).is_some()
        })
    }

    #[inline]
    fn of(&self, id: I) -> impl Iterator<Item = H> + '_ {
        self.of.get(id).into_iter().flatten().map(|&(_, handler)| handler)
    }
}
