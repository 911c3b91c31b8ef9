//! Rows of contacts: they stay where they are from step to step, four side by side, in colours: no two rows of a colour
//! share a body that can be pushed, so that their order does not matter. The last colour takes what finds no other, one
//! row in each block, and is solved in order.

use super::space::{IS_THERE, SpaceRow};
use super::tuning::Learning;
use crate::storage::reusing_clone::reusing_clone;
use wide::f32x4;

/// Number of colours; the last is for what finds no other.
pub(super) const COLOURS: usize = 32;
const LAST: u32 = COLOURS as u32 - 1;

/// The first of these colours, by bits, or the last of all.
fn first_of(colours: u32) -> u32 {
    colours.trailing_zeros().min(LAST)
}

/// The colours of a set, by bits, in order.
#[inline(always)]
fn colours_of(mut set: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let colour = set.trailing_zeros();
        set &= set.wrapping_sub(1);
        (colour < u32::BITS).then_some(colour as usize)
    })
}

/// One contact point of four rows.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Point {
    /// Arms of the normal about the bodies' origins: r x n.
    pub(super) arm_a: f32x4,
    pub(super) arm_b: f32x4,
    /// What one unit of velocity along the normal weighs.
    pub(super) mass: f32x4,
    /// Impulse of a substep, 0 or more.
    pub(super) impulse: f32x4,
    /// Distance of the outlines, kept up while the bodies move.
    pub(super) separation: f32x4,
    /// The impulse at which the contact's spring rests: what it has learnt of its load.
    pub(super) held: f32x4,
}

impl Point {
    #[inline(always)]
    pub(super) fn arms(&self) -> [f32x4; 2] {
        [self.arm_a, self.arm_b]
    }
}

/// Four contacts with at most `P` points each.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row<const P: usize> {
    pub(super) a: [u32; 4],
    pub(super) b: [u32; 4],
    pub(super) pair: [u32; 4],
    pub(super) normal_x: f32x4,
    pub(super) normal_y: f32x4,
    pub(super) inverse_mass_a: f32x4,
    pub(super) inverse_mass_b: f32x4,
    pub(super) inverse_inertia_a: f32x4,
    pub(super) inverse_inertia_b: f32x4,
    /// One friction row for both points, in their middle, along (normal y, -normal x).
    pub(super) friction: f32x4,
    pub(super) tangent_arm_a: f32x4,
    pub(super) tangent_arm_b: f32x4,
    pub(super) tangent_mass: f32x4,
    pub(super) tangent_impulse: f32x4,
    /// Speed of B against A along the tangent that friction aims at: belts.
    pub(super) tangent_speed: f32x4,
    pub(super) restitution: f32x4,
    /// Velocities along the normal and separations when the step began, and whether a point has pushed since: what
    /// restitution asks for.
    pub(super) approach: [f32x4; P],
    pub(super) gap: [f32x4; P],
    pub(super) has_pushed: [f32x4; P],
    pub(super) points: [Point; P],
}

impl<const P: usize> Default for Row<P> {
    fn default() -> Self {
        Row {
            a: [0; 4],
            b: [0; 4],
            pair: [0; 4],
            normal_x: f32x4::ZERO,
            normal_y: f32x4::ZERO,
            inverse_mass_a: f32x4::ZERO,
            inverse_mass_b: f32x4::ZERO,
            inverse_inertia_a: f32x4::ZERO,
            inverse_inertia_b: f32x4::ZERO,
            friction: f32x4::ZERO,
            tangent_arm_a: f32x4::ZERO,
            tangent_arm_b: f32x4::ZERO,
            tangent_mass: f32x4::ZERO,
            tangent_impulse: f32x4::ZERO,
            tangent_speed: f32x4::ZERO,
            restitution: f32x4::ZERO,
            approach: [f32x4::ZERO; P],
            gap: [f32x4::ZERO; P],
            has_pushed: [f32x4::ZERO; P],
            points: [Point::default(); P],
        }
    }
}

/// Four rows side by side, of whatever kind.
pub(super) trait Block: Copy + Default {
    fn lane(&self, at: usize) -> Lane;
    fn set_lane(&mut self, at: usize, lane: &Lane);
    fn pairs(&mut self) -> &mut [u32; 4];
    fn points(&mut self) -> &mut [Point];
}

/// Four contacts as the passes see them: in the plane, or in three axes.
pub(super) trait Contacts<const P: usize>: Block {
    /// Whether the bodies move along the depth axis as well.
    const IN_SPACE: bool;

