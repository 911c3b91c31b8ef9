//! What wakes those that [sleep](super::sleep).

use super::Precise;
use super::sleep::KnownJoint;
use crate::body::BodyId;
use crate::controllers::ControllerKind;
use crate::objects::Objects;
use crate::precise::parameters::sleep::{TIME_TO_SLEEP, WAKING_FORCE_CHANGE};
use crate::storage::order::sort_by_number;

impl Precise {
    /// The bodies of a pair are to wake, if they sleep.
    pub(super) fn note_waking(&mut self, pair: usize) {
        for (body, mobility) in self.sides(pair) {
            if mobility.gives_way() {
                self.sleep.note_waking(body);
            }
        }
    }

    /// What the bodies of a pair rested on may have gone.
    pub(super) fn note_loss(&mut self, pair: usize) {
        self.sides(pair).into_iter().for_each(|(body, _)| self.sleep.note_loss(body));
    }

    /// A pair has come. What nobody else would look at is: something has been put beside what sleeps.
    pub(super) fn note_new(&mut self, pair: usize) {
        if !self.may_change(pair) {
            self.note_waking(pair);
        }
    }

    /// What awake bodies have touched in this step, kinematic ones move, or other forces push than before, wakes.
    pub(crate) fn wake_disturbed(&mut self, objects: &mut Objects) {
        if self.sleep.count == 0 {
            self.sleep.touched.clear();
            return;
        }
        let mut touched = std::mem::take(&mut self.sleep.touched);
        // What a handler has refused has lost its row.
        touched.retain(|&pair| self.pairs.all[pair as usize].home.is_some());
        touched.drain(..).for_each(|pair| self.note_waking(pair as usize));
        self.sleep.touched = touched;
        self.note_moving_kinematic(objects);
        self.note_pushed(objects);
        self.wake_up();
        debug_assert!(self.is_awake_what_is_solved(), "rows and joints of what sleeps are put aside");
    }

    fn is_awake_what_is_solved(&self) -> bool {
        (0..self.pairs.len()).all(|pair| {
            let state = &self.pairs.all[pair];
            state.home.is_none_or(|home| {
                let is_asleep = self.rows.asleep(home).is_some();
                self.sides(pair)
                    .iter()
                    .all(|&(body, mobility)| !mobility.gives_way() || self.sleep.is_asleep(body) == is_asleep)
            })
        })
    }

    /// Kinematic bodies that begin to move wake what lies on them, or hangs on them by a joint.
    fn note_moving_kinematic(&mut self, objects: &Objects) {
        for at in 0..self.bodies.kinematic.len() {
            let number = self.bodies.kinematic[at] as usize;
            let id = self.bodies.ids[number];
            if !self.is_on_its_way(number, id, objects) {
                continue;
            }
            let mut pairs = std::mem::take(&mut self.lost);
            let with_rows = |pair: &usize| self.pairs.all[*pair].home.is_some();
            let of_body = self.pairs.of_body(&self.proxies, number).filter(with_rows);
            pairs.extend(of_body.map(|pair| pair as u32));
            pairs.drain(..).for_each(|pair| self.note_waking(pair as usize));
            self.lost = pairs;
            let joints = std::mem::take(&mut self.sleep.joints);
            let of_body = joints.iter().filter(|joint| joint.bodies().any(|body| Some(body) == id));
            of_body.for_each(|joint| self.note_ends(joint));
            self.sleep.joints = joints;
        }
        self.note_moving_spring_ends(objects);
    }

    /// Whether the next step moves what is kinematic.
    pub(super) fn is_on_its_way(&self, number: usize, id: Option<BodyId>, objects: &Objects) -> bool {
        let body = id.and_then(|id| objects.bodies.get(id));
        body.is_some_and(|entry| entry.body.is_on_its_way())
            || self.space.as_ref().is_some_and(|space| match id {
                Some(id) => space.is_on_its_way(id),
                None => space.is_fixture_on_its_way(number),
            })
    }

    fn note_ends(&mut self, joint: &KnownJoint) {
        for body in joint.bodies() {
            if let Some(number) = self.number_of(body) {
                self.sleep.note_waking(number);
            }
        }
    }

    /// Something has pushed a body: if it sleeps it is to be seen whether it bears that.
    pub(super) fn note_pushed_body(&mut self, number: usize) {
        if self.sleep.is_asleep(number) {
            self.sleep.pushed.push(number as u32);
        }
    }

