//! Geoms of simple shapes (behaviour chapter 13, section 3).

use crate::body::BodyId;
use crate::geom::GeomId;
use crate::geom::outline::Outline;
use crate::math::Vector2;
use crate::math::finite::{finite_vector, positive};
use crate::object_id::ObjectId;
use crate::objects::{GeomPlacement, Objects};
use crate::shape::Vertices;
use crate::{Error, Result};

/// Makes geoms of simple shapes. All lengths are in the user's unit; y points down on the screen.
///
/// Every method refuses a stale body, and all arguments that [`Objects::create_geom`] refuses.
#[doc(alias = "GeomFactory.Instance")]
#[derive(Debug, Clone, Copy)]
pub struct GeomFactory;

impl GeomFactory {
    /// A rectangle of 16 vertices, each side divided in four.
    ///
    /// # Errors
    /// A width or height that is not finite and greater than 0.
    #[doc(alias = "CreateRectangleGeom")]
    pub fn create_rectangle_geom(
        simulator: &mut Objects,
        body: BodyId,
        width: f32,
        height: f32,
        placement: GeomPlacement,
    ) -> Result<GeomId> {
        positive("width", width)?;
        positive("height", height)?;
        simulator.create_geom(body, Vertices::create_rectangle(width, height)?, placement)
    }

    /// An ellipse as a polygon.
    ///
    /// # Errors
    /// A radius that is not finite and greater than 0; fewer than 3 edges, for which the original fails as well.
    #[doc(alias = "CreateEllipseGeom")]
    pub fn create_ellipse_geom(
        simulator: &mut Objects,
        body: BodyId,
        x_radius: f32,
        y_radius: f32,
        number_of_edges: i32,
        placement: GeomPlacement,
    ) -> Result<GeomId> {
        positive("x_radius", x_radius)?;
        positive("y_radius", y_radius)?;
        check_edges(number_of_edges)?;
        simulator.create_geom(body, Vertices::create_ellipse(x_radius, y_radius, number_of_edges)?, placement)
    }

    /// A circle as a regular polygon, with a circle as its [outline](crate::GeomRef::outline).
    ///
    /// # Errors
    /// A radius that is not finite and greater than 0; fewer than 3 edges, for which the original fails as well.
    #[doc(alias = "CreateCircleGeom")]
    pub fn create_circle_geom(
        simulator: &mut Objects,
        body: BodyId,
        radius: f32,
        number_of_edges: i32,
        placement: GeomPlacement,
    ) -> Result<GeomId> {
        positive("radius", radius)?;
        check_edges(number_of_edges)?;
        let corners = Vertices::create_circle(radius, number_of_edges)?;
        simulator.create_geom_of(body, (corners, Outline::Circle { radius }), placement)
    }

    /// An upright capsule: two half discs with straight sides between them, along y. It is a polygon of `2 * edges + 2`
    /// corners, with a capsule as its [outline](crate::GeomRef::outline). The faithful methods and all queries and
    /// views use the polygon, the [precise](crate::Methods::Precise) ones the true capsule, whatever the number of
    /// edges.
    ///
    /// `height` is from tip to tip, and each of its ends, of radius `end_radius`, has `edges` edges, as with
    /// [`Vertices::create_capsule`]. Ours: the original has that outline and no factory for it.
    ///
    /// ```
    /// use farseer_core::{BodyFactory, GeomFactory, GeomPlacement, Outline, PhysicsSimulator};
    /// let mut simulator = PhysicsSimulator::default();
    /// let hero = BodyFactory::create_capsule_body_in(&mut simulator, 60.0, 12.0, 1.0)?;
    /// let placement = GeomPlacement::default();
    /// let geom = GeomFactory::create_capsule_geom_in(&mut simulator, hero, 60.0, 12.0, 8, placement)?;
    /// assert_eq!(simulator.geom(geom).unwrap().outline(), Outline::Capsule { height: 60.0, end_radius: 12.0 });
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// A height or radius that is not finite and greater than 0; a radius that is not less than half of the height; no edges,
    /// or too many.
    pub fn create_capsule_geom(
        simulator: &mut Objects,
        body: BodyId,
        height: f32,
        end_radius: f32,
        edges: i32,
        placement: GeomPlacement,
    ) -> Result<GeomId> {
        let corners = Vertices::create_capsule(height, end_radius, edges)?;
        simulator.create_geom_of(body, (corners, Outline::Capsule { height, end_radius }), placement)
    }

