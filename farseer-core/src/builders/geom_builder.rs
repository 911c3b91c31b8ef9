//! The description of a geom.

use super::geom_shape::GeomShape;
use crate::Result;
use crate::geom::options::WantedEvents;
use crate::math::Vector2;
use crate::math::finite::{finite, finite_vector, zero_or_more};
use crate::methods::{CollisionCategory, Methods};
use crate::objects::check_surface;
use crate::{CombinationRule, SurfaceOptions};

/// Friction coefficient of geoms that a builder describes, dimensionless: that of Box2D and of most solid things.
const FRICTION: f32 = 0.6;

/// Describes a geom for [`add_body`](crate::Objects::add_body) and [`add_geom`](crate::Objects::add_geom): a shape on a body, and
/// how it collides.
///
/// | | geoms of a builder | geoms of Farseer's factories |
/// |---|---|---|
/// | friction | 0.6 | 0 |
/// | two geoms collide if | both masks have a category of the other | one mask has |
/// | typed [events](crate::Event) | touches and sensors | none |
/// | a sensor | on a body of any kind | makes its body static |
/// | mass | of the body, by density | given with the body |
///
/// ```
/// use farseer_core::{BodyBuilder, CollisionCategory, Event, GeomBuilder, PhysicsSimulator};
/// let mut simulator = PhysicsSimulator::precise([0.0, 300.0])?;
/// const PLAYER: CollisionCategory = CollisionCategory::CAT1;
/// const COIN: CollisionCategory = CollisionCategory::CAT2;
/// // A coin that floats, and that only the player collects.
/// let coin = GeomBuilder::circle(8.0).sensor(true).categories(COIN).collides_with(PLAYER);
/// let (_, [coin]) = simulator.add_body(BodyBuilder::fixed().position([0.0, 50.0]), [coin])?;
/// let (_, [hero]) = simulator.add_body(BodyBuilder::dynamic(), [GeomBuilder::capsule(40.0, 8.0).categories(PLAYER)])?;
/// let mut collected = 0;
/// for _ in 0..60 {
///     simulator.update(1.0 / 60.0);
///     let began = Event::SensorBegin { sensor: coin, visitor: hero };
///     collected += simulator.events().iter().filter(|&&event| event == began).count();
/// }
/// assert_eq!(collected, 1);
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[must_use]
pub struct GeomBuilder {
    pub(super) shape: GeomShape,
    pub(super) offset: Vector2,
    pub(super) rotation_offset: f32,
    pub(super) density: Option<f32>,
    pub(super) mass: Option<f32>,
    pub(super) friction: f32,
    pub(super) restitution: f32,
    pub(super) surface: SurfaceOptions,
    pub(super) categories: CollisionCategory,
    pub(super) collides_with: CollisionCategory,
    pub(super) group: i32,
    pub(super) is_sensor: bool,
    /// `None`: as the methods have them.
    pub(super) events: Option<WantedEvents>,
    pub(super) one_way: Option<Vector2>,
    pub(super) user_data: u64,
}

/// Shapes.
impl GeomBuilder {
    fn new(shape: GeomShape) -> Self {
        GeomBuilder {
            shape,
            offset: Vector2::zeros(),
            rotation_offset: 0.0,
            density: None,
            mass: None,
            friction: FRICTION,
            restitution: 0.0,
            surface: SurfaceOptions::default(),
            categories: CollisionCategory::ALL,
            collides_with: CollisionCategory::ALL,
            group: 0,
            is_sensor: false,
            events: None,
            one_way: None,
            user_data: 0,
        }
    }

    /// A rectangle about its middle; `width` and `height` in length units, greater than 0.
    #[doc(alias("box", "cuboid"))]
    pub fn rectangle(width: f32, height: f32) -> Self {
        GeomBuilder::new(GeomShape::Rectangle { width, height })
    }

    /// A circle about its middle; `radius` in length units, greater than 0.
    #[doc(alias("ball", "disc"))]
    pub fn circle(radius: f32) -> Self {
        GeomBuilder::new(GeomShape::Circle { radius })
    }

