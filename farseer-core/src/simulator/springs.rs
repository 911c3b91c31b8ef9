//! Springs in an update (behaviour chapter 11).

use super::PhysicsSimulator;
use super::callbacks::Handler;
use crate::report::Event;
use crate::springs::{SpringId, SpringOutcome, StepLengths};

impl PhysicsSimulator {
    /// Updates springs in list order. Springs whose error is beyond their breakpoint break, and act once more.
    pub(super) fn update_springs(&mut self, step: Option<StepLengths>, handler: &mut Handler<'_>) {
        if self.pipeline.precise.is_some() && !self.spring_list().is_empty() {
            // Handlers of contacts and controllers may have edited joints, by which springs become rows or forces.
            self.import_edits();
        }
        if let Some(precise) = &mut self.pipeline.precise {
            precise.begin_springs(&self.objects);
        }
        for position in 0..self.spring_list().len() {
            if let Some((id, spring)) = self.objects.springs.at_mut(position)
                && spring.enabled()
            {
                if spring.breaks() {
                    self.report.push(Event::SpringBroke { spring: id });
                    self.call_handler(handler, |handler, context| handler.on_spring_broke(context, id));
                }
                self.update_spring(id, step, handler);
            }
        }
    }

    fn update_spring(&mut self, spring: SpringId, step: Option<StepLengths>, handler: &mut Handler<'_>) {
        let PhysicsSimulator { objects, pipeline, .. } = self;
        let kept = match &pipeline.precise {
            Some(precise) => precise.inactive_depth_accelerations(objects.springs[spring].ends()),
            None => [None; 2],
        };
        let space = pipeline.precise.as_mut().and_then(|precise| precise.depth_mut());
        let (outcome, pushes) = objects.springs[spring].compute_forces(&objects.bodies, space, step);
        // A linear spring without length has no direction for a force. As a constraint row it needs none.
        let is_point = pipeline.precise.is_some() && objects.springs[spring].has_zero_rest_length();
        if let Some(pushes) = pushes.or(is_point.then_some([None; 2])) {
            let precise = pipeline.precise.as_mut();
            if !precise.is_some_and(|precise| precise.constrain_spring(spring, pushes, objects)) {
                pushes.into_iter().flatten().for_each(|push| push.apply(&mut objects.bodies));
            }
        }
        if let Some(space) = pipeline.precise.as_mut().and_then(|precise| precise.depth_mut()) {
            kept.into_iter().flatten().for_each(|(body, push)| space.set_acceleration(body.slot(), push));
        }
        match outcome {
            SpringOutcome::Idle => {}
            SpringOutcome::NotFinite => self.report.push(Event::SpringNotFinite { spring }),
            SpringOutcome::Updated => {
                if handler.wants(|handler| handler.handles_spring_updates()) {
                    self.call_handler(handler, |handler, context| handler.on_spring_updated(context, spring));
                }
            }
        }
    }
}
