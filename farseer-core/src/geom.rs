//! Shapes attached to bodies (behaviour chapter 05, section 3).

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::bits::Floats;
use crate::body::BodyId;
use crate::contact::Feature;
use crate::math::vector2::{distance, dot, length, transform, transform_normal};
use crate::math::{Matrix, Vector2, scalar};
use crate::methods::CollisionCategory;
use crate::narrow_phase::distance_grid::DistanceGrid;
use crate::shape::{Aabb, Vertices};

crate::arena::define_id! {
    /// Names a geom of a simulator.
    GeomId
}

/// How a geom collides: everything about it that may be changed freely. `simulator[geom]` is this;
/// [`PhysicsSimulator::geom`](crate::PhysicsSimulator::geom) shows the shape and place as well.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Geom {
    pub(crate) collision_categories: CollisionCategory,
    pub(crate) collides_with: CollisionCategory,
    pub(crate) collision_group: i32,
    pub(crate) friction_coefficient: f32,
    pub(crate) restitution_coefficient: f32,
    pub(crate) collision_enabled: bool,
    pub(crate) collision_response_enabled: bool,
    tag: u64,
    /// Arguments refused since the simulator last looked.
    #[serde(skip)]
    pub(crate) rejected: Vec<&'static str>,
}

impl Default for Geom {
    fn default() -> Self {
        Geom {
            collision_categories: CollisionCategory::ALL,
            collides_with: CollisionCategory::ALL,
            collision_group: 0,
            friction_coefficient: 0.0,
            restitution_coefficient: 0.0,
            collision_enabled: true,
            collision_response_enabled: true,
            tag: 0,
            rejected: Vec::new(),
        }
    }
}

impl Geom {
    /// The categories the geom belongs to. Default all.
    #[doc(alias = "CollisionCategories")]
    pub fn collision_categories(&self) -> CollisionCategory {
        self.collision_categories
    }

    /// Sets the categories the geom belongs to.
    pub fn set_collision_categories(&mut self, value: CollisionCategory) {
        self.collision_categories = value;
    }

    /// The categories the geom collides with. Two geoms collide if **either** one's mask meets the other's
    /// categories. Default all.
    #[doc(alias = "CollidesWith")]
    pub fn collides_with(&self) -> CollisionCategory {
        self.collides_with
    }

    /// Sets the categories the geom collides with.
    pub fn set_collides_with(&mut self, value: CollisionCategory) {
        self.collides_with = value;
    }

    /// Geoms of the same group do not collide; 0 is no group. Default 0.
    #[doc(alias = "CollisionGroup")]
    pub fn collision_group(&self) -> i32 {
        self.collision_group
    }

    /// Sets the group.
    pub fn set_collision_group(&mut self, value: i32) {
        self.collision_group = value;
    }

    /// Friction, combined with the partner's when the two begin to overlap. Default 0.
    #[doc(alias = "FrictionCoefficient")]
    pub fn friction_coefficient(&self) -> f32 {
        self.friction_coefficient
    }

    /// Sets the friction of contacts that begin later. What is not finite is rejected.
    pub fn set_friction_coefficient(&mut self, value: f32) {
        if value.is_finite() {
            self.friction_coefficient = value;
        } else {
            self.rejected.push("friction_coefficient");
        }
    }

    /// Bounciness, usually 0 to 1; the mean of both partners acts. Default 0.
    #[doc(alias = "RestitutionCoefficient")]
    pub fn restitution_coefficient(&self) -> f32 {
        self.restitution_coefficient
    }

    /// Sets the bounciness. What is not finite is rejected.
    pub fn set_restitution_coefficient(&mut self, value: f32) {
        if value.is_finite() {
            self.restitution_coefficient = value;
        } else {
            self.rejected.push("restitution_coefficient");
        }
    }

    /// Whether new pairs with this geom are looked for. Default true.
    #[doc(alias = "CollisionEnabled")]
    pub fn collision_enabled(&self) -> bool {
        self.collision_enabled
    }

    /// Switches the search for new pairs. Geoms that already touch go on touching until they separate.
    pub fn set_collision_enabled(&mut self, value: bool) {
        self.collision_enabled = value;
    }

    /// Whether contacts exert impulses; they are reported either way. Default true.
    #[doc(alias = "CollisionResponseEnabled")]
    pub fn collision_response_enabled(&self) -> bool {
        self.collision_response_enabled
    }

