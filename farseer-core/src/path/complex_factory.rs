//! Chains, tracks and gravity controllers in one call (behaviour chapter 13, section 6).

use serde::{Deserialize, Serialize};

use super::{LinkSettings, LinkType, Path};
use crate::body::BodyId;
use crate::controllers::{ControllerId, GravityController, GravityType};
use crate::factories::JointFactory;
use crate::math::Vector2;
use crate::math::finite::finite_vector;
use crate::math::vector2::distance;
use crate::objects::Objects;
use crate::shape::Vertices;
use crate::{Error, Result};

const CHAIN_BIAS_FACTOR: f32 = 0.01;
const CHAIN_SOFTNESS: f32 = 0.05;

/// Default ratio of a link's height to its width, dimensionless: one third, as the original rounds it.
const DEFAULT_HEIGHT_RATIO: f32 = f32::from_bits(0x3EAA_AAAB);

/// Makes chains and tracks of linked bodies. Its settings are those of the links; in the original they are global.
///
/// The plain methods return a [`Path`] whose objects take no part yet; those ending in `_in` also add them. A chain has
/// no geoms: [`Path::create_geoms`] makes them.
///
/// ```
/// use farseer_core::{ComplexFactory, LinkType, PhysicsSimulator, math::Vector2};
///
/// let mut simulator = PhysicsSimulator::new(Vector2::new(0.0, 100.0))?;
/// let (start, end) = (Vector2::new(0.0, 0.0), Vector2::new(100.0, 0.0));
/// // 20 by 10 units, mass 1, held at the start.
/// let mut chain = ComplexFactory::default().create_pinned_chain(
///     &mut simulator, start, end, 20.0, 10.0, 1.0, true, false, LinkType::RevoluteJoint,
/// )?;
/// chain.create_geoms(&mut simulator, 1)?;
/// chain.add_to_physics_simulator(&mut simulator);
/// # Ok::<(), farseer_core::Error>(())
/// ```
#[doc(alias = "ComplexFactory.Instance")]
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ComplexFactory {
    /// Minimum distance of slider joints, in length units. Default 0.
    #[doc(alias = "Min")]
    pub min: f32,
    /// Maximum distance of slider joints, in length units. Default 0.
    #[doc(alias = "Max")]
    pub max: f32,
    /// Stiffness of springs, force per length, in mass units/s². With the default 0 springs have no effect.
    #[doc(alias = "SpringConstant")]
    pub spring_constant: f32,
    /// Damping of springs, force per velocity, in mass units/s. Default 0.
    #[doc(alias = "DampingConstant")]
    pub damping_constant: f32,
    /// Factor of the rest length of springs in chains, dimensionless; tracks ignore it. Default 1.
    #[doc(alias = "SpringRestLengthFactor")]
    pub spring_rest_length_factor: f32,
}

impl Default for ComplexFactory {
    fn default() -> Self {
        ComplexFactory {
            min: 0.0,
            max: 0.0,
            spring_constant: 0.0,
            damping_constant: 0.0,
            spring_rest_length_factor: 1.0,
        }
    }
}

