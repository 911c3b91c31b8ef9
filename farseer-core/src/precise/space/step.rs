//! The stages of a step along the depth axis, and the passes over rows in three axes.

use super::parts::{SpaceBody, SpaceTarget};
use super::passes::Spin;
use super::{Space, begin_spins, gather_warm_in_space, relax_in_space};
use crate::body::Body;
use crate::math::decay;
use crate::math::plane::length;
use crate::precise::Precise;
use crate::precise::bodies::Read;
use crate::precise::moving::leave;
use crate::precise::parameters::depth::RESTITUTION_GRAVITY_STEPS;
use crate::precise::passes::{bounce, note_approach, note_push, solve_soft, solve_soft_beside_joints};
use crate::precise::rows::SpaceRows;
use crate::precise::tuning::Step;

impl Space {
    /// What moves a body along the axis, read with the rest: see [`read`](crate::precise::bodies::read).
    pub(in crate::precise) fn read(
        &mut self,
        number: usize,
        body: &Body,
        read: &mut Read,
        step: &Step,
        id: crate::body::BodyId,
    ) {
        if body.is_kinematic() {
            self.begin_kinematic(id, step.dt);
            read.velocity[3] = self.body(id).velocity;
            return;
        }
        let told = self.body(id);
        if told.target.is_some() {
            self.body_mut(id).target = None;
        }
        read.velocity[3] = told.velocity;
        let (drag, rotational_drag) = body.drag_rates();
        let ((slowed, grown), (turning_slowed, _)) =
            (decay::over(drag, step.dt), decay::over(rotational_drag, step.dt));
        let acceleration = told.acceleration - dragged(body, read.velocity);
        let gained = told.velocity * slowed + acceleration * grown;
        read.push[3] = gained * (step.h / step.dt);
        read.forced[3] = acceleration * (0.5 * step.dt * step.dt);
        let Spin { velocity, .. } = &mut self.spins[number];
        *velocity = [0.0; 4];
        if self.are_balls[number] {
            let [x, y] = told.angular_velocity;
            *velocity = [x + x * turning_slowed, y + y * turning_slowed, 0.0, 0.0];
        }
    }

    /// Where a step has brought a body along the axis, and how it moves now.
    pub(in crate::precise) fn write(
        &mut self,
        number: usize,
        id: crate::body::BodyId,
        [x_way, y_way, _, way]: [f32; 4],
        velocity: f32,
    ) {
        self.places[number] += way;
        if let Some(target) = self.body_mut(id).target.as_mut().filter(|target| !target.is_reached) {
            target.is_reached = true;
            self.places[number] = target.z;
        }
        let ([x, y, ..], z) = (self.spins[number].velocity, self.places[number]);
        let told = self.body_mut(id);
        (told.z, told.velocity, told.acceleration, told.angular_velocity) = (z, velocity, 0.0, [x, y]);
        told.motion = [x_way, y_way, way];
    }

    /// The velocity along the axis that a kinematic body has in the step that comes.
    pub(in crate::precise) fn kinematic_velocity(&self, id: crate::body::BodyId, dt: f32) -> f32 {
        let told = self.body(id);
        match told.target {
            None => told.velocity,
            Some(SpaceTarget { is_reached: true, .. }) => 0.0,
            Some(SpaceTarget { z, .. }) => (z - told.z) / dt,
        }
    }

    /// A kinematic body has the velocity along the axis that leads to where it is brought.
    fn begin_kinematic(&mut self, id: crate::body::BodyId, dt: f32) {
        let velocity = self.kinematic_velocity(id, dt);
        let told = self.body_mut(id);
        let Some(SpaceTarget { is_reached, .. }) = told.target else { return };
        told.velocity = velocity;
        told.target = told.target.filter(|_| !is_reached && told.velocity.is_finite());
    }

