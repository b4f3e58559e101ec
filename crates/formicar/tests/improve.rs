//! The improvement of driven paths before the judge: never worse, never wrong, always the same.

use formicar::collision::{Body, ObstacleMap};
use formicar::geometry::{Arc, Point2, Pose2, angle_difference, dubins};
use formicar::map::OccupancyGrid;
use formicar::map::generate::{ScatterParameters, free_pose_pairs, scattered_obstacles};
use formicar::numeric::Seed;
use formicar::objective::{DriveCost, DriveMeter, SoftCost};
use formicar::path::{CurvePath, Direction};
use formicar::progress::{Limits, Status};
use formicar::scenario::Request;
use formicar::search::{DrivableMap, DriveProblem, HybridAstarConfig, hybrid_astar};
use formicar::smoothing::{ImproveConfig, ImproveProblem, Improved, Improver};
use formicar::validation::judge;
use formicar::vehicle::{Gears, Vehicle};
use proptest::prelude::*;

/// A free chain of arcs on a map.
struct Case {
    obstacles: ObstacleMap,
    vehicle: Vehicle,
    gears: Gears,
    start: Pose2,
    arcs: Vec<Arc>,
}

impl Case {
    /// On a map of 0.2 m cells with an origin of zero, which is its own grid frame.
    fn on(rows: &[&str], vehicle: Vehicle, start: Pose2, arcs: &[Arc]) -> Self {
        let case = Self {
            obstacles: ObstacleMap::new(&OccupancyGrid::from_rows(rows, 0.2).unwrap()),
            vehicle,
            gears: Gears::Both,
            start,
            arcs: arcs.to_vec(),
        };
        case.assert_certified(arcs);
        case
    }

    fn end(&self) -> Pose2 {
        let arcs = self.arcs.iter();
        arcs.fold(self.start, |pose, arc| arc.end_from(pose))
    }

    fn path(&self, arcs: &[Arc]) -> CurvePath {
        let frame = self.obstacles.frame();
        CurvePath::from_arcs(self.start, arcs).map_poses(|pose| frame.to_world(pose))
    }

    fn assert_certified(&self, arcs: &[Arc]) {
        let frame = self.obstacles.frame();
        let [start, goal] = [self.start, self.end()].map(|pose| frame.to_world(pose));
        let request = Request {
            gears: self.gears,
            ..Request::new(start, goal)
        };
        let report = judge(&self.obstacles, &self.vehicle, &request, &self.path(arcs));
        assert!(report.valid, "{:?}", report.violations);
        let end = arcs.iter().fold(self.start, |pose, arc| arc.end_from(pose));
        let goal = self.end();
        assert!(end.position().distance(goal.position()) <= 1e-9);
        assert!(angle_difference(end.heading, goal.heading).abs() <= 1e-9);
    }

    fn improve(&self, cost: &DriveCost, config: &ImproveConfig, budget: Option<u64>) -> Improved {
        self.improve_with(cost, config, budget, None)
    }

    /// Improves the chain, while every path that is told stands before the judge.
    fn improve_with(
        &self,
        cost: &DriveCost,
        config: &ImproveConfig,
        budget: Option<u64>,
        soft: Option<SoftCost>,
    ) -> Improved {
        let body = Body::new(&self.vehicle);
        let cost = cost.of_vehicle(&self.vehicle);
        let problem = ImproveProblem {
            obstacles: &self.obstacles,
            body: &body,
            gears: self.gears,
            end: None,
            cost: &cost,
            soft,
        };
        let meter = DriveMeter::new(&self.obstacles, &body, &cost);
        let meter = soft.map_or(meter, |soft| meter.with_soft_cost(soft));
        let mut last_m = meter.path_m(self.start, &self.arcs);
        let mut nobody = ();
        let mut limits = Limits::new(&mut nobody, budget, None);
        let improver = Improver::new(&problem, config);
        let mut tell = |arcs: &[Arc], _: &mut Limits| {
            self.assert_certified(arcs);
            let cost_m = meter.path_m(self.start, arcs);
            assert!(cost_m < last_m, "{cost_m} after {last_m}");
            last_m = cost_m;
        };
        let improved = improver.improve((self.start, &self.arcs), Seed(7), &mut limits, &mut tell);
        assert_eq!(improved.n_tries, limits.n_steps());
        assert!(
            (improved.cost_m - last_m).abs() <= 1e-6,
            "{improved:?} {last_m}"
        );
        self.assert_certified(&improved.arcs);
        improved
    }
}

fn length_m(arcs: &[Arc]) -> f64 {
    arcs.iter().map(|arc| arc.length_m()).sum()
}

