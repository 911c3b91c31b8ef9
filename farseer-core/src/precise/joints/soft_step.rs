//! Joints in the passes of the iterative solver: soft constraints beside the contacts (E. Catto, "Solver2D", 2024; Box2D 3).
//!
//! In every substep all joints are solved before all contacts: softly before bodies move, and hard after that. What the impulses of
//! joints do is summed with that of contacts, and acts at once at the beginning of the substep: a warm start that goes joint by joint,
//! between the solutions, leaves two to ten times as much error. Joints learn no load, as contacts do: their anchors hardly move against
//! each other however they swing, so that nothing tells when to learn.
//!
//! All of it is made anew in every update from what is saved of joints and bodies.

use super::super::bodies::Bodies;
use super::super::rows::Row;
use super::super::tuning::Step;
use super::colours::{colour, is_last};
use super::hold::{End, Hold};
use super::soft_block::{Kind, SoftBlock};
use super::soft_law::{BlockLaw, Law};
use super::soft_spring::SoftSpring;
use super::springs::Springs;
use crate::precise::parameters::joints::{JOINTED_BODY_ROTATION, JOINTED_BODY_SPEED, SOFT_ROW_ARM};
use crate::storage::reusing_clone::reusing_clone;

/// The joints of the iterative solver.
#[derive(Debug, Default)]
pub(super) struct SoftJoints {
    /// All joints in the plane, by their places in the list, and their colours, in the order of these.
    order: Vec<(u32, u32)>,
    /// The joints of this update, and the springs that are rows.
    joints: Vec<SoftBlock>,
    springs: Vec<SoftSpring>,
    /// Their dynamic bodies; and by body number whether it is one of them, as a mask of all bits.
    bodies: Vec<u32>,
    masks: Vec<u32>,
    /// Bodies that a blow has reached, directly or by joints; and by body number, as masks.
    struck: Vec<u32>,
    struck_masks: Vec<u32>,
}

reusing_clone! { SoftJoints { order, joints, springs, bodies, masks, struck, struck_masks } }

impl SoftJoints {
    /// Plans the order of these joints, given by their places in the list.
    pub(super) fn plan(&mut self, holds: &[Hold], in_plane: &[u32], bodies: usize) {
        self.forget();
        colour(holds, in_plane, bodies, &mut self.order);
        // Room for all of them: when the iterative solver gets one is not known before. Each colour may leave a block of each kind that is
        // not full.
        let colours = self.order.chunk_by(|one, other| one.1 == other.1).count();
        let blocks = self.order.len().div_ceil(4) + Kind::COUNT * colours;
        let alone = self.order.iter().filter(|&&(_, colour)| is_last(colour)).count();
        self.joints.reserve(self.order.len().min(blocks + alone));
        self.bodies.reserve(bodies.min(2 * self.order.len()));
        self.struck.clear();
        for masks in [&mut self.masks, &mut self.struck_masks] {
            masks.clear();
            masks.resize(bodies, 0);
        }
    }

    /// No joint is solved in this update, unless more is told.
    pub(super) fn forget(&mut self) {
        self.joints.clear();
        self.springs.clear();
        self.bodies.drain(..).for_each(|body| self.masks[body as usize] = 0);
    }

