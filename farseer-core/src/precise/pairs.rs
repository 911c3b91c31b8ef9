//! Pairs of proxies whose bounds overlap: they stay until the bounds part, and know what touched when.

use serde::{Deserialize, Serialize};

use super::one_way::Passage;
use super::proxies::Proxies;
use super::rows::{Home, Kind};
use crate::math::plane::Vector;
use crate::storage::reusing_clone::reusing_clone;

/// No pair, and no link.
pub(super) const NONE: u32 = u32::MAX;

/// What the scan of all pairs reads: the pair is looked at once both have moved by more than `tolerance` since `since`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Watch {
    pub(super) proxies: [u32; 2],
    pub(super) since: u32,
    pub(super) tolerance: u32,
}

/// The tolerance of what is looked at by its row instead.
pub(super) const BY_ROW: u32 = u32::MAX;

/// Contacts as they were found last, to be kept while the two hardly move against each other.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Frozen {
    /// Cosine and sine of A and of B then.
    pub(super) turns: [f32; 4],
    /// B's pose as seen from A.
    pub(super) relative: [f32; 4],
    pub(super) normal: Vector,
    pub(super) count: u32,
    /// Arms of A and of B, then.
    pub(super) anchors: [[f32; 4]; 2],
    pub(super) separations: [f32; 2],
    pub(super) features: [u32; 2],
    /// How far the arms of B's corners are turned on from then, to where they are in the middle of the step: where a body rolls
    /// over a corner on what does not give way, arms from before the step would take energy from it in every step.
    pub(super) lead: f32,
    /// In three axes.
    pub(super) space: FrozenInSpace,
}

/// What contacts in three axes have beside that.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct FrozenInSpace {
    pub(super) normal_z: f32,
    /// How far B was behind A.
    pub(super) apart: f32,
    pub(super) spread: f32,
    /// Where the points were along the depth axis, as seen from A.
    pub(super) depths: [f32; 2],
}

/// Everything else about a pair.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair {
    pub(super) kind: Kind,
    /// Where its row is, if it has one.
    pub(super) home: Option<Home>,
    /// It touched when last told.
    pub(super) is_told: bool,
    /// Contacts push.
    pub(super) responds: bool,
    /// A handler is told of it, from one side at least.
    pub(super) is_heard: bool,
    /// A handler refused it in this update; or in the one before.
    pub(super) is_vetoed: bool,
    pub(super) was_vetoed: bool,
    /// A handler has set something about its surfaces in this update.
    pub(super) is_set: bool,
    /// A is the ground of a world with depth.
    pub(super) is_on_ground: bool,
    /// Neither side can be pushed: a sensor and a static or kinematic body. See [`unpushed`](super::unpushed).
    pub(super) is_unpushed: bool,
    /// Whether one passes through the other.
    pub(super) passage: Passage,
}

/// A pair in the lists of its proxies: what walks along them looks at.
#[derive(Debug, Clone, Copy)]
struct Links {
    proxies: [u32; 2],
    next: [u32; 2],
    previous: [u32; 2],
}

/// The pairs: first those that may change, then those of bodies that sleep. A pair's number changes when another one goes,
/// falls asleep or wakes.
#[derive(Debug, Default)]
pub(super) struct Pairs {
    pub(super) watched: Vec<Watch>,
    pub(super) all: Vec<Pair>,
    pub(super) frozen: Vec<Frozen>,
    links: Vec<Links>,
    /// Number of those that may change.
    pub(super) awake: usize,
    /// Number of pairs that touch.
    pub(super) touching: usize,
    /// Number of those that are pairs with the ground of a world with depth.
    pub(super) on_ground: usize,
    /// Number of those of which a handler is told.
    pub(super) heard: usize,
    /// Number of pairs of which neither side can be pushed.
    pub(super) unpushed: usize,
    /// First link of each proxy's list: twice a pair's number, plus which side of it the proxy is.
    heads: Vec<u32>,
}

reusing_clone! { Pairs { watched, all, frozen, links, awake, touching, on_ground, heard, unpushed, heads } }

impl Pairs {
    /// Forgets all pairs.
    pub(super) fn reset(&mut self, proxies: usize) {
        self.watched.clear();
        self.all.clear();
        self.frozen.clear();
        self.links.clear();
        self.awake = 0;
        (self.touching, self.on_ground, self.heard, self.unpushed) = (0, 0, 0, 0);
        self.heads.clear();
        self.heads.resize(proxies, NONE);
    }

    /// Expects so many proxies, with those that it has.
    pub(super) fn grow(&mut self, proxies: usize) {
        self.heads.resize(proxies, NONE);
    }

    pub(super) fn len(&self) -> usize {
        self.all.len()
    }

