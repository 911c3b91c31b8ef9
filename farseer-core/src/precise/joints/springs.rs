//! Springs as rows of the direct solver.
//!
//! A spring that pulls at something jointed or touched is a row with a stiffness of its own, integrated with implicit Euler: with x the
//! stretch when the step begins and u its rate at the end of the step, the impulse is
//!
//! ```text
//! l = -dt (k (x + dt u) + c u) = -s (u + dt k x / s),   s = dt (c + dt k)
//! ```
//!
//! (D. Baraff and A. Witkin, "Large steps in cloth simulation", 1998). A force that is found when the step begins and acts on one body
//! would throw a light body that other rows hold: its effective mass is another one there. A spring of which no body is jointed or
//! touched stays such a force, since implicit Euler damps what swings.
//!
//! Whether a spring is a row is decided in one place, [`Precise::takes_spring`], when it acts. A row that the direct solver does not solve
//! in this step is one of the [iterative solver](super::soft_spring).
//!
//! | spring | rows |
//! |---|---|
//! | linear, fixed linear | along the line between its anchors; across it as far as the tension turns that faster than a step bears |
//! | angle | the angle; its damping, which acts on the spin of each body, adds to their inertia |
//! | fixed angle | the angle |

use super::super::Precise;
use super::super::direct::constraint::{Ends, FIXED};
use super::super::direct::joint::{ALONG, ANGLE, Elastic, JointRows};
use super::super::tuning::Step;
use super::Candidate;
use super::frame::Frame;
use super::hold::End;
use super::tree::Link;
use crate::body::BodyId;
use crate::math::Vector2;
use crate::objects::Objects;
use crate::springs::{Push, Spring, SpringId, SpringKind};
use crate::storage::reusing_clone::reusing_clone;

/// Springs that are rows in this update.
#[derive(Debug, Default)]
pub(in crate::precise) struct Springs {
    /// Springs that were taken, in the order of their list, with accelerations of their bodies by the forces that they would be otherwise:
    /// length units and radians per second squared.
    taken: Vec<(SpringId, [[f32; 3]; 2])>,
    holds: Vec<SpringHold>,
    /// By body number: whether one of the springs pulls at it. Of no use between steps.
    pulls: Vec<bool>,
}

reusing_clone! { Springs { taken, holds, pulls } }

/// A spring in a step.
#[derive(Debug, Clone, Copy)]
pub(in crate::precise) struct SpringHold {
    spring: SpringId,
    ends: [End; 2],
    /// Along the line between anchors, or the angle.
    is_linear: bool,
    /// Force per length unit or torque per radian, and force or torque per rate of the stretch.
    pub(super) stiffness: f64,
    pub(super) damping: f64,
    /// Torque on each body per its spin.
    damping_of_spin: f64,
    /// Stretch when the step begins, in length units or radians.
    pub(super) stretch: f64,
    /// Greatest torque; infinite for a linear spring.
    pub(super) most: f64,
    accelerations: [[f32; 3]; 2],
    /// The direct solver has solved it in this step.
    is_solved: bool,
}

impl Springs {
    pub(in crate::precise) fn are_none(&self) -> bool {
        self.holds.is_empty()
    }

    /// Bodies have other numbers.
    pub(in crate::precise) fn forget_numbers(&mut self) {
        self.holds.clear();
    }

    /// The springs as the direct solver sees them.
    pub(in crate::precise) fn candidates(&self) -> impl Iterator<Item = Candidate> + '_ {
        self.holds.iter().enumerate().map(|(at, hold)| Candidate {
            joint: at as u32,
            bodies: hold.ends.map(|end| end.body),
            is_free: false,
            may_be_rows: true,
            error: 0.0,
        })
    }

    /// A spring by its place.
    pub(in crate::precise) fn hold(&self, at: u32) -> &SpringHold {
        &self.holds[at as usize]
    }

    /// The direct solver has solved this spring.
    pub(in crate::precise) fn note_solved(&mut self, at: u32) {
        self.holds[at as usize].is_solved = true;
    }

    /// The springs that the direct solver has not solved.
    pub(super) fn unsolved(&self) -> impl Iterator<Item = &SpringHold> + '_ {
        self.holds.iter().filter(|hold| !hold.is_solved)
    }

    /// Whether the direct solver has solved all of them.
    pub(in crate::precise) fn are_all_solved(&self) -> bool {
        self.unsolved().next().is_none()
    }

    /// Whether one of the springs pulls at a body.
    pub(in crate::precise) fn pull_at(&self, body: usize) -> bool {
        self.pulls.get(body) == Some(&true)
    }

    /// A number by which two lists of springs are told from each other (multiplicative hashing): which there are, and which ends
    /// give way; 0 for none. Numbers of bodies are others after a restore.
    pub(in crate::precise) fn signature(&self) -> u64 {
        self.holds.iter().fold(0, |sum: u64, hold| {
            let [a, b] = hold.ends.map(|end| u64::from(end.body != 0));
            let word = hold.spring.to_bits().rotate_left(2) ^ (a << 1 | b);
            (sum.rotate_left(5) ^ word).wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15)
        })
    }
}

