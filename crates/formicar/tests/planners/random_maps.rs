//! What planners find on random maps stands before a check that knows nothing of theirs.

use super::{Case, plan_with};
use crate::quick_or_full;
use formicar::collision::{Body, Drive, ObstacleMap};
use formicar::geometry::Point2;
use formicar::map::generate::{ScatterParameters, free_pose_pairs, scattered_obstacles};
use formicar::numeric::Seed;
use formicar::planner::{Outcome, Plan, PlannerName};
use formicar::scenario::Request;
use formicar::vehicle::{Motion, Vehicle};

macro_rules! touches_nothing {
    ($($test:ident: $planner:ident,)*) => {
        $(#[test]
        fn $test() {
            what_is_found_on_random_maps_touches_nothing(PlannerName::$planner);
        })*
    };
}

touches_nothing! {
    formicar: Formicar,
    hybrid_astar: HybridAstar,
    lei2020: Lei2020,
    wang2019: Wang2019,
    astar: Astar,
    dijkstra: Dijkstra,
    improved_astar: ImprovedAstar,
    ga: Ga,
    aga: Aga,
}

/// Random maps and poses: whatever is found must stand before an independent check of dense
/// poses, as a filled rectangle against cell squares.
fn what_is_found_on_random_maps_touches_nothing(planner: PlannerName) {
    let vehicles = [Vehicle::warehouse_amr(), Vehicle::f1tenth()];
    let mut n_found = 0;
    for seed in 0..quick_or_full(6, 12) {
        let parameters = ScatterParameters {
            n_cols: 120,
            n_rows: 90,
            resolution_m: 0.1,
            density: 0.01,
            ..ScatterParameters::default()
        };
        let map = scattered_obstacles(&parameters, Seed(seed)).expect("valid parameters");
        let vehicle = &vehicles[seed as usize % 2];
        for (start, goal) in free_pose_pairs(&map, vehicle, 2, Seed(seed)).unwrap_or_default() {
            let request = Request {
                budget_steps: Some(20_000),
                ..Request::new(start, goal)
            };
            let case = Case {
                map: map.clone(),
                vehicle: vehicle.clone(),
                request,
            };
            if let Outcome::Found(plan) = plan_with(planner, &case, &case.request, &mut ()) {
                n_found += 1;
                assert_untouched(&case, &plan);
            }
        }
    }
    assert!(n_found >= quick_or_full(5, 10), "{n_found}");
}

fn assert_untouched(case: &Case, plan: &Plan) {
    assert_eq!(case.vehicle.motion(), Motion::Car);
    let limit = case.vehicle.max_curvature_per_m();
    let resolution = case.map.frame().resolution_m();
    for sample in plan.path.sample(0.02) {
        assert!(sample.curvature_per_m.abs() <= limit * (1.0 + 1e-9));
        let body = case.vehicle.footprint().placed(sample.pose);
        let (low, high) = body.bounds();
        for cell in case.map.lethal_cells().iter() {
            let corner = Point2::new(f64::from(cell.col), f64::from(cell.row)) * resolution;
            let far = corner.x > high.x
                || corner.y > high.y
                || corner.x + resolution < low.x
                || corner.y + resolution < low.y;
            if far {
                continue;
            }
            for i in 0..=4 {
                for k in 0..=4 {
                    let p = corner + Point2::new(f64::from(i), f64::from(k)) * (0.25 * resolution);
                    assert!(!body.contains(p), "{:?} covers {p:?}", sample.pose);
                }
            }
        }
    }
    let obstacles = ObstacleMap::new(&case.map);
    let body = Body::new(&case.vehicle);
    assert!(obstacles.is_free(&body, &Drive::at(plan.path.end())));
}