    /// Switches the impulses of this geom's contacts.
    pub fn set_collision_response_enabled(&mut self, value: bool) {
        self.collision_response_enabled = value;
    }

    /// A number for the user's own purposes. Default 0.
    #[doc(alias = "Tag")]
    pub fn tag(&self) -> u64 {
        self.tag
    }

    /// Sets the user's number.
    pub fn set_tag(&mut self, value: u64) {
        self.tag = value;
    }
}

/// The part of a 4x4 matrix that matters in the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PlaneMatrix {
    pub(crate) m11: f32,
    pub(crate) m12: f32,
    pub(crate) m21: f32,
    pub(crate) m22: f32,
    pub(crate) m41: f32,
    pub(crate) m42: f32,
}

impl PlaneMatrix {
    pub(crate) const IDENTITY: Self =
        PlaneMatrix { m11: 1.0, m12: 0.0, m21: 0.0, m22: 1.0, m41: 0.0, m42: 0.0 };

    #[inline(always)]
    pub(crate) fn apply(&self, p: Vector2) -> Vector2 {
        Vector2::new(p.x * self.m11 + p.y * self.m21 + self.m41, p.x * self.m12 + p.y * self.m22 + self.m42)
    }

    #[inline(always)]
    pub(crate) fn apply_normal(&self, n: Vector2) -> Vector2 {
        Vector2::new(n.x * self.m11 + n.y * self.m21, n.x * self.m12 + n.y * self.m22)
    }

    /// Inverse of a rotation with translation. Equal to the general 4x4 inverse in all bits but the sign of
    /// exact zeros, which no comparison of the engine can tell apart (behaviour chapter 05, section 3.7).
    #[inline]
    fn inverse(&self) -> Self {
        let k = 1.0 / (self.m11 * self.m22 + self.m12 * -self.m21);
        PlaneMatrix {
            m11: self.m22 * k,
            m12: -self.m12 * k,
            m21: -self.m21 * k,
            m22: self.m11 * k,
            m41: -(self.m21 * -self.m42 - self.m22 * -self.m41) * k,
            m42: (self.m11 * -self.m42 - self.m12 * -self.m41) * k,
        }
    }

    fn from_matrix(matrix: &Matrix) -> Self {
        PlaneMatrix {
            m11: matrix.m11,
            m12: matrix.m12,
            m21: matrix.m21,
            m22: matrix.m22,
            m41: matrix.m41,
            m42: matrix.m42,
        }
    }

    fn to_matrix(self) -> Matrix {
        #[rustfmt::skip]
        let matrix = Matrix::new(
            self.m11, self.m12, 0.0, 0.0,
            self.m21, self.m22, 0.0, 0.0,
            0.0,      0.0,      1.0, 0.0,
            self.m41, self.m42, 0.0, 1.0,
        );
        matrix
    }
}

/// A geom's place in the world, as its body's pose gives it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct GeomPose {
    pub(crate) matrix: PlaneMatrix,
    pub(crate) inverse: PlaneMatrix,
    pub(crate) position: Vector2,
    pub(crate) rotation: f32,
}

impl GeomPose {
    const IDENTITY: Self = GeomPose {
        matrix: PlaneMatrix::IDENTITY,
        inverse: PlaneMatrix::IDENTITY,
        position: Vector2::new(0.0, 0.0),
        rotation: 0.0,
    };

    /// Behaviour chapter 05, section 3.6.
    #[inline]
    fn of_body(position: Vector2, rotation: f32, offset: Vector2, rotation_offset: f32) -> Self {
        let angle = rotation + rotation_offset;
        let (s, c) = scalar::sin_cos(angle);
        let mut matrix = PlaneMatrix { m11: c, m12: s, m21: -s, m22: c, m41: 0.0, m42: 0.0 };
        let offset = matrix.apply(offset);
        matrix.m41 = position.x + offset.x;
        matrix.m42 = position.y + offset.y;
        GeomPose {
            matrix,
            inverse: matrix.inverse(),
            position: Vector2::new(matrix.m41, matrix.m42),
            rotation: angle,
        }
    }
}

impl Floats for GeomPose {
    fn to_floats(&self) -> Vec<f32> {
        let GeomPose { matrix: m, inverse: i, position, rotation } = *self;
        let [m, i] = [m, i].map(|m| [m.m11, m.m12, m.m21, m.m22, m.m41, m.m42]);
        [&m[..], &i[..], &[position.x, position.y, rotation]].concat()
    }

