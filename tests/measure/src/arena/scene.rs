//! Description of a scene of the arena, independent of the engine.
//!
//! Lengths are m, masses kg, times s, angles rad; y points up, as in Box2D's benchmark. A body's position is its centre of
//! mass. Shapes are given in local coordinates about the centre of mass.

use super::joint::Joint;
use crate::penetration::depth::hull;
use crate::world::turned;
use std::f64::consts::PI;

/// A point or vector in m.
pub type Point = [f32; 2];

/// Type of a body: static, kinematic or dynamic.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Kind {
    /// The body never moves.
    #[default]
    Static,
    /// The body moves with its given velocity; contacts and forces have no effect on it.
    Kinematic,
    /// Forces and impulses move the body.
    Dynamic,
}

/// Geometry of a shape in local coordinates of its body, in m.
#[derive(Debug, Clone, PartialEq)]
#[expect(missing_docs, reason = "the fields are lengths and points in m")]
pub enum Form {
    Circle {
        centre: Point,
        radius: f32,
    },
    Capsule {
        ends: [Point; 2],
        radius: f32,
    },
    Box {
        half: Point,
        centre: Point,
    },
    /// A convex polygon with anticlockwise corners, whose outline is rounded: it lies `radius` outside of the polygon of the
    /// corners.
    Polygon {
        corners: Vec<Point>,
        radius: f32,
    },
    /// A chain of edges that collides on one side alone: on the left in the direction of its points. A floor runs from left
    /// to right, a room anticlockwise.
    Chain {
        points: Vec<Point>,
        is_loop: bool,
    },
}

impl Form {
    /// Creates the convex hull of `points` (m), rounded with `radius` (m).
    pub fn hull(points: &[Point], radius: f32) -> Self {
        let points: Vec<_> = points.iter().map(|point| point.map(f64::from)).collect();
        Form::Polygon {
            corners: hull(&points).iter().map(|corner| corner.map(|v| v as f32)).collect(),
            radius,
        }
    }

    /// Returns this geometry translated by a vector in m.
    fn moved(self, [dx, dy]: Point) -> Self {
        let at = |[x, y]: Point| [x + dx, y + dy];
        let all = |points: Vec<Point>| points.into_iter().map(at).collect();
        match self {
            Form::Circle { centre, radius } => Form::Circle { centre: at(centre), radius },
            Form::Capsule { ends, radius } => Form::Capsule { ends: ends.map(at), radius },
            Form::Box { half, centre } => Form::Box { half, centre: at(centre) },
            Form::Polygon { corners, radius } => Form::Polygon { corners: all(corners), radius },
            Form::Chain { points, is_loop } => Form::Chain { points: all(points), is_loop },
        }
    }

    /// Returns the corners in m, in local coordinates, of a box, or of a polygon whose edges are moved outward by its
    /// radius. Corners are sharp, for engines without rounded polygons. Empty for other geometries.
    pub(super) fn sharp_corners(&self) -> Vec<Point> {
        match self {
            Form::Box { half: [x, y], centre: [cx, cy] } => {
                [[-x, -y], [*x, -y], [*x, *y], [-x, *y]].map(|[x, y]| [cx + x, cy + y]).to_vec()
            }
            Form::Polygon { corners, radius } => grown(corners, *radius),
            _ => Vec::new(),
        }
    }

    /// Returns the area in m², the centroid in m, and the second moment of area about the centroid in m⁴. A chain has area
    /// 0.
    fn area(&self) -> (f64, [f64; 2], f64) {
        match self {
            Form::Circle { centre, radius } => {
                let radius = f64::from(*radius);
                let area = PI * radius * radius;
                (area, centre.map(f64::from), 0.5 * area * radius * radius)
            }
            Form::Capsule { ends: [a, b], radius } => {
                let (length, r) = (f64::from((b[0] - a[0]).hypot(b[1] - a[1])), f64::from(*radius));
                let (rectangle, disc) = (2.0 * r * length, PI * r * r);
                // The centroid of a half disc is 4 r / (3 pi) from its centre.
                let (half, lever) = (0.5 * length, 4.0 * r / (3.0 * PI));
                let of_disc = disc * (0.5 * r * r + half * half + 2.0 * half * lever);
                let moment = of_disc + rectangle * (length * length + 4.0 * r * r) / 12.0;
                (rectangle + disc, [0, 1].map(|axis| 0.5 * f64::from(a[axis] + b[axis])), moment)
            }
            Form::Box { .. } | Form::Polygon { .. } => polygon_area(&self.sharp_corners()),
            Form::Chain { .. } => (0.0, [0.0; 2], 0.0),
        }
    }
}

