//! A request as a JSON object: what `plan --stdin` reads and every answer repeats.

use super::via_record::ViaRecord;
use crate::geometry::{MAX_STATED_HEADING_RAD, Pose2};
use crate::scenario::ScenarioError;
use crate::scenario::{
    CurvatureMode, GoalHeading, GoalTolerance, Request, StartContact, StartHeading,
};
use crate::vehicle::Gears;
use std::time::Duration;

/// One request on the wire; what is left out takes the value that the planner was started with.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct RequestDocument {
    /// Anything; the answer repeats it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub id: Option<serde_json::Value>,
    /// Start pose `[x m, y m, heading rad]`.
    pub start: Option<[f64; 3]>,
    /// Goal pose `[x m, y m, heading rad]`.
    pub goal: Option<[f64; 3]>,
    /// Several goals instead of one, `[x m, y m, heading rad]` each: the path ends at whichever is
    /// nearest.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub goals: Option<Vec<[f64; 3]>>,
    /// Places that the path passes on its way, in this order.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub via: Option<Vec<ViaRecord>>,
    /// Tolerance at the goal.
    pub goal_tolerance: Option<GoalTolerance>,
    /// Gears that may be used.
    pub motion: Option<Gears>,
    /// Curvature that may jump or must not: `"arcs"`, or `{"continuous": {"max_rate_per_m2": 0.5}}`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub curvature: Option<CurvatureMode>,
    /// Heading at the start: fixed or free.
    pub start_heading: Option<StartHeading>,
    /// A start in contact with obstacles: refused, or left by the shortest way.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start_contact: Option<StartContact>,
    /// Heading at the goal: fixed, either way round, or free.
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
    /// No start or goal here nor there, `goal` beside `goals`, a deadline that is no time, or a
    /// heading beyond a turn, which is one in degrees.
    pub fn onto(&self, defaults: &RequestDocument) -> Result<Request, ScenarioError> {
        let request = self.recorded_onto(defaults)?;
        check_heading("start", request.start.heading)?;
        for goal in request.goals() {
            check_heading("goal", goal.heading)?;
        }
        for heading_rad in request.via.iter().filter_map(|via| via.heading_rad) {
            check_heading("via point", heading_rad)?;
        }
        Ok(request)
    }

    /// The same of a request on record, whose headings may be any number of turns.
    pub(super) fn recorded_onto(
        &self,
        defaults: &RequestDocument,
    ) -> Result<Request, ScenarioError> {
        let start = self.start.or(defaults.start);
        let goals = self.own_goals()?;
        let mut goals = match goals {
            Some(goals) => goals,
            None => defaults.own_goals()?.unwrap_or_default(),
        };
        if goals.is_empty() {
            return Err(ScenarioError::Missing { what: "goal" });
        }
        let via = self.via.as_ref().or(defaults.via.as_ref());
        let deadline_ms = self.deadline_ms.or(defaults.deadline_ms);
        Ok(Request {
            start: start
                .map(pose)
                .ok_or(ScenarioError::Missing { what: "start" })?,
            goal: goals.remove(0),
            other_goals: goals,
            via: via.into_iter().flatten().map(ViaRecord::point).collect(),
            start_heading: self
                .start_heading
                .or(defaults.start_heading)
                .unwrap_or_default(),
            start_contact: self
                .start_contact
                .or(defaults.start_contact)
                .unwrap_or_default(),
            goal_heading: self
                .goal_heading
                .or(defaults.goal_heading)
                .unwrap_or_default(),
            goal_tolerance: self
                .goal_tolerance
                .or(defaults.goal_tolerance)
                .unwrap_or_default(),
            gears: self.motion.or(defaults.motion).unwrap_or_default(),
            curvature: self.curvature.or(defaults.curvature).unwrap_or_default(),
            deadline: deadline_ms.map(deadline).transpose()?,
            budget_steps: self.budget_steps.or(defaults.budget_steps),
        })
    }

    /// The goals given here, one or several; none where neither is.
    fn own_goals(&self) -> Result<Option<Vec<Pose2>>, ScenarioError> {
        match (self.goal, &self.goals) {
            (Some(_), Some(_)) => Err(ScenarioError::GoalAndGoals),
            (Some(goal), None) => Ok(Some(vec![pose(goal)])),
            (None, goals) => {
                let poses = |goals: &Vec<[f64; 3]>| goals.iter().copied().map(pose).collect();
                Ok(goals.as_ref().map(poses))
            }
        }
    }
}

fn check_heading(what: &'static str, heading_rad: f64) -> Result<(), ScenarioError> {
    if heading_rad.is_finite() && heading_rad.abs() > MAX_STATED_HEADING_RAD {
        return Err(ScenarioError::BeyondATurn { what, heading_rad });
    }
    Ok(())
}