    fn from_floats(floats: &[f32]) -> Option<Self> {
        let matrix = |from: usize| {
            let [m11, m12, m21, m22, m41, m42] = <[f32; 6]>::try_from(floats.get(from..from + 6)?).ok()?;
            Some(PlaneMatrix { m11, m12, m21, m22, m41, m42 })
        };
        let (matrix, inverse) = (matrix(0)?, matrix(6)?);
        let [x, y, rotation] = <[f32; 3]>::try_from(floats.get(12..)?).ok()?;
        Some(GeomPose { matrix, inverse, position: Vector2::new(x, y), rotation })
    }
}

/// What the simulator keeps of a geom.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct GeomEntry {
    pub(crate) geom: Geom,
    /// Creation number, never reused: decides which geom of a pair is A, and enters contact ids.
    pub(crate) number: u32,
    /// Index in the geom list at the start of the current update; stale in between, as in the original.
    pub(crate) collision_id: i32,
    pub(crate) body: BodyId,
    pub(crate) offset: Vector2,
    pub(crate) rotation_offset: f32,
    pub(crate) grid_cell_size: f32,
    pub(crate) local_vertices: Vertices,
    #[serde(with = "crate::bits")]
    pub(crate) world_vertices: Vertices,
    #[serde(with = "crate::bits")]
    pub(crate) aabb: Aabb,
    #[serde(with = "crate::bits")]
    pub(crate) pose: GeomPose,
    /// A matrix set by the user, until the body moves next.
    user_matrix: Option<Box<Matrix>>,
    /// Vertices or matrix were set since the body last moved: the next update from the body is due even if
    /// the body's pose is unchanged.
    pub(crate) refresh_is_due: bool,
    #[serde(with = "crate::narrow_phase::distance_grid::as_outline")]
    pub(crate) grid: Option<Arc<DistanceGrid>>,
    pub(crate) in_simulation: bool,
    pub(crate) is_sensor: bool,
    pub(crate) is_disposed: bool,
    pub(crate) is_listed: bool,
    pub(crate) is_queued: bool,
    /// It was lent out for editing since the simulator last looked.
    pub(crate) is_touched: bool,
    /// Creation numbers of other geoms and whether collision with them is ignored.
    ignored: Vec<(u32, bool)>,
}

impl GeomEntry {
    pub(crate) fn new(number: u32, body: BodyId, offset: Vector2, rotation_offset: f32) -> Self {
        GeomEntry {
            geom: Geom::default(),
            number,
            collision_id: 0,
            body,
            offset,
            rotation_offset,
            grid_cell_size: 0.0,
            local_vertices: Vertices::default(),
            world_vertices: Vertices::default(),
            aabb: Aabb::default(),
            pose: GeomPose::IDENTITY,
            user_matrix: None,
            refresh_is_due: false,
            grid: None,
            in_simulation: true,
            is_sensor: false,
            is_disposed: false,
            is_listed: false,
            is_queued: false,
            is_touched: false,
            ignored: Vec::new(),
        }
    }

    /// Takes the outline over. Until the body moves next, world vertices and box are the local ones.
    pub(crate) fn set_vertices(&mut self, mut vertices: Vertices) {
        vertices.force_counter_clockwise_order();
        self.world_vertices.clone_from(&vertices);
        self.local_vertices = vertices;
        self.aabb = Aabb::from_vertices(&self.local_vertices);
        self.refresh_is_due = true;
    }

    /// Follows the body: matrix, world vertices and box.
    pub(crate) fn follow(&mut self, position: Vector2, rotation: f32) {
        self.pose = GeomPose::of_body(position, rotation, self.offset, self.rotation_offset);
        self.user_matrix = None;
        self.refresh_is_due = false;
        self.refresh();
    }

    /// Replaces the matrix until the body moves next. Position and rotation stay, as in the original.
    pub(crate) fn set_matrix(&mut self, matrix: &Matrix) {
        self.pose.matrix = PlaneMatrix::from_matrix(matrix);
        self.pose.inverse = PlaneMatrix::from_matrix(&crate::math::matrix::invert(matrix));
        self.user_matrix = Some(Box::new(*matrix));
        self.refresh_is_due = true;
        self.refresh();
    }