    fn row(&self) -> &Row<P>;
    fn row_mut(&mut self) -> &mut Row<P>;
    /// Part of the normal along the depth axis.
    fn normal_z(&self) -> f32x4;
}

impl<const P: usize> Contacts<P> for Row<P> {
    const IN_SPACE: bool = false;

    #[inline(always)]
    fn row(&self) -> &Row<P> {
        self
    }

    #[inline(always)]
    fn row_mut(&mut self) -> &mut Row<P> {
        self
    }

    #[inline(always)]
    fn normal_z(&self) -> f32x4 {
        f32x4::ZERO
    }
}

/// One contact point.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct PointLane {
    pub(super) arm_a: f32,
    pub(super) arm_b: f32,
    pub(super) mass: f32,
    pub(super) impulse: f32,
    pub(super) separation: f32,
    pub(super) held: f32,
}

/// One row.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Lane {
    pub(super) a: u32,
    pub(super) b: u32,
    pub(super) pair: u32,
    pub(super) normal: [f32; 2],
    pub(super) inverse_masses: [f32; 2],
    pub(super) inverse_inertias: [f32; 2],
    pub(super) friction: f32,
    pub(super) tangent_arms: [f32; 2],
    pub(super) tangent_mass: f32,
    pub(super) tangent_impulse: f32,
    pub(super) tangent_speed: f32,
    pub(super) restitution: f32,
    pub(super) points: [PointLane; 2],
    pub(super) space: SpaceLane,
}

/// What a row in three axes has beside that.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct SpaceLane {
    pub(super) normal_z: f32,
    /// Arms about the depth axis of the second tangent.
    pub(super) across_arms: [f32; 2],
    /// Radii of balls; 0 for what is none.
    pub(super) radii: [f32; 2],
    pub(super) across_impulse: f32,
    pub(super) across_speed: f32,
    /// How far from the middle of the contact its pressure is, where that is a face along the depth axis; else 0.
    pub(super) spread: f32,
    pub(super) twist_impulse: f32,
    /// Impulses of the whole step: of the points, and of both tangents.
    pub(super) totals: [f32; 4],
}

impl Lane {
    /// Whether the springs of its points are on their way to rest at more of their load.
    pub(super) fn is_learning(&self, learning: &Learning) -> bool {
        let [one, two] = &self.points;
        let deepest = one.separation.min(two.separation);
        learning.learnt * (one.impulse + two.impulse) > one.held + two.held
            && deepest < 0.0
            && deepest > learning.deepest
    }
}

#[inline(always)]
pub(super) fn get(of: &f32x4, lane: usize) -> f32 {
    of.as_array()[lane]
}

#[inline(always)]
pub(super) fn set(of: &mut f32x4, lane: usize, value: f32) {
    of.as_mut_array()[lane] = value;
}

/// The points of one of four rows.
#[inline(always)]
pub(super) fn points_at<const P: usize>(points: &[Point; P], at: usize) -> [PointLane; 2] {
    let mut lanes = [PointLane::default(); 2];
    for (lane, point) in lanes.iter_mut().zip(points) {
        *lane = PointLane {
            arm_a: get(&point.arm_a, at),
            arm_b: get(&point.arm_b, at),
            mass: get(&point.mass, at),
            impulse: get(&point.impulse, at),
            separation: get(&point.separation, at),
            held: get(&point.held, at),
        };
    }
    lanes
}

#[inline(always)]
pub(super) fn set_points_at<const P: usize>(points: &mut [Point; P], at: usize, lanes: &[PointLane; 2]) {
    for (point, from) in points.iter_mut().zip(lanes) {
        set(&mut point.arm_a, at, from.arm_a);
        set(&mut point.arm_b, at, from.arm_b);
        set(&mut point.mass, at, from.mass);
        set(&mut point.impulse, at, from.impulse);
        set(&mut point.separation, at, from.separation);
        set(&mut point.held, at, from.held);
    }
}

impl<const P: usize> Block for Row<P> {
    fn lane(&self, at: usize) -> Lane {
        Lane {
            a: self.a[at],
            b: self.b[at],
            pair: self.pair[at],
            normal: [get(&self.normal_x, at), get(&self.normal_y, at)],
            inverse_masses: [get(&self.inverse_mass_a, at), get(&self.inverse_mass_b, at)],
            inverse_inertias: [get(&self.inverse_inertia_a, at), get(&self.inverse_inertia_b, at)],
            friction: get(&self.friction, at),
            tangent_arms: [get(&self.tangent_arm_a, at), get(&self.tangent_arm_b, at)],
            tangent_mass: get(&self.tangent_mass, at),
            tangent_impulse: get(&self.tangent_impulse, at),
            tangent_speed: get(&self.tangent_speed, at),
            restitution: get(&self.restitution, at),
            points: points_at(&self.points, at),
            space: SpaceLane::default(),
        }
    }

