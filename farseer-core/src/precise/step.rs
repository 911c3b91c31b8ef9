//! The stages of a step.

use crate::precise::parameters::broad_phase::COORDINATE_HEADROOM;
use crate::precise::parameters::contacts::{JOINTED_RESTITUTION_ERROR, JOINTED_RESTITUTION_PASSES};
use wide::f32x4;

use super::Precise;
use super::bodies::{Bodies, Read, read};
use super::moving::{begin_substep, displace, even_out, fly, follow, leave, renew_poses};
use super::passes::{
    bounce, gather_warm, note_approach, note_push, relax, renew_circle, renew_circles, solve_soft,
    solve_soft_beside_joints,
};
use super::touch::Looks;
pub(crate) use super::tuning::Step;
use super::tuning::Widening;
use crate::math::Vector2;
use crate::objects::Objects;
use crate::report::{Event, Report};

/// The bounds of the ground.
const BELOW: [f32; 4] = [f32::MIN, 0.0, f32::MAX, f32::MAX];

/// Nothing instead of what is not finite.
fn finite(numbers: f32x4) -> f32x4 {
    numbers & (numbers * f32x4::ZERO).simd_eq(f32x4::ZERO)
}

impl Precise {
    /// Third stage: what may have changed is looked at. Answers how many pairs that were.
    pub(crate) fn find_contacts(&mut self, friction: crate::FrictionType, most_contacts: u32) -> usize {
        self.looks = Looks::default();
        self.rolling.clear();
        self.let_go();
        let has_friction_changed = std::mem::replace(&mut self.friction, friction) != friction;
        let has_limit_changed = std::mem::replace(&mut self.most_contacts, most_contacts) != most_contacts;
        if has_friction_changed || has_limit_changed {
            self.wake_all();
            (0..self.pairs.len()).for_each(|pair| self.pairs.look_again(pair));
        }
        if std::mem::take(&mut self.has_handled) {
            self.forget_answers();
        }
        let mut lost = std::mem::take(&mut self.lost);
        let reach = self.tuning.speculative;
        renew_circles(&mut self.rows.one, &self.bodies.poses, &self.bodies.circles, reach, |pair| {
            lost.push(pair)
        });
        self.rows.change_direct(|lane| {
            let renewed = renew_circle(lane, &self.bodies.poses, &self.bodies.circles, reach);
            lost.extend((renewed == Some(true)).then_some(lane.pair));
            renewed.is_some()
        });
        lost.sort_unstable();
        let circles = lost.len();
        for pair in lost.drain(..) {
            self.touch().look(pair as usize);
        }
        self.lost = lost;
        let looked_at = circles + self.look_at_unpushed() + self.touch().scan();
        self.look_ahead_of_kinematic();
        self.remember_sunk();
        looked_at
    }

    /// What handlers have refused or changed was for one step; what sleeps keeps it until it wakes.
    fn forget_answers(&mut self) {
        for pair in 0..self.pairs.len() {
            let is_awake = pair < self.pairs.awake;
            let was_vetoed = std::mem::take(&mut self.pairs.all[pair].is_vetoed);
            self.pairs.all[pair].was_vetoed = was_vetoed;
            self.has_handled |= was_vetoed;
            if was_vetoed && is_awake {
                self.pairs.look_again(pair);
            }
            if is_awake && std::mem::take(&mut self.pairs.all[pair].is_set) {
                self.touch().renew_surface(pair);
            }
        }
    }

    /// Fourth stage: forces are taken from the bodies. One whose velocity would not be finite keeps it and is disabled.
    pub(crate) fn read_bodies(
        &mut self,
        objects: &mut Objects,
        gravity: Vector2,
        step: &Step,
        report: &mut Report,
    ) {
        let Precise { bodies, sleep, is_stale, space, .. } = self;
        let substeps = f32x4::splat(step.substeps as f32);
        for run in &sleep.bodies {
            let (hot, before) = (&mut bodies.hot[run.clone()], &mut bodies.before[run.clone()]);
            let (push, forced) = (&mut bodies.push[run.clone()], &mut bodies.forced[run.clone()]);
            let ids = run.clone().zip(&bodies.ids[run.clone()]);
            for ((((hot, before), push), forced), (number, id)) in
                hot.iter_mut().zip(before).zip(push).zip(forced).zip(ids)
            {
                let entry = id.filter(|_| !sleep.is_asleep(number)).and_then(|id| objects.bodies.get_mut(id));
                let (Some(id), Some(entry)) = (*id, entry) else { continue };
                let mut read = read(&mut entry.body, gravity, step.dt, step.h);
                if let Some(space) = space {
                    space.read(number, &entry.body, &mut read, step, id);
                }
                let then = f32x4::new(read.velocity) + f32x4::new(read.push) * substeps;
                if !(then * f32x4::ZERO).simd_eq(f32x4::ZERO).all() {
                    read = Read::default();
                    entry.body.set_enabled(false);
                    report.push(Event::NotFinite { body: id, disabled: true });
                    *is_stale = true;
                }
                (hot.velocity, *before) = (read.velocity, read.velocity);
                (*push, *forced) = (read.push, read.forced);
            }
        }
        self.begin_steady();
        self.read_fixtures();
    }

