//! The choices a simulator can be given (behaviour chapter 04, section 9).

use serde::{Deserialize, Serialize};

use crate::geom::entry::GeomEntry;
use crate::joints::{Joint, JointKind};
use crate::math::finite::finite;
use crate::{Error, Result};

/// How a simulator computes: what belongs together is chosen together.
///
/// ```
/// use farseer_core::{BroadPhaseCollider, Methods, NarrowPhaseCollider, PhysicsSimulator};
/// let mut simulator = PhysicsSimulator::default();
/// let methods =
///     Methods::Faithful { broad: BroadPhaseCollider::SPATIAL_HASH, narrow: NarrowPhaseCollider::Sat };
/// simulator.set_methods(methods)?;
/// assert_eq!(simulator.narrow_phase_collider(), NarrowPhaseCollider::Sat);
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Methods {
    /// Those of Farseer Physics 2.1.3, bit for bit (behaviour chapters 03 to 08). The default, with the original's broad
    /// and narrow phase.
    Faithful {
        /// Which pairs may touch.
        broad: BroadPhaseCollider,
        /// Where they touch.
        narrow: NarrowPhaseCollider,
    },
    /// Faster and more accurate than the original could be, and not its bits: true circles and convex pieces, contacts that
    /// persist, and solvers that are chosen by what hangs together: exact ones, and substeps whose springs learn their load. It
    /// takes the same bodies, geoms, springs and
    /// controllers, asks the same handlers and tells the same events.
    ///
    /// | setting | with the precise set |
    /// |---|---|
    /// | [`enabled`](crate::PhysicsSimulator::enabled), [`gravity`](crate::PhysicsSimulator::gravity), [`Limits`](crate::Limits) | as in the faithful set |
    /// | [`iterations`](crate::PhysicsSimulator::iterations) | substeps of an update, 1 at least; 4 is what to begin with. More than three bodies that joints tie together and nothing touches take as few of them as their swing allows, and, if they are no more than fifty, up to twice as many where they whip |
    /// | [`friction_type`](crate::PhysicsSimulator::friction_type), coefficients of geoms | as in the faithful set; changes count at once |
    /// | [`bias_factor`](crate::PhysicsSimulator::bias_factor), [`allowed_penetration`](crate::PhysicsSimulator::allowed_penetration) | other values are refused with [`Error::NotSupported`]: overlaps are undone by springs of their own, and none is left alone. What was set before this set was chosen stays, for the way back |
    /// | [`max_contacts_to_detect`](crate::PhysicsSimulator::max_contacts_to_detect), [`max_contacts_to_resolve`](crate::PhysicsSimulator::max_contacts_to_resolve) | contacts of two convex pieces, by the smaller of both: two at most, the deepest first; with 0 nothing touches |
    /// | broad and narrow phase | the one is refused with [`Error::NotSupported`], the other refused and [reported](crate::Event::RejectedInput) |
    /// | distance grids and their cell sizes | made and kept for the faithful set, and not asked |
    /// | [`set_box_radius`](crate::Objects::set_box_radius) | queries see it; pairs are those of the outline |
    /// | [`set_matrix`](crate::Objects::set_matrix) | queries see it; contacts are those of the body's pose |
    /// | a negative step, stages called one by one | refused and [reported](crate::Event::RejectedInput) |
    /// | a negative mass, an inverse inertia that is not a normal number | no push moves or turns the body: `f32::MAX` as the moment of inertia keeps it from turning |
    /// | a static body's velocity | a conveyor belt, as in the faithful set |
    /// | chains of edges | [made](crate::GeomFactory::create_chain_geom) and kept only here |
    /// | [one-way geoms](crate::Objects::set_one_way) | only here: the faithful set refuses them with [`Error::NotSupported`] |
    /// | joints | A tree of joints that nothing touches is an articulated body, solved exactly. In 2D, closed loops and joints of bodies that touch something are rows beside the contacts of their island, solved together where that pays. Soft joints, and those of islands that this does not pay for, are soft constraints in the same passes as the contacts, once per substep. A free tree with motors, limits or greatest impulses is solved together in several parts of the step, and swings like one without them |
    /// | springs | undamped ones swing with their own frequency and keep their swing, whatever steps come; one that is too stiff for a step is as stiff as it bears, and comes to rest if steps are not equal. In 2D a spring of a body that something touches or a joint holds is solved with contacts and joints, exact at rest however stiff it is: it damps what swings |
    /// | [`breakpoint`](crate::Joint::breakpoint) | as in the faithful set, but a joint breaks before it acts once more; there is hardly any error to measure, so see [`greatest_force`](crate::Joint::greatest_force) |
    /// | [`softness`](crate::Joint::softness), [`bias_factor`](crate::Joint::bias_factor) of joints | a soft joint of a point or distance yields to a steady load as far as it does in the faithful set; its bias factor counts from 0 to 1; that of a hard one, and softness of an angle, mean nothing |
    /// | `max_impulse` of joints | the greatest impulse of a substep, not of an iteration: times substeps and divided by the step it is the greatest torque. Of an island that is solved as a whole, an angle with a finite one is sought as in the faithful set, by the speed of its error times [`bias_factor`](crate::Joint::bias_factor) divided by the step; one without bound is reached at once, without speed. So a figure that jumps by angle joints whose targets change needs a finite one: a figure of mass 8 with knees bent by 1.6 rad, gravity 900 px/s², bias factor 0.2, lifts its feet by 25 px in the faithful set (5 iterations, any impulse of 5,000 and more), here by 6 px without bound, 36 px with 5,000 and 92 px with 200,000 (4 substeps) |
    /// | [motors](crate::Objects::set_joint_motor) and [limits](crate::Objects::set_joint_limits) of revolute joints, [prismatic](crate::PrismaticJoint) joints | only here: the faithful set refuses them with [`Error::NotSupported`] |
    /// | [callbacks of a geom](crate::Geom::set_collision_callbacks_enabled), friction, restitution and tangent speed [set by a handler](crate::Context::set_contact_friction) | as in the faithful set |
    /// | [sleep](crate::PhysicsSimulator::set_sleep_enabled) | only here: bodies that hang together by contacts, joints or springs sleep when all of them have moved slower, for half a second, than a hundredth of the speed that a fall over one length unit would give them, and no contact still settles. What sleeps costs nothing, and is told of only where a handler is asked about touches. It wakes when one of them is edited, pushed by other forces than it fell asleep under, touched by what is awake, refused by a handler or loses what holds it. What a motor, a belt or a kinematic body moves does not sleep, however slowly, unless it is stalled: slower than a hundredth of its drive |
    /// | [island choice](crate::PhysicsSimulator::set_island_choice) | only here: whether islands are solved as a whole where that pays, never, or wherever that can be |
    /// | [bullets](crate::Body::is_bullet) | only here: continuous collision. No dynamic body passes through a static, kinematic or sleeping one, however fast either of the two moves, and no bullet through a dynamic one: the time of impact is that of their relative motion. A kinematic body drives before it all that it meets on its way, awake or asleep; contacts push from that update on. Limits: a body that two immovable ones press against each other can be passed by one of them, and a kinematic body that turns by more than one radian in an update can leave a body behind. A sensor that a fast body crosses within one update hears of it, of no contacts, at the end of the update |
    /// | tiles | only here: boxes, circles, capsules and polygons slide over flush static or kinematic neighbours without being stopped by their seams. Gaps and steps up to 1/64 of the length unit count as flush |
    /// | [kinematic](crate::Body::is_kinematic) bodies, [gravity scale](crate::Body::gravity_scale) | moved as in the faithful set; for what kinematic bodies meet see bullets |
    ///
    /// **Which island is solved how.** What hangs together, and does not bounce in this update, is solved as
    /// a whole where that pays. Of what hangs together by contacts alone and was put in its place at rest (slower than a quarter of a unit per second) that is all
    /// without rings, such as columns, with heavy things on light ones too, and high walls, card houses and pyramids of 40 bodies
    /// or more; of what has fallen together, columns of 16 bodies or more; of 400 bodies at most, and narrow enough. That stands
    /// as rigid bodies do, with an overlap below a thousandth of a px where one unit is 32 px, whatever the substeps. Moving or
    /// not, so is what bears something more than one and a half times as heavy as itself: without rings, if it is three bodies
    /// or more; and what something 16 times as heavy jams, with rings if it is 24 bodies at most. While more than 64 bodies are
    /// awake, what bears is asked for only in every 16th update, and only 16 times as heavy counts. Where an
    /// engine adds a depth axis, it is what bears something more than one and a half times as heavy alone.
    /// In 2D an island with joints, or with springs at bodies that something touches or holds, is solved as a whole, too, whatever
    /// moves in it and whatever it weighs, unless a joint in it is soft, or is a point with a greatest impulse. It has a budget for that: five times what passes would cost (ten times
    /// where one of two bodies that touch or are joined is more than 16 times as heavy), and 300 updates of passes more. Once these are used up, or if it cannot be solved so, it goes by passes for 64 updates, then for 128, then for 255;
    /// for fewer again after quiet updates.
    /// Everything else, and for two seconds what takes long to solve, goes by passes over all contacts.
    /// [`islands`](crate::PhysicsSimulator::islands) tells which is which, why, and what it took, and
    /// [`island_residual`](crate::PhysicsSimulator::island_residual) what is left of an error.
    /// [`set_island_choice`](crate::PhysicsSimulator::set_island_choice) chooses for all of a scene instead.
    ///
    /// Geoms of the circle factory with eight edges or more are true circles, with fewer the polygons that they look like;
    /// those of the capsule factory are true capsules. Concave outlines are cut into convex pieces, and nothing catches on the
    /// cuts; those of more than 1,000 corners, and those that cross themselves, are taken for filled up to their convex hull.
    /// Collisions are events when two geoms begin to touch and separations when they end, whichever of their pieces it is;
    /// handlers are asked in every update in which they do, unless the callbacks of both are switched off: such pairs cost
    /// nothing. What a handler refuses, and contacts that it takes off the
    /// list, push nothing in that update. World vertices and boxes of geoms are computed when somebody asks for them.
    Precise {
        /// Size of things that a player looks at, in the user's length unit: how near and how slow is near and slow enough.
        /// 32 for games in px, 1 for games in metres; things of a thirtieth to three hundred times this size behave well.
        length_unit: f32,
    },
}

