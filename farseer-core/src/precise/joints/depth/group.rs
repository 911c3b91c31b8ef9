//! Bodies that joints tie together in three axes, solved at once.
//!
//! In every substep velocities are found with which all numbers are at its *end* what they are, by the method of Newton with
//! the directions at its beginning (SHAKE), and after it velocities with which they stay so (RATTLE): see [`swing`] for both.
//! What undoes errors moves bodies and is no part of their velocities, so that no energy comes of what cannot be. What
//! a push on one number does to another one goes by the bodies that both hold: a [sparse matrix](super::sparse), which is
//! factored once for each of the two. Bounds, as of ropes that only pull, are found by an active set: a row whose impulse has
//! the wrong sign leaves it, a row that is violated joins it.
//!
//! [`swing`]: super::super::swing

use super::super::super::bodies::Bodies;
use super::super::forest::GROUND;
use super::super::hold::Hold;
use super::row::{Motion, Pass, Row, Tie, What, product};
use super::sparse::Sparse;
use crate::precise::parameters::spatial_joints::{
    ACTIVE_SET_ITERATIONS, GROUP_ERROR_CONVERGED, GROUP_ERROR_FLOOR, GROUP_SWEEPS, LOOP_COMPLIANCE,
    LOOP_STIFFNESS, LOOP_VELOCITY_ITERATIONS, POSITION_ERROR_IN_MOTION, TREE_VELOCITY_ITERATIONS,
};
use crate::storage::reusing_clone::reusing_clone;

/// Bodies, and the joints that tie them.
#[derive(Debug, Default)]
pub(in super::super) struct SpatialGroup {
    pub(super) bodies: Vec<u32>,
    pub(super) inverses: Vec<Motion>,
    pub(super) velocities: Vec<Motion>,
    /// What of them in this substep only undoes errors, and is no motion.
    pub(super) undoing: Vec<Motion>,
    pub(super) ties: Vec<Tie>,
    pub(super) rows: Vec<Row>,
    /// Two numbers and the sides at which they hold the same body, and where the matrix keeps what that means.
    pub(super) shared: Vec<Shared>,
    /// `None` if that were too much.
    pub(super) sparse: Option<Sparse>,
    pub(super) missing: Vec<f64>,
    pub(super) is_looped: bool,
    pub(super) unit: f64,
    /// Nothing touches it: it goes through a step by itself, each substep in so many parts.
    pub(super) is_apart: bool,
    pub(super) parts: u32,
    /// The ways of its bodies then, and its joints at the beginning of the step.
    pub(super) ways: Vec<Motion>,
    pub(super) begun: Vec<Tie>,
    /// Velocities before the joints act in a substep.
    pub(super) before: Vec<Motion>,
    /// Energy can only be lost: nothing moves or drives it.
    pub(super) is_passive: bool,
}

