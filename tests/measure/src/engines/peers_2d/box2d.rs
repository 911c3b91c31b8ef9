//! Runs 2D scenes in Box2D 3.

use super::links::{Link, LinkKind};
use super::parts::{BodyPart, Form, Parts, ShapePart, parts};
use super::state::{PeerState, TurnCounter, metres, point, succeeds};
use crate::method::Setting;
use crate::world::{BodyState, World};
use boxdd::{
    BodyId, BodyType, DistanceJointDef, Filter, Foundation, JointBase, JointId, MAX_POLYGON_VERTICES,
    MassData, MixerId, MotorJointDef, Polygon, PrismaticJointDef, RevoluteJointDef, ShapeDef,
    SurfaceMaterial, Transform, Vec2, WeldJointDef, shapes,
};
use conformance::scene::Scene;
use std::cell::RefCell;
use std::f32::consts::TAU;

/// Linear slop of Box2D in metres: no distance joint is shorter.
const LINEAR_SLOP: f32 = 0.005;
/// `JOINT_HERTZ`: frequency in Hz of Box2D's joints. `JOINT_DAMPING_RATIO`: damping ratio of Box2D's joints, dimensionless.
/// Both are used for the motor joint that replaces a joint which Box2D lacks.
const JOINT_HERTZ: f32 = 60.0;
const JOINT_DAMPING_RATIO: f32 = 2.0;

struct Box2d {
    /// The world of Box2D. The cell is needed because the crate reads a body through a mutable reference.
    world: RefCell<boxdd::World>,
    bodies: Vec<BodyId>,
    turns: TurnCounter,
    substeps: i32,
    /// Bodies with rotational drag, and the drag torque per squared angular velocity in kg m².
    dragged: Vec<(BodyId, f32)>,
    /// Springs whose force does not act through the centres of mass of both bodies.
    eccentric: Vec<EccentricSpring>,
    /// Whether a step has failed: the world then gives no states.
    is_broken: bool,
}

/// Builds a scene in Box2D, with the iterations of the setting as substeps and default settings, on one thread. Two bodies of
/// which only the relative angle is constrained get a motor joint, as stiff as the other joints. Box2D omits corners that stand
/// out by less than 0.3 px or are nearer than 0.6 px to each other.
///
/// # Errors
///
/// The scene has a feature that Box2D lacks.
pub fn build_box2d(scene: &Scene, setting: Setting) -> Result<Box<dyn World>, String> {
    build_parts(&parts(scene)?, setting)
}

/// Builds a world of Box2D from the bodies, shapes and joints of a scene.
pub(super) fn build_parts(parts: &Parts, setting: Setting) -> Result<Box<dyn World>, String> {
    let substeps = i32::try_from(setting.passes).map_err(|_| format!("no {} substeps", setting.passes))?;
    let built = Builder::new(parts, setting).and_then(|mut builder| {
        builder.add_bodies()?;
        builder.add_links()?;
        Ok(builder)
    });
    let Builder { world, bodies, eccentric, .. } = built.map_err(|Refused(reason)| reason)?;
    let dragged = parts.bodies.iter().zip(&bodies).filter(|(part, _)| part.rotational_drag != 0.0);
    Ok(Box::new(Box2d {
        dragged: dragged.map(|(part, &body)| (body, part.rotational_drag)).collect(),
        turns: TurnCounter::new(parts.bodies.iter().map(BodyPart::spin)),
        world: RefCell::new(world),
        bodies,
        substeps,
        eccentric,
        is_broken: false,
    }))
}

/// Returns the version of Box2D: a state of its development after 3.1.
pub(super) fn version() -> String {
    let version = Foundation::initialize_default().and_then(|_| boxdd::version());
    version.map_or_else(
        |error| error.to_string(),
        |version| format!("{}.{}.{}", version.major, version.minor, version.revision),
    )
}

/// The reason why an object cannot be built in Box2D.
struct Refused(String);

impl From<boxdd::Error> for Refused {
    fn from(error: boxdd::Error) -> Self {
        Refused(error.to_string())
    }
}

impl From<&str> for Refused {
    fn from(reason: &str) -> Self {
        Refused(reason.to_owned())
    }
}

struct Builder<'a> {
    parts: &'a Parts,
    world: boxdd::World,
    bodies: Vec<BodyId>,
    ground: BodyId,
    eccentric: Vec<EccentricSpring>,
    /// Stiffness of a motor joint in Hz, by the rule of Box2D for its other joints.
    joint_hertz: f32,
}