    /// Bodies that other forces push than those they fell asleep under wake; of the others forces are forgotten.
    fn note_pushed(&mut self, objects: &mut Objects) {
        let mut pushed = std::mem::take(&mut self.sleep.pushed);
        self.collect_pushed(objects, &mut pushed);
        pushed.sort_unstable();
        pushed.dedup();
        pushed.retain(|&body| self.sleep.is_asleep(body as usize));
        self.learn_anew(objects);
        let slack = if pushed.is_empty() { 0.0 } else { self.slow() / TIME_TO_SLEEP };
        for body in pushed.drain(..).map(|body| body as usize) {
            let ([x, y, turning, z], reach) = (self.sleep.borne[body], self.bodies.reaches[body]);
            let Some(id) = self.bodies.ids[body] else { continue };
            let Some(entry) = objects.bodies.get_mut(id) else { continue };
            let in_depth = self.space.as_ref().map_or(0.0, |space| (space.acceleration(id) - z).abs());
            if in_depth > slack || !entry.body.bears([x, y, turning], reach, slack - in_depth) {
                self.sleep.note_waking(body);
            } else if let Some(space) = self.space.as_deref_mut() {
                space.forget_acceleration(id);
            }
        }
        self.sleep.pushed = pushed;
    }

    /// Who has just fallen asleep does not move any more, and springs that damp see it: what they do then is what it bears.
    fn learn_anew(&mut self, objects: &Objects) {
        let mut fresh = std::mem::take(&mut self.sleep.fresh);
        fresh.retain(|&body| self.sleep.is_asleep(body as usize));
        for body in fresh.drain(..).map(|body| body as usize) {
            let Some(id) = self.bodies.ids[body] else { continue };
            let Some(entry) = objects.bodies.get(id) else { continue };
            let ([x, y, turning], before) = (entry.body.accelerations(), self.sleep.borne[body]);
            let now = [x, y, turning, self.space.as_ref().map_or(0.0, |space| space.acceleration(id))];
            let is_near = |at: usize| (now[at] - before[at]).abs() <= WAKING_FORCE_CHANGE * before[at].abs();
            if (0..4).all(is_near) {
                self.sleep.borne[body] = now;
            }
        }
        self.sleep.fresh = fresh;
    }

    /// Who may have been pushed: by springs and controllers, and those that bear something.
    fn collect_pushed(&self, objects: &Objects, pushed: &mut Vec<u32>) {
        pushed.extend_from_slice(&self.sleep.leaning);
        let mut note = |body: Option<BodyId>| {
            let number = body.and_then(|body| self.number_of(body));
            pushed.extend(number.filter(|&number| self.sleep.is_asleep(number)).map(|number| number as u32));
        };
        for (_, spring) in (0..objects.springs.list().len()).filter_map(|at| objects.springs.at(at)) {
            spring.ends().into_iter().for_each(&mut note);
        }
        let controllers = &objects.controllers;
        for (_, controller) in (0..controllers.list().len()).filter_map(|at| controllers.at(at)) {
            match controller.kind() {
                ControllerKind::FluidDrag(drag) => {
                    drag.geoms().for_each(|geom| note(objects.geoms.get(geom).map(|geom| geom.body)));
                }
                // It pulls at everything.
                ControllerKind::Gravity(_) => objects.bodies.list().iter().for_each(|&body| note(Some(body))),
                _ => {}
            }
        }
    }

    /// Joints of what sleeps that have gone, come, or become others wake it.
    pub(super) fn note_joints_that_changed(&mut self, objects: &Objects) {
        if self.sleep.count == 0 || self.joints.are_read() {
            return;
        }
        let mut is_listed = vec![false; objects.joints.slot_count()];
        objects.joints.list().iter().for_each(|joint| is_listed[joint.slot()] = true);
        self.note_others(objects, |joint| is_listed.get(joint.joint.slot()) == Some(&true));
        let mut is_known = vec![false; objects.joints.slot_count()];
        for joint in &self.sleep.joints {
            // A damaged save may name any.
            is_known.get_mut(joint.joint.slot()).into_iter().for_each(|is_known| *is_known = true);
        }
        let all = (0..objects.joints.list().len()).filter_map(|at| objects.joints.at(at));
        for joint in all.filter(|(id, _)| !is_known[id.slot()]) {
            if let Some(joint) = self.known_joint(joint, &objects.bodies) {
                self.note_ends(&joint);
            }
        }
    }

    /// Motors or limits were edited.
    pub(crate) fn note_edited_drives(&mut self, objects: &Objects) {
        self.note_others(objects, |_| true);
    }

    /// Those joints of what sleeps that may not stay, or are not what they were, wake it.
    fn note_others(&mut self, objects: &Objects, may_stay: impl Fn(&KnownJoint) -> bool) {
        let known = std::mem::take(&mut self.sleep.joints);
        for joint in &known {
            if !(may_stay(joint) && self.is_as_it_was(joint, objects)) {
                self.note_ends(joint);
            }
        }
        self.sleep.joints = known;
    }

