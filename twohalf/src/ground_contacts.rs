//! Where objects touch their ground, and friction along Z.
//!
//! The ground needs no geom: a ball touches it in one point, a prism in at most two. The contacts are handed
//! to the 2D solver, which holds the body up and rubs along X; friction along Z is one row per body, solved
//! after each of the solver's iterations.

use farseer_core::math::Vector2;
use farseer_core::{
    BodyId, Contact, ContactId, FrictionType, GeomId, GeomRef, PhysicsSimulator, SurfaceContacts,
};
use serde::{Deserialize, Serialize};

use crate::depth::{DepthBody, DepthProfile, Depths};
use crate::ground::Ground;

/// Most points in which a body touches its ground.
const MAX_POINTS: usize = 2;

/// Stands for the ground in contact ids; no geom has this creation number.
const GROUND: u32 = u32::MAX;

/// The ground's normal in the plane of the 2D engine: up.
const UP: Vector2 = Vector2::new(0.0, -1.0);

/// Impulses of the ground's contacts in the last update, by vertex: the next solve begins with them.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct RememberedImpulses {
    /// Vertex, impulse along the normal, impulse along the tangent.
    points: [Option<(i32, f32, f32)>; MAX_POINTS],
}

impl RememberedImpulses {
    fn of(&self, vertex: i32) -> (f32, f32) {
        let known = self.points.iter().flatten().find(|(known, _, _)| *known == vertex);
        known.map_or((0.0, 0.0), |&(_, normal, tangent)| (normal, tangent))
    }

    fn normal_sum(&self) -> f32 {
        self.points.iter().flatten().map(|(_, normal, _)| normal).sum()
    }

    pub(crate) fn is_valid(&self) -> bool {
        self.points.iter().flatten().all(|(_, normal, tangent)| normal.is_finite() && tangent.is_finite())
    }
}

/// The points in which an object touches its ground.
#[derive(Debug, Clone, Copy)]
struct Touch {
    contacts: [Contact; MAX_POINTS],
    count: usize,
}

impl Touch {
    fn none() -> Self {
        Touch { contacts: [Contact::default(); MAX_POINTS], count: 0 }
    }

    fn add(&mut self, geom: GeomRef<'_>, vertex: i32, position: Vector2, remembered: &RememberedImpulses) {
        let id = ContactId { geom1: geom.id(), vertex, geom2: GROUND };
        let (normal, tangent) = remembered.of(vertex);
        self.contacts[self.count] =
            Contact::new(position, UP, -position.y, id).with_impulses(normal, tangent);
        self.count += 1;
    }

    fn contacts(&self) -> &[Contact] {
        &self.contacts[..self.count]
    }

    /// The lowest point of a ball, if it is below the ground.
    fn of_ball(geom: GeomRef<'_>, radius: f32, remembered: &RememberedImpulses) -> Self {
        let mut touch = Touch::none();
        let centre = geom.position();
        let lowest = Vector2::new(centre.x, centre.y + radius);
        if lowest.y > 0.0 {
            touch.add(geom, 0, lowest, remembered);
        }
        touch
    }

    /// The deepest vertex and the vertex below the ground that is farthest from it along x. Where several are
    /// equally deep, within `slop`, the first one is the one farthest from the second: the points of a face
    /// that lies on the ground are its ends, whichever of its vertices rounding makes the deepest.
    fn of_prism(geom: GeomRef<'_>, slop: f32, remembered: &RememberedImpulses) -> Self {
        let mut touch = Touch::none();
        let vertices = geom.world_vertices();
        let below = || vertices.iter().enumerate().filter(|(_, vertex)| vertex.y > 0.0);
        let Some(deepest) = best(below(), |vertex| vertex.y) else { return touch };
        let floor = vertices[deepest].y - slop;
        let from = |index: usize| {
            let x = vertices[index].x;
            move |vertex: Vector2| (vertex.x - x).abs()
        };
        let second = best(below(), from(deepest)).unwrap_or(deepest);
        let first = best(below().filter(|(_, vertex)| vertex.y >= floor), from(second)).unwrap_or(deepest);
        touch.add(geom, first as i32, vertices[first], remembered);
        if vertices[second].x != vertices[first].x {
            touch.add(geom, second as i32, vertices[second], remembered);
        }
        touch
    }
}

/// Index of the first vertex for which `value` is greatest.
fn best<'a>(
    vertices: impl Iterator<Item = (usize, &'a Vector2)>,
    value: impl Fn(Vector2) -> f32,
) -> Option<usize> {
    let mut best: Option<(usize, f32)> = None;
    for (index, &vertex) in vertices {
        let value = value(vertex);
        if best.is_none_or(|(_, greatest)| value > greatest) {
            best = Some((index, value));
        }
    }
    best.map(|(index, _)| index)
}

/// A body on its ground, in the solver of the current update.
#[derive(Debug, Clone)]
pub(crate) struct GroundRow {
    body: BodyId,
    surface: SurfaceContacts,
    vertices: [i32; MAX_POINTS],
    friction: f32,
    /// Arm of the friction along Z about the x axis: 0 for what does not roll.
    radius: f32,
    inverse_mass: f32,
    inverse_inertia: f32,
    velocity_z: f32,
    angular_velocity_x: f32,
    impulse_z: f32,
}

