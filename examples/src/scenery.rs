//! The background of a 2.5D scene.

use twohalf_render::{
    Canvas, Color, GroundBackdrop, Point, SoftwareCanvas, Text, Texture2D, Transform, draw_ground_backdrop,
};

use crate::Result;

/// Draws clouds and two rows of hills that end at the horizon, `horizon` px above the lower edge.
pub fn draw_hills(canvas: &mut dyn Canvas, horizon: f32) {
    let [width, height] = canvas.size().map(|side| side as f32);
    let base = height - horizon;
    for (index, [x, y, size]) in
        [[150.0, 46.0, 30.0], [470.0, 30.0, 22.0], [660.0, 70.0, 34.0]].iter().enumerate()
    {
        let white = Color::WHITE.with_opacity(0.75 - 0.1 * index as f32);
        for [dx, dy, radius] in [[-1.5, 0.25, 0.7], [-0.5, 0.0, 1.0], [0.7, 0.1, 0.9], [1.7, 0.35, 0.6]] {
            let center = [x + dx * size, y + dy * size];
            canvas.fill_ellipse(
                center,
                [1.3 * radius * size, 0.6 * radius * size],
                &Transform::IDENTITY,
                white,
            );
        }
    }
    let rows = [
        (Color::rgb(150, 176, 190), 122.0, [0.009, 0.023], 0.4),
        (Color::rgb(126, 160, 128), 84.0, [0.013, 0.031], 2.0),
    ];
    for (color, tallest, [long, short], phase) in rows {
        let ridge = |x: f32| 0.55 + 0.3 * (long * x + phase).sin() + 0.15 * (short * x + 2.0 * phase).sin();
        let mut outline: Vec<Point> = vec![[width, base], [0.0, base]];
        outline.extend((0..=width as u32 / 4).map(|step| {
            let x = 4.0 * step as f32;
            [x, base - tallest * ridge(x)]
        }));
        canvas.fill_polygon(&outline, &Transform::IDENTITY, color);
    }
}

/// A star with a word on it.
pub(crate) fn draw_burst(canvas: &mut dyn Canvas, center: Point, word: &str) {
    let ink = Color::rgb(30, 22, 34);
    for (size, color) in [(1.0, ink), (0.9, Color::rgb(240, 176, 48)), (0.6, Color::rgb(255, 240, 150))] {
        let corner = |at: usize| {
            let angle = std::f32::consts::TAU * at as f32 / 20.0;
            let far = size * if at.is_multiple_of(2) { 38.0 } else { 22.0 };
            [center[0] + 1.3 * far * angle.cos(), center[1] + 0.8 * far * angle.sin()]
        };
        let star: Vec<Point> = (0..20).map(corner).collect();
        canvas.fill_polygon(&star, &Transform::IDENTITY, color);
    }
    Text { scale: [2.0; 2], color: Color::rgb(190, 40, 30), ..Text::centered(word, center) }.draw(canvas);
}

/// Houses before the evening sky, some of their windows lit, as large as a zoom shows them. It can be repeated.
pub(crate) fn city_at_dusk(zoom: f32) -> Result<Texture2D> {
    let [width, height] = [720.0, 170.0];
    let [columns, rows] = [width, height].map(|side| (zoom * side).round() as u32);
    let mut canvas = SoftwareCanvas::new(columns, rows)?;
    let shown = Transform::scaling([zoom; 2]);
    let mut fill = |[x, y]: Point, [width, height]: Point, color: Color| {
        let corners = [[x, y], [x + width, y], [x + width, y + height], [x, y + height]];
        canvas.fill_polygon(&corners, &shown, color);
    };
    let rows = [(Color::rgb(126, 92, 128), 6, 0.0, 18.0), (Color::rgb(72, 54, 92), 9, 20.0, 62.0)];
    let mut random = 12_345_u32;
    for (color, houses, shift, top) in rows {
        let lot = width / houses as f32;
        for house in 0..houses {
            random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let roof = top + (random >> 16) as f32 % 48.0;
            let left = house as f32 * lot + shift * 0.25;
            fill([left, roof], [lot - 10.0, height - roof], color);
            fill([left + 12.0, roof - 8.0], [14.0, 8.0], color);
            let (columns, floors) = (((lot - 24.0) / 14.0) as u32, ((height - roof) / 16.0) as u32);
            for window in 0..columns * floors {
                let at = [
                    left + 8.0 + 14.0 * (window % columns) as f32,
                    roof + 8.0 + 16.0 * (window / columns) as f32,
                ];
                let is_lit = (random >> (window % 23)) & 5 == 5;
                fill(at, [7.0, 9.0], if is_lit { Color::rgb(255, 208, 128) } else { color.darker(0.25) });
            }
        }
    }
    Ok(canvas.to_texture()?)
}

/// The evening sky and the ground under it, of the size of a picture, painted once: rows of colour take longer than a picture
/// of them.
pub(crate) fn sky_at_dusk([width, height]: [u32; 2], depth: f32) -> Result<Texture2D> {
    let mut canvas = SoftwareCanvas::new(width, height)?;
    let dusk = GroundBackdrop { lines: Color::TRANSPARENT, ..GroundBackdrop::dusk(depth, 90.0) };
    draw_ground_backdrop(&mut canvas, &dusk)?;
    Ok(canvas.to_texture()?)
}