impl Default for Methods {
    fn default() -> Self {
        Methods::Faithful { broad: BroadPhaseCollider::default(), narrow: NarrowPhaseCollider::default() }
    }
}

impl Methods {
    /// The precise set for games in px.
    pub const PRECISE: Self = Methods::Precise { length_unit: 32.0 };

    pub(crate) fn broad(self) -> BroadPhaseCollider {
        match self {
            Methods::Faithful { broad, .. } => broad,
            Methods::Precise { .. } => BroadPhaseCollider::default(),
        }
    }

    /// The precise set asks no distance grids.
    pub(crate) fn narrow(self) -> NarrowPhaseCollider {
        match self {
            Methods::Faithful { narrow, .. } => narrow,
            Methods::Precise { .. } => NarrowPhaseCollider::Sat,
        }
    }

    /// With another broad phase, if it is the faithful set.
    pub(crate) fn with_broad(self, broad: BroadPhaseCollider) -> Self {
        match self {
            Methods::Faithful { narrow, .. } => Methods::Faithful { broad, narrow },
            Methods::Precise { .. } => self,
        }
    }

    /// With another narrow phase, if it is the faithful set.
    pub(crate) fn with_narrow(self, narrow: NarrowPhaseCollider) -> Self {
        match self {
            Methods::Faithful { broad, .. } => Methods::Faithful { broad, narrow },
            Methods::Precise { .. } => self,
        }
    }

