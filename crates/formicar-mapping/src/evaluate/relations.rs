//! The relations metric of Kümmerle et al. (2009), and absolute trajectory errors.

use crate::log::Relation;
use crate::scan::LaserScan;
use formicar::Pose2;
use serde::Serialize;

/// Errors of relative poses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct RelationErrors {
    /// Number of relations.
    pub n: usize,
    /// Mean translation error, meters.
    pub mean_m: f64,
    /// Sample standard deviation of it, meters.
    pub std_m: f64,
    /// Median translation error, meters.
    pub median_m: f64,
    /// Greatest translation error, meters.
    pub max_m: f64,
    /// Mean of the absolute rotation error, degrees.
    pub mean_deg: f64,
    /// Sample standard deviation of it, degrees.
    pub std_deg: f64,
}

/// Errors of pairs of scans: how far the motion by `poses` is from that by `reference`.
///
/// The error of a pair is the translation and the rotation of `(true motion)⁻¹ (own motion)`.
pub fn relation_errors(
    poses: &[Pose2],
    reference: &[Pose2],
    pairs: &[(usize, usize)],
) -> RelationErrors {
    let errors = pairs.iter().map(|&(i, j)| {
        let truth = reference[i].relative(reference[j]);
        truth.relative(poses[i].relative(poses[j])).wrapped()
    });
    summary(errors)
}

/// Errors of the relations of a file, whose times are looked up among the scans.
///
/// Relations with a time that no scan is within `tolerance_s` of are left out; their number comes
/// second.
pub fn relation_file_errors(
    poses: &[Pose2],
    scans: &[LaserScan],
    relations: &[Relation],
    tolerance_s: f64,
) -> (RelationErrors, usize) {
    let mut by_time: Vec<(f64, usize)> = scans
        .iter()
        .enumerate()
        .map(|(i, s)| (s.time_s, i))
        .collect();
    by_time.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let at = |time_s: f64| {
        let after = by_time.partition_point(|(t, _)| *t < time_s);
        let near = [after.checked_sub(1), Some(after)];
        let near = near.into_iter().flatten().filter_map(|i| by_time.get(i));
        let nearest = near.min_by(|a, b| (a.0 - time_s).abs().total_cmp(&(b.0 - time_s).abs()));
        nearest
            .filter(|(t, _)| (t - time_s).abs() <= tolerance_s)
            .map(|(_, i)| *i)
    };
    let mut n_missing = 0;
    let mut errors = Vec::new();
    for relation in relations {
        match (at(relation.from_s), at(relation.to_s)) {
            (Some(i), Some(j)) => {
                let own = poses[i].relative(poses[j]);
                errors.push(relation.motion.relative(own).wrapped());
            }
            _ => n_missing += 1,
        }
    }
    (summary(errors.into_iter()), n_missing)
}

fn summary(errors: impl Iterator<Item = Pose2>) -> RelationErrors {
    let (mut lengths, turns): (Vec<f64>, Vec<f64>) = errors
        .map(|e| (e.position().norm(), e.heading.abs().to_degrees()))
        .unzip();
    let (mean_m, std_m) = mean_and_std(&lengths);
    let (mean_deg, std_deg) = mean_and_std(&turns);
    lengths.sort_by(f64::total_cmp);
    RelationErrors {
        n: lengths.len(),
        mean_m,
        std_m,
        median_m: lengths.get(lengths.len() / 2).copied().unwrap_or(0.0),
        max_m: lengths.last().copied().unwrap_or(0.0),
        mean_deg,
        std_deg,
    }
}

fn mean_and_std(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n.max(1.0);
    let squares: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
    (mean, (squares / (n - 1.0).max(1.0)).sqrt())
}

/// Pairs of scans in a row.
pub fn neighbor_pairs(n_scans: usize) -> Vec<(usize, usize)> {
    (1..n_scans).map(|i| (i - 1, i)).collect()
}

/// Pairs of scans within `reach_m` by the reference that are more than `min_gap` scans apart: for
/// each scan, at most six of those before it, evenly spread.
pub fn loop_pairs(reference: &[Pose2], reach_m: f64, min_gap: usize) -> Vec<(usize, usize)> {
    const MAX_PER_SCAN: usize = 6;
    let mut pairs = Vec::new();
    for i in 0..reference.len() {
        let near: Vec<usize> = (0..i.saturating_sub(min_gap))
            .filter(|&j| reference[i].position().distance(reference[j].position()) < reach_m)
            .collect();
        let n = near.len().min(MAX_PER_SCAN);
        pairs.extend((0..n).map(|k| (near[k * near.len() / n], i)));
    }
    pairs
}

