//! From velocities to places: the substeps of bodies, and the end of a step.

use crate::precise::parameters::contacts::{BALLISTIC_VELOCITY_CHANGE, CENTRAL_BOUNCE_DIFFERENCE};
use std::ops::Range;

use wide::f32x4;

use super::bodies::{Bodies, Hot, turn_of};
use super::joints::Joints;
use super::proxies::Proxies;
use super::rows::{Contacts, Palette, Point, Row};
use super::tuning::{Step, Tuning};
use crate::math::lanes::{gather, select};

/// A substep begins: the impulses so far and the forces act.
///
/// What impulses do to a velocity is kept as one sum per body: after a substep it is what it was, and what the passes have
/// added since.
#[inline(always)]
pub(super) fn begin_substep(bodies: &mut Bodies, runs: &[Range<usize>], is_first: bool) {
    for run in runs.iter().cloned() {
        let (hot, warm) = (&mut bodies.hot[run.clone()], &mut bodies.warm[run.clone()]);
        let (begun, push) = (&mut bodies.begun[run.clone()], &bodies.push[run]);
        for (((hot, warm), begun), push) in hot.iter_mut().zip(warm).zip(begun).zip(push) {
            let velocity = f32x4::new(hot.velocity);
            if !is_first {
                *warm = (f32x4::new(*warm) + (velocity - f32x4::new(*begun))).to_array();
            }
            *begun = (velocity + f32x4::new(*warm) + f32x4::new(*push)).to_array();
            hot.velocity = *begun;
        }
    }
}

/// Bodies move by their velocities.
#[inline(always)]
pub(super) fn displace(bodies: &mut Bodies, runs: &[Range<usize>], h: f32, is_first: bool) {
    let h = f32x4::splat(h);
    for run in runs.iter().cloned() {
        for (hot, path) in bodies.hot[run.clone()].iter_mut().zip(&mut bodies.path[run]) {
            let step = f32x4::new(hot.velocity) * h;
            hot.step = step.to_array();
            *path = if is_first { hot.step } else { (f32x4::new(*path) + step).to_array() };
        }
    }
}

/// All substeps of bodies that nothing touches, at once.
#[inline(always)]
pub(super) fn fly(bodies: &mut Bodies, runs: &[Range<usize>], step: &Step) {
    let (dt, substeps) = (f32x4::splat(step.dt), f32x4::splat(step.substeps as f32));
    let half = f32x4::splat(0.5);
    for run in runs.iter().cloned() {
        let (hot, push) = (&mut bodies.hot[run.clone()], &bodies.push[run.clone()]);
        let (forced, path) = (&bodies.forced[run.clone()], &mut bodies.path[run]);
        for (((hot, push), forced), path) in hot.iter_mut().zip(push).zip(forced).zip(path) {
            // The middle of the velocities before and after: what constant forces do exactly.
            let (velocity, push) = (f32x4::new(hot.velocity), f32x4::new(*push) * substeps);
            let way = (velocity + half * push) * dt + f32x4::new(*forced);
            (hot.velocity, *path) = ((velocity + push).to_array(), way.to_array());
        }
    }
}

/// Bodies with one row at most, and no joint, whose velocity has hardly changed: their substeps take the middle of the velocities
/// before and after, which is exact under constant forces, instead of those after. What touches something is moved by no more than
/// the reach of its contacts, unless each substep adds what the last one does: in a long frame it may have landed, and would be
/// moved into what stopped it.
#[inline(always)]
pub(super) fn even_out(
    bodies: &mut Bodies,
    runs: &[Range<usize>],
    (palette, joints): (&Palette, &Joints),
    reach: f32,
    step: &Step,
) {
    let (back, substeps) = (-0.5 * step.h, step.substeps as f32);
    let most = BALLISTIC_VELOCITY_CHANGE * substeps;
    let longest = reach * reach / (back * back);
    let squared = |[x, y, _, z]: [f32; 4]| x * x + y * y + z * z;
    let is_single = |&body: &usize| palette.is_single(body) && !(joints.holds(body) || joints.is_soft(body));
    for body in runs.iter().cloned().flatten().filter(is_single) {
        let change = f32x4::new(bodies.hot[body].velocity) - f32x4::new(bodies.before[body]);
        let (size, push) = (squared(change.to_array()), bodies.push[body]);
        let is_even = || {
            let last = f32x4::new(push) + f32x4::new(bodies.warm[body]);
            squared((change - last * f32x4::splat(substeps)).to_array()) <= longest
        };
        let is_free = palette.is_free(body);
        if size <= most * most * squared(push) && (is_free || size <= longest || is_even()) {
            let mut path = f32x4::new(bodies.path[body]) + change * f32x4::splat(back);
            if is_free {
                path += f32x4::new(bodies.forced[body]);
            }
            bodies.path[body] = path.to_array();
        }
    }
}