impl<'a> Builder<'a> {
    fn new(parts: &'a Parts, setting: Setting) -> Result<Self, Refused> {
        let foundation = Foundation::initialize_default()?;
        let definition = foundation.world_builder().gravity(parts.gravity).enable_sleep(false).build()?;
        let mut world = foundation.create_world(definition)?;
        mix_surfaces(&mut world, parts)?;
        let ground = world.create_body(world.body_def())?;
        // Box2D limits the stiffness of joints to a quarter of the rate of substeps.
        let rate = setting.passes as f32 / setting.dt.mean();
        let joint_hertz = JOINT_HERTZ.min(rate / 4.0);
        Ok(Builder { parts, world, bodies: Vec::new(), ground, eccentric: Vec::new(), joint_hertz })
    }

    fn add_bodies(&mut self) -> Result<(), Refused> {
        for part in &self.parts.bodies {
            self.bodies.push(self.world.create_body(body(part, self.world.body_builder())?)?);
        }
        for shape in &self.parts.shapes {
            let definition = definition(shape)?;
            let mut body = self.world.body(self.bodies[shape.body])?;
            if let Form::Circle { centre, radius } = shape.form {
                body.create_circle(&definition, &shapes::circle(centre, radius)?)?;
            }
            for polygon in polygons(&shape.form)? {
                body.create_polygon(&definition, &polygon)?;
            }
        }
        for (part, &body) in self.parts.bodies.iter().zip(&self.bodies).filter(|(part, _)| !part.is_static) {
            let mass = MassData::new(part.mass, Vec2::ZERO, part.inertia)?;
            self.world.body(body)?.set_mass_data(mass)?;
        }
        Ok(())
    }

    fn add_links(&mut self) -> Result<(), Refused> {
        let links = &self.parts.links;
        links.iter().try_for_each(|link| self.add_link(link))
    }

    /// Returns the common definition of a joint: its bodies and its local frames at `anchors` (metres), the first turned by
    /// `angle` radians. The joined bodies may collide.
    fn base(&self, link: &Link, anchors: [[f32; 2]; 2], angle: f32) -> Result<JointBase, Refused> {
        let body1 = link.body1.map_or(self.ground, |index| self.bodies[index]);
        let base = self.world.joint_base(body1, self.bodies[link.body2])?;
        let [one, two] = anchors;
        Ok(base.with_local_frame_components(one, angle, two, 0.0)?.with_collide_connected(true))
    }

    fn add_link(&mut self, link: &Link) -> Result<(), Refused> {
        match link.kind {
            LinkKind::Point { anchors } => {
                let mut joint = RevoluteJointDef::new(self.base(link, anchors, 0.0)?);
                if let Some([min, max]) = self.angle_range(link) {
                    joint = joint.enable_limit(true).lower_angle(min).upper_angle(max);
                }
                self.world.create_revolute_joint(&joint)?;
            }
            LinkKind::Hinge { anchors, angle, limits, motor } => {
                let mut joint = RevoluteJointDef::new(self.base(link, anchors, angle)?);
                if let Some([min, max]) = limits {
                    joint = joint.enable_limit(true).lower_angle(min).upper_angle(max);
                }
                if let Some([speed, torque]) = motor {
                    joint = joint.enable_motor(true).motor_speed(speed).max_motor_torque(torque);
                }
                self.world.create_revolute_joint(&joint)?;
            }
            LinkKind::Slider { anchors: [one, two], angles: [angle1, angle2] } => {
                let base = self.base(link, [[0.0; 2]; 2], 0.0)?;
                let base = base.with_local_frame_components(one, angle1, two, angle2)?;
                self.world.create_prismatic_joint(&PrismaticJointDef::new(base))?;
            }
            LinkKind::Weld { anchors, angle } => {
                self.world.create_weld_joint(&WeldJointDef::new(self.base(link, anchors, angle)?))?;
            }
            LinkKind::Distance { anchors, length } => {
                let joint = DistanceJointDef::new(self.base(link, anchors, 0.0)?).length(not_short(length)?);
                self.world.create_distance_joint(&joint)?;
            }
            LinkKind::DistanceRange { anchors, min, max } => {
                // In Box2D the limits of a distance joint have an effect only beside a spring; a spring of stiffness 0 has no
                // force.
                let joint = DistanceJointDef::new(self.base(link, anchors, 0.0)?).length(not_short(max)?);
                let joint = joint.enable_spring(true).hertz(0.0).enable_limit(true);
                let joint = joint.min_length(min.max(LINEAR_SLOP)).max_length(max);
                self.world.create_distance_joint(&joint)?;
            }
            LinkKind::Spring { anchors, length, stiffness, damping } => {
                let base = self.base(link, anchors, 0.0)?;
                self.add_spring(link, base, Spring { anchors, stiffness, damping }, length)?;
            }
            LinkKind::Angle { angle } => {
                let base = self.base(link, [[0.0; 2]; 2], angle)?;
                self.add_angle_spring(base, self.joint_hertz, JOINT_DAMPING_RATIO)?;
            }
            LinkKind::AngleSpring { angle, stiffness } => {
                let base = self.base(link, [[0.0; 2]; 2], angle)?;
                let mobility: f32 = link.movable(self.parts).map(|part| 1.0 / part.inertia).sum();
                self.add_angle_spring(base, (stiffness * mobility).sqrt() / TAU, 0.0)?;
            }
            LinkKind::AngleRange { .. } => {
                if !self.parts.links.iter().any(|other| other.turns_like(link)) {
                    return Err("no angle limits without a revolute joint".into());
                }
            }
        }
        Ok(())
    }