    /// Whether a joint is still what it was, and bears its load.
    fn is_as_it_was(&self, joint: &KnownJoint, objects: &Objects) -> bool {
        let now = objects.joints.get(joint.joint).filter(|now| now.bears_its_load());
        let now = now.map(|now| (joint.joint, now));
        now.and_then(|now| self.known_joint(now, &objects.bodies)) == Some(*joint)
    }

    /// Bodies that are not listed were edited: joints of theirs do not follow them, and are read again.
    pub(super) fn note_joints_of_unlisted(&mut self, edited: &[BodyId]) {
        let is_of = |(first, second): (Option<BodyId>, BodyId)| {
            edited.contains(&second) || first.is_some_and(|first| edited.contains(&first))
        };
        let sleeping = self.sleep.joints.iter().map(|joint| joint.held.bodies);
        if self.joints.of_unlisted().chain(sleeping).any(is_of) {
            self.note_joints();
        }
    }

    /// Everything wakes.
    pub(super) fn wake_all(&mut self) {
        if self.sleep.count > 0 {
            (1..=self.bodies.count).for_each(|body| self.sleep.note_waking(body));
            self.wake_up();
        }
    }

    /// A body wakes with the next update, and those that fell asleep with it: that is an edit like others.
    pub(crate) fn wake(&mut self, body: BodyId) {
        if let Some(loaded) = &mut self.loaded {
            loaded.wake(body);
        } else if self.is_asleep(body) && !self.woken.contains(&body) {
            self.woken.push(body);
        }
    }

    /// Those that the game woke do, one after the other and before those that edits wake: the order of pairs depends on it.
    pub(super) fn wake_woken(&mut self) {
        if self.woken.is_empty() {
            return;
        }
        let others = std::mem::take(&mut self.sleep.waking);
        let mut has_woken = false;
        for body in std::mem::take(&mut self.woken) {
            if let Some(number) = self.number_of(body) {
                self.sleep.note_waking(number);
                has_woken |= self.take_up_waking();
            }
        }
        if has_woken {
            self.forget_who_slept();
        }
        self.sleep.waking.extend(others);
    }

    /// How many bodies sleep.
    pub(crate) fn asleep_count(&self) -> usize {
        self.sleep.count - self.swings_asleep()
    }

    pub(crate) fn is_asleep(&self, body: BodyId) -> bool {
        self.number_of(body).is_some_and(|number| self.sleep.is_asleep(number))
    }

    /// Those that are to wake do, with all that fell asleep together with them.
    pub(super) fn wake_up(&mut self) {
        if self.take_up_waking() {
            self.forget_who_slept();
        }
    }

    /// Those that are to wake are awake, and so are their pairs. Answers whether there were any.
    fn take_up_waking(&mut self) -> bool {
        if self.sleep.waking.is_empty() {
            return false;
        }
        let mut waking = std::mem::take(&mut self.sleep.waking);
        let mut woken = Vec::new();
        waking.drain(..).for_each(|body| self.sleep.take_up(body as usize, |body| woken.push(body)));
        self.sleep.waking = waking;
        self.take_pairs_up(&woken);
        true
    }

    /// What is kept of those that sleep, and how lists are gone through without them, follows who has woken.
    fn forget_who_slept(&mut self) {
        let joints = self.sleep.joints.len();
        let mut known = std::mem::take(&mut self.sleep.joints);
        known.retain(|joint| self.lies(joint));
        self.sleep.joints = known;
        if self.sleep.joints.len() < joints {
            self.note_joints();
        }
        let mut leaning = std::mem::take(&mut self.sleep.leaning);
        leaning.retain(|&body| self.sleep.is_asleep(body as usize));
        self.sleep.leaning = leaning;
        self.sleep.renew_runs(&self.proxies);
    }

    /// The pairs of these bodies may change again, and their rows go back to their colours. In the order of creation numbers:
    /// that of rows of the last colour matters.
    fn take_pairs_up(&mut self, woken: &[u32]) {
        let mut pairs = Vec::new();
        for &body in woken {
            pairs.extend(self.pairs.of_body(&self.proxies, body as usize));
        }
        sort_by_number(&mut pairs, |&pair| self.proxies.creation_numbers(self.pairs.watched[pair].proxies));
        pairs.dedup();
        let h = self.h;
        for &pair in &pairs {
            self.touch().move_row(pair, false, h);
            if self.pairs.all[pair].home.is_none() {
                self.pairs.look_again(pair);
            }
        }
        pairs.retain(|&pair| pair >= self.pairs.awake);
        // From the first one on, so that numbers stay what they are.
        pairs.sort_unstable();
        pairs.into_iter().for_each(|pair| {
            self.touch().take_up(pair);
        });
        // What handlers have said was for one step.
        self.has_handled = true;
    }
}
