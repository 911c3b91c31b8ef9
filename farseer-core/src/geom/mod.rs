//! Geoms: collision settings and shape (behaviour chapter 05, section 3).

pub(crate) mod distance_grid;
pub(crate) mod entry;
pub(crate) mod filter;
pub(crate) mod grid_cache;
pub(crate) mod options;
pub(crate) mod outline;
#[cfg(feature = "precise")]
pub(crate) mod pieces;
pub(crate) mod rounded;
#[cfg(feature = "precise")]
pub(crate) mod sensor_pairs;
pub(crate) mod view;

use serde::{Deserialize, Serialize};

use crate::methods::CollisionCategory;
pub use crate::storage::ids::GeomId;
use crate::storage::rejected_arguments::{ArgumentNames, RejectedArguments};
use farseer_precise::surface::SurfaceOptions;
use filter::CollisionFilter;
use options::{GeomOptions, WantedEvents};

/// Collision settings of a geom: all its properties that may be changed freely. `simulator[geom]` has this type.
/// [`PhysicsSimulator::geom`](crate::PhysicsSimulator::geom) returns shape and pose as well: position, world vertices,
/// box and body. They are computed from the body.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Geom {
    pub(crate) collision_categories: CollisionCategory,
    pub(crate) collides_with: CollisionCategory,
    pub(crate) collision_group: i32,
    pub(crate) friction_coefficient: f32,
    pub(crate) restitution_coefficient: f32,
    pub(crate) collision_enabled: bool,
    pub(crate) collision_response_enabled: bool,
    #[serde(rename = "collision_callbacks_enabled")]
    options: GeomOptions,
    tag: u64,
    /// Combination rules, surface speed and rolling resistance; `None` for the default.
    pub(crate) surface: Option<SurfaceOptions>,
    /// Arguments that setters refused since the simulator last reported them.
    pub(crate) rejected: RejectedArguments<GeomArguments>,
}

/// The names of the arguments that setters of geoms reject.
#[derive(Debug)]
pub(crate) struct GeomArguments;

impl ArgumentNames for GeomArguments {
    const NAMES: &'static [&'static str] = &["friction_coefficient", "restitution_coefficient"];
}

impl Default for Geom {
    fn default() -> Self {
        Geom {
            collision_categories: CollisionCategory::ALL,
            collides_with: CollisionCategory::ALL,
            collision_group: 0,
            friction_coefficient: 0.0,
            restitution_coefficient: 0.0,
            collision_enabled: true,
            collision_response_enabled: true,
            options: GeomOptions::default(),
            tag: 0,
            surface: None,
            rejected: RejectedArguments::default(),
        }
    }
}

impl Geom {
    /// The categories the geom belongs to. Default all.
    #[doc(alias = "CollisionCategories")]
    pub fn collision_categories(&self) -> CollisionCategory {
        self.collision_categories
    }

    /// Sets the categories the geom belongs to.
    pub fn set_collision_categories(&mut self, value: CollisionCategory) {
        self.collision_categories = value;
    }

    /// The categories with which the geom collides. Two geoms collide if **either** one's mask contains a category of
    /// the other. Default all.
    #[doc(alias = "CollidesWith")]
    pub fn collides_with(&self) -> CollisionCategory {
        self.collides_with
    }

    /// Sets the categories with which the geom collides. See also [`set_both_must_agree`](Self::set_both_must_agree).
    pub fn set_collides_with(&mut self, value: CollisionCategory) {
        self.collides_with = value;
    }

    /// Geoms of the same group do not collide; 0 is no group. Default 0.
    #[doc(alias = "CollisionGroup")]
    pub fn collision_group(&self) -> i32 {
        self.collision_group
    }

    /// Sets the group.
    pub fn set_collision_group(&mut self, value: i32) {
        self.collision_group = value;
    }

    /// Friction coefficient, dimensionless, combined with that of the other geom when the two begin to overlap. Default
    /// 0.
    #[doc(alias = "FrictionCoefficient")]
    pub fn friction_coefficient(&self) -> f32 {
        self.friction_coefficient
    }

    /// Sets the friction of contacts that begin later. A value that is not finite is rejected.
    pub fn set_friction_coefficient(&mut self, value: f32) {
        if value.is_finite() {
            self.friction_coefficient = value;
        } else {
            self.rejected.note("friction_coefficient");
        }
    }

    /// Restitution coefficient, dimensionless, usually 0 to 1; the mean of both geoms' coefficients acts. Default 0.
    #[doc(alias = "RestitutionCoefficient")]
    pub fn restitution_coefficient(&self) -> f32 {
        self.restitution_coefficient
    }

    /// Sets the restitution coefficient. A value that is not finite is rejected.
    pub fn set_restitution_coefficient(&mut self, value: f32) {
        if value.is_finite() {
            self.restitution_coefficient = value;
        } else {
            self.rejected.note("restitution_coefficient");
        }
    }