    /// A chain of edges between points, for terrain: it has edges and no inside, and each edge is solid on one side.
    /// Shapes that slide along it do not catch on the points between two edges. Ours, and only with the [precise
    /// methods](crate::Methods::Precise).
    ///
    /// The solid side is on the right hand of somebody who walks along the points, on a screen with y down. So points
    /// from left to right make a floor, points from right to left a ceiling. If the last point is the first one again
    /// the chain is closed: clockwise it is a rock, anticlockwise a room.
    ///
    /// Shapes from the solid side pass through. Once the middle of a shape is on the free side, contacts push it out
    /// there. A shape that is pushed in so far that its middle is behind an edge falls through. An open end behaves as
    /// the edge of a table for shapes that lean on it or roll over it.
    ///
    /// Points are in the geom's coordinates, and are neither recentred nor reordered; the placement's cell size has no
    /// effect. Thousands of points are as good as a few: only edges near other shapes cost time. A chain has no inside,
    /// so it contains no point, and its body is static. If the body is made dynamic later, its chains remain, but do
    /// not collide with other chains.
    ///
    /// ```
    /// use farseer_core::{Body, GeomFactory, GeomPlacement, Methods, PhysicsSimulator, math::Vector2};
    /// let mut simulator = PhysicsSimulator::default();
    /// simulator.set_methods(Methods::PRECISE)?;
    /// let ground = simulator.create_body(Body::new());
    /// simulator[ground].set_is_static(true);
    /// let hill = |i: u16| Vector2::new(f32::from(i) * 16.0, (f32::from(i) * 0.1).sin() * 40.0);
    /// let hills: Vec<Vector2> = (0..1000).map(hill).collect();
    /// GeomFactory::create_chain_geom_in(&mut simulator, ground, &hills, GeomPlacement::default())?;
    /// # Ok::<(), farseer_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// Fewer than two points, or three of a closed chain; a point that is not finite, or the same as that before it; a body
    /// that is not static; [`Error::NotSupported`] under the faithful methods.
    pub fn create_chain_geom(
        simulator: &mut Objects,
        body: BodyId,
        points: &[Vector2],
        placement: GeomPlacement,
    ) -> Result<GeomId> {
        let (points, is_closed) = check_chain(points)?;
        simulator.create_geom_of(body, (Vertices::from(points), Outline::Chain { is_closed }), placement)
    }

    /// A polygon, recentred on its centroid.
    ///
    /// As in the original the caller's list is left recentred and in the engine's winding. Make the body from it first:
    /// this positions the body at the centroid.
    ///
    /// # Errors
    /// An outline without area or not finite. The list is unchanged then.
    #[doc(alias = "CreatePolygonGeom")]
    pub fn create_polygon_geom(
        simulator: &mut Objects,
        body: BodyId,
        vertices: &mut Vertices,
        placement: GeomPlacement,
    ) -> Result<GeomId> {
        let centroid = centroid_of(vertices)?;
        let mut centred = vertices.clone();
        centred.translate(Vector2::new(-centroid.x, -centroid.y));
        centred.force_counter_clockwise_order();
        let geom = simulator.create_geom(body, centred.clone(), placement)?;
        *vertices = centred;
        Ok(geom)
    }

    /// A polygon cut into at most `max_geoms` convex geoms, for SAT. Pieces beyond that number are lost.
    ///
    /// The pieces have offsets that put the outline's centroid at the body's origin; their distance grids, if any, have
    /// cells of 1. An outline of which no triangle can be cut gives an empty list. The time of the cutting grows with
    /// the square of the number of vertices: [`simplify`](Vertices::simplify) long outlines first.
    ///
    /// # Errors
    /// All arguments that [`Vertices::decompose`] refuses. No geom is made then.
    #[doc(alias("CreateSATPolygonGeom", "DecomposeGeom"))]
    pub fn create_sat_polygon_geom(
        simulator: &mut Objects,
        body: BodyId,
        vertices: &Vertices,
        max_geoms: i32,
    ) -> Result<Vec<GeomId>> {
        simulator.body(body).ok_or(Error::StaleId { argument: "body" })?;
        let pieces = vertices.decompose(max_geoms)?;
        if pieces.is_empty() {
            return Ok(Vec::new());
        }
        let centroid = centroid_of(vertices)?;
        let placement = GeomPlacement {
            offset: Vector2::new(-centroid.x, -centroid.y),
            collision_grid_size: 1.0,
            ..GeomPlacement::default()
        };
        let mut geoms = Vec::with_capacity(pieces.len());
        for piece in pieces {
            match simulator.create_geom(body, piece, placement) {
                Ok(geom) => geoms.push(geom),
                Err(error) => {
                    simulator.discard(geoms.into_iter().map(ObjectId::from));
                    return Err(error);
                }
            }
        }
        Ok(geoms)
    }

