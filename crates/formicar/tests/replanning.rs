//! A planner whose map changes, and plans that follow from plans.

use crate::quick_or_full;
use formicar::collision::ObstacleMap;
use formicar::geometry::Pose2;
use formicar::map::generate::{ScatterParameters, free_pose_pairs, scattered_obstacles};
use formicar::map::{Cell, CellRegion, FREE, OCCUPIED, OccupancyGrid};
use formicar::metrics::flip;
use formicar::numeric::Seed;
use formicar::path::CurvePath;
use formicar::planner::{
    FormicarParameters, Outcome, Plan, PlanError, Planner, PlannerConfig, PlannerName, ReplanConfig,
};
use formicar::progress::{Event, Observer, Status};
use formicar::scenario::{Request, ViaPoint};
use formicar::validation::judge;
use formicar::vehicle::Vehicle;

/// A planner whose improvement ends soon.
fn quick(planner: PlannerName) -> PlannerConfig {
    with_tries(planner, 400)
}

fn with_tries(planner: PlannerName, max_tries: u64) -> PlannerConfig {
    let mut config = PlannerConfig::of(planner);
    if let Some(parameters) = config.family_mut::<FormicarParameters>() {
        parameters.improve.max_tries = max_tries;
    }
    config
}

/// The same without any improvement.
fn unimproved(consistency: f64) -> PlannerConfig {
    let mut parameters = FormicarParameters::default();
    parameters.improve.max_tries = 0;
    parameters.replan.consistency = consistency;
    PlannerConfig::Formicar(parameters)
}

fn on(map: &OccupancyGrid, config: PlannerConfig) -> Planner {
    Planner::new(map, Vehicle::warehouse_amr(), config).expect("valid parameters")
}

fn open_map(n_cols: usize, n_rows: usize) -> OccupancyGrid {
    let row = ".".repeat(n_cols);
    OccupancyGrid::from_rows(&vec![&row[..]; n_rows], 0.1).expect("rows")
}

fn across(n_cols: usize, n_rows: usize) -> Request {
    let y = 0.05 * n_rows as f64;
    let x = 0.1 * n_cols as f64 - 1.0;
    Request::new(Pose2::new(1.0, y, 0.0), Pose2::new(x, y, 0.0))
}

fn put(planner: &mut Planner, map: &mut OccupancyGrid, region: CellRegion, value: i8) {
    let values = vec![value; region.n_cols * region.n_rows];
    planner.update_map(region, &values).expect("on the map");
    map.replace(&region, &values).expect("on the map");
}

/// The block of `n` times `n` cells about a pose.
fn about(map: &OccupancyGrid, pose: Pose2, n: u32) -> CellRegion {
    let cell = map.frame().cell_at(pose.position()).expect("on the map");
    let corner = Cell::new(cell.col - n / 2, cell.row - n / 2);
    CellRegion::new(corner, n as usize, n as usize)
}

fn plan(planner: &mut Planner, request: &Request) -> Plan {
    let outcome = planner.plan(request, Seed(3), &mut ());
    outcome.expect("a valid request").found().expect("a path")
}

fn replan(planner: &mut Planner, request: &Request, previous: &CurvePath) -> Plan {
    let outcome = planner.replan(request, previous, Seed(4), &mut ());
    outcome.expect("a valid request").found().expect("a path")
}

fn from(start: Pose2, request: &Request) -> Request {
    Request {
        start,
        ..request.clone()
    }
}

#[test]
fn an_updated_planner_is_one_made_for_the_changed_map() {
    for name in [
        PlannerName::Formicar,
        PlannerName::HybridAstar,
        PlannerName::Astar,
    ] {
        let (mut map, request) = (open_map(160, 90), across(160, 90));
        let mut warm = on(&map, quick(name));
        plan(&mut warm, &request);
        for (col, row) in [(60, 20), (90, 44), (70, 30)] {
            let region = CellRegion::new(Cell::new(col, row), 9, 26);
            put(&mut warm, &mut map, region, OCCUPIED);
            let cold = plan(&mut on(&map, quick(name)), &request);
            let warm = plan(&mut warm, &request);
            assert_eq!(warm.path, cold.path, "{name:?}");
            assert_eq!(warm.certificate, cold.certificate, "{name:?}");
        }
        let sealed = CellRegion::new(Cell::new(100, 0), 2, 90);
        put(&mut warm, &mut map, sealed, OCCUPIED);
        let ended = warm.plan(&request, Seed(3), &mut ()).expect("a request");
        assert_eq!(ended.status(), Status::NoPath, "{name:?}");
        put(&mut warm, &mut map, sealed, FREE);
        plan(&mut warm, &request);
    }
}