    /// An upright capsule about its middle, in length units: `height` from tip to tip, `end_radius` greater than 0 and less than
    /// half of the height.
    pub fn capsule(height: f32, end_radius: f32) -> Self {
        GeomBuilder::new(GeomShape::Capsule { height, end_radius })
    }

    /// A polygon, convex or not, given by its corners in length units, in either direction, without crossings. They stay where
    /// they are: the outline is not moved to its middle.
    pub fn polygon(corners: impl IntoIterator<Item = impl Into<Vector2>>) -> Self {
        GeomBuilder::new(GeomShape::Polygon { corners: corners.into_iter().map(Into::into).collect() })
    }

    /// A convex polygon with a rounded border: all points within `radius` of the polygon with these corners, in length units. So
    /// the shape is larger than the polygon. Corners in either direction stay where they are; `radius` is greater than 0. Only
    /// with the precise set.
    ///
    /// ```
    /// use farseer_core::{BodyBuilder, GeomBuilder, PhysicsSimulator};
    /// let mut simulator = PhysicsSimulator::precise([0.0, 300.0])?;
    /// let core = [[-12.0, -8.0], [12.0, -8.0], [12.0, 8.0], [-12.0, 8.0]];
    /// let stone = GeomBuilder::rounded_polygon(core, 4.0).density(1.0);
    /// let (stone, _) = simulator.add_body(BodyBuilder::dynamic(), [stone])?;
    /// let area = 24.0 * 16.0 + 2.0 * (24.0 + 16.0) * 4.0 + std::f32::consts::PI * 16.0;
    /// assert!((simulator[stone].mass() - area).abs() < 0.01);
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    #[doc(alias("rounded_box", "round_cuboid", "round_convex"))]
    pub fn rounded_polygon(corners: impl IntoIterator<Item = impl Into<Vector2>>, radius: f32) -> Self {
        let corners = corners.into_iter().map(Into::into).collect();
        GeomBuilder::new(GeomShape::RoundedPolygon { corners, radius })
    }

    /// A segment that is solid on both sides, in length units: a [two-sided chain](Self::two_sided_chain) of two points.
    #[doc(alias("line", "edge"))]
    pub fn segment(start: impl Into<Vector2>, end: impl Into<Vector2>) -> Self {
        GeomBuilder::two_sided_chain([start.into(), end.into()])
    }

    /// A chain of edges that are solid on both sides, in length units, on a body of any kind. It is closed if the last point is the
    /// first. Shapes that slide along it do not catch on its points. Only with the precise set.
    ///
    /// The edges are thin: a shape is pushed out on the side where its middle is. Chains of any kind do not collide with each
    /// other, so that a moving one needs another geom to lie on a chain. A chain has no area: on a dynamic body give it a
    /// [mass](Self::mass), which is spread along its edges.
    ///
    /// ```
    /// use farseer_core::{BodyBuilder, GeomBuilder, PhysicsSimulator};
    /// let mut simulator = PhysicsSimulator::precise([0.0, 300.0])?;
    /// // A bowl that turns, with a ball in it.
    /// let bowl = GeomBuilder::two_sided_chain([[-60.0, -30.0], [-30.0, 0.0], [30.0, 0.0], [60.0, -30.0]]).mass(3.0);
    /// let bowl = simulator.add_body(BodyBuilder::kinematic().angular_velocity(0.2), [bowl])?.0;
    /// let (ball, _) = simulator.add_body(BodyBuilder::dynamic().position([0.0, -20.0]), [GeomBuilder::circle(8.0)])?;
    /// (0..60).for_each(|_| simulator.update(1.0 / 60.0));
    /// assert!(simulator[ball].position().y < simulator[bowl].position().y);
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    #[doc(alias("polyline", "wire"))]
    pub fn two_sided_chain(points: impl IntoIterator<Item = impl Into<Vector2>>) -> Self {
        GeomBuilder::new(GeomShape::TwoSidedChain { points: points.into_iter().map(Into::into).collect() })
    }

