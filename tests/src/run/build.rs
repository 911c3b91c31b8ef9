//! Creation of everything a scene lists.

use super::log::Log;
use super::{AtPlace, Finite, Run, controllers, links, paths};
use crate::scene::{
    At, BodySettings, BodyShape, BodySpec, BroadPhase, Friction, GeomSettings, GeomShape, GeomSpec,
    NarrowPhase, Outline, OutlineForm, Scene, SceneError, SimulatorSettings, SolverSettings,
};
use farseer_core::math::Vector2;
use farseer_core::{
    Body, BodyFactory, BroadPhaseCollider, CollisionCategory, FrictionType, GeomFactory, GeomId,
    GeomPlacement, NarrowPhaseCollider, PhysicsSimulator, Vertices,
};

type Result<T> = std::result::Result<T, SceneError>;

/// Builds a scene up to the state before the first step.
pub(super) fn build(scene: &Scene) -> Result<Run<'_>> {
    let root = At::Root;
    let mut run = Run {
        scene,
        simulator: simulator(&scene.simulator, root.key("simulator"))?,
        bodies: Vec::with_capacity(scene.bodies.len()),
        geoms: Vec::with_capacity(scene.geoms.len()),
        joints: Vec::with_capacity(scene.joints.len()),
        springs: Vec::with_capacity(scene.springs.len()),
        controllers: Vec::with_capacity(scene.controllers.len()),
        log: Log::of(scene),
        dt: scene.dt.finite(root.key("dt"))?,
        dt_real: scene.dt_real.finite(root.key("dt_real"))?,
        scaled_by: None,
    };
    let bodies = root.key("bodies");
    for (index, spec) in scene.bodies.iter().enumerate() {
        create_body(&mut run, spec, bodies.item(index))?;
    }
    let list = root.key("paths");
    for (index, spec) in scene.paths.iter().enumerate() {
        paths::create_path(&mut run, spec, list.item(index))?;
    }
    let geoms = root.key("geoms");
    let mut created = Vec::with_capacity(scene.geoms.len());
    for (index, spec) in scene.geoms.iter().enumerate() {
        created.push(create_geoms(&mut run, spec, geoms.item(index))?);
    }
    for ((index, spec), created) in scene.geoms.iter().enumerate().zip(created) {
        ignore_listed(&mut run, &created, spec, geoms.item(index))?;
    }
    let list = root.key("joints");
    for (index, spec) in scene.joints.iter().enumerate() {
        links::create_joint(&mut run, spec, list.item(index))?;
    }
    let list = root.key("springs");
    for (index, spec) in scene.springs.iter().enumerate() {
        links::create_spring(&mut run, spec, list.item(index))?;
    }
    let list = root.key("controllers");
    for (index, spec) in scene.controllers.iter().enumerate() {
        controllers::create_controller(&mut run, spec, list.item(index))?;
    }
    run.scaled_by = controllers::scaled_by(&run)?;
    run.simulator.process_added_and_removed();
    Ok(run)
}

fn simulator(settings: &SimulatorSettings, at: At<'_>) -> Result<PhysicsSimulator> {
    let gravity = settings.gravity.unwrap_or_else(Vector2::zeros);
    let mut simulator = PhysicsSimulator::new(gravity).at(at.key("gravity"))?;
    set_detection(&mut simulator, settings.narrow_phase, settings.max_contacts_to_detect);
    set_solver(&mut simulator, &settings.solver, at)?;
    if let Some(broad_phase) = settings.broad_phase.and_then(|method| broad_phase_collider(method, settings))
    {
        simulator.set_broad_phase_collider(broad_phase).at(at.key("broad_phase"))?;
    }
    Ok(simulator)
}

