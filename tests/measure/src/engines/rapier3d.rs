//! Runs 2.5D scenes in `rapier3d`: X, Y up and Z as in the scene, in px. Bodies other than balls rotate about Z only.

use rapier3d::prelude::{
    CoefficientCombineRule, Collider, ColliderBuilder, ColliderHandle, FrictionModel, Group,
    InteractionGroups, InteractionTestMode, MassProperties, PhysicsWorld, Pose, QueryFilter, Ray, RigidBody,
    RigidBodyActivation, RigidBodyBuilder, RigidBodyHandle, Rotation, SphericalJointBuilder, Vector,
};

use super::wrapped;
use crate::scenes::depth::{DepthObject, DepthPlatform, DepthScene, DepthShape, SCREEN_ANGLE, Surface};
use crate::world::{BodyState, ContactPartner, World};

/// Length unit of `rapier3d` in px, with which it scales its tolerances: the size of a large object.
const LENGTH_UNIT: f32 = 40.0;

/// A 2.5D scene in `rapier3d`. Sleep is disabled at first.
#[expect(missing_debug_implementations, reason = "the world in it has none")]
pub struct Rapier {
    world: PhysicsWorld,
    objects: Vec<RigidBodyHandle>,
    /// Distance in px from each object's origin down to its lowest point, as a function of its rotation.
    outlines: Vec<Lowest>,
    /// Object or platform of each collider, by the index of the collider.
    met: Vec<(ColliderHandle, ContactPartner)>,
}

enum Lowest {
    Ball(f64),
    /// A prism: corners of its outline about the origin, px, y down.
    Prism(Vec<[f64; 2]>),
}

impl Rapier {
    /// Builds a scene with the default settings of `rapier3d`.
    ///
    /// # Panics
    /// A shape has no volume.
    pub fn new(scene: &DepthScene) -> Self {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::new(0.0, -scene.gravity, 0.0);
        world.integration_parameters.dt = scene.dt;
        world.integration_parameters.length_unit = LENGTH_UNIT;
        let up = rapier3d::na::Unit::new_unchecked(Vector::Y);
        let ground = with_surface(ColliderBuilder::halfspace(up), scene.ground);
        let (_, ground) = world.insert(RigidBodyBuilder::fixed(), ground);
        let mut rapier = Rapier {
            world,
            objects: Vec::new(),
            outlines: Vec::new(),
            met: vec![(ground, ContactPartner::Ground)],
        };
        for object in &scene.objects {
            rapier.add_object(object);
        }
        for (index, platform) in scene.platforms.iter().enumerate() {
            let (_, collider) = rapier.world.insert(fixed(platform), platform_collider(platform));
            rapier.met.push((collider, ContactPartner::Platform(index)));
        }
        scene.ropes.iter().for_each(|rope| rapier.connect_rope(rope));
        rapier.met.sort_unstable_by_key(|(collider, _)| collider.into_raw_parts());
        rapier
    }

    /// Builds a scene with settings of `rapier3d` for accuracy: friction at every contact point, and no contact recycling.
    pub fn accurate(scene: &DepthScene) -> Self {
        let mut rapier = Self::new(scene);
        rapier.world.integration_parameters.friction_model = FrictionModel::Coulomb;
        rapier.world.integration_parameters.contact_recycling = false;
        rapier
    }

    /// Sets the number of solver iterations per step; the default of `rapier3d` is 4.
    pub fn with_iterations(mut self, iterations: usize) -> Self {
        self.world.integration_parameters.num_solver_iterations = iterations;
        self
    }

    /// Enables sleep of bodies at rest.
    pub fn with_sleep(mut self) -> Self {
        for &body in &self.objects {
            if let Some(body) = self.world.bodies.get_mut(body).filter(|body| body.is_dynamic()) {
                *body.activation_mut() = RigidBodyActivation::active();
            }
        }
        self
    }

