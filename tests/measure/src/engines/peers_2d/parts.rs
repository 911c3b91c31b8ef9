//! Description of a scene for another engine (peer): metres, kg, s and radians, y down.

use super::links::{self, Link};
use super::state::{METRE, metres, point, square_metres};
use crate::world::turned;
use conformance::run::Run;
use conformance::scene::{BodySpec, Friction, GeomShape, GeomSpec, NarrowPhase, Scene};
use farseer_core::math::Vector2;
use farseer_core::shape::Vertices;
use farseer_core::{Body, CollisionCategory};

/// Drag coefficient, linear in kg/s and rotational, of a body without a setting for it (behaviour chapter 02).
const DEFAULT_DRAG: f32 = 0.001;

/// A scene in the units of a peer: metres, kg, s and radians.
#[derive(Debug)]
pub(super) struct Parts {
    pub(super) gravity: [f32; 2],
    /// Whether the friction of a pair is the lesser coefficient of the two shapes, not the mean.
    pub(super) takes_lesser_friction: bool,
    pub(super) bodies: Vec<BodyPart>,
    pub(super) shapes: Vec<ShapePart>,
    pub(super) links: Vec<Link>,
}

/// A body in the units of a peer. Its position is that of its centre of mass in the world, metres.
#[derive(Debug, Clone)]
pub(super) struct BodyPart {
    pub(super) is_static: bool,
    pub(super) mass: f32,
    pub(super) inertia: f32,
    pub(super) position: [f32; 2],
    /// Rotation in radians, including full turns.
    pub(super) angle: f32,
    pub(super) velocity: [f32; 2],
    pub(super) angular_velocity: f32,
    pub(super) feels_gravity: bool,
    /// Rate of linear damping in 1/s: the fraction of the velocity lost per s, for short steps.
    pub(super) linear_damping: f32,
    /// Rate of angular damping in 1/s: the fraction of the angular velocity lost per s, for short steps.
    pub(super) angular_damping: f32,
    /// Drag torque per squared angular velocity, in kg m².
    pub(super) rotational_drag: f32,
}

/// A convex shape on a body, in the units of a peer.
#[derive(Debug, Clone)]
pub(super) struct ShapePart {
    pub(super) body: usize,
    pub(super) form: Form,
    pub(super) friction: f32,
    pub(super) restitution: f32,
    /// Index of the collision group, from 0; shapes of one group do not collide. `None`: the shape is in no group.
    pub(super) group: Option<usize>,
}

/// Geometry of a shape in the body's coordinates, metres.
#[derive(Debug, Clone)]
pub(super) enum Form {
    Circle {
        centre: [f32; 2],
        radius: f32,
    },
    Rectangle {
        centre: [f32; 2],
        angle: f32,
        half_extents: [f32; 2],
    },
    /// A convex polygon: corners in order, in metres. No corner lies on a straight line with its neighbours.
    Convex(Vec<[f32; 2]>),
}

/// Converts a scene to the bodies, shapes and joints that a peer needs. An error names a feature that no peer has.
pub(super) fn parts(scene: &Scene) -> Result<Parts, String> {
    if !scene.controllers.is_empty() || !scene.paths.is_empty() {
        return Err("no controllers and no paths".to_owned());
    }
    // Geoms are checked before the scene is changed, since a sensor makes its body static.
    scene.geoms.iter().try_for_each(check)?;
    let mut plain = scene.clone();
    plain.joints.clear();
    plain.springs.clear();
    // Peers have no distance grids, so the scene is built without them.
    plain.simulator.narrow_phase = Some(NarrowPhase::Sat);
    let run = Run::build(&plain).map_err(|error| error.to_string())?;
    let bodies = run.bodies().iter().zip(&scene.bodies);
    let bodies: Result<Vec<_>, _> = bodies.map(|(&id, spec)| body(&run.simulator()[id], spec)).collect();
    let mut bodies = bodies?;
    Ok(Parts {
        gravity: scene.simulator.gravity.map_or([0.0; 2], |gravity| point(double(gravity))),
        takes_lesser_friction: scene.simulator.solver.friction_type == Some(Friction::Minimum),
        shapes: shapes(&run)?,
        links: links::links(scene, &mut bodies)?,
        bodies,
    })
}

