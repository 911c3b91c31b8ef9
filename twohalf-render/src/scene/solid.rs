//! Solids of a scene, and stand-ins.

use twohalf::{BodyId, Platform, TwoHalfPhysicsSimulator, Vector3};

use super::upright::draw_upright;
use super::{Look, Textures};
use crate::corners::{bend, corners_of, cross, distance};
use crate::draw_platform::draw_faces;
use crate::hidden::Within;
use crate::surface::{Face, to_screen};
use crate::{Canvas, Color, PlatformLook, Point, SpriteBatch, Texture2D, Transform};

const STILL: Transform = Transform::IDENTITY;

/// Greatest number of copies of a texture beside each other on a face; more could not be distinguished.
const MAX_TILES: f32 = 512.0;
/// Least sine of the angle between two sides of an outline whose common corner is drawn as an edge of the
/// solid; a ratio.
const SHARP: f32 = 0.5;

pub(super) fn draw_platform(
    simulator: &TwoHalfPhysicsSimulator,
    canvas: &mut dyn Canvas,
    (platform, corners): (&Platform, &[Vector3; 8]),
    within: Within<'_>,
    look: &Look,
) {
    let (look, textures) = match look {
        Look::Solid(look) => (look, None),
        Look::Textured(look, textures) => (look, Some(textures)),
        _ => return,
    };
    let on_screen = |point: Vector3| to_screen(simulator, point);
    let mut look = *look;
    for (face, texture, color, height) in [
        (Face::Top, textures.and_then(|textures| textures.top.as_ref()), &mut look.top, platform.depth()),
        (
            Face::Front,
            textures.and_then(|textures| textures.front.as_ref()),
            &mut look.front,
            platform.height(),
        ),
    ] {
        let Some(texture) = texture else { continue };
        *color = Color::TRANSPARENT;
        let seen = within.seen(face.corners(corners));
        let face = face.corners(corners).map(on_screen);
        if cross(face[0], face[1], face[2]) > 0.0 {
            for piece in seen.pieces.iter().filter(|piece| !piece.is_empty()) {
                let outline: Vec<Point> = piece.iter().copied().map(on_screen).collect();
                draw_tiles(canvas, texture, face, [platform.width(), height], &outline);
            }
        }
    }
    // The other faces, then the edges over all of them.
    let mut batch = SpriteBatch::begin();
    draw_faces(simulator, &mut batch, (corners, within), &look, 0.0);
    batch.end(canvas);
}

/// Repeats a texture over a face of `size` px, from its first corner to the second and the last, clipped to
/// an outline.
fn draw_tiles(
    canvas: &mut dyn Canvas,
    texture: &Texture2D,
    corners: [Point; 4],
    size: Point,
    outline: &[Point],
) {
    let [a, b, _, d] = corners;
    let axis = |to: Point, length: f32| [(to[0] - a[0]) / length, (to[1] - a[1]) / length];
    let face = Transform { x_axis: axis(b, size[0]), y_axis: axis(d, size[1]), translation: a };
    let tile = [texture.width() as f32, texture.height() as f32];
    let [columns, rows] = [0, 1].map(|axis| (size[axis] / tile[axis]).ceil().min(MAX_TILES) as u32);
    let seen = canvas.visible_area();
    for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
        let corner = Transform::translation([column as f32 * tile[0], row as f32 * tile[1]]);
        let piece = corner.then(&face);
        let [width, height] = tile;
        let corners = [[0.0, 0.0], [width, 0.0], tile, [0.0, height]].map(|corner| piece.apply(corner));
        if overlaps(&corners, seen) {
            canvas.draw_texture(texture, &piece, Color::WHITE, Some(outline));
        }
    }
}

/// Whether the box of some corners overlaps a box from its upper left to its lower right corner.
fn overlaps(corners: &[Point; 4], [low, high]: [Point; 2]) -> bool {
    (0..2).all(|axis| {
        let ends = corners.map(|corner| corner[axis]);
        ends.iter().any(|&end| end <= high[axis]) && ends.iter().any(|&end| end >= low[axis])
    })
}

/// Draws each geom as a prism from its front to its back, rotated by `turn` radians more than the body is.
pub(super) fn draw_body(
    simulator: &TwoHalfPhysicsSimulator,
    canvas: &mut dyn Canvas,
    id: BodyId,
    turn: f32,
    look: &PlatformLook,
    textures: Option<&Textures>,
) {
    let Some(origin) = simulator.body(id).map(|body| Point::from(body.position())) else { return };
    let turned = Transform::translation(origin.map(|number| -number))
        .then(&Transform::rotation(turn))
        .then(&Transform::translation(origin));
    for &geom in simulator.core().geoms_of(id) {
        let Some(view) = simulator.geom(geom) else { continue };
        if draw_upright(simulator, canvas, &view, look) {
            continue;
        }
        let shape = view.virtual_geom();
        let half = 0.5 * (shape.back - shape.front);
        // From the middle of the depth, where the outline is, to its front and back.
        let [near, middle, far] = [-half, 0.0, half]
            .map(|z| Point::from(simulator.projection().to_screen(Vector3::new(0.0, 0.0, z))));
        let moved = |point: Point, to: Point| [point[0] + to[0] - middle[0], point[1] + to[1] - middle[1]];
        let outline = view.screen_outline().into_iter().map(Point::from);
        let outline = corners_of(outline.map(|point| if turn == 0.0 { point } else { turned.apply(point) }));
        let front: Vec<Point> = outline.iter().map(|&point| moved(point, near)).collect();
        let back: Vec<Point> = outline.iter().map(|&point| moved(point, far)).collect();
        draw_sides(canvas, &front, &back, look);
        canvas.fill_polygon(&front, &STILL, look.front);
        if let (Some(texture), &[a, b, c, d]) =
            (textures.and_then(|textures| textures.front.as_ref()), &front[..])
        {
            let [a, b, c, d] = upright([a, b, c, d]);
            draw_tiles(canvas, texture, [a, b, c, d], [distance(a, b), distance(a, d)], &[a, b, c, d]);
        }
        canvas.stroke_polyline(&front, true, look.edge_width, &STILL, look.edges);
    }
}