/// The broad phase to set; `None` for the one a simulator starts with.
fn broad_phase_collider(method: BroadPhase, settings: &SimulatorSettings) -> Option<BroadPhaseCollider> {
    match method {
        BroadPhase::SelectiveSweep => None,
        BroadPhase::SweepAndPrune => Some(BroadPhaseCollider::SweepAndPrune),
        BroadPhase::BruteForce => Some(BroadPhaseCollider::BruteForce),
        BroadPhase::SpatialHash => {
            // The original's defaults (behaviour chapter 08).
            let cell_size = settings.cell_size.unwrap_or(50.0);
            let auto_adjust_cell_size = settings.auto_adjust_cell_size.unwrap_or(true);
            Some(BroadPhaseCollider::SpatialHash { cell_size, auto_adjust_cell_size })
        }
    }
}

/// The settings that are global in the original.
pub(super) fn set_detection(
    simulator: &mut PhysicsSimulator,
    narrow_phase: Option<NarrowPhase>,
    max_contacts_to_detect: Option<i32>,
) {
    if let Some(narrow_phase) = narrow_phase {
        simulator.set_narrow_phase_collider(match narrow_phase {
            NarrowPhase::DistanceGrid => NarrowPhaseCollider::DistanceGrid,
            NarrowPhase::Sat => NarrowPhaseCollider::Sat,
        });
    }
    if let Some(count) = max_contacts_to_detect {
        simulator.set_max_contacts_to_detect(count);
    }
}

pub(super) fn set_solver(
    simulator: &mut PhysicsSimulator,
    settings: &SolverSettings,
    at: At<'_>,
) -> Result<()> {
    if let Some(iterations) = settings.iterations {
        simulator.set_iterations(iterations);
    }
    if let Some(factor) = settings.bias_factor {
        simulator.set_bias_factor(factor).at(at.key("bias_factor"))?;
    }
    if let Some(penetration) = settings.allowed_penetration {
        simulator.set_allowed_penetration(penetration).at(at.key("allowed_penetration"))?;
    }
    if let Some(count) = settings.max_contacts_to_resolve {
        simulator.set_max_contacts_to_resolve(count).at(at.key("max_contacts_to_resolve"))?;
    }
    if let Some(friction) = settings.friction_type {
        simulator.set_friction_type(match friction {
            Friction::Average => FrictionType::Average,
            Friction::Minimum => FrictionType::Minimum,
        });
    }
    Ok(())
}

/// Creates a body, configures it and adds it unless the scene says otherwise.
pub(super) fn create_body(run: &mut Run<'_>, spec: &BodySpec, at: At<'_>) -> Result<()> {
    let mut body = body(run, &spec.shape, at.key("shape"))?;
    if let Some(value) = spec.is_static {
        body.set_is_static(value);
    }
    if let Some(position) = spec.position {
        body.set_position(position.finite(at.key("position"))?);
    }
    if let Some(rotation) = spec.rotation {
        body.set_rotation(rotation.finite(at.key("rotation"))?);
    }
    set_body(&mut body, &spec.settings, at)?;
    let body = run.simulator.create_body(body);
    run.bodies.push(body);
    if spec.in_simulation { run.simulator.add(body).at(at) } else { Ok(()) }
}

fn body(run: &Run<'_>, shape: &BodyShape, at: At<'_>) -> Result<Body> {
    match *shape {
        BodyShape::Rectangle { width, height, mass } => {
            BodyFactory::create_rectangle_body(width, height, mass).at(at)
        }
        BodyShape::Circle { radius, mass } => BodyFactory::create_circle_body(radius, mass).at(at),
        BodyShape::Ellipse { x_radius, y_radius, mass } => {
            BodyFactory::create_ellipse_body(x_radius, y_radius, mass).at(at)
        }
        BodyShape::Polygon { ref outline, mass } => {
            let vertices = vertices(outline, at.key("outline"))?;
            BodyFactory::create_polygon_body(&vertices, mass).at(at)
        }
        BodyShape::Explicit { mass, moment_of_inertia } => {
            BodyFactory::create_body(mass, moment_of_inertia).at(at)
        }
        BodyShape::Clone { of } => {
            let original = run.body(of, at.key("of"))?;
            let original = run.simulator.body(original);
            let original =
                original.ok_or_else(|| SceneError::format(at.key("of"), format!("body {of} is disposed")))?;
            Ok(BodyFactory::create_body_from(original))
        }
    }
}

