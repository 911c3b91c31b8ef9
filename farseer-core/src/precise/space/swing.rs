//! Fixtures that swing about an upright hinge: doors that are pushed.
//!
//! Such a one has a single degree of freedom, the angle. To the rows of contacts it is a body of infinite mass and a finite moment
//! of inertia about its hinge, which is the place it goes by: their arms are those about it, so that at a distance r from the hinge it
//! weighs I / r^2, and the angular momentum about the hinge that it takes over is what the impulses lose. Nothing more is kept of
//! them than of others: it is in the same colours, and hangs together with what it touches when that falls asleep.
//!
//! Where nothing touches it it swings as the law of a damped spring says, I x" + c x' + k x = 0, in closed form. Where something
//! does, the spring pushes in every substep as it is stretched when that begins; what it is stretched on by meanwhile, and the
//! damper, follow the velocity that the passes find. That is the implicit Euler method: it loses energy, and wins none. Stops are
//! hard rows, with no bounce.

use super::Space;
use super::parts::{self, FixtureSwing, Swings};
use crate::body::BodyId;
use crate::precise::Precise;
use crate::precise::bodies::Bodies;
use crate::precise::parameters::depth::{HINGE_REST_DISTANCE, HINGE_STOP_ANGLE};
use crate::precise::proxies::Mobility;
use crate::precise::rows::Lane;
use crate::precise::tuning::Step;

impl FixtureSwing {
    pub(super) fn inverse_inertia(&self) -> f32 {
        1.0 / self.inertia
    }

    /// The nearest angle between its stops.
    pub(super) fn within(&self, angle: f32) -> f32 {
        super::upright::within(angle, self.stops[0], self.stops[1])
    }

    /// The middle of its box, turned by an angle with this cosine and sine, at a height.
    pub fn middle(&self, [cosine, sine]: [f32; 2], y: f32) -> crate::math::Vector3 {
        let ([x, z], [along, across]) = (self.hinge, self.out);
        crate::math::Vector3::new(
            x + (along * cosine - across * sine),
            y,
            z + (along * sine + across * cosine),
        )
    }

    /// Angle and velocity after so many seconds in which nothing touches it.
    fn swung(&self, [angle, turning]: [f32; 2], seconds: f32) -> [f32; 2] {
        let [inertia, stiffness, damping, rest, t] =
            [self.inertia, self.stiffness, self.damping, self.rest_angle, seconds].map(f64::from);
        let (x, v) = (f64::from(angle) - rest, f64::from(turning));
        let (pull, slowing) = (stiffness / inertia, 0.5 * damping / inertia);
        let [cosine, sine] = decayed(slowing, pull, t);
        let next = cosine * x + sine * (v + slowing * x);
        let velocity = cosine * v - sine * (slowing * v + pull * x);
        let next = if x == 0.0 && v == 0.0 { angle } else { (next + rest) as f32 };
        [next, velocity as f32]
    }

    /// The same with stops.
    fn swung_within(&self, from: [f32; 2], seconds: f32) -> [f32; 2] {
        let [angle, turning] = self.swung(from, seconds);
        let stopped = self.within(angle);
        if stopped == angle { [angle, turning] } else { [stopped, 0.0] }
    }
}

/// exp(-b t) cos(w t) and exp(-b t) sin(w t) / w with w^2 = p - b^2, which may be negative.
fn decayed(slowing: f64, pull: f64, t: f64) -> [f64; 2] {
    let squared = pull - slowing * slowing;
    let decay = libm::exp(-slowing * t);
    let size = squared.abs().sqrt();
    if size * t < 1e-4 {
        let x = squared * t * t;
        return [decay * (1.0 - 0.5 * x), decay * t * (1.0 - x / 6.0)];
    }
    if squared > 0.0 {
        return [decay * libm::cos(size * t), decay * libm::sin(size * t) / size];
    }
    // The slower of both ways to come to rest, without the difference of numbers that are nearly alike.
    let slow = libm::exp(-pull / (slowing + size) * t);
    let fast = libm::exp(-(slowing + size) * t);
    [0.5 * (slow + fast), 0.5 * (slow - fast) / size]
}

/// One that swings, in a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Swinging {
    number: u32,
    /// Where it is among the fixtures.
    place: u32,
    swing: FixtureSwing,
    /// Angle and velocity when the step began, and the angle by now.
    begun: [f32; 2],
    angle: f32,
    /// The impulse of a substep by which damper and stops hold it.
    held: f32,
    /// Whether it has moved in this substep already: what is too far then is not pushed back as velocity.
    has_moved: bool,
}