/// Methods ending in `_in`: the plain method, and adding the objects to the simulator.
macro_rules! added {
    ($($(#[$attribute:meta])* $name:ident = $plain:ident($($argument:ident: $type:ty),*);)*) => {$(
        #[doc = concat!("[`", stringify!($plain), "`](Self::", stringify!($plain), "), added to the simulator.")]
        ///
        /// # Errors
        /// As the plain method.
        $(#[$attribute])*
        pub fn $name(&self, simulator: &mut Objects, $($argument: $type),*) -> Result<Path> {
            let path = self.$plain(simulator, $($argument),*)?;
            path.add_to_physics_simulator(simulator);
            Ok(path)
        }
    )*};
}

/// Chains. Their joints have a bias factor of 0.01 and a softness of 0.05.
impl ComplexFactory {
    /// Bodies in a row from `start` to `end`, each linked with the next. They are `width` apart, and as many as the
    /// distance requires.
    ///
    /// # Errors
    /// A number that is not finite; a width, height or mass that is not greater than 0; a width greater than the
    /// distance, with which the original loops forever.
    #[doc(alias = "CreateChain(Vector2, Vector2, float, float, float, LinkType)")]
    #[allow(clippy::too_many_arguments)] // The original's signature.
    pub fn create_chain(
        &self,
        simulator: &mut Objects,
        start: Vector2,
        end: Vector2,
        width: f32,
        height: f32,
        mass: f32,
        link_type: LinkType,
    ) -> Result<Path> {
        self.create_pinned_chain(simulator, start, end, width, height, mass, false, false, link_type)
    }

    /// A chain of a number of links, whose width follows from the distance. Without `height` the links are a third as
    /// high as wide. As bodies are placed with a little space between them the chain may have one link more or less.
    ///
    /// # Errors
    /// As [`create_chain`](Self::create_chain); a number of links that is not greater than 0.
    #[doc(alias(
        "CreateChain(Vector2, Vector2, int, float, float, LinkType)",
        "CreateChain(Vector2, Vector2, int, float, LinkType)"
    ))]
    #[allow(clippy::too_many_arguments)] // The original's signature.
    pub fn create_chain_of_links(
        &self,
        simulator: &mut Objects,
        start: Vector2,
        end: Vector2,
        links: i32,
        height: Option<f32>,
        mass: f32,
        link_type: LinkType,
    ) -> Result<Path> {
        if links <= 0 {
            return Err(Error::invalid("links", links, "greater than 0"));
        }
        let width = distance(start, end) / links as f32;
        let height = height.unwrap_or(width * DEFAULT_HEIGHT_RATIO);
        self.create_chain(simulator, start, end, width, height, mass, link_type)
    }

    /// A chain whose ends may be pinned: there the first or last body turns about a point of the world.
    ///
    /// # Errors
    /// As [`create_chain`](Self::create_chain).
    #[doc(alias = "CreateChain(Vector2, Vector2, float, float, float, bool, bool, LinkType)")]
    #[allow(clippy::too_many_arguments)] // The original's signature.
    pub fn create_pinned_chain(
        &self,
        simulator: &mut Objects,
        start: Vector2,
        end: Vector2,
        width: f32,
        height: f32,
        mass: f32,
        pin_start: bool,
        pin_end: bool,
        link_type: LinkType,
    ) -> Result<Path> {
        self.create_chain_with_link_width(
            simulator, start, end, width, height, width, mass, pin_start, pin_end, link_type,
        )
    }

    /// A chain whose bodies are about `link_width` apart, whatever their width.
    ///
    /// # Errors
    /// As [`create_chain`](Self::create_chain), with the link width instead of the width.
    #[doc(alias = "CreateChain(Vector2, Vector2, float, float, float, float, bool, bool, LinkType)")]
    #[allow(clippy::too_many_arguments)] // The original's signature.
    pub fn create_chain_with_link_width(
        &self,
        simulator: &mut Objects,
        start: Vector2,
        end: Vector2,
        width: f32,
        height: f32,
        link_width: f32,
        mass: f32,
        pin_start: bool,
        pin_end: bool,
        link_type: LinkType,
    ) -> Result<Path> {
        finite_vector("start", start)?;
        finite_vector("end", end)?;
        let links = self.links(link_type, self.spring_rest_length_factor);
        links.check()?;
        let mut path = Path::with_link_width(width, height, link_width, mass, false)?;
        path.add(start)?;
        path.add(Vertices::find_midpoint(start, end))?;
        path.add(end)?;
        path.update(simulator)?;
        let pins = (pin_start.then_some(start), pin_end);
        finish_or_discard(path, simulator, |path, simulator| link_chain(path, simulator, &links, pins))
    }

    added! {
        #[allow(clippy::too_many_arguments)] // The original's signature.
        create_chain_in = create_chain(
            start: Vector2, end: Vector2, width: f32, height: f32, mass: f32, link_type: LinkType
        );
        #[allow(clippy::too_many_arguments)] // The original's signature.
        create_chain_of_links_in = create_chain_of_links(
            start: Vector2, end: Vector2, links: i32, height: Option<f32>, mass: f32, link_type: LinkType
        );
        #[allow(clippy::too_many_arguments)] // The original's signature.
        create_pinned_chain_in = create_pinned_chain(
            start: Vector2, end: Vector2, width: f32, height: f32, mass: f32, pin_start: bool, pin_end: bool,
            link_type: LinkType
        );
        #[allow(clippy::too_many_arguments)] // The original's signature.
        create_chain_with_link_width_in = create_chain_with_link_width(
            start: Vector2, end: Vector2, width: f32, height: f32, link_width: f32, mass: f32, pin_start: bool,
            pin_end: bool, link_type: LinkType
        );
    }

    fn links(&self, link_type: LinkType, spring_rest_length_factor: f32) -> LinkSettings {
        let ComplexFactory { min, max, spring_constant, damping_constant, .. } = *self;
        LinkSettings { link_type, min, max, spring_constant, damping_constant, spring_rest_length_factor }
    }
}

