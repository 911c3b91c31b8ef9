//! The choices a simulator can be given (behaviour chapter 04, section 9).

use serde::{Deserialize, Serialize};

use crate::body::Body;
use crate::geom::entry::GeomEntry;
use crate::geom::outline::Outline;
use crate::joints::{Joint, JointKind};
use crate::math::finite::finite;
use crate::{Error, Result, SurfaceOptions};

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
    /// The methods of Farseer Physics 2.1.3, bit for bit (behaviour chapters 03 to 08). The default, with the original's broad
    /// and narrow phase.
    Faithful {
        /// Which pairs may touch.
        broad: BroadPhaseCollider,
        /// Where they touch.
        narrow: NarrowPhaseCollider,
    },
    /// A second engine behind the same API: faster and more accurate than the original, with other bits. It has true circles and
    /// convex pieces, persistent contacts, substeps with soft constraints, articulated bodies, and a direct solver for islands. It takes
    /// the same bodies, geoms, joints, springs, controllers and handlers, and reports the same events.
    ///
    /// The guide has chapters on its [`settings`](crate::guide::settings), [`solvers`](crate::guide::solvers),
    /// [`joints`](crate::guide::joints), [sleeping and continuous collision](crate::guide::sleep_and_ccd) and
    /// [`events`](crate::guide::events); [`choosing`](crate::guide::choosing) says where it fails. Absent without the
    /// cargo feature `precise`, which is on by default.
    #[cfg(feature = "precise")]
    Precise {
        /// Size of the objects that a player looks at, in the user's length units, > 0. Thresholds of distance and speed scale with it.
        /// 32 for games in px, 1 for games in metres; bodies of a thirtieth to three hundred times this size behave well.
        length_unit: f32,
    },
}

impl Default for Methods {
    fn default() -> Self {
        Methods::Faithful { broad: BroadPhaseCollider::default(), narrow: NarrowPhaseCollider::default() }
    }
}

impl Methods {
    /// The precise set for games in px. Absent without the cargo feature `precise`.
    #[cfg(feature = "precise")]
    pub const PRECISE: Self = Methods::Precise { length_unit: 32.0 };

    /// Broad and narrow phase of the faithful set; `None` for the precise set.
    fn faithful(self) -> Option<(BroadPhaseCollider, NarrowPhaseCollider)> {
        match self {
            Methods::Faithful { broad, narrow } => Some((broad, narrow)),
            #[cfg(feature = "precise")]
            Methods::Precise { .. } => None,
        }
    }

    /// Length unit of the precise set, in the user's length units; `None` for the faithful set.
    pub(crate) fn length_unit(self) -> Option<f32> {
        match self {
            Methods::Faithful { .. } => None,
            #[cfg(feature = "precise")]
            Methods::Precise { length_unit } => Some(length_unit),
        }
    }

    pub(crate) fn broad(self) -> BroadPhaseCollider {
        self.faithful().map_or_else(Default::default, |(broad, _)| broad)
    }

    /// The precise set asks no distance grids.
    pub(crate) fn narrow(self) -> NarrowPhaseCollider {
        self.faithful().map_or(NarrowPhaseCollider::Sat, |(_, narrow)| narrow)
    }

    /// With another broad phase, if it is the faithful set.
    pub(crate) fn with_broad(self, broad: BroadPhaseCollider) -> Self {
        self.faithful().map_or(self, |(_, narrow)| Methods::Faithful { broad, narrow })
    }

    /// With another narrow phase, if it is the faithful set.
    pub(crate) fn with_narrow(self, narrow: NarrowPhaseCollider) -> Self {
        self.faithful().map_or(self, |(broad, _)| Methods::Faithful { broad, narrow })
    }

    pub(crate) fn is_precise(self) -> bool {
        self.length_unit().is_some()
    }