reusing_clone! {
    SpatialGroup { bodies, inverses, velocities, undoing, ties, rows, shared, sparse, missing, is_looped, unit, is_apart, parts, ways,
        begun, before, is_passive }
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Shared {
    pub(super) node: u32,
    pub(super) rows: [u32; 2],
    pub(super) sides: [u8; 2],
    pub(super) entry: u32,
}

impl SpatialGroup {
    /// The bodies that it holds.
    pub(in super::super) fn bodies(&self) -> &[u32] {
        &self.bodies
    }

    /// Its joints.
    pub(in super::super) fn holds(&self) -> impl Iterator<Item = usize> + '_ {
        self.ties.iter().map(|tie| tie.hold as usize)
    }

    /// Whether nothing touches it.
    pub(in super::super) fn is_apart(&self) -> bool {
        self.is_apart
    }

    /// Into how many parts its last substeps were divided.
    pub(in super::super) fn parts(&self) -> u32 {
        self.parts
    }

    /// Finds that out.
    pub(in super::super) fn part_from_others(&mut self, is_touched: impl Fn(usize) -> bool) {
        self.is_apart = !self.bodies.iter().any(|&body| is_touched(body as usize));
    }

    /// A step begins. `depth_of` answers where along the depth axis the body of a side is.
    pub(in super::super) fn begin(
        &mut self,
        holds: &[Hold],
        bodies: &Bodies,
        [dt, h]: [f64; 2],
        unit: f64,
        depth_of: impl Fn(&Hold, usize) -> f32,
    ) {
        self.unit = unit;
        for tie in &mut self.ties {
            let hold = &holds[tie.hold as usize];
            for (at, side) in tie.sides.iter_mut().enumerate() {
                let (end, z) = (&hold.ends[at], f64::from(depth_of(hold, at)));
                (side.place, side.arm, side.turned) = ([end.place[0], end.place[1], z], end.arm, 0.0);
                let along_z = bodies.hot.get(end.pose as usize).map_or(0.0, |hot| f64::from(hot.velocity[3]));
                let [x, y, spin] = end.velocity;
                side.ground = [x, y, spin, if end.pose == 0 { 0.0 } else { along_z }];
            }
            (tie.line, tie.total, tie.direction) = (hold.axis, [0.0; 4], [1.0, 0.0, 0.0]);
            tie.is_central = tie.sides.iter().all(|side| side.arm == [0.0; 2]);
            tie.find_direction();
        }
        self.is_passive = self.ties.iter().all(|tie| tie.sides.iter().all(|side| side.ground == [0.0; 4]))
            && !self.rows.iter().any(|row| matches!(row.what, What::Motor(_)));
        let parts = if self.is_apart { self.parts_of(holds, h) } else { 1 };
        self.begin_rows(holds, [dt, h], parts);
    }

    /// Substeps are to be divided into so many parts.
    pub(super) fn begin_rows(&mut self, holds: &[Hold], [dt, h]: [f64; 2], parts: u32) {
        self.parts = parts;
        let (parts, unit) = (f64::from(parts), self.unit);
        for row in &mut self.rows {
            let tie = &self.ties[row.tie as usize];
            row.begin(tie, &holds[tie.hold as usize], ([dt, h / parts], unit), parts);
        }
        if self.is_looped {
            self.bind_loops(h / parts);
        }
    }

    /// A pass before bodies move: joints will hold where they are then.
    pub(in super::super) fn correct(&mut self, holds: &[Hold], bodies: &mut Bodies, h: f64) {
        self.load(bodies);
        if !self.correct_velocities(holds, h, true) {
            self.correct_in_line(holds, h);
        }
        self.store(bodies);
    }

    /// Answers whether there are such velocities, as far as could be found; some errors may be left if it is to be so.
    pub(super) fn correct_velocities(&mut self, holds: &[Hold], h: f64, may_leave: bool) -> bool {
        self.before.clone_from(&self.velocities);
        self.rows.iter_mut().for_each(|row| row.impulse = 0.0);
        self.aim(holds);
        for row in &mut self.rows {
            row.choose_end(&self.ties[row.tie as usize], holds, &self.velocities, h);
        }
        let has_errors = self.rows.iter().any(|row| row.part_undone() > POSITION_ERROR_IN_MOTION);
        let pass = if has_errors { Pass::Keep } else { Pass::Undo };
        if !self.solve(holds, h, (pass, may_leave)) {
            return false;
        }
        self.rows.iter_mut().for_each(|row| row.kept_impulse = row.impulse);
        self.undoing.clear();
        self.undoing.resize(self.velocities.len(), [0.0; 4]);
        if has_errors {
            self.undoing.copy_from_slice(&self.velocities);
            let is_solved = self.solve(holds, h, (Pass::Undo, true));
            for (undoing, velocity) in self.undoing.iter_mut().zip(&mut self.velocities) {
                let kept = *undoing;
                *undoing = std::array::from_fn(|i| if is_solved { velocity[i] - kept[i] } else { 0.0 });
                if !is_solved {
                    *velocity = kept;
                }
            }
        }
        true
    }

    /// Instead of velocities that could not be found: with which the numbers do not change at first. That takes no energy but from
    /// them. The errors that it leaves are undone later.
    pub(super) fn correct_in_line(&mut self, holds: &[Hold], h: f64) {
        self.velocities.clone_from(&self.before);
        self.rows.iter_mut().for_each(|row| row.impulse = 0.0);
        self.solve(holds, h, (Pass::Relax, true));
        self.rows.iter_mut().for_each(|row| row.kept_impulse = row.impulse);
        self.undoing.clear();
        self.undoing.resize(self.velocities.len(), [0.0; 4]);
    }

    /// Bodies have moved.
    pub(in super::super) fn advance(&mut self, bodies: &Bodies, h: f64) {
        self.load(bodies);
        self.advance_ties(h);
    }

    pub(super) fn advance_ties(&mut self, h: f64) {
        let velocities = &self.velocities;
        self.ties.iter_mut().for_each(|tie| tie.advance(velocities, h));
    }

    /// A pass after bodies have moved: velocities as joints allow them.
    pub(in super::super) fn relax(&mut self, holds: &[Hold], bodies: &mut Bodies, h: f64) {
        self.load(bodies);
        self.relax_velocities(holds, h);
        self.store(bodies);
    }

    pub(super) fn relax_velocities(&mut self, holds: &[Hold], h: f64) {
        for (undoing, velocity) in self.undoing.iter().zip(&mut self.velocities) {
            (0..4).for_each(|i| velocity[i] -= undoing[i]);
        }
        self.rows.iter_mut().for_each(|row| row.impulse = row.kept_impulse);
        self.aim(holds);
        self.solve(holds, h, (Pass::Relax, true));
        for row in &self.rows {
            let tie = &mut self.ties[row.tie as usize];
            row.count(tie.link, &mut tie.total);
        }
    }

    /// What has held its joints in a step.
    pub(in super::super) fn finish(&self, holds: &mut [Hold], bodies: &mut Bodies, dt: f64) {
        self.end_swing(bodies);
        for tie in &self.ties {
            let [x, y, turning, z] = tie.total.map(|impulse| impulse / dt);
            let hold = &mut holds[tie.hold as usize];
            (hold.force, hold.force_along_depth) = ([x, y, turning], z as f32);
        }
    }

    pub(super) fn load(&mut self, bodies: &Bodies) {
        for (velocity, &body) in self.velocities.iter_mut().zip(&self.bodies) {
            *velocity = bodies.hot[body as usize].velocity.map(f64::from);
        }
    }

    /// What joints do to velocities acts once: see [`store`](super::super::store).
    fn store(&self, bodies: &mut Bodies) {
        for (velocity, &body) in self.velocities.iter().zip(&self.bodies) {
            let (now, begun) = (&mut bodies.hot[body as usize].velocity, &mut bodies.begun[body as usize]);
            for i in 0..4 {
                let next = velocity[i] as f32;
                begun[i] += next - now[i];
                now[i] = next;
            }
        }
    }

    /// Rows are as bodies are where a pass begins.
    fn aim(&mut self, holds: &[Hold]) {
        for row in &mut self.rows {
            let tie = &self.ties[row.tie as usize];
            row.aim(tie, &holds[tie.hold as usize], &self.inverses);
        }
    }

    /// Answers whether nothing is missing then; if something may be left, whether less is missing than before.
    fn solve(&mut self, holds: &[Hold], h: f64, (pass, may_leave): (Pass, bool)) -> bool {
        let Some(mut sparse) = self.sparse.take() else {
            self.solve_by_turns(holds, h, pass);
            return self.velocities.iter().flatten().all(|velocity| velocity.is_finite());
        };
        let least = if self.is_looped { LOOP_VELOCITY_ITERATIONS } else { TREE_VELOCITY_ITERATIONS };
        let mut has_stopped = false;
        let (mut first, mut last) = (0.0, 0.0);
        for look in 0..ACTIVE_SET_ITERATIONS {
            // In the end who has stopped to push does so for good: what it has not taken has to be shared among the others.
            let (worst, others_push) = self.find_missing(holds, (h, pass), look < ACTIVE_SET_ITERATIONS / 2);
            last = worst;
            if look == 0 {
                first = worst;
            }
            if !has_stopped && (worst * h <= GROUP_ERROR_FLOOR * self.unit || (look >= least && !others_push))
            {
                break;
            }
            if look == 0 || others_push {
                self.assemble(&mut sparse);
            }
            sparse.solve(&mut self.missing);
            has_stopped = self.push_all();
        }
        self.sparse = Some(sparse);
        if has_stopped {
            self.solve_by_turns(holds, h, pass);
            (last, _) = self.find_missing(holds, (h, pass), true);
        }
        let is_found = last * h <= GROUP_ERROR_CONVERGED * self.unit;
        if is_found || (!may_leave && !self.is_looped) { is_found } else { last <= first }
    }

    /// Tension makes a rope stiff against going aside, and a stiff thing overshoots where a substep is too long for it. What a
    /// load pulls has its measure; what a loop pulls that cannot close has none, and is bound by what the links bear.
    fn bind_loops(&mut self, h: f64) {
        let of_distance = self.rows.iter().filter(|row| row.what == What::Distance);
        let softest = of_distance.map(|row| {
            let tie = &self.ties[row.tie as usize];
            let inverse: f64 = tie.sides.iter().map(|side| side.inverse_mass(&self.inverses)).sum();
            inverse / tie.distance().max(GROUP_ERROR_FLOOR * self.unit)
        });
        let most = LOOP_STIFFNESS / (h * softest.fold(0.0, f64::max));
        for row in self.rows.iter_mut().filter(|row| row.closes_loop && row.what == What::Distance) {
            row.bind(most);
        }
    }

    /// What is missing of each number. Answers the most that is missing, and whether others push than before.
    fn find_missing(&mut self, holds: &[Hold], (h, pass): (f64, Pass), may_begin: bool) -> (f64, bool) {
        let (mut worst, mut others_push) = (0.0_f64, false);
        for (row, missing) in self.rows.iter_mut().zip(&mut self.missing) {
            let tie = &self.ties[row.tie as usize];
            *missing = row.missing((tie, holds), &self.velocities, (h, pass));
            let [low, high] = row.bounds;
            let is_bound = (row.impulse <= low && *missing > 0.0) || (row.impulse >= high && *missing < 0.0);
            let pushes = !is_bound && (may_begin || row.is_active) && row.answer + row.softness > 0.0;
            others_push |= std::mem::replace(&mut row.is_active, pushes) != pushes;
            if pushes {
                // Not a number is not less than anything.
                worst = if missing.abs() <= worst { worst } else { missing.abs() };
            } else {
                *missing = 0.0;
            }
        }
        (worst, others_push)
    }

    /// The matrix of those that push.
    fn assemble(&self, sparse: &mut Sparse) {
        sparse.clear();
        for (at, row) in self.rows.iter().enumerate() {
            let own = row.answer;
            // What a motor seeks and where its way ends are one number: both at once would have no solution.
            let yields = row.closes_loop || matches!(row.what, What::Motor(_));
            let own = if yields { own * (1.0 + LOOP_COMPLIANCE) } else { own };
            sparse.set_diagonal(at, if row.is_active { own + row.softness } else { 1.0 });
        }
        for &Shared { node, rows: [a, b], sides: [of_a, of_b], entry } in &self.shared {
            let (a, b) = (&self.rows[a as usize], &self.rows[b as usize]);
            if a.is_active && b.is_active {
                let (a, b) = (a.pushes[of_a as usize], b.pushes[of_b as usize]);
                sparse.add_below(entry, product(a, b, self.inverses[node as usize]));
            }
        }
        sparse.factor();
    }

    /// All push by what the solution says; or those alone that their bounds stop, if there are such, because the others had
    /// reckoned with more of them. Answers whether it was these.
    fn push_all(&mut self) -> bool {
        let is_stopped = |row: &Row, less: f64| {
            let wanted = row.impulse - less;
            row.is_active && !(row.bounds[0]..=row.bounds[1]).contains(&wanted)
        };
        let has_stopped = self.rows.iter().zip(&self.missing).any(|(row, &less)| is_stopped(row, less));
        for at in 0..self.rows.len() {
            let (row, less) = (&self.rows[at], self.missing[at]);
            if row.is_active && (!has_stopped || is_stopped(row, less)) {
                self.push(at, less);
            }
        }
        has_stopped
    }

    /// Takes so much of an impulse, as far as its bounds let it.
    fn push(&mut self, at: usize, less: f64) {
        let row = &mut self.rows[at];
        let impulse = (row.impulse - less).clamp(row.bounds[0], row.bounds[1]);
        let change = impulse - std::mem::replace(&mut row.impulse, impulse);
        for (side, push) in self.ties[row.tie as usize].sides.iter().zip(row.pushes) {
            if side.node != GROUND {
                let node = side.node as usize;
                (0..4).for_each(|i| self.velocities[node][i] += change * push[i] * self.inverses[node][i]);
            }
        }
    }

    /// One number after the other is made right, several times.
    fn solve_by_turns(&mut self, holds: &[Hold], h: f64, pass: Pass) {
        for _ in 0..GROUP_SWEEPS {
            for at in 0..self.rows.len() {
                let row = &self.rows[at];
                let tie = &self.ties[row.tie as usize];
                let missing = row.missing((tie, holds), &self.velocities, (h, pass));
                let own = row.answer + row.softness;
                if own > 0.0 {
                    self.push(at, missing / own);
                }
            }
        }
    }
}