/// Returns the vector in double precision, in the unit of `vector`.
pub(super) fn double(vector: Vector2) -> [f64; 2] {
    [vector.x, vector.y].map(f64::from)
}

/// Greatest speed in px/s that Box2D and `rapier2d` allow.
const MAX_SPEED: f64 = 12_800.0;

fn body(body: &Body, spec: &BodySpec) -> Result<BodyPart, String> {
    if !spec.in_simulation || !body.enabled() {
        return Err("no bodies that do not take part".to_owned());
    }
    let (velocity, is_static) = (double(body.linear_velocity()), body.is_static());
    if is_static && (velocity != [0.0; 2] || body.angular_velocity() != 0.0) {
        return Err("no static bodies with a velocity".to_owned());
    }
    if velocity[0].hypot(velocity[1]) > MAX_SPEED {
        return Err(format!("no speeds over {MAX_SPEED} px/s"));
    }
    if body.is_quadratic_drag_enabled() && body.quadratic_drag_coefficient() != 0.0 {
        return Err("no quadratic drag".to_owned());
    }
    let (mass, inertia) = (body.mass(), body.moment_of_inertia());
    if !(mass > 0.0 && inertia > 0.0) {
        return Err(format!("no mass of {mass} kg and moment of inertia of {inertia} kg px²"));
    }
    let rotational_drag = body.rotational_drag_coefficient();
    let has_drag = rotational_drag != DEFAULT_DRAG && !is_static;
    Ok(BodyPart {
        is_static,
        mass,
        inertia: square_metres(f64::from(inertia)),
        position: point(double(body.position())),
        angle: body.total_rotation(),
        velocity: point(velocity),
        angular_velocity: body.angular_velocity(),
        feels_gravity: !body.ignore_gravity(),
        linear_damping: body.linear_drag_coefficient() / mass,
        angular_damping: 0.0,
        rotational_drag: if has_drag { square_metres(f64::from(rotational_drag)) } else { 0.0 },
    })
}

fn shapes(run: &Run<'_>) -> Result<Vec<ShapePart>, String> {
    let specs = &run.scene().geoms;
    let mut shapes = Vec::with_capacity(specs.len());
    let mut groups: Vec<i32> = Vec::new();
    for (spec, &id) in specs.iter().zip(run.geoms()) {
        let geom = &run.simulator()[id];
        if !spec.in_simulation || !geom.collision_enabled() {
            continue;
        }
        let outline = run.simulator().geom(id).map(|geom| geom.local_vertices());
        let Some(outline) = outline else { return Err("a geom is disposed".to_owned()) };
        let group = number(geom.collision_group(), &mut groups);
        shapes.extend(forms(spec, outline)?.into_iter().map(|form| ShapePart {
            body: spec.body,
            form,
            friction: geom.friction_coefficient(),
            restitution: geom.restitution_coefficient(),
            group,
        }));
    }
    Ok(shapes)
}

/// Returns the index, from 0, of a collision group in `groups` and adds the group if it is new. `None` for group 0, which means
/// no group (behaviour chapter 05).
fn number(group: i32, groups: &mut Vec<i32>) -> Option<usize> {
    if group == 0 {
        return None;
    }
    let known = groups.iter().position(|&known| known == group);
    Some(known.unwrap_or_else(|| {
        groups.push(group);
        groups.len() - 1
    }))
}

/// Rejects settings of a geom that peers lack or treat differently.
fn check(spec: &GeomSpec) -> Result<(), String> {
    // These shapes may make more geoms than the scene has entries.
    if matches!(spec.shape, GeomShape::Decomposed { .. } | GeomShape::Clone { .. }) {
        return Err("no geoms that are copies or decompositions: name the outlines themselves".to_owned());
    }
    let settings = &spec.settings;
    let is_everything = |bits: Option<i32>| {
        bits.is_none_or(|bits| CollisionCategory::from_bits(bits) == CollisionCategory::ALL)
    };
    if !is_everything(settings.collision_categories) || !is_everything(settings.collides_with) {
        return Err("no collision categories: pairs are decided otherwise".to_owned());
    }
    if !spec.ignore.is_empty() || !spec.veto.is_empty() {
        return Err("no geoms that ignore others".to_owned());
    }
    if settings.sensor == Some(true) || settings.collision_response_enabled == Some(false) {
        return Err("no sensors".to_owned());
    }
    Ok(())
}