impl SpringHold {
    /// Its rows in a step of `dt` seconds. `lever`: length units that a turn by one radian counts as.
    pub(in crate::precise) fn rows(&self, ends: Ends, dt: f64, lever: f64) -> JointRows {
        let frame = self.frame();
        let row = if self.is_linear { ALONG } else { ANGLE };
        let prescribed =
            [0, 1].map(|side| if ends.bodies[side] == FIXED { self.ends[side].velocity } else { [0.0; 3] });
        let mut rows = JointRows::new(ends, frame.jacobian(), [0.0; 3], prescribed, lever);
        let SpringHold { stiffness, damping, stretch, .. } = *self;
        rows.spring(row, Elastic { stiffness, damping, stretch }, [dt, self.most * dt]);
        if self.is_linear {
            let distance = frame.distance();
            let tension = if distance > 0.0 { stretch / distance } else { 1.0 };
            rows.resist_across(dt * dt * stiffness * tension);
        }
        rows
    }

    /// Where its bodies are against each other; the angle is that beyond rest.
    pub(super) fn frame(&self) -> Frame {
        let link = if self.is_linear { Link::Distance } else { Link::Angle };
        Frame::between(link, &self.ends, self.stretch)
    }

    pub(super) fn ends(&self) -> &[End; 2] {
        &self.ends
    }

    /// Damping of the spin of its bodies, torque per radian per second.
    pub(in crate::precise) fn damping_of_spin(&self) -> f64 {
        self.damping_of_spin
    }
}

/// Whether a spring's law is one that rows have: it pulls back, and damps.
fn is_ordinary(spring: &Spring) -> bool {
    let (stiffness, damping) = (spring.spring_constant(), spring.damping_constant());
    let is_strong = match spring.kind() {
        SpringKind::Angle(angle) => angle.max_torque() > 0.0 && angle.torque_multiplier() != 0.0,
        SpringKind::FixedAngle(angle) => angle.max_torque() > 0.0 && angle.torque_multiplier() != 0.0,
        _ => true,
    };
    is_strong && stiffness >= 0.0 && damping >= 0.0 && stiffness + damping > 0.0
}

/// A bound of a torque; what is too great to be one is none.
fn bound(torque: f32) -> f64 {
    if torque < f32::MAX { torque.into() } else { f64::INFINITY }
}

impl Precise {
    /// Springs are about to act.
    pub(crate) fn begin_springs(&mut self, objects: &Objects) {
        self.springs.taken.clear();
        if self.space.is_none() && !objects.springs.list().is_empty() {
            self.renew_joints(objects);
        }
    }

    /// Whether a spring that pushes its bodies so is a row in this update, and the pushes are not to be applied.
    pub(crate) fn takes_spring(
        &mut self,
        id: SpringId,
        pushes: [Option<Push>; 2],
        objects: &Objects,
    ) -> bool {
        let spring = &objects.springs[id];
        let takes = self.space.is_none() && is_ordinary(spring) && self.has_rows_beside(spring);
        if takes {
            let mut accelerations = [[0.0; 3]; 2];
            for push in pushes.into_iter().flatten() {
                // A spring to the world has its body on the second side.
                let side = usize::from(spring.body2().is_none() || push.body() != spring.body1());
                accelerations[side] = push.accelerations(&objects.bodies[push.body()].body);
            }
            self.springs.taken.push((id, accelerations));
        }
        takes
    }

    /// Whether both bodies of a spring are awake and take part, and one of them is jointed or touched.
    fn has_rows_beside(&self, spring: &Spring) -> bool {
        let [one, other] = spring.ends().map(|end| end.map(|body| self.number_of(body)));
        let ends = [one.unwrap_or(Some(0)), other.unwrap_or(Some(0))];
        let [Some(a), Some(b)] = ends else { return false };
        let is_held = |&body: &usize| {
            body != 0
                && body < self.bodies.first_fixed()
                && self.is_dynamic(body)
                && (self.joints.holds(body) || self.is_touched(body))
        };
        a != b && ![a, b].iter().any(|&body| self.sleep.is_asleep(body)) && [a, b].iter().any(is_held)
    }

    /// Whether a body has a contact.
    fn is_touched(&self, body: usize) -> bool {
        self.pairs.of_body(&self.proxies, body).any(|pair| self.pairs.all[pair].home.is_some())
    }

