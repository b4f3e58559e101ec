//! Angles on the circle.

use std::f64::consts::{PI, TAU};

/// The largest heading that documents state: a turn, rounded up. A larger one is in degrees.
#[cfg(feature = "serde")]
pub(crate) const MAX_STATED_HEADING_RAD: f64 = TAU + 1e-4;

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

/// Norm of a quaternion below which it points nowhere.
const MIN_NORM: f64 = 1e-6;

/// The turn around the z axis of a quaternion `[x, y, z, w]`, which need not be of norm 1; none
/// where it is no rotation.
pub fn yaw_of_quaternion(quaternion: [f64; 4]) -> Option<f64> {
    let norm = quaternion
        .iter()
        .map(|part| part * part)
        .sum::<f64>()
        .sqrt();
    if !(MIN_NORM..=1.0 / MIN_NORM).contains(&norm) {
        return None;
    }
    let [x, y, z, w] = quaternion.map(|part| part / norm);
    Some((2.0 * (w * z + x * y)).atan2(1.0 - 2.0 * (y * y + z * z)))
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
