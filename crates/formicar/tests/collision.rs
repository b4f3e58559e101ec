//! The exact collision geometry against brute force: thousands of poses, hundreds of drives.

use formicar::collision::{Body, Drive, MIN_CLEARANCE_M, ObstacleMap};
use formicar::geometry::{ConvexPolygon, Point2, Pose2};
use formicar::map::{Cell, OCCUPIED, OccupancyGrid};
use formicar::numeric::{RandomStream, Seed};
use formicar::vehicle::{Vehicle, VehicleParameters};

const RESOLUTION_M: f64 = 0.25;

fn random_map(draw: &mut RandomStream) -> OccupancyGrid {
    let rows: Vec<String> = (0..40)
        .map(|_| {
            (0..48)
                .map(|_| if draw.unit() < 0.03 { '#' } else { '.' })
                .collect()
        })
        .collect();
    let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
    OccupancyGrid::from_rows(&rows, RESOLUTION_M).unwrap()
}

fn vehicles() -> Vec<Vehicle> {
    let footprint = serde_json::from_str(
        r#"{"footprint": [[1.1, 0.0], [0.7, 0.35], [-0.3, 0.4], [-0.45, 0.0], [-0.3, -0.4], [0.7, -0.35]], "min_turning_radius": 0.6}"#,
    );
    let hexagon: VehicleParameters = footprint.unwrap();
    let mut vehicles = vec![
        Vehicle::warehouse_amr(),
        Vehicle::f1tenth(),
        Vehicle::new(hexagon).unwrap(),
    ];
    vehicles.extend(concave());
    vehicles
}

