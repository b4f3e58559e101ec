//! The fewest and widest arcs: certified, wider than they must be, and with a margin.

use super::certified::variants;
use super::{Place, free_request, open};
use formicar::collision::Body;
use formicar::map::generate::{ScatterParameters, free_pose_pairs, scattered_obstacles};
use formicar::map::{Cell, OCCUPIED};
use formicar::metrics::ClearanceSummary;
use formicar::numeric::Seed;
use formicar::path::CurvePath;
use formicar::smoothing::{Corners, RedundantNodes, Smoothed, SmoothingConfig};
use formicar::vehicle::Vehicle;

fn wide() -> SmoothingConfig {
    SmoothingConfig {
        corners: Corners::WideArcs,
        redundant_nodes: RedundantNodes::Keep,
        ..SmoothingConfig::default()
    }
}

fn curvatures(path: &CurvePath) -> Vec<f64> {
    path.segments().iter().map(|s| s.curvature_per_m).collect()
}

/// A wall from below that the way has to round.
fn around_a_wall() -> (Place, Smoothed) {
    let mut map = open(80, 80);
    for row in 0..40 {
        map.set(Cell::new(40, row), OCCUPIED);
    }
    let place = Place::new(&map, Vehicle::lei2020());
    let request = free_request(&place, Cell::new(10, 20), Cell::new(70, 20));
    let smoothed = place.certified(&wide(), &request).unwrap().unwrap();
    (place, smoothed)
}

#[test]
fn a_wall_is_rounded_by_one_wide_arc_with_a_margin() {
    let (place, smoothed) = around_a_wall();
    let curvatures = curvatures(&smoothed.path);
    let arcs: Vec<f64> = curvatures.iter().copied().filter(|&k| k != 0.0).collect();
    assert!(arcs.len() <= 2, "{curvatures:?}");
    let least_m = place.vehicle.min_turning_radius_m();
    assert!(
        arcs.iter().all(|k| 1.0 / k.abs() > 1.5 * least_m),
        "{arcs:?}"
    );
    assert_eq!(smoothed.corners.len(), arcs.len());
    let clearance = ClearanceSummary::new(&place.obstacles, &place.vehicle, &smoothed.path, 0.0);
    assert!(clearance.mean_m > wide().arc_margin_m);
    let body = Body::new(&place.vehicle);
    let frame = place.obstacles.frame();
    for pose in smoothed.path.sample(0.1) {
        let at = frame.to_grid(pose.pose);
        let clearance_m = place.obstacles.clearance_m(&body, at);
        assert!(
            clearance_m > wide().arc_margin_m - 1e-3,
            "{clearance_m} at {at:?}"
        );
    }
}

#[test]
fn a_heavier_bend_makes_wider_arcs_and_a_cheaper_corner_more_of_them() {
    let mut map = open(80, 80);
    for row in 0..40 {
        map.set(Cell::new(40, row), OCCUPIED);
    }
    let place = Place::new(&map, Vehicle::lei2020());
    let request = free_request(&place, Cell::new(10, 20), Cell::new(70, 20));
    let tightest = |bend_weight: f64| {
        let config = SmoothingConfig {
            bend_weight,
            ..wide()
        };
        let smoothed = place.certified(&config, &request).unwrap().unwrap();
        curvatures(&smoothed.path)
            .into_iter()
            .fold(0.0, |k: f64, c| k.max(c.abs()))
    };
    assert!(tightest(10.0) < tightest(0.0));
}

#[test]
fn on_random_maps_they_are_certified_and_lose_nothing() {
    let vehicle = Vehicle::warehouse_amr();
    let (mut n_wide, mut n_curves) = (0, 0);
    for seed in 0..4 {
        let parameters = ScatterParameters {
            n_cols: 150,
            n_rows: 120,
            resolution_m: 0.1,
            density: 0.01,
            ..ScatterParameters::default()
        };
        let map = scattered_obstacles(&parameters, Seed(seed)).unwrap();
        let place = Place::new(&map, vehicle.clone());
        for (start, goal) in free_pose_pairs(&map, &vehicle, 3, Seed(seed)).unwrap() {
            for request in variants(start, goal) {
                let is_found = |config| matches!(place.certified(&config, &request), Some(Ok(_)));
                let wide = SmoothingConfig {
                    redundant_nodes: RedundantNodes::Remove,
                    ..wide()
                };
                let curves = is_found(SmoothingConfig::default());
                n_wide += usize::from(is_found(wide.clone()));
                n_curves += usize::from(curves);
                assert!(!curves || is_found(wide), "{request:?}");
            }
        }
    }
    println!("wide arcs {n_wide}, curves alone {n_curves}");
    assert!(n_curves > 40);
}
