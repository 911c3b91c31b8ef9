//! The bodies of a step, side by side: those that can be pushed from number 1 on, in the order of the list of bodies, then
//! room for some more, and behind that what stands still. Number 0 stands for everything that cannot be pushed. What has gone
//! leaves its number empty until all are listed anew.
//!
//! Between updates and in callbacks the [`Body`](crate::Body) is the truth: it is read before a step and written after it.

use crate::precise::parameters::broad_phase::{BODIES_PER_SPARE_ROOM, LEAST_SPARE_ROOM};
use wide::f32x4;

use super::outline::Shape;
use crate::body::{Body, BodyId};
use crate::math::lanes::sin_cos;
use crate::math::math_helper::TWO_PI;
use crate::math::plane::Pose;
use crate::math::{Vector2, decay, scalar};
use crate::storage::reusing_clone::reusing_clone;

/// What all passes read and write of a body: velocity and spin, and how far it has gone in this substep.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C, align(32))]
pub(super) struct Hot {
    pub(super) velocity: [f32; 4],
    pub(super) step: [f32; 4],
}

/// Room for what may come.
pub(super) fn room_for(count: usize) -> usize {
    count / BODIES_PER_SPARE_ROOM + LEAST_SPARE_ROOM
}

/// The bodies by number. Lists of those that can be pushed are as long as a multiple of four.
#[derive(Debug, Default)]
pub(super) struct Bodies {
    /// The last one of those that can be pushed has this number; and how many of them there are.
    pub(super) count: usize,
    pub(super) live: usize,
    pub(super) ids: Vec<Option<BodyId>>,
    /// Numbers of those among them that nothing pushes, but the game moves.
    pub(super) kinematic: Vec<u32>,
    pub(super) hot: Vec<Hot>,
    /// What the impulses of all contacts do to the velocity in a substep.
    pub(super) warm: Vec<[f32; 4]>,
    /// The velocity right after they did.
    pub(super) begun: Vec<[f32; 4]>,
    /// The velocity before the step.
    pub(super) before: Vec<[f32; 4]>,
    /// What forces add to the velocity in a substep.
    pub(super) push: Vec<[f32; 4]>,
    /// What a spring's force must add to the way of a body that touches nothing: see [`read`].
    pub(super) forced: Vec<[f32; 4]>,
    /// The way of the whole step.
    pub(super) path: Vec<[f32; 4]>,
    /// Reciprocals of mass and moment of inertia.
    pub(super) inverses: Vec<[f32; 2]>,
    /// What part of gravity acts, of all that have inverses.
    pub(super) gravity_parts: Vec<f32>,
    /// The radius of a body that is one circle about its origin, third in the row, and then 1 as the fourth; else 0.
    pub(super) circles: Vec<[f32; 4]>,
    /// How far a body reaches from its origin, at most; infinite for what never sleeps.
    pub(super) reaches: Vec<f32>,
    /// How far into a body its surface is from its middle, at least; and whether it passes nothing.
    pub(super) cores: Vec<f32>,
    pub(super) are_bullets: Vec<bool>,
    /// Of all bodies, with those that stand still.
    pub(super) poses: Vec<Pose>,
    pub(super) rotations: Vec<f32>,
}

reusing_clone! {
    Bodies {
        count, live, ids, kinematic, hot, warm, begun, before, push, forced, path, inverses,
        gravity_parts, circles, reaches, cores, are_bullets, poses, rotations
    }
}

/// Rotations beyond it, in radians, are taken as negative ones. Boxes lie at multiples of a right angle, and none of these is near.
const ALMOST_A_TURN: f32 = 5.0;

/// Sine and cosine of rotations: quick for those of one turn, which all are but after spins that no number holds.
///
/// Rotations are kept between 0 and the f32 next to 2 pi, which is 1.7e-7 more. A body that lies at 0 and trembles by less than that is
/// at either end in turns; a turn is taken as that f32 here, so that both ends are one pose.
#[inline(always)]
pub(super) fn turn_of(rotations: f32x4) -> (f32x4, f32x4) {
    let is_turn = rotations.simd_gt(f32x4::splat(-0.5)) & rotations.simd_lt(f32x4::splat(7.0));
    let turn = f32x4::splat(TWO_PI) & rotations.simd_gt(f32x4::splat(ALMOST_A_TURN));
    let (sine, cosine) = sin_cos((rotations - turn) & is_turn);
    if is_turn.all() { (sine, cosine) } else { turn_of_any(rotations, sine, cosine) }
}