/// A bounce of two that touch nothing else, in closed form where it turns neither: they fly until they meet, and leave each
/// other for the rest of the step. What turns them stands still along the normal for this step instead: then a step with
/// restitution 1 is the mirror image of itself. Either way no energy is won or lost over ten thousand steps.
pub(super) fn leave<const P: usize, R: Contacts<P>>(
    bodies: &mut Bodies,
    hot: &mut [Hot],
    (palette, joints): (&Palette, &Joints),
    step: &Step,
    contacts: &R,
    lanes: u32,
) {
    let row = contacts.row();
    for lane in (0..4).filter(|lane| lanes >> lane & 1 == 1) {
        let bodies_of = [row.a[lane] as usize, row.b[lane] as usize];
        let is_alone = |body: usize| body == 0 || (palette.is_single(body) && !joints.holds(body));
        if bodies_of.into_iter().all(is_alone) {
            leave_one(bodies, hot, step, contacts, lane);
        }
    }
}

fn leave_one<const P: usize, R: Contacts<P>>(
    bodies: &mut Bodies,
    hot: &mut [Hot],
    step: &Step,
    contacts: &R,
    lane: usize,
) {
    let row = contacts.row();
    let [a, b] = [row.a[lane] as usize, row.b[lane] as usize];
    let of = |lanes: &f32x4| lanes.as_array()[lane];
    let (mass_a, mass_b) = (of(&row.inverse_mass_a), of(&row.inverse_mass_b));
    let normal = f32x4::new([of(&row.normal_x), of(&row.normal_y), 0.0, of(&contacts.normal_z())]);
    let along = |change: f32x4| {
        let [x, y, _, z] = (change * normal).to_array();
        x + y + z
    };
    // Moves both against each other along the normal, by their masses.
    let share = |amount: f32| {
        let amount = normal * f32x4::splat(amount / (mass_a + mass_b));
        (amount * f32x4::splat(-mass_a), amount * f32x4::splat(mass_b))
    };
    let half = f32x4::splat(0.5 * step.dt);
    let way = |body: usize| (f32x4::new(bodies.before[body]) + f32x4::new(hot[body].velocity)) * half;
    let (way_a, way_b) = (if a == 0 { f32x4::ZERO } else { way(a) }, way(b));
    // What nothing pushes may turn, however far from its middle it is hit.
    let turning = if a == 0 || mass_a > 0.0 { 0.0 } else { hot[a].velocity[2] * of(&row.points[0].arm_a) };
    let push = |body: usize| f32x4::new(bodies.push[body]) * f32x4::splat(1.0 / step.h);
    let flight = Flight {
        gap: of(&row.gap[0]),
        approach: of(&row.approach[0]),
        acceleration: along(push(b) - push(a)),
        restitution: of(&row.restitution),
    };
    // Two that can both be pushed may have pushed others since they met.
    let has_just_met = mass_a == 0.0 || flight.gap >= 0.0;
    let bounced = if has_just_met && is_straight(row, lane) { flight.bounce(step.dt) } else { None };
    let apart = along(way_b - way_a) - turning * step.dt;
    let (change_a, change_b) = share(bounced.map_or(0.0, |(way, _)| way) - apart);
    if a != 0 {
        bodies.path[a] = (way_a + change_a).to_array();
    }
    bodies.path[b] = (way_b + change_b).to_array();
    if let Some((_, velocity)) = bounced {
        let [now_a, now_b] = [a, b].map(|body| f32x4::new(hot[body].velocity));
        let (change_a, change_b) = share(velocity - (along(now_b - now_a) - turning));
        if a != 0 {
            hot[a].velocity = (now_a + change_a).to_array();
        }
        hot[b].velocity = (now_b + change_b).to_array();
    }
}

/// Whether equal impulses on all points of a row turn neither of the two, and all points meet at once.
fn is_straight<const P: usize>(row: &Row<P>, lane: usize) -> bool {
    let of = |lanes: &f32x4| lanes.as_array()[lane];
    let sum =
        |of_point: fn(&Point) -> &f32x4| row.points.iter().map(|point| of(of_point(point))).sum::<f32>();
    let (arm_a, arm_b) = (sum(|point| &point.arm_a), sum(|point| &point.arm_b));
    let turning = of(&row.inverse_inertia_a) * arm_a * arm_a + of(&row.inverse_inertia_b) * arm_b * arm_b;
    let moving = of(&row.inverse_mass_a) + of(&row.inverse_mass_b);
    let approach = of(&row.approach[0]);
    let is_like = |other: &f32x4| (of(other) - approach).abs() <= CENTRAL_BOUNCE_DIFFERENCE * approach.abs();
    turning <= CENTRAL_BOUNCE_DIFFERENCE * CENTRAL_BOUNCE_DIFFERENCE * moving
        && row.points.iter().all(|point| of(&point.mass) > 0.0)
        && row.approach.iter().all(is_like)
}