    pub(crate) fn is_precise(self) -> bool {
        matches!(self, Methods::Precise { .. })
    }

    /// Refuses a joint that these methods cannot solve.
    pub(crate) fn check_joint(self, joint: &Joint) -> Result<()> {
        match joint.kind() {
            JointKind::Prismatic(_) => self.only_precise("prismatic joints"),
            _ => self.check_driven(joint),
        }
    }

    /// Refuses a joint with a motor or limits that these methods do not have.
    pub(crate) fn check_driven(self, joint: &Joint) -> Result<()> {
        if joint.motor().is_some() {
            self.only_precise("motors of joints")?;
        }
        if joint.limits().is_some() { self.only_precise("limits of such joints") } else { Ok(()) }
    }

    pub(crate) fn check_chains(self) -> Result<()> {
        self.only_precise("chains")
    }

    /// Refuses a geom that these methods do not have.
    pub(crate) fn check_geom(self, geom: &GeomEntry) -> Result<()> {
        if geom.outline.is_chain() {
            self.check_chains()?;
        }
        if geom.one_way.is_some() { self.check_one_way() } else { Ok(()) }
    }

    pub(crate) fn check_one_way(self) -> Result<()> {
        self.only_precise("one-way geoms")
    }

    fn only_precise(self, what: &'static str) -> Result<()> {
        if self.is_precise() { Ok(()) } else { Err(Error::NotSupported { what, methods: "faithful" }) }
    }