fn yard(n_cols: usize, n_rows: usize) -> Vec<String> {
    vec![".".repeat(n_cols); n_rows]
}

fn rows(yard: &[String]) -> Vec<&str> {
    yard.iter().map(String::as_str).collect()
}

/// The first free pair of a random map that hybrid A* joins.
fn random_case(vehicle: Vehicle, gears: Gears, seed: u64) -> Option<Case> {
    let parameters = ScatterParameters {
        n_cols: 120,
        n_rows: 100,
        resolution_m: 0.2,
        density: 0.02,
        ..ScatterParameters::default()
    };
    let map = scattered_obstacles(&parameters, Seed(seed)).unwrap();
    let obstacles = ObstacleMap::new(&map);
    let (start, goal) = *free_pose_pairs(&map, &vehicle, 1, Seed(seed))
        .ok()?
        .first()?;
    let request = Request {
        gears,
        ..Request::new(start, goal)
    };
    let config = HybridAstarConfig {
        max_iterations: 20_000,
        ..HybridAstarConfig::default()
    };
    let shared = std::sync::Arc::new(obstacles.clone());
    let ground = DrivableMap::new(shared, &vehicle, &config).unwrap();
    let cost = DriveCost::default().of_vehicle(&vehicle);
    let problem = DriveProblem::new(&ground, &config, &cost, &request);
    let mut nobody = ();
    let found = hybrid_astar(&problem, &mut Limits::new(&mut nobody, None, None));
    let (start, arcs) = found.ok()?;
    Some(Case {
        obstacles,
        vehicle,
        gears,
        start,
        arcs,
    })
}

fn quick() -> ImproveConfig {
    ImproveConfig {
        max_tries: 600,
        ..ImproveConfig::default()
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(ProptestConfig::default().cases / 30))]

    #[test]
    fn paths_on_random_maps_stay_certified_and_get_cheaper(
        seed in 0_u64..10_000,
        which in 0_usize..3,
        forward in any::<bool>(),
    ) {
        let vehicles = [Vehicle::lei2020(), Vehicle::warehouse_amr(), Vehicle::f1tenth()];
        let gears = if forward { Gears::Forward } else { Gears::Both };
        if let Some(case) = random_case(vehicles[which].clone(), gears, seed) {
            let cost = DriveCost::default();
            let improved = case.improve(&cost, &quick(), None);
            prop_assert!(improved.cost_m <= improved.start_cost_m);
            prop_assert_eq!(&improved, &case.improve(&cost, &quick(), None));
            if forward {
                prop_assert!(improved.arcs.iter().all(|arc| arc.signed_length_m > 0.0));
            }
        }
    }
}

#[test]
fn a_budget_ends_it_with_what_there_is() {
    let case = random_case(Vehicle::lei2020(), Gears::Both, 3).unwrap();
    let (cost, config) = (DriveCost::default(), ImproveConfig::default());
    let whole = case.improve(&cost, &config, None);
    assert_eq!(whole.ended, None);
    let cut = case.improve(&cost, &config, Some(whole.n_tries / 2));
    assert_eq!(cut.ended, Some(Status::BudgetExhausted));
    assert_eq!(cut.n_tries, whole.n_tries / 2);
    assert!(whole.cost_m <= cut.cost_m && cut.cost_m < whole.start_cost_m);
    let none = case.improve(&cost, &config, Some(0));
    assert_eq!(none.cost_m, none.start_cost_m);
    assert_eq!(none.arcs, DriveMeter::merged(&case.arcs));
}

#[test]
fn a_needless_detour_is_straightened() {
    let bend = |turns: f64| Arc::new(turns.signum() / 3.0, 3.0 * turns.abs());
    let arcs = [
        Arc::new(0.0, 5.0),
        bend(1.2),
        Arc::new(0.0, 8.0),
        bend(-2.4),
        Arc::new(0.0, 8.0),
        bend(1.2),
        Arc::new(0.0, 5.0),
    ];
    let yard = yard(250, 150);
    let start = Pose2::new(5.0, 10.0, 0.0);
    let case = Case::on(&rows(&yard), Vehicle::lei2020(), start, &arcs);
    let improved = case.improve(&DriveCost::default(), &ImproveConfig::default(), None);
    let radius_m = case.vehicle.min_turning_radius_m();
    let shortest_m = dubins::distance(start, case.end(), radius_m).unwrap();
    assert!(shortest_m < 0.9 * length_m(&arcs));
    assert!(length_m(&improved.arcs) < 1.01 * shortest_m, "{improved:?}");
}

