//! The description of a scene, independent of the engine.
//!
//! Lengths are m, masses kg, times s, angles rad; y points up, as in Box2D's benchmark. A body's position is its centre of
//! mass, and its shapes are given in its own axes about it. All bodies begin at angle 0.

use crate::penetration::depth::hull;
use std::f64::consts::PI;

/// A point or vector in m.
pub type Point = [f32; 2];

/// The type of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Kind {
    /// It never moves.
    #[default]
    Static,
    /// It moves as it is told, whatever it meets.
    Kinematic,
    /// Forces and impulses move it.
    Dynamic,
}

/// The geometry of a shape in the axes of its body.
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
    /// A convex polygon, corners anticlockwise, whose outline lies `radius` outside of its corners.
    Polygon {
        corners: Vec<Point>,
        radius: f32,
    },
    /// Edges whose free side is on the left along the chain: a floor from left to right, a room anticlockwise.
    Chain {
        points: Vec<Point>,
        is_loop: bool,
    },
}

impl Form {
    /// The convex hull of some points, rounded.
    pub fn hull(points: &[Point], radius: f32) -> Self {
        let points: Vec<_> = points.iter().map(|point| point.map(f64::from)).collect();
        Form::Polygon {
            corners: hull(&points).iter().map(|corner| corner.map(|v| v as f32)).collect(),
            radius,
        }
    }

    /// The same, moved by a vector.
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

    /// The corners of a polygon whose edges have moved outward by its radius; of a box its own. Corners stay sharp, as in
    /// engines without rounded polygons.
    pub(super) fn sharp_corners(&self) -> Vec<Point> {
        match self {
            Form::Box { half: [x, y], centre: [cx, cy] } => {
                [[-x, -y], [*x, -y], [*x, *y], [-x, *y]].map(|[x, y]| [cx + x, cy + y]).to_vec()
            }
            Form::Polygon { corners, radius } => grown(corners, *radius),
            _ => Vec::new(),
        }
    }

    /// Area in m², centroid in m, and second moment of area about the centroid in m⁴. A chain has no area.
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

/// A convex outline whose edges have moved outward.
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

/// See [`Form::area`]: sums over the triangles that the edges make with the first corner.
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

/// Which shapes meet: two whose masks both have the other's category, unless they are of one group.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Filter {
    /// One bit.
    pub category: u32,
    /// Bits of categories.
    pub mask: u32,
    /// 0 for none.
    pub group: u32,
}

impl Filter {
    /// Every shape that does not refuse category 1.
    pub const DEFAULT: Filter = Filter { category: 1, mask: u32::MAX, group: 0 };

    pub(super) fn meets(self, other: Filter) -> bool {
        let is_grouped = self.group != 0 && self.group == other.group;
        !is_grouped && self.mask & other.category != 0 && other.mask & self.category != 0
    }
}

/// A shape of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Shape {
    /// Its geometry.
    pub form: Form,
    /// In kg/m².
    pub density: f32,
    /// Coefficients of friction and restitution, for engines in which a pair has the geometric mean of both frictions and the
    /// greater restitution, as in Box2D.
    pub surface: [f32; 2],
    /// The same for engines in which a pair has the mean of both, chosen so that pairs come out alike.
    pub mean_surface: [f32; 2],
    /// Which shapes it meets.
    pub filter: Filter,
}

impl Shape {
    /// A shape with Box2D's default density, friction and restitution.
    pub fn new(form: Form) -> Self {
        let surface = [0.6, 0.0];
        Shape { form, density: 1.0, surface, mean_surface: surface, filter: Filter::DEFAULT }
    }

    /// A box about a point, given by half its extents.
    pub fn rectangle(half: Point, centre: Point) -> Self {
        Shape::new(Form::Box { half, centre })
    }

    /// With a density in kg/m².
    pub fn with_density(self, density: f32) -> Self {
        Shape { density, ..self }
    }

    /// With a coefficient of friction.
    pub fn with_friction(mut self, friction: f32) -> Self {
        (self.surface[0], self.mean_surface[0]) = (friction, friction);
        self
    }

    /// With a filter.
    pub fn with_filter(self, category: u32, mask: u32, group: u32) -> Self {
        Shape { filter: Filter { category, mask, group }, ..self }
    }
}

