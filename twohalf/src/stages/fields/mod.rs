//! Force fields in an update.

mod immersion;

use farseer_core::depth::DepthAxisMut;
use farseer_core::{Body, BodyId, PhysicsSimulator};

use super::report::Report;
use crate::Vector3;
use crate::depth::{DepthScheme, DepthState, Field, Fluid, World, is_movable};
use crate::events::Event;
use immersion::{Container, immersed};

pub(super) use immersion::ClipBuffer;
pub(crate) use immersion::immersion_of;

/// Forces of all fields on one body, in the frame of the plane, y down.
#[derive(Debug, Clone, Copy, Default)]
struct FieldForces {
    /// Acceleration of the body by all fields without drag, px/s².
    acceleration: [f64; 3],
    /// Torque on the body about the depth axis, mass · px²/s².
    torque: f64,
    /// Drag rate of all fluids, 1/s.
    rate: f64,
    /// Sum of the flow velocities times their drag rates, px/s².
    flow: [f64; 3],
}

/// Applies all fields to all dynamic bodies.
pub(super) fn act(
    core: &mut PhysicsSimulator,
    world: &mut World,
    report: &mut Report,
    scratch: &mut ClipBuffer,
    dt: f32,
) {
    if world.fields.is_empty() {
        return;
    }
    for at in 0..core.body_list().len() {
        let id = core.body_list()[at];
        if !is_movable(core, id) {
            continue;
        }
        if let Some((force, torque)) = field_force(core, world, id, f64::from(dt), scratch) {
            apply_field_force(core, world, report, id, (force, torque));
        }
    }
}

/// Returns force and torque of all fields on a body, in the frame of the plane; `None` if no field acts on the body.
fn field_force(
    core: &PhysicsSimulator,
    world: &World,
    id: BodyId,
    dt: f64,
    scratch: &mut ClipBuffer,
) -> Option<([f32; 3], f32)> {
    let body = core.body(id).filter(|body| body.inverse_mass() > 0.0)?;
    let depths = &world.depths;
    let mut sum = FieldForces::default();
    let place = Vector3::new(body.position().x, -body.position().y, depths.z_of(id));
    for (_, field) in world.fields.iter() {
        match field {
            Field::Well(well) if !body.ignore_gravity() => {
                let [x, y, z]: [f32; 3] = well.acceleration_at(place).into();
                sum.accelerate([x, -y, z].map(f64::from));
            }
            Field::Well(_) => {}
            Field::Fluid(fluid) => immerse(core, depths, (id, body), fluid, &mut sum, scratch),
        }
    }
    let velocity_z = depths.bodies.get(id).map_or(0.0, |state| state.velocity_z);
    let mass = f64::from(body.mass());
    let gravity = core.gravity() * if body.ignore_gravity() { 0.0 } else { body.gravity_scale() };
    // Over a step, the precise set moves a body with the mean velocity as far as gravity causes it, and with
    // the final velocity as far as forces do. A body that a field holds against gravity therefore moves by
    // half a step of gravity less than its velocity says.
    let ahead = if world.scheme == DepthScheme::Precise { 0.5 * dt as f32 } else { 0.0 };
    let in_plane = body.linear_velocity() - gravity * ahead;
    let velocity = [in_plane.x, in_plane.y, velocity_z].map(f64::from);
    let spin = f64::from(body.angular_velocity());
    let inertia = f64::from(body.moment_of_inertia());
    let push = sum.over(velocity, [gravity.x, gravity.y, 0.0].map(f64::from), dt);
    let torque = sum.torque - spin * inertia * decay_fraction(sum.rate, dt) / dt;
    let force = push.map(|push| (push * mass) as f32);
    (force != [0.0; 3] || torque != 0.0).then_some((force, torque as f32))
}

/// Adds buoyancy and drag of a fluid on all immersed geoms of a body.
fn immerse(
    core: &PhysicsSimulator,
    depths: &DepthState,
    (id, body): (BodyId, &Body),
    fluid: &Fluid,
    sum: &mut FieldForces,
    scratch: &mut ClipBuffer,
) {
    let container = Container::new(&fluid.region);
    let inverse_mass = f64::from(body.inverse_mass());
    let [flow_x, flow_y, flow_z]: [f32; 3] = fluid.flow.into();
    let flow = [flow_x, -flow_y, flow_z].map(f64::from);
    for &geom in core.geoms_of(id) {
        let responds = core.geom(geom).is_some_and(|geom| geom.collision_response_enabled());
        if !responds {
            continue;
        }
        let Some(part) = immersed(core, depths, geom, &container, scratch) else { continue };
        let lift = f64::from(fluid.density) * part.volume;
        let [up_x, up_y] = [core.gravity().x, core.gravity().y].map(|part| -f64::from(part) * lift);
        sum.accelerate([up_x * inverse_mass, up_y * inverse_mass, 0.0]);
        let arm =
            [part.middle[0] - f64::from(body.position().x), part.middle[1] - f64::from(body.position().y)];
        sum.torque += arm[0] * up_y - arm[1] * up_x;
        let rate = f64::from(fluid.drag) * part.volume * inverse_mass;
        sum.rate += rate;
        (0..3).for_each(|axis| sum.flow[axis] += rate * flow[axis]);
    }
}

/// Applies a force and a torque in the coming update.
fn apply_field_force(
    core: &mut PhysicsSimulator,
    world: &mut World,
    report: &mut Report,
    id: BodyId,
    (force, torque): ([f32; 3], f32),
) {
    // The precise set integrates Z itself.
    let kept = world.depths.bodies.get_mut(id).filter(|_| world.scheme != DepthScheme::Precise);
    let along_z = kept.as_ref().map_or(0.0, |state| state.force_z + force[2]);
    if !(along_z.is_finite() && DepthAxisMut::of(core).apply_force(id, force, torque)) {
        report.events.push(Event::NotFinite { body: id, disabled: false });
    } else if let Some(state) = kept {
        state.force_z = along_z;
    }
}

impl FieldForces {
    fn accelerate(&mut self, acceleration: [f64; 3]) {
        (0..3).for_each(|axis| self.acceleration[axis] += acceleration[axis]);
    }

    /// Returns the mean acceleration by the fields over a step, px/s², without that of gravity. With rate k, flow u and
    /// constant acceleration a, v' = a + k (u - v) has the solution v(t) = w + (v - w) e^(-k t), w = u + a / k.
    fn over(&self, velocity: [f64; 3], gravity: [f64; 3], dt: f64) -> [f64; 3] {
        let taken = decay_fraction(self.rate, dt);
        std::array::from_fn(|axis| {
            if taken == 0.0 {
                return self.acceleration[axis];
            }
            let constant = self.acceleration[axis] + gravity[axis];
            let leads_to = (self.flow[axis] + constant) / self.rate;
            (leads_to - velocity[axis]) * taken / dt - gravity[axis]
        })
    }
}

/// Fraction of a velocity that decays in a time, 1 - e^(-rate dt), dimensionless.
fn decay_fraction(rate: f64, dt: f64) -> f64 {
    -libm::expm1(-rate * dt)
}
