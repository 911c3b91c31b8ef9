//! Joints outside of trees push, and the trees answer.

use super::Loose;
use super::push::Pass;
use super::rows::{Error, Row};
use crate::precise::joints::hold::Hold;
use crate::precise::joints::tree::{Node, solve, solve_again};
use crate::storage::reusing_clone::reusing_clone;

/// Bodies times numbers that are kept, up to which trees answer as a whole.
const WHOLE: usize = 1000;

/// The part of what the two bodies alone would answer that is added to what trees answer where a loop closes: a chain that is
/// straight between two shores cannot be longer, whatever pulls.
const YIELDING: f64 = 1e-1;

/// Times that several joints of this kind take turns.
const SWEEPS: usize = 4;

/// What a push of 1 on a number does.
#[derive(Debug)]
struct Answer {
    joint: usize,
    row: Row,
    /// Of the number itself, and of velocities and impulses of all nodes.
    own: f64,
    nodes: Vec<[[f64; 3]; 2]>,
}

reusing_clone! { Answer { joint, row, own, nodes } }

/// Velocities that obey all joints of a group as far as they can, from those that do not.
pub(in crate::precise::joints) fn solve_group(
    nodes: &mut [Node],
    loose: &mut [Loose],
    holds: &[Hold],
    room: &mut Room,
    (h, pass, stiff): (f64, Pass, f64),
) {
    match pass {
        Pass::Correct => loose.iter().for_each(|joint| joint.act_again(nodes)),
        Pass::Rest => loose.iter_mut().for_each(|joint| joint.impulse = [0.0; 3]),
    }
    let is_whole = loose.len() * nodes.len() <= WHOLE;
    if !is_whole {
        for joint in loose.iter_mut() {
            let hold = &holds[joint.hold as usize];
            for row in joint.rows(hold, nodes, (h, pass)).into_iter().flatten() {
                joint.push_alone(&row, nodes, h, pass);
            }
        }
    }
    solve(nodes, stiff);
    if is_whole && !loose.is_empty() {
        room.find_answers(nodes, loose, holds, (h, pass));
        room.push_all(nodes, loose, (h, pass));
    }
}

/// A second look at a [correction](Pass::Correct), with the ways that it makes bodies go.
pub(in crate::precise::joints) fn refine_group(
    nodes: &mut [Node],
    loose: &mut [Loose],
    room: &mut Room,
    h: f64,
) {
    if loose.len() * nodes.len() > WHOLE {
        return;
    }
    nodes.iter_mut().for_each(|node| node.velocity = node.before);
    loose.iter().for_each(|joint| joint.act_again(nodes));
    solve_again(nodes);
    if !loose.is_empty() {
        room.push_all(nodes, loose, (h, Pass::Correct));
    }
}

/// Kept from pass to pass, so that nothing is allocated.
#[derive(Debug, Default)]
pub(in crate::precise::joints) struct Room {
    answers: Vec<Answer>,
    count: usize,
    /// Limits that are obeyed, of which joints.
    idle: Vec<(usize, Row)>,
    kept: Vec<[[f64; 3]; 3]>,
}

reusing_clone! { Room { answers, count, idle, kept } }

impl Room {
    /// Finds what the trees answer to each number that is not obeyed, or has had to be.
    fn find_answers(&mut self, nodes: &mut [Node], loose: &[Loose], holds: &[Hold], (h, pass): (f64, Pass)) {
        self.count = 0;
        self.idle.clear();
        for (at, joint) in loose.iter().enumerate() {
            let hold = &holds[joint.hold as usize];
            for row in joint.rows(hold, nodes, (h, pass)).into_iter().flatten() {
                if joint.is_idle(&row, nodes, h, pass) {
                    self.idle.push((at, row));
                } else {
                    self.find_answer(nodes, joint, at, &row);
                }
            }
        }
    }

    /// All push, and once more with the limits that they have pushed something past.
    fn push_all(&mut self, nodes: &mut [Node], loose: &mut [Loose], (h, pass): (f64, Pass)) {
        self.push_by_turns(nodes, loose, (h, pass));
        let known = self.count;
        for place in (0..self.idle.len()).rev() {
            let (at, row) = self.idle[place];
            if !loose[at].is_idle(&row, nodes, h, pass) {
                self.idle.remove(place);
                self.find_answer(nodes, &loose[at], at, &row);
            }
        }
        if self.count > known {
            self.push_by_turns(nodes, loose, (h, pass));
        }
    }

    fn push_by_turns(&self, nodes: &mut [Node], loose: &mut [Loose], (h, pass): (f64, Pass)) {
        for _ in 0..if self.count > 1 { SWEEPS } else { 1 } {
            for answer in &self.answers[..self.count] {
                loose[answer.joint].push(answer, nodes, h, pass);
            }
        }
    }

    /// The trees have been solved as they are: only what moves is another.
    fn find_answer(&mut self, nodes: &mut [Node], joint: &Loose, at: usize, row: &Row) {
        self.kept.clear();
        self.kept.extend(nodes.iter().map(|node| [node.velocity, node.bias, node.impulse]));
        for node in nodes.iter_mut() {
            (node.velocity, node.bias) = ([0.0; 3], [0.0; 3]);
        }
        joint.apply(row, 1.0, nodes);
        solve_again(nodes);
        let mut own = joint.speed_of(row, nodes, false);
        if let Error::Of(_) = row.error {
            own += YIELDING * joint.alone(row, nodes);
        }
        if self.answers.len() == self.count {
            self.answers.push(Answer { joint: at, row: *row, own, nodes: Vec::new() });
        }
        let answer = &mut self.answers[self.count];
        (answer.joint, answer.row, answer.own) = (at, *row, own);
        answer.nodes.clear();
        answer.nodes.extend(nodes.iter().map(|node| [node.velocity, node.impulse]));
        self.count += 1;
        for (node, &[velocity, bias, impulse]) in nodes.iter_mut().zip(&self.kept) {
            (node.velocity, node.bias, node.impulse) = (velocity, bias, impulse);
        }
    }
}

impl Loose {
    /// Pushes, and the trees answer.
    fn push(&mut self, answer: &Answer, nodes: &mut [Node], h: f64, pass: Pass) {
        let change = self.change(&answer.row, nodes, answer.own, (h, pass));
        if change != 0.0 {
            for (node, [velocity, impulse]) in nodes.iter_mut().zip(&answer.nodes) {
                for i in 0..3 {
                    node.velocity[i] += change * velocity[i];
                    node.impulse[i] += change * impulse[i];
                }
            }
        }
    }
}