    pub(crate) fn check(self) -> Result<Self> {
        match self {
            Methods::Faithful { broad, .. } => {
                broad.check()?;
            }
            Methods::Precise { length_unit } => {
                // Within these all numbers that follow from it have all their digits.
                if !(1e-20..=1e20).contains(&length_unit) {
                    return Err(Error::invalid("length_unit", length_unit, "1e-20 to 1e20"));
                }
            }
        }
        Ok(self)
    }
}

/// How the precise set solves islands, the bodies that contacts and joints connect: see
/// [`set_island_choice`](crate::PhysicsSimulator::set_island_choice).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
pub enum IslandChoice {
    /// Each island by the cheapest method that is exact enough: [as a whole where that pays](Methods::Precise). The default.
    #[default]
    ByItself,
    /// By passes over all contacts, whatever stands there.
    Passes,
    /// As a whole wherever that can be: 2 to 400 bodies, in updates in which none of them bounces, that no soft joint holds, and
    /// narrow enough for a factor of the matrix; in 2D also closed loops of joints, of any number of bodies. What has rings and moves
    /// takes far longer so than by passes.
    Whole,
}

/// Where two geoms touch: the method of the narrow phase.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
pub enum NarrowPhaseCollider {
    /// Signed distances sampled on a grid over each outline (behaviour chapter 06). Takes any simple
    /// outline, also concave ones. Misses what is smaller than a cell, and outlines that cross without a
    /// vertex inside the other.
    #[default]
    DistanceGrid,
    /// Separating axes (behaviour chapter 07). Only meaningful for convex outlines.
    #[doc(alias = "SAT")]
    Sat,
}

impl NarrowPhaseCollider {
    /// Whether it looks things up in distance grids, which are made with the geoms then.
    pub(crate) fn uses_grids(self) -> bool {
        self == NarrowPhaseCollider::DistanceGrid
    }
}

/// Which pairs may touch: the method of the broad phase.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub enum BroadPhaseCollider {
    /// Sorted interval ends on the less crowded axis (behaviour chapter 08, section 2). The default.
    #[default]
    #[doc(alias = "SelectiveSweepCollider")]
    SelectiveSweep,
    /// Incrementally sorted extents on both axes (behaviour chapter 08, section 3). Cheap for slow scenes;
    /// forgets resting pairs when a geom is removed.
    #[doc(alias = "SweepAndPruneCollider")]
    SweepAndPrune,
    /// Every geom against every other (behaviour chapter 08, section 5).
    #[doc(alias = "BruteForceCollider")]
    BruteForce,
    /// Square cells (behaviour chapter 08, section 4).
    #[doc(alias = "SpatialHashCollider")]
    SpatialHash {
        /// Edge of a cell in the user's length unit; the original's default is 50.
        #[doc(alias = "CellSize")]
        #[serde(with = "crate::storage::bits")]
        cell_size: f32,
        /// Whether each update sets the cell size to twice the mean longer side of the geoms' boxes.
        #[doc(alias = "AutoAdjustCellSize")]
        auto_adjust_cell_size: bool,
    },
}

impl BroadPhaseCollider {
    /// The spatial hash with the original's defaults: cells of 50, adjusted in every update.
    pub const SPATIAL_HASH: Self =
        BroadPhaseCollider::SpatialHash { cell_size: 50.0, auto_adjust_cell_size: true };

    pub(crate) fn check(self) -> Result<Self> {
        if let BroadPhaseCollider::SpatialHash { cell_size, .. } = self {
            finite("cell_size", cell_size)?;
        }
        Ok(self)
    }
}

/// A set of collision categories, 31 of them (behaviour chapter 04, section 9).
///
/// ```
/// use farseer_core::CollisionCategory;
/// let players_and_walls = CollisionCategory::CAT1 | CollisionCategory::CAT2;
/// assert!(players_and_walls.intersects(CollisionCategory::cat(2)?));
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[doc(alias = "CollisionCategories")]
pub struct CollisionCategory(i32);

impl CollisionCategory {
    /// No category.
    pub const NONE: Self = CollisionCategory(0);
    /// All 31 categories.
    pub const ALL: Self = CollisionCategory(0x7FFF_FFFF);

    /// Category `number`, 1 to 31, for numbers that are not known beforehand.
    ///
    /// # Errors
    /// A number outside 1 to 31.
    pub fn cat(number: u32) -> Result<Self> {
        if (1..=31).contains(&number) {
            Ok(CollisionCategory(1 << (number - 1)))
        } else {
            Err(Error::invalid("number", number, "1 to 31"))
        }
    }

