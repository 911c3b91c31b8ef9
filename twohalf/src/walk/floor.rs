//! What a figure stands on: the highest floor below its feet that it can reach.

use farseer_core::{Body, Geom};

use super::feet::Feet;
use super::rest::Rest;
use crate::projection::to_world;
use crate::shapes::{SlantedBox, Top};
use crate::{GeomId, Partner, Platform, TwoHalfPhysicsSimulator, Vector2, Vector3};

/// Ends of what is looked at are taken as far inside as this, px, where rounding cannot put them outside.
const INSIDE: f32 = 1e-3;

/// What of feet is between two depths ends no farther beside all of them than by this, px: coordinates up to 2^23 px are rounded
/// by half of it at most.
const ROUNDED: f32 = 1.0;

#[derive(Debug, Clone, Copy)]
pub(super) struct Floor {
    pub(super) partner: Partner,
    pub(super) height: f32,
    /// The upward part of its normal.
    pub(super) up: f32,
    /// How high the edge is on which a round end lies.
    pub(super) edge: Option<f32>,
    /// How that rises along X and Z.
    pub(super) slope: [f32; 2],
}

impl Floor {
    fn under_soles(partner: Partner, (height, up): (f32, f32)) -> Self {
        Floor { partner, height, up, edge: None, slope: [0.0; 2] }
    }

    fn under_ball(partner: Partner, Rest { height, normal, edge }: Rest) -> Self {
        let slope = [-normal.x / normal.y, -normal.z / normal.y];
        Floor { partner, height, up: normal.y, edge, slope }
    }

    /// How much lower a round end of a radius lies on a slope than soles as wide as that.
    pub(super) fn lower_than_soles(&self, radius: f32) -> f32 {
        if self.edge.is_some() {
            return 0.0;
        }
        let level = (1.0 - self.up * self.up).max(0.0).sqrt();
        radius * (1.0 - (1.0 - level) / self.up)
    }

    /// How high what a round end touches leads it on a way.
    pub(super) fn height_along(&self, way: Vector3) -> f32 {
        self.height + self.slope[0] * way.x + self.slope[1] * way.z
    }
}

/// Which floors can be reached: no higher than `highest`, no steeper than `least_up`, and not one of them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reach<'a> {
    pub(super) tops: &'a [Top],
    pub(super) geom: GeomId,
    pub(super) highest: f32,
    pub(super) least_up: f32,
    pub(super) but: Option<Partner>,
    /// Partners that a handler has refused hold nothing.
    pub(super) refused: &'a [Partner],
    /// An edge that is no higher than this holds a round end, however far that is past it.
    pub(super) edges: f32,
}

impl Reach<'_> {
    fn has(&self, floor: &Floor) -> bool {
        let holds = floor.up >= self.least_up || floor.edge.is_some_and(|edge| edge <= self.edges);
        floor.height <= self.highest
            && holds
            && self.but != Some(floor.partner)
            && !self.refused.contains(&floor.partner)
    }
}

impl TwoHalfPhysicsSimulator {
    /// The highest floor in reach below some feet.
    pub(super) fn floor_below(&self, feet: &Feet, reach: &Reach<'_>) -> Option<Floor> {
        let ground = Floor::under_soles(Partner::Ground, (0.0, 1.0));
        let settings = self.core.geom(reach.geom)?;
        let floors = [ground].into_iter().chain(self.platforms_below(feet, reach, &settings));
        let floors = floors.chain(geoms_below(feet, reach));
        floors
            .filter(|floor| reach.has(floor))
            .reduce(|highest, floor| if floor.height > highest.height { floor } else { highest })
    }