impl Swinging {
    /// What damper and stops make of its velocity.
    fn hold(&mut self, turning: &mut f32, h: f32) {
        let FixtureSwing { inertia, stiffness, damping, stops: [least, greatest], .. } = self.swing;
        let free = *turning - self.held / inertia;
        let slowed = free / (1.0 + h * (damping + h * stiffness) / inertia);
        let (mut back, mut on) = ((least - self.angle) / h, (greatest - self.angle) / h);
        if self.has_moved {
            (back, on) = (back.min(0.0), on.max(0.0));
        }
        let next = super::upright::within(slowed, back, on);
        self.held += (next - *turning) * inertia;
        *turning = next;
    }
}

/// Nothing, where nothing can swing: the compiler does not see by itself that such a list is empty.
fn there<T>(list: &mut [T]) -> &mut [T] {
    if Swings::ARE_THERE { list } else { &mut [] }
}

/// Stages: see [`step`](crate::precise::step).
impl Precise {
    /// A step is solved: those that are awake are listed, and what presses them against a stop meets what does not give way.
    pub(in crate::precise) fn begin_swings(&mut self, step: &Step) {
        let Precise { space: Some(space), bodies, sleep, .. } = self else { return };
        let Space { moving, fixtures, swings, .. } = &mut **space;
        swings.clear();
        for (number, &place) in (1..).zip(&*there(moving)) {
            let fixture = &fixtures[place as usize];
            let Some(&swing) = fixture.swing().filter(|_| !sleep.is_asleep(number as usize)) else {
                continue;
            };
            let angle = fixture.yaw.unwrap_or_default();
            let begun = [angle, bodies.hot[number as usize].velocity[2]];
            let held = swing.held * step.h;
            swings.push(Swinging { number, place, swing, begun, angle, held, has_moved: false });
        }
        (0..there(&mut space.swings).len()).for_each(|at| self.brace(at));
    }

    /// Rows that press one against the stop at which it rests are those of something that does not give way, as long as nothing
    /// presses it from the other side.
    fn brace(&mut self, at: usize) {
        let Some(Swinging { number, swing, begun: [angle, turning], .. }) = self.swing_at(at) else { return };
        let [least, greatest] = swing.stops;
        let pull = swing.stiffness * (swing.rest_angle - angle);
        let rests = |distance: f32, away: f32| {
            distance < HINGE_STOP_ANGLE && away * turning <= 0.0 && away * pull <= 0.0
        };
        let at_stop = [rests(angle - least, 1.0), rests(greatest - angle, -1.0)];
        let mut pairs = std::mem::take(&mut self.lost);
        let with_rows = |pair: &usize| self.pairs.all[*pair].home.is_some();
        pairs
            .extend(self.pairs.of_body(&self.proxies, number as usize).filter(with_rows).map(|it| it as u32));
        let is_pressed = |side: usize| {
            pairs
                .iter()
                .any(|&pair| self.pairs.all[pair as usize].is_told && self.turns_towards(pair as usize, side))
        };
        let braced = [0, 1].map(|side| at_stop[side] && (at_stop[1 - side] || !is_pressed(1 - side)));
        for &pair in &pairs {
            let is_braced = (0..2).any(|side| braced[side] && self.turns_towards(pair as usize, side));
            self.set_inertia(pair as usize, if is_braced { 0.0 } else { swing.inverse_inertia() });
        }
        pairs.clear();
        self.lost = pairs;
    }

    fn swing_at(&self, at: usize) -> Option<Swinging> {
        self.space.as_ref()?.swings.get(at).copied()
    }

    fn row_of(&self, pair: usize) -> Option<Lane> {
        let state = &self.pairs.all[pair];
        Some(self.rows.lane(state.kind, state.home?))
    }

    /// Whether all points of a row push what swings towards its least angle, side 0, or its greatest one, side 1.
    fn turns_towards(&self, pair: usize, side: usize) -> bool {
        let sign = if side == 0 { 1.0 } else { -1.0 };
        self.row_of(pair).is_some_and(|lane| {
            let mut points = lane.points.iter().filter(|point| point.mass > 0.0);
            points.all(|point| sign * point.arm_a > 0.0)
        })
    }

    /// The row of a pair sees what swings with another moment of inertia.
    fn set_inertia(&mut self, pair: usize, inverse_inertia: f32) {
        let state = self.pairs.all[pair];
        let (Some(home), Some(mut lane)) = (state.home, self.row_of(pair)) else { return };
        if lane.inverse_inertias[0] != inverse_inertia {
            lane.inverse_inertias[0] = inverse_inertia;
            let row = lane;
            for point in lane.points.iter_mut().filter(|point| point.mass > 0.0) {
                point.mass = row.weight(point);
            }
            self.rows.set_lane(state.kind, home, &lane);
        }
    }

    /// What held them in the last step does so again.
    pub(in crate::precise) fn warm_swings(&mut self) {
        self.for_each_swing(|swing, bodies| {
            bodies.warm[swing.number as usize][2] += swing.held / swing.swing.inertia;
        });
    }

