//! Fingerprints of shapes: 64-bit hashes that show whether a shape has changed since its manifolds were computed.
//!
//! A snapshot stores the fingerprint of each proxy. After an edit that adds or removes proxies, and after a snapshot is loaded,
//! all proxies are listed anew. A proxy whose fingerprint equals the saved one keeps its fat AABB and manifolds.
//!
//! Each 32-bit word goes through the output function of SplitMix64 (G. L. Steele, D. Lea, C. H. Flood, "Fast splittable
//! pseudorandom number generators", 2014), a bijection of 64 bits. Two different shapes have the same fingerprint by chance
//! only, with a probability of about 2^-64.

#[cfg(feature = "engine")]
use super::depth::interface::{DepthShape, VerticalShape, WorldBox};
#[cfg(feature = "engine")]
use super::shape::ShapeRef;
#[cfg(feature = "engine")]
use crate::edge_adjacency::Seam;

/// Fingerprint of a shape while it is computed: hash of the 32-bit words added so far.
#[derive(Debug, Clone, Copy, Default)]
pub struct Fingerprint(u64);

/// Increment of SplitMix64: 2^64 divided by the golden ratio, made odd. A 64-bit number without unit.
const SPLITMIX64_INCREMENT: u64 = 0x9E37_79B9_7F4A_7C15;

impl Fingerprint {
    /// Returns the 64 bits of the hash.
    pub fn bits(self) -> u64 {
        self.0
    }

    /// Adds a 32-bit word to the hash.
    pub fn add_word(&mut self, word: u32) {
        let mut mixed = (self.0 ^ u64::from(word)).wrapping_add(SPLITMIX64_INCREMENT);
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        self.0 = mixed ^ (mixed >> 31);
    }
}

/// Shapes of the engine.
#[cfg(feature = "engine")]
impl Fingerprint {
    /// Adds `numbers` to the hash by their bits. -0 counts as 0, since the minima and maxima of platforms differ in the sign of
    /// zero.
    fn add_floats(&mut self, numbers: &[f32]) {
        numbers.iter().for_each(|number| self.add_word((number + 0.0).to_bits()));
    }

    /// Adds a shape in the plane to the hash: kind, radius, bounding box, vertices, normals and adjacency of the edges. A
    /// circle has no vertices; its centre is that of its bounding box.
    pub fn add_outline(&mut self, outline: ShapeRef<'_>) {
        let shape = outline.shape;
        self.add_word(shape.kind as u32);
        self.add_word(shape.vertex_count);
        self.add_floats(&[
            shape.radius,
            shape.centre[0],
            shape.centre[1],
            shape.half_extents[0],
            shape.half_extents[1],
        ]);
        outline.vertices.iter().chain(outline.normals).for_each(|vector| self.add_floats(vector));
        outline.adjacency().iter().for_each(|seam| self.add_edge_adjacency(seam));
    }

    /// Adds the adjacency of an edge to the hash: whether the edge is internal, and the normals of the edges before and after
    /// it.
    fn add_edge_adjacency(&mut self, seam: &Seam) {
        self.add_word(u32::from(seam.is_internal));
        seam.neighbours.iter().for_each(|normal| self.add_floats(normal));
    }

    /// Adds the shape of a geom along Z to the hash: half depth, whether it is a sphere, surface of its ground, and vertical
    /// shape.
    pub fn add_depth_shape(&mut self, profile: &DepthShape) {
        let &DepthShape { half_depth, is_sphere: is_round, ground_surface: ground, vertical: upright } =
            profile;
        self.add_floats(&[half_depth]);
        self.add_word(u32::from(is_round));
        self.add_word(u32::from(ground.is_some()));
        self.add_floats(&ground.unwrap_or_default());
        match upright {
            None => self.add_word(0),
            Some(VerticalShape::Cylinder { radius, half_height }) => {
                self.add_word(1);
                self.add_floats(&[radius, half_height]);
            }
            Some(VerticalShape::Capsule { radius, half_height }) => {
                self.add_word(2);
                self.add_floats(&[radius, half_height]);
            }
            Some(VerticalShape::Prism { footprint, half_height }) => {
                self.add_word(3);
                self.add_floats(&[half_height]);
                footprint.corners().iter().for_each(|corner| self.add_floats(&[corner.x, corner.y]));
            }
        }
    }

    /// Returns the fingerprint of a box of `twohalf`: size, shear, slope, angle about Y, and whether it is one-way. Position
    /// and tilt belong to its body.
    pub(crate) fn of_world_box(fixture: &WorldBox) -> u64 {
        let mut fingerprint = Fingerprint::default();
        fingerprint.add_floats(&fixture.shape.half);
        fingerprint.add_floats(&[fixture.shape.shear, fixture.shape.climb]);
        fingerprint.add_word(u32::from(fixture.yaw.is_some()));
        fingerprint.add_floats(&[fixture.yaw.unwrap_or_default()]);
        fingerprint.add_word(u32::from(fixture.is_one_way));
        fingerprint.bits()
    }
}