    /// An update begins, in which these joints are solved, and the springs that no other solver has solved.
    pub(super) fn begin(
        &mut self,
        (holds, springs): (&[Hold], &Springs),
        is_in: impl Fn(usize) -> bool,
        (bodies, step): (&Bodies, &Step),
        unit: f64,
    ) {
        self.forget();
        let (times, law) = ([step.dt, step.h].map(f64::from), Law::soft(step.h.into()));
        let fastest = [f64::from(JOINTED_BODY_SPEED) * unit, f64::from(SOFT_ROW_ARM) * unit];
        let SoftJoints { order, joints, springs: of_springs, bodies: marked, masks, .. } = self;
        let mut mark = |ends: &[End; 2]| {
            for body in ends.iter().map(|end| end.body).filter(|&body| body != 0) {
                if std::mem::replace(&mut masks[body as usize], !0) == 0 {
                    marked.push(body);
                }
            }
        };
        // By kind the block of this colour that is not full.
        let mut open = [None; Kind::COUNT];
        let mut last = None;
        for &(at, colour) in order.iter().filter(|&&(at, _)| is_in(at as usize)) {
            let (hold, is_new) = (&holds[at as usize], last.replace(colour) != Some(colour));
            if is_new || is_last(colour) {
                open = [None; Kind::COUNT];
            }
            let kind = Kind::of(hold);
            let block = *open[kind.number()].get_or_insert_with(|| {
                joints.push(SoftBlock::new(kind));
                joints.len() - 1
            });
            if joints[block].put(at, hold, bodies, times) {
                mark(&hold.ends);
            }
            if joints[block].is_full() {
                open[kind.number()] = None;
            }
        }
        joints.iter_mut().for_each(|block| block.begin(&law, unit as f32));
        for hold in springs.unsolved() {
            of_springs.push(SoftSpring::new(hold, bodies, times[1], fastest));
            mark(hold.ends());
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.joints.is_empty() && self.springs.is_empty()
    }

    /// By body number a mask of all bits for bodies with joints in the iterative solver.
    pub(super) fn masks(&self) -> &[u32] {
        &self.masks
    }

    /// Adds what impulses do to velocities in a substep.
    pub(super) fn warm(&self, bodies: &mut Bodies) {
        self.springs.iter().for_each(|spring| spring.warm(&mut bodies.warm));
        self.joints.iter().for_each(|block| block.warm(&mut bodies.warm));
    }

    /// The pass before bodies move.
    pub(super) fn solve_soft(&mut self, bodies: &mut Bodies, h: f32) {
        self.springs.iter_mut().for_each(|spring| spring.solve(&mut bodies.hot));
        self.solve(bodies, &Law::soft(h.into()), h);
    }

    /// The pass after bodies have moved.
    pub(super) fn relax(&mut self, bodies: &mut Bodies, h: f32) {
        self.solve(bodies, &Law::HARD, h);
        self.joints.iter_mut().for_each(SoftBlock::count_impulses);
    }

    fn solve(&mut self, bodies: &mut Bodies, law: &Law, h: f32) {
        let (law, inverse_h) = (BlockLaw::of(law), 1.0 / h);
        self.joints.iter_mut().for_each(|block| block.solve(&mut bodies.hot, &law, inverse_h));
    }

    /// Joints and springs follow bodies that have moved.
    pub(super) fn advance(&mut self, bodies: &mut Bodies) {
        self.springs.iter_mut().for_each(|spring| spring.advance(bodies));
        self.joints.iter_mut().for_each(|block| block.advance(bodies));
    }

    /// No body is faster than bodies with joints may be in a substep of `h` seconds, but for bullets. Joints that cannot be kept would
    /// drive them further and further apart.
    pub(super) fn limit_speeds(&self, bodies: &mut Bodies, unit: f32, h: f32) {
        let (most, most_spin) = (JOINTED_BODY_SPEED * unit, JOINTED_BODY_ROTATION / h);
        for body in self.bodies.iter().map(|&body| body as usize).filter(|&body| !bodies.are_bullets[body]) {
            let [x, y, spin, _] = bodies.hot[body].velocity;
            let (squared, spins) = (x * x + y * y, spin.abs());
            if squared > most * most || spins > most_spin {
                let part = if squared > most * most { most / squared.sqrt() } else { 1.0 };
                let spin_part = if spins > most_spin { most_spin / spins } else { 1.0 };
                for (axis, (old, part)) in [(x, part), (y, part), (spin, spin_part)].into_iter().enumerate() {
                    // The part that is cut off is no impulse that acts again.
                    bodies.hot[body].velocity[axis] = old * part;
                    bodies.begun[body][axis] += old * part - old;
                }
            }
        }
    }

    /// A pass over contacts that bounce begins.
    pub(super) fn begin_bounce(&mut self) {
        self.struck.drain(..).for_each(|body| self.struck_masks[body as usize] = 0);
    }

    /// Notes the bodies of lanes that have bounced.
    pub(super) fn note_bounce<const P: usize>(&mut self, row: &Row<P>, lanes: u32) {
        for lane in (0..4).filter(|lane| lanes >> lane & 1 == 1) {
            for body in [row.a[lane], row.b[lane]] {
                let is_in = self.masks.get(body as usize).is_some_and(|&mask| mask != 0);
                if is_in && std::mem::replace(&mut self.struck_masks[body as usize], !0) == 0 {
                    self.struck.push(body);
                }
            }
        }
    }

    /// Hard joints of bodies that a blow has reached, in the order of colours, and of bodies that it reaches by these, keep what they hold
    /// in the velocities after it. Their impulses are those of the blow alone: they do not act again. Answers the greatest speed that one
    /// missed, in length units per second.
    pub(super) fn bounce(&mut self, bodies: &mut Bodies, unit: f32) -> f32 {
        let SoftJoints { joints, struck, struck_masks, .. } = self;
        if struck.is_empty() {
            return 0.0;
        }
        let missed =
            joints.iter_mut().map(|block| block.bounce(&mut bodies.hot, (struck_masks, struck), unit));
        missed.fold(0.0, |most: f32, missed| if missed > most { missed } else { most })
    }

    /// Forces and torques of these joints in the last substep, and their means over the update of `dt` seconds.
    pub(super) fn finish(&self, holds: &mut [Hold], times: [f32; 2]) {
        self.joints.iter().for_each(|block| block.tell(holds, times));
    }
}
