//! The shadows of a scene and the surfaces they lie on.

use twohalf::{BodyId, ContactTarget, Drawable, GeomId, TwoHalfPhysicsSimulator, Vector3};

use super::facet::Facet;
use super::{Look, Scene};
use crate::shadow::Shadow;
use crate::surface::{edge, edge_of_platform, to_screen};
use crate::{Color, Point, Sprite};

/// Width and height of the shadow picture that is stretched over footprints, px.
pub(super) const SHADOW_SIZE: [u32; 2] = [32, 16];

/// Size of a shadow as a ratio to its footprint. It is greater than 1, since the picture fades towards its
/// edge.
const SPREAD: f32 = 1.2;
/// Depth of the shadow of a flat picture as a ratio to the depth of its footprint.
const FLATNESS: f32 = 0.6;
/// Colour of the shadow of a platform.
const DARKNESS: Color = Color::rgba(0, 0, 0, 70);
/// Greatest tilt of a top that takes shadows, radians.
const LEVEL: f32 = 0.01;

/// A shadow, the body or platform that casts it, and the surface it lies on; the ground if `None`.
pub(super) struct Cast {
    pub(super) of: Drawable,
    pub(super) surface: Option<Drawable>,
    /// Height of its middle, px.
    pub(super) height: f32,
    pub(super) sprite: Sprite,
}

impl Cast {
    pub(super) fn all(scene: &Scene<'_>, things: &[(Drawable, Look)]) -> Vec<Cast> {
        let simulator = scene.simulator;
        let tops: Vec<(BodyId, GeomId)> = things.iter().flat_map(|thing| tops(simulator, thing)).collect();
        let bodies = things.iter().filter_map(|(thing, look)| match (thing, look) {
            (_, Look::Nothing | Look::Line { .. }) | (Drawable::Platform(_), _) => None,
            (Drawable::Body(id), look) => of_body(scene, *id, look, &tops),
        });
        let tops = tops.iter().filter_map(|&(id, top)| Some(Facet::top(id, &simulator.geom(top)?)));
        let mut facets: Vec<Facet> = tops.collect();
        let platforms = things.iter().filter_map(|(thing, look)| match (thing, look) {
            (Drawable::Platform(id), Look::Solid(_) | Look::Textured(..)) => {
                Some((*thing, scene.corners(*id)?))
            }
            _ => None,
        });
        let platforms: Vec<(Drawable, [Vector3; 8])> = platforms.collect();
        facets.extend(platforms.iter().flat_map(|(on, corners)| Facet::looking_up(*on, corners)));
        let of_platforms =
            platforms.iter().flat_map(|(of, corners)| of_platform(simulator, *of, corners, &facets));
        of_platforms.chain(bodies).collect()
    }
}

/// The level tops of a solid body.
fn tops(simulator: &TwoHalfPhysicsSimulator, (thing, look): &(Drawable, Look)) -> Vec<(BodyId, GeomId)> {
    let (Drawable::Body(id), Look::Solid(_) | Look::Textured(..)) = (thing, look) else { return Vec::new() };
    let Some(body) = simulator.body(*id) else { return Vec::new() };
    let quarter = std::f32::consts::FRAC_PI_2;
    let tilt = (body.rotation() + 0.5 * quarter).rem_euclid(quarter) - 0.5 * quarter;
    let has_top = |&&geom: &&GeomId| simulator.geom(geom).is_some_and(|geom| geom.virtual_geom().has_top);
    let solids = simulator.core().geoms_of(*id).iter().filter(has_top);
    if tilt.abs() > LEVEL { Vec::new() } else { solids.map(|&geom| (*id, geom)).collect() }
}

/// The shadows of a platform: on the ground and, if it hangs in the air, on all surfaces beneath it.
fn of_platform(
    simulator: &TwoHalfPhysicsSimulator,
    of: Drawable,
    corners: &[Vector3; 8],
    facets: &[Facet],
) -> Vec<Cast> {
    let underside = Facet::underside(of, corners);
    let on_ground = underside.corners.iter().map(|corner| Vector3::new(corner.x, 0.0, corner.z));
    let on_ground: Vec<Point> = on_ground.map(|corner| to_screen(simulator, corner)).collect();
    let mut casts =
        vec![Cast { of, surface: None, height: 0.0, sprite: Sprite::polygon(on_ground, DARKNESS) }];
    if corners.iter().all(|corner| corner.y > 0.0) {
        casts.extend(facets.iter().filter(|facet| facet.of != of).filter_map(|facet| {
            let (shaded, height) = facet.shaded_by(&underside, simulator)?;
            Some(Cast { of, surface: Some(facet.of), height, sprite: Sprite::polygon(shaded, DARKNESS) })
        }));
    }
    casts
}

/// The shadow of a body: on the ground, a platform, or one of these tops.
fn of_body(scene: &Scene<'_>, id: BodyId, look: &Look, tops: &[(BodyId, GeomId)]) -> Option<Cast> {
    let (simulator, texture) = (scene.simulator, scene.shadow);
    let object = simulator.body(id)?.ground().object_geom()?;
    let geom = simulator.geom(object)?;
    let (shape, middle) = (geom.virtual_geom(), geom.position3d());
    let body_of = |geom: GeomId| tops.iter().find(|(_, top)| *top == geom).map(|(body, _)| *body);
    let surface = simulator.surface_beneath_where(middle, |partner| match partner {
        ContactTarget::Geom(geom) => body_of(geom).is_some_and(|body| body != id),
        ContactTarget::Platform(_) | ContactTarget::Ground => true,
    })?;
    let on = match surface.partner {
        ContactTarget::Geom(geom) => body_of(geom).map(Drawable::Body),
        ContactTarget::Platform(platform) => Some(Drawable::Platform(platform)),
        ContactTarget::Ground => None,
    };
    let flat = matches!(look, Look::Picture(_) | Look::Figure(_) | Look::Ball(_));
    let depth = (shape.back - shape.front) * if flat { FLATNESS } else { 1.0 };
    let size = [shape.right - shape.left, depth];
    let picture = [texture.width() as f32, texture.height() as f32];
    let shadow = Shadow {
        texture,
        position_offset: [0.0; 2],
        scale: [0, 1].map(|axis| SPREAD * size[axis] / picture[axis]),
        color_tint: Color::WHITE,
        layer_depth: 0.0,
    };
    let edge = match surface.partner {
        ContactTarget::Platform(platform) => {
            Some(edge_of_platform(simulator, &scene.corners(platform)?, &surface))
        }
        _ => edge(simulator, &surface, middle.x),
    };
    Some(Cast {
        of: Drawable::Body(id),
        surface: on,
        height: surface.height,
        sprite: shadow.sprite(simulator, &surface, edge, middle, Some(shape.bottom)),
    })
}
