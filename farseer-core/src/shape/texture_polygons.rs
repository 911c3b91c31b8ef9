//! Polygons around the solid pixels of a texture (behaviour chapter 15, section 15.6.2).

use super::texture_outline::{NO_PIXEL, Pixel, trace};
use super::texture_search::{find_hole, is_in_polygon, next_entrance, split};
use super::{Aabb, PolygonCreationAssistance, Vertices};
use crate::error::{Error, Result};
use crate::math::Vector2;

impl Vertices {
    /// The outline of the first part of a texture, with the options [`PolygonCreationAssistance`] starts with.
    /// `data` has one number per pixel, row by row, alpha in its top byte.
    ///
    /// # Errors
    /// As [`Vertices::create_polygons`], and when there is no polygon: no part before the first isolated pixel
    /// or straight line has an outline of three vertices.
    #[doc(alias = "CreatePolygon")]
    pub fn create_polygon(data: &[u32], width: u32, height: u32) -> Result<Vertices> {
        let polygons = Vertices::create_polygons(&PolygonCreationAssistance::new(data, width, height)?)?;
        polygons.into_iter().next().ok_or_else(|| {
            let value = format_args!("a texture of {width} by {height} pixels without an outline");
            Error::invalid("data", value, "a texture with a solid part of three corners or more")
        })
    }

    /// The outlines of a texture with the most common options; see [`PolygonCreationAssistance`] for their meaning.
    ///
    /// # Errors
    /// As [`Vertices::create_polygons`], and when the hull tolerance is not finite.
    #[doc(alias = "CreatePolygon")]
    pub fn create_polygon_with(
        data: &[u32],
        width: u32,
        height: u32,
        hull_tolerance: f32,
        alpha_tolerance: u8,
        multi_part_detection: bool,
        hole_detection: bool,
    ) -> Result<Vec<Vertices>> {
        let mut assistance = PolygonCreationAssistance::new(data, width, height)?;
        assistance.set_hull_tolerance(hull_tolerance)?;
        assistance.set_alpha_tolerance(alpha_tolerance);
        assistance.set_multipart_detection(multi_part_detection);
        assistance.set_hole_detection(hole_detection);
        Vertices::create_polygons(&assistance)
    }

    /// The outlines of a texture: of its first part, or of all parts with multi-part detection. Each hole that is found
    /// is joined to its outline by a bridge.
    ///
    /// Vertices are the columns and rows of pixels, not the corners of pixels: an outline is half a pixel inside of the
    /// picture. Parts have positive shoelace area, opposite to engine winding.
    ///
    /// An outline starts at the first pixel of its part. The last corner before the trace returns there is lost, as in
    /// the original: of a block of three by three pixels three corners remain. The search ends at the first part with
    /// fewer than three vertices, such as an isolated pixel. A hole is not found in a part that reaches the first row,
    /// nor within the hull tolerance of the outline.
    ///
    /// # Errors
    /// None: every texture that can be made can be traced.
    #[doc(alias = "CreatePolygon")]
    pub fn create_polygons(assistance: &PolygonCreationAssistance<'_>) -> Result<Vec<Vertices>> {
        let mut polygons: Vec<Vertices> = Vec::new();
        let mut boxes: Vec<Aabb> = Vec::new();
        // As in the original both keep their values from part to part.
        let mut holes = Vec::new();
        let mut hole = None;

        let mut outline = trace(assistance, NO_PIXEL, NO_PIXEL);
        let mut part = topmost(&outline);
        loop {
            if outline.len() <= 2 {
                return Ok(polygons);
            }
            if assistance.hole_detection() {
                hole = cut_holes(assistance, &mut outline, hole, &mut holes);
            }
            boxes.push(Aabb::from_vertices(&outline));
            polygons.push(Vertices::from(outline));
            if !assistance.multipart_detection() {
                return Ok(polygons);
            }
            let is_known = |pixel| {
                let mut known = polygons.iter().zip(&boxes);
                known.any(|(polygon, aabb)| is_in_polygon(assistance, polygon, aabb, pixel))
            };
            while let Some(entrance) = part {
                part = next_entrance(assistance, entrance);
                if part.is_none_or(|pixel| !is_known(pixel)) {
                    break;
                }
            }
            let Some(entrance) = part else {
                return Ok(polygons);
            };
            outline = trace(assistance, entrance, Pixel { x: entrance.x - 1, ..entrance });
        }
    }
}

/// The first of the vertices with the smallest y.
fn topmost(outline: &[Vector2]) -> Option<Pixel> {
    let top = outline.iter().copied().reduce(|top, v| if v.y < top.y { v } else { top })?;
    Some(Pixel { x: top.x as i32, y: top.y as i32 })
}

/// Joins the holes of an outline to it, until there is none or one is found again. Returns the pixel at which the
/// search ended.
fn cut_holes(
    image: &PolygonCreationAssistance<'_>,
    outline: &mut Vec<Vector2>,
    mut hole: Option<Pixel>,
    holes: &mut Vec<Pixel>,
) -> Option<Pixel> {
    loop {
        hole = find_hole(image, outline, hole);
        let Some(entrance) = hole.filter(|pixel| !holes.contains(pixel)) else {
            return hole;
        };
        holes.push(entrance);
        let mut around = trace(image, entrance, Pixel { x: entrance.x + 1, ..entrance });
        if around.len() > 2 {
            around.push(around[0]);
            if let Some(place) = split(outline, entrance) {
                outline.splice(place..place, around);
            }
        }
    }
}