    /// Terrain from heights at equal distances, on a static body: a [chain](Self::chain) that is solid below, about its middle.
    /// `spacing` is the distance of two heights along x, greater than 0. Heights are above the geom's origin, so towards -y. Both in
    /// length units. Only with the precise set.
    ///
    /// ```
    /// use farseer_core::{BodyBuilder, GeomBuilder, PhysicsSimulator};
    /// let mut simulator = PhysicsSimulator::precise([0.0, 300.0])?;
    /// let hills = (0..200).map(|i| 30.0 * (i as f32 * 0.2).sin());
    /// simulator.add_body(BodyBuilder::fixed().position([0.0, 100.0]), [GeomBuilder::height_field(hills, 16.0)])?;
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    #[doc(alias("heightfield"))]
    pub fn height_field(heights: impl IntoIterator<Item = f32>, spacing: f32) -> Self {
        GeomBuilder::new(GeomShape::HeightField { heights: heights.into_iter().collect(), spacing })
    }

    /// A chain of edges for terrain, in length units, on a static body: points from left to right make a floor. It is closed if
    /// the last point is the first. See [`create_chain_geom`](crate::GeomFactory::create_chain_geom). Only with the precise set.
    #[doc(alias("edge_chain"))]
    pub fn chain(points: impl IntoIterator<Item = impl Into<Vector2>>) -> Self {
        GeomBuilder::new(GeomShape::Chain { points: points.into_iter().map(Into::into).collect() })
    }
}

/// Place and properties.
impl GeomBuilder {
    /// Place of the shape's origin on the body, in length units. Default the body's origin. The
    /// [rotation offset](Self::rotation_offset) does not turn it, other than that of a [`GeomPlacement`](crate::GeomPlacement).
    pub fn offset(mut self, offset: impl Into<Vector2>) -> Self {
        self.offset = offset.into();
        self
    }

    /// Rotation of the shape on the body, in radians, about the shape's origin. Default 0.
    pub fn rotation_offset(mut self, rotation_offset: f32) -> Self {
        self.rotation_offset = rotation_offset;
        self
    }

    /// Mass per area, in mass units per square of a user's length unit, 0 or more. By default a square with sides of one length
    /// unit of the methods (32 px, or 1 m) has mass 1; sensors and chains have none.
    pub fn density(mut self, density: f32) -> Self {
        (self.density, self.mass) = (Some(density), None);
        self
    }

    /// Mass of the geom in mass units, 0 or more, instead of a density.
    pub fn mass(mut self, mass: f32) -> Self {
        (self.mass, self.density) = (Some(mass), None);
        self
    }

    /// Friction coefficient, dimensionless, 0 or more. Default 0.6. The mean of both geoms acts, unless a
    /// [rule](Self::friction_rule) or [`set_friction_type`](crate::PhysicsSimulator::set_friction_type) says otherwise.
    pub fn friction(mut self, friction: f32) -> Self {
        self.friction = friction;
        self
    }

    /// Restitution coefficient, dimensionless, usually 0 to 1. Default 0. The mean of both geoms acts, unless a
    /// [rule](Self::restitution_rule) says otherwise.
    pub fn restitution(mut self, restitution: f32) -> Self {
        self.restitution = restitution;
        self
    }

    /// How the friction coefficients of this geom and another combine. If the other geom has a rule, too, the later one in the
    /// list of [`CombinationRule`] acts. Default none. Only with the precise set.
    #[doc(alias("friction_combine_rule", "combine_rule"))]
    pub fn friction_rule(mut self, rule: CombinationRule) -> Self {
        self.surface.friction_rule = Some(rule);
        self
    }

    /// How the restitution coefficients of this geom and another combine: see [`friction_rule`](Self::friction_rule). Default
    /// none. Only with the precise set.
    #[doc(alias("restitution_combine_rule"))]
    pub fn restitution_rule(mut self, rule: CombinationRule) -> Self {
        self.surface.restitution_rule = Some(rule);
        self
    }

