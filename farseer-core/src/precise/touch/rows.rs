//! Pairs and their rows come and go, and move.

use super::Touch;
use crate::math::plane::Vector;
use crate::precise::direct::{is_burden, is_upright};
use crate::precise::pairs::BY_ROW;
use crate::precise::rows::{Aside, Home, Lane};

impl Touch<'_> {
    pub(super) fn add_row(&mut self, pair: usize, lane: &Lane) {
        let kind = self.pairs.all[pair].kind;
        let free = self.palette.free(kind, [lane.a, lane.b]);
        let colour = self.rows.choose(kind, free);
        self.palette.mark(kind, [lane.a, lane.b], colour, true);
        self.direct.note([lane.a, lane.b], self.space.is_some());
        self.direct.watch_friction(lane.b, self.space.is_some());
        self.pairs.all[pair].home = Some(self.rows.push(kind, colour, lane));
        if [lane.a, lane.b].into_iter().any(|body| self.sleep.is_asleep(body as usize)) {
            self.sleep.note_touch(pair);
        }
    }

    /// Takes the row of a pair out, if it has one.
    pub(in crate::precise) fn remove_row(&mut self, pair: usize) {
        let kind = self.pairs.all[pair].kind;
        let Some(home) = self.pairs.all[pair].home.take() else { return };
        let Lane { a, b, .. } = self.rows.lane(kind, home);
        let colour = self.rows.aside(home).map_or(home.colour, |row| row.colour);
        self.palette.mark(kind, [a, b], colour, false);
        self.direct.note([a, b], self.space.is_some());
        self.rows.remove(kind, home);
        self.follow_rows();
    }

    /// Whether something heavy lies on something light by a normal of a pair, where there is a depth axis.
    #[inline(always)]
    pub(super) fn is_burden(&self, pair: usize, normal: Vector) -> bool {
        self.space.is_some() && is_upright(normal, self.fall) && self.burdens(pair, normal)
    }

    #[inline(never)]
    fn burdens(&self, pair: usize, normal: Vector) -> bool {
        let inverse_masses = self.pairs.watched[pair].proxies.map(|proxy| {
            let body = self.proxies.all[proxy as usize].body;
            self.bodies.inverses[body as usize][0]
        });
        is_burden(inverse_masses, normal, self.fall)
    }

    /// Pairs learn where their rows are that have moved.
    fn follow_rows(&mut self) {
        for (pair, home) in self.rows.take_moved() {
            self.pairs.all[pair as usize].home = Some(home);
        }
    }

    /// Takes a pair out.
    pub(in crate::precise) fn remove_pair(&mut self, pair: usize) {
        if pair >= self.pairs.awake && self.pairs.all[pair].home.is_some() {
            let bodies = self.pairs.watched[pair].proxies.map(|proxy| self.proxies.all[proxy as usize].body);
            bodies.into_iter().for_each(|body| self.sleep.note_waking(body as usize));
        }
        self.end_touch(pair);
        self.forget_pair(pair);
    }

    /// A pair that goes does not touch any more, which is told if it did.
    pub(in crate::precise) fn end_touch(&mut self, pair: usize) {
        if self.pairs.all[pair].is_told {
            self.tell(pair, false);
        }
    }

    /// Takes a pair out whose touch has ended.
    pub(in crate::precise) fn forget_pair(&mut self, pair: usize) {
        self.remove_row(pair);
        self.pairs.set_told(pair, false);
        let at = if pair < self.pairs.awake { self.lay_down(pair) } else { pair };
        self.swap_pairs(at, self.pairs.len() - 1);
        self.pairs.pop();
    }

    /// Two pairs change numbers, and their rows know.
    fn swap_pairs(&mut self, one: usize, other: usize) {
        if one == other {
            return;
        }
        self.pairs.swap(one, other);
        for pair in [one, other] {
            if let Some(home) = self.pairs.all[pair].home {
                self.rows.set_pair(self.pairs.all[pair].kind, home, pair as u32);
            }
        }
    }

    /// A pair is among those that may change from now on. Answers its number then.
    pub(in crate::precise) fn take_up(&mut self, pair: usize) -> usize {
        let at = self.pairs.awake;
        self.swap_pairs(pair, at);
        self.pairs.awake += 1;
        at
    }

    /// A pair is among those of bodies that sleep from now on. Answers its number then.
    pub(in crate::precise) fn lay_down(&mut self, pair: usize) -> usize {
        self.pairs.awake -= 1;
        self.swap_pairs(pair, self.pairs.awake);
        self.pairs.awake
    }

    /// Two circles, whose row has followed them until now, are known as they lie.
    fn freeze_circles(&mut self, pair: usize, home: Home) {
        let two = self.two(pair);
        let found = self.collide(pair, two, f32::MAX);
        self.freeze(pair, two, &found);
        let kind = self.pairs.all[pair].kind;
        let now = self.lane(pair, two);
        let mut lane = self.rows.lane(kind, home);
        (lane.normal, lane.tangent_arms, lane.tangent_mass) =
            (now.normal, now.tangent_arms, now.tangent_mass);
        for (point, now) in lane.points.iter_mut().zip(&now.points) {
            (point.arm_a, point.arm_b, point.separation) = (now.arm_a, now.arm_b, now.separation);
        }
        self.rows.set_lane(kind, home, &lane);
    }

    /// The row of a pair falls asleep, with impulses of substeps of this length; or wakes.
    pub(in crate::precise) fn move_row(&mut self, pair: usize, falls_asleep: bool, h: f32) {
        let kind = self.pairs.all[pair].kind;
        let Some(home) = self.pairs.all[pair].home else { return };
        if falls_asleep && self.pairs.watched[pair].tolerance == BY_ROW && self.rows.asleep(home).is_none() {
            self.freeze_circles(pair, home);
        }
        let moved = if falls_asleep {
            self.rows.put_aside(kind, home, false, h)
        } else {
            self.rows.take_up(kind, home, h)
        };
        // What wakes may be solved as a whole again, and of what falls asleep nothing is.
        self.direct.timing.is_due |= moved != home
            && (self.space.is_none()
                || home.is_direct()
                || self.is_burden(pair, self.pairs.frozen[pair].normal));
        self.settle(pair, moved);
    }

    /// The row of a pair is solved with its island from now on, or by the passes.
    pub(in crate::precise) fn hand_over(&mut self, pair: usize, is_direct: bool, h: f32) {
        let kind = self.pairs.all[pair].kind;
        let Some(home) = self.pairs.all[pair].home else { return };
        let moved = if is_direct {
            self.rows.put_aside(kind, home, true, h)
        } else {
            self.rows.take_up(kind, home, h)
        };
        self.settle(pair, moved);
    }

    /// A row has moved home, and others with it.
    fn settle(&mut self, pair: usize, home: Home) {
        self.pairs.all[pair].home = Some(home);
        self.follow_rows();
    }

    /// A row as it was saved.
    pub(in crate::precise) fn restore_row(
        &mut self,
        pair: usize,
        colour: u32,
        aside: Option<(f32, Option<[f64; 3]>)>,
        set: impl FnOnce(&mut Lane),
    ) {
        let mut lane = self.lane(pair, self.two(pair));
        set(&mut lane);
        let kind = self.pairs.all[pair].kind;
        let colour = self.palette.again(kind, [lane.a, lane.b], colour);
        self.palette.mark(kind, [lane.a, lane.b], colour, true);
        // A damaged save may say that what is awake sleeps.
        let is_still = |&body: &u32| {
            body == 0 || self.sleep.is_asleep(body as usize) || self.bodies.is_kinematic(body as usize)
        };
        let may_be =
            |&(_, exact): &(f32, Option<[f64; 3]>)| exact.is_some() || [lane.a, lane.b].iter().all(is_still);
        let home: Home = match aside.filter(may_be) {
            Some((h, exact)) => {
                let row = Aside { lane, colour, h, exact: exact.unwrap_or_default() };
                self.rows.push_aside(row, exact.is_some())
            }
            None => {
                self.sleep.note_waking(lane.a as usize);
                self.sleep.note_waking(lane.b as usize);
                self.rows.push(kind, colour, &lane)
            }
        };
        self.pairs.all[pair].home = Some(home);
    }
}
