//! Ground probe: the highest floor below the footprint of a character within its limits.

use farseer_core::{Body, Geom};

use super::capsule_ground::CapsuleRest;
use super::character_footprint::CharacterFootprint;
use crate::projection::to_world;
use crate::shapes::{SlantedBox, WalkableTop};
use crate::{ContactTarget, GeomId, Platform, TwoHalfPhysicsSimulator, Vector2, Vector3};

/// Inset, in px, of the depths near the front and back end at which a box is probed, so that rounding does not put these depths
/// outside of the box.
const BOX_END_INSET: f32 = 1e-3;

/// Margin of the early X test, px. Coordinates up to 2^23 px are rounded by at most half of this margin.
const SPAN_ROUNDING: f32 = 1.0;

#[derive(Debug, Clone, Copy)]
pub(super) struct GroundHit {
    pub(super) partner: ContactTarget,
    pub(super) height: f32,
    /// Upward component of the unit normal of the floor; dimensionless, 0..=1.
    pub(super) up: f32,
    /// Height of the edge that supports a hemisphere, px, Y up; `None` if a face supports it or the sole is flat.
    pub(super) edge: Option<f32>,
    /// Slope of the floor: height gained per px along X and along Z; dimensionless.
    pub(super) slope: [f32; 2],
}

impl GroundHit {
    fn under_soles(partner: ContactTarget, (height, up): (f32, f32)) -> Self {
        GroundHit { partner, height, up, edge: None, slope: [0.0; 2] }
    }

    fn under_ball(partner: ContactTarget, CapsuleRest { height, normal, edge }: CapsuleRest) -> Self {
        let slope = [-normal.x / normal.y, -normal.z / normal.y];
        GroundHit { partner, height, up: normal.y, edge, slope }
    }

    /// Height in px by which a hemisphere lies lower on a slope than a flat sole of the same radius.
    pub(super) fn sole_offset(&self, radius: f32) -> f32 {
        if self.edge.is_some() {
            return 0.0;
        }
        let level = (1.0 - self.up * self.up).max(0.0).sqrt();
        radius * (1.0 - (1.0 - level) / self.up)
    }

    /// Returns the height of the supporting plane after a displacement of the character, px, Y up.
    pub(super) fn height_along(&self, way: Vector3) -> f32 {
        self.height + self.slope[0] * way.x + self.slope[1] * way.z
    }
}

/// Limits of a ground probe. It finds floors up to the height `highest` in px, with an upward normal component of at least
/// `min_up`, and not the target `but`.
#[derive(Debug, Clone, Copy)]
pub(super) struct ProbeLimits<'a> {
    pub(super) tops: &'a [WalkableTop],
    pub(super) geom: GeomId,
    pub(super) highest: f32,
    pub(super) min_up: f32,
    pub(super) but: Option<ContactTarget>,
    /// Targets that the event handler has refused to the character; these do not support it.
    pub(super) refused: &'a [ContactTarget],
    /// Height in px up to which an edge supports a hemisphere, also one whose centre is past it.
    pub(super) edges: f32,
}

impl ProbeLimits<'_> {
    fn has(&self, floor: &GroundHit) -> bool {
        let holds = floor.up >= self.min_up || floor.edge.is_some_and(|edge| edge <= self.edges);
        floor.height <= self.highest
            && holds
            && self.but != Some(floor.partner)
            && !self.refused.contains(&floor.partner)
    }
}

impl TwoHalfPhysicsSimulator {
    /// Returns the highest floor below the footprint within the limits of the probe; `None` if there is no floor.
    pub(super) fn probe_ground(
        &self,
        footprint: &CharacterFootprint,
        reach: &ProbeLimits<'_>,
    ) -> Option<GroundHit> {
        let ground = GroundHit::under_soles(ContactTarget::Ground, (0.0, 1.0));
        let settings = self.core.geom(reach.geom)?;
        let floors = [ground].into_iter().chain(self.platforms_below(footprint, reach, &settings));
        let floors = floors.chain(geoms_below(footprint, reach));
        floors
            .filter(|floor| reach.has(floor))
            .reduce(|highest, floor| if floor.height > highest.height { floor } else { highest })
    }

