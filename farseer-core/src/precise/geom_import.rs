//! Adapter: makes the proxies of geoms from their properties.

use super::ids::{IdTable, owner_of};
use crate::body::{Body, BodyId};
use crate::geom::entry::GeomEntry;
use crate::geom::pieces::RecentOutlines;
use crate::geom::{Geom, GeomId};
use crate::objects::Objects;
use farseer_precise::bodies::BodySet;
use farseer_precise::broad_phase::proxies::{BodyType, Proxies, Proxy};
use farseer_precise::depth::feature_gate::FeatureGate;
use farseer_precise::depth::interface::DepthShape;
use farseer_precise::depth::state::DepthState;
use farseer_precise::fingerprint::Fingerprint;
use farseer_precise::index::{BodyIndex, DenseIndex, ProxyIndex};
use farseer_precise::math::plane::Vector;
use farseer_precise::pieces::Piece;
use farseer_precise::shape::Shape;

/// Number of shapes that [`RecentShapes`] remembers, a count. Value chosen: one for each outline that [`RecentOutlines`] remembers.
const RECENT_SHAPES: usize = 4;

/// Parts from which the proxies of geoms follow, and the lists that get them.
pub(super) struct ProxyImport<'a> {
    pub(super) ids: &'a mut IdTable,
    pub(super) bodies: &'a BodySet,
    pub(super) proxies: &'a mut Proxies,
    pub(super) depth: Option<FeatureGate<&'a DepthState>>,
    /// Whether any geom, or the ground under one, has a restitution coefficient above 0.
    pub(super) has_restitution: &'a mut bool,
    pub(super) objects: &'a Objects,
    pub(super) recent_shapes: RecentShapes<'a>,
}

/// The last few different shapes that the vertex pool got in two axes. Equal pieces at equal places on their bodies share one shape.
#[derive(Default)]
pub(super) struct RecentShapes<'a> {
    shapes: [Option<RecentShape<'a>>; RECENT_SHAPES],
    /// Index into `shapes` of the oldest one.
    oldest: usize,
}

/// A shape of the vertex pool, with the piece that it was made of.
#[derive(Clone, Copy)]
struct RecentShape<'a> {
    /// The piece; pieces of equal geoms are at the same address.
    piece: &'a Piece,
    /// Offset (x, y, length units) and rotation (radians) of the geom on its body, as bits.
    placement: [u32; 3],
    shape: Shape,
    fingerprint: u64,
}

impl<'a> RecentShapes<'a> {
    /// Returns the shape of a piece at a place on its body, with its fingerprint; `None` if it is none of the recent ones.
    fn find(&self, piece: &'a Piece, placement: [u32; 3]) -> Option<(Shape, u64)> {
        let is_it =
            |recent: &&RecentShape<'_>| std::ptr::eq(recent.piece, piece) && recent.placement == placement;
        self.shapes.iter().flatten().find(is_it).map(|recent| (recent.shape, recent.fingerprint))
    }

    /// Remembers a shape in place of the oldest one.
    fn add(&mut self, piece: &'a Piece, placement: [u32; 3], (shape, fingerprint): (Shape, u64)) {
        self.shapes[self.oldest] = Some(RecentShape { piece, placement, shape, fingerprint });
        self.oldest = (self.oldest + 1) % RECENT_SHAPES;
    }
}

impl<'a> ProxyImport<'a> {
    /// Appends the proxies of all geoms for whose body index `is_wanted` returns true.
    pub(super) fn push_all(&mut self, is_wanted: impl Fn(BodyIndex) -> bool) {
        let objects = self.objects;
        let mut recent_outlines = RecentOutlines::default();
        for at in 0..objects.geoms.list().len() {
            let Some((id, geom)) = objects.geoms.at(at) else { continue };
            if !self.ids.body_index(geom.body).is_some_and(&is_wanted) {
                continue;
            }
            recent_outlines.share_pieces(geom);
            self.ids.add_geom(id, self.proxies.next_index());
            for piece in 0..geom.pieces().len() {
                if let Some(proxy) = self.proxy(id, piece) {
                    self.proxies.push(proxy);
                }
            }
        }
    }

    /// Adds the proxies of a geom at the free positions from `place` on, or where the lists have room if that is `None`.
    pub(super) fn add(&mut self, id: GeomId, place: Option<ProxyIndex>) {
        let Some(geom) = self.objects.geoms.get(id) else { return };
        for piece in 0..geom.pieces().len() {
            let at = place.map(|first| ProxyIndex::new(first.position() + piece));
            let Some(proxy) = self.proxy(id, piece).and_then(|proxy| self.proxies.add(proxy, at)) else {
                continue;
            };
            self.ids.vacant_proxies.fill(proxy);
            if piece == 0 {
                self.ids.add_geom(id, proxy);
            }
        }
    }

