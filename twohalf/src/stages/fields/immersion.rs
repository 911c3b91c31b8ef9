//! Immersed volume of a geom in a box of the world, and its centroid.

use farseer_core::depth::VerticalShape;
use farseer_core::{BodyId, GeomId, PhysicsSimulator};

use crate::Vector3;
use crate::depth::upright::{depths as depths_of, half_height, middle as middle_of, span};
use crate::depth::{DepthProfile, DepthState, Fluid, Region};

/// Buffers for clipping an outline by the sides of a box.
#[derive(Debug, Clone, Default)]
pub(crate) struct ClipBuffer {
    outline: Vec<[f64; 2]>,
    kept: Vec<[f64; 2]>,
}

/// The immersed part of a geom.
#[derive(Debug, Clone, Copy)]
pub(super) struct Immersed {
    /// Volume of the immersed part, px³.
    pub(super) volume: f64,
    /// Centroid of the immersed part in the plane, px, y down.
    pub(super) middle: [f64; 2],
}

/// A box in the frame of the plane, px, y down.
#[derive(Debug, Clone, Copy)]
pub(super) struct Container {
    low: [f64; 3],
    high: [f64; 3],
}

impl Container {
    pub(super) fn new(region: &Region) -> Self {
        let ([lx, ly, lz], [hx, hy, hz]): ([f32; 3], [f32; 3]) = (region.low().into(), region.high().into());
        Container { low: [lx, -hy, lz].map(f64::from), high: [hx, -ly, hz].map(f64::from) }
    }

    /// Length of an interval inside the box along an axis, px.
    fn within(&self, axis: usize, [low, high]: [f64; 2]) -> f64 {
        (high.min(self.high[axis]) - low.max(self.low[axis])).max(0.0)
    }

    /// Returns the immersed part of a ball: exact between surface and bottom, and in proportion to the immersed width at the
    /// sides.
    fn of_ball(&self, [x, y, z]: [f64; 3], radius: f64) -> Immersed {
        let below = |depth: f64| {
            let depth = depth.clamp(0.0, 2.0 * radius);
            std::f64::consts::PI * depth * depth * (3.0 * radius - depth) / 3.0
        };
        let (bottom, top) = (y + radius, y - radius);
        let volume = (below(bottom - self.low[1]) - below(bottom - self.high[1])).max(0.0);
        let beside = |axis: usize, at: f64| self.within(axis, [at - radius, at + radius]) / (2.0 * radius);
        // Buoyancy of a ball acts below its centre and causes no torque.
        let middle = 0.5 * (top.max(self.low[1]) + bottom.min(self.high[1]));
        Immersed { volume: volume * beside(0, x) * beside(2, z), middle: [x, middle] }
    }

    /// Returns the immersed part of an upright shape: exact in height, and in proportion to the immersed width at the sides. A
    /// capsule counts as a cylinder of its volume.
    fn of_upright(&self, shape: &VerticalShape, middle: Vector3) -> Option<Immersed> {
        let [x, y, z] = [middle.x, middle.y, middle.z].map(f64::from);
        let half = f64::from(half_height(shape));
        let part = |axis: usize, at: f64, [low, high]: [f32; 2]| {
            let ends = [at + f64::from(low), at + f64::from(high)];
            self.within(axis, ends) / (ends[1] - ends[0])
        };
        let beside = part(0, x, span(shape)) * part(2, z, depths_of(shape));
        let (top, bottom) = ((y - half).max(self.low[1]), (y + half).min(self.high[1]));
        let volume = area_of(shape) * (bottom - top) * beside;
        (volume > 0.0).then_some(Immersed { volume, middle: [x, 0.5 * (top + bottom)] })
    }

    /// The immersed part of an extruded outline, exact.
    fn of_prism(
        &self,
        outline: impl Iterator<Item = [f64; 2]>,
        depths: [f64; 2],
        scratch: &mut ClipBuffer,
    ) -> Option<Immersed> {
        let deep = self.within(2, depths);
        if deep == 0.0 {
            return None;
        }
        scratch.outline.clear();
        scratch.outline.extend(outline);
        for (axis, bound, sign) in
            [(0, self.low[0], 1.0), (0, self.high[0], -1.0), (1, self.low[1], 1.0), (1, self.high[1], -1.0)]
        {
            scratch.cut(|corner| sign * (corner[axis] - bound));
        }
        let (area, middle) = area_and_middle(&scratch.outline)?;
        Some(Immersed { volume: area * deep, middle })
    }
}