    /// [`create_sat_polygon_geom`](Self::create_sat_polygon_geom), added to the simulator.
    ///
    /// # Errors
    /// As the plain method.
    pub fn create_sat_polygon_geom_in(
        simulator: &mut Objects,
        body: BodyId,
        vertices: &Vertices,
        max_geoms: i32,
    ) -> Result<Vec<GeomId>> {
        let geoms = Self::create_sat_polygon_geom(simulator, body, vertices, max_geoms)?;
        for &geom in &geoms {
            simulator.add(geom)?;
        }
        Ok(geoms)
    }

    /// A copy of a geom on a body, at the same offsets; see [`Objects::clone_geom`].
    ///
    /// # Errors
    /// A stale id; a geom without a distance grid, if the distance grid is selected.
    #[doc(alias = "CreateGeom")]
    pub fn create_geom_from(simulator: &mut Objects, body: BodyId, geom: GeomId) -> Result<GeomId> {
        simulator.clone_geom(body, geom)
    }

    /// A copy of a geom on a body, at other offsets.
    ///
    /// # Errors
    /// As [`create_geom_from`](Self::create_geom_from); offsets that are not finite.
    #[doc(alias = "CreateGeom")]
    pub fn create_geom_from_with_offset(
        simulator: &mut Objects,
        body: BodyId,
        geom: GeomId,
        offset: Vector2,
        rotation_offset: f32,
    ) -> Result<GeomId> {
        simulator.clone_geom_with_offset(body, geom, offset, rotation_offset)
    }
}

/// Methods that also add the geom to the simulator.
impl GeomFactory {
    added! {
        create_rectangle_geom_in = create_rectangle_geom(body: BodyId, width: f32, height: f32, placement: GeomPlacement) -> GeomId;
        create_ellipse_geom_in = create_ellipse_geom(body: BodyId, x_radius: f32, y_radius: f32, number_of_edges: i32, placement: GeomPlacement) -> GeomId;
        create_circle_geom_in = create_circle_geom(body: BodyId, radius: f32, number_of_edges: i32, placement: GeomPlacement) -> GeomId;
        create_capsule_geom_in = create_capsule_geom(body: BodyId, height: f32, end_radius: f32, edges: i32, placement: GeomPlacement) -> GeomId;
        create_chain_geom_in = create_chain_geom(body: BodyId, points: &[Vector2], placement: GeomPlacement) -> GeomId;
        create_polygon_geom_in = create_polygon_geom(body: BodyId, vertices: &mut Vertices, placement: GeomPlacement) -> GeomId;
        create_geom_from_in = create_geom_from(body: BodyId, geom: GeomId) -> GeomId;
        create_geom_from_with_offset_in = create_geom_from_with_offset(body: BodyId, geom: GeomId, offset: Vector2, rotation_offset: f32) -> GeomId;
    }
}

fn centroid_of(vertices: &Vertices) -> Result<Vector2> {
    finite_vector("vertices", vertices.get_centroid())
        .map_err(|_| Error::invalid("vertices", vertices, "an outline with an area"))
}

/// The points of a chain without the last one if it equals the first, and whether it does.
pub(crate) fn check_chain(points: &[Vector2]) -> Result<(&[Vector2], bool)> {
    for &point in points {
        finite_vector("points", point)?;
    }
    if let Some(twice) = points.windows(2).find(|edge| edge[0] == edge[1]) {
        return Err(Error::invalid("points", twice[1], "another point than the one before it"));
    }
    match points {
        [first, between @ .., last] if first == last => {
            if between.len() < 2 {
                return Err(Error::invalid(
                    "points",
                    points,
                    "three points or more, if the last is the first",
                ));
            }
            Ok((&points[..points.len() - 1], true))
        }
        [_, _, ..] => Ok((points, false)),
        _ => Err(Error::invalid("points", points, "two points or more")),
    }
}

fn check_edges(number_of_edges: i32) -> Result<()> {
    if number_of_edges < 3 {
        return Err(Error::invalid("number_of_edges", number_of_edges, "3 or more"));
    }
    Ok(())
}