/// Two that come together along their normal, as it is when the step begins.
struct Flight {
    gap: f32,
    approach: f32,
    acceleration: f32,
    restitution: f32,
}

impl Flight {
    /// The way along the normal in the step, and the velocity after it. Nothing if they meet again in the step, or have
    /// overlapped for longer than a step: what comes fast is noticed only once it has come too far, and then leaves from when
    /// it met.
    ///
    /// With gap s, velocity u and acceleration a they meet where s + u t + a t^2 / 2 = 0: at t = 2 s / (w - u), with
    /// w^2 = u^2 - 2 a s the square of the speed at which they do.
    fn bounce(&self, dt: f32) -> Option<(f32, f32)> {
        let Flight { gap, approach, acceleration, restitution } = *self;
        let squared = approach * approach - 2.0 * acceleration * gap;
        if !(approach < 0.0 && squared > 0.0) {
            return None;
        }
        let speed = squared.sqrt();
        let met = 2.0 * gap / (speed - approach);
        let rest = dt - met;
        let leaving = restitution * speed;
        let gap_after = rest * (leaving + 0.5 * acceleration * rest);
        (met >= -dt && rest >= 0.0 && gap_after >= 0.0)
            .then_some((gap_after - gap, leaving + acceleration * rest))
    }
}

/// The poses after a step, from the rotations that are there already.
#[inline(always)]
pub(super) fn renew_poses(bodies: &mut Bodies, runs: &[Range<usize>]) {
    for run in runs.iter().cloned() {
        let poses = bodies.poses[run.clone()].as_chunks_mut::<4>().0.iter_mut();
        let rotations = bodies.rotations[run.clone()].as_chunks::<4>().0;
        let paths = bodies.path[run].as_chunks::<4>().0;
        for ((poses, rotations), path) in poses.zip(rotations).zip(paths) {
            let [dx, dy, ..] = crate::math::lanes::columns(path);
            let [x, y, ..] = crate::math::lanes::columns(poses);
            let (sine, cosine) = turn_of(f32x4::new(*rotations));
            *poses = f32x4::transpose([x + dx, y + dy, cosine, sine]).map(f32x4::to_array);
        }
    }
}

/// How far proxies have come, and which have left their bounds.
#[inline(always)]
pub(super) fn follow(proxies: &mut Proxies, bodies: &Bodies, runs: &[Range<usize>], tuning: &Tuning) {
    let scale = f32x4::splat(tuning.motion_scale());
    let around = f32x4::splat(tuning.speculative);
    let Proxies { all, boxes, bounds, motion, escaped, movable, .. } = proxies;
    for four in runs.iter().flat_map(|run| run.clone().step_by(4)) {
        let of = &all[four..four + 4];
        let places: [u32; 4] = std::array::from_fn(|lane| of[lane].body);
        let [x, y, c, s] = gather(&bodies.poses, &places);
        let [dx, dy, turned, dz] = gather(&bodies.path, &places);
        let [cx, cy, hx, hy] = gather(boxes, &std::array::from_fn(|lane| (four + lane) as u32));
        let radius = f32x4::new(std::array::from_fn(|lane| of[lane].shape.radius));
        let reach = f32x4::new(std::array::from_fn(|lane| of[lane].shape.reach));
        let (x, y) = (x + (c * cx - s * cy), y + (s * cx + c * cy));
        let (ac, as_) = (c.abs(), s.abs());
        let (ex, ey) = (ac * hx + as_ * hy + radius + around, as_ * hx + ac * hy + radius + around);
        let [low_x, low_y, high_x, high_y] =
            gather(bounds, &std::array::from_fn(|lane| (four + lane) as u32));
        let has_left = (x - ex).simd_lt(low_x)
            | (y - ey).simd_lt(low_y)
            | (x + ex).simd_gt(high_x)
            | (y + ey).simd_gt(high_y);
        let way = (dx.abs() + dy.abs() + dz.abs() + reach * turned.abs()) * scale + f32x4::splat(0.999);
        let most = f32x4::splat(1e9);
        let way = select(way.simd_lt(most), way, most).to_array();
        for (motion, way) in motion[four..four + 4].iter_mut().zip(way) {
            *motion = motion.wrapping_add(way as u32);
        }
        let left = has_left.to_bitmask();
        for lane in (0..4).filter(|lane| left >> lane & 1 == 1 && four + lane < *movable) {
            escaped.push((four + lane) as u32);
        }
    }
}