/// Hands the contacts of a geom with its body's ground to the solver. `None` if it does not touch, or nothing is
/// to hold it.
pub(crate) fn touch_ground(
    core: &mut PhysicsSimulator,
    state: &mut DepthBody,
    profile: DepthProfile,
    geom: GeomId,
) -> Option<GroundRow> {
    let remembered = std::mem::take(&mut state.remembered);
    let view = core.geom(geom)?;
    let body = view.body();
    if !view.collision_enabled() || !view.collision_response_enabled() {
        return None;
    }
    let touch = match profile {
        DepthProfile::Round { radius } => Touch::of_ball(view, radius, &remembered),
        DepthProfile::Prism { .. } => Touch::of_prism(view, core.allowed_penetration(), &remembered),
    };
    let deepest = touch.contacts().first()?.position;
    let (friction, restitution) = combined(core.friction_type(), &state.ground, view);
    let moving = core.body(body)?;
    let radius = match profile {
        DepthProfile::Round { radius } => radius,
        DepthProfile::Prism { .. } => 0.0,
    };
    let slip = Vector2::new(
        moving.get_velocity_at_world_point(deepest).x,
        state.velocity_z + state.angular_velocity_x * radius,
    );
    let (inverse_mass, inverse_inertia) = (moving.inverse_mass(), moving.inverse_moment_of_inertia());
    let holds = friction * remembered.normal_sum() * inverse_mass;
    let along_x = friction * share_of_x(slip, holds);
    Some(GroundRow {
        body,
        surface: core.add_surface_contacts(body, touch.contacts(), along_x, restitution)?,
        vertices: touch.contacts.map(|contact| contact.id.vertex),
        friction,
        radius,
        inverse_mass,
        inverse_inertia,
        velocity_z: state.velocity_z,
        angular_velocity_x: state.angular_velocity_x,
        impulse_z: 0.0,
    })
}

/// The part of the friction coefficient that the 2D solver gets.
///
/// Friction acts against the direction in which the point slides, in the plane of X and Z, and its limit is a
/// disc. The solver knows X only and would take all of the disc for it, so that a body sliding askew would be
/// slowed along X first. It gets the part that the direction of the slip `(x, z)` gives to X. A body that last
/// update's pressure can hold (`holds`, a change of velocity) does not slide: it may take what it needs.
fn share_of_x(slip: Vector2, holds: f32) -> f32 {
    let speed = (slip.x * slip.x + slip.y * slip.y).sqrt();
    if slip.y == 0.0 || speed <= holds { 1.0 } else { slip.x.abs() / speed }
}

/// Friction and restitution of a geom on its ground, combined as those of two geoms.
fn combined(friction_type: FrictionType, ground: &Ground, geom: GeomRef<'_>) -> (f32, f32) {
    let (a, b) = (ground.friction_coefficient(), geom.friction_coefficient());
    let friction = match friction_type {
        FrictionType::Average => (a + b) / 2.0,
        FrictionType::Minimum => farseer_core::math::scalar::min(a, b),
    };
    (friction, (ground.restitution_coefficient() + geom.restitution_coefficient()) * 0.5)
}

impl GroundRow {
    /// Speed along Z of the point that touches.
    fn slip(&self) -> f32 {
        self.velocity_z + self.angular_velocity_x * self.radius
    }

    /// Friction along Z, within what normal and tangent impulses of the contacts leave of the disc.
    pub(crate) fn solve(&mut self, core: &PhysicsSimulator) {
        let left_of = |(normal, tangent): (f32, f32)| {
            let limit = (self.friction * normal).max(0.0);
            (limit * limit - tangent * tangent).max(0.0).sqrt()
        };
        let limit: f32 = core.surface_impulses(self.surface).map(left_of).sum();
        let mass = 1.0 / (self.inverse_mass + self.radius * self.radius * self.inverse_inertia);
        let wanted = self.impulse_z - self.slip() * mass;
        let impulse = wanted.clamp(-limit, limit);
        let change = impulse - self.impulse_z;
        self.impulse_z = impulse;
        self.velocity_z += change * self.inverse_mass;
        self.angular_velocity_x += change * self.radius * self.inverse_inertia;
        if impulse == wanted && self.radius == 0.0 {
            // What is left is rounding.
            self.velocity_z = 0.0;
        }
    }

    /// Writes velocities back and keeps the impulses for the next update. A body whose velocity would not be
    /// finite keeps what it had; answers its id.
    pub(crate) fn finish(&self, core: &PhysicsSimulator, depths: &mut Depths) -> Option<BodyId> {
        let state = depths.bodies.get_mut(self.body)?;
        if !self.velocity_z.is_finite() || !self.angular_velocity_x.is_finite() {
            return Some(self.body);
        }
        state.velocity_z = self.velocity_z;
        state.angular_velocity_x = self.angular_velocity_x;
        let impulses = core.surface_impulses(self.surface);
        for ((kept, &vertex), (normal, tangent)) in
            state.remembered.points.iter_mut().zip(&self.vertices).zip(impulses)
        {
            *kept = Some((vertex, normal, tangent));
        }
        None
    }
}