/// The sides of a prism that can be seen: lighter the more they look up.
fn draw_sides(canvas: &mut dyn Canvas, front: &[Point], back: &[Point], look: &PlatformLook) {
    let turn: f32 = (0..front.len()).map(|i| cross(front[0], front[i], front[(i + 1) % front.len()])).sum();
    for from in 0..front.len() {
        let to = (from + 1) % front.len();
        let [mut a, mut b, mut c, mut d] = [front[from], back[from], back[to], front[to]];
        if turn < 0.0 {
            [a, b, c, d] = [d, c, b, a];
        }
        if cross(a, b, c) <= 0.0 {
            continue;
        }
        // Direction of the edge along the front, clockwise: to the right it is a top, to the left an
        // underside.
        let up = (d[0] - a[0]) / distance(a, d).max(f32::MIN_POSITIVE);
        let color =
            if up > 0.0 { look.sides.lerp(look.top, up) } else { look.sides.lerp(look.underside, -up) };
        canvas.fill_polygon(&[a, b, c, d], &STILL, color);
        canvas.stroke_polyline(&[b, c], false, look.edge_width, &STILL, look.edges);
        for (corner, [near, far]) in [(from, [front[from], back[from]]), (to, [front[to], back[to]])] {
            if bend(front, corner).abs() > SHARP {
                canvas.stroke_polyline(&[near, far], false, look.edge_width, &STILL, look.edges);
            }
        }
    }
}

/// Four corners clockwise from the upper left one.
fn upright(mut corners: [Point; 4]) -> [Point; 4] {
    let [a, b, c, _] = corners;
    if cross(a, b, c) < 0.0 {
        corners.reverse();
    }
    let first = (0..4).min_by(|&a, &b| {
        let [a, b] = [a, b].map(|corner: usize| corners[corner][0] + corners[corner][1]);
        a.total_cmp(&b)
    });
    corners.rotate_left(first.unwrap_or(0));
    corners
}

/// Least and greatest X and Y of a body's object geom on the screen, at its depth.
pub(super) fn bounds(simulator: &TwoHalfPhysicsSimulator, id: BodyId) -> Option<[Point; 2]> {
    let body = simulator.body(id)?;
    let shape = simulator.geom(body.ground().object_geom()?)?.virtual_geom();
    let z = 0.5 * (shape.front + shape.back);
    let [left, top] = to_screen(simulator, Vector3::new(shape.left, shape.top, z));
    let [right, bottom] = to_screen(simulator, Vector3::new(shape.right, shape.bottom, z));
    Some([[left, top], [right, bottom]])
}

pub(super) fn draw_ball(
    simulator: &TwoHalfPhysicsSimulator,
    canvas: &mut dyn Canvas,
    id: BodyId,
    turn: f32,
    color: Color,
) {
    let Some((body, [[left, top], [right, bottom]])) = simulator.body(id).zip(bounds(simulator, id)) else {
        return;
    };
    let [rx, ry] = [0.5 * (right - left), 0.5 * (bottom - top)];
    let center = [left + rx, top + ry];
    canvas.fill_ellipse(center, [rx, ry], &STILL, color.darker(0.55));
    canvas.fill_ellipse(center, [rx - 1.5, ry - 1.5], &STILL, color);
    let turned = Transform::rotation(body.rotation() + turn).then(&Transform::translation(center));
    canvas.fill_ellipse([0.5 * rx, 0.0], [0.28 * rx, 0.28 * ry], &turned, color.darker(0.4));
    canvas.fill_ellipse([-0.5 * rx, 0.0], [0.2 * rx, 0.2 * ry], &turned, color.darker(0.2));
    let light = [center[0] - 0.35 * rx, center[1] - 0.4 * ry];
    canvas.fill_ellipse(light, [0.3 * rx, 0.22 * ry], &STILL, Color::rgba(255, 255, 255, 120));
}

/// A line to another body, whose drawn position is displaced by some px.
pub(super) fn draw_line(
    simulator: &TwoHalfPhysicsSimulator,
    canvas: &mut dyn Canvas,
    ends: [BodyId; 2],
    aside: Point,
    width: f32,
    color: Color,
) {
    if let [Some(from), Some(to)] = ends.map(|id| simulator.body(id)) {
        let [x, y] = Point::from(to.position());
        let line = [from.position().into(), [x + aside[0], y + aside[1]]];
        canvas.stroke_polyline(&line, false, width, &STILL, color);
    }
}
