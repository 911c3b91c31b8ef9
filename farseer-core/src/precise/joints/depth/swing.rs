//! The step of a group in three axes that nothing touches.
//!
//! Tension makes a rope stiff against going aside, and a stiff thing overshoots where a substep is too long for it. Where nothing
//! touches the group its substeps are divided for that; where something does, they are as long as those of contacts.

use super::super::super::bodies::Bodies;
use super::super::super::tuning::Step;
use super::super::hold::Hold;
use super::group::SpatialGroup;
use super::row::{Motion, What};
use super::sparse::Sparse;
use crate::precise::parameters::spatial_joints::{
    ROPE_ENERGY_GAIN, ROPE_PULL_AHEAD, ROPE_RETRY_PARTS, ROPE_STABLE_STIFFNESS, ROPE_SUBSTEP_PARTS,
    ROPE_SUBSTEP_PRODUCTS,
};

impl SpatialGroup {
    /// Into how many parts a substep is divided, by what held the joints in the last step.
    pub(super) fn parts_of(&self, holds: &[Hold], h: f64) -> u32 {
        let stiffness = self.rows.iter().filter(|row| row.what == What::Distance).map(|row| {
            let tie = &self.ties[row.tie as usize];
            let hold = &holds[tie.hold as usize];
            let ([x, y, _], z) = (hold.force, f64::from(hold.force_along_depth));
            let inverse: f64 = tie.sides.iter().map(|side| side.inverse_mass(&self.inverses)).sum();
            // Two links pull at each body.
            2.0 * (x * x + y * y + z * z).sqrt() * inverse * h * h / tie.distance()
        });
        let stiffest = stiffness.filter(|stiffness| stiffness.is_finite()).fold(0.0, f64::max);
        (0.25 * ROPE_PULL_AHEAD * stiffest / ROPE_STABLE_STIFFNESS)
            .sqrt()
            .ceil()
            .clamp(1.0, self.most_parts().into()) as u32
    }

    /// The most parts of a substep.
    fn most_parts(&self) -> u32 {
        let products = self.sparse.as_ref().map_or(0, Sparse::products);
        (ROPE_SUBSTEP_PRODUCTS / products as f64).clamp(1.0, ROPE_SUBSTEP_PARTS) as u32
    }

    /// Moves the group through all substeps. A jerk is not known before it comes: a step in which it is too much for its parts is made
    /// again, with more.
    pub(in super::super) fn swing(&mut self, holds: &[Hold], bodies: &Bodies, step: &Step) {
        if !self.is_apart {
            return;
        }
        self.begun.clone_from(&self.ties);
        let most = self.most_parts();
        while !self.swing_through(holds, bodies, step, self.parts >= most) {
            self.ties.clone_from(&self.begun);
            let times = [f64::from(step.dt), f64::from(step.h)];
            self.begin_rows(holds, times, (ROPE_RETRY_PARTS * self.parts).min(most));
        }
    }

    /// Answers whether all went well; if it must, it goes on where it does not.
    fn swing_through(&mut self, holds: &[Hold], bodies: &Bodies, step: &Step, must: bool) -> bool {
        self.load(bodies);
        self.ways.clear();
        self.ways.resize(self.bodies.len(), [0.0; 4]);
        let part = 1.0 / f64::from(self.parts);
        let h = f64::from(step.h) * part;
        for _ in 0..step.substeps * self.parts {
            for (velocity, &body) in self.velocities.iter_mut().zip(&self.bodies) {
                let push = bodies.push[body as usize];
                (0..4).for_each(|i| velocity[i] += f64::from(push[i]) * part);
            }
            let energy = self.energy();
            if !self.correct_velocities(holds, h, must) {
                if !must {
                    return false;
                }
                self.correct_in_line(holds, h);
            }
            for (way, velocity) in self.ways.iter_mut().zip(&self.velocities) {
                (0..4).for_each(|i| way[i] += velocity[i] * h);
            }
            self.advance_ties(h);
            self.relax_velocities(holds, h);
            // Not a number is no energy.
            let is_lawful = self.energy() <= (1.0 + ROPE_ENERGY_GAIN) * energy;
            if self.is_passive && !is_lawful {
                if !must {
                    return false;
                }
                self.slow_down(energy);
            }
        }
        true
    }

    /// Twice the kinetic energy.
    fn energy(&self) -> f64 {
        let of = |(velocity, inverse): (&Motion, &Motion)| {
            let weight =
                |i: usize| if inverse[i] > 0.0 { velocity[i] * velocity[i] / inverse[i] } else { 0.0 };
            (0..4).map(weight).sum::<f64>()
        };
        self.velocities.iter().zip(&self.inverses).map(of).sum()
    }

    /// Takes what it has gained from its motion, or all that is not finite.
    fn slow_down(&mut self, energy: f64) {
        let part = (energy / self.energy()).sqrt();
        let part = if part.is_finite() { part } else { 0.0 };
        for velocity in self.velocities.iter_mut().flatten() {
            *velocity = if velocity.is_finite() { *velocity * part } else { 0.0 };
        }
    }

    /// Where the step has brought it.
    pub(super) fn end_swing(&self, bodies: &mut Bodies) {
        if !self.is_apart {
            return;
        }
        for ((velocity, way), &body) in self.velocities.iter().zip(&self.ways).zip(&self.bodies) {
            bodies.hot[body as usize].velocity = velocity.map(|velocity| velocity as f32);
            bodies.path[body as usize] = way.map(|way| way as f32);
        }
    }
}
