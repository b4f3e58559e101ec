//! Symmetric 3 x 3 matrices over (x, y, heading): information, covariance, steps.

use formicar::{Point2, Pose2};
use serde::{Deserialize, Serialize};

/// A symmetric 3 x 3 matrix over x, y and heading.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sym3 {
    /// xx.
    pub xx: f64,
    /// xy.
    pub xy: f64,
    /// x and heading.
    pub xh: f64,
    /// yy.
    pub yy: f64,
    /// y and heading.
    pub yh: f64,
    /// heading.
    pub hh: f64,
}

impl Sym3 {
    /// A diagonal matrix.
    pub const fn diagonal(xx: f64, yy: f64, hh: f64) -> Self {
        Self {
            xx,
            xy: 0.0,
            xh: 0.0,
            yy,
            yh: 0.0,
            hh,
        }
    }

    /// The sum with another matrix times a factor.
    #[must_use]
    pub fn plus(self, other: Self, factor: f64) -> Self {
        Self {
            xx: self.xx + other.xx * factor,
            xy: self.xy + other.xy * factor,
            xh: self.xh + other.xh * factor,
            yy: self.yy + other.yy * factor,
            yh: self.yh + other.yh * factor,
            hh: self.hh + other.hh * factor,
        }
    }

    /// The matrix times a factor.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        Self::default().plus(self, factor)
    }

    /// The product with a vector.
    pub fn product(self, v: [f64; 3]) -> [f64; 3] {
        [
            self.xx * v[0] + self.xy * v[1] + self.xh * v[2],
            self.xy * v[0] + self.yy * v[1] + self.yh * v[2],
            self.xh * v[0] + self.yh * v[1] + self.hh * v[2],
        ]
    }

    /// The quadratic form of a vector.
    pub fn form(self, v: [f64; 3]) -> f64 {
        let p = self.product(v);
        v[0] * p[0] + v[1] * p[1] + v[2] * p[2]
    }

    /// The inverse; none where the matrix is not positive definite.
    pub fn inverse(self) -> Option<Self> {
        let a = self.yy * self.hh - self.yh * self.yh;
        let b = self.xh * self.yh - self.xy * self.hh;
        let c = self.xy * self.yh - self.xh * self.yy;
        let det = self.xx * a + self.xy * b + self.xh * c;
        let minor = self.xx * self.yy - self.xy * self.xy;
        if !(self.xx > 0.0 && minor > 0.0 && det > 0.0 && det.is_finite()) {
            return None;
        }
        let s = 1.0 / det;
        Some(Self {
            xx: a * s,
            xy: b * s,
            xh: c * s,
            yy: (self.xx * self.hh - self.xh * self.xh) * s,
            yh: (self.xy * self.xh - self.xx * self.yh) * s,
            hh: minor * s,
        })
    }

    /// The matrix of the same quantity in axes turned by an angle: `R M Rᵀ` on x and y.
    #[must_use]
    pub fn turned(self, angle_rad: f64) -> Self {
        let (s, c) = angle_rad.sin_cos();
        Self {
            xx: c * c * self.xx - 2.0 * s * c * self.xy + s * s * self.yy,
            xy: s * c * (self.xx - self.yy) + (c * c - s * s) * self.xy,
            xh: c * self.xh - s * self.yh,
            yy: s * s * self.xx + 2.0 * s * c * self.xy + c * c * self.yy,
            yh: s * self.xh + c * self.yh,
            hh: self.hh,
        }
    }

    /// The information on x and y alone, whatever the heading: least and greatest eigenvalue, and
    /// the direction of the greatest.
    pub fn translation(self) -> (f64, f64, Point2) {
        let hh = self.hh.max(f64::MIN_POSITIVE);
        let xx = self.xx - self.xh * self.xh / hh;
        let xy = self.xy - self.xh * self.yh / hh;
        let yy = self.yy - self.yh * self.yh / hh;
        let (mean, half) = (0.5 * (xx + yy), 0.5 * (xx - yy));
        let spread = (half * half + xy * xy).sqrt();
        let direction = Point2::unit(0.5 * xy.atan2(half));
        ((mean - spread).max(0.0), mean + spread, direction)
    }
}

/// The difference of two poses as a vector, its heading wrapped.
pub fn difference(to: Pose2, from: Pose2) -> [f64; 3] {
    let turn = formicar::geometry::wrap_angle(to.heading - from.heading);
    [to.x - from.x, to.y - from.y, turn]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn positive() -> impl Strategy<Value = Sym3> {
        prop::array::uniform9(-2.0..2.0_f64).prop_map(|a| {
            // A Aᵀ + I / 10.
            let dot = |i: usize, j: usize| (0..3).map(|k| a[3 * i + k] * a[3 * j + k]).sum::<f64>();
            Sym3 {
                xx: dot(0, 0) + 0.1,
                xy: dot(0, 1),
                xh: dot(0, 2),
                yy: dot(1, 1) + 0.1,
                yh: dot(1, 2),
                hh: dot(2, 2) + 0.1,
            }
        })
    }

    proptest! {
        #[test]
        fn inverse_and_turn(m in positive(), v in prop::array::uniform3(-1.0..1.0_f64), angle in -4.0..4.0_f64) {
            let back = m.inverse().unwrap().product(m.product(v));
            for (a, b) in back.iter().zip(v) {
                prop_assert!((a - b).abs() < 1e-6);
            }
            let turned = Pose2::new(0.0, 0.0, angle).transform(Point2::new(v[0], v[1]));
            let form = m.turned(angle).form([turned.x, turned.y, v[2]]);
            prop_assert!((form - m.form(v)).abs() < 1e-9);
        }
    }

    #[test]
    fn translation_leaves_out_the_heading() {
        let (least, greatest, direction) = Sym3::diagonal(1.0, 9.0, 4.0).translation();
        assert!((least - 1.0).abs() < 1e-12 && (greatest - 9.0).abs() < 1e-12);
        assert!(direction.x.abs() < 1e-12);
        assert!(Sym3::diagonal(1.0, 0.0, 1.0).inverse().is_none());
    }
}