    /// Whether the next step moves a kinematic body along the axis.
    pub(in crate::precise) fn is_on_its_way(&self, id: crate::body::BodyId) -> bool {
        let SpaceBody { velocity, target, .. } = self.body(id);
        target.map_or(velocity != 0.0, |target| !target.is_reached)
    }

    /// A body comes to rest.
    pub(in crate::precise) fn rest(&mut self, number: usize, id: crate::body::BodyId) {
        self.spins[number] = Spin::default();
        let told = self.body_mut(id);
        (told.velocity, told.acceleration, told.angular_velocity) = (0.0, 0.0, [0.0; 2]);
        told.motion = [0.0; 3];
        self.rested.push(id);
    }
}

/// What quadratic drag takes of the velocity along the axis in a second.
fn dragged(body: &Body, [x, y, _, z]: [f32; 4]) -> f32 {
    if !body.is_quadratic_drag_enabled() {
        return 0.0;
    }
    let speed = (x * x + y * y + z * z).sqrt();
    z * speed * body.quadratic_drag_coefficient() * body.inverse_mass()
}

/// Passes.
impl Precise {
    pub(in crate::precise) fn note_approaches_in_space(&mut self) -> bool {
        let threshold = self.bounce_threshold_in_space();
        let (hot, SpaceRows { prisms, balls, prisms_fixed, balls_fixed }) =
            (&self.bodies.hot, &mut self.rows.space);
        note_approach::<false, 2, _>(prisms, hot, threshold)
            | note_approach::<false, 1, _>(balls, hot, threshold)
            | note_approach::<true, 2, _>(prisms_fixed, hot, threshold)
            | note_approach::<true, 1, _>(balls_fixed, hot, threshold)
    }

    pub(in crate::precise) fn note_pushes_in_space(&mut self) {
        let SpaceRows { prisms, balls, prisms_fixed, balls_fixed } = &mut self.rows.space;
        note_push(prisms);
        note_push(balls);
        note_push(prisms_fixed);
        note_push(balls_fixed);
    }

    pub(in crate::precise) fn gather_warm_in_space(&mut self, step: &Step) {
        let Precise { bodies, rows, joints, space: Some(space), .. } = self else { return };
        let masks = joints.soft_bodies();
        let (warm, hot) = (&mut bodies.warm, &bodies.hot);
        let (spins, learning) = (&mut space.spins[..], &step.learning);
        spins.iter_mut().for_each(|spin| spin.warm = [0.0; 4]);
        let SpaceRows { prisms, balls, prisms_fixed, balls_fixed } = &mut rows.space;
        gather_warm_in_space::<false, 2>(prisms, warm, hot, spins, (learning, masks));
        gather_warm_in_space::<false, 1>(balls, warm, hot, spins, (learning, masks));
        gather_warm_in_space::<true, 2>(prisms_fixed, warm, hot, spins, (learning, masks));
        gather_warm_in_space::<true, 1>(balls_fixed, warm, hot, spins, (learning, masks));
    }

    /// A substep begins for what turns about all axes.
    pub(in crate::precise) fn begin_spins(&mut self, is_first: bool) {
        if let Some(space) = self.space.as_mut().filter(|space| space.has_balls) {
            begin_spins(&mut space.spins, is_first);
        }
    }

    pub(in crate::precise) fn solve_soft_in_space(&mut self, step: &Step) {
        let (hot, inverse, push) = (&mut self.bodies.hot, 1.0 / step.h, self.tuning.push);
        let SpaceRows { prisms, balls, prisms_fixed, balls_fixed } = &mut self.rows.space;
        if let Some(masks) = self.joints.soft_bodies() {
            let (soft, fixed) = (step.softness_beside_joints(false), step.softness_beside_joints(true));
            solve_soft_beside_joints::<false, 2, _>(prisms, hot, inverse, soft, push, masks);
            solve_soft_beside_joints::<false, 1, _>(balls, hot, inverse, soft, push, masks);
            solve_soft_beside_joints::<true, 2, _>(prisms_fixed, hot, inverse, fixed, push, masks);
            solve_soft_beside_joints::<true, 1, _>(balls_fixed, hot, inverse, fixed, push, masks);
            return;
        }
        solve_soft::<false, 2, _>(prisms, hot, inverse, step.soft, push);
        solve_soft::<false, 1, _>(balls, hot, inverse, step.soft, push);
        solve_soft::<true, 2, _>(prisms_fixed, hot, inverse, step.soft_fixed, push);
        solve_soft::<true, 1, _>(balls_fixed, hot, inverse, step.soft_fixed, push);
    }

