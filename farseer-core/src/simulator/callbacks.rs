//! Calls of the game's handler: the only place where a game is called.

#[cfg(feature = "space")]
use super::depth::DepthHandler;
use super::{Context, EventHandler, PhysicsSimulator};
use crate::geom::GeomId;
use crate::object_id::ObjectId;
use crate::report::{Event, PendingEvent, Report};

/// The handler of an update, if there is one.
pub(crate) enum Handler<'h> {
    None,
    Game(&'h mut dyn EventHandler),
    /// The handler of an engine with depth, which has callbacks of its own.
    #[cfg(feature = "space")]
    Depth(&'h mut dyn DepthHandler),
}

impl<'h> Handler<'h> {
    pub(crate) fn new(handler: Option<&'h mut dyn EventHandler>) -> Self {
        handler.map_or(Handler::None, Handler::Game)
    }

    /// The handler of an engine with depth.
    #[cfg(feature = "space")]
    pub(super) fn of_depth(handler: Option<&'h mut dyn DepthHandler>) -> Self {
        handler.map_or(Handler::None, Handler::Depth)
    }

    /// No handler.
    pub(crate) fn none() -> Self {
        Handler::None
    }

    #[inline]
    pub(crate) fn get(&mut self) -> Option<&mut (dyn EventHandler + 'h)> {
        match self {
            Handler::None => None,
            Handler::Game(handler) => Some(&mut **handler),
            #[cfg(feature = "space")]
            Handler::Depth(handler) => Some(&mut **handler),
        }
    }

    /// Whether there is a handler for which `what` is true.
    pub(crate) fn wants(&self, what: impl FnOnce(&dyn EventHandler) -> bool) -> bool {
        match self {
            Handler::None => false,
            Handler::Game(handler) => what(&**handler),
            #[cfg(feature = "space")]
            Handler::Depth(handler) => what(&**handler),
        }
    }

    /// The same with a shorter lifetime.
    pub(crate) fn reborrow(&mut self) -> Handler<'_> {
        match self {
            Handler::None => Handler::None,
            Handler::Game(handler) => Handler::Game(&mut **handler),
            #[cfg(feature = "space")]
            Handler::Depth(handler) => Handler::Depth(&mut **handler),
        }
    }
}

/// Callbacks of an engine with depth.
#[cfg(feature = "space")]
impl PhysicsSimulator {
    /// Asks about the touching pairs. A pair that the handler refuses exerts no impulse in this update.
    pub(super) fn ask_about_depth_contacts(&mut self, handler: &mut Handler<'_>) {
        let Handler::Depth(asked) = handler else { return };
        let refused = asked.on_contacts(&mut self.context());
        self.apply_edits(handler);
        if let Some(precise) = &mut self.pipeline.precise {
            refused.into_iter().for_each(|pair| precise.disable_contact(pair));
        }
    }

    /// Reports that bodies have moved.
    pub(super) fn report_depth_moved(&mut self, handler: &mut Handler<'_>) {
        let Handler::Depth(told) = handler else { return };
        told.on_moved(&mut self.context());
        self.apply_edits(handler);
    }
}

impl PhysicsSimulator {
    /// Calls the handler, if there is one, and applies its edits.
    #[inline]
    pub(super) fn call_handler<T>(
        &mut self,
        handler: &mut Handler<'_>,
        call: impl FnOnce(&mut dyn EventHandler, &mut Context<'_>) -> T,
    ) -> Option<T> {
        let answer = call(handler.get()?, &mut self.context());
        self.apply_edits(handler);
        Some(answer)
    }

    /// As [`call_handler`](Self::call_handler), for one side of a contact. No call if the
    /// [callbacks](crate::Geom::collision_callbacks_enabled) of that side are switched off.
    pub(super) fn call_handler_of_side<T>(
        &mut self,
        handler: &mut Handler<'_>,
        this: GeomId,
        call: impl FnOnce(&mut dyn EventHandler, &mut Context<'_>) -> T,
    ) -> Option<T> {
        handler.get()?;
        let is_told =
            self.objects.geoms.get(this).is_none_or(|entry| entry.geom.collision_callbacks_enabled());
        if is_told { self.call_handler(handler, call) } else { None }
    }

    /// Reports an event that was pending while no callback could be called.
    pub(super) fn report_pending(&mut self, notice: PendingEvent, handler: &mut Handler<'_>) {
        self.report.push(notice.into());
        let Some(handler) = handler.get() else { return };
        let mut context = self.context();
        match notice {
            PendingEvent::BodyUpdated { body } => handler.on_body_updated(&mut context, body),
            PendingEvent::BodyDisposed { body } => handler.on_body_disposed(&mut context, body),
            PendingEvent::NotFinite { .. } => {}
        }
    }
}

/// Reports that an object entered its list.
pub(super) fn report_added(report: &mut Report, handler: &mut Handler<'_>, object: ObjectId) {
    report.push(Event::Added { object });
    if let Some(handler) = handler.get() {
        handler.on_added(object);
    }
}

/// Reports that an object left its list.
pub(super) fn report_removed(report: &mut Report, handler: &mut Handler<'_>, object: ObjectId) {
    report.push(Event::Removed { object });
    if let Some(handler) = handler.get() {
        handler.on_removed(object);
    }
}

/// Callbacks, for engines that are built on the stages.
impl PhysicsSimulator {
    /// The context of callbacks, for the callbacks of an engine on top. Call [`settle`](Self::settle) after each.
    pub fn context(&mut self) -> Context<'_> {
        Context { simulator: self, surface: None }
    }

    /// Updates the geoms of edited bodies, and reports pending events, as after every callback of the core.
    pub fn settle(&mut self, handler: Option<&mut dyn EventHandler>) {
        self.apply_edits(&mut Handler::new(handler));
    }

    /// Adds an event to the list of this update.
    pub fn report(&mut self, event: Event) {
        self.report.push(event);
    }
}
