//! A planner of the caller in a campaign, as the example has it.

#[allow(dead_code, reason = "the example prints what the test looks at")]
#[path = "../examples/own_planner.rs"]
mod example;

use formicar_lab::run::{RunRecord, RunStatus};

#[test]
fn a_planner_of_the_caller_stands_beside_ours_and_is_judged() {
    let runs = example::runs().unwrap();
    let of = |planner: &str| {
        let runs = runs.iter().filter(|run| run.record.planner == planner);
        runs.map(|run| run.record.clone()).collect::<Vec<_>>()
    };
    let (ours, own) = (of("hybrid-astar"), of("shortest-curve"));
    assert_eq!((ours.len(), own.len()), (4, 4));
    assert!(ours.iter().all(RunRecord::is_solved));
    // The curve to the goal leads through walls: only the judge says so.
    let refused = own.iter().filter(|r| r.status == RunStatus::Infeasible);
    assert!(refused.count() > 0, "{own:?}");
    assert!(own.iter().all(|record| record.steps == Some(1)));
}