    /// Returns the proxy of one convex piece of a geom in its current state; `None` if its body is not listed. Its
    /// shape is added to the vertex pool.
    fn proxy(&mut self, id: GeomId, piece: usize) -> Option<Proxy> {
        let geom = self.objects.geoms.get(id)?;
        let body = self.ids.body_index(geom.body)?;
        let body_type = match body < self.bodies.first_static() {
            false => BodyType::Fixed,
            true if self.bodies.is_kinematic(body) => BodyType::Kinematic,
            true => BodyType::Dynamic,
        };
        let [friction, restitution] = surface_coefficients(&geom.geom);
        let bounces_on_ground = self.depth.is_some_and(|space| space.shape(id.slot()).bounces_on_ground());
        // Two negative coefficients may have a positive product.
        *self.has_restitution |= restitution != 0.0 || bounces_on_ground;
        let (shape, fingerprint) = self.add_shape(id, geom, piece);
        let surface_velocity = match body_type {
            BodyType::Fixed => surface_velocity(&self.objects.bodies[geom.body].body, geom.body, self.depth),
            _ => [0.0; 4],
        };
        Some(Proxy {
            owner: owner_of(id),
            is_world: false,
            piece: piece as u32,
            list_key: self.objects.geoms.list_key(id),
            creation_number: geom.number,
            body,
            body_type,
            shape,
            fingerprint,
            friction,
            restitution,
            surface: geom.geom.surface(),
            responds: geom.geom.collision_response_enabled(),
            is_reported: geom.geom.collision_callbacks_enabled(),
            filter: geom_filter(geom),
            ignores_some: geom.ignores_some(),
            events: geom.geom.wanted_events().0,
            surface_velocity,
            one_way: one_way_direction(geom, self.depth.is_some()),
        })
    }

    /// Adds the shape of a convex piece, in the frame of its body, to the vertex pool, or finds it there. Returns the shape and its
    /// fingerprint.
    fn add_shape(&mut self, id: GeomId, geom: &'a GeomEntry, piece: usize) -> (Shape, u64) {
        let placement = ([geom.offset.x, geom.offset.y], geom.rotation_offset);
        let piece = &geom.pieces()[piece];
        let bits = [geom.offset.x, geom.offset.y, geom.rotation_offset].map(f32::to_bits);
        if let Some(known) = self.recent_shapes.find(piece, bits) {
            return known;
        }
        let shape = match self.depth.map(|space| space.shape(id.slot())) {
            Some(DepthShape { vertical: Some(upright), .. }) => {
                let ([x, y], half) = upright.front_box();
                self.proxies.vertices.add_box_at([geom.offset.x + x, geom.offset.y + y], half)
            }
            Some(DepthShape { is_sphere: true, half_depth, .. }) => {
                let circle = Piece::Circle { centre: [0.0; 2], radius: half_depth };
                self.proxies.vertices.add(&circle, placement)
            }
            _ => self.proxies.vertices.add(piece, placement),
        };
        let made = (shape, self.fingerprint_of(id, shape));
        if self.depth.is_none() {
            self.recent_shapes.add(piece, bits, made);
        }
        made
    }

    /// Returns the [fingerprint](farseer_precise::fingerprint) of a listed `shape` of a geom, with its depth shape in three axes.
    fn fingerprint_of(&self, id: GeomId, shape: Shape) -> u64 {
        let mut fingerprint = Fingerprint::default();
        fingerprint.add_outline(self.proxies.vertices.shape_ref(shape));
        if let Some(space) = self.depth {
            fingerprint.add_depth_shape(&space.shape(id.slot()));
        }
        fingerprint.bits()
    }
}

/// Returns the surface velocity of a static body, a conveyor belt if it is not 0: x, y (length units/s), angular velocity
/// (radians/s), z (length units/s).
pub(super) fn surface_velocity(body: &Body, id: BodyId, depth: Option<FeatureGate<&DepthState>>) -> [f32; 4] {
    let (velocity, spin) = (body.linear_velocity(), body.angular_velocity());
    let along_depth = depth.map_or(0.0, |space| space.body(id.slot()).velocity);
    [velocity.x, velocity.y, spin, along_depth].map(without_negative_zero)
}

/// Returns the outward direction of the solid side of a one-way geom, a unit vector in the frame of its body. `None` for all
/// other geoms, and in three axes.
pub(super) fn one_way_direction(geom: &GeomEntry, has_depth: bool) -> Option<Vector> {
    geom.one_way.filter(|_| !has_depth).map(|direction| [direction.x, direction.y])
}

/// Returns the collision filter of a geom in the form of [`Proxy::filter`].
pub(super) fn geom_filter(entry: &GeomEntry) -> [i32; 5] {
    let geom = &entry.geom;
    let (categories, collides_with) = (geom.collision_categories().bits(), geom.collides_with().bits());
    [
        categories,
        collides_with,
        geom.collision_group(),
        i32::from(geom.collision_enabled()) | i32::from(geom.both_must_agree()) << 1,
        entry.ignore_changes,
    ]
}

/// Returns the friction and the restitution coefficient of a geom, dimensionless.
pub(super) fn surface_coefficients(geom: &Geom) -> [f32; 2] {
    [geom.friction_coefficient(), geom.restitution_coefficient()].map(without_negative_zero)
}

/// Returns `value`, with +0 in place of -0. Imports copy only values that compare unequal, so both zeros must have the same
/// bits.
fn without_negative_zero(value: f32) -> f32 {
    value + 0.0
}
