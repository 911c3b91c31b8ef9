//! What happened in a run.

use std::collections::BTreeSet;

use measure::scenes::depth::DepthScene;
use measure::world::{BodyState, Met, World};

/// Two things that met for the first time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Hit {
    /// How many steps had been made when it was noticed.
    pub(crate) step: usize,
    /// The pair, the lesser one first.
    pub(crate) pair: (Met, Met),
}

/// All states of all objects, and who met whom when.
#[derive(Debug, Clone)]
pub(crate) struct Recording {
    dt: f64,
    objects: usize,
    /// By step, then by object; the first are those before the first step.
    states: Vec<BodyState>,
    hits: Vec<Hit>,
}

impl Recording {
    /// Runs a scene to its end.
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
            // Two that are noticed in one step have no order.
            pairs.sort_unstable();
            let new = pairs.iter().filter(|pair| known.insert(**pair));
            recording.hits.extend(new.map(|&pair| Hit { step, pair }));
        }
        recording
    }

    /// Length of a step in s.
    pub(crate) fn dt(&self) -> f64 {
        self.dt
    }

    /// States of an object, from before the first step on.
    pub(crate) fn states(&self, object: usize) -> impl ExactSizeIterator<Item = &BodyState> {
        self.states.iter().skip(object).step_by(self.objects)
    }

    /// BodyState of an object after a time in s.
    pub(crate) fn state_at(&self, object: usize, time: f64) -> BodyState {
        let step = ((time / self.dt).round() as usize).min(self.states.len() / self.objects - 1);
        self.states[step * self.objects + object]
    }

    /// BodyState of an object at the end.
    pub(crate) fn last(&self, object: usize) -> BodyState {
        self.states[self.states.len() - self.objects + object]
    }

    /// Who met whom for the first time, in order.
    pub(crate) fn hits(&self) -> &[Hit] {
        &self.hits
    }

    /// Time in s at which two things met for the first time.
    pub(crate) fn time_of_hit(&self, a: Met, b: Met) -> Option<f64> {
        let pair = Met::pair(a, b);
        self.hits.iter().find(|hit| hit.pair == pair).map(|hit| hit.step as f64 * self.dt)
    }
}
