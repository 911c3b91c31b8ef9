//! Bodies that have something upright do not turn: neither contacts nor torques do it, and what a game has turned by hand lies for
//! the contacts as if it had not.

use super::Space;
use super::parts::is_geom;
use crate::body::Body;
use crate::precise::Precise;
use crate::precise::bodies::inverses_of;
use crate::precise::proxies::Proxy;

impl Space {
    /// Whether a body has something upright.
    pub(in crate::precise) fn is_steady(&self, number: usize) -> bool {
        self.has_upright && super::entry(&self.are_upright, number)
    }
}

impl Precise {
    /// Reciprocals of mass and moment of inertia of a body that can be pushed.
    pub(in crate::precise) fn inverses_in_space(&self, number: usize, body: &Body) -> [f32; 2] {
        let [mass, inertia] = inverses_of(body);
        let is_steady = self.space.as_ref().is_some_and(|space| space.is_steady(number));
        [mass, if is_steady { 0.0 } else { inertia }]
    }

    /// A proxy of something upright has been listed: its body does not turn.
    pub(in crate::precise) fn steady_body_of(&mut self, proxy: u32) {
        let Precise { space: Some(space), proxies, .. } = self else { return };
        let Proxy { geom, body, .. } = proxies.all[proxy as usize];
        if space.is_upright(proxy) && is_geom(geom) {
            let number = body as usize;
            (*super::entry_mut(&mut space.are_upright, number), space.has_upright) = (true, true);
            self.steady(number);
        }
    }

    /// The same of all that are listed.
    pub(in crate::precise) fn steady_all_bodies(&mut self) {
        (0..self.proxies.all.len()).for_each(|proxy| self.steady_body_of(proxy as u32));
    }

    /// A body is taken over that may be one of them.
    pub(in crate::precise) fn steady_if_upright(&mut self, number: usize) {
        if self.space.as_ref().is_some_and(|space| space.is_steady(number)) {
            self.steady(number);
        }
    }

    fn steady(&mut self, number: usize) {
        self.bodies.inverses[number][1] = 0.0;
        let [x, y, ..] = self.bodies.poses[number];
        self.bodies.poses[number] = [x, y, 1.0, 0.0];
        if let Some(hot) = self.bodies.hot.get_mut(number) {
            hot.velocity[2] = 0.0;
        }
    }

    /// A step begins: they do not turn in it.
    pub(in crate::precise) fn begin_steady(&mut self) {
        let Precise { space: Some(space), bodies, sleep, .. } = self else { return };
        if !space.has_upright {
            return;
        }
        for number in sleep.awake(bodies.count).filter(|&number| space.are_upright[number]) {
            for turning in [
                &mut bodies.hot[number].velocity[2],
                &mut bodies.before[number][2],
                &mut bodies.push[number][2],
                &mut bodies.forced[number][2],
            ] {
                *turning = 0.0;
            }
        }
    }

    /// A step has ended: poses are new ones. Contacts are found with the spin that a restored body has, none.
    pub(in crate::precise) fn end_steady(&mut self) {
        let Precise { space: Some(space), bodies, sleep, .. } = self else { return };
        if space.has_upright {
            // Of all that were renewed, some of which sleep beside those that are awake.
            let renewed = sleep.bodies.iter().cloned().flatten();
            for number in renewed.filter(|&number| super::entry(&space.are_upright, number)) {
                let [x, y, ..] = bodies.poses[number];
                bodies.poses[number] = [x, y, 1.0, 0.0];
                bodies.hot[number].velocity[2] = 0.0;
            }
        }
    }
}