    fn add_object(&mut self, object: &DepthObject) {
        let outline = object.outline().unwrap_or_else(|error| panic!("{error}"));
        let lowest = match object.shape {
            DepthShape::Ball { radius } => Lowest::Ball(f64::from(radius)),
            _ => Lowest::Prism(outline.iter().map(|v| [f64::from(v.x), f64::from(v.y)]).collect()),
        };
        let [x, y, z] = object.position;
        let centre = Vector::new(x, (f64::from(y) + lowest.at(f64::from(object.rotation))) as f32, z);
        let body = if object.is_static { RigidBodyBuilder::fixed() } else { movable(object) };
        let body = body.pose(Pose::from_parts(centre, Rotation::from_rotation_z(-object.rotation)));
        let collider = with_surface(shape(object).density(0.0), object.surface);
        let (body, collider) = self.world.insert(body, collider);
        self.met.push((collider, ContactPartner::Object(self.objects.len())));
        self.objects.push(body);
        self.outlines.push(lowest);
    }

    /// Connects the objects of a rope by ball joints. The joint of two neighbours is at the centre of the first one, as in
    /// `rapier3d`'s example of ball joints. Balls of a rope turn about all axes and collide with no ball of any rope.
    fn connect_rope(&mut self, rope: &[usize]) {
        let groups = InteractionGroups::new(Group::GROUP_1, !Group::GROUP_1, InteractionTestMode::And);
        for &object in rope {
            for &collider in self.world.bodies[self.objects[object]].colliders() {
                if let Some(collider) = self.world.colliders.get_mut(collider) {
                    collider.set_collision_groups(groups);
                }
            }
        }
        for two in rope.windows(2) {
            let [before, this] = [two[0], two[1]].map(|object| self.objects[object]);
            let back = self.world.bodies[before].translation() - self.world.bodies[this].translation();
            let joint = SphericalJointBuilder::new().local_anchor2(back).contacts_enabled(false);
            self.world.insert_impulse_joint(before, this, joint);
        }
    }

    fn met(&self, collider: ColliderHandle) -> ContactPartner {
        let key = collider.into_raw_parts();
        match self.met.binary_search_by_key(&key, |(known, _)| known.into_raw_parts()) {
            Ok(index) => self.met[index].1,
            Err(_) => unreachable!("every collider of the world was noted when it was made"),
        }
    }
}

impl Lowest {
    fn at(&self, rotation: f64) -> f64 {
        let (sine, cosine) = rotation.sin_cos();
        match self {
            Lowest::Ball(radius) => *radius,
            Lowest::Prism(outline) => {
                outline.iter().map(|[x, y]| x * sine + y * cosine).fold(f64::NEG_INFINITY, f64::max)
            }
        }
    }
}

/// Returns a movable body with the object's mass (kg). About all axes it has the moment of inertia (kg px²) that the object has
/// in the 2D engine.
fn movable(object: &DepthObject) -> RigidBodyBuilder {
    let body = object.body().unwrap_or_else(|error| panic!("{error}"));
    let inertia = Vector::splat(body.moment_of_inertia());
    let is_ball = matches!(object.shape, DepthShape::Ball { .. });
    RigidBodyBuilder::dynamic()
        .linvel(Vector::from(object.velocity))
        .additional_mass_properties(MassProperties::new(Vector::ZERO, body.mass(), inertia))
        .enabled_rotations(is_ball, is_ball, true)
        .can_sleep(false)
}

fn shape(object: &DepthObject) -> ColliderBuilder {
    match &object.shape {
        DepthShape::Ball { radius } => ColliderBuilder::ball(*radius),
        DepthShape::Box { size } => cuboid(*size),
        DepthShape::Polygon { outline, depth } => {
            let corner = |z: f32| outline.iter().map(move |v| Vector::new(v.x, -v.y, z));
            let corners: Vec<Vector> = corner(-depth / 2.0).chain(corner(depth / 2.0)).collect();
            ColliderBuilder::convex_hull(&corners).unwrap_or_else(|| panic!("{outline:?} has no area"))
        }
    }
}

