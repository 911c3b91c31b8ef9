//! Ropes of beads and slider joints in three axes.

use twohalf::farseer_core::{Body, BodyId, Error, JointFactory, JointId, Objects, SliderJoint};
use twohalf::{DepthScheme, Result, TwoHalfPhysicsSimulator, Vector2, Vector3};

use crate::{Ball, Spawned, spawn};
use std::f32::consts::PI;

/// Moment of inertia of a bead, mass · px²: so great that it does not roll. Beads of a real rope are no
/// wheels: friction makes a rope lie still.
const BEAD_INERTIA: f32 = 1e20;

/// Damping ratio of a rope, dimensionless, unless it is set: 1 / sqrt(2), with which a swing comes to rest soonest without
/// swinging back by more than a twentieth.
const DAMPING_RATIO: f32 = std::f32::consts::FRAC_1_SQRT_2;

/// Frequency of the slowest swing of a hanging rope divided by that of a pendulum of its length, dimensionless: half the first
/// zero of the Bessel function J0 (Daniel Bernoulli, 1732).
const SWING_FREQUENCY: f32 = 1.202_413;

/// End of a rope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RopeEnd {
    /// A free end at a point: X, Y up and Z in px.
    Free([f32; 3]),
    /// An end fixed to a point of the world: X, Y up and Z in px.
    Fixed([f32; 3]),
    /// An end at the centre of a body, which may be moved, pushed, or carried.
    Body(BodyId),
}

/// A rope: beads, and joints that limit their distances to its length. It hangs slack where there is room,
/// swings along all three axes, and rests on obstacles. Its beads do not rotate, so they slide with friction
/// and do not roll. They collide neither with each other nor with the bodies at its ends: they have one
/// collision group, a negative number.
#[derive(Debug, Clone, Copy, PartialEq)]
#[must_use = "`spawn_rope` makes it"]
pub struct Rope {
    ends: [RopeEnd; 2],
    length: Option<f32>,
    /// Number of joints.
    parts: usize,
    /// Mass of the whole rope, mass units.
    mass: f32,
    /// Radius of a bead, px.
    radius: f32,
    /// Force at which a joint breaks, mass · px/s².
    greatest_force: f32,
    /// Damping ratio of the swing, dimensionless.
    damping_ratio: f32,
    /// Greatest angle between neighbouring parts, radians.
    greatest_bend: f32,
}

/// Ids of a [spawned](spawn_rope) rope.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SpawnedRope {
    /// Bodies from the first end to the last: the bodies at its ends, or beads, and the beads between them.
    pub bodies: Vec<BodyId>,
    /// Joints between neighbouring bodies.
    pub joints: Vec<JointId>,
    /// Joints between each body and the next but one, which limit the [bend](Rope::greatest_bend); empty without a limit.
    pub bends: Vec<JointId>,
}

impl Rope {
    /// A rope of ten parts and of mass 1, as long as the distance of its ends, with beads of radius 2 px. It bends freely, and
    /// hangs still a few seconds after it was let go.
    pub fn new(from: RopeEnd, to: RopeEnd) -> Self {
        Rope {
            ends: [from, to],
            length: None,
            parts: 10,
            mass: 1.0,
            radius: 2.0,
            greatest_force: f32::MAX,
            damping_ratio: DAMPING_RATIO,
            greatest_bend: PI,
        }
    }

    /// Sets the length, px: finite and greater than 0. A rope shorter than the distance of its ends pulls
    /// them together; a longer one sags.
    pub fn length(mut self, length: f32) -> Self {
        self.length = Some(length);
        self
    }

    /// Sets the number of parts, 1 to 1000: a rope of more parts bends better and costs more.
    pub fn parts(mut self, parts: usize) -> Self {
        self.parts = parts;
        self
    }

    /// Sets the mass of the whole rope with both ends free, finite and greater than 0. Its parts and one more
    /// share it, and an end that is attached leaves its share out. A load may have three hundred times the
    /// mass of a bead at 60 steps per second; heavier loads stretch the rope.
    pub fn mass(mut self, mass: f32) -> Self {
        self.mass = mass;
        self
    }

    /// Sets the radius of its beads, px, for collisions.
    pub fn radius(mut self, radius: f32) -> Self {
        self.radius = radius;
        self
    }

    /// Sets the force, mass · px/s², at which a joint of the rope [breaks](twohalf::Event::JointBroke).
    pub fn greatest_force(mut self, force: f32) -> Self {
        self.greatest_force = force;
        self
    }

    /// Sets the damping ratio of the swing, dimensionless, finite and at least 0: 0 for a rope that swings for ever, 0.7 for
    /// one that comes to rest soonest, which is the default. From 1 on it creeps to rest.
    ///
    /// The beads have a [linear drag](twohalf::farseer_core::Body::set_linear_drag_coefficient) of twice this ratio times the
    /// frequency of the slowest swing under the present gravity. A rope with two free ends has none and falls freely; one
    /// that tears keeps it. Bodies at its ends have their own drag alone: a heavy load swings on until it has one.
    pub fn damping_ratio(mut self, ratio: f32) -> Self {
        self.damping_ratio = ratio;
        self
    }

