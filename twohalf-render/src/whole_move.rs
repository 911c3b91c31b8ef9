//! Textures that are translated by whole px: they are copied without sampling.

use tiny_skia::Pixmap;

use crate::{Texture2D, Transform};

/// Position of the upper left corner of a texture that is only translated, by whole px. The corners must be
/// within the range of coordinates.
pub(crate) fn whole_move(transform: &Transform) -> Option<[i32; 2]> {
    let Transform { x_axis, y_axis, translation } = *transform;
    let is_whole = translation.iter().all(|way| way.fract() == 0.0);
    ([x_axis, y_axis] == [[1.0, 0.0], [0.0, 1.0]] && is_whole).then(|| translation.map(|way| way as i32))
}

/// Draws a texture with its upper left corner at this px, source over, rounded to the nearest as in the
/// sampled case.
pub(crate) fn draw_moved(pixmap: &mut Pixmap, texture: &Texture2D, [x, y]: [i32; 2]) {
    let canvas = [pixmap.width(), pixmap.height()].map(|side| side as i32);
    let size = [texture.width(), texture.height()].map(|side| side as i32);
    let [left, right] = [x.max(0), (x + size[0]).min(canvas[0])];
    if left >= right {
        return;
    }
    let at = |row: i32, width: i32, column: i32| (row as usize * width as usize + column as usize) * 4;
    let length = (right - left) as usize * 4;
    for row in y.max(0)..(y + size[1]).min(canvas[1]) {
        let (to, from) = (at(row, canvas[0], left), at(row - y, size[0], left - x));
        let source = &texture.premultiplied_rgba8()[from..from + length];
        let target = &mut pixmap.data_mut()[to..to + length];
        if is_opaque(source) {
            target.copy_from_slice(source);
        } else {
            blend(target, source);
        }
    }
}

fn is_opaque(pixels: &[u8]) -> bool {
    // Four pixels at a time, which a compiler turns into one instruction.
    let (fours, rest) = pixels.as_chunks::<16>();
    let all =
        fours.iter().fold([255; 16], |all: [u8; 16], four| std::array::from_fn(|at| all[at] & four[at]));
    all.iter().chain(rest).skip(3).step_by(4).all(|&alpha| alpha == 255)
}

fn blend(target: &mut [u8], source: &[u8]) {
    for (target, source) in target.chunks_exact_mut(4).zip(source.chunks_exact(4)) {
        match 255 - u32::from(source[3]) {
            0 => target.copy_from_slice(source),
            255 => {}
            rest => {
                for (target, source) in target.iter_mut().zip(source) {
                    *target = source + ((u32::from(*target) * rest + 127) / 255) as u8;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::{Canvas, Color, Point, SoftwareCanvas, Texture2D, Transform};

    /// All values of alpha beside opaque pixels; one row is opaque.
    fn texture() -> Texture2D {
        let alpha = |at: u32| if at.is_multiple_of(3) { 255 } else { (at / 256) as u8 };
        let pixels = (0..256_u32 * 256).flat_map(|at| [200, (at % 256) as u8, 13, alpha(at)]);
        Texture2D::from_rgba8(256, 256, pixels.collect()).unwrap()
    }

    fn drawn(way: Point, clip: Option<&[Point]>) -> SoftwareCanvas {
        let mut canvas = SoftwareCanvas::new(256, 200).unwrap();
        for column in 0..256 {
            let color = Color::rgba(column as u8, 255 - column as u8, 77, 255 - (column / 2) as u8);
            canvas.fill_rectangle([column as f32, 0.0], [1.0, 200.0], &Transform::IDENTITY, color);
        }
        canvas.draw_texture(&texture(), &Transform::translation(way), Color::WHITE, clip);
        canvas
    }

    #[test]
    fn a_texture_that_is_moved_by_whole_pixels_looks_as_if_it_were_sampled() {
        for way in [[0.0, 0.0], [0.0, -56.0], [-31.0, 17.0], [100.0, 150.0], [-255.0, 199.0], [300.0, 0.0]] {
            let [x, y] = way;
            // With a clip it is sampled.
            let all = [[x, y], [x + 256.0, y], [x + 256.0, y + 256.0], [x, y + 256.0]];
            let (moved, sampled) = (drawn(way, None), drawn(way, Some(&all)));
            assert!(moved == sampled, "{way:?}");
        }
    }
}