fn cuboid([width, height, depth]: [f32; 3]) -> ColliderBuilder {
    ColliderBuilder::cuboid(width / 2.0, height / 2.0, depth / 2.0)
}

fn fixed(platform: &DepthPlatform) -> RigidBody {
    let [x, underside, z] = platform.position;
    let centre = Vector::new(x, underside + platform.size[1] / 2.0, z);
    let rotation = Rotation::from_rotation_z(-platform.rotation);
    RigidBodyBuilder::fixed().pose(Pose::from_parts(centre, rotation)).build()
}

/// Returns the collider of a platform: a cuboid, or the convex hull of the eight corners if the platform's edges in depth are
/// not parallel to Z.
fn platform_collider(platform: &DepthPlatform) -> ColliderBuilder {
    if platform.angle_in_z_axis == SCREEN_ANGLE {
        return with_surface(cuboid(platform.size), platform.surface);
    }
    let cotangent = |degrees: i32| 1.0 / f64::from(degrees).to_radians().tan();
    let shear = (cotangent(platform.angle_in_z_axis) - cotangent(SCREEN_ANGLE)) as f32;
    // The shift of the edges along X of the world, in the axes of the tilted box.
    let (sine, cosine) = platform.rotation.sin_cos();
    let half = platform.size.map(|extent| extent / 2.0);
    let corners = std::array::from_fn::<_, 8, _>(|index| {
        let [x, y, z] = [0, 1, 2].map(|axis| if index >> axis & 1 == 0 { -half[axis] } else { half[axis] });
        Vector::new(x + shear * z * cosine, y + shear * z * sine, z)
    });
    let hull = ColliderBuilder::convex_hull(&corners).unwrap_or_else(|| panic!("{platform:?} has no volume"));
    with_surface(hull, platform.surface)
}

fn with_surface(collider: ColliderBuilder, surface: Surface) -> ColliderBuilder {
    collider
        .friction(surface.friction)
        .friction_combine_rule(CoefficientCombineRule::Average)
        .restitution(surface.restitution)
        .restitution_combine_rule(CoefficientCombineRule::Average)
}

impl World for Rapier {
    fn step(&mut self, dt: f32) {
        self.world.integration_parameters.dt = dt;
        self.world.step();
    }

    fn body(&self, index: usize) -> BodyState {
        let body = &self.world.bodies[self.objects[index]];
        let (centre, turn) = (body.translation(), body.rotation());
        let angle = wrapped(-2.0 * f64::from(turn.z).atan2(f64::from(turn.w)));
        let below = self.outlines[index].at(angle);
        BodyState {
            position: [f64::from(centre.x), f64::from(centre.y) - below, f64::from(centre.z)],
            angle,
            velocity: body.linvel().to_array().map(f64::from),
            angular_velocity: -f64::from(body.angvel().z),
        }
    }

    fn body_count(&self) -> usize {
        self.objects.len()
    }

    /// Returns the height in px of the first surface below the centre of object `index`; `None` if there is none.
    fn height_beneath(&self, index: usize) -> Option<f64> {
        let middle = self.world.bodies[self.objects[index]].translation();
        let is_surface =
            |collider: ColliderHandle, _: &Collider| !matches!(self.met(collider), ContactPartner::Object(_));
        let filter = QueryFilter::new().predicate(&is_surface);
        let ray = Ray::new(middle, -Vector::Y);
        let (_, distance) = self.world.cast_ray(&ray, f32::MAX, true, filter)?;
        Some(f64::from(middle.y - distance))
    }

    fn touching(&self, pairs: &mut Vec<(ContactPartner, ContactPartner)>) {
        for pair in self.world.narrow_phase.contact_pairs() {
            if pair.total_impulse_magnitude() > 0.0 {
                pairs.push(ContactPartner::pair(self.met(pair.collider1), self.met(pair.collider2)));
            }
        }
    }
}