fn pose([x, y, heading]: [f64; 3]) -> Pose2 {
    Pose2::new(x, y, heading)
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
        let list = |pose: Pose2| [pose.x, pose.y, pose.heading];
        let (goal, goals) = if request.other_goals.is_empty() {
            (Some(list(request.goal)), None)
        } else {
            (None, Some(request.goals().map(list).collect()))
        };
        let via: Vec<_> = request.via.iter().map(ViaRecord::from).collect();
        Self {
            id: None,
            start: Some(list(request.start)),
            goal,
            goals,
            via: (!via.is_empty()).then_some(via),
            goal_tolerance: Some(request.goal_tolerance),
            motion: Some(request.gears),
            // Left out where nothing was asked for, so that such answers stay what they were.
            curvature: Some(request.curvature).filter(|&c| c != CurvatureMode::Arcs),
            start_heading: Some(request.start_heading),
            start_contact: Some(request.start_contact)
                .filter(|&contact| contact != StartContact::Refuse),
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
    use crate::geometry::Point2;
    use crate::scenario::{CurvatureRate, ViaPoint};
    use std::f64::consts::TAU;

    #[test]
    fn a_request_survives_the_wire() {
        let mut request = Request::new(Pose2::new(1.0, 2.0, 0.1), Pose2::new(3.0, 4.0, -0.1));
        request.gears = Gears::Forward;
        request.curvature = CurvatureMode::Continuous(CurvatureRate {
            max_rate_per_m2: Some(0.5),
        });
        request.deadline = Some(Duration::from_millis(250));
        let json = serde_json::to_string(&RequestDocument::from(&request)).unwrap();
        let back: RequestDocument = serde_json::from_str(&json).unwrap();
        assert_eq!(back.onto(&RequestDocument::default()).unwrap(), request);
    }

    #[test]
    fn goals_and_via_points_survive_the_wire() {
        let mut request = Request::new(Pose2::new(1.0, 2.0, 0.1), Pose2::new(3.0, 4.0, -0.1));
        request.other_goals = vec![Pose2::new(5.0, 6.0, 0.2)];
        let place = ViaPoint::new(Point2::new(2.0, 3.0));
        request.via = vec![place, place.with_heading(0.5)];
        let json = serde_json::to_string(&RequestDocument::from(&request)).unwrap();
        let back: RequestDocument = serde_json::from_str(&json).unwrap();
        assert_eq!(back.onto(&RequestDocument::default()).unwrap(), request);
    }

    #[test]
    fn own_goals_replace_those_of_the_defaults_and_one_word_serves() {
        let mut defaults = Request::new(Pose2::default(), Pose2::new(3.0, 4.0, 0.0));
        let read = |line: &str, defaults: &Request| {
            let line: RequestDocument = serde_json::from_str(line).unwrap();
            line.onto(&RequestDocument::from(defaults))
        };
        let several = read(r#"{"goals": [[1, 1, 0], [2, 2, 0]]}"#, &defaults).unwrap();
        assert_eq!((several.goal.x, several.other_goals.len()), (1.0, 1));
        defaults = several;
        let one = read(r#"{"goal": [7, 1, 0]}"#, &defaults).unwrap();
        assert_eq!((one.goal.x, one.other_goals.len()), (7.0, 0));
        let both = r#"{"goal": [7, 1, 0], "goals": [[7, 1, 0]]}"#;
        let error = read(both, &defaults).unwrap_err();
        assert_eq!(error, ScenarioError::GoalAndGoals);
        let error = read(r#"{"goals": []}"#, &defaults).unwrap_err();
        assert_eq!(error, ScenarioError::Missing { what: "goal" });
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
    fn refuses_headings_in_degrees() {
        let request = Request::new(Pose2::new(1.0, 2.0, TAU), Pose2::new(3.0, 4.0, -TAU));
        let refused = |line: &str| {
            let line: RequestDocument = serde_json::from_str(line).unwrap();
            let merged = line.onto(&RequestDocument::from(&request));
            merged.map_or_else(|error| error.to_string(), |_| String::new())
        };
        assert_eq!(refused("{}"), "");
        for line in [
            r#"{"start": [1, 1, 90]}"#,
            r#"{"goal": [1, 1, -90]}"#,
            r#"{"goals": [[1, 1, 0], [1, 1, 90]]}"#,
            r#"{"via": [{"at": [1, 1], "heading": 90}]}"#,
        ] {
            let told = refused(line);
            assert!(
                told.contains("1.5708") && told.contains("radians"),
                "{told}"
            );
        }
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
