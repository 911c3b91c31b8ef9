//! Islands that could not be solved: what presses and what rubs raise each other in them (a wedge), until no round leaves what is
//! bearable. They go by the passes of the same update, and their impulses of before act again only as far as that takes energy:
//! what is on its way out of a jam would be thrown out by all of them. Contact cycles with a [budget](super::price) are no part of this:
//! Gauss-Seidel sweeps over their rows are their solution, until the budget is spent.

use super::Direct;
use super::block::Triple;
use super::island::{Island, Member};
use crate::precise::Precise;
use crate::precise::tuning::Learning;

impl Precise {
    /// The rows of islands that could not be solved go to the passes.
    pub(super) fn leave_unsolved(&mut self, learning: &Learning) {
        let Direct { islands, count, wear, is_listed, .. } = &mut self.direct;
        if !islands[..*count].iter().any(|whole| whole.is_left) {
            return;
        }
        let mut solved = 0;
        for at in 0..*count {
            if islands[at].is_left {
                let members = &islands[at].island.members;
                members.iter().for_each(|member| wear[member.number as usize].is_direct = false);
            } else {
                islands.swap(at, solved);
                solved += 1;
            }
        }
        // Rows move: where those of the others are is asked anew.
        (*count, *is_listed) = (solved, false);
        self.move_rows(learning);
    }
}

impl Island {
    /// Rows begin with as much of their impulses of before as takes energy from bodies that have these velocities without them. With
    /// u the velocities of rows, energy is least by the part p of impulses l with which l (u + p du) = 0, where du is what all of l
    /// changes of u.
    pub(super) fn cool(&mut self, free: impl Fn(u32) -> Triple) {
        let Island { members, contacts, rubs, gradient, direction, .. } = self;
        gradient.clear();
        direction.clear();
        for &Member { number, velocity, best, .. } in members.iter() {
            gradient.push(free(number));
            direction.push(std::array::from_fn(|i| velocity[i] - best[i]));
        }
        let (mut lost, mut needed) = (0.0, 0.0);
        for contact in contacts.iter() {
            let [before, after] = [&*gradient, &*direction].map(|velocities| contact.relative_in(velocities));
            for (row, impulse) in contact.begun.into_iter().enumerate() {
                lost -= impulse * (before[row] + contact.carried[row]);
                needed += impulse * (after[row] - before[row]);
            }
        }
        // None of what is not a number.
        let part = if lost > 0.0 && needed > 0.0 { (lost / needed).min(1.0) } else { 0.0 };
        for contact in contacts {
            contact.impulses = contact.begun.map(|impulse| part * impulse);
        }
        rubs.iter_mut().for_each(|rub| rub.impulse *= part);
    }
}