    fn set_lane(&mut self, at: usize, lane: &Lane) {
        (self.a[at], self.b[at], self.pair[at]) = (lane.a, lane.b, lane.pair);
        set(&mut self.normal_x, at, lane.normal[0]);
        set(&mut self.normal_y, at, lane.normal[1]);
        set(&mut self.inverse_mass_a, at, lane.inverse_masses[0]);
        set(&mut self.inverse_mass_b, at, lane.inverse_masses[1]);
        set(&mut self.inverse_inertia_a, at, lane.inverse_inertias[0]);
        set(&mut self.inverse_inertia_b, at, lane.inverse_inertias[1]);
        set(&mut self.friction, at, lane.friction);
        set(&mut self.tangent_arm_a, at, lane.tangent_arms[0]);
        set(&mut self.tangent_arm_b, at, lane.tangent_arms[1]);
        set(&mut self.tangent_mass, at, lane.tangent_mass);
        set(&mut self.tangent_impulse, at, lane.tangent_impulse);
        set(&mut self.tangent_speed, at, lane.tangent_speed);
        set(&mut self.restitution, at, lane.restitution);
        set_points_at(&mut self.points, at, &lane.points);
    }

    fn pairs(&mut self) -> &mut [u32; 4] {
        &mut self.pair
    }

    fn points(&mut self) -> &mut [Point] {
        &mut self.points
    }
}

/// The rows of one kind.
#[derive(Debug)]
pub(super) struct Colours<R> {
    /// Which colours have rows, by bits.
    pub(super) used: u32,
    pub(super) blocks: [Vec<R>; COLOURS],
    counts: [usize; COLOURS],
}

reusing_clone! { [R: Clone] Colours<R> { used, blocks, counts } }

impl<R> Default for Colours<R> {
    fn default() -> Self {
        Colours { used: 0, blocks: std::array::from_fn(|_| Vec::new()), counts: [0; COLOURS] }
    }
}

impl<R: Block> Colours<R> {
    fn clear(&mut self) {
        self.used = 0;
        self.counts = [0; COLOURS];
        self.blocks.iter_mut().for_each(Vec::clear);
    }

    /// The first of these colours in whose last block there is room, else the first.
    fn choose(&self, free: u32) -> u32 {
        let has_room =
            |&colour: &u32| free >> colour & 1 == 1 && !self.counts[colour as usize].is_multiple_of(4);
        (0..LAST).find(has_room).unwrap_or(first_of(free))
    }

    fn push(&mut self, colour: u32, lane: &Lane) -> u32 {
        let blocks = &mut self.blocks[colour as usize];
        let count = &mut self.counts[colour as usize];
        let slot = if colour == LAST { blocks.len() * 4 } else { *count };
        if slot % 4 == 0 {
            blocks.push(R::default());
        }
        blocks[slot / 4].set_lane(slot % 4, lane);
        *count += 1;
        self.used |= 1 << colour;
        slot as u32
    }

    /// Takes a row out, and tells the pairs whose rows have another slot now.
    fn remove(&mut self, colour: u32, slot: u32, mut moved: impl FnMut(u32, u32)) {
        let slot = slot as usize;
        if colour == LAST {
            self.remove_of_last(slot / 4, moved);
        } else if let Some(pair) = self.swap_out(colour, slot) {
            moved(pair, slot as u32);
        }
        self.counts[colour as usize] -= 1;
        if self.counts[colour as usize] == 0 {
            self.used &= !(1 << colour);
        }
    }

    /// Of the last colour: the others keep their order.
    fn remove_of_last(&mut self, block: usize, mut moved: impl FnMut(u32, u32)) {
        let blocks = &mut self.blocks[LAST as usize];
        blocks.remove(block);
        for (at, row) in blocks.iter_mut().enumerate().skip(block) {
            moved(row.pairs()[0], at as u32 * 4);
        }
    }

    /// The last row of a colour takes the place of another one. Answers its pair.
    fn swap_out(&mut self, colour: u32, slot: usize) -> Option<u32> {
        let blocks = &mut self.blocks[colour as usize];
        let last = self.counts[colour as usize] - 1;
        let moved = (slot != last).then(|| blocks[last / 4].lane(last % 4));
        if let Some(lane) = &moved {
            blocks[slot / 4].set_lane(slot % 4, lane);
        }
        if last.is_multiple_of(4) {
            blocks.pop();
        } else {
            blocks[last / 4].set_lane(last % 4, &Lane::default());
        }
        moved.map(|lane| lane.pair)
    }