/// The angle that a rotation stands for in [`turn_of`], in radians.
pub(super) fn angle_of(rotation: f32) -> f64 {
    f64::from(rotation) - if rotation > ALMOST_A_TURN { f64::from(TWO_PI) } else { 0.0 }
}

#[cold]
fn turn_of_any(rotations: f32x4, mut sine: f32x4, mut cosine: f32x4) -> (f32x4, f32x4) {
    for (lane, rotation) in rotations.to_array().into_iter().enumerate() {
        if !(rotation > -0.5 && rotation < 7.0) {
            // Beyond, the sine of the core is no sine.
            let (s, c) = if rotation.abs() < 1e18 { scalar::sin_cos(rotation) } else { (0.0, 1.0) };
            (sine.as_mut_array()[lane], cosine.as_mut_array()[lane]) = (s, c);
        }
    }
    (sine, cosine)
}

/// A body that is read for a rebuilt list.
pub(super) fn pose_of(body: &Body) -> (Pose, f32) {
    let (position, rotation) = (body.position(), body.rotation());
    let (sine, cosine) = turn_of(f32x4::splat(rotation));
    ([position.x, position.y, cosine.to_array()[0], sine.to_array()[0]], rotation)
}

/// How far a body reaches that has no geom: as far as a ring of its mass and inertia.
pub(super) fn ring_of(body: &Body) -> f32 {
    let ring = (body.moment_of_inertia() / body.mass()).abs().sqrt();
    if ring.is_finite() { ring } else { 0.0 }
}

/// Reciprocals as rows use them: what is so small that numbers lose digits there is 0.
pub(super) fn inverses_of(body: &Body) -> [f32; 2] {
    [body.inverse_mass(), body.inverse_moment_of_inertia()]
        .map(|inverse| if inverse >= f32::MIN_POSITIVE { inverse } else { 0.0 })
}

impl Bodies {
    /// First number of those that stand still.
    pub(super) fn first_fixed(&self) -> usize {
        self.hot.len()
    }