    /// Returns the lower and upper limit in radians of the angle between the bodies of a revolute joint; `None` without limits.
    /// In Box2D the limits belong to the revolute joint.
    fn angle_range(&self, joint: &Link) -> Option<[f32; 2]> {
        self.parts.links.iter().find_map(|link| match link.kind {
            LinkKind::AngleRange { min, max } if joint.turns_like(link) => Some([min, max]),
            _ => None,
        })
    }

    fn add_spring(
        &mut self,
        link: &Link,
        base: JointBase,
        spring: Spring,
        length: f32,
    ) -> Result<(), Refused> {
        if spring.stiffness == 0.0 {
            return Err("no dampers without stiffness".into());
        }
        let ends = [link.body1, Some(link.body2)].map(|index| self.end(index?));
        let [hertz, ratio] = spring.tuning(&mut self.world, &ends)?;
        let joint = DistanceJointDef::new(base).length(not_short(length)?);
        let joint = joint.enable_spring(true).hertz(hertz).damping_ratio(ratio);
        let id = self.world.create_distance_joint(&joint)?;
        let is_eccentric = |(end, anchor): (&Option<End>, [f32; 2])| end.is_some() && anchor != [0.0; 2];
        if ends.iter().zip(spring.anchors).any(is_eccentric) {
            self.eccentric.push(EccentricSpring { id, spring, ends });
        }
        Ok(())
    }

    fn add_angle_spring(&mut self, base: JointBase, hertz: f32, ratio: f32) -> Result<(), Refused> {
        let joint = MotorJointDef::new(base).angular_hertz(hertz).angular_damping_ratio(ratio);
        self.world.create_motor_joint(&joint.max_spring_torque(f32::MAX))?;
        Ok(())
    }

    fn end(&self, index: usize) -> Option<End> {
        let part = &self.parts.bodies[index];
        let end = End { body: self.bodies[index], mobility: 1.0 / part.mass, turning: 1.0 / part.inertia };
        (!part.is_static).then_some(end)
    }
}

impl Link {
    /// Returns the bodies of the link that are not static.
    fn movable<'a>(&self, parts: &'a Parts) -> impl Iterator<Item = &'a BodyPart> {
        let bodies = self.body1.into_iter().chain([self.body2]).map(|index| &parts.bodies[index]);
        bodies.filter(|part| !part.is_static)
    }

    /// Returns whether one link is a revolute joint and the other a limit of the angle between the same bodies.
    fn turns_like(&self, limit: &Link) -> bool {
        matches!(self.kind, LinkKind::Point { .. })
            && matches!(limit.kind, LinkKind::AngleRange { .. })
            && (self.body1, self.body2) == (limit.body1, limit.body2)
    }
}

fn not_short(length: f32) -> Result<f32, Refused> {
    if length >= LINEAR_SLOP { Ok(length) } else { Err("no distances to be held below 0.16 px".into()) }
}

