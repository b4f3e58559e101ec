//! A scenario planned, and everything looked at again.

use super::draw::Drawn;
use super::report::Case;
use formicar::collision::{Body, Drive, ObstacleMap};
use formicar::numeric::Seed;
use formicar::planner::{NotFound, Outcome, Plan, PlanError, Planner, PlannerConfig};
use formicar::progress::Status;
use formicar::validation::judge;

/// Poses are looked at this often along a cell's side.
const LOOKS_PER_CELL: f64 = 8.0;
/// Distance by which a pose may be nearer than certified through rounding, meters.
const ROUNDING_M: f64 = 1e-9;
/// Share by which the curvature of two poses' headings may exceed the limit through rounding.
const CURVATURE_ROUNDING: f64 = 1e-6;
/// One scenario in so many is asked twice.
const ASK_TWICE: u64 = 8;

/// Plans a scenario and looks for whatever must not be.
pub(super) fn examine(drawn: &Drawn, config: &PlannerConfig) -> Case {
    let mut case = Case::begin(drawn);
    let planner = Planner::new(&drawn.map, drawn.vehicle.clone(), config.clone());
    let mut planner = match planner {
        Ok(planner) => planner,
        Err(error) => {
            case.violates(format!("no planner: {error}"));
            return case;
        }
    };
    let seed = Seed(drawn.seed);
    let answer = planner.plan(&drawn.request, seed, &mut ());
    look(&mut case, drawn, &answer);
    if drawn.seed.is_multiple_of(ASK_TWICE) {
        let mut second = Case::begin(drawn);
        look(
            &mut second,
            drawn,
            &planner.plan(&drawn.request, seed, &mut ()),
        );
        if second != case {
            case.violates("asked again, the warm planner answers otherwise".to_owned());
        }
    }
    case
}

fn look(case: &mut Case, drawn: &Drawn, answer: &Result<Outcome, PlanError>) {
    match answer {
        Ok(Outcome::Found(plan)) => look_at_plan(case, drawn, plan),
        Ok(Outcome::NotFound(failure)) => look_at_failure(case, drawn, failure),
        Err(error) => look_at_refusal(case, drawn, error),
    }
}

/// A path: judged again, and sampled pose by pose.
fn look_at_plan(case: &mut Case, drawn: &Drawn, plan: &Plan) {
    case.ends_as("found", plan.n_steps, &plan.certificate.path_hash);
    check_budget(case, drawn, plan.n_steps);
    // A map of its own: what the planner keeps is not asked.
    let obstacles = ObstacleMap::new(&drawn.map);
    let report = judge(&obstacles, &drawn.vehicle, &drawn.request, &plan.path);
    if let Some(first) = report.violations.first() {
        case.violates(format!("the judge refuses the path: {}", first.message));
    }
    if *plan.certificate != report {
        case.violates("the certificate is not of this path".to_owned());
    }
    sample(case, drawn, &obstacles, plan);
    if plan
        .cut_by
        .is_some_and(|status| status != Status::BudgetExhausted)
    {
        case.violates(format!("cut by {:?}, and nobody asked for it", plan.cut_by));
    }
}

/// Stands the vehicle at poses along the path: none may be nearer to anything than certified, and
/// none turned further from the one before than the vehicle can steer.
fn sample(case: &mut Case, drawn: &Drawn, obstacles: &ObstacleMap, plan: &Plan) {
    let body = Body::new(&drawn.vehicle);
    let certified_m = plan.certificate.min_clearance_m;
    let spacing_m = drawn.map.frame().resolution_m() / LOOKS_PER_CELL;
    let poses = plan.path.sample(spacing_m);
    for at in &poses {
        let standing = Drive::at(obstacles.frame().to_grid(at.pose));
        let clearance_m = obstacles.drive_clearance_m(&body, &standing, certified_m);
        if clearance_m < certified_m - ROUNDING_M {
            case.violates(format!(
                "at {:.6} m the clearance is {clearance_m} m, certified are {certified_m} m",
                at.s_m
            ));
            return;
        }
    }
    let limit_per_m = drawn.vehicle.max_curvature_per_m() * (1.0 + CURVATURE_ROUNDING);
    for pair in poses.windows(2) {
        let moved_m = pair[1].s_m - pair[0].s_m;
        let turned = pair[1].pose.heading - pair[0].pose.heading;
        let turned_rad = turned.sin().atan2(turned.cos()).abs();
        let chord_m = pair[1].pose.position().distance(pair[0].pose.position());
        let too_far = chord_m > moved_m + 1e-6;
        if turned_rad > limit_per_m * moved_m + 1e-6 || too_far {
            case.violates(format!(
                "from {:.6} m on it moves {chord_m} m and turns {turned_rad} rad in {moved_m} m",
                pair[0].s_m
            ));
            return;
        }
    }
}

