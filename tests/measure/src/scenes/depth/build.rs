//! Builds a 2.5D scene in `twohalf`.

use farseer_core::{Body, BodyFactory, GeomPlacement, JointFactory, SliderJoint, Vertices};
use twohalf::{
    BodyId, DepthProfile, DepthScheme, Platform, Result, TwoHalfPhysicsSimulator, Vector2, Vector3,
};

use super::{DepthObject, DepthPlatform, DepthScene, DepthShape, SCREEN_ANGLE, Surface};

/// Height of the screen in px.
const SCREEN_HEIGHT: i32 = 600;
/// Number of edges of the polygon that stands for a ball's outline.
const EDGES: i32 = 24;

/// Builds a scene with the default [`DepthScheme`] of a new simulator. Returns the simulator and the bodies in the order of
/// the scene's objects. The simulator has the platforms in the order of the scene.
///
/// # Panics
/// The scene has values that the engine rejects. No scene of this module has.
pub fn build(scene: &DepthScene) -> (TwoHalfPhysicsSimulator, Vec<BodyId>) {
    build_with(scene, DepthScheme::default())
}

/// Builds a scene with the depth scheme `scheme`. Returns the simulator and the bodies in the order of the scene's objects.
///
/// # Panics
/// The scene has values that the engine rejects.
pub fn build_with(scene: &DepthScene, scheme: DepthScheme) -> (TwoHalfPhysicsSimulator, Vec<BodyId>) {
    try_build(scene, scheme).unwrap_or_else(|error| panic!("{}: {error}", scene.name))
}

fn try_build(scene: &DepthScene, scheme: DepthScheme) -> Result<(TwoHalfPhysicsSimulator, Vec<BodyId>)> {
    let gravity = Vector2::new(0.0, scene.gravity);
    let mut simulator =
        TwoHalfPhysicsSimulator::with_angle_and_gravity(SCREEN_HEIGHT, SCREEN_ANGLE, gravity)?;
    simulator.set_depth_scheme(scheme)?;
    let bodies: Vec<BodyId> = scene
        .objects
        .iter()
        .map(|object| add_object(&mut simulator, object, scene.ground))
        .collect::<Result<_>>()?;
    for platform in &scene.platforms {
        add_platform(&mut simulator, platform)?;
    }
    for (number, rope) in scene.ropes.iter().enumerate() {
        let rope: Vec<BodyId> = rope.iter().map(|&object| bodies[object]).collect();
        connect_rope(&mut simulator, &rope, -1 - number as i32)?;
    }
    Ok((simulator, bodies))
}

fn add_object(
    simulator: &mut TwoHalfPhysicsSimulator,
    object: &DepthObject,
    ground: Surface,
) -> Result<BodyId> {
    let body = simulator.create_body(object.body()?);
    let geom = simulator.create_geom(body, object.outline()?, GeomPlacement::default())?;
    simulator.set_depth_profile(geom, object.profile())?;
    if let Some(settings) = simulator.geom_mut(geom) {
        settings.set_friction_coefficient(object.surface.friction);
        settings.set_restitution_coefficient(object.surface.restitution);
    }
    if let Some(mut view) = simulator.body_mut(body) {
        let mut view_of_ground = view.ground_mut();
        view_of_ground.set_friction_coefficient(ground.friction);
        view_of_ground.set_restitution_coefficient(ground.restitution);
        view_of_ground.set_object_geom(geom, None)?;
        view.set_rotation(object.rotation);
        view.set_position3d(Vector3::from(object.position));
        let [right, up, into] = object.velocity;
        view.set_linear_velocity(Vector2::new(right, -up));
        view.set_linear_velocity_z(into);
        view.set_is_static(object.is_static);
    }
    simulator.add(body)?;
    simulator.add(geom)?;
    Ok(body)
}