    /// The blocks of the colours that are used, in order.
    #[inline(always)]
    pub(super) fn for_each(&mut self, mut act: impl FnMut(&mut R)) {
        colours_of(self.used).for_each(|colour| self.blocks[colour].iter_mut().for_each(&mut act));
    }

    fn count(&self) -> usize {
        colours_of(self.used).map(|colour| self.counts[colour]).sum()
    }
}

/// What a row is between: two bodies that can be pushed, or one and something that does not give way, which then is A.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Kind {
    /// In three axes: neither of the two is a ball.
    pub(super) has_two_points: bool,
    pub(super) is_fixed: bool,
    pub(super) is_in_space: bool,
}

impl Kind {
    fn is_in_space(self) -> bool {
        IS_THERE && self.is_in_space
    }
}

/// Where a row lives: in a colour, or aside, [asleep](ASLEEP) or [solved with its island](DIRECT).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Home {
    pub(super) colour: u32,
    pub(super) slot: u32,
}

/// In place of a colour: the row is of bodies that sleep; or of an island that is solved as a whole.
const ASLEEP: u32 = u32::MAX;
const DIRECT: u32 = u32::MAX - 1;

impl Home {
    /// Whether the order of its colour's rows matters.
    pub(super) fn is_in_order(self) -> bool {
        self.colour == LAST
    }

    /// Whether the row is solved with its island.
    pub(super) fn is_direct(self) -> bool {
        self.colour == DIRECT
    }
}

/// A row that no pass looks at.
#[derive(Debug, Clone, Copy)]
pub(super) struct Aside {
    pub(super) lane: Lane,
    /// Which it goes back to.
    pub(super) colour: u32,
    /// Seconds of the substeps that its impulses are of.
    pub(super) h: f32,
    /// The impulses of points and friction as they were found last, if their rounded values still are those of the row.
    pub(super) exact: [f64; 3],
}

/// All rows of contacts.
#[derive(Debug, Default)]
pub(super) struct Rows {
    asleep: Vec<Aside>,
    direct: Vec<Aside>,
    pub(super) two: Colours<Row<2>>,
    pub(super) one: Colours<Row<1>>,
    pub(super) two_fixed: Colours<Row<2>>,
    pub(super) one_fixed: Colours<Row<1>>,
    pub(super) space: SpaceRows,
    /// Pairs whose rows have moved home: empty but for a moment.
    moved: Vec<(u32, Home)>,
}

reusing_clone! { Rows { asleep, direct, two, one, two_fixed, one_fixed, space, moved } }

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