    fn platforms_below<'a>(
        &'a self,
        feet: &'a Feet,
        reach: &Reach<'_>,
        settings: &'a Geom,
    ) -> impl Iterator<Item = Floor> + 'a {
        let low = Vector3::new(feet.left, -reach.highest, feet.front);
        let high = Vector3::new(feet.right, f32::MAX, feet.back);
        let near = self.world.platforms.overlapping(low, high);
        near.filter(|(_, platform)| holds(platform, Some(settings))).filter_map(|(id, platform)| {
            let (partner, shape) = (Partner::Platform(id), platform.shape());
            match feet.ball() {
                Some(ball) => Some(Floor::under_ball(partner, ball.on_box(shape)?)),
                None => Some(Floor::under_soles(partner, top_of_box(shape, feet)?)),
            }
        })
    }

    /// How high a floor is below some feet, as if they were soles.
    pub(super) fn height_of(&self, partner: Partner, feet: &Feet, reach: &Reach<'_>) -> Option<f32> {
        let top = match partner {
            Partner::Ground => Some((0.0, 1.0)),
            Partner::Platform(id) => top_of_box(self.platform(id)?.shape(), feet),
            Partner::Geom(geom) => {
                highest(reach.tops.iter().filter(|top| top.geom == geom), feet, reach.least_up)
            }
        };
        top.map(|(height, _)| height)
    }

    /// What can be stood on of these, as far as it is within some depths.
    pub(super) fn gather_tops(&self, geoms: &[GeomId], around: &Feet, tops: &mut Vec<Top>) {
        tops.clear();
        for &geom in geoms {
            self.for_each_top(geom, [around.front, around.back], |top| tops.push(top));
        }
    }

    /// Velocity of a floor at a place of the world, Y up, with that of its surface.
    pub(super) fn velocity_of(&self, partner: Partner, place: Vector3) -> Vector3 {
        match partner {
            Partner::Ground => Vector3::zeros(),
            Partner::Platform(id) => self
                .platform(id)
                .map_or(Vector3::zeros(), |platform| platform.velocity_at(place) + platform.belt()),
            Partner::Geom(geom) => self.core.geom(geom).map_or(Vector3::zeros(), |geom| {
                let velocity_at =
                    |body: &Body| body.get_velocity_at_world_point(Vector2::new(place.x, -place.y));
                let plane = self.core.body(geom.body()).map_or(Vector2::zeros(), velocity_at);
                let z = self.world.depths.bodies.get(geom.body()).map_or(0.0, |state| state.velocity_z);
                Vector3::new(plane.x, -plane.y, z) * self.time_scale(geom.body())
            }),
        }
    }
}

/// The other side of a touch of a body.
pub(super) fn partner_of(touch: &farseer_core::SpaceTouch, geom: GeomId) -> Option<Partner> {
    let partner = crate::views::partner_of(touch.partner);
    match partner {
        Partner::Geom(other) if other == geom => Some(Partner::Geom(touch.this)),
        _ if touch.this == geom => Some(partner),
        _ => None,
    }
}

/// Whether a platform can hold a geom, up or back.
pub(super) fn holds(platform: &Platform, geom: Option<&Geom>) -> bool {
    platform.collision_response_enabled()
        && geom.is_some_and(|geom| platform.filter().may_meet(&geom.filter()))
}

/// Floors that are prisms: below soles once for each of their edges, below a round end as a whole.
fn geoms_below<'a>(feet: &'a Feet, reach: &Reach<'a>) -> impl Iterator<Item = Floor> + 'a {
    let (tops, ball) = (reach.tops, feet.ball());
    let by_edges = tops
        .iter()
        .filter(move |_| ball.is_none())
        .filter_map(move |top| Some(Floor::under_soles(Partner::Geom(top.geom), top_of_edge(top, feet)?)));
    let as_whole = ball.into_iter().flat_map(move |ball| {
        let by_geoms = tops.chunk_by(|one, other| one.geom == other.geom);
        by_geoms
            .filter_map(move |tops| Some(Floor::under_ball(Partner::Geom(tops[0].geom), ball.on_tops(tops)?)))
    });
    by_edges.chain(as_whole)
}