    /// Seconds of the step before the one that is due; 0 if there was none.
    pub(crate) fn last_step(&self) -> f32 {
        self.dt
    }

    /// The step that is due.
    pub(crate) fn begin(&mut self, dt: f32, substeps: u32, gravity: Vector2, may_sleep: bool) -> Step {
        self.set_sleep(may_sleep, gravity);
        self.space.iter_mut().for_each(|space| space.rested.clear());
        (self.dt, self.fall) = (dt, [gravity.x * dt, gravity.y * dt]);
        self.begin_fixtures(dt);
        Step::new(dt, substeps, &self.tuning)
    }

    /// Sixth stage: bodies are where the step has brought them. What would not be finite stays where and as it was, and
    /// forgets the impulses that did it; of several that touch each other the one that was fastest is disabled. Those who have
    /// moved are the last ones that are told.
    pub(crate) fn write_bodies(&mut self, objects: &mut Objects, report: &mut Report) {
        self.end_kinematic();
        if !self.is_finite() {
            self.put_back(objects, report);
        }
        let Precise { bodies, sleep, space, .. } = self;
        for run in &sleep.bodies {
            let (hot, rotations) = (&bodies.hot[run.clone()], &mut bodies.rotations[run.clone()]);
            let (poses, paths) = (&bodies.poses[run.clone()], &bodies.path[run.clone()]);
            let ids = run.clone().zip(&bodies.ids[run.clone()]);
            for ((((hot, rotation), pose), path), (number, id)) in
                hot.iter().zip(rotations).zip(poses).zip(paths).zip(ids)
            {
                let id = id.filter(|_| !sleep.is_asleep(number));
                let Some(entry) = id.and_then(|id| objects.bodies.get_mut(id)) else { continue };
                let ([x, y, ..], [dx, dy, turned, _]) = (*pose, *path);
                let [vx, vy, spin, vz] = hot.velocity;
                entry.body.end_step(Vector2::new(x + dx, y + dy), turned, Vector2::new(vx, vy), spin);
                *rotation = entry.body.rotation();
                if let (Some(space), Some(id)) = (&mut *space, id) {
                    space.write(number, id, *path, vz);
                }
                if let Some(body) = id.filter(|_| *path != [0.0; 4]) {
                    report.counters.bodies_moved += 1;
                    report.push(Event::BodyUpdated { body });
                }
            }
        }
        renew_poses(bodies, &sleep.bodies);
        for at in 0..self.bodies.kinematic.len() {
            let number = self.bodies.kinematic[at] as usize;
            // Targets are reached to the last bit.
            if let Some(entry) = self.bodies.ids[number].and_then(|id| objects.bodies.get(id)) {
                self.bodies.move_to(number, &entry.body);
            }
        }
        self.end_steady();
        self.write_fixtures();
    }

    /// Kinematic bodies have come as far as their velocity says, whatever has touched them.
    fn end_kinematic(&mut self) {
        let Bodies { kinematic, hot, before, path, .. } = &mut self.bodies;
        for &number in kinematic.iter() {
            let number = number as usize;
            hot[number].velocity = before[number];
            path[number] = before[number].map(|velocity| velocity * self.dt);
        }
    }

    fn is_finite(&self) -> bool {
        let Bodies { poses, path, hot, .. } = &self.bodies;
        let mut sum = f32x4::ZERO;
        for run in &self.sleep.bodies {
            let of_run = poses[run.clone()].iter().zip(&path[run.clone()]).zip(&hot[run.clone()]);
            for ((pose, path), hot) in of_run {
                // Corners are not far from their body: what is left of the numbers is enough for them.
                let place = (f32x4::new(*pose) + f32x4::new(*path)) * f32x4::splat(COORDINATE_HEADROOM);
                sum += (place + f32x4::new(hot.velocity)) * f32x4::ZERO;
            }
        }
        sum.to_array() == [0.0; 4] && self.is_finite_in_space()
    }

