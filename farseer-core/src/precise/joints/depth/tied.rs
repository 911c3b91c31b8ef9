//! Joints that keep a point keep it in depth: the bodies that they tie together move along the depth axis as one, at the distance
//! from each other that they have. Nothing turns them about the axes of the plane, so that this is all there is to solve.

use super::super::super::bodies::Bodies;
use super::super::super::islands::Islands;
use super::super::hold::Hold;
use super::super::tree::Link;
use super::super::weight_of;
use crate::storage::reusing_clone::reusing_clone;

/// Bodies that move along the depth axis as one.
#[derive(Debug, Default)]
pub(in super::super) struct Tied {
    bodies: Vec<u32>,
    /// What does not give way and moves them, by its number; 0 is the world.
    carrier: Option<u32>,
}

reusing_clone! { Tied { bodies, carrier } }

impl Tied {
    /// Who moves as one, in the order of their first bodies.
    pub(in super::super) fn all(holds: &[Hold], count: usize) -> Vec<Tied> {
        let mut unions = Islands::default();
        unions.part(count);
        let keeping =
            || holds.iter().filter(|hold| matches!(hold.link, Link::Point | Link::Weld | Link::Line));
        for hold in keeping() {
            if let [one, other] = hold.ends.map(|end| end.body)
                && one != 0
                && other != 0
            {
                unions.join(one, other);
            }
        }
        let mut bodies: Vec<u32> = keeping().flat_map(|hold| hold.ends.map(|end| end.body)).collect();
        bodies.sort_unstable();
        bodies.dedup();
        // A set goes by its least number: that comes first.
        let mut all: Vec<(u32, Tied)> = Vec::new();
        for body in bodies.into_iter().filter(|&body| body != 0) {
            let root = unions.find(body);
            match all.binary_search_by_key(&root, |(of, _)| *of) {
                Ok(at) => all[at].1.bodies.push(body),
                Err(at) => all.insert(at, (root, Tied { bodies: vec![body], carrier: None })),
            }
        }
        for hold in keeping() {
            let [one, other] = hold.ends;
            for (held, carrier) in [(one, other), (other, one)] {
                let root = unions.find(held.body);
                if carrier.body == 0
                    && let Ok(at) = all.binary_search_by_key(&root, |(of, _)| *of)
                {
                    all[at].1.carrier.get_or_insert(carrier.pose);
                }
            }
        }
        all.into_iter().map(|(_, tied)| tied).collect()
    }

    /// The mean of what its bodies have, by their masses.
    fn mean(&self, bodies: &Bodies, of: impl Fn(usize) -> f32) -> f32 {
        let (mut sum, mut mass) = (0.0, 0.0);
        for &body in &self.bodies {
            let weight = weight_of(bodies.inverses[body as usize][0]);
            (sum, mass) = (sum + weight * f64::from(of(body as usize)), mass + weight);
        }
        (sum / mass) as f32
    }

    /// Its velocity along the axis: that of what carries it, or what keeps its momentum.
    fn velocity(&self, bodies: &Bodies) -> f32 {
        match self.carrier {
            Some(carrier) => bodies.hot.get(carrier as usize).map_or(0.0, |hot| hot.velocity[3]),
            None => self.mean(bodies, |body| bodies.hot[body].velocity[3]),
        }
    }

    /// Its bodies get one velocity. It acts once, as all that joints do.
    pub(in super::super) fn share(&self, bodies: &mut Bodies) {
        let velocity = self.velocity(bodies);
        for &body in &self.bodies {
            let now = &mut bodies.hot[body as usize].velocity[3];
            bodies.begun[body as usize][3] += velocity - *now;
            *now = velocity;
        }
    }

    /// The same after a step in which nothing has pushed them, for the way that they have come.
    pub(in super::super) fn share_way(&self, bodies: &mut Bodies, dt: f32) {
        let velocity = self.velocity(bodies);
        let way = match self.carrier {
            Some(_) => velocity * dt,
            None => self.mean(bodies, |body| bodies.path[body][3]),
        };
        for &body in &self.bodies {
            bodies.hot[body as usize].velocity[3] = velocity;
            bodies.path[body as usize][3] = way;
        }
    }
}