/// Sets a callback that combines friction and restitution of a pair by the mean. Box2D takes the geometric mean of frictions
/// and the greater restitution. The callback costs time and is set only where it changes a result.
fn mix_surfaces(world: &mut boxdd::World, parts: &Parts) -> Result<(), Refused> {
    let Some(first) = parts.shapes.first() else { return Ok(()) };
    if parts.shapes.iter().any(|shape| shape.friction != first.friction) {
        let takes_lesser = parts.takes_lesser_friction;
        let rule = MixerId::from_bytes([1 + u8::from(takes_lesser); 32]);
        world.set_friction_callback(rule, move |a, b| match takes_lesser {
            true => a.coefficient.min(b.coefficient),
            false => (a.coefficient + b.coefficient) / 2.0,
        })?;
    }
    if parts.shapes.iter().any(|shape| shape.restitution != first.restitution) {
        let rule = MixerId::from_bytes([3; 32]);
        world.set_restitution_callback(rule, |a, b| (a.coefficient + b.coefficient) / 2.0)?;
    }
    Ok(())
}

fn body(part: &BodyPart, builder: boxdd::BodyBuilder) -> Result<boxdd::BodyDef, Refused> {
    let builder = builder
        .body_type(if part.is_static { BodyType::Static } else { BodyType::Dynamic })
        .position(part.position)
        .angle(part.angle)
        .linear_velocity(part.velocity)
        .angular_velocity(part.angular_velocity)
        .linear_damping(part.linear_damping)
        .angular_damping(part.angular_damping)
        .gravity_scale(if part.feels_gravity { 1.0 } else { 0.0 });
    Ok(builder.build()?)
}

/// Returns the definition of a shape without mass: the mass of the body is set separately.
fn definition(shape: &ShapePart) -> Result<ShapeDef, Refused> {
    let surface =
        SurfaceMaterial::new().with_friction(shape.friction)?.with_restitution(shape.restitution)?;
    // In Box2D, shapes of the same negative group do not collide.
    let group_index = shape.group.map_or(Ok(0), |number| i32::try_from(number).map(|number| -1 - number));
    let group_index = group_index.map_err(|_| "no more collision groups")?;
    Ok(ShapeDef::builder()
        .density(0.0)
        .material(surface)
        .filter(Filter { group_index, ..Filter::new() })
        .build()?)
}

/// Splits a shape into polygons with at most the number of corners that Box2D allows; returns none for a circle.
fn polygons(form: &Form) -> Result<Vec<Polygon>, Refused> {
    Ok(match form {
        Form::Circle { .. } => Vec::new(),
        Form::Rectangle { centre, angle, half_extents: [x, y] } => {
            let place = Transform::from_pos_angle(*centre, *angle)?;
            vec![shapes::offset_box_polygon(*x, *y, place)?]
        }
        Form::Convex(corners) => {
            let (first, others) = corners.split_first().ok_or("no outlines without corners")?;
            let mut polygons = Vec::new();
            let mut begin = 0;
            // The polygon is cut into a fan: all pieces share the first corner, and neighbouring pieces share an edge.
            while begin + 1 < others.len() {
                let end = others.len().min(begin + MAX_POLYGON_VERTICES - 1);
                let piece = std::iter::once(first).chain(&others[begin..end]);
                polygons.push(shapes::polygon_from_points(piece.copied(), 0.0)?);
                begin = end - 1;
            }
            polygons
        }
    })
}

/// A spring with the stiffness of the scene. Box2D takes the frequency and the damping ratio, which depend on the effective
/// mass.
#[derive(Clone, Copy)]
struct Spring {
    anchors: [[f32; 2]; 2],
    stiffness: f32,
    damping: f32,
}

/// A movable body at one end of a spring.
#[derive(Clone, Copy)]
struct End {
    body: BodyId,
    /// Inverse mass in 1/kg.
    mobility: f32,
    /// Inverse moment of inertia in 1/(kg m²).
    turning: f32,
}

/// A spring whose force turns its bodies: the effective mass depends on their positions. Frequency and damping ratio are set
/// anew before each step.
struct EccentricSpring {
    id: JointId,
    spring: Spring,
    ends: [Option<End>; 2],
}