#[test]
fn a_map_that_others_hold_is_not_changed_under_them() {
    let (mut map, request) = (open_map(120, 60), across(120, 60));
    let mut planner = on(&map, quick(PlannerName::Formicar));
    let before = plan(&mut planner, &request);
    let mut other = planner.clone();
    let held = planner.obstacles().clone();
    let wall = CellRegion::new(Cell::new(60, 10), 3, 40);
    put(&mut planner, &mut map, wall, OCCUPIED);
    assert_eq!(held.lethal().count(), 0);
    assert_eq!(plan(&mut other, &request).path, before.path);
    assert_ne!(plan(&mut planner, &request).path, before.path);
}

#[test]
fn cells_that_do_not_fit_are_refused_and_change_nothing() {
    let map = open_map(50, 40);
    let mut planner = on(&map, quick(PlannerName::Formicar));
    let hash = planner.obstacles().hash();
    let mut refused = |col, n_cols, values: &[i8]| {
        let region = CellRegion::new(Cell::new(col, 0), n_cols, 1);
        let error = planner.update_map(region, values).expect_err("refused");
        assert!(matches!(error, PlanError::Map(_)));
        error.to_string()
    };
    assert!(refused(49, 2, &[0, 0]).contains("the map has 50 x 40 cells; hint"));
    assert_eq!(refused(0, 2, &[0]), "1 cell values for 2 x 1 cells");
    assert!(refused(7, 2, &[100, -2]).starts_with("cell (8, 0) has value -2"));
    assert_eq!(planner.obstacles().hash(), hash);
}

#[test]
fn on_an_unchanged_map_the_path_stays() {
    let mut map = open_map(160, 90);
    let block = CellRegion::new(Cell::new(70, 30), 20, 40);
    map.replace(&block, &[OCCUPIED; 800]).expect("on the map");
    let config = quick(PlannerName::Formicar);
    let request = across(160, 90);
    let first = plan(&mut on(&map, config), &request).path;
    let consistency = ReplanConfig::default().consistency;
    let mut planner = on(&map, unimproved(consistency));
    for share in [0.0, 0.3, 0.8] {
        let driven_m = share * first.length_m();
        let now = from(first.pose_at(driven_m), &request);
        let again = replan(&mut planner, &now, &first).path;
        let rest = first.between_m(driven_m, first.length_m());
        assert_eq!(again.segments().len(), rest.segments().len());
        assert!((again.length_m() - rest.length_m()).abs() < 1e-6);
        assert!(!flip(&first, &again, planner.obstacles()));
    }
    // Beside the path, as a vehicle that follows it is.
    let beside = first.pose_at(2.0).compose(Pose2::new(0.0, 0.05, 0.03));
    let again = replan(&mut planner, &from(beside, &request), &first).path;
    assert!(again.length_m() < first.length_m() - 1.9);
}

#[test]
fn a_new_path_must_be_cheaper_by_the_weight() {
    let mut map = open_map(160, 120);
    // A wall with a way about its upper end; then a gap opens in it, on the straight way.
    let wall = CellRegion::new(Cell::new(78, 0), 4, 100);
    map.replace(&wall, &[OCCUPIED; 400]).expect("on the map");
    let request = across(160, 120);
    let first = plan(&mut on(&map, quick(PlannerName::Formicar)), &request).path;
    let length_m = |consistency: f64| {
        let mut planner = on(&map, unimproved(consistency));
        let gap = CellRegion::new(Cell::new(78, 45), 4, 30);
        planner.update_map(gap, &[FREE; 120]).expect("on the map");
        replan(&mut planner, &request, &first).path.length_m()
    };
    assert!((length_m(0.05) - 14.0).abs() < 0.01, "straight through");
    assert!(length_m(1.0) > 14.5, "the old way stays");
}

#[test]
fn a_broken_path_is_bridged() {
    let (mut map, request) = (open_map(160, 90), across(160, 90));
    let mut planner = on(&map, unimproved(1.0));
    let first = plan(&mut planner, &request).path;
    // A block of half a meter is passed by a curve, a wide wall by a search.
    for size in [6, 26] {
        let region = about(&map, first.pose_at(7.0), size);
        put(&mut planner, &mut map, region, OCCUPIED);
        let again = replan(&mut planner, &request, &first).path;
        let shared_m = again
            .sample(0.05)
            .iter()
            .filter(|sample| (sample.pose.y - 4.5).abs() < 1e-6)
            .count() as f64
            * 0.05;
        assert!(shared_m > 3.0, "{shared_m}");
    }
}

#[test]
fn other_goals_and_reversed_headings_are_reached_from_the_old_path() {
    let (map, request) = (open_map(160, 90), across(160, 90));
    let mut planner = on(&map, quick(PlannerName::Formicar));
    let first = plan(&mut planner, &request).path;
    let moved = request.with_goal(Pose2::new(14.0, 7.0, 0.4));
    let again = replan(&mut planner, &moved, &first);
    assert!(again.certificate.valid);
    let turned = from(Pose2::new(4.0, 4.0, 3.0), &request);
    assert!(replan(&mut planner, &turned, &first).certificate.valid);
    let nothing = CurvePath::default();
    let anew = plan(&mut planner, &moved);
    let outcome = planner.replan(&moved, &nothing, Seed(3), &mut ());
    let empty = outcome.expect("a valid request").found().expect("a path");
    assert!(empty.certificate.valid && anew.certificate.valid);
}