/// Positions after the best rigid alignment with a reference.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct TrajectoryError {
    /// Root mean square distance, meters.
    pub rmse_m: f64,
    /// Mean distance, meters.
    pub mean_m: f64,
    /// Greatest distance, meters.
    pub max_m: f64,
    /// The motion that carries the own poses onto the reference.
    #[serde(skip)]
    pub alignment: Pose2,
}

/// The absolute trajectory error: distances after the rigid motion of least squared distances.
pub fn trajectory_error(poses: &[Pose2], reference: &[Pose2]) -> TrajectoryError {
    let n = poses.len().min(reference.len());
    let (poses, reference) = (&poses[..n], &reference[..n]);
    let alignment = rigid_alignment(poses, reference);
    let distances: Vec<f64> = poses
        .iter()
        .zip(reference)
        .map(|(pose, truth)| {
            alignment
                .transform(pose.position())
                .distance(truth.position())
        })
        .collect();
    let count = (n as f64).max(1.0);
    TrajectoryError {
        rmse_m: (distances.iter().map(|d| d * d).sum::<f64>() / count).sqrt(),
        mean_m: distances.iter().sum::<f64>() / count,
        max_m: distances.iter().copied().fold(0.0, f64::max),
        alignment,
    }
}

fn rigid_alignment(poses: &[Pose2], reference: &[Pose2]) -> Pose2 {
    use formicar::Point2;
    let n = (poses.len() as f64).max(1.0);
    let mean = |list: &[Pose2]| {
        list.iter()
            .fold(Point2::default(), |sum, p| sum + p.position())
            * (1.0 / n)
    };
    let (a, b) = (mean(poses), mean(reference));
    let (mut dot, mut cross) = (0.0, 0.0);
    for (pose, truth) in poses.iter().zip(reference) {
        let (u, v) = (pose.position() - a, truth.position() - b);
        dot += u.dot(v);
        cross += u.cross(v);
    }
    let turn = Pose2::new(0.0, 0.0, cross.atan2(dot));
    Pose2::at(b - turn.transform(a), turn.heading)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn poses() -> Vec<Pose2> {
        (0..60)
            .map(|i| {
                let t = f64::from(i) * 0.2;
                Pose2::new(3.0 * t.cos(), 2.0 * t.sin(), t)
            })
            .collect()
    }

    proptest! {
        #[test]
        fn a_rigid_motion_changes_no_error(x in -9.0..9.0_f64, y in -9.0..9.0_f64, h in -3.0..3.0_f64) {
            let truth = poses();
            let by = Pose2::new(x, y, h);
            let moved: Vec<Pose2> = truth.iter().map(|&p| by.compose(p)).collect();
            prop_assert!(trajectory_error(&moved, &truth).rmse_m < 1e-9);
            let errors = relation_errors(&moved, &truth, &neighbor_pairs(truth.len()));
            prop_assert!(errors.max_m < 1e-9 && errors.mean_deg < 1e-9);
        }
    }

    #[test]
    fn errors_are_those_of_the_one_pose_that_is_off() {
        let truth = poses();
        let mut off = truth.clone();
        off[10] = off[10].compose(Pose2::new(0.3, 0.4, 0.1));
        let errors = relation_errors(&off, &truth, &[(9, 10), (20, 21)]);
        assert!((errors.max_m - 0.5).abs() < 1e-9 && (errors.mean_m - 0.25).abs() < 1e-9);
        assert!((errors.mean_deg - 0.05_f64.to_degrees()).abs() < 1e-9);
        let pairs = loop_pairs(&truth, 2.0, 20);
        assert!(pairs.iter().all(|(i, j)| j - i > 20) && !pairs.is_empty());
    }

    #[test]
    fn relations_find_their_scans_by_time() {
        let scans: Vec<LaserScan> = (0..60)
            .map(|i| LaserScan {
                time_s: f64::from(i),
                ..LaserScan::default()
            })
            .collect();
        let truth = poses();
        let relation = |from_s: f64, to_s: f64| Relation {
            from_s,
            to_s,
            motion: truth[5].relative(truth[30]),
        };
        let relations = [relation(5.01, 29.99), relation(5.4, 30.0)];
        let (errors, n_missing) = relation_file_errors(&truth, &scans, &relations, 0.1);
        assert_eq!((errors.n, n_missing), (1, 1));
        assert!(errors.max_m < 1e-9);
    }
}