/// A body.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Body {
    /// Its type.
    pub kind: Kind,
    /// Centre of mass in m; of a static or kinematic body its origin.
    pub position: Point,
    /// In m/s.
    pub velocity: Point,
    /// Angular velocity in rad/s, anticlockwise.
    pub spin: f32,
    /// Share of the velocity lost per s.
    pub damping: f32,
    /// Speed in m/s below which it may sleep, for engines that can be told; theirs if there is none.
    pub sleep_speed: Option<f32>,
    /// Whether it begins asleep, for engines that can be told.
    pub is_asleep: bool,
    /// In kg; 0 unless the body is dynamic.
    pub mass: f32,
    /// Moment of inertia about the centre of mass in kg m²; 0 unless the body is dynamic.
    pub inertia: f32,
    /// Its shapes.
    pub shapes: Vec<Shape>,
}

impl Body {
    /// A static or kinematic body with its origin at a point.
    pub fn immovable(kind: Kind, position: Point, shapes: Vec<Shape>) -> Self {
        Body { kind, position, shapes, ..Body::default() }
    }

    /// A dynamic body of some shapes, which are given about a point; it has the mass of these.
    pub fn dynamic([x, y]: Point, shapes: Vec<Shape>) -> Self {
        let areas: Vec<_> =
            shapes.iter().map(|shape| (f64::from(shape.density), shape.form.area())).collect();
        let mass: f64 = areas.iter().map(|(density, (area, ..))| density * area).sum();
        let moment =
            |axis: usize| areas.iter().map(|(density, (area, at, _))| density * area * at[axis]).sum::<f64>();
        let [cx, cy] = [moment(0) / mass, moment(1) / mass];
        // Steiner's theorem.
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

/// A revolute joint between two bodies, which do not collide with each other.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Indices of the two bodies.
    pub bodies: [usize; 2],
    /// Common point in m, in the world as the bodies are when the joint is made.
    pub anchor: Point,
    /// Angle of the second body against the first from which the joint's angle counts, in rad.
    pub reference: f32,
    /// Least and greatest angle in rad.
    pub limits: Option<[f32; 2]>,
    /// Speed in rad/s of the second body against the first, and greatest torque in N m.
    pub motor: Option<[f32; 2]>,
    /// Frequency in Hz and damping ratio of a spring towards angle 0.
    pub spring: Option<[f32; 2]>,
}

impl Joint {
    /// A joint without limits, motor and spring.
    pub fn new(bodies: [usize; 2], anchor: Point) -> Self {
        Joint { bodies, anchor, reference: 0.0, limits: None, motor: None, spring: None }
    }
}

/// A change before a step. Bodies and joints are named by their order of creation.
#[derive(Debug, Clone, PartialEq)]
#[expect(missing_docs, reason = "the fields are indices, and a position in m")]
pub enum Action {
    AddBody(Body),
    AddJoint(Joint),
    RemoveBody(usize),
    RemoveJoint(usize),
    /// The step brings a kinematic body to a position.
    Move {
        body: usize,
        to: Point,
    },
}

/// The actions before a step, by its number from 0.
pub type Script = Box<dyn Fn(usize) -> Vec<Action>>;

/// A state is sound if every number is finite and within these.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Limits {
    /// Lowest and highest corner in m of the box that no body leaves; none where bodies may fall off.
    pub bounds: Option<[Point; 2]>,
    /// Greatest speed in m/s.
    pub speed: f32,
    /// Deepest overlap of two shapes in m.
    pub overlap: f32,
    /// Greatest distance in m of the two points that a joint holds together.
    pub gap: f32,
}

/// A scene.
#[derive(Default)]
#[expect(missing_debug_implementations, reason = "scripts have none")]
pub struct Scene {
    /// In m/s².
    pub gravity: Point,
    /// Whether bodies at rest may sleep.
    pub sleeps: bool,
    /// Whether the lesser friction of two comes to the same as their geometric mean, and the mean does not.
    pub takes_lesser_friction: bool,
    /// Number of steps.
    pub steps: usize,
    /// The bodies it begins with.
    pub bodies: Vec<Body>,
    /// The joints it begins with.
    pub joints: Vec<Joint>,
    /// Changes while it runs.
    pub script: Option<Script>,
    /// Which states are sound.
    pub limits: Limits,
}

impl Scene {
    /// An empty scene with Box2D's default gravity.
    pub(super) fn empty(steps: usize, limits: Limits) -> Self {
        Scene { gravity: [0.0, -10.0], sleeps: true, steps, limits, ..Scene::default() }
    }

    /// Adds a body, and answers its index.
    pub(super) fn add(&mut self, body: Body) -> usize {
        self.bodies.push(body);
        self.bodies.len() - 1
    }
}
