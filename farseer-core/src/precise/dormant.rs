//! Updates in which all sleeps and nothing is to be looked at: what the stages would find out one by one is known beforehand, and
//! after all that a game does between two updates they would find it in memory that is far away.

use super::Precise;
use crate::FrictionType;
use crate::math::Vector2;

/// What an update goes by besides the things in it.
pub(crate) struct Terms {
    pub(crate) dt: f32,
    pub(crate) substeps: u32,
    pub(crate) gravity: Vector2,
    pub(crate) may_sleep: bool,
    pub(crate) friction: FrictionType,
    pub(crate) most_contacts: u32,
}

impl Precise {
    /// Passes an update, if it is one in which nothing can happen; answers whether it was. Nobody is to be told or asked of
    /// anything, and no spring or controller acts.
    pub(crate) fn pass_dormant(&mut self, terms: &Terms) -> bool {
        let &Terms { dt, substeps, gravity, may_sleep, friction, most_contacts } = terms;
        let is_as_before = self.h == dt / substeps as f32
            && may_sleep
            && self.sleep.is_undisturbed([gravity.x, gravity.y])
            && (self.friction, self.most_contacts) == (friction, most_contacts);
        if !(is_as_before && self.is_dormant()) {
            return false;
        }
        self.dt = dt;
        true
    }

    /// Whether nothing of all that is kept from update to update is to be looked at.
    fn is_dormant(&self) -> bool {
        self.pairs.awake == 0
            && self.proxies.escaped.is_empty()
            && self.proxies.one_way == 0
            && self.widened.is_empty()
            && self.changes.is_empty()
            && !self.has_handled
            && self.joints.are_none()
            && !self.may_break_joints()
            && self.direct.is_quiet()
    }
}