/// Returns the footprint area of an upright shape, px². The area of a capsule is reduced so that area times height is its
/// volume.
fn area_of(shape: &VerticalShape) -> f64 {
    let disc = |radius: f32| std::f64::consts::PI * f64::from(radius) * f64::from(radius);
    match shape {
        VerticalShape::Cylinder { radius, .. } => disc(*radius),
        // The two ends of radius r lack the volume 2/3 pi r³ of a cylinder of height 2 h.
        VerticalShape::Capsule { radius, half_height } => {
            disc(*radius) * (1.0 - f64::from(*radius) / (3.0 * f64::from(*half_height)))
        }
        VerticalShape::Prism { footprint, .. } => {
            let corners: Vec<[f64; 2]> =
                footprint.corners().iter().map(|corner| [corner.x, corner.y].map(f64::from)).collect();
            area_and_middle(&corners).map_or(0.0, |(area, _)| area)
        }
    }
}

impl ClipBuffer {
    /// Clips the outline by a line (I. Sutherland, G. Hodgman, "Reentrant polygon clipping", 1974).
    fn cut(&mut self, side: impl Fn([f64; 2]) -> f64) {
        self.kept.clear();
        let Some(&last) = self.outline.last() else { return };
        let mut before = last;
        for &corner in &self.outline {
            let (from, to) = (side(before), side(corner));
            if (from < 0.0) != (to < 0.0) {
                let part = from / (from - to);
                self.kept.push([0, 1].map(|axis| before[axis] + part * (corner[axis] - before[axis])));
            }
            if to >= 0.0 {
                self.kept.push(corner);
            }
            before = corner;
        }
        std::mem::swap(&mut self.outline, &mut self.kept);
    }
}

/// Area of a polygon with either winding, and its centroid. `None` without an area.
fn area_and_middle(outline: &[[f64; 2]]) -> Option<(f64, [f64; 2])> {
    // Relative to one of its corners, so that distant polygons lose no digits.
    let &[ox, oy] = outline.first()?;
    let (mut area, mut middle) = (0.0, [0.0; 2]);
    for two in outline.windows(2) {
        let [ax, ay, bx, by] = [two[0][0] - ox, two[0][1] - oy, two[1][0] - ox, two[1][1] - oy];
        let part = 0.5 * (ax * by - bx * ay);
        area += part;
        middle[0] += part * (ax + bx) / 3.0;
        middle[1] += part * (ay + by) / 3.0;
    }
    (area != 0.0 && area.is_finite()).then(|| (area.abs(), [ox + middle[0] / area, oy + middle[1] / area]))
}

/// Returns the immersed part of a geom; `None` if no part is immersed.
pub(super) fn immersed(
    core: &PhysicsSimulator,
    depths: &DepthState,
    id: GeomId,
    container: &Container,
    scratch: &mut ClipBuffer,
) -> Option<Immersed> {
    let geom = core.geom(id)?;
    let z = f64::from(depths.z_of(geom.body()));
    let half = f64::from(depths.profiles.get(id)?.half_depth());
    if container.within(2, [z - half, z + half]) == 0.0 {
        return None;
    }
    let matrix = geom.matrix();
    let found = match depths.profiles.get(id)? {
        DepthProfile::Round { radius } => {
            let at = [f64::from(matrix.m41), f64::from(matrix.m42), z];
            Some(container.of_ball(at, f64::from(*radius)))
        }
        profile if profile.upright().is_some() => {
            let body = core.body(geom.body())?;
            container.of_upright(&profile.upright()?, middle_of(geom, body, z as f32))
        }
        _ => {
            let outline = geom.local_vertices().iter().map(|corner| {
                let [x, y] = [corner.x, corner.y].map(f64::from);
                let along =
                    |[of_x, of_y, at]: [f32; 3]| f64::from(of_x) * x + f64::from(of_y) * y + f64::from(at);
                [along([matrix.m11, matrix.m21, matrix.m41]), along([matrix.m12, matrix.m22, matrix.m42])]
            });
            container.of_prism(outline, [z - half, z + half], scratch)
        }
    };
    found.filter(|part| part.volume > 0.0)
}

/// Immersed fraction of the volume of a body, 0..=1, dimensionless.
pub(crate) fn immersion_of(core: &PhysicsSimulator, depths: &DepthState, fluid: &Fluid, body: BodyId) -> f32 {
    let (region, everywhere) = (Container::new(&fluid.region), Container::new(&Region::EVERYWHERE));
    let mut scratch = ClipBuffer::default();
    let mut volume = |geom: GeomId, container: &Container| {
        immersed(core, depths, geom, container, &mut scratch).map_or(0.0, |part| part.volume)
    };
    let (mut within, mut whole) = (0.0, 0.0);
    for &geom in core.geoms_of(body) {
        within += volume(geom, &region);
        whole += volume(geom, &everywhere);
    }
    if whole > 0.0 { (within / whole) as f32 } else { 0.0 }
}