    /// Speed at which the surface runs around the shape, clockwise on the screen, in length units/s. So the upper side of a conveyor
    /// belt carries things to the right, and the track of a tank drives it to the right. Friction brings what touches to this speed.
    /// A [two-sided chain](Self::two_sided_chain) carries to the right on its upper side and to the left on its lower one, in whichever
    /// direction its points are given. Default 0. Only with the precise set.
    #[doc(alias("conveyor", "tangent_speed"))]
    pub fn surface_speed(mut self, speed: f32) -> Self {
        self.surface.speed = speed;
        self
    }

    /// Coefficient of rolling resistance, dimensionless, 0 or more: a ball on level ground stops, and rests on a slope whose
    /// tangent is less. The torque is at most coefficient · radius · normal force, with the larger coefficient and radius of both
    /// geoms; polygons have the radius 0. Default 0. Only with the precise set.
    pub fn rolling_resistance(mut self, coefficient: f32) -> Self {
        self.surface.rolling_resistance = coefficient;
        self
    }

    /// The categories that the geom belongs to. Default all.
    #[doc(alias("membership", "collision_categories"))]
    pub fn categories(mut self, categories: CollisionCategory) -> Self {
        self.categories = categories;
        self
    }

    /// The categories that the geom collides with. Two geoms collide only if **both** masks have a category of the other; one of
    /// them being of a builder is enough. Default all.
    #[doc(alias("mask", "filter"))]
    pub fn collides_with(mut self, collides_with: CollisionCategory) -> Self {
        self.collides_with = collides_with;
        self
    }

    /// Group number: geoms of the same group do not collide; 0, the default, is no group.
    #[doc(alias = "collision_group")]
    pub fn group(mut self, group: i32) -> Self {
        self.group = group;
        self
    }

    /// Makes the geom a sensor: it has events and no contacts, on a body of any kind. Default false.
    pub fn sensor(mut self, is_sensor: bool) -> Self {
        self.is_sensor = is_sensor;
        self
    }

    /// The typed events of the geom. Default touches and sensors with the precise set; hits are on demand. Only with the precise
    /// set.
    pub fn events(mut self, events: WantedEvents) -> Self {
        self.events = Some(events);
        self
    }

    /// Makes the geom [one-way](crate::Objects::set_one_way): it stops bodies that come against this direction, given on the
    /// body. (0, -1) is up. Only with the precise set.
    pub fn one_way(mut self, direction: impl Into<Vector2>) -> Self {
        self.one_way = Some(direction.into());
        self
    }

    /// The number of the game that [`Geom::tag`](crate::Geom::tag) returns. Default 0.
    pub fn user_data(mut self, user_data: u64) -> Self {
        self.user_data = user_data;
        self
    }

    /// The place of the shape on the body, for queries: offset in length units, and rotation in radians.
    #[cfg(feature = "precise")]
    pub(crate) fn offset_and_rotation(&self) -> Result<(Vector2, f32)> {
        Ok((finite_vector("offset", self.offset)?, finite("rotation_offset", self.rotation_offset)?))
    }

    /// The convex pieces of the shape, for queries.
    #[cfg(feature = "precise")]
    pub(crate) fn pieces(&self) -> Result<std::sync::Arc<[farseer_precise::pieces::Piece]>> {
        let (mut corners, outline) = self.shape.outline()?;
        if !outline.is_chain() {
            corners.force_counter_clockwise_order();
        }
        Ok(crate::geom::pieces::pieces_of(&corners, outline))
    }

    /// Refuses values that are not possible, and options that the methods do not have. The shape is checked when it is made.
    pub(super) fn check(&self, methods: Methods) -> Result<()> {
        finite_vector("offset", self.offset)?;
        finite("rotation_offset", self.rotation_offset)?;
        self.density.map(|density| zero_or_more("density", density)).transpose()?;
        self.mass.map(|mass| zero_or_more("mass", mass)).transpose()?;
        zero_or_more("friction", self.friction)?;
        zero_or_more("restitution", self.restitution)?;
        methods.check_surface(check_surface(self.surface)?)?;
        if self.one_way.is_some() {
            methods.check_one_way()?;
        }
        if self.events.is_some_and(|events| events != WantedEvents::NONE) {
            methods.only_precise("typed events")?;
        }
        self.shape.check(methods)
    }
}