#[test]
fn via_points_ahead_are_passed() {
    let (mut map, mut request) = (open_map(160, 90), across(160, 90));
    request.via = vec![ViaPoint::new(formicar::geometry::Point2::new(10.0, 6.5))];
    let mut planner = on(&map, quick(PlannerName::Formicar));
    let first = plan(&mut planner, &request).path;
    let region = about(&map, first.pose_at(4.0), 6);
    put(&mut planner, &mut map, region, OCCUPIED);
    let start = first.pose_at(1.0);
    let again = replan(&mut planner, &from(start, &request), &first);
    assert!(again.certificate.valid);
}

#[test]
fn only_the_planner_that_drives_and_improves_replans() {
    let (map, request) = (open_map(60, 60), across(60, 60));
    let mut planner = on(&map, PlannerConfig::of(PlannerName::HybridAstar));
    let error = planner.replan(&request, &CurvePath::default(), Seed(1), &mut ());
    let message = error.expect_err("refused").to_string();
    assert!(message.contains("hybrid-astar does not replan; hint: use formicar"));
    let error = unimproved(1.5)
        .check()
        .expect_err("out of range")
        .to_string();
    assert!(error.starts_with("replan.consistency = 1.5"), "{error}");
}

#[test]
fn limits_hold_as_in_a_plan() {
    struct Cancels;
    impl Observer for Cancels {
        fn is_cancelled(&mut self) -> bool {
            true
        }
    }
    let mut map = open_map(160, 90);
    let block = CellRegion::new(Cell::new(70, 30), 20, 40);
    map.replace(&block, &[OCCUPIED; 800]).expect("on the map");
    let (mut planner, request) = (on(&map, quick(PlannerName::Formicar)), across(160, 90));
    let first = plan(&mut planner, &request).path;
    let cancelled = planner.replan(&request, &first, Seed(1), &mut Cancels);
    assert_eq!(cancelled.expect("asked").status(), Status::Cancelled);
    let limited = Request {
        budget_steps: Some(1),
        ..request.clone()
    };
    let kept = replan(&mut planner, &limited, &first);
    assert_eq!(kept.cut_by, Some(Status::BudgetExhausted));
    assert_eq!(kept.path.length_m(), first.length_m());
}

/// Remembers the lengths it was told of.
#[derive(Default)]
struct Told(Vec<f64>);

impl Observer for Told {
    fn on_event(&mut self, event: &Event) {
        if let Event::Improved { length_m, .. } = event {
            self.0.push(*length_m);
        }
    }
}

#[test]
fn whatever_appears_every_answer_is_certified_and_repeats_itself() {
    let parameters = ScatterParameters {
        n_cols: quick_or_full(90, 150),
        n_rows: quick_or_full(70, 120),
        resolution_m: 0.1,
        density: 0.04,
        max_obstacle_cells: 8,
    };
    let config = with_tries(PlannerName::Formicar, quick_or_full(50, 400));
    let mut n_found = 0;
    for seed in 0..quick_or_full(2, 6) {
        let mut map = scattered_obstacles(&parameters, Seed(seed)).expect("a map");
        let vehicle = Vehicle::warehouse_amr();
        let pairs = free_pose_pairs(&map, &vehicle, 1, Seed(seed)).expect("poses");
        let request = Request::new(pairs[0].0, pairs[0].1);
        let mut planner = on(&map, config.clone());
        let Ok(first) = planner
            .plan(&request, Seed(seed), &mut ())
            .expect("asked")
            .found()
        else {
            continue;
        };
        let mut path = first.path;
        for step in 0..3 {
            let start = path.pose_at(0.15 * path.length_m());
            let at = path.pose_at((0.3 + 0.2 * f64::from(step)) * path.length_m());
            let block = about(&map, at, 5);
            put(&mut planner, &mut map, block, OCCUPIED);
            let now = from(start, &request);
            let mut told = Told::default();
            let outcome = match planner.replan(&now, &path, Seed(seed), &mut told) {
                Ok(outcome) => outcome,
                // The block stands on the vehicle or on the goal.
                Err(PlanError::Scenario(_)) => break,
                Err(error) => panic!("{error}"),
            };
            let Outcome::Found(plan) = outcome else {
                break;
            };
            let fresh = ObstacleMap::new(&map);
            assert!(judge(&fresh, &vehicle, &now, &plan.path).valid);
            assert_eq!(told.0.last(), Some(&plan.path.length_m()));
            let mut cold = on(&map, config.clone());
            let again = cold
                .replan(&now, &path, Seed(seed), &mut ())
                .expect("asked");
            assert_eq!(again.found().expect("a path").path, plan.path);
            path = plan.path;
            n_found += 1;
        }
    }
    assert!(n_found >= quick_or_full(3, 8), "{n_found}");
}