fn forms(spec: &GeomSpec, outline: &Vertices) -> Result<Vec<Form>, String> {
    let offset = double(spec.offset.unwrap_or_else(Vector2::zeros));
    let angle = f64::from(spec.rotation_offset.unwrap_or(0.0));
    // The geom's rotation also turns its offset (behaviour chapter 05).
    let place = |corner: [f64; 2]| point(turned([corner[0] + offset[0], corner[1] + offset[1]], angle));
    Ok(match spec.shape {
        GeomShape::Circle { radius, .. } => {
            vec![Form::Circle { centre: place([0.0; 2]), radius: metres(f64::from(radius)) }]
        }
        GeomShape::Rectangle { width, height } => {
            let half_extents = [width, height].map(|extent| metres(f64::from(extent) / 2.0));
            vec![Form::Rectangle { centre: place([0.0; 2]), angle: angle as f32, half_extents }]
        }
        _ => {
            let pieces = convex_pieces(outline)?;
            let convex = |piece: Vec<[f64; 2]>| Form::Convex(piece.into_iter().map(place).collect());
            pieces.into_iter().map(convex).collect()
        }
    })
}

/// Returns the corners in px of the convex pieces of an outline; a convex outline is the only piece.
fn convex_pieces(outline: &Vertices) -> Result<Vec<Vec<[f64; 2]>>, String> {
    let corners = corners(outline);
    if is_convex(&corners) {
        return Ok(vec![corners]);
    }
    let pieces = outline.decompose(50).map_err(|error| error.to_string())?;
    let pieces: Vec<_> = pieces.iter().map(|piece| self::corners(piece)).collect();
    let (whole, sum) = (area(&corners).abs(), pieces.iter().map(|piece| area(piece).abs()).sum::<f64>());
    // The decomposition omits corners of less than a degree, and pieces beyond its limit: the area then differs.
    if (whole - sum).abs() > 1e-3 * whole {
        return Err(format!("an outline of {} corners cannot be cut into convex pieces", corners.len()));
    }
    Ok(pieces)
}

/// Returns the vertices of `outline` in px that do not lie on a straight line with their neighbours.
fn corners(outline: &[Vector2]) -> Vec<[f64; 2]> {
    let points: Vec<_> = outline.iter().map(|&vertex| double(vertex)).collect();
    let extent = points.iter().flatten().fold(0.0_f64, |most, part| most.max(part.abs()));
    let is_corner = |&index: &usize| bend(&points, index).abs() > 1e-6 * extent * extent;
    (0..points.len()).filter(is_corner).map(|index| points[index]).collect()
}

/// Returns twice the signed area, px², of the triangle of a vertex and its two neighbours. The sign is the turning direction of
/// the outline at the vertex.
fn bend(points: &[[f64; 2]], index: usize) -> f64 {
    let count = points.len();
    let [before, at, after] = [index + count - 1, index, index + 1].map(|index| points[index % count]);
    (at[0] - before[0]) * (after[1] - at[1]) - (at[1] - before[1]) * (after[0] - at[0])
}

fn is_convex(points: &[[f64; 2]]) -> bool {
    let bends = || (0..points.len()).map(|index| bend(points, index));
    bends().all(|bend| bend > 0.0) || bends().all(|bend| bend < 0.0)
}

fn area(points: &[[f64; 2]]) -> f64 {
    let next = points.iter().cycle().skip(1);
    points.iter().zip(next).map(|(a, b)| (a[0] * b[1] - b[0] * a[1]) / 2.0).sum()
}

impl BodyPart {
    /// Returns the initial rotation in radians and the initial angular velocity in radians/s.
    pub(super) fn spin(&self) -> (f64, f64) {
        (f64::from(self.angle), f64::from(self.angular_velocity))
    }

    /// Converts a point from the world's coordinates to the body's coordinates, both in px.
    pub(super) fn local(&self, world: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.position.map(|part| f64::from(part) * METRE);
        turned([world[0] - x, world[1] - y], -f64::from(self.angle))
    }

    /// Converts a point from the body's coordinates to the world's coordinates, both in px.
    pub(super) fn world(&self, local: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.position.map(|part| f64::from(part) * METRE);
        let [dx, dy] = turned(local, f64::from(self.angle));
        [x + dx, y + dy]
    }
}