    fn platforms_below<'a>(
        &'a self,
        footprint: &'a CharacterFootprint,
        reach: &ProbeLimits<'_>,
        settings: &'a Geom,
    ) -> impl Iterator<Item = GroundHit> + 'a {
        let low = Vector3::new(footprint.left, -reach.highest, footprint.front);
        let high = Vector3::new(footprint.right, f32::MAX, footprint.back);
        let near = self.world.platforms.overlapping(low, high);
        near.filter(|(_, platform)| holds(platform, Some(settings))).filter_map(|(id, platform)| {
            let (partner, shape) = (ContactTarget::Platform(id), platform.shape());
            match footprint.ball() {
                Some(ball) => Some(GroundHit::under_ball(partner, ball.on_box(shape)?)),
                None => Some(GroundHit::under_soles(partner, top_of_box(shape, footprint)?)),
            }
        })
    }

    /// Returns the height of the target `partner` below the footprint with a flat sole, px, Y up; `None` if no part of the
    /// target lies below the footprint.
    pub(super) fn height_of(
        &self,
        partner: ContactTarget,
        footprint: &CharacterFootprint,
        reach: &ProbeLimits<'_>,
    ) -> Option<f32> {
        let top = match partner {
            ContactTarget::Ground => Some((0.0, 1.0)),
            ContactTarget::Platform(id) => top_of_box(self.platform(id)?.shape(), footprint),
            ContactTarget::Geom(geom) => {
                highest(reach.tops.iter().filter(|top| top.geom == geom), footprint, reach.min_up)
            }
        };
        top.map(|(height, _)| height)
    }

    /// Appends the walkable edges of geoms within the depth range of the footprint `around` to `tops`.
    pub(super) fn gather_tops(
        &self,
        geoms: &[GeomId],
        around: &CharacterFootprint,
        tops: &mut Vec<WalkableTop>,
    ) {
        tops.clear();
        for &geom in geoms {
            self.for_each_top(geom, [around.front, around.back], |top| tops.push(top));
        }
    }

    /// Velocity of a floor at a place of the world, px/s, Y up, including its surface velocity.
    pub(super) fn velocity_of(&self, partner: ContactTarget, place: Vector3) -> Vector3 {
        match partner {
            ContactTarget::Ground => Vector3::zeros(),
            ContactTarget::Platform(id) => self.platform(id).map_or(Vector3::zeros(), |platform| {
                platform.velocity_at(place) + platform.world_surface_velocity()
            }),
            ContactTarget::Geom(geom) => self.core.geom(geom).map_or(Vector3::zeros(), |geom| {
                let velocity_at =
                    |body: &Body| body.get_velocity_at_world_point(Vector2::new(place.x, -place.y));
                let plane = self.core.body(geom.body()).map_or(Vector2::zeros(), velocity_at);
                let z = self.world.depths.bodies.get(geom.body()).map_or(0.0, |state| state.velocity_z);
                Vector3::new(plane.x, -plane.y, z) * self.time_scale(geom.body())
            }),
        }
    }
}

/// Returns the contact target as seen by one geom of the contact; `None` if the geom is not part of the contact.
pub(super) fn partner_of(touch: &farseer_core::depth::DepthContact, geom: GeomId) -> Option<ContactTarget> {
    let partner = crate::views::partner_of(touch.target);
    match partner {
        ContactTarget::Geom(other) if other == geom => Some(ContactTarget::Geom(touch.this)),
        _ if touch.this == geom => Some(partner),
        _ => None,
    }
}

/// Returns whether a platform exerts contact impulses on a geom.
pub(super) fn holds(platform: &Platform, geom: Option<&Geom>) -> bool {
    platform.collision_response_enabled()
        && geom.is_some_and(|geom| platform.filter().may_meet(&geom.filter()))
}

/// Iterates over the floors that are prisms: one hit per edge for a flat sole, one hit per geom for a hemisphere.
fn geoms_below<'a>(
    footprint: &'a CharacterFootprint,
    reach: &ProbeLimits<'a>,
) -> impl Iterator<Item = GroundHit> + 'a {
    let (tops, ball) = (reach.tops, footprint.ball());
    let by_edges = tops.iter().filter(move |_| ball.is_none()).filter_map(move |top| {
        Some(GroundHit::under_soles(ContactTarget::Geom(top.geom), top_of_edge(top, footprint)?))
    });
    let as_whole = ball.into_iter().flat_map(move |ball| {
        let by_geoms = tops.chunk_by(|one, other| one.geom == other.geom);
        by_geoms.filter_map(move |tops| {
            Some(GroundHit::under_ball(ContactTarget::Geom(tops[0].geom), ball.on_tops(tops)?))
        })
    });
    by_edges.chain(as_whole)
}

