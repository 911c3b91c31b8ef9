//! Scenes of the arena in Box2D 3, on one thread. All settings that a scene does not give have Box2D's default.

use super::engine::{Counters, DT, Engine, Result, SUBSTEPS, State};
use super::joint::{Joint, JointKind};
use super::scene::{Body, Filter, Form, Kind, Point, Scene, Shape};
use boxdd::{
    Aabb, BodyId, BodyType, ChainDef, DistanceJointDef, Foundation, JointBase, JointId, Position,
    PrismaticJointDef, QueryFilter, RevoluteJointDef, ShapeDef, ShapeQueryBuffer, SurfaceMaterial, Transform,
    Vec2, WeldJointDef, WorldTransform, shapes,
};

/// A scene of the arena in a Box2D world.
pub(super) struct Box2d {
    world: boxdd::World,
    bodies: Vec<BodyId>,
    joints: Vec<JointId>,
    found: ShapeQueryBuffer,
}

/// Linear slop of Box2D in metres: no distance joint is shorter.
const LINEAR_SLOP: f32 = 0.005;

impl Box2d {
    pub(super) fn new(scene: &Scene) -> Result<Self> {
        let foundation = Foundation::initialize_default()?;
        let world = foundation.world_builder().gravity(scene.gravity).enable_sleep(scene.sleeps);
        let world = foundation.create_world(world.build()?)?;
        Ok(Box2d { world, bodies: Vec::new(), joints: Vec::new(), found: ShapeQueryBuffer::new() })
    }

    fn read(&mut self, index: usize) -> boxdd::Result<State> {
        let body = self.world.body(self.bodies[index])?;
        let (position, rotation, velocity) = (body.position()?, body.rotation()?, body.linear_velocity()?);
        Ok(State {
            position: [position.x, position.y],
            angle: rotation.sine().atan2(rotation.cosine()),
            velocity: [velocity.x, velocity.y],
            spin: body.angular_velocity()?,
        })
    }
}

impl Box2d {
    fn add_hinge(&mut self, base: JointBase, joint: &Joint, of: [&Body; 2]) -> Result<JointId> {
        let [one, two] = joint.local_anchors(of);
        let base = base.with_local_frame_components(one, joint.reference, two, 0.0)?;
        let mut definition = RevoluteJointDef::new(base);
        if let Some([lower, upper]) = joint.limits {
            definition = definition.enable_limit(true).lower_angle(lower).upper_angle(upper);
        }
        if let Some([speed, torque]) = joint.motor {
            definition = definition.enable_motor(true).motor_speed(speed).max_motor_torque(torque);
        }
        if let Some([hertz, ratio]) = joint.spring {
            definition = definition.enable_spring(true).hertz(hertz).damping_ratio(ratio);
        }
        Ok(self.world.create_revolute_joint(&definition)?)
    }

    fn add_slider(&mut self, base: JointBase, joint: &Joint, of: [&Body; 2]) -> Result<JointId> {
        let ([one, two], [axis1, axis2]) = (joint.local_anchors(of), joint.local_axes(of));
        let base = base.with_local_frame_components(one, axis1, two, axis2)?;
        let mut definition = PrismaticJointDef::new(base);
        if let Some([lower, upper]) = joint.limits {
            definition = definition.enable_limit(true).lower_translation(lower).upper_translation(upper);
        }
        if let Some([speed, force]) = joint.motor {
            definition = definition.enable_motor(true).motor_speed(speed).max_motor_force(force);
        }
        Ok(self.world.create_prismatic_joint(&definition)?)
    }
}

impl Engine for Box2d {
    fn add_body(&mut self, given: &Body) -> Result<()> {
        let kind = match given.kind {
            Kind::Static => BodyType::Static,
            Kind::Kinematic => BodyType::Kinematic,
            Kind::Dynamic => BodyType::Dynamic,
        };
        let mut builder = self.world.body_builder().body_type(kind).position(given.position);
        builder = builder.angle(given.angle);
        builder = builder.linear_velocity(given.velocity).angular_velocity(given.spin);
        builder = builder.linear_damping(given.damping).awake(!given.is_asleep);
        if let Some(speed) = given.sleep_speed {
            builder = builder.sleep_threshold(speed);
        }
        let id = self.world.create_body(builder.build()?)?;
        let mut body = self.world.body(id)?;
        given.shapes.iter().try_for_each(|shape| add_shape(&mut body, shape))?;
        self.bodies.push(id);
        Ok(())
    }

