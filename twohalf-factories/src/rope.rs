//! Ropes of beads and slider joints in three axes.

use twohalf::farseer_core::{Body, BodyId, Error, JointFactory, JointId, Objects, SliderJoint};
use twohalf::{DepthScheme, Result, TwoHalfPhysicsSimulator, Vector2, Vector3};

use crate::{Ball, Spawned, spawn};

/// Moment of inertia of a bead, mass · px²: so great that it does not roll. Beads of a real rope are no
/// wheels: friction makes a rope lie still.
const BEAD_INERTIA: f32 = 1e20;

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
}

/// Ids of a [spawned](spawn_rope) rope.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SpawnedRope {
    /// Bodies from the first end to the last: the bodies at its ends, or beads, and the beads between them.
    pub bodies: Vec<BodyId>,
    /// Joints between neighbouring bodies.
    pub joints: Vec<JointId>,
}

impl Rope {
    /// A rope of ten parts and of mass 1, as long as the distance of its ends, with beads of radius 2 px.
    pub fn new(from: RopeEnd, to: RopeEnd) -> Self {
        Rope { ends: [from, to], length: None, parts: 10, mass: 1.0, radius: 2.0, greatest_force: f32::MAX }
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

    fn check(&self) -> Result<()> {
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
    let mut made = SpawnedRope { bodies: Vec::new(), joints: Vec::new() };
    let mut own = Vec::new();
    match lay(simulator, &rope, [from, to], length, (&mut made, &mut own)) {
        Ok(()) => Ok(made),
        Err(error) => {
            made.joints.into_iter().try_for_each(|joint| simulator.dispose(joint))?;
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
            RopeEnd::Free(_) => bead(simulator, rope, point, own)?,
        };
        if let Some(&before) = made.bodies.last() {
            let tied =
                simulator.edit_objects(|objects| tie(objects, [before, body], part, rope.greatest_force));
            made.joints.push(tied?);
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
    own: &mut Vec<BodyId>,
) -> Result<BodyId> {
    let mass = rope.mass / (rope.parts as f32 + 1.0);
    let at = [point.x, point.y - rope.radius, point.z];
    let Spawned { body, geom } = spawn(simulator, Ball::new(rope.radius).mass(mass).at(at))?;
    own.push(body);
    if let Some(mut view) = simulator.body_mut(body) {
        view.core_mut().set_moment_of_inertia(BEAD_INERTIA)?;
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

fn tie(
    objects: &mut Objects,
    [before, body]: [BodyId; 2],
    part: f32,
    greatest_force: f32,
) -> Result<JointId, Error> {
    let zero = Vector2::zeros();
    let joint = JointFactory::create_slider_joint(objects, before, zero, body, zero, 0.0, part)?;
    objects.joint_as_mut::<SliderJoint>(joint)?.set_slop(0.0)?;
    objects[joint].set_greatest_force(greatest_force)?;
    objects.add(joint)?;
    Ok(joint)
}
