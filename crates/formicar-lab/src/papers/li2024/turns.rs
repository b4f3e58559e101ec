//! Turns of a path from point to point (Li 2024, Table 2).

use formicar::geometry::{Point2, Pose2, angle_difference};
use formicar::path::CurvePath;

/// Shares of turns up to 5, from 5 to 10, and above 10 degrees, and the largest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Turns {
    pub(super) shares: [f64; 3],
    pub(super) largest_deg: f64,
}

impl Turns {
    /// At the inner nodes of a polyline; `None` where it has none.
    pub(super) fn of_polyline(points: &[Point2]) -> Option<Self> {
        let steps: Vec<Point2> = points
            .windows(2)
            .map(|w| w[1] - w[0])
            .filter(|step| step.norm() > 0.0)
            .collect();
        let turns = steps
            .windows(2)
            .map(|w| w[0].cross(w[1]).atan2(w[0].dot(w[1])).abs());
        Self::of(turns)
    }

    /// Over equal steps of at most `spacing_m` along a curve; `None` where it has no length.
    pub(super) fn of_curve(path: &CurvePath, spacing_m: f64) -> Option<Self> {
        let n_steps = (path.length_m() / spacing_m).ceil() as usize;
        let step_m = path.length_m() / n_steps.max(1) as f64;
        let poses: Vec<Pose2> = (0..=n_steps)
            .map(|i| pose_at(path, i as f64 * step_m))
            .collect();
        let turns = poses
            .windows(2)
            .map(|w| angle_difference(w[1].heading, w[0].heading).abs());
        Self::of(turns)
    }

    fn of(turns_rad: impl Iterator<Item = f64>) -> Option<Self> {
        let (mut counts, mut n, mut largest_deg) = ([0.0; 3], 0.0, 0.0_f64);
        for turn_rad in turns_rad {
            // Rounding must not move a turn of exactly 5 or 10 degrees up a class.
            let degrees = turn_rad.to_degrees() - 1e-9;
            counts[usize::from(degrees > 5.0) + usize::from(degrees > 10.0)] += 1.0;
            n += 1.0;
            largest_deg = largest_deg.max(degrees);
        }
        (n > 0.0).then(|| Self {
            shares: counts.map(|count| count / n),
            largest_deg: largest_deg.max(0.0),
        })
    }
}

/// The pose after a distance along a path.
fn pose_at(path: &CurvePath, s_m: f64) -> Pose2 {
    let mut begin_m = 0.0;
    for segment in path.segments() {
        if s_m < begin_m + segment.length_m {
            return segment.pose_at(s_m - begin_m);
        }
        begin_m += segment.length_m;
    }
    path.end()
}

#[cfg(test)]
mod tests {
    use super::*;
    use formicar::metrics::SteeringShare;
    use formicar::path::Direction;

    #[test]
    fn polylines_turn_at_their_nodes() {
        let points = [(0., 0.), (1., 0.), (2., 0.1), (2., 1.)].map(|(x, y)| Point2::new(x, y));
        let turns = Turns::of_polyline(&points).unwrap();
        assert_eq!(turns.shares, [0.0, 0.5, 0.5]);
        assert!((turns.largest_deg - 84.289_406_862_5).abs() < 1e-6);
        assert_eq!(Turns::of_polyline(&points[..2]), None);
    }

    #[test]
    fn curves_are_measured_as_the_library_does() {
        let mut path = CurvePath::new(Pose2::default());
        for (curvature, length) in [(0.0, 3.3), (0.1, 2.7), (-0.15, 4.1), (0.4, 1.9)] {
            path.push(curvature, length, Direction::Forward);
        }
        for spacing_m in [0.2, 1.0] {
            let turns = Turns::of_curve(&path, spacing_m).unwrap();
            let share = SteeringShare::new(&path, spacing_m);
            let expected = [share.to_5_deg, share.from_5_to_10_deg, share.over_10_deg];
            assert_eq!(turns.shares, expected);
        }
        let largest = Turns::of_curve(&path, 1.0).unwrap().largest_deg;
        assert!((largest - 0.4_f64.to_degrees()).abs() < 0.01, "{largest}");
        assert_eq!(
            Turns::of_curve(&CurvePath::new(Pose2::default()), 1.0),
            None
        );
    }
}