    fn add_joint(&mut self, joint: &Joint, of: [&Body; 2]) -> Result<()> {
        let [a, b] = joint.bodies.map(|index| self.bodies[index]);
        let base = self.world.joint_base(a, b)?;
        let id = match joint.kind {
            JointKind::Hinge => self.add_hinge(base, joint, of)?,
            JointKind::Slider { .. } => self.add_slider(base, joint, of)?,
            JointKind::Weld => {
                let [one, two] = joint.local_anchors(of);
                let base = base.with_local_frame_components(one, joint.reference, two, 0.0)?;
                self.world.create_weld_joint(&WeldJointDef::new(base))?
            }
            JointKind::Rod | JointKind::Rope { .. } | JointKind::Spring => {
                let definition = DistanceJointDef::new(base).length(Joint::length(of));
                // In Box2D the limits of a distance joint act only beside a spring, which may have no stiffness.
                let definition = match (joint.kind, joint.spring) {
                    (JointKind::Rope { length }, _) => {
                        let rope = definition.enable_spring(true).hertz(0.0).enable_limit(true);
                        rope.min_length(LINEAR_SLOP).max_length(length)
                    }
                    (_, Some([hertz, ratio])) => {
                        definition.enable_spring(true).hertz(hertz).damping_ratio(ratio)
                    }
                    _ => definition,
                };
                self.world.create_distance_joint(&definition)?
            }
        };
        self.joints.push(id);
        Ok(())
    }

    fn remove_body(&mut self, index: usize) -> Result<()> {
        Ok(self.world.body(self.bodies[index])?.destroy()?)
    }

    fn remove_joint(&mut self, index: usize) -> Result<()> {
        Ok(self.world.joint(self.joints[index])?.destroy(true)?)
    }

    fn move_to(&mut self, index: usize, position: Point) -> Result<()> {
        let target = WorldTransform::from_pos_angle(position, 0.0)?;
        Ok(self.world.body(self.bodies[index])?.set_target_transform(target, DT, true)?)
    }

    fn step(&mut self) -> Result<()> {
        match self.world.step(DT, i32::from(SUBSTEPS))?.post_step_error() {
            Some(error) => Err(error.to_string().into()),
            None => Ok(()),
        }
    }

    fn state(&mut self, index: usize) -> State {
        let nothing =
            State { position: [f32::NAN; 2], angle: f32::NAN, velocity: [f32::NAN; 2], spin: f32::NAN };
        self.read(index).unwrap_or(nothing)
    }

    fn cast_ray(&mut self, from: Point, to: Point) -> Result<Option<f32>> {
        let way = Vec2::from([to[0] - from[0], to[1] - from[1]]);
        let hit = self.world.query()?.cast_ray_closest(Position::from(from), way, QueryFilter::new())?;
        Ok(hit.map(|hit| hit.fraction))
    }

    fn count_in_box(&mut self, low: Point, high: Point) -> Result<usize> {
        let (origin, area) = (Position::from([0.0; 2]), Aabb::new(low, high)?);
        self.world.query()?.overlap_aabb_into(origin, area, QueryFilter::new(), &mut self.found)?;
        Ok(self.found.as_slice().len())
    }

    fn counters(&mut self) -> Result<Counters> {
        let counters = self.world.counters()?;
        let pairs = counters.awake_contact_count;
        // The recycled contacts may include contacts that the step ended, so the difference may be negative.
        let manifolds = (pairs - counters.recycled_contact_count).max(0);
        Ok(Counters {
            pairs: usize::try_from(pairs)?,
            manifolds: usize::try_from(manifolds)?,
            aabbs: None,
            awake: usize::try_from(self.world.awake_body_count()?)?,
        })
    }
}

fn add_shape(body: &mut boxdd::Body<'_>, shape: &Shape) -> Result<()> {
    let [friction, restitution] = shape.surface;
    let surface = SurfaceMaterial::new().with_friction(friction)?.with_restitution(restitution)?;
    let filter = filter(shape.filter)?;
    let definition = ShapeDef::builder().density(shape.density).material(surface).filter(filter).build()?;
    match &shape.form {
        Form::Circle { centre, radius } => {
            body.create_circle(&definition, &shapes::circle(*centre, *radius)?)?;
        }
        Form::Capsule { ends: [a, b], radius } => {
            body.create_capsule(&definition, &shapes::capsule(*a, *b, *radius)?)?;
        }
        Form::Box { half: [x, y], centre } => {
            let place = Transform::from_pos_angle(*centre, 0.0)?;
            body.create_polygon(&definition, &shapes::offset_box_polygon(*x, *y, place)?)?;
        }
        Form::Polygon { corners, radius } => {
            body.create_polygon(
                &definition,
                &shapes::polygon_from_points(corners.iter().copied(), *radius)?,
            )?;
        }
        // In Box2D a chain collides on its right side, in the direction of its points.
        Form::Chain { points, is_loop: true } => {
            let chain = ChainDef::builder().points(points.iter().rev().copied()).is_loop(true);
            body.create_chain(&chain.filter(filter).single_material(&surface).build()?)?;
        }
        Form::Chain { points, is_loop: false } => {
            for ends in points.windows(2) {
                body.create_segment(&definition, &shapes::segment(ends[0], ends[1])?)?;
            }
        }
    }
    Ok(())
}

fn filter(Filter { category, mask, group }: Filter) -> Result<boxdd::Filter> {
    // In Box2D shapes of one negative group do not collide.
    let group_index = -i32::try_from(group)?;
    let mask_bits = if mask == u32::MAX { u64::MAX } else { u64::from(mask) };
    Ok(boxdd::Filter { category_bits: u64::from(category), mask_bits, group_index })
}