/// Sets the given settings of a body.
pub(super) fn set_body(body: &mut Body, settings: &BodySettings, at: At<'_>) -> Result<()> {
    if let Some(velocity) = settings.linear_velocity {
        body.set_linear_velocity(velocity.finite(at.key("linear_velocity"))?);
    }
    if let Some(velocity) = settings.angular_velocity {
        body.set_angular_velocity(velocity.finite(at.key("angular_velocity"))?);
    }
    if let Some(drag) = settings.linear_drag {
        body.set_linear_drag_coefficient(drag.finite(at.key("linear_drag"))?);
    }
    if let Some(drag) = settings.rotational_drag {
        body.set_rotational_drag_coefficient(drag.finite(at.key("rotational_drag"))?);
    }
    if let Some(enabled) = settings.quadratic_drag_enabled {
        body.set_is_quadratic_drag_enabled(enabled);
    }
    if let Some(drag) = settings.quadratic_drag {
        body.set_quadratic_drag_coefficient(drag.finite(at.key("quadratic_drag"))?);
    }
    if let Some(ignore) = settings.ignore_gravity {
        body.set_ignore_gravity(ignore);
    }
    if let Some(enabled) = settings.enabled {
        body.set_enabled(enabled);
    }
    if let Some(auto_idle) = settings.auto_idle {
        body.set_is_auto_idle(auto_idle);
    }
    if let Some(velocity) = settings.minimum_velocity {
        body.set_minimum_velocity(velocity.finite(at.key("minimum_velocity"))?);
    }
    Ok(())
}

/// Creates the geoms of an entry, configures them and adds them unless the scene says otherwise.
pub(super) fn create_geoms(run: &mut Run<'_>, spec: &GeomSpec, at: At<'_>) -> Result<Vec<GeomId>> {
    let geoms = geoms(run, spec, at)?;
    for &geom in &geoms {
        set_geom(&mut run.simulator, geom, &spec.settings, at)?;
        run.geoms.push(geom);
        run.log.subscribe(geom, &spec.veto);
        if spec.in_simulation {
            run.simulator.add(geom).at(at)?;
        }
    }
    Ok(geoms)
}

fn geoms(run: &mut Run<'_>, spec: &GeomSpec, at: At<'_>) -> Result<Vec<GeomId>> {
    let body = run.body(spec.body, at.key("body"))?;
    let placement = GeomPlacement {
        offset: spec.offset.unwrap_or_else(Vector2::zeros),
        rotation_offset: spec.rotation_offset.unwrap_or(0.0),
        collision_grid_size: spec.collision_grid_size.unwrap_or(0.0),
    };
    let shape = at.key("shape");
    let outline_at = shape.key("outline");
    let simulator = &mut run.simulator;
    let geom = match spec.shape {
        GeomShape::Rectangle { width, height } => {
            GeomFactory::create_rectangle_geom(simulator, body, width, height, placement)
        }
        GeomShape::Circle { radius, edges } => {
            GeomFactory::create_circle_geom(simulator, body, radius, edges, placement)
        }
        GeomShape::Ellipse { x_radius, y_radius, edges } => {
            GeomFactory::create_ellipse_geom(simulator, body, x_radius, y_radius, edges, placement)
        }
        GeomShape::Polygon { ref outline } => {
            let mut vertices = vertices(outline, outline_at)?;
            GeomFactory::create_polygon_geom(simulator, body, &mut vertices, placement)
        }
        GeomShape::Raw { ref outline } => {
            simulator.create_geom(body, vertices(outline, outline_at)?, placement)
        }
        GeomShape::Decomposed { ref outline, pieces } => {
            let vertices = vertices(outline, outline_at)?;
            return GeomFactory::create_sat_polygon_geom(simulator, body, &vertices, pieces).at(shape);
        }
        GeomShape::Clone { of } => {
            let original = run.geom(of, shape.key("of"))?;
            let simulator = &mut run.simulator;
            match (spec.offset, spec.rotation_offset) {
                (None, None) => GeomFactory::create_geom_from(simulator, body, original),
                _ => GeomFactory::create_geom_from_with_offset(
                    simulator,
                    body,
                    original,
                    placement.offset,
                    placement.rotation_offset,
                ),
            }
        }
    };
    Ok(vec![geom.at(shape)?])
}

