//! Which shadows a scene has, and on what they lie.

use twohalf::{BodyId, Drawable, Partner, TwoHalfPhysicsSimulator, Vector3, VirtualGeom};

use super::Look;
use super::facet::Facet;
use crate::shadow::{Lit, Shadow};
use crate::surface::to_screen;
use crate::{Color, Point, Sprite, Texture2D};

/// Of the picture that is stretched over footprints, px.
pub(super) const SHADOW_SIZE: [u32; 2] = [32, 16];

/// How much larger than its footprint the shadow of a thing is: its picture fades towards its edge.
const SPREAD: f32 = 1.2;
/// How deep the shadow of a flat picture is, to the depth of its footprint.
const FLATNESS: f32 = 0.6;
/// What rests lies in what is beneath it, up to this many px.
pub(super) const SUNK: f32 = 2.0;
/// The shadow of a platform.
const DARKNESS: Color = Color::rgba(0, 0, 0, 70);
/// Tops that are tilted by more than this, rad, take no shadow.
const LEVEL: f32 = 0.01;

/// A shadow, what casts it, and what it lies on: the ground if nothing.
pub(super) struct Cast {
    pub(super) of: Drawable,
    pub(super) surface: Option<Drawable>,
    pub(super) sprite: Sprite,
}

impl Cast {
    pub(super) fn all(
        simulator: &TwoHalfPhysicsSimulator,
        texture: &Texture2D,
        things: &[(Drawable, Look)],
    ) -> Vec<Cast> {
        let tops: Vec<(BodyId, VirtualGeom)> =
            things.iter().flat_map(|thing| tops(simulator, thing)).collect();
        let bodies = things.iter().filter_map(|(thing, look)| match (thing, look) {
            (_, Look::Nothing | Look::Line { .. }) | (Drawable::Platform(_), _) => None,
            (Drawable::Body(id), look) => of_body(simulator, texture, *id, look, &tops),
        });
        let mut facets: Vec<Facet> = tops.iter().map(|(id, top)| Facet::top(*id, top)).collect();
        let platforms = things.iter().filter_map(|(thing, look)| match (thing, look) {
            (Drawable::Platform(id), Look::Solid(_) | Look::Textured(..)) => {
                Some((*thing, simulator.platform(*id)?.corners()))
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
fn tops(simulator: &TwoHalfPhysicsSimulator, (thing, look): &(Drawable, Look)) -> Vec<(BodyId, VirtualGeom)> {
    let (Drawable::Body(id), Look::Solid(_) | Look::Textured(..)) = (thing, look) else { return Vec::new() };
    let Some(body) = simulator.body(*id) else { return Vec::new() };
    let quarter = std::f32::consts::FRAC_PI_2;
    let tilt = (body.rotation() + 0.5 * quarter).rem_euclid(quarter) - 0.5 * quarter;
    let geoms = simulator.core().geoms_of(*id).iter().filter_map(|&geom| simulator.geom(geom));
    let solids = geoms.map(|geom| geom.virtual_geom()).filter(|shape| shape.has_top);
    if tilt.abs() > LEVEL { Vec::new() } else { solids.map(|shape| (*id, shape)).collect() }
}

/// The shadows of a platform: on the ground, and, if it hangs in the air, on all that is beneath it.
fn of_platform(
    simulator: &TwoHalfPhysicsSimulator,
    of: Drawable,
    corners: &[Vector3; 8],
    facets: &[Facet],
) -> Vec<Cast> {
    let underside = Facet::underside(of, corners);
    let on_ground = underside.corners.iter().map(|corner| Vector3::new(corner.x, 0.0, corner.z));
    let on_ground: Vec<Point> = on_ground.map(|corner| to_screen(simulator, corner)).collect();
    let mut casts = vec![Cast { of, surface: None, sprite: Sprite::polygon(on_ground, DARKNESS) }];
    if corners.iter().all(|corner| corner.y > 0.0) {
        casts.extend(facets.iter().filter(|facet| facet.of != of).filter_map(|facet| {
            let shaded = facet.shaded_by(&underside, simulator)?;
            Some(Cast { of, surface: Some(facet.of), sprite: Sprite::polygon(shaded, DARKNESS) })
        }));
    }
    casts
}

/// Whether something with a top is below a point, or above it.
fn covers(top: &VirtualGeom, point: Vector3) -> bool {
    let half = [0.5 * (top.right - top.left), 0.5 * (top.back - top.front)];
    let [x, z] = [(point.x - top.left) / half[0] - 1.0, (point.z - top.front) / half[1] - 1.0];
    if top.is_round { x * x + z * z <= 1.0 } else { x.abs() <= 1.0 && z.abs() <= 1.0 }
}

fn of_body(
    simulator: &TwoHalfPhysicsSimulator,
    texture: &Texture2D,
    id: BodyId,
    look: &Look,
    tops: &[(BodyId, VirtualGeom)],
) -> Option<Cast> {
    let object = simulator.body(id)?.ground().object_geom()?;
    let geom = simulator.geom(object)?;
    let (shape, middle) = (geom.virtual_geom(), geom.position3d());
    let surface = simulator.surface_beneath(middle)?;
    let is_beneath = |(other, top): &&(BodyId, VirtualGeom)| {
        *other != id && covers(top, middle) && (surface.height..=shape.bottom + SUNK).contains(&top.top)
    };
    let highest = tops.iter().filter(is_beneath).max_by(|a, b| a.1.top.total_cmp(&b.1.top));
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
    let (on, lit) = match (highest, surface.partner) {
        (Some((other, top)), _) => (Some(Drawable::Body(*other)), Lit::top(simulator, top)),
        (None, Partner::Platform(platform)) => {
            (Some(Drawable::Platform(platform)), Lit::surface(simulator, &surface))
        }
        (None, _) => (None, Lit::surface(simulator, &surface)),
    };
    Some(Cast {
        of: Drawable::Body(id),
        surface: on,
        sprite: shadow.sprite(simulator, lit, middle, Some(shape.bottom)),
    })
}