    /// The set with exactly these bits; category n is bit n - 1.
    pub const fn from_bits(bits: i32) -> Self {
        CollisionCategory(bits)
    }

    /// The set as bits; category n is bit n - 1.
    pub const fn bits(self) -> i32 {
        self.0
    }

    /// Whether both sets have a category in common.
    #[inline]
    pub const fn intersects(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }
}

/// The categories by name, `CAT1 | CAT3`; `NONE` and `ALL`. The bit that is no category is shown as `0x80000000`.
///
/// ```
/// use farseer_core::CollisionCategory;
/// let players_and_walls = CollisionCategory::CAT1 | CollisionCategory::CAT3;
/// assert_eq!(players_and_walls.to_string(), "CAT1 | CAT3");
/// ```
impl std::fmt::Display for CollisionCategory {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match *self {
            Self::NONE => return f.write_str("NONE"),
            Self::ALL => return f.write_str("ALL"),
            _ => {}
        }
        let mut separator = "";
        for number in (1..=31).filter(|number| self.0 & (1 << (number - 1)) != 0) {
            write!(f, "{separator}CAT{number}")?;
            separator = " | ";
        }
        if self.0 < 0 {
            write!(f, "{separator}0x80000000")?;
        }
        Ok(())
    }
}

macro_rules! categories {
    ($($name:ident = $number:literal, $alias:literal;)*) => {
        /// The categories by name.
        impl CollisionCategory {$(
            #[doc = concat!("Category ", $number, ".")]
            #[doc(alias = $alias)]
            pub const $name: Self = CollisionCategory(1 << ($number - 1));
        )*}
    };
}

categories! {
    CAT1 = 1, "Cat1";
    CAT2 = 2, "Cat2";
    CAT3 = 3, "Cat3";
    CAT4 = 4, "Cat4";
    CAT5 = 5, "Cat5";
    CAT6 = 6, "Cat6";
    CAT7 = 7, "Cat7";
    CAT8 = 8, "Cat8";
    CAT9 = 9, "Cat9";
    CAT10 = 10, "Cat10";
    CAT11 = 11, "Cat11";
    CAT12 = 12, "Cat12";
    CAT13 = 13, "Cat13";
    CAT14 = 14, "Cat14";
    CAT15 = 15, "Cat15";
    CAT16 = 16, "Cat16";
    CAT17 = 17, "Cat17";
    CAT18 = 18, "Cat18";
    CAT19 = 19, "Cat19";
    CAT20 = 20, "Cat20";
    CAT21 = 21, "Cat21";
    CAT22 = 22, "Cat22";
    CAT23 = 23, "Cat23";
    CAT24 = 24, "Cat24";
    CAT25 = 25, "Cat25";
    CAT26 = 26, "Cat26";
    CAT27 = 27, "Cat27";
    CAT28 = 28, "Cat28";
    CAT29 = 29, "Cat29";
    CAT30 = 30, "Cat30";
    CAT31 = 31, "Cat31";
}

impl std::ops::BitOr for CollisionCategory {
    type Output = Self;
    fn bitor(self, other: Self) -> Self {
        CollisionCategory(self.0 | other.0)
    }
}

impl std::ops::BitAnd for CollisionCategory {
    type Output = Self;
    fn bitand(self, other: Self) -> Self {
        CollisionCategory(self.0 & other.0)
    }
}

impl std::ops::Not for CollisionCategory {
    type Output = Self;
    /// All 31 categories that are not in the set.
    fn not(self) -> Self {
        CollisionCategory(!self.0 & Self::ALL.0)
    }
}

#[cfg(test)]
mod tests {
    use super::CollisionCategory;

    #[test]
    fn categories_are_shown_by_name_in_rising_order() {
        let set = CollisionCategory::CAT31 | CollisionCategory::CAT2;
        assert_eq!(set.to_string(), "CAT2 | CAT31");
    }

    #[test]
    fn no_category_and_all_categories_have_names_of_their_own() {
        assert_eq!(CollisionCategory::NONE.to_string(), "NONE");
        assert_eq!(CollisionCategory::ALL.to_string(), "ALL");
    }

    #[test]
    fn the_bit_that_is_no_category_is_not_hidden() {
        assert_eq!(CollisionCategory::from_bits(i32::MIN | 1).to_string(), "CAT1 | 0x80000000");
        assert_eq!(CollisionCategory::from_bits(-1).to_string().matches("CAT").count(), 31);
    }
}