/// An L, a U with the axle in its notch, and a T of a triangle and a bar.
fn concave() -> [Vehicle; 3] {
    [
        "[[[-0.4, -0.4], [1.0, -0.4], [1.0, 0.0], [-0.4, 0.0]], [[-0.4, -0.4], [0.0, -0.4], [0.0, 0.9], [-0.4, 0.9]]]",
        "[[[-0.5, 0.3], [0.9, 0.3], [0.9, 0.5], [-0.5, 0.5]], [[-0.5, -0.5], [0.9, -0.5], [0.9, -0.3], [-0.5, -0.3]], [[-0.6, -0.5], [-0.4, -0.5], [-0.4, 0.5], [-0.6, 0.5]]]",
        "[[[-0.3, 0.0], [0.8, -0.3], [0.8, 0.3]], [[0.7, -0.8], [1.0, -0.8], [1.0, 0.8], [0.7, 0.8]]]",
    ]
    .map(|parts| {
        let json = format!(r#"{{"parts": {parts}, "min_turning_radius_m": 0.8}}"#);
        Vehicle::new(serde_json::from_str(&json).unwrap()).unwrap()
    })
}

/// Distance of a placed body to squares and border, by sampling edges against exact squares: an
/// upper bound that is at most half the spacing too large.
fn sampled_clearance(map: &OccupancyGrid, vehicle: &Vehicle, pose: Pose2) -> f64 {
    let parts = vehicle.parts().iter();
    let sampled = parts.map(|part| sampled_clearance_of(map, part, pose));
    sampled.fold(f64::INFINITY, f64::min)
}

fn sampled_clearance_of(map: &OccupancyGrid, body: &ConvexPolygon, pose: Pose2) -> f64 {
    const N_SAMPLES: u32 = 60;
    let placed = body.placed(pose);
    let extent = map.frame().extent_m();
    let border = placed
        .corners()
        .iter()
        .map(|p| p.x.min(p.y).min(extent.x - p.x).min(extent.y - p.y))
        .fold(f64::INFINITY, f64::min)
        .max(0.0);
    let edges = || {
        placed.edges().flat_map(|(a, b)| {
            (0..=N_SAMPLES).map(move |i| a.lerp(b, f64::from(i) / f64::from(N_SAMPLES)))
        })
    };
    map.lethal_cells()
        .iter()
        .map(|cell| {
            let low = Point2::new(f64::from(cell.col), f64::from(cell.row)) * RESOLUTION_M;
            let center = low + Point2::new(0.5, 0.5) * RESOLUTION_M;
            let square = ConvexPolygon::rectangle(low, low + Point2::new(1.0, 1.0) * RESOLUTION_M);
            if placed.contains(center) || square.corners().iter().any(|&q| placed.contains(q)) {
                return 0.0;
            }
            edges()
                .map(|p| {
                    let dx = ((p.x - center.x).abs() - 0.5 * RESOLUTION_M).max(0.0);
                    let dy = ((p.y - center.y).abs() - 0.5 * RESOLUTION_M).max(0.0);
                    dx.hypot(dy)
                })
                .fold(f64::INFINITY, f64::min)
        })
        .fold(border, f64::min)
}

fn random_pose(draw: &mut RandomStream) -> Pose2 {
    Pose2::new(
        draw.range(0.5, 11.5),
        draw.range(0.5, 9.5),
        draw.range(-4.0, 4.0),
    )
}

/// As many as property tests draw, where loops draw by themselves.
fn n_cases() -> usize {
    proptest::test_runner::Config::default().cases as usize
}

#[test]
fn clearance_of_thousands_of_poses() {
    let n_rounds = n_cases() / 10;
    let mut draw = Seed(11).stream([0, 0]);
    let mut n_free = 0;
    for round in 0..n_rounds {
        let map = random_map(&mut draw);
        let obstacles = ObstacleMap::new(&map);
        let vehicle = &vehicles()[round % 6];
        let body = Body::new(vehicle);
        for _ in 0..100 {
            let pose = random_pose(&mut draw);
            let exact = obstacles.clearance_m(&body, pose);
            let sampled = sampled_clearance(&map, vehicle, pose);
            assert!(exact <= sampled + 1e-9, "{pose:?}: {exact} > {sampled}");
            // Sampled edges miss the nearest point by half a spacing at most.
            assert!(
                sampled - exact < 0.02,
                "{pose:?}: {exact} against {sampled}"
            );
            let free = obstacles.is_free(&body, &Drive::at(pose));
            assert_eq!(free, exact > MIN_CLEARANCE_M, "{pose:?}: {exact}");
            n_free += usize::from(free);
        }
    }
    assert!((10 * n_rounds..90 * n_rounds).contains(&n_free), "{n_free}");
}

#[test]
fn clearance_along_hundreds_of_drives() {
    let n_rounds = n_cases() / 20;
    let mut draw = Seed(12).stream([0, 0]);
    let mut n_free = 0;
    for round in 0..n_rounds {
        let map = random_map(&mut draw);
        let obstacles = ObstacleMap::new(&map);
        let vehicle = &vehicles()[round % 6];
        let body = Body::new(vehicle);
        for i in 0..20 {
            let curvature = if i % 5 == 0 {
                0.0
            } else {
                vehicle.max_curvature_per_m() * draw.range(-1.0, 1.0)
            };
            let drive = Drive {
                start: random_pose(&mut draw),
                curvature_per_m: curvature,
                signed_length_m: draw.range(-3.0, 3.0),
            };
            let exact = obstacles.drive_clearance_m(&body, &drive, f64::INFINITY);
            // Dense poses: an upper bound of the true clearance, tight to what a body point can
            // move between two of them.
            let n_poses = 300;
            let dense = (0..=n_poses)
                .map(|k| {
                    obstacles.clearance_m(&body, drive.pose_at(f64::from(k) / f64::from(n_poses)))
                })
                .fold(f64::INFINITY, f64::min);
            assert!(exact <= dense + 1e-9, "{drive:?}: {exact} > {dense}");
            assert!(dense - exact < 0.03, "{drive:?}: {exact} against {dense}");
            assert_eq!(
                obstacles.is_free(&body, &drive),
                exact > MIN_CLEARANCE_M,
                "{drive:?}"
            );
            let limited = obstacles.drive_clearance_m(&body, &drive, 0.1);
            assert!((limited - exact.min(0.1)).abs() < 1e-12);
            n_free += usize::from(exact > MIN_CLEARANCE_M);
        }
    }
    assert!((n_rounds..19 * n_rounds).contains(&n_free), "{n_free}");
}

#[test]
fn what_stands_in_a_notch_of_the_body_is_not_hit() {
    // The four cells beside the axle of a fork whose arms are 0.6 m apart.
    let row = ".".repeat(24);
    let mut map = OccupancyGrid::from_rows(&[&row[..]; 24], 0.125).unwrap();
    for (col, row) in [(11, 11), (12, 11), (11, 12), (12, 12)] {
        map.set(Cell::new(col, row), OCCUPIED);
    }
    let obstacles = ObstacleMap::new(&map);
    let [_, fork, _] = concave();
    let (body, pose) = (Body::new(&fork), Pose2::new(1.4375, 1.4375, 0.0));
    assert!((obstacles.clearance_m(&body, pose) - (0.3 - 0.1875)).abs() < 1e-12);
    assert!(obstacles.overlap(&body, pose).is_none());
    assert!(obstacles.touched_cells(&body, pose).is_empty());
    assert!((obstacles.contact(&fork, pose).y - 1.625).abs() < 1e-12);
    let ahead = |length_m| Drive {
        start: pose,
        curvature_per_m: 0.0,
        signed_length_m: length_m,
    };
    // The open end lets it back out; its back ends the drive ahead after 0.3375 m.
    assert!(obstacles.is_free(&body, &ahead(-0.7)));
    assert!(obstacles.is_free(&body, &ahead(0.33)));
    assert!(!obstacles.is_free(&body, &ahead(0.34)));
}

/// A corner that swings out between two poses that are free: sampling would miss it.
#[test]
fn a_notch_between_two_free_poses_is_seen() {
    let mut rows = vec![".".repeat(60); 60];
    rows[20].replace_range(30..31, "#");
    let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
    let map = OccupancyGrid::from_rows(&rows, 0.1).unwrap();
    let obstacles = ObstacleMap::new(&map);
    let vehicle = Vehicle::warehouse_amr();
    let body = Body::new(&vehicle);
    let cell = Point2::new(3.0, 3.9);
    // Aim the front right corner at the cell's lower edge from below while turning left.
    let corner = Point2::new(0.775, -0.31);
    let mut n_missed = 0;
    for i in 0..400 {
        // The corner passes straight above the turning center at a heading of 2.52 rad.
        let heading = 2.4 + 0.0004 * f64::from(i);
        let offset = Pose2::new(0.0, 0.0, heading).transform(corner);
        let start = Pose2::new(
            cell.x + 0.05 - offset.x,
            cell.y - 0.0004 - offset.y,
            heading,
        );
        let drive = Drive {
            start,
            curvature_per_m: 1.29,
            signed_length_m: 0.08,
        };
        let ends_free = [0.0, 1.0]
            .iter()
            .all(|&t| obstacles.is_free(&body, &Drive::at(drive.pose_at(t))));
        let dense_hit = (0..=2000)
            .any(|k| !obstacles.is_free(&body, &Drive::at(drive.pose_at(f64::from(k) / 2000.0))));
        if dense_hit {
            assert!(!obstacles.is_free(&body, &drive), "{drive:?}");
            n_missed += usize::from(ends_free);
        }
    }
    assert!(
        n_missed > 0,
        "the test must hold a case that end poses miss"
    );
}

#[test]
fn a_body_inside_a_large_block_is_not_free() {
    let rows = vec!["#".repeat(40); 40];
    let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
    let obstacles = ObstacleMap::new(&OccupancyGrid::from_rows(&rows, 0.25).unwrap());
    let body = Body::new(&Vehicle::warehouse_amr());
    assert_eq!(obstacles.clearance_m(&body, Pose2::new(5.0, 5.0, 0.3)), 0.0);
}

#[test]
fn a_point_may_touch_a_corner_but_not_enter() {
    let map = OccupancyGrid::from_rows(&["..#", "...", "..."], 1.0).unwrap();
    let obstacles = ObstacleMap::new(&map);
    let body = Body::new(&Vehicle::point());
    let along = |from: Point2, to: Point2| {
        let d = to - from;
        Drive {
            start: Pose2::at(from, d.angle()),
            curvature_per_m: 0.0,
            signed_length_m: d.norm(),
        }
    };
    let p = Point2::new;
    assert!(obstacles.is_free(&body, &along(p(1.5, 2.5), p(2.5, 1.5))));
    assert!(obstacles.is_free(&body, &along(p(2.0, 0.0), p(2.0, 3.0))));
    assert!(!obstacles.is_free(&body, &along(p(1.5, 2.6), p(2.6, 1.5))));
    assert!(obstacles.clearance_m(&body, Pose2::new(2.0, 2.0, 0.0)) < 2e-6);
    assert!(
        (obstacles.clearance_m(&body, Pose2::new(1.5, 1.5, 0.0)) - 0.5_f64.hypot(0.5)).abs() < 2e-6
    );
}

#[test]
fn slight_curvature_is_as_good_as_straight() {
    let mut rows = vec![".".repeat(100); 20];
    rows[3] = "#".repeat(100);
    let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
    let obstacles = ObstacleMap::new(&OccupancyGrid::from_rows(&rows, 0.1).unwrap());
    let body = Body::new(&Vehicle::warehouse_amr());
    let drive = |curvature_per_m| Drive {
        start: Pose2::new(1.0, 1.0, 0.0),
        curvature_per_m,
        signed_length_m: 7.0,
    };
    let straight = obstacles.drive_clearance_m(&body, &drive(0.0), 10.0);
    for curvature in [1e-15, 1e-9, 1e-7, 9.9e-7, 1.01e-6] {
        let slight = obstacles.drive_clearance_m(&body, &drive(curvature), 10.0);
        assert!(
            (slight - straight).abs() < 1e-4,
            "{curvature}: {slight} {straight}"
        );
    }
}