/// Sets the given settings of a geom.
pub(super) fn set_geom(
    simulator: &mut PhysicsSimulator,
    id: GeomId,
    settings: &GeomSettings,
    at: At<'_>,
) -> Result<()> {
    let geom = &mut simulator[id];
    if let Some(friction) = settings.friction {
        geom.set_friction_coefficient(friction.finite(at.key("friction"))?);
    }
    if let Some(restitution) = settings.restitution {
        geom.set_restitution_coefficient(restitution.finite(at.key("restitution"))?);
    }
    if let Some(group) = settings.collision_group {
        geom.set_collision_group(group);
    }
    if let Some(categories) = settings.collision_categories {
        geom.set_collision_categories(CollisionCategory::from_bits(categories));
    }
    if let Some(categories) = settings.collides_with {
        geom.set_collides_with(CollisionCategory::from_bits(categories));
    }
    if let Some(enabled) = settings.collision_enabled {
        geom.set_collision_enabled(enabled);
    }
    if let Some(enabled) = settings.collision_response_enabled {
        geom.set_collision_response_enabled(enabled);
    }
    match settings.sensor {
        Some(sensor) => simulator.set_is_sensor(id, sensor).at(at.key("sensor")),
        None => Ok(()),
    }
}

/// Makes the geoms of an entry ignore the geoms it lists.
pub(super) fn ignore_listed(run: &mut Run<'_>, geoms: &[GeomId], spec: &GeomSpec, at: At<'_>) -> Result<()> {
    let list = at.key("ignore");
    for &geom in geoms {
        for (index, &other) in spec.ignore.iter().enumerate() {
            ignore(run, geom, other, list.item(index))?;
        }
    }
    Ok(())
}

/// Makes a geom ignore another one; a disposed one is ignored already.
pub(super) fn ignore(run: &mut Run<'_>, geom: GeomId, other: usize, at: At<'_>) -> Result<()> {
    let other = run.geom(other, at)?;
    match run.simulator.geom(other) {
        Some(_) => run.simulator.ignore_collision_with(geom, other).at(at),
        None => Ok(()),
    }
}

/// The vertices of an outline, made afresh.
pub(super) fn vertices(outline: &Outline, at: At<'_>) -> Result<Vertices> {
    let made = match outline.form {
        OutlineForm::Rectangle { width, height } => Vertices::create_rectangle(width, height),
        OutlineForm::SimpleRectangle { width, height } => Vertices::create_simple_rectangle(width, height),
        OutlineForm::Circle { radius, edges } => Vertices::create_circle(radius, edges),
        OutlineForm::Ellipse { x_radius, y_radius, edges } => {
            Vertices::create_ellipse(x_radius, y_radius, edges)
        }
        OutlineForm::Gear { radius, teeth, tip_percentage, tooth_height } => {
            Vertices::create_gear(radius, teeth, tip_percentage, tooth_height)
        }
        OutlineForm::Capsule { height, top_radius, top_edges, bottom_radius, bottom_edges } => {
            Vertices::create_capsule_ends(height, top_radius, top_edges, bottom_radius, bottom_edges)
        }
        OutlineForm::Points { ref points } => {
            let list = at.key("points");
            for (index, point) in points.iter().enumerate() {
                point.finite(list.item(index))?;
            }
            Ok(points.iter().copied().collect())
        }
    };
    let mut vertices = made.at(at)?;
    if let Some(length) = outline.subdivide {
        vertices.sub_divide_edges(length).at(at.key("subdivide"))?;
    }
    Ok(vertices)
}
