//! The one way in which a game is told something.

use super::{Context, EventHandler, PhysicsSimulator};
use crate::geom::GeomId;
use crate::object_id::ObjectId;
use crate::report::{Event, Notice, Report};

/// The handler of an update, if there is one.
pub(crate) struct Handler<'h>(Option<&'h mut dyn EventHandler>);

impl<'h> Handler<'h> {
    pub(crate) fn new(handler: Option<&'h mut dyn EventHandler>) -> Self {
        Handler(handler)
    }

    /// Nobody is told.
    pub(crate) fn none() -> Self {
        Handler(None)
    }

    #[inline]
    pub(crate) fn get(&mut self) -> Option<&mut (dyn EventHandler + 'h)> {
        self.0.as_deref_mut()
    }

    /// Whether there is a handler that says so of itself.
    pub(crate) fn wants(&self, what: impl FnOnce(&dyn EventHandler) -> bool) -> bool {
        self.0.as_deref().is_some_and(what)
    }

    /// The same for a shorter time.
    pub(crate) fn reborrow(&mut self) -> Handler<'_> {
        match &mut self.0 {
            Some(handler) => Handler(Some(&mut **handler)),
            None => Handler(None),
        }
    }
}

impl PhysicsSimulator {
    /// Tells the handler, if there is one, and settles what it has edited.
    #[inline]
    pub(super) fn tell<T>(
        &mut self,
        handler: &mut Handler<'_>,
        tell: impl FnOnce(&mut dyn EventHandler, &mut Context<'_>) -> T,
    ) -> Option<T> {
        let answer = tell(handler.get()?, &mut self.context());
        self.settle_edits(handler);
        Some(answer)
    }

    /// As [`tell`](Self::tell), what one side of a touch is told: nothing if its
    /// [callbacks](crate::Geom::collision_callbacks_enabled) are switched off.
    pub(super) fn tell_side<T>(
        &mut self,
        handler: &mut Handler<'_>,
        this: GeomId,
        tell: impl FnOnce(&mut dyn EventHandler, &mut Context<'_>) -> T,
    ) -> Option<T> {
        handler.get()?;
        let is_told = self.objects.geoms.get(this).is_none_or(|entry| entry.geom.collision_callbacks_enabled);
        if is_told { self.tell(handler, tell) } else { None }
    }

    /// What has happened while nobody could be told.
    pub(super) fn deliver(&mut self, notice: Notice, handler: &mut Handler<'_>) {
        self.report.push(notice.into());
        let Some(handler) = handler.get() else { return };
        let mut context = self.context();
        match notice {
            Notice::BodyUpdated { body } => handler.on_body_updated(&mut context, body),
            Notice::BodyDisposed { body } => handler.on_body_disposed(&mut context, body),
            Notice::NotFinite { .. } => {}
        }
    }
}

/// An object entered its list.
pub(super) fn tell_added(report: &mut Report, handler: &mut Handler<'_>, object: ObjectId) {
    report.push(Event::Added { object });
    if let Some(handler) = handler.get() {
        handler.on_added(object);
    }
}

/// An object left its list.
pub(super) fn tell_removed(report: &mut Report, handler: &mut Handler<'_>, object: ObjectId) {
    report.push(Event::Removed { object });
    if let Some(handler) = handler.get() {
        handler.on_removed(object);
    }
}

/// For engines that are built on the stages: callbacks.
impl PhysicsSimulator {
    /// What callbacks may do to the simulator, to hand to callbacks of an engine. [`settle`](Self::settle) is due
    /// after each.
    pub fn context(&mut self) -> Context<'_> {
        Context { simulator: self, surface: None }
    }

    /// Lets geoms follow bodies that were edited, and delivers what has happened meanwhile, as after every callback
    /// of the core.
    pub fn settle(&mut self, handler: Option<&mut dyn EventHandler>) {
        self.settle_edits(&mut Handler::new(handler));
    }

    /// Puts an event on the list of this update.
    pub fn report(&mut self, event: Event) {
        self.report.push(event);
    }
}