    fn refresh(&mut self) {
        let matrix = self.pose.matrix;
        for (world, &local) in self.world_vertices.iter_mut().zip(self.local_vertices.iter()) {
            *world = matrix.apply(local);
        }
        self.aabb = Aabb::from_vertices(&self.world_vertices);
    }

    pub(crate) fn ignores(&self, number: u32) -> bool {
        self.ignored.iter().any(|&(other, ignored)| other == number && ignored)
    }

    pub(crate) fn set_ignored(&mut self, number: u32, ignored: bool) {
        match self.ignored.iter_mut().find(|(other, _)| *other == number) {
            Some(entry) => entry.1 = ignored,
            None if ignored => self.ignored.push((number, true)),
            None => {}
        }
    }

    /// Whether everything that enters arithmetic is finite: false only after loading garbage.
    pub(crate) fn is_valid(&self) -> bool {
        let finite = |v: &Vector2| v.x.is_finite() && v.y.is_finite();
        !self.local_vertices.is_empty()
            && self.local_vertices.len() == self.world_vertices.len()
            && self.local_vertices.iter().all(finite)
            && finite(&self.offset)
            && self.rotation_offset.is_finite()
            && self.geom.friction_coefficient.is_finite()
            && self.geom.restitution_coefficient.is_finite()
    }
}

/// A geom as it lies in the world: shape, place and settings.
#[derive(Debug, Clone, Copy)]
#[doc(alias = "Geom")]
pub struct GeomRef<'a> {
    pub(crate) entry: &'a GeomEntry,
    /// Position and rotation of the body if it was moved and the geom has not followed yet.
    pub(crate) pending: Option<(Vector2, f32)>,
}

impl std::ops::Deref for GeomRef<'_> {
    type Target = Geom;
    fn deref(&self) -> &Geom {
        &self.entry.geom
    }
}

impl<'a> GeomRef<'a> {
    fn pose(&self) -> GeomPose {
        match self.pending {
            None => self.entry.pose,
            Some((position, rotation)) => {
                GeomPose::of_body(position, rotation, self.entry.offset, self.entry.rotation_offset)
            }
        }
    }

    /// Creation number, counted from 0 per simulator and never reused. Of two geoms that touch, the one with
    /// the smaller number is A.
    #[doc(alias = "Id")]
    pub fn id(&self) -> u32 {
        self.entry.number
    }

    /// Index in the geom list at the start of the last update.
    #[doc(alias = "CollisionId")]
    pub fn collision_id(&self) -> i32 {
        self.entry.collision_id
    }

    /// The body it is attached to.
    #[doc(alias = "Body")]
    pub fn body(&self) -> BodyId {
        self.entry.body
    }

    /// False after removal from the simulation, until it is added again.
    #[doc(alias = "InSimulation")]
    pub fn in_simulation(&self) -> bool {
        self.entry.in_simulation
    }

    /// Whether the geom was last made a sensor.
    #[doc(alias = "IsSensor")]
    pub fn is_sensor(&self) -> bool {
        self.entry.is_sensor
    }

    /// Whether it was disposed and goes at the next update.
    #[doc(alias = "IsDisposed")]
    pub fn is_disposed(&self) -> bool {
        self.entry.is_disposed
    }

    /// Edge of a distance grid cell in the user's length unit; what was asked for under SAT.
    #[doc(alias = "GridCellSize")]
    pub fn grid_cell_size(&self) -> f32 {
        self.entry.grid_cell_size
    }