    pub(in crate::precise) fn relax_in_space(&mut self, step: &Step) {
        let Precise { bodies, rows, space: Some(space), .. } = self else { return };
        let (hot, spins, inverse) = (&mut bodies.hot, &mut space.spins, 1.0 / step.h);
        let SpaceRows { prisms, balls, prisms_fixed, balls_fixed } = &mut rows.space;
        relax_in_space::<false, 2>(prisms, hot, spins, inverse);
        relax_in_space::<false, 1>(balls, hot, spins, inverse);
        relax_in_space::<true, 2>(prisms_fixed, hot, spins, inverse);
        relax_in_space::<true, 1>(balls_fixed, hot, spins, inverse);
    }

    /// Speed of approach below which nothing bounces. What rests comes no faster than gravity makes it in a step; where there is
    /// none everything bounces.
    fn bounce_threshold_in_space(&self) -> f32 {
        let resting = RESTITUTION_GRAVITY_STEPS * length(self.fall);
        if resting < self.tuning.bounce { resting } else { self.tuning.bounce }
    }

    pub(in crate::precise) fn bounce_in_space(&mut self, step: &Step, is_last: bool) {
        let threshold = self.bounce_threshold_in_space();
        let Precise { rows, bodies, palette, joints, .. } = self;
        let mut hot = std::mem::take(&mut bodies.hot);
        macro_rules! bounce_all {
            ($fixed:literal, $points:literal, $rows:expr) => {
                bounce::<$fixed, $points, _>($rows, &mut hot, threshold, |row, lanes, hot| {
                    if is_last {
                        leave(bodies, hot, (palette, joints), step, row, lanes)
                    } else {
                        joints.note_bounce(&row.row, lanes)
                    }
                })
            };
        }
        let SpaceRows { prisms, balls, prisms_fixed, balls_fixed } = &mut rows.space;
        macro_rules! count_all {
            ($add:expr) => {
                prisms.for_each(|row| row.count($add));
                balls.for_each(|row| row.count($add));
                prisms_fixed.for_each(|row| row.count($add));
                balls_fixed.for_each(|row| row.count($add));
            };
        }
        count_all!(|total, impulse| total - impulse);
        bounce_all!(false, 2, prisms);
        bounce_all!(false, 1, balls);
        bounce_all!(true, 2, prisms_fixed);
        bounce_all!(true, 1, balls_fixed);
        count_all!(|total, impulse| total + impulse);
        bodies.hot = hot;
    }

    /// Impulses across the normals that are not those of the plane.
    pub(in crate::precise) fn for_each_impulse_in_space(&mut self, change: &impl Fn(&mut wide::f32x4)) {
        fn both<const P: usize>(row: &mut super::SpaceRow<P>, change: &impl Fn(&mut wide::f32x4)) {
            for impulse in [&mut row.row.tangent_impulse, &mut row.across_impulse, &mut row.twist_impulse] {
                change(impulse);
            }
            row.totals.iter_mut().for_each(change);
            for point in &mut row.row.points {
                change(&mut point.impulse);
                change(&mut point.held);
            }
        }
        let SpaceRows { prisms, balls, prisms_fixed, balls_fixed } = &mut self.rows.space;
        prisms.for_each(|row| both(row, change));
        balls.for_each(|row| both(row, change));
        prisms_fixed.for_each(|row| both(row, change));
        balls_fixed.for_each(|row| both(row, change));
    }
}