    /// Also along the depth axis, and of what turns about all.
    fn is_finite_in_space(&self) -> bool {
        self.space.as_ref().is_none_or(|space| {
            self.sleep.awake(self.bodies.count).all(|number| {
                let place = (space.places[number] + self.bodies.path[number][3]) * COORDINATE_HEADROOM;
                place.is_finite() && space.is_spin_finite(number)
            })
        })
    }

    #[cold]
    fn put_back(&mut self, objects: &mut Objects, report: &mut Report) {
        let is_finite = |number: usize| {
            let (pose, path) = (self.bodies.poses[number], self.bodies.path[number]);
            let velocity = self.bodies.hot[number].velocity;
            let z = self.space.as_ref().map_or(0.0, |space| space.places[number]);
            let from = [pose[0], pose[1], 0.0, z];
            let spins = self.space.as_ref().is_none_or(|space| space.is_spin_finite(number));
            spins
                && (0..4).all(|i| {
                    velocity[i].is_finite() && ((path[i] + from[i]) * COORDINATE_HEADROOM).is_finite()
                })
        };
        let lost: Vec<usize> =
            self.sleep.awake(self.bodies.count).filter(|&number| !is_finite(number)).collect();
        let speed = |number: usize| {
            let [x, y, spin, z] = self.bodies.before[number].map(f64::from);
            x * x + y * y + spin * spin + z * z
        };
        let fastest = lost.iter().map(|&number| speed(number)).fold(0.0, f64::max);
        for &number in &lost {
            let disabled = speed(number) >= fastest;
            (self.bodies.hot[number].velocity, self.bodies.path[number]) =
                (self.bodies.before[number], [0.0; 4]);
            let Some(body) = self.bodies.ids[number] else { continue };
            if let Some(space) = self.space.as_deref_mut() {
                space.stop_spinning(number);
                space.body_mut(body).target = None;
            }
            if let Some(entry) = objects.bodies.get_mut(body).filter(|_| disabled) {
                entry.body.set_enabled(false);
                entry.body.forget_target();
                self.is_stale = true;
            }
            report.push(Event::NotFinite { body, disabled });
        }
        self.forget_infinite_impulses();
    }

    /// Impulses that are not finite, and what springs have learnt of them, are forgotten.
    fn forget_infinite_impulses(&mut self) {
        self.for_each_impulse(|impulse| *impulse = finite(*impulse));
        let mut forget = |points: &mut [super::rows::Point]| {
            points.iter_mut().for_each(|point| point.separation = finite(point.separation));
        };
        self.rows.two.for_each(|row| forget(&mut row.points));
        self.rows.one.for_each(|row| forget(&mut row.points));
        self.rows.two_fixed.for_each(|row| forget(&mut row.points));
        self.rows.one_fixed.for_each(|row| forget(&mut row.points));
        self.rows.space.for_each_point(&mut forget);
    }

    /// What rows that are awake have of impulses, and of what springs have learnt of them.
    fn for_each_impulse(&mut self, change: impl Fn(&mut f32x4)) {
        if self.space.is_some() {
            return self.for_each_impulse_in_space(&change);
        }
        let change = |tangent: &mut f32x4, points: &mut [super::rows::Point]| {
            change(tangent);
            for point in points {
                change(&mut point.impulse);
                change(&mut point.held);
            }
        };
        self.rows.two.for_each(|row| change(&mut row.tangent_impulse, &mut row.points));
        self.rows.one.for_each(|row| change(&mut row.tangent_impulse, &mut row.points));
        self.rows.two_fixed.for_each(|row| change(&mut row.tangent_impulse, &mut row.points));
        self.rows.one_fixed.for_each(|row| change(&mut row.tangent_impulse, &mut row.points));
    }

    /// Fifth stage: velocities and ways.
    pub(crate) fn solve(&mut self, step: &Step) {
        if self.h != step.h {
            self.scale_impulses(step.h);
        }
        self.choose_methods(&step.learning);
        self.begin_swings(step);
        self.solve_direct(step);
        self.joints.swing(&self.bodies, step);
        if self.rows.is_empty() && self.joints.are_all_apart() && self.springs.are_all_solved() {
            fly(&mut self.bodies, &self.sleep.bodies, step);
            self.joints.share_depth_of_flight(&mut self.bodies, step.dt);
        } else {
            self.solve_passes(step);
        }
        self.joints.finish(&mut self.bodies, step);
        self.finish_direct(step);
        self.end_swings(step);
    }