    /// Sets the greatest angle between neighbouring parts, radians, 0.5 to pi: a thick rope or a cable does not fold. Pi, the
    /// default, lets it bend freely.
    ///
    /// Parts of such a rope have one length, and joints keep each body at a distance from the next but one. So it may be no
    /// longer than the distance of its ends. Where it hits something it may bend by a third more. The joints of
    /// [`bends`](SpawnedRope::bends) outlast a tear: a game disposes of those about the torn joint.
    pub fn greatest_bend(mut self, angle: f32) -> Self {
        self.greatest_bend = angle;
        self
    }

    /// Fraction of its velocity that drag takes from a bead per second, 1/s. `gravity` in px/s², `length` of the rope in px.
    fn drag_rate(&self, gravity: f32, length: f32) -> Result<f32> {
        if self.ends.iter().all(|end| matches!(end, RopeEnd::Free(_))) {
            return Ok(0.0);
        }
        let rate = 2.0 * self.damping_ratio * SWING_FREQUENCY * (gravity / length).sqrt();
        if !rate.is_finite() {
            Err(Error::invalid("damping_ratio", self.damping_ratio, "small enough for a finite drag"))?;
        }
        Ok(rate)
    }

    fn check(&self) -> Result<()> {
        if !(self.damping_ratio.is_finite() && self.damping_ratio >= 0.0) {
            Err(Error::invalid("damping_ratio", self.damping_ratio, "finite and at least 0"))?;
        }
        if !(0.5..=PI).contains(&self.greatest_bend) {
            Err(Error::invalid("greatest_bend", self.greatest_bend, "0.5 to pi"))?;
        }
        if !(1..=1000).contains(&self.parts) {
            Err(Error::invalid("parts", self.parts, "1 to 1000"))?;
        }
        for (argument, value) in
            [("mass", self.mass), ("radius", self.radius), ("length", self.length.unwrap_or(1.0))]
        {
            if !(value.is_finite() && value > 0.0) {
                Err(Error::invalid(argument, value, "finite and greater than 0"))?;
            }
        }
        if !(self.greatest_force.is_finite() && self.greatest_force >= 0.0) {
            Err(Error::invalid("greatest_force", self.greatest_force, "finite and at least 0"))?;
        }
        Ok(())
    }
}

impl RopeEnd {
    /// Position of the end, px, Y up.
    fn point(self, simulator: &TwoHalfPhysicsSimulator) -> Result<Vector3> {
        match self {
            RopeEnd::Free(point) | RopeEnd::Fixed(point) if point.iter().all(|number| number.is_finite()) => {
                Ok(Vector3::from(point))
            }
            RopeEnd::Free(point) | RopeEnd::Fixed(point) => {
                Err(Error::invalid("end", point, "finite").into())
            }
            RopeEnd::Body(body) => {
                let stale = Error::StaleId { argument: "end" };
                let z = simulator.body(body).ok_or(stale.clone())?.position3d().z;
                let middle = simulator.core().body(body).ok_or(stale)?.position();
                Ok(Vector3::new(middle.x, -middle.y, z))
            }
        }
    }
}

/// Adds a rope to the simulator, stretched between its ends: it takes part from the next update.
///
/// ```
/// use twohalf::{TwoHalfPhysicsSimulator, Vector2};
/// use twohalf_factories::{Ball, Rope, RopeEnd, spawn, spawn_rope};
///
/// let mut simulator = TwoHalfPhysicsSimulator::with_gravity(480, Vector2::new(0.0, 900.0))?;
/// let lamp = spawn(&mut simulator, Ball::new(10.0).mass(5.0).at([100.0, 190.0, 120.0]))?;
/// // Held out to the back of the lane, where it is let go.
/// let rope = Rope::new(RopeEnd::Fixed([100.0, 250.0, 40.0]), RopeEnd::Body(lamp.body));
/// let rope = spawn_rope(&mut simulator, rope)?;
/// assert_eq!((rope.bodies.len(), rope.joints.len()), (11, 10));
/// let mut nearest = f32::MAX;
/// for _ in 0..120 {
///     simulator.update(1.0 / 120.0);
///     nearest = nearest.min(simulator.body(lamp.body).unwrap().position3d().z);
/// }
/// // It has swung to the front.
/// assert!(nearest < -30.0);
/// # Ok::<(), twohalf::Error>(())
/// ```
///
/// # Errors
/// Another scheme than [`DepthScheme::Precise`]; a stale body; ends that are not finite, or at one point
/// without a length; numbers out of the ranges of [`Rope`]. After a failed call no part of it takes part in
/// the next update, and none is left after it.
pub fn spawn_rope(simulator: &mut TwoHalfPhysicsSimulator, rope: Rope) -> Result<SpawnedRope> {
    rope.check()?;
    if simulator.depth_scheme() != DepthScheme::Precise {
        Err(Error::NotSupported { what: "ropes", methods: "faithful and thesis" })?;
    }
    let [from, to] = [rope.ends[0].point(simulator)?, rope.ends[1].point(simulator)?];
    let length = rope.length.unwrap_or((to - from).norm());
    if !(length.is_finite() && length > 0.0) {
        Err(Error::invalid("length", length, "finite and greater than 0"))?;
    }
    // Parts of one length have no room for a slack rope between its ends.
    if rope.greatest_bend < PI && length > 1.0001 * (to - from).norm() {
        Err(Error::invalid("length", length, "at most the distance of the ends, if its bend is limited"))?;
    }
    let mut made = SpawnedRope { bodies: Vec::new(), joints: Vec::new(), bends: Vec::new() };
    let mut own = Vec::new();
    match lay(simulator, &rope, [from, to], length, (&mut made, &mut own)) {
        Ok(()) => Ok(made),
        Err(error) => {
            made.joints.into_iter().chain(made.bends).try_for_each(|joint| simulator.dispose(joint))?;
            own.into_iter().try_for_each(|body| simulator.dispose(body))?;
            Err(error)
        }
    }
}

