//! Contact constraints in graph colours. A constraint stays where it is from step to step, four of them side by side in one
//! block for SIMD. No two constraints of a colour share a body that can be pushed, so that their order does not matter. The
//! last colour takes the constraints that find no other, one in each block, and is solved in order.
//!
//! Greedy colouring as constraints come and go, an overflow colour and one SIMD lane for each constraint are Box2D 3's
//! (E. Catto, "SIMD Matters", box2d.org, 2024; `constraint_graph.c`, `contact_solver.c`). Box2D cites Y.-K. Chen et al.,
//! "High-Performance Physical Simulations on Next-Generation Architecture with Many Cores" (2007).

mod colours;
mod home;
mod lane;
mod palette;
mod row;

use super::space::SpaceRow;
use crate::storage::reusing_clone::reusing_clone;
use colours::LAST;
pub(super) use colours::{COLOURS, Colours};
use home::{ASLEEP, DIRECT};
pub(super) use home::{Aside, Home, Kind};
pub(super) use lane::{Lane, PointLane, SpaceLane};
pub(super) use palette::Palette;
pub(super) use row::{Block, Contacts, Point, Row, get, set};

/// All rows of contacts.
#[derive(Debug, Default)]
pub(super) struct Rows {
    asleep: Vec<Aside>,
    direct: Vec<Aside>,
    /// Since this was [asked](Rows::take_change) for, a row that is solved with its island may have got other arms or impulses.
    has_changed: bool,
    pub(super) two: Colours<Row<2>>,
    pub(super) one: Colours<Row<1>>,
    pub(super) two_fixed: Colours<Row<2>>,
    pub(super) one_fixed: Colours<Row<1>>,
    pub(super) space: SpaceRows,
    /// Pairs whose rows have moved home: empty but for a moment.
    moved: Vec<(u32, Home)>,
}

reusing_clone! { Rows { asleep, direct, has_changed, two, one, two_fixed, one_fixed, space, moved } }

/// The rows in three axes.
#[derive(Debug, Default)]
pub(super) struct SpaceRows {
    pub(super) prisms: Colours<SpaceRow<2>>,
    pub(super) balls: Colours<SpaceRow<1>>,
    pub(super) prisms_fixed: Colours<SpaceRow<2>>,
    pub(super) balls_fixed: Colours<SpaceRow<1>>,
}

reusing_clone! { SpaceRows { prisms, balls, prisms_fixed, balls_fixed } }

impl SpaceRows {
    /// Calls for the points of all rows.
    pub(super) fn for_each_point(&mut self, act: &mut impl FnMut(&mut [Point])) {
        self.prisms.for_each(|row| act(row.points()));
        self.balls.for_each(|row| act(row.points()));
        self.prisms_fixed.for_each(|row| act(row.points()));
        self.balls_fixed.for_each(|row| act(row.points()));
    }
}

/// The rows of a kind, borrowed as it says. What is done with them is compiled once for each kind of block, fixed or not.
macro_rules! of_kind {
    (@of ($($borrow:tt)+) $is_fixed:expr, $fixed:expr, $other:expr) => {
        if $is_fixed { $($borrow)+ $fixed } else { $($borrow)+ $other }
    };
    ($borrow:tt $rows:expr, $kind:expr, $colours:ident => $act:expr) => {
        match ($kind.is_in_space(), $kind.has_two_points) {
            (true, true) => {
                let $colours =
                    of_kind!(@of $borrow $kind.is_fixed, $rows.space.prisms_fixed, $rows.space.prisms);
                $act
            }
            (true, false) => {
                let $colours =
                    of_kind!(@of $borrow $kind.is_fixed, $rows.space.balls_fixed, $rows.space.balls);
                $act
            }
            (false, true) => {
                let $colours = of_kind!(@of $borrow $kind.is_fixed, $rows.two_fixed, $rows.two);
                $act
            }
            (false, false) => {
                let $colours = of_kind!(@of $borrow $kind.is_fixed, $rows.one_fixed, $rows.one);
                $act
            }
        }
    };
}

impl Rows {
    pub(super) fn clear(&mut self) {
        self.two.clear();
        self.one.clear();
        self.two_fixed.clear();
        self.one_fixed.clear();
        self.space.prisms.clear();
        self.space.balls.clear();
        self.space.prisms_fixed.clear();
        self.space.balls_fixed.clear();
        self.asleep.clear();
        self.direct.clear();
    }