    /// A substep begins: springs push.
    pub(in crate::precise) fn push_swings(&mut self, h: f32, is_first: bool) {
        self.for_each_swing(|swing, bodies| {
            let at = swing.number as usize;
            let turned = if is_first { 0.0 } else { bodies.path[at][2] };
            (swing.angle, swing.has_moved) = (swing.begun[0] + turned, false);
            let FixtureSwing { stiffness, inertia, rest_angle, .. } = swing.swing;
            bodies.push[at][2] = h * stiffness * (rest_angle - swing.angle) / inertia;
        });
    }

    /// Bodies have moved in a substep.
    pub(in crate::precise) fn turn_swings(&mut self) {
        self.for_each_swing(|swing, bodies| {
            swing.angle = swing.begun[0] + bodies.path[swing.number as usize][2];
            swing.has_moved = true;
        });
    }

    /// Dampers and stops act.
    pub(in crate::precise) fn hold_swings(&mut self, h: f32) {
        self.for_each_swing(|swing, bodies| {
            swing.hold(&mut bodies.hot[swing.number as usize].velocity[2], h);
        });
    }

    fn for_each_swing(&mut self, mut act: impl FnMut(&mut Swinging, &mut Bodies)) {
        let Precise { space: Some(space), bodies, .. } = self else { return };
        for swing in there(&mut space.swings) {
            act(swing, bodies);
        }
    }

    /// A step is solved: where nothing was near, the swing is that of the law, and nothing goes past its stop.
    pub(in crate::precise) fn end_swings(&mut self, step: &Step) {
        let has_last = self.rows.has_last();
        let Precise { space: Some(space), bodies, palette, sleep, tuning, .. } = self else { return };
        let Space { swings, fixtures, .. } = &mut **space;
        for Swinging { number, place, swing, begun, held, .. } in there(swings) {
            let at = *number as usize;
            let mut torque = *held / step.h;
            let now = if palette.swings_freely(at) && !has_last {
                torque = 0.0;
                let after = (0..step.substeps).fold(*begun, |from, _| swing.swung_within(from, step.h));
                let missing = swing.within(swing.rest_angle) - after[0];
                let reach = bodies.reaches[at];
                if swing.stiffness > 0.0 && missing.abs() * reach > HINGE_REST_DISTANCE * tuning.unit {
                    sleep.rest[at] = 0.0;
                }
                bodies.hot[at].velocity[2] = after[1];
                after[0]
            } else {
                let now = swing.within(begun[0] + bodies.path[at][2]);
                let turning = &mut bodies.hot[at].velocity[2];
                if (now == swing.stops[0] && *turning < 0.0) || (now == swing.stops[1] && *turning > 0.0) {
                    *turning = 0.0;
                }
                now
            };
            bodies.path[at][2] = now - begun[0];
            if let Some(swing) = fixtures[*place as usize].motion.as_mut().and_then(|it| it.swing_mut()) {
                swing.held = if torque.is_finite() { torque } else { 0.0 };
            }
        }
    }
}

/// Sleep, and what is saved.
impl Precise {
    /// Whether a number is that of a fixture that swings.
    pub(in crate::precise) fn swings(&self, number: usize) -> bool {
        Swings::ARE_THERE && self.space.as_ref().is_some_and(|space| space.swing_of(number).is_some())
    }

    /// How many of those that sleep are no bodies, but swing.
    pub(in crate::precise) fn swings_asleep(&self) -> usize {
        let moving = self.space.as_ref().map_or(0, |space| space.moving.len());
        let moving = if Swings::ARE_THERE { moving } else { 0 };
        (1..=moving).filter(|&number| self.sleep.is_asleep(number)).count()
    }

    /// No pass takes them for bodies that touch one thing at most.
    pub(in crate::precise) fn note_swings(&mut self) {
        let Precise { space: Some(space), palette, .. } = self else { return };
        let moving = if Swings::ARE_THERE { space.moving.len() } else { 0 };
        let numbers = (1..=moving).filter(|&number| space.swing_of(number).is_some());
        numbers.for_each(|number| palette.note_swing(number));
    }

    /// The id of a body in a save, or of a fixture that sleeps as bodies do. A fixture is known by its proxy: when fixtures have
    /// come or gone, their list is the new one before anything is listed anew.
    pub(in crate::precise) fn name_of(&self, number: usize) -> Option<BodyId> {
        let of_fixture = || {
            let mut proxies = self.proxies.of(number).map(|at| &self.proxies.all[at as usize]);
            proxies
                .find(|proxy| proxy.mobility == Mobility::Hinged)
                .map(|proxy| parts::fixture_body(proxy.geom))
        };
        self.bodies.ids[number].or_else(|| if Swings::ARE_THERE { of_fixture() } else { None })
    }

