//! Records the states and first contacts of a scene in one engine.

use std::collections::BTreeSet;

use measure::scenes::depth::DepthScene;
use measure::world::{BodyState, ContactPartner, World};

/// First contact of two objects, or of an object with the ground or a platform.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Hit {
    /// Number of steps after which the contact was found.
    pub(crate) step: usize,
    /// Both partners of the contact, the lesser in their order first.
    pub(crate) pair: (ContactPartner, ContactPartner),
}

/// States of all objects after every step, and the first contact of each pair.
#[derive(Debug, Clone)]
pub(crate) struct Recording {
    dt: f64,
    objects: usize,
    /// States by step, and by object within a step. The first ones are those before the first step.
    states: Vec<BodyState>,
    hits: Vec<Hit>,
}

impl Recording {
    /// Runs a scene in `world` to its end and records it.
    pub(crate) fn new(scene: &DepthScene, world: &mut dyn World) -> Self {
        let objects = scene.objects.len();
        let mut recording =
            Recording { dt: f64::from(scene.dt), objects, states: Vec::new(), hits: Vec::new() };
        let (mut pairs, mut known) = (Vec::new(), BTreeSet::new());
        recording.states.extend((0..objects).map(|object| world.body(object)));
        for step in 1..=scene.steps {
            world.step(scene.dt);
            recording.states.extend((0..objects).map(|object| world.body(object)));
            pairs.clear();
            world.touching(&mut pairs);
            // Contacts that are found in the same step have no order in time, so they are sorted.
            pairs.sort_unstable();
            let new = pairs.iter().filter(|pair| known.insert(**pair));
            recording.hits.extend(new.map(|&pair| Hit { step, pair }));
        }
        recording
    }

    /// Returns the length of a step, s.
    pub(crate) fn dt(&self) -> f64 {
        self.dt
    }

    /// Returns the states of an object: before the first step, and after each step.
    pub(crate) fn states(&self, object: usize) -> impl ExactSizeIterator<Item = &BodyState> {
        self.states.iter().skip(object).step_by(self.objects)
    }

    /// Returns the state of an object in the step nearest to `time`, s.
    pub(crate) fn state_at(&self, object: usize, time: f64) -> BodyState {
        let step = ((time / self.dt).round() as usize).min(self.states.len() / self.objects - 1);
        self.states[step * self.objects + object]
    }

    /// Returns the state of an object at the end of the scene.
    pub(crate) fn last(&self, object: usize) -> BodyState {
        self.states[self.states.len() - self.objects + object]
    }

    /// Returns the first contact of each pair, in order of time.
    pub(crate) fn hits(&self) -> &[Hit] {
        &self.hits
    }

    /// Returns the time of the first contact of two objects, s; `None` if they never touch.
    pub(crate) fn time_of_hit(&self, a: ContactPartner, b: ContactPartner) -> Option<f64> {
        let pair = ContactPartner::pair(a, b);
        self.hits.iter().find(|hit| hit.pair == pair).map(|hit| hit.step as f64 * self.dt)
    }
}
