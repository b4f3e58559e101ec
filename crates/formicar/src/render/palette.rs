//! Colors for a light page, told apart by lightness alone where they mean different things.

use std::fmt;

/// A color in sRGB.
///
/// ```
/// use formicar::render::Color;
///
/// let (black, white) = (Color::rgb(0, 0, 0), Color::rgb(255, 255, 255));
/// assert!(black.lightness() == 0.0 && (white.lightness() - 1.0).abs() < 1e-9);
/// assert_eq!(black.mix(white, 1.0), white);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Color {
    /// Red, 0 to 255.
    pub red: u8,
    /// Green, 0 to 255.
    pub green: u8,
    /// Blue, 0 to 255.
    pub blue: u8,
}

impl Color {
    /// The color with these parts.
    pub const fn rgb(red: u8, green: u8, blue: u8) -> Self {
        Self { red, green, blue }
    }

    /// The color at `t` of the way to another, 0 to 1.
    pub fn mix(self, other: Self, t: f64) -> Self {
        let mix = |a: u8, b: u8| {
            let (a, b) = (f64::from(a), f64::from(b));
            (a + (b - a) * t.clamp(0.0, 1.0)).round() as u8
        };
        Self {
            red: mix(self.red, other.red),
            green: mix(self.green, other.green),
            blue: mix(self.blue, other.blue),
        }
    }

    /// Its lightness in grayscale, 0 (black) to 1 (white): luma of Rec. 709.
    pub fn lightness(self) -> f64 {
        let [r, g, b] = [self.red, self.green, self.blue].map(f64::from);
        (0.2126 * r + 0.7152 * g + 0.0722 * b) / 255.0
    }
}

impl fmt::Display for Color {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "#{:02x}{:02x}{:02x}", self.red, self.green, self.blue)
    }
}

/// The page.
pub const PAGE: Color = Color::rgb(0xff, 0xff, 0xff);
/// Text and axes.
pub const INK: Color = Color::rgb(0x22, 0x27, 0x2e);
/// Text of second rank.
pub const MUTED: Color = Color::rgb(0x5d, 0x66, 0x70);
/// Frames and tick marks.
pub const RULE: Color = Color::rgb(0xa9, 0xb1, 0xb9);
/// Grid lines.
pub const HAIRLINE: Color = Color::rgb(0xe4, 0xe7, 0xea);
/// Free ground.
pub const FREE: Color = Color::rgb(0xfb, 0xfb, 0xf9);
/// Occupied ground.
pub const OBSTACLE: Color = Color::rgb(0x2f, 0x34, 0x3a);
/// Unknown ground.
pub const UNKNOWN: Color = Color::rgb(0xb4, 0xbc, 0xc4);
/// Graded ground at its highest cost below an obstacle.
pub const GRADED: Color = Color::rgb(0x9a, 0x8f, 0x7c);
/// Ground beyond the map.
pub const OFF_MAP: Color = Color::rgb(0xdf, 0xe3, 0xe7);
/// Cells by which obstacles were grown.
pub const EXPANDED: Color = Color::rgb(0xc9, 0xc9, 0xc6);
/// Cells of closed U-shapes.
pub const CLOSED: Color = Color::rgb(0x94, 0x68, 0xb4);
/// The path driven forward.
pub const FORWARD: Color = Color::rgb(0x0b, 0x4f, 0x9c);
/// The path driven in reverse.
pub const REVERSE: Color = Color::rgb(0xd9, 0x69, 0x0a);
/// Ground that the vehicle sweeps.
pub const SWEPT: Color = Color::rgb(0x4f, 0x9a, 0xd6);
/// The start pose.
pub const START: Color = Color::rgb(0x0b, 0x7a, 0x53);
/// The goal pose.
pub const GOAL: Color = Color::rgb(0x7b, 0x2d, 0x8b);
/// Limits, and the tightest place.
pub const LIMIT: Color = Color::rgb(0xd8, 0x1e, 0x3f);
/// A path over cells or way points, before it is drivable.
pub const WAYPOINTS: Color = Color::rgb(0x8c, 0x5a, 0x14);

/// A perceptually uniform scale from pale yellow (0) to dark red (1), colors that nothing else on a
/// map has.
///
/// Lightness, hue and chroma run linearly in `OKLab` (Ottosson 2020, "A perceptual color space for
/// image processing"), so that equal steps look equal and grayscale keeps the order.
pub fn heat(t: f64) -> Color {
    let t = if t.is_nan() { 0.0 } else { t.clamp(0.0, 1.0) };
    let (lightness, chroma) = (0.97 - 0.47 * t, 0.05 + 0.12 * t);
    let hue = (105.0 - 80.0 * t).to_radians();
    from_oklab(lightness, chroma * hue.cos(), chroma * hue.sin())
}

/// `OKLab` to sRGB with the matrices of Ottosson 2020.
fn from_oklab(lightness: f64, a: f64, b: f64) -> Color {
    let l = (lightness + 0.396_337_777_4 * a + 0.215_803_757_3 * b).powi(3);
    let m = (lightness - 0.105_561_345_8 * a - 0.063_854_172_8 * b).powi(3);
    let s = (lightness - 0.089_484_177_5 * a - 1.291_485_548_0 * b).powi(3);
    Color {
        red: gamma(4.076_741_662_1 * l - 3.307_711_591_3 * m + 0.230_969_929_2 * s),
        green: gamma(-1.268_438_004_6 * l + 2.609_757_401_1 * m - 0.341_319_396_5 * s),
        blue: gamma(-0.004_196_086_3 * l - 0.703_418_614_7 * m + 1.707_614_701_0 * s),
    }
}

/// Linear light to an sRGB byte (IEC 61966-2-1).
fn gamma(linear: f64) -> u8 {
    let encoded = if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    };
    (encoded.clamp(0.0, 1.0) * 255.0).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ground_and_gears_differ_in_grayscale() {
        let ground = [FREE, EXPANDED, CLOSED, OBSTACLE].map(Color::lightness);
        assert!(ground.windows(2).all(|w| w[0] - w[1] > 0.15), "{ground:?}");
        assert!(REVERSE.lightness() - FORWARD.lightness() > 0.15);
    }

    #[test]
    fn heat_darkens_evenly() {
        let light: Vec<f64> = (0..=20)
            .map(|i| heat(f64::from(i) / 20.0).lightness())
            .collect();
        assert!(light.windows(2).all(|w| w[0] - w[1] > 0.015), "{light:?}");
        assert_eq!(heat(f64::NAN), heat(-1.0));
    }
}