/// The rows of a kind, borrowed as it says.
macro_rules! of_kind {
    (($($borrow:tt)+) $rows:expr, $kind:expr, $colours:ident => $act:expr) => {
        match ($kind.has_two_points, $kind.is_fixed) {
            (true, false) if $kind.is_in_space() => {
                let $colours = $($borrow)+ $rows.space.prisms;
                $act
            }
            (false, false) if $kind.is_in_space() => {
                let $colours = $($borrow)+ $rows.space.balls;
                $act
            }
            (true, true) if $kind.is_in_space() => {
                let $colours = $($borrow)+ $rows.space.prisms_fixed;
                $act
            }
            (false, true) if $kind.is_in_space() => {
                let $colours = $($borrow)+ $rows.space.balls_fixed;
                $act
            }
            (true, false) => {
                let $colours = $($borrow)+ $rows.two;
                $act
            }
            (false, false) => {
                let $colours = $($borrow)+ $rows.one;
                $act
            }
            (true, true) => {
                let $colours = $($borrow)+ $rows.two_fixed;
                $act
            }
            (false, true) => {
                let $colours = $($borrow)+ $rows.one_fixed;
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
    pub(super) fn all_direct(&mut self) -> &mut [Aside] {
        &mut self.direct
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

impl Aside {
    /// Impulses of points and friction.
    #[inline(always)]
    pub(super) fn impulses(&self) -> [f64; 3] {
        let [one, two] = &self.lane.points;
        let rounded = [one.impulse, two.impulse, self.lane.tangent_impulse];
        let exact = |row: usize| self.exact[row] as f32 == rounded[row];
        std::array::from_fn(|row| if exact(row) { self.exact[row] } else { f64::from(rounded[row]) })
    }

    /// Impulses are forces times the length of a substep.
    fn scale(&mut self, h: f32) {
        let factor = if h == self.h { 1.0 } else { h / self.h };
        let scale = |impulse: &mut f32| {
            *impulse *= factor;
            *impulse = if impulse.is_finite() { *impulse } else { 0.0 };
        };
        scale(&mut self.lane.tangent_impulse);
        for point in &mut self.lane.points {
            [&mut point.impulse, &mut point.held].into_iter().for_each(scale);
        }
    }
}

/// Which colours are taken at each body, by bits: among rows of two bodies, and among those with something fixed. The last
/// colour is never taken, and what cannot be pushed takes none: rows that share it do not disturb each other.
#[derive(Debug, Default)]
pub(super) struct Palette {
    shared: Vec<u32>,
    fixed: Vec<u32>,
    /// Whether a body can be pushed.
    gives_way: Vec<bool>,
}

reusing_clone! { Palette { shared, fixed, gives_way } }

impl Palette {
    /// For bodies with these reciprocals of mass and inertia.
    pub(super) fn reset(&mut self, inverses: &[[f32; 2]]) {
        for taken in [&mut self.shared, &mut self.fixed] {
            taken.clear();
            taken.resize(inverses.len(), 0);
        }
        self.gives_way.clear();
        self.gives_way.extend(inverses.iter().map(|&inverses| inverses != [0.0; 2]));
    }

    /// A body has come, with these reciprocals of mass and inertia.
    pub(super) fn add(&mut self, body: usize, inverses: [f32; 2]) {
        self.gives_way[body] = inverses != [0.0; 2];
    }

    /// A body has gone, and its rows.
    pub(super) fn forget(&mut self, body: usize) {
        (self.shared[body], self.fixed[body], self.gives_way[body]) = (0, 0, false);
    }

    fn of(&mut self, kind: Kind) -> &mut [u32] {
        if kind.is_fixed { &mut self.fixed } else { &mut self.shared }
    }

    /// The colours that are free at both bodies, by bits.
    pub(super) fn free(&mut self, kind: Kind, bodies: [u32; 2]) -> u32 {
        let taken = self.of(kind);
        !bodies.iter().fold(0, |both, &body| both | taken[body as usize])
    }

    /// This colour, unless a damaged save says that it is taken already: then the first free one.
    pub(super) fn again(&mut self, kind: Kind, bodies: [u32; 2], colour: u32) -> u32 {
        let is_taken = bodies.iter().any(|&body| self.of(kind)[body as usize] >> colour & 1 == 1);
        if is_taken { first_of(self.free(kind, bodies)) } else { colour }
    }

    /// A row with this colour begins or ends.
    pub(super) fn mark(&mut self, kind: Kind, bodies: [u32; 2], colour: u32, is_taken: bool) {
        for body in bodies.into_iter().filter(|_| colour != LAST) {
            let bit = if self.gives_way[body as usize] { 1 << colour } else { 0 };
            let colours = &mut self.of(kind)[body as usize];
            *colours = if is_taken { *colours | bit } else { *colours & !bit };
        }
    }

    /// Whether a body has no row, but for those of the last colour.
    #[inline(always)]
    pub(super) fn is_free(&self, body: usize) -> bool {
        self.shared[body] | self.fixed[body] == 0
    }

    /// Whether a body has one row at most, but for those of the last colour.
    #[inline(always)]
    pub(super) fn is_single(&self, body: usize) -> bool {
        let (shared, fixed) = (self.shared[body], self.fixed[body]);
        (shared & shared.wrapping_sub(1)) | (fixed & fixed.wrapping_sub(1)) == 0
            && (shared == 0 || fixed == 0)
    }
}

#[cfg(test)]
mod tests {
    use super::{Colours, Kind, Lane, Palette, Row};

    #[test]
    fn a_new_row_fills_a_block_before_it_begins_another() {
        let mut colours = Colours::<Row<1>>::default();
        for colour in [0, 0, 0, 0, 1] {
            colours.push(colour, &Lane::default());
        }
        assert_eq!(colours.choose(!0), 1);
        assert_eq!(colours.choose(!2), 0);
    }

    #[test]
    fn what_cannot_be_pushed_takes_no_colour() {
        let kind = Kind { has_two_points: true, is_fixed: false, is_in_space: false };
        let mut palette = Palette::default();
        palette.reset(&[[0.0; 2], [0.0; 2], [1.0, 0.0], [1.0, 1.0]]);
        palette.mark(kind, [1, 2], 0, true);
        assert_eq!(palette.free(kind, [1, 3]), !0);
        assert_eq!(palette.free(kind, [1, 2]), !1);
        assert!(palette.is_free(1) && palette.is_single(2) && !palette.is_free(2));
    }
}