/// Creates bodies and joints, and lists the rope's own bodies.
fn lay(
    simulator: &mut TwoHalfPhysicsSimulator,
    rope: &Rope,
    [from, to]: [Vector3; 2],
    length: f32,
    (made, own): (&mut SpawnedRope, &mut Vec<BodyId>),
) -> Result<()> {
    let part = length / rope.parts as f32;
    let drag_rate = rope.drag_rate(simulator.core().gravity().norm(), length)?;
    let nearest = if rope.greatest_bend < PI { part } else { 0.0 };
    for at in 0..=rope.parts {
        let point = from + (to - from) * (at as f32 / rope.parts as f32);
        let end = match at {
            0 => rope.ends[0],
            _ if at == rope.parts => rope.ends[1],
            _ => RopeEnd::Free(point.into()),
        };
        let body = match end {
            RopeEnd::Body(body) => body,
            RopeEnd::Fixed(_) => hook(simulator, point, own)?,
            RopeEnd::Free(_) => bead(simulator, rope, point, drag_rate, own)?,
        };
        if let Some(&before) = made.bodies.last() {
            let tied = simulator
                .edit_objects(|objects| tie(objects, [before, body], [nearest, part], rope.greatest_force));
            made.joints.push(tied?);
        }
        let last_but_one = made.bodies.len().checked_sub(2).map(|at| made.bodies[at]);
        if let Some(before) = last_but_one.filter(|_| rope.greatest_bend < PI) {
            let apart = [2.0 * part * (rope.greatest_bend / 2.0).cos(), f32::MAX];
            let tied =
                simulator.edit_objects(|objects| tie(objects, [before, body], apart, rope.greatest_force));
            made.bends.push(tied?);
        }
        made.bodies.push(body);
    }
    Ok(())
}

/// A fixed end: a static body without geoms.
fn hook(simulator: &mut TwoHalfPhysicsSimulator, point: Vector3, own: &mut Vec<BodyId>) -> Result<BodyId> {
    let mut hook = Body::new();
    hook.set_is_static(true);
    let hook = simulator.create_body(hook);
    own.push(hook);
    simulator.add(hook)?;
    if let Some(mut view) = simulator.body_mut(hook) {
        view.set_position3d(point);
    }
    Ok(hook)
}

fn bead(
    simulator: &mut TwoHalfPhysicsSimulator,
    rope: &Rope,
    point: Vector3,
    drag_rate: f32,
    own: &mut Vec<BodyId>,
) -> Result<BodyId> {
    let mass = rope.mass / (rope.parts as f32 + 1.0);
    let at = [point.x, point.y - rope.radius, point.z];
    let Spawned { body, geom } = spawn(simulator, Ball::new(rope.radius).mass(mass).at(at))?;
    own.push(body);
    if let Some(mut view) = simulator.body_mut(body) {
        view.core_mut().set_moment_of_inertia(BEAD_INERTIA)?;
        view.core_mut().set_linear_drag_coefficient(drag_rate * mass);
    }
    if let Some(settings) = simulator.geom_mut(geom) {
        settings.set_collision_group(-1 - own[0].slot() as i32);
    }
    for end in rope.ends {
        // Beads do not collide with the bodies at the ends.
        let RopeEnd::Body(end) = end else { continue };
        for other in simulator.core().geoms_of(end).to_vec() {
            simulator.ignore_collision_with(geom, other)?;
        }
    }
    Ok(body)
}

/// A joint that limits the distance of two bodies, px.
fn tie(
    objects: &mut Objects,
    [before, body]: [BodyId; 2],
    [nearest, farthest]: [f32; 2],
    greatest_force: f32,
) -> Result<JointId, Error> {
    let zero = Vector2::zeros();
    let joint = JointFactory::create_slider_joint(objects, before, zero, body, zero, nearest, farthest)?;
    objects.joint_as_mut::<SliderJoint>(joint)?.set_slop(0.0)?;
    objects[joint].set_greatest_force(greatest_force)?;
    objects.add(joint)?;
    Ok(joint)
}