fn look_at_failure(case: &mut Case, drawn: &Drawn, failure: &NotFound) {
    case.ends_as(failure.status.name(), failure.n_steps, &failure.reason);
    check_budget(case, drawn, failure.n_steps);
    if failure.reason.trim().is_empty() {
        case.violates("no reason is given".to_owned());
    }
    if matches!(
        failure.status,
        Status::Found | Status::TimedOut | Status::Cancelled
    ) {
        case.violates(format!(
            "ended as {}, which cannot be",
            failure.status.name()
        ));
    }
}

/// A request that cannot be asked: only where the vehicle stands free nowhere.
fn look_at_refusal(case: &mut Case, drawn: &Drawn, error: &PlanError) {
    case.ends_as("refused", 0, &error.to_string());
    let is_scenario = matches!(error, PlanError::Scenario(_));
    let turns = drawn
        .request
        .via
        .iter()
        .any(|via| via.heading_rad.is_none());
    if !is_scenario || (drawn.stands_free && !turns) {
        case.violates(format!("refused without need: {error}"));
    }
    if error.to_string().trim().is_empty() {
        case.violates("refused without words".to_owned());
    }
}

fn check_budget(case: &mut Case, drawn: &Drawn, n_steps: u64) {
    if drawn
        .request
        .budget_steps
        .is_some_and(|most| n_steps > most)
    {
        case.violates(format!("{n_steps} steps exceed the budget"));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stress::ground::Kind;
    use formicar::map::OCCUPIED;

    #[test]
    fn a_path_into_an_obstacle_is_noticed_twice() {
        let config = PlannerConfig::default();
        let drawn = (0..).map(|seed| Drawn::of(seed, 20_000));
        let mut open = drawn.filter(|d| d.kind == Kind::Open && d.stands_free);
        let (mut drawn, answer) = open
            .find_map(|drawn| {
                let mut planner =
                    Planner::new(&drawn.map, drawn.vehicle.clone(), config.clone()).unwrap();
                let answer = planner.plan(&drawn.request, Seed(1), &mut ()).unwrap();
                (answer.status() == Status::Found).then_some((drawn, answer))
            })
            .unwrap();
        let Outcome::Found(plan) = &answer else {
            unreachable!("it was found")
        };
        let mut case = Case::begin(&drawn);
        look_at_plan(&mut case, &drawn, plan);
        assert_eq!(case.violations, [""; 0]);
        let end = plan.path.end().position();
        let cell = drawn.map.frame().cell_at(end).unwrap();
        drawn.map.set(cell, OCCUPIED);
        look_at_plan(&mut case, &drawn, plan);
        let says = |words: &str| case.violations.iter().any(|v| v.contains(words));
        assert!(says("the judge refuses"), "{:?}", case.violations);
        assert!(says("the clearance is"), "{:?}", case.violations);
        assert!(says("not of this path"), "{:?}", case.violations);
    }

    #[test]
    fn failures_without_a_reason_and_beyond_the_budget_are_noticed() {
        let drawn = Drawn::of(1, 100);
        let failure = NotFound::new(Status::TimedOut, " ".to_owned(), 101);
        let mut case = Case::begin(&drawn);
        look_at_failure(&mut case, &drawn, &failure);
        assert_eq!(case.violations.len(), 3, "{:?}", case.violations);
    }
}
