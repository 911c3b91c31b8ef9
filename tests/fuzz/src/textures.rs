//! Tests the outlines of random pictures.

use farseer_core::Vertices;
use farseer_core::shape::PolygonCreationAssistance;

use crate::random::Random;

/// Greatest width and height of a picture, pixels.
const WIDEST: usize = 24;
const SOLID: u32 = 0xff00_0000;

/// Checks that every function which makes outlines of a picture returns outlines or an error, and that the coordinates of the
/// outlines are finite.
///
/// # Errors
/// Names the outline that has a coordinate which is not finite.
pub fn outlines_of_a_picture(seed: u64) -> Result<(), String> {
    let mut random = Random::new(seed);
    let (width, height) = (1 + random.below(WIDEST), 1 + random.below(WIDEST));
    let picture = random.pick(PICTURES)(&mut random, width, height);
    let (width, height) = (width as u32, height as u32);
    let (tolerance, alpha) = (random.number(0.0, 5.0), random.bits() as u8);
    let (holes, parts) = (random.toss(), random.toss());
    let mut outlines: Vec<Vertices> = Vec::new();
    outlines.extend(Vertices::create_polygon(&picture, width, height));
    outlines.extend(
        Vertices::create_polygon_with(&picture, width, height, tolerance, alpha, holes, parts)
            .into_iter()
            .flatten(),
    );
    outlines.extend(all_polygons(&picture, width, height, &mut random));
    let finite = |outline: &Vertices| outline.iter().all(|v| v.x.is_finite() && v.y.is_finite());
    if outlines.iter().all(finite) { Ok(()) } else { Err("an outline is not finite".into()) }
}

fn all_polygons(picture: &[u32], width: u32, height: u32, random: &mut Random) -> Vec<Vertices> {
    let Ok(mut assistance) = PolygonCreationAssistance::new(picture, width, height) else { return vec![] };
    assistance.set_alpha_tolerance(random.bits() as u8);
    assistance.set_hull_tolerance(random.between(0.0, 8.0)).ok();
    assistance.set_hole_detection(random.toss());
    assistance.set_multipart_detection(random.toss());
    assistance.set_hole_detection_line_step_size(random.count(-1, 5));
    Vertices::create_polygons(&assistance).unwrap_or_default()
}

type Paint = fn(&mut Random, usize, usize) -> Vec<u32>;

const PICTURES: &[Paint] = &[noise, noise, boxes, lines];

/// Returns a picture in which random pixels are solid, few or many.
fn noise(random: &mut Random, width: usize, height: usize) -> Vec<u32> {
    let share = random.bits() % 100;
    (0..width * height).map(|_| if random.chance(share) { SOLID } else { 0 }).collect()
}

/// Returns a picture of solid boxes and holes that overlap.
fn boxes(random: &mut Random, width: usize, height: usize) -> Vec<u32> {
    let mut picture = vec![0; width * height];
    for _ in 0..1 + random.below(6) {
        let colour = if random.chance(70) { SOLID } else { 0 };
        let (left, top) = (random.below(width), random.below(height));
        let (right, bottom) = (left + random.below(width - left), top + random.below(height - top));
        for row in picture.chunks_mut(width).take(bottom + 1).skip(top) {
            row[left..=right].fill(colour);
        }
    }
    picture
}

/// Returns a picture of paths that are one pixel wide, with random opacity.
fn lines(random: &mut Random, width: usize, height: usize) -> Vec<u32> {
    let mut picture = vec![0; width * height];
    let mut at = random.below(picture.len());
    for _ in 0..random.below(3 * (width + height)) {
        picture[at] = (random.bits() as u32) | 0x0100_0000;
        let step = random.pick(&[1, width, picture.len() - 1, picture.len() - width]);
        at = (at + step) % picture.len();
    }
    picture
}