    /// Refuses a joint that these methods cannot solve.
    pub(crate) fn check_joint(self, joint: &Joint) -> Result<()> {
        if !joint.do_bodies_collide() {
            self.check_separating_joints()?;
        }
        match joint.kind() {
            JointKind::Prismatic(_) => self.only_precise("prismatic joints"),
            JointKind::Wheel(_) => self.only_precise("wheel joints"),
            JointKind::AngleSpring(_) => self.only_precise("angle spring joints"),
            JointKind::Motor(_) => self.only_precise("motor joints"),
            JointKind::Gear(_) => self.only_precise("gear joints"),
            JointKind::Pulley(_) => self.only_precise("pulley joints"),
            _ => self.check_driven(joint),
        }
    }

    pub(crate) fn check_separating_joints(self) -> Result<()> {
        self.only_precise("joints whose bodies do not collide")
    }

    /// Refuses a joint with a motor or limits that these methods do not have.
    pub(crate) fn check_driven(self, joint: &Joint) -> Result<()> {
        if joint.motor().is_some() {
            self.only_precise("motors of joints")?;
        }
        if joint.servo().is_some() {
            self.only_precise("servos of joints")?;
        }
        if joint.limits().is_some() { self.only_precise("limits of such joints") } else { Ok(()) }
    }

    /// Refuses a body with locked axes, which the faithful set does not have.
    pub(crate) fn check_body(self, body: &Body) -> Result<()> {
        if body.locked_axes().contains(&true) { self.only_precise("locked axes of bodies") } else { Ok(()) }
    }

    /// Refuses a shape that these methods do not have.
    pub(crate) fn check_outline(self, outline: Outline) -> Result<()> {
        match outline {
            Outline::Chain { .. } => self.only_precise("chains"),
            Outline::TwoSidedChain { .. } => self.only_precise("two-sided chains"),
            Outline::RoundedPolygon { .. } => self.only_precise("rounded polygons"),
            Outline::Polygon | Outline::Circle { .. } | Outline::Capsule { .. } => Ok(()),
        }
    }

    /// Refuses a geom that these methods do not have.
    pub(crate) fn check_geom(self, geom: &GeomEntry) -> Result<()> {
        self.check_outline(geom.outline)?;
        if let Some(surface) = geom.geom.surface {
            self.check_surface(surface)?;
        }
        if geom.one_way.is_some() { self.check_one_way() } else { Ok(()) }
    }

    /// Refuses options of a surface that these methods do not have.
    pub(crate) fn check_surface(self, surface: SurfaceOptions) -> Result<()> {
        let SurfaceOptions { friction_rule, restitution_rule, speed, rolling_resistance } = surface;
        let used = [
            (friction_rule.is_some() || restitution_rule.is_some(), "combination rules"),
            (speed != 0.0, "surface speeds"),
            (rolling_resistance != 0.0, "rolling resistance"),
        ];
        used.into_iter().filter(|(is_used, _)| *is_used).try_for_each(|(_, what)| self.only_precise(what))
    }

    pub(crate) fn check_one_way(self) -> Result<()> {
        self.only_precise("one-way geoms")
    }

    /// Refuses a feature that the faithful set does not have.
    pub(crate) fn only_precise(self, what: &'static str) -> Result<()> {
        if self.is_precise() { Ok(()) } else { Err(Error::NotSupported { what, methods: "faithful" }) }
    }

    pub(crate) fn check(self) -> Result<Self> {
        if let Some((broad, _)) = self.faithful() {
            broad.check()?;
        }
        // Within these all numbers that follow from it have all their digits.
        if let Some(length_unit) = self.length_unit()
            && !(1e-20..=1e20).contains(&length_unit)
        {
            return Err(Error::invalid("length_unit", length_unit, "1e-20 to 1e20"));
        }
        Ok(self)
    }
}

/// See [`set_solver_choice`](crate::PhysicsSimulator::set_solver_choice). The direct solver pays as described at
/// [`Methods::Precise`].
pub use farseer_precise::solver_choice::SolverChoice;

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