impl Spring {
    /// Returns the frequency in Hz and the damping ratio of the spring for the present positions of the bodies.
    fn tuning(&self, world: &mut boxdd::World, ends: &[Option<End>; 2]) -> Result<[f32; 2], Refused> {
        let mut arms = [[0.0; 2]; 2];
        let mut points = self.anchors;
        for (side, end) in ends.iter().enumerate() {
            let Some(end) = end else { continue };
            let body = world.body(end.body)?;
            let (position, rotation) = (body.position()?, body.rotation()?);
            let arm = rotation.rotate_vec(Vec2::from(self.anchors[side]));
            arms[side] = [arm.x, arm.y];
            points[side] = [position.x + arm.x, position.y + arm.y];
        }
        let [dx, dy] = [points[1][0] - points[0][0], points[1][1] - points[0][1]];
        let length = dx.hypot(dy);
        let mut mobility = 0.0;
        for (end, [x, y]) in ends.iter().zip(arms).filter_map(|(end, arm)| Some((end.as_ref()?, arm))) {
            let lever = if length > 0.0 { (x * dy - y * dx) / length } else { 0.0 };
            mobility += end.mobility + end.turning * lever * lever;
        }
        let angular = (self.stiffness * mobility).sqrt();
        let ratio = if angular > 0.0 { self.damping * mobility / (2.0 * angular) } else { 0.0 };
        Ok([angular / TAU, ratio])
    }
}

impl Box2d {
    fn advance(&mut self, dt: f32) -> Result<(), Refused> {
        let world = self.world.get_mut();
        for &(body, drag) in &self.dragged {
            let mut body = world.body(body)?;
            let angular_velocity = body.angular_velocity()?;
            body.apply_torque(-drag * angular_velocity * angular_velocity.abs(), false)?;
        }
        for EccentricSpring { id, spring, ends } in &self.eccentric {
            let [hertz, ratio] = spring.tuning(world, ends)?;
            let mut joint = world.joint(*id)?.into_distance()?;
            joint.set_spring_hertz(hertz)?;
            joint.set_spring_damping_ratio(ratio)?;
        }
        match world.step(dt, self.substeps)?.post_step_error() {
            Some(error) => Err(Refused(error.to_string())),
            None => Ok(()),
        }
    }

    fn peer_state(&self, index: usize) -> Result<PeerState, Refused> {
        let mut world = self.world.borrow_mut();
        let body = world.body(self.bodies[index])?;
        let (position, rotation) = (body.position()?, body.rotation()?);
        let velocity = body.linear_velocity()?;
        Ok(PeerState {
            position: [position.x, position.y],
            rotation: [rotation.cosine(), rotation.sine()],
            velocity: [velocity.x, velocity.y],
            angular_velocity: body.angular_velocity()?,
        })
    }

    /// Changes a body by `act`; a change that Box2D rejects has no effect.
    fn change(
        &mut self,
        index: usize,
        change: impl FnOnce(&mut boxdd::Body<'_>) -> boxdd::Result<()>,
    ) -> bool {
        let world = self.world.get_mut();
        world.body(self.bodies[index]).and_then(|mut body| change(&mut body)).is_ok()
    }
}

impl World for Box2d {
    fn step(&mut self, dt: f32) {
        if self.is_broken {
            return;
        }
        self.is_broken = !succeeds(|| self.advance(dt).map_err(|Refused(reason)| reason));
        self.turns.advance(dt);
    }

    fn body(&self, index: usize) -> BodyState {
        self.turns.state(index, if self.is_broken { None } else { self.peer_state(index).ok() })
    }

    fn body_count(&self) -> usize {
        self.turns.len()
    }

    fn set_velocity(&mut self, index: usize, velocity: [f64; 2], angular_velocity: f64) {
        let is_done = self.change(index, |body| {
            body.set_linear_velocity(point(velocity))?;
            body.set_angular_velocity(angular_velocity as f32)
        });
        if is_done {
            self.turns.set(index, None, Some(angular_velocity));
        }
    }

    fn apply_impulse(&mut self, index: usize, impulse: [f64; 2]) {
        self.change(index, |body| body.apply_linear_impulse_to_center(point(impulse), true));
    }

    fn teleport(&mut self, index: usize, position: [f64; 2], angle: f64) {
        let is_done =
            self.change(index, |body| body.set_position_and_rotation(position.map(metres), angle as f32));
        if is_done {
            self.turns.set(index, Some(angle), None);
        }
    }

    fn set_sleep_enabled(&mut self, is_enabled: bool) {
        self.is_broken |= self.world.get_mut().enable_sleeping(is_enabled).is_err();
    }

    fn is_asleep(&self, index: usize) -> bool {
        let mut world = self.world.borrow_mut();
        world.body(self.bodies[index]).and_then(|body| body.is_awake()).is_ok_and(|is_awake| !is_awake)
    }
}
