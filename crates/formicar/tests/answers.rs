//! Answers are read back as they were written, by this build and by those before.

use formicar::geometry::Pose2;
use formicar::map::OccupancyGrid;
use formicar::numeric::Seed;
use formicar::path::Spacing;
use formicar::planner::{
    Answer, AnswerContext, AnswerStatus, MapRecord, Planner, PlannerConfig, PlannerName, Timing,
};
use formicar::scenario::{ErrorCode, Request};
use formicar::vehicle::Vehicle;
use serde_json::Value;

/// Written by version 0.1.0 on one small map.
const STORED: [(&str, AnswerStatus); 6] = [
    (
        include_str!("answers/budget.json"),
        AnswerStatus::BudgetExhausted,
    ),
    (include_str!("answers/colony.json"), AnswerStatus::Found),
    (include_str!("answers/continuous.json"), AnswerStatus::Found),
    (include_str!("answers/cut.json"), AnswerStatus::Found),
    (
        include_str!("answers/invalid.json"),
        AnswerStatus::InvalidRequest,
    ),
    (
        include_str!("answers/refused.json"),
        AnswerStatus::Infeasible,
    ),
];

#[test]
fn answers_of_earlier_builds_are_read_and_written_unchanged() {
    for (text, status) in STORED {
        let answer: Answer = serde_json::from_str(text).expect("an answer");
        assert_eq!(answer.status, status);
        assert_eq!(answer.code.number(), answer.code_number);
        let stored: Value = serde_json::from_str(text).expect("JSON");
        assert_eq!(serde_json::to_value(&answer).expect("JSON"), stored);
    }
}

#[test]
fn an_answer_survives_the_wire() {
    let map = OccupancyGrid::from_rows(&["............", "............"], 0.5).expect("rows");
    for name in [PlannerName::Lei2020, PlannerName::Astar, PlannerName::Ga] {
        let planner = Planner::new(&map, Vehicle::point(), PlannerConfig::of(name));
        let mut planner = planner.expect("valid parameters");
        let near = Request::new(Pose2::new(0.7, 0.5, 0.0), Pose2::new(2.2, 0.5, 0.0));
        let off = Request::new(Pose2::new(0.7, 0.5, 0.0), Pose2::new(9.2, 0.5, 0.0));
        for (request, code) in [(near, ErrorCode::None), (off, ErrorCode::GoalOutsideMap)] {
            let result = planner.plan(&request, Seed(2), &mut ());
            let context = AnswerContext {
                planner: &planner,
                map: MapRecord::default(),
                vehicle_name: "point",
                spacing: Spacing::default(),
            };
            let answer = context.answer(Some(&request), Seed(2), &result, Timing::default());
            assert_eq!(answer.code, code);
            let json = serde_json::to_string(&answer).expect("JSON");
            let back: Answer = serde_json::from_str(&json).expect("an answer");
            assert_eq!(back, answer);
        }
    }
}
