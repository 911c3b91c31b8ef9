//! Platforms of a scene that hide the parts of others inside of them.

use twohalf::{Drawable, PlatformId, Vector3};

use super::{Look, Scene};
use crate::hidden::Solid;

/// The platforms that are drawn as opaque solids, in ascending order of their least X.
pub(super) struct Solids {
    all: Vec<(PlatformId, Solid)>,
    /// Width of the widest one, px.
    widest: f32,
}

impl Solids {
    pub(super) fn all(scene: &Scene<'_>, things: &[(Drawable, Look)]) -> Self {
        let solids = things.iter().filter_map(|(thing, look)| match (thing, look) {
            (Drawable::Platform(id), Look::Solid(look) | Look::Textured(look, _)) if look.is_opaque() => {
                Some((*id, Solid::new(&scene.corners(*id)?).moved(scene.shift(*thing).way)))
            }
            _ => None,
        });
        let mut all: Vec<(PlatformId, Solid)> = solids.collect();
        all.sort_by(|(_, a), (_, b)| a.width()[0].total_cmp(&b.width()[0]));
        let widths = all.iter().map(|(_, solid)| solid.width()).map(|[left, right]| right - left);
        let widest = widths.fold(0.0, f32::max);
        Solids { all, widest }
    }

    /// The other platforms that overlap a platform with these corners, relative to its simulated position.
    /// The platform is drawn displaced by `shift`, px.
    pub(super) fn around(&self, id: PlatformId, corners: Option<[Vector3; 8]>, shift: Vector3) -> Vec<Solid> {
        let Some(own) = corners.map(|corners| Solid::new(&corners).moved(shift)) else { return Vec::new() };
        let [left, right] = own.width();
        let first = self.all.partition_point(|(_, solid)| solid.width()[0] < left - self.widest);
        let near = self.all[first..].iter().take_while(|(_, solid)| solid.width()[0] <= right);
        let overlapping = near.filter(|(other, solid)| *other != id && solid.overlaps(&own));
        overlapping.map(|(_, solid)| solid.moved(-shift)).collect()
    }
}