    /// The springs that were taken are brought to the poses of this step. Forces of the step are those with them.
    pub(super) fn read_springs(&mut self, objects: &Objects, step: &Step) {
        let mut springs = std::mem::take(&mut self.springs);
        springs.holds.clear();
        let of_step = springs.taken.iter().filter_map(|&(id, accelerations)| {
            let hold = self.spring_hold((id, objects.springs.get(id)?), objects)?;
            Some(SpringHold { accelerations, ..hold })
        });
        springs.holds.extend(of_step);
        if !(springs.holds.is_empty() && springs.pulls.is_empty()) {
            springs.pulls.clear();
            springs.pulls.resize(if springs.holds.is_empty() { 0 } else { self.bodies.hot.len() }, false);
        }
        for hold in &springs.holds {
            for (end, accelerations) in hold.ends.iter().zip(hold.accelerations) {
                if end.body != 0 {
                    springs.pulls[end.body as usize] = true;
                    let forced = &mut self.bodies.forced[end.body as usize];
                    (0..3).for_each(|axis| forced[axis] += accelerations[axis] * (0.5 * step.dt * step.dt));
                }
            }
        }
        self.springs = springs;
    }

    /// A spring as it is now; `None` if it holds nothing that gives way.
    fn spring_hold(&self, (id, spring): (SpringId, &Spring), objects: &Objects) -> Option<SpringHold> {
        let (ends, rest) = self.spring_ends(spring, objects)?;
        let is_linear = matches!(spring.kind(), SpringKind::Linear(_) | SpringKind::FixedLinear(_));
        let distance = Frame::between(Link::Distance, &ends, 0.0).distance();
        // Without a length at rest it pulls the same way in all directions, even where it has none.
        if is_linear && distance == 0.0 && rest != 0.0 {
            return None;
        }
        let stretch = if is_linear { distance - rest } else { -rest };
        let (multiplier, most) = match spring.kind() {
            SpringKind::Angle(angle) => (angle.torque_multiplier(), bound(angle.max_torque())),
            SpringKind::FixedAngle(angle) => (angle.torque_multiplier(), bound(angle.max_torque())),
            _ => (1.0, f64::INFINITY),
        };
        let [stiffness, damping] = [spring.spring_constant(), spring.damping_constant()]
            .map(|constant| f64::from(multiplier.abs()) * f64::from(constant));
        let mut hold = SpringHold {
            spring: id,
            ends,
            is_linear,
            stiffness,
            damping,
            damping_of_spin: 0.0,
            stretch,
            most,
            accelerations: [[0.0; 3]; 2],
            is_solved: false,
        };
        if matches!(spring.kind(), SpringKind::Angle(_)) {
            hold.damp_spins(|end| self.bodies.hot.get(end.body as usize).map_or(0.0, |hot| hot.velocity[2]));
        }
        (hold.ends[0].body != hold.ends[1].body).then_some(hold)
    }

    /// Where a spring pulls at its bodies, and its length at rest; or the angle at rest, less the one now.
    fn spring_ends(&self, spring: &Spring, objects: &Objects) -> Option<([End; 2], f64)> {
        let bodies = &objects.bodies;
        let angle_of = |body: BodyId| bodies.get(body).map(|entry| f64::from(entry.body.total_rotation()));
        let origin = Vector2::zeros();
        let ([(a, p), (b, q)], rest) = match spring.kind() {
            SpringKind::Linear(linear) => {
                let one = (Some(linear.body1()), linear.attach_point1());
                ([one, (Some(linear.body2()), linear.attach_point2())], linear.rest_length().into())
            }
            SpringKind::FixedLinear(linear) => {
                let one = (None, linear.world_attach_point());
                ([one, (Some(linear.body()), linear.body_attach_point())], linear.rest_length().into())
            }
            SpringKind::Angle(angle) => {
                let turned = angle_of(angle.body2())? - angle_of(angle.body1())?;
                let ends = [angle.body1(), angle.body2()].map(|body| (Some(body), origin));
                (ends, f64::from(angle.target_angle()) - turned)
            }
            SpringKind::FixedAngle(angle) => {
                let turned = angle_of(angle.body())?;
                ([(None, origin), (Some(angle.body()), origin)], f64::from(angle.target_angle()) - turned)
            }
        };
        Some(([self.end(a, p, bodies)?, self.end(b, q, bodies)?], rest))
    }
}

impl SpringHold {
    /// The damping of an angle spring acts on the spin of each body, and not on that of one against the other; where a torque is at its
    /// bound it changes nothing.
    fn damp_spins(&mut self, spin: impl Fn(&End) -> f32) {
        let damping = std::mem::take(&mut self.damping);
        let is_bounded = |end: &End, sign: f64| {
            end.body != 0
                && (sign * self.stiffness * self.stretch - damping * f64::from(spin(end))).abs() >= self.most
        };
        if !(is_bounded(&self.ends[0], 1.0) || is_bounded(&self.ends[1], -1.0)) {
            self.damping_of_spin = damping;
        }
    }
}