/// The highest walkable edge above the footprint: height in px and upward normal component. A steep edge ends
/// at the height where the flat one begins, so steep edges are left out.
fn highest<'a>(
    tops: impl Iterator<Item = &'a WalkableTop>,
    footprint: &CharacterFootprint,
    min_up: f32,
) -> Option<(f32, f32)> {
    let flat = tops.filter_map(|top| top_of_edge(top, footprint)).filter(|(_, up)| *up >= min_up);
    flat.reduce(|highest, top| if top.0 > highest.0 { top } else { highest })
}

/// Highest point of an edge above the footprint: height in px and upward normal component.
fn top_of_edge(top: &WalkableTop, footprint: &CharacterFootprint) -> Option<(f32, f32)> {
    let [a, b] = top.edge;
    // Early out: most edges lie beside the footprint.
    if b.x >= footprint.right + SPAN_ROUNDING || a.x <= footprint.left - SPAN_ROUNDING {
        return None;
    }
    let [left, right] = footprint.span(top.front, top.back)?;
    let way = b - a;
    if b.x.max(left) >= a.x.min(right) {
        return None;
    }
    if let Some((upright, place)) = &top.upright {
        return crate::depth::upright::with_foot(upright, |foot| footprint.meets(foot, *place))
            .then_some((-a.y, 1.0));
    }
    let [left, right] = footprint.whole().span(top.front, top.back)?;
    let y_at = |x: f32| a.y + way.y * ((x - a.x) / way.x);
    let y = y_at(b.x.max(left)).min(y_at(a.x.min(right)));
    Some((-y, -way.x / way.norm()))
}

/// Highest point of a platform above the footprint: height in px and upward normal component.
pub(super) fn top_of_box(shape: &SlantedBox, footprint: &CharacterFootprint) -> Option<(f32, f32)> {
    if footprint.round.is_some() || shape.climb != 0.0 || shape.is_turned() {
        footprint.roof(shape)?;
        return footprint.whole().roof(shape);
    }
    let [width, height, depth] = shape.half;
    let (front, back) =
        (footprint.front.max(shape.centre.z - depth), footprint.back.min(shape.centre.z + depth));
    if front >= back {
        return None;
    }
    let reach = width * shape.cos.abs() + height * shape.sin.abs();
    // The corner on top, before the shear.
    let ridge = -width * shape.sin.signum() * shape.cos + height * shape.cos.signum() * shape.sin;
    let mut highest: Option<(f32, f32)> = None;
    for z in candidate_depths(shape, footprint, reach, [front, back]) {
        let middle = shape.centre.x + shape.shear * (z - shape.centre.z);
        let (low, high) = (middle - reach + BOX_END_INSET, middle + reach - BOX_END_INSET);
        if footprint.left.max(low) >= footprint.right.min(high) {
            continue;
        }
        let whole = footprint.whole();
        let (left, right) = (whole.left.max(low), whole.right.min(high));
        for x in [left, right, (middle + ridge).clamp(left, right)] {
            let top = shape.height_at(x, z).map(|(y, normal)| (-y, to_world(normal).y));
            // Two faces meet at the ridge; the flatter one counts.
            let flattest = shape.cos.abs().max(shape.sin.abs());
            let top = top.map(|(y, up)| (y, if x == middle + ridge { flattest } else { up }));
            highest = top.filter(|top| highest.is_none_or(|highest| top.0 > highest.0)).or(highest);
        }
    }
    highest
}

/// Iterates over the Z, in px, at which the top of a sheared box can be highest within the footprint. These are both ends of
/// the common depth range, and the places where edges of the box cross sides of the footprint.
fn candidate_depths(
    shape: &SlantedBox,
    footprint: &CharacterFootprint,
    reach: f32,
    [front, back]: [f32; 2],
) -> impl Iterator<Item = f32> {
    let (front, back) = (front + BOX_END_INSET, (back - BOX_END_INSET).max(front + BOX_END_INSET));
    let shear = shape.shear;
    let centre = shape.centre;
    let crossings = [footprint.left, footprint.right]
        .map(|side| [-reach, reach].map(|edge| (side - centre.x - edge) / shear + centre.z));
    let crossings = crossings.into_iter().flatten().filter(move |_| shear != 0.0);
    [front, back].into_iter().chain(crossings.map(move |z| z.clamp(front, back)))
}