/// Connects the bodies of a rope, in order, by joints that limit their distances, and puts their geoms into the collision
/// group `group`.
fn connect_rope(simulator: &mut TwoHalfPhysicsSimulator, rope: &[BodyId], group: i32) -> Result<()> {
    for &body in rope {
        for geom in simulator.core().geoms_of(body).to_vec() {
            if let Some(settings) = simulator.geom_mut(geom) {
                settings.set_collision_group(group);
            }
        }
    }
    for two in rope.windows(2) {
        let length = (centre(simulator, two[1]) - centre(simulator, two[0])).norm();
        simulator.edit_objects(|objects| {
            let zero = Vector2::zeros();
            let joint = JointFactory::create_slider_joint(objects, two[0], zero, two[1], zero, 0.0, length)?;
            objects.joint_as_mut::<SliderJoint>(joint)?.set_slop(0.0)?;
            objects.add(joint)
        })?;
    }
    Ok(())
}

fn centre(simulator: &TwoHalfPhysicsSimulator, body: BodyId) -> Vector3 {
    let middle = simulator.core().body(body).map_or(Vector2::zeros(), |body| body.position());
    let z = simulator.body(body).map_or(0.0, |body| body.position3d().z);
    Vector3::new(middle.x, -middle.y, z)
}

fn add_platform(simulator: &mut TwoHalfPhysicsSimulator, platform: &DepthPlatform) -> Result<()> {
    let [width, height, depth] = platform.size;
    let id = Platform::with_rotation_and_angle(
        simulator,
        width,
        height,
        depth,
        Vector3::from(platform.position),
        platform.rotation,
        None,
        platform.angle_in_z_axis,
    )?;
    if let Some(mut view) = simulator.platform_mut(id) {
        view.set_friction_coefficient(platform.surface.friction);
        view.set_restitution_coefficient(platform.surface.restitution);
    }
    Ok(())
}

impl DepthObject {
    /// Returns a body of the 2D engine with the object's mass (kg) and moment of inertia (kg px²), without drag.
    ///
    /// # Errors
    /// The engine rejects the size or the mass.
    pub fn body(&self) -> farseer_core::Result<Body> {
        let mut body = match &self.shape {
            DepthShape::Ball { radius } => BodyFactory::create_circle_body(*radius, self.mass)?,
            DepthShape::Box { size: [width, height, _] } => {
                BodyFactory::create_rectangle_body(*width, *height, self.mass)?
            }
            DepthShape::Polygon { .. } => BodyFactory::create_polygon_body(&self.outline()?, self.mass)?,
        };
        body.set_linear_drag_coefficient(0.0);
        body.set_rotational_drag_coefficient(0.0);
        Ok(body)
    }

    /// Returns the outline at rotation 0, relative to the body's origin, in px with y down.
    ///
    /// # Errors
    /// The engine rejects the size.
    pub fn outline(&self) -> farseer_core::Result<Vertices> {
        match &self.shape {
            DepthShape::Ball { radius } => Vertices::create_circle(*radius, EDGES),
            DepthShape::Box { size: [width, height, _] } => Vertices::create_rectangle(*width, *height),
            DepthShape::Polygon { outline, .. } => Ok(Vertices::from(outline.clone())),
        }
    }

    fn profile(&self) -> DepthProfile {
        match self.shape {
            DepthShape::Ball { radius } => DepthProfile::Round { radius },
            DepthShape::Box { size: [_, _, depth] } | DepthShape::Polygon { depth, .. } => {
                DepthProfile::Prism { depth }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{bounce, box_sliding_down_slope, pile};
    use super::*;

    #[test]
    fn bodies_are_where_the_scene_puts_them() {
        for scene in [bounce(), box_sliding_down_slope(), pile(20)] {
            let (simulator, bodies) = build(&scene);
            for (object, &body) in scene.objects.iter().zip(&bodies) {
                let place = simulator.body(body).unwrap().position3d();
                // The tolerance is the rounding of coordinates up to a few hundred px, moved to the body's origin and back.
                assert!((place - Vector3::from(object.position)).norm() < 1e-4, "{} {place}", scene.name);
            }
        }
    }

    #[test]
    fn velocities_of_the_scene_point_up_and_those_of_the_engine_down() {
        let scene = super::super::throw_in_x_and_z();
        let (simulator, bodies) = build(&scene);
        let body = simulator.body(bodies[0]).unwrap();
        assert_eq!(body.linear_velocity(), Vector2::new(50.0, -100.0));
        assert_eq!(body.linear_velocity_z(), 60.0);
    }
}
