//! How a geom collides (behaviour chapter 05, section 3).

pub(crate) mod convex_parts;
pub(crate) mod distance_grid;
pub(crate) mod entry;
pub(crate) mod filter;
pub(crate) mod grid_cache;
pub(crate) mod outline;
pub(crate) mod pieces;
pub(crate) mod seams;
pub(crate) mod surface;
pub(crate) mod view;

use serde::{Deserialize, Serialize};

use crate::methods::CollisionCategory;
pub use crate::storage::ids::GeomId;
use crate::storage::refusals::{ArgumentNames, Refusals};
use filter::CollisionFilter;

/// How a geom collides: everything about it that may be changed freely. `simulator[geom]` is this;
/// [`PhysicsSimulator::geom`](crate::PhysicsSimulator::geom) shows the shape and place as well: position, world vertices, box
/// and body, which follow from the body.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Geom {
    pub(crate) collision_categories: CollisionCategory,
    pub(crate) collides_with: CollisionCategory,
    pub(crate) collision_group: i32,
    pub(crate) friction_coefficient: f32,
    pub(crate) restitution_coefficient: f32,
    pub(crate) collision_enabled: bool,
    pub(crate) collision_response_enabled: bool,
    pub(crate) collision_callbacks_enabled: bool,
    tag: u64,
    /// Arguments refused since the simulator last looked.
    pub(crate) rejected: Refusals<GeomArguments>,
}

/// What setters of geoms refuse.
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
            collision_callbacks_enabled: true,
            tag: 0,
            rejected: Refusals::default(),
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

    /// The categories the geom collides with. Two geoms collide if **either** one's mask meets the other's
    /// categories. Default all.
    #[doc(alias = "CollidesWith")]
    pub fn collides_with(&self) -> CollisionCategory {
        self.collides_with
    }

    /// Sets the categories the geom collides with.
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

    /// Friction, combined with the partner's when the two begin to overlap. Default 0.
    #[doc(alias = "FrictionCoefficient")]
    pub fn friction_coefficient(&self) -> f32 {
        self.friction_coefficient
    }

    /// Sets the friction of contacts that begin later. What is not finite is rejected.
    pub fn set_friction_coefficient(&mut self, value: f32) {
        if value.is_finite() {
            self.friction_coefficient = value;
        } else {
            self.rejected.note("friction_coefficient");
        }
    }

    /// Bounciness, usually 0 to 1; the mean of both partners acts. Default 0.
    #[doc(alias = "RestitutionCoefficient")]
    pub fn restitution_coefficient(&self) -> f32 {
        self.restitution_coefficient
    }

    /// Sets the bounciness. What is not finite is rejected.
    pub fn set_restitution_coefficient(&mut self, value: f32) {
        if value.is_finite() {
            self.restitution_coefficient = value;
        } else {
            self.rejected.note("restitution_coefficient");
        }
    }

    /// Whether new pairs with this geom are looked for. Default true.
    #[doc(alias = "CollisionEnabled")]
    pub fn collision_enabled(&self) -> bool {
        self.collision_enabled
    }

    /// Switches the search for new pairs. Geoms that already touch go on touching until they separate.
    pub fn set_collision_enabled(&mut self, value: bool) {
        self.collision_enabled = value;
    }

    /// Whether contacts exert impulses; they are reported either way. Default true.
    #[doc(alias = "CollisionResponseEnabled")]
    pub fn collision_response_enabled(&self) -> bool {
        self.collision_response_enabled
    }

    /// Switches the impulses of this geom's contacts.
    pub fn set_collision_response_enabled(&mut self, value: bool) {
        self.collision_response_enabled = value;
    }

    /// Whether a handler is told of what this geom touches: [`on_collision`](crate::EventHandler::on_collision) and
    /// [`on_separation`](crate::EventHandler::on_separation) with this geom as `this`. Default true, as in the original,
    /// whose geoms have their own callbacks; not in the original as a switch.
    pub fn collision_callbacks_enabled(&self) -> bool {
        self.collision_callbacks_enabled
    }

    /// Switches the callbacks of this geom. A geom that is not told refuses nothing, its partner is asked all the same, and
    /// [events](crate::Event::Collision) are listed either way. With the precise set two geoms that are both switched off
    /// are not even looked at for their callbacks, so that a game of thousands of things pays for those that it asks for.
    pub fn set_collision_callbacks_enabled(&mut self, value: bool) {
        self.collision_callbacks_enabled = value;
    }

    /// Whether these settings let the geom collide with one of those settings: collision is enabled on both, they
    /// are not of one group, and their categories meet. What else decides about two geoms of a simulator (their
    /// bodies, and whom they ignore) is not asked.
    #[inline]
    pub fn may_collide_with(&self, other: &Geom) -> bool {
        self.filter().may_meet(&other.filter())
    }

    /// Whom the geom may meet, in one value.
    #[inline]
    pub fn filter(&self) -> CollisionFilter {
        CollisionFilter {
            categories: self.collision_categories,
            collides_with: self.collides_with,
            group: self.collision_group,
            is_enabled: self.collision_enabled,
            responds: self.collision_response_enabled,
        }
    }

    /// A number for the user's own purposes, such as the place of a name in a list. Default 0.
    #[doc(alias("Tag", "Geom.Name"))]
    pub fn tag(&self) -> u64 {
        self.tag
    }

    /// Sets the user's number.
    pub fn set_tag(&mut self, value: u64) {
        self.tag = value;
    }

    /// Names of the arguments that setters have refused since they were last asked for; after sixteen
    /// of them only further arguments, each once. A simulator asks its
    /// own geoms and reports them; engines that keep settings of their own ask these.
    pub fn take_rejected(&mut self) -> impl Iterator<Item = &'static str> + '_ {
        self.rejected.take()
    }

    /// Whether the coefficients are finite: false only for what was loaded from garbage.
    pub fn is_finite(&self) -> bool {
        self.friction_coefficient.is_finite() && self.restitution_coefficient.is_finite()
    }
}
