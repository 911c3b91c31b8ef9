//! When springs act (behaviour chapter 11).

use super::PhysicsSimulator;
use super::tell::Handler;
use crate::report::Event;
use crate::springs::{SpringId, SpringOutcome, Steps};

impl PhysicsSimulator {
    /// Springs in list order: those that are beyond their breakpoint break, and act once more.
    pub(super) fn update_springs(&mut self, step: Option<Steps>, handler: &mut Handler<'_>) {
        if let Some(precise) = &mut self.pipeline.precise {
            precise.begin_springs(&self.objects);
        }
        for position in 0..self.spring_list().len() {
            if let Some((id, spring)) = self.objects.springs.at_mut(position)
                && spring.enabled()
            {
                if spring.breaks() {
                    self.report.push(Event::SpringBroke { spring: id });
                    self.tell(handler, |handler, context| handler.on_spring_broke(context, id));
                }
                self.update_spring(id, step, handler);
            }
        }
    }

    fn update_spring(&mut self, spring: SpringId, step: Option<Steps>, handler: &mut Handler<'_>) {
        let PhysicsSimulator { objects, pipeline, .. } = self;
        let kept = match &pipeline.precise {
            Some(precise) => precise.absent_in_space(objects.springs[spring].ends()),
            None => [None; 2],
        };
        let space = pipeline.precise.as_mut().and_then(|precise| precise.space_mut());
        let (outcome, pushes) = objects.springs[spring].find(&objects.bodies, space, step);
        // Without length it has no direction to pull along. Rows need none.
        let is_point = pipeline.precise.is_some() && objects.springs[spring].has_no_length_at_rest();
        if let Some(pushes) = pushes.or(is_point.then_some([None; 2])) {
            let precise = pipeline.precise.as_mut();
            if !precise.is_some_and(|precise| precise.takes_spring(spring, pushes, objects)) {
                pushes.into_iter().flatten().for_each(|push| push.apply(&mut objects.bodies));
            }
        }
        if let Some(space) = pipeline.precise.as_mut().and_then(|precise| precise.space_mut()) {
            kept.into_iter().flatten().for_each(|(body, push)| space.set_acceleration(body, push));
        }
        match outcome {
            SpringOutcome::Idle => {}
            SpringOutcome::NotFinite => self.report.push(Event::SpringNotFinite { spring }),
            SpringOutcome::Updated => {
                if handler.wants(|handler| handler.handles_spring_updates()) {
                    self.tell(handler, |handler, context| handler.on_spring_updated(context, spring));
                }
            }
        }
    }
}
