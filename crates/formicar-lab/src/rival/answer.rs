//! The answer of a program, as JSON.

use anyhow::{Context, Result, bail};
use formicar::geometry::Point2;
use formicar::validation::Samples;
use serde::{Deserialize, Serialize};

/// The one document on the stdout of a program.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RivalAnswer {
    /// `ready` (who it is was asked), `found`, or a word for why there is no path: `not_found`,
    /// `refused` (a request that it does not plan for), `unavailable` (it is not installed).
    pub status: String,
    /// The reason why there is no path.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// Name and version of the planner.
    pub version: String,
    /// Poses of the path, dense: [x, y, heading], or [x, y] where it knows no headings.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub poses: Vec<Vec<f64>>,
    /// Time to the first path, seconds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub first_feasible_s: Option<f64>,
    /// The query without reading and setting up, seconds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub query_s: Option<f64>,
    /// Setting up, seconds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub map_setup_s: Option<f64>,
    /// Processor time in all, seconds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cpu_s: Option<f64>,
    /// Most memory, bytes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub peak_rss_bytes: Option<u64>,
    /// [time, length] of every path that was better than those before, seconds and meters.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub improvements: Vec<[f64; 2]>,
    /// Poses of the paths of `improvements` but the last, whose poses are `poses`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub earlier_poses: Vec<Vec<Vec<f64>>>,
    /// Processor time to the first path, seconds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub first_feasible_cpu_s: Option<f64>,
    /// Processor time of the query, seconds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub query_cpu_s: Option<f64>,
    /// Processor time of setting up, seconds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub map_setup_cpu_s: Option<f64>,
    /// Processor time to each path of `improvements`, seconds.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub improvements_cpu_s: Vec<f64>,
}

/// The most poses of a path.
const MAX_POSES: usize = 1_000_000;

/// Words for the status of an answer.
const STATUSES: [&str; 5] = ["ready", "found", "not_found", "refused", "unavailable"];

impl RivalAnswer {
    /// An answer without a path.
    pub fn without_path(status: &str, reason: &str) -> Self {
        Self {
            status: status.to_owned(),
            reason: Some(reason.to_owned()),
            ..Self::default()
        }
    }

    /// Reads what a program has printed.
    ///
    /// # Errors
    /// A text that is no answer, and values out of range, by their field.
    pub fn read(text: &str) -> Result<Self> {
        let answer: Self = serde_json::from_str(text).context("expected one JSON object")?;
        answer.check()?;
        Ok(answer)
    }

    fn check(&self) -> Result<()> {
        if !STATUSES.contains(&self.status.as_str()) {
            bail!(
                "status: {:?}; expected one of {}",
                self.status,
                STATUSES.join(", ")
            );
        }
        if self.status == "found" && self.poses.is_empty() {
            bail!("poses: none, and the status is found; expected [[x, y, heading], ...]");
        }
        let times = [
            ("first_feasible_s", self.first_feasible_s),
            ("query_s", self.query_s),
            ("map_setup_s", self.map_setup_s),
            ("cpu_s", self.cpu_s),
            ("first_feasible_cpu_s", self.first_feasible_cpu_s),
            ("query_cpu_s", self.query_cpu_s),
            ("map_setup_cpu_s", self.map_setup_cpu_s),
        ];
        for (field, time_s) in times {
            if let Some(time_s) = time_s.filter(|s| !(0.0..=1e9).contains(s)) {
                bail!("{field}: {time_s}; expected seconds from 0 on");
            }
        }
        let is_improvement = |[at_s, length_m]: &[f64; 2]| *at_s >= 0.0 && *length_m >= 0.0;
        if let Some(i) = self.improvements.iter().position(|i| !is_improvement(i)) {
            bail!("improvements[{i}]: expected [seconds, meters], both from 0 on");
        }
        self.check_course()?;
        check_poses("poses", &self.poses)?;
        let mut earlier = self.earlier_poses.iter().enumerate();
        earlier.try_for_each(|(i, poses)| check_poses(&format!("earlier_poses[{i}]"), poses))
    }

    /// What is told of the improvements is told of each of them.
    fn check_course(&self) -> Result<()> {
        let n = self.improvements.len();
        let told = [
            ("improvements_cpu_s", self.improvements_cpu_s.len(), n),
            (
                "earlier_poses",
                self.earlier_poses.len(),
                n.saturating_sub(1),
            ),
        ];
        match told
            .iter()
            .find(|(_, n_told, n)| *n_told > 0 && n_told != n)
        {
            Some((field, n_told, n)) => {
                bail!("{field}: {n_told} of them; expected {n}, as improvements tells")
            }
            None => Ok(()),
        }
    }