    fn solve_passes(&mut self, step: &Step) {
        let may_bounce = self.bounces && self.note_approaches();
        self.gather_warm(step);
        self.warm_swings();
        self.begin_rolls(step);
        for substep in 0..step.substeps {
            self.push_swings(step.h, substep == 0);
            self.renew_rolls(step, substep == 0);
            begin_substep(&mut self.bodies, &self.sleep.bodies, substep == 0);
            self.begin_spins(substep == 0);
            self.joints.correct(&mut self.bodies, step.h);
            self.hold_swings(step.h);
            self.solve_soft(step);
            self.hold_swings(step.h);
            if may_bounce {
                self.note_pushes();
            }
            self.joints.share_depth(&mut self.bodies);
            self.joints.limit_speeds(&mut self.bodies, step.h);
            displace(&mut self.bodies, &self.sleep.bodies, step.h, substep == 0);
            self.turn_swings();
            self.lean_rolls();
            self.joints.advance(&mut self.bodies, step.h);
            self.joints.relax(&mut self.bodies, step.h);
            self.relax(step);
            self.hold_swings(step.h);
            self.joints.share_depth(&mut self.bodies);
            if may_bounce {
                self.note_pushes();
            }
        }
        self.note_paths_of_rolls();
        let Precise { bodies, sleep, palette, joints, tuning, .. } = self;
        even_out(bodies, &sleep.bodies, (palette, joints), tuning.speculative, step);
        self.restore_paths_of_rolls();
        if may_bounce {
            self.bounce(step);
        }
        self.end_rolls(step);
    }

    /// Impulses are forces times the length of a substep: they follow it.
    fn scale_impulses(&mut self, h: f32) {
        let factor = f32x4::splat(h / self.h);
        self.h = h;
        self.for_each_impulse(|impulse| *impulse = finite(*impulse * factor));
    }

    /// Answers whether something may bounce in this step.
    fn note_approaches(&mut self) -> bool {
        if self.space.is_some() {
            return self.note_approaches_in_space();
        }
        let (hot, threshold) = (&self.bodies.hot, self.tuning.bounce);
        note_approach::<false, 2, _>(&mut self.rows.two, hot, threshold)
            | note_approach::<false, 1, _>(&mut self.rows.one, hot, threshold)
            | note_approach::<true, 2, _>(&mut self.rows.two_fixed, hot, threshold)
            | note_approach::<true, 1, _>(&mut self.rows.one_fixed, hot, threshold)
    }

    fn note_pushes(&mut self) {
        if self.space.is_some() {
            return self.note_pushes_in_space();
        }
        note_push(&mut self.rows.two);
        note_push(&mut self.rows.one);
        note_push(&mut self.rows.two_fixed);
        note_push(&mut self.rows.one_fixed);
    }

    fn gather_warm(&mut self, step: &Step) {
        self.joints.begin_passes(&self.springs, &self.bodies, step);
        let (warm, hot) = (&mut self.bodies.warm, &self.bodies.hot);
        self.sleep.bodies.iter().for_each(|run| warm[run.clone()].fill([0.0; 4]));
        if self.space.is_some() {
            self.gather_warm_in_space(step);
        } else {
            let masks = self.joints.soft_bodies();
            gather_warm::<false, 2>(&mut self.rows.two, warm, hot, &step.learning, masks);
            gather_warm::<false, 1>(&mut self.rows.one, warm, hot, &step.learning, masks);
            gather_warm::<true, 2>(&mut self.rows.two_fixed, warm, hot, &step.learning, masks);
            gather_warm::<true, 1>(&mut self.rows.one_fixed, warm, hot, &step.learning, masks);
        }
        self.joints.warm(&mut self.bodies);
    }

    fn solve_soft(&mut self, step: &Step) {
        if self.space.is_some() {
            return self.solve_soft_in_space(step);
        }
        let (hot, inverse, push) = (&mut self.bodies.hot, 1.0 / step.h, self.tuning.push);
        if let Some(masks) = self.joints.soft_bodies() {
            let (soft, fixed) = (step.softness_beside_joints(false), step.softness_beside_joints(true));
            let rows = &mut self.rows;
            solve_soft_beside_joints::<false, 2, _>(&mut rows.two, hot, inverse, soft, push, masks);
            solve_soft_beside_joints::<false, 1, _>(&mut rows.one, hot, inverse, soft, push, masks);
            solve_soft_beside_joints::<true, 2, _>(&mut rows.two_fixed, hot, inverse, fixed, push, masks);
            solve_soft_beside_joints::<true, 1, _>(&mut rows.one_fixed, hot, inverse, fixed, push, masks);
            return;
        }
        solve_soft::<false, 2, _>(&mut self.rows.two, hot, inverse, step.soft, push);
        solve_soft::<false, 1, _>(&mut self.rows.one, hot, inverse, step.soft, push);
        solve_soft::<true, 2, _>(&mut self.rows.two_fixed, hot, inverse, step.soft_fixed, push);
        solve_soft::<true, 1, _>(&mut self.rows.one_fixed, hot, inverse, step.soft_fixed, push);
    }