    /// The pairs of a proxy.
    pub(super) fn of(&self, proxy: u32) -> impl Iterator<Item = usize> + '_ {
        let mut link = self.heads[proxy as usize];
        std::iter::from_fn(move || {
            let at = (link != NONE).then_some((link >> 1) as usize)?;
            link = self.links[at].next[(link & 1) as usize];
            Some(at)
        })
    }

    /// The pairs of all proxies of a body.
    pub(super) fn of_body<'a>(
        &'a self,
        proxies: &'a Proxies,
        body: usize,
    ) -> impl Iterator<Item = usize> + use<'a> {
        let (mut link, mut proxy) = (NONE, proxies.first_of(body));
        std::iter::from_fn(move || self.next_of_body(proxies, &mut link, &mut proxy))
    }

    /// Apart, so that whoever asks shares it.
    #[inline(never)]
    fn next_of_body(&self, proxies: &Proxies, link: &mut u32, proxy: &mut Option<u32>) -> Option<usize> {
        while *link == NONE {
            let next = (*proxy)?;
            (*link, *proxy) = (self.heads[next as usize], proxies.after(next));
        }
        let at = (*link >> 1) as usize;
        *link = self.links[at].next[(*link & 1) as usize];
        Some(at)
    }

    /// Changes the pairs of a proxy, by the proxies that they are of.
    pub(super) fn for_each_of(&mut self, proxy: u32, mut change: impl FnMut([u32; 2], &mut Pair)) {
        let mut link = self.heads[proxy as usize];
        while link != NONE {
            let at = (link >> 1) as usize;
            change(self.links[at].proxies, &mut self.all[at]);
            link = self.links[at].next[(link & 1) as usize];
        }
    }

    pub(super) fn contains(&self, [a, b]: [u32; 2]) -> bool {
        self.of(b).any(|pair| self.links[pair].proxies == [a, b])
    }

    /// A new pair, which nothing is known of. B is in few pairs: it can be pushed.
    pub(super) fn push(&mut self, proxies: [u32; 2], kind: Kind, responds: bool, is_heard: bool) -> usize {
        let at = self.all.len();
        self.watched.push(Watch { proxies, since: 0, tolerance: 0 });
        self.frozen.push(Frozen::default());
        self.links.push(Links { proxies, next: [NONE; 2], previous: [NONE; 2] });
        self.all.push(Pair {
            kind,
            home: None,
            is_told: false,
            responds,
            is_heard,
            is_vetoed: false,
            was_vetoed: false,
            is_set: false,
            is_on_ground: false,
            is_unpushed: false,
            passage: Passage::Closed,
        });
        for side in 0..2 {
            self.link(at, side);
        }
        at
    }

    /// A pair begins or ceases to touch.
    pub(super) fn set_told(&mut self, pair: usize, is_told: bool) {
        let was_told = std::mem::replace(&mut self.all[pair].is_told, is_told);
        self.touching = self.touching + usize::from(is_told) - usize::from(was_told);
        if self.all[pair].is_on_ground {
            self.on_ground = self.on_ground + usize::from(is_told) - usize::from(was_told);
        }
        if self.all[pair].is_heard {
            self.heard = self.heard + usize::from(is_told) - usize::from(was_told);
        }
    }

    /// Neither side of a pair can be pushed, or one can.
    pub(super) fn set_unpushed(&mut self, pair: usize, is_unpushed: bool) {
        let was_unpushed = std::mem::replace(&mut self.all[pair].is_unpushed, is_unpushed);
        self.unpushed = self.unpushed + usize::from(is_unpushed) - usize::from(was_unpushed);
    }

    /// A handler is told of a pair from now on, or is not.
    pub(super) fn set_heard(&mut self, pair: usize, is_heard: bool) {
        let was_heard = std::mem::replace(&mut self.all[pair].is_heard, is_heard);
        if self.all[pair].is_told {
            self.heard = self.heard + usize::from(is_heard) - usize::from(was_heard);
        }
    }

    /// The proxy on the other side of each pair of a proxy.
    pub(super) fn partners(&self, proxy: u32) -> impl Iterator<Item = u32> + '_ {
        self.of(proxy).map(move |pair| {
            let [a, b] = self.links[pair].proxies;
            if a == proxy { b } else { a }
        })
    }

    /// The pair is looked at in full in the next step.
    pub(super) fn look_again(&mut self, pair: usize) {
        self.watched[pair].tolerance = 0;
        self.frozen[pair].turns = [0.0; 4];
    }

    fn link(&mut self, pair: usize, side: usize) {
        let head = &mut self.heads[self.watched[pair].proxies[side] as usize];
        let link = (pair * 2 + side) as u32;
        let next = std::mem::replace(head, link);
        self.links[pair].next[side] = next;
        self.links[pair].previous[side] = NONE;
        if next != NONE {
            self.links[(next >> 1) as usize].previous[(next & 1) as usize] = link;
        }
    }

    /// Takes the last pair out; it has no row any more.
    pub(super) fn pop(&mut self) {
        let last = self.all.len() - 1;
        self.set_unpushed(last, false);
        self.unlink(last);
        self.watched.pop();
        self.frozen.pop();
        self.links.pop();
        self.all.pop();
        self.awake = self.awake.min(last);
    }

    /// Two pairs change numbers.
    pub(super) fn swap(&mut self, one: usize, other: usize) {
        self.unlink(one);
        self.unlink(other);
        self.watched.swap(one, other);
        self.frozen.swap(one, other);
        self.links.swap(one, other);
        self.all.swap(one, other);
        for pair in [one, other] {
            (0..2).for_each(|side| self.link(pair, side));
        }
    }

    fn unlink(&mut self, pair: usize) {
        for side in 0..2 {
            let Links { proxies, next, previous } = self.links[pair];
            match previous[side] {
                NONE => self.heads[proxies[side] as usize] = next[side],
                link => self.links[(link >> 1) as usize].next[(link & 1) as usize] = next[side],
            }
            if next[side] != NONE {
                let link = next[side];
                self.links[(link >> 1) as usize].previous[(link & 1) as usize] = previous[side];
            }
        }
    }
}