    /// The rows aside that this home is among.
    #[inline(always)]
    fn shelf(&self, home: Home) -> Option<&Vec<Aside>> {
        match home.colour {
            ASLEEP => Some(&self.asleep),
            DIRECT => Some(&self.direct),
            _ => None,
        }
    }

    #[inline(always)]
    fn shelf_mut(&mut self, home: Home) -> Option<&mut Vec<Aside>> {
        match home.colour {
            ASLEEP => Some(&mut self.asleep),
            DIRECT => Some(&mut self.direct),
            _ => None,
        }
    }

    /// Whether no pass has anything to solve.
    pub(super) fn is_empty(&self) -> bool {
        self.used() == 0
    }

    /// Which colours have rows, by bits.
    fn used(&self) -> u32 {
        let SpaceRows { prisms, balls, prisms_fixed, balls_fixed } = &self.space;
        let in_plane = self.two.used | self.one.used | self.two_fixed.used | self.one_fixed.used;
        in_plane | prisms.used | balls.used | prisms_fixed.used | balls_fixed.used
    }

    /// Whether some row is in the last colour, of which bodies know nothing.
    pub(super) fn has_last(&self) -> bool {
        self.used() >> LAST & 1 == 1
    }

    /// Number of rows of each colour, up to the last one that is used.
    pub(super) fn per_colour(&self) -> Vec<usize> {
        let SpaceRows { prisms, balls, prisms_fixed, balls_fixed } = &self.space;
        let counts = |colour: usize| {
            let fixed = self.two_fixed.counts[colour] + self.one_fixed.counts[colour];
            let in_plane = self.two.counts[colour] + self.one.counts[colour] + fixed;
            let fixed = prisms_fixed.counts[colour] + balls_fixed.counts[colour];
            in_plane + prisms.counts[colour] + balls.counts[colour] + fixed
        };
        (0..(u32::BITS - self.used().leading_zeros()) as usize).map(counts).collect()
    }

    /// Number of points that are solved.
    pub(super) fn point_count(&self) -> usize {
        let direct = self.direct.iter().map(|row| 1 + usize::from(row.lane.points[1].mass > 0.0));
        let SpaceRows { prisms, balls, prisms_fixed, balls_fixed } = &self.space;
        let with_two = self.two.count() + self.two_fixed.count() + prisms.count() + prisms_fixed.count();
        let with_one = self.one.count() + self.one_fixed.count() + balls.count() + balls_fixed.count();
        let in_colours = 2 * with_two + with_one;
        in_colours + direct.sum::<usize>()
    }

    /// Which of these colours, by bits, a new row takes: blocks are filled before others begin.
    pub(super) fn choose(&self, kind: Kind, free: u32) -> u32 {
        of_kind!((&) self, kind, colours => colours.choose(free))
    }

    pub(super) fn push(&mut self, kind: Kind, colour: u32, lane: &Lane) -> Home {
        Home { colour, slot: of_kind!((&mut) self, kind, colours => colours.push(colour, lane)) }
    }

    /// Takes a row out. The pairs whose rows have another home now are to be [taken](Self::take_moved).
    pub(super) fn remove(&mut self, kind: Kind, home: Home) {
        let Home { colour, slot } = home;
        if let Some(shelf) = self.shelf_mut(home) {
            shelf.swap_remove(slot as usize);
            let pair = shelf.get(slot as usize).map(|moved| moved.lane.pair);
            self.moved.extend(pair.map(|pair| (pair, home)));
            return;
        }
        let mut moved = std::mem::take(&mut self.moved);
        of_kind!((&mut) self, kind, colours => {
            colours.remove(colour, slot, |pair, slot| moved.push((pair, Home { colour, slot })));
        });
        self.moved = moved;
    }

