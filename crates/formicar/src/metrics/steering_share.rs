//! Turning of a path from step to step.

use super::resample::resampled;
use crate::geometry::angle_difference;
use crate::path::CurvePath;

/// Shares of steps by how much the heading changes over them (Li 2024, Table 2).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct SteeringShare {
    /// By at most 5 degrees.
    pub to_5_deg: f64,
    /// By more than 5, at most 10 degrees.
    pub from_5_to_10_deg: f64,
    /// By more than 10 degrees.
    pub over_10_deg: f64,
}

impl SteeringShare {
    /// The cell size of Li 2024: the paper does not say how far apart its path points are.
    pub const DEFAULT_SPACING_M: f64 = 0.2;

    /// No more steps than this, however fine the spacing.
    const MAX_STEPS: f64 = 1e6;

    /// The shares over equal steps of at most `spacing_m` meters along the path; all 0 where the
    /// path or the spacing has no length.
    pub fn new(path: &CurvePath, spacing_m: f64) -> Self {
        let n_steps = (path.length_m() / spacing_m).ceil();
        if !(1.0..=Self::MAX_STEPS).contains(&n_steps) {
            return Self::default();
        }
        let mut counts = [0_usize; 3];
        for step in resampled(path, n_steps as usize + 1).windows(2) {
            let change = angle_difference(step[1].heading, step[0].heading).abs();
            // Rounding must not move a turn of exactly 5 or 10 degrees up a class.
            let degrees = change.to_degrees() - 1e-9;
            counts[usize::from(degrees > 5.0) + usize::from(degrees > 10.0)] += 1;
        }
        let [to_5_deg, from_5_to_10_deg, over_10_deg] = counts.map(|n| n as f64 / n_steps);
        Self {
            to_5_deg,
            from_5_to_10_deg,
            over_10_deg,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Point2, Pose2};
    use crate::path::Direction;

    #[test]
    fn sorts_steps_into_three_classes() {
        let mut path = CurvePath::new(Pose2::default());
        path.push(0.0, 2.0, Direction::Forward);
        path.push(7_f64.to_radians(), 1.0, Direction::Forward);
        path.push(20_f64.to_radians(), 1.0, Direction::Reverse);
        let share = SteeringShare::new(&path, 1.0);
        assert_eq!(
            (share.to_5_deg, share.from_5_to_10_deg, share.over_10_deg),
            (0.5, 0.25, 0.25)
        );
    }

    #[test]
    fn a_corner_is_one_step() {
        let points = [(0., 0.), (1.05, 0.), (1.05, 0.95)].map(|(x, y)| Point2::new(x, y));
        let share = SteeringShare::new(&CurvePath::from_polyline(&points), 0.2);
        assert!((share.over_10_deg - 0.1).abs() < 1e-12, "{share:?}");
    }

    #[test]
    fn bad_spacings_have_no_shares() {
        let mut path = CurvePath::new(Pose2::default());
        path.push(0.0, 2.0, Direction::Forward);
        for spacing in [0.0, -1.0, f64::NAN, 1e-300] {
            assert_eq!(SteeringShare::new(&path, spacing), SteeringShare::default());
        }
    }
}