    /// How coefficients combine, surface speed and rolling resistance. Set with
    /// [`Objects::set_surface`](crate::Objects::set_surface). Ours.
    pub fn surface(&self) -> SurfaceOptions {
        self.surface.unwrap_or_default()
    }

    /// Whether the broad phase makes new pairs with this geom. Default true.
    #[doc(alias = "CollisionEnabled")]
    pub fn collision_enabled(&self) -> bool {
        self.collision_enabled
    }

    /// Sets whether new pairs are made. Geoms that already touch continue to do so until they separate.
    pub fn set_collision_enabled(&mut self, value: bool) {
        self.collision_enabled = value;
    }

    /// Whether contacts exert impulses; they are reported either way. Default true.
    #[doc(alias = "CollisionResponseEnabled")]
    pub fn collision_response_enabled(&self) -> bool {
        self.collision_response_enabled
    }

    /// Sets whether this geom's contacts exert impulses.
    pub fn set_collision_response_enabled(&mut self, value: bool) {
        self.collision_response_enabled = value;
    }

    /// Whether handlers are called for contacts of this geom: [`on_collision`](crate::EventHandler::on_collision) and
    /// [`on_separation`](crate::EventHandler::on_separation) with this geom as `this`. Default true, as in the
    /// original, whose geoms have their own callbacks. The switch is ours.
    pub fn collision_callbacks_enabled(&self) -> bool {
        self.options.has(GeomOptions::CALLBACKS)
    }

    /// Sets whether handlers are called for contacts of this geom. Without callbacks it refuses no contact. The other
    /// geom's callback is called all the same, and [events](crate::Event::Collision) are listed either way. With the
    /// precise set a pair without callbacks on both sides costs no time for them, even in games with thousands of
    /// geoms.
    pub fn set_collision_callbacks_enabled(&mut self, value: bool) {
        self.options.set(GeomOptions::CALLBACKS, value);
    }

    /// Whether these settings let the geom collide with a geom of the `other` settings: collision is enabled on both,
    /// they are not of one group, and their categories match. The other conditions (the bodies, and ignored geoms) are
    /// not tested.
    #[inline]
    pub fn may_collide_with(&self, other: &Geom) -> bool {
        self.filter().may_meet(&other.filter())
    }

    /// The filter settings in one value.
    #[inline]
    pub fn filter(&self) -> CollisionFilter {
        CollisionFilter {
            categories: self.collision_categories,
            collides_with: self.collides_with,
            group: self.collision_group,
            is_enabled: self.collision_enabled,
            responds: self.collision_response_enabled,
            both_agree: self.both_must_agree(),
        }
    }

    /// Whether the masks of **both** geoms must contain a category of the other, if one of the two has this setting.
    /// Default false, as in the original: one of both masks is enough. True for geoms of a
    /// [`GeomBuilder`](crate::GeomBuilder). Ours.
    pub fn both_must_agree(&self) -> bool {
        self.options.has(GeomOptions::BOTH_AGREE)
    }

    /// Sets [`both_must_agree`](Self::both_must_agree).
    pub fn set_both_must_agree(&mut self, value: bool) {
        self.options.set(GeomOptions::BOTH_AGREE, value);
    }

    /// The typed events that the geom wants. Default none; touches and sensors for geoms of a
    /// [`GeomBuilder`](crate::GeomBuilder). Ours.
    pub fn wanted_events(&self) -> WantedEvents {
        self.options.events()
    }

    /// Sets [`wanted_events`](Self::wanted_events). A touch that lasts begins or ends, as an event, in the next update.
    pub fn set_wanted_events(&mut self, events: WantedEvents) {
        self.options.set_events(events);
    }

    /// A number for the user's own purposes, such as the index of a name in a list. Default 0.
    #[doc(alias("Tag", "Geom.Name"))]
    pub fn tag(&self) -> u64 {
        self.tag
    }

    /// Sets the user's number.
    pub fn set_tag(&mut self, value: u64) {
        self.tag = value;
    }

    /// Returns the names of the arguments that setters have refused, and clears them; after sixteen refusals only
    /// arguments that were not refused before, each once. A simulator reports those of its own geoms; engines that keep
    /// settings of their own call this for them.
    pub fn take_rejected(&mut self) -> impl Iterator<Item = &'static str> + '_ {
        self.rejected.take()
    }

    /// Whether the coefficients are finite, and the options known. False only after loading corrupt data.
    pub fn is_finite(&self) -> bool {
        self.friction_coefficient.is_finite()
            && self.restitution_coefficient.is_finite()
            && self.options.is_valid()
            && self.surface.is_none_or(|surface| surface.is_valid())
    }
}
