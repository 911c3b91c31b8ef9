//! Chains and tracks of a scene.

use super::{AtPlace, Run};
use crate::scene::{At, Link, PathGeoms, PathKind, PathSpec, SceneError};
use farseer_core::{CollisionCategory, ComplexFactory, LinkType, Path};

type Result<T> = std::result::Result<T, SceneError>;

/// Makes a path, which its factory adds to the simulation.
pub(super) fn create_path(run: &mut Run<'_>, spec: &PathSpec, at: At<'_>) -> Result<()> {
    let path = path(run, spec, at)?;
    run.bodies.extend_from_slice(path.bodies());
    for &geom in path.geoms() {
        run.geoms.push(geom);
        run.log.subscribe(geom, &[]);
        let geom = &mut run.simulator[geom];
        if let Some(friction) = spec.friction {
            geom.set_friction_coefficient(friction);
        }
        if let Some(restitution) = spec.restitution {
            geom.set_restitution_coefficient(restitution);
        }
    }
    run.joints.extend_from_slice(path.joints());
    path.joints().iter().for_each(|&joint| run.log.know_joint(joint));
    run.springs.extend_from_slice(path.springs());
    path.springs().iter().for_each(|&spring| run.log.know_spring(spring));
    Ok(())
}

fn path(run: &mut Run<'_>, spec: &PathSpec, at: At<'_>) -> Result<Path> {
    let factory = ComplexFactory {
        min: spec.min,
        max: spec.max,
        spring_constant: spec.spring_constant,
        damping_constant: spec.damping_constant,
        spring_rest_length_factor: spec.rest_length_factor,
    };
    let link = match spec.link {
        Link::Revolute => LinkType::RevoluteJoint,
        Link::Pin => LinkType::PinJoint,
        Link::Slider => LinkType::SliderJoint,
        Link::LinearSpring => LinkType::LinearSpring,
    };
    let simulator = &mut run.simulator;
    match spec.kind {
        PathKind::Chain { start, end, width, height, link_width, mass, pin_start, pin_end, ref geoms } => {
            let link_width = link_width.unwrap_or(width);
            let mut path = factory
                .create_chain_with_link_width_in(
                    simulator, start, end, width, height, link_width, mass, pin_start, pin_end, link,
                )
                .at(at)?;
            if let Some(geoms) = geoms {
                create_geoms(run, &mut path, geoms, at.key("geoms"))?;
            }
            Ok(path)
        }
        PathKind::Track { ref points, width, height, mass, endless, collision_group } => factory
            .create_track_in(simulator, points, width, height, mass, endless, collision_group, link)
            .at(at),
    }
}

fn create_geoms(run: &mut Run<'_>, path: &mut Path, geoms: &PathGeoms, at: At<'_>) -> Result<()> {
    let simulator = &mut run.simulator;
    match *geoms {
        PathGeoms { collision_group: Some(group), .. } => path.create_geoms_in(simulator, group).at(at),
        PathGeoms { collision_categories: Some(categories), collides_with: Some(with), .. } => {
            let [categories, with] = [categories, with].map(CollisionCategory::from_bits);
            path.create_geoms_with_categories_in(simulator, categories, with).at(at)
        }
        _ => Err(SceneError::format(at, "needs a group, or categories and what they collide with")),
    }
}
