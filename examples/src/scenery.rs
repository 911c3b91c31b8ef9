//! What stands behind a 2.5D scene.

use twohalf_render::{Canvas, Color, Point, Transform};

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