    fn relax(&mut self, step: &Step) {
        if self.space.is_some() {
            return self.relax_in_space(step);
        }
        let (hot, inverse) = (&mut self.bodies.hot, 1.0 / step.h);
        relax::<false, 2>(&mut self.rows.two, hot, inverse);
        relax::<false, 1>(&mut self.rows.one, hot, inverse);
        relax::<true, 2>(&mut self.rows.two_fixed, hot, inverse);
        relax::<true, 1>(&mut self.rows.one_fixed, hot, inverse);
    }

    /// A blow on one of several bodies that joints hold together is one on all of them: before bodies leave, contacts and joints are
    /// swept by Gauss-Seidel for the velocities after it.
    fn bounce(&mut self, step: &Step) {
        if self.joints.soft_bodies().is_some() {
            for _ in 0..JOINTED_RESTITUTION_PASSES {
                self.joints.begin_bounce();
                self.bounce_rows(step, false);
                if self.joints.bounce(&mut self.bodies) <= JOINTED_RESTITUTION_ERROR * self.tuning.bounce {
                    break;
                }
            }
        }
        self.bounce_rows(step, true);
    }

    /// One pass over the rows that bounce; in the last one bodies leave.
    fn bounce_rows(&mut self, step: &Step, is_last: bool) {
        if self.space.is_some() {
            return self.bounce_in_space(step, is_last);
        }
        let threshold = self.tuning.bounce;
        let Precise { rows, bodies, palette, joints, .. } = self;
        let mut hot = std::mem::take(&mut bodies.hot);
        macro_rules! bounce_all {
            ($fixed:literal, $points:literal, $rows:expr) => {
                bounce::<$fixed, $points, _>($rows, &mut hot, threshold, |row, lanes, hot| {
                    if is_last {
                        leave(bodies, hot, (palette, joints), step, row, lanes)
                    } else {
                        joints.note_bounce(row, lanes)
                    }
                })
            };
        }
        bounce_all!(false, 2, &mut rows.two);
        bounce_all!(false, 1, &mut rows.one);
        bounce_all!(true, 2, &mut rows.two_fixed);
        bounce_all!(true, 1, &mut rows.one_fixed);
        bodies.hot = hot;
    }

    /// Last stage: who has left its bounds gets new ones.
    pub(crate) fn follow(&mut self) {
        follow(&mut self.proxies, &self.bodies, &self.sleep.proxies, &self.tuning);
        if let Some(space) = &self.space {
            space.follow(&mut self.proxies, &self.bodies, &self.sleep.proxies, &self.tuning);
        }
        for at in 0..self.proxies.escaped.len() {
            let proxy = self.proxies.escaped[at];
            let reach = self.proxies.all[proxy as usize].shape.reach;
            let widening = match self.pairs.of(proxy).next() {
                None => self.tuning.widening_of_lonely(reach),
                Some(_) => self.tuning.widening(reach),
            };
            self.widen_by(proxy, widening);
        }
    }

    /// Gives a proxy new bounds: the same whatever pairs it is in.
    pub(super) fn widen(&mut self, proxy: u32) {
        self.widen_by(proxy, self.tuning.widening(self.proxies.all[proxy as usize].shape.reach));
    }

    fn widen_by(&mut self, proxy: u32, widening: Widening) {
        let bounds = self.proxies.widened(proxy as usize, &self.bodies, &self.tuning, widening, self.dt);
        self.proxies.bounds[proxy as usize] = bounds;
        let Some(space) = &mut self.space else { return self.grid.set(proxy, &bounds) };
        if proxy == space.ground {
            self.proxies.bounds[proxy as usize] = BELOW;
        }
        let body = self.proxies.all[proxy as usize].body;
        let speed = self.bodies.hot.get(body as usize).map_or(0.0, |hot| hot.velocity[3]);
        space.widen(proxy, body, speed * self.dt, widening, self.tuning.speculative);
        if space.is_in_grid(proxy) {
            self.grid.set(proxy, &space.cells(proxy, &bounds));
        }
    }
}
