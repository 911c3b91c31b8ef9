//! Islands where there is a depth axis. Those in which something heavy lies on something light are solved as a whole, whatever
//! moves: contacts that carry far more than what they hold apart weighs give way in passes, however many there are.
//!
//! Where all normals lie in the plane, and nothing turns but about the axis, there is friction alone along that, which turns
//! nothing: the plane is solved first, and what that leaves of the bounds of friction is for the axis. Friction of what slides is
//! against the slip, a part of it in the plane and a part along the axis, as the slip is. Contacts with other normals are left out
//! while nothing presses on them; else the island is left to the passes.

use super::constraint::FIXED;
use super::contact::FRICTION;
use super::island::{Island, Member};
use super::whole::finite;
use crate::math::plane::{Vector, dot};
use crate::precise::Precise;
use crate::precise::parameters::direct::{
    HEAVY_MASS_RATIO, LATERAL_FRICTION_CONVERGED, LATERAL_FRICTION_SWEEPS, SUPPORT_NORMAL_SQUARED,
};
use crate::precise::rows::{Lane, SpaceLane};

/// Whether what lies on something by a normal presses on it from above, where this is what gravity does in a step.
#[inline(always)]
pub(in crate::precise) fn is_upright(normal: Vector, fall: Vector) -> bool {
    let along = dot(normal, fall);
    along * along > SUPPORT_NORMAL_SQUARED * dot(fall, fall)
}

/// Whether something heavy lies on something light, with these reciprocals of masses, by a normal from A to B.
#[inline(never)]
pub(in crate::precise) fn is_burden([a, b]: [f32; 2], normal: Vector, fall: Vector) -> bool {
    let (above, below) = if dot(normal, fall) > 0.0 { (a, b) } else { (b, a) };
    above > 0.0 && below > HEAVY_MASS_RATIO * above && is_upright(normal, fall)
}

/// Whether a contact is one of the plane: its normal is, and nothing rolls along the axis by it.
pub(super) fn is_in_plane(lane: &Lane) -> bool {
    lane.space.normal_z == 0.0 && lane.space.radii == [0.0; 2]
}

/// Nothing presses on a contact.
pub(super) fn unload(lane: &mut Lane) {
    lane.points.iter_mut().for_each(|point| (point.impulse, point.held) = (0.0, 0.0));
    lane.tangent_impulse = 0.0;
    (lane.space.across_impulse, lane.space.twist_impulse) = (0.0, 0.0);
    lane.space.totals = [0.0; 4];
}

/// What a contact does along the depth axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rub {
    /// What a velocity weighs: impulse for each unit.
    mass: f64,
    /// Coefficient of friction.
    friction: f64,
    /// Velocity of B against A that is not that of members: of what does not give way, and of belts.
    carried: f64,
    /// On B, of the whole step.
    pub(super) impulse: f64,
}

impl Rub {
    /// Of a row whose impulses are of so many parts of a step. Its second tangent is against the axis.
    pub(super) fn new(lane: &Lane, parts: f64) -> Self {
        let [a, b] = lane.inverse_masses;
        Rub {
            mass: 1.0 / f64::from(a + b),
            friction: f64::from(lane.friction),
            carried: f64::from(lane.space.across_speed),
            impulse: f64::from(-lane.space.across_impulse) * parts,
        }
    }

    /// A moves by itself, and turns with this arm of the tangent along the axis.
    pub(super) fn carry(&mut self, [_, _, spin, z]: [f64; 4], arm: f64) {
        self.carried += spin * arm - z;
    }

    /// A row takes over what was found.
    pub(super) fn write(&self, lane: &mut SpaceLane, parts: f64) {
        lane.totals[3] = finite(-self.impulse) as f32;
        lane.across_impulse = finite(-self.impulse / parts) as f32;
    }

    /// Velocity of B against A.
    #[inline(never)]
    fn slip(&self, bodies: [u32; 2], members: &[Member]) -> f64 {
        let [a, b] = bodies.map(|at| if at == FIXED { 0.0 } else { members[at as usize].depth });
        b - a + self.carried
    }
}

/// An impulse along the axis acts on B, and against A.
#[inline(never)]
fn push(bodies: [u32; 2], members: &mut [Member], impulse: f64) {
    for (member, impulse) in bodies.into_iter().zip([-impulse, impulse]) {
        if member != FIXED {
            let member = &mut members[member as usize];
            member.depth += impulse / member.mass;
        }
    }
}

impl Island {
    /// Before the plane is solved: what contacts do along the axis, as it acts so far. Of the friction of what slips faster than
    /// this along it, a part is for that.
    pub(super) fn begin_across(&mut self, slips: f64) {
        let Island { contacts, rubs, members, .. } = self;
        for (contact, rub) in contacts.iter().zip(rubs.iter()) {
            push(contact.bodies, members, rub.impulse);
        }
        for (contact, rub) in contacts.iter_mut().zip(rubs) {
            let (along, slip) = (contact.excess[FRICTION], rub.slip(contact.bodies, members));
            if slip.abs() > slips {
                contact.friction *= along.abs() / (along * along + slip * slip).sqrt();
            }
        }
    }

    /// After the plane is solved: friction along the axis, within what the plane has left of its bounds.
    pub(super) fn rub_across(&mut self, unit: f64) {
        let Island { contacts, rubs, members, .. } = self;
        for _ in 0..LATERAL_FRICTION_SWEEPS {
            let mut is_settled = true;
            for (contact, rub) in contacts.iter_mut().zip(rubs.iter_mut()) {
                let [one, two, along] = contact.impulses;
                let most = rub.friction * (one + two);
                contact.bound = (most * most - along * along).max(0.0).sqrt();
                let wanted = rub.impulse - rub.mass * rub.slip(contact.bodies, members);
                let impulse = contact.limited(wanted);
                let change = impulse - rub.impulse;
                rub.impulse = impulse;
                is_settled &= change.abs() <= LATERAL_FRICTION_CONVERGED * unit * rub.mass;
                push(contact.bodies, members, change);
            }
            if is_settled {
                break;
            }
        }
    }
}

impl Precise {
    /// Whether a contact keeps its island from being solved in the plane, with these velocities of its sides: it is none of the
    /// plane, and they come nearer by it than they may.
    #[inline(never)]
    pub(super) fn presses_across(&self, lane: &Lane, velocities: [[f32; 4]; 2]) -> bool {
        if is_in_plane(lane) {
            return false;
        }
        // Of what turns, hardly anything turns towards such contacts.
        let [[ax, ay, _, az], [bx, by, _, bz]] = velocities;
        let along = dot(lane.normal, [bx - ax, by - ay]) + lane.space.normal_z * (bz - az);
        lane.points.iter().any(|point| point.separation + self.dt * along < -self.tuning.checked)
    }
}
