//! Colours.

/// A colour: red, green, blue (sRGB) and alpha, 0 to 255 each, alpha **straight** (not premultiplied).
///
/// As a sprite's tint it multiplies every channel of the texture, alpha included, so its alpha is the
/// sprite's opacity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Color {
    /// Red, 0 to 255.
    #[doc(alias = "R")]
    pub r: u8,
    /// Green, 0 to 255.
    #[doc(alias = "G")]
    pub g: u8,
    /// Blue, 0 to 255.
    #[doc(alias = "B")]
    pub b: u8,
    /// Alpha: 0 transparent, 255 opaque.
    #[doc(alias = "A")]
    pub a: u8,
}

impl Color {
    /// Opaque white; as a tint it leaves a texture as it is.
    pub const WHITE: Color = Color::rgb(255, 255, 255);
    /// Opaque black.
    pub const BLACK: Color = Color::rgb(0, 0, 0);
    /// Transparent black.
    pub const TRANSPARENT: Color = Color::rgba(0, 0, 0, 0);

    /// An opaque colour.
    pub const fn rgb(r: u8, g: u8, b: u8) -> Self {
        Color { r, g, b, a: 255 }
    }

    /// A colour with straight alpha.
    pub const fn rgba(r: u8, g: u8, b: u8, a: u8) -> Self {
        Color { r, g, b, a }
    }

    /// The same colour with another alpha.
    pub const fn with_alpha(self, a: u8) -> Self {
        Color { a, ..self }
    }

    /// The same colour with its alpha multiplied by `opacity`, clamped to 0..=1 (NaN counts as 0).
    pub fn with_opacity(self, opacity: f32) -> Self {
        // `as` turns NaN into 0 and saturates.
        Color { a: (f32::from(self.a) * opacity.clamp(0.0, 1.0) + 0.5) as u8, ..self }
    }

    /// The colour at `t` on the way from `self` (0) to `other` (1), alpha included; `t` is clamped to 0..=1
    /// (NaN counts as 0).
    #[doc(alias = "Lerp")]
    pub fn lerp(self, other: Color, t: f32) -> Self {
        let t = if t.is_nan() { 0.0 } else { t.clamp(0.0, 1.0) };
        let mix = |a: u8, b: u8| (f32::from(a) + (f32::from(b) - f32::from(a)) * t + 0.5) as u8;
        Color {
            r: mix(self.r, other.r),
            g: mix(self.g, other.g),
            b: mix(self.b, other.b),
            a: mix(self.a, other.a),
        }
    }

    /// A lighter colour: `amount` 0 leaves it, 1 makes it white. Alpha stays.
    pub fn lighter(self, amount: f32) -> Self {
        self.lerp(Color::WHITE.with_alpha(self.a), amount)
    }

    /// A darker colour: `amount` 0 leaves it, 1 makes it black. Alpha stays.
    pub fn darker(self, amount: f32) -> Self {
        self.lerp(Color::BLACK.with_alpha(self.a), amount)
    }
}

impl From<[u8; 4]> for Color {
    /// Red, green, blue and straight alpha.
    fn from([r, g, b, a]: [u8; 4]) -> Self {
        Color::rgba(r, g, b, a)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lerp_meets_both_ends_and_the_middle() {
        let (a, b) = (Color::rgba(0, 10, 255, 255), Color::rgba(100, 20, 0, 55));
        assert_eq!(a.lerp(b, 0.0), a);
        assert_eq!(a.lerp(b, 1.0), b);
        assert_eq!(a.lerp(b, 0.5), Color::rgba(50, 15, 128, 155));
    }

    #[test]
    fn opacity_outside_its_range_is_clamped() {
        assert_eq!(Color::WHITE.with_opacity(7.0).a, 255);
        assert_eq!(Color::WHITE.with_opacity(-1.0).a, 0);
        assert_eq!(Color::WHITE.with_opacity(f32::NAN).a, 0);
    }
}
