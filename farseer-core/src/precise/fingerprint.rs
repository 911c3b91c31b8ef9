//! Fingerprints of shapes. After an edit that adds or removes proxies, and after loading, everything is listed anew; the
//! fingerprint that is saved with a proxy tells whether its shape has changed since its bounds and manifolds were found.
//!
//! Each 32-bit word goes through the output function of SplitMix64 (G. L. Steele, D. Lea, C. H. Flood, "Fast splittable
//! pseudorandom number generators", 2014), a bijection of 64 bits. Two different shapes share a fingerprint by chance only,
//! with a probability of about 2^-64.

use super::outline::Outline;
use super::space::parts::{Fixture, SpaceProfile, SpaceUpright};
use crate::geom::seams::Seam;

/// A fingerprint, word by word.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Fingerprint(u64);

/// Increment of SplitMix64: 2^64 divided by the golden ratio, made odd.
const INCREMENT: u64 = 0x9E37_79B9_7F4A_7C15;

impl Fingerprint {
    pub(super) fn bits(self) -> u64 {
        self.0
    }

    fn add(&mut self, word: u32) {
        let mut mixed = (self.0 ^ u64::from(word)).wrapping_add(INCREMENT);
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        self.0 = mixed ^ (mixed >> 31);
    }

    /// Adds numbers. The two zeros count as one, since platforms choose between them differently in minima and maxima.
    fn add_numbers(&mut self, numbers: &[f32]) {
        numbers.iter().for_each(|number| self.add((number + 0.0).to_bits()));
    }

    /// Adds an outline: radius, box, corners, normals and seams. A circle has no corners; its centre is that of its box.
    pub(super) fn add_outline(&mut self, outline: Outline<'_>) {
        let shape = outline.shape;
        self.add(shape.family as u32);
        self.add(shape.count);
        self.add_numbers(&[shape.radius, shape.centre[0], shape.centre[1], shape.half[0], shape.half[1]]);
        outline.points.iter().chain(outline.normals).for_each(|vector| self.add_numbers(vector));
        outline.seams().iter().for_each(|seam| self.add_seam(seam));
    }

    fn add_seam(&mut self, seam: &Seam) {
        self.add(u32::from(seam.is_inner));
        seam.neighbours.iter().for_each(|normal| self.add_numbers(normal));
    }

    /// Adds the extent of a geom along the depth axis, and the ground that it rests on.
    pub(super) fn add_profile(&mut self, profile: &SpaceProfile) {
        let &SpaceProfile { half_depth, is_round, ground, upright } = profile;
        self.add_numbers(&[half_depth]);
        self.add(u32::from(is_round));
        self.add(u32::from(ground.is_some()));
        self.add_numbers(&ground.unwrap_or_default());
        match upright {
            None => self.add(0),
            Some(SpaceUpright::Cylinder { radius, half_height }) => {
                self.add(1);
                self.add_numbers(&[radius, half_height]);
            }
            Some(SpaceUpright::Capsule { radius, half_height }) => {
                self.add(2);
                self.add_numbers(&[radius, half_height]);
            }
            Some(SpaceUpright::Prism { footprint, half_height }) => {
                self.add(3);
                self.add_numbers(&[half_height]);
                footprint.corners().iter().for_each(|corner| self.add_numbers(&[corner.x, corner.y]));
            }
        }
    }

    /// The fingerprint of a fixture: its size, slant and angle about the upright axis, and whether it is one-way. Position and
    /// tilt are those of its body.
    pub(super) fn of_fixture(fixture: &Fixture) -> u64 {
        let mut fingerprint = Fingerprint::default();
        fingerprint.add_numbers(&fixture.shape.half);
        fingerprint.add_numbers(&[fixture.shape.shear, fixture.shape.climb]);
        fingerprint.add(u32::from(fixture.yaw.is_some()));
        fingerprint.add_numbers(&[fixture.yaw.unwrap_or_default()]);
        fingerprint.add(u32::from(fixture.is_one_way));
        fingerprint.bits()
    }
}