    /// The path as samples.
    pub fn samples(&self) -> Samples {
        samples(&self.poses)
    }

    /// The path of an improvement as samples; none where its poses are not told.
    pub fn samples_of(&self, improvement: usize) -> Option<Samples> {
        let is_last = improvement + 1 == self.improvements.len();
        let poses = is_last.then_some(&self.poses);
        poses
            .or(self.earlier_poses.get(improvement))
            .map(|poses| samples(poses))
    }
}

fn check_poses(field: &str, poses: &[Vec<f64>]) -> Result<()> {
    if poses.len() > MAX_POSES {
        bail!(
            "{field}: {} of them; expected at most {MAX_POSES}",
            poses.len()
        );
    }
    let n_numbers = poses.first().map_or(3, Vec::len);
    let is_pose = |pose: &Vec<f64>| {
        let is_number = |value: &f64| value.abs() <= 1e9;
        (2..=3).contains(&n_numbers) && pose.len() == n_numbers && pose.iter().all(is_number)
    };
    match poses.iter().position(|pose| !is_pose(pose)) {
        Some(i) => bail!(
            "{field}[{i}]: expected [x, y, heading], or [x, y] in all of them, each between -1e9 \
             and 1e9"
        ),
        None => Ok(()),
    }
}

fn samples(poses: &[Vec<f64>]) -> Samples {
    let has_headings = poses.first().is_some_and(|pose| pose.len() == 3);
    let headings = || poses.iter().map(|pose| pose[2]).collect();
    Samples {
        points: poses
            .iter()
            .map(|pose| Point2::new(pose[0], pose[1]))
            .collect(),
        headings: has_headings.then(headings),
        rounding_m: 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_wrong_is_told_by_its_field() {
        let cases = [
            ("", "expected one JSON object"),
            ("{}", "status: \"\"; expected one of ready, found"),
            (r#"{"status": "found"}"#, "poses: none"),
            (
                r#"{"status": "found", "poses": [[1, 2], [1, 2, 3]]}"#,
                "poses[1]",
            ),
            (r#"{"status": "found", "poses": [[1]]}"#, "poses[0]"),
            (r#"{"status": "found", "poses": [[1, 2e9]]}"#, "poses[0]"),
            (r#"{"status": "ready", "query_s": -1}"#, "query_s: -1"),
            (
                r#"{"status": "ready", "improvements": [[0, -1]]}"#,
                "improvements[0]",
            ),
            (
                r#"{"status": "ready", "improvements": [[0, 1], [1, 1]], "improvements_cpu_s": [0]}"#,
                "improvements_cpu_s: 1 of them; expected 2",
            ),
            (
                r#"{"status": "ready", "improvements": [[0, 1], [1, 1]], "earlier_poses": [[[1]]]}"#,
                "earlier_poses[0][0]",
            ),
            (
                r#"{"status": "ready", "speed": 1}"#,
                "unknown field `speed`",
            ),
        ];
        for (text, told) in cases {
            let error = format!("{:#}", RivalAnswer::read(text).unwrap_err());
            assert!(error.contains(told), "{text}: {error}");
        }
    }

    #[test]
    fn poses_are_samples() {
        let answer = RivalAnswer::read(r#"{"status": "found", "poses": [[1, 2, 3]]}"#).unwrap();
        assert_eq!(answer.samples().headings, Some(vec![3.0]));
        let answer = RivalAnswer::read(r#"{"status": "found", "poses": [[1, 2]]}"#).unwrap();
        assert_eq!(answer.samples().points, [Point2::new(1.0, 2.0)]);
        assert_eq!(answer.samples().headings, None);
    }

    #[test]
    fn improvements_have_paths_of_their_own() {
        let answer = RivalAnswer {
            improvements: vec![[0.1, 9.0], [0.2, 8.0]],
            poses: vec![vec![8.0, 0.0]],
            earlier_poses: vec![vec![vec![9.0, 0.0]]],
            ..RivalAnswer::default()
        };
        let x = |i| answer.samples_of(i).map(|samples| samples.points[0].x);
        assert_eq!([x(0), x(1), x(2)], [Some(9.0), Some(8.0), None]);
    }
}
