//! Angles on the circle.

use std::f64::consts::{PI, TAU};

/// The same direction in `(-pi, pi]`.
pub fn wrap_angle(angle_rad: f64) -> f64 {
    if -PI < angle_rad && angle_rad <= PI {
        return angle_rad;
    }
    let wrapped = angle_rad.rem_euclid(TAU);
    if wrapped > PI { wrapped - TAU } else { wrapped }
}

/// The turn from `from` to `to`, in `(-pi, pi]`.
///
/// ```
/// use formicar::geometry::angle_difference;
/// use std::f64::consts::{FRAC_PI_2, PI};
///
/// assert!((angle_difference(-0.75 * PI, 0.75 * PI) - FRAC_PI_2).abs() < 1e-12);
/// ```
pub fn angle_difference(to: f64, from: f64) -> f64 {
    wrap_angle(to - from)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wraps_to_the_half_open_interval() {
        assert_eq!(wrap_angle(PI), PI);
        assert!((wrap_angle(-PI) - PI).abs() < 1e-12);
        assert!((wrap_angle(3.5 * PI) + 0.5 * PI).abs() < 1e-12);
        assert!((angle_difference(-3.0, 3.0) - (TAU - 6.0)).abs() < 1e-12);
    }
}