/// Tracks. Their joints have a bias factor of 0.2 and a softness of 0.01.
impl ComplexFactory {
    /// Bodies with geoms along the curve through points, each linked with the next, and the last with the first if the
    /// track is endless. The geoms are in one collision group, so that they do not collide with each other.
    ///
    /// # Errors
    /// As [`Path::update`] and [`Path::create_geoms`]; a number that is not finite.
    #[doc(alias = "CreateTrack")]
    #[allow(clippy::too_many_arguments)] // The original's signature.
    pub fn create_track(
        &self,
        simulator: &mut Objects,
        points: &[Vector2],
        width: f32,
        height: f32,
        mass: f32,
        endless: bool,
        collision_group: i32,
        link_type: LinkType,
    ) -> Result<Path> {
        let links = self.links(link_type, 1.0);
        links.check()?;
        let mut path = Path::new(width, height, mass, endless)?;
        for &point in points {
            path.add(point)?;
        }
        path.update(simulator)?;
        finish_or_discard(path, simulator, |path, simulator| {
            path.create_geoms(simulator, collision_group)?;
            path.link(simulator, &links)
        })
    }

    added! {
        #[allow(clippy::too_many_arguments)] // The original's signature.
        create_track_in = create_track(
            points: &[Vector2], width: f32, height: f32, mass: f32, endless: bool, collision_group: i32,
            link_type: LinkType
        );
    }
}

/// Gravity.
impl ComplexFactory {
    /// A gravity controller whose bodies attract others, added to the simulator. `strength` is the acceleration at
    /// distance 1 in length units/s², `radius` the maximum distance in length units. The original's overload without a
    /// type is [`GravityType::Linear`].
    ///
    /// # Errors
    /// Numbers that are not finite.
    #[doc(alias = "CreateGravityController(PhysicsSimulator, List<Body>, GravityType, float, float)")]
    pub fn create_gravity_controller(
        simulator: &mut Objects,
        bodies: &[BodyId],
        gravity_type: GravityType,
        strength: f32,
        radius: f32,
    ) -> Result<ControllerId> {
        let controller = GravityController::with_bodies(bodies.to_vec(), strength, radius)?;
        add_gravity(simulator, controller, gravity_type)
    }

    /// A gravity controller whose points attract bodies, added to the simulator. See
    /// [`create_gravity_controller`](Self::create_gravity_controller).
    ///
    /// # Errors
    /// Numbers that are not finite.
    #[doc(alias = "CreateGravityController(PhysicsSimulator, List<Vector2>, GravityType, float, float)")]
    pub fn create_point_gravity_controller(
        simulator: &mut Objects,
        points: &[Vector2],
        gravity_type: GravityType,
        strength: f32,
        radius: f32,
    ) -> Result<ControllerId> {
        let controller = GravityController::with_points(points.to_vec(), strength, radius)?;
        add_gravity(simulator, controller, gravity_type)
    }
}

fn add_gravity(
    simulator: &mut Objects,
    mut controller: GravityController,
    gravity_type: GravityType,
) -> Result<ControllerId> {
    controller.set_gravity_type(gravity_type);
    let controller = simulator.create_controller(controller)?;
    simulator.add(controller)?;
    Ok(controller)
}

/// Links the bodies of a chain and pins its ends: the first body where the chain starts, the last one at the last point
/// that was evaluated when the bodies were placed.
fn link_chain(
    path: &mut Path,
    simulator: &mut Objects,
    links: &LinkSettings,
    (start, pin_end): (Option<Vector2>, bool),
) -> Result<()> {
    path.link(simulator, links)?;
    let ends = (path.bodies().first().copied(), path.bodies().last().copied());
    let end = path.control_points().last().copied().filter(|_| pin_end);
    for (body, anchor) in [(ends.0, start), (ends.1, end)] {
        if let (Some(body), Some(anchor)) = (body, anchor) {
            path.add_joint(JointFactory::create_fixed_revolute_joint(simulator, body, anchor)?);
        }
    }
    for &joint in path.joints() {
        let joint = &mut simulator[joint];
        joint.set_bias_factor(CHAIN_BIAS_FACTOR)?;
        joint.set_softness(CHAIN_SOFTNESS)?;
    }
    Ok(())
}

/// Completes a path whose bodies are made. If that fails, all its objects are removed again.
fn finish_or_discard(
    mut path: Path,
    simulator: &mut Objects,
    finish: impl FnOnce(&mut Path, &mut Objects) -> Result<()>,
) -> Result<Path> {
    match finish(&mut path, simulator) {
        Ok(()) => Ok(path),
        Err(error) => {
            simulator.discard(path.objects());
            Err(error)
        }
    }
}