/// Height and upward part of the normal of the highest of some edges above the feet that are not too steep: what is steep ends
/// where what is flat begins, at the same height.
fn highest<'a>(tops: impl Iterator<Item = &'a Top>, feet: &Feet, least_up: f32) -> Option<(f32, f32)> {
    let flat = tops.filter_map(|top| top_of_edge(top, feet)).filter(|(_, up)| *up >= least_up);
    flat.reduce(|highest, top| if top.0 > highest.0 { top } else { highest })
}

/// Of an edge, what lies above the feet.
fn top_of_edge(top: &Top, feet: &Feet) -> Option<(f32, f32)> {
    let [a, b] = top.edge;
    // Most lie beside all of the feet.
    if b.x >= feet.right + ROUNDED || a.x <= feet.left - ROUNDED {
        return None;
    }
    let [left, right] = feet.span(top.front, top.back)?;
    let way = b - a;
    if b.x.max(left) >= a.x.min(right) {
        return None;
    }
    if let Some((upright, place)) = &top.upright {
        return crate::depth::upright::with_foot(upright, |foot| feet.meets(foot, *place))
            .then_some((-a.y, 1.0));
    }
    let [left, right] = feet.whole().span(top.front, top.back)?;
    let y_at = |x: f32| a.y + way.y * ((x - a.x) / way.x);
    let y = y_at(b.x.max(left)).min(y_at(a.x.min(right)));
    Some((-y, -way.x / way.norm()))
}

/// Height and upward part of the normal of the highest point of a platform above the feet.
pub(super) fn top_of_box(shape: &SlantedBox, feet: &Feet) -> Option<(f32, f32)> {
    if feet.round.is_some() || shape.climb != 0.0 || shape.is_turned() {
        feet.roof(shape)?;
        return feet.whole().roof(shape);
    }
    let [width, height, depth] = shape.half;
    let (front, back) = (feet.front.max(shape.centre.z - depth), feet.back.min(shape.centre.z + depth));
    if front >= back {
        return None;
    }
    let reach = width * shape.cos.abs() + height * shape.sin.abs();
    // The corner on top, before it is sheared.
    let ridge = -width * shape.sin.signum() * shape.cos + height * shape.cos.signum() * shape.sin;
    let mut highest: Option<(f32, f32)> = None;
    for z in depths_to_look_at(shape, feet, reach, [front, back]) {
        let middle = shape.centre.x + shape.shear * (z - shape.centre.z);
        let (low, high) = (middle - reach + INSIDE, middle + reach - INSIDE);
        if feet.left.max(low) >= feet.right.min(high) {
            continue;
        }
        let whole = feet.whole();
        let (left, right) = (whole.left.max(low), whole.right.min(high));
        for x in [left, right, (middle + ridge).clamp(left, right)] {
            let top = shape.height_at(x, z).map(|(y, normal)| (-y, to_world(normal).y));
            // At the ridge two faces meet, and the flatter one counts.
            let flattest = shape.cos.abs().max(shape.sin.abs());
            let top = top.map(|(y, up)| (y, if x == middle + ridge { flattest } else { up }));
            highest = top.filter(|top| highest.is_none_or(|highest| top.0 > highest.0)).or(highest);
        }
    }
    highest
}

/// Where a sheared box has corners above the feet: at their ends, and where its edges cross their sides.
fn depths_to_look_at(
    shape: &SlantedBox,
    feet: &Feet,
    reach: f32,
    [front, back]: [f32; 2],
) -> impl Iterator<Item = f32> {
    let (front, back) = (front + INSIDE, (back - INSIDE).max(front + INSIDE));
    let shear = shape.shear;
    let centre = shape.centre;
    let crossings = [feet.left, feet.right]
        .map(|side| [-reach, reach].map(|edge| (side - centre.x - edge) / shear + centre.z));
    let crossings = crossings.into_iter().flatten().filter(move |_| shear != 0.0);
    [front, back].into_iter().chain(crossings.map(move |z| z.clamp(front, back)))
}