/// Returns a convex outline whose edges are moved outward by `by` m.
fn grown(corners: &[Point], by: f32) -> Vec<Point> {
    let count = corners.len();
    let normal = |a: Point, b: Point| {
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        [dy / dx.hypot(dy), -dx / dx.hypot(dy)]
    };
    let corner = |i: usize| {
        let (before, here, after) = (corners[(i + count - 1) % count], corners[i], corners[(i + 1) % count]);
        let (m, n) = (normal(before, here), normal(here, after));
        let scale = by / (1.0 + m[0] * n[0] + m[1] * n[1]);
        [here[0] + (m[0] + n[0]) * scale, here[1] + (m[1] + n[1]) * scale]
    };
    (0..count).map(corner).collect()
}

/// Returns area, centroid and second moment of area of a polygon as [`Form::area`]: sums over the triangles of each edge
/// with the first corner.
fn polygon_area(corners: &[Point]) -> (f64, [f64; 2], f64) {
    let first = corners[0].map(f64::from);
    let relative = |corner: Point| [f64::from(corner[0]) - first[0], f64::from(corner[1]) - first[1]];
    let (mut area, mut sum, mut moment) = (0.0, [0.0; 2], 0.0);
    for edge in corners.windows(2) {
        let [[ax, ay], [bx, by]] = [edge[0], edge[1]].map(relative);
        let cross = ax * by - ay * bx;
        area += 0.5 * cross;
        sum = [sum[0] + cross * (ax + bx) / 6.0, sum[1] + cross * (ay + by) / 6.0];
        moment += cross * (ax * ax + ax * bx + bx * bx + ay * ay + ay * by + by * by) / 12.0;
    }
    let [x, y] = sum.map(|sum| sum / area);
    (area, [first[0] + x, first[1] + y], moment - area * (x * x + y * y))
}

/// Collision filter of a shape. Two shapes collide if each mask contains the category of the other shape and they are not in
/// one group.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Filter {
    /// Category of the shape: a value with one bit set.
    pub category: u32,
    /// Bits of all categories with which the shape collides.
    pub mask: u32,
    /// Number of the shape's collision group; 0 is no group.
    pub group: u32,
}

impl Filter {
    /// Filter of ordinary shapes: category 1, collides with all categories, no group.
    pub const DEFAULT: Filter = Filter { category: 1, mask: u32::MAX, group: 0 };

    pub(super) fn meets(self, other: Filter) -> bool {
        let is_grouped = self.group != 0 && self.group == other.group;
        !is_grouped && self.mask & other.category != 0 && other.mask & self.category != 0
    }
}

/// A shape of a body: geometry, density, surface and filter.
#[derive(Debug, Clone, PartialEq)]
pub struct Shape {
    /// Geometry of the shape in local coordinates of its body, in m.
    pub form: Form,
    /// Density in kg/m², >= 0.
    pub density: f32,
    /// Coefficients of friction and restitution for engines that combine two surfaces as Box2D does: geometric mean of the
    /// frictions, greater one of the restitutions.
    pub surface: [f32; 2],
    /// Coefficients of friction and restitution for engines that combine two surfaces by the mean. They are chosen so that
    /// pairs in the scene get the same values as in Box2D.
    pub mean_surface: [f32; 2],
    /// Collision filter of the shape.
    pub filter: Filter,
}

impl Shape {
    /// Creates a shape with Box2D's default density, friction, restitution and filter.
    pub fn new(form: Form) -> Self {
        let surface = [0.6, 0.0];
        Shape { form, density: 1.0, surface, mean_surface: surface, filter: Filter::DEFAULT }
    }

    /// Creates a box with the half extents `half` about the point `centre`, both in m.
    pub fn rectangle(half: Point, centre: Point) -> Self {
        Shape::new(Form::Box { half, centre })
    }

    /// Returns this shape with a density in kg/m².
    pub fn with_density(self, density: f32) -> Self {
        Shape { density, ..self }
    }

    /// Returns this shape with a coefficient of friction.
    pub fn with_friction(mut self, friction: f32) -> Self {
        (self.surface[0], self.mean_surface[0]) = (friction, friction);
        self
    }

    /// Returns this shape with a collision filter.
    pub fn with_filter(self, category: u32, mask: u32, group: u32) -> Self {
        Shape { filter: Filter { category, mask, group }, ..self }
    }
}

/// A body with its initial state and its shapes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Body {
    /// Type of the body: static, kinematic or dynamic.
    pub kind: Kind,
    /// Initial centre of mass in m; for static and kinematic bodies the origin of the body.
    pub position: Point,
    /// Initial angle in rad, anticlockwise.
    pub angle: f32,
    /// Initial velocity of the centre of mass in m/s.
    pub velocity: Point,
    /// Initial angular velocity in rad/s, anticlockwise.
    pub spin: f32,
    /// Linear damping in 1/s: deceleration divided by velocity, >= 0.
    pub damping: f32,
    /// Speed in m/s below which the body may fall asleep, for engines with such a setting; `None` for the engine's default.
    pub sleep_speed: Option<f32>,
    /// Whether the body is asleep at the start, for engines with such a setting.
    pub is_asleep: bool,
    /// Mass in kg; 0 unless the body is dynamic.
    pub mass: f32,
    /// Moment of inertia about the centre of mass in kg m²; 0 unless the body is dynamic.
    pub inertia: f32,
    /// Shapes of the body.
    pub shapes: Vec<Shape>,
}