    /// The number of what is called so.
    pub(in crate::precise) fn number_named(&self, name: BodyId) -> Option<usize> {
        self.number_of(name).or_else(|| {
            if !Swings::ARE_THERE {
                return None;
            }
            let space = self.space.as_ref()?;
            let (place, fixture) = space.fixture(parts::fixture_of_body(name)?)?;
            fixture.swing()?;
            Some(space.moving.binary_search(&(place as u32)).ok()? + 1)
        })
    }

    /// Whether one that sleeps may go on sleeping.
    pub(in crate::precise) fn is_swing_at_rest(&self, number: usize) -> bool {
        let fixture = self.space.as_ref().and_then(|space| space.swinging_fixture(number));
        Swings::ARE_THERE
            && fixture.and_then(|fixture| fixture.motion).is_some_and(|motion| {
                motion.turning == 0.0 && motion.swing().is_some_and(|swing| !swing.is_edited)
            })
    }

    /// One wakes because it was edited: it has the velocity that it was given.
    pub(in crate::precise) fn take_swing(&mut self, number: usize) {
        if !self.swings(number) {
            return;
        }
        let fixture = self.space.as_ref().and_then(|space| space.swinging_fixture(number));
        if let Some(motion) = fixture.and_then(|fixture| fixture.motion) {
            self.bodies.hot[number].velocity[2] = motion.turning;
        }
    }

    /// One has fallen asleep.
    pub(in crate::precise) fn rest_swing(&mut self, number: usize) {
        if !self.swings(number) {
            return;
        }
        if let Some(space) = self.space.as_deref_mut() {
            let place = space.moving[number - 1] as usize;
            space.fixtures[place].motion.iter_mut().for_each(|motion| motion.turning = 0.0);
        }
    }
}

impl Space {
    /// The fixture of a number, if it swings.
    fn swinging_fixture(&self, number: usize) -> Option<&parts::Fixture> {
        let place = *self.moving.get(number.checked_sub(1)?)?;
        self.fixtures.get(place as usize).filter(|fixture| fixture.swing().is_some())
    }

    fn swing_of(&self, number: usize) -> Option<&FixtureSwing> {
        self.swinging_fixture(number)?.swing()
    }
}

#[cfg(all(test, feature = "swing"))]
mod tests {
    use super::{FixtureSwing, Swings};

    fn swing(stiffness: f32, damping: f32) -> FixtureSwing {
        FixtureSwing {
            hinge: [0.0; 2],
            out: [30.0, 0.0],
            inertia: 2.0,
            stiffness,
            damping,
            rest_angle: 0.5,
            stops: [-2.0, 2.0],
            held: 0.0,
            is_edited: false,
            proof: Swings,
        }
    }

    /// The law by many small steps of the classical Runge-Kutta method.
    fn by_small_steps(swing: &FixtureSwing, from: [f32; 2], seconds: f64) -> [f64; 2] {
        let [inertia, k, c, rest] =
            [swing.inertia, swing.stiffness, swing.damping, swing.rest_angle].map(f64::from);
        let slope = |[x, v]: [f64; 2]| [v, -(k * (x - rest) + c * v) / inertia];
        let (count, mut now) = (20_000, from.map(f64::from));
        let h = seconds / f64::from(count);
        let on = |[x, v]: [f64; 2], [dx, dv]: [f64; 2], t: f64| [x + t * dx, v + t * dv];
        for _ in 0..count {
            let a = slope(now);
            let b = slope(on(now, a, 0.5 * h));
            let c = slope(on(now, b, 0.5 * h));
            let d = slope(on(now, c, h));
            now = on(now, std::array::from_fn(|i| (a[i] + 2.0 * (b[i] + c[i]) + d[i]) / 6.0), h);
        }
        now
    }

    #[test]
    fn a_swing_that_nothing_touches_follows_the_law_whatever_its_damping() {
        // Without a spring, without a damper, damped less than critically, critically, hardly more, and much more.
        for (k, c) in [(0.0, 0.0), (0.0, 3.0), (8.0, 0.0), (8.0, 1.0), (8.0, 8.0), (8.0, 8.001), (8.0, 300.0)]
        {
            let swing = swing(k, c);
            for seconds in [0.001, 0.1, 1.5] {
                let found = swing.swung([-0.4, 1.5], seconds).map(f64::from);
                let law = by_small_steps(&swing, [-0.4, 1.5], f64::from(seconds));
                for (found, law) in found.into_iter().zip(law) {
                    // Seven digits of a number are what is left of both.
                    assert!(
                        (found - law).abs() < 4e-7,
                        "{found}, not {law}, with {k} and {c} after {seconds} s"
                    );
                }
            }
        }
    }

    #[test]
    fn one_at_rest_stays_where_it_is_to_the_last_bit() {
        assert_eq!(swing(8.0, 1.0).swung([0.5, 0.0], 0.1), [0.5, 0.0]);
    }
}