#[test]
fn a_path_along_a_wall_moves_off_where_there_is_room() {
    let mut yard = yard(250, 60);
    yard.push("#".repeat(250));
    // The wall ends at 0.2 m, the side of the car is 0.15 m from it: its tail may swing out.
    let start = Pose2::new(5.0, 0.85, 0.0);
    let case = Case::on(
        &rows(&yard),
        Vehicle::lei2020(),
        start,
        &[Arc::new(0.0, 40.0)],
    );
    let improved = case.improve(&DriveCost::default(), &ImproveConfig::default(), None);
    let poses = case.path(&improved.arcs).sample(0.1);
    let middle = poses.iter().filter(|p| (15.0..35.0).contains(&p.pose.x));
    let body = Body::new(&case.vehicle);
    let least_m = middle.map(|p| case.obstacles.clearance_m(&body, p.pose));
    let least_m = least_m.fold(f64::INFINITY, f64::min);
    assert!(least_m > 0.25, "{least_m}");
}

#[test]
fn needless_changes_of_gear_go() {
    let arcs = [
        Arc::new(0.0, 8.0),
        Arc::new(0.3, -3.0),
        Arc::new(-0.3, 3.0),
        Arc::new(0.0, 8.0),
    ];
    let yard = yard(200, 150);
    let start = Pose2::new(8.0, 12.0, 0.3);
    let case = Case::on(&rows(&yard), Vehicle::lei2020(), start, &arcs);
    let improved = case.improve(&DriveCost::default(), &ImproveConfig::default(), None);
    let path = case.path(&improved.arcs);
    let is_forward = |s: &formicar::path::CurveSegment| s.direction == Direction::Forward;
    assert!(path.segments().iter().all(is_forward), "{improved:?}");
}

#[test]
fn soft_costs_are_gone_around_where_that_pays() {
    let yard = yard(250, 150);
    let start = Pose2::new(5.0, 15.0, 0.0);
    let case = Case::on(
        &rows(&yard),
        Vehicle::lei2020(),
        start,
        &[Arc::new(0.0, 38.0)],
    );
    let mud = |p: Point2| f64::from(u8::from(p.distance(Point2::new(25.0, 15.0)) < 3.0)) * 5.0;
    let (cost, config) = (DriveCost::default(), ImproveConfig::default());
    let improved = case.improve_with(&cost, &config, None, Some(&mud));
    let poses = case.path(&improved.arcs).sample(0.1);
    let n_in_mud = poses
        .iter()
        .filter(|p| mud(p.pose.position()) > 0.0)
        .count();
    assert!(n_in_mud <= 1, "{n_in_mud}");
    let plain = case.improve(&cost, &config, None);
    assert_eq!(plain.arcs, case.arcs);
}

fn without_operators() -> ImproveConfig {
    ImproveConfig {
        shortcut_share: 0.0,
        shift_share: 0.0,
        cusp_share: 0.0,
        polish_passes: 0,
        ..ImproveConfig::default()
    }
}

#[test]
fn without_operators_nothing_changes_and_nothing_is_no_path() {
    let case = random_case(Vehicle::lei2020(), Gears::Both, 3).unwrap();
    let off = without_operators();
    let improved = case.improve(&DriveCost::default(), &off, None);
    assert_eq!(improved.arcs, DriveMeter::merged(&case.arcs));
    let still = Case {
        arcs: vec![],
        ..case
    };
    let improved = still.improve(&DriveCost::default(), &ImproveConfig::default(), None);
    assert_eq!((improved.cost_m, improved.n_tries), (0.0, 0));
}

#[test]
fn each_operator_improves_alone() {
    let case = random_case(Vehicle::lei2020(), Gears::Both, 11).unwrap();
    let off = without_operators();
    let alone = [
        ImproveConfig {
            shortcut_share: 1.0,
            ..off.clone()
        },
        ImproveConfig {
            shift_share: 1.0,
            ..off.clone()
        },
        ImproveConfig {
            polish_passes: 3,
            ..off
        },
    ];
    for config in alone {
        let improved = case.improve(&DriveCost::default(), &config, None);
        assert!(improved.cost_m < improved.start_cost_m, "{config:?}");
    }
}

#[test]
fn bad_parameters_are_refused() {
    assert_eq!(ImproveConfig::default().check(), Ok(()));
    let bad = ImproveConfig {
        stall_gain: -1.0,
        ..ImproveConfig::default()
    };
    let message = bad.check().unwrap_err().to_string();
    assert!(message.contains("stall_gain = -1"), "{message}");
}