impl Body {
    /// Creates a static or kinematic body with its origin at `position`, in m.
    pub fn immovable(kind: Kind, position: Point, shapes: Vec<Shape>) -> Self {
        Body { kind, position, shapes, ..Body::default() }
    }

    /// Returns the inverse mass in 1/kg; 0 unless the body is dynamic.
    pub(super) fn mobility(&self) -> f32 {
        if self.mass > 0.0 { 1.0 / self.mass } else { 0.0 }
    }

    /// Returns the inverse moment of inertia in 1/(kg m²); 0 unless the body is dynamic.
    pub(super) fn turning_mobility(&self) -> f32 {
        if self.inertia > 0.0 { 1.0 / self.inertia } else { 0.0 }
    }

    /// Returns a point of the world in m in the coordinates of this body at its initial position and angle.
    pub(super) fn local(&self, [x, y]: Point) -> Point {
        let offset = [x - self.position[0], y - self.position[1]].map(f64::from);
        turned(offset, -f64::from(self.angle)).map(|v| v as f32)
    }

    /// Creates a dynamic body whose mass and inertia follow from its shapes. Shapes are given relative to a point of the
    /// world, in m, which need not be the centre of mass.
    pub fn dynamic([x, y]: Point, shapes: Vec<Shape>) -> Self {
        let areas: Vec<_> =
            shapes.iter().map(|shape| (f64::from(shape.density), shape.form.area())).collect();
        let mass: f64 = areas.iter().map(|(density, (area, ..))| density * area).sum();
        let moment =
            |axis: usize| areas.iter().map(|(density, (area, at, _))| density * area * at[axis]).sum::<f64>();
        let [cx, cy] = [moment(0) / mass, moment(1) / mass];
        // Parallel axis theorem: moments of inertia about the common centre of mass.
        let inertia = |(density, (area, [x, y], own)): &(f64, (f64, [f64; 2], f64))| {
            density * (own + area * ((x - cx).powi(2) + (y - cy).powi(2)))
        };
        let inertia = areas.iter().map(inertia).sum::<f64>() as f32;
        let [cx, cy] = [cx, cy].map(|v| v as f32);
        let about_centre = |shape: Shape| Shape { form: shape.form.moved([-cx, -cy]), ..shape };
        let shapes = shapes.into_iter().map(about_centre).collect();
        Body { mass: mass as f32, inertia, ..Body::immovable(Kind::Dynamic, [x + cx, y + cy], shapes) }
    }
}

/// A change of the scene before a step. Bodies and joints are given by index in the order of creation.
#[derive(Debug, Clone, PartialEq)]
#[expect(missing_docs, reason = "the fields are indices, and a position in m")]
pub enum Action {
    AddBody(Body),
    AddJoint(Joint),
    RemoveBody(usize),
    RemoveJoint(usize),
    /// Moves a kinematic body to the position `to` (m) within the step.
    Move {
        body: usize,
        to: Point,
    },
}

/// Function that returns the actions before a step, by the number of the step from 0.
pub type Script = Box<dyn Fn(usize) -> Vec<Action>>;

/// Limits of a sound state: it is finite and exceeds none of these.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Limits {
    /// Lowest and highest corner in m of the box that no body may leave; `None` where bodies may fall off.
    pub bounds: Option<[Point; 2]>,
    /// Greatest speed of a body in m/s.
    pub speed: f32,
    /// Deepest overlap of two shapes in metres.
    pub overlap: f32,
    /// Greatest distance in metres between the two anchors of a joint.
    pub gap: f32,
}

/// A scene of the arena: bodies, joints, gravity, and a script of changes.
#[derive(Default)]
#[expect(missing_debug_implementations, reason = "scripts have none")]
pub struct Scene {
    /// Gravity as a vector in m/s², y up.
    pub gravity: Point,
    /// Whether bodies at rest may sleep.
    pub sleeps: bool,
    /// Whether our engine combines the frictions of a pair by the minimum. True where the minimum equals the geometric mean
    /// of Box2D for all pairs, and the arithmetic mean does not.
    pub takes_lesser_friction: bool,
    /// Number of steps of a run.
    pub steps: usize,
    /// Bodies at the start.
    pub bodies: Vec<Body>,
    /// Joints at the start.
    pub joints: Vec<Joint>,
    /// Function that returns changes before each step; `None` if there are none.
    pub script: Option<Script>,
    /// Limits of a sound final state.
    pub limits: Limits,
}

impl Scene {
    /// Creates an empty scene with gravity 10 m/s² downwards, Box2D's default.
    pub(super) fn empty(steps: usize, limits: Limits) -> Self {
        Scene { gravity: [0.0, -10.0], sleeps: true, steps, limits, ..Scene::default() }
    }

    /// Adds a body and returns its index.
    pub(super) fn add(&mut self, body: Body) -> usize {
        self.bodies.push(body);
        self.bodies.len() - 1
    }
}
