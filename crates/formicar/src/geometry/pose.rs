//! A position with a heading, and exact motion along arcs.

use super::{Point2, wrap_angle};

/// A position in meters and a heading in radians, counter-clockwise from the x axis.
///
/// As a vehicle's pose it is the center of the rear axle.
///
/// ```
/// use formicar::Pose2;
/// use std::f64::consts::PI;
///
/// // Half a circle of radius 2 m to the left.
/// let end = Pose2::new(1.0, 0.0, 0.0).advance(0.5, 2.0 * PI);
/// assert!((end.y - 4.0).abs() < 1e-12 && (end.heading - PI).abs() < 1e-12);
/// let there = Pose2::new(1.0, 0.0, 0.0).relative(end);
/// assert!((there.x - 0.0).abs() < 1e-12 && (there.y - 4.0).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Pose2 {
    /// Position along the x axis, meters.
    pub x: f64,
    /// Position along the y axis, meters.
    pub y: f64,
    /// Heading, radians; any real number, wrapped only on output.
    pub heading: f64,
}

impl Pose2 {
    /// The pose at `(x, y)` meters with a heading in radians.
    pub const fn new(x: f64, y: f64, heading: f64) -> Self {
        Self { x, y, heading }
    }

    /// The pose at a point.
    pub const fn at(position: Point2, heading: f64) -> Self {
        Self::new(position.x, position.y, heading)
    }

    /// The position alone.
    pub const fn position(self) -> Point2 {
        Point2::new(self.x, self.y)
    }

    /// A point given in this pose's frame, in the frame that the pose is given in.
    pub fn transform(self, local: Point2) -> Point2 {
        let (sin, cos) = self.heading.sin_cos();
        Point2::new(
            self.x + cos * local.x - sin * local.y,
            self.y + sin * local.x + cos * local.y,
        )
    }

    /// A pose given in this pose's frame, in the frame that this pose is given in.
    pub fn compose(self, local: Self) -> Self {
        Self::at(
            self.transform(local.position()),
            self.heading + local.heading,
        )
    }

    /// The pose `local` with `self.compose(local) == other`.
    pub fn relative(self, other: Self) -> Self {
        let (sin, cos) = self.heading.sin_cos();
        let d = other.position() - self.position();
        Self::new(
            cos * d.x + sin * d.y,
            cos * d.y - sin * d.x,
            other.heading - self.heading,
        )
    }

    /// The pose after driving a signed arc length at a constant curvature (positive left).
    ///
    /// Written with the sine cardinal, so that straight motion needs no case of its own.
    #[must_use]
    pub fn advance(self, curvature_per_m: f64, signed_length_m: f64) -> Self {
        let half_turn = 0.5 * curvature_per_m * signed_length_m;
        let chord = Point2::unit(self.heading + half_turn) * (signed_length_m * sinc(half_turn));
        Self::at(self.position() + chord, self.heading + 2.0 * half_turn)
    }

    /// The same pose with its heading in `(-pi, pi]`.
    #[must_use]
    pub fn wrapped(self) -> Self {
        Self::at(self.position(), wrap_angle(self.heading))
    }

    /// True if all three numbers are finite.
    pub fn is_finite(self) -> bool {
        self.position().is_finite() && self.heading.is_finite()
    }
}

/// sin(x) / x, by its series where the quotient would lose digits.
fn sinc(x: f64) -> f64 {
    if x.abs() < 1e-3 {
        let x2 = x * x;
        1.0 - x2 / 6.0 * (1.0 - x2 / 20.0)
    } else {
        x.sin() / x
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn advance_follows_the_circle() {
        let quarter = Pose2::default().advance(0.5, PI);
        assert!((quarter.x - 2.0).abs() < 1e-12 && (quarter.y - 2.0).abs() < 1e-12);
        assert!((quarter.heading - FRAC_PI_2).abs() < 1e-12);
        let back = quarter.advance(0.5, -PI);
        assert!(back.position().norm() < 1e-12 && back.heading.abs() < 1e-12);
    }

    #[test]
    fn advance_is_smooth_where_the_series_takes_over() {
        let at = |turn: f64| Pose2::default().advance(turn, 1.0);
        assert!((at(1.999_999e-3).y - at(2.000_001e-3).y).abs() < 2e-9);
    }

    #[test]
    fn relative_undoes_compose() {
        let (a, b) = (Pose2::new(3.0, -1.0, 2.0), Pose2::new(0.5, 4.0, -1.0));
        let back = a.relative(a.compose(b));
        assert!(back.position().distance(b.position()) < 1e-12);
        assert!((back.heading - b.heading).abs() < 1e-12);
    }
}