    /// Lists these bodies, first those that can be pushed; before them what moves and is no body.
    pub(super) fn list<'a>(
        &mut self,
        moving: impl Iterator<Item = (Pose, f32)>,
        movable: impl Iterator<Item = (BodyId, &'a Body)>,
        fixed: impl Iterator<Item = (BodyId, &'a Body)>,
    ) {
        self.ids.clear();
        self.kinematic.clear();
        self.poses.clear();
        self.rotations.clear();
        self.inverses.clear();
        self.gravity_parts.clear();
        self.reaches.clear();
        self.push_dummy();
        self.hot.clear();
        self.hot.push(Hot::default());
        self.reaches.push(f32::INFINITY);
        self.are_bullets.clear();
        self.are_bullets.push(false);
        moving.for_each(|(pose, rotation)| {
            self.kinematic.push(self.ids.len() as u32);
            self.reaches.push(f32::INFINITY);
            self.are_bullets.push(false);
            self.add_fixture(pose, rotation);
            self.hot.push(Hot::default());
        });
        let first = self.ids.len();
        movable.for_each(|(id, body)| {
            if body.is_kinematic() {
                self.kinematic.push(self.ids.len() as u32);
            }
            self.reaches.push(if body.is_kinematic() { f32::INFINITY } else { 0.0 });
            self.are_bullets.push(body.is_bullet());
            self.push(id, body, inverses_of(body));
            self.hot.push(Hot { velocity: velocity_of(body), ..Hot::default() });
        });
        self.count = self.ids.len() - 1;
        self.live = self.ids.len() - first;
        let padded = (self.ids.len() + room_for(self.count)).next_multiple_of(4);
        (self.ids.len()..padded).for_each(|_| self.push_dummy());
        fixed.for_each(|(id, body)| self.add_fixed(id, body));
        self.hot.resize(padded, Hot::default());
        self.reaches.resize(padded, f32::INFINITY);
        self.are_bullets.resize(padded, false);
        self.cores.clear();
        self.cores.resize(padded, f32::INFINITY);
        for stream in [
            &mut self.warm,
            &mut self.begun,
            &mut self.before,
            &mut self.push,
            &mut self.forced,
            &mut self.path,
            &mut self.circles,
        ] {
            stream.clear();
            stream.resize(padded, [0.0; 4]);
        }
    }

    fn push_dummy(&mut self) {
        self.ids.push(None);
        self.poses.push([0.0, 0.0, 1.0, 0.0]);
        self.rotations.push(0.0);
        self.inverses.push([0.0; 2]);
        self.gravity_parts.push(0.0);
    }

    fn push(&mut self, id: BodyId, body: &Body, inverses: [f32; 2]) {
        let (pose, rotation) = pose_of(body);
        self.ids.push(Some(id));
        self.poses.push(pose);
        self.rotations.push(rotation);
        self.inverses.push(inverses);
        self.gravity_parts.push(body.gravity_part());
    }

    /// One that stands still comes last.
    pub(super) fn add_fixed(&mut self, id: BodyId, body: &Body) {
        self.push(id, body, [0.0; 2]);
    }

    /// Something that is no body comes last.
    pub(super) fn add_fixture(&mut self, pose: Pose, rotation: f32) {
        self.push_dummy();
        self.poses.pop();
        self.rotations.pop();
        self.poses.push(pose);
        self.rotations.push(rotation);
    }

    /// One that can be pushed comes behind the others, if there is room: answers its number.
    pub(super) fn add_movable(&mut self, id: BodyId, body: &Body) -> Option<usize> {
        let number = self.count + 1;
        if number >= self.first_fixed() {
            return None;
        }
        if body.is_kinematic() {
            self.kinematic.push(number as u32);
        }
        self.ids[number] = Some(id);
        self.move_to(number, body);
        self.inverses[number] = inverses_of(body);
        self.gravity_parts[number] = body.gravity_part();
        self.are_bullets[number] = body.is_bullet();
        self.set_velocity(number, body);
        (self.count, self.live) = (number, self.live + 1);
        Some(number)
    }

    /// A body has gone.
    pub(super) fn forget(&mut self, number: usize) {
        self.ids[number] = None;
        if number >= self.first_fixed() {
            return;
        }
        self.live -= 1;
        self.kinematic.retain(|&kinematic| kinematic as usize != number);
        self.rest(number, 1.0);
        self.inverses[number] = [0.0; 2];
        self.are_bullets[number] = false;
        (self.reaches[number], self.cores[number]) = (f32::INFINITY, f32::INFINITY);
        self.circles[number] = [0.0; 4];
    }

    /// How far a body reaches, how thick it is, and whether it is one circle, as its pieces say.
    pub(super) fn measure(&mut self, number: usize, shapes: impl Iterator<Item = (Shape, f32)>) {
        let mut reach = if self.is_kinematic(number) { f32::INFINITY } else { 0.0 };
        let (mut core, mut circle, mut count) = (f32::INFINITY, [0.0; 4], 0);
        for (shape, of_shape) in shapes {
            core = if of_shape < core { of_shape } else { core };
            reach = if shape.reach > reach { shape.reach } else { reach };
            count += 1;
            let is_round = count == 1 && shape.count == 0 && shape.centre == [0.0, 0.0];
            circle = if is_round { [0.0, 0.0, shape.radius.max(f32::MIN_POSITIVE), 1.0] } else { [0.0; 4] };
        }
        (self.reaches[number], self.cores[number], self.circles[number]) = (reach, core, circle);
    }

    pub(super) fn is_kinematic(&self, number: usize) -> bool {
        self.kinematic.binary_search(&(number as u32)).is_ok()
    }

    /// Whether a body was moved since it was read.
    #[inline(always)]
    pub(super) fn was_moved(&self, number: usize, body: &Body) -> bool {
        let (pose, position) = (&self.poses[number], body.position());
        position.x != pose[0] || position.y != pose[1] || body.rotation() != self.rotations[number]
    }

    pub(super) fn moves(&self, number: usize) -> bool {
        self.hot[number].velocity != [0.0; 4]
    }

    /// A body comes to rest. Answers the accelerations that it bears, after a step of so many seconds.
    pub(super) fn rest(&mut self, number: usize, dt: f32) -> [f32; 4] {
        let borne = self.forced[number].map(|way| way / (0.5 * dt * dt));
        // The square of a step may be less than there are numbers.
        let borne = if borne.iter().all(|number| number.is_finite()) { borne } else { [0.0; 4] };
        self.hot[number] = Hot::default();
        for stream in [
            &mut self.warm,
            &mut self.begun,
            &mut self.before,
            &mut self.push,
            &mut self.forced,
            &mut self.path,
        ] {
            stream[number] = [0.0; 4];
        }
        borne
    }

    /// Takes over the velocity of an edited body.
    pub(super) fn set_velocity(&mut self, number: usize, body: &Body) {
        if let Some(hot) = self.hot.get_mut(number) {
            hot.velocity = velocity_of(body);
        }
    }

    /// The last step has not brought a body to where it is.
    pub(super) fn forget_way(&mut self, number: usize) {
        if let Some(path) = self.path.get_mut(number) {
            *path = [0.0; 4];
        }
    }

    /// Ways are known from the next step on: they are saved only while something asks for them.
    pub(super) fn forget_ways(&mut self) {
        self.path.fill([0.0; 4]);
    }

    pub(super) fn move_to(&mut self, number: usize, body: &Body) {
        (self.poses[number], self.rotations[number]) = pose_of(body);
    }
}

fn velocity_of(body: &Body) -> [f32; 4] {
    let velocity = body.linear_velocity();
    [velocity.x, velocity.y, body.angular_velocity(), 0.0]
}

/// Velocity, and what forces, gravity and drag add to it in every substep so that the whole step ends with the velocity that
/// the exact law gives: with drag rate r, v' = a - r v ends at v E + a (1 - E) / r, E = exp(-r dt). Quadratic drag acts as it
/// was when the step began.
///
/// Forces that a game or a spring has applied may depend on the place. A way by the middle of the velocities would be too
/// short then: an undamped spring would swing up. Theirs is that of the velocity after the step, as in the faithful set,
/// which keeps the swing (the symplectic Euler method); `forced` is the difference.
#[inline(always)]
pub(super) fn read(body: &mut Body, gravity: Vector2, dt: f32, h: f32) -> Read {
    if body.is_kinematic() {
        body.begin_kinematic_step(dt);
        return Read { velocity: velocity_of(body), push: [0.0; 4], forced: [0.0; 4] };
    }
    body.apply_accumulated_impulse();
    let velocity = f32x4::new(velocity_of(body));
    let (force, turning) = body.take_accelerations();
    let forced = f32x4::new([force.x, force.y, turning, 0.0]);
    let gravity = gravity * body.gravity_part();
    let acceleration = f32x4::new([gravity.x, gravity.y, 0.0, 0.0]) + forced;
    let gained = match body.drag_rates() {
        // The same as below, for less.
        (0.0, 0.0) => acceleration * f32x4::splat(dt),
        (drag, rotational_drag) => {
            let (decay, grown) = decay::over_each(f32x4::new([drag, drag, rotational_drag, 0.0]), dt);
            velocity * decay + acceleration * grown
        }
    };
    Read {
        velocity: velocity.to_array(),
        push: (gained * f32x4::splat(h / dt)).to_array(),
        forced: (forced * f32x4::splat(0.5 * dt * dt)).to_array(),
    }
}

/// What is read of a body before a step.
#[derive(Default)]
pub(super) struct Read {
    pub(super) velocity: [f32; 4],
    pub(super) push: [f32; 4],
    pub(super) forced: [f32; 4],
}
