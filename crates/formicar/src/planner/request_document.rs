//! A request as a JSON object: what `plan --stdin` reads and every answer repeats.

use crate::geometry::Pose2;
use crate::scenario::ScenarioError;
use crate::scenario::{
    CurvatureMode, GoalHeading, GoalTolerance, MotionMode, Request, StartHeading,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// One request on the wire; what is left out takes the value that the planner was started with.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct RequestDocument {
    /// Anything; the answer repeats it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub id: Option<serde_json::Value>,
    /// Start pose `[x m, y m, heading rad]`.
    pub start: Option<[f64; 3]>,
    /// Goal pose `[x m, y m, heading rad]`.
    pub goal: Option<[f64; 3]>,
    /// How far from the goal a path may end.
    pub goal_tolerance: Option<GoalTolerance>,
    /// Which gears may be used.
    pub motion: Option<MotionMode>,
    /// Whether the curvature may jump: `"arcs"`, or `{"continuous": {"max_rate_per_m2": 0.5}}`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub curvature: Option<CurvatureMode>,
    /// Whether the start heading is fixed.
    pub start_heading: Option<StartHeading>,
    /// Whether the goal heading is fixed.
    pub goal_heading: Option<GoalHeading>,
    /// Time after which to give up, milliseconds.
    pub deadline_ms: Option<f64>,
    /// Search steps after which to give up.
    pub budget_steps: Option<u64>,
    /// The seed of the run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
}

impl RequestDocument {
    /// The request, with what is left out taken from `defaults`.
    ///
    /// # Errors
    /// No start or goal here nor there, or a deadline that is no time.
    pub fn onto(&self, defaults: &RequestDocument) -> Result<Request, ScenarioError> {
        let pose = |own: Option<[f64; 3]>, other: Option<[f64; 3]>, what| {
            let [x, y, heading] = own.or(other).ok_or(ScenarioError::Missing { what })?;
            Ok(Pose2::new(x, y, heading))
        };
        let deadline_ms = self.deadline_ms.or(defaults.deadline_ms);
        Ok(Request {
            start: pose(self.start, defaults.start, "start")?,
            goal: pose(self.goal, defaults.goal, "goal")?,
            start_heading: self
                .start_heading
                .or(defaults.start_heading)
                .unwrap_or_default(),
            goal_heading: self
                .goal_heading
                .or(defaults.goal_heading)
                .unwrap_or_default(),
            goal_tolerance: self
                .goal_tolerance
                .or(defaults.goal_tolerance)
                .unwrap_or_default(),
            motion: self.motion.or(defaults.motion).unwrap_or_default(),
            curvature: self.curvature.or(defaults.curvature).unwrap_or_default(),
            deadline: deadline_ms.map(deadline).transpose()?,
            budget_steps: self.budget_steps.or(defaults.budget_steps),
        })
    }
}

/// The longest deadline, milliseconds: a year or so.
const MAX_DEADLINE_MS: f64 = 3e10;

fn deadline(milliseconds: f64) -> Result<Duration, ScenarioError> {
    if milliseconds > 0.0 && milliseconds <= MAX_DEADLINE_MS {
        return Ok(Duration::from_secs_f64(milliseconds / 1e3));
    }
    Err(ScenarioError::OutOfRange {
        what: "deadline_ms",
        value: milliseconds,
        range: "above 0 and at most 3e10",
    })
}

impl From<&Request> for RequestDocument {
    fn from(request: &Request) -> Self {
        let list = |pose: Pose2| Some([pose.x, pose.y, pose.heading]);
        Self {
            id: None,
            start: list(request.start),
            goal: list(request.goal),
            goal_tolerance: Some(request.goal_tolerance),
            motion: Some(request.motion),
            // Left out where nothing was asked for, so that such answers stay what they were.
            curvature: Some(request.curvature).filter(|&c| c != CurvatureMode::Arcs),
            start_heading: Some(request.start_heading),
            goal_heading: Some(request.goal_heading),
            deadline_ms: request.deadline.map(|d| d.as_secs_f64() * 1e3),
            budget_steps: request.budget_steps,
            seed: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::CurvatureRate;

    #[test]
    fn a_request_survives_the_wire() {
        let mut request = Request::new(Pose2::new(1.0, 2.0, 0.1), Pose2::new(3.0, 4.0, -0.1));
        request.motion = MotionMode::Forward;
        request.curvature = CurvatureMode::Continuous(CurvatureRate {
            max_rate_per_m2: Some(0.5),
        });
        request.deadline = Some(Duration::from_millis(250));
        let json = serde_json::to_string(&RequestDocument::from(&request)).unwrap();
        let back: RequestDocument = serde_json::from_str(&json).unwrap();
        assert_eq!(back.onto(&RequestDocument::default()).unwrap(), request);
    }

    #[test]
    fn what_is_left_out_comes_from_the_defaults() {
        let request = Request::new(Pose2::default(), Pose2::new(3.0, 4.0, 0.0));
        let line: RequestDocument = serde_json::from_str(r#"{"start": [1, 1, 0]}"#).unwrap();
        let merged = line.onto(&RequestDocument::from(&request)).unwrap();
        assert_eq!((merged.start.x, merged.goal.x), (1.0, 3.0));
        assert!(line.onto(&RequestDocument::default()).is_err());
    }

    #[test]
    fn refuses_deadlines_that_are_no_times() {
        let request = RequestDocument::from(&Request::new(Pose2::default(), Pose2::default()));
        for deadline_ms in [f64::NAN, -1.0, 0.0, f64::INFINITY, 1e300] {
            let bad = RequestDocument {
                deadline_ms: Some(deadline_ms),
                ..request.clone()
            };
            assert!(
                bad.onto(&RequestDocument::default()).is_err(),
                "{deadline_ms}"
            );
        }
    }

    #[test]
    fn refuses_unknown_fields() {
        assert!(serde_json::from_str::<RequestDocument>(r#"{"strat": [1, 1, 0]}"#).is_err());
    }
}
