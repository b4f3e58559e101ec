//! Whatever is returned stands before the judge.

use super::{Place, either};
use formicar::geometry::Pose2;
use formicar::map::OccupancyGrid;
use formicar::map::builtin::BuiltinMap;
use formicar::map::format::read_car_scenarios;
use formicar::map::generate::{ScatterParameters, free_pose_pairs, scattered_obstacles};
use formicar::numeric::Seed;
use formicar::scenario::{GoalHeading, Request, StartHeading};
use formicar::smoothing::{Rounding, SmoothingConfig};
use formicar::vehicle::{Gears, Vehicle};
use std::path::Path;

/// The request with each mix of headings and gears.
pub(super) fn variants(start: Pose2, goal: Pose2) -> Vec<Request> {
    let mut requests = Vec::new();
    for gears in [Gears::Forward, Gears::Both] {
        for (start_heading, goal_heading) in [
            (StartHeading::Any, GoalHeading::Any),
            (StartHeading::Exact, GoalHeading::Any),
            (StartHeading::Any, GoalHeading::Bidirectional),
            (StartHeading::Exact, GoalHeading::Exact),
        ] {
            requests.push(Request {
                gears,
                start_heading,
                goal_heading,
                ..Request::new(start, goal)
            });
        }
    }
    requests
}

#[test]
fn what_is_returned_on_random_maps_is_certified() {
    let vehicles = [
        (Vehicle::warehouse_amr(), 0.1),
        (Vehicle::f1tenth(), 0.1),
        (Vehicle::lei2020(), 0.25),
    ];
    // Forward, and with reverse allowed.
    let (mut n_by_turns, mut n_by_curves) = ([0; 2], [0; 2]);
    let mut n_asked = 0;
    for (vehicle, resolution_m) in vehicles {
        for seed in 0..6 {
            let parameters = ScatterParameters {
                n_cols: 150,
                n_rows: 120,
                resolution_m,
                density: 0.015,
                ..ScatterParameters::default()
            };
            let map = scattered_obstacles(&parameters, Seed(seed)).unwrap();
            let place = Place::new(&map, vehicle.clone());
            for (start, goal) in free_pose_pairs(&map, &vehicle, 3, Seed(seed)).unwrap() {
                for request in variants(start, goal) {
                    n_asked += 1;
                    let in_reverse = usize::from(request.gears == Gears::Both);
                    let found = either().map(|config| place.certified(&config, &request));
                    let [by_turns, by_curves] = found.map(|f| matches!(f, Some(Ok(_))));
                    n_by_turns[in_reverse] += usize::from(by_turns);
                    n_by_curves[in_reverse] += usize::from(by_curves);
                }
            }
        }
    }
    println!(
        "{n_by_turns:?}, with curves {n_by_curves:?} of {} each",
        n_asked / 2
    );
    assert!(n_by_turns[0] > 80 && n_by_turns[1] > 150);
    assert!(n_by_curves[0] > 110 && n_by_curves[1] > 190);
}

#[test]
fn scenes_are_smoothed_as_before() {
    let mut solved = Vec::new();
    for name in [
        "lei-map1",
        "lei-map3",
        "warehouse",
        "parking-lot",
        "narrow-aisle",
    ] {
        let builtin = BuiltinMap::by_name(name).unwrap();
        let vehicle = Vehicle::preset(builtin.vehicle).unwrap();
        let place = Place::new(&builtin.grid(), vehicle);
        for ends in builtin.requests {
            let request = Request::new(ends.start, ends.goal);
            let found = place.certified(&SmoothingConfig::default(), &request);
            if matches!(found, Some(Ok(_))) {
                solved.push(format!("{name} {}", ends.id));
            }
        }
    }
    println!("{solved:?}");
    assert!(solved.len() >= 7, "{solved:?}");
}

#[test]
fn car_scenarios_are_certified_or_refused() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/car");
    let names = [
        "hood_800x500",
        "street_berlin1_1024",
        "freiburg_campus",
        "nav2_warehouse",
    ];
    let (mut n_found, mut n_asked) = (0, 0);
    for name in names {
        let Ok(scenarios) = read_car_scenarios(&folder.join(format!("{name}.json"))) else {
            println!("skipped: no {name} in {}", folder.display());
            continue;
        };
        let map = OccupancyGrid::read_ros_yaml(&scenarios[0].map).unwrap();
        let vehicle = Vehicle::new(scenarios[0].vehicle.clone()).unwrap();
        let place = Place::new(&map, vehicle);
        for scenario in &scenarios {
            let request = Request::new(scenario.start, scenario.goal);
            let found = place.certified(&SmoothingConfig::default(), &request);
            n_found += usize::from(matches!(found, Some(Ok(_))));
            n_asked += 1;
        }
    }
    println!("{n_found} of {n_asked}");
    assert!(10 * n_found >= 9 * n_asked, "{n_found} of {n_asked}");
}

#[test]
fn points_keep_the_polyline() {
    let builtin = BuiltinMap::by_name("wang-open").unwrap();
    let place = Place::new(&builtin.grid(), Vehicle::point());
    let ends = &builtin.requests[0];
    let request = Request::new(ends.start, ends.goal);
    let smoothed = place
        .certified(&SmoothingConfig::default(), &request)
        .unwrap()
        .unwrap();
    assert!((smoothed.path.length_m() - smoothed.waypoints.length_m()).abs() < 1e-9);
    assert_eq!(smoothed.corners.len() + 2, smoothed.waypoints.points.len());
    assert!(
        smoothed
            .corners
            .iter()
            .all(|c| c.rounding == Rounding::None)
    );
}