    /// The pairs whose rows have moved, and where to.
    pub(super) fn take_moved(&mut self) -> std::vec::Drain<'_, (u32, Home)> {
        self.moved.drain(..)
    }

    /// A row is put aside, asleep or to be solved with its island, with the length of the substeps that its impulses are of.
    /// Answers its new home.
    pub(super) fn put_aside(&mut self, kind: Kind, home: Home, is_direct: bool, h: f32) -> Home {
        if home.colour == if is_direct { DIRECT } else { ASLEEP } {
            return home;
        }
        let lane = self.lane(kind, home);
        let row = self.aside(home).unwrap_or(Aside { lane, colour: home.colour, h, exact: [0.0; 3] });
        self.remove(kind, home);
        self.push_aside(row, is_direct)
    }

    pub(super) fn push_aside(&mut self, row: Aside, is_direct: bool) -> Home {
        let home = Home { colour: if is_direct { DIRECT } else { ASLEEP }, slot: 0 };
        let Some(shelf) = self.shelf_mut(home) else { return home };
        shelf.push(row);
        Home { slot: shelf.len() as u32 - 1, ..home }
    }

    /// A row goes back to its colour, with impulses of substeps of this length.
    pub(super) fn take_up(&mut self, kind: Kind, home: Home, h: f32) -> Home {
        let Some(mut row) = self.aside(home) else { return home };
        row.scale(h);
        self.remove(kind, home);
        self.push(kind, row.colour, &row.lane)
    }

    /// A row that is aside.
    pub(super) fn aside(&self, home: Home) -> Option<Aside> {
        self.shelf(home)?.get(home.slot as usize).copied()
    }

    /// The rows that are solved with their islands.
    pub(super) fn all_direct(&self) -> &[Aside] {
        &self.direct
    }

    /// Changes the rows that are solved with their islands, by what answers whether more than separations may be others now.
    pub(super) fn change_direct(&mut self, mut change: impl FnMut(&mut Lane) -> bool) {
        for Aside { lane, .. } in &mut self.direct {
            self.has_changed |= change(lane);
        }
    }

    /// Whether a row that is solved with its island may have got other arms or impulses since this was asked, other than by being
    /// solved.
    pub(super) fn take_change(&mut self) -> bool {
        std::mem::take(&mut self.has_changed)
    }

    /// A row that is solved with its island.
    #[inline(always)]
    pub(super) fn direct(&self, home: Home) -> &Aside {
        &self.direct[home.slot as usize]
    }

    #[inline(always)]
    pub(super) fn direct_mut(&mut self, home: Home) -> &mut Aside {
        &mut self.direct[home.slot as usize]
    }

    /// A row that sleeps.
    pub(super) fn asleep(&self, home: Home) -> Option<Aside> {
        self.aside(home).filter(|_| home.colour == ASLEEP)
    }

    #[inline]
    pub(super) fn lane(&self, kind: Kind, home: Home) -> Lane {
        let (block, at) = (home.slot as usize / 4, home.slot as usize % 4);
        if let Some(shelf) = self.shelf(home) {
            return shelf[home.slot as usize].lane;
        }
        of_kind!((&) self, kind, colours => colours.blocks[home.colour as usize][block].lane(at))
    }

    #[inline]
    pub(super) fn set_lane(&mut self, kind: Kind, home: Home, lane: &Lane) {
        let (block, at) = (home.slot as usize / 4, home.slot as usize % 4);
        if let Some(shelf) = self.shelf_mut(home) {
            shelf[home.slot as usize].lane = *lane;
            self.has_changed = true;
            return;
        }
        of_kind!((&mut) self, kind, colours => colours.blocks[home.colour as usize][block].set_lane(at, lane));
    }

    /// The pair of a row has another number now.
    pub(super) fn set_pair(&mut self, kind: Kind, home: Home, pair: u32) {
        let (block, at) = (home.slot as usize / 4, home.slot as usize % 4);
        if let Some(shelf) = self.shelf_mut(home) {
            shelf[home.slot as usize].lane.pair = pair;
            return;
        }
        of_kind!((&mut) self, kind, colours => colours.blocks[home.colour as usize][block].pairs()[at] = pair);
    }

    #[inline]
    pub(super) fn set_separations(&mut self, kind: Kind, home: Home, separations: [f32; 2]) {
        let (block, at) = (home.slot as usize / 4, home.slot as usize % 4);
        if let Some(shelf) = self.shelf_mut(home) {
            let points = &mut shelf[home.slot as usize].lane.points;
            points.iter_mut().zip(separations).for_each(|(point, separation)| point.separation = separation);
            return;
        }
        of_kind!((&mut) self, kind, colours => {
            let row = &mut colours.blocks[home.colour as usize][block];
            for (point, separation) in row.points().iter_mut().zip(separations) {
                set(&mut point.separation, at, separation);
            }
        });
    }
}
