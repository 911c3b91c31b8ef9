//! Penetration depth of the shapes of a scene in px, by the same geometry for every engine.
//!
//! A circle is a true disc here. Our 2D engine represents it by a polygon within the disc. Two such polygons that touch with
//! flat sides therefore overlap here by the segments between polygon and disc. All other shapes are their convex polygons.
//! The depth is the least translation in px that separates two shapes.

pub(crate) mod depth;

use super::world::{BodyState, World, turned};
use conformance::run::Run;
use conformance::scene::{GeomShape, GeomSpec, NarrowPhase, Scene};
use depth::{Form, Point, depth};
use farseer_core::math::Vector2;

/// All shapes of a scene as convex pieces of its bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct Shapes {
    pieces: Vec<Piece>,
}

/// A convex piece of a body, in px, in the body's local coordinates about its centre of mass.
#[derive(Debug, Clone, PartialEq)]
struct Piece {
    body: usize,
    is_static: bool,
    /// Collision group: pieces with the same number do not collide; 0 is no group.
    group: i32,
    form: Form,
}

/// A piece in world coordinates, with its least and greatest x, in px.
#[derive(Debug)]
struct Placed<'a> {
    piece: &'a Piece,
    form: Form,
    left: f64,
    right: f64,
}

impl Shapes {
    /// Returns the shapes of a scene. Geoms that are copies of others are not supported.
    ///
    /// # Panics
    ///
    /// The scene cannot be built, contains a copy of a geom, or has an outline that is neither convex nor cut into convex
    /// pieces.
    pub fn of(scene: &Scene) -> Self {
        let is_disc = |geom: &GeomSpec| matches!(geom.shape, GeomShape::Circle { .. });
        let mut pieces: Vec<Piece> = scene.geoms.iter().filter_map(|geom| disc(scene, geom)).collect();
        let mut outlines = scene.clone();
        outlines.geoms.retain(|geom| !is_disc(geom));
        for geom in &mut outlines.geoms {
            assert!(!matches!(geom.shape, GeomShape::Clone { .. }), "copies of geoms are not supported");
            // Entries of `ignore` are indices of geoms, which are wrong once discs are removed.
            geom.ignore.clear();
        }
        (outlines.joints, outlines.springs, outlines.controllers) = (Vec::new(), Vec::new(), Vec::new());
        // Distance grids are not needed here and take time to create.
        outlines.simulator.narrow_phase = Some(NarrowPhase::Sat);
        let run = Run::build(&outlines).unwrap_or_else(|error| panic!("{error}"));
        pieces.extend(polygons(&run));
        Shapes { pieces }
    }

    /// Returns the depth in px of the deepest overlap of two shapes; 0 if all are separate, infinite if the state of a body
    /// is not finite. Two shapes of one body, of static bodies or of one collision group are not tested.
    pub fn largest_overlap(&self, world: &dyn World) -> f64 {
        let states: Vec<BodyState> = (0..world.body_count()).map(|index| world.body(index)).collect();
        if !states.iter().all(BodyState::is_finite) {
            return f64::INFINITY;
        }
        let mut placed: Vec<Placed<'_>> =
            self.pieces.iter().map(|piece| Placed::new(piece, &states[piece.body])).collect();
        placed.sort_by(|one, other| one.left.total_cmp(&other.left));
        let mut largest = 0.0_f64;
        for (index, one) in placed.iter().enumerate() {
            let near = placed[index + 1..].iter().take_while(|other| other.left <= one.right);
            for other in near.filter(|other| one.piece.meets(other.piece)) {
                largest = largest.max(depth(&one.form, &other.form));
            }
        }
        largest
    }
}

impl Piece {
    fn meets(&self, other: &Piece) -> bool {
        let is_grouped = self.group != 0 && self.group == other.group;
        self.body != other.body && !(self.is_static && other.is_static) && !is_grouped
    }
}

impl<'a> Placed<'a> {
    fn new(piece: &'a Piece, state: &BodyState) -> Self {
        let form = piece.form.placed(state.position_in_plane(), state.angle);
        let (left, right) = form.extent([1.0, 0.0]);
        Placed { piece, form, left, right }
    }
}

/// Returns the disc of a circle geom in coordinates of its body, in px; `None` for other geoms.
fn disc(scene: &Scene, geom: &GeomSpec) -> Option<Piece> {
    let GeomShape::Circle { radius, .. } = geom.shape else { return None };
    let offset = point(geom.offset.unwrap_or_else(Vector2::zeros));
    let turn = f64::from(geom.rotation_offset.unwrap_or(0.0));
    Some(Piece {
        body: geom.body,
        is_static: scene.bodies[geom.body].is_static == Some(true),
        group: geom.settings.collision_group.unwrap_or(0),
        // The offset turns with the geom (behaviour chapter 05).
        form: Form::Disc { centre: turned(offset, turn), radius: f64::from(radius) },
    })
}

/// Returns the outlines of all geoms as convex pieces in coordinates of their bodies, in px, with the vertices that our 2D
/// engine uses.
fn polygons(run: &Run<'_>) -> Vec<Piece> {
    let simulator = run.simulator();
    let piece = |&id| {
        let geom = simulator.geom(id).expect("nothing was disposed yet");
        let body =
            run.bodies().iter().position(|&body| body == geom.body()).expect("its body is in the scene");
        let (offset, turn) = (point(geom.offset()), f64::from(geom.rotation_offset()));
        let on_body = |&vertex: &Vector2| {
            let vertex = point(vertex);
            turned([vertex[0] + offset[0], vertex[1] + offset[1]], turn)
        };
        let form = Form::polygon(&geom.local_vertices().iter().map(on_body).collect::<Vec<_>>());
        let is_static = simulator[geom.body()].is_static();
        Piece { body, is_static, group: geom.collision_group(), form }
    };
    run.geoms().iter().map(piece).collect()
}

fn point(value: Vector2) -> Point {
    [f64::from(value.x), f64::from(value.y)]
}