    /// The distance grid, if there is one.
    #[doc(alias = "DistanceGridData")]
    pub fn distance_grid(&self) -> Option<&'a DistanceGrid> {
        self.entry.grid.as_deref()
    }

    /// The outline in the geom's own coordinates, in the engine's winding.
    #[doc(alias = "LocalVertices")]
    pub fn local_vertices(&self) -> &'a Vertices {
        &self.entry.local_vertices
    }

    /// The outline in the world.
    #[doc(alias = "WorldVertices")]
    pub fn world_vertices(&self) -> std::borrow::Cow<'a, Vertices> {
        match self.pending {
            None => std::borrow::Cow::Borrowed(&self.entry.world_vertices),
            Some(_) => {
                let matrix = self.pose().matrix;
                std::borrow::Cow::Owned(self.entry.local_vertices.iter().map(|&v| matrix.apply(v)).collect())
            }
        }
    }

    /// The box around the outline in the world.
    #[doc(alias = "AABB")]
    pub fn aabb(&self) -> Aabb {
        match self.pending {
            None => self.entry.aabb,
            Some(_) => Aabb::from_vertices(&self.world_vertices()),
        }
    }

    /// World position of the geom's origin.
    #[doc(alias = "Position")]
    pub fn position(&self) -> Vector2 {
        self.pose().position
    }

    /// The body's rotation plus the rotation offset, in radians.
    #[doc(alias = "Rotation")]
    pub fn rotation(&self) -> f32 {
        self.pose().rotation
    }

    /// From the geom's own coordinates to the world.
    #[doc(alias = "Matrix")]
    pub fn matrix(&self) -> Matrix {
        match (&self.entry.user_matrix, self.pending) {
            (Some(matrix), None) => **matrix,
            _ => self.pose().matrix.to_matrix(),
        }
    }

    /// From the world to the geom's own coordinates.
    #[doc(alias = "MatrixInverse")]
    pub fn matrix_inverse(&self) -> Matrix {
        crate::math::matrix::invert(&self.matrix())
    }

    /// World position of a point in the geom's coordinates.
    #[doc(alias = "GetWorldPosition")]
    pub fn get_world_position(&self, local: Vector2) -> Vector2 {
        transform(local, &self.matrix())
    }

    /// Position in the geom's coordinates of a point of the world.
    #[doc(alias = "TransformToLocalCoordinates")]
    pub fn transform_to_local_coordinates(&self, world: Vector2) -> Vector2 {
        transform(world, &self.matrix_inverse())
    }

    /// A direction in the geom's coordinates, turned into the world.
    #[doc(alias = "TransformNormalToWorld")]
    pub fn transform_normal_to_world(&self, normal: Vector2) -> Vector2 {
        transform_normal(normal, &self.matrix())
    }

    /// Whether collision with the geom of this creation number is ignored from this side.
    #[doc(alias = "IsGeometryIgnored")]
    pub fn is_geometry_ignored(&self, other: GeomRef<'_>) -> bool {
        self.entry.ignores(other.id())
    }

    /// Signed distance to the outline of a point in the geom's coordinates, negative inside.
    #[doc(alias = "GetNearestDistance")]
    pub fn get_nearest_distance(&self, point: Vector2) -> f32 {
        nearest_distance(&self.entry.local_vertices, point)
    }

    /// The nearest point of edge `index` to a point in the geom's coordinates.
    ///
    /// # Panics
    /// If there is no edge `index`, as slices do.
    #[doc(alias = "GetNearestFeature")]
    pub fn get_nearest_feature(&self, point: Vector2, index: usize) -> Feature {
        nearest_feature(&self.entry.local_vertices, point, index)
    }
}

/// Distance of a point to edge `index` (behaviour chapter 05, section 3.9).
fn distance_to_edge(vertices: &Vertices, point: Vector2, index: usize) -> f32 {
    let edge = vertices.get_edge(index);
    let d = point - vertices[index];
    let c1 = dot(d, edge);
    if c1 < 0.0 {
        return length(d);
    }
    let c2 = dot(edge, edge);
    if c2 <= c1 {
        return distance(point, vertices[vertices.next_index(index)]);
    }
    distance(point, vertices[index] + edge * (c1 / c2))
}

fn nearest_feature(vertices: &Vertices, point: Vector2, index: usize) -> Feature {
    let edge = vertices.get_edge(index);
    let c1 = dot(point - vertices[index], edge);
    let (position, normal) = if c1 < 0.0 {
        (vertices[index], vertices.get_vertex_normal(index))
    } else {
        let c2 = dot(edge, edge);
        if c2 <= c1 {
            let next = vertices.next_index(index);
            (vertices[next], vertices.get_vertex_normal(next))
        } else {
            (vertices[index] + edge * (c1 / c2), vertices.get_edge_normal(index))
        }
    };
    Feature { position, normal, distance: length(point - position) }
}

/// Signed distance of a point to an outline of at least one vertex, both in the same coordinates.
pub(crate) fn nearest_distance(vertices: &Vertices, point: Vector2) -> f32 {
    let mut best = f32::MAX;
    let mut best_index = 0;
    for index in 0..vertices.len() {
        let d = distance_to_edge(vertices, point, index);
        if d < best {
            best = d;
            best_index = index;
        }
    }
    let feature = nearest_feature(vertices, point, best_index);
    if dot(point - feature.position, feature.normal) < 0.0 { -feature.distance } else { feature.distance }
}
